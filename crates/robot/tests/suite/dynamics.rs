//! Torques, inertia, energies and accelerations: numbers beside Pinocchio, and what they have to do with each other.

use crate::common::{Random, numbers, robot, with_values};
use denavit::Robot;
use denavit::description::{Convention, Decimals, Description, read_urdf};
use denavit::dynamics::{
    Dynamics, Formulas, Wrench, articulated_bodies, coriolis_matrix, direct_dynamics, friction,
    gravity_torques, inertia_matrix, inverse_dynamics, kinetic_energy, potential_energy, regressor,
    velocity_torques,
};
use denavit::geometry::Vector;
use denavit::mechanism::Reference;
use denavit::velocity::{Viewpoint, geometric, torques};
use denavit_program::{Graph, Program};
use denavit_symbolic::{Expr, Rational};
use serde_json::Value;

pub(crate) fn exact(x: f64) -> Expr {
    Rational::from_f64(x).map(Expr::from).expect("a finite number")
}

/// A number between two.
fn between(random: &mut Random, low: f64, high: f64) -> f64 {
    low + (high - low) * random.unit()
}

/// Puts ten numbers about the origin of its frame on a row.
fn weigh(d: &mut Description, row: usize, ten: &[f64]) {
    let e: Vec<Expr> = ten.iter().map(|&x| exact(x)).collect();
    let row = &mut d.rows[row];
    row.inertia_at_origin = Some([e[0], e[1], e[2], e[3], e[4], e[5]]);
    row.first_moment = Some([e[6], e[7], e[8]]);
    row.mass = Some(e[9]);
}

/// An arm with a random body on each row, some gravity and drives.
pub(crate) fn random_arm(name: &str, seed: u64) -> Description {
    let mut d = robot(name);
    let mut random = Random(seed);
    for k in 0..d.rows.len() {
        let mass = between(&mut random, 0.5, 4.0);
        let c: [f64; 3] = std::array::from_fn(|_| between(&mut random, -0.2, 0.2));
        let root: [[f64; 3]; 3] =
            std::array::from_fn(|_| std::array::from_fn(|_| between(&mut random, -0.1, 0.1)));
        let s = |i: usize, j: usize| -> f64 {
            mass * (c[i] * c[j] + (0..3).map(|m| root[i][m] * root[j][m]).sum::<f64>())
        };
        let t = s(0, 0) + s(1, 1) + s(2, 2);
        let ten = [
            t - s(0, 0),
            -s(0, 1),
            -s(0, 2),
            t - s(1, 1),
            -s(1, 2),
            t - s(2, 2),
            mass * c[0],
            mass * c[1],
            mass * c[2],
            mass,
        ];
        weigh(&mut d, k, &ten);
        if d.rows[k].variable.is_some() {
            d.rows[k].rotor = Some(exact(between(&mut random, 0.0, 0.1)));
            d.rows[k].viscous = Some(exact(between(&mut random, 0.0, 0.3)));
            d.rows[k].coulomb = Some(exact(between(&mut random, 0.0, 0.3)));
        }
    }
    d.gravity = Some(std::array::from_fn(|_| exact(between(&mut random, -9.0, 9.0))));
    for (k, p) in d.parameters.iter_mut().enumerate() {
        p.value = p.value.or(Some(Expr::from(Rational::new(2 + k as i64, 10))));
    }
    d
}

pub(crate) const ARMS: [&str; 12] = [
    "planar-3r",
    "scara",
    "articulated-3r",
    "staubli-rx90",
    "puma560",
    "stanford",
    "ur5",
    "franka-panda",
    "smart5-six-rail",
    "oblique-6r",
    "parallelogram-5r",
    "prrrrp",
];

/// q, q̇, q̈.
pub(crate) fn state(n: usize, random: &mut Random) -> [Vec<f64>; 3] {
    [1.5, 2.0, 3.0].map(|size| (0..n).map(|_| between(random, -size, size)).collect())
}

/// The largest difference, by the size of the second.
#[track_caller]
fn close(what: &str, a: &[f64], b: &[f64], tolerance: f64) -> f64 {
    assert_eq!(a.len(), b.len(), "{what}");
    let size = b.iter().fold(1e-3_f64, |m, x| m.max(x.abs()));
    let off = a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max) / size;
    assert!(off <= tolerance, "{what}: {off:e}\n{a:?}\n{b:?}");
    off
}

fn matrix_of(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().flat_map(numbers).collect()
}

