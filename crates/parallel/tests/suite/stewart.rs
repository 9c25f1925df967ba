//! Stewart platforms.

use crate::{apart, cases, pose, vector};
use denavit::geometry::{Rotation, Transform, Vector};
use denavit::random::Random;
use denavit_parallel::Stewart;
use denavit_parallel::stewart::{Bound, start};
use std::time::Instant;

/// Peter Dietmaier, "The Stewart-Gough platform of general geometry can have 40 real postures", Advances in Robot Kinematics, 1998:
/// the platform that he found, with its legs.
fn dietmaier() -> (Stewart, [f64; 6]) {
    let base = [
        [0.0, 0.0, 0.0],
        [1.107915, 0.0, 0.0],
        [0.549094, 0.756063, 0.0],
        [0.735077, -0.223935, 0.525991],
        [0.514188, -0.526063, -0.368418],
        [0.590473, 0.094733, -0.205018],
    ];
    let platform = [
        [0.0, 0.0, 0.0],
        [0.542805, 0.0, 0.0],
        [0.956919, -0.528915, 0.0],
        [0.665885, -0.353482, 1.402538],
        [0.478359, 1.158742, 0.107672],
        [-0.137087, -0.235121, 0.353913],
    ];
    let lengths = [1.0, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071];
    (Stewart { base: base.map(Vector), platform: platform.map(Vector) }, lengths)
}

#[test]
fn dietmaiers_platform_has_forty_real_poses() {
    let (platform, lengths) = dietmaier();
    let found = platform.forward(&lengths);
    assert_eq!((found.assemblies.len(), found.proved, found.bound, found.lost), (40, 40, Bound::Forty, 0));
    assert!(found.is_complete());
    for a in &found.assemblies {
        assert!(a.radius.is_some_and(|r| r < 1e-9), "{a:?}");
        let closed = platform.lengths(&a.pose);
        assert!(closed.iter().zip(lengths).all(|(a, b)| (a - b).abs() < 1e-12), "{closed:?}");
        assert!(a.pose.rotation.orthonormality_error() < 1e-14 && a.pose.rotation.determinant() > 0.0);
    }
    for (i, a) in found.assemblies.iter().enumerate() {
        assert!(found.assemblies[..i].iter().all(|b| apart(&a.pose, &b.pose) > 1e-3), "{i}");
    }
}

/// What a platform's forward solution is held against: the pose that its lengths come from.
#[test]
fn the_pose_that_lengths_come_from_is_among_all() {
    let (count, mut complete, mut slowest, mut worst) = (cases(20, 1000), 0, 0.0_f64, 0.0_f64);
    let mut poses = [0; 41];
    let start = Instant::now();
    for seed in 0..count {
        let mut random = Random(seed as u64);
        let platform = Stewart {
            base: [0; 6].map(|_| vector(&mut random)),
            platform: [0; 6].map(|_| vector(&mut random)),
        };
        let own = pose(&mut random);
        let lengths = platform.lengths(&own);
        let began = Instant::now();
        let found = platform.forward(&lengths);
        slowest = slowest.max(began.elapsed().as_secs_f64());
        complete += usize::from(found.is_complete());
        assert!(found.proved <= 40 && found.assemblies.len() <= found.proved, "{seed}");
        // Complex solutions come in pairs.
        assert_eq!((found.proved - found.assemblies.len()) % 2, 0, "{seed}");
        poses[found.assemblies.len()] += 1;
        let nearest = found.assemblies.iter().map(|a| apart(&a.pose, &own)).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-7, "{seed}: {nearest:e}");
        for a in &found.assemblies {
            worst = worst.max(a.residual);
            let off =
                platform.lengths(&a.pose).iter().zip(lengths).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 1e-10, "{seed}: {off:e}");
        }
    }
    let mean = start.elapsed().as_secs_f64() / count as f64;
    println!(
        "{count} platforms: {complete} complete; worst residual {worst:.1e} m; {:.1} ms each, {:.1} ms at most; by their real poses: {:?}",
        1e3 * mean,
        1e3 * slowest,
        poses.iter().enumerate().filter(|p| *p.1 > 0).collect::<Vec<_>>()
    );
    assert!(complete * 100 >= 95 * count, "{complete} of {count}");
}

/// Six points of a circle in three pairs, each point by so many degrees from the middle of its pair.
fn pairs(radius: f64, half: f64, first: f64) -> [Vector<f64>; 6] {
    std::array::from_fn(|i| {
        let off = if i % 2 == 0 { -half } else { half };
        let (sin, cos) = ((i / 2) as f64 * 120.0 + first + off).to_radians().sin_cos();
        Vector([radius * cos, radius * sin, 0.0])
    })
}

/// Legs that cross from one pair to the next, as those of machines do.
fn crossing(points: [Vector<f64>; 6]) -> [Vector<f64>; 6] {
    std::array::from_fn(|i| points[(i + 5) % 6])
}

fn tilted() -> Transform<f64> {
    Transform::from_rotation_translation(Rotation::from_rpy(0.2, -0.3, 0.25), Vector([0.1, -0.2, 1.1]))
}

