//! CUDA C++: a header with device functions, a file with kernels, and two tests.
//!
//! One thread computes one configuration, with the values of all configurations side by side in memory.

mod solver;
mod test;

use crate::compiled::{
    Body, Function, Pair, Step, WIDTH, about_angles, defaults, file_name, functions, inputs, opening,
};
use crate::names::Names;
use crate::order::for_blocks;
use crate::solver::{Plan, plans};
use crate::spelling::Spelling;
use crate::wrap::comments;
use crate::{File, Language, Library, Precision, c};
use denavit_symbolic::Expr;
use std::fmt::Write;

/// Words that the emitted code uses, besides those of C.
const RESERVED: &[&str] = &[
    "count", "values", "sign_of", "sincos", "sincosf", "sinf", "cosf", "atan2f", "sqrtf", "launch", "run",
    "must", "size_t", "in", "out", "std", "blocks", "warpsize", "dim3", "uint3",
];

pub(crate) fn emit(library: &Library) -> Vec<File> {
    let reserved = [c::RESERVED, RESERVED].concat();
    let name = file_name(library, Language::Cuda);
    let names = inputs(library, Language::Cuda, &reserved);
    let functions = functions(library, Language::Cuda, &names, &[]);
    let opening = opening(library, &functions, &names, &name);
    let plans = solver_plans(library, &functions);
    let source = Source { library, functions, plans, opening, name, names };
    let file = |path: String, text: String| File { path, text };
    vec![
        file(format!("{}.cuh", source.name), source.header()),
        file(format!("{}.cu", source.name), source.kernels()),
        file(format!("test_{}.cu", source.name), source.host_test()),
        file(format!("test_{}.py", source.name), source.python_test()),
    ]
}

/// The solvers, whose names are none of functions.
fn solver_plans<'a>(library: &'a Library, functions: &[Function]) -> Vec<Plan<'a>> {
    let of = |f: &Function| [f.name.clone(), format!("{}_kernel", f.name)];
    let taken: Vec<String> = functions.iter().flat_map(of).collect();
    let more = RESERVED.iter().copied().chain(["number", "place", "s"]);
    let reserved: Vec<&str> = c::solver::reserved().into_iter().chain(more).collect();
    plans(library, Language::Cuda, &inputs(library, Language::Cuda, &reserved), &[], &taken)
}

struct Source<'a> {
    library: &'a Library<'a>,
    functions: Vec<Function<'a>>,
    plans: Vec<Plan<'a>>,
    /// What every file opens with.
    opening: Vec<String>,
    /// The prefix of everything.
    name: String,
    /// Identifiers of variables and parameters.
    names: Names,
}

