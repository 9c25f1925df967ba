//! Singular configurations in numbers, for arms whose determinant is not had as a formula.

use super::{Example, example};
use crate::description::Description;
use crate::geometry::Vector;
use crate::mechanism::Robot;
use crate::random::Random;
use crate::space::JointSpace;
use crate::velocity::geometric::Viewpoint;
use crate::velocity::nearest::Slope;
use denavit_program::MissingValue;
use denavit_symbolic::Expr;

/// Descents, and joints that move in all of them together.
const STARTS: usize = 48;
const MOVED: usize = 480;
/// Configurations that are listed.
const LISTED: usize = 6;
/// Of the motion of the joint that moves the most, radians or metres.
const MUCH: f64 = 0.1;

/// Singular configurations that descents from configurations all over lead to, with what happens there: one of each kind
/// that is found, the commonest first, six at most. They are examples, and there are others beside each of them. With
/// `rows` [0, 1, 2] those of the position, with all six those of the body.
///
/// # Errors
/// If a parameter has no value.
pub fn singular_configurations(
    description: &Description,
    view: &Viewpoint<Expr>,
    rows: &[usize],
) -> Result<Vec<Example>, MissingValue> {
    let robot = Robot::numeric(description)?;
    let space = JointSpace::new(description, &robot);
    let (is_angle, length) = (&space.is_angle[..], space.length());
    // Where the rank drops does not depend on the point of the body: it is taken at an origin.
    let at_origin = Viewpoint { axes: view.axes, body: view.body, at: view.at, offset: Vector::zero() };
    let slope = Slope { robot: &robot, view: &at_origin, is_angle, length, rows };
    let mut random = Random(23);
    let mut drawn = |j: usize| {
        let half = space.half_range(j);
        let [low, high] = space.limits[j].unwrap_or([-half, half]);
        low + (high - low) * random.unit()
    };
    let count = STARTS.min(MOVED / robot.joints.max(1)).max(2);
    let mut found: Vec<(Example, usize)> = vec![];
    for _ in 0..count {
        let start: Vec<f64> = (0..robot.joints).map(&mut drawn).collect();
        let Some(singular) = slope.descend(&start, &start) else { continue };
        let mut q = singular.q;
        space.wrap(&mut q);
        let one = example(description, &robot, view, rows, q);
        match found.iter_mut().find(|(other, _)| one.place == other.place && moving(&one) == moving(other)) {
            Some((_, times)) => *times += 1,
            None => found.push((one, 1)),
        }
    }
    found.sort_by_key(|(_, times)| std::cmp::Reverse(*times));
    Ok(found.into_iter().map(|f| f.0).take(LISTED).collect())
}

/// The joints that move by much where one does that moves the most.
fn moving(example: &Example) -> Vec<Vec<usize>> {
    let of = |free: &Vec<f64>| (0..free.len()).filter(|&j| free[j].abs() > MUCH).collect();
    example.free.iter().map(of).collect()
}
