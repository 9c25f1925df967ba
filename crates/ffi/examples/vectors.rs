//! Robots made at random, states and poses of them, and what the library says of these: what `tests/against.c` is held to.
//!
//! Numbers in decimals that read back to the same doubles, separated by blanks: `robot CONVENTION ROWS cells… kinds… limits…`, then
//! `states COUNT q…`, then `poses COUNT` and for each the pose, status, how many solutions and families, and the solutions; or
//! `masses BYTES`, the text of a robot file, and `states COUNT` with q, qd, qdd, torques, inertia, gravity, energies.

use denavit::Robot;
use denavit::description::{Description, read_toml};
use denavit::dynamics::{
    Dynamics, drive_torques, gravity_torques, inertia_matrix, kinetic_energy, potential_energy,
};
use denavit::geometry::Transform;
use denavit::inverse::{Answer, InverseKinematics, InverseOptions};
use denavit::random::Random;
use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write as _;

const STATES: usize = 4;
const CONVENTIONS: [(&str, [&str; 4]); 3] = [
    ("standard", ["theta", "d", "a", "alpha"]),
    ("craig", ["alpha", "a", "theta", "d"]),
    ("khalil", ["alpha", "d", "theta", "r"]),
];
/// What the letters of a table are in the order of the standard convention; where they stand in the other two.
const PLACES: [[usize; 4]; 3] = [[0, 1, 2, 3], [2, 3, 1, 0], [2, 3, 1, 0]];

/// A row: the transforms of the standard convention, and whether it turns, slides or stands.
type Row = ([f64; 4], u8);

fn main() {
    let mut random = Random(23);
    let mut out = String::new();
    for k in 0..6 {
        let rows = arm(k, &mut random);
        chain(&mut out, k % 3, &rows, k == 1, &mut random);
    }
    weighing(&mut out, &mut random);
    println!("{out}end");
}

/// Six axes with a wrist whose axes meet, others askew, seven axes, a slide, three in a plane.
fn arm(k: usize, random: &mut Random) -> Vec<Row> {
    let mut length = || (random.unit() * 8.0).ceil() / 10.0;
    let mut row = |kind, alpha: f64| ([0.0, length(), length(), alpha], kind);
    let wrist =
        |d: f64| [([0.0, d, 0.0, FRAC_PI_2], 0), ([0.0, 0.0, 0.0, -FRAC_PI_2], 0), ([0.3, 0.1, 0.0, 0.0], 0)];
    match k {
        0 => [row(0, FRAC_PI_2), row(0, 0.0), row(0, -FRAC_PI_2)].into_iter().chain(wrist(0.5)).collect(),
        1 => [row(0, FRAC_PI_2), row(1, FRAC_PI_2), row(0, 0.0)].into_iter().chain(wrist(0.4)).collect(),
        2 => [0.4, -1.1, 0.8, 1.3, -0.7, 0.2].into_iter().map(|alpha| row(0, alpha)).collect(),
        3 => (0..7).map(|i| row(0, if i % 2 == 0 { FRAC_PI_2 } else { -FRAC_PI_2 })).collect(),
        4 => vec![row(0, 0.0), row(2, FRAC_PI_2), row(0, 0.0), row(1, 0.0)],
        _ => vec![row(0, 0.0), row(0, 0.0), row(0, 0.0)],
    }
}

fn numbers<'a>(out: &mut String, values: impl IntoIterator<Item = &'a f64>) {
    for x in values {
        let _ = write!(out, " {x:?}");
    }
    out.push('\n');
}

/// The text of a robot file, written otherwise than the library for C writes it.
fn described(convention: usize, rows: &[Row], limited: bool) -> Description {
    let (name, letters) = CONVENTIONS[convention];
    let mut text = format!("name = 'robot'\nconvention = '{name}'\n");
    for (i, (row, kind)) in rows.iter().enumerate() {
        text += "[[joints]]\n";
        let variable = rows[..i].iter().filter(|r| r.1 != 2).count() + 1;
        for (k, x) in row.iter().enumerate() {
            let letter = letters[PLACES[convention][k]];
            let moved =
                if *kind < 2 && usize::from(*kind) == k { format!(" + q{variable}") } else { String::new() };
            let _ = writeln!(text, "{letter} = '{x}{moved}'");
        }
        if limited && *kind == 0 {
            text += "limits = [-6, 3.5]\n";
        }
    }
    match read_toml(&text) {
        Ok((description, _)) => description,
        Err(findings) => panic!("{findings:?}\n{text}"),
    }
}

