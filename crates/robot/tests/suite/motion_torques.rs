//! Timings within torque limits: as fast as can be computed by hand, within the limits at all times, at one of them nearly always.

use crate::common::{Random, share};
use crate::dynamics::random_arm;
use denavit::description::read_toml;
use denavit::dynamics::{Dynamics, drive_torques, gravity_torques};
use denavit::motion::path::{Ends, cubic_spline};
use denavit::motion::plan::{KnownLimits, PlanError, PlanOptions, Planned, TimingLaw, Wish};
use denavit::motion::profile::Law;
use denavit::motion::timing::Grid;
use denavit::motion::{JointPath, Limits, MotionError, TimeOptimal, TorqueLimits, Trajectory};

/// 3 kg on a level track, pushed with 6 N at most, over one metre.
fn duration(drive: &str) -> f64 {
    let text = format!(
        "name = 'b'\nconvention = 'craig'\ngravity = [0, '-9.81', 0]\n[[joints]]\nd = 'q1'\nmass = 3\n{drive}\n"
    );
    let arm = Dynamics::numeric(&read_toml(&text).unwrap().0).unwrap();
    let limits = Limits::symmetric(&[100.0], &[1e4]).unwrap();
    let torques = TorqueLimits::symmetric(arm, &[6.0]).unwrap();
    let path = cubic_spline(&[vec![0.0], vec![1.0]], &Ends::Natural).unwrap();
    let finer = TimeOptimal { grid: Grid::Graded(4000), ..TimeOptimal::default() };
    finer.time_within(path, &limits, Some(&torques)).unwrap().duration()
}

#[test]
fn a_block_is_pushed_as_hard_as_can_be() {
    // v²/2 (1/a + 1/b) = 1, and t = v (1/a + 1/b).
    let by = |a: f64, b: f64| (2.0 * (1.0 / a + 1.0 / b)).sqrt();
    assert!((duration("") - by(2.0, 2.0)).abs() < 1e-6, "{}", duration(""));
    let coulomb = duration("coulomb = 1");
    assert!((coulomb - by(5.0 / 3.0, 7.0 / 3.0)).abs() < 1e-6, "{coulomb}");
    let rotor = duration("rotor = 1");
    assert!((rotor - by(1.5, 1.5)).abs() < 1e-6, "{rotor}");
    // With 2 N s/m v' = 2 − 2v/3, then v' = −2 − 2v/3: from rest v = 3 (1 − e^(−2t/3)), and v = 3 (e^(2t/3) − 1) to rest in the time t.
    let speed_up = |t: f64| 3.0 * t - 4.5 * (1.0 - (-t / 1.5).exp());
    let slow_down = |t: f64| 4.5 * ((t / 1.5).exp() - 1.0) - 3.0 * t;
    let braking = |t: f64| 1.5 * (2.0 - (-t / 1.5).exp()).ln();
    let (mut low, mut high) = (0.0, 3.0);
    while high - low > 1e-9 {
        let t = f64::midpoint(low, high);
        if speed_up(t) + slow_down(braking(t)) < 1.0 { low = t } else { high = t }
    }
    let viscous = duration("viscous = 2");
    assert!((viscous / (low + braking(low)) - 1.0).abs() < 1e-4, "{viscous} {}", low + braking(low));
}

#[test]
fn torques_stay_within_their_limits_and_reach_them() {
    for (k, name) in ["articulated-3r", "scara", "staubli-rx90", "franka-panda"].into_iter().enumerate() {
        let arm = Dynamics::numeric(&random_arm(name, 60 + k as u64)).unwrap();
        let n = arm.joints();
        let mut random = Random(k as u64);
        let points: Vec<Vec<f64>> =
            (0..4).map(|_| (0..n).map(|_| 2.0 * random.unit() - 1.0).collect()).collect();
        let path = cubic_spline(&points, &Ends::Natural).unwrap();
        let mut held = vec![0.0_f64; n];
        for i in 0..=200 {
            let q = path.eval(path.end() * f64::from(i) / 200.0).q;
            let gravity = gravity_torques(&arm, &q);
            held.iter_mut().zip(gravity).for_each(|(h, g)| *h = h.max(g.abs()));
        }
        let limit: Vec<f64> =
            held.iter().zip(&arm.drives).map(|(h, d)| 1.5 * (h + d.coulomb.abs()) + 2.0).collect();
        let limits = Limits::symmetric(&vec![20.0; n], &vec![1e4; n]).unwrap();
        let time = |factor: f64| {
            let torques: Vec<f64> = limit.iter().map(|t| factor * t).collect();
            let torques = TorqueLimits::symmetric(arm.clone(), &torques).unwrap();
            TimeOptimal::default().time_within(path.clone(), &limits, Some(&torques))
        };
        let timed = time(1.0).unwrap_or_else(|e| panic!("{name}: {e}"));
        let (mut most, mut busy) = (0.0_f64, 0);
        // At rest Coulomb's friction is no number: it is left away there.
        for i in 1..2000 {
            let s = timed.eval(timed.duration() * f64::from(i) / 2000.0);
            let torques = drive_torques(&arm, &s.q, &s.qd, &s.qdd, None);
            let share = torques.iter().zip(&limit).fold(0.0_f64, |m, (t, l)| m.max(t.abs() / l));
            let speed = s.qd.iter().fold(0.0_f64, |m, v| m.max(v.abs() / 20.0));
            most = most.max(share);
            busy += usize::from(share.max(speed) > 0.9);
        }
        assert!(most < 1.0 + 1e-3, "{name}: {most}");
        assert!(busy > 1900, "{name}: {busy} of 2001");
        let slack = time(4.0).unwrap();
        assert!(slack.duration() < timed.duration(), "{name}");
        if held.iter().any(|&h| h > 1.0) {
            assert!(matches!(time(1e-3), Err(MotionError::Torque { .. })), "{name}");
        }
    }
}

