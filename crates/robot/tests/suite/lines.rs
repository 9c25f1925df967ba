//! Tables out of axes at rest.

use crate::common::Random;
use denavit::catalogue;
use denavit::description::{
    Agreement, AxisAtRest, ChainAtRest, Convention, Description, JointKind, NotPlaced, Placed, Sameness,
    prove_same_chain, same_mechanism,
};
use denavit::geometry::{Rotation, Transform, Vector};
use denavit::robot::Robot;
use denavit_symbolic::{Angle, Expr, Rational};

/// The robot with numbers for its parameters.
fn in_numbers(d: &Description) -> Description {
    d.filled().in_numbers()
}

fn cells(d: &Description) -> Vec<[Expr; 4]> {
    d.rows.iter().map(|r| [r.theta, r.d, r.a, r.alpha].map(|e| Angle::of(e).to_expr())).collect()
}

fn number(e: Expr) -> f64 {
    e.eval(|_| None).unwrap()
}

#[test]
fn the_table_of_every_catalogue_arm_comes_out_of_its_own_axes() {
    let (mut to_the_letter, mut up_to_normals, mut exactly) = (0, 0, 0);
    for name in catalogue::names() {
        let d = in_numbers(&catalogue::robot(name).unwrap());
        let (again, agreement) = d.at_rest().description(name, d.convention).unwrap();
        // Its tool stands beside the last axis by the cosine of 0.0427 rad, which no decimal is.
        let is_rounded = name == "al5d";
        exactly += usize::from(agreement == Agreement::Proved);
        match agreement {
            Agreement::Proved | Agreement::Within(..1e-50) => assert!(!is_rounded),
            Agreement::Within(by) => assert!(is_rounded && by < 1e-17, "{name}: {by}"),
        }
        assert!(is_rounded || prove_same_chain(&d, &again).is_equal(), "{name}: the chain is another");
        let is_same = cells(&d) == cells(&again);
        // Of coupled joints it is not decided, and none is needed.
        let turned = is_same || matches!(same_mechanism(&d, &again), Sameness::Same(_));
        assert!(turned || name == "parallelogram-5r", "{name} is not the same up to normals");
        (to_the_letter, up_to_normals) =
            (to_the_letter + usize::from(is_same), up_to_normals + usize::from(turned));
    }
    // The others have x of the first or last frame elsewhere, or a tool in their last row.
    assert!(to_the_letter >= 42 && up_to_normals >= 97, "{to_the_letter}, {up_to_normals}");
    assert!(exactly >= 94, "{exactly} in numbers that are exact");
}

/// The rows as a person compares them: without θ and d of the first, in which the base has a part.
fn inner(placed: &Placed) -> Vec<[Expr; 4]> {
    let mut all: Vec<[Expr; 4]> = placed.rows.iter().map(|r| [r.theta, r.d, r.a, r.alpha]).collect();
    (all[0][0], all[0][1]) = (Expr::int(0), Expr::int(0));
    all.pop();
    all
}

#[test]
fn a_table_does_not_depend_on_how_its_axes_are_given() {
    let mut random = Random(20);
    for name in ["ur5", "franka-panda", "puma560", "stanford", "kuka-kr5-arc", "adept-one", "gantry-wrist"] {
        let d = in_numbers(&catalogue::robot(name).unwrap());
        let chain = d.at_rest();
        let plain = chain.rows().unwrap();
        let decimal =
            |random: &mut Random| Expr::from(Rational::new((random.unit() * 2000.0) as i64 - 1000, 1000));
        // Points moved along their axes, directions of any length: the very same.
        let mut other = chain.clone();
        for axis in &mut other.axes {
            axis.point = axis.point + axis.direction.scale(decimal(&mut random));
            axis.direction = axis.direction.scale(Expr::from(Rational::new(7, 3)));
        }
        let rows = other.rows().unwrap();
        assert_eq!(
            format!("{:?}", (&plain.rows, plain.base)),
            format!("{:?}", (&rows.rows, rows.base)),
            "{name}"
        );
        // The base moved, and turned in ways that leave numbers exact: the same rows. Of slides first it is the base that says
        // from where they count.
        if chain.axes[0].kind == JointKind::Prismatic {
            continue;
        }
        let quarter = |n: i64| Expr::pi() * Expr::from(Rational::new(n, 12));
        let to = Transform::translation(decimal(&mut random), decimal(&mut random), decimal(&mut random))
            * Transform::rotation_z(quarter(2))
            * Transform::rotation_x(quarter(3))
            * Transform::rotation_z(quarter(9));
        let mut moved = chain.clone();
        for axis in &mut moved.axes {
            (axis.point, axis.direction) = (to.act_on_point(axis.point), to.act_on_vector(axis.direction));
        }
        moved.tip = to * moved.tip;
        moved.beside = to.rotation * moved.beside;
        assert_eq!(inner(&moved.rows().unwrap()), inner(&plain), "{name} moved");
    }
}

