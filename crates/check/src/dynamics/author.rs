//! What follows from what an author prints: torques from his inertia matrix, velocity torques and gravity, these from his energies.

use super::model::Model;
use super::quantity::Quantity;
use super::statements::Read;
use crate::jacobians::derivative;
use denavit_symbolic::{Expr, Rational};
use std::collections::BTreeMap;

/// The printed values of quantities, and the pieces that print them.
pub(super) struct Author<'a> {
    model: &'a Model,
    printed: BTreeMap<Quantity, Vec<(usize, Expr)>>,
}

/// A value, and the first wrong piece that it rests on.
type Found = (Expr, Option<usize>);

impl<'a> Author<'a> {
    pub fn new(model: &'a Model, read: &Read) -> Self {
        let mut printed: BTreeMap<Quantity, Vec<(usize, Expr)>> = BTreeMap::new();
        for (k, piece) in read.pieces.iter().enumerate() {
            if let [quantity] = piece.candidates[..] {
                printed.entry(quantity).or_default().push((k, piece.value));
            }
        }
        for row in &read.rows {
            let first = row.pieces[0];
            printed.entry(Quantity::Velocity(row.joint)).or_default().push((first, row.value));
        }
        Author { model, printed }
    }

    /// What a quantity is by the rest of what is printed, what is not printed taken from the robot, or from what is; nothing where nothing of that
    /// is wrong. `wrong` says of each piece by which it is wrong.
    pub fn wants(&self, quantity: Quantity, own: usize, wrong: &[Option<usize>]) -> Vec<(Expr, usize)> {
        let of = |derives| {
            let (value, by) = Asked { author: self, own, wrong, derives }.follows(quantity, 0)?;
            Some((value, by?))
        };
        [false, true].into_iter().filter_map(of).collect()
    }
}

struct Asked<'a, 'b> {
    author: &'b Author<'a>,
    own: usize,
    wrong: &'b [Option<usize>],
    /// What is not printed follows from what is.
    derives: bool,
}

impl Asked<'_, '_> {
    /// A quantity as it is printed, or as it follows.
    fn of(&self, quantity: Quantity, depth: usize) -> Option<Found> {
        if depth > 4 {
            return None;
        }
        let own = self.author.printed.get(&quantity).into_iter().flatten().find(|(k, _)| *k != self.own);
        if let Some(&(k, value)) = own {
            return Some((value, self.wrong[k]));
        }
        if let Quantity::Inertia(i, j) = quantity
            && let Some(&(k, value)) = self
                .author
                .printed
                .get(&Quantity::Inertia(j, i))
                .into_iter()
                .flatten()
                .find(|(k, _)| *k != self.own)
        {
            return Some((value, self.wrong[k]));
        }
        match self.follows(quantity, depth + 1).filter(|_| self.derives) {
            Some((value, Some(by))) => Some((value, Some(by))),
            _ => Some((self.author.model.value(quantity)?, None)),
        }
    }

