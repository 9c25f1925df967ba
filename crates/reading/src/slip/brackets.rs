//! Brackets that close too early or too late, that are lost, or that are too many.

use super::edit::Edit;
use super::field::{self, ONE, Value, ZERO};
use super::search::{Hit, Work};
use super::tree::{Kind, Needed, Tree};
use super::{Patch, Slip};

/// No longer sequences are tried, in marks.
const MAX_MARKS: usize = 400;

/// What brackets are moved among.
#[derive(Clone, Debug)]
enum Mark {
    Open,
    Close,
    Plus,
    Minus,
    Over,
    Value(Value),
}

/// A mark and where it stands.
#[derive(Clone, Debug)]
struct Placed {
    mark: Mark,
    start: usize,
    end: usize,
}

/// Looks for other places of the brackets in every part that stands by itself.
pub(super) fn all(text: &str, tree: &Tree, values: &[Value], needed: &[Needed], work: &mut Work) -> Vec<Hit> {
    let mut hits = vec![];
    for (i, own) in needed.iter().enumerate() {
        let parent = tree.parts[i].parent.map(|p| &tree.parts[p].kind);
        let is_own = tree.is_whole(i) && parent != Some(&Kind::Bracket);
        let Some((n, d)) = own.filter(|_| is_own) else { continue };
        let Some(wanted) = field::reciprocal(&d).map(|x| field::product(&n, &x)) else { continue };
        let mut marks = vec![];
        flatten(text, tree, values, i, &mut marks);
        if marks.len() <= MAX_MARKS {
            Search { text, marks: &marks, wanted, hits: &mut hits }.run(work);
        }
    }
    hits
}

fn flatten(text: &str, tree: &Tree, values: &[Value], part: usize, marks: &mut Vec<Placed>) {
    let own = &tree.parts[part];
    let mut push = |mark: Mark, start: usize, end: usize| marks.push(Placed { mark, start, end });
    match &own.kind {
        Kind::Sum(signs) => {
            for (i, (&kid, &is_minus)) in own.kids.iter().zip(signs).enumerate() {
                let start = tree.parts[kid].span.start;
                if i > 0 || is_minus {
                    let sign = if i == 0 { own.span.start } else { start };
                    marks.push(Placed {
                        mark: if is_minus { Mark::Minus } else { Mark::Plus },
                        start: sign,
                        end: start,
                    });
                }
                flatten(text, tree, values, kid, marks);
            }
        }
        Kind::Product(places) if !own.kids.iter().any(|&k| tree.parts[k].in_braces) => {
            for (&kid, &is_under) in own.kids.iter().zip(places) {
                if is_under {
                    let start = tree.parts[kid].span.start;
                    marks.push(Placed { mark: Mark::Over, start, end: start });
                }
                match tree.parts[kid].kind {
                    // `a*-b`: a sign that is no term's.
                    Kind::Sum(_) => {
                        let span = &tree.parts[kid].span;
                        marks.push(Placed {
                            mark: Mark::Value(values[kid]),
                            start: span.start,
                            end: span.end,
                        });
                    }
                    _ => flatten(text, tree, values, kid, marks),
                }
            }
        }
        Kind::Bracket => {
            let inner = tree.parts[own.kids[0]].span.clone();
            let between = |from: usize, to: usize| text.get(from..to).unwrap_or_default();
            let open = between(own.span.start, inner.start).trim_end().len();
            let close = between(inner.end, own.span.end).trim_start();
            let close = close.strip_prefix("\\right").map_or(close, str::trim_start).len();
            push(Mark::Open, sized(text, own.span.start), own.span.start + open);
            flatten(text, tree, values, own.kids[0], marks);
            let end = own.span.end;
            marks.push(Placed { mark: Mark::Close, start: sized(text, end - close), end });
        }
        Kind::Leaf(_) | Kind::Product(_) | Kind::Power(_) | Kind::Root | Kind::Arctangent => {
            push(Mark::Value(values[part]), own.span.start, own.span.end);
        }
    }
}

/// The place of a bracket with the `\left` or `\right` before it.
fn sized(text: &str, bracket: usize) -> usize {
    let before = text.get(..bracket).unwrap_or_default().trim_end();
    let word = ["\\left", "\\right"].into_iter().find(|w| before.ends_with(w));
    word.map_or(bracket, |w| before.len() - w.len())
}

/// Brackets taken away, and brackets put before a mark; true for an opening one.
struct Move {
    gone: Vec<usize>,
    new: Vec<(usize, bool)>,
    cost: u32,
}

struct Search<'a> {
    text: &'a str,
    marks: &'a [Placed],
    wanted: Value,
    hits: &'a mut Vec<Hit>,
}

