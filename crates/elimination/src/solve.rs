//! The solver: one split of the loop after the other, until one certifies that nothing is missing.

use crate::{
    answer::{Answer, Certificate, Solution},
    arm::{Arm, Joint},
    candidate::{ACCEPTED, Candidate, Found, add, gather, lane},
    certificate::{Verdict, verdict},
    chart::Chart,
    charts::{self, Charts, NEARBY, TOGETHER, near_roots, noise},
    determinant::{DEGREE, determinant},
    eigen::SHARED,
    eliminate::eliminate,
    extract::{SMALL, UNKNOWNS, null_vectors, shared},
    fourier::{Fourier, USELESS},
    instructions::{Compute, Instructions, part},
    lanes::{Lanes, WIDTH},
    newton::{polish, smallest_singular_values},
    remaining::{First, complete},
    rigid::Rigid,
    slides::{Sliding, solve_sliding},
    split::Split,
    triple::{Triple, solve_triple},
    wide_roots::{self, wide_candidates, wide_verdict},
    work::Work,
};

/// Smallest singular value below which a configuration counts as double.
const SINGULAR: f64 = 1e-6;
/// Bound of the second derivative of the pose, lengths divided by the arm's size.
const CURVATURE: f64 = 20.0;

/// The constants of a solver: everything that does not depend on the pose.
#[derive(Clone, Debug)]
pub(crate) struct Constants {
    /// The arm, lengths divided by its size.
    pub arm: Arm,
    /// The arm's size.
    pub size: f64,
    /// Nodes and transform.
    pub fourier: Fourier<3>,
    /// The same for the wider matrix.
    pub wide: Fourier<4>,
}

/// Solves one split, by the 12 × 12 matrix or by the wider one, and adds what it finds to `work.found`.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn solve_split<I: Instructions>(
    constants: &Constants,
    split: &Split,
    wide: bool,
    target: &Rigid,
    work: &mut Work,
) -> Verdict {
    let arm = &constants.arm;
    let closing = arm.links[5].then(&target.inverse()).then(&arm.base);
    eliminate::<I>(split, &closing, &mut work.eliminated);
    if wide {
        work.matrix.fill(&work.eliminated, split);
    }
    let mut charts = Charts::whole(if wide { wide_roots::DEEPEST } else { charts::DEEPEST });
    while let Some(chart) = charts.next() {
        let verdict = solve_chart::<I>(constants, split, wide, target, &chart, work);
        charts.settle::<I>(&chart, verdict, work);
    }
    charts.verdict(work)
}

/// Finds the roots that a chart shows, and the configurations that belong to them.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn solve_chart<I: Instructions>(
    constants: &Constants,
    split: &Split,
    wide: bool,
    target: &Rigid,
    chart: &Chart,
    work: &mut Work,
) -> Verdict {
    work.marks.count = 0;
    let is_useful = if wide {
        wide_candidates(&constants.wide, split, chart, work)
    } else {
        narrow_candidates::<I>(constants, split, chart, work)
    };
    if !is_useful {
        return Verdict::Uncertain;
    }
    accept::<I>(&constants.arm, split, target, work);
    let (hidden, sign) = (split.joints[2], split.sign);
    if wide {
        wide_verdict(hidden, sign, chart, work)
    } else {
        verdict(hidden, sign, chart, &work.roots, &work.found, &mut work.marks)
    }
}

/// Finds the roots that a chart shows, and what may belong to them; false if the samples are of no use.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn narrow_candidates<I: Instructions>(
    constants: &Constants,
    split: &Split,
    chart: &Chart,
    work: &mut Work,
) -> bool {
    let (multiplied, _) = split.multiplied_and_other();
    let mut samples = [Lanes::ZERO; 3];
    for (g, sample) in samples.iter_mut().enumerate() {
        let [c, s, weight] = chart.nodes::<I>(constants.fourier.cosines[g], constants.fourier.sines[g]);
        let square = weight.times(weight);
        let square = square.times(square);
        *sample = determinant::<I>(&work.eliminated.rows, multiplied, c, s).times(square.times(square));
    }
    let useful = constants.fourier.fit::<I>(DEGREE, &samples, &mut work.polynomial);
    if !useful || work.polynomial.noise > USELESS {
        return false;
    }
    work.roots.find::<I>(&work.polynomial, noise(&work.polynomial));

    let mut near = [([0.0; 2], false); NEARBY];
    let count = near_roots(chart, &work.roots, &mut near);
    candidates::<I>(split, &near[..count], work);
    true
}

