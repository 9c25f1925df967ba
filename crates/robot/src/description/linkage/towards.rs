//! The inverse problem of a linkage as the assembly of another one: where its tip is to be is a slide in x, one in y and a turn (in space
//! a slide in z, too, and three turns), which are driven; the tip is held there by one closure more, and all joints of the linkage are
//! passive.

use super::{Closure, Linkage, Side};
use crate::description::branches::fixed_rows;
use crate::description::lines::NotNamed;
use crate::description::{Convention, JointKind, NoChain, Row, RowTree, Variable};
use crate::geometry::{Axis, Rotation, Transform, Vector};
use denavit_symbolic::{Expr, Rational, Symbol, equal, readable};
use std::fmt;

/// What of the tip is wanted.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Wanted {
    /// Its place.
    Position,
    /// Its place and its orientation.
    Pose,
}

/// The linkage whose assemblies solve the inverse problem.
#[derive(Clone, Debug)]
pub struct Towards {
    /// Its driven joints are where the tip is to be ([`Towards::driven`]).
    pub linkage: Linkage,
    /// The plane in which all happens, if all does.
    pub plane: Option<TipPlane>,
    /// Of the driven joints of the linkage that is asked about, q1 first, the place among the passive ones of this one; then of its
    /// passive joints.
    pub places: [Vec<usize>; 2],
    /// The tip's frame, and its rotation in the base with all joints at 0.
    pub tip: String,
    rest: Rotation<Expr>,
    wanted: Wanted,
}

/// The plane in which a linkage moves.
#[derive(Clone, Debug)]
pub struct TipPlane {
    /// Its axes in the base: x and y are along it.
    pub axes: Rotation<Expr>,
    /// How high the tip stands over that through the base's origin.
    pub height: Expr,
}

/// Why there is no such linkage.
#[derive(Clone, PartialEq, Debug)]
pub enum NotTowards {
    /// There is no such frame.
    NoChain(NoChain),
    /// The place of the frame is no row.
    NotNamed(NotNamed),
}

impl fmt::Display for NotTowards {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NotTowards::NoChain(why) => why.fmt(f),
            NotTowards::NotNamed(_) => {
                f.write_str("the place of the frame is no row: a number of it has no value")
            }
        }
    }
}

impl From<NoChain> for NotTowards {
    fn from(why: NoChain) -> Self {
        NotTowards::NoChain(why)
    }
}

impl From<NotNamed> for NotTowards {
    fn from(why: NotNamed) -> Self {
        NotTowards::NotNamed(why)
    }
}

fn turned(angle: i64) -> Expr {
    Expr::pi() * Expr::from(Rational::new(angle, 180))
}

/// A row that moves, with what stands before it.
fn mover(gamma: i64, alpha: i64, kind: JointKind, name: Symbol) -> Row {
    let value = Expr::from(name);
    let moved = match kind {
        JointKind::Revolute => Row { theta: value, ..Row::still() },
        JointKind::Prismatic => Row { d: value, ..Row::still() },
    };
    Row {
        gamma: turned(gamma),
        alpha: turned(alpha),
        variable: Some(Variable { symbol: name, kind }),
        ..moved
    }
}

