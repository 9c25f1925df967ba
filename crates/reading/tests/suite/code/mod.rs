//! Programs as people write them, held against forward kinematics computed in numbers.

mod refused;
mod soup;

use denavit_reading::code::{Assigned, Cell, Code, Dialect, Reading, Value, read};
use denavit_symbolic::Expr;
use denavit_symbolic::parse::{Function, SyntaxKind};
use std::f64::consts::PI;

fn joint(i: usize) -> Expr {
    Expr::symbol(&format!("q{i}"))
}

/// Joint variables `q1`, `theta1`; lengths `a1`, `d1`, `l1`; π in words.
fn meaning(name: &str) -> Option<Expr> {
    let index = |stem: &str| name.strip_prefix(stem)?.parse::<usize>().ok().filter(|i| (1..=6).contains(i));
    if let Some(i) = index("q").or(index("theta")).or(index("th")) {
        return Some(joint(i));
    }
    index("a").or(index("d")).or(index("l")).map(|_| Expr::symbol(name))
}

fn run(text: &str, language: Dialect, n: usize) -> Code {
    let joints: Vec<Expr> = (1..=n).map(joint).collect();
    read(text, 0..text.len(), language, &meaning, &joints)
}

fn python(text: &str, n: usize) -> Code {
    run(text, Dialect::Python, n)
}

fn matlab(text: &str, n: usize) -> Code {
    run(text, Dialect::Matlab, n)
}

fn place(name: &str) -> f64 {
    let mixed = name.bytes().fold(0.3, |x: f64, b| (x * 3.7 + f64::from(b) * 0.77).rem_euclid(2.0));
    0.4 + mixed
}

fn number(e: Expr) -> f64 {
    e.eval(|s| Some(place(&s.name()))).unwrap()
}

fn cells(value: &Value) -> Vec<Vec<Cell>> {
    match value {
        Value::Scalar(c) => vec![vec![c.clone()]],
        Value::Matrix(rows) => rows.clone(),
    }
}

fn numbers(value: &Value) -> Vec<Vec<f64>> {
    cells(value).iter().map(|r| r.iter().map(|c| number(c.value)).collect()).collect()
}

type M4 = [[f64; 4]; 4];

fn times(a: &M4, b: &M4) -> M4 {
    std::array::from_fn(|r| std::array::from_fn(|c| (0..4).map(|k| a[r][k] * b[k][c]).sum()))
}

/// Rot(z,θ) Trans(z,d) Trans(x,a) Rot(x,α): Denavit and Hartenberg's standard step.
fn step(theta: f64, d: f64, a: f64, alpha: f64) -> M4 {
    let ((s, c), (t, k)) = (theta.sin_cos(), alpha.sin_cos());
    let z = [[c, -s, 0., 0.], [s, c, 0., 0.], [0., 0., 1., d], [0., 0., 0., 1.]];
    let x = [[1., 0., 0., a], [0., k, -t, 0.], [0., t, k, 0.], [0., 0., 0., 1.]];
    times(&z, &x)
}

fn forward(rows: &[(f64, f64, f64, f64)]) -> M4 {
    let steps = rows.iter().map(|&(theta, d, a, alpha)| step(theta, d, a, alpha));
    steps.reduce(|t, a| times(&t, &a)).unwrap()
}

fn q(i: usize) -> f64 {
    place(&format!("q{i}"))
}

/// Joined to nothing: the code reads whole, and its last function gives back one matrix.
fn matrix(code: &Code) -> Vec<Vec<f64>> {
    assert_eq!(code.refusals, []);
    check(code);
    let last = code.functions.last().unwrap();
    assert_eq!(last.returned.len(), 1, "{last:?}");
    numbers(&last.returned[0].value)
}

fn close(found: &[Vec<f64>], right: &[impl AsRef<[f64]>]) {
    assert_eq!(found.len(), right.len());
    for (f, r) in found.iter().zip(right) {
        assert_eq!(f.len(), r.as_ref().len());
        for (x, y) in f.iter().zip(r.as_ref()) {
            assert!((x - y).abs() < 1e-9, "{found:?}");
        }
    }
}

/// What is written has the value that is given.
fn check(code: &Code) {
    let all = code.functions.iter().flat_map(|f| {
        f.assigned
            .iter()
            .map(|a| &a.value)
            .chain(f.returned.iter().map(|r| &r.value))
            .flat_map(cells)
            .flatten()
    });
    for cell in all {
        if let Some(syntax) = &cell.syntax {
            assert_eq!(syntax.value(), cell.value);
        }
    }
}

