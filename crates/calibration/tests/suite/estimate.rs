//! Estimates: deviations that hold, rows that are grossly wrong, data that do not show everything, files that read back.

use crate::made::{Dice, POINT, arm, problem};
use denavit::catalogue;
use denavit::geometry::{Transform, Vector};
use denavit_calibration::model::link;
use denavit_calibration::{
    Bar, CalibrateOptions, Calibrated, Measured, Measurement, Parameter, Problem, Reading, Rows, State,
    Visible, calibrate, choose_poses, deviation_of_hand, visible,
};
use denavit_recording::turns::exp;

/// Noise of the study: 0.02° and 0.1 mm.
pub const NOISE: [f64; 2] = [0.000_349_065_850_398_865_9, 0.1e-3];

/// Errors in every number that is seen: 0.1° and 0.5 mm.
fn errors(problem: &Problem, visible: &Visible, dice: &mut Dice) -> State {
    let mut state = problem.nominal();
    for &k in &visible.kept {
        match visible.parameters[k] {
            Parameter::Turn(..) => state.x[k] = dice.normal(0.1_f64.to_radians()),
            Parameter::Shift(..) => state.x[k] = dice.normal(0.5e-3),
            Parameter::Gain(_) => state.x[k] = dice.normal(1e-3),
            Parameter::Fixture(..) => {}
        }
    }
    state
}

/// Measurements of an arm with errors.
fn measurements(problem: &Problem, truth: &State, rows: usize, noise: [f64; 2], dice: &mut Dice) -> Measured {
    let constants = problem.constants_at(truth);
    let mut measured = Measured::default();
    for q in problem.samples(rows, 1 + (1e9 * dice.unit()) as u64) {
        let hand = problem.arm.pose_with(&constants, &problem.joints_at(truth, &q));
        let mut three = |s: f64| Vector([dice.normal(s), dice.normal(s), dice.normal(s)]);
        let (turn, shift) = (three(noise[0]), three(noise[1]));
        let fixture = truth.fixtures.first();
        let distance = fixture.map_or(0.0, |f| f.reading(problem.measurement, hand.translation)) + shift[0];
        measured.readings.push(Reading {
            turn: hand.rotation * exp(turn),
            at: hand.translation + shift,
            distance,
            group: 0,
        });
        measured.joints.push(q);
        measured.episodes.push(0);
    }
    measured
}

/// Makes some rows grossly wrong: 5 mm and about 1°.
fn spoil(measured: &mut Measured, count: usize, dice: &mut Dice) -> Vec<usize> {
    let mut spoiled = vec![];
    while spoiled.len() < count {
        let r = ((dice.unit() * measured.readings.len() as f64) as usize).min(measured.readings.len() - 1);
        if spoiled.contains(&r) {
            continue;
        }
        spoiled.push(r);
        let mut three = |s: f64| Vector([dice.normal(s), dice.normal(s), dice.normal(s)]);
        let reading = &mut measured.readings[r];
        reading.at = reading.at + three(5e-3);
        reading.turn = reading.turn * exp(three(0.02));
    }
    spoiled
}

/// How far the hand is off on configurations of its own, mean, metres.
fn hand_off(problem: &Problem, truth: &State, found: &State) -> f64 {
    let (a, b) = (problem.constants_at(truth), problem.constants_at(found));
    let free = Problem { measurement: Measurement::Position, fixtures: vec![], ..problem.clone() };
    let poses = free.samples(100, 77);
    let off = |q: &Vec<f64>| {
        let (x, y) = (problem.joints_at(truth, q), problem.joints_at(found, q));
        (problem.arm.pose_with(&a, &x).translation - problem.arm.pose_with(&b, &y).translation).norm()
    };
    poses.iter().map(off).sum::<f64>() / poses.len() as f64
}

/// What came out of many simulated arms.
#[derive(Default)]
struct Study {
    inside: usize,
    all: usize,
    worst: f64,
    before: f64,
    behind: f64,
    arms: usize,
}

