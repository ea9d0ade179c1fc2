//! The random numbers are fixed: a test that passes once always passes.

mod delta;
mod density;
mod gather;
mod irradiance;

use glam::{DAffine3, DMat3, DVec3};
use limpid_scenes::{Place, Scene, TextureId};

use super::*;
use crate::sampling::{Dim, PixelSampler};
use crate::settings::Sampler;

const NO_TEXTURES: fn() -> Textures = || Textures::prepare(&Scene::default());
const WHITE: Color = Color::Constant([1.0; 3]);

fn only(form: LightForm) -> Lights {
    with_emission(form, WHITE, &NO_TEXTURES())
}

fn with_emission(form: LightForm, emission: Color, textures: &Textures) -> Lights {
    Lights::from_shapes(vec![LightShape { shape: 3, form, emission }], &[], textures, DVec3::ZERO, 1.0)
}

fn infinite(kind: LightKind) -> Lights {
    let light = SceneLight { name: "sky".into(), kind, place: Place::default() };
    Lights::from_shapes(Vec::new(), &[light], &NO_TEXTURES(), DVec3::ZERO, 1.0)
}

/// One texture, of texels that `value` gives row by row, not interpolated.
fn picture(width: u32, height: u32, value: impl Fn(usize) -> [f32; 3]) -> Textures {
    let texels = limpid_scenes::Texels::Linear32((0..(width * height) as usize).flat_map(value).collect());
    let image = std::sync::Arc::new(limpid_scenes::Image { width, height, texels });
    let kind = limpid_scenes::TextureKind::Bitmap {
        image,
        filter: limpid_scenes::TexelFilter::Nearest,
        wrap: limpid_scenes::WrapMode::Repeat,
    };
    let texture = limpid_scenes::Texture {
        name: "t".into(),
        kind,
        uv_from_surface: DMat3::IDENTITY,
        place: Place::default(),
    };
    Textures::prepare(&Scene { textures: vec![texture], ..Scene::default() })
}

/// Choice and point of sample `i`, from the renderer's own sets.
fn numbers(sampler: Sampler, i: u32) -> (f32, Vec2) {
    let [choice, u, v] = PixelSampler::new(sampler, 3, 0, [0, 0], i).draw3(Dim::Light(0));
    (choice, Vec2::new(u, v))
}

fn sphere(center: [f64; 3], axes: [f64; 3], turned: bool) -> LightForm {
    let rotated = DMat3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 0.7);
    let matrix3 = rotated * DMat3::from_diagonal(axes.into());
    LightForm::Sphere(LightAnalytic {
        render_from_unit: DAffine3 { matrix3, translation: center.into() },
        turned,
        prim: 9,
    })
}

fn disk(center: [f64; 3], x: [f64; 3], y: [f64; 3], turned: bool) -> LightForm {
    let (x, y) = (DVec3::from(x), DVec3::from(y));
    let matrix3 = DMat3::from_cols(x, y, x.cross(y));
    LightForm::Disk(LightAnalytic {
        render_from_unit: DAffine3 { matrix3, translation: center.into() },
        turned,
        prim: 9,
    })
}

fn cylinder(center: [f64; 3], axes: [f64; 3], turned: bool) -> LightForm {
    let LightForm::Sphere(map) = sphere(center, axes, turned) else { unreachable!("it is one") };
    LightForm::Cylinder(map)
}

fn rectangle(corner: [f32; 3], edge_u: [f32; 3], edge_v: [f32; 3]) -> LightForm {
    LightForm::Rectangle(LightRectangle {
        corner: corner.into(),
        edge_u: edge_u.into(),
        edge_v: edge_v.into(),
        turned: false,
        prims: [9, 10],
    })
}

/// A square at a height over the origin that emits downwards.
fn square(height: f32, half: f32) -> LightForm {
    rectangle([-half, half, height], [2.0 * half, 0.0, 0.0], [0.0, -2.0 * half, 0.0])
}

fn triangle(corners: [[f32; 3]; 3], prim: u32) -> LightTriangle {
    LightTriangle {
        corners: corners.map(Vec3::from),
        uvs: [Vec2::ZERO, Vec2::X, Vec2::Y],
        prim,
        turned: false,
    }
}

fn triangles(corners: &[[[f32; 3]; 3]]) -> LightForm {
    LightForm::Triangles(corners.iter().zip(20..).map(|(&c, prim)| triangle(c, prim)).collect())
}

