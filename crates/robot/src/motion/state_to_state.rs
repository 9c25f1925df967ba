//! From a state to a state with no path given, under velocity, acceleration and jerk limits.
//!
//! The method is that of Berscheid & Kröger, *Jerk-limited real-time trajectory generation with arbitrary target
//! states* (RSS 2021), in the crate `rsruckig`. What it returns is checked here before it is passed on.

use super::error::{End, Failure, MotionError, StateError, joints};
use super::limits::Limits;
use super::profile::{JointMove, Phases, Profile, Sample, TimeLaw};
use super::trajectory::JointState;
use rsruckig::prelude::{
    InputParameter, Profile as Ruckig7, Ruckig, RuckigError, ThrowErrorHandler,
    Trajectory as RuckigTrajectory,
};

/// How far a state may be off its limits or its goal before an answer is refused.
const TOLERANCE: f64 = 1e-6;
/// Where the method finds no answer it is asked again with limits tighter by these shares.
const SHARES: [f64; 3] = [0.0, 1e-6, 1e-4];

/// The fastest motion from a state to a state within the limits; all joints arrive at the same time.
///
/// Positions, velocities and accelerations at both ends are arbitrary within the limits. Between them a joint may
/// leave the interval between its end positions, as it must if it starts or ends in motion. Where rounding hides the
/// answer (about 1 of 10⁵ random problems) the motion is the fastest for limits tighter by 10⁻⁶ or 10⁻⁴.
///
/// # Errors
/// If a number is not finite, a list has not one entry a joint, there are no jerk limits, an end state violates the
/// limits or cannot but violate them later, or no answer is found.
pub fn move_within_limits(
    from: &JointState,
    to: &JointState,
    limits: &Limits,
) -> Result<JointMove, MotionError> {
    for state in [from, to] {
        joints("positions", limits.dof(), &state.q)?;
        joints("velocities", limits.dof(), &state.qd)?;
        joints("accelerations", limits.dof(), &state.qdd)?;
    }
    let jerk = limits.jerk().ok_or(MotionError::NoJerkLimits)?;
    end_holds(End::Start, from, limits, jerk, 1.0)?;
    end_holds(End::End, to, limits, jerk, -1.0)?;
    let mut failure = MotionError::NoAnswer(Failure::NoProfile);
    for share in SHARES {
        match solve(from, to, limits, jerk, 1.0 - share) {
            Ok(found) if is_sound(&found, to, limits) => return Ok(found),
            Ok(_) => failure = MotionError::NoAnswer(Failure::Unsound),
            // What is refused with the limits given is refused with tighter ones.
            Err(e @ MotionError::State(_)) if share == 0.0 => return Err(e),
            Err(e) if share == 0.0 => failure = e,
            Err(_) => {}
        }
    }
    Err(failure)
}

/// Refuses a state outside the limits, and one that is on the way out (`time` 1) or comes from outside (−1): while the
/// acceleration a goes to zero the velocity still changes by a²/2j.
fn end_holds(
    end: End,
    state: &JointState,
    limits: &Limits,
    jerk: &[f64],
    time: f64,
) -> Result<(), MotionError> {
    for (i, most_jerk) in jerk.iter().enumerate() {
        let (v, a) = (state.qd[i], state.qdd[i]);
        let then = v + time * a.signum() * a * a / (2.0 * most_jerk);
        let velocity = limits.velocity()[i];
        let most = velocity.share(v).max(limits.acceleration()[i].share(a));
        if most > 1.0 + TOLERANCE {
            return Err(MotionError::State(StateError::OutsideLimits(end, i)));
        }
        if velocity.share(then) > 1.0 + TOLERANCE {
            return Err(MotionError::State(StateError::ExceedsVelocity(end, i)));
        }
    }
    Ok(())
}

