//! Python: a module over NumPy arrays, its tests, and the project file that installs it.
//!
//! Functions take arrays of any leading shape: every operation is one on whole arrays.

mod attached;
mod solver;
mod test;

use crate::blocks::{blocks, reads};
use crate::listing::{Listing, Statement};
use crate::names::{Names, brief, comment, no_test, renamed, sanitised};
use crate::solver::{Plan, plans};
use crate::spelling::Spelling;
use crate::wrap::{Wrap, comments, prose};
use crate::{File, Language, Library, Parameter, Precision, Routine};
use denavit_symbolic::{Expr, Symbol};
use rustc_hash::FxHashSet;
use std::collections::BTreeSet;

/// PEP 8 as formatters have it.
const WRAP: Wrap = Wrap { width: 88, step: 4, sign_leads: true, goes_on: "", brackets: ["(", ")"] };

/// Names that mean something in the module; functions of Python itself, and letters that look like digits.
const RESERVED: &str = "\
q parameters Parameters DEFAULTS dataclass ArrayLike NDArray l O I abs all any bin bool chr dict dir \
exec eval filter float format hash help hex id input int iter len list map max min next object oct \
open ord pow print range repr round self set slice sorted str sum super tuple vars zip ValueError \
property bytes complex callable isinstance TypeError __all__";

/// Modules that a file of that name would stand in front of.
const MODULES: &str = "\
abc argparse array ast asyncio atexit base64 binascii bisect builtins bz2 calendar cmath cmd code \
codecs collections contextlib contextvars copy copyreg csv ctypes dataclasses datetime decimal \
difflib dis email encodings enum errno faulthandler fnmatch fractions functools gc genericpath \
getpass gettext glob gzip hashlib heapq hmac html http importlib inspect io ipaddress itertools json \
keyword linecache locale logging lzma marshal math mmap multiprocessing ntpath numbers numpy opcode \
operator os pathlib pdb pickle pip pkgutil platform posix posixpath pprint profile pydoc queue \
quopri random re reprlib resource runpy secrets select selectors setuptools shlex shutil signal site \
sitecustomize socket sqlite3 sre_compile sre_constants sre_parse ssl stat statistics string \
stringprep struct subprocess symtable sys sysconfig tarfile tempfile test tests textwrap threading \
time timeit token tokenize trace traceback tracemalloc types typing unicodedata unittest urllib \
usercustomize uuid warnings weakref xml zipfile zipimport zlib";

/// The longest name of a function.
const MAX_FUNCTION: usize = 30;

/// The files: the module, its tests and the project.
pub(crate) fn emit(library: &Library) -> Vec<File> {
    let module = Module::new(library);
    let file = |path: String, lines: Vec<String>| File { path, text: lines.join("\n") + "\n" };
    vec![
        file(format!("{}.py", module.name), module.source()),
        file(format!("test_{}.py", module.name), module.tests()),
        file("pyproject.toml".into(), module.project()),
    ]
}

struct Module<'a> {
    library: &'a Library<'a>,
    name: String,
    plans: Vec<Plan<'a>>,
    /// The functions, in the order of the routines.
    functions: Vec<String>,
    /// Names of the module, inputs included.
    names: Names,
}

impl<'a> Module<'a> {
    fn new(library: &'a Library) -> Self {
        let words: Vec<&str> = RESERVED.split_whitespace().chain(MODULES.split_whitespace()).collect();
        let mut modules = Names::new(Language::Python, &words);
        let name = modules.free(&no_test(sanitised(&library.name).to_lowercase()));
        let mut names = Names::new(Language::Python, &RESERVED.split_whitespace().collect::<Vec<_>>());
        let mut function = |routine: &Routine| {
            let name = sanitised(&routine.name);
            names.free(name[..name.len().min(MAX_FUNCTION)].trim_end_matches('_'))
        };
        let functions: Vec<String> = library.routines.iter().map(&mut function).collect();
        let words: Vec<&str> = RESERVED
            .split_whitespace()
            .filter(|w| *w != "q")
            .chain(solver::WORDS.split_whitespace())
            .collect();
        let locals: Vec<&str> = words.iter().copied().chain(functions.iter().map(String::as_str)).collect();
        let mut locals = Names::new(Language::Python, &locals);
        library.parameters.iter().for_each(|p| locals.declare(p.symbol));
        let plans = plans(library, Language::Python, &locals, &words, &functions);
        library.variables.iter().for_each(|(symbol, _)| names.declare(*symbol));
        library.parameters.iter().for_each(|p| names.declare(p.symbol));
        Module { library, name, plans, functions, names }
    }

