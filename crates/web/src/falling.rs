//! Weight: the torques that hold an arm where it is, and the arm as it falls when nothing holds it.

use crate::heavy::Heavy;
use crate::motion::{Energies, Met, Path, manipulability};
use crate::refusal::Refusal;
use crate::subject::Subject;
use denavit::dynamics::{Acting, Method, Moment, NoMotion, Torques, gravity_torques, simulate};
use denavit_report::figure::BAR;
use denavit_wire::pose::matrix;
use serde::{Deserialize, Serialize};

/// The estimated error of a step.
const TOLERANCE: f64 = 1e-9;
/// Seconds that an arm falls at most.
const LONGEST: f64 = 60.0;
/// Samples a second, and at most.
const SAMPLES: [f64; 2] = [60.0, 1200.0];

/// An arm that is let go.
#[derive(Deserialize)]
pub struct Wish {
    q: Vec<f64>,
    /// How long it is followed.
    seconds: f64,
}

/// What holds an arm at rest.
#[derive(Serialize)]
pub struct Held {
    /// The links' masses are not known, and those of bars were taken: kg/m.
    #[serde(skip_serializing_if = "Option::is_none")]
    bars: Option<f64>,
    /// Of all that moves, kg.
    mass: f64,
    /// N·m, and N of slides.
    torques: Vec<f64>,
}

/// The torques that hold an arm against its weight.
///
/// # Errors
/// If the configuration does not fit, or a mass has no value.
pub fn hold(subject: &Subject, q: &[f64]) -> Result<Held, Refusal> {
    let q = subject.configuration(q)?;
    let Heavy { arm, is_known } = subject.heavy()?;
    Ok(Held {
        bars: (!is_known).then_some(BAR),
        mass: arm.links.iter().map(|link| link.body.mass).sum(),
        torques: gravity_torques(arm, q),
    })
}

/// An arm that falls from rest: its friction slows it, nothing else.
///
/// # Errors
/// If the configuration does not fit, a mass has no value, or a joint moves none.
pub fn fall(subject: &Subject, wish: &Wish) -> Result<Path, Refusal> {
    let q = subject.configuration(&wish.q)?;
    if !(wish.seconds > 0.0 && wish.seconds <= LONGEST) {
        return Err(Refusal::new(format!("an arm is followed for more than 0 s and {LONGEST} s at most")));
    }
    let arm = &subject.heavy()?.arm;
    let still = vec![0.0; q.len()];
    let acting = Acting { torques: Torques::constant(still.clone()), wrench: None };
    let samples = (wish.seconds * SAMPLES[0]).clamp(2.0, SAMPLES[1]).ceil();
    let times = (wish.seconds, wish.seconds / samples);
    let found = simulate(arm, (q, &still), &acting, times, Method::Adaptive { tolerance: TOLERANCE });
    let (found, ends) = match found {
        Ok(found) => (found, None),
        Err((NoMotion::Singular { joint, .. }, _)) => {
            let name = subject.valued.variables()[joint].symbol.name();
            let hint = "give its link a mass and an inertia, or the joint a rotor";
            let error = format!("{name} moves no mass of its own: how it falls is not determined");
            return Err(Refusal { error, hint: Some(hint.into()) });
        }
        Err((why, found)) => (found, Some(why.to_string())),
    };
    let (drift, size) = found.drift();
    let variables = subject.valued.variables();
    let leaves = found.leaves(&subject.space.limits).into_iter().map(|(j, t)| Met {
        kind: "limit",
        t,
        words: format!("{} leaves its limits: nothing stops it", variables[j].symbol.name()),
    });
    let mut events: Vec<Met> = leaves.collect();
    events.sort_by(|a, b| a.t.total_cmp(&b.t));
    let moments = &found.moments;
    let first = moments.first().map_or(0.0, |m| m.potential);
    let of = |value: &dyn Fn(&Moment) -> f64| moments.iter().map(value).collect();
    let duration = moments.last().map_or(0.0, |m| m.t);
    let exact = match size > 0.0 {
        true => format!("energy is kept to {:.0e} of the largest", drift / size),
        false => "it stands still".into(),
    };
    Ok(Path {
        duration,
        energy: Some(Energies {
            kinetic: of(&|m| m.kinetic),
            lost: of(&|m| m.dissipated),
            potential: of(&|m| m.potential - first),
        }),
        events,
        manipulability: moments.iter().map(|m| manipulability(subject, &m.q)).collect(),
        path: "the arm falls from rest, nothing holds it".into(),
        pose: moments.iter().map(|m| matrix(&subject.robot.pose(&m.q))).collect(),
        q: moments.iter().map(|m| m.q.clone()).collect(),
        reached: 1.0,
        starts: vec![],
        t: moments.iter().map(|m| m.t).collect(),
        timing: ends.map_or(exact.clone(), |why| format!("it ends early, as {why}; {exact}")),
        torque: None,
        velocity: moments.iter().map(|m| m.qd.clone()).collect(),
    })
}
