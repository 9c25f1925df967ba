//! The order in which the cells of a row are multiplied: the one place that knows it.

use super::{Convention, Description, Row};
use crate::geometry::{Axis, Transform};
use crate::scalar::Scalar;
use denavit_symbolic::Expr;

/// A cell of a row: a rotation about or a translation along an axis.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Cell {
    /// γ, about the z of the frame before.
    Gamma,
    /// b, along the z of the frame before.
    B,
    /// α, about x.
    Alpha,
    /// a (Khalil's d), along x.
    A,
    /// θ, about z.
    Theta,
    /// d (Khalil's r), along z.
    D,
}

/// Rotation about and translation along one axis, which commute.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Screw {
    /// The axis.
    pub axis: Axis,
    /// Radians.
    pub angle: Expr,
    /// Metres.
    pub length: Expr,
}

/// The screws of a row, in order.
#[derive(Clone, PartialEq, Debug)]
pub struct Screws {
    /// The constant ones before the joint's.
    pub before: Vec<Screw>,
    /// The joint's own: θ and d.
    pub joint: Screw,
    /// The constant ones behind it.
    pub behind: Vec<Screw>,
}

impl Cell {
    /// The axis that it turns about or slides along.
    pub fn axis(self) -> Axis {
        match self {
            Cell::Alpha | Cell::A => Axis::X,
            Cell::Gamma | Cell::B | Cell::Theta | Cell::D => Axis::Z,
        }
    }

    /// True for an angle, false for a length.
    pub fn turns(self) -> bool {
        matches!(self, Cell::Gamma | Cell::Alpha | Cell::Theta)
    }

    /// True if only branches need it.
    pub fn is_of_branch(self) -> bool {
        matches!(self, Cell::Gamma | Cell::B)
    }

    /// Its key in a convention: `theta`, `alpha`, `a`.
    pub fn key(self, convention: Convention) -> &'static str {
        match self {
            Cell::Gamma => "gamma",
            Cell::B => "b",
            Cell::Alpha => "alpha",
            Cell::A => convention.length_x(),
            Cell::Theta => "theta",
            Cell::D => convention.length_z(),
        }
    }

    /// What it is called in a convention, in print: θ, α, a.
    pub fn letter(self, convention: Convention) -> &'static str {
        match self {
            Cell::Gamma => "γ",
            Cell::Alpha => "α",
            Cell::Theta => "θ",
            Cell::B | Cell::A | Cell::D => self.key(convention),
        }
    }

    /// What stands in it.
    pub fn of(self, row: &Row) -> Expr {
        match self {
            Cell::Gamma => row.gamma,
            Cell::B => row.b,
            Cell::Alpha => row.alpha,
            Cell::A => row.a,
            Cell::Theta => row.theta,
            Cell::D => row.d,
        }
    }

    /// What it multiplies, with a value.
    pub fn transform<T: Scalar>(self, value: T) -> Transform<T> {
        match (self.axis(), self.turns()) {
            (axis, true) => Transform::rotation_about(axis, value),
            (Axis::X, false) => Transform::translation_x(value),
            (Axis::Y, false) => Transform::translation_y(value),
            (Axis::Z, false) => Transform::translation_z(value),
        }
    }
}

impl Convention {
    /// The cells of a row in the order of the product, which is that of the table's columns. Those of one axis stand next
    /// to each other and commute.
    pub fn order(self) -> &'static [Cell] {
        use Cell::{A, Alpha, B, D, Gamma, Theta};
        match self {
            Convention::Standard => &[Theta, D, A, Alpha],
            Convention::Craig => &[Alpha, A, Theta, D],
            Convention::Khalil => &[Gamma, B, Alpha, A, Theta, D],
        }
    }

    /// True if a row begins with its joint's screw, so that its axis is the z of the frame before; in the other conventions
    /// it is the z of the row's own frame.
    pub fn begins_with_joint(self) -> bool {
        self.order()[0] == Cell::Theta
    }

    /// The frame whose z is the axis of θ and d of a row (from 0): the one before the row, or the row's own.
    pub fn axis_frame(self, row: usize) -> usize {
        if self.begins_with_joint() { row } else { row + 1 }
    }
}

impl Description {
    /// The columns of its table in order: those of branches only if a row has one.
    pub fn columns(&self) -> Vec<Cell> {
        let has_branches = self.rows.iter().any(Row::is_branch);
        let cells = self.convention.order().iter().copied();
        cells.filter(|c| has_branches || !c.is_of_branch()).collect()
    }
}

impl Row {
    /// True if it begins with a turn about or a slide along the z of the frame before.
    pub fn is_branch(&self) -> bool {
        !self.gamma.is_zero() || !self.b.is_zero()
    }

    /// What the row multiplies.
    pub fn screws(&self, convention: Convention) -> Screws {
        let cell = |axis: &[Cell], turns: bool| {
            axis.iter().find(|c| c.turns() == turns).map_or(Expr::int(0), |c| c.of(self))
        };
        let screw = |axis: &[Cell]| Screw {
            axis: axis[0].axis(),
            angle: cell(axis, true),
            length: cell(axis, false),
        };
        let axes: Vec<&[Cell]> = convention.order().chunks(2).collect();
        let joint = axes.iter().position(|a| a.contains(&Cell::Theta)).unwrap_or_default();
        let all = |axes: &[&[Cell]]| axes.iter().map(|a| screw(a)).collect();
        Screws { before: all(&axes[..joint]), joint: screw(axes[joint]), behind: all(&axes[joint + 1..]) }
    }
}

impl Screw {
    /// True if it moves nothing.
    pub fn is_identity(&self) -> bool {
        self.angle.is_zero() && self.length.is_zero()
    }

    /// As a transform.
    pub fn transform(&self) -> Transform<Expr> {
        let shift = match self.axis {
            Axis::X => Transform::translation_x(self.length),
            Axis::Y => Transform::translation_y(self.length),
            Axis::Z => Transform::translation_z(self.length),
        };
        Transform::rotation_about(self.axis, self.angle) * shift
    }
}

impl IntoIterator for Screws {
    type Item = Screw;
    type IntoIter = std::vec::IntoIter<Screw>;
    fn into_iter(self) -> Self::IntoIter {
        let mut all = self.before;
        all.push(self.joint);
        all.extend(self.behind);
        all.into_iter()
    }
}
