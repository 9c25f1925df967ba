//! Whole trees: the numbers of Pinocchio, and what must hold of any tree.

use crate::common::{Random, numbers};
use denavit::description::{Convention, Decimals, Mechanism, read_urdf};
use denavit::dynamics::{
    Acting, DynamicFunction as F, DynamicPrograms, Dynamics, Ground, Masses, Method, OfTree, Torques,
    Unknown, acceleration_derivatives, articulated_bodies, coriolis_matrix, direct_dynamics, drive_torques,
    gravity_torques, inertia_matrix, inverse_dynamics, kinetic_energy, momentum, potential_energy, regressor,
    simulate, torque_derivatives,
};
use denavit_symbolic::Expr;
use serde_json::Value;

fn mechanism(name: &str) -> Mechanism {
    let path = format!("{}/tests/urdf/{name}.urdf", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"));
    read_urdf(&text, Decimals::AsWritten).unwrap_or_else(|e| panic!("{name}: {e:?}")).0
}

#[track_caller]
fn close(what: &str, a: &[f64], b: &[f64], tolerance: f64) {
    assert_eq!(a.len(), b.len(), "{what}");
    let size = b.iter().fold(1e-3_f64, |m, x| m.max(x.abs()));
    let off = a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max) / size;
    assert!(off <= tolerance, "{what}: {off:e}");
}

