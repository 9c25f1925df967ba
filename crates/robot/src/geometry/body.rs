//! A rigid body by its mass: ten numbers about the origin of a frame, along its axes.
//!
//! The inertia is a tensor, as Khalil and Dombre (*Modeling, Identification and Control of Robots*, ch. 9), SYMORO and URDF have it:
//! XX = ∫(y² + z²) dm, XY = −∫xy dm. Everything that follows from a body is linear in the ten.

use super::{Rotation, Transform, Vector};
use crate::scalar::Scalar;
use std::ops::Add;

/// The names of the ten numbers, in the order of [`Body::parameters`].
pub const PARAMETERS: [&str; 10] = ["XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M"];

/// A body about the origin of a frame.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Body<T> {
    /// The inertia about the origin, xx xy xz yy yz zz, kg·m².
    pub inertia: [T; 6],
    /// The first moment, mass times centre of mass, kg·m.
    pub first_moment: Vector<T>,
    /// The mass, kg.
    pub mass: T,
}

impl<T: Scalar> Body<T> {
    /// No body.
    pub fn nothing() -> Self {
        Body { inertia: [T::zero(); 6], first_moment: Vector::zero(), mass: T::zero() }
    }

    /// The body with these [`PARAMETERS`].
    pub fn of([xx, xy, xz, yy, yz, zz, mx, my, mz, mass]: [T; 10]) -> Self {
        Body { inertia: [xx, xy, xz, yy, yz, zz], first_moment: Vector([mx, my, mz]), mass }
    }

    /// Its [`PARAMETERS`].
    pub fn parameters(&self) -> [T; 10] {
        let ([xx, xy, xz, yy, yz, zz], [mx, my, mz]) = (self.inertia, self.first_moment.0);
        [xx, xy, xz, yy, yz, zz, mx, my, mz, self.mass]
    }

    /// The body with a mass, its centre, and its inertia about the centre along the axes of the frame (xx xy xz yy yz zz).
    pub fn about_centre(mass: T, centre: Vector<T>, inertia: [T; 6]) -> Self {
        let first_moment = centre.scale(mass);
        let spread = [0, 1, 2].map(|i| [0, 1, 2].map(|j| first_moment[i] * centre[j]));
        Body { inertia: plus_spread(inertia, &spread), first_moment, mass }
    }

    /// The centre of mass, and the inertia about it; `None` for a mass of 0.
    pub fn at_centre(&self) -> Option<(Vector<T>, [T; 6])> {
        if self.mass == T::zero() {
            return None;
        }
        let centre = self.first_moment.map(|m| m / self.mass);
        let spread = [0, 1, 2].map(|i| [0, 1, 2].map(|j| -(self.first_moment[i] * centre[j])));
        Some((centre, plus_spread(self.inertia, &spread)))
    }

    /// The inertia as a matrix.
    pub fn tensor(&self) -> Rotation<T> {
        tensor(self.inertia)
    }

    /// The same body about the origin of another frame, in which this one stands: H' = X H Xᵀ with the second moments,
    /// the first and the mass as H.
    #[must_use]
    pub fn seen_from(&self, x: &Transform<T>) -> Self {
        let (r, p) = (x.rotation, x.translation);
        let turned = if r == Rotation::identity() {
            *self
        } else {
            let m = (r * self.tensor() * r.inverse()).rows();
            let inertia = [m[0][0], m[0][1], m[0][2], m[1][1], m[1][2], m[2][2]];
            Body { inertia, first_moment: r * self.first_moment, mass: self.mass }
        };
        if p == Vector::zero() {
            return turned;
        }
        // The second moments grow by MS pᵀ + p MSᵀ + M p pᵀ.
        let (ms, by_mass) = (turned.first_moment, p.scale(self.mass));
        let first_moment = ms + by_mass;
        let spread = [0, 1, 2].map(|i| [0, 1, 2].map(|j| ms[i] * p[j] + p[i] * ms[j] + by_mass[i] * p[j]));
        Body { inertia: plus_spread(turned.inertia, &spread), first_moment, mass: self.mass }
    }

