//! What a document does not bear out is not called wrong; what stands beside it is.

use denavit_check::{About, CheckOptions, Checked, Standing, check};
use denavit_reading::code::Dialect;
use denavit_reading::document::Format;

fn read(text: &str, language: Option<Dialect>) -> Checked {
    let options = CheckOptions { language, ..CheckOptions::default() };
    let format = if language.is_some() { Format::Plain } else { Format::Markdown };
    check(text, format, None, &options).unwrap_or_else(|e| panic!("{e:?}\n{text}"))
}

fn all(checked: &Checked, name: &str) -> Vec<Standing> {
    checked.claims.iter().filter(|c| c.name == name).map(|c| c.standing()).collect()
}

const PLANAR: &str = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | a1 | 0 |\n\
                      | 2 | θ2 | 0 | a2 | 0 |\n\n";

#[test]
fn a_value_in_lengths_alone_is_a_configuration() {
    let table = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | q1 | h | 0 | −90° |\n| 2 | q2 | g | a2 | 0 |\n\
                 | 3 | q3 | 0 | a3 | −90° |\n| 4 | 0 | f | 0 | 0 |\n\n";
    let of = |value: &str| {
        let found = read(&format!("{table}So the bracket vanishes:\n\n$$q_3 = {value}$$\n"), None);
        let claim = found.claims.into_iter().find(|c| c.name == "q_3").unwrap();
        assert_eq!(claim.is_proved(), claim.standing() == Standing::Equal);
        (claim.about.clone(), claim.standing())
    };
    assert_eq!(of("-\\operatorname{atan2}(f, a_3)"), (About::Singularity, Standing::Equal));
    assert_eq!(of("\\operatorname{atan2}(f, a_3)").1, Standing::Undecided);
    // Where no word speaks of singularities it is a value for nobody knows which pose.
    let inverse = format!(
        "{table}Inverse kinematics of the wrist centre:\n\n$$q_3 = -\\operatorname{{atan2}}(f, a_3)$$\n"
    );
    assert_eq!(all(&read(&inverse, None), "q_3"), [Standing::Undecided]);
    // Nor where they deny it.
    let denied =
        format!("{table}The determinant does not vanish for\n\n$$q_3 = -\\operatorname{{atan2}}(f, a_3)$$\n");
    assert_eq!(all(&read(&denied, None), "q_3"), [Standing::Undecided]);
}

#[test]
fn a_determinant_that_vanishes_everywhere_says_nothing() {
    let text = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | d1 | 0 | 90° |\n| 2 | θ2 | 0 | a2 | 90° |\n\
                | 3 | θ3 | d3 | 0 | 0 |\n\nThe arm is singular at\n\n$$\\theta_2 = \\operatorname{atan2}(5 d_1, 3 a_2)$$\n";
    assert_eq!(all(&read(text, None), "\\theta_2"), [Standing::Undecided]);
}

#[test]
fn the_sine_of_another_joint_is_a_slip() {
    let found = read(&format!("{PLANAR}$$s_1 = \\sin\\theta_2$$\n"), None);
    assert_eq!(all(&found, "s_1"), [Standing::Wrong], "{:?}", found.claims);
}

#[test]
fn offsets_that_are_lengths() {
    for head in ["axis offset", "z offset", "offset along z"] {
        let text = format!(
            "DH (standard)\n\n| i | θ | {head} | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0.3 | 0.1 | 90° |\n| 2 | θ2 | 0.2 | 0.4 | 0 |\n\n\
             $$z = 0.4 \\sin\\theta_2$$\n"
        );
        let options = CheckOptions::default();
        let wrong =
            check(&text, Format::Markdown, None, &options).map(|c| all(&c, "z").contains(&Standing::Wrong));
        assert_ne!(wrong.ok(), Some(true), "{head}: no angle is shifted by a length");
    }
}

#[test]
fn a_wrong_cosine_leaves_the_angle_right() {
    let text = |factor: &str| {
        format!("{PLANAR}c2 = (x² + y² − a1² − a2²)/({factor} a1 a2)\n\nθ2 = atan2(±√(1 − c2²), c2)\n")
    };
    assert_eq!(all(&read(&text("2"), None), "θ2"), [Standing::Equal]);
    let wrong = read(&text("1"), None);
    assert_eq!((all(&wrong, "c2"), all(&wrong, "θ2")), (vec![Standing::Wrong], vec![Standing::Equal]));
    assert!(wrong.claims.iter().filter(|c| c.name == "θ2").all(|c| c.is_proved()));
}

#[test]
fn helpers_that_are_read_otherwise_than_meant_accuse_nobody() {
    // What the program calls u and w is that of a point which nothing tells.
    let text = |u: &str| {
        format!(
            "% DH (standard)\n% | i | theta | d | a | alpha |\n% | 1 | q1 | 0 | a1 | 0 |\n% | 2 | q2 | 0 | a2 | 0 |\n\
             [u, w] = camera(frame);\nr = hypot(u, w);\nq2 = acos((r^2 - {u})/(2*a1*a2));\nq1 = atan2(w, u) + gauge(r);\n"
        )
    };
    let found = read(&text("a1^2 - a2^2"), Some(Dialect::Matlab));
    assert!(found.claims.iter().all(|c| c.standing() != Standing::Wrong), "{:?}", found.claims);
}

