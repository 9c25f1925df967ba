//! Nodes cut into statements: rows, parts of lines, chains, and lines that go on with the one before.

use super::chain::only_stops;
use super::lexer::{Gap, Kind, Relation, lex};
use super::tree::{Node, NodeKind, build, has_relation};
use super::{
    CodeBlock, Document, Format, MAX_FORMULA, MAX_NOTES, MAX_STATEMENTS, Note, Part, Place, Side, Statement,
};
use super::{cut, marks, words};
use std::collections::HashMap;
use std::ops::Range;

/// The most sides of a chain over several formulas.
const LONGEST_CHAIN: usize = 1000;

/// A document being read.
pub(super) struct Reader<'t> {
    pub text: &'t str,
    pub heading: Option<Range<usize>>,
    pub prose: Option<Range<usize>>,
    /// For the next statement.
    pub label: Option<Range<usize>>,
    /// Fences that are read, where `#` is no heading.
    pub fences: Vec<Range<usize>>,
    pub code: Vec<CodeBlock>,
    pub statements: Vec<Statement>,
    pub notes: Vec<Note>,
    /// The names that stood alone on a left side, and the right sides that they had.
    pub stated: HashMap<String, Vec<u64>>,
}

/// How a region is read.
#[derive(Clone, Copy)]
pub(super) struct Manner {
    pub place: Place,
    /// Every line is a statement of its own; `[…]` has its rows on lines.
    pub lines: bool,
    /// Left sides may be sums. Of importance for lines only.
    pub sums: bool,
}

/// Where the splitter is.
#[derive(Clone, Default)]
struct Course {
    /// Statements of the row before may go on.
    before: bool,
    /// The row before ended in an operator or a relation.
    open: bool,
    link: Option<Range<usize>>,
}

impl<'t> Reader<'t> {
    pub fn new(text: &'t str) -> Self {
        Reader {
            text,
            heading: None,
            prose: None,
            label: None,
            fences: vec![],
            code: vec![],
            statements: vec![],
            notes: vec![],
            stated: HashMap::new(),
        }
    }

    /// Whether the last statement waits for its last side, and `at` follows at once.
    pub fn waits(&self, at: usize) -> bool {
        self.pending(&(at..at))
    }

    pub fn full(&self) -> bool {
        self.statements.len() >= MAX_STATEMENTS
    }

    pub fn note(&mut self, span: Range<usize>, message: impl Into<String>, hint: impl Into<String>) {
        if self.notes.len() < MAX_NOTES {
            self.notes.push(Note { span, message: message.into(), hint: hint.into() });
        }
    }

    /// Sorts out directives, finishes statements that were left open.
    pub fn finish(mut self, format: Format) -> Document {
        for i in 0..self.statements.len() {
            self.end_statement(i);
        }
        self.statements.retain(|s| s.sides.len() > 1 || s.sides.iter().any(|side| side.has_matrix()));
        self.statements.sort_by_key(|s| s.span.start);
        if self.full() {
            let end = self.statements.last().map_or(0, |s| s.span.end);
            let hint = "divide the document";
            self.note(end..end, format!("only the first {MAX_STATEMENTS} statements are read"), hint);
        }
        self.notes.sort_by_key(|n| n.span.start);
        let directives = marks::directives(self.text, format, &self.fences, &self.code);
        let rest = marks::assign(self.text, directives, &mut self.statements, &mut self.code);
        Document { statements: self.statements, code: self.code, directives: rest, notes: self.notes }
    }

    /// A side behind the last `=` that never came.
    fn end_statement(&mut self, i: usize) {
        let Some(statement) = self.statements.get_mut(i) else { return };
        if statement.sides.last().is_some_and(|s| s.parts.is_empty()) {
            statement.sides.pop();
            statement.relations.pop();
            let end = statement.sides.last().map_or(statement.span.end, |s| s.span.end);
            statement.span.end = end;
            self.note(end..end, "nothing stands behind the `=`", "write the other side in the same formula");
        }
    }

