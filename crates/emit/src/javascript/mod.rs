//! JavaScript: an ES module over typed arrays with types in its comments, its tests, and the package file.
//!
//! Functions write into arrays of the caller's. The formulas stand in one private function per routine, for one row;
//! what depends on parameters alone is computed before and handed to it.

mod attached;
mod solver;
mod test;

use crate::blocks::{Block, blocks, reads};
use crate::listing::{Listing, Statement};
use crate::names::{Names, brief, comment, renamed, sanitised};
use crate::solver::{Plan, plans};
use crate::spelling::Spelling;
use crate::wrap::{Wrap, comments, prose, split};
use crate::{File, Language, Library, Parameter, Precision, Routine};
use denavit_symbolic::{Expr, Symbol};

const WRAP: Wrap = Wrap { width: 100, step: 2, sign_leads: false, goes_on: "", brackets: ["", ""] };

/// Names that mean something in the module.
const RESERVED: &str = "\
q out parameters Parameters DEFAULTS missing i o Object Float64Array RangeError TypeError Number \
Array String ArrayBuffer test assert check TOLERANCE requireNumbers requireParameters";

/// The files: the module, its tests and the package.
pub(crate) fn emit(library: &Library) -> Vec<File> {
    let module = Module::new(library);
    let file = |path: String, lines: Vec<String>| File { path, text: lines.join("\n") + "\n" };
    vec![
        file(format!("{}.js", module.name), module.source()),
        file(format!("{}.test.js", module.name), module.tests()),
        file("package.json".into(), module.package()),
    ]
}

/// The names of one routine's functions.
struct Functions {
    /// One row.
    one: String,
    /// Many rows.
    batch: String,
    /// The formulas, private.
    row: String,
    /// What the tests hold.
    cases: String,
    scales: String,
}

struct Module<'a> {
    library: &'a Library<'a>,
    name: String,
    functions: Vec<Functions>,
    plans: Vec<Plan<'a>>,
    /// Names of the module, inputs included.
    names: Names,
}

impl<'a> Module<'a> {
    fn new(library: &'a Library) -> Self {
        let mut names = Names::new(Language::JavaScript, &RESERVED.split_whitespace().collect::<Vec<_>>());
        let mut functions = vec![];
        for routine in &library.routines {
            let one = names.free(&sanitised(&routine.name));
            let batch = names.free(&format!("{one}Batch"));
            let row = names.free(&format!("{one}Row"));
            let [cases, scales] = ["Cases", "Scales"].map(|what| names.free(&format!("{one}{what}")));
            functions.push(Functions { one, batch, row, cases, scales });
        }
        library.variables.iter().for_each(|(symbol, _)| names.declare(*symbol));
        library.parameters.iter().for_each(|p| names.declare(p.symbol));
        let plans = solver_plans(library, &functions);
        // `node --test` runs what is called like this.
        let name = sanitised(&library.name).to_lowercase();
        let is_test = name == "test" || name.ends_with("_test");
        let name = if is_test { format!("{name}_x") } else { name };
        Module { library, name, functions, plans, names }
    }

    fn header(&self) -> Vec<String> {
        let lines: Vec<String> = self.library.header.iter().map(|line| untagged(line)).collect();
        comments(lines.iter().map(String::as_str), "// ", WRAP.width)
    }

    /// Calls of the first function, as a comment shows them.
    fn example(&self) -> Vec<String> {
        let (Some(f), Some(routine)) = (self.functions.first(), self.library.routines.first()) else {
            return vec![];
        };
        let n = self.library.variables.len();
        let mut lines: Vec<String> = renamed(self.library, &self.name).into_iter().collect();
        lines.extend([String::new(), "Example:".into()]);
        lines.push(format!("    import {{ {}, {} }} from \"./{}.js\";", f.one, f.batch, self.name));
        let parameters = self.parameters_of(routine);
        let value = |p: &&Parameter| {
            format!("{}: {}", self.names.of(p.symbol), self.numbers(&[p.default.unwrap_or(1.0)])[0])
        };
        let is_required = parameters.iter().any(|p| p.default.is_none());
        let given: Vec<String> = match is_required {
            true => parameters.iter().filter(|p| p.default.is_none()).map(value).collect(),
            false => parameters.iter().take(1).map(value).collect(),
        };
        let given = format!(", undefined, {{ {} }}", given.join(", "));
        let given = if parameters.is_empty() { "" } else { &given };
        lines.push(format!("    const result = {}([{}]{given});", f.one, vec!["0"; n].join(", ")));
        lines.push(format!("    const results = {}(new Float64Array({n} * 1000){given});", f.batch));
        lines.iter().map(|line| untagged(line)).collect()
    }

