//! Tables of one mechanism, written in other ways, and tables of others.

use denavit::catalogue;
use denavit::description::{
    Convention, Description, JointKind, Sameness, TableKind, TableOptions, read_table, same_mechanism,
};
use denavit::geometry::Transform;
use denavit::random::Random;
use denavit::robot::Robot;
use denavit_symbolic::{Expr, Rational, Symbol};

fn table(rows: &str) -> Description {
    let text =
        format!("convention: standard\nangles: deg\n\n| j | θ | d | a | α |\n|--|--|--|--|--|\n{rows}");
    read_table(&text, TableKind::Markdown, &TableOptions::default()).unwrap().0
}

/// A table of joints with quarter turns, symbols, numbers and zeros.
fn random_table(random: &mut Random) -> Description {
    let joints = 2 + (random.unit() * 5.0) as usize;
    let pick = |random: &mut Random, of: &[&str]| of[(random.unit() * of.len() as f64) as usize].to_string();
    let mut rows = String::new();
    for i in 1..=joints {
        let length = |random: &mut Random, letter: &str| {
            let kind = pick(random, &["0", "0", "s", "n"]);
            match kind.as_str() {
                "s" => format!("{letter}{i}"),
                "n" => format!("{:.3}", 0.1 + random.unit()),
                _ => kind,
            }
        };
        let a = length(random, "a");
        let alpha = pick(random, &["0", "90", "-90", "180", "0", "90", "35"]);
        // Two joints on one line are no arm.
        let alpha = if a == "0" && alpha == "0" { "-90".into() } else { alpha };
        let minus = if random.unit() < 0.2 { "-" } else { "" };
        if random.unit() < 0.25 {
            let theta = pick(random, &["0", "90", "-90", "180"]);
            rows.push_str(&format!("| {i} | {theta} | {minus}q{i} | {a} | {alpha} |\n"));
        } else {
            let d = length(random, "b");
            rows.push_str(&format!("| {i} | {minus}q{i} | {d} | {a} | {alpha} |\n"));
        }
    }
    table(&rows)
}

/// A normal turned round: `Rz(π)` in front of it and behind, with a and α of the other sign.
fn turn_normal(d: &mut Description, k: usize) {
    let row = &mut d.rows[k];
    (row.a, row.alpha) = (-row.a, -row.alpha);
    row.theta = row.theta + Expr::pi();
    let half = Transform::rotation_z(Expr::pi());
    match d.rows.get_mut(k + 1) {
        Some(next) => next.theta = next.theta + Expr::pi(),
        None => d.tool = half * d.tool,
    }
}

/// The axis of a joint turned round: `Rx(π)` in front of it and behind.
fn turn_axis(d: &mut Description, k: usize) {
    let half = Expr::pi();
    match k.checked_sub(1) {
        Some(before) => d.rows[before].alpha = d.rows[before].alpha + half,
        None => d.base = d.base * Transform::rotation_x(half),
    }
    // Rx(π)·Rz(θ)·Tz(d)·Rx(π) = Rz(−θ)·Tz(−d); the variable counts the other way half of the time.
    let row = &mut d.rows[k];
    let variable = row.variable.unwrap();
    let minus = |e: Expr| match k % 2 {
        0 => (-e).substitute(|s| (s == variable.symbol).then(|| -Expr::from(s))),
        _ => -e,
    };
    match variable.kind {
        JointKind::Revolute => (row.theta, row.d) = (minus(row.theta), -row.d),
        JointKind::Prismatic => (row.theta, row.d) = (-row.theta, minus(row.d)),
    }
    row.alpha = row.alpha + half;
}

/// The defining equation at random configurations, by the robots themselves.
fn holds(a: &Description, b: &Description, same: &denavit::description::SameMechanism, random: &mut Random) {
    let value = |s: Symbol| Some(0.2 + (s.name().bytes().map(u32::from).sum::<u32>() % 17) as f64 / 23.0);
    let number = |e: Expr| e.eval(value).unwrap();
    let count = a.variables().len();
    for _ in 0..3 {
        let q: Vec<f64> = (0..count).map(|_| 6.0 * random.unit() - 3.0).collect();
        let pose = |d: &Description, q: &[f64]| {
            let symbols = d.variables();
            let all = |s: Symbol| symbols.iter().position(|v| v.symbol == s).map(|i| q[i]).or(value(s));
            let robot = Robot::symbolic(d);
            let exprs: Vec<Expr> = symbols.iter().map(|v| v.symbol.into()).collect();
            robot.pose(&exprs).map(|e: Expr| e.eval(all).unwrap())
        };
        let moved: Vec<f64> =
            (0..count).map(|i| if same.reversed[i] { -q[i] } else { q[i] } + number(same.zeros[i])).collect();
        let right = same.base.map(number) * pose(b, &moved) * same.tool.map(number);
        let (left, right) = (pose(a, &q).matrix().concat(), right.matrix().concat());
        for (x, y) in left.into_iter().zip(right) {
            assert!((x - y).abs() < 1e-9, "{x} {y}");
        }
    }
}

