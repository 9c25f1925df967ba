//! What a row says of the mass of its link.

use super::inertia::turned;
use super::tree::Mass;
use super::{Description, Row};
use crate::geometry::{Body, Transform, Vector};
use denavit_symbolic::Expr;

impl Row {
    /// The link's mass about the origin of the row's frame; `None` if the row says nothing of it. What it does not say is 0.
    pub fn body(&self) -> Option<Body<Expr>> {
        let zero = Expr::int(0);
        let says = self.mass.is_some()
            || self.com.is_some()
            || self.inertia.is_some()
            || self.first_moment.is_some()
            || self.inertia_at_origin.is_some();
        if !says {
            return None;
        }
        let mass = self.mass.unwrap_or(zero);
        let centre = Vector(self.com.unwrap_or([zero; 3]));
        let mut body = Body::about_centre(mass, centre, self.inertia.unwrap_or([zero; 6]));
        if let Some(first_moment) = self.first_moment {
            body.first_moment = Vector(first_moment);
        }
        if let Some(inertia) = self.inertia_at_origin {
            body.inertia = inertia;
        }
        Some(body)
    }

    /// The link's mass, its centre and the inertia about it, as they are given or as they follow; what is not said is 0. `None` without a
    /// mass.
    pub(super) fn weighed(&self) -> Option<Mass> {
        if let (Some(mass), Some(com), Some(inertia)) = (self.mass, self.com, self.inertia) {
            return Some(Mass { mass, com, inertia });
        }
        let mass = self.mass.filter(|m| !m.is_zero())?;
        let (centre, inertia) = self.body()?.at_centre()?;
        Some(Mass { mass, com: centre.0, inertia })
    }

    /// Takes away what the row says of its link's mass.
    pub(in crate::description) fn weigh_nothing(&mut self) {
        (self.mass, self.com, self.inertia) = (None, None, None);
        (self.first_moment, self.inertia_at_origin) = (None, None);
    }

    /// Writes the link's mass in its new frame, in which the old one stands so.
    pub(super) fn move_frame(&mut self, x_new_old: &Transform<Expr>) {
        let moved = self.body().map(|b| b.seen_from(x_new_old));
        if let Some(com) = &mut self.com {
            *com = x_new_old.act_on_point(Vector(*com)).0;
        }
        if let Some(inertia) = &mut self.inertia {
            *inertia = turned(x_new_old.rotation, *inertia); // I' = R I Rᵀ
        }
        if let Some(moved) = moved {
            if self.first_moment.is_some() {
                self.first_moment = Some(moved.first_moment.0);
            }
            if self.inertia_at_origin.is_some() {
                self.inertia_at_origin = Some(moved.inertia);
            }
        }
    }
}

impl Row {
    /// What the row says of its link's mass and its drive, with the keys of a robot file.
    pub fn mass_cells(&self) -> impl Iterator<Item = (&'static str, Expr)> {
        let single = [
            ("mass", self.mass),
            ("rotor", self.rotor),
            ("viscous", self.viscous),
            ("coulomb", self.coulomb),
        ];
        let three = [("com", self.com), ("first_moment", self.first_moment)];
        let six = [("inertia", self.inertia), ("inertia_at_origin", self.inertia_at_origin)];
        let three = three.into_iter().flat_map(|(key, e)| e.into_iter().flatten().map(move |e| (key, e)));
        let six = six.into_iter().flat_map(|(key, e)| e.into_iter().flatten().map(move |e| (key, e)));
        single.into_iter().filter_map(|(key, e)| Some((key, e?))).chain(three).chain(six)
    }
}

impl Description {
    /// Puts values in the place of symbols in what the rows say of masses and drives, and in gravity.
    pub fn substitute_masses(&mut self, value: impl Fn(Expr) -> Expr) {
        for row in &mut self.rows {
            let single = [&mut row.mass, &mut row.rotor, &mut row.viscous, &mut row.coulomb];
            single.into_iter().flatten().for_each(|e| *e = value(*e));
            let three = [&mut row.com, &mut row.first_moment].into_iter().flatten().flatten();
            let six = [&mut row.inertia, &mut row.inertia_at_origin].into_iter().flatten().flatten();
            three.chain(six).for_each(|e| *e = value(*e));
        }
        self.gravity.iter_mut().flatten().for_each(|e| *e = value(*e));
    }
}
