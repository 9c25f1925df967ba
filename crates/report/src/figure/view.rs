//! How space is seen: parallel projection, from a side that hides least.

use super::place::Layout;
use super::skeleton::{Chain, Skeleton};
use super::slide::to_segment;
use denavit::geometry::Vector;

/// A parallel projection: z of the base is up on paper, unless one looks from above.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct View {
    /// The direction of paper to the right.
    pub right: Vector<f64>,
    /// The direction of paper up.
    pub up: Vector<f64>,
    /// Towards the eye.
    pub toward: Vector<f64>,
}

impl View {
    /// From an azimuth about z (0 looks against x) and an elevation above the horizon, radians.
    pub fn from_angles(azimuth: f64, elevation: f64) -> Self {
        let ((s, c), (es, ec)) = (azimuth.sin_cos(), elevation.sin_cos());
        View {
            right: Vector([-s, c, 0.0]),
            up: Vector([-es * c, -es * s, ec]),
            toward: Vector([ec * c, ec * s, es]),
        }
    }

    /// Along an axis that points to the eye; x to the right if the axis is z.
    pub fn along(axis: Vector<f64>) -> Self {
        let norm = axis.norm();
        let toward = if norm > 0.0 { axis.scale(1.0 / norm) } else { Vector([0.0, 0.0, 1.0]) };
        let above = toward[2].abs() > 0.9;
        let up = if above { Vector([0.0, 1.0, 0.0]) } else { Vector([0.0, 0.0, 1.0]) };
        let right = up.cross(toward);
        let right = right.scale(1.0 / right.norm().max(f64::MIN_POSITIVE));
        View { right, up: toward.cross(right), toward }
    }

    /// A point on paper, metres, y up.
    pub fn flat(&self, p: Vector<f64>) -> [f64; 2] {
        [p.dot(self.right), p.dot(self.up)]
    }

    /// How near a point is to the eye.
    pub fn depth(&self, p: Vector<f64>) -> f64 {
        p.dot(self.toward)
    }
}

/// What is to be seen, metres on paper, y up.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Bounds {
    /// Lower left.
    pub min: [f64; 2],
    /// Upper right.
    pub max: [f64; 2],
}

impl Bounds {
    /// Around nothing.
    pub fn empty() -> Self {
        Bounds { min: [f64::INFINITY; 2], max: [f64::NEG_INFINITY; 2] }
    }

    /// Grows to hold a disc.
    pub fn include(&mut self, p: [f64; 2], radius: f64) {
        for (k, x) in p.into_iter().enumerate() {
            self.min[k] = self.min[k].min(x - radius);
            self.max[k] = self.max[k].max(x + radius);
        }
    }

    /// Around both.
    #[must_use]
    pub fn with(mut self, other: &Bounds) -> Self {
        for k in 0..2 {
            self.min[k] = self.min[k].min(other.min[k]);
            self.max[k] = self.max[k].max(other.max[k]);
        }
        self
    }

    /// Width and height.
    pub fn extent(&self) -> [f64; 2] {
        [0, 1].map(|k| (self.max[k] - self.min[k]).max(0.0))
    }
}

/// Where space stands on paper: points from the upper left corner.
#[derive(Clone, Copy, Debug)]
pub(super) struct Paper {
    pub view: View,
    /// Points a metre.
    pub scale: f64,
    pub origin: [f64; 2],
}

impl Paper {
    /// Bounds in the middle of a sheet, with margins; the sheet is no higher than it must be.
    pub fn fit(view: View, bounds: &Bounds, [width, height]: [f64; 2], margin: f64) -> (Self, [f64; 2]) {
        let [w, h] = bounds.extent().map(|x| x.max(1e-9));
        let [room_x, room_y] = [width, height].map(|x| (x - 2.0 * margin).max(1.0));
        let scale = (room_x / w).min(room_y / h);
        let height = (h * scale + 2.0 * margin).min(height);
        let left = (width - w * scale) / 2.0;
        let origin = [left - bounds.min[0] * scale, (height + h * scale) / 2.0 + bounds.min[1] * scale];
        (Paper { view, scale, origin }, [width, height])
    }

    pub fn at(&self, p: Vector<f64>) -> [f64; 2] {
        let [x, y] = self.view.flat(p);
        [self.origin[0] + self.scale * x, self.origin[1] - self.scale * y]
    }

    /// A direction on paper.
    pub fn along(&self, v: Vector<f64>) -> [f64; 2] {
        let [x, y] = self.view.flat(v);
        [self.scale * x, -self.scale * y]
    }
}

/// Azimuths that are tried, degrees: first those of textbooks, x towards the reader, left or right.
const AZIMUTHS: [f64; 16] = [
    -60.0, -45.0, -30.0, 30.0, 45.0, 60.0, -75.0, 75.0, -120.0, 120.0, -135.0, 135.0, -105.0, 105.0, 150.0,
    -150.0,
];

/// The view in which the parts of an arm hide each other least.
pub(super) fn choose(chain: &Chain, skeleton: &Skeleton, layout: &Layout) -> View {
    let mut best = (f64::NEG_INFINITY, View::from_angles(-0.9, 0.45));
    for (rank, azimuth) in AZIMUTHS.into_iter().enumerate() {
        for elevation in [26.0_f64, 20.0] {
            let view = View::from_angles(azimuth.to_radians(), elevation.to_radians());
            let penalty = 0.012 * rank as f64 + if elevation < 25.0 { 0.12 } else { 0.0 };
            let value = clarity(chain, skeleton, layout, &view) - penalty;
            if value > best.0 + 1e-9 {
                best = (value, view);
            }
        }
    }
    best.1
}

fn clarity(chain: &Chain, skeleton: &Skeleton, layout: &Layout, view: &View) -> f64 {
    let mut value = 0.0;
    let flat = |p: Vector<f64>| {
        let [x, y] = view.flat(p);
        Vector([x, y, 0.0])
    };
    for (i, a) in layout.symbols.iter().enumerate() {
        for b in &layout.symbols[i + 1..] {
            let wide = a.radius.max(0.8 * a.half) + b.radius.max(0.8 * b.half);
            value -= 1.5 * (1.0 - (flat(a.centre) - flat(b.centre)).norm() / wide).max(0.0);
        }
        // Links that pass over a symbol.
        for bar in layout.bars.iter().filter(|b| b.link != a.joint && b.link != a.joint + 1) {
            let near = to_segment(flat(a.centre), flat(bar.a), flat(bar.b));
            value -= 0.4 * (1.0 - near / a.radius).max(0.0);
        }
        // Axes are seen from the side, but not quite: cylinders then look round.
        let c = a.axis.dot(view.toward).abs();
        value -= 0.5 * (c - 0.75).max(0.0) / 0.25 + 0.25 * (0.2 - c).max(0.0);
    }
    for length in &skeleton.lengths {
        let seen = (flat(length.to) - flat(length.from)).norm() / (length.to - length.from).norm();
        value -= 0.6 * (0.8 - seen).max(0.0);
    }
    // The hand comes towards the eye.
    let [base, hand] = [layout.ground.0, layout.gripper.0].map(|p| view.depth(p));
    value += 0.35 * (hand - base).min(0.3 * chain.size) / chain.size;
    let extent = layout.bounds(view).extent();
    value + 0.9 * (extent[0] + 0.5 * extent[1]) / chain.size
}
