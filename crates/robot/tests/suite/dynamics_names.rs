//! Names of what is computed are no names of parameters, whatever these are called.

use crate::common::{Random, share};
use denavit::description::{Description, read_toml};
use denavit::dynamics::{
    DynamicFunction, DynamicModel, DynamicPrograms, Formulas, Ground, Masses, Recursion,
};
use denavit::forward::{ForwardModel, Outputs, Proof};
use denavit_program::Program;
use std::collections::BTreeSet;

/// What programs call their values and results.
const TEMPTING: [&str; 30] = [
    "m1", "m2", "m3", "m4", "m5", "m6", "t1", "t2", "t3", "sa1", "ca1", "w2z", "w2hz", "wd2hz", "w3hz",
    "wd3hz", "qd1", "qdd2", "MXP2", "MYP2", "MXR1", "ZZR1", "ZZ1", "MX2", "a2x", "f2x", "n2z", "U2_11",
    "x2y", "p1x",
];

/// Three turning joints, masses, centres and lengths called by names that are drawn.
fn arm(random: &mut Random) -> Description {
    let mut names: Vec<&str> = TEMPTING.to_vec();
    let mut given = String::new();
    let mut name = || {
        let name = names.swap_remove((random.unit() * names.len() as f64) as usize % names.len());
        given += &format!("{name} = ''\n");
        name
    };
    let twists = ["0", "90deg", "0"];
    let rows: String = (1..=3)
        .map(|k| {
            let (a, mass, x, zz) = (name(), name(), name(), name());
            format!(
                "[[joints]]\nalpha = '{}'\na = '{a}'\ntheta = 'q{k}'\nmass = '{mass}'\ncom = ['{x}', 0, 0]\ninertia = [0, 0, 0, '{zz}', 0, '{zz}']\n",
                twists[k - 1]
            )
        })
        .collect();
    let text =
        format!("name = 'n'\nconvention = 'craig'\ngravity = [0, '-9.81', 0]\n[parameters]\n{given}{rows}");
    read_toml(&text).unwrap_or_else(|e| panic!("{text}\n{e:?}")).0
}

/// Names are the program's own, none is a parameter's, none twice.
#[track_caller]
fn is_apart(what: &str, program: &Program, given: &BTreeSet<String>) {
    let mut own = BTreeSet::new();
    for step in program.steps() {
        assert!(!given.contains(&step.name), "{what}: {} of {given:?}", step.name);
        assert!(own.insert(step.name.clone()), "{what}: {} twice", step.name);
    }
}

#[test]
fn names_of_values_are_no_parameters() {
    for round in 0..share(60, 8) {
        let mut random = Random(9000 + round as u64);
        let d = arm(&mut random);
        let given: BTreeSet<String> = d.parameters.iter().map(|p| p.symbol.name().to_string()).collect();
        let model = DynamicModel::derive(&d);
        assert_eq!(model.ground, Ground::Proved, "{given:?}");
        is_apart("torques", &model.torques, &given);
        let state = [&model.formulas.q[..], &model.formulas.qd, &model.formulas.qdd].concat();
        let base = model.base.parameters.iter().filter(|p| p.is_grouped).map(|p| p.symbol);
        let own: BTreeSet<String> = state.into_iter().chain(base).map(|s| s.name().to_string()).collect();
        assert!(own.is_disjoint(&given), "{own:?} {given:?}");
        let formulas = Formulas::named(&d);
        let recursion = Recursion::derive(&d, &formulas, &model.base);
        assert_eq!(recursion.ground, Ground::Proved, "{given:?}");
        let steps = recursion
            .outward
            .iter()
            .flat_map(|o| &o.steps)
            .chain(recursion.inward.iter().flat_map(|i| &i.steps));
        for (symbol, _) in steps.chain(&recursion.torques) {
            assert!(!given.contains(&*symbol.name()), "{symbol:?} {given:?}");
        }
        let forward = ForwardModel::of_tool(&d, Outputs::ALL);
        assert_eq!(forward.proof, Proof::Proved, "{given:?}");
        is_apart("forward", &forward.algorithm, &given);
        for masses in [Masses::Links, Masses::Base] {
            let programs = DynamicPrograms::new(&d, masses).unwrap();
            for function in [DynamicFunction::Torque, DynamicFunction::Inertia, DynamicFunction::Bias] {
                let made = programs.program(function).unwrap();
                let read: BTreeSet<String> =
                    made.program.parameters().iter().map(|s| s.name().to_string()).collect();
                is_apart("programs", &made.program, &read);
            }
        }
    }
}
