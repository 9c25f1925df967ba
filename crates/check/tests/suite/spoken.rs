//! Words, letters and numbers around formulas: rates by letters and primes, poses that are to be reached in numbers, measured
//! values, configurations by rows, entries of the matrix printed last; velocities and torques of programs.

use denavit_check::{CheckOptions, Checked, Standing, check};
use denavit_reading::code::Dialect;
use denavit_reading::document::Format;

fn read(text: &str, format: Format, language: Option<Dialect>) -> Checked {
    let options = CheckOptions { language, ..CheckOptions::default() };
    check(text, format, None, &options).unwrap_or_else(|e| panic!("{e:?}\n{text}"))
}

/// The standings of the claims with a name.
fn all(checked: &Checked, name: &str) -> Vec<Standing> {
    checked.claims.iter().filter(|c| c.name == name).map(|c| c.standing()).collect()
}

#[track_caller]
fn is(text: &str, expected: &[(&str, &[Standing])]) {
    let found = read(text, Format::Markdown, None);
    for (name, standings) in expected {
        assert_eq!(all(&found, name), *standings, "{name}\n{text}\n{:#?}", found.claims);
    }
}

#[track_caller]
fn is_program(text: &str, language: Dialect, expected: &[(&str, &[Standing])]) {
    let found = read(text, Format::Plain, Some(language));
    for (name, standings) in expected {
        assert_eq!(all(&found, name), *standings, "{name}\n{text}\n{:#?}", found.claims);
    }
}

const RIGHT: &[Standing] = &[Standing::Equal];
const WRONG: &[Standing] = &[Standing::Wrong];
const PLANAR: &str = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | a1 | 0 |\n\
                      | 2 | θ2 | 0 | a2 | 0 |\n\n";
const SCARA: &str = "DH (standard), mm\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 420 | 300 | 0° |\n\
                     | 2 | θ2 | 0 | 250 | 180° |\n| 3 | 0 | d3 | 0 | 0° |\n\n";
const TURRET: &str = "/*\n * DH table, standard convention, units m:\n *\n *   joint | theta | d | a | alpha\n \
                      *   1 | th1 | 0.62 | 0.08 | 90 deg\n *   2 | th2 + 90 deg | 0 | 0 | 90 deg\n \
                      *   3 | 0 | ext | 0 | 0\n */\n#include <math.h>\n#define A1 0.08\n\n";

#[test]
fn rates_have_letters_of_their_own() {
    for words in ["ω1 and ω2 are the joint rates (rad/s).", "Joint speeds: u1 for θ1, w2 for θ2."] {
        let letters = if words.starts_with('J') { ["u1", "w2"] } else { ["ω1", "ω2"] };
        let [a, b] = letters;
        let text = format!(
            "{PLANAR}{words}\n\nvx = -(a1 s1 + a2 s12) {a} - a2 s12 {b}\n\nvy = (a1 c1 + a2 c12) {a} + a1 c12 {b}\n"
        );
        is(&text, &[("vx", RIGHT), ("vy", WRONG)]);
    }
}

#[test]
fn a_prime_is_the_derivative_by_time() {
    let text = format!(
        "{PLANAR}u = a1 c1 + a2 c12\n\nFor the feed rates:\n\nx' = -(a1 s1 + a2 s12) θ1' - a2 s12 θ2'\n\ny' = u θ1' - a2 c12 θ2'\n"
    );
    is(&text, &[("x'", RIGHT), ("y'", WRONG)]);
}

