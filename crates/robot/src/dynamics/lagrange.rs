//! Lagrange's equations, from the plain product of the links' transforms: what torques are by definition, and on what it rests that
//! a program computes them.
//!
//! T = ½ Σ tr(Ẋ H Ẋᵀ) with the pseudo-inertia H of a link and its transform X, V = −Σ gᵀ(M p + R MS), and
//! τ = d/dt ∂T/∂q̇ − ∂T/∂q + ∂V/∂q by exact derivatives (Uicker 1965; Khalil and Dombre, ch. 9).

use super::base::BaseModel;
use super::expansion::are_lagranges;
use super::model::{Dynamics, Formulas};
use crate::description::{Description, JointKind};
use crate::forward::{Proof, prove};
use crate::geometry::{Axis, Rotation, Transform, Vector};
use crate::random::Random;
use denavit_program::{Composer, Graph, Program, Residue, Value};
use denavit_symbolic::{Expr, Rational, Symbol, equal};
use rustc_hash::{FxHashMap, FxHashSet};

/// On what it rests that torques are those of Lagrange's equations.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Ground {
    /// Proved: the canonical forms are identical.
    Proved,
    /// The values are equal at so many random states modulo a prime of 61 bits, exactly: equality is not proved, and inequality is
    /// as good as excluded.
    Modulo(usize),
    /// The values agree in so many states, by so much of the torques' size.
    Numbers(usize, f64),
    /// They differ: a defect of the program.
    Failed,
}

impl Ground {
    /// What two together rest on.
    #[must_use]
    pub fn and(self, other: Ground) -> Ground {
        match (self, other) {
            (Ground::Failed, _) | (_, Ground::Failed) => Ground::Failed,
            (Ground::Numbers(n, x), Ground::Numbers(m, y)) => Ground::Numbers(n.min(m), x.max(y)),
            (Ground::Numbers(n, x), _) | (_, Ground::Numbers(n, x)) => Ground::Numbers(n, x),
            (Ground::Modulo(n), Ground::Modulo(m)) => Ground::Modulo(n.min(m)),
            (Ground::Modulo(n), _) | (_, Ground::Modulo(n)) => Ground::Modulo(n),
            (Ground::Proved, Ground::Proved) => Ground::Proved,
        }
    }
}

/// Joints up to which the canonical form of the plain product of the links' transforms is asked; beyond, it is too large.
pub(super) const EXPANDED: usize = 4;
/// States in which values are compared.
pub(super) const STATES: usize = 3;
/// Rounding, by the size of the torques.
pub(super) const ROUNDING: f64 = 1e-9;

/// The torques by Lagrange's equations, rotors and friction with them: `t1` … from q, q̇ and q̈.
pub fn lagrange(formulas: &Formulas) -> Program {
    let arm = &formulas.dynamics;
    let n = arm.joints();
    let [q, qd, qdd] = formulas.state();
    let (kinetic, potential) = energies(arm, &q, &qd);
    let state = [&formulas.q[..], &formulas.qd].concat();
    let slopes = program(&state, &[kinetic, potential]).jacobian().formulas();
    // Row by row: T by q and q̇, then V.
    let (by_q, momenta, weight) = (&slopes[..n], &slopes[n..2 * n], &slopes[2 * n..3 * n]);
    let rates = program(&state, momenta).jacobian().formulas();
    let torques: Vec<Expr> = (0..n)
        .map(|j| {
            let row = &rates[2 * n * j..2 * n * (j + 1)];
            let moving = (0..n).fold(Expr::int(0), |sum, i| sum + row[i] * qd[i] + row[n + i] * qdd[i]);
            moving - by_q[j]
                + weight[j]
                + arm.drives[j].viscous * qd[j]
                + arm.drives[j].coulomb * qd[j].sign()
        })
        .collect();
    program(&[&state[..], &formulas.qdd].concat(), &torques)
}

/// The same of many joints, where second derivatives of the energy, one by one, would be too many: d/dt ∂T/∂q̇ as what the momenta
/// change by along q̇ and q̈.
fn lagrange_along(formulas: &Formulas) -> Program {
    let arm = &formulas.dynamics;
    let n = arm.joints();
    let [q, qd, _] = formulas.state();
    let (kinetic, potential) = energies(arm, &q, &qd);
    let state = [&formulas.q[..], &formulas.qd].concat();
    let slopes = program(&state, &[kinetic, potential]).jacobian();
    let momenta = slopes.only(&(n..2 * n).collect::<Vec<_>>()).tangent();
    let mut all = Composer::new(&[&state[..], &formulas.qdd].concat(), slopes.parameters());
    let along: FxHashMap<Symbol, Value> = momenta.variables()[2 * n..]
        .iter()
        .zip(formulas.qd.iter().chain(&formulas.qdd))
        .map(|(&rate, &s)| (rate, all.graph().input(s)))
        .collect();
    let changes = all.copy(&momenta, |s| along.get(&s).copied());
    let slopes = all.copy(&slopes, |_| None);
    let graph = all.graph();
    let torques: Vec<(String, Value)> = (0..n)
        .map(|j| {
            let rate = Expr::from(formulas.qd[j]);
            let rubbed = graph.trace(arm.drives[j].viscous * rate + arm.drives[j].coulomb * rate.sign());
            let moving = graph.sub(changes[n + j], slopes[j]);
            let weighed = graph.add(moving, slopes[2 * n + j]);
            (format!("t{}", j + 1), graph.add(weighed, rubbed))
        })
        .collect();
    all.finish(&torques)
}

