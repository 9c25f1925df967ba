//! What path is asked for.

use crate::arguments::PathArguments;
use crate::commands::fk::configuration;
use crate::commands::ik::pose;
use crate::failure::Failure;
use denavit::Robot;
use denavit::description::Description;
use denavit::geometry::{Transform, Vector};
use denavit::inverse::Goal;
use denavit::motion::hand::{Arc, HandChain, HandPath, Line, Orientation, PoseSpline};
use denavit::motion::plan::Wish;
use serde_json::Value;
use std::path::Path;

/// Reads the way-points.
///
/// # Errors
/// If one cannot be read, or there is none.
pub fn read(
    description: &Description,
    robot: &Robot<f64>,
    arguments: &PathArguments,
) -> Result<Wish, Failure> {
    let start = arguments.q.as_deref().map(|text| configuration(description, text)).transpose()?;
    let from = match (&start, &arguments.from) {
        (Some(q), _) => Some(robot.pose(q)),
        (None, Some(text)) => Some(a_pose(text, arguments, None)?),
        (None, None) => None,
    };
    let needed =
        || Failure::Usage("say where the path starts: -q with the joints, or --from with a pose".into());
    if !arguments.joint.is_empty() {
        let mut points = vec![start.ok_or_else(needed)?];
        for text in &arguments.joint {
            points.push(configuration(description, text)?);
        }
        return Ok(Wish::Joints(points));
    }
    if let Some(file) = &arguments.via {
        return via(description, robot, file, start);
    }
    let mut here = from.ok_or_else(needed)?;
    let mut parts: Vec<Box<dyn HandPath + Send + Sync>> = vec![];
    let orientation = if arguments.screw { Orientation::Screw } else { Orientation::Slerp };
    for text in &arguments.line {
        let to = a_pose(text, arguments, Some(&here))?;
        parts.push(Box::new(Line { from: here, to, orientation }));
        here = to;
    }
    for text in &arguments.arc {
        let (middle, end) = text.split_once("->").ok_or_else(|| {
            Failure::Usage(format!(
                "--arc {text}: a point and a pose, as in \"0.4,0.1,0.3 -> 0.4,0,0.2,0,180deg,0\""
            ))
        })?;
        let via = point(middle, &here)?;
        let to = a_pose(end, arguments, Some(&here))?;
        let arc = Arc::new(here, via, to).map_err(|e| Failure::Usage(format!("--arc: {e}")))?;
        parts.push(Box::new(arc));
        here = to;
    }
    if parts.is_empty() {
        return Err(Failure::Usage("say where the path goes: --line, --arc, --joint or --via".into()));
    }
    let path: Box<dyn HandPath + Send + Sync> =
        if parts.len() == 1 { parts.remove(0) } else { Box::new(HandChain::new(parts)) };
    Ok(Wish::Hand { path, start })
}

/// A pose, or with a plus sign in front a displacement along the base's axes from the one before.
fn a_pose(
    text: &str,
    arguments: &PathArguments,
    before: Option<&Transform<f64>>,
) -> Result<Transform<f64>, Failure> {
    let named = |e: Failure| match e {
        Failure::Usage(why) => {
            let why = why.replacen("--pose: ", "", 1);
            Failure::Usage(format!(
                "`{text}`: {why}, or a displacement with a plus in front, as in +0.1,0,-0.2"
            ))
        }
        other => other,
    };
    match (text.trim().strip_prefix('+'), before) {
        (Some(rest), Some(before)) => {
            let by = pose::read(rest, &arguments.orientation, Goal::Position).map_err(named)?;
            Ok(Transform::from_rotation_translation(before.rotation, before.translation + by.translation))
        }
        _ => pose::read(text.trim(), &arguments.orientation, Goal::Pose).map_err(named),
    }
}

fn point(text: &str, here: &Transform<f64>) -> Result<Vector<f64>, Failure> {
    let (relative, text) = match text.trim().strip_prefix('+') {
        Some(rest) => (true, rest),
        None => (false, text.trim()),
    };
    let read = pose::read(text, "rpy", Goal::Position)?.translation;
    Ok(if relative { here.translation + read } else { read })
}

/// Way-points line by line: arrays of joint variables, or 4×4 matrices.
fn via(
    description: &Description,
    robot: &Robot<f64>,
    file: &Path,
    start: Option<Vec<f64>>,
) -> Result<Wish, Failure> {
    let named = file.display();
    let text = if file.as_os_str() == "-" {
        std::io::read_to_string(std::io::stdin())?
    } else {
        std::fs::read_to_string(file).map_err(|e| Failure::Input(format!("error: {named}: {e}")))?
    };
    let n = description.variables().len();
    let (mut joints, mut poses, mut errors) = (vec![], vec![], vec![]);
    for (k, line) in text.lines().enumerate().filter(|(_, l)| !l.trim().is_empty()) {
        match way_point(line, n) {
            Ok(WayPoint::Joints(q)) => joints.push(q),
            Ok(WayPoint::Pose(x)) => poses.push(x),
            Err(why) => errors.push(format!("error: {named}:{}: {why}", k + 1)),
        }
    }
    if !joints.is_empty() && !poses.is_empty() {
        errors.push(format!("error: {named}: joint variables and poses are mixed"));
    }
    if !errors.is_empty() {
        return Err(Failure::Input(errors.join("\n")));
    }
    if poses.is_empty() {
        let mut points: Vec<Vec<f64>> = start.into_iter().collect();
        points.extend(joints);
        if points.len() < 2 {
            return Err(Failure::Input(format!("error: {named}: a path needs two way-points")));
        }
        return Ok(Wish::Joints(points));
    }
    if let Some(q) = &start {
        let own = robot.pose(q);
        let first = &poses[0];
        let is_same = (own.translation - first.translation).norm() < 1e-9
            && own
                .matrix()
                .iter()
                .flatten()
                .zip(first.matrix().iter().flatten())
                .all(|(a, b)| (a - b).abs() < 1e-9);
        if !is_same {
            poses.insert(0, own);
        }
    }
    let spline = PoseSpline::new(poses).ok_or_else(|| {
        Failure::Input(format!(
            "error: {named}: a spline needs two poses, and no two in a row may be the same"
        ))
    })?;
    Ok(Wish::Hand { path: Box::new(spline), start })
}

enum WayPoint {
    Joints(Vec<f64>),
    Pose(Transform<f64>),
}

fn way_point(line: &str, joints: usize) -> Result<WayPoint, String> {
    let value: Value = serde_json::from_str(line.trim()).map_err(|e| format!("not JSON: {e}"))?;
    if value[0].is_array() {
        return pose::matrix(&value).map(WayPoint::Pose);
    }
    let numbers: Option<Vec<f64>> = value.as_array().and_then(|a| a.iter().map(Value::as_f64).collect());
    match numbers {
        Some(q) if q.len() == joints => Ok(WayPoint::Joints(q)),
        Some(q) => Err(format!("{} values, the robot has {joints} joints", q.len())),
        None => Err("neither an array of joint variables nor a 4×4 matrix".into()),
    }
}
