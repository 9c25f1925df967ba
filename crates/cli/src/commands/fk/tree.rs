//! `fk --frames` of a tree: where all its bodies are, or those that are named.

use super::answer::{Answers, transforms};
use super::{plural, stream, value, warn_of_limits};
use crate::arguments::FkArguments;
use crate::failure::Failure;
use crate::load::{self, Tree};
use crate::terminal::{Align, HEADING, noise, number, styled, table};
use denavit::description::{Convention, Joint, JointKind, Mechanism, NoChain};
use denavit::geometry::Transform;
use denavit::geometry::orientation::{OrientationSet, extract};
use denavit::quantity::reading;
use std::io::Write;

/// Answers for the bodies that a list names, or for all of them; nothing if they are named and one is not there.
///
/// # Errors
/// If a parameter has no value, the configuration cannot be read, or nothing can be written.
pub fn run(arguments: &FkArguments, tree: &Tree, frames: &str) -> Option<Result<(), Failure>> {
    let name = &arguments.robot.robot;
    let mechanism = match bodies(tree, name) {
        Ok(mechanism) => mechanism,
        Err(failure) => return Some(Err(failure)),
    };
    let bodies: Vec<usize> = match frames {
        "all" => (0..mechanism.bodies.len()).collect(),
        text => named(&mechanism, text)?,
    };
    Some(answer(arguments, &mechanism, &bodies))
}

/// The bodies that a list names, each once; a name may hold commas.
fn named(m: &Mechanism, text: &str) -> Option<Vec<usize>> {
    let all = || text.split(',').map(|word| m.body(word.trim())).collect::<Option<Vec<usize>>>();
    let mut once: Vec<usize> = vec![];
    for body in m.body(text.trim()).map(|b| vec![b]).or_else(all)? {
        if !once.contains(&body) {
            once.push(body);
        }
    }
    Some(once)
}

/// That a list names what is not there.
pub fn unknown(tree: &Tree, text: &str) -> Failure {
    let missing = |word: &str| {
        let why = match tree {
            Tree::Bodies(m) => m.chain(None, Some(word), Convention::Standard).err(),
            Tree::Rows(rows) => rows.chain(None, Some(word), Convention::Khalil).err(),
        };
        why.filter(|why| matches!(why, NoChain::Unknown { .. }))
    };
    let why = text.split(',').find_map(|word| missing(word.trim()));
    Failure::Usage(format!(
        "--frames {text}: {}",
        why.map_or("there is no such link".into(), |w| w.to_string())
    ))
}

fn answer(arguments: &FkArguments, mechanism: &Mechanism, bodies: &[usize]) -> Result<(), Failure> {
    if arguments.orientation.is_some() {
        return Err(Failure::Usage("--orientation is for one chain: name its end with --tip".into()));
    }
    let answers = Answers::of_tree(mechanism, bodies);
    match (&arguments.input, &arguments.q) {
        (Some(path), _) => stream::run(answers, path),
        (None, text) => {
            let q = configuration(mechanism, text.as_deref())?;
            let limits = mechanism.variable_limits();
            for ((joint, &x), ends) in joints(mechanism).into_iter().zip(&q).zip(limits) {
                warn_of_limits(&joint.name, kind(joint), ends, x);
            }
            let results = answers.function.scalar().eval(&q).to_vec();
            let mut out = anstream::stdout();
            if arguments.json {
                let mut text = vec![];
                answers.write(&q, &results, &mut text);
                out.write_all(&text)?;
            } else {
                write!(out, "{}", report(mechanism, bodies, &q, &results))?;
            }
            Ok(())
        }
    }
}

/// A tree as bodies.
///
/// # Errors
/// If a parameter of its rows has no value.
pub fn bodies(tree: &Tree, name: &str) -> Result<Mechanism, Failure> {
    match tree {
        Tree::Bodies(m) => Ok(m.clone()),
        Tree::Rows(rows) => {
            rows.mechanism().map_err(|missing| Failure::Input(format!("error: {name}: {missing}")))
        }
    }
}

/// How a joint that moves does.
pub fn kind(joint: &Joint) -> JointKind {
    joint.kind.unwrap_or(JointKind::Revolute)
}

/// The joints that move by themselves.
pub fn joints(m: &Mechanism) -> Vec<&Joint> {
    m.variables().into_iter().map(|j| &m.joints[j]).collect()
}

