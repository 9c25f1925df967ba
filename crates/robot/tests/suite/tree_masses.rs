//! What rows and bodies of trees weigh on a chain.

use crate::common::Random;
use crate::trees::{apart, tree};
use denavit::description::{Convention, Decimals, Described, Description, Unweighed, read_robot, read_urdf};
use denavit::dynamics::{Dynamics, inverse_dynamics};
use denavit::robot::Robot;
use denavit_symbolic::{Expr, Rational};

/// What hangs beside a chain weighs on it: rows, and the same tree as bodies, have the same torques, and the same joints are held.
#[test]
fn branches_weigh_on_the_chain() {
    let mut random = Random(31);
    let mut held = 0;
    for _ in 0..20 {
        let mut text = String::from("name = \"t\"\nconvention = \"khalil\"\ngravity = [0, 0.5, -9.8]\n");
        let rows = 7;
        let cells: Vec<[String; 6]> =
            (0..rows).map(|_| std::array::from_fn(|_| format!("{:.3}", 2.0 * random.unit() - 1.0))).collect();
        let mut below = |n: usize| (random.unit() * n as f64) as usize;
        let mut moving = 0;
        for (j, [a, b, c, x, y, z]) in cells.iter().enumerate() {
            let after = if j < 3 { j } else { below(j + 1) };
            let (theta, d) = match below(4) {
                0 if j > 0 => (a.clone(), b.clone()),
                1 => (a.clone(), {
                    moving += 1;
                    format!("\"q{moving} + {b}\"")
                }),
                _ => (
                    {
                        moving += 1;
                        format!("\"q{moving} + {a}\"")
                    },
                    b.clone(),
                ),
            };
            text += &format!(
                "[[joints]]\nname = \"r{j}\"\nafter = {after}\ntheta = {theta}\nr = {d}\nd = {c}\nalpha = {x}\n"
            );
            if below(4) > 0 {
                text += &format!(
                    "mass = 1.5\ncom = [{x}, {y}, {z}]\ninertia = [0.3, 0.01, 0.02, 0.25, 0.03, 0.35]\n"
                );
            }
        }
        let tree = tree(&text);
        let m = tree.mechanism().unwrap();
        for tip in tree.tips() {
            let Ok(by_rows) = tree.chain(None, Some(&tip), Convention::Khalil) else { continue };
            let by_bodies = m.chain(None, Some(&tip), Convention::Khalil).unwrap();
            let names: Vec<&String> = by_bodies.held.iter().map(|&j| &m.joints[j].name).collect();
            assert_eq!(by_rows.held.iter().collect::<Vec<_>>(), names, "{tip} in {text}");
            held += names.len();
            let n = by_rows.description.variables().len();
            let mut list = || -> Vec<f64> { (0..n).map(|_| 2.0 * random.unit() - 1.0).collect() };
            let [q, qd, qdd] = [list(), list(), list()];
            let torques = |d: &Description| match Dynamics::numeric(d) {
                Ok(arm) => inverse_dynamics(&arm, &q, &qd, &qdd, None),
                Err(_) => vec![0.0; n],
            };
            let (rows, bodies) = (torques(&by_rows.description), torques(&by_bodies.description));
            for (a, b) in rows.iter().zip(&bodies) {
                assert!((a - b).abs() < 1e-10, "{tip}: {rows:?} {bodies:?} in {text}");
            }
        }
    }
    assert!(held > 20, "{held}");
}

