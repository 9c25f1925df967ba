//! Trapezoidal velocity (Biagiotti & Melchiorri 2008, §3.2).

use super::Phases;
use crate::motion::error::{MotionError, StateError, finite, positive};

/// The fastest motion between two positions and velocities with these greatest velocity and acceleration: speed up,
/// cruise, slow down; triangular where the distance is too short to cruise. It turns round where it has to.
///
/// # Errors
/// If a number is not finite, a limit not positive, or an end velocity above the limit.
pub fn trapezoidal(
    [from, to]: [f64; 2],
    [v0, v1]: [f64; 2],
    max_velocity: f64,
    max_acceleration: f64,
) -> Result<Phases, MotionError> {
    positive("limits", &[max_velocity, max_acceleration])?;
    finite("end states", &[from, to, v0, v1])?;
    if v0.abs().max(v1.abs()) > max_velocity {
        return Err(MotionError::State(StateError::AboveLimit));
    }
    // Distance of the direct change of velocity: what is beyond it takes a peak above both, what is below it a
    // peak below both.
    let a = max_acceleration;
    let direct = (v1 - v0).signum() * (v1 * v1 - v0 * v0) / (2.0 * a);
    let distance = to - from;
    if distance < direct {
        return Ok(forward(-from, -distance, -v0, -v1, max_velocity, a).mirrored());
    }
    Ok(forward(from, distance, v0, v1, max_velocity, a))
}

/// With a peak velocity above both ends: vₚ² = a d + (v₀² + v₁²) / 2 where there is no cruise.
fn forward(from: f64, distance: f64, v0: f64, v1: f64, max_velocity: f64, a: f64) -> Phases {
    let peak = (a * distance + (v0 * v0 + v1 * v1) / 2.0).max(0.0).sqrt().min(max_velocity).max(v0.max(v1));
    let ramps = (2.0 * peak * peak - v0 * v0 - v1 * v1) / (2.0 * a);
    let mut phases = Phases::starting_at(from, v0);
    phases.push((peak - v0) / a, a, 0.0);
    if peak >= max_velocity {
        phases.push((distance - ramps) / peak, 0.0, 0.0);
    }
    phases.push((peak - v1) / a, -a, 0.0);
    phases
}
