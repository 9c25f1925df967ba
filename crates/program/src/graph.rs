//! The value-numbered graph: equal operations on equal values are one node.
//!
//! A [`Value`] is a node with a sign, so that `a·(−b)` and `−(a·b)` are one product and negation costs nothing.
//! Operands of sums and products are ordered; numbers are folded; nothing else is rewritten.

use crate::count::Count;
use denavit_symbolic::{Expr, Node, Rational, Symbol};
use rustc_hash::FxHashMap;
use std::cell::RefCell;

/// A node's result, with a sign.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Value {
    /// The number of the node.
    pub node: u32,
    /// True for its negative.
    pub negative: bool,
}

impl std::ops::Neg for Value {
    type Output = Value;
    fn neg(self) -> Value {
        Value { negative: !self.negative, ..self }
    }
}

/// When a value is known.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Stage {
    /// A number.
    Constant,
    /// Once the parameters are known; computed once and hoisted.
    Parameter,
    /// At every evaluation.
    Variable,
}

/// An operation. Operands without sign are magnitudes: the sign is in front of the result.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum Op {
    /// A rational that is not negative.
    Number(Rational),
    /// The constant π.
    Pi,
    /// An input.
    Input(Symbol),
    /// `a + b`
    Add(u32, u32),
    /// `a − b`
    Sub(u32, u32),
    /// `a · b`
    Mul(u32, u32),
    /// `a / b`
    Div(u32, u32),
    /// `√a`
    Sqrt(Value),
    /// `sin a`
    Sin(u32),
    /// `cos a`
    Cos(u32),
    /// `atan2(a, b)`
    Atan2(Value, Value),
}

impl Op {
    /// The nodes that the operation reads.
    pub fn operands(&self) -> impl Iterator<Item = u32> + use<> {
        let (a, b) = match *self {
            Op::Number(_) | Op::Pi | Op::Input(_) => (None, None),
            Op::Sqrt(a) => (Some(a.node), None),
            Op::Sin(a) | Op::Cos(a) => (Some(a), None),
            Op::Add(a, b) | Op::Sub(a, b) | Op::Mul(a, b) | Op::Div(a, b) => (Some(a), Some(b)),
            Op::Atan2(a, b) => (Some(a.node), Some(b.node)),
        };
        a.into_iter().chain(b)
    }
}

/// Nodes under construction.
pub struct Graph<F: Fn(Symbol) -> Stage> {
    ops: Vec<Op>,
    stages: Vec<Stage>,
    numbers: FxHashMap<Op, u32>,
    traced: FxHashMap<Expr, Value>,
    stage_of: F,
    /// For each node the last walk that met it, and the number of that walk.
    marks: RefCell<(Vec<u32>, u32)>,
}

impl<F: Fn(Symbol) -> Stage> Graph<F> {
    /// An empty graph; `stage_of` says when each input is known.
    pub fn new(stage_of: F) -> Self {
        Graph {
            ops: vec![],
            stages: vec![],
            numbers: FxHashMap::default(),
            traced: FxHashMap::default(),
            stage_of,
            marks: RefCell::default(),
        }
    }

    /// The operation of a node.
    pub fn op(&self, node: u32) -> &Op {
        &self.ops[node as usize]
    }

    /// When a node's value is known.
    pub fn stage(&self, node: u32) -> Stage {
        self.stages[node as usize]
    }

    fn intern(&mut self, op: Op) -> Value {
        if let Some(&node) = self.numbers.get(&op) {
            return Value { node, negative: false };
        }
        let node = u32::try_from(self.ops.len()).expect("fewer than 2^32 nodes");
        let stage = match &op {
            Op::Number(_) | Op::Pi => Stage::Constant,
            Op::Input(s) => (self.stage_of)(*s),
            _ => op.operands().map(|o| self.stage(o)).max().unwrap_or(Stage::Constant),
        };
        self.ops.push(op.clone());
        self.stages.push(stage);
        self.numbers.insert(op, node);
        Value { node, negative: false }
    }

