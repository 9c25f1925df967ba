//! Every formula about velocities that the documents print, held against their own tables.
//!
//! `sources/*_jacobian.toml` holds what is printed, as printed, and the verdict that is expected; the verdict itself is
//! by proof, against Jacobians that are proved to be the derivative of the product of the link transforms. Corrections,
//! and what the documents leave out, are held in the same way. `docs/errata-remarks.md` tells it in words.

use crate::common::printed::{list, read, string, strings, text};
use denavit::catalogue;
use denavit::description::Description;
use denavit::forward::{Proof, Reference};
use denavit::geometry::{Rotation, Transform, Vector};
use denavit::robot::Robot;
use denavit::velocity::{Jacobian, JacobianModel, ROWS, Singularities, Viewpoint, geometric};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Equality, Expr, equal};
use std::collections::{BTreeMap, BTreeSet};
use toml::{Table, Value};

type Matrix = Vec<Vec<Expr>>;

/// Third axes and origins of frames 0 … n, by a table or by what is printed.
struct Frames {
    z: Vec<Vector<Expr>>,
    o: Vec<Vector<Expr>>,
}

impl Frames {
    fn of(transforms: &[Transform<Expr>]) -> Self {
        Frames {
            z: transforms.iter().map(|x| x.rotation.z()).collect(),
            o: transforms.iter().map(|x| x.translation).collect(),
        }
    }

    /// `Z i-1 × (O n - O i-1)` and its like, for joint `i`.
    fn vector(&self, words: &str, i: usize) -> Vector<Expr> {
        if let Some((a, b)) = words.split_once(" × ") {
            return self.vector(a, i).cross(self.vector(b.trim_matches(['(', ')']), i));
        }
        if let Some((a, b)) = words.split_once(" - ") {
            return self.vector(a, i) - self.vector(b, i);
        }
        let Some((kind, k)) = words.split_once(' ') else {
            assert_eq!(words, "0");
            return Vector::zero();
        };
        let k = match k {
            "n" => self.z.len() - 1,
            "i" => i,
            "i-1" => i - 1,
            number => number.parse().expect("a frame's number"),
        };
        if kind == "Z" { self.z[k] } else { self.o[k] }
    }
}

/// A robot, or the first rows of its table, and the names that the document uses.
struct Arm {
    description: Description,
    robot: Robot<Expr>,
    q: Vec<Expr>,
    names: Vocabulary,
    frames: Frames,
}

impl Arm {
    fn new(file: &Table, name: &str, rows: Option<usize>) -> Self {
        let mut description = catalogue::robot(name).expect("a robot of the catalogue");
        let mut names = description.vocabulary();
        description.rows.truncate(rows.unwrap_or(usize::MAX));
        if file["robots"].as_array().is_some_and(|own| own.iter().any(|r| text(r) == name)) {
            for (name, meaning) in file["aliases"].as_table().expect("names") {
                let meaning = read(text(meaning), &names);
                names = names.alias(name, meaning);
            }
            for definition in list(file, "define") {
                let value = read(string(definition, "value"), &names);
                names = names.alias(string(definition, "name"), value);
            }
        }
        let robot = Robot::symbolic(&description);
        let q: Vec<Expr> = description.variables().iter().map(|v| v.symbol.into()).collect();
        let frames = Frames::of(&robot.frames(&q));
        Arm { description, robot, q, names, frames }
    }

    /// The robot of a claim.
    fn of(file: &Table, claim: &Table) -> Self {
        let name = claim.get("robot").map_or_else(|| string(file, "robot"), text);
        Arm::new(file, name, rows_of(claim))
    }

    fn is_prismatic(&self, joint: usize) -> bool {
        self.robot.links[joint - 1].theta.terms.is_empty()
    }

    /// The Jacobian, proved to be the derivative of the forward model.
    fn jacobian(&self, body: usize, at: usize, axes: usize) -> Jacobian<Expr> {
        let model = JacobianModel::derive(&self.description, view(body, at, axes));
        assert_eq!(model.proof, Proof::Proved);
        model.matrix.expect("short formulas")
    }

