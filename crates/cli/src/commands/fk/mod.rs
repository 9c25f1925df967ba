//! `denavit fk`: poses in numbers.

mod answer;
pub mod linkage;
mod stream;
pub mod tree;

use crate::arguments::{FkArguments, Format};
use crate::commands::{derive, parallel};
use crate::failure::{Failure, without_values};
use crate::load::{self, Around, Tree};
use crate::terminal::{Align, HEADING, NAME, lowered, matrix, noise, note, number, raised, styled};
use answer::Answers;
pub use answer::strict;
use denavit::Robot;
use denavit::description::{Convention, Description, JointKind, NamedFrame, Variable};
use denavit::forward::Reference;
use denavit::geometry::orientation::{OrientationSet, extract};
use denavit::geometry::{Transform, Vector};
use denavit::quantity::reading;
use denavit_symbolic::Expr;
use std::io::Write;

/// Computes poses.
///
/// # Errors
/// If the robot or the configuration cannot be read, a parameter has no value, or nothing can be written.
pub fn run(arguments: &FkArguments) -> Result<(), Failure> {
    if let Some((parallel, _)) = load::parallel(&arguments.robot)? {
        return parallel::fk(arguments, &parallel);
    }
    if let Some(closed) = load::without_chain(&arguments.robot)? {
        return linkage::run(arguments, &closed);
    }
    if arguments.symbolic {
        let format = if arguments.json { Format::Json } else { Format::Terminal };
        return derive::matrix_only(&arguments.robot, orientation(arguments)?, format);
    }
    if let Some(frames) = arguments.frames.as_deref()
        && (frames == "all" || arguments.robot.set.is_empty())
        && let Some(found) = load::mechanism(&arguments.robot)?
        && (frames == "all" || is_on_chain(arguments, &found, frames) != Some(true))
    {
        match tree::run(arguments, &found, frames) {
            Some(answer) => return answer,
            // Where there is a chain, what is said of its frames says more.
            None if is_on_chain(arguments, &found, frames).is_none() => {
                return Err(tree::unknown(&found, frames));
            }
            None => {}
        }
    }
    let (description, around) = load::robot_and_around(&arguments.robot)?;
    let request = Request::new(&description, &around, arguments)?;
    let robot = Robot::numeric(&description)
        .map_err(|missing| without_values(&description, &arguments.robot.robot, &missing))?;
    match (&arguments.input, &arguments.q) {
        (Some(path), _) => stream::run(Answers::new(&description, &request), path),
        (None, Some(text)) => {
            let q = configuration(&description, text)?;
            for ((v, limits), &x) in limits(&description).into_iter().zip(&q) {
                warn_of_limits(&v.symbol.name(), v.kind, limits, x);
            }
            let mut out = anstream::stdout();
            if arguments.json {
                let answers = Answers::new(&description, &request);
                let mut text = vec![];
                answers.write(&q, answers.function.scalar().eval(&q), &mut text);
                out.write_all(&text)?;
            } else {
                write!(out, "{}", report(&description, &request, &q))?;
            }
            Ok(())
        }
        (None, None) => Err(Failure::Usage(format!(
            "say where the joints are: -q with {} values, as in -q \"{}\"{}",
            robot.joints,
            vec!["0"; robot.joints].join(", "),
            pose_names(&description),
        ))),
    }
}

/// Whether the chain of a tree that is taken where none is named has all of these frames; nothing where there is no such chain.
fn is_on_chain(arguments: &FkArguments, tree: &Tree, frames: &str) -> Option<bool> {
    let convention = |usual| arguments.robot.convention.map_or(usual, Into::into);
    let found = match tree {
        Tree::Bodies(m) => {
            let chain = m.chain(None, None, convention(Convention::Standard)).ok();
            chain.map(|c| (m.frames(&c), c.description))
        }
        Tree::Rows(rows) => {
            let chain = rows.chain(None, None, convention(Convention::Khalil)).ok();
            chain.map(|c| (c.frames, c.description))
        }
    };
    found.map(|(around, d)| named_frames(&d, &around, frames).is_ok())
}

/// The frames that a list names, each once.
fn named_frames(d: &Description, around: &[NamedFrame], text: &str) -> Result<Vec<Frame>, String> {
    let find = |word: &str| Frame::find(d, around, word.trim());
    // A name may hold commas.
    let all = || text.split(',').map(find).collect();
    let found: Result<Vec<Frame>, String> = find(text).map(|f| vec![f]).or_else(|_| all());
    let mut once: Vec<Frame> = vec![];
    for frame in found? {
        if !once.contains(&frame) {
            once.push(frame);
        }
    }
    Ok(once)
}

/// What is asked for besides the tool's pose.
struct Request {
    frames: Vec<Frame>,
    orientation: Option<OrientationSet>,
}

/// A frame that is asked for: one of the table, or one with a name that does not move there.
#[derive(Clone, PartialEq)]
pub struct Frame {
    on: usize,
    named: Option<(String, Transform<f64>)>,
}

impl Frame {
    fn of_table(on: usize) -> Self {
        Frame { on, named: None }
    }

