//! Plugins: defaults and parameters.

use std::fs;
use std::sync::Arc;

use glam::{DMat3, DVec3};

use super::{loaded, scene, try_load};
use crate::{
    Aov, Color, Crop, FovAxis, LightKind, LoadOptions, PixelFilter, Projection, Scene, ShapeKind,
    TexelFilter, Texels, TextureKind, WrapMode, load,
};

#[test]
fn cameras_have_the_defaults_and_angles_of_mitsuba() {
    let camera =
        |inside: &str| loaded(&format!(r#"<sensor type="perspective">{inside}</sensor>"#)).cameras.remove(0);
    let plain = camera("");
    let Projection::Perspective { fov_deg, fov_axis, principal_point_offset } = plain.projection else {
        panic!("{:?}", plain.projection)
    };
    // 50 mm before 36 x 24 mm: x_fov is 42.3117 for a film of 2:1, says Mitsuba 3.9.1
    assert_eq!((fov_axis, principal_point_offset), (FovAxis::Diagonal, [0.0; 2]));
    let x = 2.0 * ((0.5 * fov_deg.to_radians()).tan() * 2.0 / 5f64.sqrt()).atan().to_degrees();
    assert!((x - 42.311714).abs() < 1e-5, "{x}");
    assert_eq!((plain.film.width, plain.film.height, plain.film.crop), (768, 576, None));
    assert_eq!(plain.film.filter, PixelFilter::Gaussian { stddev: 0.5 });
    assert_eq!((plain.near_clip, plain.far_clip), (None, None));
    assert_eq!((plain.name.as_str(), plain.sampler.sample_count), ("camera 1", 4));

    let given = camera(
        r#"<float name="fov" value="40"/><string name="fov_axis" value="smaller"/><float name="far_clip" value="9"/>
        <float name="principal_point_offset_y" value="-0.25"/><sampler type="ldsampler"><integer name="sample_count" value="64"/></sampler>
        <film type="hdrfilm"><integer name="width" value="40"/><integer name="height" value="30"/>
            <integer name="crop_width" value="8"/><integer name="crop_offset_x" value="32"/><rfilter type="tent"/></film>"#,
    );
    let expected = Projection::Perspective {
        fov_deg: 40.0,
        fov_axis: FovAxis::Smaller,
        principal_point_offset: [0.0, -0.25],
    };
    assert_eq!(given.projection, expected);
    assert_eq!(given.film.crop, Some(Crop { x: 32, y: 0, width: 8, height: 30 }));
    assert_eq!(given.film.filter, PixelFilter::Tent { radius: 1.0 });
    assert_eq!((given.far_clip, given.sampler.sample_count), (Some(9.0), 64));
}

#[test]
fn all_pixel_filters_are_read() {
    let third = 1.0 / 3.0;
    for (element, filter) in [
        (r#"<rfilter type="box"/>"#, PixelFilter::Box),
        (
            r#"<rfilter type="tent"><float name="radius" value="2"/></rfilter>"#,
            PixelFilter::Tent { radius: 2.0 },
        ),
        (
            r#"<rfilter type="gaussian"><float name="stddev" value="0.7"/></rfilter>"#,
            PixelFilter::Gaussian { stddev: 0.7 },
        ),
        (r#"<rfilter type="mitchell"/>"#, PixelFilter::Mitchell { b: third, c: third }),
        (r#"<rfilter type="catmullrom"/>"#, PixelFilter::CatmullRom),
        (
            r#"<rfilter type="lanczos"><integer name="lobes" value="2"/></rfilter>"#,
            PixelFilter::Lanczos { lobes: 2.0 },
        ),
    ] {
        let scene =
            loaded(&format!(r#"<sensor type="perspective"><film type="hdrfilm">{element}</film></sensor>"#));
        assert_eq!(scene.cameras[0].film.filter, filter);
        assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    }
}

#[test]
fn integrators_keep_their_depth_whatever_they_are() {
    let integrator = |element: &str| {
        let scene = loaded(element);
        let notes = scene.warnings.len() - 1; // one is about the camera
        (scene.integrator, notes)
    };
    let (path, notes) = integrator(
        r#"<integrator type="path"><integer name="max_depth" value="-1"/><integer name="rr_depth" value="9"/><boolean name="hide_emitters" value="true"/></integrator>"#,
    );
    assert_eq!((path.max_depth, path.rr_depth, path.hide_emitters, notes), (None, 9, true, 0));
    let (direct, notes) =
        integrator(r#"<integrator type="direct"><integer name="emitter_samples" value="4"/></integrator>"#);
    assert_eq!((direct.max_depth, notes), (Some(2), 0));
    let (other, notes) = integrator(
        r#"<integrator type="bdpt"><integer name="max_depth" value="7"/><float name="x" value="1"/></integrator>"#,
    );
    assert_eq!((other.kind.as_str(), other.max_depth, notes), ("bdpt", Some(7), 1));
    let (inner, notes) = integrator(
        r#"<integrator type="aov"><string name="aovs" value="dd.y:depth"/><integrator name="image" type="path"><integer name="max_depth" value="3"/></integrator></integrator>"#,
    );
    assert_eq!((inner.kind.as_str(), inner.max_depth, notes), ("path", Some(3), 0));
    assert_eq!(inner.aovs, [Aov::Depth]);
    let (several, notes) = integrator(
        r#"<integrator type="aov"><string name="aovs" value="a:albedo, nn:sh_normal,pp:position,s:shape_index, b:albedo,u:uv,x:what"/><integrator type="direct"/></integrator>"#,
    );
    assert_eq!(several.aovs, [Aov::Albedo, Aov::ShadingNormal, Aov::Position, Aov::ShapeIndex]);
    assert_eq!((several.max_depth, notes), (Some(2), 1));
    assert_eq!(integrator("").0, crate::Integrator::default());
}

#[test]
fn cylinders_have_mitsuba_defaults_and_a_length() {
    let scene = loaded(
        r#"<shape type="cylinder"/><shape type="cylinder"><float name="radius" value="2"/>
<point name="p0" x="1"/><point name="p1" x="1" y="3"/></shape>"#,
    );
    let cylinder = |i: usize| match scene.shapes[i].kind {
        ShapeKind::Cylinder { p0, p1, radius } => (p0, p1, radius),
        _ => unreachable!("both are cylinders"),
    };
    assert_eq!(cylinder(0), (DVec3::ZERO, DVec3::Z, 1.0));
    assert_eq!(cylinder(1), (DVec3::X, DVec3::new(1.0, 3.0, 0.0), 2.0));
    let error =
        try_load(r#"<shape type="cylinder"><point name="p0" z="1"/></shape>"#).unwrap_err().to_string();
    assert!(error.contains("p0 and p1 are the same point"), "{error}");
}

#[test]
fn shapes_have_their_place_names_and_media() {
    let scene = loaded(
        r#"
<shape type="sphere" id="ball"><float name="radius" value="2"/><point name="center" x="1" z="3"/>
    <boolean name="flip_normals" value="true"/><medium type="homogeneous" name="interior"><rgb name="albedo" value="1"/></medium></shape>
<shape type="disk"/><shape type="rectangle"><transform name="to_world"><scale x="2" y="3" z="0"/></transform></shape>"#,
    );
    assert!(
        matches!(scene.shapes[0].kind, ShapeKind::Sphere { radius: 2.0, center } if center == DVec3::new(1.0, 0.0, 3.0))
    );
    let names: Vec<_> = scene.shapes.iter().map(|s| (s.name.as_str(), s.place.line)).collect();
    assert_eq!(names, [("ball", 2), ("disk 2", 4), ("rectangle 3", 4)]);
    assert!(scene.shapes[0].flip_normals);
    assert_eq!(scene.media[scene.shapes[0].interior.unwrap().0 as usize].kind, "homogeneous");
    // a rectangle without thickness has an inverse all the same
    assert!(scene.shapes[2].world_from_object.determinant() != 0.0);
}

/// Writes files beside a scene, and loads it.
fn load_with(files: &[(&str, &[u8])], elements: &str) -> Scene {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in files {
        fs::write(folder.path().join(name), bytes).unwrap();
    }
    let path = folder.path().join("scene.xml");
    fs::write(&path, scene(elements)).unwrap();
    load(&path, &LoadOptions::default()).unwrap()
}

#[test]
fn shapes_of_one_file_share_their_mesh_and_textures_their_image() {
    let obj = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let ppm = png(&[[10, 20, 30]], 1);
    let shape =
        |more: &str| format!(r#"<shape type="obj"><string name="filename" value="m.obj"/>{more}</shape>"#);
    let bitmap = |more: &str| {
        format!(r#"<texture type="bitmap"><string name="filename" value="t.png"/>{more}</texture>"#)
    };
    let flat = r#"<boolean name="face_normals" value="true"/>"#;
    let raw = r#"<boolean name="raw" value="true"/><string name="wrap_mode" value="mirror"/><string name="filter_type" value="nearest"/>"#;
    let elements = [
        shape(""),
        shape("<transform name=\"to_world\"/>"),
        shape(flat),
        bitmap(""),
        bitmap(""),
        bitmap(raw),
    ]
    .concat();
    let scene = load_with(&[("m.obj", obj), ("t.png", &ppm)], &elements);
    let mesh = |i: usize| match &scene.shapes[i].kind {
        ShapeKind::Mesh(mesh) => Arc::clone(mesh),
        other => panic!("{other:?}"),
    };
    assert!(Arc::ptr_eq(&mesh(0), &mesh(1)));
    assert_eq!(mesh(0).normals, [[0.0, 0.0, 1.0]; 3]);
    assert!(mesh(2).normals.is_empty());
    let texture = |i: usize| match &scene.textures[i].kind {
        TextureKind::Bitmap { image, filter, wrap } => (Arc::clone(image), *filter, *wrap),
        other => panic!("{other:?}"),
    };
    let [first, second, third] = [0, 1, 2].map(texture);
    assert!(Arc::ptr_eq(&first.0, &second.0));
    assert_eq!(first.0.texels, Texels::Srgb8(vec![10, 20, 30]));
    assert_eq!((first.1, first.2), (TexelFilter::Bilinear, WrapMode::Repeat));
    assert_eq!(third.0.texels, Texels::Linear8(vec![10, 20, 30]));
    assert_eq!((third.1, third.2), (TexelFilter::Nearest, WrapMode::Mirror));
}

/// The texel columns that Mitsuba 3.9.1 looked up with these `to_uv`, for u = 0.1 in a picture four wide.
#[test]
fn texture_transforms_act_on_uv() {
    let u = |operations: &str| {
        let scene = loaded(&format!(
            r#"<texture type="checkerboard"><transform name="to_uv">{operations}</transform></texture>"#
        ));
        (scene.textures[0].uv_from_surface * DVec3::new(0.1, 0.3, 1.0)).x
    };
    for (operations, column) in [
        (r#"<scale x="2" y="2"/>"#, 0),
        (r#"<translate x="0.5"/>"#, 2),
        (r#"<translate x="0.5"/><scale x="0.5"/>"#, 1),
        (r#"<scale x="0.5"/><translate x="0.5"/>"#, 2),
        (r#"<matrix value="1 0 0.5 0 1 0 0 0 1"/>"#, 0), // the third column is z, not the translation
    ] {
        assert_eq!((4.0 * u(operations)) as i32, column, "{operations}");
    }
    assert_eq!(loaded(r#"<texture type="checkerboard"/>"#).textures[0].uv_from_surface, DMat3::IDENTITY);
}

#[test]
fn textures_may_stand_in_every_colour() {
    let checks = |name: &str| {
        format!(r#"<texture name="{name}" type="checkerboard"><float name="color0" value="1"/></texture>"#)
    };
    for (kind, names) in [
        ("diffuse", &["reflectance"][..]),
        ("conductor", &["eta", "k", "specular_reflectance"]),
        ("roughconductor", &["alpha", "alpha_u", "alpha_v", "eta", "k", "specular_reflectance"]),
        ("dielectric", &["specular_reflectance", "specular_transmittance"]),
        ("plastic", &["diffuse_reflectance", "specular_reflectance"]),
        ("roughplastic", &["diffuse_reflectance", "specular_reflectance"]),
    ] {
        for name in names {
            let scene =
                loaded(&format!(r#"<shape type="disk"><bsdf type="{kind}">{}</bsdf></shape>"#, checks(name)));
            assert_eq!(scene.warnings.len(), 1, "{kind} {name}: {:?}", scene.warnings);
            let shown = format!("{:?}", scene.materials[0].kind);
            assert!(shown.contains("Texture(TextureId(0))"), "{kind} {name}: {shown}");
        }
    }
    let lamp = loaded(&format!(
        r#"<shape type="disk"><emitter type="area" id="lamp">{}</emitter></shape>"#,
        checks("radiance")
    ));
    let emission = lamp.shapes[0].emission.as_ref().unwrap();
    assert!(matches!(emission.radiance, Color::Texture(_)) && emission.name.as_deref() == Some("lamp"));
    let nested = loaded(&format!(r#"<texture type="checkerboard">{}</texture>"#, checks("color1")));
    assert_eq!(nested.textures.len(), 2);
}

#[test]
fn backgrounds_are_lights() {
    let scene = load_with(
        &[("sky.png", &png(&[[1, 2, 3], [4, 5, 6]], 2))],
        r#"<emitter type="envmap" id="sky"><string name="filename" value="sky.png"/><float name="scale" value="2"/>
            <transform name="to_world"><rotate y="1" angle="90"/></transform></emitter>"#,
    );
    let LightKind::EnvMap { image, scale, world_from_light } = &scene.lights[0].kind else { panic!() };
    assert_eq!((image.width, image.height, *scale), (2, 1, 2.0));
    assert!(world_from_light.transform_vector3(DVec3::Z).abs_diff_eq(DVec3::X, 1e-12));
    let sky = loaded(r#"<emitter type="constant"><rgb name="radiance" value="1 2 3"/></emitter>"#);
    assert!(matches!(sky.lights[0].kind, LightKind::Constant { radiance: [1.0, 2.0, 3.0] }));
}

/// A PNG of these pixels.
fn png(pixels: &[[u8; 3]], width: u32) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let height = pixels.len() as u32 / width;
    let picture = ::image::RgbImage::from_raw(width, height, pixels.concat()).unwrap();
    picture.write_to(&mut bytes, ::image::ImageFormat::Png).unwrap();
    bytes.into_inner()
}
