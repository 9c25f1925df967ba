//! Axes with numbers, a faint grid, and labels that stand upright.

use super::recorder::{FINE, Recorder, colour};
use crate::figure::drawing::{Anchor, Ink, Label, Segment, Shape, Stroke};
use plotters::prelude::*;
use std::convert::Infallible;
use std::ops::Range;

/// The size of numbers and labels, points.
pub(super) const NUMBERS: f64 = 9.0;
/// The size of the labels of axes, points.
pub(super) const WORDS: f64 = 10.0;
/// Lines of axes, points.
const THIN: f64 = 0.6;

/// Where a plot stands on its page, points: x and y of the upper left corner, width, height.
#[derive(Clone, Copy)]
pub(super) struct Area {
    pub at: [f64; 2],
    pub size: [f64; 2],
}

/// The part of the page with data, and what its sides stand for.
#[derive(Clone, Debug)]
pub(super) struct Scales {
    pub area_at: [f64; 2],
    pub area_size: [f64; 2],
    pub x: Range<f64>,
    pub y: Range<f64>,
}

impl Scales {
    /// Where a value stands, points.
    pub fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let across = (x - self.x.start) / (self.x.end - self.x.start);
        let up = (y - self.y.start) / (self.y.end - self.y.start);
        [self.area_at[0] + across * self.area_size[0], self.area_at[1] + (1.0 - up) * self.area_size[1]]
    }

    /// A line through values, closed or not.
    pub fn line(&self, values: &[[f64; 2]], is_closed: bool) -> Vec<Segment> {
        let of = |(i, p): (usize, &[f64; 2])| {
            let at = self.place(*p);
            if i == 0 { Segment::Move(at) } else { Segment::Line(at) }
        };
        let mut segments: Vec<Segment> = values.iter().enumerate().map(of).collect();
        if is_closed {
            segments.push(Segment::Close);
        }
        segments
    }
}

/// Draws the axes of an area: the numbers stand outside of it, to the left and below; the label of the vertical axis above
/// its end, that of the horizontal axis below its numbers.
pub(super) fn axes(
    shapes: &mut Vec<Shape>,
    page: [f64; 2],
    area: Area,
    [x, y]: [Range<f64>; 2],
    labels: [Label; 2],
) -> Scales {
    const LEFT: f64 = 40.0;
    const BELOW: f64 = 20.0;
    let scales = Scales { area_at: area.at, area_size: area.size, x: x.clone(), y: y.clone() };
    // The recorder cannot fail; a chart that has no room is left away.
    let _ = mesh(shapes, page, [LEFT, BELOW], area, [x, y]);
    let [left, top] = area.at;
    let [wide, high] = area.size;
    let [across, up] = labels;
    let mut text = |at: [f64; 2], anchor, label| {
        shapes.push(Shape::Text { at, anchor, size: WORDS, ink: Ink::Line, label });
    };
    text([left + 0.5 * wide, top + high + BELOW + 12.0], Anchor::Middle, across);
    text([left - 4.0, top - 9.0], Anchor::Middle, up);
    scales
}

fn mesh(
    shapes: &mut Vec<Shape>,
    page: [f64; 2],
    [left, below]: [f64; 2],
    area: Area,
    [x, y]: [Range<f64>; 2],
) -> Result<(), DrawingAreaErrorKind<Infallible>> {
    let root = Recorder { shapes, size: page }.into_drawing_area();
    let root = root.shrink(
        (fine(area.at[0] - left), fine(area.at[1])),
        (fine(area.size[0] + left), fine(area.size[1] + below)),
    );
    let mut chart = ChartBuilder::on(&root)
        .x_label_area_size(fine(below))
        .y_label_area_size(fine(left))
        .build_cartesian_2d(x.clone(), y.clone())?;
    let [count_x, count_y] = [0, 1].map(|k| labels(area.size[k]));
    let [show_x, show_y] = [decimals(&x, count_x), decimals(&y, count_y)];
    let font = ("sans-serif", f64::from(FINE) * NUMBERS).into_font().color(&colour(Ink::Line));
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(colour(Ink::Faint).stroke_width(wide(0.4)))
        .axis_style(colour(Ink::Line).stroke_width(wide(THIN)))
        .set_all_tick_mark_size(fine(3.0))
        .x_labels(count_x)
        .y_labels(count_y)
        .x_label_formatter(&|v| number(*v, show_x))
        .y_label_formatter(&|v| number(*v, show_y))
        .label_style(font)
        .draw()?;
    root.present()
}

/// How many numbers have room along a side.
fn labels(length: f64) -> usize {
    (length / 38.0).clamp(2.0, 9.0) as usize
}

/// How many decimals numbers need that stand so close.
fn decimals(range: &Range<f64>, count: usize) -> usize {
    let step = (range.end - range.start) / count.max(1) as f64;
    if !step.is_finite() || step <= 0.0 {
        return 1;
    }
    (-step.log10()).ceil().clamp(0.0, 6.0) as usize
}

/// A number as it is printed: a true minus sign, no negative zero.
pub(super) fn number(v: f64, decimals: usize) -> String {
    let text = format!("{:.decimals$}", v.abs());
    let is_zero = text.chars().all(|c| matches!(c, '0' | '.'));
    if v < 0.0 && !is_zero { format!("−{text}") } else { text }
}

fn fine(length: f64) -> i32 {
    (length * f64::from(FINE)).round() as i32
}

fn wide(width: f64) -> u32 {
    (width * f64::from(FINE)).round() as u32
}

/// A line of this ink and width, points.
pub(super) fn stroke(ink: Ink, width: f64) -> Option<Stroke> {
    Some(Stroke { ink, width, dash: None })
}
