//! A drawing as SVG: with fixed colours for a file, with a page's colours inside HTML.

use super::drawing::{Anchor, Drawing, Ink, Label, Segment, Shape, Stroke};
use super::naming::{INDEX, width};
use std::fmt::Write;

/// Where the text will stand.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Palette {
    /// In a file: fixed colours for a light page.
    File,
    /// In an HTML page that has [`style`], or nothing: custom properties, with the light colours where they are not
    /// defined.
    Page,
}

/// Letters as in formulas.
const FONT: &str = "'Latin Modern Roman','STIX Two Text',Cambria,'Times New Roman',serif";

/// The custom properties that drawings in a page use, for light and dark.
pub fn style() -> String {
    let mut light = String::new();
    let mut dark = String::new();
    for ink in named_inks() {
        let (name, l, d) = (property(ink), hex(rgb(ink)), hex(rgb_dark(ink)));
        // Writing to a string does not fail.
        let _ = write!(light, "{name}:{l};");
        let _ = write!(dark, "{name}:{d};");
    }
    format!(":root{{{light}}}\n@media (prefers-color-scheme:dark){{:root{{{dark}}}}}\n")
}

/// Inks that have a property of their own; shades are mixed of two.
fn named_inks() -> Vec<Ink> {
    let mut inks = vec![Ink::Line, Ink::Faint, Ink::Paper, Ink::Dimension, Ink::Accent];
    inks.extend([0, 1, 2].map(Ink::Axis));
    inks.extend((0..8).map(Ink::Series));
    for k in 0..=STEPS {
        let light = f64::from(k) / f64::from(STEPS);
        inks.extend([Ink::Body(light), Ink::Revolute(light), Ink::Prismatic(light), Ink::Scale(light)]);
    }
    inks
}

/// Shades in a page have so many steps beside 0.
const STEPS: u8 = 12;

fn step(x: f64) -> u8 {
    (x.clamp(0.0, 1.0) * f64::from(STEPS)).round() as u8
}

fn property(ink: Ink) -> String {
    match ink {
        Ink::Line => "--d-line".into(),
        Ink::Faint => "--d-faint".into(),
        Ink::Paper => "--d-paper".into(),
        Ink::Dimension => "--d-dimension".into(),
        Ink::Accent => "--d-accent".into(),
        Ink::Axis(k) => format!("--d-axis-{}", ["x", "y", "z"][usize::from(k.min(2))]),
        Ink::Series(k) => format!("--d-series-{}", k % 8),
        Ink::Body(x) => format!("--d-body-{}", step(x)),
        Ink::Revolute(x) => format!("--d-revolute-{}", step(x)),
        Ink::Prismatic(x) => format!("--d-prismatic-{}", step(x)),
        Ink::Scale(x) => format!("--d-scale-{}", step(x)),
    }
}

fn mix(x: f64, stops: &[[u8; 3]]) -> [u8; 3] {
    let x = if x.is_finite() { x.clamp(0.0, 1.0) } else { 0.0 } * (stops.len() - 1) as f64;
    let k = (x.floor() as usize).min(stops.len().saturating_sub(2));
    let t = x - k as f64;
    [0, 1, 2].map(|c| {
        let [a, b] = [stops[k][c], stops[(k + 1).min(stops.len() - 1)][c]].map(f64::from);
        (a + t * (b - a)).round() as u8
    })
}

/// Colours of series: distinct for most kinds of sight (Okabe and Ito 2008).
const SERIES: [[u8; 3]; 8] = [
    [0, 114, 178],
    [213, 94, 0],
    [0, 158, 115],
    [204, 121, 167],
    [148, 116, 0],
    [86, 180, 233],
    [110, 110, 110],
    [230, 159, 0],
];

/// A colour on a light page.
pub(crate) fn rgb(ink: Ink) -> [u8; 3] {
    match ink {
        Ink::Line => [26, 26, 26],
        Ink::Faint => [150, 156, 164],
        Ink::Paper => [255, 255, 255],
        Ink::Body(x) => mix(x, &[[92, 100, 112], [176, 184, 194], [244, 246, 249]]),
        Ink::Revolute(x) => mix(x, &[[28, 66, 118], [82, 138, 204], [206, 226, 247]]),
        Ink::Prismatic(x) => mix(x, &[[128, 74, 14], [222, 152, 62], [252, 228, 188]]),
        Ink::Axis(0) => [196, 30, 42],
        Ink::Axis(1) => [24, 132, 60],
        Ink::Axis(_) => [22, 76, 186],
        Ink::Dimension => [108, 62, 14],
        Ink::Accent => [208, 18, 98],
        Ink::Series(k) => SERIES[usize::from(k) % 8],
        Ink::Scale(x) => mix(x, &[[68, 1, 84], [49, 104, 142], [53, 183, 121], [253, 231, 37]]),
    }
}

/// A colour on a dark page.
pub(crate) fn rgb_dark(ink: Ink) -> [u8; 3] {
    match ink {
        Ink::Line => [226, 228, 232],
        Ink::Faint => [112, 118, 128],
        Ink::Paper => [24, 26, 30],
        Ink::Body(x) => mix(x, &[[44, 49, 57], [92, 100, 112], [168, 176, 188]]),
        Ink::Revolute(x) => mix(x, &[[22, 48, 88], [48, 98, 164], [124, 172, 228]]),
        Ink::Prismatic(x) => mix(x, &[[88, 50, 10], [166, 104, 32], [234, 180, 106]]),
        Ink::Axis(0) => [255, 112, 112],
        Ink::Axis(1) => [92, 208, 122],
        Ink::Axis(_) => [128, 172, 255],
        Ink::Dimension => [230, 186, 130],
        Ink::Accent => [255, 96, 164],
        Ink::Series(k) => SERIES[usize::from(k) % 8].map(|c| c + (255 - c) / 3),
        Ink::Scale(_) => rgb(ink),
    }
}

