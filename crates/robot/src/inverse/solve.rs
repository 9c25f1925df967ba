//! Numbers from an inverse model: all solutions of a pose, the families where the arm can move with its hand still, and
//! what stands in the way of a pose that has none.
//!
//! The solver finds every branch; where a branch's equation leaves its unknown free, the unknown is given values all
//! round, and what solves the pose then is a family (or, at a single value, a solution).

use super::compile::{self, Inputs};
use super::equations::Goal;
use super::model::InverseModel;
use super::newton;
use crate::description::Description;
use crate::geometry::Transform;
use crate::robot::{MissingValue, Robot};
use denavit_program::solver::{Leaf, SolverFunction, SolverScalar, TOLERANCE};
use denavit_symbolic::Symbol;
use std::f64::consts::{PI, TAU};

/// Finds the solutions of poses for a robot with numbers.
#[derive(Clone, Debug)]
pub struct InverseSolver {
    function: SolverFunction,
    scalar: SolverScalar,
    /// The same with every branch kept, however far from a solution.
    nearest: SolverScalar,
    /// The robot that is moved.
    pub robot: Robot<f64>,
    goal: Goal,
    given: Vec<usize>,
    is_angle: Vec<bool>,
    limits: Vec<Option<[f64; 2]>>,
    nodes: Vec<NodeFacts>,
    /// A length that is compared with: the sum of the robot's lengths.
    reach: f64,
}

/// What is known of a node of the solver.
#[derive(Clone, Debug)]
struct NodeFacts {
    unknown: String,
    /// The unknown as a sum of joint variables.
    offset: f64,
    terms: Vec<(usize, f64)>,
    is_angle: bool,
    label: Option<String>,
}

/// All solutions of one pose.
#[derive(Clone, PartialEq, Debug)]
pub struct Answer {
    /// True if all solutions are here: no equation left its unknown undetermined, or what it left open is in a family
    /// found by going all round.
    pub complete: bool,
    /// The isolated ones.
    pub solutions: Vec<Solution>,
    /// Those where the arm can move with its hand still.
    pub families: Vec<Family>,
    /// What stands in the way, if there are none.
    pub obstacle: Option<Obstacle>,
}

impl Answer {
    /// True if there is a solution.
    pub fn is_reachable(&self) -> bool {
        !self.solutions.is_empty() || !self.families.is_empty()
    }
}

/// An isolated solution.
#[derive(Clone, PartialEq, Debug)]
pub struct Solution {
    /// The joint variables, radians in (−π, π] and metres.
    pub q: Vec<f64>,
    /// The distance from the pose: rotation (Frobenius norm of two columns) and position by the arm's size, together.
    pub residual: f64,
    /// The branch: `shoulder+ elbow− wrist+`.
    pub branch: String,
    /// How many branches coincide here.
    pub multiplicity: u32,
    /// Whether the robot's limits allow it, or a copy of it a whole turn away.
    pub within_limits: bool,
    /// The smallest quantity that the derivation divides by, without dimension: joints are determined to about
    /// 1e-16 by it.
    pub guard: f64,
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
    /// The nodes of the solver that are free, and the values taken there at the representative.
    at: Vec<(usize, [f64; 2])>,
    /// The signs of the nodes of the solver.
    signs: Vec<i8>,
}

/// Why a pose has no solution.
#[derive(Clone, PartialEq, Debug)]
pub enum Obstacle {
    /// An equation has no root on any branch.
    NoRoot {
        /// The unknown that it would determine.
        unknown: String,
        /// How far it is from having one, without dimension.
        gap: f64,
    },
    /// The pose does not meet what all poses of the arm meet; the nearest that the derivation came is this far away.
    NotOnTheArm {
        /// The joint variables of the nearest branch.
        q: Vec<f64>,
        /// The rotation that is missing, radians.
        angle: f64,
        /// The displacement that is missing, metres.
        distance: f64,
    },
}

