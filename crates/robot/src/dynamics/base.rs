//! Base parameters: the fewest combinations of the links' masses that the torques depend on.
//!
//! What grouping leaves is traced with a name for each number. Names that no torque reads have no effect: that is all there is to
//! the special rules of the books for the links before the second direction of rotation. That the others are independent is
//! proved by a rank: at points modulo a prime the columns of the torques by the names are as many as the names, and a rank modulo
//! a prime is no larger than the rank.

use super::dependent::without_dependent;
use super::grouping::{Grouped, grouped};
use super::model::{Formulas, Wrench};
use super::newton_euler::{Motion, backward, moment, motions};
use super::representatives::{NoBasis, Representatives};
use crate::description::{Description, Parameter};
use crate::forward::symbol_order;
use crate::geometry::{PARAMETERS, Vector};
use crate::random::Random;
use denavit_program::{Domain, Graph, Op, Program, Residue, Value};
use denavit_symbolic::{Expr, Symbol, readable};
use rustc_hash::{FxHashMap, FxHashSet};

/// A base parameter.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct BaseParameter {
    /// Its name: that of what it is alone, or `XXR3` where others are grouped with it.
    pub symbol: Symbol,
    /// What it is in the parameters of the links.
    pub value: Expr,
    /// The link, from 0.
    pub link: usize,
    /// Whether others are grouped with it.
    pub is_grouped: bool,
}

/// What becomes of a parameter of a link.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Fate {
    /// It is a base parameter alone.
    Alone,
    /// It is part of others.
    Grouped,
    /// No torque depends on it.
    WithoutEffect,
}

/// Whether the base parameters are the fewest.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Minimality {
    /// Proved: so many are independent, and so many there are.
    Proved,
    /// So many of them are independent for all that is known; there may be fewer.
    AtLeast(usize),
    /// The rank could not be had: constants of the table have no values modulo the prime.
    Unknown,
}

/// The torques in base parameters.
#[derive(Clone, Debug)]
pub struct BaseModel {
    /// The base parameters, link by link.
    pub parameters: Vec<BaseParameter>,
    /// What was asked of their representatives.
    pub asked: Representatives,
    /// Whether they are the fewest.
    pub minimality: Minimality,
    /// All parameters of the links, with what becomes of them.
    pub fates: Vec<(Symbol, Fate)>,
    /// The links, their numbers the base parameters, or sums of multiples of them where representatives were chosen.
    pub links: Vec<Grouped>,
    /// The joint torques from q, q̇ and q̈: `t1` …
    pub inverse: Program,
}

impl BaseModel {
    /// The base parameters of an arm whose links have names for their numbers ([`Formulas::named`]).
    pub fn derive(d: &Description, formulas: &Formulas) -> Self {
        Self::in_order(&order(d, formulas), formulas)
    }

    /// The same with representatives as they are wanted.
    ///
    /// # Errors
    /// If there are none.
    pub fn derive_for(
        d: &Description,
        formulas: &Formulas,
        wanted: &Representatives,
    ) -> Result<Self, NoBasis> {
        Self::derive(d, formulas).with_representatives(&order(d, formulas), formulas, wanted)
    }

    /// The same of a whole tree.
    pub fn of_tree(formulas: &Formulas) -> Self {
        Self::in_order(&order_of_tree(formulas), formulas)
    }

    /// Of a whole tree with representatives as they are wanted.
    ///
    /// # Errors
    /// If there are none.
    pub fn of_tree_for(formulas: &Formulas, wanted: &Representatives) -> Result<Self, NoBasis> {
        Self::of_tree(formulas).with_representatives(&order_of_tree(formulas), formulas, wanted)
    }

