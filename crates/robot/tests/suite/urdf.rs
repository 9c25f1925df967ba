//! URDF: what is read, what is said, what is refused.

use crate::common::{Random, shown};
use denavit::catalogue;
use denavit::description::{
    Agreement, Chain, Convention, Decimals, Description, Joint, Mechanism, NoChain, Severity,
    prove_same_chain, read_urdf, write_toml, write_urdf,
};
use denavit::geometry::{Rotation, Transform};
use denavit::mechanism::{Comparison, compare};
use denavit::robot::Robot;
use denavit_symbolic::{Angle, Expr, Rational};
use serde_json::Value;
use std::time::{Duration, Instant};

/// The findings of a text, `-` before those of one that is refused.
fn findings(text: &str) -> String {
    let (refused, list) = match read_urdf(text, Decimals::Meant) {
        Ok((_, list)) => ("", list),
        Err(list) => ("refused\n", list),
    };
    format!("{refused}{}", shown(text, &list).join("\n"))
}

/// Texts with what is said of them: `tests/urdf_findings.txt`, reviewed like code.
#[test]
fn every_finding_has_its_place() {
    let cases = include_str!("../urdf_findings.txt");
    for case in cases.split("\n=====\n") {
        let (text, expected) = case.split_once("\n-----\n").expect("a text and what is said of it");
        let (name, text) = text.trim_start().split_once('\n').expect("a name and a text");
        assert_eq!(findings(text).trim(), expected.trim(), "{name}");
    }
}

/// A revolute joint with these limits at this place.
fn limited(limits: &str, origin: &str) -> String {
    format!(
        "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/><joint name=\"j\" type=\"revolute\">\
         <parent link=\"a\"/><child link=\"b\"/><origin {origin}/><axis xyz=\"0 0 1\"/>\
         <limit {limits} effort=\"1\" velocity=\"inf\"/></joint></robot>"
    )
}

