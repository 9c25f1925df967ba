//! Tokens put together: bracket by bracket, environment by environment, and the matrices among them.

use super::grid;
use super::lexer::{Bracket, Environment, Gap, Kind, Relation, Token};
use super::{Fence, Grid, Note, cut, words};
use std::ops::Range;

/// The deepest nesting that is read.
const DEEPEST: usize = 100;

#[derive(Clone, Debug)]
pub(super) struct Node {
    pub kind: NodeKind,
    pub span: Range<usize>,
    pub gap: Gap,
}

#[derive(Clone, Debug)]
pub(super) enum NodeKind {
    Token(Kind),
    /// What stands between two brackets, whose bytes are given.
    Group {
        bracket: Bracket,
        inner: Vec<Node>,
        open: usize,
        close: usize,
    },
    /// `array` or `cases`: a matrix, or rows that are statements.
    Array {
        environment: Environment,
        inner: Vec<Node>,
    },
    Grid(Box<Grid>),
    /// Rows that are statements.
    System(Vec<Node>),
}

impl Node {
    pub fn is(&self, kind: Kind) -> bool {
        matches!(&self.kind, NodeKind::Token(k) if *k == kind)
    }

    pub fn token(&self) -> Option<Kind> {
        match self.kind {
            NodeKind::Token(kind) => Some(kind),
            _ => None,
        }
    }

    pub fn relation(&self) -> Option<Relation> {
        match self.kind {
            NodeKind::Token(Kind::Relation(relation)) => Some(relation),
            _ => None,
        }
    }
}

/// What was put together, and what could not be.
pub(super) struct Tree {
    pub nodes: Vec<Node>,
    pub notes: Vec<Note>,
    /// Where an environment or `\left` was opened that is not closed: what contains this cannot be read.
    pub broken: Vec<usize>,
}

struct Frame {
    open: Token,
    nodes: Vec<Node>,
}

/// Puts the tokens together. With `lines`, a new line in `[…]` begins a new row.
pub(super) fn build(text: &str, tokens: Vec<Token>, lines: bool) -> Tree {
    let mut builder = Builder {
        text,
        lines,
        frames: vec![],
        top: vec![],
        notes: vec![],
        broken: vec![],
        too_deep: None,
        skipped: 0,
    };
    for token in tokens {
        builder.token(token);
    }
    while let Some(frame) = builder.frames.pop() {
        builder.unclosed(frame);
    }
    let mut nodes = std::mem::take(&mut builder.top);
    builder.settle(&mut nodes, true);
    if let Some(span) = builder.too_deep.take() {
        let hint = format!("at most {DEEPEST} brackets may stand in one another");
        builder.notes.push(Note { span, message: "the brackets are nested too deeply".into(), hint });
    }
    Tree { nodes, notes: builder.notes, broken: builder.broken }
}

struct Builder<'t> {
    text: &'t str,
    lines: bool,
    frames: Vec<Frame>,
    top: Vec<Node>,
    notes: Vec<Note>,
    broken: Vec<usize>,
    /// Where the nesting first was too deep, and how many brackets stand open beyond that.
    too_deep: Option<Range<usize>>,
    skipped: usize,
}

