//! Lines that were passed over once: outputs of functions with rates and forces, helpers that nothing uses, components of an axis,
//! rates told joint by joint, places given as tuples, formulas behind a letter that joins them, dynamics in letters of their own.

use denavit_check::{CheckOptions, Checked, Skipped, Standing, check};
use denavit_reading::code::Dialect;
use denavit_reading::document::Format;

fn read(text: &str, language: Option<Dialect>) -> Checked {
    let options = CheckOptions { language, ..CheckOptions::default() };
    check(text, Format::Markdown, None, &options).unwrap_or_else(|e| panic!("{e:?}\n{text}"))
}

#[track_caller]
fn is(text: &str, language: Option<Dialect>, expected: &[(&str, &[Standing])]) {
    let found = read(text, language);
    for (name, standings) in expected {
        let said: Vec<Standing> =
            found.claims.iter().filter(|c| c.name == *name).map(|c| c.standing()).collect();
        assert_eq!(said, *standings, "{name}\n{text}\n{:#?}\n{:#?}", found.claims, found.unjudged);
    }
}

const RIGHT: &[Standing] = &[Standing::Equal];
const WRONG: &[Standing] = &[Standing::Wrong];
const C: Option<Dialect> = Some(Dialect::C);
const PYTHON: Option<Dialect> = Some(Dialect::Python);
const LEG: &str = "/* DH (standard), metres:\n *   joint  theta  d  a   alpha\n *   1      q1     0  A1  90 deg\n\
                   *   2      q2     0  A2  0\n *   3      q3     0  A3  0\n */\n#define A1 0.05\n#define A2 0.10\n#define A3 0.14\n\n";
const SCARA: &str = "DH (standard), metres\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0.4 | 0.3 | 0° |\n\
                     | 2 | θ2 | 0 | 0.2 | 180° |\n| 3 | 0 | d3 | 0 | 0° |\n\n";

#[test]
fn rates_and_forces_are_vectors_beside_that_of_the_joints() {
    let speed = |last: &str| {
        format!(
            "{LEG}double climb(const double q[3], const double qd[3])\n{{\n  \
             double zdot = A2*cos(q[1])*qd[1] + A3*cos(q[1] + q[2])*{last};\n  return zdot;\n}}\n"
        )
    };
    is(&speed("(qd[1] + qd[2])"), C, &[("zdot", RIGHT)]);
    is(&speed("qd[1]"), C, &[("zdot", WRONG)]);
    let torques = |lever: &str| {
        format!(
            "{LEG}void statics(const double q[3], const double f[3], double tau[3])\n{{\n  double c1 = cos(q[0]), s1 = sin(q[0]);\n  \
             double r = A1 + A2*cos(q[1]) + A3*cos(q[1] + q[2]);\n  double z = A2*sin(q[1]) + A3*sin(q[1] + q[2]);\n  \
             tau[0] = r*(c1*f[1] - s1*f[0]);\n  tau[1] = -z*(c1*f[0] + s1*f[1]) + ({lever})*f[2];\n  \
             tau[2] = -A3*sin(q[1] + q[2])*(c1*f[0] + s1*f[1]) + A3*cos(q[1] + q[2])*f[2];\n}}\n"
        )
    };
    is(&torques("r - A1"), C, &[("tau[0]", RIGHT), ("tau[1]", RIGHT), ("tau[2]", RIGHT)]);
    is(&torques("r"), C, &[("tau[0]", RIGHT), ("tau[1]", WRONG), ("tau[2]", RIGHT)]);
}

#[test]
fn rates_stand_beside_some_of_the_joints() {
    let text = |vz: &str| {
        format!(
            "\"\"\"DH (standard)\n  joint theta d a alpha\n  1 t1 0.4 0.3 0\n  2 t2 0 0.2 180\n  3 0 d3 0 0\n  4 t4 0 0 0\n\"\"\"\n\
             def velocity(t1, t2, w1, w2, v3, w4):\n    vx = -0.3*sin(t1)*w1 - 0.2*sin(t1 + t2)*(w1 + w2)\n    \
             vy = 0.3*cos(t1)*w1 + 0.2*cos(t1 + t2)*(w1 + w2)\n    vz = {vz}\n    return vx, vy, vz\n"
        )
    };
    is(&text("-v3"), PYTHON, &[("vx", RIGHT), ("vy", RIGHT), ("vz", RIGHT)]);
    is(&text("v3"), PYTHON, &[("vx", RIGHT), ("vy", RIGHT), ("vz", WRONG)]);
}

