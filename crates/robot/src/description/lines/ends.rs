//! Base and tool as rows: a rigid transform is `Rz·Tz·Tx·Rx` and a motion about and along z behind it, so that a table alone can say
//! where its base and its tool are.

use super::space::{Frame, Pose, V, cleaned, dot, minus, scaled, unit};
use super::{AxisAtRest, ChainAtRest, NotNamed};
use crate::description::{Convention, Description, JointKind, Parameter, Row, Screw};
use crate::geometry::{Axis, Transform, Vector};
use denavit_symbolic::real::Values;
use denavit_symbolic::{Angle, Expr, Rational, Symbol};

/// A transform as motions about and along z and x in turn: the first and the last are those of z.
pub(in crate::description) struct Turns {
    pub z: Vec<Screw>,
    pub x: Vec<Screw>,
}

fn screw(axis: Axis, angle: Expr, length: Expr) -> Screw {
    Screw { axis, angle, length }
}

fn sum(a: Expr, b: Expr) -> Expr {
    Angle::of(a + b).to_expr()
}

impl Turns {
    /// The common normal from the one z to the other, as between two axes.
    pub fn of(x: &Transform<Expr>, parameters: &[Parameter]) -> Result<Self, NotNamed> {
        let axis = |k: usize, point, direction| AxisAtRest {
            kind: JointKind::Revolute,
            point,
            direction,
            moves: vec![(k, Rational::ONE)],
        };
        let base = axis(0, Vector::zero(), Vector::unit(Axis::Z));
        let chain = ChainAtRest {
            axes: vec![base, axis(1, x.translation, x.rotation.z())],
            tip: *x,
            beside: x.rotation,
        };
        let is_named = || chain.symbols().iter().any(|s| parameters.iter().any(|p| p.symbol == *s));
        let (rows, tool) = if parameters.is_empty() || !is_named() {
            let placed = chain.rows()?;
            (placed.rows, placed.tool)
        } else {
            let d = chain.named_description("", Convention::Standard, parameters)?.description;
            (d.rows, d.tool)
        };
        let variables: Vec<Symbol> = rows.iter().filter_map(|r| Some(r.variable?.symbol)).collect();
        let still =
            |e: Expr| Angle::of(e.substitute(|s| variables.contains(&s).then(|| Expr::int(0)))).to_expr();
        let mut turns = Turns { z: vec![], x: vec![] };
        for row in &rows {
            turns.z.push(screw(Axis::Z, still(row.theta), still(row.d)));
            turns.x.push(screw(Axis::X, row.alpha, row.a));
        }
        // The last row turns about the other z, and what is left is a turn about it.
        turns.x.pop();
        let mut values = Values::default();
        let m = tool.rotation;
        if let (Some(last), Some(s), Some(c)) =
            (turns.z.last_mut(), values.of(m[(1, 0)]), values.of(m[(0, 0)]))
        {
            last.angle = sum(last.angle, s.angle(&c));
        }
        turns.settle();
        Ok(turns)
    }

    /// Leaves normals out that are none, and moves lengths forward along parallel axes.
    fn settle(&mut self) {
        for k in (0..self.x.len()).rev() {
            if self.x[k].is_identity() {
                let behind = self.z.remove(k + 1);
                self.x.remove(k);
                self.z[k].angle = sum(self.z[k].angle, behind.angle);
                self.z[k].length = sum(self.z[k].length, behind.length);
            } else if self.x[k].angle.is_zero() {
                let length = std::mem::replace(&mut self.z[k + 1].length, Expr::int(0));
                self.z[k].length = sum(self.z[k].length, length);
            }
        }
    }
}

/// A constant transform with its numbers in their shortest form; as it is where it has names.
pub(in crate::description) fn settled(x: &Transform<Expr>) -> Transform<Expr> {
    Frame::of(x, &mut Values::default()).map_or(*x, |f| f.settled())
}

/// A frame in the place of another, its z along an axis that is given there; nothing if that has no direction.
pub(in crate::description) fn frame_on(at: &Pose, axis: Vector<Expr>, values: &mut Values) -> Option<Pose> {
    let [a, b, c] = axis.0.map(|e| values.of(e));
    let z = unit(&cleaned(at.turned(&[a?, b?, c?])))?.0;
    // The axis of the frame that is the farthest from z, made perpendicular to it.
    let along = |v: &V| dot(v, &z).to_f64().abs();
    let x = at.axes().iter().min_by(|a, b| along(a).total_cmp(&along(b)))?;
    let x = unit(&minus(x, &scaled(&z, &dot(x, &z))))?.0;
    Some(Pose::with_axes(x, z, at.origin().clone()))
}

