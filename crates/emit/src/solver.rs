//! A solver in the words of a language: steps between roots, each at the depth where it is known.

use crate::compiled::{Pair, Step, Steps, formulas};
use crate::listing::Listing;
use crate::names::{Names, comment, sanitised};
use crate::{Language, Library, SolverRoutine};
use denavit_program::solver::{BESIDE, Register, Root, may_hide};
use denavit_symbolic::{Expr, Node, Symbol};
use rustc_hash::{FxHashMap, FxHashSet};

/// The longest name of a function.
const MAX_NAME: usize = 20;

/// What a solution has besides its results.
const FIELDS: [&str; 5] = ["residual", "multiplicity", "branch", "free", "count"];
/// The longest label.
const MAX_LABEL: usize = 40;

/// A label that stands in comments and strings of every language.
fn plain_text(label: &str) -> String {
    let text: String = label.chars().take(MAX_LABEL).collect();
    comment(&text).replace(['"', '\'', '`', '@', '%', '$', '{', '}'], "_")
}

/// The roots between two levels.
pub(crate) struct Branching {
    pub root: Root<Expr>,
    /// What vanishes where the unknown is free: the guard of the node, or the natural one, in either sign. A quartic
    /// knows its own.
    pub guard: Option<Expr>,
    /// What the guard is compared with: the size to the power of the guard's dimension.
    pub scale: Expr,
    /// What is small where the unknown is nearly free, unless that is nowhere.
    pub near: Option<Near>,
    pub results: Vec<Symbol>,
    /// What a step of this node adds to the number of the branch.
    pub stride: usize,
    /// What the node is called.
    pub label: String,
}

impl Branching {
    /// What helpers for its roots are called by.
    pub fn kind(&self) -> Kind {
        match self.root {
            Root::Ratio { .. } => Kind::Ratio,
            Root::Direction { .. } => Kind::Direction,
            Root::Line { .. } => Kind::Line,
            Root::Length { .. } => Kind::Length,
            Root::Sincos { .. } => Kind::Sincos,
            Root::Quadratic { .. } => Kind::Quadratic,
            Root::Quartic { .. } => Kind::Quartic,
        }
    }

    /// The operands of the helper: those of the root, complete, without guard and scale.
    pub fn operands(&self) -> Vec<Expr> {
        match self.root {
            Root::Direction { x, y, sign } => vec![x, y, sign.unwrap_or(Expr::int(1))],
            Root::Sincos { a, b, c, discriminant } => {
                vec![a, b, c, discriminant.unwrap_or(a * a + b * b - c * c)]
            }
            other => other.operands(),
        }
    }

    /// What its branches are called.
    pub fn marks(&self) -> &'static [&'static str] {
        match self.root.branches() {
            1 => &[""],
            2 => &["+", "-"],
            _ => &["1", "2", "3", "4"],
        }
    }
}

/// A value, and the share of a size below which it makes an answer doubtful.
pub(crate) struct Near {
    /// The value, in either sign unless it is a square.
    pub value: Expr,
    pub is_square: bool,
    pub share: f64,
    pub size: Expr,
}

impl Near {
    /// The guard of a node, or the square of the natural one, beside what is usual of it.
    fn new(root: &Root<Expr>, guard: Option<Expr>, scale: Expr, usual: f64) -> Self {
        let share = two_digits;
        let square = |parts: &[Expr]| parts.iter().map(|x| *x * *x).reduce(|a, b| a + b);
        let natural = match *root {
            Root::Ratio { denominator: d, .. } | Root::Quadratic { a: d, .. } => {
                let value = guard.unwrap_or(d);
                return Near { value, is_square: false, share: share(BESIDE * usual), size: scale };
            }
            Root::Direction { x, y, .. } | Root::Line { x, y } | Root::Length { x, y } => square(&[x, y]),
            Root::Sincos { a, b, .. } => square(&[a, b]),
            Root::Quartic { cc, cs, c, s, one } => square(&[cc, cs, c, s, one]),
        };
        match (guard, natural) {
            (None, Some(value)) => {
                let share = share((BESIDE * usual).powi(2));
                Near { value, is_square: true, share, size: scale * scale }
            }
            (value, _) => {
                let value = value.unwrap_or(Expr::int(0));
                Near { value, is_square: false, share: share(BESIDE * usual), size: scale }
            }
        }
    }

