//! Solvers in CUDA: device functions that fill an array of solutions, and kernels over rows side by side.

use super::{Source, test::list};
use crate::c;
use crate::c::solver::{ROOTS, constants, filled, keep, signature, stored, structure, tables};
use crate::compiled::{Body, WIDTH, lines};
use crate::nested::{Nested, routines};
use crate::solver::Plan;
use crate::{Language, Precision};
use std::fmt::Write;

impl Source<'_> {
    /// The device functions, with the routines for roots.
    pub(super) fn solvers(&self) -> String {
        if self.plans.is_empty() {
            return String::new();
        }
        let prefixed = |text: String| {
            let text = text.replace("@p@", &format!("{}_", self.name));
            let text = text.replace("@P@", &format!("{}_", self.name.to_uppercase()));
            let text =
                text.replace("\nstatic ", "\n__device__ inline ").replace("    static const", "    const");
            // Names with prefixes may not fit in a line.
            let narrow = |line: &str| match line.split_once('(') {
                Some((head, arguments)) if line.len() > WIDTH && !line.starts_with(' ') => {
                    signature(&format!("{head}("), arguments) + "\n"
                }
                _ => format!("{line}\n"),
            };
            text.lines().map(narrow).collect::<String>()
        };
        let mut text = format!("\n{}", prefixed(routines(ROOTS, &self.plans)));
        for plan in &self.plans {
            text.push_str(&self.solver(plan, &prefixed(format!("\n{}", keep(plan, &self.name)))));
        }
        text
    }

    fn macro_name(&self, plan: &Plan) -> String {
        format!("{}_{}_MAX", self.name.to_uppercase(), plan.name.to_uppercase())
    }

    fn solver(&self, plan: &Plan, keep: &str) -> String {
        let (name, f) = (&self.name, &plan.name);
        let max = self.macro_name(plan);
        let labels: Vec<String> =
            plan.labels().iter().enumerate().map(|(k, label)| format!("  {k}: {label}")).collect();
        let words = ["The branches, by their number:".to_string()];
        let words = c::block_comment(words.iter().chain(&labels).map(String::as_str));
        let mut text = format!("\n{}\n{words}{keep}", structure(plan, name, &max));
        let read = plan.parameters(self.library);
        let parameters =
            if read.is_empty() { String::new() } else { format!("const {name}_parameters &parameters, ") };
        let n = plan.routine.solver.variables.len().max(1);
        let arguments = format!(
            "const double {}[{n}], {parameters}{name}_{f}_solution solutions[{max}], {name}_{f}_certificate &certificate)",
            plan.argument
        );
        let head = signature(&format!("__device__ inline int {name}_{f}("), &arguments);
        let _ = write!(text, "\n/* Fills the array of the caller; returns the number of solutions. */\n");
        let mut out = Body { text: format!("{text}{head}\n{{\n"), indent: 4 };
        if plan.variables().is_empty() {
            out.line(&format!("(void){};", plan.argument));
        }
        for symbol in read {
            let (local, field) = (plan.names.of(symbol), self.names.of(symbol));
            out.line(&format!("const double {local} = parameters.{field};"));
        }
        for (k, symbol) in plan.variables() {
            out.line(&format!("const double {} = {}[{k}];", plan.names.of(symbol), plan.argument));
        }
        out.line("int count = 0;");
        out.line(&format!("int is_near = {};", u8::from(plan.may_hide)));
        out.blank();
        let prefix = format!("{name}_");
        let mut nested = Nested::new(plan, Language::Cuda, &prefix, "atan2");
        nested.sine_cosine = Some("sincos");
        let [complete, singular, not_a_pose] = constants(plan, name);
        nested.refusal = vec![format!("certificate = {not_a_pose};"), "return 0;".into()];
        let (whole, keep) = (format!("{name}_{f}"), format!("{name}_keep_{f}"));
        let body = nested.body(|leaf, indent| stored(leaf, indent, &whole, &keep));
        out.text.push_str(&lines(&body));
        out.statement("certificate =", &format!("is_near ? {singular} : {complete}"));
        out.line("return count;");
        out.text + "}\n"
    }

    /// The kernel of a solver.
    pub(super) fn solver_kernel(&self, plan: &Plan) -> String {
        let (name, f, m) = (&self.name, &plan.name, plan.outputs.len());
        let has_parameters = !plan.parameters(self.library).is_empty();
        let parameters =
            if has_parameters { format!("{name}_parameters parameters, ") } else { String::new() };
        let arguments = format!(
            "size_t count, const double *__restrict__ {}, {parameters}double *__restrict__ solutions)",
            plan.argument
        );
        let words = c::block_comment([
            "Always in double precision. Place i of the results holds the number of solutions of row i, place",
            "count + i its certificate; the first solution stands at places 2 count + i, 3 count + i, ...:",
            &format!("{m} results, residual, multiplicity, branch, free; the next one {} rows later.", m + 4),
        ]);
        let head = signature(&format!("extern \"C\" __global__ void {name}_{f}_kernel("), &arguments);
        let body = include_str!("kernel_solver.cu")
            .replace("@n@", &plan.routine.solver.variables.len().max(1).to_string())
            .replace("@m@", &m.to_string())
            .replace("@w@", &(m + 4).to_string())
            .replace("@MAX@", &self.macro_name(plan))
            .replace("@given@", if has_parameters { "parameters, " } else { "" })
            .replace("@argument@", &plan.argument)
            .replace("@result@", &plan.result)
            .replace("@name@", name)
            .replace("@f@", f);
        format!("\n{words}{head}\n{body}")
    }

    /// The solvers that are tested; all in double precision.
    pub(super) fn solved(&self) -> Vec<&Plan<'_>> {
        let is_double = self.library.precision == Precision::Double;
        self.plans.iter().filter(|p| is_double && !p.routine.vectors.is_empty()).collect()
    }

    /// The test for nvcc.
    pub(super) fn solver_test(&self, plan: &Plan) -> String {
        tables(plan, self.library) + &filled(include_str!("test_solver.cu"), plan, self.library, &self.name)
    }

    /// The table for the run-time compiler.
    pub(super) fn solver_table(&self, plan: &Plan) -> String {
        let has_parameters = !plan.parameters(self.library).is_empty();
        let angles: Vec<&str> =
            plan.routine.solver.angles.iter().map(|a| if *a { "True" } else { "False" }).collect();
        let mut text = format!(
            "    {{\n        \"kernel\": \"{}_{}_kernel\",\n        \"most\": {},\n        \"angles\": [{}],\n        \
             \"vectors\": [\n",
            self.name,
            plan.name,
            plan.max(),
            angles.join(", ")
        );
        for v in &plan.routine.vectors {
            let parameters: &[f64] = if has_parameters { &v.parameters } else { &[] };
            let [a, b] = [&v.variables[..], parameters].map(|values| list(values, 16));
            let _ = write!(
                text,
                "            (\n                {a},\n                {b},\n                [\n"
            );
            for s in &v.solutions {
                let results = list(&s.results, 24);
                let _ = write!(
                    text,
                    "                    (\n                        {results},\n                        {},\n                        {},\n                    ),\n",
                    s.multiplicity, s.free
                );
            }
            let _ = write!(
                text,
                "                ],\n                {:?},\n                {},\n            ),\n",
                v.tolerance,
                v.certificate.code()
            );
        }
        text + "        ],\n    },\n"
    }
}
