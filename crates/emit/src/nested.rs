//! All solutions one by one: loops over the roots of each node, the steps of each level inside of them.
//!
//! What the languages with statements have in common. Python and the lanes of Rust have forms of their own.

use crate::Language;
use crate::Precision;
use crate::compiled::{Pair, Step, WRAP};
use crate::names::Names;
use crate::solver::{Branching, Kind, Near, Plan};
use crate::spelling::Spelling;
use crate::wrap::Wrap;
use denavit_program::solver::{CANDIDATE, ROUNDED};
use denavit_symbolic::{Expr, Symbol};

/// A rotation whose entries are all off by at most `ROUNDED` has a defect, RᵀR − 1 by Frobenius' norm, of at most so many times that.
const FARTHEST: f64 = 6.0;

/// The body of a solver.
pub(crate) struct Nested<'a> {
    pub plan: &'a Plan<'a>,
    pub language: Language,
    /// What the names of helpers begin with.
    pub prefix: &'a str,
    /// The function for the angle of a point.
    pub atan2: &'static str,
    /// The function for sines and cosines together, if there is one.
    pub sine_cosine: Option<&'static str>,
    pub wrap: Wrap,
    /// What is done if the variables are no pose, a line each.
    pub refusal: Vec<String>,
    lines: Vec<String>,
    indent: usize,
    names: Names,
}

/// A node as the loops see it.
struct Loop {
    roots: String,
    index: String,
    stride: usize,
    branches: usize,
}

/// What is known of a leaf: formulas for the multiplicity, the number of the branch and the free unknowns.
pub(crate) struct Leaf {
    pub outputs: Vec<String>,
    pub residual: String,
    pub multiplicity: String,
    pub branch: String,
    pub free: String,
}

impl<'a> Nested<'a> {
    pub fn new(plan: &'a Plan<'a>, language: Language, prefix: &'a str, atan2: &'static str) -> Self {
        Nested {
            plan,
            language,
            prefix,
            atan2,
            sine_cosine: None,
            wrap: WRAP,
            refusal: vec![],
            lines: vec![],
            indent: 4,
            names: plan.names.clone(),
        }
    }

