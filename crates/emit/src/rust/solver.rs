//! Solvers in Rust: one set of variables with branches side by side, blocks with rows side by side, and a careful
//! function, root by root, for what is special: a guard that vanishes, a discriminant that is nearly 0.

use super::lanes::{Lanes, Part, stages};
use super::{Source, doc, signature};
use crate::Language;
use crate::compiled::{Body, Step, WIDTH, lines};
use crate::nested::{Leaf, Nested, element, part, routines};
use crate::solver::{Kind, Plan};
use crate::wrap::comments;
use denavit_symbolic::Symbol;
use rustc_hash::{FxHashMap, FxHashSet};
use std::fmt::Write;

const ROOTS: &str = include_str!("roots.rs.txt");
/// Words that emitted solvers use.
pub(super) const WORDS: &[&str] = &[
    "solutions",
    "count",
    "found",
    "roots",
    "rare",
    "missing",
    "absent",
    "guard",
    "clamp",
    "near",
    "tolerance",
    "row",
    "rows",
    "residuals",
    "branch",
    "multiplicity",
    "from_fn",
    "is_there",
    "is_rare",
    "sign_1",
    "sign_2",
    "sign_3",
    "sign_4",
    "sign_5",
    "sign_6",
    "sign_7",
    "sign_8",
    "sign_9",
    "signs_1",
    "signs_2",
    "signs_3",
    "signs_4",
    "signs_5",
    "signs_6",
    "signs_7",
    "signs_8",
    "signs_9",
    "b_1",
    "b_2",
    "b_3",
    "b_4",
    "b_5",
    "b_6",
    "b_7",
    "b_8",
    "b_9",
    "absent_0",
    "absent_1",
    "absent_2",
    "absent_3",
    "absent_4",
    "x",
    "f64",
    "is_candidate",
    "is_near",
    "certificate",
];
/// As many branches as go side by side.
const WIDE: usize = 8;
/// Rows of a block: what is known of 8 stays in registers and near them, and is faster than 64 by a seventh.
const ROWS: usize = 8;
/// More branches are found one by one.
const MOST: usize = 16;

/// Whether the roots have a form without branches, by which nothing is hidden.
fn has_lanes(plan: &Plan) -> bool {
    plan.max() <= MOST && !plan.may_hide && plan.nodes.iter().all(|n| n.kind() != Kind::Quartic)
}

/// Whether branches go side by side.
fn is_wide(plan: &Plan) -> bool {
    has_lanes(plan) && plan.max() > 2
}

