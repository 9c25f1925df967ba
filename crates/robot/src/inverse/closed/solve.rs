//! Numbers from an inverse model: all solutions of a pose, the families where the arm can move with its hand still, and
//! what stands in the way of a pose that has none.
//!
//! The solver finds every branch; where a branch's equation leaves its unknown free, the unknown is given values all
//! round, and what solves the pose then is a family (or, at a single value, a solution).

use super::families;
use crate::description::Description;
use crate::geometry::Transform;
use crate::inverse::answer::{Answer, Doubt, Obstacle, Solution};
use crate::inverse::branch::{Branch, Label};
use crate::inverse::derivation::{Goal, InverseModel, NumericCondition, Step, Unknown, Variant, compile};
use crate::inverse::newton;
use crate::mechanism::{MissingValue, Robot};
use crate::random::Random;
use crate::shared::{Lent, Shared};
use crate::space::{JointSpace, norm};
pub(super) use denavit_program::solver::NEAR;
use denavit_program::solver::{BESIDE, Leaf, ROUNDED, Solver, SolverFunction, SolverScalar, TOLERANCE};
use denavit_symbolic::{Expr, Symbol};
use std::f64::consts::TAU;
use std::ops::Deref;

/// Finds the solutions of poses for a robot with numbers.
#[derive(Clone, Debug)]
pub struct InverseSolver {
    function: SolverFunction,
    memory: Shared<Memory>,
    /// The robot that is moved.
    pub robot: Robot<f64>,
    pub(super) goal: Goal,
    pub(super) given: Vec<usize>,
    pub(super) space: JointSpace,
    /// How much of the motion of its joints the hand sees at least, at a configuration like any other; at most 1.
    seen: f64,
    pub(super) nodes: Vec<NodeFacts>,
    variants: Vec<VariantSolver>,
    conditions: Vec<NumericCondition>,
    /// What stands before the first axis and behind the last one in the normal form.
    base: Transform<f64>,
    tool: Transform<f64>,
}

/// A derivation that finds the unknown of a step in another way.
#[derive(Clone, Debug)]
struct VariantSolver {
    step: usize,
    nodes: Vec<NodeFacts>,
}

/// What computes a pose, with the memory that it computes in.
#[derive(Clone, Debug)]
pub(super) struct Memory {
    pub scalar: SolverScalar,
    /// The same with every branch kept, however far from a solution.
    nearest: SolverScalar,
    /// Those of the variants.
    variants: Vec<SolverScalar>,
}

/// A solver at work on a pose.
pub(super) struct Solving<'a> {
    pub solver: &'a InverseSolver,
    pub memory: Lent<'a, Memory>,
    /// What a solution may miss the pose by.
    pub(super) tolerance: f64,
}

impl Deref for Solving<'_> {
    type Target = InverseSolver;

    fn deref(&self) -> &InverseSolver {
        self.solver
    }
}

/// What is known of a node of the solver.
#[derive(Clone, Debug)]
pub(super) struct NodeFacts {
    pub unknown: String,
    /// The unknown as a sum of joint variables.
    pub offset: f64,
    pub terms: Vec<(usize, f64)>,
    pub is_angle: bool,
    pub label: Option<Label>,
}

/// Rounding leaves no more than this where formulas are well determined.
const GROWN: f64 = 1e-11;
/// A residual above this is more than rounding, and Newton's method lowers it.
pub(super) const ROUGH: f64 = 1e-13;
/// Branches that Newton's method starts from, and how far they may be from the pose.
const STARTS: usize = 24;
const NEARBY: f64 = 0.3;
/// What guards are compared with then, by what they are compared with otherwise.
pub(super) const LOOSE: f64 = NEAR / denavit_program::solver::GUARD;
/// How far it may move a branch that is a solution already, but only just: between two that nearly coincide.
const FAR: f64 = 0.2;
/// A slide this many lengths of the arm away is known to fewer digits than the equations are.
const FAR_OUT: f64 = 16.0;
/// How far Newton's method may move a member of a family that was found with loose guards.
pub(super) const SHORT: f64 = 1e-5;

