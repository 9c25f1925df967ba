//! `denavit convert`: a robot in another format, read back and held against itself.

use crate::arguments::{ConvertArguments, ConvertFormat};
use crate::commands::fk::without_values;
use crate::commands::report::put;
use crate::failure::Failure;
use crate::load::{self, Tree};
use crate::terminal::note;
use denavit::description::{
    Alone, AxesAs, Convention, Decimals, Described, Description, Mechanism, NoPar, NotNamed, RowTree,
    TableKind, TableOptions, read_mjcf, read_par, read_robot, read_table, read_toml, read_urdf, write_axes,
    write_mjcf, write_par, write_table, write_toml, write_tree, write_urdf,
};
use denavit::mechanism::{COMPARED, Comparison, compare};

/// Writes a robot in another format.
///
/// # Errors
/// If there is no such robot, a parameter has no value, or nothing can be written.
pub fn run(arguments: &ConvertArguments) -> Result<(), Failure> {
    if matches!(arguments.to, ConvertFormat::Par | ConvertFormat::Tree)
        && let Some(whole) = load::mechanism(&arguments.robot)?
    {
        return tree(&whole, arguments);
    }
    let robot = load::robot(&arguments.robot)?;
    let converted = match arguments.written_as {
        Some(to) => robot.converted(to.into()).description,
        None => robot.clone(),
    };
    let (text, back) = match arguments.to {
        ConvertFormat::Toml => {
            let text = write_toml(&converted);
            let back = read_toml(&text).ok().map(|r| r.0);
            (text, back)
        }
        ConvertFormat::Urdf => {
            let text = write_urdf(&converted)
                .map_err(|missing| no_values(missing.iter().map(|s| s.name().to_string())))?;
            let read = read_urdf(&text, Decimals::Meant).ok();
            let chain = read.and_then(|(m, _)| m.chain(Some("base"), Some("tool"), robot.convention).ok());
            (text, chain.map(|c| c.description))
        }
        ConvertFormat::Mjcf => {
            let bodies = Mechanism::of(&converted)
                .map_err(|missing| no_values(missing.iter().map(|s| s.name().to_string())))?;
            let text = write_mjcf(&bodies);
            let read = read_mjcf("written", &text, &mut Alone, Decimals::Meant).0.ok();
            let chain = read.and_then(|(m, _)| m.chain(Some("base"), Some("tool"), robot.convention).ok());
            (text, chain.map(|c| c.description))
        }
        ConvertFormat::Axes => axes(&converted, AxesAs::Lines, arguments)?,
        ConvertFormat::Poe => axes(&converted, AxesAs::Screws, arguments)?,
        ConvertFormat::BodyPoe => axes(&converted, AxesAs::BodyScrews, arguments)?,
        ConvertFormat::Par => {
            let file = write_par(&converted.as_tree()).map_err(no_par)?;
            let end = file.last.to_string();
            let back = read_par(&file.text, Decimals::Meant).ok();
            let chain = back.and_then(|(t, _)| t.chain(None, Some(&end), robot.convention).ok());
            (file.text, chain.map(|c| c.description))
        }
        ConvertFormat::Tree => {
            let text = write_tree(&converted.as_tree());
            let back = read_toml(&text).ok().map(|r| r.0);
            (text, back)
        }
        ConvertFormat::Markdown => table(&converted, TableKind::Markdown)?,
        ConvertFormat::Latex => table(&converted, TableKind::Latex)?,
        ConvertFormat::Csv => table(&converted, TableKind::Csv)?,
    };
    put(&arguments.output, text.as_bytes())?;
    say_same(&robot, back.as_ref());
    Ok(())
}

/// What was written, and what it reads back to.
type Written = (String, Option<Description>);

/// A robot file by its axes.
fn axes(robot: &Description, written: AxesAs, arguments: &ConvertArguments) -> Result<Written, Failure> {
    let text = write_axes(robot, written)
        .map_err(|missing| without_values(robot, &arguments.robot.robot, &missing))?;
    let back = read_toml(&text).ok().map(|r| r.0);
    if robot.rows.iter().any(|r| r.mass.is_some() || r.inertia.is_some()) {
        note("note: masses and inertias have no place in a file of axes");
    }
    Ok((text, back))
}

