//! C99 that is C++11 too: a header, a source file, and a test with its Makefile.
//!
//! A function for one configuration, and one for a block of some with the values of all lanes side by side. The
//! routines for sines, cosines and angles are embedded (`c/*.c`), since a compiler makes vector code of them.

pub(crate) mod single;
pub(crate) mod solver;
pub(crate) mod test;
mod words;

pub(crate) use words::RESERVED;

use crate::compiled::{
    Body, EIGHT, Function, Pair, Step, WIDTH, WRAP, about_angles, defaults, file_name, functions, inputs,
    lanes, lines, opening,
};
use crate::names::{Names, brief};
use crate::order::{for_blocks, for_one, is_large};
use crate::solver::{Plan, plans};
use crate::spelling::Spelling;
use crate::wrap::comments;
use crate::{Attachment, File, Language, Library, Parameter, Precision};
use denavit_symbolic::{Expr, Symbol};
use std::fmt::Write;

pub(crate) fn emit(library: &Library) -> Vec<File> {
    let name = file_name(library, Language::C);
    let names = inputs(library, Language::C, RESERVED);
    let functions = functions(library, Language::C, &names, &[]);
    let opening = opening(library, &functions, &names, &name);
    let plans = solver_plans(library, &functions);
    let source = Source { library, functions, plans, opening, name, names };
    let file = |path: String, text: String| File { path, text };
    let head = brief(library, &format!("{}.h", source.name));
    let head = head.iter().map(String::as_str);
    let makefile = include_str!("Makefile.txt").replace("@name@", &source.name);
    let attached = library.attachments.iter().flat_map(|a| a.named_files(&source.name));
    let mut files = vec![
        file(format!("{}.h", source.name), source.header()),
        file(format!("{}.c", source.name), source.body()),
        file(format!("test_{}.c", source.name), source.test()),
        file("Makefile".into(), format!("{}\n{makefile}", lines(&comments(head, "# ", WIDTH)))),
    ];
    files.extend(attached);
    files
}