    fn spelling<'n>(&self, names: &'n Names) -> Spelling<'n> {
        Spelling { language: Language::JavaScript, precision: Precision::Double, names }
    }

    fn numbers(&self, values: &[f64]) -> Vec<String> {
        values.iter().map(|x| self.spelling(&self.names).number(*x)).collect()
    }

    /// The parameters that a routine reads.
    fn parameters_of(&self, routine: &Routine) -> Vec<&Parameter> {
        let read = reads(&Listing::new(routine.program, &mut self.names.clone()));
        self.library.parameters.iter().filter(|p| read.contains(&p.symbol)).collect()
    }

    fn source(&self) -> Vec<String> {
        let mut lines = self.header();
        let example = self.example();
        lines.extend(comments(example.iter().map(String::as_str), "// ", WRAP.width));
        if !self.library.parameters.is_empty() {
            lines.push(String::new());
            lines.extend(self.parameters());
        }
        for (routine, functions) in self.library.routines.iter().zip(&self.functions) {
            lines.push(String::new());
            lines.extend(self.routine(routine, functions));
        }
        let is_any_required = |r: &Routine| self.parameters_of(r).iter().any(|p| p.default.is_none());
        let is_required = |p: &Plan| self.parameters_of_solver(p).iter().any(|p| p.default.is_none());
        if self.library.routines.iter().any(is_any_required) || self.plans.iter().any(is_required) {
            lines.push(String::new());
            lines.extend(documentation(&["@param {string} name".into(), "@returns {never}".into()]));
            lines.push("function missing(name) {".into());
            lines.push("  throw new TypeError(`parameter ${name} is missing: it has no default`);".into());
            lines.push("}".into());
        }
        lines.extend(self.solvers());
        lines.extend(self.attached().lines().map(str::to_string));
        lines.extend(REQUIRE_NUMBERS.lines().map(str::to_string));
        if self.library.routines.iter().any(|r| !self.parameters_of(r).is_empty())
            || self.plans.iter().any(|p| !self.parameters_of_solver(p).is_empty())
        {
            let list = &self.library.parameters;
            let known: Vec<String> =
                list.iter().map(|p| format!("\"{}\"", self.names.of(p.symbol))).collect();
            for line in REQUIRE_PARAMETERS.lines() {
                if line.contains("DEFAULTS") && list.iter().all(|p| p.default.is_none()) {
                    lines.push("  if (parameters === undefined) {".into());
                } else if line.contains("KNOWN") {
                    let whole = format!("  const known = [{}];", known.join(", "));
                    if whole.len() <= WRAP.width {
                        lines.push(whole);
                    } else {
                        lines.push("  const known = [".into());
                        lines.extend(known.iter().map(|name| format!("    {name},")));
                        lines.push("  ];".into());
                    }
                } else {
                    lines.push(line.into());
                }
            }
        }
        lines
    }

    /// The type of the parameters and their values.
    fn parameters(&self) -> Vec<String> {
        let mut about = vec!["Values of the symbols in the formulas.".to_string(), String::new()];
        about.push("@typedef {object} Parameters".into());
        for p in &self.library.parameters {
            let name = self.names.of(p.symbol);
            let name = if p.default.is_some() { format!("[{name}]") } else { name.to_string() };
            let what = untagged(&self.names.about(p.symbol, &p.about));
            about.push(format!("@property {{number}} {name} {what}"));
        }
        let mut lines = documentation(&about);
        let defaults: Vec<(&str, f64)> = self
            .library
            .parameters
            .iter()
            .filter_map(|p| p.default.map(|x| (self.names.of(p.symbol), x)))
            .collect();
        if !defaults.is_empty() {
            lines.push(String::new());
            lines.push("/** The parameters where the caller gives none. */".into());
            lines.push("export const DEFAULTS = Object.freeze({".into());
            for (name, x) in defaults {
                lines.push(format!("  {name}: {},", self.spelling(&self.names).number(x)));
            }
            lines.push("});".into());
        }
        lines
    }

    fn routine(&self, routine: &Routine, functions: &Functions) -> Vec<String> {
        let (n, m) = (self.library.variables.len(), routine.program.outputs().len());
        let parameters = self.parameters_of(routine);
        let is_required = parameters.iter().any(|p| p.default.is_none());
        let given = match (parameters.is_empty(), is_required) {
            (true, _) => "",
            (false, true) => ", parameters",
            (false, false) => ", parameters = DEFAULTS",
        };
        let body = Body::new(self, routine);
        let tag = match (parameters.is_empty(), is_required) {
            (true, _) => None,
            (false, true) => Some("@param {Parameters} parameters values of the symbols".to_string()),
            (false, false) => Some(format!("@param {{{}}} [parameters] values of the symbols", self.given())),
        };
        // What stands before a required argument is not optional itself.
        let out = if is_required && !parameters.is_empty() {
            "@param {Float64Array | undefined} out"
        } else {
            "@param {Float64Array} [out]"
        };
        let plain = |lines: &[String]| lines.iter().map(|line| untagged(line)).collect::<Vec<_>>();
        let shape = routine.shape.iter().map(|k| k.to_string()).collect::<Vec<_>>().join(" x ");
        let shape = if routine.shape.len() > 1 { format!("{shape} = {m}") } else { m.to_string() };

        // One row.
        let mut about = plain(&routine.about);
        about.push(String::new());
        about.push(format!("Operations per row: {}.", routine.program.count()));
        about.push(String::new());
        about.push(format!("@param {{ArrayLike<number>}} q {n} values:"));
        for (symbol, what) in &self.library.variables {
            let what = untagged(&self.names.about(*symbol, what));
            about.push(format!("  {}: {what}", self.names.of(*symbol)));
        }
        about.push(format!("{out} where the {shape} results go, row-major"));
        about.extend(tag.clone());
        about.push("@returns {Float64Array} `out`".into());
        about.push("@throws {RangeError} if `q` or `out` has another length".into());
        about.push("@throws {TypeError} if an argument is of another type".into());
        let mut lines = documentation(&about);
        let one = &functions.one;
        let arguments = format!("q, out = new Float64Array({m}){given}");
        lines.extend(call(&format!("export function {one}"), &arguments, " {"));
        lines.extend(required(&parameters));
        for (name, length) in [("q", n), ("out", m)] {
            lines.push(format!("  if ({name}.length !== {length}) {{"));
            lines.push(format!(
                "    throw new RangeError(`{name} must have {length} entries, not ${{{name}.length}}`);"
            ));
            lines.push("  }".into());
        }
        lines.extend(body.opening(&parameters, is_required));
        lines.extend(call(&format!("  {}", functions.row), &body.arguments("q, 0, out, 0"), ";"));
        lines.extend(["  return out;".to_string(), "}".to_string(), String::new()]);

        // Many rows.
        let mut about =
            vec![format!("{one} of many rows, one after another.").replacen(one, &format!("`{one}`"), 1)];
        about.push(String::new());
        about.push(format!("@param {{ArrayLike<number>}} q N x {n} values"));
        about.push(format!("{out} where the N x {m} results go, row-major"));
        about.extend(tag);
        about.push("@returns {Float64Array} `out`".into());
        about.push("@throws {RangeError} if `q` or `out` has another length".into());
        about.push("@throws {TypeError} if an argument is of another type".into());
        lines.extend(documentation(&about));
        let batch = &functions.batch;
        let new = match n {
            0 => "0".into(),
            1 => format!("q.length * {m}"),
            _ => format!("Math.floor(q.length / {n}) * {m}"),
        };
        let arguments = format!("q, out = new Float64Array({new}){given}");
        lines.extend(call(&format!("export function {batch}"), &arguments, " {"));
        lines.extend(required(&parameters));
        if n == 0 {
            lines.push(format!("  if (q.length !== 0 || out.length % {m} !== 0) {{"));
            lines
                .push(format!("    throw new RangeError(\"q must be empty and out have N x {m} entries\");"));
            lines.push("  }".into());
        } else {
            if n > 1 {
                lines.push(format!("  if (q.length % {n} !== 0) {{"));
                lines.push(format!(
                    "    throw new RangeError(`q must have N x {n} entries, not ${{q.length}}`);"
                ));
                lines.push("  }".into());
            }
            let [needed, have] = match n {
                1 => [format!("q.length * {m}"), "out.length".into()],
                _ => [format!("(q.length / {n}) * {m}"), "out.length".into()],
            };
            lines.push(format!("  if ({have} !== {needed}) {{"));
            lines.push(format!(
                "    throw new RangeError(`out must have {m} entries per row of q, not ${{out.length}} in all`);"
            ));
            lines.push("  }".into());
        }
        lines.extend(body.opening(&parameters, is_required));
        lines.push(match n {
            0 => format!("  for (let i = 0, o = 0; o < out.length; o += {m}) {{"),
            _ => format!("  for (let i = 0, o = 0; i < q.length; i += {n}, o += {m}) {{"),
        });
        lines.extend(call(&format!("    {}", functions.row), &body.arguments("q, i, out, o"), ";"));
        lines.extend(["  }", "  return out;", "}", ""].map(String::from));
        lines.extend(body.row(functions));
        lines
    }

    /// The type of parameters that need not be complete.
    fn given(&self) -> &'static str {
        let is_any_required = self.library.parameters.iter().any(|p| p.default.is_none());
        if is_any_required { "Partial<Parameters>" } else { "Parameters" }
    }
}

