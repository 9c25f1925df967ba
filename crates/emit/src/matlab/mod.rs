//! MATLAB, which Octave reads: one file per function, one for the parameters, and a script that tests them.
//!
//! Rows are configurations; matrices come as pages. The comment that opens a file stands behind the function line,
//! where `help` and `lookfor` look for it.

mod attached;
mod solver;

use crate::blocks::{blocks, reads};
use crate::listing::{Listing, Statement};
use crate::names::{Names, no_test, renamed, sanitised};
use crate::solver::{Plan, plans};
use crate::spelling::Spelling;
use crate::wrap::{Wrap, comments};
use crate::{File, Language, Library, Parameter, Precision, Routine};
use denavit_symbolic::{Expr, Symbol};

const WRAP: Wrap = Wrap { width: 100, step: 4, sign_leads: false, goes_on: " ...", brackets: ["", ""] };

/// The longest names of a library, of a function of it, and of results and solvers: `library_function` has at most 63 letters, two of
/// them for a number where others are called so.
const MAX_LIBRARY: usize = 30;
const MAX_FUNCTION: usize = 32;
const MAX_NAME: usize = 20;

/// Names that mean something in the files.
const RESERVED: &str = "\
q p parameters given defaults required names k error double struct isnumeric isreal ismatrix \
isstruct isscalar isfield fieldnames nargin narginchk mat2str class abs all any max strjoin permute \
isempty isequal strcmp numel help run clear value isfinite fprintf";

/// The files: functions, parameters and tests.
pub(crate) fn emit(library: &Library) -> Vec<File> {
    let module = Module::new(library);
    let file =
        |name: &str, lines: Vec<String>| File { path: format!("{name}.m"), text: lines.join("\n") + "\n" };
    let mut files: Vec<File> = library
        .routines
        .iter()
        .zip(&module.functions)
        .map(|(routine, function)| file(function, module.function(routine, function)))
        .collect();
    for (plan, function) in module.plans.iter().zip(&module.solvers) {
        files.push(file(function, module.solver(plan, function)));
    }
    if !library.parameters.is_empty() {
        files.push(file(&module.parameters, module.parameters()));
    }
    files.extend(module.attached());
    files.push(file(&module.test, module.tests()));
    files
}

struct Module<'a> {
    library: &'a Library<'a>,
    name: String,
    functions: Vec<String>,
    plans: Vec<Plan<'a>>,
    /// The functions of the solvers.
    solvers: Vec<String>,
    /// The function that completes the parameters.
    parameters: String,
    test: String,
    /// Names inside a function, inputs included.
    names: Names,
}

impl<'a> Module<'a> {
    fn new(library: &'a Library) -> Self {
        let name = no_test(short(&library.name, MAX_LIBRARY - 2).to_lowercase());
        let mut names = Names::new(Language::Matlab, &RESERVED.split_whitespace().collect::<Vec<_>>());
        let test = names.free(&format!("test_{name}"));
        let parameters = names.free(&format!("{name}_parameters"));
        let mut function = |r: &Routine| names.free(&format!("{name}_{}", short(&r.name, MAX_FUNCTION)));
        let functions: Vec<String> = library.routines.iter().map(&mut function).collect();
        let mut words: Vec<&str> = RESERVED.split_whitespace().filter(|w| *w != "q").collect();
        words.extend(solver::WORDS.split_whitespace());
        let mut locals = Names::new(Language::Matlab, &words);
        library.parameters.iter().for_each(|p| locals.declare(p.symbol));
        let plans = plans(library, Language::Matlab, &locals, &words, &[]);
        let solvers: Vec<String> =
            plans.iter().map(|p| names.free(&format!("{name}_{}", short(&p.name, MAX_NAME)))).collect();
        library.variables.iter().for_each(|(symbol, _)| names.declare(*symbol));
        library.parameters.iter().for_each(|p| names.declare(p.symbol));
        Module { library, name, functions, plans, solvers, parameters, test, names }
    }

    fn name(&self) -> &str {
        &self.name
    }

    /// The function that completes the parameters.
    fn parameters_name(&self) -> &str {
        &self.parameters
    }

    /// The field of a parameter.
    fn field(&self, p: &Parameter) -> &str {
        self.names.of(p.symbol)
    }

