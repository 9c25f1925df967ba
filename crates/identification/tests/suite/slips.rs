//! What is wrong with a recording is named, and not fitted.

use crate::made::{Setting, Truth, USUAL, recording, truth};
use denavit::geometry::Vector;
use denavit_identification::{Asked, Columns, Cutoff, NoMotion, Remark, Sought, Suspect, identify};

fn found(truth: &Truth, columns: &Columns) -> Vec<Suspect> {
    identify(&truth.model, columns, &Asked::default()).expect("motion").suspects
}

/// Differences of positions at 200 rows a second.
fn rates(x: &[f64]) -> Vec<f64> {
    let n = x.len();
    (0..n).map(|r| (x[(r + 1).min(n - 1)] - x[r.saturating_sub(1)]) * 100.0).collect()
}

#[test]
fn a_torque_with_the_other_sign() {
    for (name, seed) in [("ur5", 1), ("staubli-rx90", 2), ("franka-panda", 3)] {
        let truth = truth(name, seed, Sought::default());
        for j in [0, 1, 2] {
            let mut columns = recording(&truth, &USUAL);
            columns.tau[j].iter_mut().for_each(|x| *x = -*x);
            let suspects = found(&truth, &columns);
            let is_it = |s: &Suspect| matches!(s, Suspect::Sign(k, _) | Suspect::Inertia(k, ..) if *k == j);
            assert!(suspects.iter().any(is_it), "{name}: joint {}: {suspects:?}", j + 1);
            let other = |s: &Suspect| matches!(s, Suspect::Sign(k, _) if *k != j);
            assert!(!suspects.iter().any(other), "{name}: joint {}: {suspects:?}", j + 1);
        }
    }
}

#[test]
fn all_torques_with_the_other_sign() {
    for name in ["ur5", "stanford"] {
        let truth = truth(name, 4, Sought::default());
        let mut columns = recording(&truth, &USUAL);
        columns.tau.iter_mut().flatten().for_each(|x| *x = -*x);
        let suspects = found(&truth, &columns);
        assert!(suspects.contains(&Suspect::AllSigns), "{name}: {suspects:?}");
        // Frictions are below 0, too.
        assert!(suspects.iter().any(|s| matches!(s, Suspect::Friction(..))), "{suspects:?}");
    }
}

#[test]
fn one_torque_in_millimetres() {
    let truth = truth("ur5", 5, Sought::default());
    let mut columns = recording(&truth, &USUAL);
    columns.tau[1].iter_mut().for_each(|x| *x *= 1000.0);
    let suspects = found(&truth, &columns);
    let is_it = |s: &Suspect| matches!(s, Suspect::Factor(1, f, _) if *f == 1e-3);
    assert!(suspects.iter().any(is_it), "{suspects:?}");
}

#[test]
fn all_torques_in_millimetres() {
    let truth = truth("franka-panda", 15, Sought::default());
    let mut columns = recording(&truth, &USUAL);
    columns.tau.iter_mut().flatten().for_each(|x| *x *= 1000.0);
    let suspects = found(&truth, &columns);
    assert!(matches!(suspects[..], [Suspect::Mass(kg)] if kg > 1e4), "{suspects:?}");
}

#[test]
fn a_base_on_a_wall() {
    let mut truth = truth("ur5", 6, Sought::default());
    truth.dynamics.gravity = Vector([9.81, 0.0, 0.0]);
    let suspects = found(&truth, &recording(&truth, &USUAL));
    let is_it = |s: &Suspect| matches!(s, Suspect::Gravity(g, _) if *g == [9.81, 0.0, 0.0]);
    assert!(suspects.iter().any(is_it), "{suspects:?}");
}

