//! Dynamic functions as programs: torques, inertia, accelerations, energies and their derivatives.
//!
//! All come from one program, the short one for the torques, by substitution and exact differentiation: the bias is the torque
//! without accelerations, A its derivative by them, the accelerations A⁻¹(τ − h) by A = LDLᵀ, and their derivatives
//! −A⁻¹ ∂τ/∂q, −A⁻¹ ∂τ/∂q̇ and A⁻¹, with ∂τ/∂q at these accelerations. What parts have in common is computed once. Energies are
//! those of the plain links.

use super::base::inputs;
use super::direct::factored;
use super::dynamic_model::DynamicModel;
use super::energy::{kinetic_energy, potential_energy};
use super::expansion::are_equal;
use super::inertia::inertia_matrix;
use super::lagrange::{EXPANDED, Ground, ROUNDING, STATES, program};
use super::model::{Formulas, NoNumbers};
use super::newton_euler::inverse_dynamics;
use super::short::shortest_inertia;
use crate::description::Description;
use crate::random::Random;
use denavit_program::{Composer, Program, Residue, Value};
use denavit_symbolic::{Expr, Rational, Symbol, equal};
use rustc_hash::{FxHashMap, FxHashSet};
use std::cell::OnceCell;

/// Orders at random in which programs are shortened.
const ORDERS: u64 = 8;

/// A dynamic function.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum DynamicFunction {
    /// τ from q, q̇ and q̈.
    Torque,
    /// A from q, row by row.
    Inertia,
    /// h = C q̇ + Q + friction from q and q̇: the torque without accelerations.
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

/// The dynamic functions of an arm.
#[derive(Clone, Debug)]
pub struct DynamicPrograms {
    /// The formulas, with what they rest on.
    pub model: DynamicModel,
    /// Joint variables, their rates and accelerations, and the torques that drive the arm.
    pub symbols: [Vec<Symbol>; 4],
    masses: Masses,
    description: Description,
    /// What stands in the place of symbols of the model.
    values: FxHashMap<Symbol, Expr>,
    torque: Program,
    /// A, one way and another, once it was asked for.
    matrices: OnceCell<Vec<DynamicProgram>>,
}

/// A dynamic function as a program.
#[derive(Clone, Debug)]
pub struct DynamicProgram {
    /// Its variables are the vectors that the function reads, one behind the other.
    pub program: Program,
    /// On what it rests that the inertia matrix in it is the derivative of the torques: proved where it is that derivative, or none
    /// is needed.
    pub inertia: Ground,
}

impl DynamicProgram {
    fn plain(program: Program) -> Self {
        DynamicProgram { program, inertia: Ground::Proved }
    }
}

impl DynamicFunction {
    /// All of them.
    pub const ALL: [DynamicFunction; 8] = [
        DynamicFunction::Torque,
        DynamicFunction::Inertia,
        DynamicFunction::Bias,
        DynamicFunction::Gravity,
        DynamicFunction::Acceleration,
        DynamicFunction::Energy,
        DynamicFunction::TorqueDerivatives,
        DynamicFunction::AccelerationDerivatives,
    ];

    /// How many of q, q̇ and the third vector it reads: 1, 2 or 3.
    pub fn reads(self) -> usize {
        match self {
            DynamicFunction::Inertia | DynamicFunction::Gravity => 1,
            DynamicFunction::Bias | DynamicFunction::Energy => 2,
            DynamicFunction::Torque
            | DynamicFunction::Acceleration
            | DynamicFunction::TorqueDerivatives
            | DynamicFunction::AccelerationDerivatives => 3,
        }
    }

    /// Whether the third vector is that of the torques.
    pub fn is_driven(self) -> bool {
        matches!(self, DynamicFunction::Acceleration | DynamicFunction::AccelerationDerivatives)
    }
}

impl DynamicPrograms {
    /// The functions of an arm. With [`Masses::Numbers`] what has a name in the description stays a parameter.
    ///
    /// # Errors
    /// With [`Masses::Numbers`]: if the description says nothing of masses.
    pub fn new(d: &Description, masses: Masses) -> Result<Self, NoNumbers> {
        if masses == Masses::Numbers && !d.has_masses() {
            return Err(NoNumbers::NoMasses);
        }
        let model = match masses {
            Masses::Numbers => DynamicModel::with_numbers(d),
            Masses::Links | Masses::Base => DynamicModel::derive(d),
        };
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
        let torque = with_values(&model.torques, &model.formulas, &values);
        let (description, matrices) = (d.clone(), OnceCell::new());
        Ok(DynamicPrograms { model, symbols, masses, description, values, torque, matrices })
    }

    /// The parameters of the programs, in order: names of the table, then those of masses.
    pub fn parameters(&self) -> &[Symbol] {
        self.torque.parameters()
    }