#[test]
fn offsets_without_angles_are_those_of_the_variables() {
    let text = |entry: &str| {
        format!(
            "DH (standard)\n\n| joint | offset added to q | d | a | alpha |\n|---|---|---|---|---|\n| 1 | 0 | 0.34 | 0.06 | -90° |\n\
             | 2 | -90° | 0 | 0.29 | 0 |\n\n$$x = \\cos q_1 (0.06 + 0.29 {entry} q_2)$$\n"
        )
    };
    assert_eq!(all(&read(&text("\\sin"), None), "x"), [Standing::Equal]);
    assert_eq!(all(&read(&text("\\cos"), None), "x"), [Standing::Wrong]);
}

#[test]
fn columns_of_the_joints_that_move_the_tool() {
    let text = |offset: &str| {
        format!(
            "Khalil\n\n| j | σ | α | d | θ | r |\n|---|---|---|---|---|---|\n| 1 | 0 | 0 | 0 | θ1 | 0 |\n| 2 | 1 | 0 | 0 | 0 | r2 |\n\
             | 3 | 1 | -90° | 0 | 0 | r3 |\n| 4 | 0 | 0 | 0 | θ4 | R4 |\n\n\
             $$J = \\begin{{bmatrix}} -C_1(r_3{offset}) & 0 & -S_1 \\\\ -S_1(r_3{offset}) & 0 & C_1 \\\\ 0 & 1 & 0 \\end{{bmatrix}}$$\n"
        )
    };
    assert_eq!(all(&read(&text("+R_4"), None), "J"), [Standing::Equal]);
    // That of frame 3 is right as well.
    assert_eq!(all(&read(&text(""), None), "J"), [Standing::Equal]);
    assert_eq!(all(&read(&text("-R_4"), None), "J"), [Standing::Wrong]);
}

#[test]
fn the_other_solution_of_a_stated_configuration() {
    let text = |second: &str| {
        format!(
            "{PLANAR}a1 = 0.5 m, a2 = 0.4 m, θ1 = 30°, θ2 = 60°.\n\nx = 0.4330\n\ny = 0.6500\n\n\
             - the other solution, with the elbow up: θ1 = 82.83°, θ2 = {second}\n"
        )
    };
    let right = read(&text("−60°"), None);
    assert!(all(&right, "θ2").contains(&Standing::Equal), "{:?}", right.claims);
    assert!(!all(&right, "θ2").contains(&Standing::Wrong), "{:?}", right.claims);
}

#[test]
fn numbers_behind_words_are_no_equations() {
    let text = format!(
        "{PLANAR}a1 = 0.5 m, a2 = 0.4 m, θ1 = 0°, θ2 = 90°. A load of F = (0, 10) N acts on the hand.\n\n\
         torque 2 = 0 N m\n\nmotor 3 = 17 W\n"
    );
    let found = read(&text, None);
    assert!(found.claims.iter().all(|c| c.name != "3" && c.name != "2"), "{:?}", found.claims);
}

#[test]
fn a_proof_that_takes_too_long_is_given_up() {
    // Roots of quotients of roots: factors of these have coefficients without end.
    let text = "# DH (standard)\n# | joint | theta | d | a | alpha |\n# | 1 | q1 | 0 | coxa | pi/2 |\n# | 2 | q2 | 0 | femur | 0 |\n\
                # | 3 | q3 | 0 | tibia | 0 |\n\ndef leg_ik(x, y, z):\n    q1 = atan2(y, x)\n    r = sqrt(x**2 + y**2) - coxa\n\
                d = sqrt(r**2 + z**2)\n    q3 = acos((femur**2 + tibia**2 - d**2)/(2*femur*tibia)) - pi\n\
                q2 = atan2(z, r) + acos((femur**2 + d**2 - tibia**2)/(2*femur*d))\n    return q1, q2, q3\n";
    let text = text.replace("\nd = ", "\n    d = ").replace("\nq2 = ", "\n    q2 = ");
    let found = read(&text, Some(Dialect::Python));
    assert_eq!(all(&found, "q2"), [Standing::Conditional], "{:?}", found.claims);
}

#[test]
fn where_the_sine_of_a_joint_is_something() {
    let table = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | L1 | e | −90° |\n| 2 | θ2 | 0 | 0 | 90° |\n\
                 | 3 | 0 | d3 | 0 | 0 |\n\n";
    let of = |value: &str| {
        let found =
            read(&format!("{table}The determinant vanishes for\n\n$$\\sin\\theta_2 = {value}$$\n"), None);
        found.claims.iter().map(|c| (c.about.clone(), c.standing())).collect::<Vec<_>>()
    };
    assert_eq!(of("-\\frac{e}{d_3}"), [(About::Singularity, Standing::Equal)]);
    assert_eq!(of("\\frac{e}{d_3}"), []);
}

#[test]
fn numbers_of_another_configuration() {
    let text = |x: &str| {
        format!(
            "{PLANAR}a1 = 0.5 m, a2 = 0.4 m.\n\nR1: q = (30°, 60°)\n\nR2: q = (90°, 0°)\n\nIn these poses\n\n- R1: x = {x}\n"
        )
    };
    assert_eq!(all(&read(&text("0.4330"), None), "x"), [Standing::Equal]);
    // Said of the last one, it is right at another.
    let unnamed = text("0.4330").replace("- R1: x", "- x");
    assert_eq!(all(&read(&unnamed, None), "x"), [Standing::Undecided]);
    assert_eq!(all(&read(&text("0.4210"), None), "x"), [Standing::Wrong]);
}
