//! What was put in comes out, as near as the deviations say.

use crate::made::{Setting, USUAL, recording, table, truth};
use denavit_identification::{
    Asked, Cutoff, Identified, Known, Options, Prior, Sought, consistent, identify,
};

/// A slide between turns, a joint geared to another, one that follows two.
pub const GEARED: &str = r#"
convention = "standard"
[[joints]]
theta = "q1"
d = "0.4 m"
alpha = "90 deg"
[[joints]]
theta = "q2"
a = "0.5 m"
[[joints]]
theta = "q3 - q2"
a = "0.3 m"
alpha = "90 deg"
[[joints]]
d = "q4 + 0.2"
alpha = "30 deg"
[[joints]]
theta = "q5"
d = "0.1 m"
"#;

fn soak(usual: u64, full: u64) -> u64 {
    if std::env::var_os("DENAVIT_SOAK").is_some() { full } else { usual }
}

/// How many of the parameters that are given are within one, two and three deviations, and how many there are.
#[derive(Default, Debug)]
struct Coverage {
    within: [usize; 3],
    all: usize,
    unseen: usize,
    worst: f64,
}

impl Coverage {
    fn take(&mut self, found: &Identified, values: &[f64]) {
        for (known, truth) in found.estimate.known.iter().zip(values) {
            match known {
                Known::Value(x, s) => {
                    let off = (x - truth).abs() / s;
                    self.all += 1;
                    self.worst = self.worst.max(off);
                    (1..=3).for_each(|k| self.within[k - 1] += usize::from(off <= k as f64));
                }
                _ => self.unseen += 1,
            }
        }
    }

    fn part(&self, k: usize) -> f64 {
        self.within[k - 1] as f64 / self.all as f64
    }
}

/// Base parameters within three deviations: 99 % and more. Chance allows one in 370 of them.
#[test]
fn parameters_are_within_their_deviations() {
    let tables: Vec<String> = (0..soak(3, 60)).map(table).collect();
    let mut arms = vec!["staubli-rx90", "ur5", "franka-panda", "stanford", "scara", GEARED];
    arms.extend(tables.iter().map(String::as_str));
    let mut whole = Coverage::default();
    for name in arms {
        let mut of = Coverage::default();
        let is_table = name.contains('\n');
        let seeds = if is_table { soak(1, 4) } else { soak(2, 40) };
        for seed in 0..seeds {
            let truth = truth(name, seed, Sought::default());
            let columns = recording(&truth, &Setting { seed, ..USUAL });
            let found = identify(&truth.model, &columns, &Asked::default()).expect("motion");
            assert!(found.suspects.is_empty(), "{name} {seed}: {:?}", found.suspects);
            for c in [&mut of, &mut whole] {
                c.take(&found, &truth.values());
            }
            if seed == 0 {
                let joints = &found.estimate.joints;
                println!(
                    "{}: cutoffs {:?}, condition {:.1}, {joints:.3?}",
                    truth.description.name, found.cutoffs, found.estimate.condition
                );
            }
        }
        println!("{}: {:?} {of:?}", name.lines().last().unwrap_or(name), [1, 2, 3].map(|k| of.part(k)));
    }
    println!("all: {:?} {whole:?}", [1, 2, 3].map(|k| whole.part(k)));
    assert!(whole.part(3) >= 0.99, "{whole:?}");
    // Deviations that are far too large would cover everything.
    assert!(whole.part(1) < 0.80 && whole.part(1) > 0.55, "{whole:?}");
}

/// Without noise, without a filter, with rates and accelerations: as exact as doubles.
#[test]
fn exact_recordings_give_exact_parameters() {
    for name in ["ur5", GEARED] {
        let truth = truth(name, 5, Sought { rotors: true, ..Sought::default() });
        let clean = Setting { positions: 0.0, torques: 0.0, rate: 400.0, ..USUAL };
        let found = identify(&truth.model, &recording(&truth, &clean), &Asked::default()).expect("motion");
        for (j, of) in found.estimate.joints.iter().enumerate() {
            assert!(of.left < 5e-3 * of.torque, "{name}: joint {}: {of:?}", j + 1);
        }
    }
}