fn named<'a>(reading: &'a Reading, name: &str) -> &'a Assigned {
    let found = reading.assigned.iter().rev().find(|a| a.name == name);
    found.unwrap_or_else(|| panic!("`{name}` in {:?}", reading.assigned))
}

const UR5: [(f64, f64, f64); 6] = [
    // d, a, α: Universal Robots, "DH parameters for calculations of kinematics and dynamics".
    (0.089159, 0.0, PI / 2.0),
    (0.0, -0.425, 0.0),
    (0.0, -0.39225, 0.0),
    (0.10915, 0.0, PI / 2.0),
    (0.09465, 0.0, -PI / 2.0),
    (0.0823, 0.0, 0.0),
];

fn ur5() -> M4 {
    let rows: Vec<_> = UR5.iter().enumerate().map(|(i, &(d, a, alpha))| (q(i + 1), d, a, alpha)).collect();
    forward(&rows)
}

#[test]
fn a_planar_arm_with_numbers_of_its_own() {
    let text = r#"
import numpy as np
from math import cos, sin

l1, l2 = 0.5, 0.25  # metres

def fk(q: np.ndarray) -> tuple[float, float]:
    """The position of the hand."""
    c1, s1 = cos(q[0]), sin(q[0])
    px = l1 * c1 + l2 * np.cos(q[0] + q[1])
    py = l1*s1 \
         + l2*np.sin(q[0] + q[1])
    return px, py

if __name__ == "__main__":
    while True:
        print(fk(np.array([0.1, 0.2])))
"#;
    let code = python(text, 2);
    assert_eq!(code.refusals, []);
    check(&code);
    let [script, fk] = &code.functions[..] else { panic!("{code:?}") };
    assert_eq!((script.name.as_str(), fk.name.as_str()), ("", "fk"));
    assert_eq!(numbers(&named(script, "l2").value), [[0.25]]);
    let names: Vec<_> = fk.returned.iter().map(|r| r.name.as_deref().unwrap()).collect();
    assert_eq!(names, ["px", "py"]);
    let right =
        [0.5 * q(1).cos() + 0.25 * (q(1) + q(2)).cos(), 0.5 * q(1).sin() + 0.25 * (q(1) + q(2)).sin()];
    for (returned, right) in fk.returned.iter().zip(right) {
        close(&numbers(&returned.value), &[[right]]);
    }
    // `px` as it is written.
    let px = named(fk, "px");
    assert_eq!(&text[px.span.clone()], "l1 * c1 + l2 * np.cos(q[0] + q[1])");
    let Value::Scalar(cell) = &px.value else { panic!() };
    let syntax = cell.syntax.as_ref().unwrap();
    let SyntaxKind::Sum(terms) = &syntax.kind else { panic!("{syntax:?}") };
    let SyntaxKind::Product(factors) = &terms[1].1.kind else { panic!("{syntax:?}") };
    let SyntaxKind::Call(Function::Cos, arguments) = &factors[1].1.kind else { panic!("{syntax:?}") };
    let at = |s: &std::ops::Range<usize>| &text[cell.span.start + s.start..cell.span.start + s.end];
    assert_eq!(at(&factors[1].1.span), "np.cos(q[0] + q[1])");
    assert_eq!(at(&arguments[0].span), "q[0] + q[1]");
    assert_eq!(at(&arguments[0].children()[1].span), "q[1]");
    assert_eq!(arguments[0].children()[1].kind, SyntaxKind::Name(joint(2)));
}

#[test]
fn ur5_in_a_loop_over_its_table() {
    let text = r"
import numpy as np
d = [0.089159, 0, 0, 0.10915, 0.09465, 0.0823]
a = [0, -0.425, -0.39225, 0, 0, 0]
alpha = [np.pi/2, 0, 0, np.pi/2, -np.pi/2, 0]

def dh(theta, d, a, alpha):
    ct, st = np.cos(theta), np.sin(theta)
    ca, sa = np.cos(alpha), np.sin(alpha)
    return np.array([
        [ct, -st*ca,  st*sa, a*ct],
        [st,  ct*ca, -ct*sa, a*st],
        [0,   sa,     ca,    d],
        [0, 0, 0, 1],
    ])

def fk(q):
    T = np.eye(4)
    for i in range(6):
        T = T @ dh(q[i], d[i], a[i], alpha[i])
    return T
";
    let code = python(text, 6);
    close(&matrix(&code), &ur5());
    assert_eq!(code.functions.iter().map(|f| f.name.as_str()).collect::<Vec<_>>(), ["", "fk"]);
    // The identity and six products.
    assert_eq!(code.functions[1].assigned.iter().filter(|a| a.name == "T").count(), 7);
}

