//! Formulas of Typst as formulas of LaTeX.

use super::taken;

/// Names that LaTeX calls otherwise.
const NAMES: [(&str, &str); 34] = [
    ("plus.minus", "\\pm"),
    ("minus.plus", "\\mp"),
    ("dot.op", "\\cdot"),
    ("dot.c", "\\cdot"),
    ("dot", "\\cdot"),
    ("times", "\\times"),
    ("arrow.r", "\\to"),
    ("arrow.r.double", "\\Rightarrow"),
    ("approx", "\\approx"),
    ("equiv", "\\equiv"),
    ("prop", "\\propto"),
    ("eq.not", "\\neq"),
    ("lt.eq", "\\leq"),
    ("gt.eq", "\\geq"),
    ("degree", "^{\\circ}"),
    ("infinity", "\\infty"),
    ("oo", "\\infty"),
    ("theta.alt", "\\vartheta"),
    ("phi.alt", "\\varphi"),
    ("epsilon.alt", "\\epsilon"),
    ("epsilon", "\\varepsilon"),
    ("quad", "\\quad"),
    ("wide", "\\qquad"),
    ("dots", "\\dots"),
    ("dots.h", "\\dots"),
    ("dots.v", "\\vdots"),
    ("partial", "\\partial"),
    ("sum", "\\sum"),
    ("integral", "\\int"),
    ("and", "\\land"),
    ("or", "\\lor"),
    ("in", "\\in"),
    ("mod", "\\bmod"),
    ("checkmark", "\\checkmark"),
];
/// Names that are the same in LaTeX.
const SAME: [&str; 45] = [
    "alpha", "beta", "gamma", "delta", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu", "nu", "xi",
    "pi", "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi", "omega", "Gamma", "Delta", "Theta",
    "Lambda", "Xi", "Pi", "Sigma", "Phi", "Psi", "Omega", "sin", "cos", "tan", "cot", "arcsin", "arccos",
    "arctan", "exp", "log", "ln", "det", "min", "max",
];
/// What is written over a letter.
const ACCENTS: [(&str, &str); 10] = [
    ("hat", "hat"),
    ("tilde", "tilde"),
    ("dot", "dot"),
    ("dot.double", "ddot"),
    ("diaer", "ddot"),
    ("ddot", "ddot"),
    ("arrow", "vec"),
    ("overline", "overline"),
    ("macron", "bar"),
    ("underline", "underline"),
];
/// How letters look.
const LOOKS: [&str; 10] =
    ["upright", "italic", "bold", "cal", "sans", "mono", "serif", "bb", "frak", "display"];
/// What stands for the place at which lines are aligned, until it is known whether there are several.
const ALIGNED: char = '\u{1}';
/// Groups in groups that are followed.
const DEEPEST: usize = 100;

/// A formula that is read.
pub struct Math<'a> {
    rest: &'a str,
    depth: usize,
    has_lines: bool,
}

/// A part of a formula: what can stand above a bar, or a sign.
struct Piece {
    text: String,
    is_atom: bool,
}

impl<'a> Math<'a> {
    /// A formula as LaTeX has it.
    pub fn read(formula: &'a str) -> String {
        let mut math = Math { rest: formula, depth: 0, has_lines: false };
        let mut text = String::new();
        while !math.rest.is_empty() {
            text.push_str(&math.row(&[]));
            text.extend(math.next());
        }
        match math.has_lines {
            true => format!("\\begin{{aligned}}{}\\end{{aligned}}", text.replace(ALIGNED, "&")),
            false => text.replace(ALIGNED, " "),
        }
    }

    fn peek(&self) -> Option<char> {
        self.rest.chars().next()
    }

    fn next(&mut self) -> Option<char> {
        taken(&mut self.rest)
    }

    /// What stands before one of the marks, a bracket that nothing opened, or the end.
    fn row(&mut self, stops: &[char]) -> String {
        let mut pieces: Vec<Piece> = vec![];
        let mut bars = 0;
        while let Some(c) = self.peek() {
            if stops.contains(&c) || matches!(c, ')' | ']' | '}') {
                break;
            }
            if c == '/' && bars < DEEPEST {
                bars += 1;
                self.next();
                while pieces.last().is_some_and(|p| p.text.trim().is_empty()) {
                    pieces.pop();
                }
                let above = pieces.pop_if(|p| p.is_atom).map(|p| p.text).unwrap_or_default();
                self.rest = self.rest.trim_start();
                let below = self.piece().text;
                let text = format!("\\frac{{{}}}{{{}}}", bare(&above), bare(&below));
                pieces.push(Piece { text, is_atom: true });
                continue;
            }
            pieces.push(self.piece());
        }
        pieces.into_iter().map(|p| p.text).collect()
    }

