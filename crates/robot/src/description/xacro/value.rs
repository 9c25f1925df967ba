//! Values of xacro's expressions: exact numbers, texts, truths, lists.

use super::scope::Scope;
use super::sequence::{self, MAX_ITEMS, bounded, formatted};
use crate::description::xml::shown;
use denavit_symbolic::real::{Real, Values};
use denavit_symbolic::{Angle, Expr, Rational};
use std::ops::Range;
use std::rc::Rc;

/// Why something has no value.
#[derive(Clone, Debug)]
pub(super) struct Fault {
    pub message: String,
    pub hint: Option<String>,
    /// Where, if elsewhere than the element or attribute that is being expanded.
    pub at: Option<Range<usize>>,
}

/// A value.
#[derive(Clone, Debug)]
pub(super) enum Val {
    Number(Expr),
    Text(String),
    Truth(bool),
    List(Rc<Vec<Val>>),
    /// Values by name, in their order.
    Map(Rc<Vec<(String, Val)>>),
    /// A namespace.
    Space(Scope),
}

/// Longer numbers, in bits, and formulas, in nodes, are not worked with.
const MAX_BITS: u64 = 4096;
const MAX_FORMULA: usize = 200;
/// The largest power.
const MAX_POWER: i64 = 64;

impl Fault {
    pub fn new(message: impl Into<String>) -> Self {
        Fault { message: message.into(), hint: None, at: None }
    }

    pub fn hint(self, hint: impl Into<String>) -> Self {
        Fault { hint: Some(hint.into()), ..self }
    }

    /// At a place, unless it has one already.
    pub fn at(self, place: Range<usize>) -> Self {
        Fault { at: self.at.or(Some(place)), ..self }
    }
}

/// The number, and no more than it needs: a multiple of π and a rational are brought to normal form.
pub(super) fn number(e: Expr) -> Result<Val, Fault> {
    let form = Angle::of(e);
    if form.turns.bits().max(form.radians.bits()) > MAX_BITS {
        return Err(Fault::new("a number that is too long"));
    }
    if form.is_constant() {
        return Ok(Val::Number(form.to_expr()));
    }
    if Expr::postorder(&[e]).len() <= MAX_FORMULA {
        return Ok(Val::Number(e));
    }
    Ok(Val::Number(real(e)?.settled()))
}

/// The value in numbers.
pub(super) fn real(e: Expr) -> Result<Real, Fault> {
    Values::default()
        .of(e)
        .ok_or_else(|| Fault::new("this has no value: a division by 0, or a root of what is below 0"))
}

impl Val {
    pub fn expr(&self) -> Result<Expr, Fault> {
        match self {
            Val::Number(e) => Ok(*e),
            Val::Truth(t) => Ok(Expr::int(i64::from(*t))),
            Val::Text(t) => match Rational::from_decimal(t.trim()) {
                Some(x) => Ok(x.into()),
                None => Err(Fault::new(format!("`{}` is no number", shown(t)))),
            },
            Val::List(_) => Err(Fault::new("a list is no number")),
            Val::Map(_) => Err(Fault::new("values by name are no number")),
            Val::Space(_) => Err(Fault::new("a namespace is no number")),
        }
    }

    pub fn rational(&self) -> Result<Rational, Fault> {
        let e = self.expr()?;
        e.as_number()
            .or_else(|| Rational::from_f64(e.eval(|_| None).ok()?))
            .ok_or_else(|| Fault::new("this is no number"))
    }

    /// The values of a list, the names of a map, the letters of a text.
    pub fn items(&self) -> Result<Vec<Val>, Fault> {
        match self {
            Val::List(l) => Ok(l.to_vec()),
            Val::Map(m) => Ok(m.iter().map(|e| Val::Text(e.0.clone())).collect()),
            Val::Text(t) => Ok(t.chars().map(|c| Val::Text(c.into())).collect()),
            _ => Err(Fault::new("this is no list")),
        }
    }

    pub fn index(&self) -> Result<i64, Fault> {
        self.rational()?.floor().to_integer().ok_or_else(|| Fault::new("a number out of range"))
    }

