//! The symbols of a table that are no variables, and the values that lines of the text give them.

use super::find::GridCell;
use super::lines::{Around, Lines};
use super::read::BareUnits;
use crate::description::Parameter;
use crate::description::cell::{Place, Style, is_reserved, read_cell, variable_number};
use crate::description::diagnostic::{Diagnostics, line_column, nearest};
use crate::description::robot_file::name_fault;
use crate::description::rows::{Cell, Cells};
use crate::description::units::Quantity;
use denavit_symbolic::{Expr, Symbol};
use std::ops::Range;

/// The parameters in the order in which they first occur. Lines near the table win over those that belong to other
/// tables; `variables` are the names of the joint variables in the table.
pub(super) fn parameters(
    text: &str,
    rows: &[Cells],
    variables: &[&str],
    (lines, around): (&Lines, &Around),
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
        parameters.push(Parameter { symbol, value: value(text, name, lines, around, &style, out) });
    }
    unused(text, &parameters, variables, lines, around, out);
    parameters
}

/// So many lines that give a name a value are looked at.
const MAX_GIVEN: usize = 1_000;

/// True for a name to which lines give a constant, always the same one: other values are those of configurations.
pub(super) fn is_constant(name: &str, lines: &Lines, units: &BareUnits) -> bool {
    let style = units.style(Quantity::Open, None);
    let given = lines.values.iter().filter(|v| v.0 == name).take(MAX_GIVEN);
    let mut values = given.filter_map(|v| read_line(&v.1, &style, &mut Diagnostics::default()));
    values.next().is_some_and(|first| values.all(|v| v == first))
}

/// What a line gives a name, if that is a constant.
fn read_line(cell: &GridCell, style: &Style, out: &mut Diagnostics) -> Option<Expr> {
    let trimmed = cell.text.trim_matches(['"', '\'', '$', ' ']);
    let start = cell.span.start + cell.text.find(trimmed).unwrap_or(0);
    let place = Place { span: cell.span.clone(), start: Some(start) };
    Some(read_cell(trimmed, &place, style, out).filter(|v| v.symbols.is_empty())?.expr)
}

/// The value of a name: all lines that give one agree.
fn value(
    text: &str,
    name: &str,
    lines: &Lines,
    around: &Around,
    style: &Style,
    out: &mut Diagnostics,
) -> Option<Expr> {
    let all = || lines.values.iter().filter(|v| v.0 == name).map(|v| &v.1);
    let everywhere = 0..text.len() + 1;
    let holds = |r: &Range<usize>| all().any(|c| r.contains(&c.span.start));
    let near = [&around.own, &around.neighbours].into_iter().find(|r| holds(r)).unwrap_or(&everywhere);
    let mut found: Option<(Expr, usize)> = None;
    for cell in all().filter(|c| near.contains(&c.span.start)) {
        let mut findings = Diagnostics::default();
        let Some(read) = read_line(cell, style, &mut findings) else {
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
            Some((before, at)) if before != read => {
                let line = line_column(text, at).0;
                out.error(
                    cell.span.clone(),
                    format!("a second value for `{name}`; line {line} gives another"),
                )
                .hint("leave one of the two");
            }
            Some(_) => {}
            None => found = Some((read, cell.span.start)),
        }
    }
    Some(found?.0)
}

/// Values for names that the table does not hold.
fn unused(
    text: &str,
    parameters: &[Parameter],
    variables: &[&str],
    lines: &Lines,
    around: &Around,
    out: &mut Diagnostics,
) {
    let mut seen: Vec<&str> = vec![];
    let is_row = |at: usize| around.tables.iter().any(|t| t.contains(&at));
    let own = |at: usize| around.own.contains(&at) && !is_row(at);
    for (name, cell) in lines.values.iter().filter(|v| own(v.1.span.start)) {
        let known = parameters.iter().any(|p| *p.symbol.name() == **name) || is_reserved(name);
        if known || seen.contains(&name.as_str()) || out.is_full() {
            continue;
        }
        let style = Style { document: true, ..Style::of(Quantity::Open) };
        if read_line(cell, &style, &mut Diagnostics::default()).is_none() {
            continue; // an equation of the text
        }
        seen.push(name);
        let shown: String = text[cell.span.clone()].chars().take(40).collect();
        if variables.contains(&name.as_str()) {
            let message = format!("`{name}` is a joint variable: `{name} = {shown}` is not read");
            out.note(cell.span.clone(), message);
        } else {
            let near = nearest(
                name,
                parameters.iter().map(|p| p.symbol.name()).collect::<Vec<_>>().iter().map(|n| &**n),
            )
            .map(|n| format!("did you mean `{n}`?"));
            let message = format!("the table has no symbol `{name}`: `{name} = {shown}` is not read");
            out.warning(cell.span.clone(), message).hint = near;
        }
    }
}
