//! What a matrix or a vector is by the robot where its name does not say: its value is asked.

use super::facts::{Jacobian, Meaning};
use super::matrix::Matrix;
use super::subject::Subject;
use denavit::forward::Reference;
use denavit::geometry::{Axis, Transform, Vector};
use denavit_reading::slip::{Points, Value};
use denavit_symbolic::Expr;

/// No more frames are looked at, each in each other.
const MAX_FRAMES: usize = 10;

/// A matrix of the robot, and what it is.
pub(super) type Candidate = (Matrix, Meaning);

/// The matrices and vectors of this shape that people print, the usual ones first.
pub(super) fn candidates(subject: &Subject, shape: (usize, usize)) -> Vec<Candidate> {
    match shape {
        (1, columns) if columns > 1 => {
            candidates(subject, (columns, 1)).into_iter().map(|(m, about)| (m.transposed(), about)).collect()
        }
        (4, 4) => {
            let all = frames(subject);
            let still = all.iter().filter(
                |(_, f)| matches!(f, Meaning::Frame { seen_from, .. } if *seen_from == subject.ground()),
            );
            let still: Vec<Candidate> = still
                .map(|(x, f)| (at_rest(subject, &Matrix::of(x)), Meaning::AtRest(f.clone().into())))
                .collect();
            all.into_iter().map(|(x, frame)| (Matrix::of(&x), frame)).chain(still).collect()
        }
        (3, 3) => {
            let frames = frames(subject);
            let turns = frames.iter().map(|(x, frame)| {
                (Matrix::of_rotation(&x.rotation), Meaning::Rotation(frame.clone().into()))
            });
            let flat = frames.iter().filter_map(|(x, frame)| Some((in_plane(x)?, frame.clone())));
            turns.chain(flat).collect()
        }
        (rows @ (2 | 3), 1) => {
            let cut = |v: &Vector<Expr>| Matrix(Matrix::column(v).0.into_iter().take(rows).collect());
            let frames = frames(subject);
            let origins =
                frames.iter().map(|(x, f)| (cut(&x.translation), Meaning::Origin(f.clone().into())));
            let axes = frames.iter().filter(|_| rows == 3).flat_map(|(x, f)| {
                let own = [(Axis::Z, x.rotation.z()), (Axis::X, x.rotation.x()), (Axis::Y, x.rotation.y())];
                own.map(|(axis, v)| (cut(&v), Meaning::Axis(axis, f.clone().into())))
            });
            let still = axes_at_rest(subject).into_iter().filter(|_| rows == 3);
            origins
                .chain(axes)
                .chain(columns(subject, rows))
                .chain(velocities(subject, rows))
                .chain(still)
                .collect()
        }
        (6, 1) => columns(subject, 6).into_iter().chain(screws(subject)).collect(),
        _ => vec![],
    }
}

/// All frames in each other, those in the base first.
fn frames(subject: &Subject) -> Vec<(Transform<Expr>, Meaning)> {
    let n = subject.last().min(MAX_FRAMES);
    let place = |k: usize| if k > n { None } else { Some(k) };
    let reference = |k: usize| place(k).map_or(Reference::Tool, Reference::Frame);
    let pose = (subject.pose(), Meaning::Frame { of: Reference::Tool, seen_from: subject.ground() });
    let pairs = (0..=n + 1).flat_map(|i| (0..=n + 1).rev().map(move |j| (i, j))).filter(|(i, j)| i != j);
    let between = pairs.filter_map(|(i, j)| {
        let x = subject.transform(place(i), place(j))?;
        Some((x, Meaning::Frame { of: reference(j), seen_from: reference(i) }))
    });
    let all: Vec<_> = std::iter::once(pose).chain(between).collect();
    // From the base outwards, then back.
    let is_forward = |m: &Meaning| match m {
        Meaning::Frame { of: Reference::Tool, .. } => true,
        Meaning::Frame { of: Reference::Frame(j), seen_from: Reference::Frame(i) } => i < j,
        _ => false,
    };
    let (forward, back): (Vec<_>, Vec<_>) = all.into_iter().partition(|x| is_forward(&x.1));
    forward.into_iter().chain(back).collect()
}

/// The motion in the plane of a transform that stays in it: rotation and position of two coordinates.
fn in_plane(x: &Transform<Expr>) -> Option<Matrix> {
    let m = x.matrix();
    let is_flat = m[2][2].is_one() && m[2][0].is_zero() && m[2][1].is_zero();
    let row = |r: usize| vec![Some(m[r][0]), Some(m[r][1]), Some(m[r][3])];
    let last = [0, 0, 1].map(|n| Some(Expr::int(n))).to_vec();
    is_flat.then(|| Matrix(vec![row(0), row(1), last]))
}

/// Columns of the hand's Jacobian along the axes of the base: whole, the linear and the angular part, or those of a motion in a
/// plane of the base, (x, y, φ) and (x, z, φ).
fn columns(subject: &Subject, rows: usize) -> Vec<Candidate> {
    let axes = subject.ground();
    let full = subject.geometric_rows(Reference::Tool, axes);
    let parts: &[([u8; 6], bool)] = match rows {
        6 => &[([0, 1, 2, 3, 4, 5], false), ([3, 4, 5, 0, 1, 2], true)],
        3 => &[
            ([0, 1, 2, 3, 4, 5], false),
            ([3, 4, 5, 0, 1, 2], false),
            ([0, 1, 5, 2, 3, 4], false),
            ([0, 2, 4, 1, 3, 5], false),
        ],
        _ => &[([0, 1, 2, 3, 4, 5], false), ([3, 4, 5, 0, 1, 2], false)],
    };
    let mut found = vec![];
    for joint in 0..subject.joints().len() {
        for &(order, is_angular_first) in parts {
            let entry = |k: &u8| vec![full[usize::from(*k)].get(joint).copied()];
            let jacobian = Jacobian { body: Reference::Tool, at: None, axes, is_angular_first, rows, order };
            let column = Matrix(order[..rows].iter().map(entry).collect());
            found.push((column, Meaning::Column(joint + 1, jacobian)));
        }
    }
    found
}

