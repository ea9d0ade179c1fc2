//! Hard cases of materials: rows of one table, each named after its number.

use std::path::Path;

use glam::DVec3;
use limpid_renderer::{Prepared, WorldRay};
use limpid_scenes::load_str;

/// Every model, over its parameters. A new one enters here.
const BSDFS: &[&str] = &[
    r#"<bsdf type="diffuse"/>"#,
    r#"<bsdf type="conductor"><string name="material" value="Au"/></bsdf>"#,
    r#"<bsdf type="roughconductor"><string name="distribution" value="ggx"/></bsdf>"#,
    r#"<bsdf type="roughconductor"><string name="distribution" value="ggx"/><float name="alpha" value="0.001"/></bsdf>"#,
    r#"<bsdf type="roughconductor"><string name="distribution" value="ggx"/><float name="alpha" value="1"/></bsdf>"#,
    r#"<bsdf type="roughconductor"><float name="alpha_u" value="0.5"/><float name="alpha_v" value="0.01"/></bsdf>"#,
    r#"<bsdf type="dielectric"/>"#,
    r#"<bsdf type="plastic"><boolean name="nonlinear" value="true"/></bsdf>"#,
    r#"<bsdf type="roughplastic"><string name="distribution" value="ggx"/><float name="alpha" value="0.001"/></bsdf>"#,
    r#"<bsdf type="roughplastic"><float name="alpha" value="1"/></bsdf>"#,
    r#"<bsdf type="blendbsdf"><bsdf type="diffuse"/><bsdf type="dielectric"/></bsdf>"#,
    r#"<bsdf type="mask"><bsdf type="twosided"><bsdf type="plastic"/></bsdf></bsdf>"#,
    r#"<bsdf type="normalmap"><rgb name="normalmap" value="0.7 0.4 0.9"/><bsdf type="roughconductor"/></bsdf>"#,
    r#"<bsdf type="roughdielectric"/>"#,
    r#"<bsdf type="roughdielectric"><string name="distribution" value="ggx"/><float name="alpha" value="0.001"/></bsdf>"#,
    r#"<bsdf type="roughdielectric"><float name="alpha_u" value="1"/><float name="alpha_v" value="0.01"/><float name="int_ior" value="1.0003"/></bsdf>"#,
    r#"<bsdf type="roughdielectric"><float name="int_ior" value="1"/><float name="ext_ior" value="1"/></bsdf>"#,
    r#"<bsdf type="thindielectric"/>"#,
    r#"<bsdf type="roughdiffuse"><float name="alpha" value="0.7"/></bsdf>"#,
    r#"<bsdf type="roughdiffuse"><boolean name="use_fast_approx" value="true"/></bsdf>"#,
    r#"<bsdf type="phong"/>"#,
    r#"<bsdf type="phong"><float name="exponent" value="1e8"/><rgb name="diffuse_reflectance" value="0"/></bsdf>"#,
    r#"<bsdf type="ward"/>"#,
    r#"<bsdf type="ward"><string name="variant" value="ward"/><float name="alpha_u" value="0.001"/><float name="alpha_v" value="1"/></bsdf>"#,
    r#"<bsdf type="ward"><string name="variant" value="ward-duer"/><rgb name="diffuse_reflectance" value="0"/></bsdf>"#,
    r#"<bsdf type="coating"><rgb name="sigma_a" value="0 1 9"/><bsdf type="roughconductor"/></bsdf>"#,
    r#"<bsdf type="roughcoating"><float name="alpha" value="0.001"/><bsdf type="twosided"><bsdf type="plastic"/></bsdf></bsdf>"#,
    r#"<bsdf type="principled"/>"#,
    r#"<bsdf type="principled"><float name="metallic" value="1"/><float name="roughness" value="0"/></bsdf>"#,
    r#"<bsdf type="principled"><float name="metallic" value="0.5"/><float name="roughness" value="1"/><float name="anisotropic" value="1"/><float name="clearcoat" value="1"/><float name="clearcoat_gloss" value="1"/></bsdf>"#,
    r#"<bsdf type="principled"><float name="spec_trans" value="1"/><float name="roughness" value="0"/></bsdf>"#,
    r#"<bsdf type="principled"><float name="spec_trans" value="0.5"/><float name="specular" value="0"/><float name="sheen" value="1"/><float name="sheen_tint" value="1"/><float name="flatness" value="1"/><float name="spec_tint" value="1"/></bsdf>"#,
    r#"<bsdf type="principledthin"/>"#,
    r#"<bsdf type="principledthin"><float name="spec_trans" value="1"/><float name="roughness" value="0"/></bsdf>"#,
    r#"<bsdf type="principledthin"><float name="spec_trans" value="0.5"/><float name="diff_trans" value="1"/><float name="sheen" value="1"/><float name="flatness" value="1"/></bsdf>"#,
    r#"<bsdf type="twosided"><bsdf type="principled"><float name="clearcoat" value="1"/></bsdf></bsdf>"#,
    r#"<bsdf type="twosided"><bsdf type="roughconductor"><string name="distribution" value="ggx"/></bsdf></bsdf>"#,
];

/// The corners of the cube that draws come from, and the nearest to 1.
const DRAWS: [f32; 6] =
    [0.0, 1.0 / (1 << 23) as f32, 0.25, 0.5, 1.0 - 1.0 / (1 << 23) as f32, 1.0f32.next_down()];

#[test]
fn hc66_uniform_draw_equals_one() {
    for bsdf in BSDFS {
        let xml = format!(
            r#"<scene version="3.0.0"><sensor type="perspective"/><shape type="rectangle">{bsdf}</shape></scene>"#
        );
        let scene = load_str(&xml, Path::new("."), &Default::default()).expect("a sound scene");
        // what Mitsuba 3 lacks is here as well
        let all_read = scene.warnings.iter().all(|warning| warning.message.starts_with("Mitsuba 3 refuses"));
        assert!(all_read, "{:?}", scene.warnings);
        let prepared = Prepared::new(&scene, 0).expect("a sound scene");
        let mut scattered = 0;
        for cos in [1.0, 0.5, 0.01, 1e-6] {
            for side in [1.0, -1.0] {
                let sin = f64::sqrt(1.0 - cos * cos);
                let wo = DVec3::new(0.8 * sin, 0.6 * sin, side * cos);
                let ray = WorldRay { o: 0.125 * wo, d: -wo };
                for u in DRAWS
                    .iter()
                    .flat_map(|&a| DRAWS.map(|b| (a, b)))
                    .flat_map(|(a, b)| DRAWS.map(|c| [a, b, c]))
                {
                    let Some(s) = prepared.scatter(ray, u) else { continue };
                    scattered += 1;
                    let sound = s.wi.is_finite()
                        && (s.wi.length() - 1.0).abs() < 1e-5
                        && s.weight.iter().all(|w| w.is_finite() && *w >= 0.0)
                        && s.pdf.is_finite()
                        && s.pdf >= 0.0;
                    assert!(sound, "{bsdf}: cos {cos}, draw {u:?}: {s:?}");
                }
            }
        }
        assert!(scattered > 0, "{bsdf}: never hit, so nothing was tested");
    }
}