    /// The Jacobian of the last frame at its own origin, by a table of four formulas.
    fn by_rule(&self, rule: &BTreeMap<(&str, &str), &str>, frames: &Frames) -> Vec<[Expr; 6]> {
        (1..=self.q.len())
            .map(|i| {
                let kind = if self.is_prismatic(i) { "prismatic" } else { "revolute" };
                let [v, w] = ["linear", "rotational"].map(|part| frames.vector(rule[&(kind, part)], i));
                [v[0], v[1], v[2], w[0], w[1], w[2]]
            })
            .collect()
    }
}

fn source(text: &str) -> Table {
    text.parse().expect("TOML")
}

fn rows_of(claim: &Table) -> Option<usize> {
    claim.get("arm").map(|_| number(claim, "arm"))
}

fn number(table: &Table, key: &str) -> usize {
    table[key].as_integer().and_then(|n| usize::try_from(n).ok()).expect("a number")
}

fn view(body: usize, at: usize, axes: usize) -> Viewpoint<Expr> {
    let [body, at, axes] = [body, at, axes].map(Reference::Frame);
    Viewpoint { axes, body, at, offset: Vector::zero() }
}

/// True if proved equal, false if proved different.
fn same(a: Expr, b: Expr) -> bool {
    match equal(a, b) {
        Equality::Equal { .. } => true,
        Equality::Different { .. } => false,
        Equality::Undecided(why) => panic!("{why:?}"),
    }
}

/// The places, `row,column` from 1, at which two matrices differ.
fn differences(a: &Matrix, b: &Matrix) -> BTreeSet<String> {
    assert_eq!((a.len(), a[0].len()), (b.len(), b[0].len()), "matrices of one size");
    let places = (0..a.len()).flat_map(|r| (0..a[0].len()).map(move |c| (r, c)));
    places.filter(|&(r, c)| !same(a[r][c], b[r][c])).map(|(r, c)| format!("{},{}", r + 1, c + 1)).collect()
}

/// Rows of a Jacobian by their names.
fn chosen(jacobian: &Jacobian<Expr>, rows: &[String]) -> Matrix {
    let all = jacobian.rows();
    let at = |name: &String| ROWS.iter().position(|r| r == name).expect("a row's name");
    rows.iter().map(|name| all[at(name)].clone()).collect()
}

/// Vectors side by side.
fn side_by_side(vectors: &[Vector<Expr>]) -> Matrix {
    (0..3).map(|r| vectors.iter().map(|v| v[r]).collect()).collect()
}

fn matrix(rows: &Value, names: &Vocabulary) -> Matrix {
    let row =
        |row: &Value| row.as_array().expect("a row").iter().map(|cell| read(text(cell), names)).collect();
    rows.as_array().expect("rows").iter().map(row).collect()
}

/// The joints of the claim's kind whose columns are not what the rule says.
fn rule_fails(claim: &Table, arm: &Arm) -> BTreeSet<String> {
    let n = arm.robot.links.len();
    let jacobian = arm.jacobian(n, n, 0);
    let first = if string(claim, "part") == "linear" { 0 } else { 3 };
    let joints: Vec<usize> =
        (1..=n).filter(|&i| arm.is_prismatic(i) == (string(claim, "joints") == "prismatic")).collect();
    assert!(!joints.is_empty(), "{} says nothing of this robot", claim["id"]);
    let fails = |i: usize| {
        let (column, rule) = (&jacobian.columns[i - 1], arm.frames.vector(string(claim, "rule"), i));
        (0..3).any(|r| !same(column[first + r], rule[r]))
    };
    joints.into_iter().filter(|&i| fails(i)).map(|i| format!("joint {i}")).collect()
}

