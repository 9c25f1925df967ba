//! Motion over time: known periods, friction, energy.

use crate::common::Random;
use crate::dynamics::{random_arm, state};
use denavit::description::{JointKind, read_toml};
use denavit::dynamics::{
    Acting, Drive, Dynamics, Link, Method, NoMotion, Simulation, Torques, inertia_matrix, inverse_dynamics,
    momentum, simulate,
};
use denavit::geometry::{Axis, Body, Rotation, Transform, Vector};
use denavit::mechanism::Affine;
use std::f64::consts::PI;

const FINE: Method = Method::Adaptive { tolerance: 1e-10 };

fn arm(text: &str) -> Dynamics<f64> {
    Dynamics::numeric(&read_toml(text).expect("a robot file").0).expect("masses")
}

/// A point mass of 2 kg at 0.7 m, hanging at q = −90°.
fn pendulum() -> Dynamics<f64> {
    arm("name = 'p'\nconvention = 'craig'\ngravity = [0, '-9.81', 0]\n\
         [[joints]]\ntheta = 'q1'\nmass = 2\ncom = ['0.7', 0, 0]\n")
}

/// 3 kg on a level track.
fn block(drive: &str) -> Dynamics<f64> {
    arm(&format!(
        "name = 'b'\nconvention = 'craig'\ngravity = [0, '-9.81', 0]\n[[joints]]\nd = 'q1'\nmass = 3\n{drive}\n"
    ))
}

fn free(n: usize) -> Acting {
    Acting { torques: Torques::constant(vec![0.0; n]), wrench: None }
}

fn motion(
    arm: &Dynamics<f64>,
    from: (&[f64], &[f64]),
    acting: &Acting,
    times: (f64, f64),
    how: Method,
) -> Simulation {
    simulate(arm, from, acting, times, how).unwrap_or_else(|(why, _)| panic!("{why}"))
}

/// The period of a pendulum that swings as far as `far` is 2π√(l/g)/agm(1, cos(far/2)).
#[test]
fn a_pendulum_swings_in_its_period() {
    let (l, g) = (0.7_f64, 9.81);
    for far in [0.2_f64, 1.0, 2.5] {
        let (mut a, mut b) = (1.0, (far / 2.0).cos());
        for _ in 0..20 {
            (a, b) = (0.5 * (a + b), f64::sqrt(a * b));
        }
        let period = 2.0 * PI * (l / g).sqrt() / a;
        let start = -PI / 2.0 + far;
        for (how, within) in [(FINE, 1e-7), (Method::Symplectic { step: 2e-3 }, 1e-6)] {
            let found = motion(&pendulum(), (&[start], &[0.0]), &free(1), (period, period / 2.0), how);
            let [_, half, whole] = &found.moments[..] else { panic!("{:?}", found.moments) };
            assert!((half.q[0] - (-PI / 2.0 - far)).abs() < within, "{far} {how:?}: {}", half.q[0]);
            assert!(
                (whole.q[0] - start).abs() < within && whole.qd[0].abs() < 10.0 * within,
                "{far} {how:?}"
            );
        }
    }
}

/// Without friction the energy of an arm that falls stays: with half the step the symplectic error is a sixteenth, and the other
/// one follows its tolerance.
#[test]
fn energy_stays_to_the_order_of_the_integrator() {
    for (name, seed) in [("planar-2r", 5), ("articulated-3r", 6), ("scara", 7)] {
        let mut arm = Dynamics::numeric(&random_arm(name, seed)).unwrap();
        arm.drives.iter_mut().for_each(|d| (d.viscous, d.coulomb) = (0.0, 0.0));
        let [q, qd, _] = state(arm.joints(), &mut Random(seed));
        let drift = |how, dt| motion(&arm, (&q, &qd), &free(arm.joints()), (0.5, dt), how).drift();
        let [(coarse, size), (fine, _)] = [0.01, 0.005].map(|step| drift(Method::Symplectic { step }, 0.01));
        assert!(size > 0.1 && coarse > 1e-11 * size, "{name}: {coarse:e} of {size}");
        assert!((10.0..25.0).contains(&(coarse / fine)), "{name}: {coarse:e} {fine:e}");
        let [(coarse, _), (fine, _)] =
            [1e-5, 1e-9].map(|tolerance| drift(Method::Adaptive { tolerance }, 0.25));
        assert!(fine < 1e-7 * size && fine < 1e-2 * coarse, "{name}: {coarse:e} {fine:e}");
    }
}