/// A residual above this is more than rounding, and Newton's method lowers it.
const ROUGH: f64 = 1e-13;
/// A guard below this may be one that vanishes at a solution which is known to the square root of rounding only.
const NEAR: f64 = 1e-6;
/// What guards are compared with then, by what they are compared with otherwise.
const LOOSE: f64 = NEAR / denavit_program::solver::GUARD;
/// How far Newton's method may move a member of a family that was found with loose guards.
const SHORT: f64 = 1e-5;
/// Values that are tried for one free unknown; multiples of 5° hold all usual angles.
const ROUND: usize = 72;
/// For two, and for three and more.
const ROUND_OF_TWO: usize = 24;
const ROUND_OF_MORE: usize = 12;

impl InverseModel {
    /// The solver for the numbers of a robot: those of the description that the model was derived from, or others with
    /// the same zeros and angles.
    ///
    /// # Errors
    /// If a parameter has no value.
    pub fn solver(&self, description: &Description) -> Result<InverseSolver, MissingValue> {
        let robot = Robot::numeric(description)?;
        let value = |s: Symbol| {
            let p = description.parameters.iter().find(|p| p.symbol == s)?;
            p.value?.eval(|_| None).ok()
        };
        let missing: Vec<String> = self
            .compiled
            .solver
            .parameters
            .iter()
            .filter(|s| value(**s).is_none())
            .map(|s| s.name().to_string())
            .collect();
        if !missing.is_empty() {
            return Err(MissingValue { parameters: missing });
        }
        let parameters: Vec<f64> =
            self.compiled.solver.parameters.iter().map(|&s| value(s).unwrap_or(0.0)).collect();
        let function = self.compiled.solver.compile(&parameters);
        let nearest = compile::without_residual(self).compile(&parameters).scalar();
        let limits = description
            .rows
            .iter()
            .filter(|r| r.variable.is_some())
            .map(|r| {
                let [low, high] = r.limits?;
                Some([low.eval(value).ok()?, high.eval(value).ok()?])
            })
            .collect();
        let nodes = self
            .steps
            .iter()
            .zip(&self.labels)
            .map(|(s, label)| NodeFacts {
                offset: self.chain.unknown_expr(s.unknown).eval(|v| value(v).or(Some(0.0))).unwrap_or(0.0),
                terms: self.chain.unknown_terms(s.unknown),
                unknown: self.chain.describe(s.unknown),
                is_angle: matches!(s.unknown, super::known::Unknown::Angle(_)),
                label: label.clone(),
            })
            .collect();
        let lengths = robot
            .links
            .iter()
            .flat_map(|l| [l.before.translation.norm(), l.after.translation.norm(), l.d.offset.abs()]);
        let reach: f64 = lengths.sum::<f64>() + robot.base.translation.norm() + robot.tool.translation.norm();
        Ok(InverseSolver {
            scalar: function.scalar(),
            nearest,
            function,
            robot,
            goal: self.goal,
            given: self.given.clone(),
            is_angle: (0..self.chain.variables.len()).map(|j| self.chain.is_angle(j)).collect(),
            limits,
            nodes,
            reach,
        })
    }
}

/// The entries of a pose that a goal gives, in the order of [`Inputs`], then the given joint variables.
pub fn variables(goal: Goal, pose: &Transform<f64>, given: &[f64]) -> Vec<f64> {
    let m = pose.matrix();
    let wanted = |k: &usize| match goal {
        Goal::Pose => true,
        Goal::Position => k % 4 == 3,
        Goal::PositionAndAxis => k % 4 >= 2,
    };
    (0..12).filter(wanted).map(|k| m[k / 4][k % 4]).chain(given.iter().copied()).collect()
}

impl Inputs {
    /// How many numbers go into the solver.
    pub fn len(&self) -> usize {
        self.symbols().len()
    }

    /// True for no input; there is always one.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl InverseSolver {
    /// The compiled solver, for batches.
    pub fn function(&self) -> &SolverFunction {
        &self.function
    }

