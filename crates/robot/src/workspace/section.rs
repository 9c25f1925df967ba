//! Which plane the workspace is seen in: chosen by how the axes lie, never by the robot's name.

use crate::geometry::{Axis, Vector};

/// A plane with two coordinates in metres; all vectors are given in the base.
#[derive(Clone, PartialEq, Debug)]
pub enum Section {
    /// The half plane through the axis of a joint that turns: the distance ρ ≥ 0 from the axis, the height along it.
    /// The joint turns the half plane about the axis.
    ThroughAxis {
        /// The joint, from 0.
        joint: usize,
        /// The point of the axis that heights are counted from: nearest to the origin of the base.
        point: Vector<f64>,
        /// A unit vector, upwards where there is an up.
        direction: Vector<f64>,
    },
    /// The plane that the tool point never leaves.
    Plane {
        /// Orthonormal; the coordinates are the base's along them.
        directions: [Vector<f64>; 2],
    },
    /// The workspace as it is seen from far away: each tool point goes to its foot in a plane.
    Projection {
        /// Orthonormal; the coordinates are the base's along them.
        directions: [Vector<f64>; 2],
    },
}

/// A direction this near to an axis of the base is that axis.
const SAME: f64 = 1e-9;

impl Section {
    /// The coordinates of a point that is given in the base (metres).
    pub fn coordinates(&self, p: Vector<f64>) -> [f64; 2] {
        match self {
            Section::ThroughAxis { point, direction, .. } => {
                let r = p - *point;
                let height = r.dot(*direction);
                [(r - direction.scale(height)).norm(), height]
            }
            Section::Plane { directions } | Section::Projection { directions } => {
                directions.map(|u| u.dot(p))
            }
        }
    }

    /// How the two coordinates change with the point: a row each.
    pub(super) fn rows(&self, p: Vector<f64>) -> [Vector<f64>; 2] {
        match self {
            Section::ThroughAxis { point, direction, .. } => {
                let r = p - *point;
                let across = r - direction.scale(r.dot(*direction));
                let distance = across.norm();
                // On the axis itself every direction leads away from it.
                let away =
                    if distance > 1e-12 { across.scale(1.0 / distance) } else { direction.any_across() };
                [away, *direction]
            }
            Section::Plane { directions } | Section::Projection { directions } => *directions,
        }
    }

    /// The symbols of the two coordinates: those of the base's axes where they are along one.
    pub fn symbols(&self) -> [&'static str; 2] {
        match self {
            Section::ThroughAxis { direction, .. } => ["ρ", along(*direction).unwrap_or("h")],
            Section::Plane { directions: [u, v] } | Section::Projection { directions: [u, v] } => {
                [along(*u).unwrap_or("u"), along(*v).unwrap_or("v")]
            }
        }
    }
}

/// The name of the base's axis that a unit vector is along.
fn along(v: Vector<f64>) -> Option<&'static str> {
    let [x, y, z] = Axis::ALL.map(|a| (v - Vector::unit(a)).norm() <= SAME);
    if x {
        Some("x")
    } else if y {
        Some("y")
    } else {
        z.then_some("z")
    }
}

/// The plane across a normal: two axes of the base where the normal is the third, else any two directions.
pub(super) fn across(normal: Vector<f64>) -> [Vector<f64>; 2] {
    let [x, y, z] = Axis::ALL.map(Vector::unit);
    let is = |a: Vector<f64>| normal.cross(a).norm() <= SAME;
    if is(z) {
        [x, y]
    } else if is(y) {
        [x, z]
    } else if is(x) {
        [y, z]
    } else {
        let u = normal.any_across();
        [u, normal.cross(u)]
    }
}

/// The direction of an axis without its sense: upwards, or along the base's axis that it is nearest to.
pub(super) fn upwards(v: Vector<f64>) -> Vector<f64> {
    let leading = [v[2], v[0], v[1]].into_iter().find(|c| c.abs() > 0.1).unwrap_or(1.0);
    let up = if leading < 0.0 { -v } else { v };
    // Rounding of quarter turns must not hide that it is an axis of the base.
    Axis::ALL.map(Vector::unit).into_iter().find(|&e| (up - e).norm() <= SAME).unwrap_or(up)
}