impl Study {
    fn add(&mut self, problem: &Problem, visible: &Visible, truth: &State, found: &Calibrated) {
        for (e, &k) in found.estimates.iter().zip(&visible.kept) {
            let [x, s] = e.value.expect("everything is seen");
            let z = (x - truth.x[k]).abs() / s;
            self.inside += usize::from(z < 3.0);
            self.worst = self.worst.max(z);
            self.all += 1;
        }
        self.before += hand_off(problem, truth, &problem.nominal());
        self.behind += hand_off(problem, truth, &found.state);
        self.arms += 1;
    }

    fn part(&self) -> f64 {
        self.inside as f64 / self.all as f64
    }

    fn said(&self, name: &str) -> String {
        let mean = |x: f64| 1e3 * x / self.arms as f64;
        format!(
            "{name}: {} arms, {} numbers, {:.2} % within 3 deviations, worst {:.1}; hand {:.2} -> {:.3} mm",
            self.arms,
            self.all,
            100.0 * self.part(),
            self.worst,
            mean(self.before),
            mean(self.behind)
        )
    }
}

const ARMS: [&str; 5] = ["ur5", "staubli-rx90", "franka-panda", "stanford", "scara"];

/// A case of the study: the measurement, how many rows of 60 are wrong, whether rows are weighed.
fn study(measurement: Measurement, wrong: usize, is_robust: bool, seeds: u64) -> Study {
    let mut study = Study::default();
    for (k, name) in ARMS.into_iter().enumerate() {
        let point = if measurement == Measurement::Pose { Vector([0.0; 3]) } else { POINT };
        let problem = problem(&arm(name), measurement, point, false);
        let visible = visible(&problem);
        for seed in 0..seeds {
            let mut dice = Dice::new(1000 * k as u64 + seed);
            let truth = errors(&problem, &visible, &mut dice);
            let mut measured = measurements(&problem, &truth, 60, NOISE, &mut dice);
            spoil(&mut measured, wrong, &mut dice);
            let options = CalibrateOptions { is_robust, folds: 0, ..CalibrateOptions::default() };
            let found = calibrate(&problem, &visible, &measured, &options).expect("an estimate");
            study.add(&problem, &visible, &truth, &found);
        }
    }
    study
}

/// A hundred arms of each of five in the soak, eight otherwise.
fn seeds() -> u64 {
    if std::env::var_os("DENAVIT_SOAK").is_some() { 100 } else { 8 }
}

#[test]
fn deviations_hold_for_full_poses() {
    let study = study(Measurement::Pose, 0, false, seeds());
    println!("{}", study.said("full pose"));
    assert!(study.part() > 0.99, "{}", study.said("full pose"));
    assert!(study.behind < 0.05 * study.before, "{}", study.said("full pose"));
}

#[test]
fn deviations_hold_for_positions() {
    let study = study(Measurement::Position, 0, false, seeds());
    println!("{}", study.said("position"));
    assert!(study.part() > 0.99, "{}", study.said("position"));
    assert!(study.behind < 0.05 * study.before, "{}", study.said("position"));
}

/// Three rows of sixty are off by millimetres: the biweight is within a fifth of clean rows, least squares are far off.
#[test]
fn gross_errors() {
    let clean = study(Measurement::Pose, 0, false, seeds());
    let least = study(Measurement::Pose, 3, false, seeds());
    let robust = study(Measurement::Pose, 3, true, seeds());
    for (study, name) in [(&least, "gross errors, least squares"), (&robust, "gross errors, biweight")] {
        println!("{}", study.said(name));
    }
    assert!(robust.part() > 0.99, "{}", robust.said("biweight"));
    assert!(robust.behind < 1.2 * clean.behind, "{} {}", robust.behind, clean.behind);
    assert!(least.behind > 3.0 * robust.behind, "{} {}", least.behind, robust.behind);
}

/// Clean rows weighed by the biweight: little is lost, and deviations hold.
#[test]
fn the_biweight_on_clean_rows() {
    let clean = study(Measurement::Pose, 0, false, seeds());
    let robust = study(Measurement::Pose, 0, true, seeds());
    println!("{}", robust.said("clean, biweight"));
    assert!(robust.part() > 0.99 && robust.behind < 1.2 * clean.behind, "{}", robust.said("biweight"));
}

