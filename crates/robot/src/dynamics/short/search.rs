//! The search for choices: from a few starts, one link at a time, until nothing improves; once for each length that may be the unit.

use super::arm::{Arm, values};
use super::choices::{Choices, Form, Frame, Gauge};
use super::generator::Generator;
use crate::description::{Description, JointKind};
use crate::dynamics::base::{BaseModel, inputs};
use crate::dynamics::grouping::Grouped;
use crate::dynamics::model::Formulas;
use denavit_program::{Graph, Program, Value};
use denavit_symbolic::{Angle, Expr, Symbol};
use rustc_hash::{FxHashMap, FxHashSet};

/// A search under way, with lengths in one unit.
struct Search<'a> {
    d: &'a Description,
    formulas: &'a Formulas,
    base: &'a BaseModel,
    unit: Option<Symbol>,
    /// Whether links have numbers for names.
    has_numbers: bool,
    graph: Graph,
    arm: Arm,
    /// Names for values of the last candidate, the first role first.
    names: Vec<(Value, String)>,
}

/// Another choice for a link.
#[derive(Clone, Copy)]
enum Move {
    Link { wrench: Frame, step: Frame, form: Form, added: bool },
    Gauge(Gauge),
    Slid,
    Relative,
}

/// What a candidate costs: operations, and multiplications among them.
type Cost = (u32, u32);

/// The shortest program found for the torques in base parameters: `t1` ….
pub(in crate::dynamics) fn shortest(d: &Description, formulas: &Formulas, base: &BaseModel) -> Program {
    let mut best: Option<(Cost, Program)> = None;
    for unit in [None].into_iter().chain(units(d, formulas).into_iter().map(Some)) {
        let mut search = Search::new(d, formulas, base, unit);
        let (_, choices) = search.run();
        let Some(program) = search.program(&choices) else { continue };
        let count = program.count();
        let cost = (count.cost(), count.multiplications);
        if best.as_ref().is_none_or(|b| cost < b.0) {
            best = Some((cost, program));
        }
    }
    let own = base.inverse.count();
    match best {
        Some((cost, program)) if cost < (own.cost(), own.multiplications) => program,
        _ => base.inverse.clone(),
    }
}

/// Lengths that may be the unit: all lengths of the chain are sums of such.
fn units(d: &Description, formulas: &Formulas) -> Vec<Symbol> {
    let mut all: Vec<Symbol> = vec![];
    for link in &formulas.dynamics.links {
        for e in link.before.translation.0.into_iter().chain([link.value.offset]) {
            if link.kind == JointKind::Revolute && e == link.value.offset {
                continue;
            }
            let form = Angle::of(e);
            if !form.turns.is_zero() {
                return vec![];
            }
            for (term, _) in &form.terms {
                match term.as_symbol() {
                    Some(s) if d.parameters.iter().any(|p| p.symbol == s) => {
                        if !all.contains(&s) {
                            all.push(s);
                        }
                    }
                    _ => return vec![],
                }
            }
        }
    }
    all
}

impl<'a> Search<'a> {
    fn new(d: &'a Description, formulas: &'a Formulas, base: &'a BaseModel, unit: Option<Symbol>) -> Self {
        let variables = [&formulas.q[..], &formulas.qd, &formulas.qdd].concat();
        let mut graph = Graph::new(&variables, base.inverse.parameters());
        if let Some(unit) = unit {
            bind_lengths(d, formulas, unit, &mut graph);
        }
        let arm = Arm::new(d, formulas, &base.links, &mut graph);
        let numbers = base.links.iter().flat_map(Grouped::entries).filter_map(Expr::as_number);
        let has_numbers = unit.is_none() && numbers.into_iter().any(|r| !r.is_zero());
        Search { d, formulas, base, unit, has_numbers, graph, arm, names: vec![] }
    }

