//! The functions in Rust: a module of the package.

use super::{Controller, SAMPLES};
use crate::Solver;
use crate::inverse::MAX;
use denavit::inverse::Goal;
use denavit_emit::{Attachment, File};

/// What the root of the package says.
const DECLARATIONS: &str = "
@feature@mod ik;
@feature@pub use ik::{
@feature@    IK_MAX, IK_ROTATION_TOLERANCE, IkChoice, IkLimits, IkResult, IkSolution, IkStatus, ik, ik_all_within_limits,
@feature@    ik_nearest,
@feature@};
";

/// The functions with their test.
pub(super) fn attachment(own: &Controller) -> Attachment {
    let feature = match own.solver {
        Solver::Closed(_) => "",
        Solver::General(_) => "#[cfg(feature = \"std\")]\n",
    };
    let mut files = vec![File { path: "src/ik.rs".into(), text: own.rust(include_str!("rust/ik.rs.txt")) }];
    if !own.known.is_empty() {
        files.push(File { path: "tests/ik.rs".into(), text: own.rust(include_str!("rust/test.rs.txt")) });
    }
    Attachment {
        name: "controller".into(),
        declarations: DECLARATIONS
            .replace("@feature@    ", "    ")
            .replace("@feature@}", "}")
            .replace("@feature@", feature),
        files,
        ..Attachment::default()
    }
}

