//! The recursion of Newton and Euler written out: a name for every quantity, outward link by link, and inward; and on what each
//! rests.
//!
//! The links' velocities and accelerations are held against the derivatives by time of the plain product of the transforms, the
//! torques against Lagrange's equations.

use super::base::{BaseModel, of_link};
use super::lagrange::{Ground, program};
use super::model::{Formulas, Link, Wrench};
use super::newton_euler::{Motion, carried, carried_on, spread};
use crate::description::{Description, JointKind};
use crate::geometry::{Rotation, Transform, Vector};
use denavit_program::Program;
use denavit_symbolic::{Expr, Symbol};
use rustc_hash::{FxHashMap, FxHashSet};

/// A quantity with the formula that gives it.
pub type Named = (Symbol, Expr);

/// The recursion.
#[derive(Clone, Debug)]
pub struct Recursion {
    /// Outward, base first.
    pub outward: Vec<Outward>,
    /// Inward, the last link first.
    pub inward: Vec<Inward>,
    /// The torques of the joints by those at the axes, and with rotors and friction, where they are not the same.
    pub torques: Vec<Named>,
    /// On what it rests that these are the torques of Lagrange's equations.
    pub ground: Ground,
}

/// How a link moves, in its frame, from how the link before does. What is 0, a number or another quantity itself has no name.
#[derive(Clone, Debug)]
pub struct Outward {
    /// The link, from 0.
    pub link: usize,
    /// Its frame in that of the link before.
    pub place: Transform<Expr>,
    /// ω, ω̇, U and the acceleration of the origin less gravity.
    pub steps: Vec<Named>,
    /// On what it rests that ω, ω̇ and the acceleration are those of the product of the transforms.
    pub ground: Ground,
}

/// The wrench that moves a link and those behind it, about the origin of its frame.
#[derive(Clone, Debug)]
pub struct Inward {
    /// The link, from 0.
    pub link: usize,
    /// Force and moment.
    pub steps: Vec<Named>,
    /// Whether the torque is the moment about its axis, or the force along it.
    pub kind: JointKind,
    /// The torque at its axis.
    pub torque: Expr,
}

/// Names quantities.
struct Steps {
    all: Vec<Named>,
    taken: FxHashSet<Symbol>,
}

impl Steps {
    /// The quantity by its name; itself where it needs none.
    fn name(&mut self, name: String, e: Expr) -> Expr {
        let is_plain = |e: Expr| e.as_number().is_some() || e.as_symbol().is_some();
        let is_negative = matches!(e.node(), denavit_symbolic::Node::Neg(a) if is_plain(a));
        if is_plain(e) || is_negative {
            return e;
        }
        let symbol = self.free(name);
        self.all.push((symbol, e));
        symbol.into()
    }

    /// A name that nothing else has, an underscore behind it where another has it.
    fn free(&mut self, name: String) -> Symbol {
        let mut symbol = Symbol::new(&name);
        while !self.taken.insert(symbol) {
            symbol = Symbol::new(&format!("{}_", symbol.name()));
        }
        symbol
    }

    fn vector(&mut self, letter: &str, link: usize, v: Vector<Expr>) -> Vector<Expr> {
        Vector([0, 1, 2].map(|i| self.name(format!("{letter}{}{}", link + 1, ["x", "y", "z"][i]), v[i])))
    }

    fn take(&mut self) -> Vec<Named> {
        std::mem::take(&mut self.all)
    }
}

impl Recursion {
    /// The recursion in base parameters.
    pub fn derive(d: &Description, formulas: &Formulas, base: &BaseModel) -> Self {
        let arm = &formulas.dynamics;
        let [q, qd, qdd] = formulas.state();
        let given =
            formulas.parameters.iter().map(|p| p.symbol).chain(base.parameters.iter().map(|p| p.symbol));
        let taken = given.chain([&formulas.q[..], &formulas.qd, &formulas.qdd].concat()).collect();
        let mut steps = Steps { all: vec![], taken };
        let (rates, changes) = (arm.rates(&qd), arm.rates(&qdd));
        let (mut outward, mut motions): (Vec<Outward>, Vec<Motion<Expr>>) = (vec![], vec![]);
        let mut known: Vec<Named> = vec![];
        let wanted = definition(formulas);
        for (k, link) in arm.links.iter().enumerate() {
            let motion = moved(&mut steps, k, link, motions.last(), &q, (rates[k], changes[k]), -arm.gravity);
            let own = steps.take();
            known.extend(own.iter().copied());
            let shown: Vec<Expr> =
                [motion.turning, motion.turning_rate, motion.acceleration].iter().flat_map(|v| v.0).collect();
            let ground = base.equality(d, formulas, &traced(formulas, &known, &shown), &wanted[k]);
            outward.push(Outward { link: k, place: motion.place, steps: own, ground });
            motions.push(motion);
        }
        let (mut inward, mut axes) = (vec![], vec![Expr::int(0); arm.links.len()]);
        let mut behind: Wrench<Expr> = [Vector::zero(); 2];
        for k in (0..arm.links.len()).rev() {
            let [own_force, own_moment] = of_link(&base.links[k], &motions[k]);
            let force = steps.vector("f", k, own_force + behind[0]);
            let moment = steps.vector("n", k, own_moment + behind[1]);
            let kind = arm.links[k].kind;
            let torque = if kind == JointKind::Revolute { moment[2] } else { force[2] };
            axes[k] = torque;
            let own = steps.take();
            known.extend(own.iter().copied());
            inward.push(Inward { link: k, steps: own, kind, torque });
            behind = carried(&motions[k].place, [force, moment]);
        }
        let mut all = arm.at_joints(&axes);
        for (j, (torque, drive)) in all.iter_mut().zip(&arm.drives).enumerate() {
            *torque = *torque + drive.torque(qd[j], qdd[j]) + drive.coulomb * qd[j].sign();
        }
        let ground = base.ground(d, formulas, &traced(formulas, &known, &all));
        let torques = all.iter().enumerate().map(|(j, &e)| (steps.free(format!("t{}", j + 1)), e)).collect();
        Recursion { outward, inward, torques, ground }
    }