    /// Which joint variables are given (from 0).
    pub fn given(&self) -> &[usize] {
        &self.given
    }

    /// All solutions of a pose of the tool in the base; `given` holds a value for each joint that is given.
    ///
    /// # Panics
    /// If there is not one value per given joint.
    pub fn solve(&mut self, pose: &Transform<f64>, given: &[f64]) -> Answer {
        assert_eq!(given.len(), self.given.len(), "one value per given joint");
        let variables = variables(self.goal, pose, given);
        let mut answer = Answer { complete: true, solutions: vec![], families: vec![], obstacle: None };
        let leaves = self.scalar.solve(&variables, &[]);
        let met = leaves.met_free();
        let near = leaves.iter().any(|l| l.free == 0 && l.guard < NEAR);
        let mut found: Vec<(Solution, u64)> = vec![];
        for leaf in leaves.iter() {
            found.push((draft(&self.nodes, &leaf), leaf.free));
        }
        for (mut s, free) in found {
            if free == 0 && self.improve(pose, &mut s) {
                self.add(&mut answer.solutions, s);
            }
        }
        if met != 0 || near || !answer.is_reachable() {
            // Where roots coincide they are known to the square root of a rounding error only, and so are the guards
            // of what follows.
            let loose = met | self.scalar.solve_loosely(&variables, &[], LOOSE).met_free();
            if loose != 0 {
                self.families(pose, given, loose, &mut answer);
                self.absorb(pose, given, &mut answer);
            }
        }
        if !answer.is_reachable() {
            self.last_resort(pose, &variables, met, &mut answer);
        }
        answer
    }

    /// The members of a family with its free unknown (radians or metres) at a value; the first, if it has several.
    pub fn members(
        &mut self,
        pose: &Transform<f64>,
        given: &[f64],
        family: &Family,
        value: f64,
    ) -> Vec<Solution> {
        let mut at = family.at.clone();
        if let Some((i, x)) = at.first_mut() {
            *x = if self.nodes[*i].is_angle { [value.cos(), value.sin()] } else { [value, 0.0] };
        }
        self.with_free(pose, given, &at, &family.signs)
    }

    /// The members of a family with its free unknowns as they are at a configuration: those among them show whether the
    /// configuration belongs to the family.
    pub fn members_at(
        &mut self,
        pose: &Transform<f64>,
        given: &[f64],
        family: &Family,
        q: &[f64],
    ) -> Vec<Solution> {
        // Within the family further unknowns may be free at single places.
        let at: Vec<(usize, [f64; 2])> = (0..self.nodes.len()).map(|i| (i, self.value_at(i, q))).collect();
        self.with_free(pose, given, &at, &family.signs)
    }

    fn with_free(
        &mut self,
        pose: &Transform<f64>,
        given: &[f64],
        at: &[(usize, [f64; 2])],
        signs: &[i8],
    ) -> Vec<Solution> {
        let variables = variables(self.goal, pose, given);
        let mut free = vec![None; self.nodes.len()];
        for &(i, x) in at {
            free[i] = Some(x);
        }
        let leaves = self.scalar.solve_loosely(&variables, &free, LOOSE);
        // Where two roots coincide there is one sign for both.
        let branch: Vec<Leaf> = leaves.iter().filter(|l| l.signs == signs).collect();
        let all = || leaves.iter().filter(|l| l.free != 0 || l.guard < NEAR).collect();
        let kept: Vec<Leaf> = if branch.is_empty() { all() } else { branch };
        let found: Vec<Solution> = kept.iter().map(|l| draft(&self.nodes, l)).collect();
        found.into_iter().filter_map(|s| self.member(pose, s)).collect()
    }

