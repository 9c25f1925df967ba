//! A class of documents held against one robot, with points by a rubric.

use crate::Schema;
use crate::check::Tally;
use serde::Serialize;

/// The documents of a class.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Class {
    /// The items of the rubric; none without one.
    pub items: Vec<Item>,
    /// The version.
    pub schema: Schema,
    /// The slips of all, the most frequent first.
    pub slips: Vec<ClassSlip>,
    /// One a document.
    pub students: Vec<Student>,
    /// What the rubric is called.
    pub title: String,
}

/// An item of the rubric.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Item {
    /// What it is called.
    pub name: String,
    /// The most that it earns.
    pub points: f64,
}

/// A slip that several documents may have.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct ClassSlip {
    /// The left side of the claim.
    pub claim: String,
    /// The slip in words.
    pub slip: String,
    /// The students who made it.
    pub students: Vec<String>,
}

/// A document.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Student {
    /// What is to be marked by hand.
    pub by_hand: Vec<ByHand>,
    /// The file.
    pub document: String,
    /// Why it could not be held against the robot.
    pub error: Option<String>,
    /// What each item earns; nothing without a rubric.
    pub marks: Option<Vec<Mark>>,
    /// The file's name without its ending.
    pub name: String,
    /// The points that a teacher decides on.
    pub open: Option<f64>,
    /// The points that are certain.
    pub points: Option<f64>,
    /// How many claims there are of each verdict.
    pub tally: Option<Tally>,
}

/// What an item earns.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Mark {
    /// The points that a teacher decides on.
    pub open: f64,
    /// The points that are certain.
    pub points: f64,
    /// Why, in words.
    pub remark: String,
}

/// A formula that was not judged.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct ByHand {
    /// Its line.
    pub line: usize,
    /// It, blanks run together.
    pub text: String,
    /// Why, in words.
    pub why: String,
}
