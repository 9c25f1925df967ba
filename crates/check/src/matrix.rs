//! Matrices of formulas, some entries of which may be left out.

use denavit::geometry::{Rotation, Transform, Vector};
use denavit_reading::slip::Points;
use denavit_symbolic::Expr;

/// A matrix by rows. Rows of a printed one may differ in length; an entry that is left out is `None`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Matrix(pub Vec<Vec<Option<Expr>>>);

impl Matrix {
    /// The homogeneous matrix of a transform.
    pub fn of(x: &Transform<Expr>) -> Self {
        Matrix(x.matrix().iter().map(|row| row.iter().map(|&e| Some(e)).collect()).collect())
    }

    /// The 3×3 matrix of a rotation.
    pub fn of_rotation(r: &Rotation<Expr>) -> Self {
        Matrix(r.rows().iter().map(|row| row.iter().map(|&e| Some(e)).collect()).collect())
    }

    /// A column.
    pub fn column(v: &Vector<Expr>) -> Self {
        Matrix(v.0.iter().map(|&e| vec![Some(e)]).collect())
    }

    /// Rows and columns, if all rows have the same length.
    pub fn shape(&self) -> Option<(usize, usize)> {
        let columns = self.0.first()?.len();
        self.0.iter().all(|r| r.len() == columns).then_some((self.0.len(), columns))
    }

    pub fn entry(&self, r: usize, c: usize) -> Option<Expr> {
        *self.0.get(r)?.get(c)?
    }

    pub fn transposed(&self) -> Self {
        let columns = self.0.iter().map(Vec::len).max().unwrap_or(0);
        Matrix((0..columns).map(|c| (0..self.0.len()).map(|r| self.entry(r, c)).collect()).collect())
    }

    /// The product; an entry that an entry left out takes part in is left out, unless its factor is 0.
    pub fn times(&self, o: &Self) -> Option<Self> {
        let ((rows, inner), (inner_too, columns)) = (self.shape()?, o.shape()?);
        if (rows, inner) == (1, 1) {
            let k = self.entry(0, 0)?;
            return Some(Matrix(o.0.iter().map(|r| r.iter().map(|e| e.map(|e| k * e)).collect()).collect()));
        }
        if inner != inner_too {
            return None;
        }
        let product = |r: usize, c: usize| {
            (0..inner).try_fold(Expr::int(0), |sum, k| {
                let (a, b) = (self.entry(r, k), o.entry(k, c));
                match (a, b) {
                    (Some(a), _) if a.is_zero() => Some(sum),
                    (_, Some(b)) if b.is_zero() => Some(sum),
                    (Some(a), Some(b)) => Some(sum + a * b),
                    _ => None,
                }
            })
        };
        Some(Matrix((0..rows).map(|r| (0..columns).map(|c| product(r, c)).collect()).collect()))
    }

    /// The sum, or the difference.
    pub fn plus(&self, o: &Self, is_minus: bool) -> Option<Self> {
        if self.shape()? != o.shape()? {
            return None;
        }
        let add = |a: Option<Expr>, b: Option<Expr>| Some(if is_minus { a? - b? } else { a? + b? });
        let rows = self.0.iter().zip(&o.0);
        Some(Matrix(rows.map(|(a, b)| a.iter().zip(b).map(|(&a, &b)| add(a, b)).collect()).collect()))
    }

    /// The product of two columns of three.
    pub fn cross(&self, o: &Self) -> Option<Self> {
        if self.shape()? != (3, 1) || o.shape()? != (3, 1) {
            return None;
        }
        let vector = |m: &Self| Some(Vector([m.entry(0, 0)?, m.entry(1, 0)?, m.entry(2, 0)?]));
        Some(Matrix::column(&vector(self)?.cross(vector(o)?)))
    }

    /// All entries divided by a factor.
    pub fn divided_by(&self, factor: Expr) -> Self {
        Matrix(self.0.iter().map(|r| r.iter().map(|e| e.map(|e| e / factor)).collect()).collect())
    }