impl Source<'_> {
    fn lines(&self) -> impl Iterator<Item = &str> {
        self.opening.iter().map(String::as_str)
    }

    fn is_single(&self) -> bool {
        self.library.precision == Precision::Single
    }

    fn real(&self) -> &'static str {
        if self.is_single() { "float" } else { "double" }
    }

    fn spelling<'a>(&self, f: &'a Function) -> Spelling<'a> {
        f.spelling(Language::Cuda, self.library.precision)
    }

    fn variables(&self) -> usize {
        self.library.variables.len().max(1)
    }

    fn header(&self) -> String {
        let (name, upper, real) = (&self.name, self.name.to_uppercase(), self.real());
        let mut words = vec![String::new()];
        words.extend(self.example());
        words.extend([
            "How to call: device functions take arrays of the calling thread; parameters go by value to"
                .into(),
            "kernels and by reference to device functions. Nothing is allocated.".into(),
        ]);
        words.extend(about_angles(&self.functions, self.library.precision));
        words.push(String::new());
        if Function::any_pair(&self.functions) {
            words.push(
                "Sines and cosines are the device's, within 2 units in the last place by CUDA's documentation."
                    .into(),
            );
        }
        if Function::any_atan2(&self.functions) {
            let units = if self.is_single() { 3 } else { 2 };
            words.push(format!("Arctangents are the device's, within {units}."));
        }
        words.push(
            "Products and sums are contracted as the compiler likes, unless --fmad=false is given.".into(),
        );
        if self.is_single() {
            words.push("Never compile with --use_fast_math: sines lose most of their digits.".into());
        }
        let mut text = c::block_comment(self.lines().chain(words.iter().map(String::as_str)));
        let _ = write!(text, "#ifndef {upper}_CUH\n#define {upper}_CUH\n");
        if !self.library.parameters.is_empty() {
            let _ = write!(text, "\n/* Parameters. */\nstruct {name}_parameters {{\n");
            for p in &self.library.parameters {
                let about = self.names.about(p.symbol, &p.about);
                let about = comments([about.as_str()], "", WIDTH - 10).join("\n       ");
                let _ = write!(text, "    /* {about} */\n    {real} {};\n", self.names.of(p.symbol));
            }
            text.push_str("};\n");
            if let Some(values) = defaults(self.library) {
                let _ = write!(
                    text,
                    "\n/* The values of the parameters where nothing else is known. */\n\
                     __host__ __device__ inline {name}_parameters {name}_defaults()\n{{\n    \
                     {name}_parameters parameters;\n"
                );
                let spelling = Spelling {
                    language: Language::Cuda,
                    precision: self.library.precision,
                    names: &self.names,
                };
                for (p, value) in self.library.parameters.iter().zip(values) {
                    let (field, number) = (self.names.of(p.symbol), spelling.number(value));
                    let _ = writeln!(text, "    parameters.{field} = {number};");
                }
                text.push_str("    return parameters;\n}\n");
            }
        }
        if Function::any_sign(&self.functions) {
            let _ = write!(
                text,
                "\n/* 1, -1, or the number itself where it is 0 or none. */\n\
                 __device__ inline {real} sign_of({real} x)\n{{\n    \
                 return x > 0 ? 1 : x < 0 ? -1 : x;\n}}\n"
            );
        }
        for f in &self.functions {
            let count = format!("{}.", f.routine.program.count());
            let about = f.routine.about.iter().map(String::as_str).chain([count.as_str()]);
            text.push('\n');
            text.push_str(&c::block_comment(about));
            text.push_str(&self.one(f));
        }
        text.push_str(&self.solvers());
        text.push_str("\n#endif\n");
        text
    }

    /// A call of the first function, as a comment shows it.
    fn example(&self) -> Vec<String> {
        let (name, real) = (&self.name, self.real());
        let Some(f) = self.functions.first() else { return vec![] };
        let shape: String = f.shape().iter().map(|n| format!("[{n}]")).collect();
        let mut lines = vec![format!("Example, in code of the device (a kernel for many is in {name}.cu):")];
        lines.push(format!("    {real} q[{}] = {{}};", self.variables()));
        lines.push(format!("    {real} {}{shape};", f.result));
        let argument = match (f.parameters(self.library).is_empty(), defaults(self.library)) {
            (true, _) => "",
            (false, Some(_)) => {
                lines.push(format!("    const {name}_parameters parameters = {name}_defaults();"));
                "parameters, "
            }
            (false, None) => {
                lines.push(format!("    {name}_parameters parameters = {{}}; // and values for all of them"));
                "parameters, "
            }
        };
        lines.push(format!("    {name}_{}(q, {argument}{});", f.name, f.result));
        lines.push(String::new());
        lines
    }

    fn one(&self, f: &Function) -> String {
        let real = self.real();
        let shape: String = f.shape().iter().map(|n| format!("[{n}]")).collect();
        let parameters = self.parameters(f, "const ", " &");
        let arguments =
            format!("const {real} q[{}], {parameters}{real} {}{shape})", self.variables(), f.result);
        let head = c::call(&format!("__device__ inline void {}_{}(", self.name, f.name), &arguments);
        let mut out = Body { text: format!("{head}\n{{\n"), indent: 4 };
        if f.variables(self.library).is_empty() {
            out.line("(void)q;");
        }
        for symbol in f.parameters(self.library) {
            let name = f.names.of(symbol);
            out.line(&format!("const {real} {name} = parameters.{name};"));
        }
        for (k, symbol) in f.variables(self.library) {
            out.line(&format!("const {real} {} = q[{k}];", f.names.of(symbol)));
        }
        out.blank();
        for step in f.hoisted.iter().chain(&for_blocks(f)) {
            match step {
                Step::Pairs(pairs) => {
                    pairs.iter().for_each(|p| self.pair(f, p, &mut out));
                    out.blank();
                }
                Step::Atan2 { name, y, x } => {
                    let (call, spelling) =
                        (if self.is_single() { "atan2f" } else { "atan2" }, self.spelling(f));
                    let formula = format!("{call}({}, {})", spelling.formula(*y), spelling.formula(*x));
                    out.statement(&format!("const {real} {} =", f.of(name)), &formula);
                }
                Step::Let { name, value } => self.value(f, name, *value, &mut out),
                Step::Result { place, value } => {
                    let index: String = f.indices(*place).iter().map(|i| format!("[{i}]")).collect();
                    out.statement(&format!("{}{index} =", f.result), &self.spelling(f).formula(*value));
                }
                Step::Break => out.blank(),
            }
        }
        out.text + "}\n"
    }

    fn value(&self, f: &Function, name: &str, value: Expr, out: &mut Body) {
        let formula = self.spelling(f).formula(value);
        out.statement(&format!("const {} {} =", self.real(), f.of(name)), &formula);
    }

    fn pair(&self, f: &Function, p: &Pair, out: &mut Body) {
        let (real, angle) = (self.real(), self.spelling(f).formula(p.angle));
        let f_or_none = if self.is_single() { "f" } else { "" };
        match (&p.sine, &p.cosine) {
            (Some(sine), Some(cosine)) => {
                let (sine, cosine) = (f.of(sine), f.of(cosine));
                out.line(&format!("{real} {sine}, {cosine};"));
                out.line(&format!("sincos{f_or_none}({angle}, &{sine}, &{cosine});"));
            }
            (Some(sine), None) => {
                out.line(&format!("const {real} {} = sin{f_or_none}({angle});", f.of(sine)))
            }
            (None, Some(cosine)) => {
                out.line(&format!("const {real} {} = cos{f_or_none}({angle});", f.of(cosine)));
            }
            (None, None) => {}
        }
    }

    /// `ur5_parameters parameters, ` if the function reads any.
    fn parameters(&self, f: &Function, before: &str, after: &str) -> String {
        if f.parameters(self.library).is_empty() {
            return String::new();
        }
        let space = if after.is_empty() { " " } else { after };
        format!("{before}{}_parameters{space}parameters, ", self.name)
    }

    fn argument(&self, f: &Function) -> &'static str {
        if f.parameters(self.library).is_empty() { "" } else { "parameters, " }
    }

    fn kernels(&self) -> String {
        let name = &self.name;
        let first = self.functions.first().map_or("fk", |f| f.name.as_str());
        let mut text = c::block_comment(self.lines().chain([
            "",
            "One thread computes one configuration. Variable j of configuration i stands at",
            "q[j * count + i]; result k of it, counted row by row, comes to place k * count + i: threads",
            "side by side read and write side by side. Any number of threads does; for example",
            &format!("    {name}_{first}_kernel<<<(count + 255) / 256, 256>>>(count, q, ...);"),
            "The arrays are the device's, of the lengths that this needs, and do not overlap.",
        ]));
        let _ = writeln!(text, "#include \"{name}.cuh\"");
        for f in &self.functions {
            let shape: String = f.shape().iter().map(|n| format!("[{n}]")).collect();
            let real = self.real();
            let arguments = format!(
                "size_t count, const {real} *__restrict__ q, {}{real} *__restrict__ {})",
                self.parameters(f, "", ""),
                f.result
            );
            let head =
                c::call(&format!("extern \"C\" __global__ void {name}_{}_kernel(", f.name), &arguments);
            let body = include_str!("kernel.cu")
                .replace("@first@", &"[0]".repeat(f.shape().len() - 1))
                .replace("@shape@", &shape)
                .replace("@argument@", self.argument(f))
                .replace("@result@", &f.result)
                .replace("@real@", real)
                .replace("@name@", name)
                .replace("@f@", &f.name)
                .replace("@n@", &self.variables().to_string())
                .replace("@m@", &f.results().to_string());
            let _ = write!(text, "\n{head}\n{body}");
        }
        self.plans.iter().for_each(|plan| text.push_str(&self.solver_kernel(plan)));
        text
    }
}
