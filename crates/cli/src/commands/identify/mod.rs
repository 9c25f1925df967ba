//! `denavit identify`: base parameters, friction and masses that can be from recorded motion and torques; motions that show them.

mod excite;
mod report;

use crate::arguments::{IdentifyArguments, PriorName};
use crate::commands::check::recording::{ends_in, say_remarks, whole_table, write_whole};
use crate::commands::dynamics::gravity;
use crate::commands::dynamics::tree::unknown;
use crate::commands::fk::tree::{bodies, kind};
use crate::commands::fk::value;
use crate::failure::{Failure, without_values};
use crate::load::{self, Around};
use crate::terminal::note;
use denavit::description::{Description, JointKind, Measure, write_toml};
use denavit::dynamics::{Dynamics, OfTree};
use denavit::geometry::Body;
use denavit_identification::{
    Asked, Column, Columns, Cutoff, Joints, Known, Model, NoModel, NoPlace, Options, Prior, Roles, Sought,
    Told, consistent, described, identify, words,
};
use denavit_wire::identification as wire;
use std::io::Write;

/// What parameters are sought of.
pub struct Subject {
    /// What it is called.
    pub name: String,
    /// The description of an arm, with gravity as it is asked for; none of a whole tree.
    pub description: Option<Description>,
    /// Its torques.
    pub model: Model,
    /// The names of its joint variables.
    pub names: Vec<String>,
    /// The joints by the names that columns may have.
    joints: Joints,
    /// The masses of a tree.
    given: Option<Vec<Body<f64>>>,
}

/// Identifies from recordings, or searches a motion for it.
///
/// # Errors
/// 1 if a recording is suspect, 3 if something cannot be read, 4 for closed loops.
pub fn run(arguments: &IdentifyArguments) -> Result<(), Failure> {
    let subject = if arguments.whole { tree(arguments)? } else { arm(arguments)? };
    if let Some(output) = &arguments.output {
        match arguments.excite {
            true => ends_in(output, &["csv"], "the motion")?,
            false => ends_in(output, &["toml"], "the robot")?,
        }
    }
    if arguments.excite {
        return excite::run(&subject, arguments);
    }
    let joints = &subject.joints;
    let told = told(arguments, subject.names.len())?;
    let in_degrees = Told { degrees: true, ..told.clone() };
    let mut shown: Option<(Roles, wire::Roles)> = None;
    // As they are said, and with angles without unit in degrees where these may be.
    let mut parts: Vec<(Columns, Option<Columns>)> = vec![];
    let mut recordings = vec![];
    for file in &arguments.data {
        let name = file.to_string_lossy().into_owned();
        let failed = |e: &dyn std::fmt::Display| Failure::Input(format!("error: {name}: {e}"));
        let table = whole_table(file)?;
        say_remarks(&name, &table);
        let all: Vec<Column> = table
            .columns
            .into_iter()
            .map(|c| Column { name: c.name, unit: c.unit, values: c.values })
            .collect();
        let mut roles = Roles::find(&all, joints, &told).map_err(|e| failed(&e))?;
        for (text, columns) in [
            (&arguments.velocities, &mut roles.velocities),
            (&arguments.accelerations, &mut roles.accelerations),
        ] {
            if text.as_deref() == Some("none") {
                columns.clear();
            }
        }
        let columns = roles.columns(&all, joints, &told).map_err(|e| failed(&e))?;
        let may_be_degrees = roles.may_be_degrees(&all, joints, &told);
        let in_degrees = may_be_degrees.then(|| roles.columns(&all, joints, &in_degrees));
        let in_degrees = in_degrees.transpose().map_err(|e| failed(&e))?;
        if let Some((first, _)) = parts.first() {
            are_alike(first, &columns).map_err(|why| failed(&why))?;
        }
        parts.push((columns, in_degrees));
        recordings.push(name);
        shown.get_or_insert_with(|| (roles.clone(), named(&roles, &all)));
    }
    let Some((roles, names)) = shown else {
        return Err(Failure::Usage("say which recording: denavit identify ROBOT data.csv".into()));
    };
    let in_degrees = parts.iter().any(|p| p.1.is_some()).then(|| {
        let part = |(plain, degrees): &(Columns, Option<Columns>)| degrees.as_ref().unwrap_or(plain).clone();
        joined(parts.iter().map(part))
    });
    let columns = joined(parts.into_iter().map(|p| p.0));
    let asked = Asked {
        cutoff: cutoff(arguments.cutoff.as_deref())?,
        options: Options { robust: arguments.robust, reduce: arguments.reduce },
        in_degrees: in_degrees.as_ref(),
    };
    let found = identify(&subject.model, &columns, &asked).map_err(|why| {
        Failure::Input(format!(
            "error: {}: {}",
            recordings.join(", "),
            words::no_motion(&subject.names, &why)
        ))
    })?;
    let is_suspect = !found.suspects.is_empty();
    let prior = prior(&subject, arguments)?;
    let set = (!is_suspect).then(|| consistent(&subject.model, &found.estimate, &prior));
    let set = set.as_ref();
    let text = if arguments.json {
        let names_of = &subject.names;
        let set = set.map(|s| (s, &prior));
        let robot = &subject.name;
        let answer =
            wire::Identified::of(robot, recordings.clone(), &subject.model, names_of, names, &found, set);
        format!("{}\n", denavit_wire::text(&answer))
    } else {
        let shown =
            report::Shown { subject: &subject, recordings: &recordings, roles: &roles, columns: &names };
        report::text(&shown, &found, set.map(|s| (s, &prior)))
    };
    write!(anstream::stdout(), "{text}")?;
    if is_suspect {
        let left = if arguments.output.is_some() { ", and no file is written" } else { "" };
        return Err(Failure::No(format!(
            "the recording is not one of this arm as it stands: see above{left}"
        )));
    }
    if !found.estimate.known.iter().any(|known| matches!(known, Known::Value(..))) {
        let why = "this motion tells nothing of any parameter: see above, and no file is written";
        return Err(Failure::No(why.into()));
    }
    if let (Some(file), Some(set), Some(description)) = (&arguments.output, set, &subject.description) {
        let all = described(description, &subject.model, set).map_err(|why| match why {
            NoPlace::TwoInOne(row) => Failure::Unsupported(format!(
                "writing masses for row {}, which turns and slides: it has one body for two links",
                row + 1
            )),
            NoPlace::NoValues => Failure::Input("error: lengths have no values".into()),
        })?;
        write_whole(file, &write_toml(&all))?;
        if set.offsets.iter().any(|x| *x != 0.0) {
            note(&format!("note: {}: offsets of torques have no place in a robot file", file.display()));
        }
    }
    if set.is_some_and(|s| !s.is_settled) {
        return Err(Failure::GaveUp("the search for masses that can be did not come to its end".into()));
    }
    Ok(())
}

