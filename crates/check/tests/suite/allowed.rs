//! What differs from the robot's formula and is right all the same, other values of a joint, parts of Jacobians, and programs that go
//! by vectors and matrices.

use denavit_check::{CheckOptions, Checked, Condition, Finding, Standing, check};
use denavit_reading::code::Dialect;
use denavit_reading::document::Format;

fn read(text: &str, format: Format, language: Option<Dialect>) -> Checked {
    let options = CheckOptions { language, ..CheckOptions::default() };
    check(text, format, None, &options).unwrap_or_else(|e| panic!("{e:?}\n{text}"))
}

fn all(checked: &Checked) -> Vec<(&str, Standing)> {
    checked.claims.iter().map(|c| (c.name.as_str(), c.standing())).collect()
}

#[track_caller]
fn standing(checked: &Checked, name: &str) -> Standing {
    let claim = checked.claims.iter().find(|c| c.name == name);
    claim.unwrap_or_else(|| panic!("no claim about {name}: {:?}", all(checked))).standing()
}

const TILTED: &str = "Standard DH\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 120 | 0 | 60° |\n\
                      | 2 | θ2 | 250 | 80 | 0 |\n\n";

#[test]
fn rounded_numbers_are_right_in_numbers() {
    let text = |n: &str| format!("{TILTED}x = 80 (c1 c2 - 0.5 s1 s2) + {n} s1\n");
    let found = read(&text("216.5"), Format::Markdown, None);
    assert_eq!(all(&found), [("x", Standing::Equal)]);
    // 125 √3 is 216.506…: that is no proof, and what is farther off is wrong.
    assert!(!found.claims[0].is_proved());
    for far in ["216.7", "215.5", "-216.5", "216"] {
        assert_eq!(all(&read(&text(far), Format::Markdown, None)), [("x", Standing::Wrong)], "{far}");
    }
}

const PLANAR: &str = "Standard DH\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | l1 | 0 |\n\
                      | 2 | θ2 | 0 | 0 | 90° |\n| 3 | 0 | d3 | 0 | 0 |\n\n";

#[test]
fn rates_while_a_joint_is_locked() {
    let text = |said: &str, sign: &str| {
        format!(
            "{PLANAR}$x = l_1 c_1 + d_3 s_{{12}}$\n\n{said}\n\n$$\\dot\\theta_2 = (c_{{12}} v_x {sign} s_{{12}} v_y)/d_3$$\n"
        )
    };
    let name = "\\dot\\theta_2";
    let found = read(&text("In this mode the shoulder is locked:", "+"), Format::Markdown, None);
    assert_eq!(standing(&found, name), Standing::Conditional);
    let claim = found.claims.iter().find(|c| c.name == name).unwrap();
    assert!(matches!(claim.entries[0].finding, Finding::Conditional { condition: Condition::Locked, .. }));
    // With the wrong sign, or where nothing is said to be locked, it is wrong.
    for (said, sign) in [("The shoulder is locked:", "-"), ("Then", "+")] {
        assert_eq!(
            standing(&read(&text(said, sign), Format::Markdown, None), name),
            Standing::Wrong,
            "{said}"
        );
    }
}

#[test]
fn the_base_as_the_hand_sees_it() {
    let text = |sign: &str| {
        format!(
            "Standard DH\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | a1 | 0 |\n| 2 | θ2 | 0 | a2 | 0 |\n\n\
             The position in the inverse of T02 is\n\n$x = -a_2 {sign} a_1 c_2$\n\n$y = a_1 s_2$\n"
        )
    };
    assert_eq!(
        all(&read(&text("-"), Format::Markdown, None)),
        [("x", Standing::Equal), ("y", Standing::Equal)]
    );
    assert_eq!(standing(&read(&text("+"), Format::Markdown, None), "x"), Standing::Wrong);
}

const ELBOW: &str = "Standard DH\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | d1 | 0 | 90° |\n\
                     | 2 | θ2 | 0 | a2 | 0 |\n| 3 | θ3 | 0 | a3 | 0 |\n\n";

