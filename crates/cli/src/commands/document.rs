//! A derivation in each format of documents: a document tree to text, LaTeX, Typst, HTML.

use crate::arguments::Format;
use crate::commands::derive::{html, latex, typst};
use crate::terminal::{FAINT, HEADING, NAME, styled};
use denavit::explain::{Block, Branch, Line, Mark, Math, Piece, Proof, math, text};
use denavit_symbolic::print::Style;
use denavit_symbolic::vocabulary::Vocabulary;
use std::fmt::Write;

/// The document, with a title for the page; JSON is not made here.
pub fn document(title: &str, names: &Vocabulary, blocks: &[Block], format: Format) -> String {
    match format {
        Format::Terminal | Format::Json => text(blocks, names, &|mark, words| {
            let style = match mark {
                Mark::Heading => HEADING,
                Mark::Strong => NAME,
                Mark::Faint => FAINT,
            };
            styled(words, style)
        }),
        Format::Latex => in_latex(blocks, names),
        Format::Typst => in_typst(blocks, names),
        Format::Html => in_html(title, blocks, names),
    }
}

/// The mark behind a formula.
fn mark(proof: Option<Proof>, marks: [&'static str; 3]) -> &'static str {
    match proof {
        None => "",
        Some(Proof::Proved) => marks[0],
        Some(Proof::Sampled) => marks[1],
        Some(Proof::Wrong) => marks[2],
    }
}

fn in_latex(blocks: &[Block], names: &Vocabulary) -> String {
    let formula = |m: &Math| math(m, names, Style::Latex);
    let words = |line: &Line| -> String {
        line.0
            .iter()
            .map(|p| match p {
                Piece::Text(t) => latex::escaped(t)
                    .replace('✓', "$\\checkmark$")
                    .replace('≈', "$\\approx$")
                    .replace('−', "--")
                    .replace('·', "$\\cdot$")
                    .replace('→', "$\\to$")
                    .replace('θ', "$\\theta$"),
                Piece::Strong(t) => format!("\\textbf{{{}}}", latex::escaped(t).replace('−', "--")),
                Piece::Math(m) => format!("${}$", formula(m)),
            })
            .collect()
    };
    let mut out = latex::HEAD.replace("needs amsmath", "needs amsmath and amssymb");
    for block in blocks {
        match block {
            Block::Heading(level, line) => {
                let command =
                    ["section", "section", "subsection", "subsubsection"][usize::from(*level).min(3)];
                let _ = writeln!(out, "\\{command}*{{{}}}", words(line));
            }
            Block::Paragraph(line) => {
                let _ = writeln!(out, "\n\\noindent {}", words(line));
            }
            Block::Formula { math: m, number, proof } => {
                let tag = match number {
                    Some(n) => format!(" \\tag{{{n}}}"),
                    None => String::new(),
                };
                let mark =
                    mark(*proof, [" \\quad\\checkmark", " \\quad\\approx", " \\quad\\textbf{NOT TRUE}"]);
                let environment = if number.is_some() { "equation" } else { "equation*" };
                let _ = writeln!(
                    out,
                    "\\begin{{{environment}}} {}{mark}{tag} \\end{{{environment}}}",
                    formula(m)
                );
            }
            Block::List(lines) => {
                out += "\\begin{itemize}\n";
                for line in lines {
                    let _ = writeln!(out, "  \\item {}", words(line));
                }
                out += "\\end{itemize}\n";
            }
            Block::Tree(branch) => {
                nested(branch, 0, &mut out, &mut |out, depth, part| {
                    let indent = "  ".repeat(depth);
                    match part {
                        Part::Open => writeln!(out, "{indent}\\begin{{itemize}}"),
                        Part::Item(line) => writeln!(out, "{indent}  \\item {}", words(line)),
                        Part::Close => writeln!(out, "{indent}\\end{{itemize}}"),
                    }
                });
            }
        }
    }
    out
}

fn in_typst(blocks: &[Block], names: &Vocabulary) -> String {
    let formula = |m: &Math| math(m, names, Style::Typst);
    let words = |line: &Line| -> String {
        line.0
            .iter()
            .map(|p| match p {
                Piece::Text(t) => format!("#{};", typst::quoted(t)),
                Piece::Strong(t) => format!("#strong({});", typst::quoted(t)),
                Piece::Math(m) => format!("${}$", formula(m)),
            })
            .collect()
    };
    let mut out = typst::HEAD.to_string();
    for block in blocks {
        match block {
            Block::Heading(level, line) => {
                let _ = writeln!(out, "#heading(level: {level})[{}]\n", words(line));
            }
            Block::Paragraph(line) => {
                let _ = writeln!(out, "{}\n", words(line));
            }
            Block::Formula { math: m, number, proof } => {
                let mark = mark(*proof, [" quad checkmark", " quad approx", " quad \"NOT TRUE\""]);
                let number = number.map(|n| format!(" quad ({n})")).unwrap_or_default();
                let _ = writeln!(out, "$ {}{number}{mark} $\n", formula(m));
            }
            Block::List(lines) => {
                for line in lines {
                    let _ = writeln!(out, "- {}", words(line));
                }
                out.push('\n');
            }
            Block::Tree(branch) => {
                nested(branch, 0, &mut out, &mut |out, depth, part| match part {
                    Part::Item(line) => writeln!(out, "{}- {}", "  ".repeat(depth), words(line)),
                    Part::Open | Part::Close => Ok(()),
                });
                out.push('\n');
            }
        }
    }
    out
}

fn in_html(title: &str, blocks: &[Block], names: &Vocabulary) -> String {
    let formula = |m: &Math| math(m, names, Style::MathMl);
    let words = |line: &Line| -> String {
        line.0
            .iter()
            .map(|p| match p {
                Piece::Text(t) => html::escaped(t),
                Piece::Strong(t) => format!("<strong>{}</strong>", html::escaped(t)),
                Piece::Math(m) => format!("<math>{}</math>", formula(m)),
            })
            .collect()
    };
    let mut out = html::head(title);
    for block in blocks {
        match block {
            // The page has its title.
            Block::Heading(1, _) => {}
            Block::Heading(level, line) => {
                let _ = writeln!(out, "<h{level}>{}</h{level}>", words(line));
            }
            Block::Paragraph(line) => {
                let _ = writeln!(out, "<p>{}</p>", words(line));
            }
            Block::Formula { math: m, number, proof } => {
                let number = number.map(|n| format!(" ({n})")).unwrap_or_default();
                let mark = mark(*proof, [" ✓", " ≈", " NOT TRUE"]);
                let tail = format!("{number}{mark}");
                let tail = if tail.is_empty() {
                    tail
                } else {
                    format!(" <small>&emsp;{}</small>", tail.trim_start())
                };
                let _ = writeln!(
                    out,
                    "<div class=\"formula\"><math displaystyle=\"true\">{}</math>{tail}</div>",
                    formula(m)
                );
            }
            Block::List(lines) => {
                out += "<ul>\n";
                for line in lines {
                    let _ = writeln!(out, "<li>{}</li>", words(line));
                }
                out += "</ul>\n";
            }
            Block::Tree(branch) => {
                nested(branch, 0, &mut out, &mut |out, _, part| match part {
                    Part::Open => writeln!(out, "<ul>"),
                    Part::Item(line) => writeln!(out, "<li>{}</li>", words(line)),
                    Part::Close => writeln!(out, "</ul>"),
                });
            }
        }
    }
    out + html::END
}

/// What a nested list is written of.
enum Part<'a> {
    Open,
    Item(&'a Line),
    Close,
}

type Write1<'w> = dyn FnMut(&mut String, usize, Part) -> std::fmt::Result + 'w;

/// A tree as a list of lists.
fn nested(branch: &Branch, depth: usize, out: &mut String, write: &mut Write1) {
    // Writing to memory does not fail.
    let _ = write(out, depth, Part::Open);
    for child in &branch.children {
        let _ = write(out, depth, Part::Item(&child.line));
        if !child.children.is_empty() {
            nested(child, depth + 1, out, write);
        }
    }
    let _ = write(out, depth, Part::Close);
}
