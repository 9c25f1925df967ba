//! Whether the roots of a split are all accounted for by accepted configurations (discs of Smith 1970).
//!
//! The union of the discs holds the roots of every polynomial that differs from the computed one by its noise. A disc
//! that does not reach the circle holds no real angle; each one that does must belong to a configuration of its own.

use crate::{candidate::Found, chart::Chart, roots::Roots};

/// What the discs say about the configurations known so far.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Each disc on the circle has its configuration, and each configuration its disc.
    Certified,
    /// Discs without configuration come in pairs that overlap: about to be real, or just not any more.
    Pairs,
    /// Anything else.
    Uncertain,
}

/// A disc belongs to a configuration within this many radii,
const REACH: f64 = 3.0;
/// or within this distance.
const CLOSE: f64 = 1e-7;

/// Compares the discs in a chart with the configurations for which the chart answers; the angles at which something does
/// not fit are marked. `hidden` is the joint whose angles the roots are, times `sign`. A root with a negative radius is known
/// to belong to no configuration.
pub(crate) fn verdict<const GROUPS: usize>(
    hidden: usize,
    sign: f64,
    chart: &Chart,
    roots: &Roots<GROUPS>,
    found: &[Found],
    marks: &mut Marks,
) -> Verdict {
    marks.count = 0;
    let at = |k: usize| (roots.re[k / 8].0[k % 8], roots.im[k / 8].0[k % 8], roots.radius[k / 8].0[k % 8]);
    let mut open = [false; 24];
    let mut reaching = 0;
    for (k, open) in open.iter_mut().enumerate().take(roots.count) {
        let (x, y, r) = at(k);
        let modulus = (x * x + y * y).sqrt();
        // Also where the radius is not a number.
        let off = (modulus - 1.0).abs() > r;
        *open = !off && chart.answers_for(x / modulus);
        reaching += usize::from(*open);
    }
    let all = open;
    let (mut strangers, mut inside) = (0, 0);
    for solution in found {
        let [c, s] = solution.values[hidden];
        let [c, s] = chart.inside([c, s * sign]);
        if !chart.answers_for(c) {
            continue;
        }
        inside += 1;
        let (mut nearest, mut least) = (24, f64::INFINITY);
        for k in 0..roots.count {
            let (x, y, r) = at(k);
            let away = ((x - c) * (x - c) + (y - s) * (y - s)).sqrt();
            let reach = if REACH * r < CLOSE { CLOSE } else { REACH * r };
            if open[k] && away < least && (away <= reach || r.is_nan()) {
                (nearest, least) = (k, away);
            }
        }
        if nearest < 24 {
            open[nearest] = false;
            reaching -= 1;
        } else {
            strangers += 1;
            marks.add(s.atan2(c), true);
        }
    }
    if strangers == 0 && reaching == 0 {
        return Verdict::Certified;
    }
    let mut pairs = strangers == 0 && (inside + reaching).is_multiple_of(2);
    for k in 0..roots.count {
        if !all[k] {
            continue;
        }
        let (x, y, r) = at(k);
        // A large disc says that its root may be anywhere near.
        marks.add(y.atan2(x), open[k] || r >= VAGUE || r.is_nan());
        pairs = pairs
            && (!open[k]
                || r < PAIR
                    && (0..roots.count).any(|j| {
                        let (u, v, other) = at(j);
                        j != k && all[j] && ((x - u) * (x - u) + (y - v) * (y - v)).sqrt() <= r + other
                    }));
    }
    if pairs { Verdict::Pairs } else { Verdict::Uncertain }
}

/// A disc with a radius larger than this tells little about where its root is.
const VAGUE: f64 = 1e-2;
/// Largest disc of a root that may be half of a double one.
const PAIR: f64 = 0.02;

/// Angles in a chart, and which of them do not fit.
#[derive(Clone, Debug)]
pub(crate) struct Marks {
    pub count: usize,
    pub angles: [f64; 48],
    pub marked: [bool; 48],
}

impl Default for Marks {
    fn default() -> Marks {
        Marks { count: 0, angles: [0.0; 48], marked: [false; 48] }
    }
}

impl Marks {
    /// Adds an angle in its place.
    fn add(&mut self, angle: f64, marked: bool) {
        if self.count == self.angles.len() {
            return;
        }
        let mut at = self.count;
        while at > 0 && self.angles[at - 1] > angle {
            self.angles[at] = self.angles[at - 1];
            self.marked[at] = self.marked[at - 1];
            at -= 1;
        }
        self.angles[at] = angle;
        self.marked[at] = marked;
        self.count += 1;
    }
}
