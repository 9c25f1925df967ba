//! Rotation matrices.
//!
//! `r_ab` holds the axes of frame `b`, seen from frame `a`, in its columns x, y, z. The literature calls these
//! columns n, o, a (Paul 1981) or s, n, a (Khalil and Dombre 2002).
//! Angles are in radians and positive by the right-hand rule.

use super::vector::{Axis, Vector, three};
use crate::scalar::Scalar;
use std::fmt;
use std::ops::{Index, Mul};

/// How far a matrix that is given as a rotation may be from one, as [`Rotation::orthonormality_error`]:
/// entries printed with six decimals pass.
pub const RIGID_TOLERANCE: f64 = 1e-5;

/// A 3×3 rotation matrix, row-major.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Rotation<T>([[T; 3]; 3]);

/// Why a matrix is not a rotation or a rigid transform.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum NotRigid {
    /// An entry is infinite or not a number; rows and columns count from 0.
    NotFinite {
        /// The row of the entry.
        row: usize,
        /// The column of the entry.
        column: usize,
    },
    /// The columns are not orthogonal unit vectors.
    NotOrthonormal {
        /// The largest entry of |RᵀR − 1|.
        error: f64,
    },
    /// Orthonormal with determinant −1: a mirror image, a left-handed frame.
    Mirrored,
    /// The last row of a 4×4 matrix is not 0 0 0 1.
    LastRow([f64; 4]),
}

impl<T: Scalar> Rotation<T> {
    /// No rotation.
    #[inline]
    pub fn identity() -> Self {
        Rotation(Axis::ALL.map(|a| Vector::unit(a).0))
    }

    /// The rotation about x by an angle in radians.
    pub fn about_x(angle: T) -> Self {
        Self::about(Axis::X, angle)
    }

    /// The rotation about y by an angle in radians.
    pub fn about_y(angle: T) -> Self {
        Self::about(Axis::Y, angle)
    }

    /// The rotation about z by an angle in radians.
    pub fn about_z(angle: T) -> Self {
        Self::about(Axis::Z, angle)
    }

    /// The rotation about a coordinate axis by an angle in radians.
    pub fn about(axis: Axis, angle: T) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self::from_sin_cos(axis, sin, cos)
    }

    /// The rotation about a coordinate axis by the angle with this sine and cosine (sin² + cos² = 1 is the
    /// caller's word).
    pub fn from_sin_cos(axis: Axis, sin: T, cos: T) -> Self {
        let (s, c, o, i) = (sin, cos, T::zero(), T::one());
        Rotation(match axis {
            Axis::X => [[i, o, o], [o, c, -s], [o, s, c]],
            Axis::Y => [[c, o, s], [o, i, o], [-s, o, c]],
            Axis::Z => [[c, -s, o], [s, c, o], [o, o, i]],
        })
    }

    /// Roll, pitch and yaw in radians about the fixed axes x, y and z, in this order: Rz(yaw)·Ry(pitch)·Rx(roll),
    /// the `rpy` of URDF (Siciliano et al., *Robotics*, 2009, section 2.4.2).
    pub fn from_rpy(roll: T, pitch: T, yaw: T) -> Self {
        Self::about_z(yaw) * Self::about_y(pitch) * Self::about_x(roll)
    }

    /// The matrix with these rows, unchecked: that it is a rotation is the caller's word.
    /// [`Rotation::from_matrix`] checks numbers.
    #[inline]
    pub fn from_rows(rows: [[T; 3]; 3]) -> Self {
        Rotation(rows)
    }

    /// The rows.
    #[inline]
    pub fn rows(&self) -> [[T; 3]; 3] {
        self.0
    }

    /// The first column: axis x of the rotated frame (n; s in Khalil's letters).
    #[inline]
    pub fn x(&self) -> Vector<T> {
        self.column(Axis::X)
    }

    /// The second column: axis y of the rotated frame (o; n in Khalil's letters).
    #[inline]
    pub fn y(&self) -> Vector<T> {
        self.column(Axis::Y)
    }

    /// The third column: axis z of the rotated frame (a, the approach direction of a hand).
    #[inline]
    pub fn z(&self) -> Vector<T> {
        self.column(Axis::Z)
    }

    /// An axis of the rotated frame.
    #[inline]
    pub fn column(&self, axis: Axis) -> Vector<T> {
        Vector(three(|i| self.0[i][axis.index()]))
    }

    /// r_ba from r_ab: the transpose.
    #[inline]
    pub fn inverse(&self) -> Self {
        Rotation(three(|i| three(|j| self.0[j][i])))
    }

    /// The determinant: 1 for a rotation.
    pub fn determinant(&self) -> T {
        self.x().dot(self.y().cross(self.z()))
    }

    /// The same matrix in another scalar type.
    #[inline]
    pub fn map<U>(&self, mut f: impl FnMut(T) -> U) -> Rotation<U> {
        Rotation(self.0.map(|row| row.map(&mut f)))
    }
}

