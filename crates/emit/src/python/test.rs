//! The test that goes along with a module: stored configurations, alone and together, and what is refused.

use super::{Module, WRAP, capitalised, documentation, float};
use crate::Routine;

/// What every function is held to; a class of its own adds the configurations.
const STORED: &str = r#"
# Units in the last place of the size of a result.
TOLERANCE = 4 * 2.0**-52


class Stored:
    """A function at stored configurations."""

    def check(self, actual, expected):
        self.assertEqual(actual.dtype, np.float64)
        self.assertEqual(actual.shape, expected.shape)
        error = np.abs(actual - expected) / self.scales
        self.assertLessEqual(np.max(error, initial=0.0), TOLERANCE)

    def test_one_row(self):
        for q, arguments, expected in zip(self.q, self.arguments, self.expected):
            self.check(self.function(q, *arguments), expected)

    def test_all_rows(self):
        for k, arguments in enumerate(self.arguments):
            self.check(self.function(self.q, *arguments)[k], self.expected[k])

    def test_any_leading_shape(self):
        q, arguments, expected = self.q[0], self.arguments[0], self.expected[0]
        for leading in [(), (0,), (1,), (2, 3), (2, 0, 3)]:
            rows = np.broadcast_to(q, leading + q.shape)
            results = np.broadcast_to(expected, leading + expected.shape)
            self.check(self.function(rows, *arguments), results)

    def test_lists_integers_and_single_precision(self):
        n, arguments = self.q.shape[-1], self.arguments[0]
        expected = self.function(np.zeros(n), *arguments)
        for q in [[0] * n, np.zeros(n, dtype=int), np.zeros(n, dtype=np.float32)]:
            self.check(self.function(q, *arguments), expected)

    def test_another_shape(self):
        n, arguments = self.q.shape[-1], self.arguments[0]
        for q in [0.0, np.zeros(n + 1), np.zeros((n, n + 1))]:
            with self.assertRaises(ValueError):
                self.function(q, *arguments)
"#;

impl Module<'_> {
    pub(super) fn tests(&self) -> Vec<String> {
        let mut lines = self.header();
        let about = "The functions at stored configurations; results of an independent source.";
        lines.extend(documentation(&[about.into()], 0));
        lines.extend(
            ["", "import doctest", "import unittest", "", "import numpy as np", ""].map(String::from),
        );
        lines.push(format!("import {}", self.name));
        if !self.functions.is_empty() {
            lines.extend(STORED.lines().map(String::from));
        }
        for (routine, function) in self.library.routines.iter().zip(&self.functions) {
            lines.extend(self.test(routine, function));
        }
        self.plans.iter().for_each(|plan| lines.extend(self.solver_test(plan)));
        lines.extend(self.attached_tests().lines().map(String::from));
        let required = self.library.parameters.iter().find(|p| p.default.is_none());
        if let Some(required) = required {
            lines.extend(["", "", "class Missing(unittest.TestCase):"].map(String::from));
            lines.push("    def test_a_parameter_without_default(self):".into());
            let name = self.names.of(required.symbol);
            lines.push(format!("        with self.assertRaisesRegex(TypeError, \"{name}\"):"));
            lines.push(format!("            {}.Parameters()", self.name));
        }
        lines.extend(["", "", "class Example(unittest.TestCase):"].map(String::from));
        lines.push("    def test_of_the_module(self):".into());
        lines.push(format!("        self.assertEqual(doctest.testmod({}).failed, 0)", self.name));
        lines.extend(["", "", "if __name__ == \"__main__\":", "    unittest.main()"].map(String::from));
        lines
    }

    /// The class of a routine.
    fn test(&self, routine: &Routine, function: &str) -> Vec<String> {
        let mut lines = vec![String::new(), String::new()];
        let class: Vec<String> = function.split('_').map(capitalised).collect();
        lines.push(format!("class Test{}(Stored, unittest.TestCase):", class.concat()));
        lines.extend(WRAP.statement(
            "    function =",
            &format!("staticmethod({}.{function})", self.name),
            "",
        ));
        lines.extend(self.table("q", routine.vectors.iter().map(|v| &v.variables[..]), ""));
        if self.is_parametric(routine) {
            lines.push("    arguments = [".into());
            lines.extend(routine.vectors.iter().flat_map(|v| self.arguments(&v.parameters)));
            lines.push("    ]".into());
        } else {
            lines.push(format!("    arguments = [()] * {}", routine.vectors.len()));
        }
        let shape: Vec<String> = routine.shape.iter().map(|k| k.to_string()).collect();
        let all = [&["-1".to_string()], &shape[..]].concat();
        let all = format!(".reshape({})", all.join(", "));
        lines.extend(self.table("expected", routine.vectors.iter().map(|v| &v.results[..]), &all));
        lines.extend(self.scales(routine, &shape));
        if self.is_parametric(routine) {
            lines.extend(
                [
                    "",
                    "    def test_parameters_of_another_type(self):",
                    "        with self.assertRaisesRegex(TypeError, \"must be Parameters\"):",
                    "            self.function(self.q, {})",
                ]
                .map(String::from),
            );
        }
        lines
    }

    /// An array of the class, a list a row.
    pub(super) fn table<'v>(
        &self,
        name: &str,
        rows: impl Iterator<Item = &'v [f64]>,
        tail: &str,
    ) -> Vec<String> {
        let mut lines = vec![format!("    {name} = np.array("), "        [".into()];
        for row in rows {
            let numbers = self.numbers(row);
            let whole = format!("            [{}],", numbers.join(", "));
            if whole.len() <= WRAP.width {
                lines.push(whole);
                continue;
            }
            lines.push("            [".into());
            lines.extend(WRAP.list(&numbers, 16));
            lines.push("            ],".into());
        }
        lines.extend(["        ]".to_string(), format!("    ){tail}")]);
        lines
    }

    /// A tuple with the parameters.
    pub(super) fn arguments(&self, values: &[f64]) -> Vec<String> {
        let pairs = self.library.parameters.iter().zip(values);
        let given: Vec<String> =
            pairs.map(|(p, x)| format!("{}={}", self.names.of(p.symbol), float(&self.number(*x)))).collect();
        let whole = format!("        ({}.Parameters({}),),", self.name, given.join(", "));
        if whole.len() <= WRAP.width {
            return vec![whole];
        }
        let mut lines = vec!["        (".to_string(), format!("            {}.Parameters(", self.name)];
        lines.extend(WRAP.list(&given, 16));
        lines.extend(["            ),".to_string(), "        ),".to_string()]);
        lines
    }

    /// The size of each result.
    fn scales(&self, routine: &Routine, shape: &[String]) -> Vec<String> {
        let numbers = self.numbers(&routine.scales);
        if let ([], [scale]) = (shape, &numbers[..]) {
            return vec![format!("    scales = {scale}")];
        }
        let tail = format!(".reshape({})", shape.join(", "));
        let whole = format!("    scales = np.array([{}]){tail}", numbers.join(", "));
        if whole.len() <= WRAP.width {
            return vec![whole];
        }
        let mut lines = vec!["    scales = np.array(".to_string(), "        [".into()];
        lines.extend(WRAP.list(&numbers, 12));
        lines.extend(["        ]".to_string(), format!("    ){tail}")]);
        lines
    }
}
