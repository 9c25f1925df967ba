//! A formula as a tree whose parts know their places.

use denavit_symbolic::greek;
use std::ops::Range;

/// Parts in a row.
pub(super) struct Row {
    pub span: Range<usize>,
    pub nodes: Vec<Node>,
}

pub(super) struct Node {
    pub span: Range<usize>,
    pub kind: Kind,
}

pub(super) enum Kind {
    /// A whole element.
    Leaf(String),
    /// `{…}`, or what brackets of any size enclose.
    Group(Row),
    Fraction(Row, Row),
    /// With its degree.
    Root(Row, Option<Row>),
    Scripts {
        base: Row,
        sub: Option<Row>,
        sup: Option<Row>,
    },
    /// A sign above (or below) a part.
    Accent {
        base: Row,
        sign: &'static str,
        is_above: bool,
    },
    /// In bold or upright letters.
    Styled(Row, &'static str),
    /// Between two brackets.
    Table {
        rows: Vec<Vec<Row>>,
        open: &'static str,
        close: &'static str,
    },
    /// Lines that are aligned.
    Lines(Vec<Vec<Row>>),
}

/// The most levels of brackets.
const MAX_DEPTH: usize = 60;

/// The whole formula.
pub(super) fn formula(source: &str) -> Option<Row> {
    let mut reader = Reader { source, at: 0, depth: 0 };
    let rows = reader.table()?;
    reader.blank();
    (reader.at == source.len()).then_some(())?;
    Some(one(rows, 0..source.len()))
}

/// One row, or lines that are aligned.
fn one(mut rows: Vec<Vec<Row>>, span: Range<usize>) -> Row {
    if rows.len() == 1 && rows[0].len() == 1 {
        let nodes = rows.swap_remove(0).swap_remove(0).nodes;
        return Row { span, nodes };
    }
    let kind = Kind::Lines(rows);
    Row { span: span.clone(), nodes: vec![Node { span, kind }] }
}

struct Reader<'a> {
    source: &'a str,
    at: usize,
    depth: usize,
}