    /// A leaf as a member of a family, if it is one.
    fn member(&self, pose: &Transform<f64>, mut s: Solution) -> Option<Solution> {
        let start = s.q.clone();
        let holds = self.improve(pose, &mut s);
        let moved = start.iter().zip(&s.q).zip(&self.is_angle).map(|((x, y), &is_angle)| {
            if is_angle { wrapped(x - y).abs() } else { (x - y).abs() / self.reach.max(1e-3) }
        });
        let far = moved.fold(0.0, f64::max);
        (holds && far <= SHORT).then_some(s)
    }

    /// Drops isolated solutions that are members of a family.
    fn absorb(&mut self, pose: &Transform<f64>, given: &[f64], answer: &mut Answer) {
        let solutions = std::mem::take(&mut answer.solutions);
        let families = answer.families.clone();
        for s in solutions {
            let is_member = s.guard < NEAR && self.is_in_a_family(pose, given, &families, &s.q);
            if !is_member {
                answer.solutions.push(s);
            }
        }
    }

    /// The unknown of a node at a configuration: cosine and sine, or the displacement.
    fn value_at(&self, node: usize, q: &[f64]) -> [f64; 2] {
        let facts = &self.nodes[node];
        let x: f64 = facts.offset + facts.terms.iter().map(|&(j, k)| k * q[j]).sum::<f64>();
        if facts.is_angle { [x.cos(), x.sin()] } else { [x, 0.0] }
    }

    /// Polishes a leaf that is not a solution yet; false if it does not become one nearby.
    fn improve(&self, pose: &Transform<f64>, s: &mut Solution) -> bool {
        if s.residual > ROUGH {
            let polished = newton::polish(&self.robot, self.goal, pose, &s.q, &self.given, self.size(pose));
            if let Some((q, residual)) = polished
                && residual < s.residual
                && (s.residual > TOLERANCE || norm(&self.moved(&s.q, &q)) <= SHORT)
            {
                (s.q, s.residual) = (q, residual);
            }
        }
        for (x, is_angle) in s.q.iter_mut().zip(&self.is_angle) {
            if *is_angle {
                *x = wrapped(*x);
            }
        }
        s.within_limits = self.within_limits(&s.q);
        s.residual <= TOLERANCE
    }

    fn size(&self, pose: &Transform<f64>) -> f64 {
        self.reach.hypot(pose.translation.norm()).max(f64::MIN_POSITIVE)
    }

    fn within_limits(&self, q: &[f64]) -> bool {
        q.iter().zip(&self.limits).zip(&self.is_angle).all(|((&x, limits), &is_angle)| match limits {
            None => true,
            Some([low, high]) => {
                let inside = |x: f64| (low - 1e-9..=high + 1e-9).contains(&x);
                inside(x) || is_angle && (inside(x + TAU) || inside(x - TAU))
            }
        })
    }

    /// Adds a solution, or counts it with one that is the same.
    fn add(&self, solutions: &mut Vec<Solution>, s: Solution) {
        match solutions.iter_mut().find(|t| self.is_same(&t.q, &s.q)) {
            Some(t) => t.multiplicity += s.multiplicity,
            None => solutions.push(s),
        }
    }

    fn is_same(&self, a: &[f64], b: &[f64]) -> bool {
        const SAME: f64 = denavit_program::solver::SAME;
        a.iter().zip(b).zip(&self.is_angle).all(|((x, y), &is_angle)| {
            let d = x - y;
            (if is_angle { wrapped(d).abs() } else { d.abs() / self.reach.max(1e-3) }) <= SAME
        })
    }