/// With friction, torques that change and a wrench the energy is balanced all the same, by either integrator, and they agree.
#[test]
fn what_comes_in_and_goes_out_is_balanced() {
    let mut arm = Dynamics::numeric(&random_arm("articulated-3r", 11)).unwrap();
    arm.drives.iter_mut().for_each(|d| d.coulomb = 0.0);
    assert!(arm.drives.iter().all(|d| d.viscous > 0.0), "the test is about friction");
    let [q, qd, _] = state(3, &mut Random(3));
    let rows = vec![vec![1.0, -2.0, 0.5], vec![-3.0, 4.0, 0.0], vec![2.0, 0.0, 1.0]];
    let torques = Torques::over(vec![0.0, 0.21, 0.4], rows).unwrap();
    let wrench = Some([[4.0, -3.0, 5.0], [0.3, 0.2, -0.1]].map(Vector));
    let acting = Acting { torques, wrench };
    let [one, other] = [FINE, Method::Symplectic { step: 1e-3 }]
        .map(|how| motion(&arm, (&q, &qd), &acting, (0.5, 0.05), how));
    for found in [&one, &other] {
        let (drift, size) = found.drift();
        let last = found.moments.last().unwrap();
        assert!(drift < 1e-7 * size, "{drift:e} of {size}");
        assert!(last.dissipated > 0.0 && last.supplied != 0.0 && last.exerted != 0.0);
    }
    for (a, b) in one.moments.iter().zip(&other.moments) {
        assert!(a.q.iter().zip(&b.q).all(|(a, b)| (a - b).abs() < 1e-6), "{} s: {:?} {:?}", a.t, a.q, b.q);
    }
}

/// v = v₀ e^(−ct/m), and what is lost is heat.
#[test]
fn viscous_friction_slows_down() {
    let found = motion(&block("viscous = 2"), (&[0.0], &[4.0]), &free(1), (1.5, 0.1), FINE);
    let last = found.moments.last().unwrap();
    let left = (-2.0 * 1.5 / 3.0_f64).exp();
    assert!((last.qd[0] - 4.0 * left).abs() < 1e-8, "{}", last.qd[0]);
    assert!((last.dissipated - 24.0 * (1.0 - left * left)).abs() < 1e-7, "{}", last.dissipated);
}

/// A block with Coulomb's friction stops after m v₀/F at m v₀²/2F and stays; a torque less than F does not move it, one that grows
/// does from where it is F.
#[test]
fn coulombs_friction_stops_and_holds() {
    let block = block("coulomb = 5");
    let found = motion(&block, (&[0.0], &[4.0]), &free(1), (4.0, 0.1), FINE);
    for m in &found.moments {
        let t = m.t.min(12.0 / 5.0);
        assert!((m.q[0] - (4.0 * t - 5.0 / 6.0 * t * t)).abs() < 1e-8, "{}: {}", m.t, m.q[0]);
    }
    let last = found.moments.last().unwrap();
    assert!(last.qd[0] == 0.0 && (last.dissipated - 24.0).abs() < 1e-7 && found.switched == 1, "{last:?}");
    let held = |torque: f64| {
        let acting = Acting { torques: Torques::constant(vec![torque]), wrench: None };
        motion(&block, (&[0.3], &[0.0]), &acting, (2.0, 0.5), FINE).moments.pop().unwrap()
    };
    assert_eq!((held(4.99).q[0], held(-4.99).q[0]), (0.3, 0.3));
    assert!((held(-8.0).q[0] - (0.3 - 2.0)).abs() < 1e-8, "{}", held(-8.0).q[0]);
    // It grows by 2.5 N a second: from 2 s on the force is 2.5 (t − 2), and the way 2.5 (t − 2)³/18.
    let torques = Torques::over(vec![0.0, 4.0], vec![vec![0.0], vec![10.0]]).unwrap();
    let found = motion(&block, (&[0.0], &[0.0]), &Acting { torques, wrench: None }, (4.0, 1.0), FINE);
    let at: Vec<f64> = found.moments.iter().map(|m| m.q[0]).collect();
    let wanted = [0.0, 0.0, 0.0, 2.5 / 18.0, 2.5 * 8.0 / 18.0];
    assert!(at.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-7), "{at:?}");
}

