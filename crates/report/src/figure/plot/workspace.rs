//! A section of the workspace: the region in levels of manipulability, its edge, a bar that explains the levels.

use super::axes::{Area, MIDDLE, NUMBERS, THIN, TICK, WORDS, axes, number, stroke, text};
use crate::figure::drawing::{Anchor, Drawing, Ink, Label, Segment, Shape};
use crate::figure::solid::{arc, closed, polygon};
use crate::words::Tongue;
use denavit::Robot;
use denavit::geometry::Vector;
use denavit::workspace::{Field, Section, Workspace, contours};
use std::ops::Range;

/// The widest page, points.
const WIDTH: f64 = 440.0;
/// The highest area of data, points.
const HIGHEST: f64 = 300.0;
const LEFT: f64 = 48.0;
const RIGHT: f64 = 76.0;
const ABOVE: f64 = 24.0;
const BELOW: f64 = 40.0;
/// Levels of manipulability.
const LEVELS: u8 = 8;

/// The section of a workspace with equal scales on both axes, at most 440 points wide: what is reached, coloured by
/// manipulability, its edge, a colour bar; and a line, if one is given, in coordinates of the section ([`arm_line`]).
pub fn workspace_plot(workspace: &Workspace, arm: Option<&[[f64; 2]]>) -> Drawing {
    let ranges = [0, 1].map(|k| range(workspace, arm, k));
    let sides = ranges.clone().map(|r| r.end - r.start);
    let scale = ((WIDTH - LEFT - RIGHT) / sides[0]).min(HIGHEST / sides[1]);
    // A flat region gets a bar that can still be read.
    let size = [scale * sides[0], (scale * sides[1]).max(60.0)];
    let ranges = if size[1] > scale * sides[1] {
        let more = 0.5 * (size[1] / scale - sides[1]);
        [ranges[0].clone(), ranges[1].start - more..ranges[1].end + more]
    } else {
        ranges
    };
    let page = [LEFT + size[0] + RIGHT, ABOVE + size[1] + BELOW];
    let mut shapes = vec![];
    let area = Area { at: [LEFT, ABOVE], size };
    let metres = |symbol: &str| Label::symbol(symbol, "").and(Label::words(" / m"));
    let [across, up] = workspace.section.symbols().map(metres);
    let scales = axes(&mut shapes, area, ranges, across);
    shapes.push(text([LEFT - 4.0, ABOVE - 9.0], Anchor::Middle, WORDS, up));

    let outline: Vec<Segment> = workspace.boundary.iter().flat_map(|line| scales.line(line, true)).collect();
    shapes.push(Shape::Path { segments: outline.clone(), fill: Some(ink(0)), stroke: None });
    let shown = levels(workspace);
    let grid = workspace.grid;
    let origin = grid.centre(0);
    for level in 1..LEVELS {
        let values: Vec<f64> =
            shown.iter().map(|c| ((c.value - share(level)) / c.slope).min(c.inside)).collect();
        let field = Field { values: &values, columns: grid.columns, outside: -1.0 };
        let segments: Vec<Segment> = contours(&field, 0.0)
            .into_iter()
            .flat_map(|line| {
                let at = |p: &[f64; 2]| [0, 1].map(|k| origin[k] + p[k] * grid.side);
                scales.line(&line.iter().map(at).collect::<Vec<_>>(), true)
            })
            .collect();
        if !segments.is_empty() {
            shapes.push(Shape::Path { segments, fill: Some(ink(level)), stroke: None });
        }
    }
    shapes.push(Shape::Path { segments: outline, fill: None, stroke: stroke(Ink::Line, 0.9) });
    if let Some(line) = arm {
        shapes.push(Shape::Path {
            segments: scales.line(line, false),
            fill: None,
            stroke: stroke(Ink::Line, 1.4),
        });
        for p in line {
            shapes.push(Shape::Path {
                segments: circle(scales.place(*p), 2.2),
                fill: Some(Ink::Paper),
                stroke: stroke(Ink::Line, 0.9),
            });
        }
    }
    shapes.extend(bar([LEFT + size[0] + 18.0, ABOVE], size[1].min(160.0)));
    let description = described(workspace);
    Drawing { width: page[0], height: page[1], description, shapes }
}

