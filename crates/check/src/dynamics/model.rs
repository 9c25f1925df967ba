//! What the robot's own dynamics make of a quantity, for bodies and a gravity that are given, or that are symbols: all is linear in
//! the numbers of each body, and affine in gravity.

use super::bodies::{axis, ends, joint};
use super::points::{self, Place};
use super::quantity::Quantity;
use crate::jacobians::derivative;
use denavit::description::{Description, JointKind, Row};
use denavit::dynamics::{
    Dynamics, Formulas, gravity_torques, inertia_matrix, kinetic_energy, potential_energy, velocity_torques,
};
use denavit::geometry::{Body, Vector};
use denavit_symbolic::{Expr, Rational, Symbol};
use std::cell::RefCell;
use std::collections::BTreeMap;

/// How many numbers a link has.
pub(super) const NUMBERS: usize = 24;
/// Where the numbers of its [`Rotor`] stand, the mass of its motor last, a one, its centre of mass, and the products of the centre's coordinates, xx xy xz yy yz zz.
pub(super) const ROTOR: usize = 10;
pub(super) const COUPLED: usize = 11;
pub(super) const ALONG: usize = 12;
pub(super) const MOTOR: usize = 13;
const ONE: usize = 14;
const CENTRE: usize = 15;
const PRODUCTS: usize = 18;

/// The ten numbers of a body about the origin of its row's frame, those of the rotor that turns it, and those of its centre of mass: all
/// that is said of an arm is linear in them.
pub(super) type Numbers = [Expr; NUMBERS];

/// What the rotor of a joint adds to the kinetic energy: the factors of
#[derive(Clone, Copy)]
pub(super) struct Rotor {
    /// ½ q̇²
    pub inertia: Expr,
    /// q̇ times the rate at which the link before turns about the axis
    pub coupled: Expr,
    /// half the square of the rate at which the link turns about it
    pub along: Expr,
    /// What its motor weighs, on the axis of the joint: part of the link's mass, too.
    pub mass: Expr,
}

impl Rotor {
    /// One with an inertia as the joint feels it.
    pub fn felt(inertia: Expr) -> Self {
        let o = Expr::int(0);
        Rotor { inertia, coupled: o, along: o, mass: o }
    }
}

/// The numbers of a link.
pub(super) fn numbers(ten: [Expr; 10], rotor: Rotor, centre: [Expr; 3]) -> Numbers {
    let mut all = [Expr::int(0); NUMBERS];
    all[..10].copy_from_slice(&ten);
    (all[ROTOR], all[COUPLED], all[ALONG]) = (rotor.inertia, rotor.coupled, rotor.along);
    all[MOTOR] = rotor.mass;
    all[ONE] = Expr::int(1);
    all[CENTRE..PRODUCTS].copy_from_slice(&centre);
    let pairs = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];
    for (of, (i, j)) in all[PRODUCTS..].iter_mut().zip(pairs) {
        *of = centre[i] * centre[j];
    }
    all
}

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
    /// Of each body with its rotor.
    kinetic: Vec<Expr>,
    /// Of each body without its rotor.
    of_links: Vec<Expr>,
    /// Of the mass of each motor.
    of_motors: Vec<Expr>,
    potential: Vec<Expr>,
    slopes: RefCell<BTreeMap<(usize, usize, usize), Option<Expr>>>,
    points: Points,
    /// Angles are those against the base.
    is_absolute: bool,
}

/// Where a point of a link is in the base, and the square of its speed.
type Moving = ([Expr; 3], Expr);

/// The points of an arm's links.
struct Points {
    /// The arm, without masses.
    arm: Description,
    rows: Vec<usize>,
    /// Of each link its one, its centre, and the products of this one's coordinates.
    numbers: Vec<[Expr; NUMBERS - ONE]>,
    known: RefCell<BTreeMap<(usize, Place), Option<Moving>>>,
}

/// The rows that move: those with a joint of their own, and those that follow others.
pub(super) fn moving_rows(d: &Description) -> Option<Vec<usize>> {
    let rows: Vec<usize> = (0..d.rows.len()).filter(|&k| motion(d, &d.rows[k]).is_some()).collect();
    (!d.variables().is_empty()).then_some(rows)
}