#[test]
fn what_somebody_measured_is_no_claim() {
    let text = format!("{PLANAR}a1 = 0.3 m, a2 = 0.2 m, θ1 = 0°, θ2 = 90°:\n\nx = 0.300 m\n\n");
    is(&format!("{text}We measured x = 0.295 m there.\n"), &[("x", RIGHT)]);
    is(&format!("{text}Again x = 0.295 m there.\n"), &[("x", &[Standing::Equal, Standing::Wrong])]);
    // The remark behind a value says nothing of the next line.
    let lines =
        "θ1 = 0°, θ2 = 90°:\n\n    x = 0.300 m    measured 0.295\n    y = 0.250 m    measured 0.199\n";
    is(&format!("{PLANAR}a1 = 0.3 m, a2 = 0.2 m.\n\n{lines}"), &[("x", RIGHT), ("y", WRONG)]);
}

#[test]
fn a_row_of_numbers_is_a_configuration() {
    let text = format!(
        "{SCARA}Travel at d3 = 180: low.\n\nExamples:\n\n   (0, 90, 100):   X = 300.0   Y = 250.0   Z = 320.0\n   (90, -90, 20):   X = 250.0   Y = 301.0   Z = 400.0\n"
    );
    is(
        &text,
        &[
            ("X", &[Standing::Equal, Standing::Equal]),
            ("Y", &[Standing::Equal, Standing::Wrong]),
            ("Z", &[Standing::Equal, Standing::Equal]),
        ],
    );
}

#[test]
fn numbers_of_formulas_where_a_pose_is_reached() {
    let text = format!(
        "{SCARA}## Inverse kinematics\n\nFor the point x = 200 mm, y = 420 mm:\n\ncos(θ2) = (x² + y² - 300² - 250²)/(2·300·250) = 0.4260\n\n- solution 1: θ2 = 64.79°, θ1 = 35.44°\n- solution 2: θ2 = -64.79°, θ1 = 93.63°\n"
    );
    let twice: &[Standing] = &[Standing::Equal, Standing::Equal];
    is(&text, &[("cos(θ2)", twice), ("θ1", twice), ("θ2", twice)]);
    let wrong = text.replace("0.4260", "0.4620").replace("93.63", "93.36");
    is(
        &wrong,
        &[("cos(θ2)", &[Standing::Equal, Standing::Wrong]), ("θ1", &[Standing::Equal, Standing::Wrong])],
    );
}

#[test]
fn entries_of_the_matrix_printed_last() {
    let table = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | 0 | -90° |\n| 2 | θ2 | 0 | 0 | 90° |\n| 3 | θ3 | 0 | 0 | 0 |\n| 4 | θ4 | 0 | a4 | 0 |\n\n";
    let matrix = "$$R^0_3 = \\begin{bmatrix} c_1c_2c_3-s_1s_3 & -c_1c_2s_3-s_1c_3 & c_1s_2\\\\ s_1c_2c_3+c_1s_3 & -s_1c_2s_3+c_1c_3 & s_1s_2\\\\ -s_2c_3 & s_2s_3 & c_2\\end{bmatrix}$$\n\n";
    is(&format!("{table}{matrix}from which $\\cos\\theta_2 = r_{{33}}$.\n"), &[("\\cos\\theta_2", RIGHT)]);
    let tangent = |t: &str| format!("{table}{matrix}from which $\\tan\\theta_3 = {t}$.\n");
    is(&tangent("-r_{32}/r_{31}"), &[("\\tan\\theta_3", RIGHT)]);
    is(&tangent("r_{32}/r_{31}"), &[("\\tan\\theta_3", WRONG)]);
}

#[test]
fn what_something_satisfies_holds_there() {
    let text = format!(
        "{PLANAR}$$ x = a_1 c_1 + a_2 c_{{12}} $$\n\nOn the axis the angles satisfy\n\n$$ a_1 c_1 + a_2 c_{{12}} = -a_1 $$\n"
    );
    let found = read(&text, Format::Markdown, None);
    assert!(found.claims.iter().all(|c| c.standing() == Standing::Equal), "{:#?}", found.claims);
}