impl Builder<'_> {
    fn level(&mut self) -> &mut Vec<Node> {
        match self.frames.last_mut() {
            Some(frame) => &mut frame.nodes,
            None => &mut self.top,
        }
    }

    fn plain(&mut self, token: Token, kind: Kind) {
        self.level().push(Node { kind: NodeKind::Token(kind), span: token.span, gap: token.gap });
    }

    fn note(&mut self, span: &Range<usize>, message: String, hint: &str) {
        if self.notes.len() < 20 {
            self.notes.push(Note { span: span.clone(), message, hint: hint.into() });
        }
    }

    fn token(&mut self, token: Token) {
        match token.kind {
            Kind::Open(_) | Kind::Begin(_) => {
                if self.frames.len() < DEEPEST {
                    self.frames.push(Frame { open: token, nodes: vec![] });
                    return;
                }
                if self.too_deep.is_none() {
                    self.broken.push(token.span.start);
                    self.too_deep = Some(token.span.clone());
                }
                self.skipped += 1;
                self.plain(token, Kind::Mark);
            }
            Kind::Close(_) | Kind::End => {
                if self.skipped > 0 {
                    self.skipped -= 1;
                    return self.plain(token, Kind::Mark);
                }
                let Some(matching) = self.matching(token.kind) else {
                    let mark = cut(self.text, &token.span).to_string();
                    self.note(
                        &token.span,
                        format!("`{mark}` closes nothing"),
                        "remove it, or open it before",
                    );
                    return self.plain(token, Kind::Mark);
                };
                while self.frames.len() > matching + 1 {
                    if let Some(frame) = self.frames.pop() {
                        self.unclosed(frame);
                    }
                }
                if let Some(frame) = self.frames.pop() {
                    let node = self.close(frame, &token);
                    self.level().push(node);
                }
            }
            kind => self.plain(token, kind),
        }
    }

    /// The index of the frame that `close` closes.
    fn matching(&self, close: Kind) -> Option<usize> {
        for (i, frame) in self.frames.iter().enumerate().rev() {
            let matches = match (frame.open.kind, close) {
                (Kind::Open(Bracket::Left(_)), Kind::Close(Bracket::Right(_))) => true,
                (Kind::Open(a), Kind::Close(b)) => a == b,
                (Kind::Begin(_), Kind::End) => true,
                _ => false,
            };
            if matches {
                return Some(i);
            }
            let wall = match close {
                Kind::End => false,
                Kind::Close(Bracket::Brace | Bracket::Right(_)) => matches!(frame.open.kind, Kind::Begin(_)),
                _ => matches!(
                    frame.open.kind,
                    Kind::Begin(_) | Kind::Open(Bracket::Left(_)) | Kind::Open(Bracket::Brace)
                ),
            };
            if wall {
                return None;
            }
        }
        None
    }

    /// An opening without its end is a mark like others.
    fn unclosed(&mut self, frame: Frame) {
        let Frame { open, nodes } = frame;
        let mark = cut(self.text, &open.span).to_string();
        self.note(&open.span, format!("`{mark}` is not closed"), "close it in the same formula");
        if matches!(open.kind, Kind::Begin(_) | Kind::Open(Bracket::Left(_))) {
            self.broken.push(open.span.start);
        }
        self.plain(open, Kind::Mark);
        self.level().extend(nodes);
    }

    fn close(&mut self, frame: Frame, close: &Token) -> Node {
        let Frame { open, mut nodes } = frame;
        let span = open.span.start..close.span.end;
        let gap = open.gap;
        let make = |kind| Node { kind, span: span.clone(), gap };
        match open.kind {
            Kind::Begin(Environment::Matrix(bars)) => {
                self.settle(&mut nodes, false);
                let rows = grid::ruled_rows(self.text, &nodes, close.span.start);
                make(NodeKind::Grid(Box::new(Grid::new(span.clone(), fence(bars), rows))))
            }
            Kind::Begin(environment @ (Environment::Array | Environment::Cases)) => {
                make(NodeKind::Array { environment, inner: nodes })
            }
            Kind::Begin(Environment::Display) => {
                self.settle(&mut nodes, true);
                make(NodeKind::System(nodes))
            }
            Kind::Open(bracket) => {
                let (opened, closed) = (open.span.end, close.span.start);
                if let [node] = nodes.as_slice()
                    && bracket == Bracket::Brace
                    && let Some(relation) = node.relation()
                {
                    return make(NodeKind::Token(Kind::Relation(relation)));
                }
                if let Some(kind) = self.fenced(bracket, &mut nodes, &span) {
                    return make(kind);
                }
                self.settle(&mut nodes, false);
                let attached = gap == Gap::None && self.level().last().is_some_and(is_attachable);
                let square = matches!(bracket, Bracket::Square | Bracket::Left('['));
                let rows = match square && !attached {
                    true => grid::certain_rows(self.text, &nodes, closed, self.lines),
                    false if bracket == Bracket::Brace => grid::nested_rows(self.text, &nodes, bracket),
                    false => None,
                };
                if let Some(rows) = rows {
                    let fence = if square { Fence::Square } else { Fence::Braces };
                    return make(NodeKind::Grid(Box::new(Grid::new(span.clone(), fence, rows))));
                }
                make(NodeKind::Group { bracket, inner: nodes, open: opened, close: closed })
            }
            _ => make(NodeKind::Token(Kind::Mark)),
        }
    }

    /// A bracket around nothing but an array.
    fn fenced(&mut self, bracket: Bracket, nodes: &mut Vec<Node>, span: &Range<usize>) -> Option<NodeKind> {
        let mark = match bracket {
            Bracket::Round => '(',
            Bracket::Square => '[',
            Bracket::Curly => '{',
            Bracket::Left(mark) => mark,
            _ => return None,
        };
        let node = match nodes.as_mut_slice() {
            [node] => node,
            _ => return None,
        };
        match &mut node.kind {
            NodeKind::Array { inner, .. } if matches!(mark, '{' | '.') && has_relation(inner) => {
                let mut inner = std::mem::take(inner);
                self.settle(&mut inner, true);
                Some(NodeKind::System(inner))
            }
            NodeKind::Array { inner, .. } => {
                let mut inner = std::mem::take(inner);
                self.settle(&mut inner, false);
                let rows = grid::ruled_rows(self.text, &inner, node.span.end);
                Some(NodeKind::Grid(Box::new(Grid::new(span.clone(), fence(mark), rows))))
            }
            NodeKind::Grid(grid) if grid.fence == Fence::None => {
                let mut grid = grid.clone();
                (grid.span, grid.fence) = (span.clone(), fence(mark));
                Some(NodeKind::Grid(grid))
            }
            // `\left\{ \begin{split} … \end{split} \right.`
            NodeKind::System(inner) if matches!(mark, '{' | '.') => {
                Some(NodeKind::System(std::mem::take(inner)))
            }
            _ => None,
        }
    }

    /// Decides what only its neighbours tell: arrays without a fence, rows in brackets, names under matrices.
    /// With `sides`, the nodes are sides of statements, where `[a b c]` is a row.
    fn settle(&mut self, nodes: &mut Vec<Node>, sides: bool) {
        for node in nodes.iter_mut() {
            if let NodeKind::Array { environment, inner } = &mut node.kind {
                let mut inner = std::mem::take(inner);
                let system = has_relation(&inner);
                let fence = if *environment == Environment::Cases { Fence::Braces } else { Fence::None };
                self.settle(&mut inner, system);
                node.kind = match system {
                    true => NodeKind::System(inner),
                    false => {
                        let rows = grid::ruled_rows(self.text, &inner, node.span.end);
                        NodeKind::Grid(Box::new(Grid::new(node.span.clone(), fence, rows)))
                    }
                };
            }
        }
        if sides {
            self.rows_in_brackets(nodes);
        }
        self.names_under(nodes);
    }

    /// `q = [q_1 \quad q_2]`: a bracket that is a side of its own, transposed or not.
    fn rows_in_brackets(&mut self, nodes: &mut [Node]) {
        for i in 0..nodes.len() {
            let alone = |node: Option<&Node>, after: bool| match node.map(|n| &n.kind) {
                None | Some(NodeKind::Grid(_)) => true,
                Some(NodeKind::Token(kind)) => match kind {
                    Kind::Relation(_)
                    | Kind::Quad
                    | Kind::Comma
                    | Kind::Semicolon
                    | Kind::Amp
                    | Kind::Row => true,
                    Kind::Script | Kind::Prose => after,
                    Kind::Operator => !after || node.is_some_and(|n| cut(self.text, &n.span) == "."),
                    // A transpose, or a unit.
                    Kind::Word | Kind::Command => {
                        let is_unit = |shown: &str| words::is_unit(shown) || words::is_unit_alone(shown);
                        let shown = node.map_or("", |n| cut(self.text, &n.span));
                        after
                            && (shown.starts_with(['\'', '′', 'ᵀ']) || is_unit(shown) || shown == "\\mathrm")
                    }
                    _ => false,
                },
                _ => false,
            };
            let before = i.checked_sub(1).and_then(|i| nodes.get(i));
            let next = nodes.get(i + 1);
            let line = self.lines && next.is_some_and(|n| n.gap == Gap::Line);
            if !alone(before, false) || !(alone(next, true) || line) {
                continue;
            }
            let Some(node) = nodes.get_mut(i) else { continue };
            if let NodeKind::Group { bracket: Bracket::Round | Bracket::Left('('), inner, close, .. } =
                &node.kind
                && inner.iter().any(|n| n.is(Kind::Semicolon))
                && i > 0
                && let Some(rows) = grid::certain_rows(self.text, inner, *close, false)
                && rows.iter().all(|r| r.len() == 1)
            {
                // `P = (0.6; 0.35; -0.4)`, where commas are those of decimals.
                node.kind = NodeKind::Grid(Box::new(Grid::new(node.span.clone(), Fence::Round, rows)));
                continue;
            }
            if let NodeKind::Group { bracket: Bracket::Round | Bracket::Left('('), inner, close, .. } =
                &node.kind
                && inner.iter().any(|n| n.is(Kind::Comma))
                && i > 0
                && let Some(row) = grid::single_row(self.text, inner, *close)
            {
                // `p = (a, b, c)`: a column.
                let column = row.into_iter().map(|cell| vec![cell]).collect();
                node.kind = NodeKind::Grid(Box::new(Grid::new(node.span.clone(), Fence::Round, column)));
                continue;
            }
            if let NodeKind::Group { bracket: Bracket::Square | Bracket::Left('['), inner, close, .. } =
                &node.kind
                && let Some(row) = grid::single_row(self.text, inner, *close)
            {
                node.kind = NodeKind::Grid(Box::new(Grid::new(node.span.clone(), Fence::Square, vec![row])));
            }
        }
    }

    /// `\underbrace{M}_{name}`, `M_{name}`, `\underset{name}{M}`, `Matrix([[…]])`.
    fn names_under(&mut self, nodes: &mut Vec<Node>) {
        let mut out: Vec<Node> = Vec::with_capacity(nodes.len());
        let mut rest = std::mem::take(nodes).into_iter().peekable();
        while let Some(mut node) = rest.next() {
            let text = self.text;
            let command = |node: &Node| match node.token() {
                Some(Kind::Command | Kind::Word) => cut(text, &node.span),
                _ => "",
            };
            // `\underbrace{M}`, `Matrix(M)`, `{M}`
            if let Some(mut grid) = sole_grid(&node) {
                let before = out.last().map_or("", command);
                let brace = matches!(node.kind, NodeKind::Group { bracket: Bracket::Brace, .. });
                let round = matches!(node.kind, NodeKind::Group { bracket: Bracket::Round, .. });
                let dressed = matches!(before, "\\underbrace" | "\\overbrace" | "\\mathop" | "\\boxed");
                let named = matches!(before.to_ascii_lowercase().as_str(), "matrix" | "array");
                let under = match (out.len().checked_sub(2).and_then(|i| out.get(i)), out.last()) {
                    (Some(set), Some(name)) if command(set) == "\\underset" => inner_span(text, name),
                    _ => None,
                };
                let taken = match (brace, round) {
                    (true, _) if under.is_some() => 2,
                    (true, _) if dressed => 1,
                    (true, _) => 0,
                    (_, true) if named => 1,
                    _ => usize::MAX,
                };
                if taken <= out.len() {
                    let first = out.drain(out.len() - taken..).next();
                    let start = first.as_ref().map_or(node.span.start, |n| n.span.start);
                    let gap = first.as_ref().map_or(node.gap, |n| n.gap);
                    grid.span = start..node.span.end;
                    grid.under = under.or(grid.under);
                    node = Node { span: grid.span.clone(), kind: NodeKind::Grid(Box::new(grid)), gap };
                    // `np.`, `sp.` before `array`
                    while named
                        && out.len() >= 2
                        && out.last().is_some_and(|n| cut(text, &n.span) == ".")
                        && let [.., module, _] = out.as_slice()
                        && matches!(cut(text, &module.span), "np" | "numpy" | "sp" | "sympy")
                    {
                        let (start, gap) = (module.span.start, module.gap);
                        out.truncate(out.len() - 2);
                        node.span.start = start;
                        node.gap = gap;
                    }
                }
            }
            if let NodeKind::Grid(grid) = &mut node.kind
                && rest.peek().is_some_and(|n| n.is(Kind::Script) && cut(text, &n.span) == "_")
            {
                let script = rest.next();
                match rest.next() {
                    Some(name) if name.token().is_none_or(|k| matches!(k, Kind::Word | Kind::Command)) => {
                        grid.under = inner_span(text, &name);
                        grid.span.end = name.span.end;
                        node.span.end = name.span.end;
                        out.push(node);
                    }
                    other => {
                        out.push(node);
                        out.extend(script);
                        out.extend(other);
                    }
                }
                continue;
            }
            out.push(node);
        }
        *nodes = out;
    }
}

