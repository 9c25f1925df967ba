//! What is found in a recording, as facts.

use crate::decode::Format;
use denavit::geometry::{Axis, Transform};

/// A way in which the recording is other than the model.
#[derive(Clone, PartialEq, Debug)]
pub enum Slip {
    /// All joints are in degrees where radians are said.
    Degrees,
    /// All joints are in radians where degrees are said.
    Radians,
    /// All joints are −100 to 100 of their ranges.
    Hundred,
    /// A column among the joints' is no joint's.
    Dropped(usize),
    /// The joints' columns stand in reversed order.
    Reversed,
    /// Two joints' columns are exchanged.
    Swap(usize, usize),
    /// A joint's sign.
    Flip(usize),
    /// A joint's column is so many quarter turns ahead.
    Quarter(usize, i8),
    /// A joint's column holds it plus or minus the one before.
    Couple(usize, i8),
    /// One column is in degrees.
    DegreesOne(usize),
    /// A column counts twice (2) or half (−2) of the joint.
    Gain(usize, i8),
    /// The pose is the base seen from the hand.
    Inverse,
    /// The orientation is that of the base seen from the hand, the position is not.
    Transposed,
    /// Lengths are in another unit: how many of them are one of the model's.
    Unit(f64),
    /// The recording is left-handed: the axis that is mirrored.
    LeftHanded(Axis),
    /// It is another arm's.
    OtherArm(String),
    /// The recording's base is another one: the robot's base in it.
    Base(Transform<f64>),
    /// The recorded frame stands elsewhere in the tool.
    Tool(Transform<f64>),
    /// The pose is behind the joints, rows.
    Lag(Fitted),
    /// A joint's column is ahead of the model, radians or metres.
    Zero(usize, Fitted),
    /// A joint moves more than its column says, as a part of it.
    GainBy(usize, Fitted),
    /// A joint's column holds a part of the joint before it.
    CoupleBy(usize, Fitted),
    /// A length is longer, metres.
    Length(Length),
    /// A joint's column jumps by whole turns: row, how often, and a turn in it.
    Jump(usize, usize, usize, f64),
    /// A joint's column stood still while the hand went on.
    Stuck(Stuck),
    /// The pose of single rows is far from those before and behind.
    Spikes(Vec<usize>),
    /// The hand is far off in these rows, of so many that were looked at, and not in the others.
    Apart(Vec<usize>, usize),
    /// Numbers are missing.
    Missing(Vec<usize>),
    /// The time goes back, or stands still.
    TimeBack(Vec<usize>),
    /// Time is missing between rows.
    Gaps(Vec<usize>),
    /// A joint's column does not follow the motion; the pose asks for other values.
    Unlike(Unlike),
    /// Nothing that is known here explains it.
    NotUnderstood,
}

/// A fitted number with its standard deviation.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Fitted {
    /// It.
    pub value: f64,
    /// The deviation.
    pub deviation: f64,
}

/// A length that is another one.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Length {
    /// The constant between two moving axes, 1 behind the first.
    pub constant: usize,
    /// Its coordinate.
    pub axis: usize,
    /// What the model says, metres.
    pub model: f64,
    /// By how much it is longer, metres.
    pub by: Fitted,
}

/// A run of one value.
#[derive(Clone, PartialEq, Debug)]
pub struct Stuck {
    /// The joint.
    pub joint: usize,
    /// Its rows.
    pub from: usize,
    /// Behind the last row.
    pub to: usize,
    /// What the joint did meanwhile, as the pose shows it: the least and the most, radians or metres.
    pub meanwhile: Option<[f64; 2]>,
}

/// A column beside the values that the pose asks for.
#[derive(Clone, PartialEq, Debug)]
pub struct Unlike {
    /// The joint.
    pub joint: usize,
    /// Whether the column does not move at all.
    pub is_still: bool,
    /// The least and the most that the pose asks for, radians or metres.
    pub needed: [f64; 2],
}

/// How far the hand is off: a turn and a shift, root mean squares.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Off {
    /// Radians.
    pub turn: f64,
    /// Metres.
    pub shift: f64,
}

/// A slip with its evidence.
#[derive(Clone, PartialEq, Debug)]
pub struct Finding {
    /// What it is.
    pub slip: Slip,
    /// How far the hand is off where this alone is left as it stands.
    pub without: Option<Off>,
    /// Other slips that are the same function: no motion tells them apart.
    pub same: Vec<Slip>,
}

/// What no motion in the recording can tell.
#[derive(Clone, PartialEq, Debug)]
pub enum Unseen {
    /// A joint does not move.
    Still(usize),
    /// A joint's sign: it moves by the first number, the second would do.
    Sign(usize, f64, f64),
    /// Nothing moves.
    Everything,
}

/// A reading that the recording does not tell from the one that is given.
#[derive(Clone, PartialEq, Debug)]
pub struct Rival {
    /// Its slips.
    pub slips: Vec<Slip>,
    /// Its format.
    pub format: Format,
    /// By how many nats it is less likely.
    pub nats: f64,
}