    /// A quantity as it follows from others.
    fn follows(&self, quantity: Quantity, depth: usize) -> Option<Found> {
        if depth > 4 {
            return None;
        }
        let state = &self.author.model.state;
        let (n, bodies) = (state.q.len(), self.author.model.bodies());
        let sum = |parts: Vec<Found>| {
            let value = parts.iter().fold(Expr::int(0), |all, p| all + p.0);
            (value, parts.iter().filter_map(|p| p.1).min())
        };
        let inertial = |i: usize| -> Option<Found> {
            let parts = (0..n).map(|j| {
                let (a, by) = self.of(Quantity::Inertia(i, j), depth)?;
                Some((a * Expr::from(state.qdd[j]), by))
            });
            Some(sum(parts.collect::<Option<Vec<Found>>>()?))
        };
        let half = Expr::from(Rational::new(1, 2));
        let christoffel = |i: usize, j: usize, k: usize| -> Option<Found> {
            let slope = |a: usize, b: usize, by: usize| -> Option<Found> {
                let (value, wrong) = self.of(Quantity::Inertia(a, b), depth + 1)?;
                Some((derivative(value, state.q[by].into())?, wrong))
            };
            let (a, b, c) = (slope(i, j, k)?, slope(i, k, j)?, slope(j, k, i)?);
            let by = [a.1, b.1, c.1].into_iter().flatten().min();
            Some((half * (a.0 + b.0 - c.0), by))
        };
        Some(match quantity {
            Quantity::Torque(i) => sum(vec![
                inertial(i)?,
                self.of(Quantity::Velocity(i), depth)?,
                self.of(Quantity::Gravity(i), depth)?,
            ]),
            Quantity::Bias(i) => {
                sum(vec![self.of(Quantity::Velocity(i), depth)?, self.of(Quantity::Gravity(i), depth)?])
            }
            Quantity::Inertial(i) => inertial(i)?,
            Quantity::Velocity(i) => {
                let mut parts = vec![];
                for j in 0..n {
                    for k in 0..n {
                        let (value, by) = christoffel(i, j, k)?;
                        parts.push((value * Expr::from(state.qd[j]) * Expr::from(state.qd[k]), by));
                    }
                }
                sum(parts)
            }
            Quantity::Christoffel(i, j, k) => christoffel(i, j, k)?,
            Quantity::Centrifugal(i, j) => christoffel(i, j, j)?,
            Quantity::Coriolis(i, j, k) => sum(vec![christoffel(i, j, k)?, christoffel(i, k, j)?]),
            Quantity::CoriolisEntry(i, j) => {
                let parts = (0..n).map(|k| {
                    let (value, by) = christoffel(i, j, k)?;
                    Some((value * Expr::from(state.qd[k]), by))
                });
                sum(parts.collect::<Option<Vec<Found>>>()?)
            }
            Quantity::Inertia(i, j) => {
                let (kinetic, by) = self.of(Quantity::Kinetic(None), depth)?;
                let slope = derivative(derivative(kinetic, state.qd[i].into())?, state.qd[j].into())?;
                (slope, by)
            }
            Quantity::Gravity(i) => {
                let (potential, by) = self.of(Quantity::Potential(None), depth)?;
                (derivative(potential, state.q[i].into())?, by)
            }
            Quantity::Kinetic(None) => {
                let parts = (0..bodies).map(|k| self.of(Quantity::Kinetic(Some(k)), depth));
                sum(parts.collect::<Option<Vec<Found>>>()?)
            }
            Quantity::Potential(None) => {
                let parts = (0..bodies).map(|k| self.of(Quantity::Potential(Some(k)), depth));
                sum(parts.collect::<Option<Vec<Found>>>()?)
            }
            Quantity::Lagrangian => {
                let (kinetic, potential) =
                    (self.of(Quantity::Kinetic(None), depth)?, self.of(Quantity::Potential(None), depth)?);
                sum(vec![kinetic, (-potential.0, potential.1)])
            }
            Quantity::Momentum(i) => {
                let (kinetic, by) = self.of(Quantity::Kinetic(None), depth)?;
                (derivative(kinetic, state.qd[i].into())?, by)
            }
            Quantity::KineticSlope(i) => {
                let (kinetic, by) = self.of(Quantity::Kinetic(None), depth)?;
                (derivative(kinetic, state.q[i].into())?, by)
            }
            Quantity::MomentumRate(i) => {
                let (momentum, by) = self.of(Quantity::Momentum(i), depth)?;
                let mut sum = Expr::int(0);
                for j in 0..n {
                    sum = sum
                        + derivative(momentum, state.q[j].into())? * Expr::from(state.qd[j])
                        + derivative(momentum, state.qd[j].into())? * Expr::from(state.qdd[j]);
                }
                (sum, by)
            }
            Quantity::LagrangianSlope(i) => {
                let (slope, gravity) =
                    (self.of(Quantity::KineticSlope(i), depth)?, self.of(Quantity::Gravity(i), depth)?);
                sum(vec![slope, (-gravity.0, gravity.1)])
            }
            Quantity::InertiaRate(..)
            | Quantity::Link(_)
            | Quantity::Motor(_)
            | Quantity::Coordinate(..)
            | Quantity::Rate(..)
            | Quantity::Slope(..)
            | Quantity::Speed(..)
            | Quantity::Asada(..)
            | Quantity::Energy
            | Quantity::Kinetic(Some(_))
            | Quantity::Potential(Some(_)) => return None,
        })
    }
}
