//! What names mean in a document, what is carried forward, and what is said of what was not judged.

use denavit::description::Convention;
use denavit_check::{CheckOptions, Checked, Finding, Noted, Sense, Skipped, SlipKind, Standing, check};
use denavit_reading::document::Format;

const PLANAR: &str = "DH parameters (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | a1 | 0 |\n\
                      | 2 | θ2 | 0 | a2 | 0 |\n\n";
const PLANAR_Q: &str = "convention: standard\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | q1 | 0 | a1 | 0 |\n\
                        | 2 | q2 | 0 | a2 | 0 |\n\n";
const THREE: &str = "convention: standard\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | a1 | 0 |\n\
                     | 2 | θ2 | 0 | a2 | 0 |\n| 3 | θ3 | 0 | a3 | 0 |\n\n";
const SCARA: &str = "Standard-DH-Tabelle\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | a1 | 0 |\n\
                     | 2 | θ2 | 0 | a2 | 180° |\n| 3 | 0 | d3 | 0 | 0 |\n| 4 | θ4 | 0 | 0 | 0 |\n\n";

fn checked(table: &str, text: &str) -> Checked {
    let document = format!("{table}{text}\n");
    check(&document, Format::Markdown, None, &CheckOptions::default())
        .unwrap_or_else(|e| panic!("{text}: {e:?}"))
}

/// The name and verdict of each claim.
#[track_caller]
fn is(table: &str, text: &str, expected: &[(&str, Standing)]) {
    let all = checked(table, text);
    let said: Vec<(&str, Standing)> = all.claims.iter().map(|c| (c.name.as_str(), c.standing())).collect();
    assert_eq!(said, expected, "{text}");
}

#[test]
fn an_error_is_carried_forward() {
    let document = "$$A_1 = \\begin{bmatrix} c_1 & -s_1 & 0 & a_1 c_1 \\\\ s_1 & c_1 & 0 & a_1 c_1 \\\\ 0 & 0 & 1 & 0 \\\\ 0 & 0 & 0 & 1 \\end{bmatrix}$$\n\n\
         $$T_{02} = \\begin{bmatrix} c_{12} & -s_{12} & 0 & a_1 c_1 + a_2 c_{12} \\\\ s_{12} & c_{12} & 0 & a_1 c_1 + a_2 s_{12} \\\\ 0 & 0 & 1 & 0 \\\\ 0 & 0 & 0 & 1 \\end{bmatrix}$$\n\n\
         $$p_y = a_1 c_1 + a_2 s_{12}$$\n\n$$p_x = a_1 c_1 + a_2 s_{12}$$";
    is(
        PLANAR,
        document,
        &[
            ("A_1", Standing::Wrong),
            ("T_{02}", Standing::Carried),
            ("p_y", Standing::Carried),
            ("p_x", Standing::Wrong),
        ],
    );
    let all = checked(PLANAR, document);
    let cause = all.claims[2].entries.iter().find_map(|e| match &e.finding {
        Finding::Carried { by, .. } => Some(*by),
        _ => None,
    });
    assert_eq!(cause, Some(0));
}

#[test]
fn what_is_not_judged_is_listed() {
    let all = checked(PLANAR, "x = a1 C1 + a2 C12\n\nmu = 3 zeta + 4\n\nthe load is F = m g here");
    assert_eq!(all.tally().equal, 1);
    assert_eq!(all.unjudged.len(), 2, "{:?}", all.unjudged);
    // A helper that nothing uses says nothing; one that is used is right where it is used.
    let all = checked(PLANAR, "B = a1 + 2 a2");
    assert!(matches!(all.unjudged[..], [ref u] if matches!(u.why, Skipped::Unused(_))), "{:?}", all.unjudged);
    is(PLANAR, "k = a1 + a2 C2\n\nx = k C1 - a2 S2 S1", &[("k", Standing::Equal), ("x", Standing::Equal)]);
}

