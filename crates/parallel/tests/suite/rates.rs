//! Rates and singularities, held against differences and against what is known by hand.

use crate::{pose, signed, vector};
use denavit::geometry::{Rotation, Transform, Vector};
use denavit::random::Random;
use denavit_parallel::delta::{Delta, Drive};
use denavit_parallel::planar::{Planar, PlanarPose};
use denavit_parallel::rates::{Gained, Rates};
use denavit_parallel::stewart::Stewart;
use std::f64::consts::{FRAC_PI_2, TAU};

/// The rates of the drives at a velocity of the platform.
fn drives(rates: &Rates, x: &[f64]) -> Vec<f64> {
    let along = |row: &Vec<f64>| row.iter().zip(x).map(|(a, b)| a * b).sum::<f64>();
    rates.platform.iter().zip(&rates.drives).map(|(row, d)| along(row) / d).collect()
}

fn near(a: &[f64], b: &[f64], tolerance: f64) {
    let is_near = a.iter().zip(b).all(|(a, b)| (a - b).abs() < tolerance * (1.0 + a.abs()));
    assert!(is_near, "{a:?} {b:?}");
}

const H: f64 = 1e-6;

#[test]
fn rates_are_differences() {
    let mut random = Random(11);
    for _ in 0..50 {
        let platform = Stewart {
            base: [0; 6].map(|_| vector(&mut random)),
            platform: [0; 6].map(|_| vector(&mut random)),
        };
        let at = pose(&mut random);
        let (v, w) = (vector(&mut random), vector(&mut random));
        let moved = |h: f64| {
            let turn =
                Rotation::about_x(w[0] * h) * Rotation::about_y(w[1] * h) * Rotation::about_z(w[2] * h);
            platform.lengths(&Transform::from_rotation_translation(
                turn * at.rotation,
                at.translation + v.scale(h),
            ))
        };
        let (a, b) = (moved(-H), moved(H));
        let difference: Vec<f64> = (0..6).map(|i| (b[i] - a[i]) / (2.0 * H)).collect();
        let rates = platform.rates(&at).expect("no leg has the length 0");
        near(&drives(&rates, &[v.0, w.0].concat()), &difference, 1e-6);
        // J (J_x ẋ) = ẋ
        let j = rates.forward().expect("it is regular");
        let back: Vec<f64> =
            j.iter().map(|row| row.iter().zip(&difference).map(|(a, b)| a * b).sum()).collect();
        near(&back, &[v.0, w.0].concat(), 1e-4);
    }
    for drive in [Drive::Turns(0.235), Drive::Slides(1.2)] {
        let delta = Delta { base: 0.2, platform: 0.045, rod: 0.8, arms: [0.1, 2.1, 4.3], drive };
        let (p, v) = (Vector([0.1, -0.05, -0.7]), vector(&mut random));
        for k in 0..8 {
            let q = |h: f64| delta.inverse(p + v.scale(h)).expect("it reaches")[k].q;
            let (a, b) = (q(-H), q(H));
            let difference: Vec<f64> = (0..3).map(|i| (b[i] - a[i]) / (2.0 * H)).collect();
            near(&drives(&delta.rates(p, &q(0.0)), &v.0), &difference, 1e-6);
        }
    }
    let robot = Planar {
        base: [[0.0, 0.0], [1.0, 0.1], [0.4, 0.9]],
        platform: [[0.1, 0.0], [0.3, 0.0], [0.2, 0.2]],
        first: [0.5, 0.6, 0.4],
        second: [0.5, 0.4, 0.6],
    };
    let x = [0; 3].map(|_| signed(&mut random));
    for k in 0..8 {
        let at = |h: f64| PlanarPose { position: [0.3 + h * x[0], 0.3 + h * x[1]], angle: 0.1 + h * x[2] };
        let q = |h: f64| robot.inverse(&at(h)).expect("it reaches")[k].q;
        let (a, b) = (q(-H), q(H));
        let difference: Vec<f64> = (0..3).map(|i| (b[i] - a[i]) / (2.0 * H)).collect();
        near(&drives(&robot.rates(&at(0.0), &q(0.0)), &x), &difference, 1e-6);
    }
}

