//! Whole trees, all joints at once.

use denavit::description::{Decimals, read_urdf};
use denavit::dynamics::{OfTree, drive_torques};
use denavit_identification::{Asked, Columns, Cutoff, Known, Model, Sought, identify};

/// Two arms on a torso that turns, one joint of which follows another.
const TREE: &str = r#"
<robot name="two_arms">
  <link name="base"/>
  <link name="torso"><inertial><origin xyz="0 0 0.2"/><mass value="8"/><inertia ixx="0.2" ixy="0" ixz="0" iyy="0.2" iyz="0" izz="0.1"/></inertial></link>
  <link name="left"><inertial><origin xyz="0.15 0.01 0"/><mass value="3"/><inertia ixx="0.01" ixy="0.001" ixz="0" iyy="0.04" iyz="0" izz="0.04"/></inertial></link>
  <link name="hand"><inertial><origin xyz="0.1 0 0.02"/><mass value="1"/><inertia ixx="0.002" ixy="0" ixz="0" iyy="0.005" iyz="0" izz="0.005"/></inertial></link>
  <link name="right"><inertial><origin xyz="0.2 0 0.03"/><mass value="2.5"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.03"/></inertial></link>
  <link name="finger"><inertial><origin xyz="0.02 0 0"/><mass value="0.2"/><inertia ixx="0.0001" ixy="0" ixz="0" iyy="0.0002" iyz="0" izz="0.0002"/></inertial></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="torso"/><axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="left_lift" type="revolute"><parent link="torso"/><child link="left"/><origin xyz="0 0.2 0.4"/><axis xyz="0 1 0"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="left_bend" type="revolute"><parent link="left"/><child link="hand"/><origin xyz="0.3 0 0"/><axis xyz="0 1 0"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="right_lift" type="revolute"><parent link="torso"/><child link="right"/><origin xyz="0 -0.2 0.4"/><axis xyz="0 1 0"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="grip" type="prismatic"><parent link="right"/><child link="finger"/><origin xyz="0.4 0 0"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/><mimic joint="left_bend" multiplier="0.1"/></joint>
</robot>
"#;

#[test]
fn a_tree_is_identified_as_an_arm_is() {
    let (m, _) = read_urdf(TREE, Decimals::Meant).expect("it reads");
    let (exact, numbers) = (OfTree::exact(&m).expect("masses"), OfTree::new(&m).expect("masses"));
    let sought = Sought { rotors: false, viscous: false, coulomb: false, offsets: true };
    let model = Model::of_tree(&exact, &numbers, sought).expect("a model");
    let n = model.joints();
    assert_eq!(n, 4);
    let wave = |j: usize, k: usize| {
        [0.5 / (k + 1) as f64, 0.7 + 0.61 * k as f64 + 0.13 * j as f64, 1.7 * j as f64 + k as f64]
    };
    let state = |t: f64| -> [Vec<f64>; 3] {
        let sum = |f: &dyn Fn([f64; 3]) -> f64| (0..n).map(|j| (0..4).map(|k| f(wave(j, k))).sum()).collect();
        [
            sum(&|[a, w, p]| a * (w * t + p).sin()),
            sum(&|[a, w, p]| a * w * (w * t + p).cos()),
            sum(&|[a, w, p]| -a * w * w * (w * t + p).sin()),
        ]
    };
    let mut dice = crate::made::Dice::new(3);
    let none = || vec![vec![]; n];
    let (mut q, mut qd, mut qdd, mut tau, mut time) = (none(), none(), none(), none(), vec![]);
    for r in 0..1500 {
        let t = f64::from(r) / 50.0;
        let [a, b, c] = state(t);
        let torques = drive_torques(&numbers.dynamics, &a, &b, &c, None);
        time.push(t);
        for j in 0..n {
            q[j].push(a[j]);
            qd[j].push(b[j]);
            qdd[j].push(c[j]);
            tau[j].push(torques[j] + 0.05 * dice.normal());
        }
    }
    let columns = Columns { time, starts: vec![], q, qd: Some(qd), qdd: Some(qdd), tau };
    let asked = Asked { cutoff: Cutoff::None, ..Asked::default() };
    let found = identify(&model, &columns, &asked).expect("motion");
    let bodies: Vec<_> = numbers.dynamics.links.iter().map(|l| l.body).collect();
    let base = model.base_of(&bodies);
    let mut worst = 0.0_f64;
    for (k, value) in base.iter().enumerate() {
        let Known::Value(x, s) = found.estimate.known[k] else { continue };
        worst = worst.max((x - value).abs() / s);
    }
    assert!(worst < 4.0, "{worst}");
    assert!(found.suspects.is_empty(), "{:?}", found.suspects);
}
