//! `denavit convert`: a robot in another format, read back and held against itself.

use crate::arguments::{ConvertArguments, ConvertFormat};
use crate::commands::fk::plural;
use crate::commands::report::put;
use crate::failure::{Failure, without_values};
use crate::load::{self, Around, Tree};
use crate::terminal::{note, words};
use denavit::closure;
use denavit::description::{
    Alone, AxesAs, Convention, Decimals, Described, Description, Format, Joint, Linkage, Mechanism, NoPar,
    NotNamed, Part, Row, RowTree, TableKind, TableOptions, read_mjcf, read_par, read_robot, read_table,
    read_table_robot, read_toml, read_urdf, refused_masses, write_axes, write_linkage, write_linkage_par,
    write_mjcf, write_par, write_table, write_toml, write_tree, write_tree_table, write_urdf,
};
use denavit::mechanism::{COMPARED, Chains, Comparison, compare, compare_chains};
use denavit_symbolic::Expr;
use denavit_wire::Schema;
use denavit_wire::convert::Converted;
use std::borrow::Cow;
use std::collections::HashMap;

/// Writes a robot in another format.
///
/// # Errors
/// If there is no such robot, a parameter has no value, nothing can be written, or what was written is not the robot.
pub fn run(arguments: &ConvertArguments) -> Result<(), Failure> {
    let is_whole = matches!(arguments.to, ConvertFormat::Par | ConvertFormat::Tree);
    let is_of_bodies = matches!(arguments.to, ConvertFormat::Urdf | ConvertFormat::Mjcf);
    if arguments.whole && !is_whole && !is_of_bodies && table_kind(arguments.to).is_none() {
        return Err(Failure::Usage("--whole is for urdf, mjcf, markdown, latex and csv".into()));
    }
    if is_whole
        && arguments.robot.base.is_none()
        && arguments.robot.tip.is_none()
        && let Some(closed) = load::linkage(&arguments.robot)?
    {
        return linkage(&closed, arguments);
    }
    if (is_whole || arguments.whole)
        && let Some(whole) = load::mechanism(&arguments.robot)?
    {
        return if is_of_bodies { bodies(&whole, arguments) } else { tree(&whole, arguments) };
    }
    let (robot, around) = load::robot_and_around(&arguments.robot)?;
    let converted = match arguments.written_as {
        Some(to) => robot.converted(to.into()).description,
        None => robot.clone(),
    };
    let efforts = match &around {
        Around::Bodies(both) => has_efforts(both.1.joints.iter().map(|&j| &both.0.joints[j])),
        Around::Nothing | Around::Rows(_) => false,
    };
    let left = left_out(&converted, efforts, arguments.to);
    let Written { text, back } = written(&robot, &converted, arguments)?;
    if !arguments.json {
        put(&arguments.output, text.as_bytes())?;
    }
    let how = how_same(&robot, &back, arguments.robot.as_written);
    if arguments.json {
        answer(arguments, &robot.name, &text, &left, &how)?;
    }
    said(how)
}

/// All of a tree with closed loops, written as rows and closures.
fn linkage(closed: &Linkage, arguments: &ConvertArguments) -> Result<(), Failure> {
    if arguments.written_as.is_some_and(|to| Convention::from(to) != Convention::Khalil) {
        return Err(Failure::Usage("--as: a tree stands in the convention khalil".into()));
    }
    if arguments.json {
        return Err(Failure::Unsupported("--json of a whole tree with closed loops".into()));
    }
    left_out(&closed.all_rows(), false, arguments.to);
    let text = match arguments.to {
        ConvertFormat::Par => write_linkage_par(closed).map_err(no_par)?.text,
        _ => write_linkage(closed),
    };
    put(&arguments.output, text.as_bytes())?;
    let read = |decimals| match arguments.to {
        ConvertFormat::Par => read_par(&text, decimals).ok(),
        _ => read_robot(&text).ok(),
    };
    // What is read back has the same loops with the same equations.
    let back = read(Decimals::Meant).and_then(|(back, _)| match back {
        Described::Linkage(back) => Some(back),
        _ => None,
    });
    note(&match back.and_then(|back| closure::compare(closed, &back)) {
        Some(0) => {
            "note: read back, no configuration was found in which its loops close: nothing is compared".into()
        }
        Some(count) => format!(
            "note: read back, its loops close where these do (compared in numbers, at {})",
            plural(count, "configuration")
        ),
        None => "warning: read back, its loops do not close where these do".into(),
    });
    Ok(())
}

/// How what was written is what it was made of.
struct How {
    sentence: String,
    is_other: bool,
    /// How many chains were compared, and how many of them are proved to be the same.
    chains: usize,
    proved: usize,
    /// How many of them have other joints, and how many more were not compared.
    others: usize,
    not_compared: usize,
    /// By how much the poses of the others differ at most.
    difference: Option<f64>,
}

