//! What exceeds the limits between grid points.
//!
//! Some points of each interval are measured, and where a limit is exceeded the limits of the interval are tightened
//! and the passes run again. Where the arm cannot carry itself at one of these points, no timing helps.

use super::passes;
use super::stage::Program;
use super::torques::{Torque, TorqueLimits};
use crate::motion::error::MotionError;
use crate::motion::limits::Limits;
use crate::motion::path::{JointPath, PathPoint, Side};

/// Where an interval is measured.
const PLACES: [f64; 2] = [0.27, 0.73];
/// By how much more than the excess measured a limit is tightened: x(1 − x) and x(1 − x)(1 − 2x) are greater elsewhere
/// than at the places by a tenth.
const INFLATION: f64 = 1.25;
const ROUNDS: usize = 4;
/// An excess below this is left to the end, where everything is slowed down by as much.
const EXCESS: f64 = 1e-6;

/// Tightens limits until they hold between grid points too. Where path speeds are given at the ends, what is left in
/// the end stays exceeded: some 10⁻⁶, or more if tighter limits do not admit those speeds.
///
/// # Errors
/// If the arm cannot carry itself at a point that is measured.
pub(super) fn hold<P: JointPath>(
    path: &P,
    (limits, torque_limits): (&Limits, Option<&TorqueLimits>),
    program: &mut Program,
    ends: [f64; 2],
    x: &mut Vec<f64>,
) -> Result<(), MotionError> {
    let measured = measure(path, program, torque_limits)?;
    let limits = (limits, torque_limits);
    let mut excess = tighten(&measured, limits, program, x);
    for _ in 0..ROUNDS {
        if excess <= EXCESS {
            break;
        }
        // Only speeds at the ends can be too much for tighter limits.
        let Ok(slower) = passes::solve(program, ends) else { return Ok(()) };
        *x = slower;
        excess = tighten(&measured, limits, program, x);
    }
    if ends == [0.0; 2] && excess > 0.0 {
        let slower = (1.0 + INFLATION * excess).powi(-2);
        x.iter_mut().for_each(|x| *x *= slower);
    }
    Ok(())
}

/// What is measured at the places of all intervals, one after the other.
struct Measured {
    /// q' and q''.
    derivatives: Vec<f64>,
    /// The torques, joint by joint; none without limits of them.
    torques: Vec<Torque>,
}

fn measure<P: JointPath>(
    path: &P,
    program: &Program,
    limits: Option<&TorqueLimits>,
) -> Result<Measured, MotionError> {
    let mut point = PathPoint::zeros(path.dof());
    let count = program.share.len() * 2 * PLACES.len() * path.dof();
    let mut measured = Measured { derivatives: Vec::with_capacity(count), torques: vec![] };
    for s in program.s.windows(2) {
        for place in PLACES {
            let at = s[0] + place * (s[1] - s[0]);
            path.eval_into(at, Side::Behind, &mut point);
            measured.derivatives.extend_from_slice(&point.dq);
            measured.derivatives.extend_from_slice(&point.ddq);
            if let Some(limits) = limits {
                let torques = limits.along(&point.q, &point.dq, &point.ddq);
                limits.carried(at, &torques)?;
                measured.torques.extend(torques);
            }
        }
    }
    Ok(measured)
}

/// Tightens what is exceeded; by which share at most it is.
fn tighten(
    measured: &Measured,
    (limits, torque_limits): (&Limits, Option<&TorqueLimits>),
    program: &mut Program,
    x: &[f64],
) -> f64 {
    let dof = limits.dof();
    let mut excess = 0.0f64;
    let inverse =
        |ranges: &[crate::motion::Range]| -> Vec<[f64; 2]> { ranges.iter().map(|r| r.inverse()).collect() };
    let (velocity, acceleration) = (inverse(limits.velocity()), inverse(limits.acceleration()));
    for (i, places) in measured.derivatives.chunks_exact(2 * PLACES.len() * dof).enumerate() {
        let u = (x[i + 1] - x[i]) / (2.0 * (program.s[i + 1] - program.s[i]));
        let (mut v, mut a) = (0.0f64, 0.0f64);
        for (k, (place, derivatives)) in PLACES.iter().zip(places.chunks_exact(2 * dof)).enumerate() {
            let x = x[i] + place * (x[i + 1] - x[i]);
            let speed = x.sqrt();
            let (dq, ddq) = derivatives.split_at(dof);
            for joint in 0..dof {
                let [low, high] = velocity[joint];
                let qd = dq[joint] * speed;
                v = v.max((qd * low).max(qd * high));
                let [low, high] = acceleration[joint];
                let qdd = dq[joint] * u + ddq[joint] * x;
                a = a.max((qdd * low).max(qdd * high));
            }
            if let Some(limits) = torque_limits {
                let first = (i * PLACES.len() + k) * dof;
                a = a.max(limits.share(&measured.torques[first..first + dof], u, x));
            }
        }
        // Limits of zero are held by standing still.
        let (v, a) = (if v.is_finite() { v } else { 0.0 }, if a.is_finite() { a } else { 0.0 });
        excess = excess.max(v - 1.0).max(a - 1.0);
        if v > 1.0 + EXCESS {
            let share = (1.0 + INFLATION * (v - 1.0)).powi(-2);
            program.highest[i] *= share;
            program.highest[i + 1] *= share;
        }
        if a > 1.0 + EXCESS {
            program.share[i] /= 1.0 + INFLATION * (a - 1.0);
        }
    }
    excess
}
