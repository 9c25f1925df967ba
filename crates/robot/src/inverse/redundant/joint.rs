//! Redundant arms with a closed form for given joints: all configurations by the value of a joint that is given.
//!
//! The compiled solver gives all branches for a value; branches are followed over samples that become denser where joints
//! move fast, their ends and the places where limits are reached are closed in on.

use super::feasible::{self, Point};
use super::limits::{Range, SLACK, excess};
use super::manifold::{Chart, Found, Piece};
use crate::description::Description;
use crate::geometry::Transform;
use crate::inverse::branch::{self, Label};
use crate::inverse::closed::variables;
use crate::inverse::derivation::{Goal, InverseModel};
use crate::mechanism::{MissingValue, Robot};
use crate::shared::Shared;
use crate::space::JointSpace;
use denavit_program::solver::{Leaf, SolverScalar};
use std::f64::consts::{PI, TAU};

/// A branch is a solution up to this residual; at its end the residual decides to this.
const SOLVED: f64 = 1e-9;
const SHARP: f64 = 1e-11;
/// Values that are tried before a manifold is computed.
const TRIES: usize = 128;
/// Values all round, before they become denser, and how often they may.
const VALUES: usize = 96;
const DENSER: usize = 14;
/// Values in all, and parts of a branch: beyond these a branch comes and goes with rounding.
const MOST: usize = 3000;
const PARTS: usize = 24;
/// Neighbours further apart than this have a value between them.
const APART: f64 = 0.3;
/// How often the place where a gap is least is closed in on; with a double root there, which may be two that are not
/// quite real, how often in all.
const DIVISIONS: usize = 24;
const CLOSER: usize = 48;
/// What a residual counts for as a gap: less than any gap of an equation without a root.
const NEARLY: f64 = 1e-3;
/// Values of each further joint that is given.
const SLICES: usize = 7;

/// The solver for given joints.
#[derive(Clone, Debug)]
pub(super) struct ByJoint {
    scalar: Shared<SolverScalar>,
    goal: Goal,
    /// The joints that are given; the last one is the parameter.
    pub given: Vec<usize>,
    /// The name of the parameter.
    pub name: String,
    /// The names of all joints that are given.
    pub names: Vec<String>,
    labels: Vec<Option<Label>>,
    space: JointSpace,
    ranges: Vec<Range>,
}

/// A value of the parameter with its branches.
struct Sample {
    x: f64,
    branches: Vec<Branch>,
    /// For each node, how far the nearest branch that ended there is from going on; infinite if none ended.
    gaps: Vec<f64>,
}

/// A solution for a value of the parameter.
struct Branch {
    signs: Vec<i8>,
    q: Vec<f64>,
    /// Whether two branches are one here: where they meet, or between them where neither is quite real.
    is_double: bool,
}

impl Sample {
    fn on(&self, signs: &[i8]) -> Option<&Vec<f64>> {
        self.branches.iter().find(|b| b.signs == signs).map(|b| &b.q)
    }
}

impl ByJoint {
    /// The solver of a model with given joints.
    pub fn new(
        model: &InverseModel,
        description: &Description,
        robot: &Robot<f64>,
        space: &JointSpace,
    ) -> Result<Self, MissingValue> {
        let function = model.function(description, robot)?;
        let given = model.given.clone();
        let variables = description.variables();
        let names: Vec<String> = given.iter().map(|&j| variables[j].symbol.name().to_string()).collect();
        Ok(ByJoint {
            scalar: Shared::new(function.scalar()),
            goal: model.goal,
            name: names.last().cloned().unwrap_or_default(),
            names,
            labels: model.labels.clone(),
            ranges: Range::all(space),
            space: space.clone(),
            given,
        })
    }

    fn parameter(&self) -> usize {
        self.given.last().copied().unwrap_or(0)
    }

    /// The values that a joint is given: its limits, or all round.
    fn span(&self, joint: usize) -> [f64; 2] {
        let far = self.space.half_range(joint);
        self.ranges[joint].ends().unwrap_or([-far, far])
    }

