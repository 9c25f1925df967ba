//! Models of MuJoCo's with closed loops: where MuJoCo's own constraints put joints and sites.

use denavit::closure::{Loops, findings};
use denavit::description::linkage::is_passive;
use denavit::description::{
    Alone, Decimals, Described, Linkage, Mechanism, Severity, read_mjcf, read_robot, write_linkage,
};
use denavit::geometry::Transform;
use serde_json::Value;
use std::f64::consts::PI;

fn model(text: &str) -> (Mechanism, Vec<String>) {
    let (read, _) = read_mjcf("model.xml", text, &mut Alone, Decimals::Meant);
    let (mechanism, found) =
        read.unwrap_or_else(|f| panic!("{}", denavit::description::render(&f, "", text)));
    (mechanism, found.into_iter().map(|d| d.message).collect())
}

fn linkage(text: &str) -> Linkage {
    Linkage::of_mechanism(&model(text).0).expect("all axes have directions")
}

/// The names of the joints of variables, driven or passive, in their order; those of joints that are cut left aside.
fn joints(linkage: &Linkage, passive: bool) -> Vec<String> {
    let rows =
        linkage.tree.rows.iter().filter(|r| r.variable.is_some_and(|v| is_passive(v.symbol) == passive));
    let mut named: Vec<(usize, String)> = rows
        .map(|r| {
            let symbol = r.variable.expect("it has one").symbol.name().to_string();
            (symbol[1..].parse().expect("a number"), r.name.clone().expect("a name"))
        })
        .collect();
    named.sort();
    named.into_iter().map(|n| n.1).collect()
}

