//! A matrix that is wrong as a whole: another one in its place, its transpose, two of its rows exchanged.

use super::facts::Instead;
use super::matrix::Matrix;
use super::plan::Plan;
use super::subject::Subject;
use super::walk::{Assertion, Pair, Piece};
use denavit::geometry::Transform;
use denavit_reading::slip::{Points, Value};
use denavit_symbolic::{Expr, equal};
use std::collections::BTreeMap;

/// A matrix of more entries is not looked at as a whole.
const MAX_ENTRIES: usize = 64;

/// Of longer arms only the single links are tried.
const MAX_LINKS: usize = 9;

/// The pairs of an assertion that have a place.
fn pairs(assertion: &Assertion) -> Vec<&Pair> {
    let pairs = assertion.pieces.iter().filter_map(|p| match p {
        Piece::Pair(pair) => Some(pair),
        _ => None,
    });
    pairs.filter(|p| p.place.is_some()).collect()
}

/// What a printed matrix with several wrong entries is instead, if every entry of it says so.
pub(super) fn instead(assertion: &Assertion, plan: &Plan) -> Option<Instead> {
    let subject = &plan.subjects[assertion.subject];
    let whole = assertion.whole.as_ref()?;
    let pairs = pairs(assertion);
    if pairs.len() > MAX_ENTRIES {
        return None;
    }
    let d = &subject.description;
    // A letter of the author's for a length that has the value of several may stand for any of them.
    let valued = |e: Expr| e.substitute(|s| d.exact_value(s));
    let as_it_is = |e: Expr| e;
    let all = || elsewhere(whole, subject, plan).into_iter().chain(candidates(whole, subject));
    is_one_of(&pairs, all(), &as_it_is).or_else(|| is_one_of(&pairs, all(), &valued))
}

/// The matrix of several that is printed, if what is printed differs from what should be in more than one entry.
fn is_one_of(
    pairs: &[&Pair],
    mut all: impl Iterator<Item = (Instead, Matrix)>,
    put: &dyn Fn(Expr) -> Expr,
) -> Option<Instead> {
    let mut points = Points::new(5);
    let printed: Vec<Option<[u64; 3]>> = pairs.iter().map(|p| points.value(put(p.value))).collect();
    let wrong = pairs.iter().zip(&printed).filter(|(p, v)| points.value(put(p.wanted)) != **v).count();
    if wrong < 2 {
        return None;
    }
    let mut is = |m: &Matrix| {
        pairs.iter().zip(&printed).all(|(pair, value)| {
            let entry = pair.place.and_then(|(r, c)| m.entry(r - 1, c - 1));
            value.is_some() && entry.is_some_and(|e| points.value(put(e)) == *value)
        })
    };
    let (instead, matrix) = all.find(|(_, m)| is(m))?;
    let is_proved = pairs.iter().all(|p| {
        let entry = p.place.and_then(|(r, c)| matrix.entry(r - 1, c - 1));
        entry.is_some_and(|e| equal(put(p.value), put(e)).is_equal())
    });
    is_proved.then_some(instead)
}

/// The matrix of the same frames by the other tables of the document.
fn elsewhere(whole: &Matrix, subject: &Subject, plan: &Plan) -> Vec<(Instead, Matrix)> {
    let n = subject.last();
    let form = |x: Transform<Expr>| match whole.0.len() {
        3 if whole.0[0].len() == 3 => Matrix::of_rotation(&x.rotation),
        _ => Matrix::of(&x),
    };
    let of = |s: &Subject, i: usize, j: usize| s.transform(Some(i), Some(j)).map(form);
    let mut frames = (0..=n).flat_map(|i| (i + 1..=n).map(move |j| (i, j)));
    let Some((i, j)) = frames.find(|&(i, j)| of(subject, i, j).as_ref() == Some(whole)) else {
        return vec![];
    };
    let others = plan.subjects.iter().filter_map(|s| {
        let matrix = of(s, i, j).filter(|m| m != whole)?;
        Some((Instead::ByTable { of: j, seen_from: i, line: s.line? }, matrix))
    });
    others.collect()
}

