//! Printed inverse formulas through `denavit_check::inverse`: the verdicts are those of the documents' claims
//! (`sources/*_inverse.toml`), and what is changed in a right formula is found.

use crate::common::printed::{formulas, list, read, string, text, values};
use denavit::catalogue;
use denavit::description::Description;
use denavit::geometry::Transform;
use denavit::geometry::orientation::{EulerSet, OrientationSet};
use denavit::inverse::Goal;
use denavit::robot::Robot;
use denavit_check::inverse::{
    Cause, Fault, Inverse, Judgement, Origin, Undecided, Values, Verdict, Where, orientation,
};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Symbol, equal};
use std::collections::BTreeMap;
use toml::{Table, Value};

const COLUMNS: [&str; 4] = ["n", "o", "a", "p"];

fn pose() -> [[Symbol; 4]; 3] {
    ["x", "y", "z"].map(|r| COLUMNS.map(|c| Symbol::new(&format!("{c}{r}"))))
}

fn robot(name: &str) -> Description {
    catalogue::robot(name).expect("a robot of the catalogue")
}

/// A robot of a file's claims, and the names its formulas use.
struct Document {
    description: Description,
    names: Vocabulary,
}

impl Document {
    fn new(file: &Table, robot_name: &str, change: Option<&str>) -> Self {
        let mut description = robot(robot_name);
        if change.is_some() {
            description.rows[4].alpha = -description.rows[4].alpha;
        }
        let mut names = description.vocabulary();
        for (name, meaning) in file.get("aliases").and_then(Value::as_table).into_iter().flatten() {
            let meaning = read(text(meaning), &names);
            names = names.alias(name, meaning);
        }
        for (column, row) in COLUMNS.iter().flat_map(|c| ["x", "y", "z"].map(|r| (c, r))) {
            names = names.symbol(&format!("{column}{row}"));
        }
        for definition in list(file, "define") {
            let value = read(string(definition, "value"), &names);
            names = names.alias(string(definition, "name"), value);
        }
        Document { description, names }
    }

    fn inverse(&self) -> Inverse<'_> {
        Inverse::new(&self.description, pose(), Goal::Pose)
    }
}

fn word(j: &Judgement) -> &'static str {
    match j.verdict {
        Verdict::Right => "right",
        Verdict::Conditional => "conditional",
        Verdict::Incomplete => "incomplete",
        Verdict::Wrong => "wrong",
        Verdict::Undecided(_) => "undecided",
    }
}

fn sides(equation: &str, names: &Vocabulary) -> (Expr, Expr) {
    let (left, right) = equation.split_once('=').expect("an equation");
    (read(left.trim(), names), read(right.trim(), names))
}

/// The product of the link transforms between two frames.
fn transform(d: &Description, from: usize, to: usize) -> Transform<Expr> {
    let robot = Robot::symbolic(d);
    let q: Vec<Expr> = d.variables().iter().map(|v| v.symbol.into()).collect();
    robot.links[from..to].iter().fold(Transform::identity(), |x, link| x * link.transform(&q))
}

/// The judgements on a claim: several for a matrix or for several readings. Nothing for other kinds of claims.
fn judged(claim: &Table, document: &Document, inverse: &mut Inverse) -> Vec<Judgement> {
    let names = &document.names;
    if let Some(equation) = claim.get("equation") {
        let (left, right) = sides(text(equation), names);
        return vec![inverse.equation(left, right)];
    }
    if let Some(rows) = claim.get("matrix").and_then(Value::as_array) {
        let of: Vec<&str> = string(claim, "of").split(' ').collect();
        let frame = |k: usize| of[k].parse().expect("a frame");
        let wanted = transform(&document.description, frame(1), frame(2)).matrix();
        let cells = rows.iter().enumerate().flat_map(|(r, row)| {
            let row = row.as_array().expect("a row").iter().enumerate();
            row.map(move |(c, cell)| (r, c, text(cell)))
        });
        return cells.map(|(r, c, cell)| inverse.equation(read(cell, names), wanted[r][c])).collect();
    }
    if !claim.contains_key("values") {
        return vec![];
    }
    let readings = list(claim, "readings");
    let readings =
        if readings.is_empty() { vec![Table::new()] } else { readings.into_iter().cloned().collect() };
    let judge = |reading: &Table| {
        let mut names = document.names.clone();
        for (name, meaning) in reading {
            names = names.alias(name, read(text(meaning), &document.names));
        }
        let of_first_rows = claim.get("arm").and_then(Value::as_integer).map(|n| n as usize);
        let v = Values { of: formulas(claim, "of", &names), branches: values(claim, &names), of_first_rows };
        inverse.values(&v, &formulas(claim, "known", &names))
    };
    readings.iter().map(judge).collect()
}

