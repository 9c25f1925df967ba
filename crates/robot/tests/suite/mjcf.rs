//! MJCF: what is read, what is said, what is refused; and what is written, beside MuJoCo.

use crate::common::{Random, shown};
use denavit::catalogue;
use denavit::description::{
    Agreement, Alone, Convention, Decimals, Description, Mechanism, NoChain, Row, RowTree, Severity, Sources,
    Unweighed, read_mjcf, root_element, write_mjcf, write_toml,
};
use denavit::dynamics::{Dynamics, inverse_dynamics};
use denavit::geometry::Transform;
use denavit::mechanism::{Comparison, compare};
use denavit::robot::Robot;
use denavit_symbolic::{Expr, Rational};
use serde_json::Value;
use std::collections::HashMap;
use std::time::{Duration, Instant};

/// Files in memory, by their names.
struct Memory(HashMap<&'static str, String>);

impl Sources for Memory {
    fn open(&mut self, from: &str, wanted: &str) -> Result<(String, String), String> {
        let folder = from.rsplit_once('/').map_or(String::new(), |f| format!("{}/", f.0));
        let name = format!("{folder}{wanted}");
        self.0.get(name.as_str()).map(|text| (name.clone(), text.clone())).ok_or(format!("no `{name}`"))
    }

    fn package(&mut self, _: &str) -> Option<String> {
        None
    }
}

fn read(text: &str, decimals: Decimals) -> Mechanism {
    let (reading, files) = read_mjcf("model.xml", text, &mut Alone, decimals);
    let say = |list: Vec<_>| list.iter().map(|d| files.render(d)).collect::<String>();
    reading.unwrap_or_else(|list| panic!("{}\n{text}", say(list))).0
}

/// The findings of a text, `refused` before those of one that is.
fn findings(text: &str) -> String {
    let (refused, list) = match read_mjcf("model.xml", text, &mut Alone, Decimals::Meant).0 {
        Ok((_, list)) => ("", list),
        Err(list) => ("refused\n", list),
    };
    format!("{refused}{}", shown(text, &list).join("\n"))
}

/// Texts with what is said of them: `tests/mjcf_findings.txt`, reviewed like code.
#[test]
fn every_finding_has_its_place() {
    let cases = include_str!("../mjcf_findings.txt");
    let mut wrong = vec![];
    for case in cases.split("\n=====\n") {
        let (text, expected) = case.split_once("\n-----\n").expect("a text and what is said of it");
        let (name, text) = text.trim_start().split_once('\n').expect("a name and a text");
        let found = findings(text);
        if found.trim() != expected.trim() {
            wrong.push(format!("{name}\n{found}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n=====\n"));
}

/// Files that are made to hurt: all end in an error with a place, and soon.
#[test]
fn hostile_files_are_refused_at_once() {
    let model = |inner: &str| format!("<mujoco><worldbody>{inner}</worldbody></mujoco>");
    let deep = |n: usize| model(&format!("{}{}", "<body>".repeat(n), "</body>".repeat(n)));
    let frames = model(&format!("<body>{}{}</body>", "<frame>".repeat(100_000), "</frame>".repeat(100_000)));
    let wide: String = (0..1_000_000).map(|i| format!(" a{i}=''")).collect();
    let laughs = "<!DOCTYPE r [<!ENTITY a 'ha'><!ENTITY b '&a;&a;&a;&a;&a;&a;&a;&a;'>]><mujoco model='&b;'/>";
    let nested = |n: usize| {
        let (open, close) = ("<replicate count='1000'>".repeat(n), "</replicate>".repeat(n));
        model(&format!("{open}<geom/>{close}"))
    };
    let classes: String = (0..3000).map(|i| format!("<default class='c{i}'/>")).collect();
    let hinges = "<body><joint/>".repeat(590) + &"</body>".repeat(590);
    let many_hinges = model(&"<body><joint/></body>".repeat(501));
    let in_line = model(&hinges);
    for (name, text, said) in [
        ("depth", deep(100_000), "600 deep"),
        ("depth of frames", frames, "600 deep"),
        ("attributes", format!("<mujoco{wide}/>"), "attributes"),
        ("attributes in an open tag", format!("<mujoco{wide}"), "attributes"),
        ("entities", laughs.into(), "document type"),
        ("elements", model(&"<body/>".repeat(450_000)), "400000 elements"),
        ("bodies", model(&"<body/>".repeat(6000)), "5000 bodies"),
        ("repeated", nested(3), "elements are repeated"),
        ("repeated often", nested(500), "elements are repeated"),
        ("count", model("<replicate count='1e9'><body/></replicate>"), "from 1 to 1000"),
        ("classes", format!("<mujoco><default>{classes}</default><worldbody/></mujoco>"), "2000 classes"),
        ("digits", model(&format!("<body pos='{} 0 0'/>", "9".repeat(1_000_000))), "no decimal number"),
        ("large", model("<body pos='1e99 0 0'/>"), "out of range"),
        ("joints", many_hinges, "501 moving joints"),
        ("joints in line", in_line, "moving joints"),
        ("two roots", "<mujoco/><mujoco/>".into(), "not XML"),
        ("bytes", model("<body name='\u{fffd}'/>"), "not UTF-8"),
        ("size", " ".repeat(17 << 20), "bytes"),
        ("nothing", String::new(), "no element"),
        ("itself", model("<include file='model.xml'/>"), "is another file"),
        ("comment", "<mujoco><!--".into(), "not XML"),
    ] {
        let start = Instant::now();
        let (reading, files) = read_mjcf("model.xml", &text, &mut Alone, Decimals::Meant);
        let list = reading.err().unwrap_or_else(|| panic!("{name} is read"));
        let mut errors = list.iter().filter(|d| d.severity == Severity::Error);
        assert!(errors.any(|d| d.message.contains(said)), "{name}: {list:?}");
        assert!(list.iter().all(|d| files.place(&d.span).starts_with("model.xml:")), "{name}");
        assert!(list.len() <= 101, "{name}: {} findings", list.len());
        assert!(start.elapsed() < Duration::from_secs(20), "{name} took {:?}", start.elapsed());
    }
}

/// A file is included once, wherever it stands; a part attaches no model that attaches it.
#[test]
fn files_that_go_round_in_a_ring_are_refused() {
    let mut files = HashMap::new();
    let mut file = |name, text: &str| files.insert(name, text.to_string());
    file("m/a.xml", "<mujocoinclude><include file='b.xml'/></mujocoinclude>");
    file("m/b.xml", "<mujocoinclude><include file='a.xml'/></mujocoinclude>");
    file("m/self.xml", "<mujoco><worldbody><include file='self.xml'/></worldbody></mujoco>");
    file(
        "m/x.xml",
        "<mujoco><asset><model name='y' file='y.xml'/></asset><worldbody><attach model='y' prefix='y'/></worldbody></mujoco>",
    );
    file(
        "m/y.xml",
        "<mujoco><asset><model name='x' file='x.xml'/></asset><worldbody><body name='b'/><attach model='x' prefix='x'/></worldbody></mujoco>",
    );
    file("m/wrong.xml", "<mujocoinclude>\n  <body pos='1 2'/>\n  <body/>\n</mujocoinclude>");
    for (text, place, said) in [
        (
            "<mujoco><worldbody><include file='a.xml'/></worldbody></mujoco>",
            "m/b.xml:1:31",
            "included already",
        ),
        (
            "<mujoco><worldbody><include file='self.xml'/></worldbody></mujoco>",
            "m/self.xml:1:35",
            "included already",
        ),
        (
            "<mujoco><asset><model name='x' file='x.xml'/></asset><worldbody><attach model='x' prefix='p'/></worldbody></mujoco>",
            "m/y.xml:1:96",
            "attaches itself",
        ),
        (
            "<mujoco><worldbody><include file='wrong.xml'/></worldbody></mujoco>",
            "m/wrong.xml:2:14",
            "2 numbers, not 3",
        ),
        (
            "<mujoco><worldbody><include file='none.xml'/></worldbody></mujoco>",
            "m/model.xml:1:35",
            "cannot be read",
        ),
    ] {
        let (reading, read) = read_mjcf("m/model.xml", text, &mut Memory(files.clone()), Decimals::Meant);
        let list = reading.expect_err(text);
        let found: Vec<String> =
            list.iter().map(|d| format!("{} {}", read.place(&d.span), d.message)).collect();
        assert!(found.iter().any(|f| f.starts_with(place) && f.contains(said)), "{text}: {found:?}");
    }
}

/// What is included or attached stands where it is asked for, in the units of its own model.
#[test]
fn models_are_put_together() {
    let mut files = HashMap::new();
    files.insert("m/parts/arm.xml", "<mujocoinclude><include file='hand.xml'/></mujocoinclude>".to_string());
    files.insert(
        "m/parts/hand.xml",
        "<any><body name='hand' pos='0 0 1'><joint name='h'/></body></any>".to_string(),
    );
    files.insert(
        "m/finger.xml",
        "<mujoco model='finger'><compiler angle='radian'/><default><joint axis='1 0 0'/></default><worldbody>
         <body name='one' pos='0.5 0 0' euler='0 0 1.5707963267948966'><joint name='a'/><body name='two' pos='1 0 0'>
         <joint name='b' range='-1 1'/></body></body></worldbody><equality><joint joint1='b' joint2='a' polycoef='0 0.5'/></equality></mujoco>"
            .to_string(),
    );
    let text = "<mujoco><asset><model file='finger.xml'/></asset><worldbody><include file='parts/arm.xml'/>
        <frame pos='0 0 3' euler='0 0 90'><attach model='finger' body='one' prefix='left_'/></frame>
        <attach model='finger' prefix='right_'/></worldbody></mujoco>";
    let (reading, read) = read_mjcf("m/model.xml", text, &mut Memory(files), Decimals::Meant);
    let (m, list) =
        reading.unwrap_or_else(|l| panic!("{}", l.iter().map(|d| read.render(d)).collect::<String>()));
    let names: Vec<&str> = m.bodies.iter().map(|b| b.name.as_str()).collect();
    assert_eq!(names, ["world", "hand", "left_one", "left_two", "right_one", "right_two"], "{list:?}");
    let joints: Vec<&str> = m.variables().iter().map(|&j| m.joints[j].name.as_str()).collect();
    assert_eq!(joints, ["h", "left_a", "right_a"]);
    let at = |name: &str| m.poses(&[0.0; 3])[m.body(name).unwrap()].translation.0;
    // Rz(90°)·(0.5, 0, 0), and 1 further along the x that has been turned twice
    let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15);
    assert!(near(at("left_two"), [-1.0, 0.5, 3.0]), "{:?}", at("left_two"));
    assert!(near(at("right_two"), [0.5, 1.0, 0.0]), "{:?}", at("right_two"));
    let follower = m.joints.iter().find(|j| j.name == "right_b").unwrap();
    let follows = follower.follows.as_ref().unwrap();
    assert_eq!(
        (m.joints[follows.joint].name.as_str(), follows.factor.to_string()),
        ("right_a", "1/2".into())
    );
}

fn peers() -> Value {
    serde_json::from_str(include_str!("../peers/mjcf.json")).unwrap()
}

/// Models with the samples of them: those of `tests/mjcf`, and those made at random.
fn models() -> Vec<(String, String, Vec<Value>)> {
    let all = peers();
    let samples = |v: &Value| v["samples"].as_array().unwrap().clone();
    let files = all["files"].as_array().unwrap().iter().map(|f| {
        let name = f["name"].as_str().unwrap().to_string();
        let path = format!("{}/tests/mjcf/{name}.xml", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"));
        (name, text, samples(f))
    });
    let made = all["made"].as_array().unwrap().iter().enumerate();
    files
        .chain(made.map(|(k, f)| (format!("made {k}"), f["text"].as_str().unwrap().into(), samples(f))))
        .collect()
}

fn apart(a: &Transform<f64>, b: &Transform<f64>) -> f64 {
    let (a, b) = (a.matrix().concat(), b.matrix().concat());
    a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

/// As written; meant decimals may move what is printed with two or three places, and that is bounded.
#[test]
fn all_bodies_and_sites_are_where_mujoco_has_them() {
    let mut frames = 0;
    for (name, text, samples) in models() {
        let (m, meant) = (read(&text, Decimals::AsWritten), read(&text, Decimals::Meant));
        for sample in &samples {
            let value = |&j: &usize| sample["joints"][&m.joints[j].name].as_f64().unwrap_or(0.0);
            let q: Vec<f64> = m.variables().iter().map(value).collect();
            let all = m.poses(&q);
            for (kind, what) in [("bodies", ""), ("sites", "_site")] {
                for (frame, peer) in sample[kind].as_object().unwrap() {
                    let is_taken = kind == "sites" && !sample["bodies"][frame].is_null();
                    let own = if is_taken { format!("{frame}{what}") } else { frame.clone() };
                    let body = m.body(&own).unwrap_or_else(|| panic!("{name}: no {own}"));
                    let matrix = all[body].matrix().concat();
                    let peer = peer.as_array().unwrap().iter().map(|x| x.as_f64().unwrap());
                    let off = peer.zip(matrix).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
                    assert!(off < 1e-12, "{name}, {frame}: {off:e}");
                    frames += 1;
                }
            }
        }
        let moved = m.apart(&meant);
        assert!(moved < 5e-3, "{name}: {moved}");
    }
    assert!(frames > 1500, "{frames}");
}

/// Every chain from the world to a leaf, read both ways, is proved, and is where the tree is.
#[test]
fn all_chains_are_proved() {
    let (mut chains, mut exact) = (0, 0);
    for (name, text, _) in models() {
        for decimals in [Decimals::Meant, Decimals::AsWritten] {
            let m = read(&text, decimals);
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
            }
        }
    }
    assert!(chains > 200 && exact > 60, "{chains}, {exact} exactly");
}

/// Each robot of the catalogue as a model and back: proved the same, but for angles that have the digits of doubles. MuJoCo has the
/// tool of what is written where the table has it.
#[test]
fn the_catalogue_goes_to_mjcf_and_back() {
    let peers = peers();
    let (mut proved, mut held) = (0, 0);
    for name in catalogue::names() {
        let open = catalogue::robot(name).unwrap();
        let d = open.filled().in_numbers();
        let text = write_mjcf(&Mechanism::of(&d).unwrap());
        let back = read(&text, Decimals::Meant).chain(Some("base"), Some("tool"), d.convention).unwrap();
        match compare(&d, &back.description) {
            Comparison::Proved => proved += 1,
            Comparison::Sampled(by) => assert!(by < 1e-14, "{name}: {by:e}"),
            other => panic!("{name}: {other:?}"),
        }
        let limits = |d: &denavit::Description| {
            let number = |e: denavit_symbolic::Expr| e.eval(|_| None).unwrap();
            d.rows
                .iter()
                .filter(|r| r.variable.is_some())
                .map(|r| r.limits.map(|l| l.map(number)))
                .collect::<Vec<_>>()
        };
        assert_eq!(limits(&d), limits(&back.description), "{name}");
        let Some(q) = peers["catalogue"][name]["q"].as_array() else {
            assert!(Mechanism::of(&open).is_err(), "{name} is not among the peer's");
            continue;
        };
        let q: Vec<f64> = q.iter().map(|x| x.as_f64().unwrap()).collect();
        let pose = Robot::numeric(&d).unwrap().pose(&q).matrix().concat();
        let tool = peers["catalogue"][name]["tool"].as_array().unwrap();
        let off = tool.iter().zip(pose).map(|(x, y)| (x.as_f64().unwrap() - y).abs()).fold(0.0, f64::max);
        assert!(off < 1e-12, "{name}: {off:e}");
        held += 1;
    }
    assert!(proved >= 93 && held >= 96, "{proved} {held}");
}

/// What is read of any model can be written, and is there again.
#[test]
fn models_are_written_and_read_again() {
    for (name, text, samples) in models() {
        let m = read(&text, Decimals::Meant);
        let again = read(&write_mjcf(&m), Decimals::Meant);
        for sample in &samples {
            let at = |m: &Mechanism| {
                let value = |&j: &usize| sample["joints"][&m.joints[j].name].as_f64().unwrap_or(0.0);
                m.poses(&m.variables().iter().map(value).collect::<Vec<_>>())
            };
            let (one, other) = (at(&m), at(&again));
            for (body, pose) in m.bodies.iter().zip(&one) {
                let there = again.body(&body.name).unwrap_or_else(|| panic!("{name}: no {}", body.name));
                assert!(apart(pose, &other[there]) < 1e-12, "{name}, {}", body.name);
            }
        }
    }
}

/// The table of a maker comes out of a model of its robot.
#[test]
fn a_table_of_a_maker_comes_out() {
    let text = &models().into_iter().find(|m| m.0 == "panda").unwrap().1;
    let chain = read(text, Decimals::Meant).chain(None, Some("right_hand"), Convention::Craig).unwrap();
    assert_eq!(chain.agreement, Agreement::Proved);
    let maker = catalogue::robot("franka-panda").unwrap().in_numbers();
    let cells = |d: &denavit::Description| {
        d.rows.iter().take(6).map(|r| [r.theta, r.d, r.a, r.alpha].map(|e| e.to_string())).collect::<Vec<_>>()
    };
    assert_eq!(cells(&chain.description), cells(&maker));
}

#[test]
fn a_text_says_what_it_is() {
    for (text, root) in [
        ("<mujoco/>", Some("mujoco")),
        ("\u{feff} \n<?xml version='1.0'?>\n<!-- <robot> --><robot name='r'>", Some("robot")),
        ("<!DOCTYPE x><sdf>", Some("sdf")),
        ("name = 'x'", None),
        ("<!-- open", None),
        ("<", None),
        ("", None),
    ] {
        assert_eq!(root_element(text), root, "{text}");
    }
}

/// Elements, attributes and pieces of numbers thrown together: nothing panics, and what is read can be computed with and written.
#[test]
fn soup_does_no_harm() {
    let mut random = Random(21);
    let words = [
        "<body name=\"a\">",
        "<body pos=\"0 0 1\" euler=\"0 90 0\">",
        "<body childclass=\"c\" quat=\"0.707107 0 0 0.707107\">",
        "<body quat=\"0.9 0.1 0.2 0.3\">",
        "</body>",
        "</body>",
        "</body>",
        "<joint/>",
        "<joint name=\"j\" axis=\"1 1 0\" pos=\"0.1 0 0\"/>",
        "<joint name=\"k\" type=\"slide\" ref=\"0.1\" range=\"-1 1\"/>",
        "<joint type=\"ball\"/>",
        "<freejoint/>",
        "<joint class=\"c\"/>",
        "<site name=\"s\" zaxis=\"1 2 ",
        "3\"/>",
        "<site name=\"a\" xyaxes=\"1 0 0 0 1 0\"/>",
        "<frame axisangle=\"0 0 1 45\">",
        "</frame>",
        "<replicate count=\"3\" offset=\"0.1 0 0\" euler=\"0 0 30\">",
        "</replicate>",
        "<inertial mass=\"1\" diaginertia=\"1 1 1\" pos=\"0 0 0\"/>",
        "<geom/>",
        "</worldbody><equality><joint joint1=\"j\" joint2=\"k\" polycoef=\"0.1 2\"/></equality><worldbody>",
        "</worldbody><default><default class=\"c\"><joint axis=\"0 1 0\"/></default></default><worldbody>",
        "</worldbody><compiler angle=\"radian\" eulerseq=\"ZYX\"/><worldbody>",
        "<attach model=\"m\" prefix=\"p\"/>",
        "\"",
        "<",
        "é",
        "\u{0}",
        "<!--",
    ];
    let mut read = 0;
    for _ in 0..20_000 {
        let mut text = String::from("<mujoco><worldbody>");
        for _ in 0..1 + (random.unit() * 14.0) as usize {
            text.push_str(words[(random.unit() * words.len() as f64) as usize]);
        }
        text.push_str(["", "</body>", "</body></body>"][(random.unit() * 3.0) as usize]);
        text.push_str("</worldbody></mujoco>");
        match read_mjcf("m.xml", &text, &mut Alone, Decimals::Meant).0 {
            Err(list) => assert!(!list.is_empty(), "refused without a reason: {text}"),
            Ok((m, _)) => {
                read += 1;
                m.poses(&vec![0.1; m.variables().len()]);
                let _ = m.chain(None, None, Convention::Khalil);
                let written = write_mjcf(&m);
                let again = read_mjcf("w.xml", &written, &mut Alone, Decimals::Meant).0;
                assert!(again.is_ok(), "{text}\n{written}\n{again:?}");
            }
        }
    }
    assert!(read > 100, "{read}");
}

/// A configuration with a name goes along every chain, past what floats and what follows, and is written.
#[test]
fn keyframes_are_named_configurations() {
    let text = "<mujoco><worldbody><body name='r'><freejoint/>
      <body name='b'><joint name='one' axis='0 0 1'/>
        <body name='c' pos='1 0 0'><joint name='two' axis='0 1 0'/><body name='e' pos='1 0 0'/></body>
        <body name='d' pos='0 1 0'><joint name='three' type='slide' axis='1 0 0'/><body name='f' pos='1 0 0'/></body>
      </body></body></worldbody>
      <equality><joint joint1='two' joint2='one' polycoef='0.5 2'/></equality>
      <keyframe><key name='home' qpos='9 9 9 1 0 0 0 0.25 1 -0.125'/></keyframe></mujoco>";
    let (m, _) = read_mjcf("m", text, &mut Alone, Decimals::Meant).0.unwrap();
    let number = |k: i64, n: i64| Expr::from(Rational::new(k, n));
    let home = |values: Vec<Expr>| vec![("home".to_string(), values)];
    assert_eq!(m.poses, home(vec![number(1, 4), number(-1, 8)]));
    let chain = |to: &str| m.chain(None, Some(to), Convention::Standard).unwrap().description;
    assert_eq!(chain("f").poses, home(vec![number(1, 4), number(-1, 8)]));
    assert_eq!(chain("e").poses, home(vec![number(1, 4)]), "what follows has no value of its own");
    // Alone on the way it counts by itself.
    let alone = m.chain(Some("b"), Some("e"), Convention::Standard).unwrap().description;
    assert_eq!(alone.poses, home(vec![number(1, 1)]));
    let arm = catalogue::names().into_iter().filter_map(catalogue::robot).find(|d| !d.poses.is_empty());
    let arm = arm.expect("an arm with a named configuration");
    let written = write_mjcf(&Mechanism::of(&arm).unwrap());
    let (back, _) = read_mjcf("m", &written, &mut Alone, Decimals::Meant).0.unwrap();
    let back = back.chain(Some("base"), Some("tool"), arm.convention).unwrap().description;
    let values =
        |d: &Description| -> Vec<f64> { d.poses[0].1.iter().map(|e| e.eval(|_| None).unwrap()).collect() };
    assert_eq!((&back.poses[0].0, values(&back)), (&arm.poses[0].0, values(&arm)));
}

/// An `<inertial>` in a frame of its body is the body's; what is not known is no mass, and chains that move it have none.
#[test]
fn masses_in_frames_and_masses_that_are_not_known() {
    let text = "<mujoco><worldbody><body name='a'><joint name='j' axis='0 0 1'/><frame pos='1 0 0' euler='0 90 0'>
        <geom type='cylinder' size='0.1' fromto='0 0 0 1 1 1'/><inertial pos='1 0 0' mass='2' diaginertia='1 1 1'/></frame>
        <body name='b'><joint name='k' axis='0 1 0'/><geom type='mesh' mesh='m' mass='20'/><body name='c'><joint name='l'/><geom size='0.1'/></body>
        </body></body></worldbody></mujoco>";
    let m = read(text, Decimals::Meant);
    let mass = m.bodies[m.body("a").unwrap()].mass.as_ref().unwrap();
    assert_eq!((mass.mass, mass.com), (Expr::int(2), [1, 0, -1].map(Expr::int)));
    let chain = |from: &str, to: &str| m.chain(Some(from), Some(to), Convention::Standard).unwrap();
    assert_eq!(chain("world", "c").unweighed, Some(Unweighed::Body("b".into())));
    assert!(!chain("world", "c").description.has_masses());
    assert!(chain("b", "c").unweighed.is_none() && chain("b", "c").description.has_masses());
}

/// Where no `<inertial>` says what a body weighs, its geoms do.
#[test]
fn bodies_weigh_what_mujoco_says() {
    let all: Value = serde_json::from_str(include_str!("../peers/mjcf_masses.json")).unwrap();
    let mut compared = 0;
    for model in all["models"].as_array().unwrap() {
        let text = model["text"].as_str().unwrap();
        let m = read(text, Decimals::AsWritten);
        for (name, peer) in model["bodies"].as_object().unwrap() {
            let body = &m.bodies[m.body(name).unwrap_or_else(|| panic!("no {name}"))];
            let mass = body.mass.as_ref().unwrap_or_else(|| panic!("{name} has no mass: {text}"));
            let own = [mass.mass].into_iter().chain(mass.com).chain(mass.inertia);
            let own: Vec<f64> = own.map(|e| e.eval(|_| None).unwrap()).collect();
            let list = |key: &str| peer[key].as_array().unwrap().iter().map(|x| x.as_f64().unwrap());
            let said = [peer["mass"].as_f64().unwrap()].into_iter().chain(list("com")).chain(list("inertia"));
            for (x, y) in own.iter().zip(said) {
                assert!((x - y).abs() < 1e-9 * (1.0 + y.abs()), "{name}: {own:?} {peer} in {text}");
            }
            compared += 1;
        }
    }
    assert!(compared > 100, "{compared}");
}

/// Drives and gravity go through a model, and through a tree of rows with its masses; gravity is turned with the base of a chain.
#[test]
fn drives_gravity_and_masses_are_kept() {
    let body = |name: &str, pos: &str, joint: &str, more: &str| {
        format!(
            "<body name=\"{name}\" {pos}><inertial pos=\"0 0 0.1\" mass=\"2\" diaginertia=\"0.1 0.2 0.15\"/>{joint}{more}</body>"
        )
    };
    let arm = body("arm", "pos=\"0.3 0 0\"", "<joint name=\"j2\" axis=\"0 1 0\" damping=\"0.25\"/>", "");
    let turn = "<joint name=\"j1\" axis=\"0 0 1\" damping=\"0.5\" armature=\"0.01\" frictionloss=\"0.2\"/>";
    let mast = body("mast", "euler=\"180 0 0\"", turn, &arm);
    let text = format!("<mujoco><option gravity=\"0 0 -1.62\"/><worldbody>{mast}</worldbody></mujoco>");
    let m = read(&text, Decimals::Meant);
    let decimal = |n, d| Expr::from(Rational::new(n, d));
    let d = m.chain(Some("world"), Some("arm"), Convention::Khalil).expect("a chain").description;
    assert_eq!(d.gravity, Some([Expr::int(0), Expr::int(0), decimal(-162, 100)]));
    let drives: Vec<_> = d.rows.iter().map(|r| (r.rotor, r.viscous, r.coulomb)).collect();
    let first = (Some(decimal(1, 100)), Some(decimal(1, 2)), Some(decimal(1, 5)));
    assert_eq!(drives, [first, (None, Some(decimal(1, 4)), None)]);
    // The mast hangs upside down.
    let beside = m.chain(Some("mast"), Some("arm"), Convention::Khalil).expect("a chain").description;
    assert_eq!(beside.gravity, Some([Expr::int(0), Expr::int(0), decimal(162, 100)]));
    // Written and read again.
    let back = read(&write_mjcf(&m), Decimals::Meant);
    let again = back.chain(Some("world"), Some("arm"), Convention::Khalil).expect("a chain").description;
    assert_eq!(write_toml(&again), write_toml(&d));
    // As a tree of rows, whose chain has the same frames here.
    let rows = RowTree::of_mechanism(&m).expect("axes have directions");
    assert_eq!(rows.gravity, d.gravity);
    let masses = |rows: &[Row]| -> Vec<_> { rows.iter().map(|r| (r.mass, r.viscous, r.rotor)).collect() };
    assert_eq!(masses(&rows.rows), masses(&d.rows));
    let torques = |d: &Description| {
        let arm = Dynamics::numeric(d).expect("numbers");
        inverse_dynamics(&arm, &[0.4, -0.7], &[0.3, 0.2], &[1.0, -2.0], None)
    };
    let chain = rows.chain(None, Some("arm"), Convention::Khalil).expect("a chain").description;
    for (a, b) in torques(&d).into_iter().zip(torques(&chain)) {
        assert!((a - b).abs() < 1e-12, "{a} {b}");
    }
}

/// What bodies weigh with `boundmass`, `boundinertia` and `balanceinertia`: mass and inertia as MuJoCo 4.0.0 has them.
#[test]
fn masses_have_bounds() {
    let inertial = |mass: &str, inertia: &str| {
        format!("<inertial pos='0 0 0.1' mass='{mass}' {inertia}/><geom size='0.1'/>")
    };
    let bounds =
        |balance: &str| format!("<compiler boundmass='0.5' boundinertia='0.02' balanceinertia='{balance}'/>");
    let diagonal = |d: &str| format!("diaginertia='{d}'");
    for (compiler, body, mass, moments) in [
        (bounds("false"), inertial("0.1", &diagonal("0.01 0.03 0.03")), 0.5, [0.02, 0.03, 0.03]),
        (bounds("true"), inertial("1", &diagonal("0.1 0.03 0.03")), 1.0, [0.16 / 3.0; 3]),
        (bounds("true"), inertial("1", &diagonal("0.1 0.03 0.01")), 1.0, [0.05; 3]),
        (bounds("true"), inertial("1", "fullinertia='0.1 0.09 0.012 0.01 0 0'"), 1.0, [0.07; 3]),
        ("<compiler boundmass='0.5' boundinertia='0.02'/>".into(), String::new(), 0.5, [0.02; 3]),
        (
            "<compiler boundmass='0.5' boundinertia='0.02'/>".into(),
            "<geom size='0.01'/>".into(),
            0.5,
            [0.02; 3],
        ),
    ] {
        let text = format!(
            "<mujoco>{compiler}<worldbody><body name='a'><joint type='hinge'/>{body}</body></worldbody></mujoco>"
        );
        let m = read(&text, Decimals::Meant);
        let found = m.bodies[m.body("a").unwrap()].mass.as_ref().expect("a mass");
        let number = |e: Expr| e.eval(|_| None).unwrap();
        assert!((number(found.mass) - mass).abs() < 1e-12, "{text}");
        let [xx, xy, xz, yy, yz, zz] = found.inertia.map(number);
        for (x, expected) in
            [(xx, moments[0]), (yy, moments[1]), (zz, moments[2]), (xy, 0.0), (xz, 0.0), (yz, 0.0)]
        {
            assert!((x - expected).abs() < 1e-12, "{text}: {x} {expected}");
        }
    }
    // About other axes the moments are bounded there: those of MuJoCo are 0.02, 0.0838 and 0.1062.
    let text = format!(
        "<mujoco><compiler boundinertia='0.02'/><worldbody><body name='a'><joint/>{}</body></worldbody></mujoco>",
        inertial("1", "fullinertia='0.1 0.09 0.012 0.01 0 0'")
    );
    let m = read(&text, Decimals::Meant);
    let found = m.bodies[1].mass.as_ref().unwrap().inertia.map(|e| e.eval(|_| None).unwrap());
    for (x, expected) in found.into_iter().zip([0.1, 0.01, 0.0, 0.09, 0.0, 0.02]) {
        assert!((x - expected).abs() < 1e-12, "{found:?}");
    }
    // What all weighs together is said of what is bounded.
    let text = "<mujoco><compiler boundmass='0.5' boundinertia='0.02' settotalmass='3'/><worldbody><body name='a'><joint/>\
                <body name='b'><geom size='0.1'/></body><geom size='0.01'/></body></worldbody></mujoco>";
    let m = read(text, Decimals::Meant);
    let masses =
        ["a", "b"].map(|n| m.bodies[m.body(n).unwrap()].mass.as_ref().unwrap().mass.eval(|_| None).unwrap());
    assert!((masses[0] - 0.31991).abs() < 1e-5 && (masses[1] - 2.68009).abs() < 1e-5, "{masses:?}");
}
