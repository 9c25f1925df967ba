//! C and C++ without pointers' arithmetic, as the tokens of Python that say the same: `{ … }` is a block, `double x = …;` gives a
//! name its value, what a function writes to its arguments (`double T[4][4]`, `float *x`) is what it gives back, and `p.x` of a
//! structure is a name.

mod arguments;
mod blocks;
mod commas;
mod tokens;

use super::Dialect;
use super::grammar::Parser;
use super::lexer::{Mark, Token};
use super::python;
use super::tree::{Span, Statement};
use denavit_symbolic::Rational;
use denavit_symbolic::parse::ParseError;
use std::collections::{BTreeMap, BTreeSet};
use tokens::lexed;

/// Words of types and of storage, which say nothing here.
const TYPES: &[&str] = &[
    "double",
    "float",
    "int",
    "long",
    "short",
    "unsigned",
    "signed",
    "char",
    "bool",
    "void",
    "const",
    "static",
    "inline",
    "extern",
    "constexpr",
    "auto",
    "volatile",
    "register",
    "real",
    "real_t",
    "float64_t",
    "float32_t",
    "size_t",
    "uint8_t",
    "int32_t",
    "struct",
];
/// The longest array that is set aside.
const MAX_LENGTH: usize = 64;

/// The statements of a part of a text.
pub(super) fn parse(text: &str, span: &Span) -> (Vec<Statement>, Vec<ParseError>) {
    let tokens = Writer::new(lexed(text, span)).program();
    let parser = Parser {
        text,
        tokens,
        at: 0,
        language: Dialect::Python,
        in_matrix: false,
        depth: 0,
        in_index: false,
        errors: vec![],
    };
    python::statements(parser)
}

/// Writes the tokens of Python.
struct Writer {
    tokens: Vec<Token>,
    at: usize,
    out: Vec<Token>,
    /// Of the function that is written: what its arguments and structures are.
    outputs: Vec<String>,
    fields: BTreeMap<String, Vec<String>>,
    /// Structures that it only reads: their fields are names.
    read: BTreeSet<String>,
    /// Where its body ends.
    end: usize,
    depth: usize,
}

impl Writer {
    fn new(tokens: Vec<Token>) -> Self {
        Writer {
            tokens,
            at: 0,
            out: vec![],
            outputs: vec![],
            fields: BTreeMap::new(),
            read: BTreeSet::new(),
            end: 0,
            depth: 0,
        }
    }

    fn program(mut self) -> Vec<Token> {
        while self.at < self.tokens.len() {
            let before = self.at;
            if !self.function() {
                self.statement();
            }
            self.at = self.at.max(before + 1);
        }
        self.put(Mark::Newline);
        self.out
    }

