//! The torques for one set of choices, in the graph.
//!
//! Forward, a link turned by θ about z: ω, then the third column of U as vectors; the rest of U from five products of ω. Where the
//! masses are turned instead, U' = U + [−c −q̈ 0; q̈ −c 0; 2q̇ωx 2q̇ωy 0] with c = q̇(ωz + ωz'). Backward: force and moment of
//! each link from its numbers, first moments and second moments (or the tensor), summed to the base.

use super::arm::{Arm, V3, is_zero};
use super::choices::{Choices, Form, Frame, Gauge};
use crate::description::JointKind;
use denavit_program::{Graph, Value};
use denavit_symbolic::Expr;
use std::fmt;

/// How a frame moves: ω, ω̇, U, differences on the diagonal of U, and products of ω.
#[derive(Clone, Copy)]
struct Motion {
    w: V3,
    wd: V3,
    u: [V3; 3],
    differences: V3,
    /// ωy ωz, ωx ωz, ωx ωy.
    products: V3,
}

/// In which frame a vector is given.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// That before the group that begins with this link.
    Before(usize),
    /// That of a link.
    Link(usize),
}

/// A name for a component of a link's motion or wrench: `w2gz`, `U3_12`.
#[derive(Clone, Copy)]
pub(super) struct Label {
    letters: &'static str,
    link: usize,
    frame: Frame,
    entry: &'static str,
}

impl fmt::Display for Label {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}{}{}", self.letters, self.link + 1, mark(self.frame), self.entry)
    }
}

/// Where the entries of a vector and of a matrix stand in names.
const COMPONENTS: [&str; 3] = ["x", "y", "z"];
const ENTRIES: [[&str; 3]; 3] = [["_11", "_12", "_13"], ["_21", "_22", "_23"], ["_31", "_32", "_33"]];

pub(super) struct Generator<'a> {
    pub graph: &'a mut Graph,
    pub arm: &'a mut Arm,
    pub choices: &'a Choices,
    /// What values are, in the order in which they were met.
    pub names: Vec<(Value, Label)>,
    motions: Vec<[Option<Motion>; 4]>,
    pub(super) zero: Value,
}

impl<'a> Generator<'a> {
    pub fn new(graph: &'a mut Graph, arm: &'a mut Arm, choices: &'a Choices) -> Self {
        let zero = graph.trace(Expr::int(0));
        let n = arm.axes.len();
        Generator { graph, arm, choices, names: vec![], motions: vec![[None; 4]; n], zero }
    }

    pub(super) fn add(&mut self, a: Value, b: Value) -> Value {
        self.graph.add(a, b)
    }

    fn sub(&mut self, a: Value, b: Value) -> Value {
        let b = self.negated(b);
        self.graph.add(a, b)
    }

    pub(super) fn mul(&mut self, a: Value, b: Value) -> Value {
        self.graph.mul(a, b)
    }

    pub(super) fn negated(&self, a: Value) -> Value {
        if is_zero(self.graph, a) { a } else { -a }
    }

    pub(super) fn sum(&mut self, a: V3, b: V3) -> V3 {
        [self.add(a[0], b[0]), self.add(a[1], b[1]), self.add(a[2], b[2])]
    }

    fn dot(&mut self, a: V3, b: V3) -> Value {
        let p = [self.mul(a[0], b[0]), self.mul(a[1], b[1]), self.mul(a[2], b[2])];
        let first = self.add(p[0], p[1]);
        self.add(first, p[2])
    }

    pub(super) fn times(&mut self, m: &[V3; 3], v: V3) -> V3 {
        [self.dot(m[0], v), self.dot(m[1], v), self.dot(m[2], v)]
    }

    pub(super) fn cross(&mut self, a: V3, b: V3) -> V3 {
        let mut minor = |i: usize, j: usize| {
            let (x, y) = (self.mul(a[i], b[j]), self.mul(a[j], b[i]));
            self.sub(x, y)
        };
        [minor(1, 2), minor(2, 0), minor(0, 1)]
    }

