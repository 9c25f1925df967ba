//! Places for labels: beside what they name, on nothing else.

use super::drawing::{Anchor, Ink, Label, Shape, Stroke};
use super::naming::width;
use super::solid::polyline;

/// A rectangle: left, top, right, bottom.
pub type Rect = [f64; 4];

/// How far above its base line a label reaches, and below, in heights of letters.
const RISE: f64 = 0.74;
const DEPTH: f64 = 0.27;
/// Free space around a label, points.
const AIR: f64 = 1.5;
/// A label farther than this from what it names gets a line there, points.
const FAR: f64 = 17.0;
/// Obstacles are points at this distance.
const GRAIN: f64 = 3.0;
/// Obstacles lie in squares of this size, points.
const CELL: f64 = 16.0;

/// A label that waits for its place.
#[derive(Clone, Debug)]
pub struct Wish {
    /// What is written.
    pub label: Label,
    /// The height of the letters, points.
    pub size: f64,
    /// The colour.
    pub ink: Ink,
    /// What is named: points of which any will do.
    pub anchors: Vec<[f64; 2]>,
    /// Where the label would best be, seen from there.
    pub direction: [f64; 2],
    /// At least so far from it, points.
    pub distance: f64,
}

/// What is drawn already.
#[derive(Clone, Debug)]
pub struct Sheet {
    width: f64,
    height: f64,
    /// Those of each square, row by row; what lies beside the sheet in the square next to it.
    obstacles: Vec<Vec<Obstacle>>,
    /// The largest radius of an obstacle.
    radius: f64,
    taken: Vec<Rect>,
}

/// A point, how large it is, how bad it is to lie on it.
type Obstacle = ([f64; 2], f64, f64);

impl Sheet {
    /// An empty sheet.
    pub fn new(width: f64, height: f64) -> Self {
        let [columns, rows] = [width, height].map(cells);
        Sheet { width, height, obstacles: vec![vec![]; columns * rows], radius: 0.0, taken: vec![] }
    }

    /// The square of a point, or the one next to it.
    fn cell(&self, [x, y]: [f64; 2]) -> [usize; 2] {
        let of = |x: f64, size: f64| ((x / CELL).max(0.0) as usize).min(cells(size) - 1);
        [of(x, self.width), of(y, self.height)]
    }

    /// The obstacles that may lie in a rectangle.
    fn within(&self, [l, t, r, b]: Rect) -> impl Iterator<Item = &Obstacle> {
        let ([left, top], [right, bottom]) = (self.cell([l, t]), self.cell([r, b]));
        let columns = cells(self.width);
        (top..=bottom).flat_map(move |y| self.obstacles[y * columns..][left..=right].iter().flatten())
    }