/// Values of all joints in order, or `NAME=VALUE` for some, the others at 0.
///
/// # Errors
/// If they cannot be read.
pub fn configuration(m: &Mechanism, text: Option<&str>) -> Result<Vec<f64>, Failure> {
    let joints = joints(m);
    let names = || joints.iter().map(|j| j.name.as_str()).collect::<Vec<_>>().join(", ");
    let bad = |why: String| Failure::Usage(format!("-q: {why}"));
    let Some(text) = text.or(joints.is_empty().then_some("")) else {
        let example = joints.first().map_or("joint", |j| j.name.as_str());
        return Err(Failure::Usage(format!(
            "say where the joints are: -q with {}, or with some by name, as in -q \"{example}=0.5\" (the others are at 0): {}",
            plural(joints.len(), "value"),
            names()
        )));
    };
    if let Some((_, values)) = m.poses.iter().find(|p| p.0 == text.trim()) {
        return values.iter().map(|&e| value(e)).collect::<Result<_, _>>().map_err(bad);
    }
    let parts = load::list(text);
    let number = |joint: &Joint, text: &str| {
        load::value_of(text, kind(joint).into())
            .and_then(value)
            .map_err(|why| format!("{}: {why}", joint.name))
    };
    if !text.contains('=') {
        if parts.len() != joints.len() {
            let (given, wanted) = (plural(parts.len(), "value"), plural(joints.len(), "joint"));
            return Err(bad(format!("{given} given, the tree has {wanted}: {}", names())));
        }
        let values: Result<Vec<f64>, String> = joints.iter().zip(&parts).map(|(j, t)| number(j, t)).collect();
        return values.map_err(bad);
    }
    let mut q: Vec<Option<f64>> = vec![None; joints.len()];
    // Names may hold blanks.
    for part in text.split([',', ';']).map(str::trim) {
        let Some((name, text)) = part.split_once('=') else {
            return Err(bad(format!("`{part}`: write NAME=VALUE")));
        };
        let Some(at) = joints.iter().position(|j| j.name == name.trim()) else {
            let other = m.joints.iter().find(|j| j.name == name.trim());
            if let Some(follows) = other.and_then(|j| j.follows.as_ref()) {
                let leader = &m.joints[follows.joint].name;
                return Err(bad(format!("`{}` follows `{leader}`: give that one its value", name.trim())));
            }
            return Err(bad(format!("no joint `{}` moves by itself; they are {}", name.trim(), names())));
        };
        if q[at].replace(number(joints[at], text.trim()).map_err(bad)?).is_some() {
            return Err(bad(format!("{} is given twice", name.trim())));
        }
    }
    Ok(q.into_iter().map(Option::unwrap_or_default).collect())
}

/// The answer for reading: a line a body.
fn report(m: &Mechanism, bodies: &[usize], q: &[f64], results: &[f64]) -> String {
    let moved = joints(m).into_iter().zip(q).filter(|(_, x)| **x != 0.0);
    let at: Vec<String> = moved.map(|(j, &x)| format!("{} = {}", j.name, reading(x, kind(j)))).collect();
    let at = match (at.is_empty(), q.is_empty()) {
        (_, true) => " (no joint moves)".to_string(),
        (true, false) => " at all joints at 0".to_string(),
        (false, false) => format!(" at {}", at.join(", ")),
    };
    let poses: Vec<Transform<f64>> = transforms(results).collect();
    let rounding = noise(&poses);
    let row = |(body, x): (&denavit::description::Body, &Transform<f64>)| {
        let rpy = extract(&x.rotation, OrientationSet::Rpy).values;
        let angle = |x: f64| reading(x, JointKind::Revolute);
        let place = x.translation.0.map(|e| number(e, rounding));
        [vec![body.name.clone()], place.to_vec(), rpy.into_iter().map(angle).collect()].concat()
    };
    let rows: Vec<Vec<String>> = bodies.iter().map(|&b| &m.bodies[b]).zip(&poses).map(row).collect();
    let header = ["frame", "x", "y", "z", "roll", "pitch", "yaw"];
    let mut align = vec![Align::Right; header.len()];
    align[0] = Align::Left;
    format!("{}{at}\n\n{}", styled(&m.name, HEADING), table(&header, &align, &rows))
}