/// A pendulum that can be held at all grid points of its way and not between them.
#[test]
fn an_arm_that_cannot_carry_itself_between_grid_points_is_refused() {
    let text = "name = 'p'\nconvention = 'craig'\ngravity = [0, '-10', 0]\n[[joints]]\ntheta = 'q1'\nmass = 1\ncom = ['1', 0, 0]\n";
    let arm = Dynamics::numeric(&read_toml(text).unwrap().0).unwrap();
    let limits = Limits::symmetric(&[100.0], &[1e4]).unwrap();
    let quarter = std::f64::consts::FRAC_PI_2;
    let path = cubic_spline(&[vec![-quarter], vec![3.0 * quarter]], &Ends::Natural).unwrap();
    let points = vec![0.0, path.end() / 2.0, path.end()];
    let ends = TimeOptimal { grid: Grid::Points(points), ..TimeOptimal::default() };
    // 10 cos q is 0 at all three, and 7.5 at 0.27 of the way between them.
    let time = |torque: f64| {
        let torques = TorqueLimits::symmetric(arm.clone(), &[torque]).unwrap();
        ends.time_within(path.clone(), &limits, Some(&torques)).map(|timed| timed.duration())
    };
    assert!(time(12.0).is_ok_and(|t| t > 0.0), "{:?}", time(12.0));
    assert!(matches!(time(7.0), Err(MotionError::Torque { joint: 0, s }) if s > 0.0), "{:?}", time(7.0));
}

/// What is called time-optimal: with viscous friction, with which speeds are searched for, nothing is. Nothing but torques bounds accelerations:
/// a light block takes as short as its mass says.
#[test]
fn timings_within_torques_say_what_they_are() {
    let law = |drive: &str, mass: f64, acceleration: Option<Vec<f64>>| {
        let text = format!(
            "name = 'b'\nconvention = 'craig'\ngravity = [0, '-9.81', 0]\n[[joints]]\nd = 'q1'\nmass = '{mass}'\n{drive}\n"
        );
        let d = read_toml(&text).unwrap().0;
        let arm = Dynamics::numeric(&d).unwrap();
        let known = KnownLimits {
            velocity: Some(vec![1e6]),
            acceleration,
            torque: Some(TorqueLimits::symmetric(arm, &[6.0]).unwrap()),
            ..KnownLimits::default()
        };
        let robot = denavit::Robot::numeric(&d).unwrap();
        let wish = Wish::Joints(vec![vec![0.0], vec![1.0]]);
        let planned = Planned::new(&d, &robot, wish, &known, &PlanOptions::default()).unwrap();
        (planned.timing.by, planned.trajectory.duration())
    };
    let within = |accelerations, fastest| TimingLaw::WithinTorques { accelerations, fastest };
    assert_eq!(law("", 3.0, None).0, within(false, true));
    assert_eq!(law("", 3.0, Some(vec![1.0])).0, within(true, true));
    assert_eq!(law("viscous = 1", 3.0, Some(vec![1.0])).0, within(true, false));
    // 6 N on 6 mg: 10⁶ m/s², and 2 ms over a metre.
    let light = law("", 6e-6, None).1;
    assert!((light - 2e-3).abs() < 1e-6, "{light}");
}