impl BaseModel {
    /// On what it rests that a program, whose results are the torques in base parameters, gives those of Lagrange's equations. Where
    /// polynomials prove it, which are had from velocities in the links' frames, the values are those of [`lagrange`], too.
    pub fn ground(&self, d: &Description, formulas: &Formulas, torques: &Program) -> Ground {
        let base: FxHashMap<Symbol, Expr> = self.parameters.iter().map(|p| (p.symbol, p.value)).collect();
        let wanted = lagrange(formulas);
        if !are_lagranges(formulas, &base, torques) {
            return self.equality(d, formulas, torques, &wanted);
        }
        match self.at_states(formulas, torques, &wanted) {
            Ground::Failed => Ground::Failed,
            _ => Ground::Proved,
        }
    }

    /// The same of a tree: by the canonical form of the product of the links' transforms where it has few joints, otherwise by values at
    /// random states.
    pub(super) fn ground_of_tree(&self, formulas: &Formulas, torques: &Program) -> Ground {
        let wanted = lagrange_along(formulas);
        if formulas.dynamics.joints() <= EXPANDED {
            let base: FxHashMap<Symbol, Expr> = self.parameters.iter().map(|p| (p.symbol, p.value)).collect();
            let own = torques.formulas().into_iter().map(|e| e.substitute(|s| base.get(&s).copied()));
            if own.zip(wanted.formulas()).all(|(a, b)| equal(a, b).is_equal()) {
                return Ground::Proved;
            }
        }
        self.at_states(formulas, torques, &wanted)
    }

    /// On what it rests that the results of a program, in base parameters, are those of another, from q, q̇ and q̈.
    pub(super) fn equality(
        &self,
        d: &Description,
        formulas: &Formulas,
        torques: &Program,
        wanted: &Program,
    ) -> Ground {
        let base: FxHashMap<Symbol, Expr> = self.parameters.iter().map(|p| (p.symbol, p.value)).collect();
        if formulas.dynamics.joints() <= EXPANDED {
            let own: Vec<Expr> =
                torques.formulas().into_iter().map(|e| e.substitute(|s| base.get(&s).copied())).collect();
            match prove(d, &program(wanted.variables(), &own), &wanted.formulas()) {
                Proof::Proved => return Ground::Proved,
                Proof::Failed | Proof::Undecided(_) => {}
            }
        }
        self.at_states(formulas, torques, wanted)
    }

    /// By values at random states.
    fn at_states(&self, formulas: &Formulas, torques: &Program, wanted: &Program) -> Ground {
        self.modulo(formulas, torques, wanted).unwrap_or_else(|| self.in_numbers(formulas, torques, wanted))
    }

    /// At random states modulo a prime; nothing where constants of the table have no value there.
    fn modulo(&self, formulas: &Formulas, torques: &Program, wanted: &Program) -> Option<Ground> {
        let mut random = Random(1965);
        let mut any = || (random.unit() * (1_u64 << 53) as f64) as u64;
        let values = program(&[], &self.parameters.iter().map(|p| p.value).collect::<Vec<_>>());
        for _ in 0..STATES {
            let mut at: FxHashMap<Symbol, Residue> = FxHashMap::default();
            let parameters = formulas.parameters.iter().map(|p| p.symbol);
            for s in parameters.chain(wanted.variables().iter().copied()) {
                at.insert(s, Residue::input(any(), any()));
            }
            let theirs = wanted.eval(|s| at.get(&s).cloned()).ok()?;
            let base = values.eval(|s| at.get(&s).cloned()).ok()?;
            at.extend(self.parameters.iter().map(|p| p.symbol).zip(base));
            let ours = torques.eval(|s| at.get(&s).cloned()).ok()?;
            for (a, b) in ours.iter().zip(&theirs) {
                match (a.get(), b.get()) {
                    (Some(a), Some(b)) if a == b => {}
                    (Some(_), Some(_)) => return Some(Ground::Failed),
                    _ => return None,
                }
            }
        }
        Some(Ground::Modulo(STATES))
    }

