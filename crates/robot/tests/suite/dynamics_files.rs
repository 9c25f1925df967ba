//! What robot files and URDF files say of masses and drives.

use crate::common::{Random, shown};
use crate::dynamics::{ARMS, random_arm, state};
use denavit::description::{Convention, Decimals, Mechanism, read_toml, read_urdf, write_toml, write_urdf};
use denavit::dynamics::{Dynamics, Formulas, NoNumbers, inverse_dynamics};
use denavit_symbolic::Expr;

/// What is written reads back to the same: every key of masses and drives.
#[test]
fn masses_are_written_and_read() {
    for (k, name) in ARMS.iter().enumerate() {
        let d = random_arm(name, 300 + k as u64);
        let text = write_toml(&d);
        let (back, findings) =
            read_toml(&text).unwrap_or_else(|e| panic!("{name}: {}", shown(&text, &e).join("\n")));
        assert!(findings.iter().all(|f| f.message != "the mass is negative"), "{findings:?}");
        assert_eq!(back.gravity, d.gravity, "{name}");
        for (a, b) in back.rows.iter().zip(&d.rows) {
            assert_eq!(a.body(), b.body(), "{name}");
            assert_eq!((a.rotor, a.viscous, a.coulomb), (b.rotor, b.viscous, b.coulomb), "{name}");
        }
    }
}

