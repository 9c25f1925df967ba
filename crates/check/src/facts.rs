//! The facts that verdicts rest on; their words are the report's.

use super::formula::Formula;
use super::inverse::{Cause as SignLoss, Missing, Undecided};
pub use super::masses_read::{ReadWith, Spoken, Whereabouts};
use denavit::description::Convention;
use denavit::forward::Reference;
use denavit::geometry::Axis;
use denavit::geometry::orientation::OrientationSet;
use denavit_reading::slip::Slip;
use denavit_symbolic::Symbol;

/// Names of rates (1) and accelerations (2), with the joints that they are of.
pub(crate) type Motion = std::collections::BTreeMap<String, (usize, usize)>;

/// What a claim is about.
#[derive(Clone, PartialEq, Debug)]
pub enum About {
    /// A matrix or a vector that the robot gives.
    Matrix(Meaning),
    /// Matrices that are said to be equal, whatever they are.
    Matrices,
    /// An entry of a matrix that the robot gives.
    Entry,
    /// Formulas that are said to be equal.
    Equation,
    /// A name that what is proved uses.
    Helper,
    /// A configuration at which the arm is said to be singular.
    Singularity,
    /// Values of a joint.
    Joint,
    /// An angle of an orientation.
    Angle(OrientationSet),
    /// A table of the arm, held against the robot's.
    Table,
    /// A row of such a table.
    TableRow,
    /// Values of all joints in a table, for a pose that the document gives or that stands beside them.
    Configuration,
    /// A quantity of dynamics.
    Dynamics(Dynamic),
}

/// The quantities of dynamics.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Dynamic {
    /// A torque, or the force of a joint that slides.
    Torque,
    /// What of a torque does not depend on accelerations.
    Bias,
    /// The inertia matrix.
    Inertia,
    /// Centrifugal and Coriolis torques.
    Velocity,
    /// The matrix of these, or Christoffel's symbols.
    Coriolis,
    /// Torques of gravity.
    Gravity,
    /// The kinetic energy.
    Kinetic,
    /// The potential energy.
    Potential,
    /// Their difference.
    Lagrangian,
    /// Their sum.
    Energy,
    /// A derivative of an energy.
    Derivative,
    /// Where a point of a link is.
    Place,
    /// How fast it moves.
    Motion,
}

/// What a matrix or a vector is by the robot. Frames are numbered by rows; the tool is the hand.
#[derive(Clone, PartialEq, Debug)]
pub enum Meaning {
    /// The pose of the hand, entry by entry.
    Hand,
    /// The position of the hand.
    Position,
    /// The transform of any row of a table.
    Row,
    /// A frame in another.
    Frame {
        /// Which.
        of: Reference,
        /// In which.
        seen_from: Reference,
    },
    /// A frame in another, both named by letters, wherever they are.
    AnyFrame {
        /// Which.
        of: char,
        /// In which.
        seen_from: char,
    },
    /// The rotation of a transform.
    Rotation(Box<Meaning>),
    /// An axis of a frame.
    Axis(Axis, Box<Meaning>),
    /// The origin of a frame.
    Origin(Box<Meaning>),
    /// An inverse.
    Inverse(Box<Meaning>),
    /// A transpose.
    Transpose(Box<Meaning>),
    /// A product of several.
    Product(Vec<Meaning>),
    /// A sum of two, or their difference.
    Sum {
        /// Both.
        terms: Box<[Meaning; 2]>,
        /// Whether the second is subtracted.
        is_difference: bool,
    },
    /// The rotation about an axis.
    RotationAbout(Axis),
    /// The translation along an axis.
    TranslationAlong(Axis),
    /// A translation along all axes.
    Translation,
    /// A Jacobian.
    Jacobian(Jacobian),
    /// The column of a joint (a number from 1) in a Jacobian.
    Column(usize, Jacobian),
    /// The velocity of a frame along the axes of another.
    Velocity {
        /// Whose: of its origin, if it is not angular.
        of: Reference,
        /// Along whose axes.
        along: Reference,
        /// Whether it is the angular one.
        is_angular: bool,
    },
    /// What something is with all joints at 0.
    AtRest(Box<Meaning>),
    /// The screw of a joint (a number from 1) with all joints at 0.
    Screw {
        /// Which joint.
        joint: usize,
        /// Whether the direction of the axis stands behind the moment.
        is_linear_first: bool,
    },
    /// The torques of the joints for a load on the hand.
    Torques,
}