/// Orientations, distances, planes: the numbers are found, by more rows.
#[test]
fn other_measurements() {
    for (measurement, rows) in [
        (Measurement::Orientation, 60),
        (Measurement::Distance(Bar::Measured), 400),
        (Measurement::Distance(Bar::Offset), 400),
        (Measurement::Distance(Bar::Fixed), 400),
        (Measurement::Plane, 500),
    ] {
        let problem = problem(&arm("staubli-rx90"), measurement, POINT, false);
        let visible = visible(&problem);
        let (mut inside, mut all) = (0, 0);
        for seed in 0..seeds() / 4 {
            let mut dice = Dice::new(300 + seed);
            let truth = errors(&problem, &visible, &mut dice);
            let measured = measurements(&problem, &truth, rows, [1e-4, 2e-5], &mut dice);
            let found = calibrate(
                &problem,
                &visible,
                &measured,
                &CalibrateOptions { folds: 0, ..CalibrateOptions::default() },
            )
            .expect("an estimate");
            assert_eq!(found.unseen.len(), 0, "{measurement:?}: {:?}", found.unseen);
            for (e, &k) in found.estimates.iter().zip(&visible.kept) {
                // Where nothing says how long anything is no length is told by itself.
                let Some([x, s]) = e.value else {
                    assert!(visible.scaled().is_some_and(|(_, with)| with.contains(&k)), "{:?}", e.parameter);
                    continue;
                };
                inside += usize::from((x - truth.x[k]).abs() < 3.0 * s);
                all += 1;
            }
        }
        println!("{measurement:?}: {inside} of {all} within 3 deviations");
        assert_eq!(measurement == Measurement::Plane, visible.scaled().is_some());
        assert!(inside as f64 > 0.97 * f64::from(all), "{measurement:?}: {inside} of {all}");
    }
}

/// A joint that does not move, and few poses: what is not seen is named and held, and no number is given for it.
#[test]
fn what_rows_do_not_show_is_held() {
    let problem = problem(&arm("ur5"), Measurement::Pose, Vector([0.0; 3]), false);
    let visible = visible(&problem);
    let mut dice = Dice::new(5);
    let truth = errors(&problem, &visible, &mut dice);
    let mut measured = measurements(&problem, &truth, 60, NOISE, &mut dice);
    // Joint 5 stands still: anew, with the same readings' noise.
    let constants = problem.constants_at(&truth);
    for (q, r) in measured.joints.iter_mut().zip(&mut measured.readings) {
        q[4] = 0.7;
        let hand = problem.arm.pose_with(&constants, q);
        r.at = hand.translation + Vector([dice.normal(1e-4), dice.normal(1e-4), dice.normal(1e-4)]);
        r.turn = hand.rotation * exp(Vector([dice.normal(3e-4), dice.normal(3e-4), dice.normal(3e-4)]));
    }
    let found = calibrate(&problem, &visible, &measured, &CalibrateOptions::default()).expect("an estimate");
    // Axis 5 is a part of its link then: four numbers less.
    assert_eq!(found.unseen.len(), 4, "{:?}", found.unseen);
    assert!(found.estimates.iter().any(|e| e.value.is_none()));
    // What is given is right; what is not seen does no harm where the joint stands.
    for (e, &k) in found.estimates.iter().zip(&visible.kept) {
        if let Some([x, s]) = e.value {
            assert!((x - truth.x[k]).abs() < 4.5 * s, "{:?}: {x} ± {s}, {}", e.parameter, truth.x[k]);
        }
    }
    assert!(found.after.shift < 3e-4, "{:?}", found.after);

    let few = Measured {
        joints: measured.joints[..3].to_vec(),
        readings: measured.readings[..3].to_vec(),
        episodes: vec![0; 3],
    };
    let found = calibrate(
        &problem,
        &visible,
        &few,
        &CalibrateOptions { noise: Some(NOISE), ..CalibrateOptions::default() },
    )
    .expect("an estimate");
    assert!(found.unseen.len() >= 30 - 18, "{}", found.unseen.len());
}