#[test]
fn ur5_in_other_words() {
    let bodies = [
        "    T = np.identity(4)\n    for row, th in zip(table, q):\n        T = np.dot(T, dh(th, *row))\n    return T\n",
        "    As = [dh(t, d, a, alpha) for t, (d, a, alpha) in zip(q, table)]\n    return np.linalg.multi_dot(As)\n",
        "    As = []\n    for i, (d, a, alpha) in enumerate(table):\n        As.append(dh(theta=q[i], d=d, a=a, alpha=alpha))\n    T06 = As[0] @ As[1] @ As[2] @ As[3] @ As[4] @ As[-1]\n    return T06\n",
        "    return reduce(lambda A, B: A.dot(B), [dh(q[i], *table[i]) for i in range(len(table))])\n",
        "    T = dh(q[0], *table[0])\n    for i in range(1, len(q)):\n        T @= dh(q[i], *table[i])\n    return T\n",
        "    q1, q2, q3, q4, q5, q6 = q\n    T = dh(q1, *table[0]) @ dh(q2, *table[1]) @ dh(q3, *table[2])\n    U = dh(q4, *table[3]) @ dh(q5, *table[4]) @ dh(q6, *table[5])\n    R = T[:3, :3] @ U[0:3, 0:3]\n    p = T[:3, 3] + T[:3, :3] @ U[:3, 3]\n    X = np.eye(4)\n    X[:3, :3] = R\n    X[:3, 3] = p\n    return X\n",
        "    T = dh(q[0], *table[0])\n    for i in range(1, 6):\n        T = T @ dh(q[i], *table[i])\n    R, p = T[:3, :3], T[:3, 3].reshape(3, 1)\n    return np.vstack((np.hstack((R, p)), [0, 0, 0, 1]))\n",
        "    T = dh(q[0], *table[0])\n    for i in range(1, 6):\n        T = T @ dh(q[i], *table[i])\n    return np.linalg.inv(np.linalg.inv(T))\n",
    ];
    for body in bodies {
        let text = format!(
            "import numpy as np\nfrom functools import reduce\n
table = [(0.089159, 0, np.pi/2), (0, -0.425, 0), (0, -0.39225, 0),
         (0.10915, 0, np.deg2rad(90)), (0.09465, 0, np.radians(-90)), (0.0823, 0, 0)]
def rotz(t):
    T = np.zeros((4, 4))
    T[0, 0] = np.cos(t); T[0][1] = -np.sin(t)
    T[1, 0] = np.sin(t); T[1][1] = np.cos(t)
    T[2, 2] = T[3, 3] = 1.0
    return T
def dh(theta, d, a, alpha=0.0):
    ca, sa = np.cos(alpha), np.sin(alpha)
    X = np.array([[1, 0, 0, a], [0, ca, -sa, 0], [0, sa, ca, 0], [0, 0, 0, 1]])
    Z = np.eye(4)
    Z[2, 3] = d
    return rotz(theta) @ Z @ X

def fk(q):
{body}"
        );
        close(&matrix(&python(&text, 6)), &ur5());
    }
}

/// Paul 1981, the Stanford arm: α = -90°, 90°, 0, -90°, 90°, 0; d2 and d3; joint 3 slides.
fn stanford() -> M4 {
    let (d2, d3) = (place("d2"), place("d3"));
    let r = PI / 2.0;
    let rows = [(q(1), 0., -r), (q(2), d2, r), (0., d3, 0.), (q(4), 0., -r), (q(5), 0., r), (q(6), 0., 0.)];
    forward(&rows.map(|(theta, d, alpha)| (theta, d, 0.0, alpha)))
}

const STANFORD: &str = r"
def stanford(theta1, theta2, d3, theta4, theta5, theta6):
    c1 = cos(theta1); s1 = sin(theta1)
    c2 = cos(theta2); s2 = sin(theta2)
    c4 = cos(theta4); s4 = sin(theta4)
    c5 = cos(theta5); s5 = sin(theta5)
    c6 = cos(theta6); s6 = sin(theta6)
    nx = c1*(c2*(c4*c5*c6 - s4*s6) - s2*s5*c6) - s1*(s4*c5*c6 + c4*s6)
    ny = s1*(c2*(c4*c5*c6 - s4*s6) - s2*s5*c6) + c1*(s4*c5*c6 + c4*s6)
    nz = -s2*(c4*c5*c6 - s4*s6) - c2*s5*c6
    ox = c1*(-c2*(c4*c5*s6 + s4*c6) + s2*s5*s6) - s1*(-s4*c5*s6 + c4*c6)
    oy = s1*(-c2*(c4*c5*s6 + s4*c6) + s2*s5*s6) + c1*(-s4*c5*s6 + c4*c6)
    oz = s2*(c4*c5*s6 + s4*c6) + c2*s5*s6
    ax = c1*(c2*c4*s5 + s2*c5) - s1*s4*s5
    ay = s1*(c2*c4*s5 + s2*c5) + c1*s4*s5
    az = -s2*c4*s5 + c2*c5
    px = c1*s2*d3 - s1*d2
    py = s1*s2*d3 + c1*d2
    pz = c2*d3
    return [[nx, ox, ax, px],
            [ny, oy, ay, py],
            [nz, oz, az, pz],
            [0, 0, 0, 1]]
