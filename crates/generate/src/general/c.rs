//! The function in C99: the algorithm of `denavit-elimination`, its constants as tables, and a test.

use super::General;
use crate::tables::{integers, list, table, wrapped};
use denavit_elimination::{Joint, Rigid, Split, Tables};
use denavit_emit::Attachment;
use std::f64::consts::TAU;
use std::fmt::Write;

/// The parts of the source file behind the types and the tables.
const PARTS: [&str; 10] = [
    include_str!("eliminate.c"),
    include_str!("determinant.c"),
    include_str!("roots.c"),
    include_str!("charts.c"),
    include_str!("extract.c"),
    include_str!("complete.c"),
    include_str!("newton.c"),
    include_str!("candidates.c"),
    include_str!("wide.c"),
    include_str!("solve.c"),
];
/// The function; with its test, unless something else tests it.
pub(super) fn attachment(general: &General, tables: &Tables, is_tested: bool) -> Attachment {
    let about: String = general.about.iter().map(|line| wrapped(" * ", line, " ")).collect();
    let about = format!("/*\n{}\n */", about.trim_end());
    Attachment {
        name: "solve".into(),
        declarations: include_str!("declarations.h").replace("@about@", &about),
        definitions: include_str!("head.c").to_string() + &constants(general, tables) + &PARTS.concat(),
        test: if is_tested { test(general) } else { String::new() },
        ..Attachment::default()
    }
}

/// The tables.
fn constants(general: &General, tables: &Tables) -> String {
    let axes = &general.axes;
    let slides = tables.arm.joints.map(|joint| u8::from(joint == Joint::Prismatic));
    let angles = general.is_angle.map(u8::from);
    let count = tables.splits.len();
    let mut text = format!(
        "\n/*\n * The arm: B Z1 A1 Z2 A2 ... Z6 A6, where Zi turns about z (or moves along z); lengths are\n * divided by its \
         size.\n */\n\nenum {{ IK_SPLITS = {count} }};\n\nstatic const double ik_size = {:?};\n\n\
         static const int ik_slides[6] = {};\n\nstatic const ik_rigid ik_base =\n{};\n",
        tables.size,
        integers(&slides),
        rigid(&tables.arm.base, 4)
    );
    let links: Vec<String> = tables.arm.links.iter().map(|link| rigid(link, 4)).collect();
    let _ = write!(text, "\nstatic const ik_rigid ik_links[6] = {{\n{}\n}};\n", links.join(",\n"));
    text.push_str("\n/* The joint variables are coupling (axes - offsets). */\n");
    text.push_str(&matrix("ik_coupling[6][6]", &axes.inverse));
    text.push_str(&vector("ik_offsets[6]", &axes.offsets));
    let _ = write!(text, "\nstatic const int ik_is_angle[6] = {};\n", integers(&angles));

    text.push_str(
        "\n/* Angles at which the determinant is sampled, and what the samples add to harmonics. */\n",
    );
    let at = &tables.samples;
    text.push_str(&samples("ik_", "IK_SAMPLES", [&at.cosines, &at.sines], &at.transform));
    text.push_str("\n/* Where the search for roots starts. */\n");
    let starts: Vec<[f64; 2]> =
        (0..16).map(|k| TAU * (f64::from(k) + 0.3) / 16.0).map(|a| [a.cos(), a.sin()]).collect();
    text.push_str(&matrix("ik_start[IK_ROOTS][2]", &starts));

    text.push_str("\n/* The same of the wider matrix. */\n");
    let at = &tables.wide;
    text.push_str(&samples("ik_wide_", "IK_WIDE_SAMPLES", [&at.cosines, &at.sines], &at.transform));
    text.push_str("\n/* What its rows are mixed of. */\n");
    text.push_str(&matrix("ik_mixtures[IK_MONOMIALS][6]", &tables.mixtures));

    text.push_str("\n/* The splits in the order in which they are tried. */\n");
    let splits: Vec<String> = tables.splits.iter().map(split).collect();
    let _ = write!(text, "static const ik_split ik_splits[IK_SPLITS] = {{\n{}\n}};\n", splits.join(",\n"));
    text
}

fn samples(prefix: &str, count: &str, [cosines, sines]: [&[f64]; 2], transform: &[Vec<f64>]) -> String {
    vector(&format!("{prefix}cosines[{count}]"), cosines)
        + &vector(&format!("{prefix}sines[{count}]"), sines)
        + &matrix(&format!("{prefix}transform[{count}][{count}]"), transform)
}

fn split(split: &Split) -> String {
    let slides = split.kinds.map(|joint| u8::from(joint == Joint::Prismatic));
    let links: Vec<String> = split.links.iter().map(|link| rigid(link, 12)).collect();
    let left: Vec<String> = split.left.iter().map(|row| list(row, 12)).collect();
    format!(
        "    {{\n        {},\n        {},\n        {:?},\n        {{\n{}\n        }},\n        {},\n        {},\n        \
         {{\n{}\n        }}\n    }}",
        integers(&split.joints),
        integers(&slides),
        split.sign,
        links.join(",\n"),
        split.pose_link,
        u8::from(split.last_multiplied),
        left.join(",\n")
    )
}

/// `{{row, row, row}, translation}`
fn rigid(x: &Rigid, indent: usize) -> String {
    let margin = " ".repeat(indent);
    let rows: Vec<String> = x.rotation.iter().map(|row| list(row, indent + 8)).collect();
    format!(
        "{margin}{{\n{margin}    {{\n{}\n{margin}    }},\n{}\n{margin}}}",
        rows.join(",\n"),
        list(&x.translation, indent + 4)
    )
}

fn vector(name: &str, values: &[f64]) -> String {
    format!("\nstatic const double {name} =\n{};\n", list(values, 4))
}

fn matrix<R: AsRef<[f64]>>(name: &str, rows: &[R]) -> String {
    format!("\nstatic const double {name} = {{\n{}\n}};\n", table(rows))
}

fn test(general: &General) -> String {
    let vectors = &general.vectors;
    if vectors.is_empty() {
        return "\n/* There is no pose at which rounding leaves no doubt. */\nstatic void test_solve(void)\n{\n}\n".into();
    }
    let poses: Vec<Vec<f64>> = vectors.iter().map(|v| v.pose.concat()).collect();
    let mut known: Vec<Vec<f64>> = vectors.iter().flat_map(|v| v.solutions.iter().cloned()).collect();
    if known.is_empty() {
        known.push(vec![0.0; 6]);
    }
    let given: Vec<Vec<f64>> =
        vectors.iter().map(|v| v.configuration.clone().unwrap_or_else(|| vec![0.0; 6])).collect();
    let mut first = vec![0];
    for v in vectors {
        first.push(first.last().copied().unwrap_or(0) + v.solutions.len());
    }
    let inner = |list: Vec<String>| wrapped("    ", &list.join(", "), "").trim_end().to_string();
    let first = inner(first.iter().map(usize::to_string).collect());
    let has_given = inner(vectors.iter().map(|v| u8::from(v.configuration.is_some()).to_string()).collect());
    let angles: Vec<String> = general.is_angle.iter().map(|&is| u8::from(is).to_string()).collect();
    include_str!("test_solve.c")
        .replace("@count@", &vectors.len().to_string())
        .replace("@known_count@", &known.len().to_string())
        .replace("@poses@", &table(&poses))
        .replace("@known@", &table(&known))
        .replace("@given@", &table(&given))
        .replace("@first@", &first)
        .replace("@has_given@", &has_given)
        .replace("@unit@", &format!("{:?}", general.unit))
        .replace("@angles@", &angles.join(", "))
}