/// The types of arguments are what they should be.
fn required(parameters: &[&Parameter]) -> Vec<String> {
    let mut lines =
        vec!["  requireNumbers(q);".to_string(), "  if (!(out instanceof Float64Array)) {".into()];
    let hint = if parameters.is_empty() { "" } else { "; parameters are the third argument" };
    lines.push(format!("    throw new TypeError(\"out must be a Float64Array{hint}\");"));
    lines.push("  }".into());
    if !parameters.is_empty() {
        lines.push("  requireParameters(parameters);".into());
    }
    lines
}

/// What refuses texts and the like for numbers; typed arrays hold nothing else.
const REQUIRE_NUMBERS: &str = r#"
/** @param {ArrayLike<number>} q */
function requireNumbers(q) {
  if (ArrayBuffer.isView(q)) {
    return;
  }
  if (typeof q !== "object" || q === null || typeof q.length !== "number") {
    throw new TypeError(`q must be an array of numbers, not ${q === null ? "null" : typeof q}`);
  }
  for (let i = 0; i < q.length; i++) {
    if (typeof q[i] !== "number") {
      throw new TypeError(`q[${i}] must be a number, not ${q[i] === null ? "null" : typeof q[i]}`);
    }
  }
}
"#;

/// What refuses unknown names and what is no finite number.
const REQUIRE_PARAMETERS: &str = r#"
/** @param {Partial<Parameters> | null | undefined} parameters */
function requireParameters(parameters) {
  if (parameters === DEFAULTS || parameters === undefined) {
    return;
  }
  if (typeof parameters !== "object" || parameters === null) {
    throw new TypeError("parameters must be an object such as { name: value }");
  }
  KNOWN
  for (const [name, value] of Object.entries(parameters)) {
    if (!known.includes(name)) {
      throw new TypeError(`there is no parameter ${name}; there are ${known.join(", ")}`);
    }
    if (value !== undefined && !Number.isFinite(value)) {
      throw new TypeError(`parameter ${name} must be a finite number, not ${String(value)}`);
    }
  }
}
"#;

