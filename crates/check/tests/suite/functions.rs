//! What functions of programs give back: matrices by the functions' names, Jacobians and torques of some of the joints, tools that the
//! program alone has; and what is listed of tests and of matrices in words.

use denavit_check::{CheckOptions, Checked, Standing, check};
use denavit_reading::code::Dialect;
use denavit_reading::document::Format;

const PLANAR: &str = "# standard DH\n#  i   theta  d  a  alpha\n#  1   th1    0  L1  0\n#  2   th2    0  L2  0\n\
                      import numpy as np\nfrom math import sin, cos\nL1, L2 = 0.45, 0.35\n";

fn read(text: &str, language: Option<Dialect>) -> Checked {
    let options = CheckOptions { language, ..CheckOptions::default() };
    check(text, Format::Markdown, None, &options).unwrap_or_else(|e| panic!("{e:?}\n{text}"))
}

fn standings(found: &Checked) -> Vec<(&str, Standing)> {
    found.claims.iter().map(|c| (c.name.as_str(), c.standing())).collect()
}

/// Where a line stands in the list of what is not judged.
fn is_listed(found: &Checked, text: &str, line: &str) -> bool {
    let at = text.find(line).expect("the line");
    let end = text[at..].find('\n').map_or(text.len(), |n| at + n);
    found.unjudged.iter().any(|u| u.span.start < end && at < u.span.end)
}

#[test]
fn a_function_is_judged_by_its_name() {
    let program = |s: &str| {
        format!(
            "{PLANAR}def T12(th2):\n    c, s = cos(th2), sin(th2)\n    return np.array([[c, {s}, 0, L2*c], [s, c, 0, L2*s], [0, 0, 1, 0], \
             [0, 0, 0, 1]])\n"
        )
    };
    let python = Some(Dialect::Python);
    assert_eq!(standings(&read(&program("-s"), python)), [("T12(…)", Standing::Equal)]);
    assert_eq!(standings(&read(&program("s"), python)), [("T12(…)", Standing::Wrong)]);
}

/// The matrix of the function of a row is no table of the arm.
#[test]
fn a_transform_is_no_table() {
    let program = "# 2R, standard DH\nimport sympy as sp\nfrom sympy import sin, cos, pi, Matrix\nq1, q2 = sp.symbols('q1 q2')\n\
                   def A(theta, d, a, alpha):\n    ct, st, ca, sa = cos(theta), sin(theta), cos(alpha), sin(alpha)\n    \
                   return Matrix([[ct, -st*ca,  st*sa, a*ct],\n                   [st,  ct*ca, -ct*sa, a*st],\n                   \
                   [0,      sa,     ca,    d],\n                   [0,       0,      0,    1]])\n#      theta  d   a  alpha\n\
                   dh = [(q1, h, 0, -pi/2),\n      (q2, e, b, 0)]\nA1 = A(*dh[0])\nA2 = A(*dh[1])\nT02 = A1*A2\n";
    let found = read(program, Some(Dialect::Python));
    assert!(found.claims.iter().all(|c| c.standing() == Standing::Equal), "{:?}", standings(&found));
    assert!(["A1", "A2", "T02"].iter().all(|n| found.claims.iter().any(|c| c.name == *n)));
}

/// `Matrix.hstack(z0, z1)` takes its columns one by one.
#[test]
fn columns_are_set_side_by_side() {
    let program = |third: &str| {
        format!(
            "# RRP, standard DH\n#  i theta d a alpha\n#  1 q1 h 0 -90\n#  2 q2 e 0 90\n#  3 0 q3 0 0\nfrom sympy import sin, cos, Matrix\n\
             z0 = Matrix([0, 0, 1])\nz1 = Matrix([-sin(q1), cos(q1), 0])\nJw = Matrix.hstack(z0, z1, {third})\n"
        )
    };
    let of = |third: &str| {
        let found = read(&program(third), Some(Dialect::Python));
        found.claims.iter().find(|c| c.name == "Jw").map(denavit_check::Claim::standing)
    };
    assert_eq!(of("Matrix([0, 0, 0])"), Some(Standing::Equal));
    assert_eq!(of("Matrix([cos(q1)*sin(q2), sin(q1)*sin(q2), cos(q2)])"), Some(Standing::Wrong));
}

/// A length with a number that the table does not have is a tool's, if what is printed is right with it.
#[test]
fn a_tool_may_have_a_number() {
    let program = |last: &str| {
        format!(
            "{PLANAR}L3 = 0.12\ndef pen(th1, th2):\n    x = L1*cos(th1) + (L2 + L3)*cos(th1 + th2)\n    y = L1*sin(th1) + (L2 + \
             L3)*sin(th1 + th2)\n    return x, y\ndef jac(th1, th2):\n    J = np.array([[-L1*sin(th1) - (L2 + L3)*sin(th1+th2), -(L2 + \
             L3)*sin(th1+th2)],\n                  [L1*cos(th1) + (L2 + L3)*cos(th1+th2), {last}*cos(th1+th2)]])\n    return J\n"
        )
    };
    let standing = |last: &str| {
        let found = read(&program(last), Some(Dialect::Python));
        let of =
            |name: &str| found.claims.iter().find(|c| c.name == name).map(denavit_check::Claim::standing);
        [of("x"), of("y"), of("J")]
    };
    assert_eq!(standing("(L2 + L3)"), [Some(Standing::Equal); 3]);
    assert_eq!(standing("L2"), [Some(Standing::Equal), Some(Standing::Equal), Some(Standing::Wrong)]);
}

