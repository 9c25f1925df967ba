//! Orientations as a person or a controller writes them: quaternions, axis and angle, roll-pitch-yaw, and the
//! twelve sets of Euler angles.
//!
//! Angles are in radians, reported in (−π, π]. Euler sets are intrinsic (each turn about an axis of the frame
//! that the turns before it have moved), so that `zyz` is Rz(φ)·Ry(θ)·Rz(ψ) (Siciliano et al., *Robotics*,
//! 2009, section 2.4.1); `rpy` is fixed-axis XYZ as in URDF, Rz(yaw)·Ry(pitch)·Rx(roll) (section 2.4.2).
//!
//! # Singular orientations
//!
//! Three angles cannot tell first and last turn apart where their axes coincide: sin θ = 0 for a proper set
//! (first and last axis the same, as in `zyz`), cos θ = 0 for a Tait–Bryan set (three different axes, as in
//! `zyx`, and `rpy`). [`extract`] calls an orientation singular where that sine or cosine is below
//! [`SINGULAR`], says so, and gives the representative whose last listed angle is 0 (ψ; the yaw of `rpy`) and
//! whose middle angle is exactly the singular one. A rotation of angle 0 has no axis: it is singular as
//! `axis-angle`, and gets the axis z.
//!
//! Everywhere else the values reproduce the matrix to rounding, also right beside a singularity, where the
//! single angles are ill-determined but their combination is not: the middle angle comes from a sine and a
//! cosine at once, and the last angle from the matrix with the first turn taken off, so that it makes up for
//! what is arbitrary in the first.
//!
//! ```
//! use denavit::geometry::{Rotation, orientation};
//!
//! let r = Rotation::about_z(0.3) * Rotation::about_y(1.2) * Rotation::about_z(-2.0);
//! let zyz = orientation::extract(&r, "zyz".parse()?);
//! assert!(!zyz.singular);
//! assert_eq!(zyz.names(), ["phi", "theta", "psi"]);
//! for (found, wanted) in zyz.values.iter().zip([0.3, 1.2, -2.0]) {
//!     assert!((found - wanted).abs() < 1e-15);
//! }
//! let back = orientation::rotation(zyz.set, &zyz.values)?;
//! assert!((back.z() - r.z()).norm() < 1e-15);
//! # Ok::<(), orientation::OrientationError>(())
//! ```

use super::rotation::{NotRigid, Rotation};
use super::vector::{Axis, Vector};
use crate::scalar::Scalar;
use denavit_symbolic::Expr;
use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt;
use std::str::FromStr;

/// Below this an orientation counts as singular: the sine (proper sets) or cosine (Tait–Bryan sets, `rpy`) of
/// the middle angle, or the distance of the angle of `axis-angle` from 0 or π.
///
/// A product of a dozen rotations carries a rounding error near 1e-15, which stands where an exact singularity
/// has 0: those must be found, so the threshold lies ten times above. It must not lie higher, because the
/// singular representative differs from the matrix by up to this much.
pub const SINGULAR: f64 = 1e-14;

/// One of the twelve sequences of axes for Euler angles φ, θ, ψ, intrinsic.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct EulerSet([Axis; 3]);

/// A way to write an orientation.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub enum OrientationSet {
    /// `matrix`: the nine entries, row by row.
    Matrix,
    /// `quaternion` or `xyzw`: the unit quaternion x, y, z, w with w ≥ 0 (the first of x, y, z that is not 0 is
    /// positive where w = 0).
    Quaternion,
    /// `axis-angle`: a unit vector x, y, z and the angle about it in [0, π]; the first component of the axis
    /// that is not 0 is positive where the angle is π.
    AxisAngle,
    /// `rpy`: roll, pitch, yaw about the fixed axes x, y, z, in this order, the pitch in [−π/2, π/2]. Singular
    /// at pitch ±π/2, where the representative has yaw 0.
    Rpy,
    /// `zyz` and its kin: φ, θ, ψ, with θ in [0, π] for a proper set, in [−π/2, π/2] for a Tait–Bryan set.
    Euler(EulerSet),
}