/// The velocities of all frames, along their own axes and those of the base, in the joints' rates.
fn velocities(subject: &Subject, rows: usize) -> Vec<Candidate> {
    let n = subject.last().min(MAX_FRAMES);
    let rates = subject.rates();
    let bodies = std::iter::once(Reference::Tool).chain((1..=n).rev().map(Reference::Frame));
    let mut found = vec![];
    for of in bodies {
        for along in [subject.ground(), of] {
            let full = subject.geometric_rows(of, along);
            let sum = |r: usize| {
                let terms = full[r].iter().zip(&rates);
                vec![Some(terms.fold(Expr::int(0), |sum, (&e, &rate)| sum + e * rate))]
            };
            for is_angular in [false, true] {
                let first = if is_angular { 3 } else { 0 };
                let column = Matrix((first..first + rows).map(sum).collect());
                found.push((column, Meaning::Velocity { of, along, is_angular }));
            }
        }
    }
    found
}

/// A matrix with all joints at 0.
fn at_rest(subject: &Subject, m: &Matrix) -> Matrix {
    let joints = subject.joints();
    let still = |e: Expr| e.substitute(|s| joints.contains(&s.into()).then(|| Expr::int(0)));
    Matrix(m.0.iter().map(|row| row.iter().map(|e| e.map(still)).collect()).collect())
}

/// The directions of the joints' axes with all joints at 0, and the moments of the axes.
fn axes_at_rest(subject: &Subject) -> Vec<Candidate> {
    let screws = screws(subject);
    let part = |rows: std::ops::Range<usize>, m: &Matrix| Matrix(m.0[rows].to_vec());
    let of = |(m, about): &Candidate| [(part(0..3, m), about.clone()), (part(3..6, m), about.clone())];
    screws.iter().step_by(2).flat_map(of).collect()
}

/// The screws of the joints about the base with all joints at 0, the direction of the axis first, then last.
fn screws(subject: &Subject) -> Vec<Candidate> {
    let n = subject.last();
    if n > MAX_FRAMES {
        return vec![];
    }
    let full = subject.geometric_rows_at(Reference::Frame(0), subject.ground());
    let mut found = vec![];
    for joint in 0..subject.joints().len() {
        for is_linear_first in [false, true] {
            let order = if is_linear_first { [0, 1, 2, 3, 4, 5] } else { [3, 4, 5, 0, 1, 2] };
            let column = Matrix(order.iter().map(|&r: &usize| vec![full[r].get(joint).copied()]).collect());
            found.push((at_rest(subject, &column), Meaning::Screw { joint: joint + 1, is_linear_first }));
        }
    }
    found
}

/// How a printed matrix agrees with one of the robot's.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Agreement {
    /// Entries other than 0 and 1 in print, and how many of them agree.
    pub telling: usize,
    pub agreeing: usize,
    /// All entries agree.
    pub is_whole: bool,
}

/// The candidate that agrees with a matrix of formulas in most entries.
pub(super) fn nearest(subject: &Subject, printed: &Matrix) -> Option<(Candidate, Agreement)> {
    nearest_with(subject, printed, &|e| e)
}

/// The same where lengths have the values of a program.
pub(super) fn nearest_with(
    subject: &Subject,
    printed: &Matrix,
    given: &dyn Fn(Expr) -> Expr,
) -> Option<(Candidate, Agreement)> {
    let shape = printed.shape()?;
    let mut points = Points::new(29);
    let mut key = |m: &Matrix| -> Vec<Option<Value>> {
        m.0.iter().flatten().map(|e| e.and_then(|e| points.value(e))).collect()
    };
    let wanted = key(printed);
    let is_told = printed.0.iter().flatten().all(Option::is_some);
    let tells: Vec<bool> =
        printed.0.iter().flatten().map(|e| e.is_some_and(|e| e.as_number().is_none())).collect();
    let telling = tells.iter().filter(|t| **t).count();
    let mut best: Option<(Candidate, Agreement)> = None;
    for candidate in candidates(subject, shape) {
        let lengths =
            |m: &Matrix| Matrix(m.0.iter().map(|r| r.iter().map(|e| e.map(given)).collect()).collect());
        let own = key(&lengths(&candidate.0));
        let agrees: Vec<bool> = wanted.iter().zip(&own).map(|(a, b)| a.is_some() && a == b).collect();
        let agreeing = agrees.iter().zip(&tells).filter(|(a, t)| **a && **t).count();
        let is_whole = is_told && agrees.iter().all(|a| *a);
        let found = Agreement { telling, agreeing, is_whole };
        let is_better = best.as_ref().is_none_or(|b| (is_whole, agreeing) > (b.1.is_whole, b.1.agreeing));
        if is_better {
            best = Some((candidate, found));
        }
    }
    best
}