impl Search<'_> {
    fn run(&mut self, work: &mut Work) {
        let pairs = self.pairs();
        let count = self.marks.len();
        // Places: number i is before mark i.
        let closes = |i: usize| i > 0 && matches!(self.marks[i - 1].mark, Mark::Value(_) | Mark::Close);
        let opens = |i: usize| {
            let is_first = i == 0 || matches!(self.marks[i - 1].mark, Mark::Open);
            match self.marks.get(i).map(|m| &m.mark) {
                Some(Mark::Value(_) | Mark::Open) => true,
                Some(Mark::Minus) => is_first,
                _ => false,
            }
        };
        // A bracket around a single factor or term is at the wrong place.
        let is_idle = |open: usize, close: usize| {
            self.marks[open..close].iter().all(|m| !matches!(m.mark, Mark::Plus | Mark::Minus))
        };
        let mut moves: Vec<Move> = vec![];
        for &(open, close) in &pairs {
            let base = if is_idle(open, close) { 10 } else { 18 };
            // Beyond the other bracket of the pair it closes another one.
            for at in (0..=count).filter(|&i| closes(i) && i != close && i != close + 1) {
                let steps = self.steps(at, close);
                moves.push(Move { gone: vec![close], new: vec![(at, false)], cost: base + 2 * steps });
            }
            for at in (0..count).filter(|&i| opens(i) && i != open && i != open + 1) {
                let steps = self.steps(at, open);
                moves.push(Move { gone: vec![open], new: vec![(at, true)], cost: base + 2 * steps });
            }
            moves.push(Move { gone: vec![open, close], new: vec![], cost: 30 });
        }
        for from in (0..count).filter(|&i| opens(i)) {
            for to in (from + 2..=count).filter(|&i| closes(i)) {
                moves.push(Move { gone: vec![], new: vec![(from, true), (to, false)], cost: 34 });
            }
        }
        for Move { gone, new, cost } in moves {
            if !work.spend(1 + count as u64 / 2) {
                return;
            }
            if self.value(&gone, &new) == Some(self.wanted)
                && let Some(edit) = self.edit(&gone, &new)
            {
                self.hits.push(Hit { cost, slips: vec![Slip::Bracket], edits: vec![edit] });
            }
        }
    }

    /// The marks of each pair of brackets.
    fn pairs(&self) -> Vec<(usize, usize)> {
        let (mut open, mut pairs) = (vec![], vec![]);
        for (i, m) in self.marks.iter().enumerate() {
            match m.mark {
                Mark::Open => open.push(i),
                Mark::Close => pairs.extend(open.pop().map(|o| (o, i))),
                Mark::Plus | Mark::Minus | Mark::Over | Mark::Value(_) => {}
            }
        }
        pairs
    }

    /// How many factors lie between two places.
    fn steps(&self, a: usize, b: usize) -> u32 {
        let between = &self.marks[a.min(b)..a.max(b)];
        between.iter().filter(|m| matches!(m.mark, Mark::Value(_))).count().min(10) as u32
    }

    /// The value with brackets left out and put in.
    fn value(&self, gone: &[usize], new: &[(usize, bool)]) -> Option<Value> {
        let mut marks: Vec<&Mark> = Vec::with_capacity(self.marks.len() + 2);
        for i in 0..=self.marks.len() {
            // Closing brackets come before opening ones.
            marks.extend(new.iter().filter(|n| n.0 == i && !n.1).map(|_| &Mark::Close));
            marks.extend(new.iter().filter(|n| n.0 == i && n.1).map(|_| &Mark::Open));
            if let Some(m) = self.marks.get(i).filter(|_| !gone.contains(&i)) {
                marks.push(&m.mark);
            }
        }
        let mut reader = Reader { marks: &marks, at: 0 };
        let value = reader.sum()?;
        (reader.at == marks.len()).then_some(value)
    }

    fn edit(&self, gone: &[usize], new: &[(usize, bool)]) -> Option<Edit> {
        let mut patches = vec![];
        let mut texts = ["(".to_string(), ")".to_string()];
        for &i in gone {
            let m = &self.marks[i];
            texts[usize::from(matches!(m.mark, Mark::Close))] = self.text.get(m.start..m.end)?.to_string();
            patches.push(Patch { span: m.start..m.end, now: String::new() });
        }
        for &(i, is_open) in new {
            let at = if is_open { self.marks.get(i)?.start } else { self.marks.get(i.checked_sub(1)?)?.end };
            patches.push(Patch { span: at..at, now: texts[usize::from(!is_open)].clone() });
        }
        Some(Edit::Brackets(patches))
    }
}

/// Reads marks as a formula; the depth is at most that of the printed formula and one more.
struct Reader<'a> {
    marks: &'a [&'a Mark],
    at: usize,
}

impl Reader<'_> {
    fn sum(&mut self) -> Option<Value> {
        let mut sum = ZERO;
        let mut is_minus = self.sign().unwrap_or(false);
        loop {
            let term = self.product()?;
            sum = if is_minus { field::difference(&sum, &term) } else { field::sum(&sum, &term) };
            match self.sign() {
                Some(minus) => is_minus = minus,
                None => return Some(sum),
            }
        }
    }

    fn sign(&mut self) -> Option<bool> {
        let is_minus = match self.marks.get(self.at)? {
            Mark::Plus => false,
            Mark::Minus => true,
            Mark::Open | Mark::Close | Mark::Over | Mark::Value(_) => return None,
        };
        self.at += 1;
        Some(is_minus)
    }

    fn product(&mut self) -> Option<Value> {
        let mut product = ONE;
        let mut count = 0;
        loop {
            let is_under = matches!(self.marks.get(self.at), Some(Mark::Over));
            self.at += usize::from(is_under);
            let factor = match self.marks.get(self.at) {
                Some(Mark::Value(x)) => {
                    self.at += 1;
                    *x
                }
                Some(Mark::Open) => {
                    self.at += 1;
                    let inner = self.sum()?;
                    if !matches!(self.marks.get(self.at), Some(Mark::Close)) {
                        return None;
                    }
                    self.at += 1;
                    inner
                }
                _ if is_under || count == 0 => return None,
                _ => return Some(product),
            };
            product = field::product(&product, &if is_under { field::reciprocal(&factor)? } else { factor });
            count += 1;
        }
    }
}