fn solve(
    from: &JointState,
    to: &JointState,
    limits: &Limits,
    jerk: &[f64],
    share: f64,
) -> Result<JointMove, MotionError> {
    let n = limits.dof();
    let mut input = InputParameter::<0>::new(Some(n));
    let mut lowest = (input.max_velocity.clone(), input.max_acceleration.clone());
    for (i, most_jerk) in jerk.iter().enumerate() {
        input.current_position[i] = from.q[i];
        input.current_velocity[i] = from.qd[i];
        input.current_acceleration[i] = from.qdd[i];
        input.target_position[i] = to.q[i];
        input.target_velocity[i] = to.qd[i];
        input.target_acceleration[i] = to.qdd[i];
        input.max_velocity[i] = limits.velocity()[i].upper * share;
        input.max_acceleration[i] = limits.acceleration()[i].upper * share;
        input.max_jerk[i] = most_jerk * share;
        lowest.0[i] = limits.velocity()[i].lower * share;
        lowest.1[i] = limits.acceleration()[i].lower * share;
    }
    (input.min_velocity, input.min_acceleration) = (Some(lowest.0), Some(lowest.1));
    let mut found = RuckigTrajectory::<0>::new(Some(n));
    Ruckig::<0, ThrowErrorHandler>::new(Some(n), 0.001).calculate(&input, &mut found).map_err(refusal)?;
    let profiles = found.get_profiles().first().ok_or(MotionError::NoAnswer(Failure::NoProfile))?;
    let laws = profiles.iter().map(|p| TimeLaw::Phases(phases(p))).collect();
    Ok(JointMove::new(laws, found.get_duration()))
}

fn refusal(error: RuckigError) -> MotionError {
    // The first line; what follows repeats the input.
    let first = |text: &str| text.lines().next().unwrap_or_default().trim().to_string();
    match error {
        RuckigError::ValidationError(text) => MotionError::State(StateError::Refused(first(&text))),
        RuckigError::CalculatorError(text) => MotionError::NoAnswer(Failure::Refused(first(&text))),
    }
}

/// A brake of two phases at most, and seven phases.
fn phases(p: &Ruckig7) -> Phases {
    let mut phases = Phases::starting_at(p.p[0], p.v[0]);
    let b = &p.brake;
    let brake = (0..2).filter(|_| b.duration > 0.0).map(|k| (b.t[k], b.p[k], b.v[k], b.a[k], b.j[k]));
    let main = (0..7).map(|k| (p.t[k], p.p[k], p.v[k], p.a[k], p.j[k]));
    for (time, position, velocity, acceleration, jerk) in brake.chain(main).filter(|phase| phase.0 > 0.0) {
        phases.push_state(time, Sample { position, velocity, acceleration, jerk });
    }
    phases
}

/// Whether the phases end at the goal and keep the limits: velocities at their extremes, where the acceleration is
/// zero, the others at the ends of phases.
fn is_sound(found: &JointMove, to: &JointState, limits: &Limits) -> bool {
    found.laws().iter().enumerate().all(|(i, law)| {
        let TimeLaw::Phases(phases) = law else { return false };
        let end = phases.end();
        let near = |x: f64, y: f64| (x - y).abs() <= TOLERANCE * (1.0 + y.abs());
        let arrives =
            near(end.position, to.q[i]) && near(end.velocity, to.qd[i]) && near(end.acceleration, to.qdd[i]);
        let holds = |s: Sample| {
            let shares = [
                limits.velocity()[i].share(s.velocity),
                limits.acceleration()[i].share(s.acceleration),
                limits.jerk().map_or(0.0, |j| s.jerk.abs() / j[i]),
            ];
            shares.iter().all(|share| *share <= 1.0 + TOLERANCE)
        };
        arrives && holds(end) && phases.phases().iter().all(|p| holds(p.state)) && {
            extremes(phases).all(|t| holds(phases.at(t)))
        }
    })
}

/// Times at which the acceleration passes zero.
fn extremes(phases: &Phases) -> impl Iterator<Item = f64> + '_ {
    let ends = phases.phases().iter().skip(1).map(|p| p.start).chain([phases.duration()]);
    phases.phases().iter().zip(ends).filter_map(|(p, end)| {
        let t = p.start - p.state.acceleration / p.state.jerk;
        (t > p.start && t < end).then_some(t)
    })
}
