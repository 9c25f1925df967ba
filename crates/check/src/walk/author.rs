//! What an author printed, in the place of what the robot gives.

use super::{Assertion, Defined, Piece, Walk};
use crate::facts::{About, Meaning};
use crate::matrix::Matrix;
use crate::subject::Subject;
use denavit::forward::Reference;
use denavit::geometry::{Rotation, Transform, Vector};
use denavit_symbolic::Expr;
use denavit_symbolic::vocabulary::plain_name;
use std::collections::BTreeSet;
use std::rc::Rc;

impl Walk<'_> {
    /// True for the value of a name that is defined once, without a choice of sign.
    pub(super) fn is_plain_helper(&self, value: Expr) -> bool {
        let mut own = self.defined.iter().filter(|d| d.value == value);
        let is_choice = |d: &Defined| {
            d.printed.sign_choices() > 0 || self.defined.iter().filter(|o| o.name == d.name).count() > 1
        };
        own.next().is_some_and(|d| !is_choice(d)) && own.next().is_none()
    }

    /// Takes names that are defined for other values from here on.
    pub fn mend<'t>(&mut self, right: impl Iterator<Item = &'t (String, Expr)>) {
        for (name, value) in right {
            if self.lexis.names.lookup(name).is_some() {
                self.lexis.define(name, *value);
            }
        }
    }

    /// Takes what the claims at these places print for what follows, of the claims from number `first` on.
    pub fn believe(&mut self, places: &BTreeSet<usize>, first: usize) {
        let told: Vec<Assertion> = self.assertions[first.min(self.assertions.len())..]
            .iter()
            .filter(|a| places.contains(&a.span.start))
            .cloned()
            .collect();
        for assertion in told {
            let changed = match &assertion.about {
                About::Matrix(meaning) => self.printed_matrix(&assertion).and_then(|m| {
                    if let Meaning::Jacobian(_) = meaning {
                        self.rename(&assertion.name, m);
                        return None;
                    }
                    self.with_matrix(meaning, &m)
                }),
                About::Entry | About::Equation => self.with_scalar(&assertion),
                _ => None,
            };
            if let Some(subject) = changed {
                self.lexis = self.lexis.posed(&subject);
                self.subject = Rc::new(subject);
            }
            if let (About::Entry | About::Equation, [Piece::Pair(pair)]) =
                (&assertion.about, &assertion.pieces[..])
                && self.lexis.names.lookup(&plain_name(&assertion.name)).is_some()
            {
                self.lexis.define(&plain_name(&assertion.name), pair.value);
            }
        }
    }

    /// Gives a name of a matrix another meaning.
    fn rename(&mut self, name: &str, matrix: Matrix) {
        if let Some(name) = self.lexis.lone_name(name, &(0..name.len())) {
            self.lexis.define_matrix(&name, matrix, None);
        }
    }

    /// The right matrix with the entries that are printed in their places.
    fn printed_matrix(&self, assertion: &Assertion) -> Option<Matrix> {
        let mut matrix = assertion.whole.clone()?;
        for piece in &assertion.pieces {
            let (place, value) = match piece {
                Piece::Pair(pair) => (pair.place?, pair.value),
                Piece::Number { place, answer, .. } => ((*place)?, answer.constant?),
                Piece::Unreadable { .. } => continue,
            };
            *matrix.0.get_mut(place.0 - 1)?.get_mut(place.1 - 1)? = Some(value);
        }
        Some(matrix)
    }

    /// The robot with a matrix as printed.
    fn with_matrix(&self, meaning: &Meaning, m: &Matrix) -> Option<Subject> {
        let n = self.subject.last();
        let number = |r: Reference| match r {
            Reference::Base => 0,
            Reference::Frame(k) => k,
            Reference::Tool => n,
        };
        let rotation = || {
            let mut rows = [[Expr::int(0); 3]; 3];
            for (r, row) in rows.iter_mut().enumerate() {
                for (c, e) in row.iter_mut().enumerate() {
                    *e = m.entry(r, c)?;
                }
            }
            Some(Rotation::from_rows(rows))
        };
        let column = |c: usize| Some(Vector([m.entry(0, c)?, m.entry(1, c)?, m.entry(2, c)?]));
        let (of, seen_from, part) = match meaning {
            Meaning::Frame { of, seen_from } => (*of, *seen_from, 0),
            Meaning::Hand => (Reference::Tool, Reference::Frame(0), 0),
            Meaning::Position => (Reference::Tool, Reference::Frame(0), 2),
            Meaning::Rotation(whose) => match &**whose {
                Meaning::Frame { of, seen_from } => (*of, *seen_from, 1),
                _ => return None,
            },
            Meaning::Origin(whose) => match &**whose {
                Meaning::Frame { of, seen_from } => (*of, *seen_from, 2),
                _ => return None,
            },
            _ => return None,
        };
        let (from, to) = (number(seen_from), number(of));
        if from >= to {
            return None;
        }
        let known = self.subject.transform(Some(from), Some(to))?;
        let frame = match part {
            0 => Transform::from_rotation_translation(rotation()?, column(3)?),
            1 => Transform::from_rotation_translation(rotation()?, known.translation),
            _ => Transform::from_rotation_translation(known.rotation, column(0)?),
        };
        // The hand may be further on than the last frame.
        if of == Reference::Tool
            && from == 0
            && self.subject.transform(Some(n), None)? != Transform::identity()
        {
            let mut subject = Subject::clone(&self.subject);
            for (r, row) in frame.matrix().iter().enumerate().take(3) {
                for (c, &e) in row.iter().enumerate() {
                    subject = subject.with_entry(r, c, e);
                }
            }
            return Some(subject);
        }
        Some(self.subject.with_frame(from, to, frame))
    }

    /// The robot with an entry of the pose as printed.
    fn with_scalar(&self, assertion: &Assertion) -> Option<Subject> {
        let [piece] = &assertion.pieces[..] else { return None };
        let (wanted, value) = match piece {
            Piece::Pair(pair) => (pair.wanted, pair.value),
            Piece::Number { answer, .. } => (answer.wanted, answer.constant?),
            Piece::Unreadable { .. } => return None,
        };
        let pose = self.subject.pose().matrix();
        let places = (0..3).flat_map(|r| (0..4).map(move |c| (r, c)));
        let mut at = places.filter(|&(r, c)| pose[r][c] == wanted && !wanted.symbols().is_empty());
        let (r, c) = at.next()?;
        Some(self.subject.with_entry(r, c, value))
    }
}
