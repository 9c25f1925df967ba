//! Edits of a printed formula, and the text that they leave.

use super::lexicon::{Entry, Lexicon};
use super::style::is_minus;
use super::tree::{Kind, Tree};
use super::{Patch, write};
use denavit_symbolic::expr::Expr;
use denavit_symbolic::rational::Rational;
use denavit_symbolic::vocabulary::Vocabulary;
use std::ops::Range;

/// One change of what is printed. Parts are numbers in the tree.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Edit {
    /// The sign of a term, or a leading sign.
    Flip(usize),
    /// The signs of all terms of a sum.
    FlipAll(usize),
    /// Another atom.
    Respell(usize, Expr),
    /// Another number, without sign.
    Number(usize, Rational),
    /// A part is left out.
    Delete(usize),
    /// A factor is put beside a part.
    Factor(usize, Entry),
    /// A divisor is put behind a part.
    Divisor(usize, Expr),
    /// A term is added to a part.
    Term(usize, Entry, bool),
    /// Parts `from..to` of a part are replaced; true for a minus in front, if these are terms.
    Replace(usize, Range<usize>, Entry, bool),
    /// The formula is another one.
    Whole(Entry, bool),
    /// Another exponent.
    Power(usize, i32),
    /// Two parts are exchanged.
    Exchange(usize, usize),
    /// Brackets are moved: what is inserted where, and what is taken away.
    Brackets(Vec<Patch>),
}

/// What edits are printed with.
pub(super) struct Editor<'a> {
    pub text: &'a str,
    pub tree: &'a Tree,
    pub lexicon: &'a Lexicon,
    pub vocabulary: &'a Vocabulary,
    /// What stands between factors.
    pub gap: String,
}