    /// One within the limits, if one of a few values has one; values near those of `seed` come first.
    pub fn quick(&self, pose: &Transform<f64>, seed: Option<&[f64]>) -> Option<Found> {
        let m = self.given.len();
        let mut inputs = variables(self.goal, pose, &vec![0.0; m]);
        let first = inputs.len() - m;
        let spans: Vec<[f64; 2]> = self.given.iter().map(|&j| self.span(j)).collect();
        let tries = TRIES * m.pow(3);
        for number in 0..tries + usize::from(seed.is_some()) {
            for (k, [low, high]) in spans.iter().enumerate() {
                inputs[first + k] = match (seed, number) {
                    (Some(q), 0) => q[self.given[k]],
                    (Some(_), _) => low + (high - low) * radical(number, BASES[k % BASES.len()]),
                    (None, _) => low + (high - low) * radical(number + 1, BASES[k % BASES.len()]),
                };
            }
            let mut scalar = self.scalar.lend();
            let leaves = scalar.solve(&inputs, &[]);
            let ranges = &self.ranges;
            let good = |l: &Leaf| l.free == 0 && l.residual <= SOLVED && excess(ranges, l.outputs) <= SLACK;
            let found = match seed {
                None => leaves.iter().find(good),
                Some(q) => {
                    let away = |l: &Leaf| self.space.distance(q, l.outputs);
                    leaves.iter().filter(good).min_by(|a, b| away(a).total_cmp(&away(b)))
                }
            };
            if let Some(leaf) = found {
                let branch = branch(&self.labels, leaf.signs);
                return Some(Found { q: leaf.outputs.to_vec(), guard: Some(leaf.guard), branch });
            }
        }
        None
    }

    /// The member of a component at a value.
    pub fn member(
        &self,
        pose: &Transform<f64>,
        (signs, others): (&[i8], &[f64]),
        x: f64,
    ) -> Option<Vec<f64>> {
        let mut inputs = self.inputs(pose, others);
        self.on(&mut inputs, signs, x, SOLVED)
    }

    fn inputs(&self, pose: &Transform<f64>, others: &[f64]) -> Vec<f64> {
        let mut given = others.to_vec();
        given.push(0.0);
        variables(self.goal, pose, &given)
    }

    fn on(&self, inputs: &mut [f64], signs: &[i8], x: f64, most: f64) -> Option<Vec<f64>> {
        if let Some(last) = inputs.last_mut() {
            *last = x;
        }
        let mut scalar = self.scalar.lend();
        let leaves = scalar.solve(inputs, &[]);
        let good = |l: &Leaf| l.free == 0 && l.residual <= most;
        // At its very end a branch is one with another, whose signs are kept.
        let other = |l: &Leaf| l.signs.iter().zip(signs).filter(|(a, b)| a != b).count();
        let leaf = leaves
            .iter()
            .filter(good)
            .find(|l| l.signs == signs)
            .or_else(|| leaves.iter().filter(good).filter(|l| l.multiplicity > 1).min_by_key(other))?;
        Some(leaf.outputs.to_vec())
    }

    fn sample(&self, inputs: &mut [f64], x: f64) -> Sample {
        if let Some(last) = inputs.last_mut() {
            *last = x;
        }
        let mut scalar = self.scalar.lend();
        let leaves = scalar.solve(inputs, &[]);
        let good = leaves.iter().filter(|l| l.free == 0 && l.residual <= SOLVED);
        let branch = |l: Leaf| Branch {
            signs: l.signs.to_vec(),
            q: l.outputs.to_vec(),
            is_double: l.multiplicity > 1,
        };
        let branches = good.map(branch).collect();
        let mut gaps = vec![f64::INFINITY; self.labels.len()];
        leaves.ended().for_each(|end| gaps[end.node] = end.gap);
        // Where two roots that are not quite real were taken as one, the residual says how far they are from it.
        let doubles = leaves.iter().filter(|l| l.free == 0 && l.multiplicity > 1);
        let nearly = doubles.map(|l| NEARLY * l.residual).fold(f64::INFINITY, f64::min);
        gaps.iter_mut().for_each(|gap| *gap = gap.min(nearly));
        Sample { x, branches, gaps }
    }

    /// All branches of a pose; with more than one joint given, for a grid of values of the others.
    pub fn pieces(&self, pose: &Transform<f64>) -> Vec<Piece> {
        let others = self.given[..self.given.len() - 1].to_vec();
        let count = SLICES.pow(others.len() as u32);
        let mut found = vec![];
        for number in 0..count {
            let mut rest = number;
            let values: Vec<f64> = others
                .iter()
                .map(|&j| {
                    let [low, high] = self.span(j);
                    let part = ((rest % SLICES) as f64 + 0.5) / SLICES as f64;
                    rest /= SLICES;
                    low + (high - low) * part
                })
                .collect();
            self.slice(pose, &values, &mut found);
        }
        found
    }

