//! Dynamic functions as programs: torques, inertia, accelerations, energies and their derivatives.
//!
//! All come from one program, the short one for the torques, by substitution and exact differentiation: the bias is the torque
//! without accelerations, A its derivative by them, the accelerations A⁻¹(τ − h) by A = LDLᵀ ([`solve`]), and their derivatives
//! −A⁻¹ ∂τ/∂q, −A⁻¹ ∂τ/∂q̇ and A⁻¹, with ∂τ/∂q at these accelerations. Derivatives are by elimination of vertices, in the shortest
//! of some orders at random. A may come from composite bodies, too, where that is shorter
//! and the same. What parts have in common is computed once; then each program is shortened, and held against what it was before
//! ([`held`]). A wrench that the tool exerts adds Jᵀ w to the torques ([`wrench`]). Energies are those of the plain links.

mod held;
mod solve;
mod wrench;

use super::base::inputs;
use super::direct::factored;
use super::dynamic_model::DynamicModel;
use super::energy::{kinetic_energy, potential_energy};
use super::expansion::are_equal;
use super::inertia::inertia_matrix;
use super::lagrange::{EXPANDED, Ground, program};
use super::model::{Formulas, NoNumbers};
use super::newton_euler::inverse_dynamics;
use super::short::shortest_inertia;
use super::tree::OfTree;
use crate::description::Description;
use crate::geometry::{Body, Vector};
use denavit_program::{Composer, Program, Value};
use denavit_symbolic::{Expr, Rational, Symbol};
use held::{Held, same};
use rustc_hash::{FxHashMap, FxHashSet};
use solve::Solved;
use std::cell::OnceCell;
use std::fmt;

/// Orders at random in which programs are shortened.
const ORDERS: u64 = 8;
/// Orders at random in which vertices are eliminated.
const ELIMINATIONS: u64 = 24;
/// Operations of a program up to which all these are tried.
const USUAL: u64 = 1_000;

/// A dynamic function.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum DynamicFunction {
    /// τ from q, q̇ and q̈.
    Torque,
    /// A from q, row by row.
    Inertia,
    /// h = C q̇ + Q + friction, and what holds a wrench, from q and q̇: the torque without accelerations.
    Bias,
    /// Q from q.
    Gravity,
    /// q̈ from q, q̇ and τ.
    Acceleration,
    /// The kinetic and the potential energy from q and q̇.
    Energy,
    /// ∂τ/∂q, ∂τ/∂q̇ and A side by side, row by row, from q, q̇ and q̈.
    TorqueDerivatives,
    /// ∂q̈/∂q, ∂q̈/∂q̇ and A⁻¹ side by side, row by row, from q, q̇ and τ.
    AccelerationDerivatives,
    /// τ, ∂τ/∂q, ∂τ/∂q̇ and A side by side, row by row, from q, q̇ and q̈: what the torques and their derivatives have in common once.
    TorqueWithDerivatives,
    /// q̈, ∂q̈/∂q, ∂q̈/∂q̇ and A⁻¹ side by side, row by row, from q, q̇ and τ.
    AccelerationWithDerivatives,
}

/// Which numbers of the links a program takes as parameters.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Masses {
    /// None: those of the description stand in the program, with gravity.
    Numbers,
    /// The ten of each link about the origin of its frame, XX1 … M1.
    Links,
    /// Base parameters.
    Base,
}

/// What acts on the arm beside gravity, as arguments of programs.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub struct Loads {
    /// A wrench that the tool exerts on its surroundings, about the tool's origin along the axes of the base: FX … CZ.
    pub wrench: bool,
    /// A body fixed to the tool, by its ten numbers about the tool's origin along the tool's axes: XXL … ML.
    pub payload: bool,
}

/// The dynamic functions of an arm.
#[derive(Clone, Debug)]
pub struct DynamicPrograms {
    /// The formulas, with what they rest on.
    pub model: DynamicModel,
    /// Joint variables, their rates and accelerations, and the torques that drive the arm.
    pub symbols: [Vec<Symbol>; 4],
    /// The components of the wrench; none without one.
    pub wrench: Vec<Symbol>,
    /// On what it rests that what holds the wrench is Jᵀ w: proved where there is none.
    pub wrench_ground: Ground,
    masses: Masses,
    /// Nothing of a whole tree.
    description: Option<Description>,
    /// What stands in the place of symbols of the model.
    values: FxHashMap<Symbol, Expr>,
    /// With the wrench.
    torque: Program,
    /// A, one way and another, once it was asked for.
    matrices: OnceCell<Vec<DynamicProgram>>,
    /// The torque without accelerations, once it was asked for.
    bias: OnceCell<DynamicProgram>,
    /// The derivatives of the torques by q and q̇, once they were asked for.
    by_state: OnceCell<Program>,
}

