//! Points by a rubric.

use denavit_check::marking::{Asked, Form, Item, Mark, Rubric, Subject};
use denavit_check::{Answer, CheckOptions, Standing, ValueSlip, check};
use denavit_reading::document::Format;

const TABLE: &str = "convention: standard\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | a1 | 0 |\n\
                     | 2 | θ2 | 0 | a2 | 0 |\n\n";

/// What a document earns for one item of 12 points.
fn mark(text: &str, claims: &[&str], whole: bool) -> Mark {
    let text = format!("{TABLE}{text}");
    let checked = check(&text, Format::Markdown, None, &CheckOptions::default()).expect("a table");
    let claims = claims.iter().map(|c| (*c).to_string()).collect();
    let items = vec![Item { name: "item".into(), claims, points: 12.0, whole, ..Item::default() }];
    let rubric = Rubric { title: None, conditional: 0.5, carried: 0.75, items };
    rubric.mark(&text, &checked).marks.remove(0)
}

fn points(text: &str, claims: &[&str], whole: bool) -> [f64; 2] {
    let mark = mark(text, claims, whole);
    [mark.points, mark.open]
}

#[test]
fn what_is_not_judged_is_marked_by_hand() {
    // Neither right nor wrong: half of the points are open.
    assert_eq!(points("x = a1 C1 + a2 C12\n\ny = a1 S1 + zeta S12", &["x", "y"], false), [6.0, 6.0]);
    assert_eq!(points("x = a1 C1 + a2 C12\n\ny = a1 S1 + zeta S12", &["x", "y"], true), [0.0, 12.0]);
    // All or nothing: with one that is wrong nothing is open.
    assert_eq!(points("x = a1 C1 + a2 C2\n\ny = a1 S1 + zeta S12", &["x", "y"], true), [0.0, 0.0]);
    // A line that is passed over.
    let text = "x = a1 C1 + a2 C12\n\n$\\theta_2 = \\text{as in the lecture}$";
    let found = mark(text, &["θ2"], false);
    assert_eq!((found.points, found.open, found.by_hand.len()), (0.0, 12.0, 1), "{found:?}");
    assert_eq!(points(text, &["θ1"], false), [0.0, 0.0]);
}

#[test]
fn zeros_and_ones_earn_nothing() {
    let right = "T_02 = [C12, -S12, 0, a1 C1 + a2 C12; S12, C12, 0, a1 S1 + a2 S12; 0, 0, 1, 0; 0, 0, 0, 1]";
    let slip = right.replace("-S12", "S12");
    let found = mark(&slip, &["T02"], false);
    assert_eq!((found.points, found.right), (10.0, [5, 6]));
    // One that is wrong does count.
    let zero = right.replace("0, 0, 1, 0;", "0, 1, 0, 0;");
    assert_eq!(mark(&zero, &["T02"], false).right, [6, 8]);
    // Where there is nothing else, they are the answer.
    assert_eq!(points("R_11 = [1, 0, 0; 0, 1, 0; 0, 0, 1]", &["R11"], false), [12.0, 0.0]);
}

#[test]
fn carried_errors_earn_their_share() {
    let text = "x = a1 C1 + a2 C2\n\ny = a1 S1 + a2 S12\n\nJ = [-a1 S1, -a2 S2; a1 C1 + a2 C12, a2 C12]";
    let found = mark(text, &["J"], false);
    assert_eq!((found.right, found.points), ([2, 4], 10.5), "{found:?}");
}

/// What is said of a text by a value that is asked for: right, or its slip; nothing if it is left alone.
fn answered(text: &str, value: &str, unit: &str) -> Option<Result<(), ValueSlip>> {
    let text = format!("{TABLE}{text}");
    let mut checked = check(&text, Format::Markdown, None, &CheckOptions::default()).expect("a table");
    let answer = Answer { names: vec!["tau1".into(), "q1t".into()], value: value.into(), unit: unit.into() };
    let item =
        Item { name: "item".into(), claims: vec![], points: 3.0, answers: vec![answer], ..Item::default() };
    let rubric = Rubric { title: None, conditional: 0.5, carried: 0.75, items: vec![item] };
    rubric.answer(&text, Format::Markdown, &mut checked);
    let mark = rubric.mark(&text, &checked).marks.remove(0);
    let found = checked.answered.first().map(|a| a.slip.map_or(Ok(()), Err));
    assert_eq!(mark.points > 2.9, found == Some(Ok(())), "{text}");
    found
}

