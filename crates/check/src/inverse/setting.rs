//! What the symbols of a formula stand for: joint variables, parameters, entries of a pose; and the points at which
//! formulas are compared.

use super::tape::Tape;
use denavit_symbolic::{Angle, Expr, Symbol, readable};
use rustc_hash::FxHashMap;
use std::f64::consts::TAU;

/// Values this near are the same: radians, and lengths by the size of the robot.
const SAME: f64 = 1e-6;

/// The symbols, with the forward model.
pub struct Setting {
    /// The joint variables, or the angles of an orientation.
    pub variables: Vec<Symbol>,
    pub is_angle: Vec<bool>,
    /// The entries of the pose, and each in the variables.
    pub entries: Vec<(Symbol, Expr)>,
    pub parameters: Vec<(Symbol, f64)>,
    /// A length to compare lengths with, metres.
    pub size: f64,
    /// True if samples hold all solutions.
    pub is_enumerated: bool,
    /// Variables whose values go with each pose.
    pub given: Vec<usize>,
    inputs: FxHashMap<Symbol, usize>,
}

/// A configuration, its pose, and all others with the same pose.
#[derive(Clone, Debug)]
pub struct Sample {
    pub q: Vec<f64>,
    /// The pose, in the order of [`Setting::entries`].
    pub entries: Vec<f64>,
    /// All solutions, that configuration among them.
    pub solutions: Vec<Vec<f64>>,
    /// How the joints move where the hand stays still.
    pub motions: Vec<Vec<f64>>,
}

/// What is compared: a formula in the variables.
#[derive(Clone, Copy, Debug)]
pub struct Unknown {
    pub formula: Expr,
    /// Whether whole turns do not count.
    pub is_angle: bool,
}

impl Setting {
    pub fn new(
        variables: Vec<Symbol>,
        is_angle: Vec<bool>,
        entries: Vec<(Symbol, Expr)>,
        parameters: Vec<(Symbol, f64)>,
        size: f64,
    ) -> Self {
        let symbols =
            variables.iter().chain(entries.iter().map(|e| &e.0)).chain(parameters.iter().map(|p| &p.0));
        let mut inputs = FxHashMap::default();
        for (k, &s) in symbols.enumerate() {
            inputs.entry(s).or_insert(k);
        }
        let entries = entries.into_iter().map(|(s, e)| (s, readable::settled(e))).collect();
        Setting {
            variables,
            is_angle,
            entries,
            parameters,
            // An arm of slides alone has no length of its own.
            size: if size == 0.0 { 1.0 } else { size.max(1e-3) },
            is_enumerated: true,
            given: vec![],
            inputs,
        }
    }

    /// The formulas over the inputs of [`point`](Self::point).
    pub fn tape(&self, formulas: &[Expr]) -> Result<Tape, Symbol> {
        Tape::new(formulas, &self.inputs)
    }

    /// A configuration and a pose as inputs.
    pub fn point(&self, q: &[f64], entries: &[f64]) -> Vec<f64> {
        q.iter().chain(entries).copied().chain(self.parameters.iter().map(|p| p.1)).collect()
    }

    /// A formula with the forward model in place of the pose.
    pub fn by_table(&self, e: Expr) -> Expr {
        e.substitute(|s| self.entries.iter().find(|x| x.0 == s && !self.variables.contains(&s)).map(|x| x.1))
    }

    pub fn unknown(&self, formula: Expr) -> Unknown {
        let turns = |s: Symbol| self.variables.iter().position(|&v| v == s).is_some_and(|j| self.is_angle[j]);
        let form = Angle::of(formula);
        let is_angle = !form.terms.is_empty()
            && form.terms.iter().all(|(x, k)| k.is_integer() && x.as_symbol().is_some_and(turns));
        Unknown { formula, is_angle }
    }

    /// The factors of the variables in a linear form; nothing if it is none.
    pub fn row(&self, formula: Expr) -> Option<Vec<f64>> {
        let mut row = vec![0.0; self.variables.len()];
        for (x, k) in Angle::of(formula).terms {
            match x.as_symbol().and_then(|s| self.variables.iter().position(|&v| v == s)) {
                Some(j) => row[j] += k.to_f64(),
                None if x.symbols().iter().any(|s| self.variables.contains(s)) => return None,
                None => {}
            }
        }
        Some(row)
    }

    /// Equal but for whole turns and rounding.
    pub fn near(&self, of: &[Unknown], a: &[f64], b: &[f64]) -> bool {
        self.apart(of, a, b) <= SAME
    }

    /// How far values are from each other but for whole turns: the worst, radians and lengths by the arm's size.
    pub fn apart(&self, of: &[Unknown], a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).zip(of).fold(0.0, |most, ((x, y), u)| {
            let d = x - y;
            let own = match u.is_angle {
                true => (d - TAU * (d / TAU).round()).abs(),
                false => d.abs() / self.size.max(y.abs()).max(1.0),
            };
            if own >= most || own.is_nan() { own } else { most }
        })
    }

    /// Two configurations are one.
    pub fn is_same(&self, a: &[f64], b: &[f64]) -> bool {
        a.iter().zip(b).zip(&self.is_angle).all(|((x, y), &is_angle)| {
            let d = x - y;
            (if is_angle { d - TAU * (d / TAU).round() } else { d / self.size }).abs() <= SAME
        })
    }
}

/// True if `row` is a combination of `rows`.
pub fn spans(rows: &[Vec<f64>], row: &[f64]) -> bool {
    let mut basis: Vec<Vec<f64>> = vec![];
    let reduced = |basis: &[Vec<f64>], row: &[f64]| {
        let mut rest = row.to_vec();
        for b in basis {
            if let Some(k) = b.iter().position(|x| x.abs() > 1e-9) {
                let factor = rest[k] / b[k];
                rest.iter_mut().zip(b).for_each(|(x, y)| *x -= factor * y);
            }
        }
        rest
    };
    let is_zero = |row: &[f64]| row.iter().all(|x| x.abs() < 1e-9);
    for r in rows {
        let mut rest = reduced(&basis, r);
        if !is_zero(&rest) {
            // The first entry leads; what rounding leaves before it would lead instead.
            rest.iter_mut().filter(|x| x.abs() < 1e-9).for_each(|x| *x = 0.0);
            basis.push(rest);
        }
    }
    is_zero(&reduced(&basis, row))
}
