//! Equations without meaning, one for each kind of root that the six angles do not have.

use super::certificate;
use denavit_emit::{Certificate, KnownSolution, SolverVector};
use denavit_program::solver::{Draft, Output, Root, Solver, SolverBuilder};
use denavit_symbolic::{Expr, Symbol};
use std::f64::consts::PI;

const GIVEN: [&str; 9] = ["e1", "e2", "e3", "e4", "g", "a", "h", "b", "m"];

fn symbols(names: &[&str]) -> Vec<Symbol> {
    names.iter().map(|n| Symbol::new(n)).collect()
}

/// `e1 cos² + e2 cos sin + e3 cos + e4 sin + g = 0`, `a r² + 2 cos r + h = 0`, `(b + sin) w = m`, `(e3 + r) sin φ = w cos φ`.
///
/// Without the first equation, `(cos, sin)` is the direction of (e1, e2), and m the sum of its sine and cosine.
pub fn solver(has_quartic: bool) -> Solver {
    let results = ["c", "double", "branch", "r", "k2", "w", "cf", "sf", "k4"];
    let mut builder = SolverBuilder::new(&symbols(&GIVEN), &[], &symbols(&results));
    let [e1, e2, e3, e4, g, a, h, b, m] = GIVEN.map(Expr::symbol);
    let [c, s, _, r, _, w, cf, sf, _] = results.map(Expr::symbol);
    let node = |builder: &mut SolverBuilder, root: Root<Expr>, names: &[&str]| {
        let root = root.map(|e| builder.trace(e));
        builder.node(Draft { root, guard: None, degree: 0, results: symbols(names), label: None });
    };
    let m = if has_quartic { m } else { m.sin() + m.cos() };
    if has_quartic {
        node(&mut builder, Root::Quartic { cc: e1, cs: e2, c: e3, s: e4, one: g }, &results[..3]);
    } else {
        node(&mut builder, Root::Direction { x: e1, y: e2, sign: Some(e4) }, &results[..2]);
    }
    node(&mut builder, Root::Quadratic { a, b: c, c: h }, &results[3..5]);
    node(&mut builder, Root::Ratio { numerator: m, denominator: b + s }, &results[5..6]);
    node(&mut builder, Root::Line { x: e3 + r, y: w }, &results[6..]);
    let terms = [
        if has_quartic { e1 * c * c + e2 * c * s + e3 * c + e4 * s + g } else { e1 * s - e2 * c },
        a * r * r + Expr::int(2) * c * r + h,
        (b + s) * w - m,
        (e3 + r) * sf - w * cf,
    ];
    let residual = terms.iter().map(|&e| e * e).reduce(|a, b| a + b).expect("some").sqrt();
    let outputs =
        [("theta", s.atan2(c), true), ("r", r, false), ("w", w, false), ("phi", sf.atan2(cf), true)];
    let outputs: Vec<Output> = outputs
        .into_iter()
        .map(|(name, e, is_angle)| Output { name: name.into(), value: builder.trace(e), is_angle })
        .collect();
    let (residual, size) = (builder.trace(residual), builder.trace(Expr::int(1)));
    builder.finish(&outputs, residual, size)
}

/// The roots of a function on a circle where it changes its sign, by halves.
fn roots(f: impl Fn(f64) -> f64) -> Vec<f64> {
    let n = 4096;
    let at = |k: i32| PI * (2.0 * (f64::from(k) + 0.37) / f64::from(n) - 1.0);
    let between = |k: i32| {
        let (mut low, mut high) = (at(k), at(k + 1));
        let sign = f(low) < 0.0;
        for _ in 0..80 {
            let x = 0.5 * (low + high);
            if (f(x) < 0.0) == sign { low = x } else { high = x }
        }
        low
    };
    (0..n).filter(|&k| (f(at(k)) < 0.0) != (f(at(k + 1)) < 0.0)).map(between).collect()
}

