//! Dynamic functions as programs: beside the plain algorithms, Pinocchio, and one another.

use crate::common::{Random, numbers, robot};
use crate::dynamics::{ARMS, random_arm, state, with_bodies};
use denavit::description::{Description, read_toml};
use denavit::dynamics::{
    Drive, DynamicFunction as F, DynamicPrograms, Dynamics, Ground, Loads, Masses, NoProgram,
    acceleration_derivatives, direct_dynamics, drive_torques, torque_derivatives,
};
use denavit::geometry::{Body, PARAMETERS, Vector};
use denavit_program::Program;
use serde_json::Value;

/// The largest difference, by the size of the second.
#[track_caller]
fn close(what: &str, a: &[f64], b: &[f64], tolerance: f64) {
    assert_eq!(a.len(), b.len(), "{what}");
    let size = b.iter().fold(1e-3_f64, |m, x| m.max(x.abs()));
    let off = a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max) / size;
    assert!(off <= tolerance, "{what}: {off:e}\n{a:?}\n{b:?}");
}

fn is_conditioned(f: F) -> f64 {
    if f.is_driven() { 1e4 } else { 1.0 }
}

/// The lengths that are left, as the robot file has them.
fn lengths(d: &Description, program: &Program) -> Vec<f64> {
    program.parameters().iter().map(|s| d.value(*s).expect("a value")).collect()
}

/// Operations never grow: each is what was found, and no target is missed by more.
#[test]
fn counts_are_as_short_as_they_were_found() {
    for (name, function, most) in [
        ("staubli-rx90", F::Inertia, [105, 103]),
        ("staubli-rx90", F::Bias, [189, 175]),
        ("staubli-rx90", F::Gravity, [53, 31]),
        ("ur5", F::Inertia, [91, 105]),
        ("ur5", F::Acceleration, [353, 323]),
        ("franka-panda", F::Inertia, [161, 161]),
        ("scara", F::Inertia, [11, 16]),
        ("planar-2r", F::Inertia, [2, 4]),
    ] {
        let all = DynamicPrograms::new(&robot(name), Masses::Base).unwrap();
        let count = all.program(function).expect("no energy").program.count();
        let found = [count.multiplications, count.additions];
        assert!(found[0] + found[1] <= most[0] + most[1], "{name}, {function:?}: {found:?}");
    }
}

/// Torques and their derivatives in one pass: to rounding what the functions alone and the recursion over dual numbers give, and
/// with fewer operations; accelerations likewise.
#[test]
fn one_pass_is_shorter_than_two() {
    for name in ["planar-2r", "scara", "stanford", "ur5"] {
        let d = random_arm(name, 21);
        let arm = Dynamics::numeric(&d).expect("numbers");
        let all = DynamicPrograms::new(&d, Masses::Numbers).unwrap();
        let n = all.symbols[0].len();
        let [q, qd, third] = state(n, &mut Random(17));
        let tau = direct_dynamics(&arm, &q, &qd, &third, None).unwrap();
        for (both, values, slopes) in [
            (F::TorqueWithDerivatives, F::Torque, F::TorqueDerivatives),
            (F::AccelerationWithDerivatives, F::Acceleration, F::AccelerationDerivatives),
        ] {
            let [both_programs, values, slopes] =
                [both, values, slopes].map(|f| all.program(f).unwrap().program);
            let [cost, of_values, of_slopes] = [&both_programs, &values, &slopes].map(|p| p.count().cost());
            assert!(cost < of_values + of_slopes, "{name}, {both:?}: {cost} of {of_values} and {of_slopes}");
            let (x, of_plain) = if both.is_driven() {
                let found = acceleration_derivatives(&arm, &q, &qd, &third).unwrap();
                (tau.clone(), found)
            } else {
                let found = torque_derivatives(&arm, &q, &qd, &third);
                (drive_torques(&arm, &q, &qd, &third, None), found)
            };
            let inputs = [&q[..], &qd, &third].concat();
            let found = both_programs.compile(&lengths(&d, &both_programs)).scalar().eval(&inputs).to_vec();
            let wanted: Vec<f64> = (0..n)
                .flat_map(|j| {
                    [&[x[j]], &of_plain.by_q[j][..], &of_plain.by_qd[j], &of_plain.by_third[j]].concat()
                })
                .collect();
            close(&format!("{name}, {both:?}"), &found, &wanted, 1e-11 * is_conditioned(both));
        }
    }
}

