//! A drawing as a TikZ picture; needs the packages `tikz` and `xcolor` only.

use super::drawing::{Anchor, Drawing, Ink, Label, Segment, Shape};
use super::svg::{number, rgb};
use denavit_symbolic::greek;
use std::fmt::Write;

/// The drawing as a `tikzpicture` environment.
pub fn tikz(drawing: &Drawing) -> String {
    let mut out = String::from("\\begin{tikzpicture}[x=1bp,y=-1bp,line join=round]\n");
    let inks = inks(drawing);
    for colour in &inks {
        let [r, g, b] = *colour;
        let _ = writeln!(out, "\\definecolor{{{}}}{{RGB}}{{{r},{g},{b}}}", name(*colour));
    }
    let [w, h] = [drawing.width, drawing.height].map(number);
    let _ = writeln!(out, "\\path[use as bounding box,clip] (0,0) rectangle ({w},{h});");
    for shape in &drawing.shapes {
        match shape {
            Shape::Path { segments, fill, stroke } => {
                let mut options = vec![];
                options.extend(fill.map(|f| format!("fill={}", name(rgb(f)))));
                if let Some(s) = stroke {
                    options.push(format!("draw={},line width={}bp", name(rgb(s.ink)), number(s.width)));
                    options.extend(
                        s.dash.map(|d| format!("dash pattern=on {}bp off {}bp", number(d), number(0.7 * d))),
                    );
                }
                let _ = writeln!(out, "\\path[{}] {};", options.join(","), path(segments));
            }
            Shape::Text { at, anchor, size, ink, label } => {
                let anchor = match anchor {
                    Anchor::Start => "base west",
                    Anchor::Middle => "base",
                    Anchor::End => "base east",
                };
                let _ = writeln!(
                    out,
                    "\\node[anchor={anchor},inner sep=0pt,outer sep=0pt,text={},font=\\fontsize{{{}bp}}{{{}bp}}\\selectfont] at ({},{}) {{{}}};",
                    name(rgb(*ink)),
                    number(*size),
                    number(1.2 * size),
                    number(at[0]),
                    number(at[1]),
                    text(label)
                );
            }
        }
    }
    out.push_str("\\end{tikzpicture}\n");
    out
}

/// The colours that occur, each once.
fn inks(drawing: &Drawing) -> Vec<[u8; 3]> {
    let used = drawing.shapes.iter().flat_map(|shape| match shape {
        Shape::Path { fill, stroke, .. } => [*fill, stroke.map(|s| s.ink)],
        Shape::Text { ink, .. } => [Some(*ink), None::<Ink>],
    });
    let mut colours: Vec<[u8; 3]> = used.flatten().map(rgb).collect();
    colours.sort_unstable();
    colours.dedup();
    colours
}

fn name([r, g, b]: [u8; 3]) -> String {
    format!("d{r:02x}{g:02x}{b:02x}")
}

fn path(segments: &[Segment]) -> String {
    let point = |p: &[f64; 2]| format!("({},{})", number(p[0]), number(p[1]));
    let mut out = String::new();
    for segment in segments {
        let _ = match segment {
            Segment::Move(p) => write!(out, " {}", point(p)),
            Segment::Line(p) => write!(out, " -- {}", point(p)),
            Segment::Cubic(a, b, p) => {
                write!(out, " .. controls {} and {} .. {}", point(a), point(b), point(p))
            }
            Segment::Close => write!(out, " -- cycle"),
        };
    }
    out.trim_start().to_string()
}

/// A label: symbols as formulas, words as they are.
fn text(label: &Label) -> String {
    let mut out = String::new();
    for piece in label.0.iter().filter(|p| !p.text.is_empty()) {
        let inner = escape(&piece.text, piece.italic);
        let styled = if piece.italic { inner } else { format!("\\mathrm{{{inner}}}") };
        let _ = match piece.subscript {
            true => write!(out, "_{{{styled}}}"),
            false => write!(out, "{{{styled}}}"),
        };
    }
    format!("${out}$")
}

/// Text inside a formula.
fn escape(text: &str, italic: bool) -> String {
    let mut out = String::new();
    let letters = text.chars().filter(|c| c.is_alphabetic()).count();
    for c in text.chars() {
        match c {
            '\\' => out.push_str("\\backslash{}"),
            '{' | '}' | '$' | '&' | '#' | '%' | '_' => {
                out.push('\\');
                out.push(c);
            }
            '^' => out.push_str("\\mbox{\\textasciicircum}"),
            '~' => out.push_str("\\sim{}"),
            '−' => out.push('-'),
            ' ' | '\u{a0}' => out.push_str("\\ "),
            '\u{2009}' => out.push_str("\\,"),
            '\'' => out.push_str("{'}"),
            c if c.is_control() => out.push_str("\\ "),
            c => match greek::name(c) {
                Some(name) => {
                    let _ = write!(out, "\\{name}{{}}");
                }
                None if c.is_ascii() => out.push(c),
                // Formulas have no accents.
                None => {
                    let _ = write!(out, "\\mbox{{{c}}}");
                }
            },
        }
    }
    // Several letters are a name, not a product.
    if italic && letters > 1 { format!("\\mathit{{{out}}}") } else { out }
}