/// A dynamic function as a program.
#[derive(Clone, Debug)]
pub struct DynamicProgram {
    /// Its variables are the vectors that the function reads, one behind the other.
    pub program: Program,
    /// On what it rests that the inertia matrix in it is the derivative of the torques: proved where it is that derivative, or none
    /// is needed.
    pub inertia: Ground,
    /// Whether that matrix is one of composite bodies.
    pub by_bodies: bool,
    /// On what it rests that it computes what it did before it was shortened.
    pub shortening: Ground,
}

/// Why there is no program of a function.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum NoProgram {
    /// Base parameters do not tell energies.
    Energy,
    /// The joint, from 0, moves no mass of its own, in no state or in none of three random ones modulo a prime: no acceleration
    /// follows from torques.
    Singular(usize),
}

impl fmt::Display for NoProgram {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoProgram::Energy => f.write_str("base parameters do not tell energies"),
            NoProgram::Singular(joint) => write!(
                f,
                "joint {} moves no mass of its own: no acceleration follows from torques",
                joint + 1
            ),
        }
    }
}

impl std::error::Error for NoProgram {}

impl DynamicProgram {
    fn plain(program: Program) -> Self {
        DynamicProgram { program, inertia: Ground::Proved, by_bodies: false, shortening: Ground::Proved }
    }
}

impl DynamicFunction {
    /// All of them.
    pub const ALL: [DynamicFunction; 10] = [
        DynamicFunction::Torque,
        DynamicFunction::Inertia,
        DynamicFunction::Bias,
        DynamicFunction::Gravity,
        DynamicFunction::Acceleration,
        DynamicFunction::Energy,
        DynamicFunction::TorqueDerivatives,
        DynamicFunction::AccelerationDerivatives,
        DynamicFunction::TorqueWithDerivatives,
        DynamicFunction::AccelerationWithDerivatives,
    ];

    /// How many of q, q̇ and the third vector it reads: 1, 2 or 3.
    pub fn reads(self) -> usize {
        match self {
            DynamicFunction::Inertia | DynamicFunction::Gravity => 1,
            DynamicFunction::Bias | DynamicFunction::Energy => 2,
            DynamicFunction::Torque
            | DynamicFunction::Acceleration
            | DynamicFunction::TorqueDerivatives
            | DynamicFunction::AccelerationDerivatives
            | DynamicFunction::TorqueWithDerivatives
            | DynamicFunction::AccelerationWithDerivatives => 3,
        }
    }

    /// Whether a wrench of the tool is among what it computes or reads.
    pub fn feels_wrench(self) -> bool {
        match self {
            DynamicFunction::Inertia | DynamicFunction::Gravity | DynamicFunction::Energy => false,
            DynamicFunction::Torque
            | DynamicFunction::Bias
            | DynamicFunction::Acceleration
            | DynamicFunction::TorqueDerivatives
            | DynamicFunction::AccelerationDerivatives
            | DynamicFunction::TorqueWithDerivatives
            | DynamicFunction::AccelerationWithDerivatives => true,
        }
    }

    /// Whether the third vector is that of the torques.
    pub fn is_driven(self) -> bool {
        match self {
            DynamicFunction::Acceleration
            | DynamicFunction::AccelerationDerivatives
            | DynamicFunction::AccelerationWithDerivatives => true,
            DynamicFunction::Torque
            | DynamicFunction::Inertia
            | DynamicFunction::Bias
            | DynamicFunction::Gravity
            | DynamicFunction::Energy
            | DynamicFunction::TorqueDerivatives
            | DynamicFunction::TorqueWithDerivatives => false,
        }
    }

    /// Of a matrix that has derivatives side by side, by one vector after the other, in how many columns other results stand before
    /// them; nothing for any other function.
    pub fn before_derivatives(self) -> Option<usize> {
        match self {
            DynamicFunction::Torque
            | DynamicFunction::Inertia
            | DynamicFunction::Bias
            | DynamicFunction::Gravity
            | DynamicFunction::Acceleration
            | DynamicFunction::Energy => None,
            DynamicFunction::TorqueDerivatives | DynamicFunction::AccelerationDerivatives => Some(0),
            DynamicFunction::TorqueWithDerivatives | DynamicFunction::AccelerationWithDerivatives => Some(1),
        }
    }
}

