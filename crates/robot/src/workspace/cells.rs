//! The cells of the section that the tool point comes to: sampled, grown from cell to cell, improved.

use super::arm::{Arm, Sequence};
use super::extremes::{Extremes, Objective, climb};
use super::section::Section;
use std::collections::VecDeque;

/// Square cells in the section's coordinates.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Grid {
    /// The lower left corner, metres.
    pub origin: [f64; 2],
    /// The side of a cell, metres.
    pub side: f64,
    /// How many cells stand beside each other.
    pub columns: usize,
    /// How many cells stand upon each other.
    pub rows: usize,
}

impl Grid {
    /// How many cells there are; cell `k` is in column `k % columns` of row `k / columns`, the lowest row first.
    pub fn len(&self) -> usize {
        self.columns * self.rows
    }

    /// Whether there is no cell.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The centre of a cell, metres.
    pub fn centre(&self, cell: usize) -> [f64; 2] {
        let (i, j) = (cell % self.columns, cell / self.columns);
        [self.origin[0] + (i as f64 + 0.5) * self.side, self.origin[1] + (j as f64 + 0.5) * self.side]
    }

    /// The cell that a point lies in.
    pub fn cell(&self, at: [f64; 2]) -> Option<usize> {
        let [x, y] = [0, 1].map(|k| ((at[k] - self.origin[k]) / self.side).floor());
        let inside = x >= 0.0 && y >= 0.0 && x < self.columns as f64 && y < self.rows as f64;
        inside.then(|| y as usize * self.columns + x as usize)
    }

    /// The cells around one: four that share a side, then four that share a corner.
    pub(super) fn around(&self, cell: usize) -> impl Iterator<Item = usize> + use<> {
        const AWAY: [(isize, isize); 8] =
            [(1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1)];
        let (columns, rows) = (self.columns, self.rows);
        let (i, j) = (cell % columns, cell / columns);
        AWAY.into_iter().filter_map(move |(x, y)| {
            let (i, j) = (i.checked_add_signed(x)?, j.checked_add_signed(y)?);
            (i < columns && j < rows).then_some(j * columns + i)
        })
    }
}

/// What is known of each cell.
pub(super) struct Cells {
    pub grid: Grid,
    /// The largest measure found; none where the tool point does not come.
    pub values: Vec<Option<f64>>,
    /// The configurations with these measures, one after the other.
    pub configurations: Vec<f64>,
    joints: usize,
}

/// Cells across the larger side.
const ACROSS: f64 = 120.0;
/// Configurations sampled.
const SAMPLES: usize = 12_000;
/// Joints of an arm with very many.
const MANY: f64 = 24.0;
/// Samples that each extreme is climbed to from.
const STARTS: usize = 6;
/// Walks to a neighbouring cell.
const WALKS: usize = 5;

/// Finds the extremes, then the cells between them.
pub(super) fn find(arm: &mut Arm) -> (Cells, Extremes) {
    let joints = arm.ranges.len();
    let mut q = arm.middle();
    let mut sequence = Sequence::new(joints);
    // A walk takes as many steps as there are joints: with very many of them fewer cells and samples are looked at.
    let part = (MANY / joints.max(1) as f64).min(1.0);
    let (count, across) = ((SAMPLES as f64 * part) as usize, (ACROSS * part.sqrt()).round());
    let mut samples = vec![0.0; count * joints];
    let mut seen: Vec<Seen> = Vec::with_capacity(count);
    for sample in samples.chunks_exact_mut(joints.max(1)) {
        sequence.next(&arm.ranges, &mut q);
        sample.copy_from_slice(&q);
        let place = arm.at(&q);
        let far = arm.shoulder.map_or(0.0, |s| (arm.walk.point - s).norm());
        seen.push(Seen { place, far, measure: arm.measure() });
    }
    let (extremes, seeds) = extremes(arm, &samples, &seen);
    let mut cells = Cells::new(grid(&arm.section, &extremes, across), joints);
    for (sample, seen) in samples.chunks_exact(joints.max(1)).zip(&seen) {
        cells.offer(seen.place, seen.measure, sample);
    }
    for q in &seeds {
        let place = arm.at(q);
        cells.offer(place, arm.measure(), q);
    }
    cells.grow(arm, 2 * WALKS);
    cells.spread(arm);
    cells.climb(arm);
    cells.spread(arm);
    // Other postures have come to the edge.
    cells.grow(arm, 4 * WALKS);
    (cells, extremes)
}

