//! Recordings in which little moves, and columns that do not follow.

use crate::made::{Made, NOMINAL, Noise, Setting, arm, make};
use denavit_recording::{HoldOptions, Slip, Unseen, hold, words};

/// Keeps the joints still but some.
fn only(made: &mut Made, name: &str, moving: &[usize]) {
    let arm = arm(name);
    let n = arm.joints();
    let rows = made.poses.len();
    for i in (0..n).filter(|i| !moving.contains(i)) {
        let first = made.recording.columns[1 + i].values[0];
        made.recording.columns[1 + i].values.fill(first);
    }
    // The poses anew, with noise of the position alone.
    let format = denavit_recording::Format { form: denavit_recording::Form::QuaternionXyzw, degrees: false };
    made.recording.columns.truncate(1 + n);
    let mut columns = vec![vec![]; 7];
    let mut dice = crate::made::Dice::new(9);
    for r in 0..rows {
        let q: Vec<f64> = (0..n).map(|i| made.recording.columns[1 + i].values[r]).collect();
        let pose = arm.pose(&q);
        let turn = format.write(&pose.rotation, None);
        let all = pose.translation.0.iter().map(|x| x + dice.normal(0.3e-3)).chain(turn);
        all.enumerate().for_each(|(k, x)| columns[k].push(x));
    }
    for (k, values) in columns.into_iter().enumerate() {
        let name = format!("p{k}");
        made.recording.columns.push(denavit_recording::Column { name, said: None, values });
    }
    made.roles.position = (n + 1..n + 4).collect();
    made.roles.rotation = (n + 4..n + 8).collect();
}

#[test]
fn one_joint_alone() {
    for name in ["ur5", "staubli-rx90", "scara"] {
        for joint in [1, 2] {
            let mut made = make(name, &[], 11, &NOMINAL);
            only(&mut made, name, &[joint]);
            let held = hold(&arm(name), &made.recording, &made.roles, &HoldOptions::default()).expect("held");
            assert_eq!(held.findings, [], "{name} {joint}");
            let still = held.unseen.iter().filter(|u| matches!(u, Unseen::Still(_))).count();
            assert_eq!(still, arm(name).joints() - 1, "{name} {joint}: {:?}", held.unseen);
        }
    }
}

#[test]
fn nothing_moves() {
    let mut made = make("ur5", &[], 12, &NOMINAL);
    only(&mut made, "ur5", &[]);
    let held = hold(&arm("ur5"), &made.recording, &made.roles, &HoldOptions::default()).expect("held");
    assert_eq!((held.findings.len(), &held.unseen[..]), (0, &[Unseen::Everything][..]));
}

#[test]
fn a_sign_that_cannot_be_seen() {
    let little = Setting { motion: 0.002, noise: Noise(1e-3, 0.3, 0.02), ..NOMINAL };
    let made = make("ur5", &[], 5, &little);
    let held = hold(&arm("ur5"), &made.recording, &made.roles, &HoldOptions::default()).expect("held");
    assert_eq!(held.findings, []);
    assert!(held.unseen.iter().any(|u| matches!(u, Unseen::Sign(..))), "{:?}", held.unseen);
}

#[test]
fn a_column_that_stands_still_throughout() {
    let mut found = 0;
    for (k, name) in ["ur5", "staubli-rx90", "puma560", "franka-panda"].into_iter().enumerate() {
        let mut made = make(name, &["xyzw"], 20 + k as u64, &NOMINAL);
        let joint = 1 + k % 3;
        let first = made.recording.columns[1 + joint].values[0];
        made.recording.columns[1 + joint].values.fill(first);
        let arm = arm(name);
        let held = hold(&arm, &made.recording, &made.roles, &HoldOptions::default()).expect("held");
        let is_it = |s: &Slip| matches!(s, Slip::Unlike(u) if u.joint == joint && u.is_still);
        found += usize::from(held.findings.iter().any(|f| is_it(&f.slip)));
    }
    assert_eq!(found, 4);
}

#[test]
fn a_stuck_run_tells_what_the_joint_did() {
    let made = make("ur5", &["stuck"], 31, &NOMINAL);
    let held = hold(&arm("ur5"), &made.recording, &made.roles, &HoldOptions::default()).expect("held");
    let stuck = held.findings.iter().find_map(|f| match &f.slip {
        Slip::Stuck(s) => Some(s.clone()),
        _ => None,
    });
    let stuck = stuck.expect("it is found");
    let [low, high] = stuck.meanwhile.expect("the pose shows it");
    // Where the column stands is one of the values at its beginning.
    let value = made.recording.columns[1 + stuck.joint].values[stuck.from];
    assert!(low - 0.01 < value && value < high + 0.01 && high - low > 0.02, "{low} {value} {high}");
}

#[test]
fn words_of_a_recording() {
    let made = make("ur5", &["flip", "tool-z"], 42, &NOMINAL);
    let ur5 = arm("ur5");
    let held = hold(&ur5, &made.recording, &made.roles, &HoldOptions::default()).expect("held");
    let columns = made.roles.joints.iter().map(|&c| made.recording.columns[c].name.as_str()).collect();
    let names = words::Names { arm: &ur5, columns, first_row: 2, row: "line" };
    let text = words::lines(&held, &names).join("\n");
    assert!(text.contains("the sign is reversed. The hand is off by"), "{text}");
    assert!(text.contains("a frame shifted by 17"), "{text}");
    assert!(text.contains("left over: "), "{text}");
    let clean = make("ur5", &[], 43, &NOMINAL);
    let held = hold(&ur5, &clean.recording, &clean.roles, &HoldOptions::default()).expect("held");
    let text = words::lines(&held, &names).join("\n");
    assert!(
        text.contains("nothing to remark: 0.1") && text.contains("the noise of the columns alone is"),
        "{text}"
    );
}

/// Single poses, as for a calibration: rows that have nothing to do with one another.
#[test]
fn poses_far_apart() {
    let long = Setting { rows: 9000, ..NOMINAL };
    for (k, (slips, count)) in
        [(vec![], 0), (vec!["flip"], 1), (vec!["mm", "tool-z"], 2)].into_iter().enumerate()
    {
        let mut made = make("staubli-rx90", &slips, 60 + k as u64, &long);
        for c in &mut made.recording.columns {
            c.values = (0..100).map(|r| c.values[(r * 2741) % 9000]).collect();
        }
        made.roles.time = None;
        let held =
            hold(&arm("staubli-rx90"), &made.recording, &made.roles, &HoldOptions::default()).expect("held");
        assert_eq!((held.findings.len(), held.noise), (count, None), "{slips:?}: {:?}", held.findings);
    }
}
