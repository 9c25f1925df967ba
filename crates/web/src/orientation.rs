//! Orientations as one types them.

use crate::refusal::Refusal;
use crate::solve;
use denavit::geometry::orientation::{OrientationSet, extract, rotation};
use denavit::geometry::{Transform, Vector};
use denavit_wire::pose::{Matrix, Orientation, matrix};
use serde::Serialize;

const SETS: [(&str, &str); 15] = [
    ("rpy", "roll, pitch, yaw (fixed axes x, y, z)"),
    ("zyx", "Euler z y x"),
    ("zyz", "Euler z y z"),
    ("zxz", "Euler z x z"),
    ("xyz", "Euler x y z"),
    ("xzy", "Euler x z y"),
    ("yxz", "Euler y x z"),
    ("yzx", "Euler y z x"),
    ("zxy", "Euler z x y"),
    ("xyx", "Euler x y x"),
    ("xzx", "Euler x z x"),
    ("yxy", "Euler y x y"),
    ("yzy", "Euler y z y"),
    ("quaternion", "quaternion x y z w"),
    ("axis-angle", "axis and angle"),
];

/// A set.
#[derive(Serialize)]
struct Set {
    name: &'static str,
    /// What its values are called.
    names: &'static [&'static str],
    title: &'static str,
}

/// All sets.
#[derive(Serialize)]
pub struct Sets {
    sets: Vec<Set>,
}

/// A pose.
#[derive(Serialize)]
pub struct Posed {
    pose: Matrix,
}

/// The sets, with the names of their values.
pub fn sets() -> Sets {
    let all = SETS.into_iter().filter_map(|(name, title)| {
        let set: OrientationSet = name.parse().ok()?;
        Some(Set { name, names: set.names(), title })
    });
    Sets { sets: all.collect() }
}

fn set(name: &str) -> Result<OrientationSet, Refusal> {
    name.parse()
        .map_err(|why: denavit::geometry::orientation::OrientationError| Refusal::new(why.to_string()))
}

/// The orientation of a pose.
///
/// # Errors
/// If there is no such set, or the matrix is no pose.
pub fn angles(pose: &[Vec<f64>], name: &str) -> Result<Orientation, Refusal> {
    Ok(extract(&solve::pose(pose)?.rotation, set(name)?).into())
}

/// The pose with a position and an orientation.
///
/// # Errors
/// If there is no such set, or the values are no orientation.
pub fn pose(xyz: [f64; 3], name: &str, values: &[f64]) -> Result<Posed, Refusal> {
    let turn = rotation(set(name)?, values).map_err(|why| Refusal::new(why.to_string()))?;
    Ok(Posed { pose: matrix(&Transform::from_rotation_translation(turn, Vector(xyz))) })
}
