//! All tests of the crate.

mod delta;
mod files;
mod intervals;
mod planar;
mod rates;
mod stewart;

use denavit::geometry::orientation::{OrientationSet, rotation};
use denavit::geometry::{Transform, Vector};
use denavit::random::Random;

/// How many cases: few, or all that `cargo xtask soak suites` wants.
fn cases(few: usize, all: usize) -> usize {
    if std::env::var_os("DENAVIT_SOAK").is_some() { all } else { few }
}

/// A number in [−1, 1).
fn signed(random: &mut Random) -> f64 {
    2.0 * random.unit() - 1.0
}

fn vector(random: &mut Random) -> Vector<f64> {
    Vector([0; 3].map(|_| signed(random)))
}

/// Any pose with its origin in the cube around that of the base.
fn pose(random: &mut Random) -> Transform<f64> {
    let quaternion: [f64; 4] = [0; 4].map(|_| signed(random));
    let turned = rotation(OrientationSet::Quaternion, &quaternion).expect("it is not 0");
    Transform::from_rotation_translation(turned, vector(random))
}

/// The largest difference of two matrices' entries.
fn apart(a: &Transform<f64>, b: &Transform<f64>) -> f64 {
    let pairs = a.matrix().into_iter().flatten().zip(b.matrix().into_iter().flatten());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