#[test]
fn only_what_is_proved_vouches_for_a_helper() {
    // Without the other elbow, θ2 is right under a condition: so is D.
    let text = "D = (px² + py² - a1² - a2²)/(2 a1 a2)\n\nθ2 = arccos(D)";
    let all = checked(PLANAR, text);
    assert_eq!((all.tally().conditional, all.tally().equal), (2, 0), "{:?}", all.claims);
    // `k` stands in the text of the equation, but in no formula of it.
    let all = checked(PLANAR, "k = a1 + 3 a2\n\nkx: px = a1 C1 + a2 C12");
    assert!(!all.claims.iter().any(|c| c.name == "k"), "{:?}", all.claims);
}

#[test]
fn the_document_tells_the_order_of_atan2() {
    let right = "θ2 = atan2(c, s)\n\nθ1 = atan2(px, py) - atan2(a1 + a2 c, a2 s)";
    let helpers = "c = (px² + py² - a1² - a2²)/(2 a1 a2)\n\ns = ±sqrt(1 - c²)\n\n";
    let said = |text: &str| {
        let all = checked(PLANAR, &format!("{helpers}{text}"));
        let joints = all.claims.iter().filter(|c| c.name.starts_with('θ')).map(|c| c.standing());
        let is_told = all.notes.iter().any(|n| n.what == Noted::Reading(Sense::CosineFirst));
        (joints.collect::<Vec<Standing>>(), is_told)
    };
    let (joints, is_told) = said(right);
    assert!(is_told && !joints.contains(&Standing::Wrong), "{joints:?}");
    // One formula alone does not turn the order: it is called what it is.
    let (joints, is_told) = said("θ2 = atan2(s, c)\n\nθ1 = atan2(px, py) - atan2(a2 s, a1 + a2 c)");
    assert!(!is_told && joints[1] == Standing::Wrong, "{joints:?}");
}

#[test]
fn the_document_says_what_its_names_mean() {
    // Links, not frames in the base.
    let link = |k: usize| {
        format!(
            "$$T_{k} = \\begin{{bmatrix}} c_{k} & -s_{k} & 0 & a_{k} c_{k} \\\\ s_{k} & c_{k} & 0 & a_{k} s_{k} \\\\ 0 & 0 & 1 & 0 \\\\ 0 & 0 & 0 & 1 \\end{{bmatrix}}$$\n\n"
        )
    };
    is(
        THREE,
        &(link(1) + &link(2) + &link(3)),
        &[("T_1", Standing::Equal), ("T_2", Standing::Equal), ("T_3", Standing::Equal)],
    );
    // X and Y as the wrist of a planar arm.
    let wrist = "X = px - a3 cos(θ1+θ2+θ3)\n\nY = py - a3 sin(θ1+θ2+θ3)\n\n\
                 cos θ2 = (X² + Y² - a1² - a2²)/(2 a1 a2)";
    is(THREE, wrist, &[("X", Standing::Equal), ("Y", Standing::Equal), ("cos θ2", Standing::Equal)]);
}

#[test]
fn jacobians_of_tasks() {
    let j = "$$J = \\begin{bmatrix} -a_1 s_1 - a_2 s_{12} & -a_2 s_{12} & 0 & 0 \\\\ a_1 c_1 + a_2 c_{12} & a_2 c_{12} & 0 & 0 \\\\ 0 & 0 & -1 & 0 \\\\ 1 & 1 & 0 & -1 \\end{bmatrix}$$";
    is(SCARA, j, &[("J", Standing::Equal)]);
    is(SCARA, &j.replace("0 & 0 & -1 & 0", "0 & 0 & 1 & 0"), &[("J", Standing::Wrong)]);
    is(THREE, "$$\\det J = a_1 a_2 \\sin\\theta_2$$", &[("\\det J", Standing::Equal)]);
    let inverse = "$$J^{-1} = \\frac{1}{a_1 a_2 s_2} \\begin{bmatrix} a_2 c_{12} & a_2 s_{12} \\\\ -a_1 c_1 - a_2 c_{12} & -a_1 s_1 - a_2 s_{12} \\end{bmatrix}$$";
    is(PLANAR, inverse, &[("J^{-1}", Standing::Equal)]);
    // The transpose is no inverse.
    let transposed = "$$J^{-1} = \\begin{bmatrix} -a_1 s_1 - a_2 s_{12} & a_1 c_1 + a_2 c_{12} \\\\ -a_2 s_{12} & a_2 c_{12} \\end{bmatrix}$$";
    is(PLANAR, transposed, &[("J^{-1}", Standing::Wrong)]);
}

