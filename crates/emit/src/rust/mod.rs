//! A Rust package without standard library, allocation, dependency or `unsafe`.
//!
//! A function for one configuration, and one for a block of [`LANES`] with the values of all lanes side by side. The
//! routines for sines, cosines and angles are those of this crate (`kernel/*.rs`), embedded as they stand.

mod attached;
mod kernel;
mod lanes;
mod solver;
mod test;

use crate::compiled::{
    Body, EIGHT, Function, Pair, Step, WIDTH, about_angles, defaults, file_name, functions, inputs, lines,
    opening,
};
use crate::names::{Names, brief, comment};
use crate::order::for_one;
use crate::solver::{Kind, Plan, plans};
use crate::spelling::Spelling;
use crate::wrap::comments;
use crate::{Attachment, File, Language, Library, Precision};
use denavit_symbolic::{Expr, Symbol};
use std::fmt::Write;

/// Configurations of a block.
const LANES: usize = 64;
/// Names that the emitted code uses, or that a pattern would take for a constant.
const RESERVED: &[&str] = &[
    "q",
    "parameters",
    "i",
    "k",
    "in_range",
    "lanes",
    "sin_cos",
    "sin_cos_8",
    "sin_cos_in_range",
    "near_sin_cos",
    "atan2",
    "near_atan2",
    "atan2_in_range",
    "sqrt",
    "kernel",
    "none",
    "some",
    "ok",
    "err",
    "default",
    "value",
];
/// Names that functions do not have: they are in scope where functions are called.
const TAKEN: &[&str] = &[
    "sin_cos",
    "sin_cos_8",
    "sin_cos_in_range",
    "near_sin_cos",
    "atan2",
    "near_atan2",
    "atan2_in_range",
    "sqrt",
    "kernel",
    "from_fn",
    "q",
    "i",
    "j",
    "k",
    "v",
    "x",
    "one",
    "block",
    "lane",
    "same",
    "expected",
    "scale",
    "value",
    "variables",
    "units",
];
/// What functions call of the kernel.
const KERNEL: &[&str] = &[
    "atan2",
    "atan2_in_range",
    "near_atan2",
    "near_sin_cos",
    "sin_cos",
    "sin_cos_8",
    "sin_cos_in_range",
    "sqrt",
];
/// Where fused multiply-add is an instruction that the compiler may use.
const FUSED: &str = "all(feature = \"std\", any(target_feature = \"fma\", target_arch = \"aarch64\"))";

pub(crate) fn emit(library: &Library) -> Vec<File> {
    let names = inputs(library, Language::Rust, RESERVED);
    let functions = functions(library, Language::Rust, &names, TAKEN);
    let name = Names::new(Language::Rust, &["alloc", "proc_macro"]).free(&file_name(library, Language::Rust));
    let opening = opening(library, &functions, &names, &name);
    let of = |f: &Function| [f.name.clone(), format!("{}_block", f.name), format!("{}_one_by_one", f.name)];
    let taken: Vec<String> = functions.iter().flat_map(of).collect();
    let words: Vec<&str> = [RESERVED, TAKEN, solver::WORDS].concat();
    let words: Vec<&str> =
        words.into_iter().filter(|w| *w != "q").chain(taken.iter().map(String::as_str)).collect();
    let plans = plans(library, Language::Rust, &inputs(library, Language::Rust, &words), TAKEN, &taken);
    let source = Source { library, functions, plans, opening, name, names };
    let file = |path: &str, text: String| File { path: path.into(), text };
    let mut files = vec![file("Cargo.toml", source.manifest()), file("src/lib.rs", source.root())];
    files.push(file("rustfmt.toml", source.format()));
    if source.needs_kernel() {
        files.push(file("src/kernel.rs", source.kernel()));
    }
    if source.has_pairs() || source.has_atan2() {
        files.push(file("src/kernel/fused.rs", source.fused()));
    }
    if !source.plans.is_empty() {
        files.push(file("src/roots.rs", source.roots()));
    }
    files.push(file("tests/vectors.rs", source.test()));
    files.extend(source.attached());
    files
}