#[test]
fn a_wrist_counts_on() {
    let text = "DH (standard)\n\n| joint | θ | d | a | α |\n|---|---|---|---|---|\n| 1 (th4) | th4 | 0 | 0 | -90° |\n| 2 (th5) | th5 | 0 | 0 | 90° |\n| 3 (th6) | th6 | d6 | 0 | 0 |\n\nr13 = c4*s5\n\nr31 = s5*c6\n\nNumbers: th4 = 30 deg, th5 = 60 deg, th6 = 90 deg gives r33 = 0.500, r13 = 0.750.\n";
    is(text, &[("r13", &[Standing::Equal, Standing::Equal]), ("r31", WRONG), ("r33", RIGHT)]);
}

#[test]
fn the_flipped_solution_beside_a_corrected_one() {
    let text = "DH (standard)\n\n| joint | θ | d | a | α |\n|---|---|---|---|---|\n| 4 | q4 | 0 | 0 | -90° |\n| 5 | q5 | 0 | 0 | 90° |\n| 6 | q6 | d6 | 0 | 0 |\n\nq5 = atan2(sqrt(r13^2 + r23^2), r33)\n\nq4 = atan2(r13, r23)\n\nYou have swapped the arguments:\n\nq4 = atan2(r23, r13)\n\nThe other solution:\n\nq5 = atan2(-sqrt(r13^2 + r23^2), r33)\n\nq4 = atan2(-r23, -r13)\n";
    let found = read(text, Format::Markdown, None);
    let wrong: Vec<usize> =
        found.claims.iter().filter(|c| c.standing() == Standing::Wrong).map(|c| c.span.start).collect();
    assert_eq!(wrong, [text.find("q4 = atan2(r13").unwrap()], "{:#?}", found.claims);
}

#[test]
fn a_matrix_in_a_fence_below_its_name() {
    let text = format!(
        "{PLANAR}T01 =\n\n```\n[ c1  -s1  0  a1*c1 ]\n[ s1  c1   0  a1*s1 ]\n[ 0   0    1  0 ]\n[ 0   0    0  1 ]\n```\n"
    );
    is(&text, &[("T01", RIGHT)]);
    is(&text.replace("a1*s1", "a1*c1"), &[("T01", WRONG)]);
}

#[test]
fn a_coordinate_beside_right_ones_is_the_hand() {
    let text = format!(
        "{SCARA}x = 300 cos θ1 + 250 cos(θ1 + θ2)\n\ny = 300 sin θ1 + 250 sin(θ1 + θ2)\n\nz = 420 + d3\n\nFor θ1 = 20°, θ2 = 50°, d3 = 120:\n\nz = 540\n"
    );
    let found = read(&text, Format::Markdown, None);
    assert_eq!(all(&found, "z").first(), Some(&Standing::Wrong), "{:#?}", found.claims);
    assert!(!all(&found, "z").contains(&Standing::Equal), "{:#?}", found.claims);
}

#[test]
fn determinants_of_blocks() {
    // Of the joints that move the point.
    let wrist = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | 0 | q1 | 0 | 0 |\n| 2 | q2 | 0 | l2 | 0 |\n| 3 | q3 | 0 | l3 | 0 |\n| 4 | q4 | l4 | 0 | 0 |\n\n";
    is(&format!("{wrist}det J_v = l2 l3 sin q3\n"), &[("det J_v", RIGHT)]);
    is(&format!("{wrist}det J_v = l2 l3 cos q3\n"), &[("det J_v", WRONG)]);
    // Of the block that is printed in numbers.
    let numbers = format!(
        "{SCARA}For θ1 = 20°, θ2 = 50°, d3 = 120 mm:\n\nJ = | -337.5 -234.9 |\n    |  367.4   85.5 |\n\ndet J = 57453 mm²\n"
    );
    is(&numbers, &[("det J", RIGHT)]);
    let printed = "Jv =\n\n```\n| -a1*s1 - a2*s12  -a2*s12 |\n|  a1*c1 + a2*c12   a2*c12 |\n```\n\n";
    is(&format!("{PLANAR}{printed}det(Jv) = a1*a2*s2\n"), &[("det(Jv)", RIGHT)]);
}