/// The places at which a claim is refuted.
fn refuted(claim: &Table, arm: &Arm) -> BTreeSet<String> {
    if claim.contains_key("rule") {
        return rule_fails(claim, arm);
    }
    let printed = matrix(&claim["matrix"], &arm.names);
    if claim.contains_key("columns") {
        let vectors: Vec<_> = strings(claim, "columns").iter().map(|v| arm.frames.vector(v, 0)).collect();
        let mut places = differences(&printed, &side_by_side(&vectors));
        if let Some(rows) = claim.get("determinant") {
            let units = ["i", "j", "k"];
            let names = units.iter().fold(arm.names.clone(), |names, unit| names.symbol(unit));
            let d = matrix(rows, &names);
            let [a, b, c] = [0, 1, 2].map(|r| Vector([d[r][0], d[r][1], d[r][2]]));
            let sum = (0..3).fold(Expr::int(0), |sum, r| sum + Expr::symbol(units[r]) * printed[r][0]);
            places.extend((!same(a.dot(b.cross(c)), sum)).then(|| "determinant".to_string()));
        }
        return places;
    }
    let [body, at, axes] = ["body", "at", "axes"].map(|key| number(claim, key));
    differences(&printed, &chosen(&arm.jacobian(body, at, axes), &strings(claim, "rows")))
}

/// What the rule gives with the printed matrices; `mended` is one of them, taken as corrected.
fn frames_in_print(claim: &Table, arm: &Arm, mended: Option<&str>) -> Frames {
    let forward = source(include_str!("../sources/cylindrical.toml"));
    let claims = list(&forward, "claims");
    let by_id = |id: &str| {
        let claim = claims.iter().find(|c| string(c, "id") == id).expect("a claim of the forward model");
        let mut rows = claim["matrix"].as_array().expect("rows").clone();
        rows.truncate(3);
        let right = claim.get("right").filter(|_| mended == Some(id)).and_then(Value::as_table);
        for (place, formula) in right.into_iter().flatten() {
            let [r, c] = row_and_column(place);
            rows[r][c] = formula.clone();
        }
        matrix(&Value::Array(rows), &arm.names)
    };
    let vector = |id: &str| {
        let m = by_id(id);
        Vector([m[0][0], m[1][0], m[2][0]])
    };
    let transform = |id: &str| {
        let m = by_id(id);
        let rotation = Rotation::from_rows([0, 1, 2].map(|r| [m[r][0], m[r][1], m[r][2]]));
        Transform::from_rotation_translation(rotation, Vector([0, 1, 2].map(|r| m[r][3])))
    };
    let names = claim["by_rule"].as_table().expect("matrices");
    let wrist = ["H4", "H5", "H6"].map(|h| transform(string(names, "H3")) * transform(string(names, h)));
    let Frames { z, o } = Frames::of(&wrist);
    Frames {
        z: (0..=3).map(|k| vector(&format!("PRPRRR-Z{k}"))).chain(z).collect(),
        o: (0..=3).map(|k| vector(&format!("PRPRRR-O{k}"))).chain(o).collect(),
    }
}

/// The columns, from 1, in which the Jacobian by the printed rule and matrices is not that of the table.
fn refuted_columns(file: &Table, claim: &Table, robot: &str, mended: Option<&str>) -> Vec<i64> {
    let arm = Arm::new(file, robot, None);
    let frames = frames_in_print(claim, &arm, mended);
    let claims = list(file, "claims");
    let rules = claims.iter().filter(|c| c.contains_key("rule") && !c.contains_key("arm"));
    let rule: BTreeMap<_, _> =
        rules.map(|c| ((string(c, "joints"), string(c, "part")), string(c, "rule"))).collect();
    let n = arm.q.len();
    let wanted = arm.jacobian(n, n, 0).columns;
    let columns = arm.by_rule(&rule, &frames).into_iter().zip(wanted).enumerate();
    let wrong = columns.filter(|(_, (a, b))| (0..6).any(|r| !same(a[r], b[r])));
    wrong.map(|(j, _)| j as i64 + 1).collect()
}