    /// Nothing, if numbers already say that it is large.
    fn unless_never(self) -> Option<Self> {
        let value = self.value.eval(|_| None).ok();
        let never = value.zip(self.least()).is_some_and(|(value, least)| value.abs() > least);
        (!never).then_some(self)
    }

    /// The share of the size, if numbers say it.
    pub fn least(&self) -> Option<f64> {
        self.size.eval(|_| None).ok().map(|size| two_digits(self.share * size))
    }

    fn formulas(&self) -> [Expr; 2] {
        [self.value, self.size]
    }
}

/// They say enough of what is small.
fn two_digits(x: f64) -> f64 {
    format!("{x:.1e}").parse().unwrap_or(x)
}

/// The kinds of roots.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Kind {
    Ratio,
    Direction,
    Line,
    Length,
    Sincos,
    Quadratic,
    Quartic,
}

impl Kind {
    pub const ALL: [Kind; 7] = [
        Kind::Ratio,
        Kind::Direction,
        Kind::Line,
        Kind::Length,
        Kind::Sincos,
        Kind::Quadratic,
        Kind::Quartic,
    ];

    /// Its name in the emitted code.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Ratio => "ratio",
            Kind::Direction => "direction",
            Kind::Line => "line",
            Kind::Length => "length",
            Kind::Sincos => "sincos",
            Kind::Quadratic => "quadratic",
            Kind::Quartic => "quartic",
        }
    }
}

/// A solver in the words of a language.
pub(crate) struct Plan<'a> {
    pub routine: &'a SolverRoutine<'a>,
    /// Its own name.
    pub name: String,
    /// The names of the arrays of variables and of results.
    pub argument: String,
    pub result: String,
    /// Identifiers of everything in it.
    pub names: Names,
    /// What depends on parameters alone.
    pub hoisted: Vec<Step>,
    /// What is known before each node, and at the end what the residual needs.
    pub levels: Vec<Vec<Step>>,
    pub nodes: Vec<Branching>,
    /// What only the results need.
    pub leaf: Vec<Step>,
    pub outputs: Vec<Expr>,
    pub residual: Expr,
    /// Rounding may hide branches: it is never certain that all are found.
    pub may_hide: bool,
    /// How far the variables are from what they must be, if that is known, and the size.
    pub defect: Option<Expr>,
    pub size: Expr,
    reads: FxHashSet<Symbol>,
}

/// The solvers of a library. `names` holds the identifiers of its parameters, `taken` what functions are not called.
pub(crate) fn plans<'a>(
    library: &'a Library,
    language: Language,
    names: &Names,
    reserved: &[&str],
    taken: &[String],
) -> Vec<Plan<'a>> {
    let taken: Vec<&str> = taken.iter().map(String::as_str).collect();
    let mut functions =
        Names::new(language, &[reserved, &["test", "parameters", "defaults"], &taken].concat());
    let plan = |routine: &'a SolverRoutine<'a>| {
        let name = sanitised(&routine.name).to_lowercase();
        Plan::new(routine, functions.free(name[..name.len().min(MAX_NAME)].trim_end_matches('_')), names)
    };
    library.solvers.iter().map(plan).collect()
}

