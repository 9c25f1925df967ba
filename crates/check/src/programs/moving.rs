//! Velocities of the hand and torques of the joints in programs.

use super::Program;
use super::called::{gives_another, is_velocity};
use super::stated::in_radians;
use crate::custom;
use crate::facts::{About, Meaning};
use crate::matrix::Matrix;
use crate::walk::Assertion;
use denavit_reading::code::{Cell, Reading, Value};
use denavit_symbolic::Expr;
use std::ops::Range;

impl Program<'_> {
    /// The torques of all joints below one another, in an array that is called so: `tau[3]`.
    pub(super) fn torques(
        &self,
        name: &str,
        shown: &str,
        span: &Range<usize>,
        rows: &[Vec<Cell>],
    ) -> Option<Assertion> {
        const NAMES: [&str; 8] = ["tau", "torque", "hold", "static", "effort", "force", "grav", "load"];
        let lower = name.to_lowercase();
        let is_called = NAMES.iter().any(|n| lower.starts_with(n) || lower.ends_with(n));
        let n = self.subject.joints().len();
        if !is_called || rows.len() != n || rows.iter().any(|r| r.len() != 1) {
            return None;
        }
        let torque = |k: usize| {
            let names = ["τ", "M", "C", "Γ"].map(|letter| format!("{letter}{k}"));
            let is_known = |name: &&String| self.lexis.is_by_custom(name);
            names.iter().find(is_known).and_then(|name| self.lexis.names.lookup(name))
        };
        let wanted: Vec<Expr> = (1..=n).map(torque).collect::<Option<_>>()?;
        // Of the load in the program's letters.
        let loads = wanted.iter().flat_map(|e| e.symbols());
        let loads: Vec<_> = loads.filter(|s| self.lexis.is_by_custom(&s.name())).collect();
        let printed: Vec<_> = rows.iter().flatten().flat_map(|c| c.value.symbols()).collect();
        if !loads.iter().any(|s| printed.contains(s)) {
            return None;
        }
        let matrix = Matrix(wanted.into_iter().map(|e| vec![Some(e)]).collect());
        let pieces = self.compare(rows, &matrix)?;
        Some(self.assertion(shown, About::Matrix(Meaning::Torques), span, pieces, Some(matrix)))
    }

    /// The velocity of the hand that a function gives back, which its name says.
    pub(super) fn velocity(
        &self,
        function: &Reading,
        shown: &str,
        span: &Range<usize>,
        rows: &[Vec<Cell>],
    ) -> Option<Assertion> {
        let is_column = matches!(rows.len(), 2 | 3 | 6) && rows.iter().all(|r| r.len() == 1);
        if !is_column
            || !gives_another(function)
            || !is_velocity(function)
            || !self.has_rates(rows.iter().flatten())
        {
            return None;
        }
        let wanted = self.subject.velocity().into_iter().take(rows.len());
        let matrix = Matrix(wanted.map(|e| vec![Some(e)]).collect());
        let pieces = self.compare(rows, &matrix)?;
        Some(self.assertion(shown, About::Equation, span, pieces, None))
    }

    /// `v.x` of such a function.
    pub(super) fn component(
        &self,
        name: &str,
        shown: &str,
        span: &Range<usize>,
        value: &Value,
    ) -> Option<Assertion> {
        let Value::Scalar(cell) = value else { return None };
        let plain = custom::plain(name).to_lowercase();
        let axis = ["x", "y", "z"].iter().position(|a| plain == *a || plain == format!("v{a}"))?;
        if !self.has_rates([cell]) {
            return None;
        }
        let pieces = vec![self.piece(None, cell, self.subject.velocity()[axis])];
        Some(self.assertion(shown, About::Equation, span, pieces, None))
    }

    fn has_rates<'c>(&self, cells: impl IntoIterator<Item = &'c Cell>) -> bool {
        let rates = self.subject.rates();
        cells.into_iter().any(|c| in_radians(c.value).symbols().iter().any(|s| rates.contains(&(*s).into())))
    }
}
