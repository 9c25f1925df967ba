//! xacro's expressions: the part of Python that files have.

use super::scope::Scope;
use super::value::{Fault, Val, arithmetic, function, real};
use crate::description::{diagnostic::nearest, xml::shown};
use denavit_symbolic::{Expr, Rational};
use std::rc::Rc;

/// The longest expression, in bytes, and how deep brackets may stand in brackets.
const MAX_LENGTH: usize = 4000;
const MAX_DEPTH: usize = 60;

#[derive(Clone, PartialEq, Debug)]
enum Token {
    Number(Rational),
    Word(String),
    Text(String),
    Sign(&'static str),
}

/// Signs, longer ones first.
const SIGNS: &[&str] = &[
    "**", "//", "==", "!=", "<=", ">=", "-", "+", "*", "/", "%", "(", ")", "[", "]", ".", ",", "<", ">", "{",
    "}", ":",
];

/// What an expression asks of what is around it.
#[derive(Clone, Copy)]
pub(super) enum Asked<'a> {
    /// The value of a name.
    Name(&'a str),
    /// The value of a name in a namespace.
    Member(Scope, &'a str),
    /// The value of an argument, as text.
    Argument(&'a str),
    /// The folder of a package.
    Package(&'a str),
    /// The folder of the file at hand.
    Folder,
    /// The path of a file that the one at hand names.
    File(&'a str),
    /// What a file of YAML holds.
    Values(&'a str),
}

/// Who answers.
type Around<'n> = dyn FnMut(Asked) -> Result<Val, Fault> + 'n;

/// Modules whose names may stand before what is in them.
const MODULES: &[&str] = &["math", "xacro", "python", "numpy", "np"];

/// An expression being evaluated; what is not chosen of `a if c else b` is read and not evaluated.
struct Reader<'n> {
    tokens: Vec<Token>,
    next: usize,
    depth: usize,
    is_live: bool,
    around: &'n mut Around<'n>,
}

/// The value of an expression.
pub(super) fn evaluate<'n>(text: &str, around: &'n mut Around<'n>) -> Result<Val, Fault> {
    if text.len() > MAX_LENGTH {
        return Err(Fault::new(format!("an expression of {} bytes; {MAX_LENGTH} are allowed", text.len())));
    }
    let mut reader = Reader { tokens: tokens(text)?, next: 0, depth: 0, is_live: true, around };
    let value = reader.choice()?;
    match reader.peek() {
        None => Ok(value),
        Some(token) => Err(unexpected(token)),
    }
}

fn tokens(text: &str) -> Result<Vec<Token>, Fault> {
    let mut found = vec![];
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let length;
        if first.is_ascii_digit() || first == '.' && rest[1..].starts_with(|c: char| c.is_ascii_digit()) {
            length = number_length(rest);
            let number = Rational::from_decimal(&rest[..length]);
            found.push(Token::Number(
                number.ok_or_else(|| Fault::new(format!("`{}` is no number", shown(rest))))?,
            ));
        } else if first.is_alphabetic() || first == '_' {
            length = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
            found.push(Token::Word(rest[..length].into()));
        } else if first == '\'' || first == '"' {
            let end = rest[1..].find(first).ok_or_else(|| Fault::new("a quote that is not closed"))?;
            length = end + 2;
            found.push(Token::Text(rest[1..=end].into()));
        } else if let Some(sign) = SIGNS.iter().find(|s| rest.starts_with(**s)) {
            length = sign.len();
            found.push(Token::Sign(sign));
        } else {
            return Err(Fault::new(format!("`{}` is not understood", shown(rest))));
        }
        rest = rest[length..].trim_start();
    }
    Ok(found)
}

/// The length of the decimal that a text begins with.
fn number_length(text: &str) -> usize {
    let digits = |from: usize| text[from..].bytes().take_while(u8::is_ascii_digit).count();
    let mut at = digits(0);
    if text[at..].starts_with('.') {
        at += 1 + digits(at + 1);
    }
    if let Some(exponent) = text[at..].strip_prefix(['e', 'E']) {
        let sign = usize::from(exponent.starts_with(['+', '-']));
        let count = digits(at + 1 + sign);
        if count > 0 {
            at += 1 + sign + count;
        }
    }
    at
}

fn unexpected(token: &Token) -> Fault {
    let text = match token {
        Token::Number(_) => "a number".to_string(),
        Token::Word(w) => format!("`{}`", shown(w)),
        Token::Text(_) => "a text".into(),
        Token::Sign(s) => format!("`{s}`"),
    };
    Fault::new(format!("{text} is not understood here"))
}

impl Reader<'_> {
    fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.next)
    }

