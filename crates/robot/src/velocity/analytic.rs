//! The analytic Jacobian: how fast the numbers change that an orientation is written with.

use super::geometric::Jacobian;
use crate::geometry::orientation::{EulerSet, OrientationSet};
use crate::geometry::{Axis, Rotation, Vector};
use crate::scalar::Scalar;

/// The position's rates, then those of the orientation's values, one column a joint.
#[derive(Clone, PartialEq, Debug)]
pub struct AnalyticJacobian<T> {
    /// x, y, z, then the names of the set's values: `qx` … `qw` of a quaternion, `ux` … `uz` and `angle`.
    pub names: Vec<String>,
    /// As many rows as names; one row has an entry a joint.
    pub rows: Vec<Vec<T>>,
}

/// The analytic Jacobian from the geometric one along the axes of the base, at the body's origin.
///
/// `values` are the orientation's in `set`. Where [`determinant`] is 0 the set is singular and entries are not finite;
/// quaternions and matrices never are.
pub fn analytic<T: Scalar>(jacobian: &Jacobian<T>, set: OrientationSet, values: &[T]) -> AnalyticJacobian<T> {
    let [x, y, z, a, b, c] = jacobian.rows();
    let turning = |row: &[T; 3]| -> Vec<T> {
        let columns = a.iter().zip(&b).zip(&c);
        columns.map(|((&p, &q), &r)| row[0] * p + row[1] * q + row[2] * r).collect()
    };
    let mut rows = vec![x.clone(), y.clone(), z.clone()];
    rows.extend(rates(set, values).iter().map(turning));
    // Components of a quaternion and of an axis are called x, y, z too.
    let letter = match set {
        OrientationSet::Quaternion => "q",
        OrientationSet::AxisAngle => "u",
        _ => "",
    };
    let own = |name: &&str| if name.len() == 1 { format!("{letter}{name}") } else { name.to_string() };
    let names = ["x", "y", "z"].map(String::from).into_iter().chain(set.names().iter().map(own)).collect();
    AnalyticJacobian { names, rows }
}

/// The matrix B of `d(values)/dt = B ω`, with ω along the axes of the base; one row a value.
///
/// - `rpy` and Euler sets: the inverse of E, `ω = E d(values)/dt`, whose columns are the axes of the three turns
///   (Siciliano et al., *Robotics*, 2009, section 3.6);
/// - quaternion: ½ (w ω + ω × v) and −½ ω·v, for any quaternion of length 1;
/// - axis and angle: ½ (ω × u + cot(θ/2) (ω − (u·ω) u)) and u·ω;
/// - matrix: ω × each column.
///
/// # Panics
/// If `values` are not as many as the set has.
pub fn rates<T: Scalar>(set: OrientationSet, values: &[T]) -> Vec<[T; 3]> {
    assert_eq!(values.len(), set.names().len(), "one value for each name of the set");
    let half = T::one() / T::int(2);
    let (o, l) = (T::zero(), T::one());
    let units = Axis::ALL.map(Vector::<T>::unit);
    match set {
        OrientationSet::Rpy | OrientationSet::Euler(_) => inverse(&turns(set, values)),
        OrientationSet::Quaternion => {
            let (v, w) = (Vector([values[0], values[1], values[2]]), values[3]);
            let by_unit = units.map(|e| (e.scale(w) + e.cross(v)).scale(half));
            let mut rows = transposed(&by_unit);
            rows.push(v.scale(-half).0);
            rows
        }
        OrientationSet::AxisAngle => {
            let u = Vector([values[0], values[1], values[2]]);
            let (s, c) = (values[3] * half).sin_cos();
            let by_unit = units.map(|e| {
                let across = e - u.scale(u.dot(e));
                (e.cross(u) + across.scale(c / s)).scale(half)
            });
            let mut rows = transposed(&by_unit);
            rows.push(u.0);
            rows
        }
        OrientationSet::Matrix => {
            let cross = |column: usize, row: usize| {
                let [x, y, z] = [0, 1, 2].map(|r| values[3 * r + column]);
                [[o, z, -y], [-z, o, x], [y, -x, o]][row].map(|e| e * l)
            };
            (0..9).map(|k| cross(k % 3, k / 3)).collect()
        }
    }
}

/// det E, which vanishes where the set is singular: ± sin θ (proper sets), ± cos θ (Tait–Bryan sets, `rpy`), sin(θ/2)
/// (axis and angle); `None` for sets that are never singular.
///
/// # Panics
/// If `values` are not as many as the set has.
pub fn determinant<T: Scalar>(set: OrientationSet, values: &[T]) -> Option<T> {
    match set {
        OrientationSet::Rpy | OrientationSet::Euler(_) => {
            let [a, b, c] = turns(set, values);
            Some(a.dot(b.cross(c)))
        }
        OrientationSet::AxisAngle => Some((values[3] / T::int(2)).sin_cos().0),
        OrientationSet::Quaternion | OrientationSet::Matrix => None,
    }
}

/// The axes of the three turns in the base, in the order of the values.
fn turns<T: Scalar>(set: OrientationSet, values: &[T]) -> [Vector<T>; 3] {
    let (axes, angles, is_reversed) = match set {
        OrientationSet::Euler(set) => (EulerSet::axes(set), [values[0], values[1], values[2]], false),
        // Roll, pitch, yaw about fixed x, y, z are yaw, pitch, roll about moving z, y, x.
        _ => ([Axis::Z, Axis::Y, Axis::X], [values[2], values[1], values[0]], true),
    };
    let first = Rotation::about(axes[0], angles[0]);
    let second = first * Rotation::about(axes[1], angles[1]);
    let turns = [Vector::unit(axes[0]), first * Vector::unit(axes[1]), second * Vector::unit(axes[2])];
    if is_reversed { [turns[2], turns[1], turns[0]] } else { turns }
}

/// The inverse of the matrix with these columns.
fn inverse<T: Scalar>([a, b, c]: &[Vector<T>; 3]) -> Vec<[T; 3]> {
    let determinant = a.dot(b.cross(*c));
    [b.cross(*c), c.cross(*a), a.cross(*b)].map(|row| row.0.map(|x| x / determinant)).to_vec()
}

fn transposed<T: Scalar>(columns: &[Vector<T>; 3]) -> Vec<[T; 3]> {
    (0..3).map(|r| [columns[0][r], columns[1][r], columns[2][r]]).collect()
}
