//! Limits of a joint in a table: columns min and max, or one with both.

use super::columns::Role;
use super::find::GridCell;
use super::read::{BareUnits, ReadRow};
use crate::description::JointKind;
use crate::description::cell::{Place, read_cell};
use crate::description::diagnostic::Diagnostics;
use crate::description::units::Quantity;
use denavit_symbolic::Expr;

/// The limits that a row gives its variable.
pub(super) fn limits(
    row: &ReadRow,
    kind: JointKind,
    units: &BareUnits,
    out: &mut Diagnostics,
) -> Option<[Expr; 2]> {
    let quantity = if kind == JointKind::Revolute { Quantity::Angle } else { Quantity::Length };
    let filled =
        |role| row.source(role).filter(|c| !matches!(c.text.trim_matches(['$', ' ']), "" | "-" | "–" | "—"));
    let (lower, upper, place, role) = if let Some(both) = filled(Role::Limits) {
        let Some((lower, upper)) = split(both) else {
            out.error(both.span.clone(), "limits are two values").hint("write them as -160 … 160 or ±160");
            return None;
        };
        (lower, upper, both.span.clone(), Role::Limits)
    } else {
        let (lower, upper) = (filled(Role::Lower)?, filled(Role::Upper)?);
        (lower.clone(), upper.clone(), upper.span.clone(), Role::Upper)
    };
    let mut value = |cell: &GridCell| {
        let place = Place { span: cell.span.clone(), start: Some(cell.span.start) };
        let mut style = units.style(quantity, row.unit(role, quantity));
        style.nearly = false;
        let value = read_cell(&cell.text, &place, &style, out)?;
        if let Some((name, span)) = value.symbols.first() {
            out.error(span.clone(), format!("`{name}` stands where a number is needed"));
            return None;
        }
        Some(value.expr)
    };
    let (mut low, high) = (value(&lower)?, value(&upper)?);
    if lower.text == upper.text {
        low = -high; // ±160
    }
    let number = |e: Expr| e.eval(|_| None).unwrap_or(0.0);
    if number(low) > number(high) {
        out.error(place, "the lower limit is above the upper one");
        return None;
    }
    Some([low, high])
}

/// `-160 … 160`, `[-160, 160]`, `-160 to 160 deg`, `±160` (twice the same text).
fn split(cell: &GridCell) -> Option<(GridCell, GridCell)> {
    let text = &cell.text;
    let inner = text.trim_matches(['[', ']', '(', ')', '$', ' ']);
    let start = cell.span.start + text.find(inner)?;
    let part = |from: usize, to: usize| {
        let piece = &inner[from..to];
        let at = start + from + (piece.len() - piece.trim_start().len());
        GridCell { text: piece.trim().to_string(), span: at..at + piece.trim().len() }
    };
    for sign in ["±", "+/-", "\\pm"] {
        if inner.starts_with(sign) {
            let value = part(sign.len(), inner.len());
            return Some((value.clone(), value));
        }
    }
    for between in ["...", "…", "..", " to ", ",", ";", "/", "~"] {
        if let Some(at) = inner.find(between) {
            let (mut lower, upper) = (part(0, at), part(at + between.len(), inner.len()));
            let numeric = |c: char| c.is_ascii_digit() || matches!(c, '.' | '+' | '-' | '−' | ' ');
            if lower.text.chars().all(numeric) {
                lower.text.push_str(upper.text.trim_start_matches(numeric)); // the unit stands behind the second
            }
            return Some((lower, upper));
        }
    }
    None
}
