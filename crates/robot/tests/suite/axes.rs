//! Robots that are given by their axes at rest, or as products of exponentials.

use crate::common::Random;
use denavit::catalogue;
use denavit::description::{
    AxesAs, Convention, Description, Diagnostic, line_column, prove_same_chain, read_toml, write_axes,
};
use denavit::geometry::{Rotation, Transform, Vector};
use denavit::robot::Robot;

const WAYS: [AxesAs; 3] = [AxesAs::Lines, AxesAs::Screws, AxesAs::BodyScrews];

fn read(text: &str) -> Description {
    read_toml(text).unwrap_or_else(|f| panic!("{}\n{text}", denavit::description::render(&f, "", text))).0
}

#[test]
fn every_catalogue_arm_goes_to_its_axes_and_back() {
    let mut with_names = 0;
    for name in catalogue::names() {
        let d = catalogue::robot(name).unwrap();
        for way in WAYS {
            let text = write_axes(&d, way).unwrap();
            let back = read(&text);
            assert_eq!(back.convention, d.convention, "{name}");
            let names = |d: &Description| d.rows.iter().filter_map(|r| r.name.clone()).collect::<Vec<_>>();
            let limits = |d: &Description| {
                d.rows.iter().filter(|r| r.variable.is_some()).map(|r| r.limits).collect::<Vec<_>>()
            };
            assert_eq!((names(&back), limits(&back)), (names(&d), limits(&d)), "{name}");
            let kept = back.parameters.len() == d.parameters.len();
            with_names += usize::from(kept && !d.parameters.is_empty());
            // What keeps its names is the same for all values; else with the values that there are.
            let same = match kept {
                true => prove_same_chain(&d, &back),
                false => prove_same_chain(&d.in_numbers(), &back.in_numbers()),
            };
            // The tool of this one is off by a decimal of its own.
            assert!(same.is_equal() || name == "al5d", "{name} as {way:?}: {same:?}\n{text}");
        }
    }
    assert!(with_names >= 40, "{with_names} with names");
}

/// exp(ξq)
fn exponential(w: [f64; 3], v: [f64; 3], q: f64) -> Transform<f64> {
    if w == [0.0; 3] {
        return Transform::from_rotation_translation(Rotation::identity(), Vector(v.map(|x| x * q)));
    }
    let ([x, y, z], (s, c)) = (w, q.sin_cos());
    let u = 1.0 - c;
    let r = Rotation::from_rows([
        [c + u * x * x, u * x * y - s * z, u * x * z + s * y],
        [u * x * y + s * z, c + u * y * y, u * y * z - s * x],
        [u * x * z - s * y, u * y * z + s * x, c + u * z * z],
    ]);
    // p = (1 − R)(ω × v) + ω ωᵀ v q
    let (w, v) = (Vector(w), Vector(v));
    let across = w.cross(v);
    let turned = Transform::from_rotation_translation(r, Vector::zero()).act_on_vector(across);
    Transform::from_rotation_translation(r, across - turned + w.scale(w.dot(v) * q))
}

/// The UR5 as Lynch and Park have it (Modern Robotics, example 4.5), and a slide in front of it.
const UR5: &str = r#"
name = "UR5 on a rail"

[parameters]
W1 = "109 mm"
W2 = "82 mm"
L1 = "425 mm"
L2 = "392 mm"
H1 = "89 mm"
H2 = "95 mm"

[[screws]]
omega = [0, 0, 0]
v = [0, 1, 0]

[[screws]]
omega = [0, 0, 1]
v = [0, 0, 0]

[[screws]]
omega = [0, 1, 0]
v = ["-H1", 0, 0]

[[screws]]
omega = [0, 1, 0]
v = ["-H1", 0, "L1"]

[[screws]]
omega = [0, 1, 0]
v = ["-H1", 0, "L1 + L2"]

[[screws]]
omega = [0, 0, -1]
v = ["-W1", "L1 + L2", 0]

