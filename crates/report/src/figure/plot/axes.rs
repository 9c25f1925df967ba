//! Axes with numbers, a faint grid, and labels that stand upright.

use crate::figure::drawing::{Anchor, Ink, Label, Segment, Shape, Stroke};
use std::ops::Range;

/// The size of numbers and of names in legends, points.
pub(super) const NUMBERS: f64 = 9.0;
/// The size of the labels of axes, points.
pub(super) const WORDS: f64 = 10.0;
/// Lines of axes, points.
pub(super) const THIN: f64 = 0.6;
/// Lines of the grid, points.
const GRID: f64 = 0.4;
/// How far a tick stands out, points.
pub(super) const TICK: f64 = 3.0;
/// How far the middle of a digit is above its base line, by its size.
pub(super) const MIDDLE: f64 = 0.34;
/// How high a digit is, by its size.
const DIGIT: f64 = 0.7;
/// Between a tick and its number, points.
const GAP: f64 = 3.0;
/// From the horizontal axis down to the base line of its label, points.
const BELOW: f64 = 32.0;
/// Room for a number, beside the next and below it, points.
const ROOM: [f64; 2] = [38.0, 24.0];

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

/// Draws the axes of an area: the numbers stand outside of it, to the left and below, the label of the horizontal axis
/// below its numbers.
pub(super) fn axes(shapes: &mut Vec<Shape>, area: Area, [x, y]: [Range<f64>; 2], across: Label) -> Scales {
    let ([left, top], [wide, high]) = (area.at, area.size);
    let (right, bottom) = (left + wide, top + high);
    let scales = Scales { area_at: area.at, area_size: area.size, x, y };
    let [ticks_x, ticks_y] = [ticks(&scales.x, wide / ROOM[0]), ticks(&scales.y, high / ROOM[1])];
    let [xs, ys]: [Vec<f64>; 2] = [
        ticks_x.iter().map(|t| scales.place([t.value, scales.y.start])[0]).collect(),
        ticks_y.iter().map(|t| scales.place([scales.x.start, t.value])[1]).collect(),
    ];
    let mut lines = |ink, width, segments: Vec<Segment>| {
        if !segments.is_empty() {
            shapes.push(Shape::Path { segments, fill: None, stroke: stroke(ink, width) });
        }
    };
    let grid = xs.iter().map(|&x| [[x, top], [x, bottom]]).chain(ys.iter().map(|&y| [[left, y], [right, y]]));
    lines(Ink::Faint, GRID, grid.flat_map(segment).collect());
    let axes = [[[left, top], [left, bottom]], [[left, bottom], [right, bottom]]].into_iter();
    let ticks = xs.iter().map(|&x| [[x, bottom], [x, bottom + TICK]]);
    let ticks = ticks.chain(ys.iter().map(|&y| [[left - TICK, y], [left, y]]));
    lines(Ink::Line, THIN, axes.chain(ticks).flat_map(segment).collect());

    for (tick, x) in ticks_x.into_iter().zip(xs) {
        let at = [x, bottom + TICK + GAP + DIGIT * NUMBERS];
        shapes.push(text(at, Anchor::Middle, NUMBERS, Label::words(tick.text)));
    }
    for (tick, y) in ticks_y.into_iter().zip(ys) {
        let at = [left - TICK - GAP, y + MIDDLE * NUMBERS];
        shapes.push(text(at, Anchor::End, NUMBERS, Label::words(tick.text)));
    }
    shapes.push(text([left + 0.5 * wide, bottom + BELOW], Anchor::Middle, WORDS, across));
    scales
}

/// A value with a number of its own.
#[derive(Clone, PartialEq, Debug)]
struct Tick {
    value: f64,
    text: String,
}

/// The multiples of 1, 2 or 5 times a power of ten in a range, not many more than have room; none where the range is empty
/// or too narrow to tell them apart.
fn ticks(range: &Range<f64>, room: f64) -> Vec<Tick> {
    let count = room.floor().clamp(2.0, 9.0);
    let least = (range.end - range.start) / count;
    let largest = range.start.abs().max(range.end.abs());
    if !(least.is_finite() && least > 1e-9 * largest && least > 1e-300) {
        return vec![];
    }
    let below = least.log10().floor() as i32;
    let mantissa = least / 10_f64.powi(below);
    let factors = [(1, below), (2, below), (5, below)];
    let fits = |(factor, _): &(i64, i32)| mantissa <= *factor as f64 * (1.0 + 1e-9);
    let (factor, power) = factors.into_iter().find(fits).unwrap_or((1, below + 1));
    let step = factor as f64 * 10_f64.powi(power);
    // A limit that is a multiple has its number, whatever rounding says.
    let (first, last) = ((range.start / step - 1e-6).ceil(), (range.end / step + 1e-6).floor());
    let multiples = (first as i64)..=(last as i64);
    multiples.map(|n| Tick { value: n as f64 * step, text: written(n * factor, power) }).collect()
}

/// `n`·10^`power`, with a power of ten where there would be many zeros.
fn written(n: i64, power: i32) -> String {
    match power {
        _ if n == 0 => "0".into(),
        0..6 => number(n as f64 * 10_f64.powi(power), 0),
        -6..0 => number(n as f64 * 10_f64.powi(power), power.unsigned_abs() as usize),
        _ => format!("{}e{}", number(n as f64, 0), number(f64::from(power), 0)),
    }
}

/// A number as it is printed: a true minus sign, no negative zero.
pub(super) fn number(v: f64, decimals: usize) -> String {
    let text = format!("{:.decimals$}", v.abs());
    let is_zero = text.chars().all(|c| matches!(c, '0' | '.'));
    if v < 0.0 && !is_zero { format!("−{text}") } else { text }
}

fn segment([from, to]: [[f64; 2]; 2]) -> [Segment; 2] {
    [Segment::Move(from), Segment::Line(to)]
}

/// A line of this ink and width, points.
pub(super) fn stroke(ink: Ink, width: f64) -> Option<Stroke> {
    Some(Stroke { ink, width, dash: None })
}

/// Words or symbols of this size, points.
pub(super) fn text(at: [f64; 2], anchor: Anchor, size: f64, label: Label) -> Shape {
    Shape::Text { at, anchor, size, ink: Ink::Line, label }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(range: Range<f64>, room: f64) -> String {
        ticks(&range, room).iter().map(|t| t.text.as_str()).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn steps_are_one_two_or_five() {
        for (range, room, expect) in [
            (0.0..1.0, 5.0, "0 0.2 0.4 0.6 0.8 1.0"),
            (-0.31..0.31, 7.9, "−0.3 −0.2 −0.1 0 0.1 0.2 0.3"),
            (0.0..0.9, 2.0, "0 0.5"),
            (-100.0..250.0, 5.0, "−100 0 100 200"),
            (-60.0..120.0, 5.0, "−50 0 50 100"),
            // 0.1 + 0.2 and its like do not lose the last number.
            (0.1..0.1 + 0.2, 2.0, "0.1 0.2 0.3"),
            (0.0..4e-9, 2.0, "0 2e−9 4e−9"),
            (0.0..3.2e7, 3.0, "0 2e7"),
        ] {
            assert_eq!(texts(range, room), expect);
        }
    }

    #[test]
    fn ranges_without_width_have_no_numbers() {
        for range in [1.0..1.0, 2.0..1.0, 0.0..f64::INFINITY, f64::NAN..1.0, 1e18..1e18 + 1.0] {
            assert_eq!(texts(range, 5.0), "");
        }
    }
}
