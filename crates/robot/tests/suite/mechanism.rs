//! The moving axes with the constants between them, and the chain they come from.

use crate::common::Random;
use denavit::description::{Convention, JointKind, read_toml};
use denavit::geometry::Transform;
use denavit::mechanism::{Comparison, Lengths, MovingAxes, MovingAxis, compare};
use denavit::{Robot, catalogue};
use denavit_symbolic::{Expr, Rational};

/// Turns and slides with constants beside them, a row that does both, a constant row, and a coupling.
const MIXED: &str = r#"
    name = "Mixed"
    convention = "craig"
    base = { xyz = ["0.1 m", "0", "0.2 m"], rpy = ["0", "30 deg", "10 deg"] }
    tool = { xyz = ["0", "0.3 m", "0.1 m"], rpy = ["20 deg", "0", "0"] }
    joints = [
        { theta = "q1 + 120 deg", d = "0.3 m", alpha = "20 deg", a = "0.1 m" },
        { theta = "40 deg", d = "q2 + 0.2 m", alpha = "-90 deg" },
        { theta = "25 deg", d = "0.1 m", alpha = "70 deg", a = "0.2 m" },
        { theta = "q3 - q1 - 90 deg", d = "0.5*q2 + 0.1 m", alpha = "90 deg" },
    ]
"#;

#[test]
fn axes_and_constants_multiply_to_the_pose() {
    let texts = catalogue::names().into_iter().filter_map(catalogue::text).chain([MIXED]);
    for text in texts {
        let (description, _) = read_toml(text).unwrap_or_else(|e| panic!("{e:?}"));
        let robot = Robot::numeric(&description.filled()).unwrap();
        let mut random = Random(5);
        let q: Vec<f64> = (0..robot.joints).map(|_| 4.0 * random.unit() - 2.0).collect();
        for lengths in [Lengths::Before, Lengths::Behind] {
            let MovingAxes { moving, constants } = MovingAxes::new(&robot, lengths);
            let moved = |axis: &MovingAxis<f64>| {
                let by = axis.value.terms.iter().map(|&(j, k)| k * q[j]).sum::<f64>() + axis.value.constant();
                match axis.kind {
                    JointKind::Revolute => Transform::rotation_z(by),
                    JointKind::Prismatic => Transform::translation_z(by),
                }
            };
            let product =
                moving.iter().zip(&constants[1..]).fold(constants[0], |x, (a, c)| x * moved(a) * *c);
            let gap = robot.pose(&q).inverse() * product;
            let off = gap
                .matrix()
                .as_flattened()
                .iter()
                .zip(Transform::identity().matrix().as_flattened())
                .map(|(x, y)| (x - y).abs())
                .fold(0.0, f64::max);
            assert!(off < 1e-12 * robot.reach().max(1.0), "{}: {off}", description.name);
        }
    }
}

/// Another way to write the same arm is proved to be it; what is off by a millimetre or turned round is not.
#[test]
fn descriptions_are_compared() {
    let ur5 = catalogue::robot("ur5").unwrap();
    assert_eq!(compare(&ur5, &ur5.converted(Convention::Craig).description), Comparison::Proved);
    assert_eq!(compare(&ur5, &ur5.in_numbers()), Comparison::Proved);
    let mut longer = ur5.in_numbers();
    longer.tool = longer.tool * Transform::translation_z(Expr::from(Rational::new(1, 1000)));
    let Comparison::Sampled(by) = compare(&ur5, &longer) else { panic!("a longer tool is another arm") };
    assert!((0.9e-3..=1e-3).contains(&by), "{by:e}");
    assert_eq!(compare(&ur5, &catalogue::robot("stanford").unwrap()), Comparison::OtherJoints);
    let open = catalogue::robot("prrrrp").unwrap();
    let mut other = open.clone();
    other.tool = other.tool * Transform::translation_z(Expr::int(1));
    assert_eq!(compare(&open, &open.converted(Convention::Standard).description), Comparison::Proved);
    assert!(matches!(compare(&open, &other), Comparison::NoNumbers(_)));
}
