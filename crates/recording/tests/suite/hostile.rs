//! Columns that nobody should write: errors or findings, no panic.

use crate::made::{Dice, NOMINAL, Setting, arm, make};
use denavit_recording::{Column, HoldError, HoldOptions, Recording, Roles, RolesError, Slip, Told, hold};

/// Whatever comes of it.
fn held(name: &str, recording: &Recording, roles: &Roles) -> Result<Vec<Slip>, HoldError> {
    let held = hold(&arm(name), recording, roles, &HoldOptions { others: false, format: None })?;
    let _ = held.recipe.to_string();
    Ok(held.findings.into_iter().map(|f| f.slip).collect())
}

#[test]
fn numbers_of_every_kind() {
    let short = Setting { rows: 60, ..NOMINAL };
    let made = make("ur5", &["xyzw"], 1, &short);
    let values =
        [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -0.0, 1e300, -1e300, 1e-300, 1.0, f64::MAX];
    for c in 0..made.recording.columns.len() {
        // Each column takes some of them.
        for value in (0..3).map(|k| values[(c + 3 * k) % values.len()]) {
            let mut recording = made.recording.clone();
            recording.columns[c].values.fill(value);
            let _ = held("ur5", &recording, &made.roles);
        }
    }
    // Single ones, anywhere.
    let mut dice = Dice::new(3);
    for _ in 0..15 {
        let mut recording = made.recording.clone();
        for _ in 0..1 + dice.below(60) {
            let (c, r) = (dice.below(recording.columns.len()), dice.below(60));
            recording.columns[c].values[r] = dice.one_of(&values);
        }
        let _ = held("ur5", &recording, &made.roles);
    }
}

#[test]
fn missing_numbers_are_told_and_left_aside() {
    let mut made = make("ur5", &[], 2, &NOMINAL);
    for r in [5, 6, 300] {
        made.recording.columns[3].values[r] = f64::NAN;
    }
    let ur5 = arm("ur5");
    let held = hold(&ur5, &made.recording, &made.roles, &HoldOptions::default()).expect("held");
    assert_eq!(held.findings, []);
    assert!(held.remarks.iter().any(|f| f.slip == Slip::Missing(vec![5, 6, 300])), "{:?}", held.remarks);
}

#[test]
fn time_that_goes_back() {
    let mut made = make("ur5", &[], 3, &NOMINAL);
    made.recording.columns[0].values[400] = 1.0;
    let found = held("ur5", &made.recording, &made.roles).expect("held");
    assert!(matches!(&found[..], [Slip::TimeBack(rows)] if rows == &[400]), "{found:?}");
}

#[test]
fn few_rows_and_columns() {
    let made = make("ur5", &["xyzw"], 4, &Setting { rows: 40, ..NOMINAL });
    for rows in 0..12 {
        let mut recording = made.recording.clone();
        recording.columns.iter_mut().for_each(|c| c.values.truncate(rows));
        let is_error = held("ur5", &recording, &made.roles).is_err();
        assert!(is_error || rows >= 8, "{rows}");
    }
    let roles = |change: &dyn Fn(&mut Roles)| {
        let mut roles = made.roles.clone();
        change(&mut roles);
        held("ur5", &made.recording, &roles)
    };
    assert_eq!(roles(&|r| r.joints.truncate(5)), Err(HoldError::Joints { found: 5, needed: 6 }));
    assert_eq!(roles(&|r| r.joints.clear()), Err(HoldError::Joints { found: 0, needed: 6 }));
    assert_eq!(roles(&|r| r.joints = vec![1; 30]), Err(HoldError::TooManyJoints { found: 30, needed: 6 }));
    assert_eq!(roles(&|r| r.position.truncate(2)), Err(HoldError::Position(2)));
    assert_eq!(roles(&|r| r.rotation.truncate(2)), Err(HoldError::Rotation(2)));
    assert_eq!(roles(&|r| r.rotation[0] = 999), Err(HoldError::Lengths));
    assert_eq!(
        held("ur5", &Recording::default(), &Roles::default()),
        Err(HoldError::Joints { found: 0, needed: 6 })
    );
}

