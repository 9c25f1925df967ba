//! The function in JavaScript: the algorithm of `denavit-elimination`, its constants as tables, and a test.

use super::General;
use crate::tables::wrapped;
use denavit_elimination::{Joint, Rigid, Split, Tables};
use denavit_emit::Attachment;

/// The parts of the module.
const PARTS: [&str; 7] = [
    include_str!("javascript/tables.js.txt"),
    include_str!("javascript/eliminate.js.txt"),
    include_str!("javascript/matrix.js.txt"),
    include_str!("javascript/roots.js.txt"),
    include_str!("javascript/newton.js.txt"),
    include_str!("javascript/wide.js.txt"),
    include_str!("javascript/solve.js.txt"),
];

/// The function with its test.
pub(super) fn attachment(general: &General, tables: &Tables) -> Attachment {
    let axes = &general.axes;
    let (narrow, wide) = (&tables.samples, &tables.wide);
    let about: String = general.about.iter().map(|line| wrapped(" * ", line, "")).collect();
    let slides = tables.arm.joints.map(|joint| joint == Joint::Prismatic);
    let links: Vec<String> = tables.arm.links.iter().map(rigid).collect();
    let splits: Vec<String> = tables.splits.iter().map(split).collect();
    let definitions = PARTS
        .concat()
        .replace("@about@", about.trim_end())
        .replace("@size@", &format!("{:?}", tables.size))
        .replace("@slides@", &format!("{slides:?}"))
        .replace("@base@", &rigid(&tables.arm.base))
        .replace("@links@", &lines(&links))
        .replace("@coupling@", &rows(&axes.inverse))
        .replace("@offsets@", &list(&axes.offsets))
        .replace("@angles@", &format!("{:?}", general.is_angle))
        .replace("@narrow@", &samples(8, [&narrow.cosines, &narrow.sines], &narrow.transform))
        .replace("@wide@", &samples(12, [&wide.cosines, &wide.sines], &wide.transform))
        .replace("@mixtures@", &rows(&tables.mixtures))
        .replace("@splits@", &lines(&splits));
    Attachment { name: "solve".into(), definitions, test: test(general), ..Attachment::default() }
}

fn samples(degree: usize, [cosines, sines]: [&[f64]; 2], transform: &[Vec<f64>]) -> String {
    format!(
        "{{\n  degree: {degree},\n  cosines: {},\n  sines: {},\n  transform: {},\n}}",
        list(cosines),
        list(sines),
        rows(transform)
    )
}

fn split(split: &Split) -> String {
    let slides = split.kinds.map(|joint| joint == Joint::Prismatic);
    let links: Vec<String> = split.links.iter().map(rigid).collect();
    format!(
        "{{\n  joints: {:?},\n  slides: {slides:?},\n  sign: {:?},\n  links: {},\n  poseLink: {},\n  lastMultiplied: {},\n  \
         left: {},\n}}",
        split.joints,
        split.sign,
        lines(&links),
        split.pose_link,
        split.last_multiplied,
        rows(&split.left)
    )
}

fn rigid(x: &Rigid) -> String {
    let rotation: Vec<String> = x.rotation.iter().map(|row| list(row)).collect();
    format!("{{ r: [{}], t: {} }}", rotation.join(", "), list(&x.translation))
}

/// Numbers on as many lines as they need.
fn list(values: &[f64]) -> String {
    let numbers: Vec<String> = values.iter().map(|x| format!("{x:?}")).collect();
    let whole = format!("[{}]", numbers.join(", "));
    if whole.len() <= 96 { whole } else { format!("[\n{}]", wrapped("  ", &numbers.join(", "), "")) }
}

fn rows<R: AsRef<[f64]>>(rows: &[R]) -> String {
    lines(&rows.iter().map(|row| list(row.as_ref())).collect::<Vec<String>>())
}

fn lines(items: &[String]) -> String {
    format!("[\n{}]", items.iter().map(|item| format!("  {item},\n")).collect::<String>())
}

fn test(general: &General) -> String {
    let vectors: Vec<String> = general
        .vectors
        .iter()
        .map(|v| {
            let pose = rows(&v.pose);
            let given = v.configuration.as_ref().map_or("null".into(), |q| list(q));
            format!("{{ pose: {pose}, given: {given}, known: {} }}", rows(&v.solutions))
        })
        .collect();
    include_str!("javascript/test.js.txt")
        .replace("@vectors@", &lines(&vectors))
        .replace("@unit@", &format!("{:?}", general.unit))
        .replace("@angles@", &format!("{:?}", general.is_angle))
}
