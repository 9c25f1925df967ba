//! Statements and blocks of MATLAB and of Python.

use super::code::Kind;
use super::parse::{Act, Form, Function, MAX_DEPTH, Node, Parser, Round, Statement};

/// How often each word may be read.
const MAX_WORK: usize = 200;

impl Parser<'_> {
    /// Statements up to a dedent, or to one of these words.
    pub(super) fn block(&mut self, ends: &[&str]) -> Vec<Statement> {
        let mut found = vec![];
        loop {
            match self.kind() {
                Kind::End => break,
                Kind::Dedent => {
                    self.at += 1;
                    if self.depth > 0 {
                        break;
                    }
                }
                Kind::Line => self.at += 1,
                Kind::Indent => self.at += 1,
                _ if ends.contains(&self.word()) => break,
                _ if self.is_too_much() => self.at = self.tokens.len() - 1,
                _ => {
                    let (start, before) = (self.start(), self.at);
                    let act = self.statement();
                    self.brackets.clear();
                    let act = match act {
                        Some(act) if self.is_ended(before) => act,
                        _ => self.left(before),
                    };
                    self.work += 1 + self.at.saturating_sub(before);
                    found.push(Statement { act, span: start..self.end().max(start) });
                }
            }
        }
        found
    }

    /// Whether so much was read that the rest is left.
    pub(super) fn is_too_much(&self) -> bool {
        self.work > MAX_WORK * self.tokens.len()
    }

    /// True at the end of a statement, which `,` ends too in MATLAB.
    fn is_ended(&mut self, before: usize) -> bool {
        if self.at == before {
            return false;
        }
        let behind_block = matches!(self.tokens[self.at - 1].kind, Kind::Dedent | Kind::Line)
            || (!self.is_python()
                && matches!(&self.text[self.tokens[self.at - 1].span.clone()], "end" | "else"));
        let ended = matches!(self.kind(), Kind::Line | Kind::End | Kind::Dedent | Kind::Indent);
        ended || behind_block || (!self.is_python() && self.take(","))
    }

    /// A statement that is not understood, up to its end.
    fn left(&mut self, from: usize) -> Act {
        self.at = from;
        let first = self.word().to_string();
        let mut names = vec![];
        let mut open = 0_usize;
        let mut has_equals = false;
        loop {
            match self.kind() {
                Kind::End => break,
                Kind::Line | Kind::Dedent if open == 0 => break,
                Kind::Name => names.push(self.word().to_string()),
                Kind::Sign => match self.word() {
                    "(" | "[" | "{" => open += 1,
                    ")" | "]" | "}" => open = open.saturating_sub(1),
                    "=" => has_equals = true,
                    _ => {}
                },
                _ => {}
            }
            self.at += 1;
        }
        let ends_in_colon = self.at > from && self.text[self.tokens[self.at - 1].span.clone()] == *":";
        // Words of a text may begin so too.
        let is_head = match first.as_str() {
            "for" | "parfor" if !self.is_python() => has_equals,
            "if" | "elseif" | "else" | "while" | "switch" | "try" | "function" | "case"
                if !self.is_python() =>
            {
                true
            }
            "for" | "if" | "elif" | "else" | "while" | "with" | "try" | "except" | "finally" | "def"
            | "class" | "async" | "match" => self.is_python() && ends_in_colon,
            _ => false,
        };
        if is_head { Act::Unread } else { Act::Other(names) }
    }

    pub(super) fn deeper<T>(&mut self, read: impl FnOnce(&mut Self) -> Option<T>) -> Option<T> {
        if self.depth >= MAX_DEPTH {
            return None;
        }
        self.depth += 1;
        let found = read(self);
        self.depth -= 1;
        found
    }

    fn statement(&mut self) -> Option<Act> {
        if self.kind() == Kind::Name && !self.second().starts_with('=') {
            let found = if self.is_python() { self.python() } else { self.matlab() };
            if let Some(found) = found {
                return found;
            }
        }
        self.simple()
    }

    /// A value, or names that are said to be one.
    fn simple(&mut self) -> Option<Act> {
        let mut targets = vec![self.values()?];
        let sign = self.word().to_string();
        if self.is_python() && sign == ":" {
            // A type.
            if !matches!(&targets[0].form, Form::Name(_) | Form::Attribute(..))
                || ["else", "try", "finally"].contains(&&self.text[targets[0].span.clone()])
            {
                return None;
            }
            self.at += 1;
            self.value()?;
        }
        let augmented = sign.strip_suffix('=').filter(|s| ["+", "-", "*", "/", "**", "//"].contains(s));
        if let Some(sign) = augmented {
            self.at += 1;
            return Some(Act::Assign(targets, sign.to_string(), self.values()?));
        }
        let mut value = None;
        while self.take("=") {
            targets.extend(value.replace(self.values()?));
        }
        match value {
            Some(value) => Some(Act::Assign(targets, String::new(), value)),
            None => targets.pop().map(Act::Value),
        }
    }

    /// Values between commas are a list of Python.
    pub(super) fn values(&mut self) -> Option<Node> {
        let first = self.value()?;
        if !self.is_python() || self.word() != "," {
            return Some(first);
        }
        let start = first.span.start;
        let mut all = vec![first];
        while self.take(",") {
            if matches!(self.kind(), Kind::Line | Kind::End) || self.word() == "=" {
                break;
            }
            all.push(self.value()?);
        }
        self.node(Form::List(all), start)
    }

    /// A block of MATLAB, up to `end`.
    fn body(&mut self, ends: &[&str]) -> Option<Vec<Statement>> {
        self.deeper(|p| {
            p.take(",");
            let all: Vec<&str> = ["end", "endfor", "endif", "endwhile", "endfunction", "function"]
                .iter()
                .chain(ends)
                .copied()
                .collect();
            Some(p.block(&all))
        })
    }

    fn close(&mut self) {
        if self.word().starts_with("end") {
            self.at += 1;
        }
    }

    /// A statement of MATLAB that begins with a word of its own.
    fn matlab(&mut self) -> Option<Option<Act>> {
        let word = self.word().to_string();
        let is_command = !matches!(self.second(), "(" | "=" | "." | "{");
        let act = match word.as_str() {
            "for" | "parfor" => {
                self.at += 1;
                let bracket = self.take("(");
                let target = self.value();
                let ok = self.take("=");
                let (Some(target), true, Some(values)) = (target, ok, self.value()) else {
                    return Some(None);
                };
                if bracket {
                    self.take(")");
                }
                let body = self.body(&[]);
                self.close();
                body.map(|body| Act::For(Round { target, values, conditions: vec![] }, body))
            }
            "if" => self.matlab_if(),
            "while" => {
                self.at += 1;
                let head = self.value();
                let body = self.body(&[]);
                self.close();
                head.and(body).map(|body| Act::Unsure(vec![body]))
            }
            "switch" | "try" => {
                self.at += 1;
                let mut blocks = vec![];
                loop {
                    blocks.extend(self.body(&["case", "otherwise", "catch"]));
                    if !["case", "otherwise", "catch"].contains(&self.word()) {
                        break;
                    }
                    self.at += 1;
                    while !matches!(self.kind(), Kind::Line | Kind::End) {
                        self.at += 1;
                    }
                }
                self.close();
                Some(if word == "try" { Act::Try(blocks) } else { Act::Unsure(blocks) })
            }
            "function" => self.matlab_function(),
            "global" | "persistent" | "do" | "until" | "unwind_protect" | "arguments" | "classdef"
                if is_command || word == "do" =>
            {
                self.left(self.at);
                Some(Act::Unread)
            }
            "return" => self.one(Act::Return(None)),
            "break" => self.one(Act::Break),
            "continue" => self.one(Act::Continue),
            "syms" | "clear" | "clearvars" if is_command => {
                self.at += 1;
                let mut names = vec![];
                while self.kind() == Kind::Name {
                    names.extend(self.name());
                }
                if word != "syms" && names.is_empty() {
                    names.push("all".into());
                }
                Some(Act::Free(names))
            }
            "close" | "clc" | "hold" | "format" | "figure" | "more" | "pkg" | "warning" | "disp"
            | "addpath"
                if is_command =>
            {
                self.left(self.at);
                Some(Act::Nothing)
            }
            _ => return None,
        };
        Some(act)
    }

    fn one(&mut self, act: Act) -> Option<Act> {
        self.at += 1;
        Some(act)
    }

    fn matlab_if(&mut self) -> Option<Act> {
        self.at += 1;
        let mut blocks = vec![];
        let mut condition = Some(self.value()?);
        loop {
            self.take(",");
            blocks.push((condition, self.body(&["else", "elseif"])?));
            if self.take("elseif") {
                condition = Some(self.value()?);
            } else if self.take("else") {
                condition = None;
            } else {
                break;
            }
        }
        self.close();
        Some(Act::If(blocks))
    }

    fn matlab_function(&mut self) -> Option<Act> {
        self.at += 1;
        let mut results = vec![];
        let name = if self.take("[") {
            while self.word() != "]" && !matches!(self.kind(), Kind::End | Kind::Line) {
                match self.name() {
                    Some(name) => results.push(name),
                    None => self.at += 1,
                }
            }
            self.take("]");
            self.take("=");
            self.name()?
        } else {
            let first = self.name()?;
            match self.take("=") {
                true => {
                    results.push(first);
                    self.name()?
                }
                false => first,
            }
        };
        let mut parameters = vec![];
        if self.take("(") {
            while self.word() != ")" && !matches!(self.kind(), Kind::End | Kind::Line) {
                match self.name() {
                    Some(name) => parameters.push((name, None)),
                    None => self.at += 1,
                }
            }
            self.take(")");
        }
        let body = self.body(&[])?;
        self.close();
        Some(Act::Function(Box::new(Function { name, parameters, results, body })))
    }

    /// The block behind `:`.
    fn suite(&mut self) -> Option<Vec<Statement>> {
        if !self.take(":") {
            return None;
        }
        self.deeper(|p| {
            if p.kind() != Kind::Line {
                // On the same line.
                let start = p.start();
                let before = p.at;
                let act = p.statement().unwrap_or(Act::Nothing);
                let act = if p.is_ended(before) { act } else { p.left(before) };
                return Some(vec![Statement { act, span: start..p.end() }]);
            }
            while p.kind() == Kind::Line {
                p.at += 1;
            }
            if p.kind() != Kind::Indent {
                return Some(vec![]);
            }
            p.at += 1;
            Some(p.block(&[]))
        })
    }

    /// A statement of Python that begins with a word of its own.
    fn python(&mut self) -> Option<Option<Act>> {
        let word = self.word().to_string();
        let act = match word.as_str() {
            "for" => {
                self.at += 1;
                let round = self.round();
                let body = round.is_some().then(|| self.suite()).flatten();
                round.zip(body).map(|(round, body)| Act::For(round, body))
            }
            "if" => self.python_if(),
            "while" => {
                self.at += 1;
                self.value().and_then(|_| self.suite()).map(|body| Act::Unsure(vec![body]))
            }
            "with" => {
                self.at += 1;
                while self.word() != ":" && !matches!(self.kind(), Kind::Line | Kind::End) {
                    self.at += 1;
                }
                self.suite().map(Act::Block)
            }
            "try" => {
                self.at += 1;
                let mut blocks = vec![];
                blocks.extend(self.suite());
                self.skip_lines_before(&["except", "else", "finally"]);
                while ["except", "else", "finally"].contains(&self.word()) {
                    while self.word() != ":" && !matches!(self.kind(), Kind::Line | Kind::End) {
                        self.at += 1;
                    }
                    blocks.extend(self.suite());
                    self.skip_lines_before(&["except", "else", "finally"]);
                }
                Some(Act::Try(blocks))
            }
            "def" => self.python_function(),
            "class" => {
                self.at += 1;
                let name = self.name();
                while self.word() != ":" && !matches!(self.kind(), Kind::Line | Kind::End) {
                    self.at += 1;
                }
                name.and_then(|name| Some(Act::Class(name, self.suite()?)))
            }
            "return" => {
                self.at += 1;
                let is_bare = matches!(self.kind(), Kind::Line | Kind::End | Kind::Dedent);
                if is_bare { Some(Act::Return(None)) } else { self.values().map(|v| Act::Return(Some(v))) }
            }
            "break" => self.one(Act::Break),
            "continue" => self.one(Act::Continue),
            "pass" => self.one(Act::Nothing),
            "import" | "from" => self.import(),
            "raise" | "assert" => {
                self.left(self.at);
                Some(Act::Nothing)
            }
            "global" | "nonlocal" => {
                self.left(self.at);
                Some(Act::Unread)
            }
            _ => return None,
        };
        Some(act)
    }

    fn import(&mut self) -> Option<Act> {
        let mut names: Vec<(String, String)> = vec![];
        let is_from = self.word() == "from";
        while !matches!(self.kind(), Kind::Line | Kind::End) {
            if self.take("as") {
                if let (Some(last), Some(name)) = (names.last_mut(), self.name()) {
                    last.0 = name;
                }
            } else {
                match self.name() {
                    Some(name) if name == "import" => names.clear(),
                    Some(name) => names.push((name.clone(), name)),
                    None => self.at += 1,
                }
            }
        }
        Some(if is_from { Act::Import(names) } else { Act::Nothing })
    }

    /// Ends of lines before one of these words.
    fn skip_lines_before(&mut self, words: &[&str]) {
        let lines = self.tokens[self.at..].iter().take_while(|t| t.kind == Kind::Line).count();
        let behind = self.tokens.get(self.at + lines).map(|t| &self.text[t.span.clone()]);
        if behind.is_some_and(|word| words.contains(&word)) {
            self.at += lines;
        }
    }

    fn python_if(&mut self) -> Option<Act> {
        let mut blocks = vec![];
        self.at += 1;
        let mut condition = Some(self.value()?);
        loop {
            blocks.push((condition, self.suite()?));
            self.skip_lines_before(&["elif", "else"]);
            if self.take("elif") {
                condition = Some(self.value()?);
            } else if self.take("else") {
                condition = None;
            } else {
                return Some(Act::If(blocks));
            }
        }
    }

    fn python_function(&mut self) -> Option<Act> {
        self.at += 1;
        let name = self.name()?;
        let mut parameters = vec![];
        if !self.take("(") {
            return None;
        }
        while !self.take(")") {
            match self.kind() {
                Kind::Name => {
                    let name = self.name()?;
                    if self.take(":") {
                        self.value()?;
                    }
                    let value = if self.take("=") { Some(self.value()?) } else { None };
                    parameters.push((name, value));
                }
                // `*all` and `**named` take what is left.
                Kind::Sign if self.word().starts_with('*') => return None,
                Kind::Sign => self.at += 1,
                _ => return None,
            }
        }
        if self.take("->") {
            self.value()?;
        }
        Some(Act::Function(Box::new(Function { name, parameters, results: vec![], body: self.suite()? })))
    }

    /// `names in values if all`
    pub(super) fn round(&mut self) -> Option<Round> {
        let start = self.start();
        let mut targets = vec![];
        loop {
            targets.push(self.unary()?);
            if !self.take(",") {
                break;
            }
        }
        if !self.take("in") {
            return None;
        }
        let target = if targets.len() == 1 { targets.pop()? } else { self.node(Form::List(targets), start)? };
        let values = self.sums(0)?;
        let mut conditions = vec![];
        while self.take("if") {
            conditions.push(self.sums(0)?);
        }
        Some(Round { target, values, conditions })
    }
}
