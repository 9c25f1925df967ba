//! Every formula of inverse kinematics that the documents print, held against their own tables.
//!
//! `sources/*_inverse.toml` holds what is printed, as printed, and the verdict that is expected. Equations are proved or
//! refuted with the forward model in place of the pose; printed values are compared with all solutions of random poses,
//! which the derived inverse model gives. Corrections are held in the same way, and their values proved to solve
//! equations that are proved. `docs/errata-remarks.md` tells it in words.

mod procedures;

use crate::common::printed::{formulas, list, read, string, strings, text, values};
use denavit::catalogue;
use denavit::description::Description;
use denavit::geometry::Transform;
use denavit::inverse::{Goal, InverseModel, InverseOptions, InverseSolver};
use denavit::robot::Robot;
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Equality, Expr, Rational, Symbol, equal};
use procedures::{check_procedures, run, steps};
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::{PI, TAU};
use toml::{Table, Value};

const POSES: usize = 200;
const TOLERANCE: f64 = 1e-6;
/// The entries of a pose by row, as the documents call its columns.
const COLUMNS: [&str; 4] = ["n", "o", "a", "p"];

/// A small generator of numbers that look random (splitmix64).
struct Random(u64);

impl Random {
    fn within(&mut self, bound: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0) * bound
    }
}

/// A table, its forward model in place of the pose's symbols, and its inverse model.
struct Model {
    description: Description,
    names: Vocabulary,
    /// The joint variables.
    variables: Vec<Symbol>,
    is_angle: Vec<bool>,
    parameters: BTreeMap<Symbol, f64>,
    /// The entries of the pose, by the table.
    pose: BTreeMap<Symbol, Expr>,
    robot: Robot<f64>,
    inverse: InverseModel,
    solver: InverseSolver,
}

impl Model {
    /// The first `arm` rows of a robot, or all; `change` is made to the table.
    fn new(file: &Table, name: &str, arm: Option<usize>, change: Option<&str>) -> Self {
        let mut description = catalogue::robot(name).expect("a robot of the catalogue");
        if let Some(change) = change {
            assert_eq!(change, "joint 5: alpha = -90 deg");
            description.rows[4].alpha = -description.rows[4].alpha;
        }
        description.rows.truncate(arm.unwrap_or(usize::MAX));
        let mut names = description.vocabulary();
        for (name, meaning) in file.get("aliases").and_then(Value::as_table).into_iter().flatten() {
            let meaning = read(text(meaning), &names);
            names = names.alias(name, meaning);
        }
        for (column, row) in COLUMNS.iter().flat_map(|c| ["x", "y", "z"].map(|r| (c, r))) {
            names = names.symbol(&format!("{column}{row}"));
        }
        // Names that the corrections use speak of all joints.
        for definition in list(file, "define").into_iter().filter(|_| arm.is_none()) {
            let value = read(string(definition, "value"), &names);
            names = names.alias(string(definition, "name"), value);
        }

        let mut numbers = description.clone();
        let open = numbers.parameters.iter_mut().filter(|p| p.value.is_none());
        for (k, p) in (1..).zip(open) {
            p.value = Some(Rational::new(24 + 7 * k, 100).into());
        }
        let goal = if arm.is_some() { Goal::Position } else { Goal::Pose };
        let inverse =
            InverseModel::derive(&numbers, &InverseOptions { goal, given: None }).expect("a closed form");
        let variables: Vec<Symbol> = description.variables().iter().map(|v| v.symbol).collect();
        let q: Vec<Expr> = variables.iter().map(|&v| v.into()).collect();
        let entries = Robot::symbolic(&description).pose(&q).matrix();
        let symbol = |r: usize, c: usize| Symbol::new(&format!("{}{}", COLUMNS[c], ["x", "y", "z"][r]));
        let places = (0..3).flat_map(|r| (0..4).map(move |c| (r, c)));
        Model {
            is_angle: (0..q.len()).map(|j| inverse.chain.is_angle(j)).collect(),
            pose: places.map(|(r, c)| (symbol(r, c), entries[r][c])).collect(),
            parameters: numbers.known_values().into_iter().collect(),
            robot: Robot::numeric(&numbers).expect("numbers"),
            solver: inverse.solver(&numbers).expect("numbers"),
            variables,
            names,
            description,
            inverse,
        }
    }