/// The solvers, whose names are none of functions.
fn solver_plans<'a>(library: &'a Library, functions: &[Function]) -> Vec<Plan<'a>> {
    let of = |f: &Function| [f.name.clone(), format!("{}_block", f.name)];
    let taken: Vec<String> = functions.iter().flat_map(of).collect();
    plans(library, Language::C, &inputs(library, Language::C, &solver::reserved()), &[], &taken)
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

    fn real(&self) -> &'static str {
        match self.library.precision {
            Precision::Double => "double",
            Precision::Single => "float",
        }
    }

    fn upper(&self) -> String {
        self.name.to_uppercase()
    }

    fn spelling<'a>(&self, function: &'a Function) -> Spelling<'a> {
        function.spelling(Language::C, self.library.precision)
    }

    /// A number that no function needs to spell.
    fn number(&self, x: f64) -> String {
        let names = Default::default();
        Spelling { language: Language::C, precision: self.library.precision, names: &names }.number(x)
    }

    /// A text of double precision in the precision of the library.
    fn in_precision(&self, text: &str) -> String {
        match self.library.precision {
            Precision::Double => text.into(),
            Precision::Single => ["sin(x)", "cos(x)"]
                .into_iter()
                .fold(text.replace("double", "float"), |t, call| t.replace(call, &call.replace('(', "f("))),
        }
    }

    fn header(&self) -> String {
        let (name, upper, real) = (&self.name, self.upper(), self.real());
        let (angles, example) = (about_angles(&self.functions, self.library.precision), self.example());
        let mut words = vec![String::new()];
        words.extend(example);
        words.extend([
            "How to call: q and the results are arrays of the caller; they do not overlap. Nothing is".into(),
            "allocated or stored. Any number of threads may call at once.".into(),
        ]);
        words.extend(angles);
        let huge = match (Function::any_range(&self.functions), self.library.precision) {
            (false, _) => "",
            (true, Precision::Double) => ", but for angles above 1.6e6, where it calls the C library",
            (true, Precision::Single) => ", but for angles above 6400, where it calls the C library",
        };
        let lanes = lanes(self.library, &self.functions);
        let strict =
            format!("-D{upper}_STRICT uses no fused multiply-add: the same bits on every machine{huge}.");
        let mut text = block_comment(self.lines().chain(words.iter().map(String::as_str)).chain([
            "",
            &format!(
                "A block holds {lanes} configurations side by side. Variable j of configuration i stands at"
            ),
            &format!(
                "q[{upper}_LANES * j + i]; result k, counted row by row, at [{upper}_LANES * k + i]. Blocks"
            ),
            "aligned to 64 bytes are fastest. Lanes that are not needed must hold finite numbers.",
            "",
            "Never compile with -ffast-math, -Ofast or /fp:fast: they remove roundings that results depend",
            "on. icx does so by default: give it -fp-model=precise. Link with -lm.",
            "Compile with -ffp-contract=off; with -O3 and -march=x86-64-v3 (or -march=native) for speed, or",
            &format!("with -D{upper}_MULTIVERSION (gcc on x86-64), which chooses when the program starts."),
            &strict,
        ]));
        let _ = write!(
            text,
            "#ifndef {upper}_H\n#define {upper}_H\n\n#ifdef __cplusplus\nextern \"C\" {{\n#endif\n\n\
             /* Variables of a configuration. */\n#define {upper}_VARIABLES {}\n\
             /* Configurations of a block. */\n#define {upper}_LANES {lanes}\n",
            self.library.variables.len()
        );
        if !self.library.parameters.is_empty() {
            let _ = write!(text, "\n/* Parameters. */\ntypedef struct {name}_parameters {{\n");
            for p in &self.library.parameters {
                let field = self.field(p.symbol);
                let about = self.names.about(p.symbol, &p.about);
                let about = comments([about.as_str()], "", WIDTH - 10).join("\n       ");
                let _ = write!(text, "    /* {about} */\n    {real} {field};\n");
            }
            let _ = writeln!(text, "}} {name}_parameters;");
            if defaults(self.library).is_some() {
                let _ = write!(
                    text,
                    "\n/* The values of the parameters where nothing else is known. */\n\
                     extern const {name}_parameters {name}_defaults;\n"
                );
            }
        }
        for f in &self.functions {
            let count = format!("{}.", f.routine.program.count());
            let about = f.routine.about.iter().map(String::as_str).chain([count.as_str()]);
            let _ = write!(text, "\n{}{};\n", block_comment(about), self.signature(f, ""));
            let words = format!("The same for a block of {upper}_LANES configurations.");
            let _ = write!(text, "\n/* {words} */\n{};\n", self.block_signature(f, "", ""));
        }
        self.plans.iter().for_each(|plan| text.push_str(&self.declaration(plan)));
        text.push_str(&self.attached(|a| &a.declarations));
        text.push_str("\n#ifdef __cplusplus\n}\n#endif\n\n#endif\n");
        text
    }

    fn field(&self, symbol: Symbol) -> &str {
        self.names.of(symbol)
    }

    /// A call of the first function, as a comment shows it.
    fn example(&self) -> Vec<String> {
        let (name, real) = (&self.name, self.real());
        let Some(f) = self.functions.first() else { return vec![] };
        let shape: String = f.shape().iter().map(|n| format!("[{n}]")).collect();
        let mut lines = vec!["Example:".to_string()];
        lines.push(format!("    {real} q[{}] = {{ 0 }};", self.library.variables.len().max(1)));
        lines.push(format!("    {real} {}{shape};", f.result));
        let argument = match (f.parameters(self.library).is_empty(), defaults(self.library)) {
            (true, _) => String::new(),
            (false, Some(_)) => format!("&{name}_defaults, "),
            (false, None) => {
                lines.push(format!("    {name}_parameters parameters;"));
                let one = |p: &Parameter| {
                    let value = self.number(p.default.unwrap_or(1.0));
                    format!("    parameters.{} = {value};", self.names.of(p.symbol))
                };
                lines.extend(self.library.parameters.iter().map(one));
                "&parameters, ".into()
            }
        };
        lines.push(format!("    {name}_{}(q, {argument}{});", f.name, f.result));
        lines.push(String::new());
        lines
    }

    /// `, const ur5_parameters *parameters` if the function reads any.
    fn parameters(&self, f: &Function) -> String {
        if f.parameters(self.library).is_empty() {
            return String::new();
        }
        format!(", const {}_parameters *parameters", self.name)
    }

    fn signature(&self, f: &Function, prefix: &str) -> String {
        let (name, real) = (&self.name, self.real());
        let shape: String = f.shape().iter().map(|n| format!("[{n}]")).collect();
        let head = format!("{prefix}void {name}_{}(", f.name);
        let arguments = format!(
            "const {real} q[{}]{}, {real} {}{shape})",
            self.library.variables.len().max(1),
            self.parameters(f),
            f.result
        );
        call(&head, &arguments)
    }

    fn block_signature(&self, f: &Function, prefix: &str, restrict: &str) -> String {
        let (name, real) = (&self.name, self.real());
        let head = format!("{prefix}void {name}_{}_block(", f.name);
        let (parameters, result) = (self.parameters(f), &f.result);
        call(&head, &format!("const {real} *{restrict}q{parameters}, {real} *{restrict}{result})"))
    }

    fn body(&self) -> String {
        let (name, upper) = (&self.name, self.upper());
        let mut text =
            block_comment(self.lines().chain(["", &format!("How to call and compile: see {name}.h.")]));
        let _ = write!(
            text,
            "#include \"{name}.h\"\n\n#include <math.h>\n#include <stdint.h>\n#include <string.h>\n\n"
        );
        text.push_str(&include_str!("macros.c").replace("@NAME@", &upper));
        text.push_str(&self.routines());
        if let Some(values) = defaults(self.library) {
            let values: Vec<String> = values.into_iter().map(|x| self.number(x)).collect();
            let _ = write!(text, "\nconst {name}_parameters {name}_defaults = {{\n");
            text.push_str(&lines(&WRAP.list(&values, 4)));
            text.push_str("};\n");
        }
        for f in &self.functions {
            text.push_str(&self.one(f));
            text.push_str(&self.block(f));
        }
        text + &self.solvers() + &self.attached(|a| &a.definitions)
    }

    /// The routines for sines, cosines, angles and signs, as far as something calls them.
    fn routines(&self) -> String {
        let mut text = String::new();
        let single = self.library.precision == Precision::Single;
        let either = |of_double, of_single| if single { of_single } else { of_double };
        let pairs = Function::any_pair(&self.functions) || !single && Plan::any_pair(&self.plans);
        let atan2 = Function::any_atan2(&self.functions) || !single && Plan::any_atan2(&self.plans);
        if pairs || atan2 || !self.library.attachments.is_empty() {
            let fma = if single { "fmaf" } else { "fma" };
            text.push_str(&include_str!("class.c").replace("@NAME@", &self.upper()).replace("@FMA@", fma));
        }
        if pairs {
            text.push_str(either(include_str!("sine_cosine_double.c"), include_str!("sine_cosine_single.c")));
            text.push_str(&self.in_precision(include_str!("sine_cosine.c")));
        }
        if Function::any_eight(&self.functions) {
            text.push_str(&self.in_precision(include_str!("eight.c")));
        }
        if atan2 {
            text.push_str(either(include_str!("atan2_double.c"), include_str!("atan2_single.c")));
        }
        if Function::any_sign(&self.functions) {
            text.push_str(&self.in_precision(include_str!("sign.c")));
        }
        text
    }

    /// A text of all attachments.
    fn attached(&self, text: fn(&Attachment) -> &str) -> String {
        let of_functions =
            || self.functions.iter().map(|f| (f.name.as_str(), f.parameters(self.library).is_empty()));
        let of_solvers =
            || self.plans.iter().map(|p| (p.name.as_str(), p.parameters(self.library).is_empty()));
        let texts = self.library.attachments.iter().map(|a| Attachment::named(text(a), &self.name));
        let called = texts.map(|text| Attachment::called(text, of_functions().chain(of_solvers())));
        called.map(|text| Attachment::with_results(text, &self.plans)).collect()
    }

    fn one(&self, f: &Function) -> String {
        let real = self.real();
        let mut out = Body { text: format!("\n{}\n{{\n", self.signature(f, "CLONES ")), indent: 4 };
        let variables = f.variables(self.library);
        if variables.is_empty() {
            out.line("(void)q;");
        }
        self.open_parameters(f, &mut out);
        for (k, symbol) in variables {
            out.line(&format!("const {real} {} = q[{k}];", f.names.of(symbol)));
        }
        out.blank();
        let mut names = f.names.clone();
        for step in &for_one(f) {
            match step {
                Step::Pairs(pairs) => {
                    for run in Function::runs(pairs) {
                        if run.len() > 1 {
                            self.eight(f, run, &mut names, &mut out);
                        } else {
                            self.pair(f, "sine_cosine", &run[0], &mut names, &mut out);
                        }
                    }
                    out.blank();
                }
                Step::Atan2 { name, y, x } => {
                    let spelling = self.spelling(f);
                    let formula = format!("any_atan2({}, {})", spelling.formula(*y), spelling.formula(*x));
                    out.statement(&format!("const {real} {} =", f.of(name)), &formula);
                }
                Step::Result { place, value } => {
                    let index: String = f.indices(*place).iter().map(|i| format!("[{i}]")).collect();
                    out.statement(&format!("{}{index} =", f.result), &self.spelling(f).formula(*value));
                }
                Step::Break => out.blank(),
                Step::Let { name, value } => self.value(f, name, *value, &mut out),
            }
        }
        out.text + "}\n"
    }

    fn block(&self, f: &Function) -> String {
        let (upper, real) = (self.upper(), self.real());
        let mut text = String::new();
        if f.has_range() {
            text = self.rare_block(f);
        }
        let signature = self.block_signature(f, "CLONES ", "RESTRICT ");
        let mut out = Body { text: text + &format!("\n{signature}\n{{\n"), indent: 4 };
        let variables = f.variables(self.library);
        if variables.is_empty() {
            out.line("(void)q;");
        }
        self.open_parameters(f, &mut out);
        let mut names = f.names.clone();
        for step in &f.hoisted {
            match step {
                Step::Pairs(pairs) => {
                    pairs.iter().for_each(|p| self.pair(f, "sine_cosine", p, &mut names, &mut out));
                }
                Step::Atan2 { name, y, x } => {
                    let spelling = self.spelling(f);
                    let formula = format!("any_atan2({}, {})", spelling.formula(*y), spelling.formula(*x));
                    out.statement(&format!("const {real} {} =", f.of(name)), &formula);
                }
                Step::Let { name, value } => self.value(f, name, *value, &mut out),
                Step::Break | Step::Result { .. } => {}
            }
        }
        if f.has_range() {
            let is_wide = self.library.precision == Precision::Double && is_large(f);
            out.line(if is_wide { "int64_t in_range = 1;" } else { "int in_range = 1;" });
        }
        out.line(&format!("for (int i = 0; i < {upper}_LANES; i++) {{"));
        out.indent = 8;
        for (k, symbol) in variables {
            out.line(&format!("const {real} {} = q[{}];", f.names.of(symbol), self.lane(k, "i")));
        }
        out.blank();
        for step in &for_blocks(f) {
            match step {
                Step::Pairs(pairs) => {
                    for p in pairs {
                        self.pair(f, "in_range &= near_sine_cosine", p, &mut names, &mut out);
                    }
                    out.blank();
                }
                Step::Atan2 { name, y, x } => {
                    let (name, spelling) = (f.of(name), self.spelling(f));
                    out.line(&format!("{real} {name};"));
                    let (y, x) = (spelling.formula(*y), spelling.formula(*x));
                    out.statement("in_range &=", &format!("near_atan2({y}, {x}, &{name})"));
                }
                Step::Result { place, value } => {
                    let head = format!("{}[{}] =", f.result, self.lane(*place, "i"));
                    out.statement(&head, &self.spelling(f).formula(*value));
                }
                Step::Break => out.blank(),
                Step::Let { name, value } => self.value(f, name, *value, &mut out),
            }
        }
        out.indent = 4;
        out.line("}");
        if f.has_range() {
            out.line("if (!in_range) {");
            let parameters = if self.parameters(f).is_empty() { "" } else { ", parameters" };
            out.line(&format!("    {}_one_by_one(q{parameters}, {});", f.name, f.result));
            out.line("}");
        }
        out.text + "}\n"
    }

    /// The block without vector code.
    fn rare_block(&self, f: &Function) -> String {
        let (name, upper, real) = (&self.name, self.upper(), self.real());
        let variables = self.library.variables.len().max(1);
        let arguments = format!("const {real} *q{}, {real} *{})", self.parameters(f), f.result);
        let head = call(&format!("static NOINLINE void {}_one_by_one(", f.name), &arguments);
        let parameters = if self.parameters(f).is_empty() { "" } else { "parameters, " };
        let shape: String = f.shape().iter().map(|n| format!("[{n}]")).collect();
        let first = "[0]".repeat(f.shape().len() - 1);
        format!(
            "\n/* A block with an angle that is huge, infinite or not a number. */\n{head}\n{{\n\
             {i}for (int i = 0; i < {upper}_LANES; i++) {{\n\
             {i}{i}{real} lane[{variables}];\n\
             {i}{i}{real} one{shape};\n\
             {i}{i}for (int j = 0; j < {variables}; j++) {{\n\
             {i}{i}{i}lane[j] = q[{upper}_LANES * j + i];\n\
             {i}{i}}}\n\
             {i}{i}{name}_{function}(lane, {parameters}one);\n\
             {i}{i}const {real} *values = one{first};\n\
             {i}{i}for (int k = 0; k < {results}; k++) {{\n\
             {i}{i}{i}{result}[{upper}_LANES * k + i] = values[k];\n\
             {i}{i}}}\n\
             {i}}}\n}}\n",
            i = "    ",
            function = f.name,
            results = f.results(),
            result = f.result,
        )
    }

    /// `UR5_LANES * 3 + i`
    fn lane(&self, row: usize, i: &str) -> String {
        match row {
            0 => i.to_string(),
            1 => format!("{}_LANES + {i}", self.upper()),
            _ => format!("{}_LANES * {row} + {i}", self.upper()),
        }
    }

    fn open_parameters(&self, f: &Function, out: &mut Body) {
        for symbol in f.parameters(self.library) {
            let name = f.names.of(symbol);
            out.line(&format!("const {} {name} = parameters->{name};", self.real()));
        }
    }

    fn value(&self, f: &Function, name: &str, value: Expr, out: &mut Body) {
        let formula = self.spelling(f).formula(value);
        out.statement(&format!("const {} {} =", self.real(), f.of(name)), &formula);
    }

    fn pair(&self, f: &Function, call: &str, p: &Pair, names: &mut Names, out: &mut Body) {
        let mut identifier = |name: &Option<String>| match name {
            Some(name) => f.of(name).to_string(),
            None => names.free("unread"),
        };
        let (sine, cosine) = (identifier(&p.sine), identifier(&p.cosine));
        out.line(&format!("{} {sine}, {cosine};", self.real()));
        let angle = self.spelling(f).formula(p.angle);
        let (head, call) = call.rsplit_once(' ').map_or((String::new(), call), |(h, c)| (format!("{h} "), c));
        out.line(&format!("{head}{call}({angle}, &{sine}, &{cosine});"));
    }

    fn eight(&self, f: &Function, run: &[Pair], names: &mut Names, out: &mut Body) {
        let real = self.real();
        let [angles, sines, cosines] = ["angles", "sines", "cosines"].map(|word| names.free(word));
        let formulas: Vec<String> = run.iter().map(|p| self.spelling(f).formula(p.angle)).collect();
        let head = format!("const {real} {angles}[{EIGHT}] = {{");
        out.list(&head, &formulas, "};");
        out.line(&format!("{real} {sines}[{EIGHT}];"));
        out.line(&format!("{real} {cosines}[{EIGHT}];"));
        out.line(&format!("eight_sines_and_cosines({angles}, {sines}, {cosines});"));
        for (k, p) in run.iter().enumerate() {
            for (name, array) in [(&p.sine, &sines), (&p.cosine, &cosines)] {
                if let Some(name) = name {
                    out.line(&format!("const {real} {} = {array}[{k}];", f.of(name)));
                }
            }
        }
    }
}

/// `head` with arguments, on two lines if one is too long.
pub(crate) fn call(head: &str, arguments: &str) -> String {
    if head.len() + arguments.len() < WIDTH {
        return format!("{head}{arguments}");
    }
    // A bracket of arguments goes on under its first; one that is still too long has a line per argument.
    let margin = " ".repeat(head.len().min(WIDTH / 2));
    let separate = arguments.replace(", ", &format!(",\n{margin}"));
    format!("{head}{separate}")
}

/// Lines as one comment that stands alone.
pub(crate) fn block_comment<'a>(text: impl IntoIterator<Item = &'a str>) -> String {
    format!("/*\n{} */\n", lines(&comments(text, " * ", WIDTH)))
}
