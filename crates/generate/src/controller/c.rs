//! The functions in C99.

use super::{Controller, SAMPLES};
use crate::Solver;
use crate::inverse::MAX;
use crate::tables::{list, table, wrapped};
use denavit::inverse::Goal;
use denavit_emit::Attachment;

/// The functions with their test.
pub(super) fn attachment(own: &Controller) -> Attachment {
    let goal = match own.goal {
        Goal::Pose => include_str!("c/goal_pose.c"),
        Goal::Position => include_str!("c/goal_position.c"),
        Goal::PositionAndAxis => include_str!("c/goal_axis.c"),
    };
    let definitions = include_str!("c/answer.c").replace("@goal@", goal)
        + include_str!("c/solve.c")
        + &include_str!("c/singular.c").replace("@neighbour@", include_str!("c/neighbour.c"))
        + &copies(own)
        + include_str!("c/nearest.c");
    Attachment {
        name: "ik".into(),
        declarations: own.filled(include_str!("c/declarations.h")),
        definitions: own.filled(&definitions),
        test: if own.known.is_empty() {
            "\nstatic void test_ik(void)\n{\n}\n".into()
        } else {
            own.filled(include_str!("c/test.c"))
        },
        ..Attachment::default()
    }
}

/// The table of further motions after which all links are back.
fn copies(own: &Controller) -> String {
    let rows = own.copies();
    format!(
        "\nenum {{\n    /* Motions of joints with gears after which all links are back, besides those in turns of one joint; the first is \
         none. */\n    ANSWER_COPIES = {}\n}};\n\nstatic const double answer_copies[ANSWER_COPIES][ANSWER_JOINTS] = {{\n{}\n}};\n",
        rows.len(),
        table(&rows)
    )
}

