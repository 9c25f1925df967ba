//! Smooth curves through poses.

use super::{HandPath, Stretch, turn};
use crate::geometry::{Transform, Vector};

/// Through poses, smooth in position (a natural cubic spline over the chords) and in orientation (a cubic Bézier curve of
/// rotations between each two, with one angular velocity at each pose: Kim, Kim and Shin 1995).
#[derive(Clone, PartialEq, Debug)]
pub struct PoseSpline {
    poses: Vec<Transform<f64>>,
    /// s at each pose.
    at: Vec<f64>,
    /// Second derivatives of the position by s.
    bent: Vec<Vector<f64>>,
    /// The angular velocity at each pose by s, along the tool's own axes.
    turning: Vec<Vector<f64>>,
}

impl PoseSpline {
    /// Through poses, `None` if there are fewer than two or two in a row have one position and one orientation.
    pub fn new(poses: Vec<Transform<f64>>) -> Option<Self> {
        let chord = |w: &[Transform<f64>]| {
            let turned = turn::vector(&(w[0].rotation.inverse() * w[1].rotation)).norm();
            (w[1].translation - w[0].translation).norm().max(0.5 * turned)
        };
        let chords: Vec<f64> = poses.windows(2).map(chord).collect();
        let total: f64 = chords.iter().sum();
        if chords.is_empty() || chords.iter().any(|&c| c < 1e-9 * total || c.is_nan() || c <= 0.0) {
            return None;
        }
        let mut at = vec![0.0];
        chords.iter().for_each(|c| at.push(at[at.len() - 1] + c / total));
        let bent = natural(&at, &poses.iter().map(|p| p.translation).collect::<Vec<_>>());
        let turning = (0..poses.len()).map(|k| turning(&poses, &at, k)).collect();
        Some(PoseSpline { poses, at, bent, turning })
    }
}

/// The mean of the angular velocities before and behind a pose, the nearer neighbour counting more.
fn turning(poses: &[Transform<f64>], at: &[f64], k: usize) -> Vector<f64> {
    let rate = |i: usize| {
        let way = turn::vector(&(poses[i].rotation.inverse() * poses[i + 1].rotation));
        way.scale(1.0 / (at[i + 1] - at[i]))
    };
    match k {
        0 => rate(0),
        k if k + 1 == poses.len() => rate(k - 1),
        k => {
            let (h, next) = (at[k] - at[k - 1], at[k + 1] - at[k]);
            (rate(k - 1).scale(next) + rate(k).scale(h)).scale(1.0 / (h + next))
        }
    }
}

/// Second derivatives of the natural cubic spline, by Thomas's algorithm.
fn natural(at: &[f64], values: &[Vector<f64>]) -> Vec<Vector<f64>> {
    let n = at.len();
    let mut bent = vec![Vector::zero(); n];
    let mut factor = vec![0.0; n];
    for k in 1..n - 1 {
        let (h, next) = (at[k] - at[k - 1], at[k + 1] - at[k]);
        let slopes =
            (values[k + 1] - values[k]).scale(1.0 / next) - (values[k] - values[k - 1]).scale(1.0 / h);
        let pivot = 2.0 * (h + next) - h * factor[k - 1];
        factor[k] = next / pivot;
        bent[k] = (slopes.scale(6.0) - bent[k - 1].scale(h)).scale(1.0 / pivot);
    }
    for k in (1..n - 1).rev() {
        bent[k] = bent[k] - bent[k + 1].scale(factor[k]);
    }
    bent
}

impl HandPath for PoseSpline {
    fn stretches(&self) -> Vec<Stretch> {
        vec![Stretch::Spline(self.poses.len())]
    }

    fn pose(&self, s: f64) -> Transform<f64> {
        let k = self.at.partition_point(|a| *a <= s).clamp(1, self.at.len() - 1) - 1;
        let h = self.at[k + 1] - self.at[k];
        let u = ((s - self.at[k]) / h).clamp(0.0, 1.0);
        let (a, b) = (1.0 - u, u);
        let (from, to) = (&self.poses[k], &self.poses[k + 1]);
        let curve = self.bent[k].scale(a * a * a - a) + self.bent[k + 1].scale(b * b * b - b);
        let position = from.translation.scale(a) + to.translation.scale(b) + curve.scale(h * h / 6.0);
        let start = self.turning[k].scale(h / 3.0);
        let end = self.turning[k + 1].scale(h / 3.0);
        let middle = turn::vector(
            &(turn::about(-start) * (from.rotation.inverse() * to.rotation) * turn::about(-end)),
        );
        let rotation = from.rotation
            * turn::about(start.scale(1.0 - a * a * a))
            * turn::about(middle.scale(u * u * (3.0 - 2.0 * u)))
            * turn::about(end.scale(b * b * b));
        Transform::from_rotation_translation(rotation, position)
    }
}
