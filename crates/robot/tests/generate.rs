//! What the tests of generated inverse kinematics hold.

use denavit::generate::{Generated, Options, Wanted, generate};
use denavit::inverse::{self, Goal};
use denavit::{catalogue, description};
use denavit_program::emit::{Language, Precision};

fn generated(name: &str, goal: Goal, given: Option<Vec<usize>>) -> Generated {
    generated_for(catalogue::text(name).expect("the catalogue has it"), goal, given)
}

fn generated_for(text: &str, goal: Goal, given: Option<Vec<usize>>) -> Generated {
    let d = description::read_toml(text).expect("it can be read").0;
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

/// An angle with a value is put into the closed form, so that another one in the parameters would not be read.
#[test]
fn what_is_part_of_the_closed_form_is_said() {
    let text = include_str!("generated/symbols.toml");
    let found = generated_for(text, Goal::Pose, None);
    assert_eq!(found.inverse.expect("a closed form").assumed.len(), 1);
    assert!(
        found.files.iter().all(|f| f.text.contains("ik holds for alpha1 = ") || f.path.ends_with(".toml"))
    );
    let found = generated("ur5", Goal::Pose, None);
    assert!(found.inverse.expect("a closed form").assumed.is_empty());
    assert!(!found.files.iter().any(|f| f.text.contains("ik holds for")));
}

#[test]
fn an_arm_in_general_position_is_refused() {
    let found = generated("oblique-6r", Goal::Pose, None);
    assert!(found.inverse.is_none());
    assert!(found.refused.expect("a reason").starts_with("no closed form"));
    assert!(!found.files.is_empty(), "the forward model is there");
}
