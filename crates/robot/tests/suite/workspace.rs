//! Sections of workspaces: radii, heights and areas against closed forms and dense samples; every cell is really reached,
//! within the limits; the same call gives the same bits.

use crate::common::{Random, robot};
use denavit::description::{Description, read_toml};
use denavit::inverse::JointSpace;
use denavit::workspace::{NoWorkspace, Section, Workspace};
use denavit::{Robot, catalogue};
use denavit_symbolic::Rational;
use std::f64::consts::PI;

struct Case {
    robot: Robot<f64>,
    space: JointSpace,
}

impl Case {
    fn of(mut description: Description) -> Self {
        // Robots given with symbols only get lengths that are not special.
        let mut next = 31;
        for p in description.parameters.iter_mut().filter(|p| p.value.is_none()) {
            p.value = Some(Rational::new(next, 100).into());
            next += 7;
        }
        let robot = Robot::numeric(&description).expect("all parameters have values");
        let space = JointSpace::new(&description, &robot);
        Case { robot, space }
    }

    fn named(name: &str) -> Self {
        Case::of(robot(name))
    }

    fn text(text: &str) -> Self {
        Case::of(read_toml(text).unwrap_or_else(|e| panic!("{e:?}")).0)
    }

    fn workspace(&self) -> Workspace {
        Workspace::new(&self.robot, &self.space).expect("a workspace")
    }
}

/// A planar arm of two links with these limits of the first joint.
fn planar(l1: f64, l2: f64, limits: &str) -> Case {
    Case::text(&format!(
        "name = \"2R\"\nconvention = \"standard\"\n[[joints]]\ntheta = \"q1\"\na = \"{l1} m\"\n{limits}\n[[joints]]\ntheta = \"q2\"\na = \"{l2} m\"\n"
    ))
}

#[track_caller]
fn near(x: f64, wanted: f64, by: f64) {
    assert!((x - wanted).abs() <= by, "{x} is not {wanted} within {by}");
}

#[test]
fn a_planar_arm_reaches_an_annulus() {
    for (l1, l2) in [(1.0, 0.6), (0.4, 0.9), (0.5, 0.5)] {
        let w = planar(l1, l2, "").workspace();
        assert!(matches!(w.section, Section::Plane { .. }));
        assert_eq!(w.section.symbols(), ["x", "y"]);
        let (inner, outer) = (f64::abs(l1 - l2), l1 + l2);
        for reached in [w.extremes.first, w.extremes.second] {
            near(reached[0], -outer, 1e-9);
            near(reached[1], outer, 1e-9);
        }
        near(w.extremes.from_shoulder.expect("a shoulder"), outer, 1e-9);
        near(w.area(), PI * (outer * outer - inner * inner), 2e-3 * outer * outer);
        let radius = |cell: usize| w.grid.centre(cell).map(|c| c * c).iter().sum::<f64>().sqrt();
        for (cell, value) in w.manipulability.iter().enumerate() {
            let inside = radius(cell) < outer - w.grid.side && radius(cell) > inner + w.grid.side;
            let outside = radius(cell) > outer + w.grid.side || radius(cell) < inner - w.grid.side;
            assert!(!(inside && value.is_none()), "a cell at {:?} is missing", w.grid.centre(cell));
            assert!(!(outside && value.is_some()), "a cell at {:?} is too much", w.grid.centre(cell));
        }
        // √det(J Jᵀ) = l1·l2·|sin q2|
        near(w.largest_manipulability, l1 * l2, 1e-3 * l1 * l2);
        let holes = w.boundary.iter().filter(|l| denavit::workspace::area(l) < 0.0).count();
        assert_eq!(holes, usize::from(inner > 0.0));
    }
}

#[test]
fn limits_of_the_first_joint_leave_a_part_of_the_annulus() {
    // The second joint is unlimited: all discs of radius 0.2 around the half circle of radius 1.
    let case = planar(1.0, 0.2, "limits = [\"0 deg\", \"180 deg\"]");
    let w = case.workspace();
    near(w.extremes.second[1], 1.2, 1e-9);
    near(w.extremes.second[0], -0.2, 1e-9);
    // Half an annulus, and half a disc at both ends.
    near(w.area(), 0.5 * PI * (1.44 - 0.64) + PI * 0.04, 5e-3);
}

#[test]
fn a_scara_reaches_a_tube() {
    let w = Case::named("scara").workspace();
    assert_eq!(w.section.symbols(), ["ρ", "z"]);
    // a1 = 0.4, a2 = 0.3; d4 = 0.1 below; the slide's assumed travel is the sum of the lengths, 0.8.
    near(w.extremes.first[0], 0.1, 1e-6);
    near(w.extremes.first[1], 0.7, 1e-9);
    near(w.extremes.second[0], -0.9, 1e-9);
    near(w.extremes.second[1], -0.1, 1e-9);
    near(w.area(), 0.6 * 0.8, 1e-3);
    assert_eq!(w.assumed.len(), 1);
    assert!(w.held.is_empty());
}

