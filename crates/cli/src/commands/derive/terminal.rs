//! The derivation for a terminal.

use crate::arguments::Format;
use crate::commands::document;
use crate::commands::show::{dh_table, title};
use crate::terminal::{Align, FAINT, HEADING, NAME, lowered, matrix, matrix_width, raised, styled, words};
use denavit::geometry::orientation::OrientationSet;
use denavit_program::COUNTING_RULE;
use denavit_report::document::{Block, Math};
use denavit_report::words::Tongue;
use denavit_report::{Derivation, Part, Section};
use denavit_symbolic::Expr;
use denavit_symbolic::print::Style;
use std::fmt::Write;

/// Wider matrices are printed entry by entry.
const WIDTH: usize = 110;

/// Table, link transforms, forward model and algorithm.
pub fn whole(d: &Derivation) -> String {
    let mut text = title(d.description) + &dh_table(d.description);
    let _ = writeln!(text, "\n{}", styled("Link transforms", HEADING));
    for (i, link) in d.links.iter().enumerate() {
        let label = label(&i.to_string(), &(i + 1).to_string());
        text.push('\n');
        text += &named_matrix(d, &label, link);
    }
    text + "\n" + &forward(d) + "\n" + &algorithm(d)
}

fn label(from: &str, to: &str) -> String {
    match (from.parse::<usize>(), to.parse::<usize>()) {
        (Ok(_), Ok(_)) => format!("{}T{}", raised(from), lowered(to)),
        _ => format!("T({from} → {to})"),
    }
}

fn named_matrix(d: &Derivation, label: &str, rows: &[[Expr; 4]; 4]) -> String {
    let entries: Vec<Vec<String>> =
        rows.iter().map(|row| row.iter().map(|&e| d.text(e, Style::Unicode)).collect()).collect();
    if matrix_width(&entries) <= WIDTH {
        return matrix(&format!("{label} = "), &entries, Align::Left);
    }
    let mut text = String::new();
    for column in 0..4 {
        for (row, entry) in entries.iter().enumerate().take(3) {
            let name = styled(&format!("t{}{}", row + 1, column + 1), NAME);
            let _ = writeln!(text, "  {name} = {}", entry[column]);
        }
    }
    text
}

/// The orientation as angles.
pub fn angles(d: &Derivation, set: OrientationSet, all: &[(&'static str, Expr)]) -> String {
    if all.is_empty() {
        return String::new();
    }
    let mut text = format!("\n{}\n\n", styled(&format!("Orientation as {set}"), HEADING));
    for (name, value) in all {
        let _ = writeln!(text, "  {} = {}", styled(name, NAME), d.text(*value, Style::Unicode));
    }
    text + &format!("  {}\n", styled("where the middle angle does not make it singular", FAINT))
}

/// A section with words and equations.
pub fn section(section: &Section) -> String {
    let mut blocks = vec![];
    for part in &section.parts {
        match part {
            Part::Block(block) => blocks.push(block.clone()),
            Part::Equations(all) => {
                let formula = |math: &Math| Block::Formula { math: math.clone(), number: None, proof: None };
                blocks.extend(all.iter().map(formula));
            }
            _ => {}
        }
    }
    let text = document::document_in(Tongue::English, "", &section.names, &blocks, Format::Terminal);
    if text.starts_with('\n') { text } else { format!("\n{text}") }
}

/// The simplified model.
pub fn forward(d: &Derivation) -> String {
    let [from, to] = d.frames();
    let mut text = format!("{}\n\n", styled(&format!("Forward model {}", label(&from, &to)), HEADING));
    match &d.model.matrix {
        Ok(rows) => text += &named_matrix(d, &label(&from, &to), rows),
        Err(why) => {
            let _ = writeln!(text, "  not expanded: {why}");
        }
    }
    text
}

fn algorithm(d: &Derivation) -> String {
    let mut text = format!("{}\n\n", styled("Algorithm", HEADING));
    let plain = |e: Expr| d.in_full(e, Style::Unicode);
    let trigonometry = d.trigonometry();
    for of_one_angle in trigonometry.chunk_by(|a, b| a.0[1..] == b.0[1..]) {
        let line: Vec<String> =
            of_one_angle.iter().map(|(name, value)| format!("{name} = {}", plain(*value))).collect();
        let _ = writeln!(text, "  {}", line.join(",  "));
    }
    for step in &d.steps {
        let value = d.text(step.value, Style::Unicode);
        let mark = if step.is_output { styled(&step.name, NAME) } else { step.name.clone() };
        let _ = writeln!(text, "  {mark} = {value}");
    }
    let _ = writeln!(text, "\n  {}", styled(&d.model.algorithm.count().to_string(), HEADING));
    let _ = writeln!(text, "  {}", styled(&format!("counted: {COUNTING_RULE}"), FAINT));
    let is_part = |name: &str| {
        let digits = name.trim_start_matches(['x', 'y', 'z', 'p']).trim_end_matches(['x', 'y', 'z']);
        name.len() > digits.len() + 1 && digits.bytes().all(|b| b.is_ascii_digit()) && !digits.is_empty()
    };
    if d.steps.iter().any(|s| is_part(&s.name)) {
        let meaning =
            "names: x3y is the y component, in frame 3, of the last x axis (so y, z); p a partial position";
        let _ = writeln!(text, "  {}", styled(meaning, FAINT));
    }
    let _ = writeln!(text, "  {}", words().forward_proof(d.model.proof));
    text
}
