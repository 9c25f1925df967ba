//! Which charts of the circle a way to solve goes through, and which of their roots are tried.

use crate::{
    certificate::Verdict,
    chart::{Chart, crowds},
    fourier::Trigonometric,
    instructions::Instructions,
    roots::Roots,
    work::Work,
};

/// Most charts of a split.
const CHARTS: usize = 12;
/// A value larger than this many times the noise is not zero.
const CLEAR: f64 = 2.0;
/// How deep charts are taken of parts of charts.
pub(crate) const DEEPEST: u32 = 4;
/// Roots of the whole circle closer than this (rad) may be one that several configurations share.
pub(crate) const TOGETHER: f64 = 3e-4;
/// Roots within this distance of the circle are tried as real angles: noise moves a double root by its square root.
pub(crate) const NEAR: f64 = 0.02;
/// Least noise of the polynomial that the discs allow for.
const NOISE: f64 = 2e-14;

/// The chart of the whole circle first, then charts of the arcs where something does not fit.
pub(crate) struct Charts {
    list: [Chart; CHARTS],
    done: usize,
    count: usize,
    depth: u32,
    total: Verdict,
}

impl Charts {
    /// The whole circle, parts to be taken up to a depth.
    pub fn whole(depth: u32) -> Charts {
        Charts { list: [Chart::WHOLE; CHARTS], done: 0, count: 1, depth, total: Verdict::Certified }
    }

    /// The next chart to solve in.
    pub fn next(&mut self) -> Option<Chart> {
        if self.done == self.count {
            return None;
        }
        self.done += 1;
        Some(self.list[self.done - 1])
    }

    /// Takes the verdict in a chart, with the marks and the polynomial that it left in `work`, and adds charts of the arcs
    /// in question.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub fn settle<I: Instructions>(&mut self, chart: &Chart, verdict: Verdict, work: &mut Work) {
        if self.done == 1 {
            work.effort = 0;
        }
        work.effort += 8 + work.candidates.len();
        if verdict == Verdict::Certified {
            return;
        }
        let mut arcs = [(0.0, 0.0); 8];
        let (marks, n) = (&work.marks, work.marks.count);
        let threshold = CLEAR * noise(&work.polynomial);
        let crowds =
            crowds::<I>(&marks.angles[..n], &marks.marked[..n], &work.polynomial, threshold, &mut arcs);
        if crowds == 0 || chart.depth == self.depth || self.count + crowds > CHARTS {
            self.total = if self.total == Verdict::Uncertain { self.total } else { verdict };
            return;
        }
        for &(centre, half_width) in &arcs[..crowds] {
            self.list[self.count] = chart.part(centre, half_width);
            self.count += 1;
        }
    }

    /// The verdict on all of them; configurations come in even numbers.
    pub fn verdict(&self, work: &Work) -> Verdict {
        let odd = !work.found.len().is_multiple_of(2);
        if self.total == Verdict::Certified && odd { Verdict::Uncertain } else { self.total }
    }
}

/// The noise that the discs allow for.
#[inline]
pub(crate) fn noise(polynomial: &Trigonometric) -> f64 {
    if 4.0 * polynomial.noise > NOISE { 4.0 * polynomial.noise } else { NOISE }
}

/// Most roots near the circle, with the middles of those that are close together.
pub(crate) const NEARBY: usize = 48;

/// The roots near the circle as cosines and sines of the hidden joint, and the middles of those that are close together
/// (marked): a root that several configurations share falls apart by the root of the noise, its middle does not.
pub(crate) fn near_roots<const GROUPS: usize>(
    chart: &Chart,
    roots: &Roots<GROUPS>,
    near: &mut [([f64; 2], bool); NEARBY],
) -> usize {
    let mut count = 0;
    for k in 0..roots.count {
        let (x, y) = (roots.re[k / 8].0[k % 8], roots.im[k / 8].0[k % 8]);
        let modulus = (x * x + y * y).sqrt();
        let (x, y) = (x / modulus, y / modulus);
        if (modulus - 1.0).abs() < NEAR && chart.answers_for(x + 0.1) {
            let mut middle = [0.0; 2];
            for ([u, v], _) in &near[..count] {
                if (x - u).abs() + (y - v).abs() < TOGETHER {
                    let (c, s) = (x + u, y + v);
                    let length = (c * c + s * s).sqrt();
                    middle = [c / length, s / length];
                }
            }
            near[count] = ([x, y], false);
            count += 1;
            if middle != [0.0; 2] {
                near[count] = (middle, true);
                count += 1;
            }
        }
    }
    for (pair, _) in &mut near[..count] {
        *pair = chart.outside(*pair);
    }
    count
}
