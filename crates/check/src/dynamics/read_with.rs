//! How masses, inertias and gravity are read where the words of a document do not say it.

use super::attempt::Attempt;
use super::bodies::{ends, joint, slender};
use super::model::{Numbers, ROTOR, Rotor, numbers};
use super::told::Told;
use super::vote::Reading;
use super::words::Role;
use crate::facts::{ReadWith, Whereabouts};
use crate::formula::Formula;
use crate::subject::Subject;
use denavit::geometry::{Body, Rotation, Transform, Vector};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Node, Rational, equal};
use std::rc::Rc;

/// What an attempt takes names for that has an effect on what is right, and is not said.
pub(super) fn read_with(
    attempt: &Attempt,
    subject: &Subject,
    told: &Told,
    names: &Rc<Vocabulary>,
) -> Vec<ReadWith> {
    let (vote, reading) = (&attempt.vote, &attempt.vote.best[0]);
    let is_plain = !attempt.is_given && !attempt.roles.values().any(|r| matches!(r, Role::Ten(..)));
    if !is_plain || reading.score == 0 {
        return vec![];
    }
    let right = || (0..attempt.tests.len()).filter(|&t| reading.right[t]);
    let mut found = vec![];
    for (k, &row) in attempt.rows.iter().enumerate() {
        if right().any(|t| vote.links[t].contains(&k)) {
            found.extend(Link { attempt, reading, subject, told, names, k, row }.all());
        }
    }
    let gravity = attempt.gravities[reading.gravity];
    let has_gravity = |t: usize| {
        let symbols = attempt.tests[t].value.symbols();
        gravity.iter().flat_map(|e| e.symbols()).any(|g| symbols.contains(&g))
    };
    if told.gravity.is_none()
        && !told.is_level
        && subject.description.gravity.is_none()
        && right().any(has_gravity)
    {
        found.push(ReadWith::Gravity(gravity.map(|e| Formula::new(e, names))));
    }
    if !vote.against.is_empty() {
        // What words contradict is open.
        found.retain(|r| matches!(r, ReadWith::Mass { .. } | ReadWith::Gravity(_)));
    }
    found
}

/// A link as it is read.
struct Link<'a> {
    attempt: &'a Attempt,
    reading: &'a Reading,
    subject: &'a Subject,
    told: &'a Told,
    names: &'a Rc<Vocabulary>,
    k: usize,
    row: usize,
}