impl Rotation<f64> {
    /// The rotation with these rows, kept as given.
    ///
    /// # Errors
    /// If an entry is not finite, the columns are not orthonormal within [`RIGID_TOLERANCE`], or the
    /// determinant is −1.
    pub fn from_matrix(rows: [[f64; 3]; 3]) -> Result<Self, NotRigid> {
        for (row, entries) in rows.iter().enumerate() {
            if let Some(column) = entries.iter().position(|x| !x.is_finite()) {
                return Err(NotRigid::NotFinite { row, column });
            }
        }
        let r = Rotation(rows);
        let error = r.orthonormality_error();
        if error > RIGID_TOLERANCE {
            return Err(NotRigid::NotOrthonormal { error });
        }
        if r.determinant() < 0.0 {
            return Err(NotRigid::Mirrored);
        }
        Ok(r)
    }

    /// The largest entry of |RᵀR − 1|: 0 for columns that are orthogonal unit vectors; infinite where entries
    /// are not numbers or overflow.
    pub fn orthonormality_error(&self) -> f64 {
        let mut worst = 0.0;
        for a in Axis::ALL {
            for b in Axis::ALL {
                let wanted = if a == b { 1.0 } else { 0.0 };
                let error = (self.column(a).dot(self.column(b)) - wanted).abs();
                worst = if error.is_nan() { f64::INFINITY } else { error.max(worst) };
            }
        }
        worst
    }
}

/// The entry in (row, column), counted from 0.
///
/// # Panics
/// If an index is not below 3.
impl<T> Index<(usize, usize)> for Rotation<T> {
    type Output = T;
    #[inline]
    fn index(&self, (row, column): (usize, usize)) -> &T {
        &self.0[row][column]
    }
}

/// r_ac = r_ab · r_bc
impl<T: Scalar> Mul for Rotation<T> {
    type Output = Self;
    #[inline]
    fn mul(self, r_bc: Self) -> Self {
        let (rows, [x, y, z]) = (self.0, r_bc.0);
        let entry = |[a, b, c]: [T; 3], j: usize| a * x[j] + b * y[j] + c * z[j];
        Rotation(three(|i| three(|j| entry(rows[i], j))))
    }
}

/// v_a = r_ab · v_b
impl<T: Scalar> Mul<Vector<T>> for Rotation<T> {
    type Output = Vector<T>;
    #[inline]
    fn mul(self, v_b: Vector<T>) -> Vector<T> {
        Vector(three(|i| Vector(self.0[i]).dot(v_b)))
    }
}

impl fmt::Display for NotRigid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NotRigid::NotFinite { row, column } => {
                write!(f, "the entry in row {}, column {} is not a finite number", row + 1, column + 1)
            }
            NotRigid::NotOrthonormal { error } => write!(
                f,
                "the columns of the rotation are not orthogonal unit vectors (off by {error:.1e}, \
                 allowed is {RIGID_TOLERANCE:.0e})"
            ),
            NotRigid::Mirrored => f.write_str(
                "the rotation has determinant −1: it is a mirror image; one axis has the wrong sign, or two are swapped",
            ),
            NotRigid::LastRow([a, b, c, d]) => {
                write!(f, "the last row is {a} {b} {c} {d}, not 0 0 0 1")?;
                match [*a, *b, *c] != [0.0; 3] && *d == 1.0 {
                    true => f.write_str(" (a translation there belongs into the last column: transposed matrix?)"),
                    false => Ok(()),
                }
            }
        }
    }
}

impl std::error::Error for NotRigid {}
