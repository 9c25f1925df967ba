//! Lists, maps and texts of xacro's expressions: their entries and parts, and functions of them.

use super::expression::MAX_LENGTH;
use super::value::{Fault, Val, arithmetic, is_same, real};
use crate::description::{diagnostic::nearest, xml::shown};
use denavit_symbolic::Expr;
use std::cmp::Ordering;
use std::collections::HashMap;
use std::rc::Rc;

/// The longest list that an expression makes.
pub(super) const MAX_ITEMS: usize = 10_000;

/// A list that is not too long.
pub(super) fn bounded(values: impl Iterator<Item = Val>) -> Result<Val, Fault> {
    let all: Vec<Val> = values.take(MAX_ITEMS + 1).collect();
    match all.len() > MAX_ITEMS {
        true => Err(Fault::new(format!("a list of more than {MAX_ITEMS} values"))),
        false => Ok(Val::List(Rc::new(all))),
    }
}

/// Values by name with others, which count where a name is given twice.
pub(super) fn united(
    mut all: Vec<(String, Val)>,
    others: Vec<(String, Val)>,
) -> Result<Vec<(String, Val)>, Fault> {
    let mut places: HashMap<String, usize> =
        all.iter().enumerate().map(|(at, entry)| (entry.0.clone(), at)).collect();
    for (name, value) in others {
        match places.get(&name) {
            Some(&at) => all[at].1 = value,
            None => {
                places.insert(name.clone(), all.len());
                all.push((name, value));
            }
        }
    }
    match all.len() > MAX_ITEMS {
        true => Err(Fault::new(format!("more than {MAX_ITEMS} values by name"))),
        false => Ok(all),
    }
}

/// What stands under an index or a name.
pub(super) fn entry(value: &Val, index: &Val) -> Result<Val, Fault> {
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
        Val::Text(_) => &Rc::new(value.items()?),
        _ => return Err(Fault::new("an index behind what is no list")),
    };
    let at = index.index()?;
    let at = if at < 0 { at.saturating_add(all.len() as i64) } else { at };
    let found = usize::try_from(at).ok().and_then(|i| all.get(i)).cloned();
    found.ok_or_else(|| Fault::new(format!("there is no entry {}: the list has {}", index.show(), all.len())))
}

/// `value[from:to:step]`, of a list or a text.
pub(super) fn slice(value: &Val, [from, to, step]: [Option<&Val>; 3]) -> Result<Val, Fault> {
    if !matches!(value, Val::List(_) | Val::Text(_)) {
        return Err(Fault::new("a part of what is no list"));
    }
    let all = value.items()?;
    let length = all.len() as i64;
    let step = step.map_or(Ok(1), Val::index)?;
    if step == 0 {
        return Err(Fault::new("a step of 0"));
    }
    // Backwards the ends are the last one and the one before the first.
    let (low, high) = if step > 0 { (0, length) } else { (-1, length - 1) };
    let end = |given: Option<&Val>, otherwise: i64| match given {
        None => Ok(otherwise),
        Some(v) => v.index().map(|i| if i < 0 { i.saturating_add(length) } else { i }.clamp(low, high)),
    };
    let (from, to) = match step > 0 {
        true => (end(from, 0)?, end(to, length)?),
        false => (end(from, length - 1)?, end(to, -1)?),
    };
    let mut found = vec![];
    let mut at = from;
    while if step > 0 { at < to } else { at > to } {
        found.extend(usize::try_from(at).ok().and_then(|i| all.get(i)).cloned());
        at = at.saturating_add(step);
    }
    Ok(match value {
        Val::Text(_) => Val::Text(found.iter().map(Val::show).collect()),
        _ => Val::List(Rc::new(found)),
    })
}

/// Functions of lists.
pub(super) const FUNCTIONS: &[&str] =
    &["range", "list", "tuple", "sorted", "reversed", "enumerate", "zip", "sum", "any", "all", "bool"];