    /// Frame `to` in frame `from`, by the product of the link transforms.
    fn transform(&self, from: usize, to: usize) -> Transform<Expr> {
        let robot = Robot::symbolic(&self.description);
        let q: Vec<Expr> = self.variables.iter().map(|&v| v.into()).collect();
        if from > to {
            return self.transform(to, from).inverse();
        }
        robot.links[from..to].iter().fold(Transform::identity(), |x, link| x * link.transform(&q))
    }

    /// A formula with the table's forward model in place of the pose.
    fn by_table(&self, e: Expr) -> Expr {
        e.substitute(|s| self.pose.get(&s).copied())
    }

    /// An equation's sides; both are formulas in joint variables and the pose.
    fn sides(&self, equation: &str) -> (Expr, Expr) {
        let (left, right) = equation.split_once('=').unwrap_or_else(|| panic!("`{equation}` is no equation"));
        (read(left.trim(), &self.names), read(right.trim(), &self.names))
    }

    /// True if the equation is proved for every configuration, false if it is refuted.
    fn holds(&self, equation: &str) -> bool {
        let (left, right) = self.sides(equation);
        decided(equation, self.by_table(left), self.by_table(right))
    }

    fn random(&self, random: &mut Random) -> Vec<f64> {
        self.is_angle.iter().map(|&a| random.within(if a { PI } else { 3.0 })).collect()
    }

    /// The value of a formula in joint variables and the pose.
    fn value(&self, e: Expr, q: &[f64], pose: &Transform<f64>) -> f64 {
        let m = pose.matrix();
        let entry = |s: Symbol| {
            let name = s.name();
            let column = COLUMNS.iter().position(|c| name.starts_with(c))?;
            let row = ["x", "y", "z"].iter().position(|r| name[1..] == **r)?;
            Some(m[row][column])
        };
        let variable = |s: Symbol| self.variables.iter().position(|&v| v == s).map(|j| q[j]);
        let known = |s: Symbol| variable(s).or_else(|| self.parameters.get(&s).copied()).or_else(|| entry(s));
        e.eval(known).unwrap_or_else(|s| panic!("{} has no value", s.name()))
    }

    fn values(&self, of: &[Expr], q: &[f64], pose: &Transform<f64>) -> Vec<f64> {
        of.iter().map(|&e| self.value(e, q, pose)).collect()
    }

    /// The joint variable that a sum of joint variables is solved for: the last one.
    fn last(&self, of: Expr) -> usize {
        let symbols = of.symbols();
        (0..self.variables.len())
            .rev()
            .find(|&j| symbols.contains(&self.variables[j]))
            .expect("a joint variable")
    }

    /// Puts `value` for `of`, a joint variable or a sum of such.
    fn put(&self, e: Expr, of: Expr, value: Expr) -> Expr {
        let last = self.variables[self.last(of)];
        let others = of.substitute(|s| (s == last).then(|| Expr::int(0)));
        e.substitute(|s| (s == last).then(|| value - others))
    }
}

/// True if proved equal, false if proved different.
fn decided(id: &str, a: Expr, b: Expr) -> bool {
    match equal(a, b) {
        Equality::Equal { .. } => true,
        Equality::Different { .. } => false,
        Equality::Undecided(why) => panic!("{id}: {why:?}"),
    }
}

/// Equal but for whole turns.
fn near(a: &[f64], b: &[f64]) -> bool {
    a.iter().zip(b).all(|(x, y)| (x - y - TAU * ((x - y) / TAU).round()).abs() <= TOLERANCE)
}

/// What is found out about printed values.
struct Judged {
    verdict: &'static str,
    faults: BTreeSet<String>,
}