    fn spelling(&self) -> Spelling<'_> {
        Spelling { language: self.language, precision: Precision::Double, names: &self.names }
    }

    fn formula(&self, e: Expr) -> String {
        self.spelling().formula(e)
    }

    fn line(&mut self, text: &str) {
        self.lines.push(if text.is_empty() {
            String::new()
        } else {
            format!("{}{text}", " ".repeat(self.indent))
        });
    }

    fn blank(&mut self) {
        if self.lines.last().is_some_and(|l| !l.is_empty() && !l.ends_with('{')) {
            self.lines.push(String::new());
        }
    }

    fn constant(&mut self, name: &str, formula: &str) {
        let declare = match self.language {
            Language::C | Language::Cuda | Language::IkFast => "const double ",
            Language::Rust => "let ",
            Language::JavaScript => "const ",
            Language::Matlab | Language::Python => "",
        };
        let head = format!("{}{declare}{name} =", " ".repeat(self.indent));
        self.lines.extend(self.wrap.statement(&head, formula, self.end()));
    }

    /// What ends a statement.
    fn end(&self) -> &'static str {
        if self.language == Language::Python { "" } else { ";" }
    }

    fn comment(&mut self, text: &str) {
        let line = match self.language {
            Language::C | Language::Cuda | Language::IkFast => format!("/* {text} */"),
            Language::Rust | Language::JavaScript => format!("// {text}"),
            Language::Matlab => format!("% {text}"),
            Language::Python => format!("# {text}"),
        };
        self.line(&line);
    }

    /// The same at an indentation.
    pub fn body_at(mut self, indent: usize, leaf: impl Fn(&Leaf, usize) -> Vec<String>) -> Vec<String> {
        self.indent = indent;
        self.body(leaf)
    }

    /// The steps from the first level to the leaf; `leaf` writes what is done with a solution, at an indentation.
    pub fn body(mut self, leaf: impl Fn(&Leaf, usize) -> Vec<String>) -> Vec<String> {
        let plan = self.plan;
        self.steps(&plan.hoisted);
        let mut loops: Vec<Loop> = vec![];
        let mut open = 0;
        for (i, level) in plan.levels.iter().enumerate() {
            self.steps(level);
            if i == 0 {
                self.admission();
            }
            let Some(node) = plan.nodes.get(i) else { break };
            let [roots, index] = ["roots", "i"].map(|word| self.names.free(&format!("{word}_{}", i + 1)));
            self.blank();
            self.node(node, &roots);
            if let Some(near) = &node.near {
                self.near(near, &loops);
            }
            let branches = node.root.branches();
            if branches > 1 {
                self.open(&roots, &index, branches);
                open += 1;
            }
            self.results(node, &roots, &index);
            loops.push(Loop { roots, index, stride: node.stride, branches });
        }
        let mut found = self.found(&loops);
        // Python takes all leaves, and looks at the residuals in the end.
        if self.language != Language::Python {
            if plan.residual.as_symbol().is_none() {
                let name = self.names.free("residual");
                self.constant(&name, &found.residual);
                found.residual = name;
            }
            self.candidate(&found.residual);
        }
        let (residual, tolerance) = (&found.residual, self.tolerance());
        let condition = match self.language {
            Language::Python => None,
            Language::Rust => Some(format!("if {residual} <= {tolerance} {{")),
            Language::Matlab => Some(format!("if {residual} <= {tolerance}")),
            Language::C | Language::Cuda | Language::IkFast | Language::JavaScript => {
                Some(format!("if ({residual} <= {tolerance}) {{"))
            }
        };
        if let Some(condition) = condition {
            self.line(&condition);
            self.indent += self.wrap.step;
            open += 1;
        }
        self.steps(&plan.leaf);
        let margin = " ".repeat(self.indent);
        self.lines.extend(leaf(&found, self.indent).into_iter().map(|line| format!("{margin}{line}")));
        for _ in 0..open {
            self.close();
        }
        self.lines
    }

    /// What residuals are compared with.
    fn tolerance(&self) -> &'static str {
        match (self.plan.defect, self.language) {
            (Some(_), _) => "tolerance",
            (None, Language::Rust) => "roots::TOLERANCE",
            (None, _) => "1e-9",
        }
    }

    /// Looks at the variables: whether they are numbers and, where that is computed, how far from a pose.
    fn admission(&mut self) {
        let size = self.formula(self.plan.size);
        let defect = self.plan.defect.map(|e| self.formula(e));
        let (language, refusal) = (self.language, self.refusal.clone());
        let largest = match language {
            Language::Rust => "f64::MAX",
            Language::JavaScript => "Number.MAX_VALUE",
            Language::Matlab => "realmax",
            Language::C | Language::Cuda | Language::IkFast | Language::Python => "1.7976931348623157e308",
        };
        let [and, times] = match language {
            Language::Python => [" & ", " * "],
            Language::Matlab => [" && ", "*"],
            Language::C | Language::Cuda | Language::IkFast | Language::JavaScript | Language::Rust => {
                [" && ", " * "]
            }
        };
        let grouped = |e: String| if language == Language::Python { format!("({e})") } else { e };
        let mut conditions: Vec<String> = vec![];
        conditions.extend(defect.iter().map(|d| grouped(format!("{d} <= {:e}", FARTHEST * ROUNDED))));
        conditions.push(grouped(format!("{size} <= {largest}")));
        let condition = conditions.join(and);
        self.blank();
        match language {
            Language::Python => self.constant("is_pose", &condition),
            Language::C | Language::Cuda | Language::IkFast | Language::JavaScript => {
                self.line(&format!("if (!({condition})) {{"))
            }
            Language::Rust => self.line(&format!("if !({condition}) {{")),
            Language::Matlab => self.line(&format!("if ~({condition})")),
        }
        if language != Language::Python {
            let margin = " ".repeat(self.wrap.step);
            refusal.iter().for_each(|l| self.line(&format!("{margin}{l}")));
            self.line(if language == Language::Matlab { "end" } else { "}" });
        }
        let Some(defect) = defect else { return };
        let is_typed = matches!(language, Language::Rust | Language::C | Language::Cuda | Language::IkFast);
        let fourfold = format!("4{}{times}{defect}", if is_typed { ".0" } else { "" });
        let clamped = match language {
            Language::C | Language::Cuda | Language::IkFast => {
                format!("fmax(1e-9, fmin({fourfold}, {CANDIDATE:e}))")
            }
            Language::Rust => format!("({fourfold}).clamp(roots::TOLERANCE, {CANDIDATE:e})"),
            Language::JavaScript => format!("Math.max(1e-9, Math.min({fourfold}, {CANDIDATE:e}))"),
            Language::Matlab => format!("max(1e-9, min({fourfold}, {CANDIDATE:e}))"),
            Language::Python => format!("np.clip({fourfold}, 1e-9, {CANDIDATE:e})"),
        };
        self.constant("tolerance", &clamped);
    }

    /// Notes that the unknown of a node is free, or nearly so.
    fn near(&mut self, near: &Near, loops: &[Loop]) {
        let [value, size] = [near.value, near.size].map(|e| self.bounded(e));
        let times = if self.language == Language::Matlab { "*" } else { " * " };
        let least = match near.least() {
            Some(least) => format!("{least:e}"),
            None => format!("{:e}{times}{size}", near.share),
        };
        let value = match (near.is_square, self.language) {
            (true, _) => value,
            (false, Language::C | Language::Cuda | Language::IkFast) => {
                format!("fabs({})", self.formula(near.value))
            }
            (false, Language::Rust) => format!("f64::abs({})", self.formula(near.value)),
            (false, Language::JavaScript) => format!("Math.abs({})", self.formula(near.value)),
            (false, Language::Matlab) => format!("abs({})", self.formula(near.value)),
            (false, Language::Python) => format!("np.abs({})", self.formula(near.value)),
        };
        let condition = format!("{value} <= {least}");
        if self.language != Language::Python {
            return self.note(&condition);
        }
        // Branches that are not there come this far, too.
        self.constant("nearly_free", &condition);
        for l in loops.iter().filter(|l| l.branches > 1) {
            self.constant(
                "nearly_free",
                &format!("nearly_free & ({}.multiplicity[{}] > 0)", l.roots, l.index),
            );
        }
        self.note("nearly_free");
    }

    /// Notes that a branch comes near a solution, and is none: one that rounding hides.
    fn candidate(&mut self, residual: &str) {
        let and = if self.language == Language::Rust { "&" } else { "&&" };
        let [open, close] = if self.language == Language::Rust { ["(", ")"] } else { ["", ""] };
        let tolerance = self.tolerance();
        self.note(&format!(
            "{open}{residual} > {tolerance}{close} {and} {open}{residual} <= {CANDIDATE:e}{close}"
        ));
    }

    fn note(&mut self, condition: &str) {
        let (head, condition) = match self.language {
            Language::C | Language::Cuda | Language::IkFast | Language::Rust | Language::Python => {
                ("is_near |=", condition.to_string())
            }
            Language::JavaScript => ("isNear ||=", condition.to_string()),
            Language::Matlab => ("is_near = is_near ||", format!("({condition})")),
        };
        let head = format!("{}{head}", " ".repeat(self.indent));
        self.lines.extend(self.wrap.statement(&head, condition.as_str(), self.end()));
    }

    /// A formula that can be a factor.
    fn bounded(&self, e: Expr) -> String {
        let text = self.formula(e);
        if e.as_symbol().is_some() || e.symbols().is_empty() { text } else { format!("({text})") }
    }

    fn open(&mut self, roots: &str, i: &str, branches: usize) {
        self.line(&match self.language {
            Language::C | Language::Cuda | Language::IkFast => {
                format!("for (int {i} = 0; {i} < {roots}.count; {i}++) {{")
            }
            Language::JavaScript => format!("for (let {i} = 0; {i} < {roots}.count; {i}++) {{"),
            Language::Rust => format!("for {i} in 0..{roots}.count {{"),
            Language::Matlab => format!("for {i} = 1:{roots}.count"),
            Language::Python => format!("for {i} in range({branches}):"),
        });
        self.indent += self.wrap.step;
    }

    fn close(&mut self) {
        self.indent -= self.wrap.step;
        match self.language {
            Language::Python => {}
            Language::Matlab => self.line("end"),
            Language::C | Language::Cuda | Language::IkFast | Language::Rust | Language::JavaScript => {
                self.line("}")
            }
        }
    }

    fn steps(&mut self, steps: &[Step]) {
        for step in steps {
            match step {
                Step::Pairs(pairs) => pairs.iter().for_each(|p| self.pair(p)),
                Step::Atan2 { name, y, x } => {
                    let formula = format!("{}({}, {})", self.atan2, self.formula(*y), self.formula(*x));
                    let name = self.names.of(Symbol::new(name)).to_string();
                    self.constant(&name, &formula);
                }
                Step::Let { name, value } => {
                    let (name, value) = (self.names.of(Symbol::new(name)).to_string(), self.formula(*value));
                    self.constant(&name, &value);
                }
                Step::Break | Step::Result { .. } => {}
            }
        }
    }

    fn pair(&mut self, p: &Pair) {
        let angle = self.formula(p.angle);
        let name = |s: &Self, n: &Option<String>| n.as_ref().map(|n| s.names.of(Symbol::new(n)).to_string());
        let (sine, cosine) = (name(self, &p.sine), name(self, &p.cosine));
        match (self.language, self.sine_cosine) {
            (Language::Rust, Some(function)) => {
                let or_none = |n: Option<String>| n.unwrap_or("_".into());
                let head = format!("({}, {})", or_none(sine), or_none(cosine));
                self.constant(&head, &format!("{function}({angle})"));
            }
            (_, Some(function)) => {
                let sine = sine.unwrap_or_else(|| self.names.free("unread"));
                let cosine = cosine.unwrap_or_else(|| self.names.free("unread"));
                self.line(&format!("double {sine}, {cosine};"));
                self.line(&format!("{function}({angle}, &{sine}, &{cosine});"));
            }
            (language, None) => {
                let library = match language {
                    Language::JavaScript => "Math.",
                    Language::Python => "np.",
                    Language::C | Language::Cuda | Language::IkFast | Language::Rust | Language::Matlab => "",
                };
                for (name, function) in [(sine, "sin"), (cosine, "cos")] {
                    if let Some(name) = name {
                        self.constant(&name, &format!("{library}{function}({angle})"));
                    }
                }
            }
        }
    }

    /// The call that finds the roots.
    fn node(&mut self, node: &Branching, roots: &str) {
        self.comment(&node.label);
        let mut arguments: Vec<String> = node.operands().into_iter().map(|e| self.formula(e)).collect();
        arguments.push(match (node.guard, self.language) {
            (Some(guard), _) => self.formula(guard),
            (None, Language::C | Language::Cuda | Language::IkFast) => "1e300".into(),
            (None, Language::Rust) => "f64::INFINITY".into(),
            (None, Language::JavaScript) => "Infinity".into(),
            (None, Language::Matlab) => "Inf".into(),
            (None, Language::Python) => "np.inf".into(),
        });
        arguments.push(self.formula(node.scale));
        let (p, kind) = (self.prefix, node.kind().name());
        let call = match self.language {
            Language::JavaScript => format!("{p}{kind}Roots({})", arguments.join(", ")),
            _ => format!("{p}{kind}_roots({})", arguments.join(", ")),
        };
        let declare = match self.language {
            Language::C | Language::Cuda | Language::IkFast => format!("const {p}roots {roots} ="),
            Language::Rust => format!("let {roots} ="),
            Language::JavaScript => format!("const {roots} ="),
            Language::Matlab | Language::Python => format!("{roots} ="),
        };
        let head = format!("{}{declare}", " ".repeat(self.indent));
        self.lines.extend(self.wrap.statement(&head, &call, self.end()));
    }

    /// The results of a root by their names, as far as they are read.
    fn results(&mut self, node: &Branching, roots: &str, index: &str) {
        let branches = node.root.branches();
        let i = match (branches, self.language) {
            (1, Language::Matlab) => "1",
            (1, _) => "0",
            _ => index,
        };
        let element = |field: &str| match self.language {
            Language::Matlab => format!("{roots}.{field}({i})"),
            _ => format!("{roots}.{field}[{i}]"),
        };
        let sign = match (self.language, node.kind()) {
            (Language::Rust, Kind::Quartic) => format!("({index} + 1) as f64"),
            (Language::Rust, _) => format!("1.0 - 2.0 * {index} as f64"),
            (Language::Matlab, Kind::Quartic) => index.to_string(),
            (Language::Matlab, _) => format!("3 - 2*{index}"),
            (_, Kind::Quartic) => format!("{index} + 1"),
            _ => format!("1 - 2 * {index}"),
        };
        let values: Vec<String> = match (node.root.is_angle(), branches) {
            (true, 1) => vec![element("x"), element("y")],
            (true, _) => vec![element("x"), element("y"), sign],
            (false, 1) => vec![element("x")],
            (false, _) => vec![element("x"), sign],
        };
        for (symbol, value) in node.results.iter().zip(values) {
            if self.plan.reads(*symbol) {
                let name = self.names.of(*symbol).to_string();
                self.constant(&name, &value);
            }
        }
    }

    fn found(&self, loops: &[Loop]) -> Leaf {
        let times = match self.language {
            Language::Matlab => "*",
            _ => " * ",
        };
        let sum = |parts: Vec<String>| if parts.is_empty() { "0".into() } else { parts.join(" + ") };
        let scaled = |factor: usize, what: String| match factor {
            1 => what,
            _ => format!("{factor}{times}{what}"),
        };
        let branching: Vec<&Loop> = loops.iter().filter(|l| l.branches > 1).collect();
        let element = |l: &&Loop| match self.language {
            Language::Matlab => format!("{}.multiplicity({})", l.roots, l.index),
            _ => format!("{}.multiplicity[{}]", l.roots, l.index),
        };
        let multiplicity: Vec<String> = branching.iter().map(element).collect();
        let index = |l: &Loop| match self.language {
            Language::Matlab => format!("({} - 1)", l.index),
            _ => l.index.clone(),
        };
        let is_free = if self.language == Language::JavaScript { "isFree" } else { "is_free" };
        Leaf {
            outputs: self.plan.outputs.iter().map(|e| self.formula(*e)).collect(),
            residual: self.formula(self.plan.residual),
            multiplicity: if multiplicity.is_empty() { "1".into() } else { multiplicity.join(times) },
            branch: sum(branching.iter().map(|l| scaled(l.stride, index(l))).collect()),
            free: sum(loops
                .iter()
                .enumerate()
                .map(|(k, l)| scaled(1 << k, format!("{}.{is_free}", l.roots)))
                .collect()),
        }
    }
}

