//! Products and sums of matrices as they are printed: matrices between names of matrices.

use super::facts::Meaning;
use super::lexis::Lexis;
use super::matrix::Matrix;
use super::names::{Name, Token, tokens};
use super::subject::Subject;
use denavit_reading::document::{Fence, Grid, Part, Side};
use denavit_symbolic::Expr;
use std::ops::Range;

/// A factor of a product.
#[derive(Clone, Debug)]
pub(super) enum Factor<'a> {
    /// A matrix in print.
    Grid(&'a Grid),
    /// What a name means, and what it is if the robot gives it.
    Named(Matrix, Option<Meaning>),
    /// A part in brackets.
    Worked,
    /// A number before a matrix.
    Scalar(Expr),
}

/// A side of an equation between matrices.
#[derive(Clone, Debug)]
pub(super) struct Product<'a> {
    /// The factors, where the side is a product.
    pub factors: Option<Vec<Factor<'a>>>,
    /// The value, if all that it needs is there.
    pub value: Option<Matrix>,
    /// What it is, where it is a product of names that the robot gives a meaning.
    pub about: Option<Meaning>,
}

enum Piece<'a> {
    Grid(&'a Grid),
    Token(Token),
    Scalar(Expr),
}

/// Why a side is no product of matrices.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum NotMatrices {
    /// It is something else.
    Other,
    /// A name without meaning.
    Unknown(Box<Name>),
}

/// Reads a side; `value` gives the matrix that a grid prints.
pub(super) fn product<'a>(
    text: &str,
    side: &'a Side,
    lexis: &Lexis,
    subject: &Subject,
    value: &dyn Fn(&Grid) -> Option<Matrix>,
) -> Result<Product<'a>, NotMatrices> {
    let mut pieces = vec![];
    for part in &side.parts {
        match part {
            Part::Matrix(grid) => pieces.push(Piece::Grid(grid)),
            Part::Text(span) => {
                let known = |word: &str| lexis.has_matrix(word);
                let is_factor = pieces.is_empty() && side.parts.len() > 1;
                let scalar = || factor(text, span, lexis).filter(|_| is_factor);
                match (tokens(text, span, &known), scalar()) {
                    (_, Some(value)) => pieces.push(Piece::Scalar(value)),
                    (Some(found), None) => pieces.extend(found.into_iter().map(Piece::Token)),
                    (None, None) => return Err(NotMatrices::Other),
                }
            }
        }
    }
    if pieces.is_empty() || pieces.len() > 200 {
        return Err(NotMatrices::Other);
    }
    let mut reader = Reader { pieces, at: 0, lexis, subject, value, depth: 0 };
    let found = reader.sum()?;
    if reader.at < reader.pieces.len() { Err(NotMatrices::Other) } else { Ok(found) }
}

/// A formula before a matrix, the sign of the product behind it left aside.
fn factor(text: &str, span: &Range<usize>, lexis: &Lexis) -> Option<Expr> {
    let source = text.get(span.clone())?;
    let mut bare = source.trim_end();
    for sign in ["\\cdot", "\\times", "*", "·", "\\,", "\\;", "."] {
        bare = bare.strip_suffix(sign).unwrap_or(bare).trim_end();
    }
    let value = lexis.formula(text, &(span.start..span.start + bare.len())).ok()?;
    (value.sign_choices() == 0).then(|| value.value())
}

struct Reader<'a, 'b> {
    pieces: Vec<Piece<'a>>,
    at: usize,
    lexis: &'b Lexis,
    subject: &'b Subject,
    value: &'b dyn Fn(&Grid) -> Option<Matrix>,
    depth: usize,
}

