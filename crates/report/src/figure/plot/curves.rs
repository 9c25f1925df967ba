//! Lines over an axis: joints over time, for example.

use super::axes::{Area, NUMBERS, Scales, WORDS, axes};
use crate::figure::drawing::{Anchor, Drawing, Ink, Label, Segment, Shape, Stroke};
use crate::words::Language;

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

/// The size of the plot's page, points.
const WIDTH: f64 = 440.0;
/// The part with data, points.
const HIGH: f64 = 190.0;
const LEFT: f64 = 48.0;
const RIGHT: f64 = 12.0;
const BELOW: f64 = 40.0;

/// Lines over a common axis, 440 points wide: the title above (left away if it is empty), a legend where there are two or
/// more lines. The labels are those of the horizontal and of the vertical axis, with their units.
pub fn curves(title: &str, labels: [Label; 2], curves: &[Curve]) -> Drawing {
    let legend = if curves.len() > 1 { legend(curves) } else { vec![] };
    let lines = legend.iter().map(|e| e.row + 1).max().unwrap_or(0);
    let heading = if title.is_empty() { 0.0 } else { 18.0 };
    let top = 20.0 + heading + 14.0 * lines as f64;
    let page = [WIDTH, top + HIGH + BELOW];
    let area = Area { at: [LEFT, top], size: [WIDTH - LEFT - RIGHT, HIGH] };
    let range = |k: usize, margin: f64| {
        let values = curves.iter().flat_map(|c| &c.points).filter(|p| p.iter().all(|v| v.is_finite()));
        let (low, high) =
            values.map(|p| p[k]).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        if low > high || !(high - low).is_finite() {
            return 0.0..1.0;
        }
        // A constant needs a range too.
        let wide = if high - low > 1e-9 * high.abs().max(1e-9) { high - low } else { high.abs().max(1.0) };
        let at_least = 0.5 * (wide - (high - low));
        low - at_least - margin * wide..high + at_least + margin * wide
    };
    let mut shapes = vec![];
    let scales = axes(&mut shapes, page, area, [range(0, 0.0), range(1, 0.06)], labels);
    if !title.is_empty() {
        let at = [0.5 * WIDTH, 13.0];
        shapes.push(Shape::Text {
            at,
            anchor: Anchor::Middle,
            size: WORDS + 1.0,
            ink: Ink::Line,
            label: Label::words(title),
        });
    }
    for (k, curve) in curves.iter().enumerate() {
        shapes.extend(drawn(&scales, curve, k));
    }
    for (entry, (k, curve)) in legend.iter().zip(curves.iter().enumerate()) {
        let y = heading + 9.0 + 14.0 * entry.row as f64;
        let x = LEFT + entry.x;
        let segments = vec![Segment::Move([x, y]), Segment::Line([x + SAMPLE, y])];
        shapes.push(Shape::Path { segments, fill: None, stroke: Some(line(k, curve)) });
        shapes.push(Shape::Text {
            at: [x + SAMPLE + 4.0, y + 3.0],
            anchor: Anchor::Start,
            size: NUMBERS,
            ink: Ink::Line,
            label: curve.name.clone(),
        });
    }
    let names: Vec<String> = curves.iter().map(|c| plain(&c.name)).collect();
    let description = Language::default().words().curves_picture(title, &names);
    Drawing { width: page[0], height: page[1], description, shapes }
}

/// The part of the legend's entry that shows the line, points.
const SAMPLE: f64 = 18.0;

/// Where an entry of the legend stands.
struct Entry {
    row: usize,
    x: f64,
}

/// Entries side by side, in as many lines as they need.
fn legend(curves: &[Curve]) -> Vec<Entry> {
    let (mut row, mut x) = (0, 0.0);
    let mut all = vec![];
    for curve in curves {
        let wide = SAMPLE + 18.0 + 0.55 * NUMBERS * plain(&curve.name).chars().count() as f64;
        if x > 0.0 && x + wide > WIDTH - LEFT - RIGHT {
            (row, x) = (row + 1, 0.0);
        }
        all.push(Entry { row, x });
        x += wide;
    }
    all
}

fn plain(label: &Label) -> String {
    label.0.iter().map(|p| p.text.as_str()).collect()
}

/// The line of a curve, interrupted where there is no value.
fn drawn(scales: &Scales, curve: &Curve, number: usize) -> Vec<Shape> {
    let parts = curve.points.split(|p| !p.iter().all(|v| v.is_finite())).filter(|part| part.len() > 1);
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
