//! IKFast's interface around the functions of C: goals of its types, answers joint by joint, families by free values.
//!
//! The interface is that of the files which IKFast generates (Diankov 2010, *Automated Construction of Robotic
//! Manipulation Programs*, ch. 4) and of the header `ikfast.h`, versions 61 and later; types and their numbers are OpenRAVE's.

mod kind;
mod test;

use super::inverse::MAX;
use super::tables::wrapped;
use super::{PackageOptions, Solver, Unable, Wanted};
use denavit::description::{Description, JointKind};
use denavit::inverse::derivation::{NormalChain, Unknown};
use denavit::robot::Robot;
use denavit::space::JointSpace;
use denavit_emit::{Attachment, File, Language, Routine};
use kind::Kind;
use std::f64::consts::TAU;

/// The functions of the interface, with the values of parameters in them; the options as they are for other languages.
///
/// # Errors
/// If other functions are wanted.
pub(super) fn completed(options: &PackageOptions) -> Result<PackageOptions, Unable> {
    let mut new = options.clone();
    if options.language == Language::IkFast {
        let functions = vec![Wanted::Pose, Wanted::Inverse];
        if let Some(other) = options.functions.iter().find(|w| !functions.contains(w)) {
            return Err(Unable::NotInInterface(*other));
        }
        (new.functions, new.fixed) = (functions, true);
    }
    Ok(new)
}

/// What is known of an arm behind the interface.
pub(super) struct Interface<'a> {
    kind: Kind,
    solver: Solver<'a>,
    /// The pose of the tool.
    pose: &'a Routine<'a>,
    robot: Robot<f64>,
    is_angle: Vec<bool>,
    /// Whether all links come back after a whole turn of a joint, and not after less.
    goes_round: Vec<bool>,
    given: Vec<usize>,
    /// What lengths are compared with, metres.
    size: f64,
    /// For each joint how many roots the equation has that finds it, and what a step of them adds to the number of a branch.
    roots: Vec<[usize; 2]>,
}

impl<'a> Interface<'a> {
    /// Finds the type of the goal.
    ///
    /// # Errors
    /// If there is none, in words.
    pub fn new(
        d: &Description,
        solver: Solver<'a>,
        pose: &'a Routine<'a>,
        size: f64,
    ) -> Result<Self, String> {
        let robot = Robot::numeric(d).map_err(|missing| missing.to_string())?;
        let (kind, given, roots) = match solver {
            Solver::Closed(closed) => {
                let model = closed.model();
                let strides = closed.strides();
                (
                    Kind::of(model, &robot)?,
                    model.given.clone(),
                    roots(&model.chain, &closed.unknowns(), &strides, &model.given),
                )
            }
            Solver::General(_) => {
                let first = [MAX, 1];
                let roots = (0..robot.joints).map(|j| if j == 0 { first } else { [1, 1] }).collect();
                (Kind::Transform, vec![], roots)
            }
        };
        let is_angle = d.variables().iter().map(|v| v.kind == JointKind::Revolute).collect();
        let turning = JointSpace::new(d, &robot).turning;
        let goes_round = turning.periods.iter().map(|p| *p == TAU).collect();
        Ok(Interface { kind, solver, pose, robot, is_angle, goes_round, given, size, roots })
    }

    /// Lines for the head of the file.
    pub fn header(&self, ends: &[String; 2]) -> Vec<String> {
        let mut lines = vec![
            String::new(),
            format!("The interface of IKFast, type {} ({}).", self.kind.name(), self.kind.number()),
            self.kind.about(ends),
        ];
        lines.extend((!self.given.is_empty()).then(|| {
            let given: Vec<String> = self.given.iter().map(usize::to_string).collect();
            format!("pfree: the values of these joints, counted from 0: {}.", given.join(", "))
        }));
        lines.extend([
            "ComputeIk adds the configurations of a goal, each once, angles from -pi to pi; limits are not looked at. These are all, \
             and false says that the arm does not reach, but for goals at singular configurations or beside them, where there \
             may be more: the interface has no place for the certificate that solve has in C and Rust."
                .into(),
            "Where two joints turn against each other with the hand still, or one turns for nothing, the solution \
             is the whole family: GetFree names the joint that is free, and others follow it (fmul, foffset). Of a family that \
             is no straight line in the joint variables, one member is added."
                .into(),
            match self.solver {
                Solver::Closed(_) => "indices[0] of a joint is the root that was taken where it was found, maxsolutions how many \
                                      there are; together they name the branch."
                    .into(),
                Solver::General(_) => "indices[0] of the first joint numbers the solutions.".into(),
            },
            "Rotations are rounded: the nearest one is meant. What is none has no solution.".into(),
            String::new(),
            "It includes the ikfast.h of the project that takes it (OpenRAVE, MoveIt, Tesseract and others have one); \
             interface/ikfast.h beside it serves its test. IKFAST_NO_MAIN, IKFAST_CLIBRARY, IKFAST_NAMESPACE and IKFAST_REAL do what \
             that header says; IKFAST_ASSERT, if it is defined, is called on whether the goal is numbers and a rotation, and nothing is \
             thrown otherwise. GetKinematicsHash is empty, so that nothing is compared with it."
                .into(),
            "C++11. What is allocated is what the interface's lists hold. Any number of threads may call at once. Never compile with \
             -ffast-math: it removes roundings that results depend on."
                .into(),
        ]);
        lines
    }

