//! What the tests of generated inverse kinematics hold.

use denavit::generate::{Generated, Options, Wanted, generate};
use denavit::inverse::{self, Goal};
use denavit::{catalogue, description};
use denavit_program::emit::{Language, Precision};

fn generated(name: &str, goal: Goal, given: Option<Vec<usize>>) -> Generated {
    let text = catalogue::text(name).expect("the catalogue has it");
    let d = description::read_toml(text).expect("the catalogue can be read").0;
    let options = Options {
        language: Language::Python,
        functions: vec![Wanted::Pose, Wanted::Inverse],
        inverse: inverse::Options { goal, given },
        precision: Precision::Double,
        name: None,
        fixed: false,
    };
    generate(&d, &options).expect("nothing is fixed")
}

/// Six random configurations and one a joint are in general position in all but one joint; where rounding decides how
/// many solutions a pose has, it is left out.
#[test]
fn most_poses_are_kept() {
    for (name, goal, least) in [
        ("ur5", Goal::Pose, 11),
        ("puma560", Goal::Pose, 11),
        ("stanford", Goal::Pose, 9),
        ("scara", Goal::Pose, 9),
        ("staubli-rx90", Goal::Pose, 11),
        ("cylindrical-wrist", Goal::Pose, 11),
        ("franka-panda", Goal::Pose, 11),
        ("planar-3r", Goal::Pose, 8),
        ("articulated-3r", Goal::Position, 8),
        ("rhino-xr3", Goal::PositionAndAxis, 9),
    ] {
        let found = generated(name, goal, None);
        let inverse = found.inverse.unwrap_or_else(|| panic!("{name}: {:?}", found.refused));
        assert!(inverse.vectors >= least, "{name}: {} poses", inverse.vectors);
    }
}

#[test]
fn what_is_zero_in_the_table_is_said() {
    let found = generated("puma560", Goal::Pose, None);
    let assumed = found.inverse.expect("a closed form").assumed;
    let text = &found.files.iter().find(|f| f.path == "puma560.py").expect("a module").text;
    assert_eq!(text.contains("ik holds for"), !assumed.is_empty());
}

#[test]
fn an_arm_in_general_position_is_refused() {
    let found = generated("oblique-6r", Goal::Pose, None);
    assert!(found.inverse.is_none());
    assert!(found.refused.expect("a reason").starts_with("no closed form"));
    assert!(!found.files.is_empty(), "the forward model is there");
}
