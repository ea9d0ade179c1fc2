//! The lights of a scene are where its rays hit them.

use glam::DMat4;
use limpid_scenes::{MaterialKind, ShapeKind};

use super::*;
use crate::Prepared;
use crate::accel::{Hit, NONE as MISSED, Ray};
use crate::testing::{add, camera, glow, mesh, scene};

/// From the point `p` of the world; the number of samples drawn, and of those that a ray confirms.
fn confirmed(kind: &ShapeKind, world_from_object: DMat4, flip: bool, p: DVec3) -> (u32, u32) {
    let black = MaterialKind::Diffuse { reflectance: Color::Constant([0.0; 3]) };
    let eye = DVec3::new(0.5, -9.0, 0.25);
    let mut scene = scene(camera(eye, DVec3::ZERO, 1, 1), vec![black]);
    // Its primitives are not the first.
    add(&mut scene, ShapeKind::Rectangle, DMat4::from_translation(DVec3::new(0.0, 0.0, -50.0)), 0);
    let shape = add(&mut scene, kind.clone(), world_from_object, 0);
    (shape.emission, shape.flip_normals) = (glow(2.0), flip);
    let prepared = Prepared::new(&scene, 0).expect("nothing is missing");
    let (lights, textures) = (&prepared.lights, &prepared.textures);
    let light = lights.of_shape(1).expect("it emits");
    let p = (p - eye).as_vec3();
    let (mut drawn, mut found) = (0, 0);
    for i in 0..500 {
        let (choice, u) = numbers(Sampler::Sobol, i);
        let Some(s) = lights.sample(p, choice, u, textures) else { continue };
        drawn += 1;
        let (ray, mut hit) = (Ray::new(p, s.wi), [Hit::MISS]);
        prepared.accel.closest(&[ray], &mut hit);
        if hit[0].prim != s.skip || hit[0].prim == MISSED {
            continue; // at an edge, by rounding
        }
        let surface = prepared.geometry.surface(&ray, &hit[0]);
        let (radiance, pdf) = lights.hit(light, p, &surface, s.wi, textures);
        let slack = 1e-4 + 1e-5 / surface.ng.dot(s.wi).abs();
        let agree = (pdf / s.pdf - 1.0).abs() < slack && (hit[0].t / s.t_max - 1.0).abs() < slack;
        found += u32::from(agree && radiance == s.radiance && radiance == Rgb::splat(2.0));
    }
    (drawn, found)
}

#[test]
fn samples_are_confirmed_by_rays() {
    let corners = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let outwards = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let inwards = outwards.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
    let closed = |kind| (kind, DVec3::new(0.15, 0.2, 0.1));
    let shapes = [
        closed(ShapeKind::Cube),
        closed(ShapeKind::Sphere { center: DVec3::new(0.0, 0.1, 0.0), radius: 0.8 }),
        // So long that its inside is not seen through its ends.
        closed(ShapeKind::Cylinder { p0: DVec3::NEG_Z * 5.0, p1: DVec3::Z * 5.0, radius: 0.9 }),
        closed(mesh(corners.clone(), outwards)),
        // Open ones, and one whose winding is the wrong way round: its inside is the other way.
        (ShapeKind::Rectangle, DVec3::NEG_Z),
        (ShapeKind::Disk, DVec3::NEG_Z),
        (mesh(corners, inwards), DVec3::new(3.0, 4.0, 5.0)),
    ];
    let turned = DMat4::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 2.0);
    let place = DMat4::from_translation(DVec3::new(0.3, 0.7, -0.2));
    let maps = [
        DMat4::IDENTITY,
        place * turned * DMat4::from_scale(DVec3::new(0.5, 1.5, 1.0)),
        place * turned * DMat4::from_scale(DVec3::new(1.0, -1.0, 1.0)),
    ];
    for (kind, behind) in &shapes {
        // The side that emits for an upright map; a mirror and a flip each turn it, or leave what is closed.
        let front = match kind {
            ShapeKind::Rectangle | ShapeKind::Disk => DVec3::Z,
            _ if behind.length() > 1.0 => DVec3::new(0.15, 0.2, 0.1),
            _ => DVec3::new(3.0, 4.0, 5.0),
        };
        for map in maps {
            for flip in [false, true] {
                let at = |p: DVec3| map.transform_point3(p);
                let [lit, dark] = if flip { [*behind, front] } else { [front, *behind] };
                let (drawn, found) = confirmed(kind, map, flip, at(lit));
                assert!(
                    drawn >= 100 && f64::from(found) > 0.98 * f64::from(drawn),
                    "{kind:?} {map} {flip}: {found} of {drawn}"
                );
                // Of a closed mesh the far walls are drawn, behind the near ones.
                let (_, found) = confirmed(kind, map, flip, at(dark));
                assert_eq!(found, 0, "{kind:?} {map} {flip}: from behind");
            }
        }
    }
}

#[test]
fn emission_by_an_attribute_is_the_same_drawn_and_hit() {
    let values = vec![1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let name = String::from("vertex_color");
    let attribute = limpid_scenes::MeshAttribute {
        name: name.clone(),
        domain: limpid_scenes::AttributeDomain::Vertex,
        channels: 3,
        values,
    };
    let mesh = limpid_scenes::Mesh {
        positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        triangles: vec![[0, 1, 2]],
        attributes: vec![attribute],
        ..Default::default()
    };
    for flip in [false, true] {
        let black = MaterialKind::Diffuse { reflectance: Color::Constant([0.0; 3]) };
        let mut scene = scene(camera(DVec3::ZERO, DVec3::X, 1, 1), vec![black]);
        scene.textures.push(limpid_scenes::Texture {
            name: "t".into(),
            kind: limpid_scenes::TextureKind::MeshAttribute { name: name.clone(), scale: 2.0 },
            uv_from_surface: DMat3::IDENTITY,
            place: Place::default(),
        });
        let shape = add(&mut scene, ShapeKind::Mesh(std::sync::Arc::new(mesh.clone())), DMat4::IDENTITY, 0);
        let emission = limpid_scenes::Emission {
            name: None,
            radiance: Color::Texture(TextureId(0)),
            place: Place::default(),
        };
        (shape.emission, shape.flip_normals) = (Some(emission), flip);
        let prepared = Prepared::new(&scene, 0).expect("nothing is missing");
        let p = Vec3::new(0.3, 0.3, if flip { -0.5 } else { 0.5 });
        for i in 0..200 {
            let (choice, u) = numbers(Sampler::Sobol, i);
            let s = prepared.lights.sample(p, choice, u, &prepared.textures).expect("it emits towards p");
            let (ray, mut hit) = (Ray::new(p, s.wi), [Hit::MISS]);
            prepared.accel.closest(&[ray], &mut hit);
            if hit[0].prim == MISSED {
                continue; // at an edge, by rounding
            }
            let surface = prepared.geometry.surface(&ray, &hit[0]);
            let (radiance, _) = prepared.lights.hit(LightId(0), p, &surface, s.wi, &prepared.textures);
            assert!(radiance.abs_diff_eq(s.radiance, 1e-4), "{flip}: {radiance}, not {}", s.radiance);
            // Red, green and blue are the barycentric coordinates, and these the place.
            assert!((radiance.y - 2.0 * surface.p.x).abs() < 1e-4, "{flip}: {radiance} at {}", surface.p);
        }
    }
}