/// Compares values with what `of` is in the solutions that agree in `known`, at random poses.
///
/// Only poses with as many solutions as there can be are taken: at others, a right value may be one of a branch that a
/// later step ends, for the elbow is out of reach there.
fn judge(
    id: &str,
    model: &mut Model,
    of: &[Expr],
    known: &[Expr],
    values: &[Vec<Expr>],
    at: &[Expr],
) -> Judged {
    let mut faults = BTreeSet::new();
    let (mut ever, mut as_told) = (false, true);
    let mut random = Random(7);
    let mut poses = 0;
    while poses < POSES {
        let q = model.random(&mut random);
        let pose = model.robot.pose(&q);
        let answer = model.solver.solve(&pose, &[]);
        assert!(answer.solutions.iter().any(|s| near(&s.q, &q)), "{q:?} is among the solutions");
        if answer.solutions.len() < model.inverse.max_solutions() {
            continue;
        }
        poses += 1;
        let given = model.values(known, &q, &pose);
        let agree = answer.solutions.iter().filter(|s| near(&model.values(known, &s.q, &pose), &given));
        let right: Vec<Vec<f64>> = agree.map(|s| model.values(of, &s.q, &pose)).collect();
        let printed: Vec<Vec<f64>> = values.iter().map(|v| model.values(v, &q, &pose)).collect();
        for (k, value) in printed.iter().enumerate() {
            let is_right = right.iter().any(|r| near(r, value));
            ever |= is_right;
            if !is_right && value.iter().all(|x| x.is_finite()) {
                faults.insert("extra".to_string());
            }
            if let Some(&condition) = at.get(k) {
                as_told &= is_right == (model.value(condition, &q, &pose) > 0.0);
            }
        }
        if right.iter().any(|r| !printed.iter().any(|p| near(r, p))) {
            faults.insert("missing".to_string());
        }
    }
    let verdict = if faults.is_empty() {
        "right"
    } else if !ever {
        "wrong"
    } else {
        assert!(at.len() == values.len() && as_told, "{id}: `where` says which value is right where");
        "conditional"
    };
    Judged { verdict, faults }
}

/// How often values solve an equation, whatever the quantities in it: "always", "sometimes" or "never".
fn follows(model: &Model, equation: &str, of: Expr, known: &[Expr], values: &[Vec<Expr>]) -> &'static str {
    let (left, right) = model.sides(equation);
    let left = left - right;
    let (mut solved, mut seen) = (0, 0);
    let mut random = Random(11);
    for value in values {
        let value = with_sums(model, value[0], known);
        let residual = model.put(with_sums(model, left, known), of, value);
        for _ in 0..POSES {
            let numbers: BTreeMap<Symbol, f64> =
                residual.symbols().into_iter().map(|s| (s, random.within(2.0))).collect();
            let residual = residual.eval(|s| numbers.get(&s).copied()).expect("all have numbers");
            if residual.is_finite() {
                seen += 1;
                solved += usize::from(residual.abs() < 1e-9);
            }
        }
    }
    assert!(seen > POSES / 10);
    match solved {
        0 => "never",
        _ if solved == seen => "always",
        _ => "sometimes",
    }
}

/// A known sum of joint variables is one quantity, whatever its parts.
fn with_sums(model: &Model, e: Expr, known: &[Expr]) -> Expr {
    let sums = known.iter().enumerate().filter(|k| k.1.symbols().len() > 1);
    sums.fold(e, |e, (k, &sum)| model.put(e, sum, Expr::symbol(&format!("sum {k}"))))
}

/// Corrected values are right, and solve equations which hold.
fn check_correction(id: &str, model: &mut Model, of: &[Expr], right: &Table) {
    let known = formulas(right, "known", &model.names);
    let values = values(right, &model.names);
    let judged = judge(id, model, of, &known, &values, &[]);
    assert_eq!((judged.verdict, judged.faults), ("right", BTreeSet::new()), "{id}");
    let equations = strings(right, "solves");
    assert!(!equations.is_empty(), "{id}");
    let identically =
        right.get("identically").and_then(Value::as_integer).map_or(equations.len(), |n| n as usize);
    for (k, equation) in equations.iter().enumerate() {
        assert!(model.holds(equation), "{id}: {equation}");
        for value in values.iter().filter(|_| k < identically) {
            let (left, right) = model.sides(equation);
            let [left, right] = [left, right].map(|side| {
                let side = with_sums(model, side, &known);
                let found = of.iter().zip(value).map(|(&of, &v)| (of, with_sums(model, v, &known)));
                found.fold(side, |e, (of, v)| model.put(e, of, v))
            });
            assert!(decided(id, left, right), "{id}: the value solves {equation}");
        }
    }
}

