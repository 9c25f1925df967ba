//! The test of the emitted Rust: the stored configurations, one by one and in blocks.

use super::Source;
use super::solver::camel;
use crate::Vector;
use crate::compiled::{Body, Function, TOLERANCE, WIDTH, WRAP, lines};
use crate::solver::Plan;
use std::fmt::Write;

impl Source<'_> {
    pub(super) fn test(&self) -> String {
        let mut text = self.head("// ", &["", "The stored configurations, one by one and in blocks."]);
        let tested: Vec<&Function> =
            self.functions.iter().filter(|f| !f.routine.vectors.is_empty()).collect();
        text.push_str(
            "\n#![allow(non_snake_case, clippy::approx_constant, clippy::excessive_precision)]\n\n",
        );
        let solved: Vec<&Plan> = self.plans.iter().filter(|p| !p.routine.vectors.is_empty()).collect();
        if tested.is_empty() && solved.is_empty() {
            return text;
        }
        let has_parameters = tested.iter().any(|f| !f.parameters(self.library).is_empty())
            || solved.iter().any(|p| !p.parameters(self.library).is_empty());
        let mut used: Vec<String> = tested.first().map(|_| "LANES".to_string()).into_iter().collect();
        if has_parameters {
            used.push("Parameters".into());
        }
        used.extend(tested.iter().flat_map(|f| [f.name.clone(), format!("{}_block", f.name)]));
        for p in &solved {
            let (f, kind, upper) = (&p.name, camel(&p.name), p.name.to_uppercase());
            used.extend([f.clone(), format!("{f}_block"), format!("{kind}Block"), format!("{kind}Solution")]);
            used.push(format!("{kind}Certificate"));
            used.extend(["BRANCHES", "LANES", "MAX"].map(|word| format!("{upper}_{word}")));
        }
        let whole = format!("use {}::{{{}}};", self.name, used.join(", "));
        let fits = whole.len() <= WIDTH;
        let split = format!("use {}::{{\n{}}};", self.name, lines(&WRAP.list(&used, 4)));
        let _ = write!(
            text,
            "{}\nuse std::array::from_fn;\n{}",
            if fits { &whole } else { &split },
            if tested.is_empty() {
                String::new()
            } else {
                format!(
                    "\n/// Units in the last place, of the scale of a result.\nconst UNITS: f64 = {TOLERANCE:?};\n\n\
                     /// Equal bits; all that are not numbers are alike.\nfn same(a: f64, b: f64) -> bool {{\n    \
                     a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())\n}}\n"
                )
            }
        );
        if has_parameters {
            text.push_str(&self.parameters_of_a_row());
        }
        tested.iter().for_each(|f| text.push_str(&self.test_of(f)));
        solved.iter().for_each(|p| text.push_str(&self.test_of_solver(p)));
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

impl Source<'_> {
    fn test_of_solver(&self, plan: &Plan) -> String {
        let (f, upper, vectors) = (&plan.name, plan.name.to_uppercase(), &plan.routine.vectors);
        let has_parameters = !plan.parameters(self.library).is_empty();
        let (n, m) = (plan.routine.solver.variables.len(), plan.outputs.len());
        let mut text = format!("\nconst {upper}_VARIABLES: [[f64; {n}]; {}] = [\n", vectors.len());
        vectors.iter().for_each(|v| text.push_str(&row(&v.variables)));
        text.push_str("];\n");
        if has_parameters {
            let width = self.library.parameters.len();
            let _ = write!(text, "\nconst {upper}_PARAMETERS: [[f64; {width}]; {}] = [\n", vectors.len());
            vectors.iter().for_each(|v| text.push_str(&row(&v.parameters)));
            text.push_str("];\n");
        }
        let _ = write!(
            text,
            "\n/// The solutions: results, multiplicity, free unknowns.\n#[allow(clippy::type_complexity)]\n\
             const {upper}_KNOWN: [&[([f64; {m}], u32, u32)]; {}] = [\n",
            vectors.len()
        );
        for v in vectors {
            text.push_str("    &[\n");
            for s in &v.solutions {
                let list = WRAP.list(&numbers(&s.results), 16);
                let _ = write!(
                    text,
                    "        (\n            [\n{}            ],\n            {},\n            {},\n        ),\n",
                    lines(&list),
                    s.multiplicity,
                    s.free
                );
            }
            text.push_str("    ],\n");
        }
        let tolerances: Vec<f64> = vectors.iter().map(|v| v.tolerance).collect();
        let list = lines(&WRAP.list(&numbers(&tolerances), 4));
        let _ = write!(text, "];\n\nconst {upper}_TOLERANCE: [f64; {}] = [\n{list}];\n", vectors.len());
        let certificates: Vec<String> =
            vectors.iter().map(|v| format!("{}Certificate::{:?}", camel(f), v.certificate)).collect();
        let list = lines(&WRAP.list(&certificates, 4));
        let _ = write!(
            text,
            "\nconst {upper}_CERTIFICATE: [{}Certificate; {}] = [\n{list}];\n",
            camel(f),
            vectors.len()
        );
        let given = match has_parameters {
            true => format!("        let parameters = parameters({upper}_PARAMETERS[v]);\n"),
            false => String::new(),
        };
        let shape = if plan.routine.shape.is_empty() { &[1][..] } else { &plan.routine.shape };
        let letters = ["a", "b", "c", "d"];
        let place: Vec<String> = (0..shape.len())
            .map(|d| match shape[d + 1..].iter().product::<usize>() {
                1 => letters[d].to_string(),
                stride => format!("{stride} * {}", letters[d]),
            })
            .collect();
        let inner = format!("variables[{}]", place.join(" + "));
        let nested = (0..shape.len()).rev().fold(inner, |e, d| format!("from_fn(|{}| {e})", letters[d]));
        let angles: Vec<String> = plan.routine.solver.angles.iter().map(bool::to_string).collect();
        text + &include_str!("test_solver.rs.txt")
            .replace("@parameters@\n", &given)
            .replace("@argument@", if has_parameters { ", &parameters" } else { "" })
            .replace("@nested@", &nested)
            .replace("@angles@", &angles.join(", "))
            .replace("@result@", &plan.result)
            .replace("@n@", &n.to_string())
            .replace("@m@", &m.to_string())
            .replace("@K@", &camel(f))
            .replace("@f@", f)
            .replace("@F@", &upper)
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
