//! The grammar of a cell.

use super::lexer::{Fault, Kind, Token, tokens};
use super::{Severity, Style, Value, special};
use crate::description::units::{Quantity, Unit, unit_at, unit_named};
use denavit_symbolic::{Expr, Rational};
use std::ops::Range;

/// Brackets deeper than this are no table cell.
const MAX_DEPTH: usize = 40;
/// The largest power, and how many powers a cell may hold: numbers stay short.
const MAX_POWER: i64 = 9;
const MAX_POWERS: usize = 8;

/// The functions that a cell may call.
pub(super) const FUNCTIONS: &[&str] = &["sin", "cos", "tan", "sqrt", "atan2"];

type Finding = (Severity, Range<usize>, String);

/// A part of a formula, and what is known of its unit.
#[derive(Clone)]
struct Term {
    expr: Expr,
    span: Range<usize>,
    /// A name occurs.
    symbolic: bool,
    /// A unit occurs, or π in an angle.
    dimensioned: bool,
    /// Significant digits, if it is a single number.
    digits: Option<usize>,
}

impl Term {
    /// A number that still takes a unit.
    fn is_bare(&self) -> bool {
        !self.symbolic && !self.dimensioned
    }
}

struct Parser<'a> {
    text: &'a str,
    tokens: Vec<Token>,
    at: usize,
    style: &'a Style,
    measures: Option<Quantity>,
    symbols: Vec<(String, Range<usize>)>,
    bare: Vec<(f64, Range<usize>)>,
    findings: Vec<Finding>,
    powers: usize,
}

/// Reads a cell; spans are bytes of `text`.
pub(super) fn parse(text: &str, style: &Style) -> Result<(Value, Vec<Finding>), Fault> {
    let tokens = tokens(text, style.document, style.decimal_comma)?;
    let mut p = Parser {
        text,
        tokens,
        at: 0,
        style,
        measures: None,
        symbols: vec![],
        bare: vec![],
        findings: vec![],
        powers: 0,
    };
    if p.tokens.is_empty() {
        return Err(Fault::new(0..0, "an empty cell").hint("write 0 where there is nothing"));
    }
    let term = p.sum(0, true)?;
    if let Some(token) = p.tokens.get(p.at) {
        let span = token.span.clone();
        return Err(Fault::new(span.clone(), format!("`{}` is not expected here", &text[span])));
    }
    let finite = term.expr.eval(|_| Some(1.0)).is_ok_and(f64::is_finite);
    if !finite && p.symbols.is_empty() {
        return Err(Fault::new(0..text.len(), "the value is not a finite number"));
    }
    Ok((Value { expr: term.expr, symbols: p.symbols, bare: p.bare }, p.findings))
}