    /// The torques at the joints.
    fn torques(&mut self, choices: &Choices) -> Vec<Value> {
        let mut generator = Generator::new(&mut self.graph, &mut self.arm, choices);
        let of_axes = generator.torques();
        self.names = generator.names;
        let graph = &mut self.graph;
        let arm = &self.formulas.dynamics;
        let mut torques = vec![graph.trace(Expr::int(0)); arm.joints()];
        for (link, mut torque) in arm.links.iter().zip(of_axes) {
            if let (JointKind::Prismatic, Some(unit)) = (link.kind, self.unit) {
                let over = over(unit, graph);
                torque = graph.mul(torque, over);
            }
            for &(j, k) in &link.value.terms {
                let k = graph.trace(k);
                let part = graph.mul(k, torque);
                torques[j] = graph.add(torques[j], part);
            }
        }
        for (j, drive) in arm.drives.iter().enumerate() {
            // The rates themselves, not those in another unit.
            let [rate, change] = [self.formulas.qd[j], self.formulas.qdd[j]].map(|s| graph.input(s));
            let way = if drive.coulomb.is_zero() { rate } else { graph.sign(rate) };
            for (e, rate) in [(drive.rotor, change), (drive.viscous, rate), (drive.coulomb, way)] {
                let e = graph.trace(e);
                let part = graph.mul(e, rate);
                torques[j] = graph.add(torques[j], part);
            }
        }
        torques
    }

    fn cost(&mut self, choices: &Choices) -> Cost {
        if self.has_numbers {
            self.bind_numbers(choices);
        }
        let torques = self.torques(choices);
        let count = self.graph.walk(&torques).count;
        (count.cost(), count.multiplications)
    }

    /// Numbers that links have for the choices, in place of their names: what is 0 is nothing to compute with.
    fn bind_numbers(&mut self, choices: &Choices) {
        let named = values(self.d, &self.formulas.dynamics, &self.base.links, choices, &self.arm.slides);
        for (symbol, value, _) in named {
            let known = match value.as_number() {
                Some(_) => self.graph.trace(value),
                None => self.graph.input(symbol),
            };
            self.graph.bind(symbol, known);
        }
    }

    fn run(&mut self) -> (Cost, Choices) {
        let n = self.arm.axes.len();
        let mut starts =
            vec![Choices::all(n, Frame::Own, Form::NoZz), Choices::all(n, Frame::Group, Form::NoYy)];
        let mut relative = Choices::all(n, Frame::Own, Form::NoYy);
        for k in 0..n {
            if self.arm.axes[k].first != k {
                (relative.wrench[k], relative.step[k]) = (Frame::First, Frame::First);
            }
        }
        relative.relative = true;
        starts.push(relative);
        let found = starts.into_iter().map(|start| self.descend(start));
        let mut best: Option<(Cost, Choices)> = None;
        for candidate in found.collect::<Vec<_>>() {
            if best.as_ref().is_none_or(|b| candidate.0 < b.0) {
                best = Some(candidate);
            }
        }
        best.unwrap_or_else(|| ((u32::MAX, 0), Choices::all(n, Frame::Own, Form::NoZz)))
    }

    fn descend(&mut self, start: Choices) -> (Cost, Choices) {
        let n = self.arm.axes.len();
        let mut best = (self.cost(&start), start);
        loop {
            let mut is_better = false;
            for k in 0..n {
                for step in self.moves(k) {
                    let Some(choices) = self.moved(&best.1, k, step) else { continue };
                    let cost = self.cost(&choices);
                    if cost < best.0 {
                        best = (cost, choices);
                        is_better = true;
                    }
                }
            }
            if !is_better {
                return best;
            }
        }
    }

    /// What may be chosen otherwise for one link.
    fn moves(&self, k: usize) -> Vec<Move> {
        let frames: &[Frame] = match self.arm.axes[k].first == k {
            true => &[Frame::Group, Frame::Own],
            false => &[Frame::Group, Frame::Own, Frame::First],
        };
        let mut all = vec![];
        for &wrench in frames {
            for &step in frames {
                for form in [Form::NoZz, Form::NoYy] {
                    for added in [true, false] {
                        if (wrench, step) != (Frame::Own, Frame::Own) || added {
                            all.push(Move::Link { wrench, step, form, added });
                        }
                    }
                }
            }
        }
        all.extend([Gauge::Nothing, Gauge::X, Gauge::Y].map(Move::Gauge));
        if !is_nothing(&self.graph, self.arm.axes[k].along) {
            all.push(Move::Slid);
        }
        if k + 1 == self.arm.axes.len() {
            all.push(Move::Relative);
        }
        all
    }

