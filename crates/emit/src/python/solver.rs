//! Solvers in Python: functions over any number of rows, a loop over the branches of each node.

use super::{Module, WRAP, capitalised, documentation};
use crate::nested::{Nested, routines};
use crate::solver::Plan;
use crate::{Language, Parameter};

const ROOTS: &str = include_str!("roots.py.txt");
/// Words that emitted solvers use.
pub(super) const WORDS: &str = "NamedTuple results residuals multiplicities frees shape leaf is_angle kind is_pose \
is_near nearly_free tolerance";

/// The name of the class of solutions, and of the labels.
pub(super) fn class(plan: &Plan) -> String {
    let parts: String = plan.name.split('_').map(capitalised).collect();
    format!("{parts}Solutions")
}

pub(super) fn labels(plan: &Plan) -> String {
    format!("{}_BRANCHES", plan.name.to_uppercase())
}

impl Module<'_> {
    /// The routines for roots, and the solvers.
    pub(super) fn solvers(&self) -> Vec<String> {
        if self.plans.is_empty() {
            return vec![];
        }
        let text = routines(ROOTS, &self.plans);
        let mut lines: Vec<String> = text.trim_end().lines().map(str::to_string).collect();
        for plan in &self.plans {
            lines.extend(self.solver(plan));
        }
        lines
    }

    /// The parameters that a solver reads.
    fn parameters_of_solver(&self, plan: &Plan) -> Vec<&Parameter> {
        self.library.parameters.iter().filter(|p| plan.reads(p.symbol)).collect()
    }

    fn solver(&self, plan: &Plan) -> Vec<String> {
        let (f, argument, result, kind) = (&plan.name, &plan.argument, &plan.result, class(plan));
        let (m, most) = (plan.outputs.len(), plan.max());
        let parameters = self.parameters_of_solver(plan);
        let mut lines = vec![String::new(), String::new(), format!("{} = (", labels(plan))];
        lines.extend(plan.labels().iter().map(|label| format!("    \"{label}\",")));
        lines.extend([")".into(), String::new(), String::new()]);
        lines.push(format!("class {kind}(NamedTuple):"));
        lines.extend(documentation(
            &[format!("Solutions of `{f}`: for each row, the first `count` of {most}.")],
            4,
        ));
        lines.push(String::new());
        for (field, what) in [
            (result.as_str(), format!("Results, shape (..., {most}, {m}).")),
            ("residual", "How far the equations are from holding.".into()),
            ("multiplicity", "How many branches come together in each.".into()),
            ("branch", format!("The numbers of their branches, whose labels are in `{}`.", labels(plan))),
            ("free", "The unknowns that are free, a bit each.".into()),
            ("count", "How many solutions there are, shape (...).".into()),
            (
                "certificate",
                "0: these are all. 1: the pose is singular, or nearly so; there may be more. 2: it is no pose.".into(),
            ),
        ] {
            lines.push(format!("    {field}: np.ndarray"));
            lines.extend(documentation(&[what], 4));
        }
        lines.extend([String::new(), String::new()]);

        let given = match (parameters.is_empty(), self.has_defaults()) {
            (true, _) => "",
            (false, true) => ", parameters: Parameters = DEFAULTS",
            (false, false) => ", parameters: Parameters",
        };
        let whole = format!("def {f}({argument}: ArrayLike{given}) -> {kind}:");
        if whole.len() <= WRAP.width {
            lines.push(whole);
        } else {
            lines.push(format!("def {f}("));
            lines.extend(format!("{argument}: ArrayLike{given}").split(", ").map(|a| format!("    {a},")));
            lines.push(format!(") -> {kind}:"));
        }
        let shape: Vec<String> = plan.routine.shape.iter().map(usize::to_string).collect();
        let leading = [&["...".to_string()], &shape[..]].concat().join(", ");
        let mut about = plan.about();
        about.insert(1, String::new());
        let section = |title: &str| [String::new(), title.into(), "-".repeat(title.len())];
        about.extend(section("Parameters"));
        about.push(format!("{argument} : array_like, shape ({leading})"));
        if !parameters.is_empty() {
            about.push("parameters : Parameters".into());
            about.push("    Values of the symbols in the formulas.".into());
        }
        about.extend(section("Returns"));
        about.push(kind.clone());
        lines.extend(documentation(&about, 4));
        if !parameters.is_empty() {
            lines.push("    if not isinstance(parameters, Parameters):".into());
            lines.push("        kind = type(parameters).__name__".into());
            lines.push("        raise TypeError(f\"parameters must be Parameters(...), not {kind}\")".into());
        }
        lines.push(format!("    {argument} = np.asarray({argument}, dtype=np.float64)"));
        let d = plan.routine.shape.len();
        let rows = if d == 0 { format!("{argument}.shape") } else { format!("{argument}.shape[:-{d}]") };
        if d > 0 {
            let tuple = format!("({}{})", shape.join(", "), if d == 1 { "," } else { "" });
            lines.push(format!("    if {argument}.shape[-{d}:] != {tuple}:"));
            let message =
                format!("f\"{argument} must have the shape ({leading}), not {{{argument}.shape}}\"");
            let whole = format!("        raise ValueError({message})");
            if whole.len() <= WRAP.width {
                lines.push(whole);
            } else {
                lines.extend([
                    "        raise ValueError(".into(),
                    format!("            {message}"),
                    "        )".into(),
                ]);
            }
        }
        for (k, symbol) in plan.variables() {
            let (mut rest, mut index) = (k, vec![]);
            for n in plan.routine.shape.iter().rev() {
                index.push((rest % n).to_string());
                rest /= n;
            }
            index.push("...".into());
            index.reverse();
            lines.push(format!("    {} = {argument}[{}]", plan.names.of(symbol), index.join(", ")));
        }
        for p in &parameters {
            let (local, field) = (plan.names.of(p.symbol), self.names.of(p.symbol));
            lines.extend(WRAP.statement(&format!("    {local} ="), &format!("parameters.{field}"), ""));
        }
        lines.push(format!("    shape = {rows}"));
        lines.push(format!("    results = np.empty(shape + ({most}, {m}))"));
        lines.push(format!("    residuals = np.empty(shape + ({most},))"));
        lines.push(format!("    multiplicities = np.zeros(shape + ({most},), dtype=int)"));
        lines.push(format!("    frees = np.zeros(shape + ({most},), dtype=int)"));
        let first = if plan.may_hide { "ones" } else { "zeros" };
        lines.push(format!("    is_near = np.{first}(shape, dtype=bool)"));
        lines.push(String::new());
        lines.push(
            "    with np.errstate(all=\"ignore\"):  # what no root stands behind may be anything".into(),
        );
        let mut nested = Nested::new(plan, Language::Python, "_", "np.arctan2");
        nested.wrap = WRAP;
        lines.extend(nested.body_at(8, |leaf, indent| {
            let room = crate::wrap::Wrap { width: WRAP.width - indent, ..WRAP };
            let mut lines = vec![];
            // A constant number of a branch needs no name.
            let is_short = leaf.branch.len() <= 3;
            if !is_short {
                lines.push(format!("leaf = {}", leaf.branch));
            }
            let b = if is_short { leaf.branch.as_str() } else { "leaf" };
            for (head, value) in
                [("residuals", &leaf.residual), ("multiplicities", &leaf.multiplicity), ("frees", &leaf.free)]
            {
                lines.extend(room.statement(&format!("{head}[..., {b}] ="), value, ""));
            }
            for (k, e) in leaf.outputs.iter().enumerate() {
                lines.extend(room.statement(&format!("results[..., {b}, {k}] ="), e, ""));
            }
            lines
        }));
        let angles: Vec<&str> =
            plan.routine.solver.angles.iter().map(|a| if *a { "True" } else { "False" }).collect();
        lines.extend(WRAP.statement("        is_angle =", &format!("np.array([{}])", angles.join(", ")), ""));
        lines.push(format!("        return {kind}("));
        let tolerance = if plan.defect.is_some() { "tolerance" } else { "1e-9" };
        lines.push("            *_collected(".into());
        lines.push("                (results, residuals, multiplicities, frees),".into());
        lines.push(format!("                (is_angle, {tolerance}, is_pose, is_near),"));
        lines.push("            )".into());
        lines.push("        )".into());
        lines
    }

    /// The test of a solver.
    pub(super) fn solver_test(&self, plan: &Plan) -> Vec<String> {
        let (f, name) = (&plan.name, self.module());
        let parameters = self.parameters_of_solver(plan);
        let vectors = &plan.routine.vectors;
        let kind: String = f.split('_').map(capitalised).collect();
        let mut lines = vec![String::new(), String::new(), format!("class Test{kind}(unittest.TestCase):")];
        let shape: Vec<String> = plan.routine.shape.iter().map(usize::to_string).collect();
        let tail = format!(".reshape({})", [&["-1".to_string()], &shape[..]].concat().join(", "));
        lines.extend(self.table("given", vectors.iter().map(|v| &v.variables[..]), &tail));
        if parameters.is_empty() {
            lines.push(format!("    arguments = [()] * {}", vectors.len()));
        } else {
            lines.push("    arguments = [".into());
            lines.extend(vectors.iter().flat_map(|v| self.arguments(&v.parameters)));
            lines.push("    ]".into());
        }
        let certificates: Vec<String> = vectors.iter().map(|v| v.certificate.code().to_string()).collect();
        lines.push("    certificates = [".into());
        lines.extend(WRAP.list(&certificates, 8));
        lines.push("    ]".into());
        lines.push("    known = [".into());
        for v in vectors {
            lines.push("        [".into());
            for s in &v.solutions {
                lines.push("            (".into());
                lines.push("                [".into());
                lines.extend(WRAP.list(&self.numbers(&s.results), 20));
                lines.push("                ],".into());
                lines.push(format!("                {},", s.multiplicity));
                lines.push(format!("                {},", s.free));
                lines.push("            ),".into());
            }
            lines.push("        ],".into());
        }
        lines.push("    ]".into());
        let tolerances: Vec<f64> = vectors.iter().map(|v| v.tolerance).collect();
        lines.push("    tolerances = [".into());
        lines.extend(WRAP.list(&self.numbers(&tolerances), 8));
        lines.push("    ]".into());
        let angles: Vec<&str> =
            plan.routine.solver.angles.iter().map(|a| if *a { "True" } else { "False" }).collect();
        lines.extend(WRAP.statement("    is_angle =", &format!("np.array([{}])", angles.join(", ")), ""));
        let text = format!(
            "
    def check(self, found, k):
        self.assertEqual(found.count, len(self.known[k]))
        self.assertEqual(found.certificate, self.certificates[k])
        for results, multiplicity, free in self.known[k]:
            apart = found.{} - np.array(results)
            turns = np.round(apart / (2 * np.pi))
            apart = np.where(self.is_angle, apart - 2 * np.pi * turns, apart)
            alike = (found.multiplicity == multiplicity) & (found.free == free)
            alike &= found.residual <= 1e-9
            alike &= np.abs(apart).max(axis=-1) <= self.tolerances[k]
            self.assertTrue(alike.any())
            for branch in found.branch[: found.count]:
                self.assertIsInstance({name}.{}[branch], str)

    def test_one_row(self):
        for k, arguments in enumerate(self.arguments):
            self.check({name}.{f}(self.given[k], *arguments), k)

    def test_all_rows(self):
        for k, arguments in enumerate(self.arguments):
            found = {name}.{f}(self.given, *arguments)
            self.check({name}.{}(*(part[k] for part in found)), k)
        found = {name}.{f}(self.given[:0], *arguments)
        self.assertEqual(found.count.shape, (0,))",
            plan.result,
            labels(plan),
            class(plan),
        );
        lines.extend(text.lines().map(str::to_string));
        lines
    }
}