    /// The interface in C++, with its test.
    pub fn attachment(&self) -> Attachment {
        let file = |path: &str, text: &str| File { path: path.into(), text: text.into() };
        Attachment {
            name: "interface".into(),
            definitions: self.filled(include_str!("inside.cpp")),
            around: [include_str!("ahead.cpp").into(), self.filled(include_str!("behind.cpp"))],
            test: self.filled(&test::text(self)),
            files: vec![file("interface/ikfast.h", include_str!("ikfast.h"))],
            ..Attachment::default()
        }
    }

    /// A template with the facts of the arm in it.
    fn filled(&self, template: &str) -> String {
        let n = self.robot.joints;
        let rows = |list: Vec<String>| {
            let whole = list.join(", ");
            if whole.len() <= 60 { whole } else { format!("\n{}", wrapped("    ", &whole, "")) }
        };
        let each = |f: &dyn Fn(usize) -> String| rows((0..n).map(f).collect());
        let is_given = |j: usize| self.given.contains(&j);
        let given: Vec<String> = self.given.iter().map(usize::to_string).collect();
        let read_given = format!(
            "    for (int k = 0; k < {}; k++) {{\n        goal[{} + k] = static_cast<double>(pfree[k]);\n    }}\n",
            self.given.len(),
            self.kind.numbers()
        );
        let free = format!(
            "    static int joints[{}] = {{{}}};\n    return joints;\n",
            self.given.len(),
            given.join(", ")
        );
        let has_given = !self.given.is_empty();
        let rotation = self.kind.rotation_numbers();
        let (is_family, branch) = match self.solver {
            Solver::Closed(_) => ("found[s].free != 0", "found[s].branch"),
            Solver::General(_) => ("found[s].singular < 1e-6", "s"),
        };
        template
            .replace("@kind@", &self.kind.code())
            .replace("@joint_types@", &each(&|j| if self.is_angle[j] { "0x01" } else { "0x11" }.into()))
            .replace("@turns@", &each(&|j| self.is_angle[j].to_string()))
            .replace("@can_be_free@", &each(&|j| (self.goes_round[j] && !is_given(j)).to_string()))
            .replace("@is_given@", &each(&|j| is_given(j).to_string()))
            .replace("@joint_roots@", &each(&|j| self.roots[j][0].to_string()))
            .replace("@joint_strides@", &each(&|j| self.roots[j][1].to_string()))
            .replace("@is_wanted@", &self.kind.columns().map(|is| is.to_string()).join(", "))
            .replace("@near@", &format!("{:e}", 1e-9 * self.size))
            .replace("@goal_size@", &(self.kind.numbers() + self.given.len()).to_string())
            .replace("@read_given@", if has_given { &read_given } else { "    (void)pfree;\n" })
            .replace("@free_parameters@", if has_given { &free } else { "    return nullptr;\n" })
            .replace("@given_count@", &self.given.len().to_string())
            .replace("@given@", &if has_given { given.join(", ") } else { "0".into() })
            .replace("@is_family@", is_family)
            .replace("@branch@", branch)
            .replace("@type_name@", self.kind.name())
            .replace("@type@", self.kind.number())
            .replace("@arguments@", self.kind.arguments())
            .replace("@usage@", &self.kind.usage(self.given.len()))
            .replace("@arguments_count@", &(3 + rotation + self.given.len()).to_string())
            .replace("@goal_count@", &(3 + rotation).to_string())
            .replace("@rotation_count@", &rotation.to_string())
            .replace("@n@", &n.to_string())
    }
}

/// For each joint the roots of the equation that finds it, and their stride among the branches: a joint an equation, the one
/// that it is about where it is about one.
fn roots(
    chain: &NormalChain,
    unknowns: &[Unknown],
    strides: &[[usize; 2]],
    given: &[usize],
) -> Vec<[usize; 2]> {
    let joints = chain.variables.len();
    let mut all = vec![[1, 1]; joints];
    let mut is_taken: Vec<bool> = (0..joints).map(|j| given.contains(&j)).collect();
    let moved =
        |joint: usize, axes: &[usize]| chain.drivers.inverse[joint].iter().any(|(k, _)| axes.contains(k));
    for (unknown, own) in unknowns.iter().zip(strides).filter(|(_, own)| own[0] > 1) {
        let axes: Vec<usize> = match *unknown {
            Unknown::Slide(axis) => vec![axis],
            Unknown::Angle(d) => chain.axes_between(d).into_iter().map(|x| x.0).collect(),
        };
        let free = |j: &usize| !is_taken[*j];
        let near = (0..joints).filter(free).find(|&j| moved(j, &axes));
        if let Some(joint) = near.or((0..joints).find(free)) {
            is_taken[joint] = true;
            all[joint] = *own;
        }
    }
    all
}