/// The arm's frames as a line in the section of its workspace, at a configuration; none where they do not lie in one half
/// plane through the axis.
///
/// # Panics
/// If `q` does not have one entry per joint.
pub fn arm_line(workspace: &Workspace, robot: &Robot<f64>, q: &[f64]) -> Option<Vec<[f64; 2]>> {
    let mut q = q.to_vec();
    for held in &workspace.held {
        if let Some(x) = q.get_mut(held.joint) {
            *x = held.range[0];
        }
    }
    let mut places: Vec<Vector<f64>> = robot.frames(&q).iter().map(|x| x.translation).collect();
    places.push(robot.pose(&q).translation);
    if let Section::ThroughAxis { point, direction, .. } = &workspace.section {
        let across = |p: &Vector<f64>| {
            let r = *p - *point;
            r - direction.scale(r.dot(*direction))
        };
        let furthest = places.iter().map(across).max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
        let (length, size) = (furthest.norm(), robot.reach().max(1e-9));
        let is_along = |v: Vector<f64>| {
            length < 1e-6 * size
                || (v - furthest.scale(v.dot(furthest) / (length * length))).norm() < 1e-6 * size
                    && v.dot(furthest) > -1e-6 * size * length
        };
        if !places.iter().all(|p| is_along(across(p))) {
            return None;
        }
    }
    let mut line: Vec<[f64; 2]> = places.into_iter().map(|p| workspace.section.coordinates(p)).collect();
    line.dedup_by(|a, b| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-9);
    Some(line)
}

fn share(level: u8) -> f64 {
    f64::from(level) / f64::from(LEVELS)
}

fn ink(level: u8) -> Ink {
    Ink::Scale((f64::from(level) + 0.5) / f64::from(LEVELS))
}

/// What an axis shows: the region, the arm, and a margin; not beyond the axis that the section ends at.
fn range(workspace: &Workspace, arm: Option<&[[f64; 2]]>, k: usize) -> Range<f64> {
    let reached = if k == 0 { workspace.extremes.first } else { workspace.extremes.second };
    let of_arm = arm.into_iter().flatten().map(|p| p[k]);
    let (mut low, mut high) =
        of_arm.fold((reached[0], reached[1]), |(low, high), x| (low.min(x), high.max(x)));
    let other = if k == 0 { workspace.extremes.second } else { workspace.extremes.first };
    let margin = 0.04 * (high - low).max(other[1] - other[0]).max(1e-6);
    (low, high) = (low - margin, high + margin);
    if k == 0 && matches!(workspace.section, Section::ThroughAxis { .. }) {
        // The axis is shown unless it is far away.
        low = if low < 0.5 * high { 0.0 } else { low };
    }
    low..high
}

/// What is drawn at the centre of a cell.
#[derive(Clone, Copy)]
struct Shown {
    /// The manipulability, carried on beyond the edge.
    value: f64,
    /// How fast the value changes, by a cell: with it, values are distances too.
    slope: f64,
    /// How far within the edge it is, in cells; negative beyond. At most [`NEAR`].
    inside: f64,
}

/// Cells on both sides of the edge whose distance from it matters.
const NEAR: f64 = 2.5;

/// Values smoothed a little and carried on beyond the edge, and distances from the edge.
fn levels(workspace: &Workspace) -> Vec<Shown> {
    let grid = workspace.grid;
    let mut values = workspace.manipulability.clone();
    // The cells at the edge are met at their rim only: what is within carries on to them.
    for _ in 0..2 {
        values = mean(&values, grid.columns, 0.5, false);
    }
    for _ in 0..4 {
        values = mean(&values, grid.columns, 0.0, true);
    }
    let mut distance = vec![f64::INFINITY; values.len()];
    let mut beside = |a: [f64; 2], b: [f64; 2]| {
        let of = |p: [f64; 2]| [0, 1].map(|k| (p[k] - grid.origin[k]) / grid.side - 0.5);
        let (a, b) = (of(a), of(b));
        let [across, up] = [0, 1].map(|k| cells_between(a[k].min(b[k]) - NEAR, a[k].max(b[k]) + NEAR));
        for j in up.clone().filter(|&j| j < grid.rows) {
            for i in across.clone().filter(|&i| i < grid.columns) {
                let away = from_segment([i as f64, j as f64], a, b);
                let d = &mut distance[j * grid.columns + i];
                *d = d.min(away);
            }
        }
    };
    for line in &workspace.boundary {
        for (a, b) in line.iter().zip(line.iter().skip(1).chain(line.first())) {
            beside(*a, *b);
        }
    }
    let slope = |cell: usize| {
        let at = |k: usize| values.get(k).copied().flatten().or(values[cell]).unwrap_or(0.0);
        let across = 0.5 * (at(cell + 1) - at(cell.saturating_sub(1)));
        let up = 0.5 * (at(cell + grid.columns) - at(cell.saturating_sub(grid.columns)));
        across.hypot(up).max(1e-3)
    };
    let shown = |cell: usize| {
        let is_reached = workspace.manipulability[cell].is_some();
        let near = distance[cell].min(NEAR);
        // Far from the edge a cell says itself on which side it is.
        let is_inside = if near < NEAR { is_within(workspace, grid.centre(cell)) } else { is_reached };
        let value = values[cell].unwrap_or(0.0);
        Shown { value, slope: slope(cell), inside: if is_inside { near } else { -near } }
    };
    (0..values.len()).map(shown).collect()
}