    fn op(&self, k: usize) -> &'static str {
        match self.tokens.get(k).map(|t| &t.mark) {
            Some(Mark::Op(op)) => op,
            _ => "",
        }
    }

    fn name(&self, k: usize) -> Option<&str> {
        match self.tokens.get(k).map(|t| &t.mark) {
            Some(Mark::Name(name)) => Some(name),
            _ => None,
        }
    }

    /// A token of its own at the present place.
    fn put(&mut self, mark: Mark) {
        let last = self.tokens.last().map_or(0, |t| t.span.end);
        let place = self.tokens.get(self.at).map_or(last, |t| t.span.start);
        self.out.push(Token { mark, span: place..place, is_apart: true });
    }

    fn word(&mut self, word: &str) {
        self.put(Mark::Name(word.into()));
    }

    /// The place behind the bracket that closes the one at `k`.
    fn behind(&self, k: usize) -> usize {
        let mut depth = 0_usize;
        for i in k..self.tokens.len() {
            match self.op(i) {
                "(" | "[" | "{" => depth += 1,
                ")" | "]" | "}" => {
                    depth = depth.saturating_sub(1);
                    if depth == 0 {
                        return i + 1;
                    }
                }
                _ => {}
            }
        }
        self.tokens.len()
    }

    /// `type name(parameters) {`, up to the end of its body.
    fn function(&mut self) -> bool {
        let mut k = self.behind_type(self.at).unwrap_or(self.at);
        while self.name(k).is_some() && self.name(k + 1).is_some()
            || self.name(k).is_some() && matches!(self.op(k + 1), "*" | "&")
        {
            k += 1 + usize::from(matches!(self.op(k + 1), "*" | "&"));
        }
        // `Arm::fk`
        while self.name(k).is_some() && self.op(k + 1) == "::" {
            k += 2;
        }
        let (Some(name), "(") = (self.name(k).map(str::to_string), self.op(k + 1)) else { return false };
        let close = self.behind(k + 1);
        let body = if self.name(close) == Some("const") { close + 1 } else { close };
        if self.op(body) != "{" || k == self.at {
            return false;
        }
        let end = self.behind(body);
        self.outputs.clear();
        self.fields = self.written(body, end);
        self.end = end;
        self.out.push(Token { mark: Mark::Name("def".into()), ..self.tokens[self.at].clone() });
        self.out.push(Token { mark: Mark::Name(name), ..self.tokens[k].clone() });
        self.out.push(self.tokens[k + 1].clone());
        let sizes = self.parameters(k + 2, close - 1, body, end);
        self.out.push(self.tokens[close - 1].clone());
        self.at = body;
        self.put(Mark::Op(":"));
        self.put(Mark::Newline);
        self.put(Mark::Indent);
        for (name, size) in sizes {
            self.zeros(&name, &size);
        }
        self.at = body + 1;
        while self.at + 1 < end {
            let before = self.at;
            self.statement();
            self.at = self.at.max(before + 1);
        }
        if !self.outputs.is_empty() {
            self.word("return");
            for (k, name) in self.outputs.clone().iter().enumerate() {
                if k > 0 {
                    self.put(Mark::Op(","));
                }
                self.word(name);
            }
        } else {
            self.word("pass");
        }
        self.put(Mark::Newline);
        self.put(Mark::Dedent);
        self.at = end;
        self.end = 0;
        self.fields.clear();
        self.read.clear();
        true
    }

    /// The place behind a type with parameters, `std::array<double, 3>`, perhaps a reference, before a name.
    fn behind_type(&self, from: usize) -> Option<usize> {
        let mut k = from;
        while self.name(k) == Some("const") || self.name(k) == Some("static") {
            k += 1;
        }
        while self.name(k).is_some() && self.op(k + 1) == "::" {
            k += 2;
        }
        if self.name(k).is_none() || self.op(k + 1) != "<" {
            return None;
        }
        let mut depth = 0_usize;
        let mut i = k + 1;
        loop {
            match self.op(i) {
                "<" => depth += 1,
                ">" => depth = depth.saturating_sub(1),
                ">>" => depth = depth.saturating_sub(2),
                "," | "::" | "*" | "&" => {}
                "" if i < self.tokens.len() => {}
                _ => return None,
            }
            i += 1;
            if depth == 0 {
                break;
            }
        }
        while matches!(self.op(i), "*" | "&") {
            i += 1;
        }
        self.name(i).is_some().then_some(i)
    }

    /// `name = np.zeros((4, 4))`
    fn zeros(&mut self, name: &str, size: &[usize]) {
        self.word(name);
        self.put(Mark::Op("="));
        self.word("np");
        self.put(Mark::Op("."));
        self.word("zeros");
        self.put(Mark::Op("("));
        self.put(Mark::Op("("));
        for n in size {
            self.put(Mark::Number(Rational::from(i64::try_from(*n).unwrap_or(0)), true));
            self.put(Mark::Op(","));
        }
        self.put(Mark::Op(")"));
        self.put(Mark::Op(")"));
        self.put(Mark::Newline);
    }

    /// The name that stands for a field.
    fn field(&self, base: &str, field: &str) -> String {
        let is_lone = self.fields.len() <= 1 && self.fields.contains_key(base);
        if is_lone { field.to_string() } else { format!("{base}_{field}") }
    }

    /// One statement, or one block.
    fn statement(&mut self) {
        match self.op(self.at) {
            ";" | "}" => {
                self.at += 1;
                return;
            }
            "{" => {
                let end = self.behind(self.at);
                self.at += 1;
                self.block(end);
                return;
            }
            _ => {}
        }
        if self.name(self.at) == Some("for") && self.counted_loop() || self.comma_initialised() {
            return;
        }
        match self.name(self.at) {
            Some("typedef" | "using" | "namespace" | "enum" | "template" | "class") => {
                return self.passed_over();
            }
            Some("struct") if self.op(self.at + 2) == "{" => return self.passed_over(),
            Some("for" | "while" | "do" | "switch" | "goto") => return self.refused(),
            Some("if") if self.op(self.at + 1) == "(" => return self.branches(),
            _ => {}
        }
        if self.inner_function() {
            return;
        }
        // Types, and the casts and stars of what they declare.
        let is_return = self.name(self.at) == Some("return");
        let mut is_declared = false;
        if let Some(k) = self.behind_type(self.at).filter(|_| !is_return) {
            (self.at, is_declared) = (k, true);
        }
        while !is_return
            && (self.name(self.at).is_some_and(|w| TYPES.contains(&w))
                || self.name(self.at).is_some() && (self.name(self.at + 1).is_some()))
        {
            self.at += 1;
            is_declared = true;
        }
        while matches!(self.op(self.at), "*" | "&") {
            self.at += 1;
        }
        if is_return {
            self.out.push(self.tokens[self.at].clone());
            self.at += 1;
            if let Some(name) = self.name(self.at).filter(|_| self.op(self.at + 1) == ";")
                && let Some(fields) = self.fields.get(name)
            {
                let names: Vec<String> = fields.iter().map(|f| self.field(name, f)).collect();
                for (k, name) in names.iter().enumerate() {
                    if k > 0 {
                        self.put(Mark::Op(","));
                    }
                    self.word(name);
                }
                self.put(Mark::Newline);
                self.at += 2;
                return;
            }
            if self.op(self.at) == ";" && !self.outputs.is_empty() {
                let names = self.outputs.clone();
                for (k, name) in names.iter().enumerate() {
                    if k > 0 {
                        self.put(Mark::Op(","));
                    }
                    self.word(name);
                }
            }
        }
        // One declarator after another.
        loop {
            if is_declared
                && let Some(name) = self.name(self.at).map(str::to_string)
                && matches!(self.op(self.at + 1), ";" | "," | "[")
            {
                let size = match self.op(self.at + 1) {
                    "[" => self.size(self.at, &name, 0, 0),
                    // `Mat3 J;` whose entries are set one by one.
                    _ if self.is_written(&name, self.at, self.end) => {
                        self.size(self.at, &name, self.at + 1, self.end)
                    }
                    _ => None,
                };
                let mut k = self.at + 1;
                while self.op(k) == "[" {
                    k = self.behind(k);
                }
                if self.op(k) != "=" {
                    if let Some(size) = size {
                        self.zeros(&name, &size);
                    }
                    self.at = k + 1;
                    if self.op(k) == "," {
                        continue;
                    }
                    return;
                }
                self.out.push(self.tokens[self.at].clone());
                self.at = k;
            }
            if !self.expression(is_declared) {
                break;
            }
        }
    }

    /// Up to the end of the statement, or of a declarator; true if another one follows.
    fn expression(&mut self, is_declared: bool) -> bool {
        let mut depth = 0_usize;
        let start = self.out.len();
        let mut is_array = false;
        while self.at < self.tokens.len() {
            let op = self.op(self.at);
            match op {
                ";" if depth == 0 => break,
                "," if depth == 0 && is_declared => {
                    self.put(Mark::Newline);
                    self.at += 1;
                    while self.op(self.at) == "*" {
                        self.at += 1;
                    }
                    return true;
                }
                "(" if self.name(self.at + 1).is_some_and(|w| TYPES.contains(&w))
                    && self.op(self.at + 2) == ")" =>
                {
                    self.at += 3; // a cast
                    continue;
                }
                "(" | "[" => depth += 1,
                "{" => {
                    depth += 1;
                    is_array = true;
                    self.put(Mark::Op("["));
                    self.at += 1;
                    continue;
                }
                "}" if depth == 0 => break,
                "}" => {
                    depth -= 1;
                    self.put(Mark::Op("]"));
                    self.at += 1;
                    continue;
                }
                ")" | "]" => depth = depth.saturating_sub(1),
                "&&" | "||" | "!" => {
                    let word = match op {
                        "&&" => "and",
                        "||" => "or",
                        _ => "not",
                    };
                    self.out.push(Token { mark: Mark::Name(word.into()), ..self.tokens[self.at].clone() });
                    self.at += 1;
                    continue;
                }
                "++" | "--" | "<<" | ">>" | "<<=" | ">>=" => {
                    let bad = Mark::Bad(format!("`{op}` is not read"));
                    self.out.push(Token { mark: bad, ..self.tokens[self.at].clone() });
                    self.at += 1;
                    continue;
                }
                "&" if self.name(self.at + 1).is_some() => {
                    self.at += 1;
                    continue;
                }
                _ => {}
            }
            self.token();
        }
        if is_array {
            // `{{…}, {…}}` is an array, not a list.
            let equals = (start..self.out.len()).find(|&i| self.out[i].mark == Mark::Op("="));
            if let Some(i) = equals {
                let place = self.out[i].span.end;
                let own = |mark| Token { mark, span: place..place, is_apart: true };
                let words =
                    [Mark::Name("np".into()), Mark::Op("."), Mark::Name("array".into()), Mark::Op("(")];
                self.out.splice(i + 1..i + 1, words.map(own));
                self.put(Mark::Op(")"));
            }
        }
        self.put(Mark::Newline);
        if self.op(self.at) == ";" {
            self.at += 1;
        }
        false
    }

    /// A token as it is, names as NumPy has them.
    fn token(&mut self) {
        let token = self.tokens[self.at].clone();
        let Some(name) = self.name(self.at).map(str::to_string) else {
            self.out.push(token);
            self.at += 1;
            return;
        };
        if name == "std" && self.op(self.at + 1) == "::" || name == "Math" && self.op(self.at + 1) == "." {
            self.at += 2;
            return;
        }
        if let ("." | "->", Some(field)) = (self.op(self.at + 1), self.name(self.at + 2)) {
            let is_own = name == "this" || self.read.contains(&name);
            let name = if is_own { field.to_string() } else { self.field(&name, field) };
            let span = token.span.start..self.tokens[self.at + 2].span.end;
            self.out.push(Token { mark: Mark::Name(name), span, is_apart: token.is_apart });
            // `p.x()` is a field, too.
            let is_component = matches!(self.name(self.at + 2), Some("x" | "y" | "z"));
            let is_call = is_component && self.op(self.at + 3) == "(" && self.op(self.at + 4) == ")";
            self.at += if is_call { 5 } else { 3 };
            return;
        }
        let plain = name.strip_suffix('f').filter(|n| {
            matches!(
                *n,
                "sin"
                    | "cos"
                    | "tan"
                    | "sqrt"
                    | "atan2"
                    | "acos"
                    | "asin"
                    | "atan"
                    | "fabs"
                    | "pow"
                    | "hypot"
            )
        });
        let name = match plain.unwrap_or(&name) {
            "M_PI" | "PI" => "pi",
            "fabs" => "abs",
            name => name,
        };
        self.out.push(Token { mark: Mark::Name(name.to_string()), ..token });
        self.at += 1;
    }
}
