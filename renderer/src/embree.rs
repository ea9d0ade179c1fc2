//! Embree 4 through its C library, which is opened at run time: what our hits and our speed are compared with.

#![allow(unsafe_code)]

use std::ffi::c_void;
use std::path::Path;
use std::ptr;

use glam::Vec3;
use libloading::Library;

use crate::accel::{Hit, NONE, Ray};
use crate::bench::cpu_seconds;

type Handle = *mut c_void;

#[repr(C, align(16))]
struct RtcRay {
    o: [f32; 3],
    near: f32,
    d: [f32; 3],
    time: f32,
    far: f32,
    mask: u32,
    id: u32,
    flags: u32,
}

/// The hit's tail is longer than any version's list of instances.
#[repr(C, align(16))]
struct RtcRayHit {
    ray: RtcRay,
    ng: [f32; 3],
    uv: [f32; 2],
    prim: u32,
    geometry: u32,
    instance: [u32; 4],
}

const PACKET: usize = 16;

#[repr(C, align(64))]
struct RtcPacket {
    o: [[f32; PACKET]; 3],
    near: [f32; PACKET],
    d: [[f32; PACKET]; 3],
    time: [f32; PACKET],
    far: [f32; PACKET],
    mask: [u32; PACKET],
    id: [u32; PACKET],
    flags: [u32; PACKET],
    ng: [[f32; PACKET]; 3],
    uv: [[f32; PACKET]; 2],
    prim: [u32; PACKET],
    geometry: [u32; PACKET],
    instance: [[u32; PACKET]; 4],
}

#[repr(C, align(64))]
struct Valid([i32; PACKET]);

type Query<T> = unsafe extern "C" fn(Handle, *mut T, Handle);
type PacketQuery = unsafe extern "C" fn(*const Valid, Handle, *mut RtcPacket, Handle);

/// A scene of one mesh in Embree, built with the default flags at medium quality by one thread.
pub struct Embree {
    /// Embree's number for its version, such as 40400.
    pub version: isize,
    scene: Handle,
    intersect1: Query<RtcRayHit>,
    occluded1: Query<RtcRay>,
    intersect16: PacketQuery,
    occluded16: PacketQuery,
    // Shared with Embree; the functions above are the library's.
    _corners: Vec<[f32; 3]>,
    _indices: Vec<[u32; 3]>,
    _library: Library,
}

impl Embree {
    /// Opens the library and builds over triangles whose corners are shared by position.
    ///
    /// # Errors
    ///
    /// Where the library cannot be opened, lacks a function or is not of version 4.
    pub fn new(library: &Path, triangles: &[[Vec3; 3]]) -> Result<(Self, f64), String> {
        let (mut corners, indices) = indexed(triangles);
        let count = corners.len();
        corners.push([0.0; 3]); // Embree reads 16 bytes at the last one
        corners.push([0.0; 3]);
        // SAFETY: the signatures are those of Embree 4's C interface; the buffers stay as they are as long as the scene.
        unsafe {
            let library = Library::new(library).map_err(|e| e.to_string())?;
            macro_rules! function {
                ($name:literal, $type:ty) => {
                    *library.get::<$type>($name).map_err(|e| e.to_string())?
                };
            }
            let device = function!(b"rtcNewDevice\0", unsafe extern "C" fn(*const i8) -> Handle)(
                c"threads=1".as_ptr().cast(),
            );
            let property = function!(b"rtcGetDeviceProperty\0", unsafe extern "C" fn(Handle, i32) -> isize);
            let version = property(device, 0);
            if !(40000..50000).contains(&version) {
                return Err(format!("Embree's version is {version}, not 4"));
            }
            let scene = function!(b"rtcNewScene\0", unsafe extern "C" fn(Handle) -> Handle)(device);
            let geometry =
                function!(b"rtcNewGeometry\0", unsafe extern "C" fn(Handle, i32) -> Handle)(device, 0);
            type Share = unsafe extern "C" fn(Handle, i32, u32, i32, *const c_void, usize, usize, usize);
            let share = function!(b"rtcSetSharedGeometryBuffer\0", Share);
            share(geometry, 0, 0, 0x5003, indices.as_ptr().cast(), 0, 12, indices.len());
            share(geometry, 1, 0, 0x9003, corners.as_ptr().cast(), 0, 12, count);
            function!(b"rtcCommitGeometry\0", unsafe extern "C" fn(Handle))(geometry);
            function!(b"rtcAttachGeometry\0", unsafe extern "C" fn(Handle, Handle) -> u32)(scene, geometry);
            let begin = cpu_seconds();
            function!(b"rtcCommitScene\0", unsafe extern "C" fn(Handle))(scene);
            let seconds = cpu_seconds() - begin;
            let embree = Self {
                version,
                scene,
                intersect1: function!(b"rtcIntersect1\0", Query<RtcRayHit>),
                occluded1: function!(b"rtcOccluded1\0", Query<RtcRay>),
                intersect16: function!(b"rtcIntersect16\0", PacketQuery),
                occluded16: function!(b"rtcOccluded16\0", PacketQuery),
                _corners: corners,
                _indices: indices,
                _library: library,
            };
            Ok((embree, seconds))
        }
    }