/// Each condition that was found has the sign of the file's, wherever the arm is.
fn same_signs(id: &str, d: &Description, found: &[Where], told: &[Expr]) {
    assert_eq!(found.len(), told.len(), "{id}");
    let q: Vec<Symbol> = d.variables().iter().map(|v| v.symbol).collect();
    let matrix = Robot::symbolic(d).pose(&q.iter().map(|&v| v.into()).collect::<Vec<Expr>>()).matrix();
    let by_table = |e: Expr| {
        let at = |s: Symbol| (0..12).find(|k| pose()[k / 4][k % 4] == s).map(|k| matrix[k / 4][k % 4]);
        e.substitute(at)
    };
    for (found, &told) in found.iter().zip(told) {
        let Where::If(conditions) = found else { panic!("{id}: {found:?}") };
        let [condition] = conditions[..] else { panic!("{id}: {conditions:?}") };
        let product = by_table(condition * told);
        for n in 1..100 {
            let joint =
                |s: Symbol| q.iter().position(|&v| v == s).map(|j| f64::from(n) * (1.7 + j as f64).sqrt());
            let value = product.eval(|s| joint(s).or_else(|| d.value(s)).or(Some(0.4))).expect("numbers");
            assert!(value > 0.0, "{id}: {condition} and {told}");
        }
    }
}

/// Checks all claims of a file that are about inverse formulas.
fn check(file: &str, change: Option<&str>) -> BTreeMap<String, usize> {
    let file: Table = file.parse().expect("TOML");
    let document = Document::new(&file, string(&file, "robot"), change);
    let mut inverse = document.inverse();
    let mut counts = BTreeMap::new();
    for claim in list(&file, "claims").into_iter().filter(|c| !c.contains_key("robot")) {
        let id = string(claim, "id");
        let key = if change.is_some() && claim.contains_key("hypothesis") { "hypothesis" } else { "verdict" };
        let expected = string(claim, key);
        for j in judged(claim, &document, &mut inverse) {
            assert_eq!(word(&j), expected, "{id}: {j:?}");
            *counts.entry(expected.to_string()).or_default() += 1;
            let is_value = claim.contains_key("values");
            assert_eq!(j.counterexample.is_some(), expected != "right", "{id}");
            if is_value && expected != "right" {
                assert!(j.faults.iter().any(|f| !f.is_remark()), "{id}");
            }
            if expected == "conditional" {
                let told: Vec<Expr> = formulas(claim, "where", &document.names);
                same_signs(id, &document.description, &j.branches, &told);
            }
        }
    }
    for omitted in list(&file, "omitted").into_iter().filter(|c| !c.contains_key("robot")) {
        for j in judged(omitted, &document, &mut inverse) {
            assert_eq!(word(&j), "right", "{}: {j:?}", string(omitted, "id"));
        }
    }
    counts
}

#[test]
fn the_claims_of_the_ur3_report() {
    let counts = check(include_str!("../../../robot/tests/sources/ur3_inverse.toml"), None);
    // Two matrices count by entry.
    assert_eq!(
        counts,
        [("conditional", 2), ("right", 38), ("wrong", 14)].map(|(k, n)| (k.to_string(), n)).into()
    );
}

#[test]
fn the_claims_of_the_ur3_report_with_the_likely_table() {
    check(include_str!("../../../robot/tests/sources/ur3_inverse.toml"), Some("alpha5"));
}

#[test]
fn the_claims_of_the_cylindrical_arm() {
    let counts = check(include_str!("../../../robot/tests/sources/cylindrical_inverse.toml"), None);
    // One claim in two readings.
    assert_eq!(counts, [("conditional", 1), ("wrong", 2)].map(|(k, n)| (k.to_string(), n)).into());
}

