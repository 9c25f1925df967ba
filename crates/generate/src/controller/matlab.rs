//! The functions in MATLAB: a file each, and a private one with what they share.

use super::{Controller, SAMPLES};
use crate::Solver;
use crate::inverse::MAX;
use crate::tables::wrapped;
use denavit::inverse::Goal;
use denavit_emit::{Attachment, File};

/// The functions with their test.
pub(super) fn attachment(own: &Controller) -> Attachment {
    let goal = match own.goal {
        Goal::Pose => include_str!("matlab/goal_pose.m"),
        Goal::Position => include_str!("matlab/goal_position.m"),
        Goal::PositionAndAxis => include_str!("matlab/goal_axis.m"),
    };
    let answer = include_str!("matlab/answer.m").replace("@goal@", goal) + include_str!("matlab/nearest.m");
    let file = |path: &str, text: &str| File { path: path.into(), text: own.matlab(text) };
    Attachment {
        name: "controller".into(),
        test: if own.known.is_empty() { String::new() } else { own.matlab(include_str!("matlab/test.m")) },
        files: vec![
            file("@name@_ik.m", include_str!("matlab/ik.m")),
            file("@name@_ik_nearest.m", include_str!("matlab/ik_nearest.m")),
            file("@name@_ik_all_within_limits.m", include_str!("matlab/ik_all_within_limits.m")),
            file("@name@_limits.m", include_str!("matlab/limits.m")),
            file("private/@name@_answer.m", &answer),
            file("private/@name@_numbers.m", include_str!("matlab/numbers.m")),
        ],
        ..Attachment::default()
    }
}

