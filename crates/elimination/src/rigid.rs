//! Rigid motions: `x ↦ rotation x + translation`, rotations by rows, lengths in any one unit.

/// A rigid motion; `a.then(b)` is the product `a b` of the transforms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rigid {
    /// Orthogonal matrix with determinant 1, by rows.
    pub rotation: [[f64; 3]; 3],
    /// Where the origin goes.
    pub translation: [f64; 3],
}

impl Rigid {
    /// No motion.
    pub const IDENTITY: Rigid =
        Rigid { rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], translation: [0.0; 3] };

    /// Rotation about z by an angle given by its cosine and sine.
    #[inline]
    pub fn about_z(c: f64, s: f64) -> Rigid {
        Rigid { rotation: [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]], translation: [0.0; 3] }
    }

    /// Translation along z.
    #[inline]
    pub fn along_z(d: f64) -> Rigid {
        Rigid { translation: [0.0, 0.0, d], ..Rigid::IDENTITY }
    }

    /// A direction turned.
    #[inline]
    pub fn turn(&self, v: [f64; 3]) -> [f64; 3] {
        let r = &self.rotation;
        [dot(r[0], v), dot(r[1], v), dot(r[2], v)]
    }

    /// A direction turned by the inverse.
    #[inline]
    pub(crate) fn turn_back(&self, v: [f64; 3]) -> [f64; 3] {
        let r = &self.rotation;
        [
            r[0][0] * v[0] + r[1][0] * v[1] + r[2][0] * v[2],
            r[0][1] * v[0] + r[1][1] * v[1] + r[2][1] * v[2],
            r[0][2] * v[0] + r[1][2] * v[1] + r[2][2] * v[2],
        ]
    }

    /// A point moved.
    #[inline]
    pub fn point(&self, p: [f64; 3]) -> [f64; 3] {
        let v = self.turn(p);
        let t = &self.translation;
        [v[0] + t[0], v[1] + t[1], v[2] + t[2]]
    }

    /// A point moved by the inverse.
    #[inline]
    pub(crate) fn point_back(&self, p: [f64; 3]) -> [f64; 3] {
        let t = &self.translation;
        self.turn_back([p[0] - t[0], p[1] - t[1], p[2] - t[2]])
    }

    /// The product `self next`.
    #[inline]
    pub fn then(&self, next: &Rigid) -> Rigid {
        let mut rotation = [[0.0; 3]; 3];
        for (row, own) in rotation.iter_mut().zip(&self.rotation) {
            for (k, entry) in row.iter_mut().enumerate() {
                *entry = own[0] * next.rotation[0][k]
                    + own[1] * next.rotation[1][k]
                    + own[2] * next.rotation[2][k];
            }
        }
        Rigid { rotation, translation: self.point(next.translation) }
    }

    /// The inverse.
    #[inline]
    pub fn inverse(&self) -> Rigid {
        let r = &self.rotation;
        let t = self.turn_back(self.translation);
        Rigid {
            rotation: [[r[0][0], r[1][0], r[2][0]], [r[0][1], r[1][1], r[2][1]], [r[0][2], r[1][2], r[2][2]]],
            translation: [-t[0], -t[1], -t[2]],
        }
    }

    /// The same motion with lengths multiplied by `factor`.
    #[inline]
    pub fn scaled(&self, factor: f64) -> Rigid {
        let t = &self.translation;
        Rigid { rotation: self.rotation, translation: [t[0] * factor, t[1] * factor, t[2] * factor] }
    }
}

/// The scalar product.
#[inline]
pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The vector product.
#[inline]
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