/// What is far off is far off for least squares, and counts little with --robust.
#[test]
fn outliers_count_little() {
    let truth = truth("staubli-rx90", 3, Sought::default());
    let mut columns = recording(&truth, &USUAL);
    for (j, tau) in columns.tau.iter_mut().enumerate() {
        let size = tau.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let rows = tau.len();
        // A second here and there in which something leans on the arm.
        for at in [0.21, 0.53, 0.8] {
            let from = (at * rows as f64) as usize + 37 * j;
            tau[from..from + 150].iter_mut().for_each(|x| *x += 0.6 * size);
        }
    }
    let error = |robust: bool| {
        let options = Options { robust, reduce: false };
        let found = identify(&truth.model, &columns, &Asked { options, ..Asked::default() }).expect("motion");
        let values = truth.values();
        let rows = &found.observations.rows;
        let of = |r: &denavit_identification::Row| {
            let predicted = |v: &[f64]| r.entries.iter().zip(v).map(|(a, b)| a * b).sum::<f64>();
            (predicted(&found.estimate.values) - predicted(&values)).powi(2)
        };
        (rows.iter().map(of).sum::<f64>() / rows.len() as f64).sqrt()
    };
    let (plain, robust) = (error(false), error(true));
    assert!(robust < 0.5 * plain, "{robust} {plain}");
}

/// Masses that can be, with the same torques, for those that are and for given ones that are others.
#[test]
fn masses_can_be_and_have_the_torques() {
    for (k, name) in ["staubli-rx90", "ur5", "franka-panda", GEARED].into_iter().enumerate() {
        let truth = truth(name, 20 + k as u64, Sought::default());
        let found = identify(&truth.model, &recording(&truth, &USUAL), &Asked::default()).expect("motion");
        let mut dice = crate::made::Dice::new(99);
        let other = (0..truth.dynamics.links.len()).map(|_| dice.body(4.0, 0.1)).collect();
        for prior in [Prior::Neutral, Prior::Given(other)] {
            let set = consistent(&truth.model, &found.estimate, &prior);
            assert!(set.is_settled, "{name}");
            for (i, body) in set.bodies.iter().enumerate() {
                assert_eq!(body.check(), Ok(()), "{name}: link {}: {body:?}", i + 1);
                assert!(body.mass > 0.0);
            }
            assert!(set.drives.iter().all(|d| d.viscous > 0.0 && d.coulomb > 0.0));
            // The truth is a set that can be: the best is no worse, and it is off by noise.
            let (left, best) = (found.left(&set.values), found.left(&found.estimate.values));
            println!("{name}: excess {:.2}, farthest {:?}", set.excess, set.farthest);
            for (a, b) in left.iter().zip(&best) {
                assert!(*a < 1.1 * b, "{name}: {left:?} {best:?}");
            }
        }
        // Given the truth, the set is the truth as far as torques tell, and stays near where they do not.
        let bodies: Vec<_> = truth.dynamics.links.iter().map(|l| l.body).collect();
        let near = consistent(&truth.model, &found.estimate, &Prior::Given(bodies.clone()));
        for (a, b) in near.bodies.iter().zip(&bodies) {
            assert!((a.mass - b.mass).abs() < 0.5 * b.mass + 0.2, "{name}: {} {}", a.mass, b.mass);
        }
    }
}

