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

/// What closures allow of motions.
pub(crate) struct Allowed {
    /// Rates of all joints: so many independent motions.
    pub free: Vec<Vec<f64>>,
    /// Accelerations with which the closures hold, one of many.
    pub drift: Vec<f64>,
}

/// Pivots below this, by the largest, leave so little of accelerations that no motion is followed by them.
const NEARLY: f64 = 1e-5;
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

    /// G: how the passive joints move with the driven ones, a row for each passive joint.
    ///
    /// # Errors
    /// The passive joints, from 0, that are left free where W_p is singular.
    ///
    /// # Panics
    /// If there is not one value for each joint.
    pub fn passive_rates(&self, q: &[f64], p: &[f64]) -> Result<Vec<Vec<f64>>, Vec<usize>> {
        let w = self.constraint(&self.all(q, p));
        let n = q.len();
        let factors = Factors::of(&w[n..], RANK);
        if factors.rank() < p.len() {
            return Err(factors.dependent());
        }
        let solved: Vec<Vec<f64>> = w[..n].iter().map(|c| factors.solve(c)).collect();
        Ok((0..p.len()).map(|i| solved.iter().map(|c| -c[i]).collect()).collect())
    }

    /// Ẇ v: how fast the frames of the closures would part if no joint accelerated, as [`Loops::constraint`] has them.
    fn parting(&self, all: &[f64], rates: &[f64]) -> Vec<f64> {
        let frames = self.placed(all);
        let mut parting = vec![0.0; 6 * self.sides.len()];
        for (k, sides) in self.sides.iter().enumerate() {
            for (sign, (link, on)) in [1.0, -1.0].into_iter().zip(sides) {
                let mut twists: Vec<([f64; 6], usize)> = vec![];
                self.along(&frames, *on, Some(link), &mut |twist, variable| twists.push((twist, variable)));
                // From the base on: a twist changes as the body that carries its axis moves.
                let (mut v, mut w) = (Vector::zero(), Vector::zero());
                for (s, variable) in twists.into_iter().rev() {
                    let rate = rates[variable];
                    let (linear, angular) = (Vector([s[0], s[1], s[2]]), Vector([s[3], s[4], s[5]]));
                    let change = (w.cross(linear) + v.cross(angular)).scale(rate / self.size);
                    let turn = w.cross(angular).scale(rate);
                    for i in 0..3 {
                        parting[6 * k + i] += sign * change[i];
                        parting[6 * k + 3 + i] += sign * turn[i];
                    }
                    (v, w) = (v + linear.scale(rate), w + angular.scale(rate));
                }
            }
        }
        parting
    }

    /// The accelerations of all joints with those of the first `driven` at 0: the closures hold.
    pub(crate) fn drift(&self, all: &[f64], rates: &[f64], driven: usize) -> Vec<f64> {
        let w = self.constraint(all);
        let passive = Factors::of(&w[driven..], RANK).solve(&self.parting(all, rates));
        vec![0.0; driven].into_iter().chain(passive.into_iter().map(|x| -x)).collect()
    }

    /// The motions that the closures allow, none driven; nothing where these have lost rank, so that there are more of them than there
    /// are driven joints.
    pub(crate) fn allowed(&self, all: &[f64], rates: &[f64]) -> Option<Allowed> {
        let w = self.constraint(all);
        let factors = Factors::of(&w, NEARLY);
        let dependent = factors.dependent();
        if dependent.len() > self.driven.len() {
            return None;
        }
        let motion = |&j: &usize| {
            let mut motion: Vec<f64> = factors.solve(&w[j]).into_iter().map(|x| -x).collect();
            motion[j] = 1.0;
            motion
        };
        let drift = factors.solve(&self.parting(all, rates)).into_iter().map(|x| -x).collect();
        Some(Allowed { free: dependent.iter().map(motion).collect(), drift })
    }

    /// Puts all joints, and their rates, back to where the closures hold: by so little as an integrator is off.
    pub(crate) fn settle(&self, all: &mut [f64], rates: &mut [f64]) {
        for _ in 0..2 {
            let step = Factors::of(&self.constraint(all), RANK).solve(&self.errors(all));
            all.iter_mut().zip(step).for_each(|(x, s)| *x -= s);
        }
        let w = self.constraint(all);
        let mut off = vec![0.0; 6 * self.sides.len()];
        for (column, rate) in w.iter().zip(rates.iter()) {
            off.iter_mut().zip(column).for_each(|(o, c)| *o += c * rate);
        }
        let step = Factors::of(&w, RANK).solve(&off);
        rates.iter_mut().zip(step).for_each(|(x, s)| *x -= s);
    }

    /// How the passive joints and a frame, on a row with a pose there, move with the driven joints.
    ///
    /// # Panics
    /// If there is not one value for each joint.
    pub fn rates(&self, place: &Place, q: &[f64], p: &[f64]) -> Rates {
        let all = self.all(q, p);
        let n = q.len();
        let g = match self.passive_rates(q, p) {
            Ok(g) => g,
            Err(free_joints) => {
                return Rates { passive: None, frame: None, free: free_joints.len(), free_joints };
            }
        };
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
        Rates { frame: Some((0..n).map(column).collect()), passive: Some(g), free: 0, free_joints: vec![] }
    }
}