    fn module(&self) -> &str {
        &self.name
    }

    fn header(&self) -> Vec<String> {
        Self::head(&self.library.header)
    }

    fn head(lines: &[String]) -> Vec<String> {
        // An interpreter takes `coding: name` in the first lines for the encoding of the file.
        let plain =
            |line: &String| comment(line).replace("coding:", "coding :").replace("coding=", "coding =");
        let lines: Vec<String> = lines.iter().map(plain).collect();
        comments(lines.iter().map(String::as_str), "# ", WRAP.width)
    }

    /// A call of the first function, for people and for `doctest`.
    fn example(&self) -> Vec<String> {
        let (Some(function), Some(routine)) = (self.functions.first(), self.library.routines.first()) else {
            return vec![];
        };
        let n = self.library.variables.len();
        let mut lines = vec!["Examples".to_string(), "--------".into()];
        lines.push(">>> import numpy as np".into());
        // A call must fit into a line.
        let is_long = self.name.len() > MAX_FUNCTION;
        let name = if is_long { "formulas" } else { &self.name };
        lines.push(format!(">>> import {}{}", self.name, if is_long { " as formulas" } else { "" }));
        let given = if self.is_parametric(routine) && !self.has_defaults() {
            let one = |p: &Parameter| {
                let value = float(&self.number(p.default.unwrap_or(1.0)));
                format!("...     {}={value},", self.names.of(p.symbol))
            };
            lines.push(format!(">>> parameters = {name}.Parameters("));
            lines.extend(self.library.parameters.iter().map(one));
            lines.push("... )".into());
            ", parameters"
        } else {
            ""
        };
        lines.push(format!(">>> {name}.{function}(np.zeros({n}){given}).shape"));
        let shape = |leading: &[usize]| {
            let all: Vec<String> = leading.iter().chain(&routine.shape).map(usize::to_string).collect();
            format!("({}{})", all.join(", "), if all.len() == 1 { "," } else { "" })
        };
        lines.push(shape(&[]));
        lines.push(format!(">>> {name}.{function}(np.zeros((1000, {n})){given}).shape"));
        lines.push(shape(&[1000]));
        lines
    }

