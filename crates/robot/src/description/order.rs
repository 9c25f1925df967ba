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

    /// The frame whose z is the axis of θ and d of a row (from 0): the one before the row, or the row's own.
    pub fn axis_frame(self, row: usize) -> usize {
        if self.order()[0] == Cell::Theta { row } else { row + 1 }
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

    /// The row as the screws about its axes, in order, and which of them is θ, d.
    pub fn screws(&self, convention: Convention) -> (Vec<Screw>, usize) {
        let order = convention.order();
        let value = |axis: &[Cell], turns: bool| {
            axis.iter().find(|c| c.turns() == turns).map_or(Expr::int(0), |c| c.of(self))
        };
        let screw = |axis: &[Cell]| Screw {
            axis: axis[0].axis(),
            angle: value(axis, true),
            length: value(axis, false),
        };
        let moving = order.iter().position(|c| *c == Cell::Theta).map_or(0, |k| k / 2);
        (order.chunks(2).map(screw).collect(), moving)
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
