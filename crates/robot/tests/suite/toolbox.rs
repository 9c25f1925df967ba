//! Robots out of programs for the toolboxes of MATLAB and Python.

use crate::common::shown;
use denavit::catalogue;
use denavit::description::{Convention, Description, Language, prove_same_chain, read_program, read_toml};
use denavit::robot::Robot;

fn read(text: &str, language: Language) -> Description {
    match read_program(text, language, None) {
        Ok((d, _)) => d,
        Err(found) => panic!("{}\n{text}", denavit::description::render(&found, "program", text)),
    }
}

fn same(d: &Description, rows: &str) {
    let toml = format!("name = \"t\"\n{rows}");
    let other =
        read_toml(&toml).unwrap_or_else(|f| panic!("{}", denavit::description::render(&f, "t", &toml))).0;
    assert!(prove_same_chain(&d.in_numbers(), &other.in_numbers()).is_equal(), "{d:?}");
}

const PUMA: &str = "convention = \"standard\"\n[[joints]]\ntheta = \"q1\"\nalpha = \"90 deg\"\n[[joints]]\ntheta = \"q2\"\na = 0.4318\n\
                    [[joints]]\ntheta = \"q3\"\nd = 0.15005\na = 0.0203\nalpha = \"-90 deg\"\n";

#[test]
fn links_of_matlab_are_a_table() {
    for text in [
        "% Puma\nL(1) = Link([0 0 0 pi/2], 'standard');\nL(2) = Link([ 0 0 0.4318 0 0]);\nL(3) = Link([0 0.15005 0.0203 -pi/2 0]);\np = SerialLink(L, 'name', 'Puma');",
        "L1 = Link('d', 0, 'a', 0, 'alpha', pi/2);\nL3 = Link('d', 0.15005, 'a', 0.0203, ... the elbow\n  'alpha', -pi/2);\n\
         L2 = Link('d', 0, 'a', 431.8/1000, 'alpha', 0, 'm', 17.4);\np = SerialLink([L1 L2 L3]);",
        "deg = pi/180; a2 = 0.4318; d3 = 0.15005;\nL = [Revolute('d', 0, 'a', 0, 'alpha', 90*deg), Revolute('a', a2, 'alpha', 0), \
         Revolute('d', d3, 'a', 0.0203, 'alpha', deg2rad(-90))];\np = SerialLink(L)",
        "dh = [0 0 0 pi/2; 0 0 0.4318 0\n 0 0.15005 0.0203 -pi/2];\nr = SerialLink(dh);",
        "dhparams = [0  pi/2  0  0;\n 0.4318  0  0  0\n 0.0203 -pi/2 0.15005 0];\nrobot = rigidBodyTree;\nfor i = 1:3\n\
         jnt = rigidBodyJoint(['j' num2str(i)], 'revolute');\nsetFixedTransform(jnt, dhparams(i,:), 'dh');\nend",
    ] {
        let d = read(text, Language::Matlab);
        same(&d, PUMA);
        assert_eq!(d.convention, Convention::Standard);
    }
}

#[test]
fn links_of_python_are_a_table() {
    let text = "import roboticstoolbox as rtb\nfrom math import pi\nimport numpy as np\n\"\"\" RevoluteDH(a=9) is none \"\"\"\nd3 = 0.15005  # RevoluteDH(a=1)\n\
                robot = rtb.DHRobot([\n    rtb.RevoluteDH(alpha=np.pi/2),\n    rtb.RevoluteDH(0, 431.8e-3),\n    \
                rtb.DHLink(d3, -pi/2, 0, 0.0203),\n], name=\"Puma\")";
    let d = read(text, Language::Python);
    same(&d, PUMA);
    assert_eq!(d.name, "Puma");
    // A slide, a modified table, an offset, a joint the other way round, limits.
    let text = "links = [RevoluteMDH(d=0.4, offset=np.deg2rad(30), qlim=[-pi, pi/2]), PrismaticMDH(alpha=-pi/2, theta=pi/2, offset=0.1),\n\
                RevoluteMDH(a=0.2, alpha=pi/2, flip=True)]\nr = DHRobot(links)";
    let d = read(text, Language::Python);
    assert_eq!(d.convention, Convention::Craig);
    same(
        &d,
        "convention = \"craig\"\n[[joints]]\ntheta = \"q1 + 30 deg\"\nd = 0.4\n[[joints]]\nalpha = \"-90 deg\"\ntheta = \"90 deg\"\nd = \"q2 + 0.1\"\n\
         [[joints]]\nalpha = \"90 deg\"\na = 0.2\ntheta = \"-q3\"\n",
    );
    let ends = d.rows[0].limits.unwrap().map(|e| e.eval(|_| None).unwrap());
    assert_eq!(ends, [-std::f64::consts::PI, std::f64::consts::FRAC_PI_2]);
    // Names without a value are parameters.
    let d = read(
        "syms = symbols('a1 a2')\nr = DHRobot([RevoluteDH(a=a1), RevoluteDH(a=2*a2)])",
        Language::Python,
    );
    assert_eq!(d.parameters.len(), 2);
}