impl Link<'_> {
    fn numbers(&self) -> &Numbers {
        &self.attempt.candidates.bodies[self.k][self.reading.bodies[self.k]]
    }

    /// True if nothing that is right would be otherwise with this body.
    fn is_same(&self, body: Body<Expr>, centre: Vector<Expr>) -> bool {
        let own = self.numbers();
        let rotor = Rotor {
            inertia: own[ROTOR],
            coupled: own[ROTOR + 1],
            along: own[ROTOR + 2],
            mass: own[ROTOR + 3],
        };
        let other = numbers(body.parameters(), rotor, centre.0);
        self.attempt.vote.is_same(self.reading, self.k, own, &other, &self.attempt.model.state)
    }

    fn formula(&self, e: Expr) -> Formula {
        Formula::new(e, self.names)
    }

    fn all(&self) -> Vec<ReadWith> {
        let (own, link) = (self.numbers(), self.k);
        let (d, o) = (&self.subject.description, Expr::int(0));
        let mut found = vec![];
        if !own[ROTOR].is_zero() && !self.told.has_rotors {
            found.push(ReadWith::Rotor { inertia: self.formula(own[ROTOR]), joint: link });
        }
        // A load or a motor beside it is said by its name.
        let is_mass =
            |e: Expr| e.symbols().iter().all(|s| matches!(self.attempt.roles.get(s), Some(Role::Mass(_))));
        let mass = own[9];
        if !is_mass(mass) {
            return found;
        }
        let body = Body::of(std::array::from_fn(|p| own[p]));
        let joint = joint(d, self.row);
        let Some((centre, about_centre)) = body.at_centre() else {
            let inertia = self.about(&body, joint).map(|(inertia, _)| inertia);
            found.extend(inertia.map(|inertia| ReadWith::Inertia { inertia, link, is_at_joint: true }));
            return found;
        };
        let centre = self.centre(centre);
        let at_joint = Body::about_centre(mass, joint, about_centre);
        let is_told = self.told.links.from(link).is_some() || self.told.links.place.is_some();
        if !is_told && !self.is_same(at_joint, joint) {
            found.push(ReadWith::Mass {
                mass: self.formula(mass),
                link,
                at: self.whereabouts(centre, joint),
            });
        }
        let none = Body::about_centre(mass, centre, [o; 6]);
        let is_told = self.told.inertia.is_some() || self.told.links.shape.is_some();
        if is_told {
            return found;
        }
        if self.is_same(none, centre) {
            // With what it would have if it had one it would be otherwise.
            let one = Expr::symbol("an inertia");
            if !self.is_same(Body::about_centre(mass, centre, [one, o, o, one, o, one]), centre) {
                found.push(ReadWith::Point { link });
            }
        } else if let Some((inertia, is_at_joint)) = self.about(&body, joint) {
            found.push(ReadWith::Inertia { inertia, link, is_at_joint });
        } else {
            found.push(ReadWith::Rod { link });
        }
        found
    }

    /// The centre as it was made, without what a quotient leaves.
    fn centre(&self, quotient: Vector<Expr>) -> Vector<Expr> {
        let own = self.numbers();
        let given = Vector([own[15], own[16], own[17]]);
        let is_it = quotient.0.iter().zip(&given.0).all(|(a, b)| equal(*a, *b).is_equal());
        if is_it { given } else { quotient }
    }

    /// The inertia of a link, and whether it is about the joint.
    fn about(&self, body: &Body<Expr>, joint: Vector<Expr>) -> Option<(Formula, bool)> {
        let o = Expr::int(0);
        let at = |p: Vector<Expr>| {
            let back = Transform { rotation: Rotation::identity(), translation: Vector(p.0.map(|e| -e)) };
            body.seen_from(&back).inertia
        };
        let centre = body.at_centre().map(|(_, tensor)| tensor);
        let is_it = |a: [Expr; 6], b: [Expr; 6]| a.iter().zip(&b).all(|(x, y)| equal(*x, *y).is_equal());
        let is_inertia = |r: &Role| matches!(r, Role::Inertia(_) | Role::About(..));
        let symbols =
            body.inertia.iter().flat_map(|e| e.symbols()).collect::<std::collections::BTreeSet<_>>();
        for s in symbols.into_iter().filter(|s| self.attempt.roles.get(s).is_some_and(is_inertia)) {
            let inertia = Expr::from(s);
            let way = ends(&self.subject.description, self.row).first().map(|end| *end - joint);
            let along = way.and_then(unit);
            let mut tensors =
                vec![[inertia, o, o, inertia, o, inertia], slender(inertia, &Vector([Expr::int(1), o, o]))];
            tensors.extend(along.map(|u| slender(inertia, &u)));
            for (tensor, is_at_joint) in [(centre, false), (Some(at(joint)), true)] {
                // Of others only what turns about the axis has an effect.
                if tensor.is_some_and(|t| tensors.iter().any(|own| is_it(t, *own))) {
                    return Some((self.formula(inertia), is_at_joint));
                }
            }
            let is_free = |t: [Expr; 6]| {
                t.iter().all(|e| {
                    e.is_zero()
                        || e.symbols().iter().all(|s| self.attempt.roles.get(s).is_some_and(is_inertia))
                })
            };
            if centre.is_some_and(is_free) || is_free(at(joint)) {
                return Some((self.formula(inertia), !centre.is_some_and(is_free)));
            }
        }
        None
    }

    fn whereabouts(&self, centre: Vector<Expr>, joint: Vector<Expr>) -> Whereabouts {
        let is_at = |p: Vector<Expr>| (centre - p).0.iter().all(|e| equal(*e, Expr::int(0)).is_equal());
        let half = Expr::from(Rational::new(1, 2));
        if is_at(joint) {
            return Whereabouts::Joint;
        }
        for end in ends(&self.subject.description, self.row) {
            if is_at(end) {
                return Whereabouts::End;
            }
            if is_at((joint + end).scale(half)) {
                return Whereabouts::Middle;
            }
            // Along the way from the joint to the end.
            let Some(u) = unit(end - joint) else { continue };
            for length in centre.0.iter().flat_map(|e| e.symbols()).map(Expr::from) {
                if is_at(joint + u.scale(length)) {
                    return Whereabouts::FromJoint(self.formula(length));
                }
                if is_at(end - u.scale(length)) {
                    return Whereabouts::FromEnd(self.formula(length));
                }
            }
        }
        Whereabouts::At(centre.0.map(|e| self.formula(e)))
    }
}

/// The direction of an axis along which a vector points.
fn unit(v: Vector<Expr>) -> Option<Vector<Expr>> {
    let along: Vec<usize> = (0..3).filter(|&i| !v[i].is_zero()).collect();
    let &[i] = &along[..] else { return None };
    let is_back = matches!(v[i].node(), Node::Neg(_)) || v[i].as_number().is_some_and(|r| r.is_negative());
    let one = Expr::int(if is_back { -1 } else { 1 });
    Some(Vector(std::array::from_fn(|k| if k == i { one } else { Expr::int(0) })))
}
