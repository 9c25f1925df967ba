//! The derivation as one self-contained web page with MathML.

use super::Derivation;
use denavit_symbolic::Expr;
use denavit_symbolic::print::Style;
use std::fmt::Write;

/// Matrices get their brackets from borders: without a mathematical font a browser does not stretch the characters.
const STYLE: &str = "body{font:16px/1.5 system-ui,sans-serif;max-width:70rem;margin:2rem auto;padding:0 1rem}\
math{font-size:1.1em}div.formula{margin:.3rem 0 .3rem 1.5rem;padding:.15rem 0;overflow-x:auto;overflow-y:hidden}\
mtable{border:solid currentColor;border-width:0 1.5px;border-radius:.5em;padding:0 .3em}p.note{opacity:.75}\
@media(prefers-color-scheme:dark){body{background:#15171a;color:#e4e6ea}}";

/// The page.
pub fn document(d: &Derivation) -> String {
    let mut text = head(&d.description.name) + "<h2>Link transforms</h2>\n";
    for (i, link) in d.links.iter().enumerate() {
        text += &formula(&frame_label(&i.to_string(), &(i + 1).to_string()), &matrix(d, link));
    }
    let [from, to] = d.frames();
    let _ = writeln!(text, "<h2>Forward model <math>{}</math></h2>", frame_label(&from, &to));
    if let Ok(rows) = &d.model.matrix {
        for column in 0..4 {
            for (row, cells) in rows.iter().enumerate().take(3) {
                let left = format!("<msub><mi>t</mi><mn>{}{}</mn></msub>", row + 1, column + 1);
                text += &formula(&left, &d.text(cells[column], Style::MathMl));
            }
        }
    }
    text += "<h2>Algorithm</h2>\n";
    for (_, e) in d.trigonometry() {
        text += &formula(&d.text(e, Style::MathMl), &d.in_full(e, Style::MathMl));
    }
    for step in &d.steps {
        text +=
            &formula(&d.text(Expr::symbol(&step.name), Style::MathMl), &d.text(step.value, Style::MathMl));
    }
    let _ = writeln!(text, "<p>{}</p>", escaped(&d.model.algorithm.count().to_string()));
    let _ = writeln!(text, "<p class=\"note\">{}</p>", escaped(&d.model.proof.to_string()));
    text + END
}

/// The page up to its heading.
pub fn head(title: &str) -> String {
    let title = escaped(title);
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n"
    )
}

/// The end of a page.
pub const END: &str = "</body>\n</html>\n";

fn formula(left: &str, right: &str) -> String {
    format!(
        "<div class=\"formula\"><math displaystyle=\"true\"><mrow>{left}<mo>=</mo>{right}</mrow></math></div>\n"
    )
}

fn frame_label(from: &str, to: &str) -> String {
    let (from, to) = (escaped(from), escaped(to));
    format!(
        "<mmultiscripts><mi>T</mi><mtext>{to}</mtext><none/><mprescripts/><none/><mtext>{from}</mtext></mmultiscripts>"
    )
}

fn matrix(d: &Derivation, rows: &[[Expr; 4]; 4]) -> String {
    let rows: String = rows
        .iter()
        .map(|row| {
            let cells: String =
                row.iter().map(|&e| format!("<mtd>{}</mtd>", d.text(e, Style::MathMl))).collect();
            format!("<mtr>{cells}</mtr>")
        })
        .collect();
    format!("<mtable>{rows}</mtable>")
}

/// Text outside of formulas.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
