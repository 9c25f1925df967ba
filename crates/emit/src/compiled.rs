//! What the compiled languages have in common: the words at the head of a file, and the steps of a function.

use crate::blocks::blocks;
use crate::listing::{Listing, Statement};
use crate::names::{Names, no_test, renamed, sanitised};
use crate::spelling::Spelling;
use crate::wrap::Wrap;
use crate::{Language, Library, Precision, Routine};
use denavit_symbolic::{Expr, Node, Symbol};
use rustc_hash::{FxHashMap, FxHashSet};
use std::fmt::Write;

/// What a block's function may read and write, in bytes: most processors have a first cache of 32 KiB or 48.
const FIRST_CACHE: usize = 36 << 10;
/// The longest line.
pub(crate) const WIDTH: usize = 100;
/// Formulas of several lines go on with a sign, further in.
pub(crate) const WRAP: Wrap =
    Wrap { width: WIDTH, step: 4, sign_leads: true, goes_on: "", brackets: ["", ""] };
/// How many angles the routine for sines and cosines of several takes.
pub(crate) const EIGHT: usize = 8;
/// So many angles or fewer are cheaper one by one.
const FEW: usize = 3;

/// The sine and cosine of an angle; what is not read has no name.
#[derive(Clone, Debug)]
pub(crate) struct Pair {
    pub angle: Expr,
    pub sine: Option<String>,
    pub cosine: Option<String>,
}

/// What a function does next.
#[derive(Clone, Debug)]
pub(crate) enum Step {
    /// An empty line.
    Break,
    /// Sines and cosines of angles that are all known.
    Pairs(Vec<Pair>),
    /// The angle of a point.
    Atan2 { name: String, y: Expr, x: Expr },
    /// A named value.
    Let { name: String, value: Expr },
    /// The result at a place.
    Result { place: usize, value: Expr },
}

/// The formulas that a step reads.
pub(crate) fn formulas(step: &Step) -> Vec<Expr> {
    match step {
        Step::Pairs(pairs) => pairs.iter().map(|p| p.angle).collect(),
        Step::Atan2 { y, x, .. } => vec![*y, *x],
        Step::Let { value, .. } | Step::Result { value, .. } => vec![*value],
        Step::Break => vec![],
    }
}

/// A function in the words of a language. Its formulas have no sines, cosines or arctangents.
pub(crate) struct Function<'a> {
    pub routine: &'a Routine<'a>,
    /// Its own name.
    pub name: String,
    /// The name of the array of results.
    pub result: String,
    /// Identifiers of everything in it.
    pub names: Names,
    /// What depends on parameters alone.
    pub hoisted: Vec<Step>,
    pub body: Vec<Step>,
    reads: FxHashSet<Symbol>,
}

impl<'a> Function<'a> {
    fn new(routine: &'a Routine<'a>, name: String, names: &Names) -> Self {
        let mut names = names.clone();
        let result = names.free(&sanitised(&routine.result));
        let listing = Listing::new(routine.program, &mut names);
        let mut hoisted = Steps { list: vec![], names: &mut names };
        hoisted.statements(&listing.hoisted);
        let hoisted = hoisted.list;
        let mut body = Steps { list: vec![], names: &mut names };
        let inputs = routine.program.variables();
        for (k, block) in blocks(&listing, &routine.shape, inputs, body.names).iter().enumerate() {
            if k > 0 {
                body.list.push(Step::Break);
            }
            body.statements(&block.statements);
            for (place, value) in &block.results {
                let value = body.without_atan2(*value);
                body.list.push(Step::Result { place: *place, value });
            }
        }
        let body = body.list;
        let reads = hoisted.iter().chain(&body).flat_map(formulas).flat_map(|e| e.symbols()).collect();
        Function { routine, name, result, hoisted, body, reads, names }
    }

    /// Whether a variable or parameter is read.
    pub fn reads(&self, symbol: Symbol) -> bool {
        self.reads.contains(&symbol)
    }

    /// The parameters that are read, in order.
    pub fn parameters(&self, library: &Library) -> Vec<Symbol> {
        library.parameters.iter().map(|p| p.symbol).filter(|s| self.reads(*s)).collect()
    }

    /// The variables that are read, in order, with their places.
    pub fn variables(&self, library: &Library) -> Vec<(usize, Symbol)> {
        let symbols = library.variables.iter().map(|v| v.0).enumerate();
        symbols.filter(|(_, s)| self.reads(*s)).collect()
    }