/// A sample's place in the section, its distance from the shoulder, its measure.
struct Seen {
    place: [f64; 2],
    far: f64,
    measure: f64,
}

/// The extremes, and the configurations that have them.
fn extremes(arm: &mut Arm, samples: &[f64], seen: &[Seen]) -> (Extremes, Vec<Vec<f64>>) {
    let joints = arm.ranges.len();
    let shoulder = arm.shoulder;
    let mut seeds = vec![];
    let mut best = |objective: Objective, rough: &dyn Fn(&Seen) -> f64| {
        let mut order: Vec<usize> = (0..seen.len()).collect();
        let starts = STARTS.min(order.len());
        order.select_nth_unstable_by(starts.saturating_sub(1), |&a, &b| {
            rough(&seen[b]).total_cmp(&rough(&seen[a])).then(a.cmp(&b))
        });
        let mut highest: Option<(f64, Vec<f64>)> = None;
        for &k in &order[..starts] {
            let mut q = samples[k * joints..(k + 1) * joints].to_vec();
            let value = climb(arm, objective, &mut q);
            if highest.as_ref().is_none_or(|h| value > h.0) {
                highest = Some((value, q));
            }
        }
        let q = highest.map(|h| h.1).unwrap_or_default();
        let place = arm.at(&q);
        let far = arm.shoulder.map_or(0.0, |s| (arm.walk.point - s).norm());
        seeds.push(q);
        (place, far)
    };
    let mut first = [
        best(Objective::First(-1.0), &|s| -s.place[0]).0[0],
        best(Objective::First(1.0), &|s| s.place[0]).0[0],
    ];
    let second = [
        best(Objective::Second(-1.0), &|s| -s.place[1]).0[1],
        best(Objective::Second(1.0), &|s| s.place[1]).0[1],
    ];
    let from_shoulder = shoulder.map(|s| best(Objective::From(s), &|s| s.far).1);
    // The axis itself is met up to rounding only.
    if matches!(arm.section, Section::ThroughAxis { .. }) && first[0] < 1e-6 * arm.length {
        first[0] = 0.0;
    }
    (Extremes { first, second, from_shoulder, shoulder }, seeds)
}

/// Cells from extreme to extreme, and one or two more; none beyond the axis.
fn grid(section: &Section, extremes: &Extremes, across: f64) -> Grid {
    let sides = [extremes.first, extremes.second].map(|[low, high]| (high - low).max(0.0));
    let side = (sides[0].max(sides[1]) / across).max(1e-9);
    let count = |wide: f64| (wide / side - 1e-6).ceil().clamp(1.0, across) as usize + 3;
    let mut grid = Grid {
        // Half a cell off, so that rounding at an extreme does not reach another cell.
        origin: [extremes.first[0] - 1.5 * side, extremes.second[0] - 1.5 * side],
        side,
        columns: count(sides[0]),
        rows: count(sides[1]),
    };
    if matches!(section, Section::ThroughAxis { .. }) && grid.origin[0] < 0.0 {
        grid.origin[0] = 0.0;
    }
    grid
}

impl Cells {
    fn new(grid: Grid, joints: usize) -> Self {
        Cells { grid, values: vec![None; grid.len()], configurations: vec![0.0; grid.len() * joints], joints }
    }

