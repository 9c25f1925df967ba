//! What inverse kinematics answers: solutions, families of them, or what stands in the way.

use super::branch::Branch;
use super::self_motion::SelfMotion;
use crate::space::JointSpace;

/// All solutions of one pose.
#[derive(Clone, PartialEq, Debug)]
pub struct Answer {
    /// Why there may be more solutions; nothing if all are here: no equation left its unknown undetermined, what it left
    /// open is in a family found by going all round, or a count of the roots says so.
    pub doubt: Option<Doubt>,
    /// The isolated ones.
    pub solutions: Vec<Solution>,
    /// Those where the arm can move with its hand still.
    pub families: Vec<Family>,
    /// What stands in the way, if there are none.
    pub obstacle: Option<Obstacle>,
}

/// Solutions that are one may be this far from what lies halfway between them, radians, and lengths by the arm's size.
const BESIDE: f64 = 1e-3;
/// No rounding of a pose moves a solution this far from it.
const GROSS: f64 = 1e-2;

impl Answer {
    /// No solution yet.
    pub fn empty() -> Self {
        Answer { doubt: None, solutions: vec![], families: vec![], obstacle: None }
    }

    /// True if all solutions are here.
    pub fn is_complete(&self) -> bool {
        self.doubt.is_none()
    }

    /// Judges the joints as they are returned: wrapped, moved along a family, as a copy.
    pub(in crate::inverse) fn judge(&mut self, miss: impl Fn(&[f64]) -> f64) {
        let families = self.families.iter_mut().map(|f| &mut f.representative);
        families.chain(&mut self.solutions).for_each(|s| s.residual = miss(&s.q));
    }

    /// Leaves out what misses the pose by more than any rounding does: a mistake of a method, which may lack others then.
    pub(in crate::inverse) fn leave_false(&mut self) {
        let before = self.solutions.len();
        self.solutions.retain(|s| s.residual <= GROSS);
        if self.solutions.len() < before {
            self.doubt = self.doubt.or(Some(Doubt::Uncounted));
        }
    }

    /// Takes what was found without a formula for the solution beside it, where halfway between the two the pose is missed no
    /// more than at them: a root that counts twice is known to the square root of a rounding error only.
    pub(in crate::inverse) fn merge(&mut self, space: &JointSpace, miss: impl Fn(&[f64]) -> f64) {
        let mut k = 0;
        while k < self.solutions.len() {
            let own = &self.solutions[k];
            let is_it = |(j, s): &(usize, &Solution)| {
                let (between, way) = space.halfway(&own.q, &s.q);
                *j != k && way <= BESIDE && miss(&between) <= own.residual.max(s.residual)
            };
            let found =
                if own.branch.is_empty() { self.solutions.iter().enumerate().find(is_it) } else { None };
            let Some((j, _)) = found else {
                k += 1;
                continue;
            };
            let one = self.solutions.remove(k);
            let other = &mut self.solutions[if j > k { j - 1 } else { j }];
            other.multiplicity = other.multiplicity.max(2);
            // The twin that the limits allow stands for both; else the better one.
            let is_better = one.residual < other.residual && one.within_limits == other.within_limits;
            if other.branch.is_empty() && (is_better || one.within_limits && !other.within_limits) {
                (other.q, other.residual, other.within_limits) = (one.q, one.residual, one.within_limits);
            }
            self.doubt = self.doubt.or(Some(Doubt::DoubleRoot));
        }
    }

    /// Adds what a descent found: the curve through it, if the arm can move there with its hand still, or a solution.
    pub(in crate::inverse) fn add(&mut self, new: Solution, motion: Option<SelfMotion>) {
        match motion {
            Some(motion) => self.families.push(Family::followed(new, motion)),
            None => self.solutions.push(new),
        }
    }

    /// Says what a list leaves in doubt whatever the method: that copies are missing, that a pose lacks digits.
    pub(in crate::inverse) fn doubt_numbers(&mut self, space: &JointSpace, all_copies: bool) {
        let doubt = match all_copies {
            _ if space.is_remote() => Some(Doubt::Digits),
            false if self.is_reachable() => Some(Doubt::Copies),
            _ => None,
        };
        self.doubt = self.doubt.or(doubt);
    }

    /// Lists the copies of what was found that joints with gears have within the range of a whole turn or more, and
    /// puts the limits to each; says of copies that are not listed, and of digits that a pose lacks, that they leave a
    /// doubt.
    pub(in crate::inverse) fn spread(&mut self, space: &JointSpace) {
        self.doubt_numbers(space, space.turning.all_copies);
        if space.turning.copies.is_empty() {
            return;
        }
        let found = std::mem::take(&mut self.solutions);
        for (s, q) in found.iter().flat_map(|s| space.copies(&s.q).into_iter().map(move |q| (s, q))) {
            if !self.solutions.iter().any(|t| space.is_listed_as(&t.q, &q)) {
                self.solutions.push(Solution { within_limits: space.within(&q), q, ..s.clone() });
            }
        }
        let found = std::mem::take(&mut self.families);
        for (f, q) in
            found.iter().flat_map(|f| space.copies(&f.representative.q).into_iter().map(move |q| (f, q)))
        {
            let way: Vec<f64> = q.iter().zip(&f.representative.q).map(|(x, y)| x - y).collect();
            let mut family = f.clone();
            family.curve.iter_mut().for_each(|p| p.iter_mut().zip(&way).for_each(|(x, d)| *x += d));
            family.representative =
                Solution { within_limits: space.within(&q), q, ..f.representative.clone() };
            self.families.push(family);
        }
    }

