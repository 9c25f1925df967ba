//! Lists of way-points, checked.

use crate::motion::error::{MotionError, finite, joints};

/// Parameters of way-points by the length of the chords between them, from 0; in them q' is nearly a unit vector.
///
/// # Errors
/// If there are fewer than two way-points, they differ in the number of joints, a number is not finite, or one
/// repeats the one before it.
pub fn chord_lengths(way_points: &[Vec<f64>]) -> Result<Vec<f64>, MotionError> {
    checked(way_points)?;
    let mut parameters = vec![0.0];
    let mut s = 0.0;
    for (i, pair) in way_points.windows(2).enumerate() {
        let chord = distance(&pair[0], &pair[1]);
        // A chord that vanishes beside the length before it is a repetition too.
        if s + chord <= s {
            return Err(MotionError::RepeatedWayPoint(i + 1));
        }
        s += chord;
        parameters.push(s);
    }
    finite("way-points", &[s])?;
    Ok(parameters)
}

/// The number of joints, if the list is two way-points or more of finite numbers.
pub(super) fn checked(way_points: &[Vec<f64>]) -> Result<usize, MotionError> {
    if way_points.len() < 2 {
        return Err(MotionError::TooFewWayPoints(way_points.len()));
    }
    let dof = way_points[0].len();
    if dof == 0 {
        return Err(MotionError::Joints { what: "way-points", expected: 1, found: 0 });
    }
    for point in way_points {
        joints("way-points", dof, point)?;
    }
    Ok(dof)
}

/// Refuses parameters that are not one for each way-point, from 0 and increasing.
pub(super) fn checked_parameters(parameters: &[f64], way_points: &[Vec<f64>]) -> Result<(), MotionError> {
    const WHAT: &str = "parameters of way-points";
    joints(WHAT, way_points.len(), parameters)?;
    if parameters[0] != 0.0 {
        return Err(MotionError::NotIncreasing(WHAT, 0));
    }
    match parameters.windows(2).position(|p| p[1] <= p[0]) {
        Some(i) => Err(MotionError::NotIncreasing(WHAT, i + 1)),
        None => Ok(()),
    }
}

/// The Euclidean distance in joint space.
pub(super) fn distance(a: &[f64], b: &[f64]) -> f64 {
    // Scaled, so that squares neither overflow nor vanish.
    let scale = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    if scale == 0.0 {
        return 0.0;
    }
    scale * a.iter().zip(b).map(|(a, b)| ((a - b) / scale).powi(2)).sum::<f64>().sqrt()
}