/// The parameters taken apart; `names` gives the field of each, and the field with the name it gets.
fn required_parameters(
    parameters: &[&Parameter],
    is_required: bool,
    names: impl Fn(&Parameter) -> (String, String),
) -> Vec<String> {
    let value = |p: &&Parameter| {
        let (field, name) = names(p);
        match p.default {
            Some(_) => format!("{name} = DEFAULTS.{field}"),
            None => format!("{name} = missing(\"{field}\")"),
        }
    };
    let values: Vec<String> = parameters.iter().map(value).collect();
    let source = if is_required { "parameters ?? {}" } else { "parameters" };
    let whole = format!("  const {{ {} }} = {source};", values.join(", "));
    match values.len() {
        0 => vec![],
        _ if whole.len() <= WRAP.width => vec![whole],
        _ => {
            let mut lines = vec!["  const {".to_string()];
            lines.extend(values.iter().map(|value| format!("    {value},")));
            lines.push(format!("  }} = {source};"));
            lines
        }
    }
}

/// The solvers, whose names are none of the module's.
fn solver_plans<'a>(library: &'a Library, functions: &[Functions]) -> Vec<Plan<'a>> {
    let of = |f: &Functions| {
        let names = [&f.one, &f.batch, &f.row, &f.cases, &f.scales];
        names.map(|name| name.to_string())
    };
    let taken: Vec<String> = functions.iter().flat_map(of).collect();
    let words: Vec<&str> = RESERVED.split_whitespace().chain(solver::WORDS.split_whitespace()).collect();
    let locals: Vec<&str> = words.iter().copied().filter(|w| *w != "q").collect();
    let locals: Vec<&str> = locals.into_iter().chain(taken.iter().map(String::as_str)).collect();
    let mut names = Names::new(Language::JavaScript, &locals);
    library.parameters.iter().for_each(|p| names.declare(p.symbol));
    plans(library, Language::JavaScript, &names, &words, &taken)
}

