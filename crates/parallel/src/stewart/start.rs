//! Six hyperplanes in P¹⁶ with all of their forty solutions, from which those of every platform are followed.
//!
//! The hyperplanes are drawn by a generator; the solutions stand in `forty.txt` (a line each: e and g, real and imaginary parts in turn),
//! found by [`monodromy`] from one pose through which the hyperplanes were laid. A test finds them again, and another sees by
//! [`trace_defect`] that there are no more.

pub use super::equations::{Study, apart, norm};

use super::equations::{Quadric, half_product};
use super::track::{Care, Line};
use crate::complex::Complex;
use denavit::random::Random;

/// Printed by `cargo run -p denavit-parallel --example forty`.
const FORTY: &str = include_str!("forty.txt");

/// How many poses satisfy six generic hyperplanes.
pub const MOST: usize = 40;

/// A complex number of the square around 0.
fn complex(random: &mut Random) -> Complex {
    let mut signed = || 2.0 * random.unit() - 1.0;
    Complex::new(signed(), signed())
}

/// A complex number of size 1.
pub(super) fn unit(random: &mut Random) -> Complex {
    loop {
        let z = complex(random);
        if (0.01..1.0).contains(&z.norm2()) {
            return z * (1.0 / z.abs());
        }
    }
}

/// A generic hyperplane: a combination of the seventeen forms.
fn hyperplane(random: &mut Random) -> Quadric {
    let zero = [[Complex::ZERO; 4]; 4];
    let mut h = Quadric { ee: zero, eg: zero, gg: complex(random) };
    for i in 0..4 {
        for j in 0..=i {
            h.ee[i][j] = complex(random);
            h.ee[j][i] = h.ee[i][j];
        }
    }
    // 2 g·(e b − a e) with complex a, b: the entries of eᵀ M g.
    let (a, b): ([Complex; 3], [Complex; 3]) =
        (std::array::from_fn(|_| complex(random)), std::array::from_fn(|_| complex(random)));
    let [d, s]: [[Complex; 3]; 2] =
        [std::array::from_fn(|i| b[i] - a[i]), std::array::from_fn(|i| b[i] + a[i])];
    let o = Complex::ZERO;
    let m =
        [[o, -d[0], -d[1], -d[2]], [d[0], o, s[2], -s[1]], [d[1], -s[2], o, s[0]], [d[2], s[1], -s[0], o]];
    h.eg = std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]));
    h
}

/// The hyperplanes, and a pose that satisfies them.
pub(super) fn hyperplanes() -> ([Quadric; 6], Study) {
    let mut random = Random(40);
    let mut pose: Study = std::array::from_fn(|_| complex(&mut random));
    // e·g = 0
    let rest = (0..3).fold(Complex::ZERO, |sum, i| sum + pose[i] * pose[4 + i]);
    pose[7] = -rest / pose[3];
    let all = std::array::from_fn(|_| {
        let mut h = hyperplane(&mut random);
        let n = (0..4).fold(Complex::ZERO, |sum, i| sum + pose[i] * pose[i]);
        let value = half_product(&h.gradient(&pose), &pose);
        for i in 0..4 {
            h.ee[i][i] -= value / n;
        }
        h
    });
    (all, pose)
}

/// The forty solutions of the hyperplanes, |(e, g)| = 1.
pub fn solutions() -> Vec<Study> {
    let number = |word: &str| word.parse::<f64>().unwrap_or(f64::NAN);
    let solution = |line: &str| {
        let parts: Vec<f64> = line.split_whitespace().map(number).collect();
        parts.chunks_exact(2).map(|z| Complex::new(z[0], z[1])).collect::<Vec<_>>().try_into().ok()
    };
    FORTY.lines().filter_map(solution).collect()
}

/// All solutions of the hyperplanes, from one of them: along triangles of lines to other hyperplanes and back, with factors at random,
/// solutions change places.
pub fn monodromy() -> Vec<Study> {
    let (home, seed) = hyperplanes();
    let mut random = Random(41);
    let mut known = vec![seed];
    for _ in 0..40 {
        let away: [Quadric; 6] = std::array::from_fn(|_| hyperplane(&mut random));
        let factors: [[Complex; 6]; 2] = std::array::from_fn(|_| std::array::from_fn(|_| unit(&mut random)));
        let (there, back) = (Line::new(&home, &factors[0], &away), Line::new(&away, &factors[1], &home));
        for i in 0..known.len() {
            let middle = there.follow(&known[i], Care::MORE);
            let end = back.follow(&middle.x, Care::MORE);
            let is_new = middle.is_reached && end.is_reached && known.iter().all(|k| apart(k, &end.x) > 1e-6);
            if is_new {
                known.push(end.x);
            }
        }
        if known.len() >= MOST {
            break;
        }
    }
    known
}

/// By how much the sum of g·g/e·e over these solutions is not linear where the first hyperplane moves parallel to itself, as a part of the
/// sum: the trace test (Sommese, Verschelde and Wampler 2002). It is 0, but for rounding, for all solutions together and for no part of them.
pub fn trace_defect(solutions: &[Study]) -> f64 {
    let (home, _) = hyperplanes();
    let sum = |along: f64| {
        let mut moved = home;
        for (i, row) in moved[0].ee.iter_mut().enumerate() {
            row[i] += Complex::new(0.3, 0.4) * along;
        }
        let line = Line::new(&home, &[Complex::ONE; 6], &moved);
        solutions.iter().fold(Complex::ZERO, |sum, start| {
            let x = line.follow(start, Care::MORE).x;
            let square = |part: &[Complex]| part.iter().fold(Complex::ZERO, |sum, &z| sum + z * z);
            sum + square(&x[4..]) / square(&x[..4])
        })
    };
    let [a, b, c] = [0.0, 1.0, 2.0].map(sum);
    (a - b * 2.0 + c).abs() / (a.abs() + b.abs() + c.abs())
}
