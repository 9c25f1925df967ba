//! The file that is written has the torques that were recorded.

use crate::made::{USUAL, recording, truth};
use denavit::description::{Described, read_robot, write_toml};
use denavit::dynamics::{Dynamics, drive_torques};
use denavit_identification::{
    Asked, Column, Joints, NoColumns, Prior, Roles, Sought, Told, consistent, described, identify,
};
use denavit_recording::RolesError;

#[test]
fn the_written_robot_has_the_recorded_torques() {
    for name in ["staubli-rx90", "ur5", "franka-panda", "stanford", crate::recovery::GEARED] {
        let truth = truth(name, 31, Sought { rotors: true, ..Sought::default() });
        let columns = recording(&truth, &USUAL);
        let found = identify(&truth.model, &columns, &Asked::default()).expect("motion");
        let set = consistent(&truth.model, &found.estimate, &Prior::Neutral);
        let text = write_toml(&described(&truth.description, &truth.model, &set).expect("a table"));
        let (Described::Chain(back), findings) = read_robot(&text).expect("it reads back") else {
            panic!("a chain")
        };
        assert!(findings.is_empty(), "{name}: {findings:?}\n{text}");
        let read = Dynamics::numeric(&back).expect("numbers");
        // At states of another motion, beside the torques in truth.
        let other =
            recording(&truth, &crate::made::Setting { seed: 77, positions: 0.0, torques: 0.0, ..USUAL });
        let n = truth.model.joints();
        let rate = USUAL.rate;
        let (mut off, mut size) = (vec![0.0; n], vec![0.0; n]);
        for r in (10..other.time.len() - 10).step_by(50) {
            let at = |k: usize| -> Vec<f64> { other.q.iter().map(|x| x[k]).collect() };
            let (before, q, behind) = (at(r - 1), at(r), at(r + 1));
            let qd: Vec<f64> = before.iter().zip(&behind).map(|(a, b)| (b - a) * rate / 2.0).collect();
            let qdd: Vec<f64> = (0..n).map(|j| (before[j] - 2.0 * q[j] + behind[j]) * rate * rate).collect();
            let (a, b) = (
                drive_torques(&read, &q, &qd, &qdd, None),
                drive_torques(&truth.dynamics, &q, &qd, &qdd, None),
            );
            for j in 0..n {
                off[j] += (a[j] + set.offsets[j] - b[j] - truth.offsets[j]).powi(2);
                size[j] += b[j] * b[j];
            }
        }
        let parts: Vec<f64> = off.iter().zip(&size).map(|(a, b): (&f64, &f64)| (a / b).sqrt()).collect();
        println!("{}: {parts:.4?}", truth.description.name);
        assert!(parts.iter().all(|p| *p < 0.03), "{name}: {parts:?}");
    }
}

/// A recording without noise, made from masses: the masses that are found have its parameters.
#[test]
fn masses_that_were_recorded_are_found_to_be() {
    let exact = crate::made::Setting { positions: 0.0, torques: 0.0, ..USUAL };
    for name in ["staubli-rx90", "ur5"] {
        let truth = truth(name, 33, Sought::default());
        let found = identify(&truth.model, &recording(&truth, &exact), &Asked::default()).expect("motion");
        let set = consistent(&truth.model, &found.estimate, &Prior::Neutral);
        assert!(matches!(set.farthest, Some((_, off)) if off < 3.0), "{name}: {:?}", set.farthest);
    }
}

fn column(name: &str, unit: Option<&str>, values: &[f64]) -> Column {
    Column { name: name.into(), unit: unit.map(Into::into), values: values.to_vec() }
}

