//! Parameters of the glTF 2.0 material.

use crate::{Color, Rgb, Scalar};

/// The metallic-roughness material of glTF 2.0 (appendix B of its specification) with the extensions
/// `KHR_materials_ior`, `_specular`, `_clearcoat`, `_sheen`, `_transmission` and `_volume`. Numbers are in \[0, 1\] where
/// nothing else is said; factors and textures of the file are multiplied already.
///
/// For readers: the default is glTF's own. A material that is `doubleSided` goes into
/// [`TwoSided`](crate::MaterialKind::TwoSided) unless it transmits; alpha, normal maps and emission are not part of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GltfMaterial {
    /// Colour of the diffuse base, of metal, and of what goes through.
    pub base_color: Color,
    /// From dielectric to metal.
    pub metallic: Scalar,
    /// Its square is the microfacet width.
    pub roughness: Scalar,
    /// Index inside over that outside, at least 1.
    pub ior: f32,
    /// Weight of the dielectric's reflection.
    pub specular: Scalar,
    /// Colour of the dielectric's reflection at normal incidence; may exceed 1.
    pub specular_color: Color,
    /// Weight of a clear coat of index 1.5.
    pub clearcoat: Scalar,
    /// Its square is the width of the coat's facets.
    pub clearcoat_roughness: Scalar,
    /// Colour of the sheen; black for none.
    pub sheen_color: Color,
    /// Its square is the width of the sheen.
    pub sheen_roughness: Scalar,
    /// From the diffuse base to transmission; constant 0 is black from behind.
    pub transmission: Scalar,
    /// No inside (`thicknessFactor` 0): light goes through without bending.
    pub thin: bool,
    /// White light that has gone this distance inside, in world space, has this colour; `None`: the inside is clear.
    pub attenuation: Option<(f32, Rgb)>,
}

impl Default for GltfMaterial {
    /// glTF's: a white metal of roughness 1.
    fn default() -> Self {
        let [zero, one] = [0.0, 1.0].map(Scalar::Constant);
        let [black, white] = [0.0, 1.0].map(|grey| Color::Constant([grey; 3]));
        Self {
            base_color: white,
            metallic: one,
            roughness: one,
            ior: 1.5,
            specular: one,
            specular_color: white,
            clearcoat: zero,
            clearcoat_roughness: zero,
            sheen_color: black,
            sheen_roughness: zero,
            transmission: zero,
            thin: true,
            attenuation: None,
        }
    }
}

impl GltfMaterial {
    /// All of its numbers that may be textured.
    pub fn scalars_mut(&mut self) -> [&mut Scalar; 7] {
        [
            &mut self.metallic,
            &mut self.roughness,
            &mut self.specular,
            &mut self.clearcoat,
            &mut self.clearcoat_roughness,
            &mut self.sheen_roughness,
            &mut self.transmission,
        ]
    }

    /// Whether some light goes through, somewhere.
    pub fn transmits(&self) -> bool {
        self.transmission != Scalar::Constant(0.0)
    }
}