impl Linkage {
    /// The linkage, with the values of its parameters, whose assemblies are the configurations of this one in which a frame is where it
    /// is wanted.
    ///
    /// # Errors
    /// If there is no such frame.
    pub fn towards(&self, tip: Option<&str>, wanted: Wanted) -> Result<Towards, NotTowards> {
        let numbers = self.in_numbers();
        let (tip, way, pose) = numbers.way(tip)?;
        let plane = numbers.plane_of_tip(&way, &pose);
        // The transform along the way with all joints at 0.
        let still = |e: Expr| e.substitute(|s| numbers.kind(s).map(|_| Expr::int(0)));
        let rotation = way.iter().fold(numbers.tree.base.rotation, |r, &j| {
            let row = &numbers.tree.rows[j];
            let still = Row { theta: still(row.theta), d: still(row.d), ..row.clone() };
            let screws = still.screws(Convention::Khalil);
            let all = screws.before.iter().chain([&screws.joint]).chain(&screws.behind);
            all.fold(r, |r, s| (r * Rotation::about(s.axis, s.angle)).map(readable::settled))
        });
        let rest = (rotation * pose.rotation).map(readable::settled);
        let mut linkage = numbers.clone();
        (linkage.modes, linkage.poses) = (vec![], vec![]);
        // The frame of the tip as rows that do not move, for a closure stands on one.
        let on = way.last().copied();
        let right = linkage.tree.fixed(on, &pose)?;
        // What is driven: from the origin of the base, whatever its transform, along the axes of the plane.
        let axes = plane.as_ref().map_or_else(Rotation::identity, |p| p.axes);
        let back = numbers.tree.base.inverse() * Transform::from_rotation_translation(axes, Vector::zero());
        let back = back.map(readable::settled);
        let start = linkage.tree.fixed(None, &back)?;
        let names: Vec<Symbol> = (1..=6).map(|k| Symbol::new(&format!("tip {k}"))).collect();
        let free = Symbol::new("free 1");
        let (r, p) = (JointKind::Revolute, JointKind::Prismatic);
        let x = linkage.tree.push(mover(90, 90, p, names[0]), start);
        let y = linkage.tree.push(mover(-90, -90, p, names[1]), Some(x));
        let end = match (&plane, wanted) {
            (Some(TipPlane { height, .. }), _) => {
                let turn = if wanted == Wanted::Pose { names[2] } else { free };
                let row = Row { d: *height, ..mover(-90, 90, r, turn) };
                linkage.tree.push(row, Some(y))
            }
            (None, _) => {
                let z = linkage.tree.push(mover(-90, 90, p, names[2]), Some(y));
                let turns = match wanted {
                    Wanted::Pose => [names[3], names[4], names[5]],
                    Wanted::Position => [1, 2, 3].map(|k| Symbol::new(&format!("free {k}"))),
                };
                let yaw = linkage.tree.push(mover(0, 0, r, turns[0]), Some(z));
                let pitch = linkage.tree.push(mover(0, -90, r, turns[1]), Some(yaw));
                let roll = linkage.tree.push(mover(-90, -90, r, turns[2]), Some(pitch));
                let square = Row { gamma: turned(90), alpha: turned(90), theta: turned(90), ..Row::still() };
                linkage.tree.push(square, Some(roll))
            }
        };
        let place = match &plane {
            Some(plane) => (plane.axes.inverse() * rest).map(readable::settled),
            None => Rotation::identity(),
        };
        let place = Transform::from_rotation_translation(place, Vector::zero());
        let left = linkage.tree.fixed(Some(end), &place)?;
        let side = |after| Side { after, row: Row::still() };
        linkage.closures.push(Closure {
            name: Some("tip".into()),
            left: side(left),
            right: side(right),
            span: 0..0,
        });
        let places = linkage.numbered(&numbers, &names);
        Ok(Towards { linkage, plane, places, tip, rest, wanted })
    }

    /// The plane in which the linkage moves, if all axes that turn are parallel, and all that slide across them, exactly: that of x and y
    /// of the base where they are along its z.
    fn plane_of_tip(&self, way: &[usize], pose: &Transform<Expr>) -> Option<TipPlane> {
        let mut frames: Vec<Transform<Expr>> = vec![];
        let mut axes: Option<Rotation<Expr>> = None;
        let is_zero = |e: Expr| equal(e, Expr::int(0)).is_equal();
        let is_along = |v: Vector<Expr>| is_zero(v[0]) && is_zero(v[1]);
        let mut slides: Vec<Vector<Expr>> = vec![];
        let mut fits = |x: &Transform<Expr>, kind: JointKind| {
            let z = x.rotation.z();
            if kind == JointKind::Prismatic {
                slides.push(z);
                return true;
            }
            // The first axis that turns says which plane it is.
            let own = || if is_along(z) { Rotation::identity() } else { x.rotation };
            let across = axes.get_or_insert_with(own).inverse() * z;
            is_along(across.map(readable::settled))
        };
        // With all joints at 0; the axes of what turns stay where they are, and those of slides stay across.
        let still = |row: &Row| {
            let at_rest = |e: Expr| e.substitute(|s| self.kind(s).map(|_| Expr::int(0)));
            let screws = Row { theta: at_rest(row.theta), d: at_rest(row.d), ..row.clone() };
            let screws = screws.screws(Convention::Khalil);
            let all = screws.before.iter().chain([&screws.joint]).chain(&screws.behind);
            all.map(|s| s.transform()).fold(Transform::identity(), |x, y| x * y).map(readable::settled)
        };
        let all = self.tree.rows.iter().zip(&self.tree.after);
        for (row, on) in all {
            let before = on.map_or(self.tree.base, |j| frames[j]);
            let frame = (before * still(row)).map(readable::settled);
            let moves = row.variable.map(|v| v.kind);
            let follows = [(row.theta, JointKind::Revolute), (row.d, JointKind::Prismatic)]
                .into_iter()
                .filter(|(e, _)| e.symbols().into_iter().any(|s| self.kind(s).is_some()))
                .map(|f| f.1);
            if !moves.into_iter().chain(follows).all(|kind| fits(&frame, kind)) {
                return None;
            }
            frames.push(frame);
        }
        for side in self.closures.iter().flat_map(|c| [&c.left, &c.right]) {
            let before = side.after.map_or(self.tree.base, |j| frames[j]);
            let kind = side.row.variable.map(|v| v.kind);
            if kind.is_some_and(|kind| !fits(&(before * still(&side.row)).map(readable::settled), kind)) {
                return None;
            }
        }
        let axes = axes.unwrap_or_else(Rotation::identity);
        let across = |v: &Vector<Expr>| is_zero(readable::settled(axes.z().dot(*v)));
        if !slides.iter().all(across) {
            return None;
        }
        let last = way.last().map_or(self.tree.base, |&j| frames[j]);
        let height = readable::settled(axes.z().dot((last * *pose).translation));
        Some(TipPlane { axes, height })
    }

