//! `denavit convert`: a robot in another format, read back and held against itself.

use crate::arguments::{ConvertArguments, ConvertFormat};
use crate::commands::fk::without_values;
use crate::commands::report::put;
use crate::failure::Failure;
use crate::load::{self, Tree};
use crate::terminal::note;
use denavit::description::{
    Alone, AxesAs, Convention, Decimals, Described, Description, Mechanism, NoPar, NotNamed, Row, RowTree,
    TableKind, TableOptions, read_mjcf, read_par, read_robot, read_table, read_table_robot, read_toml,
    read_urdf, refused_masses, write_axes, write_mjcf, write_par, write_table, write_toml, write_tree,
    write_tree_table, write_urdf,
};
use denavit::mechanism::{COMPARED, Comparison, compare, compare_chains};
use denavit_symbolic::Expr;

/// Writes a robot in another format.
///
/// # Errors
/// If there is no such robot, a parameter has no value, nothing can be written, or what was written is not the robot.
pub fn run(arguments: &ConvertArguments) -> Result<(), Failure> {
    let is_whole = matches!(arguments.to, ConvertFormat::Par | ConvertFormat::Tree);
    if arguments.whole && !is_whole && table_kind(arguments.to).is_none() {
        return Err(Failure::Usage("--whole is for tables: markdown, latex and csv".into()));
    }
    if (is_whole || arguments.whole)
        && let Some(whole) = load::mechanism(&arguments.robot)?
    {
        return tree(&whole, arguments);
    }
    let robot = load::robot(&arguments.robot)?;
    let converted = match arguments.written_as {
        Some(to) => robot.converted(to.into()).description,
        None => robot.clone(),
    };
    say_left(&converted, arguments.to);
    let Written { text, back } = written(&robot, &converted, arguments)?;
    put(&arguments.output, text.as_bytes())?;
    say_same(&robot, &back, arguments.robot.as_written)
}

/// Says what of masses, drives and gravity has no place in a format.
fn say_left(d: &Description, to: ConvertFormat) {
    let any = |of: fn(&Row) -> bool| d.rows.iter().any(of);
    let is_known = |e: Expr| e.symbols().iter().all(|s| d.value(*s).is_some());
    let (masses, rotors, friction) =
        (d.has_masses(), any(|r| r.rotor.is_some()), any(|r| r.viscous.is_some() || r.coulomb.is_some()));
    let gravity = d.gravity.is_some();
    let given = [(masses, "masses"), (rotors, "rotors"), (friction, "friction"), (gravity, "gravity")];
    let (has_place, what): ([bool; 4], &str) = match to {
        ConvertFormat::Toml | ConvertFormat::Tree => return,
        ConvertFormat::Urdf => ([true, false, true, false], "a URDF"),
        ConvertFormat::Mjcf => ([true; 4], "a model"),
        ConvertFormat::Axes | ConvertFormat::Poe | ConvertFormat::BodyPoe => ([false; 4], "a file of axes"),
        ConvertFormat::Par => ([false; 4], "what is written of a .par file"),
        ConvertFormat::Markdown | ConvertFormat::Latex | ConvertFormat::Csv => ([false; 4], "a table"),
    };
    let left: Vec<&str> = given.iter().zip(has_place).filter(|(g, p)| g.0 && !p).map(|(g, _)| g.1).collect();
    if !left.is_empty() {
        note(&format!("note: left out, as {what} has no place for it: {}", left.join(", ")));
    }
    let is_open = || d.rows.iter().flat_map(Row::mass_cells).any(|cell| !is_known(cell.1));
    if matches!(to, ConvertFormat::Urdf | ConvertFormat::Mjcf) && is_open() {
        note("note: masses and drives without a value are left out");
    }
}

/// Says which masses MuJoCo refuses.
fn say_refused(bodies: &Mechanism) {
    let refused = refused_masses(bodies);
    if !refused.is_empty() {
        let names = refused.join(", ");
        note(&format!(
            "warning: MuJoCo refuses the masses of {names}, which no bodies have: they are left out"
        ));
    }
    let moves = bodies.joints.iter().any(|j| j.kind.is_some() && bodies.bodies[j.child].mass.is_none());
    if moves {
        note("note: a link without a mass has that of its solids in MuJoCo, 1000 kg/m³");
    }
}

/// What was written, and how it is read back.
struct Written {
    text: String,
    back: Back,
}

/// What a text is read back to, if to one chain.
enum Back {
    /// There is one way to read it.
    Alone(Option<Box<Description>>),
    /// With the decimals of angles as they are meant, or as they are written.
    ByDecimals(Box<dyn Fn(Decimals) -> Option<Description>>),
}

