//! Formulas evaluated at many points.

use denavit_symbolic::{Expr, Node, Symbol};
use rustc_hash::FxHashMap;

/// A list of formulas as one sequence of operations over earlier results.
pub struct Tape {
    steps: Vec<Step>,
    roots: Vec<usize>,
}

enum Step {
    Constant(f64),
    Input(usize),
    Neg(usize),
    Add(usize, usize),
    Sub(usize, usize),
    Mul(usize, usize),
    Div(usize, usize),
    Pow(usize, i32),
    Sqrt(usize),
    Sin(usize),
    Cos(usize),
    Atan2(usize, usize),
}

/// A radicand this far below 0 is 0 but for rounding.
const ROUNDING: f64 = 1e-9;

impl Tape {
    /// The formulas over the inputs.
    ///
    /// # Errors
    /// A symbol that is no input.
    pub fn new(formulas: &[Expr], inputs: &FxHashMap<Symbol, usize>) -> Result<Self, Symbol> {
        let mut place: FxHashMap<Expr, usize> = FxHashMap::default();
        let mut steps = vec![];
        for e in Expr::postorder(formulas) {
            let at = |x: Expr| place[&x];
            steps.push(match e.node() {
                Node::Number(r) => Step::Constant(r.to_f64()),
                Node::Pi => Step::Constant(std::f64::consts::PI),
                Node::Symbol(s) => Step::Input(*inputs.get(&s).ok_or(s)?),
                Node::Neg(a) => Step::Neg(at(a)),
                Node::Add(a, b) => Step::Add(at(a), at(b)),
                Node::Sub(a, b) => Step::Sub(at(a), at(b)),
                Node::Mul(a, b) => Step::Mul(at(a), at(b)),
                Node::Div(a, b) => Step::Div(at(a), at(b)),
                Node::Pow(a, n) => Step::Pow(at(a), n),
                Node::Sqrt(a) => Step::Sqrt(at(a)),
                Node::Sin(a) => Step::Sin(at(a)),
                Node::Cos(a) => Step::Cos(at(a)),
                Node::Atan2(a, b) => Step::Atan2(at(a), at(b)),
            });
            place.insert(e, steps.len() - 1);
        }
        Ok(Tape { roots: formulas.iter().map(|e| place[e]).collect(), steps })
    }

    /// The values at a point: one number an input.
    pub fn values(&self, inputs: &[f64]) -> Vec<f64> {
        let mut x: Vec<f64> = Vec::with_capacity(self.steps.len());
        for step in &self.steps {
            let value = match *step {
                Step::Constant(c) => c,
                Step::Input(k) => inputs[k],
                Step::Neg(a) => -x[a],
                Step::Add(a, b) => x[a] + x[b],
                Step::Sub(a, b) => x[a] - x[b],
                Step::Mul(a, b) => x[a] * x[b],
                Step::Div(a, b) => x[a] / x[b],
                Step::Pow(a, n) => x[a].powi(n),
                Step::Sqrt(a) if (-ROUNDING..0.0).contains(&x[a]) => 0.0,
                Step::Sqrt(a) => x[a].sqrt(),
                Step::Sin(a) => x[a].sin(),
                Step::Cos(a) => x[a].cos(),
                Step::Atan2(a, b) => x[a].atan2(x[b]),
            };
            x.push(value);
        }
        self.roots.iter().map(|&k| x[k]).collect()
    }
}
