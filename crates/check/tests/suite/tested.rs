//! What programs say of masses, and what their tests expect: equations of motion line by line, in the names of the program, and numbers
//! held against the robot's own functions.

use denavit_check::{CheckOptions, Checked, Standing, check};
use denavit_reading::code::Dialect;
use denavit_reading::document::Format;

const PLANAR: &str = "# standard DH, gravity along -y\n#  i   theta  d  a  alpha\n#  1   th1    0  l1  0\n#  2   th2    0  l2  0\n\
                      # centres of mass at lc1, lc2 along the links, inertias I1, I2 about the centres of mass\nimport numpy as np\n";

fn read(text: &str, language: Dialect) -> Checked {
    let options = CheckOptions { language: Some(language), ..CheckOptions::default() };
    check(text, Format::Markdown, None, &options).unwrap_or_else(|e| panic!("{e:?}\n{text}"))
}

fn standing(found: &Checked, name: &str) -> Option<Standing> {
    found.claims.iter().find(|c| c.name == name).map(denavit_check::Claim::standing)
}

/// The equations of motion of a planar arm in one function; `second` is the last torque of gravity, `sign` that of the second
/// centrifugal torque.
fn equations(second: &str, sign: &str) -> String {
    format!(
        "{PLANAR}def dyn(th1, th2, w1, w2):\n    M11 = m1*lc1**2 + I1 + m2*(l1**2 + lc2**2 + 2*l1*lc2*np.cos(th2)) + I2\n    M12, M22 = \
         m2*(lc2**2 + l1*lc2*np.cos(th2)) + I2, m2*lc2**2 + I2\n    h = m2*l1*lc2*np.sin(th2)\n    C1 = -h*(2*w1*w2 + w2**2)\n    \
         C2 = {sign}h*w1**2\n    G1 = (m1*lc1 + m2*l1)*g*np.cos(th1) + m2*lc2*g*np.cos(th1+th2)\n    G2 = {second}\n    \
         return M11, M12, M22, C1, C2, G1, G2\n"
    )
}

#[test]
fn equations_of_motion_in_a_function() {
    let right = read(&equations("m2*lc2*g*np.cos(th1+th2)", ""), Dialect::Python);
    let names = ["M11", "M12", "M22", "h", "C1", "C2", "G1", "G2"];
    for name in names {
        assert_eq!(standing(&right, name), Some(Standing::Equal), "{name}");
    }
    assert!(right.unjudged.is_empty(), "{:?}", right.unjudged);
    let wrong = read(&equations("m2*lc2*g*np.cos(th2)", "-"), Dialect::Python);
    for name in names {
        let expected = if ["C2", "G2"].contains(&name) { Standing::Wrong } else { Standing::Equal };
        assert_eq!(standing(&wrong, name), Some(expected), "{name}");
    }
}

/// Entries of arrays, and rates in a vector.
#[test]
fn equations_of_motion_in_arrays() {
    let program = |factor: &str| {
        format!(
            "// standard DH, gravity along -y\n//  i   theta  d  a  alpha\n//  1   q1    0  l1  0\n//  2   q2    0  l2  0\n\
             // point masses m1, m2 at the ends of the links\nvoid torques(double q[2], double dq[2], double ddq[2], double tau[2]) {{\n  \
             tau[0] = (m1*l1*l1 + m2*(l1*l1 + l2*l2 + 2*l1*l2*cos(q[1])))*ddq[0] + m2*(l2*l2 + l1*l2*cos(q[1]))*ddq[1] - \
             m2*l1*l2*sin(q[1])*({factor}*dq[0]*dq[1] + dq[1]*dq[1]) + (m1 + m2)*g*l1*cos(q[0]) + m2*g*l2*cos(q[0] + q[1]);\n  \
             tau[1] = m2*(l2*l2 + l1*l2*cos(q[1]))*ddq[0] + m2*l2*l2*ddq[1] + m2*l1*l2*sin(q[1])*dq[0]*dq[0] + \
             m2*g*l2*cos(q[0] + q[1]);\n}}\n"
        )
    };
    for (factor, first) in [("2", Standing::Equal), ("1", Standing::Wrong)] {
        let found = read(&program(factor), Dialect::C);
        let all: Vec<(&str, Standing)> =
            found.claims.iter().map(|c| (c.name.as_str(), c.standing())).collect();
        assert_eq!(all.iter().map(|c| c.1).collect::<Vec<_>>(), [first, Standing::Equal], "{all:?}");
    }
}

