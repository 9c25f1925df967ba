//! What strangers write in their own ways: remarks behind rows, joints with names of their own, tools in words, loads that are held.

use denavit_check::{CheckOptions, Checked, Noted, Sense, Standing, check};
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

/// Each of the formulas is right, and wrong with another sign before it.
fn holds(text: &str, names_and_formulas: &[(&str, &str)]) {
    for (name, formula) in names_and_formulas {
        assert!(text.contains(formula), "{formula} in {text}");
        for (sign, expected) in [("", Standing::Equal), ("-", Standing::Wrong)] {
            let found = read(&text.replace(formula, &format!("{sign}{formula}")), Format::Plain, None);
            assert_eq!(all(&found, name).last(), Some(&expected), "{name}: {text}\n{:?}", found.claims);
        }
    }
}

fn senses(checked: &Checked) -> Vec<Sense> {
    let senses = checked.notes.iter().filter_map(|n| match &n.what {
        Noted::Reading(sense) => Some(sense.clone()),
        _ => None,
    });
    senses.collect()
}

const PLANAR: &str = "DH (standard)   theta   d   a    alpha\n  1             th1     0   L1   0\n  2             th2     0   L2   0      ";

#[test]
fn a_remark_behind_a_row_is_none_of_its_cells() {
    for remark in ["(m)", "(L1 = 0.4 m)", "[mm, deg]", ""] {
        holds(&format!("{PLANAR}{remark}\n\n  x = L1*cos(th1) + L2*cos(th1+th2)\n"), &[("x", "L1*cos(th1)")]);
    }
}

#[test]
fn joints_with_names_of_their_own() {
    let table = "Standard DH:\n\n  i   theta      d     a   alpha\n  1   pan        H     E   +90\n  2   tilt + 90  0     0   +90\n  3   0          rho   0   0\n\n";
    let text = format!("{table}H = 0.31 m\n\nz = H + rho*sin(tilt)\n");
    holds(&text, &[("z", "rho*sin(tilt)")]);
}

#[test]
fn lengths_are_in_the_unit_that_is_the_only_one() {
    let table = "DH (standard)\n\njoint   theta   d   a    alpha\n1       th1     0   300  0\n2       th2     0   200  0\n\n";
    let text = format!(
        "{table}th1 = 40 deg, th2 = 75 deg:\n  x = 145.3 mm\n\n  det J = 300*200*sin(75) = 57956 mm^2\n"
    );
    let found = read(&text, Format::Plain, None);
    assert_eq!(all(&found, "x"), [Standing::Equal], "{:?}", found.claims);
    assert_eq!(all(&found, "det J"), [Standing::Equal], "{:?}", found.claims);
    let found = read(&text.replace("57956", "59756"), Format::Plain, None);
    assert_eq!(all(&found, "det J"), [Standing::Wrong], "{:?}", found.claims);
}

#[test]
fn a_tool_that_only_formulas_have() {
    let text = format!(
        "{PLANAR}\n\nx = L1*cos(th1) + L2*cos(th1+th2) + e*cos(th1+th2)\n\ny = L1*sin(th1) + L2*sin(th1+th2) + e*sin(th1+th2)\n\nz = 0\n"
    );
    let found = read(&text, Format::Plain, None);
    assert_eq!((all(&found, "x"), all(&found, "y")), (vec![Standing::Equal], vec![Standing::Equal]));
    assert!(senses(&found).iter().any(|s| matches!(s, Sense::Tool { .. })), "{:?}", found.notes);
    // One of the two with a slip: the other alone does not vouch for a tool.
    let found = read(&text.replace("e*sin(th1+th2)", "e*cos(th1+th2)"), Format::Plain, None);
    assert!(!all(&found, "y").contains(&Standing::Equal), "{:?}", found.claims);
}