    /// What errors of a function are called by.
    fn mnemonic<'f>(&self, function: &'f str) -> &'f str {
        function.strip_prefix(&format!("{}_", self.name)).unwrap_or(function)
    }

    fn spelling<'n>(&self, names: &'n Names) -> Spelling<'n> {
        Spelling { language: Language::Matlab, precision: Precision::Double, names }
    }

    fn numbers(&self, values: &[f64]) -> Vec<String> {
        values.iter().map(|x| self.spelling(&self.names).number(*x)).collect()
    }

    /// The parameters that a routine reads.
    fn parameters_of(&self, routine: &Routine) -> Vec<&Parameter> {
        let read = reads(&Listing::new(routine.program, &mut self.names.clone()));
        self.library.parameters.iter().filter(|p| read.contains(&p.symbol)).collect()
    }

    fn function(&self, routine: &Routine, function: &str) -> Vec<String> {
        let n = self.library.variables.len();
        let mut names = self.names.clone();
        let result = names.free(&short(&routine.result, MAX_NAME));
        let listing = Listing::new(routine.program, &mut names);
        let read = reads(&listing);
        let parameters = self.parameters_of(routine);
        let is_required =
            !parameters.is_empty() && self.library.parameters.iter().any(|p| p.default.is_none());
        let arguments = if parameters.is_empty() { "q" } else { "q, parameters" };
        let mut lines = vec![format!("function {result} = {function}({arguments})")];
        lines.extend(self.about(routine, function, &result, &parameters));
        lines.push(String::new());
        let least = if is_required { 2 } else { 1 };
        lines.push(format!("narginchk({least}, {});", if parameters.is_empty() { 1 } else { 2 }));
        lines.push(format!("if ~isnumeric(q) || ~isreal(q) || ~ismatrix(q) || size(q, 2) ~= {n}"));
        let [component, mnemonic] =
            [&self.name, function.strip_prefix(&format!("{}_", self.name)).unwrap_or(function)];
        lines.push(format!("    error('{component}:{mnemonic}:q', ..."));
        lines.push(format!(
            "        'q must be a real N x {n} matrix, not %s %s.', mat2str(size(q)), class(q));"
        ));
        lines.push("end".into());
        lines.push("q = double(q);".into());
        if !parameters.is_empty() {
            if !is_required {
                lines.extend(["if nargin < 2", "    parameters = struct();", "end"].map(String::from));
            }
            lines.push(format!("parameters = {}(parameters);", self.parameters));
        }
        let used = self.library.variables.iter().enumerate().filter(|(_, v)| read.contains(&v.0));
        let unpacked: Vec<String> =
            used.map(|(k, (symbol, _))| format!("{} = q(:, {});", names.of(*symbol), k + 1)).collect();
        if !unpacked.is_empty() {
            lines.push(String::new());
            lines.extend(unpacked);
        }
        lines.extend(parameters.iter().map(|p| format!("{0} = parameters.{0};", names.of(p.symbol))));
        let blocks = blocks(&listing, &routine.shape, routine.program.variables(), &mut names);
        let spelling = self.spelling(&names);
        if !listing.hoisted.is_empty() {
            lines.push(String::new());
            lines.extend(listing.hoisted.iter().flat_map(|s| statement(s, &spelling)));
        }
        for (k, block) in blocks.iter().enumerate() {
            if k == 0 || !block.statements.is_empty() {
                lines.push(String::new());
            }
            lines.extend(block.statements.iter().flat_map(|s| statement(s, &spelling)));
            lines.push(String::new());
            if k == 0 {
                lines.push(format!("{result} = zeros({});", size(&routine.shape, "size(q, 1)")));
            }
            for (place, value) in block.results.iter().filter(|r| !r.1.is_zero()) {
                let head = format!("{result}({}) =", index(*place, &routine.shape));
                lines.extend(WRAP.statement(&head, &spelling.formula(*value), ";"));
            }
        }
        lines.push("end".into());
        lines.dedup_by(|a, b| a.is_empty() && b.is_empty());
        lines
    }

    /// What `help` shows.
    fn about(
        &self,
        routine: &Routine,
        function: &str,
        result: &str,
        parameters: &[&Parameter],
    ) -> Vec<String> {
        let n = self.library.variables.len();
        let (upper, output) = (function.to_uppercase(), result.to_uppercase());
        let summary = routine.about.first().map_or("", String::as_str);
        let mut lines = comments([format!("{upper}  {summary}").as_str()], "%", WRAP.width);
        let indented = |line: &String| format!("  {line}");
        let rest: Vec<String> = routine.about.iter().skip(1).map(indented).collect();
        lines.extend(comments(rest.iter().map(String::as_str), "% ", WRAP.width));
        lines.push("%".into());
        let mut about = vec![format!(
            "  {output} = {upper}(Q): Q is N x {n}, one configuration a row; {output} is {}.",
            {
                let size = size(&routine.shape, "N");
                size.replace(", ", " x ")
            }
        )];
        for (k, (symbol, what)) in self.library.variables.iter().enumerate() {
            let what = self.names.about(*symbol, what);
            about.push(format!("    Q(:, {})  {}: {what}", k + 1, self.names.of(*symbol)));
        }
        if !parameters.is_empty() {
            about.push(String::new());
            let optional = self.library.parameters.iter().all(|p| p.default.is_some());
            let what = if optional { "fields that are missing have the defaults of" } else { "see" };
            about.push(format!(
                "  {output} = {upper}(Q, PARAMETERS): a struct of values of the symbols; {what} {}.",
                self.parameters.to_uppercase()
            ));
        }
        about.push(String::new());
        about.push("  Example:".into());
        about.extend(self.example(function, result, parameters).iter().map(|line| format!("      {line}")));
        about.push(String::new());
        about.push(format!("  Operations per row of Q: {}.", routine.program.count()));
        lines.extend(comments(about.iter().map(String::as_str), "% ", WRAP.width));
        lines.push("%".into());
        let renamed = renamed(self.library, &self.name);
        let header = self.library.header.iter().chain(&renamed).map(indented);
        let header: Vec<String> = header.collect();
        lines.extend(comments(header.iter().map(String::as_str), "% ", WRAP.width));
        lines
    }

    /// A call, as a comment shows it.
    fn example(&self, function: &str, result: &str, parameters: &[&Parameter]) -> Vec<String> {
        let mut lines = vec![format!("q = zeros(1000, {});", self.library.variables.len())];
        let is_required = self.library.parameters.iter().any(|p| p.default.is_none());
        let given = match parameters.first() {
            Some(p) if !is_required => {
                let value = &self.numbers(&[p.default.unwrap_or(1.0)])[0];
                lines.push(format!("parameters.{} = {value};", self.names.of(p.symbol)));
                ", parameters"
            }
            Some(_) => {
                lines.extend(self.library.parameters.iter().map(|p| {
                    let value = &self.numbers(&[p.default.unwrap_or(1.0)])[0];
                    format!("parameters.{} = {value};", self.names.of(p.symbol))
                }));
                ", parameters"
            }
            None => "",
        };
        lines.push(format!("{result} = {function}(q{given});"));
        lines
    }

    fn parameters(&self) -> Vec<String> {
        let name = &self.parameters;
        let upper = name.to_uppercase();
        let list = &self.library.parameters;
        let mut lines = vec![format!("function parameters = {name}(given)")];
        lines.extend(comments(
            [format!("{upper}  Values of the symbols in the formulas.").as_str()],
            "%",
            WRAP.width,
        ));
        let is_required = list.iter().any(|p| p.default.is_none());
        let mut about = vec![];
        if !is_required {
            about.push(format!("  PARAMETERS = {upper}() is a struct of the defaults."));
        }
        about.push(format!(
            "  PARAMETERS = {upper}(GIVEN) has the values of the struct GIVEN in their place."
        ));
        about.push(String::new());
        for p in list {
            let what = match p.default {
                Some(x) => format!("default {}", self.numbers(&[x])[0]),
                None => "required".into(),
            };
            let about_it = self.names.about(p.symbol, &p.about);
            about.push(format!("    {}: {about_it} ({what})", self.names.of(p.symbol)));
        }
        about.push(String::new());
        about.extend(self.library.header.iter().map(|line| format!("  {line}")));
        lines.extend(comments(about.iter().map(String::as_str), "% ", WRAP.width));
        lines.push(String::new());
        lines.push(format!("narginchk({}, 1);", u8::from(is_required)));
        if !is_required {
            lines.extend(["if nargin < 1", "    given = struct();", "end"].map(String::from));
        }
        lines.push("if ~isstruct(given) || ~isscalar(given)".into());
        lines.push(format!("    error('{}:parameters:type', 'parameters must be a struct.');", self.name));
        lines.push("end".into());
        lines.push(String::new());
        lines.push("parameters = struct();".into());
        for p in list.iter() {
            if let Some(x) = p.default {
                lines.push(format!("parameters.{} = {};", self.names.of(p.symbol), self.numbers(&[x])[0]));
            }
        }
        let names: Vec<String> = list.iter().map(|p| format!("'{}'", self.names.of(p.symbol))).collect();
        let whole = format!("known = {{{}}};", names.join(", "));
        if whole.len() <= WRAP.width {
            lines.push(whole);
        } else {
            lines.push("known = { ...".into());
            lines.extend(WRAP.list(&names, 4).into_iter().map(|line| line + " ..."));
            lines.push("};".into());
        }
        let text = r"
names = fieldnames(given);
for k = 1:numel(names)
    if ~any(strcmp(names{k}, known))
        error('NAME:parameters:unknown', 'there is no parameter %s.', names{k});
    end
    value = given.(names{k});
    if ~isnumeric(value) || ~isreal(value) || ~isscalar(value) || ~isfinite(value)
        error('NAME:parameters:value', ...
            'parameter %s must be a finite real number, not a %s.', names{k}, class(value));
    end
    parameters.(names{k}) = double(value);
end
";
        lines.extend(text.replace("NAME", &self.name).trim_end().lines().skip(1).map(str::to_string));
        if is_required {
            let text = r"for k = 1:numel(known)
    if ~isfield(parameters, known{k})
        error('NAME:parameters:missing', ...
            'parameter %s is missing: it has no default.', known{k});
    end
end";
            lines.extend(text.replace("NAME", &self.name).lines().map(str::to_string));
        }
        lines.push("end".into());
        lines
    }
}