    /// How its formulas are written.
    pub fn spelling(&self, language: Language, precision: Precision) -> Spelling<'_> {
        Spelling { language, precision, names: &self.names }
    }

    /// All steps, what is hoisted first.
    pub fn steps(&self) -> impl Iterator<Item = &Step> {
        self.hoisted.iter().chain(&self.body)
    }

    /// The identifier of a named value.
    pub fn of(&self, name: &str) -> &str {
        self.names.of(Symbol::new(name))
    }

    /// How many results there are.
    pub fn results(&self) -> usize {
        self.routine.shape.iter().product()
    }

    /// The lengths of the nested arrays of results, at least one.
    pub fn shape(&self) -> Vec<usize> {
        if self.routine.shape.is_empty() { vec![1] } else { self.routine.shape.clone() }
    }

    /// The indices of a result.
    pub fn indices(&self, place: usize) -> Vec<usize> {
        let mut rest = place;
        let mut indices: Vec<usize> = vec![];
        for length in self.shape().into_iter().rev() {
            indices.push(rest % length);
            rest /= length;
        }
        indices.reverse();
        indices
    }

    /// Runs of angles for one configuration: those that are taken eight at a time, and those one by one.
    pub fn runs(pairs: &[Pair]) -> Vec<&[Pair]> {
        let mut runs = vec![];
        for chunk in pairs.chunks(EIGHT) {
            if chunk.len() > FEW { runs.push(chunk) } else { runs.extend(chunk.chunks(1)) }
        }
        runs
    }

    /// Whether some function of the list takes angles eight at a time.
    pub fn any_eight(functions: &[Self]) -> bool {
        let is_eight = |s: &Step| match s {
            Step::Pairs(pairs) => Self::runs(pairs).iter().any(|run| run.len() > 1),
            Step::Break | Step::Atan2 { .. } | Step::Let { .. } | Step::Result { .. } => false,
        };
        functions.iter().flat_map(Function::steps).any(is_eight)
    }

    /// Whether some function of the list takes a root of what is no constant.
    pub fn any_root(functions: &[Self]) -> bool {
        Self::any_formula(functions, |e| matches!(e.node(), Node::Sqrt(_)) && !e.symbols().is_empty())
    }

    /// Whether some function of the list takes the sign of a value.
    pub fn any_sign(functions: &[Self]) -> bool {
        Self::any_formula(functions, |e| matches!(e.node(), Node::Sign(_)))
    }

    fn any_formula(functions: &[Self], is: fn(&Expr) -> bool) -> bool {
        let has = |s: &Step| {
            let formulas = match s {
                Step::Break => vec![],
                Step::Pairs(pairs) => pairs.iter().map(|p| p.angle).collect(),
                Step::Atan2 { y, x, .. } => vec![*y, *x],
                Step::Let { value, .. } | Step::Result { value, .. } => vec![*value],
            };
            Expr::postorder(&formulas).iter().any(is)
        };
        functions.iter().flat_map(Function::steps).any(has)
    }

    /// Whether some function of the list has a range in which the routines without branches hold.
    pub fn any_range(functions: &[Self]) -> bool {
        functions.iter().any(Function::has_range)
    }

    /// Whether some function of the list takes sines and cosines.
    pub fn any_pair(functions: &[Self]) -> bool {
        functions.iter().flat_map(Function::steps).any(|s| matches!(s, Step::Pairs(_)))
    }

    /// Whether some function of the list takes the angle of a point.
    pub fn any_atan2(functions: &[Self]) -> bool {
        functions.iter().flat_map(Function::steps).any(|s| matches!(s, Step::Atan2 { .. }))
    }

    /// Whether something in its body has a range in which the routines without branches hold.
    pub fn has_range(&self) -> bool {
        self.body.iter().any(|s| matches!(s, Step::Pairs(_) | Step::Atan2 { .. }))
    }
}

/// The functions of a library; `names` holds the identifiers of its variables and parameters.
pub(crate) fn functions<'a>(
    library: &'a Library,
    language: Language,
    names: &Names,
    reserved: &[&str],
) -> Vec<Function<'a>> {
    let mut taken = Names::new(language, &[reserved, &["test", "parameters", "defaults", "lanes"]].concat());
    let mut name = |r: &Routine| taken.free(&sanitised(&r.name).to_lowercase());
    library.routines.iter().map(|r| (r, name(r))).map(|(r, name)| Function::new(r, name, names)).collect()
}

/// Identifiers for the variables and parameters of a library.
pub(crate) fn inputs(library: &Library, language: Language, reserved: &[&str]) -> Names {
    let mut names = Names::new(language, reserved);
    let variables = library.variables.iter().map(|v| v.0);
    variables.chain(library.parameters.iter().map(|p| p.symbol)).for_each(|s| names.declare(s));
    names
}

/// The name of files and functions.
pub(crate) fn file_name(library: &Library, language: Language) -> String {
    Names::new(language, &["main", "makefile"]).free(&no_test(sanitised(&library.name).to_lowercase()))
}