/// The formulas of a routine.
struct Body<'a> {
    library: &'a Library<'a>,
    names: Names,
    listing: Listing,
    blocks: Vec<Block>,
    /// What the formulas of a row read of the parameters and of what depends on them alone.
    constants: Vec<Symbol>,
}

impl<'a> Body<'a> {
    fn new(module: &Module<'a>, routine: &Routine) -> Self {
        let library = module.library;
        let mut names = module.names.clone();
        let listing = Listing::new(routine.program, &mut names);
        let blocks = blocks(&listing, &routine.shape, routine.program.variables(), &mut names);
        let read = reads(&Listing { hoisted: vec![], ..listing.clone() });
        let parameters = library.parameters.iter().map(|p| p.symbol);
        let hoisted = listing.hoisted.iter().flat_map(|statement| match statement {
            Statement::Pair { sine, cosine, .. } => vec![sine.as_ref(), cosine.as_ref()],
            Statement::Let { name, .. } => vec![Some(name)],
        });
        let hoisted = hoisted.flatten().map(|name| Symbol::new(name));
        let constants = parameters.chain(hoisted).filter(|s| read.contains(s)).collect();
        Body { library, names, listing, blocks, constants }
    }

    fn spelling(&self) -> Spelling<'_> {
        Spelling { language: Language::JavaScript, precision: Precision::Double, names: &self.names }
    }

    /// The parameters taken apart, and what depends on them alone.
    fn opening(&self, parameters: &[&Parameter], is_required: bool) -> Vec<String> {
        let mut lines = required_parameters(parameters, is_required, |p| {
            let name = self.names.of(p.symbol).to_string();
            (name.clone(), name)
        });
        lines.extend(self.listing.hoisted.iter().flat_map(|s| statement(s, &self.spelling())));
        lines
    }

    /// Arguments of the function for a row.
    fn arguments(&self, first: &str) -> String {
        let constants = self.constants.iter().map(|s| format!(", {}", self.names.of(*s)));
        format!("{first}{}", constants.collect::<String>())
    }

    /// The private function with the formulas.
    fn row(&self, functions: &Functions) -> Vec<String> {
        let mut about =
            vec![format!("`{}` of the row that begins at `q[i]`, into `out[o]` and on.", functions.one)];
        about.push(String::new());
        about.extend(["@param {ArrayLike<number>} q", "@param {number} i"].map(String::from));
        about.extend(["@param {Float64Array} out", "@param {number} o"].map(String::from));
        about.extend(self.constants.iter().map(|s| format!("@param {{number}} {}", self.names.of(*s))));
        let mut lines = documentation(&about);
        lines.extend(call(&format!("function {}", functions.row), &self.arguments("q, i, out, o"), " {"));
        let read = reads(&self.listing);
        let variables = self.library.variables.iter().enumerate();
        for (k, (symbol, _)) in variables.filter(|(_, v)| read.contains(&v.0)) {
            lines.push(format!("  const {} = q[{}];", self.names.of(*symbol), sum("i", k)));
        }
        for (k, block) in self.blocks.iter().enumerate() {
            if k > 0 {
                lines.push(String::new());
            }
            lines.extend(block.statements.iter().flat_map(|s| statement(s, &self.spelling())));
            if !block.statements.is_empty() {
                lines.push(String::new());
            }
            for (place, value) in &block.results {
                let head = format!("  out[{}] =", sum("o", *place));
                lines.extend(WRAP.statement(&head, &self.spelling().formula(*value), ";"));
            }
        }
        lines.push("}".into());
        lines
    }
}

