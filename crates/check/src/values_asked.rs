//! Values that a rubric asks for, and what was held against them.

use std::ops::Range;

/// A value that is asked for.
#[derive(Clone, PartialEq, Debug)]
pub struct Answer {
    /// What people call it: letters and digits only, `*` for any.
    pub names: Vec<String>,
    /// Its value as a formula: of numbers, or of numbers and one letter.
    pub value: String,
    /// Its unit, nothing where it has none.
    pub unit: String,
}

/// A statement that was held against an answer.
#[derive(Clone, PartialEq, Debug)]
pub struct Answered {
    /// The item of the rubric, and which of its answers.
    pub of: [usize; 2],
    /// Where it stands.
    pub span: Range<usize>,
    /// Its left side as printed.
    pub name: String,
    /// What is wrong with it; nothing if it is right.
    pub slip: Option<ValueSlip>,
    /// What is right, with its unit.
    pub right: String,
    /// As how many formulas it counts.
    pub counts: usize,
    /// It may be right or no answer: it is marked by hand.
    pub by_hand: bool,
}

/// How a value differs from the right one.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ValueSlip {
    /// By its sign.
    Sign,
    /// Radians stand where degrees do, or the other way round.
    AngleUnit,
    /// By a factor of two or three, or one of these is missing.
    Factor,
    /// By a power of ten.
    PowerOfTen,
    /// One term is another: that with this power of the letter.
    Term(usize),
    /// In another way.
    Other,
}