    /// The same numbers in another scalar type.
    pub fn map<U>(&self, mut f: impl FnMut(T) -> U) -> Body<U> {
        let [xx, xy, xz, yy, yz, zz] = self.inertia;
        let inertia = [f(xx), f(xy), f(xz), f(yy), f(yz), f(zz)];
        Body { inertia, first_moment: self.first_moment.map(&mut f), mass: f(self.mass) }
    }
}

/// Two bodies that are fixed to each other.
impl<T: Scalar> Add for Body<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let inertia = std::array::from_fn(|k| self.inertia[k] + other.inertia[k]);
        let first_moment = self.first_moment + other.first_moment;
        Body { inertia, first_moment, mass: self.mass + other.mass }
    }
}

fn tensor<T: Scalar>([xx, xy, xz, yy, yz, zz]: [T; 6]) -> Rotation<T> {
    Rotation::from_rows([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
}

/// The inertia where the second moments grow by a symmetric matrix s: J + tr(s)·1 − s.
fn plus_spread<T: Scalar>([xx, xy, xz, yy, yz, zz]: [T; 6], s: &[[T; 3]; 3]) -> [T; 6] {
    let [x, y, z] = [s[0][0], s[1][1], s[2][2]];
    [xx + (y + z), xy - s[0][1], xz - s[0][2], yy + (x + z), yz - s[1][2], zz + (x + y)]
}

/// What is wrong with a body that is given by numbers.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum NoBody {
    /// A number is infinite or none.
    NotFinite,
    /// The mass is negative.
    NegativeMass,
    /// There is a first moment or an inertia, and no mass.
    NoMass,
    /// The inertia about the centre of mass is not positive.
    NotPositive,
    /// Of the moments about the principal axes one is larger than the sum of the others.
    Triangle,
}

/// How much larger than rounding a breach of the rules is, by the size of the inertia.
const TOLERANCE: f64 = 1e-9;

impl Body<f64> {
    /// Whether a distribution of mass has these numbers: the mass is not negative, and the second moments about the centre
    /// of mass are positive semidefinite, which is the triangle inequality of the principal moments. No body has none.
    ///
    /// # Errors
    /// What is wrong.
    pub fn check(&self) -> Result<(), NoBody> {
        let all = self.parameters();
        if all.iter().any(|x| !x.is_finite()) {
            return Err(NoBody::NotFinite);
        }
        if self.mass < 0.0 {
            return Err(NoBody::NegativeMass);
        }
        let Some((_, inertia)) = self.at_centre() else {
            return if all.iter().all(|&x| x == 0.0) { Ok(()) } else { Err(NoBody::NoMass) };
        };
        let size = self.inertia.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let moments = eigenvalues(inertia);
        if moments[0] < -TOLERANCE * size {
            return Err(NoBody::NotPositive);
        }
        if moments[2] - moments[1] - moments[0] > TOLERANCE * size {
            return Err(NoBody::Triangle);
        }
        Ok(())
    }
}

/// The eigenvalues of a symmetric matrix, ascending, by Jacobi's rotations.
fn eigenvalues(inertia: [f64; 6]) -> [f64; 3] {
    let mut m = tensor(inertia).rows();
    for _ in 0..40 {
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            if m[i][j] == 0.0 {
                continue;
            }
            let zeta = (m[j][j] - m[i][i]) / (2.0 * m[i][j]);
            let t = zeta.signum() / (zeta.abs() + zeta.hypot(1.0));
            let c = 1.0 / t.hypot(1.0);
            let s = c * t;
            for row in &mut m {
                (row[i], row[j]) = (c * row[i] - s * row[j], s * row[i] + c * row[j]);
            }
            let (a, b) = (m[i], m[j]);
            for k in 0..3 {
                (m[i][k], m[j][k]) = (c * a[k] - s * b[k], s * a[k] + c * b[k]);
            }
        }
    }
    let mut values = [m[0][0], m[1][1], m[2][2]];
    values.sort_by(f64::total_cmp);
    values
}