/// Adds the null vectors at the given cosines and sines of the hidden joint to the candidates.
///
/// Where several configurations share a root, the middles of close roots are exact: they serve instead of the roots.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn candidates<I: Instructions>(split: &Split, near: &[([f64; 2], bool)], work: &mut Work) {
    work.candidates.clear();
    let (multiplied, _) = split.multiplied_and_other();
    let mut small = [0.0; NEARBY];
    for (g, group) in near.chunks(WIDTH).enumerate() {
        let [c, s] = gather(group, |(pair, _)| *pair);
        let mut x = [Lanes::ZERO; UNKNOWNS];
        let pivots = null_vectors::<I>(&work.eliminated.rows, multiplied, c, s, &mut x);
        for (l, (pair, _)) in group.iter().enumerate() {
            let mut vector = [0.0; UNKNOWNS];
            for (entry, x) in vector.iter_mut().zip(&x) {
                *entry = x.0[l];
            }
            small[8 * g + l] = pivots.0[l];
            work.candidates.push(Candidate { hidden: *pair, x: vector });
        }
    }
    let mut kept = 0;
    for k in 0..near.len() {
        let ([c, s], middle) = near[k];
        let together = |j: usize| (near[j].0[0] - c).abs() + (near[j].0[1] - s).abs() < 2.0 * TOGETHER;
        let shared_here = small[k] <= SMALL || small[k].is_nan();
        let replaced = !middle && (0..near.len()).any(|j| near[j].1 && small[j] <= SMALL && together(j));
        if replaced || (middle && !shared_here) {
            continue;
        }
        let own = work.candidates[k];
        work.candidates[kept] = own;
        kept += 1;
        if shared_here {
            let mut vectors = [[0.0; UNKNOWNS]; SHARED];
            let found = shared(&work.eliminated.rows, multiplied, c, s, &mut vectors);
            for x in &vectors[..found] {
                work.candidates.push(Candidate { hidden: [c, s], x: *x });
            }
        }
    }
    // Close the gap between those kept and those added.
    let added = near.len();
    let mut to = kept;
    for from in added..work.candidates.len() {
        work.candidates[to] = work.candidates[from];
        to += 1;
    }
    work.candidates.truncate(to);
}

/// Completes and polishes the candidates, and keeps those that reach the pose and are new.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn accept<I: Instructions>(arm: &Arm, split: &Split, target: &Rigid, work: &mut Work) {
    let first = First::new(split.kinds[0], &work.eliminated.first);
    let branches: &[f64] = if first.open.is_some() { &[1.0, -1.0] } else { &[1.0] };
    for group in work.candidates.chunks(WIDTH) {
        let hidden = gather(group, |candidate| candidate.hidden);
        let x = gather(group, |candidate| candidate.x);
        for &branch in branches {
            let mut values = [[Lanes::ZERO; 2]; 6];
            complete::<I>(split, &work.eliminated, &first, branch, &hidden, &x, &mut values);
            let residual = polish::<I>(arm, target, &mut values);
            for l in 0..group.len() {
                if residual.0[l] <= ACCEPTED {
                    let values = lane(&values, l);
                    add(arm, &mut work.found, Found { values, residual: residual.0[l] });
                }
            }
        }
    }
}

/// The ways to solve an arm, in their order.
#[derive(Clone, Debug)]
pub(crate) enum Method {
    /// At most one slide: elimination.
    Splits(Vec<Split>),
    /// Two slides: the rotations first.
    Slides(Vec<Sliding>),
    /// Three slides: in closed form.
    Triple(Box<Triple>),
}

impl Method {
    /// The ways in their order. The wider matrices last: they take ten times as long, and never vanish.
    pub fn way(&self, turn: usize) -> Option<Way<'_>> {
        match self {
            Method::Splits(splits) => {
                let wide = turn >= splits.len();
                let split = splits.get(if wide { turn - splits.len() } else { turn })?;
                Some(Way::Split { split, wide })
            }
            Method::Slides(ways) => ways.get(turn).map(Way::Slides),
            Method::Triple(triple) => (turn == 0).then_some(Way::Triple(triple)),
        }
    }
}

