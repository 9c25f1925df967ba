//! The tests of the emitted CUDA: one to build with nvcc, one that compiles at run time.

use super::Source;
use crate::c::{block_comment, test as c};
use crate::compiled::{Function, WIDTH, WRAP, lines};
use crate::wrap::comments;
use std::fmt::Write;

/// Units in the last place that the tests allow, of the scale of a result: the device's sines are off by up to two.
const TOLERANCE: f64 = 8.0;

impl Source<'_> {
    fn tested(&self) -> Vec<&Function<'_>> {
        self.functions.iter().filter(|f| !f.routine.vectors.is_empty()).collect()
    }

    /// For nvcc.
    pub(super) fn host_test(&self) -> String {
        let name = &self.name;
        let mut text = block_comment(self.lines().chain([
            "",
            "The stored configurations. Build and run on a machine with a GPU and the CUDA toolkit:",
            &format!("    nvcc -O3 test_{name}.cu -o test_{name} && ./test_{name}"),
            &format!("Without the toolkit, test_{name}.py does the same."),
        ]));
        let head = include_str!("test_head.cu").replace("@name@", name);
        let (includes, rest) = head.split_once("\nstatic int failures;").unwrap_or((&head, ""));
        text.push_str(includes);
        if self.tested().is_empty() && self.solved().is_empty() {
            return text + "\nint main()\n{\n    return 0;\n}\n";
        }
        text.push_str(&c::preamble(self.library, TOLERANCE));
        text.push_str("\nstatic int failures;");
        text.push_str(rest);
        for f in self.tested() {
            text.push_str(&c::tables(f, self.library));
            text.push_str(&c::filled(include_str!("test_function.cu"), f, self.library, name));
        }
        self.solved().iter().for_each(|plan| text.push_str(&self.solver_test(plan)));
        text.push_str("\nint main()\n{\n");
        let (tested, solved) = (self.tested(), self.solved());
        for name in tested.iter().map(|f| &f.name).chain(solved.iter().map(|p| &p.name)) {
            let _ = writeln!(text, "    test_{name}();");
        }
        let _ = write!(
            text,
            "    if (failures == 0) {{\n        std::puts(\"{name}: all configurations agree\");\n    }}\n    \
             return failures != 0;\n}}\n"
        );
        text
    }

    /// For the run-time compiler.
    pub(super) fn python_test(&self) -> String {
        let mut tables = String::from("FUNCTIONS = [\n");
        for f in self.tested() {
            let has_parameters = !f.parameters(self.library).is_empty();
            let scales = list(&f.routine.scales, 8);
            let _ = write!(
                tables,
                "    {{\n        \"kernel\": \"{}_{}_kernel\",\n        \"scales\": {scales},\n        \
                 \"vectors\": [\n",
                self.name, f.name
            );
            for v in &f.routine.vectors {
                let parameters: &[f64] = if has_parameters { &v.parameters } else { &[] };
                let [a, b, c] = [&v.variables, parameters, &v.results].map(|values| list(values, 16));
                let margin = " ".repeat(16);
                let _ = write!(
                    tables,
                    "            (\n{margin}{a},\n{margin}{b},\n{margin}{c},\n            ),\n"
                );
            }
            tables.push_str("        ],\n    },\n");
        }
        tables.push_str("]\nSOLVERS = [\n");
        self.solved().iter().for_each(|plan| tables.push_str(&self.solver_table(plan)));
        tables.push_str("]\n");
        let (ctype, epsilon, rounding, units) = if self.is_single() {
            (
                "c_float",
                "2.0**-23",
                "; variables are rounded as they come in",
                "(8.0 + sum(map(abs, variables)))",
            )
        } else {
            ("c_double", "2.0**-52", "", "8.0")
        };
        let opening = lines(&comments(self.lines(), "# ", WIDTH));
        let script = include_str!("test.py.txt")
            .replace("@ctype@", ctype)
            .replace("@epsilon@", epsilon)
            .replace("@rounding@", rounding)
            .replace("@units@", units)
            .replace("@name@", &self.name)
            .replace("@tables@\n", &tables);
        format!("{opening}\n{script}")
    }
}

/// A Python list, in one line if it fits.
pub(super) fn list(values: &[f64], indent: usize) -> String {
    let values: Vec<String> = values.iter().map(|x| format!("{x:?}")).collect();
    let whole = format!("[{}]", values.join(", "));
    if indent + 12 + whole.len() <= WIDTH {
        return whole;
    }
    format!("[\n{}{}]", lines(&WRAP.list(&values, indent + 4)), " ".repeat(indent))
}
