//! What values of a program are: formulas as text, lists, links, robots, and what is not followed.

use super::links::Joint;
use super::{Link, Made};
use crate::description::cell::MAX_LENGTH;
use std::collections::HashSet;
use std::ops::Range;
use std::rc::Rc;

/// No list has more entries.
pub(super) const MAX_ITEMS: usize = 10_000;

/// What is not followed, and where.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Lost {
    pub span: Range<usize>,
    pub message: Rc<str>,
}

/// A formula as a cell of a table has it, and its number if it has one without names.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Formula {
    pub text: Rc<str>,
    pub number: Option<f64>,
    pub span: Range<usize>,
}

impl Formula {
    pub fn new(text: &str, number: Option<f64>, span: Range<usize>) -> Formula {
        Formula { text: text.into(), number, span }
    }

    pub fn integer(n: i64, span: Range<usize>) -> Formula {
        #[expect(clippy::cast_precision_loss, reason = "numbers of rows are small")]
        Formula::new(&n.to_string(), Some(n as f64), span)
    }

    /// In brackets where it is more than a word.
    fn wrapped(&self) -> String {
        let is_word = self.text.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '.'));
        if is_word { self.text.to_string() } else { format!("({})", self.text) }
    }

    /// Two formulas with a sign between them, unless that is too long or no formula.
    pub fn joined(&self, sign: &str, other: &Formula, span: Range<usize>) -> Option<Formula> {
        let sign = sign.trim_start_matches('.');
        let sign = if sign == "**" { "^" } else { sign };
        let both = self.number.zip(other.number);
        let number = match sign {
            "+" => both.map(|(a, b)| a + b),
            "-" => both.map(|(a, b)| a - b),
            "*" => both.map(|(a, b)| a * b),
            "/" => both.map(|(a, b)| a / b),
            "^" => both.map(|(a, b)| a.powf(b)),
            "//" | "%" => {
                let (a, b) = both?;
                let value = if sign == "%" { a - b * (a / b).floor() } else { (a / b).floor() };
                return whole(value).map(|n| Formula::integer(n, span));
            }
            _ => return None,
        };
        let text = format!("{}{sign}{}", self.wrapped(), other.wrapped());
        (text.len() <= MAX_LENGTH).then(|| Formula::new(&text, number, span))
    }

    pub fn negated(&self, span: Range<usize>) -> Option<Formula> {
        let text = format!("-{}", self.wrapped());
        (text.len() <= MAX_LENGTH).then(|| Formula::new(&text, self.number.map(|n| -n), span))
    }

    /// The function of this name of it.
    pub fn of(&self, function: &str) -> Option<Formula> {
        let text = format!("{function}({})", self.text);
        (text.len() <= MAX_LENGTH).then(|| Formula::new(&text, None, self.span.clone()))
    }

    pub fn in_radians(&self) -> Option<Formula> {
        let text = format!("{}*pi/180", self.wrapped());
        let number = self.number.map(f64::to_radians);
        (text.len() <= MAX_LENGTH).then(|| Formula::new(&text, number, self.span.clone()))
    }

    pub fn in_degrees(&self) -> Option<Formula> {
        let text = format!("{}*180/pi", self.wrapped());
        let number = self.number.map(f64::to_degrees);
        (text.len() <= MAX_LENGTH).then(|| Formula::new(&text, number, self.span.clone()))
    }
}

/// The whole number that a number is.
#[expect(clippy::cast_possible_truncation, reason = "the range is looked at before")]
pub(super) fn whole(value: f64) -> Option<i64> {
    (value.fract() == 0.0 && value.abs() < 1e9).then_some(value as i64)
}

/// A value of a program.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Value {
    Number(Formula),
    Bool(bool),
    Text(Rc<str>),
    /// `None`, and what stands in no place of a list of MATLAB.
    None,
    /// Of MATLAB; of one row, or one column, where it is a list.
    Matrix(Rc<Vec<Vec<Value>>>),
    /// Of Python, by its number: names may stand for the same list.
    List(usize),
    Link(usize),
    Robot(usize),
    Joint(usize),
    Body(usize),
    Tree,
    /// A function that is known by this name.
    Known(Rc<str>),
    Unknown(Lost),
}

/// A list of Python.
#[derive(Clone, Debug)]
pub(super) struct List {
    pub items: Vec<Value>,
    /// Of numpy: sums and multiples go entry by entry.
    pub is_array: bool,
    /// The array that it is a part of: numpy's parts change with the whole.
    pub part_of: Option<usize>,
    /// Of `zip` and its like, which read lists only when they are gone through: what those held when this was made.
    pub reads: Vec<(usize, Vec<Value>)>,
    pub lost: Option<Lost>,
}

/// Where a loop is in what it goes through: a list may change under way.
pub(super) struct Through {
    /// Its list; else all values.
    list: Result<usize, std::vec::IntoIter<Value>>,
    at: usize,
}

/// A body of a `rigidBodyTree`.
#[derive(Clone, Debug)]
pub(super) struct Body {
    pub name: Value,
    pub joint: Option<usize>,
    pub lost: Option<Lost>,
}

/// All that values stand for by a number.
#[derive(Default, Debug)]
pub(super) struct Store {
    pub lists: Vec<List>,
    pub links: Vec<Link>,
    pub robots: Vec<Made>,
    pub joints: Vec<Joint>,
    pub bodies: Vec<Body>,
    /// What was changed where it is unsure that the program gets there.
    pub changed: Vec<Value>,
}

impl Store {
    pub fn list(&mut self, items: Vec<Value>, is_array: bool) -> Value {
        self.lists.push(List { items, is_array, part_of: None, reads: vec![], lost: None });
        Value::List(self.lists.len() - 1)
    }

