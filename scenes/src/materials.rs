//! Questions about materials that are made of others.

use crate::{MaterialId, MaterialKind, Scene};

impl MaterialKind {
    /// Whether the model itself scatters light from one side of the surface to the other. What lets light straight
    /// through does not count.
    pub fn transmits(&self) -> bool {
        match self {
            Self::Dielectric { .. } | Self::RoughDielectric { .. } | Self::ThinDielectric { .. } => true,
            Self::Principled(p) => p.transmits(),
            Self::Gltf(p) => p.transmits(),
            // Perhaps only reflects, but on both sides.
            Self::PrincipledThin(_) => true,
            Self::Diffuse { .. }
            | Self::Conductor { .. }
            | Self::RoughConductor { .. }
            | Self::Plastic { .. }
            | Self::RoughPlastic { .. }
            | Self::RoughDiffuse { .. }
            | Self::Phong { .. }
            | Self::Ward { .. }
            | Self::TwoSided { .. }
            | Self::Null
            | Self::Mask { .. }
            | Self::Blend { .. }
            | Self::Mixture { .. }
            | Self::Perturbed { .. } => false,
        }
    }

    /// Whether its inside takes some of the light.
    pub fn absorbs(&self) -> bool {
        matches!(self, Self::Gltf(p) if p.attenuation.is_some())
    }

    /// The materials that it is made of.
    pub fn inner(&self) -> Vec<MaterialId> {
        match self {
            Self::Diffuse { .. }
            | Self::Conductor { .. }
            | Self::RoughConductor { .. }
            | Self::Dielectric { .. }
            | Self::Plastic { .. }
            | Self::RoughPlastic { .. }
            | Self::RoughDielectric { .. }
            | Self::ThinDielectric { .. }
            | Self::RoughDiffuse { .. }
            | Self::Phong { .. }
            | Self::Ward { .. }
            | Self::Principled(_)
            | Self::PrincipledThin(_)
            | Self::Gltf(_)
            | Self::Null => Vec::new(),
            Self::Mask { inner, .. } | Self::Perturbed { inner, .. } => vec![*inner],
            Self::TwoSided { front: a, back: b } | Self::Blend { first: a, second: b, .. } => vec![*a, *b],
            Self::Mixture { parts } => parts.iter().map(|&(_, inner)| inner).collect(),
        }
    }
}

impl Scene {
    /// Whether `test` holds for a material or for any that it is made of. Each is looked at once, however often it
    /// is part of another.
    pub fn any_material(&self, material: MaterialId, test: fn(&MaterialKind) -> bool) -> bool {
        let mut seen = vec![false; self.materials.len()];
        let mut open = vec![material];
        while let Some(MaterialId(id)) = open.pop() {
            if !std::mem::replace(&mut seen[id as usize], true) {
                let kind = &self.materials[id as usize].kind;
                if test(kind) {
                    return true;
                }
                open.extend(kind.inner());
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Color, Material, Scalar};

    #[test]
    fn a_material_that_is_part_of_many_is_looked_at_once() {
        // Each blends the one before with itself: 2^60 ways lead to the first.
        let mut scene = Scene::default();
        let mut add =
            |kind| scene.materials.push(Material { name: String::new(), kind, place: Default::default() });
        add(MaterialKind::Diffuse { reflectance: Color::Constant([0.5; 3]) });
        for id in 0..60 {
            let (first, second) = (MaterialId(id), MaterialId(id));
            add(MaterialKind::Blend { weight: Scalar::Constant(0.5), first, second });
        }
        assert!(!scene.any_material(MaterialId(60), MaterialKind::transmits));
        assert!(scene.any_material(MaterialId(60), |kind| matches!(kind, MaterialKind::Diffuse { .. })));
    }
}
