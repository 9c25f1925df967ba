//! Names get their values, and what they get is put down for the reader.

use super::machine::{Machine, Slot};
use super::report;
use super::tree::{Definition, Span};
use super::value::Object;
use super::{Assigned, Returned};
use denavit_symbolic::parse::ParseError;

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
    fn is_recorded(&self) -> bool {
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
        if let (true, Some(right)) = (self.is_recorded(), right)
            && let Some(value) = report::value(&value, &mut self.budget)
        {
            record = Some(self.records.len());
            self.records.push(Some(Assigned { name: name.to_string(), span: right.clone(), value }));
        }
        // How a scalar is written was put down; from here on its name stands for it.
        let value = match value {
            Object::Scalar(s) => Object::Scalar(s.unwritten(&s.span)),
            value => value,
        };
        self.frame().slots.insert(name, Slot { value: Some(value), record, touched: None });
    }

    /// Entries of a name were set: what it was before is not its value.
    pub fn touch(&mut self, name: &'a str, span: &Span) {
        if !self.is_recorded() {
            return;
        }
        let Some(slot) = self.frame().slots.get_mut(name) else { return };
        let record = slot.record.take();
        let mut start = slot.touched.as_ref().map_or(span.start, |t| t.start);
        if let Some(old) = record.and_then(|r| self.records.get_mut(r)?.take()) {
            start = start.min(old.span.start);
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
        if let Some(value) = value.and_then(|v| report::value(&v, &mut self.budget)) {
            self.records.push(Some(Assigned { name: name.to_string(), span, value }));
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