    /// The inverse: of a rotation or a rigid motion as such, of another small matrix by its cofactors.
    pub fn inverse(&self) -> Option<Self> {
        let (rows, columns) = self.shape()?;
        if rows != columns || rows > 4 {
            return None;
        }
        if rows >= 3 && self.is_rigid() {
            return self.rigid_inverse();
        }
        let determinant = self.determinant()?;
        if determinant.is_zero() {
            return None;
        }
        let minor = |r: usize, c: usize| {
            let kept = self.0.iter().enumerate().filter(|x| x.0 != r).map(|(_, row)| {
                row.iter().enumerate().filter(|x| x.0 != c).map(|x| *x.1).collect::<Vec<Option<Expr>>>()
            });
            let rest: Vec<Vec<Option<Expr>>> = kept.collect();
            if rest.is_empty() { Some(Expr::int(1)) } else { Matrix(rest).determinant() }
        };
        let mut inverse = vec![vec![None; rows]; rows];
        for (r, row) in inverse.iter_mut().enumerate() {
            for (c, entry) in row.iter_mut().enumerate() {
                let cofactor = minor(c, r)?;
                *entry = Some(if (r + c) % 2 == 0 { cofactor } else { -cofactor } / determinant);
            }
        }
        Some(Matrix(inverse))
    }

    /// True if the first three rows and columns are a rotation, and a fourth row says nothing; entries left out count as right.
    fn is_rigid(&self) -> bool {
        let mut points = Points::new(17);
        let mut is =
            |e: Option<Expr>, n: i64| e.is_none_or(|e| points.value(e) == points.value(Expr::int(n)));
        let rows = || (0..3).flat_map(|i| (i..3).map(move |j| (i, j)));
        let dot = |i: usize, j: usize| {
            (0..3).try_fold(Expr::int(0), |sum, k| Some(sum + self.entry(i, k)? * self.entry(j, k)?))
        };
        let turns = rows().all(|(i, j)| is(dot(i, j), i64::from(i == j)));
        let last = self.0.len() == 3 || (0..4).all(|c| is(self.entry(3, c), i64::from(c == 3)));
        turns && last
    }

    /// The inverse of a rotation or a homogeneous matrix, as such.
    fn rigid_inverse(&self) -> Option<Self> {
        let at = |r: usize, c: usize| self.entry(r, c);
        let rotation = || {
            let mut rows = [[Expr::int(0); 3]; 3];
            for (r, row) in rows.iter_mut().enumerate() {
                for (c, entry) in row.iter_mut().enumerate() {
                    *entry = at(r, c)?;
                }
            }
            Some(Rotation::from_rows(rows))
        };
        match self.shape()? {
            (3, 3) => Some(Matrix::of_rotation(&rotation()?.inverse())),
            (4, 4) => {
                let position = Vector([at(0, 3)?, at(1, 3)?, at(2, 3)?]);
                Some(Matrix::of(&Transform::from_rotation_translation(rotation()?, position).inverse()))
            }
            _ => None,
        }
    }

    /// The determinant of a small square matrix, by its first row.
    pub fn determinant(&self) -> Option<Expr> {
        let (n, columns) = self.shape()?;
        if n != columns || n > 6 {
            return None;
        }
        if n == 1 {
            return self.entry(0, 0);
        }
        (0..n).try_fold(Expr::int(0), |sum, c| {
            let head = self.entry(0, c)?;
            if head.is_zero() {
                return Some(sum);
            }
            let rest = self.0[1..].iter().map(|row| {
                row.iter().enumerate().filter(|e| e.0 != c).map(|e| *e.1).collect::<Vec<Option<Expr>>>()
            });
            let minor = Matrix(rest.collect()).determinant()?;
            Some(if c % 2 == 0 { sum + head * minor } else { sum - head * minor })
        })
    }

    /// The first three rows and columns of a 4×4 matrix.
    pub fn rotation_part(&self) -> Self {
        Matrix(self.0.iter().take(3).map(|r| r.iter().take(3).copied().collect()).collect())
    }
}
