//! The function in MATLAB, which Octave reads: the algorithm of `denavit-elimination`, the constants of the arm, and a test.

use super::General;
use crate::controller::matlab::{row, rows};
use crate::tables::wrapped;
use denavit_elimination::{Joint, Ranking, Rigid, Tables};
use denavit_emit::{Attachment, File};

/// The parts of the file.
const PARTS: [&str; 4] = [
    include_str!("matlab/solve.m"),
    include_str!("matlab/arm.m"),
    include_str!("matlab/eliminate.m"),
    include_str!("matlab/roots.m"),
];

/// The function with its test.
pub(super) fn attachment(general: &General, tables: &Tables) -> Attachment {
    let axes = &general.axes;
    let slides = tables.arm.joints.map(|joint| joint == Joint::Prismatic);
    let link = |(k, x): (usize, &Rigid)| format!("a.links(:, :, {}) = {};", k + 1, rigid(x));
    let links: Vec<String> = tables.arm.links.iter().enumerate().map(link).collect();
    let cuts = match general.plan.ranking() {
        Ranking::Splits(cuts) => cuts,
        Ranking::Slides(_) | Ranking::Triple => vec![],
    };
    let cuts: Vec<String> =
        cuts.iter().map(|&(joint, last)| format!("{}, {}", joint + 1, u8::from(last))).collect();
    let about: String = general.about.iter().map(|line| wrapped("%   ", line, "")).collect();
    let about = about.trim_start_matches(['%', ' ']).trim_end();
    let text = PARTS
        .concat()
        .replace("@about@", about)
        .replace("@size@", &format!("{:?}", tables.size))
        .replace("@slides@", &words(&slides))
        .replace("@base@", &rigid(&tables.arm.base))
        .replace("@links@", &links.join("\n"))
        .replace("@coupling@", &rows(&axes.inverse.map(|row| row.to_vec())))
        .replace("@offsets@", &row(&axes.offsets))
        .replace("@is_angle@", &words(&general.is_angle))
        .replace("@cuts@", &format!("[{}]", cuts.join("; ")));
    Attachment {
        name: "solve".into(),
        test: test(general),
        files: vec![File { path: "@name@_solve.m".into(), text }],
        ..Attachment::default()
    }
}

fn words(are: &[bool]) -> String {
    format!("[{}]", are.iter().map(|&is| u8::from(is).to_string()).collect::<Vec<_>>().join(", "))
}

/// A homogeneous matrix.
fn rigid(x: &Rigid) -> String {
    let row = |i: usize| [&x.rotation[i][..], &[x.translation[i]]].concat();
    rows(&[row(0), row(1), row(2), vec![0.0, 0.0, 0.0, 1.0]])
}

fn test(general: &General) -> String {
    let vectors = &general.vectors;
    let list = |rows_of: &[Vec<f64>]| match rows_of {
        [] => "zeros(0, 6)".into(),
        some => rows(some),
    };
    let block =
        |items: Vec<String>| items.iter().map(|item| format!("{item}, ...")).collect::<Vec<_>>().join("\n");
    let poses = vectors.iter().map(|v| rows(&v.pose.map(|row| row.to_vec()))).collect();
    let known = vectors.iter().map(|v| list(&v.solutions)).collect();
    let given = vectors.iter().map(|v| list(v.configuration.as_slice())).collect();
    include_str!("matlab/test.m")
        .replace("@poses@", &block(poses))
        .replace("@known@", &block(known))
        .replace("@given@", &block(given))
        .replace("@unit@", &format!("{:?}", general.unit))
        .replace("@angles@", &words(&general.is_angle))
}