/// Everything that Pinocchio computed at a state.
fn held_against(name: &str, arm: &Dynamics<f64>, sample: &Value, tolerance: f64) -> f64 {
    let of = |key: &str| numbers(&sample[key]);
    let (q, qd, qdd) = (of("q"), of("qd"), of("qdd"));
    let mut worst = 0.0_f64;
    let mut hold = |what: &str, a: &[f64], b: &[f64]| {
        worst = worst.max(close(&format!("{name}, {what}"), a, b, tolerance));
    };
    hold("tau", &inverse_dynamics(arm, &q, &qd, &qdd, None), &of("tau"));
    hold("A", &inertia_matrix(arm, &q).concat(), &matrix_of(&sample["A"]));
    hold("Q", &gravity_torques(arm, &q), &of("Q"));
    let velocity = velocity_torques(arm, &q, &qd);
    let h: Vec<f64> = velocity.iter().zip(gravity_torques(arm, &q)).map(|(a, b)| a + b).collect();
    hold("h", &h, &of("h"));
    hold("T", &[kinetic_energy(arm, &q, &qd)], &[sample["T"].as_f64().unwrap()]);
    hold("V", &[potential_energy(arm, &q)], &[sample["V"].as_f64().unwrap()]);
    // Accelerations are as good as the matrix is.
    let pulled = of("pulled");
    let direct = direct_dynamics(arm, &q, &qd, &pulled, None).unwrap_or_else(|e| panic!("{name}: {e}"));
    close(&format!("{name}, direct"), &direct, &of("direct"), 1e3 * tolerance);
    if let Some(articulated) = articulated_bodies(arm, &q, &qd, &pulled) {
        close(&format!("{name}, articulated"), &articulated.unwrap(), &of("direct"), 1e3 * tolerance);
    }
    if sample["W"].is_array() {
        let w = regressor(arm, &q, &qd, &qdd);
        let columns = 10 * arm.links.len();
        let own: Vec<f64> = w.iter().flat_map(|row| row[..columns].to_vec()).collect();
        hold("W", &own, &matrix_of(&sample["W"]));
    }
    worst
}

/// An arm of the catalogue with the bodies, the rotors and the gravity of a stored one.
pub(crate) fn with_bodies(one: &Value) -> Description {
    let name = one["name"].as_str().unwrap();
    let mut d = with_values(robot(name), &one["parameters"]);
    for (k, body) in one["bodies"].as_array().unwrap().iter().enumerate() {
        if body.is_array() {
            weigh(&mut d, k, &numbers(body));
        }
    }
    let gravity = numbers(&one["gravity"]);
    d.gravity = Some([0, 1, 2].map(|i| exact(gravity[i])));
    let rotors = numbers(&one["rotors"]);
    for (row, rotor) in d.rows.iter_mut().filter(|r| r.variable.is_some()).zip(rotors) {
        row.rotor = Some(exact(rotor));
    }
    d
}

/// The arms of the catalogue with random bodies in the frames of their rows.
#[test]
fn arms_of_the_catalogue_move_as_pinocchio_says() {
    let all: Value = serde_json::from_str(include_str!("../peers/dynamics.json")).unwrap();
    let (mut count, mut regressors) = (0, 0);
    for one in all["catalogue"].as_array().unwrap() {
        let name = one["name"].as_str().unwrap();
        let d = with_bodies(one);
        let arm = Dynamics::numeric(&d).unwrap_or_else(|e| panic!("{name}: {e}"));
        for sample in one["samples"].as_array().unwrap() {
            held_against(name, &arm, sample, 1e-12);
            regressors += usize::from(sample["W"].is_array());
        }
        count += 1;
    }
    assert_eq!((count, regressors), (28, 8));
}