fn entries(pose: &Transform<f64>) -> Vec<f64> {
    pose.matrix().into_iter().flatten().collect()
}

/// As the header numbers them.
fn status(answer: &Answer, left_out: usize) -> i32 {
    match (answer.is_reachable(), answer.is_complete()) {
        (true, true) => i32::from(!answer.families.is_empty()),
        (true, false) => 2,
        (false, _) if left_out > 0 => 5,
        (false, true) => 3,
        (false, false) => 4,
    }
}

fn chain(out: &mut String, convention: usize, rows: &[Row], limited: bool, random: &mut Random) {
    let _ = writeln!(out, "robot {} {}", convention + 1, rows.len());
    for (row, _) in rows {
        let mut placed = [0.0; 4];
        row.iter().zip(PLACES[convention]).for_each(|(x, at)| placed[at] = *x);
        numbers(out, &placed);
    }
    let kinds: Vec<String> = rows.iter().map(|r| r.1.to_string()).collect();
    let _ = writeln!(out, "{} {}", kinds.join(" "), i32::from(limited));
    let d = described(convention, rows, limited);
    let robot = match Robot::numeric(&d) {
        Ok(robot) => robot,
        Err(why) => panic!("{why}"),
    };
    let n = robot.joints;
    let mut states: Vec<Vec<f64>> = (0..if n > 6 { 1 } else { STATES })
        .map(|_| (0..n).map(|_| 2.0 * PI * random.unit() - PI).collect())
        .collect();
    // The last one is singular where there is a wrist: its middle joint is straight.
    states.push((0..n).map(|j| if j == 4 { 0.0 } else { 0.3 * j as f64 - 0.5 }).collect());
    let _ = writeln!(out, "states {}", states.len());
    states.iter().for_each(|q| numbers(out, q));
    let solver = match InverseKinematics::new(&d, &InverseOptions::default()) {
        Ok(solver) => solver,
        Err(why) => panic!("{why}"),
    };
    let mut poses: Vec<Transform<f64>> = states.iter().map(|q| robot.pose(q)).collect();
    let mut far = robot.pose(&states[0]);
    far.translation.0[0] += 50.0;
    poses.push(far);
    let _ = writeln!(out, "poses {}", poses.len());
    for pose in &poses {
        let given = vec![0.0; solver.given.len()];
        let mut answer = solver.solve(pose, &given);
        let left_out = if limited { answer.leave_out(&solver.space) } else { 0 };
        numbers(out, &entries(pose));
        let counts = [answer.solutions.len(), answer.families.len(), left_out];
        let _ = writeln!(out, "{} {} {} {}", status(&answer, left_out), counts[0], counts[1], counts[2]);
        answer.solutions.iter().for_each(|s| numbers(out, &s.q));
    }
}

/// An arm with masses.
fn weighing(out: &mut String, random: &mut Random) {
    let text = include_str!("../../generate/tests/robots/moving.toml");
    let Ok((d, _)) = read_toml(text) else { panic!("it has no errors") };
    let arm = match Dynamics::numeric(&d) {
        Ok(arm) => arm,
        Err(why) => panic!("{why}"),
    };
    let n = arm.joints();
    let _ = write!(out, "masses {}\n{text}\nstates {STATES}\n", text.len());
    for _ in 0..STATES {
        let mut vector = || (0..n).map(|_| 2.0 * random.unit() - 1.0).collect::<Vec<f64>>();
        let [q, qd, qdd] = [vector(), vector(), vector()];
        [&q, &qd, &qdd].into_iter().for_each(|v| numbers(out, v));
        numbers(out, &drive_torques(&arm, &q, &qd, &qdd, None));
        numbers(out, inertia_matrix(&arm, &q).iter().flatten());
        numbers(out, &drive_torques(&arm, &q, &qd, &vec![0.0; n], None));
        numbers(out, &gravity_torques(&arm, &q));
        numbers(out, &[kinetic_energy(&arm, &q, &qd), potential_energy(&arm, &q)]);
    }
}