impl DynamicPrograms {
    /// The functions of an arm. With [`Masses::Numbers`] what has a name in the description stays a parameter.
    ///
    /// # Errors
    /// With [`Masses::Numbers`]: if the description says nothing of masses. If a mass is negative.
    pub fn new(d: &Description, masses: Masses) -> Result<Self, NoNumbers> {
        Self::with_loads(d, masses, Loads::default())
    }

    /// The same with loads as arguments. The numbers of a payload are parameters, grouped with those of the last link in base
    /// parameters.
    ///
    /// # Errors
    /// With [`Masses::Numbers`]: if the description says nothing of masses. If a mass is negative.
    pub fn with_loads(d: &Description, masses: Masses, loads: Loads) -> Result<Self, NoNumbers> {
        if masses == Masses::Numbers && !d.has_masses() {
            return Err(NoNumbers::NoMasses);
        }
        d.no_negative_mass()?;
        let formulas = match masses {
            Masses::Numbers => Formulas::in_numbers(d),
            Masses::Links | Masses::Base => Formulas::named(d),
        };
        let formulas = if loads.payload { formulas.carrying() } else { formulas };
        let model = DynamicModel::of(d, formulas);
        Ok(Self::of(model, Some(d), masses, loads))
    }

    /// The functions of a whole tree: none has a tool.
    pub fn of_tree(tree: &OfTree<Expr>, masses: Masses) -> Self {
        let formulas = Formulas::of_tree(tree);
        let formulas = if masses == Masses::Numbers { formulas } else { formulas.with_names() };
        Self::of(DynamicModel::of_tree(formulas), None, masses, Loads::default())
    }

    /// Those of a model, with a wrench if there is a description of the arm.
    fn of(model: DynamicModel, d: Option<&Description>, masses: Masses, loads: Loads) -> Self {
        let mut values: FxHashMap<Symbol, Expr> = FxHashMap::default();
        if masses != Masses::Base {
            for p in &model.base.parameters {
                if p.is_grouped {
                    values.insert(p.symbol, p.value);
                }
            }
        }
        let formulas = &model.formulas;
        let drives = driving(formulas);
        let symbols = [formulas.q.clone(), formulas.qd.clone(), formulas.qdd.clone(), drives];
        let plain = with_values(&model.torques, &model.formulas, &values);
        let mut names = vec![];
        let (torque, wrench_ground) = match d.filter(|_| loads.wrench) {
            Some(d) => {
                names = wrench::names(formulas, &symbols);
                wrench::added(d, formulas, &plain, &names)
            }
            None => (plain, Ground::Proved),
        };
        DynamicPrograms {
            model,
            symbols,
            wrench: names,
            wrench_ground,
            masses,
            description: d.cloned(),
            values,
            torque,
            matrices: OnceCell::new(),
            bias: OnceCell::new(),
            by_state: OnceCell::new(),
        }
    }

    /// The parameters of the programs, in order: names of the table, then those of masses.
    pub fn parameters(&self) -> &[Symbol] {
        self.torque.parameters()
    }

    /// The program of a function.
    ///
    /// # Errors
    /// Of the energies from base parameters, which do not tell them; of accelerations where a joint moves no mass.
    pub fn program(&self, function: DynamicFunction) -> Result<DynamicProgram, NoProgram> {
        match function {
            DynamicFunction::Torque => Ok(DynamicProgram::plain(self.torque.clone())),
            DynamicFunction::Bias => Ok(self.bias().clone()),
            DynamicFunction::Gravity => Ok(self.at_rest(2)),
            DynamicFunction::TorqueDerivatives => Ok(self.slopes(false)),
            DynamicFunction::TorqueWithDerivatives => Ok(self.slopes(true)),
            DynamicFunction::Energy if self.masses == Masses::Base => Err(NoProgram::Energy),
            DynamicFunction::Energy => Ok(DynamicProgram::plain(self.energies())),
            DynamicFunction::Inertia => {
                let shortest = self.inertias().iter().min_by_key(|p| p.program.count().cost());
                Ok(shortest.expect("there is the derivative").clone())
            }
            DynamicFunction::Acceleration => self.accelerations(Solved::Accelerations),
            DynamicFunction::AccelerationDerivatives => self.accelerations(Solved::Derivatives),
            DynamicFunction::AccelerationWithDerivatives => self.accelerations(Solved::Both),
        }
    }