    /// The program of a function; nothing for the energies from base parameters, which do not tell them.
    pub fn program(&self, function: DynamicFunction) -> Option<DynamicProgram> {
        let plain = match function {
            DynamicFunction::Torque => self.torque.clone(),
            DynamicFunction::Bias => self.at_rest(1),
            DynamicFunction::Gravity => self.at_rest(2),
            DynamicFunction::TorqueDerivatives => return self.slopes(),
            DynamicFunction::Energy if self.masses == Masses::Base => return None,
            DynamicFunction::Energy => self.energies(),
            DynamicFunction::Inertia => return shortest(self.inertias()),
            DynamicFunction::Acceleration => return self.accelerations(false),
            DynamicFunction::AccelerationDerivatives => return self.accelerations(true),
        };
        Some(DynamicProgram::plain(plain))
    }

    /// The same from the links as they are, by other ways: the plain recursion of Newton and Euler, composite bodies, and derivatives
    /// of these; the energies have one way only. For checks.
    pub fn reference(&self, function: DynamicFunction) -> Program {
        let arm = &self.model.formulas.dynamics;
        let n = arm.joints();
        let [q, qd, qdd] = self.model.formulas.state();
        let tau: Vec<Expr> = self.symbols[3].iter().map(|&s| s.into()).collect();
        let still = vec![Expr::int(0); n];
        let torque = |qd: &[Expr], qdd: &[Expr]| -> Vec<Expr> {
            let smooth = inverse_dynamics(arm, &q, qd, qdd, None);
            smooth
                .into_iter()
                .zip(arm.drives.iter().zip(qd))
                .map(|(t, (d, v))| t + d.coulomb * v.sign())
                .collect()
        };
        let formulas = match function {
            DynamicFunction::Torque | DynamicFunction::TorqueDerivatives => torque(&qd, &qdd),
            DynamicFunction::Inertia => inertia_matrix(arm, &q).concat(),
            DynamicFunction::Bias => torque(&qd, &still),
            DynamicFunction::Gravity => torque(&still, &still),
            DynamicFunction::Acceleration | DynamicFunction::AccelerationDerivatives => {
                let rest: Vec<Expr> = tau.iter().zip(torque(&qd, &still)).map(|(&t, h)| t - h).collect();
                factored(&inertia_matrix(arm, &q)).solve(&rest)
            }
            DynamicFunction::Energy => return self.energies(),
        };
        let variables = self.variables(function);
        let plain = with_values(&program(&variables, &formulas), &self.model.formulas, &self.values);
        match function {
            DynamicFunction::TorqueDerivatives | DynamicFunction::AccelerationDerivatives => plain.jacobian(),
            _ => plain,
        }
    }

    /// The variables that a function reads.
    pub fn variables(&self, function: DynamicFunction) -> Vec<Symbol> {
        let third = if function.is_driven() { 3 } else { 2 };
        [0, 1, third][..function.reads()].iter().flat_map(|&k| self.symbols[k].iter().copied()).collect()
    }

    /// The torques with the last `vectors` of q, q̇ and q̈ zero, from the others.
    fn at_rest(&self, vectors: usize) -> Program {
        let kept = &self.symbols[..3 - vectors];
        let mut all = Composer::new(&kept.concat(), self.parameters());
        let zero = all.graph().number(&Rational::ZERO);
        let is_zero = |s: Symbol| !kept.iter().flatten().any(|k| *k == s) && self.is_state(s);
        let torques = all.copy(&self.torque, |s| is_zero(s).then_some(zero));
        let names: Vec<(String, Value)> = named("t", torques);
        all.finish(&names).shortened(ORDERS)
    }

    fn is_state(&self, s: Symbol) -> bool {
        self.symbols[..3].iter().flatten().any(|k| *k == s)
    }

    /// A, one way and another.
    fn inertias(&self) -> Vec<DynamicProgram> {
        self.matrices.get_or_init(|| self.found_inertias()).clone()
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
        let ways = [triangle(false), triangle(true)].map(|entries| {
            let mut all = Composer::new(&self.symbols[0], self.parameters());
            let values = all.copy(&slopes, |_| None);
            let entries: Vec<Value> = entries.into_iter().map(|k| values[k]).collect();
            all.finish(&named("a", entries)).shortened(0)
        });
        // What another way gives is taken where it is the same matrix.
        let composite = self.composite().and_then(|program| {
            let inertia = match are_equal(&self.model.formulas, &program, &ways[0]) {
                true => Ground::Proved,
                false => same(&program, &ways[0], n <= EXPANDED),
            };
            (inertia != Ground::Failed).then_some(DynamicProgram { program, inertia })
        });
        ways.map(DynamicProgram::plain).into_iter().chain(composite).collect()
    }