    /// With symbols in an order in which they are written.
    fn in_order(order: &[Symbol], formulas: &Formulas) -> Self {
        let links = grouped(&formulas.dynamics);
        let (named, mut parameters) = named(&links, formulas);
        let inverse = torques(formulas, &named, &parameters);
        let live: FxHashSet<Symbol> = inputs(&inverse).collect();
        parameters.retain(|p| live.contains(&p.symbol));
        // What no torque reads is 0, so that nobody is asked for its value.
        let is_read = |e: Expr| e.as_symbol().is_none_or(|s| live.contains(&s));
        let named: Vec<Grouped> =
            named.iter().map(|l| l.with(|_, e| if is_read(e) { e } else { Expr::int(0) })).collect();
        for p in parameters.iter_mut().filter(|p| p.is_grouped) {
            p.value = readable::simplify(p.value, order).map_or(p.value, |s| s.expr);
        }
        let model = Self::in_parameters(formulas, named, parameters);
        match model.minimality {
            Minimality::AtLeast(_) => without_dependent(formulas, order, model),
            Minimality::Proved | Minimality::Unknown => model,
        }
    }

    /// With links whose numbers are sums of base parameters.
    pub(super) fn in_parameters(
        formulas: &Formulas,
        links: Vec<Grouped>,
        parameters: Vec<BaseParameter>,
    ) -> Self {
        let inverse = torques(formulas, &links, &parameters);
        let minimality = minimality(&inverse, &parameters);
        let mut used: FxHashMap<Symbol, Fate> = FxHashMap::default();
        for p in &parameters {
            let fate = if p.is_grouped { Fate::Grouped } else { Fate::Alone };
            for s in p.value.symbols() {
                let known = used.entry(s).or_insert(fate);
                *known = if fate == Fate::Grouped { fate } else { *known };
            }
        }
        let own = formulas.dynamics.links.iter().flat_map(|l| l.body.parameters());
        let mut fates: Vec<(Symbol, Fate)> = vec![];
        for s in own.flat_map(|e| e.symbols()) {
            if !fates.iter().any(|f| f.0 == s) {
                fates.push((s, used.get(&s).copied().unwrap_or(Fate::WithoutEffect)));
            }
        }
        BaseModel { parameters, asked: Representatives::default(), minimality, fates, links, inverse }
    }

    /// The value of a base parameter, if those of the links are known.
    pub fn value(&self, formulas: &Formulas, p: &BaseParameter) -> Option<f64> {
        p.value.eval(|s| formulas.value(s)).ok()
    }
}

fn order_of_tree(formulas: &Formulas) -> Vec<Symbol> {
    formulas.parameters.iter().map(|p| p.symbol).collect()
}

/// The table's names, then those of the masses.
fn order(d: &Description, formulas: &Formulas) -> Vec<Symbol> {
    let mut order = symbol_order(d);
    order.extend(
        formulas.parameters.iter().map(|p| p.symbol).filter(|s| !d.parameters.iter().any(|p| p.symbol == *s)),
    );
    order
}

/// A name for what is grouped with a number of a link, from 0, as no other is called.
pub(super) fn named_apart(letters: &str, link: usize, taken: &mut FxHashSet<String>) -> Symbol {
    let mut name = format!("{letters}R{}", link + 1);
    while !taken.insert(name.clone()) {
        name.push('_');
    }
    Symbol::new(&name)
}

/// The grouped links with names for their numbers, and what these stand for.
fn named(links: &[Grouped], formulas: &Formulas) -> (Vec<Grouped>, Vec<BaseParameter>) {
    let mut taken: FxHashSet<String> =
        formulas.parameters.iter().map(|p| p.symbol.name().to_string()).collect();
    let mut parameters: Vec<BaseParameter> = vec![];
    let mut all = vec![];
    for (k, link) in links.iter().enumerate() {
        let first = parameters.len();
        all.push(link.with(|entry, value| {
            if value.is_zero() || value.as_number().is_some() {
                return value;
            }
            if let Some(known) = parameters[first..].iter().find(|p| p.value == value) {
                return known.symbol.into();
            }
            let is_grouped = value.as_symbol().is_none();
            let symbol = value.as_symbol().filter(|_| !parameters.iter().any(|p| p.value == value));
            let symbol = symbol.unwrap_or_else(|| named_apart(PARAMETERS[entry.min(9)], k, &mut taken));
            parameters.push(BaseParameter { symbol, value, link: k, is_grouped });
            symbol.into()
        }));
    }
    (all, parameters)
}

