//! Two solvers built by hand, with the forward direction of each as plain numbers.

use denavit_program::solver::{Draft, Output, Root, Solver, SolverBuilder};
use denavit_program::{Graph, Value};
use denavit_symbolic::{Expr, Symbol};

pub fn symbols(names: &[&str]) -> Vec<Symbol> {
    names.iter().map(|n| Symbol::new(n)).collect()
}

pub fn input(name: &str) -> Expr {
    Expr::symbol(name)
}

fn number(n: i64) -> Expr {
    Expr::int(n)
}

fn sum_of_squares(terms: &[Expr]) -> Expr {
    terms.iter().map(|&e| e * e).reduce(|a, b| a + b).expect("at least one")
}

/// A node of formulas.
pub fn node(b: &mut SolverBuilder, root: Root<Expr>, guard: Option<Expr>, degree: u8, results: &[&str]) {
    let root = root.map(|e| b.trace(e));
    let guard = guard.map(|e| b.trace(e));
    b.node(Draft { root, guard, degree, results: symbols(results), label: None });
}

/// Outputs that are angles, from their sines and cosines.
pub fn angles(b: &mut SolverBuilder, of: &[(&str, Expr, Expr)]) -> Vec<Output> {
    let angle = |b: &mut SolverBuilder, s: Expr, c: Expr| -> Value {
        let (s, c) = (b.trace(s), b.trace(c));
        let graph: &mut Graph = &mut b.graph;
        graph.atan2(s, c)
    };
    of.iter()
        .map(|&(name, s, c)| Output { name: name.into(), value: angle(b, s, c), is_angle: true })
        .collect()
}

/// `x = l1 cos x1 + l2 cos(x1 + x2)`, `y` with sines; lengths are parameters.
pub fn planar() -> Solver {
    let [x, y, l1, l2, c2, s2, c1, s1] = ["x", "y", "l1", "l2", "c2", "s2", "c1", "s1"].map(input);
    let mut b = SolverBuilder::new(
        &symbols(&["x", "y"]),
        &symbols(&["l1", "l2"]),
        &symbols(&["c2", "s2", "k2", "c1", "s1"]),
    );
    let q = x * x + y * y;
    // q = l1² + l2² + 2 l1 l2 c2; the discriminant is Heron's product.
    let root = Root::Sincos {
        a: number(2) * l1 * l2,
        b: number(0),
        c: q - l1 * l1 - l2 * l2,
        discriminant: Some(((l1 + l2) * (l1 + l2) - q) * (q - (l1 - l2) * (l1 - l2))),
    };
    node(&mut b, root, None, 2, &["c2", "s2", "k2"]);
    let (u, v) = (l1 + l2 * c2, l2 * s2);
    let root = Root::Direction { x: u * x + v * y, y: u * y - v * x, sign: None };
    node(&mut b, root, Some(q.sqrt()), 1, &["c1", "s1"]);
    let outputs = angles(&mut b, &[("x1", s1, c1), ("x2", s2, c2)]);
    let size = sum_of_squares(&[x, y, l1, l2]).sqrt();
    let residual = sum_of_squares(&[x - (u * c1 - v * s1), y - (u * s1 + v * c1)]).sqrt() / size;
    let (residual, size) = (b.trace(residual), b.trace(size));
    b.finish(&outputs, residual, size)
}

pub fn planar_forward([l1, l2]: [f64; 2], x: &[f64]) -> Vec<f64> {
    let (s, c) = (x[0].sin_cos(), (x[0] + x[1]).sin_cos());
    vec![l1 * s.1 + l2 * c.1, l1 * s.0 + l2 * c.0]
}

/// a2, a3, d4, d5 of the chain below.
pub const LENGTHS: [f64; 4] = [-0.425, -0.39225, 0.10915, 0.09465];

