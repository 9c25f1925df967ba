//! Which joint variables, or sums of them, a formula takes as known.

use super::setting::{Setting, Unknown, spans};
use denavit_symbolic::{Angle, Expr, Node};
use rustc_hash::FxHashSet;

/// What is known to a formula for `of`: what was found before, and what the formulas themselves speak of. Nothing if
/// they speak of the unknown itself.
pub fn known(
    setting: &Setting,
    of: &[Expr],
    before: &[Expr],
    branches: &[Vec<Expr>],
) -> Option<Vec<Unknown>> {
    let mut known: Vec<Expr> = before.to_vec();
    known.extend(setting.given.iter().map(|&j| Expr::from(setting.variables[j])));
    let rows = |all: &[Expr]| all.iter().filter_map(|&e| setting.row(e)).collect::<Vec<_>>();
    let first = rows(&known);
    for e in spoken(setting, &branches.concat()) {
        if let Some(row) = setting.row(e)
            && !spans(&rows(&known), &row)
        {
            known.push(e);
        }
    }
    let all = rows(&known);
    let is_circular = |e: &Expr| setting.row(*e).is_some_and(|r| spans(&all, &r) && !spans(&first, &r));
    (!of.iter().any(is_circular)).then(|| known.into_iter().map(|e| setting.unknown(e)).collect())
}

/// The angles of sines and cosines, and the sums outside of these, as linear forms in the variables.
fn spoken(setting: &Setting, formulas: &[Expr]) -> Vec<Expr> {
    let mut found = vec![];
    let mut seen = FxHashSet::default();
    let mut next: Vec<Expr> = formulas.to_vec();
    while let Some(e) = next.pop() {
        if !seen.insert(e) {
            continue;
        }
        let linear = match e.node() {
            Node::Sin(a) | Node::Cos(a) => a,
            Node::Symbol(_) | Node::Neg(_) | Node::Add(..) | Node::Sub(..) => e,
            Node::Mul(k, _) if k.as_number().is_some() => e,
            _ => {
                next.extend(e.children());
                continue;
            }
        };
        let form = Angle::of(linear);
        let is_variable = |x: Expr| x.as_symbol().is_some_and(|s| setting.variables.contains(&s));
        let (own, rest): (Vec<_>, Vec<_>) = form.terms.into_iter().partition(|t| is_variable(t.0));
        // A product that is a term of its own is looked into.
        next.extend(rest.into_iter().flat_map(|t| match t.0.node() {
            Node::Symbol(_) => vec![],
            Node::Mul(..) => t.0.children().collect(),
            _ => vec![t.0],
        }));
        if !own.is_empty() {
            found.push(Angle { terms: own, ..Angle::default() }.to_expr());
        }
    }
    found
}
