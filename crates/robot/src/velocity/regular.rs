//! Configurations where the arm can move in all its directions.

use super::geometric::{Viewpoint, geometric};
use super::measures::measures;
use crate::description::Description;
use crate::mechanism::Robot;
use crate::space::JointSpace;

/// Below this part of the largest value found an example counts as singular.
const SINGULAR: f64 = 0.02;
/// Turns that are tried instead, degrees.
const TURNS: [[i32; 5]; 4] =
    [[0, 25, -40, 20, 35], [20, -35, 50, 30, -45], [-30, 40, 60, -35, 50], [45, 30, -70, 55, 40]];

/// A configuration that is not singular, as far as the arm has one: the one that is `shown` (radians and metres, one entry a
/// joint), or one beside it, within the limits. The one that is shown if a parameter of the robot has no value.
pub fn regular_configuration(description: &Description, shown: Vec<f64>) -> Vec<f64> {
    let Ok(robot) = Robot::numeric(description) else { return shown };
    let space = JointSpace::new(description, &robot);
    let length = robot.reach().max(1e-9);
    let turned = |turns: &[i32; 5]| -> Vec<f64> {
        let turn = |(j, x): (usize, &f64)| match space.is_angle[j] {
            true => x + f64::from(turns[j % 5]).to_radians(),
            false => *x,
        };
        shown.iter().enumerate().map(turn).collect()
    };
    let all: Vec<Vec<f64>> = [shown.clone()].into_iter().chain(TURNS.iter().map(turned)).collect();
    let value = |q: &Vec<f64>| {
        let jacobian = geometric(&robot, q, &Viewpoint::tool());
        measures(&jacobian, &space.is_angle, length).whole.singular_values
    };
    let values: Vec<Vec<f64>> = all.iter().map(value).collect();
    // Directions that the arm never has do not count.
    let rank =
        values.iter().map(|v| v.iter().filter(|s| **s > 1e-6 * v[0].max(1e-12)).count()).max().unwrap_or(0);
    let least = |k: usize| if rank == 0 { 0.0 } else { values[k].get(rank - 1).copied().unwrap_or(0.0) };
    let best = (0..all.len()).map(least).fold(0.0, f64::max);
    let within =
        |q: &Vec<f64>| q.iter().zip(&space.limits).all(|(x, l)| l.is_none_or(|[a, b]| a <= *x && *x <= b));
    let chosen =
        (0..all.len()).find(|&k| (k == 0 || within(&all[k])) && least(k) >= SINGULAR * best.max(1e-12));
    all.into_iter().nth(chosen.unwrap_or(0)).unwrap_or(shown)
}
