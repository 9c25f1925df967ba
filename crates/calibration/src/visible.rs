//! What a kind of measurement can show of an arm, by its structure.
//!
//! An error that commutes with a joint slides through it: exp(ξ)·J(q) = J(q)·exp(ξ) for the turn about and the shift along a
//! joint that turns, for all shifts and the turn about the direction of one that slides. So (ξ, −Ad(C⁻¹) ξ) at the links before
//! and behind it is a null vector of every measurement, exactly, and a pose shows at most 6(n + 1) − 2R − 4P = 4R + 2P + 6
//! numbers. Other measurements have null vectors of their own: the turn of a point, the whole arm moved with what stands beside
//! it, all lengths scaled. What is left is a minimal set. A rank in numbers is the bound from the other side.
//!
//! Everett, Driels and Mooring (1987) and Hollerbach and Wampler (1996) have the number 4R + 2P + 6.

use crate::linear::{dot, null_vectors, singular};
use crate::measurement::{Bar, Fixture, Measurement};
use crate::model::{Parameter, Problem, adjoint, frame_along};
use denavit::geometry::{Axis, Transform, Vector};
use denavit_recording::Arm;

/// Singular values below this part of the largest are zero; columns have length 1.
const ZERO: f64 = 1e-9;
/// Entries of null vectors below this are zero.
const NOTHING: f64 = 1e-9;

/// Why a combination of errors is not seen.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Cause {
    /// It commutes with an axis, and slides from before it to behind it: the axis, and the turn or shift.
    Slide(usize, bool, Axis),
    /// A point has no turn.
    Point(Axis),
    /// The point is on the last axis, and stays there.
    OnAxis(Axis),
    /// An orientation shows no length.
    Length(usize, Axis),
    /// The whole arm is moved with what stands beside it.
    Everything(bool, Axis),
    /// All lengths are scaled.
    Scale,
    /// A gain moves nothing that is measured.
    Gain(usize),
    /// It was found in numbers.
    Found,
}

/// A combination of errors that is not seen.
#[derive(Clone, PartialEq, Debug)]
pub struct Null {
    /// Its entries, in the order of the parameters.
    pub vector: Vec<f64>,
    /// Why.
    pub cause: Cause,
}

/// What is seen.
#[derive(Clone, Debug)]
pub struct Visible {
    /// All parameters.
    pub parameters: Vec<Parameter>,
    /// The combinations that no configuration shows.
    pub null: Vec<Null>,
    /// The same ones, each with the parameter that it takes away: 1 there, and 0 in all others.
    reduced: Vec<(usize, Vec<f64>)>,
    /// The parameters that are left: a minimal set of all that is seen.
    pub kept: Vec<usize>,
    /// The rank in numbers.
    pub rank: usize,
    /// The last singular value that is not zero and the first that is, in parts of the largest.
    pub gap: [f64; 2],
    /// The most that a null vector of length 1 moves what is measured.
    pub annihilates: f64,
}

impl Visible {
    /// An error with what is not seen taken away: its only entries are at the kept parameters.
    #[must_use]
    pub fn reduced(&self, mut vector: Vec<f64>) -> Vec<f64> {
        for (pivot, null) in &self.reduced {
            let by = vector[*pivot];
            if by != 0.0 {
                vector.iter_mut().zip(null).for_each(|(x, y)| *x -= by * y);
                vector[*pivot] = 0.0;
            }
        }
        vector
    }

    /// Where nothing says how long anything is: the length that stands for the scale, held at what the table says, and the
    /// kept parameters that are what they are with it only.
    pub fn scaled(&self) -> Option<(usize, Vec<usize>)> {
        let (_, (pivot, vector)) =
            self.null.iter().zip(&self.reduced).find(|(n, _)| n.cause == Cause::Scale)?;
        let with = self.kept.iter().copied().filter(|&k| vector[k].abs() > NOTHING);
        Some((*pivot, with.collect()))
    }

    /// How many of the null vectors were found in numbers alone.
    pub fn found(&self) -> usize {
        self.null.iter().filter(|n| n.cause == Cause::Found).count()
    }
}