/// A colour as `#rrggbb`.
pub fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// A number with at most two decimals, the same everywhere.
pub fn number(x: f64) -> String {
    if !x.is_finite() {
        return "0".into();
    }
    let text = format!("{x:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

/// Text between tags or quotes.
fn escape(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            // XML knows no others.
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// The drawing as an `svg` element; `id` tells several in one page apart.
pub fn svg(drawing: &Drawing, palette: Palette, id: &str) -> String {
    let id: String = id.chars().filter(|c| c.is_ascii_alphanumeric() || *c == '-').collect();
    let [w, h] = [drawing.width, drawing.height].map(number);
    let about = escape(&drawing.description);
    let title = escape(drawing.description.split(',').next().unwrap_or_default());
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}pt\" height=\"{h}pt\" viewBox=\"0 0 {w} {h}\" \
         role=\"img\" aria-labelledby=\"d-{id}-title d-{id}-desc\" font-family=\"{FONT}\">\n\
         <title id=\"d-{id}-title\">{title}</title>\n<desc id=\"d-{id}-desc\">{about}</desc>\n"
    );
    if palette == Palette::File {
        let _ = writeln!(out, "<path d=\"M0 0H{w}V{h}H0Z\" fill=\"{}\"/>", hex(rgb(Ink::Paper)));
    }
    for shape in &drawing.shapes {
        match shape {
            Shape::Path { segments, fill, stroke } => path(segments, *fill, *stroke, palette, &mut out),
            Shape::Text { at, anchor, size, ink, label } => {
                // Not every program finds the middle of a text in several pieces.
                let wide = width(label, *size);
                let (anchor, left) = match anchor {
                    Anchor::Middle if label.0.len() > 1 => ("start", at[0] - 0.48 * wide),
                    Anchor::End if label.0.len() > 1 => ("start", at[0] - 0.96 * wide),
                    Anchor::Start => ("start", at[0]),
                    Anchor::Middle => ("middle", at[0]),
                    Anchor::End => ("end", at[0]),
                };
                let [x, y] = [left, at[1]].map(number);
                let _ = write!(
                    out,
                    "<text x=\"{x}\" y=\"{y}\" font-size=\"{}\" text-anchor=\"{anchor}\"{}>",
                    number(*size),
                    colour("fill", Some(*ink), palette)
                );
                spans(label, *size, &mut out);
                out.push_str("</text>\n");
            }
        }
    }
    out.push_str("</svg>\n");
    out
}

fn spans(label: &Label, size: f64, out: &mut String) {
    // Each shift is relative to the last.
    let mut low = false;
    for piece in label.0.iter().filter(|p| !p.text.is_empty()) {
        let mut attributes = String::new();
        if piece.subscript != low {
            let shift = if piece.subscript { 0.25 } else { -0.25 } * size;
            let _ = write!(attributes, " dy=\"{}\"", number(shift));
            low = piece.subscript;
        }
        if piece.subscript {
            let _ = write!(attributes, " font-size=\"{}\"", number(INDEX * size));
        }
        if piece.italic {
            attributes.push_str(" font-style=\"italic\"");
        }
        // Spaces at the ends of pieces would be lost.
        let text = if label.0.len() > 1 { piece.text.replace(' ', "\u{a0}") } else { piece.text.clone() };
        let _ = write!(out, "<tspan{attributes}>{}</tspan>", escape(&text));
    }
}

fn colour(attribute: &str, ink: Option<Ink>, palette: Palette) -> String {
    match (ink, palette) {
        (None, _) => format!(" {attribute}=\"none\""),
        (Some(ink), Palette::File) => format!(" {attribute}=\"{}\"", hex(rgb(ink))),
        (Some(ink), Palette::Page) => {
            format!(" style=\"{attribute}:var({},{})\"", property(ink), hex(rgb(ink)))
        }
    }
}

fn path(segments: &[Segment], fill: Option<Ink>, stroke: Option<Stroke>, palette: Palette, out: &mut String) {
    out.push_str("<path d=\"");
    let point = |p: &[f64; 2]| format!("{} {}", number(p[0]), number(p[1]));
    for segment in segments {
        let _ = match segment {
            Segment::Move(p) => write!(out, "M{}", point(p)),
            Segment::Line(p) => write!(out, "L{}", point(p)),
            Segment::Cubic(a, b, p) => write!(out, "C{} {} {}", point(a), point(b), point(p)),
            Segment::Close => write!(out, "Z"),
        };
    }
    out.push('"');
    // One style attribute an element.
    match (palette, fill, stroke) {
        (Palette::Page, Some(f), Some(s)) => {
            let [f, s] = [f, s.ink].map(|i| format!("var({},{})", property(i), hex(rgb(i))));
            let _ = write!(out, " style=\"fill:{f};stroke:{s}\"");
        }
        _ => {
            out.push_str(&colour("fill", fill, palette));
            if let Some(s) = stroke {
                out.push_str(&colour("stroke", Some(s.ink), palette));
            }
        }
    }
    if let Some(s) = stroke {
        let _ = write!(out, " stroke-width=\"{}\" stroke-linejoin=\"round\"", number(s.width));
        if let Some(dash) = s.dash {
            let _ = write!(out, " stroke-dasharray=\"{} {}\"", number(dash), number(0.7 * dash));
        }
    }
    out.push_str("/>\n");
}