/// The arm that the arguments name, and its torques.
fn arm(arguments: &IdentifyArguments) -> Result<Subject, Failure> {
    let robot = &arguments.robot;
    if load::without_chain(robot)?.is_some() {
        return Err(Failure::Unsupported(
            "identification of closed loops whose passive joints are not couplings of the driven ones".into(),
        ));
    }
    let (mut description, around) = load::robot_and_around(robot)?;
    if let Around::Rows(chain) = &around
        && let Some(closed) = chain.closed.as_ref().filter(|c| !c.beside.is_empty())
    {
        return Err(Failure::Unsupported(format!(
            "identification of closed loops with links beside the chain: the masses of {} have a part in the torques",
            closed.beside.join(", ")
        )));
    }
    let held = around.held_joints();
    if !held.is_empty() {
        note(&format!(
            "note: what hangs on the chain behind {} counts as part of its links: hold these joints still",
            held.join(", ")
        ));
    }
    if let Some(text) = &arguments.gravity {
        description.gravity = Some(gravity(text)?);
    }
    let model = Model::new(&description, sought(arguments)?).map_err(|why| match why {
        NoModel::Missing(missing) => without_values(&description, &robot.robot, &missing),
        NoModel::NoJoints | NoModel::Groupings => Failure::Input(format!("error: {}: {why}", robot.robot)),
    })?;
    let names: Vec<String> = description.variables().iter().map(|v| v.symbol.name().to_string()).collect();
    let joints = joints_of(&description, &names);
    let name = description.name.clone();
    Ok(Subject { name, description: Some(description), model, names, joints, given: None })
}

/// The tree that the arguments name, all its joints at once.
fn tree(arguments: &IdentifyArguments) -> Result<Subject, Failure> {
    let file = &arguments.robot.robot;
    let found = load::mechanism(&arguments.robot)?
        .ok_or_else(|| Failure::Usage(format!("--whole: {file} is no tree: leave it away")))?;
    let mut m = bodies(&found, file)?;
    if let Some(text) = &arguments.gravity {
        m.gravity = Some(gravity(text)?);
    }
    let numbers = OfTree::new(&m).map_err(|why| unknown(file, &why))?;
    let exact = OfTree::exact(&m).map_err(|why| unknown(file, &why))?;
    let model = Model::of_tree(&exact, &numbers, sought(arguments)?)
        .map_err(|why| Failure::Input(format!("error: {file}: {why}")))?;
    let moving = crate::commands::fk::tree::joints(&m);
    let names: Vec<String> = moving.iter().map(|j| j.name.clone()).collect();
    let numbered = (1..=names.len()).map(|k| format!("q{k}")).collect();
    let turns = moving.iter().map(|j| kind(j) == JointKind::Revolute).collect();
    Ok(Subject {
        name: m.name.clone(),
        description: None,
        model,
        joints: Joints { names: vec![names.clone(), numbered], turns },
        names,
        given: Some(numbers.dynamics.links.iter().map(|l| l.body).collect()),
    })
}

fn sought(arguments: &IdentifyArguments) -> Result<Sought, Failure> {
    let mut sought = Sought { rotors: arguments.rotors, viscous: false, coulomb: false, offsets: false };
    for part in arguments.friction.split(',').map(str::trim).filter(|p| !p.is_empty() && *p != "none") {
        match part {
            "viscous" => sought.viscous = true,
            "coulomb" => sought.coulomb = true,
            "offset" => sought.offsets = true,
            _ => {
                return Err(Failure::Usage(format!(
                    "--friction {part}: some of viscous, coulomb, offset, with commas, or none"
                )));
            }
        }
    }
    Ok(sought)
}

