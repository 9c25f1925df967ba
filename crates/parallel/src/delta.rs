//! Delta robots: three arms that turn or slide, and rods that keep the platform parallel to the base.
//!
//! The frame stands in the middle of the base, z up, and that of the platform in the middle of the platform. Arm i stands at the angle φᵢ
//! around z, on the direction uᵢ = (cos φᵢ, sin φᵢ, 0). A drive brings the end of its arm to
//!
//! ```text
//! cᵢ = base uᵢ + s (cos α uᵢ − sin α z)      turning: s = arm, α = qᵢ;   sliding: s = qᵢ, α = slope
//! ```
//!
//! and the rod keeps |p + platform uᵢ − cᵢ| = rod. That the platform does not turn is what its parallelograms are for, and is taken so.

use crate::rates::Rates;
use denavit::geometry::Vector;

/// A leg that could be longer or shorter by less than this part of it is stretched: nothing but rounding is left of its bend.
pub(crate) const FLAT: f64 = 1e-14;

/// How the arms are driven.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Drive {
    /// An arm of this length turns; angles are below the horizontal, outwards.
    Turns(f64),
    /// A slide at this angle below the horizontal, outwards.
    Slides(f64),
}

/// Metres and radians.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Delta {
    /// From the middle of the base to the axes of the arms, or to where slides begin.
    pub base: f64,
    /// From the middle of the platform to its rods.
    pub platform: f64,
    /// The length of the rods.
    pub rod: f64,
    /// The arms' angles around z.
    pub arms: [f64; 3],
    /// How they are driven.
    pub drive: Drive,
}

/// On which side of something a solution lies.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Sign {
    /// `+`
    Plus,
    /// `-`
    Minus,
}

impl Sign {
    /// Both.
    pub const BOTH: [Sign; 2] = [Sign::Plus, Sign::Minus];

    /// `+` or `-`.
    pub fn letter(self) -> char {
        match self {
            Sign::Plus => '+',
            Sign::Minus => '-',
        }
    }

    /// 1 or −1.
    pub fn factor(self) -> f64 {
        match self {
            Sign::Plus => 1.0,
            Sign::Minus => -1.0,
        }
    }
}

/// One of the eight ways in which three legs reach a pose.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Mode {
    /// A sign for each leg.
    pub signs: [Sign; 3],
    /// The drives, radians or metres.
    pub q: [f64; 3],
}

impl Mode {
    /// `++-`.
    pub fn name(&self) -> String {
        self.signs.iter().map(|s| s.letter()).collect()
    }
}

/// The drives of the eight modes, from the two solutions of each leg.
pub(crate) fn modes(legs: [[f64; 2]; 3]) -> Vec<Mode> {
    let mode = |k: usize| {
        let signs = [k >> 2, k >> 1, k].map(|bit| Sign::BOTH[bit & 1]);
        let q = std::array::from_fn(|i| legs[i][usize::from(signs[i] == Sign::Minus)]);
        Mode { signs, q }
    };
    (0..8).map(mode).collect()
}

/// A leg that does not reach.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct OutOfReach {
    /// Which, counted from 0.
    pub leg: usize,
    /// By how many metres it is too short or too long.
    pub metres: f64,
}

/// Why there are not two positions for the drives.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum NoPosition {
    /// The spheres around the ends of the arms do not meet.
    Apart,
    /// Their centres lie on a line: they meet in a circle or not at all.
    OnALine,
}

impl Delta {
    /// uᵢ.
    fn outwards(&self, leg: usize) -> Vector<f64> {
        let (sin, cos) = self.arms[leg].sin_cos();
        Vector([cos, sin, 0.0])
    }

    /// The end of an arm.
    pub fn end(&self, leg: usize, q: f64) -> Vector<f64> {
        let (s, angle) = match self.drive {
            Drive::Turns(arm) => (arm, q),
            Drive::Slides(slope) => (q, slope),
        };
        self.outwards(leg).scale(self.base) + self.along(leg, angle).scale(s)
    }

    /// A rod, from the end of its arm to the platform.
    pub fn rod_at(&self, leg: usize, p: Vector<f64>, q: f64) -> Vector<f64> {
        p + self.outwards(leg).scale(self.platform) - self.end(leg, q)
    }

    /// cos α u − sin α z
    fn along(&self, leg: usize, angle: f64) -> Vector<f64> {
        let (sin, cos) = angle.sin_cos();
        let u = self.outwards(leg);
        Vector([cos * u[0], cos * u[1], -sin])
    }

    /// The drives of a position: each leg has two solutions, and all eight modes are closed.
    ///
    /// A turning arm: `+` is the one whose elbow is further outwards, of a platform below the base. With x along u and z down from the arm's
    /// axis to the end of its rod, x cos q + z sin q = k and h = ±√(x² + z² − k²). A slide: `+` is the one further along it.
    ///
    /// # Errors
    /// The first leg that does not reach.
    pub fn inverse(&self, p: Vector<f64>) -> Result<Vec<Mode>, OutOfReach> {
        let mut legs = [[0.0; 2]; 3];
        for (leg, both) in legs.iter_mut().enumerate() {
            *both = self.leg(leg, p)?;
        }
        Ok(modes(legs))
    }

