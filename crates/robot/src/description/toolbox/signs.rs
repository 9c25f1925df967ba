//! Sums, multiples, comparisons and blocks of numbers.

use super::parse::Node;
use super::run::Run;
use super::value::{Formula, MAX_ITEMS, Value, formula, integer};
use std::ops::Range;
use std::rc::Rc;

impl Run<'_> {
    /// Each number of a value by a function.
    pub fn each_number(
        &mut self,
        value: &Value,
        span: &Range<usize>,
        of: &dyn Fn(&Formula) -> Option<Formula>,
    ) -> Value {
        match value {
            Value::Unknown(_) => value.clone(),
            Value::Matrix(rows) => {
                let rows = Rc::clone(rows);
                if self.step(rows.iter().map(Vec::len).sum(), span) {
                    return self.unknown(span);
                }
                let one = |v: &Value| formula(v).and_then(|f| of(&f)).map(Value::Number);
                let found: Option<Vec<Vec<Value>>> =
                    rows.iter().map(|r| r.iter().map(one).collect()).collect();
                found.map_or_else(|| self.unknown(span), |rows| Value::Matrix(Rc::new(rows)))
            }
            Value::List(_) => match self.store.items(value) {
                Ok(items) if !self.step(items.len(), span) => {
                    let mut found = vec![];
                    for item in items {
                        // Rows in a list.
                        found.push(match &item {
                            Value::List(inner) if Value::List(*inner) != *value => {
                                self.inner_numbers(&item, span, of)
                            }
                            _ => formula(&item)
                                .and_then(|f| of(&f))
                                .map_or_else(|| self.unknown(span), Value::Number),
                        });
                    }
                    self.store.list(found, true)
                }
                Err(Some(lost)) => Value::Unknown(lost),
                _ => self.unknown(span),
            },
            _ => formula(value).and_then(|f| of(&f)).map_or_else(|| self.unknown(span), Value::Number),
        }
    }

    fn inner_numbers(
        &mut self,
        value: &Value,
        span: &Range<usize>,
        of: &dyn Fn(&Formula) -> Option<Formula>,
    ) -> Value {
        let Ok(items) = self.store.items(value) else { return self.unknown(span) };
        if self.step(items.len(), span) {
            return self.unknown(span);
        }
        let one = |v: &Value| formula(v).and_then(|f| of(&f)).map(Value::Number);
        match items.iter().map(one).collect::<Option<Vec<Value>>>() {
            Some(found) => self.store.list(found, true),
            None => self.unknown(span),
        }
    }

    pub fn binary(&mut self, sign: &str, left: Value, right: Value, span: &Range<usize>) -> Value {
        if let Value::Unknown(_) = left {
            return left;
        }
        if let Value::Unknown(_) = right {
            return right;
        }
        if matches!(sign, "==" | "~=" | "!=" | "is" | "is not" | "<" | ">" | "<=" | ">=") {
            return self.compared(sign, &left, &right).map_or_else(|| self.unknown(span), Value::Bool);
        }
        let is_arithmetic = matches!(sign, "+" | "-" | "*" | "/" | ".*" | "./" | ".^" | "^" | "//" | "%");
        // `^` of Python is no power.
        if !is_arithmetic || sign == "^" && self.is_python() && self.text[span.clone()].contains('^') {
            return self.unknown(span);
        }
        let is_array = |run: &Self, v: &Value| match v {
            Value::List(k) => run.store.lists[*k].is_array,
            Value::Matrix(_) => true,
            _ => false,
        };
        match (&left, &right) {
            (Value::Text(a), Value::Text(b))
                if sign == "+" && self.is_python() && a.len() + b.len() < 1000 =>
            {
                Value::Text(format!("{a}{b}").into())
            }
            (Value::Robot(_), Value::Robot(_)) if matches!(sign, "+" | "*") => {
                let links = [&left, &right].map(|r| r.clone()).to_vec();
                self.robot_of(&Value::Matrix(Rc::new(vec![links])), span)
            }
            (Value::List(a), Value::List(b))
                if sign == "+" && !is_array(self, &left) && !is_array(self, &right) =>
            {
                let (a, b) = (self.store.items(&Value::List(*a)), self.store.items(&Value::List(*b)));
                match (a, b) {
                    (Ok(mut a), Ok(b))
                        if a.len() + b.len() <= MAX_ITEMS && !self.step(a.len() + b.len(), span) =>
                    {
                        a.extend(b);
                        self.store.list(a, false)
                    }
                    (Err(Some(lost)), _) | (_, Err(Some(lost))) => Value::Unknown(lost),
                    _ => self.unknown(span),
                }
            }
            (Value::List(_), count) | (count, Value::List(_))
                if sign == "*" && !is_array(self, &left) && !is_array(self, &right) =>
            {
                let list = if matches!(left, Value::List(_)) { &left } else { &right };
                let items = self.store.items(list);
                let count = integer(count).and_then(|n| usize::try_from(n.max(0)).ok());
                match (items, count) {
                    (Ok(items), Some(count))
                        if items.len().saturating_mul(count) <= MAX_ITEMS
                            && !self.step(items.len() * count, span) =>
                    {
                        let all = (0..count).flat_map(|_| items.iter().cloned()).collect();
                        self.store.list(all, false)
                    }
                    (Err(Some(lost)), _) => Value::Unknown(lost),
                    _ => self.unknown(span),
                }
            }
            (a, b) if is_array(self, a) && formula(b).is_some() && sign != "^" => {
                let b = formula(b).unwrap_or_else(|| Formula::integer(0, span.clone()));
                self.each_number(&left, span, &|f| f.joined(sign, &b, span.clone()))
            }
            (a, b) if is_array(self, b) && formula(a).is_some() && !matches!(sign, "/" | "^") => {
                let a = formula(a).unwrap_or_else(|| Formula::integer(0, span.clone()));
                self.each_number(&right, span, &|f| a.joined(sign, f, span.clone()))
            }
            (a, b) => {
                let found = formula(a).zip(formula(b)).and_then(|(a, b)| a.joined(sign, &b, span.clone()));
                found.map_or_else(|| self.unknown(span), Value::Number)
            }
        }
    }

    /// `a *= 2` of an array changes it where it is, for all that have it.
    pub fn put_in_place(&mut self, array: usize, found: &Value, span: &Range<usize>) {
        self.change(&Value::List(array));
        let whole = self.store.lists[array].part_of;
        match (found, whole) {
            (Value::List(k), None) => self.store.lists[array].items = self.store.lists[*k].items.clone(),
            _ => {
                let lost = self.lost(span, "is not followed");
                self.store.lose(&Value::List(whole.unwrap_or(array)), &lost);
                self.store.lose(&Value::List(array), &lost);
            }
        }
    }

    fn compared(&self, sign: &str, left: &Value, right: &Value) -> Option<bool> {
        let is_none = |v: &Value| *v == Value::None;
        let equal = match (left, right) {
            (Value::Text(a), Value::Text(b)) => a == b,
            // A name without value may be anything, but it is something.
            (a, b) if is_none(a) || is_none(b) => is_none(a) && is_none(b),
            (a, b) => {
                let (a, b) = (formula(a)?.number?, formula(b)?.number?);
                match sign {
                    "<" => return Some(a < b),
                    ">" => return Some(a > b),
                    "<=" => return Some(a <= b),
                    ">=" => return Some(a >= b),
                    #[expect(clippy::float_cmp, reason = "so the program says")]
                    _ => a == b,
                }
            }
        };
        match sign {
            "==" | "is" => Some(equal),
            "~=" | "!=" | "is not" => Some(!equal),
            _ => None,
        }
    }

    /// `[a b; c d]`: blocks side by side and below one another.
    pub fn matrix(&mut self, rows: &[Vec<Node>], is_cell: bool, span: &Range<usize>) -> Value {
        let mut found: Vec<Vec<Value>> = vec![];
        for row in rows {
            let values: Vec<Value> = row.iter().map(|n| self.value(n)).collect();
            if is_cell {
                found.push(values);
                continue;
            }
            if values.iter().any(|v| matches!(v, Value::Text(_))) {
                // Words in a row are one.
                let mut text = String::new();
                for value in &values {
                    match value {
                        Value::Text(t) if text.len() + t.len() < 1000 => text += t,
                        _ => return self.unknown(span),
                    }
                }
                found.push(vec![Value::Text(text.into())]);
                continue;
            }
            let mut lines: Option<Vec<Vec<Value>>> = None;
            for value in values {
                let block = match value {
                    Value::Matrix(block) if block.iter().all(Vec::is_empty) => continue,
                    Value::Matrix(block) => Rc::unwrap_or_clone(block),
                    other => vec![vec![other]],
                };
                match &mut lines {
                    None => lines = Some(block),
                    Some(lines) if lines.len() == block.len() => {
                        lines.iter_mut().zip(block).for_each(|(line, more)| line.extend(more));
                    }
                    Some(_) => return self.unknown(span),
                }
            }
            found.extend(lines.unwrap_or_default());
        }
        let width = found.first().map_or(0, Vec::len);
        if found.len() == 1 && width == 1 && !is_cell {
            return found.remove(0).remove(0);
        }
        let count: usize = found.iter().map(Vec::len).sum();
        let is_even = found.iter().all(|r| r.len() == width);
        if !is_even || count > MAX_ITEMS || self.step(count / 8, span) {
            return self.unknown(span);
        }
        Value::Matrix(Rc::new(found))
    }
}