    /// Something long and thick that labels should not lie on.
    pub fn block(&mut self, a: [f64; 2], b: [f64; 2], radius: f64, weight: f64) {
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let steps = (length / GRAIN).ceil().clamp(1.0, 400.0);
        for k in 0..=steps as usize {
            let t = k as f64 / steps;
            let point = [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
            let [column, row] = self.cell(point);
            self.obstacles[row * cells(self.width) + column].push((point, radius, weight));
        }
        self.radius = self.radius.max(radius);
    }

    /// How much there is along a line already, per point of its length.
    pub fn busy(&self, a: [f64; 2], b: [f64; 2]) -> f64 {
        let (vx, vy) = (b[0] - a[0], b[1] - a[1]);
        let square = (vx * vx + vy * vy).max(1e-9);
        let mut sum = 0.0;
        let reach = self.radius + 3.0;
        let [left, right] = [a[0].min(b[0]) - reach, a[0].max(b[0]) + reach];
        let [top, bottom] = [a[1].min(b[1]) - reach, a[1].max(b[1]) + reach];
        for ([x, y], radius, weight) in self.within([left, top, right, bottom]) {
            let t = (((x - a[0]) * vx + (y - a[1]) * vy) / square).clamp(0.0, 1.0);
            let (dx, dy) = (a[0] + t * vx - x, a[1] + t * vy - y);
            if dx.hypot(dy) < radius + 3.0 {
                sum += weight;
            }
        }
        let outside =
            |p: [f64; 2]| p[0] < 4.0 || p[1] < 4.0 || p[0] > self.width - 4.0 || p[1] > self.height - 4.0;
        sum / square.sqrt() + if outside(a) || outside(b) { 10.0 } else { 0.0 }
    }

    /// Places a label; it overlaps no other.
    pub fn place(&mut self, wish: &Wish, shapes: &mut Vec<Shape>) {
        let w = width(&wish.label, wish.size);
        let h = wish.size * (RISE + DEPTH);
        let mut best: Option<(f64, Rect, [f64; 2], f64)> = None;
        for (rank, &anchor) in wish.anchors.iter().enumerate() {
            for ring in [0.0, 3.0, 7.0, 12.0, 18.0, 26.0, 36.0, 48.0, 64.0] {
                // Farther rings cost more than the best that is found already.
                let base = 0.5 * ring + 0.8 * rank as f64;
                if best.as_ref().is_some_and(|b| b.0 <= base) {
                    break;
                }
                for turn in 0..16 {
                    let angle = f64::from(turn) * std::f64::consts::PI / 8.0;
                    let (s, c) = angle.sin_cos();
                    let away = wish.distance + ring;
                    // The label's nearest edge or corner, not its middle, has the distance.
                    let half = |t: f64, extent: f64| (1.42 * t).clamp(-1.0, 1.0) * extent / 2.0;
                    let middle = [anchor[0] + c * away + half(c, w), anchor[1] + s * away + half(s, h)];
                    let rect = around(middle, w, h);
                    let turned = 1.0 - (c * wish.direction[0] + s * wish.direction[1]);
                    let Some(covered) = self.covered(&rect) else { continue };
                    let cost = base + 2.2 * turned + covered;
                    if best.as_ref().is_none_or(|b| cost < b.0) {
                        best = Some((cost, rect, anchor, away));
                    }
                }
            }
        }
        let found = best.or_else(|| self.anywhere(wish, w, h));
        let Some((_, rect, anchor, away)) = found else { return };
        if away > FAR.max(wish.distance + 13.0) {
            let near = [anchor[0].clamp(rect[0], rect[2]), anchor[1].clamp(rect[1], rect[3])];
            shapes.push(Shape::Path {
                segments: polyline(&[anchor, near]),
                fill: None,
                stroke: Some(Stroke { ink: Ink::Faint, width: 0.6, dash: None }),
            });
            self.block(anchor, near, 0.5, 1.0);
        }
        shapes.push(Shape::Text {
            at: [(rect[0] + rect[2]) / 2.0, rect[1] + RISE * wish.size],
            anchor: Anchor::Middle,
            size: wish.size,
            ink: wish.ink,
            label: wish.label.clone(),
        });
        self.taken.push(rect);
    }

    /// What a label at a place would cover; none if it would overlap another or leave the sheet.
    fn covered(&self, rect: &Rect) -> Option<f64> {
        let [l, t, r, b] = *rect;
        if l < 1.0 || t < 1.0 || r > self.width - 1.0 || b > self.height - 1.0 {
            return None;
        }
        let apart = |o: &Rect| l >= o[2] + AIR || r + AIR <= o[0] || t >= o[3] + AIR || b + AIR <= o[1];
        if !self.taken.iter().all(apart) {
            return None;
        }
        let mut sum = 0.0;
        let reach = self.radius + AIR;
        for ([x, y], radius, weight) in self.within([l - reach, t - reach, r + reach, b + reach]) {
            let (dx, dy) = ((l - x).max(x - r), (t - y).max(y - b));
            if dx < radius + AIR && dy < radius + AIR {
                sum += 2.0 * weight;
            }
        }
        Some(sum)
    }

    /// The free place nearest to what is named, wherever it is.
    fn anywhere(&self, wish: &Wish, w: f64, h: f64) -> Option<(f64, Rect, [f64; 2], f64)> {
        let anchor = *wish.anchors.first()?;
        let mut best: Option<(f64, Rect, [f64; 2], f64)> = None;
        let (columns, rows) =
            ((self.width / 6.0).min(200.0) as usize, (self.height / 6.0).min(200.0) as usize);
        for i in 0..columns {
            for k in 0..rows {
                let middle = [6.0 * i as f64 + w / 2.0, 6.0 * k as f64 + h / 2.0];
                let away = (middle[0] - anchor[0]).hypot(middle[1] - anchor[1]);
                let rect = around(middle, w, h);
                let Some(covered) = self.covered(&rect) else { continue };
                let cost = away + covered;
                if best.as_ref().is_none_or(|b| cost < b.0) {
                    best = Some((cost, rect, anchor, away));
                }
            }
        }
        best
    }
}

/// How many squares there are along a side of the sheet.
fn cells(size: f64) -> usize {
    (size / CELL).ceil().clamp(1.0, 1000.0) as usize
}

fn around([x, y]: [f64; 2], w: f64, h: f64) -> Rect {
    [x - w / 2.0, y - h / 2.0, x + w / 2.0, y + h / 2.0]
}

/// The rectangle that a label with letters of a size fills.
pub fn rect(at: [f64; 2], anchor: Anchor, size: f64, label: &Label) -> Rect {
    let w = width(label, size);
    let left = match anchor {
        Anchor::Start => at[0],
        Anchor::Middle => at[0] - w / 2.0,
        Anchor::End => at[0] - w,
    };
    [left, at[1] - RISE * size, left + w, at[1] + DEPTH * size]
}