/// A force as a vector beside the joints by their names.
#[test]
fn torques_of_a_vector() {
    let program = |last: &str| {
        format!(
            "{PLANAR}def static(th1, th2, F):\n    tau1 = (-l1*np.sin(th1) - l2*np.sin(th1+th2))*F[0] + (l1*np.cos(th1) + \
             l2*np.cos(th1+th2))*F[1]\n    tau2 = -l2*np.sin(th1+th2)*F[0] + {last}*F[1]\n    return tau1, tau2\n"
        )
    };
    let found = read(&program("l2*np.cos(th1+th2)"), Dialect::Python);
    assert_eq!([standing(&found, "tau1"), standing(&found, "tau2")], [Some(Standing::Equal); 2]);
    // With one of two wrong there is no majority for a sense of the force.
    let found = read(&program("l2*np.cos(th2)"), Dialect::Python);
    assert_ne!(standing(&found, "tau2"), Some(Standing::Equal));
}

/// The tests of a program whose forward model stands elsewhere: l1 = 0.3, l2 = 0.2.
fn tests(expected: &str, entry: &str) -> String {
    format!(
        "\"\"\"standard DH\"\"\"\nimport unittest\nimport numpy as np\nfrom arm import Link, Arm\narm = Arm([Link(d=0, a=0.3, alpha=0), Link(d=0, a=0.2, alpha=0)])\n\
         class TestForward(unittest.TestCase):\n    def test_up(self):\n        q = [np.pi/2, 0]\n        T = arm.fkine(q)\n        expected = np.array([{expected}])\n        \
         np.testing.assert_allclose(T[:3, 3], expected, atol=1e-3)\n    def test_bent(self):\n        q = np.deg2rad([30, 60])\n        \
         T = arm.fkine(q)\n        self.assertAlmostEqual(T[0, 3], {entry}, places=3)\n        assert np.allclose(T[1, 3], 0.35)\n"
    )
}

#[test]
fn what_tests_expect_is_held_against_the_robot() {
    let found = read(&tests("0, 0.5, 0", "0.2598"), Dialect::Python);
    assert_eq!(standing(&found, "expected"), Some(Standing::Equal), "{:?}", found.claims);
    assert_eq!(standing(&found, "T[0, 3]"), Some(Standing::Equal));
    assert_eq!(standing(&found, "T[1, 3]"), Some(Standing::Equal));
    let found = read(&tests("0.5, 0, 0", "-0.2598"), Dialect::Python);
    assert_eq!(standing(&found, "expected"), Some(Standing::Wrong));
    assert_eq!(standing(&found, "T[0, 3]"), Some(Standing::Wrong));
    assert_eq!(standing(&found, "T[1, 3]"), Some(Standing::Equal));
}

/// What the text defines itself is carried out, and a test of something else says nothing.
#[test]
fn tests_of_other_functions_say_nothing() {
    let text = tests("0, 0.5, 0", "0.2598")
        + "def fkine(q):\n    return 2*q[0]\ndef test_own():\n    np.testing.assert_allclose(fkine([1.0, 2.0]), 7.0)\n";
    let found = read(&text, Dialect::Python);
    assert!(found.claims.iter().all(|c| !c.name.contains("fkine")), "{:?}", found.claims);
}

/// Functions that may take degrees, or give another point, accuse nobody: no comparison is right.
#[test]
fn tests_of_which_none_is_right_accuse_nobody() {
    let text = tests("0.4, 0.3, 0", "0.45").replace("T[1, 3], 0.35", "T[1, 3], 0.15");
    let found = read(&text, Dialect::Python);
    assert!(found.claims.iter().all(|c| c.standing() != Standing::Wrong), "{:?}", found.claims);
    assert!(!found.unjudged.is_empty());
}

/// A tolerance relative to what is expected.
#[test]
fn relative_tolerances_of_tests() {
    let text = tests("0, 0.5, 0", "0.2598")
        .replace("np.allclose(T[1, 3], 0.35)", "np.allclose(T[1, 3], 0.3401, rtol=0.05)");
    assert_eq!(standing(&read(&text, Dialect::Python), "T[1, 3]"), Some(Standing::Equal));
}

/// A vector with a force in it that no torques are is left aside.
#[test]
fn vectors_with_forces_are_no_torques_by_that() {
    let text = format!(
        "{PLANAR}# torques for a force F = (Fx, Fy) at the tip\ndef turned(th1, th2, F):\n    side = np.array([np.cos(th1)*F[0] + np.sin(th1)*F[1], \
         np.cos(th1)*F[1] - np.sin(th1)*F[0]])\n    return side\n"
    );
    let found = read(&text, Dialect::Python);
    assert!(found.claims.iter().all(|c| c.standing() != Standing::Wrong), "{:?}", found.claims);
}
