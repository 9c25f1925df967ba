//! The values of a description's parameters.

use super::{Description, Parameter};
pub use denavit_program::MissingValue;
use denavit_symbolic::{Expr, Symbol};

impl Parameter {
    /// Its value as a number (metres or radians), if one is known.
    pub fn number(&self) -> Option<f64> {
        self.value?.eval(|_| None).ok()
    }
}

impl Description {
    /// The robot with the values of its parameters in their place; those without value stay.
    #[must_use]
    pub fn in_numbers(&self) -> Description {
        let all: Vec<Symbol> = self.parameters.iter().map(|p| p.symbol).collect();
        self.with_numbers_for(&all)
    }

    /// The robot with the values of these parameters in their place; those without value stay.
    #[must_use]
    pub fn with_numbers_for(&self, these: &[Symbol]) -> Description {
        let value = |e: Expr| e.substitute(|s| self.exact_value(s).filter(|_| these.contains(&s)));
        let mut numbers = self.clone();
        numbers.parameters.retain(|p| p.value.is_none() || !these.contains(&p.symbol));
        for row in &mut numbers.rows {
            for cell in [&mut row.theta, &mut row.d, &mut row.a, &mut row.alpha, &mut row.gamma, &mut row.b] {
                *cell = value(*cell);
            }
        }
        numbers.substitute_masses(value);
        (numbers.base, numbers.tool) = (self.base.map(value), self.tool.map(value));
        numbers
    }

    /// The parameter with this symbol.
    pub fn parameter(&self, symbol: Symbol) -> Option<&Parameter> {
        self.parameters.iter().find(|p| p.symbol == symbol)
    }

    /// The exact value of a parameter; nothing for one without value and for other symbols.
    pub fn exact_value(&self, symbol: Symbol) -> Option<Expr> {
        self.parameter(symbol)?.value
    }

    /// The value of a parameter as a number (metres or radians); nothing for one without value and for other symbols.
    pub fn value(&self, symbol: Symbol) -> Option<f64> {
        self.parameter(symbol)?.number()
    }

    /// The parameters that have values, with these.
    pub fn known_values(&self) -> Vec<(Symbol, f64)> {
        self.parameters.iter().filter_map(|p| Some((p.symbol, p.number()?))).collect()
    }

    /// The values of these parameters: what a program is compiled for.
    ///
    /// # Errors
    /// If one has no value.
    pub fn values(&self, symbols: &[Symbol]) -> Result<Vec<f64>, MissingValue> {
        denavit_program::values(symbols, |s| self.value(s))
    }
}
