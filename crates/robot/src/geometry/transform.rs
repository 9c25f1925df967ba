//! Rigid transforms: a rotation and a translation, written as a homogeneous 4×4 matrix (Denavit and
//! Hartenberg 1955; Paul 1981, ch. 1).
//!
//! ```
//! use denavit::geometry::{Transform, Vector};
//! use std::f64::consts::FRAC_PI_2;
//!
//! // A camera one metre above the origin of a table, turned a quarter turn about the vertical.
//! let x_table_camera = Transform::translation(0.0, 0.0, 1.0) * Transform::rotation_z(FRAC_PI_2);
//!
//! // It sees a cup half a metre ahead on its x axis; on the table that is y.
//! let cup_table = x_table_camera.act_on_point(Vector([0.5, 0.0, -1.0]));
//! assert!((cup_table - Vector([0.0, 0.5, 0.0])).norm() < 1e-15);
//!
//! // A direction has no place, so only the rotation acts on it.
//! let ahead_table = x_table_camera.act_on_vector(Vector([1.0, 0.0, 0.0]));
//! assert!((ahead_table - Vector([0.0, 1.0, 0.0])).norm() < 1e-15);
//!
//! let x_camera_table = x_table_camera.inverse();
//! let cup_camera = x_camera_table.act_on_point(cup_table);
//! assert!((cup_camera - Vector([0.5, 0.0, -1.0])).norm() < 1e-15);
//! ```
//!
//! With formulas instead of numbers, the same code gives the link transform of a table's row:
//!
//! ```
//! use denavit::geometry::Transform;
//! use denavit_symbolic::Expr;
//!
//! let (theta, a) = (Expr::symbol("theta1"), Expr::symbol("a1"));
//! let link = Transform::rotation_z(theta) * Transform::translation_x(a); // Rz(θ)·Tx(a)
//! assert_eq!(link.matrix()[0], [theta.cos(), -theta.sin(), Expr::int(0), theta.cos() * a]);
//! ```

use super::rotation::{NotRigid, RIGID_TOLERANCE, Rotation};
use super::vector::{Axis, Vector};
use crate::scalar::Scalar;
use std::ops::Mul;

/// Frame `b` seen from frame `a`: `x_ab`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Transform<T> {
    /// The axes of `b`, in coordinates of `a`, as columns.
    pub rotation: Rotation<T>,
    /// The origin of `b`, in coordinates of `a` (metres).
    pub translation: Vector<T>,
}

impl<T: Scalar> Transform<T> {
    /// The same frame.
    #[inline]
    pub fn identity() -> Self {
        Self::from_rotation_translation(Rotation::identity(), Vector::zero())
    }

    /// First the translation (in `a`), then the rotation about the new origin.
    #[inline]
    pub fn from_rotation_translation(rotation: Rotation<T>, translation: Vector<T>) -> Self {
        Transform { rotation, translation }
    }

    /// Trans(x, y, z), in metres.
    pub fn translation(x: T, y: T, z: T) -> Self {
        Self::from_rotation_translation(Rotation::identity(), Vector([x, y, z]))
    }

    /// Tx(a), in metres: the link length of a Denavit–Hartenberg table.
    pub fn translation_x(a: T) -> Self {
        Self::translation(a, T::zero(), T::zero())
    }

    /// Ty(b), in metres.
    pub fn translation_y(b: T) -> Self {
        Self::translation(T::zero(), b, T::zero())
    }

    /// Tz(d), in metres: the link offset of a Denavit–Hartenberg table.
    pub fn translation_z(d: T) -> Self {
        Self::translation(T::zero(), T::zero(), d)
    }

    /// Rx(α), in radians: the twist of a Denavit–Hartenberg table.
    pub fn rotation_x(alpha: T) -> Self {
        Self::rotation_about(Axis::X, alpha)
    }

    /// Ry(β), in radians.
    pub fn rotation_y(beta: T) -> Self {
        Self::rotation_about(Axis::Y, beta)
    }

    /// Rz(θ), in radians: the joint angle of a Denavit–Hartenberg table.
    pub fn rotation_z(theta: T) -> Self {
        Self::rotation_about(Axis::Z, theta)
    }