#[test]
fn components_of_an_axis_may_be_plain_sines() {
    let text = |y: &str| {
        format!(
            "\"\"\"DH (standard)\n  joint theta d a alpha\n  1 pan 0.3 0.04 90\n  2 tilt 0 0.09 0\n\"\"\"\n\
             def up(pan, tilt):\n    ux = -cos(pan)*sin(tilt)\n    uy = {y}\n    uz = cos(tilt)\n    return ux, uy, uz\n"
        )
    };
    is(&text("-sin(pan)*sin(tilt)"), PYTHON, &[("ux", RIGHT), ("uy", RIGHT), ("uz", RIGHT)]);
    is(&text("-sin(pan)*cos(tilt)"), PYTHON, &[("ux", RIGHT), ("uy", WRONG), ("uz", RIGHT)]);
}

#[test]
fn lines_of_programs_of_which_nothing_is_said_are_listed() {
    let body =
        "void other(double u, double v, double *a, double *b)\n{\n  *a = 0;\n  *b = A2*u + A3*cos(v);\n}\n";
    let found = read(&format!("{LEG}{body}"), C);
    let listed = |part: &str| {
        found.unjudged.iter().any(|u| {
            LEG.len() <= u.span.start && {
                let text = format!("{LEG}{body}");
                text[u.span.clone()].contains(part) && !text[u.span.clone()].contains("void")
            }
        })
    };
    assert!(listed("a = 0") && listed("A3*cos(v)"), "{:?}", found.unjudged);
    // An abbreviation is nothing to be judged.
    let short = format!("{LEG}void fk(const double q[3], double p[1])\n{{\n  double c2 = cos(q[1]);\n}}\n");
    let found = read(&short, C);
    let is_short = |s: &Skipped| matches!(s, Skipped::OfProgram(n) if n == "c2");
    assert!(!found.unjudged.iter().any(|u| is_short(&u.why)), "{:?}", found.unjudged);
}

#[test]
fn the_table_has_its_own_letter_for_a_joint_vector() {
    let body = |sign: &str| {
        format!(
            "{}void joints(double x, double y, double z, int elbow, double t[3])\n{{\n  double u = sqrt(x*x + y*y) - A1;\n  \
             double c3 = (u*u + z*z - A2*A2 - A3*A3)/(2.0*A2*A3);\n  double s3 = elbow*sqrt(1.0 - c3*c3);\n  \
             t[0] = atan2({sign});\n  t[2] = atan2(s3, c3);\n  t[1] = atan2(z, u) - atan2(A3*s3, A2 + A3*c3);\n}}\n",
            LEG.replace("q1", "t[0]").replace("q2", "t[1]").replace("q3", "t[2]")
        )
    };
    let half = &[Standing::Conditional];
    is(&body("y, x"), C, &[("t[0]", half), ("t[2]", half), ("t[1]", half)]);
    is(&body("x, y"), C, &[("t[0]", WRONG)]);
}

#[test]
fn a_sum_along_z_has_the_letter_of_its_row_for_the_joint() {
    let text = |torque: &str| {
        format!(
            "\"\"\"DH (standard)\n  joint theta d a alpha\n  1 0 z0+z1 0 0\n  2 t2 0 l2 0\n  3 t3 0 l3 0\n\"\"\"\n\
             def statics(z1, t2, t3, fx, fy, fz):\n    f1 = fz\n    tau2 = -(l2*sin(t2) + l3*sin(t2 + t3))*fx + (l2*cos(t2) + l3*cos(t2 + t3))*fy\n    \
             tau3 = {torque}\n    return f1, tau2, tau3\n"
        )
    };
    let right = "-l3*sin(t2 + t3)*fx + l3*cos(t2 + t3)*fy";
    is(&text(right), PYTHON, &[("tau2", RIGHT), ("tau3", RIGHT)]);
    is(&text(&right[1..]), PYTHON, &[("tau2", RIGHT), ("tau3", WRONG)]);
}

#[test]
fn rates_are_told_joint_by_joint() {
    let text = |words: &str, vy: &str| {
        format!("{SCARA}θ1 = 30°, θ2 = 40°, d3 = 0.1\n\n{words},\n\nvx = -0.364 m/s e vy = {vy} m/s.\n")
    };
    let ordinals = "Com 0.8 rad/s na primeira junta e 0.5 rad/s na segunda";
    is(&text(ordinals, "0.297"), None, &[("vx", RIGHT), ("vy", RIGHT)]);
    is(&text(ordinals, "0.247"), None, &[("vx", RIGHT), ("vy", WRONG)]);
    let one = format!(
        "{SCARA}θ1 = 30°, θ2 = 40°, d3 = 0.1\n\nWith θ1 at 0.8 rad/s, the others at rest,\n\nvx = -0.270 m/s\n"
    );
    is(&one, None, &[("vx", RIGHT)]);
}