    fn sign(&mut self, among: &[&'static str]) -> Option<&'static str> {
        let Some(Token::Sign(sign)) = self.peek() else { return None };
        let found = among.iter().find(|s| *s == sign).copied();
        self.next += usize::from(found.is_some());
        found
    }

    fn word(&mut self, word: &str) -> bool {
        let found = matches!(self.peek(), Some(Token::Word(w)) if w == word);
        self.next += usize::from(found);
        found
    }

    fn needs(&mut self, sign: &'static str) -> Result<(), Fault> {
        self.sign(&[sign]).map(|_| ()).ok_or_else(|| Fault::new(format!("`{sign}` is missing")))
    }

    /// What a part gives that is evaluated; nothing of use otherwise.
    fn live(&self, value: impl FnOnce() -> Result<Val, Fault>) -> Result<Val, Fault> {
        if self.is_live { value() } else { Ok(Val::Truth(false)) }
    }

    fn unless(&mut self, dead: bool, part: fn(&mut Self) -> Result<Val, Fault>) -> Result<Val, Fault> {
        let before = self.is_live;
        self.is_live = before && !dead;
        let value = part(self);
        self.is_live = before;
        value
    }

    /// `a if c else b`
    fn choice(&mut self) -> Result<Val, Fault> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return Err(Fault::new(format!("more than {MAX_DEPTH} brackets in brackets")));
        }
        let start = self.next;
        let has_choice = self.is_live && self.tokens.contains(&Token::Word("if".into()));
        let mut value = self.unless(has_choice, Self::or)?;
        if self.word("if") {
            let condition = self.or()?;
            let takes = self.is_live && condition.holds()?;
            if !self.word("else") {
                return Err(Fault::new("`else` is missing"));
            }
            let other = self.unless(takes, Self::choice)?;
            if takes {
                let end = std::mem::replace(&mut self.next, start);
                value = self.or()?;
                self.next = end;
            } else {
                value = other;
            }
        } else if has_choice {
            self.next = start;
            value = self.or()?;
        }
        self.depth -= 1;
        Ok(value)
    }

    fn or(&mut self) -> Result<Val, Fault> {
        let mut value = self.and()?;
        while self.word("or") {
            let is_true = self.is_live && value.holds()?;
            let other = self.unless(is_true, Self::and)?;
            value = if is_true { value } else { other };
        }
        Ok(value)
    }

    fn and(&mut self) -> Result<Val, Fault> {
        let mut value = self.not()?;
        while self.word("and") {
            let is_false = self.is_live && !value.holds()?;
            let other = self.unless(is_false, Self::not)?;
            value = if is_false { value } else { other };
        }
        Ok(value)
    }

    fn not(&mut self) -> Result<Val, Fault> {
        let mut times = 0;
        while self.word("not") {
            times += 1;
        }
        let value = self.comparison()?;
        if times == 0 {
            return Ok(value);
        }
        self.live(|| Ok(Val::Truth(value.holds()? == (times % 2 == 0))))
    }

    fn comparison(&mut self) -> Result<Val, Fault> {
        let a = self.sum()?;
        if self.word("in") {
            let b = self.sum()?;
            return self.live(|| match &b {
                Val::List(l) => Ok(Val::Truth(l.iter().any(|x| is_same(&a, x)))),
                Val::Map(m) => Ok(Val::Truth(m.iter().any(|x| x.0 == a.show()))),
                other => Ok(Val::Truth(other.show().contains(&a.show()))),
            });
        }
        let Some(sign) = self.sign(&["==", "!=", "<=", ">=", "<", ">"]) else { return Ok(a) };
        let b = self.sum()?;
        self.live(|| {
            if matches!(sign, "==" | "!=") {
                return Ok(Val::Truth(is_same(&a, &b) == (sign == "==")));
            }
            let difference = real(a.expr()? - b.expr()?)?;
            let (below, equal) = (difference.is_negative(), difference.is_zero());
            Ok(Val::Truth(match sign {
                "<" => below && !equal,
                "<=" => below || equal,
                ">" => !below && !equal,
                _ => !below || equal,
            }))
        })
    }

