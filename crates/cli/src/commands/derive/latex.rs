//! The derivation as LaTeX: sections with `align*` and `bmatrix`, for a document with `amsmath`.

use super::Derivation;
use denavit_symbolic::Expr;
use denavit_symbolic::print::Style;
use std::fmt::Write;

/// The first line of a fragment.
pub const HEAD: &str = concat!("% Made by denavit ", env!("CARGO_PKG_VERSION"), "; needs amsmath.\n");

/// A fragment to paste into a document.
pub fn document(d: &Derivation) -> String {
    let mut text = HEAD.to_string();
    let _ =
        writeln!(text, "\\section*{{{}}}\n\\subsection*{{Link transforms}}", escaped(&d.description.name));
    for (i, link) in d.links.iter().enumerate() {
        let _ = writeln!(text, "\\[ {{}}^{{{i}}}T_{{{}}} = {} \\]", i + 1, matrix(d, link));
    }
    let [from, to] =
        d.frames().map(|f| if f.parse::<usize>().is_ok() { f } else { format!("\\mathrm{{{f}}}") });
    let _ = writeln!(text, "\\subsection*{{Forward model ${{}}^{{{from}}}T_{{{to}}}$}}");
    if let Ok(rows) = &d.model.matrix {
        let mut entries = vec![];
        for column in 0..4 {
            for (row, cells) in rows.iter().enumerate().take(3) {
                let value = d.text(cells[column], Style::Latex);
                entries.push(format!("t_{{{}{}}} &= {value}", row + 1, column + 1));
            }
        }
        let _ = writeln!(text, "\\begin{{align*}}\n{}\n\\end{{align*}}", entries.join(" \\\\\n"));
    }
    let _ = writeln!(text, "\\subsection*{{Algorithm}}");
    let trigonometry = d
        .trigonometry()
        .into_iter()
        .map(|(_, e)| format!("{} &= {}", d.text(e, Style::Latex), d.in_full(e, Style::Latex)));
    let steps = d.steps.iter().map(|s| {
        format!("{} &= {}", d.text(Expr::symbol(&s.name), Style::Latex), d.text(s.value, Style::Latex))
    });
    let lines: Vec<String> = trigonometry.chain(steps).collect();
    let _ = writeln!(text, "\\begin{{align*}}\n{}\n\\end{{align*}}", lines.join(" \\\\\n"));
    let _ = writeln!(
        text,
        "{}; {}.",
        escaped(&d.model.algorithm.count().to_string()),
        escaped(&d.model.proof.to_string())
    );
    text
}

fn matrix(d: &Derivation, rows: &[[Expr; 4]; 4]) -> String {
    let rows: Vec<String> = rows
        .iter()
        .map(|row| row.iter().map(|&e| d.text(e, Style::Latex)).collect::<Vec<_>>().join(" & "))
        .collect();
    format!("\\begin{{bmatrix}} {} \\end{{bmatrix}}", rows.join(" \\\\ "))
}

/// Text outside of formulas.
pub fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '\\' => out.push_str("\\textbackslash{}"),
            '~' => out.push_str("\\textasciitilde{}"),
            '^' => out.push_str("\\textasciicircum{}"),
            '#' | '$' | '%' | '&' | '_' | '{' | '}' => out.extend(['\\', c]),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}
