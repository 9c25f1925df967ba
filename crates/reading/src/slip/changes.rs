//! The small changes of a printed formula: each gives one part another value.

use super::edit::Edit;
use super::field::{self, ONE, Value, ZERO};
use super::lexicon::{Lexicon, atoms_of, distance};
use super::tree::{Kind, Tree};
use super::{Slip, Wanted};
use denavit_symbolic::expr::{Expr, Node};
use rustc_hash::FxHashSet;

/// What a change of a sign costs; the other costs are relative to it.
pub(super) const SIGN: u32 = 10;
/// What it costs more if an atom is put in that the right formula does not contain.
const FOREIGN: u32 = 4;
/// Only atoms as near as this are taken for each other here; the others are looked up.
const NEAR: u32 = 25;

/// A change of one part.
#[derive(Clone, Debug)]
pub(super) struct Change {
    pub part: usize,
    pub value: Value,
    pub cost: u32,
    pub slip: Slip,
    pub edit: Edit,
}

/// What it costs more to put in the atoms of `e`, for the right formula does not contain them.
pub(super) fn foreign(e: Expr, home: &FxHashSet<Expr>) -> u32 {
    if home.is_empty() {
        return 0;
    }
    let is_atom = |e: &Expr| matches!(e.node(), Node::Symbol(_) | Node::Sin(_) | Node::Cos(_));
    let atoms = atoms_of(e);
    FOREIGN * atoms.iter().filter(|a| is_atom(a) && !home.contains(a)).count() as u32
}

/// The atoms of the formula that is wanted; empty where only its values are known.
pub(super) fn home(wanted: &Wanted) -> FxHashSet<Expr> {
    match wanted {
        Wanted::Formula(e) => atoms_of(*e),
        Wanted::Values(_) => FxHashSet::default(),
    }
}

/// All small changes, at most `limit` of them.
pub(super) fn all(
    tree: &Tree,
    values: &[Value],
    lexicon: &Lexicon,
    home: &FxHashSet<Expr>,
    limit: usize,
) -> Vec<Change> {
    let mut changes = vec![];
    for (i, part) in tree.parts.iter().enumerate() {
        if changes.len() >= limit {
            break;
        }
        let x = &values[i];
        let mut offer = |value: Value, cost: u32, slip: Slip, edit: Edit| {
            if value != *x {
                changes.push(Change { part: i, value, cost, slip, edit });
            }
        };
        let parent = part.parent.map(|p| &tree.parts[p].kind);
        let is_term = matches!(parent, Some(Kind::Sum(_)));
        match (&part.kind, tree.is_whole(i) && !is_term) {
            (Kind::Sum(signs), true) => {
                let cost = SIGN * signs.len() as u32;
                offer(field::opposite(x), cost, Slip::Sign, Edit::FlipAll(i));
            }
            (_, true) => {
                let cost = if part.in_braces { SIGN + 6 } else { SIGN };
                offer(field::opposite(x), cost, Slip::Sign, Edit::Flip(i));
            }
            _ if is_term => offer(field::opposite(x), SIGN, Slip::Sign, Edit::Flip(i)),
            _ => {}
        }
        let has_siblings = part.parent.is_some_and(|p| tree.parts[p].kids.len() > 1);
        match parent {
            Some(Kind::Sum(_)) if has_siblings => {
                offer(ZERO, 16 + 2 * part.size.min(12), Slip::ExtraTerm, Edit::Delete(i));
            }
            Some(Kind::Product(_)) if has_siblings => {
                offer(ONE, 13 + 7 * part.size.min(12), Slip::ExtraFactor, Edit::Delete(i));
            }
            _ => {}
        }
        match part.kind {
            Kind::Leaf(e) => {
                for &(other, value) in &lexicon.atoms {
                    let cost = distance(e, other);
                    if cost < NEAR {
                        let cost = cost + foreign(other, home);
                        offer(value, cost, replaced(e, other), Edit::Respell(i, other));
                    }
                }
            }
            Kind::Power(n) => {
                for other in [1, 2, 3, n - 1, n + 1] {
                    if other != n
                        && other != 0
                        && let Some(value) = field::raised(&values[part.kids[0]], other)
                    {
                        offer(value, 18, Slip::Exponent, Edit::Power(i, other));
                    }
                }
            }
            Kind::Sum(_) | Kind::Product(_) | Kind::Root | Kind::Arctangent | Kind::Bracket => {}
        }
        let is_factor = !matches!(parent, Some(Kind::Power(_)));
        let is_base = match part.kind {
            Kind::Leaf(e) => e.as_number().is_none(),
            Kind::Bracket => matches!(parent, Some(Kind::Sum(_) | Kind::Product(_)) | None),
            _ => false,
        };
        if is_factor && is_base {
            offer(field::product(x, x), 20, Slip::Exponent, Edit::Power(i, 2));
        }
    }
    changes.truncate(limit);
    changes
}

/// What slip puts one atom in the place of another.
pub(super) fn replaced(a: Expr, b: Expr) -> Slip {
    match (a.node(), b.node()) {
        (Node::Sin(x), Node::Cos(y)) | (Node::Cos(x), Node::Sin(y)) if x == y => Slip::SineForCosine,
        (Node::Sin(_), Node::Sin(_)) | (Node::Cos(_), Node::Cos(_)) => Slip::Index,
        (Node::Symbol(_), Node::Symbol(_)) if distance(a, b) < 20 => Slip::Index,
        (Node::Symbol(_), Node::Symbol(_)) => Slip::Symbol,
        (Node::Sin(_), Node::Cos(_)) | (Node::Cos(_), Node::Sin(_)) => {
            Slip::Several(vec![Slip::SineForCosine, Slip::Index])
        }
        _ => Slip::Replaced,
    }
}