    /// In the frame that is turned by an angle about z, seen from the one before.
    pub(super) fn turned(&mut self, angle: Option<(Value, Value)>, v: V3) -> V3 {
        let Some((s, c)) = angle else { return v };
        let (cx, sy, sx, cy) = (self.mul(c, v[0]), self.mul(s, v[1]), self.mul(s, v[0]), self.mul(c, v[1]));
        [self.sub(cx, sy), self.add(sx, cy), v[2]]
    }

    /// The other way round.
    fn unturned(&mut self, angle: Option<(Value, Value)>, v: V3) -> V3 {
        let Some((s, c)) = angle else { return v };
        let (cx, sy, sx, cy) = (self.mul(c, v[0]), self.mul(s, v[1]), self.mul(s, v[0]), self.mul(c, v[1]));
        [self.add(cx, sy), self.sub(cy, sx), v[2]]
    }

    /// Cᵀ v for the constant turn before an axis.
    fn seen_in_group(&mut self, k: usize, v: V3) -> V3 {
        let m = self.arm.axes[k].turn;
        let columns = [0, 1, 2].map(|c| [m[0][c], m[1][c], m[2][c]]);
        self.times(&columns, v)
    }

    pub(super) fn angle_of(&mut self, k: usize, frame: Frame) -> Option<(Value, Value)> {
        let first = self.arm.axes[k].first;
        match frame {
            Frame::Own => None,
            Frame::Group => self.arm.turned(first, k, self.graph),
            Frame::First if k == first => None,
            Frame::First => self.arm.turned(first + 1, k, self.graph),
        }
    }

    pub(super) fn place(&self, k: usize, frame: Frame) -> Place {
        let first = self.arm.axes[k].first;
        match frame {
            Frame::Own => Place::Link(k),
            Frame::Group => Place::Before(first),
            Frame::First => Place::Link(first),
        }
    }

    /// The rate and the change of the turns from one axis to another together.
    fn turning(&mut self, from: usize, to: usize) -> (Value, Value) {
        let (mut rate, mut change) = (self.zero, self.zero);
        for k in from..=to {
            let axis = &self.arm.axes[k];
            if axis.kind == JointKind::Revolute {
                let (r, c) = (axis.rate, axis.change);
                (rate, change) = (self.add(rate, r), self.add(change, c));
            }
        }
        (rate, change)
    }

    fn still(&self) -> Motion {
        let z = [self.zero; 3];
        Motion { w: z, wd: z, u: [z; 3], differences: z, products: z }
    }

    /// The frame before the group that begins with an axis, turned with the link before it.
    fn before(&mut self, first: usize) -> Motion {
        if let Some(known) = self.motions[first][3] {
            return known;
        }
        let found = if first == 0 {
            self.still()
        } else {
            let m = self.own(first - 1);
            let (w, wd) = (self.seen_in_group(first, m.w), self.seen_in_group(first, m.wd));
            let columns = [0, 1, 2].map(|c| [m.u[0][c], m.u[1][c], m.u[2][c]]);
            let columns = columns.map(|column| self.seen_in_group(first, column));
            let u =
                [0, 1, 2].map(|r| self.seen_in_group(first, [columns[0][r], columns[1][r], columns[2][r]]));
            let differences = self.differences(&u);
            let products = self.products(w);
            Motion { w, wd, u, differences, products }
        };
        self.motions[first][3] = Some(found);
        found
    }

    fn differences(&mut self, u: &[V3; 3]) -> V3 {
        [self.sub(u[2][2], u[1][1]), self.sub(u[0][0], u[2][2]), self.sub(u[1][1], u[0][0])]
    }

    fn products(&mut self, w: V3) -> V3 {
        [self.mul(w[1], w[2]), self.mul(w[0], w[2]), self.mul(w[0], w[1])]
    }