    /// On what it rests that a program of these computes what the function is: the torques' equality with Lagrange's, that of the
    /// wrench where the function reads it, and the program's own.
    pub fn ground(&self, function: DynamicFunction, program: &DynamicProgram) -> Ground {
        let own = self.model.ground.and(program.inertia).and(program.shortening);
        if function.feels_wrench() { own.and(self.wrench_ground) } else { own }
    }

    /// The same from the links as they are, by other ways: the plain recursion of Newton and Euler, composite bodies, and derivatives
    /// of these; the energies have one way only. For checks.
    pub fn reference(&self, function: DynamicFunction) -> Program {
        let arm = &self.model.formulas.dynamics;
        let n = arm.joints();
        let [q, qd, qdd] = self.model.formulas.state();
        let tau: Vec<Expr> = self.symbols[3].iter().map(|&s| s.into()).collect();
        let still = vec![Expr::int(0); n];
        let w: Vec<Expr> = self.wrench.iter().map(|&s| s.into()).collect();
        let exerted = (function.feels_wrench() && w.len() == 6)
            .then(|| [Vector([w[0], w[1], w[2]]), Vector([w[3], w[4], w[5]])]);
        let torque = |qd: &[Expr], qdd: &[Expr]| -> Vec<Expr> {
            let smooth = inverse_dynamics(arm, &q, qd, qdd, exerted.as_ref());
            smooth
                .into_iter()
                .zip(arm.drives.iter().zip(qd))
                .map(|(t, (d, v))| t + d.coulomb * v.sign())
                .collect()
        };
        let formulas = match function {
            DynamicFunction::Torque
            | DynamicFunction::TorqueDerivatives
            | DynamicFunction::TorqueWithDerivatives => torque(&qd, &qdd),
            DynamicFunction::Inertia => inertia_matrix(arm, &q).concat(),
            DynamicFunction::Bias => torque(&qd, &still),
            DynamicFunction::Gravity => torque(&still, &still),
            DynamicFunction::Acceleration
            | DynamicFunction::AccelerationDerivatives
            | DynamicFunction::AccelerationWithDerivatives => {
                let rest: Vec<Expr> = tau.iter().zip(torque(&qd, &still)).map(|(&t, h)| t - h).collect();
                factored(&inertia_matrix(arm, &q)).solve(&rest)
            }
            DynamicFunction::Energy => return self.energies(),
        };
        let variables = self.variables(function);
        let plain = with_values(&program(&variables, &formulas), &self.model.formulas, &self.values);
        match function.before_derivatives() {
            None => plain,
            Some(0) => plain.jacobian_by(&variables[..3 * n]),
            Some(_) => beside(&plain, &plain.jacobian_by(&variables[..3 * n])),
        }
    }

    /// The variables that a function reads: the wrench, where there is one and the function feels it, behind the others.
    pub fn variables(&self, function: DynamicFunction) -> Vec<Symbol> {
        let third = if function.is_driven() { 3 } else { 2 };
        let read = [0, 1, third].into_iter().take(function.reads());
        let state = read.flat_map(|k| self.symbols[k].iter().copied());
        let wrench = self.wrench.iter().copied().filter(|_| function.feels_wrench());
        state.chain(wrench).collect()
    }

    /// The torque without accelerations.
    fn bias(&self) -> &DynamicProgram {
        self.bias.get_or_init(|| self.at_rest(1))
    }

    /// The torques with the last `vectors` of q, q̇ and q̈ zero, from the others; with the wrench where the arm moves.
    fn at_rest(&self, vectors: usize) -> DynamicProgram {
        let kept = self.symbols[..3 - vectors].concat();
        let wrench = if vectors == 1 { &self.wrench[..] } else { &[] };
        let kept = [&kept[..], wrench].concat();
        let mut all = Composer::new(&kept, self.parameters());
        let zero = all.graph().number(&Rational::ZERO);
        let is_zero = |s: Symbol| !kept.contains(&s) && self.is_state(s);
        let torques = all.copy(&self.torque, |s| is_zero(s).then_some(zero));
        let long = DynamicProgram::plain(all.finish(&named("t", torques)));
        self.shortened(vec![long], self.orders(), Held::Expanded)
    }

