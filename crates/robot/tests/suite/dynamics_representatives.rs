//! Base parameters with other representatives: the same torques, minimal, and reasons where there are none.

use crate::common::{Random, robot};
use crate::dynamics_base::{base, differs, under};
use denavit::description::Description;
use denavit::dynamics::{
    BaseModel, DynamicModel, Fate, Formulas, Ground, Minimality, NoBasis, Representatives,
};
use denavit_symbolic::{Expr, Symbol, equal};

fn wanted(kept: &[&str], dropped: &[&str]) -> Representatives {
    let symbols = |all: &[&str]| all.iter().map(|s| Symbol::new(s)).collect();
    Representatives { kept: symbols(kept), dropped: symbols(dropped) }
}

fn shown(model: &BaseModel, name: &str) -> Expr {
    let found = model.parameters.iter().find(|p| *p.symbol.name() == *name);
    found.unwrap_or_else(|| panic!("{name} is none of {:?}", model.parameters)).value
}

/// YY2 in the place of XX2, and mass where Gautier and Khalil have a first moment: by hand.
#[test]
fn groupings_of_the_rx90_with_other_representatives() {
    let d = robot("staubli-rx90");
    let formulas = Formulas::named(&d);
    let model = BaseModel::derive_for(&d, &formulas, &wanted(&["YY6", "M4"], &["XX6"])).unwrap();
    assert_eq!(model.parameters.len(), 36);
    assert_eq!(model.minimality, Minimality::Proved);
    let s = Expr::symbol;
    // XXR6 = XX6 − YY6 with the other sign; M4 stands for the sum of the masses behind in the place of MY3, the nearest.
    assert!(equal(shown(&model, "YYR6"), s("YY6") - s("XX6")).is_equal());
    let by_mass = shown(&model, "MR4");
    let masses = s("M4") + s("M5") + s("M6");
    let lever = s("RL4");
    let value = masses + (s("MY3") + s("MZ4")) / lever;
    assert!(equal(by_mass, value).is_equal(), "{by_mass}");
    // What is divided by and multiplied with is neither.
    let near = shown(&model, "XXR3").to_string();
    assert!(!near.contains('/') && near.contains("XX3"), "{near}");
    assert!(model.parameters.iter().all(|p| !p.symbol.name().starts_with("XXR6")));
    for seed in 0..2 {
        assert!(!differs(&formulas, &model, seed));
    }
}

/// Programs in such parameters are short ones, and proved.
#[test]
fn programs_in_other_representatives() {
    let d = robot("articulated-3r");
    let model = DynamicModel::derive_for(&d, &wanted(&["YY2", "YY3"], &[])).unwrap();
    assert_eq!(model.ground, Ground::Proved);
    assert_eq!(model.base.parameters.len(), 15);
    for name in ["YYR2", "YYR3"] {
        let letters = name.replace('R', "");
        let other = Symbol::new(&letters.replace('Y', "X"));
        let value = shown(&model.base, name);
        assert!(
            value.symbols().contains(&Symbol::new(&letters)) && value.symbols().contains(&other),
            "{value}"
        );
    }
    let plain = DynamicModel::derive(&d);
    assert_eq!(plain.torques.count().cost(), model.torques.count().cost(), "what is constant is apart");
}

/// Random choices on arms of many kinds: the torques are what they were, the columns independent; what is refused is dependent.
#[test]
fn random_choices() {
    let mut random = Random(1991);
    let (mut chosen, mut dependent, mut needed) = (0, 0, 0);
    for name in ["staubli-rx90", "stanford", "scara", "planar-3r", "ur5", "prrrrp", "oblique-6r", "rail-puma"]
    {
        let (formulas, plain) = base(&under(robot(name), [0, 0, -1]));
        let d = under(robot(name), [0, 0, -1]);
        let has_effect = |f: &&(Symbol, Fate)| f.1 != Fate::WithoutEffect;
        let effective: Vec<Symbol> = plain.fates.iter().filter(has_effect).map(|f| f.0).collect();
        for _ in 0..6 {
            let mut draw = |below: usize| (random.unit() * below as f64) as usize;
            let mut some = |count: usize| -> Vec<Symbol> {
                (0..count).map(|_| effective[draw(effective.len())]).collect()
            };
            let (kept, dropped) = (some(3), some(1));
            let wanted = Representatives { kept, dropped };
            match BaseModel::derive_for(&d, &formulas, &wanted) {
                Ok(model) => {
                    chosen += 1;
                    holds(name, &formulas, &plain, &model, &wanted);
                }
                Err(NoBasis::Dependent(s, of)) => {
                    dependent += 1;
                    is_effect_of(name, &plain, s, of);
                }
                Err(NoBasis::Needed(s, _)) => {
                    needed += 1;
                    assert!(wanted.dropped.contains(&s), "{name}");
                }
                Err(NoBasis::Both(s)) => assert!(wanted.kept.contains(&s) && wanted.dropped.contains(&s)),
                Err(other) => panic!("{name}: {other}"),
            }
        }
    }
    assert!(chosen >= 16 && dependent + needed >= 2, "{chosen} {dependent} {needed}");
}