/// Six angles of a chain with three parallel axes (α = 90, 0, 0, 90, −90, 0 degrees; a2, a3, d4, d5), from the
/// 3 × 4 matrix U = (s n a p), row by row.
pub fn six() -> Solver {
    let names: Vec<String> = (1..=3).flat_map(|i| (1..=4).map(move |j| format!("u{i}{j}"))).collect();
    let variables: Vec<Symbol> = names.iter().map(|n| Symbol::new(n)).collect();
    let u: Vec<Expr> = names.iter().map(|n| input(n)).collect();
    let results = ["c1", "s1", "k1", "s5", "k5", "c234", "s234", "c6", "s6", "c3", "s3", "k3", "c2", "s2"];
    let mut b = SolverBuilder::new(&variables, &symbols(&["a2", "a3", "d4", "d5"]), &symbols(&results));
    let [a2, a3, d4, d5] = ["a2", "a3", "d4", "d5"].map(input);
    let [c1, s1, _, s5, k5, c234, s234, c6, s6, c3, s3, _, c2, s2] = results.map(input);
    // In frame 1: v = c1·x₁ + s1·x₂, x₃, w = s1·x₁ − c1·x₂ of a column x.
    let column = |j: usize| [u[j], u[4 + j], u[8 + j]];
    let v = |[x, y, _]: [Expr; 3]| c1 * x + s1 * y;
    let w = |[x, y, _]: [Expr; 3]| s1 * x - c1 * y;
    let [s, n, a, p] = [0, 1, 2, 3].map(column);

    // s1·p₁ − c1·p₂ = d4
    let root = Root::Sincos { a: -p[1], b: p[0], c: d4, discriminant: None };
    node(&mut b, root, None, 1, &["c1", "s1", "k1"]);
    // w_s = s5·c6, w_n = −s5·s6, w_a = c5
    node(&mut b, Root::Length { x: w(s), y: w(n) }, None, 0, &["s5", "k5"]);
    let c5 = w(a);
    // v_a = −c234·s5, a₃ = −s234·s5
    let root = Root::Direction { x: -v(a), y: -a[2], sign: Some(k5) };
    node(&mut b, root, None, 0, &["c234", "s234"]);
    let root = Root::Direction { x: c234 * n[2] - s234 * v(n), y: c234 * s[2] - s234 * v(s), sign: None };
    node(&mut b, root, None, 0, &["c6", "s6"]);
    // a2·c2 + a3·c23 = x, a2·s2 + a3·s23 = z
    let (x, z) = (v(p) - d5 * s234, p[2] + d5 * c234);
    let q = x * x + z * z;
    let root = Root::Sincos {
        a: number(2) * a2 * a3,
        b: number(0),
        c: q - a2 * a2 - a3 * a3,
        discriminant: Some(((a2 + a3) * (a2 + a3) - q) * (q - (a2 - a3) * (a2 - a3))),
    };
    node(&mut b, root, None, 2, &["c3", "s3", "k3"]);
    let (l, m) = (a2 + a3 * c3, a3 * s3);
    let root = Root::Direction { x: l * x + m * z, y: l * z - m * x, sign: None };
    node(&mut b, root, Some(q.sqrt()), 1, &["c2", "s2"]);

    let (c23, s23) = (c2 * c3 - s2 * s3, s2 * c3 + c2 * s3);
    let outputs = [
        ("x1", s1, c1),
        ("x2", s2, c2),
        ("x3", s3, c3),
        ("x4", s234 * c23 - c234 * s23, c234 * c23 + s234 * s23),
        ("x5", s5, c5),
        ("x6", s6, c6),
    ];
    let outputs = angles(&mut b, &outputs);
    let size = sum_of_squares(&[p[0], p[1], p[2], a2, a3, d4, d5]).sqrt();
    let turned = sum_of_squares(&[
        w(s) - s5 * c6,
        w(n) + s5 * s6,
        v(a) + c234 * s5,
        a[2] + s234 * s5,
        v(s) - (c234 * (c5 * c6) - s234 * s6),
        s[2] - (s234 * (c5 * c6) + c234 * s6),
        v(n) + (c234 * (c5 * s6) + s234 * c6),
        n[2] + (s234 * (c5 * s6) - c234 * c6),
    ]);
    let moved = sum_of_squares(&[w(p) - d4, x - (l * c2 - m * s2), z - (l * s2 + m * c2)]);
    let residual = (turned + moved / (size * size)).sqrt();
    let (residual, size) = (b.trace(residual), b.trace(size));
    b.finish(&outputs, residual, size)
}

/// U of six angles: the product of Rz(θ)·Tz(d)·Tx(a)·Rx(α).
pub fn six_forward([a2, a3, d4, d5]: [f64; 4], x: &[f64]) -> Vec<f64> {
    let rows =
        [(0.0, 0.0, 1.0), (0.0, a2, 0.0), (0.0, a3, 0.0), (d4, 0.0, 1.0), (d5, 0.0, -1.0), (0.0, 0.0, 0.0)];
    let mut t = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    for (angle, (d, a, sa)) in x.iter().zip(rows) {
        let ((s, c), ca) = (angle.sin_cos(), 1.0 - f64::abs(sa));
        let link = [[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0.0, sa, ca, d]];
        t = t.map(|row| {
            let at = |j: usize| (0..3).map(|k| row[k] * link[k][j]).sum::<f64>();
            [at(0), at(1), at(2), at(3) + row[3]]
        });
    }
    t.concat()
}

/// Numbers from a seed (Marsaglia's xorshift).
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        for shift in [13, -7, 17] {
            self.0 ^= if shift > 0 { self.0 << shift } else { self.0 >> -shift };
        }
        self.0
    }

    /// From −1 to 1.
    pub fn number(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub fn angles(&mut self, n: usize) -> Vec<f64> {
        (0..n).map(|_| self.number() * std::f64::consts::PI).collect()
    }
}