    /// Its pose, where the table's frame has this one.
    fn placed(&self, table: Transform<f64>) -> Transform<f64> {
        self.named.as_ref().map_or(table, |n| table * n.1)
    }

    /// The row's frame that it stands on.
    pub fn row(&self) -> usize {
        self.on
    }

    /// Where it stands there, if it is another.
    pub fn offset(&self) -> Option<Transform<f64>> {
        self.named.as_ref().map(|n| n.1)
    }

    /// The row's frame that it stands on, and its origin there.
    pub fn point(&self) -> (usize, Vector<f64>) {
        (self.on, self.named.as_ref().map_or_else(Vector::zero, |n| n.1.translation))
    }

    /// The frame that a word names.
    pub fn find(d: &Description, around: &[NamedFrame], word: &str) -> Result<Self, String> {
        load::frame(d, word).map(Frame::of_table).or_else(|why| {
            let named = around.iter().find(|f| f.name == word);
            let Some(NamedFrame { name, on, pose }) = named else {
                let names: Vec<&str> = around.iter().map(|f| f.name.as_str()).collect();
                let also = if names.is_empty() { String::new() } else { format!(", {}", names.join(", ")) };
                return Err(format!("{why}{also}"));
            };
            let open = || {
                let symbols = pose.matrix().concat().into_iter().flat_map(Expr::symbols);
                let mut names: Vec<String> =
                    symbols.filter(|s| d.value(*s).is_none()).map(|s| s.name().to_string()).collect();
                names.dedup();
                format!("where `{name}` stands has no value: {}", names.join(", "))
            };
            let pose = pose.map(|e| e.eval(|s| d.value(s)).unwrap_or(f64::NAN));
            if pose.matrix().as_flattened().iter().any(|x| !x.is_finite()) {
                return Err(open());
            }
            Ok(Frame { on: on.map_or(0, |row| row + 1), named: Some((name.clone(), pose)) })
        })
    }
}

impl Request {
    fn new(description: &Description, around: &Around, arguments: &FkArguments) -> Result<Self, Failure> {
        let last = description.rows.len();
        let frames = match arguments.frames.as_deref() {
            None => vec![],
            Some("all") => (0..=last).map(Frame::of_table).collect(),
            Some(text) => named_frames(description, &around.frames(), text)
                .map_err(|why| Failure::Usage(format!("--frames {text}: {why}, or `all`")))?,
        };
        Ok(Request { frames, orientation: orientation(arguments)? })
    }
}

/// The set of angles that is asked for.
fn orientation(arguments: &FkArguments) -> Result<Option<OrientationSet>, Failure> {
    let set = arguments.orientation.as_deref().map(str::parse::<OrientationSet>).transpose();
    set.map_err(|e| Failure::Usage(format!("--orientation: {e}")))
}

fn pose_names(d: &Description) -> String {
    match d.poses.iter().map(|p| p.0.as_str()).collect::<Vec<_>>()[..] {
        [] => String::new(),
        ref names => format!(", or a pose by name: {}", names.join(", ")),
    }
}

/// A pose of the file, or values separated by commas, semicolons or blanks, or `NAME=VALUE` for some joints, the others at 0.
pub fn configuration(d: &Description, text: &str) -> Result<Vec<f64>, Failure> {
    let variables = d.variables();
    let bad = |why: String| Failure::Usage(format!("-q: {why}"));
    if let Some((_, q)) = d.poses.iter().find(|p| p.0 == text.trim()) {
        return q.iter().map(|e| value(*e).map_err(bad)).collect();
    }
    if text.contains('=') {
        return by_name(d, text).map_err(bad);
    }
    let parts = load::list(text);
    if parts.len() != variables.len() {
        return Err(bad(format!(
            "{} given, the robot has {} ({}){}",
            plural(parts.len(), "value"),
            plural(variables.len(), "joint"),
            variables.iter().map(|v| v.symbol.name().to_string()).collect::<Vec<_>>().join(", "),
            pose_names(d),
        )));
    }
    let (mut q, mut errors) = (vec![], vec![]);
    for (part, (variable, limits)) in parts.iter().zip(limits(d)) {
        match load::value_of(part, variable.kind.into()).and_then(value) {
            Ok(x) => {
                // A joint that turns so far may be there.
                let is_allowed = limits.is_some_and(|[low, high]| (low..=high).contains(&x));
                if variable.kind == JointKind::Revolute && !is_allowed {
                    load::note_of_radians(part, &variable.symbol.name(), x);
                }
                q.push(x);
            }
            Err(why) => errors.push(format!("{}: {why}", variable.symbol.name())),
        }
    }
    if errors.is_empty() { Ok(q) } else { Err(bad(errors.join("\n  "))) }
}

