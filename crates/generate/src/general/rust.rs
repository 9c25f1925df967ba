//! The function in Rust: the files of `denavit-elimination`, the constants of the arm, and a test.

use super::General;
use denavit_elimination::{Joint, Ranking, Rigid, source};
use denavit_emit::{Attachment, File};
use std::fmt::Write;

/// What the root of the package says.
const DECLARATIONS: &str = "
#[cfg(feature = \"std\")]
#[allow(unused, missing_docs, clippy::all)]
mod elimination;
#[cfg(feature = \"std\")]
mod solve;
#[cfg(feature = \"std\")]
pub use solve::{SOLVE_MAX, SolveCertificate, SolveSolution, solve};
";

pub(super) fn attachment(general: &General) -> Attachment {
    let mut files = vec![
        File { path: "src/solve.rs".into(), text: function(general) },
        File { path: "tests/solve.rs".into(), text: test(general) },
    ];
    files.extend(
        source::module()
            .into_iter()
            .map(|(name, text)| File { path: format!("src/elimination/{name}"), text }),
    );
    Attachment { name: "solve".into(), declarations: DECLARATIONS.into(), files, ..Attachment::default() }
}

fn function(general: &General) -> String {
    let arm = &general.axes.arm;
    let about: String = general.about.iter().map(|line| format!("/// {}\n", escaped(line))).collect();
    let about = about.replace('\n', "\n///\n");
    let joints = arm.joints.map(|joint| match joint {
        Joint::Revolute => "Joint::Revolute",
        Joint::Prismatic => "Joint::Prismatic",
    });
    let links: String = arm.links.iter().map(|link| format!("        {},\n", rigid(link))).collect();
    let rows = |m: &[[f64; 6]; 6]| m.iter().map(|row| format!("    {row:?},\n")).collect::<String>();
    include_str!("solve.rs.txt")
        .replace("@about@\n", &about)
        .replace("@base@", &rigid(&arm.base))
        .replace("@joints@", &joints.join(", "))
        .replace("@links@\n", &links)
        .replace("@ranking@", &ranking(&general.plan.ranking()))
        .replace("@offsets@", &format!("{:?}", general.axes.offsets))
        .replace("@inverse@\n", &rows(&general.axes.inverse))
        .replace("@angles@", &format!("{:?}", general.is_angle))
}

fn ranking(ranking: &Ranking) -> String {
    match ranking {
        Ranking::Splits(ways) => format!("Ranking::Splits(vec!{ways:?})"),
        Ranking::Slides(ways) => format!("Ranking::Slides(vec!{ways:?})"),
        Ranking::Triple => "Ranking::Triple".into(),
    }
}

fn rigid(x: &Rigid) -> String {
    let [a, b, c] = x.rotation;
    format!(
        "Rigid {{\n            rotation: [\n                {a:?},\n                {b:?},\n                {c:?},\n            \
         ],\n            translation: {:?},\n        }}",
        x.translation
    )
}

/// Markup is taken literally.
fn escaped(text: &str) -> String {
    text.chars().flat_map(|c| "[]<>`*_".contains(c).then_some('\\').into_iter().chain([c])).collect()
}

fn test(general: &General) -> String {
    let count = general.vectors.len();
    let mut poses = format!("const POSES: [[[f64; 4]; 3]; {count}] = [\n");
    let mut known =
        format!("/// All configurations at each pose.\nconst KNOWN: [&[[f64; 6]]; {count}] = [\n");
    let mut given =
        format!("/// The configuration whose pose it is.\nconst GIVEN: [Option<[f64; 6]>; {count}] = [\n");
    for v in &general.vectors {
        let [a, b, c] = v.pose;
        let _ = write!(poses, "    [\n        {a:?},\n        {b:?},\n        {c:?},\n    ],\n");
        known.push_str("    &[\n");
        v.solutions.iter().for_each(|s| _ = writeln!(known, "        {s:?},"));
        known.push_str("    ],\n");
        let _ = writeln!(given, "    {:?},", v.configuration);
    }
    include_str!("test_solve.rs.txt")
        .replace("@poses@", &poses)
        .replace("@known@", &known)
        .replace("@given@", &given)
        .replace("@unit@", &format!("{:?}", general.unit))
        .replace("@angles@", &format!("{:?}", general.is_angle))
}
