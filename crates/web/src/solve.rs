//! All configurations that bring the hand to a pose.

use crate::refusal::Refusal;
use crate::scene::{Bodies, bodies};
use crate::subject::Subject;
use crate::words;
use denavit::geometry::Transform;
use denavit::inverse::{Family, JointSpace, Members, Nearest, Obstacle, Solution};
use denavit_report::words::Inverse as _;
use denavit_wire::inverse as wire;
use denavit_wire::pose::{Matrix, matrix};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A pose, or the one of a configuration; what is near to where the arm is comes first to mind.
#[derive(Deserialize)]
pub struct Wish {
    pose: Option<Vec<Vec<f64>>>,
    q: Option<Vec<f64>>,
    near: Option<Vec<f64>>,
    /// One solution near to where the arm is will do.
    #[serde(default)]
    quick: bool,
}

/// All that was found for a pose. An arm that cannot take it has the solutions of the nearest pose that it can.
#[derive(Serialize)]
pub struct Found {
    complete: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    doubt: Option<String>,
    families: Vec<wire::Family>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    given: BTreeMap<String, f64>,
    /// Which solution, from 0, the nearest is a copy of.
    #[serde(skip_serializing_if = "Option::is_none")]
    index: Option<usize>,
    method: &'static str,
    /// What is said and drawn of each family.
    motions: Vec<Motion>,
    #[serde(skip_serializing_if = "Option::is_none")]
    nearest: Option<wire::Nearest>,
    #[serde(skip_serializing_if = "Option::is_none")]
    obstacle: Option<wire::Obstacle>,
    pose: Matrix,
    /// Each solution as it is drawn.
    scenes: Vec<Bodies>,
    solutions: Vec<wire::Solution>,
    status: &'static str,
    /// What stands in the way, and where the arm is instead.
    #[serde(skip_serializing_if = "Option::is_none")]
    stop: Option<Stop>,
}

/// A family as it is shown.
#[derive(Serialize)]
struct Motion {
    /// Whether it comes back to where it began.
    closed: bool,
    scene: Bodies,
    words: String,
}

/// Where an arm ends that cannot take the pose.
#[derive(Serialize)]
struct Stop {
    pose: Matrix,
    scene: Bodies,
    words: String,
}

/// All solutions of the pose.
///
/// # Errors
/// If there is no pose in it, or the robot cannot be solved.
pub fn solve(subject: &mut Subject, wish: &Wish) -> Result<Found, Refusal> {
    let asked = match (&wish.pose, &wish.q) {
        (Some(rows), _) => pose(rows)?,
        (None, Some(q)) => subject.robot.pose(subject.configuration(q)?),
        (None, None) => return Err(Refusal::new("a pose, or a configuration that has it, is needed")),
    };
    let near = match &wish.near {
        Some(q) => subject.configuration(q)?.to_vec(),
        None => subject.space.middle(),
    };
    let solver = subject.solver()?;
    solver.seed = Some(near.clone());
    let given: Vec<f64> = solver.given.iter().map(|&j| near[j]).collect();
    let answer = match wish.quick {
        true => solver.one(&asked, &given, Some(&near)),
        false => solver.solve(&asked, &given),
    };
    let (method, own) = (solver.method(), solver.given.clone());
    // An arm that cannot take the pose is followed to the nearest that it can.
    let (shown, target) = match &answer.obstacle {
        Some(o) if !answer.is_reachable() => {
            let nearest = solver.robot.pose(&o.q);
            let given: Vec<f64> = solver.given.iter().map(|&j| o.q[j]).collect();
            (solver.solve(&nearest, &given), nearest)
        }
        _ => (answer.clone(), asked),
    };
    let nearest = match &shown.solutions[..] {
        [one] if wish.quick => Some(copy(&solver.space, one, &near)),
        _ => solver.nearest(&target, &shown, &near),
    };
    let members: Vec<_> = shown.families.iter().map(|f| solver.members(&target, f)).collect();
    let obstacle = answer.obstacle.as_ref().filter(|_| !answer.is_reachable());
    let variables = subject.valued.variables();
    let name = |j: &usize| variables[*j].symbol.name().to_string();
    let is_nearest = |s: &Solution| nearest.as_ref().is_some_and(|n| subject.space.is_same(&s.q, &n.q));
    let along = |(f, m): (&Family, &Members)| wire::Family {
        curve: m.members.clone(),
        ..wire::Family::of(f, &subject.space)
    };
    let families = || shown.families.iter().zip(&members);
    Ok(Found {
        complete: answer.is_complete(),
        doubt: wire::doubt(&answer),
        families: families().map(along).collect(),
        given: own.iter().map(name).zip(given).collect(),
        index: shown.solutions.iter().position(is_nearest),
        method,
        motions: families().map(|(f, m)| motion(subject, f, m)).collect(),
        nearest: nearest.as_ref().map(wire::Nearest::of),
        obstacle: obstacle.map(wire::Obstacle::from),
        pose: matrix(&asked),
        scenes: shown.solutions.iter().map(|s| bodies(&subject.arm.at(&s.q))).collect(),
        solutions: shown.solutions.iter().map(|s| wire::Solution::of(s, &subject.space)).collect(),
        status: wire::status(&answer),
        stop: obstacle.map(|o| Stop {
            pose: matrix(&target),
            scene: bodies(&subject.arm.at(&o.q)),
            words: why(o),
        }),
    })
}

/// Why there is no solution.
fn why(found: &Obstacle) -> String {
    let why = words().obstacle(found);
    let conditions: Vec<&str> = found.violated.iter().map(|v| v.0.as_str()).collect();
    match conditions[..] {
        [] => why,
        _ => format!("{why}; {}", words().violated(&conditions)),
    }
}

/// The copy of a solution, whole turns away, that is nearest to where the arm is.
fn copy(space: &JointSpace, s: &Solution, near: &[f64]) -> Nearest {
    let q = space.nearest_copy(&s.q, near);
    let distance = space.distance(&q, near);
    Nearest { q, distance, within_limits: s.within_limits }
}

fn motion(subject: &Subject, f: &Family, along: &Members) -> Motion {
    let variables = subject.valued.variables();
    let largest = f.direction.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let moving = variables.iter().zip(&f.direction).filter(|(_, x)| x.abs() > 1e-9 * largest);
    let parts: Vec<String> = moving
        .map(|(v, x)| format!("{} by {}", v.symbol.name(), denavit_report::decimals(x / largest, 4)))
        .collect();
    let where_ = match (f.is_affine, f.dimension) {
        (true, _) => ", in these proportions everywhere",
        (false, 1) => ", in these proportions here",
        _ => "",
    };
    Motion {
        closed: along.is_closed,
        scene: bodies(&subject.arm.at(&f.representative.q)),
        words: format!("the hand stands still while the joints move: {}{where_}", parts.join(", ")),
    }
}

/// A pose from rows of rows.
///
/// # Errors
/// If it is none.
pub fn pose(rows: &[Vec<f64>]) -> Result<Transform<f64>, Refusal> {
    let row = |r: usize| -> Option<[f64; 4]> { rows.get(r)?.clone().try_into().ok() };
    let four = || Some([row(0)?, row(1)?, row(2)?, row(3)?]);
    let rows = four().ok_or_else(|| Refusal::new("a pose has four rows of four numbers"))?;
    Transform::from_matrix(rows).map_err(|why| Refusal::new(why.to_string()))
}
