//! Which statements define a name of the document's own.

use super::{Scalar, Walk};
use denavit_symbolic::Expr;
use denavit_symbolic::parse::{Syntax, SyntaxKind};
use denavit_symbolic::vocabulary::plain_name;
use std::ops::Range;

impl Walk<'_> {
    /// True if a side defines a name: one without meaning, or a second spelling of a joint whose own formula it would stand in.
    pub(super) fn defines(&self, span: &Range<usize>, side: &Scalar, formula: &Syntax) -> bool {
        match side {
            Scalar::Lone(_) => true,
            Scalar::Formula(_, left) => {
                let joint = left.value().as_symbol().filter(|s| self.subject.joints().contains(&(*s).into()));
                // A helper may be defined anew: what it was before is not what it should be.
                if matches!(left.kind, SyntaxKind::Name(_)) && self.lexis.is_helper(self.source(span)) {
                    // A number for it at a known configuration is its value.
                    let is_value = formula.value().symbols().is_empty() && !left.value().symbols().is_empty();
                    if is_value
                        && self.is_plain_helper(left.value())
                        && self.at.knows(left.value(), &self.subject)
                    {
                        return false;
                    }
                    return !denavit_symbolic::equal(left.value(), formula.value()).is_equal();
                }
                let is_letter = self.source(span).starts_with('t') && !self.source(span).starts_with("th");
                joint.is_some_and(|j| {
                    is_letter && formula.value() != left.value() && formula.value().symbols().contains(&j)
                })
            }
            Scalar::Broken(..) => false,
        }
    }

    /// True for `Z = P_z - L`: by custom Z is that entry of the pose, which it cannot be here.
    pub(super) fn is_told_of_itself(&self, name: &Range<usize>, formula: &Range<usize>) -> bool {
        let entry = |span: &Range<usize>| self.lexis.inverse_formula(self.text, span).ok().map(|s| s.value());
        // By custom, or beside the same in another spelling: `Px = px - d6*ax`.
        let is_own = |name: &Range<usize>| {
            let plain = |span: &Range<usize>| plain_name(self.source(span));
            self.lexis.is_by_custom(self.source(name)) || !plain(formula).contains(&plain(name))
        };
        let (Some(name), Some(formula)) = (entry(name).filter(|_| is_own(name)), entry(formula)) else {
            return false;
        };
        let is_entry = |s| (0..3).any(|r| (0..4).any(|c| self.lexis.pose_symbol(r, c) == s));
        name.as_symbol().is_some_and(|s| is_entry(s) && formula != name && formula.symbols().contains(&s))
    }

    /// True for `Y = d_1 - z = a_2 s_2 + a_3 s_{23}`, which holds of the arm but for the name: that is the document's own.
    pub(super) fn is_own_of_two(&self, name: &Range<usize>, read: &[Scalar]) -> bool {
        let [Scalar::Formula(_, left), Scalar::Formula(a, posed), Scalar::Formula(b, moved)] = read else {
            return false;
        };
        let known = |e: Expr| e.substitute(|s| self.subject.description.exact_value(s));
        let is_same = |x: Expr, y: Expr| denavit_symbolic::equal(known(x), known(y)).is_equal();
        let source = self.source(name).trim();
        source.chars().count() <= 2
            && self.speaks_of_pose(a)
            && !self.speaks_of_pose(b)
            && is_same(posed.value(), moved.value())
            && !is_same(left.value(), moved.value())
    }
}