impl<'a> Plan<'a> {
    fn new(routine: &'a SolverRoutine<'a>, name: String, names: &Names) -> Self {
        let solver = routine.solver;
        let mut names = names.clone();
        let argument = names.free(&sanitised(&routine.argument));
        let result = match sanitised(&routine.result) {
            taken if FIELDS.contains(&taken.to_lowercase().as_str()) => format!("{taken}_2"),
            free => free,
        };
        let result = names.free(&result);

        // Registers, and what stands in them.
        let mut held: FxHashMap<Register, Expr> = FxHashMap::default();
        let mut names_of_registers: FxHashSet<Symbol> = FxHashSet::default();
        for (k, s) in solver.variables.iter().enumerate() {
            held.insert(k as Register, Expr::from(*s));
            names.declare(*s);
        }
        let results = solver.nodes.iter().flat_map(|n| &n.results);
        for (register, s) in (solver.variables.len() as Register..).zip(results) {
            held.insert(register, Expr::from(*s));
            names.declare(*s);
        }
        for level in &solver.levels {
            for (name, _) in level.program.outputs() {
                names_of_registers.insert(Symbol::new(name));
                names.declare(Symbol::new(name));
            }
        }

        let mut renaming = Renaming { defined: FxHashSet::default(), names: &mut names };
        let mut hoisted: Vec<Step> = vec![];
        let mut levels: Vec<Vec<Step>> = vec![];
        let mut plain: FxHashMap<Symbol, Expr> = FxHashMap::default();
        for level in &solver.levels {
            let listing = Listing::new(&level.program, renaming.names);
            let written: FxHashSet<Symbol> =
                level.program.outputs().iter().map(|(name, _)| Symbol::new(name)).collect();
            let reserved = |s: Symbol| names_of_registers.contains(&s) && !written.contains(&s);
            let mut steps = Steps { list: vec![], names: renaming.names };
            steps.statements(&listing.hoisted);
            let fixed = std::mem::take(&mut steps.list);
            steps.statements(&listing.body);
            let body = steps.list;
            let mut map = plain.clone();
            for step in fixed {
                renaming.add(step, &mut map, &reserved, &mut hoisted, true);
            }
            let mut list = vec![];
            for step in body {
                renaming.add(step, &mut map, &reserved, &mut list, false);
            }
            for (((name, _), value), &r) in
                level.program.outputs().iter().zip(&listing.results).zip(&level.writes)
            {
                let value = value.substitute(|s| map.get(&s).copied());
                held.insert(r, value);
                if value != Expr::symbol(name) {
                    plain.insert(Symbol::new(name), value);
                }
            }
            levels.push(list);
        }

        let of = |r: Register| held[&r];
        let size = of(solver.size);
        let mut stride = solver.max_solutions();
        let mut nodes = vec![];
        for (i, node) in solver.nodes.iter().enumerate() {
            stride /= node.root.branches();
            let root = node.root.map(of);
            let natural = match root {
                Root::Ratio { denominator, .. } => Some(denominator),
                Root::Direction { x, y, .. } | Root::Line { x, y } | Root::Length { x, y } => {
                    Some((x * x + y * y).sqrt())
                }
                Root::Sincos { a, b, .. } => Some((a * a + b * b).sqrt()),
                Root::Quadratic { a, .. } => Some(a),
                Root::Quartic { .. } => None,
            };
            let scale = if node.degree == 0 { Expr::int(1) } else { size.powi(node.degree.into()) };
            let usual = routine.usual.get(i).copied().unwrap_or(1.0);
            let unnamed = || format!("node {i} ({})", node.results[0].name());
            nodes.push(Branching {
                root,
                near: Near::new(&root, node.guard.map(of), scale, usual).unless_never(),
                guard: node.guard.map(of).or(natural),
                scale,
                results: node.results.clone(),
                stride,
                label: plain_text(&node.label.clone().unwrap_or_else(unnamed)),
            });
        }
        let outputs: Vec<Expr> = solver.outputs.iter().map(|(_, r)| of(*r)).collect();
        let residual = of(solver.residual);
        let mut plan = Plan {
            routine,
            name,
            argument,
            result,
            names,
            hoisted,
            levels,
            nodes,
            leaf: vec![],
            outputs,
            residual,
            may_hide: may_hide(routine.usual.iter().copied()),
            defect: solver.defect.map(of),
            size,
            reads: FxHashSet::default(),
        };
        plan.prune();
        plan
    }

    /// Drops what nothing reads, and puts what only the results need behind the residual.
    fn prune(&mut self) {
        let last = self.levels.pop().expect("a level more than nodes");
        let mut for_residual: FxHashSet<Symbol> = FxHashSet::default();
        let first = needed_of(last.clone(), &mut for_residual, self.residual.symbols());
        let first: FxHashSet<Symbol> = first.iter().flat_map(defined).collect();
        let is_first = |step: &Step| defined(step).iter().any(|s| first.contains(s));
        let (residual, leaf): (Vec<Step>, Vec<Step>) = last.into_iter().partition(is_first);
        let mut needed: FxHashSet<Symbol> = FxHashSet::default();
        self.leaf = needed_of(leaf, &mut needed, self.outputs.iter().flat_map(|e| e.symbols()).collect());
        self.levels.push(needed_of(residual, &mut needed, self.residual.symbols()));
        for i in (0..self.nodes.len()).rev() {
            let node = &self.nodes[i];
            let read = node.operands().into_iter().chain(node.guard).chain([node.scale]);
            let read = read.chain(node.near.iter().flat_map(Near::formulas));
            let at_first = self.defect.into_iter().chain([self.size]).filter(|_| i == 0);
            let read = read.chain(at_first);
            needed.extend(read.flat_map(|e| e.symbols()));
            let level = std::mem::take(&mut self.levels[i]);
            self.levels[i] = needed_of(level, &mut needed, vec![]);
        }
        let hoisted = std::mem::take(&mut self.hoisted);
        self.hoisted = needed_of(hoisted, &mut needed, vec![]);
        self.reads = needed;
    }

