//! A wider matrix of the hidden joint, for poses at which the [determinant](crate::determinant) vanishes identically.
//!
//! Where the last axis is parallel to the first, as with a tool that points straight down, the six equations have
//! relations: three of them imply the others, but the 12 × 12 matrix is too narrow to see it, and has two null vectors at
//! every value of the hidden joint. With half angles for both joints that are not hidden, `(u, v)` and `(u', v')`, the
//! equations are forms of degree 2 in either pair. Multiplied by `u u'`, `u v'`, `v u'` and `v v'` they are 24 equations
//! between the 16 monomials of degree 3 in either pair, and these lose rank only where there is a solution.
//!
//! Sixteen fixed mixtures of them have a determinant of degree 12 in the hidden angle. Those of its 24 roots are true at
//! which all 24 equations lose rank: the mixtures add others, and complex solutions at a real angle add pairs. Both are
//! recognised and dismissed, so that the [certificate](crate::certificate) asks for the rest only.

use crate::{
    answer::{Candidate, Work},
    arm::Joint,
    certificate::{Verdict, verdict},
    chart::Chart,
    charts::{NEAR, noise},
    eliminate::Eliminated,
    extract::{ALMOST, SHARED, UNKNOWNS},
    fourier::Fourier,
    lanes::Lanes,
    products::NullSpace,
    roots::Roots,
    solve::USELESS,
    split::Split,
};

/// Unknowns: `u³ … v³` times `u'³ … v'³`, the second faster.
pub(crate) const MONOMIALS: usize = 16;
/// Equations: six times four multipliers.
pub(crate) const EQUATIONS: usize = 24;
/// Degree of the determinant in the hidden angle.
pub(crate) const DEGREE: usize = 12;

/// How deep charts are taken of parts of charts: a group of roots that is not understood there will not be.
pub(crate) const DEEPEST: u32 = 2;

/// A form of degree 2 in both pairs: coefficients of `u², u v, v²` times those of the other pair, the latter faster.
type Form = [f64; 9];
/// Forms over `(1, c, s)` of the hidden joint.
type Forms<const N: usize> = [[Form; N]; 3];

/// The equations of a pose in half angles.
#[derive(Clone, Debug)]
pub(crate) struct Wide {
    /// The six equations.
    own: Forms<6>,
    /// Four mixtures of them for each multiplier.
    mixed: Forms<MONOMIALS>,
}

impl Default for Wide {
    fn default() -> Wide {
        Wide { own: [[[0.0; 9]; 6]; 3], mixed: [[[0.0; 9]; MONOMIALS]; 3] }
    }
}

impl Wide {
    /// Takes the equations of a pose. They have their own sizes again: one that is all rounding must not be enlarged.
    #[inline(never)]
    pub fn fill(&mut self, eliminated: &Eliminated, split: &Split) {
        let (multiplied, other) = split.multiplied_and_other();
        for (part, forms) in self.own.iter_mut().enumerate() {
            for (i, form) in forms.iter_mut().enumerate() {
                let mut entries = [0.0; 9];
                for (entry, x) in entries.iter_mut().zip(&eliminated.rows[i][9 * part..]) {
                    *entry = x * eliminated.sizes[i];
                }
                *form = halved(multiplied, 3, halved(other, 1, entries));
            }
        }
        for (mixed, own) in self.mixed.iter_mut().zip(&self.own) {
            for (i, form) in mixed.iter_mut().enumerate() {
                *form = [0.0; 9];
                for (j, equation) in own.iter().enumerate() {
                    let weight = weight(i, j);
                    for (entry, x) in form.iter_mut().zip(equation) {
                        *entry += weight * x;
                    }
                }
            }
        }
    }

    /// The determinants of the mixtures at the nodes of a chart.
    fn samples(&self, fourier: &Fourier<4>, chart: &Chart) -> [Lanes; 4] {
        let mut samples = [Lanes::ZERO; 4];
        for (g, sample) in samples.iter_mut().enumerate() {
            let [c, s, weight] = chart.nodes::<false>(fourier.cosines[g], fourier.sines[g]);
            for l in 0..8 {
                let square = weight.0[l] * weight.0[l];
                let fourth = square * square;
                sample.0[l] = self.determinant(c.0[l], s.0[l]) * (fourth * fourth * fourth);
            }
        }
        samples
    }