    fn sum(&mut self) -> Result<Val, Fault> {
        let mut value = self.product()?;
        while let Some(sign) = self.sign(&["+", "-"]) {
            let other = self.product()?;
            value = self.live(|| arithmetic(sign, &value, &other))?;
        }
        Ok(value)
    }

    fn product(&mut self) -> Result<Val, Fault> {
        let mut value = self.signed()?;
        while let Some(sign) = self.sign(&["*", "/", "%", "//"]) {
            let other = self.signed()?;
            value = self.live(|| arithmetic(sign, &value, &other))?;
        }
        Ok(value)
    }

    fn signed(&mut self) -> Result<Val, Fault> {
        let mut is_negative = false;
        let mut is_signed = false;
        while let Some(sign) = self.sign(&["-", "+"]) {
            is_signed = true;
            is_negative ^= sign == "-";
        }
        let mut value = self.called()?;
        if self.sign(&["**"]).is_some() {
            self.depth += 1;
            if self.depth > MAX_DEPTH {
                return Err(Fault::new("too many powers of powers"));
            }
            let exponent = self.signed()?;
            self.depth -= 1;
            value = self.live(|| arithmetic("**", &value, &exponent))?;
        }
        match is_signed {
            true => self
                .live(|| arithmetic(if is_negative { "-" } else { "+" }, &Val::Number(Expr::int(0)), &value)),
            false => Ok(value),
        }
    }

    /// Indices and methods behind a value.
    fn called(&mut self) -> Result<Val, Fault> {
        let mut value = self.atom()?;
        loop {
            if self.sign(&["["]).is_some() {
                let index = self.choice()?;
                self.needs("]")?;
                value = self.live(|| entry(&value, &index))?;
            } else if self.sign(&["."]).is_some() {
                let Some(Token::Word(name)) = self.peek().cloned() else {
                    return Err(Fault::new("a name is missing"));
                };
                self.next += 1;
                let arguments = if self.sign(&["("]).is_some() { Some(self.list(")")?) } else { None };
                if self.is_live {
                    value = match (arguments, &value) {
                        (Some(arguments), _) => method(&value, &name, &arguments)?,
                        (None, Val::Space(space)) => (self.around)(Asked::Member(*space, &name))?,
                        (None, _) => entry(&value, &Val::Text(name))?,
                    };
                }
            } else {
                return Ok(value);
            }
        }
    }

    fn atom(&mut self) -> Result<Val, Fault> {
        let Some(token) = self.peek().cloned() else {
            return Err(Fault::new("an expression that is not complete"));
        };
        self.next += 1;
        match token {
            Token::Number(x) => Ok(Val::Number(x.into())),
            Token::Text(t) => Ok(Val::Text(t)),
            Token::Sign("(") => {
                let value = self.choice()?;
                self.needs(")")?;
                Ok(value)
            }
            Token::Sign("[") => Ok(Val::List(Rc::new(self.list("]")?))),
            Token::Word(w) if w == "True" || w == "true" => Ok(Val::Truth(true)),
            Token::Word(w) if w == "False" || w == "false" => Ok(Val::Truth(false)),
            Token::Word(mut w) => {
                // math.sin, xacro.load_yaml; a namespace of the file's own may have such a name.
                let is_module = MODULES.contains(&w.as_str())
                    && self.peek() == Some(&Token::Sign("."))
                    && (!self.is_live || (self.around)(Asked::Name(&w)).is_err());
                if is_module {
                    self.next += 1;
                    let Some(Token::Word(inner)) = self.peek().cloned() else {
                        return Err(Fault::new("a name is missing"));
                    };
                    self.next += 1;
                    w = inner;
                }
                if self.sign(&["("]).is_some() {
                    let arguments = self.list(")")?;
                    return if self.is_live { self.function(&w, &arguments) } else { Ok(Val::Truth(false)) };
                }
                if self.is_live { (self.around)(Asked::Name(&w)) } else { Ok(Val::Truth(false)) }
            }
            other => Err(unexpected(&other)),
        }
    }

