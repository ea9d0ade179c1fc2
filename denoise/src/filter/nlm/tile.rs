//! Tiles, and what of the image is copied beside each other for one of them.

use std::ops::Range;

use crate::plane::Size;

/// Size of a tile in pixels: wide, because rows are what the loops run over, and low enough for what a tile
/// needs to stay in a core's second-level cache.
const TILE: (usize, usize) = (64, 32);

/// What rows are padded to, so that loops over them run in whole blocks.
pub(super) const LANES: usize = 16;

/// A part of a row. Its fixed length is what lets a compiler make one or two instructions of a loop over it.
pub(super) type Block = [f32; LANES];

/// A rectangle of pixels; what lies in a halo may lie outside the image.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rect {
    pub x: Range<isize>,
    pub y: Range<isize>,
}

impl Rect {
    /// The tiles of an image.
    pub fn tiles(size: Size) -> Vec<Rect> {
        let cut = |length: usize, side: usize| {
            (0..length).step_by(side).map(move |a| a as isize..(a + side).min(length) as isize)
        };
        let rows = cut(size.height, TILE.1);
        rows.flat_map(|y| cut(size.width, TILE.0).map(move |x| Rect { x, y: y.clone() })).collect()
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
    x: isize,
    y: isize,
    stride: usize,
    values: Vec<f32>,
}

impl Grid {
    /// Makes this cover a rectangle, with zero everywhere, in the padding too.
    pub fn cover(&mut self, rect: &Rect) {
        (self.x, self.y) = (rect.x.start, rect.y.start);
        self.stride = rect.width().next_multiple_of(LANES);
        self.values.clear();
        self.values.resize(self.stride * rect.y.len(), 0.0);
    }

    /// Blocks in a row.
    pub fn blocks(&self) -> usize {
        self.stride / LANES
    }

    /// A row with its padding.
    #[inline(always)]
    pub fn row(&self, y: isize) -> &[Block] {
        self.values[(y - self.y) as usize * self.stride..][..self.stride].as_chunks().0
    }

    /// So many rows, one after the other.
    #[inline(always)]
    pub fn rows(&self, y: isize, count: usize) -> &[Block] {
        self.values[(y - self.y) as usize * self.stride..][..count * self.stride].as_chunks().0
    }

    #[inline(always)]
    pub fn row_mut(&mut self, y: isize) -> &mut [Block] {
        self.values[(y - self.y) as usize * self.stride..][..self.stride].as_chunks_mut().0
    }

    /// Makes a row zero outside a range of x.
    #[inline(always)]
    pub fn clear_outside(&mut self, y: isize, x: &Range<isize>) {
        let (start, end) = ((x.start - self.x) as usize, (x.end - self.x) as usize);
        let row = &mut self.values[(y - self.y) as usize * self.stride..][..self.stride];
        row[..start].fill(0.0);
        row[end..].fill(0.0);
    }
}

/// Planes of the image around a tile, zero outside the image, with rows long enough for whole blocks.
pub(super) struct Local<'a> {
    size: Size,
    rect: Rect,
    stride: usize,
    /// What was copied, in the order of the copies.
    planes: Vec<&'a [f32]>,
    values: Vec<f32>,
}

impl<'a> Local<'a> {
    /// Nothing yet, of a tile and so many pixels around it.
    pub fn new(size: Size, tile: &Rect, margin: usize) -> Self {
        let rect = tile.grown(margin);
        // A row of blocks may begin anywhere in it and end up to a block late.
        let stride = rect.width().next_multiple_of(LANES) + LANES;
        Self { size, rect, stride, planes: Vec::new(), values: Vec::new() }
    }

    /// Copies a plane, unless it is here already. The answer is its number.
    pub fn copy(&mut self, plane: &'a [f32]) -> usize {
        if let Some(number) = self.planes.iter().position(|known| std::ptr::eq(*known, plane)) {
            return number;
        }
        let Size { width, height } = self.size;
        let image = Rect { x: 0..width as isize, y: 0..height as isize };
        let inside = self.rect.meet(&image);
        let first = self.values.len();
        self.values.resize(first + self.stride * (self.rect.y.len() + 1), 0.0); // a last row to run into
        for y in inside.y.clone() {
            let row = &plane[inside.row_in(y, self.size)];
            let at = first + self.at(inside.x.start, y);
            self.values[at..][..row.len()].copy_from_slice(row);
        }
        self.planes.push(plane);
        self.planes.len() - 1
    }

    fn at(&self, x: isize, y: isize) -> usize {
        (y - self.rect.y.start) as usize * self.stride + (x - self.rect.x.start) as usize
    }

    /// So many blocks of a plane from a pixel on.
    #[inline(always)]
    pub fn row(&self, number: usize, (x, y): (isize, isize), blocks: usize) -> &[Block] {
        let plane = number * self.stride * (self.rect.y.len() + 1);
        self.values[plane + self.at(x, y)..][..blocks * LANES].as_chunks().0
    }
}
