//! Six angles of a chain with three parallel axes, solved by hand: α = 90, 0, 0, 90, −90, 0 degrees.

use denavit_program::solver::{Draft, Output, Root, Solver, SolverBuilder};
use denavit_symbolic::{Expr, Rational, Symbol};

/// d1, a2, a3, d4, d5, d6.
pub const LENGTHS: [f64; 6] = [0.089159, -0.425, -0.39225, 0.10915, 0.09465, 0.0823];
pub const PARAMETERS: [&str; 6] = ["d1", "a2", "a3", "d4", "d5", "d6"];

/// The names of the 3 × 4 matrix.
pub const POSE: [&str; 12] =
    ["r11", "r12", "r13", "p_x", "r21", "r22", "r23", "p_y", "r31", "r32", "r33", "p_z"];

fn symbols(names: &[&str]) -> Vec<Symbol> {
    names.iter().map(|n| Symbol::new(n)).collect()
}

/// All angles from the matrix; the lengths are parameters if they are to be, else numbers.
pub fn solver(has_parameters: bool) -> Solver {
    let results = ["c1", "s1", "k1", "s5", "k5", "c234", "s234", "c3", "s3", "k3", "c2", "s2"];
    let parameters = if has_parameters { symbols(&PARAMETERS) } else { vec![] };
    let mut b = SolverBuilder::new(&symbols(&POSE), &parameters, &symbols(&results));
    let number =
        |x: f64| Expr::from(Rational::from_f64((x * 1e6).round()).expect("finite")) / Expr::int(1_000_000);
    let length = |k: usize| if has_parameters { Expr::symbol(PARAMETERS[k]) } else { number(LENGTHS[k]) };
    let [d1, a2, a3, d4, d5, d6] = [0, 1, 2, 3, 4, 5].map(length);
    let u = POSE.map(Expr::symbol);
    let [s, n, a, p] = [0, 1, 2, 3].map(|j| [u[j], u[4 + j], u[8 + j]]);
    let p = [p[0] - d6 * a[0], p[1] - d6 * a[1], p[2] - d6 * a[2] - d1];
    let [c1, s1, _, s5, k5, c234, s234, c3, s3, _, c2, s2] = results.map(Expr::symbol);
    let node = |b: &mut SolverBuilder,
                root: Root<Expr>,
                guard: Option<Expr>,
                degree,
                names: &[&str],
                label: &str| {
        let root = root.map(|e| b.trace(e));
        let guard = guard.map(|e| b.trace(e));
        b.node(Draft { root, guard, degree, results: symbols(names), label: Some(label.into()) });
    };
    // In frame 1: v = c1·x₁ + s1·x₂, x₃, w = s1·x₁ − c1·x₂ of a column x.
    let v = |x: [Expr; 3]| c1 * x[0] + s1 * x[1];
    let w = |x: [Expr; 3]| s1 * x[0] - c1 * x[1];

    // s1·p₁ − c1·p₂ = d4
    let root = Root::Sincos { a: -p[1], b: p[0], c: d4, discriminant: None };
    node(&mut b, root, None, 1, &["c1", "s1", "k1"], "shoulder");
    // w_s = s5·c6, w_n = −s5·s6, w_a = c5
    node(&mut b, Root::Length { x: w(s), y: w(n) }, None, 0, &["s5", "k5"], "wrist");
    let c5 = w(a);
    // v_a = −c234·s5, a₃ = −s234·s5
    let root = Root::Direction { x: -v(a), y: -a[2], sign: Some(k5) };
    node(&mut b, root, None, 0, &["c234", "s234"], "forearm");
    let (s6, c6) = (c234 * s[2] - s234 * v(s), c234 * n[2] - s234 * v(n));
    // a2·c2 + a3·c23 = x, a2·s2 + a3·s23 = z
    let (x, z) = (v(p) - d5 * s234, p[2] + d5 * c234);
    let q = x * x + z * z;
    let root = Root::Sincos {
        a: Expr::int(2) * a2 * a3,
        b: Expr::int(0),
        c: q - a2 * a2 - a3 * a3,
        discriminant: Some(((a2 + a3) * (a2 + a3) - q) * (q - (a2 - a3) * (a2 - a3))),
    };
    node(&mut b, root, None, 2, &["c3", "s3", "k3"], "elbow");
    let (l, m) = (a2 + a3 * c3, a3 * s3);
    let root = Root::Direction { x: l * x + m * z, y: l * z - m * x, sign: None };
    node(&mut b, root, Some(q.sqrt()), 1, &["c2", "s2"], "upper");

    let [q1, q2, q3, q234, q5, q6] =
        [(s1, c1), (s2, c2), (s3, c3), (s234, c234), (s5, c5), (s6, c6)].map(|(s, c)| s.atan2(c));
    let angles = [("q1", q1), ("q2", q2), ("q3", q3), ("q4", q234 - q2 - q3), ("q5", q5), ("q6", q6)];
    let outputs: Vec<Output> = angles
        .into_iter()
        .map(|(name, e)| Output { name: name.into(), value: b.trace(e), is_angle: true })
        .collect();
    let sum = |terms: &[Expr]| terms.iter().map(|&e| e * e).reduce(|a, b| a + b).expect("some");
    let size = sum(&[p[0], p[1], p[2], a2, a3, d4, d5, d6]).sqrt();
    let turned = sum(&[
        w(s) - s5 * c6,
        w(n) + s5 * s6,
        v(a) + c234 * s5,
        a[2] + s234 * s5,
        v(s) - (c234 * (c5 * c6) - s234 * s6),
        s[2] - (s234 * (c5 * c6) + c234 * s6),
        v(n) + (c234 * (c5 * s6) + s234 * c6),
        n[2] + (s234 * (c5 * s6) - c234 * c6),
    ]);
    let moved = sum(&[w(p) - d4, x - (l * c2 - m * s2), z - (l * s2 + m * c2)]);
    let residual = (turned + moved / (size * size)).sqrt();
    let (residual, size) = (b.trace(residual), b.trace(size));
    b.finish(&outputs, residual, size)
}

