//! Ways of writing that are met in the wild: names behind formulas, labels before them, joints from 0 on, brackets of programs on
//! lines of their own, frames of tables, and numbers that belong to a goal.

use denavit_check::{About, CheckOptions, Checked, Finding, Standing, check};
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
fn is(text: &str, expected: &[(&str, Standing)]) {
    let found = read(text, Format::Markdown, None);
    for (name, standing) in expected {
        let said: Vec<&Standing> = expected.iter().filter(|e| e.0 == *name).map(|e| &e.1).collect();
        assert_eq!(
            all(&found, name).iter().collect::<Vec<_>>(),
            said,
            "{name} {standing:?}\n{text}\n{:?}",
            found.claims
        );
    }
}

const PLANAR: &str = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | a1 | 0 |\n\
                      | 2 | θ2 | 0 | a2 | 0 |\n\n";

#[test]
fn arguments_of_arctangents() {
    let half = "D = (px² + py² − a1² − a2²)/(2 a1 a2)\n\nu = ±sqrt((1 − D)/(1 + D))\n\n";
    for value in ["2 arctan u", "2 arctan(u)", "2 atan2(u; 1)"] {
        let found = read(&format!("{PLANAR}{half}θ2 = {value}\n"), Format::Markdown, None);
        assert_eq!(all(&found, "θ2"), [Standing::Conditional], "{value}: {:?}", found.claims);
    }
}

#[test]
fn a_name_behind_a_formula() {
    let text = "$$\\cos\\theta_2 = \\frac{p_x^2+p_y^2-a_1^2-a_2^2}{2a_1a_2} =: D$$\n\n$$\\theta_2 = \\operatorname{atan2}(\\pm\\sqrt{1-D^2}, D)$$";
    is(&format!("{PLANAR}{text}\n"), &[("\\cos\\theta_2", Standing::Equal), ("\\theta_2", Standing::Equal)]);
}

#[test]
fn the_end_of_a_difference_is_given_no_value() {
    let text = "a1 = 0.5 m, a2 = 0.3 m.\n\nThe largest radius is a1 + a2 = 0.80 m and the smallest radius a1 − a2 = 0.20 m.\n";
    is(&format!("{PLANAR}{text}"), &[("a1 + a2", Standing::Equal), ("a1 − a2", Standing::Equal)]);
    let wrong = text.replace("0.20", "0.25");
    is(&format!("{PLANAR}{wrong}"), &[("a1 + a2", Standing::Equal), ("a1 − a2", Standing::Wrong)]);
}

#[test]
fn configurations_behind_words_and_labels() {
    let numbers = "a1 = 0.5 m, a2 = 0.3 m.\n\n";
    for words in
        ["Bei θ1 = 30°, θ2 = 60° gilt", "*Example.* θ1 = 30°, θ2 = 60°:", "**Beispiel.** θ1 = 30°, θ2 = 60°:"]
    {
        is(
            &format!("{PLANAR}{numbers}{words}\n\nx = 0.433 m\n\ny = 0.550 m\n"),
            &[("x", Standing::Equal), ("y", Standing::Equal)],
        );
    }
    is(&format!("{PLANAR}{numbers}In der Nullstellung ist\n\nx = 0.8 m\n"), &[("x", Standing::Equal)]);
}

/// Coordinates of the elbow are right where the hand's own stand beside them, and the hand's without its last link where they do not.
#[test]
fn coordinates_of_another_point() {
    let numbers = "a1 = 0.5 m, a2 = 0.3 m.\n\nAt θ1 = 30°, θ2 = 30°:\n\n";
    let hand = "x = 0.583 m\n\ny = 0.510 m\n\n";
    let pin = "The pin is at x = 0.433 m, y = 0.250 m.\n";
    let both = [Standing::Equal, Standing::Equal];
    let found = read(&format!("{PLANAR}{numbers}{hand}{pin}"), Format::Markdown, None);
    assert_eq!((all(&found, "x"), all(&found, "y")), (both.to_vec(), both.to_vec()), "{:?}", found.claims);
    let found = read(&format!("{PLANAR}{numbers}{pin}"), Format::Markdown, None);
    assert_eq!((all(&found, "x"), all(&found, "y")), (vec![Standing::Wrong], vec![Standing::Wrong]));
}