fn written(
    robot: &Description,
    converted: &Description,
    arguments: &ConvertArguments,
) -> Result<Written, Failure> {
    let convention = robot.convention;
    let alone =
        |text: String, back: Option<Description>| Written { text, back: Back::Alone(back.map(Box::new)) };
    Ok(match arguments.to {
        ConvertFormat::Toml => {
            let text = write_toml(converted);
            let back = read_toml(&text).ok().map(|r| r.0);
            alone(text, back)
        }
        ConvertFormat::Urdf => {
            let text = write_urdf(converted).map_err(|missing| no_values(missing.parameters.into_iter()))?;
            let copy = text.clone();
            let back = move |decimals| {
                let (m, _) = read_urdf(&copy, decimals).ok()?;
                Some(m.chain(Some("base"), Some("tool"), convention).ok()?.description)
            };
            Written { text, back: Back::ByDecimals(Box::new(back)) }
        }
        ConvertFormat::Mjcf => {
            let bodies =
                Mechanism::of(converted).map_err(|missing| no_values(missing.parameters.into_iter()))?;
            say_refused(&bodies);
            let text = write_mjcf(&bodies);
            let copy = text.clone();
            let back = move |decimals| {
                let (m, _) = read_mjcf("written", &copy, &mut Alone, decimals).0.ok()?;
                Some(m.chain(Some("base"), Some("tool"), convention).ok()?.description)
            };
            Written { text, back: Back::ByDecimals(Box::new(back)) }
        }
        ConvertFormat::Axes => axes(converted, AxesAs::Lines, arguments)?,
        ConvertFormat::Poe => axes(converted, AxesAs::Screws, arguments)?,
        ConvertFormat::BodyPoe => axes(converted, AxesAs::BodyScrews, arguments)?,
        ConvertFormat::Par => {
            let file = write_par(&converted.as_tree()).map_err(no_par)?;
            let (copy, end) = (file.text.clone(), file.last.to_string());
            let back = move |decimals| {
                let (tree, _) = read_par(&copy, decimals).ok()?;
                Some(tree.chain(None, Some(&end), convention).ok()?.description)
            };
            Written { text: file.text, back: Back::ByDecimals(Box::new(back)) }
        }
        ConvertFormat::Tree => {
            let text = write_tree(&converted.as_tree());
            let back = read_toml(&text).ok().map(|r| r.0);
            alone(text, back)
        }
        ConvertFormat::Markdown => table(converted, TableKind::Markdown)?,
        ConvertFormat::Latex => table(converted, TableKind::Latex)?,
        ConvertFormat::Csv => table(converted, TableKind::Csv)?,
    })
}

/// The kind of table that is written, if one is.
fn table_kind(to: ConvertFormat) -> Option<TableKind> {
    match to {
        ConvertFormat::Markdown => Some(TableKind::Markdown),
        ConvertFormat::Latex => Some(TableKind::Latex),
        ConvertFormat::Csv => Some(TableKind::Csv),
        _ => None,
    }
}

/// A robot file by its axes.
fn axes(robot: &Description, written: AxesAs, arguments: &ConvertArguments) -> Result<Written, Failure> {
    let text = write_axes(robot, written)
        .map_err(|missing| without_values(robot, &arguments.robot.robot, &missing))?;
    let back = read_toml(&text).ok().map(|r| r.0);
    Ok(Written { text, back: Back::Alone(back.map(Box::new)) })
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
    let kind = table_kind(arguments.to);
    let (text, named): (String, Vec<(String, String)>) = match (arguments.to, kind) {
        (_, Some(kind)) => write_tree_table(&rows, kind).map_err(not_named)?,
        (ConvertFormat::Par, _) => {
            let file = write_par(&rows).map_err(no_par)?;
            (file.text, file.frames.into_iter().map(|(name, row)| (name, row.to_string())).collect())
        }
        _ => (write_tree(&rows), rows.frame_names().into_iter().map(|n| (n.clone(), n)).collect()),
    };
    put(&arguments.output, text.as_bytes())?;
    say_left(&rows.all_rows(), arguments.to);
    let read = |decimals| {
        let described = match (arguments.to, kind) {
            (ConvertFormat::Par, _) => return read_par(&text, decimals).ok().map(|r| r.0),
            (_, Some(kind)) => read_table_robot(&text, kind, &TableOptions::default()),
            _ => read_robot(&text),
        };
        match described.ok()?.0 {
            Described::Tree(tree) => Some(*tree),
            // A table without a branch is one chain.
            Described::Chain(chain) => Some(chain.as_tree()),
        }
    };
    let compared = |decimals| Some(compare_chains(whole.as_ref(), &read(decimals)?, &named));
    let meant = (!arguments.robot.as_written).then(|| compared(Decimals::Meant)).flatten();
    let (chains, is_meant) = match meant {
        Some(chains) if !chains.differ() => (Some(chains), true),
        meant => match compared(Decimals::AsWritten) {
            Some(written) if !written.differ() => (Some(written), arguments.robot.as_written),
            written => (meant.or(written), true),
        },
    };
    let Some(chains) = chains else {
        return say("what was written does not read back as a tree".into(), true);
    };
    let mut said = format!(
        "{}, {} of {} chains are proved to be the same",
        read_back(is_meant),
        chains.proved,
        chains.count()
    );
    if chains.sampled > 0 {
        said += &format!(", {} {}", chains.sampled, sampled(chains.most));
    }
    if chains.others > 0 {
        said += &format!(", {} have other joints", chains.others);
    }
    if chains.open > 0 {
        said += &format!(", {} were not compared", chains.open);
    }
    say(said, chains.differ())
}