#[test]
fn values_are_marked_in_any_form() {
    let torque = |text: &str| answered(text, "2.3205", "N m");
    for right in [
        "$\\tau_1 = 2.3205$ N m",
        "$\\tau_1 = 2.32$",
        "τ1 = 2.32 Nm",
        "$\\tau_{1} = 0.0023205 \\text{ kN m}$",
        "$\\tau_1 = 2 + 0.3205$",
        "$\\tau_1 = 10 \\cdot 0.23205\\,\\mathrm{N\\,m}$",
    ] {
        assert_eq!(torque(right), Some(Ok(())), "{right}");
    }
    for (wrong, slip) in [
        ("$\\tau_1 = -2.3205$ N m", ValueSlip::Sign),
        ("$\\tau_1 = 4.641$ N m", ValueSlip::Factor),
        ("$\\tau_1 = 232.05$", ValueSlip::PowerOfTen),
        ("$\\tau_1 = 2.42$", ValueSlip::Other),
    ] {
        assert_eq!(torque(wrong), Some(Err(slip)), "{wrong}");
    }
    // A formula is none of these.
    assert_eq!(torque("$\\tau_1 = F_y a_1 C_1$"), None);
    let way = |text: &str| answered(text, "30 + 45 t^2 - 15 t^3", "°");
    for right in [
        "$q_1(t) = 30 + 45 t^2 - 15 t^3$",
        "$q_1(t) = 30 - 15 t^2 (t - 3)$ °",
        "$q_1(t) = 30 + 60\\left(3 (t/2)^2 - 2 (t/2)^3\\right)$",
        "$q_1(t) = 0.523599 + 0.785398 t^2 - 0.261799 t^3$",
    ] {
        assert_eq!(way(right), Some(Ok(())), "{right}");
    }
    for (wrong, slip) in [
        ("$q_1(t) = 30 + 45 t^2 + 15 t^3$", ValueSlip::Term(3)),
        ("$q_1(t) = 45 t^2 - 15 t^3$", ValueSlip::Term(0)),
        ("$q_1(t) = 30 + 45 t^2 - 15 t^3$ rad", ValueSlip::AngleUnit),
    ] {
        assert_eq!(way(wrong), Some(Err(slip)), "{wrong}");
    }
    assert_eq!(way("$q_1(t) = a_0 + a_2 t^2$"), None);
    assert_eq!(way("$q_1(t) = 30$"), None);
}

/// The frame of a slide with the other sign is that of the base seen from it, which its name does not say.
#[test]
fn a_slide_with_the_other_sign_is_wrong() {
    let table = "convention: standard\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | 0 | d1 | 0 | 0 |\n\
                 | 2 | θ2 | 0 | a2 | 0 |\n\n";
    let standing = |sign: &str| {
        let text = format!("{table}A_1 = [1, 0, 0, 0; 0, 1, 0, 0; 0, 0, 1, {sign}d1; 0, 0, 0, 1]");
        let checked = check(&text, Format::Markdown, None, &CheckOptions::default()).expect("a table");
        checked.claims[0].standing()
    };
    assert_eq!([standing(""), standing("-")], [Standing::Equal, Standing::Wrong]);
}

/// The marks of a document for items that say what they ask for.
fn marks(text: &str, items: Vec<Item>) -> Vec<Mark> {
    marks_of(TABLE, text, items)
}

fn marks_of(table: &str, text: &str, items: Vec<Item>) -> Vec<Mark> {
    let text = format!("{table}{text}");
    let mut checked = check(&text, Format::Markdown, None, &CheckOptions::default()).expect("a table");
    let rubric = Rubric { title: None, conditional: 0.5, carried: 0.75, items };
    rubric.answer(&text, Format::Markdown, &mut checked);
    rubric.mark(&text, &checked).marks
}

