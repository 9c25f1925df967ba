//! The inverse function: its words, and vectors from the solver's evaluator, each solution checked by the forward
//! model in extended precision.

use super::PackageOptions;
use super::forward::{ends, traced};
use super::samples::{self, Sample};
use super::words::text;
use denavit::description::{Description, JointKind};
use denavit::geometry::{Rotation, Transform, Vector};
use denavit::inverse::derivation::Unknown;
use denavit::inverse::{Goal, InverseModel, JointSpace, Refusal, variables};
use denavit::robot::Robot;
use denavit_emit::{Certificate, KnownSolution, Language, Precision, SolverRoutine, SolverVector};
use denavit_program::solver::{BESIDE, SAME, Solver, SolverScalar, may_hide};
use denavit_program::{Extended, Program};
use denavit_symbolic::{Expr, Symbol};
use std::f64::consts::TAU;

/// Room for solutions by elimination: that many an arm has at most where none are double.
pub(crate) const MAX: usize = 16;

/// What is known of a generated inverse function.
#[derive(Clone, Debug)]
pub struct Inverse {
    /// True if it is no closed form: the joints are eliminated with numbers.
    pub by_elimination: bool,
    /// The largest number of solutions.
    pub max_solutions: usize,
    /// What its branches are called: shoulder, elbow, wrist.
    pub branches: Vec<String>,
    /// The joint variables that are given beside the pose.
    pub given: Vec<Symbol>,
    /// True if the derivation chose them.
    pub given_by_choice: bool,
    /// Parameters whose values are part of the closed form: those that are 0, and angles.
    pub assumed: Vec<(Symbol, Expr)>,
    /// Poses in the test.
    pub vectors: usize,
}

impl Inverse {
    /// `8 solutions`.
    pub fn at_most(&self) -> String {
        let n = self.max_solutions;
        format!("{n} solution{}", if n == 1 { "" } else { "s" })
    }
}

/// An inverse function.
pub(super) struct Closed {
    model: InverseModel,
    /// Takes rounded rotations, too.
    solver: Solver,
    usual: Vec<f64>,
    ends: [String; 2],
    facts: Inverse,
    vectors: Vec<SolverVector>,
    /// What the function is called.
    name: &'static str,
}

impl Closed {
    /// Derives it.
    pub fn new(d: &Description, options: &PackageOptions) -> Result<Self, Refusal> {
        let model = InverseModel::derive(d, &options.inverse)?;
        let occurs = |s: Symbol| {
            let cells = d.rows.iter().flat_map(|r| [r.theta, r.d, r.a, r.alpha, r.gamma, r.b]);
            let fixed = [d.base, d.tool].into_iter().flat_map(|x| x.matrix()).flatten();
            cells.chain(fixed).any(|e| e.symbols().contains(&s))
        };
        let is_left = |s: Symbol| model.description.parameter(s).is_some();
        let assumed: Vec<(Symbol, Expr)> = d
            .parameters
            .iter()
            .filter(|p| occurs(p.symbol) && !is_left(p.symbol))
            .filter_map(|p| Some((p.symbol, p.value?)))
            .collect();
        let is_single = options.precision == Precision::Single
            && matches!(options.language, Language::C | Language::Cuda);
        let solver = model.rounding_solver();
        let mut tester = Tester::new(d, &model, &solver, &assumed, is_single);
        let vectors = tester.vectors(d);
        let usual = tester.usual;
        let facts = Inverse {
            by_elimination: false,
            max_solutions: model.max_solutions(),
            branches: model.labels.iter().flatten().map(ToString::to_string).collect(),
            given: model.given.iter().map(|&j| model.chain.variables[j]).collect(),
            given_by_choice: model.given_by_choice,
            assumed,
            vectors: vectors.len(),
        };
        Ok(Closed { model, solver, usual, ends: ends(d), facts, vectors, name: options.solver_name() })
    }

    /// What was derived.
    pub fn model(&self) -> &InverseModel {
        &self.model
    }

    /// What each equation finds.
    pub fn unknowns(&self) -> Vec<Unknown> {
        self.model.steps.iter().map(|step| step.unknown).collect()
    }

