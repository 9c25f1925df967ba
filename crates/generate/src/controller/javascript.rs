//! The functions in JavaScript: behind the others of the module.

use super::{Controller, SAMPLES};
use crate::Solver;
use crate::tables::wrapped;
use denavit::inverse::Goal;
use denavit_emit::Attachment;

/// The functions with their test.
pub(super) fn attachment(own: &Controller) -> Attachment {
    let goal = match own.goal {
        Goal::Pose => include_str!("javascript/goal_pose.js.txt"),
        Goal::Position => include_str!("javascript/goal_position.js.txt"),
        Goal::PositionAndAxis => include_str!("javascript/goal_axis.js.txt"),
    };
    let definitions = include_str!("javascript/types.js.txt").to_string()
        + &include_str!("javascript/ik.js.txt").replace("@goal@", goal)
        + include_str!("javascript/call.js.txt");
    Attachment {
        name: "controller".into(),
        definitions: own.javascript(&definitions),
        test: if own.known.is_empty() {
            String::new()
        } else {
            own.javascript(include_str!("javascript/test.js.txt"))
        },
        ..Attachment::default()
    }
}

impl Controller<'_> {
    /// A template with the facts of the arm in it.
    fn javascript(&self, template: &str) -> String {
        let n = self.joints();
        let numbers = |f: &dyn Fn(usize) -> f64| list(&(0..n).map(f).collect::<Vec<_>>());
        let has_given = !self.given.is_empty();
        let (g, p) = (self.given.len(), self.has_parameters);
        let either = |is: bool, text: &str| if is { text.to_string() } else { String::new() };
        let entries: Vec<String> = self.places().iter().map(|(i, j)| format!("goal[{i}][{j}]")).collect();
        let flatten = match self.goal {
            Goal::Pose if has_given => "[...goal.slice(0, 3).flat(), ...Array.from(given)]".into(),
            Goal::Pose => "goal.slice(0, 3).flat()".into(),
            _ if has_given => format!("[{}, ...Array.from(given)]", entries.join(", ")),
            _ => format!("[{}]", entries.join(", ")),
        };
        let twist = if self.is_full { include_str!("javascript/twist.js.txt") } else { "    return null;" };
        let search = if has_given {
            include_str!("javascript/search_given.js.txt")
        } else {
            include_str!("javascript/search_plain.js.txt")
        };
        let solve_goal = if self.passes_rounded() {
            "off <= 1e-5 ? [0, 4, 8].map((start) => [0, 1, 2, 3].map((k) => pose[start + k])) : goal"
        } else {
            "goal"
        };
        let given_length = format!("\n  ikRequire(given, \"given\", [{g}]);");
        let given_check = "\n  if (!Array.from(given).every(Number.isFinite)) {\n    return { status: \"not finite\", off, \
                           solutions: [] };\n  }";
        let given_names: Vec<String> = self.given.iter().map(|j| format!("q[{j}]")).collect();
        let given_public = format!(
            "\n * @param {{ArrayLike<number>}} given {g} values (rad, m): {}",
            given_names.join(", ")
        );
        let wrong =
            if self.goal == Goal::Position { "" } else { include_str!("javascript/test_wrong.js.txt") };
        let or_twist =
            if self.is_full { ", or the goal\n * turned and shifted a little if there is none" } else { "" };
        let (configurations, counts) = self.tested();
        let (most, result, branch) = match self.solver {
            Solver::Closed(_) => (
                "solveBranches.length",
                None,
                "the number of its branch, whose label is in `solveBranches`, if it\n *   is one's",
            ),
            Solver::General(_) => ("SOLVE_MAX", Some("q"), "by elimination there are no branches: null"),
        };
        let template = result.map_or(template.to_string(), |q| template.replace("@solve_result@: q", q));
        let test_given: Vec<String> = self.given.iter().map(|j| format!("q[{j}]")).collect();
        let (default, public, limits) = if self.has_defaults {
            (", parameters = DEFAULTS", "[parameters]", "{IkLimits} [allowed]")
        } else {
            (", parameters", "parameters", "{IkLimits | undefined} allowed")
        };
        let public = format!("\n * @param {{Parameters}} {public} values of the symbols");
        let limits = if p { limits } else { "{IkLimits} [allowed]" };
        let given: Vec<String> = self.given.iter().map(usize::to_string).collect();
        let nearest = self.nearest().replace("OUTSIDE_LIMITS", "outside limits").replace("FAMILY", "family");
        let nearest =
            nearest.replace("UNDECIDED", "undecided").replace("SOLVED then says", "`solved` then says");
        template
            .replace("@most@", most)
            .replace("@branch@", branch)
            .replace("@search@", search.trim_end())
            .replace("@settle@", include_str!("javascript/settle.js.txt"))
            .replace(
                "@parameters_check@",
                &either(
                    p,
                    "\n  if (!Object.values(parameters).every(Number.isFinite)) {\n    return { status: \"not finite\", off, \
                     solutions: [] };\n  }",
                ),
            )
            .replace(
                "@parameters_numbers@",
                &either(p, " &&\n    Object.values(parameters).every(Number.isFinite)"),
            )
            .replace("@spread@", if has_given { include_str!("javascript/spread.js.txt") } else { "" })
            .replace("@twist@", twist.trim_end())
            .replace("@wrong@", wrong)
            .replace("@or_twist@", or_twist)
            .replace("@given_public@", &either(has_given, &given_public))
            .replace("@given_length@", &either(has_given, &given_length))
            .replace("@given_check@", &either(has_given, given_check))
            .replace("@given_local@", if has_given { ", given" } else { "" })
            .replace("@given_passed@", if has_given { ", given" } else { "" })
            .replace("@given_test@", &either(has_given, &format!(", [{}]", test_given.join(", "))))
            .replace("@given_doc@", &either(has_given, "\n * @param {ArrayLike<number>} given"))
            .replace("{IkLimits} @allowed_name@", limits)
            .replace("@parameters_default@", &either(p, default))
            .replace("@parameters_public@", &either(p, &public))
            .replace("@parameters_doc@", &either(p, "\n * @param {Parameters} parameters"))
            .replace("@parameters_given@", &either(p, ", parameters"))
            .replace("@parameters_passed@", &either(p, ", parameters"))
            .replace(
                "@parameters_test@",
                &either(p, &format!("\nconst parameters = {};", self.test_parameters())),
            )
            .replace("@read@", self.read())
            .replace("@pose_read@", self.read())
            .replace("@range@", self.range())
            .replace("@nearest@", wrapped(" * ", &nearest, "").trim_end())
            .replace("@flatten@", &flatten)
            .replace("@solve_goal@", solve_goal)
            .replace("@samples@", &SAMPLES.to_string())
            .replace("@configurations@", &rows(&configurations))
            .replace("@solutions@", &format!("[{counts}]"))
            .replace("@copies@", &rows(&self.copies()))
            .replace("@given@", &format!("[{}]", given.join(", ")))
            .replace("@size@", &format!("{:?}", self.size))
            .replace("@units@", &numbers(&|j| self.unit(j)))
            .replace("@periods@", &numbers(&|j| self.period(j)))
            .replace("@windows@", &numbers(&|j| self.window(j)))
            .replace("@lower@", &numbers(&|j| self.limit(j)[0]))
            .replace("@upper@", &numbers(&|j| self.limit(j)[1]))
            .replace("@variables@", &self.variables.to_string())
            .replace("@columns@", &(6 * n).to_string())
            .replace("@n@", &n.to_string())
    }
}

/// A number in JavaScript.
fn number(x: f64) -> String {
    match x {
        f64::INFINITY => "Infinity".into(),
        f64::NEG_INFINITY => "-Infinity".into(),
        x => format!("{x:?}"),
    }
}

fn list(values: &[f64]) -> String {
    let values: Vec<String> = values.iter().map(|x| number(*x)).collect();
    format!("[{}]", values.join(", "))
}

fn rows(values: &[Vec<f64>]) -> String {
    let rows: String = values.iter().map(|row| format!("  {},\n", list(row))).collect();
    format!("[\n{rows}]")
}
