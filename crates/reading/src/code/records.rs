//! Names get their values, and what they get is put down for the reader.

use super::machine::{Machine, Slot};
use super::report;
use super::scalar::Scalar;
use super::tree::{Definition, Span};
use super::value::{Matrix, Object};
use super::{Assigned, Returned};
use denavit_symbolic::Expr;
use denavit_symbolic::parse::ParseError;
use std::rc::Rc;

impl<'a> Machine<'a> {
    /// What a MATLAB function gives back.
    pub fn outputs(&mut self, d: &'a Definition) -> Vec<Returned> {
        let mut returned = vec![];
        for (name, span) in &d.outputs {
            self.flush(name);
            let slot = self.frame().slots.get(name.as_str());
            match slot.map(|s| (s.value.clone(), s.record)) {
                None => {
                    self.refuse(ParseError::new(span.clone(), format!("`{name}` is given no value")).into())
                }
                Some((Some(value), record)) => {
                    let of_record = record.and_then(|r| self.records.get(r)?.as_ref());
                    let span = of_record.map_or(span.clone(), |a| a.span.clone());
                    if let Some(value) = report::value(&value, &mut self.budget) {
                        returned.push(Returned { name: Some(name.clone()), span, value });
                    }
                }
                Some((None, _)) => {}
            }
        }
        returned
    }

    /// True in the function that is read, not in those that it calls.
    pub(super) fn is_recorded(&self) -> bool {
        self.frames.len() == self.root + 1
    }

    /// Gives a name its value.
    pub fn bind(&mut self, name: &'a str, value: Object<'a>, right: Option<&Span>) {
        self.flush(name);
        let value = match value {
            Object::Scalar(s) => Object::Scalar(s.settled()),
            value => value,
        };
        let mut record = None;
        if let Some(value) = self.told(name, &value) {
            self.frame().slots.insert(name, Slot::of(value));
            return;
        }
        if let (true, Some(right)) = (self.is_recorded(), right)
            && let Some(value) = report::value(&value, &mut self.budget)
        {
            record = Some(self.records.len());
            self.records.push(Some(Assigned { name: name.to_string(), span: right.clone(), value }));
        }
        let value = right.map_or(value.clone(), |right| self.mended(value, right.start));
        let posed = right.and_then(|right| {
            self.pose_in_numbers(name, &value, right).or_else(|| self.joint_of(name, &value, right))
        });
        let value = posed.unwrap_or(value);
        // How a scalar is written was put down; from here on its name stands for it.
        let value = match value {
            Object::Scalar(s) => Object::Scalar(s.unwritten(&s.span)),
            value => value,
        };
        self.frame().slots.insert(name, Slot { value: Some(value), record, touched: None });
    }

    /// The value that stands for one that is written at a place.
    fn mended(&self, value: Object<'a>, place: usize) -> Object<'a> {
        let Some(entries) = self.mended.get(&place).filter(|_| self.is_recorded()) else { return value };
        match (value, entries.as_slice()) {
            (Object::Scalar(s), [e]) => Object::Scalar(Scalar::of(*e, &s.span)),
            (Object::Matrix(m), all) if m.entries.len() == all.len() => {
                let entries = all.iter().zip(&m.entries).map(|(e, s)| Scalar::of(*e, &s.span)).collect();
                Object::Matrix(Matrix { entries, storage: Rc::new(()), ..Matrix::clone(&m) }.into())
            }
            (value, _) => value,
        }
    }

    /// What a name stands for that the script gives numbers, and which is known to be something else.
    fn told(&self, name: &str, value: &Object<'a>) -> Option<Object<'a>> {
        if self.frames.len() > 1 {
            return None;
        }
        let replaced = |entries: &[Scalar]| -> Option<Vec<Scalar>> {
            let values: Vec<Expr> = entries.iter().map(|s| s.expr).collect();
            let now = (self.stated)(name, &values)?;
            Some(now.into_iter().zip(entries).map(|(e, s)| Scalar::of(e, &s.span)).collect())
        };
        match value {
            Object::Scalar(s) => Some(Object::Scalar(replaced(std::slice::from_ref(s))?.pop()?)),
            Object::Matrix(m) if m.is_vector() => {
                let entries = replaced(&m.entries)?;
                Some(Object::Matrix(Matrix { entries, storage: Rc::new(()), ..Matrix::clone(m) }.into()))
            }
            Object::List(items) => {
                let scalar = |o: &Object<'a>| match o {
                    Object::Scalar(s) => Some(s.clone()),
                    _ => None,
                };
                let entries: Vec<Scalar> = items.iter().map(scalar).collect::<Option<_>>()?;
                Some(Object::list(replaced(&entries)?.into_iter().map(Object::Scalar).collect()))
            }
            _ => None,
        }
    }

    /// Entries of a name were set: what it was before is not its value.
    pub fn touch(&mut self, name: &'a str, span: &Span) {
        if !self.is_recorded() {
            return;
        }
        let Some(slot) = self.frame().slots.get_mut(name) else { return };
        let record = slot.record.take();
        let start = slot.touched.as_ref().map_or(span.start, |t| t.start);
        if let Some(old) = record.and_then(|r| self.records.get_mut(r)) {
            *old = None;
        }
        if let Some(slot) = self.frame().slots.get_mut(name) {
            let end = slot.touched.as_ref().map_or(span.end, |t| t.end.max(span.end));
            slot.touched = Some(start..end);
        }
    }

    /// Puts down what a name has become by its entries.
    pub fn flush(&mut self, name: &str) {
        if !self.is_recorded() {
            return;
        }
        let next = self.records.len();
        let Some(slot) = self.frame().slots.get_mut(name) else { return };
        let Some(span) = slot.touched.take() else { return };
        slot.record = Some(next);
        let value = slot.value.clone();
        if let Some(written) = value.clone().and_then(|v| report::value(&v, &mut self.budget)) {
            let place = span.start;
            self.records.push(Some(Assigned { name: name.to_string(), span, value: written }));
            if let Some(value) = value.filter(|_| self.mended.contains_key(&place)) {
                let value = self.mended(value, place);
                if let Some(slot) = self.frame().slots.get_mut(name) {
                    slot.value = Some(value);
                }
            }
        } else {
            self.records.push(None);
        }
    }

    /// What was put down.
    pub fn assigned(&mut self) -> Vec<Assigned> {
        let mut touched: Vec<(usize, &'a str)> = self
            .frame()
            .slots
            .iter()
            .filter_map(|(name, slot)| Some((slot.touched.as_ref()?.start, *name)))
            .collect();
        touched.sort_unstable();
        for (_, name) in touched {
            self.flush(name);
        }
        for slot in self.frame().slots.values_mut() {
            slot.record = None;
        }
        std::mem::take(&mut self.records).into_iter().flatten().collect()
    }
}

/// True for a value that is numbers alone.
pub(super) fn is_number(value: &Object<'_>) -> bool {
    match value {
        Object::Scalar(s) => s.expr.symbols().is_empty(),
        Object::Matrix(m) => m.entries.iter().all(|s| s.expr.symbols().is_empty()),
        Object::List(items) => items.iter().all(is_number),
        _ => false,
    }
}
