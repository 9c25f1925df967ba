//! Orientations as one types them.

use crate::refusal::Refusal;
use crate::scene::matrix;
use crate::solve;
use denavit::geometry::orientation::{OrientationSet, extract, rotation};
use denavit::geometry::{Transform, Vector};
use serde_json::{Value, json};

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

/// The sets, with the names of their values.
pub fn sets() -> Value {
    let all = SETS.into_iter().filter_map(|(name, title)| {
        let set: OrientationSet = name.parse().ok()?;
        Some(json!({ "name": name, "title": title, "names": set.names() }))
    });
    json!({ "sets": all.collect::<Vec<_>>() })
}

fn set(name: &str) -> Result<OrientationSet, Refusal> {
    name.parse()
        .map_err(|why: denavit::geometry::orientation::OrientationError| Refusal::new(why.to_string()))
}

/// The orientation of a pose.
///
/// # Errors
/// If there is no such set, or the matrix is no pose.
pub fn angles(pose: &[Vec<f64>], name: &str) -> Result<Value, Refusal> {
    let found = extract(&solve::pose(pose)?.rotation, set(name)?);
    Ok(json!({ "values": found.values, "singular": found.singular }))
}

/// The pose with a position and an orientation.
///
/// # Errors
/// If there is no such set, or the values are no orientation.
pub fn pose(xyz: [f64; 3], name: &str, values: &[f64]) -> Result<Value, Refusal> {
    let turn = rotation(set(name)?, values).map_err(|why| Refusal::new(why.to_string()))?;
    Ok(json!({ "pose": matrix(&Transform::from_rotation_translation(turn, Vector(xyz))) }))
}