    /// Whether a variable, a parameter or a result of a root is read.
    pub fn reads(&self, symbol: Symbol) -> bool {
        self.reads.contains(&symbol)
    }

    /// The parameters that are read, in order.
    pub fn parameters(&self, library: &Library) -> Vec<Symbol> {
        library.parameters.iter().map(|p| p.symbol).filter(|s| self.reads(*s)).collect()
    }

    /// The variables that are read, in order, with their places.
    pub fn variables(&self) -> Vec<(usize, Symbol)> {
        let symbols = self.routine.solver.variables.iter().copied().enumerate();
        symbols.filter(|(_, s)| self.reads(*s)).collect()
    }

    /// All steps.
    pub fn steps(&self) -> impl Iterator<Item = &Step> {
        self.hoisted.iter().chain(self.levels.iter().flatten()).chain(&self.leaf)
    }

    /// How many solutions there are at most.
    pub fn max(&self) -> usize {
        self.routine.solver.max_solutions()
    }

    /// Whether its formulas have roots of what is no constant.
    pub fn any_root(&self) -> bool {
        let nodes = self.nodes.iter().flat_map(|n| n.operands().into_iter().chain(n.guard).chain([n.scale]));
        let ends = [self.residual, self.size].into_iter().chain(self.defect);
        let all: Vec<Expr> = self.steps().flat_map(formulas).chain(nodes).chain(ends).collect();
        let is_root = |e: &Expr| matches!(e.node(), Node::Sqrt(_)) && !e.symbols().is_empty();
        Expr::postorder(&all).iter().any(is_root)
    }

    /// The words for each branch, by its number: `shoulder +, elbow -`.
    pub fn labels(&self) -> Vec<String> {
        let one = |branch: usize| {
            let mark = |n: &Branching| {
                let digit = branch / n.stride % n.root.branches();
                format!("{} {}", n.label, n.marks()[digit])
            };
            let branching = self.nodes.iter().filter(|n| n.root.branches() > 1);
            branching.map(mark).collect::<Vec<_>>().join(", ")
        };
        (0..self.max()).map(one).collect()
    }

    /// What holds of the results in every language.
    pub fn about(&self) -> Vec<String> {
        let mut lines = self.routine.about.clone();
        lines.push(String::new());
        lines.push(format!(
            "At most {}. Each has a residual (at most 1e-9{}), a multiplicity (branches that come together, \
             within 2e-7), the number of its branch, and a bit for each unknown that is free there, of whose family \
             it is one member:",
            if self.max() == 1 { "1 solution".into() } else { format!("{} solutions", self.max()) },
            if self.defect.is_some() { ", or what rounding of the rotation leaves" } else { "" },
        ));
        for (i, (node, own)) in self.nodes.iter().zip(&self.routine.solver.nodes).enumerate() {
            let results = &node.results[..1 + usize::from(node.root.is_angle())];
            let of: Vec<&str> = results.iter().map(|s| self.names.of(*s)).collect();
            let of = of.join(", ");
            lines.push(match own.label {
                Some(_) => format!("  bit {i}: {} ({of})", node.label),
                None => format!("  bit {i}: {of}"),
            });
        }
        lines.push(String::new());
        lines.push(
            "With them comes a certificate. Complete: these are all; where there is none, the arm does not reach. Singular: \
             an unknown is free somewhere, or nearly so; what is there solves the equations, and there may be more."
                .into(),
        );
        if self.may_hide {
            lines.push(
                "This arm is solved by dividing by so little that rounding may hide branches: complete is never said.".into(),
            );
        }
        lines.push(match self.defect {
            Some(_) => "Not a pose: the rotation is off by more than 1e-5 from all rotations, or something is no number; by \
                 less, the nearest rotation is meant."
                .into(),
            None => "Not a pose: something is no number.".into(),
        });
        lines
    }

    /// Whether some root of the kind is taken.
    pub fn any(plans: &[Self], kind: Kind) -> bool {
        plans.iter().flat_map(|p| &p.nodes).any(|n| n.kind() == kind)
    }