fn fixed(z: Screw, x: Screw) -> Row {
    Row { theta: z.angle, d: z.length, alpha: x.angle, a: x.length, ..Row::still() }
}

impl Row {
    fn turn_behind(&mut self, z: &Screw) {
        (self.theta, self.d) = (sum(self.theta, z.angle), sum(self.d, z.length));
    }
}

impl Description {
    /// The same robot with base and tool as rows without joint, where its own rows cannot take them; rows that are there keep their
    /// joints, names and limits.
    ///
    /// # Errors
    /// If base or tool have names on which more than lengths depend, without values.
    pub fn with_ends_in_rows(&self) -> Result<Description, NotNamed> {
        let mut d = self.clone();
        d.base_into_rows()?;
        d.tool_into_rows()?;
        Ok(d)
    }

    fn base_into_rows(&mut self) -> Result<(), NotNamed> {
        if self.base == Transform::identity() || self.rows.is_empty() {
            return Ok(());
        }
        let nothing = screw(Axis::X, Expr::int(0), Expr::int(0));
        if self.convention.begins_with_joint() {
            let turns = Turns::of(&self.base, &self.parameters)?;
            let last = turns.x.len();
            self.rows[0].turn_behind(&turns.z[last]);
            self.rows.splice(0..0, turns.z.iter().zip(&turns.x).map(|(z, x)| fixed(*z, *x)));
        } else {
            let before = self.rows[0].screws(self.convention).before;
            let before = before.iter().fold(self.base, |x, s| x * s.transform());
            let turns = Turns::of(&before, &self.parameters)?;
            let first = &mut self.rows[0];
            let last = turns.x.len();
            let x = if last == 0 { nothing } else { turns.x[last - 1] };
            (first.alpha, first.a, first.gamma, first.b) = (x.angle, x.length, Expr::int(0), Expr::int(0));
            let mut rows: Vec<Row> = vec![];
            if last == 0 {
                first.turn_behind(&turns.z[0]);
            } else {
                first.turn_behind(&turns.z[last]);
                rows.extend((1..last).map(|k| fixed(turns.z[k], turns.x[k - 1])));
                if self.convention == Convention::Khalil {
                    let branch = rows.first_mut().unwrap_or(first);
                    (branch.gamma, branch.b) = (turns.z[0].angle, turns.z[0].length);
                } else if !turns.z[0].is_identity() {
                    rows.insert(0, fixed(turns.z[0], nothing));
                }
            }
            self.rows.splice(0..0, rows);
        }
        self.base = Transform::identity();
        Ok(())
    }

    fn tool_into_rows(&mut self) -> Result<(), NotNamed> {
        if self.tool == Transform::identity() || self.rows.is_empty() {
            return Ok(());
        }
        let nothing = screw(Axis::X, Expr::int(0), Expr::int(0));
        let turns = Turns::of(&self.tool, &self.parameters)?;
        let last = turns.x.len();
        if self.convention.begins_with_joint() {
            self.rows.extend(turns.z.iter().zip(&turns.x).map(|(z, x)| fixed(*z, *x)));
            if !turns.z[last].is_identity() {
                self.rows.push(fixed(turns.z[last], nothing));
            }
        } else {
            let mut rows: Vec<Row> = (0..last).map(|k| fixed(turns.z[k + 1], turns.x[k])).collect();
            let z = turns.z[0];
            let end = self.rows.last_mut().filter(|r| r.body().is_none());
            let branch = rows.first_mut().filter(|_| self.convention == Convention::Khalil);
            match (end, branch) {
                (Some(end), _) => end.turn_behind(&z),
                (None, Some(branch)) => (branch.gamma, branch.b) = (z.angle, z.length),
                (None, None) if z.is_identity() => {}
                (None, None) => rows.insert(0, fixed(z, nothing)),
            }
            self.rows.extend(rows);
        }
        self.tool = Transform::identity();
        Ok(())
    }
}