/// A formula of the UR3's, in the names of the report.
fn of_ur3(document: &Document, of: &str, branches: &[&str]) -> Values {
    let one = |formula: &&str| vec![read(formula, &document.names)];
    Values {
        of: vec![read(of, &document.names)],
        branches: branches.iter().map(one).collect(),
        of_first_rows: None,
    }
}

/// Each change in a right formula is found, and a right formula is proposed which is judged right.
#[test]
fn what_is_changed_in_a_right_formula_is_found() {
    let file: Table = include_str!("../../../robot/tests/sources/ur3_inverse.toml").parse().expect("TOML");
    let document = Document::new(&file, "ur3-lab", None);
    let mut inverse = document.inverse();
    let right_1 = ["atan2(Y, X) + atan2(D, sqrt(X^2+Y^2-D^2))", "atan2(Y, X) + atan2(D, -sqrt(X^2+Y^2-D^2))"];
    let right_5 = [
        "atan2(sqrt(1-(S_1 a_x - C_1 a_y)^2), S_1 a_x - C_1 a_y)",
        "-atan2(sqrt(1-(S_1 a_x - C_1 a_y)^2), S_1 a_x - C_1 a_y)",
    ];
    let w = "(U^2 + V^2 - a_2^2 - a_3^2)/(2 a_2 a_3)";
    let right_3 = [format!("atan2(sqrt(1-({w})^2), {w})"), format!("-atan2(sqrt(1-({w})^2), {w})")];
    let right_3: Vec<&str> = right_3.iter().map(String::as_str).collect();
    let right_2 = ["atan2((C_3 a_3 + a_2) V - S_3 a_3 U, (C_3 a_3 + a_2) U + S_3 a_3 V)"];
    let right_6 = [r"atan2(-\frac{C_1 o_y - S_1 o_x}{S_5}, \frac{C_1 n_y - S_1 n_x}{S_5})"];
    let short = "((C_1 p_x + S_1 p_y)^2 + (d_1 - p_z)^2 - a_2^2 - a_3^2)/(2 a_2 a_3)";
    let short = format!("atan2(sqrt(1-({short})^2), {short})");
    type Row<'a> = (&'a str, &'a [&'a str], Vec<&'a str>, &'a str, &'a str);
    let rows: Vec<Row> = vec![
        ("θ_1", &[], right_1.to_vec(), "right", "proved"),
        ("θ_1", &[], vec![right_1[0]], "incomplete", "mended"),
        ("θ_1", &[], vec!["atan2(Y/X, 1) + atan2(D, sqrt(X^2+Y^2-D^2))"], "conditional", "mended"),
        ("θ_1", &[], vec!["atan2(Y, X) - atan2(D, sqrt(X^2+Y^2-D^2))"], "wrong", "mended"),
        ("θ_1", &[], vec!["atan2(p_y, p_x) + atan2(D, sqrt(p_x^2+p_y^2-D^2))"], "wrong", "derived"),
        ("θ_5", &["θ_1"], right_5.to_vec(), "right", "proved"),
        ("θ_5", &["θ_1"], vec![right_5[1]], "incomplete", "mended"),
        ("θ_5", &["θ_1"], vec!["atan2(S_1 a_x - C_1 a_y, 1)"], "wrong", "derived"),
        ("θ_6", &["θ_1", "θ_5"], right_6.to_vec(), "right", "proved"),
        (
            "θ_6",
            &["θ_1", "θ_5"],
            vec!["atan2(-(C_1 o_y - S_1 o_x), C_1 n_y - S_1 n_x)"],
            "conditional",
            "entries",
        ),
        (
            "θ_6",
            &["θ_1", "θ_5"],
            vec![r"atan2(-\frac{C_1 o_y - S_1 o_x}{C_1 n_y - S_1 n_x}, 1)"],
            "conditional",
            "entries",
        ),
        ("θ_3", &["θ_1", "θ_5", "θ_{234}"], right_3.clone(), "right", "proved"),
        ("θ_3", &["θ_1", "θ_5", "θ_{234}"], vec![right_3[0]], "incomplete", "mended"),
        ("θ_3", &["θ_1", "θ_5", "θ_{234}"], vec![&short], "wrong", "derived"),
        ("θ_2", &["θ_1", "θ_5", "θ_{234}", "θ_3"], right_2.to_vec(), "right", "proved"),
        (
            "θ_2",
            &["θ_1", "θ_5", "θ_{234}", "θ_3"],
            vec!["atan2((C_3 a_3 + a_2) V + S_3 a_3 U, (C_3 a_3 + a_2) U + S_3 a_3 V)"],
            "wrong",
            "derived",
        ),
        ("θ_4", &["θ_{234}", "θ_2", "θ_3"], vec!["θ_{234} - θ_2 + θ_3"], "wrong", "derived"),
    ];
    for (of, known, branches, verdict, right) in rows {
        let v = of_ur3(&document, of, &branches);
        let known: Vec<Expr> = known.iter().map(|k| read(k, &document.names)).collect();
        let j = inverse.values(&v, &known);
        assert_eq!(word(&j), verdict, "{of} = {branches:?}: {j:?}");
        if right == "proved" {
            assert!(j.grounds.proved && j.right.is_none() && j.missing.is_none(), "{of}: {j:?}");
            assert!(j.faults.iter().all(Fault::is_remark), "{of}: {:?}", j.faults);
            continue;
        }
        let proposed = j.right.expect("a right formula");
        let origin = match right {
            "mended" => Origin::Mended,
            "entries" => Origin::Entries,
            _ => Origin::Derived,
        };
        assert_eq!(proposed.origin, origin, "{of} = {branches:?}");
        let v = Values { of: proposed.of, branches: proposed.branches, of_first_rows: None };
        let again = inverse.values(&v, &proposed.known);
        assert_eq!(word(&again), "right", "{of}: {:?}", v.branches);
    }
}