fn item(about: Subject, form: Option<Form>, formulas: usize) -> Item {
    Item { name: "item".into(), points: 12.0, about: vec![about], form, formulas, ..Item::default() }
}

const POSE: &str = "\\begin{pmatrix} C_{12} & -S_{12} & 0 & a_1 C_1 + a_2 C_{12} \\\\ S_{12} & C_{12} & 0 & a_1 S_1 + a_2 S_{12} \\\\ \
                    0 & 0 & 1 & 0 \\\\ 0 & 0 & 0 & 1 \\end{pmatrix}";

#[test]
fn a_pose_is_found_by_what_it_is() {
    let asked = || vec![item(Subject::Pose, Some(Form::Formulas), 6), item(Subject::Links, None, 0)];
    for name in
        ["T_{02}", "{}^0_2T", "T", "T = A_1 A_2", "A_1 A_2", "T_2^0", "T_{0E}", "T_{tool}", "M", "T_2"]
    {
        let found = marks(&format!("$${name} = {POSE}$$"), asked());
        // A product between the name and the matrix is a formula more.
        let count = 6 + usize::from(name.contains('='));
        assert_eq!((found[0].points, found[0].right), (12.0, [count; 2]), "{name}");
        assert_eq!(found[1].right, [0, 0], "{name}");
    }
    // A slip costs its share, whatever the name is.
    let slip = POSE.replace("a_1 S_1", "a_1 C_1");
    for name in ["T_{02}", "T", "T_2^0"] {
        let found = marks(&format!("$${name} = {slip}$$"), asked());
        assert_eq!((found[0].points, found[0].open), (10.0, 0.0), "{name}");
    }
    // A link is no pose.
    let link = "$$A_2 = \\begin{pmatrix} C_2 & -S_2 & 0 & a_2 C_2 \\\\ S_2 & C_2 & 0 & a_2 S_2 \\\\ 0 & 0 & 1 & 0 \\\\ \
                0 & 0 & 0 & 1 \\end{pmatrix}$$";
    assert_eq!(marks(link, asked())[0].right, [0, 0]);
}

/// A name that is that of the inverse earns the points of its value, and it is said.
#[test]
fn a_pose_with_the_name_of_its_inverse_is_one() {
    let text = format!("$$T_0^2 = {POSE}$$");
    let found = marks(&text, vec![item(Subject::Pose, None, 6)]).remove(0);
    assert_eq!((found.points, found.named_otherwise.len()), (12.0, 1), "{found:?}");
}

#[test]
fn numbers_and_formulas_are_apart() {
    let numbers = "With a1 = 1, a2 = 1 and θ1 = 0, θ2 = 90°:\n\n\
                   T_02 = [0.000, -1.000, 0, 1.000; 1.000, 0.000, 0, 1.000; 0, 0, 1, 0; 0, 0, 0, 1]";
    let asked = || {
        let [formulas, numbers] = [Form::Formulas, Form::Numbers].map(|f| item(Subject::Pose, Some(f), 6));
        vec![formulas, numbers]
    };
    let points = |text: &str| marks(text, asked()).iter().map(|m| m.points).collect::<Vec<f64>>();
    assert_eq!(points(numbers), [0.0, 12.0]);
    assert_eq!(points(&format!("$$T = {POSE}$$")), [12.0, 0.0]);
}

/// Both configurations of a pose, of which the second joint changes its sign.
fn configurations() -> Item {
    let asked = |degrees: [f64; 2]| Asked { q: degrees.map(f64::to_radians).to_vec(), within: vec![1e-4; 2] };
    let configurations = vec![asked([30.0, 60.0]), asked([80.0, -60.0])];
    Item { configurations, ..item(Subject::Joints, None, 4) }
}

