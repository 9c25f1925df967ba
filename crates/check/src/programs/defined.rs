//! Names that programs define, and those of which nothing is said.

use super::followed::entries_of;
use crate::lexis::Lexis;
use crate::subject::Subject;
use crate::walk::{Assertion, Defined};
use denavit_reading::code::{Code, Value};
use denavit_symbolic::parse::SyntaxKind;
use denavit_symbolic::{Expr, Node};
use std::collections::BTreeSet;
use std::ops::Range;

/// What a program computes from the joints.
pub(super) fn unsaid(codes: &[Code], subject: &Subject) -> Vec<(Range<usize>, String)> {
    let moves = |e: &Expr| e.symbols().iter().any(|s| subject.joints().contains(&(*s).into()));
    let is_plain = |e: &Expr| matches!(e.node(), Node::Symbol(_) | Node::Sin(_) | Node::Cos(_));
    let tells = |value: &Value| {
        let entries = entries_of(value);
        entries.iter().any(moves) && !(entries.len() == 1 && is_plain(&entries[0]))
    };
    let functions = codes.iter().flat_map(|c| &c.functions);
    let assigned = functions.flat_map(|f| &f.assigned).filter(|a| tells(&a.value));
    assigned.map(|a| (a.span.clone(), a.name.clone())).collect()
}

/// Scalars with names of the author's own, which later formulas use.
pub(super) fn defined(
    source: &str,
    codes: &[Code],
    assertions: &[Assertion],
    subject: usize,
) -> Vec<Defined> {
    let mut found: Vec<Defined> = vec![];
    for a in codes.iter().flat_map(|c| &c.functions).flat_map(|f| &f.assigned) {
        let Value::Scalar(cell) = &a.value else { continue };
        let (Some(printed), false) = (&cell.syntax, cell.value.symbols().is_empty()) else { continue };
        let is_judged = assertions.iter().any(|x| x.span.start < a.span.end && a.span.start < x.span.end);
        let is_own = a.span.start <= cell.span.start && cell.span.end <= a.span.end;
        // `c12 = cos(q1 + q2)` is an abbreviation.
        let is_plain =
            matches!(cell.value.node(), Node::Sin(_) | Node::Cos(_)) && !a.name.ends_with(['x', 'y', 'z']);
        if is_judged || !is_own || is_plain || matches!(printed.kind, SyntaxKind::Name(_)) {
            continue;
        }
        let line = source[..a.span.start].rfind('\n').map_or(0, |i| i + 1);
        let start = line + (source[line..].len() - source[line..].trim_start().len());
        found.push(Defined {
            name: a.name.clone(),
            by_custom: false,
            statement: start.min(a.span.start)..a.span.end,
            shown: a.name.clone(),
            span: cell.span.clone(),
            printed: printed.clone(),
            value: cell.value,
            subject,
            from: a.span.end,
        });
    }
    found.dedup_by(|a, b| a.span == b.span);
    found
}

/// Names that a program gives numbers, and that the robot does not have.
pub(super) fn numbers(codes: &[Code], lexis: &Lexis) -> Vec<String> {
    let functions = codes.iter().flat_map(|c| &c.functions).filter(|f| f.name.is_empty());
    let is_number = |value: &Value| match value {
        Value::Scalar(cell) => cell.value.symbols().is_empty() && !cell.value.is_zero(),
        Value::Matrix(_) => false,
    };
    let assigned = functions.flat_map(|f| &f.assigned).filter(|a| is_number(&a.value));
    let names: BTreeSet<&String> = assigned.map(|a| &a.name).collect();
    names.into_iter().filter(|n| lexis.names.lookup(n).is_none()).cloned().collect()
}
