//! Solvers in C: a function that fills an array of solutions, with the routines for the roots that it calls.

use super::{RESERVED, Source, WIDTH, block_comment, test};
use crate::compiled::{Body, WRAP, lines};
use crate::nested::{Leaf, Nested, element, part, routines};
use crate::solver::Plan;
use crate::{Certificate, Language, Library, Precision};
use denavit_program::Count;
use std::fmt::Write;

/// The routines for roots; parts begin with a line `@ name`.
pub(crate) const ROOTS: &str = include_str!("roots.c");
/// Words that emitted solvers use.
pub(crate) const WORDS: &[&str] = &[
    "roots",
    "solutions",
    "count",
    "found",
    "fabs",
    "fmax",
    "fmin",
    "floor",
    "guard",
    "clamp",
    "dbl_max",
    "ratio_roots",
    "direction_roots",
    "line_roots",
    "length_roots",
    "sincos_roots",
    "quadratic_roots",
    "quartic_roots",
    "polynomial",
    "root_between",
    "certificate",
    "tolerance",
    "is_near",
];

/// What names in solvers are not.
pub(crate) fn reserved() -> Vec<&'static str> {
    RESERVED.iter().chain(WORDS).copied().filter(|word| *word != "q").collect()
}

impl Source<'_> {
    /// What the header says of a solver.
    pub(super) fn declaration(&self, plan: &Plan) -> String {
        let (name, f) = (&self.name, &plan.name);
        let macro_name = format!("{}_{}_MAX", self.upper(), f.to_uppercase());
        let words = format!("The labels of the branches of {name}_{f}, by their number.");
        format!(
            "\n{}\n/* {words} */\nextern const char *const {name}_{f}_branches[{macro_name}];\n\n\
             /* Fills the array of the caller; returns the number of solutions. The certificate may be NULL. */\n{};\n",
            structure(plan, name, &macro_name),
            self.solver_signature(plan, "")
        )
    }

    fn solver_signature(&self, plan: &Plan, prefix: &str) -> String {
        let (name, f) = (&self.name, &plan.name);
        let parameters = match plan.parameters(self.library).is_empty() {
            true => String::new(),
            false => format!(", const {name}_parameters *parameters"),
        };
        let n = plan.routine.solver.variables.len().max(1);
        let max = format!("{}_{}_MAX", self.upper(), f.to_uppercase());
        let argument = &plan.argument;
        signature(
            &format!("{prefix}int {name}_{f}("),
            &format!(
                "const double {argument}[{n}]{parameters}, {name}_{f}_solution solutions[{max}], \
                 {name}_{f}_certificate *certificate)"
            ),
        )
    }

    /// The solvers with their routines.
    pub(super) fn solvers(&self) -> String {
        if self.plans.is_empty() {
            return String::new();
        }
        let mut text = format!("\n{}", routines(ROOTS, &self.plans).replace("@p@", "").replace("@P@", ""));
        for plan in &self.plans {
            let (name, f) = (&self.name, &plan.name);
            let max = format!("{}_{}_MAX", self.upper(), f.to_uppercase());
            text.push_str(&keep(plan, name).replace("@p@", ""));
            let labels: Vec<String> = plan.labels().iter().map(|l| format!("    \"{l}\",\n")).collect();
            let _ =
                write!(text, "\nconst char *const {name}_{f}_branches[{max}] = {{\n{}}};\n", labels.concat());
            text.push_str(&self.solver(plan));
        }
        text
    }

    pub(super) fn solver(&self, plan: &Plan) -> String {
        let is_double = self.library.precision == Precision::Double;
        let mut out = Body { text: format!("\n{}\n{{\n", self.solver_signature(plan, "")), indent: 4 };
        if plan.variables().is_empty() {
            out.line(&format!("(void){};", plan.argument));
        }
        for symbol in plan.parameters(self.library) {
            let (local, field) = (plan.names.of(symbol), self.names.of(symbol));
            let cast = if is_double { "" } else { "(double)" };
            out.line(&format!("const double {local} = {cast}parameters->{field};"));
        }
        for (k, symbol) in plan.variables() {
            out.line(&format!("const double {} = {}[{k}];", plan.names.of(symbol), plan.argument));
        }
        out.line("int count = 0;");
        out.line(&format!("int is_near = {};", u8::from(plan.may_hide)));
        out.blank();
        let atan2 = if is_double { "any_atan2" } else { "atan2" };
        let mut nested = Nested::new(plan, Language::C, "", atan2);
        nested.sine_cosine = is_double.then_some("sine_cosine");
        let [complete, singular, not_a_pose] = constants(plan, &self.name);
        nested.refusal =
            ["if (certificate) {", &format!("    *certificate = {not_a_pose};"), "}", "return 0;"]
                .map(String::from)
                .to_vec();
        let prefix = format!("{}_{}", self.name, plan.name);
        let body = nested.body(|leaf, indent| stored(leaf, indent, &prefix, &format!("keep_{}", plan.name)));
        out.text.push_str(&lines(&body));
        out.line("if (certificate) {");
        out.statement("    *certificate =", &format!("is_near ? {singular} : {complete}"));
        out.line("}");
        out.line("return count;");
        out.text + "}\n"
    }

    /// The test of a solver.
    pub(super) fn solver_test(&self, plan: &Plan) -> String {
        tables(plan, self.library) + &filled(include_str!("test_solver.c"), plan, self.library, &self.name)
    }
}

