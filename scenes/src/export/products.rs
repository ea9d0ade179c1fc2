//! Products and channels of textures: Mitsuba 3 has neither.

use super::bake::{DEEPEST, linear, values};
use super::textures::times;
use super::{ExportError, Writer};
use crate::{Color, Mesh, Rgb, ShapeKind, TextureId, TextureKind};

/// What a texture is on the whole.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Level {
    /// Over its texels, or the vertices of all meshes, each counted once.
    mean: Rgb,
    /// It is that everywhere.
    is_constant: bool,
}

impl Writer<'_> {
    /// A product times a factor: exact where one of the two is the same everywhere or both are pictures that fit on each other.
    /// Else one stands in, a picture rather than what is none, times the mean of the other.
    pub(super) fn product(
        &mut self,
        name: &str,
        id: TextureId,
        [a, b]: [Color; 2],
        factor: Rgb,
    ) -> Result<(), ExportError> {
        let [level_a, level_b] = [a, b].map(|color| self.level(color, DEEPEST));
        if level_a.is_constant {
            return self.scaled_color(name, b, times(level_a.mean, factor));
        }
        if level_b.is_constant {
            return self.scaled_color(name, a, times(level_b.mean, factor));
        }
        if let Some(baked) = self.bake(id) {
            return self.baked_texture(name, baked.map(|texel| times(texel, factor)));
        }
        let is_picture = |color| matches!(color, Color::Texture(of) if self.bake(of).is_some());
        let (kept, other, mean) =
            if is_picture(b) && !is_picture(a) { (b, a, level_a.mean) } else { (a, b, level_b.mean) };
        let [kind, other] = [kept, other].map(|color| self.kind(color));
        self.note(&format!(
            "texture \"{}\": Mitsuba has no product of {kind} and {other}: in place of the latter stands its mean",
            self.scene.textures[id.0 as usize].name
        ));
        self.scaled_color(name, kept, times(mean, factor))
    }

    /// A channel times a factor: exact of pictures and of what is the same everywhere, else its mean.
    pub(super) fn channel(&mut self, name: &str, id: TextureId, factor: Rgb) -> Result<(), ExportError> {
        let level = self.level(Color::Texture(id), DEEPEST);
        if !level.is_constant {
            if let Some(baked) = self.bake(id) {
                return self.baked_texture(name, baked.map(|texel| times(texel, factor)));
            }
            self.note(&format!(
                "texture \"{}\": Mitsuba has no channel of {}: its mean stands in",
                self.scene.textures[id.0 as usize].name,
                self.kind(Color::Texture(id))
            ));
        }
        self.color(name, Color::Constant(times(level.mean, factor)))
    }

    /// In the words of a note.
    fn kind(&self, color: Color) -> &'static str {
        let Color::Texture(id) = color else { return "a colour" };
        match &self.scene.textures[id.0 as usize].kind {
            TextureKind::Bitmap { .. } => "a picture",
            TextureKind::Checkerboard { .. } => "a checkerboard",
            TextureKind::MeshAttribute { name, .. } if name.starts_with("vertex_") => {
                "the values of vertices"
            }
            TextureKind::MeshAttribute { .. } => "the values of faces",
            TextureKind::Scaled { color, .. } => self.kind(*color),
            TextureKind::Channel { of, .. } => self.kind(Color::Texture(*of)),
            TextureKind::Product { .. } => "a product",
        }
    }

    fn level(&self, color: Color, depth: u32) -> Level {
        let constant = |mean| Level { mean, is_constant: true };
        let id = match color {
            Color::Constant(mean) => return constant(mean),
            Color::Texture(TextureId(id)) => id,
        };
        let grey = Level { mean: [0.5; 3], is_constant: false };
        let Some(texture) = self.scene.textures.get(id as usize).filter(|_| depth > 0) else { return grey };
        let of = |color| self.level(color, depth - 1);
        match &texture.kind {
            TextureKind::Bitmap { image, .. } => {
                let linear = linear(image);
                mean(values(&linear).chunks_exact(3).map(|t| [t[0], t[1], t[2]])).unwrap_or(grey)
            }
            TextureKind::Checkerboard { color0, color1 } => {
                let both = [of(*color0), of(*color1)];
                let Some(level) = mean(both.iter().map(|level| level.mean)) else { return grey };
                Level {
                    is_constant: level.is_constant && both.iter().all(|level| level.is_constant),
                    ..level
                }
            }
            TextureKind::MeshAttribute { name, scale } => {
                let values = self.meshes_of_scene().flat_map(|mesh| &mesh.attributes);
                let values = values.filter(|attribute| attribute.name == *name).flat_map(|attribute| {
                    let last = attribute.channels.saturating_sub(1).min(2) as usize;
                    let of_one = attribute.values.chunks_exact(attribute.channels.max(1) as usize);
                    of_one.map(move |value| [0, 1, 2].map(|c: usize| value[c.min(last)] * scale))
                });
                mean(values).unwrap_or(constant([0.0; 3])) // black on meshes that have none
            }
            TextureKind::Scaled { color, factor } => {
                let level = of(*color);
                Level { mean: times(level.mean, *factor), ..level }
            }
            TextureKind::Channel { of: whole, channel } => {
                let level = of(Color::Texture(*whole));
                Level { mean: [level.mean[usize::from(*channel).min(2)]; 3], ..level }
            }
            TextureKind::Product { a, b } => {
                let [a, b] = [of(*a), of(*b)];
                Level { mean: times(a.mean, b.mean), is_constant: a.is_constant && b.is_constant }
            }
        }
    }

    fn meshes_of_scene(&self) -> impl Iterator<Item = &Mesh> {
        let in_groups = self.scene.groups.iter().flat_map(|group| &group.shapes);
        self.scene.shapes.iter().chain(in_groups).filter_map(|shape| match &shape.kind {
            ShapeKind::Mesh(mesh) => Some(&**mesh),
            _ => None,
        })
    }
}

/// `None` of nothing, and where the mean is no number.
fn mean(values: impl Iterator<Item = Rgb>) -> Option<Level> {
    let (mut sum, mut count, mut first, mut is_constant) = ([0.0f64; 3], 0u64, None, true);
    for value in values {
        is_constant &= *first.get_or_insert(value) == value;
        sum.iter_mut().zip(value).for_each(|(sum, v)| *sum += f64::from(v));
        count += 1;
    }
    let first = first?;
    // a constant keeps its bits
    let mean = if is_constant { first } else { sum.map(|sum| (sum / count as f64) as f32) };
    mean.iter().all(|v| v.is_finite()).then_some(Level { mean, is_constant })
}
