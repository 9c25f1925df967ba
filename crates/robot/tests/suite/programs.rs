//! Programs that make robots are followed, and what is not followed is an error with its place.

use crate::common::shown;
use denavit::description::{Description, Language, prove_same_chain, read_program};

fn read(text: &str, language: Language) -> (Description, Vec<String>) {
    match read_program(text, language, None) {
        Ok((d, found)) => (d, shown(text, &found)),
        Err(found) => panic!("{}\n{text}", denavit::description::render(&found, "program", text)),
    }
}

fn same(text: &str, other: &str, language: Language) {
    let (a, b) = (read(text, language).0, read(other, language).0);
    assert!(prove_same_chain(&a.in_numbers(), &b.in_numbers()).is_equal(), "{text}\n{a:?}\n{b:?}");
}

/// Three links written out, in each language.
const MATLAB: &str = "L(1) = Link([0 0.4 0.1 pi/2]);\nL(2) = Link([0 0 0.3 0]);\nL(3) = Link([0 0.2 0 -pi/2]);\nr = SerialLink(L);";
const PYTHON: &str =
    "r = DHRobot([RevoluteDH(0.4, 0.1, pi/2), RevoluteDH(0, 0.3), RevoluteDH(0.2, 0, -pi/2)])";

#[test]
fn programs_of_matlab_are_followed() {
    for text in [
        // By index, in any order, with what is set later.
        "L(1) = Link([0 0.4 0.1 pi/2]);\nL(3) = Link([0 0.2 0 -pi/2]);\nL(2) = Link([0 0 0.3 0]);\nr = SerialLink(L);",
        "L(1) = Link([0 9 9 9]);\nL(2) = Link([0 0 0.3 0]);\nL(3) = Link([0 0.2 0 -pi/2]);\nL(1) = Link([0 0.4 0.1 pi/2]);\nr = SerialLink(L);",
        "L(1) = Link([0 0.4 5 pi/2]);\nL(2) = Link([0 0 0.3 0]);\nL(3) = Link([0 0.2 0 0]);\nL(1).a = 0.1; L(3).alpha = -pi/2;\nr = SerialLink(L);",
        "L(1) = Link([0 0.4 0.1 pi/2]);\nL(2) = Link([0 0 0.3 0]);\nL(3) = Link([0 0.2 0 -pi/2]);\nL(4) = Link([0 7 7 7]);\nr = SerialLink(L(1:3));",
        "L(1) = Link([0 0.4 0.1 pi/2]);\nL(end+1) = Link([0 0 0.3 0]);\nL = [L Link([0 0.2 0 -pi/2])];\nr = SerialLink(L);",
        "L = [Link([0 0.4 0.1 pi/2])\n  Link([0 0 0.3 0])\n  Link([0 0.2 0 -pi/2])];\nr = SerialLink([L(1) L(2) L(3)]);",
        "a = SerialLink([Link([0 0.4 0.1 pi/2]) Link([0 0 0.3 0])]);\nb = a * SerialLink(Link([0 0.2 0 -pi/2]));\nr = SerialLink(b);",
        // Loops, vectors, tables of columns.
        "d = [0.4 0 0.2]; a = [0.1, 0.3, 0]; al = [pi/2 0 -pi/2];\nfor i=1:3\n  L(i) = Link([0 d(i) a(i) al(i)]);\nend\nr = SerialLink(L);",
        "d = [0.4 0 0.2]; al = [90 0 -90]*pi/180;\nn = length(d);\nfor i=1:n, L(i) = Revolute('d', d(i), 'alpha', al(i)); end\nL(1).a = 0.1; L(2).a = 0.3;\nr = SerialLink(L);",
        "mm = 1e-3;\nd = [400 0 200]'*mm;\na = [0.1, 0.3, 0]';\nalpha = [pi/2 0 -pi/2]';\ntheta = zeros(3,1);\nDH = [theta d a alpha];\nr = SerialLink(DH);",
        "DH = zeros(3,4);\nDH(1,:) = [0 0.4 0.1 pi/2];\nDH(2,3) = 0.3;\nDH(3,:) = [0 0.2 0 -pi/2];\nfor k = 1:size(DH,1)\n L(k) = Link(DH(k,:));\nend\nr = SerialLink(L);",
        // Comments, conditions, functions.
        "%{\nL(1) = Link([0 9 9 pi/2]);\n%{\ninner\n%}\n%}\nL(1) = Link([0 0.4 0.1 pi/2]); % L(2) = Link([0 5 5 5])\nif false\nL(2) = Link([0 0 0.9 0]);\nelse\nL(2) = Link([0 0 0.3 0]);\nend\nL(3) = Link([0 0.2 0 -pi/2]);\nr = SerialLink(L);",
        "function r = arm(N)\n if nargin == 0\n  N = 2;\n end\n L(1) = Link([0 0.4 0.1 pi/2]);\n L(N) = Link([0 0 0.3 0]);\n L(N+1) = link3(0.2);\n r = SerialLink(L, 'name', 'it''s');\nend\nfunction l = link3(d)\n l = Link([0 d 0 -pi/2]);\nend",
        // Trees, a variable for each joint or kinds in a list.
        "dhparams = [0.1 pi/2 0.4 0; 0.3 0 0 0; 0 -pi/2 0.2 0];\nrobot = rigidBodyTree('DataFormat','row');\n\
         body1 = rigidBody('body1');\njnt1 = rigidBodyJoint('jnt1','revolute');\nsetFixedTransform(jnt1,dhparams(1,:),'dh');\nbody1.Joint = jnt1;\naddBody(robot,body1,'base')\n\
         body2 = rigidBody('body2');\njnt2 = rigidBodyJoint('jnt2','revolute');\nsetFixedTransform(jnt2,dhparams(2,:),'dh');\nbody2.Joint = jnt2;\naddBody(robot,body2,'body1')\n\
         body3 = rigidBody('body3');\nbody3.Joint = rigidBodyJoint('jnt3','revolute');\nsetFixedTransform(body3.Joint,[0 -pi/2 0.2 0],'dh');\naddBody(robot,body3,'body2')\nshowdetails(robot)",
        "dhparams = [0.1 pi/2 0.4 0; 0.3 0 0 0; 0 -pi/2 0.2 0];\nkinds = {'revolute','revolute','revolute'};\nrobot = rigidBodyTree;\nbodies = cell(3,1);\n\
         for i = 1:3\n bodies{i} = rigidBody(['body' num2str(i)]);\n j = rigidBodyJoint(['jnt' num2str(i)], kinds{i});\n setFixedTransform(j, dhparams(i,:), 'dh');\n bodies{i}.Joint = j;\n\
         if i == 1\n  addBody(robot, bodies{i}, 'base')\n else\n  addBody(robot, bodies{i}, bodies{i-1}.Name)\n end\nend",
    ] {
        same(text, MATLAB, Language::Matlab);
    }
    // A joint the other way round, slides of a tree, limits in degrees, offsets set later.
    same(
        "r = SerialLink([Revolute('d', 0.4, 'flip', 'alpha', pi/2, 'offset', 1) Revolute('a', 0.3)]);",
        "L(1) = Link([0 0.4 0 pi/2 0 1]); L(2) = Link([0 0 0.3 0]);\nL(1).flip = true;\nr = SerialLink(L);",
        Language::Matlab,
    );
    let flipped =
        read("r = SerialLink([Revolute('d', 0.4, 'a', 1, 'flip') Revolute('a', 0.3)]);", Language::Matlab).0;
    let plain = read("r = SerialLink([Revolute('d', 0.4, 'a', 1) Revolute('a', 0.3)]);", Language::Matlab).0;
    assert!(!prove_same_chain(&flipped, &plain).is_equal());
    let tree = "kinds = {'revolute','prismatic'};\nfor i = 1:2\n j = rigidBodyJoint('j', kinds{i});\n setFixedTransform(j, [0.1 0 0.2 0.3], 'dh');\nend";
    let by_links = "r = SerialLink([Link([0 0.2 0.1 0]) Link([0.3 0 0.1 0 1])]);";
    same(tree, by_links, Language::Matlab);
    for limits in ["[-90 180]*pi/180", "[-90 180]*deg", "deg2rad([-90 180])", "[-pi/2, pi]"] {
        let text = format!(
            "deg = pi/180;\nL(1) = Link('d', 0, 'a', 1, 'alpha', 0, 'qlim', {limits});\nL(2) = Revolute('a', 1);\nL(2).qlim = {limits};\nr = SerialLink(L);"
        );
        for row in read(&text, Language::Matlab).0.rows {
            let ends = row.limits.expect(limits).map(|e| e.eval(|_| None).unwrap());
            assert!(
                (ends[0] + std::f64::consts::FRAC_PI_2).abs() < 1e-15
                    && (ends[1] - std::f64::consts::PI).abs() < 1e-15
            );
        }
    }
}