impl<'a> Reader<'a> {
    fn rest(&self) -> &'a str {
        &self.source[self.at..]
    }

    fn blank(&mut self) {
        loop {
            let rest = self.rest();
            let trimmed = rest.trim_start_matches(|c: char| c.is_whitespace() || c == '~');
            self.at += rest.len() - trimmed.len();
            match trimmed.strip_prefix('%') {
                Some(remark) => self.at += 1 + remark.find('\n').unwrap_or(remark.len()),
                None => return,
            }
        }
    }

    fn skip(&mut self, text: &str) -> bool {
        let is_there = self.rest().starts_with(text);
        self.at += if is_there { text.len() } else { 0 };
        is_there
    }

    /// The name of a command that stands here, without going on.
    fn command(&self) -> Option<&'a str> {
        let rest = self.rest().strip_prefix('\\')?;
        let letters = rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len());
        let sign = rest.chars().next().map_or(0, char::len_utf8);
        Some(&rest[..if letters == 0 { sign } else { letters }])
    }

    /// Rows of cells, up to what ends them.
    fn table(&mut self) -> Option<Vec<Vec<Row>>> {
        let mut rows = vec![vec![]];
        loop {
            let cell = self.row()?;
            rows.last_mut()?.push(cell);
            if self.skip("&") {
                continue;
            }
            if self.command() == Some("\\") || self.command() == Some("cr") {
                self.at += 1 + self.command().map_or(0, str::len);
                self.skip("*");
                // A distance between lines: `\\[4pt]`.
                if let Some(inside) = self.rest().strip_prefix('[')
                    && let Some((distance, _)) = inside.split_once(']')
                    && distance.ends_with(|c: char| c.is_ascii_alphabetic())
                    && distance.len() < 8
                {
                    self.at += distance.len() + 2;
                }
                rows.push(vec![]);
                continue;
            }
            // A last line without anything is none.
            if rows.len() > 1 && matches!(&rows.last()?[..], [one] if one.nodes.is_empty()) {
                rows.pop();
            }
            return Some(rows);
        }
    }

    /// Parts up to the end of a cell, a group or the formula.
    fn row(&mut self) -> Option<Row> {
        self.blank();
        let start = self.at;
        let mut nodes: Vec<Node> = vec![];
        let mut end = start;
        loop {
            self.blank();
            let rest = self.rest();
            let ends = rest.is_empty()
                || rest.starts_with(['}', '&'])
                || matches!(self.command(), Some("\\" | "cr" | "end" | "right"));
            if ends {
                return Some(Row { span: start..end, nodes });
            }
            let node = self.node(&mut nodes)?;
            nodes.extend(node);
            end = self.at;
        }
    }

    /// The next part; nothing for what is not shown.
    fn node(&mut self, before: &mut Vec<Node>) -> Option<Option<Node>> {
        self.depth += 1;
        let node = if self.depth > MAX_DEPTH { None } else { self.part(before) };
        self.depth -= 1;
        node
    }

    fn part(&mut self, before: &mut Vec<Node>) -> Option<Option<Node>> {
        let start = self.at;
        let sign = self.rest().chars().next()?;
        let kind = match sign {
            '_' | '^' | '\'' | '′' => {
                let base = before.pop();
                return self.scripts(base, start).map(Some);
            }
            '{' => Kind::Group(self.group()?),
            '\\' => match self.control()? {
                Some(kind) => kind,
                None => return Some(None),
            },
            '$' | '#' => return None,
            '0'..='9' => Kind::Leaf(self.number()),
            c if c.is_alphabetic() => {
                self.at += c.len_utf8();
                Kind::Leaf(format!("<mi>{c}</mi>"))
            }
            c => {
                self.at += c.len_utf8();
                let is_sign = matches!(c, '-' | '−' | '+') && before.last().is_some_and(opens);
                let sign = operator(c);
                // Of one number, not between two.
                Kind::Leaf(if is_sign { sign.replace("<mo>", "<mo form=\"prefix\">") } else { sign })
            }
        };
        Some(Some(Node { span: start..self.at, kind }))
    }

    fn number(&mut self) -> String {
        let rest = self.rest();
        let digits = |s: &str| s.find(|c: char| !c.is_ascii_digit()).unwrap_or(s.len());
        let whole = digits(rest);
        let broken = rest[whole..].strip_prefix('.').map_or(0, digits);
        let length = if broken > 0 { whole + 1 + broken } else { whole };
        self.at += length;
        format!("<mn>{}</mn>", &rest[..length])
    }

    /// `{…}`
    fn group(&mut self) -> Option<Row> {
        self.skip("{").then_some(())?;
        let start = self.at;
        let rows = self.table()?;
        let end = self.at;
        self.skip("}").then_some(())?;
        Some(one(rows, start..end))
    }

    /// The argument of a command: a group, or one part.
    fn argument(&mut self) -> Option<Row> {
        self.blank();
        if self.rest().starts_with('{') {
            return self.group();
        }
        let start = self.at;
        // `\frac12` has two arguments.
        if self.rest().starts_with(|c: char| c.is_ascii_digit()) {
            self.at += 1;
            let kind = Kind::Leaf(format!("<mn>{}</mn>", &self.source[start..self.at]));
            return Some(Row { span: start..self.at, nodes: vec![Node { span: start..self.at, kind }] });
        }
        if self.rest().is_empty() || self.rest().starts_with(['}', '&', '_', '^']) {
            return None;
        }
        let node = self.node(&mut vec![])??;
        Some(Row { span: start..self.at, nodes: vec![node] })
    }

    fn scripts(&mut self, base: Option<Node>, start: usize) -> Option<Node> {
        let (mut sub, mut sup): (Option<Row>, Option<Row>) = (None, None);
        loop {
            let at = self.at;
            self.blank();
            if self.skip("_") {
                let row = self.argument()?;
                sub.replace(row).is_none().then_some(())?;
            } else if self.skip("^") {
                let row = self.argument()?;
                match &mut sup {
                    // `q'^2`
                    Some(primes) => primes.nodes.extend(row.nodes),
                    None => sup = Some(row),
                }
            } else if self.rest().starts_with(['\'', '′']) {
                let from = self.at;
                self.at += self.rest().chars().next().map_or(0, char::len_utf8);
                let node = Node { span: from..self.at, kind: Kind::Leaf("<mo>′</mo>".into()) };
                match &mut sup {
                    Some(primes) => primes.nodes.push(node),
                    None => sup = Some(Row { span: from..self.at, nodes: vec![node] }),
                }
            } else {
                self.at = at;
                break;
            }
        }
        let begins = base.as_ref().map_or(start, |b| b.span.start);
        let base = match base {
            Some(node) => Row { span: node.span.clone(), nodes: vec![node] },
            None => Row { span: start..start, nodes: vec![] },
        };
        Some(Node { span: begins..self.at, kind: Kind::Scripts { base, sub, sup } })
    }

    /// A text in braces, as it is.
    fn words(&mut self) -> Option<&'a str> {
        self.blank();
        let inside = self.rest().strip_prefix('{')?;
        let end = inside.find('}')?;
        let words = &inside[..end];
        self.at += end + 2;
        (!words.contains(['{', '\\', '$'])).then_some(words)
    }

    /// What a command makes; nothing for what is not shown.
    fn control(&mut self) -> Option<Option<Kind>> {
        let name = self.command()?;
        self.at += 1 + name.len();
        let leaf = |text: String| Some(Some(Kind::Leaf(text)));
        if let Some((_, sign)) = SIGNS.iter().find(|s| s.0 == name) {
            return leaf(format!("<mo>{sign}</mo>"));
        }
        if let Some((_, sign, is_above)) = ACCENTS.iter().find(|a| a.0 == name) {
            return Some(Some(Kind::Accent { base: self.argument()?, sign, is_above: *is_above }));
        }
        if FUNCTIONS.contains(&name) {
            return leaf(format!("<mi class=\"fn\">{name}</mi>"));
        }
        if let Some(letter) = greek::letter(name) {
            return leaf(format!("<mi>{letter}</mi>"));
        }
        match name {
            "pi" => leaf("<mi>π</mi>".into()),
            "partial" => leaf("<mi>∂</mi>".into()),
            "infty" => leaf("<mi>∞</mi>".into()),
            "ell" => leaf("<mi>ℓ</mi>".into()),
            "frac" | "dfrac" | "tfrac" | "cfrac" => {
                Some(Some(Kind::Fraction(self.argument()?, self.argument()?)))
            }
            "sqrt" => {
                let degree = self.degree()?;
                Some(Some(Kind::Root(self.argument()?, degree)))
            }
            "left" => self.bracketed().map(Some),
            "begin" => self.environment().map(Some),
            "text" | "textrm" | "mbox" | "hbox" | "textnormal" | "textbf" | "textit" => {
                leaf(format!("<mtext>{}</mtext>", escaped(self.words()?)))
            }
            "operatorname" => {
                self.skip("*");
                leaf(format!("<mi>{}</mi>", escaped(self.words()?)))
            }
            "mathrm" | "rm" if self.is_word() => {
                leaf(format!("<mi mathvariant=\"normal\">{}</mi>", self.words()?))
            }
            "mathbf" | "boldsymbol" | "bm" | "pmb" | "vect" | "mat" => {
                Some(Some(Kind::Styled(self.argument()?, "bold")))
            }
            "mathrm" | "mathit" | "mathsf" | "mathcal" | "mathbb" | "mathtt" => {
                Some(Some(Kind::Styled(self.argument()?, "plain")))
            }
            "tag" | "label" => {
                self.words()?;
                Some(None)
            }
            "big" | "Big" | "bigg" | "Bigg" | "bigl" | "bigr" | "Bigl" | "Bigr" | "biggl" | "biggr"
            | "displaystyle" | "textstyle" | "nonumber" | "notag" | "limits" | "nolimits" | "bf" | "it"
            | "rm" | "hline" | "middle" => Some(None),
            " " | "," | ";" | ":" | ">" => leaf("<mspace width=\"0.25em\"></mspace>".into()),
            "!" | "/" => Some(None),
            "quad" => leaf("<mspace width=\"1em\"></mspace>".into()),
            "qquad" => leaf("<mspace width=\"2em\"></mspace>".into()),
            "{" | "}" | "%" | "&" | "_" | "#" | "$" => leaf(operator(name.chars().next()?)),
            _ => None,
        }
    }

    /// True before a word in braces.
    fn is_word(&self) -> bool {
        let inside = self.rest().trim_start().strip_prefix('{').and_then(|r| r.split('}').next());
        inside.is_some_and(|w| !w.is_empty() && w.chars().all(char::is_alphanumeric))
    }

    /// `[3]`
    fn degree(&mut self) -> Option<Option<Row>> {
        let Some(inside) = self.rest().strip_prefix('[') else { return Some(None) };
        let end = inside.find(']')?;
        let start = self.at + 1;
        let part = &inside[..end];
        part.chars().all(char::is_alphanumeric).then_some(())?;
        self.at += end + 2;
        let span = start..start + end;
        let node = Node { span: span.clone(), kind: Kind::Leaf(format!("<mn>{part}</mn>")) };
        Some(Some(Row { span, nodes: vec![node] }))
    }

    /// `\left( … \right)`
    fn bracketed(&mut self) -> Option<Kind> {
        let open_at = self.at;
        let open = self.bracket()?;
        let start = self.at;
        let rows = self.table()?;
        let inside = one(rows, start..self.at);
        (self.command() == Some("right")).then_some(())?;
        self.at += "\\right".len();
        let close_at = self.at;
        let close = self.bracket()?;
        let leaf = |span: Range<usize>, sign: &str| Node {
            span,
            kind: Kind::Leaf(if sign.is_empty() { String::new() } else { format!("<mo>{sign}</mo>") }),
        };
        let mut nodes = vec![leaf(open_at..start, open)];
        nodes.extend(inside.nodes);
        nodes.push(leaf(close_at..self.at, close));
        Some(Kind::Group(Row { span: open_at..self.at, nodes }))
    }

    fn bracket(&mut self) -> Option<&'static str> {
        self.blank();
        let found = BRACKETS.iter().find(|b| self.rest().starts_with(b.0))?;
        self.at += found.0.len();
        Some(found.1)
    }

    /// `\begin{bmatrix} … \end{bmatrix}`
    fn environment(&mut self) -> Option<Kind> {
        let name = self.words()?;
        let bare = name.trim_end_matches('*');
        if matches!(bare, "array" | "alignedat" | "tabular") {
            self.words()?;
        }
        let rows = self.table()?;
        (self.command() == Some("end")).then_some(())?;
        self.at += "\\end".len();
        (self.words()? == name).then_some(())?;
        let (open, close) = match bare {
            "matrix" | "smallmatrix" | "array" | "tabular" => ("", ""),
            "pmatrix" => ("(", ")"),
            "bmatrix" => ("[", "]"),
            "Bmatrix" => ("{", "}"),
            "vmatrix" => ("|", "|"),
            "Vmatrix" => ("‖", "‖"),
            "cases" => ("{", ""),
            "aligned" | "align" | "split" | "gathered" | "alignedat" | "eqnarray" => {
                return Some(Kind::Lines(rows));
            }
            _ => return None,
        };
        Some(Kind::Table { rows, open, close })
    }
}

