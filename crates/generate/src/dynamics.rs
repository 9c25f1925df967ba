//! Dynamic functions: their programs, words and vectors.

use super::samples;
use super::words::text;
use super::{Function, Unable, Wanted};
use denavit::description::{Description, JointKind, Mechanism};
use denavit::dynamics::{
    DynamicFunction, DynamicProgram, DynamicPrograms, Ground, Link, Loads, Masses, NoProgram, OfTree,
};
use denavit::quantity::torque_unit;
use denavit_emit::{Parameter, Routine, Vector};
use denavit_program::{Composer, Extended, Program, Value};
use denavit_symbolic::{Expr, Symbol};
use rustc_hash::FxHashMap;

/// What programs are of: an arm, or a whole tree.
pub(super) struct Moving {
    /// How the joint variables move, in order.
    pub kinds: Vec<JointKind>,
    /// The parameters of the table, with values for tests; a tree has none.
    pub parameters: Vec<(Symbol, f64)>,
}

impl Moving {
    /// An arm.
    pub fn arm(d: &Description) -> Self {
        let kinds = d.variables().into_iter().map(|v| v.kind).collect();
        let values = samples::parameters(d);
        Moving { kinds, parameters: d.parameters.iter().map(|p| p.symbol).zip(values).collect() }
    }

    /// A tree.
    pub fn tree(m: &Mechanism) -> Self {
        let kind = |j: usize| m.joints[j].kind.unwrap_or(JointKind::Revolute);
        Moving { kinds: m.variables().into_iter().map(kind).collect(), parameters: vec![] }
    }
}

/// All dynamic functions that are asked for.
pub(super) struct Dynamic {
    moving: Moving,
    all: DynamicPrograms,
    functions: Vec<One>,
    /// The vectors behind q: rates, and accelerations or torques.
    pub variables: Vec<(Symbol, String)>,
    /// Those beside the parameters of the table, with a value for tests.
    parameters: Vec<(Parameter, f64)>,
}

struct One {
    function: DynamicFunction,
    /// Over the variables of the library.
    program: Program,
    /// As it was made.
    made: DynamicProgram,
    /// By other ways, from the links as they are.
    reference: Program,
}

/// Values for tests where a link has none: those of a body that can be. XX XY XZ YY YZ ZZ, MX MY MZ, M.
const LINK: [(&str, f64, &str); 10] = [
    ("XX", 0.4, "kg m^2"),
    ("XY", 0.02, "kg m^2"),
    ("XZ", -0.03, "kg m^2"),
    ("YY", 0.5, "kg m^2"),
    ("YZ", 0.01, "kg m^2"),
    ("ZZ", 0.6, "kg m^2"),
    ("MX", 0.1, "kg m"),
    ("MY", -0.05, "kg m"),
    ("MZ", 0.08, "kg m"),
    ("M", 2.0, "kg"),
];
/// Acceleration of gravity for tests.
const GRAVITY: f64 = 9.81;

impl Dynamic {
    /// The functions among those that are wanted; nothing if there is none.
    ///
    /// # Errors
    /// If numbers are to stand in the code and the description has none; if energies are wanted from base parameters, or a payload
    /// beside them; if a joint moves no mass and accelerations are wanted; if a load is wanted and no function feels it.
    pub fn new(
        d: &Description,
        wanted: &[Wanted],
        masses: Option<Masses>,
        loads: Loads,
    ) -> Result<Option<Self>, Unable> {
        let functions: Vec<DynamicFunction> =
            wanted.iter().filter_map(|w| if let Wanted::Dynamic(f) = w { Some(*f) } else { None }).collect();
        if loads.payload && functions.is_empty() {
            return Err(Unable::Loads { is_wrench: false });
        }
        if loads.wrench && !functions.iter().any(|f| f.feels_wrench()) {
            return Err(Unable::Loads { is_wrench: true });
        }
        if functions.is_empty() {
            return Ok(None);
        }
        let usual = if d.has_masses() { Masses::Numbers } else { Masses::Links };
        let masses = masses.unwrap_or(usual);
        if masses == Masses::Base && functions.contains(&DynamicFunction::Energy) {
            return Err(Unable::Program(NoProgram::Energy));
        }
        if masses == Masses::Base && loads.payload {
            return Err(Unable::Payload);
        }
        let all = DynamicPrograms::with_loads(d, masses, loads).map_err(Unable::Masses)?;
        Self::of(all, Moving::arm(d), functions).map(Some)
    }

