//! From axes at rest to rows: the Denavit–Hartenberg table of a chain that is given by its axes.
//!
//! With all joint variables 0 each axis is a line, a sliding one a direction. Between neighbours stands their common normal,
//! and base, axes, normals and tip are one sequence of screws `B Z₁ X₁ Z₂ X₂ … Zₙ E`, of which the conventions are cuts
//! ([`convert`](super::convert)). The frames: z along the axes as they are given, so that every variable enters with its own
//! sign; x along the normals, turned so that the table is the plainest (`signs`); where axes are parallel, through the origin
//! before. Axes that are nearly parallel have a normal far away, and a fixed row more instead (Hayati and Mirmirani 1985).

mod ends;
mod place;
mod screws;
mod signs;
mod space;
mod symbols;

pub(super) use ends::{Turns, frame_on, settled};
pub use screws::{Agreement, compare_screws, same_screws};
pub(super) use space::{Alike, Pose};
pub use symbols::{Named, NotNamed};

use super::{Convention, Description, JointKind, Row, Variable};
use crate::geometry::{Rotation, Transform, Vector};
use denavit_symbolic::real::{Real, Values};
use denavit_symbolic::{Angle, Expr, Rational, Symbol};
use space::{Frame, V};

/// An axis with all joint variables 0, in the base.
#[derive(Clone, Debug)]
pub struct AxisAtRest {
    /// Whether it turns or slides.
    pub kind: JointKind,
    /// A point of it, metres.
    pub point: Vector<Expr>,
    /// Its direction, of any length.
    pub direction: Vector<Expr>,
    /// The joint variables that move it, from 0, and radians or metres for a unit of each; at most one of them is new, and is the
    /// next.
    pub moves: Vec<(usize, Rational)>,
}

/// A chain by its axes at rest.
#[derive(Clone, Debug)]
pub struct ChainAtRest {
    /// The axes in order.
    pub axes: Vec<AxisAtRest>,
    /// The tip at rest, in the base.
    pub tip: Transform<Expr>,
    /// Directions that x of frame 0 may take where none of the base's axes is perpendicular to the first axis, such as those of
    /// its joint's own frame.
    pub beside: Rotation<Expr>,
}

/// The rows of a chain in the standard convention.
#[derive(Clone, Debug)]
pub struct Placed {
    /// Frame 0 in the base.
    pub base: Transform<Expr>,
    /// The rows.
    pub rows: Vec<Row>,
    /// The axis of each row, from 0; the fixed row between axes that are nearly parallel has none.
    pub axes: Vec<Option<usize>>,
    /// The tip in the last frame.
    pub tool: Transform<Expr>,
}

/// Why a chain has no rows.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum NotPlaced {
    /// A number of it stands as a symbol without value.
    Symbols,
    /// The direction of this axis, from 0, has no length.
    NoDirection(usize),
}

/// An axis in numbers.
#[derive(Clone, Debug)]
struct Line {
    kind: JointKind,
    /// Nothing where a slide goes through the origin before it.
    point: Option<V>,
    direction: V,
}

/// A row under way: `Rz(theta)·Tz(d)·Tx(a)·Rx(alpha)`.
#[derive(Clone, Debug)]
struct Draft {
    theta: Expr,
    d: Expr,
    a: Expr,
    alpha: Expr,
    /// The axis that moves it.
    motion: Option<usize>,
    /// True if its x is that of the row before, so that it turns round with it.
    is_free: bool,
}

impl ChainAtRest {
    /// The rows of the chain, in the standard convention.
    ///
    /// # Errors
    /// If the chain has symbols for numbers, or an axis without direction.
    pub fn rows(&self) -> Result<Placed, NotPlaced> {
        let mut values = Values::default();
        let lines = place::relocated(&self.lines(&mut values)?);
        let tip = Frame::of(&self.tip, &mut values).ok_or(NotPlaced::Symbols)?;
        let beside = Transform::from_rotation_translation(self.beside, Vector::zero());
        let beside = Frame::of(&beside, &mut values).ok_or(NotPlaced::Symbols)?;
        let start = place::first_frame(&lines, &beside);
        let (mut drafts, mut end) = place::drafts(&lines, &start, &tip);
        signs::choose(&mut drafts);
        // Where the tip is seen from is a frame of the rows as they are written.
        let turned = screws::end_of(&start, &drafts, &mut values);
        end = turned.unwrap_or(end);
        let rows = drafts.iter().map(|d| self.row(d)).collect();
        Ok(Placed {
            base: start.settled(),
            rows,
            axes: drafts.iter().map(|d| d.motion).collect(),
            tool: end.seen(&tip).settled(),
        })
    }