/// Which Jacobian a matrix is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Jacobian {
    /// The point that moves: the hand, or the origin of the last frame.
    pub body: Reference,
    /// The frame at whose origin that point is, where that is not the body's own.
    pub at: Option<usize>,
    /// Along whose axes: frame 0 is the usual one, the tool stands for the hand's own.
    pub axes: Reference,
    /// Whether the angular rows stand first.
    pub is_angular_first: bool,
    /// How many rows there are.
    pub rows: usize,
    /// Which rows of the full one they are, linear ones from 0, angular ones from 3; those behind `rows` do not count.
    pub order: [u8; 6],
}

impl Meaning {
    /// A product of one factor is that factor.
    pub(super) fn product(mut factors: Vec<Meaning>) -> Self {
        if factors.len() == 1 { factors.remove(0) } else { Meaning::Product(factors) }
    }

    /// True if a Jacobian stands first in it.
    pub(super) fn begins_with_jacobian(&self) -> bool {
        match self {
            Meaning::Jacobian(_) => true,
            Meaning::Product(factors) => factors.first().is_some_and(Meaning::begins_with_jacobian),
            Meaning::Sum { terms, .. } => terms[0].begins_with_jacobian(),
            _ => false,
        }
    }
}

/// What a matrix with several wrong entries is as a whole. Numbers count from 1 but for those of frames.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Instead {
    /// The inverse of what it should be.
    Inverse,
    /// Its transpose.
    Transpose,
    /// It with the rotation transposed.
    RotationTransposed,
    /// It with two rows exchanged.
    RowsExchanged(usize, usize),
    /// It with the signs of a row changed.
    RowSigns(usize),
    /// It with two columns exchanged.
    ColumnsExchanged(usize, usize),
    /// It with the signs of a column changed.
    ColumnSigns(usize),
    /// Another frame in another one.
    Frame {
        /// Which.
        of: usize,
        /// In which.
        seen_from: usize,
    },
    /// The links between two frames multiplied in the opposite order.
    Backwards {
        /// The frame.
        of: usize,
        /// In which.
        seen_from: usize,
    },
    /// A frame in another without one of the links between.
    Without {
        /// The frame.
        of: usize,
        /// In which.
        seen_from: usize,
        /// The link that is left out.
        link: usize,
    },
    /// The same frames by another table of the document.
    ByTable {
        /// The frame.
        of: usize,
        /// In which.
        seen_from: usize,
        /// The line of that table.
        line: usize,
    },
}

/// What else is to be said of a claim or of a formula.
#[derive(Clone, PartialEq, Debug)]
pub enum Remark {
    /// A matrix has more rows than it should have.
    ManyRows {
        /// Those in print.
        printed: usize,
        /// Those that it should have.
        wanted: usize,
    },
    /// A row is too short.
    ShortRow(ShortRow),
    /// There is nothing to compare an entry with (row and column from 1).
    Incomparable(usize, usize),
    /// Further entries of a product (row and column from 1) that differ when it is worked out.
    OthersDiffer(Vec<(usize, usize)>),
    /// A number is right if degrees are taken for radians, or radians for degrees.
    AngleUnit,
    /// It is right in millimetres.
    Millimetres,
    /// It is right in metres.
    Metres,
    /// It is right but for its sign.
    Sign,
    /// It is off in the last digit.
    LastDigit,
    /// It is off by so much.
    OffBy(f64),
    /// Found in samples, not proved.
    Sampled,
    /// Compared with all solutions at so many poses.
    Compared(usize),
    /// It is read in a sense that is not the first one: the rest of the document supports it.
    ReadAs(Sense),
    /// A function or a root loses a sign.
    SignLost {
        /// Which of several values (from 0).
        value: Option<usize>,
        /// What loses it.
        by: SignLoss,
        /// It is right where these are positive.
        right_where: Vec<Formula>,
    },
    /// Solutions are left out.
    LeftOut(Missing),
    /// A value belongs to no solution at a share of the poses.
    NoSolution {
        /// Which of several values (from 0).
        value: Option<usize>,
        /// The share.
        share: f64,
    },
    /// A value is no number at a share of the poses.
    NoNumber {
        /// Which of several values (from 0).
        value: Option<usize>,
        /// The share.
        share: f64,
    },
    /// A divisor vanishes.
    DivisionByZero {
        /// What vanishes.
        factor: Formula,
        /// Where, if it is known.
        zeros: Vec<Zeros>,
    },
    /// Wrong at a configuration at which the joint is determined, radians and metres.
    FailsAt(Vec<f64>),
    /// The left side minus the right one.
    Residual(Formula),
    /// A table is that of the robot, but for what its author may choose.
    Placed(Box<Placement>),
    /// It is right by the document's own table, which is the same mechanism as the robot.
    ByOwnTable,
    /// It holds of the coordinates as they are, not as they were printed before.
    OfTrueCoordinates,
}