/// A block that comes to rest and is pulled away again within what would be one step: v = 3.3 − 3t + 2t²/3 until it is 0, then it
/// sticks until 4t − 4 is 5.
#[test]
fn a_joint_that_sticks_within_a_step_is_seen() {
    let torques = Torques::over(vec![0.0, 5.0], vec![vec![-4.0], vec![16.0]]).unwrap();
    let acting = Acting { torques, wrench: None };
    let found = motion(&block("coulomb = 5"), (&[0.0], &[3.3]), &acting, (5.0, 5.0), FINE);
    let t = (3.0 - (9.0_f64 - 8.0 / 3.0 * 3.3).sqrt()) / (4.0 / 3.0);
    let stopped = 3.3 * t - 1.5 * t * t + 2.0 / 9.0 * t.powi(3);
    let last = found.moments.last().unwrap();
    assert!((last.qd[0] - 2.0 / 3.0 * 2.75 * 2.75).abs() < 1e-8, "{last:?}");
    assert!((last.q[0] - (stopped + 2.0 / 9.0 * 2.75_f64.powi(3))).abs() < 1e-7, "{last:?} {stopped}");
    assert_eq!(found.switched, 2);
}

/// An arm with Coulomb's friction in all joints comes to rest, its energy balanced through all that sticks and slides on the way.
#[test]
fn an_arm_comes_to_rest() {
    for (name, seed) in [("planar-2r", 1), ("articulated-3r", 2), ("scara", 3)] {
        let mut arm = Dynamics::numeric(&random_arm(name, seed)).unwrap();
        arm.drives.iter_mut().for_each(|d| (d.viscous, d.coulomb) = (3.0, 2.0));
        let [q, qd, _] = state(arm.joints(), &mut Random(seed));
        let how = Method::Adaptive { tolerance: 1e-8 };
        let found = motion(&arm, (&q, &qd), &free(arm.joints()), (4.0, 0.02), how);
        let (drift, size) = found.drift();
        assert!(drift < 1e-5 * size && found.switched > 0, "{name}: {drift:e} of {size}, {}", found.switched);
    }
}

/// What cannot be is refused, and what was found is beside it.
#[test]
fn refusals() {
    let arm = pendulum();
    let why =
        |arm: &Dynamics<f64>, qd: f64, times, how| match simulate(arm, (&[0.0], &[qd]), &free(1), times, how)
        {
            Err((why, found)) => (why, found.moments.len()),
            Ok(found) => panic!("{:?}", found.moments),
        };
    let step = |step| Method::Symplectic { step };
    assert_eq!(why(&arm, 0.0, (0.0, 1.0), FINE).0, NoMotion::NotPositive);
    assert_eq!(why(&arm, 0.0, (1.0, f64::NAN), FINE).0, NoMotion::NotPositive);
    assert_eq!(why(&arm, 0.0, (1.0, 1.0), step(f64::INFINITY)).0, NoMotion::NotPositive);
    assert_eq!(why(&arm, 0.0, (1.0, 1e-9), FINE).0, NoMotion::Samples);
    // Each sample ends a step, and of these there are no more.
    assert_eq!(why(&arm, 0.0, (1.0, 1.0 / 600_000.0), FINE).0, NoMotion::Samples);
    assert!(matches!(why(&arm, 0.0, (1.0, 0.5), step(1e-9)), (NoMotion::Steps { .. }, 2)));
    assert!(matches!(
        why(&arm, 1e200, (1.0, 0.5), FINE).0,
        NoMotion::NotFinite { .. } | NoMotion::Steps { .. }
    ));
    assert!(matches!(why(&arm, 0.0, (100.0, 50.0), step(50.0)).0, NoMotion::NotSolved { .. }));
    assert_eq!(why(&block("coulomb = 5"), 0.0, (1.0, 0.5), step(0.1)).0, NoMotion::Coulomb);
    let empty = self::arm("name = 'p'\nconvention = 'craig'\n[[joints]]\ntheta = 'q1'\nmass = 2\n");
    assert_eq!(why(&empty, 0.0, (1.0, 0.5), FINE).0, NoMotion::Singular { joint: 0, t: 0.0 });
    for (times, rows) in
        [(vec![], vec![]), (vec![0.0, 0.0], vec![vec![1.0]; 2]), (vec![0.0], vec![vec![f64::NAN]])]
    {
        assert_eq!(Torques::over(times, rows), None);
    }
}