#[test]
fn torques_that_hold_a_load() {
    let load = "A weight F = (0, -W) hangs at the tip. The torques that hold it are\n\n";
    let right = "τ1 = W*(L1*cos(th1) + L2*cos(th1+th2))\n\nτ2 = W*L2*cos(th1+th2)\n";
    let found = read(&format!("{PLANAR}\n\n{load}{right}"), Format::Plain, None);
    assert_eq!((all(&found, "τ1"), all(&found, "τ2")), (vec![Standing::Equal], vec![Standing::Equal]));
    assert!(senses(&found).contains(&Sense::AgainstLoad), "{:?}", found.notes);
    // One sign alone is a slip.
    let found = read(&format!("{PLANAR}\n\n{load}{}", right.replace("τ2 = ", "τ2 = -")), Format::Plain, None);
    let wrong = [all(&found, "τ1"), all(&found, "τ2")].concat();
    assert_eq!(wrong.iter().filter(|s| **s == Standing::Wrong).count(), 1, "{:?}", found.claims);
}

#[test]
fn derivatives_of_coordinates() {
    let derivatives =
        "dx/dth1 = L1*cos(th1)*0 - L1*sin(th1) - L2*sin(th1+th2)\n\n∂y/∂th2 = L2*cos(th1+th2)\n";
    let text = format!("{PLANAR}\n\n{derivatives}");
    holds(&text, &[("∂y/∂th2", "L2*cos(th1+th2)")]);
    let found = read(&text, Format::Plain, None);
    assert_eq!(all(&found, "dx/dth1"), [Standing::Equal], "{:?}", found.claims);
    let sentence = format!("{PLANAR}\n\nHence ∂x/∂th2 = -L2*sin(th1+th2), as expected.\n");
    assert!(read(&sentence, Format::Plain, None).claims.iter().all(|c| c.standing() == Standing::Equal));
}

#[test]
fn vectors_with_a_unit_behind_them() {
    let text = "DH (standard), lengths in metres\n\n  i   theta   d   a     alpha\n  1   th1     0   0.5   0\n  2   th2     0   0.35  0\n\nAt th1 = 30°, th2 = 60° the tip is at p = (0.4330, 0.6000) m\n";
    let found = read(text, Format::Plain, None);
    assert_eq!(all(&found, "p"), [Standing::Equal], "{:?}", found.claims);
    let found = read(&text.replace("0.6000", "0.6400"), Format::Plain, None);
    assert!(!all(&found, "p").contains(&Standing::Equal), "{:?}", found.claims);
}

#[test]
fn matrices_as_interpreters_show_them() {
    let table = "Standard DH, lengths in metres\n\n  i   theta   d      a      alpha\n  1   q1      0.35   0.1    90 deg\n  2   q2      0      0.3    0\n  3   q3      0      0.25   0\n\n";
    let text = format!(
        "{table}>> qn = [0.2 0.6 -0.9];\n>> T = arm.fkine(qn)\nT =\n    0.9363    0.2896    0.1987    0.5747\n    0.1898    0.0587   -0.9801    0.1165\n   -0.2955    0.9553         0    0.4455\n         0         0         0    1.0000\n\n"
    );
    let found = read(&text, Format::Plain, None);
    assert_eq!(all(&found, "T").last(), Some(&Standing::Equal), "{:?}", found.claims);
    let found = read(&text.replace("0.5747", "0.5477"), Format::Plain, None);
    assert_eq!(all(&found, "T").last(), Some(&Standing::Wrong), "{:?}", found.claims);
}

#[test]
fn members_with_the_names_of_joints_and_determinants() {
    let text = "// Standard DH\n//   i   theta   d     a   alpha\n//   1   pan     0     0   90\n//   2   tilt    0     L   0\n\
                double height(state q)\n{\n    double z = L*sin(q.tilt);\n    return z;\n}\n";
    let found = read(text, Format::Plain, Some(Dialect::C));
    assert_eq!(all(&found, "z"), [Standing::Equal], "{:?} {:?}", found.claims, found.notes);
    let wrong = read(&text.replace("sin(q.tilt)", "cos(q.tilt)"), Format::Plain, Some(Dialect::C));
    assert_eq!(all(&wrong, "z"), [Standing::Wrong], "{:?}", wrong.claims);
}