    /// Functions of a whole tree.
    ///
    /// # Errors
    /// If masses or values are missing; if energies are wanted from base parameters; if a joint moves no mass and accelerations are
    /// wanted.
    pub fn of_tree(
        m: &Mechanism,
        functions: Vec<DynamicFunction>,
        masses: Option<Masses>,
    ) -> Result<Self, Unable> {
        let masses = masses.unwrap_or(Masses::Numbers);
        if masses == Masses::Base && functions.contains(&DynamicFunction::Energy) {
            return Err(Unable::Program(NoProgram::Energy));
        }
        let tree = OfTree::exact(m).map_err(Unable::Tree)?;
        Self::of(DynamicPrograms::of_tree(&tree, masses), Moving::tree(m), functions)
    }

    fn of(all: DynamicPrograms, moving: Moving, functions: Vec<DynamicFunction>) -> Result<Self, Unable> {
        let variables = variables(&moving, &all, &functions);
        let symbols: Vec<Symbol> =
            all.symbols[0].iter().chain(variables.iter().map(|v| &v.0)).copied().collect();
        let made = |function: DynamicFunction| {
            let made = all.program(function).map_err(Unable::Program)?;
            let program = over(&made.program, &symbols);
            let reference = over(&all.reference(function), &symbols);
            Ok(One { function, program, made, reference })
        };
        let functions = functions.into_iter().map(made).collect::<Result<Vec<One>, Unable>>()?;
        let parameters = parameters(&moving, &all, &functions);
        Ok(Dynamic { moving, all, functions, variables, parameters })
    }

    /// The links of a tree, a line each: number, joint, the link before.
    pub fn links_of_tree(&self, m: &Mechanism) -> Vec<String> {
        let arm = &self.all.model.formulas.dynamics;
        let joint = |row: usize| m.joints[row].name.as_str();
        let line = |(k, link): (usize, &Link<Expr>)| match link.parent {
            Some(parent) => format!("{:>2}  {} on {}", k + 1, joint(link.row), parent + 1),
            None => format!("{:>2}  {}", k + 1, joint(link.row)),
        };
        arm.links.iter().enumerate().map(line).collect()
    }

    /// The joint variables.
    pub fn joints(&self) -> &[Symbol] {
        &self.all.symbols[0]
    }

    /// The functions with their operations, and what they rest on.
    pub fn functions(&self) -> impl Iterator<Item = Function> {
        self.functions.iter().map(|one| Function {
            wanted: Wanted::Dynamic(one.function),
            count: one.program.count(),
            is_proved: self.all.ground(one.function, &one.made) == Ground::Proved,
            claim: claim(one.function, &self.all, &one.made),
            divides_by: one.made.program.divisors().into_iter().map(text).collect(),
        })
    }

    /// The parameters beside those of the table.
    pub fn parameters(&self) -> impl Iterator<Item = Parameter> {
        self.parameters.iter().map(|p| p.0.clone())
    }