    /// What goes through lists, and has these values as long as they are not changed.
    pub fn lazily(&mut self, items: Vec<Value>, of: &[Value]) -> Value {
        let mut reads = vec![];
        for k in of.iter().filter_map(|v| if let Value::List(k) = v { Some(*k) } else { None }) {
            match self.lists[k].reads.is_empty() {
                true => reads.push((k, self.lists[k].items.clone())),
                false => reads.extend(self.lists[k].reads.iter().cloned()),
            }
        }
        self.lists.push(List { items, is_array: false, part_of: None, reads, lost: None });
        Value::List(self.lists.len() - 1)
    }

    /// True for a list whose items are not what it will be read as.
    fn is_overtaken(&self, k: usize) -> bool {
        self.lists[k]
            .reads
            .iter()
            .any(|(of, items)| self.lists[*of].items != *items || self.lists[*of].lost.is_some())
    }

    /// A list with those that it reads; nothing of other values.
    pub fn read_by(&self, value: &Value) -> Vec<Value> {
        let Value::List(k) = value else { return vec![] };
        let reads = self.lists[*k].reads.iter().map(|r| Value::List(r.0));
        reads.chain([value.clone()]).collect()
    }

    /// Begins to go through a value.
    pub fn through(&self, value: &Value) -> Result<Through, Option<Lost>> {
        let items = self.items(value)?;
        let list = if let Value::List(k) = value { Ok(*k) } else { Err(items.into_iter()) };
        Ok(Through { list, at: 0 })
    }

    /// The next value, if there is one and it is known.
    pub fn next(&self, through: &mut Through) -> Result<Option<Value>, Option<Lost>> {
        let k = match &mut through.list {
            Ok(k) => *k,
            Err(items) => return Ok(items.next()),
        };
        if self.lists[k].lost.is_some() || self.is_overtaken(k) {
            return Err(self.lists[k].lost.clone());
        }
        through.at += 1;
        Ok(self.lists[k].items.get(through.at - 1).cloned())
    }

    /// Takes what was gone through out of what can be gone through but once.
    pub fn used(&mut self, through: &Through) {
        if let Ok(k) = through.list
            && !self.lists[k].reads.is_empty()
        {
            let items = &mut self.lists[k].items;
            items.drain(..through.at.min(items.len()));
        }
    }

    /// Says that this is not known any more, nor what it holds; robots in lists stay as they are.
    pub fn lose(&mut self, value: &Value, lost: &Lost) {
        let mut open = vec![value.clone()];
        while let Some(one) = open.pop() {
            let place = match one {
                Value::List(k) => {
                    if self.lists[k].lost.is_none() {
                        open.extend(
                            self.lists[k].items.iter().filter(|v| !matches!(v, Value::Robot(_))).cloned(),
                        );
                    }
                    &mut self.lists[k].lost
                }
                Value::Matrix(rows) => {
                    let held = |v: &&Value| !matches!(v, Value::Robot(_) | Value::Number(_));
                    open.extend(rows.iter().flatten().filter(held).cloned());
                    continue;
                }
                Value::Link(k) => &mut self.links[k].lost,
                Value::Robot(k) => &mut self.robots[k].lost,
                Value::Joint(k) => &mut self.joints[k].lost,
                Value::Body(k) => &mut self.bodies[k].lost,
                _ => continue,
            };
            place.get_or_insert_with(|| lost.clone());
        }
    }

    /// Whether links stand in a value.
    pub fn holds_link(&self, value: &Value) -> bool {
        let mut open = vec![value.clone()];
        let mut seen = HashSet::new();
        while let Some(one) = open.pop() {
            match one {
                Value::Link(_) => return true,
                Value::List(k) if seen.insert(k) => open.extend(self.lists[k].items.iter().cloned()),
                Value::Matrix(rows) => open.extend(rows.iter().flatten().cloned()),
                _ => {}
            }
        }
        false
    }

    /// The entries of a list, row or column.
    pub fn items(&self, value: &Value) -> Result<Vec<Value>, Option<Lost>> {
        match value {
            Value::List(k) => match &self.lists[*k].lost {
                Some(lost) => Err(Some(lost.clone())),
                None if self.is_overtaken(*k) => Err(None),
                None => Ok(self.lists[*k].items.clone()),
            },
            Value::Matrix(rows) if rows.len() == 1 => Ok(rows[0].clone()),
            Value::Matrix(rows) if rows.iter().all(|r| r.len() == 1) => Ok(rows.concat()),
            Value::Unknown(lost) => Err(Some(lost.clone())),
            _ => Err(None),
        }
    }

    /// Whether a value counts as true, if that is known.
    pub fn truth(&self, value: &Value) -> Option<bool> {
        match value {
            Value::Bool(b) => Some(*b),
            Value::None => Some(false),
            Value::Number(f) => f.number.map(|n| n != 0.0),
            Value::Text(t) => Some(!t.is_empty()),
            Value::List(k) if self.lists[*k].lost.is_none() => Some(!self.lists[*k].items.is_empty()),
            _ => None,
        }
    }
}

/// The number that a value is; true counts as 1.
pub(super) fn formula(value: &Value) -> Option<Formula> {
    match value {
        Value::Number(f) => Some(f.clone()),
        Value::Bool(b) => Some(Formula::integer(i64::from(*b), 0..0)),
        Value::Matrix(rows) => match rows.as_slice() {
            [row] if row.len() == 1 => formula(&row[0]),
            _ => None,
        },
        _ => None,
    }
}

/// The whole number that a value is.
pub(super) fn integer(value: &Value) -> Option<i64> {
    whole(formula(value)?.number?)
}