/// Poses that were computed from the joints are known for it.
#[test]
fn computed_poses() {
    let problem = problem(&arm("ur5"), Measurement::Pose, Vector([0.0; 3]), false);
    let visible = visible(&problem);
    let mut dice = Dice::new(6);
    let truth = errors(&problem, &visible, &mut dice);
    let measured = measurements(&problem, &truth, 60, [1e-9, 1e-9], &mut dice);
    let found = calibrate(&problem, &visible, &measured, &CalibrateOptions::default()).expect("an estimate");
    assert!(found.is_computed && hand_off(&problem, &truth, &found.state) < 1e-7);
    let real = measurements(&problem, &truth, 60, NOISE, &mut dice);
    let found = calibrate(&problem, &visible, &real, &CalibrateOptions::default()).expect("an estimate");
    assert!(!found.is_computed);
    // The noise of each kind is found, and rows that were left out are off by as much.
    assert!((found.noise[0] / NOISE[0] - 1.0).abs() < 0.25 && (found.noise[1] / NOISE[1] - 1.0).abs() < 0.25);
    let [before, behind] = found.held_out.expect("five parts");
    assert!(behind.shift < 0.5 * before.shift && behind.shift > found.after.shift * 0.9);
}

/// Gains are found beside the geometry.
#[test]
fn gains() {
    let problem = problem(&arm("stanford"), Measurement::Pose, Vector([0.0; 3]), true);
    let visible = visible(&problem);
    let mut dice = Dice::new(9);
    let truth = errors(&problem, &visible, &mut dice);
    let measured = measurements(&problem, &truth, 80, NOISE, &mut dice);
    let found = calibrate(&problem, &visible, &measured, &CalibrateOptions::default()).expect("an estimate");
    assert!(hand_off(&problem, &truth, &found.state) < 0.15e-3);
    let gains = found.estimates.iter().filter(|e| matches!(e.parameter, Parameter::Gain(_))).count();
    assert_eq!(gains, 6);
}

/// All arms of the catalogue, with errors, as a robot file in each convention: what is read back is the arm to the last digits.
#[test]
fn files_read_back() {
    let mut dice = Dice::new(12);
    let mut refused = vec![];
    let mut count = 0;
    for name in catalogue::names() {
        let Some(description) = catalogue::robot(name).map(|d| d.filled()) else { continue };
        for convention in denavit::description::Convention::ALL {
            let description = description.converted(convention).description;
            let Ok(arm) = denavit_recording::Arm::new(name, &description) else { continue };
            let mut constants = arm.constants.clone();
            for c in &mut constants {
                let mut three = |s: f64| Vector([dice.normal(s), dice.normal(s), dice.normal(s)]);
                *c = *c * Transform::from_rotation_translation(exp(three(0.003)), three(1e-3));
            }
            let rows = match Rows::new(&description) {
                Ok(rows) => rows,
                Err(e) => {
                    refused.push(format!("{name}: {e}"));
                    continue;
                }
            };
            let table = rows.table(&constants);
            let text = rows.text(&table, None, None);
            let mut at = vec![];
            for _ in 0..20 {
                at.push(arm.limits.iter().map(|l| l[0] + (l[1] - l[0]) * dice.unit()).collect::<Vec<f64>>());
            }
            if let Err(e) = rows.read_back(&text, &constants, None, &at) {
                panic!("{name} {convention}: {e}\n{text}");
            }
            // Angles and lengths are near those that there were.
            for (own, old) in table.rows.iter().zip(rows.nominal()) {
                for k in [2, 3, 4] {
                    assert!(
                        (own.cells[k] - old.cells[k]).abs() < 0.08,
                        "{name} {convention} {k}: {own:?} {old:?}"
                    );
                }
            }
            count += 1;
        }
    }
    assert!(count > 240, "{count}: {refused:?}");
}