#[test]
fn programs_of_python_are_followed() {
    for text in [
        "d, a = [0.4, 0, 0.2], [0.1, 0.3, 0]\nalpha = [pi/2, 0, -pi/2]\nlinks = []\nfor j in range(3):\n    link = RevoluteDH(d=d[j], a=a[j], alpha=alpha[j])\n    links.append(link)\nr = DHRobot(links)",
        "import numpy as np\nd = np.r_[400, 0, 200] * 1e-3\na = np.array([0.1, 0.3, 0])\nalpha = np.deg2rad([90, 0, -90])\nr = DHRobot([RevoluteDH(d=d[i], a=a[i], alpha=alpha[i]) for i in range(len(d))])",
        "dh = np.array([[0.4, 0.1, pi/2], [0, 0.3, 0], [0.2, 0, -pi/2]])\nr = DHRobot([RevoluteDH(d=d, a=a, alpha=al) for d, a, al in dh])",
        "dh = [[0.4, 0.1, pi/2], [0, 0.3, 0], [0.2, 0, -pi/2]]\nlinks = [RevoluteDH(*()) for _ in range(0)]\nfor k, row in enumerate(dh):\n    links.append(RevoluteDH(d=row[0], a=dh[k][1], alpha=row[-1]))\nr = DHRobot(links)",
        "links = [RevoluteDH(0, 0.3)]\nlinks.insert(0, RevoluteDH(0.4, 0.1, pi/2))\nlinks.extend([RevoluteDH(0.2, 0, -pi/2)])\nr = DHRobot(links)",
        "links = [None] * 4\nlinks[2] = RevoluteDH(0.2, 0, -pi/2)\nlinks[0] = RevoluteDH(0.4, 9, pi/2)\nlinks[1] = RevoluteDH(0, 0.3)\nlinks[0].a = 0.1\nr = DHRobot(links[:3])",
        "if 0:\n    links = [RevoluteDH(a=9)]\nelif 1 > 2:\n    links = []\nelse:\n    links = [RevoluteDH(0.4, 0.1, pi/2), RevoluteDH(0, 0.3)]\nlinks += [RevoluteDH(0.2, 0, -pi/2)]\nr = DHRobot(links)",
        // A class, a link behind it that is none of it, functions with values, other names.
        "from roboticstoolbox import DHRobot, RevoluteDH as R\nclass Arm(DHRobot):\n    def __init__(self, symbolic=False):\n        if symbolic:\n            import spatialmath.base.symbolic as sym\n            pi = sym.pi()\n        else:\n            from math import pi\n        self.d1 = 0.4\n        L = [R(d=self.d1, a=0.1, alpha=pi / 2), R(a=0.3), R(0.2, alpha=-pi / 2)]\n        super().__init__(L, name=\"arm\")\n        self.qz = [0, 0, 0]\n\nif __name__ == \"__main__\":\n    stray = R(a=9)\n    arm = Arm()\n",
        "def link(d, a=0, alpha=0):\n    return RevoluteDH(d=d, a=a, alpha=alpha)\n\ndef make(height):\n    return DHRobot([link(height, 0.1, pi/2), link(0, a=0.3), link(height / 2, alpha=-pi/2)])\n\nif __name__ == '__main__':\n    r = make(0.4)\n",
    ] {
        same(text, PYTHON, Language::Python);
    }
    same(
        "r = DHRobot([RevoluteDH(a=1)]*2 + [PrismaticDH(offset=1)])",
        "r = DHRobot([RevoluteDH(a=1), RevoluteDH(a=1), PrismaticDH(offset=1)])",
        Language::Python,
    );
}