impl<'a> Reader<'a, '_> {
    fn token(&self) -> Option<&Token> {
        match self.pieces.get(self.at) {
            Some(Piece::Token(token)) => Some(token),
            _ => None,
        }
    }

    fn sum(&mut self) -> Result<Product<'a>, NotMatrices> {
        let mut is_minus = matches!(self.token(), Some(Token::Minus));
        if is_minus {
            return Err(NotMatrices::Other);
        }
        let mut sum = self.product()?;
        while let Some(Token::Plus | Token::Minus) = self.token() {
            is_minus = matches!(self.token(), Some(Token::Minus));
            self.at += 1;
            let term = self.product()?;
            let value = sum.value.zip(term.value).and_then(|(a, b)| a.plus(&b, is_minus));
            let both = sum.about.zip(term.about);
            let about = both.map(|(a, b)| Meaning::Sum { terms: [a, b].into(), is_difference: is_minus });
            sum = Product { factors: None, value, about };
        }
        Ok(sum)
    }

    fn product(&mut self) -> Result<Product<'a>, NotMatrices> {
        let mut factors = vec![];
        let mut value: Option<Matrix> = None;
        let mut abouts: Option<Vec<Meaning>> = Some(vec![]);
        let mut is_cross = false;
        loop {
            let is_first = factors.is_empty();
            let found = match self.pieces.get(self.at) {
                Some(Piece::Grid(grid)) => {
                    let grid: &'a Grid = grid;
                    self.at += 1;
                    abouts = None;
                    let value =
                        if grid.fence == Fence::Bars { self.determinant(grid) } else { (self.value)(grid) };
                    Some((Factor::Grid(grid), value))
                }
                Some(&Piece::Scalar(value)) => {
                    self.at += 1;
                    abouts = None;
                    Some((Factor::Scalar(value), Some(Matrix(vec![vec![Some(value)]]))))
                }
                Some(Piece::Token(Token::Name(name))) => {
                    let name = name.clone();
                    self.at += 1;
                    let Some((matrix, about)) = self.lexis.matrix(self.subject, &name) else {
                        return Err(NotMatrices::Unknown(Box::new(name)));
                    };
                    match (&mut abouts, &about) {
                        (Some(all), Some(about)) => all.push(about.clone()),
                        _ => abouts = None,
                    }
                    Some((Factor::Named(matrix.clone(), about), Some(matrix)))
                }
                Some(Piece::Token(Token::Open)) => {
                    self.at += 1;
                    self.depth += 1;
                    if self.depth > 20 {
                        return Err(NotMatrices::Other);
                    }
                    let inner = self.sum()?;
                    self.depth -= 1;
                    let Some(&Token::Close { is_inverse, is_transposed }) = self.token() else {
                        return Err(NotMatrices::Other);
                    };
                    self.at += 1;
                    let mut worked = inner.value;
                    if is_inverse {
                        worked = worked.and_then(|m| m.inverse());
                    }
                    if is_transposed {
                        worked = worked.map(|m| m.transposed());
                    }
                    match (&mut abouts, inner.about) {
                        (Some(all), Some(about)) => all.push(about),
                        _ => abouts = None,
                    }
                    Some((Factor::Worked, worked))
                }
                _ => None,
            };
            let Some((factor, mut found)) = found else {
                if is_first || is_cross {
                    return Err(NotMatrices::Other);
                }
                break;
            };
            if let Some(&Token::Power { is_inverse, is_transposed }) = self.token() {
                self.at += 1;
                if is_inverse {
                    found = found.and_then(|m| m.inverse());
                }
                if is_transposed {
                    found = found.map(|m| m.transposed());
                }
            }
            value = match (value, found) {
                (None, found) if is_first => found,
                (Some(a), Some(b)) => a.cross(&b).filter(|_| is_cross).or_else(|| a.times(&b)),
                _ => None,
            };
            factors.push(factor);
            is_cross = matches!(self.token(), Some(Token::Times));
            self.at += usize::from(matches!(self.token(), Some(Token::Times | Token::Dot)));
        }
        let about = abouts.map(Meaning::product);
        Ok(Product { factors: Some(factors), value, about })
    }

    /// The value of a determinant; with i, j, k in its first row it is the product of two vectors.
    fn determinant(&self, grid: &Grid) -> Option<Matrix> {
        let m = (self.value)(grid)?;
        let unit = |c: usize| m.entry(0, c).and_then(|e| e.as_symbol()).map(|s| s.name().to_string());
        if m.shape() == Some((3, 3)) && [0, 1, 2].map(unit) == ["i", "j", "k"].map(|s| Some(s.to_string())) {
            let row = |r: usize| Matrix((0..3).map(|c| vec![m.entry(r, c)]).collect());
            return row(1).cross(&row(2));
        }
        m.determinant().map(|d: Expr| Matrix(vec![vec![Some(d)]]))
    }
}