    /// How many roots each equation has, and what a step from one to the next adds to the number of a branch.
    pub fn strides(&self) -> Vec<[usize; 2]> {
        let mut stride = self.solver.max_solutions();
        let own = |branches: usize| {
            stride /= branches;
            [branches, stride]
        };
        self.solver.nodes.iter().map(|node| node.root.branches()).map(own).collect()
    }

    /// What a test holds it to.
    pub fn vectors(&self) -> &[SolverVector] {
        &self.vectors
    }

    /// Configurations whose poses are regular, and how many there are with the pose of each.
    pub fn regular(&self) -> Vec<(Vec<f64>, usize)> {
        let is_regular = |v: &&SolverVector| {
            v.certificate == Certificate::Complete
                && v.solutions.iter().all(|s| s.multiplicity == 1 && s.free == 0)
        };
        let known = |v: &SolverVector| Some((v.solutions.first()?.results.clone(), v.solutions.len()));
        self.vectors.iter().filter(is_regular).filter_map(known).collect()
    }

    /// What is known of it.
    pub fn facts(&self) -> Inverse {
        self.facts.clone()
    }

    /// Lines for the head of each file.
    pub fn header(&self) -> Vec<String> {
        let branches = match &self.facts.branches[..] {
            [] => String::new(),
            all => format!(" ({})", all.join(", ")),
        };
        let mut lines = vec![format!(
            "{}: closed form, at most {}{branches}. The code puts each into the forward model, and returns how far \
             it is from the pose. A certificate says whether these are all.",
            self.name,
            self.facts.at_most()
        )];
        lines.extend(self.condition());
        lines
    }

    /// What it takes for granted.
    fn condition(&self) -> Option<String> {
        let values = self.facts.assumed.iter().map(|(s, e)| format!("{} = {}", s.name(), text(*e)));
        let values: Vec<String> = values.collect();
        (!values.is_empty()).then(|| {
            format!(
                "{} holds for {} only; what the parameters say of them is not read.",
                self.name,
                values.join(", ")
            )
        })
    }

    /// What joints with gears do to the results.
    fn gears(&self) -> Vec<String> {
        let JointSpace { is_angle, turning, .. } = JointSpace::without_lengths(&self.model.description);
        let names: Vec<String> = self.model.chain.variables.iter().map(|s| s.name().to_string()).collect();
        let turns = |x: f64| {
            let text = format!("{:.6}", x / TAU);
            text.trim_end_matches('0').trim_end_matches('.').to_string()
        };
        let geared = (0..names.len()).filter(|&j| is_angle[j] && turning.periods[j] != TAU);
        let periods: Vec<String> =
            geared.map(|j| format!("{} every {} turns", names[j], turns(turning.periods[j]))).collect();
        let mut lines = vec![];
        if !periods.is_empty() {
            lines.push(format!("Joints with gears: all links come back with {}.", periods.join(", ")));
        }
        if !turning.copies.is_empty() {
            let copy =
                |c: &Vec<f64>| format!("({})", c.iter().map(|x| turns(*x)).collect::<Vec<_>>().join(", "));
            let copies: Vec<String> = turning.copies.iter().map(copy).collect();
            lines.push(format!(
                "Each result stands for {} configurations: the others follow by adding, in turns of {}, {}.",
                copies.len() + 1,
                names.join(", "),
                copies.join(", ")
            ));
        }
        lines
    }

    /// With words and vectors.
    pub fn routine(&self) -> SolverRoutine<'_> {
        let [to, from] = &self.ends;
        let (what, input, argument, shape) = match self.model.goal {
            Goal::Pose => (
                format!("{to} has a pose in {from}"),
                "the first three rows of the homogeneous matrix, row by row: rotation (no unit), position (m)",
                "pose",
                vec![3, 4],
            ),
            Goal::Position => (
                format!("the origin of {to} has a position in {from}"),
                "the position (m)",
                "position",
                vec![3],
            ),
            Goal::PositionAndAxis => (
                format!("the origin of {to} has a position and its z axis a direction in {from}"),
                "for x, y and z in turn the component of the z axis (no unit) and of the position (m)",
                "goal",
                vec![3, 2],
            ),
        };
        let all = |list: &[Symbol]| list.iter().map(|s| s.name().to_string()).collect::<Vec<_>>().join(", ");
        let mut about = vec![format!("Inverse kinematics: all joint variables with which {what}.")];
        let count: usize = shape.iter().product();
        let (argument, shape) = if self.facts.given.is_empty() {
            about.push(format!("Given: {input}."));
            (argument, shape)
        } else {
            about.push(format!("Given: {input}; then {}.", all(&self.facts.given)));
            ("goal", vec![count + self.facts.given.len()])
        };
        about.push(format!(
            "The results: {}; angles in rad from -pi to pi, displacements in m. Limits are not looked at.",
            all(&self.model.chain.variables)
        ));
        about.extend(self.gears());
        if self.model.goal == Goal::Pose && self.model.rank < 6 {
            about.push(format!(
                "The arm moves its hand in {} directions only; other poses have no solution.",
                self.model.rank
            ));
        }
        about.extend(self.condition());
        about.push(
            "Where a pose leaves an unknown free, a family solves it; its member with 0 there is given."
                .into(),
        );
        SolverRoutine {
            name: self.name.into(),
            about,
            solver: &self.solver,
            usual: self.usual.clone(),
            argument: argument.into(),
            shape,
            result: "q".into(),
            vectors: self.vectors.clone(),
        }
    }
}

