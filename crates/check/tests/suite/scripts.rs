//! Inverse kinematics in programs, helpers at fault, roots of squares; functions of a row, and scripts with numbers.

use denavit::catalogue;
use denavit_check::{About, CheckOptions, Checked, Claim, Finding, SlipKind, Standing, check};
use denavit_reading::code::Dialect;
use denavit_reading::document::Format;

fn checked(robot: &str, text: &str, language: Option<Dialect>) -> Checked {
    let options = CheckOptions { language, ..CheckOptions::default() };
    check(text, Format::Plain, catalogue::robot(robot).as_ref(), &options).unwrap()
}

fn claim<'a>(checked: &'a Checked, name: &str) -> &'a Claim {
    checked.claims.iter().find(|c| c.name == name).unwrap_or_else(|| panic!("no claim about {name}"))
}

/// The elbow arm as programs solve it.
fn python(quadrant: &str, elbow: &str, shoulder: &str) -> String {
    format!(
        "import numpy as np\n\ndef solve(p, elbow=1):\n    px, py, pz = p\n    th1 = np.arctan2({quadrant})\n    \
         r = np.cos(th1)*p[0] + np.sin(th1)*p[1]   # in the plane of the arm\n    s = p[2] - d1\n    \
         D = (r**2 + s**2 - a2**2 - a3**2) / (2*a2*a3)\n    th3 = np.arctan2({elbow} * np.sqrt(1 - D**2), D)\n    \
         th2 = np.arctan2(s, r) - np.arctan2({shoulder})\n    return np.array([th1, th2, th3])\n"
    )
}

#[test]
fn the_lines_of_a_function_are_judged() {
    let shoulder = "a3*np.sin(th3), a2 + a3*np.cos(th3)";
    let right = checked("articulated-3r", &python("py, px", "elbow", shoulder), Some(Dialect::Python));
    for name in ["r", "s", "D", "th3", "th2"] {
        assert_eq!(claim(&right, name).standing(), Standing::Equal, "{name}");
    }
    assert_ne!(claim(&right, "th1").standing(), Standing::Wrong);

    let wrong = checked("articulated-3r", &python("px, py", "elbow", shoulder), Some(Dialect::Python));
    let slip = |checked: &Checked, name: &str| match &claim(checked, name).entries[0].finding {
        Finding::Wrong(wrong) => wrong.slip.clone().map(|s| s.kind),
        other => panic!("{name}: {other:?}"),
    };
    assert_eq!(slip(&wrong, "th1"), Some(SlipKind::Arguments));

    let swapped = "a3*np.cos(th3), a2 + a3*np.sin(th3)";
    let wrong = checked("articulated-3r", &python("py, px", "elbow", swapped), Some(Dialect::Python));
    assert!(matches!(slip(&wrong, "th2"), Some(SlipKind::Formula(_))));
}

#[test]
fn a_matlab_script_too() {
    let text = "px = T(1,4); py = T(2,4);\nq1 = atan2(py, px);\nr = px*cos(q1) + py*sin(q1);\ns = pz - d1;\n\
                D = (r.^2 + s.^2 - a2^2 - a3^2)./(2*a2*a3);\nfor k = [1 -1]\n  q3 = atan2(k*sqrt(1 - D^2), D);\nend\n\
                q2 = atan2(s, r) - atan2(a3*sin(q3), a2 + a3*cos(q3));\n";
    let right = checked("articulated-3r", text, Some(Dialect::Matlab));
    for name in ["r", "s", "D", "q3", "q2"] {
        assert_eq!(claim(&right, name).standing(), Standing::Equal, "{name}");
    }
}

/// `r = √(px² + py²)`, the way of most textbooks: r² is no root.
#[test]
fn the_square_of_a_root_is_proved() {
    let text = "r = sqrt(px^2 + py^2)\ns = pz - d1\nD = (r^2 + s^2 - a2^2 - a3^2)/(2*a2*a3)\n\
                theta3 = atan2(±sqrt(1 - D^2), D)\n";
    let right = checked("articulated-3r", text, None);
    assert_eq!(claim(&right, "theta3").standing(), Standing::Equal);
}

