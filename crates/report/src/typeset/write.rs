//! The tree in MathML, with what is marked.

use super::Marks;
use super::read::{self, Kind, Node, Row};
use std::ops::Range;

/// The inside of a `math` element.
pub(super) fn formula(source: &str, all: &Row, marks: &Marks) -> Option<String> {
    let inside = |r: &Range<usize>| r.start <= r.end && r.end <= source.len();
    marks.classes.iter().map(|c| &c.0).chain(marks.changes.iter().map(|c| &c.0)).all(inside).then_some(())?;
    let changes: Vec<Change> = marks.changes.iter().map(|c| Change::of(source, c)).collect();
    Writer { source, marks }.row(all, &changes, None)
}

/// What should be something else.
#[derive(Clone, Debug)]
struct Change {
    /// Without the blanks around it.
    span: Range<usize>,
    now: String,
}

impl Change {
    fn of(source: &str, (span, now): &(Range<usize>, String)) -> Self {
        let text = source.get(span.clone()).unwrap_or_default();
        let start = span.start + (text.len() - text.trim_start().len());
        let span = start..start + text.trim().len();
        Change { span, now: now.clone() }
    }

    /// True if it lies within one part, and not at its edge.
    fn is_within(&self, node: &Node) -> bool {
        let (a, b) = (self.span.start, self.span.end);
        let Range { start, end } = node.span;
        match a == b {
            true => start < a && a < end,
            false => start <= a && b <= end && (start, end) != (a, b),
        }
    }

    fn fits(&self, row: &Row) -> bool {
        row.span.start <= self.span.start && self.span.end <= row.span.end
    }
}

struct Writer<'a> {
    source: &'a str,
    marks: &'a Marks,
}