    /// Numbers the joints, those with these names as driven, all others as passive; the places of the driven and of the passive joints of
    /// another linkage, which are in this one, among the passive ones.
    fn numbered(&mut self, of: &Linkage, driven: &[Symbol]) -> [Vec<usize>; 2] {
        let mut passive: Vec<Symbol> = vec![];
        let mut names: Vec<(Symbol, Symbol)> = vec![];
        for v in self.variables() {
            let new = match driven.iter().position(|d| *d == v.symbol) {
                Some(k) => format!("q{}", k + 1),
                None => {
                    passive.push(v.symbol);
                    format!("p{}", passive.len())
                }
            };
            names.push((v.symbol, Symbol::new(&new)));
        }
        let new = |s: Symbol| names.iter().find(|n| n.0 == s).map(|n| n.1);
        let closures = self.closures.iter_mut().flat_map(|c| [&mut c.left.row, &mut c.right.row]);
        for row in self.tree.rows.iter_mut().chain(closures) {
            for cell in [&mut row.theta, &mut row.d] {
                *cell = cell.substitute(|s| new(s).map(Expr::from));
            }
            if let Some(v) = &mut row.variable {
                v.symbol = new(v.symbol).unwrap_or(v.symbol);
            }
        }
        let place = |v: Variable| passive.iter().position(|&p| p == v.symbol).unwrap_or(0);
        [of.driven(), of.passive()].map(|all| all.into_iter().map(place).collect())
    }
}

impl RowTree {
    fn push(&mut self, row: Row, after: Option<usize>) -> usize {
        self.rows.push(row);
        self.after.push(after);
        self.rows.len() - 1
    }

    /// Rows that do not move, for a transform: the last of them.
    fn fixed(&mut self, mut on: Option<usize>, x: &Transform<Expr>) -> Result<Option<usize>, NotNamed> {
        if *x != Transform::identity() {
            for row in fixed_rows(x, &[])? {
                on = Some(self.push(row, on));
            }
        }
        Ok(on)
    }
}

/// Directions that are nearer are the same.
const ALONG: f64 = 1e-9;

impl Towards {
    /// The driven joints for a pose of the tip: x, y and where it is asked for the turn of the plane; in space x, y, z, and the angles yaw,
    /// pitch and roll. Nothing for what is not in the plane.
    pub fn driven(&self, pose: &Transform<f64>) -> Option<Vec<f64>> {
        let number = |e: Expr| e.eval(|_| None).unwrap_or(f64::NAN);
        let p = pose.translation;
        if let Some(TipPlane { axes, height }) = &self.plane {
            let back = axes.map(number).inverse();
            let p = back * p;
            let size = p.norm().max(1.0);
            if (p[2] - number(*height)).abs() > ALONG * size {
                return None;
            }
            if self.wanted == Wanted::Position {
                return Some(vec![p[0], p[1]]);
            }
            let turn = back * pose.rotation * (back * self.rest.map(number)).inverse();
            let z = turn.z();
            if z[0].hypot(z[1]) > ALONG || z[2] < 0.0 {
                return None;
            }
            let x = turn.column(Axis::X);
            return Some(vec![p[0], p[1], x[1].atan2(x[0])]);
        }
        let mut all = vec![p[0], p[1], p[2]];
        if self.wanted == Wanted::Pose {
            // R = Rz(yaw) Ry(pitch) Rx(roll)
            let r = pose.rotation.rows();
            let pitch = (-r[2][0]).atan2(r[0][0].hypot(r[1][0]));
            let yaw = r[1][0].atan2(r[0][0]);
            let (s, c) = yaw.sin_cos();
            let roll = (s * r[0][2] - c * r[1][2]).atan2(c * r[1][1] - s * r[0][1]);
            all.extend([yaw, pitch, roll]);
        }
        Some(all)
    }
}
