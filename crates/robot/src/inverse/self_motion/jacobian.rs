//! The scaled Jacobian of the hand and its singular values.
//!
//! Rows: the rotation (radians) and the displacement by a length, in the base; those that a goal does not give are 0.
//! Columns: the joints, slides by the same length, so that all entries are without dimension.

use crate::geometry::{Transform, Vector};
use crate::inverse::derivation::Goal;
use crate::robot::Robot;

/// What a configuration is measured with.
#[derive(Clone, Copy, Debug)]
pub(in crate::inverse) struct Frame<'a> {
    pub robot: &'a Robot<f64>,
    pub goal: Goal,
    /// Whether a joint turns.
    pub is_angle: &'a [bool],
    /// What lengths are divided by, metres.
    pub size: f64,
}

/// J = U Σ Vᵀ: the right singular vectors, the longest image first, and their images σᵢuᵢ.
#[derive(Clone, Debug)]
pub(in crate::inverse) struct Singular {
    pub vectors: Vec<Vec<f64>>,
    pub images: Vec<[f64; 6]>,
    pub values: Vec<f64>,
}

impl Frame<'_> {
    /// A unit of a joint: a radian, or the length.
    pub fn unit(&self, joint: usize) -> f64 {
        if self.is_angle[joint] { 1.0 } else { self.size }
    }

    /// One column a joint.
    pub fn jacobian(&self, q: &[f64]) -> Vec<[f64; 6]> {
        let hand = self.robot.pose(q);
        let tool = hand.rotation.z();
        let mut columns = vec![[0.0; 6]; q.len()];
        let mut before = self.robot.base;
        for link in &self.robot.links {
            let screw = before * link.before;
            let z = screw.rotation.z();
            let lever = z.cross(hand.translation - screw.translation);
            for &(j, k) in &link.theta.terms {
                for i in 0..3 {
                    columns[j][i] += k * z[i];
                    columns[j][3 + i] += k * lever[i] / self.size;
                }
            }
            for &(j, k) in &link.d.terms {
                for i in 0..3 {
                    columns[j][3 + i] += k * z[i] / self.size;
                }
            }
            before = before * link.transform(q);
        }
        for (j, c) in columns.iter_mut().enumerate() {
            let turn = Vector([c[0], c[1], c[2]]);
            let seen = match self.goal {
                Goal::Pose => turn,
                Goal::Position => Vector([0.0; 3]),
                // Turning about the tool's axis does not move it.
                Goal::PositionAndAxis => turn - tool.scale(tool.dot(turn)),
            };
            c[..3].copy_from_slice(&seen.0);
            let unit = self.unit(j);
            c.iter_mut().for_each(|x| *x *= unit);
        }
        columns
    }

    /// The singular values at a configuration.
    pub fn singular(&self, q: &[f64]) -> Singular {
        singular(self.jacobian(q))
    }

    /// The error of a pose as rotation vector and displacement by the length, both in the base.
    pub fn error(&self, wanted: &Transform<f64>, q: &[f64]) -> [f64; 6] {
        let have = self.robot.pose(q);
        let (a, b) = (&have.rotation, &wanted.rotation);
        let turn = match self.goal {
            Goal::Position => Vector([0.0; 3]),
            Goal::PositionAndAxis => a.z().cross(b.z()),
            Goal::Pose => (a.x().cross(b.x()) + a.y().cross(b.y()) + a.z().cross(b.z())).scale(0.5),
        };
        let d = (wanted.translation - have.translation).scale(1.0 / self.size);
        [turn[0], turn[1], turn[2], d[0], d[1], d[2]]
    }
}

impl Singular {
    /// The joints' motion, in units, whose image is nearest to `e`, of those in the span of the first `rank` vectors.
    pub fn solve(&self, e: &[f64; 6], rank: usize) -> Vec<f64> {
        let mut x = vec![0.0; self.vectors.len()];
        for ((v, w), sigma) in self.vectors.iter().zip(&self.images).zip(&self.values).take(rank) {
            if *sigma < f64::MIN_POSITIVE {
                continue;
            }
            let k = dot(w, e) / (sigma * sigma);
            x.iter_mut().zip(v).for_each(|(x, v)| *x += k * v);
        }
        x
    }
}

/// Jacobi's method from one side: columns are turned in pairs until all are orthogonal (Hestenes 1958).
fn singular(mut columns: Vec<[f64; 6]>) -> Singular {
    let n = columns.len();
    let mut v: Vec<Vec<f64>> =
        (0..n).map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect()).collect();
    let total: f64 = columns.iter().map(|c| dot(c, c)).sum();
    for _ in 0..30 {
        let mut is_done = true;
        for i in 0..n {
            for j in i + 1..n {
                let (a, b) = (dot(&columns[i], &columns[i]), dot(&columns[j], &columns[j]));
                let c = dot(&columns[i], &columns[j]);
                // A column of rounding errors has no direction.
                if c * c <= 1e-31 * a * b || a.min(b) <= 1e-31 * total {
                    continue;
                }
                is_done = false;
                let zeta = (b - a) / (2.0 * c);
                let t = zeta.signum() / (zeta.abs() + zeta.hypot(1.0));
                let (cos, sin) = (1.0 / t.hypot(1.0), t / t.hypot(1.0));
                let (ci, cj) = (columns[i], columns[j]);
                for k in 0..6 {
                    columns[i][k] = cos * ci[k] - sin * cj[k];
                    columns[j][k] = sin * ci[k] + cos * cj[k];
                }
                let (left, right) = v.split_at_mut(j);
                for (x, y) in left[i].iter_mut().zip(&mut right[0]) {
                    (*x, *y) = (cos * *x - sin * *y, sin * *x + cos * *y);
                }
            }
        }
        if is_done {
            break;
        }
    }
    let mut order: Vec<usize> = (0..n).collect();
    let length = |c: &[f64; 6]| dot(c, c).sqrt();
    order.sort_by(|&a, &b| length(&columns[b]).total_cmp(&length(&columns[a])));
    Singular {
        vectors: order.iter().map(|&k| v[k].clone()).collect(),
        images: order.iter().map(|&k| columns[k]).collect(),
        values: order.iter().map(|&k| length(&columns[k])).collect(),
    }
}

fn dot(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}
