//! Every formula and matrix that the five documents print in their forward models, held against their own tables.
//!
//! `sources/*.toml` holds what is printed, as printed, and the verdict that is expected; the verdict itself is by
//! proof. `docs/errata.md` tells the refuted ones in words.

use denavit::catalogue;
use denavit::description::{Description, read_toml};
use denavit::geometry::orientation::{OrientationSet, extraction_formulas};
use denavit::geometry::{Axis, Rotation, Transform};
use denavit::robot::Robot;
use denavit_symbolic::parse::{parse, parse_angle};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Verdict, equal};
use std::collections::BTreeSet;
use toml::{Table, Value};

type Matrix = Vec<Vec<Expr>>;

/// A document's robot, and the names that the document uses.
struct Context {
    robot: Option<Description>,
    names: Vocabulary,
}

impl Context {
    fn new(file: &Table, robot: &str) -> Self {
        let robot = catalogue::text(robot).map(|text| read_toml(text).expect("a catalogue robot").0);
        let mut names = robot.as_ref().map_or_else(Vocabulary::new, Description::vocabulary);
        for (name, meaning) in file.get("aliases").and_then(Value::as_table).into_iter().flatten() {
            let meaning = read(text(meaning), &names);
            names = names.alias(name, meaning);
        }
        for definition in list(file, "define") {
            let value = read(string(definition, "value"), &names);
            names = names.alias(string(definition, "name"), value);
        }
        Context { robot, names }
    }

    fn robot(&self) -> &Description {
        self.robot.as_ref().expect("the claim is about a robot")
    }

    /// Frame `to` in frame `from`, by the product of the link transforms of the table.
    fn transform(&self, from: &str, to: &str) -> Transform<Expr> {
        let robot = Robot::symbolic(self.robot());
        let q: Vec<Expr> = self.robot().variables().iter().map(|v| v.symbol.into()).collect();
        let frames = robot.frames(&q);
        let frame = |name: &str| match name {
            "tool" => robot.pose(&q),
            number => frames[number.parse::<usize>().expect("a frame's number")],
        };
        // ⁱTⱼ is the product of the links between, so that nothing is cancelled that is not there.
        match (from.parse::<usize>(), to.parse::<usize>()) {
            (Ok(i), Ok(j)) if i <= j => {
                robot.links[i..j].iter().fold(Transform::identity(), |x, link| x * link.transform(&q))
            }
            (Ok(i), Ok(j)) if i > j => self.transform(&j.to_string(), &i.to_string()).inverse(),
            _ => frame(from).inverse() * frame(to),
        }
    }
}

fn text(v: &Value) -> &str {
    v.as_str().unwrap_or_else(|| panic!("{v} is no string"))
}

fn string<'a>(table: &'a Table, key: &str) -> &'a str {
    table.get(key).map(text).unwrap_or_else(|| panic!("no `{key}` in {table}"))
}

fn list<'a>(table: &'a Table, key: &str) -> Vec<&'a Table> {
    let items = table.get(key).and_then(Value::as_array).into_iter().flatten();
    items.filter_map(Value::as_table).collect()
}

fn strings(table: &Table, key: &str) -> Vec<String> {
    table.get(key).and_then(Value::as_array).into_iter().flatten().map(|v| text(v).to_string()).collect()
}

fn read(formula: &str, names: &Vocabulary) -> Expr {
    parse(formula, names).unwrap_or_else(|errors| panic!("`{formula}`: {errors:?}"))
}

/// What the claim prints: entries by place, 1-based; entries left out are not there.
fn printed(claim: &Table, names: &Vocabulary) -> Vec<((usize, usize), Expr)> {
    if let Some(entry) = claim.get("entry") {
        let words: Vec<&str> = string(claim, "of").split(' ').collect();
        let at = |k: usize| words[k].parse().expect("row and column");
        return vec![((at(4), at(5)), read(text(entry), names))];
    }
    let rows = claim["matrix"].as_array().expect("a matrix");
    let cells = rows.iter().enumerate().flat_map(|(r, row)| {
        let row = row.as_array().expect("a row");
        row.iter().enumerate().map(move |(c, cell)| ((r + 1, c + 1), text(cell)))
    });
    cells.filter(|cell| cell.1 != ".").map(|(at, cell)| (at, read(cell, names))).collect()
}

fn homogeneous(x: &Transform<Expr>) -> Matrix {
    x.matrix().iter().map(|row| row.to_vec()).collect()
}

