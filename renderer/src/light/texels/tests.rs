use std::sync::Arc;

use glam::{DMat3, Vec2};
use limpid_scenes::{
    Image, Place, Scene, TexelFilter, Texels as Values, Texture, TextureId, TextureKind, WrapMode,
};
use limpid_testkit::assert_chi2_2d;

use super::*;

fn picture(
    width: u32,
    height: u32,
    filter: TexelFilter,
    value: impl Fn(usize) -> f32,
    map: DMat3,
) -> Textures {
    let texels = (0..(width * height) as usize).flat_map(|i| [value(i); 3]).collect();
    let image = Arc::new(Image { width, height, texels: Values::Linear32(texels) });
    let kind = TextureKind::Bitmap { image, filter, wrap: WrapMode::Repeat };
    let texture = Texture { name: "t".into(), kind, uv_from_surface: map, place: Place::default() };
    Textures::prepare(&Scene { textures: vec![texture], ..Scene::default() })
}

const COLOR: Color = Color::Texture(TextureId(0));

#[test]
fn draws_follow_their_density() {
    let turned = DMat3::from_angle(0.7) * DMat3::from_scale(glam::DVec2::new(2.0, 0.4));
    for (filter, map) in [
        (TexelFilter::Nearest, DMat3::IDENTITY),
        (TexelFilter::Bilinear, DMat3::IDENTITY),
        (TexelFilter::Bilinear, turned),
    ] {
        let textures = picture(5, 3, filter, |i| ((i * 7919) % 13) as f32, map);
        let texels = Texels::new(COLOR, &textures).unwrap();
        let draw = |u: Vec2| Some(texels.sample(u.as_dvec2()).as_vec2());
        assert_chi2_2d(draw, |uv| texels.density(uv), Vec2::ZERO, Vec2::ONE);
    }
}

#[test]
fn cells_are_texels_and_hold_what_they_emit() {
    let textures = picture(4, 2, TexelFilter::Nearest, |i| i as f32, DMat3::IDENTITY);
    let texels = Texels::new(COLOR, &textures).unwrap();
    assert!(texels.size == [4, 2] && (texels.mean() - 3.5).abs() < 1e-6);
    for i in 0..8 {
        let uv = Vec2::new(((i % 4) as f32 + 0.3) / 4.0, ((i / 4) as f32 + 0.9) / 2.0);
        let truth = (f64::from(i) + FLOOR * 3.5) / (3.5 * (1.0 + FLOOR));
        assert!((texels.density(uv) - truth).abs() < 1e-6, "{i}: {} {truth}", texels.density(uv));
    }
}

#[test]
fn one_lit_texel_gets_nearly_all_draws() {
    let textures =
        picture(64, 64, TexelFilter::Nearest, |i| if i == 999 { 5.0 } else { 0.0 }, DMat3::IDENTITY);
    let texels = Texels::new(COLOR, &textures).unwrap();
    let lit = Vec2::new((999 % 64) as f32 + 0.5, (999 / 64) as f32 + 0.5) / 64.0;
    assert!(texels.density(lit) / 4096.0 > 0.95, "{}", texels.density(lit));
    assert!(texels.density(Vec2::ZERO) > 0.04, "{}", texels.density(Vec2::ZERO));
}

#[test]
fn bad_texels_and_constants_do_no_harm() {
    let bad = |i: usize| [f32::NAN, f32::INFINITY, -3.0, 2.0][i % 4];
    let textures = picture(4, 4, TexelFilter::Nearest, bad, DMat3::IDENTITY);
    let texels = Texels::new(COLOR, &textures).unwrap();
    assert!((texels.mean() - 0.5).abs() < 1e-6);
    assert!((0..16).all(|i| texels.density(Vec2::new((i % 4) as f32, (i / 4) as f32) / 4.0) > 0.0));
    assert!(Texels::new(Color::Constant([1.0; 3]), &textures).is_none());
    let black = picture(4, 4, TexelFilter::Nearest, |_| 0.0, DMat3::IDENTITY);
    assert!(Texels::new(COLOR, &black).is_none());
    // Too fine to be looked at as a whole: it must end soon all the same.
    let fine = picture(2, 2, TexelFilter::Nearest, |i| i as f32, DMat3::from_scale(glam::DVec2::splat(1e30)));
    assert!(Texels::new(COLOR, &fine).is_none_or(|t| t.size == [1024, 1024]));
}
