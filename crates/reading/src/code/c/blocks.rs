//! Branches, loops and blocks of C as those of Python.

use super::{TYPES, Writer};
use crate::code::lexer::{Mark, Token};
use denavit_symbolic::Rational;
use std::collections::BTreeSet;

/// So many tokens before an argument its call is looked for.
const MAX_ARGUMENTS: usize = 200;

impl Writer {
    /// `if (…) … else …`
    pub(super) fn branches(&mut self) {
        self.word("if");
        loop {
            let close = self.behind(self.at + 1);
            self.at += 1;
            while self.at < close {
                match self.op(self.at) {
                    op @ ("&&" | "||" | "!") => {
                        let word = [("&&", "and"), ("||", "or"), ("!", "not")];
                        let word = word.iter().find(|w| w.0 == op).map_or("not", |w| w.1);
                        self.word(word);
                        self.at += 1;
                    }
                    _ => self.token(),
                }
            }
            self.body();
            if self.name(self.at) != Some("else") {
                return;
            }
            self.at += 1;
            if self.name(self.at) == Some("if") {
                self.word("elif");
                continue;
            }
            self.word("else");
            self.body();
            return;
        }
    }

    /// `for (int i = 0; i < 4; i++) …`, as a loop over a range; false for any other loop.
    pub(super) fn counted_loop(&mut self) -> bool {
        let close = self.behind(self.at + 1);
        let mut k = self.at + 2;
        while self.name(k).is_some_and(|w| TYPES.contains(&w)) {
            k += 1;
        }
        let (Some(name), "=") = (self.name(k).map(str::to_string), self.op(k + 1)) else { return false };
        let end_of = |from: usize| (from..close).find(|&i| self.op(i) == ";");
        let Some(first) = end_of(k + 2) else { return false };
        let Some(second) = end_of(first + 1) else { return false };
        let is_name = |i: usize| self.name(i) == Some(&name);
        let compares = matches!(self.op(first + 2), "<" | "<=") && is_name(first + 1);
        let step = second + 1;
        let counts = is_name(step) && self.op(step + 1) == "++" && step + 3 == close
            || self.op(step) == "++" && is_name(step + 1) && step + 3 == close;
        // Bounds that are numbers, so that the turns are known.
        let is_number = |i: usize| matches!(self.tokens.get(i).map(|t| &t.mark), Some(Mark::Number(..)));
        let has_numbers = (k + 2..first).chain(first + 3..second).all(is_number);
        if !(compares && counts && has_numbers && first > k + 2 && second > first + 3) {
            return false;
        }
        let is_closed = self.op(first + 2) == "<=";
        self.word("for");
        self.word(&name);
        self.word("in");
        self.word("range");
        self.put(Mark::Op("("));
        self.out.extend_from_slice(&self.tokens[k + 2..first]);
        self.put(Mark::Op(","));
        self.out.extend_from_slice(&self.tokens[first + 3..second]);
        if is_closed {
            self.put(Mark::Op("+"));
            self.put(Mark::Number(Rational::from(1), true));
        }
        self.put(Mark::Op(")"));
        self.at = close;
        self.body();
        true
    }

    pub(super) fn body(&mut self) {
        self.put(Mark::Op(":"));
        self.put(Mark::Newline);
        self.put(Mark::Indent);
        self.word("pass");
        self.put(Mark::Newline);
        self.depth += 1;
        if self.depth < 60 {
            self.statement();
        } else {
            self.passed_over();
        }
        self.depth -= 1;
        self.put(Mark::Dedent);
    }

    pub(super) fn block(&mut self, end: usize) {
        self.depth += 1;
        while self.at + 1 < end && self.depth < 60 {
            let before = self.at;
            self.statement();
            self.at = self.at.max(before + 1);
        }
        self.depth -= 1;
        self.at = end;
    }

    /// Past a statement or a block that says nothing here.
    pub(super) fn passed_over(&mut self) {
        while self.at < self.tokens.len() {
            match self.op(self.at) {
                ";" => {
                    self.at += 1;
                    return;
                }
                "{" => {
                    self.at = self.behind(self.at);
                    while self.name(self.at).is_some() && self.op(self.at + 1) == ";" {
                        self.at += 1;
                    }
                    return;
                }
                "(" => self.at = self.behind(self.at),
                _ => self.at += 1,
            }
        }
    }