fn sum(base: &str, offset: usize) -> String {
    if offset == 0 { base.into() } else { format!("{base} + {offset}") }
}

fn statement(statement: &Statement, spelling: &Spelling) -> Vec<String> {
    let one = |name: &str, value: Expr| {
        let head = format!("  const {} =", spelling.names.of(Symbol::new(name)));
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

/// `head(arguments)tail`, an argument a line if need be.
fn call(head: &str, arguments: &str, tail: &str) -> Vec<String> {
    let whole = format!("{head}({arguments}){tail}");
    if whole.len() <= WRAP.width {
        return vec![whole];
    }
    let margin = " ".repeat(head.len() - head.trim_start().len());
    let mut lines = vec![format!("{head}(")];
    lines.extend(split(arguments, &[", "]).iter().map(|(_, a)| format!("{margin}  {a},")));
    lines.push(format!("{margin}){tail}"));
    lines
}

/// A line of a comment in which no word is a tag.
fn untagged(text: &str) -> String {
    let mut plain = String::new();
    for c in comment(text).chars() {
        let opens_a_word = plain.chars().next_back().is_none_or(|last| !last.is_alphanumeric());
        if c == '@' && opens_a_word {
            plain.push_str("(at)");
        } else {
            plain.push(c);
        }
    }
    plain
}

fn documentation(about: &[String]) -> Vec<String> {
    let mut lines = vec!["/**".to_string()];
    for line in about {
        for part in prose(&comment(line), WRAP.width - 3) {
            lines.push(format!(" * {part}").trim_end().to_string());
        }
    }
    lines.push(" */".into());
    lines
}

impl Module<'_> {
    fn package(&self) -> Vec<String> {
        let quoted = |text: &str| format!("\"{}\"", comment(text).replace('"', "'"));
        let mut lines = vec!["{".to_string(), "  \"//\": [".into()];
        let header = brief(self.library, &format!("{}.js", self.name));
        let header = comments(header.iter().map(String::as_str), "", WRAP.width - 7);
        let header: Vec<String> = header.iter().map(|line| format!("    {}", quoted(line))).collect();
        lines.push(header.join(",\n"));
        lines.extend([
            "  ],".to_string(),
            format!("  \"name\": \"{}\",", self.name.replace('_', "-")),
            "  \"version\": \"1.0.0\",".into(),
            format!("  \"description\": {},", quoted(&self.library.title)),
            "  \"type\": \"module\",".into(),
            format!("  \"exports\": \"./{}.js\",", self.name),
            "  \"scripts\": { \"test\": \"node --test\" }".into(),
            "}".into(),
        ]);
        lines
    }
}