#[test]
fn configurations_are_marked_however_they_are_told() {
    let points = |text: &str| {
        let mark = marks(text, vec![configurations()]).remove(0);
        (mark.points, mark.open, mark.configurations)
    };
    let all = (12.0, 0.0, Some([2, 2]));
    for text in [
        "θ1 = 30°, θ2 = 60°\n\nθ1 = 80°, θ2 = -60°",
        "$\\theta_1 = 0.5236,\\ \\theta_2 = 1.0472$\n\n$\\theta_1 = 1.3963,\\ \\theta_2 = -1.0472$",
        "q = (30°, 60°)\n\nq = (80°, -60°)",
        "$q = (30^\\circ, 60^\\circ)$ or $q = (80^\\circ, -60^\\circ)$",
        "q = (0.5236, 1.0472)\n\nq = (1.3963, -1.0472)",
        "| # | θ1 | θ2 |\n|-|-|-|\n| 1 | 30° | 60° |\n| 2 | 80° | -60° |",
        "| θ1 (rad) | θ2 (rad) |\n|-|-|\n| 1.3963 | -1.0472 |\n| 0.5236 | 1.0472 |",
        "$q_1 = \\begin{pmatrix} 30^\\circ \\\\ 60^\\circ \\end{pmatrix}$, \
         $q_2 = \\begin{pmatrix} 80^\\circ \\\\ -60^\\circ \\end{pmatrix}$",
        "θ₁ = 30°, θ₂ = 60°\n\nθ₁ = 80°, θ₂ = −60°",
        "$\\theta_1^{(1)} = 30^\\circ$, $\\theta_2^{(1)} = 60^\\circ$\n\n$\\theta_1^{(2)} = 80^\\circ$, $\\theta_2^{(2)} = -60^\\circ$",
        "q1a = 30°, q2a = 60°; q1b = 80°, q2b = -60°",
        "q2 = acos(0.5) = 60°, q1 = 70° - 40° = 30°\n\nq2 = -acos(0.5) = -60°, q1 = 40° + 40° = 80°",
        "1. $\\theta_1 = \\pi/6$, $\\theta_2 = \\frac{\\pi}{3}$\n2. $\\theta_1 = 80°$, $\\theta_2 = -60°$",
    ] {
        assert_eq!(points(text), all, "{text}");
    }
    assert_eq!(points("θ1 = 30°, θ2 = 60°"), (6.0, 0.0, Some([1, 2])));
    // Said twice, it counts once.
    assert_eq!(points("θ1 = 30°, θ2 = 60°\n\nq = (30°, 60°)"), (6.0, 0.0, Some([1, 2])));
    let wrong = marks("θ1 = 30°, θ2 = 60°\n\nθ1 = 80°, θ2 = 60°", vec![configurations()]).remove(0);
    assert_eq!((wrong.points, wrong.slips.len()), (6.0, 1));
    assert_eq!((wrong.slips[0].1, wrong.slips[0].2.as_str()), (ValueSlip::Sign, "(80°, -60°)"));
    // What may be meant otherwise is nothing wrong: a list without a name, the goal, a sentence.
    for more in
        ["(0.5, 0.25)", "[0.8660, 0.5000]", "With both joints at zero, q = (0°, 0°), the arm is stretched."]
    {
        assert_eq!(points(&format!("θ1 = 30°, θ2 = 60°\n\nθ1 = 80°, θ2 = -60°\n\n{more}")), all, "{more}");
        let one = points(&format!("θ1 = 30°, θ2 = 60°\n\n{more}"));
        assert_eq!(one, (6.0, 6.0, Some([1, 2])), "{more}");
    }
    // Digits that are not there are no reason for full points, nor are radians beyond a turn.
    let rounded = points("θ1 = 30°, θ2 = 60°\n\nθ1 = 1, θ2 = -1");
    assert_eq!(rounded, (6.0, 6.0, Some([1, 2])));
    assert_eq!(points("θ1 = 30°, θ2 = 60°\n\nθ1 = 20, θ2 = 18").0, 6.0);
    // Where none is right they may be no answer: by hand.
    for text in ["θ1 = 31°, θ2 = 61.5°", "q = (31°, 61.5°)", "1. (31°, 61.5°)"] {
        let none = points(text);
        assert!(none.0 == 0.0 && none.1 > 0.0, "{text}: {none:?}");
    }
}