/// An identifier of bounded length.
fn short(name: &str, length: usize) -> String {
    let name = sanitised(name);
    name[..name.len().min(length)].trim_end_matches('_').to_string()
}

fn statement(statement: &Statement, spelling: &Spelling) -> Vec<String> {
    let one = |name: &str, value: Expr| {
        let head = format!("{} =", spelling.names.of(Symbol::new(name)));
        WRAP.statement(&head, &spelling.formula(value), ";")
    };
    match statement {
        Statement::Let { name, value } => one(name, *value),
        Statement::Pair { angle, sine, cosine } => {
            let sine = sine.iter().flat_map(|name| one(name, angle.sin()));
            sine.chain(cosine.iter().flat_map(|name| one(name, angle.cos()))).collect()
        }
    }
}

/// The size of the results of `rows` configurations: matrices are pages, numbers and vectors are rows.
fn size(shape: &[usize], rows: &str) -> String {
    match shape {
        [] => format!("{rows}, 1"),
        [m] => format!("{rows}, {m}"),
        [pages @ .., r, c] => {
            let pages: String = pages.iter().rev().map(|k| format!("{k}, ")).collect();
            format!("{r}, {c}, {pages}{rows}")
        }
    }
}

/// Where a result stands.
fn index(place: usize, shape: &[usize]) -> String {
    let (mut rest, mut indices) = (place, vec![]);
    for k in shape.iter().rev() {
        indices.push((rest % k + 1).to_string());
        rest /= k;
    }
    match &indices[..] {
        [] => ":".into(),
        [k] => format!(":, {k}"),
        [c, r, pages @ ..] => {
            let pages: String = pages.iter().map(|k| format!("{k}, ")).collect();
            format!("{r}, {c}, {pages}:")
        }
    }
}