/// A chain of a URDF, written as a robot file and as a URDF, has the torques that it had.
#[test]
fn a_converted_file_has_the_same_torques() {
    let files = [
        ("panda", Some("panda_hand")),
        ("ur5_robot", Some("tool0")),
        ("kinova", Some("j2s6s200_end_effector")),
        ("so100", None),
        ("finger_edu", None),
    ];
    for (name, tip) in files {
        let path = format!("{}/tests/urdf/{name}.urdf", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"));
        let mechanism = read_urdf(&text, Decimals::Meant).unwrap().0;
        let d = mechanism.chain(None, tip, Convention::Khalil).unwrap().description;
        let arm = Dynamics::numeric(&d).unwrap();
        let [q, qd, qdd] = state(arm.joints(), &mut Random(17));
        let wanted = inverse_dynamics(&arm, &q, &qd, &qdd, None);
        let from_toml = read_toml(&write_toml(&d)).unwrap().0;
        let urdf = write_urdf(&Mechanism::of(&d).unwrap());
        let from_urdf = read_urdf(&urdf, Decimals::AsWritten).unwrap().0;
        let from_urdf = from_urdf.chain(None, None, Convention::Standard).unwrap().description;
        for (how, other) in [("toml", from_toml), ("urdf", from_urdf)] {
            let other = Dynamics::numeric(&other).unwrap();
            let found = inverse_dynamics(&other, &q, &qd, &qdd, None);
            let size = wanted.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            let off = found.iter().zip(&wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size;
            assert!(off < 1e-12, "{name} by {how}: {off:e}");
        }
    }
}

/// A robot that says nothing of masses has symbols, named as Khalil and Dombre name them, and no numbers.
#[test]
fn a_robot_without_masses_has_symbols() {
    let d = crate::common::robot("planar-2r");
    assert_eq!(Dynamics::numeric(&d).unwrap_err(), NoNumbers::NoMasses);
    let formulas = Formulas::new(&d);
    assert!(formulas.is_generic);
    let names: Vec<String> = formulas.parameters.iter().map(|p| p.symbol.name().to_string()).collect();
    for name in ["XX1", "ZZ1", "MX1", "MZ2", "M2", "g"] {
        assert!(names.iter().any(|n| n == name), "{name} in {names:?}");
    }
    assert_eq!(formulas.qd.iter().map(|s| s.name().to_string()).collect::<Vec<_>>(), ["qd1", "qd2"]);
    let g = formulas.parameters.iter().find(|p| *p.symbol.name() == *"g").unwrap();
    assert_eq!(g.number(), Some(9.81));
    assert_eq!(formulas.dynamics.gravity.0[2], -Expr::from(g.symbol));
}

/// Findings have their place, and name the link.
#[test]
fn what_no_body_has_is_said() {
    let rows = [
        (
            "mass = 1\ninertia = [1, 0, 0, 1, 0, 3]",
            vec![
                "6:11 warning: `upper`: no body has this inertia | of the moments about its principal axes none is larger than the \
             sum of the others",
            ],
        ),
        (
            "mass = 1\ninertia = [1, 2, 0, 1, 0, 1]",
            vec![
                "6:11 warning: `upper`: no body has this: the inertia about the centre of mass is not positive | products of inertia \
             have the sign of the tensor, XY = −∫xy dm",
            ],
        ),
        (
            "mass = 0\ncom = [0, 0, 1]\ninertia = [1, 0, 0, 1, 0, 1]",
            vec![
                "7:11 warning: `upper`: no body has this: its mass is 0, and the rest is not | give its mass",
            ],
        ),
        // Mass 2 at x = 1 has 2 of its own about y and z.
        (
            "mass = 2\nfirst_moment = [2, 0, 0]\ninertia_at_origin = [0, 0, 0, 1, 0, 1]",
            vec![
                "7:21 warning: `upper`: no body has this: the inertia about the centre of mass is not positive | products of inertia \
             have the sign of the tensor, XY = −∫xy dm",
            ],
        ),
        (
            "mass = 2\ncom = [1, 0, 0]\nfirst_moment = [2, 0, 0]",
            vec![
                "7:16 error: `first_moment` beside `com` | mass, com, inertia (about the centre of mass), or mass, first_moment, \
             inertia_at_origin",
            ],
        ),
        (
            "rotor = '-0.1 kg m^2'\nviscous = -1\ncoulomb = -2",
            vec![
                "5:9 error: rotor is negative",
                "6:11 error: viscous is negative",
                "7:11 error: coulomb is negative",
            ],
        ),
        ("mass = 2\nfirst_moment = [2, 0, 0]\ninertia_at_origin = [0, 0, 0, 2, 0, 2]", vec![]),
    ];
    for (keys, wanted) in rows {
        let text = format!("convention = 'craig'\n[[joints]]\nname = 'upper'\ntheta = 'q1'\n{keys}\n");
        let found = match read_toml(&text) {
            Ok((_, findings)) | Err(findings) => shown(&text, &findings),
        };
        assert_eq!(found, wanted, "{text}");
    }
    let text = "convention = 'craig'\n[[joints]]\nrotor = 1\nalpha = 1\n[[joints]]\ntheta = 'q1'\n";
    let found = read_toml(text).unwrap_err();
    assert!(
        shown(text, &found)[0].starts_with("3:9 error: `rotor` of a row without a joint variable"),
        "{found:?}"
    );
}

/// Masses of rows that do not move, of points, and of bodies without a place are in what is written.
#[test]
fn masses_of_all_rows_are_in_a_urdf() {
    let text = "convention = 'standard'\n[[joints]]\ntheta = 'q1'\nd = 0.3\nalpha = '90 deg'\nmass = 2\ninertia = [0.1, 0, 0, 0.2, 0, 0.15]\n\
                [[joints]]\ntheta = 'q2'\na = 0.4\nmass = 3\ncom = [-0.2, 0.01, 0]\n\
                [[joints]]\na = 0.1\nalpha = '-90 deg'\nmass = 1.5\ncom = [0.05, 0, 0.02]\ninertia = [0.01, 0.001, 0, 0.02, 0, 0.015]\n\
                [[joints]]\ntheta = 'q3'\nd = 0.2\nmass = 0.5\n[[joints]]\nd = 0.1\nmass = 0.7\ncom = [0.02, 0, 0.03]\n\
                inertia = [0.01, 0, 0, 0.01, 0, 0.01]\n";
    let d = read_toml(text).unwrap_or_else(|e| panic!("{}", shown(text, &e).join("\n"))).0;
    let arm = Dynamics::numeric(&d).unwrap();
    let urdf = write_urdf(&Mechanism::of(&d).unwrap());
    let back = read_urdf(&urdf, Decimals::AsWritten).unwrap().0;
    let back = back.chain(None, None, Convention::Standard).unwrap().description;
    let other = Dynamics::numeric(&back).unwrap();
    let mut random = Random(23);
    for _ in 0..20 {
        let [q, qd, qdd] = state(arm.joints(), &mut random);
        let wanted = inverse_dynamics(&arm, &q, &qd, &qdd, None);
        let found = inverse_dynamics(&other, &q, &qd, &qdd, None);
        for (a, b) in found.iter().zip(&wanted) {
            assert!((a - b).abs() < 1e-11, "{found:?} {wanted:?}");
        }
    }
}