#[test]
fn what_later_sentences_give_is_not_given_yet() {
    let text = "DH (standard), lengths in metres\n\n  i   theta   d   a     alpha\n  1   th1     0   0.5   0\n  2   th2     0   0.35  0\n\n\
                For th1 = 30°, th2 = 60° we have x = 0.433 m. Afterwards th1 = 10°, th2 = 20° is set.\n";
    let found = read(text, Format::Plain, None);
    assert_eq!(all(&found, "x"), [Standing::Equal], "{:?}", found.claims);
}

#[test]
fn a_long_power_of_powers_is_no_unit() {
    let text = format!("{PLANAR}\n\nx = {}2\n", "2^".repeat(20_000));
    read(&text, Format::Plain, None);
}

#[test]
fn the_function_of_a_row_is_none_of_four_joints() {
    let text = "# Standard DH\n#  i  theta  d   a   alpha\n#  1  q1     0   L   0\n#  2  q2     0   L   0\n#  3  q3     0   L   0\n#  4  q4     0   L   0\n\
                def A(th, d, a, al):\n    return Matrix([[cos(th), -sin(th)*cos(al), sin(th)*sin(al), a*cos(th)],\n        \
                [sin(th), cos(th)*cos(al), -cos(th)*sin(al), a*sin(th)],\n        [0, sin(al), cos(al), d], [0, 0, 0, 1]])\n";
    let found = read(text, Format::Plain, Some(Dialect::Python));
    assert_eq!(
        found.claims.iter().map(|c| c.standing()).collect::<Vec<_>>(),
        [Standing::Equal],
        "{:?}",
        found.claims
    );
}

#[test]
fn numbers_that_a_program_defines_for_lengths() {
    let program = |unit: &str, h: &str, height: &str| {
        format!(
            "/* Standard DH{unit}, angles in rad\n *  i  theta  d    a    alpha\n *  1  q1     H    0    90\n *  2  q2     0    L    0\n */\n\
             #define H {h}\n#define L 0.3f\nvoid ik(const double p[3], double q[2])\n{{\n\
             \x20   double rho = sqrt(p[0]*p[0] + p[1]*p[1]);\n    q[0] = atan2(p[1], p[0]);\n    q[1] = atan2(p[2] - {height}, rho);\n}}\n"
        )
    };
    for (unit, h) in [("", "1.20f"), (", lengths in mm", "120.0f")] {
        let found = read(&program(unit, h, "H"), Format::Plain, Some(Dialect::C));
        assert!(found.claims.iter().all(|c| c.standing() != Standing::Wrong), "{unit}: {:?}", found.claims);
        let found = read(&program(unit, h, "L"), Format::Plain, Some(Dialect::C));
        assert!(found.claims.iter().any(|c| c.standing() == Standing::Wrong), "{unit}: {:?}", found.claims);
    }
}

#[test]
fn a_number_behind_a_formula_that_is_not_read_is_not_wrong_by_itself() {
    let text = |formula: &str, number: &str| {
        format!(
            "{PLANAR}\n\nWith th1 = 40 deg, th2 = 20 deg and L1 = 0.3 m, L2 = 0.2 m:\n\nx = {formula} = {number} m\n"
        )
    };
    // The point meant may be another one, of which `mystery` tells.
    let found = read(&text("L1*cos(th1) + mystery(L2)", "0.9"), Format::Plain, None);
    assert!(all(&found, "x").iter().all(|s| *s != Standing::Wrong), "{:?}", found.claims);
    let found = read(&text("L1*cos(th1) + L2*cos(th1 + th2)", "0.9"), Format::Plain, None);
    assert_eq!(all(&found, "x"), [Standing::Wrong], "{:?}", found.claims);
}

