//! Chains through trees: what is proved of them, what stands still in them, and joints that follow others.

use denavit::Robot;
use denavit::description::{Agreement, Convention, Decimals, Mechanism, RowTree, read_urdf, write_tree};
use denavit::mechanism::{Tree, compare_chains};
use denavit_symbolic::Expr;

/// Numbers that are rounded on the way along a chain are not taken for exact behind it: not for a proof, not for 0, and not in print.
#[test]
fn what_is_rounded_stays_rounded() {
    let joint = |name: &str, parent: &str, child: &str, kind: &str, origin: &str| {
        format!(
            "<joint name='{name}' type='{kind}'><origin {origin}/><parent link='{parent}'/><child link='{child}'/>\
             <axis xyz='0 0 1'/></joint>"
        )
    };
    let of = |joints: &[String]| {
        let links: String = (0..=joints.len()).map(|i| format!("<link name='l{i}'/>")).collect();
        let text = format!("<robot name='r'>{links}{}</robot>", joints.concat());
        read_urdf(&text, Decimals::Meant).unwrap().0.chain(None, None, Convention::Standard).unwrap()
    };
    // A turn by 0.7 has no exact sine.
    let turned = of(&[
        joint("a", "l0", "l1", "fixed", "rpy='0 0 0.7'"),
        joint("b", "l1", "l2", "continuous", "xyz='0.1 0.02 0.3'"),
    ]);
    assert!(!matches!(turned.agreement, Agreement::Proved), "{:?}", turned.agreement);
    let d = &turned.description;
    let entries = [&d.base, &d.tool].into_iter().flat_map(|x| x.matrix().concat());
    let cells = d.rows.iter().flat_map(|r| [r.theta, r.d, r.a, r.alpha]);
    for e in entries.chain(cells) {
        assert!(e.to_string().len() <= 60, "{e}");
    }
    // There and back again: both joints are on one axis.
    let back = of(&[
        joint("a", "l0", "l1", "fixed", "rpy='0 0 0.7'"),
        joint("b", "l1", "l2", "continuous", "xyz='0.1 0.02 0.3'"),
        joint("c", "l2", "l3", "fixed", "xyz='0.2 0.1 0' rpy='0 0 1.3'"),
        joint("d", "l3", "l4", "fixed", "rpy='0 0 -1.3'"),
        joint("e", "l4", "l5", "fixed", "xyz='-0.2 -0.1 0'"),
        joint("f", "l5", "l6", "continuous", "xyz='0 0 0.4'"),
    ]);
    let a: Vec<String> = back.description.rows.iter().map(|r| r.a.to_string()).collect();
    assert!(a.iter().all(|a| a == "0"), "{a:?}");
}

/// What stands still elsewhere is another tree, and an end that is wrong says nothing of those behind it.
#[test]
fn ends_that_are_others_are_said_alone() {
    let text = |x: &str, kind: &str| {
        format!(
            "<robot name='r'><link name='a'/><link name='b'/><link name='c'/><link name='d'/>\
             <joint name='still' type='fixed'><origin xyz='{x} 0 0'/><parent link='a'/><child link='b'/></joint>\
             <joint name='p' type='{kind}'><parent link='a'/><child link='c'/><axis xyz='0 0 1'/>\
             <limit lower='-1' upper='1' effort='1' velocity='1'/></joint>\
             <joint name='q' type='continuous'><parent link='a'/><child link='d'/><axis xyz='0 0 1'/></joint></robot>"
        )
    };
    let of = |text: &str| read_urdf(text, Decimals::Meant).unwrap().0;
    let one = of(&text("0.1", "revolute"));
    let ends: Vec<(String, String)> = ["b", "c", "d"].map(|n| (n.to_string(), n.to_string())).to_vec();
    let with =
        |other: &Mechanism| compare_chains(Tree::Bodies(&one), &RowTree::of_mechanism(other).unwrap(), &ends);
    assert!(!with(&one).differ());
    let moved = with(&of(&text("0.3", "revolute")));
    assert!(moved.differ() && moved.most > 0.1, "{moved:?}");
    let sliding = with(&of(&text("0.1", "prismatic")));
    assert_eq!((sliding.others, sliding.proved), (1, 1), "{sliding:?}");
}

/// A chain that meets a joint which follows another before that other one: the row that introduces the variable names it.
#[test]
fn the_first_joint_on_the_way_is_the_variable() {
    let joint = |name: &str, links: [&str; 2], x: &str, more: &str| {
        format!(
            "<joint name='{name}' type='revolute'><parent link='{}'/><child link='{}'/><origin xyz='{x} 0 0'/><axis xyz='0 0 1'/>\
             {more}</joint>",
            links[0], links[1]
        )
    };
    let limits =
        |low: &str, high: &str| format!("<limit lower='{low}' upper='{high}' effort='1' velocity='2'/>");
    let text = format!(
        "<robot name='fingers'><link name='palm'/><link name='drive'/><link name='k'/>{}{}</robot>",
        joint("motor", ["palm", "drive"], "0", &limits("0", "1")),
        joint(
            "knuckle",
            ["palm", "k"],
            "0.03",
            &format!("{}<mimic joint='motor' multiplier='-2' offset='0.1'/>", limits("-2.5", "0.2"))
        ),
    );
    let m = read_urdf(&text, Decimals::AsWritten).unwrap().0;
    let chain = m.chain(Some("k"), Some("drive"), Convention::Standard).unwrap();
    let moving: Vec<_> = chain.description.rows.iter().filter(|r| r.name.is_some()).collect();
    let names: Vec<_> = moving.iter().map(|r| r.name.as_deref().unwrap_or_default()).collect();
    assert_eq!(names, ["knuckle", "motor"]);
    assert_eq!(chain.joints.iter().map(|&j| m.joints[j].name.as_str()).collect::<Vec<_>>(), ["knuckle"]);
    // The knuckle is at 0.1 − 2·motor; the motor's limits are 0 and 1.
    let [low, high] = moving[0].limits.unwrap().map(|e| e.eval(|_| None).unwrap());
    assert!((low + 1.9).abs() < 1e-12 && (high - 0.1).abs() < 1e-12, "{low} {high}");
    let velocity = moving[0].velocity.unwrap().eval(|_| None).unwrap();
    assert!((velocity - 4.0).abs() < 1e-12);
    // With the motor at 0.3 the knuckle is at −0.5: from its link the drive is where the tree has it.
    let found = Robot::numeric(&chain.description).unwrap().pose(&[-0.5]);
    let all = m.placing().poses(&[0.3]);
    let [k, drive] = ["k", "drive"].map(|n| all[m.body(n).unwrap()]);
    let apart = (k.inverse() * drive).matrix().concat().into_iter().zip(found.matrix().concat());
    assert!(apart.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) < 1e-12);
}

