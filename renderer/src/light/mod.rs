//! Lights, for the time being: triangles by area, spheres by cone, a constant sky by BSDF sampling alone.
use crate::accel::SceneBounds;
use crate::color::Rgb;
use crate::geometry::{Geometry, Surface};
use crate::texture::Textures;
use glam::{DVec3, Vec2, Vec3};
use limpid_scenes::{Color, LightKind};
#[derive(Clone, Copy)]
pub struct LightId(pub u32);
pub struct LightSample {
    pub wi: Vec3,
    pub t_max: f32,
    pub radiance: Rgb,
    pub pdf: f32,
    pub skip: u32,
}
enum Kind {
    Tris(Vec<(u32, [Vec3; 3], Vec3, f32)>, f32),
    Sphere(DVec3, f64, u32),
}
pub struct Lights {
    lights: Vec<(Kind, Rgb)>,
    of_shape: Vec<Option<u32>>,
    sky: Option<Rgb>,
}
impl Lights {
    pub fn new(scene: &limpid_scenes::Scene, g: &Geometry, _: &Textures, _: SceneBounds) -> Self {
        let mut lights = Vec::new();
        let mut of_shape = Vec::new();
        for (i, s) in scene.shapes.iter().enumerate() {
            let Some(e) = &s.emission else {
                of_shape.push(None);
                continue;
            };
            let Color::Constant(c) = e.radiance else {
                of_shape.push(None);
                continue;
            };
            of_shape.push(Some(lights.len() as u32));
            let sh = &g.shapes[i];
            let kind = if (sh.first_prim as usize) < g.triangles.len() {
                let mut total = 0.0;
                let t = (sh.first_prim..sh.first_prim + sh.prims)
                    .map(|p| {
                        let c = g.corners(p);
                        let n = (c[1] - c[0]).cross(c[2] - c[0]);
                        total += 0.5 * n.length();
                        (p, c, n.normalize() * if g.is_turned(p) { -1.0 } else { 1.0 }, total)
                    })
                    .collect();
                Kind::Tris(t, total)
            } else {
                let a = &g.analytics[sh.first_prim as usize - g.triangles.len()];
                let m = a.frame.render_from_object;
                Kind::Sphere(m.translation, m.matrix3.x_axis.length(), sh.first_prim)
            };
            lights.push((kind, Rgb::from(c)));
        }
        let sky = scene.lights.iter().find_map(|l| match l.kind {
            LightKind::Constant { radiance } => Some(radiance.into()),
            _ => None,
        });
        Self { lights, of_shape, sky }
    }
    pub fn of_shape(&self, s: u32) -> Option<LightId> {
        self.of_shape[s as usize].map(LightId)
    }
    pub fn radiance(&self, l: LightId, s: &Surface, wo: Vec3, _: &Textures) -> Rgb {
        if wo.dot(s.ng) > 0.0 { self.lights[l.0 as usize].1 } else { Rgb::ZERO }
    }
    pub fn hit(&self, l: LightId, p: Vec3, s: &Surface, wi: Vec3, t: &Textures) -> (Rgb, f32) {
        let r = self.radiance(l, s, -wi, t);
        let n = self.lights.len() as f32;
        let pdf = match &self.lights[l.0 as usize].0 {
            Kind::Tris(_, area) => (s.p - p).length_squared() / (area * wi.dot(s.ng).abs()),
            Kind::Sphere(c, r, _) => {
                let d2 = (*c - p.as_dvec3()).length_squared();
                let s2 = r * r / d2;
                (1.0 / (std::f64::consts::TAU * (s2 / (1.0 + (1.0 - s2).sqrt())))) as f32
            }
        };
        (r, pdf / n)
    }
    pub fn has_infinite(&self) -> bool {
        self.sky.is_some()
    }
    pub fn miss(&self, _: Vec3) -> impl Iterator<Item = (Rgb, f32)> + '_ {
        self.sky.iter().map(|c| (*c, 0.0))
    }
    pub fn sample(&self, p: Vec3, u: f32, v: Vec2, _: &Textures) -> Option<LightSample> {
        let n = self.lights.len();
        if n == 0 {
            return None;
        }
        let x = u * n as f32;
        let i = (x as usize).min(n - 1);
        let u = x - i as f32;
        let (k, r) = &self.lights[i];
        match k {
            Kind::Tris(t, total) => {
                let j = t.partition_point(|t| t.3 <= u * total).min(t.len() - 1);
                let (prim, c, ng, _) = t[j];
                let s = v.x.sqrt();
                let q = c[0] * (1.0 - s) + c[1] * (s * (1.0 - v.y)) + c[2] * (s * v.y);
                let d = q - p;
                let d2 = d.length_squared();
                let wi = d / d2.sqrt();
                let cos = -wi.dot(ng);
                (cos > 0.0).then(|| LightSample {
                    wi,
                    t_max: d2.sqrt() * (1.0 - 1e-5),
                    radiance: *r,
                    pdf: d2 / (total * cos) / n as f32,
                    skip: prim,
                })
            }
            Kind::Sphere(c, rad, prim) => {
                let w = *c - p.as_dvec3();
                let d2 = w.length_squared();
                let s2 = rad * rad / d2;
                if s2 >= 1.0 {
                    return None;
                }
                let omc = s2 / (1.0 + (1.0 - s2).sqrt());
                let one_minus = omc * v.x as f64;
                let sin = (one_minus * (2.0 - one_minus)).sqrt();
                let (sp, cp) = (std::f64::consts::TAU * v.y as f64).sin_cos();
                let z = w / d2.sqrt();
                let (x, y) = z.any_orthonormal_pair();
                let wi = x * sin * cp + y * sin * sp + z * (1.0 - one_minus);
                let b = wi.dot(w);
                let t = b - (rad * rad - (d2 - b * b)).max(0.0).sqrt();
                Some(LightSample {
                    wi: wi.as_vec3(),
                    t_max: (t * (1.0 - 1e-5)) as f32,
                    radiance: *r,
                    pdf: (1.0 / (std::f64::consts::TAU * omc)) as f32 / n as f32,
                    skip: *prim,
                })
            }
        }
    }
}
