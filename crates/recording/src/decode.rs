//! How a recording writes an orientation: the formats, the numbers of each, and which of them columns can be.
//!
//! Moving axes are those of [`EulerSet`]; turns about fixed axes are the same ones in the opposite order.

use crate::turns::{exp, log};
use denavit::geometry::orientation::{OrientationSet, extract, rotation};
use denavit::geometry::{EulerSet, Rotation, Vector};
use std::f64::consts::{PI, TAU};
use std::fmt;
use std::str::FromStr;

/// A way to write an orientation.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Form {
    /// The axis times the angle.
    RotationVector,
    /// Three turns: the set as a number in [`EulerSet::ALL`], about moving axes or fixed ones.
    Euler(u8, bool),
    /// x, y, z, w
    QuaternionXyzw,
    /// w, x, y, z
    QuaternionWxyz,
    /// The first two rows of the matrix.
    Rows,
    /// Its first two columns.
    Columns,
    /// The matrix by rows.
    Matrix,
}

/// A format: how an orientation is written, and in which unit its angles are.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Format {
    /// The numbers.
    pub form: Form,
    /// Whether its angles are in degrees.
    pub degrees: bool,
}

impl Form {
    /// How many numbers it has.
    pub fn width(self) -> usize {
        match self {
            Form::RotationVector | Form::Euler(..) => 3,
            Form::QuaternionXyzw | Form::QuaternionWxyz => 4,
            Form::Rows | Form::Columns => 6,
            Form::Matrix => 9,
        }
    }

    /// Every one.
    pub fn all() -> Vec<Form> {
        let sets = 0..EulerSet::ALL.len() as u8;
        let turns = sets.flat_map(|k| [Form::Euler(k, true), Form::Euler(k, false)]);
        let others = [Form::QuaternionXyzw, Form::QuaternionWxyz, Form::Rows, Form::Columns, Form::Matrix];
        [Form::RotationVector].into_iter().chain(turns).chain(others).collect()
    }
}

impl Format {
    /// The orientation; nothing where the numbers are none.
    pub fn read(self, x: &[f64]) -> Option<Rotation<f64>> {
        if x.len() != self.form.width() || x.iter().any(|x| !x.is_finite()) {
            return None;
        }
        let angle = |k: usize| if self.degrees { x[k].to_radians() } else { x[k] };
        let vector = |k: usize| Vector([x[k], x[k + 1], x[k + 2]]);
        let quaternion = |x: &[f64]| {
            let norm = x.iter().map(|x| x * x).sum::<f64>().sqrt();
            let is_unit = (0.5..2.0).contains(&norm);
            if is_unit { rotation(OrientationSet::Quaternion, x).ok() } else { None }
        };
        match self.form {
            Form::RotationVector => Some(exp(Vector([angle(0), angle(1), angle(2)]))),
            Form::Euler(set, is_moving) => {
                let [i, j, k] = EulerSet::ALL[usize::from(set)].axes();
                let [a, b, c] = [
                    Rotation::about(i, angle(0)),
                    Rotation::about(j, angle(1)),
                    Rotation::about(k, angle(2)),
                ];
                Some(if is_moving { a * b * c } else { c * b * a })
            }
            Form::QuaternionXyzw => quaternion(x),
            Form::QuaternionWxyz => quaternion(&[x[1], x[2], x[3], x[0]]),
            Form::Rows => orthonormal(vector(0), vector(3)),
            Form::Columns => orthonormal(vector(0), vector(3)).map(|r| r.inverse()),
            Form::Matrix => {
                // The third row says whether it is a mirror image, which is none of ours.
                let r = orthonormal(vector(0), vector(3))?;
                let third = Vector(r.rows()[2]);
                (third.dot(vector(6)) > 0.5).then_some(r)
            }
        }
    }