#[test]
fn half_a_turn_is_another_value() {
    for other in ["$\\theta_1' = \\theta_1 + \\pi$", "$\\theta_1 = \\theta_1 + 180°$"] {
        let found = read(
            &format!("{ELBOW}$\\theta_1 = \\operatorname{{atan2}}(p_y, p_x)$ and {other}.\n"),
            Format::Markdown,
            None,
        );
        assert!(found.claims.len() == 2 && found.tally().wrong == 0, "{:?}", all(&found));
        let found = read(
            &format!("{ELBOW}$\\theta_1 = \\operatorname{{atan2}}(-p_y, p_x)$ and {other}.\n"),
            Format::Markdown,
            None,
        );
        assert_eq!(found.tally().wrong, 2, "{:?}", all(&found));
    }
    // Alone it says nothing of the robot, and is listed.
    let found = read(&format!("{ELBOW}and $\\theta_1 = \\theta_1 + \\pi$\n"), Format::Markdown, None);
    assert!(found.claims.is_empty() && found.unjudged.len() == 1, "{:?}", all(&found));
}

#[test]
fn joints_that_keep_the_hand_level() {
    let found = read(
        &format!("{ELBOW}Keeping the hand level means $\\theta_3 = -\\theta_2$.\n"),
        Format::Markdown,
        None,
    );
    assert_eq!((found.tally().wrong, found.unjudged.len()), (0, 1), "{:?}", all(&found));
}

#[test]
fn determinants_of_columns() {
    let table = "Standard DH\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | a1 | 0 |\n\
                 | 2 | θ2 | 0 | a2 | 0 |\n| 3 | θ3 | 0 | a3 | 0 |\n\n";
    let text = |printed: &str| {
        format!(
            "{table}$$\\det[J_2\\;J_3] = {printed}$$\n\n$\\det J_{{12}} = a_1 a_2 s_2 + a_1 a_3 s_{{23}}$\n"
        )
    };
    let found = read(&text("a_2 a_3 s_3"), Format::Markdown, None);
    assert_eq!(found.tally().equal, 2, "{:?}", all(&found));
    let found = read(&text("a_2 a_3 c_3"), Format::Markdown, None);
    assert_eq!((found.tally().equal, found.tally().wrong), (1, 1), "{:?}", all(&found));
}

/// A wrist that is found by vectors, matrices and indices.
fn decoupled(quadrant: &str, wrist: &str) -> String {
    format!(
        "% standard DH\n%  i  theta  d   a   alpha\n%  1  q1     d1  0    90\n%  2  q2     0   a2   0\n%  3  q3     0   0    90\n\
         %  4  q4     d4  0   -90\n%  5  q5     0   0    90\n%  6  q6     d6  0    0\n\n\
         function q = solve(T, L)\nd1 = L.d1; a2 = L.a2; d4 = L.d4; d6 = L.d6;\nR = T(1:3,1:3);\np = T(1:3,4);\n\
         pc = p - d6*R(:,3);\nq1 = atan2({quadrant});\nr = sqrt(pc(1)^2 + pc(2)^2);\ns = pc(3) - d1;\n\
         S3 = (r^2 + s^2 - a2^2 - d4^2)/(2*a2*d4);\nfor k = [1 -1]\n  q3 = atan2(S3, k*sqrt(1 - S3^2));\n\
         \x20 q2 = atan2(s, r) + atan2(d4*cos(q3), a2 + d4*sin(q3));\nend\n\
         R03 = [cos(q1)*cos(q2+q3), sin(q1), cos(q1)*sin(q2+q3); sin(q1)*cos(q2+q3), -cos(q1), sin(q1)*sin(q2+q3); sin(q2+q3), 0, -cos(q2+q3)];\n\
         R36 = R03' * R;\nq5 = atan2(sqrt(R36(1,3)^2 + R36(2,3)^2), R36(3,3));\n{wrist};\nq6 = atan2(R36(3,2), -R36(3,1));\nend\n"
    )
}

#[test]
fn programs_by_vectors_and_matrices() {
    let right = decoupled("pc(2), pc(1)", "q4 = atan2(R36(2,3), R36(1,3))");
    let found = read(&right, Format::Plain, Some(Dialect::Matlab));
    for name in ["pc", "R03", "R36", "q1", "r", "s", "S3", "q3", "q2", "q5", "q4", "q6"] {
        let standing = standing(&found, name);
        assert!(matches!(standing, Standing::Equal | Standing::Conditional), "{name}: {standing:?}");
    }
    let wrong = decoupled("pc(1), pc(2)", "q4 = atan2(R36(1,3), R36(2,3))");
    let found = read(&wrong, Format::Plain, Some(Dialect::Matlab));
    for name in ["q1", "q4"] {
        assert_eq!(standing(&found, name), Standing::Wrong, "{name}");
    }
    assert_eq!(standing(&found, "q5"), standing(&read(&right, Format::Plain, Some(Dialect::Matlab)), "q5"));
}

