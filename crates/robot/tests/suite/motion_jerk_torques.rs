//! Timings within jerk and torque limits together: all limits hold at all times, and what does not bind costs nothing.

use crate::common::{Random, share};
use crate::dynamics::random_arm;
use denavit::description::read_toml;
use denavit::dynamics::{Dynamics, drive_torques, gravity_torques};
use denavit::motion::jerk_limited::SmoothTimedPath;
use denavit::motion::path::{Ends, PiecewisePath, QuinticEnds, cubic_spline, quintic_spline};
use denavit::motion::plan::{KnownLimits, PlanError, PlanOptions, Planned, TimingLaw, Wish};
use denavit::motion::profile::{Profile, double_s};
use denavit::motion::timing::Grid;
use denavit::motion::{
    JerkLimited, JointPath, Limits, MotionError, Range, TimeOptimal, TorqueLimits, Trajectory,
};

/// The greatest parts of velocities, accelerations, jerks and torques, at 20,001 instants.
fn shares(timed: &SmoothTimedPath<&PiecewisePath>, limits: &Limits, torques: &TorqueLimits) -> [f64; 4] {
    let mut most = [0.0_f64; 4];
    let most_of = |most: &mut f64, ranges: &[Range], values: &[f64]| {
        ranges.iter().zip(values).for_each(|(r, v)| *most = most.max(r.share(*v)));
    };
    for k in 0..=20_000 {
        let t = timed.duration() * f64::from(k) / 20_000.0;
        let state = timed.eval(t);
        most_of(&mut most[0], limits.velocity(), &state.qd);
        most_of(&mut most[1], limits.acceleration(), &state.qdd);
        for (jerk, limit) in timed.jerk(t).iter().zip(limits.jerk().unwrap()) {
            most[2] = most[2].max(jerk.abs() / limit);
        }
        let needed = drive_torques(torques.arm(), &state.q, &state.qd, &state.qdd, None);
        most_of(&mut most[3], torques.ranges(), &needed);
    }
    most
}

/// The torques at rest on a path, joint by joint, at most.
fn held(arm: &Dynamics<f64>, path: &PiecewisePath) -> Vec<f64> {
    let mut held = vec![0.0_f64; arm.joints()];
    for i in 0..=400 {
        let gravity = gravity_torques(arm, &path.eval(path.end() * f64::from(i) / 400.0).q);
        held.iter_mut().zip(gravity).for_each(|(h, g)| *h = h.max(g.abs()));
    }
    held.iter().zip(&arm.drives).map(|(h, d)| h + d.coulomb.abs()).collect()
}

#[test]
fn all_limits_hold_at_all_times() {
    let arms = ["articulated-3r", "scara", "staubli-rx90", "franka-panda", "stanford", "planar-2r"];
    let mut binding = [0; 4];
    for round in 0..share(60, 12) {
        let name = arms[round % arms.len()];
        let mut arm = Dynamics::numeric(&random_arm(name, 200 + round as u64)).unwrap();
        let has_friction = round % 3 != 0;
        if !has_friction {
            arm.drives.iter_mut().for_each(|d| (d.viscous, d.coulomb) = (0.0, 0.0));
        }
        let n = arm.joints();
        let mut random = Random(300 + round as u64);
        let mut list = |low: f64, high: f64, count: usize| -> Vec<f64> {
            (0..count).map(|_| low + (high - low) * random.unit()).collect()
        };
        let points: Vec<Vec<f64>> = (0..2 + round % 4).map(|_| list(-1.0, 1.0, n)).collect();
        let path = match round % 2 {
            0 => cubic_spline(&points, &Ends::Natural).unwrap(),
            _ => quintic_spline(&points, &QuinticEnds::Natural).unwrap(),
        };
        let torques: Vec<f64> =
            held(&arm, &path).iter().zip(list(1.2, 2.0, n)).map(|(h, f)| f * h + 1.0).collect();
        let torques = TorqueLimits::symmetric(arm, &torques).unwrap();
        let limits = Limits::symmetric(&list(1.0, 5.0, n), &list(5.0, 60.0, n)).unwrap();
        let limits = limits.with_jerk(&list(50.0, 2000.0, n)).unwrap();
        let timed = JerkLimited::default().time_within(&path, &limits, Some(&torques));
        let timed = timed.unwrap_or_else(|e| panic!("{name}, round {round}: {e}"));
        let most = shares(&timed, &limits, &torques);
        assert!(most.iter().all(|r| *r <= 1.0 + 2e-4), "{name}, round {round}: {most:?}");
        binding.iter_mut().zip(most).for_each(|(b, m)| *b += usize::from(m > 0.98));
        assert!(timed.slowed() < 1.05, "{name}, round {round}: {}", timed.slowed());
        // No shorter than within either, but for grids.
        let jerks = JerkLimited::default().time(&path, &limits).unwrap().duration();
        let alone = TimeOptimal::default().time_within(&path, &limits, Some(&torques)).unwrap().duration();
        let ratio = timed.duration() / jerks.max(alone);
        assert!(ratio > 0.99, "{name}, round {round}: {ratio}");
        if round % 2 == 0 {
            let ratio = timed.duration() / jerks.max(alone);
            assert!(ratio < 2.0, "{name}, round {round}: {ratio}");
        }
    }
    assert!(binding.iter().all(|b| *b > 0), "{binding:?}");
}

