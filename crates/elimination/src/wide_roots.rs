//! Roots of the determinant of the [wider matrix](crate::wide): which of them are true, and the candidates there.

use crate::{
    arm::Joint,
    candidate::Candidate,
    certificate::{Verdict, verdict},
    chart::Chart,
    charts::{NEAR, noise},
    eigen::SHARED,
    extract::{ALMOST, UNKNOWNS},
    fourier::{Fourier, USELESS},
    instructions::Strict,
    products::NullSpace,
    roots::Roots,
    split::Split,
    wide::{DEGREE, MONOMIALS},
    work::Work,
};

/// How deep charts are taken of parts of charts: a group of roots that is not understood there will not be.
pub(crate) const DEEPEST: u32 = 2;
/// Most roots.
const ROOTS: usize = 2 * DEGREE;
/// The group of roots that are of no interest.
const NONE: usize = ROOTS;
/// Roots closer than this may be one that several solutions share, taken apart by rounding.
const TOGETHER: f64 = 2e-3;
/// Pivots below this, compared to the first, may be zeros at a root,
const SMALL: f64 = 1e-3;
/// and below this they are zeros.
const SHARP: f64 = 1e-8;
/// An eigenvalue with a larger relative imaginary part is certainly not real: ten times the root of [`SHARP`], the most
/// by which a double one can be off.
const COMPLEX: f64 = 1e-3;
/// The least pivot of a matrix that has full rank in spite of rounding,
const FULL: f64 = 1e-9;
/// and how many radii of a root it must be away from zero.
const CERTAIN: f64 = 100.0;

/// Finds the roots that a chart shows, and what may belong to them; false if the samples are of no use.
#[inline(never)]
pub(crate) fn wide_candidates(fourier: &Fourier<4>, split: &Split, chart: &Chart, work: &mut Work) -> bool {
    work.candidates.clear();
    let samples = work.matrix.samples(fourier, chart);
    let is_useful = fourier.fit::<Strict>(DEGREE, &samples, &mut work.polynomial);
    if !is_useful || work.polynomial.noise > USELESS {
        return false;
    }
    work.wide.find::<Strict>(&work.polynomial, noise(&work.polynomial));
    let mut group = [NONE; ROOTS];
    for own in 0..grouped(chart, &work.wide, &mut group) {
        settle(split, chart, &group, own, work);
    }
    true
}

/// The verdict on the roots that are not dismissed.
#[inline(never)]
pub(crate) fn wide_verdict(hidden: usize, sign: f64, chart: &Chart, work: &mut Work) -> Verdict {
    verdict(hidden, sign, chart, &work.wide, &work.found, &mut work.marks)
}

/// Real and imaginary part of a root, and its radius.
fn root(roots: &Roots<3>, k: usize) -> (f64, f64, f64) {
    (roots.re[k / 8].0[k % 8], roots.im[k / 8].0[k % 8], roots.radius[k / 8].0[k % 8])
}

/// Numbers the groups of roots near the circle that lie together; how many there are.
fn grouped(chart: &Chart, roots: &Roots<3>, group: &mut [usize; ROOTS]) -> usize {
    let mut groups = 0;
    for k in 0..roots.count {
        let (x, y, r) = root(roots, k);
        let modulus = (x * x + y * y).sqrt();
        let off = (modulus - 1.0).abs();
        if off >= NEAR && off > r || !chart.answers_for(x / modulus + 0.1) {
            continue;
        }
        group[k] = groups;
        groups += 1;
        for j in 0..k {
            let (u, v, _) = root(roots, j);
            let (a, b) = (group[j], group[k]);
            if a == NONE || a == b || (x - u).abs() + (y - v).abs() >= TOGETHER {
                continue;
            }
            // Two groups become one, and the last group takes the number that is free.
            let (low, high) = if a < b { (a, b) } else { (b, a) };
            groups -= 1;
            for one in &mut group[..=k] {
                *one = if *one == high {
                    low
                } else if *one == groups {
                    high
                } else {
                    *one
                };
            }
        }
    }
    groups
}