#[test]
fn a_torque_is_no_helper() {
    let text = format!(
        "{PLANAR}A force (fx, fy) acts on the tip.\n\ntau1 = -(a1 s1 + a2 s12) fx + (a1 c1 + a2 c12) fy\n\ntau2 = -a2 s12 fx + a2 c2 fy\n\na1 = 0.5 m, a2 = 0.3 m, θ1 = 30°, θ2 = 45°, fx = 20 N, fy = -10 N:\n\ntau2 = -7.917 Nm\n"
    );
    let found = read(&text, Format::Markdown, None);
    assert_eq!(all(&found, "tau2").first(), Some(&Standing::Wrong), "{:#?}", found.claims);
}

#[test]
fn joints_by_greek_letters_and_a_moment_in_numbers() {
    let text = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | φ1 | 0 | l1 | 0 |\n| 2 | φ2 | 0 | l2 | 0 |\n\nGelenkmomente:\n\nτ1 = -(l1 s1 + l2 s12) Fx + (l1 c1 + l2 c12) Fy + M\n\nl1 = 0,5 m, l2 = 0,4 m, Stellung φ1 = 0°, φ2 = 90°.\n\nMit Fx = 10 N, Fy = -20 N und M = 1,5 Nm:\n\nτ1 = -12,50 Nm\n";
    is(text, &[("τ1", &[Standing::Equal, Standing::Equal])]);
    is(&text.replace("-12,50", "-14,00"), &[("τ1", &[Standing::Equal, Standing::Wrong])]);
}

#[test]
fn a_helper_in_joints_keeps_what_it_is_by_the_pose() {
    let table = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | d1 | a1 | 90° |\n| 2 | θ2 | 0 | a2 | 0 |\n| 3 | θ3 | 0 | a3 | 0 |\n\n";
    let text = format!(
        "{table}r = sqrt(x² + y²) - a1\n\nh = z - d1\n\nThese are also r = a2 c2 + a3 c23 and h = a2 s2 + a3 s23.\n\nθ3 = ± acos((r² + h² - a2² - a3²)/(2 a2 a3))\n"
    );
    let found = read(&text, Format::Markdown, None);
    let joint = all(&found, "θ3");
    assert!(matches!(joint[..], [Standing::Equal | Standing::Conditional]), "{:#?}", found.claims);
}

#[test]
fn velocities_and_torques_of_programs() {
    let text = format!(
        "{TURRET}/* speed of the hand */\nvoid speed(double th1, double th2, double ext, double w1, double w2, double ve, double v[3])\n{{\n    double c1 = cos(th1), s1 = sin(th1), c2 = cos(th2), s2 = sin(th2);\n    double rho = A1 + ext*c2;\n    v[0] = -rho*s1*w1 - ext*c1*s2*w2 + c1*c2*ve;\n    v[1] =  rho*c1*w1 - ext*s1*s2*w2 + s1*c2*ve;\n    v[2] =  ext*c2*w2 + s2*ve;\n}}\n\ndouble detj(double th2, double ext)\n{{\n    return ext*(A1 + ext*cos(th2));\n}}\n\n/* tau = J^T f for a load (fx, fy, fz) */\nvoid hold(double th1, double th2, double ext, double fx, double fy, double fz, double tau[3])\n{{\n    double c1 = cos(th1), s1 = sin(th1), c2 = cos(th2), s2 = sin(th2);\n    tau[0] = (A1 + ext*c2)*(c1*fy - s1*fx);\n    tau[1] = ext*(c2*fz - s2*(c1*fx + s1*fy));\n    tau[2] = c1*c2*fx + s1*c2*fy + s2*fz;\n}}\n"
    );
    let right = [
        ("v[0]", RIGHT),
        ("v[1]", RIGHT),
        ("v[2]", RIGHT),
        ("detj(…)", RIGHT),
        ("tau[1]", RIGHT),
        ("tau[2]", RIGHT),
    ];
    is_program(&text, Dialect::C, &right);
    let wrong = text.replace("ext*c2*w2 + s2*ve", "ext*c2*w2 - s2*ve").replace("s2*fz;", "c2*fz;");
    is_program(&wrong, Dialect::C, &[("v[1]", RIGHT), ("v[2]", WRONG), ("tau[1]", RIGHT), ("tau[2]", WRONG)]);
}

