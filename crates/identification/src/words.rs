//! What was found, in English.

use crate::identify::Identified;
use crate::model::{Model, What};
use crate::motion::{NoMotion, Remark};
use crate::suspects::Suspect;
use denavit::quantity::torque_unit;

/// A number with a few digits.
pub fn short(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    if !x.is_finite() {
        return "∞".into();
    }
    let places = (2 - x.abs().log10().floor() as i32).clamp(0, 12) as usize;
    let text = if (1e-6..1e7).contains(&x.abs()) { format!("{x:.places$}") } else { format!("{x:.2e}") };
    text.replace('-', "−")
}

/// A part in percent.
pub fn percent(part: f64) -> String {
    let x = 100.0 * part;
    if x < 0.1 {
        format!("{x:.2} %")
    } else if x < 10.0 {
        format!("{x:.1} %")
    } else {
        format!("{x:.0} %")
    }
}

/// The unit of a joint's torque.
fn unit(model: &Model, joint: usize) -> &'static str {
    use denavit::description::JointKind::{Prismatic, Revolute};
    torque_unit(if model.turns[joint] { Revolute } else { Prismatic })
}

/// What is suspect; `names` are those of the joints.
pub fn suspect(model: &Model, names: &[String], s: &Suspect) -> String {
    match s {
        Suspect::Sign(j, part) => format!(
            "the torque of {} has the other sign: with it turned round, what is left over of all torques, squared, falls to {}",
            names[*j],
            percent(*part)
        ),
        Suspect::Factor(j, f, part) => format!(
            "the torque of {} fits the others when it is multiplied with {}: another unit? What is left over, squared, falls to {}",
            names[*j],
            short(*f),
            percent(*part)
        ),
        Suspect::AllSigns => {
            "all torques have the other sign: the inertias that the joints feel are below 0 as they stand, masses negative".into()
        }
        Suspect::Inertia(j, x, s) => format!(
            "the inertia that {} feels is below 0, {} ± {} at one configuration: no arm has that. Its torque may have the other sign",
            names[*j],
            short(*x),
            short(*s)
        ),
        Suspect::Friction(k, x, s) => {
            let p = &model.parameters[*k];
            let what = if matches!(p.what, What::Rotor(_)) { "no rotor has that" } else { "such a friction drives" };
            format!("{} is below 0, {} ± {} {}: {what}", p.name, short(*x), short(*s), p.unit)
        }
        Suspect::Gravity(g, part) => format!(
            "the torques fit another gravity, ({}, {}, {}) m/s² in the base: what is left over, squared, falls to {}. Is the base mounted otherwise? --gravity",
            short(g[0]),
            short(g[1]),
            short(g[2]),
            percent(*part)
        ),
        Suspect::Mass(kg) => format!(
            "with these torques even links would weigh {} kg: no arm of this size does. Are the torques in another unit?",
            short(*kg)
        ),
        Suspect::Unexplained(j, share) => format!(
            "{} of the torque of {} is not explained by any masses and frictions",
            percent(*share),
            names[*j]
        ),
    }
}

/// What is worth saying of a recording.
pub fn remark(names: &[String], r: &Remark) -> String {
    match r {
        Remark::Missing(n) => format!("{n} rows in which a number is missing are left out"),
        Remark::Back(n) => format!("the time goes back or stands still at {n} rows: stretches end there"),
        Remark::Gaps(n) => format!("time is missing at {n} places: stretches end there"),
        Remark::Uneven(part) => {
            format!("the times are uneven by {} of a step: even ones are taken between them", percent(*part))
        }
        Remark::Turns(j) => format!("jumps by whole turns are undone in {}", names[*j]),
        Remark::Short(n) => format!("{n} stretches are too short for the filter"),
        Remark::Degrees(by) => format!(
            "columns of the joints that do not say their unit are taken for degrees: taken for radians, {}",
            match by {
                Some(by) => format!("{} times as much of the torques is left over", short(*by)),
                None => "they are no motion".into(),
            }
        ),
    }
}

/// Why columns are no motion.
pub fn no_motion(names: &[String], why: &NoMotion) -> String {
    match why {
        NoMotion::Rows { whole, all } => {
            format!("{whole} of {all} rows have a number in every column that is needed; at least 32 are")
        }
        NoMotion::Time => "the time does not go on\n  = hint: --rate with the rows a second".into(),
        NoMotion::Short { longest, needed } => format!(
            "at most {longest} rows follow one another, and the filter needs {needed}\n  = hint: a longer recording, a higher --cutoff, or --cutoff none"
        ),
        NoMotion::Cutoff(f, rate) => {
            format!(
                "--cutoff {}: the recording has {} rows a second; a filter is below 0.45 of that",
                short(*f),
                short(*rate)
            )
        }
        NoMotion::Rates(j, k) => format!(
            "the velocities of {} are {} times those of its positions{}\n  = hint: say the units in the header, as in `qd1 [deg/s]`, or leave the velocities out with --velocities none",
            names[*j],
            short(*k),
            if *k < 0.0 { ": the sign" } else { ": the unit, or the time" }
        ),
        NoMotion::Accelerations(j, k) => format!(
            "the accelerations of {} are {} times those of its velocities\n  = hint: say the units in the header, or leave the accelerations out with --accelerations none",
            names[*j],
            short(*k)
        ),
    }
}

/// What of the torques is explained, and what the motion does not tell.
pub fn lines(model: &Model, names: &[String], found: &Identified) -> Vec<String> {
    let mut all = vec![];
    for (j, of) in found.estimate.joints.iter().enumerate() {
        if of.rows == 0 {
            all.push(format!(
                "{} does not move: its torque is not used, as its friction is not known at rest",
                names[j]
            ));
        }
    }
    let unseen: Vec<usize> = found.unseen().collect();
    if !unseen.is_empty() {
        let list = |which: &[usize]| {
            which.iter().map(|&k| model.parameters[k].name.as_str()).collect::<Vec<_>>().join(", ")
        };
        all.push(format!("this motion does not tell {}: they are not given as numbers", list(&unseen)));
        for group in found.estimate.unseen.iter().filter(|g| g.len() > 1).take(6) {
            all.push(format!("it does not tell these apart, only what they add up to: {}", list(group)));
        }
    }
    let named: Vec<String> =
        model.absorbed.iter().map(|(rotor, of)| format!("{rotor} is part of {of}")).collect();
    if !named.is_empty() {
        all.push(format!("of rotors, {}: no torque tells them apart", named.join(", ")));
    }
    let joints: Vec<usize> = (0..names.len()).filter(|&j| found.estimate.joints[j].at_rest > 0).collect();
    if !joints.is_empty() {
        let of = |&j: &usize| format!("{} of {}", found.estimate.joints[j].at_rest, names[j]);
        let list = joints.iter().map(of).collect::<Vec<_>>().join(", ");
        all.push(format!("rows at rest are left out, where Coulomb's friction is whatever holds: {list}"));
    }
    all
}

/// What the torques of a joint are in.
pub fn unit_of_torque(model: &Model, joint: usize) -> &'static str {
    unit(model, joint)
}
