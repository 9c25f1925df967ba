//! `[parameters]`: names, values, and what the rows use them for.

use super::fields::Reader;
use super::frames::FrameCells;
use super::{Declared, MAX_PARAMETERS, Quantity, Style};
use crate::description::Parameter;
use crate::description::cell::{is_reserved, name_of, variable_number};
use crate::description::rows::{Cell, Cells};
use denavit_symbolic::Symbol;
use rustc_hash::FxHashMap;
use toml::Spanned;
use toml::de::DeValue;

/// The names that stand as summands in angles and in lengths, and in what is said of masses and drives.
pub(super) struct Uses {
    angles: Vec<Symbol>,
    lengths: Vec<Symbol>,
    pub others: FxHashMap<Symbol, Quantity>,
}

impl Uses {
    /// What these cells use.
    pub fn of_cells(angles: &[Cell], lengths: &[Cell]) -> Self {
        let summands = |cells: &[Cell]| cells.iter().flat_map(Cell::summands).collect();
        Uses { angles: summands(angles), lengths: summands(lengths), others: FxHashMap::default() }
    }

    pub fn of(rows: &[Cells], frames: &[&FrameCells]) -> Self {
        let summands =
            |cells: &mut dyn Iterator<Item = &Cell>| cells.flat_map(Cell::summands).collect::<Vec<_>>();
        let by: Vec<_> = rows.iter().map(Cells::by_quantity).collect();
        Uses {
            angles: summands(&mut by.iter().flat_map(|b| b.0).chain(frames.iter().flat_map(|f| &f.angles))),
            lengths: summands(&mut by.iter().flat_map(|b| b.1).chain(frames.iter().flat_map(|f| &f.lengths))),
            others: FxHashMap::default(),
        }
    }
}

/// Why a name cannot be a parameter's, and what would help.
pub(in crate::description) fn name_fault(name: &str) -> Option<(String, String)> {
    if variable_number(name).is_some() {
        let message = format!("the parameter `{name}` is named like a joint variable");
        return Some((message, "q1, q2, … are the joint variables; choose another letter".into()));
    }
    if is_reserved(name) {
        let message =
            format!("the parameter `{name}` is named like a constant, a function, a unit or a sine");
        return Some((
            message,
            "C1 and S23 are cosines and sines of joint angles; choose another name".into(),
        ));
    }
    None
}

impl Reader<'_> {
    /// The names in the order of the file.
    pub fn parameter_names<'a>(&mut self, value: Option<&'a Spanned<DeValue<'a>>>) -> Vec<Declared<'a>> {
        let Some(table) = value.and_then(|v| self.table(v, "parameters")) else { return vec![] };
        if table.entries.len() > MAX_PARAMETERS {
            let message = format!("{} parameters; {MAX_PARAMETERS} are allowed", table.entries.len());
            self.out.error(table.span.clone(), message);
            return vec![];
        }
        let mut declared: Vec<Declared> = vec![];
        for ((key, span), (_, value)) in table.keys().zip(&table.entries) {
            let name = if key.len() <= 40 { name_of(key, false) } else { None };
            let Some(name) = name else {
                self.out.error(
                    span,
                    "a parameter's name is a letter followed by letters, digits and `_` (40 at most)",
                );
                continue;
            };
            if let Some((message, hint)) = name_fault(&name) {
                self.out.error(span, message).hint(hint);
            } else if declared.iter().any(|d| d.name == name) {
                self.out.error(span, format!("`{name}` is given twice"));
                continue;
            }
            declared.push(Declared { symbol: Symbol::new(&name), name, value });
        }
        declared
    }

    /// Their values.
    pub fn parameter_values(&mut self, declared: &[Declared], uses: &Uses) -> Vec<Parameter> {
        declared.iter().map(|p| self.parameter(p, uses)).collect()
    }

    fn parameter(&mut self, p: &Declared, uses: &Uses) -> Parameter {
        let none = Parameter { symbol: p.symbol, value: None };
        match p.value.get_ref() {
            DeValue::String(text) if text.trim().is_empty() => return none,
            DeValue::Table(table) if table.is_empty() => return none,
            _ => {}
        }
        let (angle, length) = (uses.angles.contains(&p.symbol), uses.lengths.contains(&p.symbol));
        let quantity = match (angle, length) {
            (true, false) => Quantity::Angle,
            (false, true) => Quantity::Length,
            (true, true) => {
                self.out.error(p.value.span(), format!("`{}` is used as an angle and as a length", p.name));
                return none;
            }
            (false, false) => uses.others.get(&p.symbol).copied().unwrap_or(Quantity::Open),
        };
        let Some(value) = self.value(p.value, &Style { nearly: angle, ..Style::plain(quantity) }) else {
            return none;
        };
        if let Some((name, span)) = value.symbols.first() {
            self.out
                .error(span.clone(), format!("`{name}` in the value of a parameter"))
                .hint("a value is a number; write sums of parameters in the cells");
            return none;
        }
        self.bare_numbers(&value, quantity);
        Parameter { symbol: p.symbol, value: Some(value.expr) }
    }
}
