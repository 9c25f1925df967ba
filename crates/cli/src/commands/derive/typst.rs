//! The derivation as Typst markup.

use super::Derivation;
use denavit_symbolic::Expr;
use denavit_symbolic::print::Style;
use std::fmt::Write;

/// The first lines of a fragment.
pub const HEAD: &str = concat!(
    "// Made by denavit ",
    env!("CARGO_PKG_VERSION"),
    "\n#show math.equation: set block(breakable: true)\n"
);

/// A fragment to paste into a document.
pub fn document(d: &Derivation) -> String {
    let mut text = HEAD.to_string();
    let _ = writeln!(text, "#heading(level: 1, {})\n\n== Link transforms\n", quoted(&d.description.name));
    for (i, link) in d.links.iter().enumerate() {
        let _ = writeln!(text, "$ attach(T, tl: {i}, br: {}) = {} $\n", i + 1, matrix(d, link));
    }
    let [from, to] = d.frames().map(|f| quoted(&f));
    let _ = writeln!(text, "== Forward model $attach(T, tl: {from}, br: {to})$\n");
    if let Ok(rows) = &d.model.matrix {
        let mut lines = vec![];
        for column in 0..4 {
            for (row, cells) in rows.iter().enumerate().take(3) {
                lines.push(format!(
                    "$t_{}{} = {}$",
                    row + 1,
                    column + 1,
                    d.text(cells[column], Style::Typst)
                ));
            }
        }
        // In a line of text, a long formula breaks.
        let _ = writeln!(text, "{}\n", lines.join("\n\n"));
    }
    let trigonometry = d
        .trigonometry()
        .into_iter()
        .map(|(_, e)| format!("{} &= {}", d.text(e, Style::Typst), d.in_full(e, Style::Typst)));
    let steps = d.steps.iter().map(|s| {
        format!("{} &= {}", d.text(Expr::symbol(&s.name), Style::Typst), d.text(s.value, Style::Typst))
    });
    let lines: Vec<String> = trigonometry.chain(steps).collect();
    let _ = writeln!(text, "== Algorithm\n\n$ {} $\n", lines.join(" \\\n  "));
    let _ = writeln!(text, "#{}", quoted(&format!("{}; {}.", d.model.algorithm.count(), d.model.proof)));
    text
}

fn matrix(d: &Derivation, rows: &[[Expr; 4]; 4]) -> String {
    let rows: Vec<String> = rows
        .iter()
        .map(|row| row.iter().map(|&e| d.text(e, Style::Typst)).collect::<Vec<_>>().join(", "))
        .collect();
    format!("mat(delim: \"[\", {})", rows.join("; "))
}

/// A Typst string.
pub fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\"").replace(char::is_control, " "))
}