    /// Reads the formulas of `span`. Whether there was a statement.
    pub fn region(&mut self, span: Range<usize>, manner: Manner) -> bool {
        if span.len() > MAX_FORMULA {
            let hint = "divide it into statements of their own";
            self.note(span.start..span.start, format!("a formula of {} bytes is not read", span.len()), hint);
            return false;
        }
        let text = self.text;
        let tree = build(text, lex(text, &span), manner.lines);
        self.nodes(&tree.nodes, tree.notes, &tree.broken, manner)
    }

    /// Reads the formulas of nodes that were put together.
    pub fn nodes(&mut self, nodes: &[Node], notes: Vec<Note>, broken: &[usize], manner: Manner) -> bool {
        let count = self.statements.len();
        let last = self.statements.last().map(|s| s.span.end);
        let mut course = Course::default();
        self.rows(nodes, manner, &mut course);
        // What contains an environment that is not closed cannot be read.
        let hit = |s: &Statement| broken.iter().any(|b| s.span.contains(b));
        let kept: Vec<Statement> = self.statements.split_off(count).into_iter().filter(|s| !hit(s)).collect();
        self.statements.extend(kept);
        let found = self.statements.len() > count || self.statements.last().map(|s| s.span.end) != last;
        if found || has_relation(nodes) {
            for note in notes {
                self.note(note.span, note.message, note.hint);
            }
        }
        found
    }

    /// Nodes cut at `\\`, and at the ends of lines where these count.
    fn rows(&mut self, nodes: &[Node], manner: Manner, course: &mut Course) {
        let mut first = 0;
        let mut related = false;
        for (i, node) in nodes.iter().enumerate() {
            let row = node.is(Kind::Row);
            let system = matches!(node.kind, NodeKind::System(_));
            let line = node.gap == Gap::Line && i > first && self.new_line(nodes, related, i, manner);
            if row || system || line {
                self.row(nodes.get(first..i).unwrap_or(&[]), manner, course);
                first = if line && !row && !system { i } else { i + 1 };
                related = false;
            }
            related |= node.relation().is_some();
            if let NodeKind::System(inner) = &node.kind {
                // A name before the brace (`U_0 \left\{ …`) is no statement, but `= \begin{split}` goes on.
                let inner_manner = Manner { lines: false, ..manner };
                self.rows(inner, inner_manner, course);
            }
        }
        self.row(nodes.get(first..).unwrap_or(&[]), manner, course);
    }

    /// Whether the line that begins with node `i` begins a row.
    fn new_line(&self, nodes: &[Node], related_before: bool, i: usize, manner: Manner) -> bool {
        let (Some(node), Some(before)) = (nodes.get(i), i.checked_sub(1).and_then(|i| nodes.get(i))) else {
            return false;
        };
        let goes_on =
            matches!(before.token(), Some(Kind::Operator | Kind::Relation(_) | Kind::Dots | Kind::Script))
                && cut(self.text, &before.span) != ".";
        let relation = node.relation().is_some();
        if goes_on || relation {
            return false;
        }
        let line = nodes.get(i..).unwrap_or(&[]);
        let length = line.iter().skip(1).position(|n| n.gap == Gap::Line).map_or(line.len(), |n| n + 1);
        let line = line.get(..length).unwrap_or(line);
        let related = line.iter().any(|n| n.relation().is_some());
        if node.is(Kind::Operator) {
            return related && matches!(cut(self.text, &node.span), "-" | "−");
        }
        manner.lines || (related && related_before && self.begins_statement(line))
    }

    /// Whether the nodes begin with a name and a relation.
    fn begins_statement(&self, nodes: &[Node]) -> bool {
        let nodes = nodes.iter().skip_while(|n| n.is(Kind::Amp) || n.is(Kind::Prose)).take(200);
        let mut named = false;
        for node in nodes {
            match &node.kind {
                NodeKind::Token(Kind::Relation(_)) => return named,
                NodeKind::Token(Kind::Word | Kind::Command) | NodeKind::Grid(_) => named = true,
                NodeKind::Token(Kind::Script | Kind::Amp | Kind::Mark | Kind::Dots)
                | NodeKind::Group { .. } => {}
                NodeKind::Token(Kind::Operator)
                    if named || matches!(cut(self.text, &node.span), "-" | "\\pm") => {}
                _ => return false,
            }
        }
        false
    }