impl Controller<'_> {
    /// A template with the facts of the arm in it.
    fn rust(&self, template: &str) -> String {
        let n = self.joints();
        let each = |f: &dyn Fn(usize) -> String| array((0..n).map(f).collect());
        let numbers = |f: &dyn Fn(usize) -> f64| each(&|j| number(f(j)));
        let has_given = !self.given.is_empty();
        let (g, p) = (self.given.len(), self.has_parameters);
        let either = |is: bool, text: &str| if is { text.to_string() } else { String::new() };
        let goal = match self.goal {
            Goal::Pose => include_str!("rust/goal_pose.rs.txt"),
            Goal::Position => include_str!("rust/goal_position.rs.txt"),
            Goal::PositionAndAxis => include_str!("rust/goal_axis.rs.txt"),
        };
        let is_closed = matches!(self.solver, Solver::Closed(_));
        let entries: Vec<String> = self.places().iter().map(|(i, j)| format!("goal[{i}][{j}]")).collect();
        let flatten = match self.goal {
            _ if has_given => {
                let given = (0..g).map(|k| format!("given[{k}]"));
                array(entries.into_iter().chain(given).collect())
            }
            Goal::Pose => "[goal[0], goal[1], goal[2]]".into(),
            Goal::Position => array(entries),
            Goal::PositionAndAxis => array(entries.chunks(2).map(|row| array(row.to_vec())).collect()),
        };
        let twist = if self.is_full { include_str!("rust/twist.rs.txt") } else { "        return None;" };
        let search = if has_given {
            include_str!("rust/search_given.rs.txt")
        } else {
            include_str!("rust/search_plain.rs.txt")
        };
        let copies = self.copies();
        let rows = |all: &[Vec<f64>]| {
            let rows = all.iter().map(|row| array(row.iter().map(|x| number(*x)).collect()));
            array(rows.collect())
        };
        // As in C, what looks like chance.
        let scattered = array((0..64).map(|k| number((1.0 + 2.4 * f64::from(k)).sin())).collect());
        let read = if has_given {
            let names: Vec<String> = self.given.iter().map(|j| format!("q[{j}]")).collect();
            format!("{}; then the values of {}", self.read(), names.join(", "))
        } else {
            self.read().to_string()
        };
        let solve_goal =
            if self.passes_rounded() { "if off <= 1e-5 { pose } else { &goal }" } else { "&goal" };
        let not_numbers =
            "\n    if !see(&[0.0; N], parameters).iter().all(|x| x.is_finite()) {\n        return ";
        let given_check = "\n    if !given.iter().all(|x| x.is_finite()) {\n        return IkResult::new(IkStatus::NotFinite, off);\n    }";
        let max = if is_closed { "SOLVE_MAX".to_string() } else { MAX.to_string() };
        let branch = if is_closed {
            "The number of its branch, whose label is in [`SOLVE_BRANCHES`](crate::SOLVE_BRANCHES), if it is one's."
        } else {
            "By elimination there are no branches."
        };
        let (configurations, counts) = self.tested();
        let test_given: Vec<String> = self.given.iter().map(|j| format!("q[{j}]")).collect();
        let wrong = if self.goal == Goal::Position { "" } else { include_str!("rust/test_wrong.rs.txt") };
        let nearest =
            self.nearest().replace("OUTSIDE_LIMITS", "`OutsideLimits`").replace("SOLVED", "`Solved`");
        let nearest = nearest
            .replace("FAMILY", "`Family`")
            .replace("UNDECIDED", "`Undecided`")
            .replace(" ik,", " [`ik`],");
        template
            .replace("@goal@", goal)
            .replace("@search@", search.trim_end())
            .replace("@spread@", if has_given { include_str!("rust/spread.rs.txt") } else { "" })
            .replace("@twist@", twist.trim_end())
            .replace("@wrong@", wrong)
            .replace(
                "@or_twist@",
                if self.is_full {
                    ", or the goal turned\n/// and shifted a little if there is none"
                } else {
                    ""
                },
            )
            .replace(
                "@atan2@",
                if self.goal == Goal::Position {
                    "use crate::kernel::sqrt;"
                } else {
                    "use crate::kernel::{atan2, sqrt};"
                },
            )
            .replace("@solve_names@", "SolveCertificate, SolveSolution, SOLVE_MAX")
            .replace("@feature@", if is_closed { "" } else { "#![cfg(feature = \"std\")]\n" })
            .replace("@scattered@", &scattered)
            .replace("@copies_count@", &copies.len().to_string())
            .replace("@copies@", &rows(&copies))
            .replace("@configurations@", &rows(&configurations))
            .replace("@solutions@", &format!("[{counts}]"))
            .replace("@count@", &self.known.len().to_string())
            .replace("@flatten@", &flatten)
            .replace("@solve_goal@", solve_goal)
            .replace("@solve_result@", if is_closed { "@solve_result@" } else { "q" })
            .replace("@found_branch@", if is_closed { "Some(s.branch)" } else { "None" })
            .replace("@branch@", branch)
            .replace("@max@", &max)
            .replace("@read@", &read)
            .replace("@range@", self.range())
            .replace("@nearest@", &nearest)
            .replace("@given_check@", &either(has_given, given_check))
            .replace(
                "@parameters_check@",
                &either(p, &format!("{not_numbers}IkResult::new(IkStatus::NotFinite, off);\n    }}")),
            )
            .replace("@parameters_check_choice@", &either(p, &format!("{not_numbers}choice;\n    }}")))
            .replace("@given_parameter@", &either(has_given, &format!(", given: &[f64; {g}]")))
            .replace("@given_passed@", if has_given { ", given" } else { "" })
            .replace("@given_test@", &either(has_given, &format!(", &{}", array(test_given))))
            .replace("@given_count@", &g.to_string())
            .replace("@given@", &array(self.given.iter().map(usize::to_string).collect()))
            .replace("@samples@", &SAMPLES.to_string())
            .replace("@parameters_given@", &either(p, ", parameters: &crate::Parameters"))
            .replace("@parameters_passed@", &either(p, ", parameters"))
            .replace("@parameters_unread@", &either(p, "\n    let _ = parameters;"))
            .replace(
                "@parameters_test@",
                &either(p, &format!("\n    let parameters = &@name@::{};", self.test_parameters())),
            )
            .replace("@size@", &number(self.size))
            .replace("@units@", &numbers(&|j| self.unit(j)))
            .replace("@periods@", &numbers(&|j| self.period(j)))
            .replace("@windows@", &numbers(&|j| self.window(j)))
            .replace("@is_given@", &each(&|j| self.is_given(j).to_string()))
            .replace("@lower@", &numbers(&|j| self.limit(j)[0]))
            .replace("@upper@", &numbers(&|j| self.limit(j)[1]))
            .replace("@variables@", &self.variables.to_string())
            .replace("@columns@", &(6 * n).to_string())
            .replace("@n@", &n.to_string())
    }
}

/// A number in Rust.
fn number(x: f64) -> String {
    match x {
        f64::INFINITY => "f64::INFINITY".into(),
        f64::NEG_INFINITY => "f64::NEG_INFINITY".into(),
        x => format!("{x:?}"),
    }
}

fn array(values: Vec<String>) -> String {
    format!("[{}]", values.join(", "))
}
