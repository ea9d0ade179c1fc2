//! The dials of Burley's models at a hit.

use glam::Vec2;
use limpid_scenes::{Principled, PrincipledThin, Scalar};

use crate::bsdf::{self, Bsdf, PrincipledDials, PrincipledThinDials};
use crate::texture::Textures;

/// See [`bsdf::Principled`].
#[inline]
pub fn principled(p: &Principled, uv: Vec2, textures: &Textures) -> Bsdf<'static> {
    let scalar = |s: Scalar| textures.scalar(s, uv);
    Bsdf::Principled(bsdf::Principled::new(&PrincipledDials {
        base_color: textures.color(p.base_color, uv),
        roughness: scalar(p.roughness),
        anisotropic: scalar(p.anisotropic),
        metallic: scalar(p.metallic),
        spec_trans: scalar(p.spec_trans),
        eta: p.eta,
        spec_tint: scalar(p.spec_tint),
        sheen: scalar(p.sheen),
        sheen_tint: scalar(p.sheen_tint),
        flatness: scalar(p.flatness),
        clearcoat: scalar(p.clearcoat),
        clearcoat_gloss: scalar(p.clearcoat_gloss),
    }))
}

/// See [`bsdf::PrincipledThin`].
#[inline]
pub fn principled_thin(p: &PrincipledThin, uv: Vec2, textures: &Textures) -> Bsdf<'static> {
    let scalar = |s: Scalar| textures.scalar(s, uv);
    Bsdf::PrincipledThin(bsdf::PrincipledThin::new(&PrincipledThinDials {
        base_color: textures.color(p.base_color, uv),
        roughness: scalar(p.roughness),
        anisotropic: scalar(p.anisotropic),
        spec_trans: scalar(p.spec_trans),
        eta: scalar(p.eta),
        spec_tint: scalar(p.spec_tint),
        sheen: scalar(p.sheen),
        sheen_tint: scalar(p.sheen_tint),
        flatness: scalar(p.flatness),
        diff_trans: scalar(p.diff_trans),
    }))
}
