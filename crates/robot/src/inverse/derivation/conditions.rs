//! What a pose must meet so that an arm with fewer than six degrees of freedom can take it, and what such an arm is for.
//!
//! An equation without unknowns that no step needs is a condition: it holds for the poses of the arm and for no others.
//! Of all of them those are kept that are short and independent, as many as the arm lacks degrees of freedom.

use super::algebra::{Algebra, Kind};
use super::chain::{Motion, NormalChain};
use super::equations::{Equation, Source, constant};
use super::known::{Known, Samples, Unknown};
use super::plan::Step;
use denavit_symbolic::poly::{Atom, Monomial, Poly};
use denavit_symbolic::{Expr, Rational};
use rustc_hash::FxHashSet;

/// A condition on the pose, in its entries and in what the steps before it find.
#[derive(Clone, Debug)]
pub struct Condition {
    /// Where it comes from.
    pub source: Source,
    /// pose side − chain side, which must vanish.
    pub zero: Poly,
    /// The side with the entries of the pose.
    pub pose: Poly,
    /// The other side.
    pub chain: Poly,
    /// Behind which step everything in it is known (0: it holds entries of the pose alone).
    pub behind: usize,
    /// The dimension: 0 for a rotation, 1 for a length.
    pub degree: u8,
}

/// What the hand of an arm can be told.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Task {
    /// Any position and orientation.
    Pose,
    /// A position and the direction of the tool's z axis.
    PositionAndAxis,
    /// A position and a turn about one fixed direction (SCARA).
    PositionAndTurn,
    /// A place in a plane and a turn in it.
    Planar,
    /// A position.
    Position,
    /// An orientation.
    Orientation,
    /// None of these: a set of poses of this dimension.
    Other(usize),
}

/// What an arm serves, from the ranks of its motion: of the pose, of the position alone, of position and axis.
pub fn task(chain: &NormalChain, rank: usize, of_position: usize, with_axis: usize) -> Task {
    let turning = chain.axes.iter().any(|a| a.motion != Motion::Slide);
    match rank {
        6 => Task::Pose,
        5 if with_axis == 5 => Task::PositionAndAxis,
        4 if chain.groups.len() == 1 && of_position == 3 => Task::PositionAndTurn,
        3 if of_position == 3 => Task::Position,
        3 if of_position == 2 && chain.groups.len() == 1 => Task::Planar,
        3 if of_position < 3 && chain.groups.len() == 3 && turning => Task::Orientation,
        n => Task::Other(n),
    }
}

/// The independent conditions of an arm that lacks degrees of freedom, the earliest and shortest first; then entries that
/// are 1 or −1 always.
pub fn conditions(
    chain: &NormalChain,
    equations: &[Equation],
    steps: &[Step],
    given: &[usize],
    samples: &Samples,
    lacking: usize,
) -> Vec<Condition> {
    if lacking == 0 {
        return vec![];
    }
    let used: FxHashSet<Source> =
        steps.iter().flat_map(|s| s.origins.iter().flat_map(|o| o.sources())).collect();
    let mut known = Known::new(chain, given);
    let mut candidates: Vec<Condition> = vec![];
    for behind in 0..=steps.len() {
        for e in equations {
            let is_new = !candidates.iter().any(|c| c.source == e.source);
            if is_new && !used.contains(&e.source) && known.unknowns(chain, &e.atoms).is_empty() {
                candidates.push(Condition {
                    source: e.source,
                    zero: e.zero.clone(),
                    pose: e.pose.clone(),
                    chain: e.chain.clone(),
                    behind,
                    degree: e.degree,
                });
            }
        }
        if let Some(step) = steps.get(behind) {
            known.learn(step.unknown);
        }
    }
    // Independent of each other as functions of the pose. A row of gradients by the 12 entries of the pose, with what the
    // steps find held, and with the tangents of rotations only; steps that move with the pose are covered by taking
    // conditions of different steps.
    let directions = samples.pose_directions();
    let mut chosen: Vec<Condition> = vec![];
    let mut basis: Vec<Vec<f64>> = vec![];
    // An entry that is ±1 is so at its largest or smallest, where it has no gradient: it says which of two signs.
    let mut signs: Vec<Condition> = vec![];
    for c in candidates {
        let is_full = chosen.len() == lacking;
        let mut row: Vec<f64> = directions.iter().map(|d| samples.derivative(&c.zero, d)).collect();
        let length = norm(&row);
        if length <= 1e-9 * samples.size(&c.zero) {
            let gives = equations.iter().find(|e| e.source == c.source).and_then(constant);
            if gives.is_some_and(|(_, x, _)| x.abs() == Rational::ONE) {
                signs.push(c);
            }
            continue;
        }
        if is_full {
            continue;
        }
        for b in &basis {
            let along: f64 = row.iter().zip(b).map(|(x, y)| x * y).sum();
            row.iter_mut().zip(b).for_each(|(x, y)| *x -= along * y);
        }
        let left = norm(&row);
        if left > 1e-6 * length {
            row.iter_mut().for_each(|x| *x /= left);
            basis.push(row);
            chosen.push(c);
        }
    }
    chosen.extend(signs);
    chosen
}

