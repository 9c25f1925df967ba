//! Tables as answers: each arm of the catalogue in other conventions, with other normals and zeros, and with a wrong cell.

use denavit::catalogue;
use denavit::description::{Convention, Description, JointKind};
use denavit::geometry::Transform;
use denavit::random::Random;
use denavit::robot::Robot;
use denavit_check::{About, CheckOptions, Checked, Condition, Finding, Remark, Standing, check};
use denavit_reading::document::Format;
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::{Expr, Symbol};

/// A table as a student would hand it in.
fn handed_in(d: &Description) -> String {
    let names = d.vocabulary();
    let mut text =
        format!("The table, {} convention:\n\nconvention: {}\nangles: rad\n\n", d.convention, d.convention);
    let columns = d.columns();
    let heads: Vec<&str> = columns.iter().map(|c| c.letter(d.convention)).collect();
    text += &format!("| i | {} |\n|---|{}\n", heads.join(" | "), "---|".repeat(heads.len()));
    for (i, row) in (1..).zip(&d.rows) {
        let cells = columns.iter().map(|c| print(c.of(row), &names, Style::Ascii)).collect::<Vec<_>>();
        text += &format!("| {i} | {} |\n", cells.join(" | "));
    }
    text
}

fn judged(robot: &Description, table: &Description) -> Checked {
    check(&handed_in(table), Format::Markdown, Some(robot), &CheckOptions::default()).unwrap()
}

fn standing(checked: &Checked) -> Standing {
    checked.claims.iter().find(|c| c.about == About::Table).expect("a claim about the table").standing()
}

/// Without base and tool, which a table cannot hold, and without rows that do not move.
fn arms() -> impl Iterator<Item = Description> {
    let plain =
        |d: &Description| d.rows.iter().all(|r| r.variable.is_some()) && (2..=7).contains(&d.rows.len());
    catalogue::names().into_iter().filter_map(catalogue::robot).filter(move |d| plain(d)).map(|mut d| {
        (d.base, d.tool) = (Transform::identity(), Transform::identity());
        d
    })
}

fn turn_normal(d: &mut Description, k: usize) {
    let row = &mut d.rows[k];
    (row.a, row.alpha) = (-row.a, -row.alpha);
    row.theta = row.theta + Expr::pi();
    d.rows[k + 1].theta = d.rows[k + 1].theta + Expr::pi();
}

#[test]
fn right_tables_are_never_called_wrong() {
    let mut random = Random(41);
    let (mut right, mut all) = (0, 0);
    for robot in arms() {
        for convention in Convention::ALL {
            let mut table = robot.converted(Convention::Standard).description;
            for k in 0..table.rows.len() - 1 {
                if random.unit() < 0.3 {
                    turn_normal(&mut table, k);
                }
            }
            let k = (random.unit() * table.rows.len() as f64) as usize;
            if table.rows[k].variable.is_some_and(|v| v.kind == JointKind::Revolute) && random.unit() < 0.5 {
                table.rows[k].theta = table.rows[k].theta + Expr::pi() / Expr::int(2);
            }
            let table = table.converted(convention).description;
            let checked = judged(&robot, &table);
            let found = standing(&checked);
            assert_ne!(found, Standing::Wrong, "{}\n{}", robot.name, handed_in(&table));
            all += 1;
            right += usize::from(found == Standing::Equal);
        }
    }
    assert!(all > 60 && right * 10 >= all * 7, "{right} of {all}");
}

/// The largest difference of the poses at a few configurations.
fn apart(a: &Description, b: &Description, random: &mut Random) -> f64 {
    let variables = a.variables();
    let mut worst: f64 = 0.0;
    for _ in 0..4 {
        let q: Vec<f64> = variables.iter().map(|_| 4.0 * random.unit() - 2.0).collect();
        let pose = |d: &Description| {
            let value = |s: Symbol| {
                let joint = variables.iter().position(|v| v.symbol == s).map(|i| q[i]);
                joint.or_else(|| a.value(s)).or(Some(0.3 + 0.01 * s.name().len() as f64))
            };
            let joints: Vec<Expr> = variables.iter().map(|v| v.symbol.into()).collect();
            Robot::symbolic(d).pose(&joints).map(|e: Expr| e.eval(value).unwrap())
        };
        let (x, y) = (pose(a).matrix().concat(), pose(b).matrix().concat());
        worst = x.into_iter().zip(y).map(|(x, y)| (x - y).abs()).fold(worst, f64::max);
    }
    worst
}

#[test]
fn a_wrong_cell_is_found_and_named() {
    let mut random = Random(42);
    let (mut wrong, mut named, mut all) = (0, 0, 0);
    for robot in arms() {
        for _ in 0..4 {
            let mut table = robot.clone();
            let k = (random.unit() * table.rows.len() as f64) as usize;
            let which = (random.unit() * 3.0) as usize;
            let row = &mut table.rows[k];
            let cell = match which {
                0 => &mut row.alpha,
                1 => &mut row.a,
                _ if row.variable.is_some_and(|v| v.kind == JointKind::Revolute) => &mut row.d,
                _ => continue,
            };
            let was = *cell;
            *cell = match cell.is_zero() {
                true if which == 0 => Expr::pi() / Expr::int(2),
                true => continue,
                false if random.unit() < 0.5 => -*cell,
                false => Expr::int(0),
            };
            if apart(&robot, &table, &mut random) < 1e-9 {
                continue;
            }
            all += 1;
            let checked = judged(&robot, &table);
            let claim = checked.claims.iter().find(|c| c.about == About::Table).unwrap();
            // Nothing that moves the hand otherwise is right without a word.
            let placed = claim.remarks.iter().any(|r| matches!(r, Remark::Placed(_)));
            match claim.standing() {
                Standing::Equal => assert!(placed, "{}, row {k}: {was}\n{}", robot.name, handed_in(&table)),
                Standing::Conditional => {
                    let free = |f: &Finding| {
                        matches!(f, Finding::Conditional { condition: Condition::Placed(_), .. })
                    };
                    assert!(claim.entries.iter().any(|e| free(&e.finding)));
                }
                Standing::Wrong => {
                    wrong += 1;
                    let cells: Vec<_> =
                        claim.entries.iter().filter(|e| e.finding.standing() == Standing::Wrong).collect();
                    named += usize::from(matches!(cells[..], [one] if one.place.map(|p| p.0) == Some(k + 1)));
                }
                _ => {}
            }
        }
    }
    assert!(wrong * 2 > all && named * 10 >= wrong * 8, "{named} of {wrong} of {all}");
}
