//! What the robot's own dynamics make of a quantity, for bodies and a gravity that are given, or that are symbols: all is linear in
//! the numbers of each body, and affine in gravity.

use super::quantity::Quantity;
use crate::jacobians::derivative;
use denavit::description::Description;
use denavit::dynamics::{
    Dynamics, Formulas, gravity_torques, inertia_matrix, kinetic_energy, potential_energy, velocity_torques,
};
use denavit::geometry::{Body, Vector};
use denavit_symbolic::{Expr, Rational, Symbol};
use std::cell::RefCell;
use std::collections::BTreeMap;

/// How many numbers a link has.
pub(super) const NUMBERS: usize = 11;

/// The ten numbers of a body about the origin of its row's frame, and the inertia of the rotor that turns it.
pub(super) type Numbers = [Expr; NUMBERS];

/// The coordinates in which a document has its formulas.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Coordinates {
    /// The joint variables.
    Joints,
    /// Angles against the base, and the forces that belong to these.
    Absolute,
    /// Angles against the base, and the torques of the joints.
    AbsoluteWithTorques,
}

/// Joint variables, rates and accelerations.
#[derive(Clone, Debug)]
pub(super) struct State {
    pub q: Vec<Symbol>,
    pub qd: Vec<Symbol>,
    pub qdd: Vec<Symbol>,
}

/// An arm with masses as formulas.
pub(super) struct Model {
    pub state: State,
    inertia: Vec<Vec<Expr>>,
    velocity: Vec<Expr>,
    gravity: Vec<Expr>,
    /// Of each body.
    kinetic: Vec<Expr>,
    potential: Vec<Expr>,
    slopes: RefCell<BTreeMap<(usize, usize, usize), Option<Expr>>>,
}

/// The rows that move, of an arm in which each joint moves one row.
pub(super) fn moving_rows(d: &Description) -> Option<Vec<usize>> {
    let rows: Vec<usize> =
        d.rows.iter().enumerate().filter(|(_, r)| r.variable.is_some()).map(|(k, _)| k).collect();
    let joints = d.variables().len();
    (rows.len() == joints && joints > 0).then_some(rows)
}

impl Model {
    /// With bodies in the frames of the moving rows.
    pub fn new(
        d: &Description,
        rows: &[usize],
        bodies: &[Numbers],
        gravity: [Expr; 3],
        in_coordinates: Coordinates,
    ) -> Option<Model> {
        let mut d = d.clone();
        for row in &mut d.rows {
            (row.mass, row.com, row.inertia) = (None, None, None);
            (row.first_moment, row.inertia_at_origin) = (None, None);
            (row.rotor, row.viscous, row.coulomb) = (None, None, None);
        }
        for (&k, &[xx, xy, xz, yy, yz, zz, mx, my, mz, m, rotor]) in rows.iter().zip(bodies) {
            let row = &mut d.rows[k];
            row.mass = Some(m);
            row.rotor = Some(rotor);
            row.first_moment = Some([mx, my, mz]);
            row.inertia_at_origin = Some([xx, xy, xz, yy, yz, zz]);
        }
        d.gravity = Some([Expr::int(0); 3]);
        let mut formulas = Formulas::new(&d);
        formulas.dynamics.gravity = Vector(gravity);
        let arm = &formulas.dynamics;
        if arm.links.len() != rows.len() || arm.joints() != rows.len() {
            return None;
        }
        let [q, qd, _] = formulas.state();
        let alone = |k: usize| -> Dynamics<Expr> {
            let mut arm = arm.clone();
            for (i, link) in arm.links.iter_mut().enumerate() {
                if i != k {
                    link.body = Body::nothing();
                    arm.drives[i].rotor = Expr::int(0);
                }
            }
            arm
        };
        let each: Vec<Dynamics<Expr>> = (0..rows.len()).map(alone).collect();
        let model = Model {
            inertia: inertia_matrix(arm, &q),
            velocity: velocity_torques(arm, &q, &qd),
            gravity: gravity_torques(arm, &q),
            kinetic: each.iter().map(|arm| kinetic_energy(arm, &q, &qd)).collect(),
            potential: each.iter().map(|arm| potential_energy(arm, &q)).collect(),
            state: State { q: formulas.q, qd: formulas.qd, qdd: formulas.qdd },
            slopes: RefCell::default(),
        };
        Some(match in_coordinates {
            Coordinates::Joints => model,
            Coordinates::Absolute => model.in_absolute_angles(true),
            Coordinates::AbsoluteWithTorques => model.in_absolute_angles(false),
        })
    }