#[test]
fn columns_are_known_by_their_names_and_units() {
    let joints = Joints {
        names: vec![vec!["q1".into(), "q2".into()], vec!["shoulder".into(), "lift".into()]],
        turns: vec![true, false],
    };
    let x = [1.0, 2.0, 4.0];
    let all = [
        column("time", Some("ms"), &[0.0, 1.0, 2.0]),
        column("q1", Some("deg"), &x),
        column("q2", Some("mm"), &x),
        column("qd1", Some("rpm"), &x),
        column("qd2", Some("m/s"), &x),
        column("tau_1", Some("N mm"), &x),
        column("tau_2", Some("kN"), &x),
    ];
    let told = Told::default();
    let roles = Roles::find(&all, &joints, &told).expect("known");
    let si = roles.columns(&all, &joints, &told).expect("units");
    assert!((si.time[1] - 1e-3).abs() < 1e-15);
    assert!((si.q[0][0] - 1_f64.to_radians()).abs() < 1e-15 && (si.q[1][0] - 1e-3).abs() < 1e-15);
    assert!((si.qd.as_ref().expect("rates")[0][0] - 0.104_719_755).abs() < 1e-9);
    assert!((si.tau[0][0] - 1e-3).abs() < 1e-15 && (si.tau[1][0] - 1e3).abs() < 1e-12);
    // Degrees where no unit is said, and there alone.
    let mut bare = all.clone();
    bare[1].unit = None;
    let in_degrees = Told { degrees: true, ..Told::default() };
    let si = roles.columns(&bare, &joints, &in_degrees).expect("units");
    assert!((si.q[0][0] - 1_f64.to_radians()).abs() < 1e-15 && (si.q[1][0] - 1e-3).abs() < 1e-15);
    assert!((si.qd.expect("rates")[0][0] - 0.104_719_755).abs() < 1e-9);
    let named = [
        column("t", None, &[0.0, 0.1, 0.2]),
        column("shoulder_pos", None, &x),
        column("lift_pos", None, &x),
        column("shoulder_effort", None, &x),
        column("lift_effort", None, &x),
    ];
    let roles = Roles::find(&named, &joints, &told).expect("known");
    assert_eq!((roles.time, roles.joints, roles.torques), (Some(0), vec![1, 2], vec![3, 4]));
    // Hours are no step of a recording.
    let mut hours = all.clone();
    hours[0].unit = Some("h".into());
    let why = Roles::find(&hours, &joints, &told)
        .expect("known")
        .columns(&hours, &joints, &told)
        .expect_err("hours");
    assert!(matches!(why, NoColumns::Unit { what: "time", .. }), "{why:?}");
    // The rate that is told, not the time.
    let told_rate = Told { rate: Some(500.0), ..Told::default() };
    let roles = Roles::find(&named, &joints, &told_rate).expect("known");
    assert_eq!(roles.time, None);
    assert_eq!(roles.columns(&named, &joints, &told_rate).expect("units").time, [0.0, 0.002, 0.004]);
    // Currents without gains, units of something else, columns that are not there.
    let currents = [
        column("t", None, &x),
        column("q1", None, &x),
        column("q2", None, &x),
        column("current1", Some("mA"), &x),
        column("current2", Some("A"), &x),
    ];
    let roles = Roles::find(&currents, &joints, &told).expect("known");
    assert!(matches!(roles.columns(&currents, &joints, &told), Err(NoColumns::Currents(_))));
    let gains = Told { gains: Some(vec![5.0, 7.0]), ..Told::default() };
    let si = roles.columns(&currents, &joints, &gains).expect("gains");
    assert!((si.tau[0][0] - 5e-3).abs() < 1e-15 && (si.tau[1][0] - 7.0).abs() < 1e-15);
    let mut wrong = all.clone();
    wrong[1].unit = Some("mm".into());
    let roles = Roles::find(&wrong, &joints, &told).expect("known");
    assert!(matches!(roles.columns(&wrong, &joints, &told), Err(NoColumns::Unit { .. })));
    assert!(matches!(
        Roles::find(&all[..5], &joints, &told),
        Err(NoColumns::Roles(RolesError::Unknown("torques", _)))
    ));
    assert!(matches!(
        Roles::find(&all[1..], &joints, &told),
        Err(NoColumns::Roles(RolesError::Unknown("time", _)))
    ));
    let off = Told { torques: Some("nothing".into()), ..Told::default() };
    assert!(matches!(Roles::find(&all, &joints, &off), Err(NoColumns::Roles(RolesError::NoColumn(..)))));
}