/// Where it stands and what it holds is said to be left out, wherever the program says it.
#[test]
fn what_a_robot_stands_on_is_said_to_be_left_out() {
    for (text, language, place) in [
        (
            "r = SerialLink([Link([0 1 0 0]) Link([0 0 1 0])]);\nr.tool = transl(0,0,1);",
            Language::Matlab,
            "2:1 warning: `tool` is not read",
        ),
        (
            "r = DHRobot([RevoluteDH(a=1), RevoluteDH(a=1)])\nr.base = SE3(0, 0, 1)",
            Language::Python,
            "2:1 warning: `base` is not read",
        ),
        (
            "r = DHRobot([RevoluteDH(a=1), RevoluteDH(a=1)], base=SE3(0, 0, 1))",
            Language::Python,
            "1:54 warning: `base` is not read",
        ),
    ] {
        let found = read(text, language).1;
        assert!(found.iter().any(|f| f.starts_with(place)), "{found:?}");
    }
    let none = read("r = DHRobot([RevoluteDH(a=1), RevoluteDH(a=1)], base=None)", Language::Python).1;
    assert!(!none.iter().any(|f| f.contains("warning")), "{none:?}");
}

#[test]
fn what_is_not_followed_is_an_error_with_its_place() {
    let said = |text: &str, language: Language| {
        let found = shown(text, &read_program(text, language, None).expect_err(text));
        found.into_iter().find(|f| f.contains(" error: ")).expect("an error")
    };
    for (text, expected) in [
        ("for i = 1:n\n L(i) = Link([0 0 1 0]);\nend\nr = SerialLink(L);", "1:1 error: `for i = 1:n`"),
        ("while k < 3\n L(k) = Link([0 0 1 0]);\nend\nr = SerialLink(L);", "1:1 error: "),
        (
            "x = f(3);\nr = SerialLink([Link([0 0 x 0]) Link([0 0 1 0])]);",
            "1:5 error: `f(3)` is not followed",
        ),
        ("r = SerialLink([Link([0 0 a(2) 0]) Link([0 0 1 0])]);", "1:27 error: `a(2)` is not followed"),
        ("L(1) = Link([0 0 1 0]);\nL(3) = Link([0 0 1 0]);\nr = SerialLink(L);", "3:16 error: "),
        (
            "L(1) = Link([0 0 1 0]); L(2) = Link([0 0 1 0]);\nL(1).nofriction();\nL(2).jointtype = 'P';\nr = SerialLink(L);",
            "2:1 error: ",
        ),
        (
            "L(1) = Link([0 0 1 0]); L(2) = Link([0 0 1 0]);\nif x > 1\n L(2).a = 3;\nend\nr = SerialLink(L);",
            "2:1 error: `if x > 1`",
        ),
        (
            "L(1) = Link([0 0 1 0]); L(2) = Link([0 0 1 0]);\nfor k = )\nL(2).a = 3;\nend\nr = SerialLink(L);",
            "2:1 error: ",
        ),
        ("r = SerialLink([Link([0 0 1 90], 'deg') Link([0 0 1 0])]);", "1:34 error: `'deg'` is not followed"),
        (
            "j = rigidBodyJoint('j','revolute');\nsetFixedTransform(j,[0 1 0 0],'dh');\nk = rigidBodyJoint('k',kinds(2));\nsetFixedTransform(k,[0 1 0 0],'dh');",
            "3:24 error: ",
        ),
        (
            "r = rigidBodyTree;\nj = rigidBodyJoint('j','revolute');\nsetFixedTransform(j,[0 1 0 0],'dh');\nb = rigidBody('b'); b.Joint = j;\nc = rigidBody('c');\naddBody(r,b,'base'); addBody(r,c,'base');",
            "6:22 error: ",
        ),
        ("L = [Link([0 0 1 0]) Link([0 0 2 0])];\nL(1) = [];\nr = SerialLink(L);", "2:1 error: `L(1)`"),
        (
            "L = [Link([0 0 1 0]) Link([0 0 2 0])];\neval('L(2).a = 7;');\nr = SerialLink(L);",
            "2:1 error: `eval(",
        ),
        ("r = SerialLink([Link([0 1d-3 0 0]) Link([0 0 1 0])]);", "1:22 error: "),
        (
            "r = rigidBodyTree;\nj = rigidBodyJoint('j','revolute');\nj.JointAxis = [0 1 0];\nsetFixedTransform(j,[0 1 0 0],'dh');",
            "3:1 error: ",
        ),
    ] {
        assert!(
            said(text, Language::Matlab).starts_with(expected),
            "{text}: {}",
            said(text, Language::Matlab)
        );
    }
    for (text, expected) in [
        ("links = [RevoluteDH(a=1) for i in things]\nr = DHRobot(links)", "1:9 error: "),
        (
            "links = [RevoluteDH(a=1), RevoluteDH(a=2)]\nlinks.sort(key=str)\nr = DHRobot(links)",
            "2:1 error: `links.sort(key=str)`",
        ),
        (
            "links = [RevoluteDH(a=1), RevoluteDH(a=2)]\nmend(links)\nr = DHRobot(links)",
            "2:1 error: `mend(links)`",
        ),
        (
            "links = [RevoluteDH(a=1), RevoluteDH(a=2)]\nif x:\n    links.pop()\nr = DHRobot(links)",
            "3:5 error: `links.pop()`",
        ),
        (
            "links = [RevoluteDH(a=1), RevoluteDH(a=2)]\nlinks.extend(puma.links)\nr = DHRobot(links)",
            "2:14 error: `puma.links`",
        ),
        (
            "p = dict(a=1)\nr = DHRobot([RevoluteDH(**p), RevoluteDH(a=2)])",
            "2:25 error: `**p` is not followed",
        ),
        ("r = DHRobot([RevoluteDH(a=1), RevoluteDH(a=f(1))])", "1:44 error: `f(1)` is not followed"),
        ("r = DHRobot([RevoluteDH(a=1), RevoluteDH(a=x[1])])", "1:44 error: `x[1]` is not followed"),
        ("r = DHRobot([RevoluteDH(a=1)]*n)", "1:13 error: "),
        ("r = DHRobot([RevoluteDH(a=1), RevoluteDH(a=2)])\nr.links = []", "2:1 error: `r.links`"),
        // What is not followed behind a robot, and what follows it.
        (
            "l = RevoluteDH(a=1)\nr = DHRobot([l, RevoluteDH(a=2)])\nif x[:\n    y = 1\nelse:\n    l.a = 3",
            "3:1 error: `if x[:…`",
        ),
        (
            "class P: pass\np = P()\np.a = 1\nq = p\nq.a = 2\nr = DHRobot([RevoluteDH(a=p.a), RevoluteDH(a=1)])",
            "4:5 error: `p` gets",
        ),
        (
            "h = 0\ndef f():\n    global h\n    h = 2\nf()\nr = DHRobot([RevoluteDH(a=h), RevoluteDH(a=1)])",
            "3:5 error: `global h`",
        ),
        (
            "import numpy as np\na = np.array([1, 2])\nb = a[0:1]\nb[0] = 7\nr = DHRobot([RevoluteDH(a=a[0]), RevoluteDH(a=1)])",
            "4:1 error: `b[0]`",
        ),
        ("r = DHRobot([RevoluteDH(a=2^3), RevoluteDH(a=1)])", "1:27 error: `2^3`"),
        (
            "class A(DHRobot):\n    def __init__(self):\n        super().__init__([RevoluteDH(a=1), RevoluteDH(a=2)])\n    def grow(self):\n        self.links[0].a = 9\nr = A()\nr.grow()",
            "7:1 error: `r.grow()`",
        ),
    ] {
        assert!(
            said(text, Language::Python).starts_with(expected),
            "{text}: {}",
            said(text, Language::Python)
        );
    }
    // Programs without end and values that grow: an answer soon.
    for text in [
        "a = [1];\nfor i = 1:10000\n a = [a a];\nend\nr = SerialLink(a);".to_string(),
        "for i = 1:10000\nfor j = 1:10000\nfor k = 1:10000\n L(k) = Link([0 0 1 0]);\nend\nend\nend\nr = SerialLink(L);".into(),
        "function r = f(x)\n r = f(x + 1) + f(x - 1);\nend\nr = SerialLink([Link([0 0 f(1) 0])]);".into(),
        "a = 2;\nfor i = 1:1000\n a = a*a;\nend\nr = SerialLink([Link([0 0 a 0])]);".into(),
        "if x\n".repeat(5_000) + "L = Link([0 0 1 0]);",
        "x = -".to_string() + &"-".repeat(50_000) + "1;",
        "x = 1".to_string() + &"+1".repeat(50_000) + ";",
        "x = ".to_string() + &"a(".repeat(50_000),
        "%{\n".repeat(20_000),
    ] {
        assert!(read_program(&text, Language::Matlab, None).is_err());
    }
    for text in [
        "x = [1]\nfor i in range(10000):\n    x += x\nr = DHRobot(x)".to_string(),
        "def f(x):\n    return f(f(x))\nr = DHRobot([RevoluteDH(a=f(1))])".into(),
        "x = []\nx.append(x)\nr = DHRobot(x)".into(),
        "x = []\nx.append(x)\ny = np.deg2rad(x)\nr = DHRobot([RevoluteDH(a=-x)])".into(),
        (0..3_000).map(|k| format!("{}if x:\n", " ".repeat(k))).collect(),
    ] {
        assert!(read_program(&text, Language::Python, None).is_err());
    }
}

/// Blocks in blocks that do not end as they begin are read again and again: that has a bound, beyond which nothing is taken for read.
#[test]
fn blocks_that_do_not_end_are_bounded() {
    let robot = "L(1) = Link([0 0 1 0]);\nr = SerialLink(L);";
    let matlab = format!("{}x = 1;\n{}{robot}", "if a\n".repeat(40), "elseif )\nend\n".repeat(40));
    let indent = |n: usize| " ".repeat(n);
    let heads: String = (0..40).map(|k| format!("{}if a:\n", indent(k))).collect();
    let ends: String = (0..40).rev().map(|k| format!("{0}elif ):\n{0} y = 1\n", indent(k))).collect();
    let python = format!(
        "from roboticstoolbox import *\n{heads}{}x = 1\n{ends}r = DHRobot([RevoluteDH(a=1)])\n",
        indent(40)
    );
    for (text, language) in [(matlab, Language::Matlab), (python, Language::Python)] {
        assert!(read_program(&text, language, None).is_err(), "{text}");
    }
}