    /// With the angles of all links against the base in place of the joint variables.
    fn in_absolute_angles(self, moves_forces: bool) -> Model {
        let State { q, qd, qdd } = &self.state;
        let back = |e: Expr| {
            e.substitute(|s| {
                [q, qd, qdd].into_iter().find_map(|all| {
                    let k = all.iter().position(|x| *x == s)?;
                    (k > 0).then(|| Expr::from(all[k]) - Expr::from(all[k - 1]))
                })
            })
        };
        let n = q.len();
        // q = B φ with ones on the diagonal and −1 below; forces that belong to φ are Bᵀ τ.
        let columns = |row: &[Expr]| -> Vec<Expr> {
            (0..n).map(|j| if j + 1 < n { row[j] - row[j + 1] } else { row[j] }).collect()
        };
        let rows = |all: Vec<Expr>| -> Vec<Expr> { if moves_forces { columns(&all) } else { all } };
        let inertia: Vec<Vec<Expr>> = self
            .inertia
            .iter()
            .map(|row| columns(&row.iter().map(|&e| back(e)).collect::<Vec<_>>()))
            .collect();
        let by_column: Vec<Vec<Expr>> =
            (0..n).map(|j| rows(inertia.iter().map(|r| r[j]).collect())).collect();
        let inertia = (0..n).map(|i| (0..n).map(|j| by_column[j][i]).collect()).collect();
        let all = |v: &[Expr]| -> Vec<Expr> { v.iter().map(|&e| back(e)).collect() };
        Model {
            inertia,
            velocity: rows(all(&self.velocity)),
            gravity: rows(all(&self.gravity)),
            kinetic: all(&self.kinetic),
            potential: all(&self.potential),
            state: self.state.clone(),
            slopes: RefCell::default(),
        }
    }

    /// ∂A_ij/∂q_k
    fn slope(&self, i: usize, j: usize, k: usize) -> Option<Expr> {
        let key = (i.min(j), i.max(j), k);
        if let Some(known) = self.slopes.borrow().get(&key) {
            return *known;
        }
        let found = derivative(self.inertia[key.0][key.1], self.state.q[k].into());
        self.slopes.borrow_mut().insert(key, found);
        found
    }

    /// Christoffel's symbol of row i for q̇_j q̇_k.
    fn christoffel(&self, i: usize, j: usize, k: usize) -> Option<Expr> {
        let sum = self.slope(i, j, k)? + self.slope(i, k, j)? - self.slope(j, k, i)?;
        Some(Expr::from(Rational::new(1, 2)) * sum)
    }

    /// The value of a quantity; nothing for what the arm has not.
    pub fn value(&self, quantity: Quantity) -> Option<Expr> {
        let State { q, qd, qdd } = &self.state;
        let n = q.len();
        let row = |i: usize, by: &[Symbol]| {
            (0..n).fold(Expr::int(0), |sum, j| sum + self.inertia[i][j] * Expr::from(by[j]))
        };
        let all = |parts: &[Expr]| parts.iter().fold(Expr::int(0), |sum, &e| sum + e);
        let slope_of_kinetic = |i: usize| derivative(all(&self.kinetic), q[i].into());
        Some(match quantity {
            Quantity::Torque(i) => row(i, qdd) + self.velocity[i] + self.gravity[i],
            Quantity::Bias(i) => self.velocity[i] + self.gravity[i],
            Quantity::Inertial(i) => row(i, qdd),
            Quantity::Inertia(i, j) => self.inertia[i][j],
            Quantity::Velocity(i) => self.velocity[i],
            Quantity::Centrifugal(i, j) => self.christoffel(i, j, j)?,
            Quantity::Coriolis(i, j, k) => self.christoffel(i, j, k)? + self.christoffel(i, k, j)?,
            Quantity::Gravity(i) => self.gravity[i],
            Quantity::Kinetic(None) => all(&self.kinetic),
            Quantity::Kinetic(Some(k)) => *self.kinetic.get(k)?,
            Quantity::Potential(None) => all(&self.potential),
            Quantity::Potential(Some(k)) => *self.potential.get(k)?,
            Quantity::Lagrangian => all(&self.kinetic) - all(&self.potential),
            Quantity::Energy => all(&self.kinetic) + all(&self.potential),
            Quantity::Momentum(i) => row(i, qd),
            Quantity::MomentumRate(i) => row(i, qdd) + self.velocity[i] + slope_of_kinetic(i)?,
            Quantity::KineticSlope(i) => slope_of_kinetic(i)?,
            Quantity::LagrangianSlope(i) => slope_of_kinetic(i)? - self.gravity[i],
            Quantity::Christoffel(i, j, k) => self.christoffel(i, j, k)?,
            Quantity::Asada(i, j, k) => {
                self.slope(i, j, k)? - Expr::from(Rational::new(1, 2)) * self.slope(j, k, i)?
            }
            Quantity::CoriolisEntry(i, j) => {
                let mut sum = Expr::int(0);
                for (k, &rate) in qd.iter().enumerate() {
                    sum = sum + self.christoffel(i, j, k)? * Expr::from(rate);
                }
                sum
            }
            Quantity::InertiaRate(i, j) => {
                let mut sum = Expr::int(0);
                for (k, &rate) in qd.iter().enumerate() {
                    sum = sum + self.slope(i, j, k)? * Expr::from(rate);
                }
                sum
            }
        })
    }
}