    /// The nearest hit of each ray; `skip` is not looked at.
    pub fn closest(&self, rays: &[Ray], hits: &mut [Hit]) {
        for (ray, hit) in rays.iter().zip(hits) {
            let mut query = RtcRayHit {
                ray: single(ray),
                ng: [0.0; 3],
                uv: [0.0; 2],
                prim: NONE,
                geometry: NONE,
                instance: [NONE; 4],
            };
            // SAFETY: the scene is built, and the struct is the library's.
            unsafe { (self.intersect1)(self.scene, &mut query, ptr::null_mut()) };
            *hit = if query.geometry == NONE {
                Hit::MISS
            } else {
                Hit { t: query.ray.far, prim: query.prim, u: query.uv[0], v: query.uv[1], instance: NONE }
            };
        }
    }

    /// Whether anything lies on each ray.
    pub fn occluded(&self, rays: &[Ray], blocked: &mut [bool]) {
        for (ray, blocked) in rays.iter().zip(blocked) {
            let mut query = single(ray);
            // SAFETY: as above.
            unsafe { (self.occluded1)(self.scene, &mut query, ptr::null_mut()) };
            *blocked = query.far < 0.0;
        }
    }

    /// [`closest`](Self::closest) in packets of 16.
    pub fn closest_packets(&self, rays: &[Ray], hits: &mut [Hit]) {
        for (rays, hits) in rays.chunks(PACKET).zip(hits.chunks_mut(PACKET)) {
            let (valid, mut query) = packet(rays);
            // SAFETY: as above.
            unsafe { (self.intersect16)(&valid, self.scene, &mut query, ptr::null_mut()) };
            for (k, hit) in hits.iter_mut().enumerate() {
                *hit = if query.geometry[k] == NONE {
                    Hit::MISS
                } else {
                    let [u, v] = query.uv.map(|c| c[k]);
                    Hit { t: query.far[k], prim: query.prim[k], u, v, instance: NONE }
                };
            }
        }
    }

    /// [`occluded`](Self::occluded) in packets of 16.
    pub fn occluded_packets(&self, rays: &[Ray], blocked: &mut [bool]) {
        for (rays, blocked) in rays.chunks(PACKET).zip(blocked.chunks_mut(PACKET)) {
            let (valid, mut query) = packet(rays);
            // SAFETY: as above; the ray of a packet is the beginning of this struct.
            unsafe { (self.occluded16)(&valid, self.scene, &mut query, ptr::null_mut()) };
            for (k, blocked) in blocked.iter_mut().enumerate() {
                *blocked = query.far[k] < 0.0;
            }
        }
    }
}

fn single(ray: &Ray) -> RtcRay {
    RtcRay {
        o: ray.o.to_array(),
        near: 0.0,
        d: ray.d.to_array(),
        time: 0.0,
        far: ray.t_max,
        mask: NONE,
        id: 0,
        flags: 0,
    }
}

fn packet(rays: &[Ray]) -> (Valid, RtcPacket) {
    let ray = |k: usize| &rays[k.min(rays.len() - 1)];
    let query = RtcPacket {
        o: std::array::from_fn(|axis| std::array::from_fn(|k| ray(k).o[axis])),
        near: [0.0; PACKET],
        d: std::array::from_fn(|axis| std::array::from_fn(|k| ray(k).d[axis])),
        time: [0.0; PACKET],
        far: std::array::from_fn(|k| ray(k).t_max),
        mask: [NONE; PACKET],
        id: [0; PACKET],
        flags: [0; PACKET],
        ng: [[0.0; PACKET]; 3],
        uv: [[0.0; PACKET]; 2],
        prim: [NONE; PACKET],
        geometry: [NONE; PACKET],
        instance: [[NONE; PACKET]; 4],
    };
    (Valid(std::array::from_fn(|k| if k < rays.len() { -1 } else { 0 })), query)
}

/// Corners of equal position become one.
fn indexed(triangles: &[[Vec3; 3]]) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let (mut corners, mut known) = (Vec::new(), std::collections::HashMap::new());
    let indices = (triangles.iter())
        .map(|t| {
            t.map(|p| {
                *known.entry(p.to_array().map(f32::to_bits)).or_insert_with(|| {
                    corners.push(p.to_array());
                    corners.len() as u32 - 1
                })
            })
        })
        .collect();
    (corners, indices)
}
