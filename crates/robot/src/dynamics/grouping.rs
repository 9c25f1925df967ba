//! Mass on the axis of a revolute joint belongs to either of the two links that it joins, and a slide turns with the link before
//! it: what a link can give to the one before, from the tip to the base (Gautier and Khalil 1990).
//!
//! A mass m, a first moment mz and a second moment zz along the axis are at the same place on both links, so that no energy
//! changes. With m = M, mz = MZ and zz = YY a link keeps XX − YY, XY, XZ, YZ, ZZ, MX and MY. A slide keeps its mass and its first
//! moment. Where all turns before it are about its own direction, it is fixed to the link before as seen along that direction: it
//! keeps what it weighs along it alone, and the link before takes the rest, a mass for motions in the plan. Where they are about
//! another direction, a first moment along that one stands still as the link turns, and has no effect: it is taken off such
//! that one component is 0.

use super::model::{Dynamics, Link};
use crate::description::JointKind;
use crate::geometry::{Body, Rotation, Transform, Vector};
use denavit_symbolic::{Expr, equal};

/// What a link has after grouping, about the origin of its frame.
#[derive(Clone, Debug)]
pub struct Grouped {
    /// XX XY XZ YY YZ ZZ.
    pub inertia: [Expr; 6],
    /// MX MY MZ.
    pub first_moment: Vector<Expr>,
    /// The mass for accelerations along x, y and z: F = M V̇ component by component.
    pub mass: Vector<Expr>,
}

/// What a link gives to the one before, where mass may be counted with either.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Gives {
    /// It turns: mass on its axis.
    OnAxis,
    /// It slides: its inertia.
    Inertia,
    /// It slides along the direction of all turns before it: all but its mass along that.
    Plan,
    /// It slides askew to the direction of all turns before it: its inertia, and its first moment along that direction counts
    /// nowhere.
    Across,
    /// It turns, and has a mass for each direction: nothing.
    Nothing,
}

impl Grouped {
    /// A body as it is.
    pub(super) fn of(body: &Body<Expr>) -> Self {
        let mass = Vector([body.mass; 3]);
        Grouped { inertia: body.inertia, first_moment: body.first_moment, mass }
    }

    /// Takes a body whose mass is one for the directions of `mass`.
    fn take(&mut self, body: &Body<Expr>, mass: Vector<Expr>) {
        self.inertia = std::array::from_fn(|k| self.inertia[k] + body.inertia[k]);
        self.first_moment = self.first_moment + body.first_moment;
        self.mass = self.mass + mass;
    }

    /// All numbers.
    pub(super) fn entries(&self) -> [Expr; 12] {
        let ([a, b, c, d, e, f], [x, y, z], [l, m, n]) = (self.inertia, self.first_moment.0, self.mass.0);
        [a, b, c, d, e, f, x, y, z, l, m, n]
    }

    /// With other numbers in their place.
    pub(super) fn with(&self, mut of: impl FnMut(usize, Expr) -> Expr) -> Self {
        let e = self.entries();
        let mut at = |k: usize| of(k, e[k]);
        Grouped {
            inertia: [at(0), at(1), at(2), at(3), at(4), at(5)],
            first_moment: Vector([at(6), at(7), at(8)]),
            mass: Vector([at(9), at(10), at(11)]),
        }
    }
}

/// The links after grouping, base first.
pub fn grouped(arm: &Dynamics<Expr>) -> Vec<Grouped> {
    with_gifts(arm).0
}

/// What each link gives to the one before, base first.
pub fn given(arm: &Dynamics<Expr>) -> Vec<Gives> {
    with_gifts(arm).1
}