#[test]
fn a_helper_is_blamed_for_what_it_makes_wrong() {
    let text = |helper: &str| format!("D = {helper}\n\ntheta3 = atan2(±sqrt(1 - D^2), D)\n");
    let right = "(px^2 + py^2 + (pz - d1)^2 - a2^2 - a3^2)/(2*a2*a3)";
    let checked_right = checked("articulated-3r", &text(right), None);
    assert_eq!(claim(&checked_right, "D").standing(), Standing::Equal);
    for (was, now) in [("- a3^2", "+ a3^2"), ("(2*a2*a3)", "(a2*a3)"), ("(pz - d1)", "(pz + d1)")] {
        let found = checked("articulated-3r", &text(&right.replace(was, now)), None);
        let helper = claim(&found, "D");
        assert_eq!((helper.standing(), &helper.about), (Standing::Wrong, &About::Helper), "{now}");
        assert_eq!(claim(&found, "theta3").standing(), Standing::Carried, "{now}");
    }
}

fn dh(entry: &str) -> String {
    format!(
        "import numpy as np\ndef dh(theta, d, a, alpha):\n    ct, st = np.cos(theta), np.sin(theta)\n    \
         ca, sa = np.cos(alpha), np.sin(alpha)\n    return np.array([[ct, -st*ca, st*sa, a*ct],\n\
         [st, ct*ca, {entry}, a*st], [0, sa, ca, d], [0, 0, 0, 1]])\n\n\
         def fk(q):\n    A1 = dh(q[0], d1, 0, np.pi/2)\n    A2 = dh(q[1], 0, a2, 0)\n    A3 = dh(q[2], 0, a3, 0)\n    \
         return A1 @ A2 @ A3\n"
    )
}

#[test]
fn a_wrong_function_of_a_row_is_the_slip_and_the_rest_is_carried() {
    let right = checked("articulated-3r", &dh("-ct*sa"), Some(Dialect::Python));
    assert!(right.claims.len() >= 5 && right.claims.iter().all(|c| c.standing() == Standing::Equal));
    let wrong = checked("articulated-3r", &dh("ct*sa"), Some(Dialect::Python));
    assert_eq!(claim(&wrong, "dh").standing(), Standing::Wrong);
    for (name, standing) in [("A1", Standing::Carried), ("A2", Standing::Equal), ("fk(…)", Standing::Carried)]
    {
        assert_eq!(claim(&wrong, name).standing(), standing, "{name}");
    }
    // Craig's rows, the lengths in the other order.
    let craig = "import numpy as np\ndef trans(alpha, a, d, theta):\n    return np.array([\n\
        [np.cos(theta), -np.sin(theta), 0, a],\n\
        [np.sin(theta)*np.cos(alpha), np.cos(theta)*np.cos(alpha), -np.sin(alpha), -d*np.sin(alpha)],\n\
        [np.sin(theta)*np.sin(alpha), np.cos(theta)*np.sin(alpha), np.cos(alpha), d*np.cos(alpha)],\n\
        [0, 0, 0, 1]])\n";
    let right = checked("puma560-craig", craig, Some(Dialect::Python));
    assert_eq!(claim(&right, "trans").standing(), Standing::Equal);
}

#[test]
fn numbers_that_a_script_gives_joints_are_joints() {
    let text = |angle: &str| {
        format!(
            "import numpy as np\na1, a2 = 0.5, 0.4\nq1, q2 = 30, 45\n\ndef Rz(t):\n    c, s = np.cos(t), np.sin(t)\n    \
             return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])\n\n\
             def shift(x):\n    M = np.eye(4)\n    M[0, 3] = x\n    return M\n\n\
             A1 = Rz(np.deg2rad(q1)) @ shift(a1)\nA2 = Rz({angle}) @ shift(a2)\nT02 = A1 @ A2\n"
        )
    };
    let standings = |text: &str| {
        let found = checked("planar-2r", text, Some(Dialect::Python));
        ["A1", "A2", "T02"].map(|name| claim(&found, name).standing())
    };
    assert_eq!(standings(&text("np.deg2rad(q2)")), [Standing::Equal; 3]);
    assert_eq!(standings(&text("q2")), [Standing::Equal, Standing::Wrong, Standing::Carried]);
    // A vector of all joints, and MATLAB in degrees.
    let vector = "import numpy as np\nq = np.deg2rad([30, 45])\na1, a2 = 0.5, 0.4\n\
        px = a1*np.cos(q[0]) + a2*np.cos(q[0] + q[1])\npy = a1*np.sin(q[0]) + a2*np.sin(q[1])\n";
    let found = checked("planar-2r", vector, Some(Dialect::Python));
    assert_eq!(["px", "py"].map(|n| claim(&found, n).standing()), [Standing::Equal, Standing::Wrong]);
    let matlab = "q1 = 30; q2 = 45;\na1 = 0.5; a2 = 0.4;\nT = [cosd(q1+q2) -sind(q1+q2) 0 a1*cosd(q1)+a2*cosd(q1+q2); \
        sind(q1+q2) cosd(q1+q2) 0 a1*sind(q1)+a2*sind(q1+q2); 0 0 1 0; 0 0 0 1];\n";
    assert_eq!(claim(&checked("planar-2r", matlab, Some(Dialect::Matlab)), "T").standing(), Standing::Equal);
}