/// The first state of each arm with Pinocchio's bodies: torques, matrices, accelerations and all first derivatives.
#[test]
fn programs_agree_with_pinocchio() {
    let read = |text: &str| -> Value { serde_json::from_str(text).unwrap() };
    let states = read(include_str!("../peers/dynamics.json"));
    let slopes = read(include_str!("../peers/dynamics_derivatives.json"));
    let (states, slopes) = (states["catalogue"].as_array().unwrap(), slopes["catalogue"].as_array().unwrap());
    let matrix = |v: &Value| -> Vec<Vec<f64>> { v.as_array().unwrap().iter().map(numbers).collect() };
    let mut derived = 0;
    for (one, slope) in states.iter().zip(slopes) {
        let name = one["name"].as_str().unwrap();
        assert_eq!(slope["name"], one["name"]);
        let d = with_bodies(one);
        let all = DynamicPrograms::new(&d, Masses::Numbers).unwrap_or_else(|e| panic!("{name}: {e}"));
        let of = |key: &str| numbers(&one["samples"][0][key]);
        let beside = |keys: [&str; 3]| -> Vec<f64> {
            let blocks = keys.map(|key| matrix(&slope[key]));
            (0..all.symbols[0].len())
                .flat_map(|i| blocks.iter().flat_map(|b| b[i].clone()).collect::<Vec<_>>())
                .collect()
        };
        let hold = |function: F, third: &str, wanted: Vec<f64>, tolerance: f64| {
            let program = all.program(function).expect("numbers tell all").program;
            let x = [of("q"), of("qd"), of(third)].concat();
            let mut scalar = program.compile(&lengths(&d, &program)).scalar();
            let found = scalar.eval(&x[..program.variables().len()]);
            close(&format!("{name}, {function:?}"), found, &wanted, tolerance);
        };
        hold(F::Torque, "qdd", of("tau"), 1e-10);
        hold(F::Inertia, "qdd", matrix(&one["samples"][0]["A"]).concat(), 1e-10);
        hold(F::Bias, "qdd", of("h"), 1e-10);
        hold(F::Gravity, "qdd", of("Q"), 1e-10);
        hold(
            F::Energy,
            "qdd",
            vec![one["samples"][0]["T"].as_f64().unwrap(), one["samples"][0]["V"].as_f64().unwrap()],
            1e-10,
        );
        hold(F::Acceleration, "pulled", of("direct"), 1e-9);
        // The recursion over dual numbers.
        let mut arm = Dynamics::numeric(&d).expect("numbers");
        let found = torque_derivatives(&arm, &of("q"), &of("qd"), &of("qdd"));
        for (key, own) in [("tau_q", &found.by_q), ("tau_qd", &found.by_qd), ("tau_qdd", &found.by_third)] {
            close(&format!("{name}, {key} in numbers"), &own.concat(), &matrix(&slope[key]).concat(), 1e-10);
        }
        if slope["qdd_q"].is_array() {
            let found = acceleration_derivatives(&arm, &of("q"), &of("qd"), &of("pulled")).expect("masses");
            for (key, own) in [("qdd_q", &found.by_q), ("qdd_qd", &found.by_qd), ("qdd_tau", &found.by_third)]
            {
                close(
                    &format!("{name}, {key} in numbers"),
                    &own.concat(),
                    &matrix(&slope[key]).concat(),
                    1e-9,
                );
            }
        }
        // Friction has derivatives, Coulomb's none.
        let rubs = Drive { rotor: 0.0, viscous: 0.7, coulomb: 3.0 };
        let before = arm.drives.clone();
        arm.drives.iter_mut().for_each(|d| *d = Drive { rotor: d.rotor, ..rubs });
        let rubbed = torque_derivatives(&arm, &of("q"), &of("qd"), &of("qdd"));
        for (j, before) in before.iter().enumerate() {
            let more = rubbed.by_qd[j][j] - found.by_qd[j][j];
            assert!((more - 0.7 + before.viscous).abs() < 1e-9, "{name}: {more}");
        }
        let behind = |values: &str, slopes: [&str; 3]| -> Vec<f64> {
            let (values, slopes) = (of(values), beside(slopes));
            let rows = slopes.chunks(3 * values.len());
            values.iter().zip(rows).flat_map(|(&v, row)| [&[v], row].concat()).collect()
        };
        let of_torques = ["tau_q", "tau_qd", "tau_qdd"];
        hold(F::TorqueDerivatives, "qdd", beside(of_torques), 1e-10);
        hold(F::TorqueWithDerivatives, "qdd", behind("tau", of_torques), 1e-10);
        if slope["qdd_q"].is_array() {
            derived += 1;
            let of_accelerations = ["qdd_q", "qdd_qd", "qdd_tau"];
            hold(F::AccelerationDerivatives, "pulled", beside(of_accelerations), 1e-9);
            hold(F::AccelerationWithDerivatives, "pulled", behind("direct", of_accelerations), 1e-9);
        }
    }
    assert_eq!((states.len(), derived), (28, 26));
}

