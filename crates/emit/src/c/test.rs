//! The test of the emitted C: the stored configurations, one by one and in blocks.

use super::{Source, block_comment};
use crate::compiled::{Function, TOLERANCE, WIDTH, WRAP, lines};
use crate::names::Names;
use crate::spelling::Spelling;
use crate::{Language, Library, Precision, Vector};
use std::fmt::Write;

impl Source<'_> {
    pub(super) fn test(&self) -> String {
        let name = &self.name;
        let words = format!("The stored configurations of {name}.c, one by one and in blocks.");
        let mut text = block_comment(self.lines().chain(["", &words]));
        let tested: Vec<&Function> =
            self.functions.iter().filter(|f| !f.routine.vectors.is_empty()).collect();
        let head = include_str!("test_head.c");
        let head =
            if tested.is_empty() { head.split("\nstatic void\n").next().unwrap_or(head) } else { head };
        text.push_str(&head.replace("@name@", name).replace("@N@", &self.upper()));
        if !tested.is_empty() {
            text.push_str(&preamble(self.library, TOLERANCE));
        }
        for f in &tested {
            text.push_str(&tables(f, self.library));
            text.push_str(&filled(include_str!("test_function.c"), f, self.library, name));
        }
        let solved = || self.plans.iter().filter(|p| !p.routine.vectors.is_empty());
        solved().for_each(|plan| text.push_str(&self.solver_test(plan)));
        text.push_str(&self.attached(|a| &a.test));
        text.push_str("\nint main(void)\n{\n");
        let attached = self.library.attachments.iter().map(|a| &a.name);
        for name in tested.iter().map(|f| &f.name).chain(solved().map(|p| &p.name)).chain(attached) {
            let _ = writeln!(text, "    test_{name}();");
        }
        let _ = write!(
            text,
            "    if (failures == 0) {{\n        puts(\"{name}: all configurations agree\");\n    }}\n    \
             return failures != 0;\n}}\n"
        );
        text
    }
}

/// The type of numbers, their number in a configuration, and what a result may be off by.
pub(crate) fn preamble(library: &Library, units: f64) -> String {
    let variables = library.variables.len().max(1);
    let real = if library.precision == Precision::Single { "float" } else { "double" };
    let head = format!("\ntypedef {real} real;\n\nenum {{ VARIABLES = {variables} }};\n\n");
    let rest = match library.precision {
        Precision::Double => format!(
            "/* Units in the last place, of the scale of a result. */\n\
             static double tolerance(const double *variables)\n{{\n    (void)variables;\n    \
             return {units:?} * DBL_EPSILON;\n}}\n"
        ),
        Precision::Single => format!(
            "/* Units in the last place, of the scale of a result. Variables are rounded as they come in. */\n\
             static double tolerance(const double *variables)\n{{\n    double units = {units:?};\n    \
             for (int j = 0; j < VARIABLES; j++) {{\n        units += fabs(variables[j]);\n    }}\n    \
             return units * (double)FLT_EPSILON;\n}}\n"
        ),
    };
    head + &rest
}

/// The stored configurations of a function.
pub(crate) fn tables(f: &Function, library: &Library) -> String {
    let (function, vectors) = (&f.name, &f.routine.vectors);
    let upper = function.to_uppercase();
    let mut text =
        format!("\nenum {{ {upper}_VECTORS = {}, {upper}_RESULTS = {} }};\n", vectors.len(), f.results());
    let table = |what: &str, width: usize, rows: Vec<&[f64]>| {
        let head = format!("\nstatic const double {function}_{what}[{upper}_VECTORS][{width}] = {{\n");
        head + &rows.into_iter().map(row).collect::<String>() + "};\n"
    };
    let of = |part: fn(&Vector) -> &[f64]| vectors.iter().map(part).collect::<Vec<_>>();
    text.push_str(&table("variables", library.variables.len().max(1), of(|v| &v.variables)));
    if !f.parameters(library).is_empty() {
        text.push_str(&table("parameters", library.parameters.len(), of(|v| &v.parameters)));
    }
    text.push_str(&table("results", f.results(), of(|v| &v.results)));
    let scales = lines(&WRAP.list(&numbers(&f.routine.scales), 4));
    let _ = write!(text, "\nstatic const double {function}_scales[{upper}_RESULTS] = {{\n{scales}}};\n");
    text
}

/// The template of a test with the words of a function in it.
pub(crate) fn filled(template: &str, f: &Function, library: &Library, name: &str) -> String {
    let function = &f.name;
    let has_parameters = !f.parameters(library).is_empty();
    let given: Vec<String> =
        (0..library.parameters.len()).map(|k| format!("(real){function}_parameters[v][{k}]")).collect();
    let given = lines(&WRAP.list(&given, 12));
    let given = format!("        const {name}_parameters parameters = {{\n{given}        }};\n");
    let shape: String = f.shape().iter().map(|n| format!("[{n}]")).collect();
    template
        .replace("@parameters@\n", if has_parameters { &given } else { "" })
        .replace("@argument@", if has_parameters { "parameters, " } else { "" })
        .replace("@address@", if has_parameters { "&parameters, " } else { "" })
        .replace("@result@", &f.result)
        .replace("@shape@", &shape)
        .replace("@first@", &"[0]".repeat(f.shape().len() - 1))
        .replace("@f@", function)
        .replace("@F@", &function.to_uppercase())
        .replace("@name@", name)
}

/// A row of a table, in braces.
pub(crate) fn row(values: &[f64]) -> String {
    let values = if values.is_empty() { &[0.0] } else { values };
    let list = numbers(values);
    let whole = format!("    {{{}}},\n", list.join(", "));
    if whole.len() <= WIDTH {
        return whole;
    }
    format!("    {{\n{}    }},\n", lines(&WRAP.list(&list, 8)))
}

/// Numbers of double precision, in which the tests compare.
pub(crate) fn numbers(values: &[f64]) -> Vec<String> {
    let names = Names::default();
    let spelling = Spelling { language: Language::C, precision: Precision::Double, names: &names };
    values.iter().map(|x| spelling.number(*x)).collect()
}