    /// Gives free unknowns values all round, and gathers what solves the pose.
    fn families(&mut self, pose: &Transform<f64>, given: &[f64], met: u64, answer: &mut Answer) {
        let variables = variables(self.goal, pose, given);
        let mut free: Vec<usize> = (0..self.nodes.len()).filter(|i| met >> i & 1 == 1).collect();
        let mut members: Vec<Member> = vec![];
        // Other unknowns may turn out to be free on the way; then all are varied.
        for _ in 0..3 {
            let steps = match free.len() {
                1 => ROUND,
                2 => ROUND_OF_TWO,
                _ => ROUND_OF_MORE,
            };
            members.clear();
            let mut more = met;
            let count = steps.pow(free.len().min(3) as u32);
            for number in 0..count {
                let at = self.values(&free, steps, number);
                let leaves = self.scalar.solve_loosely(&variables, &at, LOOSE);
                more |= leaves.met_free();
                for leaf in leaves.iter().filter(|l| l.free != 0) {
                    members.push(Member {
                        solution: draft(&self.nodes, &leaf),
                        signs: leaf.signs.to_vec(),
                        free: leaf.free,
                        number,
                    });
                }
            }
            let known = free.len();
            free = (0..self.nodes.len()).filter(|i| more >> i & 1 == 1).collect();
            if free.len() == known {
                let steps = match known {
                    1 => ROUND,
                    2 => ROUND_OF_TWO,
                    _ => ROUND_OF_MORE,
                };
                self.group(pose, given, &free, steps, members, answer);
                return;
            }
        }
        answer.complete = false;
    }

    /// The values of free unknowns in sample `number`.
    fn values(&self, free: &[usize], steps: usize, number: usize) -> Vec<Option<[f64; 2]>> {
        let mut at = vec![None; self.nodes.len()];
        let mut rest = number;
        for &i in free.iter().take(3) {
            let k = rest % steps;
            rest /= steps;
            let turn = k as f64 / steps as f64;
            at[i] = Some(if self.nodes[i].is_angle {
                quarter_exact(k, steps)
            } else {
                [(2.0 * turn - 1.0) * self.reach, 0.0]
            });
        }
        at
    }

    /// Members that belong together: the same branches, neighbouring values.
    fn group(
        &mut self,
        pose: &Transform<f64>,
        given: &[f64],
        free: &[usize],
        steps: usize,
        members: Vec<Member>,
        answer: &mut Answer,
    ) {
        let mut groups: Vec<Vec<Member>> = vec![];
        for m in members {
            let same = |g: &&mut Vec<Member>| {
                let last = &g[g.len() - 1];
                last.signs == m.signs
                    && last.free == m.free
                    && (free.len() > 1 || m.number - last.number <= 1)
            };
            match groups.iter_mut().find(same) {
                Some(g) => g.push(m),
                None => groups.push(vec![m]),
            }
        }
        // All round, the last values are next to the first ones.
        if free.len() == 1 && self.nodes[free[0]].is_angle {
            let mut k = 0;
            while k < groups.len() {
                let starts = groups[k][0].number == 0;
                let end = (0..groups.len()).find(|&j| {
                    j != k
                        && groups[j][0].signs == groups[k][0].signs
                        && groups[j][0].free == groups[k][0].free
                        && groups[j].last().is_some_and(|m| m.number + 1 == steps)
                });
                if let (true, Some(j)) = (starts, end) {
                    let mut joined = std::mem::take(&mut groups[j]);
                    joined.append(&mut groups[k]);
                    groups[k] = joined;
                    groups.remove(j);
                    k = 0;
                    continue;
                }
                k += 1;
            }
        }
        for group in groups {
            // The representative: a proper solution, of the value nearest to 0.
            let slides = !self.nodes[free[0]].is_angle;
            let away = |m: &Member| {
                let k = m.number % steps;
                if slides { k.abs_diff(steps / 2) } else { k.min(steps - k) }
            };
            let mut sorted: Vec<usize> = (0..group.len()).collect();
            sorted.sort_by_key(|&k| (away(&group[k]), group[k].number));
            let best =
                sorted.iter().find_map(|&k| self.member(pose, group[k].solution.clone()).map(|s| (k, s)));
            let Some((k, representative)) = best else { continue };
            let (mask, signs) = (group[k].free, group[k].signs.clone());
            let values = self.values(free, steps, group[k].number);
            let at: Vec<(usize, [f64; 2])> = (0..self.nodes.len())
                .filter(|i| mask >> i & 1 == 1)
                .filter_map(|i| Some((i, values[i]?)))
                .collect();
            let q = representative.q.clone();
            // Two branches may meet at single places: the whole group must be known already to be dropped.
            let places = [k, 0, group.len() / 3, group.len() / 2, group.len() - 1];
            if places.iter().all(|&p| {
                let Some(s) = self.member(pose, group[p].solution.clone()) else { return true };
                self.is_in_a_family(pose, given, &answer.families, &s.q)
            }) {
                continue;
            }
            // Of the unknowns that are free, those that can move while the others stay.
            let moving: Vec<(usize, Vec<f64>)> = at
                .iter()
                .filter_map(|&(i, _)| Some((i, self.tangent(pose, given, i, (&at, &signs), &q)?)))
                .collect();
            let Some((first, direction)) = moving.first().cloned() else {
                self.add(&mut answer.solutions, representative);
                continue;
            };
            let at: Vec<(usize, [f64; 2])> =
                at.into_iter().filter(|a| moving.iter().any(|m| m.0 == a.0)).collect();
            let far = group[(k + group.len() / 2) % group.len()].solution.q.clone();
            let is_affine = at.len() == 1
                && self
                    .tangent(pose, given, first, (&at, &signs), &far)
                    .is_some_and(|d| parallel(&d, &direction));
            answer.families.push(Family {
                dimension: at.len(),
                free: at.iter().map(|&(i, _)| self.nodes[i].unknown.clone()).collect(),
                direction,
                is_affine,
                interval: (free.len() == 1).then(|| self.interval(free[0], steps, &group)),
                at,
                signs,
                representative,
            });
        }
    }