    /// A loop: what it changes is not known afterwards.
    pub(super) fn refused(&mut self) {
        let word = self.name(self.at).unwrap_or_default().to_string();
        self.lost(format!("`{word}` is not read"));
    }

    /// A function inside of a statement, `std::for_each(…, [&](double a) { x += a; });`: what it changes is not known afterwards.
    pub(super) fn inner_function(&mut self) -> bool {
        let (mut depth, mut k) = (0_usize, self.at);
        // Whether the brackets around are round.
        let mut round = vec![];
        let is_one = loop {
            match self.op(k) {
                _ if k >= self.tokens.len() => break false,
                ";" if depth == 0 => break false,
                // A statement of a block.
                ";" if round.last() == Some(&false) => break true,
                op @ ("(" | "{" | "[") => {
                    depth += 1;
                    round.push(op != "{");
                }
                ")" | "}" | "]" if depth == 0 => break false,
                ")" | "}" | "]" => {
                    depth -= 1;
                    round.pop();
                }
                "+=" | "-=" | "*=" | "/=" if depth > 0 => break true,
                _ => {}
            }
            k += 1;
        };
        if is_one {
            self.lost("a function inside of a statement is not read".into());
        }
        is_one
    }

    fn lost(&mut self, message: String) {
        self.out.push(Token { mark: Mark::Bad(message), ..self.tokens[self.at].clone() });
        self.put(Mark::Newline);
        let start = self.at;
        self.passed_over();
        let changed: BTreeSet<String> = (start..self.at).flat_map(|i| self.given_at(i, start)).collect();
        let end = self.at;
        self.at = start;
        for name in changed {
            self.word(&name);
            self.put(Mark::Op("="));
            self.put(Mark::Bad("what a loop makes of it is not known".into()));
            self.put(Mark::Newline);
        }
        self.at = end;
    }

    /// The names that get a value by what stands at a place, in statements from `start` on: on a left side, counted up, or handed to a
    /// function that is called for that.
    fn given_at(&self, at: usize, start: usize) -> Vec<String> {
        const GIVES: [&str; 9] = ["=", "+=", "-=", "*=", "/=", "<<=", ">>=", "++", "--"];
        let before = |k: usize| if k > start { self.op(k - 1) } else { ";" };
        if self.op(at) == "]" && self.op(at + 1) == "=" {
            // `[a, b] = …`
            let open = (start..at).rev().find(|&k| self.op(k) == "[").filter(|&k| !before(k).is_empty());
            let inside = open.map_or(at..at, |open| open + 1..at);
            return inside.filter_map(|k| self.name(k).map(str::to_string)).collect();
        }
        let Some(name) = self.name(at) else { return vec![] };
        let mut names = vec![name.to_string()];
        let mut k = at + 1;
        loop {
            match (self.op(k), self.name(k + 1)) {
                ("[", _) => k = self.behind(k),
                ("." | "->", Some(field)) => {
                    names.extend([field.to_string(), self.field(name, field)]);
                    k += 2;
                }
                _ => break,
            }
        }
        let is_counted = matches!(before(at), "++" | "--");
        // `&x`, and `mul(A, B, C);` as a statement.
        let is_alone = matches!(self.op(k), "," | ")");
        let is_place = before(at) == "&" && is_alone;
        let is_handed = is_alone && matches!(before(at), "," | "(") && self.is_argument(start, at);
        if GIVES.contains(&self.op(k)) || is_counted || is_place || is_handed { names } else { vec![] }
    }

    /// True for what stands in the brackets of a call that is a statement by itself.
    fn is_argument(&self, start: usize, at: usize) -> bool {
        let mut depth = 0_usize;
        for i in (start + 1..at).rev().take(MAX_ARGUMENTS) {
            match self.op(i) {
                ")" | "]" | "}" => depth += 1,
                "(" | "[" | "{" if depth > 0 => depth -= 1,
                "(" => {
                    let is_first = i < start + 2 || matches!(self.op(i - 2), ";" | "{" | "}" | ")");
                    return is_first && self.name(i - 1).is_some() && self.op(self.behind(i)) == ";";
                }
                "[" | "{" => return false,
                _ => {}
            }
        }
        false
    }
}