fn with_gifts(arm: &Dynamics<Expr>) -> (Vec<Grouped>, Vec<Gives>) {
    let o = Expr::int(0);
    let bodies = arm.links.iter().map(|l| Grouped::of(&l.body)).collect();
    let mut gives = vec![Gives::Nothing; arm.links.len()];
    let all = told_by(arm, bodies, &mut gives, |_, own, _| {
        let yy = own.inertia[3];
        let first_moment = Vector([o, o, own.first_moment[2]]);
        Body { inertia: [yy, o, o, yy, o, o], first_moment, mass: own.mass[0] }
    });
    (all, gives)
}

/// The links, given as these, where each revolute one gives away what is chosen on its axis, for the link and the one before.
pub(super) fn grouped_by(
    arm: &Dynamics<Expr>,
    all: Vec<Grouped>,
    chosen: impl Fn(usize, &Grouped, Option<&Grouped>) -> Body<Expr>,
) -> Vec<Grouped> {
    told_by(arm, all, &mut vec![Gives::Nothing; arm.links.len()], chosen)
}

/// The same, saying what each gives.
fn told_by(
    arm: &Dynamics<Expr>,
    mut all: Vec<Grouped>,
    gives: &mut [Gives],
    chosen: impl Fn(usize, &Grouped, Option<&Grouped>) -> Body<Expr>,
) -> Vec<Grouped> {
    let o = Expr::int(0);
    for j in (0..all.len()).rev() {
        let (own, link) = (all[j].clone(), &arm.links[j]);
        let [xx, xy, xz, yy, yz, zz] = own.inertia;
        let [x, y, z] = own.mass.0;
        // What is given away, in the frame before the motion, and for which directions its mass is one.
        let (given, mass) = match link.kind {
            JointKind::Revolute if x == y => {
                gives[j] = Gives::OnAxis;
                let given = chosen(j, &own, link.parent.map(|p| &all[p]));
                let less = |a: Expr, b: Expr| match (b.is_zero(), a == b) {
                    (true, _) => a,
                    (_, true) => o,
                    _ => a - b,
                };
                let along = given.inertia[0];
                // Where it gives all its mass away, that may be one for the plan and another along the axis.
                let (mass, kept) = match given.mass == x {
                    true => (own.mass, Vector([o; 3])),
                    false => (Vector([given.mass; 3]), own.mass.map(|m| less(m, given.mass))),
                };
                all[j] = Grouped {
                    inertia: [less(xx, along), xy, xz, less(yy, along), yz, zz],
                    first_moment: Vector([own.first_moment[0], own.first_moment[1], o]),
                    mass: kept,
                };
                (given, mass)
            }
            JointKind::Revolute => continue,
            JointKind::Prismatic if is_plan(arm, j) && x == y => {
                gives[j] = Gives::Plan;
                all[j] = Grouped { inertia: [o; 6], first_moment: Vector([o; 3]), mass: Vector([o, o, z]) };
                let first_moment = Vector([own.first_moment[0], own.first_moment[1], o]);
                (Body { inertia: own.inertia, first_moment, mass: x }, Vector([x, y, o]))
            }
            JointKind::Prismatic => {
                gives[j] = Gives::Inertia;
                all[j].inertia = [o; 6];
                if let Some((axis, direction)) = turned_about(arm, j).and_then(|n| Some((greatest(n)?, n))) {
                    gives[j] = Gives::Across;
                    let part = own.first_moment[axis] / direction[axis];
                    all[j].first_moment = Vector([0, 1, 2].map(|i| match i == axis {
                        true => o,
                        false => own.first_moment[i] - direction[i] * part,
                    }));
                }
                let first_moment = Vector([o; 3]);
                (Body { inertia: own.inertia, first_moment, mass: o }, Vector([o; 3]))
            }
        };
        if let Some(before) = link.parent {
            let turned = diagonal(&link.before.rotation, mass).unwrap_or(mass);
            let place = match link.kind {
                JointKind::Revolute => link.before,
                // What is constant of its displacement does not matter: only what turns is given away.
                JointKind::Prismatic => still(link),
            };
            all[before].take(&given.seen_from(&place), turned);
        }
    }
    all
}