/// Viscous friction bounds speeds where it hinders and helps to brake: the timing within torques alone is the fastest for all that,
/// within its limits at 10,001 instants, and jerk limits make none shorter.
#[test]
fn jerk_limits_shorten_nothing_with_viscous_friction() {
    let arms = ["articulated-3r", "scara", "staubli-rx90", "franka-panda", "stanford", "planar-2r"];
    for round in 0..share(300, 18) {
        let name = arms[round % arms.len()];
        let mut random = Random(4000 + round as u64);
        let mut arm = Dynamics::numeric(&random_arm(name, 5000 + round as u64)).unwrap();
        let n = arm.joints();
        let mut list = |low: f64, high: f64, count: usize| -> Vec<f64> {
            (0..count).map(|_| low + (high - low) * random.unit()).collect()
        };
        let points: Vec<Vec<f64>> = (0..2 + round % 3).map(|_| list(-1.5, 1.5, n)).collect();
        let path = cubic_spline(&points, &Ends::Natural).unwrap();
        let left = list(0.3, 3.0, n);
        let (gravity, factors) = (held(&arm, &path), list(0.0, 2.0, n));
        // At up to two thirds of a joint's speed limit friction takes all that is left.
        for ((drive, left), factor) in arm.drives.iter_mut().zip(&left).zip(factors) {
            drive.viscous = 0.5 * left * factor.powi(3);
        }
        let torques: Vec<f64> = gravity.iter().zip(&left).map(|(g, l)| g + l).collect();
        let torques = TorqueLimits::symmetric(arm, &torques).unwrap();
        let limits = Limits::symmetric(&list(1.0, 6.0, n), &vec![1e4; n]).unwrap();
        let finer = TimeOptimal { grid: Grid::Graded(4000), ..TimeOptimal::default() };
        let alone = finer.time_within(&path, &limits, Some(&torques));
        let alone = alone.unwrap_or_else(|e| panic!("{name}, round {round}: {e}"));
        let mut most = 0.0_f64;
        for k in 1..10_000 {
            let state = alone.eval(alone.duration() * f64::from(k) / 10_000.0);
            let needed = drive_torques(torques.arm(), &state.q, &state.qd, &state.qdd, None);
            torques.ranges().iter().zip(needed).for_each(|(r, t)| most = most.max(r.share(t)));
        }
        assert!(most < 1.0 + 1e-3, "{name}, round {round}: {most}");
        let limits = limits.with_jerk(&list(100.0, 1e5, n)).unwrap();
        let timed = JerkLimited::default().time_within(&path, &limits, Some(&torques)).unwrap();
        let ratio = timed.duration() / alone.duration();
        assert!(ratio > 0.998, "{name}, round {round}: {ratio}");
    }
}

