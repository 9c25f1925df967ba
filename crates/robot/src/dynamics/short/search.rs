//! The search for choices: from a few starts, one link at a time, until nothing improves; once for each length that may be the unit.

use super::arm::{Arm, Unit, values};
use super::choices::{Choices, Form, Frame, Gauge};
use super::generator::{Generator, Label};
use crate::description::{Description, JointKind};
use crate::dynamics::base::{BaseModel, inputs};
use crate::dynamics::grouping::Grouped;
use crate::dynamics::model::Formulas;
use denavit_program::{Composer, Graph, Program, Value};
use denavit_symbolic::{Angle, Expr, Symbol};
use rustc_hash::{FxHashMap, FxHashSet};

/// What is searched.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Wanted {
    /// τ from q, q̇ and q̈.
    Torques,
    /// A from q, row by row.
    Inertia,
}

/// A search under way, with lengths in one unit.
struct Search<'a> {
    wanted: Wanted,
    d: &'a Description,
    formulas: &'a Formulas,
    base: &'a BaseModel,
    unit: Unit,
    /// Whether links have numbers for names.
    has_numbers: bool,
    graph: Graph,
    arm: Arm,
    /// Names for values of the last candidate, the first role first.
    names: Vec<(Value, Label)>,
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

/// Orders at random in which the program that was found is shortened further.
const ORDERS: u64 = 8;

/// The shortest program found for the torques in base parameters: `t1` ….
pub(in crate::dynamics) fn shortest(d: &Description, formulas: &Formulas, base: &BaseModel) -> Program {
    let [own, in_units] = found(Wanted::Torques, d, formulas, base);
    // A slide's force in a unit of length is divided by it again.
    let forces =
        own.first().map(|own| in_units.iter().filter_map(|p| with_forces(p, own, formulas)).collect());
    let forces: Vec<Program> = forces.unwrap_or_default();
    let all = own.into_iter().chain(in_units).chain(forces).chain([base.inverse.clone()]);
    // Of those that are as short one that divides by nothing.
    let all = all.map(|p| p.shortened(0)).map(|p| (cost(&p), p.divisors().len(), p));
    let best = all.min_by_key(|(cost, divisors, _)| (*cost, *divisors));
    best.map_or_else(|| base.inverse.clone(), |(.., best)| best.shortened(ORDERS))
}

/// A program with the forces of slides as another one has them; nothing where there are none.
fn with_forces(program: &Program, other: &Program, formulas: &Formulas) -> Option<Program> {
    let slides: Vec<bool> = (0..formulas.q.len())
        .map(|j| {
            let mut own = formulas.dynamics.links.iter().filter(|l| l.value.terms.iter().any(|t| t.0 == j));
            own.all(|l| l.kind == JointKind::Prismatic)
        })
        .collect();
    if !slides.contains(&true) {
        return None;
    }
    let mut both = Composer::new(program.variables(), program.parameters());
    let [of_program, of_other] = [program, other].map(|p| both.copy(p, |_| None));
    let chosen = of_program.into_iter().zip(of_other).zip(&slides);
    let chosen = chosen.map(|((own, other), slides)| if *slides { other } else { own });
    let outputs: Vec<(String, Value)> = program.outputs().iter().map(|o| o.0.clone()).zip(chosen).collect();
    Some(both.finish(&outputs))
}

/// The shortest program found for the inertia matrix in base parameters, row by row, by composite bodies; nothing where a link has a
/// mass for each direction. Whether it is the torques' derivative is not known.
pub(in crate::dynamics) fn shortest_inertia(
    d: &Description,
    formulas: &Formulas,
    base: &BaseModel,
) -> Option<Program> {
    let all = found(Wanted::Inertia, d, formulas, base).into_iter().flatten().map(|p| p.shortened(0));
    all.min_by_key(cost).map(|best| best.shortened(ORDERS))
}

/// The program that is found with lengths as they are, and those in each unit of length.
fn found(wanted: Wanted, d: &Description, formulas: &Formulas, base: &BaseModel) -> [Vec<Program>; 2] {
    let mut search = Search::new(wanted, d, formulas, base, Unit(None));
    let starts = search.starts();
    let Some((_, choices)) = search.run(starts) else { return [vec![], vec![]] };
    let own = search.program(&choices);
    let in_unit = |unit: Expr| {
        let mut search = Search::new(wanted, d, formulas, base, Unit(Some(unit)));
        // What is short in one unit hardly differs in another.
        let (_, choices) = search.run(vec![choices.clone()])?;
        search.program(&choices)
    };
    let in_units = units(d, formulas).into_iter().filter_map(in_unit);
    [own.into_iter().collect(), in_units.collect()]
}

