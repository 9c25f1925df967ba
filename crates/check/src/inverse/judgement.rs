//! What is asked about printed values and what is answered.

use denavit_symbolic::factor::Zero;
use denavit_symbolic::{Expr, Symbol};

/// Values for one or several joint variables, or sums of them.
#[derive(Clone, Debug)]
pub struct Values {
    /// What is found: an expression in joint variables, `q3` or `q2 + q3 + q4`; `cos q6` is compared as a number.
    pub of: Vec<Expr>,
    /// The alternatives, every ± chosen; in each one expression per unknown.
    pub branches: Vec<Vec<Expr>>,
    /// The arm alone: the pose is that of the frame behind this many rows of the table.
    pub of_first_rows: Option<usize>,
}

/// The answer about an equation or about values.
#[derive(Clone, Debug)]
pub struct Judgement {
    /// In a word.
    pub verdict: Verdict,
    /// What it rests on.
    pub grounds: Grounds,
    /// For each branch where it is right; for an equation, where it holds.
    pub branches: Vec<Where>,
    /// What the values leave out of the solutions.
    pub missing: Option<Missing>,
    /// Branches (from 0) whose values belong to no solution somewhere, though they are defined.
    pub extra: Vec<usize>,
    /// What is wrong, and remarks.
    pub faults: Vec<Fault>,
    /// Numbers at which it is wrong.
    pub counterexample: Option<Counterexample>,
    /// What would be right.
    pub right: Option<Right>,
    /// The identities that prove it: of an angle, that the sine of its difference to the joint's own, times a length, is 0.
    pub identities: Vec<[Expr; 2]>,
}

/// The verdict in a word.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Verdict {
    /// The values are those of the solutions and no others; the equation holds.
    Right,
    /// All values belong to solutions, but some solutions are left out.
    Incomplete,
    /// Right in a part of all configurations.
    Conditional,
    /// Right nowhere, but for single configurations.
    Wrong,
    /// Nothing follows.
    Undecided(Undecided),
}

/// Why nothing follows.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Undecided {
    /// A symbol is neither a joint variable, a parameter nor an entry of the pose.
    UnknownSymbol(Symbol),
    /// A branch has another number of formulas than there are unknowns; there is no branch, or there are hundreds.
    Shape,
    /// The formula contains what it is for.
    Circular,
    /// There is no number for the formula at any sample.
    NeverDefined,
    /// The robot has no samples: no joint, or a part of the table that is not there.
    NoSamples,
    /// The arm's solutions cannot be enumerated, and the values are not those of the configuration everywhere.
    NoEnumeration,
}

/// What a verdict rests on.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Grounds {
    /// True if an identity in the joint variables proves that every configuration is among the values (where the
    /// branch's condition holds), or that the equation holds; a refutation by numbers counts as proved.
    pub proved: bool,
    /// Random poses, each compared in all solutions.
    pub poses: usize,
    /// Special ones beside: joints at 0, ±π/2, π.
    pub special: usize,
    /// How far values that count as right are from the configuration's own, at half of the poses or more: rounding, or what
    /// only looks right. Radians, lengths by the arm's size.
    pub apart: f64,
}

/// Where a branch is right.
#[derive(Clone, PartialEq, Debug)]
pub enum Where {
    /// Everywhere.
    Everywhere,
    /// Nowhere.
    Nowhere,
    /// Where all of these are positive.
    If(Vec<Expr>),
    /// In this share of the samples, for a reason that was not found.
    Partly(f64),
}

/// Solutions that are left out.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Missing {
    /// The share of poses at which a solution is left out.
    pub poses: f64,
    /// The most different values that the formulas give and that are right.
    pub given: usize,
    /// The most that there are.
    pub existing: usize,
}

/// The function that loses a sign.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Cause {
    /// An arctangent of a quotient.
    Arctan,
    /// An arcsine.
    Arcsin,
    /// An arccosine.
    Arccos,
    /// An arctangent of two arguments that both have the wrong sign somewhere.
    Atan2,
    /// A square root.
    Root,
    /// Something else.
    Other,
}

/// What is wrong, or worth a remark.
#[derive(Clone, PartialEq, Debug)]
pub enum Fault {
    /// Right where the conditions are positive only.
    WrongQuadrant {
        /// The branch, from 0.
        branch: usize,
        /// What loses the sign.
        cause: Cause,
        /// What must be positive.
        conditions: Vec<Expr>,
    },
    /// Solutions are left out; see [`Judgement::missing`].
    MissingBranch,
    /// The branch belongs to no solution in this share of the poses.
    ExtraBranch {
        /// The branch, from 0.
        branch: usize,
        /// The share.
        share: f64,
    },
    /// The branch is not a number in this share of the poses, all of which the arm reaches.
    OutOfDomain {
        /// The branch, from 0.
        branch: usize,
        /// The share.
        share: f64,
    },
    /// A divisor vanishes.
    DivisionByZero {
        /// The divisor as printed.
        divisor: Expr,
        /// What vanishes of it, by the table.
        factor: Expr,
        /// Its zeros solved for an angle.
        zeros: Vec<Zero>,
        /// A configuration at which it does.
        at: Option<Vec<f64>>,
        /// True if the unknown is not determined there, so that no formula could give it, and for an equation, which
        /// says nothing there: then this is a remark.
        is_singular: bool,
    },
    /// Wrong at a special configuration, though right around it, and though the pose determines the unknown there.
    FailsAt(Vec<f64>),
    /// Left side minus right side of an equation that does not hold, by the table.
    Residual(Expr),
}

impl Fault {
    /// True if a right formula may have it, too.
    pub fn is_remark(&self) -> bool {
        matches!(self, Fault::DivisionByZero { is_singular: true, .. })
    }
}

/// Numbers at which a formula is wrong.
#[derive(Clone, PartialEq, Debug)]
pub struct Counterexample {
    /// The joint variables, radians and metres.
    pub q: Vec<f64>,
    /// The entries of the pose by rows.
    pub pose: Vec<f64>,
    /// What each branch gives (radians or metres); both sides of an equation.
    pub printed: Vec<Vec<f64>>,
    /// What the solutions have that agree in the joints found before.
    pub right: Vec<Vec<f64>>,
}

/// A formula that is right.
#[derive(Clone, Debug)]
pub struct Right {
    /// What is found.
    pub of: Vec<Expr>,
    /// The alternatives.
    pub branches: Vec<Vec<Expr>>,
    /// What it needs of the joint variables.
    pub known: Vec<Expr>,
    /// Where it comes from.
    pub origin: Origin,
}

/// Where a right formula comes from.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Origin {
    /// The printed formula with other functions or signs.
    Mended,
    /// Two entries of the pose, seen from frames that are known, that are the unknown's sine and cosine.
    Entries,
    /// A step of the derived inverse model.
    Derived,
}

/// What all printed formulas together yield, one after another.
#[derive(Clone, PartialEq, Debug)]
pub struct Composed {
    /// Random poses.
    pub poses: usize,
    /// Solutions that they have together.
    pub existing: usize,
    /// Solutions that the formulas yield.
    pub yielded: usize,
    /// Configurations that the formulas yield and that are none.
    pub spurious: usize,
    /// Joint variables that no formula is for; then nothing is counted.
    pub open: Vec<Symbol>,
}

impl Judgement {
    /// Nothing follows.
    pub(super) fn undecided(why: Undecided) -> Self {
        Judgement {
            verdict: Verdict::Undecided(why),
            grounds: Grounds::default(),
            branches: vec![],
            missing: None,
            extra: vec![],
            faults: vec![],
            counterexample: None,
            right: None,
            identities: vec![],
        }
    }
}
