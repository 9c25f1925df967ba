//! The inertia matrix by composite bodies, in second moments: each link with what is behind it, in its own frame or in that before
//! its group, from the tip to the base.
//!
//! A body seen from another origin, P away: Σ' = Σ + MS Pᵀ + P (MS + M P)ᵀ, MS' = MS + M P. A link that turns with the unit
//! acceleration needs the force (−MY, MX, 0) and the moment (−Σxz, −Σyz, Σxx + Σyy), carried to the base.

use super::arm::{V3, is_zero};
use super::choices::Form;
use super::generator::{Generator, Place};
use crate::description::JointKind;
use denavit_program::Value;
use denavit_symbolic::Expr;

/// Masses of a link with those behind it, about the origin of its frame.
struct Composite {
    /// xx, yy, xy, xz, yz, zz of the second moments.
    second: [Value; 6],
    first: V3,
    mass: Value,
}

/// Where two components stand among the second moments.
const PLACES: [(usize, usize); 6] = [(0, 0), (1, 1), (0, 1), (0, 2), (1, 2), (2, 2)];

impl Generator<'_> {
    /// The matrix of the axes; nothing where a link has a mass for each direction that is not one along its group alone.
    pub fn inertia(&mut self) -> Option<Vec<Vec<Value>>> {
        let n = self.arm.axes.len();
        let mut matrix = vec![vec![self.zero; n]; n];
        let mut behind: Option<Composite> = None;
        // What only masses along the first group's axes add.
        let mut along = self.zero;
        for k in (0..n).rev() {
            let frame = self.choices.step[k];
            let (mut body, axial) = self.numbers_of(k)?;
            along = self.add(along, axial);
            let angle = self.angle_of(k, frame);
            body.second = self.turned_second(angle, body.second);
            body.first = self.turned(angle, body.first);
            if let Some(rest) = behind {
                let rest = self.seen_before(k + 1, rest);
                let p = self.lever(k + 1);
                let by_mass = p.map(|x| self.mul(rest.mass, x));
                let moved = self.sum(rest.first, by_mass);
                for (i, (r, c)) in PLACES.into_iter().enumerate() {
                    let (a, b) = (self.mul(rest.first[r], p[c]), self.mul(moved[c], p[r]));
                    let both = self.add(a, b);
                    let all = self.add(rest.second[i], both);
                    body.second[i] = self.add(body.second[i], all);
                }
                body.first = self.sum(body.first, moved);
                body.mass = self.add(body.mass, rest.mass);
            }
            let ([xx, yy, _, xz, yz, _], [mx, my, _]) = (body.second, body.first);
            let (mut force, mut moment, entry);
            if self.arm.axes[k].kind == JointKind::Revolute {
                let both = self.add(xx, yy);
                force = [self.negated(my), mx, self.zero];
                moment = [self.negated(xz), self.negated(yz), both];
                entry = both;
            } else {
                let all = if self.arm.axes[k].first == 0 { self.add(body.mass, along) } else { body.mass };
                force = [self.zero, self.zero, all];
                moment = [my, self.negated(mx), self.zero];
                entry = all;
            }
            matrix[k][k] = entry;
            for j in (0..k).rev() {
                let (from, to) =
                    (self.place(j + 1, self.choices.step[j + 1]), self.place(j, self.choices.step[j]));
                (force, moment) = (self.convert(force, from, to), self.convert(moment, from, to));
                let p = self.lever(j + 1);
                let turning = self.cross(p, force);
                moment = self.sum(moment, turning);
                let entry = match self.arm.axes[j].kind {
                    JointKind::Revolute => moment[2],
                    JointKind::Prismatic => force[2],
                };
                (matrix[j][k], matrix[k][j]) = (entry, entry);
            }
            behind = Some(body);
        }
        Some(matrix)
    }

    /// The masses of a link alone in its own frame, and what acts along its axis only.
    fn numbers_of(&mut self, k: usize) -> Option<(Composite, Value)> {
        let o = self.zero;
        let Some(names) = self.arm.slides[k] else {
            let [xx, yy, xy, xz, yz] = ["SXX", "SYY", "SXY", "SXZ", "SYZ"].map(|l| self.named(l, k));
            let first = [self.named("MX", k), self.named("MY", k), o];
            return Some((Composite { second: [xx, yy, xy, xz, yz, o], first, mass: o }, o));
        };
        let [a, b, c, x, y, z] = names.map(|s| s.map_or(o, |s| self.graph.trace(Expr::from(s))));
        let body = |mass: Value| Composite { second: [o; 6], first: [x, y, z], mass };
        let is_along = is_zero(self.graph, a) && is_zero(self.graph, b) && self.arm.axes[k].first == 0;
        match (a == b && b == c, is_along) {
            (true, _) => Some((body(a), o)),
            (false, true) => Some((body(o), c)),
            (false, false) => None,
        }
    }

    /// The way from the origin of a link to that of the next, `k`, in the frame that is chosen for the first.
    fn lever(&mut self, k: usize) -> V3 {
        let p = self.arm.offset(k, self.choices, self.graph);
        let angle = self.angle_of(k - 1, self.choices.step[k - 1]);
        self.turned(angle, p)
    }

    /// A body that is known in the frame chosen for link `k`, in that chosen for the link before, about the same origin.
    fn seen_before(&mut self, k: usize, body: Composite) -> Composite {
        let (own, before) = (self.choices.step[k], self.choices.step[k - 1]);
        let (from, to) = (self.place(k, own), self.place(k - 1, before));
        let first = self.convert(body.first, from, to);
        let (start, start_before) = (self.arm.axes[k].first, self.arm.axes[k - 1].first);
        let mut second = body.second;
        if start == start_before && (from, to) == (Place::Link(k), Place::Link(k - 1)) {
            let between = self.arm.turned(k, k, self.graph);
            second = self.turned_second(between, second);
            return Composite { second, first, ..body };
        }
        // Into the frame before the group.
        if from == Place::Link(k) {
            let angle = self.arm.turned(start, k, self.graph);
            second = self.turned_second(angle, second);
        }
        let is_own = to == Place::Link(k - 1);
        let angle = self.arm.turned(start_before, k - 1, self.graph);
        if start == start_before {
            let back = angle.map(|(s, c)| (self.negated(s), c)).filter(|_| is_own);
            second = self.turned_second(back, second);
        } else {
            // C Σ Cᵀ, a side after the other.
            let turn = self.arm.axes[k].turn;
            let [xx, yy, xy, xz, yz, zz] = second;
            let rows = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]].map(|row| self.times(&turn, row));
            let columns = [0, 1, 2].map(|c| self.times(&turn, [rows[0][c], rows[1][c], rows[2][c]]));
            second = PLACES.map(|(r, c)| columns[c][r]);
            second = self.turned_second(angle.filter(|_| !is_own), second);
        }
        Composite { second, first, ..body }
    }

    fn turned_second(&mut self, angle: Option<(Value, Value)>, second: [Value; 6]) -> [Value; 6] {
        let [xx, yy, xy, xz, yz, zz] = second;
        let [xx, yy, xy, xz, yz] = self.turned_tensor(angle, [xx, yy, xy, xz, yz], Form::NoZz);
        [xx, yy, xy, xz, yz, zz]
    }
}
