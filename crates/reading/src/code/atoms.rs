//! What an expression begins with: numbers, names, brackets, matrices and functions without a name.

use super::Dialect;
use super::grammar::{Parsed, Parser};
use super::lexer::Mark;
use super::tree::{Definition, Kind, Node, Parameter, Span, Statement, StatementKind, Suffix, SuffixKind};
use denavit_symbolic::parse::ParseError;

/// Words that begin no value.
const PYTHON_WORDS: &[&str] = &[
    "and", "as", "assert", "async", "await", "break", "class", "continue", "def", "del", "elif", "else",
    "except", "finally", "for", "from", "global", "if", "import", "in", "is", "nonlocal", "or", "pass",
    "raise", "return", "try", "while", "with", "yield",
];
const MATLAB_WORDS: &[&str] = &[
    "break",
    "case",
    "catch",
    "classdef",
    "continue",
    "else",
    "elseif",
    "end",
    "for",
    "function",
    "global",
    "if",
    "otherwise",
    "parfor",
    "persistent",
    "return",
    "switch",
    "try",
    "while",
];

impl Parser<'_> {
    pub fn primary(&mut self) -> Parsed<Node> {
        let start = self.at;
        let is_matlab = self.language == Dialect::Matlab;
        let kind = match self.mark() {
            Some(Mark::Number(r, is_whole)) => Kind::Number(r.clone(), *is_whole),
            Some(Mark::Text(text)) => {
                let mut text = text.clone();
                while let (Some(Mark::Text(more)), false) =
                    (self.tokens.get(self.at + 1).map(|t| &t.mark), is_matlab)
                {
                    text.push_str(more);
                    self.at += 1;
                }
                Kind::Text(text)
            }
            Some(Mark::Name(word)) => match word.as_str() {
                "end" if is_matlab && self.in_index => Kind::End,
                word if is_matlab && MATLAB_WORDS.contains(&word) => return Err(self.unexpected("a value")),
                word if !is_matlab && PYTHON_WORDS.contains(&word) => return Err(self.unexpected("a value")),
                word => Kind::Name(word.to_string()),
            },
            Some(Mark::Op("(")) => return self.nested(Self::bracketed),
            Some(Mark::Op("[")) if is_matlab => return self.nested(|p| p.rows("]")),
            Some(Mark::Op("{")) if is_matlab => return self.nested(|p| p.rows("}")),
            Some(Mark::Op("[")) => return self.nested(Self::list),
            Some(Mark::Op("{")) => return self.nested(Self::dictionary),
            Some(Mark::Op("@")) if is_matlab => return self.nested(Self::anonymous),
            _ => return Err(self.unexpected("a value")),
        };
        self.at += 1;
        Ok(self.node(kind, start))
    }

    fn bracketed(&mut self) -> Parsed<Node> {
        let start = self.at;
        self.at += 1;
        let outer = std::mem::replace(&mut self.in_matrix, false);
        let inner = self.inside_brackets(start);
        self.in_matrix = outer;
        inner
    }

    fn inside_brackets(&mut self, start: usize) -> Parsed<Node> {
        if self.eat(")") {
            return Ok(self.node(Kind::Tuple(vec![]), start));
        }
        let inner = match self.language {
            Dialect::Python | Dialect::C => self.expressions()?,
            Dialect::Matlab => self.expression()?,
        };
        let inner = self.comprehension(inner)?;
        self.expect(")")?;
        Ok(self.node(Kind::Bracket(Box::new(inner)), start))
    }

    fn list(&mut self) -> Parsed<Node> {
        let start = self.at;
        self.at += 1;
        let mut parts = vec![];
        while !self.eat("]") {
            let item = self.starred()?;
            if self.is_word("for") && parts.is_empty() {
                let list = self.comprehension(item)?;
                self.expect("]")?;
                return Ok(Node { kind: list.kind, span: self.since(start) });
            }
            parts.push(item);
            if !self.eat(",") && !self.is_op("]") {
                return Err(self.unexpected("`,` or `]`"));
            }
        }
        Ok(self.node(Kind::List(parts), start))
    }

    /// `{q1: 0.3, q2: 0.5}` as a list of pairs.
    fn dictionary(&mut self) -> Parsed<Node> {
        let start = self.at;
        self.at += 1;
        let mut pairs = vec![];
        while !self.eat("}") {
            let from = self.at;
            let key = self.expression()?;
            if !self.eat(":") {
                let e = ParseError::new(self.here(), "a set is not read");
                return Err(e.hint("write a list"));
            }
            let value = self.expression()?;
            pairs.push(self.node(Kind::List(vec![key, value]), from));
            if !self.eat(",") && !self.is_op("}") {
                return Err(self.unexpected("`,` or `}`"));
            }
        }
        Ok(self.node(Kind::List(pairs), start))
    }

    fn rows(&mut self, close: &str) -> Parsed<Node> {
        let start = self.at;
        self.at += 1;
        let outer = std::mem::replace(&mut self.in_matrix, true);
        let read = self.row_list(close);
        self.in_matrix = outer;
        let rows = read?;
        let kind = if close == "]" { Kind::Rows(rows) } else { Kind::Cells(rows) };
        Ok(self.node(kind, start))
    }

    fn row_list(&mut self, close: &str) -> Parsed<Vec<Vec<Node>>> {
        let (mut rows, mut row) = (vec![], vec![]);
        loop {
            if self.is_op(";") || self.is_op(close) {
                if !row.is_empty() {
                    rows.push(std::mem::take(&mut row));
                }
                if self.eat(close) {
                    return Ok(rows);
                }
                self.at += 1;
            } else if !self.eat(",") {
                row.push(self.expression()?);
            }
        }
    }

    /// `@(x) x + 1`, or `@cos`.
    fn anonymous(&mut self) -> Parsed<Node> {
        let start = self.at;
        self.at += 1;
        if !self.eat("(") {
            let (name, _) = self.word("a name or `(` behind `@`")?;
            return Ok(self.node(Kind::Name(name), start));
        }
        let mut parameters = vec![];
        while !self.eat(")") {
            let (name, span) = self.word("a name")?;
            parameters.push(Parameter { name, span, default: None });
            if !self.eat(",") && !self.is_op(")") {
                return Err(self.unexpected("`,` or `)`"));
            }
        }
        let outer = std::mem::replace(&mut self.in_matrix, false);
        let body = self.expression();
        self.in_matrix = outer;
        Ok(self.unnamed(parameters, body?, start))
    }

    pub fn lambda(&mut self) -> Parsed<Node> {
        let start = self.at;
        self.at += 1;
        let parameters = self.parameters(":")?;
        let body = self.expression()?;
        Ok(self.unnamed(parameters, body, start))
    }

    fn unnamed(&self, parameters: Vec<Parameter>, value: Node, start: usize) -> Node {
        let span = self.since(start);
        let body = vec![Statement { span: value.span.clone(), kind: StatementKind::Return(Some(value)) }];
        let name = "the function".to_string();
        let definition = Definition { name, span: span.clone(), parameters, outputs: vec![], body };
        Node { kind: Kind::Lambda(Box::new(definition)), span }
    }

    /// Parameters of Python up to a bracket or colon; their types are passed over.
    pub fn parameters(&mut self, close: &str) -> Parsed<Vec<Parameter>> {
        let mut parameters = vec![];
        while !self.eat(close) {
            if self.eat("/") || (self.is_op("*") && self.next_is(",")) {
                self.at += usize::from(self.is_op("*"));
            } else {
                if self.is_op("*") || self.is_op("**") {
                    let e = ParseError::new(self.here(), "any number of arguments is not read");
                    return Err(e.hint("name each argument"));
                }
                let (name, span) = self.word("the name of an argument")?;
                if close == ")" && self.eat(":") {
                    self.expression()?;
                }
                let default = if self.eat("=") { Some(self.expression()?) } else { None };
                parameters.push(Parameter { name, span, default });
            }
            if !self.eat(",") && !self.is_op(close) {
                return Err(self.unexpected(&format!("`,` or `{close}`")));
            }
        }
        Ok(parameters)
    }

    pub fn next_is(&self, op: &str) -> bool {
        matches!(self.tokens.get(self.at + 1).map(|t| &t.mark), Some(Mark::Op(o)) if *o == op)
    }

    /// The names of a place that is called with dots: `jax.numpy`.
    pub fn dotted(&mut self) -> Parsed<String> {
        let mut path = self.word("a name")?.0;
        while self.eat(".") {
            path.push('.');
            path.push_str(&self.word("a name")?.0);
        }
        Ok(path)
    }

    /// Past everything up to the end of the line.
    pub fn skip_line(&mut self) {
        while !matches!(self.mark(), None | Some(Mark::Newline)) {
            self.at += 1;
        }
    }

    /// A refused statement.
    pub fn refused(&self, error: ParseError, body: Vec<Statement>, start: usize) -> Statement {
        Statement { kind: StatementKind::Refused(error, body), span: self.since(start) }
    }
}

/// The name that is called, if an expression is one call of one name.
pub(super) fn called_name(node: &Node) -> Option<(&str, Span)> {
    let Kind::Path(base, suffixes) = &node.kind else { return None };
    match (&base.kind, suffixes.as_slice()) {
        (Kind::Name(name), [Suffix { kind: SuffixKind::Call(_), .. }]) => Some((name, base.span.clone())),
        _ => None,
    }
}