/// Values of some joints by name, the others at 0.
fn by_name(d: &Description, text: &str) -> Result<Vec<f64>, String> {
    let variables = d.variables();
    let mut q: Vec<Option<f64>> = vec![None; variables.len()];
    for part in text.split([',', ';']).map(str::trim) {
        let (name, text) = part.split_once('=').ok_or_else(|| format!("`{part}`: write NAME=VALUE"))?;
        let at = load::joint(d, name.trim())?;
        let read = load::value_of(text.trim(), variables[at].kind.into()).and_then(value);
        let x = read.map_err(|why| format!("{}: {why}", name.trim()))?;
        if q[at].replace(x).is_some() {
            return Err(format!("{} is given twice", name.trim()));
        }
    }
    Ok(q.into_iter().map(Option::unwrap_or_default).collect())
}

pub fn plural(n: usize, word: &str) -> String {
    format!("{n} {word}{}", if n == 1 { "" } else { "s" })
}

pub fn value(e: Expr) -> Result<f64, String> {
    match e.eval(|_| None) {
        Ok(x) if x.is_finite() => Ok(x),
        _ => Err("not a finite number".into()),
    }
}

pub fn limits(d: &Description) -> Vec<(Variable, Option<[f64; 2]>)> {
    let numeric = |l: [Expr; 2]| Some([value(l[0]).ok()?, value(l[1]).ok()?]);
    d.rows.iter().filter_map(|r| Some((r.variable?, r.limits.and_then(numeric)))).collect()
}

fn warn_of_limits(name: &str, kind: JointKind, limits: Option<[f64; 2]>, x: f64) {
    if let Some([low, high]) = limits
        && !(low..=high).contains(&x)
    {
        let [x, low, high] = [x, low, high].map(|x| reading(x, kind));
        note(&format!("warning: {name} = {x} is outside its limits {low} … {high}"));
    }
}

/// What the file calls the joints, as a paragraph; nothing where it has no names.
pub fn joint_names(d: &Description) -> String {
    let Some(names) = d.joint_names() else { return String::new() };
    let variables = d.variables();
    let named = variables.iter().zip(&names).map(|(v, name)| format!("{} {name}", v.symbol.name()));
    format!("joints: {}\n\n", named.collect::<Vec<_>>().join(", "))
}

/// The answer for reading.
fn report(d: &Description, request: &Request, q: &[f64]) -> String {
    let at: Vec<String> = d
        .variables()
        .iter()
        .zip(q)
        .map(|(v, &x)| format!("{} = {}", v.symbol.name(), reading(x, v.kind)))
        .collect();
    let mut text = format!("{} at {}\n\n{}", styled(&d.name, HEADING), at.join(", "), joint_names(d));
    let last = d.rows.len();
    let poses: Vec<Reference> = (0..=last).map(Reference::Frame).chain([Reference::Tool]).collect();
    let frames: Vec<Transform<f64>> =
        answer::transforms(answer::function(d, &poses).scalar().eval(q)).collect();
    let pose = frames[last + 1];
    let rounding = noise(&frames);
    let show = |label: &str, x: &Transform<f64>| {
        let noise = |column: usize| if column == 3 { rounding } else { 1e-14 };
        let row = |row: &[f64; 4]| row.iter().enumerate().map(|(c, &e)| number(e, noise(c))).collect();
        let entries: Vec<Vec<String>> = x.matrix().iter().map(row).collect();
        matrix(&format!("{label} = "), &entries, Align::Right)
    };
    let (has_base, has_tool) = (d.base != Transform::identity(), d.tool != Transform::identity());
    let label = |i: usize| match has_base {
        true => format!("T(base → {i})"),
        false => format!("{}T{}", raised("0"), lowered(&i.to_string())),
    };
    for frame in request.frames.iter().filter(|f| f.on != last || has_tool || f.named.is_some()) {
        let label = match &frame.named {
            None => label(frame.on),
            Some((name, _)) => format!("T({} → {name})", if has_base { "base" } else { "0" }),
        };
        text += &show(&label, &frame.placed(frames[frame.on]));
        text.push('\n');
    }
    let whole = match (has_tool, has_base) {
        (false, _) => label(last),
        (true, false) => "T(0 → tool)".into(),
        (true, true) => "T(base → tool)".into(),
    };
    text += &show(&whole, &pose);
    if let Some(set) = request.orientation {
        let o = extract(&pose.rotation, set);
        text += &format!("\n  orientation as {}: ", styled(&set.to_string(), NAME));
        let is_length_free = matches!(set, OrientationSet::Matrix | OrientationSet::Quaternion);
        let values: Vec<String> = o
            .names()
            .iter()
            .zip(&o.values)
            .map(|(name, &x)| {
                let angle = !(is_length_free || set == OrientationSet::AxisAngle && *name != "angle");
                if angle {
                    format!("{name} {}", reading(x, JointKind::Revolute))
                } else {
                    format!("{name} {}", number(x, 1e-15))
                }
            })
            .collect();
        text += &values.join(", ");
        if o.singular {
            text += match set {
                OrientationSet::AxisAngle => "  (singular: no axis is distinguished; z is taken)",
                _ => {
                    "  (singular: only the sum or difference of the outer angles is determined; the last is taken as 0)"
                }
            };
        }
        text.push('\n');
    }
    text
}