    /// The branches with the other given joints at some values.
    fn slice(&self, pose: &Transform<f64>, others: &[f64], found: &mut Vec<Piece>) {
        let mut inputs = self.inputs(pose, others);
        let parameter = self.parameter();
        let is_angle = self.space.turning.goes_round(parameter);
        let [low, high] = if is_angle { [-PI, PI] } else { self.span(parameter) };
        let samples = self.samples(&mut inputs, [low, high]);
        let mut known: Vec<&Vec<i8>> = vec![];
        for s in samples.iter().flat_map(|s| &s.branches) {
            if !known.contains(&&s.signs) {
                known.push(&s.signs);
            }
        }
        known.sort_by(|a, b| b.cmp(a));
        for signs in known {
            // Runs of neighbours that have the branch: places of the first and the last.
            let mut runs: Vec<[usize; 2]> = vec![];
            for k in (0..samples.len()).filter(|&k| samples[k].on(signs).is_some()) {
                match runs.last_mut() {
                    Some(run) if run[1] + 1 == k => run[1] = k,
                    _ => runs.push([k, k]),
                }
            }
            let last = samples.len() - 1;
            let goes_round = is_angle && runs.len() > 1 && runs[0][0] == 0 && runs[runs.len() - 1][1] == last;
            let tail = if goes_round { runs.pop() } else { None };
            if runs.len() > PARTS {
                runs.sort_by_key(|[a, b]| a.abs_diff(*b));
                runs.drain(..runs.len() - PARTS);
                runs.sort_unstable();
            }
            for (number, [a, b]) in runs.into_iter().enumerate() {
                let point = |k: usize, turn: f64| {
                    let q = samples[k].on(signs)?;
                    Some((samples[k].x + turn, excess(&self.ranges, q)))
                };
                let mut points: Vec<Point> = (a..=b).filter_map(|k| point(k, 0.0)).collect();
                let (mut from, turn) = (a, if is_angle { TAU } else { 0.0 });
                if let (0, Some([c, _])) = (number, tail) {
                    // From the tail across the seam: π is −π.
                    let before: Vec<Point> = (c..last).filter_map(|k| point(k, -turn)).collect();
                    points.splice(0..0, before);
                    from = c;
                }
                let whole = is_angle && a == 0 && b == last;
                if !whole {
                    let mut end = |k: usize, outside: Option<&Sample>, turn: f64| {
                        self.end(&mut inputs, signs, samples[k].x, outside?.x, turn)
                    };
                    let before = from.checked_sub(1).and_then(|k| samples.get(k));
                    let first = end(from, before, if from == a { 0.0 } else { -turn });
                    let after = end(b, samples.get(b + 1), 0.0);
                    points.splice(0..0, first);
                    points.extend(after);
                }
                match points[..] {
                    [] => continue,
                    // At the border of what can be reached there may be a single value.
                    [only] => points.push(only),
                    _ => {}
                }
                let mut along = |x: f64| {
                    let x = if is_angle { super::wrapped(x) } else { x };
                    let q = self.on(&mut inputs, signs, x, SOLVED)?;
                    Some(excess(&self.ranges, &q))
                };
                let mut parts = feasible::intervals(&points, &mut along);
                let mut domain = [points[0].0, points[points.len() - 1].0];
                if domain[0] == domain[1] && points[0].1 <= SLACK {
                    parts = vec![domain];
                }
                if whole {
                    domain = [-PI, PI];
                    join_round(&mut parts);
                } else if is_angle && domain[0] <= -PI {
                    domain = domain.map(|x| x + TAU);
                    parts.iter_mut().flatten().for_each(|x| *x += TAU);
                }
                found.push(Piece {
                    branch: branch(&self.labels, signs),
                    parameter: self.name.clone(),
                    domain,
                    feasible: parts,
                    is_closed: whole,
                    chart: Chart::Joint { signs: signs.clone(), others: others.to_vec() },
                });
            }
        }
    }

