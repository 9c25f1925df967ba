//! Planar loops: all axes that turn are parallel, all that slide perpendicular to them, exactly.
//!
//! In the plane of a loop every row is a turn by ±θ and a vector, and the closure is one sum of angles and one complex equation. What
//! stands along the axes must cancel identically.

use super::Linkage;
use crate::description::{Convention, Row};
use crate::geometry::parallel::{flip, parallel, reversed};
use crate::geometry::{Axis, Rotation, Transform, Vector};
use denavit_symbolic::{Angle, Expr, Symbol, equal, readable};

/// A vector of the plane, `(x + iy)·e(angle)` with `e(φ) = cos φ + i sin φ`.
#[derive(Clone, Debug)]
pub struct Term {
    /// Along the direction; affine in the variables of slides.
    pub x: Expr,
    /// To the left of it.
    pub y: Expr,
    /// The direction; affine in the variables of joints that turn.
    pub angle: Angle,
}

/// A loop in its plane: the sum of the terms is 0, and so is the turn, up to whole turns.
#[derive(Clone, Debug)]
pub struct Planar {
    /// The vectors around the loop.
    pub terms: Vec<Term>,
    /// The sum of the angles around it.
    pub turn: Angle,
}

/// Why a loop is not planar.
#[derive(Clone, Debug)]
pub enum Fault {
    /// No joint of it turns.
    NothingTurns,
    /// The axis of this row is neither parallel nor perpendicular to those before as it would have to be.
    Axis {
        /// The row's name, if it has one.
        row: Option<String>,
    },
    /// All axes are parallel, but the two frames of the closure are turned out of the plane against each other.
    Tilted,
    /// All axes are parallel, but the two sides end this far apart along them.
    Offset(Expr),
}

/// A place in the plane of a loop, walked to from its beginning.
struct Walker {
    /// The rotation there is Rz(angle)·since, z being the normal of the plane.
    angle: Expr,
    since: Rotation<Expr>,
    terms: Vec<Term>,
    height: Expr,
}

impl Walker {
    fn new(since: Rotation<Expr>) -> Self {
        Walker { angle: Expr::int(0), since, terms: vec![], height: Expr::int(0) }
    }

    fn shift(&mut self, v: Vector<Expr>) {
        let v = self.since * v;
        if !(v[0].is_zero() && v[1].is_zero()) {
            self.terms.push(Term { x: v[0], y: v[1], angle: Angle::of(self.angle) });
        }
        self.height = self.height + v[2];
    }

    fn turn(&mut self, axis: Axis, angle: Expr) {
        if !angle.is_zero() {
            self.since = (self.since * Rotation::about(axis, angle)).map(readable::settled);
        }
    }

    /// What is constant before the joint of a row.
    fn before(&mut self, row: &Row) {
        for screw in row.screws(Convention::Khalil).before {
            self.turn(screw.axis, screw.angle);
            let mut v = [Expr::int(0); 3];
            v[screw.axis.index()] = screw.length;
            self.shift(Vector(v));
        }
    }

    /// A row whose angle and length move with these variables.
    fn row(&mut self, row: &Row, variables: &[Symbol]) -> Result<(), Fault> {
        let fault = || Fault::Axis { row: row.name.clone() };
        let moves = |e: Expr| e.symbols().iter().any(|s| variables.contains(s));
        self.before(row);
        if moves(row.theta) {
            let (angle, is_flipped) = turn_of(&self.since).ok_or_else(fault)?;
            let theta = if is_flipped { -row.theta } else { row.theta };
            self.angle = Angle::of(self.angle + angle + theta).to_expr();
            self.since = flip(is_flipped);
        } else {
            self.turn(Axis::Z, row.theta);
        }
        if moves(row.d) && !self.since.z()[2].is_zero() {
            return Err(fault());
        }
        self.shift(Vector([Expr::int(0), Expr::int(0), row.d]));
        Ok(())
    }
}

/// The angle of a turn about z, up to a turn of z round.
fn turn_of(r: &Rotation<Expr>) -> Option<(Expr, bool)> {
    parallel(r).or_else(|| {
        let x = r.x();
        Some((x[1].atan2(x[0]), reversed(r)?))
    })
}

impl Planar {
    /// A loop in its plane, if it is planar.
    ///
    /// # Errors
    /// Why it is not.
    pub fn of(linkage: &Linkage, closure: usize) -> Result<Self, Fault> {
        let variables: Vec<Symbol> = linkage.variables().map(|v| v.symbol).collect();
        let sides = linkage.sides(closure);
        let turns = |row: &&Row| row.theta.symbols().iter().any(|s| variables.contains(s));
        let first = sides.iter().find_map(|side| Some(&side[..=side.iter().position(turns)?]));
        let way = first.ok_or(Fault::NothingTurns)?;
        // The frame in which the loop begins, seen from that of the first axis that turns.
        let mut to_first = Walker::new(Rotation::identity());
        for (k, row) in way.iter().enumerate() {
            to_first.before(row);
            if k + 1 < way.len() {
                to_first.turn(Axis::Z, row.theta);
            }
        }
        let begin = to_first.since.inverse();
        let walked = |side: &[&Row]| {
            let mut walker = Walker::new(begin);
            side.iter().try_for_each(|row| walker.row(row, &variables)).map(|()| walker)
        };
        let (left, right) = (walked(&sides[0])?, walked(&sides[1])?);
        let between = (left.since * right.since.inverse()).map(readable::settled);
        let Some((rest, false)) = turn_of(&between) else { return Err(Fault::Tilted) };
        let offset = readable::settled(left.height - right.height);
        if !equal(offset, Expr::int(0)).is_equal() {
            return Err(Fault::Offset(offset));
        }
        let back = right.terms.into_iter().map(|t| Term { x: -t.x, y: -t.y, ..t });
        let terms = left.terms.into_iter().chain(back).collect();
        Ok(Planar { terms, turn: Angle::of(left.angle - right.angle + rest) })
    }
}

impl Linkage {
    /// Both frames of a closure, seen from the last one that its sides have in common.
    pub fn ends(&self, closure: usize) -> [Transform<Expr>; 2] {
        let pose = |side: &Vec<&Row>| {
            let screws = side.iter().flat_map(|row| row.screws(Convention::Khalil));
            screws.fold(Transform::identity(), |x, screw| x * screw.transform())
        };
        self.sides(closure).each_ref().map(pose)
    }
}