    /// A by composite bodies from base parameters; nothing where a link has a mass for each direction.
    fn composite(&self) -> Option<Program> {
        let found = shortest_inertia(&self.description, &self.model.formulas, &self.model.base)?;
        let found = with_values(&found, &self.model.formulas, &self.values);
        let mut all = Composer::new(&self.symbols[0], self.parameters());
        let entries = all.copy(&found, |_| None);
        Some(all.finish(&named("a", entries)))
    }

    /// ∂τ/∂q, ∂τ/∂q̇ and A: all of them derivatives of the torques, or with the matrix that makes it the shortest.
    fn slopes(&self) -> Option<DynamicProgram> {
        let [q, qd, qdd, _] = &self.symbols;
        let n = q.len();
        let by_state = self.torque.jacobian_by(&[&q[..], qd].concat());
        let with = |matrix: DynamicProgram| {
            let mut all = Composer::new(&[&q[..], qd, qdd].concat(), self.parameters());
            let slopes = all.copy(&by_state, |_| None);
            let matrix_entries = all.copy(&matrix.program, |_| None);
            let rows = slopes.chunks(2 * n).zip(matrix_entries.chunks(n));
            let entries = rows.flat_map(|(a, b)| [a, b].concat()).collect();
            DynamicProgram { program: all.finish(&named("d", entries)), ..matrix }
        };
        let plain = DynamicProgram::plain(self.torque.jacobian());
        let all = self.inertias().into_iter().map(with).chain([plain]);
        shortest(all.map(|p| DynamicProgram { program: p.program.shortened(0), ..p }))
    }

    /// The torques of accelerations alone, at rest and without gravity: A q̈.
    fn unforced(&self) -> Program {
        let [q, qd, qdd, _] = &self.symbols;
        let mut all = Composer::new(&[&q[..], qdd].concat(), self.parameters());
        let zero = all.graph().number(&Rational::ZERO);
        let torques = all.copy(&self.torque, |s| qd.contains(&s).then_some(zero));
        let weight = all.copy(&self.torque, |s| (qd.contains(&s) || qdd.contains(&s)).then_some(zero));
        let graph = all.graph();
        let moving = torques.into_iter().zip(weight).map(|(t, w)| graph.sub(t, w)).collect();
        all.finish(&named("t", moving))
    }

    /// q̈ = A⁻¹(τ − h), or its derivatives, with the matrix that makes it the shortest.
    fn accelerations(&self, derivatives: bool) -> Option<DynamicProgram> {
        let solved = |matrix: DynamicProgram| DynamicProgram {
            program: self.solved(&matrix.program, derivatives),
            ..matrix
        };
        shortest(self.inertias().into_iter().map(solved))
    }

    fn solved(&self, matrix: &Program, derivatives: bool) -> Program {
        let [q, qd, qdd, tau] = &self.symbols;
        let n = q.len();
        let mut all = Composer::new(&[&q[..], qd, tau].concat(), self.parameters());
        let matrix = all.copy(matrix, |_| None);
        let bias = all.copy(&self.at_rest(1), |_| None);
        let graph = all.graph();
        let rest: Vec<Value> = (0..n)
            .map(|j| {
                let drive = graph.input(tau[j]);
                graph.sub(drive, bias[j])
            })
            .collect();
        let factors = Factors::new(&matrix, n, &mut all);
        let accelerations = factors.solve(rest, &mut all);
        if !derivatives {
            return all.finish(&named("qdd", accelerations)).shortened(0);
        }
        let at = |s: Symbol| qdd.iter().position(|k| *k == s).map(|k| accelerations[k]);
        let slopes = all.copy(&self.torque.jacobian_by(&[&q[..], qd].concat()), at);
        let [zero, one] = [Rational::ZERO, Rational::ONE].map(|r| all.graph().number(&r));
        let mut columns: Vec<Vec<Value>> = vec![];
        for c in 0..2 * n {
            let column = (0..n).map(|i| -slopes[2 * n * i + c]).collect();
            columns.push(factors.solve(column, &mut all));
        }
        for c in 0..n {
            let unit = (0..n).map(|i| if i == c { one } else { zero }).collect();
            columns.push(factors.solve(unit, &mut all));
        }
        // A⁻¹ is symmetric: what of it is below the diagonal is what is above.
        let entry = |i: usize, c: usize| match c.checked_sub(2 * n) {
            Some(j) if j > i => columns[2 * n + i][j],
            _ => columns[c][i],
        };
        let entries = (0..3 * n * n).map(|k| entry(k / (3 * n), k % (3 * n))).collect();
        all.finish(&named("d", entries)).shortened(0)
    }

