//! Motions planned from what is asked and what is known of limits.

use denavit::motion::MotionError;
use denavit::motion::hand::{Line, Orientation};
use denavit::motion::plan::{Course, KnownLimits, PlanError, PlanOptions, Planned, Verdict, Wish};
use denavit::motion::profile::Law;
use denavit::{Description, Robot, catalogue};

fn ur5() -> (Description, Robot<f64>) {
    let d = catalogue::robot("ur5").expect("it is in the catalogue");
    let robot = Robot::numeric(&d).expect("all parameters have values");
    (d, robot)
}

fn of_joints(points: &[[f64; 6]], limits: &KnownLimits, options: &PlanOptions) -> Result<Planned, PlanError> {
    let (d, robot) = ur5();
    let points = points.iter().map(|p| p.to_vec()).collect();
    Planned::new(&d, &robot, Wish::Joints(points), limits, options)
}

const MOVE: [[f64; 6]; 2] = [[0.0; 6], [1.0; 6]];

fn all(x: f64) -> Option<Vec<f64>> {
    Some(vec![x; 6])
}

#[test]
fn more_knowledge_times_better() {
    let mut limits = KnownLimits::default();
    let usual = PlanOptions::default();
    let found = of_joints(&MOVE, &limits, &usual).expect("no limits are needed");
    assert!(found.trajectory.duration() == 1.0 && found.verdict() == Verdict::Whole);
    // A quintic law is 15/8 as fast in its middle as on the average.
    limits.velocity = all(1.5);
    let found = of_joints(&MOVE, &limits, &usual).expect("slower");
    assert!((found.trajectory.duration() - 1.25).abs() < 1e-6);
    // 1 rad at 1.5 rad/s, and 1.5/4 s to gain that speed.
    limits.acceleration = all(4.0);
    let found = of_joints(&MOVE, &limits, &usual).expect("by a trapezoidal law");
    assert!((found.trajectory.duration() - (1.0 / 1.5 + 1.5 / 4.0)).abs() < 1e-9, "{:?}", found.timing);
    limits.jerk = all(100.0);
    let slower = of_joints(&MOVE, &limits, &usual).expect("with limited jerk").trajectory.duration();
    assert!(slower > found.trajectory.duration());
    let spline = of_joints(&[[0.0; 6], [0.5; 6], [0.2; 6]], &limits, &usual).expect("a spline");
    assert_eq!(spline.course, Course::Spline(3));
}

#[test]
fn refusals_are_typed() {
    let (nothing, usual) = (KnownLimits::default(), PlanOptions::default());
    let refusal = |limits: &KnownLimits, options: &PlanOptions| match of_joints(&MOVE, limits, options) {
        Ok(found) => panic!("{:?}", found.timing),
        Err(why) => why,
    };
    let jerk = KnownLimits { jerk: all(1.0), ..KnownLimits::default() };
    assert_eq!(refusal(&jerk, &usual), PlanError::NeededForJerk);
    let law = PlanOptions { law: Some(Law::Cubic), ..usual };
    assert_eq!(refusal(&nothing, &law), PlanError::NeededForLaw);
    let short = KnownLimits { velocity: Some(vec![1.0; 5]), ..KnownLimits::default() };
    assert!(matches!(refusal(&short, &usual), PlanError::Limits(MotionError::Joints { found: 5, .. })));
    let never = PlanOptions { duration: Some(-1.0), ..usual };
    assert!(matches!(refusal(&nothing, &never), PlanError::Motion(MotionError::NotPositive(..))));
    let quick = PlanOptions { duration: Some(0.125), ..usual };
    let slow = KnownLimits { velocity: all(1.5), ..KnownLimits::default() };
    let PlanError::TooFast { needed, .. } = refusal(&slow, &quick) else { panic!("it is too fast") };
    assert!((needed - 1.25).abs() < 1e-6);
    let both = KnownLimits { acceleration: all(4.0), ..slow };
    assert!(matches!(refusal(&both, &quick), PlanError::TooShort { .. }));
    let far = of_joints(&[[0.0; 6], [99.0; 6]], &nothing, &usual).err();
    assert!(matches!(far, Some(PlanError::OutsideLimits { joint }) if joint == "q1"));
}

#[test]
fn a_line_ends_where_the_arm_does() {
    let (d, robot) = ur5();
    let q = [0.1, -1.2, 1.5, 0.2, 0.9, 0.3];
    let from = robot.pose(&q);
    let line = |by: f64| {
        let mut to = from;
        to.translation.0[0] += by;
        Box::new(Line { from, to, orientation: Orientation::Slerp })
    };
    let wish = |by: f64, start: Option<Vec<f64>>| Wish::Hand { path: line(by), start };
    let (limits, usual) = (KnownLimits::of(&d), PlanOptions::default());
    let plan = |w: Wish| Planned::new(&d, &robot, w, &limits, &usual);
    let found = plan(wish(-0.05, Some(q.to_vec()))).expect("it is short");
    assert!(found.verdict() == Verdict::Whole && found.alternatives.is_empty());
    let found = plan(wish(-0.05, None)).expect("some branch goes there");
    assert!(found.verdict() == Verdict::Whole && found.alternatives.len() > 1);
    let found = plan(wish(5.0, Some(q.to_vec()))).expect("it begins");
    assert!(matches!(found.verdict(), Verdict::Ends(reached) if reached > 0.0 && reached < 0.5));
}
