//! Recipes: what they are applied to is what the model says, and they read back as they were written.

use crate::made::{KINDS, NOMINAL, Noise, Setting, arm, make};
use denavit_recording::{HoldOptions, Recipe, Roles, Told, deviations, fixed, hold};

const ARMS: [&str; 4] = ["ur5", "franka-panda", "scara", "staubli-rx90"];

#[test]
fn what_is_fixed_is_clean() {
    for (k, kind) in KINDS.iter().enumerate() {
        // Another arm is not undone in columns, and a length neither.
        if ["variant", "length"].contains(kind) {
            continue;
        }
        let name = ARMS[k % ARMS.len()];
        let arm = arm(name);
        let made = make(name, &[kind], 4000 + k as u64, &NOMINAL);
        let held = hold(&arm, &made.recording, &made.roles, &HoldOptions::default()).expect("it can be held");
        let (fixed, _) = fixed(&made.recording, &made.roles, &held.recipe, &arm);
        let roles = Roles::find(&fixed, &arm, &Told::default()).expect("its names say what they are");
        let again = hold(&arm, &fixed, &roles, &HoldOptions::default()).expect("it can be held");
        assert_eq!(again.findings, [], "{name} {kind}: {:?}", held.findings);
        assert!(again.rho < 1.1, "{name} {kind}: {}", again.rho);
    }
}

/// Row by row the hand is off by what is left over, whatever the slip, those of the arm itself too; as the columns stand it is farther off.
#[test]
fn deviations_are_what_is_left_over() {
    for (k, kind) in KINDS.iter().enumerate() {
        let name = ARMS[k % ARMS.len()];
        let arm = arm(name);
        let made = make(name, &[kind], 4000 + k as u64, &NOMINAL);
        let held = hold(&arm, &made.recording, &made.roles, &HoldOptions::default()).expect("it can be held");
        let middle = |recipe: &Recipe| {
            let all = deviations(&made.recording, &made.roles, recipe, &arm);
            assert_eq!(all.len(), held.rows[0]);
            let mut shifts: Vec<f64> = all.iter().flatten().map(|o| o.shift).collect();
            shifts.sort_by(f64::total_cmp);
            shifts.get(shifts.len() / 2).copied()
        };
        let after = middle(&held.recipe).expect("rows");
        assert!(
            after < 2.0 * held.left_over.shift && after > 0.3 * held.left_over.shift,
            "{name} {kind}: {after} and {}",
            held.left_over.shift
        );
        let before = middle(&Recipe::plain(&made.recording, &made.roles, &arm));
        assert!(before.is_none_or(|b| b > 0.9 * after), "{name} {kind}: {before:?}, {after}");
    }
}

#[test]
fn without_noise_the_recipe_gives_the_poses() {
    let exact = Setting { noise: Noise(0.0, 0.0, 0.0), ..NOMINAL };
    let kinds = [
        "flip",
        "zero90",
        "swap",
        "mm",
        "inverse",
        "transposed",
        "mirror",
        "all-deg",
        "norm100",
        "couple",
        "reverse",
        "euler",
    ];
    for (k, kind) in kinds.iter().enumerate() {
        let name = ARMS[k % 2];
        let arm = arm(name);
        let made = make(name, &[kind], 5000 + k as u64, &exact);
        let held = hold(&arm, &made.recording, &made.roles, &HoldOptions::default()).expect("it can be held");
        let find = |c: &String| made.recording.columns.iter().find(|x| x.name == *c).expect("a column");
        let columns: Vec<_> = held.recipe.joints.iter().map(|j| find(&j.column)).collect();
        let position: Vec<_> = held.recipe.position.iter().map(find).collect();
        let rotation: Vec<_> = held.recipe.rotation.iter().map(find).collect();
        for r in (0..900).step_by(37) {
            let q = held.recipe.joints_of(&columns.iter().map(|c| c.values[r]).collect::<Vec<_>>());
            let at = [0, 1, 2].map(|i| position[i].values[r]);
            let turn: Vec<f64> = rotation.iter().map(|c| c.values[r]).collect();
            let pose = held.recipe.pose_of(at, &turn).expect("an orientation");
            let model = arm.pose(&q);
            let far = (pose.translation - model.translation).norm();
            assert!(far < 1e-9, "{name} {kind}, row {r}: {far}; {:?}", held.findings);
            let back = held.recipe.recorded(&model, Some(&turn));
            for (x, y) in back.0.iter().chain(&back.1).zip(at.iter().chain(&turn)) {
                assert!((x - y).abs() < 1e-8 * held.recipe.scale.max(1.0), "{name} {kind}, row {r}: {x} {y}");
            }
        }
    }
}

#[test]
fn recipes_read_back() {
    for (k, kind) in KINDS.iter().enumerate() {
        let name = ARMS[(k + 1) % ARMS.len()];
        let arm = arm(name);
        let made = make(name, &[kind], 6000 + k as u64, &NOMINAL);
        let held = hold(&arm, &made.recording, &made.roles, &HoldOptions::default()).expect("it can be held");
        let text = held.recipe.to_string();
        let read = Recipe::read(&text).unwrap_or_else(|e| panic!("{kind}: {e}\n{text}"));
        assert_eq!(read, held.recipe, "{kind}");
        assert_eq!(read.to_string(), text);
        assert_eq!(read.is_of(&arm).is_ok(), *kind != "variant" || held.recipe.robot == name);
    }
}

#[test]
fn a_recipe_is_of_one_table() {
    let ur5 = arm("ur5");
    let made = make("ur5", &["flip"], 1, &NOMINAL);
    let held = hold(&ur5, &made.recording, &made.roles, &HoldOptions::default()).expect("it can be held");
    assert!(held.recipe.is_of(&ur5).is_ok());
    assert!(held.recipe.is_of(&arm("ur5e")).is_err());
}

#[test]
fn what_is_no_recipe_is_refused() {
    let ur5 = arm("ur5");
    let made = make("ur5", &["couple", "stuck"], 3, &NOMINAL);
    let text =
        hold(&ur5, &made.recording, &made.roles, &HoldOptions::default()).expect("held").recipe.to_string();
    // Every line left out, and every text cut off, is refused or still a recipe; none panics.
    let lines: Vec<&str> = text.lines().collect();
    let mut refused = 0;
    for k in 0..lines.len() {
        let without: Vec<&str> = lines.iter().enumerate().filter(|l| l.0 != k).map(|l| *l.1).collect();
        refused += usize::from(Recipe::read(&without.join("\n")).is_err());
        let _ = Recipe::read(&lines[..k].join("\n"));
    }
    assert!(refused > 20, "{refused}");
}