/// A function of lists.
pub(super) fn function(name: &str, arguments: &[Val]) -> Result<Val, Fault> {
    let pair = |a: Val, b: Val| Val::List(Rc::new(vec![a, b]));
    match (name, arguments) {
        ("range", [_] | [_, _] | [_, _, _]) => {
            let numbers = arguments.iter().map(Val::index).collect::<Result<Vec<_>, _>>()?;
            let (from, to, step) = match numbers[..] {
                [to] => (0, to, 1),
                [from, to] => (from, to, 1),
                [from, to, step, ..] => (from, to, step),
                [] => (0, 0, 1),
            };
            if step == 0 {
                return Err(Fault::new("a step of 0"));
            }
            let next = |at: &i64| at.checked_add(step);
            let all = std::iter::successors(Some(from), next);
            let inside = all.take_while(|&at| if step > 0 { at < to } else { at > to });
            bounded(inside.map(|at| Val::Number(Expr::int(at))))
        }
        ("list" | "tuple", []) => bounded(std::iter::empty()),
        ("list" | "tuple", [list]) => bounded(list.items()?.into_iter()),
        ("reversed", [list]) => bounded(list.items()?.into_iter().rev()),
        ("sorted", [list]) => sorted(list.items()?).and_then(|all| bounded(all.into_iter())),
        ("enumerate", [list]) => {
            let numbered = list.items()?.into_iter().zip(0..);
            bounded(numbered.map(|(value, at)| pair(Val::Number(Expr::int(at)), value)))
        }
        ("zip", [a, b]) => {
            let (a, b) = (a.items()?, b.items()?);
            bounded(a.into_iter().zip(b).map(|(a, b)| pair(a, b)))
        }
        ("sum", [list]) => {
            let zero = Val::Number(Expr::int(0));
            list.items()?.iter().try_fold(zero, |sum, value| arithmetic("+", &sum, value))
        }
        ("any" | "all", [list]) => {
            let wanted = name == "any";
            for value in list.items()? {
                if value.holds()? == wanted {
                    return Ok(Val::Truth(wanted));
                }
            }
            Ok(Val::Truth(!wanted))
        }
        ("bool", [value]) => value.holds().map(Val::Truth),
        _ => Err(Fault::new(format!("`{name}` does not take {} values", arguments.len()))),
    }
}

/// Numbers by their size, else texts by their letters.
fn sorted(mut all: Vec<Val>) -> Result<Vec<Val>, Fault> {
    let numbers: Option<Vec<_>> = all
        .iter()
        .map(|v| Some(v).filter(|v| !matches!(v, Val::Text(_))).and_then(|v| real(v.expr().ok()?).ok()))
        .collect();
    let Some(numbers) = numbers else {
        if all.iter().any(|v| !matches!(v, Val::Text(_))) {
            return Err(Fault::new("these have no order"));
        }
        all.sort_by_cached_key(Val::show);
        return Ok(all);
    };
    let mut both: Vec<_> = numbers.into_iter().zip(all).collect();
    both.sort_by(|(x, _), (y, _)| {
        let difference = x.clone() - y.clone();
        match (difference.is_zero(), difference.is_negative()) {
            (true, _) => Ordering::Equal,
            (_, true) => Ordering::Less,
            _ => Ordering::Greater,
        }
    });
    Ok(both.into_iter().map(|b| b.1).collect())
}

/// `form % values`, as Python and C have it: `%s`, `%d`, `%f`, `%g`, `%%`, with width and places.
pub(super) fn formatted(form: &str, values: &Val) -> Result<Val, Fault> {
    let values = match values {
        Val::List(all) => all.to_vec(),
        one => vec![one.clone()],
    };
    let mut values = values.into_iter();
    let (mut text, mut rest) = (String::new(), form);
    while let Some(at) = rest.find('%') {
        text.push_str(&rest[..at]);
        rest = &rest[at + 1..];
        if let Some(behind) = rest.strip_prefix('%') {
            text.push('%');
            rest = behind;
            continue;
        }
        let flags = rest.len() - rest.trim_start_matches(['-', '0', '+', ' ']).len();
        let (flags, behind) = rest.split_at(flags);
        let (width, behind) = digits(behind)?;
        let (places, behind) = match behind.strip_prefix('.') {
            Some(behind) => digits(behind).map(|(places, rest)| (Some(places), rest))?,
            None => (None, behind),
        };
        let kind = behind.chars().next().ok_or_else(|| Fault::new("a format that is not complete"))?;
        rest = &behind[kind.len_utf8()..];
        let value = values.next().ok_or_else(|| Fault::new("fewer values than the format has places"))?;
        let shown = placed(kind, &value, places, flags)?;
        let missing = width.saturating_sub(shown.chars().count());
        let is_number = kind != 's';
        if flags.contains('-') {
            text.push_str(&shown);
            text.extend(std::iter::repeat_n(' ', missing));
        } else if flags.contains('0') && is_number {
            let sign = shown.len() - shown.trim_start_matches(['-', '+', ' ']).len();
            text.push_str(&shown[..sign]);
            text.extend(std::iter::repeat_n('0', missing));
            text.push_str(&shown[sign..]);
        } else {
            text.extend(std::iter::repeat_n(' ', missing));
            text.push_str(&shown);
        }
    }
    text.push_str(rest);
    match (values.next().is_some(), text.len() > MAX_LENGTH) {
        (true, _) => Err(Fault::new("more values than the format has places")),
        (_, true) => Err(Fault::new("a text that is too long")),
        _ => Ok(Val::Text(text)),
    }
}