    /// The choices after a move; nothing if that leaves them as they are, or a mass that is kept without a lever.
    fn moved(&mut self, from: &Choices, k: usize, step: Move) -> Option<Choices> {
        let mut c = from.clone();
        match step {
            Move::Link { wrench, step, form, added } => {
                (c.wrench[k], c.step[k], c.form[k], c.added[k]) = (wrench, step, form, added);
            }
            Move::Gauge(gauge) => c.gauge[k] = gauge,
            Move::Relative => c.relative = !c.relative,
            Move::Slid => {
                c.slid[k] = !c.slid[k];
                for j in k..c.gauge.len().min(k + 2) {
                    if !self.arm.allows(j, c.gauge[j], &c, &mut self.graph) {
                        c.gauge[j] = Gauge::Nothing;
                    }
                }
            }
        }
        let is_legal = (0..c.gauge.len()).all(|j| self.arm.allows(j, c.gauge[j], &c, &mut self.graph));
        (is_legal && c != *from).then_some(c)
    }

    /// The program of choices, its numbers those of the base parameters; nothing if it does not read all of them.
    fn program(&self, choices: &Choices) -> Option<Program> {
        let named = values(self.d, &self.formulas.dynamics, &self.base.links, choices, &self.arm.slides);
        let mut last = Search::new(self.d, self.formulas, self.base, self.unit);
        let scale = self.unit.map(Expr::from);
        let mut of_links: Vec<(Value, String)> = vec![];
        for (symbol, value, power) in named {
            // The values are in the robot's own units.
            let mut value = own_units(value, self.unit, &mut last.graph);
            if let Some(unit) = scale {
                for _ in 0..power {
                    let unit = last.graph.input(unit.as_symbol()?);
                    value = last.graph.mul(value, unit);
                }
            }
            last.graph.bind(symbol, value);
            of_links.push((value, symbol.name().to_string()));
        }
        let torques = last.torques(choices);
        let results: Vec<(String, Value)> =
            torques.into_iter().enumerate().map(|(j, v)| (format!("t{}", j + 1), v)).collect();
        let variables = last.graph.variables().iter().chain(last.graph.parameters());
        let taken: FxHashSet<String> = variables.map(|s| s.name().to_string()).collect();
        let mut names: FxHashMap<u32, String> = FxHashMap::default();
        for (value, name) in of_links.iter().chain(&last.names) {
            names.entry(value.node).or_insert_with(|| name.clone());
        }
        let program = Program::new(&last.graph, &results, |node| names.get(&node).cloned(), &taken);
        let read: FxHashSet<Symbol> = inputs(&program).collect();
        self.base.parameters.iter().all(|p| read.contains(&p.symbol)).then_some(program)
    }
}

fn is_nothing(graph: &Graph, v: Value) -> bool {
    graph.as_number(v).is_some_and(|r| r.is_zero())
}

/// One over the unit.
fn over(unit: Symbol, graph: &mut Graph) -> Value {
    let (one, unit) = (graph.trace(Expr::int(1)), graph.input(unit));
    graph.div(one, unit)
}

/// A formula in the robot's own units, where lengths are bound to others.
fn own_units(e: Expr, unit: Option<Symbol>, graph: &mut Graph) -> Value {
    if unit.is_none() {
        return graph.trace(e);
    }
    // Symbols of its own for lengths, bound to the inputs themselves.
    let fresh = |s: Symbol| Symbol::new(&format!("{} in its own unit", s.name()));
    for s in e.symbols() {
        let input = graph.input(s);
        graph.bind(fresh(s), input);
    }
    graph.trace(e.substitute(|s| Some(fresh(s).into())))
}

/// Binds lengths, slides and gravity to what they are where one length is 1.
fn bind_lengths(d: &Description, formulas: &Formulas, unit: Symbol, graph: &mut Graph) {
    let inverse = over(unit, graph);
    let scaled = |s: Symbol, graph: &mut Graph| {
        let input = graph.input(s);
        let by = graph.mul(input, inverse);
        graph.bind(s, by);
    };
    for s in units(d, formulas).into_iter().filter(|s| *s != unit) {
        scaled(s, graph);
    }
    for s in formulas.dynamics.gravity.0.iter().flat_map(|e| e.symbols()) {
        scaled(s, graph);
    }
    for link in formulas.dynamics.links.iter().filter(|l| l.kind == JointKind::Prismatic) {
        for &(j, _) in &link.value.terms {
            for s in [formulas.q[j], formulas.qd[j], formulas.qdd[j]] {
                scaled(s, graph);
            }
        }
    }
    let one = graph.trace(Expr::int(1));
    graph.bind(unit, one);
}
