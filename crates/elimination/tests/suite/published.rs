//! Arms and poses with known numbers of configurations, singular poses, and arms that are refused.

use crate::arms::{Draws, apart, manseur_doty, newton, puma560, solve, standard, ur10e};
use denavit_elimination::{Answer, Certificate, Joint, Plan, Rigid, Unsuitable};

/// Problem 6 of Wampler and Morgan (1991), an arm close to that of Manseur and Doty (1989): sixteen real configurations.
/// The angles are those of table III of Manocha and Canny (1994), which prints two decimals of them (degrees).
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
    let printed = [
        [-96.28, -6.27, 179.96, 38.48, 52.55, -39.40],
        [-120.78, 172.33, -179.07, 31.33, -146.71, 142.82],
        [88.67, -176.72, -176.72, -63.24, 157.19, 140.43],
        [113.84, 5.30, -177.74, -55.92, -62.98, -43.37],
        [-178.12, 108.19, -147.73, -5.69, -164.67, 179.58],
        [168.32, -103.89, 146.60, -17.24, -171.87, 98.16],
        [-12.94, -105.09, -114.97, 3.02, 7.41, -79.42],
        [2.51, 108.07, 112.04, -10.52, 0.00, -0.10],
        [2.51, 108.07, -67.95, -169.47, 179.99, 179.89],
        [-12.94, -105.09, 65.02, 176.97, 172.58, 100.57],
        [168.32, -103.89, -33.39, -162.75, -8.12, -81.83],
        [-178.12, 108.19, 32.26, -174.30, -15.32, -0.41],
        [88.67, -176.72, 3.27, -116.75, 22.80, -39.56],
        [-96.28, -6.27, -0.03, 141.51, 127.44, 140.59],
        [-120.78, 172.33, 0.92, 148.66, -33.28, -37.17],
        [113.84, 5.30, 2.25, -124.07, -117.01, 136.62],
    ];
    each_is_printed(&answer, &printed, 0.02);
}

/// The example of Raghavan and Roth (1990): two of the sixteen configurations are real. The numbers are those of the files
/// `Examples/example1` of github.com/ambuj-Shahi/General_6-R_IK, whose complex solutions are left out here.
#[test]
fn raghavan_and_roth() {
    let arm = standard([
        [0.8, 0.9, 20.0, 0.0],
        [1.2, 3.7, 31.0, 0.0],
        [0.33, 1.0, 45.0, 0.0],
        [1.8, 0.5, 81.0, 0.0],
        [0.6, 2.1, 12.0, 0.0],
        [2.2, 0.63, 100.0, 0.0],
    ]);
    let pose = Rigid {
        rotation: orthogonal([
            [0.354937475307970, 0.461639573991743, -0.812962663562556],
            [0.876709605247149, 0.137616185817977, 0.460914366741046],
            [0.324653132880913, -0.876327957516839, -0.355878707125018],
        ]),
        translation: [6.82151837150213, 1.46146704002829, 5.36950521368663],
    };
    let mut answer = Answer::default();
    solve(&Plan::new(&arm).unwrap(), &pose, &mut answer);
    assert_eq!(answer.certificate, Certificate::Complete);
    let printed = [
        [13.109881, 50.992641, -72.044721, 72.065198, -7.195753, -37.852729],
        [14.000158, 29.699750, -45.000135, 71.000293, -63.000511, 10.000427],
    ];
    // The files round the twists to six digits.
    each_is_printed(&answer, &printed, 2e-3);
    let mut draws = Draws(6);
    for found in (0..200).filter_map(|_| newton(&arm, &pose, draws.configuration(&arm))) {
        assert!(answer.solutions.iter().any(|solution| apart(&arm, &solution.q, &found) < 1e-6));
    }
}

/// Whether the solutions are the printed ones up to a tolerance, all in degrees.
fn each_is_printed(answer: &Answer, printed: &[[f64; 6]], tolerance: f64) {
    assert_eq!(answer.solutions.len(), printed.len());
    for row in printed {
        let away = |q: &[f64; 6]| {
            let turns = q.iter().zip(row).map(|(a, b)| (a.to_degrees() - b) / 360.0);
            turns.map(|x| 360.0 * (x - x.round()).abs()).fold(0.0, f64::max)
        };
        let least = answer.solutions.iter().map(|solution| away(&solution.q)).fold(360.0, f64::min);
        assert!(least < tolerance, "{row:?}: {least}");
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
    for (name, arm) in crate::arms::named() {
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
    for (_, arm) in crate::arms::named() {
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
    let mut gantry = crate::arms::random(5);
    gantry.joints = [Joint::Prismatic; 6];
    assert_eq!(Plan::new(&gantry).err(), Some(Unsuitable::TooManySlides));
    let mut bent = crate::arms::random(5);
    bent.links[2].rotation[0][0] += 0.1;
    assert_eq!(Plan::new(&bent).err(), Some(Unsuitable::NotRigid));
    let mut missing = crate::arms::random(5);
    missing.links[2].translation[0] = f64::NAN;
    assert_eq!(Plan::new(&missing).err(), Some(Unsuitable::NotRigid));
}