fn cost(program: &Program) -> Cost {
    let count = program.count();
    (count.cost(), count.multiplications)
}

/// Lengths that may be the unit: the symbols and the numbers among those of the chain.
fn units(d: &Description, formulas: &Formulas) -> Vec<Expr> {
    let mut all: Vec<Expr> = vec![];
    for link in &formulas.dynamics.links {
        let offset = (link.kind == JointKind::Prismatic).then_some(link.value.offset);
        for e in link.before.translation.0.into_iter().chain(offset) {
            let form = Angle::of(e);
            let is_number = form.terms.is_empty() && form.turns.is_zero() && !form.radians.is_zero();
            let number = is_number.then(|| Expr::from(form.radians.abs()));
            let is_length = |s: Symbol| d.parameters.iter().any(|p| p.symbol == s);
            let terms = form.terms.iter().map(|t| t.0).filter(|t| t.as_symbol().is_some_and(is_length));
            for unit in terms.chain(number) {
                if !all.contains(&unit) {
                    all.push(unit);
                }
            }
        }
    }
    all
}

impl<'a> Search<'a> {
    fn new(
        wanted: Wanted,
        d: &'a Description,
        formulas: &'a Formulas,
        base: &'a BaseModel,
        unit: Unit,
    ) -> Self {
        let variables = [&formulas.q[..], &formulas.qd, &formulas.qdd].concat();
        let mut graph = Graph::new(&variables, base.inverse.parameters());
        let arm = Arm::new(d, formulas, &base.links, unit, &mut graph);
        let numbers = base.links.iter().flat_map(Grouped::entries).filter_map(Expr::as_number);
        let has_numbers = numbers.into_iter().any(|r| !r.is_zero());
        Search { wanted, d, formulas, base, unit, has_numbers, graph, arm, names: vec![] }
    }

    /// What is searched, for choices.
    fn results(&mut self, choices: &Choices) -> Option<Vec<Value>> {
        match self.wanted {
            Wanted::Torques => Some(self.torques(choices)),
            Wanted::Inertia => self.inertia(choices),
        }
    }

