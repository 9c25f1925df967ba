//! The sides of statements: their parts, chains that go on, and chains that are several statements.

use super::lexer::{Kind, lex};
use super::statements::Reader;
use super::tree::{Node, NodeKind};
use super::{Fence, Grid, Part, Side, Statement, cut, words};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::ops::Range;

impl Reader<'_> {
    /// `A = [..] B = [..]`: the index of the side with `B` behind the matrix, if `B` was not stated before to be
    /// something else.
    pub(super) fn new_name(&self, statement: &Statement) -> Option<usize> {
        let sides = &statement.sides;
        (1..sides.len().saturating_sub(1)).find(|&i| {
            let (Some(side), Some(next)) = (sides.get(i), sides.get(i + 1)) else { return false };
            let [.., Part::Matrix(_), Part::Text(name)] = side.parts.as_slice() else { return false };
            let [Part::Matrix(_), ..] = next.parts.as_slice() else { return false };
            if !words::is_one_name(self.text, name) {
                return false;
            }
            let before = self.stated.get(&words::bare(self.text, name));
            before.is_none_or(|b| b.contains(&self.value_of(next)))
        })
    }

    /// The text of a side's matrices up to a name behind them, without blanks and braces, as a number to compare.
    fn value_of(&self, side: &Side) -> u64 {
        let mut hasher = DefaultHasher::new();
        for part in side.parts.iter().take_while(|p| matches!(p, Part::Matrix(_))) {
            let shown = cut(self.text, part.span()).replace("\\mathsf", "").replace("\\mathbf", "");
            shown
                .chars()
                .filter(|c| !c.is_whitespace() && !matches!(c, '{' | '}'))
                .for_each(|c| c.hash(&mut hasher));
        }
        hasher.finish()
    }

    pub(super) fn remember(&mut self, statement: &Statement) {
        if let [Side { parts, .. }, values @ ..] = statement.sides.as_slice()
            && let [Part::Text(name)] = parts.as_slice()
            && name.len() < 60
        {
            let values: Vec<u64> =
                values.iter().filter(|v| v.has_matrix()).map(|v| self.value_of(v)).collect();
            if !values.is_empty() {
                self.stated.entry(words::bare(self.text, name)).or_default().extend(values);
            }
        }
    }
}

impl Statement {
    /// Cuts the text at the end of side `at` off, as the first side of a statement.
    pub(super) fn cut_off(&mut self, at: usize) -> Statement {
        let mut rest = self.clone();
        let name = match self.sides.get_mut(at) {
            Some(side) => side.parts.pop(),
            None => None,
        };
        self.sides.truncate(at + 1);
        self.relations.truncate(at);
        let end = self.sides.last().and_then(|s| s.parts.last()).map_or(self.span.end, |p| p.span().end);
        if let Some(side) = self.sides.last_mut() {
            side.span.end = end;
        }
        self.span.end = end;
        rest.sides.drain(..=at);
        rest.relations.drain(..at);
        if let Some(name) = name {
            rest.span.start = name.span().start;
            rest.sides.insert(0, Side { span: name.span().clone(), parts: vec![name] });
        }
        (rest.label, rest.link) = (None, None);
        (self.juxtaposed, rest.juxtaposed) = (true, true);
        self.aside = None;
        rest
    }
}

impl Side {
    pub(super) fn has_matrix(&self) -> bool {
        self.parts.iter().any(|p| matches!(p, Part::Matrix(g) if g.fence != Fence::None))
    }

    /// Adds parts; text that only marks stand between is one text.
    pub(super) fn append(&mut self, text: &str, other: Side) {
        if self.parts.is_empty() {
            *self = other;
            return;
        }
        for part in other.parts {
            match (self.parts.last_mut(), part) {
                (Some(Part::Text(a)), Part::Text(b)) if only_marks(text, a.end..b.start) => a.end = b.end,
                (_, part) => self.parts.push(part),
            }
        }
        self.span.end = self.parts.last().map_or(self.span.end, |p| p.span().end);
    }

    pub(super) fn add(&mut self, nodes: &[Node]) {
        for node in nodes {
            match &node.kind {
                NodeKind::Grid(grid) => self.parts.push(Part::Matrix(Grid::clone(grid))),
                NodeKind::Group { inner, open, close, .. } if has_grid(inner) => {
                    self.add_text(node.span.start..*open);
                    self.add(inner);
                    self.add_text(*close..node.span.end);
                }
                NodeKind::Token(Kind::Amp | Kind::Quad | Kind::Row) => {}
                _ => self.add_text(node.span.clone()),
            }
        }
    }

    fn add_text(&mut self, span: Range<usize>) {
        match self.parts.last_mut() {
            // What is drawn over several lines is not in the order of the text.
            Some(Part::Text(text)) if text.end <= span.start => text.end = span.end,
            _ => self.parts.push(Part::Text(span)),
        }
    }
}

impl Part {
    /// Its place.
    pub fn span(&self) -> &Range<usize> {
        match self {
            Part::Text(span) => span,
            Part::Matrix(grid) => &grid.span,
        }
    }
}

fn has_grid(nodes: &[Node]) -> bool {
    nodes.iter().any(|n| match &n.kind {
        NodeKind::Grid(_) => true,
        NodeKind::Group { inner, .. } => has_grid(inner),
        _ => false,
    })
}

/// Whether [`super::formula`] makes blanks of all that stands in `span`.
fn only_marks(text: &str, span: Range<usize>) -> bool {
    span.start <= span.end
        && lex(text, &span).iter().all(|t| matches!(t.kind, Kind::Amp | Kind::Row | Kind::Quad))
}

/// Whether only what may end a formula stands in `span`.
pub(super) fn only_stops(text: &str, span: Range<usize>) -> bool {
    lex(text, &span).iter().all(|t| match t.kind {
        Kind::Amp | Kind::Row | Kind::Quad | Kind::Comma | Kind::Semicolon => true,
        Kind::Operator => cut(text, &t.span) == ".",
        _ => false,
    })
}