/// A joint that follows one of a later branch comes behind it in the rows, with its variable and the named poses.
#[test]
fn rows_of_followers_come_behind_those_they_follow() {
    let joint = |name: &str, links: [&str; 2], more: &str| {
        format!(
            "<joint name='{name}' type='continuous'><parent link='{}'/><child link='{}'/><origin xyz='0.1 0 0'/><axis xyz='0 0 1'/>\
             {more}</joint>",
            links[0], links[1]
        )
    };
    let text = format!(
        "<robot name='r'><link name='a'/><link name='b'/><link name='c'/><link name='d'/><link name='e'/>{}{}{}{}</robot>",
        joint("one", ["a", "b"], ""),
        joint("slave", ["b", "c"], "<mimic joint='master' multiplier='-2'/>"),
        joint("two", ["c", "d"], ""),
        joint("master", ["a", "e"], ""),
    );
    let mut m = read_urdf(&text, Decimals::AsWritten).unwrap().0;
    let name = |j: usize| m.joints[j].name.clone();
    assert_eq!(m.variables().into_iter().map(name).collect::<Vec<_>>(), ["one", "two", "master"]);
    m.poses = vec![("home".into(), [1, 2, 3].map(Expr::int).to_vec())];
    let rows = RowTree::of_mechanism(&m).unwrap();
    let back = crate::trees::tree(&write_tree(&rows));
    let names: Vec<&str> = back.rows.iter().filter_map(|r| r.name.as_deref()).collect();
    assert_eq!(names, ["one", "master", "slave", "two"]);
    let home: Vec<String> = back.poses[0].1.iter().map(|e| e.to_string()).collect();
    assert_eq!(home, ["1", "3", "2"]);
    let ends = ["d", "e"].map(|n| (n.to_string(), n.to_string()));
    let same = compare_chains(Tree::Bodies(&m), &back, &ends);
    assert_eq!((same.proved, same.count()), (2, 2), "{same:?}");
}

/// Limits of a joint that follows another are limits of what moves both, unless they would leave it no way to move.
#[test]
fn limits_of_followers_narrow_those_of_their_leaders() {
    let joint = |name: &str, links: [&str; 2], limits: [f64; 2], more: &str| {
        format!(
            "<joint name='{name}' type='revolute'><parent link='{}'/><child link='{}'/><origin xyz='0.2 0 0.1' rpy='0.3 0 0'/><axis xyz='0 1 0'/>\
             <limit lower='{}' upper='{}' effort='1' velocity='1'/>{more}</joint>",
            links[0], links[1], limits[0], limits[1]
        )
    };
    let tree = |follower: [f64; 2], mimic: &str| {
        let (lead, follows) =
            (joint("lead", ["a", "b"], [-1.0, 1.0], ""), joint("second", ["b", "c"], follower, mimic));
        let text = format!(
            "<robot name='r'><link name='a'/><link name='b'/><link name='c'/>{lead}{follows}</robot>"
        );
        read_urdf(&text, Decimals::AsWritten).unwrap().0
    };
    let limits = |m: &Mechanism| {
        let chain = m.chain(None, None, Convention::Standard).unwrap().description;
        let ends = chain.rows.iter().find_map(|r| r.limits).unwrap().map(|e| e.eval(|_| None).unwrap());
        assert_eq!(m.variable_limits(), [Some(ends)]);
        ends
    };
    let mimic = "<mimic joint='lead' multiplier='-1.5' offset='0.25'/>";
    // −1 ≤ 0.25 − 1.5 q ≤ 1
    let narrow = tree([-1.0, 1.0], mimic);
    let near = |found: [f64; 2], wanted: [f64; 2]| {
        assert!(found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?} {wanted:?}");
    };
    near(limits(&narrow), [-0.5, 1.25 / 1.5].map(|x: f64| x.clamp(-1.0, 1.0)));
    near(limits(&tree([-2.0, 2.0], mimic)), [-1.0, 1.0]);
    // A file of a gripper: both fingers from 0 to 0.8, one of them turned round.
    near(limits(&tree([3.0, 4.0], mimic)), [-1.0, 1.0]);
    // Written and read again.
    let written = denavit::description::write_urdf(&narrow);
    near(limits(&read_urdf(&written, Decimals::AsWritten).unwrap().0), [-0.5, 1.25 / 1.5]);
}
