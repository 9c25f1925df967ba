//! Angles as pairs: the cosine and sine of an angle in the place of the angle, as an input or as a result.

use crate::graph::{Graph, Op, Value};
use crate::program::{Program, names_of};
use crate::rebuild::{Rebuild, apply, signed, unique};
use denavit_symbolic::{Rational, Symbol};
use rustc_hash::FxHashMap;
use std::fmt;

/// The largest multiple of an angle that is expanded: the rounding error grows with the multiple.
const LARGEST_MULTIPLE: i64 = 1024;

/// Why a program cannot do with the sine and cosine of an angle.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct PairRefusal {
    /// The angle.
    pub variable: Symbol,
    /// What stands in the way.
    pub reason: PairReason,
}

/// What stands in the way of a pair.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum PairReason {
    /// The program has no such variable.
    NotAVariable,
    /// An operation (its number in [`Program::ops`]) reads the angle outside a sine or cosine.
    Operation(u32),
    /// A sine or cosine (its number in [`Program::ops`]) of a part of the angle, or of more than
    /// 1024 times the angle.
    Multiple(u32),
    /// A result depends on the angle itself.
    Result(String),
}

impl fmt::Display for PairRefusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = self.variable.name();
        match &self.reason {
            PairReason::NotAVariable => write!(f, "there is no variable `{name}`"),
            PairReason::Operation(n) => write!(f, "operation {n} reads `{name}` outside a sine or cosine"),
            PairReason::Multiple(n) => {
                write!(f, "operation {n} takes the sine or cosine of a part or a large multiple of `{name}`")
            }
            PairReason::Result(result) => {
                write!(f, "the result `{result}` is not a function of the sine and cosine of `{name}`")
            }
        }
    }
}

impl std::error::Error for PairRefusal {}

impl Program {
    /// The same with two variables, `c_<name>` and `s_<name>`, in the place of each of the given ones: the cosine and
    /// the sine of the angle. Sines and cosines of sums of angles, of their differences and whole multiples, and of
    /// sums with anything else are expanded by the addition theorems, each partial sum once.
    ///
    /// # Errors
    /// The first use of an angle that its sine and cosine do not determine.
    pub fn with_pairs(&self, variables: &[Symbol]) -> Result<Program, PairRefusal> {
        if let Some(&variable) = variables.iter().find(|v| !self.variables().contains(v)) {
            return Err(PairRefusal { variable, reason: PairReason::NotAVariable });
        }
        let mut used = names_of(self);
        let (mut inputs, mut angles) = (vec![], vec![]);
        for variable in self.variables() {
            if variables.contains(variable) {
                let mut input =
                    |prefix| Symbol::new(&unique(&format!("{prefix}_{}", variable.name()), &mut used));
                let pair = [input("c"), input("s")];
                inputs.extend(pair);
                angles.push((*variable, pair));
            } else {
                inputs.push(*variable);
            }
        }
        let mut expansion = Expansion::new(Rebuild::new(self, &inputs, used), angles);
        let mut at: Vec<Part> = Vec::with_capacity(self.ops().len());
        for (i, (op, _)) in self.ops().iter().enumerate() {
            let part = expansion.operation(i as u32, op, &at)?;
            if let Part::Plain(v) = part {
                expansion.work.keep_name(self, i as u32, v);
            }
            at.push(part);
        }
        let mut outputs = vec![];
        for (name, v) in self.outputs() {
            match &at[v.node as usize] {
                Part::Plain(own) => outputs.push((name.clone(), signed(*own, v.negative))),
                Part::Angle(angle) => return Err(expansion.refuse(angle, PairReason::Result(name.clone()))),
            }
        }
        Ok(expansion.work.finish(&outputs))
    }

    /// The same with two results, `c_<name>` and `s_<name>`, in the place of each that is an arctangent: the cosine
    /// and the sine of the angle, `(x, y)/√(x² + y²)` for atan2(y, x). Other results stay.
    pub fn results_as_pairs(&self) -> Program {
        let mut work = Rebuild::new(self, self.variables(), names_of(self));
        let at = work.copy(self);
        let mut outputs = vec![];
        for (name, v) in self.outputs() {
            let own = signed(at[v.node as usize], v.negative);
            let Op::Atan2(y, x) = *work.graph.op(own.node) else {
                outputs.push((name.clone(), own));
                continue;
            };
            let graph = &mut work.graph;
            let (xx, yy) = (graph.mul(x, x), graph.mul(y, y));
            let square = graph.add(xx, yy);
            let length = graph.sqrt(square);
            let (cosine, sine) = (graph.div(x, length), graph.div(y, length));
            outputs.push((work.unique(&format!("c_{name}")), cosine));
            outputs.push((work.unique(&format!("s_{name}")), signed(sine, own.negative)));
        }
        work.finish(&outputs)
    }
}

