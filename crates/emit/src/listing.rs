//! A program as the statements that a person would write: named intermediates, one statement a line.

use crate::names::Names;
use denavit_program::Program;
use denavit_program::Stage;
use denavit_symbolic::{Angle, Expr, Node, Symbol};
use rustc_hash::{FxHashMap, FxHashSet};

/// A statement.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Statement {
    /// The sine and cosine of an angle; what is not read has no name.
    Pair { angle: Expr, sine: Option<String>, cosine: Option<String> },
    /// A named value.
    Let { name: String, value: Expr },
}

/// A program as statements. Formulas contain symbols, numbers, sums, products, quotients, roots and arctangents;
/// sines and cosines are names of [`Statement::Pair`].
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Listing {
    /// What depends on parameters alone.
    pub hoisted: Vec<Statement>,
    /// What depends on variables; it opens with the sines and cosines of angles that only variables and
    /// parameters enter.
    pub body: Vec<Statement>,
    /// The results in order, each a name with or without sign, or a number.
    pub results: Vec<Expr>,
}

impl Listing {
    /// The statements of a program. `names` holds identifiers for its variables and parameters, and receives those
    /// of its intermediates.
    pub fn new(program: &Program, names: &mut Names) -> Self {
        let steps = program.steps();
        steps.iter().for_each(|step| names.declare(Symbol::new(&step.name)));
        let variables = program.variables();
        let mut builder = Builder { variables, pairs: FxHashMap::default(), order: vec![], names };
        // What needs no statement of its own: another name, or a number as a result.
        let mut plain: FxHashMap<Symbol, Expr> = FxHashMap::default();
        let mut lets: Vec<(Stage, String, Expr)> = vec![];
        for step in steps {
            let value = builder.without_sines(step.value.substitute(|s| plain.get(&s).copied()));
            if is_signed_symbol(value) || step.is_output && value.symbols().is_empty() {
                plain.insert(Symbol::new(&step.name), value);
            } else {
                lets.push((step.stage, step.name, value));
            }
        }
        let Builder { pairs, order, .. } = builder;
        let result = |name: &str| plain.get(&Symbol::new(name)).copied().unwrap_or(Expr::symbol(name));
        let results: Vec<Expr> = program.outputs().iter().map(|(name, _)| result(name)).collect();

        // Angles stand before the first statement that reads them, in front of all if inputs are enough.
        let parameters: FxHashSet<Symbol> = program.parameters().iter().copied().collect();
        let inputs: FxHashSet<Symbol> =
            program.variables().iter().copied().chain(parameters.iter().copied()).collect();
        let (mut hoisted, mut body) = (vec![], vec![]);
        let mut placed: FxHashSet<Expr> = FxHashSet::default();
        for angle in &order {
            let symbols = angle.symbols();
            if symbols.iter().all(|s| inputs.contains(s)) {
                let list =
                    if symbols.iter().all(|s| parameters.contains(s)) { &mut hoisted } else { &mut body };
                list.push(pairs[angle].statement(*angle));
                placed.insert(*angle);
            }
        }
        // Those that a formula reads and are not placed yet, behind those that their angles read.
        let mut place_read = |value: Expr, list: &mut Vec<Statement>| {
            let mut read: FxHashSet<Symbol> = value.symbols().into_iter().collect();
            let mut missing: Vec<Expr> = vec![];
            for angle in order.iter().rev().filter(|angle| !placed.contains(*angle)) {
                let pair = &pairs[angle];
                if read.iter().any(|s| pair.is(&s.name())) {
                    read.extend(angle.symbols());
                    missing.push(*angle);
                }
            }
            for angle in missing.into_iter().rev() {
                list.push(pairs[&angle].statement(angle));
                placed.insert(angle);
            }
        };
        for (stage, name, value) in lets {
            let list = if stage == Stage::Variable { &mut body } else { &mut hoisted };
            place_read(value, list);
            list.push(Statement::Let { name, value });
        }
        results.iter().for_each(|result| place_read(*result, &mut body));
        Listing { hoisted, body, results }
    }
}

