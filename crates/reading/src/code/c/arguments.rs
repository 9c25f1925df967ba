//! The arguments of a function of C: those that it reads, and those that it writes.

use super::{MAX_LENGTH, Writer};
use crate::code::lexer::{Mark, Token};
use std::collections::BTreeMap;

impl Writer {
    /// The fields that a function writes, by structure, in order.
    pub(super) fn written(&self, from: usize, to: usize) -> BTreeMap<String, Vec<String>> {
        let mut found: BTreeMap<String, Vec<String>> = BTreeMap::new();
        for i in from..to {
            if let (Some(base), "." | "->", Some(field), "=") =
                (self.name(i), self.op(i + 1), self.name(i + 2), self.op(i + 3))
            {
                let fields = found.entry(base.to_string()).or_default();
                if !fields.iter().any(|f| f == field) {
                    fields.push(field.to_string());
                }
            }
        }
        found
    }

    /// Writes the arguments that a function reads; returns the arrays that it writes, with their sizes.
    pub(super) fn parameters(
        &mut self,
        from: usize,
        to: usize,
        body: usize,
        end: usize,
    ) -> Vec<(String, Vec<usize>)> {
        let mut sizes = vec![];
        let mut start = from;
        let mut is_first = true;
        while start < to {
            // The commas of `std::array<double, 3>` are its own.
            let first = self.behind_type(start).filter(|k| *k < to).unwrap_or(start);
            let stop = (first..to).find(|&i| self.op(i) == ",").unwrap_or(to);
            let words: Vec<usize> = (start..stop).filter(|&i| self.name(i).is_some()).collect();
            let is_const = words.iter().any(|&i| self.name(i) == Some("const"));
            if let Some(&k) = words.last().filter(|&&i| self.name(i) != Some("void")) {
                let name = self.name(k).unwrap_or_default().to_string();
                let is_pointer = (start..k).any(|i| matches!(self.op(i), "*" | "&")) || self.op(k + 1) == "[";
                let is_structure = self.fields.contains_key(&name);
                let is_written = !is_const && is_pointer && self.is_written(&name, body, end);
                if self.read.is_empty() && self.is_read_by_fields(k, [from, to], [body, end]) {
                    self.read.insert(name);
                } else if is_structure && is_pointer {
                    let fields = self.fields.get(&name).cloned().unwrap_or_default();
                    let names: Vec<String> = fields.iter().map(|f| self.field(&name, f)).collect();
                    self.outputs.extend(names);
                } else if is_written {
                    self.outputs.push(name.clone());
                    if let Some(size) = self.size(k, &name, body, end) {
                        sizes.push((name, size));
                    }
                } else {
                    if !is_first {
                        self.out.push(Token { mark: Mark::Op(","), ..self.tokens[k].clone() });
                    }
                    self.out.push(self.tokens[k].clone());
                    is_first = false;
                }
            }
            start = stop + 1;
        }
        sizes
    }

    /// True for an argument of a type with a name of its own of which a function reads fields, and nothing else.
    fn is_read_by_fields(&self, k: usize, [from, to]: [usize; 2], [body, end]: [usize; 2]) -> bool {
        let type_at = k - usize::from(matches!(self.op(k - 1), "*" | "&"));
        let is_own = type_at > 0 && self.name(type_at - 1).is_some_and(|w| !super::TYPES.contains(&w));
        let Some(name) = self.name(k) else { return false };
        let mut uses = (body..end).filter(|&i| self.name(i) == Some(name) && !self.is_field(i)).peekable();
        // A name that the function has elsewhere is another value, unless it is given that of the field, and no other.
        let is_field_itself = |i: usize, f: &str| {
            self.op(i + 1) == "="
                && self.name(i + 2) == Some(name)
                && matches!(self.op(i + 3), "." | "->")
                && self.name(i + 4) == Some(f)
                && matches!(self.op(i + 5), ";" | ",")
        };
        let is_free = |f: &str| {
            let is_it = |i: &usize| self.name(*i) == Some(f) && !self.is_field(*i);
            let is_given = |i: usize| matches!(self.op(i + 1), "=" | "+=" | "-=" | "*=" | "/=");
            !(from..to).any(|i| is_it(&i))
                && (body..end).find(is_it).is_none_or(|i| is_field_itself(i, f))
                && (body..end).filter(is_it).filter(|&i| is_given(i)).count() <= 1
        };
        let is_read = |i: usize| {
            matches!(self.op(i + 1), "." | "->")
                && self.name(i + 2).is_some_and(|f| !matches!(f, "x" | "y" | "z") && is_free(f))
                && !matches!(self.op(i + 3), "=" | "(" | "[" | "." | "->")
        };
        is_own && uses.peek().is_some() && uses.all(is_read)
    }

    /// True for the name of a field, `d1` of `arm.d1`.
    fn is_field(&self, i: usize) -> bool {
        i > 0 && matches!(self.op(i - 1), "." | "->")
    }

    /// True if a function gives an argument, or entries of it, a value.
    pub(super) fn is_written(&self, name: &str, body: usize, end: usize) -> bool {
        (body..end).filter(|&i| self.name(i) == Some(name)).any(|i| {
            let mut k = i + 1;
            while self.op(k) == "[" {
                k = self.behind(k);
            }
            self.op(k) == "="
        })
    }

    /// The size of an array that is written, declared or by its largest index.
    pub(super) fn size(&self, k: usize, name: &str, body: usize, end: usize) -> Option<Vec<usize>> {
        let whole = |i: usize| match self.tokens.get(i).map(|t| &t.mark) {
            Some(Mark::Number(r, true)) => r.to_integer().and_then(|n| usize::try_from(n).ok()),
            _ => None,
        };
        let mut declared = vec![];
        let mut i = k + 1;
        while self.op(i) == "[" {
            declared.push(whole(i + 1));
            i = self.behind(i);
        }
        if !declared.is_empty() && declared.iter().all(Option::is_some) {
            return declared.into_iter().map(|n| n.filter(|n| (1..=MAX_LENGTH).contains(n))).collect();
        }
        let mut sides: Vec<usize> = vec![];
        for i in (body..end).filter(|&i| self.name(i) == Some(name)) {
            let (mut k, mut side) = (i + 1, 0);
            while self.op(k) == "[" {
                let n = whole(k + 1)? + 1;
                match sides.get_mut(side) {
                    Some(most) => *most = n.max(*most),
                    None => sides.push(n),
                }
                (k, side) = (self.behind(k), side + 1);
            }
        }
        let fits = !sides.is_empty() && sides.iter().all(|n| *n <= MAX_LENGTH);
        fits.then_some(sides)
    }
}
