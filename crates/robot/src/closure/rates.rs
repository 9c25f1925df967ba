//! Velocities of closed loops (Khalil and Dombre 2002, ch. 7): with W_a q̇ + W_p ṗ = 0 from the twists along both sides of each cut,
//! ṗ = G q̇, G = −W_p⁻¹ W_a, and of a frame J = J_a + J_p G.

use super::linear::Factors;
use super::{Loops, Place};
use crate::geometry::{Transform, Vector};
use crate::mechanism::Link;

/// How the passive joints and a frame move with the driven joints.
#[derive(Clone, Debug)]
pub struct Rates {
    /// G: a row for each passive joint, a column for each driven one; nothing where W_p is singular.
    pub passive: Option<Vec<Vec<f64>>>,
    /// J of the frame, a column for each driven joint: the velocity of its origin along the axes of the base, then its angular velocity.
    pub frame: Option<Vec<[f64; 6]>>,
    /// How many passive motions are possible with the driven joints at rest: above 0, assembly modes meet (a parallel singularity).
    pub free: usize,
    /// Passive joints (from 0) that are left free then, one for each such motion.
    pub free_joints: Vec<usize>,
}

/// Pivots below this, by the largest, count as 0.
pub(super) const RANK: f64 = 1e-9;

impl Loops {
    /// The columns of W: for each variable, the driven ones first, the twist of the left frame of each closure against the right one,
    /// at the origin of the base, lengths by the size.
    pub(super) fn constraint(&self, all: &[f64]) -> Vec<Vec<f64>> {
        let frames = self.placed(all);
        let mut columns = vec![vec![0.0; 6 * self.sides.len()]; all.len()];
        for (k, sides) in self.sides.iter().enumerate() {
            for (sign, (link, on)) in [1.0, -1.0].into_iter().zip(sides) {
                let mut add = |twist: [f64; 6], variable: usize| {
                    for (i, x) in twist.into_iter().enumerate() {
                        let scale = if i < 3 { 1.0 / self.size } else { 1.0 };
                        columns[variable][6 * k + i] += sign * x * scale;
                    }
                };
                self.along(&frames, *on, Some(link), &mut add);
            }
        }
        columns
    }

    /// The twists of the joints on the way to a row, and of a link on it, each with its variable.
    fn along(
        &self,
        frames: &[Transform<f64>],
        on: Option<usize>,
        behind: Option<&Link<f64>>,
        add: &mut impl FnMut([f64; 6], usize),
    ) {
        let place = |row: Option<usize>| row.map_or(self.base, |r| frames[r]);
        let mut one = |link: &Link<f64>, on: Option<usize>| {
            let axis = link.axis(&place(on));
            for mover in link.movers() {
                let [v, w] = axis.twist(&mover, Vector::zero());
                add([v[0], v[1], v[2], w[0], w[1], w[2]], mover.joint);
            }
        };
        if let Some(link) = behind {
            one(link, on);
        }
        let mut next = on;
        while let Some(row) = next {
            let (link, on) = &self.links[row];
            one(link, *on);
            next = *on;
        }
    }

    /// How the passive joints and a frame, on a row with a pose there, move with the driven joints.
    ///
    /// # Panics
    /// If there is not one value for each joint.
    pub fn rates(&self, place: &Place, q: &[f64], p: &[f64]) -> Rates {
        let all = self.all(q, p);
        let n = q.len();
        let w = self.constraint(&all);
        let factors = Factors::of(&w[n..], RANK);
        let free = p.len() - factors.rank();
        let free_joints = factors.dependent();
        if free > 0 {
            return Rates { passive: None, frame: None, free, free_joints };
        }
        let solved: Vec<Vec<f64>> = w[..n].iter().map(|c| factors.solve(c)).collect();
        let g: Vec<Vec<f64>> = (0..p.len()).map(|i| solved.iter().map(|c| -c[i]).collect()).collect();
        let frames = self.placed(&all);
        let mut spatial = vec![[0.0; 6]; all.len()];
        self.along(&frames, place.0, None, &mut |twist, variable| {
            spatial[variable].iter_mut().zip(twist).for_each(|(s, t)| *s += t);
        });
        let origin = (place.0.map_or(self.base, |r| frames[r]) * place.1).translation;
        let column = |j: usize| {
            let mut sum = spatial[j];
            for (i, row) in g.iter().enumerate() {
                sum.iter_mut().zip(spatial[n + i]).for_each(|(s, t)| *s += row[j] * t);
            }
            // v = v₀ + ω × p
            let w = Vector([sum[3], sum[4], sum[5]]);
            let v = Vector([sum[0], sum[1], sum[2]]) + w.cross(origin);
            [v[0], v[1], v[2], w[0], w[1], w[2]]
        };
        Rates { frame: Some((0..n).map(column).collect()), passive: Some(g), free, free_joints }
    }
}