impl Editor<'_> {
    /// The patches of all the edits, and the text with them.
    pub fn applied(&self, edits: &[Edit]) -> Option<(Vec<Patch>, String)> {
        let patches = self.patches(edits)?;
        let text = patched(self.text, &patches)?;
        Some((patches, text))
    }

    /// The patches of all the edits in the order of the text; `None` if they are in each other's way.
    fn patches(&self, edits: &[Edit]) -> Option<Vec<Patch>> {
        let mut patches = vec![];
        for edit in edits {
            patches.extend(self.of(edit)?);
        }
        patches.sort_by_key(|p| (p.span.start, p.span.end));
        patches.windows(2).all(|p| p[0].span.end <= p[1].span.start).then_some(patches)
    }

    fn span(&self, part: usize) -> Range<usize> {
        self.tree.parts[part].span.clone()
    }

    fn between(&self, span: Range<usize>) -> &str {
        self.text.get(span).unwrap_or_default()
    }

    fn of(&self, edit: &Edit) -> Option<Vec<Patch>> {
        let tree = self.tree;
        let one = |span: Range<usize>, now: String| Some(vec![Patch { span, now }]);
        match edit {
            Edit::Flip(part) => Some(vec![self.flip(*part)?]),
            Edit::FlipAll(part) => tree.parts[*part].kids.iter().map(|&k| self.flip(k)).collect(),
            Edit::Respell(part, e) => one(self.span(*part), self.spell(*e)),
            Edit::Number(part, r) => one(self.span(*part), write::number(r)),
            Edit::Delete(part) => self.delete(*part),
            Edit::Factor(part, entry) => self.factor(*part, entry),
            Edit::Divisor(part, e) => {
                let end = self.span(*part).end;
                one(end..end, format!("/{}", self.spell(*e)))
            }
            Edit::Term(part, entry, is_minus) => {
                let (span, term) = (self.span(*part), self.write_term(entry, *is_minus));
                let is_nothing = matches!(tree.parts[*part].kind, Kind::Leaf(e) if e.is_zero());
                if is_nothing {
                    let sign = if *is_minus { self.minus() } else { String::new() };
                    return one(span, sign + &term);
                }
                self.insert_term(*part, entry, *is_minus)
            }
            Edit::Replace(part, range, entry, is_minus) => {
                self.replace(*part, range.clone(), entry, *is_minus)
            }
            Edit::Whole(entry, is_minus) => {
                let sign = if *is_minus { self.minus() } else { String::new() };
                one(self.span(0), sign + &self.write_term(entry, *is_minus))
            }
            Edit::Power(part, n) => self.power(*part, *n),
            Edit::Exchange(a, b) => {
                let of = |x: usize, y: usize| Patch {
                    span: self.span(x),
                    now: self.between(self.span(y)).to_string(),
                };
                Some(vec![of(*a, *b), of(*b, *a)])
            }
            Edit::Brackets(patches) => Some(patches.clone()),
        }
    }

    fn minus(&self) -> String {
        self.lexicon.style.minus().to_string()
    }

    fn spell(&self, e: Expr) -> String {
        self.lexicon.style.spell(e, self.vocabulary)
    }

    /// The sign of a part: what stands between the term before and the part.
    fn sign(&self, part: usize) -> Option<Range<usize>> {
        let (parent, i) = self.tree.place(part)?;
        let Kind::Sum(_) = self.tree.parts[parent].kind else { return None };
        let start = match i.checked_sub(1) {
            Some(before) => self.span(self.tree.parts[parent].kids[before]).end,
            None => self.span(parent).start,
        };
        let gap = self.text.get(start..self.span(part).start)?;
        let (at, c) = gap.char_indices().rfind(|(_, c)| *c == '+' || is_minus(*c))?;
        Some(start + at..start + at + c.len_utf8())
    }

    fn flip(&self, part: usize) -> Option<Patch> {
        let start = self.span(part).start;
        let is_first = self
            .tree
            .place(part)
            .is_none_or(|(parent, i)| i == 0 || !matches!(self.tree.parts[parent].kind, Kind::Sum(_)));
        let Some(sign) = self.sign(part) else {
            return is_first.then(|| Patch { span: start..start, now: self.minus() });
        };
        let was_minus = self.between(sign.clone()).starts_with(is_minus);
        Some(match (was_minus, is_first) {
            (true, true) => Patch { span: sign.start..start, now: String::new() },
            (true, false) => Patch { span: sign, now: "+".to_string() },
            (false, _) => Patch { span: sign, now: self.minus() },
        })
    }

    fn delete(&self, part: usize) -> Option<Vec<Patch>> {
        let (parent, i) = self.tree.place(part)?;
        let kids = &self.tree.parts[parent].kids;
        if kids.len() < 2 {
            return None;
        }
        let own = self.span(part);
        if let Some(before) = i.checked_sub(1) {
            return Some(vec![Patch { span: self.span(kids[before]).end..own.end, now: String::new() }]);
        }
        let next = self.span(kids[1]).start;
        match &self.tree.parts[parent].kind {
            Kind::Sum(signs) => {
                let now = if signs[1] { self.minus() } else { String::new() };
                Some(vec![Patch { span: self.span(parent).start..next, now }])
            }
            Kind::Product(places) if places[1] => Some(vec![Patch { span: own, now: "1".to_string() }]),
            Kind::Product(_) => Some(vec![Patch { span: own.start..next, now: String::new() }]),
            Kind::Leaf(_) | Kind::Power(_) | Kind::Root | Kind::Arctangent | Kind::Bracket => None,
        }
    }

    /// A term at the place where the author would print it.
    fn insert_term(&self, part: usize, entry: &Entry, is_minus: bool) -> Option<Vec<Patch>> {
        let style = &self.lexicon.style;
        let (span, term) = (self.span(part), self.write_term(entry, is_minus));
        let one = |span: Range<usize>, now: String| Some(vec![Patch { span, now }]);
        let (kids, leads_minus) = match &self.tree.parts[part].kind {
            Kind::Sum(signs) => (self.tree.parts[part].kids.clone(), signs.first() == Some(&true)),
            _ => (vec![part], false),
        };
        let own = self.writer().lead(&self.lexicon.factors(entry));
        let others: Vec<Option<Expr>> = kids.iter().map(|&k| self.lead(k)).collect();
        let mut at = style.place(own, &others);
        if at == kids.len() && leads_minus && !is_minus {
            at = 0; // a term with a plus comes before a leading minus
        }
        if at == 0 {
            let sign = if is_minus { self.minus() } else { String::new() };
            return one(
                span.start..self.span(*kids.first()?).start,
                sign + &term + &style.term_gap(leads_minus),
            );
        }
        let end = self.span(*kids.get(at - 1)?).end;
        one(end..end, style.term_gap(is_minus) + &term)
    }

    /// The name that a part begins with.
    fn lead(&self, part: usize) -> Option<Expr> {
        match self.tree.leaf(part) {
            Some(e) => Some(e).filter(|e| e.as_number().is_none()),
            None => self.lead(*self.tree.parts[part].kids.first()?),
        }
    }

    /// A factor at the place where the author would print it.
    fn factor(&self, part: usize, entry: &Entry) -> Option<Vec<Patch>> {
        let insert = |at: usize, now: String| Some(vec![Patch { span: at..at, now }]);
        let factor = self.write_factor(entry);
        let whole = self.span(part);
        if let Kind::Sum(_) = self.tree.parts[part].kind {
            let open =
                Patch { span: whole.start..whole.start, now: format!("{factor}{}(", self.bracket_gap()) };
            return Some(vec![open, Patch { span: whole.end..whole.end, now: ")".to_string() }]);
        }
        let kids = match &self.tree.parts[part].kind {
            // A fraction takes its factors in front.
            Kind::Product(places) if !places.contains(&true) => self.tree.parts[part].kids.clone(),
            _ => vec![part],
        };
        let lead = match entry {
            Entry::Product(atoms) => {
                atoms.first().map_or(Expr::int(1), |&i| self.lexicon.atoms[usize::from(i)].0)
            }
            Entry::Sum(..) | Entry::Phrase(..) => self.lexicon.expr(entry),
        };
        // The place at which the fewest neighbours are on the wrong side.
        let is_after = |kid: &usize| {
            let kid = self.tree.leaf(*kid).unwrap_or_else(Expr::pi); // π: sorted like a bracket
            self.lexicon.style.compare(kid, lead)
        };
        let sides: Vec<_> = kids.iter().map(is_after).collect();
        let wrong = |at: usize| {
            let before = sides[..at].iter().filter(|s| s.is_gt()).count();
            before + sides[at..].iter().filter(|s| s.is_lt()).count()
        };
        let at = (0..=kids.len()).rev().min_by_key(|&at| wrong(at))?;
        let gap = |neighbour: usize| match self.tree.parts[neighbour].kind {
            Kind::Bracket => self.bracket_gap(),
            _ => self.gap.clone(),
        };
        match (at.checked_sub(1), kids.get(at)) {
            (_, Some(&next)) => insert(self.span(next).start, factor + &gap(next)),
            (Some(before), None) => insert(self.span(kids[before]).end, gap(kids[before]) + &factor),
            (None, None) => None,
        }
    }

    /// What stands between a factor and a bracket.
    fn bracket_gap(&self) -> String {
        if self.gap.trim().is_empty() { self.gap.trim_end().to_string() } else { self.gap.clone() }
    }

    fn replace(&self, part: usize, range: Range<usize>, entry: &Entry, minus: bool) -> Option<Vec<Patch>> {
        let kids = self.tree.parts[part].kids.get(range.clone())?;
        let (first, last) = (self.span(*kids.first()?), self.span(*kids.last()?));
        if let Kind::Sum(_) = self.tree.parts[part].kind {
            let term = self.write_term(entry, minus);
            let (start, sign) = match range.start.checked_sub(1) {
                Some(before) => {
                    (self.span(self.tree.parts[part].kids[before]).end, self.lexicon.style.term_gap(minus))
                }
                None => (self.span(part).start, if minus { self.minus() } else { String::new() }),
            };
            return Some(vec![Patch { span: start..last.end, now: sign + &term }]);
        }
        let is_whole = kids.len() == 1 && self.tree.is_whole(kids[0]);
        let now = if is_whole { self.write_term(entry, false) } else { self.write_factor(entry) };
        let mut patches = vec![Patch { span: first.start..last.end, now }];
        if minus {
            patches.push(self.flip(self.tree.term(part))?);
        }
        Some(patches)
    }

    fn power(&self, part: usize, n: i32) -> Option<Vec<Patch>> {
        let part = &self.tree.parts[part];
        let Kind::Power(_) = part.kind else {
            let now = if (0..10).contains(&n) { format!("^{n}") } else { format!("^{{{n}}}") };
            return Some(vec![Patch { span: part.span.end..part.span.end, now }]);
        };
        let base = self.span(part.kids[0]);
        let exponent = self.text.get(base.end..part.span.end)?;
        let is_digit = |c: char| c.is_ascii_digit() || is_minus(c);
        let (from, to) = (exponent.find(is_digit)?, exponent.rfind(is_digit)?);
        let now = match n {
            1 => String::new(),
            n => format!("{}{n}{}", &exponent[..from], exponent.get(to + 1..)?),
        };
        Some(vec![Patch { span: base.end..part.span.end, now }])
    }

    fn writer(&self) -> write::Writer<'_> {
        write::Writer { style: &self.lexicon.style, vocabulary: self.vocabulary, gap: &self.gap }
    }

    fn write_factor(&self, entry: &Entry) -> String {
        self.writer().factors(&self.lexicon.factors(entry))
    }

    /// A term; of a sum behind a minus, in brackets.
    fn write_term(&self, entry: &Entry, behind_minus: bool) -> String {
        match &self.lexicon.factors(entry)[..] {
            [one] => self.writer().term(*one, behind_minus),
            factors => self.writer().factors(factors),
        }
    }
}

/// The text with the patches applied, which are in the order of the text.
fn patched(text: &str, patches: &[Patch]) -> Option<String> {
    let mut result = String::with_capacity(text.len() + 16);
    let mut at = 0;
    for patch in patches {
        result.push_str(text.get(at..patch.span.start)?);
        result.push_str(&patch.now);
        at = patch.span.end;
    }
    result.push_str(text.get(at..)?);
    Some(result)
}