    /// What a program reads beside parameters.
    fn is_state(&self, s: Symbol) -> bool {
        self.symbols[..3].iter().flatten().chain(&self.wrench).any(|k| *k == s)
    }

    /// A, one way and another.
    fn inertias(&self) -> &[DynamicProgram] {
        self.matrices.get_or_init(|| self.found_inertias())
    }

    fn found_inertias(&self) -> Vec<DynamicProgram> {
        let n = self.symbols[0].len();
        let slopes = self.unforced().jacobian_by(&self.symbols[2]);
        let triangle = |is_lower: bool| {
            let entry = |i: usize, j: usize| {
                let (high, low) = (i.max(j), i.min(j));
                if is_lower { n * high + low } else { n * low + high }
            };
            let entries: Vec<usize> = (0..n * n).map(|k| entry(k / n, k % n)).collect();
            entries
        };
        let long = [triangle(false), triangle(true)].map(|entries| {
            let mut all = Composer::new(&self.symbols[0], self.parameters());
            let values = all.copy(&slopes, |_| None);
            let entries: Vec<Value> = entries.into_iter().map(|k| values[k]).collect();
            all.finish(&named("a", entries))
        });
        // What another way gives is taken where it is the same matrix.
        let composite = self.composite().and_then(|program| {
            let inertia = match are_equal(&self.model.formulas, &program, &long[0]) {
                true => Ground::Proved,
                false => same(&program, &long[0], n <= EXPANDED),
            };
            let plain = DynamicProgram::plain(program);
            (inertia != Ground::Failed).then_some(DynamicProgram { inertia, by_bodies: true, ..plain })
        });
        let ways = long.map(|p| self.shortened(vec![DynamicProgram::plain(p)], 0, Held::Expanded));
        ways.into_iter().chain(composite).collect()
    }

    /// A by composite bodies from base parameters; nothing where a link has a mass for each direction.
    fn composite(&self) -> Option<Program> {
        let found = match &self.description {
            Some(d) => shortest_inertia(d, &self.model.formulas, &self.model.base)?,
            None => self.by_bodies()?,
        };
        let found = with_values(&found, &self.model.formulas, &self.values);
        let mut all = Composer::new(&self.symbols[0], self.parameters());
        let entries = all.copy(&found, |_| None);
        Some(all.finish(&named("a", entries)))
    }

    /// The same by the plain algorithm.
    fn by_bodies(&self) -> Option<Program> {
        let formulas = &self.model.formulas;
        let mut arm = formulas.dynamics.clone();
        for (link, own) in arm.links.iter_mut().zip(&self.model.base.links) {
            let [mass, y, z] = own.mass.0;
            if mass != y || mass != z {
                return None;
            }
            link.body = Body { inertia: own.inertia, first_moment: own.first_moment, mass };
        }
        let [q, ..] = formulas.state();
        Some(program(&formulas.q, &inertia_matrix(&arm, &q).concat()).shortened(0))
    }

    /// Orders in which programs are shortened: of whole trees the first alone.
    fn orders(&self) -> u64 {
        if self.description.is_some() { ORDERS } else { 0 }
    }

    /// ∂τ/∂q, ∂τ/∂q̇ and A, behind the torques or alone: all of them derivatives of the torques, or with the matrix that makes it the
    /// shortest.
    fn slopes(&self, with_torques: bool) -> DynamicProgram {
        let [q, qd, qdd, _] = &self.symbols;
        let n = q.len();
        let whole = |slopes: Program| if with_torques { beside(&self.torque, &slopes) } else { slopes };
        let with = |matrix: &DynamicProgram| {
            let mut all =
                Composer::new(&self.variables(DynamicFunction::TorqueDerivatives), self.parameters());
            let slopes = all.copy(self.by_state(), |_| None);
            let matrix_entries = all.copy(&matrix.program, |_| None);
            // Two of nothing side by side are nothing.
            let rows = slopes.chunks((2 * n).max(1)).zip(matrix_entries.chunks(n.max(1)));
            let entries = rows.flat_map(|(a, b)| [a, b].concat()).collect();
            DynamicProgram { program: whole(all.finish(&named("d", entries))), ..matrix.clone() }
        };
        let plain = self.jacobian_by(&[&q[..], qd, qdd].concat());
        let all = self.inertias().iter().map(with).chain([DynamicProgram::plain(whole(plain))]);
        let held = if n <= EXPANDED { Held::Expanded } else { Held::AtStates };
        self.shortened(all.collect(), 0, held)
    }

