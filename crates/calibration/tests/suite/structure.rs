//! What is seen by the structure, and the rank in numbers.

use crate::made::{POINT, arms, problem};
use denavit::catalogue;
use denavit::geometry::Vector;
use denavit_calibration::visible::supposed;
use denavit_calibration::{Bar, Cause, Measurement, Problem, formula, table_seen, visible};
use denavit_recording::Arm;

const ALL: [Measurement; 8] = [
    Measurement::Pose,
    Measurement::Position,
    Measurement::Orientation,
    Measurement::Distance(Bar::Measured),
    Measurement::Distance(Bar::Offset),
    Measurement::Distance(Bar::Fixed),
    Measurement::Distance(Bar::FixedUnknown),
    Measurement::Plane,
];

fn kinds(arm: &Arm) -> [usize; 2] {
    let turns = arm.moving.iter().filter(|a| a.turns).count();
    [turns, arm.moving.len() - turns]
}

/// 4R + 2P + 6, and its like: the null vectors of the structure annihilate, and nothing else does.
#[test]
fn all_arms_of_the_catalogue() {
    let arms = arms();
    assert!(arms.len() > 80, "{}", arms.len());
    for arm in &arms {
        let [turns, slides] = kinds(arm);
        let v = visible(&problem(arm, Measurement::Pose, POINT, false));
        let wanted = formula(Measurement::Pose, turns, slides);
        assert_eq!((v.kept.len(), v.rank, v.found()), (wanted, wanted, 0), "{}", arm.name);
        assert_eq!(v.null.len(), 2 * turns + 4 * slides, "{}", arm.name);
        assert!(v.annihilates < 1e-12, "{}: {}", arm.name, v.annihilates);
        assert!(v.gap[0] > 1e-5, "{}: {:?}", arm.name, v.gap);
    }
}

/// The numbers of other measurements; what comes with the lengths of one arm alone is found in numbers.
#[test]
fn other_measurements() {
    for name in ["ur5", "staubli-rx90", "puma560", "franka-panda", "kuka-iiwa-7", "scara", "stanford"] {
        let arm = crate::made::arm(name);
        let [turns, slides] = kinds(&arm);
        for measurement in ALL {
            let v = visible(&problem(&arm, measurement, POINT, false));
            // All axes of a SCARA are parallel: lengths across them scaled are a plane that is tilted.
            let found = usize::from(name == "scara" && measurement == Measurement::Plane);
            let wanted = formula(measurement, turns, slides) - found;
            assert!(v.annihilates < 1e-12, "{name} {measurement:?}: {}", v.annihilates);
            assert_eq!(
                (v.kept.len(), v.rank, v.found()),
                (wanted, wanted, found),
                "{name} {measurement:?} {:?}",
                v.gap
            );
        }
    }
}

/// Several planes, or centres: each is where it is, and the arm is seen as with one; a plane that stands across them all does not
/// say how large it is either.
#[test]
fn several_planes_and_centres() {
    for (measurement, each) in [(Measurement::Plane, 3), (Measurement::Distance(Bar::Measured), 3)] {
        let arm = crate::made::arm("staubli-rx90");
        let fixtures = supposed(&arm, measurement, POINT, 3);
        let problem = Problem::new(&arm, measurement, POINT, false, fixtures);
        let v = visible(&problem);
        let wanted = formula(measurement, 6, 0) + 2 * each;
        assert_eq!((v.kept.len(), v.rank, v.found()), (wanted, wanted, 0), "{measurement:?}: {:?}", v.gap);
        assert!(v.annihilates < 1e-12);
    }
}

/// The table of the study: a point on the last axis shows two numbers less; gains are seen.
#[test]
fn points_on_the_axis_and_gains() {
    // Arm, position of a point off and on the last axis, gains beside a full pose.
    for (name, off, on, gains) in [
        ("ur5", 27, 25, 6),
        ("staubli-rx90", 27, 25, 6),
        ("franka-panda", 31, 29, 7),
        ("kuka-iiwa-7", 31, 29, 7),
        ("scara", 17, 15, 4),
        ("stanford", 25, 23, 6),
    ] {
        let arm = crate::made::arm(name);
        let seen = |m, point, gains| visible(&problem(&arm, m, point, gains)).kept.len();
        // Along z of the last axis from where it is crossed: the tool's own frame is turned against it in the catalogue at most by
        // a constant, which the tests of one arm take away.
        let axis = on_last_axis(&arm);
        assert_eq!(seen(Measurement::Position, POINT, false), off, "{name}");
        assert_eq!(seen(Measurement::Position, axis, false), on, "{name}");
        let [turns, slides] = kinds(&arm);
        let pose = formula(Measurement::Pose, turns, slides);
        assert_eq!(seen(Measurement::Pose, POINT, true), pose + gains, "{name}");
    }
}