/// What moves with the chain beside it is not counted as if it stood still: the rows have no masses then, and it is said.
#[test]
fn what_moves_beside_the_chain_is_not_weighed_as_fixed() {
    let link = |name: &str| {
        format!(
            "<link name='{name}'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>"
        )
    };
    let joint = |name: &str, on: &str, to: &str, more: &str| {
        format!(
            "<joint name='{name}' type='continuous'><parent link='{on}'/><child link='{to}'/><origin xyz='1 0 0'/><axis xyz='0 1 0'/>{more}</joint>"
        )
    };
    let links: String = ["b", "l1", "l2", "l3"].map(link).concat();
    let arm = joint("j1", "b", "l1", "") + &joint("j2", "l1", "l2", "");
    let file = |more: &str| format!("<robot name='r'>{links}{arm}{}</robot>", joint("j3", "l1", "l3", more));
    let mimics = read_urdf(&file("<mimic joint='j2' multiplier='2'/>"), Decimals::Meant).unwrap().0;
    let chain = mimics.chain(None, Some("l2"), Convention::Standard).unwrap();
    assert_eq!(chain.unweighed, Some(Unweighed::Joint("j3".into())));
    assert!(!chain.description.has_masses());
    // By itself it can be held where it is, and is named.
    let alone = read_urdf(&file(""), Decimals::Meant).unwrap().0;
    let chain = alone.chain(None, Some("l2"), Convention::Standard).unwrap();
    assert!(chain.unweighed.is_none() && chain.description.has_masses());
    assert_eq!(chain.held.len(), 1);
    // The same in rows.
    let rows = |theta: &str| {
        format!(
            "name = \"t\"\nconvention = \"khalil\"\n[[joints]]\nname = \"a\"\ntheta = \"q1\"\nmass = 1\n[[joints]]\nname = \"b\"\nd = 1\ntheta = \"q2\"\nmass = 1\n\
         [[joints]]\nname = \"c\"\nafter = \"a\"\nd = 1\ntheta = \"{theta}\"\nmass = 1\n"
        )
    };
    let chain = |theta: &str| tree(&rows(theta)).chain(None, Some("b"), Convention::Khalil).unwrap();
    assert_eq!(chain("2*q2").unweighed, Some(Unweighed::Joint("c".into())));
    assert!(!chain("2*q2").description.has_masses());
    assert!(chain("q3").unweighed.is_none() && chain("q3").held == ["c"]);
}

/// A joint with a gear that follows another, and masses, as bodies and joints.
#[test]
fn rows_become_bodies_with_their_masses() {
    let text = r#"
name = "wrist"
convention = "khalil"
[parameters]
l = "100 mm"
m = 2
[[joints]]
name = "first"
theta = "q1"
[[joints]]
name = "second"
d = "l"
theta = "q1 - 2*q2"
mass = "m"
com = ["l", 0, 0]
inertia = [1, 0, 0, 2, 0, 3]
[[joints]]
name = "plate"
after = "first"
alpha = "90 deg"
mass = 1
com = [0, 0, "l"]
inertia = [1, 0, 0, 1, 0, 1]
[[frames]]
name = "tip"
on = "second"
xyz = ["l", 0, 0]
"#;
    let (Described::Tree(tree), _) = read_robot(text).unwrap_or_else(|f| panic!("{f:?}")) else {
        panic!("a tree");
    };
    let m = tree.mechanism().unwrap();
    let named = |names: Vec<&str>| names.into_iter().map(str::to_string).collect::<Vec<_>>();
    let bodies: Vec<String> = m.bodies.iter().map(|b| b.name.clone()).collect();
    assert_eq!(bodies, named(vec!["base", "first", "second (1)", "second (2)", "second", "plate", "tip"]));
    let mass = |name: &str| m.bodies[m.body(name).unwrap()].mass.clone();
    let l = Expr::from(Rational::new(1, 10));
    assert_eq!(mass("second").map(|x| (x.mass, x.com[0])), Some((Expr::int(2), l)));
    assert_eq!(mass("plate").map(|x| x.com[2]), Some(l));
    assert!(mass("first").is_none());
    // The tip by its chain and by its body.
    let q = [0.3, -0.7];
    let tip = m.poses(&q)[m.body("tip").unwrap()];
    let chain = tree.chain(None, Some("tip"), Convention::Khalil).unwrap().description;
    let by_rows = Robot::numeric(&chain).unwrap().pose(&q);
    assert!(apart(&tip, &by_rows) < 1e-15, "{tip:?} {by_rows:?}");
}