/// What a table leaves as it likes, while its axes are those of the robot. Joints are counted from 1.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Placement {
    /// Joints that are 0 elsewhere, and what is added to the robot's variable.
    pub zeros: Vec<(usize, Formula)>,
    /// Joints that count the other way.
    pub reversed: Vec<usize>,
    /// Frame 0 stands elsewhere.
    pub base: bool,
    /// The last frame stands elsewhere.
    pub hand: bool,
    /// Frame 0 or the last frame is turned.
    pub is_turned: bool,
    /// Names of the table for lengths of the robot.
    pub names: Vec<(String, String)>,
    /// The convention in which the table is that of the robot, where nothing says it.
    pub convention: Option<Convention>,
    /// Its lengths are in millimetres.
    pub millimetres: bool,
}

impl Placement {
    /// True if nothing is left to the author.
    pub fn is_none(&self) -> bool {
        *self == Placement::default()
    }
}

/// A meaning of a name that is not the first one.
#[derive(Clone, PartialEq, Debug)]
pub enum Sense {
    /// Letters stand for the rates of joints: `u_1`, `θ_1` and so on, each letter before its joint.
    Rates(Vec<[String; 2]>),
    /// A number behind `T` is that of a link, not of a frame in the base.
    LinkAlone,
    /// The document's own transforms of links, whose product is the robot's.
    OwnLinks,
    /// Velocities are those of the printed Jacobian's point, along its axes.
    VelocitiesOfJacobian,
    /// The left index is the frame, the right one that in which it is seen.
    IndicesExchanged,
    /// The name is a helper, not an entry of the pose.
    Helper,
    /// `atan2` has the cosine first.
    CosineFirst,
    /// The columns of the pose are s, n, a, P.
    ColumnsSnap,
    /// The place of the hand is o.
    PlaceIsO,
    /// Frame 0 is the base in front of the table.
    ZeroIsBase,
    /// r_ij are the entries of the wrist's rotation.
    WristEntries,
    /// Lengths without a unit are in millimetres, or in metres.
    Unit {
        /// Which.
        millimetres: bool,
    },
    /// The components of a load are those along the axes of the hand.
    LoadInHand,
    /// The place of the hand has the number of the frame in which it is seen.
    HandInFrames,
    /// The torques hold against the load: τ = −Jᵀ F.
    AgainstLoad,
    /// Lengths that the table has in numbers have this letter and the number of their row.
    Lengths {
        /// Which.
        letter: char,
    },
    /// The hand stands there in the last frame of the table.
    Tool {
        /// Its coordinates.
        place: [Formula; 3],
    },
    /// A load on the hand of this letter along an axis, or against it.
    Load {
        /// Its letter; `N` where words give it in newtons.
        letter: char,
        /// The axis.
        axis: Axis,
        /// Whether it points against the axis.
        is_minus: bool,
    },
}

/// A printed row with fewer elements than others.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ShortRow {
    /// Its number, from 1.
    pub row: usize,
    /// Its elements.
    pub elements: usize,
    /// Those of the longest.
    pub width: usize,
}

/// Where a factor vanishes.
#[derive(Clone, PartialEq, Debug)]
pub struct Zeros {
    /// An angle; nothing if it is too long to be shown.
    pub angle: Option<Formula>,
    /// Its values there.
    pub values: Vec<Formula>,
}