    /// Values from `low` to `high`, denser where branches move fast or end.
    fn samples(&self, inputs: &mut [f64], [low, high]: [f64; 2]) -> Vec<Sample> {
        let at = (0..=VALUES).map(|k| low + (high - low) * k as f64 / VALUES as f64);
        let mut samples: Vec<Sample> = at.map(|x| self.sample(inputs, x)).collect();
        for k in (1..samples.len() - 1).rev() {
            let three = [k - 1, k, k + 1].map(|k| &samples[k]);
            let between = [k - 1, k + 1].map(|k| samples[k].x);
            if let Some(found) = self.hidden(inputs, three, between) {
                samples.insert(if found.x < samples[k].x { k } else { k + 1 }, found);
            }
        }
        if high - low >= TAU && self.space.turning.goes_round(self.parameter()) {
            self.hidden_at_the_seam(inputs, &mut samples);
        }
        for _ in 0..DENSER {
            let mut denser: Vec<Sample> = vec![];
            let mut grew = false;
            let count = samples.len();
            for (k, s) in samples.into_iter().enumerate() {
                if let Some(last) = denser.last()
                    && denser.len() + count - k < MOST
                    && self.is_rough(last, &s)
                {
                    let middle = (last.x + s.x) / 2.0;
                    denser.push(self.sample(inputs, middle));
                    grew = true;
                }
                denser.push(s);
            }
            samples = denser;
            if !grew {
                break;
            }
        }
        samples
    }

    /// Adds what is [hidden](Self::hidden) where the circle is cut: the first and the last sample are one.
    fn hidden_at_the_seam(&self, inputs: &mut [f64], samples: &mut Vec<Sample>) {
        let last = samples.len() - 1;
        let three = [last - 1, 0, 1].map(|k| &samples[k]);
        let between = [samples[last - 1].x - TAU, samples[1].x];
        let Some(found) = self.hidden(inputs, three, between) else { return };
        if found.x >= samples[0].x {
            samples.insert(1, found);
        } else {
            let found = self.sample(inputs, found.x + TAU);
            samples.insert(last, found);
        }
    }

    /// A place near the middle one of three neighbours, between the others: with branches that the two beside it do not
    /// have (an island), or without branches that they have (a hole).
    fn hidden(&self, inputs: &mut [f64], three: [&Sample; 3], between: [f64; 2]) -> Option<Sample> {
        let [a, b, c] = three;
        let is_least = |&i: &usize| b.gaps[i].is_finite() && b.gaps[i] <= a.gaps[i] && b.gaps[i] < c.gaps[i];
        let nodes: Vec<usize> = (0..b.gaps.len()).filter(is_least).collect();
        let island = nodes.into_iter().find_map(|node| self.island(inputs, three, between, node));
        island.or_else(|| {
            let pairs = self.nearing(three);
            pairs.into_iter().find_map(|pair| self.hole(inputs, b, between, &pair))
        })
    }

    /// Where the gap of a node closes that is least at the middle one of three neighbours.
    fn island(
        &self,
        inputs: &mut [f64],
        [a, b, c]: [&Sample; 3],
        between: [f64; 2],
        node: usize,
    ) -> Option<Sample> {
        let mut search = Lowest::new(between, (b.x, b.gaps[node]));
        let mut reached: Option<Sample> = None;
        for division in 0..CLOSER {
            if division >= DIVISIONS && reached.is_none() {
                break;
            }
            let found = self.sample(inputs, search.next());
            search.take(found.gaps[node]);
            let beside = if found.x < b.x { a } else { c };
            let is_new = |s: &&Branch| b.on(&s.signs).is_none() && beside.on(&s.signs).is_none();
            match found.branches.iter().filter(is_new).map(|s| s.is_double).reduce(|p, q| p && q) {
                None => {}
                Some(false) => return Some(found),
                // Two real roots may be near.
                Some(true) if reached.as_ref().is_none_or(|r| found.gaps[node] < r.gaps[node]) => {
                    reached = Some(found);
                }
                Some(true) => {}
            }
        }
        reached
    }

    /// Branches that differ in one sign and may meet between three neighbours.
    fn nearing(&self, [a, b, c]: [&Sample; 3]) -> Vec<[Vec<i8>; 2]> {
        let mut found = vec![];
        for (number, s) in b.branches.iter().enumerate() {
            for t in &b.branches[number + 1..] {
                if s.signs.iter().zip(&t.signs).filter(|(x, y)| x != y).count() != 1 {
                    continue;
                }
                let pair = [&s.signs, &t.signs];
                let apart = |at: &Sample| self.apart(at, pair);
                if let Some(middle) = apart(b)
                    && let Some(before) = apart(a).filter(|&x| middle <= x)
                    && let Some(after) = apart(c).filter(|&x| middle < x)
                    && comes_down([before, middle, after])
                {
                    found.push(pair.map(Clone::clone));
                }
            }
        }
        found
    }