/// The joints by the names that columns may have.
fn joints_of(d: &Description, names: &[String]) -> Joints {
    let variables = d.variables();
    let own = |v: &denavit::description::Variable| {
        let row = d.rows.iter().find(|r| r.variable.is_some_and(|x| x.symbol == v.symbol))?;
        row.name.clone()
    };
    let given: Option<Vec<String>> = variables.iter().map(own).collect();
    Joints {
        names: [names.to_vec()].into_iter().chain(given).collect(),
        turns: variables.iter().map(|v| v.kind == JointKind::Revolute).collect(),
    }
}

fn told(arguments: &IdentifyArguments, joints: usize) -> Result<Told, Failure> {
    let gains = arguments.gains.as_deref().map(|text| -> Result<Vec<f64>, Failure> {
        let wrong = |why: String| Failure::Usage(format!("--gains {text}: {why}"));
        let number = |part: &str| load::value_of(part, Measure::Other("")).and_then(value).map_err(wrong);
        let all = load::list(text).into_iter().map(number).collect::<Result<Vec<f64>, _>>()?;
        match all.len() {
            1 => Ok(all),
            n if n == joints => Ok(all),
            n => Err(wrong(format!("{n} values; one for all, or one for each of {joints} joints"))),
        }
    });
    let unless_none = |text: &Option<String>| text.clone().filter(|t| t != "none");
    Ok(Told {
        time: arguments.time.clone(),
        joints: arguments.joints.clone(),
        velocities: unless_none(&arguments.velocities),
        accelerations: unless_none(&arguments.accelerations),
        torques: arguments.torques.clone(),
        gains: gains.transpose()?,
        rate: arguments.rate,
        degrees: arguments.degrees,
    })
}

fn cutoff(text: Option<&str>) -> Result<Cutoff, Failure> {
    let Some(text) = text else { return Ok(Cutoff::Found) };
    if text.trim() == "none" {
        return Ok(Cutoff::None);
    }
    let plain = text.trim().trim_end_matches("Hz").trim();
    match plain.parse::<f64>() {
        Ok(f) if f.is_finite() && f > 0.0 => Ok(Cutoff::At(f)),
        _ => Err(Failure::Usage(format!("--cutoff {text}: a frequency in Hz above 0, or none"))),
    }
}

/// Whether two recordings have the same columns.
fn are_alike(first: &Columns, more: &Columns) -> Result<(), &'static str> {
    match first.qd.is_some() == more.qd.is_some() && first.qdd.is_some() == more.qdd.is_some() {
        true => Ok(()),
        false => Err(
            "it has velocities or accelerations, and the first has not, or the other way round\n  = hint: --velocities none --accelerations none",
        ),
    }
}

/// Recordings that are alike, one behind the other.
fn joined(mut parts: impl Iterator<Item = Columns>) -> Columns {
    let mut all = parts.next().unwrap_or_default();
    let append = |all: &mut Vec<Vec<f64>>, more: Vec<Vec<f64>>| {
        all.iter_mut().zip(more).for_each(|(a, m)| a.extend(m));
    };
    for more in parts {
        let rows = all.time.len();
        all.starts.push(rows);
        all.starts.extend(more.starts.iter().map(|r| r + rows));
        all.time.extend(more.time);
        append(&mut all.q, more.q);
        append(&mut all.tau, more.tau);
        for (all, more) in [(&mut all.qd, more.qd), (&mut all.qdd, more.qdd)] {
            all.as_mut().zip(more).into_iter().for_each(|(all, more)| append(all, more));
        }
    }
    all
}

fn named(roles: &Roles, all: &[Column]) -> wire::Roles {
    let of = |columns: &[usize]| columns.iter().map(|&c| all[c].name.clone()).collect();
    wire::Roles {
        accelerations: of(&roles.accelerations),
        joints: of(&roles.joints),
        time: roles.time.map(|c| all[c].name.clone()),
        torques: of(&roles.torques),
        velocities: of(&roles.velocities),
    }
}

/// What masses are to be near to.
fn prior(subject: &Subject, arguments: &IdentifyArguments) -> Result<Prior, Failure> {
    let given = || -> Result<Vec<Body<f64>>, Failure> {
        if let Some(given) = &subject.given {
            return Ok(given.clone());
        }
        let Some(description) = &subject.description else { return Ok(vec![]) };
        let arm: Dynamics<f64> = crate::commands::dynamics::numeric(description, &arguments.robot.robot)?;
        Ok(arm.links.iter().map(|l| l.body).collect())
    };
    let has_masses = subject.description.as_ref().is_none_or(Description::has_masses);
    match arguments.prior {
        Some(PriorName::Neutral) => Ok(Prior::Neutral),
        Some(PriorName::File) => given().map(Prior::Given),
        None if !has_masses => Ok(Prior::Neutral),
        None => given().map(Prior::Given),
    }
}