    /// The rotation about a coordinate axis by an angle in radians.
    pub fn rotation_about(axis: Axis, angle: T) -> Self {
        Self::from_rotation_translation(Rotation::about(axis, angle), Vector::zero())
    }

    /// x_ba from x_ab: [Rᵀ, −Rᵀp].
    #[inline]
    pub fn inverse(&self) -> Self {
        let r_ba = self.rotation.inverse();
        Self::from_rotation_translation(r_ba, -(r_ba * self.translation))
    }

    /// The coordinates in `a` of a point given in `b`: R·p + t.
    #[inline]
    pub fn act_on_point(&self, p_b: Vector<T>) -> Vector<T> {
        self.rotation * p_b + self.translation
    }

    /// The coordinates in `a` of a free vector (a direction, a velocity, a force) given in `b`: R·v.
    #[inline]
    pub fn act_on_vector(&self, v_b: Vector<T>) -> Vector<T> {
        self.rotation * v_b
    }

    /// The homogeneous matrix, row-major, with the last row 0 0 0 1.
    pub fn matrix(&self) -> [[T; 4]; 4] {
        let ([x, y, z], p, o) = (self.rotation.rows(), self.translation.0, T::zero());
        [[x[0], x[1], x[2], p[0]], [y[0], y[1], y[2], p[1]], [z[0], z[1], z[2], p[2]], [o, o, o, T::one()]]
    }

    /// The same transform in another scalar type.
    #[inline]
    pub fn map<U>(&self, mut f: impl FnMut(T) -> U) -> Transform<U> {
        Transform { rotation: self.rotation.map(&mut f), translation: self.translation.map(&mut f) }
    }
}

impl Transform<f64> {
    /// The transform of a homogeneous matrix, row-major; rotation and translation are kept as given.
    ///
    /// # Errors
    /// If an entry is not finite, the last row is not 0 0 0 1, the rotation is not orthonormal (both within
    /// [`RIGID_TOLERANCE`]), or its determinant is −1.
    pub fn from_matrix(m: [[f64; 4]; 4]) -> Result<Self, NotRigid> {
        for (row, entries) in m.iter().enumerate() {
            if let Some(column) = entries.iter().position(|x| !x.is_finite()) {
                return Err(NotRigid::NotFinite { row, column });
            }
        }
        let [x, y, z, last] = m;
        if [last[0], last[1], last[2], last[3] - 1.0].iter().any(|error| error.abs() > RIGID_TOLERANCE) {
            return Err(NotRigid::LastRow(last));
        }
        let rotation = Rotation::from_matrix([x, y, z].map(|row| [row[0], row[1], row[2]]))?;
        Ok(Transform { rotation, translation: Vector([x[3], y[3], z[3]]) })
    }
}

/// x_ac = x_ab · x_bc
impl<T: Scalar> Mul for Transform<T> {
    type Output = Self;
    #[inline]
    fn mul(self, x_bc: Self) -> Self {
        let p_ac = self.act_on_point(x_bc.translation);
        Self::from_rotation_translation(self.rotation * x_bc.rotation, p_ac)
    }
}

/// The pose with the rotation nearest to its own, and by how much the columns of its own fail to be orthonormal.
pub(crate) fn nearest_rigid(pose: &Transform<f64>) -> (Transform<f64>, f64) {
    let mut rows = pose.rotation.rows();
    let mut defect = 0.0_f64;
    for step in 0..3 {
        // R (3·1 − RᵀR)/2, which converges to the orthogonal factor of R.
        let column = |j: usize| Vector(std::array::from_fn(|i: usize| rows[i][j]));
        let product: [[f64; 3]; 3] = std::array::from_fn(|i| {
            std::array::from_fn(|j| f64::from(u8::from(i == j)) - column(i).dot(column(j)))
        });
        let largest = product.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
        if step == 0 {
            defect = largest;
        }
        if largest <= 1e-15 || largest > 0.1 {
            break;
        }
        rows = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                rows[i][j] + 0.5 * (0..3).map(|k| rows[i][k] * product[k][j]).sum::<f64>()
            })
        });
    }
    (Transform::from_rotation_translation(Rotation::from_rows(rows), pose.translation), defect)
}
