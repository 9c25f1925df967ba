//! Configurations at which one factor of a determinant is 0 and the others are not.

use crate::description::Description;
use crate::mechanism::Robot;
use crate::random::Random;
use denavit_symbolic::{Expr, Symbol};

/// Random starts.
const STARTS: usize = 40;
/// Newton steps from each.
const STEPS: usize = 50;
/// The other factors are not smaller than this, of their usual size.
const APART: f64 = 0.05;

/// A configuration of a robot at which `factor` is 0 and the other factors are not, near another if there is one; lengths
/// without value are those of [`Description::filled`].
pub fn singular_configuration(
    description: &Description,
    factor: Expr,
    factors: &[Expr],
    near: &[f64],
) -> Option<Vec<f64>> {
    Finder::new(description).find(factor, factors, Some(near)).map(|found| found.1)
}

/// Finds configurations of a robot, with lengths of its own where it gives none.
pub struct Finder {
    robot: Option<Robot<f64>>,
    values: Vec<(Symbol, f64)>,
    variables: Vec<Symbol>,
}

impl Finder {
    /// For a robot.
    pub fn new(description: &Description) -> Self {
        let with_values = description.filled();
        Finder {
            robot: Robot::numeric(&with_values).ok(),
            values: with_values.known_values(),
            variables: description.variables().iter().map(|v| v.symbol).collect(),
        }
    }

    /// A configuration at which `factor` is 0 and the other factors are not, with the robot's lengths there; from `near`,
    /// if that leads to one.
    pub fn find(&self, factor: Expr, all: &[Expr], near: Option<&[f64]>) -> Option<(Robot<f64>, Vec<f64>)> {
        let robot = self.robot.clone()?;
        let mut random = Random(11);
        let anywhere =
            (0..STARTS).map(|_| self.variables.iter().map(|_| 4.0 * random.unit() - 2.0).collect());
        for start in near.map(<[f64]>::to_vec).into_iter().chain(anywhere) {
            let Some(q) = self.newton(factor, start) else { continue };
            let others = all.iter().filter(|&&f| f != factor);
            let mut sizes = others.map(|&f| self.value(f, &q).abs());
            if sizes.all(|s| s > APART * robot.reach().min(1.0)) {
                return Some((robot, q));
            }
        }
        None
    }

    /// Configurations to start from.
    pub fn starts(&self, count: usize) -> Vec<Vec<f64>> {
        let mut random = Random(17);
        (0..count).map(|_| self.variables.iter().map(|_| 6.0 * random.unit() - 3.0).collect()).collect()
    }

    fn value(&self, e: Expr, q: &[f64]) -> f64 {
        let joint = |s: Symbol| self.variables.iter().position(|&v| v == s).map(|j| q[j]);
        let parameter = |s: Symbol| self.values.iter().find(|v| v.0 == s).map(|v| v.1);
        e.eval(|s| joint(s).or_else(|| parameter(s))).unwrap_or(f64::NAN)
    }

    /// The zero that Newton's method finds along the gradient; even zeros are approached slowly, but they are reached.
    fn newton(&self, factor: Expr, mut q: Vec<f64>) -> Option<Vec<f64>> {
        for _ in 0..STEPS {
            let value = self.value(factor, &q);
            if value.abs() < 1e-14 {
                return Some(q);
            }
            let slope = |j: usize| {
                let at = |by: f64| {
                    let mut q = q.clone();
                    q[j] += by;
                    self.value(factor, &q)
                };
                (at(1e-6) - at(-1e-6)) / 2e-6
            };
            let gradient: Vec<f64> = (0..q.len()).map(slope).collect();
            let square: f64 = gradient.iter().map(|g| g * g).sum();
            if !value.is_finite() || square < 1e-30 {
                return None;
            }
            let step = (value / square).clamp(-0.5 / square.sqrt(), 0.5 / square.sqrt());
            q.iter_mut().zip(&gradient).for_each(|(x, g)| *x -= step * g);
        }
        (self.value(factor, &q).abs() < 1e-12).then_some(q)
    }
}