/// An orientation in one of the sets.
#[derive(Clone, PartialEq, Debug)]
pub struct Orientation {
    /// How it is written.
    pub set: OrientationSet,
    /// As many values as the set has names; angles in radians.
    pub values: Vec<f64>,
    /// True if other values, arbitrarily far from these, stand for the same orientation.
    pub singular: bool,
}

/// Why values do not give an orientation.
#[derive(Clone, PartialEq, Debug)]
pub enum OrientationError {
    /// No set has this name.
    UnknownSet(String),
    /// The set has another number of values.
    WrongCount {
        /// The set.
        set: OrientationSet,
        /// How many values were given.
        found: usize,
    },
    /// A value is infinite or not a number.
    NotFinite {
        /// The set.
        set: OrientationSet,
        /// The name of the value.
        name: &'static str,
    },
    /// The quaternion, or the axis, has length 0.
    ZeroLength(OrientationSet),
    /// The nine values are not a rotation matrix.
    NotRigid(NotRigid),
}

impl EulerSet {
    /// Rx·Ry·Rx
    pub const XYX: Self = EulerSet([Axis::X, Axis::Y, Axis::X]);
    /// Rx·Rz·Rx
    pub const XZX: Self = EulerSet([Axis::X, Axis::Z, Axis::X]);
    /// Ry·Rx·Ry
    pub const YXY: Self = EulerSet([Axis::Y, Axis::X, Axis::Y]);
    /// Ry·Rz·Ry
    pub const YZY: Self = EulerSet([Axis::Y, Axis::Z, Axis::Y]);
    /// Rz·Rx·Rz
    pub const ZXZ: Self = EulerSet([Axis::Z, Axis::X, Axis::Z]);
    /// Rz·Ry·Rz
    pub const ZYZ: Self = EulerSet([Axis::Z, Axis::Y, Axis::Z]);
    /// Rx·Ry·Rz
    pub const XYZ: Self = EulerSet([Axis::X, Axis::Y, Axis::Z]);
    /// Rx·Rz·Ry
    pub const XZY: Self = EulerSet([Axis::X, Axis::Z, Axis::Y]);
    /// Ry·Rx·Rz
    pub const YXZ: Self = EulerSet([Axis::Y, Axis::X, Axis::Z]);
    /// Ry·Rz·Rx
    pub const YZX: Self = EulerSet([Axis::Y, Axis::Z, Axis::X]);
    /// Rz·Rx·Ry
    pub const ZXY: Self = EulerSet([Axis::Z, Axis::X, Axis::Y]);
    /// Rz·Ry·Rx
    pub const ZYX: Self = EulerSet([Axis::Z, Axis::Y, Axis::X]);

    /// All twelve, the proper ones first.
    pub const ALL: [Self; 12] = [
        Self::XYX,
        Self::XZX,
        Self::YXY,
        Self::YZY,
        Self::ZXZ,
        Self::ZYZ,
        Self::XYZ,
        Self::XZY,
        Self::YXZ,
        Self::YZX,
        Self::ZXY,
        Self::ZYX,
    ];

    /// The set with these axes, if no two neighbours are the same.
    pub fn new(axes: [Axis; 3]) -> Option<Self> {
        (axes[0] != axes[1] && axes[1] != axes[2]).then_some(EulerSet(axes))
    }

    /// The axes of the first, middle and last turn.
    pub fn axes(self) -> [Axis; 3] {
        self.0
    }

    /// True if the first and the last axis are the same; a set of three different axes is Tait–Bryan.
    pub fn is_proper(self) -> bool {
        self.0[0] == self.0[2]
    }
}

impl OrientationSet {
    /// Every set.
    pub const ALL: [Self; 16] = {
        let mut all = [Self::Matrix; 16];
        (all[1], all[2], all[3]) = (Self::Quaternion, Self::AxisAngle, Self::Rpy);
        let mut i = 0;
        while i < 12 {
            all[4 + i] = Self::Euler(EulerSet::ALL[i]);
            i += 1;
        }
        all
    };