/// How many numbers a measurement shows of an arm with so many turns and slides, by the structure: the point off the last axis.
/// Things beside the arm count.
pub fn formula(measurement: Measurement, turns: usize, slides: usize) -> usize {
    let arm = 4 * turns + 2 * slides;
    match measurement {
        Measurement::Pose => arm + 6,
        Measurement::Position => arm + 3,
        Measurement::Orientation => 2 * turns + 3,
        Measurement::Distance(Bar::Measured | Bar::Fixed) => arm,
        Measurement::Distance(Bar::Offset) => arm + 1,
        // All lengths may be scaled where nothing slides.
        Measurement::Distance(Bar::FixedUnknown) => arm + usize::from(slides > 0),
        Measurement::Plane => arm - usize::from(slides == 0),
    }
}

/// What is seen of an arm.
pub fn visible(problem: &Problem) -> Visible {
    let parameters = problem.parameters();
    let mut basis = Basis::new(parameters.len(), problem.of_arm());
    slides(problem, &mut basis);
    ends(problem, &mut basis);
    beside(problem, &mut basis);
    let mut rank = rank_of(problem, &basis);
    if rank.values < basis.kept().len() {
        for v in rank.null {
            basis.add(v, Cause::Found, None);
        }
        rank.null = vec![];
    }
    Visible {
        kept: basis.kept(),
        parameters,
        null: basis.null,
        reduced: basis.reduced,
        rank: rank.values,
        gap: rank.gap,
        annihilates: rank.annihilates,
    }
}

/// Null vectors, and what they take away.
struct Basis {
    count: usize,
    /// Parameters from here on are of things beside the arm.
    of_arm: usize,
    null: Vec<Null>,
    reduced: Vec<(usize, Vec<f64>)>,
}

impl Basis {
    fn new(count: usize, of_arm: usize) -> Self {
        Basis { count, of_arm, null: vec![], reduced: vec![] }
    }

    /// Adds a null vector, unless it is a sum of those that there are. It takes one of these away if one is given, else what it
    /// is largest in.
    fn add(&mut self, vector: Vec<f64>, cause: Cause, wanted: Option<&[usize]>) {
        let mut rest = vector.clone();
        for (pivot, null) in &self.reduced {
            let by = rest[*pivot];
            if by != 0.0 {
                rest.iter_mut().zip(null).for_each(|(x, y)| *x -= by * y);
                rest[*pivot] = 0.0;
            }
        }
        let largest = |from: &mut dyn Iterator<Item = usize>| {
            let best = from.max_by(|&i, &j| rest[i].abs().total_cmp(&rest[j].abs()));
            best.filter(|&i| rest[i].abs() > NOTHING)
        };
        let pivot = wanted
            .and_then(|w| largest(&mut w.iter().copied()))
            .or_else(|| largest(&mut (0..self.of_arm)))
            .or_else(|| largest(&mut (self.of_arm..self.count)));
        let Some(pivot) = pivot else { return };
        let by = rest[pivot];
        rest.iter_mut().for_each(|x| *x /= by);
        rest[pivot] = 1.0;
        for (_, other) in &mut self.reduced {
            let by = other[pivot];
            if by != 0.0 {
                other.iter_mut().zip(&rest).for_each(|(x, y)| *x -= by * y);
                other[pivot] = 0.0;
            }
        }
        self.reduced.push((pivot, rest));
        self.null.push(Null { vector, cause });
    }

    fn kept(&self) -> Vec<usize> {
        (0..self.count).filter(|k| self.reduced.iter().all(|r| r.0 != *k)).collect()
    }
}

/// What a number of a link's twist is called: turns 0 to 2, shifts 3 to 5.
fn unit(i: usize) -> [f64; 6] {
    std::array::from_fn(|k| f64::from(u8::from(i == k)))
}

/// Errors that slide through axes.
fn slides(problem: &Problem, basis: &mut Basis) {
    let is_turn_alone = problem.measurement == Measurement::Orientation;
    if is_turn_alone {
        for k in 0..=problem.last() {
            for axis in Axis::ALL {
                let at = 6 * k + 3 + axis.index();
                let mut v = vec![0.0; basis.count];
                v[at] = 1.0;
                basis.add(v, Cause::Length(k, axis), Some(&[at]));
            }
        }
    }
    for (k, axis) in problem.arm.moving.iter().enumerate() {
        let passing: &[usize] = match (axis.turns, is_turn_alone) {
            (true, _) => &[2, 5],
            (false, false) => &[2, 3, 4, 5],
            // Only its turns count, and all of them pass.
            (false, true) => &[0, 1, 2],
        };
        let back = problem.constants[k + 1].inverse();
        for &i in passing {
            let mut v = vec![0.0; basis.count];
            v[6 * k + i] = 1.0;
            for (c, x) in adjoint(&back, &unit(i)).into_iter().enumerate() {
                v[6 * (k + 1) + c] = -x;
            }
            basis.add(v, Cause::Slide(k, i < 3, Axis::ALL[i % 3]), Some(&[6 * k + i]));
        }
    }
}

