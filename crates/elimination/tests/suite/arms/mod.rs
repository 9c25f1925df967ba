//! Arms to test on, from their tables, and pseudo-random numbers.
#![allow(dead_code, reason = "the example `measure` takes its part")]

use denavit_elimination::{Answer, Arm, Isa, Joint, Plan, Rigid};

/// On the instructions that every processor has.
pub fn solve(plan: &Plan, pose: &Rigid, answer: &mut Answer) {
    plan.solve_on(Isa::PORTABLE, pose, answer);
}

/// Pseudo-random numbers (xorshift64*).
pub struct Draws(pub u64);

impl Draws {
    pub fn unit(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.unit()
    }

    pub fn configuration(&mut self, arm: &Arm) -> [f64; 6] {
        let size = arm.size();
        arm.joints.map(|joint| match joint {
            Joint::Revolute => self.between(-std::f64::consts::PI, std::f64::consts::PI),
            Joint::Prismatic => self.between(-size, size),
        })
    }
}

fn rz(q: f64) -> Rigid {
    let (s, c) = q.sin_cos();
    Rigid { rotation: [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]], translation: [0.0; 3] }
}

fn rx(q: f64) -> Rigid {
    let (s, c) = q.sin_cos();
    Rigid { rotation: [[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]], translation: [0.0; 3] }
}

fn shift(x: f64, z: f64) -> Rigid {
    Rigid { translation: [x, 0.0, z], ..Rigid::IDENTITY }
}

/// Cosines and sines of right angles as exact numbers.
fn exact(mut rigid: Rigid) -> Rigid {
    for row in &mut rigid.rotation {
        for x in row {
            if x.abs() < 1e-15 {
                *x = 0.0;
            }
        }
    }
    rigid
}

/// `Rz(θ) Tz(d) Tx(a) Rx(α)` per joint; rows `(a, d, α in degrees, θ₀ in degrees)`.
pub fn standard(rows: [[f64; 4]; 6]) -> Arm {
    let mut links = rows.map(|[a, d, alpha, _]| shift(a, d).then(&exact(rx(alpha.to_radians()))));
    let offset = |i: usize| exact(rz(rows[i][3].to_radians()));
    for (i, link) in links.iter_mut().enumerate().take(5) {
        *link = link.then(&offset(i + 1));
    }
    Arm { base: offset(0), joints: [Joint::Revolute; 6], links }
}

/// `Rx(α) Tx(a) Rz(θ) Tz(d)` per joint; rows `(α in degrees before the joint, a before it, θ₀ in degrees, d)`.
pub fn craig(rows: [[f64; 4]; 6]) -> Arm {
    let before = |i: usize| {
        let [alpha, a, theta, _] = rows[i];
        exact(rx(alpha.to_radians())).then(&shift(a, 0.0)).then(&exact(rz(theta.to_radians())))
    };
    let links = std::array::from_fn(|i| {
        let d = shift(0.0, rows[i][3]);
        if i < 5 { d.then(&before(i + 1)) } else { d }
    });
    Arm { base: before(0), joints: [Joint::Revolute; 6], links }
}

/// Each link turned and shifted by up to `amount` about and along each axis.
pub fn perturbed(mut arm: Arm, amount: f64, seed: u64) -> Arm {
    let mut draws = Draws(seed);
    let size = arm.size();
    for link in &mut arm.links {
        let [x, z] = [0, 1].map(|_| draws.between(-amount, amount));
        let y = Rigid { translation: [0.0, draws.between(-amount, amount) * size, 0.0], ..Rigid::IDENTITY };
        let t = shift(draws.between(-amount, amount) * size, draws.between(-amount, amount) * size).then(&y);
        *link = link.then(&rx(x)).then(&rz(z)).then(&t);
    }
    arm
}

