//! Planar 3-RRR robots.

use crate::{cases, signed};
use denavit::random::Random;
use denavit_parallel::planar::{Planar, PlanarPose};

fn any(random: &mut Random) -> Planar {
    let point = |random: &mut Random| [signed(random), signed(random)];
    Planar {
        base: [0; 3].map(|_| point(random)),
        platform: [0; 3].map(|_| point(random)),
        first: [0; 3].map(|_| 0.3 + random.unit()),
        second: [0; 3].map(|_| 0.3 + random.unit()),
    }
}

fn open(robot: &Planar, pose: &PlanarPose, q: &[f64; 3]) -> f64 {
    let (sin, cos) = pose.angle.sin_cos();
    let off = |i: usize| {
        let ([x, y], c) = (robot.platform[i], robot.elbow(i, q[i]));
        let at = [pose.position[0] + cos * x - sin * y, pose.position[1] + sin * x + cos * y];
        ((at[0] - c[0]).hypot(at[1] - c[1]) - robot.second[i]).abs()
    };
    (0..3).map(off).fold(0.0, f64::max)
}

#[test]
fn all_poses_close_and_the_own_one_is_among_them() {
    let (mut random, mut count, mut complete) = (Random(6), [0; 7], 0);
    let mut reached = 0;
    for case in 0..cases(2_000, 100_000) {
        let robot = any(&mut random);
        let pose = PlanarPose {
            position: [signed(&mut random), signed(&mut random)],
            angle: 3.2 * signed(&mut random),
        };
        let Ok(modes) = robot.inverse(&pose) else { continue };
        reached += 1;
        for mode in &modes {
            assert!(open(&robot, &pose, &mode.q) < 1e-12, "{case} {}", mode.name());
        }
        let q = modes[case % 8].q;
        let found = robot.forward(&q);
        complete += usize::from(found.is_complete);
        count[found.assemblies.len()] += 1;
        for a in &found.assemblies {
            assert!(open(&robot, &a.pose, &q) < 1e-10, "{case}: {a:?}");
        }
        let off = |a: &PlanarPose| {
            let turn = (a.angle - pose.angle).sin().abs();
            (a.position[0] - pose.position[0]).hypot(a.position[1] - pose.position[1]).max(turn)
        };
        let nearest = found.assemblies.iter().map(|a| off(&a.pose)).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-5, "{case}: {nearest:e} {found:?}");
        if found.is_complete {
            assert_eq!(
                found.assemblies.len() % 2,
                0,
                "{case}: roots of a polynomial of degree 6 come in pairs"
            );
        }
    }
    println!("{reached} robots: {complete} complete; by their poses {count:?}");
    assert!(reached > 100 && complete * 100 >= 99 * reached, "{complete} of {reached}");
    assert!(count[6] > 0, "{count:?}");
}

/// Equilateral triangles: an own pose with all drives turned alike.
#[test]
fn a_symmetric_robot_turns_in_its_middle() {
    let corner = |k: usize, r: f64, first: f64| {
        let (sin, cos) = (first + k as f64 * std::f64::consts::TAU / 3.0).sin_cos();
        [r * cos, r * sin]
    };
    let robot = Planar {
        base: [0, 1, 2].map(|k| corner(k, 0.35, 0.0)),
        platform: [0, 1, 2].map(|k| corner(k, 0.1, 0.0)),
        first: [0.2; 3],
        second: [0.2; 3],
    };
    let modes = robot.inverse(&PlanarPose { position: [0.0, 0.0], angle: 0.2 }).expect("it reaches");
    let q = modes[0].q;
    let found = robot.forward(&q);
    let middle =
        found.assemblies.iter().filter(|a| a.pose.position[0].hypot(a.pose.position[1]) < 1e-6).count();
    assert_eq!(middle, 2, "{found:?}");
    // Turned by 90°, 180°, 270°: where charts of the angle end.
    for quarter in 0..4 {
        let angle = 0.3 + 0.25 * std::f64::consts::TAU * f64::from(quarter);
        let pose = PlanarPose { position: [0.02, -0.01], angle };
        let Ok(modes) = robot.inverse(&pose) else { continue };
        let found = robot.forward(&modes[5].q);
        assert!(found.is_complete, "{found:?}");
        assert!(found.assemblies.iter().any(|a| (a.pose.angle - angle).sin().abs() < 1e-9), "{quarter}");
    }
}

/// The platform and the elbows are the same triangle and all second links are alike: every position on a circle does.
#[test]
fn a_motion_with_drives_at_rest_is_not_counted() {
    let b = [[0.0, 0.0], [0.3, 0.0], [0.1, 0.25]];
    let robot =
        Planar { base: b.map(|p| [p[0] - 0.2, p[1]]), platform: b, first: [0.2; 3], second: [0.15; 3] };
    let found = robot.forward(&[0.0; 3]);
    assert!(
        !found.is_complete && found.assemblies.iter().all(|a| !a.is_proved || a.residual < 1e-10),
        "{found:?}"
    );
}