    pub fn truth(&self) -> Result<bool, Fault> {
        Ok(match self {
            Val::Truth(t) => *t,
            Val::Number(e) => !real(*e)?.is_zero(),
            Val::List(l) => !l.is_empty(),
            Val::Map(m) => !m.is_empty(),
            Val::Space(_) => true,
            Val::Text(t) => match t.trim() {
                "true" | "True" | "1" => true,
                "false" | "False" | "0" | "" => false,
                t => match Rational::from_decimal(t) {
                    Some(x) => !x.is_zero(),
                    None => {
                        let shown = shown(t);
                        return Err(Fault::new(format!("`{shown}` is neither true nor false")));
                    }
                },
            },
        })
    }

    /// As Python takes it in `not`, `and`, `or` and a choice: a text is true unless it is empty.
    pub fn holds(&self) -> Result<bool, Fault> {
        match self {
            Val::Text(t) => Ok(!t.is_empty()),
            _ => self.truth(),
        }
    }

    /// As text: numbers as decimals, the nearest double's where they are none.
    pub fn show(&self) -> String {
        match self {
            Val::Number(e) => {
                decimal(*e).unwrap_or_else(|| format!("{}", e.eval(|_| None).unwrap_or(f64::NAN)))
            }
            Val::Text(t) => t.clone(),
            Val::Truth(true) => "True".into(),
            Val::Truth(false) => "False".into(),
            Val::List(l) => format!("[{}]", l.iter().map(Val::quoted).collect::<Vec<_>>().join(", ")),
            Val::Map(m) => {
                let entries = m.iter().map(|(name, value)| format!("'{name}': {}", value.quoted()));
                format!("{{{}}}", entries.collect::<Vec<_>>().join(", "))
            }
            Val::Space(_) => "a namespace".into(),
        }
    }

    /// As text inside a list: texts in quotes.
    fn quoted(&self) -> String {
        match self {
            Val::Text(t) => format!("'{t}'"),
            other => other.show(),
        }
    }

    /// The value of a property or parameter: a text in single quotes is what stands between them, `true` and `false` are truths.
    pub fn unquoted(self) -> Self {
        let inner = |t: &str| Some(t.strip_prefix('\'')?.strip_suffix('\'')?.to_string());
        match &self {
            Val::Text(t) => match t.as_str() {
                "true" | "True" => Val::Truth(true),
                "false" | "False" => Val::Truth(false),
                t => inner(t).map_or(self, Val::Text),
            },
            _ => self,
        }
    }

    /// The number or truth that a text is, if it is one.
    pub fn converted(text: String) -> Self {
        match text.to_lowercase().as_str() {
            "true" => Val::Truth(true),
            "false" => Val::Truth(false),
            _ => match Rational::from_decimal(text.trim()) {
                Some(x) => Val::Number(x.into()),
                None => Val::Text(text),
            },
        }
    }
}

/// The decimal that a number is, if it is one with at most 40 places.
pub(super) fn decimal(e: Expr) -> Option<String> {
    let x = e.as_number()?;
    let mut scaled = x.abs();
    for places in 0..=40 {
        if scaled.is_integer() {
            let digits = format!("{:0>width$}", scaled.digits().0, width = places + 1);
            let (whole, fraction) = digits.split_at(digits.len() - places);
            let sign = if x.is_negative() { "-" } else { "" };
            return Some(if places == 0 {
                format!("{sign}{whole}")
            } else {
                format!("{sign}{whole}.{fraction}")
            });
        }
        scaled = scaled * Rational::from(10);
    }
    None
}