    /// The next part with its indices.
    fn piece(&mut self) -> Piece {
        let mut piece = self.part();
        while let Some(mark @ ('_' | '^')) = self.peek().filter(|_| piece.is_atom) {
            self.next();
            let index = self.part().text;
            // `x_"4x"` has letters and digits as they are.
            let plain = index.strip_prefix("\\text{").and_then(|t| t.strip_suffix('}'));
            piece.text.push_str(&format!("{mark}{{{}}}", plain.unwrap_or_else(|| bare(&index)).trim()));
        }
        if piece.is_atom {
            let primes = self.rest.len() - self.rest.trim_start_matches('\'').len();
            piece.text.push_str(&self.rest[..primes]);
            self.rest = &self.rest[primes..];
        }
        piece
    }

    fn part(&mut self) -> Piece {
        // Names of code are names here.
        self.rest = self.rest.trim_start_matches('#');
        let Some(c) = self.peek() else { return Piece { text: String::new(), is_atom: false } };
        let atom = |text: String| Piece { text, is_atom: true };
        let sign = |text: &str| Piece { text: text.into(), is_atom: false };
        match c {
            '"' => {
                let text = self.quoted();
                // `""^0 T`
                let is_bare = text.is_empty() && self.rest.starts_with(['^', '_']);
                match text.is_empty() {
                    _ if is_bare => atom("{}".into()),
                    true => sign(""),
                    // `"0,5"` is a number.
                    false => match decimal(&text) {
                        Some(number) => atom(number),
                        None => atom(format!("\\text{{{text}}}")),
                    },
                }
            }
            '(' | '[' | '{' => atom(self.group()),
            c if c.is_ascii_digit() => {
                let end =
                    self.rest.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(self.rest.len());
                let digits = self.rest[..end].trim_end_matches('.');
                self.rest = &self.rest[digits.len()..];
                atom(digits.into())
            }
            c if c.is_alphabetic() => self.named(),
            '\\' => {
                self.next();
                match self.peek() {
                    Some(c) if !c.is_whitespace() => {
                        self.next();
                        sign(&c.to_string())
                    }
                    _ => {
                        self.has_lines = true;
                        sign("\\\\")
                    }
                }
            }
            '*' => {
                self.next();
                sign("\\cdot ")
            }
            '&' => {
                self.next();
                sign(&ALIGNED.to_string())
            }
            _ => {
                let signs = [
                    ("<=", "\\leq "),
                    (">=", "\\geq "),
                    ("!=", "\\neq "),
                    ("->", "\\to "),
                    ("=>", "\\Rightarrow "),
                ];
                if let Some((shown, latex)) = signs.iter().find(|s| self.rest.starts_with(s.0)) {
                    self.rest = &self.rest[shown.len()..];
                    return sign(latex);
                }
                self.next();
                sign(&c.to_string())
            }
        }
    }

    /// The text between quotes.
    fn quoted(&mut self) -> String {
        self.next();
        let end = self.rest.find('"').unwrap_or(self.rest.len());
        let text = self.rest[..end].to_string();
        self.rest = self.rest[end..].strip_prefix('"').unwrap_or("");
        text
    }

    /// Brackets with what is in them.
    fn group(&mut self) -> String {
        let open = self.next().unwrap_or('(');
        if self.depth >= DEEPEST {
            self.rest = "";
            return String::new();
        }
        self.depth += 1;
        let inner = self.row(&[]);
        self.depth -= 1;
        // It may be closed behind a place where the line may be broken.
        let close = self.next();
        let shown = |c: char| if matches!(c, '{' | '}') { format!("\\{c}") } else { c.to_string() };
        format!("{}{inner}{}", shown(open), close.map(shown).unwrap_or_default())
    }

    /// A letter, a name, or a function with its arguments.
    fn named(&mut self) -> Piece {
        let letters = |text: &str| text.find(|c: char| !c.is_alphabetic()).unwrap_or(text.len());
        let mut end = letters(self.rest);
        while let Some(more) = self.rest[end..].strip_prefix('.') {
            let longer = end + 1 + letters(more);
            let name = &self.rest[..longer];
            if longer == end + 1 || !(is_name(name) || NAMES.iter().any(|n| n.0.starts_with(name))) {
                break;
            }
            end = longer;
        }
        let name = &self.rest[..end];
        self.rest = &self.rest[end..];
        let mut text = match name {
            _ if self.peek() == Some('(') && is_function(name) => return self.function(name),
            _ if name.chars().count() == 1 => {
                // `a1` is what nobody writes who has seen its page, and is meant as `a_1`.
                let digits = self.rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(self.rest.len());
                let (number, rest) = self.rest.split_at(digits);
                self.rest = rest;
                if number.is_empty() { name.to_string() } else { format!("{name}_{{{number}}}") }
            }
            _ => match NAMES.iter().find(|n| n.0 == name) {
                Some((_, latex)) if latex.starts_with('^') => (*latex).to_string(),
                Some((_, latex)) => format!("{latex} "),
                None if name.starts_with("sym.") => format!("\\{} ", &name[4..]),
                None if SAME.contains(&name) => {
                    let is_apart = self.peek().is_none_or(|c| !c.is_alphanumeric());
                    format!("\\{name}{}", if is_apart { "" } else { " " })
                }
                None => format!("\\mathit{{{name}}}"),
            },
        };
        if text.ends_with(' ') && self.peek().is_some_and(|c| matches!(c, '_' | '^' | '(')) {
            text.pop();
        }
        // `theta(t)` is one whole above a bar.
        if self.peek() == Some('(') {
            text.push_str(&self.group());
        }
        let is_atom = !NAMES[..13].iter().any(|n| n.0 == name);
        Piece { text, is_atom }
    }