fn no_par(why: NoPar) -> Failure {
    Failure::Input(match why {
        NoPar::Follows(row) => {
            format!(
                "error: `{row}` follows other joints, and a .par file has no words for that\n  = hint: name a chain without it by --base and --tip, or write --to tree"
            )
        }
        NoPar::NotNamed(why) => return not_named(why),
    })
}

fn not_named(why: NotNamed) -> Failure {
    match why {
        NotNamed::NeedsValues(names) => no_values(names.iter().map(|s| s.name().to_string())),
        NotNamed::NotPlaced(_) => {
            Failure::Input("error: base or tool is no rigid transform in numbers".into())
        }
    }
}

/// A table for documents.
fn table(robot: &Description, kind: TableKind) -> Result<Written, Failure> {
    let text = write_table(robot, kind).map_err(not_named)?;
    let back = read_table(&text, kind, &TableOptions::default()).ok().map(|r| r.0);
    Ok(Written { text, back: Back::Alone(back.map(Box::new)) })
}

fn no_values(names: impl Iterator<Item = String>) -> Failure {
    let names: Vec<String> = names.collect();
    Failure::Input(format!("error: no value for {}; give it with --set", names.join(", ")))
}

/// What is said of poses that were compared in samples.
fn sampled(most: f64) -> String {
    match most == 0.0 {
        true => format!("are equal to the last bit in {COMPARED} configurations, which is no proof"),
        false => format!("differ by {most:.0e} at most in {COMPARED} configurations"),
    }
}

/// How a sentence on what was read back begins; `is_meant` if decimals were read as they always are.
fn read_back(is_meant: bool) -> &'static str {
    if is_meant { "read back" } else { "read back with --as-written (its decimals are meant so)" }
}

/// A note, or a failure where what was written is something else.
fn say(said: String, is_other: bool) -> Result<(), Failure> {
    if is_other {
        return Err(Failure::No(format!("error: {said}")));
    }
    note(&format!("note: {said}"));
    Ok(())
}

/// Says how what was written is the robot; a failure if it is another.
fn say_same(robot: &Description, back: &Back, as_written: bool) -> Result<(), Failure> {
    let compared = |back: Option<Description>| back.map(|back| compare(robot, &back));
    let (comparison, is_meant) = match back {
        Back::Alone(back) => (compared(back.as_deref().cloned()), true),
        Back::ByDecimals(read) if as_written => (compared(read(Decimals::AsWritten)), true),
        Back::ByDecimals(read) => match compared(read(Decimals::Meant)) {
            Some(meant) if !meant.differs() => (Some(meant), true),
            meant => match compared(read(Decimals::AsWritten)) {
                Some(written) if !written.differs() => (Some(written), false),
                _ => (meant, true),
            },
        },
    };
    let Some(comparison) = comparison else {
        return say("what was written does not read back as one chain".into(), true);
    };
    let how = read_back(is_meant);
    let said = match &comparison {
        Comparison::Proved => format!("{how}, it is proved to be the same robot"),
        Comparison::Sampled(by) => {
            format!("{how}, its poses {}", sampled(*by))
        }
        Comparison::OtherJoints => format!("{how}, it has other joints than the robot"),
        Comparison::NoNumbers(missing) => {
            format!("what was written was not held against the robot: {missing}")
        }
    };
    say(said, comparison.differs())
}