/// What an operation of the old program is in the new one.
enum Part {
    /// A value.
    Plain(Value),
    /// An angle that has no value, only a cosine and a sine.
    Angle(Angle),
}

/// `Σ kᵢ·angleᵢ + rest`, with at least one angle; angles are numbered and in order, no kᵢ is 0.
#[derive(Clone)]
struct Angle {
    multiples: Vec<(usize, Rational)>,
    rest: Value,
}

/// The same with whole multiples; no rest stands for 0.
#[derive(Clone, PartialEq, Eq, Hash)]
struct Sum {
    multiples: Vec<(usize, i64)>,
    rest: Option<Value>,
}

impl Sum {
    const EMPTY: Sum = Sum { multiples: vec![], rest: None };

    fn one(angle: usize, multiple: i64) -> Self {
        Sum { multiples: vec![(angle, multiple)], rest: None }
    }

    fn negated(&self) -> Self {
        let multiples = self.multiples.iter().map(|m| (m.0, -m.1)).collect();
        Sum { multiples, rest: self.rest.map(|v| -v) }
    }

    fn plus(&self, other: &Sum) -> Self {
        Sum {
            multiples: merged(&self.multiples, &other.multiples, |a, b| a + b),
            rest: self.rest.or(other.rest),
        }
    }

    /// What is missing to `whole`; `None` if that is not a sum of this kind.
    fn missing(&self, whole: &Sum) -> Option<Self> {
        let rest = match self.rest {
            None => whole.rest,
            own if own == whole.rest => None,
            _ => return None,
        };
        Some(Sum { multiples: merged(&whole.multiples, &self.negated().multiples, |a, b| a + b), rest })
    }

    fn size(&self) -> i64 {
        self.multiples.iter().map(|m| m.1.abs()).sum::<i64>() + i64::from(self.rest.is_some())
    }
}

/// Two lists in order as one; what adds up to 0 is left out.
fn merged<T: Clone + Default + PartialEq>(
    a: &[(usize, T)],
    b: &[(usize, T)],
    sum: impl Fn(&T, &T) -> T,
) -> Vec<(usize, T)> {
    let (mut a, mut b) = (a.iter().peekable(), b.iter().peekable());
    let mut all = vec![];
    loop {
        let next = match (a.peek(), b.peek()) {
            (None, None) => return all,
            (Some(x), Some(y)) if x.0 == y.0 => (x.0, sum(&x.1, &y.1)),
            (Some(x), Some(y)) if x.0 > y.0 => (*y).clone(),
            (Some(x), _) => (*x).clone(),
            (None, Some(y)) => (*y).clone(),
        };
        a.next_if(|x| x.0 == next.0);
        b.next_if(|y| y.0 == next.0);
        if next.1 != T::default() {
            all.push(next);
        }
    }
}

/// The cosine and the sine of an angle.
type Pair = [Value; 2];

/// `cos(a + b) = cos a cos b − sin a sin b`, `sin(a + b) = sin a cos b + cos a sin b`
fn added(graph: &mut Graph, [ca, sa]: Pair, [cb, sb]: Pair) -> Pair {
    let (cc, ss) = (graph.mul(ca, cb), graph.mul(sa, sb));
    let (sc, cs) = (graph.mul(sa, cb), graph.mul(ca, sb));
    [graph.sub(cc, ss), graph.add(sc, cs)]
}

/// The new program under construction.
struct Expansion {
    work: Rebuild,
    /// The angles, each with the inputs that replace it.
    angles: Vec<(Symbol, [Symbol; 2])>,
    /// Sums whose pair is there, in the order in which they were met.
    known: Vec<Sum>,
    pairs: FxHashMap<Sum, Pair>,
}

impl Expansion {
    fn new(work: Rebuild, angles: Vec<(Symbol, [Symbol; 2])>) -> Self {
        let mut own = Expansion { work, angles, known: vec![], pairs: FxHashMap::default() };
        for angle in 0..own.angles.len() {
            let pair = own.angles[angle].1.map(|s| own.work.graph.input(s));
            own.insert(Sum::one(angle, 1), pair);
        }
        own
    }