    /// How the joints move with one of the free unknowns at a solution, a unit vector; nothing if they cannot.
    fn tangent(
        &mut self,
        pose: &Transform<f64>,
        given: &[f64],
        node: usize,
        (at, signs): (&[(usize, [f64; 2])], &[i8]),
        q: &[f64],
    ) -> Option<Vec<f64>> {
        const STEP: f64 = 1e-3;
        let at: Vec<(usize, [f64; 2])> = at.iter().map(|&(i, _)| (i, self.value_at(i, q))).collect();
        let number = at.iter().position(|a| a.0 == node)?;
        for step in [STEP, -STEP] {
            let mut moved = at.clone();
            let [x, y] = moved[number].1;
            moved[number].1 = if self.nodes[node].is_angle {
                let (s, c) = step.sin_cos();
                [x * c - y * s, y * c + x * s]
            } else {
                [x + step * self.reach, 0.0]
            };
            // The neighbour on the same branch is the nearest one.
            let members = self.with_free(pose, given, &moved, signs);
            let distance = |s: &Solution| norm(&self.moved(q, &s.q));
            let nearest = members.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
            if let Some(n) = nearest
                && distance(n) < 100.0 * STEP
            {
                let length = distance(n) * step.signum();
                return Some(self.moved(q, &n.q).iter().map(|d| d / length).collect());
            }
        }
        None
    }

    /// How the joints differ, angles by the shorter way.
    fn moved(&self, from: &[f64], to: &[f64]) -> Vec<f64> {
        let pairs = from.iter().zip(to).zip(&self.is_angle);
        pairs.map(|((x, y), &is_angle)| if is_angle { wrapped(y - x) } else { y - x }).collect()
    }

    fn is_in_a_family(
        &mut self,
        pose: &Transform<f64>,
        given: &[f64],
        families: &[Family],
        q: &[f64],
    ) -> bool {
        families.iter().any(|f| {
            let members = self.members_at(pose, given, f, q);
            members.iter().any(|m| self.moved(q, &m.q).iter().all(|d| d.abs() <= SHORT))
        })
    }