    /// The chain as a description in a convention, its variables q1, q2, …, and how it was proved to be the chain.
    ///
    /// # Errors
    /// If the chain has symbols for numbers, or an axis without direction.
    pub fn description(
        &self,
        name: &str,
        convention: Convention,
    ) -> Result<(Description, Agreement), NotPlaced> {
        let Placed { base, rows, tool, .. } = self.rows()?;
        let standard = Description {
            name: name.into(),
            source: None,
            convention: Convention::Standard,
            parameters: vec![],
            rows,
            base,
            tool,
            poses: vec![],
            gravity: None,
        };
        let mut description = standard.converted(convention).description;
        description.take_base_into_rows();
        let agreement = screws::agreement(self, &description)?;
        Ok((description, agreement))
    }

    /// The chain seen from its tip: base and tip exchanged, the axes in the other order and, since what moved the tip now moves the
    /// base, turned round; its first variable is the last.
    #[must_use]
    pub fn reversed(&self) -> ChainAtRest {
        let from_tip = self.tip.inverse();
        let mut numbers: Vec<usize> = vec![];
        let mut axes = vec![];
        for axis in self.axes.iter().rev() {
            let mut moves = vec![];
            for (v, factor) in &axis.moves {
                let known = numbers.iter().position(|n| n == v);
                let number = known.unwrap_or(numbers.len());
                if known.is_none() {
                    numbers.push(*v);
                }
                moves.push((number, factor.clone()));
            }
            let (point, direction) =
                (from_tip.act_on_point(axis.point), -from_tip.act_on_vector(axis.direction));
            axes.push(AxisAtRest { kind: axis.kind, point, direction, moves });
        }
        ChainAtRest { axes, tip: from_tip, beside: from_tip.rotation * self.beside }
    }

    fn lines(&self, values: &mut Values) -> Result<Vec<Line>, NotPlaced> {
        let mut three = |v: &Vector<Expr>| -> Option<V> {
            let [a, b, c] = v.0.map(|e| values.of(e));
            Some(space::cleaned([a?, b?, c?]))
        };
        let mut lines = vec![];
        for (k, axis) in self.axes.iter().enumerate() {
            let point = three(&axis.point).ok_or(NotPlaced::Symbols)?;
            let direction = three(&axis.direction).ok_or(NotPlaced::Symbols)?;
            let length = space::dot(&direction, &direction);
            // What is of length 1 but for rounding is left as it is.
            let is_unit = (length - Real::from(1)).is_zero();
            let unit = if is_unit { Some(direction) } else { space::unit(&direction).map(|u| u.0) };
            let direction = unit.ok_or(NotPlaced::NoDirection(k))?;
            lines.push(Line { kind: axis.kind, point: Some(point), direction: space::cleaned(direction) });
        }
        Ok(lines)
    }

    fn row(&self, draft: &Draft) -> Row {
        let (mut theta, mut d, mut variable) = (draft.theta, draft.d, None);
        if let Some(k) = draft.motion {
            let axis = &self.axes[k];
            let symbol = |v: usize| Symbol::new(&format!("q{}", v + 1));
            let moved = axis.moves.iter().fold(Expr::int(0), |sum, (v, factor)| {
                sum + Expr::from(factor.clone()) * Expr::from(symbol(*v))
            });
            match axis.kind {
                JointKind::Revolute => theta = Angle::of(moved + theta).to_expr(),
                JointKind::Prismatic => d = Angle::of(moved + d).to_expr(),
            }
            let is_known = |v: usize| self.axes[..k].iter().any(|a| a.moves.iter().any(|m| m.0 == v));
            let own = axis.moves.iter().map(|m| m.0).find(|&v| !is_known(v));
            variable = own.map(|v| Variable { symbol: symbol(v), kind: axis.kind });
        }
        Row { theta, d, a: draft.a, alpha: draft.alpha, variable, ..Row::still() }
    }
}

impl Description {
    /// In Craig's and Khalil's conventions the first row has a place for a base `Rx(α)·Tx(a)·Tz(d)`.
    fn take_base_into_rows(&mut self) {
        let Some(row) = self.rows.first_mut() else { return };
        let (r, p) = (self.base.rotation, self.base.translation);
        let x = r.x();
        let is_free = row.alpha.is_zero() && row.a.is_zero() && !row.is_branch();
        if self.convention.begins_with_joint() || !is_free || !x[0].is_one() {
            return;
        }
        // Tx(a)·Rx(α)·Tz(d) stands at (a, −d sin α, d cos α).
        let mut values = Values::default();
        let mut all = || {
            let (s, c) = (values.of(r[(2, 1)])?, values.of(r[(1, 1)])?);
            let (y, z) = (values.of(p[1])?, values.of(p[2])?);
            let across = y.clone() * c.clone() + z.clone() * s.clone();
            let along = z * c.clone() - y * s.clone();
            across.is_zero().then(|| (s.angle(&c), along.settled()))
        };
        let Some((alpha, along)) = all() else { return };
        if (alpha.sin(), alpha.cos()) != (r[(2, 1)], r[(1, 1)]) {
            return;
        }
        (row.alpha, row.a) = (alpha, p[0]);
        row.d = Angle::of(row.d + along).to_expr();
        self.base = Transform::identity();
    }
}