impl Controller<'_> {
    /// A template with the facts of the arm in it.
    fn matlab(&self, template: &str) -> String {
        let n = self.joints();
        let numbers = |f: &dyn Fn(usize) -> f64| row(&(0..n).map(f).collect::<Vec<_>>());
        let has_given = !self.given.is_empty();
        let (g, p) = (self.given.len(), self.has_parameters);
        let either = |is: bool, text: &str| if is { text.to_string() } else { String::new() };
        let flatten = match self.goal {
            Goal::Pose if has_given => "reshape(goal.', 1, []), given",
            Goal::Pose => "goal",
            Goal::Position if has_given => "goal(:, 4).', given",
            Goal::Position => "goal(:, 4).'",
            Goal::PositionAndAxis if has_given => "reshape(goal(:, 3:4).', 1, []), given",
            Goal::PositionAndAxis => "goal(:, 3:4)",
        };
        let twist = if self.is_full { include_str!("matlab/twist.m") } else { "        continue;" };
        let search = if has_given {
            include_str!("matlab/search_given.m")
        } else {
            include_str!("matlab/search_plain.m")
        };
        let (max, branch, branch_about) = match self.solver {
            Solver::Closed(closed) => (
                closed.facts().max_solutions,
                "info.branch",
                "label branch + 1 of @NAME@_SOLVE is its; -1 if it is none's",
            ),
            Solver::General(_) => (MAX, "-ones(size(q, 1), 1)", "-1: by elimination there are none"),
        };
        let given: Vec<String> = self.given.iter().map(|j| (j + 1).to_string()).collect();
        let given = if has_given { format!("[{}]", given.join(", ")) } else { "zeros(1, 0)".into() };
        let names: Vec<String> = self.given.iter().map(|j| format!("q({})", j + 1)).collect();
        let given_about =
            format!("%\n%   GIVEN has the value{} of {}.\n", if g == 1 { "" } else { "s" }, names.join(", "));
        let given_check = format!("\ngiven = @name@_numbers(given, 'given', {{[1, {g}]}});");
        let solve_goal = if self.passes_rounded() { "rounded" } else { "goal" };
        let rounded = "\nrounded = goal;\nif off <= 1e-5\n    rounded = pose;\nend";
        let test_given = format!(", q({given})");
        let wrong = if self.goal == Goal::Position { "" } else { include_str!("matlab/test_wrong.m") };
        let or_twist =
            if self.is_full { ", or the\n% goal turned and shifted a little if there is none" } else { "" };
        let (configurations, counts) = self.tested();
        let (is_given, is_parametric) = (usize::from(has_given), usize::from(p));
        let is_required = usize::from(p && !self.has_defaults);
        // Limits stand ahead of parameters.
        let places = if template.contains("@limits_place@") { 2 } else { 1 };
        let default = |place: usize| {
            let text = format!("\nif nargin < {place}\n    parameters = struct();\nend");
            either(p && self.has_defaults, &text)
        };
        let quoted = |word: &str| format!("'{}'", word.to_lowercase().replace('_', " "));
        let mut nearest = self.nearest().to_string();
        for word in ["OUTSIDE_LIMITS", "FAMILY", "UNDECIDED", "SOLVED"] {
            nearest = nearest.replace(word, &quoted(word));
        }
        let about = "%   PARAMETERS is a struct of values of the symbols, as for the other functions.\n%";
        template
            .replace("@search@", search.trim_end())
            .replace("@spread@", if has_given { include_str!("matlab/spread.m") } else { "" })
            .replace("@twist@", twist.trim_end())
            .replace("@wrong@", wrong)
            .replace("@or_twist@", or_twist)
            .replace("@flatten@", flatten)
            .replace("@solve_goal@", solve_goal)
            .replace("@rounded@", &either(self.passes_rounded(), rounded))
            .replace("@max@", &max.to_string())
            .replace("@branch@", branch)
            .replace("@branch_about@", branch_about)
            .replace("@given_about@", &either(has_given, &given_about))
            .replace("@given_check@", &either(has_given, &given_check))
            .replace("@given_local@", if has_given { ", given" } else { "" })
            .replace("@GIVEN@", if has_given { ", GIVEN" } else { "" })
            .replace("@given_or_none@", if has_given { "given" } else { "[]" })
            .replace("@given_test@", &either(has_given, &test_given))
            .replace("@least@", &(1 + is_given + is_required * places).to_string())
            .replace("@arguments@", &(1 + is_given + is_parametric).to_string())
            .replace("@nearest_least@", &(2 + 2 * is_required).to_string())
            .replace("@nearest_arguments@", &(3 + is_parametric).to_string())
            .replace("@all_arguments@", &(2 + is_given + is_parametric).to_string())
            .replace("@limits_place@", &(2 + is_given).to_string())
            .replace("@parameters_default@", &default(2 + is_given))
            .replace("@nearest_default@", &default(4))
            .replace("@all_default@", &default(3 + is_given))
            .replace("@parameters_about@", &either(p, &format!("\n{about}")))
            .replace("@parameters_or_none@", if p { "parameters" } else { "struct()" })
            .replace("@PARAMETERS@", &either(p, ", PARAMETERS"))
            .replace("@parameters_given@", &either(p, ", parameters"))
            .replace("@parameters_passed@", &either(p, ", parameters"))
            .replace("@parameters_test@", &either(p, &format!("\nparameters = {};", self.test_parameters())))
            .replace("@clear@", if p { "clear parameters" } else { "" })
            .replace("@read@", self.read())
            .replace("@range@", self.range())
            .replace("@nearest@", wrapped("%   ", &nearest, "").trim_end())
            .replace("@samples@", &SAMPLES.to_string())
            .replace("@configurations@", &rows(&configurations))
            .replace("@solutions@", &format!("[{counts}]"))
            .replace("@copies@", &rows(&self.copies()))
            .replace("@given@", &given)
            .replace("@size@", &format!("{:?}", self.size))
            .replace("@units@", &numbers(&|j| self.unit(j)))
            .replace("@periods@", &numbers(&|j| self.period(j)))
            .replace("@windows@", &numbers(&|j| self.window(j)))
            .replace("@lower@", &numbers(&|j| self.limit(j)[0]))
            .replace("@upper@", &numbers(&|j| self.limit(j)[1]))
            .replace("@variables@", &self.variables.to_string())
            .replace("@n@", &n.to_string())
    }
}

/// A number in MATLAB.
fn number(x: f64) -> String {
    match x {
        f64::INFINITY => "Inf".into(),
        f64::NEG_INFINITY => "-Inf".into(),
        x => format!("{x:?}"),
    }
}

fn list(values: &[f64]) -> String {
    let values: Vec<String> = values.iter().map(|x| number(*x)).collect();
    values.join(", ")
}

pub(crate) fn row(values: &[f64]) -> String {
    format!("[{}]", list(values))
}

pub(crate) fn rows(values: &[Vec<f64>]) -> String {
    let rows: Vec<String> = values.iter().map(|row| format!("    {}", list(row))).collect();
    format!("[ ...\n{} ...\n]", rows.join("; ...\n"))
}