/// What does not bind costs nothing: strong drives leave the timing within jerks, great jerks that within torques.
#[test]
fn what_does_not_bind_costs_nothing() {
    for (k, name) in ["articulated-3r", "scara", "staubli-rx90"].into_iter().enumerate() {
        let mut arm = Dynamics::numeric(&random_arm(name, 80 + k as u64)).unwrap();
        arm.drives.iter_mut().for_each(|d| d.viscous = 0.0);
        let n = arm.joints();
        let mut random = Random(90 + k as u64);
        let points: Vec<Vec<f64>> =
            (0..4).map(|_| (0..n).map(|_| 2.0 * random.unit() - 1.0).collect()).collect();
        let path = cubic_spline(&points, &Ends::Natural).unwrap();
        let limit: Vec<f64> = held(&arm, &path).iter().map(|h| 1.5 * h + 2.0).collect();
        let times = |strength: f64, jerk: f64| {
            let torques: Vec<f64> = limit.iter().map(|t| strength * t).collect();
            let torques = TorqueLimits::symmetric(arm.clone(), &torques).unwrap();
            let limits = Limits::symmetric(&vec![3.0; n], &vec![100.0; n]).unwrap();
            let limits = limits.with_jerk(&vec![jerk; n]).unwrap();
            let options = JerkLimited { intervals: 600, gap: 1e-3 };
            [
                options.time_within(&path, &limits, Some(&torques)).unwrap().duration(),
                options.time(&path, &limits).unwrap().duration(),
                TimeOptimal::default().time_within(&path, &limits, Some(&torques)).unwrap().duration(),
            ]
        };
        let [both, jerks, _] = times(1e4, 100.0);
        assert!((both / jerks - 1.0).abs() < 5e-3, "{name}: {both} {jerks}");
        let [both, _, torques] = times(1.0, 1e6);
        assert!((0.99..1.03).contains(&(both / torques)), "{name}: {both} {torques}");
        let [both, jerks, torques] = times(1.0, 200.0);
        assert!(both > 0.995 * jerks.max(torques) && both < 1.5 * jerks.max(torques), "{name}: {both}");
    }
}

fn block(drive: &str, mass: f64) -> Dynamics<f64> {
    let text = format!(
        "name = 'b'\nconvention = 'craig'\ngravity = [0, '-9.81', 0]\n[[joints]]\nd = 'q1'\nmass = '{mass}'\n{drive}\n"
    );
    Dynamics::numeric(&read_toml(&text).unwrap().0).unwrap()
}

/// 3 kg on a level track, pushed with 6 N over one metre, are a double S of 2 m/s²: the force is the acceleration's limit.
#[test]
fn a_force_is_a_limit_of_the_acceleration() {
    let path = cubic_spline(&[vec![0.0], vec![1.0]], &Ends::Natural).unwrap();
    let time = |drive: &str, acceleration: f64, force: f64| {
        let limits = Limits::symmetric(&[100.0], &[acceleration]).unwrap().with_jerk(&[10.0]).unwrap();
        let torques = TorqueLimits::symmetric(block(drive, 3.0), &[force]).unwrap();
        JerkLimited::default().time_within(&path, &limits, Some(&torques)).unwrap().duration()
    };
    let best = double_s([0.0, 1.0], [0.0; 2], 100.0, 2.0, 10.0).unwrap().duration();
    for duration in [time("", 100.0, 6.0), time("", 2.0, 600.0), time("rotor = 1", 100.0, 8.0)] {
        assert!((1.0..1.003).contains(&(duration / best)), "{duration} {best}");
    }
    // Friction against the motion, with it while braking: 5/3 and 7/3 m/s². The ramps of the jerk cost the time in which it
    // turns one into the other.
    let coulomb = time("coulomb = 1", 100.0, 6.0);
    assert!(coulomb > best && coulomb < 1.05 * best, "{coulomb} {best}");
    let viscous = time("viscous = 2", 100.0, 6.0);
    assert!(viscous > best && viscous < 1.3 * best, "{viscous} {best}");
}

