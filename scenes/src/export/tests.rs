mod products;

use std::fs;
use std::path::Path;

use super::*;
use crate::{LoadOptions, ShapeKind, Warning, load, load_str};

/// Exports into a folder and reads the result back.
fn there_and_back(scene: &Scene) -> (Scene, Exported) {
    let folder = tempfile::tempdir().unwrap();
    let mut write = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap())?;
        fs::write(path, bytes)
    };
    let exported = export_mitsuba(scene, "files", &mut write).unwrap();
    let path = folder.path().join("out.xml");
    fs::write(&path, &exported.xml).unwrap();
    let again = load(&path, &LoadOptions::default()).unwrap_or_else(|e| panic!("{e}\n{}", exported.xml));
    (again, exported)
}

fn loaded(elements: &str) -> Scene {
    load_str(&format!("<scene version=\"3.0.0\">{elements}</scene>"), Path::new("."), &LoadOptions::default())
        .unwrap()
}

/// What the material of the only shape is, its inner ones in place.
fn shown(scene: &Scene) -> String {
    fn show(scene: &Scene, id: crate::MaterialId) -> String {
        let kind = &scene.materials[id.0 as usize].kind;
        let inner: Vec<String> = kind.inner().into_iter().map(|id| show(scene, id)).collect();
        format!("{kind:?} of {inner:?}").replace("MaterialId", "").chars().collect()
    }
    show(scene, scene.shapes[0].material)
}

/// The numbers of materials change, what they are does not.
fn without_ids(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('(') {
        let digits = after.find(|c: char| !c.is_ascii_digit()).unwrap_or(after.len());
        out += before;
        out += if after[digits..].starts_with(')') { "(_" } else { "(" };
        rest = if after[digits..].starts_with(')') { &after[digits..] } else { after };
    }
    out + rest
}

