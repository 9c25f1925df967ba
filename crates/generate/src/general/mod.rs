//! The inverse function of an arm with six joints and no closed form: elimination, in every language but CUDA.
//!
//! Rust embeds the files of the crate `denavit-elimination` as they are; C and JavaScript have the same algorithm in `general/*.c`
//! and `general/javascript`, Python and MATLAB in folders of their names, over arrays.

mod c;
mod javascript;
mod matlab;
mod python;
mod rust;

use super::PackageOptions;
use super::inverse::{Inverse, MAX};
use super::samples::{self, Sample};
use super::words::text;
use denavit::description::{Description, JointKind};
use denavit::geometry::Transform;
use denavit::inverse::general::{GeneralSolver, SixAxes};
use denavit::inverse::{Answer, Goal};
use denavit::robot::Robot;
use denavit::space::JointSpace;
use denavit_elimination::{Plan, Tables};
use denavit_emit::{Attachment, Language};
use denavit_symbolic::{Expr, Symbol};

/// What C takes of the stack; a test holds it to that.
const STACK: &str = "Stack as gcc 12 compiles it for x86-64 and Cortex-M7, that of libm aside: at most 11.5 kB in solve, 13.5 kB in ik \
                     and 16 kB in ik_nearest and ik_all_within_limits, at their worst poses (21 kB with AVX-512). No heap, \
                     and no static data that changes: calls may run at the same time.";

/// An inverse function by elimination.
pub(super) struct General {
    language: Language,
    axes: SixAxes,
    plan: Plan,
    /// What languages other than Rust print.
    tables: Option<Tables>,
    is_angle: [bool; 6],
    /// What lengths are compared with, metres.
    unit: f64,
    /// What the function is about, without comment signs.
    about: Vec<String>,
    facts: Inverse,
    pub vectors: Vec<Vector>,
}

/// A pose, a configuration that has it, and all configurations that have it.
pub(super) struct Vector {
    /// Rows 1 to 3.
    pub pose: [[f64; 4]; 3],
    configuration: Option<Vec<f64>>,
    pub solutions: Vec<Vec<f64>>,
}

impl General {
    /// Measures which eliminations suit the arm.
    ///
    /// # Errors
    /// If it is not an arm for elimination; with words if it is one, but not with these options.
    pub fn new(d: &Description, options: &PackageOptions) -> Result<Self, Option<String>> {
        let variables = d.variables();
        if variables.len() != 6 || options.inverse.goal != Goal::Pose || options.inverse.given.is_some() {
            return Err(None);
        }
        let robot = Robot::numeric(d).map_err(|missing| {
            Some(format!("elimination computes with the values of parameters: {missing}"))
        })?;
        let space = JointSpace::new(d, &robot);
        let is_geared = |j: usize| space.is_angle[j] && space.turning.periods[j] != std::f64::consts::TAU;
        if (0..variables.len()).any(is_geared) || !space.turning.copies.is_empty() {
            return Err(Some(
                "elimination is generated for arms without gears: a whole turn of a joint must bring all links back".into(),
            ));
        }
        let solver = GeneralSolver::new(&robot, &space)
            .map_err(|why| Some(format!("nor does elimination serve the arm: {why}")))?;
        let Some((axes, plan)) = solver.parts() else {
            return Err(Some("elimination is generated for arms of six axes".into()));
        };
        let (axes, plan, tables) = (axes.clone(), plan.clone(), plan.tables());
        match options.language {
            Language::Rust => {}
            Language::C | Language::IkFast | Language::Python | Language::Matlab | Language::JavaScript
                if tables.is_some() => {}
            Language::C | Language::IkFast | Language::Python | Language::Matlab | Language::JavaScript => {
                return Err(Some(format!(
                    "elimination in {} serves arms with at most one prismatic joint; --language rust serves this one",
                    options.language.name()
                )));
            }
            Language::Cuda => {
                return Err(Some(
                    "elimination is generated in C, Rust, Python, MATLAB and JavaScript (--language ikfast is C++)"
                        .into(),
                ));
            }
        }
        let is_angle = std::array::from_fn(|j| variables[j].kind == JointKind::Revolute);
        let unit = samples::unit(space.reach);
        let vectors = Tester { robot, space, unit, solver: &solver }.vectors(d);
        let assumed = d.parameters.iter().filter_map(|p| Some((p.symbol, p.value?)));
        let facts = Inverse {
            by_elimination: true,
            max_solutions: MAX,
            branches: vec![],
            given: vec![],
            given_by_choice: false,
            assumed: assumed.collect(),
            vectors: vectors.len(),
        };
        let about = about(d, &facts.assumed);
        Ok(General { language: options.language, axes, plan, tables, is_angle, unit, about, facts, vectors })
    }

    /// What is known of it.
    pub fn facts(&self) -> Inverse {
        self.facts.clone()
    }

    /// Configurations, and how many there are with the pose of each.
    pub fn regular(&self) -> Vec<(Vec<f64>, usize)> {
        let known = |v: &Vector| Some((v.configuration.clone()?, v.solutions.len()));
        self.vectors.iter().filter_map(known).collect()
    }