/// Prints the answer as JSON.
fn answer(
    arguments: &ConvertArguments,
    robot: &str,
    text: &str,
    left: &[Part],
    how: &How,
) -> Result<(), Failure> {
    let How { chains, proved, difference, .. } = *how;
    let left_out = left.iter().map(|p| words().left_part(*p)).collect();
    let (others, not_compared) = (how.others, how.not_compared);
    let converted =
        Converted { chains, difference, left_out, not_compared, others, proved, robot, schema: Schema, text };
    let mut line = vec![];
    denavit_wire::line(&converted, &mut line);
    put(&arguments.output, &line)
}

/// The format of what is written.
fn format(to: ConvertFormat) -> Format {
    match to {
        ConvertFormat::Toml | ConvertFormat::Tree => Format::RobotFile,
        ConvertFormat::Urdf => Format::Urdf,
        ConvertFormat::Mjcf => Format::Mjcf,
        ConvertFormat::Axes | ConvertFormat::Poe | ConvertFormat::BodyPoe => Format::Axes,
        ConvertFormat::Par => Format::Par,
        ConvertFormat::Markdown | ConvertFormat::Latex | ConvertFormat::Csv => Format::Table,
    }
}

/// What of a robot has no place in a format; it is said.
fn left_out(d: &Description, has_efforts: bool, to: ConvertFormat) -> Vec<Part> {
    let efforts = [Part::Efforts].into_iter().filter(|_| has_efforts);
    let left: Vec<Part> = d.parts().into_iter().chain(efforts).filter(|p| !format(to).holds(*p)).collect();
    if !left.is_empty() {
        let what = match format(to) {
            Format::RobotFile => "a robot file",
            Format::Urdf => "a URDF as it is written here",
            Format::Mjcf => "a model as it is written here",
            Format::Axes => "a file of axes",
            Format::Par => "a .par file as it is written here",
            Format::Table => "a table",
        };
        let names: Vec<&str> = left.iter().map(|p| words().left_part(*p)).collect();
        note(&format!("note: left out, as {what} has no place for it: {}", names.join(", ")));
    }
    let is_known = |e: Expr| e.symbols().iter().all(|s| d.value(*s).is_some());
    let is_open = || d.rows.iter().flat_map(Row::mass_cells).any(|cell| !is_known(cell.1));
    if matches!(to, ConvertFormat::Urdf | ConvertFormat::Mjcf) && is_open() {
        note("note: masses and drives without a value are left out");
    }
    left
}

/// Whether joints of a tree, or of a chain of it, have limits of torque or force.
fn has_efforts<'j>(mut joints: impl Iterator<Item = &'j Joint>) -> bool {
    joints.any(|j| j.effort.is_some())
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
            let bodies =
                Mechanism::of(converted).map_err(|missing| no_values(missing.parameters.into_iter()))?;
            let text = write_urdf(&bodies);
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
                let tree = read_par(&copy, decimals).ok()?.0.tree()?;
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
    // Rows have frames of their own; the others are those of bodies, which may be called otherwise where a name is taken.
    let named = match whole {
        Tree::Rows(_) => named,
        Tree::Bodies(m) => {
            let body: HashMap<&str, &str> = ends(&rows, m).map(|(body, frame)| (frame, body)).collect();
            named
                .into_iter()
                .filter_map(|(end, there)| Some((body.get(end.as_str())?.to_string(), there)))
                .collect()
        }
    };
    let efforts = match whole {
        Tree::Bodies(m) => has_efforts(m.joints.iter()),
        Tree::Rows(_) => false,
    };
    let left = left_out(&rows.all_rows(), efforts, arguments.to);
    if !arguments.json {
        put(&arguments.output, text.as_bytes())?;
    }
    let read = |decimals| {
        let described = match (arguments.to, kind) {
            (ConvertFormat::Par, _) => return read_par(&text, decimals).ok()?.0.tree(),
            (_, Some(kind)) => read_table_robot(&text, kind, &TableOptions::default()),
            _ => read_robot(&text),
        };
        match described.ok()?.0 {
            Described::Tree(tree) => Some(*tree),
            // A table without a branch is one chain.
            Described::Chain(chain) => Some(chain.as_tree()),
            Described::Linkage(_) => None,
        }
    };
    let compared = |decimals| Some(compare_chains(whole.as_ref(), &read(decimals)?, &named));
    how_tree(&rows.name, &text, &left, arguments, &compared)
}

/// The ends of a tree of bodies, and what its rows call them.
fn ends<'a>(rows: &'a RowTree, m: &'a Mechanism) -> impl Iterator<Item = (&'a str, &'a str)> {
    let bodies = m.leaves().into_iter().map(|b| m.bodies[b].name.as_str());
    bodies.zip(rows.frames.iter().map(|f| f.name.as_str()))
}