struct Source<'a> {
    library: &'a Library<'a>,
    functions: Vec<Function<'a>>,
    plans: Vec<Plan<'a>>,
    /// What every file opens with.
    opening: Vec<String>,
    /// The name of the package.
    name: String,
    /// Identifiers of variables and parameters.
    names: Names,
}

impl Source<'_> {
    /// The words that open a file, and some more.
    fn head(&self, prefix: &str, more: &[&str]) -> String {
        let opening = self.opening.iter().map(String::as_str);
        lines(&comments(opening.chain(more.iter().copied()), prefix, WIDTH))
    }

    fn spelling<'a>(&self, f: &'a Function) -> Spelling<'a> {
        f.spelling(Language::Rust, Precision::Double)
    }

    fn has_pairs(&self) -> bool {
        Function::any_pair(&self.functions) || Plan::any_pair(&self.plans)
    }

    fn has_atan2(&self) -> bool {
        self.is_called_beside("atan2") || Function::any_atan2(&self.functions) || Plan::any_atan2(&self.plans)
    }

    fn has_root(&self) -> bool {
        let divides = |p: &Plan| p.nodes.iter().any(|n| n.kind() != Kind::Ratio) || p.any_root();
        self.is_called_beside("sqrt") || Function::any_root(&self.functions) || self.plans.iter().any(divides)
    }

    fn needs_kernel(&self) -> bool {
        self.has_pairs() || self.has_atan2() || self.has_root()
    }

    fn manifest(&self) -> String {
        let title = comment(&self.library.title).replace('"', "'");
        format!(
            "{}\n[package]\nname = \"{}\"\nversion = \"0.1.0\"\nedition = \"2024\"\nrust-version = \"1.85\"\n\
             description = \"{title}\"\n\n[features]\ndefault = [\"std\"]\n\
             # Fused multiply-add where the target has it (RUSTFLAGS=\"-C target-cpu=x86-64-v3\"). Without\n\
             # this feature only `core` is needed, and results have the same bits on every machine.\nstd = []\n",
            self.brief(),
            self.name
        )
    }

    /// The code is laid out already.
    fn format(&self) -> String {
        format!("{}\ndisable_all_formatting = true\n", self.brief())
    }

    fn brief(&self) -> String {
        let lines_of_it = brief(self.library, "src/lib.rs");
        lines(&comments(lines_of_it.iter().map(String::as_str), "# ", WIDTH))
    }

    /// A call of the first function; documentation that is a test.
    fn example(&self) -> Vec<String> {
        let Some(f) = self.functions.first() else { return vec![] };
        let (name, n) = (&self.name, self.library.variables.len());
        let result = if f.result == f.name || f.result == *name { "results" } else { &f.result };
        let index: String = f.shape().iter().map(|_| "[0]").collect();
        let mut lines = vec!["```".to_string()];
        let parameters =
            match (f.parameters(self.library).is_empty(), defaults(self.library)) {
                (true, _) => {
                    lines.push(format!("use {name}::{};", f.name));
                    String::new()
                }
                (false, Some(_)) => {
                    lines.push(format!("use {name}::{{{}, Parameters}};", f.name));
                    ", &Parameters::default()".into()
                }
                (false, None) => {
                    lines.push(format!("use {name}::{{{}, Parameters}};", f.name));
                    lines.push("let parameters = Parameters {".into());
                    lines.extend(self.library.parameters.iter().map(|p| {
                        format!("    {}: {:?},", self.names.of(p.symbol), p.default.unwrap_or(1.0))
                    }));
                    lines.push("};".into());
                    ", &parameters".into()
                }
            };
        lines.push(format!("let {result} = {}(&[0.0; {n}]{parameters});", f.name));
        lines.push(format!("assert!({result}{index}.is_finite());"));
        lines.push("```".into());
        lines
    }

    fn root(&self) -> String {
        let example = self.example();
        let angles: Vec<String> =
            about_angles(&self.functions, Precision::Double).iter().map(|line| doc(line)).collect();
        let mut more = vec![""];
        more.extend(example.iter().map(String::as_str));
        more.extend(["", "The functions allocate nothing and need `core` only."]);
        more.extend(angles.iter().map(String::as_str));
        let has_functions = !self.functions.is_empty();
        more.extend(has_functions.then_some([
            "",
            "A block holds the values of `LANES` configurations side by side: `q[j][i]` is variable j of",
            "configuration i, and result k of it, counted row by row, comes to row k. All lanes must hold",
            "finite numbers. Blocks are several times faster than single calls if the compiler may use",
            "vector instructions and fused multiply-add: `RUSTFLAGS=\"-C target-cpu=x86-64-v3\"` or",
            "`native`.",
        ]).into_iter().flatten());
        let opening: String = self.head("//! ", &[]).replace("```", "'''");
        let mut text = format!("//! ```text\n{opening}//! ```\n");
        text.push_str(&lines(&comments(more, "//! ", WIDTH)));
        let is_attached = !self.library.attachments.is_empty();
        text.push_str(if is_attached {
            "\n#![cfg_attr(not(feature = \"std\"), no_std)]\n"
        } else {
            "\n#![no_std]\n"
        });
        text.push_str(
            "#![forbid(unsafe_code)]\n#![allow(non_snake_case, clippy::approx_constant)]\n\n\
             #[cfg(feature = \"std\")]\nextern crate std;\n",
        );
        if self.needs_kernel() {
            text.push_str("\nmod kernel;\n");
        }
        if !self.plans.is_empty() {
            text.push_str("mod roots;\n");
        }
        for attachment in &self.library.attachments {
            text.push_str(&Attachment::named(&attachment.declarations, &self.name));
        }
        let code = self.code();
        let used: Vec<&str> = KERNEL.iter().copied().filter(|word| is_called(&code, word)).collect();
        if !used.is_empty() {
            text.push('\n');
        }
        if is_called(&code, "from_fn") {
            text.push_str("use core::array::from_fn;\n");
        }
        match &used[..] {
            [] => {}
            [one] => _ = writeln!(text, "use kernel::{one};"),
            many => {
                let many: Vec<String> = many.iter().map(|name| name.to_string()).collect();
                let mut out = Body { text, indent: 0 };
                out.list("use kernel::{", &many, "};");
                text = out.text;
            }
        }
        text + &code
    }

    /// The functions, and what they are for.
    fn code(&self) -> String {
        let mut text = String::new();
        if !self.functions.is_empty() {
            text.push_str(&format!("\n/// Configurations of a block.\npub const LANES: usize = {LANES};\n"));
        }
        text.push_str(&self.parameters());
        if Function::any_sign(&self.functions) {
            text.push_str(
                "\n/// 1, −1, or the number itself where it is 0 or none.\n#[inline(always)]\nfn sign_of(x: f64) -> f64 {\n    \
                 if x > 0.0 {\n        1.0\n    } else if x < 0.0 {\n        -1.0\n    } else {\n        x\n    }\n}\n",
            );
        }
        for f in &self.functions {
            text.push_str(&self.one(f));
            text.push_str(&self.block(f));
            if f.has_range() {
                text.push_str(&self.one_by_one(f));
            }
        }
        text + &self.solvers()
    }

    fn parameters(&self) -> String {
        if self.library.parameters.is_empty() {
            return String::new();
        }
        let mut text = String::from(
            "\n/// Parameters.\n#[derive(Clone, Copy, PartialEq, Debug)]\npub struct Parameters {\n",
        );
        for p in &self.library.parameters {
            let about = doc(&self.names.about(p.symbol, &p.about));
            text.push_str(&lines(&comments([about.as_str()], "    /// ", WIDTH)));
            let _ = writeln!(text, "    pub {}: f64,", self.names.of(p.symbol));
        }
        text.push_str("}\n");
        if let Some(values) = defaults(self.library) {
            text.push_str(
                "\nimpl Default for Parameters {\n    /// The values where nothing else is known.\n    \
                 fn default() -> Self {\n        Parameters {\n",
            );
            for (p, value) in self.library.parameters.iter().zip(values) {
                let _ = writeln!(text, "            {}: {value:?},", self.names.of(p.symbol));
            }
            text.push_str("        }\n    }\n}\n");
        }
        text
    }

    /// `, parameters: &Parameters` if the function reads any.
    fn parameter(&self, f: &Function) -> &'static str {
        if f.parameters(self.library).is_empty() { "" } else { ", parameters: &Parameters" }
    }

    fn argument(&self, f: &Function) -> &'static str {
        if f.parameters(self.library).is_empty() { "" } else { ", parameters" }
    }

    /// The name of the array of variables.
    fn q(&self, f: &Function) -> &'static str {
        if f.variables(self.library).is_empty() { "_q" } else { "q" }
    }

    fn one(&self, f: &Function) -> String {
        let count = f.routine.program.count().to_string();
        let about: Vec<String> = f.routine.about.iter().map(|line| doc(line)).collect();
        let about = about.iter().map(String::as_str).chain(["", &count]);
        let mut text = format!("\n{}", lines(&comments(about, "/// ", WIDTH)));
        let array = f.shape().iter().rev().fold("f64".to_string(), |inner, n| format!("[{inner}; {n}]"));
        let n = self.library.variables.len();
        let head = format!("pub fn {}(", f.name);
        let arguments = format!("{}: &[f64; {n}]{}", self.q(f), self.parameter(f));
        text.push_str(&signature(&head, &arguments, &format!(") -> {array} {{")));
        let mut out = Body { text, indent: 4 };
        self.take_parameters(f, &mut out);
        self.take_variables(f, &mut out);
        let mut names = f.names.clone();
        // Matrices in a row are written one after another.
        let is_stack = f.shape().len() > 2;
        let zeros = f.shape().iter().rev().fold("0.0".to_string(), |inner, n| format!("[{inner}; {n}]"));
        let mut part = 0;
        if is_stack {
            out.line(&format!("let mut {} = {zeros};", f.result));
        }
        let mut results: Vec<Expr> = vec![];
        for step in &for_one(f) {
            match step {
                Step::Pairs(pairs) => {
                    out.blank();
                    for run in Function::runs(pairs) {
                        if run.len() > 1 {
                            self.eight(f, run, &mut names, &mut out);
                        } else {
                            self.pair(f, "sin_cos", &run[0], &mut out);
                        }
                    }
                    out.blank();
                }
                Step::Atan2 { name, y, x } => self.atan2(f, "atan2", name, [*y, *x], &mut out),
                Step::Let { name, value } => self.value(f, name, *value, &mut out),
                Step::Result { value, .. } => {
                    results.push(*value);
                    if is_stack && results.len() == f.shape()[1..].iter().product() {
                        let head = format!("{}[{part}] = ", f.result);
                        out.nested(&head, &self.formulas(f, &results), &f.shape()[1..], ";");
                        part += 1;
                        results.clear();
                    }
                }
                Step::Break => out.blank(),
            }
        }
        out.blank();
        if is_stack {
            out.line(&f.result);
        } else {
            out.nested("", &self.formulas(f, &results), &f.shape(), "");
        }
        out.text + "}\n"
    }

    fn formulas(&self, f: &Function, list: &[Expr]) -> Vec<String> {
        list.iter().map(|e| self.spelling(f).formula(*e)).collect()
    }

    fn block(&self, f: &Function) -> String {
        let (n, m) = (self.library.variables.len(), f.results());
        let mut text = format!("\n/// [`{}`] of a block of configurations.\n", f.name);
        let arguments = format!(
            "{}: &[[f64; LANES]; {n}]{}, {}: &mut [[f64; LANES]; {m}]",
            self.q(f),
            self.parameter(f),
            f.result
        );
        text.push_str(&signature(&format!("pub fn {}_block(", f.name), &arguments, ") {"));
        let mut out = Body { text, indent: 4 };
        self.take_parameters(f, &mut out);
        for step in &f.hoisted {
            match step {
                Step::Pairs(pairs) => pairs.iter().for_each(|p| self.pair(f, "sin_cos", p, &mut out)),
                Step::Atan2 { name, y, x } => self.atan2(f, "atan2", name, [*y, *x], &mut out),
                Step::Let { name, value } => self.value(f, name, *value, &mut out),
                Step::Break | Step::Result { .. } => {}
            }
        }
        if f.has_range() {
            out.line("let mut in_range = true;");
        }
        out.line("for i in 0..LANES {");
        out.indent = 8;
        for (k, symbol) in f.variables(self.library) {
            out.line(&format!("let {} = q[{k}][i];", f.names.of(symbol)));
        }
        out.blank();
        let mut names = f.names.clone();
        for step in &f.body {
            match step {
                Step::Pairs(pairs) => {
                    for p in pairs {
                        let angle = self.named(f, p.angle, &mut names, &mut out);
                        out.line(&format!("in_range &= sin_cos_in_range({angle});"));
                        out.line(&format!("let {} = near_sin_cos({angle});", names_of(f, p)));
                    }
                    out.blank();
                }
                Step::Atan2 { name, y, x } => {
                    let [y, x] = [*y, *x].map(|e| self.named(f, e, &mut names, &mut out));
                    out.line(&format!("in_range &= atan2_in_range({y}, {x});"));
                    out.line(&format!("let {} = near_atan2({y}, {x});", f.of(name)));
                }
                Step::Let { name, value } => self.value(f, name, *value, &mut out),
                Step::Result { place, value } => {
                    out.statement(&format!("{}[{place}][i] =", f.result), &self.spelling(f).formula(*value));
                }
                Step::Break => out.blank(),
            }
        }
        out.indent = 4;
        out.line("}");
        if f.has_range() {
            out.line("if !in_range {");
            out.line(&format!("    {}_one_by_one({}{}, {});", f.name, self.q(f), self.argument(f), f.result));
            out.line("}");
        }
        out.text + "}\n"
    }

    /// The block without vector code.
    fn one_by_one(&self, f: &Function) -> String {
        let (n, m, name) = (self.library.variables.len(), f.results(), &f.name);
        let arguments =
            format!("q: &[[f64; LANES]; {n}]{}, block: &mut [[f64; LANES]; {m}]", self.parameter(f));
        let head = signature(&format!("fn {name}_one_by_one("), &arguments, ") {");
        let flat = ".as_flattened()".repeat(f.shape().len() - 1);
        format!(
            "\n/// A block with an angle that is huge, infinite or not a number.\n#[cold]\n#[inline(never)]\n{head}    \
             for i in 0..LANES {{\n        let one = {name}(&from_fn(|j| q[j][i]){});\n        \
             for (k, value) in one{flat}.iter().enumerate() {{\n            block[k][i] = *value;\n        \
             }}\n    }}\n}}\n",
            self.argument(f)
        )
    }

    fn take_parameters(&self, f: &Function, out: &mut Body) {
        let read = f.parameters(self.library);
        if read.is_empty() {
            return;
        }
        let mut fields: Vec<String> = read.iter().map(|s| f.names.of(*s).to_string()).collect();
        if read.len() < self.library.parameters.len() {
            fields.push("..".into());
        }
        out.list_spaced("let Parameters {", &fields, "} = *parameters;");
    }

    fn take_variables(&self, f: &Function, out: &mut Body) {
        let read = |s: Symbol| if f.reads(s) { f.names.of(s).to_string() } else { "_".into() };
        let variables: Vec<String> = self.library.variables.iter().map(|v| read(v.0)).collect();
        if variables.iter().any(|v| v != "_") {
            out.list("let [", &variables, "] = *q;");
        }
    }

    /// A name, or a formula that gets one.
    fn named(&self, f: &Function, e: Expr, names: &mut Names, out: &mut Body) -> String {
        let formula = self.spelling(f).formula(e);
        if e.as_symbol().is_some() || e.symbols().is_empty() {
            return formula;
        }
        let name = names.free("angle");
        out.statement(&format!("let {name} ="), &formula);
        name
    }

    fn value(&self, f: &Function, name: &str, value: Expr, out: &mut Body) {
        out.statement(&format!("let {} =", f.of(name)), &self.spelling(f).formula(value));
    }

    fn atan2(&self, f: &Function, call: &str, name: &str, [y, x]: [Expr; 2], out: &mut Body) {
        let spelling = self.spelling(f);
        let formula = format!("{call}({}, {})", spelling.formula(y), spelling.formula(x));
        out.statement(&format!("let {} =", f.of(name)), &formula);
    }

    fn pair(&self, f: &Function, call: &str, p: &Pair, out: &mut Body) {
        let formula = format!("{call}({})", self.spelling(f).formula(p.angle));
        out.statement(&format!("let {} =", names_of(f, p)), &formula);
    }

    fn eight(&self, f: &Function, run: &[Pair], names: &mut Names, out: &mut Body) {
        let mut formulas: Vec<String> = run.iter().map(|p| self.spelling(f).formula(p.angle)).collect();
        formulas.resize(EIGHT, "0.0".into());
        let name = |name: &Option<String>| name.as_ref().map_or("_", |name| f.of(name)).to_string();
        let sines: Vec<String> = run.iter().map(|p| name(&p.sine)).collect();
        let cosines: Vec<String> = run.iter().map(|p| name(&p.cosine)).collect();
        let mut array = |word: &str, list: &[String]| {
            if list.iter().all(|name| name == "_") { "_".into() } else { names.free(word) }
        };
        let arrays = [array("sines", &sines), array("cosines", &cosines)];
        out.list(&format!("let ({}, {}) = sin_cos_8([", arrays[0], arrays[1]), &formulas, "]);");
        for (mut list, array) in [sines, cosines].into_iter().zip(arrays) {
            if list.len() < EIGHT {
                list.push("..".into());
            }
            if array != "_" {
                out.list("let [", &list, &format!("] = {array};"));
            }
        }
    }
}