/// Adds the candidates of a group of roots; those of its roots that no configuration can belong to get a negative radius.
fn settle(split: &Split, chart: &Chart, group: &[usize; ROOTS], own: usize, work: &mut Work) {
    let members = || (0..ROOTS).filter(|&k| group[k] == own);
    let (mut x, mut y, mut size) = (0.0, 0.0, 0);
    for k in members() {
        let (u, v, _) = root(&work.wide, k);
        (x, y, size) = (x + u, y + v, size + 1);
    }
    // If they are one root that as many solutions share, in their middle, then these are all there are, and those that are
    // not real need no configuration.
    let middle = on_circle(chart, x, y);
    let mut space = NullSpace::default();
    if size > 1 {
        space.find(work.matrix.all(middle), SHARP);
    }
    let found =
        if size > 1 && space.count == size { candidates(split, middle, &space, COMPLEX, work) } else { None };
    if let Some(real) = found {
        for k in members().skip(real) {
            work.wide.radius[k / 8].0[k % 8] = -1.0;
        }
        return;
    }
    for k in members() {
        let (x, y, r) = root(&work.wide, k);
        let hidden = on_circle(chart, x, y);
        space.find(work.matrix.all(hidden), SMALL);
        // Full rank at every angle in the disc: a root of the mixtures only.
        if space.least > CERTAIN * chart.kappa * r && space.least > FULL {
            work.wide.radius[k / 8].0[k % 8] = -1.0;
        }
        candidates(split, hidden, &space, ALMOST, work);
    }
}

/// Cosine and sine of the hidden joint in the direction of a point near the circle.
fn on_circle(chart: &Chart, x: f64, y: f64) -> [f64; 2] {
    let modulus = (x * x + y * y).sqrt();
    chart.outside([x / modulus, y / modulus])
}

/// Adds the products in a null space to the candidates: how many; nothing if it is not known which they are.
fn candidates(
    split: &Split,
    hidden: [f64; 2],
    space: &NullSpace,
    tolerance: f64,
    work: &mut Work,
) -> Option<usize> {
    let mut vectors = [[0.0; MONOMIALS]; SHARED];
    let count = space.products(tolerance, &mut vectors)?;
    for y in &vectors[..count] {
        work.candidates.push(Candidate { hidden, x: narrowed(split, y) });
    }
    Some(count)
}

/// The null vector of the 12 × 12 matrix that belongs to a product of powers.
fn narrowed(split: &Split, y: &[f64; MONOMIALS]) -> [f64; UNKNOWNS] {
    let (multiplied, other) = split.multiplied_and_other();
    let [u, v] = pair(multiplied, y);
    let powers = [u * u * u, u * u * v, u * v * v, v * v * v];
    let mut z = [0.0; 4];
    for (power, block) in powers.iter().zip(y.chunks_exact(4)) {
        for (z, y) in z.iter_mut().zip(block) {
            *z += power * y;
        }
    }
    let [a, b] = pair(other, &z);
    let w = match other {
        Joint::Revolute => [1.0, a * a - b * b, 2.0 * a * b],
        Joint::Prismatic => [1.0, b, b * b],
    };
    let r = if multiplied == Joint::Revolute { 3.0f64.sqrt() } else { 1.0 };
    let weights = [1.0, r, r, 1.0];
    std::array::from_fn(|k| weights[k / 3] * powers[k / 3] * w[k % 3])
}

/// The pair `(u, v)` whose third powers four blocks are proportional to: of length 1, or `(1, d)` of a slide.
fn pair(joint: Joint, blocks: &[f64]) -> [f64; 2] {
    let stride = blocks.len() / 4;
    let (mut uu, mut uv, mut vv) = (0.0, 0.0, 0.0);
    for (a, b) in blocks.iter().zip(&blocks[stride..]) {
        uu += a * a;
        uv += a * b;
        vv += b * b;
    }
    let [u, v] = if uu > vv { [uu, uv] } else { [uv, vv] };
    let length = (u * u + v * v).sqrt();
    match joint {
        Joint::Prismatic => [1.0, v / u],
        Joint::Revolute if length > 0.0 => [u / length, v / length],
        Joint::Revolute => [1.0, 0.0],
    }
}
