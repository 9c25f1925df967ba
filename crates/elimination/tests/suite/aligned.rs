//! Poses with the last axis parallel to the first, such as a tool that points straight down: the 12 × 12 matrices of the
//! splits lose their rank there, the answers must not.
//!
//! `DENAVIT_SOAK=1` solves 2,000 poses an arm.

use crate::arms::{Draws, apart, named, newton, reversed, solve};
use denavit_elimination::{Answer, Arm, Certificate, Joint, Plan, Rigid};

fn poses() -> usize {
    if std::env::var_os("DENAVIT_SOAK").is_some() { 2000 } else { 60 }
}

/// A turn about x and y together.
fn tilted(by: f64) -> Rigid {
    let ((s, c), (t, d)) = (by.sin_cos(), (0.7 * by).sin_cos());
    Rigid { rotation: [[d, 0.0, t], [s * t, c, -s * d], [-c * t, s, c * d]], translation: [0.0; 3] }
}

/// A pose within reach with the tool along the first axis or (mostly) against it; the last axis is the tool's.
fn aligned(arm: &Arm, draws: &mut Draws) -> Rigid {
    loop {
        let mut pose = arm.pose(&draws.configuration(arm));
        let (s, c) = draws.between(-3.1, 3.1).sin_cos();
        let up = if draws.unit() < 0.8 { -1.0 } else { 1.0 };
        pose.rotation = [[c, -up * s, 0.0], [s, up * c, 0.0], [0.0, 0.0, up]];
        if (0..6).any(|_| newton(arm, &pose, draws.configuration(arm)).is_some()) {
            return pose;
        }
    }
}

/// The arms of [`named`] whose first axis is the base's and whose last one the tool's, but for the two whose straight
/// wrists and shoulders make singular poses common here: those have closed forms.
fn candidates() -> Vec<(&'static str, Arm)> {
    let stands = |arm: &Arm| arm.base.rotation[2][2] == 1.0 && arm.links[5].rotation[2][2].abs() == 1.0;
    let turns = |arm: &Arm| arm.joints == [Joint::Revolute; 6];
    let arms: Vec<_> = named().into_iter().filter(|(_, arm)| stands(arm) && turns(arm)).collect();
    arms.into_iter().filter(|(name, _)| !["UR10e", "PUMA 560"].contains(name)).collect()
}

/// Solutions that are not among others.
fn missing(arm: &Arm, all: &[[f64; 6]], answer: &Answer) -> usize {
    let known = |q: &[f64; 6]| answer.solutions.iter().any(|s| apart(arm, &s.q, q) < 1e-4);
    all.iter().filter(|q| arm.smallest_singular_value(q) > 1e-5 && !known(q)).count()
}

/// Complete sets, and certified: the reversed arm has the same, Newton's method finds no more from random starts, and
/// none comes from the poses on either side.
#[test]
fn complete_sets() {
    let mut kinds = 0;
    for (name, arm) in candidates() {
        kinds += 1;
        let other_arm = reversed(&arm);
        let (plan, other) = (Plan::new(&arm).unwrap(), Plan::new(&other_arm).unwrap());
        let (mut draws, mut answer, mut beside) = (Draws(47), Answer::default(), Answer::default());
        let mut certified = 0;
        for turn in 0..poses() {
            let pose = aligned(&arm, &mut draws);
            solve(&plan, &pose, &mut answer);
            certified += usize::from(answer.certificate == Certificate::Complete);
            assert!(!answer.solutions.is_empty(), "{name}");

            let mut all = vec![];
            for tilt in [1e-6, -1e-6] {
                solve(&plan, &pose.then(&tilted(tilt)), &mut beside);
                let polished = |q: [f64; 6]| newton(&arm, &pose, q).filter(|p| apart(&arm, p, &q) < 1e-2);
                all.extend(beside.solutions.iter().filter_map(|s| polished(s.q)));
            }
            let starts = if turn < 20 { 20 } else { 0 };
            all.extend((0..starts).filter_map(|_| newton(&arm, &pose, draws.configuration(&arm))));
            assert_eq!(missing(&arm, &all, &answer), 0, "{name}: pose {turn}, {pose:?}");

            solve(&other, &pose.inverse(), &mut beside);
            if [&answer, &beside].iter().all(|answer| answer.certificate == Certificate::Complete) {
                assert_eq!(answer.solutions.len(), beside.solutions.len(), "{name}: pose {turn}, {pose:?}");
            }
        }
        assert!(100 * certified >= 98 * poses(), "{name}: {certified} certified of {}", poses());
    }
    assert!(kinds >= 8, "{kinds}");
}

/// On the way to such a pose the number of solutions does not change, nor do they.
#[test]
fn nearly_aligned() {
    for (name, arm) in candidates() {
        let plan = Plan::new(&arm).unwrap();
        let (mut draws, mut answer) = (Draws(48), Answer::default());
        for turn in 0..poses() / 6 {
            let pose = aligned(&arm, &mut draws);
            solve(&plan, &pose, &mut answer);
            if answer.certificate != Certificate::Complete
                || answer.solutions.iter().any(|s| s.singular < 1e-3)
            {
                continue;
            }
            let all: Vec<[f64; 6]> = answer.solutions.iter().map(|s| s.q).collect();
            for tilt in [1e-12, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6] {
                solve(&plan, &pose.then(&tilted(tilt)), &mut answer);
                let known = |q: &[f64; 6]| answer.solutions.iter().any(|s| apart(&arm, &s.q, q) < 2e-2);
                assert!(all.iter().all(known), "{name}: pose {turn} off by {tilt:e}");
                assert_eq!(answer.solutions.len(), all.len(), "{name}: pose {turn} off by {tilt:e}");
            }
        }
    }
}

/// An arm with a slide: the wider matrix takes it as well.
#[test]
fn with_a_slide() {
    for slide in [1, 2, 3, 4] {
        let rows = [
            [0.1, 0.3, -90.0, 0.0],
            [0.5, 0.1, 180.0, -90.0],
            [0.05, 0.2, -90.0, 0.0],
            [0.0, 0.4, 90.0, 0.0],
            [0.1, 0.15, -90.0, 0.0],
            [0.0, 0.16, 180.0, 0.0],
        ];
        let mut arm = crate::arms::standard(rows);
        arm.joints[slide] = Joint::Prismatic;
        let Ok(plan) = Plan::new(&arm) else { continue };
        let (mut draws, mut answer) = (Draws(49), Answer::default());
        for turn in 0..poses() / 2 {
            let pose = aligned(&arm, &mut draws);
            solve(&plan, &pose, &mut answer);
            let all: Vec<[f64; 6]> =
                (0..30).filter_map(|_| newton(&arm, &pose, draws.configuration(&arm))).collect();
            assert_eq!(missing(&arm, &all, &answer), 0, "slide {slide}, pose {turn}: {answer:?}");
        }
    }
}
