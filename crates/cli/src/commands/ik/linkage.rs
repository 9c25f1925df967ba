//! `ik` of closed loops that are no serial chain: the driven joints, in every assembly mode, with which the tip is where it is wanted.

use super::pose;
use crate::arguments::IkArguments;
use crate::commands::fk::linkage::{assemblies, at, configuration};
use crate::commands::fk::plural;
use crate::failure::{Failure, without_values};
use crate::terminal::{Align, HEADING, note, styled, table};
use denavit::closure::{ClosedAnswer, ClosedInverse, ClosedSolution, NoInverse};
use denavit::description::Linkage;
use denavit::description::linkage::Wanted;
use denavit::inverse::Goal;
use denavit::quantity::reading;
use denavit::space::JointSpace;
use denavit_symbolic::Symbol;
use denavit_wire::linkage::Reached;
use std::io::Write;

/// Solves a pose.
///
/// # Errors
/// If something is asked that is for serial chains, the pose cannot be read, a length has no value, or no configuration is found.
pub fn run(arguments: &IkArguments, linkage: &Linkage) -> Result<(), Failure> {
    let goal = arguments.goal();
    let wanted = match goal {
        Goal::Pose => Some(Wanted::Pose),
        Goal::Position => Some(Wanted::Position),
        _ => None,
    };
    let given = [
        (wanted.is_none(), "--goal"),
        (arguments.robot.mode.is_some() && arguments.q.is_none(), "--mode with --pose"),
        (arguments.input.is_some(), "--input"),
        (arguments.given.is_some(), "--given"),
        (arguments.near.is_some(), "--near"),
        (arguments.best.is_some(), "--best"),
        (arguments.limits, "--limits"),
        (arguments.one, "--one"),
        (arguments.idealise.is_some(), "--idealise"),
        (arguments.explain, "--explain"),
        (arguments.symbolic, "--symbolic"),
        (arguments.certificate.is_some(), "--certificate"),
    ];
    if let Some((_, option)) = given.into_iter().find(|g| g.0) {
        return Err(Failure::Unsupported(format!("{option} for closed loops that are no serial chain")));
    }
    let wanted = wanted.unwrap_or(Wanted::Pose);
    let inverse = ClosedInverse::new(linkage, arguments.robot.tip.as_deref(), wanted);
    let inverse = inverse.map_err(|why| match why {
        NoInverse::Missing(missing) => without_values(&linkage.all_rows(), &arguments.robot.robot, &missing),
        NoInverse::Frame(why) => Failure::Usage(why.to_string()),
    })?;
    let loops = inverse.loops();
    let pose = match (&arguments.q, &arguments.pose) {
        (Some(_), _) => {
            let q = configuration(linkage, arguments.q.as_deref())?;
            let found = assemblies(loops, arguments.robot.mode.as_deref(), &q)?;
            let (_, place) =
                loops.place(arguments.robot.tip.as_deref()).map_err(|why| Failure::Usage(why.to_string()))?;
            let meant = loops.mode(None).ok();
            let first = found.all.iter().find(|a| Some(&a.mode) == meant.as_ref()).unwrap_or(&found.all[0]);
            if found.all.len() > 1 {
                note(&format!("note: the pose is that of the mode {} at {}", first.mode, at(linkage, &q)));
            }
            loops.pose(&place, &q, &first.passive)
        }
        (None, Some(text)) => pose::read(text, &arguments.orientation, goal)?,
        (None, None) => {
            return Err(Failure::Unsupported(
                "a derivation for closed loops that are no serial chain\n  = hint: --pose, or -q, asks for numbers"
                    .into(),
            ));
        }
    };
    let answer = inverse.solve(&pose);
    let rows = linkage.all_rows();
    let (space, variables) = (JointSpace::without_lengths(&rows), rows.variables());
    for (k, s) in answer.solutions.iter().enumerate() {
        let all = s.q.iter().chain(&s.passive).zip(linkage.driven().into_iter().chain(linkage.passive()));
        let is_beyond = |x: f64, of: Symbol| {
            let joint = variables.iter().position(|v| v.symbol == of);
            joint.is_some_and(|j| space.turns(j, x).is_none())
        };
        let names: Vec<String> =
            all.filter(|(x, v)| is_beyond(**x, v.symbol)).map(|(_, v)| v.symbol.name().to_string()).collect();
        if !names.is_empty() {
            note(&format!("warning: configuration {}: {} outside the limits", k + 1, names.join(", ")));
        }
    }
    let word = if wanted == Wanted::Pose { "pose" } else { "position" };
    let name = &linkage.tree.name;
    let mut out = anstream::stdout();
    if arguments.json {
        let answer = Reached::of(name, inverse.tip(), word, &pose, &answer);
        writeln!(out, "{}", denavit_wire::text(&answer))?;
    } else if !answer.is_out_of_plane {
        write!(out, "{}", text(linkage, inverse.tip(), word, &answer))?;
    }
    if !answer.solutions.is_empty() {
        return Ok(());
    }
    Err(Failure::No(match (answer.is_out_of_plane, answer.is_complete) {
        (true, _) => format!("`{}` moves in a plane, and this is not in it", inverse.tip()),
        (_, true) => "not reachable: no assembly of the loops gets there".into(),
        (_, false) => "nothing was found, which does not prove that there is nothing".into(),
    }))
}

fn text(linkage: &Linkage, tip: &str, goal: &str, answer: &ClosedAnswer) -> String {
    let (driven, passive) = (linkage.driven(), linkage.passive());
    let how = match (answer.is_complete, answer.is_closed_form) {
        (true, _) => "all there are, in closed form",
        (false, true) => "in closed form; there may be more",
        (false, false) => "by Newton's method from many starts; there may be more",
    };
    let mut text = format!(
        "{}: {} with `{tip}` at this {goal}, {how}\n",
        styled(&linkage.tree.name, HEADING),
        plural(answer.solutions.len(), "configuration")
    );
    if answer.solutions.is_empty() {
        return text;
    }
    let names: Vec<String> = driven.iter().chain(&passive).map(|v| v.symbol.name().to_string()).collect();
    let mut header: Vec<&str> = names.iter().map(String::as_str).collect();
    header.insert(0, "mode");
    header.push("residual");
    let mut align = vec![Align::Right; header.len()];
    align[0] = Align::Left;
    let row = |s: &ClosedSolution| {
        let all = s.q.iter().chain(&s.passive).zip(driven.iter().chain(&passive));
        let values = all.map(|(&x, v)| reading(x, v.kind)).collect();
        let mode = s.mode.as_ref().map_or("?".into(), ToString::to_string);
        [vec![mode], values, vec![format!("{:.0e}", s.residual)]].concat()
    };
    let rows: Vec<Vec<String>> = answer.solutions.iter().map(row).collect();
    text += &format!("\n{}", table(&header, &align, &rows));
    let singular: Vec<String> =
        (1..).zip(&answer.solutions).filter(|(_, s)| s.is_singular).map(|(k, _)| k.to_string()).collect();
    if !singular.is_empty() {
        text += &format!("  not isolated, singular or one of a family: {}\n", singular.join(", "));
    }
    text
}