#[test]
fn materials_come_back_as_they_were() {
    let diffuse = r#"<bsdf type="diffuse"><rgb name="reflectance" value="0.1 0.2 0.3"/></bsdf>"#;
    let cases = [
        diffuse.to_string(),
        r#"<bsdf type="conductor"><string name="material" value="Au"/></bsdf>"#.into(),
        r#"<bsdf type="conductor"/>"#.into(),
        r#"<bsdf type="roughconductor"><string name="distribution" value="ggx"/><float name="alpha_u" value="0.3"/></bsdf>"#.into(),
        r#"<bsdf type="dielectric"><float name="int_ior" value="1.7"/></bsdf>"#.into(),
        r#"<bsdf type="roughdielectric"><string name="distribution" value="ggx"/><float name="alpha_v" value="0.3"/></bsdf>"#.into(),
        r#"<bsdf type="thindielectric"><rgb name="specular_transmittance" value="0.1 0.2 0.3"/></bsdf>"#.into(),
        r#"<bsdf type="plastic"><boolean name="nonlinear" value="true"/></bsdf>"#.into(),
        r#"<bsdf type="roughplastic"><float name="alpha" value="0.37"/></bsdf>"#.into(),
        format!(r#"<bsdf type="twosided">{diffuse}<bsdf type="plastic"/></bsdf>"#),
        format!(r#"<bsdf type="mask"><float name="opacity" value="0.3"/>{diffuse}</bsdf>"#),
        format!(r#"<bsdf type="blendbsdf"><float name="weight" value="0.3"/>{diffuse}<bsdf type="plastic"/></bsdf>"#),
        format!(r#"<bsdf type="normalmap"><rgb name="normalmap" value="0.3 0.5 1"/>{diffuse}</bsdf>"#),
        r#"<bsdf type="null"/>"#.into(),
        r#"<bsdf type="principled"><float name="metallic" value="0.3"/><float name="specular" value="0.7"/><float name="sheen" value="0.2"/></bsdf>"#.into(),
        r#"<bsdf type="principledthin"><float name="eta" value="1.4"/><float name="diff_trans" value="1.3"/></bsdf>"#.into(),
    ];
    for case in cases {
        let scene = loaded(&format!(r#"<sensor type="perspective"/><shape type="cube">{case}</shape>"#));
        let (again, exported) = there_and_back(&scene);
        assert_eq!(without_ids(&shown(&again)), without_ids(&shown(&scene)), "{case}\n{}", exported.xml);
        assert!(
            exported.notes.is_empty() && again.warnings.is_empty(),
            "{case}: {:?} {:?}",
            exported.notes,
            again.warnings
        );
    }
}

#[test]
fn models_of_0_x_are_refused_with_their_place() {
    for kind in ["roughdiffuse", "phong", "ward"] {
        let scene = loaded(&format!(r#"<shape type="cube"><bsdf type="{kind}" id="old"/></shape>"#));
        let error = export_mitsuba(&scene, "assets", &mut |_, _| Ok(())).unwrap_err().to_string();
        assert!(error.contains(&format!("bsdf \"old\": Mitsuba 3 has no {kind}")), "{error}");
    }
}

#[test]
fn rough_glass_between_equal_indices_becomes_what_mitsuba_takes() {
    let inside = r#"<float name="int_ior" value="1.2"/><float name="ext_ior" value="1.2"/>"#;
    let scene =
        loaded(&format!(r#"<shape type="cube"><bsdf type="roughdielectric">{inside}</bsdf></shape>"#));
    let (again, _) = there_and_back(&scene);
    let kind = &again.materials[0].kind;
    assert!(
        matches!(kind, crate::MaterialKind::ThinDielectric { int_ior: 1.2, ext_ior: 1.2, .. }),
        "{kind:?}"
    );
}

#[test]
fn a_mixture_becomes_blends_of_the_same_shares() {
    let part = |grey| format!(r#"<bsdf type="diffuse"><rgb name="reflectance" value="{grey}"/></bsdf>"#);
    let scene = loaded(&format!(
        r#"<shape type="cube"><bsdf type="mixturebsdf"><string name="weights" value="0.125, 0.25, 0.5"/>{}{}{}</bsdf></shape>"#,
        part(0.1),
        part(0.2),
        part(0.4)
    ));
    let (again, _) = there_and_back(&scene);
    fn add(scene: &Scene, id: crate::MaterialId, share: f32, shares: &mut Vec<(f32, f32)>) {
        match &scene.materials[id.0 as usize].kind {
            crate::MaterialKind::Blend { weight: crate::Scalar::Constant(weight), first, second } => {
                add(scene, *first, share * (1.0 - weight), shares);
                add(scene, *second, share * weight, shares);
            }
            crate::MaterialKind::Diffuse { reflectance: crate::Color::Constant([grey, ..]) } => {
                shares.push((*grey, share))
            }
            other => panic!("{other:?}"),
        }
    }
    let mut shares = Vec::new();
    add(&again, again.shapes[0].material, 1.0, &mut shares);
    for ((grey, share), (expected_grey, expected)) in
        shares.iter().zip([(0.0, 0.125), (0.1, 0.125), (0.2, 0.25), (0.4, 0.5)])
    {
        assert!((share - expected).abs() < 1e-6 && *grey == expected_grey, "{shares:?}");
    }
    assert_eq!(shares.len(), 4);
}

#[test]
fn cameras_lights_shapes_and_textures_come_back() {
    let scene = loaded(
        r#"<integrator type="path"><integer name="max_depth" value="7"/></integrator>
        <sensor type="perspective" id="front"><float name="fov" value="33"/><string name="fov_axis" value="smaller"/>
          <float name="near_clip" value="0.5"/><float name="far_clip" value="50"/>
          <transform name="to_world"><lookat origin="1,2,3" target="0,0,0" up="0,0,1"/></transform>
          <film type="hdrfilm"><integer name="width" value="40"/><integer name="height" value="30"/>
            <integer name="crop_offset_x" value="3"/><integer name="crop_width" value="11"/><rfilter type="mitchell"/></film>
          <sampler type="multijitter"><integer name="sample_count" value="16"/></sampler></sensor>
        <shape type="sphere" id="ball"><float name="radius" value="2"/><point name="center" x="1" y="2" z="3"/>
          <transform name="to_world"><rotate x="1" angle="30"/><scale value="2"/></transform>
          <bsdf type="diffuse"><texture name="reflectance" type="checkerboard">
            <transform name="to_uv"><scale x="3" y="5"/><translate x="0.25"/></transform></texture></bsdf></shape>
        <shape type="rectangle"><transform name="to_world"><scale x="-2"/></transform><boolean name="flip_normals" value="true"/>
          <emitter type="area" id="lamp"><rgb name="radiance" value="1 2 3"/></emitter></shape>
        <emitter type="constant"><rgb name="radiance" value="0.5 0.25 0.125"/></emitter>"#,
    );
    let (again, exported) = there_and_back(&scene);
    let warnings: Vec<&Warning> = again.warnings.iter().collect();
    assert!(warnings.is_empty(), "{warnings:?}\n{}", exported.xml);
    assert_eq!(again.integrator, scene.integrator);
    let (a, b) = (&again.cameras[0], &scene.cameras[0]);
    assert_eq!((&a.name, &a.projection, &a.film, &a.sampler), (&b.name, &b.projection, &b.film, &b.sampler));
    assert_eq!((a.near_clip, a.far_clip), (b.near_clip, b.far_clip));
    assert!(a.world_from_camera.abs_diff_eq(b.world_from_camera, 1e-12));
    // The sphere's scale went into its radius.
    let ball = |scene: &Scene| match scene.shapes[0].kind {
        crate::ShapeKind::Sphere { center, radius } => {
            let to_world = scene.shapes[0].world_from_object;
            let scale = glam::DMat3::from_mat4(to_world).determinant().cbrt();
            (to_world.transform_point3(center), radius * scale)
        }
        ref other => panic!("{other:?}"),
    };
    let ((center_a, radius_a), (center_b, radius_b)) = (ball(&again), ball(&scene));
    assert!(center_a.abs_diff_eq(center_b, 1e-12) && (radius_a - radius_b).abs() < 1e-12);
    assert_eq!(again.textures[0].uv_from_surface, scene.textures[0].uv_from_surface);
    let lamp = |scene: &Scene| {
        let shape = &scene.shapes[1];
        let emission = shape.emission.clone().expect("a lamp");
        (shape.world_from_object, shape.flip_normals, emission.name, emission.radiance)
    };
    assert_eq!(lamp(&again), lamp(&scene));
    assert!(matches!(again.lights[0].kind, crate::LightKind::Constant { radiance: [0.5, 0.25, 0.125] }));
}

#[test]
fn meshes_and_pictures_keep_their_bits_and_are_written_once() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.xml");
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0.1\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1\n";
    fs::write(folder.path().join("a.obj"), obj).unwrap();
    fs::write(folder.path().join("flat.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0.1\nf 1 2 3\n").unwrap();
    let bytes: Vec<u8> = (0..2 * 3 * 3).map(|i| i as u8 * 14).collect();
    ::image::save_buffer(folder.path().join("t.png"), &bytes, 2, 3, ::image::ColorType::Rgb8).unwrap();
    let texture =
        r#"<texture name="reflectance" type="bitmap"><string name="filename" value="t.png"/></texture>"#;
    let shape = |file: &str, more: &str| {
        format!(
            r#"<shape type="obj"><string name="filename" value="{file}"/>{more}<bsdf type="diffuse">{texture}</bsdf></shape>"#
        )
    };
    let mirrored = r#"<transform name="to_world"><scale x="-1"/></transform>"#;
    let flat = r#"<boolean name="face_normals" value="true"/>"#;
    let xml = format!(
        "<scene version=\"3.0.0\"><sensor type=\"perspective\"/>{}{}{}{}</scene>",
        shape("a.obj", ""),
        shape("a.obj", mirrored),
        shape("flat.obj", flat),
        shape("flat.obj", &format!("{flat}{mirrored}"))
    );
    fs::write(&path, xml).unwrap();
    let scene = load(&path, &LoadOptions::default()).unwrap();
    let (again, exported) = there_and_back(&scene);
    let mesh = |scene: &Scene, i: usize| match &scene.shapes[i].kind {
        crate::ShapeKind::Mesh(mesh) => mesh.as_ref().clone(),
        other => panic!("{other:?}"),
    };
    for i in 0..3 {
        assert_eq!(mesh(&again, i), mesh(&scene, i), "{i}");
    }
    // Flat faces in a mirror run the other way round for Mitsuba.
    let [a, b, c] = mesh(&scene, 3).triangles[0];
    assert_eq!(mesh(&again, 3).triangles, [[a, c, b]]);
    assert_eq!(exported.xml.matches("mesh_0000.ply").count(), 2, "{}", exported.xml);
    let crate::TextureKind::Bitmap { image, .. } = &again.textures[0].kind else { panic!() };
    assert_eq!(image.texels, crate::Texels::Srgb8(bytes));
}

#[test]
fn an_ellipsoid_is_a_mesh_with_a_note() {
    let scene =
        loaded(r#"<shape type="sphere"><transform name="to_world"><scale x="2"/></transform></shape>"#);
    let (again, exported) = there_and_back(&scene);
    assert!(exported.notes[0].contains("ellipsoid"), "{:?}", exported.notes);
    let crate::ShapeKind::Mesh(mesh) = &again.shapes[0].kind else { panic!() };
    assert_eq!(mesh.triangles.len(), 2 * 512 * 255);
}

#[test]
fn a_medium_is_refused_with_its_place() {
    let scene = loaded(r#"<shape type="cube"><medium name="interior" type="homogeneous" id="fog"/></shape>"#);
    let error = export_mitsuba(&scene, "files", &mut |_, _| Ok(())).unwrap_err().to_string();
    assert!(error.contains("medium \"fog\": participating media"), "{error}");
}

#[test]
fn lights_and_cameras_come_back_as_they_were() {
    let scene = loaded(
        r#"<integrator type="aov"><string name="aovs" value="a:albedo,d:depth"/><integrator type="path"/></integrator>
        <sensor type="thinlens"><float name="aperture_radius" value="0.25"/><float name="focus_distance" value="3"/>
            <film type="hdrfilm"><string name="pixel_format" value="rgba"/></film></sensor>
        <sensor type="orthographic"><transform name="to_world"><scale x="10" y="5"/></transform></sensor>
        <emitter type="point"><rgb name="intensity" value="1 2 3"/><point name="position" value="4 5 6"/></emitter>
        <emitter type="spot"><float name="cutoff_angle" value="35"/><float name="beam_width" value="5"/>
            <texture type="checkerboard" name="texture"/><transform name="to_world"><translate x="1"/></transform></emitter>
        <emitter type="directional"><vector name="direction" value="0 -1 0"/><rgb name="irradiance" value="0.5"/></emitter>
        <emitter type="projector"><float name="fov" value="40"/><float name="scale" value="2"/>
            <texture type="checkerboard" name="irradiance"/></emitter>
        <emitter type="sunsky"/>"#,
    );
    let (again, exported) = there_and_back(&scene);
    assert_eq!(again.integrator, scene.integrator);
    for (a, b) in again.cameras.iter().zip(&scene.cameras) {
        assert_eq!((&a.projection, &a.lens, a.film.alpha), (&b.projection, &b.lens, b.film.alpha));
    }
    assert_eq!((again.cameras.len(), again.lights.len()), (2, 6));
    let shown = |scene: &Scene, i: usize| {
        let text = format!("{:?}", scene.lights[i].kind);
        without_ids(&text)
    };
    for i in 0..3 {
        assert_eq!(shown(&again, i), shown(&scene, i));
    }
    let half = |scene: &Scene| match scene.lights[3].kind {
        crate::LightKind::Projector { half_size: [x, y], scale, .. } => [x, y, f64::from(scale)],
        ref other => panic!("{other:?}"),
    };
    assert!(half(&again).iter().zip(half(&scene)).all(|(a, b)| (a - b).abs() < 1e-12));
    // Sky and sun become one emitter, and that two lights again.
    for i in 4..6 {
        let (ours, theirs) = (day(&again, i), day(&scene, i));
        assert!(ours.0.sun.abs_diff_eq(theirs.0.sun, 1e-9) && (ours.1 - theirs.1).abs() < 1e-9, "{ours:?}");
    }
    assert!(exported.notes.is_empty(), "{exported:?}");
}

/// The day of a light, and its sun's width.
fn day(scene: &Scene, light: usize) -> (crate::Daylight, f64) {
    match scene.lights[light].kind {
        crate::LightKind::Sky { daylight, .. } => (daylight, 0.0),
        crate::LightKind::Sun { daylight, half_deg, .. } => (daylight, half_deg),
        ref other => panic!("{other:?}"),
    }
}

/// Mitsuba 3.9.1 looks up directions as long as the scale makes them (`docs/mitsuba.md`).
#[test]
fn what_surrounds_a_scene_is_exported_without_its_scale() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("sky.png");
    ::image::save_buffer(&picture, &[10, 20, 30, 40, 50, 60], 2, 1, ::image::ColorType::Rgb8).unwrap();
    let turn = r#"<rotate x="0.6" z="0.8" angle="50"/>"#;
    let exported = |kind: &str, operations: &str| {
        let scene = loaded(&format!(
            r#"<emitter type="{kind}"><string name="filename" value="{}"/><vector name="sun_direction" value="1 2 3"/>
            <transform name="to_world">{turn}{operations}</transform></emitter>"#,
            picture.display()
        ));
        let (again, exported) = there_and_back(&scene);
        let frame = match again.lights[0].kind {
            crate::LightKind::EnvMap { world_from_light, .. } => world_from_light,
            _ => day(&again, 0).0.world_from_light,
        };
        let towards =
            frame.transform_vector3(if kind == "sunsky" { day(&again, 0).0.sun } else { glam::DVec3::Y });
        (frame, towards.normalize(), exported.notes)
    };
    for kind in ["envmap", "sunsky"] {
        let (frame, towards, notes) = exported(kind, "");
        assert!(notes.is_empty(), "{notes:?}");
        for (operations, mirror) in [
            (r#"<scale value="3"/>"#, glam::DVec3::ONE),
            (r#"<scale value="1e-5"/>"#, glam::DVec3::ONE),
            (r#"<scale x="-2" y="2" z="2"/><translate x="5"/>"#, glam::DVec3::new(-1.0, 1.0, 1.0)),
        ] {
            let (turned, to, notes) = exported(kind, operations);
            let expected = glam::DMat4::from_scale(mirror) * frame;
            assert!(turned.abs_diff_eq(expected, 1e-12), "{kind} {operations}: {turned} {expected}");
            let expected = if kind == "sunsky" { towards } else { mirror * towards };
            assert!(
                to.abs_diff_eq(expected, 1e-9) && notes.is_empty(),
                "{kind} {operations}: {to} {notes:?}"
            );
        }
        let (uneven, to, notes) = exported(kind, r#"<scale x="3"/>"#);
        let linear = glam::DMat3::from_mat4(uneven);
        assert!((linear * linear.transpose()).abs_diff_eq(glam::DMat3::IDENTITY, 1e-12), "{uneven}");
        assert!(kind == "envmap" || to.abs_diff_eq(towards, 1e-9), "{to} {towards}");
        assert!(notes.len() == 1 && notes[0].contains("a scale that differs by direction"), "{notes:?}");
    }
}

#[test]
fn suns_stay_suns_unless_something_else_surrounds_the_scene() {
    let sun = r#"<emitter type="sunsky"><float name="sky_scale" value="0"/><float name="sun_aperture" value="3"/></emitter>"#;
    let (alone, exported) = there_and_back(&loaded(sun));
    assert!((day(&alone, 0).1 - 1.5).abs() < 1e-9 && exported.notes.is_empty(), "{exported:?}");

    let sun =
        r#"<emitter type="constant"/><emitter type="sun"><float name="sun_aperture" value="3"/></emitter>"#;
    let (beside, exported) = there_and_back(&loaded(sun));
    let crate::LightKind::Directional { direction, irradiance } = beside.lights[1].kind else {
        panic!("{:?}", beside.lights)
    };
    let day = day(&alone, 0).0;
    let towards = day.world_from_light.transform_vector3(day.sun);
    assert!(direction.abs_diff_eq(-towards, 1e-9) && exported.notes[0].contains("sun 2"), "{exported:?}");
    let truth =
        day.sun(1.5).map(|l| f64::from(l) * std::f64::consts::PI * 1.5_f64.to_radians().sin().powi(2));
    assert!((f64::from(irradiance[0]) / truth[0] - 1.0).abs() < 1e-5, "{irradiance:?} {truth:?}");
}

#[test]
fn groups_cylinders_and_attributes_come_back_as_they_were() {
    let folder = tempfile::tempdir().unwrap();
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        property float color_0\nproperty float color_1\nproperty float color_2\nelement face 1\n\
        property list uchar int vertex_indices\nproperty float w_0\nend_header\n0 0 0 1 0 0\n1 0 0 0 1 0\n0 1 0 0 0 1\n3 0 1 2 7\n";
    fs::write(folder.path().join("m.ply"), ply).unwrap();
    let scene = r#"<scene version="3.0.0"><sensor type="perspective"/>
<shape type="shapegroup" id="g"><shape type="ply"><string name="filename" value="m.ply"/><bsdf type="diffuse">
    <texture type="scale" name="reflectance"><float name="scale" value="0.5"/>
    <texture type="mesh_attribute"><string name="name" value="vertex_color"/></texture></texture></bsdf></shape></shape>
<shape type="instance"><ref id="g"/><transform name="to_world"><translate x="2"/></transform></shape>
<shape type="cylinder"><point name="p0" x="1"/><point name="p1" x="2"/><float name="radius" value="3"/></shape></scene>"#;
    fs::write(folder.path().join("scene.xml"), scene).unwrap();
    let scene = load(&folder.path().join("scene.xml"), &LoadOptions::default()).unwrap();
    let (again, exported) = there_and_back(&scene);
    assert!(
        exported.notes.is_empty() && again.warnings.is_empty(),
        "{:?} {:?}",
        exported.notes,
        again.warnings
    );
    let kinds = |scene: &Scene| {
        let ShapeKind::Mesh(mesh) = &scene.groups[0].shapes[0].kind else { unreachable!("it is a mesh") };
        format!("{:?} {:?} {:?}", mesh.attributes, scene.shapes[0].kind, scene.shapes[1].kind)
    };
    assert_eq!(kinds(&again), kinds(&scene));
    assert_eq!(again.shapes[0].world_from_object, scene.shapes[0].world_from_object);
    let attribute = again.textures.iter().map(|texture| format!("{:?}", texture.kind)).collect::<String>();
    assert_eq!(attribute, r#"MeshAttribute { name: "vertex_color", scale: 0.5 }"#);
}