const PLOTTER: &str = "/*\n *   Denavit-Hartenberg (standard), mm\n *   joint | theta | d | a | alpha\n *   1 | q1 | H | L1 | 0\n \
                       *   2 | q2 | 0 | L2 | 180\n *   3 | 0 | q3 | 0 | 0\n */\n#include <math.h>\n#define L1 180.0\n#define L2 140.0\n#define H 220.0\n\n";

#[test]
fn loops_blocks_and_determinants_of_c() {
    let text = format!(
        "{PLOTTER}void frame3(double q1, double q2, double q3, double T[4][4])\n{{\n    double c = cos(q1 + q2), s = sin(q1 + q2);\n    double M[4][4] = {{\n        {{ c,  s,  0, L1 * cos(q1) + L2 * c }},\n        {{ s, -c,  0, L1 * sin(q1) + L2 * s }},\n        {{ 0,  0, -1, H - q3 }},\n        {{ 0,  0,  0, 1 }}\n    }};\n    for (int i = 0; i < 4; i++)\n        for (int j = 0; j < 4; ++j)\n            T[i][j] = M[i][j];\n}}\n\nvoid jacobian(double q1, double q2, double J[2][2])\n{{\n    J[0][0] = -L1 * sin(q1) - L2 * sin(q1 + q2);\n    J[0][1] = -L2 * sin(q1 + q2);\n    J[1][0] = L1 * cos(q1) + L2 * cos(q1 + q2);\n    J[1][1] = L2 * cos(q1 + q2);\n}}\n\ndouble det_j(double q1, double q2)\n{{\n    return L1 * L2 * sin(q2);\n}}\n"
    );
    is_program(&text, Dialect::C, &[("det_j(…)", RIGHT)]);
    let found = read(&text, Format::Plain, Some(Dialect::C));
    assert!(found.claims.iter().all(|c| c.standing() == Standing::Equal), "{:#?}", found.claims);
    let of = |letter: &str, claims: &Checked| claims.claims.iter().any(|c| c.name.starts_with(letter));
    assert!(of("T", &found) && of("J", &found), "{:#?}", found.claims);
    let wrong = text.replace("J[1][1] = L2 * cos(q1 + q2)", "J[1][1] = L2 * cos(q2)");
    let found = read(&wrong, Format::Plain, Some(Dialect::C));
    assert!(found.claims.iter().any(|c| c.name.starts_with('J') && c.standing() == Standing::Wrong));
    // What a loop makes that is not read is not judged.
    let lost = text.replace("for (int i = 0; i < 4; i++)", "for (int i = 0; i < n(4); i++)");
    let found = read(&lost, Format::Plain, Some(Dialect::C));
    assert!(!of("T", &found), "{:#?}", found.claims);
}

#[test]
fn a_factor_of_a_root_is_a_sign() {
    let text = format!(
        "{PLOTTER}int inverse(double x, double y, double z, int left, double q[3])\n{{\n    double c2 = (x * x + y * y - L1 * L1 - L2 * L2) / (2 * L1 * L2);\n    double s2 = left * sqrt(1 - c2 * c2);\n    q[1] = atan2(s2, c2);\n    q[0] = atan2(y, x) - atan2(L2 * s2, L1 + L2 * c2);\n    q[2] = H - z;\n    return 1;\n}}\n"
    );
    let conditional: &[Standing] = &[Standing::Conditional];
    let found = read(&text, Format::Plain, Some(Dialect::C));
    for name in ["q[0]", "q[1]", "q[2]", "c2", "s2"] {
        let standing = all(&found, name);
        assert!(
            matches!(standing[..], [Standing::Equal | Standing::Conditional]),
            "{name} {standing:?} {conditional:?}\n{:#?}",
            found.claims
        );
    }
    let wrong = text.replace("L1 + L2 * c2)", "L1 - L2 * c2)");
    is_program(&wrong, Dialect::C, &[("q[0]", WRONG)]);
}