    /// ∂τ/∂q and ∂τ/∂q̇ side by side.
    fn by_state(&self) -> &Program {
        let [q, qd, ..] = &self.symbols;
        self.by_state.get_or_init(|| self.jacobian_by(&[&q[..], qd].concat()))
    }

    /// The derivatives of the torques, in fewer orders where they are long.
    fn jacobian_by(&self, variables: &[Symbol]) -> Program {
        let orders = ELIMINATIONS * USUAL / (self.torque.ops().len() as u64).max(USUAL);
        self.torque.jacobian_in_orders(variables, orders)
    }

    /// The torques of accelerations alone, at rest and without gravity: A q̈.
    fn unforced(&self) -> Program {
        let [q, qd, qdd, _] = &self.symbols;
        let mut all = Composer::new(&[&q[..], qdd].concat(), self.parameters());
        let zero = all.graph().number(&Rational::ZERO);
        let is_rest = |s: Symbol| qd.contains(&s) || self.wrench.contains(&s);
        let torques = all.copy(&self.torque, |s| is_rest(s).then_some(zero));
        let weight = all.copy(&self.torque, |s| (is_rest(s) || qdd.contains(&s)).then_some(zero));
        let graph = all.graph();
        let moving = torques.into_iter().zip(weight).map(|(t, w)| graph.sub(t, w)).collect();
        all.finish(&named("t", moving))
    }

    fn energies(&self) -> Program {
        let formulas = &self.model.formulas;
        let [q, qd, _] = formulas.state();
        let arm = &formulas.dynamics;
        let both = [kinetic_energy(arm, &q, &qd), potential_energy(arm, &q)];
        with_values(&program(&self.symbols[..2].concat(), &both), formulas, &self.values)
    }
}

/// The results of a program, each with its derivatives behind it.
fn beside(values: &Program, slopes: &Program) -> Program {
    let mut all = Composer::new(values.variables(), values.parameters());
    let rows = all.copy(values, |_| None);
    let derivatives = all.copy(slopes, |_| None);
    let columns = derivatives.len() / rows.len().max(1);
    let row = |(k, value): (usize, &Value)| [&[*value], &derivatives[columns * k..][..columns]].concat();
    let entries = rows.iter().enumerate().flat_map(row).collect();
    all.finish(&named("d", entries))
}

/// `t1`, `t2`, ….
fn named(letter: &str, values: Vec<Value>) -> Vec<(String, Value)> {
    values.into_iter().enumerate().map(|(k, v)| (format!("{letter}{}", k + 1), v)).collect()
}

/// A program with formulas in place of parameters, whose own symbols are parameters.
fn with_values(program: &Program, formulas: &Formulas, values: &FxHashMap<Symbol, Expr>) -> Program {
    let mut parameters: Vec<Symbol> =
        program.parameters().iter().copied().filter(|s| !values.contains_key(s)).collect();
    let read: FxHashSet<Symbol> = inputs(program).collect();
    let mut more: Vec<Symbol> =
        values.iter().filter(|v| read.contains(v.0)).flat_map(|v| v.1.symbols()).collect();
    more.sort_by_key(|s| formulas.parameters.iter().position(|p| p.symbol == *s));
    for s in more {
        if !parameters.contains(&s) {
            parameters.push(s);
        }
    }
    let mut all = Composer::new(program.variables(), &parameters);
    let graph = all.graph();
    let mut at: FxHashMap<Symbol, Value> = FxHashMap::default();
    for s in program.parameters().iter().filter(|s| read.contains(s)) {
        if let Some(&value) = values.get(s) {
            at.insert(*s, graph.trace(value));
        }
    }
    let results = all.copy(program, |s| at.get(&s).copied());
    let outputs: Vec<(String, Value)> = program.outputs().iter().map(|o| o.0.clone()).zip(results).collect();
    all.finish(&outputs)
}

/// Names for the torques that drive the joints: `tau1` for `q1`.
fn driving(formulas: &Formulas) -> Vec<Symbol> {
    let is_taken = |s: Symbol| formulas.parameters.iter().any(|p| p.symbol == s);
    let named = |s: &Symbol| {
        let mut name = format!("tau{}", s.name().trim_start_matches('q'));
        while is_taken(Symbol::new(&name)) {
            name.push('_');
        }
        Symbol::new(&name)
    };
    formulas.q.iter().map(named).collect()
}