/// The words that open a file: the header of the library, what each function costs, and how it is called.
pub(crate) fn opening(library: &Library, functions: &[Function], names: &Names, name: &str) -> Vec<String> {
    let mut lines = library.header.clone();
    lines.extend(renamed(library, name));
    if !functions.is_empty() {
        lines.extend([String::new(), "Operations of one configuration:".into()]);
        lines.extend(functions.iter().map(|f| {
            let name = &f.routine.name;
            let also = if f.name == *name { String::new() } else { format!(" (the function {name})") };
            format!("  {}{also}: {}", f.name, f.routine.program.count())
        }));
        lines.extend([String::new(), "Variables, in the order of q:".into()]);
        let variables = library.variables.iter().enumerate();
        lines.extend(
            variables
                .map(|(k, (s, about))| format!("  q[{k}] = {}: {}", names.of(*s), names.about(*s, about))),
        );
        if library.variables.is_empty() {
            lines.push("  none".into());
        }
    }
    if !library.parameters.is_empty() {
        lines.extend([String::new(), "Parameters:".into()]);
        lines.extend(library.parameters.iter().map(|p| {
            let default = p.default.map_or("no default".into(), |x| format!("default {x:?}"));
            format!("  {}: {} ({default})", names.of(p.symbol), names.about(p.symbol, &p.about))
        }));
    }
    if !functions.is_empty() {
        lines.extend([String::new(), "Results:".into()]);
    }
    for f in functions {
        let shape: Vec<String> = f.shape().iter().map(usize::to_string).collect();
        lines.push(format!("  {} of {}, {}:", f.result, f.name, shape.join(" x ")));
        lines.extend(f.routine.about.iter().map(|line| format!("    {line}")));
    }
    lines
}

/// What holds of angles: which are taken, and what their sums cost.
pub(crate) fn about_angles(functions: &[Function], precision: Precision) -> Vec<String> {
    if !Function::any_range(functions) {
        return vec![];
    }
    let unit = if precision == Precision::Single { "2^-24" } else { "2^-53" };
    vec![
        "Every finite angle has its sine; an infinite one or NaN makes the results that read it NaN.".into(),
        "Where formulas add angles up, the sum is rounded before its sine is taken: by up to".into(),
        format!("|sum| {unit} (rad), and results with it. A sum beyond the largest number gives NaN."),
    ]
}

/// The default of every parameter, if each has one.
pub(crate) fn defaults(library: &Library) -> Option<Vec<f64>> {
    let all: Option<Vec<f64>> = library.parameters.iter().map(|p| p.default).collect();
    all.filter(|list| !list.is_empty())
}

/// Units in the last place that the tests allow, of the scale of a result. In single precision each variable is
/// rounded as well, which moves a result by up to half a unit of the variable's magnitude.
pub(crate) const TOLERANCE: f64 = 4.0;

/// Statements on their way to steps.
pub(crate) struct Steps<'a> {
    pub list: Vec<Step>,
    pub names: &'a mut Names,
}

impl Steps<'_> {
    /// Adds the steps of statements.
    pub fn statements(&mut self, statements: &[Statement]) {
        for statement in statements {
            match statement {
                Statement::Pair { angle, sine, cosine } => {
                    let angle = self.without_atan2(*angle);
                    let pair = Pair { angle, sine: sine.clone(), cosine: cosine.clone() };
                    match self.list.last_mut() {
                        Some(Step::Pairs(pairs)) if !pairs.iter().any(|p| is_read(p, angle)) => {
                            pairs.push(pair);
                        }
                        _ => self.list.push(Step::Pairs(vec![pair])),
                    }
                }
                Statement::Let { name, value } => match value.node() {
                    Node::Atan2(y, x) => {
                        let (y, x) = (self.without_atan2(y), self.without_atan2(x));
                        self.list.push(Step::Atan2 { name: name.clone(), y, x });
                    }
                    _ => {
                        let value = self.without_atan2(*value);
                        let step = Step::Let { name: name.clone(), value };
                        match self.list.last() {
                            // A sum goes ahead of the angles, so that all of them are known at once.
                            Some(Step::Pairs(pairs)) if !pairs.iter().any(|p| is_read(p, value)) => {
                                self.list.insert(self.list.len() - 1, step);
                            }
                            _ => self.list.push(step),
                        }
                    }
                },
            }
        }
    }

    /// The formula with names in place of its arctangents, which become steps of their own.
    fn without_atan2(&mut self, e: Expr) -> Expr {
        let mut done: FxHashMap<Expr, Expr> = FxHashMap::default();
        for part in Expr::postorder(&[e]) {
            let of = |x: Expr| done[&x];
            let new = match part.node() {
                _ if part.symbols().is_empty() => part,
                Node::Number(_) | Node::Pi | Node::Symbol(_) => part,
                Node::Sin(a) => of(a).sin(),
                Node::Cos(a) => of(a).cos(),
                Node::Neg(a) => -of(a),
                Node::Add(a, b) => of(a) + of(b),
                Node::Sub(a, b) => of(a) - of(b),
                Node::Mul(a, b) => of(a) * of(b),
                Node::Div(a, b) => of(a) / of(b),
                Node::Pow(a, n) => of(a).powi(n),
                Node::Sqrt(a) => of(a).sqrt(),
                Node::Sign(a) => of(a).sign(),
                Node::Atan2(y, x) => {
                    let (y, x) = (of(y), of(x));
                    let name = self.names.fresh("angle");
                    self.list.push(Step::Atan2 { name: name.clone(), y, x });
                    Expr::symbol(&name)
                }
            };
            done.insert(part, new);
        }
        done[&e]
    }
}