impl Module<'_> {
    fn tests(&self) -> Vec<String> {
        let name = &self.test;
        let mut lines = comments(
            [format!("{}  Test the functions at stored configurations.", name.to_uppercase()).as_str()],
            "%",
            WRAP.width,
        );
        let header: Vec<String> = self.library.header.iter().map(|line| format!("  {line}")).collect();
        lines.push("%   Their results are of an independent source.".into());
        lines.push("%".into());
        lines.extend(comments(header.iter().map(String::as_str), "% ", WRAP.width));
        lines.push(String::new());
        lines.push("% Units in the last place of the size of a result.".into());
        lines.push("tolerance = 4 * 2^-52;".into());
        for (routine, function) in self.library.routines.iter().zip(&self.functions) {
            lines.extend(self.test(routine, function));
        }
        for (plan, function) in self.plans.iter().zip(&self.solvers) {
            lines.extend(self.solver_test(plan, function));
        }
        lines.extend(self.attached_tests().lines().map(String::from));
        if let Some(p) = self.library.parameters.first() {
            let text = r"
% A parameter is a number.
identifier = '';
try
    PARAMETERS(struct('SYMBOL', '1'));
catch err
    identifier = err.identifier;
end
if ~strcmp(identifier, 'NAME:parameters:value')
    error('NAME:test', 'a text is taken for a number.');
end";
            let text = text.replace("PARAMETERS", &self.parameters).replace("NAME", &self.name);
            lines.extend(text.replace("SYMBOL", self.names.of(p.symbol)).lines().map(String::from));
        }
        if self.library.parameters.iter().any(|p| p.default.is_none()) {
            let text = r"
% A parameter without a default is required.
identifier = '';
try
    PARAMETERS(struct());
catch err
    identifier = err.identifier;
end
if ~strcmp(identifier, 'NAME:parameters:missing')
    error('NAME:test', 'a missing parameter is not reported.');
end";
            let text = text.replace("PARAMETERS", &self.parameters).replace("NAME", &self.name);
            lines.extend(text.lines().map(String::from));
        }
        lines.push(String::new());
        lines.push(format!("fprintf('{}: all configurations agree\\n');", self.name));
        lines
    }

    /// A matrix in lines.
    fn matrix(&self, name: &str, rows: &[&[f64]]) -> Vec<String> {
        if rows.iter().all(|row| row.is_empty()) {
            return vec![format!("{name} = zeros({}, 0);", rows.len())];
        }
        let mut lines = vec![format!("{name} = [ ...")];
        for row in rows {
            let own = WRAP.list(&self.numbers(row), 4);
            let last = own.len() - 1;
            lines.extend(
                own.into_iter().enumerate().map(|(k, line)| line + if k < last { " ..." } else { "; ..." }),
            );
        }
        lines.push("];".into());
        lines
    }

    fn test(&self, routine: &Routine, function: &str) -> Vec<String> {
        let n = self.library.variables.len();
        let parameters = self.parameters_of(routine);
        let mut lines = vec![String::new(), format!("% {function}")];
        let column =
            |part: fn(&crate::Vector) -> &[f64]| routine.vectors.iter().map(part).collect::<Vec<_>>();
        lines.extend(self.matrix("q", &column(|v| &v.variables)));
        lines.extend(self.matrix("expected", &column(|v| &v.results)));
        lines.extend(self.matrix("scales", &[&routine.scales]));
        if !parameters.is_empty() {
            lines.extend(self.matrix("values", &column(|v| &v.parameters)));
        }
        lines.push(format!("name = '{function}';"));
        let given = if parameters.is_empty() { "" } else { ", parameters" };
        lines.push("for k = 1:size(q, 1)".into());
        if !parameters.is_empty() {
            for (k, p) in self.library.parameters.iter().enumerate() {
                lines.push(format!("    parameters.{} = values(k, {});", self.names.of(p.symbol), k + 1));
            }
        }
        for (what, argument, own) in [("one row", "q(k, :)", "1"), ("all rows", "q", "k")] {
            lines.push(format!("    results = {function}({argument}{given});"));
            if let d @ 2.. = routine.shape.len() {
                let rest: String = (3..=d + 1).map(|k| format!(", {k}")).collect();
                let m = routine.program.outputs().len();
                lines.push(format!("    results = reshape(permute(results, [2, 1{rest}]), {m}, []).';"));
            }
            lines.push(format!("    worst = max(abs(results({own}, :) - expected(k, :)) ./ scales);"));
            lines.push("    if ~(worst <= tolerance)".into());
            lines.push(format!("        error('{}:test', ...", self.name));
            lines.push(format!("            '%s of {what}: row %d is off by %g.', name, k, worst);"));
            lines.push("    end".into());
        }
        lines.push("end".into());
        let failed = |what: &str| format!("    error('{}:test', '%s {what}.', name);", self.name);
        lines.push(format!("if ~isempty({function}(zeros(0, {n}){given}))"));
        lines.push(failed("of no rows is not empty"));
        lines.push("end".into());
        lines.push("identifier = '';".into());
        lines.push("try".into());
        lines.push(format!("    {function}(zeros(1, {}){given});", n + 1));
        lines.push("catch err".into());
        lines.push("    identifier = err.identifier;".into());
        lines.push("end".into());
        let mnemonic = function.strip_prefix(&format!("{}_", self.name)).unwrap_or(function);
        lines.push(format!("if ~strcmp(identifier, '{}:{mnemonic}:q')", self.name));
        lines.push(failed("takes a row of another length"));
        lines.push("end".into());
        if !parameters.is_empty() {
            lines.push("clear parameters".into());
        }
        lines
    }
}
