//! Arms of the catalogue, and numbers that look random.

use denavit::catalogue;
use denavit::geometry::Vector;
use denavit::random::Random;
use denavit_calibration::visible::supposed;
use denavit_calibration::{Measurement, Problem};
use denavit_recording::Arm;

/// An arm of the catalogue, with lengths where it has none.
pub fn arm(name: &str) -> Arm {
    let description = catalogue::robot(name).expect("it is there").filled();
    Arm::new(name, &description).expect("numbers")
}

/// All arms of the catalogue that are chains.
pub fn arms() -> Vec<Arm> {
    let one = |name: &&str| Arm::new(name, &catalogue::robot(name)?.filled()).ok();
    catalogue::names().iter().filter_map(one).collect()
}

/// A point off the last axis.
pub const POINT: Vector<f64> = Vector([0.07, 0.03, 0.11]);

/// What is measured of an arm; things beside it stand where it reaches them.
pub fn problem(arm: &Arm, measurement: Measurement, point: Vector<f64>, gains: bool) -> Problem {
    let fixtures = supposed(arm, measurement, point, 1);
    Problem::new(arm, measurement, point, gains, fixtures)
}

/// Numbers that look random, of a normal distribution too.
pub struct Dice(Random);

impl Dice {
    pub fn new(seed: u64) -> Self {
        Dice(Random(seed.wrapping_mul(0x9e37_79b9).wrapping_add(77)))
    }

    pub fn unit(&mut self) -> f64 {
        self.0.unit()
    }

    pub fn normal(&mut self, deviation: f64) -> f64 {
        let (u, v) = (1.0 - self.0.unit(), self.0.unit());
        deviation * (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos()
    }
}