#[test]
fn loops_close_where_mujoco_closes_them() {
    let figures: Value = serde_json::from_str(include_str!("../peers/mjcf_loops.json")).expect("JSON");
    let mut compared = 0;
    for case in figures["cases"].as_array().expect("a list") {
        let text = case["text"].as_str().expect("a text");
        let linkage = linkage(text);
        let found = findings(&linkage);
        assert!(
            found.iter().all(|d| d.severity != Severity::Error),
            "{}\n{text}",
            denavit::description::render(&found, "", text)
        );
        // What is added to cut a loop is no tip.
        assert!(linkage.way(None).map_or(true, |(tip, ..)| text.contains(&tip)));
        let own: Vec<&str> =
            case["driven"].as_array().expect("a list").iter().filter_map(Value::as_str).collect();
        let driven = joints(&linkage, false);
        assert_eq!(driven, own);
        let passive = joints(&linkage, true);
        // What was read is written as rows, and read again.
        let written = write_linkage(&linkage);
        let Described::Linkage(again) = read_robot(&written).expect("what is written can be read").0 else {
            panic!("{written}");
        };
        for linkage in [&linkage, &*again] {
            let loops = Loops::new(linkage).expect("it has values");
            for configuration in case["configurations"].as_array().expect("a list") {
                let value = |name: &String| configuration["joints"][name].as_f64();
                let q: Vec<f64> = driven.iter().map(|name| value(name).expect("a number")).collect();
                // Of a point that is held in space two of three turns are joints that the file does not have.
                let p: Vec<Option<f64>> = passive.iter().map(value).collect();
                let near = |x: &f64, y: &Option<f64>| {
                    y.is_none_or(|y| ((x - y + PI).rem_euclid(2.0 * PI) - PI).abs() < 1e-7)
                };
                let all = loops.assemblies(&q);
                let own = all.iter().find(|a| a.passive.iter().zip(&p).all(|(x, y)| near(x, y)));
                let own = own.unwrap_or_else(|| panic!("{p:?} is not among {all:?}\n{text}"));
                for (name, rows) in configuration["sites"].as_object().expect("a table") {
                    let (_, place) = loops.place(Some(name)).expect("a frame of the model");
                    let there = loops.pose(&place, &q, &own.passive);
                    assert!(apart(&there, rows) < 1e-9, "{name}: {:e}\n{text}", apart(&there, rows));
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 100, "{compared}");
}

fn apart(pose: &Transform<f64>, rows: &Value) -> f64 {
    let own = pose.matrix();
    let entry = |i: usize, j: usize| (own[i][j] - rows[i][j].as_f64().expect("a number")).abs();
    (0..12).map(|k| entry(k / 4, k % 4)).fold(0.0, f64::max)
}

const FOUR: &str = "<mujoco><worldbody>
  <body name='crank'><joint name='crank'/><geom size='0.01'/>
    <body name='coupler' pos='1 0 0'><joint name='coupler'/><geom size='0.01'/></body></body>
  <body name='rocker' pos='4 3 0' euler='0 0 90'><joint name='rocker'/><geom size='0.01'/></body>
</worldbody>
<equality>LOOP</equality>DRIVE</mujoco>";

#[test]
fn actuators_say_what_is_driven() {
    let connect = "<connect body1='coupler' body2='rocker' anchor='3 0 0'/>";
    let four = |drive: &str| linkage(&FOUR.replace("LOOP", connect).replace("DRIVE", drive));
    let driven = |drive: &str| joints(&four(drive), false);
    assert_eq!(driven("<actuator><motor joint='rocker'/></actuator>"), ["rocker"]);
    assert_eq!(driven("<actuator><motor joint='crank'/></actuator>"), ["crank"]);
    // Where nothing is said, the last ones follow the first.
    assert_eq!(driven(""), ["crank"]);
    assert_eq!(joints(&four(""), true), ["coupler", "rocker"]);
    // Two drives are one too many: the loop is closed where they happen to fit.
    let both = Loops::new(&four("<actuator><motor joint='crank'/><motor joint='rocker'/></actuator>"))
        .expect("values");
    assert!(both.assemblies(&[0.3, 0.4]).is_empty());
    // A chain through it is taken as if the loop were open.
    let (mechanism, _) = model(&FOUR.replace("LOOP", connect).replace("DRIVE", ""));
    assert_eq!((mechanism.holds.len(), mechanism.variables().len()), (1, 3));
}

#[test]
fn what_is_wrong_with_loops_is_said() {
    let said = |closed: &str, wanted: &str| {
        let text = FOUR.replace("LOOP", closed).replace("DRIVE", "");
        let (read, _) = read_mjcf("model.xml", &text, &mut Alone, Decimals::Meant);
        let found = match read {
            Ok((_, found)) | Err(found) => found,
        };
        let all: Vec<String> = found.iter().map(|d| format!("{} {:?}", d.message, d.hint)).collect();
        assert!(all.iter().any(|m| m.contains(wanted)), "{wanted}: {all:?}");
    };
    said("<connect body1='couple' body2='rocker' anchor='3 0 0'/>", "there is no body `couple`");
    said("<connect body1='couple' body2='rocker' anchor='3 0 0'/>", "did you mean `coupler`?");
    said("<connect body1='coupler' body2='rocker'/>", "without `anchor`");
    said("<connect anchor='3 0 0'/>", "without `body1`");
    said("<connect body1='coupler' body2='coupler' anchor='3 0 0'/>", "holds a body to itself");
    said("<connect site1='a' site2='b'/>", "there is no site `a`");
    said("<weld body1='coupler' relpose='1 2 3'/>", "`relpose` is seven numbers");
    said("<weld body1='coupler' turn='1'/>", "turn");
    let clean = |closed: &str| {
        let (mechanism, found) = model(&FOUR.replace("LOOP", closed).replace("DRIVE", ""));
        assert!(found.is_empty(), "{found:?}");
        mechanism.holds.len()
    };
    assert_eq!(clean("<weld name='w' body1='coupler' body2='rocker' relpose='3 0 0 1 0 0 0'/>"), 1);
    assert_eq!(clean("<weld body1='coupler'/>"), 1);
}