/// All hits of the ray from `p` along `wi` with a light, by the plainest means.
fn intersect(form: &LightForm, p: Vec3, wi: Vec3) -> Vec<LightHit> {
    let (o, d) = (p.as_dvec3(), wi.as_dvec3());
    match form {
        LightForm::Triangles(triangles) => triangles
            .iter()
            .filter_map(|t| {
                let corners = t.corners.map(Vec3::as_dvec3);
                let (s, r) = plane(o, d, corners[0], corners[1] - corners[0], corners[2] - corners[0])?;
                let uv = t.uvs[0] + s * (t.uvs[1] - t.uvs[0]) + r * (t.uvs[2] - t.uvs[0]);
                (s >= 0.0 && r >= 0.0 && s + r <= 1.0).then(|| {
                    on_plane(o, d, corners[0], corners[1] - corners[0], corners[2] - corners[0], uv, t.prim)
                })
            })
            .collect(),
        LightForm::Rectangle(r) => {
            let [c, u, v] = [r.corner, r.edge_u, r.edge_v].map(Vec3::as_dvec3);
            let Some((s, t)) = plane(o, d, c, u, v) else { return Vec::new() };
            let inside = (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t);
            let mut hit = on_plane(o, d, c, u, v, Vec2::new(s, t), r.prims[usize::from(s < t)]);
            hit.ng = if r.turned { -hit.ng } else { hit.ng };
            if inside { vec![hit] } else { Vec::new() }
        }
        LightForm::Disk(a) => {
            let m = a.render_from_unit;
            let Some((s, t)) = plane(o, d, m.translation, m.matrix3.x_axis, m.matrix3.y_axis) else {
                return Vec::new();
            };
            let uv = Vec2::new(s.hypot(t), turn(t, s));
            let (x, y) = (m.matrix3.x_axis, m.matrix3.y_axis);
            let mut hit = on_plane(o, d, m.translation, x, y, uv, a.prim);
            hit.ng = if a.turned { -hit.ng } else { hit.ng };
            if s * s + t * t <= 1.0 { vec![hit] } else { Vec::new() }
        }
        LightForm::Cylinder(a) => {
            let inverse = a.render_from_unit.inverse();
            let (o1, d1) = (inverse.transform_point3(o), inverse.transform_vector3(d));
            let (o2, d2) = (o1.truncate(), d1.truncate());
            let middle = -o2.dot(d2) / d2.length_squared();
            let under = (1.0 - (o2 + middle * d2).length_squared()) / d2.length_squared();
            let roots = [middle - under.sqrt(), middle + under.sqrt()].into_iter();
            let hits = roots.filter(|t| *t > 0.0 && (0.0..=1.0).contains(&(o1.z + t * d1.z))).map(|t| {
                let q = o1 + t * d1;
                let ng = (inverse.matrix3.transpose() * DVec3::new(q.x, q.y, 0.0)).normalize().as_vec3();
                LightHit {
                    p: (o + t * d).as_vec3(),
                    ng: if a.turned { -ng } else { ng },
                    uv: Vec2::new(turn(q.y as f32, q.x as f32), q.z as f32).into(),
                    prim: a.prim,
                }
            });
            // The near wall hides what lies behind it.
            hits.take(1).collect()
        }
        LightForm::Sphere(a) => {
            let inverse = a.render_from_unit.inverse();
            let (o1, d1) = (inverse.transform_point3(o), inverse.transform_vector3(d));
            // o1 + t d1 on the unit sphere, from the point that is nearest to its centre.
            let (a2, b) = (d1.length_squared(), -o1.dot(d1));
            let closest = o1 + b / a2 * d1;
            let under = (1.0 - closest.length_squared()) / a2;
            if under < 0.0 {
                return Vec::new();
            }
            [b / a2 - under.sqrt(), b / a2 + under.sqrt()]
                .into_iter()
                .filter(|&t| t > 0.0)
                .map(|t| {
                    let q = o1 + t * d1;
                    let outwards = inverse.matrix3.transpose() * q;
                    let ng = outwards.normalize().as_vec3();
                    LightHit {
                        p: (o + t * d).as_vec3(),
                        ng: if a.turned { -ng } else { ng },
                        uv: Vec2::new(
                            turn(q.y as f32, q.x as f32),
                            (q.z.clamp(-1.0, 1.0).acos() / PI) as f32,
                        )
                        .into(),
                        prim: a.prim,
                    }
                })
                .collect()
        }
    }
}

fn turn(y: f32, x: f32) -> f32 {
    (y.atan2(x) / std::f32::consts::TAU).rem_euclid(1.0)
}

