//! Inverse kinematics of closed loops.

use crate::common::Random;
use crate::linkages::{Between, catalogued, linkage};
use denavit::closure::{ClosedInverse, Loops};
use denavit::description::linkage::Wanted;
use denavit::description::{JointKind, Linkage};
use denavit::geometry::{Rotation, Transform, Vector};
use std::f64::consts::PI;

/// Of what was found every configuration is closed there and has the frame where it is wanted, and what the pose was made from is among
/// them.
fn compare(
    name: &str,
    linkage: &Linkage,
    wanted: Wanted,
    poses: usize,
    random: &mut Random,
) -> (usize, usize) {
    let inverse = ClosedInverse::new(linkage, None, wanted).unwrap_or_else(|e| panic!("{name}: {e}"));
    let loops = Loops::new(linkage).unwrap();
    let (_, place) = loops.place(None).unwrap();
    let (mut found, mut lost) = (0, 0);
    let mut left = poses;
    while left > 0 {
        let q: Vec<f64> = loops
            .driven()
            .iter()
            .map(|kind| match kind {
                JointKind::Revolute => random.between(-3.0, 3.0),
                JointKind::Prismatic => random.between(-1.0, 1.5),
            })
            .collect();
        for assembly in loops.assemblies(&q) {
            left = left.saturating_sub(1);
            let mut pose = loops.pose(&place, &q, &assembly.passive);
            if wanted == Wanted::Position {
                pose = Transform::from_rotation_translation(Rotation::identity(), pose.translation);
            }
            let answer = inverse.solve(&pose);
            assert!(!answer.is_out_of_plane, "{name} at {q:?}");
            found += answer.solutions.len();
            for s in &answer.solutions {
                assert!(loops.is_closed(&s.q, &s.passive), "{name} at {q:?}: {s:?}");
                let there = loops.pose(&place, &s.q, &s.passive);
                let off = (there.translation - pose.translation).norm();
                assert!(off < 1e-7, "{name} at {q:?}: {off:e}");
                if wanted == Wanted::Pose {
                    let (a, b) = (there.rotation.rows(), pose.rotation.rows());
                    let off = a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| (a - b).abs());
                    assert!(off.fold(0.0, f64::max) < 1e-7, "{name} at {q:?}");
                }
                if let Some(mode) = &s.mode {
                    assert!(loops.assembly_near(&s.q, mode, Some(&s.passive)).is_ok(), "{name}: {mode}");
                }
            }
            let same = |a: f64, b: f64, kind: &JointKind| match kind {
                JointKind::Revolute => ((a - b + PI).rem_euclid(2.0 * PI) - PI).abs() < 1e-4,
                JointKind::Prismatic => (a - b).abs() < 1e-4,
            };
            let is_there = answer.solutions.iter().any(|s| {
                s.q.iter().zip(&q).zip(loops.driven()).all(|((a, b), k)| same(*a, *b, k))
                    && s.passive
                        .iter()
                        .zip(&assembly.passive)
                        .zip(loops.passive())
                        .all(|((a, b), k)| same(*a, *b, k))
            });
            if !is_there {
                assert!(!answer.is_complete, "{name} at {q:?} {}: said to be complete", assembly.mode);
                lost += 1;
            }
        }
    }
    (found, lost)
}

/// A five-bar's four solutions for a point, in closed form.
#[test]
fn a_five_bar_reaches_a_point_in_four_ways() {
    let mut random = Random(301);
    let five = catalogued("five-bar");
    let inverse = ClosedInverse::new(&five, None, Wanted::Position).unwrap();
    assert!(inverse.is_closed_form());
    let (found, lost) = compare("five-bar", &five, Wanted::Position, 200, &mut random);
    assert_eq!(lost, 0);
    assert!(found > 400, "{found}");
    let loops = Loops::new(&five).unwrap();
    let home: Vec<f64> = five.poses[0].1.iter().map(|e| e.eval(|_| None).unwrap()).collect();
    let (_, place) = loops.place(None).unwrap();
    let p = loops.assemblies(&home)[0].passive.clone();
    let answer = inverse.solve(&loops.pose(&place, &home, &p));
    assert_eq!((answer.solutions.len(), answer.is_complete), (4, true), "{answer:?}");
    let far = Transform::from_rotation_translation(Rotation::identity(), Vector([1e3, 0.0, 0.0]));
    let answer = inverse.solve(&far);
    assert!(answer.solutions.is_empty() && answer.is_complete && !answer.is_out_of_plane);
    let above = Transform::from_rotation_translation(Rotation::identity(), Vector([0.1, 0.1, 1.0]));
    assert!(inverse.solve(&above).is_out_of_plane);
}

/// The same in planes that stand upright and aslant.
#[test]
fn planes_in_space_have_closed_forms() {
    let mut random = Random(303);
    let text = denavit::catalogue::linkage_text("five-bar").unwrap();
    for turned in [
        "alpha = \"90 deg\"",
        "gamma = \"30 deg\"\nalpha = \"-90 deg\"",
        "gamma = \"40 deg\"\nalpha = \"0.7\"\nb = 0.3",
    ] {
        // Both arms stand on the base.
        let text = text
            .replace("name = \"left arm\"", &format!("name = \"left arm\"\n{turned}"))
            .replace("after = \"base\"", &format!("after = \"base\"\n{turned}"));
        let five = linkage(&text);
        for wanted in [Wanted::Position, Wanted::Pose] {
            let inverse = ClosedInverse::new(&five, None, wanted).unwrap();
            // A pose is one number more than there are joints.
            assert_eq!(inverse.is_closed_form(), wanted == Wanted::Position, "{turned}");
        }
        let (found, lost) = compare(turned, &five, Wanted::Position, 60, &mut random);
        assert_eq!(lost, 0);
        assert!(found > 120, "{found}");
        let inverse = ClosedInverse::new(&five, None, Wanted::Position).unwrap();
        let beside = Transform::from_rotation_translation(Rotation::identity(), Vector([0.3, 0.2, 0.1]));
        assert!(inverse.solve(&beside).is_out_of_plane, "{turned}");
    }
    // Poses of a plane: a platform on three legs.
    let legs = upright_platform();
    let inverse = ClosedInverse::new(&legs, None, Wanted::Pose).unwrap();
    assert!(inverse.is_closed_form());
    let (found, lost) = compare("upright platform", &legs, Wanted::Pose, 40, &mut random);
    assert!(lost == 0 && found > 80, "{found}, {lost} lost");
}