    /// The names of its values, in order.
    pub fn names(self) -> &'static [&'static str] {
        match self {
            OrientationSet::Matrix => &["r11", "r12", "r13", "r21", "r22", "r23", "r31", "r32", "r33"],
            OrientationSet::Quaternion => &["x", "y", "z", "w"],
            OrientationSet::AxisAngle => &["x", "y", "z", "angle"],
            OrientationSet::Rpy => &["roll", "pitch", "yaw"],
            OrientationSet::Euler(_) => &["phi", "theta", "psi"],
        }
    }
}

impl Orientation {
    /// The names of the values, in order.
    pub fn names(&self) -> &'static [&'static str] {
        self.set.names()
    }

    /// The other values of the same orientation, where there are exactly two: (φ+π, −θ, ψ+π) of a proper set,
    /// (φ+π, π−θ, ψ+π) of a Tait–Bryan set and of `rpy`, the negated quaternion, the negated axis with the
    /// negated angle. `None` for a singular orientation, which has infinitely many, and for a matrix.
    pub fn other_solution(&self) -> Option<Self> {
        let opposite = |a: f64| canonical(if a > 0.0 { a - PI } else { a + PI });
        let supplement = |a: f64| canonical(if a < 0.0 { -PI - a } else { PI - a });
        let values = match (self.set, &self.values[..]) {
            _ if self.singular => return None,
            (OrientationSet::Quaternion | OrientationSet::AxisAngle, q) => {
                q.iter().map(|x| 0.0 - x).collect()
            }
            (OrientationSet::Euler(set), &[a, b, c]) if set.is_proper() => {
                vec![opposite(a), 0.0 - b, opposite(c)]
            }
            (OrientationSet::Euler(_) | OrientationSet::Rpy, &[a, b, c]) => {
                vec![opposite(a), supplement(b), opposite(c)]
            }
            (OrientationSet::Matrix | OrientationSet::Euler(_) | OrientationSet::Rpy, _) => return None,
        };
        Some(Orientation { values, ..*self })
    }
}

/// A rotation matrix written in `set`; see the module on what is singular. What is not a rotation gives values
/// without meaning (not numbers where the matrix holds none), never a panic.
pub fn extract(r: &Rotation<f64>, set: OrientationSet) -> Orientation {
    let (values, singular) = match set {
        OrientationSet::Matrix => (r.map(|x| x + 0.0).rows().concat(), false),
        OrientationSet::Quaternion => (quaternion(r).to_vec(), false),
        OrientationSet::AxisAngle => axis_angle(quaternion(r)),
        // Rᵀ = Rx(−roll)·Ry(−pitch)·Rz(−yaw)
        OrientationSet::Rpy => {
            let (negated, singular) = euler_angles(&r.inverse(), EulerSet::XYZ);
            (negated.map(|a| canonical(-a)).to_vec(), singular)
        }
        OrientationSet::Euler(e) => {
            let (angles, singular) = euler_angles(r, e);
            (angles.to_vec(), singular)
        }
    };
    Orientation { set, values, singular }
}

/// The rotation matrix of values in `set`. Angles may be any finite ones; quaternions and axes need not have
/// length 1, only their direction counts.
///
/// # Errors
/// If the number of values is wrong, a value is not finite, a quaternion or axis is 0, or nine values are not
/// a rotation matrix.
pub fn rotation(set: OrientationSet, values: &[f64]) -> Result<Rotation<f64>, OrientationError> {
    if let Some((_, name)) = values.iter().zip(set.names()).find(|(x, _)| !x.is_finite()) {
        return Err(OrientationError::NotFinite { set, name });
    }
    let zero = OrientationError::ZeroLength(set);
    match (set, values) {
        (OrientationSet::Matrix, &[a, b, c, d, e, f, g, h, i]) => {
            Rotation::from_matrix([[a, b, c], [d, e, f], [g, h, i]]).map_err(OrientationError::NotRigid)
        }
        (OrientationSet::Quaternion, &[x, y, z, w]) => {
            unit([x, y, z, w]).map(rotation_of_quaternion).ok_or(zero)
        }
        (OrientationSet::AxisAngle, &[x, y, z, angle]) => {
            let (s, c) = (angle / 2.0).sin_cos();
            unit([x, y, z]).map(|[x, y, z]| rotation_of_quaternion([s * x, s * y, s * z, c])).ok_or(zero)
        }
        (OrientationSet::Rpy, &[roll, pitch, yaw]) => Ok(Rotation::from_rpy(roll, pitch, yaw)),
        (OrientationSet::Euler(set), &[phi, theta, psi]) => {
            let [i, j, k] = set.0;
            Ok(Rotation::about(i, phi) * Rotation::about(j, theta) * Rotation::about(k, psi))
        }
        _ => Err(OrientationError::WrongCount { set, found: values.len() }),
    }
}