    /// With words and vectors.
    pub fn routines(&self, configurations: &[Vec<f64>]) -> Vec<Routine<'_>> {
        let states = self.states(configurations);
        self.functions.iter().map(|one| self.routine(one, &states)).collect()
    }

    /// Values for the parameters beside those of the table.
    pub fn values(&self) -> Vec<f64> {
        self.parameters.iter().map(|p| p.1).collect()
    }

    /// Configurations with rates, and accelerations or torques; the first at rest.
    fn states(&self, configurations: &[Vec<f64>]) -> Vec<Vector> {
        let mut random = samples::Uniform::new();
        let of = |k: usize, q: &Vec<f64>, random: &mut samples::Uniform| {
            let more =
                self.variables.iter().map(|_| if k == 0 { 0.0 } else { 2.0 * random.between(-1.0, 1.0) });
            let variables = q.iter().copied().chain(more).collect();
            let table = self.moving.parameters.iter().map(|p| p.1);
            let parameters = table.chain(self.values()).collect();
            Vector { variables, parameters, results: vec![] }
        };
        configurations.iter().enumerate().map(|(k, q)| of(k, q, &mut random)).collect()
    }

    fn routine<'a>(&'a self, one: &'a One, states: &[Vector]) -> Routine<'a> {
        let vectors: Vec<Vector> = states
            .iter()
            .map(|state| {
                let exact = self.exact(&one.reference, state);
                Vector { results: exact.iter().map(Extended::to_f64).collect(), ..state.clone() }
            })
            .collect();
        let n = self.all.symbols[0].len();
        let (result, shape, mut about) = words(one.function, n);
        if one.function.feels_wrench() && !self.all.wrench.is_empty() {
            about.push("The tool exerts the force FX, FY, FZ and the moment CX, CY, CZ on its surroundings, about its origin.".into());
        }
        let scales = scales(one, self, &vectors);
        let name = Wanted::Dynamic(one.function).name().into();
        Routine { name, about, program: &one.program, result: result.into(), shape, vectors, scales }
    }

    /// The results of the reference, whose parameters are those of the links: where base parameters are given, those from which
    /// they come.
    fn exact(&self, reference: &Program, state: &Vector) -> Vec<Extended> {
        let values = self.inputs(reference, state);
        let links = self.links();
        let value =
            |s: Symbol| values.get(&s).copied().or_else(|| links.get(&s).copied()).map(Extended::from);
        reference.eval(value).expect("a value for every input")
    }

    /// The values of a program's inputs in a state.
    fn inputs(&self, program: &Program, state: &Vector) -> FxHashMap<Symbol, f64> {
        let parameters = self.all.model.formulas.parameters.iter().map(|p| p.symbol);
        let of_table = parameters.take(state.parameters.len() - self.parameters.len());
        let names = of_table.chain(self.parameters.iter().map(|p| p.0.symbol));
        program
            .variables()
            .iter()
            .copied()
            .zip(state.variables.iter().copied())
            .chain(names.zip(state.parameters.iter().copied()))
            .collect()
    }

    /// Values for the numbers of the links, and for gravity.
    fn links(&self) -> FxHashMap<Symbol, f64> {
        values_of_links(&self.all)
    }
}

/// What a function rests on: the torques, the wrench, the inertia matrix as the torques' derivative, and what was shortened; and what it
/// divides by.
fn claim(function: DynamicFunction, all: &DynamicPrograms, made: &DynamicProgram) -> String {
    let from = match function {
        DynamicFunction::Torque => "",
        DynamicFunction::Energy => return "the energies of the links, written out".into(),
        DynamicFunction::Bias | DynamicFunction::Gravity => "from the torques, which are ",
        DynamicFunction::Inertia | DynamicFunction::TorqueDerivatives => {
            "derivatives of the torques, which are "
        }
        DynamicFunction::TorqueWithDerivatives => "the torques and their derivatives; the torques are ",
        DynamicFunction::Acceleration => "by A = LDL^T from the torques, which are ",
        DynamicFunction::AccelerationDerivatives | DynamicFunction::AccelerationWithDerivatives => {
            "by A = LDL^T from derivatives of the torques, which are "
        }
    };
    let equal = |to: &str, ground: Ground| match ground {
        Ground::Proved => format!("proved equal to {to}"),
        Ground::Modulo(states) => {
            format!("equal to {to} at {states} random states modulo a prime of 61 bits, exactly; not proved")
        }
        Ground::Numbers(states, off) => {
            format!("equal to {to} in {states} random states within {off:.0e}; not proved")
        }
        Ground::Failed => format!("not equal to {to}: a defect"),
    };
    let mut text = format!("{from}{}", equal("Lagrange's equations", all.model.ground));
    if made.by_bodies {
        text += &format!(
            "; the inertia matrix by composite bodies, {}",
            equal("these derivatives", made.inertia)
        );
    }
    if function.feels_wrench() && !all.wrench.is_empty() {
        text += &format!(
            "; what holds the wrench {}",
            equal("J^T w with the derivative of the product of the link transforms", all.wrench_ground)
        );
    }
    if made.shortening != Ground::Proved {
        text += &format!("; made shorter, and {}", equal("what it was before", made.shortening));
    }
    let divisors: Vec<String> = made.program.divisors().into_iter().map(super::words::text).collect();
    if !divisors.is_empty() {
        text += &format!("; it divides by {}, and holds where that is not 0", divisors.join(", "));
    }
    text
}