/// Checks what is given as right, for the table or for the hypothesis; true if there is something.
fn check_right(id: &str, claim: &Table, model: &mut Model, is_hypothesis: bool) -> bool {
    let key = |name: &str| {
        let other = format!("hypothesis_{name}");
        if is_hypothesis && claim.contains_key(&other) { other } else { name.into() }
    };
    let mut corrected = false;
    if let Some(equation) = claim.get(&key("right_equation")) {
        assert!(model.holds(text(equation)), "{id}: {equation}");
        corrected = true;
    }
    if let Some(frame) = claim.get("right_carries") {
        assert!(carries(model, text(frame), &formulas(claim, "of", &model.names)), "{id}");
        corrected = true;
    }
    if let Some(right) = claim.get(&key("right")).and_then(Value::as_table) {
        let of = formulas(claim, "of", &model.names);
        check_correction(id, model, &of, right);
        corrected = true;
    }
    corrected
}

/// The verdict on a claim, and its faults if it claims values.
fn verdict(claim: &Table, model: &mut Model) -> (String, Option<BTreeSet<String>>) {
    let id = string(claim, "id");
    let said = |is_right: bool| (if is_right { "right" } else { "wrong" }.to_string(), None);
    if let Some(equation) = claim.get("equation") {
        return said(model.holds(text(equation)));
    }
    if let Some(rows) = claim.get("matrix").and_then(Value::as_array) {
        let wanted = product(model, &[string(claim, "of").to_string()]).matrix();
        let cells = rows.iter().enumerate().flat_map(|(r, row)| {
            let row = row.as_array().expect("a row").iter().enumerate();
            row.map(move |(c, cell)| (r, c, text(cell)))
        });
        let cells: Vec<(usize, usize, &str)> = cells.collect();
        assert_eq!(cells.len(), 16);
        return said(cells.iter().all(|&(r, c, cell)| {
            let printed = model.by_table(read(cell, &model.names));
            decided(id, printed, wanted[r][c])
        }));
    }
    if claim.contains_key("product") {
        let (wanted, factors) =
            (product(model, &[string(claim, "of").to_string()]), product(model, &strings(claim, "product")));
        let entries = wanted.rotation.rows().into_iter().zip(factors.rotation.rows());
        return said(entries.flat_map(|(a, b)| a.into_iter().zip(b)).all(|(a, b)| decided(id, a, b)));
    }
    if let Some(frame) = claim.get("carries") {
        return said(carries(model, text(frame), &formulas(claim, "of", &model.names)));
    }
    if !claim.contains_key("values") {
        return ("unreadable".into(), None);
    }
    let readings = list(claim, "readings");
    let readings =
        if readings.is_empty() { vec![Table::new()] } else { readings.into_iter().cloned().collect() };
    let mut found: Option<(String, Option<BTreeSet<String>>)> = None;
    for reading in readings {
        let mut names = model.names.clone();
        for (name, meaning) in &reading {
            names = names.alias(name, read(text(meaning), &model.names));
        }
        let of = formulas(claim, "of", &names);
        let known = formulas(claim, "known", &names);
        let judged = judge(id, model, &of, &known, &values(claim, &names), &formulas(claim, "where", &names));
        let judged = (judged.verdict.to_string(), Some(judged.faults));
        assert!(found.as_ref().is_none_or(|f| *f == judged), "{id}: one verdict in all readings");
        found = Some(judged);
    }
    found.expect("a reading")
}

/// A product of `R i j` or `T i j`.
fn product(model: &Model, factors: &[String]) -> Transform<Expr> {
    factors.iter().fold(Transform::identity(), |x, factor| {
        let [_, from, to] = factor.split(' ').collect::<Vec<_>>()[..] else { panic!("{factor}") };
        x * model.transform(from.parse().expect("a frame"), to.parse().expect("a frame"))
    })
}