/// A configuration counts for the pose that it is told for.
#[test]
fn configurations_belong_to_their_poses() {
    let mut item = configurations();
    item.configurations[1].q = vec![0.2, 0.4];
    let table = TABLE.replace("a1", "0.4").replace("a2", "0.3");
    let points = |text: &str| {
        let mark = marks_of(&table, text, vec![item.clone()]).remove(0);
        (mark.points, mark.open)
    };
    let [first, second] = ["θ1 = 30°, θ2 = 60°", "θ1 = 0.2000, θ2 = 0.4000"];
    for (text, expected) in [
        (format!("## Position 1\n\n{first}\n\n## Position 2\n\n{second}"), (12.0, 0.0)),
        (format!("## Position 1\n\n{second}\n\n## Position 2\n\n{first}"), (0.0, 12.0)),
        (format!("{first}\n\n{second}"), (12.0, 0.0)),
        (format!("{second}\n\n{first}"), (0.0, 12.0)),
    ] {
        assert_eq!(points(&text), expected, "{text}");
    }
}

/// Links that are the same matrix under each name, and one that is told several times.
#[test]
fn a_matrix_counts_once() {
    let link = |k: usize| {
        format!(
            "\\begin{{pmatrix}} C_{k} & -S_{k} & 0 & a_{k} C_{k} \\\\ S_{k} & C_{k} & 0 & a_{k} S_{k} \\\\ 0 & 0 & 1 & 0 \\\\ 0 & 0 & 0 & 1 \\end{{pmatrix}}"
        )
    };
    let points = |names: [&str; 2], of: [usize; 2]| {
        let text = format!("$${} = {}$$\n\n$${} = {}$$", names[0], link(of[0]), names[1], link(of[1]));
        marks(&text, vec![item(Subject::Links, None, 12)]).remove(0).points
    };
    let names = ["T_{01}", "T_{12}"];
    assert_eq!(points(names, [1, 2]), 12.0);
    assert_eq!(points([names[0], names[0]], [1, 1]), 6.0);
    assert!(points(names, [1, 1]) < 11.0);
    assert!(points(names, [2, 1]) < 11.0);
}

#[test]
fn singular_values_are_marked_however_they_are_told() {
    let asked = || {
        let zeros = vec![(2, "0".to_string()), (2, "pi".to_string())];
        vec![Item { zeros, ..item(Subject::Singularities, None, 2) }]
    };
    for (text, points) in [
        ("The arm is singular where sin(θ2) = 0.", 12.0),
        ("The arm is singular for $\\theta_2 \\in \\{0, \\pi\\}$.", 12.0),
        ("The arm is singular for $\\theta_2 = k\\pi$.", 12.0),
        ("The arm is singular for θ2 = 0 or θ2 = 180°.", 12.0),
        ("The arm is singular for $\\theta_2 = 0, \\pi$.", 12.0),
        ("The arm is singular for θ2 = 0.", 6.0),
        ("The arm is singular for θ2 = 90°.", 0.0),
    ] {
        let found = marks(text, asked()).remove(0);
        assert_eq!((found.points, found.open), (points, 0.0), "{text}: {found:?}");
    }
    // What is denied, or stands beside others, is marked by hand.
    for text in [
        "The arm is never singular at θ2 = 0 and it is regular at θ2 = π.",
        "For θ2 = 0, π the determinant is not zero.",
        "Le bras n'est pas singulier pour θ2 = 0, π.",
    ] {
        let found = marks(text, asked()).remove(0);
        assert_eq!((found.points, found.open), (0.0, 12.0), "{text}: {found:?}");
    }
    let determinant = || vec![item(Subject::Determinant, None, 1)];
    for name in ["det J", "|J|", "\\det J"] {
        let found = marks(&format!("${name} = a_1 a_2 S_2$"), determinant()).remove(0);
        assert!(found.points + found.open > 11.9, "{name}: {found:?}");
    }
}