impl Writer<'_> {
    /// Parts in a row, those of a class together but for the class that they stand in, those that should be others with what should
    /// stand there.
    fn row(&self, row: &Row, changes: &[Change], around: Option<&str>) -> Option<String> {
        let nodes = &row.nodes;
        let deeper = |c: &Change, n: &Node| c.is_within(n) && parts(&n.kind).iter().any(|r| c.fits(r));
        // Each change with the parts that it is about.
        let mut here: Vec<(Range<usize>, Vec<&Change>)> = vec![];
        for change in changes.iter().filter(|c| !nodes.iter().any(|n| deeper(c, n))) {
            let first = nodes.iter().take_while(|n| n.span.end <= change.span.start).count();
            let behind = nodes.iter().take_while(|n| n.span.start < change.span.end).count().max(first);
            match here.iter_mut().find(|(range, _)| range.start < behind && first < range.end) {
                Some((range, all)) => {
                    *range = range.start.min(first)..range.end.max(behind);
                    all.push(change);
                }
                None => here.push((first..behind, vec![change])),
            }
        }
        here.sort_by_key(|h| (h.0.start, h.0.end));
        let mut out = String::new();
        let mut open: Option<&str> = None;
        let mut k = 0;
        let mut here = here.into_iter().peekable();
        loop {
            let next = here.next_if(|h| h.0.start <= k);
            let class = nodes.get(k).and_then(|n| self.class(n)).filter(|c| Some(*c) != around);
            // What is added at the end of a marked part stands in it.
            let is_added = next.as_ref().is_some_and(|h| h.0.is_empty());
            if !is_added && class != open {
                out.push_str(if open.is_some() { "</mrow>" } else { "" });
                class.iter().for_each(|c| out.push_str(&format!("<mrow class=\"{c}\">")));
                open = class;
            }
            match next {
                Some((range, all)) => {
                    self.changed(nodes, range.clone(), &all, open.or(around), &mut out)?;
                    k = range.end.max(k);
                }
                None => match nodes.get(k) {
                    Some(node) => {
                        let own: Vec<Change> = changes.iter().filter(|c| deeper(c, node)).cloned().collect();
                        out.push_str(&self.node(node, &own, open.or(around))?);
                        k += 1;
                    }
                    None => break,
                },
            }
        }
        out.push_str(if open.is_some() { "</mrow>" } else { "" });
        Some(out)
    }

    /// Parts as deleted, and what should stand there.
    fn changed(
        &self,
        nodes: &[Node],
        range: Range<usize>,
        all: &[&Change],
        around: Option<&str>,
        out: &mut String,
    ) -> Option<()> {
        let was: Vec<String> =
            nodes[range.clone()].iter().map(|n| self.node(n, &[], around)).collect::<Option<_>>()?;
        if !was.is_empty() {
            out.push_str(&format!("<mrow class=\"del\">{}</mrow>", was.concat()));
        }
        let (mut at, end) = match &nodes[range] {
            [] => (all[0].span.start, all[0].span.end),
            [first, .., last] => (first.span.start, last.span.end),
            [one] => (one.span.start, one.span.end),
        };
        let mut now = String::new();
        for change in all {
            now += self.source.get(at..change.span.start)?;
            now += &change.now;
            at = change.span.end;
        }
        now += self.source.get(at..end)?;
        if !now.trim().is_empty() {
            let row = read::formula(&now)?;
            let set = Writer { source: &now, marks: &Marks::default() }.row(&row, &[], None)?;
            out.push_str(&format!("<mrow class=\"ins\">{set}</mrow>"));
        }
        Some(())
    }

    /// The class of a part that lies in one that is marked; a part that holds all of such a one passes it on.
    fn class(&self, node: &Node) -> Option<&'static str> {
        let holds = |r: &Range<usize>| r.start <= node.span.start && node.span.end <= r.end;
        self.marks.classes.iter().find(|c| holds(&c.0)).map(|c| c.1)
    }

    fn node(&self, node: &Node, changes: &[Change], around: Option<&str>) -> Option<String> {
        let row = |r: &Row| {
            let own: Vec<Change> = changes.iter().filter(|c| c.fits(r)).cloned().collect();
            self.row(r, &own, around)
        };
        let is_one = |r: &Row| r.nodes.len() == 1 && !changes.iter().any(|c| c.fits(r));
        // One element where MathML wants one.
        let one = |r: &Row| Some(if is_one(r) { row(r)? } else { format!("<mrow>{}</mrow>", row(r)?) });
        Some(match &node.kind {
            Kind::Leaf(text) => text.clone(),
            Kind::Group(r) => format!("<mrow>{}</mrow>", row(r)?),
            Kind::Fraction(above, below) => format!("<mfrac>{}{}</mfrac>", one(above)?, one(below)?),
            Kind::Root(inside, None) => format!("<msqrt>{}</msqrt>", row(inside)?),
            Kind::Root(inside, Some(degree)) => format!("<mroot>{}{}</mroot>", one(inside)?, one(degree)?),
            Kind::Scripts { base, sub, sup } => {
                let name = match (sub, sup) {
                    (Some(_), Some(_)) => "msubsup",
                    (Some(_), None) => "msub",
                    _ => "msup",
                };
                let scripts: Vec<String> =
                    [sub, sup].into_iter().flatten().map(&one).collect::<Option<_>>()?;
                format!("<{name}>{}{}</{name}>", one(base)?, scripts.concat())
            }
            Kind::Accent { base, sign, is_above } => {
                let name = if *is_above { "mover" } else { "munder" };
                format!("<{name} accent=\"true\">{}<mo>{sign}</mo></{name}>", one(base)?)
            }
            Kind::Styled(r, class) => format!("<mrow class=\"{class}\">{}</mrow>", row(r)?),
            Kind::Table { rows, open, close } => {
                let bracket =
                    |sign: &str| if sign.is_empty() { String::new() } else { format!("<mo>{sign}</mo>") };
                let table = table(rows, "", &|_, r| row(r))?;
                format!("<mrow>{}{table}{}</mrow>", bracket(open), bracket(close))
            }
            Kind::Lines(rows) => table(rows, " class=\"lines\"", &|k, r| {
                // The sign of equality keeps its space at the start of a cell.
                let text = row(r)?;
                let is_sign = k > 0 && text.starts_with("<mo>");
                Some(if is_sign { text.replacen("<mo>", "<mo form=\"infix\">", 1) } else { text })
            })?,
        })
    }
}

fn table(rows: &[Vec<Row>], more: &str, cell: &dyn Fn(usize, &Row) -> Option<String>) -> Option<String> {
    let mut out = format!("<mtable{more}>");
    for row in rows {
        out.push_str("<mtr>");
        for (k, r) in row.iter().enumerate() {
            out.push_str(&format!("<mtd>{}</mtd>", cell(k, r)?));
        }
        out.push_str("</mtr>");
    }
    Some(out + "</mtable>")
}

/// The rows of which a part is made.
fn parts(kind: &Kind) -> Vec<&Row> {
    match kind {
        Kind::Leaf(_) => vec![],
        Kind::Group(r) | Kind::Styled(r, _) | Kind::Accent { base: r, .. } => vec![r],
        Kind::Fraction(a, b) => vec![a, b],
        Kind::Root(a, b) => [Some(a), b.as_ref()].into_iter().flatten().collect(),
        Kind::Scripts { base, sub, sup } => {
            [Some(base), sub.as_ref(), sup.as_ref()].into_iter().flatten().collect()
        }
        Kind::Table { rows, .. } | Kind::Lines(rows) => rows.iter().flatten().collect(),
    }
}