impl InverseModel {
    /// The solver for code that gets poses as they come: a rotation that is rounded stands for the one nearest to it.
    pub fn rounding_solver(&self) -> Solver {
        compile::rounding(self)
    }

    /// The compiled steps with the numbers of a robot.
    pub(in crate::inverse) fn function(
        &self,
        description: &Description,
        robot: &Robot<f64>,
    ) -> Result<SolverFunction, MissingValue> {
        let usual = inputs(robot, self.goal, &self.given, &somewhere(robot));
        let compiled = self.compiled.solver.compile_with(|s| description.value(s))?;
        Ok(compiled.with_usual_guards(usual.iter().map(Vec::as_slice)))
    }

    /// The solver for the numbers of a robot: those of the description that the model was derived from, or others with
    /// the same zeros and angles.
    ///
    /// # Errors
    /// If a parameter has no value.
    pub fn solver(&self, description: &Description) -> Result<InverseSolver, MissingValue> {
        let robot = Robot::numeric(description)?;
        let value = |s: Symbol| description.value(s);
        let anywhere = somewhere(&robot);
        let size = robot.reach().max(f64::MIN_POSITIVE);
        let seen = |q: &Vec<f64>| newton::least_seen(&robot, self.goal, q, &self.given, size);
        let seen = anywhere.iter().map(seen).fold(0.0, f64::max).min(1.0);
        let usual = inputs(&robot, self.goal, &self.given, &anywhere);
        let usual = || usual.iter().map(Vec::as_slice);
        let function = self.function(description, &robot)?;
        let nearest =
            compile::without_residual(self).compile_with(value)?.with_usual_guards(usual()).scalar();
        let facts = |steps: &[Step], labels: &[Option<Label>]| -> Vec<NodeFacts> {
            let pairs = steps.iter().zip(labels);
            pairs
                .map(|(s, label)| NodeFacts {
                    offset: self
                        .chain
                        .unknown_expr(s.unknown)
                        .eval(|v| value(v).or(Some(0.0)))
                        .unwrap_or(0.0),
                    terms: self.chain.unknown_terms(s.unknown),
                    unknown: self.chain.describe(s.unknown),
                    is_angle: matches!(s.unknown, Unknown::Angle(_)),
                    label: *label,
                })
                .collect()
        };
        let nodes = facts(&self.steps, &self.labels);
        let variant = |v: &Variant| VariantSolver { step: v.step, nodes: facts(&v.steps, &v.labels) };
        let scalar =
            |v: &Variant| Ok(v.compiled.solver.compile_with(value)?.with_usual_guards(usual()).scalar());
        let variants = self.variants.iter().map(variant).collect();
        let memory = Memory {
            scalar: function.scalar(),
            nearest,
            variants: self.variants.iter().map(scalar).collect::<Result<_, MissingValue>>()?,
        };
        let mut space = JointSpace::new(description, &robot);
        space.turning.keep(&self.given);
        let conditions = self
            .conditions
            .iter()
            .map(|c| NumericCondition::new(&self.chain, c, self.condition_text(c), value))
            .collect();
        let number = |e: Expr| e.eval(value).unwrap_or(f64::NAN);
        Ok(InverseSolver {
            variants,
            memory: Shared::new(memory),
            conditions,
            base: self.chain.base.map(number),
            tool: self.chain.tool.map(number),
            function,
            robot,
            seen,
            goal: self.goal,
            given: self.given.clone(),
            space,
            nodes,
        })
    }
}