/// Where a formula is right.
#[derive(Clone, PartialEq, Debug)]
pub enum Condition {
    /// With one of its signs.
    OneSign,
    /// With the sign that belongs to the configuration.
    OwnSign,
    /// As far as it goes: solutions are left out.
    Incomplete(Option<Missing>),
    /// As far as numbers show: the values agree at so many poses, to about this much (radians, or lengths by the arm's
    /// size), and nothing is proved.
    Compared {
        /// The poses.
        poses: usize,
        /// How far the values are from the right ones at most of them: rounding is 1e-12 and less.
        apart: f64,
    },
    /// In a part of all configurations: where all formulas of one of these lists are positive, if that is known.
    Configurations(Vec<Vec<Formula>>),
    /// In a part of all orientations: where all of these are positive, if that is known.
    Orientations(Vec<Formula>),
    /// A helper, where what uses it is right: that is not all proved, or not all right.
    AsUsed,
    /// While other joints are at rest, as the text has some fixed.
    Locked,
    /// Where a joint follows others as the text says, `q4 = -(q2 + q3)`.
    Following,
    /// As an answer to a task that leaves this free.
    Placed(Box<Placement>),
}

/// Why a formula is neither proved nor refuted.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Unproved {
    /// A length has no value.
    NoLength,
    /// A joint's rate has no value.
    NoRate,
    /// Neither proved equal nor found different.
    NotFound,
    /// It is right by the document's own table, which is not that of the robot.
    OwnTable,
    /// The names are those of no angles of the set.
    NotOfSet,
    /// Nothing says for which pose values of the joints are.
    NoPose,
    /// It is refuted as the robot, or what is given, is read, and nothing in the document bears that reading out.
    Unsupported,
    /// It is right at another configuration that the document states.
    OtherConfiguration,
    /// Nothing says how the masses of the links, or gravity, are meant so that it could be refuted.
    OpenReading,
    /// It is right in a reading that the words of the document contradict.
    AgainstWords(Spoken),
    /// A column of a table has a head that is not known.
    UnknownColumn,
    /// A table has other joints than the robot.
    OtherJoints,
    /// A table has names that are not the robot's.
    OtherNames,
    /// It is a torque for a load of which another torque has a component that is not known.
    OpenLoad,
    /// What the judge of values says.
    Values(Undecided),
}

/// What was done to a formula.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum SlipKind {
    /// A change of the formula.
    Formula(Slip),
    /// The arguments of `atan2` are exchanged.
    Arguments,
    /// It stands in another entry's place (row and column from 1), and that one in its place.
    ExchangedWith(usize, usize),
    /// The entry of another place.
    OtherEntry,
}

impl SlipKind {
    /// A word for programs: `lost-factor`.
    pub fn id(&self) -> &'static str {
        match self {
            SlipKind::Formula(slip) => slip.id(),
            SlipKind::Arguments => "arguments",
            SlipKind::ExchangedWith(..) => "transposed",
            SlipKind::OtherEntry => "entry",
        }
    }
}

/// A change of the robot, or of what is meant. Rows are counted from 1.
#[derive(Clone, PartialEq, Debug)]
pub enum Change {
    /// A cell with the opposite sign.
    Opposite(TableCell),
    /// A cell forgotten.
    Forgotten(TableCell),
    /// A cell exchanged with that of the next row.
    ExchangedWithNext(TableCell),
    /// The α of a row, in degrees.
    Alpha {
        /// The row.
        row: usize,
        /// Its α.
        degrees: i32,
    },
    /// The θ of a row with an offset more, in degrees.
    Offset {
        /// The row.
        row: usize,
        /// The offset.
        degrees: i32,
    },
    /// The θ of a row counted the other way.
    CountedBackwards(usize),
    /// The table read in another convention.
    Convention(Convention),
    /// The tool left out.
    NoTool,
    /// A parameter that is 0.
    Vanishing(Symbol),
    /// A definition of the document with a slip.
    Definition {
        /// The name that is defined.
        name: String,
        /// The slip.
        slip: SlipKind,
    },
}

/// A cell of a table: the letter of its column as printed, and its row.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct TableCell {
    /// The letter.
    pub letter: String,
    /// The row, from 1.
    pub row: usize,
}
