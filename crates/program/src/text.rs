//! The text form of a program: one operation a line, exact, to be read back.
//!
//! ```text
//! variables q1 q2
//! parameters a
//! %0 = input q1          # operations: input, number, pi, add, sub, mul, div, sqrt, sin, cos, atan2
//! %1 = cos %0
//! %2 = input a
//! %m1 = mul %1 %2        # a shared value has a name, any other a number
//! %4 = number 3/2
//! %5 = add %m1 %4
//! result x = %5
//! result y = -%m1        # signs: on results and on operands of sqrt and atan2
//! ```
//!
//! A name is bare if it consists of letters, digits, `_`, `.` and `'`, and otherwise stands in quotes. `#` starts a
//! comment. What [`Program::to_text`] writes reads back as the same program, operation by operation, as long as its
//! results have distinct names.

use crate::graph::{Op, Value};
use crate::program::Program;
use denavit_symbolic::{Rational, Symbol};
use rustc_hash::{FxHashMap, FxHashSet};
use std::fmt::{self, Write};
use std::iter::{Peekable, Zip};
use std::ops::RangeFrom;

/// The largest text that is read, in bytes.
pub(crate) const MAX_BYTES: usize = 1 << 24;
/// The longest numerator or denominator, in digits.
const MAX_DIGITS: usize = 4000;

/// What is wrong with the text of a program, and where.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct TextError {
    /// The line, from 1.
    pub line: usize,
    /// The character in the line, from 1.
    pub column: usize,
    /// What is wrong.
    pub message: String,
}

impl fmt::Display for TextError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.line, self.column, self.message)
    }
}

impl std::error::Error for TextError {}

impl fmt::Display for Program {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (word, inputs) in [("variables", self.variables()), ("parameters", self.parameters())] {
            write!(f, "{word}")?;
            for s in inputs {
                write!(f, " {}", Name(&s.name()))?;
            }
            writeln!(f)?;
        }
        for (i, (op, _)) in self.ops().iter().enumerate() {
            let at = |n: &u32| Operand(self, Value { node: *n, negative: false });
            write!(f, "{} = {}", at(&(i as u32)), op.mnemonic())?;
            match op {
                Op::Number(r) => write!(f, " {r}")?,
                Op::Pi => {}
                Op::Input(s) => write!(f, " {}", Name(&s.name()))?,
                Op::Add(a, b) | Op::Sub(a, b) | Op::Mul(a, b) | Op::Div(a, b) => {
                    write!(f, " {} {}", at(a), at(b))?;
                }
                Op::Sqrt(a) => write!(f, " {}", Operand(self, *a))?,
                Op::Sin(a) | Op::Cos(a) | Op::Sign(a) => write!(f, " {}", at(a))?,
                Op::Atan2(a, b) => write!(f, " {} {}", Operand(self, *a), Operand(self, *b))?,
            }
            writeln!(f)?;
        }
        for (name, v) in self.outputs() {
            writeln!(f, "result {} = {}", Name(name), Operand(self, *v))?;
        }
        Ok(())
    }
}

impl Program {
    /// The program as text.
    pub fn to_text(&self) -> String {
        self.to_string()
    }

    /// Reads the text of a program.
    ///
    /// # Errors
    /// All that is wrong with it, in order.
    pub fn from_text(text: &str) -> Result<Program, Vec<TextError>> {
        if text.len() > MAX_BYTES {
            let message = format!("the text is longer than {MAX_BYTES} bytes");
            return Err(vec![TextError { line: 1, column: 1, message }]);
        }
        let mut reader = Reader::default();
        for (i, line) in text.lines().enumerate() {
            reader.line(i + 1, line);
        }
        if !reader.errors.is_empty() {
            return Err(reader.errors);
        }
        Ok(reader.finish())
    }
}

fn is_bare(c: char) -> bool {
    c.is_alphanumeric() || "_.'".contains(c)
}

/// True for the label of a value without a name.
fn is_number(label: &str) -> bool {
    label.bytes().all(|b| b.is_ascii_digit())
}

/// A name, in quotes if need be.
pub(crate) struct Name<'a>(pub &'a str);

/// A text in quotes.
pub(crate) struct Quoted<'a>(pub &'a str);

impl fmt::Display for Quoted<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        quoted(self.0, f)
    }
}

impl fmt::Display for Name<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.0.is_empty() && self.0.chars().all(is_bare) {
            return f.write_str(self.0);
        }
        quoted(self.0, f)
    }
}

