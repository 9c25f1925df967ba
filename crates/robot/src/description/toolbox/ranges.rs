//! Ranges of whole numbers.

use super::parse::Node;
use super::run::Run;
use super::value::{Formula, MAX_ITEMS, Value, integer};
use std::ops::Range;
use std::rc::Rc;

impl Run<'_> {
    /// `1:n`, `a:step:b`
    pub fn range(&mut self, ends: &[Option<Node>], span: &Range<usize>) -> Value {
        let mut numbers = vec![];
        for end in ends {
            let Some(end) = end else { return self.unknown(span) };
            match integer(&self.value(end)) {
                Some(n) => numbers.push(n),
                None => return self.unknown(span),
            }
        }
        let (first, step, last) = match numbers[..] {
            [first, last] => (first, 1, last),
            [first, step, last] if step != 0 => (first, step, last),
            _ => return self.unknown(span),
        };
        match self.counted(first, step, last, span) {
            Some(items) => Value::Matrix(Rc::new(vec![items])),
            None => self.unknown(span),
        }
    }

    /// The numbers from the first to the last, which is among them.
    pub fn counted(&mut self, first: i64, step: i64, last: i64, span: &Range<usize>) -> Option<Vec<Value>> {
        let count =
            if step == 0 { return None } else { usize::try_from((last - first) / step + 1).unwrap_or(0) };
        let count = if (last - first).signum() * step.signum() < 0 { 0 } else { count };
        if count > MAX_ITEMS || self.step(count, span) {
            return None;
        }
        let at = |k: usize| first + step * i64::try_from(k).unwrap_or(0);
        Some((0..count).map(|k| Value::Number(Formula::integer(at(k), span.clone()))).collect())
    }
}