#[test]
fn legs_that_meet_in_three_points_have_sixteen_poses() {
    let corner =
        |points: [Vector<f64>; 6]| -> [Vector<f64>; 6] { std::array::from_fn(|i| points[i / 2 * 2]) };
    for (base, what) in [(pairs(1.0, 12.0, 0.0), "6-3"), (corner(pairs(1.0, 0.0, 0.0)), "octahedron")] {
        let platform = Stewart { base, platform: crossing(corner(pairs(0.6, 0.0, 60.0))) };
        for own in [tilted(), Transform::translation(0.0, 0.0, 1.0)] {
            let found = platform.forward(&platform.lengths(&own));
            assert_eq!((found.proved, found.bound), (16, Bound::Sixteen), "{what}");
            assert!(found.is_complete(), "{what}");
            assert!(found.assemblies.iter().any(|a| apart(&a.pose, &own) < 1e-9), "{what}");
            // Both are planar: what is mirrored at the base closes as well.
            let heights: Vec<f64> = found.assemblies.iter().map(|a| a.pose.translation[2]).collect();
            let mirrored = heights.iter().rev().map(|z| -z);
            assert!(heights.iter().zip(mirrored).all(|(a, b)| (a - b).abs() < 1e-9), "{heights:?}");
        }
    }
}

#[test]
fn what_is_not_proved_is_not_complete() {
    // Two regular half-hexagons: fewer than forty, and nothing here says how many there can be.
    let platform = Stewart { base: pairs(1.0, 12.0, 0.0), platform: crossing(pairs(0.6, 10.0, 60.0)) };
    let found = platform.forward(&platform.lengths(&tilted()));
    assert!(!found.is_complete() && found.proved < 40 && found.lost > 0);
    assert!(found.assemblies.iter().any(|a| apart(&a.pose, &tilted()) < 1e-9 && a.radius.is_some()));
    // Similar hexagons, leg by leg: the platform moves with its legs at rest (Karger and Husty 1998), and no pose is isolated.
    let platform = Stewart { base: pairs(1.0, 12.0, 0.0), platform: pairs(0.6, 12.0, 0.0) };
    let found = platform.forward(&platform.lengths(&tilted()));
    assert!(!found.is_complete() && found.assemblies.iter().all(|a| a.radius.is_none()), "{found:?}");
    // One leg twice.
    let (mut twice, lengths) = dietmaier();
    (twice.base[5], twice.platform[5]) = (twice.base[4], twice.platform[4]);
    let mut same = lengths;
    same[5] = same[4];
    assert!(!twice.forward(&same).is_complete());
    // All points in one.
    let point = Stewart { base: [Vector::zero(); 6], platform: [Vector::zero(); 6] };
    assert!(!point.forward(&[1.0; 6]).is_complete());
    assert!(!point.forward(&[0.0; 6]).is_complete());
}

#[test]
fn legs_that_are_too_short_have_no_pose() {
    let (platform, mut lengths) = dietmaier();
    let own = lengths;
    lengths[0] = 100.0;
    let found = platform.forward(&lengths);
    assert!(found.assemblies.is_empty() && found.is_complete(), "{found:?}");
    let found = platform.forward(&own.map(|l| -l));
    assert!(found.assemblies.is_empty() && !found.is_complete(), "{found:?}");
}

#[test]
fn poses_do_not_depend_on_units_or_frames() {
    let (platform, lengths) = dietmaier();
    let far = Vector([30.0, -20.0, 10.0]);
    for scale in [1e-3, 1.0, 1e3] {
        let moved = Stewart {
            base: platform.base.map(|p| (p + far).scale(scale)),
            platform: platform.platform.map(|p| (p - far).scale(scale)),
        };
        let found = moved.forward(&lengths.map(|l| l * scale));
        assert_eq!(found.assemblies.len(), 40);
        assert!(found.is_complete() && found.assemblies.iter().all(|a| a.residual < 1e-12 * scale * 50.0));
    }
}

#[test]
fn the_forty_starting_points_are_found_again() {
    let (found, kept) = (start::monodromy(), start::solutions());
    assert_eq!(found.len(), 40);
    for x in kept {
        assert_eq!(found.iter().filter(|y| start::apart(&x, y) < 1e-9).count(), 1);
        // A pose: e·e is not 0.
        let n = x[..4].iter().fold(denavit_parallel::complex::Complex::ZERO, |sum, &z| sum + z * z);
        assert!(n.abs() > 1e-6);
    }
}

/// Forty is the degree of the variety: the trace of all forty is linear, and that of fewer is not.
#[test]
fn the_forty_are_all_that_there_are() {
    let all = start::solutions();
    assert!(start::trace_defect(&all) < 1e-9, "{:e}", start::trace_defect(&all));
    for left_out in [0, 13, 39] {
        let mut fewer = all.clone();
        fewer.remove(left_out);
        assert!(start::trace_defect(&fewer) > 1e-6, "{left_out}");
    }
}
