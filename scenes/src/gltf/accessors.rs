//! Accessors: typed numbers in buffers, with sparse replacements.

use std::sync::Arc;

use super::Reader;
use super::buffers::Bytes;
use super::json::{EXPORT_AGAIN, Item};
use crate::SceneError;

/// Elements of an accessor as floating-point numbers, row after row.
#[derive(Debug)]
pub(super) struct Floats {
    /// Numbers an element: 1, 2, 3, 4 or 16 for what is read here.
    pub width: usize,
    pub values: Vec<f32>,
}

impl Floats {
    /// Number of elements.
    pub fn len(&self) -> usize {
        self.values.len() / self.width
    }

    /// The first `N` numbers of an element; missing ones are 0.
    pub fn get<const N: usize>(&self, index: usize) -> [f32; N] {
        let element = &self.values[index * self.width..(index + 1) * self.width];
        std::array::from_fn(|i| element.get(i).copied().unwrap_or(0.0))
    }

    /// All elements, cut or filled up to `N` numbers.
    pub fn rows<const N: usize>(&self) -> Vec<[f32; N]> {
        (0..self.len()).map(|index| self.get(index)).collect()
    }
}

/// How one number is stored.
#[derive(Clone, Copy, PartialEq)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn of(code: u64) -> Option<Self> {
        Some(match code {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// The number at the beginning of `bytes`, mapped to \[0, 1\] or \[−1, 1\] where `normalized`.
    fn float(self, bytes: &[u8], normalized: bool) -> f32 {
        let (value, largest) = match self {
            Self::I8 => (f32::from(bytes[0] as i8), 127.0),
            Self::U8 => (f32::from(bytes[0]), 255.0),
            Self::I16 => (f32::from(i16::from_le_bytes([bytes[0], bytes[1]])), 32_767.0),
            Self::U16 => (f32::from(u16::from_le_bytes([bytes[0], bytes[1]])), 65_535.0),
            Self::U32 => (self.unsigned(bytes) as f32, u32::MAX as f32),
            Self::F32 => return f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]),
        };
        if normalized { (value / largest).max(-1.0) } else { value }
    }

    /// The same as an index; numbers that are no index become one that no list has.
    fn unsigned(self, bytes: &[u8]) -> u32 {
        match self {
            Self::U8 => bytes[0].into(),
            Self::U16 => u16::from_le_bytes([bytes[0], bytes[1]]).into(),
            Self::U32 => u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]),
            Self::I8 | Self::I16 | Self::F32 => u32::MAX,
        }
    }
}

/// Where the elements of an accessor lie.
struct Layout {
    component: Component,
    width: usize,
    count: usize,
    normalized: bool,
}

