//! Pictures, each decoded once for what it is used as.

use std::sync::Arc;

use super::Reader;
use super::buffers::Bytes;
use super::json::{EXPORT_AGAIN, Item};
use crate::{Image, SceneError, Texels};

/// What the numbers of a picture mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Use {
    /// sRGB-encoded colours.
    Color,
    /// Numbers as they are.
    Data,
    /// The alpha channel alone.
    Alpha,
    /// 1 where alpha times a factor reaches a cutoff, else 0: both as bits.
    Cutout {
        /// Of the `f32`.
        factor: u32,
        /// Of the `f32`.
        cutoff: u32,
    },
}

/// Where the bytes of a picture lie (address of the buffer, offset), and what they are used as.
pub(super) type ImageKey = (usize, usize, Use);

impl Reader<'_> {
    /// A picture; `None` where its alpha is asked for and it is opaque everywhere.
    pub(super) fn image(&mut self, index: usize, usage: Use) -> Result<Option<Arc<Image>>, SceneError> {
        let item = self.document.entry("images", index)?;
        let bytes = self.image_bytes(index, &item)?;
        let (address, offset) = bytes.key();
        let key = (address, offset, usage);
        if let Some(known) = self.images.get(&key) {
            return Ok(known.clone());
        }
        let decoded = match usage {
            Use::Color => crate::image::decode(&bytes, false).map(Some),
            Use::Data => crate::image::decode(&bytes, true).map(Some),
            Use::Alpha => crate::image::decode_alpha(&bytes),
            Use::Cutout { factor, cutoff } => {
                let (factor, cutoff) = (f32::from_bits(factor), f32::from_bits(cutoff));
                let stays = |alpha: u8| f32::from(alpha) / 255.0 * factor >= cutoff;
                let cut = |mut image: Image| {
                    if let Texels::Linear8(bytes) = &mut image.texels {
                        bytes.iter_mut().for_each(|alpha| *alpha = if stays(*alpha) { 255 } else { 0 });
                    }
                    image
                };
                crate::image::decode_alpha(&bytes).map(|image| image.map(cut))
            }
        };
        let image = decoded
            .map_err(|problem| item.error("", problem, "export the model with PNG or JPEG pictures"))?;
        let image = image.map(Arc::new);
        self.images.insert(key, image.clone());
        Ok(image)
    }

    fn image_bytes(&mut self, index: usize, item: &Item<'_>) -> Result<Bytes, SceneError> {
        if let Some(known) = self.image_bytes.get(&index) {
            return Ok(known.clone());
        }
        let bytes = match (item.string("uri")?, item.index("bufferView", "bufferViews")?) {
            (Some(uri), _) => self.uri(uri, item)?,
            (None, Some(view)) => self.view(view)?.0,
            (None, None) => return Err(item.error("", "neither uri nor bufferView", EXPORT_AGAIN)),
        };
        self.image_bytes.insert(index, bytes.clone());
        Ok(bytes)
    }
}