/// True if the frame's origin does not depend on the variables.
fn carries(model: &Model, frame: &str, variables: &[Expr]) -> bool {
    let origin = model.transform(0, frame.parse().expect("a frame")).translation;
    let other =
        |s: Symbol| variables.contains(&s.into()).then(|| Expr::symbol(&format!("other {}", s.name())));
    origin.0.iter().all(|&e| decided(frame, e, e.substitute(other)))
}

/// A file's tables, each with its model made once.
struct Models<'a> {
    file: &'a Table,
    change: Option<&'a str>,
    made: BTreeMap<(String, Option<usize>), Model>,
}

impl<'a> Models<'a> {
    fn new(file: &'a Table, change: Option<&'a str>) -> Self {
        Models { file, change, made: BTreeMap::new() }
    }

    fn of(&mut self, claim: &Table) -> &mut Model {
        let name = claim.get("robot").map_or(string(self.file, "robot"), text).to_string();
        let arm = claim.get("arm").and_then(Value::as_integer).map(|n| n as usize);
        let (file, change) = (self.file, self.change);
        self.made.entry((name.clone(), arm)).or_insert_with(|| Model::new(file, &name, arm, change))
    }
}

fn count(counts: &mut BTreeMap<String, usize>, verdict: &str) {
    *counts.entry(verdict.to_string()).or_default() += 1;
}

fn stored_faults(claim: &Table, keys: [&str; 2], verdict: &str) -> Option<BTreeSet<String>> {
    let faults = keys.iter().find(|k| claim.contains_key(**k)).map(|k| strings(claim, k));
    claim.contains_key("values").then(|| {
        let faults = if verdict == "right" { None } else { faults };
        faults.unwrap_or_default().into_iter().collect()
    })
}

/// Checks a file's claims; gives the number of each verdict.
fn check(file: &Table) -> Vec<(String, usize)> {
    let mut models = Models::new(file, None);
    let mut counts = BTreeMap::new();
    for claim in list(file, "claims") {
        let id = string(claim, "id");
        let model = models.of(claim);
        let (found, faults) = verdict(claim, model);
        assert_eq!(found, string(claim, "verdict"), "{id}, {faults:?}");
        assert_eq!(faults, stored_faults(claim, ["faults", "faults"], &found), "{id}");
        if let Some(from) = claim.get("from") {
            let (of, known) =
                (formulas(claim, "of", &model.names)[0], formulas(claim, "known", &model.names));
            let printed = values(claim, &model.names);
            assert_eq!(follows(model, text(from), of, &known, &printed), string(claim, "follows"), "{id}");
            if let Some(solution) = claim.get("solution_of_from").and_then(Value::as_table) {
                let solution = values(solution, &model.names);
                assert_eq!(follows(model, text(from), of, &known, &solution), "always", "{id}");
            }
        }
        let corrected = check_right(id, claim, model, false);
        assert_eq!(
            corrected,
            matches!(&found[..], "wrong" | "conditional"),
            "{id}: what is not right is corrected"
        );
        assert_eq!(corrected, claim.contains_key("why"), "{id}");
        count(&mut counts, &found);
    }
    for omitted in list(file, "omitted") {
        let model = models.of(omitted);
        let of = formulas(omitted, "of", &model.names);
        check_correction(string(omitted, "id"), model, &of, omitted);
    }
    counts.into_iter().collect()
}

fn source(text: &str) -> Table {
    text.parse().expect("TOML")
}

fn counts(of: &[(&str, usize)]) -> Vec<(String, usize)> {
    of.iter().map(|&(verdict, n)| (verdict.to_string(), n)).collect()
}

#[test]
fn ur3() {
    let file = source(include_str!("../../sources/ur3_inverse.toml"));
    assert_eq!(check(&file), counts(&[("conditional", 2), ("right", 8), ("unreadable", 2), ("wrong", 14)]));
    check_procedures(&file, None);
}

#[test]
fn cylindrical() {
    let file = source(include_str!("../../sources/cylindrical_inverse.toml"));
    assert_eq!(check(&file), counts(&[("conditional", 1), ("right", 4), ("wrong", 2)]));
    check_procedures(&file, None);
}