    /// What a turn about z adds to a motion, in its frame.
    fn with_turn(&mut self, from: &Motion, (rate, change): (Value, Value), is_added: bool) -> Motion {
        if is_zero(self.graph, rate) && is_zero(self.graph, change) {
            return *from;
        }
        let (up, w0) = (from.u, from.w);
        let wz = self.add(w0[2], rate);
        let w = [w0[0], w0[1], wz];
        let (across_y, across_x) = (self.mul(rate, w0[1]), self.mul(rate, w0[0]));
        let wd =
            [self.add(from.wd[0], across_y), self.sub(from.wd[1], across_x), self.add(from.wd[2], change)];
        let u = if is_added {
            let both = self.add(w0[2], wz);
            let c = self.mul(rate, both);
            let twice = self.add(rate, rate);
            let (x, y) = (self.mul(twice, w[0]), self.mul(twice, w[1]));
            [
                [self.sub(up[0][0], c), self.sub(up[0][1], change), up[0][2]],
                [self.add(up[1][0], change), self.sub(up[1][1], c), up[1][2]],
                [self.add(up[2][0], x), self.add(up[2][1], y), up[2][2]],
            ]
        } else {
            let [yz, xz, xy] = self.products(w);
            let squares = [0, 1, 2].map(|i| self.mul(w[i], w[i]));
            let mut diagonal = |i: usize, j: usize| {
                let sum = self.add(squares[i], squares[j]);
                self.negated(sum)
            };
            let d = [diagonal(1, 2), diagonal(0, 2), diagonal(0, 1)];
            [
                [d[0], self.sub(xy, wd[2]), self.add(xz, wd[1])],
                [self.add(xy, wd[2]), d[1], self.sub(yz, wd[0])],
                [self.sub(xz, wd[1]), self.add(yz, wd[0]), d[2]],
            ]
        };
        let differences = self.differences(&u);
        let products = self.products(w);
        Motion { w, wd, u, differences, products }
    }

    fn in_group(&mut self, k: usize) -> Motion {
        if let Some(known) = self.motions[k][1] {
            return known;
        }
        let first = self.arm.axes[k].first;
        let from = self.before(first);
        let turning = self.turning(first, k);
        let found = self.with_turn(&from, turning, self.choices.added[k]);
        self.motions[k][1] = Some(found);
        found
    }

    fn in_first(&mut self, k: usize) -> Motion {
        let first = self.arm.axes[k].first;
        if k == first {
            return self.own(first);
        }
        if let Some(known) = self.motions[k][2] {
            return known;
        }
        let from = self.own(first);
        let turning = self.turning(first + 1, k);
        let found = self.with_turn(&from, turning, self.choices.added[k]);
        self.motions[k][2] = Some(found);
        found
    }

    /// In the link's own frame, by the third column of U.
    fn own(&mut self, k: usize) -> Motion {
        if let Some(known) = self.motions[k][0] {
            return known;
        }
        let first = self.arm.axes[k].first;
        let (from, group) = (self.before(first), self.in_group(k));
        let Some(angle) = self.arm.turned(first, k, self.graph) else {
            self.motions[k][0] = Some(group);
            return group;
        };
        let w = self.unturned(Some(angle), group.w);
        let column = self.unturned(Some(angle), [from.u[0][2], from.u[1][2], self.zero]);
        let (u33, wdz) = (from.u[2][2], group.wd[2]);
        let [yz, xz, xy] = self.products(w);
        let (yy, zz) = (self.mul(w[1], w[1]), self.mul(w[2], w[2]));
        let (u13, u23) = (column[0], column[1]);
        let (wdy, wdx) = (self.sub(u13, xz), self.sub(yz, u23));
        let (u31, u32) = (self.sub(xz, wdy), self.add(yz, wdx));
        let sum = self.add(yy, zz);
        let u11 = self.negated(sum);
        let d1 = self.sub(zz, yy);
        let u22 = self.sub(u33, d1);
        let u = [[u11, self.sub(xy, wdz), u13], [self.add(xy, wdz), u22, u23], [u31, u32, u33]];
        let differences = [d1, self.sub(u11, u33), self.sub(u22, u11)];
        let found = Motion { w, wd: [wdx, wdy, wdz], u, differences, products: [yz, xz, xy] };
        self.motions[k][0] = Some(found);
        found
    }

