//! Programs in C as they stand in firmware: entries set one by one, structures, choices by `?`, flat matrices, and functions that
//! give something else than a place.

use denavit_check::{CheckOptions, Checked, Standing, check};
use denavit_reading::code::Dialect;
use denavit_reading::document::Format;

const HEAD: &str = "/* DH (standard), metres:\n *   joint  theta  d   a   alpha\n *   1      q1     D1  A1  +90 deg\n *   2      q2     0   A2  0\n\
                     *   3      q3     0   A3  0\n */\n#define D1 0.09\n#define A1 0.03\n#define A2 0.14\n#define A3 0.16\n\
                     typedef struct { double x, y, z; } vec3;\n\n";

fn read(body: &str) -> Checked {
    let options = CheckOptions { language: Some(Dialect::C), ..CheckOptions::default() };
    let text = format!("{HEAD}{body}");
    check(&text, Format::Plain, None, &options).unwrap_or_else(|e| panic!("{e:?}\n{text}"))
}

#[track_caller]
fn is(found: &Checked, name: &str, standing: Standing) {
    let said: Vec<Standing> = found.claims.iter().filter(|c| c.name == name).map(|c| c.standing()).collect();
    assert_eq!(said, [standing], "{name}: {:?}", found.claims);
}

#[test]
fn entries_that_are_set_one_by_one_have_a_verdict_each() {
    let body = |last: &str| {
        format!(
            "void jacobian(double q1, double q2, double q3, double J[3][3])\n{{\n  double c1 = cos(q1), s1 = sin(q1);\n\
             double w = A1 + A2*cos(q2) + A3*cos(q2 + q3), v = A2*sin(q2) + A3*sin(q2 + q3);\n\
             J[0][0] = -s1*w;  J[0][1] = -c1*v;  J[0][2] = -A3*c1*sin(q2 + q3);\n\
             J[1][0] = c1*w;   J[1][1] = -s1*v;  J[1][2] = {last};\n\
             J[2][0] = 0.0;    J[2][1] = A2*cos(q2) + A3*cos(q2 + q3);\n  J[2][2] = A3*cos(q2 + q3);\n}}\n"
        )
    };
    let found = read(&body("A3*s1*sin(q2 + q3)"));
    is(&found, "J[1][2]", Standing::Wrong);
    for name in ["J[0][0]", "J[0][1]", "J[0][2]", "J[1][0]", "J[1][1]", "J[2][1]", "J[2][2]"] {
        is(&found, name, Standing::Equal);
    }
    is(&read(&body("-A3*s1*sin(q2 + q3)")), "J[1][2]", Standing::Equal);
}

#[test]
fn the_cause_of_what_is_carried_is_the_entry_at_fault() {
    let found = read(
        "void jac(double q1, double q2, double q3, double J[3][3])\n{\n  double w = A1 + A2*cos(q2) + A3*cos(q2 + q3);\n\
         J[0][0] = -sin(q1)*w;  J[0][1] = -cos(q1)*(A2*sin(q2) + A3*sin(q2 + q3));  J[0][2] = -A3*cos(q1)*sin(q2 + q3);\n\
         J[1][0] = cos(q1)*w;   J[1][1] = sin(q1)*(A2*sin(q2) + A3*sin(q2 + q3));   J[1][2] = -A3*sin(q1)*sin(q2 + q3);\n\
         J[2][0] = 0.0;  J[2][1] = A2*cos(q2) + A3*cos(q2 + q3);  J[2][2] = A3*cos(q2 + q3);\n}\n",
    );
    is(&found, "J[1][1]", Standing::Wrong);
    is(&found, "J[0][0]", Standing::Equal);
    for claim in &found.claims {
        for entry in &claim.entries {
            if let denavit_check::Finding::Carried { by, .. } = entry.finding {
                assert!(matches!(found.claims[by].standing(), Standing::Wrong | Standing::Carried));
            }
        }
    }
}

#[test]
fn structures_and_choices() {
    let body = |first: &str| {
        format!(
            "int ik(vec3 p, int up, double q[3])\n{{\n  double w, h, D;\n  q[0] = atan2({first});\n\
             w = sqrt(p.x*p.x + p.y*p.y) - A1;\n  h = p.z - D1;\n\
             D = (w*w + h*h - A2*A2 - A3*A3) / (2.0*A2*A3);\n  q[2] = up ? -acos(D)\n            : acos(D);\n\
             q[1] = atan2(h, w) - atan2(A3*sin(q[2]), A2 + A3*cos(q[2]));\n  return 1;\n}}\n"
        )
    };
    // The shoulder forwards only: right as far as it goes.
    let found = read(&body("p.y, p.x"));
    for name in ["q[0]", "q[2]", "q[1]"] {
        is(&found, name, Standing::Conditional);
    }
    is(&read(&body("p.x, p.y")), "q[0]", Standing::Wrong);
}

