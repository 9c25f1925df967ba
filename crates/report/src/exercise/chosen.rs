//! The numbers of an exercise: as people write them, within the limits, where the arm is regular; the same for the same seed.

use super::NoExercise;
use denavit::description::{Description, Measure};
use denavit::inverse::JointSpace;
use denavit::random::Random;
use denavit::robot::Robot;
use denavit::velocity::{Viewpoint, geometric, measures};
use denavit_symbolic::{Expr, Rational};

/// Angles are multiples of this, degrees.
const ANGLE: i64 = 15;
/// Lengths are multiples of 1/20 m.
const PARTS: i64 = 20;
/// Lengths and slides that nothing bounds have from two of these to twelve.
const LENGTHS: [i64; 2] = [2, 12];
/// Configurations among which the regular ones are looked for.
const DRAWN: usize = 200;
/// A configuration is regular if its smallest singular value is this part of the largest among those drawn.
const REGULAR: f64 = 0.3;

/// Where the numbers of an exercise come from.
pub(super) struct Chosen {
    random: Random,
}

impl Chosen {
    pub(super) fn new(seed: u64) -> Self {
        let mut random = Random(seed);
        // Seeds beside each other have first numbers beside each other.
        random.unit();
        Chosen { random }
    }

    /// A whole number between two, these included.
    pub(super) fn whole(&mut self, [low, high]: [i64; 2]) -> i64 {
        let count = (high - low + 1).max(1);
        low + ((self.random.unit() * count as f64) as i64).min(count - 1)
    }

    /// The robot with a value for each parameter that has none: lengths in steps of 5 cm, no two alike while there are others.
    pub(super) fn with_values(&mut self, description: &Description) -> Description {
        let mut valued = description.clone();
        let mut taken: Vec<i64> = vec![];
        for p in valued.parameters.iter_mut().filter(|p| p.value.is_none()) {
            p.value = Some(match description.measure(p.symbol) {
                Measure::Length => {
                    let mut steps = self.whole(LENGTHS);
                    for _ in 0..LENGTHS[1] {
                        if taken.contains(&steps) {
                            steps = if steps == LENGTHS[1] { LENGTHS[0] } else { steps + 1 };
                        }
                    }
                    taken.push(steps);
                    Expr::from(Rational::new(steps, PARTS))
                }
                Measure::Angle => Expr::int(self.whole([1, 5]) * ANGLE) * Expr::pi() / Expr::int(180),
                // Masses that an exercise gave its arm.
                Measure::Other("kg") if p.symbol.name().starts_with('m') => Expr::int(self.whole([1, 5])),
                Measure::Other(_) => continue,
            });
        }
        valued
    }

    /// A configuration of round values within the limits, radians and metres; not 0 where another is to be had.
    fn configuration(&mut self, space: &JointSpace) -> Vec<f64> {
        let mut q = vec![];
        for (&is_angle, limits) in space.is_angle.iter().zip(&space.limits) {
            let step = if is_angle { (ANGLE as f64).to_radians() } else { 1.0 / PARTS as f64 };
            let free = if is_angle { [1 - 180 / ANGLE, 180 / ANGLE - 1] } else { LENGTHS };
            let [low, high] = match limits {
                Some([low, high]) => {
                    let bounds = [(low / step - 1e-9).ceil() as i64, (high / step + 1e-9).floor() as i64];
                    if is_angle { [bounds[0].max(free[0]), bounds[1].min(free[1])] } else { bounds }
                }
                None => free,
            };
            if low > high {
                q.push(limits.map_or(0.0, |[low, high]| f64::midpoint(low, high)));
                continue;
            }
            let mut steps = self.whole([low, high]);
            if steps == 0 {
                steps = if high > 0 { self.whole([1, high]) } else { low };
            }
            q.push(if is_angle {
                ((steps * ANGLE) as f64).to_radians()
            } else {
                steps as f64 / PARTS as f64
            });
        }
        q
    }

    /// So many configurations in which the arm can move in all its directions, and that `serve`.
    pub(super) fn configurations(
        &mut self,
        description: &Description,
        count: usize,
        mut serves: impl FnMut(&[f64]) -> bool,
    ) -> Result<Vec<Vec<f64>>, NoExercise> {
        let robot = Robot::numeric(description).map_err(NoExercise::Values)?;
        let space = JointSpace::new(description, &robot);
        let length = robot.reach().max(1e-9);
        let mut drawn = vec![];
        for _ in 0..DRAWN {
            let q = self.configuration(&space);
            let jacobian = geometric(&robot, &q, &Viewpoint::tool());
            let values = measures(&jacobian, &space.is_angle, length).whole.singular_values;
            drawn.push((q, values));
        }
        // Directions that the arm never has do not count.
        let rank = |values: &[f64]| values.iter().filter(|s| **s > 1e-6 * values[0].max(1e-12)).count();
        let rank = drawn.iter().map(|(_, values)| rank(values)).max().unwrap_or(0);
        let least =
            |values: &[f64]| if rank == 0 { 1.0 } else { values.get(rank - 1).copied().unwrap_or(0.0) };
        let best = drawn.iter().map(|(_, values)| least(values)).fold(0.0, f64::max);
        let mut found: Vec<Vec<f64>> = vec![];
        for (q, values) in drawn {
            if found.len() == count {
                break;
            }
            if least(&values) >= REGULAR * best && !found.contains(&q) && serves(&q) {
                found.push(q);
            }
        }
        if found.len() < count {
            return Err(NoExercise::Configurations { found: found.len(), asked: count });
        }
        Ok(found)
    }

    /// Velocities of the joints, rad/s and m/s, none 0.
    pub(super) fn rates(&mut self, space: &JointSpace) -> Vec<f64> {
        let mut rate = |is_angle: &bool| {
            let steps = self.whole([1, 5]) * if self.random.unit() < 0.5 { -1 } else { 1 };
            steps as f64 / if *is_angle { 10.0 } else { PARTS as f64 }
        };
        space.is_angle.iter().map(&mut rate).collect()
    }

    /// A component of a force, N, not 0.
    pub(super) fn force(&mut self) -> f64 {
        let size = 5 * self.whole([1, 10]);
        (if self.random.unit() < 0.5 { -size } else { size }) as f64
    }

    /// The greatest speed and acceleration of a joint, in degrees or metres.
    pub(super) fn limits(&mut self, is_angle: bool) -> [f64; 2] {
        match is_angle {
            true => [(self.whole([2, 8]) * 15) as f64, (self.whole([2, 8]) * 30) as f64],
            false => [self.whole([2, 8]) as f64 / PARTS as f64, self.whole([4, 16]) as f64 / PARTS as f64],
        }
    }

    /// Quarter turns and lengths, by which a drawing is easy to read; one entry a joint.
    pub(super) fn quarters(&mut self, space: &JointSpace) -> Vec<Expr> {
        let one = |is_angle: &bool| match is_angle {
            true => Expr::int(self.whole([-1, 2])) * Expr::pi() / Expr::int(2),
            false => Expr::from(Rational::new(self.whole(LENGTHS), PARTS)),
        };
        space.is_angle.iter().map(one).collect()
    }
}
