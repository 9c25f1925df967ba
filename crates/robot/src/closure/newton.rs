//! Loops that no dyad solves: by Newton's method, from where they were, from 0, and from here and there.

use super::linear::Factors;
use super::{CLOSED, Loops};
use crate::description::JointKind;
use crate::geometry::{Transform, Vector};
use crate::random::Random;
use crate::space::wrapped;
use std::f64::consts::PI;

/// How often it is begun.
const STARTS: usize = 16;
/// How many steps it takes at most.
const STEPS: usize = 60;

impl Loops {
    /// Changes the variables that no step finds until all loops close.
    pub(super) fn descend(&self, all: &mut [f64], is_near: bool) -> Option<()> {
        let mut random = Random(0x5EED);
        let driven = self.driven.len();
        for start in 0..STARTS {
            let mut x = all.to_vec();
            if start > 0 || !is_near {
                for &k in &self.rest {
                    let from = if start <= usize::from(is_near) { 0.0 } else { 2.0 * random.unit() - 1.0 };
                    x[k] = match self.passive[k - driven] {
                        JointKind::Revolute => PI * from,
                        JointKind::Prismatic => self.size * from,
                    };
                }
            }
            if self.newton(&mut x) {
                for &k in &self.rest {
                    all[k] = match self.passive[k - driven] {
                        JointKind::Revolute => wrapped(x[k]),
                        JointKind::Prismatic => x[k],
                    };
                }
                return Some(());
            }
        }
        None
    }

    fn newton(&self, x: &mut [f64]) -> bool {
        let mut best = f64::INFINITY;
        for _ in 0..STEPS {
            let errors = self.errors(x);
            let size = errors.iter().fold(0.0_f64, |m, e| m.max(e.abs()));
            if size <= 1e-15 || (size <= CLOSED * 1e-3 && size >= best) {
                break;
            }
            best = best.min(size);
            let matrix = self.constraint(x);
            let columns: Vec<Vec<f64>> = self.rest.iter().map(|&k| matrix[k].clone()).collect();
            let step = Factors::of(&columns, 1e-10).solve(&errors);
            let longest = step.iter().fold(0.0_f64, |m, s| m.max(s.abs()));
            // A long step goes where the linear form says nothing.
            let by = if longest > 0.5 { 0.5 / longest } else { 1.0 };
            self.rest.iter().zip(&step).for_each(|(&k, s)| x[k] -= by * s);
        }
        self.first_apart(x).is_none()
    }

    /// For each closure the twist from the right frame to the left one, lengths by the size, as [`Loops::constraint`] has them.
    pub(super) fn errors(&self, x: &[f64]) -> Vec<f64> {
        let frames = self.placed(x);
        let one = |sides: &[_; 2]| {
            let [a, b]: [Transform<f64>; 2] = [&sides[0], &sides[1]].map(|s| self.side(&frames, s, x));
            let r = (a.rotation * b.rotation.inverse()).rows();
            let w = Vector([r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]]).scale(0.5);
            // The velocity at the origin of the base: v = ṗ − ω × p.
            let v = (a.translation - b.translation) - w.cross(b.translation);
            [v.0.map(|e| e / self.size), w.0].concat()
        };
        self.sides.iter().flat_map(one).collect()
    }
}