    /// A number.
    pub fn number(&mut self, r: &Rational) -> Value {
        let magnitude = self.intern(Op::Number(r.abs()));
        if r.is_negative() { -magnitude } else { magnitude }
    }

    /// The number behind a value, if it is one.
    pub fn as_number(&self, v: Value) -> Option<Rational> {
        match self.op(v.node) {
            Op::Number(r) => Some(if v.negative { -r } else { r.clone() }),
            _ => None,
        }
    }

    fn is_zero(&self, v: Value) -> bool {
        matches!(self.op(v.node), Op::Number(r) if r.is_zero())
    }

    fn is_unit(&self, v: Value) -> bool {
        matches!(self.op(v.node), Op::Number(r) if r.is_one())
    }

    /// `a + b`
    pub fn add(&mut self, a: Value, b: Value) -> Value {
        match (self.as_number(a), self.as_number(b)) {
            (Some(x), Some(y)) => return self.number(&(x + y)),
            (Some(x), _) if x.is_zero() => return b,
            (_, Some(y)) if y.is_zero() => return a,
            _ => {}
        }
        if a.node == b.node && a.negative != b.negative {
            return self.number(&Rational::ZERO);
        }
        let (a, b) = if a.node <= b.node { (a, b) } else { (b, a) };
        let sum = match a.negative == b.negative {
            true => self.intern(Op::Add(a.node, b.node)),
            false => self.intern(Op::Sub(a.node, b.node)),
        };
        if a.negative { -sum } else { sum }
    }

    /// `a − b`
    pub fn sub(&mut self, a: Value, b: Value) -> Value {
        self.add(a, -b)
    }

    /// `a · b`
    pub fn mul(&mut self, a: Value, b: Value) -> Value {
        let negative = a.negative != b.negative;
        let signed = |v: Value| if negative { -v } else { v };
        let (x, y) = (Value { negative: false, ..a }, Value { negative: false, ..b });
        if self.is_zero(x) || self.is_unit(y) {
            return if self.is_zero(x) { x } else { signed(x) };
        }
        if self.is_zero(y) || self.is_unit(x) {
            return if self.is_zero(y) { y } else { signed(y) };
        }
        if let (Some(r), Some(t)) = (self.as_number(x), self.as_number(y)) {
            let product = self.number(&(r * t));
            return signed(product);
        }
        let product = self.intern(Op::Mul(x.node.min(y.node), x.node.max(y.node)));
        signed(product)
    }

    /// `a / b`
    pub fn div(&mut self, a: Value, b: Value) -> Value {
        let negative = a.negative != b.negative;
        let (x, y) = (Value { negative: false, ..a }, Value { negative: false, ..b });
        let quotient = match (self.as_number(x), self.as_number(y)) {
            (_, Some(t)) if t.is_one() => x,
            (Some(r), Some(t)) if !t.is_zero() => self.number(&(r / t)),
            (None, Some(t)) if !t.is_zero() => {
                let inverse = self.number(&(Rational::ONE / t));
                self.mul(x, inverse)
            }
            (Some(r), None) if r.is_zero() => x,
            _ => self.intern(Op::Div(x.node, y.node)),
        };
        if negative { -quotient } else { quotient }
    }

    /// `aⁿ`, by repeated squaring.
    pub fn powi(&mut self, a: Value, n: i32) -> Value {
        let mut result = self.number(&Rational::ONE);
        let (mut base, mut k) = (a, n.unsigned_abs());
        while k > 0 {
            if k & 1 == 1 {
                result = self.mul(result, base);
            }
            k >>= 1;
            if k > 0 {
                base = self.mul(base, base);
            }
        }
        if n < 0 {
            let one = self.number(&Rational::ONE);
            return self.div(one, result);
        }
        result
    }