/// A function with its arguments, each in a line of its own if one line is too long.
pub(crate) fn signature(head: &str, arguments: &str) -> String {
    let whole = format!("{head}{arguments}");
    if whole.len() < WIDTH {
        return whole;
    }
    format!("{head}\n    {}", arguments.replace(", ", ",\n    "))
}

/// The structure of a solution, with what is to be said of the function.
pub(crate) fn structure(plan: &Plan, name: &str, macro_name: &str) -> String {
    let mut words = plan.about();
    let shape: Vec<String> = plan.routine.shape.iter().map(usize::to_string).collect();
    words.push(format!(
        "Takes {} values, {} row by row. Between the roots, each branch once: {}.",
        plan.routine.solver.variables.len(),
        if shape.is_empty() { "a number".into() } else { shape.join(" x ") },
        counts(plan)
    ));
    let words = block_comment(words.iter().map(String::as_str));
    format!(
        "{words}#define {macro_name} {}\n\ntypedef struct {name}_{f}_solution {{\n    double {}[{}];\n    \
         double residual;\n    int multiplicity;\n    int branch;\n    unsigned free;\n}} {name}_{f}_solution;\n\n\
         typedef enum {name}_{f}_certificate {{\n{}\n}} {name}_{f}_certificate;\n",
        plan.max(),
        plan.result,
        plan.outputs.len().max(1),
        constants(plan, name)
            .iter()
            .enumerate()
            .map(|(k, c)| format!("    {c} = {k}"))
            .collect::<Vec<_>>()
            .join(",\n"),
        f = plan.name,
    )
}

/// The values of the certificate.
pub(crate) fn constants(plan: &Plan, name: &str) -> [String; 3] {
    let prefix = format!("{}_{}", name.to_uppercase(), plan.name.to_uppercase());
    Certificate::ALL.map(|c| format!("{prefix}_{}", c.words().replace(' ', "_").to_uppercase()))
}

/// What the programs between roots cost, each taken once.
pub(crate) fn counts(plan: &Plan) -> String {
    plan.routine.solver.levels.iter().map(|l| l.program.count()).sum::<Count>().to_string()
}

/// The function that keeps a solution.
pub(crate) fn keep(plan: &Plan, name: &str) -> String {
    let angles: Vec<&str> = plan.routine.solver.angles.iter().map(|a| if *a { "1" } else { "0" }).collect();
    part(ROOTS, "keep")
        .replace("@angles@", &angles.join(", "))
        .replace("@name@", name)
        .replace("@f@", &plan.name)
        .replace("@m@", &plan.outputs.len().to_string())
        .replace("@result@", &plan.result)
}

/// What is done with a solution.
pub(crate) fn stored(leaf: &Leaf, indent: usize, prefix: &str, keep: &str) -> Vec<String> {
    let mut lines = vec![format!("const {prefix}_solution found = {{")];
    let whole = format!("    {{{}}},", leaf.outputs.join(", "));
    if indent + whole.len() <= WIDTH {
        lines.push(whole);
    } else {
        lines.push("    {".into());
        lines.extend(
            leaf.outputs.iter().flat_map(|e| element(indent + 4, e)).map(|line| format!("    {line}")),
        );
        lines.push("    },".into());
    }
    let Leaf { residual, multiplicity, branch, free, .. } = leaf;
    lines.extend([residual, multiplicity, branch, free].into_iter().flat_map(|e| element(indent, e)));
    lines.push("};".into());
    lines.push(format!("count = {keep}(solutions, count, &found);"));
    lines
}

