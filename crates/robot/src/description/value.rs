//! Single values with units, as they stand on a command line or in a form.

use super::cell::{Place, Style, read_cell};
use super::diagnostic::{Diagnostic, Diagnostics};
use super::units::Quantity;
use super::{Description, JointKind};
use denavit_symbolic::{Expr, Symbol};
use std::fmt;

/// What a value measures.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Measure {
    /// Radians.
    Angle,
    /// Metres.
    Length,
}

impl From<JointKind> for Measure {
    fn from(kind: JointKind) -> Self {
        match kind {
            JointKind::Revolute => Measure::Angle,
            JointKind::Prismatic => Measure::Length,
        }
    }
}

/// Reads a constant with or without unit: `90 deg`, `-pi/2`, `20 mm`, `0.1`.
///
/// # Errors
/// If the text is no finite constant, or has a unit of something else.
pub fn read_value(text: &str, measure: Measure) -> Result<Expr, Vec<Diagnostic>> {
    let quantity = match measure {
        Measure::Angle => Quantity::Angle,
        Measure::Length => Quantity::Length,
    };
    let mut out = Diagnostics::default();
    let place = Place { span: 0..text.len(), start: Some(0) };
    let value = read_cell(text, &place, &Style::plain(quantity), &mut out);
    if let Some(value) = &value {
        for (name, span) in &value.symbols {
            out.error(span.clone(), format!("`{name}` is no number"));
        }
        let number = value.expr.eval(|_| None);
        if value.symbols.is_empty() && !number.is_ok_and(f64::is_finite) {
            out.error(place.span, "not a finite number");
        }
    }
    match value {
        Some(value) if !out.has_errors() => Ok(value.expr),
        _ => Err(out.list().to_vec()),
    }
}

/// Why a parameter has not been given a value.
#[derive(Clone, PartialEq, Debug)]
pub enum NotSet {
    /// There is no parameter of this name.
    Unknown {
        /// The name.
        name: String,
        /// Those that are there.
        known: Vec<String>,
    },
    /// The text is no value.
    Value(Vec<Diagnostic>),
}

impl fmt::Display for NotSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NotSet::Unknown { name, known } if known.is_empty() => {
                write!(f, "no parameter `{name}`; there are none")
            }
            NotSet::Unknown { name, known } => {
                write!(f, "no parameter `{name}`; they are {}", known.join(", "))
            }
            NotSet::Value(findings) => {
                let sentence = |d: &Diagnostic| match &d.hint {
                    Some(hint) => format!("{} ({hint})", d.message),
                    None => d.message.clone(),
                };
                write!(f, "{}", findings.iter().map(sentence).collect::<Vec<_>>().join("; "))
            }
        }
    }
}

impl std::error::Error for NotSet {}

impl Description {
    /// Gives a parameter a value: a constant with or without unit, as in a robot file.
    ///
    /// # Errors
    /// If there is no such parameter, or the text is no value.
    pub fn set(&mut self, name: &str, value: &str) -> Result<(), NotSet> {
        let symbol = Symbol::new(name.trim());
        let measure = self.measure(symbol);
        let known = || self.parameters.iter().map(|p| p.symbol.name().to_string()).collect();
        let Some(at) = self.parameters.iter().position(|p| p.symbol == symbol) else {
            return Err(NotSet::Unknown { name: name.trim().into(), known: known() });
        };
        self.parameters[at].value = Some(read_value(value.trim(), measure).map_err(NotSet::Value)?);
        Ok(())
    }

    /// What a parameter measures: an angle if some row turns by it, else a length.
    pub fn measure(&self, parameter: Symbol) -> Measure {
        let turns = self.rows.iter().flat_map(|r| [r.theta, r.alpha, r.gamma]);
        let mut symbols = turns.flat_map(Expr::symbols);
        if symbols.any(|s| s == parameter) { Measure::Angle } else { Measure::Length }
    }
}