    /// The sampled values between the ends of a group.
    fn interval(&self, node: usize, steps: usize, group: &[Member]) -> [f64; 2] {
        let value = |number: usize| {
            let turn = number as f64 / steps as f64;
            if self.nodes[node].is_angle { wrapped(turn * TAU) } else { (2.0 * turn - 1.0) * self.reach }
        };
        if group.len() == steps && self.nodes[node].is_angle {
            return [-PI, PI];
        }
        [value(group[0].number), value(group[group.len() - 1].number)]
    }

    /// Newton's method from the branches that come nearest, and if that fails what stands in the way.
    fn last_resort(&mut self, pose: &Transform<f64>, variables: &[f64], met: u64, answer: &mut Answer) {
        let free: Vec<usize> = (0..self.nodes.len()).filter(|i| met >> i & 1 == 1).collect();
        let (steps, count) = if free.is_empty() { (1, 1) } else { (ROUND, ROUND) };
        let mut starts: Vec<Solution> = vec![];
        for number in 0..count {
            let at = self.values(&free[..free.len().min(1)], steps, number);
            let leaves = self.nearest.solve_carefully(variables, &at);
            for leaf in leaves.iter() {
                starts.push(draft(&self.nodes, &leaf));
            }
        }
        for s in &mut starts {
            s.residual = newton::distance(&self.robot, self.goal, pose, &s.q, self.size(pose));
        }
        starts.sort_by(|a, b| a.residual.total_cmp(&b.residual));
        starts.truncate(16);
        for s in &starts {
            let mut s = s.clone();
            s.residual = s.residual.max(2.0 * TOLERANCE);
            if self.improve(pose, &mut s) {
                answer.complete = false;
                self.add(&mut answer.solutions, s);
            }
        }
        if answer.is_reachable() {
            return;
        }
        let leaves = self.scalar.solve_carefully(variables, &[]);
        let last = leaves.ended().max_by(|a, b| a.node.cmp(&b.node));
        answer.obstacle = match (starts.first(), last) {
            (Some(s), _) => {
                let (angle, distance) = newton::gap(&self.robot, self.goal, pose, &s.q);
                Some(Obstacle::NotOnTheArm { q: s.q.clone(), angle, distance })
            }
            (None, Some(end)) => {
                Some(Obstacle::NoRoot { unknown: self.nodes[end.node].unknown.clone(), gap: end.gap })
            }
            (None, None) => None,
        };
    }
}

/// A leaf with values for free unknowns.
struct Member {
    solution: Solution,
    signs: Vec<i8>,
    free: u64,
    number: usize,
}

fn draft(nodes: &[NodeFacts], leaf: &Leaf) -> Solution {
    let branch: Vec<String> = nodes
        .iter()
        .zip(leaf.signs)
        .enumerate()
        .filter(|(i, (n, _))| n.label.is_some() && leaf.free >> i & 1 == 0)
        .map(|(_, (n, sign))| {
            let label = n.label.as_deref().unwrap_or_default();
            match sign {
                -1 => format!("{label}−"),
                1 => format!("{label}+"),
                k => format!("{label}{k}"),
            }
        })
        .collect();
    Solution {
        q: leaf.outputs.to_vec(),
        residual: leaf.residual,
        branch: branch.join(" "),
        multiplicity: leaf.multiplicity,
        within_limits: true,
        guard: leaf.guard,
    }
}

/// Cosine and sine of k/steps of a turn, exact at quarter turns.
fn quarter_exact(k: usize, steps: usize) -> [f64; 2] {
    if (4 * k).is_multiple_of(steps) {
        return [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]][4 * k / steps % 4];
    }
    let (s, c) = (k as f64 / steps as f64 * TAU).sin_cos();
    [c, s]
}

/// The angle in (−π, π].
fn wrapped(x: f64) -> f64 {
    let y = x - TAU * (x / TAU).round();
    if y <= -PI { y + TAU } else { y }
}

fn norm(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn parallel(a: &[f64], b: &[f64]) -> bool {
    let dot: f64 = a.iter().zip(b).map(|(x, y)| x * y).sum();
    (dot.abs() - 1.0).abs() <= 1e-6
}