/// The number that a text begins with, 0 if none, and what stands behind it.
fn digits(text: &str) -> Result<(usize, &str), Fault> {
    let length = text.bytes().take_while(u8::is_ascii_digit).count();
    let (digits, behind) = text.split_at(length);
    let number = if digits.is_empty() { Some(0) } else { digits.parse().ok().filter(|n| *n <= 100) };
    number.map(|n| (n, behind)).ok_or_else(|| Fault::new("a width out of range"))
}

/// A value in the place of a format.
fn placed(kind: char, value: &Val, places: Option<usize>, flags: &str) -> Result<String, Fault> {
    let number = || -> Result<f64, Fault> {
        value.expr()?.eval(|_| None).map_err(|_| Fault::new("this has no value in numbers"))
    };
    let shown = match kind {
        's' | 'r' => {
            let text = value.show();
            return Ok(places.map_or(text.clone(), |p| text.chars().take(p).collect()));
        }
        'd' | 'i' | 'u' => {
            let x = value.rational()?;
            let whole = if x.is_negative() { -(-x).floor() } else { x.floor() };
            Val::Number(whole.into()).show()
        }
        'f' | 'F' => format!("{:.*}", places.unwrap_or(6), number()?),
        'g' | 'G' => general(number()?, places.unwrap_or(6).max(1)),
        other => return Err(Fault::new(format!("the format `%{other}` is not read"))),
    };
    let plus = ['+', ' '].into_iter().find(|&c| flags.contains(c)).filter(|_| !shown.starts_with('-'));
    Ok(plus.map_or(shown.clone(), |c| format!("{c}{shown}")))
}

/// A number with so many digits, without zeros at its end: `%g`.
fn general(x: f64, places: usize) -> String {
    let trimmed = |text: &str| match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_string(),
        false => text.to_string(),
    };
    let scientific = format!("{x:.*e}", places - 1);
    let Some((mantissa, exponent)) = scientific.split_once('e') else { return scientific };
    let Ok(exponent) = exponent.parse::<i32>() else { return scientific };
    if exponent < -4 || exponent >= places as i32 {
        let sign = if exponent < 0 { '-' } else { '+' };
        return format!("{}e{sign}{:02}", trimmed(mantissa), exponent.abs());
    }
    let behind = usize::try_from(places as i32 - 1 - exponent).unwrap_or(0);
    trimmed(&format!("{x:.behind$}"))
}

/// What a value answers to a method.
pub(super) fn method(value: &Val, name: &str, arguments: &[Val]) -> Result<Val, Fault> {
    let list = |all: Vec<Val>| Ok(Val::List(Rc::new(all)));
    if let Val::Map(all) = value {
        return match (name, arguments) {
            ("keys", []) => list(all.iter().map(|e| Val::Text(e.0.clone())).collect()),
            ("values", []) => list(all.iter().map(|e| e.1.clone()).collect()),
            ("items", []) => {
                let pair = |e: &(String, Val)| Val::List(Rc::new(vec![Val::Text(e.0.clone()), e.1.clone()]));
                list(all.iter().map(pair).collect())
            }
            ("get", [key]) => entry(value, key),
            ("get", [key, otherwise]) => Ok(entry(value, key).unwrap_or_else(|_| otherwise.clone())),
            _ => Err(Fault::new(format!("`.{}` is not read", shown(name)))),
        };
    }
    if let (Val::List(all), "index" | "count", [wanted]) = (value, name, arguments) {
        let mut places = all.iter().zip(0..).filter(|(v, _)| is_same(v, wanted)).map(|p| p.1);
        let found = if name == "count" { Some(places.count() as i64) } else { places.next() };
        let found = found.map(|at| Val::Number(Expr::int(at)));
        return found.ok_or_else(|| Fault::new(format!("`{}` is not in the list", shown(&wanted.show()))));
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
        ("join", _) => {
            let [Val::List(all)] = arguments else { return Err(Fault::new("`join` takes a list")) };
            let parts: Vec<String> = all.iter().map(Val::show).collect();
            let length = parts.iter().map(|p| p.len() + text.len()).sum::<usize>();
            match length > MAX_LENGTH {
                true => Err(Fault::new("a text that is too long")),
                false => Ok(Val::Text(parts.join(&text))),
            }
        }
        ("replace", [old, new])
            if !old.is_empty() && text.len() * new.len().max(1) <= MAX_LENGTH * MAX_LENGTH =>
        {
            Ok(Val::Text(text.replace(old, new)))
        }
        _ => Err(Fault::new(format!("`.{}` is not read", shown(name)))),
    }
}