#[test]
fn the_same_written_otherwise() {
    let mut random = Random(20);
    let mut undecided = 0;
    for case in 0..CASES {
        let a = random_table(&mut random);
        let mut b = a.clone();
        for k in 0..b.rows.len() {
            if random.unit() < 0.4 {
                turn_normal(&mut b, k);
            }
            if random.unit() < 0.25 {
                turn_axis(&mut b, k);
            }
        }
        // Another zero position of a joint, another hand, another base.
        let k = (random.unit() * b.rows.len() as f64) as usize;
        match b.rows[k].variable.unwrap().kind {
            JointKind::Revolute => b.rows[k].theta = b.rows[k].theta + Expr::pi() / Expr::int(2),
            JointKind::Prismatic => b.rows[k].d = b.rows[k].d + Expr::from(Symbol::new("c")),
        }
        if random.unit() < 0.5 {
            b.tool = b.tool * Transform::translation_x(Expr::from(Rational::new(1, 3)));
        }
        let convention = Convention::ALL[case % 3];
        let b = b.converted(convention).description;
        match same_mechanism(&a, &b) {
            Sameness::Same(same) => holds(&a, &b, &same, &mut random),
            Sameness::Different => panic!("case {case}: {:?}\n{:?}", a.rows, b.rows),
            // Two joints on one line, say.
            Sameness::Undecided => undecided += 1,
        }
    }
    assert!(undecided < CASES / 4, "{undecided}");
}

const CASES: usize = 300;

#[test]
fn another_mechanism() {
    let mut random = Random(21);
    let mut different = 0;
    for case in 0..CASES {
        let a = random_table(&mut random);
        let mut b = a.clone();
        let k = (random.unit() * b.rows.len() as f64) as usize;
        let row = &mut b.rows[k];
        match case % 3 {
            0 => row.a = row.a + Expr::from(Rational::new(1, 7)),
            1 => row.alpha = row.alpha + Expr::pi() / Expr::int(5),
            _ => row.d = row.d + Expr::from(Rational::new(1, 7)),
        }
        match same_mechanism(&a, &b) {
            Sameness::Same(same) => holds(&a, &b, &same, &mut random),
            Sameness::Different => different += 1,
            Sameness::Undecided => {}
        }
    }
    assert!(different > CASES / 6, "{different}");
}

#[test]
fn lengths_that_matter_and_lengths_that_do_not() {
    let arm = |d4: &str, d2: &str| {
        table(&format!(
            "| 1 | q1 | l1 | 0 | 90 |\n| 2 | q2 | {d2} | l2 | 0 |\n| 3 | q3 | 0 | 0 | 90 |\n| 4 | q4 | {d4} | 0 | -90 |\n| 5 | q5 | 0 | 0 | 90 |\n| 6 | q6 | l6 | 0 | 0 |\n"
        ))
    };
    let is = |a: &Description, b: &Description| match same_mechanism(a, b) {
        Sameness::Same(_) => Some(true),
        Sameness::Different => Some(false),
        Sameness::Undecided => None,
    };
    assert_eq!(is(&arm("l4", "0"), &arm("l4", "0")), Some(true));
    assert_eq!(is(&arm("l4", "0"), &arm("l5", "0")), Some(false));
    assert_eq!(is(&arm("l4", "0"), &arm("-l4", "0")), Some(true), "another way to count the angles");
    assert_eq!(is(&arm("l4", "0"), &arm("l4", "b")), Some(false));
}

#[test]
fn every_arm_in_every_convention() {
    for name in catalogue::names() {
        let d = catalogue::robot(name).unwrap();
        for convention in Convention::ALL {
            match same_mechanism(&d, &d.converted(convention).description) {
                Sameness::Same(same) => {
                    assert!(same.reversed.iter().all(|r| !r), "{}", d.name);
                    assert!(same.zeros.iter().all(|z| z.is_zero()), "{}", d.name);
                    assert!(
                        same.base == Transform::identity() && same.tool == Transform::identity(),
                        "{}",
                        d.name
                    );
                }
                Sameness::Different => panic!("{} in {convention}", d.name),
                Sameness::Undecided => {}
            }
        }
    }
}