#[test]
fn velocities_torques_and_singular_configurations() {
    is(
        PLANAR,
        "$$\\dot x = -a_1 s_1 \\dot\\theta_1 - a_2 s_{12} (\\dot\\theta_1 + \\dot\\theta_2)$$",
        &[("\\dot x", Standing::Equal)],
    );
    is(
        PLANAR,
        "tau2 = -a2 s12 Fx + a2 c12 Fy\n\ntau1 = a1 s1 Fx",
        &[("tau2", Standing::Equal), ("tau1", Standing::Wrong)],
    );
    is(PLANAR, "The arm is singular for $\\theta_2 = 0$.", &[("\\theta_2", Standing::Equal)]);
    is(PLANAR, "The arm is singular if θ2 = 90°.", &[("θ2", Standing::Wrong)]);
}

#[test]
fn numbers_in_sentences() {
    let text = "Für a1 = 0,5 m, a2 = 0,3 m, q1 = 30° und q2 = 60° ist x = 0,433 m und y = 0,650 m.";
    is(PLANAR, text, &[("x", Standing::Equal), ("y", Standing::Wrong)]);
}

#[test]
fn exchanged_arguments_are_named() {
    let all = checked(SCARA, "θ1 = atan2(px, py) - atan2(a2 sin θ2, a1 + a2 cos θ2)");
    let Finding::Wrong(wrong) = &all.claims[0].entries[0].finding else { panic!("{:?}", all.claims) };
    let slip = wrong.slip.as_ref().expect("a slip");
    assert_eq!(slip.kind, SlipKind::Arguments);
    assert_eq!(slip.formula, "atan2(py, px) - atan2(a2 sin θ2, a1 + a2 cos θ2)");
}

#[test]
fn tables_set_with_blanks() {
    let text = "standard convention\n\n  link   theta   d    a    alpha\n   1     t1     0    a1   0\n   2     t2     0    a2   0\n\n\
                px = a1 C1 + a2 C12";
    is("", text, &[("px", Standing::Equal)]);
    let behind_words =
        text.replace("  link   theta", "standard DH:  i  theta").replace("a1", "2").replace("a2", "1.5");
    let told = "px = 2 C1 + 1.5 C12\n\nFor t1 = 20 deg, t2 = 45 deg: px = 2 cos 20 + 1.5 cos 65 = 2.513";
    let (table, _) = behind_words.split_once("px").expect("a formula");
    is("", &format!("{table}{told}"), &[("px", Standing::Equal), ("px", Standing::Equal)]);
}

#[test]
fn rounded_numbers_behind_exact_ones() {
    is(PLANAR, "yw = 1 - 0.5 sin 60° = 0.567 m", &[("yw", Standing::Equal)]);
    is(PLANAR, "yw = 1 - 0.5 sin 60° = 0.576 m", &[("yw", Standing::Wrong)]);
    is(PLANAR, "k = sqrt(7) = 2.65", &[("k", Standing::Equal)]);
}

#[test]
fn statements_tell_the_convention() {
    const TABLE: &str = "| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | d1 | 0 | 90° |\n| 2 | θ2 | 0 | a2 | 0 |\n\
        | 3 | θ3 | 0 | a3 | 0 |\n\n";
    let told = |text: &str| {
        let options = CheckOptions::default();
        let all = check(&format!("{TABLE}{text}"), Format::Markdown, None, &options).ok()?;
        let counts = all.notes.iter().find_map(|n| match n.what {
            Noted::Supported { convention, right, rival } => Some((convention, right, rival)),
            _ => None,
        });
        Some((counts, all.tally().equal))
    };
    let standard = "px = C1 (a2 C2 + a3 C23)\n\npy = S1 (a2 C2 + a3 C23)\n\npz = d1 + a2 S2 + a3 S23";
    assert_eq!(told(standard), Some((Some((Convention::Standard, 3, 0)), 3)));
    // The first twist is before the first joint there: the arm moves in a vertical plane.
    let craig = "px = a2 C1 + a3 C12\n\npy = -d1\n\npz = a2 S1 + a3 S12";
    assert_eq!(told(craig), Some((Some((Convention::Craig, 3, 0)), 3)));
    // One slip changes nothing; what fits in none is not guessed.
    assert_eq!(told(&craig.replace("C12", "S12")), Some((Some((Convention::Craig, 2, 0)), 2)));
    assert_eq!(told("px = 2 a3 C1\n\npy = 0"), None);
    assert_eq!(told("The arm is blue."), None);
}

