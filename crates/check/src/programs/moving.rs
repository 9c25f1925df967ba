//! Velocities of the hand and torques of the joints in programs.

use super::Program;
use super::called::{gives_another, is_velocity};
use super::stated::in_radians;
use crate::custom;
use crate::facts::{About, Meaning};
use crate::matrix::Matrix;
use crate::walk::Assertion;
use denavit_reading::code::{Assigned, Cell, Reading, Value, is_force};
use denavit_symbolic::{Expr, Symbol, equal};
use std::ops::Range;

impl Program<'_> {
    /// Columns that are called the hand's place, `p(1) = …`, if most of their entries that move are its coordinates.
    pub(super) fn places(&self, function: &Reading, judged: &[Assertion]) -> Vec<Assertion> {
        const NAMES: [&str; 9] = ["p", "P", "pos", "tip", "tcp", "xyz", "p_tool", "p_tip", "p_ee"];
        let place = Matrix::column(&self.subject.pose().translation);
        let mut found = vec![];
        for (i, a) in function.assigned.iter().enumerate() {
            let Value::Matrix(rows) = &a.value else { continue };
            let is_last = !function.assigned[i + 1..].iter().any(|b| b.name == a.name);
            let is_judged = judged.iter().any(|x| x.span.start < a.span.end && a.span.start < x.span.end);
            let is_line = rows.len() == 1 || rows.iter().all(|r| r.len() == 1);
            let rows: Vec<Vec<Cell>> = rows.iter().flatten().map(|c| vec![c.clone()]).collect();
            if !is_last || is_judged || !is_line || rows.len() != 3 || !NAMES.contains(&a.name.as_str()) {
                continue;
            }
            let joints = self.subject.joints();
            let moves = |e: Expr| e.symbols().iter().any(|s| joints.contains(&(*s).into()));
            let values = rows.iter().flatten().map(|c| in_radians(c.value));
            let moving: Vec<bool> = values
                .zip(place.0.iter().flatten())
                .filter(|(own, _)| moves(*own))
                .map(|(own, wanted)| wanted.is_some_and(|w| equal(own, self.with_numbers(w, own)).is_equal()))
                .collect();
            let right = moving.iter().filter(|r| **r).count();
            if right < 2 || 2 * right <= moving.len() {
                continue;
            }
            if let Some(pieces) = self.compare(&rows, &place) {
                let about = About::Matrix(Meaning::Position);
                found.push(self.assertion(&a.name, about, &a.span, pieces, Some(place.clone())));
            }
        }
        found
    }

    /// The torques of all joints below one another, or of the first ones, in an array that is called so: `tau[3]`.
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
        if !(is_called || self.has_force(rows.iter().flatten()))
            || rows.len() < n.min(2)
            || rows.len() > n
            || rows.iter().any(|r| r.len() != 1)
        {
            return None;
        }
        let wanted = self.wanted_torques(rows, is_called)?;
        let matrix = Matrix(wanted.into_iter().map(|e| vec![Some(e)]).collect());
        let pieces = self.compare(rows, &matrix)?;
        Some(self.assertion(shown, About::Matrix(Meaning::Torques), span, pieces, Some(matrix)))
    }

    /// The torques that rows should be; of rows that are not called so most have to be these.
    fn wanted_torques(&self, rows: &[Vec<Cell>], is_called: bool) -> Option<Vec<Expr>> {
        let told = self.told_torques(rows).filter(|w| is_called || self.is_mostly(rows, w));
        told.or_else(|| self.torques_of_argument(rows))
    }

    /// How many rows are what is wanted.
    fn right(&self, rows: &[Vec<Cell>], wanted: &[Expr]) -> usize {
        let printed = rows.iter().flatten().map(|c| in_radians(c.value));
        let pairs = printed.zip(wanted);
        pairs.filter(|(a, b)| equal(*a, self.with_numbers(**b, *a)).is_equal()).count()
    }

    fn is_mostly(&self, rows: &[Vec<Cell>], wanted: &[Expr]) -> bool {
        2 * self.right(rows, wanted) > rows.len()
    }

    /// The torques for the load that the document tells, if it is in what is printed.
    fn told_torques(&self, rows: &[Vec<Cell>]) -> Option<Vec<Expr>> {
        let torque = |k: usize| {
            let names = ["τ", "M", "C", "Γ"].map(|letter| format!("{letter}{k}"));
            let is_known = |name: &&String| self.lexis.is_by_custom(name);
            names.iter().find(is_known).and_then(|name| self.lexis.names.lookup(name))
        };
        let wanted: Vec<Expr> = (1..=rows.len()).map(torque).collect::<Option<_>>()?;
        // Of the load in the program's letters.
        let loads = wanted.iter().flat_map(|e| e.symbols());
        let loads: Vec<_> = loads.filter(|s| self.lexis.is_by_custom(&s.name())).collect();
        let printed: Vec<_> = rows.iter().flatten().flat_map(|c| c.value.symbols()).collect();
        loads.iter().any(|s| printed.contains(s)).then_some(wanted)
    }

    /// The torques for a force whose components are an argument, held or exerted: as most of what is printed has it.
    fn torques_of_argument(&self, rows: &[Vec<Cell>]) -> Option<Vec<Expr>> {
        let symbols = rows.iter().flatten().flat_map(|c| in_radians(c.value).symbols());
        let stem = symbols.into_iter().find_map(|s| {
            let name = s.name().to_string();
            name.strip_suffix(['x', 'y', 'z']).filter(|stem| is_force(stem)).map(String::from)
        })?;
        let zero = Expr::int(0);
        let force = ["x", "y", "z"].map(|axis| Expr::symbol(&format!("{stem}{axis}")));
        let exerted = self.subject.torques(&[force[0], force[1], force[2], zero, zero, zero]);
        let held: Vec<Expr> = exerted.iter().map(|e| -*e).collect();
        let best = [held, exerted].into_iter().max_by_key(|w| self.right(rows, w))?;
        self.is_mostly(rows, &best).then_some(best)
    }

    /// The torques of the first joints, each under a name of its own, `tau1 = … F[0] + … F[1]`.
    pub(super) fn torques_one_by_one(&self, function: &Reading, judged: &[Assertion]) -> Vec<Assertion> {
        let is_free =
            |a: &&Assigned| !judged.iter().any(|x| x.span.start < a.span.end && a.span.start < x.span.end);
        let torque = |k: usize| {
            let is_called = |a: &&Assigned| custom::plain(&a.name) == format!("τ{k}");
            // `n1`, `f3`: by their numbers, if a force stands in them.
            let is_numbered = |a: &&Assigned| {
                let stem = a.name.trim_end_matches(|c: char| c.is_ascii_digit());
                let has_force = matches!(&a.value, Value::Scalar(cell) if self.has_force([cell]));
                has_force && a.name[stem.len()..].parse() == Ok(k)
            };
            let mut all = function.assigned.iter().rev().filter(is_free);
            let found = all.clone().find(is_called).or_else(|| all.find(is_numbered))?;
            match &found.value {
                Value::Scalar(cell) => Some((found, cell)),
                Value::Matrix(_) => None,
            }
        };
        let all: Vec<(&Assigned, &Cell)> = (1..=self.subject.joints().len()).map_while(torque).collect();
        let rows: Vec<Vec<Cell>> = all.iter().map(|(_, cell)| vec![(*cell).clone()]).collect();
        if rows.len() < 2 {
            return vec![];
        }
        let is_called = all.iter().all(|(a, _)| custom::plain(&a.name).starts_with('τ'));
        let Some(wanted) = self.wanted_torques(&rows, is_called) else { return vec![] };
        let of = |((a, cell), wanted): (&(&Assigned, &Cell), Expr)| {
            let pieces = vec![self.piece(None, cell, wanted)];
            self.assertion(&a.name, About::Entry, &a.span, pieces, None)
        };
        all.iter().zip(wanted).map(of).collect()
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

    /// Whether components of a force stand in what is printed.
    fn has_force<'c>(&self, cells: impl IntoIterator<Item = &'c Cell>) -> bool {
        let is_component = |s: &Symbol| {
            s.name().strip_suffix(['x', 'y', 'z']).is_some_and(is_force)
                && !self.subject.joints().contains(&(*s).into())
        };
        cells.into_iter().any(|c| c.value.symbols().iter().any(is_component))
    }

    fn has_rates<'c>(&self, cells: impl IntoIterator<Item = &'c Cell>) -> bool {
        let rates = self.subject.rates();
        cells.into_iter().any(|c| in_radians(c.value).symbols().iter().any(|s| rates.contains(&(*s).into())))
    }
}