    /// A row cut at `;`, arrows, words, and at commas and spaces before the next statement.
    fn row(&mut self, nodes: &[Node], manner: Manner, course: &mut Course) {
        if nodes.is_empty() || self.full() {
            return;
        }
        let mut first = 0;
        let (mut parted, mut related) = (false, false);
        for (i, node) in nodes.iter().enumerate() {
            let shown = cut(self.text, &node.span);
            let next = nodes.get(i + 1..).unwrap_or(&[]);
            // `with L_1 = 0.45 m` may begin a line.
            let apart = node.gap > Gap::None || i == 0 && next.first().is_some_and(|n| n.gap > Gap::None);
            let joins = || related && i > 0 && self.joins(&nodes[..=i], next);
            let word = node.is(Kind::Word) && apart && (words::is_link(&shown.to_lowercase()) || joins());
            let hard = match node.token() {
                Some(Kind::Semicolon | Kind::Arrow) => true,
                // `θ1 = 20°: cos θ5 = 0.5`
                Some(Kind::Colon) => related && self.begins_statement(next),
                // `θ2 = 90°. x = 220 mm`
                Some(Kind::Operator) if shown == "." => {
                    let is_end = node.gap == Gap::None && next.first().is_some_and(|n| n.gap > Gap::None);
                    related && is_end && self.begins_statement(next)
                }
                Some(Kind::Prose) if related && words::is_condition(prose_of(shown)) => false,
                Some(Kind::Prose) => {
                    i == first || self.begins_statement(next) || words::is_link(prose_of(shown))
                }
                _ => word && self.begins_statement(next),
            };
            if hard {
                self.segment(nodes.get(first..i).unwrap_or(&[]), manner, course);
                if !node.is(Kind::Semicolon) {
                    course.link = Some(node.span.clone());
                }
                (first, parted, related) = (i + 1, false, false);
                continue;
            }
            if matches!(node.token(), Some(Kind::Comma | Kind::Quad)) {
                parted = true;
                continue;
            }
            // `px = 0.175 m    py = 0.303 m`
            parted |= node.gap == Gap::Wide && related && manner.place == Place::Line;
            if parted && related && !node.is(Kind::Amp) {
                if self.begins_statement(nodes.get(i..).unwrap_or(&[])) {
                    self.segment(nodes.get(first..i).unwrap_or(&[]), manner, course);
                    (first, related) = (i, false);
                }
                parted = false;
            }
            related |= node.relation().is_some();
        }
        self.segment(nodes.get(first..).unwrap_or(&[]), manner, course);
    }

    /// True for a letter behind a number or a unit that joins two formulas in some language: `x = 0.5 m e y = 0.2 m`.
    fn joins(&self, nodes: &[Node], next: &[Node]) -> bool {
        let [.., before, node] = nodes else { return false };
        let shown = cut(self.text, &before.span);
        let is_value = words::is_unit(shown) || shown.ends_with(|c: char| c.is_ascii_digit());
        let is_name =
            matches!(next, [name, relation, ..] if name.is(Kind::Word) && relation.relation().is_some());
        is_value && is_name && matches!(cut(self.text, &node.span), "y" | "e" | "o" | "u" | "i" | "и")
    }

