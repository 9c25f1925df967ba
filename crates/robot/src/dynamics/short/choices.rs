//! What is chosen for each link.

/// A frame for the motion, the wrench or the sum of a link.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Frame {
    /// Its own.
    Own,
    /// That before its group.
    Group,
    /// That of the group's first link.
    First,
}

/// What of the second moments on the axis a link gives away.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Form {
    /// So much that its second moment along z is 0.
    NoZz,
    /// So much that YY is 0.
    NoYy,
}

/// What mass a link keeps on its axis.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Gauge {
    /// None.
    Nothing,
    /// So much that MX of the link before is 0.
    X,
    /// So much that MY of the link before is 0.
    Y,
}

/// The choices, link by link.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Choices {
    /// Where the wrench is had.
    pub wrench: Vec<Frame>,
    /// Where the step to the next link and the sum are made.
    pub step: Vec<Frame>,
    pub form: Vec<Form>,
    pub gauge: Vec<Gauge>,
    /// Whether U of the group's later links is that of the link before with what is added, not products of ω.
    pub added: Vec<bool>,
    /// Whether the constant length along a revolute axis stands behind the joint.
    pub slid: Vec<bool>,
    /// Whether vectors go from link to link of a group by the angle between.
    pub relative: bool,
}

impl Choices {
    /// All links in one kind of frame.
    pub fn all(n: usize, frame: Frame, form: Form) -> Self {
        Choices {
            wrench: vec![frame; n],
            step: vec![frame; n],
            form: vec![form; n],
            gauge: vec![Gauge::Nothing; n],
            added: vec![true; n],
            // Behind the last axis stands nothing that a length could lengthen.
            slid: (1..=n).map(|k| k == n).collect(),
            relative: false,
        }
    }
}