/// The formulas of roll-pitch-yaw or Euler angles in the entries of a matrix, each with its name, as the books
/// print them; `None` for the other sets. They hold where the orientation is not singular.
///
/// For `zyz`: φ = atan2(r23, r13), θ = atan2(√(r13² + r23²), r33), ψ = atan2(r32, −r31)
/// (Siciliano et al., *Robotics*, 2009, section 2.4.1).
pub fn extraction_formulas(r: &Rotation<Expr>, set: OrientationSet) -> Option<Vec<(&'static str, Expr)>> {
    let formulas = match set {
        OrientationSet::Euler(e) => euler_formulas(r, e),
        // Rz(yaw)·Ry(pitch)·Rx(roll)
        OrientationSet::Rpy => {
            let [yaw, pitch, roll] = euler_formulas(r, EulerSet::ZYX);
            [roll, pitch, yaw]
        }
        OrientationSet::Matrix | OrientationSet::Quaternion | OrientationSet::AxisAngle => return None,
    };
    Some(set.names().iter().copied().zip(formulas).collect())
}

/// The axes of a set and how they are handed, as rows and columns of a matrix.
///
/// With R = R_i(φ) R_j(θ) R_k(ψ), `l` the third axis beside i, j and `m` beside j, k:
/// e_i × e_j = ε e_l and e_j × e_k = σ e_m.
struct Roles {
    i: usize,
    j: usize,
    k: usize,
    l: usize,
    m: usize,
    proper: bool,
    epsilon: bool,
    sigma: bool,
}

impl Roles {
    fn of(set: EulerSet) -> Self {
        let [i, j, k] = set.0.map(Axis::index);
        let follows = |a: usize, b: usize| b == (a + 1) % 3;
        let (epsilon, sigma) = (follows(i, j), follows(j, k));
        Roles { i, j, k, l: 3 - i - j, m: 3 - j - k, proper: set.is_proper(), epsilon, sigma }
    }

    /// Sine and cosine of φ, both times sin θ (proper) or cos θ (Tait–Bryan): from the column
    /// R e_k = R_i(φ) R_j(θ) e_k.
    fn first<T: Scalar>(&self, r: &Rotation<T>) -> (T, T) {
        let (rj, rl) = (r[(self.j, self.k)], r[(self.l, self.k)]);
        match self.proper {
            true => (rj, signed(!self.epsilon, rl)),
            false => (signed(!self.epsilon, rj), rl),
        }
    }

    /// cos θ (proper) or sin θ (Tait–Bryan).
    fn middle<T: Scalar>(&self, r: &Rotation<T>) -> T {
        signed(self.proper || self.epsilon, r[(self.i, self.k)])
    }

    /// Sine and cosine of ψ, both times sin θ (proper) or cos θ (Tait–Bryan): from the row
    /// e_iᵀ R = e_iᵀ R_j(θ) R_k(ψ).
    fn last<T: Scalar>(&self, r: &Rotation<T>) -> (T, T) {
        let rj = r[(self.i, self.j)];
        match self.proper {
            true => (rj, signed(self.epsilon, r[(self.i, self.l)])),
            false => (signed(!self.epsilon, rj), r[(self.i, self.i)]),
        }
    }
}

fn signed<T: Scalar>(positive: bool, x: T) -> T {
    if positive { x } else { -x }
}

