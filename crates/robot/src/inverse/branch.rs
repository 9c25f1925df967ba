//! Which of several roots a solution takes, step by step.

use std::fmt::{self, Display, Write};

/// What a choice between roots is about.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Part {
    /// The first turning joint.
    Shoulder,
    /// A joint between shoulder and wrist.
    Elbow,
    /// The last joints.
    Wrist,
    /// A joint that slides.
    Reach,
}

/// The name of a step that has several roots.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Label {
    /// What it is about.
    pub part: Part,
    /// From 1, among the steps that are about the same.
    pub number: usize,
}

/// Which root is taken.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Choice {
    /// The one with the sign +1.
    Plus,
    /// The one with the sign −1.
    Minus,
    /// One of more than two, by its number.
    Root(i8),
}

/// The choice of each step that has several, in the order of the steps; nothing where a solution has no name.
#[derive(Clone, PartialEq, Eq, Hash, Debug, Default)]
pub struct Branch(pub Vec<(Label, Choice)>);

impl Choice {
    /// By the sign of a solver's node.
    pub(crate) fn of_sign(sign: i8) -> Self {
        match sign {
            1 => Choice::Plus,
            -1 => Choice::Minus,
            n => Choice::Root(n),
        }
    }
}

impl Branch {
    /// By the signs of a solver's nodes.
    pub(crate) fn of_signs(labels: impl IntoIterator<Item = Option<Label>>, signs: &[i8]) -> Self {
        let all = labels.into_iter().zip(signs);
        Branch(all.filter_map(|(label, &sign)| Some((label?, Choice::of_sign(sign)))).collect())
    }

    /// True if it has no name.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

/// The identifier in solvers and generated code: `elbow2`.
impl Display for Label {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let part = match self.part {
            Part::Shoulder => "shoulder",
            Part::Elbow => "elbow",
            Part::Wrist => "wrist",
            Part::Reach => "reach",
        };
        if self.number == 1 { f.write_str(part) } else { write!(f, "{part}{}", self.number) }
    }
}

impl Display for Choice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Choice::Plus => f.write_char('+'),
            Choice::Minus => f.write_char('−'),
            Choice::Root(n) => write!(f, "{n}"),
        }
    }
}

/// The identifier in JSON: `shoulder+ elbow2−`.
impl Display for Branch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let all: Vec<String> = self.0.iter().map(|(label, choice)| format!("{label}{choice}")).collect();
        f.pad(&all.join(" "))
    }
}