#[test]
fn numbers_for_a_pose_behind_formulas() {
    let rows = [(1, 4), (2, 3), (3, 1)].map(|(k, a)| format!("| {k} | θ{k} | 0 | {a} | 0 |\n")).concat();
    let table =
        format!("convention: standard\n\n| i | theta | d | a | alpha |\n|---|---|---|---|---|\n{rows}\n");
    let at = |f: fn(f64) -> f64| {
        [(4, 20.0), (3, 80.0), (1, 50.0)].map(|(a, x): (i32, f64)| f64::from(a) * f(x.to_radians()))
    };
    let [x, y]: [f64; 2] = [at(f64::cos), at(f64::sin)].map(|p| p.iter().sum());
    let text = format!(
        "Tool wanted at $x = {x:.4}$, $y = {y:.4}$ with $φ = θ_1 + θ_2 + θ_3 = 50°$. First the wrist,\n\n\
         $x_w = x - \\cos φ$\n\n$y_w = y - \\sin φ$\n\n\
         $\\cos θ_2 = (x_w^2 + y_w^2 - 4^2 - 3^2)/(2·4·3)$\n\n$θ_2 = 60.0°$\n\n\
         $θ_1 = atan2(y_w, x_w) - atan2(3 \\sin θ_2, 4 + 3 \\cos θ_2) = 20.0°$\n\n\
         $θ_3 = 50° - θ_1 - θ_2 = -30.0°$\n"
    );
    let wrong = |text: &str| {
        let all = checked(&table, text);
        all.claims
            .iter()
            .filter(|c| c.standing() == Standing::Wrong)
            .map(|c| c.name.clone())
            .collect::<Vec<String>>()
    };
    assert_eq!(wrong(&text), [""; 0]);
    assert!(checked(&table, &text).tally().equal > 4);
    assert_eq!(wrong(&text.replace("= -30.0°", "= -10.0°")), ["θ_3"]);
    assert_eq!(wrong(&text.replace("- 4^2", "- 4")), [r"\cos θ_2"]);
}

#[test]
fn right_statements_are_not_accused() {
    let wrong = |text: &str| {
        let all = checked(PLANAR, text);
        all.claims
            .iter()
            .filter(|c| c.standing() == Standing::Wrong)
            .map(|c| c.name.clone())
            .collect::<Vec<String>>()
    };
    let nobody: [&str; 0] = [];
    // The place of the hand is o, where no letters say that o is an axis.
    assert_eq!(wrong("o_x = a1 C1 + a2 C12\n\no_y = a1 S1 + a2 S12"), nobody);
    assert_eq!(wrong("n_x = C12\n\no_x = a1 C1 + a2 C12"), ["o_x"]);
    // Zeros and ones without joints are the matrix somewhere.
    assert_eq!(wrong("With the arm stretched, R_02 = [1, 0, 0; 0, 1, 0; 0, 0, 1]"), nobody);
    assert_eq!(wrong("All joints zero: R_02 = [0, 1, 0; 1, 0, 0; 0, 0, 1]"), ["R_02"]);
    // The point that is to be reached is not where the arm was before.
    let numbers = PLANAR.replace("| a1 |", "| 1 |").replace("| a2 |", "| 1 |");
    let there =
        |text: &str| checked(&numbers, &format!("For q1 = 30°, q2 = 60°: x = 0.866 m.\n\n{text}")).tally();
    let tally = there("For the point x = 1.2 m, y = 0.9 m I get the following.");
    assert_eq!((tally.wrong, tally.equal), (0, 1));
    assert_eq!(there("There I get x = 1.2 m, y = 0.9 m.").wrong, 2);
    // Two names of one entry: one of them is a helper.
    assert_eq!(wrong("X = px - a1 C1\n\nθ12 = atan2(py - a1 S1, X)"), nobody);
    // A root for a length that may be negative.
    let text = "w = sqrt((a1 + a2 C2)²)\n\npx = w C1 - a2 S1 S2";
    assert_eq!(wrong(text), nobody);
    assert_eq!(wrong(&text.replace("C1 - a2", "C1 + a2")), ["px"]);
    // A matrix in bars, and one that is wrong.
    let text = "J = | -a1 S1 - a2 S12   -a2 S12 |\n    |  a1 C1 + a2 C12    a2 C12 |\n\ndet J = a1 a2 S2";
    assert_eq!(wrong(text), nobody);
    assert_eq!(wrong(&text.replace("a2 S12   -a2", "a2 C12   -a2")), ["J"]);
    // The determinant of a matrix that could not be read is that of another.
    assert_eq!(wrong("J(zeta) = [zeta; 1]\n\ndet J = 3 a1"), nobody);
    // Fractions with commas, and a comma behind one.
    let text = "Für q1 = 0,5 rad und q2 = 0,25 rad: cos(q1) = 0,878, sin(q1) = 0,479, also";
    assert_eq!(wrong(text), nobody);
}