/// What a point does not show, and a turn.
fn ends(problem: &Problem, basis: &mut Basis) {
    let last = problem.last();
    let drives = |j: usize, wanted: &dyn Fn(usize) -> bool| {
        let moved = |k: &usize| problem.arm.moving[*k].terms.iter().any(|t| t.0 == j);
        (0..last).filter(moved).all(wanted)
    };
    let mut gains = vec![];
    if problem.measurement == Measurement::Orientation {
        gains.extend((0..problem.arm.joints()).filter(|&j| drives(j, &|k| !problem.arm.moving[k].turns)));
    }
    if problem.measurement.is_of_point() {
        for axis in Axis::ALL {
            let at = 6 * last + axis.index();
            let mut v = vec![0.0; basis.count];
            v[at] = 1.0;
            basis.add(v, Cause::Point(axis), Some(&[at]));
        }
        let t = problem.constants[last].translation;
        let is_on_axis = problem.arm.moving.last().is_some_and(|a| a.turns)
            && t[0].hypot(t[1]) < 1e-12 * (1.0 + t[2].abs());
        if is_on_axis {
            for axis in [Axis::X, Axis::Y] {
                // The point at (0, 0, h) stays: v = −ω × (0, 0, h).
                let w: Vector<f64> = Vector::unit(axis);
                let by = -w.cross(Vector([0.0, 0.0, t[2]]));
                let at = 6 * (last - 1);
                let mut v = vec![0.0; basis.count];
                v[at..at + 3].copy_from_slice(&w.0);
                v[at + 3..at + 6].copy_from_slice(&by.0);
                basis.add(v, Cause::OnAxis(axis), Some(&[at + axis.index()]));
            }
            gains.extend((0..problem.arm.joints()).filter(|&j| drives(j, &|k| k + 1 == last)));
        }
    }
    for j in gains.into_iter().filter(|_| problem.gains) {
        let mut v = vec![0.0; basis.count];
        v[problem.of_links() + j] = 1.0;
        basis.add(v, Cause::Gain(j), Some(&[problem.of_links() + j]));
    }
}

/// What does not change where the arm stands to the things beside it.
fn beside(problem: &Problem, basis: &mut Basis) {
    if problem.fixtures.is_empty() {
        return;
    }
    let back = problem.constants[0].inverse();
    let first: Vec<usize> = (0..6).collect();
    for i in [3, 4, 5, 0, 1, 2] {
        let twist = unit(i);
        let mut v = vec![0.0; basis.count];
        v[..6].copy_from_slice(&adjoint(&back, &twist));
        for (f, fixture) in problem.fixtures.iter().enumerate() {
            v[problem.of_fixture(f)].copy_from_slice(&fixture.carried(problem.measurement, &twist));
        }
        basis.add(v, Cause::Everything(i < 3, Axis::ALL[i % 3]), Some(&first));
    }
    if let Some(v) = scaled(problem, basis.count) {
        basis.add(v, Cause::Scale, None);
    }
}

/// All lengths scaled about the origin of the base, where nothing that is measured says how long they are.
fn scaled(problem: &Problem, count: usize) -> Option<Vec<f64>> {
    let measurement = problem.measurement;
    if !matches!(measurement, Measurement::Plane | Measurement::Distance(Bar::FixedUnknown)) {
        return None;
    }
    let mut v = vec![0.0; count];
    for (k, c) in problem.constants.iter().enumerate() {
        // t + R v = s t
        let by = c.rotation.inverse() * c.translation;
        v[6 * k + 3..6 * k + 6].copy_from_slice(&by.0);
    }
    for j in 0..problem.arm.joints() {
        let of_joint = || problem.arm.moving.iter().filter(|a| a.terms.iter().any(|t| t.0 == j));
        match (of_joint().any(|a| !a.turns), of_joint().any(|a| a.turns)) {
            (false, _) => {}
            (true, false) if problem.gains => v[problem.of_links() + j] = 1.0,
            _ => return None,
        }
    }
    for (f, fixture) in problem.fixtures.iter().enumerate() {
        let (c, places) = (fixture.frame.translation, problem.of_fixture(f));
        let own = match measurement {
            Measurement::Plane => vec![0.0, 0.0, fixture.frame.rotation.z().dot(c)],
            _ => vec![c[0], c[1], c[2], fixture.length],
        };
        v[places].copy_from_slice(&own);
    }
    Some(v)
}

