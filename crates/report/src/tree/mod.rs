//! What documents are made of: headings, paragraphs, formulas, lists, a tree of branches; no notation.

mod lines;
mod math;

pub use denavit_symbolic::print::BrokenLine;
pub use lines::{Laid, aligned, laid, matrix_width};
pub use math::math;

use denavit_symbolic::Expr;

/// A part of a document.
#[derive(Clone, Debug)]
pub enum Block {
    /// A heading: level 1 for the document, 2 and 3 inside.
    Heading(u8, Line),
    /// Running text.
    Paragraph(Line),
    /// A formula on a line of its own.
    Formula {
        /// The formula.
        math: Math,
        /// The number by which the text refers to it.
        number: Option<usize>,
        /// Whether it is proved; nothing for definitions.
        proof: Option<Proof>,
    },
    /// Remarks.
    List(Vec<Line>),
    /// The branches.
    Tree(Branch),
}

/// What is known of a formula.
#[derive(Clone, Copy, PartialEq, Eq, Debug, PartialOrd, Ord)]
pub enum Proof {
    /// It follows identically from the robot's own chain of matrices.
    Proved,
    /// It holds at sample poses; the expansion was too large to decide.
    Sampled,
    /// It does not hold.
    Wrong,
}

/// Text with formulas in it.
#[derive(Clone, Debug, Default)]
pub struct Line(pub Vec<Piece>);

/// A part of a line.
#[derive(Clone, Debug)]
pub enum Piece {
    /// Words.
    Text(String),
    /// Words that stand out.
    Strong(String),
    /// A formula.
    Math(Math),
}

impl Line {
    /// A line that starts with words.
    pub fn new(text: impl Into<String>) -> Self {
        Line::default().text(text)
    }

    /// Words.
    #[must_use]
    pub fn text(mut self, text: impl Into<String>) -> Self {
        let text = text.into();
        match self.0.last_mut() {
            Some(Piece::Text(before)) => before.push_str(&text),
            _ if text.is_empty() => {}
            _ => self.0.push(Piece::Text(text)),
        }
        self
    }

    /// Words that stand out.
    #[must_use]
    pub fn strong(mut self, text: impl Into<String>) -> Self {
        self.0.push(Piece::Strong(text.into()));
        self
    }

    /// A formula.
    #[must_use]
    pub fn math(mut self, math: impl Into<Math>) -> Self {
        self.0.push(Piece::Math(math.into()));
        self
    }

    /// Several formulas with commas between them.
    #[must_use]
    pub fn list(self, all: impl IntoIterator<Item = Math>) -> Self {
        self.numbers(all, ", ")
    }

    /// Several formulas, which may be numbers, with what stands between numbers in a language.
    #[must_use]
    pub fn numbers(mut self, all: impl IntoIterator<Item = Math>, between: &str) -> Self {
        for (k, math) in all.into_iter().enumerate() {
            if k > 0 {
                self = self.text(between);
            }
            self = self.math(math);
        }
        self
    }
}

/// A formula.
#[derive(Clone, Debug)]
pub enum Math {
    /// An expression.
    Expr(Expr),
    /// Expressions with signs between them: a ≤ b ≤ c.
    Chain(Expr, Vec<(Sign, Expr)>),
    /// A product of matrices.
    Product(Vec<Factor>),
    /// An equation of two products.
    Products(Vec<Factor>, Vec<Factor>),
    /// A matrix by its entries.
    Matrix(Factor, Vec<Vec<Expr>>),
    /// A matrix of decimal numbers, digits with a hyphen for a minus sign.
    Numbers(Factor, Vec<Vec<String>>),
    /// The determinant of a matrix.
    Determinant(Factor, Expr),
    /// A decimal number with its unit.
    Quantity {
        /// What it is the value of.
        of: Expr,
        /// Whether it is the value of its velocity.
        is_rate: bool,
        /// The number, a hyphen for its minus sign.
        digits: String,
        /// `°`, `m`, `rad/s`.
        unit: &'static str,
    },
}

impl From<Expr> for Math {
    fn from(e: Expr) -> Self {
        Math::Expr(e)
    }
}

impl Math {
    /// a = b
    pub fn equation(a: Expr, b: Expr) -> Self {
        Math::Chain(a, vec![(Sign::Equal, b)])
    }

    /// One relation.
    pub fn relation(a: Expr, sign: Sign, b: Expr) -> Self {
        Math::Chain(a, vec![(sign, b)])
    }

    /// All expressions in it.
    pub fn exprs(&self) -> Vec<Expr> {
        match self {
            Math::Expr(e) | Math::Determinant(_, e) | Math::Quantity { of: e, .. } => vec![*e],
            Math::Chain(a, rest) => [*a].into_iter().chain(rest.iter().map(|r| r.1)).collect(),
            Math::Product(_) | Math::Products(..) | Math::Numbers(..) => vec![],
            Math::Matrix(_, rows) => rows.iter().flatten().copied().collect(),
        }
    }
}

/// A sign between expressions.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Sign {
    /// =
    Equal,
    /// ≠
    Different,
    /// <
    Less,
    /// ≤
    AtMost,
    /// ≥
    AtLeast,
    /// ±: equal to plus or minus what follows
    EitherSign,
}

/// A matrix of a product.
#[derive(Clone, PartialEq, Debug)]
pub enum Factor {
    /// A named matrix: A2(q2), U, T; `power` −1 for its inverse.
    Named {
        /// The letter.
        letter: &'static str,
        /// Its number.
        number: Option<usize>,
        /// What it depends on, where that is to be said.
        of: Option<Expr>,
        /// Whether its inverse is meant.
        inverse: bool,
    },
    /// A named matrix with a letter as its index: Jv.
    Indexed(&'static str, char),
    /// The pose of a frame in another: T with both names.
    Frame {
        /// The frame it is seen from.
        from: String,
        /// The frame that is seen.
        to: String,
    },
    /// A turn about an axis by an angle.
    Rotation(char, Expr),
    /// A displacement.
    Translation([Expr; 3]),
    /// The inverse of one of those above.
    Inverse(Box<Factor>),
    /// Any other constant matrix, the upper three rows.
    Constant(Vec<Vec<Expr>>),
}

impl Factor {
    /// A matrix with a letter.
    pub fn named(letter: &'static str) -> Self {
        Factor::Named { letter, number: None, of: None, inverse: false }
    }

    /// The inverse.
    #[must_use]
    pub fn inverse(self) -> Self {
        match self {
            Factor::Named { letter, number, of, inverse } => {
                Factor::Named { letter, number, of, inverse: !inverse }
            }
            // Half a turn is its own inverse.
            Factor::Rotation(axis, angle) if angle == Expr::pi() => Factor::Rotation(axis, angle),
            Factor::Rotation(axis, angle) => Factor::Rotation(axis, -angle),
            Factor::Translation(p) => Factor::Translation(p.map(|x| -x)),
            Factor::Inverse(of) => *of,
            other @ (Factor::Constant(_) | Factor::Frame { .. } | Factor::Indexed(..)) => {
                Factor::Inverse(Box::new(other))
            }
        }
    }
}

/// A node of the solution tree.
#[derive(Clone, Debug)]
pub struct Branch {
    /// What is found here.
    pub line: Line,
    /// What follows.
    pub children: Vec<Branch>,
}