/// φ, θ, ψ, and whether the orientation is singular.
fn euler_angles(r: &Rotation<f64>, set: EulerSet) -> ([f64; 3], bool) {
    let roles = Roles::of(set);
    let (y, x) = roles.first(r);
    let (middle, rest) = (roles.middle(r), y.hypot(x));
    let [row_j, row_l] = [roles.j, roles.l].map(|a| Vector(r.rows()[a]));

    if rest < SINGULAR {
        // ψ = 0, so R e_j = R_i(φ) e_j = cos φ e_j + ε sin φ e_l
        let phi = angle(signed(roles.epsilon, row_l[roles.j]), row_j[roles.j]);
        let theta = match (roles.proper, middle > 0.0) {
            (true, true) => 0.0,
            (true, false) => PI,
            (false, true) => FRAC_PI_2,
            (false, false) => -FRAC_PI_2,
        };
        return ([phi, theta, 0.0], true);
    }
    let phi = angle(y, x);
    let theta = if roles.proper { angle(rest, middle) } else { angle(middle, rest) };
    // The row of axis j in R_i(−φ) R = R_j(θ) R_k(ψ) is e_jᵀ R_k(ψ), whatever θ is.
    let (s, c) = phi.sin_cos();
    let row = row_j * c + row_l * signed(roles.epsilon, s);
    let psi = angle(signed(roles.sigma, row[roles.m]), row[roles.j]);
    ([phi, theta, psi], false)
}

fn euler_formulas(r: &Rotation<Expr>, set: EulerSet) -> [Expr; 3] {
    let roles = Roles::of(set);
    let ((sin_phi, cos_phi), (sin_psi, cos_psi)) = (roles.first(r), roles.last(r));
    let middle = roles.middle(r);
    // The two entries beside the middle one: in its column for a proper set, in its row for a Tait–Bryan set.
    let (a, b) = if roles.proper { (roles.j, roles.l) } else { (roles.i, roles.j) };
    let [p, q] = [a.min(b), a.max(b)].map(|n| if roles.proper { r[(n, roles.i)] } else { r[(roles.i, n)] });
    let rest = (p.powi(2) + q.powi(2)).sqrt();
    let theta = if roles.proper { rest.atan2(middle) } else { middle.atan2(rest) };
    [sin_phi.atan2(cos_phi), theta, sin_psi.atan2(cos_psi)]
}

/// x, y, z, w with w ≥ 0 (Shepperd 1978): every row of 4qqᵀ, whose entries are sums of entries of R, is a
/// multiple of q; the one with the largest diagonal entry is the best conditioned.
pub(crate) fn quaternion(r: &Rotation<f64>) -> [f64; 4] {
    let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = r.rows();
    let rows = [
        [1.0 + xx - yy - zz, yx + xy, xz + zx, zy - yz],
        [yx + xy, 1.0 - xx + yy - zz, zy + yz, xz - zx],
        [xz + zx, zy + yz, 1.0 - xx - yy + zz, yx - xy],
        [zy - yz, xz - zx, yx - xy, 1.0 + xx + yy + zz],
    ];
    let best = (0..4).fold(3, |best, n| if rows[n][n] > rows[best][best] { n } else { best });
    let q = unit(rows[best]).unwrap_or([f64::NAN; 4]);
    let leading = [q[3], q[0], q[1], q[2]].into_iter().find(|x| *x != 0.0);
    q.map(|x| if leading.is_some_and(|l| l < 0.0) { 0.0 - x } else { 0.0 + x })
}

/// Axis and angle, and whether the angle is 0, of a unit quaternion with w ≥ 0.
fn axis_angle([x, y, z, w]: [f64; 4]) -> (Vec<f64>, bool) {
    let v = Vector([x, y, z]);
    let sin_half = v.norm();
    if 2.0 * sin_half < SINGULAR {
        return (vec![0.0, 0.0, 1.0, 0.0], true);
    }
    let mut axis = v * (1.0 / sin_half);
    let mut angle = 2.0 * sin_half.atan2(w);
    if 2.0 * w < SINGULAR {
        // A half turn is the same about −axis; the sign must not hang on the rounding error that is w.
        angle = PI;
        if axis.0.into_iter().find(|x| x.abs() > SINGULAR).is_some_and(|x| x < 0.0) {
            axis = Vector::zero() - axis;
        }
    }
    (vec![axis[0], axis[1], axis[2], angle], false)
}