/// How a row moves, by a joint of its own or behind others.
pub(super) fn motion(d: &Description, row: &Row) -> Option<JointKind> {
    let joints = d.variables();
    let follows = |e: Expr| e.symbols().iter().any(|s| joints.iter().any(|v| v.symbol == *s));
    match row.variable {
        Some(v) => Some(v.kind),
        None if follows(row.theta) => Some(JointKind::Revolute),
        None => follows(row.d).then_some(JointKind::Prismatic),
    }
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
        d.gravity = Some([Expr::int(0); 3]);
        let points = Points {
            arm: d.clone(),
            rows: rows.to_vec(),
            numbers: bodies.iter().map(|b| std::array::from_fn(|p| b[ONE + p])).collect(),
            known: RefCell::default(),
        };
        for (&k, &[xx, xy, xz, yy, yz, zz, mx, my, mz, m, rotor, ..]) in rows.iter().zip(bodies) {
            let row = &mut d.rows[k];
            row.mass = Some(m);
            row.rotor = row.variable.is_some().then_some(rotor);
            row.first_moment = Some([mx, my, mz]);
            row.inertia_at_origin = Some([xx, xy, xz, yy, yz, zz]);
        }
        let mut formulas = Formulas::new(&d);
        formulas.dynamics.gravity = Vector(gravity);
        let arm = &formulas.dynamics;
        if arm.links.len() != rows.len() {
            return None;
        }
        // The drive that stands in each row.
        let joints = d.variables();
        let drive = |k: usize| joints.iter().position(|v| Some(*v) == d.rows[rows[k]].variable);
        let [q, qd, _] = formulas.state();
        let alone = |k: usize| -> Dynamics<Expr> {
            let mut arm = arm.clone();
            for (i, link) in arm.links.iter_mut().enumerate() {
                if i != k {
                    link.body = Body::nothing();
                    if let Some(j) = drive(i) {
                        arm.drives[j].rotor = Expr::int(0);
                    }
                }
            }
            arm
        };
        let each: Vec<Dynamics<Expr>> = (0..rows.len()).map(alone).collect();
        let of_motor = |(k, body): (usize, &Numbers)| -> Option<Expr> {
            let at = joint(&points.arm, *rows.get(k)?);
            let arm = points.with(k, &Body::about_centre(body[MOTOR], at, [Expr::int(0); 6]))?;
            Some(kinetic_energy(&arm, &q, &qd))
        };
        let model = Model {
            inertia: inertia_matrix(arm, &q),
            velocity: velocity_torques(arm, &q, &qd),
            gravity: gravity_torques(arm, &q),
            kinetic: each.iter().map(|arm| kinetic_energy(arm, &q, &qd)).collect(),
            of_links: each.iter().map(|arm| kinetic_energy(&without_rotors(arm), &q, &qd)).collect(),
            of_motors: bodies.iter().enumerate().map(of_motor).collect::<Option<_>>()?,
            potential: each.iter().map(|arm| potential_energy(arm, &q)).collect(),
            state: State { q: formulas.q, qd: formulas.qd, qdd: formulas.qdd },
            slopes: RefCell::default(),
            points,
            is_absolute: false,
        };
        let model = model.with_rotors(bodies)?;
        Some(match in_coordinates {
            Coordinates::Joints => model,
            Coordinates::Absolute => model.in_absolute_angles(true),
            Coordinates::AbsoluteWithTorques => model.in_absolute_angles(false),
        })
    }

    /// With what rotors add that turn with the link before them.
    fn with_rotors(mut self, bodies: &[Numbers]) -> Option<Model> {
        let n = self.state.q.len();
        let half = Expr::from(Rational::new(1, 2));
        let of = |all: &[Symbol]| -> Vec<Expr> { all.iter().map(|s| Expr::from(*s)).collect() };
        let (q, qd) = (of(&self.state.q), of(&self.state.qd));
        for (k, body) in bodies.iter().enumerate() {
            let (coupled, along) = (body[COUPLED], body[ALONG]);
            if coupled.is_zero() && along.is_zero() {
                continue;
            }
            // The joint of a row is known where each has one.
            if bodies.len() != n {
                return None;
            }
            // A link turns about its axis at q̇ and the rate of the link before.
            let turning = self.points.turning(k, &self.state)?;
            let before = turning - qd[k];
            self.kinetic[k] = self.kinetic[k] + coupled * qd[k] * before + half * along * turning.powi(2);
            let slopes: Option<Vec<Expr>> = qd.iter().map(|&rate| derivative(turning, rate)).collect();
            let slopes = slopes?;
            let own = |i: usize| Expr::int(i64::from(i == k));
            let entry = |i: usize, j: usize| {
                let before = |i: usize| slopes[i] - own(i);
                coupled * (own(i) * before(j) + before(i) * own(j)) + along * slopes[i] * slopes[j]
            };
            for i in 0..n {
                for j in 0..n {
                    self.inertia[i][j] = self.inertia[i][j] + entry(i, j);
                    for l in 0..n {
                        let slope = derivative(entry(i, j), q[l])? - half * derivative(entry(j, l), q[i])?;
                        self.velocity[i] = self.velocity[i] + slope * qd[j] * qd[l];
                    }
                }
            }
        }
        Some(self)
    }

    /// A formula in joint variables with the angles against the base, q̇ and q̈ likewise.
    fn back(&self, e: Expr) -> Expr {
        let State { q, qd, qdd } = &self.state;
        e.substitute(|s| {
            [q, qd, qdd].into_iter().find_map(|all| {
                let k = all.iter().position(|x| *x == s)?;
                (k > 0).then(|| Expr::from(all[k]) - Expr::from(all[k - 1]))
            })
        })
    }

    /// Where a point of a link is, and the square of its speed.
    fn point(&self, place: Place, k: usize) -> Option<Moving> {
        if let Some(known) = self.points.known.borrow().get(&(k, place)) {
            return *known;
        }
        let found = self.points.moving(place, k, &self.state).map(|(at, square)| match self.is_absolute {
            true => (at.map(|e| self.back(e)), self.back(square)),
            false => (at, square),
        });
        self.points.known.borrow_mut().insert((k, place), found);
        found
    }

    /// With the angles of all links against the base in place of the joint variables.
    fn in_absolute_angles(self, moves_forces: bool) -> Model {
        let q = &self.state.q;
        let back = |e: Expr| self.back(e);
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
            of_links: all(&self.of_links),
            of_motors: all(&self.of_motors),
            potential: all(&self.potential),
            state: self.state.clone(),
            slopes: RefCell::default(),
            points: self.points,
            is_absolute: true,
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

    /// How many bodies there are.
    pub fn bodies(&self) -> usize {
        self.kinetic.len()
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
            Quantity::Link(k) => *self.of_links.get(k)? - self.of_motors[k],
            Quantity::Motor(k) => *self.kinetic.get(k)? - self.of_links[k] + self.of_motors[k],
            Quantity::Potential(None) => all(&self.potential),
            Quantity::Potential(Some(k)) => *self.potential.get(k)?,
            Quantity::Lagrangian => all(&self.kinetic) - all(&self.potential),
            Quantity::Energy => all(&self.kinetic) + all(&self.potential),
            Quantity::Momentum(i) => row(i, qd),
            Quantity::MomentumRate(i) => row(i, qdd) + self.velocity[i] + slope_of_kinetic(i)?,
            Quantity::KineticSlope(i) => slope_of_kinetic(i)?,
            Quantity::LagrangianSlope(i) => slope_of_kinetic(i)? - self.gravity[i],
            Quantity::Coordinate(place, k, axis) => self.point(place, k)?.0[axis],
            Quantity::Rate(place, k, axis) => points::rate(self.point(place, k)?.0[axis], &self.state)?,
            Quantity::Slope(place, k, axis, j) => {
                derivative(self.point(place, k)?.0[axis], Expr::from(*q.get(j)?))?
            }
            Quantity::Speed(place, k) => self.point(place, k)?.1,
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

fn without_rotors(arm: &Dynamics<Expr>) -> Dynamics<Expr> {
    let mut arm = arm.clone();
    arm.drives.iter_mut().for_each(|drive| drive.rotor = Expr::int(0));
    arm
}

impl Points {
    /// The arm with one body, in the frame of a link's row.
    fn with(&self, k: usize, body: &Body<Expr>) -> Option<Dynamics<Expr>> {
        let mut d = self.arm.clone();
        let row = &mut d.rows[*self.rows.get(k)?];
        row.mass = Some(body.mass);
        row.first_moment = Some(body.first_moment.0);
        row.inertia_at_origin = Some(body.inertia);
        Some(Formulas::new(&d).dynamics)
    }

    /// The derivative by a joint's rate of half the square of the rate at which its link turns about its axis.
    fn turning(&self, k: usize, state: &State) -> Option<Expr> {
        let axis = axis(&self.arm, *self.rows.get(k)?);
        let about = |i: usize, j: usize| axis[i] * axis[j];
        let inertia = [about(0, 0), about(0, 1), about(0, 2), about(1, 1), about(1, 2), about(2, 2)];
        let arm = self.with(k, &Body { inertia, ..Body::nothing() })?;
        let [q, qd] =
            [&state.q, &state.qd].map(|all| -> Vec<Expr> { all.iter().map(|s| Expr::from(*s)).collect() });
        derivative(kinetic_energy(&arm, &q, &qd), qd[k])
    }

    /// Where a point of a link is in the base, and the square of its speed: those of a body of one kilogram there.
    fn moving(&self, place: Place, k: usize, state: &State) -> Option<Moving> {
        let [one, x, y, z, xx, xy, xz, yy, yz, zz] = *self.numbers.get(k)?;
        let body = match place {
            Place::Centre => Body {
                mass: one,
                first_moment: Vector([x, y, z]),
                inertia: [yy + zz, -xy, -xz, xx + zz, -yz, xx + yy],
            },
            Place::End(of) => {
                let end = *ends(&self.arm, self.rows[k]).get(of)?;
                Body::about_centre(one, end, [Expr::int(0); 6])
            }
        };
        let mut arm = self.with(k, &body)?;
        let [q, qd] =
            [&state.q, &state.qd].map(|all| -> Vec<Expr> { all.iter().map(|s| Expr::from(*s)).collect() });
        let square = Expr::int(2) * kinetic_energy(&arm, &q, &qd);
        let at = std::array::from_fn(|axis| {
            arm.gravity = Vector(std::array::from_fn(|i| Expr::int(if i == axis { -1 } else { 0 })));
            potential_energy(&arm, &q)
        });
        Some((at, square))
    }
}