    /// Leaves out what the limits exclude, and how much that is: solutions of which they allow no copy, families of which
    /// they allow no member that is known. What is left stands where the limits allow it, next to where it was.
    pub fn leave_out(&mut self, space: &JointSpace) -> usize {
        let before = self.solutions.len() + self.families.len();
        self.solutions.retain(|s| s.within_limits);
        // Of a family that was not followed nothing else is known.
        let is_excluded = |f: &Family| {
            !f.representative.within_limits
                && !f.curve.is_empty()
                && f.feasible.is_empty()
                && !f.curve.iter().any(|q| space.within(q))
        };
        self.families.retain(|f| !is_excluded(f));
        let families = self.families.iter_mut().map(|f| &mut f.representative);
        for s in families.chain(&mut self.solutions).filter(|s| s.within_limits) {
            s.q = match space.listed_copies(&s.q, 1).pop() {
                Some(copy) => copy,
                // What is not listed with all its copies.
                None => space.nearest_copy(&s.q, &s.q),
            };
        }
        before - self.solutions.len() - self.families.len()
    }

    /// True if there is a solution.
    pub fn is_reachable(&self) -> bool {
        !self.solutions.is_empty() || !self.families.is_empty()
    }
}

/// Why an answer may lack solutions.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Doubt {
    /// Some were found by trying values or by starting from nearby, where others may hide.
    Sampled,
    /// Two roots nearly coincide: whether they are two, one or none is below rounding.
    DoubleRoot,
    /// The roots could not be counted.
    Uncounted,
    /// Solutions were searched for by descent from several starts, and there may be any number.
    Searched,
    /// One solution was asked for.
    OneAsked,
    /// Gears repeat each configuration more often within a turn than is listed.
    Copies,
    /// The robot stands so far from the origin that a pose has too few digits.
    Digits,
}

/// An isolated solution.
#[derive(Clone, PartialEq, Debug)]
pub struct Solution {
    /// The joint variables, radians in (−π, π] and metres.
    pub q: Vec<f64>,
    /// The distance from the pose: rotation (Frobenius norm of two columns) and position by the arm's size, together.
    pub residual: f64,
    /// The branch: `shoulder+ elbow− wrist+`.
    pub branch: Branch,
    /// How many branches coincide here.
    pub multiplicity: u32,
    /// Whether the robot's limits allow it, or a copy of it a whole turn away.
    pub within_limits: bool,
    /// The smallest quantity that the derivation divides by, without dimension: joints are determined to about
    /// 1e-16 by it.
    pub guard: f64,
}

impl Solution {
    /// A configuration that was found without a formula, beside which nothing is known.
    pub(in crate::inverse) fn found(q: Vec<f64>, residual: f64, within_limits: bool) -> Self {
        Solution { q, residual, branch: Branch::default(), multiplicity: 1, within_limits, guard: 0.0 }
    }
}

/// Solutions in which some joints can move together with the hand still.
#[derive(Clone, PartialEq, Debug)]
pub struct Family {
    /// One of them.
    pub representative: Solution,
    /// How many parameters it has.
    pub dimension: usize,
    /// The unknowns that are free: `q4`, `q2 + q3 + q4`.
    pub free: Vec<String>,
    /// How the joints move at the representative, a unit vector (the first of the null space).
    pub direction: Vec<f64>,
    /// True if they move in these proportions everywhere: an affine family.
    pub is_affine: bool,
    /// For one free unknown, the values for which there is a solution (radians or metres), from the sampling.
    pub interval: Option<[f64; 2]>,
    /// The values of the free unknown at which the limits allow the configuration, or a copy of it whole turns away, in
    /// order; for the curves of a redundant arm.
    pub feasible: Vec<[f64; 2]>,
    /// Members along it, neighbours next to each other, where it is not affine and was followed; the first again at
    /// the end if it is closed.
    pub curve: Vec<Vec<f64>>,
    /// The nodes of the solver that are free, and the values taken there at the representative.
    pub(in crate::inverse) at: Vec<(usize, [f64; 2])>,
    /// The signs of the nodes of the solver.
    pub(in crate::inverse) signs: Vec<i8>,
    /// For one free node, the values of it that belong to this family: the same signs may have others on other stretches.
    pub(in crate::inverse) stretch: Option<[f64; 2]>,
}

impl Family {
    /// Free unknowns and how the joints move at a solution; nothing is known further along.
    pub(in crate::inverse) fn new(representative: Solution, free: Vec<String>, direction: Vec<f64>) -> Self {
        Family {
            representative,
            dimension: free.len(),
            free,
            direction,
            is_affine: false,
            interval: None,
            feasible: vec![],
            curve: vec![],
            at: vec![],
            signs: vec![],
            stretch: None,
        }
    }

    /// What was followed from a solution: a family by its length s.
    pub(in crate::inverse) fn followed(representative: Solution, motion: SelfMotion) -> Self {
        let SelfMotion { direction, is_affine, curve, .. } = motion;
        Family { is_affine, curve, ..Family::new(representative, vec!["s".into()], direction) }
    }
}

/// Why a pose has no solution, and how near the arm comes.
#[derive(Clone, PartialEq, Debug)]
pub struct Obstacle {
    /// The unknown for which no branch has a value, if that is where the branches end: the pose is out of reach.
    pub unknown: Option<String>,
    /// The joint variables of the nearest configuration that was found.
    pub q: Vec<f64>,
    /// The rotation that is missing there, radians.
    pub angle: f64,
    /// The displacement that is missing there, metres.
    pub distance: f64,
    /// The conditions of the arm that the pose violates, the worst first, with what is left instead of 0 (a number
    /// without dimension, or metres).
    pub violated: Vec<(String, f64)>,
}
