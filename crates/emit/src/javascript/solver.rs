//! Solvers in JavaScript: a function that returns an array of solutions.

use super::{Module, WRAP, call, documentation, required_parameters, untagged};
use crate::nested::{Nested, part, routines};
use crate::solver::{Kind, Plan};
use crate::{Certificate, Language, Parameter};

const ROOTS: &str = include_str!("roots.js");
/// Words that emitted solvers use.
pub(super) const WORDS: &str = "\
roots solutions found vanishes freeRoot GUARD CLAMP ratioRoots directionRoots lineRoots lengthRoots \
sincosRoots quadraticRoots quarticRoots polynomial rootBetween Infinity isNear tolerance certificate Number";

impl Module<'_> {
    /// The functions and the routines that they call.
    pub(super) fn solvers(&self) -> Vec<String> {
        if self.plans.is_empty() {
            return vec![];
        }
        let mut text = routines(ROOTS, &self.plans);
        let is_free = |p: &Plan| p.nodes.iter().any(|n| n.kind() != Kind::Length);
        if self.plans.iter().any(is_free) {
            text.push_str(&part(ROOTS, "free"));
        }
        let mut lines: Vec<String> = text.lines().map(str::to_string).collect();
        for plan in &self.plans {
            lines.extend(self.solver(plan));
        }
        lines
    }

    /// The parameters that a solver reads.
    pub(super) fn parameters_of_solver(&self, plan: &Plan) -> Vec<&Parameter> {
        self.library.parameters.iter().filter(|p| plan.reads(p.symbol)).collect()
    }

    pub(super) fn labels(&self, plan: &Plan) -> String {
        format!("{}Branches", plan.name)
    }

    fn solver(&self, plan: &Plan) -> Vec<String> {
        let (f, n, argument) = (&plan.name, plan.routine.solver.variables.len(), &plan.argument);
        let kind = format!("{}{}Solution", f[..1].to_uppercase(), &f[1..]);
        let parameters = self.parameters_of_solver(plan);
        let is_required = parameters.iter().any(|p| p.default.is_none());
        let mut lines = vec![String::new()];
        lines.extend(documentation(&[
            format!("A solution of `{f}`."),
            String::new(),
            format!("@typedef {{object}} {kind}"),
            format!("@property {{number[]}} {} the {} results", plan.result, plan.outputs.len()),
            "@property {number} residual how far the equations are from holding".into(),
            "@property {number} multiplicity how many branches come together in it".into(),
            format!(
                "@property {{number}} branch the number of its branch, whose label is in `{}`",
                self.labels(plan)
            ),
            "@property {number} free the unknowns that are free, a bit each".into(),
        ]));
        lines.push(String::new());
        let certificate = certificate_type(plan);
        let words: Vec<String> = Certificate::ALL.iter().map(|c| format!("\"{}\"", c.words())).collect();
        lines.push(format!("/** @typedef {{{}}} {certificate} */", words.join(" | ")));
        lines.push(String::new());
        lines.push(format!("/** The labels of the branches of `{f}`, by their number. */"));
        lines.push(format!("export const {} = Object.freeze([", self.labels(plan)));
        lines.extend(plan.labels().iter().map(|label| format!("  \"{label}\",")));
        lines.push("]);".into());
        lines.push(String::new());
        let angles: Vec<&str> =
            plan.routine.solver.angles.iter().map(|a| if *a { "true" } else { "false" }).collect();
        let keep = format!("{f}Keep");
        let text = part(ROOTS, "keep")
            .replace("@angles@", &angles.join(", "))
            .replace("@T@", &kind)
            .replace("@keep@", &keep)
            .replace("@result@", &plan.result);
        lines.extend(text.trim().lines().map(str::to_string));
        lines.push(String::new());

        let mut about: Vec<String> = plan.about().iter().map(|line| untagged(line)).collect();
        let shape: Vec<String> = plan.routine.shape.iter().map(usize::to_string).collect();
        about.push(String::new());
        about
            .push(format!("@param {{ArrayLike<number>}} {argument} {} values, row-major", shape.join(" x ")));
        match (parameters.is_empty(), is_required) {
            (true, _) => {}
            (false, true) => about.push("@param {Parameters} parameters values of the symbols".into()),
            (false, false) => {
                about.push(format!("@param {{{}}} [parameters] values of the symbols", self.given()))
            }
        }
        about.push(format!("@returns {{{kind}[] & {{ certificate: {certificate} }}}}"));
        about.push(format!("@throws {{RangeError}} if `{argument}` has another length"));
        about.push("@throws {TypeError} if an argument is of another type".into());
        lines.extend(documentation(&about));
        let given = match (parameters.is_empty(), is_required) {
            (true, _) => "",
            (false, true) => ", parameters",
            (false, false) => ", parameters = DEFAULTS",
        };
        lines.extend(call(&format!("export function {f}"), &format!("{argument}{given}"), " {"));
        lines.push(format!("  requireNumbers({argument});"));
        if !parameters.is_empty() {
            lines.push("  requireParameters(parameters);".into());
        }
        lines.push(format!("  if ({argument}.length !== {n}) {{"));
        let message = format!("`{argument} must have {n} entries, not ${{{argument}.length}}`");
        lines.extend(WRAP.statement("    throw new", &format!("RangeError({message})"), ";"));
        lines.push("  }".into());
        let local = |p: &Parameter| match (self.names.of(p.symbol), plan.names.of(p.symbol)) {
            (field, local) if field == local => (field.to_string(), local.to_string()),
            (field, local) => (format!("{field}: {local}"), local.to_string()),
        };
        lines.extend(required_parameters(&parameters, is_required, |p| {
            (self.names.of(p.symbol).into(), local(p).0)
        }));
        for (k, symbol) in plan.variables() {
            lines.push(format!("  const {} = {argument}[{k}];", plan.names.of(symbol)));
        }
        lines.push(format!("  /** @type {{{kind}[]}} */"));
        lines.push("  const solutions = [];".into());
        lines.push(format!("  let isNear = {};", plan.may_hide));
        lines.push(String::new());
        let mut nested = Nested::new(plan, Language::JavaScript, "", "Math.atan2");
        nested.refusal = returned(&certificate, &format!("\"{}\"", Certificate::NotAPose.words()));
        nested.wrap = WRAP;
        lines.extend(nested.body_at(2, |leaf, indent| {
            let mut lines = vec![format!("{keep}(solutions, {{")];
            let room = crate::wrap::Wrap { width: WRAP.width - indent, ..WRAP };
            let whole = format!("  {}: [{}],", plan.result, leaf.outputs.join(", "));
            if indent + whole.len() <= WRAP.width {
                lines.push(whole);
            } else {
                lines.push(format!("  {}: [", plan.result));
                for e in &leaf.outputs {
                    lines.extend(room.statement("   ", e, ","));
                }
                lines.push("  ],".into());
            }
            for (field, value) in [
                ("residual", &leaf.residual),
                ("multiplicity", &leaf.multiplicity),
                ("branch", &leaf.branch),
                ("free", &leaf.free),
            ] {
                if field == value {
                    lines.push(format!("  {field},"));
                } else {
                    lines.extend(room.statement(&format!("  {field}:"), value, ","));
                }
            }
            lines.push("});".into());
            lines
        }));
        let words = [Certificate::Singular, Certificate::Complete].map(|c| format!("\"{}\"", c.words()));
        let verdict = format!("isNear ? {}", words.join(" : "));
        lines.extend(returned(&certificate, &verdict).into_iter().map(|line| format!("  {line}")));
        lines.push("}".into());
        lines
    }

    /// The stored solutions.
    pub(super) fn solver_test(&self, plan: &Plan) -> Vec<String> {
        let f = &plan.name;
        let parameters = self.parameters_of_solver(plan);
        let list = |head: &str, values: &[f64], indent: usize| {
            let numbers = self.numbers(values);
            let margin = " ".repeat(indent);
            let whole = format!("{margin}{head}[{}],", numbers.join(", "));
            if whole.len() <= WRAP.width {
                return vec![whole];
            }
            let mut lines = vec![format!("{margin}{head}[")];
            lines.extend(WRAP.list(&numbers, indent + 2));
            lines.push(format!("{margin}],"));
            lines
        };
        let mut lines = vec![String::new(), format!("const {f}Cases = [")];
        for v in &plan.routine.vectors {
            lines.push("  {".into());
            lines.extend(list("given: ", &v.variables, 4));
            if !parameters.is_empty() {
                lines.push("    parameters: {".into());
                let pairs = self.library.parameters.iter().zip(&v.parameters);
                lines.extend(
                    pairs.map(|(p, x)| {
                        format!("      {}: {},", self.names.of(p.symbol), self.numbers(&[*x])[0])
                    }),
                );
                lines.push("    },".into());
            }
            lines.push("    known: [".into());
            for s in &v.solutions {
                lines.push("      {".into());
                lines.extend(list("results: ", &s.results, 8));
                lines.push(format!("        multiplicity: {},", s.multiplicity));
                lines.push(format!("        free: {},", s.free));
                lines.push("      },".into());
            }
            lines.push("    ],".into());
            lines.push(format!("    certificate: \"{}\",", v.certificate.words()));
            lines.push(format!("    tolerance: {},", self.numbers(&[v.tolerance])[0]));
            lines.push("  },".into());
        }
        lines.push("];".into());
        let angles: Vec<&str> =
            plan.routine.solver.angles.iter().map(|a| if *a { "true" } else { "false" }).collect();
        let text = format!(
            "
test(\"{f} finds all solutions\", () => {{
  const isAngle = [{}];
  for (const {{ given, {}known, certificate, tolerance }} of {f}Cases) {{
    const found = {f}(given{});
    assert.equal(found.length, known.length);
    assert.equal(found.certificate, certificate);
    for (const {{ results, multiplicity, free }} of known) {{
      const distances = found
        .filter((s) => s.multiplicity === multiplicity && s.free === free && s.residual <= 1e-9)
        .map((s) => {{
          assert.equal(typeof {}[s.branch], \"string\");
          const each = s.{}.map((value, k) => {{
            const apart = value - results[k];
            return isAngle[k] ? apart - 2 * Math.PI * Math.round(apart / (2 * Math.PI)) : apart;
          }});
          return Math.max(...each.map(Math.abs));
        }});
      assert.ok(Math.min(...distances) <= tolerance, `${{distances}}`);
    }}
  }}
  assert.throws(() => {f}([]), RangeError);
}});",
            angles.join(", "),
            if parameters.is_empty() { "" } else { "parameters, " },
            if parameters.is_empty() { "" } else { ", parameters" },
            self.labels(plan),
            plan.result,
        );
        lines.extend(text.lines().map(str::to_string));
        lines
    }
}

/// The type of the certificate.
fn certificate_type(plan: &Plan) -> String {
    let f = &plan.name;
    format!("{}{}Certificate", f[..1].to_uppercase(), &f[1..])
}

/// The statements that return the solutions with a certificate.
fn returned(kind: &str, verdict: &str) -> Vec<String> {
    vec![
        format!("/** @type {{{kind}}} */"),
        format!("const certificate = {verdict};"),
        "return Object.assign(solutions, { certificate });".into(),
    ]
}