    /// An orientation in this format; angles within half a turn of those before, if there are any.
    pub fn write(self, r: &Rotation<f64>, before: Option<&[f64]>) -> Vec<f64> {
        let unit = if self.degrees { 180.0 / PI } else { 1.0 };
        let rows = r.rows();
        match self.form {
            Form::RotationVector => {
                let v = log(r);
                let t = v.norm();
                // The other vector of the same turn, if that is nearer.
                let other = if t > 1e-9 { v.scale((t - TAU) / t) } else { v };
                let far = |v: &Vector<f64>| {
                    before.map_or(v.norm(), |b| (v.scale(unit) - Vector([b[0], b[1], b[2]])).norm())
                };
                let best = if before.is_some() && far(&other) < far(&v) { other } else { v };
                best.scale(unit).0.to_vec()
            }
            Form::Euler(set, is_moving) => {
                let set = EulerSet::ALL[usize::from(set)];
                let [i, j, k] = set.axes();
                let set = if is_moving { set } else { named([k, j, i]) };
                let mut x = extract(r, OrientationSet::Euler(set)).values;
                if !is_moving {
                    x.reverse();
                }
                x.iter_mut().for_each(|x| *x *= unit);
                if let Some(b) = before {
                    let turn = TAU * unit;
                    x.iter_mut().zip(b).for_each(|(x, b)| *x += turn * ((b - *x) / turn).round());
                }
                x
            }
            Form::QuaternionXyzw | Form::QuaternionWxyz => {
                let q = extract(r, OrientationSet::Quaternion).values;
                let mut q = if self.form == Form::QuaternionXyzw { q } else { vec![q[3], q[0], q[1], q[2]] };
                if before.is_some_and(|b| b.iter().zip(&q).map(|(a, b)| a * b).sum::<f64>() < 0.0) {
                    q.iter_mut().for_each(|x| *x = 0.0 - *x);
                }
                q
            }
            Form::Rows => rows[..2].concat(),
            Form::Columns => r.inverse().rows()[..2].concat(),
            Form::Matrix => rows.concat(),
        }
    }
}

/// The rotation with these directions of its first two rows.
fn orthonormal(a: Vector<f64>, b: Vector<f64>) -> Option<Rotation<f64>> {
    let unit = |v: Vector<f64>| (v.norm() > 0.3 && v.norm() < 3.0).then(|| v.scale(1.0 / v.norm()));
    let x = unit(a)?;
    let y = unit(b - x.scale(x.dot(b)))?;
    Some(Rotation::from_rows([x.0, y.0, x.cross(y).0]))
}

/// The set with these axes.
fn named(axes: [denavit::geometry::Axis; 3]) -> EulerSet {
    EulerSet::ALL.into_iter().find(|s| s.axes() == axes).unwrap_or(EulerSet::ALL[0])
}

/// Formats that columns can be, each with what it costs to believe it, nats: a branch of angles that is not the usual one costs.
pub fn candidates(columns: &[&[f64]], rows: &[usize]) -> Vec<(Format, f64)> {
    let row = |r: usize| columns.iter().map(|c| c[r]).collect::<Vec<f64>>();
    let largest = |k: usize| rows.iter().map(|&r| columns[k][r].abs()).fold(0.0, f64::max);
    let width = columns.len();
    let forms = Form::all().into_iter().filter(|f| f.width() == width);
    if width != 3 {
        let of = |form| (Format { form, degrees: false }, 0.0);
        let is_read = |f: &(Format, f64)| {
            let read = rows.iter().filter(|&&r| f.0.read(&row(r)).is_some()).count();
            2 * read > rows.len()
        };
        return forms.map(of).filter(is_read).collect();
    }
    let degrees = (0..3).any(|k| largest(k) > 7.0);
    let half = if degrees { 180.0 } else { PI };
    let norm = |r: &usize| row(*r).iter().map(|x| x * x).sum::<f64>().sqrt();
    let longest = rows.iter().map(norm).fold(0.0, f64::max);
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for &r in rows {
        (low, high) = (low.min(columns[1][r]), high.max(columns[1][r]));
    }
    let slack = 0.005 * half;
    let is_usual = |form: Form| match form {
        Form::RotationVector => longest <= half + slack,
        Form::Euler(set, _) if EulerSet::ALL[usize::from(set)].is_proper() => low > -slack || high < slack,
        Form::Euler(..) => high.max(-low) <= 0.5 * half * 1.001,
        _ => true,
    };
    let cost = |form| if is_usual(form) { 0.0 } else { UNUSUAL };
    forms.map(|form| (Format { form, degrees }, cost(form))).collect()
}

/// What another branch of a format costs, nats.
const UNUSUAL: f64 = 4.0;

impl fmt::Display for Form {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Form::RotationVector => "rotation vector",
            Form::Euler(set, true) => {
                return write!(f, "moving {}", EulerSet::ALL[usize::from(*set)].to_string().to_uppercase());
            }
            Form::Euler(set, false) => return write!(f, "fixed {}", EulerSet::ALL[usize::from(*set)]),
            Form::QuaternionXyzw => "quaternion xyzw",
            Form::QuaternionWxyz => "quaternion wxyz",
            Form::Rows => "two rows",
            Form::Columns => "two columns",
            Form::Matrix => "matrix by rows",
        })
    }
}

impl FromStr for Form {
    type Err = ();
    fn from_str(s: &str) -> Result<Self, ()> {
        Form::all().into_iter().find(|f| f.to_string() == s).ok_or(())
    }
}