#[test]
fn a_chain_from_the_tip_back_is_the_inverse() {
    for name in ["ur5", "franka-panda", "stanford", "kinova-mico", "cylindrical-rpp", "scara"] {
        let Some(d) = catalogue::robot(name).map(|d| in_numbers(&d)) else { continue };
        let chain = d.at_rest();
        let back = chain.reversed();
        let n = chain.axes.len();
        let (forward, _) = chain.description("there", Convention::Standard).unwrap();
        let (backward, agreement) = back.description("back", Convention::Craig).unwrap();
        assert!(matches!(agreement, Agreement::Proved | Agreement::Within(..1e-17)), "{name}: {agreement:?}");
        let q: Vec<f64> = (0..n).map(|i| 0.3 + 0.2 * i as f64).collect();
        let reversed: Vec<f64> = q.iter().rev().copied().collect();
        let there = Robot::numeric(&forward).unwrap().pose(&q);
        let back = Robot::numeric(&backward).unwrap().pose(&reversed);
        let product = (there * back).matrix();
        let one = Transform::<f64>::identity().matrix();
        for k in 0..16 {
            assert!((product[k / 4][k % 4] - one[k / 4][k % 4]).abs() < 1e-13, "{name}");
        }
    }
}

#[test]
fn axes_that_are_nearly_parallel_have_no_normal_far_away() {
    for exponent in 1..=12 {
        for pair in 0..5 {
            let beta =
                Rational::from_decimal(&format!("{}e-{}", if exponent == 1 { "0.1" } else { "1" }, exponent))
                    .unwrap();
            // Six axes upright side by side, all behind one pair tilted by β about a slanting direction.
            let mut frame = Transform::<Expr>::identity();
            let mut axes = vec![];
            for k in 0..6 {
                axes.push(AxisAtRest {
                    kind: JointKind::Revolute,
                    point: frame.translation,
                    direction: frame.rotation.z(),
                    moves: vec![(k, Rational::ONE)],
                });
                let length = |n: i64| Expr::from(Rational::new(n, 1000));
                frame = frame * Transform::translation(length(200 + 10 * k as i64), length(70), length(30));
                if k == pair {
                    frame = frame
                        * Transform::rotation_x(Expr::from(beta.clone()))
                        * Transform::rotation_y(Expr::from(beta.clone()));
                }
            }
            let chain = ChainAtRest { axes, tip: frame, beside: Rotation::identity() };
            let (d, agreement) = chain.description("tilted", Convention::Standard).unwrap();
            assert!(
                matches!(agreement, Agreement::Within(..1e-16)),
                "β = 1e-{exponent}, pair {pair}: {agreement:?}"
            );
            let farthest = d
                .rows
                .iter()
                .map(|r| number(r.d.substitute(|_| Some(Expr::int(0)))).abs())
                .fold(0.0, f64::max);
            assert!(farthest < 1000.0 * 1.5, "β = 1e-{exponent}: d = {farthest}");
            // The pose by plain transforms, in which nothing is far away.
            let b = beta.to_f64();
            let q = [0.3, -0.4, 0.5, -0.6, 0.7, 0.8];
            let mut pose = Transform::<f64>::identity();
            for (k, q) in q.iter().enumerate() {
                pose = pose
                    * Transform::rotation_z(*q)
                    * Transform::translation(0.2 + 0.01 * k as f64, 0.07, 0.03);
                if k == pair {
                    pose = pose * Transform::rotation_x(b) * Transform::rotation_y(b);
                }
            }
            let found = Robot::numeric(&d).unwrap().pose(&q).matrix();
            for (k, x) in pose.matrix().concat().into_iter().enumerate() {
                assert!((found[k / 4][k % 4] - x).abs() < 1e-12, "β = 1e-{exponent}, pair {pair}");
            }
        }
    }
}

#[test]
fn an_axis_without_direction_is_named() {
    let chain = ChainAtRest {
        axes: vec![AxisAtRest {
            kind: JointKind::Revolute,
            point: Vector::zero(),
            direction: Vector::zero(),
            moves: vec![(0, Rational::ONE)],
        }],
        tip: Transform::identity(),
        beside: Rotation::identity(),
    };
    assert_eq!(chain.rows().unwrap_err(), NotPlaced::NoDirection(0));
}

#[test]
fn a_chain_turned_round_twice_has_the_same_table() {
    for name in ["ur5", "puma560", "staubli-rx90", "kinova-mico", "stanford", "scara", "kuka-kr5-arc"] {
        let chain = in_numbers(&catalogue::robot(name).unwrap()).at_rest();
        let (once, twice) = (chain.rows().unwrap(), chain.reversed().reversed().rows().unwrap());
        let table = |p: &Placed| p.rows.iter().map(|r| [r.theta, r.d, r.a, r.alpha]).collect::<Vec<_>>();
        assert_eq!(table(&once), table(&twice), "{name}");
        assert_eq!((once.base, once.tool), (twice.base, twice.tool), "{name}");
    }
}
