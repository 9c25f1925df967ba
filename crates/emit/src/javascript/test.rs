//! The test that goes along with a module: stored configurations, alone and together, and what is refused.

use crate::Routine;
use crate::javascript::{Functions, Module, WRAP, attached, call};

impl Module<'_> {
    pub(super) fn tests(&self) -> Vec<String> {
        let mut lines = self.header();
        let mut imports: Vec<&str> = vec![];
        for functions in &self.functions {
            imports.extend([functions.one.as_str(), functions.batch.as_str()]);
        }
        let solvers: Vec<String> = self.plans.iter().flat_map(|p| [p.name.clone(), self.labels(p)]).collect();
        imports.extend(solvers.iter().map(String::as_str));
        let attached = self.attached();
        imports.extend(attached::functions(&attached));
        imports.sort_unstable();
        lines.extend(
            [
                "",
                "// The functions at stored configurations; results of an independent source.",
                "",
                "import assert from \"node:assert/strict\";",
                "import test from \"node:test\";",
            ]
            .map(String::from),
        );
        let whole = format!("import {{ {} }} from \"./{}.js\";", imports.join(", "), self.name);
        if whole.len() <= WRAP.width {
            lines.push(whole);
        } else {
            lines.push("import {".into());
            lines.extend(imports.iter().map(|name| format!("  {name},")));
            lines.push(format!("}} from \"./{}.js\";", self.name));
        }
        let text = r"
// Units in the last place of the size of a result.
const TOLERANCE = 4 * 2 ** -52;

/**
 * @param {ArrayLike<number>} actual
 * @param {ArrayLike<number>} expected
 * @param {ArrayLike<number>} scales
 */
function check(actual, expected, scales) {
  assert.equal(actual.length, expected.length);
  for (let k = 0; k < expected.length; k++) {
    const error = Math.abs(actual[k] - expected[k]);
    const bound = TOLERANCE * scales[k];
    assert.ok(error <= bound, `result ${k}: ${actual[k]}, not ${expected[k]}`);
  }
}";
        if !self.functions.is_empty() {
            lines.extend(text.lines().map(str::to_string));
        }
        for (routine, functions) in self.library.routines.iter().zip(&self.functions) {
            lines.extend(self.test(routine, functions));
        }
        self.plans.iter().for_each(|plan| lines.extend(self.solver_test(plan)));
        lines.extend(self.attached_tests().lines().map(str::to_string));
        lines
    }

    fn test(&self, routine: &Routine, functions: &Functions) -> Vec<String> {
        let (n, m) = (self.library.variables.len(), routine.program.outputs().len());
        let Functions { one, batch, cases, scales, .. } = functions;
        let parameters = self.parameters_of(routine);
        let entry = |name: &str, values: &[f64]| -> Vec<String> {
            let numbers = self.numbers(values);
            let whole = format!("    {name}: [{}],", numbers.join(", "));
            if whole.len() <= WRAP.width {
                return vec![whole];
            }
            let mut lines = vec![format!("    {name}: [")];
            lines.extend(WRAP.list(&numbers, 6));
            lines.push("    ],".into());
            lines
        };
        let mut lines = vec![String::new()];
        let numbers = self.numbers(&routine.scales);
        let whole = format!("const {scales} = [{}];", numbers.join(", "));
        if whole.len() <= WRAP.width {
            lines.push(whole);
        } else {
            lines.push(format!("const {scales} = ["));
            lines.extend(WRAP.list(&numbers, 2));
            lines.push("];".into());
        }
        lines.push(format!("const {cases} = ["));
        for vector in &routine.vectors {
            lines.push("  {".into());
            lines.extend(entry("q", &vector.variables));
            if !parameters.is_empty() {
                let values = self.library.parameters.iter().zip(&vector.parameters);
                let values: Vec<String> = values
                    .map(|(p, x)| format!("{}: {}", self.names.of(p.symbol), self.numbers(&[*x])[0]))
                    .collect();
                let whole = format!("    parameters: {{ {} }},", values.join(", "));
                if whole.len() <= WRAP.width {
                    lines.push(whole);
                } else {
                    lines.push("    parameters: {".into());
                    lines.extend(values.iter().map(|value| format!("      {value},")));
                    lines.push("    },".into());
                }
            }
            lines.extend(entry("expected", &vector.results));
            lines.push("  },".into());
        }
        lines.push("];".into());

        let given = if parameters.is_empty() { "" } else { ", parameters" };
        let first = if parameters.is_empty() { String::new() } else { ", parameters".to_string() };
        lines.extend(
            format!(
                "
test(\"{one} of one row\", () => {{
  for (const {{ q, expected{given} }} of {cases}) {{
    const out = new Float64Array({m});
    assert.equal({one}(q, out{given}), out);
    check(out, expected, {scales});
  }}
}});
"
            )
            .lines()
            .map(str::to_string),
        );
        let all = if parameters.is_empty() {
            format!(
                "
test(\"{batch} of all rows\", () => {{
  const q = Float64Array.from({cases}.flatMap((c) => c.q));
  const out = {batch}(q);
  {cases}.forEach(({{ expected }}, k) => {{
    check(out.subarray(k * {m}, (k + 1) * {m}), expected, {scales});
  }});
}});
"
            )
        } else {
            format!(
                "
test(\"{batch} of all rows\", () => {{
  const q = Float64Array.from({cases}.flatMap((c) => c.q));
  {cases}.forEach(({{ parameters, expected }}, k) => {{
    const out = {batch}(q, undefined, parameters);
    check(out.subarray(k * {m}, (k + 1) * {m}), expected, {scales});
  }});
}});
"
            )
        };
        if n > 0 {
            lines.extend(all.lines().map(str::to_string));
        }
        let undefined = if first.is_empty() { "" } else { ", undefined" };
        let [more_in, more_out] = [n + 1, m + 1].map(|length| format!("new Float64Array({length})"));
        lines.extend([String::new(), format!("test(\"{one} refuses other lengths\", () => {{")]);
        lines.push(format!("  const q = new Float64Array({n});"));
        if !parameters.is_empty() {
            lines.push(format!("  const {{ parameters }} = {cases}[0];"));
        }
        let mut refused = |refused: String| {
            lines.extend(call("  assert.throws", &format!("() => {refused}, RangeError"), ";"))
        };
        refused(format!("{one}({more_in}{undefined}{first})"));
        refused(format!("{one}(q, {more_out}{first})"));
        if n > 0 {
            refused(format!("{batch}(q, {more_out}{first})"));
        }
        lines.push("});".into());
        lines.extend([String::new(), format!("test(\"{one} refuses other types\", () => {{")]);
        lines.push(format!("  const q = new Float64Array({n});"));
        lines.push(format!("  const refused = [[\"{}\"], [q, {{}}]];", "1".repeat(n)));
        if n > 0 {
            lines.push(format!("  refused.push([Array({n}).fill(\"1\")]);"));
        }
        if let Some(p) = parameters.first() {
            let name = self.names.of(p.symbol);
            lines.push(format!("  const {{ parameters }} = {cases}[0];"));
            lines.push("  refused.push([q, undefined, { ...parameters, \"no such\": 1 }]);".into());
            lines.push("  refused.push([".into());
            lines.push("    q,".into());
            lines.push("    undefined,".into());
            lines.push(format!("    {{ ...parameters, {name}: \"1\" }},"));
            lines.push("  ]);".into());
        }
        lines.push("  for (const given of refused) {".into());
        for function in [one, batch] {
            lines.push("    // @ts-expect-error: other types on purpose".into());
            lines.push(format!("    assert.throws(() => {function}(...given), TypeError);"));
        }
        lines.extend(["  }".to_string(), "});".into()]);
        if let Some(required) = parameters.iter().find(|p| p.default.is_none()) {
            let name = self.names.of(required.symbol);
            lines
                .extend([String::new(), format!("test(\"{one} says which parameter is missing\", () => {{")]);
            lines.push("  // @ts-expect-error: a parameter without a default is required".into());
            lines.push(format!("  const incomplete = () => {one}(new Float64Array({n}));"));
            lines.push(format!("  assert.throws(incomplete, /parameter {name} is missing/);"));
            lines.push("});".into());
        }
        lines
    }
}
