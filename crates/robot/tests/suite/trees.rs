//! Trees of rows in Khalil's notation: robot files, tables, `.par` files.

use crate::common::Random;
use denavit::catalogue;
use denavit::description::{
    Alone, Convention, Decimals, Described, Description, Diagnostic, Mechanism, NoChain, RowTree, Severity,
    TableKind, TableOptions, line_column, prove_same_chain, read_mjcf, read_par, read_robot,
    read_table_robot, read_toml, read_urdf, write_mjcf, write_par, write_tree, write_urdf,
};
use denavit::geometry::Transform;
use denavit::mechanism::{Comparison, Tree, compare, compare_chains};
use denavit::robot::Robot;
use denavit_symbolic::{Expr, Rational};
use std::time::Instant;

fn shown(text: &str, findings: &[Diagnostic]) -> Vec<String> {
    let one = |d: &Diagnostic| {
        let (line, column) = line_column(text, d.span.start);
        format!("{line}:{column}: {}", d.message)
    };
    findings.iter().filter(|d| d.severity == Severity::Error).map(one).collect()
}

fn par(text: &str) -> RowTree {
    let read = read_par(text, Decimals::Meant);
    let read = read.unwrap_or_else(|f| panic!("{}\n{text}", denavit::description::render(&f, "par", text)));
    read.0.tree().expect("a tree")
}

pub fn tree(text: &str) -> RowTree {
    let read = read_robot(text);
    match read.unwrap_or_else(|f| panic!("{}\n{text}", denavit::description::render(&f, "", text))).0 {
        Described::Tree(tree) => *tree,
        Described::Chain(_) | Described::Linkage(_) => panic!("a tree is expected"),
    }
}

/// The Stäubli RX-90 as Khalil and Dombre have it (Modeling, Identification and Control of Robots, 2002, table 3.1).
const RX90: &str = "(* Robotname = 'RX90' *)\nNL = 6\nNJ = 6\nNF = 6\nType = 0\nis_mobile = 0\n\n\
    (* Geometric parameters *)\nant = {0,1,2,3,4,5}\nsigma = {0,0,0,0,0,0}\nb = {0,0,0,0,0,0}\nd = {0,0,D3,0,0,0}\n\
    r = {0,0,0,RL4,0,0}\ngamma = {0,0,0,0,0,0}\nalpha = {0,pi/2,0,-1.5708,pi/2,-pi/2}\nmu = {1,1,1,1,1,1}\n\
    theta = {th1,th2,th3,\n  th4,th5,th6}\n(* D3 = 0.45 *)\n(* RL4 = 0.45 *)\nG = {0,0,-9.81}\nXX = {XX1,XX2,XX3,XX4,XX5,XX6}\n";

#[test]
fn the_rx90_of_a_par_file_is_that_of_the_catalogue() {
    let read = par(RX90);
    assert_eq!((read.name.as_str(), read.rows.len(), read.is_chain()), ("RX90", 6, true));
    let d = read.chain(None, None, Convention::Khalil).unwrap().description;
    let catalogued = catalogue::robot("staubli-rx90").unwrap();
    assert!(prove_same_chain(&d.in_numbers(), &catalogued.in_numbers()).is_equal());
    assert_eq!(d.parameters.len(), 2, "D3 and RL4 are names");
}

