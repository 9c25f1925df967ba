//! Programs as they are written, in one form for both languages.

use denavit_symbolic::Rational;
use denavit_symbolic::parse::ParseError;
use std::collections::BTreeSet;
use std::ops::Range;

/// A place in the text, in bytes.
pub(super) type Span = Range<usize>;

/// A part of an expression.
#[derive(Debug)]
pub(super) struct Node {
    pub kind: Kind,
    pub span: Span,
}

#[derive(Debug)]
pub(super) enum Kind {
    /// A number; true for one that Python takes as an `int`.
    Number(Rational, bool),
    Text(String),
    Name(String),
    /// In brackets of its own.
    Bracket(Box<Node>),
    /// What is behind a value: `.T`, `(…)`, `[…]`.
    Path(Box<Node>, Vec<Suffix>),
    Unary(Op, Box<Node>),
    /// Operators of one level, from left to right.
    Chain(Box<Node>, Vec<(Op, Node)>),
    List(Vec<Node>),
    Tuple(Vec<Node>),
    /// `[a b; c d]`
    Rows(Vec<Vec<Node>>),
    /// `{a, b}`
    Cells(Vec<Vec<Node>>),
    Lambda(Box<Definition>),
    /// `item for target in source`
    Comprehension(Box<[Node; 3]>),
    /// `value if test else other`, as test, value, other.
    Choice(Box<[Node; 3]>),
    /// `from:to:step`, as Python has it.
    Slice(Box<[Option<Node>; 3]>),
    /// `:` as an index.
    All,
    /// `end` in an index.
    End,
    /// `*rest`
    Star(Box<Node>),
}

#[derive(Debug)]
pub(super) struct Suffix {
    pub kind: SuffixKind,
    /// Where it ends.
    pub end: usize,
}

#[derive(Debug)]
pub(super) enum SuffixKind {
    Attribute(String),
    Call(Vec<Argument>),
    Index(Vec<Node>),
    /// `{…}`
    Cell(Vec<Node>),
    Transpose,
}

#[derive(Debug)]
pub(super) struct Argument {
    pub name: Option<String>,
    pub value: Node,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Op {
    Add,
    Sub,
    Mul,
    Div,
    FloorDiv,
    Mod,
    Pow,
    MatMul,
    /// `.*`, `./` and `.^`
    EachMul,
    EachDiv,
    EachPow,
    /// `\`
    LeftDiv,
    Colon,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
    NotEqual,
    And,
    Or,
    Not,
}

impl Op {
    pub fn is_comparison(self) -> bool {
        use Op::*;
        matches!(self, Less | LessEqual | Greater | GreaterEqual | Equal | NotEqual)
    }
}

#[derive(Debug)]
pub(super) struct Parameter {
    pub name: String,
    pub span: Span,
    pub default: Option<Node>,
}

/// A function of the text.
#[derive(Debug)]
pub(super) struct Definition {
    pub name: String,
    pub span: Span,
    pub parameters: Vec<Parameter>,
    /// The names of what a MATLAB function gives back, and their places.
    pub outputs: Vec<(String, Span)>,
    pub body: Vec<Statement>,
}

#[derive(Debug)]
pub(super) struct Statement {
    pub kind: StatementKind,
    pub span: Span,
}

#[derive(Debug)]
pub(super) enum StatementKind {
    /// Targets, the first first, and what each of them gets.
    Assign(Vec<Node>, Node),
    /// `target += value`
    Augment(Node, Op, Node),
    /// An expression by itself.
    Show(Node),
    /// What a test holds to be true.
    Assert(Node),
    Return(Option<Node>),
    For(Node, Node, Vec<Statement>),
    If(Vec<(Node, Vec<Statement>)>, Vec<Statement>),
    Define(Definition),
    /// Names and the paths of what they are: `np` for `numpy`.
    Import(Vec<(String, String)>),
    ImportAll(String),
    /// Names declared to stand for themselves.
    Declare(Vec<(String, Span)>),
    Break,
    Continue,
    Pass,
    /// The program gives up.
    Raise,
    /// What is not read, and the statements in it, whose names are not known afterwards.
    Refused(ParseError, Vec<Statement>),
}

/// The names that statements give new values, or may change, and whether one of them leaves the function.
pub(super) fn changed<'a>(statements: &'a [Statement], names: &mut Vec<&'a str>) -> bool {
    collected(statements, names, false)
}

/// The names on the left sides of statements.
pub(super) fn given(statements: &[Statement]) -> Vec<&str> {
    let mut names = vec![];
    collected(statements, &mut names, true);
    names
}

