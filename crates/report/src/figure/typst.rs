//! A drawing in Typst's own markup.

use super::drawing::{Anchor, Drawing, Label, Segment, Shape};
use super::naming::{INDEX, width};
use super::svg::{hex, number, rgb};
use std::fmt::Write;

/// The drawing as a `#box` with everything placed in it.
pub fn typst(drawing: &Drawing) -> String {
    let [w, h] = [drawing.width, drawing.height].map(number);
    let mut out = format!("#box(width: {w}pt, height: {h}pt, clip: true)[\n");
    for shape in &drawing.shapes {
        match shape {
            Shape::Path { segments, fill, stroke } => {
                out.push_str("#place(top + left, curve(");
                if let Some(fill) = fill {
                    let _ = write!(out, "fill: rgb(\"{}\"), ", hex(rgb(*fill)));
                }
                match stroke {
                    None => out.push_str("stroke: none, "),
                    Some(s) => {
                        let (paint, thickness) = (hex(rgb(s.ink)), number(s.width));
                        let _ = write!(
                            out,
                            "stroke: (paint: rgb(\"{paint}\"), thickness: {thickness}pt, join: \"round\""
                        );
                        if let Some(dash) = s.dash {
                            let _ = write!(out, ", dash: ({}pt, {}pt)", number(dash), number(0.7 * dash));
                        }
                        out.push_str("), ");
                    }
                }
                path(segments, &mut out);
                out.push_str("))\n");
            }
            Shape::Text { at, anchor, size, ink, label } => {
                // A box of no width, so that the text grows to the side that its anchor leaves.
                let estimate = width(label, *size) + 20.0;
                let (align, left) = match anchor {
                    Anchor::Start => ("left", at[0]),
                    Anchor::Middle => ("center", at[0] - estimate / 2.0),
                    Anchor::End => ("right", at[0] - estimate),
                };
                let _ = writeln!(
                    out,
                    "#place(top + left, dx: {}pt, dy: {}pt, box(width: {}pt, height: {}pt, align({align} + bottom, \
                     text(size: {}pt, fill: rgb(\"{}\"), bottom-edge: \"baseline\", top-edge: \"baseline\")[{}])))",
                    number(left),
                    number(at[1] - size),
                    number(estimate),
                    number(*size),
                    number(*size),
                    hex(rgb(*ink)),
                    text(label)
                );
            }
        }
    }
    out.push_str("]\n");
    out
}

fn path(segments: &[Segment], out: &mut String) {
    let point = |p: &[f64; 2]| format!("({}pt, {}pt)", number(p[0]), number(p[1]));
    let parts: Vec<String> = segments
        .iter()
        .map(|segment| match segment {
            Segment::Move(p) => format!("curve.move({})", point(p)),
            Segment::Line(p) => format!("curve.line({})", point(p)),
            Segment::Cubic(a, b, p) => format!("curve.cubic({}, {}, {})", point(a), point(b), point(p)),
            Segment::Close => "curve.close(mode: \"straight\")".into(),
        })
        .collect();
    out.push_str(&parts.join(", "));
}

fn text(label: &Label) -> String {
    let mut out = String::new();
    for piece in label.0.iter().filter(|p| !p.text.is_empty()) {
        let style = if piece.italic { ", style: \"italic\"" } else { "" };
        let (size, shift) = if piece.subscript { (number(INDEX), true) } else { ("1".into(), false) };
        let words = format!("text(size: {size}em{style}, {})", string(&piece.text));
        let _ = match shift {
            // Lowered by a quarter of a letter of full size.
            true => write!(out, "#box(move(dy: 0.25em, {words}))"),
            false => write!(out, "#{words}"),
        };
    }
    out
}

/// A string literal.
fn string(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => {
                out.push('\\');
                out.push(c);
            }
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
