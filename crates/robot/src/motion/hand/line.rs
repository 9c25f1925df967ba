//! Straight lines.

use super::{HandPath, Stretch, turn};
use crate::geometry::{Transform, Vector};

/// How the orientation goes from one end to the other.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Orientation {
    /// About one axis at a constant rate while the origin goes straight (SLERP).
    Slerp,
    /// As a screw: about and along one line in space. The origin goes along a helix, straight only if nothing turns.
    Screw,
}

/// From a pose to a pose.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Line {
    /// The pose at the start.
    pub from: Transform<f64>,
    /// The pose at the end.
    pub to: Transform<f64>,
    /// How the orientation changes.
    pub orientation: Orientation,
}

impl HandPath for Line {
    fn stretches(&self) -> Vec<Stretch> {
        vec![Stretch::Line]
    }

    fn pose(&self, s: f64) -> Transform<f64> {
        match self.orientation {
            Orientation::Slerp => Transform::from_rotation_translation(
                turn::between(&self.from.rotation, &self.to.rotation, s),
                self.from.translation + (self.to.translation - self.from.translation).scale(s),
            ),
            Orientation::Screw => self.from * screw(&(self.from.inverse() * self.to), s),
        }
    }
}

/// The part s of a rigid motion: exp(s log X) (Murray, Li & Sastry 1994, section 2.3).
fn screw(x: &Transform<f64>, s: f64) -> Transform<f64> {
    let w = turn::vector(&x.rotation);
    let angle = w.norm();
    let p = x.translation;
    if angle < 1e-9 {
        return Transform::from_rotation_translation(turn::about(w.scale(s)), p.scale(s));
    }
    // p = h·w + c − R c, with the point c of the axis nearest to the origin.
    let axis = w.scale(1.0 / angle);
    let along = axis.scale(axis.dot(p));
    let across = p - along;
    let half = (0.5 * angle).tan();
    let c: Vector<f64> = (across + axis.cross(across).scale(1.0 / half)).scale(0.5);
    let r = turn::about(w.scale(s));
    Transform::from_rotation_translation(r, along.scale(s) + c - r * c)
}