fn holds(name: &str, formulas: &Formulas, plain: &BaseModel, model: &BaseModel, wanted: &Representatives) {
    assert_eq!(model.minimality, Minimality::Proved, "{name}: {wanted:?}");
    assert_eq!(model.parameters.len(), plain.parameters.len(), "{name}: {wanted:?}");
    assert!(!differs(formulas, model, 7), "{name}: {wanted:?}");
    // Each one kept stands in one grouping alone, with 1 there; what was dropped stands for nothing by itself.
    let reading = |s: Symbol| model.parameters.iter().filter(move |p| p.value.symbols().contains(&s));
    for &s in &wanted.kept {
        let all: Vec<_> = reading(s).collect();
        assert_eq!(all.len(), 1, "{name}: {wanted:?}");
        let is_own = |x: Symbol| plain.fates.iter().any(|f| f.0 == x);
        let slope = all[0].value.substitute(|x| is_own(x).then_some(Expr::int(0)));
        let one = all[0].value.substitute(|x| (x == s).then_some(Expr::int(1))) - all[0].value;
        assert!(equal(slope, Expr::int(0)).is_equal(), "{name}: a sum of multiples");
        assert!(equal(one, Expr::int(1) - Expr::from(s)).is_equal(), "{name}: {wanted:?}");
    }
    for &s in &wanted.dropped {
        assert!(model.parameters.iter().all(|p| p.symbol != s), "{name}: {wanted:?}");
    }
}

/// By the groupings as they were: those of the parameter alone are those of what its effect is said to be.
fn is_effect_of(name: &str, plain: &BaseModel, s: Symbol, of: Expr) {
    let own = |x: Symbol| plain.fates.iter().any(|f| f.0 == x);
    for p in &plain.parameters {
        let alone = |one: Symbol| p.value.substitute(|x| own(x).then(|| Expr::int(i64::from(x == one))));
        let others: Vec<Symbol> = of.symbols().into_iter().filter(|x| own(*x)).collect();
        let sum = others.iter().fold(Expr::int(0), |sum, &x| {
            let k = of.substitute(|y| own(y).then(|| Expr::int(i64::from(y == x))));
            sum + k * alone(x)
        });
        assert!(equal(alone(s), sum).is_equal(), "{name}: {} and {of}", s.name());
    }
}

#[test]
fn what_is_no_choice() {
    let d: Description = robot("staubli-rx90");
    let formulas = Formulas::named(&d);
    let why = |kept: &[&str], dropped: &[&str]| {
        BaseModel::derive_for(&d, &formulas, &wanted(kept, dropped)).unwrap_err().to_string()
    };
    assert_eq!(why(&["XX9"], &[]), "the links have no parameter XX9");
    assert_eq!(why(&["XX2"], &["XX2"]), "XX2 cannot be kept and dropped");
    assert_eq!(why(&["XX1"], &[]), "XX1 has no effect on the torques: it represents nothing");
    assert_eq!(why(&[], &["XY6"]), "XY6 cannot be dropped: no other parameter stands for it");
    let all = why(&[], &["MX2", "M3", "M4", "M5", "M6"]);
    assert!(
        all.starts_with("MX2 cannot be dropped: all that could stand for it are dropped, too: M3"),
        "{all}"
    );
    // The mass at the elbow and the inertia about the shoulder have the same effect.
    let d = robot("planar-2r");
    let both = BaseModel::derive_for(&d, &Formulas::named(&d), &wanted(&["ZZ1", "M2"], &[])).unwrap_err();
    let words = "M2 cannot be kept with the others: its effect on the torques is theirs, a1^2*ZZ1";
    assert_eq!(both.to_string(), words);
}
