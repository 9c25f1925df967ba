//! Statements of Python.

use super::Dialect;
use super::grammar::{Parsed, Parser};
use super::lexer::{self, Mark};
use super::tree::{Definition, Kind, Node, Op, Parameter, Span, Statement, StatementKind};
use denavit_symbolic::parse::ParseError;

/// Decorators that leave what a function computes as it is.
const HARMLESS: &[&str] = &[
    "jit",
    "njit",
    "staticmethod",
    "cache",
    "lru_cache",
    "property",
    "vectorize",
    "jax",
    "numba",
    "functools",
    "nb",
];

/// The statements of a part of a text.
pub(super) fn parse(text: &str, span: &Span) -> (Vec<Statement>, Vec<ParseError>) {
    let tokens = lexer::tokens(text, span, Dialect::Python);
    let (at, language, depth) = (0, Dialect::Python, 0);
    let parser =
        Parser { text, tokens, at, language, in_matrix: false, depth, in_index: false, errors: vec![] };
    statements(parser)
}

/// The statements of tokens.
pub(super) fn statements(mut parser: Parser<'_>) -> (Vec<Statement>, Vec<ParseError>) {
    let mut statements = vec![];
    while parser.mark().is_some() {
        // What is left of a block whose beginning was not understood.
        if matches!(parser.mark(), Some(Mark::Indent | Mark::Dedent)) {
            parser.at += 1;
        } else {
            parser.statement(&mut statements);
        }
    }
    (statements, parser.errors)
}