/// With α5 = −90°, as in the report's products, other formulas are right.
#[test]
fn ur3_with_the_likely_table() {
    let file = source(include_str!("../../sources/ur3_inverse.toml"));
    let change = string(file["hypothesis"].as_table().expect("a hypothesis"), "change").to_string();
    let mut models = Models::new(&file, Some(&change));
    let mut found_counts = BTreeMap::new();
    for claim in list(&file, "claims") {
        let id = string(claim, "id");
        let (found, faults) = verdict(claim, models.of(claim));
        let expected = claim.get("hypothesis").map_or("unreadable", text);
        assert_eq!(found, expected, "{id}, {faults:?}");
        if found == "conditional" {
            assert_eq!(faults, stored_faults(claim, ["hypothesis_faults", "faults"], &found), "{id}");
        }
        if matches!(&found[..], "wrong" | "conditional") {
            assert!(check_right(id, claim, models.of(claim), true), "{id}: what is not right is corrected");
        }
        count(&mut found_counts, &found);
    }
    let expected = counts(&[("conditional", 3), ("right", 9), ("unreadable", 2), ("wrong", 12)]);
    assert_eq!(found_counts.into_iter().collect::<Vec<(String, usize)>>(), expected);
    check_procedures(&file, Some(&change));
}

/// The report's formulas together, all signs tried, never put the hand where it should be, with either table.
#[test]
fn ur3_as_printed_finds_nothing() {
    let file = source(include_str!("../../sources/ur3_inverse.toml"));
    let change = string(file["hypothesis"].as_table().expect("a hypothesis"), "change").to_string();
    for change in [None, Some(&change[..])] {
        let mut models = Models::new(&file, change);
        for procedure in list(&file, "procedures") {
            let model = models.of(procedure);
            let steps = steps(&file, procedure, &model.names, &[]);
            let combinations: usize = steps.iter().map(|s| s.1.len()).product();
            assert_eq!(Some(combinations as i64), procedure["combinations"].as_integer());
            let mut random = Random(17);
            let (mut found, mut tried) = (0, 0);
            for _ in 0..POSES {
                let pose = model.robot.pose(&model.random(&mut random));
                for q in run(model, &steps, &pose) {
                    tried += 1;
                    let (a, b) = (model.robot.pose(&q).matrix(), pose.matrix());
                    let same = a.iter().flatten().zip(b.iter().flatten()).all(|(x, y)| (x - y).abs() < 1e-3);
                    found += i64::from(same);
                }
            }
            assert!(tried > POSES);
            assert_eq!(Some(found), procedure["printed"].as_integer());
        }
    }
}

/// What the documents do not mention: poses at which their formulas divide by 0, where the arm can move by itself.
#[test]
fn degenerate_poses_have_families() {
    let ur3 = source(include_str!("../../sources/ur3_inverse.toml"));
    let cylindrical = source(include_str!("../../sources/cylindrical_inverse.toml"));
    let reach = |m: &Model| -["a3", "a4", "a5"].iter().map(|a| m.parameters[&Symbol::new(a)]).sum::<f64>();
    type Case<'a> = (&'a Table, &'a str, usize, fn(f64) -> f64, bool);
    let cases: [Case<'_>; 8] = [
        (&ur3, "ur3-lab", 4, |_| 0.0, true),
        (&ur3, "ur3-lab", 4, |_| PI, true),
        (&ur3, "ur3-lab", 4, |_| PI / 2.0, false),
        (&cylindrical, "cylindrical-wrist", 4, |_| 0.0, true),
        (&cylindrical, "cylindrical-wrist", 4, |_| PI / 2.0, false),
        (&cylindrical, "cylindrical-wrist-b", 4, |_| PI / 2.0, true),
        (&cylindrical, "cylindrical-wrist-b", 4, |_| 0.0, false),
        (&cylindrical, "cylindrical-wrist", 2, |on_the_column| on_the_column, true),
    ];
    let mut random = Random(19);
    for (file, robot, joint, special, has_family) in cases {
        let model = Model::new(file, robot, None, None);
        for _ in 0..5 {
            let mut q = model.random(&mut random);
            q[joint] = special(if joint == 2 { reach(&model) } else { 0.0 });
            let answer = model.solver.solve(&model.robot.pose(&q), &[]);
            assert_eq!(!answer.families.is_empty(), has_family, "{robot} at {q:?}: {answer:?}");
        }
    }
}