/// What the results are called, their shape, and what they are.
fn words(function: DynamicFunction, n: usize) -> (&'static str, Vec<usize>, Vec<String>) {
    let units = "N m (N for a joint that slides)";
    let change = "rad/s^2 (m/s^2 for a joint that slides)";
    let first = function.before_derivatives().unwrap_or(0);
    let columns = |last: &str| {
        let column = |k: usize| first + k;
        format!(
            "Columns {} to {}: by q; {} to {}: by qd; {} to {}: {last}.",
            column(1),
            column(n),
            column(n + 1),
            column(2 * n),
            column(2 * n + 1),
            column(3 * n)
        )
    };
    let at_zero =
        "Coulomb's friction jumps where a rate is 0: its derivative is 0 on either side, and 0 here."
            .to_string();
    match function {
        DynamicFunction::Torque => {
            let what = format!(
                "Inverse dynamics: the torques of the {n} drives that give the accelerations qdd in the state (q, qd), with \
                 gravity, rotors and friction; {units}."
            );
            ("tau", vec![n], vec![what, "At rest Coulomb's friction counts as 0.".into()])
        }
        DynamicFunction::Inertia => {
            let what = format!(
                "The inertia matrix A, {n} by {n}, symmetric, from q alone; rotors are on its diagonal."
            );
            ("inertia", vec![n, n], vec![what, "kg m^2; kg m and kg where joints slide.".into()])
        }
        DynamicFunction::Bias => {
            let what = format!(
                "The torques without accelerations, from q and qd: centrifugal and Coriolis torques, gravity, friction; {units}."
            );
            ("bias", vec![n], vec![what])
        }
        DynamicFunction::Gravity => (
            "gravity",
            vec![n],
            vec![format!("The torques that hold the arm at rest, from q alone; {units}.")],
        ),
        DynamicFunction::Acceleration => {
            let what = format!(
                "Direct dynamics: the accelerations of the {n} joints under the torques tau of the drives in the state (q, qd); \
                 {change}."
            );
            let singular =
                "A joint that moves nothing with mass makes them infinite or not a number.".to_string();
            ("qdd", vec![n], vec![what, singular])
        }
        DynamicFunction::Energy => {
            let what = "The kinetic energy, with that of the rotors, and the potential energy, which is 0 with all mass at the \
                        origin of the base, from q and qd; J.";
            ("energy", vec![2], vec![what.into()])
        }
        DynamicFunction::TorqueDerivatives => {
            let what = format!("The derivatives of the torques, {n} by {}, a row a joint.", 3 * n);
            (
                "derivatives",
                vec![n, 3 * n],
                vec![what, columns("by qdd, which is the inertia matrix"), at_zero],
            )
        }
        DynamicFunction::AccelerationDerivatives => {
            let what = format!("The derivatives of the accelerations, {n} by {}, a row a joint.", 3 * n);
            ("derivatives", vec![n, 3 * n], vec![what, columns("by tau, which is the inverse of A"), at_zero])
        }
        DynamicFunction::TorqueWithDerivatives => {
            let what = format!(
                "The torques with their derivatives in one pass, {n} by {}, a row a joint: what both need is computed once.",
                3 * n + 1
            );
            let torques = format!("Column 1: the torques; {units}.");
            let derivatives = columns("by qdd, which is the inertia matrix");
            ("expansion", vec![n, 3 * n + 1], vec![what, torques, derivatives, at_zero])
        }
        DynamicFunction::AccelerationWithDerivatives => {
            let what = format!(
                "The accelerations with their derivatives in one pass, {n} by {}, a row a joint: what both need is computed once.",
                3 * n + 1
            );
            let accelerations = format!("Column 1: the accelerations; {change}.");
            let derivatives = columns("by tau, which is the inverse of A");
            ("expansion", vec![n, 3 * n + 1], vec![what, accelerations, derivatives, at_zero])
        }
    }
}