/// All solutions by search.
fn solutions(has_quartic: bool, [e1, e2, e3, e4, g, a, h, b, m]: [f64; 9]) -> Vec<KnownSolution> {
    let mut found = vec![];
    let f = |x: f64| e1 * x.cos().powi(2) + e2 * x.cos() * x.sin() + e3 * x.cos() + e4 * x.sin() + g;
    let m = if has_quartic { m } else { m.sin() + m.cos() };
    let one = if e4 < 0.0 { f64::atan2(-e2, -e1) } else { f64::atan2(e2, e1) };
    for theta in if has_quartic { roots(f) } else { vec![one] } {
        let (s, c) = theta.sin_cos();
        let d = c * c - a * h;
        let radii = match a {
            0.0 => vec![-h / (2.0 * c)],
            _ if d < 0.0 => vec![],
            _ => vec![(-c + d.sqrt()) / a, (-c - d.sqrt()) / a],
        };
        for r in radii {
            let w = m / (b + s);
            let phi = w.atan2(e3 + r);
            for phi in [phi, phi + PI] {
                found.push(KnownSolution { results: vec![theta, r, w, phi], multiplicity: 1, free: 0 });
            }
        }
    }
    found
}

/// Four, two and no zeros, a linear equation, a zero at π, one that is touched, and a factor that vanishes.
pub fn vectors(has_quartic: bool) -> Vec<SolverVector> {
    let at = |[e1, e2, e3, e4]: [f64; 4], theta: f64| {
        let (s, c) = theta.sin_cos();
        -(e1 * c * c + e2 * c * s + e3 * c + e4 * s)
    };
    let e = [0.9, -0.4, 0.2, 0.3];
    let f = [0.2, -0.1, 1.0, -0.7];
    let mut list = vec![
        [e[0], e[1], e[2], e[3], at(e, 0.7), 1.5, -0.6, 2.0, 0.7],
        [f[0], f[1], f[2], f[3], at(f, -2.0), 0.7, 0.1, 1.5, -0.4],
        [e[0], e[1], e[2], e[3], 5.0, 1.5, -0.6, 2.0, 0.7],
        [e[0], e[1], e[2], e[3], at(e, 2.2), 0.0, 0.6, 2.0, 0.7],
        [f[0], f[1], f[2], f[3], at(f, PI), 1.2, -0.5, 2.0, 1.7],
        [
            if has_quartic { 0.0 } else { -3.0 },
            0.0,
            f[2],
            f[3],
            at([0.0, 0.0, f[2], f[3]], 0.4),
            1.2,
            -0.5,
            2.0,
            1.7,
        ],
    ]
    .into_iter()
    .map(|x: [f64; 9]| {
        let solutions = solutions(has_quartic, x);
        // Without its square, the second equation has a root at infinity.
        let certificate = if x[5] == 0.0 { Certificate::Singular } else { certificate(&solutions) };
        let variables = x.to_vec();
        SolverVector { variables, parameters: vec![], solutions, certificate, tolerance: 1e-10 }
    })
    .collect::<Vec<_>>();
    if !has_quartic {
        return list;
    }
    // cos² − 2 cos + 1 = (cos − 1)²: touches 0 at 0; the factor b + sin and its product are 0 there: w = 0 is free.
    let known =
        |r: f64, phi: f64| KnownSolution { results: vec![0.0, r, 0.0, phi], multiplicity: 2, free: 1 << 2 };
    let (up, down) = (-1.0 + 3_f64.sqrt(), -1.0 - 3_f64.sqrt());
    list.push(SolverVector {
        variables: vec![1.0, 0.0, -2.0, 0.0, 1.0, 1.0, -2.0, 0.0, 0.0],
        parameters: vec![],
        solutions: vec![known(up, 0.0), known(up, PI), known(down, 0.0), known(down, PI)],
        certificate: Certificate::Singular,
        tolerance: 1e-6,
    });
    list
}
