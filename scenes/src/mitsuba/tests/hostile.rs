//! Input made to break readers: it must end soon, and never in a panic.

use std::fmt::Write;
use std::fs;
use std::time::{Duration, Instant};

use super::{loaded, scene, try_load};
use crate::testing::mutations;
use crate::{LoadOptions, load, load_str};

/// Something of everything.
const ALL: &str = r##"<scene version="0.6.0"><default name="r" value="2"/><alias id="red" as="rot"/>
<integrator type="path"><integer name="maxDepth" value="5"/></integrator>
<sensor type="perspective"><float name="fov" value="40"/><string name="fovAxis" value="y"/>
 <transform name="toWorld"><lookat origin="1, 2, 3" target="0 0 0" up="0 1 0"/><scale x="2"/></transform>
 <sampler type="independent"><integer name="sampleCount" value="4"/></sampler>
 <film type="hdrfilm"><integer name="width" value="8"/><integer name="cropWidth" value="2"/><rfilter type="tent"/></film></sensor>
<bsdf type="twosided" id="red"><bsdf type="diffuse"><rgb name="reflectance" value="#ff8000"/></bsdf></bsdf>
<bsdf type="roughconductor" id="m"><string name="material" value="Cu"/><float name="alpha" value="0.2"/></bsdf>
<texture type="checkerboard" id="t"><spectrum name="color0" value="400:0.1, 500:0.3"/><float name="uscale" value="3"/></texture>
<shape type="sphere" id="s"><float name="radius" value="$r"/><point name="center" x="1" y="2" z="3"/><ref id="rot"/>
 <emitter type="area"><blackbody name="radiance" temperature="3000"/></emitter></shape>
<shape type="cube"><transform name="toWorld"><matrix value="1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"/><rotate y="1" angle="9"/></transform>
 <bsdf type="plastic"><ref name="diffuseReflectance" id="t"/><boolean name="nonlinear" value="true"/></bsdf></shape>
<emitter type="constant"><srgb name="radiance" value="1 .5 0"/></emitter></scene>"##;

#[test]
fn mutated_scenes_load_or_fail_but_never_panic() {
    let options = LoadOptions::default();
    let warnings = load_str(ALL, "".as_ref(), &options).unwrap().warnings;
    assert!(warnings.iter().all(|w| w.message.starts_with("Mitsuba 3 refuses")), "{warnings:?}");
    let start = Instant::now();
    let mut good = 0;
    for text in mutations(ALL.as_bytes(), 10_000) {
        let text = String::from_utf8_lossy(&text);
        good += usize::from(load_str(&text, "".as_ref(), &options).is_ok());
    }
    println!("{good} of 10000 mutated scenes load, in {:?}", start.elapsed());
    assert!((100..9_900).contains(&good), "{good}: the mutations are too wild or too tame");
    assert!(start.elapsed() < Duration::from_secs(60));
}

/// Each takes the parser or the reader to its limits; a quadratic step in any would not end within the minute.
#[test]
fn large_and_deep_scenes_end_soon() {
    let n = 100_000;
    let start = Instant::now();
    let numbered =
        |pattern: &dyn Fn(usize) -> String| (0..n).fold(String::new(), |text, i| text + &pattern(i));
    let refused = [
        "<a>".repeat(n),
        "<shape>".repeat(n) + &"</shape>".repeat(n),
        format!("<a{}/>", numbered(&|i| format!(" a{i}=''"))),
        "<a xmlns:b='c'>".repeat(n),
        "<".repeat(n),
        "<!--".repeat(n),
        "&lt;<".repeat(n),
        // materials that refer on and on
        numbered(&|i| format!("<bsdf type='twosided' id='b{i}'><ref id='b{}'/></bsdf>", i + 1)),
    ];
    for elements in &refused {
        assert!(try_load(elements).is_err(), "{}…", &elements[..40]);
    }
    let accepted = [
        "&#65;<medium type='x'/>".repeat(n),
        format!("<shape type='cube'>{}</shape>", "<float name='x' value='1'/>".repeat(n)),
        numbered(&|i| format!("<alias id='a{i}' as='a{}'/>", i + 1)) + "<bsdf type='diffuse' id='x'/>",
        format!("<spectrum name='x' value='{}'/>", numbered(&|i| format!("{i}:1 "))),
        "<shape type='sphere'/>".repeat(n),
    ];
    for elements in &accepted {
        loaded(elements);
    }
    assert!(start.elapsed() < Duration::from_secs(60), "{:?}", start.elapsed());
}

#[test]
fn includes_and_parameters_that_multiply_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    for i in 0..12 {
        let include = format!(r#"<include filename="{}.xml"/>"#, i + 1);
        fs::write(folder.path().join(format!("{i}.xml")), scene(&include.repeat(10))).unwrap();
    }
    fs::write(folder.path().join("12.xml"), scene("")).unwrap();
    let error = load(&folder.path().join("0.xml"), &LoadOptions::default()).unwrap_err();
    assert!(error.problem.contains("more than 4096 includes"), "{error}");

    let mut doubling = String::from(r#"<default name="p0" value="xxxxxxxxxxxxxxxx"/>"#);
    for i in 0..40 {
        write!(doubling, r#"<default name="p{}" value="$p{i} $p{i}"/>"#, i + 1).unwrap();
    }
    assert!(try_load(&doubling).unwrap_err().problem.contains("expand to more than"));
}