#[test]
fn a_spherical_arm_reaches_a_ball_without_its_core() {
    // d2 = 0.2 across, the slide up to 0.5: ρ² + z² = d2² + q3², and ρ ≥ d2.
    let mut case = Case::named("spherical-rrp");
    case.space.limits[2] = Some([0.0, 0.5]);
    let w = case.workspace();
    let outer = f64::hypot(0.2, 0.5);
    near(w.extremes.from_shoulder.expect("axes 1 and 2 meet"), outer, 1e-9);
    near(w.extremes.first[0], 0.2, 1e-6);
    near(w.extremes.first[1], outer, 1e-9);
    near(w.extremes.second[1], 0.5, 1e-9);
    // The segment of the disc beyond the chord ρ = d2.
    let angle = 2.0 * (0.2 / outer).acos();
    near(w.area(), 0.5 * outer * outer * (angle - angle.sin()), 2e-3);
}

#[test]
fn slides_alone_reach_a_box_and_slides_across_are_held() {
    let w = Case::named("cartesian-ppp").workspace();
    assert!(matches!(w.section, Section::Projection { .. }));
    assert_eq!(w.section.symbols(), ["x", "z"]);
    assert_eq!(w.assumed.len(), 3);
    near(w.area(), 1.0, 5e-3);
    let on_rail = Case::named("rail-puma").workspace();
    assert!(matches!(on_rail.section, Section::ThroughAxis { joint: 1, .. }));
    assert_eq!(on_rail.held.iter().map(|h| h.joint).collect::<Vec<_>>(), [0]);
}

#[test]
fn the_reach_of_a_puma_is_that_of_a_dense_sample() {
    let case = Case::named("puma560");
    let w = case.workspace();
    let shoulder = w.extremes.shoulder.expect("axes 1 and 2 meet");
    let mut random = Random(7);
    let (mut far, mut out, mut up) = (0.0_f64, 0.0_f64, f64::MIN);
    for _ in 0..400_000 {
        let limits = case.space.limits.iter().map(|l| l.expect("all joints have limits"));
        let q: Vec<f64> = limits.map(|[l, h]| l + (h - l) * random.unit()).collect();
        let p = case.robot.pose(&q).translation;
        far = far.max((p - shoulder).norm());
        out = out.max(p[0].hypot(p[1]));
        up = up.max(p[2]);
    }
    let reach = w.extremes.from_shoulder.expect("a shoulder");
    for (found, sampled) in [(reach, far), (w.extremes.first[1], out), (w.extremes.second[1], up)] {
        assert!(found >= sampled - 1e-9, "a sample at {sampled} is beyond {found}");
        assert!(found <= sampled + 0.01, "no sample comes near {found}, only to {sampled}");
    }
}

#[test]
fn every_cell_is_reached_within_the_limits() {
    for name in
        ["puma560", "franka-panda", "cylindrical-wrist", "smart5-six-rail", "planar-3r", "gantry-wrist"]
    {
        let case = Case::named(name);
        let w = case.workspace();
        let mut count = 0;
        for (cell, value) in w.manipulability.iter().enumerate() {
            assert_eq!(w.configuration(cell).is_some(), value.is_some());
            let (Some(q), Some(value)) = (w.configuration(cell), value) else { continue };
            count += 1;
            assert!((0.0..=1.0).contains(value));
            let at = w.section.coordinates(case.robot.pose(q).translation);
            let centre = w.grid.centre(cell);
            for k in 0..2 {
                // The robot's own product of transforms rounds otherwise.
                assert!(
                    (at[k] - centre[k]).abs() <= w.grid.side * (0.5 + 1e-9),
                    "{name}: {at:?} not in {centre:?}"
                );
            }
            for (j, &x) in q.iter().enumerate() {
                let assumed = w.assumed.iter().chain(&w.held).filter(|a| a.joint == j).map(|a| a.range);
                for [low, high] in case.space.limits[j].into_iter().chain(assumed) {
                    assert!((low..=high).contains(&x), "{name}: joint {j} at {x}");
                }
            }
        }
        assert!(count > 1000, "{name}: {count} cells");
    }
}

#[test]
fn every_robot_of_the_catalogue_has_a_workspace_within_its_reach() {
    for name in catalogue::names().into_iter().step_by(5_usize.div_ceil(crate::common::share(5, 1))) {
        let case = Case::named(name);
        let w = case.workspace();
        assert!(w.extremes.first[0] <= w.extremes.first[1], "{name}");
        assert!(!w.boundary.is_empty(), "{name}");
        let travel: f64 = w.assumed.iter().map(|a| a.range[1].abs()).sum();
        let given: f64 = case
            .space
            .limits
            .iter()
            .zip(&case.space.is_angle)
            .filter(|l| !l.1)
            .filter_map(|l| l.0.map(|[low, high]| low.abs().max(high.abs())))
            .sum();
        let reach = case.robot.reach() + travel + given + 1e-9;
        for x in [w.extremes.first, w.extremes.second].as_flattened() {
            assert!(x.abs() <= reach, "{name}: {x} is beyond {reach}");
        }
    }
}

#[test]
fn the_same_call_gives_the_same_bits() {
    let case = Case::named("staubli-tx60");
    assert_eq!(case.workspace(), case.workspace());
}

#[test]
fn where_nothing_moves_there_is_no_workspace() {
    let turning = "name = \"R\"\nconvention = \"standard\"\n[[joints]]\ntheta = \"q1\"\nd = \"1 m\"\n";
    let case = Case::text(turning);
    assert_eq!(Workspace::new(&case.robot, &case.space), Err(NoWorkspace::NothingMoves));
    let mut case = planar(1.0, 0.5, "");
    case.space.limits[0] = Some([0.0, f64::INFINITY]);
    assert_eq!(Workspace::new(&case.robot, &case.space), Err(NoWorkspace::NotFinite));
}
