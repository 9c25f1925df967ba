//! What `check` reads and says, statement by statement.

use denavit_check::{
    Change, CheckOptions, Checked, Condition, Finding, Noted, Remark, Standing, TableCell, Unreadable, check,
};
use denavit_reading::code::Dialect;
use denavit_reading::document::Format;

/// A planar arm with two links of its own names.
const PLANAR: &str = "convention: standard\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | a1 | 0 |\n\
                      | 2 | θ2 | 0 | a2 | 0 |\n\n";
/// The first three joints of the Stanford arm in Khalil's convention.
const STANFORD: &str = "convention: khalil\n\n| j | σ | α | d | θ | r |\n|---|---|---|---|---|---|\n| 1 | 0 | 0 | 0 | θ1 | 0 |\n\
                        | 2 | 0 | -90° | 0 | θ2 | R2 |\n| 3 | 1 | 90° | 0 | 0 | r3 |\n\n";

fn checked(table: &str, text: &str) -> Checked {
    let document = format!("{table}{text}\n");
    check(&document, Format::Markdown, None, &CheckOptions::default())
        .unwrap_or_else(|e| panic!("{text}: {e:?}"))
}

/// `name: standing` of each claim, with the formula after the first slip, or what the matrix is instead.
fn said(table: &str, text: &str) -> Vec<String> {
    let all = checked(table, text);
    let claims = all.claims.iter().map(|c| {
        let slip = c.entries.iter().find_map(|e| match &e.finding {
            Finding::Wrong(w) => Some(w.slip.as_ref().map_or("?".into(), |s| format!(" -> {}", s.formula))),
            Finding::Conditional { condition, .. } => Some(format!(" {condition:?}")),
            _ => None,
        });
        let instead = c.instead.map(|i| format!(" -> {i:?}"));
        format!("{}: {}{}", c.name, c.standing().name(), instead.or(slip).unwrap_or_default())
    });
    claims.collect()
}

fn is(table: &str, text: &str, expected: &[&str]) {
    assert_eq!(said(table, text), expected, "{text}");
}

#[test]
fn entries_in_the_notations_of_courses() {
    is(PLANAR, "$$p_x = a_1 C_1 + a_2 C_{12}$$", &["p_x: equal"]);
    is(PLANAR, "P_y = a1*S1 + a2*S12", &["P_y: equal"]);
    is(
        PLANAR,
        r"$$n_x = \cos(\theta_1 + \theta_2), \quad o_x = -\sin(\theta_1+\theta_2)$$",
        &["n_x: equal", "o_x: equal"],
    );
    is(PLANAR, "x = a1.c1 + a2.c1", &["x: wrong -> a1.c1 + a2.c12"]);
    is(PLANAR, "t_{24} = a_1 S_1 - a_2 S_{12}", &["t_{24}: wrong -> a_1 S_1 + a_2 S_{12}"]);
    is(PLANAR, "y = a1 S1", &["y: wrong -> a1 S1 + a2 S12"]);
}

#[test]
fn matrices_by_their_names() {
    let right = r"\begin{bmatrix} C_2 & -S_2 & 0 & a_2 C_2 \\ S_2 & C_2 & 0 & a_2 S_2 \\ 0 & 0 & 1 & 0 \\ 0 & 0 & 0 & 1 \end{bmatrix}";
    for name in ["A_2", "{}^1T_2", "T_{12}", "T_{1,2}", "H_2^1", r"{}^{1}\mathbf{T}_{2}", "^1A_2"] {
        is(PLANAR, &format!("$${name} = {right}$$"), &[&format!("{name}: equal")]);
    }
    is(PLANAR, "T12 = [C2 -S2 0 a2*C2; S2 C2 0 a2*S2; 0 0 1 0; 0 0 0 1]", &["T12: equal"]);
    is(
        PLANAR,
        "$$R_2^1 = \\begin{pmatrix} C_2 & . & 0 \\\\ S_2 & . & 0 \\\\ 0 & 0 & 1 \\end{pmatrix}$$",
        &["R_2^1: equal"],
    );
    is(
        PLANAR,
        "$$A_2^{-1} = \\begin{bmatrix} C_2 & S_2 & 0 & -a_2 \\\\ -S_2 & C_2 & 0 & 0 \\\\ 0 & 0 & 1 & 0 \\\\ 0 & 0 & 0 & 1 \\end{bmatrix}$$",
        &["A_2^{-1}: equal"],
    );
    is(PLANAR, "$${}^0T_2 = {}^0T_1\\,{}^1T_2$$", &["{}^0T_2: equal"]);
    is(PLANAR, "$${}^0T_2 = {}^1T_2\\,{}^0T_1$$", &["{}^0T_2: wrong?"]);
}