/// Finds what a test holds the function to.
struct Tester<'a> {
    model: &'a InverseModel,
    solver: SolverScalar,
    usual: Vec<f64>,
    has_rotation: bool,
    is_angle: Vec<bool>,
    /// The plain product of the link transforms, rows 1 to 3.
    product: Program,
    /// Values of the parameters in the product and in the library.
    exact: Vec<(Symbol, f64)>,
    parameters: Vec<f64>,
}

/// A residual above this is no clean solution.
const CLEAN: f64 = 1e-11;
/// How far entries of a pose are moved to see what rounding does.
const NUDGES: [f64; 8] = [2e-16, -2e-16, 4e-16, -4e-16, 8e-16, -8e-16, 1.2e-15, -1.2e-15];
/// How much more than that is allowed.
const FACTOR: f64 = 64.0;
/// How many poses are rounded, and by how much more than they the solutions may differ.
const ROUNDED: usize = 3;
const MAGNIFIED: f64 = 1e3;
/// The largest tolerance of a vector.
const LOOSEST: f64 = 1e-5;

impl<'a> Tester<'a> {
    fn new(
        d: &Description,
        model: &'a InverseModel,
        solver: &Solver,
        assumed: &[(Symbol, Expr)],
        is_single: bool,
    ) -> Self {
        let values = samples::parameters(d);
        let parameters: Vec<f64> =
            values.iter().map(|&x| if is_single { f64::from(x as f32) } else { x }).collect();
        let is_assumed = |s: Symbol| assumed.iter().any(|a| a.0 == s);
        let symbols: Vec<Symbol> = d.parameters.iter().map(|p| p.symbol).collect();
        let both = symbols.iter().zip(values.iter().zip(&parameters));
        let exact: Vec<(Symbol, f64)> =
            both.map(|(&s, (&x, &rounded))| (s, if is_assumed(s) { x } else { rounded })).collect();
        let value = |s: &Symbol| exact.iter().find(|e| e.0 == *s).map_or(0.0, |e| e.1);
        let own: Vec<f64> = solver.parameters.iter().map(value).collect();
        let function = solver.compile(&own);
        let q: Vec<Symbol> = d.variables().iter().map(|v| v.symbol).collect();
        let of: Vec<Expr> = q.iter().map(|s| (*s).into()).collect();
        let rows = Robot::symbolic(d).pose(&of).matrix();
        let product: Vec<Expr> = rows.into_iter().take(3).flatten().collect();
        let mut tester = Tester {
            solver: function.scalar(),
            usual: vec![],
            has_rotation: solver.defect.is_some(),
            is_angle: d.variables().iter().map(|v| v.kind == JointKind::Revolute).collect(),
            product: traced(&q, &symbols, &product),
            model,
            exact,
            parameters,
        };
        let some: Vec<Vec<f64>> =
            samples::few(d).iter().map(|s| tester.goal(&tester.pose(&s.variables), &s.variables)).collect();
        let function = function.with_usual_guards(some.iter().map(Vec::as_slice));
        (tester.solver, tester.usual) = (function.scalar(), function.usual_guards());
        tester
    }