impl Controller<'_> {
    /// A template with the facts of the arm in it.
    fn filled(&self, template: &str) -> String {
        let n = self.joints();
        let numbers = |f: &dyn Fn(usize) -> f64| row(&(0..n).map(f).collect::<Vec<_>>());
        let flags = |f: &dyn Fn(usize) -> bool| {
            let all: Vec<&str> = (0..n).map(|j| if f(j) { "1" } else { "0" }).collect();
            format!("{{{}}}", all.join(", "))
        };
        let has_given = !self.given.is_empty();
        let (g, p) = (self.given.len(), self.has_parameters);
        let given_line = format!("\n    const double given[{g}],");
        let parameters_line = "\n    const @name@_parameters *parameters,";
        let either = |is: bool, text: &str| if is { text.to_string() } else { String::new() };
        let given: Vec<String> = self.given.iter().map(usize::to_string).collect();
        let (max, branch, found_branch) = match self.solver {
            Solver::Closed(_) => (
                "@NAME@_SOLVE_MAX".to_string(),
                "The number of its branch, whose label is in @name@_solve_branches; -1 if it is none's.",
                "found[s].branch",
            ),
            Solver::General(_) => (MAX.to_string(), "By elimination there are no branches: -1.", "-1"),
        };
        let words = |lines: &str| wrapped(" * ", lines, "").trim_end().trim_start_matches(" * ").to_string();
        let read = if has_given {
            let names = self.given.iter().map(|j| format!("q[{j}]")).collect::<Vec<_>>().join(", ");
            format!("{};\n * then the values of {names}", self.read())
        } else {
            self.read().to_string()
        };
        let nearest = words(self.nearest());
        let places = self.places();
        let mut flatten = String::new();
        for (k, (i, j)) in places.iter().enumerate() {
            flatten.push_str(&format!("    values[{k}] = goal[{i}][{j}];\n"));
        }
        if has_given {
            flatten
                .push_str(&format!("    memcpy(values + {}, given, {g} * sizeof *given);\n", places.len()));
        }
        let given_check = format!(
            "\n    if (!answer_is_finite(given, {g})) {{\n        status = @NAME@_IK_NOT_FINITE;\n    }}"
        );
        let twist =
            if self.is_full { include_str!("c/twist.c").to_string() } else { "        return 0;".into() };
        let twist = twist.trim_end();
        let search =
            if has_given { include_str!("c/search_given.c") } else { include_str!("c/search_plain.c") };
        let spread = if has_given { include_str!("c/spread.c") } else { "" };
        let solve_goal = if self.passes_rounded() { "result->off <= 1e-5 ? pose : goal" } else { "goal" };
        let parameters_check = "\n    if (!answer_is_finite((const double *)parameters, (int)(sizeof *parameters / sizeof(double)))) {\n        \
                                status = @NAME@_IK_NOT_FINITE;\n    }";
        let (configurations, counts) = self.tested();
        let parameters_test = format!(
            "\n    const @name@_parameters values = {{\n{}    }};\n    const @name@_parameters *parameters = &values;",
            wrapped(
                "        ",
                &self.parameters.iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(", "),
                ""
            )
        );
        let given_test: String = std::iter::once(format!("\n        double given[{g}];"))
            .chain(self.given.iter().enumerate().map(|(k, j)| format!("\n        given[{k}] = q[{j}];")))
            .collect();
        let wrong = match self.goal {
            Goal::Position => "",
            Goal::Pose | Goal::PositionAndAxis => {
                "        controlled(v, @name@_ik(wrong@given_passed@@parameters_passed@, &result) == @NAME@_IK_NOT_A_ROTATION\n            \
                 && result.count == 0 && result.off > 0.005, \"what is no rotation is taken for one\");\n"
            }
        };
        template
            .replace("@search@", search)
            .replace("@spread@", spread)
            .replace("@wrong@", wrong)
            .replace("@given_test@", &either(has_given, &given_test))
            .replace("@parameters_test@", &either(p, &parameters_test))
            .replace("@configurations@", &table(&configurations))
            .replace("@solutions@", &format!("{{{counts}}}"))
            .replace("@count@", &self.known.len().to_string())
            .replace("@twist@", twist)
            .replace(
                "@or_twist@",
                if self.is_full {
                    ", or the\n   goal turned and shifted a little if there is none"
                } else {
                    ""
                },
            )
            .replace("@about@", "")
            .replace("@flatten@", &flatten)
            .replace("@values@", &(places.len() + g).to_string())
            .replace("@solve_goal@", solve_goal)
            .replace("@solve_result@", if matches!(self.solver, Solver::Closed(_)) { "@solve_result@" } else { "q" })
            .replace("@found_branch@", found_branch)
            .replace("@branch@", branch)
            .replace("@max@", &max)
            .replace("@read@", &read)
            .replace("@range@", self.range())
            .replace("@nearest@", &nearest)
            .replace("@given_check@", &either(has_given, &given_check))
            .replace(
                "@given_bound@",
                if has_given {
                    ",\n * or @name@_solve for up to 33 values of the joints that are given and Newton's method from 24 configurations"
                } else {
                    ""
                },
            )
            .replace("@parameters_check@", &either(p, parameters_check))
            .replace("@given_declaration@", &either(has_given, &given_line))
            .replace("@given_local@", &either(has_given, &given_line))
            .replace("@given_passed@", if has_given { ", given" } else { "" })
            .replace("@given_count@", &g.to_string())
            .replace("@given@", &format!("{{{}}}", given.join(", ")))
            .replace("@samples@", &SAMPLES.to_string())
            .replace("@parameters_declaration@", &either(p, parameters_line))
            .replace("@parameters_local@", &either(p, parameters_line))
            .replace("@parameters_given@", &either(p, ", const @name@_parameters *parameters"))
            .replace("@parameters_passed@", &either(p, ", parameters"))
            .replace("@parameters_unread@", &either(p, "\n    (void)parameters;"))
            .replace("@size@", &format!("{:?}", self.size))
            .replace("@units@", &numbers(&|j| self.unit(j)))
            .replace("@periods@", &numbers(&|j| self.period(j)))
            .replace("@windows@", &numbers(&|j| self.window(j)))
            .replace("@is_given@", &flags(&|j| self.is_given(j)))
            .replace("@lower@", &limits(n, |j| self.limit(j)[0]))
            .replace("@upper@", &limits(n, |j| self.limit(j)[1]))
            .replace("@columns@", &(6 * n).to_string())
            .replace("@variables@", &self.variables.to_string())
            .replace("@n@", &n.to_string())
    }
}

/// Numbers in braces on a line or more.
fn row(values: &[f64]) -> String {
    list(values, 4).trim_start().to_string()
}

fn limits(joints: usize, of: impl Fn(usize) -> f64) -> String {
    let one = |x: f64| match x {
        f64::INFINITY => "HUGE_VAL".to_string(),
        f64::NEG_INFINITY => "-HUGE_VAL".into(),
        x => format!("{x:?}"),
    };
    let all: Vec<String> = (0..joints).map(of).map(one).collect();
    format!("{{{}}}", all.join(", "))
}