/// Torques, matrices, accelerations and energies of two-armed, legged and many-fingered robots, joints that follow others among
/// them.
#[test]
fn trees_agree_with_pinocchio() {
    let peers: Value = serde_json::from_str(include_str!("../peers/dynamics_trees.json")).unwrap();
    let trees = peers["trees"].as_array().unwrap();
    assert_eq!(trees.len(), 7);
    let mut bodies = 0;
    for tree in trees {
        let name = tree["name"].as_str().unwrap();
        let m = mechanism(name);
        let mut found = OfTree::new(&m).unwrap_or_else(|e| panic!("{name}: {e}"));
        // Drives are not in the figures.
        found.dynamics.drives.iter_mut().for_each(|d| *d = denavit::dynamics::Drive::nothing());
        let arm = &found.dynamics;
        let names: Vec<&str> = tree["joints"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
        let theirs: Vec<usize> = found
            .joints
            .iter()
            .map(|&j| {
                names
                    .iter()
                    .position(|n| *n == m.joints[j].name)
                    .unwrap_or_else(|| panic!("{name}: {}", m.joints[j].name))
            })
            .collect();
        let of = |key: &str| -> Vec<f64> {
            let all = numbers(&tree["sample"][key]);
            theirs.iter().map(|&k| all[k]).collect()
        };
        let [q, qd, qdd] = ["q", "qd", "qdd"].map(of);
        close(&format!("{name}, torques"), &inverse_dynamics(arm, &q, &qd, &qdd, None), &of("tau"), 1e-10);
        close(&format!("{name}, Q"), &gravity_torques(arm, &q), &of("Q"), 1e-10);
        let rows = tree["sample"]["A"].as_array().unwrap();
        let entry = |i: usize, j: usize| numbers(&rows[i.max(j)])[i.min(j)];
        let wanted: Vec<f64> =
            theirs.iter().flat_map(|&i| theirs.iter().map(move |&j| entry(i, j))).collect();
        close(&format!("{name}, A"), &inertia_matrix(arm, &q).concat(), &wanted, 1e-10);
        let pulled = of("pulled");
        close(
            &format!("{name}, direct"),
            &direct_dynamics(arm, &q, &qd, &pulled, None).unwrap(),
            &of("direct"),
            1e-7,
        );
        if let Some(by_bodies) = articulated_bodies(arm, &q, &qd, &pulled) {
            bodies += 1;
            close(&format!("{name}, by bodies"), &by_bodies.unwrap(), &of("direct"), 1e-7);
        }
        // Programs of the whole tree.
        let mut exact = OfTree::<Expr>::exact(&m).unwrap_or_else(|e| panic!("{name}: {e}"));
        exact.dynamics.drives.iter_mut().for_each(|d| *d = denavit::dynamics::Drive::nothing());
        let all = DynamicPrograms::of_tree(&exact, Masses::Numbers);
        assert!(!matches!(all.model.ground, Ground::Failed), "{name}");
        let run = |f: F, x: &[f64]| all.program(f).unwrap().program.compile(&[]).scalar().eval(x).to_vec();
        let state = [&q[..], &qd, &qdd].concat();
        close(&format!("{name}, program of torques"), &run(F::Torque, &state), &of("tau"), 1e-10);
        close(&format!("{name}, program of A"), &run(F::Inertia, &q), &wanted, 1e-10);
        let driven = [&q[..], &qd, &pulled].concat();
        close(
            &format!("{name}, program of accelerations"),
            &run(F::Acceleration, &driven),
            &of("direct"),
            1e-7,
        );
        let energy = |key: &str| tree["sample"][key].as_f64().unwrap();
        close(&format!("{name}, T"), &[kinetic_energy(arm, &q, &qd)], &[energy("T")], 1e-10);
        close(&format!("{name}, V"), &[potential_energy(arm, &q)], &[energy("V")], 1e-10);
    }
    assert!(bodies > 0, "articulated bodies are compared");
}

/// A tree that is a chain is the chain; the regressor, C and the momentum fit the rest on one with branches.
#[test]
fn models_of_a_tree_fit_together() {
    let m = mechanism("z1");
    let tip = m.bodies[*m.leaves().last().unwrap()].name.clone();
    let of_tree = OfTree::new(&m).unwrap().dynamics;
    let chain = m.chain(None, Some(&tip), Convention::Khalil).unwrap();
    let chain = Dynamics::numeric(&chain.description).unwrap();
    assert_eq!(chain.joints(), of_tree.joints());
    let [q, qd, qdd] = [0.3, -0.7, 1.1].map(|x| vec![x; chain.joints()]);
    let both = [&of_tree, &chain].map(|arm| inverse_dynamics(arm, &q, &qd, &qdd, None));
    close("z1", &both[0], &both[1], 1e-10);
    let arm = OfTree::new(&mechanism("solo12")).unwrap().dynamics;
    let n = arm.joints();
    assert!(arm.links.iter().enumerate().any(|(k, l)| l.parent != k.checked_sub(1)), "it has branches");
    let mut random = Random(8);
    let [q, qd, qdd] = [(); 3].map(|()| (0..n).map(|_| 2.0 * random.unit() - 1.0).collect::<Vec<f64>>());
    let chi: Vec<f64> = arm.links.iter().flat_map(|l| l.body.parameters()).collect();
    let rest: Vec<f64> =
        arm.drives.iter().map(|d| d.rotor).chain(arm.drives.iter().map(|d| d.viscous)).collect();
    let chi = [chi, rest].concat();
    let by: Vec<f64> = regressor(&arm, &q, &qd, &qdd)
        .iter()
        .map(|row| row.iter().zip(&chi).map(|(w, x)| w * x).sum())
        .collect();
    let torques = inverse_dynamics(&arm, &q, &qd, &qdd, None);
    close("Wχ", &by, &torques, 1e-11);
    let times = |matrix: &[Vec<f64>], x: &[f64]| -> Vec<f64> {
        matrix.iter().map(|row| row.iter().zip(x).map(|(a, b)| a * b).sum()).collect()
    };
    let (pulled, turned) =
        (times(&inertia_matrix(&arm, &q), &qdd), times(&coriolis_matrix(&arm, &q, &qd), &qd));
    let rubbed = arm.drives.iter().zip(&qd).map(|(d, v)| d.viscous * v);
    let sum: Vec<f64> = pulled
        .iter()
        .zip(&turned)
        .zip(gravity_torques(&arm, &q))
        .zip(rubbed)
        .map(|(((a, b), c), d)| a + b + c + d)
        .collect();
    close("A q̈ + C q̇ + Q", &sum, &torques, 1e-11);
    // The rate of the centre of mass.
    let found = momentum(&arm, &q, &qd);
    let at = |t: f64| {
        let moved: Vec<f64> = q.iter().zip(&qd).map(|(q, v)| q + t * v).collect();
        momentum(&arm, &moved, &qd).centre
    };
    let rate = (at(1e-5) - at(-1e-5)).scale(found.mass / 2e-5);
    close("momentum", &found.linear.0, &rate.0, 1e-6);
}

/// Derivatives of whole trees, joints that follow others among them, against differences.
#[test]
fn derivatives_of_trees_are_slopes() {
    let peers: Value = serde_json::from_str(include_str!("../peers/dynamics_trees.json")).unwrap();
    let mut random = Random(77);
    for tree in peers["trees"].as_array().unwrap() {
        let name = tree["name"].as_str().unwrap();
        let arm = OfTree::new(&mechanism(name)).unwrap().dynamics;
        let n = arm.joints();
        let mut any =
            |size: f64| -> Vec<f64> { (0..n).map(|_| size * (2.0 * random.unit() - 1.0)).collect() };
        let (q, qd, qdd) = (any(1.0), any(0.5), any(1.0));
        let found = torque_derivatives(&arm, &q, &qd, &qdd);
        let torque = |q: &[f64], qd: &[f64], qdd: &[f64]| inverse_dynamics(&arm, q, qd, qdd, None);
        let at = |all: &[f64], k: usize, h: f64| {
            let mut all = all.to_vec();
            all[k] += h;
            all
        };
        let h = 1e-5;
        let column = |k: usize, of: &dyn Fn(f64) -> Vec<f64>, rows: &[Vec<f64>], what: &str| {
            let slope: Vec<f64> = of(h).iter().zip(of(-h)).map(|(a, b)| (a - b) / (2.0 * h)).collect();
            let own: Vec<f64> = rows.iter().map(|row| row[k]).collect();
            close(&format!("{name}, {what} {k}"), &own, &slope, 1e-5);
        };
        for k in 0..n {
            column(k, &|h| torque(&at(&q, k, h), &qd, &qdd), &found.by_q, "q");
            column(k, &|h| torque(&q, &at(&qd, k, h), &qdd), &found.by_qd, "qd");
            column(k, &|h| torque(&q, &qd, &at(&qdd, k, h)), &found.by_third, "qdd");
        }
    }
}

/// Every function of a whole tree as a program is what the algorithms give in numbers, with the links' numbers in it or as
/// parameters of links or base parameters; joints that follow others and drives among them.
#[test]
fn programs_of_trees_compute_what_numbers_do() {
    for (name, ground) in [
        ("double_pendulum", Some(Ground::Proved)),
        ("finger_edu", None),
        ("ur5_gripper", None),
        ("bolt", Some(Ground::Modulo(3))),
        ("solo12", Some(Ground::Modulo(3))),
    ] {
        let m = mechanism(name);
        let arm = OfTree::new(&m).unwrap().dynamics;
        let exact = OfTree::<Expr>::exact(&m).unwrap();
        let n = arm.joints();
        let mut random = Random(9);
        let mut any = || -> Vec<f64> { (0..n).map(|_| 2.0 * random.unit() - 1.0).collect() };
        let (q, qd, third) = (any(), any(), any());
        let torques = drive_torques(&arm, &q, &qd, &third, None);
        let slopes = torque_derivatives(&arm, &q, &qd, &third);
        let accelerations = direct_dynamics(&arm, &q, &qd, &third, None).unwrap();
        let driven = acceleration_derivatives(&arm, &q, &qd, &third).unwrap();
        let beside = |first: Option<&Vec<f64>>, of: &denavit::dynamics::Slopes| -> Vec<f64> {
            let row = |j: usize| {
                let own: Vec<f64> = first.iter().map(|all| all[j]).collect();
                [&own[..], &of.by_q[j], &of.by_qd[j], &of.by_third[j]].concat()
            };
            (0..n).flat_map(row).collect()
        };
        for masses in [Masses::Numbers, Masses::Links, Masses::Base] {
            let all = DynamicPrograms::of_tree(&exact, masses);
            let found = all.model.ground;
            assert!(found != Ground::Failed, "{name}");
            if let (Some(ground), Masses::Numbers) = (ground, masses) {
                assert_eq!(found, ground, "{name}");
            }
            let (base, formulas) = (&all.model.base, &all.model.formulas);
            let value = |s: &denavit_symbolic::Symbol| {
                let grouped = base.parameters.iter().find(|p| p.is_grouped && p.symbol == *s);
                grouped.map_or_else(|| formulas.value(*s), |p| base.value(formulas, p)).expect("a value")
            };
            for f in F::ALL {
                let Ok(program) = all.program(f) else {
                    assert_eq!((f, masses), (F::Energy, Masses::Base), "{name}");
                    continue;
                };
                assert!(all.ground(f, &program) != Ground::Failed, "{name}, {f:?}");
                let values: Vec<f64> = program.program.parameters().iter().map(value).collect();
                let x = [&q[..], &qd, &third].concat();
                let x = &x[..program.program.variables().len()];
                let found = program.program.compile(&values).scalar().eval(x).to_vec();
                let wanted = match f {
                    F::Torque => torques.clone(),
                    F::Inertia => inertia_matrix(&arm, &q).concat(),
                    F::Bias => drive_torques(&arm, &q, &qd, &vec![0.0; n], None),
                    F::Gravity => gravity_torques(&arm, &q),
                    F::Acceleration => accelerations.clone(),
                    F::Energy => vec![kinetic_energy(&arm, &q, &qd), potential_energy(&arm, &q)],
                    F::TorqueDerivatives => beside(None, &slopes),
                    F::AccelerationDerivatives => beside(None, &driven),
                    F::TorqueWithDerivatives => beside(Some(&torques), &slopes),
                    F::AccelerationWithDerivatives => beside(Some(&accelerations), &driven),
                };
                let tolerance = if f.is_driven() { 1e-8 } else { 1e-11 };
                close(&format!("{name}, {masses:?}, {f:?}"), &found, &wanted, tolerance);
            }
        }
    }
}

/// A tree that falls keeps its energy.
#[test]
fn a_tree_falls() {
    let mut arm = OfTree::new(&mechanism("baxter")).unwrap().dynamics;
    arm.drives.iter_mut().for_each(|d| (d.viscous, d.coulomb) = (0.0, 0.0));
    let n = arm.joints();
    let acting = Acting { torques: Torques::constant(vec![0.0; n]), wrench: None };
    let state = (vec![0.2; n], vec![0.0; n]);
    let how = Method::Adaptive { tolerance: 1e-8 };
    let found = simulate(&arm, (&state.0, &state.1), &acting, (0.1, 0.05), how)
        .unwrap_or_else(|(why, _)| panic!("{why}"));
    let (drift, size) = found.drift();
    assert!(size > 0.1 && drift < 1e-5 * size, "{drift:e} of {size}");
}

/// What a tree does not say is not guessed.
#[test]
fn trees_without_numbers_are_refused() {
    let of =
        |text: &str| OfTree::new(&read_urdf(text, Decimals::AsWritten).unwrap().0).map(|t| t.joints.len());
    let links = "<link name='a'/><link name='b'/><joint name='j' type='revolute'><parent link='a'/><child link='b'/>\
                 <axis xyz='0 1 0'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint>";
    assert_eq!(of(&format!("<robot name='r'>{links}</robot>")), Err(Unknown::NoMasses));
    let heavy = links.replace(
        "<link name='b'/>",
        "<link name='b'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>",
    );
    assert_eq!(of(&format!("<robot name='r'>{heavy}</robot>")), Ok(1));
    // What weighs, but not how much.
    let mut m = read_urdf(&format!("<robot name='r'>{links}</robot>"), Decimals::AsWritten).unwrap().0;
    m.bodies.iter_mut().filter(|b| b.name == "b").for_each(|b| b.is_unweighed = true);
    assert_eq!(OfTree::new(&m).map(|t| t.joints.len()), Err(Unknown::Unweighed("b".into())));
}