/// Base parameters and numbers of links as arguments: the same torques as with the numbers in the program.
#[test]
fn numbers_may_be_arguments() {
    for name in ["scara", "stanford", "ur5"] {
        let d = random_arm(name, 9);
        let x = state(d.variables().len(), &mut Random(8)).concat();
        let plain = DynamicPrograms::new(&d, Masses::Numbers).unwrap();
        for masses in [Masses::Links, Masses::Base] {
            let all = DynamicPrograms::new(&d, masses).unwrap();
            let (base, formulas) = (&all.model.base, &all.model.formulas);
            let value = |s: &denavit_symbolic::Symbol| {
                let grouped = base.parameters.iter().find(|p| p.is_grouped && p.symbol == *s);
                grouped.map_or_else(|| formulas.value(*s), |p| base.value(formulas, p)).expect("a value")
            };
            for function in F::ALL {
                let program = match all.program(function) {
                    Ok(found) => found.program,
                    Err(why) => {
                        assert_eq!((why, masses, function), (NoProgram::Energy, Masses::Base, F::Energy));
                        continue;
                    }
                };
                let values: Vec<f64> = program.parameters().iter().map(value).collect();
                let of_numbers = plain.program(function).unwrap().program;
                let x = &x[..program.variables().len()];
                let wanted = of_numbers.compile(&lengths(&d, &of_numbers)).scalar().eval(x).to_vec();
                let found = program.compile(&values).scalar().eval(x).to_vec();
                close(
                    &format!("{name}, {masses:?}, {function:?}"),
                    &found,
                    &wanted,
                    1e-11 * is_conditioned(function),
                );
            }
        }
    }
    let bare = DynamicPrograms::new(&robot("ur5"), Masses::Numbers).map(|_| ());
    assert_eq!(bare, Err(denavit::dynamics::NoNumbers::NoMasses));
}

#[test]
fn programs_compute_what_plain_algorithms_do() {
    for name in ARMS {
        let d = random_arm(name, 77);
        let all = DynamicPrograms::new(&d, Masses::Numbers).unwrap();
        let mut random = Random(5);
        for f in F::ALL {
            let program = all.program(f).expect("numbers tell all").program;
            let reference = all.reference(f);
            assert_eq!(program.variables(), all.variables(f));
            let mut scalar = program.compile(&lengths(&d, &program)).scalar();
            let mut plain = reference.compile(&lengths(&d, &reference)).scalar();
            for _ in 0..3 {
                let x: Vec<f64> = state(all.symbols[0].len(), &mut random).concat();
                let x = &x[..program.variables().len()];
                close(&format!("{name}, {f:?}"), scalar.eval(x), plain.eval(x), 1e-11 * is_conditioned(f));
            }
        }
    }
}