";

#[test]
fn stanford_written_out() {
    let code = python(STANFORD, 6);
    close(&matrix(&code), &stanford());
    let nz = named(&code.functions[0], "nz");
    assert_eq!(&STANFORD[nz.span.clone()], "-s2*(c4*c5*c6 - s4*s6) - c2*s5*c6");
}

#[test]
fn matlab_written_out_and_as_products() {
    let body: String =
        STANFORD.lines().skip(2).take_while(|l| !l.contains("return")).map(|l| format!("{l};\n")).collect();
    let text = format!(
        "function T = stanford(theta1, theta2, d3, theta4, theta5, theta6)\n% the arm\n{body}
    T = [nx ox ax px; ny, oy, ay, py
         nz oz ... and the last two
         az pz; 0 0 0 1];
end\n"
    );
    close(&matrix(&matlab(&text, 6)), &stanford());

    let text = r"
function T = fk(q)
  DH = [0.089159 0 pi/2; 0 -0.425 0; 0 -0.39225 0; 0.10915 0 pi/2; 0.09465 0 -pi/2; 0.0823 0 0];
  T = eye(4);
  for i = 1:size(DH, 1)
      A{i} = dh(q(i), DH(i,1), DH(i,2), DH(i,3)*180/pi);
      T = T*A{i};
  end
end

function A = dh(theta, d, a, alpha)
  c = cos(theta); s = sin(theta);
  %{
  alpha is in degrees
  %}
  ca = cosd(alpha); sa = sind(alpha);
  A = [c -s*ca s*sa a*c
       s c*ca -c*sa a*s   % second
       0 sa ca d
       0 0 0 1];
end
";
    close(&matrix(&matlab(text, 6)), &ur5());

    let text = r"
clear all; clc
syms theta1 theta2 real
Rz = @(t) [cos(t) -sin(t) 0 0; sin(t) cos(t) 0 0; 0 0 1 0; 0 0 0 1];
[c1, s1] = deal(cos(theta1), sin(theta1));
A1 = Rz(theta1)*[eye(3) [a1; 0; 0]; 0 0 0 1];
A2 = Rz(theta2);
A2(1:3,4) = [a2*cos(theta2) a2*sin(theta2) 0]';
T = A1*A2
p = T(1:3, end);
px = T(1,4); n = numel(p);
";
    let code = matlab(text, 2);
    assert_eq!(code.refusals, []);
    check(&code);
    let script = &code.functions[0];
    let (a1, a2) = (place("a1"), place("a2"));
    let right = forward(&[(q(1), 0., a1, 0.), (q(2), 0., a2, 0.)]);
    close(&numbers(&named(script, "T").value), &right);
    close(&numbers(&named(script, "px").value), &[[right[0][3]]]);
    close(&numbers(&named(script, "A2").value), &step(q(2), 0., a2, 0.));
    assert_eq!(script.assigned.iter().filter(|a| a.name == "A2").count(), 1);
    close(&numbers(&named(script, "p").value), &[[right[0][3]], [right[1][3]], [right[2][3]]]);
}

#[test]
fn sympy_has_matrix_products() {
    let text = r"
from sympy import *
q1, q2 = symbols('q1 q2')
a1, a2 = symbols('a1:3')
def A(th, a):
    return Matrix([[cos(th), -sin(th), 0, a*cos(th)], [sin(th), cos(th), 0, a*sin(th)], [0, 0, 1, 0], [0, 0, 0, 1]])
T = simplify(A(q1, a1) * A(q2, a2))
R = T[0:3, 0:3]
px = T[0, 3]
";
    let code = python(text, 2);
    assert_eq!(code.refusals, []);
    let right = forward(&[(q(1), 0., place("a1"), 0.), (q(2), 0., place("a2"), 0.)]);
    close(&numbers(&named(&code.functions[0], "T").value), &right);
    close(&numbers(&named(&code.functions[0], "px").value), &[[right[0][3]]]);
}