/// The vectors behind q that the functions read. One vector stands for accelerations and for torques where functions read either.
fn variables(moving: &Moving, all: &DynamicPrograms, functions: &[DynamicFunction]) -> Vec<(Symbol, String)> {
    let most = functions.iter().map(|f| f.reads()).max().unwrap_or(1);
    let mut list = vec![];
    let wrench = all.wrench.iter().enumerate().map(|(k, &s)| {
        let what = if k < 3 { "force" } else { "moment about the tool's origin" };
        let unit = if k < 3 { "N" } else { "N m" };
        let axis = ["x", "y", "z"][k % 3];
        (s, format!("{what} that the tool exerts, along {axis} of the base, in {unit}"))
    });
    let kinds = &moving.kinds;
    let unit = |k: usize, turning: &str, sliding: &str| {
        if kinds[k] == JointKind::Revolute { turning.to_string() } else { sliding.to_string() }
    };
    let name = |k: usize| all.symbols[0][k].name();
    if most >= 2 {
        for (k, &s) in all.symbols[1].iter().enumerate() {
            list.push((s, format!("rate of {}, in {}", name(k), unit(k, "rad/s", "m/s"))));
        }
    }
    if most >= 3 {
        let thirds = functions.iter().filter(|f| f.reads() == 3);
        let (driven, given): (Vec<&DynamicFunction>, Vec<_>) = thirds.partition(|f| f.is_driven());
        for (k, &kind) in kinds.iter().enumerate() {
            let rate = format!("acceleration of {}, in {}", name(k), unit(k, "rad/s^2", "m/s^2"));
            let torque = format!("torque that drives {}, in {}", name(k), torque_unit(kind));
            list.push(match (driven.is_empty(), given.is_empty()) {
                (true, _) => (all.symbols[2][k], rate),
                (_, true) => (all.symbols[3][k], torque),
                _ => {
                    let symbol =
                        Symbol::new(&format!("u{}", all.symbols[2][k].name().trim_start_matches("qdd")));
                    (symbol, format!("{rate}; for acceleration and its derivatives the {torque}"))
                }
            });
        }
    }
    list.extend(wrench);
    list
}

/// A program over the variables of the library: q, rates, and one vector that is either accelerations or torques.
fn over(program: &Program, symbols: &[Symbol]) -> Program {
    let mut all = Composer::new(symbols, program.parameters());
    let mut at: FxHashMap<Symbol, Value> = FxHashMap::default();
    for (k, &s) in program.variables().iter().enumerate() {
        let place = symbols.iter().position(|x| *x == s).unwrap_or(k);
        at.insert(s, all.graph().input(symbols[place]));
    }
    let results = all.copy(program, |s| at.get(&s).copied());
    let outputs: Vec<(String, Value)> = program.outputs().iter().map(|o| o.0.clone()).zip(results).collect();
    all.finish(&outputs)
}

/// Values for the numbers of the links that have none, and for gravity.
fn values_of_links(all: &DynamicPrograms) -> FxHashMap<Symbol, f64> {
    let formulas = &all.model.formulas;
    let mut values: FxHashMap<Symbol, f64> = FxHashMap::default();
    for p in &formulas.parameters {
        if let Some(value) = p.number() {
            values.insert(p.symbol, value);
        }
    }
    for (&s, (_, value, _)) in formulas.payload.iter().zip(LINK) {
        values.insert(s, 0.5 * value);
    }
    for (k, link) in formulas.dynamics.links.iter().enumerate() {
        for (e, (_, value, _)) in link.body.parameters().into_iter().zip(LINK) {
            // Those of the last link are sums with a payload.
            for s in e.symbols() {
                values.entry(s).or_insert(value * (1.0 + 0.0625 * k as f64));
            }
        }
    }
    values
}