#[test]
fn a_tuple_of_coordinates_is_a_goal() {
    let text = |angle: &str| {
        format!(
            "{SCARA}The arm reaches the target $(x,y,z)=(0.25,\\,0.30,\\,0.10)$ with\n\n- $d_3 = 0.3$,\n- $\\theta_2 = {angle}^\\circ$\n"
        )
    };
    is(&text("78.00"), None, &[("d_3", RIGHT), ("\\theta_2", RIGHT)]);
    let found = read(&text("70.00"), None);
    let second = found.claims.iter().find(|c| c.name == "\\theta_2").map(|c| c.standing());
    assert_ne!(second, Some(Standing::Equal), "{:?}", found.claims);
}

#[test]
fn helpers_of_joints_are_what_the_pose_makes_them() {
    let text = |shoulder: &str| {
        format!(
            "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | h | 0 | 90° |\n| 2 | θ2 | 0 | a2 | 0 |\n| 3 | θ3 | 0 | a3 | 0 |\n\n\
             With rho = a2 cos θ2 + a3 cos(θ2+θ3) the hand is at\n\nx = rho cos θ1\n\ny = rho sin θ1\n\n## Inverse\n\nw = z - h\n\nrho^2 = x^2 + y^2\n\n\
             k = cos θ3 = (x^2 + y^2 + w^2 - a2^2 - a3^2)/(2 a2 a3)\n\nθ3 = atan2(±sqrt(1 - k^2), k)\n\nθ2 = {shoulder}\n"
        )
    };
    let found = read(&text("atan2(w, rho) - atan2(a3 sin θ3, a2 + a3 cos θ3)"), None);
    let of = |found: &Checked, name: &str| found.claims.iter().find(|c| c.name == name).map(|c| c.standing());
    assert!(matches!(of(&found, "θ2"), Some(Standing::Equal | Standing::Conditional)), "{:?}", found.claims);
    assert_eq!(of(&found, "θ3"), Some(Standing::Equal), "{:?}", found.claims);
    let found = read(&text("atan2(rho, w) - atan2(a3 sin θ3, a2 + a3 cos θ3)"), None);
    assert_eq!(of(&found, "θ2"), Some(Standing::Wrong), "{:?}", found.claims);
}

#[test]
fn dynamics_of_joints_without_numbers() {
    let text = |sign: &str| {
        format!(
            "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ+90° | 0 | 0 | 90° |\n| 2 | 0 | r | 0 | 0 |\n\n\
             A point mass $m$ at the tip, gravity along $-y_0$.\n\n$$K = \\tfrac12 m(\\dot r^2 + r^2\\dot\\theta^2)$$\n\n\
             $$\\tau_1 = m r^2\\ddot\\theta + 2 m r\\dot r\\dot\\theta + m g r\\cos\\theta$$\n\n$$\\tau_2 = m\\ddot r {sign} m r\\dot\\theta^2 + m g\\sin\\theta$$\n"
        )
    };
    is(&text("-"), None, &[("K", RIGHT), ("\\tau_1", RIGHT), ("\\tau_2", RIGHT)]);
    is(&text("+"), None, &[("K", RIGHT), ("\\tau_1", RIGHT), ("\\tau_2", WRONG)]);
}

#[test]
fn formulas_behind_words_and_before_units() {
    let text = |det: &str| {
        format!(
            "DH (standard), mm\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | t1 | 0 | 120 | 0 |\n| 2 | t2 | 0 | 95 | 0 |\n\n\
                 It jitters at the rim, because det J = {det} (mm²) goes to zero there.\n"
        )
    };
    is(&text("11400 sin(t2)"), None, &[("det J", RIGHT)]);
    is(&text("11400 cos(t2)"), None, &[("det J", WRONG)]);
    let boundary = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | h | 0 | 90° |\n| 2 | θ2 | 0 | a2 | 0 |\n| 3 | θ3 | 0 | a3 | 0 |\n\n\
                    The arm is over the shoulder where $a_2 c_2 + a_3 c_{23} = 0$.\n";
    is(boundary, None, &[("a_2 c_2 + a_3 c_{23}", RIGHT)]);
}

#[test]
fn a_row_that_is_transposed_is_a_column() {
    let text = |middle: &str| {
        format!(
            "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | d1 | 0 | 90° |\n| 2 | θ2 | d2 | 0 | -90° |\n| 3 | 0 | d3 | 0 | 0 |\n\n\
             The tool origin is $o_3^0 = [-c_1s_2d_3 + s_1d_2,\\; -s_1s_2d_3 {middle} c_1d_2,\\; d_1 + c_2d_3]^T$.\n"
        )
    };
    is(&text("-"), None, &[("o_3^0", RIGHT)]);
    is(&text("+"), None, &[("o_3^0", WRONG)]);
    let found = read(&text("-"), None);
    let places: Vec<_> = found.claims[0].entries.iter().map(|e| e.place).collect();
    assert_eq!(places, [Some((1, 1)), Some((2, 1)), Some((3, 1))], "{:?}", found.claims);
}