fn check_by_rule(file: &Table, claim: &Table) -> &'static str {
    let stored = |table: &Table, robot: &str| -> Vec<i64> {
        let columns = table["refuted_columns"][robot].as_array().expect("columns");
        columns.iter().filter_map(Value::as_integer).collect()
    };
    let mended = claim["mended"].as_table().expect("a matrix");
    let mut all_wrong = true;
    for robot in strings(file, "robots") {
        let found = refuted_columns(file, claim, &robot, None);
        assert_eq!(found, stored(claim, &robot), "{robot}");
        all_wrong &= !found.is_empty();
        let found = refuted_columns(file, claim, &robot, Some(string(mended, "matrix")));
        assert_eq!(found, stored(mended, &robot), "{robot}, mended");
    }
    if all_wrong { "wrong" } else { "right" }
}

/// Whether the six velocities determine the rates: the determinant, and the factors that make it 0.
fn check_invertible(file: &Table, claim: &Table) -> &'static str {
    let mut somewhere_singular = false;
    for robot in strings(file, "robots") {
        let arm = Arm::new(file, &robot, None);
        let found = Singularities::derive(&arm.description, Reference::Frame(arm.q.len()))
            .expect("not singular everywhere");
        assert_eq!((found.minors.len(), found.is_complete), (1, true));
        let stored = read(text(&claim["determinant"][&robot]), &arm.names);
        assert!(same(found.minors[0].determinant.to_expr(), stored), "{robot}");
        let stored = claim["singular"][&robot].as_array().expect("factors");
        assert_eq!(found.common.len(), stored.len(), "{robot}");
        for factor in stored {
            let factor = read(text(factor), &arm.names);
            let is_found = |f: Expr| same(f, factor) || same(f, -factor);
            assert!(found.common.iter().any(|s| is_found(s.factor) && s.example.is_some()), "{robot}");
        }
        somewhere_singular |= !stored.is_empty();
    }
    if somewhere_singular { "conditional" } else { "right" }
}

/// The verdict on a claim; the places at which it is refuted are as stored.
fn verdict(file: &Table, claim: &Table) -> &'static str {
    let id = string(claim, "id");
    if claim.contains_key("by_rule") {
        return check_by_rule(file, claim);
    }
    if claim.contains_key("invertible") {
        return check_invertible(file, claim);
    }
    let arm = Arm::of(file, claim);
    let found = refuted(claim, &arm);
    let stored: BTreeSet<String> = strings(claim, "wrong").into_iter().collect();
    assert_eq!(found, stored, "{id}");
    if claim.contains_key("rule") {
        check_conventions(file, claim);
    }
    if !found.is_empty() {
        assert!(refuted(&corrected(claim), &arm).is_empty(), "{id}: the correction");
        check_readings(file, claim, &arm);
    }
    if found.is_empty() { "right" } else { "wrong" }
}

/// The claim with what is given as right in place of what is wrong.
fn corrected(claim: &Table) -> Table {
    let mut corrected = claim.clone();
    let right = claim["right"].as_table().expect("corrections");
    assert!(right.keys().eq(strings(claim, "wrong").iter()), "what is wrong is corrected, and no more");
    for (place, formula) in right {
        put(&mut corrected, place, text(formula));
    }
    corrected
}

fn put(claim: &mut Table, place: &str, formula: &str) {
    let [r, c] = row_and_column(place);
    claim["matrix"][r][c] = formula.into();
}

/// A place `row,column`, which counts from 1, counted from 0.
fn row_and_column(place: &str) -> [usize; 2] {
    let (r, c) = place.split_once(',').expect("a place");
    [r, c].map(|n| n.parse::<usize>().expect("a number") - 1)
}