#[test]
fn a_table_in_the_comments_of_a_program() {
    let program = |mark: char| {
        format!(
            "{mark} standard DH:\n{mark} | joint | theta | d | a | alpha |\n{mark} |---|---|---|---|---|\n\
             {mark} | 1 | q1 | h | e | 0 |\n{mark} | 2 | q2 | 0 | b | 0 |\npx = e*cos(q1) + b*cos(q1 + q2)\npy = e*sin(q1) + b*sin(q2)\n"
        )
    };
    for (mark, language) in [('#', Dialect::Python), ('%', Dialect::Matlab)] {
        let options = CheckOptions { language: Some(language), ..CheckOptions::default() };
        let found = check(&program(mark), Format::Plain, None, &options).unwrap();
        assert_eq!(claim(&found, "px").standing(), Standing::Equal, "{mark}");
        assert_eq!(claim(&found, "py").standing(), Standing::Wrong, "{mark}");
    }
}

/// Names and standings of what is said of a document that brings its table along.
fn standings(text: &str, format: Format, language: Option<Dialect>) -> Vec<(String, Standing)> {
    let options = CheckOptions { language, ..CheckOptions::default() };
    let found = check(text, format, None, &options).unwrap();
    found.claims.iter().map(|c| (c.name.clone(), c.standing())).collect()
}

fn of(all: &[(String, Standing)], name: &str) -> Standing {
    all.iter().find(|c| c.0 == name).unwrap_or_else(|| panic!("no claim about {name}: {all:?}")).1
}

const TABLE: &str = "| i | a | alpha | d | theta |\n|---|---|---|---|---|\n| 1 | l1 | 0 | 0 | q1 |\n| 2 | l2 | 0 | 0 | q2 |\n\n";

#[test]
fn cells_of_a_notebook_share_their_names() {
    let text = |sign: &str| {
        format!(
            "convention: standard\n\n{TABLE}```python\nfrom sympy import *\nq1, q2, l1, l2 = symbols('q1 q2 l1 l2')\n\
             x = l1*cos(q1) + l2*cos(q1 + q2)\ny = l1*sin(q1) {sign} l2*sin(q1 + q2)\n```\n\nThen\n\n\
             ```python\nJ = Matrix([x, y]).jacobian([q1, q2])\nJ.subs({{q1: pi/6, q2: pi/3, l1: 0.5, l2: 0.4}}).evalf(3)\n```\n\n\
             ```\nMatrix([\n[-0.65, -0.4],\n[0.433, 0]])\n```\n"
        )
    };
    let right = standings(&text("+"), Format::Markdown, None);
    assert!(right.iter().all(|c| c.1 == Standing::Equal), "{right:?}");
    assert_eq!(of(&right, "J"), Standing::Equal);
    let wrong = standings(&text("-"), Format::Markdown, None);
    assert_eq!([of(&wrong, "y"), of(&wrong, "J")], [Standing::Wrong, Standing::Carried]);
}

#[test]
fn what_a_program_prints() {
    let text = |printed: &str| {
        format!(
            "# standard DH\n# | i | a | alpha | d | theta |\n# | 1 | 0.3 | 0 | 0 | q1 |\n# | 2 | 0.2 | 0 | 0 | q2 |\nimport math\n\
             q1 = math.radians(30)\nq2 = math.radians(60)\nx = 0.3*math.cos(q1) + 0.2*math.cos(q1+q2)\n\
             y = 0.3*math.sin(q1) + 0.2*math.sin(q1+q2)\nprint(x, y)   # {printed}\n"
        )
    };
    for (printed, standing) in [
        ("0.2598 0.35", Standing::Equal),
        ("0.2598 0.53", Standing::Wrong),
        ("[0.26, 0.35]", Standing::Equal),
    ] {
        let all = standings(&text(printed), Format::Plain, Some(Dialect::Python));
        assert_eq!(of(&all, "x, y"), standing, "{printed}");
    }
}