pub fn random(seed: u64) -> Arm {
    let mut draws = Draws(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    for _ in 0..10 {
        draws.unit();
    }
    standard(std::array::from_fn(|_| {
        [
            draws.between(-0.5, 0.5),
            draws.between(-0.5, 0.5),
            draws.between(-180.0, 180.0),
            draws.between(-180.0, 180.0),
        ]
    }))
}

/// Random arms with slides at the given joints.
pub fn sliding(slides: &[usize], seed: u64) -> Arm {
    let mut arm = random(seed);
    for &i in slides {
        arm.joints[i] = Joint::Prismatic;
    }
    arm
}

pub fn ur10e() -> Arm {
    standard([
        [0.0, 0.1807, 90.0, 0.0],
        [-0.6127, 0.0, 0.0, 0.0],
        [-0.57155, 0.0, 0.0, 0.0],
        [0.0, 0.17415, 90.0, 0.0],
        [0.0, 0.11985, -90.0, 0.0],
        [0.0, 0.11655, 0.0, 0.0],
    ])
}

/// The UR10e with errors of 1e-3 to 6e-3 in each angle and length, as a calibration finds them.
pub fn calibrated_ur10e() -> Arm {
    let rows = [
        [0.0012, 0.1807, 90.2, 0.1],
        [-0.6140, 0.003, 0.15, -0.2],
        [-0.5699, -0.0021, -0.12, 0.25],
        [0.0017, 0.17415 + 0.0024, 89.83, -0.15],
        [-0.0014, 0.1211, -90.21, 0.18],
        [0.0013, 0.1179, 0.08, 0.0],
    ];
    standard(rows)
}

pub fn puma560() -> Arm {
    standard([
        [0.0, 0.0, 90.0, 0.0],
        [0.4318, 0.0, 0.0, 0.0],
        [0.0203, 0.15005, -90.0, 0.0],
        [0.0, 0.4318, 90.0, 0.0],
        [0.0, 0.0, -90.0, 0.0],
        [0.0, 0.0562, 0.0, 0.0],
    ])
}

/// The sixteen-solution arm of Manseur and Doty (1989).
pub fn manseur_doty() -> Arm {
    standard([
        [0.3, 0.0, 90.0, 0.0],
        [1.0, 0.0, 1.0, 0.0],
        [0.0, 0.2, 90.0, 0.0],
        [1.5, 0.0, 1.0, 0.0],
        [0.0, 0.0, 90.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
    ])
}

/// Arms of the catalogue in crates/robot/catalogue without closed form, and others.
pub fn named() -> Vec<(&'static str, Arm)> {
    vec![
        ("random 1", random(1)),
        ("random 2", random(2)),
        ("random 3", random(3)),
        (
            "oblique 6R",
            standard([
                [0.1, 0.3, 45.0, 0.0],
                [0.35, 0.0, 30.0, 0.0],
                [0.0, 0.12, 60.0, 0.0],
                [0.05, 0.3, -45.0, 0.0],
                [0.0, 0.1, 90.0, 0.0],
                [0.0, 0.08, 0.0, 0.0],
            ]),
        ),
        (
            "FANUC CRX-10iA/L",
            standard([
                [0.0, 0.245, -90.0, 0.0],
                [0.71, 0.0, 180.0, -90.0],
                [0.0, 0.0, -90.0, 0.0],
                [0.0, -0.54, 90.0, 0.0],
                [0.0, 0.15, -90.0, 0.0],
                [0.0, -0.16, 180.0, 0.0],
            ]),
        ),
        (
            "Motoman HC10",
            standard([
                [0.0, 0.275, -90.0, 0.0],
                [0.7, 0.0, 180.0, -90.0],
                [0.0, 0.0, -90.0, -90.0],
                [0.0, -0.5, 90.0, 0.0],
                [0.0, -0.162, -90.0, 0.0],
                [0.0, -0.13, 180.0, 0.0],
            ]),
        ),
        (
            "ABB GoFa",
            standard([
                [0.0, 0.265, -90.0, 0.0],
                [0.444, 0.0, 0.0, -90.0],
                [0.11, 0.0, -90.0, 0.0],
                [0.0, 0.47, 90.0, 0.0],
                [0.08, 0.0, -90.0, 0.0],
                [0.0, 0.101, 0.0, 180.0],
            ]),
        ),
        (
            "Kinova Jaco",
            standard([
                [0.0, 0.2755, 90.0, 0.0],
                [0.41, 0.0, 180.0, -90.0],
                [0.0, -0.0098, 90.0, 90.0],
                [0.0, -0.2501971, 60.0, 0.0],
                [0.0, -0.0857943, 60.0, -180.0],
                [0.0, -0.2115971, 180.0, 100.0],
            ]),
        ),
        (
            "Kinova Mico",
            standard([
                [0.0, 0.2755, 90.0, 0.0],
                [0.29, 0.0, 180.0, -90.0],
                [0.0, -0.007, 90.0, 90.0],
                [0.0, -0.1660817, 60.0, 0.0],
                [0.0, -0.0855633, 60.0, -180.0],
                [0.0, -0.2027817, 180.0, 100.0],
            ]),
        ),
        (
            "UFACTORY xArm 6",
            craig([
                [0.0, 0.0, 0.0, 0.267],
                [-90.0, 0.0, -79.34995, 0.0],
                [0.0, 0.28948661, 79.34995, 0.0],
                [-90.0, 0.0775, 0.0, 0.3425],
                [90.0, 0.0, 0.0, 0.0],
                [-90.0, 0.076, 0.0, 0.097],
            ]),
        ),
        (
            "PiPER, wrist offset 5 mm",
            craig([
                [0.0, 0.0, 0.0, 0.123],
                [-90.0, 0.0, -172.22, 0.0],
                [0.0, 0.28503, -102.78, 0.0],
                [90.0, -0.02198, 0.0, 0.25075],
                [-90.0, 0.005, 0.0, 0.0],
                [90.0, 0.0, 0.0, 0.091],
            ]),
        ),
        ("Manseur-Doty", manseur_doty()),
        ("UR10e, calibrated", calibrated_ur10e()),
        ("UR10e", ur10e()),
        ("PUMA 560", puma560()),
        ("1P5R, slide 1", sliding(&[0], 11)),
        ("1P5R, slide 3", sliding(&[2], 12)),
        ("1P5R, slide 6", sliding(&[5], 13)),
        ("2P4R, slides 1 2", sliding(&[0, 1], 14)),
        ("2P4R, slides 1 3", sliding(&[0, 2], 15)),
        ("2P4R, slides 3 4", sliding(&[2, 3], 16)),
        ("2P4R, slides 2 6", sliding(&[1, 5], 17)),
        ("3P3R, slides 1 2 3", sliding(&[0, 1, 2], 18)),
        ("3P3R, slides 2 4 5", sliding(&[1, 3, 4], 19)),
    ]
}

/// The largest difference between two configurations: angles as chords, slides in parts of the arm's size.
pub fn apart(arm: &Arm, a: &[f64; 6], b: &[f64; 6]) -> f64 {
    let size = arm.size();
    (0..6)
        .map(|i| match arm.joints[i] {
            Joint::Revolute => 2.0 * ((a[i] - b[i]) / 2.0).sin().abs(),
            Joint::Prismatic => (a[i] - b[i]).abs() / size,
        })
        .fold(0.0, f64::max)
}

/// The distance of two poses, lengths in parts of the arm's size.
pub fn distance(arm: &Arm, a: &Rigid, b: &Rigid) -> f64 {
    let mut square = 0.0;
    for i in 0..3 {
        square += ((a.translation[i] - b.translation[i]) / arm.size()).powi(2);
        for k in 0..3 {
            square += (a.rotation[i][k] - b.rotation[i][k]).powi(2) / 2.0;
        }
    }
    square.sqrt()
}

/// The arm read from the tool to the base: `T⁻¹ = A₆⁻¹ Z₆(−q₆) A₅⁻¹ … Z₁(−q₁) B⁻¹`, where `Z(−q)` is `Z(q)` between half
/// turns about x.
pub fn reversed(arm: &Arm) -> Arm {
    let flip =
        Rigid { rotation: [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]], translation: [0.0; 3] };
    let links = std::array::from_fn(|i| match i {
        5 => flip.then(&arm.base.inverse()),
        _ => flip.then(&arm.links[4 - i].inverse()).then(&flip),
    });
    let mut joints = arm.joints;
    joints.reverse();
    Arm { base: arm.links[5].inverse().then(&flip), joints, links }
}

/// Levenberg and Marquardt's steps with a Jacobian by differences: nothing in common with the solver.
pub fn newton(arm: &Arm, pose: &Rigid, mut q: [f64; 6]) -> Option<[f64; 6]> {
    let size = arm.size();
    let rest = |q: &[f64; 6]| -> [f64; 12] {
        let at = arm.pose(q);
        std::array::from_fn(|k| match k {
            0..3 => (at.translation[k] - pose.translation[k]) / size,
            _ => at.rotation[(k - 3) / 3][(k - 3) % 3] - pose.rotation[(k - 3) / 3][(k - 3) % 3],
        })
    };
    let norm = |r: &[f64; 12]| r.iter().map(|x| x * x).sum::<f64>();
    let mut damping = 1e-2;
    for _ in 0..60 {
        let r = rest(&q);
        if norm(&r) < 1e-24 {
            return Some(q);
        }
        let columns: [[f64; 12]; 6] = std::array::from_fn(|i| {
            let (mut a, mut b) = (q, q);
            a[i] += 1e-6;
            b[i] -= 1e-6;
            let (a, b) = (rest(&a), rest(&b));
            std::array::from_fn(|k| (a[k] - b[k]) / 2e-6)
        });
        let mut m = [[0.0; 7]; 6];
        for i in 0..6 {
            for j in 0..6 {
                m[i][j] = columns[i].iter().zip(&columns[j]).map(|(a, b)| a * b).sum();
            }
            m[i][i] += damping * (1e-3 + m[i][i]);
            m[i][6] = -columns[i].iter().zip(&r).map(|(a, b)| a * b).sum::<f64>();
        }
        for k in 0..6 {
            let pivot = m[k];
            for (_, row) in m.iter_mut().enumerate().filter(|(i, _)| *i != k) {
                let factor = row[k] / pivot[k];
                for (entry, pivot) in row.iter_mut().zip(pivot) {
                    *entry -= factor * pivot;
                }
            }
        }
        let mut next = q;
        for i in 0..6 {
            next[i] += m[i][6] / m[i][i];
        }
        if norm(&rest(&next)) < norm(&r) {
            q = next;
            damping /= 8.0;
        } else {
            damping *= 4.0;
        }
    }
    None
}