fn escaped(text: &str) -> String {
    crate::render::escaped(text)
}

fn operator(sign: char) -> String {
    let shown = match sign {
        '-' => '−',
        '*' => '∗',
        c => c,
    };
    format!("<mo>{}</mo>", escaped(&shown.to_string()))
}

/// True for a bracket that opens, a comma, a sign between two formulas.
fn opens(node: &Node) -> bool {
    let Kind::Leaf(text) = &node.kind else { return false };
    let sign = text.strip_prefix("<mo>").and_then(|rest| rest.strip_suffix("</mo>"));
    sign.is_some_and(|s| !matches!(s, ")" | "]" | "}" | "|" | "‖" | "′" | "∘" | "°" | "!"))
}

const BRACKETS: &[(&str, &str)] = &[
    ("(", "("),
    (")", ")"),
    ("[", "["),
    ("]", "]"),
    ("|", "|"),
    (".", ""),
    ("\\{", "{"),
    ("\\}", "}"),
    ("\\lbrace", "{"),
    ("\\rbrace", "}"),
    ("\\|", "‖"),
    ("\\lVert", "‖"),
    ("\\rVert", "‖"),
    ("\\lvert", "|"),
    ("\\rvert", "|"),
    ("/", "/"),
];

const FUNCTIONS: &[&str] = &[
    "sin", "cos", "tan", "cot", "arcsin", "arccos", "arctan", "sinh", "cosh", "tanh", "exp", "ln", "log",
    "det", "min", "max", "dim", "ker", "arg",
];

