//! Arms and poses with known numbers of configurations, singular poses, and arms that are refused.

mod arms;

use arms::{Draws, manseur_doty, puma560, solve, standard, ur10e};
use denavit_elimination::{Answer, Certificate, Joint, Plan, Rigid, Unsuitable};

/// Manseur and Doty (1989), the pose as Manocha and Canny (1994) print it: sixteen real configurations.
#[test]
fn sixteen_solutions() {
    let arm = manseur_doty();
    let plan = Plan::new(&arm).unwrap();
    let pose = Rigid {
        rotation: orthogonal([
            [-0.760117, -0.641689, 0.102262],
            [0.133333, 0.0, 0.991071],
            [-0.635959, 0.766965, 0.085558],
        ]),
        translation: [-1.140175, 0.0, 0.0],
    };
    let mut answer = Answer::default();
    solve(&plan, &pose, &mut answer);
    assert_eq!(answer.solutions.len(), 16);
    assert_eq!(answer.certificate, Certificate::Complete);
    for solution in &answer.solutions {
        assert!(solution.residual < 1e-12);
        let exact = arm.smallest_singular_value(&solution.q);
        assert!((solution.singular / exact - 1.0).abs() < 0.1, "{} {exact}", solution.singular);
    }
}

/// Printed rotations have six digits: the nearest orthogonal one, by `R ← (3 R − R Rᵀ R) / 2`.
fn orthogonal(mut r: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    for _ in 0..20 {
        let mut next = [[0.0; 3]; 3];
        for i in 0..3 {
            for k in 0..3 {
                let mut cubic = 0.0;
                for a in 0..3 {
                    for b in 0..3 {
                        cubic += r[i][a] * r[b][a] * r[b][k];
                    }
                }
                next[i][k] = 1.5 * r[i][k] - 0.5 * cubic;
            }
        }
        r = next;
    }
    r
}

/// The wrist of a PUMA straight: joints 4 and 6 turn against each other. The answer has members of the family, and does
/// not claim to be complete.
#[test]
fn straight_wrist() {
    let arm = puma560();
    let plan = Plan::new(&arm).unwrap();
    let mut answer = Answer::default();
    let mut draws = Draws(3);
    for _ in 0..200 {
        let mut q = draws.configuration(&arm);
        q[4] = 0.0;
        solve(&plan, &arm.pose(&q), &mut answer);
        assert_ne!(answer.certificate, Certificate::Complete);
        assert!(answer.solutions.iter().any(|solution| solution.singular < 1e-6));
    }
}

/// All joints at multiples of a right angle: stretched, folded, singular poses among them.
#[test]
fn special_configurations_do_not_hang() {
    for arm in [puma560(), ur10e(), manseur_doty()] {
        let plan = Plan::new(&arm).unwrap();
        let mut answer = Answer::default();
        for k in 0..1024u32 {
            let right: [f64; 6] = std::array::from_fn(|i| {
                f64::from(((4 * k + k % 4) >> (2 * i)) & 3) * std::f64::consts::FRAC_PI_2
            });
            let pose = arm.pose(&right);
            solve(&plan, &pose, &mut answer);
            assert!(
                answer.solutions.iter().all(|s| s.q.iter().all(|q| q.is_finite()) && s.residual <= 1e-10)
            );
        }
    }
}

/// A pose out of reach has no configuration, and that is certain.
#[test]
fn out_of_reach() {
    for (name, arm) in arms::named() {
        if arm.joints.contains(&Joint::Prismatic) {
            continue;
        }
        let plan = Plan::new(&arm).unwrap();
        let mut answer = Answer::default();
        let mut draws = Draws(4);
        for _ in 0..50 {
            let mut pose = arm.pose(&draws.configuration(&arm));
            pose.translation = [8.0 * arm.size(), 3.0 * arm.size(), -4.0 * arm.size()];
            solve(&plan, &pose, &mut answer);
            assert!(answer.solutions.is_empty());
            assert_eq!(answer.certificate, Certificate::Complete, "{name}");
        }
    }
}

#[test]
fn the_same_bits_on_every_run() {
    for (_, arm) in arms::named() {
        let (one, two) = (Plan::new(&arm).unwrap(), Plan::new(&arm).unwrap());
        assert_eq!(one.hidden(), two.hidden());
        let (mut a, mut b) = (Answer::default(), Answer::default());
        let mut draws = Draws(4);
        for _ in 0..20 {
            let pose = arm.pose(&draws.configuration(&arm));
            solve(&one, &pose, &mut a);
            solve(&two, &pose, &mut b);
            solve(&two, &pose, &mut b);
            assert_eq!(a.solutions, b.solutions);
        }
    }
}

#[test]
fn unsuitable_arms() {
    // All axes parallel.
    let flat = standard([[0.3, 0.1, 0.0, 0.0]; 6]);
    assert_eq!(Plan::new(&flat).err(), Some(Unsuitable::Singular));
    let mut gantry = arms::random(5);
    gantry.joints = [Joint::Prismatic; 6];
    assert_eq!(Plan::new(&gantry).err(), Some(Unsuitable::TooManySlides));
    let mut bent = arms::random(5);
    bent.links[2].rotation[0][0] += 0.1;
    assert_eq!(Plan::new(&bent).err(), Some(Unsuitable::NotRigid));
    let mut missing = arms::random(5);
    missing.links[2].translation[0] = f64::NAN;
    assert_eq!(Plan::new(&missing).err(), Some(Unsuitable::NotRigid));
}
