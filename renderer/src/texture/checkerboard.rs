//! Squares of side ½.

use glam::DVec2;
use limpid_scenes::Color;

use super::fract;

/// Two colours in turn.
pub struct Checkerboard {
    /// The first where both or neither of frac(u), frac(v) lie above ½.
    pub colors: [Color; 2],
}

impl Checkerboard {
    /// The colour whose turn it is.
    pub fn color(&self, uv: DVec2) -> Color {
        self.colors[usize::from((fract(uv.x) > 0.5) != (fract(uv.y) > 0.5))]
    }
}
