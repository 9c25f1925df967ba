//! Statements and values of a program as trees. What has another form is kept with its place and stands for nothing known.

use super::code::{Kind, Language, Token, quoted, tokens};
use std::ops::Range;

/// No value and no block is deeper.
pub(super) const MAX_DEPTH: usize = 60;

/// A value as it is written.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub form: Form,
    pub span: Range<usize>,
    depth: usize,
}

/// The form of a value.
#[derive(Clone, Debug)]
pub(super) enum Form {
    Number,
    Text(String),
    Name(String),
    /// `f(…)`, `a(i)`, `a[i]`, `c{i}`.
    Call(Box<Node>, Vec<Argument>),
    Attribute(Box<Node>, String),
    Unary(String, Box<Node>),
    Binary(String, Box<Node>, Box<Node>),
    /// `[1 2; 3 4]`; in braces, its entries are not joined.
    Matrix(Vec<Vec<Node>>, bool),
    /// A list or several values of Python.
    List(Vec<Node>),
    /// `[value for names in values if all]`
    Each(Box<Node>, Vec<Round>),
    /// `1:n`, `1:2:n`, `:`; of Python only in brackets.
    Range(Vec<Option<Node>>),
    /// `a if c else b`: a, c, b.
    Choice(Box<[Node; 3]>),
    Transposed(Box<Node>),
    /// What is not followed.
    Other,
}

/// `for names in values if all`
#[derive(Clone, Debug)]
pub(super) struct Round {
    pub target: Node,
    pub values: Node,
    pub conditions: Vec<Node>,
}

/// An argument of a call.
#[derive(Clone, Debug)]
pub(super) struct Argument {
    /// `d=…`
    pub key: Option<String>,
    pub value: Node,
}

/// A statement with its place.
#[derive(Clone, Debug)]
pub(super) struct Statement {
    pub act: Act,
    pub span: Range<usize>,
}

/// What a statement does.
#[derive(Clone, Debug)]
pub(super) enum Act {
    Value(Node),
    /// The targets, the sign before `=`, and the value.
    Assign(Vec<Node>, String, Node),
    For(Round, Vec<Statement>),
    /// Each block with its condition; one without is `else`.
    If(Vec<(Option<Node>, Vec<Statement>)>),
    /// Blocks that run or do not, once or often.
    Unsure(Vec<Vec<Statement>>),
    /// A block that runs, and what runs where it fails.
    Try(Vec<Vec<Statement>>),
    /// A block that runs.
    Block(Vec<Statement>),
    Function(Box<Function>),
    Class(String, Vec<Statement>),
    /// `from x import name as other`
    Import(Vec<(String, String)>),
    /// Names that stand for themselves, or for nothing any more.
    Free(Vec<String>),
    Return(Option<Node>),
    Break,
    Continue,
    Nothing,
    /// What is not followed, with the names in it.
    Other(Vec<String>),
    /// The head of a block that is not followed.
    Unread,
}

/// A function of the program.
#[derive(Clone, Debug)]
pub(super) struct Function {
    pub name: String,
    pub parameters: Vec<(String, Option<Node>)>,
    /// The names whose values it gives back, of MATLAB's.
    pub results: Vec<String>,
    pub body: Vec<Statement>,
}

/// The statements of a program.
pub(super) fn program(text: &str, language: Language) -> Vec<Statement> {
    let mut parser =
        Parser { text, language, tokens: tokens(text, language), at: 0, depth: 0, work: 0, brackets: vec![] };
    let mut found = vec![];
    while parser.kind() != Kind::End {
        let before = parser.at;
        found.extend(parser.block(&[]));
        if parser.at == before {
            parser.at += 1;
        }
    }
    // Blocks in blocks that do not end as they begin are read again and again.
    if parser.is_too_much() {
        found.push(Statement { act: Act::Unread, span: 0..0 });
    }
    found
}

pub(super) struct Parser<'t> {
    pub(super) text: &'t str,
    language: Language,
    pub(super) tokens: Vec<Token>,
    pub(super) at: usize,
    pub(super) depth: usize,
    /// Statements and words that were read, those that were read again among them.
    pub(super) work: usize,
    /// Brackets under way: in `[` and `{` of MATLAB blanks part values.
    pub(super) brackets: Vec<char>,
}