#[test]
fn lengths_in_millimetres_by_words() {
    let table = "Standard DH, lengths in mm.\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | 300 | 0 |\n\n";
    let all = check(
        &format!("{table}At θ1 = 30°:\n\nx = 259.8 mm\n\nT_01 = [0.866, -0.5, 0, 259.8; 0.5, 0.866, 0, 150; 0, 0, 1, 0; 0, 0, 0, 1]"),
        Format::Markdown,
        None,
        &CheckOptions::default(),
    )
    .expect("a table");
    assert!(
        all.claims.len() == 2 && all.claims.iter().all(|c| c.standing() == Standing::Equal),
        "{:?}",
        all.claims
    );
    assert!(all.notes.iter().any(|n| n.what == Noted::InMillimetres));
}

/// A text may solve two problems with links of the same names: the second one's are told again, and judged by themselves.
#[test]
fn links_of_two_problems() {
    let matrix = "$$U = \\begin{bmatrix} n_x & o_x & a_x & p_x \\\\ n_y & o_y & a_y & p_y \\\\ n_z & o_z & a_z & p_z \\\\ 0 & 0 & 0 & 1 \\end{bmatrix}$$";
    let first = "$A_1(q_1) = \\operatorname{Rot}(z, q_1) \\operatorname{Trans}(x, a_1)$";
    let document = |last: &str| {
        format!(
            "## Inverse kinematics\n\nGiven the pose T of the hand; sought q1, q2.\n\n$U = A_1 A_2$\n\n\
             $U = T \\operatorname{{Trans}}(x, -a_2)$\n\n{first}\n\n$A_2(q_2) = \\operatorname{{Rot}}(z, q_2)$\n\n{matrix}\n\n\
             $p_x = a_1 C_1$\n\n$p_y = a_1 S_1$\n\n$C_1 p_x + S_1 p_y = a_1$\n\n\
             ## The position alone\n\nGiven the position of the hand; sought q1, q2. With $U = T$ the chain is\n\n$U = A_1 A_2$\n\n\
             {first}\n\n$A_2(q_2) = \\operatorname{{Rot}}(z, q_2) \\operatorname{{Trans}}(x, a_2)$\n\n{matrix}\n\n\
             $p_x = a_1 C_1 + a_2 C_{{12}}$\n\n{last}"
        )
    };
    let wrong = |last: &str| -> Vec<String> {
        let all = checked(PLANAR_Q, &document(last));
        let wrong = all.claims.iter().filter(|c| matches!(c.standing(), Standing::Wrong | Standing::Carried));
        wrong.map(|c| c.name.clone()).collect()
    };
    assert_eq!(wrong("$p_y = a_1 S_1 + a_2 S_{12}$"), Vec::<String>::new());
    assert_eq!(wrong("$p_y = a_1 S_1 - a_2 S_{12}$"), ["p_y"]);
}