fn norm(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// A condition over numbers.
#[derive(Clone, Debug)]
pub struct NumericCondition {
    /// The condition in words of formulas: `S1·px − C1·py = 0`.
    pub text: String,
    /// The dimension: 0 for a rotation, 1 for a length.
    pub degree: u8,
    terms: Vec<(f64, Vec<(Factor, i32)>)>,
}

/// What a term of a condition is made of.
#[derive(Clone, Debug)]
enum Factor {
    /// An entry of the pose behind base and tool, row-major 3×4.
    Pose(usize),
    /// The cosine of a sum of joint variables.
    Cos(f64, Vec<(usize, f64)>),
    /// The sine.
    Sin(f64, Vec<(usize, f64)>),
    /// A displacement.
    Slide(f64, Vec<(usize, f64)>),
    /// A constant.
    Constant(f64),
}

impl NumericCondition {
    /// A condition with numbers for the constants of the robot.
    pub fn new(
        chain: &NormalChain,
        c: &Condition,
        text: String,
        value: impl Fn(denavit_symbolic::Symbol) -> Option<f64>,
    ) -> Self {
        let form = |x: Unknown| {
            let offset: Expr = chain.unknown_expr(x);
            let offset = offset.eval(|s| value(s).or(Some(0.0))).unwrap_or(0.0);
            (offset, chain.unknown_terms(x))
        };
        let factor = |a: Atom| match chain.algebra.kind(a) {
            Kind::Pose(k) => Factor::Pose(k),
            Kind::Cos(n) => {
                let (offset, terms) = form(Unknown::Angle(chain.differences[n]));
                Factor::Cos(offset, terms)
            }
            Kind::Sin(n) => {
                let (offset, terms) = form(Unknown::Angle(chain.differences[n]));
                Factor::Sin(offset, terms)
            }
            Kind::Slide(k) => {
                let (offset, terms) = form(Unknown::Slide(k));
                Factor::Slide(offset, terms)
            }
            Kind::Constant(e) => Factor::Constant(e.eval(&value).unwrap_or(f64::NAN)),
        };
        let factors = |m: &Monomial| m.factors().iter().map(|&(a, n)| (factor(a), i32::from(n))).collect();
        let terms = c.zero.terms().iter().map(|(m, r)| (r.to_f64(), factors(m))).collect();
        NumericCondition { text, degree: c.degree, terms }
    }

    /// True if no joint variable stands in it: a pose that misses it is out of the question.
    pub fn is_of_pose(&self) -> bool {
        let factors = || self.terms.iter().flat_map(|t| &t.1);
        factors().all(|f| matches!(f.0, Factor::Pose(_) | Factor::Constant(_)))
    }

    /// By how much a pose (behind base and tool, 3×4 row-major) with these joint variables misses it.
    pub fn miss(&self, pose: &[f64; 12], q: &[f64]) -> f64 {
        let sum = |offset: &f64, terms: &[(usize, f64)]| -> f64 {
            offset + terms.iter().map(|&(j, k)| k * q[j]).sum::<f64>()
        };
        let factor = |f: &Factor| match f {
            Factor::Pose(k) => pose[*k],
            Factor::Cos(o, t) => sum(o, t).cos(),
            Factor::Sin(o, t) => sum(o, t).sin(),
            Factor::Slide(o, t) => sum(o, t),
            Factor::Constant(x) => *x,
        };
        self.terms.iter().map(|(r, fs)| r * fs.iter().map(|(f, n)| factor(f).powi(*n)).product::<f64>()).sum()
    }
}

impl Samples {
    /// Six directions in which the first sample's pose can move: three turns, three shifts, as changes of its entries.
    pub(crate) fn pose_directions(&self) -> Vec<[f64; 12]> {
        let atoms = self.first();
        let mut found = vec![];
        for axis in 0..3 {
            let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
            let mut d = [0.0; 12];
            for column in 0..3 {
                // e × column
                d[i * 4 + column] = -atoms[j * 4 + column];
                d[j * 4 + column] = atoms[i * 4 + column];
            }
            found.push(d);
        }
        for axis in 0..3 {
            let mut d = [0.0; 12];
            d[axis * 4 + 3] = self.length();
            found.push(d);
        }
        found
    }

    /// The sum of the absolute values of a polynomial's terms, at the first sample.
    fn size(&self, p: &Poly) -> f64 {
        Algebra::value_and_size(p, self.first()).1
    }

    /// The derivative of a polynomial along a change of the pose's entries, at the first sample.
    pub fn derivative(&self, p: &Poly, direction: &[f64; 12]) -> f64 {
        const STEP: f64 = 1e-6;
        let at = |h: f64| {
            let mut atoms = self.first().to_vec();
            for (k, d) in direction.iter().enumerate() {
                atoms[k] += h * d;
            }
            Algebra::value(p, &atoms)
        };
        (at(STEP) - at(-STEP)) / (2.0 * STEP)
    }
}