/// Files with their own inertias, what is fixed to a link merged with it.
#[test]
fn files_move_as_pinocchio_says() {
    let all: Value = serde_json::from_str(include_str!("../peers/dynamics.json")).unwrap();
    let mut count = 0;
    for one in all["urdf"].as_array().unwrap() {
        let name = one["name"].as_str().unwrap();
        let path = format!("{}/tests/urdf/{name}.urdf", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"));
        let mechanism = read_urdf(&text, Decimals::AsWritten).unwrap().0;
        for convention in Convention::ALL {
            let tip = one["tip"].as_str();
            let chain = mechanism.chain(None, tip, convention).unwrap_or_else(|e| panic!("{name}: {e}"));
            let joints: Vec<&str> = chain.joints.iter().map(|&j| mechanism.joints[j].name.as_str()).collect();
            let theirs: Vec<&str> =
                one["joints"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
            assert_eq!(joints, theirs, "{name}");
            let arm = Dynamics::numeric(&chain.description).unwrap_or_else(|e| panic!("{name}: {e}"));
            for sample in one["samples"].as_array().unwrap() {
                held_against(name, &arm, sample, 1e-10);
            }
        }
        count += 1;
    }
    assert_eq!(count, 12);
}

/// Another convention has other frames, and the same torques.
#[test]
fn torques_do_not_depend_on_the_convention() {
    for (k, name) in ARMS.iter().enumerate() {
        let d = random_arm(name, 40 + k as u64);
        let arm = Dynamics::numeric(&d).unwrap();
        let [q, qd, qdd] = state(arm.joints(), &mut Random(k as u64));
        let wanted = inverse_dynamics(&arm, &q, &qd, &qdd, None);
        for convention in Convention::ALL {
            let other = Dynamics::numeric(&d.converted(convention).description).unwrap();
            let torques = inverse_dynamics(&other, &q, &qd, &qdd, None);
            close(&format!("{name} {convention}"), &torques, &wanted, 1e-12);
        }
    }
}

/// A is symmetric and positive definite, τ = A q̈ + C q̇ + Q + friction, C q̇ are the velocity torques, Ȧ − 2C is skew, τ = Wχ, and
/// the torques of an acceleration give it back by either way.
#[test]
fn the_parts_make_the_whole() {
    for (k, name) in ARMS.iter().enumerate() {
        let arm = Dynamics::numeric(&random_arm(name, 7 + k as u64)).unwrap();
        let n = arm.joints();
        let [q, qd, qdd] = state(n, &mut Random(100 + k as u64));
        let tau = inverse_dynamics(&arm, &q, &qd, &qdd, None);
        let a = inertia_matrix(&arm, &q);
        let c = coriolis_matrix(&arm, &q, &qd);
        let times = |m: &[Vec<f64>], v: &[f64]| -> Vec<f64> {
            m.iter().map(|row| row.iter().zip(v).map(|(x, y)| x * y).sum()).collect()
        };
        let velocity = velocity_torques(&arm, &q, &qd);
        close(&format!("{name}: C q̇"), &times(&c, &qd), &velocity, 1e-12);
        let gravity = gravity_torques(&arm, &q);
        let sum: Vec<f64> = (0..n)
            .map(|j| times(&a, &qdd)[j] + velocity[j] + gravity[j] + arm.drives[j].viscous * qd[j])
            .collect();
        close(&format!("{name}: A q̈ + C q̇ + Q"), &sum, &tau, 1e-12);
        // Cholesky by the factors without roots: all pivots are positive.
        let factors = denavit::dynamics::factored(&a);
        assert!(factors.diagonal.iter().all(|&d| d > 0.0), "{name}: {:?}", factors.diagonal);
        // Ȧ by central differences along q̇.
        let h = 1e-5;
        let at = |t: f64| {
            let moved: Vec<f64> = q.iter().zip(&qd).map(|(x, v)| x + t * v).collect();
            inertia_matrix(&arm, &moved)
        };
        let (more, less) = (at(h), at(-h));
        let size = a.concat().iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        for i in 0..n {
            for j in 0..=i {
                let rate = |i: usize, j: usize| (more[i][j] - less[i][j]) / (2.0 * h) - 2.0 * c[i][j];
                let off = (rate(i, j) + rate(j, i)).abs() / size;
                assert!(off < 1e-8, "{name}: Ȧ − 2C at {i} {j}: {off:e}");
            }
        }
        let chi: Vec<f64> = arm
            .links
            .iter()
            .flat_map(|l| l.body.parameters())
            .chain(arm.drives.iter().map(|d| d.rotor))
            .chain(arm.drives.iter().map(|d| d.viscous))
            .collect();
        close(&format!("{name}: Wχ"), &times(&regressor(&arm, &q, &qd, &qdd), &chi), &tau, 1e-12);
        let pushed: Vec<f64> = {
            let rubbed = friction(&arm, &qd);
            (0..n).map(|j| tau[j] + rubbed[j] - arm.drives[j].viscous * qd[j]).collect()
        };
        close(name, &direct_dynamics(&arm, &q, &qd, &pushed, None).unwrap(), &qdd, 1e-9);
        match articulated_bodies(&arm, &q, &qd, &pushed) {
            Some(found) => drop(close(name, &found.unwrap(), &qdd, 1e-9)),
            None => assert!(["parallelogram-5r"].contains(name), "{name}"),
        }
    }
}

/// d(T + V)/dt = q̇ᵀ(τ − friction), along a motion with constant acceleration.
#[test]
fn power_is_the_rate_of_energy() {
    for (k, name) in ARMS.iter().enumerate() {
        let mut arm = Dynamics::numeric(&random_arm(name, 70 + k as u64)).unwrap();
        arm.drives.iter_mut().for_each(|d| d.viscous = 0.0);
        let [q, qd, qdd] = state(arm.joints(), &mut Random(3 * k as u64));
        let energy = |t: f64| {
            let at: Vec<f64> = (0..q.len()).map(|j| q[j] + qd[j] * t + 0.5 * qdd[j] * t * t).collect();
            let rates: Vec<f64> = (0..q.len()).map(|j| qd[j] + qdd[j] * t).collect();
            kinetic_energy(&arm, &at, &rates) + potential_energy(&arm, &at)
        };
        let h = 1e-4;
        // Of the fourth order.
        let rate = (8.0 * (energy(h) - energy(-h)) - (energy(2.0 * h) - energy(-2.0 * h))) / (12.0 * h);
        let tau = inverse_dynamics(&arm, &q, &qd, &qdd, None);
        let power: f64 = tau.iter().zip(&qd).map(|(t, v)| t * v).sum();
        let size = 1.0 + tau.iter().zip(&qd).map(|(t, v)| (t * v).abs()).sum::<f64>();
        assert!((rate - power).abs() < 1e-9 * size, "{name}: {rate} {power}");
    }
}

/// What the tool exerts on its surroundings costs Jᵀ w, whatever the motion.
#[test]
fn a_wrench_of_the_tool_costs_the_transposed_jacobian() {
    for (k, name) in ARMS.iter().enumerate() {
        let d = random_arm(name, k as u64);
        let (arm, robot) = (Dynamics::numeric(&d).unwrap(), Robot::numeric(&d).unwrap());
        let [q, qd, qdd] = state(arm.joints(), &mut Random(k as u64 + 9));
        let wrench: Wrench<f64> = [Vector([3.0, -4.0, 5.5]), Vector([0.7, 1.2, -0.4])];
        let with = inverse_dynamics(&arm, &q, &qd, &qdd, Some(&wrench));
        let without = inverse_dynamics(&arm, &q, &qd, &qdd, None);
        let difference: Vec<f64> = with.iter().zip(&without).map(|(a, b)| a - b).collect();
        let jacobian = geometric(&robot, &q, &Viewpoint::of(Reference::Tool, Reference::Base));
        let [Vector(f), Vector(m)] = wrench;
        let held = torques(&jacobian, &[f[0], f[1], f[2], m[0], m[1], m[2]]);
        close(name, &difference, &held, 1e-10);
    }
}

/// Splitting a body between a link and a row that is fixed behind it changes nothing; nor does mass in front of the first joint.
#[test]
fn what_is_fixed_to_a_link_is_part_of_it() {
    let one = "name = 'r'\nconvention = 'craig'\ngravity = [0, '-9.81', 0]\n\
               [[joints]]\nalpha = '30 deg'\nmass = 4\ncom = [1, 2, 3]\n\
               [[joints]]\ntheta = 'q1'\nmass = 2\ncom = ['0.1', 0, 0]\ninertia = ['0.02', 0, 0, '0.02', 0, '0.02']\n\
               [[joints]]\nalpha = '90 deg'\na = '0.5'\nd = '0.2'\nmass = 3\ncom = [0, '0.1', 0]\n\
               inertia = ['0.02', '0.01', 0, '0.03', 0, '0.02']\n";
    let read = |text: &str| denavit::description::read_toml(text).unwrap_or_else(|e| panic!("{e:?}")).0;
    let arm = Dynamics::numeric(&read(one)).unwrap();
    assert_eq!(arm.links.len(), 1);
    // In frame 1, z = the axis: the second body's centre is at (0.5, −0.2, 0.1): x of frame 2 is x, its y is z.
    let body = &arm.links[0].body;
    close("first moment", &body.first_moment.0, &[0.2 + 1.5, -0.6, 0.3], 1e-15);
    // ZZ: 0.02 + 2·0.01 + its YY about the centre + 3·(0.5² + 0.2²)
    close("inertia", &[body.inertia[5]], &[0.02 + 0.02 + 0.03 + 3.0 * 0.29], 1e-15);
    let tau = inverse_dynamics(&arm, &[0.0], &[0.3], &[2.0], None);
    // The axis is 30° from the base's z about x, gravity along −y: its part across the axis is g cos 30° along −y of frame 1.
    let hang = 9.81 * 30_f64.to_radians().cos() * 1.7;
    close("torque", &tau, &[2.0 * body.inertia[5] + hang], 1e-14);
}

/// Craig's two links with point masses (*Introduction to Robotics*, section 6.7, as every course prints it).
#[test]
fn two_links_move_as_the_textbook_says() {
    let text = "name = '2R'\nconvention = 'craig'\ngravity = [0, '-9.81', 0]\n\
                [[joints]]\ntheta = 'q1'\nmass = '4.6'\ncom = ['0.5', 0, 0]\n\
                [[joints]]\na = '0.5'\ntheta = 'q2'\nmass = '2.3'\ncom = ['0.4', 0, 0]\n";
    let d = denavit::description::read_toml(text).unwrap().0;
    let arm = Dynamics::numeric(&d).unwrap();
    let (m1, m2, l1, l2, g) = (4.6, 2.3, 0.5, 0.4, 9.81);
    let ([q1, q2], [v1, v2], [a1, a2]) = ([0.4_f64, -1.1_f64], [0.7, -1.3], [2.0, 0.6]);
    let (c1, c2, s2, c12) = (q1.cos(), q2.cos(), q2.sin(), (q1 + q2).cos());
    let tau1 = m2 * l2 * l2 * (a1 + a2) + m2 * l1 * l2 * c2 * (2.0 * a1 + a2) + (m1 + m2) * l1 * l1 * a1
        - m2 * l1 * l2 * s2 * v2 * v2
        - 2.0 * m2 * l1 * l2 * s2 * v1 * v2
        + m2 * l2 * g * c12
        + (m1 + m2) * l1 * g * c1;
    let tau2 =
        m2 * l1 * l2 * c2 * a1 + m2 * l1 * l2 * s2 * v1 * v1 + m2 * l2 * g * c12 + m2 * l2 * l2 * (a1 + a2);
    close("2R", &inverse_dynamics(&arm, &[q1, q2], &[v1, v2], &[a1, a2], None), &[tau1, tau2], 1e-14);
}

/// The formulas, traced, give the numbers.
#[test]
fn formulas_give_the_numbers() {
    for (k, name) in
        ["planar-3r", "scara", "staubli-rx90", "stanford", "parallelogram-5r", "ur5"].iter().enumerate()
    {
        let d = random_arm(name, 200 + k as u64);
        let formulas = Formulas::new(&d);
        assert!(!formulas.is_generic);
        let [q, qd, qdd] = [&formulas.q, &formulas.qd, &formulas.qdd]
            .map(|all| all.iter().map(|&s| s.into()).collect::<Vec<Expr>>());
        let torques = inverse_dynamics(&formulas.dynamics, &q, &qd, &qdd, None);
        let matrix = inertia_matrix(&formulas.dynamics, &q);
        let energy = kinetic_energy(&formulas.dynamics, &q, &qd);
        let all: Vec<Expr> = torques.into_iter().chain(matrix.concat()).chain([energy]).collect();
        let variables = [formulas.q.clone(), formulas.qd.clone(), formulas.qdd.clone()].concat();
        let parameters: Vec<_> = formulas.parameters.iter().map(|p| p.symbol).collect();
        let mut graph = Graph::new(&variables, &parameters);
        let results: Vec<_> =
            all.iter().enumerate().map(|(i, &e)| (format!("r{i}"), graph.trace(e))).collect();
        let program = Program::new(&graph, &results, |_| None, &rustc_hash::FxHashSet::default());
        let value = |s| formulas.parameters.iter().find(|p| p.symbol == s)?.number();
        let function = program.compile_with(value).unwrap();
        let arm = Dynamics::numeric(&d).unwrap();
        let [q, qd, qdd] = state(arm.joints(), &mut Random(5));
        let mut wanted = inverse_dynamics(&arm, &q, &qd, &qdd, None);
        wanted.extend(inertia_matrix(&arm, &q).concat());
        wanted.push(kinetic_energy(&arm, &q, &qd));
        close(name, function.scalar().eval(&[q, qd, qdd].concat()), &wanted, 1e-12);
    }
}

/// A joint that moves no mass has no acceleration; the answer names it.
#[test]
fn a_joint_without_mass_is_named() {
    let mut d = random_arm("planar-3r", 1);
    let last = d.rows.last_mut().unwrap();
    (last.mass, last.first_moment, last.inertia_at_origin, last.rotor) = (None, None, None, None);
    let arm = Dynamics::numeric(&d).unwrap();
    let [q, qd, tau] = state(3, &mut Random(8));
    assert_eq!(direct_dynamics(&arm, &q, &qd, &tau, None).unwrap_err().joint, 2);
    assert_eq!(articulated_bodies(&arm, &q, &qd, &tau).unwrap().unwrap_err().joint, 2);
}