    /// The configuration of a cell.
    pub fn configuration(&self, cell: usize) -> &[f64] {
        &self.configurations[cell * self.joints..(cell + 1) * self.joints]
    }

    /// Keeps a configuration if its cell has none that is as good; its cell if it is kept.
    fn offer(&mut self, place: [f64; 2], measure: f64, q: &[f64]) -> Option<usize> {
        let cell = self.grid.cell(place)?;
        if self.values[cell].is_some_and(|v| v >= measure) {
            return None;
        }
        self.values[cell] = Some(measure);
        self.configurations[cell * self.joints..(cell + 1) * self.joints].copy_from_slice(q);
        Some(cell)
    }

    /// Steps from every reached cell to those beside it that are not, until nothing changes.
    fn grow(&mut self, arm: &mut Arm, walks: usize) {
        let reached = |k: &usize| self.values[*k].is_some();
        let mut queue: VecDeque<usize> = (0..self.grid.len()).filter(reached).collect();
        let mut q = arm.middle();
        while let Some(cell) = queue.pop_front() {
            for beside in self.grid.around(cell) {
                if self.values[beside].is_some() {
                    continue;
                }
                q.copy_from_slice(self.configuration(cell));
                let place = arm.approach(&mut q, self.grid.centre(beside), 0.25 * self.grid.side, walks);
                // A step that came to another cell is as good as one that came here.
                let came = self.grid.cell(place).filter(|&c| self.values[c].is_none());
                if came.is_some() {
                    arm.walk.to(&q);
                    self.offer(place, arm.measure(), &q);
                    queue.extend(came);
                }
            }
        }
    }

    /// Tries each cell's configuration in the cells around it, there and back through the grid: good postures spread.
    fn spread(&mut self, arm: &mut Arm) {
        let count = self.grid.len();
        for k in (0..count).chain((0..count).rev()) {
            let Some(mut value) = self.values[k] else { continue };
            for beside in self.grid.around(k).take(4) {
                if !self.values[beside].is_some_and(|v| v > value * 1.002) {
                    continue;
                }
                let mut q = self.configuration(beside).to_vec();
                let place = arm.approach(&mut q, self.grid.centre(k), 0.3 * self.grid.side, WALKS);
                if self.grid.cell(place) == Some(k) {
                    arm.walk.to(&q);
                    self.offer(place, arm.measure(), &q);
                    value = self.values[k].unwrap_or(value);
                }
            }
        }
    }

    /// Moves each cell's configuration uphill in what its joints leave free, a step or two.
    fn climb(&mut self, arm: &mut Arm) {
        let mut gradient = vec![0.0; self.joints];
        for k in 0..self.grid.len() {
            let Some(value) = self.values[k] else { continue };
            let mut q = self.configuration(k).to_vec();
            for (j, g) in gradient.iter_mut().enumerate() {
                let unit = arm.weights[j].sqrt();
                *g = 0.0;
                if unit > 0.0 {
                    let here = q[j];
                    q[j] += 1e-5 * unit;
                    arm.walk.to(&q);
                    *g = (arm.measure() - value) / 1e-5;
                    q[j] = here;
                }
            }
            let length = gradient.iter().map(|g| g * g).sum::<f64>().sqrt();
            if length <= 1e-9 * value {
                continue;
            }
            for step in [0.4, 0.12] {
                let mut q = self.configuration(k).to_vec();
                for ((x, g), w) in q.iter_mut().zip(&gradient).zip(&arm.weights) {
                    *x += step * g / length * w.sqrt();
                }
                arm.clamp(&mut q);
                let place = arm.approach(&mut q, self.grid.centre(k), 0.3 * self.grid.side, WALKS);
                if self.grid.cell(place) == Some(k) {
                    arm.walk.to(&q);
                    if self.offer(place, arm.measure(), &q).is_some() {
                        break;
                    }
                }
            }
        }
    }
}