/// A way to solve a pose.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Way<'a> {
    /// By the 12 × 12 matrix of a split, or by the wider one.
    Split { split: &'a Split, wide: bool },
    /// By a ring of four turns.
    Slides(&'a Sliding),
    /// In closed form.
    Triple(&'a Triple),
}

impl Way<'_> {
    /// Whether it is by a wider matrix.
    pub fn is_wide(&self) -> bool {
        matches!(self, Way::Split { wide: true, .. })
    }

    /// The hidden joint (0 to 5).
    pub fn hidden(self) -> usize {
        match self {
            Way::Split { split, .. } => split.joints[2],
            Way::Slides(way) => way.turns[0],
            Way::Triple(triple) => triple.turns[0],
        }
    }
}

/// What is done at a pose.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Task<'a> {
    /// One way after the other until one certifies the answer, which is reported.
    Answer(&'a Method),
    /// One way only, to see what it finds.
    Trial(Way<'a>),
}

impl<'a> Task<'a> {
    fn way(self, turn: usize) -> Option<Way<'a>> {
        match self {
            Task::Answer(method) => method.way(turn),
            Task::Trial(way) => (turn == 0).then_some(way),
        }
    }
}

part! {
    /// Does a task at a pose, lengths divided by the arm's size: the last verdict. What is no part of its own is compiled
    /// into each function that calls this, for its instructions: there is one for each set of instructions.
    pub(crate) fn solve<I>(
        constants: &Constants,
        task: Task<'_>,
        target: &Rigid,
        answer: &mut Answer,
    ) -> Verdict {
        let work = &mut answer.work;
        work.found.clear();
        let mut turn = 0;
        let mut last = Verdict::Uncertain;
        while let Some(way) = task.way(turn) {
            if last == Verdict::Certified || last == Verdict::Pairs && way.is_wide() {
                break;
            }
            last = match way {
                Way::Split { split, wide } => solve_split::<I>(constants, split, wide, target, work),
                Way::Slides(way) => solve_sliding::<I>(&constants.arm, way, target, work),
                Way::Triple(triple) => solve_triple::<I>(&constants.arm, triple, target, work),
            };
            turn += 1;
        }
        answer.splits = turn as u32;
        if matches!(task, Task::Answer(_)) {
            report::<I>(constants, last, answer);
        }
        last
    }
}

/// Turns what was found into solutions, with their singular values.
#[inline(always)]
fn report<I: Instructions>(constants: &Constants, last: Verdict, answer: &mut Answer) {
    answer.solutions.clear();
    let mut all_isolated = true;
    for group in answer.work.found.chunks(WIDTH) {
        let flat: [Lanes; 12] = gather(group, |found| {
            let mut flat = [0.0; 12];
            for (pair, value) in flat.chunks_exact_mut(2).zip(&found.values) {
                pair.copy_from_slice(value);
            }
            flat
        });
        let mut values = [[Lanes::ZERO; 2]; 6];
        for (i, value) in values.iter_mut().enumerate() {
            *value = [flat[2 * i], flat[2 * i + 1]];
        }
        let singular = smallest_singular_values::<I>(&constants.arm, &values);
        for (l, found) in group.iter().enumerate() {
            let mut q = [0.0; 6];
            for (i, q) in q.iter_mut().enumerate() {
                let [c, s] = found.values[i];
                *q = match constants.arm.joints[i] {
                    Joint::Revolute => {
                        let angle = s.atan2(c);
                        if angle <= -std::f64::consts::PI { std::f64::consts::PI } else { angle }
                    }
                    Joint::Prismatic => c * constants.size,
                };
            }
            let singular = if singular.0[l].is_finite() { singular.0[l] } else { 0.0 };
            // Newton and Kantorovich: a root of its own lies near if 2 K residual ≤ σ², K bounds the second derivative.
            let isolated = singular > SINGULAR && 2.0 * CURVATURE * found.residual <= singular * singular;
            all_isolated = all_isolated && isolated;
            let multiplicity = if singular < SINGULAR { 2 } else { 1 };
            answer.solutions.push(Solution { q, residual: found.residual, singular, multiplicity });
        }
    }
    answer.certificate = match last {
        _ if !all_isolated => Certificate::NearDoubleRoot,
        Verdict::Certified => Certificate::Complete,
        Verdict::Pairs => Certificate::NearDoubleRoot,
        Verdict::Uncertain => Certificate::Undecided,
    };
}
