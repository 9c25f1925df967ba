//! Tables of numbers with a column for each joint.

use denavit::catalogue;
use denavit::description::{Description, JointKind};
use denavit::random::Random;
use denavit::robot::Robot;
use denavit_check::{About, CheckOptions, Claim, Standing, check};
use denavit_reading::document::Format;

/// Arms whose lengths have values.
fn arms() -> impl Iterator<Item = (Description, Robot<f64>)> {
    let all = catalogue::names().into_iter().filter_map(catalogue::robot);
    all.filter_map(|d| Some((Robot::numeric(&d).ok()?, d)).map(|(r, d)| (d, r))).filter(|(d, _)| {
        let plain = d.rows.iter().all(|r| r.variable.is_some());
        plain && (2..=7).contains(&d.rows.len())
    })
}

fn claims(text: &str, robot: &Description) -> Vec<Claim> {
    let found = check(text, Format::Markdown, Some(robot), &CheckOptions::default()).unwrap();
    found.claims.into_iter().filter(|c| c.about == About::Configuration).collect()
}

/// A head and rows of joints in degrees and metres, each with the place of the hand in millimetres.
fn table(d: &Description, rows: &[(Vec<f64>, [f64; 3])]) -> String {
    let joints = d.variables();
    let heads: Vec<String> = (1..=joints.len()).map(|k| format!("q{k}")).collect();
    let mut text =
        format!("Poses (angles in degrees):\n\n| {} | x [mm] | y [mm] | z [mm] |\n", heads.join(" | "));
    text += &format!("|{}\n", "---|".repeat(joints.len() + 3));
    for (q, p) in rows {
        let q = q.iter().zip(&joints).map(|(x, v)| match v.kind {
            JointKind::Revolute => format!("{:.1}", x.to_degrees()),
            JointKind::Prismatic => format!("{x:.3}"),
        });
        let cells: Vec<String> = q.chain(p.iter().map(|x| format!("{:.1}", 1000.0 * x))).collect();
        text += &format!("| {} |\n", cells.join(" | "));
    }
    text
}

#[test]
fn a_wrong_row_is_found_and_no_right_one_accused() {
    let mut random = Random(7);
    let (mut arms_tried, mut found) = (0, 0);
    for (d, robot) in arms() {
        let joints = d.variables();
        let mut rows: Vec<(Vec<f64>, [f64; 3])> = (0..6)
            .map(|_| {
                let q: Vec<f64> = joints
                    .iter()
                    .map(|v| match v.kind {
                        JointKind::Revolute => (300.0 * random.unit() - 150.0).round().to_radians(),
                        JointKind::Prismatic => (1000.0 * random.unit()).round() / 1000.0,
                    })
                    .collect();
                let p = robot.pose(&q).translation.0;
                (q, p)
            })
            .collect();
        let right = claims(&table(&d, &rows), &d);
        assert!(right.len() == 6 && right.iter().all(|c| c.standing() == Standing::Equal), "{}", d.name);
        // One number with another sign.
        let r = (random.unit() * 6.0) as usize;
        let axis = (random.unit() * 3.0) as usize;
        if rows[r].1[axis].abs() < 0.02 {
            continue;
        }
        arms_tried += 1;
        rows[r].1[axis] = -rows[r].1[axis];
        for (k, claim) in claims(&table(&d, &rows), &d).iter().enumerate() {
            assert_eq!(claim.standing() == Standing::Wrong, k == r, "{}, row {k}", d.name);
            found += usize::from(claim.standing() == Standing::Wrong);
        }
    }
    assert!(arms_tried > 50 && found == arms_tried, "{found} of {arms_tried}");
}

