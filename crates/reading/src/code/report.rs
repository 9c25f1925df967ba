//! What was computed, as it is handed back.

use super::scalar::{Budget, Scalar};
use super::tree::{Kind, Node, Span};
use super::value::Object;
use super::{Cell, Returned, Value};
use denavit_symbolic::parse::{Syntax, SyntaxKind};

/// Numbers and matrices; `None` for lists of matrices, functions and texts.
pub(super) fn value(object: &Object, budget: &mut Budget) -> Option<Value> {
    let mut cells =
        |entries: &[Scalar]| -> Option<Vec<Cell>> { entries.iter().map(|e| cell(e, budget)).collect() };
    match object {
        Object::Scalar(s) => Some(Value::Scalar(cell(s, budget)?)),
        Object::Matrix(m) if m.entries.is_empty() => None,
        Object::Matrix(m) => {
            Some(Value::Matrix(m.entries.chunks(m.columns).map(&mut cells).collect::<Option<_>>()?))
        }
        Object::List(items) if items.is_empty() => None,
        Object::List(items) => {
            let mut rows: Vec<Vec<Cell>> = vec![];
            for item in items.iter() {
                rows.push(match item {
                    Object::Scalar(s) => cells(std::slice::from_ref(s))?,
                    Object::List(row) => {
                        let scalar = |o: &Object| match o {
                            Object::Scalar(s) => Some(s.clone()),
                            _ => None,
                        };
                        cells(&row.iter().map(scalar).collect::<Option<Vec<Scalar>>>()?)?
                    }
                    _ => return None,
                });
            }
            let length = rows[0].len();
            (length > 0 && rows.iter().all(|r| r.len() == length)).then_some(Value::Matrix(rows))
        }
        _ => None,
    }
}

/// What a function gives back, one by one.
pub(super) fn returned(node: &Node, object: &Object, budget: &mut Budget) -> Vec<Returned> {
    let name = |node: &Node| match &node.kind {
        Kind::Name(name) => Some(name.clone()),
        _ => None,
    };
    let inner = match &node.kind {
        Kind::Bracket(inner) => inner,
        _ => node,
    };
    if let (Kind::Tuple(parts), Object::List(items)) = (&inner.kind, object)
        && parts.len() == items.len()
    {
        return parts.iter().zip(items.iter()).flat_map(|(p, i)| returned(p, i, budget)).collect();
    }
    if let Some(value) = value(object, budget) {
        return vec![Returned { name: name(inner), span: inner.span.clone(), value }];
    }
    // A list of matrices.
    let Object::List(items) = object else { return vec![] };
    let one = |item: &Object| {
        let value = value(item, budget)?;
        Some(Returned { name: None, span: inner.span.clone(), value })
    };
    items.iter().filter_map(one).collect()
}

fn cell(s: &Scalar, budget: &mut Budget) -> Option<Cell> {
    let written = s.syntax.as_ref().map_or(0, |_| s.span.len() as u64 / 8);
    budget.charge(1 + written, &s.span).ok()?;
    let s = s.clone().settled();
    let start = s.span.start;
    let syntax = s.syntax.as_deref().map(|syntax| moved(syntax, start));
    Some(Cell { value: s.expr, syntax, span: s.span })
}

/// The same with places that count from `start`.
fn moved(syntax: &Syntax, start: usize) -> Syntax {
    let boxed = |s: &Syntax| Box::new(moved(s, start));
    let kind = match &syntax.kind {
        SyntaxKind::Number(_) | SyntaxKind::Name(_) => syntax.kind.clone(),
        SyntaxKind::Sum(terms) => SyntaxKind::Sum(terms.iter().map(|(s, t)| (*s, moved(t, start))).collect()),
        SyntaxKind::Product(factors) => {
            SyntaxKind::Product(factors.iter().map(|(d, f)| (*d, moved(f, start))).collect())
        }
        SyntaxKind::Fraction(over, under) => SyntaxKind::Fraction(boxed(over), boxed(under)),
        SyntaxKind::Power(base, n) => SyntaxKind::Power(boxed(base), *n),
        SyntaxKind::Root(inner) => SyntaxKind::Root(boxed(inner)),
        SyntaxKind::Call(f, arguments) => {
            SyntaxKind::Call(*f, arguments.iter().map(|a| moved(a, start)).collect())
        }
        SyntaxKind::Bracket(inner) => SyntaxKind::Bracket(boxed(inner)),
    };
    let at = |place: usize| place.saturating_sub(start);
    let span: Span = at(syntax.span.start)..at(syntax.span.end);
    Syntax { kind, span }
}