fn collected<'a>(statements: &'a [Statement], names: &mut Vec<&'a str>, is_left: bool) -> bool {
    let mut leaves = false;
    for statement in statements {
        match &statement.kind {
            StatementKind::Assign(targets, _) => targets.iter().for_each(|t| targeted(t, names)),
            StatementKind::Augment(target, ..) => targeted(target, names),
            StatementKind::Show(_) | StatementKind::Define(_) if is_left => {}
            StatementKind::Show(node) => receiver(node, names),
            StatementKind::For(target, _, body) => {
                targeted(target, names);
                leaves |= collected(body, names, is_left);
            }
            StatementKind::If(arms, other) => {
                for (_, body) in arms {
                    leaves |= collected(body, names, is_left);
                }
                leaves |= collected(other, names, is_left);
            }
            StatementKind::Refused(_, body) => leaves |= collected(body, names, is_left),
            StatementKind::Define(d) => names.push(&d.name),
            StatementKind::Declare(declared) => names.extend(declared.iter().map(|d| d.0.as_str())),
            StatementKind::Return(_) => leaves = true,
            StatementKind::Import(_)
            | StatementKind::ImportAll(_)
            | StatementKind::Break
            | StatementKind::Continue
            | StatementKind::Assert(_)
            | StatementKind::Pass => {}
            StatementKind::Raise => leaves = true,
        }
    }
    leaves
}

fn targeted<'a>(target: &'a Node, names: &mut Vec<&'a str>) {
    match &target.kind {
        Kind::Name(name) => names.push(name),
        Kind::Path(base, _) | Kind::Bracket(base) | Kind::Star(base) => targeted(base, names),
        Kind::List(parts) | Kind::Tuple(parts) => parts.iter().for_each(|p| targeted(p, names)),
        Kind::Rows(rows) => rows.iter().flatten().for_each(|p| targeted(p, names)),
        _ => {}
    }
}

/// `T` of `T.append(x)`, which may change it, and what is handed to a function.
fn receiver<'a>(node: &'a Node, names: &mut Vec<&'a str>) {
    if let Kind::Path(base, suffixes) = &node.kind
        && let Kind::Name(name) = &base.kind
    {
        names.push(name);
        for suffix in suffixes {
            if let SuffixKind::Call(arguments) = &suffix.kind {
                arguments.iter().for_each(|a| targeted(&a.value, names));
            }
        }
    }
}

/// The names that stand in statements for their values.
pub(super) fn mentioned<'a>(statements: &'a [Statement], names: &mut BTreeSet<&'a str>) {
    for statement in statements {
        match &statement.kind {
            StatementKind::Assign(_, node)
            | StatementKind::Augment(_, _, node)
            | StatementKind::Show(node) => {
                in_node(node, names);
            }
            StatementKind::Return(node) => node.iter().for_each(|n| in_node(n, names)),
            StatementKind::For(_, source, body) => {
                in_node(source, names);
                mentioned(body, names);
            }
            StatementKind::If(arms, other) => {
                for (test, body) in arms {
                    in_node(test, names);
                    mentioned(body, names);
                }
                mentioned(other, names);
            }
            StatementKind::Define(d) => mentioned(&d.body, names),
            StatementKind::Refused(_, body) => mentioned(body, names),
            _ => {}
        }
    }
}

fn in_node<'a>(node: &'a Node, names: &mut BTreeSet<&'a str>) {
    match &node.kind {
        Kind::Name(name) => {
            names.insert(name);
        }
        Kind::Number(..) | Kind::Text(_) | Kind::All | Kind::End => {}
        Kind::Bracket(inner) | Kind::Unary(_, inner) | Kind::Star(inner) => in_node(inner, names),
        Kind::Path(base, suffixes) => {
            in_node(base, names);
            for suffix in suffixes {
                match &suffix.kind {
                    SuffixKind::Call(arguments) => arguments.iter().for_each(|a| in_node(&a.value, names)),
                    SuffixKind::Index(items) | SuffixKind::Cell(items) => {
                        items.iter().for_each(|n| in_node(n, names));
                    }
                    SuffixKind::Attribute(_) | SuffixKind::Transpose => {}
                }
            }
        }
        Kind::Chain(first, rest) => {
            in_node(first, names);
            rest.iter().for_each(|(_, n)| in_node(n, names));
        }
        Kind::List(parts) | Kind::Tuple(parts) => parts.iter().for_each(|n| in_node(n, names)),
        Kind::Rows(rows) | Kind::Cells(rows) => rows.iter().flatten().for_each(|n| in_node(n, names)),
        Kind::Lambda(d) => mentioned(&d.body, names),
        Kind::Comprehension(parts) | Kind::Choice(parts) => parts.iter().for_each(|n| in_node(n, names)),
        Kind::Slice(parts) => parts.iter().flatten().for_each(|n| in_node(n, names)),
    }
}