/// All formulas of the report together find nothing; the right ones find all.
#[test]
fn formulas_one_after_another() {
    let file: Table = include_str!("../../../robot/tests/sources/ur3_inverse.toml").parse().expect("TOML");
    let document = Document::new(&file, "ur3-lab", None);
    let mut inverse = document.inverse();
    let procedure = list(&file, "procedures")[0];
    for (is_right, key) in [(true, "right"), (false, "values")] {
        let steps: Vec<Values> = crate::common::printed::strings(procedure, "steps")
            .iter()
            .map(|id| {
                let claim =
                    list(&file, "claims").into_iter().find(|c| string(c, "id") == id).expect("a claim");
                let corrected = claim.get(key).and_then(Value::as_table).unwrap_or(claim);
                let of = formulas(claim, "of", &document.names);
                Values { of, branches: values(corrected, &document.names), of_first_rows: None }
            })
            .collect();
        let c = inverse.composed(&steps).expect("known symbols");
        assert!(c.open.is_empty() && c.poses >= 50);
        if is_right {
            assert_eq!((c.yielded, c.spurious), (c.existing, 0));
        } else {
            assert_eq!(c.yielded, 0);
            assert!(c.spurious > 0);
        }
        assert_eq!(inverse.composed(&steps[..3]).expect("known symbols").open.len(), 3);
    }
}

fn entries() -> [[Symbol; 3]; 3] {
    [1, 2, 3].map(|r| [1, 2, 3].map(|c| Symbol::new(&format!("r{r}{c}"))))
}

fn angles(formulas: [&str; 3], set: OrientationSet) -> Vec<(String, Expr)> {
    let names = entries().iter().flatten().fold(Vocabulary::new(), |v, s| v.symbol(&s.name()));
    let pairs = set.names().iter().zip(formulas);
    pairs.map(|(n, f)| ((*n).to_string(), read(f, &names))).collect()
}

