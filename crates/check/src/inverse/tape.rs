//! Formulas evaluated at many points: programs over doubles whose roots forgive rounding.

use denavit_program::{Domain, Graph, Program, Value};
use denavit_symbolic::{Expr, Rational, Symbol};
use rustc_hash::{FxHashMap, FxHashSet};

/// A list of formulas as one program.
pub struct Tape {
    program: Program,
    /// Where the program's inputs stand among those of a point.
    inputs: FxHashMap<Symbol, usize>,
}

/// A radicand this far below 0 is 0 but for rounding.
const ROUNDING: f64 = 1e-9;

/// A double; the root of one that is negative by rounding alone is 0.
#[derive(Clone, Copy)]
struct Rounded(f64);

impl Domain for Rounded {
    fn rational(r: &Rational) -> Self {
        Rounded(r.to_f64())
    }
    fn pi() -> Self {
        Rounded(std::f64::consts::PI)
    }
    fn neg(&self) -> Self {
        Rounded(-self.0)
    }
    fn add(&self, b: &Self) -> Self {
        Rounded(self.0 + b.0)
    }
    fn sub(&self, b: &Self) -> Self {
        Rounded(self.0 - b.0)
    }
    fn mul(&self, b: &Self) -> Self {
        Rounded(self.0 * b.0)
    }
    fn div(&self, b: &Self) -> Self {
        Rounded(self.0 / b.0)
    }
    fn sqrt(&self) -> Self {
        Rounded(if (-ROUNDING..0.0).contains(&self.0) { 0.0 } else { self.0.sqrt() })
    }
    fn sin_cos(&self) -> (Self, Self) {
        let (s, c) = self.0.sin_cos();
        (Rounded(s), Rounded(c))
    }
    fn atan2(&self, x: &Self) -> Self {
        Rounded(self.0.atan2(x.0))
    }
    fn sign(&self) -> Self {
        Rounded(self.0.sign())
    }
}

impl Tape {
    /// The formulas over the inputs.
    ///
    /// # Errors
    /// A symbol that is no input.
    pub fn new(formulas: &[Expr], inputs: &FxHashMap<Symbol, usize>) -> Result<Self, Symbol> {
        let symbols = || formulas.iter().flat_map(|e| e.symbols());
        if let Some(unknown) = symbols().find(|s| !inputs.contains_key(s)) {
            return Err(unknown);
        }
        let mut graph = Graph::new(&[], &[]);
        let outputs: Vec<(String, Value)> =
            formulas.iter().enumerate().map(|(k, &e)| (format!("x{k}"), graph.trace(e))).collect();
        let program = Program::new(&graph, &outputs, |_| None, &FxHashSet::default());
        let inputs = symbols().filter_map(|s| Some((s, *inputs.get(&s)?))).collect();
        Ok(Tape { program, inputs })
    }

    /// The values at a point: one number an input.
    pub fn values(&self, point: &[f64]) -> Vec<f64> {
        let input = |s: Symbol| Some(Rounded(point[*self.inputs.get(&s)?]));
        // Every symbol is an input, so that none is without a value.
        let found = self.program.eval(input).unwrap_or_default();
        found.into_iter().map(|x| x.0).collect()
    }
}