#[test]
fn flat_matrices_and_determinants() {
    let body = |entry: &str, factor: &str| {
        format!(
            "void rot(double q1, double q2, double q3, double R[9])\n{{\n\
             R[0] = cos(q1)*cos(q2 + q3);  R[1] = -cos(q1)*sin(q2 + q3);  R[2] = sin(q1);\n\
             R[3] = sin(q1)*cos(q2 + q3);  R[4] = -sin(q1)*sin(q2 + q3);  R[5] = {entry};\n\
             R[6] = sin(q2 + q3);          R[7] = cos(q2 + q3);           R[8] = 0.0;\n}}\n\n\
             double arm_det(double q2, double q3)\n{{\n  double w = A1 + A2*cos(q2) + A3*cos(q2 + q3);\n\
             return {factor}*A3*w*sin(q3);\n}}\n"
        )
    };
    let right = read(&body("-cos(q1)", "-A2"));
    is(&right, "R[5]", Standing::Equal);
    is(&right, "arm_det(…)", Standing::Equal);
    let wrong = read(&body("cos(q1)", "A2"));
    is(&wrong, "R[5]", Standing::Wrong);
    is(&wrong, "R[0]", Standing::Equal);
    is(&wrong, "arm_det(…)", Standing::Wrong);
    // Rows, as C has them: a transposed rotation is another one.
    let turned = body("-cos(q1)", "-A2")
        .replace("R[1] =", "R[x] =")
        .replace("R[3] =", "R[1] =")
        .replace("R[x] =", "R[3] =");
    is(&read(&turned), "R[1]", Standing::Wrong);
}

#[test]
fn what_is_no_place_is_not_called_a_wrong_one() {
    // An argument beside named joints is no joint; a velocity and a torque are no positions.
    let found = read(
        "double hold(double q2, double q3, double G) { return -G*(A2*cos(q2) + A3*cos(q2 + q3)); }\n\
         void tip_vel(double q1, double q2, double q3, double u1, double u2, double u3, double v[3])\n{\n\
         v[0] = u1;\n  v[1] = u2;\n  v[2] = u3;\n}\n",
    );
    assert!(found.claims.iter().all(|c| c.standing() != Standing::Wrong), "{:?}", found.claims);
    assert!(!found.unjudged.is_empty());
}

#[test]
fn remarks_behind_rows_of_a_table() {
    let text = "// DH table, standard:  theta, d, a, alpha\n//   pan   :  q1, H, E, -90 deg     (E: the tilt axis sits beside the pan axis)\n\
                //   tilt  :  q2, 0, 0, +90 deg\n//   boom  :  0,  q3, 0, 0\n#define H 1.25\n#define E 0.18\n\n\
                void pos(double q1, double q2, double q3, double out[3])\n{\n    double r = E + q3*sin(q2);\n\
                out[0] = r*cos(q1);\n    out[1] = r*sin(q1);\n    out[2] = H - q3*cos(q2);\n}\n";
    let options = CheckOptions { language: Some(Dialect::C), ..CheckOptions::default() };
    let found = check(text, Format::Plain, None, &options).unwrap();
    is(&found, "out[0]", Standing::Equal);
    is(&found, "out[2]", Standing::Wrong);
    // Brackets of a cell are no remark.
    let bracketed = text.replace("0,  q3, 0, 0\n", "0,  q3, 0, (pi / 2)\n");
    let found = check(&bracketed, Format::Plain, None, &options).unwrap();
    is(&found, "out[0]", Standing::Equal);
}

#[test]
fn functions_of_a_part_of_the_joints() {
    let text = |level: &str| {
        format!(
            "# DH (standard)\n# | i | theta | d | a | alpha |\n# | 1 | q1 | 0 | L1 | 0 |\n# | 2 | q2 | 0 | L2 | 0 |\n# | 3 | q3 | 0 | L3 | 0 |\n\
             # Rods keep the hand level.\nimport numpy as np\n\ndef forward(q1, q2):\n    x = L1*np.cos(q1) + L2*np.cos(q1 + q2) + {level}\n    return x\n"
        )
    };
    let options = CheckOptions { language: Some(Dialect::Python), ..CheckOptions::default() };
    let found = check(&text("L3"), Format::Plain, None, &options).unwrap();
    assert!(found.claims.iter().all(|c| c.standing() != Standing::Wrong), "{:?}", found.claims);
    // One that takes all joints says what it says.
    let all = text("L3").replace("forward(q1, q2)", "forward(q1, q2, q3)");
    let found = check(&all, Format::Plain, None, &options).unwrap();
    assert!(found.claims.iter().any(|c| c.standing() == Standing::Wrong), "{:?}", found.claims);
}

const PLANAR: &str = "// DH (standard): theta, d, a, alpha\n//   joint 1: theta = q1, d = 0, a = L1, alpha = 0\n\
                       //   joint 2: theta = q2, d = 0, a = L2, alpha = 0\n";

/// What is said of a program about the planar arm.
fn planar(body: &str, language: Dialect) -> Vec<(String, Standing)> {
    let options = CheckOptions { language: Some(language), ..CheckOptions::default() };
    let head = if language == Dialect::C { PLANAR.to_string() } else { PLANAR.replace("//", "#") };
    let found = check(&format!("{head}{body}"), Format::Plain, None, &options).expect("a table");
    found.claims.iter().map(|c| (c.name.clone(), c.standing())).collect()
}