    fn in_numbers(&self, formulas: &Formulas, torques: &Program, wanted: &Program) -> Ground {
        let mut random = Random(1970);
        let mut worst = 0.0_f64;
        for _ in 0..STATES {
            let mut at: FxHashMap<Symbol, f64> = FxHashMap::default();
            for p in &formulas.parameters {
                at.insert(p.symbol, p.number().unwrap_or_else(|| 0.1 + random.unit()));
            }
            at.extend(wanted.variables().iter().map(|&s| (s, 2.0 * random.unit() - 1.0)));
            for p in &self.parameters {
                let value = p.value.eval(|s| at.get(&s).copied()).unwrap_or(f64::NAN);
                at.insert(p.symbol, value);
            }
            let eval = |program: &Program| program.eval(|s| at.get(&s).copied()).unwrap_or_default();
            let (ours, theirs) = (eval(torques), eval(wanted));
            let size = theirs.iter().fold(1e-3_f64, |m, x| m.max(x.abs()));
            for (a, b) in ours.iter().zip(&theirs) {
                let off = (a - b).abs() / size;
                worst = if off.is_nan() { f64::INFINITY } else { worst.max(off) };
            }
        }
        if worst <= ROUNDING { Ground::Numbers(STATES, worst) } else { Ground::Failed }
    }
}

/// Formulas as they stand, as a program; what is no variable is a parameter.
pub(super) fn program(variables: &[Symbol], formulas: &[Expr]) -> Program {
    let mut graph = Graph::new(variables, &[]);
    let name = |k: usize| format!("t{}", k + 1);
    let results: Vec<(String, Value)> =
        formulas.iter().enumerate().map(|(k, &e)| (name(k), graph.trace(e))).collect();
    Program::new(&graph, &results, |_| None, &FxHashSet::default())
}

/// A transform and how fast it changes.
struct Moving {
    x: Transform<Expr>,
    turning: Rotation<Expr>,
    velocity: Vector<Expr>,
}

/// Twice the kinetic energy halved, and the potential one.
fn energies(arm: &Dynamics<Expr>, q: &[Expr], qd: &[Expr]) -> (Expr, Expr) {
    let o = Expr::int(0);
    let half = Expr::from(Rational::new(1, 2));
    let still = Rotation::from_rows([[o; 3]; 3]);
    let base = Moving { x: Transform::identity(), turning: still, velocity: Vector([o; 3]) };
    let mut all: Vec<Moving> = vec![];
    let (mut twice, mut weight) = (o, Vector([o; 3]));
    for (link, rate) in arm.links.iter().zip(arm.rates(qd)) {
        let before = link.parent.map_or(&base, |p| &all[p]);
        let place = link.place(q);
        let (turning, velocity) = match link.kind {
            JointKind::Revolute => {
                // d/dt Rz = (axis × Rz) θ̇, column by column
                let axis = link.before.rotation.z().scale(rate);
                let columns = Axis::ALL.map(|c| axis.cross(place.rotation.column(c)));
                (Rotation::from_rows([0, 1, 2].map(|i| columns.map(|c| c[i]))), Vector([o; 3]))
            }
            JointKind::Prismatic => (still, link.before.rotation.z().scale(rate)),
        };
        let r = before.x.rotation;
        let turned = sum(&(before.turning * place.rotation), &(r * turning));
        let moved = before.velocity + before.turning * place.translation + r * velocity;
        let at = Moving { x: before.x * place, turning: turned, velocity: moved };
        let [xx, xy, xz, yy, yz, zz] = link.body.inertia;
        let trace = (xx + yy + zz) * half;
        let second =
            Rotation::from_rows([[trace - xx, -xy, -xz], [-xy, trace - yy, -yz], [-xz, -yz, trace - zz]]);
        let (mass, first) = (link.body.mass, link.body.first_moment);
        // tr(Ṙ Σ Ṙᵀ) + 2 ṗ·Ṙ MS + M ṗ²
        let spread = at.turning * second;
        let spin = (0..3).fold(o, |all, i| all + Vector(spread.rows()[i]).dot(Vector(at.turning.rows()[i])));
        let crossed = at.velocity.dot(at.turning * first);
        twice = twice + spin + (crossed + crossed) + mass * at.velocity.dot(at.velocity);
        weight = weight + at.x.translation.scale(mass) + at.x.rotation * first;
        all.push(at);
    }
    for (drive, &rate) in arm.drives.iter().zip(qd) {
        twice = twice + drive.rotor * rate * rate;
    }
    (twice * half, -arm.gravity.dot(weight))
}

fn sum(a: &Rotation<Expr>, b: &Rotation<Expr>) -> Rotation<Expr> {
    let (a, b) = (a.rows(), b.rows());
    Rotation::from_rows([0, 1, 2].map(|i| [0, 1, 2].map(|j| a[i][j] + b[i][j])))
}