    fn spelling<'n>(&self, names: &'n Names) -> Spelling<'n> {
        Spelling { language: Language::Python, precision: Precision::Double, names }
    }

    fn number(&self, x: f64) -> String {
        self.spelling(&self.names).number(x)
    }

    fn numbers(&self, values: &[f64]) -> Vec<String> {
        values.iter().map(|x| self.number(*x)).collect()
    }

    fn source(&self) -> Vec<String> {
        let library = self.library;
        let has_parameters = !library.parameters.is_empty();
        let mut lines = self.header();
        let title = format!("{}: formulas over NumPy arrays.", library.title);
        let mut about = vec![title.replace(">>>", "> > >"), String::new()];
        about.extend(renamed(library, &self.name).into_iter().flat_map(|line| [line, String::new()]));
        about.extend(self.example());
        while about.last().is_some_and(String::is_empty) {
            about.pop();
        }
        lines.extend(documentation(&about, 0));
        lines.push(String::new());
        let mut imports: BTreeSet<&str> = self.imports().collect();
        imports.extend(has_parameters.then_some("from dataclasses import dataclass"));
        imports.extend((!self.plans.is_empty()).then_some("from typing import NamedTuple"));
        lines.extend(imports.iter().map(|line| line.to_string()));
        if !imports.is_empty() {
            lines.push(String::new());
        }
        let arrays = if self.functions.is_empty() { "" } else { ", NDArray" };
        lines.push("import numpy as np".into());
        lines.extend([format!("from numpy.typing import ArrayLike{arrays}"), String::new()]);
        let constants: &[&str] = match (has_parameters, self.has_defaults()) {
            (false, _) => &[],
            (true, false) => &["Parameters"],
            (true, true) => &["DEFAULTS", "Parameters"],
        };
        let labels: Vec<String> = self.plans.iter().map(solver::labels).collect();
        let classes: Vec<String> = self.plans.iter().map(solver::class).collect();
        let constants = constants.iter().copied().chain(labels.iter().chain(&classes).map(String::as_str));
        let solvers = self.plans.iter().map(|p| p.name.as_str());
        let attached = self.attached();
        let others = attached::public(&attached);
        let public = constants.chain(self.functions.iter().map(String::as_str)).chain(solvers).chain(others);
        let public: Vec<String> = public.map(|name| format!("\"{name}\"")).collect();
        let all = format!("__all__ = [{}]", public.join(", "));
        if all.len() <= WRAP.width {
            lines.push(all);
        } else {
            lines.push("__all__ = [".into());
            lines.extend(public.iter().map(|name| format!("    {name},")));
            lines.push("]".into());
        }
        if has_parameters {
            lines.extend(self.parameters());
        }
        for (routine, function) in library.routines.iter().zip(&self.functions) {
            lines.extend([String::new(), String::new()]);
            lines.extend(self.function(routine, function));
        }
        lines.extend(self.solvers());
        lines.extend(attached.lines().map(String::from));
        lines
    }

    fn has_defaults(&self) -> bool {
        !self.library.parameters.is_empty() && self.library.parameters.iter().all(|p| p.default.is_some())
    }

    /// The class of the parameters.
    fn parameters(&self) -> Vec<String> {
        let mut about = vec!["Values of the symbols in the formulas.".into(), String::new()];
        about.extend(["Attributes".into(), "----------".into()]);
        for p in &self.library.parameters {
            about.push(format!("{} : float", self.names.of(p.symbol)));
            about.push(format!("    {}", capitalised(&self.names.about(p.symbol, &p.about))));
        }
        let mut lines: Vec<String> =
            ["", "", "@dataclass(frozen=True, kw_only=True)", "class Parameters:"].map(String::from).to_vec();
        lines.extend(documentation(&about, 4));
        lines.push(String::new());
        for p in &self.library.parameters {
            let default = p.default.map_or(String::new(), |x| format!(" = {}", float(&self.number(x))));
            lines.push(format!("    {}: float{default}", self.names.of(p.symbol)));
        }
        if self.has_defaults() {
            lines.extend(["", "", "DEFAULTS = Parameters()"].map(String::from));
        }
        lines
    }

    fn function(&self, routine: &Routine, function: &str) -> Vec<String> {
        let mut names = self.names.clone();
        let result = sanitised(&routine.result);
        let is_function = self.functions.contains(&result);
        let result = names.free(if is_function { "result" } else { &result });
        let listing = Listing::new(routine.program, &mut names);
        let read = reads(&listing);
        let parameters: Vec<Symbol> = self.parameters_of(&read);
        let n = self.library.variables.len();
        let shape = routine.shape.iter().map(|k| k.to_string()).collect::<Vec<_>>().join(", ");

        let parameter = match (parameters.is_empty(), self.has_defaults()) {
            (true, _) => "",
            (false, true) => ", parameters: Parameters = DEFAULTS",
            (false, false) => ", parameters: Parameters",
        };
        let whole = format!("def {function}(q: ArrayLike{parameter}) -> NDArray[np.float64]:");
        let mut lines = if whole.len() <= WRAP.width {
            vec![whole]
        } else {
            let arguments = format!("q: ArrayLike{parameter}");
            let mut lines = vec![format!("def {function}(")];
            lines.extend(arguments.split(", ").map(|a| format!("    {a},")));
            lines.push(") -> NDArray[np.float64]:".into());
            lines
        };
        lines.extend(self.about(routine, &result, !parameters.is_empty()));
        if !parameters.is_empty() {
            lines.push("    if not isinstance(parameters, Parameters):".into());
            lines.push("        kind = type(parameters).__name__".into());
            lines.push("        raise TypeError(f\"parameters must be Parameters(...), not {kind}\")".into());
        }
        lines.push("    q = np.asarray(q, dtype=np.float64)".into());
        lines.push(format!("    if q.shape[-1:] != ({n},):"));
        let message = format!("raise ValueError(f\"q must have the shape (..., {n}), not {{q.shape}}\")");
        lines.push(format!("        {message}"));
        lines.extend(self.unpacked(&read, &names));
        for symbol in parameters {
            let name = names.of(symbol);
            lines.extend(WRAP.statement(&format!("    {name} ="), &format!("parameters.{name}"), ""));
        }
        let blocks = blocks(&listing, &routine.shape, routine.program.variables(), &mut names);
        let spelling = self.spelling(&names);
        if !listing.hoisted.is_empty() {
            lines.push(String::new());
            lines.extend(listing.hoisted.iter().flat_map(|s| statement(s, 4, &spelling)));
        }
        let whole = if shape.is_empty() {
            "q.shape[:-1]".into()
        } else {
            format!("q.shape[:-1] + ({shape}{})", if routine.shape.len() == 1 { "," } else { "" })
        };
        let has_zeros = blocks.iter().flat_map(|b| &b.results).any(|r| r.1.is_zero());
        let new = if has_zeros { "zeros" } else { "empty" };
        for (k, block) in blocks.iter().enumerate() {
            if k == 0 || !block.statements.is_empty() {
                lines.push(String::new());
            }
            // Up to the last sine or cosine of the first results.
            let is_pair = |s: &Statement| matches!(s, Statement::Pair { .. });
            let pairs = block.statements.iter().rposition(is_pair).filter(|_| k == 0).map_or(0, |p| p + 1);
            let (sines, rest) = block.statements.split_at(pairs);
            if pairs > 0 {
                lines.push("    with np.errstate(invalid=\"ignore\"):  # infinite angles give NaN".into());
                lines.extend(sines.iter().flat_map(|s| statement(s, 8, &spelling)));
                if !rest.is_empty() {
                    lines.push(String::new());
                }
            }
            lines.extend(rest.iter().flat_map(|s| statement(s, 4, &spelling)));
            lines.push(String::new());
            if k == 0 {
                lines.extend(WRAP.statement(&format!("    {result} ="), &format!("np.{new}({whole})"), ""));
            }
            for (place, value) in block.results.iter().filter(|r| !r.1.is_zero()) {
                let head = format!("    {result}[{}] =", index(*place, &routine.shape));
                lines.extend(WRAP.statement(&head, &spelling.formula(*value), ""));
            }
        }
        lines.push(format!("    return {result}"));
        lines.dedup_by(|a, b| a.is_empty() && b.is_empty());
        lines
    }

    /// The parameters that a function reads.
    fn parameters_of(&self, read: &FxHashSet<Symbol>) -> Vec<Symbol> {
        self.library.parameters.iter().map(|p| p.symbol).filter(|s| read.contains(s)).collect()
    }

    fn about(&self, routine: &Routine, result: &str, has_parameters: bool) -> Vec<String> {
        let n = self.library.variables.len();
        let shape: String = routine.shape.iter().map(|k| format!(", {k}")).collect();
        let mut about: Vec<String> = vec![];
        for (k, line) in routine.about.iter().enumerate() {
            about.push(line.clone());
            if k == 0 && routine.about.len() > 1 {
                about.push(String::new());
            }
        }
        let section = |title: &str| [String::new(), title.into(), "-".repeat(title.len())];
        about.extend(section("Parameters"));
        about.push(format!("q : array_like, shape (..., {n})"));
        for (symbol, what) in &self.library.variables {
            let what = self.names.about(*symbol, what);
            about.push(format!("    {}: {what}", self.names.of(*symbol)));
        }
        if has_parameters {
            let optional = if self.has_defaults() { ", optional" } else { "" };
            about.push(format!("parameters : Parameters{optional}"));
            about.push("    Values of the symbols in the formulas.".into());
        }
        about.extend(section("Returns"));
        about.push(format!("{result} : numpy.ndarray of float64, shape (...{shape})"));
        about.push("    For each row of `q`.".into());
        about.extend(section("Raises"));
        about.push("ValueError".into());
        about.push(format!("    If the last axis of `q` does not have the length {n}."));
        if has_parameters {
            about.push("TypeError".into());
            about.push("    If `parameters` is no `Parameters`.".into());
        }
        about.extend(section("Notes"));
        about.push(format!("Operations per row of `q`: {}.", routine.program.count()));
        documentation(&about, 4)
    }

    /// The variables that a function reads.
    fn unpacked(&self, read: &FxHashSet<Symbol>, names: &Names) -> Vec<String> {
        let variables = &self.library.variables;
        let list: Vec<&str> = variables.iter().map(|(symbol, _)| names.of(*symbol)).collect();
        let all = format!("    {} = np.moveaxis(q, -1, 0)", list.join(", "));
        if list.len() > 1 && variables.iter().all(|(s, _)| read.contains(s)) && all.len() <= WRAP.width {
            return vec![all];
        }
        let used = variables.iter().enumerate().filter(|(_, (symbol, _))| read.contains(symbol));
        used.map(|(k, (symbol, _))| format!("    {} = q[..., {k}]", names.of(*symbol))).collect()
    }
}