fn quoted(name: &str, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    f.write_char('"')?;
    for c in name.chars() {
        match c {
            '"' | '\\' => write!(f, "\\{c}")?,
            c if c.is_control() => write!(f, "\\u{{{:x}}}", u32::from(c))?,
            c => f.write_char(c)?,
        }
    }
    f.write_char('"')
}

/// A reference to a value: its sign, and its name or number.
struct Operand<'a>(&'a Program, Value);

impl fmt::Display for Operand<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Operand(program, v) = self;
        f.write_str(if v.negative { "-%" } else { "%" })?;
        match program.name(v.node) {
            None => write!(f, "{}", v.node),
            Some(name) if is_number(name) => quoted(name, f),
            Some(name) => write!(f, "{}", Name(name)),
        }
    }
}

#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Token {
    /// A keyword, a name, or digits.
    Word(String),
    /// A name in quotes.
    Quoted(String),
    /// `%` and a name or number.
    Label(Label),
    Minus,
    Equals,
    Slash,
}

#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Label {
    Name(String),
    Number(String),
}

/// An operation as it is read; symbols are not made yet.
enum Line {
    Done(Op),
    Input(String),
}

#[derive(Default)]
pub(crate) struct Reader {
    pub variables: Vec<String>,
    pub parameters: Vec<String>,
    inputs: FxHashSet<String>,
    ops: Vec<Line>,
    names: Vec<Option<String>>,
    labels: FxHashMap<Label, u32>,
    pub results: Vec<(String, Value)>,
    result_names: FxHashSet<String>,
    pub errors: Vec<TextError>,
}

/// The tokens of a line that are not read yet, each with its column; `end` is the column behind them.
pub(crate) struct Rest<'a> {
    line: usize,
    tokens: std::slice::Iter<'a, (usize, Token)>,
    end: usize,
}

impl<'a> Rest<'a> {
    pub fn new(line: usize, tokens: &'a [(usize, Token)], end: usize) -> Self {
        Rest { line, tokens: tokens.iter(), end }
    }

    /// The number of the line.
    pub fn number(&self) -> usize {
        self.line
    }

    /// The column behind the line.
    pub fn end(&self) -> usize {
        self.end
    }

    pub fn column(&self) -> usize {
        self.tokens.as_slice().first().map_or(self.end, |t| t.0)
    }

    pub fn next(&mut self) -> Option<&Token> {
        self.tokens.next().map(|t| &t.1)
    }

    pub fn take(&mut self, token: &Token) -> bool {
        let found = self.tokens.as_slice().first().is_some_and(|t| t.1 == *token);
        if found {
            self.tokens.next();
        }
        found
    }

    pub fn error(&self, column: usize, message: impl Into<String>) -> TextError {
        TextError { line: self.line, column, message: message.into() }
    }

    pub fn name(&mut self, what: &str) -> Result<(usize, String), TextError> {
        let column = self.column();
        match self.next() {
            Some(Token::Word(name) | Token::Quoted(name)) => Ok((column, name.clone())),
            _ => Err(self.error(column, format!("expected {what}"))),
        }
    }

    pub fn digits(&mut self) -> Result<Rational, TextError> {
        let column = self.column();
        match self.next() {
            Some(Token::Word(word)) if is_number(word) => match word.len() {
                0..=MAX_DIGITS => {
                    Rational::from_decimal(word).ok_or_else(|| self.error(column, "expected a whole number"))
                }
                _ => Err(self.error(column, format!("more than {MAX_DIGITS} digits"))),
            },
            Some(Token::Minus) => {
                Err(self.error(column, "a number has no sign: subtract it, or use it negated"))
            }
            _ => Err(self.error(column, "expected a whole number")),
        }
    }

    pub fn equals(&mut self) -> Result<(), TextError> {
        let column = self.column();
        if self.take(&Token::Equals) { Ok(()) } else { Err(self.error(column, "expected `=`")) }
    }

    pub fn finished(&self) -> Result<(), TextError> {
        match self.tokens.as_slice().first() {
            None => Ok(()),
            Some((column, _)) => Err(self.error(*column, "nothing more is expected in this line")),
        }
    }
}

