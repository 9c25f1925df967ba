//! The symbols of a table that are no variables, and the values that lines of the text give them.

use super::lines::Lines;
use super::read::BareUnits;
use crate::description::Parameter;
use crate::description::cell::{Place, Style, read_cell, variable_number};
use crate::description::diagnostic::Diagnostics;
use crate::description::robot_file::name_fault;
use crate::description::rows::{Cell, Cells};
use crate::description::units::Quantity;
use denavit_symbolic::{Expr, Symbol};
use std::ops::Range;

/// The parameters in the order in which they first occur.
pub(super) fn parameters(
    text: &str,
    rows: &[Cells],
    lines: &Lines,
    units: &BareUnits,
    out: &mut Diagnostics,
) -> Vec<Parameter> {
    let mut names: Vec<(&str, Range<usize>)> = vec![];
    let mut symbols: Vec<_> = rows.iter().flat_map(Cells::all).flat_map(|c| &c.symbols).collect();
    symbols.sort_by_key(|s| s.1.start);
    for (name, span) in symbols {
        if variable_number(name).is_none() && !names.iter().any(|n| n.0 == name) {
            names.push((name, span.clone()));
        }
    }
    if names.len() > 1000 {
        out.error(0..0, "more than 1000 parameters");
        return vec![];
    }
    let uses = |pick: fn(&Cells) -> [&Cell; 3]| -> Vec<Symbol> {
        rows.iter().flat_map(pick).flat_map(Cell::summands).collect()
    };
    let (angles, lengths) = (uses(|c| c.by_quantity().0), uses(|c| c.by_quantity().1));
    let mut parameters = vec![];
    for (name, span) in names {
        if let Some((message, hint)) = name_fault(name) {
            out.error(span.clone(), message).hint(hint);
        }
        let symbol = Symbol::new(name);
        let (angle, length) = (angles.contains(&symbol), lengths.contains(&symbol));
        if angle && length {
            out.error(span, format!("`{name}` is used as an angle and as a length"));
            continue;
        }
        let style = match (angle, length) {
            (true, _) => units.style(Quantity::Angle, None),
            (_, true) => units.style(Quantity::Length, None),
            _ => units.style(Quantity::Open, None),
        };
        parameters.push(Parameter { symbol, value: value(text, name, lines, &style, out) });
    }
    parameters
}

/// The value of a name: the first line that gives one.
fn value(text: &str, name: &str, lines: &Lines, style: &Style, out: &mut Diagnostics) -> Option<Expr> {
    let mut found: Option<Expr> = None;
    for (_, cell) in lines.values.iter().filter(|v| v.0 == name) {
        let trimmed = cell.text.trim_matches(['"', '\'', '$', ' ']);
        let start = cell.span.start + cell.text.find(trimmed).unwrap_or(0);
        let place = Place { span: cell.span.clone(), start: Some(start) };
        let mut findings = Diagnostics::default();
        let read = read_cell(trimmed, &place, style, &mut findings).filter(|v| v.symbols.is_empty());
        let Some(read) = read else {
            let shown: String = text[cell.span.clone()].chars().take(40).collect();
            out.note(cell.span.clone(), format!("`{name} = {shown}` is not taken for the value of `{name}`"))
                .hint(
                    findings
                        .list()
                        .first()
                        .map_or("a value is a number with a unit".into(), |f| f.message.clone()),
                );
            continue;
        };
        match found {
            Some(before) if before != read.expr => {
                out.warning(cell.span.clone(), format!("a second value for `{name}`; the first is taken"));
            }
            _ => found = Some(read.expr),
        }
    }
    found
}