/// What a loop that is not read changes is not what it was before.
#[test]
fn loops_that_are_not_read_leave_nothing_to_judge() {
    let body = |turns: &str| {
        format!(
            "void fk(double q1, double q2, double L1, double L2, double *px, double *py)\n{{\n  double x = 0, y = 0, phi = 0;\n\
             \x20 int i = 0;\n{turns}\n  *px = x;\n  *py = y;\n}}\n"
        )
    };
    for turns in [
        "  while (i < 2) { phi += i ? q2 : q1; x += (i ? L2 : L1) * cos(phi); y += (i ? L2 : L1) * sin(phi); i++; }",
        "  for (auto p : {q1, q2}) { phi += p; x += L1 * cos(phi); y += L1 * sin(phi); }",
        "  auto add = [&](double q, double l) { phi += q; x += l * cos(phi); y += l * sin(phi); };\n  add(q1, L1);\n  add(q2, L2);",
    ] {
        assert_eq!(planar(&body(turns), Dialect::C), [], "{turns}");
    }
    let python = "def fk(q1, q2, L1, L2):\n    x, y, phi = 0, 0, 0\n    todo = [(q1, L1), (q2, L2)]\n    while todo:\n        q, l = todo.pop(0)\n\
                  \x20       phi += q\n        x += l * cos(phi)\n        y += l * sin(phi)\n    return x, y\n";
    assert_eq!(planar(python, Dialect::Python), []);
}

/// Each function has its joints in degrees or in radians for itself.
#[test]
fn one_function_in_degrees_leaves_the_others_in_radians() {
    let body = "#define RAD (M_PI / 180.0)\nvoid forward(double q1, double q2, double *x, double *y)\n{\n  *x = L1 * cos(q1) + L2 * cos(q1 + q2);\n\
                \x20 *y = L1 * sin(q1) - L2 * sin(q1 + q2);\n}\nvoid degrees(double q1, double q2, double *x, double *y)\n{\n\
                \x20 forward(q1 * RAD, q2 * RAD, x, y);\n}\n";
    let found = planar(body, Dialect::C);
    assert_eq!(found, [("x".into(), Standing::Equal), ("y".into(), Standing::Wrong)]);
}

/// Inverse formulas in degrees hold if their factors do.
#[test]
fn a_missing_factor_of_degrees_is_not_proved() {
    let body = |last: &str| {
        format!(
            "RAD = pi / 180\nDEG = 180 / pi\n\ndef forward(q1, q2):\n    x = L1 * cos(q1 * RAD) + L2 * cos((q1 + q2) * RAD)\n    return x\n\n\
             def inverse(x, y):\n    c = (x*x + y*y - L1*L1 - L2*L2) / (2*L1*L2)\n    q2 = arccos(c) * DEG\n\
             \x20   q1 = arctan2(y, x) * DEG - arctan2(L2*sin(q2*RAD), L1 + L2*cos(q2*RAD)){last}\n    return q1, q2\n"
        )
    };
    let standing = |last: &str| {
        let found = planar(&body(last), Dialect::Python);
        found.into_iter().find(|f| f.0 == "q1").map(|f| f.1)
    };
    assert_eq!(standing(" * DEG"), Some(Standing::Equal));
    for last in ["", " * DEG * DEG", " * RAD"] {
        assert_eq!(standing(last), None, "{last}");
    }
}

/// A matrix of Eigen has the sizes with which it is made.
#[test]
fn sizes_of_matrices_are_those_of_their_declaration() {
    let head = format!(
        "{PLANAR}//   joint 3: theta = q3, d = 0, a = L3, alpha = 0\nconst double L1 = 0.4, L2 = 0.3, L3 = 0.2;\n"
    );
    let standing = |declared: &str| {
        let body = format!(
            "MatrixXd jacobian(double q1, double q2, double q3)\n{{\n  double s1 = sin(q1), s12 = sin(q1 + q2), s123 = sin(q1 + q2 + q3);\n\
             \x20 double c1 = cos(q1), c12 = cos(q1 + q2), c123 = cos(q1 + q2 + q3);\n  {declared}\n\
             \x20 J << -L1*s1 - L2*s12 - L3*s123, -L2*s12 - L3*s123, -L3*s123,\n\
             \x20       L1*c1 + L2*c12 + L3*c123, L2*c12 + L3*c123, L3*c123;\n  return J;\n}}\n"
        );
        let options = CheckOptions { language: Some(Dialect::C), ..CheckOptions::default() };
        let found = check(&format!("{head}{body}"), Format::Plain, None, &options).expect("a table");
        found.claims.iter().map(|c| c.standing()).collect::<Vec<_>>()
    };
    assert_eq!(standing("MatrixXd J(2, 3);"), [Standing::Equal]);
    assert_eq!(standing("MatrixXd J;"), []);
}
