//! The nearest that Mitsuba 3 has to glTF's material. `docs/mitsuba.md` measures how far the two are apart.

use crate::{Color, GltfMaterial, MaterialKind, Principled, PrincipledThin, Scalar, Scene};

/// Puts the nearest materials of Mitsuba's in the place of glTF's; gives what differs, each difference once.
pub(crate) fn replace_gltf_materials(scene: &mut Scene) -> Vec<&'static str> {
    let mut differences = Vec::new();
    for material in &mut scene.materials {
        if let MaterialKind::Gltf(gltf) = &material.kind {
            let (kind, found) = nearest(gltf);
            differences.extend(found);
            material.kind = kind;
        }
    }
    let mut seen = Vec::new();
    differences.retain(|difference| {
        let is_new = !seen.contains(difference);
        seen.push(*difference);
        is_new
    });
    differences
}

/// The material, and what of it is otherwise.
fn nearest(p: &GltfMaterial) -> (MaterialKind, Vec<&'static str>) {
    let [zero, one] = [0.0, 1.0].map(Scalar::Constant);
    let [black, white] = [[0.0; 3], [1.0; 3]].map(Color::Constant);
    let is_metal = p.metallic == one;
    let is_plain = p.metallic == zero && !p.transmits();
    let mut differences = Vec::new();
    let mut differs = |applies: bool, what| {
        if applies {
            differences.push(what);
        }
    };
    differs(p.sheen_color != black, "sheen is left out");
    differs(!is_metal && p.specular_color != white, "the colour of the reflection is left out");
    differs(p.attenuation.is_some(), "the inside absorbs nothing");
    // The weight of the reflection is that at normal incidence, as an index, where that bends no light.
    let eta = match p.specular {
        Scalar::Constant(weight) if is_plain && weight < 1.0 => {
            let r = weight.max(0.0).sqrt() * (p.ior - 1.0) / (p.ior + 1.0);
            (1.0 + r) / (1.0 - r)
        }
        specular => {
            differs(!is_metal && specular != one, "the weight of the reflection is left out");
            p.ior
        }
    };
    if is_plain && eta == 1.0 && p.clearcoat == zero {
        return (MaterialKind::Diffuse { reflectance: p.base_color }, differences); // nothing reflects
    }
    if p.thin && p.transmits() {
        differs(true, "a sheet of two surfaces lets light through, and not one");
        differs(p.clearcoat != zero, "the coat is left out");
        let thin = PrincipledThin {
            base_color: p.base_color,
            roughness: p.roughness,
            spec_trans: p.transmission,
            eta: Scalar::Constant(p.ior),
            ..PrincipledThin::default()
        };
        return (MaterialKind::PrincipledThin(Box::new(thin)), differences);
    }
    differs(
        !is_metal,
        "the base is Burley's and gives nothing to the reflection over it, which is Fresnel's and not Schlick's",
    );
    differs(p.clearcoat != zero, "the coat is Burley's, and takes nothing from what is below it");
    // Mitsuba's coat has a width of 0.1 − 0.099 gloss.
    let gloss = match p.clearcoat_roughness {
        Scalar::Constant(roughness) => ((0.1 - roughness * roughness) / 0.099).clamp(0.0, 1.0),
        Scalar::Texture(_) => 0.0,
    };
    // Where all of it goes through, Mitsuba takes the root of the colour.
    let base_color = match p.base_color {
        Color::Constant(color) if p.metallic == zero && p.transmission == one => {
            Color::Constant(color.map(|c| c * c))
        }
        color => color,
    };
    let principled = Principled {
        base_color,
        roughness: p.roughness,
        metallic: p.metallic,
        spec_trans: p.transmission,
        eta,
        clearcoat: p.clearcoat,
        clearcoat_gloss: Scalar::Constant(gloss),
        ..Principled::default()
    };
    (MaterialKind::Principled(Box::new(principled)), differences)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dielectric() -> GltfMaterial {
        GltfMaterial {
            base_color: Color::Constant([0.5; 3]),
            metallic: Scalar::Constant(0.0),
            ..GltfMaterial::default()
        }
    }

    #[test]
    fn metal_is_the_same_and_what_reflects_nothing_is_diffuse() {
        let (kind, differences) = nearest(&GltfMaterial::default());
        assert!(matches!(kind, MaterialKind::Principled(_)) && differences.is_empty(), "{differences:?}");
        for dull in [
            GltfMaterial { specular: Scalar::Constant(0.0), ..dielectric() },
            GltfMaterial { ior: 1.0, ..dielectric() },
        ] {
            let (kind, differences) = nearest(&dull);
            assert!(
                matches!(kind, MaterialKind::Diffuse { .. }) && differences.is_empty(),
                "{differences:?}"
            );
        }
    }

    #[test]
    fn the_weight_of_the_reflection_is_an_index_where_it_can_be() {
        let weighted = GltfMaterial { specular: Scalar::Constant(0.25), ..dielectric() };
        let (MaterialKind::Principled(p), differences) = nearest(&weighted) else { panic!("principled") };
        let r = ((p.eta - 1.0) / (p.eta + 1.0)).powi(2);
        assert!((r - 0.25 * 0.04).abs() < 1e-6, "{r}");
        assert_eq!(differences.len(), 1);
        let half_metal = GltfMaterial { metallic: Scalar::Constant(0.5), ..weighted };
        let (MaterialKind::Principled(p), differences) = nearest(&half_metal) else { panic!("principled") };
        assert_eq!(p.eta, 1.5);
        assert!(differences.contains(&"the weight of the reflection is left out"), "{differences:?}");
    }

    #[test]
    fn glass_has_the_colour_that_goes_through() {
        let glass = GltfMaterial { transmission: Scalar::Constant(1.0), thin: false, ..dielectric() };
        let (MaterialKind::Principled(p), _) = nearest(&glass) else { panic!("principled") };
        assert_eq!(p.base_color, Color::Constant([0.25; 3]));
        let thin = GltfMaterial { thin: true, ..glass };
        assert!(matches!(nearest(&thin).0, MaterialKind::PrincipledThin(_)));
    }
}