impl Source<'_> {
    /// The file of the routines for roots.
    pub(super) fn roots(&self) -> String {
        let mut text = self.head("// ", &["", "Roots of equations in one unknown."]);
        if self.plans.iter().any(|p| p.nodes.iter().any(|n| !matches!(n.kind(), Kind::Ratio))) {
            text.push_str("\nuse super::kernel::sqrt;\n");
        }
        text.push_str(&routines(ROOTS, &self.plans));
        let with_lanes: Vec<&Plan> = self.plans.iter().filter(|p| has_lanes(p)).collect();
        if with_lanes.is_empty() {
            return text;
        }
        let any = |kind: Kind| with_lanes.iter().any(|p| p.nodes.iter().any(|n| n.kind() == kind));
        if any(Kind::Sincos) || any(Kind::Quadratic) {
            text.push_str(&format!("{}\n{}", part(ROOTS, "missing"), part(ROOTS, "near")));
        }
        for kind in Kind::ALL.into_iter().filter(|k| any(*k)) {
            text.push_str(&part(ROOTS, &format!("{}_lane", kind.name())));
        }
        text
    }

    /// The solvers.
    pub(super) fn solvers(&self) -> String {
        self.plans.iter().map(|plan| self.solver(plan)).collect()
    }

    fn solver(&self, plan: &Plan) -> String {
        let (f, upper, kind) = (&plan.name, plan.name.to_uppercase(), camel(&plan.name));
        let (max, m, result) = (plan.max(), plan.outputs.len(), &plan.result);
        let labels: Vec<String> = plan.labels().iter().map(|l| format!("    \"{l}\",\n")).collect();
        let angles: Vec<String> = plan.routine.solver.angles.iter().map(bool::to_string).collect();
        let mut text = format!(
            "\n/// The largest number of solutions of [`{f}`].\npub const {upper}_MAX: usize = {max};\n\n\
             /// The labels of the branches of [`{f}`], by their number.\n\
             pub const {upper}_BRANCHES: [&str; {upper}_MAX] = [\n{}];\n\n\
             /// A solution of [`{f}`].\n#[derive(Clone, Copy, PartialEq, Debug)]\npub struct {kind}Solution {{\n    \
             /// The results.\n    pub {result}: [f64; {m}],\n    /// How far the equations are from holding.\n    \
             pub residual: f64,\n    /// How many branches come together in it.\n    pub multiplicity: u32,\n    \
             /// The number of its branch.\n    pub branch: u32,\n    \
             /// The unknowns that are free, a bit each.\n    pub free: u32,\n}}\n\n\
             impl {kind}Solution {{\n    /// No solution, to fill arrays with.\n    pub const NONE: Self = \
             Self {{\n        {result}: [f64::NAN; {m}],\n        residual: f64::INFINITY,\n        \
             multiplicity: 0,\n        branch: 0,\n        free: 0,\n    }};\n}}\n",
            labels.concat()
        );
        text.push_str(&certificate(plan));
        let about: Vec<String> = plan.about().iter().map(|line| doc(line)).collect();
        let about = lines(&comments(about.iter().map(String::as_str), "/// ", WIDTH));
        let _ = write!(text, "\n{about}");
        if is_wide(plan) {
            text.push_str(&self.wide(plan));
            text.push_str(
                "\n/// The same root by root, with all that is special.\n#[cold]\n#[inline(never)]\n",
            );
            text.push_str(&self.careful(plan, &format!("fn {f}_careful(")));
        } else {
            text.push_str(&self.careful(plan, &format!("pub fn {f}(")));
        }
        let _ = write!(
            text,
            "\n/// Adds a solution, or its multiplicity to an equal one; returns the number of solutions.\n\
             {}    const IS_ANGLE: [bool; {m}] = [{}];\n    \
             if found.{result}.iter().any(|x| !x.is_finite()) {{\n        return count;\n    }}\n    \
             for known in &mut solutions[..count] {{\n        \
             if roots::is_same(&known.{result}, &found.{result}, &IS_ANGLE) {{\n            \
             known.multiplicity += found.multiplicity;\n            return count;\n        }}\n    }}\n    \
             solutions[count] = found;\n    count + 1\n}}\n",
            signature(
                &format!("fn {f}_keep("),
                &format!(
                    "solutions: &mut [{kind}Solution; {upper}_MAX], count: usize, found: {kind}Solution"
                ),
                ") -> usize {"
            ),
            angles.join(", ")
        );
        text.push_str(&self.rows(plan));
        text
    }

    /// The arguments of a function for one set of variables.
    fn arguments(&self, plan: &Plan) -> String {
        let (kind, upper) = (camel(&plan.name), plan.name.to_uppercase());
        let array =
            self.shape(plan).iter().rev().fold("f64".to_string(), |inner, n| format!("[{inner}; {n}]"));
        let (parameters, _) = self.given(plan);
        let argument = self.argument_name(plan);
        format!("{argument}: &{array}{parameters}, solutions: &mut [{kind}Solution; {upper}_MAX]")
    }

    fn shape(&self, plan: &Plan) -> Vec<usize> {
        if plan.routine.shape.is_empty() { vec![1] } else { plan.routine.shape.clone() }
    }

    fn argument_name(&self, plan: &Plan) -> String {
        let underscore = if plan.variables().is_empty() { "_" } else { "" };
        format!("{underscore}{}", plan.argument)
    }

    /// `, parameters: &Parameters` and `, parameters` if the solver reads any.
    fn given(&self, plan: &Plan) -> (&'static str, &'static str) {
        match plan.parameters(self.library).is_empty() {
            true => ("", ""),
            false => (", parameters: &Parameters", ", parameters"),
        }
    }

    fn open(&self, plan: &Plan, out: &mut Body) {
        let read = plan.parameters(self.library);
        if !read.is_empty() {
            let field = |s: &Symbol| match (self.names.of(*s), plan.names.of(*s)) {
                (field, local) if field == local => field.to_string(),
                (field, local) => format!("{field}: {local}"),
            };
            let mut fields: Vec<String> = read.iter().map(field).collect();
            if read.len() < self.library.parameters.len() {
                fields.push("..".into());
            }
            out.list_spaced("let Parameters {", &fields, "} = *parameters;");
        }
    }

    /// The variables out of nested arrays.
    fn take(&self, plan: &Plan, out: &mut Body) {
        let variables = &plan.routine.solver.variables;
        let of = |s: &Symbol| if plan.reads(*s) { plan.names.of(*s).to_string() } else { "_".into() };
        let all: Vec<String> = variables.iter().map(of).collect();
        if all.iter().any(|name| name != "_") {
            let tail = format!(" = *{};", plan.argument);
            out.nested("let ", &all, &self.shape(plan), &tail);
        }
    }

    /// Root by root.
    fn careful(&self, plan: &Plan, head: &str) -> String {
        let (kind, f) = (camel(&plan.name), &plan.name);
        let result = format!(") -> (usize, {kind}Certificate) {{");
        let mut out = Body { text: signature(head, &self.arguments(plan), &result), indent: 4 };
        self.open(plan, &mut out);
        self.take(plan, &mut out);
        out.line("let mut count = 0;");
        out.line(&format!("let mut is_near = {};", plan.may_hide));
        out.blank();
        let mut nested = Nested::new(plan, Language::Rust, "roots::", "atan2");
        nested.sine_cosine = Some("sin_cos");
        nested.refusal = vec![format!("return (0, {kind}Certificate::NotAPose);")];
        let body = nested.body(|leaf, indent| {
            let mut lines = vec![format!("let found = {kind}Solution {{")];
            let list = |values: &[String]| format!("[{}]", values.join(", "));
            lines.extend(element(indent, &format!("{}: {}", plan.result, list(&leaf.outputs))));
            let Leaf { residual, multiplicity, branch, free, .. } = leaf;
            for (field, value) in [("residual", residual), ("multiplicity", multiplicity)] {
                lines.extend(element(indent, &shorthand(field, value)));
            }
            lines.extend(element(indent, &format!("branch: ({branch}) as u32")));
            lines.extend(element(indent, &shorthand("free", free)));
            lines.push("};".into());
            lines.push(format!("count = {f}_keep(solutions, count, found);"));
            lines
        });
        out.text.push_str(&lines(&body));
        out.blank();
        out.line("if is_near {");
        out.line(&format!("    return (count, {kind}Certificate::Singular);"));
        out.line("}");
        out.line(&format!("(count, {kind}Certificate::Complete)"));
        out.text + "}\n"
    }

    /// Branches side by side.
    fn wide(&self, plan: &Plan) -> String {
        let (f, kind, upper) = (&plan.name, camel(&plan.name), plan.name.to_uppercase());
        let lanes = plan.max().div_ceil(WIDE) * WIDE;
        let m = plan.outputs.len();
        let head = format!("pub fn {f}(");
        let result = format!(") -> (usize, {kind}Certificate) {{");
        let mut out = Body { text: signature(&head, &self.arguments(plan), &result), indent: 4 };
        for (i, node) in plan.nodes.iter().enumerate().filter(|(_, n)| n.root.branches() > 1) {
            let sign = |lane: usize| {
                if (lane / node.stride).is_multiple_of(2) { "1.0".into() } else { "-1.0".into() }
            };
            let signs: Vec<String> = (0..lanes).map(sign).collect();
            out.list(&format!("const SIGNS_{}: [f64; {lanes}] = [", i + 1), &signs, "];");
        }
        self.open(plan, &mut out);
        self.take(plan, &mut out);
        let stages = stages(plan);
        let mut writer = Lanes { plan, out, names: plan.names.clone(), is_row: false };
        writer.steps(&plan.hoisted, false);
        // What no sign enters is computed once; single roots in front of all signs have no lanes either.
        writer.out.line(&format!("let mut residuals = [f64::INFINITY; {lanes}];"));
        writer.out.line(&format!("let mut {} = [[0.0; {lanes}]; {m}];", plan.result));
        writer.out.line("let mut rare = false;");
        if stages[0].parts.iter().any(|p| matches!(p, Part::Node(..))) {
            writer.out.line("let missing = 0.0;");
        }
        writer.stage(&stages[0], false);
        writer.unusual();
        writer.out.line(&format!("for i in 0..{lanes} {{"));
        writer.out.indent += 4;
        for (i, node) in plan.nodes.iter().enumerate().filter(|(_, n)| n.root.branches() > 1) {
            let _ = node;
            writer.out.line(&format!("let sign_{0} = SIGNS_{0}[i];", i + 1));
        }
        writer.out.line("let missing = 0.0;");
        for stage in &stages[1..] {
            writer.stage(stage, true);
        }
        let residual = writer.formula(plan.residual);
        writer.out.statement("residuals[i] =", &format!("{residual} + missing"));
        writer.candidate("residuals[i]");
        for (k, e) in plan.outputs.iter().enumerate() {
            let formula = writer.formula(*e);
            writer.out.statement(&format!("{}[{k}][i] =", plan.result), &formula);
        }
        writer.out.indent -= 4;
        let mut out = writer.out;
        out.line("}");
        out.line("if rare {");
        let (_, given) = self.given(plan);
        out.line(&format!("    return {f}_careful({}{given}, solutions);", self.argument_name(plan)));
        out.line("}");
        out.line("let mut count = 0;");
        out.line(&format!("for i in 0..{upper}_MAX {{"));
        out.line(&format!("    solutions[count] = {kind}Solution {{"));
        out.line(&format!("        {0}: from_fn(|k| {0}[k][i]),", plan.result));
        out.line("        residual: residuals[i],");
        out.line("        multiplicity: 1,");
        out.line("        branch: i as u32,");
        out.line("        free: 0,");
        out.line("    };");
        out.line("    if residuals[i] <= roots::TOLERANCE {");
        out.line("        count += 1;");
        out.line("    }");
        out.line("}");
        out.line(&format!("(count, {kind}Certificate::Complete)"));
        out.text + "}\n"
    }

    /// Rows side by side.
    fn rows(&self, plan: &Plan) -> String {
        let (f, kind, upper) = (&plan.name, camel(&plan.name), plan.name.to_uppercase());
        let (m, n, result) = (plan.outputs.len(), plan.routine.solver.variables.len(), &plan.result);
        let (parameters, given) = self.given(plan);
        let mut text = format!(
            "\n/// Rows of a block of [`{f}_block`].\npub const {upper}_LANES: usize = {ROWS};\n\n\
             /// The solutions of a block: branch by branch, with all rows side by side. A branch whose\n\
             /// multiplicity is 0 has no solution.\n#[derive(Clone, Copy, PartialEq, Debug)]\n\
             pub struct {kind}Block {{\n    /// Result k of branch b of row i stands at `[b][k][i]`.\n    \
             pub {result}: [[[f64; {upper}_LANES]; {m}]; {upper}_MAX],\n    /// How far the equations are from holding.\n    \
             pub residual: [[f64; {upper}_LANES]; {upper}_MAX],\n    /// How many branches come together.\n    \
             pub multiplicity: [[u8; {upper}_LANES]; {upper}_MAX],\n    /// The unknowns that are free, a bit each.\n    \
             pub free: [[u32; {upper}_LANES]; {upper}_MAX],\n    /// What is said of each row.\n    \
             pub certificate: [{kind}Certificate; {upper}_LANES],\n}}\n\nimpl {kind}Block {{\n    /// No solutions.\n    \
             pub const NONE: Self = Self {{\n        {result}: [[[f64::NAN; {upper}_LANES]; {m}]; {upper}_MAX],\n        \
             residual: [[f64::INFINITY; {upper}_LANES]; {upper}_MAX],\n        multiplicity: [[0; {upper}_LANES]; {upper}_MAX],\n        \
             free: [[0; {upper}_LANES]; {upper}_MAX],\n        certificate: [{kind}Certificate::Complete; {upper}_LANES],\n    \
             }};\n}}\n\n/// [`{f}`] of a block of rows.\n"
        );
        let argument = self.argument_name(plan);
        let arguments =
            format!("{argument}: &[[f64; {upper}_LANES]; {n}]{parameters}, solutions: &mut {kind}Block");
        let call = format!("{f}_row({argument}{given}, solutions, i);");
        if has_lanes(plan) {
            text.push_str(&self.nested_rows(plan, &arguments, &call));
        } else {
            text.push_str(&signature(&format!("pub fn {f}_block("), &arguments, ") {"));
            let _ = write!(text, "    for i in 0..{upper}_LANES {{\n        {call}\n    }}\n}}\n");
        }
        let careful = if is_wide(plan) { format!("{f}_careful") } else { f.to_string() };
        let shape = self.shape(plan);
        let mut strides: Vec<usize> = vec![];
        (0..shape.len()).for_each(|d| strides.push(shape[d + 1..].iter().product()));
        let letters = ["a", "b", "c", "d"];
        let place: Vec<String> = strides
            .iter()
            .zip(letters)
            .map(|(s, l)| if *s == 1 { l.to_string() } else { format!("{s} * {l}") })
            .collect();
        let inner = format!("{argument}[{}][i]", place.join(" + "));
        let inner = if plan.variables().is_empty() { "0.0".into() } else { inner };
        let used = |l: &str| if plan.variables().is_empty() { format!("_{l}") } else { l.to_string() };
        let value =
            (0..shape.len()).rev().fold(inner, |inner, d| format!("from_fn(|{}| {inner})", used(letters[d])));
        let row = format!("{arguments}, i: usize");
        text.push_str("\n/// One row of a block.\n#[cold]\n#[inline(never)]\n");
        text.push_str(&signature(&format!("fn {f}_row("), &row, ") {"));
        let _ = write!(
            text,
            "    let mut found = [{kind}Solution::NONE; {upper}_MAX];\n    \
             let row = {value};\n    \
             let (count, certificate) = {careful}(&row{given}, &mut found);\n    \
             solutions.certificate[i] = certificate;\n    \
             for b in 0..{upper}_MAX {{\n        solutions.residual[b][i] = f64::INFINITY;\n        \
             solutions.multiplicity[b][i] = 0;\n        solutions.free[b][i] = 0;\n        \
             solutions.{result}[b].iter_mut().for_each(|row| row[i] = f64::NAN);\n    }}\n    \
             for found in &found[..count] {{\n        let b = found.branch as usize;\n        \
             solutions.residual[b][i] = found.residual;\n        \
             solutions.multiplicity[b][i] = found.multiplicity as u8;\n        \
             solutions.free[b][i] = found.free;\n        \
             solutions.{result}[b].iter_mut().zip(found.{result}).for_each(|(row, x)| row[i] = x);\n    \
             }}\n}}\n"
        );
        text
    }

    fn nested_rows(&self, plan: &Plan, arguments: &str, call: &str) -> String {
        let (f, upper) = (&plan.name, plan.name.to_uppercase());
        let mut out = Body { text: signature(&format!("pub fn {f}_block("), arguments, ") {"), indent: 4 };
        self.open(plan, &mut out);
        let mut writer = Lanes { plan, out, names: plan.names.clone(), is_row: true };
        writer.steps(&plan.hoisted, false);
        writer.out.line(&format!("let mut rare = [0.0; {upper}_LANES];"));
        let stages = stages(plan);
        let last = stages.len() - 1;
        // What each pass leaves for later ones.
        let ends: Vec<Symbol> =
            plan.outputs.iter().chain([&plan.residual]).flat_map(|e| e.symbols()).collect();
        let mut later: Vec<FxHashSet<Symbol>> = vec![ends.into_iter().collect()];
        for stage in stages.iter().rev() {
            let mut read = later[later.len() - 1].clone();
            read.extend(stage.parts.iter().flat_map(Part::reads));
            later.push(read);
        }
        later.reverse(); // later[s]: read by pass s or behind it
        let mut known: Vec<Symbol> = vec![];
        let mut arrays: FxHashMap<Symbol, String> = FxHashMap::default();
        let mut flagged = false;
        let mut branch: Vec<String> = vec![];
        for (s, stage) in stages.iter().enumerate() {
            let own: Vec<Symbol> = stage.parts.iter().flat_map(Part::defines).collect();
            let keep: Vec<Symbol> = if s == last {
                vec![]
            } else {
                own.iter().copied().filter(|x| later[s + 1].contains(x)).collect()
            };
            if let Some(Part::Node(i, node)) = stage.parts.first() {
                let signs = if s > 0 { ["1.0", "-1.0"].join(", ") } else { String::new() };
                if s > 0 {
                    let sign = format!("sign_{}", i + 1);
                    let b = format!("b_{}", i + 1);
                    writer.out.line(&format!("for ({b}, {sign}) in [{signs}].into_iter().enumerate() {{"));
                    writer.out.indent += 4;
                    branch.push(if node.stride == 1 { b } else { format!("{} * {b}", node.stride) });
                }
            }
            let has_nodes = stage.parts.iter().any(|p| matches!(p, Part::Node(..)));
            for x in &keep {
                let name = writer.names.free(&format!("{}_rows", plan.names.of(*x)));
                arrays.insert(*x, name);
            }
            let array = |x: &Symbol| &arrays[x];
            for x in &keep {
                writer.out.line(&format!("let mut {} = [0.0; {upper}_LANES];", array(x)));
            }
            let is_flagged = (flagged || has_nodes) && s < last;
            if is_flagged {
                writer.out.line(&format!("let mut absent_{s} = [0.0; {upper}_LANES];"));
            }
            let branches = if branch.is_empty() { "0".into() } else { branch.join(" + ") };
            if s == last {
                writer.out.line(&format!("let branch = {branches};"));
                writer.out.line(&format!("let rows = &mut solutions.{}[branch];", plan.result));
                writer.out.line("let residuals = &mut solutions.residual[branch];");
            }
            writer.out.line(&format!("for i in 0..{upper}_LANES {{"));
            writer.out.indent += 4;
            let here: Vec<Symbol> = stage.parts.iter().flat_map(Part::reads).collect();
            let mut at_end: Vec<Symbol> = if s == last {
                plan.outputs.iter().chain([&plan.residual]).flat_map(|e| e.symbols()).collect()
            } else {
                vec![]
            };
            if s == 0 {
                at_end.extend(plan.defect.iter().chain([&plan.size]).flat_map(|e| e.symbols()));
            }
            let reads = |x: &Symbol| here.contains(x) || at_end.contains(x);
            for (k, symbol) in plan.variables() {
                if reads(&symbol) {
                    writer.out.line(&format!("let {} = {}[{k}][i];", plan.names.of(symbol), plan.argument));
                }
            }
            for x in known.iter().filter(|x| reads(x)) {
                writer.out.line(&format!("let {} = {}[i];", plan.names.of(*x), array(x)));
            }
            let has_angles = stage.parts.iter().any(|p| match p {
                Part::Steps(steps) => steps.iter().any(|s| matches!(s, Step::Atan2 { .. })),
                Part::Node(..) => false,
            });
            if has_nodes || has_angles || s == last {
                let from = if flagged { format!("absent_{}[i]", s - 1) } else { "0.0".into() };
                writer.out.line(&format!("let missing = {from};"));
            }
            writer.stage(stage, true);
            if s == 0 {
                writer.unusual();
            }
            for x in &keep {
                writer.out.line(&format!("{}[i] = {};", array(x), plan.names.of(*x)));
            }
            if is_flagged {
                let value = if has_nodes { "missing".to_string() } else { format!("absent_{}[i]", s - 1) };
                writer.out.line(&format!("absent_{s}[i] = {value};"));
            }
            if s == last {
                let residual = writer.formula(plan.residual);
                writer.out.statement("residuals[i] =", &format!("{residual} + missing"));
                writer.candidate("residuals[i]");
                for (k, e) in plan.outputs.iter().enumerate() {
                    let formula = writer.formula(*e);
                    writer.out.statement(&format!("rows[{k}][i] ="), &formula);
                }
            }
            writer.out.indent -= 4;
            writer.out.line("}");
            flagged |= has_nodes;
            known.extend(keep);
        }
        writer.out.line("let multiplicity = &mut solutions.multiplicity[branch];");
        writer.out.line(&format!("for i in 0..{upper}_LANES {{"));
        writer.out.line("    multiplicity[i] = u8::from(residuals[i] <= roots::TOLERANCE);");
        writer.out.line("}");
        writer.out.line(&format!("solutions.free[branch] = [0; {upper}_LANES];"));
        while writer.out.indent > 4 {
            writer.out.indent -= 4;
            writer.out.line("}");
        }
        let mut out = writer.out;
        out.line(&format!("solutions.certificate = [{}Certificate::Complete; {upper}_LANES];", camel(f)));
        out.line("for (i, rare) in rare.iter().enumerate() {");
        out.line("    if *rare != 0.0 {");
        out.line(&format!("        {call}"));
        out.line("    }");
        out.line("}");
        out.text + "}\n"
    }
}

/// What is said of an answer.
fn certificate(plan: &Plan) -> String {
    let (f, kind) = (&plan.name, camel(&plan.name));
    format!(
        "\n/// What [`{f}`] says of its answer.\n#[derive(Clone, Copy, PartialEq, Eq, Debug)]\npub enum {kind}Certificate {{\n    \
         /// All solutions are there; without one, there is none.\n    Complete,\n    \
         /// Somewhere an unknown is free, or nearly so: what is there solves the equations,\n    \
         /// and there may be more.\n    \
         Singular,\n    \
         /// The variables are no numbers, or further from what they must be than rounding\n    \
         /// brings them.\n    \
         NotAPose,\n}}\n"
    )
}

/// `field`, or `field: value`.
fn shorthand(field: &str, value: &str) -> String {
    if field == value { field.into() } else { format!("{field}: {value}") }
}

/// A name as types have it.
pub(super) fn camel(name: &str) -> String {
    let part = |p: &str| p[..1].to_uppercase() + &p[1..];
    name.split('_').filter(|p| !p.is_empty()).map(part).collect()
}
