//! A table cell, read exactly: numbers with units, parameters, joint variables, and formulas of them.
//!
//! The grammar is that of formulas (`denavit_symbolic::parse`), with units behind numbers. A name is a whole word
//! (`RL4`, `a1`): a cell of a table never runs names together. A cell has at most [`MAX_LENGTH`] bytes, which bounds
//! every recursion over what is read.

mod measure;
mod special;
mod write;

pub(super) use measure::greek;
pub(super) use special::name as multiple_name;
pub(super) use write::{decimal, write_cell};

use super::diagnostic::{Diagnostics, Severity};
use super::units::{Quantity, Unit};
use denavit_symbolic::{Expr, parse::whole_word};
use std::ops::Range;

/// The longest cell, in bytes.
pub const MAX_LENGTH: usize = 1000;

/// How a cell is to be read.
#[derive(Clone, Debug)]
pub(super) struct Style {
    /// What it measures.
    pub quantity: Quantity,
    /// The unit of a number without one; `None`: SI.
    pub bare: Option<Unit>,
    /// As it stands in a document: `$\theta_1$` is `theta1`, LaTeX commands are known.
    pub document: bool,
    /// `0,5` is a half.
    pub decimal_comma: bool,
    /// Whether an angle that is nearly a multiple of π/12 is worth a warning.
    pub nearly: bool,
}

impl Style {
    /// A cell of a robot file.
    pub fn of(quantity: Quantity) -> Self {
        Style {
            quantity,
            bare: None,
            document: false,
            decimal_comma: false,
            nearly: quantity == Quantity::Angle,
        }
    }

    /// A value that is no geometry, such as a limit.
    pub fn plain(quantity: Quantity) -> Self {
        Style { nearly: false, ..Style::of(quantity) }
    }
}

/// What a cell says.
#[derive(Clone, Debug)]
pub(super) struct Value {
    /// The formula.
    pub expr: Expr,
    /// The names in it and their places.
    pub symbols: Vec<(String, Range<usize>)>,
    /// Numbers other than 0 that stand without a unit, as written, and their places.
    pub bare: Vec<(f64, Range<usize>)>,
}

/// Where the text of a cell stands in the whole text.
#[derive(Clone, Debug)]
pub(super) struct Place {
    /// All of the cell.
    pub span: Range<usize>,
    /// Where byte 0 of the cell's text stands, unless escapes shift the bytes behind it.
    pub start: Option<usize>,
}

impl Place {
    /// A part of the cell, in the whole text.
    pub fn part(&self, part: Range<usize>) -> Range<usize> {
        match self.start {
            Some(start) => start + part.start..start + part.end,
            None => self.span.clone(),
        }
    }
}

/// Reads a cell; reports what is wrong with it (one error a cell) and what is worth saying.
pub(super) fn read_cell(text: &str, place: &Place, style: &Style, out: &mut Diagnostics) -> Option<Value> {
    if text.len() > MAX_LENGTH {
        out.error(place.span.clone(), format!("a cell of {} bytes; {MAX_LENGTH} are allowed", text.len()));
        return None;
    }
    match measure::read(text, style) {
        Ok((mut value, findings)) => {
            for (severity, span, message) in findings {
                let span = place.part(span);
                match severity {
                    Severity::Note => out.note(span, message),
                    _ => out.warning(span, message),
                };
            }
            value.symbols.iter_mut().for_each(|s| s.1 = place.part(s.1.clone()));
            value.bare.iter_mut().for_each(|b| b.1 = place.part(b.1.clone()));
            Some(value)
        }
        Err(fault) => {
            let span = if fault.span.is_empty() { place.span.clone() } else { place.part(fault.span) };
            let finding = out.error(span, fault.message);
            finding.hint = fault.hint;
            None
        }
    }
}

/// The plain form of a name as it stands in a document (`$a_1$` is `a1`), if the text is one name and nothing else.
pub(super) fn name_of(text: &str, document: bool) -> Option<String> {
    if text.len() > MAX_LENGTH {
        return None;
    }
    let word = if document { whole_word(&measure::mended(text, false)) } else { whole_word(text) };
    Some(measure::plain(&word?, document))
}

/// True for names that stand for something else already: π, functions, units, `C1`, `S23`.
pub(super) fn is_reserved(name: &str) -> bool {
    let index = name.strip_prefix(['C', 'S', 'c', 's']).unwrap_or("");
    // Joints are counted from 1: `s0` is a length as good as any.
    let digits = !index.is_empty() && index.bytes().all(|b| b.is_ascii_digit());
    let trigonometric = digits && !index.starts_with('0');
    let word = ["sin", "cos", "tan", "sqrt", "atan2", "pi", "inf", "nan", "NaN", "infinity"].contains(&name);
    let unit = super::units::unit_named(name)
        .is_some_and(|u| matches!(u.quantity, Quantity::Angle | Quantity::Length) && name != "m");
    trigonometric || word || unit
}

/// The number of the joint variable that a name is: `q12` is 12.
pub(super) fn variable_number(name: &str) -> Option<usize> {
    let index = name.strip_prefix('q')?;
    let plain = index.len() <= 4 && !index.starts_with('0') && index.bytes().all(|b| b.is_ascii_digit());
    if plain { index.parse().ok() } else { None }
}