#[test]
fn noise_is_not_understood() {
    let mut dice = Dice::new(5);
    let column = |k: usize, dice: &mut Dice| Column {
        name: format!("ünì {k} 列"),
        said: None,
        values: (0..300).map(|_| dice.normal(1.0)).collect(),
    };
    let recording = Recording { columns: (0..13).map(|k| column(k, &mut dice)).collect() };
    let roles = Roles {
        joints: (0..6).collect(),
        position: vec![6, 7, 8],
        rotation: vec![9, 10, 11],
        ..Roles::default()
    };
    let found = held("ur5", &recording, &roles).expect("held");
    assert_eq!(found, [Slip::NotUnderstood]);
    let error = Roles::find(&recording, &arm("ur5"), &Told::default());
    assert!(matches!(error, Err(RolesError::Unknown("joints", _))));
}

#[test]
fn columns_told_by_hand() {
    let made = make("ur5", &[], 6, &Setting { rows: 30, ..NOMINAL });
    let told = |joints: &str, position: &str| {
        let text = |t: &str| Some(t.to_string());
        let told =
            Told { joints: text(joints), position: text(position), time: None, rotation: text("r0..r2") };
        Roles::find(&made.recording, &arm("ur5"), &told)
    };
    let roles = told("c0..c5", "x,y, z").expect("they are there");
    assert_eq!((roles.joints, roles.position, roles.time), ((1..7).collect(), vec![7, 8, 9], Some(0)));
    assert_eq!(told("c5..c0", "x,y,z").expect("they are there").joints, [6, 5, 4, 3, 2, 1]);
    assert!(matches!(told("c0..c9", "x,y,z"), Err(RolesError::NoColumn(name, _)) if name == "c9"));
    assert!(matches!(told("", "x,y,z"), Err(RolesError::Unknown("joints", _)) | Ok(_)));
}

#[test]
fn columns_by_their_names() {
    let heads = [
        "t,q1,q2,q3,q4,q5,q6,x,y,z,rx,ry,rz",
        "timestamp,actual_q_0,actual_q_1,actual_q_2,actual_q_3,actual_q_4,actual_q_5,actual_TCP_pose_0,actual_TCP_pose_1,actual_TCP_pose_2,actual_TCP_pose_3,actual_TCP_pose_4,actual_TCP_pose_5",
        "time,joint_1,joint_2,joint_3,joint_4,joint_5,joint_6,px,py,pz,qx,qy,qz,qw",
        "J1,J2,J3,J4,J5,J6,X,Y,Z,A,B,C",
        "stamp,position[0],position[1],position[2],position[3],position[4],position[5],pose.position.x,pose.position.y,pose.position.z,pose.orientation.x,pose.orientation.y,pose.orientation.z,pose.orientation.w",
        "state[0],state[1],state[2],state[3],state[4],state[5],state[6],pose[0],pose[1],pose[2],pose[3],pose[4],pose[5],pose[6]",
        "theta1,theta2,theta3,theta4,theta5,theta6,dq1,dq2,dq3,dq4,dq5,dq6,x,y,z,roll,pitch,yaw",
    ];
    for head in heads {
        let column = |name: &str| Column { name: name.into(), said: None, values: vec![0.0; 10] };
        let recording = Recording { columns: head.split(',').map(column).collect() };
        let roles =
            Roles::find(&recording, &arm("ur5"), &Told::default()).unwrap_or_else(|e| panic!("{head}: {e}"));
        let joints = if head.contains("state[6]") { 7 } else { 6 };
        let width = recording.columns.len()
            - joints
            - 3
            - usize::from(roles.time.is_some())
            - if head.contains("dq1") { 6 } else { 0 };
        assert_eq!(
            (roles.joints.len(), roles.position.len(), roles.rotation.len()),
            (joints, 3, width),
            "{head}"
        );
    }
}