/// The matrix of a unit quaternion (Siciliano et al., *Robotics*, 2009, section 2.6).
fn rotation_of_quaternion([x, y, z, w]: [f64; 4]) -> Rotation<f64> {
    let diagonal = |a: f64, b: f64| 1.0 - 2.0 * (a * a + b * b);
    let (xy, xz, yz) = (2.0 * x * y, 2.0 * x * z, 2.0 * y * z);
    let (xw, yw, zw) = (2.0 * x * w, 2.0 * y * w, 2.0 * z * w);
    Rotation::from_rows([
        [diagonal(y, z), xy - zw, xz + yw],
        [xy + zw, diagonal(x, z), yz - xw],
        [xz - yw, yz + xw, diagonal(x, y)],
    ])
}

/// The vector of length 1 in this direction; `None` without one. Neither squares nor sums overflow.
fn unit<const N: usize>(v: [f64; N]) -> Option<[f64; N]> {
    let largest = v.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    if largest == 0.0 {
        return None;
    }
    let v = v.map(|x| x / largest);
    let norm = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    Some(v.map(|x| x / norm))
}

/// The angle of the point (x, y) in (−π, π], whatever the signs of zeros.
fn angle(y: f64, x: f64) -> f64 {
    canonical((y + 0.0).atan2(x + 0.0))
}

/// An angle in [−π, π] with π for −π and 0 for −0.
fn canonical(a: f64) -> f64 {
    if a == -PI { PI } else { a + 0.0 }
}

impl FromStr for EulerSet {
    type Err = OrientationError;
    fn from_str(s: &str) -> Result<Self, OrientationError> {
        let named = |set: &EulerSet| set.to_string().eq_ignore_ascii_case(s);
        EulerSet::ALL.into_iter().find(named).ok_or_else(|| OrientationError::UnknownSet(s.into()))
    }
}

impl FromStr for OrientationSet {
    type Err = OrientationError;
    fn from_str(s: &str) -> Result<Self, OrientationError> {
        let named = |set: &OrientationSet| set.to_string().eq_ignore_ascii_case(s);
        match OrientationSet::ALL.into_iter().find(named) {
            Some(set) => Ok(set),
            None if s.eq_ignore_ascii_case("xyzw") => Ok(OrientationSet::Quaternion),
            None => Err(OrientationError::UnknownSet(s.into())),
        }
    }
}

impl fmt::Display for EulerSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|axis| write!(f, "{axis}"))
    }
}

impl fmt::Display for OrientationSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            OrientationSet::Matrix => f.write_str("matrix"),
            OrientationSet::Quaternion => f.write_str("quaternion"),
            OrientationSet::AxisAngle => f.write_str("axis-angle"),
            OrientationSet::Rpy => f.write_str("rpy"),
            OrientationSet::Euler(set) => set.fmt(f),
        }
    }
}

impl fmt::Display for OrientationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            OrientationError::UnknownSet(name) => {
                let known = OrientationSet::ALL.map(|set| set.to_string()).join(", ");
                write!(f, "no orientation is called `{}` (known: {known}, xyzw)", name.escape_debug())
            }
            OrientationError::WrongCount { set, found } => {
                let names = set.names();
                write!(f, "`{set}` has {} values ({}), not {found}", names.len(), names.join(", "))
            }
            OrientationError::NotFinite { set, name } => {
                write!(f, "the {name} of `{set}` is not a finite number")
            }
            OrientationError::ZeroLength(set) => {
                write!(f, "the `{set}` has length 0, so it has no direction")
            }
            OrientationError::NotRigid(why) => why.fmt(f),
        }
    }
}

impl std::error::Error for OrientationError {}
