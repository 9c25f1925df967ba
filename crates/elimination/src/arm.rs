//! The arm in normal form: `T = B Z₁(q₁) A₁ Z₂(q₂) A₂ … Z₆(q₆) A₆`.
//!
//! `Z` turns about z by the angle `q` (rad) or moves along z by `q` (the arm's unit of length). Conventions, offsets and
//! fixed joints are folded into the constants `B` and `A`.

use crate::rigid::{Rigid, cross, dot};

/// What a joint does along its z axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joint {
    /// Turns.
    Revolute,
    /// Slides.
    Prismatic,
}

/// Six joints and the constant transforms around them.
#[derive(Clone, Debug, PartialEq)]
pub struct Arm {
    /// `B`: the first joint's frame in the base.
    pub base: Rigid,
    /// The joints, from the base on.
    pub joints: [Joint; 6],
    /// `A₁ … A₆`: what follows each joint.
    pub links: [Rigid; 6],
}

impl Arm {
    /// Where the tool is at the configuration `q`.
    pub fn pose(&self, q: &[f64; 6]) -> Rigid {
        let mut pose = self.base;
        for ((&joint, link), &q) in self.joints.iter().zip(&self.links).zip(q) {
            pose = pose.then(&motion(joint, q)).then(link);
        }
        pose
    }

    /// Half the sum of the lengths between the joints, which makes lengths comparable to angles; 1 if there are none.
    pub fn size(&self) -> f64 {
        let sum: f64 =
            self.links[..5].iter().map(|link| dot(link.translation, link.translation).sqrt()).sum();
        if sum > 0.0 { sum / 2.0 } else { 1.0 }
    }

    /// The same arm with lengths multiplied by `factor`.
    pub fn scaled(&self, factor: f64) -> Arm {
        Arm {
            base: self.base.scaled(factor),
            joints: self.joints,
            links: self.links.map(|link| link.scaled(factor)),
        }
    }

    /// The geometric Jacobian at `q` in the base frame: a column `(velocity of the tool's origin, turn)` per joint.
    pub fn jacobian(&self, q: &[f64; 6]) -> [[f64; 6]; 6] {
        let (mut pose, mut axes) = (self.base, [([0.0; 3], [0.0; 3]); 6]);
        for (i, axis) in axes.iter_mut().enumerate() {
            let r = &pose.rotation;
            *axis = ([r[0][2], r[1][2], r[2][2]], pose.translation);
            pose = pose.then(&motion(self.joints[i], q[i])).then(&self.links[i]);
        }
        let end = pose.translation;
        let mut columns = [[0.0; 6]; 6];
        for (i, (z, o)) in axes.into_iter().enumerate() {
            let (linear, turn) = match self.joints[i] {
                Joint::Revolute => (cross(z, [end[0] - o[0], end[1] - o[1], end[2] - o[2]]), z),
                Joint::Prismatic => (z, [0.0; 3]),
            };
            columns[i] = [linear[0], linear[1], linear[2], turn[0], turn[1], turn[2]];
        }
        columns
    }

    /// The smallest singular value of the geometric Jacobian at `q`, lengths divided by [`Arm::size`].
    pub fn smallest_singular_value(&self, q: &[f64; 6]) -> f64 {
        let size = self.size();
        let mut q = *q;
        for (q, joint) in q.iter_mut().zip(&self.joints) {
            if *joint == Joint::Prismatic {
                *q /= size;
            }
        }
        smallest_singular_value(self.scaled(1.0 / size).jacobian(&q))
    }
}

/// The motion of a joint.
pub(crate) fn motion(joint: Joint, q: f64) -> Rigid {
    match joint {
        Joint::Revolute => Rigid::about_z(q.cos(), q.sin()),
        Joint::Prismatic => Rigid::along_z(q),
    }
}

/// The smallest singular value of a square matrix given by columns: one-sided Jacobi rotations (Hestenes 1958).
pub(crate) fn smallest_singular_value(mut columns: [[f64; 6]; 6]) -> f64 {
    let product = |a: &[f64; 6], b: &[f64; 6]| -> f64 { a.iter().zip(b).map(|(x, y)| x * y).sum() };
    for _ in 0..30 {
        let mut turned = false;
        for i in 0..5 {
            for j in i + 1..6 {
                let (a, b) = (columns[i], columns[j]);
                let (aa, bb, ab) = (product(&a, &a), product(&b, &b), product(&a, &b));
                if ab * ab <= 1e-30 * aa * bb {
                    continue;
                }
                turned = true;
                let zeta = (bb - aa) / (2.0 * ab);
                let t = zeta.signum() / (zeta.abs() + (1.0 + zeta * zeta).sqrt());
                let c = 1.0 / (1.0 + t * t).sqrt();
                for k in 0..6 {
                    columns[i][k] = c * (a[k] - t * b[k]);
                    columns[j][k] = c * (b[k] + t * a[k]);
                }
            }
        }
        if !turned {
            break;
        }
    }
    columns.iter().map(|column| product(column, column)).fold(f64::INFINITY, f64::min).sqrt()
}