/// What an opening bracket stands on without a gap: it is an index or an argument then.
fn is_attachable(node: &Node) -> bool {
    match &node.kind {
        NodeKind::Group { bracket, .. } => *bracket == Bracket::Round,
        NodeKind::Token(kind) => *kind == Kind::Word,
        _ => false,
    }
}

/// Whether a row has a relation that is not in brackets.
pub(super) fn has_relation(nodes: &[Node]) -> bool {
    nodes.iter().any(|n| n.relation().is_some() || matches!(&n.kind, NodeKind::System(_)))
}

/// The matrix that is all of a bracket.
fn sole_grid(node: &Node) -> Option<Grid> {
    match &node.kind {
        NodeKind::Group { inner, .. } => match inner.as_slice() {
            [Node { kind: NodeKind::Grid(grid), .. }] => Some(Grid::clone(grid)),
            // `Matrix([a, b])` is a column, but only `[[a], [b]]` says so.
            _ => None,
        },
        _ => None,
    }
}

/// What stands in the braces, or the whole node.
fn inner_span(text: &str, node: &Node) -> Option<Range<usize>> {
    let span = match &node.kind {
        NodeKind::Group { open, close, .. } => *open..*close,
        _ => node.span.clone(),
    };
    let shown = cut(text, &span);
    let start = span.start + (shown.len() - shown.trim_start().len());
    let end = start + shown.trim().len();
    (!words::bare(text, &(start..end)).is_empty()).then_some(start..end)
}

fn fence(mark: char) -> Fence {
    match mark {
        '[' => Fence::Square,
        '(' => Fence::Round,
        '|' => Fence::Bars,
        '{' => Fence::Braces,
        _ => Fence::None,
    }
}
