//! The functions in Python: behind the others of the module.

use super::{Controller, SAMPLES};
use crate::Solver;
use crate::inverse::MAX;
use crate::tables::wrapped_in;
use denavit::inverse::Goal;
use denavit_emit::Attachment;

/// What is imported beside NumPy.
const IMPORTS: &str =
    "from enum import IntEnum\nfrom itertools import islice, product\nfrom typing import NamedTuple\n";

/// The longest line.
pub(crate) const WIDTH: usize = 88;

/// The functions with their test.
pub(super) fn attachment(own: &Controller) -> Attachment {
    let goal = match own.goal {
        Goal::Pose => include_str!("python/goal_pose.py.txt"),
        Goal::Position => include_str!("python/goal_position.py.txt"),
        Goal::PositionAndAxis => include_str!("python/goal_axis.py.txt"),
    };
    let definitions =
        include_str!("python/ik.py.txt").replace("@goal@", goal) + include_str!("python/call.py.txt");
    Attachment {
        name: "controller".into(),
        declarations: IMPORTS.into(),
        definitions: own.python(&definitions),
        test: if own.known.is_empty() {
            String::new()
        } else {
            own.python(include_str!("python/test.py.txt"))
        },
        ..Attachment::default()
    }
}

impl Controller<'_> {
    /// A template with the facts of the arm in it.
    fn python(&self, template: &str) -> String {
        let n = self.joints();
        let numbers = |f: &dyn Fn(usize) -> f64| row(&(0..n).map(f).collect::<Vec<_>>());
        let has_given = !self.given.is_empty();
        let (g, p) = (self.given.len(), self.has_parameters);
        let either = |is: bool, text: &str| if is { text.to_string() } else { String::new() };
        let lines = |indent: usize, text: &str| {
            wrapped_in(WIDTH, &" ".repeat(indent), text, "").trim_end().to_string()
        };
        let given_names: Vec<String> = self.given.iter().map(|j| format!("q[{j}]")).collect();
        let read = lines(8, &format!("The first three rows are read, {}.", self.read()));
        let given_about = format!(
            "    given : array_like, shape ({g},)\n        The values of {} (rad, m).\n",
            given_names.join(", ")
        );
        let given_shape = format!(
            "\n    given = np.asarray(given, dtype=np.float64)\n    if given.shape != ({g},):\n        raise \
             ValueError(f\"given must have the shape ({g},), not {{given.shape}}\")"
        );
        let goals = match self.goal {
            Goal::Pose => "goals",
            Goal::Position => "goals[:, :, 3]",
            Goal::PositionAndAxis => "goals[:, :, 2:]",
        };
        let goals = if has_given {
            format!("_beside({goals}.reshape(len(goals), -1), given)")
        } else {
            goals.to_string()
        };
        let twist = if self.is_full {
            include_str!("python/twist.py.txt")
        } else {
            "        return np.empty((0, 3, 4))"
        };
        let search = if has_given {
            include_str!("python/search_given.py.txt")
        } else {
            include_str!("python/search_plain.py.txt")
        };
        let solve_goal = if self.passes_rounded() { "(pose if off <= 1e-5 else goal)" } else { "goal" };
        let parameters_check = "\n    if not np.isfinite([*vars(parameters).values()]).all():\n        status = IkStatus.NOT_FINITE";
        let given_check = "\n    if not np.isfinite(given).all():\n        status = IkStatus.NOT_FINITE";
        let wrong = if self.goal == Goal::Position { "" } else { include_str!("python/test_wrong.py.txt") };
        let (configurations, counts) = self.tested();
        let or_twist =
            if self.is_full { ", or\n    the goal turned and shifted a little if there is none" } else { "" };
        let signature = |arguments: &[&str]| {
            let all: Vec<&str> = arguments.iter().copied().filter(|a| !a.is_empty()).collect();
            format!("\n    {},\n", all.join(",\n    "))
        };
        let given_argument = if has_given { "given: ArrayLike" } else { "" };
        let (parameters, keyword) = match (p, self.has_defaults) {
            (false, _) => ("", ""),
            (true, true) => ("parameters: Parameters = DEFAULTS", "parameters: Parameters = DEFAULTS"),
            (true, false) => ("parameters: Parameters", "*,\n    parameters: Parameters"),
        };
        let limits = "limits: tuple[ArrayLike, ArrayLike] = LIMITS";
        let (most, branch, listed) = match self.solver {
            Solver::Closed(_) => (
                "len(SOLVE_BRANCHES)".to_string(),
                "The number of its branch, whose label is in `SOLVE_BRANCHES`, if it is one's.",
                "q, residual, multiplicity, branch, _, counts, certificate",
            ),
            Solver::General(_) => {
                let about = "None: by elimination there are no branches.";
                (MAX.to_string(), about, "q, residual, multiplicity, _, counts, certificate")
            }
        };
        let is_general = matches!(self.solver, Solver::General(_));
        let no_branch = either(is_general, "\n    branch = np.full(residual.shape, None)");
        let given: Vec<String> = self.given.iter().map(usize::to_string).collect();
        let given = format!("[{}]", given.join(", "));
        template
            .replace("@most@", &most)
            .replace("@branch@", branch)
            .replace("@listed@", listed)
            .replace("@no_branch@", &no_branch)
            .replace("@search@", search.trim_end())
            .replace("@spread@", if has_given { include_str!("python/spread.py.txt") } else { "" })
            .replace("@twist@", twist.trim_end())
            .replace("@wrong@", wrong)
            .replace("@or_twist@", or_twist)
            .replace("@ik_arguments@", &signature(&["pose: ArrayLike", given_argument, parameters]))
            .replace(
                "@nearest_arguments@",
                &signature(&["pose: ArrayLike", "previous: ArrayLike", limits, keyword]),
            )
            .replace("@all_arguments@", &signature(&["pose: ArrayLike", given_argument, limits, keyword]))
            .replace(
                "@parameters_about@",
                &either(p, "    parameters : Parameters\n        Values of the symbols in the formulas.\n"),
            )
            .replace("@given_about@", &either(has_given, &given_about))
            .replace("@given_shape@", &either(has_given, &given_shape))
            .replace("@parameters_check@", &either(p, parameters_check))
            .replace("@given_check@", &either(has_given, given_check))
            .replace("@read@", &read)
            .replace("@pose_read@", &read)
            .replace("@range@", self.range())
            .replace("@nearest@", &lines(4, self.nearest()))
            .replace("@flatten@", &goals)
            .replace("@solve_goal@", solve_goal)
            .replace("@given_local@", if has_given { ", given" } else { "" })
            .replace("@given_passed@", if has_given { ", given" } else { "" })
            .replace("@given_argument@", if has_given { ", given" } else { "" })
            .replace("@samples@", &SAMPLES.to_string())
            .replace("@parameters_given@", &either(p, ", parameters"))
            .replace("@parameters_passed@", &either(p, ", parameters"))
            .replace("@parameters_argument@", &either(p, ", self.parameters"))
            .replace("@parameters_keyword@", &either(p, ", parameters=self.parameters"))
            .replace("@parameters_test@", &if p { self.test_parameters() } else { "None".into() })
            .replace("@configurations@", &rows(&configurations, 4))
            .replace("@solutions@", &format!("[{counts}]"))
            .replace("@copies@", &rows(&self.copies(), 0))
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

/// A number in Python.
fn number(x: f64) -> String {
    match x {
        f64::INFINITY => "np.inf".into(),
        f64::NEG_INFINITY => "-np.inf".into(),
        x => format!("{x:?}"),
    }
}

fn list(values: &[f64]) -> String {
    let values: Vec<String> = values.iter().map(|x| number(*x)).collect();
    format!("[{}]", values.join(", "))
}

/// An array on a line or more, at a depth of four spaces or none.
pub(crate) fn row(values: &[f64]) -> String {
    let whole = list(values);
    if whole.len() <= WIDTH - 30 {
        return format!("np.array({whole})");
    }
    let inner = wrapped_in(WIDTH, "        ", whole.trim_matches(['[', ']']), "");
    format!("np.array(\n    [\n{inner}    ]\n)")
}

/// An array with a list a row.
pub(crate) fn rows(values: &[Vec<f64>], indent: usize) -> String {
    let margin = " ".repeat(indent);
    let rows = values.iter().map(|row| {
        let whole = format!("{margin}        {},\n", list(row));
        if whole.len() <= WIDTH + 1 {
            return whole;
        }
        let inner =
            wrapped_in(WIDTH, &format!("{margin}            "), list(row).trim_matches(['[', ']']), "");
        format!("{margin}        [\n{inner}{margin}        ],\n")
    });
    format!("np.array(\n{margin}    [\n{}{margin}    ]\n{margin})", rows.collect::<String>())
}