/// The stored solutions.
pub(crate) fn tables(plan: &Plan, library: &Library) -> String {
    let (f, upper) = (&plan.name, plan.name.to_uppercase());
    let vectors = &plan.routine.vectors;
    let all: Vec<_> = vectors.iter().flat_map(|v| &v.solutions).collect();
    let mut text =
        format!("\nenum {{ {upper}_VECTORS = {}, {upper}_KNOWN = {} }};\n", vectors.len(), all.len().max(1));
    let table = |what: &str, width: usize, rows: Vec<&[f64]>| {
        let count = if what == "known" { "KNOWN" } else { "VECTORS" };
        let head = format!("\nstatic const double {f}_{what}[{upper}_{count}][{width}] = {{\n");
        head + &rows.into_iter().map(test::row).collect::<String>() + "};\n"
    };
    let n = plan.routine.solver.variables.len().max(1);
    text.push_str(&table("variables", n, vectors.iter().map(|v| &v.variables[..]).collect()));
    if !plan.parameters(library).is_empty() {
        let rows = vectors.iter().map(|v| &v.parameters[..]).collect();
        text.push_str(&table("parameters", library.parameters.len(), rows));
    }
    let none = vec![0.0; plan.outputs.len()];
    let rows = if all.is_empty() { vec![&none[..]] } else { all.iter().map(|s| &s.results[..]).collect() };
    text.push_str(&table("known", plan.outputs.len(), rows));
    let mut ends = vec![0];
    vectors.iter().for_each(|v| ends.push(ends[ends.len() - 1] + v.solutions.len()));
    let mut list = |head: &str, values: Vec<String>| {
        let values = if values.is_empty() { vec!["0".into()] } else { values };
        let _ = write!(text, "\nstatic const {head} = {{\n{}}};\n", lines(&WRAP.list(&values, 4)));
    };
    list(&format!("double {f}_tolerance[{upper}_VECTORS]"), test::numbers(&tolerances(plan)));
    list(&format!("int {f}_first[{upper}_VECTORS + 1]"), ends.iter().map(usize::to_string).collect());
    let multiplicities = all.iter().map(|s| s.multiplicity.to_string()).collect();
    list(&format!("int {f}_multiplicity[{upper}_KNOWN]"), multiplicities);
    let certificates = vectors.iter().map(|v| v.certificate.code().to_string()).collect();
    list(&format!("int {f}_certificates[{upper}_VECTORS]"), certificates);
    list(&format!("unsigned {f}_free[{upper}_KNOWN]"), all.iter().map(|s| s.free.to_string()).collect());
    text
}

/// What results may be off by.
pub(crate) fn tolerances(plan: &Plan) -> Vec<f64> {
    plan.routine.vectors.iter().map(|v| v.tolerance).collect()
}

/// The template of a test with the words of a solver in it.
pub(crate) fn filled(template: &str, plan: &Plan, library: &Library, name: &str) -> String {
    let f = &plan.name;
    let has_parameters = !plan.parameters(library).is_empty();
    let real = if library.precision == Precision::Single { "(float)" } else { "" };
    let given: Vec<String> =
        (0..library.parameters.len()).map(|k| format!("{real}{f}_parameters[v][{k}]")).collect();
    let given = lines(&WRAP.list(&given, 12));
    let given = format!("        const {name}_parameters parameters = {{\n{given}        }};\n");
    let angles: Vec<&str> = plan.routine.solver.angles.iter().map(|a| if *a { "1" } else { "0" }).collect();
    template
        .replace("@parameters@\n", if has_parameters { &given } else { "" })
        .replace("@argument@", if has_parameters { "parameters, " } else { "" })
        .replace("@address@", if has_parameters { "&parameters, " } else { "" })
        .replace("@angles@", &angles.join(", "))
        .replace("@result@", &plan.result)
        .replace("@n@", &plan.routine.solver.variables.len().max(1).to_string())
        .replace("@m@", &plan.outputs.len().to_string())
        .replace("@MAX@", &format!("{}_{}_MAX", name.to_uppercase(), f.to_uppercase()))
        .replace("@f@", f)
        .replace("@F@", &f.to_uppercase())
        .replace("@name@", name)
}