/// Some configurations like any other.
fn somewhere(robot: &Robot<f64>) -> Vec<Vec<f64>> {
    const CONFIGURATIONS: usize = 8;
    let mut random = Random(2);
    let size = robot.reach();
    (0..CONFIGURATIONS)
        .map(|_| {
            let mut q = vec![0.0; robot.joints];
            q.iter_mut().for_each(|x| *x = size * (random.unit() - 0.5));
            let turning = robot.links.iter().flat_map(|l| &l.theta.terms).map(|t| t.0);
            turning.for_each(|j| q[j] = TAU * random.unit());
            q
        })
        .collect()
}

/// The inputs of a solver at configurations.
fn inputs(robot: &Robot<f64>, goal: Goal, given: &[usize], all: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let one = |q: &Vec<f64>| {
        let given: Vec<f64> = given.iter().map(|&j| q[j]).collect();
        variables(goal, &robot.pose(q), &given)
    };
    all.iter().map(one).collect()
}

/// The entries of a pose that a goal gives, in the order of [`Inputs`](crate::inverse::derivation::Inputs), then the given joint variables.
pub fn variables(goal: Goal, pose: &Transform<f64>, given: &[f64]) -> Vec<f64> {
    let m = pose.matrix();
    let wanted = |k: &usize| match goal {
        Goal::Pose => true,
        Goal::Position => k % 4 == 3,
        Goal::PositionAndAxis => k % 4 >= 2,
    };
    (0..12).filter(wanted).map(|k| m[k / 4][k % 4]).chain(given.iter().copied()).collect()
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
    ///
    /// A pose is taken to be as precise as its rotation is orthonormal: the nearest rotation is meant, and solutions may
    /// miss the pose by as much.
    pub fn solve(&self, pose: &Transform<f64>, given: &[f64]) -> Answer {
        assert_eq!(given.len(), self.given.len(), "one value per given joint");
        let (pose, mut solving) = self.at(pose);
        let mut answer = solving.solve(&pose, given);
        answer.spread(&self.space);
        let size = solving.size(&pose);
        answer.judge(|q| newton::distance(&self.robot, self.goal, &pose, q, size));
        // Where rounding is large, what looks like a family need not be one.
        let found = answer.families.len();
        let tolerance = 16.0 * solving.tolerance;
        answer.families.retain(|f| f.representative.residual <= tolerance);
        if answer.families.len() < found {
            answer.doubt = answer.doubt.or(Some(Doubt::Sampled));
        }
        answer
    }

    /// The unknown of a node at a configuration: cosine and sine, or the displacement.
    pub(super) fn value_at(&self, node: usize, q: &[f64]) -> [f64; 2] {
        let facts = &self.nodes[node];
        let x: f64 = facts.offset + facts.terms.iter().map(|&(j, k)| k * q[j]).sum::<f64>();
        if facts.is_angle { [x.cos(), x.sin()] } else { [x, 0.0] }
    }

    /// The rigid pose that is meant, and what solves it.
    pub(super) fn at(&self, pose: &Transform<f64>) -> (Transform<f64>, Solving<'_>) {
        let (pose, defect) = newton::nearest_rigid(pose);
        let tolerance = (4.0 * defect).clamp(TOLERANCE, ROUNDED);
        (pose, Solving { solver: self, memory: self.memory.lend(), tolerance })
    }
}