    /// Zero, quarter turns, random configurations, random ones with a joint at zero, rounded poses, a pose out of reach, and
    /// a matrix that is no rotation.
    fn vectors(&mut self, d: &Description) -> Vec<SolverVector> {
        let mut all = samples::few(d);
        let last = all.len().saturating_sub(ROUNDED);
        let far: Option<SolverVector> = all.last().and_then(|s| self.unreachable(s));
        let none: Option<SolverVector> = all.last().and_then(|s| self.no_pose(s));
        let rounded: Vec<SolverVector> = all[last..].iter().filter_map(|s| self.rounded(s)).collect();
        all.extend(samples::special(d));
        let mut found: Vec<SolverVector> = all.iter().filter_map(|s| self.vector(s)).collect();
        found.extend(rounded.into_iter().chain(far).chain(none));
        found
    }

    /// The pose of a configuration, and all solutions; nothing if rounding decides how many there are.
    fn vector(&mut self, sample: &Sample) -> Option<SolverVector> {
        let variables = self.goal(&self.pose(&sample.variables), &sample.variables);
        self.vector_at(sample, variables, 0.0)
    }

    /// The same of the pose in six decimals; nothing if the goal has no rotation.
    fn rounded(&mut self, sample: &Sample) -> Option<SolverVector> {
        const DECIMALS: f64 = 1e6;
        self.has_rotation.then_some(())?;
        let q = &sample.variables;
        let units = std::iter::repeat([1.0, 1.0, 1.0, samples::unit(sample.reach)]).flatten();
        let round = |(x, unit): (&f64, f64)| (x / unit * DECIMALS).round() / DECIMALS * unit;
        let pose: Vec<f64> = self.pose(q).iter().zip(units).map(round).collect();
        self.vector_at(sample, self.goal(&pose, q), 1.0 / DECIMALS)
    }

    /// The same of variables that are off by `off` from those of the configuration.
    fn vector_at(&mut self, sample: &Sample, variables: Vec<f64>, off: f64) -> Option<SolverVector> {
        let q = &sample.variables;
        let (known, certificate) = self.solutions(&variables)?;
        let mut moved = 0.0_f64;
        let units = self.units(samples::unit(sample.reach));
        for (k, nudge) in NUDGES.into_iter().enumerate() {
            let signs = |i: usize| if (i * (2 * k + 3) + k).is_multiple_of(3) { -nudge } else { nudge };
            let by = |(i, x): (usize, &f64)| x + signs(i) * x.abs().max(units[i]);
            let nudged: Vec<f64> = variables.iter().enumerate().map(by).collect();
            let (others, same) = self.solutions(&nudged)?;
            moved = moved.max(self.apart(&known, &others).filter(|_| same == certificate)?);
        }
        let size = sample.reach.max(1.0);
        let tolerance = 1e-12 * size + FACTOR * moved;
        let is_known =
            |s: &KnownSolution| self.distance(&s.results, q) <= tolerance.max(SAME).max(MAGNIFIED * off);
        let holds = known.iter().any(|s| s.free != 0 || is_known(s))
            && known.iter().all(|s| self.reaches(&variables, &s.results, size.max(1e11 * off)));
        let is_clear = tolerance <= LOOSEST && self.are_apart(&known, tolerance);
        (holds && is_clear).then(|| SolverVector {
            variables,
            parameters: self.parameters.clone(),
            solutions: known,
            certificate,
            tolerance,
        })
    }

    /// A pose far outside, if it has no solution.
    fn unreachable(&mut self, sample: &Sample) -> Option<SolverVector> {
        let q = &sample.variables;
        let mut pose = self.pose(q);
        pose[3] += 8.0 * sample.reach + 8.0 * samples::unit(sample.reach);
        let variables = self.goal(&pose, q);
        let (solutions, certificate) = self.solutions(&variables)?;
        let parameters = self.parameters.clone();
        let vector = SolverVector { variables, parameters, solutions, certificate, tolerance: 1e-9 };
        vector.solutions.is_empty().then_some(vector)
    }

    /// A pose whose rotation is stretched by a thousandth.
    fn no_pose(&self, sample: &Sample) -> Option<SolverVector> {
        self.has_rotation.then_some(())?;
        let pose: Vec<f64> = self.pose(&sample.variables).iter().map(|x| 1.001 * x).collect();
        Some(SolverVector {
            variables: self.goal(&pose, &sample.variables),
            parameters: self.parameters.clone(),
            solutions: vec![],
            certificate: Certificate::NotAPose,
            tolerance: 1e-9,
        })
    }

