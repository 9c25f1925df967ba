//! Statements of MATLAB and Octave.

use super::Dialect;
use super::atoms::called_name;
use super::grammar::{Parsed, Parser};
use super::lexer::{self, Mark};
use super::tree::{Definition, Kind, Node, Op, Parameter, Span, Statement, StatementKind, SuffixKind};
use denavit_symbolic::parse::ParseError;

/// Commands that are written without brackets and change no value.
const COMMANDS: &[&str] = &[
    "clc",
    "clear",
    "clearvars",
    "close",
    "format",
    "hold",
    "more",
    "pkg",
    "warning",
    "figure",
    "digits",
    "grid",
];
/// What `syms` may say of its names.
const ASSUMPTIONS: &[&str] = &["real", "positive", "rational", "integer", "clear"];
/// Words that end a block.
const ENDS: &[&str] = &["end", "endfunction", "endif", "endfor", "endwhile", "endswitch", "end_try_catch"];

/// The statements of a part of a text.
pub(super) fn parse(text: &str, span: &Span) -> (Vec<Statement>, Vec<ParseError>) {
    let mut parser = Parser {
        text,
        tokens: lexer::tokens(text, span, Dialect::Matlab),
        at: 0,
        language: Dialect::Matlab,
        in_matrix: false,
        depth: 0,
        in_index: false,
        errors: vec![],
    };
    let mut statements = vec![];
    while parser.mark().is_some() {
        parser.lines(&mut statements, &[]);
        if parser.mark().is_some() {
            let e = parser.unexpected("a statement");
            parser.errors.push(e);
            parser.at += 1;
        }
    }
    (statements, parser.errors)
}

