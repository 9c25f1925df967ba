//! The function in Python: the algorithm of `denavit-elimination` over NumPy arrays, the constants of the arm, and a test.

use super::General;
use crate::controller::python::{WIDTH, row, rows};
use crate::tables::wrapped_in;
use denavit_elimination::{Joint, Ranking, Rigid, Tables};
use denavit_emit::Attachment;

/// The parts of the module.
const PARTS: [&str; 4] = [
    include_str!("python/arm.py.txt"),
    include_str!("python/eliminate.py.txt"),
    include_str!("python/roots.py.txt"),
    include_str!("python/solve.py.txt"),
];

/// The function with its test.
pub(super) fn attachment(general: &General, tables: &Tables) -> Attachment {
    let axes = &general.axes;
    let slides = tables.arm.joints.map(|joint| joint == Joint::Prismatic);
    let links: Vec<String> = tables.arm.links.iter().map(|link| rigid(link, 8)).collect();
    let cuts = match general.plan.ranking() {
        Ranking::Splits(cuts) => cuts,
        Ranking::Slides(_) | Ranking::Triple => vec![],
    };
    let cuts: Vec<String> = cuts.iter().map(|&(joint, last)| format!("({joint}, {})", word(last))).collect();
    let (first, rest) = general.about.split_first().map_or(("", &[][..]), |(a, b)| (a.as_str(), b));
    let about: String = rest.iter().map(|line| wrapped_in(WIDTH, "    ", line, "")).collect();
    let about = format!("{}\n{}", wrapped_in(WIDTH, "    ", first, "").trim_start(), about.trim_end());
    let definitions = PARTS
        .concat()
        .replace("@size@", &format!("{:?}", tables.size))
        .replace("@slides@", &words(&slides))
        .replace("@base@", &rigid(&tables.arm.base, 0))
        .replace("@links@", &format!("np.array(\n    [\n{}    ]\n)", nested(&links)))
        .replace("@coupling@", &rows(&axes.inverse.map(|row| row.to_vec()), 0))
        .replace("@offsets@", &row(&axes.offsets))
        .replace("@is_angle@", &words(&general.is_angle))
        .replace("@cuts@", &format!("[{}]", cuts.join(", ")))
        .replace("@about@", &about);
    Attachment {
        name: "solve".into(),
        declarations: "from typing import NamedTuple\n".into(),
        definitions,
        test: test(general),
        ..Attachment::default()
    }
}

fn word(is: bool) -> &'static str {
    if is { "True" } else { "False" }
}

fn words(are: &[bool]) -> String {
    format!("[{}]", are.iter().map(|&is| word(is)).collect::<Vec<_>>().join(", "))
}

/// A homogeneous matrix.
fn rigid(x: &Rigid, indent: usize) -> String {
    let row = |i: usize| [&x.rotation[i][..], &[x.translation[i]]].concat();
    rows(&[row(0), row(1), row(2), vec![0.0, 0.0, 0.0, 1.0]], indent)
}

/// Arrays as items of a list.
fn nested(items: &[String]) -> String {
    items.iter().map(|item| format!("        {item},\n")).collect()
}

fn test(general: &General) -> String {
    let vectors = &general.vectors;
    let list = |rows_of: &[Vec<f64>]| match rows_of {
        [] => "np.zeros((0, 6))".into(),
        some => rows(some, 8),
    };
    let block = |items: Vec<String>| format!("[\n{}    ]", nested(&items));
    let poses = vectors.iter().map(|v| rows(&v.pose.map(|row| row.to_vec()), 8)).collect();
    let known = vectors.iter().map(|v| list(&v.solutions)).collect();
    let given = vectors.iter().map(|v| list(v.configuration.as_slice())).collect();
    include_str!("python/test.py.txt")
        .replace("@poses@", &block(poses))
        .replace("@known@", &block(known))
        .replace("@given@", &block(given))
        .replace("@unit@", &format!("{:?}", general.unit))
        .replace("@angles@", &words(&general.is_angle))
}