const SIGNS: &[(&str, &str)] = &[
    ("cdot", "·"),
    ("times", "×"),
    ("ast", "∗"),
    ("pm", "±"),
    ("mp", "∓"),
    ("div", "÷"),
    ("le", "≤"),
    ("leq", "≤"),
    ("leqslant", "≤"),
    ("ge", "≥"),
    ("geq", "≥"),
    ("geqslant", "≥"),
    ("ne", "≠"),
    ("neq", "≠"),
    ("approx", "≈"),
    ("equiv", "≡"),
    ("sim", "∼"),
    ("to", "→"),
    ("rightarrow", "→"),
    ("Rightarrow", "⇒"),
    ("implies", "⇒"),
    ("Leftrightarrow", "⇔"),
    ("iff", "⇔"),
    ("in", "∈"),
    ("longrightarrow", "⟶"),
    ("mapsto", "↦"),
    ("propto", "∝"),
    ("forall", "∀"),
    ("angle", "∠"),
    ("prod", "∏"),
    ("otimes", "⊗"),
    ("cap", "∩"),
    ("cup", "∪"),
    ("wedge", "∧"),
    ("vee", "∨"),
    ("ll", "≪"),
    ("gg", "≫"),
    ("dots", "…"),
    ("ldots", "…"),
    ("cdots", "⋯"),
    ("vdots", "⋮"),
    ("ddots", "⋱"),
    ("circ", "∘"),
    ("prime", "′"),
    ("top", "⊤"),
    ("perp", "⊥"),
    ("parallel", "∥"),
    ("nabla", "∇"),
    ("sum", "∑"),
    ("int", "∫"),
    ("lbrace", "{"),
    ("rbrace", "}"),
    ("lvert", "|"),
    ("rvert", "|"),
    ("|", "‖"),
    ("colon", ":"),
    ("degree", "°"),
];

const ACCENTS: &[(&str, &str, bool)] = &[
    ("dot", "˙", true),
    ("ddot", "¨", true),
    ("hat", "^", true),
    ("widehat", "^", true),
    ("vec", "→", true),
    ("overrightarrow", "→", true),
    ("bar", "¯", true),
    ("overline", "¯", true),
    ("tilde", "~", true),
    ("widetilde", "~", true),
    ("underline", "_", false),
    ("overbrace", "⏞", true),
    ("underbrace", "⏟", false),
    ("check", "ˇ", true),
];