    /// The names of all quantities.
    pub fn names(&self) -> impl Iterator<Item = Symbol> {
        let outward = self.outward.iter().flat_map(|o| &o.steps);
        outward.chain(self.inward.iter().flat_map(|i| &i.steps)).chain(&self.torques).map(|s| s.0)
    }
}

/// How a link moves, its quantities by names.
fn moved(
    steps: &mut Steps,
    k: usize,
    link: &Link<Expr>,
    before: Option<&Motion<Expr>>,
    q: &[Expr],
    rates: (Expr, Expr),
    base: Vector<Expr>,
) -> Motion<Expr> {
    let place = link.place(q);
    let [turning, turning_rate, acceleration] = carried_on(link.kind, &place, before, rates, base);
    let turning = steps.vector("w", k, turning);
    let turning_rate = steps.vector("wd", k, turning_rate);
    let rows = spread(turning, turning_rate).rows();
    let entries = [0, 1, 2]
        .map(|i| [0, 1, 2].map(|j| steps.name(format!("U{}_{}{}", k + 1, i + 1, j + 1), rows[i][j])));
    let spread = Rotation::from_rows(entries);
    let acceleration = steps.vector("a", k, acceleration);
    Motion { place, turning, turning_rate, spread, acceleration }
}

/// Formulas of named quantities as a program from q, q̇ and q̈.
fn traced(formulas: &Formulas, known: &[Named], shown: &[Expr]) -> Program {
    let mut values: FxHashMap<Symbol, Expr> = FxHashMap::default();
    for &(symbol, e) in known {
        let value = e.substitute(|s| values.get(&s).copied());
        values.insert(symbol, value);
    }
    let all: Vec<Expr> = shown.iter().map(|e| e.substitute(|s| values.get(&s).copied())).collect();
    program(&[&formulas.q[..], &formulas.qd, &formulas.qdd].concat(), &all)
}

/// ω, ω̇ and the acceleration less gravity of each link, in its frame, by derivatives of the product of the transforms: nine
/// formulas a link.
fn definition(formulas: &Formulas) -> Vec<Program> {
    let arm = &formulas.dynamics;
    let [q, qd, qdd] = formulas.state();
    let n = q.len();
    let state = [&formulas.q[..], &formulas.qd].concat();
    let all = [&formulas.q[..], &formulas.qd, &formulas.qdd].concat();
    // By time: ∂/∂q q̇ + ∂/∂q̇ q̈.
    let by_time = |entries: &[Expr]| -> Vec<Expr> {
        let slopes = program(&state, entries).jacobian().formulas();
        let row =
            |row: &[Expr]| (0..n).fold(Expr::int(0), |sum, i| sum + row[i] * qd[i] + row[n + i] * qdd[i]);
        slopes.chunks(2 * n).map(row).collect()
    };
    let mut x = Transform::identity();
    let mut found = vec![];
    for link in &arm.links {
        x = x * link.place(&q);
        let (r, back) = (x.rotation, x.rotation.inverse());
        let entries: Vec<Expr> = r.rows().as_flattened().iter().chain(&x.translation.0).copied().collect();
        let rates = by_time(&entries);
        // RᵀṘ = ω^
        let spin = back * Rotation::from_rows([0, 1, 2].map(|i| [0, 1, 2].map(|j| rates[3 * i + j])));
        let rows = spin.rows();
        let turning = Vector([rows[2][1], rows[0][2], rows[1][0]]);
        let moving: Vec<Expr> = turning.0.iter().chain(&rates[9..12]).copied().collect();
        let changes = by_time(&moving);
        // ω̇ along the axes of the frame is the rate of ω's components there.
        let acceleration = back * (Vector([changes[3], changes[4], changes[5]]) - arm.gravity);
        let nine: Vec<Expr> = turning.0.iter().chain(&changes[..3]).chain(&acceleration.0).copied().collect();
        found.push(program(&all, &nine));
    }
    found
}