/// Whether code calls a function, without a path.
fn is_called(code: &str, name: &str) -> bool {
    let call = format!("{name}(");
    let is_other = |c: char| c.is_alphanumeric() || c == '_' || c == ':' || c == '.';
    let calls = |line: &str| line.match_indices(&call).any(|(at, _)| !line[..at].ends_with(is_other));
    let lines = code.lines().map(str::trim_start);
    lines.filter(|line| !line.starts_with("//") && !line.starts_with("pub fn")).any(calls)
}

/// `(s1, c1)`, with `_` for what is not read.
fn names_of(f: &Function, p: &Pair) -> String {
    let name = |name: &Option<String>| name.as_ref().map_or("_", |name| f.of(name)).to_string();
    format!("({}, {})", name(&p.sine), name(&p.cosine))
}

/// A text for documentation: what would be markup there is taken literally.
fn doc(text: &str) -> String {
    text.chars().flat_map(|c| "[]<>`*_".contains(c).then_some('\\').into_iter().chain([c])).collect()
}

/// `head arguments tail`, an argument a line if it is too long.
fn signature(head: &str, arguments: &str, tail: &str) -> String {
    let whole = format!("{head}{arguments}{tail}\n");
    if whole.chars().count() <= WIDTH {
        return whole;
    }
    let arguments: String = arguments.split(", ").map(|a| format!("    {a},\n")).collect();
    format!("{head}\n{arguments}{tail}\n")
}