/// Three legs of two links under a triangle, in the plane of x and z of the base.
fn upright_platform() -> Linkage {
    linkage(
        "name = \"three legs\"\nconvention = \"khalil\"\ntip = \"platform\"\n\
         [[joints]]\nname = \"a1\"\nalpha = \"90 deg\"\ntheta = \"q1\"\n[[joints]]\nname = \"b1\"\nd = 0.5\ntheta = \"p1\"\n\
         [[joints]]\nname = \"platform\"\nd = 0.6\ntheta = \"p2\"\n\
         [[joints]]\nname = \"a2\"\nafter = \"base\"\nalpha = \"90 deg\"\nd = 1\ntheta = \"q2\"\n\
         [[joints]]\nname = \"b2\"\nd = 0.6\ntheta = \"p3\"\n\
         [[joints]]\nname = \"a3\"\nafter = \"base\"\nb = 0.8\nalpha = \"90 deg\"\nd = 0.5\ntheta = \"q3\"\n\
         [[joints]]\nname = \"b3\"\nd = 0.5\ntheta = \"p4\"\n\
         [[closures]]\nleft = { after = \"b2\", d = 0.5, theta = \"p5\" }\nright = { after = \"platform\", d = 0.3 }\n\
         [[closures]]\nleft = { after = \"b3\", d = 0.6, theta = \"p6\" }\n\
         right = { after = \"platform\", gamma = \"50 deg\", d = 0.3 }\n",
    )
}

/// Three legs of two links under a triangle: three joints driven, poses of the plane, the loops one dyad after the other.
#[test]
fn a_planar_platform_on_three_legs_reaches_poses_in_eight_ways() {
    let mut random = Random(302);
    let mut most = 0;
    for _ in 0..6 {
        let mut size = |low: f64, high: f64| (random.between(low, high) * 1000.0).round() / 1000.0;
        let (a, b, c) = (size(0.4, 0.7), size(0.4, 0.7), size(0.2, 0.4));
        let text = format!(
            "name = \"three legs\"\nconvention = \"khalil\"\ntip = \"platform\"\n\
             [[joints]]\nname = \"a1\"\ntheta = \"q1\"\n[[joints]]\nname = \"b1\"\nd = {a}\ntheta = \"p1\"\n\
             [[joints]]\nname = \"platform\"\nd = {b}\ntheta = \"p2\"\n\
             [[joints]]\nname = \"a2\"\nafter = \"base\"\nd = 1\ntheta = \"q2\"\n[[joints]]\nname = \"b2\"\nd = {b}\ntheta = \"p3\"\n\
             [[joints]]\nname = \"a3\"\nafter = \"base\"\ngamma = \"60 deg\"\nd = 1\ntheta = \"q3\"\n\
             [[joints]]\nname = \"b3\"\nd = {a}\ntheta = \"p4\"\n\
             [[closures]]\nleft = {{ after = \"b2\", d = {a}, theta = \"p5\" }}\nright = {{ after = \"platform\", d = {c} }}\n\
             [[closures]]\nleft = {{ after = \"b3\", d = {b}, theta = \"p6\" }}\n\
             right = {{ after = \"platform\", gamma = \"50 deg\", d = {c} }}\n"
        );
        let legs = linkage(&text);
        let inverse = ClosedInverse::new(&legs, None, Wanted::Pose).unwrap();
        assert!(inverse.is_closed_form(), "{text}");
        for _ in 0..40 {
            let turn = Rotation::from_sin_cos(denavit::geometry::Axis::Z, 0.1_f64.sin(), 0.1_f64.cos());
            let at = Vector([random.between(0.2, 0.6), random.between(0.1, 0.5), 0.0]);
            let answer = inverse.solve(&Transform::from_rotation_translation(turn, at));
            assert!(answer.is_complete);
            most = most.max(answer.solutions.len());
            let loops = inverse.loops();
            for s in &answer.solutions {
                assert!(loops.is_closed(&s.q, &s.passive), "{s:?}");
                let (_, place) = loops.place(None).unwrap();
                let there = loops.pose(&place, &s.q, &s.passive);
                assert!((there.translation - at).norm() < 1e-9, "{s:?}");
            }
        }
    }
    assert_eq!(most, 8);
}

/// What is not one dyad after the other is sought, and never said to be complete.
#[test]
fn other_linkages_are_sought() {
    let mut random = Random(303);
    for (name, wanted, poses) in [
        ("four-bar", Wanted::Position, 30),
        ("slider-crank", Wanted::Position, 30),
        ("akr3000", Wanted::Pose, 4),
        ("sr400", Wanted::Pose, 4),
    ] {
        let (found, lost) = compare(name, &catalogued(name), wanted, poses, &mut random);
        assert!(found > 0 && 2 * lost <= poses, "{name}: {found} found, {lost} of {poses} lost");
    }
}
