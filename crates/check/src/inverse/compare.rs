//! Printed values against all solutions, at samples.

use super::judgement::{Counterexample, Missing, Undecided};
use super::setting::{Sample, Setting, Unknown};
use super::tape::Tape;
use denavit_symbolic::Expr;

/// What printed values are at samples.
pub struct Comparison {
    /// For each branch and sample, whether the value is that of a solution that agrees in what is known.
    pub right: Vec<Vec<bool>>,
    /// The same, whether there is a value.
    pub finite: Vec<Vec<bool>>,
    /// For each sample whether a solution is left out.
    pub left_out: Vec<bool>,
    /// The most different right values that were printed, and that there are.
    pub most: [usize; 2],
    /// The first sample at which something is wrong.
    pub example: Option<Counterexample>,
}

/// The formulas of a comparison.
pub struct Formulas<'a> {
    pub of: &'a [Unknown],
    pub known: &'a [Unknown],
    pub branches: &'a [Vec<Expr>],
}

/// The tapes of what is found, what is known and what is printed.
struct Tapes {
    of: Tape,
    known: Tape,
    printed: Tape,
}

impl Tapes {
    fn new(setting: &Setting, formulas: &Formulas) -> Result<Self, Undecided> {
        let tape = |all: &[Expr]| setting.tape(all).map_err(Undecided::UnknownSymbol);
        let of: Vec<Expr> = formulas.of.iter().map(|u| u.formula).collect();
        let known: Vec<Expr> = formulas.known.iter().map(|u| u.formula).collect();
        Ok(Tapes { of: tape(&of)?, known: tape(&known)?, printed: tape(&formulas.branches.concat())? })
    }
}

/// A sample's printed values and those of its solutions that agree in what is known.
fn at(setting: &Setting, formulas: &Formulas, tapes: &Tapes, s: &Sample) -> [Vec<Vec<f64>>; 2] {
    let here = setting.point(&s.q, &s.entries);
    let given = tapes.known.values(&here);
    let mut right: Vec<Vec<f64>> = vec![];
    for q in std::iter::once(&s.q).chain(&s.solutions) {
        let there = setting.point(q, &s.entries);
        if !setting.near(formulas.known, &tapes.known.values(&there), &given) {
            continue;
        }
        let value = tapes.of.values(&there);
        if !right.iter().any(|r| setting.near(formulas.of, r, &value)) {
            right.push(value);
        }
    }
    let printed = tapes.printed.values(&here);
    [printed.chunks(formulas.of.len().max(1)).map(<[f64]>::to_vec).collect(), right]
}

impl Comparison {
    /// Compares at samples.
    ///
    /// # Errors
    /// A symbol that has no value.
    pub fn new(setting: &Setting, samples: &[Sample], formulas: &Formulas) -> Result<Self, Undecided> {
        let tapes = Tapes::new(setting, formulas)?;
        let n = formulas.branches.len();
        let mut this = Comparison {
            right: vec![vec![]; n],
            finite: vec![vec![]; n],
            left_out: vec![],
            most: [0, 0],
            example: None,
        };
        for s in samples {
            let [printed, right] = at(setting, formulas, &tapes, s);
            let near = |a: &[f64], b: &[f64]| setting.near(formulas.of, a, b);
            let mut is_wrong = false;
            for (k, value) in printed.iter().enumerate() {
                let is_right = right.iter().any(|r| near(r, value));
                let is_finite = value.iter().all(|x| x.is_finite());
                is_wrong |= is_finite && !is_right;
                this.right[k].push(is_right);
                this.finite[k].push(is_finite);
            }
            let given = right.iter().filter(|r| printed.iter().any(|p| near(r, p))).count();
            is_wrong |= given < right.len();
            this.left_out.push(given < right.len());
            this.most = [this.most[0].max(given), this.most[1].max(right.len())];
            if is_wrong && this.example.is_none() {
                this.example =
                    Some(Counterexample { q: s.q.clone(), pose: s.entries.clone(), printed, right });
            }
        }
        Ok(this)
    }

    /// True if the values are those of the solutions at every sample.
    pub fn is_right(&self) -> bool {
        let extra = self.right.iter().zip(&self.finite).any(|(r, f)| r.iter().zip(f).any(|(r, f)| *f && !r));
        !extra && !self.left_out.iter().any(|&x| x)
    }

    /// The share of samples at which a branch has a value that belongs to no solution.
    pub fn extra(&self, branch: usize) -> f64 {
        share(self.right[branch].iter().zip(&self.finite[branch]).map(|(r, f)| *f && !r))
    }

    pub fn missing(&self) -> Option<Missing> {
        let poses = share(self.left_out.iter().copied());
        (poses > 0.0).then_some(Missing { poses, given: self.most[0], existing: self.most[1] })
    }
}

/// The share of those that are true.
pub fn share(of: impl Iterator<Item = bool>) -> f64 {
    let (mut yes, mut all) = (0, 0);
    for x in of {
        yes += usize::from(x);
        all += 1;
    }
    f64::from(yes as u32) / f64::from(all.max(1) as u32)
}

/// A special configuration at which values that are right elsewhere are not, though the pose determines them there: the
/// configuration's own value is not among them.
pub fn fails_at(setting: &Setting, special: &[Sample], formulas: &Formulas) -> Option<Vec<f64>> {
    let tapes = Tapes::new(setting, formulas).ok()?;
    let determined = |s: &&Sample| s.motions.is_empty();
    let fails = |s: &&Sample| {
        let [printed, _] = at(setting, formulas, &tapes, s);
        let own = tapes.of.values(&setting.point(&s.q, &s.entries));
        !printed.iter().any(|p| setting.near(formulas.of, p, &own))
    };
    special.iter().filter(determined).find(fails).map(|s| s.q.clone())
}

/// How far the printed values are from each configuration's own, the nearest of them, at half of the samples or more.
pub fn apart(setting: &Setting, samples: &[Sample], formulas: &Formulas) -> f64 {
    let Ok(tapes) = Tapes::new(setting, formulas) else { return f64::INFINITY };
    let of = |s: &Sample| {
        let here = setting.point(&s.q, &s.entries);
        let (own, printed) = (tapes.of.values(&here), tapes.printed.values(&here));
        let branches = printed.chunks(formulas.of.len().max(1));
        branches.map(|b| setting.apart(formulas.of, b, &own)).fold(f64::INFINITY, f64::min)
    };
    median(samples.iter().map(of).collect())
}

/// The middle one of some numbers; 0 if there are none.
pub fn median(mut all: Vec<f64>) -> f64 {
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied().unwrap_or(0.0)
}