/// Fichter 1986 ("A Stewart platform-based manipulator"): an octahedral platform that is turned by ±90° about its axis is singular, in a
/// screw along that axis.
#[test]
fn fichters_singularity_is_a_screw_along_the_axis() {
    let corner = |k: usize, r: f64| {
        let (sin, cos) = (k as f64 * TAU / 3.0).sin_cos();
        Vector([r * cos, r * sin, 0.0])
    };
    // Legs 2k and 2k + 1 go from corner k to corners k + 1 and k + 2 of the same triangle, turned: at 0° the sides are opposite.
    let platform = Stewart {
        base: std::array::from_fn(|i| corner(i / 2, 1.0)),
        platform: std::array::from_fn(|i| corner((i / 2 + 1 + i % 2) % 3, 0.6)),
    };
    let turned = |angle: f64| Transform::translation(0.0, 0.0, 0.8) * Transform::rotation_z(angle);
    let singular = |angle: f64| platform.rates(&turned(angle)).expect("legs have lengths").singular();
    assert!(singular(0.0).gained.is_empty() && singular(0.5).gained.is_empty());
    for angle in [FRAC_PI_2, -FRAC_PI_2] {
        let found = singular(angle);
        let [Gained::Screw { axis, point, pitch }] = found.gained[..] else { panic!("{found:?}") };
        assert!(
            axis[2].abs() > 1.0 - 1e-9 && point[0].hypot(point[1]) < 1e-9 && pitch.abs() > 0.01,
            "{found:?}"
        );
        assert!(found.condition().is_infinite() && found.serial.is_empty());
        // No leg changes its length to first order.
        let rates = platform.rates(&turned(angle)).expect("legs have lengths");
        let v = axis.scale(pitch) - axis.cross(Vector([0.0, 0.0, 0.8]) - point).scale(-1.0);
        near(&drives(&rates, &[v.0, axis.0].concat()), &[0.0; 6], 1e-9);
    }
}

#[test]
fn a_delta_is_singular_where_rods_are_in_a_plane_or_along_arms() {
    let arms = [0.0, TAU / 3.0, 2.0 * TAU / 3.0];
    let delta = Delta { base: 0.2, platform: 0.05, rod: 0.35, arms, drive: Drive::Turns(0.2) };
    // All rods horizontal: it gains the motion along z.
    let q = [FRAC_PI_2 * 0.0; 3];
    let p = delta.forward(&q).expect("they touch");
    assert_eq!(p.len(), 1);
    let found = delta.rates(p[0].1, &q).singular();
    let [Gained::Translation(along)] = found.gained[..] else { panic!("{found:?}") };
    assert!(along[2].abs() > 1.0 - 1e-6, "{along:?}");
    // Rods straight on from the arms: drives move and the platform does not, and all rods are in a plane as well.
    assert_eq!(found.serial, [0, 1, 2]);
    let regular = delta
        .rates(Vector([0.0, 0.0, -0.3]), &delta.inverse(Vector([0.0, 0.0, -0.3])).expect("it reaches")[0].q);
    let found = regular.singular();
    assert!(found.gained.is_empty() && found.serial.is_empty() && found.condition() < 100.0);
}

#[test]
fn a_planar_robot_is_singular_where_links_meet_in_a_point_or_stretch() {
    let corner = |k: usize, r: f64| {
        let (sin, cos) = (k as f64 * TAU / 3.0).sin_cos();
        [r * cos, r * sin]
    };
    let robot = Planar {
        base: [0, 1, 2].map(|k| corner(k, 0.5)),
        platform: [0, 1, 2].map(|k| corner(k, 0.1)),
        first: [0.2; 3],
        second: [0.3; 3],
    };
    // All second links point to the middle: the platform turns about it.
    let pose = PlanarPose { position: [0.0, 0.0], angle: 0.0 };
    let mut q = robot.inverse(&pose).expect("it reaches")[0].q;
    let bent = robot.rates(&pose, &q).singular();
    assert!(bent.gained.is_empty() && bent.serial.is_empty(), "{bent:?}");
    let stretched = Planar { second: [0.2; 3], ..robot };
    q = stretched.inverse(&pose).expect("it reaches")[0].q;
    let found = stretched.rates(&pose, &q).singular();
    let [Gained::Screw { point, pitch, .. }] = found.gained[..] else { panic!("{found:?}") };
    assert!(point.norm() < 1e-9 && pitch == 0.0);
    assert_eq!(found.serial, [0, 1, 2]);
}