    /// The nodes behind `i.e.` or `d.h.` that they begin with.
    fn without_that_is<'n>(&self, nodes: &'n [Node]) -> &'n [Node] {
        let shown = |k: usize| nodes.get(k).map_or("", |n| cut(self.text, &n.span));
        let letters = [shown(0), shown(2)].map(str::to_lowercase);
        let is_it = matches!([&*letters[0], &*letters[1]], ["i", "e"] | ["d", "h"] | ["z", "b"] | ["e", "g"]);
        if is_it && shown(1) == "." && shown(3) == "." { nodes.get(4..).unwrap_or(nodes) } else { nodes }
    }

    /// One statement, or a piece of one.
    fn segment(&mut self, nodes: &[Node], manner: Manner, course: &mut Course) {
        let link = course.link.take();
        let amp = nodes.first().is_some_and(|n| n.is(Kind::Amp));
        let nodes = self.without_that_is(trim(self.text, nodes));
        let (nodes, aside) = self.without_aside(nodes);
        let (label, nodes) = self.split_label(nodes);
        let (Some(first), Some(last)) = (nodes.first(), nodes.last()) else { return };
        let ends = nodes.iter().map(|n| n.span.end).max().unwrap_or(last.span.end);
        let span = nodes.iter().map(|n| n.span.start).min().unwrap_or(first.span.start)..ends;
        let related = has_relation(nodes);
        if first.is(Kind::Prose) && !related {
            return;
        }
        if nodes.iter().any(|n| n.is(Kind::Other)) {
            // `-π < q < π` states no equation; behind an equation it is a condition.
            if !related
                && course.before
                && let Some(statement) = self.statements.last_mut()
            {
                statement.aside.get_or_insert(span);
            }
            return;
        }
        let (sides, relations) = self.sides_of(nodes);
        let begins_related = first.relation().is_some();
        let operator = first.is(Kind::Operator);
        // `90^\circ` ends in a script, not in an operator.
        let is_script =
            nodes.len().checked_sub(2).and_then(|k| nodes.get(k)).is_some_and(|n| n.is(Kind::Script));
        let open = last.relation().is_some() || last.is(Kind::Operator) && !is_script;
        let sign = matches!(cut(self.text, &first.span), "-" | "−" | "±" | "\\pm" | "+");
        let prose = first.is(Kind::Prose);
        let goes_on = course.before
            && (course.open
                || begins_related
                || (operator && (!related || !sign || amp))
                || (amp && !related && !prose));
        let pending = self.pending(&span);
        if (goes_on || pending) || (begins_related && self.follows(&span)) {
            self.continue_last(sides, relations, span, aside);
            (course.before, course.open) = (true, open);
            return;
        }
        if manner.place == Place::Line || manner.place == Place::Code {
            let left = sides.first().map_or(0..0, |s| s.span.clone());
            let shaped = begins_related || words::is_left_side(self.text, &left, manner.sums);
            let drawn = sides.first().is_some_and(Side::has_matrix);
            if !(shaped || drawn) || words::is_prose(self.text, &span) || (!related && !drawn) {
                let waits = !(related || course.before || manner.place == Place::Code);
                if waits && !words::is_prose(self.text, &span) {
                    // `( … )` with `= …` on the next line.
                    self.push(sides, relations, span, manner, Extra { label, link, aside });
                    (course.before, course.open) = (true, open);
                } else {
                    course.before = false;
                }
                return;
            }
        }
        if begins_related {
            let Some(label) = label.clone().or_else(|| self.label.clone()) else {
                self.note(span, "the `=` follows no other side", "write both sides in one formula");
                return;
            };
            let mut sides = sides;
            if let Some(first) = sides.first_mut() {
                *first = Side { span: label.clone(), parts: vec![Part::Text(label.clone())] };
            }
            self.push(
                sides,
                relations,
                label.start..span.end,
                manner,
                Extra { label: Some(label), link, aside },
            );
            (course.before, course.open) = (true, open);
            return;
        }
        // Without a relation it may still be the first line of a chain.
        if related || !matches!(manner.place, Place::Inline | Place::Code) {
            self.push(sides, relations, span, manner, Extra { label, link, aside });
            (course.before, course.open) = (true, open);
        }
    }

    /// Whether the last statement waits for its last side, and `span` follows at once.
    fn pending(&self, span: &Range<usize>) -> bool {
        let empty = self.statements.last().and_then(|s| s.sides.last()).is_some_and(|s| s.parts.is_empty());
        empty && (self.follows(span) || self.begins_fence(span))
    }

    /// Whether only the first line of a fence stands between the last statement and `span`: `T =` above a matrix in one.
    fn begins_fence(&self, span: &Range<usize>) -> bool {
        self.statements.last().is_some_and(|s| {
            s.sides.len() < LONGEST_CHAIN && s.span.end <= span.start && span.start - s.span.end < 100 && {
                let gap = cut(self.text, &(s.span.end..span.start)).trim();
                matches!(gap, "```" | "```text" | "```txt" | "```math" | "~~~")
            }
        })
    }

    /// Whether only marks of formulas stand between the last statement and `span`.
    fn follows(&self, span: &Range<usize>) -> bool {
        self.statements.last().is_some_and(|s| {
            s.sides.len() < LONGEST_CHAIN && s.span.end <= span.start && span.start - s.span.end < 400 && {
                let gap = cut(self.text, &(s.span.end..span.start));
                !gap.contains(['#', '<'])
                    && !gap.contains("```")
                    && only_stops(self.text, s.span.end..span.start)
            }
        })
    }

    fn continue_last(
        &mut self,
        sides: Vec<Side>,
        relations: Vec<Relation>,
        span: Range<usize>,
        aside: Option<Range<usize>>,
    ) {
        let text = self.text;
        let Some(statement) = self.statements.last_mut() else { return };
        let mut sides = sides.into_iter();
        if let (Some(last), Some(first)) = (statement.sides.last_mut(), sides.next()) {
            last.append(text, first);
        }
        statement.sides.extend(sides);
        statement.relations.extend(relations);
        statement.span.end = statement.span.end.max(span.end);
        statement.aside = statement.aside.take().or(aside);
    }

    /// `\quad (0.5pt)`, `\text{if …}` at the end.
    fn without_aside<'n>(&self, nodes: &'n [Node]) -> (&'n [Node], Option<Range<usize>>) {
        let Some(related) = nodes.iter().position(|n| n.relation().is_some()) else { return (nodes, None) };
        let quad = nodes.iter().rposition(|n| n.is(Kind::Quad)).filter(|&i| i > related);
        let prose = nodes.iter().position(|n| n.is(Kind::Prose)).filter(|&i| i > related);
        let lone = |i: &usize| {
            matches!(nodes.get(i + 1..), Some([Node { kind: NodeKind::Group { bracket, .. }, .. }])
                if *bracket == super::lexer::Bracket::Round)
        };
        let number = nodes.len().checked_sub(1).filter(|&i| i > related + 1 && self.is_number(&nodes[i]));
        let remark = nodes.len().checked_sub(1).filter(|&i| i > related + 1 && self.is_remark(&nodes[i]));
        let Some(at) = prose.or(quad.filter(lone)).or(number).or(remark) else { return (nodes, None) };
        let kept = nodes.get(..at).unwrap_or(nodes);
        let aside = nodes.get(at..).unwrap_or(&[]);
        let aside = aside.iter().find(|n| !n.is(Kind::Quad)).zip(aside.last());
        (trim(self.text, kept), aside.map(|(a, b)| a.span.start..b.span.end))
    }

    /// `(elbow)`, or `correct` far behind: a word that is no name.
    fn is_remark(&self, node: &Node) -> bool {
        let shown = cut(self.text, &node.span);
        let inner = shown.strip_prefix('(').and_then(|s| s.strip_suffix(')')).map(str::trim);
        match inner {
            Some(inner) => node.gap > Gap::None && words::is_long_word(inner),
            None => node.gap == Gap::Wide && node.is(Kind::Word) && words::is_long_word(shown),
        }
    }

    /// `(3)`, set off from what is before it: the number of an equation.
    fn is_number(&self, node: &Node) -> bool {
        let is_set_off = node.gap == Gap::Wide;
        let inner = cut(self.text, &node.span).strip_prefix('(').and_then(|s| s.strip_suffix(')'));
        is_set_off && inner.is_some_and(|i| i.starts_with(|c: char| c.is_ascii_digit()) && i.len() <= 5)
    }

    /// `X_p : a = b`
    fn split_label<'n>(&self, nodes: &'n [Node]) -> (Option<Range<usize>>, &'n [Node]) {
        let related = nodes.iter().position(|n| n.relation().is_some()).unwrap_or(0);
        let colon = nodes.iter().take(related).position(|n| n.is(Kind::Colon));
        match colon.map(|at| nodes.split_at(at)) {
            Some(([first, .., last] | [first @ last], [_, rest @ ..])) => {
                (Some(first.span.start..last.span.end), trim(self.text, rest))
            }
            _ => (None, nodes),
        }
    }

    /// The sides of a chain.
    pub fn sides_of(&self, nodes: &[Node]) -> (Vec<Side>, Vec<Relation>) {
        let (mut sides, mut relations) = (vec![], vec![]);
        let mut first = 0;
        for (i, node) in nodes.iter().enumerate() {
            if let Some(relation) = node.relation() {
                sides.push(self.side(nodes.get(first..i).unwrap_or(&[]), node.span.start));
                relations.push(relation);
                first = i + 1;
            }
        }
        let end = nodes.last().map_or(0, |n| n.span.end);
        sides.push(self.side(nodes.get(first..).unwrap_or(&[]), end));
        (sides, relations)
    }

    fn side(&self, nodes: &[Node], end: usize) -> Side {
        let mut side = Side { span: end..end, parts: vec![] };
        side.add(trim(self.text, nodes));
        // `v = (0.1, 0.2) m/s`
        if let [.., Part::Matrix(_), Part::Text(unit)] = side.parts.as_slice()
            && words::is_unit_alone(cut(self.text, unit))
        {
            side.parts.pop();
        }
        if let (Some(first), Some(last)) = (side.parts.first(), side.parts.last()) {
            let ends = side.parts.iter().map(|p| p.span().end).max().unwrap_or(last.span().end);
            side.span = first.span().start.min(ends)..ends;
        }
        side
    }

    fn push(
        &mut self,
        sides: Vec<Side>,
        relations: Vec<Relation>,
        span: Range<usize>,
        manner: Manner,
        extra: Extra,
    ) {
        // A chain's first line, or a lone matrix, waits; what came of it shows in the end.
        let label = extra.label.or_else(|| self.label.take());
        let mut statement = Statement {
            span,
            sides,
            relations,
            directives: vec![],
            heading: self.heading.clone(),
            prose: self.prose.clone(),
            label,
            link: extra.link,
            aside: extra.aside,
            place: manner.place,
            juxtaposed: false,
        };
        while let Some(at) = self.new_name(&statement) {
            let rest = statement.cut_off(at);
            self.remember(&statement);
            self.statements.push(std::mem::replace(&mut statement, rest));
        }
        self.remember(&statement);
        self.statements.push(statement);
    }
}

struct Extra {
    label: Option<Range<usize>>,
    link: Option<Range<usize>>,
    aside: Option<Range<usize>>,
}

/// `if` of `\text{ if }`
fn prose_of(shown: &str) -> &str {
    shown.split_once('{').map_or("", |(_, inner)| inner.trim_end_matches('}').trim())
}

/// Without what only sets or ends a formula.
fn trim<'n>(text: &str, nodes: &'n [Node]) -> &'n [Node] {
    let idle = |n: &Node| {
        matches!(
            n.token(),
            Some(Kind::Amp | Kind::Quad | Kind::Comma | Kind::Semicolon | Kind::Row | Kind::Arrow)
        )
    };
    let stop = |n: &Node| idle(n) || n.is(Kind::Colon) || (n.is(Kind::Operator) && cut(text, &n.span) == ".");
    let Some(first) = nodes.iter().position(|n| !idle(n)) else { return &[] };
    let last = nodes.iter().rposition(|n| !stop(n)).unwrap_or(first);
    nodes.get(first..=last.max(first)).unwrap_or(&[])
}
