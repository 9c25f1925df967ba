//! Columns as measurements: planes and centres that nobody told, formats, frames, and what is refused.

use crate::made::{Dice, POINT, arm};
use denavit::geometry::{Transform, Vector};
use denavit_calibration::measured::{NoMeasurements, What, prepare};
use denavit_calibration::visible::supposed;
use denavit_calibration::{Bar, CalibrateOptions, Measurement, Problem, calibrate, visible};
use denavit_recording::turns::exp;
use denavit_recording::{Arm, Column, Form, Format, HoldError, Recording, Roles};

/// The arm with errors of 0.1° and 0.5 mm at the end of every link.
fn real(arm: &Arm, dice: &mut Dice) -> Vec<Transform<f64>> {
    let by = |dice: &mut Dice| {
        let mut three = |s: f64| Vector([dice.normal(s), dice.normal(s), dice.normal(s)]);
        Transform::from_rotation_translation(exp(three(1.7e-3)), three(0.5e-3))
    };
    arm.constants.iter().map(|c| *c * by(dice)).collect()
}

fn what(measurement: Measurement) -> What {
    What {
        measurement,
        point: if measurement.is_of_point() { POINT } else { Vector([0.0; 3]) },
        gains: false,
        distance: None,
        group: None,
        length: None,
        recipe: None,
        is_unchecked: false,
        is_robust: false,
    }
}

fn columns(rows: &[Vec<f64>], names: &[&str]) -> Recording {
    let column = |(k, name): (usize, &&str)| Column {
        name: (*name).into(),
        said: None,
        values: rows.iter().map(|r| r[k]).collect(),
    };
    Recording { columns: names.iter().enumerate().map(column).collect() }
}

/// Planes that the arm touches, two of them, and a bar of one length: on configurations that were not measured the point of the
/// calibrated arm is where it should be.
#[test]
fn surfaces() {
    for (measurement, groups) in [
        (Measurement::Plane, 1),
        (Measurement::Plane, 2),
        (Measurement::Distance(Bar::Fixed), 1),
        (Measurement::Distance(Bar::FixedUnknown), 1),
    ] {
        let mut dice = Dice::new(21);
        let arm = arm("staubli-rx90");
        let mut truth =
            Problem::new(&arm, measurement, POINT, false, supposed(&arm, measurement, POINT, groups));
        truth.constants = real(&arm, &mut dice);
        let last = truth.last();
        truth.constants[last] = truth.constants[last] * Transform::translation(POINT[0], POINT[1], POINT[2]);
        let noise = 2e-5;
        let mut rows = vec![];
        for group in 0..groups {
            for mut q in truth.samples_on(group, 300, 5 + group as u64) {
                // What touches is a little off, and so is what the joints say.
                q.iter_mut().for_each(|q| *q += dice.normal(0.5 * noise));
                q.push(group as f64);
                rows.push(q);
            }
        }
        assert_eq!(rows.len(), 300 * groups);
        let recording = columns(&rows, &["q1", "q2", "q3", "q4", "q5", "q6", "surface"]);
        let roles = Roles { joints: (0..6).collect(), ..Roles::default() };
        let length =
            matches!(measurement, Measurement::Distance(Bar::Fixed)).then(|| truth.fixtures[0].length);
        let asked = What { group: Some(6), length, ..what(measurement) };
        let prepared = prepare(&arm, &recording, &roles, &asked).expect("measurements");
        let visible = visible(&prepared.problem);
        assert_eq!((visible.rank, visible.found()), (visible.kept.len(), 0), "{measurement:?}");
        let options = CalibrateOptions { folds: 0, ..CalibrateOptions::default() };
        let found =
            calibrate(&prepared.problem, &visible, &prepared.measured, &options).expect("an estimate");
        assert_eq!(found.unseen.len(), 0, "{measurement:?} {:?}", found.unseen);
        assert!(found.after.shift < 3.0 * noise, "{measurement:?}: {:?} {:?}", found.before, found.after);
        assert!(found.after.shift < 0.1 * found.before.shift, "{measurement:?}: {:?}", found.before);
        let constants = prepared.problem.constants_at(&found.state);
        for group in 0..groups {
            let others = truth.samples_on(group, 50, 77);
            let off = |q: &Vec<f64>| {
                let at = arm.pose_with(&constants, q).translation;
                found.state.fixtures[group].reading(measurement, at).powi(2)
            };
            let off = (others.iter().map(off).sum::<f64>() / 50.0).sqrt();
            assert!(off < 3.0 * noise, "{measurement:?} {group}: {off}");
        }
    }
}

/// Orientations in a format that is not told, seen from another base.
#[test]
fn orientations() {
    let mut dice = Dice::new(22);
    let arm = arm("ur5");
    let constants = real(&arm, &mut dice);
    let other = exp(Vector([0.5, 0.2, -1.0]));
    // Which axes angles are about is not told apart from a base that is turned.
    for (form, width, base) in [
        (Form::RotationVector, 3, other),
        (Form::QuaternionWxyz, 4, other),
        (Form::QuaternionXyzw, 4, other),
        (Form::Euler(3, true), 3, exp(Vector([0.0; 3]))),
    ] {
        let format = Format { form, degrees: form != Form::RotationVector && width == 3 };
        let mut rows = vec![];
        for _ in 0..60 {
            let q: Vec<f64> = arm.limits.iter().map(|[l, h]| l + (h - l) * dice.unit()).collect();
            let turn = base * arm.pose_with(&constants, &q).rotation;
            let noise = Vector([dice.normal(1e-4), dice.normal(1e-4), dice.normal(1e-4)]);
            rows.push([q, format.write(&(turn * exp(noise)), None)].concat());
        }
        let names = ["q1", "q2", "q3", "q4", "q5", "q6", "a", "b", "c", "d"];
        let recording = columns(&rows, &names[..6 + width]);
        let roles =
            Roles { joints: (0..6).collect(), rotation: (6..6 + width).collect(), ..Roles::default() };
        let prepared =
            prepare(&arm, &recording, &roles, &what(Measurement::Orientation)).expect("measurements");
        assert_eq!(prepared.format, Some(format));
        let visible = visible(&prepared.problem);
        assert_eq!(visible.kept.len(), 15);
        let options = CalibrateOptions::default();
        let found =
            calibrate(&prepared.problem, &visible, &prepared.measured, &options).expect("an estimate");
        assert_eq!(found.unseen.len(), 0);
        assert!((found.noise[0] / 1e-4 - 1.0).abs() < 0.3, "{:?}", found.noise);
        assert!(found.held_out.is_some());
        // More parts than rows are none.
        let options = CalibrateOptions { folds: usize::MAX, ..options };
        let found =
            calibrate(&prepared.problem, &visible, &prepared.measured, &options).expect("an estimate");
        assert_eq!(found.held_out, None);
    }
}