/// All of a tree as bodies and joints; every chain from its root to an end is read back and compared.
fn bodies(whole: &Tree, arguments: &ConvertArguments) -> Result<(), Failure> {
    if arguments.written_as.is_some() {
        return Err(Failure::Usage("--as: bodies and joints have no convention".into()));
    }
    let (tree, rows) = match whole {
        Tree::Bodies(m) => (Cow::Borrowed(m), RowTree::of_mechanism(m).ok()),
        Tree::Rows(rows) => {
            let tree = rows.mechanism().map_err(|missing| no_values(missing.parameters.into_iter()))?;
            (Cow::Owned(tree), Some(rows.clone()))
        }
    };
    let text = match arguments.to {
        ConvertFormat::Mjcf => {
            say_refused(&tree);
            write_mjcf(&tree)
        }
        _ => write_urdf(&tree),
    };
    // Torques and forces have a place here.
    let parts = rows.map_or(vec![], |rows| left_out(&rows.all_rows(), false, arguments.to));
    if !arguments.json {
        put(&arguments.output, text.as_bytes())?;
    }
    let compared = |decimals| {
        let back = match arguments.to {
            ConvertFormat::Mjcf => read_mjcf("written", &text, &mut Alone, decimals).0.ok()?.0,
            _ => read_urdf(&text, decimals).ok()?.0,
        };
        let rows = RowTree::of_mechanism(&back).ok()?;
        // Its rows call the ends as they do where a name is taken.
        let there: HashMap<&str, &str> = ends(&rows, &back).collect();
        let leaves = tree.leaves().into_iter().map(|b| tree.bodies[b].name.clone());
        let ends: Vec<(String, String)> = leaves
            .map(|end| (end.clone(), there.get(end.as_str()).map_or(end, |name| name.to_string())))
            .collect();
        Some(compare_chains(whole.as_ref(), &rows, &ends))
    };
    how_tree(&tree.name, &text, &parts, arguments, &compared)
}

/// Says how what was written of a tree is the tree, by what it is read back to with decimals as they are meant, or as they are written.
fn how_tree(
    name: &str,
    text: &str,
    left: &[Part],
    arguments: &ConvertArguments,
    compared: &dyn Fn(Decimals) -> Option<Chains>,
) -> Result<(), Failure> {
    let meant = (!arguments.robot.as_written).then(|| compared(Decimals::Meant)).flatten();
    let (chains, is_meant) = match meant {
        Some(chains) if !chains.differ() => (Some(chains), true),
        meant => match compared(Decimals::AsWritten) {
            Some(written) if !written.differ() => (Some(written), arguments.robot.as_written),
            written => (meant.or(written), true),
        },
    };
    let how = match chains {
        None => How::unread("what was written does not read back as a tree"),
        Some(chains) => how_chains(&chains, is_meant),
    };
    if arguments.json {
        answer(arguments, name, text, left, &how)?;
    }
    said(how)
}

/// How the chains of a tree are those of what was written.
fn how_chains(chains: &Chains, is_meant: bool) -> How {
    let mut sentence = match chains.count() {
        0 => format!("{}, no joint moves in it", read_back(is_meant)),
        all => {
            format!("{}, {} of {all} chains are proved to be the same", read_back(is_meant), chains.proved)
        }
    };
    if chains.sampled > 0 {
        sentence += &format!(", {} {}", chains.sampled, sampled(chains.most));
    }
    if chains.others > 0 {
        sentence += &format!(", {} have other joints", chains.others);
    }
    if chains.open > 0 {
        sentence += &format!(", {} were not compared", chains.open);
    }
    How {
        sentence,
        is_other: chains.differ(),
        chains: chains.count() - chains.open,
        proved: chains.proved,
        others: chains.others,
        not_compared: chains.open,
        difference: (chains.sampled > 0).then_some(chains.most),
    }
}

impl How {
    fn unread(sentence: &str) -> Self {
        let (chains, proved, others, not_compared) = (0, 0, 0, 1);
        How {
            sentence: sentence.into(),
            is_other: true,
            chains,
            proved,
            others,
            not_compared,
            difference: None,
        }
    }
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
fn said(how: How) -> Result<(), Failure> {
    if how.is_other {
        return Err(Failure::No(format!("error: {}", how.sentence)));
    }
    note(&format!("note: {}", how.sentence));
    Ok(())
}

/// How what was written is the robot.
fn how_same(robot: &Description, back: &Back, as_written: bool) -> How {
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
        return How::unread("what was written does not read back as one chain");
    };
    let how = read_back(is_meant);
    let (sentence, proved, difference) = match &comparison {
        Comparison::Proved => (format!("{how}, it is proved to be the same robot"), 1, None),
        Comparison::Sampled(by) => (format!("{how}, its poses {}", sampled(*by)), 0, Some(*by)),
        Comparison::OtherJoints => (format!("{how}, it has other joints than the robot"), 0, None),
        Comparison::NoNumbers(missing) => {
            (format!("what was written was not held against the robot: {missing}"), 0, None)
        }
    };
    let not_compared = usize::from(matches!(comparison, Comparison::NoNumbers(_)));
    let others = usize::from(matches!(comparison, Comparison::OtherJoints));
    let (is_other, chains) = (comparison.differs(), 1 - not_compared);
    How { sentence, is_other, chains, proved, others, not_compared, difference }
}