/// −x or x.
fn is_signed_symbol(e: Expr) -> bool {
    match e.node() {
        Node::Neg(a) => a.as_symbol().is_some(),
        _ => e.as_symbol().is_some(),
    }
}

/// Names of a sine and cosine.
struct Pair {
    sine: String,
    cosine: String,
    reads_sine: bool,
    reads_cosine: bool,
}

impl Pair {
    fn is(&self, name: &str) -> bool {
        self.sine == name || self.cosine == name
    }

    fn statement(&self, angle: Expr) -> Statement {
        Statement::Pair {
            angle,
            sine: self.reads_sine.then(|| self.sine.clone()),
            cosine: self.reads_cosine.then(|| self.cosine.clone()),
        }
    }
}

struct Builder<'a> {
    variables: &'a [Symbol],
    pairs: FxHashMap<Expr, Pair>,
    order: Vec<Expr>,
    names: &'a mut Names,
}

impl Builder<'_> {
    /// The formula with names in place of its sines and cosines.
    fn without_sines(&mut self, e: Expr) -> Expr {
        let mut done: FxHashMap<Expr, Expr> = FxHashMap::default();
        for part in Expr::postorder(&[e]) {
            let of = |x: Expr| done[&x];
            let new = match part.node() {
                Node::Number(_) | Node::Pi | Node::Symbol(_) => part,
                Node::Sin(_) | Node::Cos(_) if part.symbols().is_empty() => part,
                Node::Sin(a) => {
                    let angle = of(a);
                    let pair = self.pair(angle);
                    pair.reads_sine = true;
                    Expr::symbol(&pair.sine)
                }
                Node::Cos(a) => {
                    let angle = of(a);
                    let pair = self.pair(angle);
                    pair.reads_cosine = true;
                    Expr::symbol(&pair.cosine)
                }
                Node::Neg(a) => -of(a),
                Node::Add(a, b) => of(a) + of(b),
                Node::Sub(a, b) => of(a) - of(b),
                Node::Mul(a, b) => of(a) * of(b),
                Node::Div(a, b) => of(a) / of(b),
                Node::Pow(a, n) => of(a).powi(n),
                Node::Sqrt(a) => of(a).sqrt(),
                Node::Atan2(a, b) => of(a).atan2(of(b)),
                Node::Sign(a) => of(a).sign(),
            };
            done.insert(part, new);
        }
        done[&e]
    }

    fn pair(&mut self, angle: Expr) -> &mut Pair {
        if !self.pairs.contains_key(&angle) {
            let index = index(angle, self.variables).unwrap_or(format!("a{}", self.order.len() + 1));
            let [sine, cosine] = ["s", "c"].map(|letter| self.names.fresh(&format!("{letter}{index}")));
            self.order.push(angle);
            self.pairs.insert(angle, Pair { sine, cosine, reads_sine: false, reads_cosine: false });
        }
        self.pairs.get_mut(&angle).expect("inserted above")
    }
}

/// What sines of a sum are called by, behind their letter: `23` for q2 + q3, the numbers of variables, but `_q2_al3`,
/// with all names, where something else enters.
fn index(angle: Expr, variables: &[Symbol]) -> Option<String> {
    let form = Angle::of(angle);
    let is_plain_sum = form.to_expr() == angle && form.terms.iter().all(|t| t.1.is_one());
    if !is_plain_sum || form.terms.is_empty() {
        return None;
    }
    let symbols: Vec<Symbol> = form.terms.iter().map(|t| t.0.as_symbol()).collect::<Option<_>>()?;
    let names: Vec<_> = symbols.iter().map(|s| s.name()).collect();
    let number = |name: &str| name[name.trim_end_matches(|c: char| c.is_ascii_digit()).len()..].to_string();
    let numbers: Vec<String> = names.iter().map(|name| number(name)).collect();
    if symbols.iter().all(|s| variables.contains(s)) && numbers.iter().all(|n| !n.is_empty()) {
        let separator = if numbers.iter().any(|n| n.len() > 1) { "_" } else { "" };
        return Some(numbers.join(separator));
    }
    Some(names.iter().map(|name| format!("_{name}")).collect())
}