#[test]
fn a_matrix_wrong_as_a_whole_is_named() {
    let t = r"\begin{bmatrix} C_1 & S_1 & 0 & a_1 C_1 \\ -S_1 & C_1 & 0 & a_1 S_1 \\ 0 & 0 & 1 & 0 \\ 0 & 0 & 0 & 1 \end{bmatrix}";
    is(PLANAR, &format!("$$A_1 = {t}$$"), &["A_1: wrong -> RotationTransposed"]);
    let inverse = r"\begin{bmatrix} C_1 & S_1 & 0 & -a_1 \\ -S_1 & C_1 & 0 & 0 \\ 0 & 0 & 1 & 0 \\ 0 & 0 & 0 & 1 \end{bmatrix}";
    is(PLANAR, &format!("$$A_1 = {inverse}$$"), &["A_1: wrong -> Inverse"]);
    let other = r"\begin{bmatrix} C_2 & -S_2 & 0 & a_2 C_2 \\ S_2 & C_2 & 0 & a_2 S_2 \\ 0 & 0 & 1 & 0 \\ 0 & 0 & 0 & 1 \end{bmatrix}";
    is(PLANAR, &format!("$$A_1 = {other}$$"), &["A_1: wrong -> Frame { of: 2, seen_from: 1 }"]);
}

#[test]
fn a_cell_of_the_table_explains_many_errors() {
    let text = "n_x = C1 C2\n\nn_y = S1 C2\n\na_x = -C1 S2\n\na_y = -S1 S2\n\na_z = C2\n\nP_x = R2 S1 - r3 C1 S2\n\nP_y = -R2 C1 - r3 S1 S2\n\nP_z = r3 C2";
    let all = checked(STANFORD, text);
    let exchanged = TableCell { letter: "α".into(), row: 2 };
    assert_eq!(all.causes[0].change, Change::ExchangedWithNext(exchanged));
    assert!(all.causes[0].turns_wrong.is_empty() && all.causes[0].turns_right.len() >= 4);
}

#[test]
fn definitions_are_used_and_a_slip_in_one_is_found_through_its_results() {
    let right = "D1 = a_1 + a_2 C_2\n\nD2 = a_2 S_2\n\nx = C_1 D1 - S_1 D2\n\ny = S_1 D1 + C_1 D2";
    is(PLANAR, right, &["D1: equal", "D2: equal", "x: equal", "y: equal"]);
    let all = checked(PLANAR, &right.replace("D1 = a_1 + a_2 C_2", "D1 = a_1 + a_2 S_2"));
    let cause = all.causes.first().expect("a cause");
    let slip = cause.slip.as_ref().expect("a slip");
    assert_eq!((slip.formula.as_str(), cause.turns_right.len()), ("a_1 + a_2 C_2", 2), "{:?}", cause.change);
}

#[test]
fn jacobians_and_determinants() {
    let j = |c: &str| {
        format!(
            r"$$J = \begin{{bmatrix}} -a_1 S_1 - a_2 S_{{12}} & -a_2 S_{{12}} \\ a_1 C_1 + a_2 C_{{12}} & {c} \end{{bmatrix}}$$"
        )
    };
    is(PLANAR, &j("a_2 C_{12}"), &["J: equal"]);
    is(PLANAR, &j("a_2 C_1"), &["J: wrong -> a_2 C_{12}"]);
    is(PLANAR, r"$$\det J = a_1 a_2 S_2$$", &[r"\det J: equal"]);
    is(PLANAR, "$$|J| = a_1 a_2 C_2$$", &["|J|: wrong -> a_1 a_2 S_2"]);
}

#[test]
fn values_of_joints() {
    let elbow =
        |sign: &str| format!(r"$$\theta_2 = {sign}\arccos\frac{{x^2 + y^2 - a_1^2 - a_2^2}}{{2 a_1 a_2}}$$");
    is(PLANAR, &elbow(r"\pm"), &[r"\theta_2: equal"]);
    let one = checked(PLANAR, &elbow(""));
    let Finding::Conditional { condition, .. } = &one.claims[0].entries[0].finding else { panic!("{one:?}") };
    let Condition::Incomplete(Some(missing)) = condition else { panic!("{condition:?}") };
    assert_eq!((missing.given, missing.existing), (1, 2));
    let wrong = elbow(r"\pm").replace("- a_2^2", "+ a_2^2");
    assert!(said(PLANAR, &wrong)[0].starts_with(r"\theta_2: wrong"));
}

#[test]
fn numbers_at_a_stated_configuration() {
    let table = PLANAR.replace("a1", "0.5").replace("a2", "0.3");
    is(&table, "θ1 = 30°, θ2 = 45°\n\nx = 0.511\n\ny = 0.61", &["x: equal", "y: wrong?"]);
    is(&table, "$$q = [30, 45]$$\n\n$$x = 0.5107$$", &["x: equal"]);
    let all = checked(&table, "θ1 = 30°, θ2 = 45°\n\nx = 0.354");
    let Finding::Wrong(wrong) = &all.claims[0].entries[0].finding else { panic!("{:?}", all.claims) };
    assert!(wrong.remarks == [Remark::AngleUnit], "{:?}", wrong.remarks);
}