impl Parser<'_> {
    pub(super) fn token(&self) -> &Token {
        &self.tokens[self.at.min(self.tokens.len() - 1)]
    }

    pub(super) fn kind(&self) -> Kind {
        self.token().kind
    }

    pub(super) fn word(&self) -> &str {
        match self.kind() {
            Kind::Name | Kind::Sign => &self.text[self.token().span.clone()],
            Kind::Line if self.text[self.token().span.clone()] == *";" => ";",
            _ => "",
        }
    }

    /// The word behind the next.
    pub(super) fn second(&self) -> &str {
        self.tokens.get(self.at + 1).map_or("", |t| &self.text[t.span.clone()])
    }

    pub(super) fn start(&self) -> usize {
        self.token().span.start
    }

    /// Where the word before ended.
    pub(super) fn end(&self) -> usize {
        self.at.checked_sub(1).map_or(0, |k| self.tokens[k.min(self.tokens.len() - 1)].span.end)
    }

    pub(super) fn take(&mut self, word: &str) -> bool {
        let is = self.word() == word;
        self.at += usize::from(is);
        is
    }

    pub(super) fn name(&mut self) -> Option<String> {
        let name = (self.kind() == Kind::Name).then(|| self.word().to_string())?;
        self.at += 1;
        Some(name)
    }

    pub(super) fn is_python(&self) -> bool {
        self.language == Language::Python
    }

    fn blanks_part(&self) -> bool {
        !self.is_python() && matches!(self.brackets.last(), Some('[' | '{'))
    }

    // Values ---------------------------------------------------------------------------------------------------------

    pub(super) fn node(&self, form: Form, start: usize) -> Option<Node> {
        let depth = 1 + match &form {
            Form::Call(a, _) | Form::Attribute(a, _) | Form::Unary(_, a) | Form::Transposed(a) => a.depth,
            Form::Binary(_, a, b) => a.depth.max(b.depth),
            Form::Matrix(rows, _) => rows.iter().flatten().map(|n| n.depth).max().unwrap_or(0),
            Form::List(all) => all.iter().map(|n| n.depth).max().unwrap_or(0),
            _ => 0,
        };
        let span = start..self.end().max(start);
        (depth <= MAX_DEPTH).then_some(Node { form, span, depth })
    }

    pub(super) fn value(&mut self) -> Option<Node> {
        self.deeper(|p| {
            let start = p.start();
            let first = p.sums(0)?;
            if p.is_python() && p.word() == "if" {
                p.at += 1;
                let condition = p.sums(0)?;
                if !p.take("else") {
                    return None;
                }
                let other = p.value()?;
                return p.node(Form::Choice(Box::new([first, condition, other])), start);
            }
            if !p.is_python() && p.word() == ":" {
                let mut ends = vec![Some(first)];
                while p.take(":") {
                    ends.push(Some(p.sums(0)?));
                }
                return p.node(Form::Range(ends), start);
            }
            Some(first)
        })
    }

    /// How strongly a sign between two values binds.
    fn strength(&self) -> Option<u8> {
        if self.blanks_part() && matches!(self.word(), "+" | "-") {
            // `[1 -2]` are two values.
            let behind = self.tokens.get(self.at + 1).is_some_and(|t| t.apart);
            if self.token().apart && !behind {
                return None;
            }
        }
        Some(match self.word() {
            "or" | "||" | "|" => 1,
            "and" | "&&" | "&" => 2,
            "in" | "is" | "==" | "~=" | "!=" | "<" | ">" | "<=" | ">=" => 3,
            "not" if self.second() == "in" => 3,
            "+" | "-" => 5,
            "*" | "/" | "%" | "@" | "//" | ".*" | "./" | "\\" => 6,
            _ => return None,
        })
    }

    pub(super) fn sums(&mut self, least: u8) -> Option<Node> {
        let start = self.start();
        let mut left = if self.is_python() && self.word() == "not" {
            self.at += 1;
            // It binds less than comparisons.
            let inner = self.deeper(|p| p.sums(2))?;
            self.node(Form::Unary("not".into(), Box::new(inner)), start)?
        } else {
            self.unary()?
        };
        while let Some(strength) = self.strength().filter(|s| *s > least) {
            let mut sign = self.word().to_string();
            self.at += 1;
            if ["not", "is"].contains(&sign.as_str()) && ["in", "not"].contains(&self.word()) {
                sign = format!("{sign} {}", self.word());
                self.at += 1;
            }
            let right = self.deeper(|p| p.sums(strength))?;
            // `0 < i < 2` of Python is two comparisons.
            if strength == 3 && self.is_python() && self.strength() == Some(3) {
                return None;
            }
            left = self.node(Form::Binary(sign, Box::new(left), Box::new(right)), start)?;
        }
        Some(left)
    }

    pub(super) fn unary(&mut self) -> Option<Node> {
        let start = self.start();
        if matches!(self.word(), "-" | "+" | "~" | "!" | "*" | "**") {
            let sign = self.word().to_string();
            self.at += 1;
            let inner = self.deeper(Self::unary)?;
            return self.node(Form::Unary(sign, Box::new(inner)), start);
        }
        let base = self.postfix()?;
        let part = self.blanks_part()
            && self.token().apart
            && !self.tokens.get(self.at + 1).is_some_and(|t| t.apart);
        if matches!(self.word(), "**" | "^" | ".^") && !part {
            self.at += 1;
            let power = self.deeper(Self::unary)?;
            // MATLAB's powers of powers go the other way.
            let is_bare = !self.text[power.span.clone()].starts_with('(');
            if !self.is_python() && is_bare && matches!(&power.form, Form::Binary(s, ..) if s == "^") {
                return None;
            }
            return self.node(Form::Binary("^".into(), Box::new(base), Box::new(power)), start);
        }
        Some(base)
    }

    fn postfix(&mut self) -> Option<Node> {
        let start = self.start();
        let mut node = self.primary()?;
        loop {
            if self.blanks_part() && self.token().apart {
                return Some(node);
            }
            match self.word() {
                "(" => node = self.called(node, start, ')')?,
                "[" if self.is_python() => node = self.called(node, start, ']')?,
                "{" if !self.is_python() => node = self.called(node, start, '}')?,
                "." => {
                    self.at += 1;
                    match self.name() {
                        Some(name) => node = self.node(Form::Attribute(Box::new(node), name), start)?,
                        None => return None,
                    }
                }
                "'" | ".'" if !self.is_python() => {
                    self.at += 1;
                    node = self.node(Form::Transposed(Box::new(node)), start)?;
                }
                _ => return Some(node),
            }
        }
    }

    fn called(&mut self, callee: Node, start: usize, close: char) -> Option<Node> {
        let open = match close {
            ')' => '(',
            ']' => '[',
            _ => '{',
        };
        self.at += 1;
        self.brackets.push(if open == '[' || open == '{' { '(' } else { open });
        let arguments = self.arguments(close);
        self.brackets.pop();
        let arguments = arguments?;
        self.node(Form::Call(Box::new(callee), arguments), start)
    }

    fn arguments(&mut self, close: char) -> Option<Vec<Argument>> {
        let close = close.to_string();
        let mut found = vec![];
        while !self.take(&close) {
            if self.kind() == Kind::End {
                return None;
            }
            if self.kind() == Kind::Line || self.take(",") {
                if self.kind() == Kind::Line {
                    self.at += 1;
                }
                continue;
            }
            let before = self.at;
            let key = (self.kind() == Kind::Name && self.second() == "=").then(|| self.word().to_string());
            if key.is_some() {
                self.at += 2;
            }
            let from = self.at;
            let value = self.argument(&close);
            let is_whole = value.is_some() && (self.word() == "," || self.word() == close);
            let value = match value {
                Some(value) if is_whole => value,
                _ => self.unread(from, &close)?,
            };
            found.push(Argument { key, value });
            if self.at == before {
                return None;
            }
        }
        Some(found)
    }

    /// An argument or an index: a value, `:`, `1:3`, `x for x in y`.
    fn argument(&mut self, close: &str) -> Option<Node> {
        let start = self.start();
        let mut ends = vec![];
        loop {
            if self.word() == ":" {
                ends.push(None);
            } else if self.word() == "," || self.word() == close {
                if !ends.is_empty() {
                    ends.push(None);
                }
                break;
            } else {
                let value = self.value()?;
                if self.is_python() && self.word() == "for" {
                    return self.each(value, start);
                }
                ends.push(Some(value));
            }
            if !self.take(":") {
                break;
            }
        }
        match (ends.len(), ends.first()) {
            (1, Some(Some(_))) => ends.pop().flatten(),
            _ => self.node(Form::Range(ends), start),
        }
    }

    /// What is not understood, up to the next `,` or the bracket's end.
    fn unread(&mut self, from: usize, close: &str) -> Option<Node> {
        self.at = from;
        let start = self.start();
        let mut open = 0_usize;
        loop {
            match self.kind() {
                Kind::End => return None,
                Kind::Sign => match self.word() {
                    "(" | "[" | "{" => open += 1,
                    word if open == 0 && (word == "," || word == close) => break,
                    ")" | "]" | "}" => open = open.saturating_sub(1),
                    _ => {}
                },
                _ => {}
            }
            self.at += 1;
        }
        self.node(Form::Other, start)
    }

    /// The rounds behind a value.
    fn each(&mut self, value: Node, start: usize) -> Option<Node> {
        let mut rounds = vec![];
        while self.take("for") {
            rounds.push(self.round()?);
        }
        self.node(Form::Each(Box::new(value), rounds), start)
    }

    fn primary(&mut self) -> Option<Node> {
        let start = self.start();
        let text = self.text[self.token().span.clone()].to_string();
        match self.kind() {
            Kind::Number => {
                self.at += 1;
                self.node(Form::Number, start)
            }
            Kind::Text => {
                self.at += 1;
                let mut inner = quoted(&text)?.to_string();
                while self.is_python() && self.kind() == Kind::Text {
                    inner += quoted(&self.text[self.token().span.clone()])?;
                    self.at += 1;
                }
                self.node(Form::Text(inner), start)
            }
            Kind::Filled => {
                self.at += 1;
                self.node(Form::Other, start)
            }
            Kind::Name if text == "lambda" => None,
            Kind::Name => {
                self.at += 1;
                self.node(Form::Name(text), start)
            }
            Kind::Sign => match text.as_str() {
                "(" => {
                    self.at += 1;
                    self.brackets.push('(');
                    let inner = if self.is_python() { self.listed(")", start) } else { self.value() };
                    self.brackets.pop();
                    let mut inner = inner?;
                    if !self.is_python() && !self.take(")") {
                        return None;
                    }
                    inner.span = start..self.end();
                    Some(inner)
                }
                "[" if self.is_python() => {
                    self.at += 1;
                    self.brackets.push('[');
                    let inner = self.listed("]", start);
                    self.brackets.pop();
                    let mut inner = inner?;
                    inner.span = start..self.end();
                    Some(inner)
                }
                "[" | "{" if !self.is_python() => {
                    self.at += 1;
                    self.brackets.push(if text == "[" { '[' } else { '{' });
                    let rows = self.rows(if text == "[" { "]" } else { "}" });
                    self.brackets.pop();
                    self.node(Form::Matrix(rows?, text == "{"), start)
                }
                "{" => {
                    self.at += 1;
                    let unread = self.unread(self.at, "}");
                    self.take("}");
                    // Dictionaries and sets; `,` parts what they hold.
                    let mut unread = unread?;
                    while self.tokens[self.at - 1].span.end == unread.span.end && self.word() == "," {
                        self.at += 1;
                        unread = self.unread(self.at, "}")?;
                        self.take("}");
                    }
                    self.node(Form::Other, start)
                }
                _ => None,
            },
            _ => None,
        }
    }

    /// What stands in brackets of Python: a value, a list, or one for each.
    fn listed(&mut self, close: &str, start: usize) -> Option<Node> {
        let mut all = vec![];
        let mut commas = 0;
        while !self.take(close) {
            let value = self.value()?;
            if self.word() == "for" {
                let each = self.each(value, start)?;
                return self.take(close).then_some(each);
            }
            all.push(value);
            if self.take(",") {
                commas += 1;
            } else if self.word() != close {
                return None;
            }
        }
        if close == ")" && commas == 0 && all.len() == 1 {
            return all.pop();
        }
        self.node(Form::List(all), start)
    }

    fn rows(&mut self, close: &str) -> Option<Vec<Vec<Node>>> {
        let mut rows: Vec<Vec<Node>> = vec![vec![]];
        while !self.take(close) {
            if self.kind() == Kind::Line {
                self.at += 1;
                rows.push(vec![]);
            } else if !self.take(",") {
                // `1d-3` is one number, which is not read.
                let last = self.tokens.get(self.at.wrapping_sub(1)).map(|t| &self.text[t.span.clone()]);
                let begins = last.is_none_or(|word| ["[", "{", ","].contains(&word)) || self.token().apart;
                let is_behind_value = rows.last().is_some_and(|r| !r.is_empty());
                if is_behind_value && !begins {
                    return None;
                }
                let value = self.value()?;
                rows.last_mut()?.push(value);
            }
        }
        rows.retain(|r| !r.is_empty());
        Some(rows)
    }
}