#[test]
fn joints_that_are_counted_from_zero() {
    let table = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | q0 | 0 | a1 | 0 |\n| 2 | q1 | 0 | a2 | 0 |\n\n";
    is(
        &format!("{table}x = a1*cos(q0) + a2*cos(q0 + q1)\n\ny = a1*sin(q1) + a2*sin(q0 + q1)\n"),
        &[("x", Standing::Equal), ("y", Standing::Wrong)],
    );
}

#[test]
fn tables_with_rules_and_remarks() {
    let ruled = "Craig's convention:\n\n    i | alpha_{i-1} | a_{i-1} | d_i | theta_i\n    --+-------------+---------+-----+--------\n    1 |      0      |    0    |  0  | θ1\n    2 |      0      |    L1   |  0  | θ2\n    3 |      0      |    L2   |  0  | 0\n\nx = L1 c1 + L2 c12\n";
    is(ruled, &[("x", Standing::Equal)]);
    let remark = "\\begin{tabular}{lcccc}\n\\multicolumn{5}{c}{Standard DH}\\\\\nLink & $a_i$ & $\\alpha_i$ & $d_i$ & $\\theta_i$\\\\\n1 & $a_1$ & 0 & 0 & $\\theta_1^*$\\\\\n2 & $a_2$ & 0 & 0 & $\\theta_2^*$\\\\\n\\multicolumn{5}{l}{${}^*$ joint variable}\n\\end{tabular}\n\nStandard convention.\n\\[ x = a_1 c_1 + a_2 c_{12} \\]\n";
    let found = read(remark, Format::Latex, None);
    assert_eq!(all(&found, "x"), [Standing::Equal], "{:?}", found.claims);
}

#[test]
fn velocities_of_links_and_screws_by_their_names() {
    let table = "Craig's convention\n\n| i | α_{i-1} | a_{i-1} | d_i | θ_i |\n|---|---|---|---|---|\n| 1 | 0 | 0 | 0 | θ1 |\n| 2 | 0 | L1 | 0 | θ2 |\n| 3 | 0 | L2 | 0 | 0 |\n\n";
    let column =
        |name: &str, cells: &str| format!("$${name} = \\begin{{bmatrix}}{cells}\\end{{bmatrix}}$$\n\n");
    let text = column("{}^1\\omega_1", "0\\\\0\\\\\\dot\\theta_1")
        + &column("{}^1v_1", "0\\\\0\\\\0")
        + &column("{}^2v_2", "L_1 s_2\\dot\\theta_1\\\\L_1 s_2\\dot\\theta_1\\\\0")
        + "$${}^3\\omega_3 = {}^2\\omega_2$$\n\nThe screws are ξ_1 = (0, 0, 0, 0, 0, 1) and ξ_2 = (0, -L1, 0, 0, 0, 1).\n";
    is(
        &format!("{table}{text}"),
        &[
            ("{}^1\\omega_1", Standing::Equal),
            ("{}^1v_1", Standing::Equal),
            ("{}^2v_2", Standing::Wrong),
            ("{}^3\\omega_3", Standing::Equal),
            ("ξ_1", Standing::Equal),
            ("ξ_2", Standing::Equal),
        ],
    );
}

#[test]
fn tables_of_solutions_with_the_joints_below_one_another() {
    let table = "Standard DH:\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | 0.5 | 0 |\n| 2 | θ2 | 0 | 0.3 | 0 |\n\n";
    let text = |y: &str, second: &str| {
        format!(
            "{table}# Inverse kinematics\n\nThe point to reach is\n\nx = 0.433 m\n\ny = {y} m\n\nSolutions in degrees:\n\n| | A | B |\n|---|---|---|\n| θ1 | 30.0 | 73.6 |\n| θ2 | 60.0 | {second} |\n"
        )
    };
    let standings = |text: &str| -> Vec<Standing> {
        let found = read(text, Format::Markdown, None);
        let rows = found.claims.iter().filter(|c| c.about == About::Configuration);
        rows.map(|c| c.standing()).collect()
    };
    assert_eq!(standings(&text("0.550", "-60.0")), [Standing::Equal; 2]);
    assert_eq!(standings(&text("0.550", "60.0")), [Standing::Equal, Standing::Wrong]);
    // No column fits: each row is said to be undecided.
    assert_eq!(standings(&text("9.9", "-60.0")), [Standing::Undecided; 2]);
}