#[test]
fn torque_limits_are_planned_with() {
    let d = random_arm("articulated-3r", 5);
    let arm = Dynamics::numeric(&d).unwrap();
    let robot = denavit::Robot::numeric(&d).unwrap();
    let known = |velocity: Option<Vec<f64>>, jerk: Option<Vec<f64>>| KnownLimits {
        velocity,
        jerk,
        torque: Some(TorqueLimits::symmetric(arm.clone(), &[1e3; 3]).unwrap()),
        ..KnownLimits::default()
    };
    let plan = |known: &KnownLimits| {
        let wish = Wish::Joints(vec![vec![0.0; 3], vec![0.4, -0.3, 0.2]]);
        Planned::new(&d, &robot, wish, known, &PlanOptions::default()).map(|p| p.trajectory.duration())
    };
    assert!(plan(&known(Some(vec![5.0; 3]), None)).is_ok_and(|t| t > 0.0 && t < 1.0));
    assert_eq!(plan(&known(None, None)), Err(PlanError::NeededForTorque));
    assert_eq!(plan(&known(None, Some(vec![5.0; 3]))), Err(PlanError::NeededForTorque));
    assert!(plan(&known(Some(vec![5.0; 3]), Some(vec![50.0; 3]))).is_ok_and(|t| t > 0.6));
    let law = PlanOptions { law: Some(Law::Cubic), ..PlanOptions::default() };
    let wish = Wish::Joints(vec![vec![0.0; 3], vec![0.4, -0.3, 0.2]]);
    let refused = Planned::new(&d, &robot, wish, &known(Some(vec![5.0; 3]), None), &law);
    assert_eq!(refused.map(|_| ()), Err(PlanError::LawWithTorque));
    let short = TorqueLimits::symmetric(arm.clone(), &[1.0; 2]);
    assert!(matches!(short, Err(MotionError::Joints { expected: 3, found: 2, .. })));
    assert!(matches!(
        TorqueLimits::symmetric(arm.clone(), &[1.0, 0.0, 1.0]),
        Err(MotionError::NotPositive(..))
    ));
}

/// A planned motion is slowed down in the end by what was exceeded between the points of its grid: no torque, velocity or acceleration is
/// beyond its limit at any of 100,001 instants, and the fastest torque is at it.
#[test]
fn planned_motions_are_within_their_limits() {
    let arms = ["planar-2r", "scara", "articulated-3r", "staubli-rx90"];
    for round in 0..share(80, 12) {
        let name = arms[round % arms.len()];
        let mut d = random_arm(name, 700 + round as u64);
        if round % 2 == 0 {
            d.rows.iter_mut().for_each(|r| (r.viscous, r.coulomb) = (None, None));
        }
        let arm = Dynamics::numeric(&d).unwrap();
        let n = arm.joints();
        let mut random = Random(800 + round as u64);
        let mut list = |low: f64, high: f64| -> Vec<f64> {
            (0..n).map(|_| low + (high - low) * random.unit()).collect()
        };
        let points = vec![list(-1.5, 1.5), list(-1.5, 1.5), list(-1.5, 1.5)];
        // What carries the arm anywhere, and something more.
        let mut torques = list(0.5, 4.0);
        for k in 0..400 {
            let q: Vec<f64> = (0..n).map(|j| 3.0 * (f64::from(k) * 0.618 * (j + 1) as f64).sin()).collect();
            for ((t, g), drive) in torques.iter_mut().zip(gravity_torques(&arm, &q)).zip(&arm.drives) {
                *t = t.max(1.3 * (g.abs() + drive.coulomb));
            }
        }
        let limits = TorqueLimits::symmetric(arm, &torques).unwrap();
        let known = KnownLimits {
            velocity: Some(list(3.0, 30.0)),
            torque: Some(limits.clone()),
            ..KnownLimits::default()
        };
        let robot = denavit::Robot::numeric(&d).unwrap();
        let planned = Planned::new(&d, &robot, Wish::Joints(points), &known, &PlanOptions::default());
        let planned = planned.unwrap_or_else(|e| panic!("{name}, round {round}: {e}"));
        let motion = &planned.trajectory;
        let (mut torque, mut velocity, mut worst) = (0.0_f64, 0.0_f64, String::new());
        for k in 0..=100_000 {
            let state = motion.eval(motion.duration() * f64::from(k) / 1e5);
            let needed = drive_torques(limits.arm(), &state.q, &state.qd, &state.qdd, None);
            for (j, (range, mut needed)) in limits.ranges().iter().zip(needed).enumerate() {
                // Of a joint that turns round just there, or begins or ends to move, Coulomb's friction is either.
                let coulomb = limits.arm().drives[j].coulomb;
                if state.qd[j].abs() < 1e-4 {
                    let is_counted = state.qd[j] != 0.0;
                    let without = needed - f64::from(u8::from(is_counted)) * coulomb * state.qd[j].signum();
                    needed = without.signum() * (without.abs() - coulomb).max(0.0);
                }
                let share = range.share(needed);
                if share > torque {
                    (torque, worst) = (share, format!("joint {j}, {state:?}"));
                }
            }
            let rates = state.qd.iter().zip(known.velocity.as_ref().unwrap());
            velocity = rates.fold(velocity, |m, (v, l)| m.max(v.abs() / l));
        }
        let held = planned.timing.held.unwrap();
        let what = format!("{name}, round {round}: {torque} {velocity} {held:?} {worst}");
        assert!(torque < 1.0 + 1e-5 && velocity < 1.0 + 1e-5, "{what}");
        // With viscous friction speeds are searched for.
        let least = if limits.arm().drives.iter().any(|d| d.viscous != 0.0) { 0.9 } else { 0.99 };
        assert!(torque > least || velocity > least, "{what}");
        assert!(held.instants > 10_000 && held.torque.is_some_and(|t| t <= 1.0 + 1e-8), "{held:?}");
    }
}