/// Coordinates of the hit with a plane, in front of the ray.
fn plane(o: DVec3, d: DVec3, corner: DVec3, u: DVec3, v: DVec3) -> Option<(f32, f32)> {
    let n = u.cross(v);
    let t = n.dot(corner - o) / n.dot(d);
    let q = o + t * d - corner;
    let s = q.cross(v).dot(n) / n.length_squared();
    let r = u.cross(q).dot(n) / n.length_squared();
    (t > 0.0).then_some((s as f32, r as f32))
}

fn on_plane(o: DVec3, d: DVec3, corner: DVec3, u: DVec3, v: DVec3, uv: Vec2, prim: u32) -> LightHit {
    let n = u.cross(v);
    let t = n.dot(corner - o) / n.dot(d);
    LightHit { p: (o + t * d).as_vec3(), ng: n.normalize().as_vec3(), uv: uv.into(), prim }
}

/// One light of each kind and situation, with a name, and points to look at it from.
fn cases() -> Vec<(&'static str, LightForm, Vec<Vec3>)> {
    let points = |p: &[[f32; 3]]| p.iter().map(|&p| Vec3::from(p)).collect::<Vec<_>>();
    let below = points(&[[0.0, 0.0, 0.0], [0.3, -0.2, 0.9], [2.5, 0.4, 0.5], [9.0, -40.0, -30.0]]);
    vec![
        ("square", square(1.0, 0.5), below.clone()),
        ("wide square", square(1.0, 8.0), below.clone()),
        ("parallelogram", rectangle([-1.0, 1.0, 1.5], [2.0, 0.5, 0.0], [0.3, -1.0, 0.4]), below.clone()),
        ("disk", disk([0.0, 0.0, 1.2], [0.5, 0.0, 0.1], [0.0, -0.8, 0.0], false), below.clone()),
        ("turned disk", disk([0.0, 0.0, 1.2], [0.5, 0.0, 0.1], [0.0, 0.8, 0.0], true), below.clone()),
        (
            "small triangle",
            triangles(&[[[0.0, 0.0, 1.0], [0.0, 0.02, 1.0], [0.02, 0.0, 1.0]]]),
            below.clone(),
        ),
        ("triangle", triangles(&[[[-1.0, -1.0, 1.0], [0.0, 1.0, 1.2], [1.0, -1.0, 1.1]]]), below),
        // Convex, so that a ray meets one front at most.
        (
            "tetrahedron",
            triangles(&TETRAHEDRON),
            points(&[[0.0, 0.0, 2.0], [0.0, 0.0, -0.3], [3.0, 4.0, 5.0]]),
        ),
        (
            "sphere",
            sphere([0.0, 0.0, 2.0], [1.0; 3], false),
            points(&[[0.0, 0.0, 0.0], [0.0, 0.0, 0.99], [5.0, 60.0, 7.0]]),
        ),
        (
            "lit from inside",
            sphere([0.0, 0.0, 2.0], [1.0; 3], true),
            points(&[[0.0, 0.0, 2.0], [0.0, 0.9, 2.0]]),
        ),
        (
            "ellipsoid",
            sphere([0.0, 0.0, 2.0], [0.5, -1.0, 0.7], false),
            points(&[[0.0, 0.0, 0.0], [1.0, 1.2, 2.0], [5.0, 60.0, 7.0]]),
        ),
        (
            "ellipsoid lit from inside",
            sphere([0.0, 0.0, 2.0], [0.5, 1.0, 0.7], true),
            points(&[[0.0, 0.0, 2.0], [0.1, 0.3, 2.2]]),
        ),
        (
            "cylinder",
            cylinder([0.0, 0.0, 2.0], [0.5, 0.5, 1.5], false),
            points(&[[0.0, 0.0, 0.0], [0.6, 1.2, 2.0], [5.0, 60.0, 7.0]]),
        ),
        (
            "elliptic cylinder",
            cylinder([0.0, 0.0, 2.0], [0.5, -1.0, 0.7], false),
            points(&[[1.5, 1.5, 2.0], [5.0, 60.0, 7.0]]),
        ),
        // Inside, in front of an open end, and outside, from where a part is seen through the end.
        (
            "tube lit from inside",
            cylinder([0.0, 0.0, 2.0], [0.5, 0.5, 0.7], true),
            points(&[[0.2, 0.0, 2.3], [-0.3, 0.1, 1.0], [-1.5, 0.2, 1.2]]),
        ),
    ]
}

#[rustfmt::skip]
const TETRAHEDRON: [[[f32; 3]; 3]; 4] = [
    [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
    [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]],
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
];