impl Reader {
    /// The program that was read, where there are no errors.
    pub fn finish(self) -> Program {
        // Symbols stay as long as their store, so that they are made only for a text that is right.
        let symbols = |names: &[String]| names.iter().map(|n| Symbol::new(n)).collect();
        let [variables, parameters] = [symbols(&self.variables), symbols(&self.parameters)];
        let ops = self.ops.into_iter().map(|line| match line {
            Line::Done(op) => op,
            Line::Input(name) => Op::Input(Symbol::new(&name)),
        });
        Program::from_parts(variables, parameters, ops, self.results, self.names)
    }

    /// Reads a line.
    pub fn line(&mut self, number: usize, text: &str) {
        let (tokens, end) = match tokens(number, text) {
            Ok(found) => found,
            Err(error) => {
                self.errors.push(error);
                // A label that is there is defined, so that its uses are no errors of their own.
                if let Some(label) = first_label(text) {
                    self.define(label, Line::Done(Op::Pi));
                }
                return;
            }
        };
        let mut rest = Rest::new(number, &tokens, end);
        let outcome = match rest.next() {
            None => return,
            Some(Token::Label(label)) => self.operation(label.clone(), tokens[0].0, &mut rest),
            Some(Token::Word(word)) if word == "variables" => self.declaration(true, &mut rest),
            Some(Token::Word(word)) if word == "parameters" => self.declaration(false, &mut rest),
            Some(Token::Word(word)) if word == "result" => self.result(&mut rest),
            Some(_) => {
                Err(rest.error(tokens[0].0, "expected `variables`, `parameters`, `result` or `%name =`"))
            }
        };
        self.errors.extend(outcome.and_then(|()| rest.finished()).err());
    }

    fn declaration(&mut self, is_variable: bool, rest: &mut Rest) -> Result<(), TextError> {
        while rest.column() != rest.end {
            let (column, name) = rest.name("a name")?;
            if !self.inputs.insert(name.clone()) {
                self.errors.push(rest.error(column, format!("`{name}` is declared twice")));
                continue;
            }
            if is_variable { self.variables.push(name) } else { self.parameters.push(name) }
        }
        Ok(())
    }

    fn result(&mut self, rest: &mut Rest) -> Result<(), TextError> {
        let (column, name) = rest.name("the name of a result")?;
        rest.equals()?;
        let v = self.value(rest)?;
        if !self.result_names.insert(name.clone()) {
            return Err(rest.error(column, format!("there are two results `{name}`")));
        }
        self.results.push((name, v));
        Ok(())
    }

    fn operation(&mut self, label: Label, column: usize, rest: &mut Rest) -> Result<(), TextError> {
        let parsed = rest.equals().and_then(|()| self.right_side(rest));
        let is_new = !self.labels.contains_key(&label);
        let (line, failure) = match parsed {
            Ok(line) => (line, None),
            Err(error) => (Line::Done(Op::Pi), Some(error)),
        };
        self.define(label, line);
        match failure {
            Some(error) => Err(error),
            None if is_new => Ok(()),
            None => Err(rest.error(column, "this value is defined twice")),
        }
    }

    fn define(&mut self, label: Label, line: Line) {
        if self.labels.contains_key(&label) {
            return;
        }
        let node = self.ops.len() as u32; // fewer than MAX_BYTES
        self.ops.push(line);
        self.names.push(match &label {
            Label::Name(name) => Some(name.clone()),
            Label::Number(_) => None,
        });
        self.labels.insert(label, node);
    }

    fn right_side(&mut self, rest: &mut Rest) -> Result<Line, TextError> {
        let (column, word) = rest.name("an operation")?;
        let op = match word.as_str() {
            "input" => {
                let (column, name) = rest.name("the name of an input")?;
                if !self.inputs.contains(&name) {
                    return Err(rest.error(column, format!("`{name}` is neither a variable nor a parameter")));
                }
                return Ok(Line::Input(name));
            }
            "number" => {
                let numerator = rest.digits()?;
                let column = rest.column();
                let denominator = if rest.take(&Token::Slash) { rest.digits()? } else { Rational::ONE };
                if denominator.is_zero() {
                    return Err(rest.error(column, "a denominator is not zero"));
                }
                Op::Number(numerator / denominator)
            }
            "pi" => Op::Pi,
            "add" => Op::Add(self.node(rest)?, self.node(rest)?),
            "sub" => Op::Sub(self.node(rest)?, self.node(rest)?),
            "mul" => Op::Mul(self.node(rest)?, self.node(rest)?),
            "div" => Op::Div(self.node(rest)?, self.node(rest)?),
            "sqrt" => Op::Sqrt(self.value(rest)?),
            "sin" => Op::Sin(self.node(rest)?),
            "cos" => Op::Cos(self.node(rest)?),
            "sign" => Op::Sign(self.node(rest)?),
            "atan2" => Op::Atan2(self.value(rest)?, self.value(rest)?),
            _ => return Err(rest.error(column, format!("there is no operation `{word}`"))),
        };
        Ok(Line::Done(op))
    }