/// A statement inside a function.
fn statement(statement: &Statement, indent: usize, spelling: &Spelling) -> Vec<String> {
    let margin = " ".repeat(indent);
    let named = |name: &String| spelling.names.of(Symbol::new(name)).to_string();
    match statement {
        Statement::Let { name, value } => {
            WRAP.statement(&format!("{margin}{} =", named(name)), &spelling.formula(*value), "")
        }
        Statement::Pair { angle, sine, cosine } => {
            let one = |name: &Option<String>, function: fn(Expr) -> Expr| {
                name.as_ref().map(|name| (named(name), spelling.formula(function(*angle))))
            };
            let list: Vec<(String, String)> =
                [one(sine, Expr::sin), one(cosine, Expr::cos)].into_iter().flatten().collect();
            let all =
                |part: fn(&(String, String)) -> &str| list.iter().map(part).collect::<Vec<_>>().join(", ");
            let whole = format!("{margin}{} = {}", all(|p| &p.0), all(|p| &p.1));
            if whole.len() <= WRAP.width {
                return vec![whole];
            }
            list.iter()
                .flat_map(|(name, value)| WRAP.statement(&format!("{margin}{name} ="), value, ""))
                .collect()
        }
    }
}

/// The index of a result in an array with leading axes.
fn index(place: usize, shape: &[usize]) -> String {
    let (mut rest, mut parts) = (place, vec![]);
    for k in shape.iter().rev() {
        parts.push(format!(", {}", rest % k));
        rest /= k;
    }
    parts.reverse();
    format!("...{}", parts.concat())
}