    /// Rows 1 to 3 of the pose, rounded from extended precision.
    fn pose(&self, q: &[f64]) -> Vec<f64> {
        let value = |s: Symbol| {
            let variable = self.product.variables().iter().position(|x| *x == s).map(|k| q[k]);
            let x = variable.or_else(|| self.exact.iter().find(|e| e.0 == s).map(|e| e.1))?;
            Some(Extended::from(x))
        };
        let exact = self.product.eval(value);
        exact.expect("a sample has a value for every input").iter().map(Extended::to_f64).collect()
    }

    /// What the solver takes of a pose and a configuration.
    fn goal(&self, pose: &[f64], q: &[f64]) -> Vec<f64> {
        let r = std::array::from_fn(|i| std::array::from_fn(|j| pose[4 * i + j]));
        let p = Vector(std::array::from_fn(|i| pose[4 * i + 3]));
        let pose = Transform::from_rotation_translation(Rotation::from_rows(r), p);
        let given: Vec<f64> = self.model.given.iter().map(|&j| q[j]).collect();
        variables(self.model.goal, &pose, &given)
    }

    /// What the solver's inputs are measured in: 1, or the unit of lengths.
    fn units(&self, unit: f64) -> Vec<f64> {
        let pose: Vec<f64> = (0..12).map(|k| if k % 4 == 3 { unit } else { 1.0 }).collect();
        let joints: Vec<f64> =
            self.is_angle.iter().map(|is_angle| if *is_angle { 1.0 } else { unit }).collect();
        self.goal(&pose, &joints)
    }

    /// All solutions, and whether there may be more; nothing if some are not clean.
    fn solutions(&mut self, variables: &[f64]) -> Option<(Vec<KnownSolution>, Certificate)> {
        let leaves = self.solver.solve_carefully(variables, &[]);
        let is_near = may_hide(self.usual.iter().copied())
            || leaves.met_free() != 0
            || leaves.lost_guard() < BESIDE
            || leaves.iter().any(|l| l.free != 0 || l.guard < BESIDE);
        let certificate = if is_near { Certificate::Singular } else { Certificate::Complete };
        let known = |leaf: denavit_program::solver::Leaf| {
            (leaf.residual <= CLEAN).then(|| KnownSolution {
                results: leaf.outputs.to_vec(),
                multiplicity: leaf.multiplicity,
                free: leaf.free as u32,
            })
        };
        let known: Option<Vec<KnownSolution>> = leaves.iter().map(known).collect();
        Some((known?, certificate))
    }

    /// How far the solutions of a pose are from the same ones of another; nothing if they are others.
    fn apart(&self, known: &[KnownSolution], others: &[KnownSolution]) -> Option<f64> {
        if known.len() != others.len() {
            return None;
        }
        let nearest = |s: &KnownSolution| {
            let alike = others.iter().filter(|t| t.multiplicity == s.multiplicity && t.free == s.free);
            alike.map(|t| self.distance(&s.results, &t.results)).min_by(f64::total_cmp)
        };
        known.iter().map(nearest).try_fold(0.0_f64, |most, x| Some(most.max(x?)))
    }

    /// The largest difference of two configurations, angles modulo 2π.
    fn distance(&self, a: &[f64], b: &[f64]) -> f64 {
        let each = a.iter().zip(b).zip(&self.is_angle).map(|((x, y), &is_angle)| {
            let d = x - y;
            (if is_angle { d - TAU * (d / TAU).round() } else { d }).abs()
        });
        each.fold(0.0, f64::max)
    }

    /// Whether solutions are farther apart than what they are allowed to be off.
    fn are_apart(&self, known: &[KnownSolution], tolerance: f64) -> bool {
        let pair = |i: usize, s: &KnownSolution| {
            known[..i].iter().all(|t| self.distance(&s.results, &t.results) > 4.0 * tolerance)
        };
        known.iter().enumerate().all(|(i, s)| pair(i, s))
    }

    /// Whether the forward model brings a solution to the pose.
    fn reaches(&self, variables: &[f64], q: &[f64], size: f64) -> bool {
        let found = self.goal(&self.pose(q), q);
        found.iter().zip(variables).all(|(x, y)| (x - y).abs() <= 1e-10 * size)
    }
}