/// A point of the tool on the last axis that moves.
fn on_last_axis(arm: &Arm) -> Vector<f64> {
    let last = arm.constants[arm.constants.len() - 1];
    last.inverse().act_on_point(Vector([0.0, 0.0, 0.137]))
}

#[test]
fn a_point_that_stays_is_known_for_it() {
    let arm = crate::made::arm("ur5");
    let v = visible(&problem(&arm, Measurement::Position, on_last_axis(&arm), false));
    assert_eq!(v.null.iter().filter(|n| matches!(n.cause, Cause::OnAxis(_))).count(), 2);
    assert_eq!(v.found(), 0);
}

/// What of the tables is told apart, and how many tilts of parallel axes no cell has.
#[test]
fn cells_of_tables() {
    // Arm, cells, told apart, with base and tool, all that is seen.
    for (name, cells, alone, with_frames, all) in [
        ("ur5", 24, 22, 28, 30),
        ("staubli-rx90", 24, 23, 29, 30),
        ("puma560", 24, 23, 29, 30),
        ("franka-panda", 32, 30, 34, 34),
        ("kuka-iiwa-7", 28, 28, 34, 34),
        ("scara", 16, 11, 17, 20),
        ("stanford", 24, 21, 27, 28),
    ] {
        let description = catalogue::robot(name).expect("it is there").filled();
        let arm = crate::made::arm(name);
        let problem = problem(&arm, Measurement::Pose, POINT, false);
        let v = visible(&problem);
        let seen = table_seen(&description, &problem, &v).expect("numbers");
        assert_eq!(
            (seen.cells, seen.cells - seen.tied.len(), v.kept.len() - seen.lacking, v.kept.len()),
            (cells, alone, with_frames, all),
            "{name}"
        );
    }
}

#[test]
fn lengths_along_parallel_axes_are_seen_as_a_sum() {
    let description = catalogue::robot("ur5").expect("it is there").filled();
    let arm = crate::made::arm("ur5");
    let problem = problem(&arm, Measurement::Pose, POINT, false);
    let seen = table_seen(&description, &problem, &visible(&problem)).expect("numbers");
    let said: Vec<String> =
        seen.tied.iter().map(|t| denavit_calibration::words::tied(t, &description)).collect();
    assert_eq!(
        said,
        [
            "d2 and d3: the axes of rows 2 and 3 are parallel, only the sum is seen",
            "d2 and d4: the axes of rows 2 and 4 are parallel, only the sum is seen",
        ]
    );
}

/// The derivatives are those of the model, by central differences, away from the table.
#[test]
fn derivatives() {
    let mut dice = crate::made::Dice::new(4);
    for name in ["ur5", "stanford", "scara", "franka-panda"] {
        let arm = crate::made::arm(name);
        for measurement in ALL {
            let problem = problem(&arm, measurement, POINT, true);
            let mut state = problem.nominal();
            state.x.iter_mut().for_each(|x| *x += dice.normal(0.05));
            let q = &problem.samples(3, 8)[1];
            let constants = problem.constants_at(&state);
            let (hand, rows) = problem.derivatives(&state, &constants, q, 0);
            let reading = denavit_calibration::Reading {
                turn: hand.rotation,
                at: hand.translation,
                distance: state.fixtures.first().map_or(0.0, |f| f.reading(measurement, hand.translation)),
                group: 0,
            };
            let count = problem.parameters().len();
            for p in 0..count {
                let h = 1e-5;
                let at = |by: f64| {
                    let mut step = vec![0.0; count];
                    step[p] = by;
                    let moved = problem.stepped(&state, &step);
                    problem.residual(&moved, &problem.constants_at(&moved), q, &reading)
                };
                let (up, down) = (at(h), at(-h));
                for (i, row) in rows.iter().enumerate() {
                    let slope = -(up[i] - down[i]) / (2.0 * h);
                    assert!(
                        (slope - row[p]).abs() < 1e-7 * (1.0 + slope.abs()),
                        "{name} {measurement:?} {p} {i}: {slope} {}",
                        row[p]
                    );
                }
            }
        }
    }
}
