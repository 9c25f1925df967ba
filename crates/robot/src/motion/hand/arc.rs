//! Arcs of circles.

use super::{HandPath, Stretch, turn};
use crate::geometry::{Rotation, Transform, Vector};
use std::fmt;

/// From a pose to a pose on the circle through a third point; the orientation by the shorter turn, at a constant rate.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Arc {
    from: Transform<f64>,
    to: Transform<f64>,
    centre: Vector<f64>,
    /// The normal of the circle's plane times the angle of the arc.
    turned: Vector<f64>,
}

/// Three points give no arc.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ArcError {
    /// Two of them are one.
    SamePoint,
    /// They lie on a line.
    Straight,
}

impl fmt::Display for ArcError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            ArcError::SamePoint => "two of the three points of the arc are one",
            ArcError::Straight => "the three points of the arc lie on a line",
        })
    }
}

impl std::error::Error for ArcError {}

impl Arc {
    /// From a pose through a point to a pose.
    ///
    /// # Errors
    /// If the three points lie on a line, or two are one.
    pub fn new(from: Transform<f64>, via: Vector<f64>, to: Transform<f64>) -> Result<Self, ArcError> {
        let (a, b, c) = (from.translation, via, to.translation);
        let (u, v) = (b - a, c - a);
        let size = u.norm().max(v.norm()).max((c - b).norm());
        if u.norm().min(v.norm()).min((c - b).norm()) < 1e-9 * size || size < 1e-12 {
            return Err(ArcError::SamePoint);
        }
        let n = u.cross(v);
        if n.norm() < 1e-9 * u.norm() * v.norm() {
            return Err(ArcError::Straight);
        }
        let centre = a + (n.cross(u).scale(v.dot(v)) + v.cross(n).scale(u.dot(u))).scale(0.5 / n.dot(n));
        let normal = n.scale(1.0 / n.norm());
        let (p, q) = (a - centre, c - centre);
        // From a over b to c is counterclockwise about n.
        let angle = normal.dot(p.cross(q)).atan2(p.dot(q)).rem_euclid(std::f64::consts::TAU);
        Ok(Arc { from, to, centre, turned: normal.scale(angle) })
    }

    /// The radius, metres.
    pub fn radius(&self) -> f64 {
        (self.from.translation - self.centre).norm()
    }

    /// The angle of the arc, radians, in (0, 2π).
    pub fn angle(&self) -> f64 {
        self.turned.norm()
    }
}

impl HandPath for Arc {
    fn stretches(&self) -> Vec<Stretch> {
        vec![Stretch::Arc]
    }

    fn pose(&self, s: f64) -> Transform<f64> {
        let r: Rotation<f64> = turn::about(self.turned.scale(s));
        let position = self.centre + r * (self.from.translation - self.centre);
        Transform::from_rotation_translation(
            turn::between(&self.from.rotation, &self.to.rotation, s),
            position,
        )
    }

    fn length(&self) -> f64 {
        self.radius() * self.angle()
    }
}