/// A documentation string in lines.
fn documentation(about: &[String], indent: usize) -> Vec<String> {
    let margin = " ".repeat(indent);
    let room = WRAP.width - indent;
    let plain = |line: &String| comment(line).replace('"', "'");
    if let [line] = about {
        let line = plain(line);
        if line.chars().count() + 6 <= room {
            return vec![format!("{margin}\"\"\"{line}\"\"\"")];
        }
    }
    let mut lines: Vec<String> = about
        .iter()
        .map(plain)
        .flat_map(|line| prose(&line, room - 3))
        .map(|line| format!("{margin}{line}"))
        .collect();
    if let Some(first) = lines.first_mut() {
        *first = format!("{margin}\"\"\"{}", first.trim_start());
    }
    lines.push(format!("{margin}\"\"\""));
    lines.iter().map(|line| line.trim_end().to_string()).collect()
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// A number with a point, for what is a `float`.
fn float(number: &str) -> String {
    if number.contains(['.', 'e']) { number.into() } else { format!("{number}.0") }
}

impl Module<'_> {
    /// The parameters that a routine reads.
    fn is_parametric(&self, routine: &Routine) -> bool {
        !self.parameters_of(&reads(&Listing::new(routine.program, &mut self.names.clone()))).is_empty()
    }

    fn project(&self) -> Vec<String> {
        let mut lines = Self::head(&brief(self.library, &format!("{}.py", self.name)));
        let title = comment(&self.library.title).replace('"', "'");
        lines.extend([
            String::new(),
            "[build-system]".into(),
            "requires = [\"setuptools>=61\"]".into(),
            "build-backend = \"setuptools.build_meta\"".into(),
            String::new(),
            "[project]".into(),
            format!("name = \"{}\"", self.name.replace('_', "-")),
            "version = \"1.0.0\"".into(),
            format!("description = \"{title}\""),
            "requires-python = \">=3.10\"".into(),
            "dependencies = [\"numpy>=1.22\"]".into(),
            String::new(),
            "[tool.setuptools]".into(),
            format!("py-modules = [\"{}\"]", self.name),
        ]);
        lines
    }
}
