//! Poses that an arm is asked for: regular, singular, nearly so, with the noise of rounding.

use super::arms::one_of;
use crate::common::Random;
use denavit::geometry::{Rotation, Transform};
use denavit::inverse::JointSpace;
use denavit::robot::Robot;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

/// A pose with a configuration that has it.
#[derive(Clone, Debug)]
pub struct Asked {
    pub q: Vec<f64>,
    pub pose: Transform<f64>,
    /// What the pose was changed by, at most.
    pub noise: f64,
    /// What was asked for: a configuration like any other, one at quarter turns, or one beside it.
    pub class: &'static str,
}

/// A configuration, and its pose.
pub fn asked(random: &mut Random, robot: &Robot<f64>, space: &JointSpace) -> Asked {
    // How much of it is special, and how far from there.
    let special = one_of(random, &[0.0, 0.0, 0.0, 0.4, 0.8, 1.0]);
    let off =
        if special > 0.0 { one_of(random, &[0.0, 0.0, 0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3]) } else { 0.0 };
    let class = match (special > 0.0, off > 0.0) {
        (false, _) => "regular",
        (true, false) => "at quarter turns",
        (true, true) => "beside",
    };
    let q: Vec<f64> = space
        .is_angle
        .iter()
        .map(|&is_angle| {
            let unit = if is_angle { 1.0 } else { robot.reach() };
            let x = if random.unit() >= special {
                (TAU * random.unit() - PI) * if is_angle { 1.0 } else { 0.2 }
            } else if is_angle {
                let step = one_of(random, &[FRAC_PI_2, FRAC_PI_2, FRAC_PI_2, FRAC_PI_4]);
                step * one_of(random, &[-1.0, 0.0, 0.0, 1.0, 2.0])
            } else {
                one_of(random, &[0.0, 0.25, 0.5, -0.5])
            };
            unit * (x + off * (2.0 * random.unit() - 1.0))
        })
        .collect();
    let mut pose = robot.pose(&q);
    let noise = if random.unit() < 0.2 { 3e-16 } else { 0.0 };
    if noise > 0.0 {
        let rows = pose.rotation.rows().map(|row| row.map(|x| x + noise * (2.0 * random.unit() - 1.0)));
        pose = Transform::from_rotation_translation(Rotation::from_rows(rows), pose.translation);
    }
    Asked { q, pose, noise, class }
}