impl Parser<'_> {
    fn peek(&self) -> Option<&Kind> {
        self.tokens.get(self.at).map(|t| &t.kind)
    }

    fn peek_sign(&self) -> Option<char> {
        match self.peek() {
            Some(Kind::Sign(c)) => Some(*c),
            _ => None,
        }
    }

    fn take_sign(&mut self, sign: char) -> bool {
        let found = self.peek_sign() == Some(sign);
        self.at += usize::from(found);
        found
    }

    /// Where the next token stands, or the end.
    fn here(&self) -> Range<usize> {
        self.tokens.get(self.at).map_or(self.text.len()..self.text.len(), |t| t.span.clone())
    }

    fn expect(&mut self, sign: char) -> Result<(), Fault> {
        if self.take_sign(sign) {
            return Ok(());
        }
        let what = self
            .tokens
            .get(self.at)
            .map_or("the end".to_string(), |t| format!("`{}`", &self.text[t.span.clone()]));
        let message = format!("`{sign}` is missing before {what}");
        Err(Fault::new(self.tokens.get(self.at).map_or(0..self.text.len(), |t| t.span.clone()), message))
    }

    fn sum(&mut self, depth: usize, top: bool) -> Result<Term, Fault> {
        if depth > MAX_DEPTH {
            return Err(Fault::new(self.here(), format!("brackets more than {MAX_DEPTH} deep")));
        }
        let start = self.here().start;
        let mut terms = vec![];
        let mut negative = self.take_sign('-');
        if !negative {
            self.take_sign('+');
        }
        loop {
            terms.push((negative, self.term(depth)?));
            match self.peek_sign() {
                Some(c @ ('+' | '-')) => {
                    self.at += 1;
                    negative = c == '-';
                }
                _ => break,
            }
        }
        let symbolic = terms.iter().any(|t| t.1.symbolic);
        let dimensioned = terms.iter().any(|t| t.1.dimensioned);
        let digits = if let [(_, only)] = terms.as_slice() { only.digits } else { None };
        let mut expr = Expr::int(0);
        for (negative, term) in terms {
            let bare_length = term.is_bare() && (top || symbolic || dimensioned);
            let value = if bare_length { self.with_bare_unit(&term) } else { term.expr };
            expr = if negative { expr - value } else { expr + value };
        }
        let end = self.tokens[..self.at].last().map_or(start, |t| t.span.end);
        Ok(Term { expr, span: start..end.max(start), symbolic, dimensioned, digits })
    }

    /// A number without unit, in SI.
    fn with_bare_unit(&mut self, term: &Term) -> Expr {
        let Some(number) = term.expr.as_number().filter(|r| !r.is_zero()) else { return term.expr };
        self.bare.push((number.to_f64(), term.span.clone()));
        match self.style.bare {
            Some(unit) => term.expr * unit.factor(),
            None if self.style.quantity == Quantity::Angle => self.exact_angle(&number, term),
            None => term.expr,
        }
    }

    /// A number of radians: the multiple of π/12 whose nearest double it is, or itself.
    fn exact_angle(&mut self, radians: &Rational, term: &Term) -> Expr {
        let shown = &self.text[term.span.clone()];
        match special::recognise(radians, term.digits.unwrap_or(0)) {
            special::Angle::Exactly(multiple) => {
                let name = special::name(&multiple);
                self.findings.push((Severity::Note, term.span.clone(), format!("{shown} is read as {name}")));
                Expr::from(multiple) * Expr::pi()
            }
            special::Angle::Nearly(multiple, off) => {
                if self.style.nearly {
                    let name = special::name(&multiple);
                    let message = format!("{shown} is nearly {name} (off by {off:.1e} rad)");
                    self.findings.push((Severity::Warning, term.span.clone(), message));
                }
                radians.clone().into()
            }
            special::Angle::Plain => radians.clone().into(),
        }
    }

    fn term(&mut self, depth: usize) -> Result<Term, Fault> {
        let mut term = self.product(depth)?;
        if let Some((unit, end)) = self.unit_here() {
            let span = self.here().start..end;
            while self.tokens.get(self.at).is_some_and(|t| t.span.start < end) {
                self.at += 1;
            }
            self.apply_unit(&mut term, unit, span)?;
            while let Some(sign @ ('*' | '/')) = self.peek_sign() {
                self.at += 1;
                let factor = self.factor(depth)?;
                term = self.multiply(&term, &factor, sign)?;
            }
            if let Some(next) = self.tokens.get(self.at)
                && !matches!(next.kind, Kind::Sign(_))
            {
                let span = next.span.clone();
                let message = format!("`{}` behind a unit", &self.text[span.clone()]);
                return Err(Fault::new(span, message).hint("a product with a unit needs a `*`"));
            }
        }
        Ok(term)
    }

    /// The unit that begins at the next token, and where it ends.
    fn unit_here(&self) -> Option<(Unit, usize)> {
        let token = self.tokens.get(self.at)?;
        if let Kind::Sign(_) | Kind::Number(..) = token.kind {
            return None;
        }
        let written = unit_at(&self.text[token.span.start..]).map(|u| (u, token.span.start + u.name.len()));
        match &token.kind {
            Kind::Degree => written.or_else(|| Some((unit_named("deg")?, token.span.end))),
            Kind::Word(name) => written.or_else(|| Some((unit_named(name)?, token.span.end))),
            _ => None,
        }
    }

    fn apply_unit(&mut self, term: &mut Term, unit: Unit, span: Range<usize>) -> Result<(), Fault> {
        if term.symbolic {
            let message = format!("the unit `{}` behind a name", unit.name);
            return Err(
                Fault::new(span, message).hint("a name has its unit in its value; give numbers a unit")
            );
        }
        if term.dimensioned && !(unit.factor().is_one() && self.measures.is_none()) {
            let message = format!(
                "`{}` is in radians already; `{}` would be a second unit",
                &self.text[term.span.clone()],
                unit.name
            );
            return Err(Fault::new(span, message));
        }
        let wanted =
            if self.style.quantity == Quantity::Open { self.measures } else { Some(self.style.quantity) };
        if wanted.is_some_and(|q| q != unit.quantity) {
            let wanted = wanted.map_or("", Quantity::name);
            let message = format!("`{}` measures {}; this is {wanted}", unit.name, unit.quantity.name());
            return Err(Fault::new(span, message));
        }
        self.measures = Some(unit.quantity);
        term.expr = match term.expr.as_number() {
            Some(number) if unit.quantity == Quantity::Angle && unit.factor().is_one() => {
                self.exact_angle(&number, term)
            }
            _ => term.expr * unit.factor(),
        };
        term.dimensioned = true;
        term.span.end = span.end;
        Ok(())
    }

    fn product(&mut self, depth: usize) -> Result<Term, Fault> {
        let mut term = self.factor(depth)?;
        loop {
            let sign = match self.peek() {
                Some(Kind::Sign(c @ ('*' | '/'))) => {
                    let c = *c;
                    self.at += 1;
                    c
                }
                Some(Kind::Number(..)) => return Err(self.two_values()),
                Some(Kind::Word(_) | Kind::Fraction | Kind::Root | Kind::Sign('('))
                    if self.unit_here().is_none() =>
                {
                    if self.tokens[self.at].after_dollar {
                        return Err(self.two_values());
                    }
                    '*'
                }
                _ => return Ok(term),
            };
            let factor = self.factor(depth)?;
            term = self.multiply(&term, &factor, sign)?;
        }
    }

    fn two_values(&self) -> Fault {
        Fault::new(self.here(), "two values in one cell").hint("write a product with `*`")
    }

    fn multiply(&mut self, a: &Term, b: &Term, sign: char) -> Result<Term, Fault> {
        let span = a.span.start..b.span.end;
        if sign == '/' && b.expr.is_zero() {
            return Err(Fault::new(span, "a division by zero"));
        }
        if sign == '*' && a.dimensioned && b.dimensioned && !a.symbolic && !b.symbolic {
            return Err(Fault::new(span, "a product of two quantities with units"));
        }
        Ok(Term {
            expr: if sign == '/' { a.expr / b.expr } else { a.expr * b.expr },
            span,
            symbolic: a.symbolic || b.symbolic,
            dimensioned: a.dimensioned != b.dimensioned,
            digits: None,
        })
    }

    fn factor(&mut self, depth: usize) -> Result<Term, Fault> {
        let Some(token) = self.tokens.get(self.at).cloned() else {
            let end = self.tokens.last().map_or(0..0, |t| t.span.clone());
            return Err(Fault::new(end, "the cell ends where a value is expected"));
        };
        if depth > MAX_DEPTH {
            return Err(Fault::new(token.span, format!("brackets more than {MAX_DEPTH} deep")));
        }
        self.at += 1;
        let plain = |expr, digits| Term {
            expr,
            span: token.span.clone(),
            symbolic: false,
            dimensioned: false,
            digits,
        };
        let mut base = match token.kind.clone() {
            Kind::Number(value, digits) => plain(value.into(), Some(digits)),
            Kind::Word(name) => self.named(&name, &token.span, depth)?,
            Kind::Sign('-') => {
                let f = self.factor(depth + 1)?;
                return Ok(Term { expr: -f.expr, span: token.span.start..f.span.end, ..f });
            }
            Kind::Sign('(') => {
                let inside = self.sum(depth + 1, false)?;
                self.expect(')')?;
                Term { span: token.span.start..self.tokens[self.at - 1].span.end, ..inside }
            }
            Kind::Fraction => {
                let (above, below) = (self.group(depth)?, self.group(depth)?);
                let quotient = self.multiply(&above, &below, '/')?;
                Term { span: token.span.start..below.span.end, ..quotient }
            }
            Kind::Root => {
                let inside = self.group(depth)?;
                Term {
                    expr: inside.expr.sqrt(),
                    span: token.span.start..inside.span.end,
                    digits: None,
                    ..inside
                }
            }
            Kind::Sign(_) | Kind::Degree => {
                let shown = &self.text[token.span.clone()];
                return Err(Fault::new(
                    token.span.clone(),
                    format!("`{shown}` stands where a value is expected"),
                ));
            }
        };
        if self.peek_sign() == Some('^') {
            self.at += 1;
            base = self.power(base)?;
        }
        Ok(base)
    }

    /// `{…}`, or the single token of `\frac12`.
    fn group(&mut self, depth: usize) -> Result<Term, Fault> {
        if self.peek_sign() != Some('(') {
            return Err(Fault::new(self.here(), "`{` is missing"));
        }
        self.at += 1;
        let inside = self.sum(depth + 1, false)?;
        self.expect(')')?;
        Ok(inside)
    }

    fn power(&mut self, base: Term) -> Result<Term, Fault> {
        let bracket = self.take_sign('(');
        let negative = self.take_sign('-');
        let span = self.here();
        let exponent = match self.peek() {
            Some(Kind::Number(value, _)) => value.to_integer().filter(|n| *n <= MAX_POWER),
            _ => None,
        };
        self.powers += 1;
        let Some(n) = exponent.filter(|_| self.powers <= MAX_POWERS).and_then(|n| i32::try_from(n).ok())
        else {
            return Err(Fault::new(
                span,
                format!("a power is a whole number up to {MAX_POWER}, and a cell has few"),
            ));
        };
        self.at += 1;
        if bracket {
            self.expect(')')?;
        }
        if negative && base.expr.is_zero() {
            return Err(Fault::new(base.span, "a division by zero"));
        }
        let end = self.tokens[self.at - 1].span.end;
        let expr = base.expr.powi(if negative { -n } else { n });
        Ok(Term { expr, span: base.span.start..end, digits: None, ..base })
    }

    fn named(&mut self, name: &str, span: &Range<usize>, depth: usize) -> Result<Term, Fault> {
        let angle = self.style.quantity == Quantity::Angle;
        let constant =
            |expr, dimensioned| Term { expr, span: span.clone(), symbolic: false, dimensioned, digits: None };
        match name {
            "pi" => return Ok(constant(Expr::pi(), angle)),
            "inf" | "nan" | "NaN" | "infinity" | "Inf" | "Infinity" => {
                return Err(Fault::new(span.clone(), "the value is not a finite number"));
            }
            _ => {}
        }
        let bracket = self.peek_sign() == Some('(');
        if bracket && FUNCTIONS.contains(&name) {
            return self.call(name, span, depth);
        }
        if bracket
            && self.style.document
            && let Some(end) = self.tokens[self.at..].iter().position(|t| t.kind == Kind::Sign(')'))
            && let Some(long) = distance_name(name, &self.tokens[self.at..=self.at + end])
        {
            self.at += end + 1;
            let span = span.start..self.tokens[self.at - 1].span.end;
            let message = format!("{} is named {long}", &self.text[span.clone()]);
            self.findings.push((Severity::Note, span.clone(), message));
            return Ok(self.symbol(long, span));
        }
        Ok(self.symbol(name.to_string(), span.clone()))
    }

    fn symbol(&mut self, name: String, span: Range<usize>) -> Term {
        let expr = Expr::symbol(&name);
        self.symbols.push((name, span.clone()));
        Term { expr, span, symbolic: true, dimensioned: false, digits: None }
    }

    /// The call of a function; its arguments are plain numbers, those of a sine radians.
    fn call(&mut self, name: &str, span: &Range<usize>, depth: usize) -> Result<Term, Fault> {
        self.expect('(')?;
        let quantity = if matches!(name, "sqrt" | "atan2") { Quantity::Number } else { Quantity::Angle };
        let inner = Style { quantity, bare: None, nearly: false, ..self.style.clone() };
        let mut arguments = vec![];
        loop {
            let mut p = Parser {
                text: self.text,
                tokens: std::mem::take(&mut self.tokens),
                at: self.at,
                style: &inner,
                measures: None,
                symbols: std::mem::take(&mut self.symbols),
                bare: vec![],
                findings: std::mem::take(&mut self.findings),
                powers: self.powers,
            };
            let argument = p.sum(depth + 1, true);
            (self.tokens, self.symbols, self.findings) = (p.tokens, p.symbols, p.findings);
            (self.at, self.powers) = (p.at, p.powers);
            arguments.push(argument?);
            if !self.take_sign(',') {
                break;
            }
        }
        self.expect(')')?;
        let span = span.start..self.tokens[self.at - 1].span.end;
        let symbolic = arguments.iter().any(|a| a.symbolic);
        let expr = match (name, arguments.as_slice()) {
            ("sin", [a]) => a.expr.sin(),
            ("cos", [a]) => a.expr.cos(),
            ("tan", [a]) => {
                let (sin, cos) = a.expr.sin_cos();
                if cos.is_zero() {
                    return Err(Fault::new(span, "the value is not a finite number"));
                }
                sin / cos
            }
            ("sqrt", [a]) if a.expr.as_number().is_some_and(|r| r.is_negative()) => {
                return Err(Fault::new(span, "the root of a negative number"));
            }
            ("sqrt", [a]) => a.expr.sqrt(),
            ("atan2", [y, x]) => y.expr.atan2(x.expr),
            _ => {
                let count = if name == "atan2" { "two arguments" } else { "one argument" };
                return Err(Fault::new(span, format!("`{name}` takes {count}")));
            }
        };
        Ok(Term { expr, span, symbolic, dimensioned: name == "atan2", digits: None })
    }
}

/// The name of a distance written as a function, from the bracket on: `d(O_2, O_3)` is `dO2O3`.
pub(super) fn distance_name(first: &str, tokens: &[Token]) -> Option<String> {
    let [Token { kind: Kind::Sign('('), .. }, inside @ .., Token { kind: Kind::Sign(')'), .. }] = tokens
    else {
        return None;
    };
    let mut name = first.to_string();
    for (i, token) in inside.iter().enumerate() {
        match (&token.kind, i % 2) {
            (Kind::Word(word), 0) => name.push_str(word),
            (Kind::Sign(','), 1) => {}
            _ => return None,
        }
    }
    (inside.len() >= 3 && inside.len() % 2 == 1).then_some(name)
}