/// A joint that stands still: what it alone shows is not given as a number.
#[test]
fn what_the_motion_does_not_tell_is_named() {
    let truth = truth("ur5", 8, Sought::default());
    let mut columns = recording(&truth, &USUAL);
    // Joint 4 stands still, in truth too.
    let n = truth.model.joints();
    columns.q[3].fill(0.4);
    let rows = columns.time.len();
    let derive = |x: &[f64]| -> Vec<f64> {
        (0..rows).map(|r| (x[(r + 1).min(rows - 1)] - x[r.saturating_sub(1)]) * 100.0).collect()
    };
    let clean = recording(&truth, &Setting { positions: 0.0, torques: 0.0, ..USUAL });
    let mut q = clean.q.clone();
    q[3].fill(0.4);
    let qd: Vec<Vec<f64>> = q.iter().map(|x| derive(x)).collect();
    let qdd: Vec<Vec<f64>> = qd.iter().map(|x| derive(x)).collect();
    for r in 0..rows {
        let at = |c: &[Vec<f64>]| -> Vec<f64> { c.iter().map(|x| x[r]).collect() };
        let tau = denavit::dynamics::drive_torques(&truth.dynamics, &at(&q), &at(&qd), &at(&qdd), None);
        (0..n).for_each(|j| columns.tau[j][r] = tau[j] + truth.offsets[j]);
    }
    let found = identify(&truth.model, &columns, &Asked::default()).expect("motion");
    let unseen: Vec<&str> = found.unseen().map(|k| truth.model.parameters[k].name.as_str()).collect();
    assert_eq!(found.estimate.joints[3].rows, 0);
    for name in ["FV4", "FS4", "offset4"] {
        assert!(unseen.contains(&name), "{unseen:?}");
    }
    // What the others show is still right.
    for (k, (known, value)) in found.estimate.known.iter().zip(truth.values()).enumerate() {
        if let Known::Value(x, s) = known {
            assert!((x - value).abs() < 6.0 * s, "{}: {x} ± {s}, {value}", truth.model.parameters[k].name);
        }
    }
}

/// Parameters that are 0 are left out, the others stay.
#[test]
fn an_f_test_leaves_out_what_is_nothing() {
    let mut truth = truth("staubli-rx90", 4, Sought::default());
    truth.offsets.fill(0.0);
    truth.dynamics.drives.iter_mut().for_each(|d| d.viscous = 0.0);
    let options = Options { robust: false, reduce: true };
    let columns = recording(&truth, &USUAL);
    let found = identify(&truth.model, &columns, &Asked { options, ..Asked::default() }).expect("motion");
    let values = truth.values();
    let (mut zeros, mut others) = (0, 0);
    for (known, value) in found.estimate.known.iter().zip(&values) {
        if let Known::LeftOut(x, s) = known {
            if *value == 0.0 {
                zeros += 1
            } else {
                others += 1
            };
            assert!((x - value).abs() < 4.0 * s, "{x} ± {s}, {value}");
        }
    }
    assert!(zeros >= 8, "{zeros} {others}");
    // Coulomb's friction is there, and stays.
    for (p, known) in truth.model.parameters.iter().zip(&found.estimate.known) {
        if p.name.starts_with("FS") {
            assert!(matches!(known, Known::Value(..)), "{}: {known:?}", p.name);
        }
    }
}

/// All rows as they are, where rates and accelerations are recorded.
#[test]
fn recorded_rates_are_taken() {
    let truth = truth("scara", 6, Sought::default());
    let clean = Setting { positions: 0.0, torques: 0.01, rate: 100.0, ..USUAL };
    let mut columns = recording(&truth, &clean);
    let derive = |x: &[f64]| -> Vec<f64> {
        let n = x.len();
        (0..n)
            .map(|r| {
                let at = r.clamp(2, n - 3);
                (8.0 * (x[at + 1] - x[at - 1]) - (x[at + 2] - x[at - 2])) / 12.0 * 100.0
            })
            .collect()
    };
    columns.qd = Some(columns.q.iter().map(|x| derive(x)).collect());
    columns.qdd = columns.qd.as_ref().map(|qd| qd.iter().map(|x| derive(x)).collect());
    let asked = Asked { cutoff: Cutoff::None, ..Asked::default() };
    let found = identify(&truth.model, &columns, &asked).expect("motion");
    let mut coverage = Coverage::default();
    coverage.take(&found, &truth.values());
    assert!(coverage.worst < 5.0 && coverage.unseen == 0, "{coverage:?}");
}