    fn motion(&mut self, k: usize, frame: Frame) -> Motion {
        let m = match frame {
            Frame::Own => self.own(k),
            Frame::Group => self.in_group(k),
            Frame::First => self.in_first(k),
        };
        self.name("w", k, frame, m.w);
        self.name("wd", k, frame, m.wd);
        for (row, entries) in m.u.into_iter().zip(ENTRIES) {
            self.name_entries("U", k, frame, row, entries);
        }
        m
    }

    fn name(&mut self, letters: &'static str, k: usize, frame: Frame, v: V3) {
        self.name_entries(letters, k, frame, v, COMPONENTS);
    }

    fn name_entries(
        &mut self,
        letters: &'static str,
        link: usize,
        frame: Frame,
        v: V3,
        entries: [&'static str; 3],
    ) {
        let labels = entries.map(|entry| Label { letters, link, frame, entry });
        self.names.extend(v.into_iter().zip(labels));
    }

    /// A vector of one frame in another.
    pub(super) fn convert(&mut self, v: V3, from: Place, to: Place) -> V3 {
        if from == to {
            return v;
        }
        let group = |arm: &Arm, p: Place| match p {
            Place::Before(first) => first,
            Place::Link(k) => arm.axes[k].first,
        };
        let (source, target) = (group(self.arm, from), group(self.arm, to));
        if source == target {
            let angle = |g: &mut Self, p: Place| match p {
                Place::Before(_) => None,
                Place::Link(k) => g.arm.turned(source, k, g.graph),
            };
            let (a, b) = (angle(self, from), angle(self, to));
            if a == b {
                return v;
            }
            if let (Place::Link(i), Place::Link(j), true) = (from, to, self.choices.relative) {
                let (low, high) = (i.min(j), i.max(j));
                let between = self.arm.turned(low + 1, high, self.graph);
                return if j > i { self.unturned(between, v) } else { self.turned(between, v) };
            }
            let v = self.turned(a, v);
            return self.unturned(b, v);
        }
        if source < target {
            let next = (source + 1..self.arm.axes.len()).find(|&k| self.arm.axes[k].first == k);
            let next = next.unwrap_or(target);
            let v = self.convert(v, from, Place::Link(next - 1));
            let v = self.seen_in_group(next, v);
            return self.convert(v, Place::Before(next), to);
        }
        let v = self.convert(v, from, Place::Before(source));
        let turn = self.arm.axes[source].turn;
        let v = self.times(&turn, v);
        self.convert(v, Place::Link(source - 1), to)
    }

    /// The torques at the axes.
    pub fn torques(&mut self) -> Vec<Value> {
        let n = self.arm.axes.len();
        let mut accelerations: Vec<(V3, Place)> = vec![];
        let mut steps: Vec<V3> = vec![];
        let base = self.arm.base;
        let mut v = self.seen_in_group(0, base);
        if self.arm.axes[0].kind == JointKind::Prismatic {
            v[2] = self.add(v[2], self.arm.axes[0].change);
        }
        accelerations.push((v, Place::Before(0)));
        for k in 0..n.saturating_sub(1) {
            let frame = self.choices.step[k];
            let (place, m, angle) = (self.place(k, frame), self.motion(k, frame), self.angle_of(k, frame));
            let offset = self.arm.offset(k + 1, self.choices, self.graph);
            let p = self.turned(angle, offset);
            steps.push(p);
            let (before, from) = accelerations[k];
            let before = self.convert(before, from, place);
            let spread = self.times(&m.u, p);
            let mut v = self.sum(before, spread);
            if self.arm.axes[k + 1].kind == JointKind::Prismatic {
                let axis = &self.arm.axes[k + 1];
                let (rate, change) = (axis.rate, axis.change);
                let z = [axis.turn[0][2], axis.turn[1][2], axis.turn[2][2]];
                let z = if is_zero(self.graph, z[0]) && is_zero(self.graph, z[1]) {
                    z
                } else {
                    self.turned(angle, z)
                };
                let twice = self.add(rate, rate);
                let across = self.cross(m.w, z);
                let across = across.map(|x| self.mul(twice, x));
                let along = z.map(|x| self.mul(change, x));
                v = self.sum(v, across);
                v = self.sum(v, along);
            }
            self.name("a", k + 1, frame, v);
            accelerations.push((v, place));
        }
        let mut torques = vec![self.zero; n];
        let mut behind: Option<(V3, V3, Place)> = None;
        for k in (0..n).rev() {
            let own_frame = self.choices.wrench[k];
            let own = self.place(k, own_frame);
            let (v, from) = accelerations[k];
            let v = self.convert(v, from, own);
            let (force, moment) = self.wrench(k, own_frame, v);
            self.name("f", k, own_frame, force);
            self.name("n", k, own_frame, moment);
            let at = if k + 1 < n { self.place(k, self.choices.step[k]) } else { own };
            let (mut force, mut moment) = (self.convert(force, own, at), self.convert(moment, own, at));
            if let Some((f, m, from)) = behind {
                let (f, m) = (self.convert(f, from, at), self.convert(m, from, at));
                moment = self.sum(moment, m);
                let lever = self.cross(steps[k], f);
                moment = self.sum(moment, lever);
                force = self.sum(force, f);
            }
            behind = Some((force, moment, at));
            torques[k] = match self.arm.axes[k].kind {
                JointKind::Revolute => moment[2],
                JointKind::Prismatic => force[2],
            };
        }
        torques
    }

    pub(super) fn named(&mut self, letters: &'static str, k: usize) -> Value {
        let name = self.arm.number(letters, k);
        self.graph.trace(name)
    }

    /// Force and moment of a link about the origin of its frame, in a frame.
    fn wrench(&mut self, k: usize, frame: Frame, v: V3) -> (V3, V3) {
        let m = self.motion(k, frame);
        let angle = self.angle_of(k, frame);
        let turns = self.arm.axes[k].kind == JointKind::Revolute;
        if !turns {
            return self.wrench_of_slide(k, &m, angle, v);
        }
        let next = |g: Gauge| self.choices.gauge.get(k + 1) == Some(&g);
        let (no_x, no_y) = (next(Gauge::X), next(Gauge::Y));
        let mx = if no_x { self.zero } else { self.named("MX", k) };
        let my = if no_y { self.zero } else { self.named("MY", k) };
        let ms = self.turned(angle, [mx, my, self.zero]);
        let (form, u) = (self.choices.form[k], m.u);
        let columns = |c: usize| [u[0][c], u[1][c], u[2][c]];
        let by_x = columns(0).map(|e| self.mul(e, ms[0]));
        let by_y = columns(1).map(|e| self.mul(e, ms[1]));
        let mut force = self.sum(by_x, by_y);
        if self.choices.gauge[k] != Gauge::Nothing {
            let mass = self.named("M", k);
            let inertial = v.map(|e| self.mul(mass, e));
            force = self.sum(force, inertial);
        }
        let lever = self.cross(ms, v);
        let letters = match form {
            Form::NoZz => ["SXX", "SYY", "SXY", "SXZ", "SYZ"],
            Form::NoYy => ["XX", "", "XY", "XZ", "YZ"],
        };
        let given = letters.map(|l| if l.is_empty() { self.zero } else { self.named(l, k) });
        let [x, y, xy, xz, yz] = self.turned_tensor(angle, given, form);
        let [d1, d2, d3] = m.differences;
        let spin: [Vec<Value>; 3] = match form {
            Form::NoZz => [
                vec![self.mul(u[2][1], y), self.mul(d1, yz), self.mul(u[2][0], xy), self.minus(u[1][0], xz)],
                vec![
                    self.minus(u[2][0], x),
                    self.mul(d2, xz),
                    self.minus(u[2][1], xy),
                    self.mul(u[0][1], yz),
                ],
                vec![
                    self.mul(u[1][0], x),
                    self.minus(u[0][1], y),
                    self.mul(d3, xy),
                    self.mul(u[1][2], xz),
                    self.minus(u[0][2], yz),
                ],
            ],
            Form::NoYy => {
                let zz = self.named("ZZ", k);
                let (zy, xz_, yx) = (self.sub(zz, y), self.sub(x, zz), self.sub(y, x));
                let ([pyz, pxz, pxy], wd) = (m.products, m.wd);
                [
                    vec![
                        self.mul(x, wd[0]),
                        self.mul(zy, pyz),
                        self.minus(d1, yz),
                        self.minus(u[2][0], xy),
                        self.mul(u[1][0], xz),
                    ],
                    vec![
                        self.mul(y, wd[1]),
                        self.mul(xz_, pxz),
                        self.minus(d2, xz),
                        self.mul(u[2][1], xy),
                        self.minus(u[0][1], yz),
                    ],
                    vec![
                        self.mul(zz, wd[2]),
                        self.mul(yx, pxy),
                        self.minus(d3, xy),
                        self.minus(u[1][2], xz),
                        self.mul(u[0][2], yz),
                    ],
                ]
            }
        };
        let mut moment = [self.zero; 3];
        for (i, parts) in spin.into_iter().enumerate() {
            let sum = parts.into_iter().fold(self.zero, |sum, p| self.add(sum, p));
            moment[i] = self.add(sum, lever[i]);
        }
        (force, moment)
    }

    fn minus(&mut self, a: Value, b: Value) -> Value {
        let product = self.mul(a, b);
        self.negated(product)
    }

    /// xx, yy, xy, xz, yz of a symmetric matrix (second moments; or a tensor, whose entries off the diagonal turn alike), in the
    /// frame before the turn.
    pub(super) fn turned_tensor(
        &mut self,
        angle: Option<(Value, Value)>,
        t: [Value; 5],
        form: Form,
    ) -> [Value; 5] {
        let Some((s, c)) = angle else { return t };
        let [x, y, xy, xz, yz] = t;
        let (p, r) = (self.mul(s, c), self.mul(s, s));
        let twice = self.add(xy, xy);
        let (x1, y1) = match form {
            // y is 0: y' = x s² + 2xy s c
            Form::NoYy => {
                let (a, b) = (self.mul(x, r), self.mul(twice, p));
                let y1 = self.add(a, b);
                (self.sub(x, y1), y1)
            }
            Form::NoZz => {
                let d = self.sub(y, x);
                let (a, b) = (self.mul(d, r), self.mul(twice, p));
                let change = self.sub(a, b);
                let x1 = self.add(x, change);
                let both = self.add(x, y);
                (x1, self.sub(both, x1))
            }
        };
        let d = self.sub(y, x);
        let (a, b) = (self.mul(d, p), self.mul(twice, r));
        let change = self.add(a, b);
        let xy1 = self.sub(xy, change);
        let [xz1, yz1, _] = self.turned(angle, [xz, yz, self.zero]);
        [x1, y1, xy1, xz1, yz1]
    }

    /// A slide keeps a mass, which may be another for each direction, and a first moment.
    fn wrench_of_slide(&mut self, k: usize, m: &Motion, angle: Option<(Value, Value)>, v: V3) -> (V3, V3) {
        let names = self.arm.slides[k].unwrap_or([None; 6]);
        let mut at = |i: usize| names[i].map_or(self.zero, |s| self.graph.trace(Expr::from(s)));
        let (mass, ms) = ([at(0), at(1), at(2)], [at(3), at(4), at(5)]);
        let ms = self.turned(angle, ms);
        let inertial = match mass[0] == mass[1] {
            true => [0, 1, 2].map(|i| self.mul(mass[i], v[i])),
            // Another along x than along y: in the link's own frame.
            false => {
                let own = self.unturned(angle, v);
                let own = [0, 1, 2].map(|i| self.mul(mass[i], own[i]));
                self.turned(angle, own)
            }
        };
        let spread = self.times(&m.u, ms);
        (self.sum(spread, inertial), self.cross(ms, v))
    }
}

/// What marks the frame in a name: none its own, `g` that before the group, `h` that of the group's first link.
fn mark(frame: Frame) -> &'static str {
    match frame {
        Frame::Own => "",
        Frame::Group => "g",
        Frame::First => "h",
    }
}