#[test]
fn every_catalogue_arm_goes_to_a_par_file_and_back() {
    let mut refused = vec![];
    for name in catalogue::names() {
        let d = catalogue::robot(name).unwrap();
        let Ok(file) = write_par(&d.as_tree()) else {
            refused.push(name);
            continue;
        };
        let text = file.text;
        let back = par(&text).chain(None, None, Convention::Khalil).unwrap().description;
        let is_same = prove_same_chain(&d, &back).is_equal()
            || prove_same_chain(&d.in_numbers(), &back.in_numbers()).is_equal();
        // Tools and bases whose normals are roots hold decimals.
        let q: Vec<f64> = (0..d.variables().len()).map(|i| 0.3 + 0.4 * i as f64).collect();
        let apart = || {
            let [a, b] = [&d, &back].map(|d| Robot::numeric(d).unwrap().pose(&q).matrix().concat());
            a.iter().zip(&b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        assert!((is_same || apart() < 1e-15) && !text.contains(" deg"), "{name}\n{text}");
    }
    assert_eq!(refused, ["parallelogram-5r"], "couplings have no words in the format");
}

#[test]
fn what_is_wrong_with_a_par_file_has_its_place() {
    let plain =
        "NL = 2\nNJ = 2\nNF = 2\nant = {0,1}\nsigma = {0,1}\ntheta = {th1,0}\nr = {0,r2}\nd = {0,D2}\n";
    assert!(read_par(plain, Decimals::Meant).is_ok());
    let changed = |from: &str, to: &str| plain.replace(from, to);
    for (text, expected) in [
        (String::new(), &["1:1: there are no geometric parameters"] as &[&str]),
        (
            "hello\n".into(),
            &["1:1: `key = value` is expected here", "1:1: there are no geometric parameters"],
        ),
        (changed("NJ = 2", "NJ = 3"), &["3:6: 3 joints for 2 links need 4 frames, not 2"]),
        (format!("{plain}Type = 2\n"), &["9:8: a mechanism with closed loops, of 2 joints for 2 links"]),
        (changed("ant = {0,1}", "ant = {0,2}"), &["4:10: frame 2 stands on frame 2, which comes later"]),
        (
            changed("ant = {0,1}", "ant = {0,x}"),
            &["4:10: an antecedent is the number of a frame, 0 for the base"],
        ),
        (
            changed("sigma = {0,1}", "sigma = {0,3}"),
            &["5:12: σ is 0 (it turns), 1 (it slides) or 2 (it is fixed)"],
        ),
        (
            changed("theta = {th1,0}", "theta = {0,0}"),
            &["6:10: frame 1 turns, but its `theta` holds no variable"],
        ),
        (changed("d = {0,D2}", "d = {0}"), &["8:1: `d` has 1 values, others have 2"]),
        (changed("NF = 2", "NF = 4"), &["3:1: `NF` is 4, the columns have 2 values"]),
        (changed("d = {0,D2}", "d = {0,D2"), &["8:5: this list does not end"]),
        (changed("d = {0,D2}", "d = {0,D2+}"), &["8:10: something is missing at the end"]),
        (changed("d = {0,D2}", "d = {0,q7}"), &["8:8: `q7` is no name of a length here"]),
        (format!("{plain}Z = {{1,0,0}}\n"), &["9:1: `Z` has 16 values, not 3"]),
        (
            format!("(* open\n{plain}"),
            &["1:1: this comment does not end", "1:1: there are no geometric parameters"],
        ),
        // All at once, though there are loops and a column is short.
        (
            changed("NJ = 2", "NJ = 3")
                .replace("ant = {0,1}", "ant = {0,x}")
                .replace("d = {0,D2}", "d = {q1+}")
                + "Z = {1}\nZ = {2}\n",
            &[
                "3:6: 3 joints for 2 links need 4 frames, not 2",
                "4:10: an antecedent is the number of a frame, 0 for the base",
                "8:1: `d` has 1 values, others have 2",
                "8:8: something is missing at the end",
                "9:1: `Z` has 16 values, not 1",
                "10:1: `Z` a second time; the first is in line 9",
            ],
        ),
        (format!("{plain}ant = {{0,1}}\n"), &["9:1: `ant` a second time; the first is in line 4"]),
    ] {
        let found = shown(&text, &read_par(&text, Decimals::Meant).expect_err(&text));
        let expected: Vec<&str> = expected.to_vec();
        assert_eq!(found.len(), expected.len(), "{found:?}\n{text}");
        for (f, e) in found.iter().zip(&expected) {
            // The words of a formula's error are the parser's.
            let (f, e) = if e.ends_with("at the end") { (&f[..5], &e[..5]) } else { (f.as_str(), *e) };
            assert_eq!(f, e, "{text}");
        }
    }
}

#[test]
fn soup_of_par_files_does_no_harm() {
    const PIECES: [&str; 22] = [
        "NL", "NJ", "NF", "ant", "theta", "d", "=", "{", "}", ",", "(*", "*)", "\n", " ", "th1", "pi/2", "é",
        "0", "1", "2", "(", "9e999999",
    ];
    let mut random = Random(3);
    for _ in 0..3000 {
        let count = 1 + (random.unit() * 40.0) as usize;
        let text: String = (0..count).map(|_| PIECES[(random.unit() * 22.0) as usize % 22]).collect();
        if let Ok((tree, _)) = read_par(&text, Decimals::Meant) {
            let _ = tree.tree().map(|t| t.chain(None, None, Convention::Standard));
        }
    }
}

/// A torso that turns and lifts, with two arms of three joints, and a gripper whose second finger follows the first.
const TORSO: &str = r#"
name = "Torso"
convention = "khalil"
tip = "left finger"

[parameters]
h = "400 mm"
w = "150 mm"
l = "250 mm"

[[joints]]
name = "turn"
theta = "q1"
r = "h"

[[joints]]
name = "lift"
r = "q2"
limits = [0, "200 mm"]

[[joints]]
name = "left shoulder"
gamma = "90 deg"
d = "w"
alpha = "90 deg"
theta = "q3"
limits = ["-90 deg", "90 deg"]

[[joints]]
name = "left elbow"
d = "l"
theta = "q4 - 90 deg"

[[joints]]
name = "left finger"
d = "l"
alpha = "-90 deg"
r = "q5 + 20 mm"

[[joints]]
name = "left thumb"
after = "left elbow"
d = "l"
alpha = "-90 deg"
theta = "180 deg"
r = "-q5"

[[joints]]
name = "right shoulder"
after = "lift"
gamma = "-90 deg"
d = "w"
alpha = "90 deg"
theta = "q6"

[[joints]]
name = "right elbow"
d = "l"
theta = "q7"

[[frames]]
name = "camera"
on = "lift"
xyz = [0, 0, "h"]
rpy = [0, "30 deg", 0]

[[frames]]
name = "right hand"
on = "right elbow"
xyz = ["l", 0, 0]
"#;

/// The pose of a frame in another, from the poses of the bodies at values of the tree's variables.
fn seen(tree: &RowTree, from: &str, to: &str, q: &[f64]) -> Transform<f64> {
    let m = tree.mechanism().unwrap();
    let poses = m.poses(q);
    let [from, to] = [from, to].map(|name| poses[m.body(name).unwrap()]);
    from.inverse() * to
}

pub fn apart(a: &Transform<f64>, b: &Transform<f64>) -> f64 {
    a.matrix().concat().iter().zip(b.matrix().concat()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn pose(d: &Description, q: &[f64]) -> Transform<f64> {
    Robot::numeric(d).unwrap().pose(q)
}

#[test]
fn chains_of_a_tree_are_its_rows() {
    let tree = tree(TORSO);
    let q = [0.3, 0.1, -0.4, 0.5, 0.02, 0.7, -0.8];
    for (from, to, of) in [
        (None, None, &[0_usize, 1, 2, 3, 4][..]),
        (None, Some("right hand"), &[0, 1, 5, 6][..]),
        (None, Some("left thumb"), &[0, 1, 2, 3, 4][..]),
        (None, Some("camera"), &[0, 1][..]),
        (Some("lift"), Some("left elbow"), &[2, 3][..]),
        (Some("camera"), Some("right hand"), &[5, 6][..]),
        (Some("left elbow"), Some("right hand"), &[3, 2, 5, 6][..]),
        (Some("right hand"), Some("camera"), &[6, 5][..]),
        (Some("left finger"), Some("base"), &[4, 3, 2, 1, 0][..]),
    ] {
        for convention in Convention::ALL {
            let chain = tree.chain(from, to, convention).unwrap();
            let values: Vec<f64> = of.iter().map(|&v| q[v]).collect();
            let by_bodies = seen(&tree, &chain.from, &chain.to, &q);
            let off = apart(&by_bodies, &pose(&chain.description, &values));
            assert!(off < 1e-14, "{from:?} to {to:?}, {convention}: {off}");
        }
    }
    // Down the tree the names stay, and so do limits and joints' names.
    let down = tree.chain(None, Some("right hand"), Convention::Khalil).unwrap().description;
    assert_eq!((down.parameters.len(), down.rows[2].name.as_deref()), (3, Some("right shoulder")));
    assert!(down.rows[1].limits.is_some() && format!("{}", down.rows[3].a) == "l");
    let thumb = tree.chain(Some("left elbow"), Some("left thumb"), Convention::Khalil).unwrap().description;
    assert_eq!(format!("{}", thumb.rows[0].d), "-q1");
    assert!(matches!(tree.chain(None, Some("left hand"), Convention::Khalil), Err(NoChain::Unknown { .. })));
    assert!(matches!(
        tree.chain(Some("lift"), Some("camera"), Convention::Khalil),
        Err(NoChain::Rigid { .. })
    ));
    // The two arms of another have as many joints.
    let twins = "convention = \"khalil\"\njoints = [{ name = \"l\", theta = \"q1\" }, { name = \"r\", after = 0, theta = \"q2\" }]\n";
    assert_eq!(shown(twins, &read_toml(twins).unwrap_err()), ["1:1: there are several tips: l, r"]);
    assert_eq!(read_toml(&format!("tip = \"r\"\n{twins}")).unwrap().0.variables().len(), 1);
    assert_eq!(read_toml(TORSO).unwrap().0.variables().len(), 5);
}

#[test]
fn trees_are_written_and_read_back() {
    let first = tree(TORSO);
    let again = tree(&write_tree(&first));
    assert_eq!(write_tree(&again), write_tree(&first));
    assert_eq!((again.tip.as_deref(), &again.after), (Some("left finger"), &first.after));
    for name in ["left finger", "left thumb", "right hand", "camera"] {
        let [a, b] =
            [&first, &again].map(|t| t.chain(None, Some(name), Convention::Khalil).unwrap().description);
        assert!(prove_same_chain(&a, &b).is_equal(), "{name}");
    }
    // A thumb that follows has no words in a .par file; without it the tree goes there and back, frame by frame.
    let message = format!("{:?}", write_par(&first).unwrap_err());
    assert!(message.contains("left thumb"), "{message}");
    let from = TORSO.find("[[joints]]\nname = \"left thumb\"").unwrap();
    let to = TORSO.find("[[joints]]\nname = \"right shoulder\"").unwrap();
    let plain = tree(&format!("{}{}", &TORSO[..from], &TORSO[to..]));
    let file = write_par(&plain).unwrap();
    let text = file.text;
    let numbers: Vec<(&str, usize)> = file.frames.iter().map(|f| (f.0.as_str(), f.1)).collect();
    assert_eq!(numbers, [("camera", 8), ("right hand", 9), ("left finger", 10)]);
    let back = par(&text);
    assert!(text.contains("Type = 1") && back.parameters.len() == 3, "{text}");
    // Rows: 7 joints, then the camera, the right hand, and what stood beside q5.
    for (name, number) in [("right hand", "9"), ("camera", "8"), ("left shoulder", "3")] {
        let a = plain.chain(None, Some(name), Convention::Khalil).unwrap().description;
        let b = back.chain(None, Some(number), Convention::Khalil).unwrap().description;
        assert!(prove_same_chain(&a, &b).is_equal(), "{name}\n{text}");
    }
    let a = plain.chain(None, Some("left finger"), Convention::Khalil).unwrap().description;
    let b = back.chain(None, Some("10"), Convention::Khalil).unwrap().description;
    assert!(prove_same_chain(&a, &b).is_equal(), "{text}");
}

#[test]
fn what_is_wrong_with_a_tree_has_its_place() {
    let head = "convention = \"khalil\"\n[[joints]]\nname = \"a\"\ntheta = \"q1\"\n[[joints]]\nname = \"b\"\ntheta = \"q2\"\n";
    for (tail, expected) in [
        ("after = \"c\"\n", &["8:9: there is no row of this name"] as &[&str]),
        ("after = \"b\"\n", &["8:9: `b` does not come before this row"]),
        ("after = 7\n", &["8:9: there is no row of this name"]),
        ("after = \"base\"\n[tool]\nxyz = [0, 0, 1]\n", &["9:1: `tool` in a tree"]),
        ("[[frames]]\nname = \"x\"\n", &["8:1: on which row does this frame stand?"]),
        (
            "[[frames]]\non = \"b\"\nxyz = [0, 0]\n",
            &["8:1: a frame has a name", "10:7: xyz has 3 values, not 2"],
        ),
        ("[[frames]]\non = 1\nname = \"a\"\n", &["8:1: a second frame is called `a`"]),
        ("[[frames]]\non = 1\nname = \"f\"\nxyz = [0, 0, \"k\"]\n", &["11:15: `k` is not declared"]),
    ] {
        let text = format!("{head}{tail}");
        assert_eq!(shown(&text, &read_robot(&text).expect_err(&text)), expected, "{text}");
    }
    let craig = format!("{head}after = \"a\"\n").replace("khalil", "craig");
    assert_eq!(shown(&craig, &read_robot(&craig).unwrap_err()), ["8:1: unknown key `after`"]);
    let tip = format!("tip = \"z\"\n{head}");
    assert_eq!(shown(&tip, &read_robot(&tip).unwrap_err()), ["1:7: there is no frame of this name"]);
}

#[test]
fn a_table_with_antecedents_is_a_tree() {
    let text = "convention: khalil\n\n\
        | j | a(j) | μ_j | σ_j | γ_j | b_j | α_j | d_j | θ_j | r_j |\n\
        |---|---|---|---|---|---|---|---|---|---|\n\
        | 1 | 0 | 1 | 0 | 0 | 0 | 0 | 0 | θ1 | 0 |\n\
        | 2 | 1 | 1 | 0 | 0 | 0 | π/2 | D2 | θ2 | 0 |\n\
        | 3 | 2 | 1 | 0 | 0 | 0 | 0 | D3 | θ3 | 0 |\n\
        | 4 | 1 | 1 | 0 | 90° | B4 | -π/2 | D4 | θ4 | 0 |\n\
        | 5 | 4 | 1 | 1 | 0 | 0 | 0 | D3 | 0 | r5 |\n\
        | 6 | 5 | 0 | 2 | 0 | 0 | 0 | D3 | 0 | 0 |\n\n\
        D2 = 0.1 m, D3 = 0.3 m, D4 = 0.2 m, B4 = 50 mm\n";
    let read = read_table_robot(text, TableKind::Markdown, &TableOptions::default());
    let (read, _) = read.unwrap_or_else(|f| panic!("{}", denavit::description::render(&f, "", text)));
    let Described::Tree(tree) = read else { panic!("a tree is expected") };
    assert_eq!(tree.after, [None, Some(0), Some(1), Some(0), Some(3), Some(4)]);
    let q = [0.3, -0.2, 0.5, 0.7, 0.05];
    for (to, of) in [("3", [0_usize, 1, 2]), ("6", [0, 3, 4])] {
        let d = tree.chain(None, Some(to), Convention::Khalil).unwrap().description;
        let values: Vec<f64> = of.iter().map(|&v| q[v]).collect();
        assert!(apart(&seen(&tree, "base", to, &q), &pose(&d, &values)) < 1e-14);
    }
    let wrong = text.replace("| 4 | 1 |", "| 4 | 4 |").replace("convention: khalil\n", "");
    let findings = read_table_robot(&wrong, TableKind::Markdown, &TableOptions::default()).unwrap_err();
    assert_eq!(shown(&wrong, &findings), ["7:7: row 4 stands on row 4, which does not come before it"]);
}

/// A tree of bodies as rows, and as a `.par` file: every chain to a leaf is proved the same, or differs by rounding.
#[test]
fn trees_of_bodies_become_rows() {
    let (mut proved, mut all, mut files) = (0, 0, 0);
    for name in
        ["pr2", "baxter", "anymal_kinova", "xarm7", "so101", "allegro_left_hand", "ur5_gripper", "panda"]
    {
        let path = format!("{}/tests/urdf/{name}.urdf", env!("CARGO_MANIFEST_DIR"));
        let (m, _) = read_urdf(&std::fs::read_to_string(path).unwrap(), Decimals::Meant).unwrap();
        let tree = RowTree::of_mechanism(&m).unwrap();
        let again = match read_robot(&write_tree(&tree)) {
            Ok((Described::Tree(tree), _)) => *tree,
            other => panic!("{name}: {other:?}"),
        };
        let file = write_par(&tree).ok();
        files += usize::from(file.is_some());
        for body in m.leaves() {
            let leaf = m.bodies[body].name.as_str();
            let Ok(chain) = m.chain(None, Some(leaf), Convention::Khalil) else { continue };
            // What follows a joint beside the way counts by itself in chains of bodies, as that joint in rows.
            if chain.joints.iter().any(|&j| m.joints[j].follows.is_some()) {
                continue;
            }
            let back = again.chain(None, Some(leaf), Convention::Khalil).unwrap().description;
            let from_file = file.as_ref().map(|file| {
                let row = file.frames.iter().find(|f| f.0 == leaf).unwrap().1.to_string();
                par(&file.text).chain(None, Some(&row), Convention::Khalil).unwrap().description
            });
            for back in [Some(back), from_file].into_iter().flatten() {
                all += 1;
                match compare(&chain.description, &back) {
                    Comparison::Proved => proved += 1,
                    Comparison::Sampled(by) if by < 1e-14 => {}
                    other => panic!("{name}, {leaf}: {other:?}"),
                }
            }
        }
    }
    // The others have decimals with 18 places, which need not be the same ones in a chain and in a tree.
    assert!(files >= 4 && all >= 60 && proved >= all / 2, "{files} files; {proved} of {all}");
}

/// The structures beside the catalogue: all their frames are where their chains have them.
#[test]
fn structures_are_read_and_their_chains_agree() {
    let mut random = Random(11);
    for (name, joints, frames) in
        [("dual-arm", 13, 17), ("mobile-arm", 7, 10), ("gripper", 3, 8), ("humanoid", 31, 37)]
    {
        let path = format!("{}/structures/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let tree = tree(&std::fs::read_to_string(path).unwrap());
        let m = tree.mechanism().unwrap();
        assert_eq!((m.variables().len(), m.bodies.len()), (joints, frames), "{name}");
        let q: Vec<f64> = (0..joints).map(|_| 2.0 * random.unit() - 1.0).collect();
        let all = m
            .frames_program(&(0..m.bodies.len()).collect::<Vec<_>>())
            .compile(&[])
            .scalar()
            .eval(&q)
            .to_vec();
        for (b, body) in m.bodies.iter().enumerate().skip(1) {
            let chain = tree.chain(None, Some(&body.name), Convention::Khalil).unwrap();
            // A joint that follows another is counted as that one in rows, by itself in chains of bodies.
            if name == "gripper" {
                continue;
            }
            // The variables on the way, as the tree numbers them.
            let by_axes = m.chain(None, Some(&body.name), Convention::Craig).unwrap();
            let at = |j: &usize| m.variables().iter().position(|v| v == j).unwrap();
            let by_rows: Vec<f64> = by_axes.joints.iter().map(|j| q[at(j)]).collect();
            let entries: Vec<f64> = all[16 * b..][..16].to_vec();
            for d in [&chain.description, &by_axes.description] {
                let found = pose(d, &by_rows).matrix().concat();
                let off = entries.iter().zip(&found).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(off < 1e-14, "{name}, {}: {off}", body.name);
            }
        }
    }
    // The platform drives along x and y and turns about z.
    let path = format!("{}/structures/mobile-arm.toml", env!("CARGO_MANIFEST_DIR"));
    let tree = tree(&std::fs::read_to_string(path).unwrap());
    let d = tree.chain(None, Some("heading"), Convention::Khalil).unwrap().description;
    let expected = Transform::translation(0.7, -0.4, 0.0) * Transform::rotation_z(0.3);
    assert!(apart(&pose(&d, &[0.7, -0.4, 0.3]), &expected) < 1e-15);
}

/// Joints with gears, of any sign, and rows that others move too: bodies and joints move as the rows do, and so does what is
/// written of them.
#[test]
fn gears_turn_by_their_factor() {
    let mut random = Random(29);
    let mut compared = 0;
    for _ in 0..40 {
        let mut pick = |of: &[&str]| of[(of.len() as f64 * random.unit()) as usize].to_string();
        let convention = pick(&["standard", "craig", "khalil"]);
        let along = if convention == "khalil" { ["r", "d"] } else { ["d", "a"] };
        let mut text = format!("name = \"gears\"\nconvention = \"{convention}\"\n");
        let joints = 3;
        for k in 1..=joints {
            let own = format!("{}*q{k}", pick(&["1", "-1", "2", "-3", "0.5", "-0.25"]));
            let more = if k > 1 { pick(&["", " + q1", " - 0.5*q1", " + 2*q1"]) } else { String::new() };
            let (turn, slide) = match pick(&["turn", "turn", "slide"]).as_str() {
                "slide" => (pick(&["0", "30 deg"]), own),
                _ => (own + &more, pick(&["0", "0.4"])),
            };
            let (alpha, a) = (pick(&["0", "90 deg", "-90 deg"]), pick(&["0", "0.3"]));
            let [z, x] = along;
            text += &format!(
                "[[joints]]\nalpha = \"{alpha}\"\n{x} = {a}\ntheta = \"{turn}\"\n{z} = \"{slide}\"\n"
            );
        }
        // A turn cannot follow a slide.
        let Ok((d, _)) = read_toml(&text) else { continue };
        let q: Vec<f64> = (0..joints).map(|_| 2.0 * random.unit() - 1.0).collect();
        let is_same = |back: &Description, how: &str| match compare(&d, back) {
            Comparison::Proved => {}
            Comparison::Sampled(by) if by < 1e-12 => {}
            other => panic!("{how}: {other:?}\n{text}"),
        };
        let bodies = Mechanism::of(&d).expect("numbers");
        is_same(
            &bodies.chain(Some("base"), Some("tool"), d.convention).expect("a chain").description,
            "bodies",
        );
        let tool = bodies.body("tool").expect("a tool");
        assert!(apart(&bodies.poses(&q)[tool], &pose(&d, &q)) < 1e-12, "{text}");
        let rows = RowTree::of_chain(&d);
        let (end, m) = (rows.frame_names().pop().expect("frames"), rows.mechanism().expect("numbers"));
        assert!(apart(&m.poses(&q)[m.body(&end).expect("the end")], &pose(&d, &q)) < 1e-12, "{text}");
        let chain =
            |m: Mechanism| m.chain(Some("base"), Some("tool"), d.convention).expect("a chain").description;
        let urdf = read_urdf(&write_urdf(&bodies), Decimals::Meant).expect("a URDF").0;
        is_same(&chain(urdf), "URDF");
        let mjcf =
            read_mjcf("gears", &write_mjcf(&bodies), &mut Alone, Decimals::Meant).0.expect("a model").0;
        is_same(&chain(mjcf), "MJCF");
        compared += 1;
    }
    assert!(compared > 20, "{compared}");
}

/// Configurations of a tree have a value for each variable of it; those of a chain the values of its own.
#[test]
fn a_tree_has_poses() {
    let text = "convention = \"khalil\"\ntip = \"c\"\n[[joints]]\nname = \"a\"\ntheta = \"q1\"\n[[joints]]\nname = \"b\"\nd = 1\n\
                theta = \"q2\"\n[[joints]]\nname = \"c\"\nafter = \"a\"\nd = 2\nr = \"q3\"\n[poses]\nhome = [\"30 deg\", 1, 0.5]\n";
    let read = tree(text);
    let again = tree(&write_tree(&read));
    let degrees = |n| Expr::from(Rational::new(n, 180)) * Expr::pi();
    let all = vec![("home".to_string(), vec![degrees(30), Expr::int(1), Rational::new(1, 2).into()])];
    assert_eq!((&read.poses, &again.poses), (&all, &all));
    let chain = again.chain(None, None, Convention::Khalil).unwrap().description;
    assert_eq!(chain.poses, [("home".to_string(), vec![all[0].1[0], all[0].1[2]])]);
    let bodies = again.mechanism().unwrap();
    assert_eq!(bodies.poses, all);
    assert_eq!(RowTree::of_mechanism(&bodies).unwrap().poses, all);
    let wrong = text.replace(", 0.5]", "]");
    assert_eq!(
        shown(&wrong, &read_robot(&wrong).unwrap_err()),
        ["16:8: the pose `home` has 2 values for 3 joint variables"]
    );
}

/// Frames alone, of which none moves, are a tree.
#[test]
fn a_tree_may_stand_still() {
    let text = "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='fixed'><origin xyz='1 2 3'/>\
                <parent link='a'/><child link='b'/></joint></robot>";
    let (m, _) = read_urdf(text, Decimals::Meant).unwrap();
    let again = tree(&write_tree(&RowTree::of_mechanism(&m).unwrap()));
    assert_eq!((again.rows.len(), again.frames.len()), (0, 1));
    assert_eq!(again.frames[0].pose.translation.0, [1, 2, 3].map(Expr::int));
    assert!(matches!(again.chain(None, None, Convention::Khalil), Err(NoChain::Rigid { .. })));
    let empty = "convention = \"khalil\"\n";
    assert_eq!(shown(empty, &read_robot(empty).unwrap_err()), ["1:1: there are no joints"]);
}

/// Frames with names on frame 0 are frames of the chains that begin there, and their parameters are parameters of these.
#[test]
fn frames_of_a_chain_keep_their_parameters() {
    let text = "convention = \"khalil\"\ntip = \"a\"\n[parameters]\nL = 0.5\nK = 0.25\n[[joints]]\nname = \"a\"\ntheta = \"q1\"\n\
                [[joints]]\nname = \"b\"\nd = 1\ntheta = \"q2\"\n[[frames]]\nname = \"f\"\non = \"a\"\nxyz = [\"L\", 0, 0]\n\
                [[frames]]\nname = \"g\"\non = \"base\"\nxyz = [\"K\", 0, 0]\n";
    let chain = tree(text).chain(None, None, Convention::Khalil).unwrap();
    let names: Vec<(&str, Option<usize>)> = chain.frames.iter().map(|f| (f.name.as_str(), f.on)).collect();
    assert_eq!(names, [("f", Some(0)), ("g", None)]);
    for frame in &chain.frames {
        let x = frame.pose.translation[0].eval(|s| chain.description.value(s));
        assert!(x.is_ok_and(|x| x > 0.2), "{}", frame.name);
    }
}

/// A tree of many joints, all exact, is written as rows and held against them at once: by its joints, not by its chains.
#[test]
fn a_tree_of_many_joints_is_compared_soon() {
    let mut random = Random(499);
    let mut text = String::from("<robot name='r'><link name='l0'/>");
    for i in 1..500 {
        let parent = if i < 250 { i - 1 } else { i - 249 };
        let axis = ["1 0 0", "0 1 0", "0 0 1"][(random.unit() * 3.0) as usize % 3];
        let turn =
            ["0 0 0", "1.5707963267948966 0 0", "0 0.7853981633974483 0"][(random.unit() * 3.0) as usize % 3];
        text += &format!(
            "<link name='l{i}'/><joint name='j{i}' type='continuous'><origin xyz='0.3 0 0' rpy='{turn}'/>\
             <parent link='l{parent}'/><child link='l{i}'/><axis xyz='{axis}'/></joint>"
        );
    }
    text += "</robot>";
    let start = Instant::now();
    let (m, _) = read_urdf(&text, Decimals::Meant).unwrap();
    let rows = RowTree::of_mechanism(&m).unwrap();
    let back = tree(&write_tree(&rows));
    let ends: Vec<(String, String)> = rows.frames.iter().map(|f| (f.name.clone(), f.name.clone())).collect();
    let same = compare_chains(Tree::Bodies(&m), &back, &ends);
    assert_eq!((same.count(), same.others, same.open), (ends.len(), 0, 0));
    assert!(!same.differ() && same.proved == ends.len(), "{same:?}");
    // A link that is longer is seen in the chains over it, a joint that counts otherwise as well.
    let longer = text.replacen("xyz='0.3 0 0'", "xyz='0.4 0 0'", 1);
    let other = compare_chains(Tree::Bodies(&read_urdf(&longer, Decimals::Meant).unwrap().0), &back, &ends);
    assert!(other.differ() && other.most > 0.05, "{other:?}");
    let sliding = text.replacen("continuous", "prismatic", 1);
    let other = compare_chains(Tree::Bodies(&read_urdf(&sliding, Decimals::Meant).unwrap().0), &back, &ends);
    assert!(other.others > 200, "{other:?}");
    assert!(start.elapsed().as_secs() < 100, "{:?}", start.elapsed());
}
