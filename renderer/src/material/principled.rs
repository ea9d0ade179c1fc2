//! The dials of Burley's models and of glTF's at a hit.

use limpid_scenes::{GltfMaterial, Principled, PrincipledThin, Scalar};

use crate::bsdf::{self, Bsdf, GltfDials, PrincipledDials, PrincipledThinDials};
use crate::texture::{TexturePoint, Textures};

/// See [`bsdf::Principled`].
#[inline]
pub fn principled(p: &Principled, at: TexturePoint, textures: &Textures) -> Bsdf<'static> {
    let scalar = |s: Scalar| textures.scalar(s, at);
    Bsdf::Principled(bsdf::Principled::new(&PrincipledDials {
        base_color: textures.color(p.base_color, at),
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
pub fn principled_thin(p: &PrincipledThin, at: TexturePoint, textures: &Textures) -> Bsdf<'static> {
    let scalar = |s: Scalar| textures.scalar(s, at);
    Bsdf::PrincipledThin(bsdf::PrincipledThin::new(&PrincipledThinDials {
        base_color: textures.color(p.base_color, at),
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

/// See [`bsdf::Gltf`].
#[inline]
pub fn gltf(p: &GltfMaterial, at: TexturePoint, textures: &Textures) -> Bsdf<'static> {
    let scalar = |s: Scalar| textures.scalar(s, at);
    Bsdf::Gltf(bsdf::Gltf::new(&GltfDials {
        base_color: textures.color(p.base_color, at),
        metallic: scalar(p.metallic),
        roughness: scalar(p.roughness),
        ior: p.ior,
        specular: scalar(p.specular),
        specular_color: textures.color(p.specular_color, at),
        clearcoat: scalar(p.clearcoat),
        clearcoat_roughness: scalar(p.clearcoat_roughness),
        sheen_color: textures.color(p.sheen_color, at),
        sheen_roughness: scalar(p.sheen_roughness),
        transmission: scalar(p.transmission),
        thin: p.thin,
    }))
}