    /// The determinant of the mixtures, by elimination with partial pivoting.
    fn determinant(&self, c: f64, s: f64) -> f64 {
        let mut m = [[0.0; MONOMIALS]; MONOMIALS];
        for (i, row) in m.iter_mut().enumerate() {
            place(&at(&self.mixed, i, c, s), i / 4, row);
        }
        let mut product = 1.0;
        for k in 0..MONOMIALS {
            let mut best = k;
            for r in k + 1..MONOMIALS {
                if m[r][k].abs() > m[best][k].abs() {
                    best = r;
                }
            }
            if best != k {
                m.swap(k, best);
                product = -product;
            }
            let pivot = m[k];
            product *= pivot[k];
            if pivot[k] == 0.0 {
                return 0.0;
            }
            let inverse = 1.0 / pivot[k];
            for row in &mut m[k + 1..] {
                let factor = row[k] * inverse;
                for (entry, pivot) in row.iter_mut().zip(&pivot) {
                    *entry -= factor * pivot;
                }
            }
        }
        product
    }

    /// All equations at a value of the hidden joint.
    fn all(&self, [c, s]: [f64; 2]) -> [[f64; MONOMIALS]; EQUATIONS] {
        let mut m = [[0.0; MONOMIALS]; EQUATIONS];
        for (i, row) in m.iter_mut().enumerate() {
            place(&at(&self.own, i / 4, c, s), i % 4, row);
        }
        m
    }
}

/// From the monomials of a joint, every `stride` entries, to those of its half angle: `1 = u² + v²`, `c = u² − v²`,
/// `s = 2 u v`; a slide's stay as they are.
fn halved(joint: Joint, stride: usize, mut form: Form) -> Form {
    if joint == Joint::Revolute {
        for at in (0..9).filter(|at| (at / stride).is_multiple_of(3)) {
            let (one, c, s) = (form[at], form[at + stride], form[at + 2 * stride]);
            (form[at], form[at + stride], form[at + 2 * stride]) = (one + c, 2.0 * s, one - c);
        }
    }
    form
}

/// `F₁ + c F_c + s F_s`
fn at<const N: usize>(forms: &Forms<N>, i: usize, c: f64, s: f64) -> Form {
    std::array::from_fn(|k| forms[0][i][k] + c * forms[1][i][k] + s * forms[2][i][k])
}

/// A form times one of the four multipliers, in a row of zeros.
fn place(form: &Form, multiplier: usize, row: &mut [f64; MONOMIALS]) {
    for i in 0..3 {
        let to = 4 * (i + multiplier / 2) + multiplier % 2;
        row[to..to + 3].copy_from_slice(&form[3 * i..3 * i + 3]);
    }
}

/// A fixed number between −1 and 1 without pattern.
fn weight(i: usize, j: usize) -> f64 {
    let x = (6 * i + j + 1) as f64 * 0.754_877_666_246_692_8;
    let y = (x - x.floor()) * 997.0;
    2.0 * (y - y.floor()) - 1.0
}

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
    let is_useful = fourier.fit::<false>(DEGREE, &samples, &mut work.polynomial);
    if !is_useful || work.polynomial.noise > USELESS {
        return false;
    }
    work.wide.find::<false>(&work.polynomial, noise(&work.polynomial));
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
    if size > 1 && space.count == size {
        let real = candidates(split, middle, &space, COMPLEX, work);
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

/// Adds the products in a null space to the candidates: how many.
fn candidates(split: &Split, hidden: [f64; 2], space: &NullSpace, tolerance: f64, work: &mut Work) -> usize {
    let mut vectors = [[0.0; MONOMIALS]; SHARED];
    let count = space.products(tolerance, &mut vectors);
    for y in &vectors[..count] {
        work.candidates.push(Candidate { hidden, x: narrowed(split, y) });
    }
    count
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