/// Of a SCARA, those of the two joints that turn in the plan; brackets in a comment begin no function.
#[test]
fn jacobians_and_torques_of_the_first_joints() {
    let program = |sign: &str| {
        format!(
            "/* SCARA (of the exercise)\n * DH (standard)\n *  joint theta d a alpha\n *  1 q[0] D1 A1 0\n *  2 q[1] 0 A2 180\n *  3 0 q[2] 0 \
             0\n *  4 q[3] D4 0 0\n */\nvoid jacobian(const double q[4], double J[2][2])\n{{\n  J[0][0] = -A1*sin(q[0]) - \
             A2*sin(q[0]+q[1]);\n  J[0][1] = -A2*sin(q[0]+q[1]);\n  J[1][0] = A1*cos(q[0]) + A2*cos(q[0]+q[1]);\n  J[1][1] = {sign} \
             A2*cos(q[0]+q[1]);\n}}\nvoid hold(const double q[4], double fx, double fy, double tau[2])\n{{\n  tau[0] = (-A1*sin(q[0]) - \
             A2*sin(q[0]+q[1]))*fx + (A1*cos(q[0]) + A2*cos(q[0]+q[1]))*fy;\n  tau[1] = {sign} A2*(cos(q[0]+q[1])*fy - \
             sin(q[0]+q[1])*fx);\n}}\n"
        )
    };
    let wrong = |sign: &str| {
        let found = read(&program(sign), Some(Dialect::C));
        let names = found.claims.iter().filter(|c| c.standing() == Standing::Wrong).map(|c| c.name.clone());
        (found.claims.len(), names.collect::<Vec<_>>())
    };
    let (count, none) = wrong("");
    assert!(count >= 2 && none.is_empty(), "{count} {none:?}");
    assert!(wrong("-").1.iter().any(|n| n.starts_with('J')));
}

/// A helper of what is proved is no longer idle, where lengths have numbers, too.
#[test]
fn a_helper_is_used_by_what_is_given_back() {
    let text = format!(
        "{PLANAR}def tip(th1, th2):\n    far = L2*cos(th1 + th2)\n    x = L1*cos(th1) + far\n    y = L1*sin(th1) + L2*sin(th1 + th2)\n    \
         return x, y\n"
    );
    let found = read(&text, Some(Dialect::Python));
    assert!(
        found.claims.iter().any(|c| c.name == "far" && c.standing() == Standing::Equal),
        "{:?}",
        standings(&found)
    );
}

/// Scalars that a vector is made of are its entries, each where its formula stands.
#[test]
fn what_a_vector_is_made_of_is_judged_where_it_stands() {
    let program = |sign: &str| {
        format!(
            "{PLANAR}def pos(th1, th2):\n    x4 = L1*cos(th1) + L2*cos(th1 + th2)\n    y4 = L1*sin(th1) {sign} L2*sin(th1 + th2)\n    \
             return np.array([x4, y4, 0])\n"
        )
    };
    let standing = |sign: &str| {
        let found = read(&program(sign), Some(Dialect::Python));
        let of =
            |name: &str| found.claims.iter().find(|c| c.name == name).map(denavit_check::Claim::standing);
        [of("x4"), of("y4"), of("pos(…)")]
    };
    assert_eq!(standing("+"), [Some(Standing::Equal); 3]);
    assert_eq!(standing("-"), [Some(Standing::Equal), Some(Standing::Wrong), Some(Standing::Carried)]);
}

#[test]
fn what_tests_compare_is_listed() {
    let text = format!(
        "{PLANAR}class TestArm:\n    def test_zero(self):\n        expected = np.array([0.8, 0.0])\n        \
         np.testing.assert_allclose(arm.tip([0, 0]), expected)\n        self.assertAlmostEqual(arm.det([0, 0]), 0.0)\n"
    );
    let found = read(&text, Some(Dialect::Python));
    for line in ["expected = np.array", "np.testing.assert_allclose", "self.assertAlmostEqual"] {
        assert!(is_listed(&found, &text, line), "{line}: {:?}", found.unjudged);
    }
}

#[test]
fn rows_in_words_are_listed() {
    let text = "link 1: theta = q1, d = 0, a = a1, alpha = 0\nlink 2: theta = q2, d = 0, a = a2, alpha = 0 (standard DH)\n\n\
                x = a1 c1 + a2 c12\n\nrows of the Jacobian:\n\nrow 1: -a1 s1 - a2 s12, -a2 s12\nrow 2: a1 c1 + a2 c12, a2 c12\n\n\
                chapter 3: tea, cake, and a walk\n";
    let found = read(text, None);
    assert!(is_listed(&found, text, "row 1: -a1 s1") && is_listed(&found, text, "row 2: a1 c1"));
    assert!(!is_listed(&found, text, "chapter 3: tea"));
}

/// A scalar that is right in some entries of a matrix and wrong in another is not at fault: the entry is.
#[test]
fn a_scalar_that_is_right_elsewhere_is_not_at_fault() {
    let program = "# standard DH\n#  i   theta  d  a  alpha\n#  1   q1     H  L0 90°\n#  2   q2     0  L1 0\nimport numpy as np\nfrom math import sin, cos\n\
                   def jac(q1, q2):\n    reach = L0 + L1*cos(q2)\n    return np.array([[-sin(q1)*reach, -cos(q1)*L1*sin(q2)],\n                     \
                   [cos(q1)*reach, -sin(q1)*L1*sin(q2)],\n                     [0, reach]])\n";
    let found = read(program, Some(Dialect::Python));
    assert_eq!(standings(&found), [("reach", Standing::Equal), ("jac(…)", Standing::Wrong)]);
    let wrong: Vec<_> =
        found.claims[1].entries.iter().filter(|e| e.finding.standing() == Standing::Wrong).collect();
    assert_eq!(wrong.iter().map(|e| e.place).collect::<Vec<_>>(), [Some((3, 2))]);
}