#[test]
fn torques_and_numbers_are_no_goals() {
    let table = "Standard DH, h = 0.3 m:\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | q1 | h | 0 | 0 |\n| 2 | 0 | q2 | 0 | -90 |\n| 3 | 0 | q3 | 0 | 0 |\n\n";
    let text = "## Inverse kinematics\n\nq2 = pz - h\n\n## Statics, for a force (Fx, Fy, Fz) that the hand exerts\n\nf2 = Fz\n\ntau1 = -q3*(cos(q1)*Fx + sin(q1)*Fy)\n\nq1 = 40 deg, q2 = 0.25 m, q3 = 0.6 m.\n\nF = (10, -20, 30) N\n\nf2 = 31 N\n";
    is(&format!("{table}{text}"), &[("f2", Standing::Equal), ("f2", Standing::Wrong)]);
}

#[test]
fn part_of_the_joints_for_part_of_a_pose() {
    let scara = "Standard DH, lengths in m\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | 0.5 | 0 |\n| 2 | θ2 | 0 | 0.3 | 180° |\n| 3 | 0 | d3 | 0 | 0 |\n\n";
    let text = |second: &str| {
        format!("{scara}# Inverse kinematics\n\nx = 0.433 m\n\ny = 0.550 m\n\nθ1 = 30.0°\n\nθ2 = {second}\n")
    };
    is(&text("60.0°"), &[("θ1", Standing::Equal), ("θ2", Standing::Equal)]);
    is(&text("66.0°"), &[("θ1", Standing::Equal), ("θ2", Standing::Wrong)]);
}

#[test]
fn distances_are_what_they_are() {
    let text = |sign: &str| format!("{PLANAR}ρ = sqrt(a1² + a2² {sign} 2 a1 a2 cos θ2)\n");
    is(&text("+"), &[("ρ", Standing::Equal)]);
    let wrong = read(&text("-"), Format::Markdown, None);
    assert!(all(&wrong, "ρ").is_empty() && wrong.unjudged.len() == 1, "{:?}", wrong.claims);
}

#[test]
fn a_rate_in_other_rates_says_how_to_move() {
    let found = read(
        &format!("{PLANAR}$$\\dot\\theta_2 = -2\\dot\\theta_1$$\n\n$$v_x = 0$$\n"),
        Format::Markdown,
        None,
    );
    assert!(all(&found, "\\dot\\theta_2").is_empty() && !found.unjudged.is_empty(), "{:?}", found.claims);
}

#[test]
fn entries_of_a_rotation_under_its_own_letter() {
    let wrist = "Standard DH\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | d1 | 0 | 90° |\n| 2 | θ2 | 0 | a2 | 0 |\n| 3 | θ3 | 0 | 0 | 90° |\n| 4 | θ4 | d4 | 0 | -90° |\n| 5 | θ5 | 0 | 0 | 90° |\n| 6 | θ6 | d6 | 0 | 0 |\n\n";
    let text = |a: &str| {
        format!(
            "{wrist}Let $N = ({{}}^0R_3)^T\\,{{}}^0R_6$ with the elements $n_{{ij}}$.\n\n$$\\theta_5 = \\operatorname{{atan2}}(\\pm\\sqrt{{n_{{13}}^2+n_{{23}}^2}}, {a})$$\n\n$$\\cos\\theta_5 = n_{{33}}$$\n"
        )
    };
    let right = read(&text("n_{33}"), Format::Markdown, None);
    assert_eq!(all(&right, "\\theta_5"), [Standing::Equal], "{:?}", right.claims);
    assert_eq!(all(&right, "\\cos\\theta_5"), [Standing::Equal], "{:?}", right.claims);
    let wrong = read(&text("-n_{33}"), Format::Markdown, None);
    assert_eq!(all(&wrong, "\\theta_5"), [Standing::Wrong], "{:?}", wrong.claims);
}