    fn refuse(&self, angle: &Angle, reason: PairReason) -> PairRefusal {
        PairRefusal { variable: self.angles[angle.multiples[0].0].0, reason }
    }

    fn operation(&mut self, number: u32, op: &Op, at: &[Part]) -> Result<Part, PairRefusal> {
        if let Op::Input(s) = op
            && let Some(angle) = self.angles.iter().position(|a| a.0 == *s)
        {
            let rest = self.work.graph.number(&Rational::ZERO);
            return Ok(Part::Angle(Angle { multiples: vec![(angle, Rational::ONE)], rest }));
        }
        let angle = op.nodes().find_map(|n| match &at[n as usize] {
            Part::Angle(angle) => Some(angle),
            Part::Plain(_) => None,
        });
        let Some(angle) = angle else {
            let plain = |n: u32| match &at[n as usize] {
                Part::Plain(v) => *v,
                Part::Angle(_) => unreachable!("no operand is an angle"),
            };
            return Ok(Part::Plain(apply(&mut self.work.graph, op, plain)));
        };
        let refusal = self.refuse(angle, PairReason::Operation(number));
        let factor = |graph: &Graph, n: u32| match &at[n as usize] {
            Part::Plain(v) => graph.as_number(*v),
            Part::Angle(_) => None,
        };
        match op {
            Op::Sin(_) | Op::Cos(_) => {
                let pair = self.expanded(number, angle)?;
                Ok(Part::Plain(pair[usize::from(matches!(op, Op::Sin(_)))]))
            }
            Op::Add(a, b) => Ok(self.combined(&at[*a as usize], &at[*b as usize], false)),
            Op::Sub(a, b) => Ok(self.combined(&at[*a as usize], &at[*b as usize], true)),
            Op::Mul(a, b) => {
                let graph = &self.work.graph;
                let factor = factor(graph, *a).or_else(|| factor(graph, *b)).ok_or(refusal)?;
                Ok(self.scaled(angle, &factor))
            }
            Op::Div(_, b) => {
                let divisor = factor(&self.work.graph, *b).and_then(|r| r.recip()).ok_or(refusal)?;
                Ok(self.scaled(angle, &divisor))
            }
            Op::Sqrt(_) | Op::Atan2(..) | Op::Sign(_) | Op::Number(_) | Op::Pi | Op::Input(_) => Err(refusal),
        }
    }

    /// `a + b`, or `a − b`.
    fn combined(&mut self, a: &Part, b: &Part, negative: bool) -> Part {
        let (first, x) = split(a);
        let (second, y) = split(b);
        let multiples =
            merged(first, &if negative { negated(second) } else { second.to_vec() }, |a, b| a + b);
        let rest = self.work.graph.add(x, signed(y, negative));
        part(multiples, rest)
    }

    fn scaled(&mut self, angle: &Angle, factor: &Rational) -> Part {
        let by = self.work.graph.number(factor);
        let rest = self.work.graph.mul(angle.rest, by);
        let multiples = angle.multiples.iter().map(|m| (m.0, &m.1 * factor));
        part(multiples.filter(|m| !m.1.is_zero()).collect(), rest)
    }

    /// The pair of an angle.
    fn expanded(&mut self, number: u32, angle: &Angle) -> Result<Pair, PairRefusal> {
        let mut multiples = vec![];
        for (place, k) in &angle.multiples {
            match k.to_integer().filter(|k| k.abs() <= LARGEST_MULTIPLE) {
                Some(k) => multiples.push((*place, k)),
                None => {
                    let reason = PairReason::Multiple(number);
                    return Err(PairRefusal { variable: self.angles[*place].0, reason });
                }
            }
        }
        let is_zero = self.work.graph.as_number(angle.rest).is_some_and(|r| r.is_zero());
        Ok(self.pair(&Sum { multiples, rest: (!is_zero).then_some(angle.rest) }))
    }

    fn lookup(&self, sum: &Sum) -> Option<Pair> {
        let negative = || self.pairs.get(&sum.negated()).map(|[c, s]| [*c, -*s]);
        self.pairs.get(sum).copied().or_else(negative)
    }