/// Matrices that people print for another.
fn candidates(whole: &Matrix, subject: &Subject) -> Vec<(Instead, Matrix)> {
    let mut found = vec![];
    let (rows, columns) = whole.shape().unwrap_or((0, 0));
    if let Some(inverse) = whole.inverse() {
        found.push((Instead::Inverse, inverse));
    }
    if rows == columns {
        found.push((Instead::Transpose, whole.transposed()));
    }
    if (rows, columns) == (4, 4) {
        let mut turned = whole.clone();
        for r in 0..3 {
            for c in 0..3 {
                turned.0[r][c] = whole.0[c][r];
            }
        }
        found.push((Instead::RotationTransposed, turned));
    }
    let last = |n: usize| if n == 4 { 3 } else { n };
    for i in 0..last(rows) {
        for j in i + 1..last(rows) {
            let mut m = whole.clone();
            m.0.swap(i, j);
            found.push((Instead::RowsExchanged(i + 1, j + 1), m));
        }
        let mut m = whole.clone();
        m.0[i].iter_mut().for_each(|e| *e = e.map(|e| -e));
        found.push((Instead::RowSigns(i + 1), m));
    }
    for i in 0..last(columns) {
        for j in i + 1..last(columns) {
            let mut m = whole.clone();
            m.0.iter_mut().for_each(|row| row.swap(i, j));
            found.push((Instead::ColumnsExchanged(i + 1, j + 1), m));
        }
        let mut m = whole.clone();
        m.0.iter_mut().for_each(|row| row[i] = row[i].map(|e| -e));
        found.push((Instead::ColumnSigns(i + 1), m));
    }
    let n = subject.last();
    let form = |x: &Transform<Expr>| match (rows, columns) {
        (3, 3) => Some(Matrix::of_rotation(&x.rotation)),
        (3 | 4, 4) => Some(Matrix::of(x)),
        _ => None,
    };
    let link = |k: usize| subject.transform(Some(k), Some(k + 1));
    let product = |links: Vec<usize>| {
        let whole = links.into_iter().try_fold(Transform::identity(), |x, k| Some(x * link(k)?))?;
        form(&whole)
    };
    let longest = if n > MAX_LINKS { 1 } else { n };
    let pairs = || (0..=n).flat_map(|i| (i + 1..=n.min(i + longest)).map(move |j| (i, j)));
    for (i, j) in pairs() {
        found.extend(product((i..j).collect()).map(|m| (Instead::Frame { of: j, seen_from: i }, m)));
    }
    for (i, j) in pairs().filter(|(i, j)| j - i > 1) {
        let backwards = product((i..j).rev().collect());
        found.extend(backwards.map(|m| (Instead::Backwards { of: j, seen_from: i }, m)));
        for without in i..j {
            let rest = product((i..j).filter(|k| *k != without).collect());
            let link = without + 1;
            found.extend(rest.map(|m| (Instead::Without { of: j, seen_from: i, link }, m)));
        }
    }
    found
}

/// The entries of a matrix that stand in each other's place, by their numbers among the pieces.
pub(super) fn exchanged(assertion: &Assertion) -> BTreeMap<usize, usize> {
    let mut points = Points::new(5);
    let mut wrong: BTreeMap<(Value, Value), Vec<usize>> = BTreeMap::new();
    let mut found = BTreeMap::new();
    let pair_of = |i: usize| match assertion.pieces.get(i) {
        Some(Piece::Pair(pair)) => Some(pair),
        _ => None,
    };
    for i in 0..assertion.pieces.len() {
        let Some(pair) = pair_of(i).filter(|p| p.place.is_some() && p.printed.is_some()) else { continue };
        let (Some(printed), Some(right)) = (points.value(pair.value), points.value(pair.wanted)) else {
            continue;
        };
        if printed == right {
            continue;
        }
        let others = wrong.get(&(right, printed)).into_iter().flatten().copied();
        let mut others = others.filter(|k| !found.contains_key(k));
        // Of several the one across the diagonal.
        let across = pair.place.map(|(r, c)| (c, r));
        let other =
            others.clone().find(|&k| pair_of(k).and_then(|p| p.place) == across).or_else(|| others.next());
        if let Some(other) = other
            && let Some(b) = pair_of(other)
            && equal(pair.value, b.wanted).is_equal()
            && equal(b.value, pair.wanted).is_equal()
        {
            found.extend([(i, other), (other, i)]);
        }
        wrong.entry((printed, right)).or_default().push(i);
    }
    found
}
