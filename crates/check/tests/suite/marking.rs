//! Points by a rubric.

use denavit_check::marking::{Item, Mark, Rubric};
use denavit_check::{Answer, CheckOptions, Standing, ValueSlip, check};
use denavit_reading::document::Format;

const TABLE: &str = "convention: standard\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | a1 | 0 |\n\
                     | 2 | θ2 | 0 | a2 | 0 |\n\n";

/// What a document earns for one item of 12 points.
fn mark(text: &str, claims: &[&str], whole: bool) -> Mark {
    let text = format!("{TABLE}{text}");
    let checked = check(&text, Format::Markdown, None, &CheckOptions::default()).expect("a table");
    let claims = claims.iter().map(|c| (*c).to_string()).collect();
    let items = vec![Item { name: "item".into(), claims, points: 12.0, whole, formulas: 0, answers: vec![] }];
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
    let item = Item {
        name: "item".into(),
        claims: vec![],
        points: 3.0,
        whole: false,
        formulas: 0,
        answers: vec![answer],
    };
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