/// The momentum of the mass is its derivative by time; about any axis, moved there as a first joint at rest, it is what that joint
/// has: the entry of A q̇.
#[test]
fn momentum_is_that_of_all_mass() {
    for (k, name) in
        ["planar-2r", "articulated-3r", "scara", "stanford", "franka-panda"].into_iter().enumerate()
    {
        let mut arm = Dynamics::numeric(&random_arm(name, 40 + k as u64)).unwrap();
        arm.drives.iter_mut().for_each(|d| d.rotor = 0.0);
        let [q, qd, _] = state(arm.joints(), &mut Random(k as u64));
        let found = momentum(&arm, &q, &qd);
        let at = |t: f64| {
            let moved: Vec<f64> = q.iter().zip(&qd).map(|(q, v)| q + t * v).collect();
            momentum(&arm, &moved, &qd).centre
        };
        let step = 1e-5;
        let rate = (at(step) - at(-step)).scale(found.mass / (2.0 * step));
        let off = (found.linear - rate).0.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        assert!(off < 1e-6, "{name}: {:?} {rate:?}", found.linear);
        let about_base = found.angular + found.centre.cross(found.linear);
        for axis in [Axis::X, Axis::Y, Axis::Z] {
            // z of the new joint's frame along the axis of the base.
            let turned = match axis {
                Axis::X => Rotation::from_sin_cos(Axis::Y, 1.0, 0.0),
                Axis::Y => Rotation::from_sin_cos(Axis::X, -1.0, 0.0),
                Axis::Z => Rotation::identity(),
            };
            let place = Transform::from_rotation_translation(turned, Vector::zero());
            let mut longer = arm.clone();
            longer.links[0].before = place.inverse() * longer.links[0].before;
            for (k, link) in longer.links.iter_mut().enumerate() {
                link.parent = Some(k);
                link.value.terms.iter_mut().for_each(|t| t.0 += 1);
            }
            let first = Link {
                parent: None,
                before: place,
                kind: JointKind::Revolute,
                value: Affine { offset: 0.0, quarters: 0, terms: vec![(0, 1.0)] },
                body: Body::nothing(),
                row: 0,
            };
            longer.links.insert(0, first);
            longer.drives.insert(0, Drive::nothing());
            let still: Vec<f64> = [0.0].iter().chain(&q).copied().collect();
            let rates: Vec<f64> = [0.0].iter().chain(&qd).copied().collect();
            let wanted: f64 = inertia_matrix(&longer, &still)[0].iter().zip(&rates).map(|(a, b)| a * b).sum();
            let own = about_base.dot(Vector::unit(axis));
            assert!((own - wanted).abs() < 1e-9 * (1.0 + wanted.abs()), "{name} {axis:?}: {own} {wanted}");
        }
    }
}

/// What the tool carries is a body like others: its weight is felt at the joints as the wrench that holds it.
#[test]
fn a_payload_is_felt() {
    let arm = Dynamics::numeric(&random_arm("articulated-3r", 9)).unwrap();
    let [q, _, _] = state(3, &mut Random(4));
    let mass = 1.7;
    let loaded = arm.clone().carrying(&Body::about_centre(mass, Vector::zero(), [0.0; 6]));
    let pull = [Vector(arm.gravity.0.map(|g| mass * g)).scale(-1.0), Vector::zero()];
    let still = [0.0; 3];
    let wanted = inverse_dynamics(&arm, &q, &still, &still, Some(&pull));
    let found = inverse_dynamics(&loaded, &q, &still, &still, None);
    assert!(
        found.iter().zip(&wanted).all(|(a, b)| (a - b).abs() < 1e-12 * (1.0 + b.abs())),
        "{found:?} {wanted:?}"
    );
}
