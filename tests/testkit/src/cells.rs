//! A rectangle cut into cells of about equal probability under a density.

/// Cells carry at most this much, so that narrow lobes spread over many cells too. More and smaller cells would dilute
/// what is wrong with a density over more degrees of freedom.
const LARGEST_MASS: f64 = 1.0 / 32.0;
/// All of the rectangle is halved this often both ways, whatever the density: a lobe wider than a hundredth of a side
/// cannot hide between the points of the quadrature. One that does makes a test fail, not pass.
const UNIFORM_DEPTH: u32 = 6;
/// Then it goes on where the density bends, down to 2⁻¹⁴ of a side.
const LARGEST_DEPTH: u32 = 14;
/// Quadrature error that ends the halving: far below what counts of draws can tell.
const TOLERANCE: f64 = 1e-8;
/// Gauss and Legendre's rule with four points over [0, 1].
const NODES: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// Lower corner and size.
#[derive(Clone, Copy, Debug)]
pub struct Rect {
    pub min: [f64; 2],
    pub size: [f64; 2],
}

impl Rect {
    /// The four quarters; bit 0 of the index is the upper half of the first coordinate, bit 1 of the second.
    fn quarter(self, i: usize) -> Self {
        let size = self.size.map(|s| 0.5 * s);
        let shift = |axis: usize| if i >> axis & 1 == 1 { size[axis] } else { 0.0 };
        Self { min: [self.min[0] + shift(0), self.min[1] + shift(1)], size }
    }
}

/// A tree of quarters; every leaf of the cut is one cell.
pub struct Cells {
    rect: Rect,
    nodes: Vec<Node>,
    /// Probability of each cell.
    pub masses: Vec<f64>,
}

/// Either four quarters at consecutive places, or a cell.
enum Node {
    Quarters(usize),
    Cell(usize),
}

/// Quarters with their integrals, before it is known where cells begin.
struct Mass {
    total: f64,
    quarters: Option<Box<[Mass; 4]>>,
}

impl Cells {
    /// Integrates the density over `rect` and cuts it.
    pub fn new(rect: Rect, density: &impl Fn(f64, f64) -> f64) -> Self {
        let mass = integrate(rect, density, 0, quadrature(rect, density));
        let mut cells = Self { rect, nodes: vec![Node::Cell(0)], masses: Vec::new() };
        cells.cut(0, &mass);
        cells
    }

    fn cut(&mut self, node: usize, mass: &Mass) {
        match &mass.quarters {
            Some(quarters) if mass.total > LARGEST_MASS => {
                let first = self.nodes.len();
                self.nodes[node] = Node::Quarters(first);
                self.nodes.extend((0..4).map(|_| Node::Cell(0)));
                for (i, quarter) in quarters.iter().enumerate() {
                    self.cut(first + i, quarter);
                }
            }
            _ => {
                self.nodes[node] = Node::Cell(self.masses.len());
                self.masses.push(mass.total);
            }
        }
    }

    /// Of the whole rectangle.
    pub fn total(&self) -> f64 {
        self.masses.iter().sum()
    }

    /// The cell that holds a point of the rectangle.
    pub fn find(&self, x: f64, y: f64) -> usize {
        let (mut rect, mut node) = (self.rect, 0);
        loop {
            match self.nodes[node] {
                Node::Cell(cell) => return cell,
                Node::Quarters(first) => {
                    let upper =
                        |axis: usize, x: f64| usize::from(x >= rect.min[axis] + 0.5 * rect.size[axis]);
                    let i = upper(0, x) | upper(1, y) << 1;
                    (rect, node) = (rect.quarter(i), first + i);
                }
            }
        }
    }
}

fn quadrature(rect: Rect, density: &impl Fn(f64, f64) -> f64) -> f64 {
    let mut sum = 0.0;
    for (x, weight_x) in NODES {
        for (y, weight_y) in NODES {
            let value = density(rect.min[0] + x * rect.size[0], rect.min[1] + y * rect.size[1]);
            assert!(value >= 0.0 && value.is_finite(), "density {value} in {rect:?}");
            sum += weight_x * weight_y * value;
        }
    }
    sum * rect.size[0] * rect.size[1]
}

fn integrate(rect: Rect, density: &impl Fn(f64, f64) -> f64, depth: u32, coarse: f64) -> Mass {
    if depth == LARGEST_DEPTH {
        return Mass { total: coarse, quarters: None };
    }
    let rects = [0, 1, 2, 3].map(|i| rect.quarter(i));
    let coarse_quarters = rects.map(|r| quadrature(r, density));
    let fine: f64 = coarse_quarters.iter().sum();
    if depth >= UNIFORM_DEPTH && (fine - coarse).abs() <= TOLERANCE && fine <= LARGEST_MASS {
        return Mass { total: fine, quarters: None };
    }
    let quarters = [0, 1, 2, 3].map(|i| integrate(rects[i], density, depth + 1, coarse_quarters[i]));
    Mass { total: quarters.iter().map(|q| q.total).sum(), quarters: Some(Box::new(quarters)) }
}