[[screws]]
omega = [0, 1, 0]
v = ["H2 - H1", 0, "L1 + L2"]

[tip]
matrix = [[-1, 0, 0, "L1 + L2"], [0, 0, 1, "W1 + W2"], [0, 1, 0, "H1 - H2"], [0, 0, 0, 1]]
"#;

#[test]
fn a_product_of_exponentials_is_its_table() {
    let (w1, w2, l1, l2, h1, h2) = (0.109, 0.082, 0.425, 0.392, 0.089, 0.095);
    let screws = [
        ([0.0; 3], [0.0, 1.0, 0.0]),
        ([0.0, 0.0, 1.0], [0.0; 3]),
        ([0.0, 1.0, 0.0], [-h1, 0.0, 0.0]),
        ([0.0, 1.0, 0.0], [-h1, 0.0, l1]),
        ([0.0, 1.0, 0.0], [-h1, 0.0, l1 + l2]),
        ([0.0, 0.0, -1.0], [-w1, l1 + l2, 0.0]),
        ([0.0, 1.0, 0.0], [h2 - h1, 0.0, l1 + l2]),
    ];
    let m =
        [[-1.0, 0.0, 0.0, l1 + l2], [0.0, 0.0, 1.0, w1 + w2], [0.0, 1.0, 0.0, h1 - h2], [0.0, 0.0, 0.0, 1.0]];
    let m = Transform::from_matrix(m).unwrap();
    let mut random = Random(7);
    for convention in Convention::ALL {
        let d = read(&format!("convention = \"{convention}\"\n{UR5}"));
        assert_eq!((d.convention, d.parameters.len()), (convention, 6), "its names stay");
        assert!(d.rows.iter().any(|r| !r.a.symbols().is_empty() || !r.d.symbols().is_empty()));
        let robot = Robot::numeric(&d).unwrap();
        for _ in 0..20 {
            let q: Vec<f64> = (0..7).map(|_| 4.0 * random.unit() - 2.0).collect();
            let exact =
                screws.iter().zip(&q).fold(Transform::identity(), |x, (s, q)| x * exponential(s.0, s.1, *q))
                    * m;
            for (a, b) in robot.pose(&q).matrix().concat().iter().zip(exact.matrix().concat()) {
                assert!((a - b).abs() < 1e-14, "{convention}: {a} {b}");
            }
        }
    }
}

#[test]
fn names_without_values_stay_if_the_table_is_the_same_for_all() {
    let text = |second: &str| {
        format!(
            "[parameters]\nl1 = \"\"\nl2 = \"\"\n[[axes]]\npoint = [0, 0, 0]\ndirection = \"z\"\n\
             [[axes]]\npoint = {second}\ndirection = [0, -1, 0]\n\
             [tip]\nxyz = [\"l2\", 0, \"l1\"]\n"
        )
    };
    let d = read(&text("[0, 0, \"l1\"]"));
    assert_eq!(d.parameters.len(), 2);
    assert_eq!(format!("{}", d.rows[0].d), "l1");
    assert!(
        d.rows.iter().any(|r| format!("{} {}", r.a, r.d).contains("l2"))
            || format!("{:?}", d.tool).contains("l2")
    );
    // Across both the distance is a root.
    let text = text("[\"l1\", \"l2\", 0]").replace("[0, -1, 0]", "\"z\"");
    let findings = read_toml(&text).unwrap_err();
    assert_eq!(shown(&text, &findings), ["4:1: the table is not the same for all values of `l1`, `l2`"]);
    let d = read(&text.replace("l1 = \"\"", "l1 = \"3 m\"").replace("l2 = \"\"", "l2 = \"4 m\""));
    assert_eq!((d.parameters.len(), format!("{}", d.rows[0].a)), (0, "5".to_string()));
}

fn shown(text: &str, findings: &[Diagnostic]) -> Vec<String> {
    let one = |d: &Diagnostic| {
        let (line, column) = line_column(text, d.span.start);
        format!("{line}:{column}: {}", d.message)
    };
    findings.iter().filter(|d| d.severity == denavit::description::Severity::Error).map(one).collect()
}