#[test]
fn positions_in_degrees() {
    let truth = truth("staubli-rx90", 7, Sought::default());
    let in_degrees = recording(&truth, &USUAL);
    let mut columns = in_degrees.clone();
    columns.q.iter_mut().flatten().for_each(|x| *x = x.to_degrees());
    let asked = Asked { in_degrees: Some(&in_degrees), ..Asked::default() };
    let of = identify(&truth.model, &columns, &asked).expect("motion");
    assert!(
        of.remarks.iter().any(|r| matches!(r, Remark::Degrees(Some(by)) if *by > 3.0)),
        "{:?}",
        of.remarks
    );
    assert!(of.estimate.joints.iter().all(|j| j.left < 0.1 * j.torque));
    // Where they are no motion in radians, it is said as well.
    columns.qd = Some(in_degrees.q.iter().map(|q| rates(q)).collect());
    let in_degrees = Columns { qd: columns.qd.clone(), ..in_degrees };
    let asked = Asked { in_degrees: Some(&in_degrees), ..Asked::default() };
    let of = identify(&truth.model, &columns, &asked).expect("motion");
    assert!(of.remarks.contains(&Remark::Degrees(None)), "{:?}", of.remarks);
}

#[test]
fn velocities_in_degrees() {
    let truth = truth("scara", 8, Sought::default());
    let mut columns = recording(&truth, &Setting { positions: 0.0, ..USUAL });
    columns.qd = Some(columns.q.iter().map(|q| rates(q)).collect());
    if let Some(qd) = &mut columns.qd {
        qd[1].iter_mut().for_each(|x| *x = x.to_degrees());
    }
    let why = identify(&truth.model, &columns, &Asked::default()).expect_err("not the same");
    assert!(matches!(why, NoMotion::Rates(1, k) if (k - 57.3).abs() < 1.0), "{why:?}");
}

/// What cannot be identified from is refused, and nothing panics.
#[test]
fn columns_that_are_no_motion() {
    let truth = truth("scara", 9, Sought::default());
    let ask = |columns: &Columns| identify(&truth.model, columns, &Asked::default());
    let columns = recording(&truth, &USUAL);
    let rows = columns.time.len();
    let short = |n: usize| {
        let cut = |all: &Vec<Vec<f64>>| all.iter().map(|c| c[..n].to_vec()).collect();
        Columns {
            time: columns.time[..n].to_vec(),
            q: cut(&columns.q),
            tau: cut(&columns.tau),
            ..Columns::default()
        }
    };
    for slow in [1e-17, f64::MIN_POSITIVE] {
        let asked = Asked { cutoff: Cutoff::At(slow), ..Asked::default() };
        assert!(matches!(identify(&truth.model, &columns, &asked), Err(NoMotion::Short { .. })));
    }
    assert!(matches!(ask(&short(0)), Err(NoMotion::Rows { .. })));
    assert!(matches!(ask(&short(20)), Err(NoMotion::Rows { .. })));
    let _ = ask(&short(60));
    let stopped = Columns { time: vec![1.0; rows], ..columns.clone() };
    assert!(matches!(ask(&stopped), Err(NoMotion::Time)));
    let mut missing = columns.clone();
    missing.tau[2].fill(f64::NAN);
    assert!(matches!(ask(&missing), Err(NoMotion::Rows { whole: 0, .. })));
    for fill in [0.0, 1e300, f64::INFINITY, -1e-300] {
        let mut odd = columns.clone();
        odd.tau.iter_mut().for_each(|c| c.fill(fill));
        let _ = ask(&odd);
        let mut odd = columns.clone();
        odd.q.iter_mut().for_each(|c| c.fill(fill));
        let _ = ask(&odd);
    }
    let mut gaps = columns;
    gaps.time.iter_mut().skip(rows / 2).for_each(|t| *t += 5.0);
    gaps.q[0][10] = f64::NAN;
    let of = ask(&gaps).expect("two stretches");
    assert!(of.remarks.contains(&Remark::Gaps(2)), "{:?}", of.remarks);
    assert!(of.remarks.contains(&Remark::Missing(1)));
}