/// An elementary transform such as `rot z θ_n` or `trans x 90 deg`.
fn elementary(words: &str, names: &Vocabulary) -> Transform<Expr> {
    let [kind, axis, value] = words.splitn(3, ' ').collect::<Vec<_>>()[..] else { panic!("{words}") };
    let axis = match axis {
        "x" => Axis::X,
        "y" => Axis::Y,
        "z" => Axis::Z,
        _ => panic!("{words}"),
    };
    let value = parse_angle(value, names).unwrap_or_else(|e| panic!("{words}: {e:?}"));
    match (kind, axis) {
        ("rot", axis) => Transform::rotation_about(axis, value),
        (_, Axis::X) => Transform::translation_x(value),
        (_, Axis::Y) => Transform::translation_y(value),
        (_, Axis::Z) => Transform::translation_z(value),
    }
}

/// Three frames at arbitrary places, for laws that hold of any.
fn anywhere(frame: &str) -> Transform<Expr> {
    let symbol = |what: &str| Expr::symbol(&format!("{what}({frame})"));
    let rotation = Rotation::from_rpy(symbol("roll"), symbol("pitch"), symbol("yaw"));
    Transform::translation(symbol("x"), symbol("y"), symbol("z"))
        * Transform::from_rotation_translation(rotation, denavit::geometry::Vector::zero())
}

/// `inverse(T i j)`, `transpose(R j-1 j)`, `T j i`.
fn property(words: &str) -> Matrix {
    if let Some(inner) = words.strip_prefix("inverse(").and_then(|w| w.strip_suffix(')')) {
        return inverse(inner);
    }
    if let Some(inner) = words.strip_prefix("transpose(").and_then(|w| w.strip_suffix(')')) {
        let m = property(inner);
        return (0..m.len()).map(|c| m.iter().map(|row| row[c]).collect()).collect();
    }
    let [kind, from, to] = words.split(' ').collect::<Vec<_>>()[..] else { panic!("{words}") };
    let x = anywhere(from).inverse() * anywhere(to);
    match kind {
        "R" => x.rotation.rows().iter().map(|row| row.to_vec()).collect(),
        _ => homogeneous(&x),
    }
}

/// The inverse of `T i j`, which is `T j i`: their product is proved to be the identity.
fn inverse(words: &str) -> Matrix {
    let [kind, from, to] = words.split(' ').collect::<Vec<_>>()[..] else { panic!("{words}") };
    let (original, candidate) = (property(words), property(&format!("{kind} {to} {from}")));
    for (r, row) in original.iter().enumerate() {
        for c in 0..row.len() {
            let terms = row.iter().zip(&candidate).map(|(&a, column)| a * column[c]);
            let entry = terms.fold(Expr::int(0), |sum, term| sum + term);
            assert!(equal(entry, Expr::int(i64::from(r == c))).is_equal(), "inverse of {words}");
        }
    }
    candidate
}

/// What the claim should print, by the robot's own definition.
fn wanted(claim: &Table, context: &Context) -> Matrix {
    let of = string(claim, "of");
    let words: Vec<&str> = of.split(' ').collect();
    let symbols = claim.get("symbols").and_then(Value::as_table);
    let symbol = |key: &str| symbols.map_or(Expr::int(0), |s| read(string(s, key), &context.names));
    match words[..] {
        ["T", i, j] | ["T", i, j, "entry", _, _] => homogeneous(&context.transform(i, j)),
        ["R", i, j] => context.transform(i, j).rotation.rows().iter().map(|row| row.to_vec()).collect(),
        ["P", i, j] => context.transform(i, j).translation.0.iter().map(|&e| vec![e]).collect(),
        ["O", i] => context.transform("0", i).translation.0.iter().map(|&e| vec![e]).collect(),
        ["Z", i] => context.transform("0", i).rotation.z().0.iter().map(|&e| vec![e]).collect(),
        ["rot", "x"] => homogeneous(&Transform::rotation_x(symbol("angle"))),
        ["rot", "y"] => homogeneous(&Transform::rotation_y(symbol("angle"))),
        ["rot", "z"] => homogeneous(&Transform::rotation_z(symbol("angle"))),
        ["trans"] => homogeneous(&Transform::translation(symbol("x"), symbol("y"), symbol("z"))),
        ["dh", "standard"] => homogeneous(
            &(Transform::rotation_z(symbol("theta"))
                * Transform::translation_z(symbol("d"))
                * Transform::translation_x(symbol("a"))
                * Transform::rotation_x(symbol("alpha"))),
        ),
        ["dh", "khalil"] => homogeneous(
            &(Transform::rotation_x(symbol("alpha"))
                * Transform::translation_x(symbol("d"))
                * Transform::rotation_z(symbol("theta"))
                * Transform::translation_z(symbol("r"))),
        ),
        ["product"] => {
            let factors = strings(claim, "factors");
            let factors = factors.iter().map(|f| elementary(f, &context.names));
            homogeneous(&factors.fold(Transform::identity(), |x, f| x * f))
        }
        ["inverse"] => {
            let given: Vec<Vec<Expr>> = claim["given"]
                .as_array()
                .expect("rows")
                .iter()
                .map(|row| {
                    row.as_array().expect("a row").iter().map(|c| read(text(c), &context.names)).collect()
                })
                .collect();
            let entry = |r: usize, c: usize| given[r][c];
            let rotation = Rotation::from_rows([0, 1, 2].map(|r| [0, 1, 2].map(|c| entry(r, c))));
            let position = denavit::geometry::Vector([0, 1, 2].map(|r| entry(r, 3)));
            homogeneous(&Transform::from_rotation_translation(rotation, position).inverse())
        }
        _ => panic!("unknown claim `{of}`"),
    }
}