/// The rule in other robots: where joint i turns about the axis of frame i, it holds with i for i-1 only.
fn check_conventions(file: &Table, claim: &Table) {
    let holds = |robot: &str, rule: &str| {
        let mut claim = claim.clone();
        claim["rule"] = rule.into();
        rule_fails(&claim, &Arm::new(file, robot, rows_of(&claim))).is_empty()
    };
    let rule = string(claim, "rule");
    for robot in strings(file, "robots").iter().chain(&strings(claim, "holds_for")) {
        assert!(holds(robot, rule), "{rule}: {robot}");
    }
    for robot in strings(claim, "fails_for") {
        assert!(!holds(&robot, rule), "{rule}: {robot}");
        assert!(holds(&robot, &rule.replace("i-1", "i")), "{rule}: {robot}");
    }
}

/// No other reading of a wrong Jacobian is right: other rows, points and axes; and the slip is what it is said to be.
fn check_readings(file: &Table, claim: &Table, arm: &Arm) {
    for rows in claim.get("or_rows").and_then(Value::as_array).into_iter().flatten() {
        let mut other = claim.clone();
        other["rows"] = rows.clone();
        assert!(!refuted(&other, arm).is_empty(), "{rows}");
    }
    let slip = claim["slip"].as_table().expect("what is printed instead");
    let column = number(slip, "column");
    let printed = matrix(&claim["matrix"], &arm.names);
    let right = matrix(&corrected(claim)["matrix"], &arm.names);
    for (name, row) in strings(claim, "rows").iter().zip(printed.iter().zip(&right)) {
        let Some(k) = ["wx", "wy", "wz"].iter().position(|w| w == name) else { continue };
        let by = |key| arm.frames.vector(string(slip, key), 0)[k];
        assert!(same(row.0[column - 1], by("vector")) && same(row.1[column - 1], by("instead_of")), "{name}");
    }
    assert_eq!(claim["anywhere"].as_bool(), Some(is_right_anywhere(file, claim)));
    assert!(is_right_anywhere(file, &corrected(claim)));
}

/// Whether there is a point and there are axes, of the arm or of arm and wrist, for which the printed matrix is right,
/// linear rows first or angular ones.
fn is_right_anywhere(file: &Table, claim: &Table) -> bool {
    let angular_first = [3, 4, 5, 0, 1, 2].map(|r| ROWS[r]);
    let exchanged = |name: &String| angular_first[ROWS.iter().position(|r| r == name).expect("a row")];
    let mut readings = vec![strings(claim, "rows")];
    for rows in claim.get("or_rows").and_then(Value::as_array).into_iter().flatten() {
        readings.push(rows.as_array().expect("rows").iter().map(|name| text(name).to_string()).collect());
    }
    for rows in readings.clone() {
        readings.push(rows.iter().map(|name| exchanged(name).to_string()).collect());
    }
    strings(file, "robots").iter().any(|robot| {
        let arm = Arm::new(file, robot, None);
        let printed = matrix(&claim["matrix"], &arm.names);
        let n = arm.q.len();
        let views = (0..=n).flat_map(|at| (0..=n).map(move |axes| (at, axes)));
        views.into_iter().any(|(at, axes)| {
            let jacobian = geometric(&arm.robot, &arm.q, &view(n, at, axes));
            let of_arm = Jacobian { columns: jacobian.columns[..printed[0].len()].to_vec() };
            readings.iter().any(|rows| differ_nowhere(&printed, &chosen(&of_arm, rows)))
        })
    })
}

/// Whether two matrices are equal; the first difference ends it.
fn differ_nowhere(a: &Matrix, b: &Matrix) -> bool {
    a.iter().flatten().zip(b.iter().flatten()).all(|(&a, &b)| same(a, b))
}

fn document() -> Table {
    source(include_str!("../sources/cylindrical_jacobian.toml"))
}