impl Parser<'_> {
    fn is_end(&self) -> bool {
        matches!(self.mark(), Some(Mark::Name(w)) if ENDS.contains(&w.as_str()))
    }

    /// Statements up to the end of a block or one of the words.
    fn lines(&mut self, out: &mut Vec<Statement>, words: &[&str]) {
        loop {
            match self.mark() {
                None => return,
                Some(Mark::Newline | Mark::Op(";" | ",")) => self.at += 1,
                Some(Mark::Name(w)) if ENDS.contains(&w.as_str()) || words.contains(&w.as_str()) => return,
                _ => self.line(out),
            }
        }
    }

    fn line(&mut self, out: &mut Vec<Statement>) {
        let start = self.at;
        match self.nested(|p| p.matlab_statement(start)) {
            Ok(statement) => {
                let is_block = matches!(
                    statement.kind,
                    StatementKind::For(..) | StatementKind::If(..) | StatementKind::Define(_)
                );
                out.push(statement);
                if !is_block && !matches!(self.mark(), None | Some(Mark::Newline | Mark::Op(";" | ","))) {
                    let e = self.unexpected("the end of the statement");
                    out.pop();
                    self.give_up(e, start, out);
                }
            }
            Err(e) => self.give_up(e, start, out),
        }
    }

    fn give_up(&mut self, error: ParseError, start: usize, out: &mut Vec<Statement>) {
        self.skip_line();
        self.at = self.at.max(start + 1);
        // What the line was to give a value.
        let span = self.since(start);
        let mut body = vec![];
        if let (Some(Mark::Name(name)), Some(Mark::Op("=" | "("))) =
            (self.tokens.get(start).map(|t| &t.mark), self.tokens.get(start + 1).map(|t| &t.mark))
        {
            let target = Node { kind: Kind::Name(name.clone()), span: span.clone() };
            let value = Node { kind: Kind::Tuple(vec![]), span: span.clone() };
            body.push(Statement { kind: StatementKind::Assign(vec![target], value), span });
        }
        let statement = self.refused(error, body, start);
        out.push(statement);
    }

    fn matlab_statement(&mut self, start: usize) -> Parsed<Statement> {
        let word = match self.mark() {
            Some(Mark::Name(word)) => word.clone(),
            _ => String::new(),
        };
        let next = self.tokens.get(self.at + 1).map(|t| t.mark.clone());
        let kind = match word.as_str() {
            "function" => return self.function(start),
            "for" | "parfor" => self.for_loop()?,
            "if" => self.if_arms()?,
            "while" | "switch" | "try" | "do" | "unwind_protect" | "classdef" | "arguments" => {
                let e = ParseError::new(self.here(), format!("`{word}` is not read"));
                let e = match word.as_str() {
                    "while" | "do" => e.hint("only loops over known numbers are: `for i = 1:6`"),
                    _ => e,
                };
                self.skip_line();
                let mut body = vec![];
                loop {
                    self.lines(
                        &mut body,
                        &["case", "otherwise", "catch", "until", "unwind_protect_cleanup", "function"],
                    );
                    if self.is_end() || self.mark().is_none() || self.is_word("function") {
                        break;
                    }
                    let is_until = self.is_word("until");
                    self.skip_line();
                    if is_until {
                        return Ok(self.refused(e, body, start));
                    }
                }
                self.at += usize::from(self.is_end());
                return Ok(self.refused(e, body, start));
            }
            "return" => {
                self.at += 1;
                // Of Julia: `return x, y`.
                let is_bare = matches!(self.mark(), None | Some(Mark::Newline | Mark::Op(";" | ",")));
                StatementKind::Return(if is_bare { None } else { Some(self.values_returned()?) })
            }
            "break" | "continue" => {
                self.at += 1;
                if word == "break" { StatementKind::Break } else { StatementKind::Continue }
            }
            "global" | "persistent" => {
                return Err(ParseError::new(self.here(), format!("`{word}` is not read"))
                    .hint("hand the value over as an argument"));
            }
            "error" if matches!(next, Some(Mark::Op("("))) => {
                self.expression()?;
                StatementKind::Raise
            }
            "syms" => self.syms()?,
            w if COMMANDS.contains(&w) && !matches!(next, Some(Mark::Op("=" | "("))) => {
                self.skip_line();
                StatementKind::Pass
            }
            _ => self.matlab_assignment()?,
        };
        Ok(Statement { kind, span: self.since(start) })
    }

    /// `x, y` behind `return`.
    fn values_returned(&mut self) -> Parsed<Node> {
        let start = self.at;
        let mut parts = vec![self.expression()?];
        while self.eat(",") {
            parts.push(self.expression()?);
        }
        Ok(match <[Node; 1]>::try_from(parts) {
            Ok([one]) => one,
            Err(parts) => self.node(Kind::Tuple(parts), start),
        })
    }

    fn syms(&mut self) -> Parsed<StatementKind> {
        self.at += 1;
        let mut names = vec![];
        while !matches!(self.mark(), None | Some(Mark::Newline | Mark::Op(";" | ","))) {
            let (name, span) = self.word("a name")?;
            if self.is_op("(") {
                let e = ParseError::new(self.here(), "a function of time is not read");
                return Err(e.hint(format!("write `syms {name}`")));
            }
            if !ASSUMPTIONS.contains(&name.as_str()) {
                names.push((name, span));
            }
        }
        Ok(StatementKind::Declare(names))
    }

    /// True if what stands here is `[…] =`.
    fn has_outputs(&self) -> bool {
        let mut depth = 0_usize;
        for token in &self.tokens[self.at..] {
            match token.mark {
                Mark::Op("[" | "(" | "{") => depth += 1,
                Mark::Op("]" | ")" | "}") => depth = depth.saturating_sub(1),
                Mark::Newline => return false,
                _ => {}
            }
            if depth == 0 {
                let behind = token.span.end;
                let at = self.tokens.partition_point(|t| t.span.end <= behind);
                return matches!(self.tokens.get(at).map(|t| &t.mark), Some(Mark::Op("=")));
            }
        }
        false
    }

    fn matlab_assignment(&mut self) -> Parsed<StatementKind> {
        if self.is_op("[") && self.has_outputs() {
            let start = self.at;
            self.at += 1;
            let mut targets = vec![];
            self.in_matrix = true;
            let read = loop {
                if self.eat("]") {
                    break Ok(());
                }
                if self.eat(",") {
                    continue;
                }
                let from = self.at;
                if self.eat("~") || self.eat("!") {
                    targets.push(self.node(Kind::Name("~".to_string()), from));
                    continue;
                }
                match self.postfix() {
                    Ok(target) => targets.push(target),
                    Err(e) => break Err(e),
                }
            };
            self.in_matrix = false;
            read?;
            let target = self.node(Kind::Tuple(targets), start);
            self.expect("=")?;
            return Ok(StatementKind::Assign(vec![target], self.expression()?));
        }
        let first = self.expression()?;
        let augment = match self.mark() {
            Some(Mark::Op("+=")) => Some(Op::Add),
            Some(Mark::Op("-=")) => Some(Op::Sub),
            Some(Mark::Op("*=")) => Some(Op::Mul),
            Some(Mark::Op("/=")) => Some(Op::Div),
            _ => None,
        };
        if let Some(op) = augment {
            self.at += 1;
            return Ok(StatementKind::Augment(first, op, self.expression()?));
        }
        if !self.eat("=") {
            return Ok(StatementKind::Show(first));
        }
        Ok(StatementKind::Assign(vec![first], self.expression()?))
    }

    fn for_loop(&mut self) -> Parsed<StatementKind> {
        self.at += 1;
        let is_bracketed =
            self.is_op("(") && matches!(self.tokens.get(self.at + 2).map(|t| &t.mark), Some(Mark::Op("=")));
        self.at += usize::from(is_bracketed);
        let start = self.at;
        let name = self.word("the name of the loop")?.0;
        let target = self.node(Kind::Name(name), start);
        self.expect("=")?;
        let source = self.expression()?;
        if is_bracketed {
            self.expect(")")?;
        }
        let mut body = vec![];
        self.lines(&mut body, &["function"]);
        self.block_end()?;
        Ok(StatementKind::For(target, source, body))
    }

    fn block_end(&mut self) -> Parsed<()> {
        if !self.is_end() {
            return Err(self.unexpected("`end`"));
        }
        self.at += 1;
        Ok(())
    }

    fn if_arms(&mut self) -> Parsed<StatementKind> {
        let (mut arms, mut other) = (vec![], vec![]);
        self.at += 1;
        loop {
            let test = self.expression()?;
            let mut body = vec![];
            self.lines(&mut body, &["elseif", "else", "function"]);
            arms.push((test, body));
            if self.eat_word("elseif") {
                continue;
            }
            if self.eat_word("else") {
                self.lines(&mut other, &["function"]);
            }
            self.block_end()?;
            return Ok(StatementKind::If(arms, other));
        }
    }

    fn function(&mut self, start: usize) -> Parsed<Statement> {
        self.at += 1;
        let mut outputs = vec![];
        if self.eat("[") {
            while !self.eat("]") {
                if !self.eat(",") {
                    outputs.push(self.word("the name of an output")?);
                }
            }
            self.expect("=")?;
        } else if self.next_is("=") {
            outputs.push(self.word("the name of the output")?);
            self.at += 1;
        }
        let mut name = self.word("the name of the function")?.0;
        while self.eat(".") {
            name = self.word("a name")?.0;
        }
        let mut parameters = vec![];
        if self.eat("(") {
            while !self.eat(")") {
                let span = self.here();
                let name =
                    if self.eat("~") { "~".to_string() } else { self.word("the name of an argument")?.0 };
                let default = if self.eat("=") { Some(self.expression()?) } else { None };
                parameters.push(Parameter { name, span, default });
                if !self.eat(",") && !self.is_op(")") {
                    return Err(self.unexpected("`,` or `)`"));
                }
            }
        }
        let mut body = vec![];
        self.lines(&mut body, &["function"]);
        self.at += usize::from(self.is_end());
        let span = self.since(start);
        let definition = Definition { name, span: span.clone(), parameters, outputs, body };
        Ok(Statement { kind: StatementKind::Define(definition), span })
    }
}

