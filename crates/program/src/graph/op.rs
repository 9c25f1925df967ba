//! The operations: what each reads, computes and costs, and how it varies with its operands.

use super::Graph;
use crate::domain::Domain;
use denavit_symbolic::{Rational, Symbol};

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
    /// The sign of `a`: 1, −1, or `a` itself where it is 0 or no number
    Sign(u32),
}

impl Op {
    /// The values that the operation reads.
    pub fn operands(&self) -> impl Iterator<Item = Value> + use<> {
        let plain = |node| Some(Value { node, negative: false });
        let (a, b) = match *self {
            Op::Number(_) | Op::Pi | Op::Input(_) => (None, None),
            Op::Sqrt(a) => (Some(a), None),
            Op::Sin(a) | Op::Cos(a) | Op::Sign(a) => (plain(a), None),
            Op::Add(a, b) | Op::Sub(a, b) | Op::Mul(a, b) | Op::Div(a, b) => (plain(a), plain(b)),
            Op::Atan2(a, b) => (Some(a), Some(b)),
        };
        a.into_iter().chain(b)
    }

    /// The nodes that the operation reads.
    pub fn nodes(&self) -> impl Iterator<Item = u32> + use<> {
        self.operands().map(|v| v.node)
    }

    /// The same operation on nodes that are numbered otherwise.
    #[must_use]
    pub(crate) fn renumbered(&self, at: impl Fn(u32) -> u32) -> Op {
        let moved = |v: Value| Value { node: at(v.node), ..v };
        match self.clone() {
            op @ (Op::Number(_) | Op::Pi | Op::Input(_)) => op,
            Op::Add(a, b) => Op::Add(at(a), at(b)),
            Op::Sub(a, b) => Op::Sub(at(a), at(b)),
            Op::Mul(a, b) => Op::Mul(at(a), at(b)),
            Op::Div(a, b) => Op::Div(at(a), at(b)),
            Op::Sqrt(a) => Op::Sqrt(moved(a)),
            Op::Sin(a) => Op::Sin(at(a)),
            Op::Cos(a) => Op::Cos(at(a)),
            Op::Atan2(a, b) => Op::Atan2(moved(a), moved(b)),
            Op::Sign(a) => Op::Sign(at(a)),
        }
    }

    /// The value, the definition that every evaluator follows; `at` gives the operands, `input` the inputs.
    pub fn value<D: Domain>(&self, input: impl FnOnce(Symbol) -> D, at: impl Fn(u32) -> D) -> D {
        let signed = |v: Value| if v.negative { at(v.node).neg() } else { at(v.node) };
        match self {
            Op::Number(r) => D::rational(r),
            Op::Pi => D::pi(),
            Op::Input(s) => input(*s),
            Op::Add(a, b) => at(*a).add(&at(*b)),
            Op::Sub(a, b) => at(*a).sub(&at(*b)),
            Op::Mul(a, b) => at(*a).mul(&at(*b)),
            Op::Div(a, b) => at(*a).div(&at(*b)),
            Op::Sqrt(a) => signed(*a).sqrt(),
            Op::Sin(a) => at(*a).sin_cos().0,
            Op::Cos(a) => at(*a).sin_cos().1,
            Op::Atan2(a, b) => signed(*a).atan2(&signed(*b)),
            Op::Sign(a) => at(*a).sign(),
        }
    }

    /// How the result of this operation, which is `own`, varies with each operand as it is read (with its sign).
    pub(crate) fn partials(&self, own: Value, graph: &mut Graph) -> Vec<Value> {
        let one = graph.number(&Rational::ONE);
        let plain = |node: u32| Value { node, negative: false };
        match *self {
            Op::Number(_) | Op::Pi | Op::Input(_) => vec![],
            Op::Add(..) => vec![one, one],
            Op::Sub(..) => vec![one, -one],
            Op::Mul(a, b) => vec![plain(b), plain(a)],
            // ∂(a/b)/∂a = 1/b,   ∂(a/b)/∂b = −(a/b)/b
            Op::Div(_, b) => {
                let (first, second) = (graph.div(one, plain(b)), graph.div(own, plain(b)));
                vec![first, -second]
            }
            // ∂√a/∂a = 1/(2√a)
            Op::Sqrt(_) => {
                let twice = graph.add(own, own);
                vec![graph.div(one, twice)]
            }
            // 0 on either side; at 0, where it jumps, there is no derivative, and 0 stands for it.
            Op::Sign(_) => vec![graph.number(&Rational::ZERO)],
            Op::Sin(a) => vec![graph.cos(plain(a))],
            Op::Cos(a) => vec![-graph.sin(plain(a))],
            // ∂atan2(y, x)/∂y = x/(x² + y²),   ∂/∂x = −y/(x² + y²)
            Op::Atan2(y, x) => {
                let (yy, xx) = (graph.mul(y, y), graph.mul(x, x));
                let square = graph.add(xx, yy);
                let (by_y, by_x) = (graph.div(x, square), graph.div(y, square));
                vec![by_y, -by_x]
            }
        }
    }

    /// Cycles that one value takes in a block on four double lanes, by estimate; a sine and cosine of one angle are
    /// computed together, so that each counts half of the pair.
    pub fn cycles(&self) -> f64 {
        match self {
            Op::Number(_) | Op::Pi | Op::Input(_) => 0.0,
            Op::Add(..) | Op::Sub(..) | Op::Mul(..) => 0.25,
            Op::Sign(_) => 0.5,
            Op::Div(..) => 2.0,
            Op::Sqrt(_) => 3.0,
            Op::Sin(_) | Op::Cos(_) => 3.0,
            Op::Atan2(..) => 9.0,
        }
    }

    /// Its name in the text form of programs.
    pub fn mnemonic(&self) -> &'static str {
        match self {
            Op::Number(_) => "number",
            Op::Pi => "pi",
            Op::Input(_) => "input",
            Op::Add(..) => "add",
            Op::Sub(..) => "sub",
            Op::Mul(..) => "mul",
            Op::Div(..) => "div",
            Op::Sqrt(_) => "sqrt",
            Op::Sin(_) => "sin",
            Op::Cos(_) => "cos",
            Op::Atan2(..) => "atan2",
            Op::Sign(_) => "sign",
        }
    }
}