/// With gains, too.
#[test]
fn files_with_gains_read_back() {
    let description = catalogue::robot("stanford").expect("it is there").filled();
    let arm = arm("stanford");
    let rows = Rows::new(&description).expect("rows");
    let gains = [0.001, -0.002, 0.003, 0.0, 0.0005, -0.001];
    let table = rows.table(&arm.constants);
    let text = rows.text(&table, Some(&gains), None);
    let at = vec![vec![0.3, -0.4, 0.5, 0.6, -0.7, 0.8], vec![-1.3, 0.4, 0.2, 1.6, 0.7, -0.8]];
    if let Err(e) = rows.read_back(&text, &arm.constants, Some(&gains), &at) {
        panic!("{e}\n{text}");
    }
}

/// Chosen poses are worth more than as many at random, and the deviation that is foretold is the one that comes.
#[test]
fn chosen_poses() {
    for name in ["ur5", "scara"] {
        let problem = problem(&arm(name), Measurement::Pose, Vector([0.0; 3]), false);
        let visible = visible(&problem);
        let candidates = problem.samples(300, 3);
        for count in [8, 12] {
            let chosen = choose_poses(&problem, &visible, &candidates, count, NOISE, 1);
            println!("{name} {count}: chosen {:?}, random {:?}", chosen.deviation, chosen.random);
            let mut numbers = chosen.chosen.clone();
            numbers.sort_unstable();
            numbers.dedup();
            assert_eq!((numbers.len(), chosen.unseen), (count, 0));
            let (own, random) = chosen.deviation.zip(chosen.random).expect("poses tell of the hand");
            assert!(own[0] < 0.85 * random[0] && own[1] < 0.85 * random[1], "{name} {count}");
        }
        // The deviation that is said is that of the hand of simulated arms.
        let chosen = choose_poses(&problem, &visible, &candidates, 20, NOISE, 1);
        let joints: Vec<Vec<f64>> = chosen.chosen.iter().map(|&c| candidates[c].clone()).collect();
        let mut squares = vec![];
        let mut foretold = 0.0;
        for seed in 0..30 {
            let mut dice = Dice::new(500 + seed);
            let truth = errors(&problem, &visible, &mut dice);
            let constants = problem.constants_at(&truth);
            let mut measured = Measured::default();
            for q in &joints {
                let hand = problem.arm.pose_with(&constants, q);
                let mut three = |s: f64| Vector([dice.normal(s), dice.normal(s), dice.normal(s)]);
                let (turn, shift) = (three(NOISE[0]), three(NOISE[1]));
                let (turn, at) = (hand.rotation * exp(turn), hand.translation + shift);
                measured.readings.push(Reading { turn, at, distance: 0.0, group: 0 });
                measured.joints.push(q.clone());
                measured.episodes.push(0);
            }
            let options = CalibrateOptions { noise: Some(NOISE), folds: 0, ..CalibrateOptions::default() };
            let found = calibrate(&problem, &visible, &measured, &options).expect("an estimate");
            squares.push(hand_off(&problem, &truth, &found.state).powi(2));
            foretold = deviation_of_hand(&problem, &visible, &found).expect("all is seen")[0];
        }
        let real = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
        let said = chosen.deviation.expect("poses tell of the hand")[0];
        println!("{name}: foretold {} mm, came {} mm", 1e3 * said, 1e3 * real);
        assert!((real / said - 1.0).abs() < 0.25, "{name}: {real} {:?}", chosen.deviation);
        assert!((foretold / said - 1.0).abs() < 0.4, "{name}: {foretold}");
    }
}

/// The value of an error is what the constant has.
#[test]
fn parameters_are_what_they_say() {
    let problem = problem(&arm("ur5"), Measurement::Pose, Vector([0.0; 3]), false);
    let mut state = problem.nominal();
    state.x[6 * 2] = 0.01;
    state.x[6 * 2 + 4] = 0.002;
    let (w, v) = link(&state.x, 2);
    assert_eq!((w.0, v.0), ([0.01, 0.0, 0.0], [0.0, 0.002, 0.0]));
    let by = problem.constants[2].inverse() * problem.constants_at(&state)[2];
    assert!(
        (by.translation[1] - 0.002).abs() < 1e-15
            && (by.rotation.rows()[2][1] - 0.01_f64.sin()).abs() < 1e-15
    );
}
