//! The test of the emitted Rust: the stored configurations, one by one and in blocks.

use super::Source;
use crate::emit::Vector;
use crate::emit::compiled::{Body, Function, TOLERANCE, WIDTH, WRAP, lines};
use std::fmt::Write;

impl Source<'_> {
    pub(super) fn test(&self) -> String {
        let mut text = self.head("// ", &["", "The stored configurations, one by one and in blocks."]);
        let tested: Vec<&Function> =
            self.functions.iter().filter(|f| !f.routine.vectors.is_empty()).collect();
        text.push_str(
            "\n#![allow(non_snake_case, clippy::approx_constant, clippy::excessive_precision)]\n\n",
        );
        if tested.is_empty() {
            return text;
        }
        let mut used = vec!["LANES".to_string()];
        if tested.iter().any(|f| !f.parameters(self.library).is_empty()) {
            used.push("Parameters".into());
        }
        used.extend(tested.iter().flat_map(|f| [f.name.clone(), format!("{}_block", f.name)]));
        let whole = format!("use {}::{{{}}};", self.name, used.join(", "));
        let fits = whole.len() <= WIDTH;
        let split = format!("use {}::{{\n{}}};", self.name, lines(&WRAP.list(&used, 4)));
        let _ = write!(
            text,
            "{}\nuse std::array::from_fn;\n\n\
             /// Units in the last place, of the scale of a result.\nconst UNITS: f64 = {TOLERANCE:?};\n\n\
             /// Equal bits; all that are not numbers are alike.\nfn same(a: f64, b: f64) -> bool {{\n    \
             a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())\n}}\n",
            if fits { whole } else { split }
        );
        if tested.iter().any(|f| !f.parameters(self.library).is_empty()) {
            text.push_str(&self.parameters_of_a_row());
        }
        tested.iter().for_each(|f| text.push_str(&self.test_of(f)));
        text
    }

    /// The parameters from a row of a table, in a function of its own: their names may be those of functions.
    fn parameters_of_a_row(&self) -> String {
        let all = &self.library.parameters;
        let symbols: Vec<String> = all.iter().map(|p| self.names.of(p.symbol).to_string()).collect();
        let mut out = Body { text: String::new(), indent: 4 };
        out.list("let [", &symbols, "] = values;");
        out.list_spaced("Parameters {", &symbols, "}");
        let head = format!("fn parameters(values: [f64; {}]) -> Parameters {{", all.len());
        format!("\n/// A row of a table.\n{head}\n{}}}\n", out.text)
    }

    fn test_of(&self, f: &Function) -> String {
        let (vectors, upper) = (&f.routine.vectors, f.name.to_uppercase());
        let has_parameters = !f.parameters(self.library).is_empty();
        let table = |what: &str, width: usize, rows: Vec<&[f64]>| {
            let head = format!("\nconst {upper}_{what}: [[f64; {width}]; {}] = [\n", rows.len());
            head + &rows.into_iter().map(row).collect::<String>() + "];\n"
        };
        let of = |part: fn(&Vector) -> &[f64]| vectors.iter().map(part).collect::<Vec<_>>();
        let mut text = table("VARIABLES", self.library.variables.len(), of(|v| &v.variables));
        if has_parameters {
            text.push_str(&table("PARAMETERS", self.library.parameters.len(), of(|v| &v.parameters)));
        }
        text.push_str(&table("RESULTS", f.results(), of(|v| &v.results)));
        let scales = lines(&WRAP.list(&numbers(&f.routine.scales), 4));
        let _ = write!(text, "\nconst {upper}_SCALES: [f64; {}] = [\n{scales}];\n", f.results());
        let given = match has_parameters {
            true => format!("        let parameters = parameters({upper}_PARAMETERS[v]);\n"),
            false => String::new(),
        };
        // The second place is one level further out.
        let outer: String =
            given.lines().map(|line| format!("{}\n", line.strip_prefix("    ").unwrap_or(line))).collect();
        let body = include_str!("test_function.rs.txt")
            .replacen("@parameters@\n", &given, 1)
            .replacen("@parameters@\n", &outer, 1)
            .replace("    let v = 0;\n", if has_parameters { "    let v = 0;\n" } else { "" })
            .replace(
                "@F@_VARIABLES[v][j]",
                if has_parameters { "@F@_VARIABLES[v][j]" } else { "@F@_VARIABLES[0][j]" },
            )
            .replace("@argument@", if has_parameters { ", &parameters" } else { "" })
            .replace("@flat@", &".as_flattened()".repeat(f.shape().len() - 1))
            .replace("@n@", &self.library.variables.len().to_string())
            .replace("@m@", &f.results().to_string())
            .replace("@f@", &f.name)
            .replace("@F@", &upper);
        text + &body
    }
}

/// A row of a table.
fn row(values: &[f64]) -> String {
    let list = numbers(values);
    let whole = format!("    [{}],\n", list.join(", "));
    if whole.len() <= WIDTH {
        return whole;
    }
    format!("    [\n{}    ],\n", lines(&WRAP.list(&list, 8)))
}

fn numbers(values: &[f64]) -> Vec<String> {
    values.iter().map(|x| format!("{x:?}")).collect()
}
