//! xacro's expressions: the part of Python that files have.

use super::scope::Scope;
use super::sequence::{self, entry, method, slice};
use super::value::{Fault, Val, arithmetic, compared, function};
use crate::description::xml::shown;
use denavit_symbolic::{Expr, Rational};
use std::rc::Rc;

/// The longest expression, in bytes, and how deep brackets may stand in brackets.
pub(super) const MAX_LENGTH: usize = 4000;
const MAX_DEPTH: usize = 60;
/// How many values an expression works out that goes through lists.
const MAX_STEPS: usize = 200_000;

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
    "}", ":", "=",
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
    /// The names that `for` gives values, the innermost last.
    locals: Vec<(String, Val)>,
    steps: usize,
    around: &'n mut Around<'n>,
}

/// The value of an expression.
pub(super) fn evaluate<'n>(text: &str, around: &'n mut Around<'n>) -> Result<Val, Fault> {
    if text.len() > MAX_LENGTH {
        return Err(Fault::new(format!("an expression of {} bytes; {MAX_LENGTH} are allowed", text.len())));
    }
    let tokens = tokens(text)?;
    let mut reader = Reader { tokens, next: 0, depth: 0, is_live: true, locals: vec![], steps: 0, around };
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
    fn live(&mut self, value: impl FnOnce() -> Result<Val, Fault>) -> Result<Val, Fault> {
        match self.is_live {
            true => value().and_then(|v| self.counted(v)),
            false => Ok(Val::Truth(false)),
        }
    }

    /// A value, with the values that it consists of counted.
    fn counted(&mut self, value: Val) -> Result<Val, Fault> {
        self.steps += if let Val::List(all) = &value { 1 + all.len() } else { 1 };
        match self.steps > MAX_STEPS {
            true => Err(Fault::new(format!("an expression of more than {MAX_STEPS} values"))),
            false => Ok(value),
        }
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

    /// `a < b`, `a not in b`, and chains of them: `a < b <= c` is `a < b and b <= c`.
    fn comparison(&mut self) -> Result<Val, Fault> {
        let mut a = self.sum()?;
        let mut holds: Option<bool> = None;
        while let Some(sign) = self.compares() {
            // What stands behind a comparison that fails is not evaluated.
            let is_over = holds == Some(false);
            let b = self.unless(is_over, Self::sum)?;
            holds = Some(self.is_live && !is_over && compared(sign, &a, &b)?);
            a = b;
        }
        match holds {
            None => Ok(a),
            Some(holds) => self.live(|| Ok(Val::Truth(holds))),
        }
    }

    /// What compares the value before it with the one behind.
    fn compares(&mut self) -> Option<&'static str> {
        let start = self.next;
        let is_not = self.word("not");
        if self.word("in") {
            return Some(if is_not { "not in" } else { "in" });
        }
        self.next = start;
        self.sign(&["==", "!=", "<=", ">=", "<", ">"])
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
                value = self.index(&value)?;
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

    /// What stands behind `[`: an index, or `from:to:step`.
    fn index(&mut self, value: &Val) -> Result<Val, Fault> {
        let mut parts: Vec<Option<Val>> = vec![None];
        while self.sign(&["]"]).is_none() {
            if self.sign(&[":"]).is_some() {
                parts.push(None);
            } else if let Some(last) = parts.last_mut().filter(|l| l.is_none()) {
                *last = Some(self.choice()?);
            } else {
                self.needs("]")?;
            }
        }
        match &parts[..] {
            [Some(index)] => self.live(|| entry(value, index)),
            [from, to] => self.live(|| slice(value, [from.as_ref(), to.as_ref(), None])),
            [from, to, step] => self.live(|| slice(value, [from.as_ref(), to.as_ref(), step.as_ref()])),
            _ => Err(Fault::new("an index is missing")),
        }
    }

    /// The value of a name.
    fn name(&mut self, name: &str) -> Result<Val, Fault> {
        match self.locals.iter().rev().find(|l| l.0 == name) {
            Some((_, value)) => Ok(value.clone()),
            None => (self.around)(Asked::Name(name)),
        }
    }

    fn atom(&mut self) -> Result<Val, Fault> {
        self.counted(Val::Truth(false))?;
        let Some(token) = self.peek().cloned() else {
            return Err(Fault::new("an expression that is not complete"));
        };
        self.next += 1;
        match token {
            Token::Number(x) => Ok(Val::Number(x.into())),
            Token::Text(t) => Ok(Val::Text(t)),
            Token::Sign("(") => {
                let start = self.next;
                let mut all = self.list(")")?;
                let is_list = all.len() != 1 || self.comma_in(start);
                Ok(if is_list { Val::List(Rc::new(all)) } else { all.remove(0) })
            }
            Token::Sign("[") => Ok(Val::List(Rc::new(self.list("]")?))),
            Token::Word(w) if w == "True" || w == "true" => Ok(Val::Truth(true)),
            Token::Word(w) if w == "False" || w == "false" => Ok(Val::Truth(false)),
            Token::Word(mut w) => {
                // math.sin, xacro.load_yaml; a namespace of the file's own may have such a name.
                let is_module = MODULES.contains(&w.as_str())
                    && self.peek() == Some(&Token::Sign("."))
                    && (!self.is_live || self.name(&w).is_err());
                if is_module {
                    self.next += 1;
                    let Some(Token::Word(inner)) = self.peek().cloned() else {
                        return Err(Fault::new("a name is missing"));
                    };
                    self.next += 1;
                    w = inner;
                }
                if self.sign(&["("]).is_some() {
                    if w == "dict" {
                        return self.dict();
                    }
                    let arguments = self.list(")")?;
                    if !self.is_live {
                        return Ok(Val::Truth(false));
                    }
                    let value = self.function(&w, &arguments)?;
                    return self.counted(value);
                }
                if self.is_live { self.name(&w) } else { Ok(Val::Truth(false)) }
            }
            other => Err(unexpected(&other)),
        }
    }

    /// `dict(a=1, b=2)`, `dict([("a", 1)])`: values by name.
    fn dict(&mut self) -> Result<Val, Fault> {
        let mut all: Vec<(String, Val)> = vec![];
        while self.sign(&[")"]).is_none() {
            let name = match (self.peek(), self.tokens.get(self.next + 1)) {
                (Some(Token::Word(name)), Some(Token::Sign("="))) => Some(name.clone()),
                _ => None,
            };
            self.next += if name.is_some() { 2 } else { 0 };
            let value = self.choice()?;
            let entries = match (name, &value) {
                _ if !self.is_live => vec![],
                (Some(name), _) => vec![(name, value)],
                (None, Val::Map(map)) => map.to_vec(),
                (None, pairs) => {
                    let pair = |pair: Val| match &pair.items()?[..] {
                        [name, value] => Ok((name.show(), value.clone())),
                        _ => Err(Fault::new("`dict` takes pairs of a name and a value")),
                    };
                    pairs.items()?.into_iter().map(pair).collect::<Result<_, _>>()?
                }
            };
            all = sequence::united(all, entries)?;
            if self.sign(&[","]).is_none() {
                self.needs(")")?;
                break;
            }
        }
        self.counted(Val::Map(Rc::new(all)))
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

    /// Values between commas, or one for each of others: `a, b`, `2*x for x in list if x > 1`.
    fn list(&mut self, end: &'static str) -> Result<Vec<Val>, Fault> {
        let (start, mut all) = (self.next, vec![]);
        if let Some(part) = self.with_for(end) {
            let locals = self.locals.len();
            self.next = part;
            let found = self.each(start, &mut all);
            self.locals.truncate(locals);
            found?;
            self.needs(end)?;
            return Ok(all);
        }
        while self.sign(&[end]).is_none() {
            all.push(self.choice()?);
            if self.sign(&[","]).is_none() {
                self.needs(end)?;
                break;
            }
        }
        Ok(all)
    }

    /// How deep each token from `start` on stands in the brackets that open there, up to where the one around them closes.
    fn depths(&self, start: usize) -> impl Iterator<Item = (usize, usize)> {
        let depth = |depth: &mut usize, (at, token): (usize, &Token)| {
            match token {
                Token::Sign("(" | "[" | "{") => *depth += 1,
                Token::Sign(")" | "]" | "}") if *depth == 0 => return None,
                Token::Sign(")" | "]" | "}") => *depth -= 1,
                _ => {}
            }
            Some((at, *depth))
        };
        self.tokens.iter().enumerate().skip(start).scan(0, depth)
    }

    /// Where `for` stands in the list at hand, if it is of such a kind.
    fn with_for(&self, end: &'static str) -> Option<usize> {
        let word = Token::Word("for".into());
        let is_list = end != "}" && self.tokens[self.next..].contains(&word);
        self.depths(self.next)
            .filter(|_| is_list)
            .find(|&(at, d)| d == 0 && self.tokens[at] == word)
            .map(|f| f.0)
    }

    /// True if a comma stands between the values of the bracket that opens before `start`.
    fn comma_in(&self, start: usize) -> bool {
        self.depths(start).any(|(at, d)| d == 0 && self.tokens[at] == Token::Sign(","))
    }

    /// `for x in list if c for y in …`, with what stands at `start` for each.
    fn each(&mut self, start: usize, all: &mut Vec<Val>) -> Result<(), Fault> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return Err(Fault::new(format!("more than {MAX_DEPTH} brackets in brackets")));
        }
        if self.word("for") {
            let mut names = vec![];
            loop {
                let Some(Token::Word(name)) = self.peek().cloned() else {
                    return Err(Fault::new("a name is missing behind `for`"));
                };
                self.next += 1;
                names.push(name);
                if self.sign(&[","]).is_none() {
                    break;
                }
            }
            if !self.word("in") {
                return Err(Fault::new("`in` is missing"));
            }
            let values = self.or()?;
            let inner = self.next;
            // What is not evaluated is gone through once, with names that mean nothing.
            let values = if self.is_live { values.items()? } else { vec![] };
            let is_live = std::mem::replace(&mut self.is_live, false);
            self.each(start, &mut vec![])?;
            self.is_live = is_live;
            let end = self.next;
            let locals = self.locals.len();
            for value in values {
                let parts = if names.len() == 1 { vec![value] } else { value.items()? };
                if parts.len() != names.len() {
                    let message = format!("{} values for {} names", parts.len(), names.len());
                    return Err(Fault::new(message));
                }
                self.locals.extend(names.iter().cloned().zip(parts));
                self.next = inner;
                self.each(start, all)?;
                self.locals.truncate(locals);
            }
            self.next = end;
        } else if self.word("if") {
            let condition = self.or()?;
            let is_live = self.is_live;
            self.is_live = is_live && condition.holds()?;
            self.each(start, all)?;
            self.is_live = is_live;
        } else {
            let end = std::mem::replace(&mut self.next, start);
            let value = self.choice()?;
            if !matches!(self.peek(), Some(Token::Word(w)) if w == "for") {
                return Err(Fault::new("`for` stands behind one value"));
            }
            self.next = end;
            if self.is_live {
                all.push(value);
            }
        }
        self.depth -= 1;
        Ok(())
    }
}
