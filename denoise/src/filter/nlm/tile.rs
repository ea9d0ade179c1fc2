//! Rectangles of pixels, and values over them.

use std::ops::Range;

use crate::plane::Size;

/// Side of a tile in pixels. The accumulators of two components in two halves take 256 KiB then.
const SIDE: usize = 64;

/// What rows of a [`Grid`] are padded to, so that loops over them run in whole blocks.
pub(super) const LANES: usize = 16;

/// A rectangle of pixels; what lies in a halo may lie outside the image.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rect {
    pub x: Range<isize>,
    pub y: Range<isize>,
}

impl Rect {
    /// The tiles of an image.
    pub fn tiles(size: Size) -> Vec<Rect> {
        let cut = |length: usize| {
            (0..length).step_by(SIDE).map(move |a| a as isize..(a + SIDE).min(length) as isize)
        };
        cut(size.height).flat_map(|y| cut(size.width).map(move |x| Rect { x, y: y.clone() })).collect()
    }

    /// The pixels that have a neighbour at an offset in the image.
    pub fn with_neighbour(size: Size, (dx, dy): (isize, isize)) -> Rect {
        let (width, height) = (size.width as isize, size.height as isize);
        Rect { x: (-dx).max(0)..width.min(width - dx), y: (-dy).max(0)..height.min(height - dy) }
    }

    pub fn width(&self) -> usize {
        self.x.len()
    }

    pub fn pixels(&self) -> usize {
        self.x.len() * self.y.len()
    }

    pub fn is_empty(&self) -> bool {
        self.x.is_empty() || self.y.is_empty()
    }

    pub fn grown(&self, by: usize) -> Rect {
        let by = by as isize;
        Rect { x: self.x.start - by..self.x.end + by, y: self.y.start - by..self.y.end + by }
    }

    pub fn meet(&self, other: &Rect) -> Rect {
        let meet = |a: &Range<isize>, b: &Range<isize>| a.start.max(b.start)..a.end.min(b.end);
        Rect { x: meet(&self.x, &other.x), y: meet(&self.y, &other.y) }
    }

    /// Where row `y` of this rectangle lies in a plane of the image.
    pub fn row_in(&self, y: isize, size: Size) -> Range<usize> {
        let start = y as usize * size.width + self.x.start as usize;
        start..start + self.width()
    }

    /// Where part of row `y` lies in a plane of this rectangle.
    pub fn local(&self, y: isize, x: &Range<isize>) -> Range<usize> {
        let start = (y - self.y.start) as usize * self.width() + (x.start - self.x.start) as usize;
        start..start + x.len()
    }

    /// Copies a plane of this rectangle into the image's.
    pub fn place(&self, size: Size, part: &[f32], out: &mut [f32]) {
        for (y, row) in self.y.clone().zip(part.chunks_exact(self.width())) {
            out[self.row_in(y, size)].copy_from_slice(row);
        }
    }
}

/// Values over a rectangle, the rows padded to whole blocks of [`LANES`].
#[derive(Default)]
pub(super) struct Grid {
    /// Top left corner.
    x: isize,
    y: isize,
    stride: usize,
    values: Vec<f32>,
}

impl Grid {
    /// Makes this cover a rectangle, with the same value everywhere, in the padding too.
    pub fn reset(&mut self, rect: &Rect, value: f32) {
        (self.x, self.y) = (rect.x.start, rect.y.start);
        self.stride = rect.width().next_multiple_of(LANES);
        self.values.clear();
        self.values.resize(self.stride * rect.y.len(), value);
    }

    #[inline(always)]
    fn at(&self, x: isize, y: isize) -> usize {
        (y - self.y) as usize * self.stride + (x - self.x) as usize
    }

    #[inline(always)]
    pub fn row(&self, y: isize, x: &Range<isize>) -> &[f32] {
        &self.values[self.at(x.start, y)..][..x.len()]
    }

    #[inline(always)]
    pub fn row_mut(&mut self, y: isize, x: &Range<isize>) -> &mut [f32] {
        let at = self.at(x.start, y);
        &mut self.values[at..][..x.len()]
    }

    /// The whole row with its padding.
    #[inline(always)]
    pub fn padded_row(&self, y: isize) -> &[f32] {
        &self.values[self.at(self.x, y)..][..self.stride]
    }
}