/// `a op b`.
pub(super) fn arithmetic(op: &str, a: &Val, b: &Val) -> Result<Val, Fault> {
    if let (Val::Text(x), Val::Text(y), "+") = (a, b, op)
        && (a.expr().is_err() || b.expr().is_err())
    {
        return Ok(Val::Text(format!("{x}{y}")));
    }
    match (a, b, op) {
        (Val::List(x), Val::List(y), "+") => return bounded(x.iter().chain(y.iter()).cloned()),
        (Val::List(x), n @ Val::Number(_), "*") | (n @ Val::Number(_), Val::List(x), "*") => {
            let times = usize::try_from(n.index()?).unwrap_or(0);
            return bounded((0..times.min(MAX_ITEMS + 1)).flat_map(|_| x.iter().cloned()));
        }
        (Val::Text(form), values, "%") if form.contains('%') => return formatted(form, values),
        _ => {}
    }
    let (x, y) = (a.expr()?, b.expr()?);
    let zero = || Fault::new("a division by 0");
    let floor = |x: Expr, y: Expr| -> Result<Rational, Fault> { Ok(Val::Number(x / y).rational()?.floor()) };
    match op {
        "+" => number(x + y),
        "-" => number(x - y),
        "*" => number(x * y),
        _ if matches!(op, "/" | "//" | "%") && real(y)?.is_zero() => Err(zero()),
        // (a + bπ)/c
        "/" => match y.as_number().and_then(|k| k.recip()) {
            Some(k) => number(Angle::of(x).scaled(&k).to_expr()),
            None if x == y => number(Expr::int(1)),
            None => number(x / y),
        },
        "//" => number(floor(x, y)?.into()),
        "%" => number(x - y * Expr::from(floor(x, y)?)),
        "**" => power(x, y),
        _ => Err(Fault::new(format!("`{op}` is not read"))),
    }
}

fn power(x: Expr, y: Expr) -> Result<Val, Fault> {
    let exponent = y.as_number();
    if let Some(n) = exponent.as_ref().and_then(Rational::to_integer).filter(|n| n.abs() <= MAX_POWER) {
        if n < 0 && real(x)?.is_zero() {
            return Err(Fault::new("a division by 0"));
        }
        return number(x.powi(n as i32));
    }
    if exponent == Some(Rational::new(1, 2)) {
        real(x.sqrt())?;
        return number(x.sqrt());
    }
    let value = |e: Expr| e.eval(|_| None).unwrap_or(f64::NAN);
    let power =
        Rational::from_f64(value(x).powf(value(y))).ok_or_else(|| Fault::new("a power without value"))?;
    number(power.into())
}

/// A function of numbers.
pub(super) fn function(name: &str, arguments: &[Val]) -> Result<Val, Fault> {
    let count = |n: usize| match arguments.len() == n {
        true => Ok(()),
        false => Err(Fault::new(format!("`{name}` takes {n} value{}", if n == 1 { "" } else { "s" }))),
    };
    let half_turn = || Expr::int(180);
    let first =
        || arguments.first().map_or_else(|| Err(Fault::new(format!("`{name}` of nothing"))), Val::expr);
    match name {
        "str" => return count(1).map(|()| Val::Text(arguments[0].show())),
        "len" => {
            count(1)?;
            let length = match &arguments[0] {
                Val::List(l) => l.len(),
                Val::Map(m) => m.len(),
                other => other.show().chars().count(),
            };
            return number(Expr::int(length as i64));
        }
        "max" | "min" if matches!(arguments, [Val::List(_)]) => {
            return function(name, &arguments[0].items()?);
        }
        "max" | "min" => {
            let mut best = first()?;
            for other in &arguments[1..] {
                let other = other.expr()?;
                let is_below = real(other - best)?.is_negative();
                if is_below == (name == "min") {
                    best = other;
                }
            }
            return number(best);
        }
        _ if sequence::FUNCTIONS.contains(&name) => return sequence::function(name, arguments),
        "atan2" => {
            count(2)?;
            return angle(arguments[0].expr()?, arguments[1].expr()?);
        }
        "hypot" => {
            let sum = arguments.iter().try_fold(Expr::int(0), |sum, a| a.expr().map(|x| sum + x * x))?;
            real(sum.sqrt())?;
            return number(sum.sqrt());
        }
        // The rest has the sign of what is divided.
        "fmod" => {
            count(2)?;
            let (x, y) = (arguments[0].expr()?, arguments[1].expr()?);
            if real(y)?.is_zero() {
                return Err(Fault::new("a division by 0"));
            }
            return number(x - y * Expr::from(whole(x / y)?));
        }
        "copysign" => {
            count(2)?;
            let (x, y) = (arguments[0].expr()?, arguments[1].expr()?);
            let is_other = real(x)?.is_negative() != real(y)?.is_negative();
            return number(if is_other { -x } else { x });
        }
        "pow" => return count(2).and_then(|()| power(arguments[0].expr()?, arguments[1].expr()?)),
        "round" if arguments.len() == 2 => {
            let places = u32::try_from(arguments[1].index()?).ok().filter(|p| *p <= 40);
            let places = places.ok_or_else(|| Fault::new("a number of places out of range"))?;
            let scale = Expr::from(Rational::from(10)).powi(places as i32);
            return number(Expr::from(rounded(first()? * scale)?) / scale);
        }
        _ => count(1)?,
    }
    let x = first()?;
    let floor = |e: Expr| -> Result<Rational, Fault> { Ok(Val::Number(e).rational()?.floor()) };
    match name {
        "radians" => number(Expr::pi() * Expr::from(Rational::new(1, 180)) * x),
        "degrees" => {
            let form = Angle::of(x);
            match form.is_constant() && form.radians.is_zero() {
                true => number(Expr::from(form.turns) * half_turn()),
                false => number(x * half_turn() / Expr::pi()),
            }
        }
        "sin" => number(x.sin()),
        "cos" => number(x.cos()),
        "tan" => arithmetic("/", &number(x.sin())?, &number(x.cos())?),
        "asin" => angle(x, (Expr::int(1) - x * x).sqrt()),
        "acos" => angle((Expr::int(1) - x * x).sqrt(), x),
        "atan" => angle(x, Expr::int(1)),
        "sqrt" => {
            real(x.sqrt())?;
            number(x.sqrt())
        }
        "abs" | "fabs" => number(if real(x)?.is_negative() { -x } else { x }),
        "float" => number(x),
        "floor" => number(floor(x)?.into()),
        "ceil" => number((-floor(-x)?).into()),
        "round" => number(rounded(x)?.into()),
        "int" | "trunc" => number(whole(x)?.into()),
        _ => Err(Fault::new(format!("the function `{}` is not read", shown(name)))),
    }
}

