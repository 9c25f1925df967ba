//! Lines over an axis: joints over time, for example.

use super::axes::{Area, MIDDLE, NUMBERS, Scales, WORDS, axes, stroke, text};
use crate::figure::drawing::{Anchor, Drawing, Ink, Label, Segment, Shape, Stroke};
use crate::figure::naming::width;
use std::ops::Range;

/// A line of a plot.
#[derive(Clone, PartialEq, Debug)]
pub struct Curve {
    /// What stands beside its sample.
    pub name: Label,
    /// Its points; where one is not finite the line is interrupted.
    pub points: Vec<[f64; 2]>,
    /// Whether it is dashed.
    pub is_dashed: bool,
}

/// Lines with a vertical axis of their own.
#[derive(Clone, PartialEq, Debug)]
pub struct Panel {
    /// What the vertical axis stands for, with its unit.
    pub label: Label,
    /// The lines.
    pub curves: Vec<Curve>,
}

/// The width of the page, points.
const WIDTH: f64 = 440.0;
/// The part of a panel with data, points.
const HIGH: f64 = 140.0;
const LEFT: f64 = 48.0;
const RIGHT: f64 = 12.0;
/// Between the words above the data and the data, points.
const ABOVE: f64 = 9.0;
/// Below the data, points: the numbers, and the label behind the last panel.
const BELOW: f64 = 22.0;
const LAST: f64 = 40.0;
/// Where labels and legends begin, points.
const MARGIN: f64 = 14.0;
/// What the title, a panel's label and a line of the legend take, points.
const TITLE: f64 = 18.0;
const LABEL: f64 = 18.0;
const ENTRY: f64 = 14.0;
/// The part of the legend's entry that shows the line, points.
const SAMPLE: f64 = 18.0;
/// Between line and name, and between entries, points.
const GAPS: [f64; 2] = [4.0, 14.0];

/// Panels one below the other with a common horizontal axis, 440 points wide: the title above (left away if it is empty),
/// a legend where a panel has two or more lines. Every vertical axis shows 0, so that heights can be compared; at each
/// mark of the horizontal axis a line runs through all panels.
pub fn curves(title: &str, across: &Label, panels: &[Panel], marks: &[f64]) -> Drawing {
    let mut shapes = vec![];
    let mut y = 0.0;
    if !title.is_empty() {
        y += TITLE;
        shapes.push(text([0.5 * WIDTH, y], Anchor::Middle, WORDS + 1.0, Label::words(title)));
    }
    let values = |panel: &Panel, k: usize| -> Vec<f64> {
        let points = panel.curves.iter().flat_map(|c| &c.points);
        points.filter(|p| is_finite(p)).map(|p| p[k]).collect()
    };
    let x = range(panels.iter().flat_map(|p| values(p, 0)), 0.0);
    for (number, panel) in panels.iter().enumerate() {
        y += LABEL;
        shapes.push(text([MARGIN, y], Anchor::Start, WORDS, panel.label.clone()));
        if panel.curves.len() > 1 {
            y = legend(&mut shapes, y, &panel.curves);
        }
        let area = Area { at: [LEFT, y + ABOVE], size: [WIDTH - LEFT - RIGHT, HIGH] };
        let is_last = number + 1 == panels.len();
        let label = if is_last { across.clone() } else { Label::default() };
        let up = range(values(panel, 1).into_iter().chain([0.0]), 0.06);
        let scales = axes(&mut shapes, area, [x.clone(), up], label);
        shapes.extend(marks.iter().filter(|at| x.contains(at)).map(|at| mark(&scales, *at)));
        let lines = panel.curves.iter().enumerate();
        shapes.extend(lines.flat_map(|(k, curve)| drawn(&scales, curve, k)));
        y += ABOVE + HIGH + if is_last { LAST } else { BELOW };
    }
    let labels: Vec<String> = panels.iter().map(|p| plain(&p.label)).collect();
    let description = format!("{title}, over {}: {}", plain(across), labels.join("; "));
    Drawing { width: WIDTH, height: y, description, shapes }
}

fn is_finite(p: &[f64; 2]) -> bool {
    p.iter().all(|v| v.is_finite())
}

/// What an axis shows: the values, and this share of them on both sides.
fn range(values: impl Iterator<Item = f64>, margin: f64) -> Range<f64> {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    if low > high || !(high - low).is_finite() {
        return 0.0..1.0;
    }
    // A constant needs a range too.
    let wide = if high - low > 1e-9 * high.abs().max(1e-9) { high - low } else { high.abs().max(1.0) };
    let at_least = 0.5 * (wide - (high - low));
    low - at_least - margin * wide..high + at_least + margin * wide
}

/// Entries side by side below a base line, in as many lines as they need; gives the base line of the last.
fn legend(shapes: &mut Vec<Shape>, above: f64, curves: &[Curve]) -> f64 {
    let (mut x, mut y) = (MARGIN, above + ENTRY);
    for (k, curve) in curves.iter().enumerate() {
        let wide = SAMPLE + GAPS[0] + width(&curve.name, NUMBERS);
        if x > MARGIN && x + wide > WIDTH - RIGHT {
            (x, y) = (MARGIN, y + ENTRY);
        }
        let middle = y - MIDDLE * NUMBERS;
        let segments = vec![Segment::Move([x, middle]), Segment::Line([x + SAMPLE, middle])];
        shapes.push(Shape::Path { segments, fill: None, stroke: Some(line(k, curve)) });
        shapes.push(text([x + SAMPLE + GAPS[0], y], Anchor::Start, NUMBERS, curve.name.clone()));
        x += wide + GAPS[1];
    }
    y
}

fn plain(label: &Label) -> String {
    label.0.iter().map(|p| p.text.as_str()).collect()
}

/// The line at a mark.
fn mark(scales: &Scales, at: f64) -> Shape {
    let ends = [[at, scales.y.start], [at, scales.y.end]];
    Shape::Path { segments: scales.line(&ends, false), fill: None, stroke: stroke(Ink::Accent, 0.8) }
}

/// The line of a curve, interrupted where there is no value.
fn drawn(scales: &Scales, curve: &Curve, number: usize) -> Vec<Shape> {
    let parts = curve.points.split(|p| !is_finite(p)).filter(|part| part.len() > 1);
    parts
        .map(|part| Shape::Path {
            segments: scales.line(part, false),
            fill: None,
            stroke: Some(line(number, curve)),
        })
        .collect()
}

fn line(number: usize, curve: &Curve) -> Stroke {
    let ink = Ink::Series(u8::try_from(number % 256).unwrap_or(0));
    Stroke { ink, width: 1.2, dash: curve.is_dashed.then_some(3.0) }
}