/// A rank in numbers.
struct Rank {
    values: usize,
    gap: [f64; 2],
    annihilates: f64,
    /// Null vectors beside those of the basis.
    null: Vec<Vec<f64>>,
}

/// The rank of the kept parameters at configurations at random.
fn rank_of(problem: &Problem, basis: &Basis) -> Rank {
    let kept = basis.kept();
    let state = problem.nominal();
    let constants = problem.constants_at(&state);
    let width = problem.measurement.width();
    let groups = problem.fixtures.len().max(1);
    let count = (4 * basis.count).div_ceil(width).max(40) * if width == 1 { 2 } else { 1 };
    let (mut columns, mut annihilates) = (vec![vec![]; kept.len()], 0.0_f64);
    let samples = (0..groups).flat_map(|g| {
        problem.samples_on(g, count.div_ceil(groups), 1 + g as u64).into_iter().map(move |q| (g, q))
    });
    for (group, q) in samples {
        let (_, rows) = problem.derivatives(&state, &constants, &q, group);
        for row in rows {
            for null in &basis.null {
                let size = dot(&null.vector, &null.vector).sqrt();
                annihilates = annihilates.max(dot(&row, &null.vector).abs() / size);
            }
            columns.iter_mut().zip(&kept).for_each(|(c, &k)| c.push(row[k]));
        }
    }
    let sizes: Vec<f64> = columns.iter().map(|c| dot(c, c).sqrt()).collect();
    for (c, size) in columns.iter_mut().zip(&sizes) {
        c.iter_mut().for_each(|x| *x /= size.max(1e-12));
    }
    let found = singular(&columns);
    let largest = found.values.first().copied().unwrap_or(0.0).max(1e-300);
    let values = found.values.iter().filter(|v| **v > ZERO * largest).count();
    let at = |k: usize| found.values.get(k).map_or(0.0, |v| v / largest);
    let null = if values < kept.len() {
        // The complement of the null space is spanned by the other vectors: null vectors of these rows are sparse.
        let rows: Vec<Vec<f64>> =
            (0..kept.len()).map(|k| found.vectors[..values].iter().map(|v| v[k]).collect()).collect();
        let whole = |n: Vec<f64>| {
            let mut v = vec![0.0; basis.count];
            n.iter().zip(&kept).zip(&sizes).for_each(|((x, &k), size)| v[k] = x / size.max(1e-12));
            v
        };
        null_vectors(&rows, 1e-7).into_iter().map(whole).collect()
    } else {
        vec![]
    };
    Rank { values, gap: [at(values.saturating_sub(1)), at(values)], annihilates, null }
}

/// Where a plane or a centre may stand that the arm reaches well.
pub fn supposed(arm: &Arm, measurement: Measurement, point: Vector<f64>, count: usize) -> Vec<Fixture> {
    if measurement.of_fixture() == 0 {
        return vec![];
    }
    let problem = Problem::new(arm, Measurement::Position, point, false, vec![]);
    let middle: Vec<f64> = arm.limits.iter().map(|[low, high]| low + 0.6 * (high - low)).collect();
    let reach = |q: &[f64]| problem.arm.pose_with(&problem.constants, q).translation;
    let poses = problem.samples(60 + count, 3);
    // The point among them that is nearest to the middle of all.
    let mean = poses.iter().fold(Vector::zero(), |a, q| a + reach(q)).scale(1.0 / poses.len().max(1) as f64);
    let far = poses.iter().map(|q| (reach(q) - mean).norm()).fold(0.0, f64::max).max(0.1);
    let normals = [[0.3, -0.5, 0.81], [0.9, 0.2, -0.4], [-0.2, 0.8, 0.5]];
    let of = |f: usize| {
        let normal = normals[f % 3];
        let frame = frame_along(Vector(normal), reach(&middle).scale(0.3) + mean.scale(0.7));
        let by = frame.rotation.x().scale(0.2 * far * f as f64);
        let at = frame.translation + by;
        let fixed = matches!(measurement, Measurement::Distance(Bar::Fixed | Bar::FixedUnknown));
        let frame = Transform::from_rotation_translation(frame.rotation, at);
        Fixture { frame, length: if fixed { 0.6 * far } else { 0.0 } }
    };
    (0..count.max(1)).map(of).collect()
}