#[test]
fn signs_blanks_and_quotes_in_matlab_matrices() {
    let value = |text: &str| {
        let code = matlab(text, 2);
        assert_eq!(code.refusals, [], "{text}");
        numbers(&named(&code.functions[0], "x").value)
    };
    // The rules of "Array indexing and concatenation": a sign with a blank before it only begins an entry.
    for (text, right) in [
        ("x = [1 -2]", vec![vec![1., -2.]]),
        ("x = [1 - 2]", vec![vec![-1.]]),
        ("x = [1 -2 + 3, 4]", vec![vec![1., 1., 4.]]),
        ("x = [1 2]'", vec![vec![1.], vec![2.]]),
        ("a = [1 2]; x = [a' a']", vec![vec![1., 1.], vec![2., 2.]]),
        ("a = [1 2]; x = [a(1) (2)]", vec![vec![1., 2.]]),
        ("x = -2^2", vec![vec![-4.]]),
        ("x = 2^-1", vec![vec![0.5]]),
        ("x = [1 2; 3 4].*[2 2; 0 1]", vec![vec![2., 4.], vec![0., 4.]]),
        ("x = [1 2; 3 4]*[2 2; 0 1]", vec![vec![2., 4.], vec![6., 10.]]),
        ("a = [1 2; 3 4]; x = a(:)'", vec![vec![1., 3., 2., 4.]]),
        ("a = 5:-2:1; x = a(end)", vec![vec![1.]]),
        ("x = 0; for i = [1 2 3], x = x + i; end", vec![vec![6.]]),
        ("x(2) = 3;", vec![vec![0., 3.]]),
        ("x = 2.*3 - 1e-1", vec![vec![5.9]]),
        ("if 1 < 2 && ~false, x = 1; else, x = 2; end", vec![vec![1.]]),
        ("x = zeros(2); x(:,1) = [1; 2];", vec![vec![1., 0.], vec![2., 0.]]),
    ] {
        close(&value(text), &right);
    }
}

#[test]
fn numpy_has_its_own_rules() {
    let value = |text: &str| {
        let code = python(text, 2);
        assert_eq!(code.refusals, [], "{text}");
        check(&code);
        numbers(&named(&code.functions[0], "x").value)
    };
    for (text, right) in [
        ("x = -2**2", vec![vec![-4.]]),
        ("x = 2**-1", vec![vec![0.5]]),
        ("x = 4**0.5", vec![vec![2.]]),
        ("x = 7 // 2 + -7 % 3", vec![vec![5.]]),
        ("x = np.array([[1, 2], [3, 4]]) * np.array([[2, 2], [0, 1]])", vec![vec![2., 4.], vec![0., 4.]]),
        ("x = np.array([[1, 2], [3, 4]]) @ np.array([1, 1])", vec![vec![3.], vec![7.]]),
        ("x = np.matrix([[1, 2], [3, 4]]) * np.matrix([[1], [1]])", vec![vec![3.], vec![7.]]),
        ("x = np.array([1, 2]) @ np.array([3, 4])", vec![vec![11.]]),
        ("x = np.cross([1, 0, 0], [0, 1, 0])", vec![vec![0.], vec![0.], vec![1.]]),
        ("x = np.array([[1, 2], [3, 4]]) + np.array([10, 20])", vec![vec![11., 22.], vec![13., 24.]]),
        (
            "x = np.block([[np.eye(2), np.zeros((2, 1))], [np.zeros((1, 2)), 1]])",
            vec![vec![1., 0., 0.], vec![0., 1., 0.], vec![0., 0., 1.]],
        ),
        ("x = sum([i*i for i in range(4)])", vec![vec![14.]]),
        ("x = [1, 2, 3][::-1]", vec![vec![3.], vec![2.], vec![1.]]),
        ("x = 1 if None is None else 2", vec![vec![1.]]),
        ("x = np.linalg.norm([3, 4])", vec![vec![5.]]),
        ("T = np.eye(2)\nU = T.copy()\nU[0, 1] = 5\nx = T", vec![vec![1., 0.], vec![0., 1.]]),
    ] {
        close(&value(text), &right);
    }
}

#[test]
fn degrees_are_exact() {
    let code = python(
        "import numpy as np\nx = np.cos(np.deg2rad(90) + q1)\ny = sin(q1*pi/180)\nz = cos(1.5708)\n",
        1,
    );
    let script = &code.functions[0];
    let value = |name: &str| cells(&named(script, name).value)[0][0].value;
    assert_eq!(value("x"), -joint(1).sin());
    assert_eq!(value("y"), (joint(1) * Expr::pi() / Expr::int(180)).sin());
    assert_ne!(value("z"), Expr::int(0));
}