impl Solving<'_> {
    fn solve(&mut self, pose: &Transform<f64>, given: &[f64]) -> Answer {
        let solver = self.solver;
        let variables = variables(self.goal, pose, given);
        let mut answer = Answer::empty();
        let leaves = self.memory.scalar.solve(&variables, &[]);
        let met = leaves.met_free();
        let near = leaves.lost_guard() < BESIDE || leaves.iter().any(|l| l.free == 0 && l.guard < BESIDE);
        let mut found: Vec<(Solution, u64)> = vec![];
        // Where rounding grows, it may hide other solutions.
        let near = near || self.tolerance <= TOLERANCE && leaves.iter().any(|l| l.residual > GROWN);
        for leaf in leaves.iter() {
            found.push((draft(&solver.nodes, &leaf), leaf.free));
        }
        for (mut s, free) in found {
            if free == 0 && self.improve(pose, &mut s) {
                self.add(&mut answer.solutions, s);
            }
        }
        // What Newton's method does not bring all the way lies beside a root that it does not find.
        let is_rough = |s: &Solution| s.residual > ROUGH && self.tolerance <= TOLERANCE;
        let near = near || answer.solutions.iter().any(|s| is_rough(s) || self.is_beside(&s.q));
        if met != 0 || near || !answer.is_reachable() {
            // Where roots coincide they are known to the square root of a rounding error only, and so are the guards
            // of what follows.
            let loose = met | self.memory.scalar.solve_loosely(&variables, &[], LOOSE).met_free();
            let loose = loose & !self.other_ways(pose, &variables, loose, &mut answer);
            if loose != 0 {
                self.families(pose, given, loose, &mut answer);
                self.absorb(pose, given, &mut answer);
            }
            let starts = self.nearest(pose, &variables, loose);
            if loose != 0 {
                self.search_on(pose, given, &starts, &mut answer);
            }
            if !answer.is_reachable() {
                self.approach(pose, &variables, &starts, &mut answer);
            }
            let is_lost = !answer.is_reachable() && !self.is_excluded(pose);
            if met != 0 || near || is_lost {
                self.confirm(pose, (&variables, given), &starts, &mut answer);
                if answer.solutions.iter().any(|s| self.is_blurred(s)) {
                    answer.doubt = Some(Doubt::Sampled);
                }
                if answer.is_reachable() {
                    answer.obstacle = None;
                } else if (met != 0 || near) && is_lost {
                    answer.doubt = Some(Doubt::Sampled);
                }
            }
        }
        answer
    }

    /// True if the hand hardly sees some motion of the joints: other solutions may be near, or far along that motion.
    pub(super) fn is_beside(&self, q: &[f64]) -> bool {
        let size = self.space.length();
        newton::least_seen(&self.robot, self.goal, q, &self.given, size) < BESIDE * self.seen
    }

    /// Polishes a leaf that is not a solution yet; false if it does not become one nearby.
    pub(super) fn improve(&self, pose: &Transform<f64>, s: &mut Solution) -> bool {
        self.improve_within(pose, s, FAR)
    }

    /// The same; what is a solution already moves by `most` (radians, and lengths by the reach) at most.
    pub(super) fn improve_within(&self, pose: &Transform<f64>, s: &mut Solution, most: f64) -> bool {
        if s.residual > ROUGH {
            let polished = newton::polish(&self.robot, self.goal, pose, &s.q, &self.given, self.size(pose));
            if let Some((q, residual)) = polished
                && residual < s.residual
                && (s.residual > self.tolerance || norm(&self.space.way(&s.q, &q)) <= most)
            {
                (s.q, s.residual) = (q, residual);
            }
        }
        self.space.wrap(&mut s.q);
        s.within_limits = self.space.within(&s.q);
        let is_far = |(x, &is_angle): (&f64, &bool)| !is_angle && x.abs() > FAR_OUT * self.space.length();
        if s.q.iter().zip(&self.space.is_angle).any(is_far) {
            // The equations have the displacement; what is returned has its rounding.
            s.residual = newton::distance(&self.robot, self.goal, pose, &s.q, self.size(pose));
        }
        s.residual <= self.tolerance
    }

    /// True if no configuration can have a pose, whatever rounding did to the branches: it is beyond the reach, or misses
    /// what all poses of the arm meet whatever the joints.
    fn is_excluded(&self, pose: &Transform<f64>) -> bool {
        let turns_only = self.space.is_angle.iter().all(|x| *x);
        let entries = self.behind_ends(pose);
        let misses =
            |c: &NumericCondition| self.relative(c, c.miss(&entries, &[]), pose) > 16.0 * self.tolerance;
        turns_only && self.space.away(pose) > self.space.reach + NEAR * self.size(pose)
            || self.conditions.iter().filter(|c| c.is_of_pose()).any(misses)
    }

    /// The entries of a pose without what stands before the first axis and behind the last one.
    fn behind_ends(&self, pose: &Transform<f64>) -> [f64; 12] {
        let m = (self.base.inverse() * *pose * self.tool.inverse()).matrix();
        std::array::from_fn(|k| m[k / 4][k % 4])
    }

    /// What a condition is missed by, lengths by the size.
    fn relative(&self, c: &NumericCondition, miss: f64, pose: &Transform<f64>) -> f64 {
        miss.abs() / self.size(pose).powi(i32::from(c.degree))
    }

    /// The conditions that a pose does not meet, by joint variables that come near.
    fn violated(&self, pose: &Transform<f64>, q: &[f64]) -> Vec<(String, f64)> {
        let entries = self.behind_ends(pose);
        let mut found: Vec<(String, f64, f64)> = self
            .conditions
            .iter()
            .map(|c| {
                let miss = c.miss(&entries, q);
                (c.text.clone(), miss, self.relative(c, miss, pose))
            })
            .filter(|c| c.2 > self.tolerance)
            .collect();
        found.sort_by(|a, b| b.2.total_cmp(&a.2));
        found.into_iter().map(|(text, miss, _)| (text, miss)).collect()
    }

    pub(super) fn size(&self, pose: &Transform<f64>) -> f64 {
        self.space.size(pose)
    }

    /// Adds a solution, or counts it with one that is the same.
    pub(super) fn add(&self, solutions: &mut Vec<Solution>, s: Solution) {
        match solutions.iter_mut().find(|t| self.space.is_same(&t.q, &s.q)) {
            Some(t) => t.multiplicity += s.multiplicity,
            None => solutions.push(s),
        }
    }

    /// The solutions by variants of the steps in `met`; the result says which of those are settled so: their variants
    /// leave nothing open.
    fn other_ways(&mut self, pose: &Transform<f64>, variables: &[f64], met: u64, answer: &mut Answer) -> u64 {
        let mut settled = 0;
        let mut found: Vec<Solution> = vec![];
        let ways = self.solver.variants.iter().zip(&mut self.memory.variants);
        for (v, scalar) in ways.filter(|(v, _)| met >> v.step & 1 == 1) {
            if scalar.solve_loosely(variables, &[], LOOSE).met_free() != 0 {
                continue;
            }
            let leaves = scalar.solve_carefully(variables, &[]);
            found.extend(leaves.iter().map(|l| draft(&v.nodes, &l)));
            settled |= 1 << v.step;
        }
        for mut s in found {
            if self.improve(pose, &mut s) && !answer.solutions.iter().any(|t| self.space.is_same(&t.q, &s.q))
            {
                answer.solutions.push(s);
            }
        }
        settled
    }

    /// The branches however far from the pose, the nearest first; unknowns that are free are given values all round, one
    /// at a time.
    fn nearest(&mut self, pose: &Transform<f64>, variables: &[f64], met: u64) -> Vec<Solution> {
        let solver = self.solver;
        let free: Vec<usize> = (0..self.nodes.len()).filter(|i| met >> i & 1 == 1).collect();
        let mut starts: Vec<Solution> = vec![];
        let rounds: Vec<&[usize]> = if free.is_empty() { vec![&[]] } else { free.chunks(1).collect() };
        for unknown in rounds {
            let steps = if unknown.is_empty() { 1 } else { families::round(1) };
            for number in 0..steps {
                let at = self.values(unknown, steps, number);
                let leaves = self.memory.nearest.solve_loosely(variables, &at, LOOSE);
                starts.extend(leaves.iter().map(|l| draft(&solver.nodes, &l)));
            }
        }
        for s in &mut starts {
            s.residual = newton::distance(&self.robot, self.goal, pose, &s.q, self.size(pose));
        }
        starts.retain(|s| s.residual.is_finite());
        starts.sort_by(|a, b| a.residual.total_cmp(&b.residual));
        starts
    }

    /// Solutions that Newton's method finds from branches nearby: those at values of free unknowns that were not tried.
    fn search_on(&mut self, pose: &Transform<f64>, given: &[f64], starts: &[Solution], answer: &mut Answer) {
        let mut tried: Vec<Vec<f64>> = vec![];
        let near = self.tolerance..NEARBY;
        for s in starts.iter().filter(|s| near.contains(&s.residual)) {
            if tried.len() == STARTS {
                return;
            }
            if tried.iter().any(|q| norm(&self.space.way(q, &s.q)) < 0.5 * NEARBY) {
                continue;
            }
            tried.push(s.q.clone());
            let mut s = Solution { multiplicity: 1, branch: Branch::default(), ..s.clone() };
            // What converges slowly lies between two roots that nearly coincide, and is none.
            if !self.improve(pose, &mut s)
                || s.residual > 1e-3 * self.tolerance
                || answer.solutions.iter().any(|t| self.space.is_same(&t.q, &s.q))
                || self.is_in_a_family(pose, given, &answer.families, &s.q)
            {
                continue;
            }
            answer.doubt = Some(Doubt::Sampled);
            answer.solutions.push(s);
        }
    }

    /// As near as the arm comes to a pose from the best branches: what stands in the way, or a solution after all.
    fn approach(
        &mut self,
        pose: &Transform<f64>,
        variables: &[f64],
        starts: &[Solution],
        answer: &mut Answer,
    ) {
        let size = self.size(pose);
        let leaves = self.memory.scalar.solve_carefully(variables, &[]);
        let last = leaves.ended().max_by_key(|end| end.node).map(|end| end.node);
        let unknown = last.filter(|_| starts.is_empty()).map(|i| self.nodes[i].unknown.clone());
        let from: Vec<Vec<f64>> = if starts.is_empty() {
            self.anywhere(pose, variables, STARTS)
        } else {
            starts.iter().take(STARTS).map(|s| s.q.clone()).collect()
        };
        let near = from
            .iter()
            .filter_map(|q| newton::approach(&self.robot, self.goal, pose, q, &self.given, size))
            .min_by(|a, b| a.1.total_cmp(&b.1));
        let Some((q, residual)) = near else { return };
        let mut s = Solution::found(q, residual, true);
        if self.improve(pose, &mut s) {
            answer.doubt = Some(Doubt::Sampled);
            answer.solutions.push(s);
            return;
        }
        let (angle, distance) = newton::gap(&self.robot, self.goal, pose, &s.q);
        let violated = self.violated(pose, &s.q);
        answer.obstacle = Some(Obstacle { unknown, q: s.q, angle, distance, violated });
    }

    /// Configurations all over the arm, with the joints that are given where they are.
    pub(super) fn anywhere(&self, pose: &Transform<f64>, variables: &[f64], count: usize) -> Vec<Vec<f64>> {
        let mut random = Random(1);
        let size = self.size(pose);
        let first = variables.len() - self.given.len();
        (0..count)
            .map(|_| {
                let mut q = self.space.anywhere(&mut random, size);
                for (k, &j) in self.given.iter().enumerate() {
                    q[j] = variables[first + k];
                }
                q
            })
            .collect()
    }
}

pub(super) fn draft(nodes: &[NodeFacts], leaf: &Leaf) -> Solution {
    // What is free has no root of its own.
    let label = |(i, n): (usize, &NodeFacts)| n.label.filter(|_| leaf.free >> i & 1 == 0);
    let branch = Branch::of_signs(nodes.iter().enumerate().map(label), leaf.signs);
    Solution {
        q: leaf.outputs.to_vec(),
        residual: leaf.residual,
        branch,
        multiplicity: leaf.multiplicity,
        within_limits: true,
        guard: leaf.guard,
    }
}