impl Reader<'_> {
    /// The numbers of an accessor, which are decoded once.
    pub(super) fn floats(&mut self, index: usize) -> Result<Arc<Floats>, SceneError> {
        if let Some(known) = self.accessors.get(&index) {
            return Ok(Arc::clone(known));
        }
        let item = self.document.entry("accessors", index)?;
        let layout = layout(&item)?;
        let Layout { component, width, count, normalized } = layout;
        self.take(4 * (width * count) as u64, &item)?;
        let mut values = vec![0.0f32; width * count];
        if let Some(view) = item.index("bufferView", "bufferViews")? {
            let (bytes, stride, step) = self.elements(&item, view, &layout, count)?;
            for (row, element) in values.chunks_exact_mut(width).zip(0..) {
                let element = &bytes[element * stride..];
                for (i, value) in row.iter_mut().enumerate() {
                    *value = component.float(&element[step(i)..], normalized);
                }
            }
        }
        if let Some(sparse) = item.object("sparse")? {
            let (places, bytes, stride, step) = self.sparse(&sparse, &layout)?;
            for (place, element) in places.into_iter().zip(0..) {
                let element = &bytes[element * stride..];
                for i in 0..width {
                    values[place * width + i] = component.float(&element[step(i)..], normalized);
                }
            }
        }
        let floats = Arc::new(Floats { width, values });
        self.accessors.insert(index, Arc::clone(&floats));
        Ok(floats)
    }

    /// The numbers of an accessor as indices.
    pub(super) fn unsigned(&mut self, index: usize) -> Result<Vec<u32>, SceneError> {
        let item = self.document.entry("accessors", index)?;
        let layout = Layout { width: 1, ..layout(&item)? };
        self.take(4 * layout.count as u64, &item)?;
        let mut values = vec![0u32; layout.count];
        if let Some(view) = item.index("bufferView", "bufferViews")? {
            let (bytes, stride, _) = self.elements(&item, view, &layout, layout.count)?;
            for (value, element) in values.iter_mut().zip(0..) {
                *value = layout.component.unsigned(&bytes[element * stride..]);
            }
        }
        if let Some(sparse) = item.object("sparse")? {
            let (places, bytes, stride, _) = self.sparse(&sparse, &layout)?;
            for (place, element) in places.into_iter().zip(0..) {
                values[place] = layout.component.unsigned(&bytes[element * stride..]);
            }
        }
        Ok(values)
    }

    /// The bytes from the first element on, the stride, and where in an element each number lies; `count` elements
    /// are within.
    fn elements(
        &mut self,
        item: &Item<'_>,
        view: usize,
        layout: &Layout,
        count: usize,
    ) -> Result<(Bytes, usize, impl Fn(usize) -> usize + use<>), SceneError> {
        let (bytes, stride) = self.view(view)?;
        let size = layout.component.size();
        // columns of matrices of small numbers begin at multiples of four bytes (specification, 3.6.2.4)
        let rows = match layout.width {
            9 if size < 4 => 3,
            4 if size == 1 && item.get("type").and_then(|t| t.as_str()) == Some("MAT2") => 2,
            width => width,
        };
        let column = (rows * size).next_multiple_of(if rows == layout.width { 1 } else { 4 });
        let step = move |i: usize| i / rows * column + i % rows * size;
        let packed = step(layout.width - 1) + size;
        let stride = stride.filter(|stride| *stride > 0).unwrap_or(packed);
        let offset = item.unsigned("byteOffset")?.unwrap_or(0);
        let needed = match count {
            0 => 0,
            count => ((count - 1) as u64).saturating_mul(stride as u64).saturating_add(packed as u64),
        };
        if offset.saturating_add(needed) > bytes.len() as u64 {
            let problem = format!(
                "{count} elements take {needed} bytes from {offset} on, but the buffer view has {}",
                bytes.len()
            );
            return Err(item.error("count", problem, EXPORT_AGAIN));
        }
        Ok((bytes.from(offset as usize), stride, step))
    }

    /// The places that sparse values go to, and the bytes of the values.
    #[expect(clippy::type_complexity, reason = "the list of places and what `elements` returns")]
    fn sparse(
        &mut self,
        item: &Item<'_>,
        layout: &Layout,
    ) -> Result<(Vec<usize>, Bytes, usize, impl Fn(usize) -> usize + use<>), SceneError> {
        let count = item.unsigned("count")?.unwrap_or(0);
        if count > layout.count as u64 {
            return Err(item.error("count", format!("{count} of {} elements", layout.count), EXPORT_AGAIN));
        }
        let part = |key: &str| item.object(key)?.ok_or_else(|| item.error(key, "not there", EXPORT_AGAIN));
        let view = |part: &Item<'_>| {
            let view = part.index("bufferView", "bufferViews")?;
            view.ok_or_else(|| part.error("bufferView", "not there", EXPORT_AGAIN))
        };
        let indices = part("indices")?;
        let of_indices =
            Layout { component: component(&indices)?, width: 1, count: count as usize, normalized: false };
        let (bytes, stride, _) = self.elements(&indices, view(&indices)?, &of_indices, of_indices.count)?;
        let place = |element: usize| {
            let place = of_indices.component.unsigned(&bytes[element * stride..]) as usize;
            if place < layout.count {
                return Ok(place);
            }
            let problem = format!("element {place}, but the accessor has {}", layout.count);
            Err(indices.error("", problem, EXPORT_AGAIN))
        };
        let places = (0..of_indices.count).map(place).collect::<Result<Vec<_>, _>>()?;
        let values = part("values")?;
        let (bytes, stride, step) = self.elements(&values, view(&values)?, layout, of_indices.count)?;
        Ok((places, bytes, stride, step))
    }
}

fn component(item: &Item<'_>) -> Result<Component, SceneError> {
    let code = item.unsigned("componentType")?;
    code.and_then(Component::of).ok_or_else(|| {
        let problem = code.map_or("not there".into(), |code| format!("unknown type {code}"));
        item.error("componentType", problem, "5120 to 5123, 5125 and 5126 are the types that there are")
    })
}

fn layout(item: &Item<'_>) -> Result<Layout, SceneError> {
    let kind = item.string("type")?.unwrap_or_default();
    let width = match kind {
        "SCALAR" => 1,
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" | "MAT2" => 4,
        "MAT3" => 9,
        "MAT4" => 16,
        _ => {
            let problem = format!("unknown type \"{}\"", kind.chars().take(40).collect::<String>());
            return Err(item.error("type", problem, "SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3, MAT4 are known"));
        }
    };
    let count = item.unsigned("count")?.unwrap_or(0);
    if count > u64::from(u32::MAX) {
        return Err(item.error("count", format!("{count} elements"), EXPORT_AGAIN));
    }
    Ok(Layout {
        component: component(item)?,
        width,
        count: count as usize,
        normalized: item.boolean("normalized")?,
    })
}
