//! Discrete distributions over a row and over a grid of cells.
//!
//! Weights that are not finite or not positive count as 0, and a cell of weight 0 is never drawn. Both keep the order
//! of `u`, so that what was stratified stays so, and give back what is left of `u` for a choice within the cell.

/// Cell `i` of a row with probability proportional to its weight.
#[derive(Clone, Debug)]
pub struct Distribution1d {
    /// Sums of the weights up to and including each cell.
    sums: Box<[f64]>,
}

impl Distribution1d {
    /// `None` where all weights are 0.
    pub fn new(weights: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut sum = 0.0;
        let sums: Box<[f64]> = weights
            .into_iter()
            .map(|w| {
                sum += positive(w);
                sum
            })
            .collect();
        (sum > 0.0 && sum.is_finite()).then_some(Self { sums })
    }

    /// The cell that `u` in [0, 1) falls into, and a number in [0, 1) that is uniform within it.
    #[inline]
    pub fn sample(&self, u: f64) -> (usize, f64) {
        let x = u * self.total();
        let cell = self.sums.partition_point(|&sum| sum <= x);
        if cell == self.sums.len() {
            // u · total was rounded up to the total: the last cell that has a weight.
            return (self.sums.partition_point(|&sum| sum < self.total()), BELOW_ONE);
        }
        let before = self.before(cell);
        (cell, ((x - before) / (self.sums[cell] - before)).clamp(0.0, BELOW_ONE))
    }

    /// Probability of a cell; 0 where there is none.
    #[inline]
    pub fn pmf(&self, cell: usize) -> f64 {
        match self.sums.get(cell) {
            Some(sum) => (sum - self.before(cell)) / self.total(),
            None => 0.0,
        }
    }

    /// Sum of the weights.
    #[inline]
    pub fn total(&self) -> f64 {
        self.sums[self.sums.len() - 1]
    }

    #[inline]
    fn before(&self, cell: usize) -> f64 {
        if cell == 0 { 0.0 } else { self.sums[cell - 1] }
    }
}

/// Cell `(column, row)` of a grid with probability proportional to its weight.
#[derive(Clone, Debug)]
pub struct Distribution2d {
    rows: Distribution1d,
    width: usize,
    /// Row by row, the sums of the weights over the row's total. `f32`, since a large map has millions; a cell of less
    /// than 6e-8 of its row may be missed.
    columns: Box<[f32]>,
}

impl Distribution2d {
    /// `weight(column, row)` of a grid of `width` × `height`; `None` where all weights are 0.
    pub fn new(width: usize, height: usize, weight: impl Fn(usize, usize) -> f64) -> Option<Self> {
        let mut columns = Vec::with_capacity(width * height);
        let mut totals = Vec::with_capacity(height);
        for row in 0..height {
            let total: f64 = (0..width).map(|column| positive(weight(column, row))).sum();
            let scale = if total > 0.0 { 1.0 / total } else { 0.0 };
            let mut sum = 0.0;
            columns.extend((0..width).map(|column| {
                sum += positive(weight(column, row));
                (sum * scale) as f32
            }));
            totals.push(total);
        }
        let rows = Distribution1d::new(totals)?;
        Some(Self { rows, width, columns: columns.into() })
    }

    /// The cell that `u` in [0, 1)² falls into, `[column, row]`, and a point in [0, 1)² that is uniform within it.
    #[inline]
    pub fn sample(&self, u: [f64; 2]) -> ([usize; 2], [f64; 2]) {
        let (row, y) = self.rows.sample(u[1]);
        let sums = &self.columns[row * self.width..][..self.width];
        // The last sum is 1 up to rounding; the comparison is with it, so that there always is a cell.
        let total = sums[self.width - 1];
        let x = (u[0] * f64::from(total)) as f32;
        let column = if x < total {
            sums.partition_point(|&sum| sum <= x)
        } else {
            sums.partition_point(|&sum| sum < total)
        };
        let before = if column == 0 { 0.0 } else { f64::from(sums[column - 1]) };
        let within = (u[0] * f64::from(total) - before) / (f64::from(sums[column]) - before);
        ([column, row], [within.clamp(0.0, BELOW_ONE), y])
    }

    /// Probability of the cell `[column, row]`, which must be within the grid.
    #[inline]
    pub fn pmf(&self, [column, row]: [usize; 2]) -> f64 {
        let sums = &self.columns[row * self.width..][..self.width];
        let before = if column == 0 { 0.0 } else { sums[column - 1] };
        let total = f64::from(sums[self.width - 1]);
        if total > 0.0 { self.rows.pmf(row) * f64::from(sums[column] - before) / total } else { 0.0 }
    }

    /// Sum of the weights.
    pub fn total(&self) -> f64 {
        self.rows.total()
    }
}

const BELOW_ONE: f64 = 1.0 - f64::EPSILON / 2.0;

#[inline]
fn positive(weight: f64) -> f64 {
    if weight > 0.0 && weight.is_finite() { weight } else { 0.0 }
}

#[cfg(test)]
mod tests;