#[test]
fn programs_in_c() {
    let text = |last: &str| {
        format!(
            "#include <math.h>\n/* DH (standard)\n * | i | a  | alpha | d | theta |\n * | 1 | L1 | 0 | 0 | theta1 |\n \
             * | 2 | L2 | 0 | 0 | theta2 |\n */\nfloat L1 = 100.0f; /* mm */\nfloat L2 = 80.0f;\n\n\
             void forward(float theta1, float theta2, float *x, float *y) {{\n  *x = L1*cosf(theta1) + L2*cosf(theta1 + theta2);\n  \
             *y = L1*sinf(theta1) + L2*sinf({last});\n}}\n\n\
             void jacobian(const double q[2], double J[2][2])\n{{\n  double s1 = sin(q[0]), s12 = sin(q[0] + q[1]);\n  \
             J[0][0] = -L1*s1 - L2*s12; J[0][1] = -L2*s12;\n  J[1][0] = L1*cos(q[0]) + L2*cos(q[0] + q[1]);\n  \
             J[1][1] = L2*cos(q[0] + q[1]);\n}}\n"
        )
    };
    let right = standings(&text("theta1 + theta2"), Format::Plain, Some(Dialect::C));
    let names = ["x", "y", "J[0][0]", "J[0][1]", "J[1][0]", "J[1][1]"];
    assert_eq!(names.map(|n| of(&right, n)), [Standing::Equal; 6]);
    let wrong = standings(&text("theta2"), Format::Plain, Some(Dialect::C));
    assert_eq!(
        ["x", "y", "J[1][0]"].map(|n| of(&wrong, n)),
        [Standing::Equal, Standing::Wrong, Standing::Equal]
    );
}

#[test]
fn robots_in_code_and_in_words() {
    let formulas =
        "x = np.cos(q1)*(0.3*np.cos(q2) + 0.2*np.cos(q2 + q3))\nz = 0.4 + 0.3*np.sin(q2) + 0.2*np.sin(q3)\n";
    for robot in [
        "robot = DHRobot([\n    RevoluteDH(d=0.4, a=0, alpha=pi/2),\n    RevoluteDH(d=0, a=0.3, alpha=0),\n    RevoluteDH(a=0.2)])\n",
        "L1 = Link('d', 0.4, 'a', 0, 'alpha', pi/2)\nL2 = Link('d', 0, 'a', 0.3, 'alpha', 0)\nL3 = Link('d', 0, 'a', 0.2, 'alpha', 0)\n",
        "# DH parameters (theta, d, a, alpha), standard:\n#   axis 1: q1  0.4  0  90\n#   axis 2: q2  0  0.3  0\n#   axis 3: q3  0  0.2  0\n",
        "# standard DH\n#  1: theta = q1, d = 0.4, a = 0, alpha = 90\n#  2: theta = q2, d = 0, a = 0.3, alpha = 0\n#  3: theta = q3, d = 0, a = 0.2, alpha = 0\n",
    ] {
        let text = format!("import numpy as np\nfrom math import pi\n{robot}\n{formulas}");
        let all = standings(&text, Format::Plain, Some(Dialect::Python));
        assert_eq!([of(&all, "x"), of(&all, "z")], [Standing::Equal, Standing::Wrong], "{robot}");
    }
    // Without a robot nothing is claimed.
    let options = CheckOptions { language: Some(Dialect::Python), ..CheckOptions::default() };
    assert!(check("x = 0.3\ny = 0.5\nz = x + y\n", Format::Plain, None, &options).is_err());
}

#[test]
fn branches_classes_and_bounds_of_inverse_functions() {
    let text = "import numpy as np\nclass Arm:\n    def ik(self, x, y, z, lefty=True):\n        r, s = np.hypot(x, y), z - self.d1\n        \
                c3 = (r**2 + s**2 - self.a2**2 - self.a3**2)/(2*self.a2*self.a3)\n        c3 = np.clip(c3, -1.0, 1.0)\n        \
                q3 = np.arccos(c3) if lefty else -np.arccos(c3)\n        \
                q2 = np.arctan2(s, r) - np.arctan2(self.a3*np.sin(q3), self.a2 + self.a3*np.cos(q3))\n        return q2, q3\n";
    let found = checked("articulated-3r", text, Some(Dialect::Python));
    for name in ["c3", "q3", "q2"] {
        let standing = claim(&found, name).standing();
        assert!(matches!(standing, Standing::Equal | Standing::Conditional), "{name}: {standing:?}");
    }
}