    /// The value of a formula, its parts shared with all that was traced before.
    pub fn trace(&mut self, e: Expr) -> Value {
        if let Some(&v) = self.traced.get(&e) {
            return v;
        }
        for part in Expr::postorder(&[e]) {
            if self.traced.contains_key(&part) {
                continue;
            }
            let of = |x: &Expr| self.traced[x];
            let v = match part.node() {
                Node::Number(r) => self.number(&r),
                Node::Pi => self.intern(Op::Pi),
                Node::Symbol(s) => self.intern(Op::Input(s)),
                Node::Neg(a) => -of(&a),
                Node::Add(a, b) => {
                    let (a, b) = (of(&a), of(&b));
                    self.add(a, b)
                }
                Node::Sub(a, b) => {
                    let (a, b) = (of(&a), of(&b));
                    self.sub(a, b)
                }
                Node::Mul(a, b) => {
                    let (a, b) = (of(&a), of(&b));
                    self.mul(a, b)
                }
                Node::Div(a, b) => {
                    let (a, b) = (of(&a), of(&b));
                    self.div(a, b)
                }
                Node::Pow(a, n) => {
                    let a = of(&a);
                    self.powi(a, n)
                }
                Node::Sqrt(a) => {
                    let a = of(&a);
                    self.intern(Op::Sqrt(a))
                }
                Node::Sin(a) => {
                    let a = of(&a);
                    let sine = self.intern(Op::Sin(a.node));
                    if a.negative { -sine } else { sine }
                }
                Node::Cos(a) => {
                    let a = of(&a);
                    self.intern(Op::Cos(a.node))
                }
                Node::Atan2(a, b) => {
                    let (a, b) = (of(&a), of(&b));
                    self.intern(Op::Atan2(a, b))
                }
            };
            self.traced.insert(part, v);
        }
        self.traced[&e]
    }

    /// The nodes that `outputs` need, in order of evaluation: what the first output needs comes first.
    pub fn reach(&self, outputs: &[Value]) -> Vec<u32> {
        let mut found = vec![];
        let mut seen = vec![false; self.ops.len()];
        let mut pending: Vec<(u32, bool)> = outputs.iter().rev().map(|v| (v.node, false)).collect();
        while let Some((node, operands_done)) = pending.pop() {
            if operands_done {
                found.push(node);
            } else if !std::mem::replace(&mut seen[node as usize], true) {
                pending.push((node, true));
                let operands: Vec<u32> = self.op(node).operands().collect();
                pending.extend(operands.iter().rev().map(|&o| (o, false)));
            }
        }
        found
    }

    /// What `outputs` cost, for walks that extend this one.
    pub fn walk(&self, outputs: &[Value]) -> Walk {
        let (marks, walks) = &mut *self.marks.borrow_mut();
        *walks += 1;
        let mut walk = Walk { number: *walks, angles: vec![], count: Count::default() };
        self.visit(outputs, marks, *walks, *walks, |n| {
            walk.count.include(n, |n| (self.op(n), self.stage(n)), &mut walk.angles);
        });
        walk
    }

    /// What the outputs of the last [`Graph::walk`] and these cost together.
    pub fn extended(&self, paid: &Walk, outputs: &[Value]) -> Count {
        let (marks, walks) = &mut *self.marks.borrow_mut();
        *walks += 1;
        let (mut count, mut angles) = (paid.count, paid.angles.clone());
        self.visit(outputs, marks, paid.number, *walks, |n| {
            count.include(n, |n| (self.op(n), self.stage(n)), &mut angles);
        });
        count
    }

    /// Visits what `outputs` need, but for nodes that carry the mark `paid` or `walk`; visited ones get `walk`.
    fn visit(
        &self,
        outputs: &[Value],
        marks: &mut Vec<u32>,
        paid: u32,
        walk: u32,
        mut visit: impl FnMut(u32),
    ) {
        marks.resize(self.ops.len(), 0);
        let mut pending: Vec<u32> = outputs.iter().map(|v| v.node).collect();
        while let Some(node) = pending.pop() {
            let mark = &mut marks[node as usize];
            if *mark != paid && *mark != walk {
                *mark = walk;
                visit(node);
                pending.extend(self.op(node).operands());
            }
        }
    }
}

/// A walk over the nodes that some outputs need.
#[derive(Clone, Debug)]
pub struct Walk {
    number: u32,
    angles: Vec<u32>,
    /// What they cost.
    pub count: Count,
}