/// Every evaluator gives the bits of the scalar one, and single precision what it can; signs of rates among the operations.
#[test]
fn every_evaluator_runs_them() {
    for name in ["planar-2r", "stanford", "ur5"] {
        let d = random_arm(name, 31);
        let all = DynamicPrograms::new(&d, Masses::Numbers).unwrap();
        for f in F::ALL {
            let program = all.program(f).expect("numbers tell all").program;
            let function = program.compile(&lengths(&d, &program));
            let (variables, results) = (program.variables().len(), program.outputs().len());
            let mut random = Random(31);
            let rows: Vec<Vec<f64>> = (0..101)
                .map(|_| state(all.symbols[0].len(), &mut random).concat()[..variables].to_vec())
                .collect();
            let mut scalar = function.scalar();
            let wanted: Vec<f64> = rows.iter().flat_map(|x| scalar.eval(x).to_vec()).collect();
            assert!(wanted.iter().all(|x| x.is_finite()), "{name}, {f:?}");

            let mut batch = vec![0.0; wanted.len()];
            function.batch::<f64>().run(&rows.concat(), &mut batch);
            assert_eq!(batch, wanted, "{name}, {f:?}");
            let mut block = function.block::<f64>();
            for (k, lanes) in rows.chunks(block.lanes()).enumerate() {
                for (lane, x) in lanes.iter().enumerate() {
                    x.iter().enumerate().for_each(|(j, v)| block.variable(j)[lane] = *v);
                }
                block.run();
                for lane in 0..lanes.len() {
                    let found: Vec<f64> = (0..results).map(|j| block.output(j)[lane]).collect();
                    let first = (k * block.lanes() + lane) * results;
                    assert_eq!(found, wanted[first..first + results], "{name}, {f:?}");
                }
            }

            let mut single = vec![0.0_f32; wanted.len()];
            let narrow: Vec<f32> = rows.concat().iter().map(|&x| x as f32).collect();
            function.batch::<f32>().run(&narrow, &mut single);
            for (row, (found, wanted)) in single.chunks(results).zip(wanted.chunks(results)).enumerate() {
                let found: Vec<f64> = found.iter().map(|&x| f64::from(x)).collect();
                close(&format!("{name}, {f:?}, row {row}"), &found, wanted, 1e-4 * is_conditioned(f));
            }
        }
    }
}

/// A that is not the derivative of the torques itself is proved to be it, and there is such a one.
#[test]
fn the_inertia_matrix_says_on_what_it_rests() {
    let mut by_bodies = 0;
    for name in ["planar-2r", "planar-3r", "scara", "staubli-rx90", "ur5"] {
        let all = DynamicPrograms::new(&robot(name), Masses::Base).unwrap();
        for f in [F::Inertia, F::Acceleration, F::TorqueDerivatives] {
            let found = all.program(f).unwrap();
            assert_eq!(found.inertia, Ground::Proved, "{name}, {f:?}");
            by_bodies += usize::from(found.by_bodies);
        }
    }
    assert!(by_bodies > 0);
}

/// What was shortened is held against what it was: polynomials are proved to be equal, quotients are equal at random states.
#[test]
fn shortened_programs_say_on_what_they_rest() {
    let mut sampled = 0;
    for name in ["stanford", "ur5"] {
        let all = DynamicPrograms::new(&robot(name), Masses::Base).unwrap();
        for f in [F::Torque, F::Inertia, F::Bias, F::Gravity] {
            let found = all.program(f).unwrap();
            assert_eq!(
                (found.shortening, all.ground(f, &found)),
                (Ground::Proved, Ground::Proved),
                "{name}, {f:?}"
            );
        }
        for f in [F::TorqueDerivatives, F::Acceleration, F::AccelerationDerivatives] {
            let found = all.program(f).unwrap();
            assert!(matches!(found.shortening, Ground::Proved | Ground::Modulo(3)), "{name}, {f:?}");
            assert_eq!(all.ground(f, &found), found.shortening, "{name}, {f:?}");
            sampled += usize::from(found.shortening != Ground::Proved);
        }
    }
    assert!(sampled > 0, "no quotient was shortened");
}