/// A coordinate with few digits is one that was rounded: a unit more in its last one is another number where that is a good part
/// of it, and is neither in another unit nor off by rounding.
#[test]
fn coarse_numbers_are_rounded_ones() {
    let mut random = Random(11);
    let mut wrong = 0;
    for (d, robot) in arms().filter(|(d, _)| d.variables().iter().all(|v| v.kind == JointKind::Revolute)) {
        let degrees: Vec<f64> = (0..robot.joints).map(|_| (360.0 * random.unit() - 180.0).round()).collect();
        let q: Vec<f64> = degrees.iter().map(|x| x.to_radians()).collect();
        let x = robot.pose(&q).translation.0[0];
        let told: Vec<String> =
            degrees.iter().enumerate().map(|(k, q)| format!("q{} = {q}°", k + 1)).collect();
        let of = |decimals: usize, more: f64| {
            let text = format!("At {} the hand is at\n\n$x = {:.decimals$}$ m\n", told.join(", "), x + more);
            let found = check(&text, Format::Markdown, Some(&d), &CheckOptions::default()).unwrap();
            let claim = found.claims.iter().find(|c| c.name == "x").unwrap_or_else(|| panic!("{text}"));
            (claim.standing(), format!("{:?}", claim.entries))
        };
        for decimals in 1..4 {
            assert_eq!(of(decimals, 0.0).0, Standing::Equal, "{} {x} {decimals}", d.name);
        }
        if x.abs() < 2.0 {
            let (standing, said) = of(1, 0.11 * x.signum());
            assert_eq!(standing, Standing::Wrong, "{} {x}", d.name);
            assert!(!said.contains("Metres") && !said.contains("LastDigit"), "{} {x}: {said}", d.name);
            wrong += 1;
        }
    }
    assert!(wrong > 40, "{wrong}");
}

#[test]
fn solutions_of_a_point() {
    let d = catalogue::robot("articulated-3r").unwrap();
    let text = |elbow: &str, goal: &str| {
        format!(
            "All solutions for the point {goal} m, degrees:\n\n| no | θ1 | θ2 | θ3 |\n|--|--|--|--|\n\
             | a | 30.00 | 45.00 | -60.00 |\n| b | 30.00 | {elbow} | 60.00 |\n"
        )
    };
    let robot = Robot::numeric(&d).unwrap();
    let q = [30.0_f64, 45.0, -60.0].map(f64::to_radians);
    let p = robot.pose(&q).translation.0;
    let goal = format!("({:.4}, {:.4}, {:.4})", p[0], p[1], p[2]);
    // The elbow on the other side: θ2 + 2·atan2(a3 s3, a2 + a3 c3).
    let [a2, a3] = [1, 2].map(|k| d.rows[k].a.eval(|s| d.value(s)).unwrap());
    let lean = (a3 * q[2].sin()).atan2(a2 + a3 * q[2].cos());
    let other = format!("{:.2}", (q[1] + 2.0 * lean).to_degrees());
    let standings = |text: &str| claims(text, &d).iter().map(Claim::standing).collect::<Vec<_>>();
    assert_eq!(standings(&text(&other, &goal)), [Standing::Equal; 2]);
    assert_eq!(standings(&text("12.30", &goal)), [Standing::Equal, Standing::Wrong]);
    // No row fits: what is meant is not known.
    assert_eq!(standings(&text(&other, "(9.1, 8.2, 7.3)")), [Standing::Undecided; 2]);
}

#[test]
fn columns_of_angles_and_columns_that_nobody_knows() {
    let d = catalogue::robot("planar-3r").unwrap();
    let robot = Robot::numeric(&d).unwrap();
    let row = |q: [f64; 3], phi: f64| {
        let p = robot.pose(&q.map(f64::to_radians)).translation.0;
        format!("| {} | {} | {} | {:.3} | {:.3} | {phi} |\n", q[0], q[1], q[2], p[0], p[1])
    };
    let text = |head: &str, phi: f64| {
        format!(
            "phi = q1 + q2 + q3 is the angle of the hand. Angles in degrees.\n\n| q1 | q2 | q3 | x | y | {head} |\n\
             |--|--|--|--|--|--|\n{}{}",
            row([30.0, 45.0, -60.0], 15.0),
            row([100.0, 60.0, 90.0], phi)
        )
    };
    let standings = |text: &str| claims(text, &d).iter().map(Claim::standing).collect::<Vec<_>>();
    assert_eq!(standings(&text("phi", -110.0)), [Standing::Equal; 2], "a turn further is the same");
    assert_eq!(standings(&text("phi", 110.0)), [Standing::Equal, Standing::Wrong]);
    assert_eq!(standings(&text("zeta", 7.0)), [Standing::Undecided; 2], "nothing is passed over");
}