/// True if proved equal, false if proved different.
fn holds(id: &str, a: Expr, b: Expr) -> bool {
    match equal(a, b) {
        Verdict::Equal { .. } => true,
        Verdict::Different { .. } => false,
        Verdict::Undecided(why) => panic!("{id}: {why:?}"),
    }
}

/// The places at which a claim is refuted.
fn refuted(claim: &Table, context: &Context) -> BTreeSet<String> {
    let id = string(claim, "id");
    let pairs: Vec<(String, Expr, Expr)> = match string(claim, "of") {
        "angle identity" => {
            let side = |key| read(string(claim, key), &context.names);
            vec![("right_side".into(), side("left"), side("right_side"))]
        }
        "property" => {
            let (left, right) = (property(string(claim, "left")), property(string(claim, "right_side")));
            let entries = left.iter().flatten().zip(right.iter().flatten());
            entries.map(|(&a, &b)| ("right_side".to_string(), a, b)).collect()
        }
        "alpha" => {
            let values = strings(claim, "values");
            let rows = context.robot().rows.iter().enumerate();
            assert_eq!(values.len(), context.robot().rows.len());
            rows.map(|(i, row)| ((i + 1).to_string(), row.alpha, read(&values[i], &context.names))).collect()
        }
        set if set.starts_with("euler") => {
            let entry = |r: usize, c: usize| Expr::symbol(&format!("R({r},{c})"));
            let rotation = Rotation::from_rows([1, 2, 3].map(|r| [1, 2, 3].map(|c| entry(r, c))));
            let names = (1..=3)
                .flat_map(|r| (1..=3).map(move |c| format!("R({r},{c})")))
                .fold(Vocabulary::new(), |v, name| v.symbol(&name));
            let set: OrientationSet = set.split(' ').next_back().and_then(|s| s.parse().ok()).expect("a set");
            let ours = extraction_formulas(&rotation, set).expect("angles");
            // The documents' roll-pitch-yaw angles are φ about z, θ about y, ψ about x.
            let keys =
                if set == OrientationSet::Rpy { ["psi", "theta", "phi"] } else { ["phi", "theta", "psi"] };
            keys.iter()
                .zip(ours)
                .map(|(key, (_, e))| ((*key).into(), e, read(string(claim, key), &names)))
                .collect()
        }
        _ => {
            let wanted = wanted(claim, context);
            let entries = printed(claim, &context.names).into_iter();
            entries.map(|((r, c), e)| (format!("{r},{c}"), wanted[r - 1][c - 1], e)).collect()
        }
    };
    assert!(!pairs.is_empty(), "{id} claims nothing");
    pairs.into_iter().filter(|(_, a, b)| !holds(id, *a, *b)).map(|p| p.0).collect()
}