    /// The value of a function; some ask for what is around the expression.
    fn function(&mut self, name: &str, arguments: &[Val]) -> Result<Val, Fault> {
        let asked: fn(&str) -> Asked = match name {
            "load_yaml" => |file| Asked::Values(file),
            "arg" => |name| Asked::Argument(name),
            "abs_filename" => |file| Asked::File(file),
            "find" => |package| Asked::Package(package),
            "dirname" if arguments.is_empty() => return (self.around)(Asked::Folder),
            _ => return function(name, arguments),
        };
        let [Val::Text(text)] = arguments else {
            return Err(Fault::new(format!("`{}` takes a text", shown(name))));
        };
        (self.around)(asked(text))
    }

    fn list(&mut self, end: &'static str) -> Result<Vec<Val>, Fault> {
        let mut all = vec![];
        while self.sign(&[end]).is_none() {
            all.push(self.choice()?);
            if self.sign(&[","]).is_none() {
                self.needs(end)?;
                break;
            }
        }
        Ok(all)
    }
}

fn is_same(a: &Val, b: &Val) -> bool {
    let is_text = |v: &Val| matches!(v, Val::Text(_));
    match (a.expr(), b.expr()) {
        (Ok(x), Ok(y)) if !(is_text(a) && is_text(b)) => real(x - y).is_ok_and(|d| d.is_zero()),
        _ => a.show() == b.show(),
    }
}

fn entry(value: &Val, index: &Val) -> Result<Val, Fault> {
    let all = match value {
        Val::List(all) => all,
        Val::Map(all) => {
            let name = index.show();
            let found = all.iter().find(|e| e.0 == name).map(|e| e.1.clone());
            return found.ok_or_else(|| {
                let fault = Fault::new(format!("there is no `{}`", shown(&name)));
                match nearest(&name, all.iter().map(|e| e.0.as_str())) {
                    Some(near) => fault.hint(format!("did you mean `{near}`?")),
                    None => fault,
                }
            });
        }
        _ => return Err(Fault::new("an index behind what is no list")),
    };
    let at = index.index()?;
    let at = if at < 0 { at + all.len() as i64 } else { at };
    let found = usize::try_from(at).ok().and_then(|i| all.get(i)).cloned();
    found.ok_or_else(|| Fault::new(format!("there is no entry {}: the list has {}", index.show(), all.len())))
}

/// What a value answers to a method.
fn method(value: &Val, name: &str, arguments: &[Val]) -> Result<Val, Fault> {
    let list = |all: Vec<Val>| Ok(Val::List(Rc::new(all)));
    if let Val::Map(all) = value {
        return match (name, arguments) {
            ("keys", []) => list(all.iter().map(|e| Val::Text(e.0.clone())).collect()),
            ("values", []) => list(all.iter().map(|e| e.1.clone()).collect()),
            ("get", [key]) => entry(value, key),
            ("get", [key, otherwise]) => Ok(entry(value, key).unwrap_or_else(|_| otherwise.clone())),
            _ => Err(Fault::new(format!("`.{}` is not read", shown(name)))),
        };
    }
    let text = value.show();
    let texts: Vec<String> = arguments.iter().map(Val::show).collect();
    let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
    match (name, &texts[..]) {
        ("lower", []) => Ok(Val::Text(text.to_lowercase())),
        ("upper", []) => Ok(Val::Text(text.to_uppercase())),
        ("strip", []) => Ok(Val::Text(text.trim().into())),
        ("startswith", [start]) => Ok(Val::Truth(text.starts_with(start))),
        ("endswith", [end]) => Ok(Val::Truth(text.ends_with(end))),
        ("split", []) => list(text.split_whitespace().map(|t| Val::Text(t.into())).collect()),
        ("split", [at]) if !at.is_empty() => list(text.split(at).map(|t| Val::Text(t.into())).collect()),
        ("replace", [old, new])
            if !old.is_empty() && text.len() * new.len().max(1) <= MAX_LENGTH * MAX_LENGTH =>
        {
            Ok(Val::Text(text.replace(old, new)))
        }
        _ => Err(Fault::new(format!("`.{}` is not read", shown(name)))),
    }
}