#[test]
fn programs_are_read_not_run() {
    let python = "import numpy as np\n\ndef fk(q, a1, a2):\n    c1, s1 = np.cos(q[0]), np.sin(q[0])\n    \
                  c12, s12 = np.cos(q[0] + q[1]), np.sin(q[0] + q[1])\n    \
                  return np.array([[c12, -s12, 0, a1*c1 + a2*c12],\n                     \
                  [s12, c12, 0, a1*s1 + a2*c12],\n                     [0, 0, 1, 0],\n                     [0, 0, 0, 1]])\n";
    let block = format!("```python\n{python}```");
    is(PLANAR, &block, &["fk(…): wrong -> a1*s1 + a2*s12"]);
    is(PLANAR, &block.replace("a1*s1 + a2*c12", "a1*s1 + a2*s12"), &["fk(…): equal"]);
    let loops = "```python\ndef fk(q):\n    while True:\n        q = q + 1\n    return q\n```";
    let all = checked(PLANAR, loops);
    assert!(
        all.claims.is_empty() && all.notes.iter().any(|n| matches!(n.what, Noted::NotRead(_))),
        "{:?}",
        all.notes
    );
    let matlab = "function p = fk(q)\n  a1 = 0.5; a2 = 0.3;\n  p = [a1*cos(q(1)) + a2*cos(q(1)+q(2)); a1*sin(q(1)) + a2*sin(q(1)+q(2)); 0];\nend\n";
    let table = PLANAR.replace("| a1 |", "| 0.5 |").replace("| a2 |", "| 0.3 |");
    let (robot, _) = denavit::description::read_table(
        &table,
        denavit::description::TableKind::Markdown,
        &denavit::description::TableOptions::default(),
    )
    .expect("a table");
    let options = CheckOptions { language: Some(Dialect::Matlab), ..CheckOptions::default() };
    let all = check(matlab, Format::Plain, Some(&robot), &options).expect("a program");
    assert_eq!(all.claims.len(), 1);
    assert_eq!(all.claims[0].standing(), Standing::Equal, "{:?}", all.claims[0]);
}

#[test]
fn directives() {
    is(PLANAR, "<!-- check: claim T02 1,4 -->\n$$r = a_1 C_1 + a_2 C_{12}$$", &["r: equal"]);
    is(PLANAR, "<!-- check: alias L = a_2 -->\n$$x = a_1 C_1 + L C_{12}$$", &["x: equal"]);
    is(PLANAR, "<!-- check: skip -->\n$$x = 0$$\n\n$$y = a_1 S_1 + a_2 S_{12}$$", &["y: equal"]);
    is(PLANAR, "<!-- check: rows 1 -->\n$$x = a_1 C_1$$", &["x: equal"]);
    is(PLANAR, "<!-- check: tool b, 0, 0 -->\n$$x = a_1 C_1 + (a_2 + b) C_{12}$$", &["x: equal"]);
}

#[test]
fn what_cannot_be_read_says_where() {
    let all = checked(PLANAR, "$$p_x = a_1 C_1 + foo C_{12}$$");
    let Finding::Unreadable(errors) = &all.claims[0].entries[0].finding else { panic!("{:?}", all.claims) };
    assert!(
        matches!(&errors[0].why, Unreadable::Syntax { message, .. } if message.contains("foo")),
        "{errors:?}"
    );
    let none = check("# Nothing\n\nx = 3\n", Format::Markdown, None, &CheckOptions::default());
    assert!(none.is_err_and(|e| e[0].what == Noted::NoRobot));
}

#[test]
fn toml_says_what_each_claim_is() {
    let text = "[[claims]]\nclaim = \"A1\"\nmatrix = [['C1', '-S1', '0', 'a1*C1'], ['S1', 'C1', '0', 'a1*S1'], ['0', '0', '1', '0'], ['0', '0', '0', '1']]\n";
    let table = denavit::description::read_table(
        PLANAR,
        denavit::description::TableKind::Markdown,
        &denavit::description::TableOptions::default(),
    );
    let robot = table.expect("a table").0;
    let all = check(text, Format::Toml, Some(&robot), &CheckOptions::default()).expect("claims");
    assert_eq!(all.tally().equal, 1, "{:?}", all.claims);
}

/// Values of joints that agree in numbers alone are not called proved, however near they are.
#[test]
fn what_is_not_proved_is_not_called_so() {
    let right = "θ_12 = atan2(n_y, n_x)";
    let almost = [
        "θ_12 = atan2(n_y, n_x) + 1/10000000",
        "θ_12 = atan2(n_y, n_x + 0.000001)",
        "θ_12 = atan2(n_y*(n_x + 99999/100000), n_x*(n_x + 99999/100000))",
    ];
    assert_eq!(checked(PLANAR, right).tally().equal, 1);
    for text in almost {
        let all = checked(PLANAR, text);
        assert_eq!((all.claims.len(), all.tally().equal), (1, 0), "{text}: {:?}", all.claims);
    }
}