/// All of a tree, written as rows; every chain from its root to an end is read back and compared.
fn tree(whole: &Tree, arguments: &ConvertArguments) -> Result<(), Failure> {
    if arguments.written_as.is_some_and(|to| Convention::from(to) != Convention::Khalil) {
        return Err(Failure::Usage("--as: a tree stands in the convention khalil".into()));
    }
    let rows = match whole {
        Tree::Bodies(m) => {
            RowTree::of_mechanism(m).map_err(|_| Failure::Input("error: an axis has no direction".into()))?
        }
        Tree::Rows(rows) => rows.clone(),
    };
    // The ends of chains, and what they are called in what is written.
    let (text, named): (String, Vec<(String, String)>) = match arguments.to {
        ConvertFormat::Par => {
            let file = write_par(&rows).map_err(no_par)?;
            (file.text, file.frames.into_iter().map(|(name, row)| (name, row.to_string())).collect())
        }
        _ => (write_tree(&rows), rows.frame_names().into_iter().map(|n| (n.clone(), n)).collect()),
    };
    put(&arguments.output, text.as_bytes())?;
    let back = match arguments.to {
        ConvertFormat::Par => read_par(&text, Decimals::Meant).ok().map(|r| r.0),
        _ => match read_robot(&text) {
            Ok((Described::Tree(tree), _)) => Some(*tree),
            _ => None,
        },
    };
    let Some(back) = back else {
        note("note: what was written was not held against the robot: it does not read back as a tree");
        return Ok(());
    };
    let (mut proved, mut sampled, mut most, mut open) = (0, 0, 0.0_f64, 0);
    for (end, there) in &named {
        let one = match whole {
            Tree::Bodies(m) => m.chain(None, Some(end), Convention::Khalil).map(|c| {
                // What follows a joint beside the way counts by itself there, as that joint in rows.
                let follows = c.joints.iter().any(|&j| m.joints[j].follows.is_some());
                (!follows).then_some(c.description)
            }),
            Tree::Rows(rows) => rows.chain(None, Some(end), Convention::Khalil).map(|c| Some(c.description)),
        };
        let Ok(one) = one else { continue };
        let Some(one) = one else {
            open += 1;
            continue;
        };
        match back.chain(None, Some(there), Convention::Khalil).map(|c| compare(&one, &c.description)) {
            Ok(Comparison::Proved) => proved += 1,
            Ok(Comparison::Sampled(by)) => (sampled, most) = (sampled + 1, most.max(by)),
            _ => open += 1,
        }
    }
    let mut said =
        format!("note: read back, {proved} of {} chains are proved to be the same", proved + sampled + open);
    if sampled > 0 {
        said += &format!(", {sampled} differ by {most:.0e} at most in {COMPARED} configurations");
    }
    if open > 0 {
        said += &format!(", {open} were not compared");
    }
    note(&said);
    Ok(())
}

fn no_par(why: NoPar) -> Failure {
    Failure::Input(match why {
        NoPar::Follows(row) => {
            format!(
                "error: `{row}` follows other joints, and a .par file has no words for that\n  = hint: name a chain without it by --base and --tip, or write --to tree"
            )
        }
        NoPar::NotNamed(NotNamed::NeedsValues(names)) => {
            return no_values(names.iter().map(|s| s.name().to_string()));
        }
        NoPar::NotNamed(NotNamed::NotPlaced(_)) => {
            "error: base or tool is no rigid transform in numbers".into()
        }
    })
}

/// A table for documents.
fn table(robot: &Description, kind: TableKind) -> Result<Written, Failure> {
    let text = write_table(robot, kind).map_err(|why| match why {
        NotNamed::NeedsValues(names) => no_values(names.iter().map(|s| s.name().to_string())),
        NotNamed::NotPlaced(_) => {
            Failure::Input("error: base or tool is no rigid transform in numbers".into())
        }
    })?;
    let back = read_table(&text, kind, &TableOptions::default()).ok().map(|r| r.0);
    Ok((text, back))
}

fn no_values(names: impl Iterator<Item = String>) -> Failure {
    let names: Vec<String> = names.collect();
    Failure::Input(format!("error: no value for {}; give it with --set", names.join(", ")))
}

/// Says how what was written is the robot.
fn say_same(robot: &Description, back: Option<&Description>) {
    let Some(back) = back else {
        return note(
            "note: what was written was not held against the robot: it does not read back as one chain",
        );
    };
    note(&match compare(robot, back) {
        Comparison::Proved => "note: read back, it is proved to be the same robot".to_string(),
        Comparison::Sampled(by) => {
            format!("note: read back, its poses differ by {by:.0e} at most in {COMPARED} configurations")
        }
        Comparison::OtherJoints => "note: read back, it has other joints than the robot".into(),
        Comparison::NoNumbers(missing) => {
            format!("note: what was written was not held against the robot: {missing}")
        }
    });
}