/// Infinite ends, as programs print them, are none; one end alone is left out aloud.
#[test]
fn infinite_limits_are_none() {
    for (ends, is_said) in [
        (r#"lower="-inf" upper="inf""#, false),
        (r#"lower="-INF" upper="+Infinity""#, false),
        (r#"lower="-inf" upper="1""#, true),
        (r#"lower="0.5" upper="inf""#, true),
    ] {
        let (mechanism, list) = read_urdf(&limited(ends, ""), Decimals::Meant).unwrap();
        assert!(mechanism.joints[0].limits.is_none() && mechanism.joints[0].velocity.is_none(), "{ends}");
        assert_eq!(list.iter().any(|f| f.message.contains("on one side")), is_said, "{ends}");
    }
    assert!(read_urdf(&limited(r#"lower="nan" upper="1""#, ""), Decimals::Meant).is_err());
}

/// Degrees and millimetres are warned of, once each; what arms have is not.
#[test]
fn degrees_and_millimetres_are_warned_of() {
    let warned = |limits: &str, origin: &str| {
        let (_, list) = read_urdf(&limited(limits, origin), Decimals::Meant).unwrap();
        list.iter().filter(|f| f.hint.as_deref().is_some_and(|h| h.contains("of a URDF are in"))).count()
    };
    let plain = r#"lower="-6.3" upper="12.6""#;
    assert_eq!(warned(plain, r#"xyz="10 0 2" rpy="0 6.28 -3.14""#), 0);
    assert_eq!(warned(r#"lower="-90" upper="90""#, ""), 1);
    assert_eq!(warned(plain, r#"xyz="300 0 0""#), 1);
    assert_eq!(warned(plain, r#"xyz="0 0 0" rpy="0 90 0""#), 1);
    assert_eq!(warned(r#"lower="-170" upper="170""#, r#"xyz="0 300 0" rpy="90 0 180""#), 3);
}

/// Files that are made to hurt: all end in an error with a place, and soon.
#[test]
fn hostile_files_are_refused_at_once() {
    let joint = |name: &str, parent: &str, child: &str| {
        format!("<joint name='{name}' type='fixed'><parent link='{parent}'/><child link='{child}'/></joint>")
    };
    let deep = format!("<robot name='r'>{}{}</robot>", "<a>".repeat(100_000), "</a>".repeat(100_000));
    let wide: String = (0..1_000_000).map(|i| format!(" a{i}=''")).collect();
    let laughs = "<!DOCTYPE r [<!ENTITY a 'ha'><!ENTITY b '&a;&a;&a;&a;&a;&a;&a;&a;'>]><robot name='&b;'/>";
    let many: String = (0..500_000).map(|_| "<link/>").collect();
    let ring: String = (0..1000)
        .map(|i| {
            format!(
                "<link name='l{i}'/>{}",
                joint(&format!("j{i}"), &format!("l{i}"), &format!("l{}", (i + 1) % 1000))
            )
        })
        .collect();
    let long_digits = format!(
        "<robot name='r'><link name='a'/><joint name='j' type='fixed'><origin xyz='{} 0 0'/></joint></robot>",
        "9".repeat(1_000_000)
    );
    for (name, text, said) in [
        ("depth", deep, "64 deep"),
        ("attributes", format!("<robot{wide}/>"), "attributes"),
        ("attributes in an open tag", format!("<robot{wide}"), "attributes"),
        ("quotes in an open tag", format!("<robot a='{wide}"), "attributes"),
        ("entities", laughs.into(), "document type"),
        ("elements", format!("<robot name='r'>{many}</robot>"), "400000 elements"),
        ("ring", format!("<robot name='r'>{ring}</robot>"), "ring"),
        ("digits", long_digits, "decimal"),
        ("size", " ".repeat(17 << 20), "bytes"),
        ("nothing", String::new(), "no element"),
        ("blanks", "\n\n\n".into(), "no element"),
        ("comment", "<!--".into(), "not XML"),
        ("section", "<robot><![CDATA[".into(), "not XML"),
    ] {
        let start = Instant::now();
        let list = read_urdf(&text, Decimals::Meant).err().unwrap_or_else(|| panic!("{name} is read"));
        assert!(
            list.iter().any(|d| d.severity == Severity::Error && d.message.contains(said)),
            "{name}: {list:?}"
        );
        assert!(list.len() <= 101, "{name}: {} findings", list.len());
        assert!(start.elapsed() < Duration::from_secs(20), "{name} took {:?}", start.elapsed());
    }
}

/// Elements, attributes and pieces of numbers thrown together: nothing panics, and what is read can be computed with.
#[test]
fn soup_does_no_harm() {
    let mut random = Random(20);
    let words = [
        "<robot name=\"r\">",
        "</robot>",
        "<link name=\"a\"/>",
        "<link name=\"b\"/>",
        "<link name=\"c\">",
        "</link>",
        "<joint name=\"j\" type=\"revolute\">",
        "<joint name=\"k\" type=\"planar\">",
        "<joint name=\"l\" type=\"floating\">",
        "</joint>",
        "<parent link=\"a\"/>",
        "<child link=\"b\"/>",
        "<parent link=\"b\"/>",
        "<child link=\"c\"/>",
        "<origin xyz=\"1e-13 0.3 ",
        "-1.5708\"/>",
        "<origin rpy=\"",
        "1.57 0 0\"/>",
        "<axis xyz=\"0 1e-300 1\"/>",
        "<axis xyz=\"1 1 1\"/>",
        "<mimic joint=\"k\"/>",
        "<mimic joint=\"j\" multiplier=\"0\"/>",
        "<limit lower=\"",
        "1\" upper=\"2\"/>",
        "<inertial>",
        "</inertial>",
        "&lt;",
        "\"",
        "<",
        ">",
        "é",
        "\u{0}",
        "<!--",
        "-->",
    ];
    let mut read = 0;
    for _ in 0..20_000 {
        let mut text = String::from("<robot name=\"r\"><link name=\"a\"/>");
        for _ in 0..1 + (random.unit() * 14.0) as usize {
            text.push_str(words[(random.unit() * words.len() as f64) as usize]);
        }
        if random.unit() < 0.8 {
            text.push_str("</robot>");
        }
        match read_urdf(&text, Decimals::Meant) {
            Err(list) => assert!(!list.is_empty(), "refused without a reason: {text}"),
            Ok((m, _)) => {
                read += 1;
                m.poses(&vec![0.1; m.variables().len()]);
                let _ = m.chain(None, None, Convention::Khalil);
            }
        }
    }
    assert!(read > 20, "{read}");
}

/// The files of `tests/urdf` and what Pinocchio computed of them.
fn peers() -> Vec<(String, String, Vec<Value>)> {
    let all: Value = serde_json::from_str(include_str!("../peers/urdf.json")).unwrap();
    let files = all["files"].as_array().unwrap().iter();
    files
        .map(|f| {
            let name = f["name"].as_str().unwrap().to_string();
            let text = file(&name);
            (name, text, f["samples"].as_array().unwrap().clone())
        })
        .collect()
}

fn file(name: &str) -> String {
    let path = format!("{}/tests/urdf/{name}.urdf", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"))
}

fn mechanism(name: &str) -> Mechanism {
    read_urdf(&file(name), Decimals::Meant).unwrap_or_else(|e| panic!("{name}: {e:?}")).0
}

fn apart(a: &Transform<f64>, b: &Transform<f64>) -> f64 {
    let (a, b) = (a.matrix().concat(), b.matrix().concat());
    a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

/// As written; meant decimals may move what is printed with two or three places, and that is bounded.
#[test]
fn all_links_are_where_pinocchio_has_them() {
    let (mut links, mut programs) = (0, std::collections::BTreeMap::new());
    for (name, text, samples) in peers() {
        let read = |decimals| read_urdf(&text, decimals).unwrap_or_else(|e| panic!("{name}: {e:?}")).0;
        let (m, meant) = (read(Decimals::AsWritten), read(Decimals::Meant));
        for sample in &samples {
            let value = |&j: &usize| sample["joints"][&m.joints[j].name].as_f64().unwrap_or(0.0);
            let q: Vec<f64> = m.variables().iter().map(value).collect();
            // The program for all of them has them there, too.
            let program = programs
                .entry(name.clone())
                .or_insert_with(|| m.frames_program(&(0..m.bodies.len()).collect::<Vec<_>>()).compile(&[]));
            let results = program.scalar().eval(&q).to_vec();
            for ((body, pose), entries) in m.bodies.iter().zip(m.poses(&q)).zip(results.chunks(16)) {
                let Some(peer) = sample["links"][&body.name].as_array() else { continue };
                let differs = |(x, y): (&Value, &f64)| (x.as_f64().unwrap() - y).abs();
                let off = peer.iter().zip(entries).map(differs).fold(0.0, f64::max);
                assert!(off < 1e-12, "{name}, {}: {off:e} in the program", body.name);
                let matrix = pose.matrix().concat();
                let off =
                    peer.iter().zip(matrix).map(|(x, y)| (x.as_f64().unwrap() - y).abs()).fold(0.0, f64::max);
                assert!(off < 1e-12, "{name}, {}: {off:e}", body.name);
                links += 1;
            }
        }
        let moved = m.apart(&meant);
        assert!(moved < 5e-3, "{name}: {moved}");
    }
    assert!(links > 1500, "{links}");
}

/// Every chain from the root to a leaf, read both ways, is proved, and is where the tree is.
#[test]
fn all_chains_are_proved() {
    let (mut chains, mut exact) = (0, 0);
    for (name, text, _) in peers() {
        for decimals in [Decimals::Meant, Decimals::AsWritten] {
            let m = read_urdf(&text, decimals).unwrap().0;
            for leaf in m.leaves() {
                let convention = Convention::ALL[chains % 3];
                let chain = match m.chain(None, Some(&m.bodies[leaf].name), convention) {
                    Ok(chain) => chain,
                    Err(NoChain::Rigid { .. }) => continue,
                    Err(why) => panic!("{name}: {why}"),
                };
                chains += 1;
                match chain.agreement {
                    Agreement::Proved => exact += 1,
                    Agreement::Within(by) => assert!(by < 1e-16, "{name}, {}: {by:e}", m.bodies[leaf].name),
                }
                let (q, at) = somewhere(&m, &chain);
                let off = apart(&m.poses(&q)[leaf], &Robot::numeric(&chain.description).unwrap().pose(&at));
                assert!(off < 1e-12, "{name}, {}: {off:e}", m.bodies[leaf].name);
                let lengths = chain.description.rows.iter().flat_map(|r| [r.a, r.d, r.b]);
                let at_rest = |e: Expr| e.eval(|_| Some(0.0)).unwrap().abs();
                assert!(lengths.map(at_rest).fold(0.0, f64::max) < 1.5, "{name}: a normal far away");
            }
        }
    }
    assert!(chains > 200 && exact > 120, "{chains}, {exact} exactly");
}

/// A configuration of a mechanism, and of a chain of it.
fn somewhere(m: &Mechanism, chain: &Chain) -> (Vec<f64>, Vec<f64>) {
    let variables = m.variables();
    let mut q = vec![0.0; variables.len()];
    for (i, &j) in chain.joints.iter().enumerate() {
        let leader = m.joints[j].follows.as_ref().map_or(j, |f| f.joint);
        q[variables.iter().position(|&v| v == leader).unwrap()] = [0.3, -0.4, 1.2, 0.9, -0.8][i % 5];
    }
    let values = chain.joints.iter().map(|&j| value_of(m, &q, j)).collect();
    (q, values)
}

/// The value of a joint in a configuration of the mechanism.
fn value_of(m: &Mechanism, q: &[f64], j: usize) -> f64 {
    let own = |leader: usize| q[m.variables().iter().position(|&v| v == leader).unwrap()];
    let follows = m.joints[j].follows.as_ref();
    follows.map_or_else(|| own(j), |f| f.factor.to_f64() * own(f.joint) + f.offset.eval(|_| None).unwrap())
}

fn cells(d: &Description) -> Vec<[Expr; 4]> {
    d.rows.iter().map(|r| [r.theta, r.d, r.a, r.alpha].map(|e| Angle::of(e).to_expr())).collect()
}

/// The makers' tables, as the catalogue has them, out of the makers' files.
#[test]
fn tables_of_makers_come_out_row_for_row() {
    for (name, from, to, arm) in [
        ("ur3_robot", "base", "tool0", "ur3"),
        ("ur5_robot", "base", "tool0", "ur5"),
        ("ur10_robot", "base", "tool0", "ur10"),
        ("panda", "panda_link0", "panda_link7", "franka-panda"),
    ] {
        let maker = catalogue::robot(arm).unwrap();
        let values = |e: Expr| e.substitute(|s| maker.exact_value(s));
        let chain = mechanism(name).chain(Some(from), Some(to), maker.convention).unwrap();
        assert_eq!(chain.agreement, Agreement::Proved, "{name}");
        let mut expected: Vec<[Expr; 4]> = cells(&maker).iter().map(|r| r.map(values)).collect();
        let mut found = cells(&chain.description);
        if arm == "franka-panda" {
            // The maker's flange is a row of its own there.
            expected.truncate(7);
            found.truncate(7);
        }
        let number = |rows: &[[Expr; 4]]| rows.iter().map(|r| r.map(|e| format!("{e}"))).collect::<Vec<_>>();
        assert_eq!(number(&found), number(&expected), "{name}");
    }
}

/// A file may insert fixed joints and turn the frames of joints about: the table is the same.
#[test]
fn the_table_does_not_depend_on_how_frames_are_placed() {
    let quarter = |n: i64| Expr::pi() * Expr::from(Rational::new(n, 6));
    for (name, from, to) in [
        ("ur5_robot", "base", "tool0"),
        ("panda", "panda_link0", "panda_hand"),
        ("xarm7", "link_base", "link_eef"),
    ] {
        let m = mechanism(name);
        let plain = m.chain(Some(from), Some(to), Convention::Standard).unwrap();
        let mut other = m.clone();
        let turns: Vec<Rotation<Expr>> = (0..m.bodies.len() as i64)
            .map(|i| Rotation::from_rpy(quarter(i % 5), quarter(3 * (i % 2)), quarter(i % 7)))
            .collect();
        let kept: Vec<usize> = [from, to].map(|b| m.body(b).unwrap()).to_vec();
        let turn = |body: usize| if kept.contains(&body) { Rotation::identity() } else { turns[body] };
        let as_transform =
            |r: Rotation<Expr>| Transform::from_rotation_translation(r, denavit::geometry::Vector::zero());
        for joint in &mut other.joints {
            // The child's frame turned by R: the axis stands in it as R⁻¹z, what hangs on it at R⁻¹X.
            let (p, c) = (turn(joint.parent), turn(joint.child));
            joint.origin = as_transform(p.inverse()) * joint.origin * as_transform(c);
            joint.axis = c.inverse() * joint.axis;
        }
        for (b, body) in other.bodies.iter_mut().enumerate() {
            let Some(mass) = &mut body.mass else { continue };
            let turned = mass.body().seen_from(&as_transform(turn(b).inverse()));
            let Some((com, inertia)) = turned.at_centre() else { continue };
            (mass.com, mass.inertia) = (com.0, inertia);
        }
        // A fixed joint in front of each that moves.
        let mut split = Mechanism { joints: vec![], ..other.clone() };
        for joint in &other.joints {
            let half = Transform::translation(Expr::from(Rational::new(1, 7)), Expr::int(0), Expr::int(1))
                * Transform::rotation_x(quarter(1));
            let between = split.bodies.len();
            let mut body = split.bodies[0].clone();
            body.name = format!("{} before", joint.name);
            body.mass = None;
            split.bodies.push(body);
            split.joints.push(Joint {
                name: format!("{} fixed", joint.name),
                kind: None,
                child: between,
                origin: joint.origin * half,
                follows: None,
                ..joint.clone()
            });
            let follows =
                joint.follows.clone().map(|f| denavit::description::Follows { joint: 2 * f.joint + 1, ..f });
            split.joints.push(Joint { parent: between, origin: half.inverse(), follows, ..joint.clone() });
        }
        for (what, changed) in [("turned", &other), ("split", &split)] {
            let chain = changed.chain(Some(from), Some(to), Convention::Standard).unwrap();
            let table = |c: &Chain| write_toml(&c.description);
            assert_eq!(table(&chain), table(&plain), "{name} {what}");
        }
    }
}

/// From leaf to leaf, up the tree and down again: one way is the inverse of the other.
#[test]
fn ways_between_leaves_go_both_ways() {
    let mut count = 0;
    for name in ["baxter", "pr2", "anymal_kinova", "allegro_right_hand", "b1_z1", "ur5_robot"] {
        let m = mechanism(name);
        let leaves = m.leaves();
        for pair in leaves.windows(2).step_by(1 + leaves.len() / 6) {
            let names = [0, 1].map(|k| m.bodies[pair[k]].name.as_str());
            let Ok(there) = m.chain(Some(names[0]), Some(names[1]), Convention::Craig) else { continue };
            let back = m.chain(Some(names[1]), Some(names[0]), Convention::Standard).unwrap();
            let (q, at) = somewhere(&m, &there);
            // Where joints follow others, each way has the first that it meets as variable.
            let value = |&joint: &usize| value_of(&m, &q, joint);
            let other: Vec<f64> = back.joints.iter().map(value).collect();
            let pose = |c: &Chain, q: &[f64]| Robot::numeric(&c.description).unwrap().pose(q);
            let product = pose(&there, &at) * pose(&back, &other);
            assert!(apart(&product, &Transform::identity()) < 1e-12, "{name}: {names:?}");
            let tree = m.poses(&q);
            let between = tree[pair[0]].inverse() * tree[pair[1]];
            assert!(apart(&between, &pose(&there, &at)) < 1e-12, "{name}: {names:?}");
            count += 1;
        }
    }
    assert!(count >= 15, "{count}");
}

#[test]
fn tips_are_found_or_listed() {
    let m = mechanism("ur5_gripper");
    match m.chain(None, None, Convention::Standard) {
        Ok(_) => panic!("the fingers are two tips"),
        Err(why) => assert!(matches!(&why, NoChain::Several(tips) if tips.len() > 1), "{why}"),
    }
    let near = m.chain(None, Some("wrist_3_lnk"), Convention::Standard).unwrap_err();
    assert_eq!(near, NoChain::Unknown { name: "wrist_3_lnk".into(), near: Some("wrist_3_link".into()) });
    let rigid =
        mechanism("ur5_robot").chain(Some("base"), Some("base_link"), Convention::Standard).unwrap_err();
    assert_eq!(rigid.to_string(), "no joint moves between `base` and `base_link`");
    let names: Vec<String> = {
        let chain = mechanism("z1").chain(None, None, Convention::Standard).unwrap();
        chain.description.rows.iter().filter_map(|r| r.name.clone()).collect()
    };
    assert_eq!(names.last().map(String::as_str), Some("jointGripper"), "{names:?}");
    assert_eq!(names.len(), 7);
}

/// A leader behind its follower, a follower of a follower: the first on the way introduces the variable.
#[test]
fn joints_that_follow_are_couplings() {
    let text = "<robot name='r'><link name='a'/><link name='b'/><link name='c'/><link name='d'/>
        <joint name='j' type='continuous'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/><mimic joint='k' multiplier='-2' offset='0.5'/></joint>
        <joint name='k' type='continuous'><parent link='b'/><child link='c'/><origin xyz='0.3 0 0'/><axis xyz='0 0 1'/></joint>
        <joint name='l' type='continuous'><parent link='c'/><child link='d'/><origin xyz='0.2 0 0'/><axis xyz='0 0 1'/><mimic joint='j' multiplier='0.5'/></joint>
        </robot>";
    let m = read_urdf(text, Decimals::Meant).unwrap().0;
    let chain = m.chain(None, None, Convention::Standard).unwrap();
    let thetas: Vec<String> = chain.description.rows.iter().map(|r| r.theta.to_string()).collect();
    assert_eq!(thetas, ["q1", "1/4 - q1/2", "q1/2"]);
    // Without the leader on the way the follower is what moves.
    let alone = m.chain(None, Some("b"), Convention::Standard).unwrap();
    assert_eq!(alone.description.rows[0].theta.to_string(), "q1");
    assert_eq!(m.joints[alone.joints[0]].name, "j");
}

#[test]
fn a_large_robot_is_read_soon() {
    let text = file("pr2");
    let start = Instant::now();
    let m = read_urdf(&text, Decimals::Meant).unwrap().0;
    assert!(m.bodies.len() > 80);
    // 20 ms in a release build; tests share their processor.
    assert!(start.elapsed() < Duration::from_secs(10), "{:?}", start.elapsed());
}

/// Very many links that do not move, beside each other or on each other, and as many names that are not there.
#[test]
fn very_many_links_are_read_soon() {
    const MANY: usize = 20_000;
    let fixed = |name: usize, parent: usize| {
        format!(
            "<link name='l{name}'/><joint name='j{name}' type='fixed'><origin xyz='0.01 0 0.02' rpy='0 0 0.3'/>\
             <parent link='l{parent}'/><child link='l{name}'/></joint>"
        )
    };
    let moving = "<link name='l0'/><link name='tip'/><joint name='j' type='continuous'><parent link='l0'/><child link='tip'/></joint>";
    let of = |parent: fn(usize) -> usize| -> String {
        let all: String = (1..MANY).map(|i| fixed(i, parent(i))).collect();
        format!("<robot name='r'>{moving}{all}</robot>")
    };
    for parent in
        [(|_| 0) as fn(usize) -> usize, |i| i - 1, |i| if i % 2 == 0 { i - 1 } else { i.saturating_sub(2) }]
    {
        let text = of(parent);
        let start = Instant::now();
        let m = read_urdf(&text, Decimals::Meant).unwrap().0;
        assert_eq!(m.apart(&read_urdf(&text, Decimals::AsWritten).unwrap().0), 0.0);
        let chain = m.chain(None, Some("tip"), Convention::Standard).unwrap();
        assert_eq!(m.frames(&chain).len(), MANY + 1);
        // What is said of the others is that they have no joints.
        assert_eq!(m.chain(None, None, Convention::Standard).unwrap().to, m.body("tip").unwrap());
        // 4 s and less in a release build.
        assert!(start.elapsed() < Duration::from_secs(200), "{:?}", start.elapsed());
    }
    let text = of(|_| 0).replace("<parent link='l0'/>", "<parent link='lost'/>");
    let start = Instant::now();
    assert!(read_urdf(&text, Decimals::Meant).is_err());
    assert!(start.elapsed() < Duration::from_secs(100), "{:?}", start.elapsed());
}

/// A chain of many joints whose angles are no multiples of 15° is made, written and held against itself soon.
#[test]
fn a_long_chain_is_converted_soon() {
    let joint = |i: usize| {
        format!(
            "<link name='l{i}'/><joint name='j{i}' type='continuous'><origin xyz='0.1 0.02 0.3' rpy='0.3 0 0.7'/>\
             <parent link='l{}'/><child link='l{i}'/><axis xyz='{}'/></joint>",
            i - 1,
            ["1 0 0", "0 1 0", "0 0 1"][i % 3]
        )
    };
    let text =
        format!("<robot name='r'><link name='l0'/>{}</robot>", (1..=120).map(joint).collect::<String>());
    let start = Instant::now();
    let m = read_urdf(&text, Decimals::Meant).unwrap().0;
    let d = m.chain(None, None, Convention::Standard).unwrap().description;
    let back = read_urdf(&write_urdf(&Mechanism::of(&d).unwrap()), Decimals::Meant).unwrap().0;
    let back = back.chain(Some("base"), Some("tool"), Convention::Standard).unwrap().description;
    let compared = compare(&d, &back);
    assert!(
        matches!(compared, Comparison::Proved) || matches!(compared, Comparison::Sampled(by) if by < 1e-12),
        "{compared:?}"
    );
    let all: Vec<usize> = (0..m.bodies.len()).collect();
    assert_eq!(m.frames_program(&all).compile(&[]).scalar().eval(&[0.1; 120]).len(), 16 * 121);
    assert!(start.elapsed() < Duration::from_secs(100), "{:?}", start.elapsed());
}

/// Whole trees as URDF and back: bodies, joints, what follows what, limits, masses, and where everything is.
#[test]
fn whole_trees_go_to_urdf_and_back() {
    for name in ["baxter", "pr2", "anymal_kinova", "allegro_right_hand", "ur5_gripper"] {
        let m = mechanism(name);
        let text = write_urdf(&m);
        let (back, _) = read_urdf(&text, Decimals::Meant).unwrap_or_else(|e| panic!("{name}: {e:?}"));
        let names = |m: &Mechanism| -> (Vec<String>, Vec<String>) {
            (
                m.bodies.iter().map(|b| b.name.clone()).collect(),
                m.joints.iter().map(|j| j.name.clone()).collect(),
            )
        };
        let sorted = |(mut a, mut b): (Vec<String>, Vec<String>)| {
            a.sort();
            b.sort();
            (a, b)
        };
        assert_eq!(sorted(names(&back)), sorted(names(&m)), "{name}");
        let there: Vec<usize> =
            m.joints.iter().map(|j| back.joints.iter().position(|b| b.name == j.name).unwrap()).collect();
        for (one, &k) in m.joints.iter().zip(&there) {
            let other = &back.joints[k];
            let number = |e: Option<Expr>| e.map(|e| e.eval(|_| None).unwrap());
            let ends = |j: &Joint| j.limits.map(|l| l.map(|e| number(Some(e)).unwrap()));
            assert_eq!((one.kind, ends(one)), (other.kind, ends(other)), "{name}: {}", one.name);
            if one.limits.is_some() {
                assert_eq!(number(one.velocity).unwrap_or(0.0), number(other.velocity).unwrap_or(0.0));
                assert_eq!(number(one.effort).unwrap_or(0.0), number(other.effort).unwrap_or(0.0));
            }
            let leads = |m: &Mechanism, j: &Joint| {
                j.follows
                    .as_ref()
                    .map(|f| (m.joints[f.joint].name.clone(), f.factor.clone(), number(Some(f.offset))))
            };
            assert_eq!(leads(&m, one), leads(&back, other), "{name}: {}", one.name);
        }
        let q: Vec<f64> = (0..m.variables().len()).map(|i| [0.3, -0.4, 1.2, 0.9, -0.8][i % 5]).collect();
        let own = m.variables();
        let other: Vec<f64> =
            back.variables().iter().map(|&j| q[own.iter().position(|&o| there[o] == j).unwrap()]).collect();
        let (a, b) = (m.poses(&q), back.poses(&other));
        for (body, pose) in m.bodies.iter().zip(&a) {
            let off = apart(pose, &b[back.body(&body.name).unwrap()]);
            assert!(off < 1e-12, "{name}: {}: {off:e}", body.name);
            let again = &back.bodies[back.body(&body.name).unwrap()];
            assert_eq!(body.mass.is_some(), again.mass.is_some(), "{name}: {}", body.name);
        }
    }
}

/// Each robot of the catalogue as a URDF and back: the rows that its axes have, to the letter, and proved the same. Angles that are no
/// multiples of 15° come back with the digits of a double.
#[test]
fn the_catalogue_goes_to_urdf_and_back() {
    let (mut to_the_letter, mut proved) = (0, 0);
    for name in catalogue::names() {
        let d = catalogue::robot(name).unwrap().filled().in_numbers();
        let text = write_urdf(&Mechanism::of(&d).unwrap());
        let (m, _) = read_urdf(&text, Decimals::Meant).unwrap_or_else(|e| panic!("{name}: {e:?}\n{text}"));
        let back = m.chain(None, Some("tool"), d.convention).unwrap().description;
        let (plain, _) = d.at_rest().description(name, d.convention).unwrap();
        to_the_letter += usize::from(cells(&plain) == cells(&back));
        proved += usize::from(prove_same_chain(&d, &back).is_equal());
        let q: Vec<f64> = (0..d.variables().len()).map(|i| 0.3 + 0.2 * i as f64).collect();
        let [a, b] = [&d, &back].map(|d| Robot::numeric(d).unwrap().pose(&q));
        assert!(apart(&a, &b) < 1e-14, "{name}: {:e}", apart(&a, &b));
    }
    assert!(to_the_letter >= 93 && proved >= 93, "{to_the_letter} {proved}");
    let missing = Mechanism::of(&catalogue::robot("prrrrp").unwrap()).unwrap_err();
    assert_eq!(missing.parameters.len(), 3);
}
