//! Jerk-limited ("double S") velocity (Biagiotti & Melchiorri 2008, §3.4).
//!
//! A change of velocity Δ takes T(Δ) = Δ/a + a/j where the acceleration reaches its limit (Δ ≥ a²/j), else 2√(Δ/j);
//! being symmetric it covers T(Δ) times the mean of its end velocities. What is left is the peak velocity.

use super::Phases;
use crate::motion::error::{MotionError, StateError, finite, positive};

/// The fastest motion between two positions and velocities, with no acceleration at its ends, and these greatest
/// velocity, acceleration and jerk: at most seven phases.
///
/// # Errors
/// If a number is not finite, a limit not positive, an end velocity above its limit or against the direction of
/// motion, or the distance too short for the change of velocity (see [`crate::motion::move_within_limits`]).
pub fn double_s(
    [from, to]: [f64; 2],
    [v0, v1]: [f64; 2],
    max_velocity: f64,
    max_acceleration: f64,
    max_jerk: f64,
) -> Result<Phases, MotionError> {
    let ramp = Ramp { acceleration: max_acceleration, jerk: max_jerk };
    positive("limits", &[max_velocity, max_acceleration, max_jerk])?;
    finite("end states", &[from, to, v0, v1])?;
    if v0.abs().max(v1.abs()) > max_velocity {
        return Err(MotionError::State(StateError::AboveLimit));
    }
    let backward = to < from || (to == from && v0 + v1 < 0.0);
    let sign = if backward { -1.0 } else { 1.0 };
    let (v0, v1, distance) = (sign * v0, sign * v1, sign * (to - from));
    if v0 < 0.0 || v1 < 0.0 {
        return Err(MotionError::State(StateError::AgainstMotion));
    }
    let needed = ramp.distance(v0, v1);
    if distance < needed * (1.0 - 1e-12) {
        return Err(MotionError::TooShort { needed, found: distance });
    }
    let peak = peak_velocity(ramp, distance, v0, v1, max_velocity);
    let cruise = distance - ramp.distance(v0, peak) - ramp.distance(peak, v1);
    let mut phases = Phases::starting_at(sign * from, v0);
    ramp.push(&mut phases, peak - v0);
    if peak >= max_velocity {
        phases.push(cruise / peak, 0.0, 0.0);
    }
    ramp.push(&mut phases, v1 - peak);
    Ok(if backward { phases.mirrored() } else { phases })
}

#[derive(Clone, Copy)]
struct Ramp {
    acceleration: f64,
    jerk: f64,
}

impl Ramp {
    /// The acceleration that a change of velocity reaches.
    fn reached(self, change: f64) -> f64 {
        self.acceleration.min((self.jerk * change.abs()).sqrt())
    }

    fn time(self, change: f64) -> f64 {
        let a = self.reached(change);
        if a == 0.0 { 0.0 } else { change.abs() / a + a / self.jerk }
    }

    fn distance(self, from: f64, to: f64) -> f64 {
        (from + to) / 2.0 * self.time(to - from)
    }

    fn push(self, phases: &mut Phases, change: f64) {
        let a = self.reached(change);
        if a == 0.0 {
            return;
        }
        let (time, sign) = (a / self.jerk, change.signum());
        phases.push(time, 0.0, sign * self.jerk);
        phases.push(change.abs() / a - time, sign * a, 0.0);
        phases.push(time, sign * a, -sign * self.jerk);
    }
}

/// The velocity between the ramps: the limit, or the one at which the ramps take all of the distance.
fn peak_velocity(ramp: Ramp, distance: f64, v0: f64, v1: f64, max_velocity: f64) -> f64 {
    let covered = |peak: f64| ramp.distance(v0, peak) + ramp.distance(peak, v1);
    if covered(max_velocity) <= distance {
        return max_velocity;
    }
    let (a, j) = (ramp.acceleration, ramp.jerk);
    if v0 == 0.0 && v1 == 0.0 {
        // d = v²/a + v a/j, or d = 2 √(v³/j) where a is not reached.
        let knee = a * a / j;
        return if covered(knee) <= distance {
            2.0 * a * distance / (knee + (knee * knee + 4.0 * a * distance).sqrt())
        } else {
            (distance * distance * j / 4.0).cbrt()
        };
    }
    // The distance grows with the peak: halving until nothing is between.
    let (mut low, mut high) = (v0.max(v1), max_velocity);
    loop {
        let middle = low + (high - low) / 2.0;
        if middle <= low || middle >= high {
            return low;
        }
        if covered(middle) <= distance { low = middle } else { high = middle }
    }
}