/// Joints in degrees, and positions in millimetres, are told as a hint; nothing is converted in silence.
#[test]
fn units_are_not_guessed() {
    let mut dice = Dice::new(23);
    let arm = arm("ur5");
    let problem = Problem::new(&arm, Measurement::Position, POINT, false, vec![]);
    let rows: Vec<Vec<f64>> = (0..40)
        .map(|_| {
            let q: Vec<f64> = arm.limits.iter().map(|[l, h]| l + (h - l) * dice.unit()).collect();
            let at = arm.pose_with(&problem.constants, &q).translation;
            [q.iter().map(|q| q.to_degrees()).collect(), at.scale(1e3).0.to_vec()].concat()
        })
        .collect();
    let recording = columns(&rows, &["q1", "q2", "q3", "q4", "q5", "q6", "x", "y", "z"]);
    let roles = Roles { joints: (0..6).collect(), position: (6..9).collect(), ..Roles::default() };
    match prepare(&arm, &recording, &roles, &what(Measurement::Position)) {
        Err(NoMeasurements::Far(_, false, Some(hint))) => {
            assert!(hint.contains("degrees") && hint.contains("millimetres"), "{hint}");
        }
        other => panic!("{other:?}"),
    }
}

/// Joints that are not told, more rows than are used, and rows without a number.
#[test]
fn columns_and_rows_are_counted() {
    let mut dice = Dice::new(24);
    let arm = arm("ur5");
    let problem = Problem::new(&arm, Measurement::Position, POINT, false, vec![]);
    let mut rows: Vec<Vec<f64>> = (0..6004)
        .map(|_| {
            let q: Vec<f64> = arm.limits.iter().map(|[l, h]| l + (h - l) * dice.unit()).collect();
            let x = arm.pose_with(&problem.constants, &q);
            [
                q,
                x.translation.0.to_vec(),
                Format { form: Form::RotationVector, degrees: false }.write(&x.rotation, None),
            ]
            .concat()
        })
        .collect();
    (0..3).for_each(|r| rows[r][7] = f64::NAN);
    let names = ["q1", "q2", "q3", "q4", "q5", "q6", "x", "y", "z", "rx", "ry", "rz"];
    let recording = columns(&rows, &names);
    let roles = Roles {
        joints: (0..6).collect(),
        position: (6..9).collect(),
        rotation: (9..12).collect(),
        ..Roles::default()
    };
    for measurement in [Measurement::Position, Measurement::Pose] {
        let asked = What { is_unchecked: true, ..what(measurement) };
        let prepared = prepare(&arm, &recording, &roles, &asked).expect("measurements");
        assert_eq!((prepared.left, prepared.every, prepared.rows.len()), (3, 3, 2001), "{measurement:?}");
        let fewer = Roles { joints: (0..5).collect(), ..roles.clone() };
        match prepare(&arm, &recording, &fewer, &asked) {
            Err(NoMeasurements::Hold(HoldError::Joints { found: 5, needed: 6 })) => {}
            other => panic!("{measurement:?}: {other:?}"),
        }
    }
}

/// Nothing that columns hold makes it panic.
#[test]
fn hostile_columns() {
    let arm = arm("scara");
    let roles = Roles {
        joints: (0..4).collect(),
        position: (4..7).collect(),
        rotation: (7..10).collect(),
        ..Roles::default()
    };
    let names = ["q1", "q2", "q3", "q4", "x", "y", "z", "rx", "ry", "rz"];
    for value in [0.0, 1.0, -1e300, f64::NAN, f64::INFINITY, 1e-300] {
        for count in [0, 1, 5, 6, 40] {
            let rows = vec![vec![value; 10]; count];
            let recording = columns(&rows, &names);
            for measurement in [
                Measurement::Pose,
                Measurement::Position,
                Measurement::Orientation,
                Measurement::Distance(Bar::Measured),
                Measurement::Distance(Bar::FixedUnknown),
                Measurement::Plane,
            ] {
                for is_unchecked in [false, true] {
                    let asked = What { distance: Some(4), is_unchecked, ..what(measurement) };
                    let Ok(prepared) = prepare(&arm, &recording, &roles, &asked) else { continue };
                    let visible = visible(&prepared.problem);
                    let options = CalibrateOptions { is_robust: true, ..CalibrateOptions::default() };
                    if let Ok(found) = calibrate(&prepared.problem, &visible, &prepared.measured, &options) {
                        // One configuration shows no more than its own numbers.
                        assert!(
                            visible.kept.len() - found.unseen.len() <= measurement.width(),
                            "{measurement:?} {value}"
                        );
                    }
                }
            }
        }
    }
}
