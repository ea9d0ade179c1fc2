//! What limpid does otherwise than Mitsuba 3 on purpose, undone.
//!
//! What differs by choice has its switch here, so that a comparison sees mistakes and not decisions: clip planes, the
//! steps of pixel filters, checkerboards that are read as numbers, glTF's materials, and how its spots fade.

use std::collections::HashMap;

use crate::gltf_in_mitsuba::replace_gltf_materials;
use crate::{LightKind, Scalar, Scene, SpotFalloff, TextureId, TextureKind, linear_beam_deg};

/// Where Mitsuba's cameras begin and end to see, in scene units, unless the file says otherwise.
const CLIP: [f64; 2] = [1e-2, 1e4];
/// Mitsuba looks pixel filters up in a table of so many values, without interpolation.
const FILTER_STEPS: u32 = 31;

/// Changes the scene so that it means here what it means in Mitsuba 3: leaves out what limpid does otherwise on purpose.
pub fn as_mitsuba(scene: &mut Scene) {
    for camera in &mut scene.cameras {
        camera.near_clip.get_or_insert(CLIP[0]);
        camera.far_clip.get_or_insert(CLIP[1]);
        camera.film.filter_steps = Some(FILTER_STEPS);
    }
    replace_gltf_materials(scene);
    swap_checkerboards(scene);
    for light in &mut scene.lights {
        if let LightKind::Spot { cutoff_deg, beam_deg, falloff, .. } = &mut light.kind
            && *falloff == SpotFalloff::CosineSquared
        {
            *falloff = SpotFalloff::Angle;
            *beam_deg = linear_beam_deg(*beam_deg, *cutoff_deg);
        }
    }
}

/// Mitsuba 3.9 swaps the two colours of a checkerboard where it is read as a number.
fn swap_checkerboards(scene: &mut Scene) {
    let Scene { materials, textures, .. } = scene;
    let mut swapped: HashMap<TextureId, TextureId> = HashMap::new();
    for scalar in materials.iter_mut().flat_map(|material| material.kind.scalars_mut()) {
        let Scalar::Texture(id) = scalar else { continue };
        let mut other = textures[id.0 as usize].clone();
        let TextureKind::Checkerboard { color0, color1 } = other.kind else { continue };
        *id = *swapped.entry(*id).or_insert_with(|| {
            other.kind = TextureKind::Checkerboard { color0: color1, color1: color0 };
            textures.push(other);
            TextureId(textures.len() as u32 - 1)
        });
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::{Color, LoadOptions, MaterialKind, load_str};

    #[test]
    fn clip_planes_are_mitsubas_where_the_file_states_none() {
        let text = r#"<scene version="3.0.0">
            <sensor type="perspective"/>
            <sensor type="perspective"><float name="near_clip" value="3"/></sensor>
        </scene>"#;
        let mut scene = load_str(text, Path::new(""), &LoadOptions::default()).expect("is a scene");
        as_mitsuba(&mut scene);
        let clips: Vec<_> = scene.cameras.iter().map(|camera| (camera.near_clip, camera.far_clip)).collect();
        assert_eq!(clips, [(Some(1e-2), Some(1e4)), (Some(3.0), Some(1e4))]);
    }

    #[test]
    fn checkerboards_are_swapped_as_numbers_and_stay_as_colours() {
        let board = r#"type="checkerboard"><float name="color0" value="0.1"/><float name="color1" value="0.9"/></texture>"#;
        let text = format!(
            r#"<scene version="3.0.0"><bsdf type="mask" id="m"><texture name="opacity" {board}
               <bsdf type="diffuse"><texture name="reflectance" {board}</bsdf></bsdf>
               <shape type="sphere"><ref id="m"/></shape></scene>"#
        );
        let mut scene = load_str(&text, Path::new(""), &LoadOptions::default()).expect("is a scene");
        as_mitsuba(&mut scene);
        let grey = |id: TextureId| match scene.textures[id.0 as usize].kind {
            TextureKind::Checkerboard { color0: Color::Constant(a), .. } => a[0],
            _ => panic!("a checkerboard"),
        };
        for material in &scene.materials {
            match material.kind {
                MaterialKind::Mask { opacity: Scalar::Texture(id), .. } => assert_eq!(grey(id), 0.9),
                MaterialKind::Diffuse { reflectance: Color::Texture(id) } => assert_eq!(grey(id), 0.1),
                _ => {}
            }
        }
        assert_eq!(scene.textures.len(), 3);
    }
}