#[test]
fn cylindrical() {
    let file = document();
    let mut counts = BTreeMap::new();
    for claim in list(&file, "claims") {
        let found = verdict(&file, claim);
        assert_eq!(found, string(claim, "verdict"), "{}", claim["id"]);
        *counts.entry(found).or_insert(0) += 1;
    }
    assert_eq!(counts.into_iter().collect::<Vec<_>>(), [("conditional", 1), ("right", 10), ("wrong", 3)]);
}

/// The matrices that the slides leave out, and rates that give the velocities asked for.
#[test]
fn what_is_left_out() {
    let file = document();
    let all: Vec<String> = ROWS.iter().map(|r| r.to_string()).collect();
    for item in list(&file, "omitted") {
        let id = string(item, "id");
        let arm = Arm::of(&file, item);
        let given = matrix(&item["matrix"], &arm.names);
        let n = arm.q.len();
        let places = differences(&given, &chosen(&arm.jacobian(n, number(item, "at"), 0), &all));
        assert_eq!(places, BTreeSet::new(), "{id}");
        if let Some(formula) = item.get("linear_determinant") {
            let [a, b, c] = [0, 1, 2].map(|r| Vector([given[r][0], given[r][1], given[r][2]]));
            assert!(same(a.dot(b.cross(c)), read(text(formula), &arm.names)), "{id}");
        }
        // The velocities are J q̇; the formulas must give q̇ again.
        let rates: Vec<Expr> = (1..=n).map(|j| Expr::symbol(&format!("rate {j}"))).collect();
        let velocities = ["v_x", "v_y", "v_z", "w_x", "w_y", "w_z"].iter().zip(&given);
        let mut names = velocities.fold(arm.names.clone(), |names, (name, row)| {
            names.alias(name, row.iter().zip(&rates).fold(Expr::int(0), |sum, (&e, &rate)| sum + e * rate))
        });
        let mut solved = BTreeSet::new();
        for step in item.get("inverse").and_then(Value::as_array).into_iter().flatten() {
            let (name, value) = (text(&step[0]), read(text(&step[1]), &names));
            if let Some(j) = name.strip_prefix('T') {
                let j: usize = j.parse().expect("a joint");
                assert!(same(value, rates[j - 1]), "{id}: {name}");
                solved.insert(j);
            }
            names = names.alias(name, value);
        }
        assert!(solved.is_empty() || solved.len() == n, "{id}");
    }
}

/// A right formula that is changed is refuted where it is changed.
#[test]
fn a_changed_formula_is_refuted() {
    let file = document();
    let claims = list(&file, "claims");
    let rules: BTreeSet<&str> =
        claims.iter().filter(|c| c.contains_key("rule")).map(|c| string(c, "rule")).collect();
    let mut changed = 0;
    for claim in claims {
        let arm = Arm::of(&file, claim);
        if let Some(rule) = claim.get("rule").map(text) {
            let is_revolute = string(claim, "joints") == "revolute";
            let next = rule.replacen("i-1", "i", 1);
            let others = rules.iter().copied().chain(is_revolute.then_some(&next[..]));
            for other in others.filter(|&other| other != rule) {
                let mut claim = claim.clone();
                claim["rule"] = other.into();
                assert!(!rule_fails(&claim, &arm).is_empty(), "{}: {other}", claim["id"]);
                changed += 1;
            }
        }
        for (r, row) in claim.get("matrix").and_then(Value::as_array).into_iter().flatten().enumerate() {
            for (c, cell) in row.as_array().expect("a row").iter().enumerate() {
                let place = format!("{},{}", r + 1, c + 1);
                let cell = text(cell);
                let turned = (cell != "0").then(|| format!("-({cell})"));
                for formula in turned.into_iter().chain([format!("{cell} + 1")]) {
                    if strings(claim, "wrong").contains(&place) {
                        continue;
                    }
                    let mut claim = claim.clone();
                    put(&mut claim, &place, &formula);
                    assert!(refuted(&claim, &arm).contains(&place), "{}: {place} = {formula}", claim["id"]);
                    changed += 1;
                }
            }
        }
    }
    assert_eq!(changed, 73);
}