#[test]
fn rows_of_a_list_that_is_returned() {
    let text = "import numpy as np\n\n# DH, standard convention\nd1, a2, a3 = 0.069, 0.146, 0.187\n\n\ndef dh(theta, d, a, alpha):\n    ct, st = np.cos(theta), np.sin(theta)\n    ca, sa = np.cos(alpha), np.sin(alpha)\n    return np.array([[ct, -st*ca, st*sa, a*ct], [st, ct*ca, -ct*sa, a*st], [0.0, sa, ca, d], [0.0, 0.0, 0.0, 1.0]])\n\n\ndef table(q1, q2, q3):\n    #        theta          d    a    alpha\n    return [(q1,            d1,  0.0, np.pi/2),\n            (q2,            0.0, a2,  0.0),\n            (q3,            0.0, a3,  0.0)]\n\n\ndef fk(q):\n    q1, q2, q3 = q\n    r = a2*np.cos(q2) + a3*np.cos(q2 + q3)\n    x = r*np.cos(q1)\n    y = r*np.sin(q1)\n    z = d1 + a2*np.sin(q2) + a3*np.sin(q2 + q3)\n    return np.array([x, y, z])\n";
    let found = read(text, Format::Plain, Some(Dialect::Python));
    assert_eq!(found.robots[0].rows.len(), 3, "{:#?}", found.robots[0]);
    // The module of π is no letter.
    let letters: Vec<String> =
        found.robots[0].parameters.iter().map(|p| p.symbol.name().to_string()).collect();
    assert_eq!(letters, ["d1", "a2", "a3"]);
    assert!(found.claims.iter().all(|c| c.standing() != Standing::Wrong), "{:#?}", found.claims);
}

#[test]
fn components_of_an_axis_under_names_of_the_author() {
    let table = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | h | 0 | 90° |\n| 2 | θ2 + 90° | 0 | 0 | 90° |\n| 3 | 0 | d3 | 0 | 0 |\n\nThe direction of the beam is\n\n";
    let text = format!("{table}ux = cos θ1 cos θ2\n\nuy = sin θ1 cos θ2\n\nuz = sin θ2\n");
    is(&text, &[("ux", RIGHT), ("uy", RIGHT), ("uz", RIGHT)]);
    is(&text.replace("uz = sin", "uz = cos"), &[("ux", RIGHT), ("uy", RIGHT), ("uz", WRONG)]);
    // One of three says nothing.
    is(&text.replace("uz = sin θ2", "uz = 2").replace("uy = sin", "uy = cos"), &[("ux", &[]), ("uy", &[])]);
}

#[test]
fn a_velocity_with_one_slip() {
    let table = "| i | α(i−1) | a(i−1) | d(i) | θ(i) |\n|---|---|---|---|---|\n| 1 | 0 | 0 | 0 | θ1 |\n| 2 | 90° | 0 | d2 | 0 |\n| 3 | 0 | 0 | L2 | θ3 |\n\nCraig's convention. Joint rates: w1 for θ1, u2 for d2 and w3 for θ3.\n\n";
    let text = format!("{table}- v3 in frame 3: v3 = (c3*(d2 + L2)*w1, -s3*(d2 + L2)*w1, u2)\n");
    is(&text, &[("v3", RIGHT)]);
    is(&text.replace("-s3*", "s3*"), &[("v3", WRONG)]);
}