#[test]
fn shapes_know_their_lights() {
    let lights = only(square(1.0, 1.0));
    assert_eq!(lights.of_shape(3), Some(LightId(0)));
    assert!([0, 4, u32::MAX].iter().all(|&shape| lights.of_shape(shape).is_none()));
    assert!(!lights.has_infinite() && infinite(LightKind::Constant { radiance: [0.0; 3] }).has_infinite());
}

#[test]
fn what_emits_nothing_is_never_drawn() {
    let textures = NO_TEXTURES();
    let dark = with_emission(square(1.0, 1.0), Color::Constant([0.0; 3]), &textures);
    let flat = only(triangles(&[[[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [2.0, 0.0, 1.0]]]));
    let sky = infinite(LightKind::Constant { radiance: [0.0; 3] });
    let none = Lights::from_shapes(Vec::new(), &[], &textures, DVec3::ZERO, 0.0);
    for lights in [dark, flat, sky, none] {
        assert_eq!(lights.sample(Vec3::ZERO, 0.5, Vec2::splat(0.5), &textures), None);
    }
}

#[test]
fn light_does_not_leave_the_back() {
    let textures = NO_TEXTURES();
    let behind = [
        ("square", Vec3::new(0.1, 0.2, 3.0)),
        ("disk", Vec3::new(0.1, 0.2, 3.0)),
        ("triangle", Vec3::Z * 3.0),
    ];
    let inside = [("tetrahedron", Vec3::splat(0.1)), ("sphere", Vec3::Z * 2.3), ("ellipsoid", Vec3::Z * 2.2)];
    let outside = [("lit from inside", Vec3::ZERO), ("ellipsoid lit from inside", Vec3::ZERO)];
    for (name, form, _) in cases() {
        for (_, p) in behind.iter().chain(&inside).chain(&outside).filter(|(n, _)| *n == name) {
            let lights = only(form.clone());
            for i in 0..256 {
                let (choice, u) = numbers(Sampler::Sobol, i);
                assert_eq!(lights.sample(*p, choice, u, &textures), None, "{name}");
            }
        }
    }
}

#[test]
fn densities_beyond_single_precision_keep_the_ratio_to_radiance() {
    // A square of half-side 1e-15 at distance 1e5: density 2.5e39.
    let textures = NO_TEXTURES();
    let lights = with_emission(square(1e5, 1e-15), Color::Constant([1e30; 3]), &textures);
    let sample = lights.sample(Vec3::ZERO, 0.5, Vec2::splat(0.5), &textures).unwrap();
    assert_eq!(sample.pdf, f32::MAX);
    let truth = 1e30 * 4e-30 / 1e10;
    assert!((f64::from(sample.radiance.x / sample.pdf) / truth - 1.0).abs() < 1e-5, "{sample:?}");
}

#[test]
fn coordinates_that_are_no_numbers_do_no_harm() {
    let textures = NO_TEXTURES();
    for (name, form, _) in cases() {
        let lights = only(form);
        for p in [Vec3::NAN, Vec3::INFINITY, Vec3::MAX, Vec3::ZERO] {
            for u in [Vec2::ZERO, Vec2::splat(1.0 - f32::EPSILON / 2.0)] {
                let Some(s) = lights.sample(p, u.x, u, &textures) else { continue };
                assert!(
                    s.wi.is_finite() && s.pdf > 0.0 && s.pdf.is_finite() && s.t_max >= 0.0,
                    "{name} {p}: {s:?}"
                );
            }
        }
    }
}

#[test]
fn uv_of_samples_is_that_of_hits() {
    // A look-up is told apart by its place.
    let textures =
        picture(64, 64, |i| [3 * i, 3 * i + 1, 3 * i + 2].map(|i| ((i * 7919) % 1000) as f32 + 1.0));
    for (name, form, points) in cases() {
        let lights = with_emission(form.clone(), Color::Texture(TextureId(0)), &textures);
        let (mut same, mut all) = (0, 0);
        for i in 0..1000 {
            let (choice, u) = numbers(Sampler::Sobol, i);
            let Some(s) = lights.sample(points[0], choice, u, &textures) else { continue };
            for at in intersect(&form, points[0], s.wi).iter().filter(|at| at.prim == s.skip) {
                let (radiance, _) = lights.hit_at(LightId(0), points[0], at, s.wi, &textures);
                if radiance != Rgb::ZERO {
                    all += 1;
                    same += u32::from(radiance == s.radiance);
                }
            }
        }
        // Not so where rounding leads into the next texel.
        assert!(all > 200 && f64::from(same) > 0.98 * f64::from(all), "{name}: {same} of {all}");
    }
}