/// Each value mixed with the mean of those around it; with `carried` only where there is none.
fn mean(values: &[Option<f64>], columns: usize, own: f64, carried: bool) -> Vec<Option<f64>> {
    let rows = values.len().checked_div(columns).unwrap_or(0);
    let of = |cell: usize| {
        let (i, j) = (cell % columns, cell / columns);
        if carried && values[cell].is_some() {
            return values[cell];
        }
        let (mut sum, mut count) = (0.0, 0.0);
        for b in j.saturating_sub(1)..(j + 2).min(rows) {
            for a in i.saturating_sub(1)..(i + 2).min(columns) {
                if let Some(v) = values[b * columns + a] {
                    (sum, count) = (sum + v, count + 1.0);
                }
            }
        }
        match values[cell] {
            Some(v) => Some(own * v + (1.0 - own) * sum / count),
            None if carried && count > 0.0 => Some(sum / count),
            None => None,
        }
    };
    (0..values.len()).map(of).collect()
}

fn cells_between(low: f64, high: f64) -> Range<usize> {
    low.floor().clamp(0.0, 1e6) as usize..high.ceil().clamp(0.0, 1e6) as usize + 1
}

fn from_segment(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (ab, ap) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let square = ab[0] * ab[0] + ab[1] * ab[1];
    let t = if square > 0.0 { ((ap[0] * ab[0] + ap[1] * ab[1]) / square).clamp(0.0, 1.0) } else { 0.0 };
    (ap[0] - t * ab[0]).hypot(ap[1] - t * ab[1])
}

/// Whether a point lies within the edge: an odd number of lines on one side of it.
fn is_within(workspace: &Workspace, [x, y]: [f64; 2]) -> bool {
    let mut inside = false;
    for line in &workspace.boundary {
        for (a, b) in line.iter().zip(line.iter().skip(1).chain(line.first())) {
            if (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) {
                inside = !inside;
            }
        }
    }
    inside
}

/// The bar of levels with its numbers, its label above.
fn bar([x, y]: [f64; 2], high: f64) -> Vec<Shape> {
    const WIDE: f64 = 11.0;
    let mut shapes = vec![];
    let at = |part: f64| y + high * (1.0 - part);
    let box_of = |low: f64, top: f64| {
        let (a, b) = (at(low), at(top));
        polygon(&[[x, a], [x + WIDE, a], [x + WIDE, b], [x, b]])
    };
    for level in 0..LEVELS {
        let segments = box_of(share(level), share(level + 1));
        shapes.push(Shape::Path { segments, fill: Some(ink(level)), stroke: None });
    }
    shapes.push(Shape::Path { segments: box_of(0.0, 1.0), fill: None, stroke: stroke(Ink::Line, THIN) });
    for quarter in 0..=4_u8 {
        let part = f64::from(quarter) / 4.0;
        let segments = vec![Segment::Move([x + WIDE, at(part)]), Segment::Line([x + WIDE + TICK, at(part)])];
        shapes.push(Shape::Path { segments, fill: None, stroke: stroke(Ink::Line, THIN) });
        let place = [x + WIDE + 2.0 * TICK, at(part) + MIDDLE * NUMBERS];
        shapes.push(text(place, Anchor::Start, NUMBERS, Label::words(number(part, 2))));
    }
    let label = Label::symbol("w", "").and(Label::words(" / ")).and(Label::symbol("w", "max"));
    shapes.push(text([x, y - 9.0], Anchor::Start, WORDS, label));
    shapes
}

/// A circle, points.
fn circle(centre: [f64; 2], r: f64) -> Vec<Segment> {
    closed(arc(centre, [r, 0.0], [0.0, r], 0.0, std::f64::consts::TAU))
}

fn described(workspace: &Workspace) -> String {
    let extremes = [workspace.extremes.first, workspace.extremes.second];
    let ranges = extremes.map(|range| range.map(|x| number(x, 3)));
    Tongue::default().words().workspace_picture(&workspace.section, ranges)
}