    fn function(&mut self, name: &str) -> Piece {
        let (rows, named) = self.arguments();
        let first = || rows.iter().flatten().next().cloned().unwrap_or_default();
        let second = || rows.iter().flatten().nth(1).cloned().unwrap_or_default();
        let matrix = |name: &str, rows: &[Vec<String>]| {
            let rows: Vec<String> = rows.iter().map(|row| row.join(" & ")).collect();
            format!("\\begin{{{name}}}{}\\end{{{name}}}", rows.join(" \\\\ "))
        };
        let column = || rows.iter().flatten().map(|e| vec![e.clone()]).collect::<Vec<_>>();
        let text = match name {
            "sqrt" => format!("\\sqrt{{{}}}", first()),
            "root" => format!("\\sqrt[{}]{{{}}}", first(), second()),
            "frac" => format!("\\frac{{{}}}{{{}}}", first(), second()),
            "mat" => matrix("bmatrix", &rows),
            "vec" => matrix("bmatrix", &column()),
            "cases" => matrix("cases", &column()),
            "abs" => format!("|{}|", first()),
            "norm" => format!("\\|{}\\|", first()),
            "lr" => first(),
            "attach" => {
                let index = |places: [&str; 2], mark: char| {
                    let found = named.iter().find(|n| places.contains(&n.0.as_str()));
                    found.map(|n| format!("{mark}{{{}}}", bare(&n.1))).unwrap_or_default()
                };
                let left = index(["tl", "tl"], '^') + &index(["bl", "bl"], '_');
                let left = if left.is_empty() { left } else { format!("{{}}{left}") };
                format!("{left}{}{}{}", first(), index(["tr", "t"], '^'), index(["br", "b"], '_'))
            }
            "op" => format!("\\operatorname{{{}}}", first().replace("\\text{", "").replace('}', "")),
            _ if LOOKS.contains(&name) => match first().strip_prefix("\\text{") {
                Some(word) => format!("\\mathit{{{word}"),
                None => first(),
            },
            _ => {
                let accent = ACCENTS.iter().find(|a| a.0 == name).map_or(name, |a| a.1);
                format!("\\{accent}{{{}}}", first())
            }
        };
        let text = if name == "op" && self.peek() == Some('(') { text + &self.group() } else { text };
        Piece { text, is_atom: true }
    }

    /// The arguments row by row, and those with names.
    fn arguments(&mut self) -> (Vec<Vec<String>>, Vec<(String, String)>) {
        self.next();
        let (mut rows, mut named) = (vec![vec![]], vec![]);
        if self.depth >= DEEPEST {
            self.rest = "";
            return (rows, named);
        }
        self.depth += 1;
        loop {
            let word = self.rest.trim_start();
            let is_part = |c: char| c.is_alphanumeric() || c == '-';
            let name = word.find(|c| !is_part(c)).unwrap_or(word.len());
            let behind = word[name..].strip_prefix(':').filter(|rest| name > 0 && !rest.starts_with('='));
            if let Some(rest) = behind {
                let name = word[..name].to_string();
                self.rest = rest;
                named.push((name, self.row(&[',', ';']).trim().to_string()));
            }
            let is_named = behind.is_some();
            let argument = self.row(&[',', ';']);
            let argument = argument.trim();
            if let Some(row) = rows.last_mut().filter(|_| !is_named && !argument.is_empty()) {
                row.push(argument.to_string());
            }
            match self.next() {
                Some(',') => {}
                Some(';') => rows.push(vec![]),
                _ => break,
            }
        }
        self.depth -= 1;
        rows.retain(|row| !row.is_empty());
        (rows, named)
    }
}

fn is_name(name: &str) -> bool {
    NAMES.iter().any(|n| n.0 == name) || ACCENTS.iter().any(|a| a.0 == name) || name.starts_with("sym.")
}

fn is_function(name: &str) -> bool {
    const OTHERS: [&str; 11] =
        ["sqrt", "root", "frac", "mat", "vec", "cases", "abs", "norm", "lr", "op", "attach"];
    OTHERS.contains(&name) || LOOKS.contains(&name) || ACCENTS.iter().any(|a| a.0 == name)
}

/// What stands between the brackets that only hold a group together.
fn bare(text: &str) -> &str {
    let Some(inner) = text.strip_prefix('(').and_then(|t| t.strip_suffix(')')) else { return text };
    let mut depth = 0_i32;
    let is_one = inner.chars().all(|c| {
        depth += i32::from(c == '(') - i32::from(c == ')');
        depth >= 0
    });
    if is_one { inner } else { text }
}

/// `0{,}5` for a text that is a number with a comma.
fn decimal(text: &str) -> Option<String> {
    let (whole, rest) = text.split_once(',')?;
    let is_number = |part: &str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
    (is_number(whole) && is_number(rest)).then(|| format!("{whole}{{,}}{rest}"))
}
