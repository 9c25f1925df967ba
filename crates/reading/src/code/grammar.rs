//! Expressions of both languages.

use super::Dialect;
use super::lexer::{Mark, Token};
use super::tree::{Argument, Kind, Node, Op, Span, Suffix, SuffixKind};
use super::{MAX_CHAIN, MAX_NESTING};
use denavit_symbolic::parse::ParseError;

pub(super) type Parsed<T> = Result<T, ParseError>;

/// Reads tokens; statements are in `python` and `matlab`.
pub(super) struct Parser<'a> {
    pub text: &'a str,
    pub tokens: Vec<Token>,
    pub at: usize,
    pub language: Dialect,
    /// A blank separates entries.
    pub in_matrix: bool,
    pub depth: usize,
    /// Within an index, where `end` is a number.
    pub in_index: bool,
    pub errors: Vec<ParseError>,
}

impl Parser<'_> {
    pub fn mark(&self) -> Option<&Mark> {
        self.tokens.get(self.at).map(|t| &t.mark)
    }

    /// The place of the token that comes next, or of the last one.
    pub fn here(&self) -> Span {
        let last = self.tokens.last().map_or(0..0, |t| t.span.clone());
        self.tokens.get(self.at).map_or(last, |t| t.span.clone())
    }

    /// From the token `start` to the last one that was read.
    pub fn since(&self, start: usize) -> Span {
        let from = self.tokens.get(start).map_or(0, |t| t.span.start);
        from..self.tokens[..self.at.min(self.tokens.len())].last().map_or(from, |t| t.span.end.max(from))
    }

    pub fn is_op(&self, op: &str) -> bool {
        matches!(self.mark(), Some(Mark::Op(o)) if *o == op)
    }

    pub fn is_word(&self, word: &str) -> bool {
        matches!(self.mark(), Some(Mark::Name(n)) if n == word)
    }

    pub fn eat(&mut self, op: &str) -> bool {
        let is = self.is_op(op);
        self.at += usize::from(is);
        is
    }

    pub fn eat_word(&mut self, word: &str) -> bool {
        let is = self.is_word(word);
        self.at += usize::from(is);
        is
    }

    pub fn expect(&mut self, op: &str) -> Parsed<()> {
        if self.eat(op) { Ok(()) } else { Err(self.unexpected(&format!("`{op}`"))) }
    }

    pub fn unexpected(&self, wanted: &str) -> ParseError {
        let found = match self.mark() {
            Some(Mark::Bad(message)) => return ParseError::new(self.here(), message.clone()),
            None | Some(Mark::Newline | Mark::Dedent) => "the line ends".to_string(),
            Some(Mark::Indent) => "the line is indented".to_string(),
            Some(_) => {
                let written: String =
                    self.text.get(self.here()).unwrap_or_default().chars().take(30).collect();
                format!("found `{written}`")
            }
        };
        ParseError::new(self.here(), format!("expected {wanted}, {found}"))
    }

    pub fn word(&mut self, wanted: &str) -> Parsed<(String, Span)> {
        let span = self.here();
        match self.mark() {
            Some(Mark::Name(name)) => {
                let name = name.clone();
                self.at += 1;
                Ok((name, span))
            }
            _ => Err(self.unexpected(wanted)),
        }
    }

    /// One level deeper.
    pub fn nested<T>(&mut self, read: impl FnOnce(&mut Self) -> Parsed<T>) -> Parsed<T> {
        if self.depth >= MAX_NESTING {
            let message = format!("nested more than {MAX_NESTING} deep");
            return Err(ParseError::new(self.here(), message));
        }
        self.depth += 1;
        let read = read(self);
        self.depth -= 1;
        read
    }

    pub fn node(&self, kind: Kind, start: usize) -> Node {
        Node { kind, span: self.since(start) }
    }

    /// Expressions with commas between them: one, or a tuple.
    pub fn expressions(&mut self) -> Parsed<Node> {
        let start = self.at;
        let first = self.starred()?;
        if !self.is_op(",") {
            return Ok(first);
        }
        let mut parts = vec![first];
        while self.eat(",") {
            if matches!(self.mark(), None | Some(Mark::Newline | Mark::Op("=" | ")" | "]" | ":" | ";"))) {
                break;
            }
            parts.push(self.starred()?);
        }
        Ok(self.node(Kind::Tuple(parts), start))
    }

    pub fn starred(&mut self) -> Parsed<Node> {
        let start = self.at;
        if self.language == Dialect::Python && self.eat("*") {
            let inner = Box::new(self.climb(0)?);
            return Ok(self.node(Kind::Star(inner), start));
        }
        self.expression()
    }

    pub fn expression(&mut self) -> Parsed<Node> {
        self.nested(|p| {
            let start = p.at;
            if p.language == Dialect::Matlab {
                return p.climb(0);
            }
            if p.is_word("lambda") {
                return p.lambda();
            }
            let value = p.climb(0)?;
            // `c ? a : b` of C
            if p.eat("?") {
                let first = p.expression()?;
                if !p.eat(":") {
                    return Err(p.unexpected("`:`"));
                }
                let other = p.expression()?;
                return Ok(p.node(Kind::Choice(Box::new([value, first, other])), start));
            }
            if !p.eat_word("if") {
                return Ok(value);
            }
            let test = p.climb(0)?;
            if !p.eat_word("else") {
                return Err(p.unexpected("`else`"));
            }
            let other = p.expression()?;
            Ok(p.node(Kind::Choice(Box::new([test, value, other])), start))
        })
    }

    /// The operator that comes next, its level, and how many tokens it has.
    fn operator(&self) -> Parsed<Option<(u8, Op, usize)>> {
        let is_python = self.language == Dialect::Python;
        let op = match self.mark() {
            Some(Mark::Op(op)) => *op,
            Some(Mark::Name(name)) if is_python => {
                let next = self.tokens.get(self.at + 1).map(|t| &t.mark);
                let followed = |word: &str| matches!(next, Some(Mark::Name(n)) if n == word);
                return Ok(Some(match name.as_str() {
                    "or" => (0, Op::Or, 1),
                    "and" => (1, Op::And, 1),
                    "is" if followed("not") => (3, Op::NotEqual, 2),
                    "is" => (3, Op::Equal, 1),
                    _ => return Ok(None),
                }));
            }
            _ => return Ok(None),
        };
        let comparison = if is_python { 3 } else { 4 };
        let (level, op) = match op {
            "||" | "|" if !is_python => (0, Op::Or),
            "&&" | "&" if !is_python => (1, Op::And),
            "<" => (comparison, Op::Less),
            "<=" => (comparison, Op::LessEqual),
            ">" => (comparison, Op::Greater),
            ">=" => (comparison, Op::GreaterEqual),
            "==" => (comparison, Op::Equal),
            "!=" | "~=" => (comparison, Op::NotEqual),
            ":" if !is_python => {
                // A lone `:` of an index stands before `,` or `)`.
                (5, Op::Colon)
            }
            "+" => (6, Op::Add),
            "-" => (6, Op::Sub),
            "*" => (7, Op::Mul),
            "/" => (7, Op::Div),
            ".*" => (7, Op::EachMul),
            "./" => (7, Op::EachDiv),
            "\\" => (7, Op::LeftDiv),
            "//" => (7, Op::FloorDiv),
            "%" => (7, Op::Mod),
            "@" if is_python => (7, Op::MatMul),
            "^" | "&" | "|" | "<<" | ">>" if is_python => {
                let e = ParseError::new(self.here(), format!("`{op}` works on bits in Python"));
                return Err(if op == "^" { e.hint("a power is `**`") } else { e });
            }
            _ => return Ok(None),
        };
        Ok(Some((level, op, 1)))
    }

    /// True if a sign in a matrix begins the next entry: `[a -b]`.
    fn begins_entry(&self) -> bool {
        let (Some(here), Some(next)) = (self.tokens.get(self.at), self.tokens.get(self.at + 1)) else {
            return false;
        };
        self.in_matrix && here.is_apart && !next.is_apart && matches!(here.mark, Mark::Op("+" | "-" | "@"))
    }

    pub fn climb(&mut self, lowest: u8) -> Parsed<Node> {
        let start = self.at;
        let mut left = self.unary()?;
        loop {
            let level = match self.operator()? {
                Some((level, ..)) if level >= lowest && !self.begins_entry() => level,
                _ => return Ok(left),
            };
            let mut rest = vec![];
            while let Some((_, op, length)) = self.operator()?.filter(|o| o.0 == level)
                && !self.begins_entry()
            {
                if rest.len() >= MAX_CHAIN {
                    let message = format!("more than {MAX_CHAIN} operators in a row");
                    return Err(ParseError::new(self.since(start), message));
                }
                self.at += length;
                rest.push((op, self.climb(level + 1)?));
            }
            left = self.node(Kind::Chain(Box::new(left), rest), start);
        }
    }

    fn unary(&mut self) -> Parsed<Node> {
        let start = self.at;
        let op = match self.mark() {
            Some(Mark::Op("-")) => Op::Sub,
            Some(Mark::Op("+")) => Op::Add,
            Some(Mark::Op("~" | "!")) if self.language == Dialect::Matlab => Op::Not,
            Some(Mark::Name(n)) if n == "not" && self.language == Dialect::Python => {
                self.at += 1;
                let inner = Box::new(self.nested(|p| p.climb(3))?);
                return Ok(self.node(Kind::Unary(Op::Not, inner), start));
            }
            _ => return self.power(),
        };
        self.at += 1;
        let inner = Box::new(self.nested(Self::unary)?);
        Ok(self.node(Kind::Unary(op, inner), start))
    }

    fn power(&mut self) -> Parsed<Node> {
        let start = self.at;
        let base = self.postfix()?;
        if self.language == Dialect::Python {
            if !self.eat("**") {
                return Ok(base);
            }
            let exponent = self.nested(Self::unary)?;
            return Ok(self.node(Kind::Chain(Box::new(base), vec![(Op::Pow, exponent)]), start));
        }
        let mut rest = vec![];
        while let Some(Mark::Op(op @ ("^" | ".^"))) = self.mark() {
            let op = if *op == "^" { Op::Pow } else { Op::EachPow };
            self.at += 1;
            let from = self.at;
            let is_negative = self.eat("-");
            let inner = self.nested(Self::postfix)?;
            if let Kind::Path(_, suffixes) = &inner.kind
                && matches!(suffixes.last().map(|s| &s.kind), Some(SuffixKind::Transpose))
            {
                let e = ParseError::new(self.since(start), "a transpose behind a power");
                return Err(e.hint("write brackets: `(A^2)'`"));
            }
            let exponent = match is_negative {
                true => self.node(Kind::Unary(Op::Sub, Box::new(inner)), from),
                false => inner,
            };
            rest.push((op, exponent));
            if rest.len() > MAX_NESTING {
                return Err(ParseError::new(self.since(start), "too many powers in a row"));
            }
        }
        Ok(if rest.is_empty() { base } else { self.node(Kind::Chain(Box::new(base), rest), start) })
    }

    pub fn postfix(&mut self) -> Parsed<Node> {
        let start = self.at;
        let mut base = self.primary()?;
        let mut suffixes = vec![];
        loop {
            let is_apart = self.tokens.get(self.at).is_some_and(|t| t.is_apart);
            let is_matlab = self.language == Dialect::Matlab;
            if self.in_matrix && is_apart {
                break;
            }
            let kind = match self.mark() {
                Some(Mark::Op("(")) => {
                    self.at += 1;
                    SuffixKind::Call(self.nested(Self::arguments)?)
                }
                Some(Mark::Op("[")) if !is_matlab => {
                    self.at += 1;
                    SuffixKind::Index(self.nested(|p| p.indices("]"))?)
                }
                Some(Mark::Op("{")) if is_matlab => {
                    self.at += 1;
                    SuffixKind::Cell(self.nested(|p| p.indices("}"))?)
                }
                Some(Mark::Op("'" | ".'")) => {
                    self.at += 1;
                    SuffixKind::Transpose
                }
                Some(Mark::Op(".")) => {
                    self.at += 1;
                    SuffixKind::Attribute(self.word("a name behind `.`")?.0)
                }
                _ => break,
            };
            if let (SuffixKind::Attribute(name), Kind::Name(own), true) =
                (&kind, &base.kind, suffixes.is_empty())
                && own == "self"
                && !is_matlab
            {
                base = self.node(Kind::Name(name.clone()), start);
                continue;
            }
            suffixes.push(Suffix { kind, end: self.since(start).end });
            if suffixes.len() > MAX_NESTING {
                return Err(ParseError::new(self.since(start), "too many calls in a row"));
            }
        }
        Ok(if suffixes.is_empty() { base } else { self.node(Kind::Path(Box::new(base), suffixes), start) })
    }

    /// Outside of what a blank separates, and where `end` may be a number.
    fn inside<T>(&mut self, read: impl FnOnce(&mut Self) -> Parsed<T>) -> Parsed<T> {
        let outer = (self.in_matrix, self.in_index);
        (self.in_matrix, self.in_index) = (false, true);
        let read = read(self);
        (self.in_matrix, self.in_index) = outer;
        read
    }

    /// The arguments of a call, behind its bracket.
    fn arguments(&mut self) -> Parsed<Vec<Argument>> {
        self.inside(|p| {
            let mut arguments = vec![];
            while !p.eat(")") {
                let next = p.tokens.get(p.at + 1).map(|t| &t.mark);
                let mut name = None;
                if let (Some(Mark::Name(word)), Some(Mark::Op("="))) = (p.mark(), next) {
                    name = Some(word.clone());
                    p.at += 2;
                }
                if p.is_op("**") {
                    let e = ParseError::new(p.here(), "`**` before an argument is not read");
                    return Err(e.hint("write the arguments by themselves"));
                }
                let value = p.index_item()?;
                let value = p.comprehension(value)?;
                arguments.push(Argument { name, value });
                if !p.eat(",") && !p.is_op(")") {
                    return Err(p.unexpected("`,` or `)`"));
                }
            }
            Ok(arguments)
        })
    }

    fn indices(&mut self, close: &str) -> Parsed<Vec<Node>> {
        self.inside(|p| {
            let mut items = vec![];
            while !p.eat(close) {
                items.push(p.index_item()?);
                if !p.eat(",") && !p.is_op(close) {
                    return Err(p.unexpected(&format!("`,` or `{close}`")));
                }
            }
            Ok(items)
        })
    }

    fn index_item(&mut self) -> Parsed<Node> {
        let start = self.at;
        if self.language == Dialect::Matlab {
            let next = self.tokens.get(self.at + 1).map(|t| &t.mark);
            if self.is_op(":") && matches!(next, Some(Mark::Op("," | ")" | "}"))) {
                self.at += 1;
                return Ok(self.node(Kind::All, start));
            }
            return self.expression();
        }
        let ends = |p: &Self| matches!(p.mark(), Some(Mark::Op(":" | "]" | "," | ")")));
        let first = if self.is_op(":") { None } else { Some(self.starred()?) };
        if !self.is_op(":") {
            return first.ok_or_else(|| self.unexpected("an index"));
        }
        self.at += 1;
        let second = if ends(self) { None } else { Some(self.expression()?) };
        let mut third = None;
        if self.eat(":") && !ends(self) {
            third = Some(self.expression()?);
        }
        if first.is_none() && second.is_none() && third.is_none() {
            return Ok(self.node(Kind::All, start));
        }
        Ok(self.node(Kind::Slice(Box::new([first, second, third])), start))
    }

    /// `item for target in source`, if `for` comes next.
    pub fn comprehension(&mut self, item: Node) -> Parsed<Node> {
        if self.language == Dialect::Matlab || !self.is_word("for") {
            return Ok(item);
        }
        let from = item.span.start;
        self.at += 1;
        let target = self.targets()?;
        if !self.eat_word("in") {
            return Err(self.unexpected("`in`"));
        }
        let source = self.climb(0)?;
        if self.is_word("if") || self.is_word("for") {
            return Err(ParseError::new(self.here(), "a list is read with one `for` and without `if`"));
        }
        let span = from..source.span.end;
        Ok(Node { kind: Kind::Comprehension(Box::new([item, target, source])), span })
    }

    /// The names before `in`.
    pub fn targets(&mut self) -> Parsed<Node> {
        let start = self.at;
        let first = self.postfix()?;
        if !self.is_op(",") {
            return Ok(first);
        }
        let mut parts = vec![first];
        while self.eat(",") {
            if self.is_word("in") {
                break;
            }
            parts.push(self.postfix()?);
        }
        Ok(self.node(Kind::Tuple(parts), start))
    }
}