#[test]
fn an_upright_letter_before_an_angle_is_its_sine_beside_a_name_in_italics() {
    let text = |look: &str| {
        format!(
            "Standard DH\n\n| i | $\\theta$ | d | a | $\\alpha$ |\n|---|---|---|---|---|\n| 1 | $\\theta_1$ | $s$ | $L_1$ | 0 |\n\
             | 2 | $\\theta_2$ | 0 | $L_2$ | 0 |\n\n$$z = s$$\n\n$$y = L_1\\,{look}\\theta_1 + L_2\\sin(\\theta_1+\\theta_2)$$\n"
        )
    };
    for (look, expected) in [("\\mathrm{s}", Standing::Equal), ("\\mathrm{c}", Standing::Wrong)] {
        let found = read(&text(look), Format::Markdown, None);
        assert_eq!(all(&found, "y"), [expected], "{:?}", found.claims);
    }
}

#[test]
fn the_same_joint_in_another_solution() {
    let table = PLANAR.replace("th1", "θ1").replace("th2", "θ2");
    for prime in ["'", "′"] {
        let text = format!("{table}\n\nThe other way (flip: θ1{prime} = θ1 + 180, θ2{prime} = -θ2)\n");
        let found = read(&text, Format::Plain, None);
        assert!(found.claims.is_empty(), "{:?}", found.claims);
        assert_eq!(found.unjudged.len(), 2, "{:?}", found.unjudged);
    }
    // A sum that is told by itself is none.
    let found = read(&format!("{table}\n\nWith θ12 = θ1 + θ2, θ2 = θ12 - θ1\n"), Format::Plain, None);
    assert_eq!(all(&found, "θ2"), [Standing::Equal], "{:?}", found.claims);
}

#[test]
fn what_holds_of_coordinates_as_they_are_is_right_behind_wrong_ones() {
    let of = |y: &str, squares: &str| {
        let text = format!(
            "{PLANAR}\n\nx = L1*cos(th1) + L2*cos(th1 + th2)\n\ny = {y}\n\n\
             cos(th2) = (x^2 + y^2 - L1^2 {squares} L2^2)/(2*L1*L2)\n"
        );
        let found = read(&text, Format::Plain, None);
        let last = found.claims.last().expect("a claim");
        (all(&found, "y"), last.standing())
    };
    let right = "L1*sin(th1) + L2*sin(th1 + th2)";
    let wrong = "L1*sin(th1) - L2*sin(th1 + th2)";
    assert_eq!(of(right, "-"), (vec![Standing::Equal], Standing::Equal));
    assert_eq!(of(wrong, "-"), (vec![Standing::Wrong], Standing::Equal));
    assert_eq!(of(wrong, "+"), (vec![Standing::Wrong], Standing::Wrong));
    assert_eq!(of(right, "+"), (vec![Standing::Equal], Standing::Wrong));
}

#[test]
fn words_that_only_one_joint_moves_hold_to_the_end_of_their_part_of_the_sentence() {
    let of = |sign: &str| {
        let text = format!(
            "{PLANAR}\n\nx = L1*cos(th1) + L2*cos(th1 + th2)\ny = L1*sin(th1) + L2*sin(th1 + th2)\n\n\
             If only joint 1 turns, at the rate dth1, the hand moves with $\\dot x = -y\\,\\dot{{th1}}$ and \
             $\\dot y = {sign} x\\,\\dot{{th1}}$.\n"
        );
        let found = read(&text, Format::Markdown, None);
        all(&found, "\\dot y")
    };
    assert_eq!((of(""), of("-")), (vec![Standing::Equal], vec![Standing::Wrong]));
}

#[test]
fn a_point_so_far_out_on_an_axis_of_the_last_frame() {
    let of = |x: &str| {
        let text = format!(
            "DH table, standard convention, metres:\n\n| i | theta | d | a | alpha |\n|---|---|---|---|---|\n| 1 | q1 | 0 | 0.4 | 0 |\n\
             | 2 | q2 | 0 | 0.3 | 0 |\n\nThe probe sits 0.25 m out on the x axis of frame 2.\n\n\
             With q1 = 0 and q2 = 90 deg the tip is at\n\nx = {x} m\ny = 0.55 m\n"
        );
        let found = read(&text, Format::Plain, None);
        (all(&found, "x"), all(&found, "y"))
    };
    assert_eq!(of("0.4"), (vec![Standing::Equal], vec![Standing::Equal]));
    assert_eq!(of("0.7").0, [Standing::Wrong]);
}
