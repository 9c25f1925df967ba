//! What the tests of generated functions hold.

use crate::packages;
use denavit::description::{Decimals, read_toml, read_urdf};
use denavit::dynamics::DynamicFunction;
use denavit::inverse::{self, Goal};
use denavit::{Description, catalogue};
use denavit_emit::Language;
use denavit_generate::{Generated, PackageOptions, Unable, Wanted, generate, generate_tree};

fn robot(name: &str) -> Description {
    catalogue::robot(name).expect("the catalogue has it")
}

fn symbols() -> Description {
    read_toml(include_str!("../robots/symbols.toml")).expect("it can be read").0
}

fn generated(name: &str, goal: Goal, given: Option<Vec<usize>>) -> Generated {
    generated_for(&robot(name), goal, given)
}

fn generated_for(d: &Description, goal: Goal, given: Option<Vec<usize>>) -> Generated {
    let inverse = inverse::InverseOptions { goal, given };
    functions(d, &[Wanted::Pose, Wanted::Inverse], inverse)
}

fn functions(d: &Description, wanted: &[Wanted], inverse: inverse::InverseOptions) -> Generated {
    generate(d, &options(Language::Python, wanted, inverse)).expect("nothing is fixed")
}

fn options(language: Language, wanted: &[Wanted], inverse: inverse::InverseOptions) -> PackageOptions {
    PackageOptions { inverse, name: None, ..packages::options(language, wanted) }
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
    let found = generated_for(&symbols(), Goal::Pose, None);
    assert_eq!(found.inverse.expect("a closed form").assumed.len(), 1);
    assert!(
        found.files.iter().all(|f| f.text.contains("solve holds for alpha1 = ") || f.path.ends_with(".toml"))
    );
    let found = generated("ur5", Goal::Pose, None);
    assert!(found.inverse.expect("a closed form").assumed.is_empty());
    assert!(!found.files.iter().any(|f| f.text.contains("solve holds for")));
}

#[test]
fn an_arm_in_general_position_is_refused_in_cuda() {
    let options = options(Language::Cuda, &[Wanted::Pose, Wanted::Inverse], Default::default());
    let found = generate(&robot("oblique-6r"), &options).expect("nothing is fixed");
    assert!(found.inverse.is_none());
    assert!(found.refused.expect("a reason").starts_with("no closed form"));
    assert!(!found.files.is_empty(), "the forward model is there");
}

/// Arms that slide, couplings, symbols without value, more joints than directions.
#[test]
fn jacobians_are_proved_to_be_derivatives() {
    let catalogue = ["stanford", "parallelogram-5r", "prrrrp", "franka-panda", "oblique-6r"];
    for d in catalogue.map(robot).into_iter().chain([symbols()]) {
        let found = functions(&d, &[Wanted::Jacobian, Wanted::JacobianAndPose], Default::default());
        assert!(found.functions.iter().all(|f| f.is_proved), "{:?}", found.functions);
    }
}

/// Both in one pass take one sine and cosine an angle, and fewer operations than one after the other.
#[test]
fn pose_and_jacobian_come_in_one_pass() {
    let d = robot("ur5");
    let wanted = |list: &[Wanted]| functions(&d, list, Default::default()).functions;
    let both = wanted(&[Wanted::Pose, Wanted::Jacobian]);
    assert_eq!(both.iter().map(|f| f.wanted).collect::<Vec<_>>()[2..], [Wanted::JacobianAndPose]);
    let [pose, jacobian, one_pass] = [0, 1, 2].map(|k| both[k].count);
    assert_eq!(one_pass.sincos, pose.sincos);
    assert!(one_pass.cost() < pose.cost() + jacobian.cost());
    assert_eq!(wanted(&[Wanted::Jacobian]).len(), 1);
    assert_eq!(wanted(&[Wanted::JacobianAndPose]).len(), 1);
}

/// A whole tree: functions of all its joints, by name, in every language; what only a chain has is refused.
#[test]
fn whole_trees_are_generated() {
    let m = read_urdf(include_str!("../../../robot/tests/urdf/solo12.urdf"), Decimals::AsWritten).unwrap().0;
    let functions =
        [DynamicFunction::Torque, DynamicFunction::Inertia, DynamicFunction::TorqueWithDerivatives];
    for language in Language::ALL {
        let options = PackageOptions {
            name: Some("solo".into()),
            ..packages::options(language, &functions.map(Wanted::Dynamic))
        };
        if language == Language::IkFast {
            let why = Unable::NotInInterface(options.functions[0]);
            assert_eq!(generate_tree(&m, &options).map(|_| ()), Err(why));
            continue;
        }
        let found = generate_tree(&m, &options).expect("it has masses");
        assert_eq!(found.functions.len(), 3);
        for f in &found.functions {
            assert!(
                f.claim.contains("equal to Lagrange's equations") && f.divides_by.is_empty(),
                "{}",
                f.claim
            );
        }
        let all: String = found.files.iter().map(|f| f.text.as_str()).collect();
        for word in ["A whole tree of", "FL_KFE on 2", "(HR_KFE)"] {
            assert!(all.contains(word), "{word}");
        }
        let chains = PackageOptions { functions: vec![Wanted::Pose], ..options };
        assert_eq!(generate_tree(&m, &chains).map(|_| ()), Err(Unable::OfChains(Wanted::Pose)));
    }
}