/// A wrench and a payload as arguments: as the plain algorithms have them, and the references; what holds the wrench is proved.
#[test]
fn loads_may_be_arguments() {
    for (name, masses) in [
        ("scara", Masses::Numbers),
        ("stanford", Masses::Links),
        ("ur5", Masses::Numbers),
        ("ur5", Masses::Base),
    ] {
        let d = random_arm(name, 12);
        let loads = Loads { wrench: true, payload: masses != Masses::Base };
        let all = DynamicPrograms::with_loads(&d, masses, loads).unwrap();
        assert_eq!(all.wrench_ground, Ground::Proved, "{name}");
        let n = all.symbols[0].len();
        let mut random = Random(21);
        let [q, qd, third] = state(n, &mut random);
        let w: Vec<f64> = (0..6).map(|_| 10.0 * random.unit() - 5.0).collect();
        let numbers: [f64; 10] =
            Body::about_centre(2.5, Vector([0.02, -0.03, 0.1]), [0.1, 0.01, 0.0, 0.2, 0.02, 0.15])
                .parameters();
        let payload = Body::of(if loads.payload { numbers } else { [0.0; 10] });
        let arm = Dynamics::numeric(&d).unwrap().carrying(&payload);
        let wrench = [Vector([w[0], w[1], w[2]]), Vector([w[3], w[4], w[5]])];
        let (base, formulas) = (&all.model.base, &all.model.formulas);
        let of_payload = |s: &denavit_symbolic::Symbol| {
            PARAMETERS.iter().position(|p| format!("{p}L") == *s.name()).map(|k| numbers[k])
        };
        let value = |s: &denavit_symbolic::Symbol| {
            let grouped = base.parameters.iter().find(|p| p.is_grouped && p.symbol == *s);
            let own = grouped.map_or_else(|| formulas.value(*s), |p| base.value(formulas, p));
            own.or_else(|| of_payload(s)).unwrap_or_else(|| panic!("{name}: {}", s.name()))
        };
        for f in F::ALL {
            let Ok(found) = all.program(f) else { continue };
            let [program, reference] = [found.program, all.reference(f)];
            assert_eq!(program.variables(), all.variables(f), "{name}, {f:?}");
            let state = [&q[..], &qd, &third][..f.reads()].concat();
            let x = if f.feels_wrench() { [&state[..], &w].concat() } else { state };
            let of = |p: &Program| {
                let values: Vec<f64> = p.parameters().iter().map(value).collect();
                p.compile(&values).scalar().eval(&x).to_vec()
            };
            let found = of(&program);
            if masses != Masses::Base {
                close(&format!("{name}, {f:?}"), &found, &of(&reference), 1e-10 * is_conditioned(f));
            }
            let wanted = match f {
                F::Torque => drive_torques(&arm, &q, &qd, &third, Some(&wrench)),
                F::Bias => drive_torques(&arm, &q, &qd, &vec![0.0; n], Some(&wrench)),
                F::Acceleration => direct_dynamics(&arm, &q, &qd, &third, Some(&wrench)).unwrap(),
                _ => continue,
            };
            close(&format!("{name}, {f:?}"), &found, &wanted, 1e-10 * is_conditioned(f));
        }
    }
}

/// A joint that moves no mass: no program divides by the 0 that its pivot is, seen at once or only when values are put in.
#[test]
fn accelerations_of_joints_without_mass_are_refused() {
    let light = "convention = 'craig'\n[[joints]]\ntheta = 'q1'\nmass = 1\ncom = ['1', 0, 0]\n[[joints]]\na = 1\ntheta = 'q2'\n";
    let twice = "convention = 'craig'\n[parameters]\nJ = ''\n[[joints]]\ntheta = 'q1'\n[[joints]]\ntheta = 'q2'\nmass = 1\n\
                 inertia = ['J', 0, 0, 'J', 0, 'J']\n";
    for (text, joint) in [(light, 1), (twice, 0)] {
        let d = read_toml(text).unwrap().0;
        let all = DynamicPrograms::new(&d, Masses::Numbers).unwrap();
        for f in [F::Acceleration, F::AccelerationDerivatives] {
            assert_eq!(all.program(f).map(|_| ()), Err(NoProgram::Singular(joint)), "{f:?}");
        }
        assert!(all.program(F::Inertia).is_ok());
    }
}

