//! The value-numbered graph: equal operations on equal values are one node.
//!
//! A [`Value`] is a node with a sign, so that `a·(−b)` and `−(a·b)` are one product and negation costs nothing.
//! Operands of sums and products are ordered; numbers are folded; nothing else is rewritten.

mod count;
mod op;

pub use count::{COUNTING_RULE, Count};
pub use op::{Op, Stage, Value};

use denavit_symbolic::{Expr, Node, Rational, Symbol};
use rustc_hash::FxHashMap;
use std::cell::RefCell;

/// Nodes under construction.
#[derive(Clone, Debug)]
pub struct Graph {
    variables: Vec<Symbol>,
    parameters: Vec<Symbol>,
    ops: Vec<Op>,
    stages: Vec<Stage>,
    numbers: FxHashMap<Op, u32>,
    traced: FxHashMap<Expr, Value>,
    /// For each node the last walk that met it, and the number of that walk.
    marks: RefCell<(Vec<u32>, u32)>,
}

impl Graph {
    /// An empty graph. A symbol that is neither a variable nor a parameter becomes a further parameter when it is met.
    pub fn new(variables: &[Symbol], parameters: &[Symbol]) -> Self {
        Graph {
            variables: variables.to_vec(),
            parameters: parameters.to_vec(),
            ops: vec![],
            stages: vec![],
            numbers: FxHashMap::default(),
            traced: FxHashMap::default(),
            marks: RefCell::default(),
        }
    }

    /// The inputs that are known at every evaluation only.
    pub fn variables(&self) -> &[Symbol] {
        &self.variables
    }

    /// The inputs that are known before.
    pub fn parameters(&self) -> &[Symbol] {
        &self.parameters
    }

    /// The operation of a node.
    pub fn op(&self, node: u32) -> &Op {
        &self.ops[node as usize]
    }

    /// When a node's value is known.
    pub fn stage(&self, node: u32) -> Stage {
        self.stages[node as usize]
    }

    /// The node of an operation on nodes that are there; for what [`Graph::add`] and its like do not cover.
    pub(crate) fn intern(&mut self, op: Op) -> Value {
        if let Some(&node) = self.numbers.get(&op) {
            return Value { node, negative: false };
        }
        let node = u32::try_from(self.ops.len()).expect("fewer than 2^32 nodes");
        let stage = match &op {
            Op::Number(_) | Op::Pi => Stage::Constant,
            Op::Input(s) if self.variables.contains(s) => Stage::Variable,
            Op::Input(s) => {
                if !self.parameters.contains(s) {
                    self.parameters.push(*s);
                }
                Stage::Parameter
            }
            _ => op.nodes().map(|o| self.stage(o)).max().unwrap_or(Stage::Constant),
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

    /// An input.
    pub fn input(&mut self, s: Symbol) -> Value {
        self.intern(Op::Input(s))
    }

    /// `√a`
    pub fn sqrt(&mut self, a: Value) -> Value {
        match self.as_number(a).and_then(|r| r.sqrt()) {
            Some(root) => self.number(&root),
            None => self.intern(Op::Sqrt(a)),
        }
    }

    /// `sin a`
    pub fn sin(&mut self, a: Value) -> Value {
        if self.is_zero(a) {
            return a;
        }
        let sine = self.intern(Op::Sin(a.node));
        if a.negative { -sine } else { sine }
    }

    /// `cos a`
    pub fn cos(&mut self, a: Value) -> Value {
        if self.is_zero(a) {
            return self.number(&Rational::ONE);
        }
        self.intern(Op::Cos(a.node))
    }

    /// `atan2(y, x)`
    pub fn atan2(&mut self, y: Value, x: Value) -> Value {
        self.intern(Op::Atan2(y, x))
    }

    /// The sign of `a`, an odd function.
    pub fn sign(&mut self, a: Value) -> Value {
        let sign = match self.as_number(Value { negative: false, ..a }) {
            Some(r) if r.is_zero() => return a,
            Some(_) => self.number(&Rational::ONE),
            None => self.intern(Op::Sign(a.node)),
        };
        if a.negative { -sign } else { sign }
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

    /// What a symbol stands for in all formulas that are traced from now on, in place of the input.
    pub fn bind(&mut self, s: Symbol, v: Value) {
        self.traced.insert(s.into(), v);
    }

    /// The value of a formula, its parts shared with all that was traced before.
    pub fn trace(&mut self, e: Expr) -> Value {
        if let Some(&v) = self.traced.get(&e) {
            return v;
        }
        for part in Expr::postorder_of_new(&[e], |e| self.traced.contains_key(&e)) {
            let of = |x: &Expr| self.traced[x];
            let v = match part.node() {
                Node::Number(r) => self.number(&r),
                Node::Pi => self.intern(Op::Pi),
                Node::Symbol(s) => self.input(s),
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
                Node::Sign(a) => {
                    let a = of(&a);
                    self.sign(a)
                }
                Node::Sqrt(a) => {
                    let a = of(&a);
                    self.sqrt(a)
                }
                Node::Sin(a) => {
                    let a = of(&a);
                    self.sin(a)
                }
                Node::Cos(a) => {
                    let a = of(&a);
                    self.cos(a)
                }
                Node::Atan2(a, b) => {
                    let (a, b) = (of(&a), of(&b));
                    self.atan2(a, b)
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
                let operands: Vec<u32> = self.op(node).nodes().collect();
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
                pending.extend(self.op(node).nodes());
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