    /// The inertia matrix of the joints, Gᵀ A G + rotors with that of the axes.
    fn inertia(&mut self, choices: &Choices) -> Option<Vec<Value>> {
        let mut generator = Generator::new(&mut self.graph, &mut self.arm, choices);
        let of_axes = generator.inertia()?;
        self.names = generator.names;
        let graph = &mut self.graph;
        let arm = &self.formulas.dynamics;
        let n = arm.joints();
        let mut matrix = vec![graph.trace(Expr::int(0)); n * n];
        for (row, a) in arm.links.iter().zip(&of_axes) {
            for (column, &entry) in arm.links.iter().zip(a) {
                let mut entry = entry;
                for link in [row, column] {
                    if let (JointKind::Prismatic, Some(over)) = (link.kind, self.unit.inverse(graph)) {
                        entry = graph.mul(entry, over);
                    }
                }
                for &(i, by_row) in &row.value.terms {
                    for &(j, by_column) in &column.value.terms {
                        let (by_row, by_column) = (graph.trace(by_row), graph.trace(by_column));
                        let by = graph.mul(by_row, by_column);
                        let part = graph.mul(by, entry);
                        matrix[n * i + j] = graph.add(matrix[n * i + j], part);
                    }
                }
            }
        }
        for (j, drive) in arm.drives.iter().enumerate() {
            let rotor = graph.trace(drive.rotor);
            matrix[n * j + j] = graph.add(matrix[n * j + j], rotor);
        }
        Some(matrix)
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
            if let (JointKind::Prismatic, Some(over)) = (link.kind, self.unit.inverse(graph)) {
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

    fn cost(&mut self, choices: &Choices) -> Option<Cost> {
        if self.has_numbers {
            self.bind_numbers(choices);
        }
        let results = self.results(choices)?;
        let count = self.graph.walk(&results).count;
        Some((count.cost(), count.multiplications))
    }

    /// Numbers that links have for the choices, in place of their names: what is 0 is nothing to compute with.
    fn bind_numbers(&mut self, choices: &Choices) {
        let named = values(self.d, &self.formulas.dynamics, &self.base.links, choices, &self.arm.slides);
        for (symbol, value, power) in named {
            let mut known = self.graph.input(symbol);
            if value.as_number().is_some() {
                let number = self.graph.trace(value);
                let scaled = self.unit.raised(number, power, &mut self.graph);
                known = if self.graph.as_number(scaled).is_some() { scaled } else { known };
            }
            self.graph.bind(symbol, known);
        }
    }

    fn run(&mut self, starts: Vec<Choices>) -> Option<(Cost, Choices)> {
        let mut best: Option<(Cost, Choices)> = None;
        for start in starts {
            let candidate = self.descend(start)?;
            if best.as_ref().is_none_or(|b| candidate.0 < b.0) {
                best = Some(candidate);
            }
        }
        best
    }

    fn starts(&self) -> Vec<Choices> {
        let n = self.arm.axes.len();
        if self.wanted == Wanted::Inertia {
            // Between links of a group by the angle between them.
            let all = |frame| Choices { relative: true, ..Choices::all(n, frame, Form::NoZz) };
            return vec![all(Frame::Own), all(Frame::Group)];
        }
        let mut relative = Choices::all(n, Frame::Own, Form::NoYy);
        for k in 0..n {
            if self.arm.axes[k].first != k {
                (relative.wrench[k], relative.step[k]) = (Frame::First, Frame::First);
            }
        }
        relative.relative = true;
        vec![Choices::all(n, Frame::Own, Form::NoZz), Choices::all(n, Frame::Group, Form::NoYy), relative]
    }

    /// Nothing where no choices give what is searched.
    fn descend(&mut self, start: Choices) -> Option<(Cost, Choices)> {
        let n = self.arm.axes.len();
        let mut best = (self.cost(&start)?, start);
        loop {
            let mut is_better = false;
            for k in 0..n {
                for step in self.moves(k) {
                    let Some(choices) = self.moved(&best.1, k, step) else { continue };
                    let cost = self.cost(&choices)?;
                    if cost < best.0 {
                        best = (cost, choices);
                        is_better = true;
                    }
                }
            }
            if !is_better {
                return Some(best);
            }
        }
    }

    /// What may be chosen otherwise for one link.
    fn moves(&self, k: usize) -> Vec<Move> {
        let slides = !is_nothing(&self.graph, self.arm.axes[k].along);
        let slid = slides.then_some(Move::Slid);
        if self.wanted == Wanted::Inertia {
            let form = Form::NoZz;
            let steps = [Frame::Group, Frame::Own];
            let steps = steps.map(|step| Move::Link { wrench: step, step, form, added: true });
            return steps.into_iter().chain(slid).collect();
        }
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
        all.extend(slid);
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

    /// The program of choices, its numbers those of the base parameters; nothing if torques do not read all of them.
    fn program(&self, choices: &Choices) -> Option<Program> {
        let named = values(self.d, &self.formulas.dynamics, &self.base.links, choices, &self.arm.slides);
        let mut last = Search::new(self.wanted, self.d, self.formulas, self.base, self.unit);
        let mut of_links: Vec<(Value, String)> = vec![];
        for (symbol, value, power) in named {
            let value = last.graph.trace(value);
            let value = self.unit.raised(value, power, &mut last.graph);
            last.graph.bind(symbol, value);
            of_links.push((value, symbol.name().to_string()));
        }
        let letter = if self.wanted == Wanted::Torques { "t" } else { "a" };
        let results = last.results(choices)?.into_iter().enumerate();
        let results: Vec<(String, Value)> = results.map(|(j, v)| (format!("{letter}{}", j + 1), v)).collect();
        let variables = last.graph.variables().iter().chain(last.graph.parameters());
        let taken: FxHashSet<String> = variables.map(|s| s.name().to_string()).collect();
        let mut names: FxHashMap<u32, String> = FxHashMap::default();
        for (value, name) in of_links {
            names.entry(value.node).or_insert(name);
        }
        for (value, label) in &last.names {
            names.entry(value.node).or_insert_with(|| label.to_string());
        }
        let program = Program::new(&last.graph, &results, |node| names.get(&node).cloned(), &taken);
        let read: FxHashSet<Symbol> = inputs(&program).collect();
        let reads_all = || self.base.parameters.iter().all(|p| read.contains(&p.symbol));
        (self.wanted == Wanted::Inertia || reads_all()).then_some(program)
    }
}

fn is_nothing(graph: &Graph, v: Value) -> bool {
    graph.as_number(v).is_some_and(|r| r.is_zero())
}