/// True for a call that only shows something: `disp(T)`.
pub(super) fn is_display(node: &Node) -> bool {
    if let Some((name, _)) = called_name(node) {
        return DISPLAYS.contains(&name);
    }
    match &node.kind {
        Kind::Path(_, suffixes) => {
            let mut before = suffixes.iter().rev().skip(1);
            let named = match before.next().map(|s| &s.kind) {
                Some(SuffixKind::Attribute(name)) => DISPLAYS.contains(&name.as_str()),
                _ => false,
            };
            named && matches!(suffixes.last().map(|s| &s.kind), Some(SuffixKind::Call(_)))
        }
        _ => false,
    }
}

const DISPLAYS: &[&str] = &[
    "print",
    "pprint",
    "disp",
    "display",
    "fprintf",
    "printf",
    "set_printoptions",
    "init_printing",
    "figure",
    "plot",
    "plot3",
    "show",
    "axis",
    "title",
    "xlabel",
    "ylabel",
    "zlabel",
    "legend",
    "grid",
    "assert",
    "pretty",
    "simplify",
    "close",
    "clc",
    "clear",
    "view",
    "tic",
    "toc",
    "rng",
    "drawnow",
    "hold",
    "warning",
    "scatter",
    "latex",
    "savefig",
    "seterr",
    "filterwarnings",
    "format",
    "line",
    "text",
    "subplot",
    "init_session",
    "info",
    "debug",
];