/// The matrix of six angles: the product of Rz(θ)·Tz(d)·Tx(a)·Rx(α).
pub fn forward([d1, a2, a3, d4, d5, d6]: [f64; 6], q: &[f64]) -> Vec<f64> {
    let rows =
        [(d1, 0.0, 1.0), (0.0, a2, 0.0), (0.0, a3, 0.0), (d4, 0.0, 1.0), (d5, 0.0, -1.0), (d6, 0.0, 0.0)];
    let mut t = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    for (angle, (d, a, sa)) in q.iter().zip(rows) {
        let ((s, c), ca) = (angle.sin_cos(), 1.0 - f64::abs(sa));
        let link = [[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0.0, sa, ca, d]];
        t = t.map(|row| {
            let at = |j: usize| (0..3).map(|k| row[k] * link[k][j]).sum::<f64>();
            [at(0), at(1), at(2), at(3) + row[3]]
        });
    }
    t.concat()
}

/// All solutions by the book, with arc cosines: results, multiplicity, free unknowns. Where the wrist is straight, its
/// third node is free and taken as 0.
pub fn inverse([d1, a2, a3, d4, d5, d6]: [f64; 6], u: &[f64]) -> Vec<(Vec<f64>, u32, u32)> {
    use std::f64::consts::FRAC_PI_2;
    let at = |i: usize, j: usize| u[4 * i + j];
    let p = [0, 1, 2].map(|i| at(i, 3) - d6 * at(i, 2) - if i == 2 { d1 } else { 0.0 });
    let mut found = vec![];
    let reach = p[0].hypot(p[1]);
    if reach < d4.abs() {
        return found;
    }
    for shoulder in [1.0, -1.0] {
        let q1 = p[1].atan2(p[0]) + shoulder * (d4 / reach).acos() + FRAC_PI_2;
        let (s1, c1) = q1.sin_cos();
        let v = |j: usize| c1 * at(0, j) + s1 * at(1, j);
        let w = |j: usize| s1 * at(0, j) - c1 * at(1, j);
        let bent = w(0).hypot(w(1));
        let wrists = if bent < 1e-12 { vec![(0.0, 2)] } else { vec![(bent, 1), (-bent, 1)] };
        for (s5, twice) in wrists {
            let q5 = f64::atan2(s5, w(2));
            let q234 = if s5 == 0.0 { 0.0 } else { f64::atan2(-at(2, 2) / s5, -v(2) / s5) };
            let (s, c) = q234.sin_cos();
            let q6 = f64::atan2(c * at(2, 0) - s * v(0), c * at(2, 1) - s * v(1));
            let (x, z) = (c1 * p[0] + s1 * p[1] - d5 * s, p[2] + d5 * c);
            let cosine = (x * x + z * z - a2 * a2 - a3 * a3) / (2.0 * a2 * a3);
            if cosine.abs() > 1.0 + 1e-9 {
                continue;
            }
            let is_straight = cosine.abs() > 1.0 - 1e-12;
            for elbow in if is_straight { vec![0.0] } else { vec![1.0, -1.0] } {
                let q3 = if is_straight { cosine.clamp(-1.0, 1.0).acos() } else { elbow * cosine.acos() };
                let q2 = z.atan2(x) - f64::atan2(a3 * q3.sin(), a2 + a3 * q3.cos());
                let times = twice * if is_straight { 2 } else { 1 };
                let free = if s5 == 0.0 { 1 << 2 } else { 0 };
                found.push((vec![q1, q2, q3, q234 - q2 - q3, q5, q6], times, free));
            }
        }
    }
    found
}