/// A value in braces that stand at an indentation, in lines that are indented from there.
pub(crate) fn element(indent: usize, value: &str) -> Vec<String> {
    let wrap = Wrap { width: WRAP.width - indent, ..WRAP };
    let lines = wrap.statement("    ", value, ",").into_iter();
    lines.map(|line| format!("    {}", line.trim())).filter(|line| !line.trim().is_empty()).collect()
}

/// The parts of a text with the routines for roots that are called: the head, the kinds in use, and the end.
///
/// Parts begin with a line `@ name`.
pub(crate) fn routines(text: &str, plans: &[Plan]) -> String {
    let is_any = |kind: Kind| Plan::any(plans, kind);
    let wanted = |name: &str| match name {
        "head" => true,
        "clamp" => is_any(Kind::Sincos) || is_any(Kind::Quadratic) || is_any(Kind::Quartic),
        _ => Kind::ALL.iter().any(|k| k.name() == name && is_any(*k)),
    };
    parts(text).into_iter().filter(|(name, _)| wanted(name)).map(|(_, text)| text).collect()
}

/// One part of such a text.
pub(crate) fn part(text: &str, name: &str) -> String {
    parts(text).into_iter().find(|p| p.0 == name).map_or(String::new(), |p| p.1)
}

fn parts(text: &str) -> Vec<(&str, String)> {
    let pieces = text.trim_end().strip_prefix("@ ").unwrap_or(text).split("\n@ ");
    let cut = |piece: &'_ str| piece.split_once('\n').map(|(name, rest)| (name.len(), format!("{rest}\n")));
    pieces.filter_map(|piece| cut(piece).map(|(end, rest)| (&piece[..end], rest))).collect()
}