    fn energies(&self) -> Program {
        let formulas = &self.model.formulas;
        let [q, qd, _] = formulas.state();
        let arm = &formulas.dynamics;
        let both = [kinetic_energy(arm, &q, &qd), potential_energy(arm, &q)];
        with_values(&program(&self.symbols[..2].concat(), &both), formulas, &self.values)
    }
}

/// A = LDLᵀ in a graph, the joints from the tip to the base: what the last joint has to do with is known first, and is often constant.
struct Factors {
    lower: Vec<Vec<Value>>,
    /// One over each entry of D.
    inverse: Vec<Value>,
}

impl Factors {
    fn new(matrix: &[Value], n: usize, all: &mut Composer) -> Self {
        let graph = all.graph();
        let matrix: Vec<Value> = matrix.iter().rev().copied().collect();
        let [zero, one] = [Rational::ZERO, Rational::ONE].map(|r| graph.number(&r));
        let mut inverse = vec![];
        let (mut lower, mut diagonal) = (vec![vec![zero; n]; n], vec![zero; n]);
        for j in 0..n {
            // L D of the row, once for all entries below.
            let scaled: Vec<Value> = (0..j).map(|k| graph.mul(lower[j][k], diagonal[k])).collect();
            let mut pivot = matrix[n * j + j];
            for k in 0..j {
                let part = graph.mul(lower[j][k], scaled[k]);
                pivot = graph.sub(pivot, part);
            }
            diagonal[j] = pivot;
            let over = graph.div(one, pivot);
            inverse.push(over);
            for i in j + 1..n {
                let mut entry = matrix[n * i + j];
                for k in 0..j {
                    let part = graph.mul(lower[i][k], scaled[k]);
                    entry = graph.sub(entry, part);
                }
                lower[i][j] = graph.mul(entry, over);
            }
        }
        Factors { lower, inverse }
    }

    fn solve(&self, mut x: Vec<Value>, all: &mut Composer) -> Vec<Value> {
        let (graph, n) = (all.graph(), x.len());
        x.reverse();
        for i in 0..n {
            for k in 0..i {
                let part = graph.mul(self.lower[i][k], x[k]);
                x[i] = graph.sub(x[i], part);
            }
        }
        for (entry, d) in x.iter_mut().zip(&self.inverse) {
            *entry = graph.mul(*entry, *d);
        }
        for i in (0..n).rev() {
            for k in i + 1..n {
                let part = graph.mul(self.lower[k][i], x[k]);
                x[i] = graph.sub(x[i], part);
            }
        }
        x.reverse();
        x
    }
}

/// The program with the fewest operations.
fn shortest(all: impl IntoIterator<Item = DynamicProgram>) -> Option<DynamicProgram> {
    all.into_iter().min_by_key(|p| p.program.count().cost())
}

/// On what it rests that two programs are equal: their canonical forms, if these may be asked for, or values at random points, modulo a
/// prime or, where constants have no value there, in doubles.
fn same(a: &Program, b: &Program, expands: bool) -> Ground {
    if expands && a.formulas().into_iter().zip(b.formulas()).all(|(x, y)| equal(x, y).is_equal()) {
        return Ground::Proved;
    }
    let mut random = Random(1982);
    let mut any = || (random.unit() * (1_u64 << 53) as f64) as u64;
    let mut ground = Ground::Modulo(STATES);
    for _ in 0..STATES {
        let mut at: FxHashMap<Symbol, Residue> = FxHashMap::default();
        let mut near: FxHashMap<Symbol, f64> = FxHashMap::default();
        for s in inputs(a).chain(inputs(b)) {
            at.entry(s).or_insert_with(|| Residue::input(any(), any()));
            near.entry(s).or_insert_with(|| any() as f64 / (1_u64 << 53) as f64);
        }
        let [x, y] = [a, b].map(|p| {
            let values = p.eval(|s| at.get(&s).cloned()).ok()?;
            values.iter().map(Residue::get).collect::<Option<Vec<u64>>>()
        });
        if let (Some(x), Some(y)) = (x, y) {
            if x != y {
                return Ground::Failed;
            }
            continue;
        }
        let [x, y] = [a, b].map(|p| p.eval(|s| near.get(&s).copied()).unwrap_or_default());
        let size = x.iter().fold(f64::MIN_POSITIVE, |m, v| m.max(v.abs()));
        let off = x.iter().zip(&y).map(|(v, w)| (v - w).abs() / size);
        let worst = off.fold(0.0_f64, |m, v| if v.is_nan() { f64::INFINITY } else { m.max(v) });
        if x.is_empty() || x.len() != y.len() || worst > ROUNDING {
            return Ground::Failed;
        }
        ground = ground.and(Ground::Numbers(STATES, worst));
    }
    ground
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