/// Whether an angle reads the sine or cosine of a pair.
fn is_read(pair: &Pair, angle: Expr) -> bool {
    let names = [&pair.sine, &pair.cosine];
    angle.symbols().iter().any(|s| names.into_iter().flatten().any(|name| *s.name() == **name))
}

/// Lines with their ends.
pub(crate) fn lines(list: &[String]) -> String {
    list.iter().map(|line| format!("{line}\n")).collect()
}

/// A function that is being written.
pub(crate) struct Body {
    pub text: String,
    pub indent: usize,
}

impl Body {
    /// A line at the present indentation.
    pub fn line(&mut self, line: &str) {
        let _ = writeln!(self.text, "{}{line}", " ".repeat(self.indent));
    }

    /// An empty line, unless there is one or a bracket has just opened.
    pub fn blank(&mut self) {
        if !self.text.ends_with("\n\n") && !self.text.ends_with("{\n") {
            self.text.push('\n');
        }
    }

    /// `head formula;`
    pub fn statement(&mut self, head: &str, formula: &str) {
        let head = format!("{}{head}", " ".repeat(self.indent));
        self.text.push_str(&lines(&WRAP.statement(&head, formula, ";")));
    }

    /// Values with commas between `head` and `tail`, in one line if they fit.
    pub fn list(&mut self, head: &str, values: &[String], tail: &str) {
        self.bracketed(head, values, tail, "");
    }

    /// The same with spaces inside of the braces.
    pub fn list_spaced(&mut self, head: &str, values: &[String], tail: &str) {
        self.bracketed(head, values, tail, " ");
    }

    fn bracketed(&mut self, head: &str, values: &[String], tail: &str, space: &str) {
        let whole = format!("{head}{space}{}{space}{tail}", values.join(", "));
        if self.indent + whole.chars().count() <= WIDTH {
            return self.line(&whole);
        }
        self.line(head);
        self.text.push_str(&lines(&WRAP.list(values, self.indent + 4)));
        self.line(tail);
    }

    /// Values as nested arrays, a row a line if it fits.
    pub fn nested(&mut self, head: &str, values: &[String], shape: &[usize], tail: &str) {
        let (outer, inner) = (shape.len() > 1, shape.get(1..).unwrap_or_default());
        if !outer {
            let whole = format!("{head}[{}]{tail}", values.join(", "));
            if self.indent + whole.chars().count() <= WIDTH {
                return self.line(&whole);
            }
            self.line(&format!("{head}["));
            values.iter().for_each(|v| self.element(v));
            return self.line(&format!("]{tail}"));
        }
        self.line(&format!("{head}["));
        self.indent += 4;
        let size: usize = inner.iter().product();
        values.chunks(size.max(1)).for_each(|row| self.nested("", row, inner, ","));
        self.indent -= 4;
        self.line(&format!("]{tail}"));
    }

    /// A value in a line of its own, or in several.
    fn element(&mut self, value: &str) {
        let margin = " ".repeat(self.indent + 4);
        let mut list = WRAP.statement(&margin, value, ",");
        list.iter_mut().for_each(|line| *line = format!("{margin}{}", line.trim_start()));
        list.retain(|line| !line.trim().is_empty());
        self.text.push_str(&lines(&list));
    }
}

/// Configurations of a block: at most 64, and so few that what the largest function reads and writes stays in the first cache.
pub(crate) fn lanes(library: &Library, functions: &[Function]) -> usize {
    let numbers =
        functions.iter().map(|f| library.variables.len() + f.shape().iter().product::<usize>()).max();
    let bytes = if library.precision == Precision::Double { 8 } else { 4 };
    let fits = |lanes: usize| lanes * bytes * numbers.unwrap_or(0) <= FIRST_CACHE;
    [64, 32].into_iter().find(|&lanes| fits(lanes)).unwrap_or(16)
}
