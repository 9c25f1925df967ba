//! Tables as the program writes them for documents.

use denavit::catalogue;
use denavit::description::{
    Convention, Description, TableKind, TableOptions, prove_same_chain, read_table, read_toml, write_table,
};
use denavit::robot::Robot;

const KINDS: [TableKind; 3] = [TableKind::Markdown, TableKind::Csv, TableKind::Latex];

#[test]
fn every_catalogue_arm_goes_to_a_table_and_back() {
    let (mut with_names, mut proved, mut off) = (0, 0, 0.0_f64);
    for name in catalogue::names() {
        let robot = catalogue::robot(name).unwrap();
        for convention in Convention::ALL {
            let d = robot.converted(convention).description;
            for kind in KINDS {
                let text = write_table(&d, kind).unwrap_or_else(|e| panic!("{name} {convention}: {e:?}"));
                let read = read_table(&text, kind, &TableOptions::default());
                let (back, _) = read.unwrap_or_else(|f| {
                    panic!("{name}\n{}\n{text}", denavit::description::render(&f, "table", &text))
                });
                assert_eq!(back.convention, convention, "{name}");
                let kept = prove_same_chain(&d, &back).is_equal();
                let same = kept || prove_same_chain(&d.in_numbers(), &back.in_numbers()).is_equal();
                with_names += usize::from(kept && !d.parameters.is_empty());
                // Rows for bases and tools whose normals are roots, or their angles arcs, hold decimals.
                off = off.max(if same { 0.0 } else { apart(&d, &back) });
                proved += usize::from(same);
                let limits = |d: &Description| {
                    d.rows.iter().filter(|r| r.variable.is_some()).map(|r| r.limits).collect::<Vec<_>>()
                };
                assert_eq!(limits(&back), limits(&d), "{name} {convention} {kind:?}\n{text}");
            }
        }
    }
    let all = 9 * catalogue::names().len();
    assert!(with_names >= 300 && proved >= all - 40, "{with_names} with names, {proved} of {all} proved");
    assert!(off < 1e-15, "{off}");
}

/// The largest difference of the poses at rest and somewhere else.
fn apart(a: &Description, b: &Description) -> f64 {
    let [a, b] = [a, b].map(|d| Robot::numeric(d).unwrap());
    let q: Vec<f64> = (0..a.joints).map(|i| 0.3 + 0.4 * i as f64).collect();
    let [x, y] = [&a, &b].map(|r| r.pose(&q).matrix().concat());
    x.iter().zip(&y).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

/// An arm whose base and tool need rows of their own, and share nothing with its first and last axis.
const ASKEW: &str = r#"
    name = "Askew"
    convention = "standard"
    parameters = { h = "300 mm", t = "80 mm" }
    base = { xyz = ["0.1 m", "0.2 m", "h"], rpy = ["0", "30 deg", "45 deg"] }
    tool = { xyz = ["0.05 m", "0", "t"], rpy = ["90 deg", "0", "15 deg"] }
    joints = [
        { theta = "q1 + 90 deg", alpha = "-90 deg", limits = ["-1 rad", "1 rad"], name = "a|b_c" },
        { d = "q2 + 0.2 m", a = "0.1 m", alpha = "90 deg" },
        { theta = "q3 - q1" },
    ]
"#;

#[test]
fn base_and_tool_are_rows() {
    for convention in Convention::ALL {
        let (d, _) = read_toml(ASKEW).unwrap();
        let d = d.converted(convention).description;
        let ends = d.with_ends_in_rows().unwrap();
        assert!(prove_same_chain(&d, &ends).is_equal(), "{convention}");
        assert!(ends.rows.len() <= d.rows.len() + 3, "{convention}: {} rows", ends.rows.len());
        assert_eq!(ends.parameters.len(), 2, "{convention}: names of lengths stay");
        for kind in KINDS {
            let text = write_table(&d, kind).unwrap();
            let (back, _) = read_table(&text, kind, &TableOptions::default())
                .unwrap_or_else(|f| panic!("{}\n{text}", denavit::description::render(&f, "table", &text)));
            assert!(prove_same_chain(&d, &back).is_equal(), "{convention} {kind:?}\n{text}");
        }
    }
}