/// The parameters of the programs that the table has not.
fn parameters(moving: &Moving, all: &DynamicPrograms, functions: &[One]) -> Vec<(Parameter, f64)> {
    let formulas = &all.model.formulas;
    let links = values_of_links(all);
    let of_table: FxHashMap<Symbol, f64> = moving.parameters.iter().copied().collect();
    let value = |s: Symbol| of_table.get(&s).or_else(|| links.get(&s)).copied();
    let is_new = |s: &&Symbol| !of_table.contains_key(s);
    let mut list = vec![];
    // Those of the links in their order, then base parameters. Energies may read more than torques.
    let read: Vec<Symbol> = functions.iter().flat_map(|one| one.program.parameters().to_vec()).collect();
    let own = formulas.parameters.iter().map(|p| p.symbol);
    let base = all.model.base.parameters.iter().map(|p| p.symbol);
    let mut symbols: Vec<Symbol> = vec![];
    for s in own.chain(base).filter(|s| read.contains(s)) {
        if !symbols.contains(&s) {
            symbols.push(s);
        }
    }
    for &symbol in symbols.iter().filter(is_new) {
        let default = formulas.value(symbol);
        let base = all.model.base.parameters.iter().find(|p| p.symbol == symbol);
        let of_link = formulas.dynamics.links.iter().enumerate().find_map(|(k, link)| {
            let place = link.body.parameters().iter().position(|e| e.symbols().contains(&symbol))?;
            Some((k + 1, LINK[place]))
        });
        let of_payload = formulas.payload.iter().position(|s| *s == symbol).map(|k| LINK[k]);
        let (about, default, own) = match (base.filter(|b| b.is_grouped), of_link) {
            _ if let Some((letters, value, unit)) = of_payload => (
                format!("{letters} of what the tool carries, about the tool's origin; {unit}"),
                None,
                0.5 * value,
            ),
            (Some(base), _) => {
                let own = base.value.eval(value).unwrap_or(f64::NAN);
                let known = base.value.eval(|s| formulas.value(s)).ok();
                (format!("base parameter of link {}: {}", base.link + 1, text(base.value)), known, own)
            }
            (None, Some((link, (letters, _, unit)))) => {
                let own = value(symbol).unwrap_or(1.0);
                (format!("{letters} of link {link} about the origin of its frame; {unit}"), default, own)
            }
            (None, None) => {
                let own = value(symbol).unwrap_or(GRAVITY);
                ("acceleration of gravity; m/s^2".into(), default, own)
            }
        };
        list.push((Parameter { symbol, about, default }, own));
    }
    list
}

/// What each result is worth where rounding is concerned: as much as the largest of its kind, more where the function itself
/// makes more of rounding, as a solution of equations does.
fn scales(one: &One, all: &Dynamic, vectors: &[Vector]) -> Vec<f64> {
    let n = all.all.symbols[0].len();
    let count = one.program.outputs().len();
    // Results of one kind: energies each, a matrix column block by column block.
    let kind = |k: usize| match (one.function, one.function.before_derivatives()) {
        (DynamicFunction::Energy, _) => k,
        (_, Some(first)) => match (k % (3 * n + first)).checked_sub(first) {
            Some(column) => column / n,
            None => 3,
        },
        _ => 0,
    };
    let kinds = (0..count).map(kind).max().map_or(0, |k| k + 1);
    let mut sizes = vec![f64::MIN_POSITIVE; kinds];
    for v in vectors {
        v.results.iter().enumerate().for_each(|(k, x)| sizes[kind(k)] = sizes[kind(k)].max(x.abs()));
    }
    let mut rounding = vec![1.0_f64; kinds];
    for v in vectors {
        let inputs = all.inputs(&one.program, v);
        let own = one.program.eval(|s| inputs.get(&s).copied()).unwrap_or_default();
        for (k, (x, y)) in own.iter().zip(&v.results).enumerate() {
            let off = (x - y).abs() / (f64::EPSILON * sizes[kind(k)]);
            rounding[kind(k)] = rounding[kind(k)].max(off);
        }
    }
    (0..count).map(|k| sizes[kind(k)] * rounding[kind(k)]).collect()
}