/// The wrench that moves a grouped link.
pub(super) fn of_link(link: &Grouped, m: &Motion<Expr>) -> Wrench<Expr> {
    let inertial = Vector([0, 1, 2].map(|i| link.mass[i] * m.acceleration[i]));
    [inertial + m.spread * link.first_moment, moment(&link.inertia, link.first_moment, m)]
}

/// The torques of links, as a program with their names as parameters behind the others.
fn torques(formulas: &Formulas, links: &[Grouped], named: &[BaseParameter]) -> Program {
    let arm = &formulas.dynamics;
    let [q, qd, qdd] = formulas.state();
    let motions = motions(arm, &q, &qd, &qdd, -arm.gravity);
    let wrenches: Vec<Wrench<Expr>> = links.iter().zip(&motions).map(|(l, m)| of_link(l, m)).collect();
    let mut torques = arm.at_joints(&backward(arm, &motions, &wrenches));
    for (j, (torque, drive)) in torques.iter_mut().zip(&arm.drives).enumerate() {
        *torque = *torque + drive.torque(qd[j], qdd[j]) + drive.coulomb * qd[j].sign();
    }
    let variables = [&formulas.q[..], &formulas.qd, &formulas.qdd].concat();
    let own: FxHashSet<Symbol> =
        arm.links.iter().flat_map(|l| l.body.parameters()).flat_map(|e| e.symbols()).collect();
    // Lengths may be among what makes the links' numbers, too.
    let is_named = |s: &Symbol| named.iter().any(|p| p.symbol == *s);
    let read: FxHashSet<Symbol> = Expr::postorder(&torques).into_iter().filter_map(Expr::as_symbol).collect();
    let is_input = |s: &Symbol| !own.contains(s) || read.contains(s) && !is_named(s);
    let mut parameters: Vec<Symbol> =
        formulas.parameters.iter().map(|p: &Parameter| p.symbol).filter(is_input).collect();
    parameters.extend(named.iter().map(|p| p.symbol).filter(|s| !parameters.contains(s)).collect::<Vec<_>>());
    let taken: FxHashSet<String> =
        variables.iter().chain(&parameters).map(|s| s.name().to_string()).collect();
    let mut graph = Graph::new(&variables, &parameters);
    let mut names: FxHashMap<u32, String> = FxHashMap::default();
    for (k, (m, [force, moment])) in motions.iter().zip(&wrenches).enumerate() {
        let mut name = |graph: &mut Graph, letter: &str, v: &Vector<Expr>| {
            for (e, axis) in v.0.iter().zip(["x", "y", "z"]) {
                let value = graph.trace(*e);
                names.entry(value.node).or_insert_with(|| format!("{letter}{}{axis}", k + 1));
            }
        };
        name(&mut graph, "w", &m.turning);
        name(&mut graph, "wd", &m.turning_rate);
        name(&mut graph, "a", &m.acceleration);
        name(&mut graph, "f", force);
        name(&mut graph, "n", moment);
        for (i, row) in m.spread.rows().iter().enumerate() {
            for (j, e) in row.iter().enumerate() {
                let value = graph.trace(*e);
                names.entry(value.node).or_insert_with(|| format!("U{}_{}{}", k + 1, i + 1, j + 1));
            }
        }
    }
    let results: Vec<(String, Value)> =
        torques.iter().enumerate().map(|(j, &e)| (format!("t{}", j + 1), graph.trace(e))).collect();
    Program::new(&graph, &results, |node| names.get(&node).cloned(), &taken)
}

/// The inputs that a program reads.
pub(super) fn inputs(program: &Program) -> impl Iterator<Item = Symbol> {
    program.ops().iter().filter_map(|(op, _)| if let Op::Input(s) = op { Some(*s) } else { None })
}