/// What programs divide by is said, parameter by parameter; the pivots of A are none of these.
#[test]
fn divisors_are_known() {
    let all = DynamicPrograms::new(&robot("planar-2r"), Masses::Links).unwrap();
    let of = |f| -> Vec<String> {
        all.program(f).unwrap().program.divisors().iter().map(ToString::to_string).collect()
    };
    let model = |d: &Description| -> Vec<String> {
        denavit::dynamics::DynamicModel::derive(d).divisors().iter().map(ToString::to_string).collect()
    };
    let mut flat = robot("planar-2r");
    flat.gravity = Some([0, -10, 0].map(denavit_symbolic::Expr::int));
    assert_eq!(model(&flat), ["a1"]);
    // The first pivot, from the tip, depends on parameters alone, here on one that is grouped.
    assert_eq!(of(F::Acceleration), ["ZZ2"]);
}

/// Numbers of links are arguments with --masses, whatever the lengths are: none stands in the program, and the torques are linear in each.
#[test]
fn numbers_of_links_are_arguments_beside_lengths_without_values() {
    let rows: String = [("a1", 2.0, -0.2), ("a2", 3.0, -0.1)]
        .iter()
        .zip(1..)
        .map(|((a, mass, x), k)| {
            format!(
                "[[joints]]\ntheta = 'q{k}'\na = '{a}'\nmass = '{mass}'\ncom = ['{x}', '0.01', 0]\ninertia = [0, 0, 0, '0.02', 0, '0.02']\n"
            )
        })
        .collect();
    for is_known in [true, false] {
        let [first, second] = if is_known { ["0.7 m", "0.5 m"] } else { [""; 2] };
        let lengths = format!("[parameters]\na1 = '{first}'\na2 = '{second}'\n");
        let text = format!("name = 'n'\nconvention = 'standard'\ngravity = [0, '-9.81', 0]\n{lengths}{rows}");
        let d = read_toml(&text).unwrap_or_else(|e| panic!("{text}\n{e:?}")).0;
        for (masses, wanted) in [
            (Masses::Links, &["M2", "ZZ1", "ZZ2", "MX1", "MX2", "MY1", "MY2"][..]),
            (Masses::Base, &["ZZR1", "MXR1", "ZZ2", "MX2", "MY1", "MY2"]),
        ] {
            let all = DynamicPrograms::new(&d, masses).unwrap();
            let program = all.program(F::Torque).unwrap().program;
            let mut names: Vec<String> = program
                .parameters()
                .iter()
                .map(|s| s.name().to_string())
                .filter(|n| n != "a1" && n != "a2")
                .collect();
            names.sort();
            let mut wanted: Vec<&str> = wanted.iter().copied().chain(["g"]).collect();
            wanted.sort_unstable();
            assert_eq!(names, wanted, "{masses:?}");
            if !is_known {
                continue;
            }
            // With what they are by the file the torques are those of the arm.
            let (base, formulas) = (&all.model.base, &all.model.formulas);
            let value = |s: &denavit_symbolic::Symbol| {
                let grouped = base.parameters.iter().find(|p| p.is_grouped && p.symbol == *s);
                grouped.map_or_else(|| formulas.value(*s), |p| base.value(formulas, p)).expect("a value")
            };
            let values: Vec<f64> = program.parameters().iter().map(value).collect();
            let x = [0.3, -0.8, 1.2, 0.4, -0.7, 0.9];
            let arm = Dynamics::numeric(&d).unwrap();
            let found = program.compile(&values).scalar().eval(&x).to_vec();
            close("torques", &found, &drive_torques(&arm, &x[..2], &x[2..4], &x[4..], None), 1e-12);
        }
    }
    // Names of one's own are the arguments.
    let own = "name = 'n'\nconvention = 'craig'\n[parameters]\nm = ''\nc = ''\n[[joints]]\ntheta = 'q1'\nmass = 'm'\ncom = ['c', 0, 0]\ninertia = [0, 0, 0, 0, 0, '0.02']\n[[joints]]\ntheta = 'q2'\nalpha = '90deg'\nmass = 3\ncom = ['0.1', 0, 0]\n";
    let d = read_toml(own).unwrap().0;
    let all = DynamicPrograms::new(&d, Masses::Links).unwrap();
    let names: Vec<String> = all.parameters().iter().map(|s| s.name().to_string()).collect();
    assert!(names.contains(&"m".to_string()) && names.contains(&"MX2".to_string()), "{names:?}");
    assert!(!names.iter().any(|n| n == "M1" || n == "ZZ1"), "{names:?}");
}