/// In a text or a document a program is read as such where a table does not have what it says.
#[test]
fn programs_in_texts_keep_offsets_and_conventions() {
    use denavit::description::{TableKind, TableOptions, read_table};
    let read = |text: &str| read_table(text, TableKind::Markdown, &TableOptions::default());
    let offset = "convention = \"standard\"\n[[joints]]\ntheta = \"q1 + 90 deg\"\nd = 0.5\na = 0.1\nalpha = \"90 deg\"\n[[joints]]\ntheta = \"q2\"\na = 0.4\n";
    same(&read("L(1) = Link([0 0.5 0.1 pi/2 0 pi/2]);\nL(2) = Link([0 0 0.4 0 0 0]);\n").unwrap().0, offset);
    let python = "robot = DHRobot([\n    RevoluteDH(d=0.5, a=0.1, alpha=np.pi/2, offset=pi/2),\n    RevoluteDH(a=0.4),\n])";
    same(&read(python).unwrap().0, offset);
    let modified = "r = DHRobot([RevoluteMDH(a=0.1), RevoluteMDH(a=0.4)])";
    assert_eq!(read(modified).unwrap().0.convention, Convention::Craig);
    let standard = TableOptions { convention: Some(Convention::Standard), ..TableOptions::default() };
    assert!(read_table(modified, TableKind::Markdown, &standard).is_err());
}

/// Every arm of the catalogue whose rows a toolbox has goes to Python and back.
#[test]
fn arms_of_the_catalogue_go_to_programs_and_back() {
    let mut count = 0;
    for name in catalogue::names() {
        let d = catalogue::robot(name).unwrap().in_numbers();
        let suffix = match d.convention {
            Convention::Standard => "DH",
            Convention::Craig => "MDH",
            Convention::Khalil => continue,
        };
        let text = |e: denavit_symbolic::Expr| format!("{:.17}", e.eval(|_| None).unwrap_or(f64::NAN));
        let at_rest = |e: denavit_symbolic::Expr| e.substitute(|_| Some(denavit_symbolic::Expr::int(0)));
        let link = |r: &denavit::description::Row| {
            use denavit::description::JointKind::{Prismatic, Revolute};
            let v = r.variable?;
            let own = |e: denavit_symbolic::Expr| {
                e - at_rest(e) == denavit_symbolic::Expr::symbol(&v.symbol.name())
            };
            let (theta, d) = (at_rest(r.theta), at_rest(r.d));
            Some(match v.kind {
                Revolute if own(r.theta) => {
                    let (d, a, alpha) = (text(d), text(r.a), text(r.alpha));
                    format!("Revolute{suffix}(d={d}, a={a}, alpha={alpha}, offset={})", text(theta))
                }
                Prismatic if own(r.d) => {
                    let (theta, a, alpha) = (text(theta), text(r.a), text(r.alpha));
                    format!("Prismatic{suffix}(theta={theta}, a={a}, alpha={alpha}, offset={})", text(d))
                }
                _ => return None,
            })
        };
        let Some(links) = d.rows.iter().map(link).collect::<Option<Vec<String>>>() else { continue };
        let back = read(&format!("r = DHRobot([{}])", links.join(", ")), Language::Python);
        let q: Vec<f64> = (0..links.len()).map(|k| 0.3 + 0.2 * k as f64).collect();
        let pose = |d: &Description| Robot::numeric(d).unwrap().pose(&q).matrix().concat();
        let d = Description { base: back.base, tool: back.tool, ..d };
        let off = pose(&d).iter().zip(pose(&back)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-12, "{name}: {off}");
        count += 1;
    }
    assert!(count > 30, "{count}");
}

#[test]
fn what_is_wrong_with_a_program_has_its_place() {
    let said = |text: &str| {
        let found = shown(text, &read_program(text, Language::Python, None).expect_err(text));
        found.into_iter().find(|f| f.contains(" error: ")).expect("an error")
    };
    for (text, expected) in [
        ("x = 1", "1:1 error: no robot is made in this program"),
        (
            "r = DHRobot([RevoluteDH(a=1), RevoluteMDH(a=1)])",
            "1:31 error: standard and modified links in one robot",
        ),
        (
            "a = DHRobot([RevoluteDH(a=1)])\nb = DHRobot([RevoluteDH(a=2)])",
            "2:5 error: the program makes 2 robots",
        ),
        ("r = DHRobot([RevoluteDH(1, 2, 3, 4, 5)])", "1:37 error: what does this value say?"),
        ("r = DHRobot([RevoluteDH(a=q2)])", "1:27 error: the joint variable `q2` beside the joint's own"),
        ("r = DHRobot([RevoluteDH(a=1 +)])", "1:27 error: "),
        ("a = b\nb = a\nr = DHRobot([RevoluteDH(a=[1, 2])])", "3:27 error: "),
    ] {
        assert!(said(text).starts_with(expected), "{text}: {}", said(text));
    }
    // Brackets without end, long lines, names in rings: an answer at once.
    for text in [
        "Link(".repeat(20_000),
        "[".repeat(50_000),
        "a = a\n".repeat(2_000) + "r = DHRobot([RevoluteDH(a=a)])",
        "'".repeat(30_000),
        "Link([1 2 3 4])".repeat(3_000),
    ] {
        let _ = read_program(&text, Language::Python, None);
        let _ = read_program(&text, Language::Matlab, None);
    }
}