    pub fn any_atan2(plans: &[Self]) -> bool {
        plans.iter().flat_map(Plan::steps).any(|s| matches!(s, Step::Atan2 { .. }))
    }

    pub fn any_pair(plans: &[Self]) -> bool {
        plans.iter().flat_map(Plan::steps).any(|s| matches!(s, Step::Pairs(_)))
    }
}

/// New names for intermediates of one level that another level uses too.
struct Renaming<'a> {
    defined: FxHashSet<Symbol>,
    names: &'a mut Names,
}

impl Renaming<'_> {
    fn add(
        &mut self,
        step: Step,
        map: &mut FxHashMap<Symbol, Expr>,
        reserved: &impl Fn(Symbol) -> bool,
        list: &mut Vec<Step>,
        is_shared: bool,
    ) {
        let step = substituted(step, map);
        if is_shared {
            // The same value under another name.
            let same = |old: &Step| match (old, &step) {
                (Step::Let { name: a, value: x }, Step::Let { name: b, value: y }) if x == y => {
                    Some((Symbol::new(b), Expr::symbol(a)))
                }
                _ => None,
            };
            if let Some((name, known)) = list.iter().find_map(same) {
                map.insert(name, known);
                return;
            }
        }
        let mut fresh = |name: String| {
            let symbol = Symbol::new(&name);
            if self.defined.insert(symbol) && !reserved(symbol) {
                return name;
            }
            let new = self.names.fresh(&name);
            self.defined.insert(Symbol::new(&new));
            map.insert(symbol, Expr::symbol(&new));
            new
        };
        let step = match step {
            Step::Break => return,
            Step::Pairs(pairs) => Step::Pairs(
                pairs
                    .into_iter()
                    .map(|p| Pair {
                        angle: p.angle,
                        sine: p.sine.map(&mut fresh),
                        cosine: p.cosine.map(&mut fresh),
                    })
                    .collect(),
            ),
            Step::Atan2 { name, y, x } => Step::Atan2 { name: fresh(name), y, x },
            Step::Let { name, value } => Step::Let { name: fresh(name), value },
            Step::Result { .. } => unreachable!("levels have registers"),
        };
        list.push(step);
    }
}

fn substituted(step: Step, map: &FxHashMap<Symbol, Expr>) -> Step {
    let new = |e: Expr| e.substitute(|s| map.get(&s).copied());
    match step {
        Step::Break => Step::Break,
        Step::Pairs(pairs) => {
            Step::Pairs(pairs.into_iter().map(|p| Pair { angle: new(p.angle), ..p }).collect())
        }
        Step::Atan2 { name, y, x } => Step::Atan2 { name, y: new(y), x: new(x) },
        Step::Let { name, value } => Step::Let { name, value: new(value) },
        Step::Result { place, value } => Step::Result { place, value: new(value) },
    }
}

/// The names that a step defines.
pub(crate) fn defined(step: &Step) -> Vec<Symbol> {
    match step {
        Step::Pairs(pairs) => {
            pairs.iter().flat_map(|p| [&p.sine, &p.cosine]).flatten().map(|name| Symbol::new(name)).collect()
        }
        Step::Atan2 { name, .. } | Step::Let { name, .. } => vec![Symbol::new(name)],
        Step::Break | Step::Result { .. } => vec![],
    }
}

/// The steps whose names are needed, in order; adds what they read.
fn needed_of(steps: Vec<Step>, needed: &mut FxHashSet<Symbol>, more: Vec<Symbol>) -> Vec<Step> {
    needed.extend(more);
    let mut kept = vec![];
    for step in steps.into_iter().rev() {
        if defined(&step).iter().any(|s| needed.contains(s)) {
            let step = with_names_of(step, needed);
            needed.extend(formulas(&step).iter().flat_map(|e| e.symbols()));
            kept.push(step);
        }
    }
    kept.reverse();
    kept
}

/// Sines and cosines without the names that nothing reads.
fn with_names_of(step: Step, needed: &FxHashSet<Symbol>) -> Step {
    match step {
        Step::Pairs(pairs) => {
            let keep = |name: Option<String>| name.filter(|name| needed.contains(&Symbol::new(name)));
            let pairs = pairs.into_iter().map(|p| Pair {
                angle: p.angle,
                sine: keep(p.sine),
                cosine: keep(p.cosine),
            });
            Step::Pairs(pairs.filter(|p| p.sine.is_some() || p.cosine.is_some()).collect())
        }
        other => other,
    }
}
