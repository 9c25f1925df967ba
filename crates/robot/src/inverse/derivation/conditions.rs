//! What a pose must meet so that an arm with fewer than six degrees of freedom can take it, and what such an arm is for.
//!
//! An equation without unknowns that no step needs is a condition: it holds for the poses of the arm and for no others.
//! So is, where cosine and sine of an angle come from two equations, that their squares add up to 1. Of all of them those are kept that are short and independent, as many as the arm lacks degrees of freedom.

use super::algebra::{Algebra, Kind};
use super::chain::{Motion, NormalChain};
use super::equations::{Equation, Source, constant};
use super::known::{Known, Samples, Unknown};
use super::plan::{Form, Step};
use super::tangent::Tangent;
use denavit_symbolic::poly::{Atom, Monomial, Poly};
use denavit_symbolic::{Expr, Rational};
use rustc_hash::FxHashSet;

/// A condition on the pose, in its entries and in what the steps before it find.
#[derive(Clone, Debug)]
pub struct Condition {
    /// pose side − chain side, which must vanish.
    pub zero: Poly,
    /// The side with the entries of the pose.
    pub pose: Poly,
    /// The other side.
    pub chain: Poly,
    /// Behind which step everything in it is known (0: it holds entries of the pose alone).
    pub behind: usize,
    /// The dimension: 0 for a rotation, 1 for a length, 2 for the square of one.
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
        4 if of_position == 3 && chain.turns_about_one_direction() => Task::PositionAndTurn,
        3 if of_position == 3 => Task::Position,
        3 if of_position == 2 && chain.turns_about_one_direction() => Task::Planar,
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
    let mut candidates: Vec<(Option<Source>, Condition)> = vec![];
    for behind in 0..=steps.len() {
        for e in equations {
            let is_new = !candidates.iter().any(|c| c.0 == Some(e.source));
            if is_new && !used.contains(&e.source) && known.unknowns(chain, &e.atoms).is_empty() {
                let (zero, pose, chain) = (e.zero.clone(), e.pose.clone(), e.chain.clone());
                let condition = Condition { zero, pose, chain, behind, degree: e.degree };
                candidates.push((Some(e.source), condition));
            }
        }
        if let Some(step) = steps.get(behind) {
            known.learn(chain, step.unknown);
        }
    }
    candidates
        .extend(steps.iter().enumerate().filter_map(|(k, s)| Some((None, on_the_circle(chain, s, k)?))));
    // Independent of each other as functions of the pose: gradients along the six ways in which a pose can move, with what the
    // steps find moving along.
    let mut tangents: Vec<Tangent> = vec![];
    let directions: Vec<Vec<Vec<f64>>> = {
        tangents.extend(samples.pose_directions().map(|d| Tangent::new(chain, samples, given, d)));
        let mut all = vec![tangents.iter().map(Tangent::direction).collect()];
        for step in steps {
            tangents.iter_mut().for_each(|t| t.learn(step));
            all.push(tangents.iter().map(Tangent::direction).collect());
        }
        all
    };
    let mut chosen: Vec<Condition> = vec![];
    let mut basis: Vec<Vec<f64>> = vec![];
    // An entry that is ±1 is so at its largest or smallest, where it has no gradient: it says which of two signs.
    let mut signs: Vec<Condition> = vec![];
    for (source, c) in candidates {
        let is_full = chosen.len() == lacking;
        let mut row: Vec<f64> = directions[c.behind].iter().map(|d| samples.derivative(&c.zero, d)).collect();
        let length = norm(&row);
        if length <= 1e-8 * samples.size(&c.zero) {
            let gives = equations.iter().find(|e| Some(e.source) == source).and_then(constant);
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

/// That the cosine and the sine that a step takes from two equations belong to one angle.
fn on_the_circle(chain: &NormalChain, step: &Step, behind: usize) -> Option<Condition> {
    let ([x, y], Form::Pair { .. }) = (&step.rows[..], &step.form) else { return None };
    if !(x.c.squares.is_empty() && y.c.squares.is_empty()) {
        return None;
    }
    let a = &chain.algebra;
    let sum = |p: &Poly, q: &Poly| a.square(p).plus(&a.square(q));
    let cross = |p: &Poly, q: &Poly, r: &Poly, s: &Poly| a.times(p, q).minus(&a.times(r, s));
    let product = a.times(&x.a, &y.a).plus(&a.times(&x.b, &y.b));
    let is_turned = product.is_zero() && sum(&x.a, &x.b) == sum(&y.a, &y.b);
    let (pose, chain, times) = match is_turned {
        // The rows turn the direction and scale it.
        true => (sum(&x.c.plus, &y.c.plus), sum(&x.a, &x.b), 1),
        // Cramer's rule.
        false => {
            let (cosine, sine) =
                (cross(&x.c.plus, &y.b, &x.b, &y.c.plus), cross(&x.a, &y.c.plus, &x.c.plus, &y.a));
            (sum(&cosine, &sine), a.square(&cross(&x.a, &y.b, &x.b, &y.a)), 2)
        }
    };
    Some(Condition { zero: pose.minus(&chain), pose, chain, behind, degree: times * (x.degree + y.degree) })
}

fn norm(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// A condition over numbers.
#[derive(Clone, Debug)]
pub struct NumericCondition {
    /// The condition in words of formulas: `S1·px − C1·py = 0`.
    pub text: String,
    /// The dimension: 0 for a rotation, 1 for a length, 2 for the square of one.
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
    pub(crate) fn pose_directions(&self) -> [[f64; 12]; 6] {
        let atoms = self.first();
        let mut found = [[0.0; 12]; 6];
        for (axis, d) in found.iter_mut().take(3).enumerate() {
            let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
            for column in 0..3 {
                // e × column
                d[i * 4 + column] = -atoms[j * 4 + column];
                d[j * 4 + column] = atoms[i * 4 + column];
            }
        }
        for axis in 0..3 {
            found[3 + axis][axis * 4 + 3] = self.length();
        }
        found
    }

    /// The sum of the absolute values of a polynomial's terms, at the first sample.
    fn size(&self, p: &Poly) -> f64 {
        Algebra::value_and_size(p, self.first()).1
    }

    /// The derivative of a polynomial along a change of the atoms, at the first sample.
    pub fn derivative(&self, p: &Poly, direction: &[f64]) -> f64 {
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