    fn leg(&self, leg: usize, p: Vector<f64>) -> Result<[f64; 2], OutOfReach> {
        let u = self.outwards(leg);
        let w = p + u.scale(self.platform - self.base);
        match self.drive {
            Drive::Turns(arm) => {
                let (x, z) = (w.dot(u), -w[2]);
                let (across, within) = (w - Vector([x * u[0], x * u[1], w[2]]), x.hypot(z));
                let far = across.norm();
                // What of the rod lies in the plane in which the arm turns.
                let rod = self.rod * self.rod - far * far;
                if rod < 0.0 {
                    return Err(OutOfReach { leg, metres: far - self.rod });
                }
                let rod = rod.sqrt();
                let off = (within - arm - rod).max((arm - rod).abs() - within);
                if off > 1e-12 * (arm + rod) {
                    return Err(OutOfReach { leg, metres: off });
                }
                if within == 0.0 {
                    // Every angle does: none is said.
                    return Err(OutOfReach { leg, metres: 0.0 });
                }
                // h² = (within + k)(within − k) in a form that does not cancel.
                let k = (within * within + (arm - rod) * (arm + rod)) / (2.0 * arm);
                let product =
                    (within + arm + rod) * (within + arm - rod) * (within - arm + rod) * (arm + rod - within);
                let h = if off > -FLAT * (arm + rod) { 0.0 } else { product.max(0.0).sqrt() / (2.0 * arm) };
                Ok(Sign::BOTH.map(|s| (z * k - s.factor() * h * x).atan2(x * k + s.factor() * h * z)))
            }
            Drive::Slides(slope) => {
                let along = self.along(leg, slope);
                let middle = w.dot(along);
                let across = (w - along.scale(middle)).norm();
                if across > self.rod * (1.0 + 1e-12) {
                    return Err(OutOfReach { leg, metres: across - self.rod });
                }
                let is_flat = across > self.rod * (1.0 - FLAT);
                let h = if is_flat { 0.0 } else { ((self.rod + across) * (self.rod - across)).sqrt() };
                Ok(Sign::BOTH.map(|s| middle + s.factor() * h))
            }
        }
    }

    /// The positions of the platform: the two points in which the spheres around the ends of the arms meet. `+` lies on the side from
    /// which the arms go round counterclockwise, so that `-` is below a usual robot; one where they touch.
    ///
    /// # Errors
    /// If they do not meet, or in more than two points.
    pub fn forward(&self, q: &[f64; 3]) -> Result<Vec<(Sign, Vector<f64>)>, NoPosition> {
        let [a, b, c] = [0, 1, 2].map(|i| self.end(i, q[i]) - self.outwards(i).scale(self.platform));
        let (u, v) = (b - a, c - a);
        let n = u.cross(v);
        let area = n.dot(n);
        // As far apart as the ends of the arms are known.
        let reach = a.norm().max(b.norm()).max(c.norm()) + self.base + self.platform;
        if area <= 1e-26 * reach * reach * u.dot(u).max(v.dot(v)) {
            return Err(NoPosition::OnALine);
        }
        // The centre of the circle through the three, and the height of the points above it.
        let w = (u.cross(n).scale(-v.dot(v)) + v.cross(n).scale(u.dot(u))).scale(1.0 / (2.0 * area));
        let height = self.rod * self.rod - w.dot(w);
        // Not a number where numbers are too large: nothing meets there.
        if height.is_nan() || height < -1e-12 * self.rod * self.rod {
            return Err(NoPosition::Apart);
        }
        if height <= 1e-12 * self.rod * self.rod {
            return Ok(vec![(Sign::Plus, a + w)]);
        }
        let h = n.scale((height / area).sqrt());
        Ok(Sign::BOTH.map(|s| (s, a + w + h.scale(s.factor()))).to_vec())
    }

    /// J_x v = J_q q̇: a row of J_x is the direction r of a rod, and the entry of J_q is r·∂c/∂q.
    pub fn rates(&self, p: Vector<f64>, q: &[f64; 3]) -> Rates {
        let (mut rows, mut drives, mut most) = (vec![], vec![], vec![]);
        for (leg, &q) in q.iter().enumerate() {
            let r = self.rod_at(leg, p, q).scale(1.0 / self.rod);
            let (by_q, size) = match self.drive {
                // The derivative of an arm at α is the arm at α + 90°.
                Drive::Turns(arm) => (self.along(leg, q + std::f64::consts::FRAC_PI_2).scale(arm), arm),
                Drive::Slides(slope) => (self.along(leg, slope), 1.0),
            };
            rows.push(r.0);
            drives.push(r.dot(by_q));
            most.push(size);
        }
        Rates::of_translation(rows, drives, most, p)
    }
}
