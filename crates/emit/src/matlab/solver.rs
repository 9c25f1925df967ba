//! Solvers in MATLAB: a function a file, with the routines for roots behind it.

use super::{Module, WRAP};
use crate::nested::{Nested, part, routines};
use crate::solver::{Kind, Plan};
use crate::wrap::{Wrap, comments};
use crate::{Certificate, Language, Parameter};

const ROOTS: &str = include_str!("roots.m");
/// Words that emitted solvers use.
pub(super) const WORDS: &str = "\
solutions found keep roots_of vanishes free_root double_root ratio_roots direction_roots line_roots \
length_roots sincos_roots quadratic_roots quartic_roots root_between info numel Inf is_near tolerance \
refused realmax";

impl Module<'_> {
    /// The parameters that a solver reads.
    fn parameters_of_solver(&self, plan: &Plan) -> Vec<&Parameter> {
        self.library.parameters.iter().filter(|p| plan.reads(p.symbol)).collect()
    }

    pub(super) fn solver(&self, plan: &Plan, function: &str) -> Vec<String> {
        let (argument, result) = (&plan.argument, &plan.result);
        let n = plan.routine.solver.variables.len();
        let parameters = self.parameters_of_solver(plan);
        let is_required =
            !parameters.is_empty() && self.library.parameters.iter().any(|p| p.default.is_none());
        let (upper, output) = (function.to_uppercase(), result.to_uppercase());
        let upper_argument = argument.to_uppercase();
        let arguments =
            if parameters.is_empty() { argument.clone() } else { format!("{argument}, parameters") };
        let mut lines = vec![format!("function [{result}, info] = {function}({arguments})")];
        let shape = match &plan.routine.shape[..] {
            [] => "1 x 1".to_string(),
            [k] => format!("1 x {k}"),
            many => many.iter().map(usize::to_string).collect::<Vec<_>>().join(" x "),
        };
        let mut about = plan.about();
        let summary = about.remove(0);
        lines.extend(comments([format!("{upper}  {summary}").as_str()], "%", WRAP.width));
        about.extend([
            String::new(),
            format!("[{output}, INFO] = {upper}({upper_argument}): {upper_argument} is {shape}; a solution a row of {output}."),
            "INFO has a row a solution in each field: residual, multiplicity, branch, free; and INFO.labels".into(),
            "what the branches are called: label k is that of branch k - 1. INFO.certificate is 'complete',".into(),
            "'singular' or 'not a pose'.".into(),
        ]);
        if !parameters.is_empty() {
            about.push(format!(
                "[...] = {upper}({upper_argument}, PARAMETERS): a struct of values of the symbols; see {}.",
                self.parameters_name().to_uppercase()
            ));
        }
        about.push(String::new());
        about.extend(self.library.header.clone());
        let about: Vec<String> = about.iter().map(|line| format!("  {line}")).collect();
        lines.extend(comments(about.iter().map(String::as_str), "% ", WRAP.width));
        lines.push(String::new());
        let least = if is_required { 2 } else { 1 };
        lines.push(format!("narginchk({least}, {});", if parameters.is_empty() { 1 } else { 2 }));
        lines.push(format!("if ~isnumeric({argument}) || ~isreal({argument}) || numel({argument}) ~= {n}"));
        let mnemonic = self.mnemonic(function);
        lines.push(format!("    error('{}:{mnemonic}:argument', ...", self.name()));
        lines.push(format!("        '{argument} must have {n} real entries, not %d.', numel({argument}));"));
        lines.push("end".into());
        // Row by row.
        lines.push(match plan.routine.shape.len() {
            0 | 1 => format!("{argument} = double({argument}(:).');"),
            2 => format!("{argument} = reshape(double({argument}).', 1, []);"),
            d => {
                let order: Vec<String> = (1..=d).rev().map(|k| k.to_string()).collect();
                format!("{argument} = reshape(permute(double({argument}), [{}]), 1, []);", order.join(", "))
            }
        });
        if !parameters.is_empty() {
            if !is_required {
                lines.extend(["if nargin < 2", "    parameters = struct();", "end"].map(String::from));
            }
            lines.push(format!("parameters = {}(parameters);", self.parameters_name()));
        }
        let variables = plan.variables();
        lines
            .extend(variables.iter().map(|(k, s)| format!("{} = {argument}({});", plan.names.of(*s), k + 1)));
        lines.extend(
            parameters.iter().map(|p| format!("{} = parameters.{};", plan.names.of(p.symbol), self.field(p))),
        );
        lines.push("solutions = struct('results', {}, 'residual', {}, 'multiplicity', {}, ...".into());
        lines.push("    'branch', {}, 'free', {});".into());
        lines.push(format!("is_near = {};", plan.may_hide));
        lines.push(format!("{result} = zeros(0, {});", plan.outputs.len()));
        lines.push("info = struct('residual', zeros(0, 1), 'multiplicity', zeros(0, 1), ...".into());
        lines.push("    'branch', zeros(0, 1), 'free', zeros(0, 1));".into());
        lines.push("info.labels = { ...".into());
        lines.extend(plan.labels().iter().map(|label| format!("    '{label}', ...")));
        lines.push("};".to_string());
        lines.push(String::new());
        let mut nested = Nested::new(plan, Language::Matlab, "", "atan2");
        nested.wrap = WRAP;
        nested.refusal =
            vec![format!("info.certificate = '{}';", Certificate::NotAPose.words()), "return;".into()];
        lines.extend(nested.body_at(0, |leaf, indent| {
            let room = Wrap { width: WRAP.width - indent - 4, ..WRAP };
            let mut lines = vec!["found = struct( ...".to_string()];
            lines.push("    'results', [ ...".into());
            lines.extend(leaf.outputs.iter().flat_map(|e| room.statement("       ", e, ", ...")));
            lines.push("    ], ...".into());
            for (k, (field, value)) in [
                ("residual", &leaf.residual),
                ("multiplicity", &leaf.multiplicity),
                ("branch", &leaf.branch),
                ("free", &leaf.free),
            ]
            .into_iter()
            .enumerate()
            {
                let tail = if k == 3 { " ..." } else { ", ..." };
                lines.extend(room.statement(&format!("    '{field}',"), value, tail));
            }
            lines.push(");".into());
            lines.push("solutions = keep(solutions, found);".into());
            lines
        }));
        let m = plan.outputs.len();
        lines.push(String::new());
        lines.push(format!("{result} = reshape([solutions.results], {m}, []).';"));
        for field in ["residual", "multiplicity", "branch", "free"] {
            lines.push(format!("info.{field} = [solutions.{field}].';"));
        }
        lines.push(format!("info.certificate = '{}';", Certificate::Complete.words()));
        lines.push("if is_near".into());
        lines.push(format!("    info.certificate = '{}';", Certificate::Singular.words()));
        lines.extend(["end".to_string(), "end".into()]);
        let mut text = routines(ROOTS, std::slice::from_ref(plan));
        let any = |kinds: &[Kind]| plan.nodes.iter().any(|n| kinds.contains(&n.kind()));
        if plan.nodes.iter().any(|n| n.kind() != Kind::Length) {
            text.push_str(&part(ROOTS, "free"));
        }
        if any(&[Kind::Length, Kind::Sincos, Kind::Quadratic]) {
            text.push_str(&part(ROOTS, "double"));
        }
        let angles: Vec<&str> =
            plan.routine.solver.angles.iter().map(|a| if *a { "1" } else { "0" }).collect();
        text.push_str(&part(ROOTS, "keep").replace("@angles@", &angles.join(", ")));
        lines.extend(text.lines().map(str::to_string));
        lines
    }

    /// The stored solutions.
    pub(super) fn solver_test(&self, plan: &Plan, function: &str) -> Vec<String> {
        let parameters = self.parameters_of_solver(plan);
        let (vectors, m) = (&plan.routine.vectors, plan.outputs.len());
        let mut lines = vec![String::new(), format!("% {function}")];
        let all: Vec<_> = vectors.iter().flat_map(|v| &v.solutions).collect();
        lines.extend(self.matrix("given", &vectors.iter().map(|v| &v.variables[..]).collect::<Vec<_>>()));
        if !parameters.is_empty() {
            lines.extend(
                self.matrix("values", &vectors.iter().map(|v| &v.parameters[..]).collect::<Vec<_>>()),
            );
        }
        let results: Vec<&[f64]> = all.iter().map(|s| &s.results[..]).collect();
        if results.is_empty() {
            lines.push(format!("known = zeros(0, {m});"));
        } else {
            lines.extend(self.matrix("known", &results));
        }
        let mut owners: Vec<f64> = vec![];
        for (k, v) in vectors.iter().enumerate() {
            owners.extend(vec![(k + 1) as f64; v.solutions.len()]);
        }
        let multiplicities: Vec<f64> = all.iter().map(|s| f64::from(s.multiplicity)).collect();
        let free: Vec<f64> = all.iter().map(|s| f64::from(s.free)).collect();
        let tolerances: Vec<f64> = vectors.iter().map(|v| v.tolerance).collect();
        for (name, list) in [
            ("owners", &owners),
            ("multiplicities", &multiplicities),
            ("frees", &free),
            ("tolerances", &tolerances),
        ] {
            lines.extend(self.matrix(name, &[list]));
        }
        let certificates: Vec<String> =
            vectors.iter().map(|v| format!("    '{}', ...", v.certificate.words())).collect();
        lines.push("certificates = { ...".into());
        lines.extend(certificates);
        lines.push("};".into());
        let angles: Vec<&str> =
            plan.routine.solver.angles.iter().map(|a| if *a { "1" } else { "0" }).collect();
        lines.push(format!("is_angle = logical([{}]);", angles.join(", ")));
        lines.push("for k = 1:size(given, 1)".into());
        if !parameters.is_empty() {
            for (k, p) in self.library.parameters.iter().enumerate() {
                lines.push(format!("    parameters.{} = values(k, {});", self.field(p), k + 1));
            }
        }
        let shape = match &plan.routine.shape[..] {
            [] | [_] => "given(k, :)".to_string(),
            [r, c] => format!("reshape(given(k, :), {c}, {r}).'"),
            many => {
                let back: Vec<String> = many.iter().rev().map(usize::to_string).collect();
                let order: Vec<String> = (1..=many.len()).rev().map(|k| k.to_string()).collect();
                format!("permute(reshape(given(k, :), [{}]), [{}])", back.join(", "), order.join(", "))
            }
        };
        lines.push(format!("    argument = {shape};"));
        let passed = if parameters.is_empty() { "" } else { ", parameters" };
        lines.push(format!("    [results, info] = {function}(argument{passed});"));
        let text = r"    expected = find(owners == k);
    if size(results, 1) ~= numel(expected)
        error('NAME:test', '%d solutions, expected %d.', size(results, 1), numel(expected));
    end
    if ~strcmp(info.certificate, certificates{k})
        error('NAME:test', 'FUNCTION: configuration %d is %s.', k, info.certificate);
    end
    for e = expected
        apart = results - repmat(known(e, :), size(results, 1), 1);
        apart(:, is_angle) = apart(:, is_angle) - 2*pi*round(apart(:, is_angle)/(2*pi));
        alike = info.multiplicity == multiplicities(e) & info.free == frees(e) ...
            & info.residual <= 1e-9 & max(abs(apart), [], 2) <= tolerances(k);
        if ~any(alike) || info.branch(1) >= numel(info.labels)
            error('NAME:test', 'FUNCTION: configuration %d lacks a solution.', k);
        end
    end
end";
        let text = text.replace("NAME", self.name()).replace("FUNCTION", function);
        lines.extend(text.lines().map(str::to_string));
        if !parameters.is_empty() {
            lines.push("clear parameters".into());
        }
        lines
    }
}