    /// The distance of two branches.
    fn apart(&self, at: &Sample, [s, t]: [&Vec<i8>; 2]) -> Option<f64> {
        Some(self.space.distance(at.on(s)?, at.on(t)?))
    }

    /// A place where two branches that come near one another have ended.
    fn hole(
        &self,
        inputs: &mut [f64],
        middle: &Sample,
        between: [f64; 2],
        [s, t]: &[Vec<i8>; 2],
    ) -> Option<Sample> {
        let mut search = Lowest::new(between, (middle.x, self.apart(middle, [s, t])?));
        for _ in 0..DIVISIONS {
            let found = self.sample(inputs, search.next());
            let is_one = |b: &Branch| b.is_double && (b.signs == *s || b.signs == *t);
            match self.apart(&found, [s, t]) {
                Some(distance) => search.take(distance),
                // Further on into the hole roots are less real.
                None if found.branches.iter().any(is_one) => {
                    search.take(-found.gaps.iter().copied().fold(f64::INFINITY, f64::min));
                }
                None => return Some(found),
            }
        }
        None
    }

    /// True if a branch has moved far, or has come to an end.
    fn is_rough(&self, a: &Sample, b: &Sample) -> bool {
        let moved = |s: &Branch| match b.on(&s.signs) {
            Some(p) => self.space.distance(&s.q, p) > APART,
            None => true,
        };
        a.branches.iter().any(moved) || b.branches.iter().any(|s| a.on(&s.signs).is_none())
    }

    /// The last place of a branch between one where it exists and one where it does not.
    fn end(&self, inputs: &mut [f64], signs: &[i8], inside: f64, outside: f64, turn: f64) -> Option<Point> {
        let (mut inside, mut outside) = (inside, outside);
        let mut last = None;
        for _ in 0..60 {
            let middle = (inside + outside) / 2.0;
            if middle == inside || middle == outside {
                break;
            }
            match self.on(inputs, signs, middle, SHARP) {
                Some(q) => (inside, last) = (middle, Some(q)),
                None => outside = middle,
            }
        }
        last.map(|q| (inside + turn, excess(&self.ranges, &q)))
    }
}

/// True if a distance that is least at the middle one of three places may come down to 0 between them: its square is
/// nearly a parabola where two roots meet, and has its lowest point there.
fn comes_down(distances: [f64; 3]) -> bool {
    let [before, middle, after] = distances.map(|x| x * x);
    let bend = before + after - 2.0 * middle;
    middle - (after - before).powi(2) / (8.0 * bend) <= 0.05 * (before + after)
}

/// The search for the lowest point of a function between two places: the larger side of the best is divided.
struct Lowest {
    between: [f64; 2],
    best: (f64, f64),
    tried: f64,
}

impl Lowest {
    fn new(between: [f64; 2], best: (f64, f64)) -> Self {
        Lowest { between, best, tried: best.0 }
    }

    /// Where the function is wanted.
    fn next(&mut self) -> f64 {
        let [low, high] = self.between;
        let (x, _) = self.best;
        let side = if x - low > high - x { low - x } else { high - x };
        self.tried = x + 0.38 * side;
        self.tried
    }

    /// Its value there.
    fn take(&mut self, value: f64) {
        let is_left = self.tried < self.best.0;
        let ends = usize::from(!is_left);
        if value < self.best.1 {
            self.between[1 - ends] = self.best.0;
            self.best = (self.tried, value);
        } else {
            self.between[ends] = self.tried;
        }
    }
}

/// What a branch is called.
fn branch(labels: &[Option<Label>], signs: &[i8]) -> branch::Branch {
    branch::Branch::of_signs(labels.iter().copied(), signs)
}

/// On a circle cut at ±π, the parts at its two ends are one.
fn join_round(parts: &mut Vec<[f64; 2]>) {
    if parts.len() > 1 && parts[0][0] == -PI && parts[parts.len() - 1][1] == PI {
        let [_, end] = parts.remove(0);
        if let Some(last) = parts.last_mut() {
            last[1] = end + TAU;
        }
    }
}

const BASES: [usize; 4] = [2, 3, 5, 7];

/// The radical inverse: values that fill (0, 1) evenly, whatever their number (van der Corput 1935; Halton 1960).
pub(super) fn radical(mut number: usize, base: usize) -> f64 {
    let (mut x, mut digit) = (0.0, 1.0);
    while number > 0 {
        digit /= base as f64;
        x += digit * (number % base) as f64;
        number /= base;
    }
    x
}
