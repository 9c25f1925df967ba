//! The edge of what is reached: around the cells, then pushed out to where the arm really ends.

use super::arm::Arm;
use super::cells::Cells;
use super::contour::{Field, area, contours};

/// Walks of a point that is pushed out.
const WALKS: usize = 16;
/// Cells that a point of the edge may be moved by.
const FURTHEST: f64 = 1.6;

/// Closed lines in the section's coordinates (metres), what is reached on their left.
pub(super) fn boundary(arm: &mut Arm, cells: &Cells) -> Vec<Vec<[f64; 2]>> {
    let grid = cells.grid;
    let mask: Vec<f64> = cells.values.iter().map(|v| f64::from(u8::from(v.is_some()))).collect();
    let field = Field { values: &mask, columns: grid.columns, outside: 0.0 };
    let origin = grid.centre(0);
    let mut lines = vec![];
    for line in contours(&field, 0.5) {
        // A single cell that was not met in the midst of others is no hole.
        if area(&line) < 0.0 && area(&line) > -1.2 {
            continue;
        }
        let line: Vec<[f64; 2]> = line.iter().map(|p| [0, 1].map(|k| origin[k] + p[k] * grid.side)).collect();
        lines.push(tidied(&pushed(arm, cells, &smoothed(&line)), grid.side));
    }
    lines.retain(|l| l.len() > 2);
    lines
}

/// Each point between its neighbours: staircases become slopes.
fn smoothed(line: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let n = line.len();
    let of = |i: usize| {
        let (a, b, c) = (line[(i + n - 1) % n], line[i], line[(i + 1) % n]);
        [0, 1].map(|k| 0.25 * a[k] + 0.5 * b[k] + 0.25 * c[k])
    };
    (0..n).map(of).collect()
}

/// Each point moved to the place nearest to a target a cell further out that the arm comes to.
fn pushed(arm: &mut Arm, cells: &Cells, line: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let (n, grid) = (line.len(), cells.grid);
    let mut points: Vec<Pushed> = vec![];
    for i in 0..n {
        let here = line[i];
        // Over some points, because the normal of a staircase is not that of the edge.
        let (a, b) = (line[(i + n - n.min(3)) % n], line[(i + 3) % n]);
        let tangent = [b[0] - a[0], b[1] - a[1]];
        let length = tangent[0].hypot(tangent[1]).max(1e-12);
        let out = [tangent[1] / length, -tangent[0] / length];
        let target = [0, 1].map(|k| here[k] + 1.2 * grid.side * out[k]);
        let mut point = Pushed { target, place: here, left: f64::INFINITY, q: arm.middle() };
        // The cells nearest to the point on its inner side may hold postures whose own end is further in.
        let inner = [0, 1].map(|k| here[k] - 0.6 * grid.side * out[k]);
        let nearest = grid.cell(inner);
        let around = nearest.into_iter().chain(nearest.into_iter().flat_map(|c| grid.around(c)));
        for cell in around.filter(|&c| cells.values[c].is_some()) {
            point.push(arm, cells.configuration(cell), grid.side);
        }
        points.push(point);
    }
    // What came furthest at one point may at those beside it.
    for i in (0..n).chain((0..n).rev()) {
        for beside in [i + 1, i + n - 1, i + 2, i + n - n.min(2)] {
            let q = points[beside % n].q.clone();
            points[i].push(arm, &q, grid.side);
        }
    }
    let near = |(point, here): (&Pushed, &[f64; 2])| {
        let is_near = away(point.place, *here) <= FURTHEST * grid.side;
        if is_near { point.place } else { *here }
    };
    points.iter().zip(line).map(near).collect()
}

/// A point that is pushed out.
struct Pushed {
    target: [f64; 2],
    /// Where it came to, how far from the target that is, and by which configuration.
    place: [f64; 2],
    left: f64,
    q: Vec<f64>,
}

impl Pushed {
    /// Tries from a configuration.
    fn push(&mut self, arm: &mut Arm, from: &[f64], side: f64) {
        let mut q = from.to_vec();
        let place = arm.approach(&mut q, self.target, 1e-3 * side, WALKS);
        let left = away(place, self.target);
        if left < self.left - 1e-6 * side {
            (self.place, self.left, self.q) = (place, left, q);
        }
    }
}

fn away(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Without points that stand on top of each other or on the line between their neighbours.
fn tidied(line: &[[f64; 2]], side: f64) -> Vec<[f64; 2]> {
    let mut kept: Vec<[f64; 2]> = vec![];
    for (i, &p) in line.iter().enumerate() {
        let Some(&last) = kept.last() else {
            kept.push(p);
            continue;
        };
        let next = line[(i + 1) % line.len()];
        let (a, b) = ([p[0] - last[0], p[1] - last[1]], [next[0] - p[0], next[1] - p[1]]);
        let (la, lb) = (a[0].hypot(a[1]), b[0].hypot(b[1]));
        let is_straight =
            (a[0] * b[1] - a[1] * b[0]).abs() <= 5e-3 * la * lb && a[0] * b[0] + a[1] * b[1] > 0.0;
        if la > 0.1 * side && !(is_straight && la < 2.5 * side) {
            kept.push(p);
        }
    }
    kept
}
