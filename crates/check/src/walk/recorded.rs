//! Names that have a meaning in the joints, and are found from the pose: what they are in inverse formulas.

use super::scalars::replaced;
use super::{Scalar, Walk};
use denavit_reading::slip::Points;
use denavit_symbolic::parse::SyntaxKind;
use denavit_symbolic::vocabulary::plain_name;
use denavit_symbolic::{Expr, Node};
use std::ops::Range;

impl Walk<'_> {
    /// Keeps what is printed for the sine or cosine of a joint: `c_3 = D`, `s_3 = ±√(1 − D²)`.
    pub(super) fn record_sine(&mut self, spans: &[Range<usize>], read: &[Scalar]) {
        let ([_, right], [Scalar::Formula(_, left), _]) = (spans, read) else { return };
        let sine = left.value();
        if !matches!(sine.node(), Node::Sin(_) | Node::Cos(_)) {
            return;
        }
        let Ok(syntax) = self.lexis.inverse_formula(self.text, right) else { return };
        let known: Vec<(Expr, Expr)> = self.sines.iter().filter_map(|s| Some((s.0, *s.1.first()?))).collect();
        let values: Vec<Expr> = syntax.variants().iter().map(|s| replaced(s, &known, 0)).collect();
        self.sines.retain(|s| s.0 != sine);
        if !values.iter().any(|v| v.symbols().iter().any(|s| sine.symbols().contains(s))) {
            // `s_{234} = …`, an angle that is found before its parts.
            let joints = self.subject.joints();
            let parts = sine.symbols().into_iter().filter(|s| joints.contains(&(*s).into())).count();
            let is_right = || {
                let mut points = Points::new(61);
                let right = points.value(sine);
                matches!(&read[1], Scalar::Formula(_, s) if right.is_some() && points.value(s.value()) == right)
            };
            if let ([value], true) = (&values[..], parts > 1 && is_right()) {
                self.lexis.define_sine(&plain_name(self.source(&spans[0])), *value);
            }
            self.sines.push((sine, values));
        }
    }

    /// Keeps what a helper that was defined in the joints is by the pose: `ρ = a_2 c_2`, and later `ρ = c_1 x + s_1 y`.
    pub(super) fn record_posed(&mut self, spans: &[Range<usize>], read: &[Scalar]) {
        let ([name, right], [Scalar::Formula(_, left), Scalar::Formula(_, formula)]) = (spans, read) else {
            return;
        };
        let is_name = matches!(left.kind, SyntaxKind::Name(_)) && self.lexis.is_helper(self.source(name));
        if !is_name || !self.speaks_of_pose(right) || formula.sign_choices() > 0 {
            return;
        }
        let Ok(posed) = self.lexis.inverse_formula(self.text, right) else { return };
        // Which it is, and no other helper of this name.
        if denavit_symbolic::equal(left.value(), formula.value()).is_equal() {
            self.lexis.define_inverse(&plain_name(self.source(name)), posed.value());
        }
    }
}