/// A weak drive whose friction grows with the speed, down a slope: at full speed the friction holds it back, slower less so.
#[test]
fn a_duration_that_friction_does_not_allow_is_refused() {
    let d = read_toml(
        "name = 'b'\nconvention = 'craig'\ngravity = [0, 0, '-9.81']\n[[joints]]\nd = 'q1'\nmass = 1\nviscous = 20\n",
    );
    let d = d.unwrap().0;
    let robot = denavit::Robot::numeric(&d).unwrap();
    let known = |jerk: Option<f64>, torque: f64| KnownLimits {
        velocity: Some(vec![10.0]),
        jerk: jerk.map(|j| vec![j]),
        torque: Some(TorqueLimits::symmetric(Dynamics::numeric(&d).unwrap(), &[torque]).unwrap()),
        ..KnownLimits::default()
    };
    let plan = |known: &KnownLimits, duration: Option<f64>| {
        let options = PlanOptions { duration, ..PlanOptions::default() };
        Planned::new(&d, &robot, Wish::Joints(vec![vec![2.0], vec![0.0]]), known, &options)
    };
    for jerk in [None, Some(500.0)] {
        let found = plan(&known(jerk, 12.0), None).unwrap();
        let held = found.timing.held.unwrap();
        assert!(held.torque.is_some_and(|t| t > 0.9 && t < 1.002), "{held:?}");
        assert_eq!(held.jerk.is_some(), jerk.is_some());
        assert_eq!(held.acceleration, None);
        let twice = plan(&known(jerk, 12.0), Some(2.0 * found.trajectory.duration())).unwrap();
        assert!(twice.timing.held.unwrap().velocity < 0.51 * held.velocity + 1e-3);
        assert!(matches!(
            plan(&known(jerk, 9.0), None).map(|_| ()),
            Err(PlanError::Motion(MotionError::Torque { joint: 0, .. }))
        ));
    }
    let law = plan(&known(Some(500.0), 12.0), None).unwrap().timing.by;
    assert_eq!(law, TimingLaw::WithinJerksAndTorques { accelerations: false });
}

/// Two links without weight: the second one turns against the first, whose drive is weak and has much friction. While the arm gathers
/// speed the second link helps it; more slowly it helps less, by the square, and the friction falls by the speed alone.
#[test]
fn slower_is_not_always_easier() {
    let text = "name = 'b'\nconvention = 'craig'\ngravity = [0, 0, '-9.81']\n[[joints]]\ntheta = 'q1'\nmass = '0.1'\ncom = ['0.1', 0, 0]\nviscous = 0.5\n[[joints]]\ntheta = 'q2'\na = '0.2'\nmass = 4\ncom = ['0.3', 0, 0]\n";
    let d = read_toml(text).unwrap().0;
    let robot = denavit::Robot::numeric(&d).unwrap();
    let plan = |duration: Option<f64>| {
        let known = KnownLimits {
            velocity: Some(vec![100.0; 2]),
            jerk: Some(vec![1e5; 2]),
            torque: Some(TorqueLimits::symmetric(Dynamics::numeric(&d).unwrap(), &[0.01, 50.0]).unwrap()),
            ..KnownLimits::default()
        };
        let options = PlanOptions { duration, ..PlanOptions::default() };
        let points = vec![vec![0.0, 2.0], vec![0.2, 1.5], vec![0.2, 0.0], vec![0.2, -1.0]];
        Planned::new(&d, &robot, Wish::Joints(points), &known, &options)
    };
    let fastest = plan(None).unwrap();
    let torque = |planned: &Planned| planned.timing.held.and_then(|h| h.torque).unwrap();
    assert!((0.99..1.0001).contains(&torque(&fastest)), "{}", torque(&fastest));
    let own = fastest.trajectory.duration();
    match plan(Some(2.0 * own)).map(|_| ()) {
        Err(PlanError::SlowTorque { joint, t, share }) => {
            assert!(joint == "q1" && t > 0.0 && t < 2.0 * own && share > 1.5, "{joint} {t} {share}");
        }
        other => panic!("{other:?}"),
    }
    // Slow enough, it is.
    assert!(torque(&plan(Some(10.0 * own)).unwrap()) < 1.0);
}