    /// The pair of a sum, from a known one that leaves little to be added; what is missing to that is added angle by
    /// angle, and all partial sums are known from then on.
    fn pair(&mut self, sum: &Sum) -> Pair {
        if let Some(pair) = self.lookup(sum) {
            return pair;
        }
        let both_signs = self.known.iter().flat_map(|k| [k.clone(), k.negated()]);
        let candidates = both_signs.filter_map(|k| k.missing(sum).map(|missing| (k, missing)));
        let best = candidates.min_by_key(|(_, missing)| (self.lookup(missing).is_none(), missing.size()));
        let (mut so_far, missing) = match best {
            Some((k, missing)) if missing.size() < sum.size() => (k, missing),
            _ => (Sum::EMPTY, sum.clone()),
        };
        let mut steps: Vec<Sum> = match self.lookup(&missing) {
            Some(_) => vec![missing],
            None => {
                let angles = missing.multiples.iter().map(|m| Sum::one(m.0, m.1));
                angles.chain(missing.rest.map(|_| Sum { multiples: vec![], rest: missing.rest })).collect()
            }
        };
        if so_far == Sum::EMPTY {
            so_far = steps.remove(0);
        }
        let mut pair = self.step(&so_far);
        for step in steps {
            let further = self.step(&step);
            pair = added(&mut self.work.graph, pair, further);
            so_far = so_far.plus(&step);
            self.insert(so_far.clone(), pair);
        }
        pair
    }

    /// The pair of a known sum, of a multiple of one angle, or of a rest.
    fn step(&mut self, sum: &Sum) -> Pair {
        if let Some(pair) = self.lookup(sum) {
            return pair;
        }
        let pair = match (&sum.multiples[..], sum.rest) {
            ([(angle, k)], None) => {
                let halves = [k / 2, k - k / 2].map(|half| self.step(&Sum::one(*angle, half)));
                added(&mut self.work.graph, halves[0], halves[1])
            }
            (_, rest) => offset(&mut self.work.graph, rest),
        };
        self.insert(sum.clone(), pair);
        pair
    }

    fn insert(&mut self, sum: Sum, pair: Pair) {
        if sum.rest.is_none() && sum.multiples.iter().all(|m| m.1 == 1) {
            let angles: Vec<String> =
                sum.multiples.iter().map(|m| self.angles[m.0].0.name().to_string()).collect();
            for (prefix, v) in ["c", "s"].into_iter().zip(pair) {
                if !v.negative {
                    self.work.names.entry(v.node).or_insert_with(|| format!("{prefix}_{}", angles.join("_")));
                }
            }
        }
        self.known.push(sum.clone());
        self.pairs.insert(sum, pair);
    }
}

/// The angles and the rest of an operand.
fn split(part: &Part) -> (&[(usize, Rational)], Value) {
    match part {
        Part::Plain(v) => (&[], *v),
        Part::Angle(angle) => (&angle.multiples, angle.rest),
    }
}

fn negated(multiples: &[(usize, Rational)]) -> Vec<(usize, Rational)> {
    multiples.iter().map(|m| (m.0, -&m.1)).collect()
}

fn part(multiples: Vec<(usize, Rational)>, rest: Value) -> Part {
    if multiples.is_empty() { Part::Plain(rest) } else { Part::Angle(Angle { multiples, rest }) }
}

/// The pair of what is not made of angles: exact at quarter turns.
fn offset(graph: &mut Graph, rest: Option<Value>) -> Pair {
    let zero = graph.number(&Rational::ZERO);
    let v = rest.unwrap_or(zero);
    let quarters = of_pi(graph, v).map(|r| &r * &Rational::from(2)).and_then(|r| r.to_integer());
    match quarters {
        Some(n) => {
            let (c, s) = [(1, 0), (0, 1), (-1, 0), (0, -1)][n.rem_euclid(4) as usize];
            [c, s].map(|x| graph.number(&Rational::from(x)))
        }
        None => [graph.cos(v), graph.sin(v)],
    }
}

/// r for a value that is written as r·π.
fn of_pi(graph: &Graph, v: Value) -> Option<Rational> {
    let magnitude = match *graph.op(v.node) {
        Op::Pi => Rational::ONE,
        Op::Mul(a, b) => {
            let is_pi = |n: u32| *graph.op(n) == Op::Pi;
            let factor = if is_pi(b) { a } else { b };
            if !is_pi(a) && !is_pi(b) {
                return None;
            }
            graph.as_number(Value { node: factor, negative: false })?
        }
        _ => return None,
    };
    Some(if v.negative { -magnitude } else { magnitude })
}