/// Points of the state more than are needed.
const SPARE: usize = 4;

/// Whether the torques' columns by the parameters are independent.
fn minimality(program: &Program, parameters: &[BaseParameter]) -> Minimality {
    let is_number = |node: u32| matches!(program.ops()[node as usize].0, Op::Number(_));
    let is_root = |op: &Op| matches!(op, Op::Sqrt(v) if !is_number(v.node));
    let roots = program.ops().iter().filter(|(op, _)| is_root(op)).count();
    let live = parameters.len();
    // Of several roots but those of numbers the signs would be anybody's choice.
    if roots > 1 {
        return Minimality::Unknown;
    }
    if live == 0 {
        return Minimality::Proved;
    }
    let mut random = Random(2021);
    let mut any = || (random.unit() * (1_u64 << 53) as f64) as u64;
    let mut constants: FxHashMap<Symbol, Residue> = FxHashMap::default();
    for &s in program.parameters() {
        constants.insert(s, Residue::input(any(), any()));
    }
    let Some(rows) = columns(program, parameters, &constants, &mut any) else { return Minimality::Unknown };
    match Residue::rank(&rows) {
        Some(rank) if rank == live => Minimality::Proved,
        Some(rank) => Minimality::AtLeast(rank),
        None => Minimality::Unknown,
    }
}

/// The torques' columns by the parameters at states at random, more than are needed, with constants of the robot that are the same at
/// all; nothing where one has no value.
pub(super) fn columns(
    program: &Program,
    parameters: &[BaseParameter],
    constants: &FxHashMap<Symbol, Residue>,
    any: &mut impl FnMut() -> u64,
) -> Option<Vec<Vec<Residue>>> {
    let joints = program.outputs().len().max(1);
    let is_base: FxHashSet<Symbol> = parameters.iter().map(|p| p.symbol).collect();
    let mut rows: Vec<Vec<Residue>> = vec![];
    for _ in 0..parameters.len().div_ceil(joints) + SPARE {
        let mut at = constants.clone();
        for &s in program.variables() {
            at.insert(s, Residue::input(any(), any()));
        }
        // τ is linear in them, but for what drives add, which is there without any of them.
        let with = |one: Option<Symbol>| {
            let input = |s: Symbol| match is_base.contains(&s) {
                true => Some(Residue::new(u64::from(Some(s) == one))),
                false => at.get(&s).cloned(),
            };
            program.eval(input).ok()
        };
        let drives = with(None)?;
        let columns: Vec<Vec<Residue>> = parameters
            .iter()
            .map(|p| Some(with(Some(p.symbol))?.iter().zip(&drives).map(|(a, b)| a.sub(b)).collect()))
            .collect::<Option<_>>()?;
        for j in 0..program.outputs().len() {
            rows.push(columns.iter().map(|c| c[j].clone()).collect());
        }
    }
    Some(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One parameter is twice as effective as another: what drives add must not make them independent.
    #[test]
    fn drives_make_no_parameters_independent() {
        let [a, b, friction, rate] = ["a", "b", "fs", "qd"].map(Symbol::new);
        let torque = |second: i64, by: Symbol| {
            let own = Expr::from(a) * Expr::from(rate) + Expr::int(second) * Expr::from(b) * Expr::from(by);
            own + Expr::from(friction) * Expr::from(rate).sign()
        };
        let named =
            [a, b].map(|symbol| BaseParameter { symbol, value: symbol.into(), link: 0, is_grouped: false });
        let of = |torque: Expr, variables: &[Symbol]| {
            minimality(&crate::dynamics::lagrange::program(variables, &[torque]), &named)
        };
        assert_eq!(of(torque(2, rate), &[rate]), Minimality::AtLeast(1));
        let other = Symbol::new("qdd");
        assert_eq!(of(torque(2, other), &[rate, other]), Minimality::Proved);
    }
}