#[test]
fn programs_with_the_pitch_and_a_choice() {
    let text = |sign: &str| {
        format!(
            "# standard DH\n#  i  theta  d   a   alpha\n#  1  q1     d1  0   90\n#  2  q2     0   a2  0\n#  3  q3     0   a3  0\n\
             #  4  q4     0   a4  0\nfrom math import *\n\ndef solve(x, y, z, pitch, up):\n    q1 = atan2(y, x)\n\
             \x20   r = hypot(x, y) - a4*cos(pitch)\n    h = z - d1 - a4*sin(pitch)\n\
             \x20   c3 = (r**2 + h**2 - a2**2 - a3**2)/(2*a2*a3)\n    q3 = -acos(max(-1, min(1, c3))) if up else acos(c3)\n\
             \x20   q2 = atan2(h, r) - atan2(a3*sin(q3), a2 + a3*cos(q3))\n    q4 = pitch - q2 {sign} q3\n    return q1, q2, q3, q4\n"
        )
    };
    let found = read(&text("-"), Format::Plain, Some(Dialect::Python));
    assert_eq!(found.tally().wrong, 0, "{:?}", all(&found));
    for name in ["q1", "q2", "q3", "q4"] {
        assert!(matches!(standing(&found, name), Standing::Equal | Standing::Conditional), "{name}");
    }
    let found = read(&text("+"), Format::Plain, Some(Dialect::Python));
    assert_eq!(standing(&found, "q4"), Standing::Wrong);
}

#[test]
fn words_of_other_languages_and_units() {
    let table = "DH classique\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | q1 | h | 0 | 90° |\n| 2 | 0 | q2 | 0 | 0 |\n\n";
    let found = read(&format!("{table}q2 = racine(px² + py²)\n"), Format::Markdown, None);
    assert_eq!((found.claims.len(), found.tally().wrong), (1, 0), "{:?}", all(&found));
    let text = "Standard DH\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | 0.4 | 0 |\n| 2 | θ2 | 0 | 0.3 | 0 |\n\n\
                For $\\theta_1 = 30^\\circ$, $\\theta_2 = 60^\\circ$:\n\n$$p_x = 0.346\\ \\mathrm{m}$$\n\n$$p_y = 0.400\\ \\mathrm{m}$$\n";
    let found = read(text, Format::Markdown, None);
    assert_eq!(all(&found), [("p_x", Standing::Equal), ("p_y", Standing::Wrong)]);
}

const POLAR: &str = "Standard DH\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | h | 0 | -90° |\n\
                     | 2 | θ2 | 0 | 0 | 90° |\n| 3 | 0 | d3 | 0 | 0 |\n\n";

#[test]
fn forces_along_the_axes_of_the_hand() {
    let text = |second: &str, third: &str| {
        format!(
            "{POLAR}A force $f = (f_x, f_y, f_z)$ in the hand's own frame is balanced by the torques\n\n\
             $\\tau_1 = d_3 s_2 f_y$\n\n$\\tau_2 = {second}$\n\n$\\tau_3 = {third}$\n"
        )
    };
    let found = read(&text("d_3 f_x", "f_z"), Format::Markdown, None);
    let right = ["\\tau_1", "\\tau_2", "\\tau_3"].map(|n| (n, Standing::Equal));
    assert_eq!(all(&found), right);
    // A slip in one is wrong all the same.
    let found = read(&text("d_3 f_z", "f_z"), Format::Markdown, None);
    assert_eq!(standing(&found, "\\tau_2"), Standing::Wrong);
}

#[test]
fn formulas_at_a_configuration_of_their_own_sentence() {
    let text = |x: &str| {
        format!(
            "{PLANAR}The hand is at\n\n$x_h = l_1 c_1 + d_3 s_{{12}}$\n\n$y_h = l_1 s_1 - d_3 c_{{12}}$\n\n\
             At rest, $\\theta_1 = \\theta_2 = 0$, it is at $x_h = {x}$.\n"
        )
    };
    let last = |x: &str| {
        read(&text(x), Format::Markdown, None).claims.last().map(|c| (c.name.clone(), c.standing()))
    };
    assert_eq!(last("l_1"), Some(("x_h".into(), Standing::Equal)));
    assert_ne!(last("l_1 + d_3"), Some(("x_h".into(), Standing::Equal)));
}