/// The place of a slide in the frame before it, its own displacement left aside.
fn still(link: &Link<Expr>) -> Transform<Expr> {
    link.before
}

/// A mass for each direction of a frame, in another; `None` if it is none there.
fn diagonal(r: &Rotation<Expr>, mass: Vector<Expr>) -> Option<Vector<Expr>> {
    let [x, y, z] = mass.0;
    if x == y && y == z {
        return Some(mass);
    }
    let rows = r.rows();
    let along = |row: [Expr; 3]| {
        let one: Vec<usize> = (0..3).filter(|&c| !row[c].is_zero()).collect();
        match one[..] {
            [c] if (row[c] * row[c]).is_one() => Some(mass[c]),
            _ => None,
        }
    };
    let [a, b, c] = rows.map(along);
    let apart = || Some(Vector([a?, b?, c?]));
    apart().or_else(|| {
        // A turn about z leaves a mass in the plan as it is.
        let about_z = rows[2][0].is_zero() && rows[2][1].is_zero();
        (about_z && x == y).then_some(mass)
    })
}

/// The direction of all turns before a link, in the frame before its motion, if they have one that is constant there.
fn turned_about(arm: &Dynamics<Expr>, link: usize) -> Option<Vector<Expr>> {
    let is_none = |e: Expr| e.is_zero() || equal(e, Expr::int(0)).is_equal();
    // From the link's frame to that of the one that is looked at; behind the last turn the direction in the latter.
    let mut r = arm.links[link].before.rotation;
    let mut found: Option<(Vector<Expr>, Vector<Expr>)> = None;
    let mut next = arm.links[link].parent;
    while let Some(k) = next {
        let link = &arm.links[k];
        if link.kind == JointKind::Revolute {
            let [_, _, z] = r.rows();
            let (_, here) = *found.get_or_insert((Vector(z), r * Vector(z)));
            if !is_none(here[0]) || !is_none(here[1]) {
                return None;
            }
        }
        next = link.parent;
        match &mut found {
            // A turn about it leaves it as it is.
            Some((_, here)) => *here = link.before.rotation * *here,
            None => r = link.before.rotation * r,
        }
    }
    found.map(|f| f.0)
}

/// The axis to which a direction in numbers is nearest; nothing for one that is along an axis, or has names.
fn greatest(direction: Vector<Expr>) -> Option<usize> {
    let sizes: Vec<f64> =
        direction.0.iter().map(|e| e.eval(|_| None).map(f64::abs)).collect::<Result<_, _>>().ok()?;
    let is_along = direction.0.iter().filter(|e| !e.is_zero()).count() == 1;
    (!is_along).then(|| (0..3).fold(0, |best, i| if sizes[i] >= sizes[best] { i } else { best }))
}

/// Whether a slide is along the direction of all turns before it, of which there is one, and masses can be kept apart by
/// directions on the way to the base.
fn is_plan(arm: &Dynamics<Expr>, slide: usize) -> bool {
    let mut r = arm.links[slide].before.rotation;
    let mut turns = 0;
    let (mut next, mut way) = (arm.links[slide].parent, vec![slide]);
    while let Some(k) = next {
        let link = &arm.links[k];
        next = link.parent;
        way.push(k);
        if link.kind == JointKind::Revolute {
            // The slide's direction in the frame of a link that turns: a turn about z leaves ±z alone.
            let z = r.z();
            if !(z[0].is_zero() && z[1].is_zero()) {
                return false;
            }
            turns += 1;
            r = link.before.rotation;
        } else {
            r = link.before.rotation * r;
        }
    }
    let one = Expr::int(1);
    let apart = |l: &Link<Expr>| diagonal(&l.before.rotation, Vector([one, one, Expr::int(0)])).is_some();
    // The first link on the way stands in the base.
    way.pop();
    turns > 0 && way.iter().all(|&k| apart(&arm.links[k]))
}