impl Parser<'_> {
    /// One line, or one block, and what stands behind `;`.
    fn statement(&mut self, out: &mut Vec<Statement>) {
        let start = self.at;
        if matches!(self.mark(), Some(Mark::Newline)) {
            self.at += 1;
            return;
        }
        if self.is_word("class") {
            if let Err(e) = self.nested(|p| p.class(out)) {
                self.recover(e, start, out);
            }
            return;
        }
        let read = self.nested(|p| match p.mark() {
            Some(Mark::Name(word)) => match word.as_str() {
                "def" => p.definition(start).map(Some),
                "for" => p.for_block(start).map(Some),
                "if" => p.if_block(start).map(Some),
                "while" => {
                    let e = ParseError::new(p.here(), "a `while` loop is not read");
                    p.refused_block(e.hint("only loops over known numbers are: `for i in range(6)`"), start)
                        .map(Some)
                }
                "try" => p.refused_block(ParseError::new(p.here(), "`try` is not read"), start).map(Some),
                "with" => p.refused_block(ParseError::new(p.here(), "`with` is not read"), start).map(Some),
                "async" => p.refused_block(ParseError::new(p.here(), "`async` is not read"), start).map(Some),
                "match" if !p.next_is("=") && !p.next_is(".") && !p.next_is("(") => {
                    p.refused_block(ParseError::new(p.here(), "`match` is not read"), start).map(Some)
                }
                _ => Ok(None),
            },
            Some(Mark::Op("@")) => p.decorated(start).map(Some),
            _ => Ok(None),
        });
        match read {
            Ok(Some(statement)) => out.push(statement),
            Ok(None) if self.at > start => {} // passed over
            Ok(None) => self.simple_line(out),
            Err(e) => self.recover(e, start, out),
        }
    }

    /// A statement that is not understood, with the block below it.
    fn recover(&mut self, error: ParseError, start: usize, out: &mut Vec<Statement>) {
        self.skip_line();
        self.at += usize::from(self.mark().is_some());
        let body = match self.mark() {
            Some(Mark::Indent) => self.nested(|p| Ok(p.indented())).unwrap_or_default(),
            _ => vec![],
        };
        self.at = self.at.max(start + 1);
        let body = if body.is_empty() { self.lost_name(start) } else { body };
        let statement = self.refused(error, body, start);
        out.push(statement);
    }

    /// The name that a line which is not understood gives a value, `T = …`, as a statement that is never run: what the name stands
    /// for is not known afterwards.
    fn lost_name(&self, start: usize) -> Vec<Statement> {
        let marks = [start, start + 1].map(|k| self.tokens.get(k));
        let [Some(first), Some(second)] = marks else { return vec![] };
        let (Mark::Name(name), Mark::Op("=")) = (&first.mark, &second.mark) else { return vec![] };
        let node = || Node { kind: Kind::Name(name.clone()), span: first.span.clone() };
        vec![Statement { kind: StatementKind::Assign(vec![node()], node()), span: first.span.clone() }]
    }

    fn simple_line(&mut self, out: &mut Vec<Statement>) {
        loop {
            let start = self.at;
            match self.simple() {
                Ok(kind) => out.push(Statement { kind, span: self.since(start) }),
                Err(e) => return self.recover(e, start, out),
            }
            if self.eat(";") && !matches!(self.mark(), Some(Mark::Newline)) {
                continue;
            }
            if !matches!(self.mark(), None | Some(Mark::Newline)) {
                let e = self.unexpected("the end of the line");
                out.pop();
                return self.recover(e, start, out);
            }
            self.at += 1;
            return;
        }
    }

    fn simple(&mut self) -> Parsed<StatementKind> {
        let word = match self.mark() {
            Some(Mark::Name(word)) => word.clone(),
            _ => String::new(),
        };
        let refuse = |p: &mut Self, message: &str| {
            let e = ParseError::new(p.here(), message);
            p.at += 1;
            Err(e)
        };
        match word.as_str() {
            "pass" => self.skipped(),
            "assert" => {
                self.at += 1;
                let asserted = self.expression();
                self.skip_line();
                Ok(asserted.map_or(StatementKind::Pass, StatementKind::Assert))
            }
            "break" => self.skipped().map(|_| StatementKind::Break),
            "continue" => self.skipped().map(|_| StatementKind::Continue),
            "return" => {
                self.at += 1;
                if matches!(self.mark(), None | Some(Mark::Newline | Mark::Op(";"))) {
                    return Ok(StatementKind::Return(None));
                }
                Ok(StatementKind::Return(Some(self.expressions()?)))
            }
            "import" => self.import(),
            "from" => self.import_from(),
            "raise" => {
                self.skip_line();
                Ok(StatementKind::Raise)
            }
            "global" | "nonlocal" => refuse(self, "a name from outside the function is not changed here"),
            "del" => refuse(self, "`del` is not read"),
            "yield" => refuse(self, "`yield` is not read"),
            "await" => refuse(self, "`await` is not read"),
            _ => self.assignment(),
        }
    }

    fn skipped(&mut self) -> Parsed<StatementKind> {
        self.at += 1;
        Ok(StatementKind::Pass)
    }

    fn import(&mut self) -> Parsed<StatementKind> {
        self.at += 1;
        let mut names = vec![];
        loop {
            let path = self.dotted()?;
            if self.eat_word("as") {
                names.push((self.word("a name")?.0, path));
            } else {
                let root = path.split('.').next().unwrap_or_default().to_string();
                names.push((root.clone(), root));
            }
            if !self.eat(",") {
                return Ok(StatementKind::Import(names));
            }
        }
    }

    fn import_from(&mut self) -> Parsed<StatementKind> {
        self.at += 1;
        while self.eat(".") {}
        let path = if self.is_word("import") { String::new() } else { self.dotted()? };
        if !self.eat_word("import") {
            return Err(self.unexpected("`import`"));
        }
        if self.eat("*") {
            return Ok(StatementKind::ImportAll(path));
        }
        let is_bracketed = self.eat("(");
        let mut names = vec![];
        loop {
            let name = self.word("a name")?.0;
            let full = format!("{path}.{name}");
            let local = if self.eat_word("as") { self.word("a name")?.0 } else { name };
            names.push((local, full));
            if !self.eat(",") || self.is_op(")") {
                break;
            }
        }
        if is_bracketed {
            self.expect(")")?;
        }
        Ok(StatementKind::Import(names))
    }

    fn assignment(&mut self) -> Parsed<StatementKind> {
        let first = self.expressions()?;
        let op = match self.mark() {
            Some(Mark::Op(op)) => *op,
            _ => return Ok(StatementKind::Show(first)),
        };
        let augment = match op {
            "+=" => Some(Op::Add),
            "-=" => Some(Op::Sub),
            "*=" => Some(Op::Mul),
            "/=" => Some(Op::Div),
            "@=" => Some(Op::MatMul),
            "**=" => Some(Op::Pow),
            "//=" => Some(Op::FloorDiv),
            "%=" => Some(Op::Mod),
            _ => None,
        };
        if let Some(op) = augment {
            self.at += 1;
            return Ok(StatementKind::Augment(first, op, self.expressions()?));
        }
        if self.eat(":") {
            self.expression()?;
            if !self.is_op("=") {
                return Ok(StatementKind::Pass);
            }
        }
        let mut parts = vec![first];
        while self.eat("=") {
            parts.push(self.expressions()?);
        }
        let value = parts.pop();
        match value {
            Some(value) if !parts.is_empty() => Ok(StatementKind::Assign(parts, value)),
            Some(value) => Ok(StatementKind::Show(value)),
            None => Err(self.unexpected("a value")),
        }
    }

    /// What belongs to a line that ends with `:`.
    fn block(&mut self) -> Parsed<Vec<Statement>> {
        self.expect(":")?;
        let mut body = vec![];
        if !matches!(self.mark(), Some(Mark::Newline)) {
            self.simple_line(&mut body);
            return Ok(body);
        }
        self.at += 1;
        if !matches!(self.mark(), Some(Mark::Indent)) {
            return Err(self.unexpected("an indented block"));
        }
        Ok(self.indented())
    }

    fn indented(&mut self) -> Vec<Statement> {
        self.at += 1;
        let mut body = vec![];
        loop {
            match self.mark() {
                None => return body,
                Some(Mark::Dedent) => {
                    self.at += 1;
                    return body;
                }
                Some(Mark::Indent) => {
                    let e = ParseError::new(self.here(), "the line is indented without a reason");
                    let start = self.at;
                    let inner = self.nested(|p| Ok(p.indented())).unwrap_or_default();
                    self.at = self.at.max(start + 1);
                    body.push(self.refused(e, inner, start));
                }
                _ => self.statement(&mut body),
            }
        }
    }

    fn definition(&mut self, start: usize) -> Parsed<Statement> {
        self.at += 1;
        let (name, _) = self.word("the name of the function")?;
        self.expect("(")?;
        let parameters = self.parameters(")")?;
        if self.eat("->") {
            self.expression()?;
        }
        let body = self.block()?;
        let span = self.since(start);
        let definition = Definition { name, span: span.clone(), parameters, outputs: vec![], body };
        Ok(Statement { kind: StatementKind::Define(definition), span })
    }

    fn decorated(&mut self, start: usize) -> Parsed<Statement> {
        while self.is_op("@") {
            let from = self.at;
            self.at += 1;
            let is_harmless = matches!(self.mark(), Some(Mark::Name(n)) if HARMLESS.contains(&n.as_str()));
            self.skip_line();
            let written = self.text.get(self.since(from)).unwrap_or_default();
            if !is_harmless {
                let e = ParseError::new(self.since(from), format!("`{written}` is not read"));
                self.at += 1;
                if self.is_word("def") {
                    self.definition(self.at)?;
                }
                return Ok(self.refused(
                    e.hint("leave it out if the function is the same without it"),
                    vec![],
                    start,
                ));
            }
            self.at += usize::from(self.mark().is_some());
        }
        if !self.is_word("def") {
            return Err(self.unexpected("`def`"));
        }
        self.definition(self.at)
    }

    fn for_block(&mut self, start: usize) -> Parsed<Statement> {
        self.at += 1;
        let target = self.targets()?;
        if !self.eat_word("in") {
            return Err(self.unexpected("`in`"));
        }
        let source = self.expressions()?;
        let body = self.block()?;
        let statement = Statement { kind: StatementKind::For(target, source, body), span: self.since(start) };
        if self.is_word("else") {
            let e = ParseError::new(self.here(), "`else` of a loop is not read");
            self.at += 1;
            let mut inner = self.block()?;
            inner.insert(0, statement);
            return Ok(self.refused(e, inner, start));
        }
        Ok(statement)
    }

    fn if_block(&mut self, start: usize) -> Parsed<Statement> {
        let (mut arms, mut other) = (vec![], vec![]);
        self.at += 1;
        loop {
            let test = self.expressions()?;
            arms.push((test, self.block()?));
            if self.eat_word("elif") {
                continue;
            }
            if self.eat_word("else") {
                other = self.block()?;
            }
            break;
        }
        Ok(Statement { kind: StatementKind::If(arms, other), span: self.since(start) })
    }

    /// A block that is not read, with the blocks that belong to it.
    fn refused_block(&mut self, error: ParseError, start: usize) -> Parsed<Statement> {
        let mut body = vec![];
        loop {
            // The colon of the block; those of slices and dictionaries are in brackets.
            let mut depth = 0_usize;
            loop {
                match self.mark() {
                    None | Some(Mark::Newline) => return Err(error),
                    Some(Mark::Op("(" | "[" | "{")) => depth += 1,
                    Some(Mark::Op(")" | "]" | "}")) => depth = depth.saturating_sub(1),
                    Some(Mark::Op(":")) if depth == 0 => break,
                    _ => {}
                }
                self.at += 1;
            }
            body.extend(self.block()?);
            if !matches!(self.mark(), Some(Mark::Name(w)) if matches!(w.as_str(), "except" | "finally" | "else"))
            {
                return Ok(self.refused(error, body, start));
            }
        }
    }

    /// The functions of a class stand for themselves, `self.a` for `a`, and what is done at its making is done once.
    fn class(&mut self, out: &mut Vec<Statement>) -> Parsed<()> {
        while !matches!(self.mark(), None | Some(Mark::Newline | Mark::Op(":"))) {
            self.at += 1;
        }
        for statement in self.block()? {
            let Statement { kind: StatementKind::Define(mut d), span } = statement else {
                out.push(statement);
                continue;
            };
            let is_own = |p: &Parameter| matches!(p.name.as_str(), "self" | "cls");
            if d.parameters.first().is_some_and(is_own) {
                d.parameters.remove(0);
            }
            if d.name != "__init__" {
                out.push(Statement { kind: StatementKind::Define(d), span });
                continue;
            }
            for p in d.parameters {
                let Some(value) = p.default else { continue };
                let target = Node { kind: Kind::Name(p.name), span: p.span.clone() };
                out.push(Statement { kind: StatementKind::Assign(vec![target], value), span: p.span });
            }
            out.extend(d.body);
        }
        Ok(())
    }
}

/// `__name__ == "__main__"`
pub(super) fn is_main(test: &Node) -> bool {
    let Kind::Chain(left, rest) = &test.kind else { return false };
    match (&left.kind, rest.as_slice()) {
        (Kind::Name(name), [(Op::Equal, Node { kind: Kind::Text(text), .. })]) => {
            name == "__name__" && text == "__main__"
        }
        _ => false,
    }
}