/// The formulas given as right are right.
fn check_corrections(claim: &Table, context: &Context) {
    let Some(right) = claim.get("right").and_then(Value::as_table) else { return };
    for (place, formula) in right {
        let mut corrected = claim.clone();
        match place.split_once(',') {
            Some((r, c)) if claim.contains_key("matrix") => {
                let [r, c]: [usize; 2] = [r, c].map(|n| n.parse().expect("a place"));
                corrected["matrix"][r - 1][c - 1] = formula.clone();
            }
            Some(_) => corrected["entry"] = formula.clone(),
            None => corrected[place.as_str()] = formula.clone(),
        }
        assert!(!refuted(&corrected, context).contains(place), "{}: {place} = {formula}", claim["id"]);
    }
}

/// Checks a file's claims; gives the numbers of equal and wrong ones.
fn check(source: &str) -> (usize, usize) {
    let file: Table = source.parse().expect("TOML");
    let own = Context::new(&file, string(&file, "robot"));
    let (mut right, mut wrong) = (0, 0);
    for claim in list(&file, "claims") {
        let other = claim.get("robot").map(|name| Context::new(&file, text(name)));
        let mut names = other.as_ref().unwrap_or(&own).names.clone();
        // Letters of a general matrix stand for themselves.
        for letter in claim.get("symbols").and_then(Value::as_table).into_iter().flatten() {
            names = declare(names, text(letter.1));
        }
        for factor in strings(claim, "factors") {
            names = declare(names, factor.splitn(3, ' ').last().unwrap_or_default());
        }
        if string(claim, "of") == "angle identity" {
            names = declare(names.degrees(true), "θ_n");
        }
        let robot = other.map_or_else(|| own.robot.clone(), |c| c.robot);
        let context = Context { robot, names };
        let expected: BTreeSet<String> = strings(claim, "wrong").into_iter().collect();
        assert_eq!(expected.is_empty(), string(claim, "verdict") == "equal", "{}", claim["id"]);
        assert_eq!(refuted(claim, &context), expected, "{}", claim["id"]);
        check_corrections(claim, &context);
        if expected.is_empty() { right += 1 } else { wrong += 1 }
    }
    (right, wrong)
}

/// Declares a letter such as `θ_n` unless it is known, or a number.
fn declare(names: Vocabulary, letter: &str) -> Vocabulary {
    let is_letter = letter.starts_with(|c: char| c.is_alphabetic());
    if is_letter && names.lookup(letter).is_none() { names.symbol(letter) } else { names }
}

#[test]
fn general_transforms() {
    assert_eq!(check(include_str!("sources/transforms.toml")), (21, 2));
}

#[test]
fn staubli_rx90() {
    assert_eq!(check(include_str!("sources/rx90.toml")), (16, 2));
}

#[test]
fn stanford() {
    assert_eq!(check(include_str!("sources/stanford.toml")), (3, 1));
}

#[test]
fn prrrrp() {
    assert_eq!(check(include_str!("sources/prrrrp.toml")), (33, 1));
}

#[test]
fn ur3() {
    assert_eq!(check(include_str!("sources/ur3.toml")), (13, 19));
}

#[test]
fn cylindrical() {
    assert_eq!(check(include_str!("sources/cylindrical.toml")), (47, 3));
}

#[test]
fn smart5_six() {
    assert_eq!(check(include_str!("sources/smart5.toml")), (2, 1));
}

/// One changed cell of the UR3 report's table mends most of what it prints.
#[test]
fn ur3_with_the_likely_table() {
    let file: Table = include_str!("sources/ur3.toml").parse().expect("TOML");
    let hypothesis = file["hypothesis"].as_table().expect("a hypothesis");
    assert_eq!(string(hypothesis, "change"), "joint 5: alpha = -90 deg");
    let mut context = Context::new(&file, string(&file, "robot"));
    if let Some(robot) = &mut context.robot {
        robot.rows[4].alpha = -robot.rows[4].alpha;
    }
    let claims = list(&file, "claims");
    let claim = |id: &String| *claims.iter().find(|c| string(c, "id") == id).expect("a claim");
    for id in strings(hypothesis, "turns_equal") {
        assert!(refuted(claim(&id), &context).is_empty(), "{id}");
    }
    for id in strings(hypothesis, "turns_wrong") {
        assert!(!refuted(claim(&id), &context).is_empty(), "{id}");
    }
    for (id, formula) in hypothesis["right"].as_table().expect("formulas") {
        let mut corrected = claim(id).clone();
        assert!(!refuted(&corrected, &context).is_empty(), "{id} is wrong as printed");
        corrected["entry"] = formula.clone();
        assert!(refuted(&corrected, &context).is_empty(), "{id} = {formula}");
    }
}