    /// Lines for the head of each file.
    pub fn header(&self) -> Vec<String> {
        let mut lines = vec![format!(
            "solve: no closed form; by elimination with numbers, at most {} solutions, each polished by Newton's method on \
             the forward model.",
            MAX
        )];
        if self.language == Language::C {
            lines.push(STACK.into());
        }
        lines.extend(condition(&self.facts.assumed));
        lines
    }

    /// The function in its language.
    pub fn attachment(&self) -> Attachment {
        match (&self.tables, self.language) {
            (Some(tables), Language::C) => c::attachment(self, tables, true),
            (Some(tables), Language::IkFast) => c::attachment(self, tables, false),
            (Some(tables), Language::Python) => python::attachment(self, tables),
            (Some(tables), Language::Matlab) => matlab::attachment(self, tables),
            (Some(tables), Language::JavaScript) => javascript::attachment(self, tables),
            _ => rust::attachment(self),
        }
    }
}

/// What the values are that it holds for.
fn condition(assumed: &[(Symbol, Expr)]) -> Option<String> {
    let values: Vec<String> = assumed.iter().map(|(s, e)| format!("{} = {}", s.name(), text(*e))).collect();
    (!values.is_empty()).then(|| {
        format!("solve holds for {} only; what the parameters say of them is not read.", values.join(", "))
    })
}

fn about(d: &Description, assumed: &[(Symbol, Expr)]) -> Vec<String> {
    let [to, from] = super::forward::ends(d);
    let variables: Vec<String> = d.variables().iter().map(|v| v.symbol.name().to_string()).collect();
    let mut lines = vec![
        format!("Inverse kinematics: all joint variables with which {to} has a pose in {from}."),
        "Given: the first three rows of the homogeneous matrix, row by row: rotation (no unit), position (m).".into(),
        format!(
            "The results: {}; angles in rad from -pi to pi, displacements in m. Limits are not looked at.",
            variables.join(", ")
        ),
    ];
    lines.extend(condition(assumed));
    lines.push(
        "The loop equation is cut in two and two joints are eliminated (Raghavan and Roth 1990); the determinant that \
         remains is a trigonometric polynomial of degree 8 in another joint, whose roots give all solutions."
            .into(),
    );
    lines
}

/// Finds what the test of a package holds the function to.
struct Tester<'a> {
    robot: Robot<f64>,
    space: JointSpace,
    unit: f64,
    solver: &'a GeneralSolver,
}

/// A residual above this is no clean solution.
const CLEAN: f64 = 1e-11;
/// A smallest singular value below this magnifies rounding too much.
const SINGULAR: f64 = 1e-3;
/// How near the configuration must be to one that is found.
const SAME: f64 = 1e-9;
/// How far entries of a pose are moved to see whether as many solutions are found.
const NUDGES: [f64; 4] = [4e-16, -4e-16, 1.2e-15, -1.2e-15];

impl Tester<'_> {
    /// Special and random configurations, and a pose out of reach.
    fn vectors(&mut self, d: &Description) -> Vec<Vector> {
        let mut all = samples::samples(d);
        let far = all.last().and_then(|s| self.unreachable(s));
        all.extend(samples::special(d));
        let mut found: Vec<Vector> = all.iter().filter_map(|s| self.vector(&s.variables)).collect();
        found.extend(far);
        found
    }

    /// The pose of a configuration and all solutions; nothing if rounding decides how many there are.
    fn vector(&mut self, q: &[f64]) -> Option<Vector> {
        let pose = self.robot.pose(q);
        let solutions = self.solutions(&pose)?;
        for nudge in NUDGES {
            let mut near = pose;
            for (i, row) in near.rotation.rows().iter().enumerate() {
                near.translation.0[i] += nudge * self.unit * (1.0 + row[i].abs());
            }
            if self.solutions(&near)?.len() != solutions.len() {
                return None;
            }
        }
        let is_known = solutions.iter().any(|s| self.space.distance(s, q) < SAME);
        let configuration = Some(q.to_vec());
        is_known.then(|| Vector { pose: rows(&pose), configuration, solutions })
    }

    /// A pose far outside, if it is certain to have no solution.
    fn unreachable(&mut self, sample: &Sample) -> Option<Vector> {
        let mut pose = self.robot.pose(&sample.variables);
        pose.translation.0[0] += 8.0 * sample.reach + 8.0 * self.unit;
        let solutions = self.solutions(&pose)?;
        solutions.is_empty().then(|| Vector { pose: rows(&pose), configuration: None, solutions })
    }

    /// All solutions; nothing if these may not be all, or some are not clean.
    fn solutions(&self, pose: &Transform<f64>) -> Option<Vec<Vec<f64>>> {
        let Answer { solutions, families, doubt, .. } = self.solver.solve(pose);
        let is_clean = solutions.iter().all(|s| s.residual <= CLEAN && s.guard >= SINGULAR);
        let holds = doubt.is_none() && families.is_empty() && is_clean;
        holds.then(|| solutions.into_iter().map(|s| s.q).collect())
    }
}

/// Rows 1 to 3 of the matrix.
fn rows(pose: &Transform<f64>) -> [[f64; 4]; 3] {
    let r = pose.rotation.rows();
    std::array::from_fn(|i| [r[i][0], r[i][1], r[i][2], pose.translation.0[i]])
}