    /// A value that has no sign.
    fn node(&mut self, rest: &mut Rest) -> Result<u32, TextError> {
        let column = rest.column();
        let v = self.value(rest)?;
        if v.negative {
            return Err(rest.error(column, "signs stand on results and on operands of sqrt and atan2 only"));
        }
        Ok(v.node)
    }

    fn value(&mut self, rest: &mut Rest) -> Result<Value, TextError> {
        let negative = rest.take(&Token::Minus);
        let column = rest.column();
        match rest.next() {
            Some(Token::Label(label)) => match self.labels.get(label) {
                Some(&node) => Ok(Value { node, negative }),
                None => Err(rest.error(column, "this value is not defined above")),
            },
            _ => Err(rest.error(column, "expected a value: `%` and its name or number")),
        }
    }
}

/// The tokens of a line, each with its column, and the column behind the last character.
pub(crate) fn tokens(line: usize, text: &str) -> Result<(Vec<(usize, Token)>, usize), TextError> {
    let mut found = vec![];
    let mut chars: Chars = (1..).zip(text.chars()).peekable();
    let end = text.chars().count() + 1;
    while let Some((column, c)) = chars.next() {
        let error = |column: usize, message: &str| TextError { line, column, message: message.into() };
        let token = match c {
            '#' => break,
            '=' => Token::Equals,
            '-' => Token::Minus,
            '/' => Token::Slash,
            '"' => Token::Quoted(quotation(&mut chars).map_err(|m| error(column, m))?),
            '%' => match chars.next() {
                Some((column, '"')) => {
                    Token::Label(Label::Name(quotation(&mut chars).map_err(|m| error(column, m))?))
                }
                Some((_, c)) if is_bare(c) => {
                    let label = bare(c, &mut chars);
                    Token::Label(if is_number(&label) { Label::Number(label) } else { Label::Name(label) })
                }
                _ => return Err(error(column, "expected a name or number behind `%`")),
            },
            c if c.is_whitespace() => continue,
            c if is_bare(c) => Token::Word(bare(c, &mut chars)),
            c => return Err(error(column, &format!("unexpected character `{}`", c.escape_debug()))),
        };
        found.push((column, token));
    }
    Ok((found, end))
}

/// The characters of a line that are not read yet, each with its column.
type Chars<'a> = Peekable<Zip<RangeFrom<usize>, std::str::Chars<'a>>>;

/// The rest of a bare name behind its first character.
fn bare(first: char, chars: &mut Chars) -> String {
    let mut name = String::from(first);
    while let Some((_, c)) = chars.next_if(|c| is_bare(c.1)) {
        name.push(c);
    }
    name
}

/// A name in quotes behind the first of them.
fn quotation(chars: &mut Chars) -> Result<String, &'static str> {
    let mut name = String::new();
    loop {
        match chars.next().map(|c| c.1) {
            None => return Err("this quote is not closed"),
            Some('"') => return Ok(name),
            Some('\\') => match chars.next().map(|c| c.1) {
                Some(c @ ('"' | '\\')) => name.push(c),
                Some('u') => name.push(code_point(chars).ok_or("expected a character as in `\\u{a}`")?),
                _ => {
                    return Err(
                        "behind a backslash stand a quote, a backslash or a character as in `\\u{a}`",
                    );
                }
            },
            Some(c) => name.push(c),
        }
    }
}

fn code_point(chars: &mut Chars) -> Option<char> {
    chars.next_if(|c| c.1 == '{')?;
    let mut code = 0_u32;
    loop {
        match chars.next()?.1 {
            '}' => return char::from_u32(code),
            c => code = code.checked_mul(16)?.checked_add(c.to_digit(16)?)?,
        }
    }
}

/// The label that a line which cannot be read starts with.
fn first_label(text: &str) -> Option<Label> {
    let name: String = text.trim_start().strip_prefix('%')?.chars().take_while(|c| is_bare(*c)).collect();
    match name.as_str() {
        "" => None,
        label if is_number(label) => Some(Label::Number(name)),
        _ => Some(Label::Name(name)),
    }
}
