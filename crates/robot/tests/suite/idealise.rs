//! Nearly special arms: what becomes special, what that costs, and that nothing else moves.

use crate::common::robot;
use denavit::catalogue;
use denavit::description::{Description, read_toml};
use denavit::idealise::{Measured, idealised};
use denavit::inverse::{InverseModel, InverseOptions};
use denavit::robot::Robot;

/// The text of a robot file with some cells written otherwise.
fn changed(name: &str, changes: &[(&str, &str)]) -> Description {
    let mut text = catalogue::text(name).expect("a robot of the catalogue").to_string();
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    read_toml(&text).expect("a robot file").0
}

/// Nothing is special in an arm that is: the table in lines is the same function.
#[test]
fn what_is_special_stays() {
    for name in catalogue::names() {
        let description = robot(name);
        if Robot::numeric(&description).is_err() {
            continue;
        }
        let ideal = idealised(&description, 1e-7).expect("numbers");
        assert_eq!(ideal.snaps, [], "{name}");
        // Lengths are written to twelve decimals.
        assert!(ideal.rotation_error < 1e-8, "{name}: {}", ideal.rotation_error);
        assert!(ideal.position_error < 1e-8, "{name}: {}", ideal.position_error);
    }
}

/// A right angle written as 1.5708: its place is found, and the error is that of the rounding.
#[test]
fn rounded_right_angles() {
    let rounded = changed("ur10e", &[("\"90 deg\"", "1.5708"), ("\"-90 deg\"", "-1.5708")]);
    let ideal = idealised(&rounded, 1e-3).expect("numbers");
    let places: Vec<_> = ideal.snaps.iter().map(|s| (s.axes, s.what)).collect();
    assert_eq!(places, [((1, 2), Measured::Angle), ((4, 5), Measured::Angle), ((5, 6), Measured::Angle)]);
    assert!(ideal.rotation_error > 1e-6 && ideal.rotation_error < 3.0 * 3.7e-6, "{}", ideal.rotation_error);
    assert!(ideal.position_error < 1e-5, "{}", ideal.position_error);
    InverseModel::derive(&ideal.description, &InverseOptions::default()).expect("the closed form of a UR");
}

/// A calibrated arm: axes a milliradian off parallel have their common normal metres away, and the table says so.
#[test]
fn far_common_normals() {
    let tilted = changed(
        "ur10e",
        &[
            (
                "theta = \"q2\"\na = \"a2\"",
                "theta = \"q2 + 0.7\"\na = \"-0.3 m\"\nd = \"130 m\"\nalpha = 0.001",
            ),
            (
                "theta = \"q3\"\na = \"a3\"",
                "theta = \"q3 - 0.7\"\na = \"a3\"\nd = \"-129.9 m\"\nalpha = -0.002",
            ),
        ],
    );
    let ideal = idealised(&tilted, 1e-2).expect("numbers");
    assert!(ideal.rotation_error < 5e-3, "{}", ideal.rotation_error);
    assert!(ideal.position_error < 5e-3, "{}", ideal.position_error);
    InverseModel::derive(&ideal.description, &InverseOptions::default()).expect("the closed form of a UR");
    let lengths = Robot::numeric(&ideal.description).expect("numbers").reach();
    assert!(lengths < 5.0, "{lengths}");
}