#[test]
fn what_is_wrong_with_axes_has_its_place() {
    for (text, expected) in [
        ("axes = []\n", &["1:8: there are no axes"] as &[&str]),
        (
            "[[axes]]\npoint = [0, 0]\ndirection = [0, 0, 0]\n[[axes]]\nkind = \"ball\"\n[[axes]]\n",
            &[
                "2:9: point has 3 values, not 2",
                "3:13: this axis has no direction",
                "5:8: an axis is \"revolute\" or \"prismatic\"",
                "6:1: the axis has no direction",
                "6:1: the axis has no point",
            ],
        ),
        ("[[axes]]\npoint = [0, 0, 0]\ndirection = \"w\"\n", &["3:13: no axis of this name"]),
        (
            "[[axes]]\npoint = [0, \"l\", 0]\ndirection = [0, \"k\", 1]\n",
            &["2:14: `l` is not declared", "3:18: `k` stands where a number is needed"],
        ),
        ("[[axes]]\npoint = [0, 0, 0]\ndirection = \"z\"\n[[joints]]\n", &["4:1: `joints` beside `axes`"]),
        (
            "[[axes]]\npoint = [0, 0, 0]\ndirection = \"z\"\nmoves = \"q2\"\n",
            &["4:9: the next joint variable is `q1`"],
        ),
        (
            "[[axes]]\npoint = [0, 0, 0]\ndirection = \"z\"\nmoves = \"q1 + 1\"\n",
            &["4:9: a sum of joint variables is expected here"],
        ),
        (
            "[[axes]]\npoint = [0, 0, 0]\ndirection = \"z\"\nlimits = [\"10 deg\", \"-10 deg\"]\n[tool]\n",
            &["4:10: the lower limit is above the upper one", "5:2: unknown key `tool`"],
        ),
        (
            "[[screws]]\nomega = [0, 0, 1]\nv = [0, 0, \"1 m\"]\n",
            &["3:5: v is not perpendicular to ω: the screw has a pitch"],
        ),
        ("[[screws]]\nomega = [0, 0, 2]\nv = [0, 0, 0]\n", &["2:9: ω has the length 2.0000, not 1"]),
        (
            "[[screws]]\nomega = [0, 0, 0]\nv = [0, 0, 3]\n[[screws]]\nomega = [0, 0, 1]\n",
            &[
                "3:5: v of a screw that slides has the length 3.0000, not 1",
                "4:1: a screw has `omega` and `v`",
            ],
        ),
    ] {
        let findings = read_toml(text).expect_err(text);
        let mut found = shown(text, &findings);
        found.retain(|f| !f.is_empty());
        assert_eq!(found, expected, "{text}");
    }
}

/// Forty joints whose frames are turned by decimals: exactly, an entry at the end is a sum of 2⁴⁰ products.
#[test]
fn long_chains_with_decimals_for_angles_are_written() {
    let mut random = Random(11);
    let mut text = String::from("name = \"Snake\"\nconvention = \"standard\"\n");
    for k in 1..=40 {
        let (a, alpha) = (0.1 + random.unit(), 1.0 + random.unit());
        text += &format!("\n[[joints]]\ntheta = \"q{k}\"\na = {a:.3}\nalpha = \"{alpha:.4} rad\"\n");
    }
    let d = read(&text);
    let robot = Robot::numeric(&d).unwrap();
    let q: Vec<f64> = (0..40).map(|_| random.unit() * 6.0 - 3.0).collect();
    for way in WAYS {
        let written = write_axes(&d, way).unwrap();
        let back = Robot::numeric(&read(&written)).unwrap();
        let (there, here) = (robot.pose(&q), back.pose(&q));
        let apart = (there.translation - here.translation).norm();
        assert!(apart < 1e-12, "{way:?}: {apart}");
    }
}