/// The whole number of a number, towards 0.
fn whole(x: Expr) -> Result<Rational, Fault> {
    let floor = |e: Expr| -> Result<Rational, Fault> { Ok(Val::Number(e).rational()?.floor()) };
    if real(x)?.is_negative() { Ok(-floor(-x)?) } else { floor(x) }
}

/// The nearest whole number, the even one of two that are as near.
fn rounded(x: Expr) -> Result<Rational, Fault> {
    let above = Val::Number(x + Expr::from(Rational::new(1, 2))).rational()?;
    let nearest = above.floor();
    let is_even = (nearest.clone() * Rational::new(1, 2)).is_integer();
    Ok(if above == nearest && !is_even { nearest - Rational::ONE } else { nearest })
}

/// The angle of the point (x, y).
fn angle(y: Expr, x: Expr) -> Result<Val, Fault> {
    let (y, x) = (real(y)?, real(x)?);
    let length = (y.clone() * y.clone() + x.clone() * x.clone()).sqrt();
    match length.and_then(|l| l.recip()) {
        Some(over) => number((y * over.clone()).angle(&(x * over))),
        None => number(Expr::int(0)),
    }
}

/// Whether `a sign b` holds.
pub(super) fn compared(sign: &str, a: &Val, b: &Val) -> Result<bool, Fault> {
    let is_in = || match b {
        Val::List(l) => l.iter().any(|x| is_same(a, x)),
        Val::Map(m) => m.iter().any(|x| x.0 == a.show()),
        other => other.show().contains(&a.show()),
    };
    match sign {
        "in" => return Ok(is_in()),
        "not in" => return Ok(!is_in()),
        "==" | "!=" => return Ok(is_same(a, b) == (sign == "==")),
        _ => {}
    }
    let (below, equal) = match (a, b) {
        (Val::Text(x), Val::Text(y)) => (x < y, x == y),
        _ => {
            let difference = real(a.expr()? - b.expr()?)?;
            (difference.is_negative(), difference.is_zero())
        }
    };
    Ok(match sign {
        "<" => below && !equal,
        "<=" => below || equal,
        ">" => !below && !equal,
        _ => !below || equal,
    })
}

pub(super) fn is_same(a: &Val, b: &Val) -> bool {
    let is_text = |v: &Val| matches!(v, Val::Text(_));
    match (a.expr(), b.expr()) {
        (Ok(x), Ok(y)) if !(is_text(a) && is_text(b)) => real(x - y).is_ok_and(|d| d.is_zero()),
        _ => a.show() == b.show(),
    }
}
