//! All configurations that bring the hand to a pose.

use crate::refusal::Refusal;
use crate::scene::{bodies, matrix};
use crate::subject::Subject;
use crate::words;
use denavit::geometry::Transform;
use denavit::inverse::{Answer, Family, JointSpace, Members, Nearest, Obstacle, Solution};
use denavit_report::words::Inverse as _;
use serde::Deserialize;
use serde_json::{Value, json};

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

/// All solutions of the pose.
///
/// # Errors
/// If there is no pose in it, or the robot cannot be solved.
pub fn solve(subject: &mut Subject, wish: &Wish) -> Result<Value, Refusal> {
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
    let mut value = json!({
        "pose": matrix(&asked),
        "method": solver.method(),
        "given": solver.given.iter().zip(&given).map(|(j, x)| json!({ "joint": j, "value": x })).collect::<Vec<_>>(),
    });
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
    if let (Some(o), false) = (&answer.obstacle, answer.is_reachable()) {
        value["obstacle"] = json!({
            "words": obstacle(o),
            "q": o.q,
            "pose": matrix(&target),
            "angle": o.angle,
            "distance": o.distance,
            "scene": bodies(&subject.arm.at(&o.q)),
        });
    }
    let shown: &Answer = &shown;
    value["complete"] = answer.is_complete().into();
    if let Some(doubt) = answer.doubt {
        value["doubt"] = words().doubt(doubt).into();
    }
    value["solutions"] = shown.solutions.iter().map(|s| solution(subject, s)).collect();
    let families = shown.families.iter().zip(&members);
    value["families"] = families.map(|(f, m)| family(subject, f, m)).collect();
    if let Some(n) = nearest {
        let is_same = |s: &Solution| subject.space.is_same(&s.q, &n.q);
        value["nearest"] = json!({
            "q": n.q,
            "distance": n.distance,
            "withinLimits": n.within_limits,
            "index": shown.solutions.iter().position(is_same),
        });
    }
    Ok(value)
}

/// Why there is no solution.
fn obstacle(found: &Obstacle) -> String {
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

fn solution(subject: &Subject, s: &Solution) -> Value {
    json!({
        "q": s.q,
        "branch": s.branch.to_string(),
        "residual": s.residual,
        "multiplicity": s.multiplicity,
        "withinLimits": s.within_limits,
        "scene": bodies(&subject.arm.at(&s.q)),
    })
}

fn family(subject: &Subject, f: &Family, along: &Members) -> Value {
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
    json!({
        "free": f.free,
        "words": format!("the hand stands still while the joints move: {}{where_}", parts.join(", ")),
        "dimension": f.dimension,
        "direction": f.direction,
        "representative": solution(subject, &f.representative),
        "curve": along.members,
        "closed": along.is_closed,
    })
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