#[test]
fn programs_in_their_own_ways() {
    let c = "/* DH (standard):\n *  i | theta | d | a | alpha\n *  1 | q0    | H | 0 | 90\n *  2 | q1    | 0 | A | 0\n *  3 | q2    | 0 | B | 0\n */\nstatic const double H = 77.0, A = 130.0, B = 124.0;\n\nvoid forward(double q0, double q1, double q2, double *px)\n{\n    double rad = A*cos(q1) + B*cos(q1 + q2);\n    double x = rad*cos(q0);\n    *px = x;\n}\n\nint inverse(double x, double y, double z, int elbow, double *q)\n{\n    double r = sqrt(x*x + y*y);\n    double h = z - H;\n    double c = (r*r + h*h - A*A - B*B)/(2*A*B);\n    double q2 = elbow*acos(c);\n    double q1 = atan2(h, r) - atan2(B*sin(q2), A + B*cos(q2));\n    return 0;\n}\n";
    let found = read(c, Format::Plain, Some(Dialect::C));
    assert_eq!(all(&found, "x"), [Standing::Equal], "{:?}", found.claims);
    assert_eq!(all(&found, "q2"), [Standing::Equal], "{:?}", found.claims);
    assert_ne!(all(&found, "q1"), [Standing::Wrong], "{:?}", found.claims);
    let wrong = read(&c.replace("2*A*B);", "2*A*A);"), Format::Plain, Some(Dialect::C));
    assert_eq!(all(&wrong, "q2"), [Standing::Wrong], "{:?}", wrong.claims);

    let python = "# DH (standard): theta d a alpha\n# 1: q1, 0, l1, 0\n# 2: q2, 0, l2, 0\n# 3: q3, 0, l3, 0\nimport numpy as np\nl1, l2, l3 = 0.5, 0.4, 0.2\n\ndef ik(x, y, gam, e=1):\n    xw = x - l3*np.cos(gam)\n    yw = y - l3*np.sin(gam)\n    c2 = (xw**2 + yw**2 - l1**2 - l2**2) / (2*l1*l2)\n    s2 = e*np.sqrt(1 - c2**2)\n    q2 = np.arctan2(s2, c2)\n    q1 = np.arctan2(yw, xw) - np.arctan2(l2*s2, l1 + l2*c2)\n    q3 = gam - q1 - q2\n    return q1, q2, q3\n\n# statics: the torques for a force (fx, fy) at the tip\ntau3 = l3*(-np.sin(q1 + q2 + q3)*fx + np.cos(q1 + q2 + q3)*fy)\n";
    let found = read(python, Format::Plain, Some(Dialect::Python));
    for name in ["q2", "q1", "q3", "xw", "c2", "tau3"] {
        let said = all(&found, name);
        assert!(!said.is_empty() && !said.contains(&Standing::Wrong), "{name}: {:?}", found.claims);
    }
    let wrong = read(&python.replace("gam - q1 - q2", "gam - q1 + q2"), Format::Plain, Some(Dialect::Python));
    assert_eq!(all(&wrong, "q3"), [Standing::Wrong], "{:?}", wrong.claims);
}

#[test]
fn what_the_pose_gives_is_given_where_it_is_solved_for() {
    // The wrong forward line is one thing, the inverse formula that is right by the name's meaning another.
    let text = "z = a1 sin θ2\n\nθ1 = atan2(py, px) − atan2(a2 sin θ2, a1 + a2 cos θ2)\n";
    let found = read(&format!("{PLANAR}{text}"), Format::Markdown, None);
    assert_ne!(all(&found, "θ1"), [Standing::Wrong], "{:?}", found.claims);
    assert!(found.claims.iter().all(|c| !matches!(c.entries[0].finding, Finding::Carried { .. })));
}