/// The angles of 004: ψ of roll-pitch-yaw has a sign too many, the others are right.
#[test]
fn the_angles_of_004() {
    let zyz = OrientationSet::Euler(EulerSet::ZYZ);
    let zyx = OrientationSet::Euler(EulerSet::ZYX);
    let of_zyz = ["atan2(r23, r13)", "atan2(sqrt(r13^2 + r23^2), r33)", "atan2(r32, -r31)"];
    let found = orientation(zyz, &angles(of_zyz, zyz), &entries()).expect("angles");
    for (name, j) in &found.angles {
        assert_eq!((j.verdict, j.grounds.proved), (Verdict::Right, true), "{name}: {j:?}");
    }
    assert_eq!(found.range, Expr::symbol("angle theta").sin());

    let of_rpy = ["atan2(r21, r11)", "atan2(-r31, sqrt(r32^2 + r33^2))", "atan2(r32, -r33)"];
    let found = orientation(zyx, &angles(of_rpy, zyx), &entries()).expect("angles");
    let verdicts: Vec<&str> = found.angles.iter().map(|a| word(&a.1)).collect();
    assert_eq!(verdicts, ["right", "right", "wrong"]);
    let right = found.angles[2].1.right.as_ref().expect("a right formula");
    assert!(equal(right.branches[0][0], angles(["r32", "r33", "atan2(r32, r33)"], zyx)[2].1).is_equal());

    // The other range, and an arctangent of a quotient.
    let other = ["atan2(-r23, -r13)", "atan2(-sqrt(r13^2 + r23^2), r33)", "atan2(-r32/r31, 1)"];
    let found = orientation(zyz, &angles(other, zyz), &entries()).expect("angles");
    assert_eq!(found.range, -Expr::symbol("angle theta").sin());
    let verdicts: Vec<&str> = found.angles.iter().map(|a| word(&a.1)).collect();
    assert_eq!(verdicts, ["right", "right", "conditional"]);
    let last = &found.angles[2].1;
    assert!(matches!(&last.faults[0], Fault::WrongQuadrant { cause: Cause::Arctan, .. }), "{last:?}");
    assert_eq!(last.right.as_ref().expect("mended").origin, Origin::Mended);
}

/// What is no formula for the arm is refused with a reason.
#[test]
fn refusals() {
    let d = robot("planar-2r");
    let mut inverse = Inverse::new(&d, pose(), Goal::Position);
    let q = |n: u32| Expr::symbol(&format!("q{n}"));
    let one =
        |of: Expr, value: Expr| Values { of: vec![of], branches: vec![vec![value]], of_first_rows: None };
    let x = Symbol::new("nobody");
    let mut why = |v: Values| match inverse.values(&v, &[]).verdict {
        Verdict::Undecided(why) => why,
        other => panic!("{other:?}"),
    };
    assert_eq!(why(one(q(1), x.into())), Undecided::UnknownSymbol(x));
    assert_eq!(why(one(q(1), q(1) + Expr::symbol("px"))), Undecided::Circular);
    assert_eq!(why(one(q(1), (-Expr::int(1)).sqrt())), Undecided::NeverDefined);
    assert_eq!(why(one(q(1), Expr::int(1) / Expr::int(0))), Undecided::NeverDefined);
    assert_eq!(why(Values { of: vec![q(1)], branches: vec![vec![]], of_first_rows: None }), Undecided::Shape);
    assert_eq!(
        why(Values { of: vec![q(1)], branches: vec![vec![q(2)]], of_first_rows: Some(0) }),
        Undecided::NoSamples
    );
}

/// A formula that is right for no robot is found wrong for each, and what is proposed is right.
#[test]
fn proposals_are_right() {
    // For joints that the derivation takes as given, and for arms without closed form, nothing derived is proposed.
    let robots = [
        ("puma560", 6),
        ("stanford", 6),
        ("ur5", 6),
        ("scara", 4),
        ("kuka-kr6-r900", 6),
        ("staubli-rx90", 6),
        ("cylindrical-wrist", 6),
        ("prrrrp", 5),
        ("franka-panda", 6),
        ("smart5-six-rail", 6),
        ("oblique-6r", 0),
        ("planar-3r", 3),
        ("abb-gofa-crb15000-5", 0),
        ("rhino-xr3", 5),
    ];
    for (name, expected) in robots {
        let d = robot(name);
        let mut inverse = Inverse::new(&d, pose(), Goal::Pose);
        let mut proposed = 0;
        for v in d.variables() {
            let of = vec![Expr::from(v.symbol)];
            let nonsense = vec![vec![Expr::symbol("px") + Expr::symbol("ny")]];
            let j = inverse.values(&Values { of, branches: nonsense, of_first_rows: None }, &[]);
            assert_eq!(word(&j), "wrong", "{name}");
            let Some(right) = j.right else { continue };
            let v = Values { of: right.of, branches: right.branches, of_first_rows: None };
            assert_eq!(word(&inverse.values(&v, &right.known)), "right", "{name}: {v:?}");
            proposed += 1;
        }
        assert_eq!(proposed, expected, "{name}");
    }
}
