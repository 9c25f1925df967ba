//! Programs in further languages, arms told by motions, angles in degrees by constants of a program's own, tables with remarks, and
//! points that words tell: what is right is proved, and a slip in it is found.

use denavit_check::{CheckOptions, Checked, Standing, check};
use denavit_reading::code::Dialect;
use denavit_reading::document::Format;

fn read(text: &str, format: Format, language: Option<Dialect>) -> Checked {
    let options = CheckOptions { language, ..CheckOptions::default() };
    check(text, format, None, &options).unwrap_or_else(|e| panic!("{e:?}\n{text}"))
}

fn all(checked: &Checked, name: &str) -> Vec<Standing> {
    checked.claims.iter().filter(|c| c.name == name).map(|c| c.standing()).collect()
}

/// What is said of a name, right and after a change of the text.
fn both(text: &str, language: Option<Dialect>, name: &str, [was, now]: [&str; 2]) -> [Vec<Standing>; 2] {
    assert!(text.contains(was), "{was}");
    [text.to_string(), text.replace(was, now)].map(|t| all(&read(&t, Format::Markdown, language), name))
}

const EQUAL: [Standing; 1] = [Standing::Equal];
const WRONG: [Standing; 1] = [Standing::Wrong];

#[test]
fn scripts_of_javascript() {
    let text = "// const DH = [   // standard DH\n//   { a: L1, alpha: 0, d: 0, theta: q1 },\n//   { a: L2, alpha: 0, d: 0, theta: q2 },\n// ];\n\
                const { sin, cos } = Math;\n\nexport function forward(q1, q2, { L1, L2 }) {\n  const a = q1, b = q1 + q2;\n  return {\n    \
                x: L1 * cos(a) + L2 * cos(b),\n    y: L1 * sin(a) + L2 * sin(b),\n  };\n}\n\n\
                export const detJ = (q2, { L1, L2 }) => L1 * L2 * sin(q2);\n";
    let c = Some(Dialect::C);
    assert_eq!(both(text, c, "x", ["L2 * cos(b)", "L2 * cos(a)"]), [EQUAL, WRONG]);
    assert_eq!(both(text, c, "y", ["L2 * sin(b),", "L2 * cos(b),"]), [EQUAL, WRONG]);
    let [right, wrong] = both(text, c, "detJ(…)", ["L2 * sin(q2);", "L2 * cos(q2);"]);
    assert_eq!(right, EQUAL);
    // It does not take all joints, and is not called wrong.
    assert_ne!(wrong, EQUAL);
}

#[test]
fn programs_of_julia() {
    let text = "# DH (standard):\n# joint │ θ  │ d  │ a  │ α\n#   1   │ θ1 │ d1 │ 0  │ π/2\n#   2   │ θ2 │ 0  │ a2 │ 0\n\n\
                function hand(θ1, θ2)\n    s1, c1 = sincos(θ1); s2, c2 = sincos(θ2)\n    T02 = [c1*c2  -c1*s2   s1  a2*c1*c2;\n           \
                s1*c2  -s1*s2  -c1  a2*s1*c2;\n           s2      c2      0   d1 + a2*s2;\n           0       0       0   1]\n    \
                return T02\nend\n";
    let [right, wrong] = both(text, Some(Dialect::Matlab), "T02", ["-s1*s2  -c1 ", "-s1*s2   c1 "]);
    assert_eq!([right, wrong], [EQUAL, WRONG]);
}

#[test]
fn matrices_with_commas_of_eigen() {
    let text = "// Denavit-Hartenberg (standard):\n//  i | theta | d  | a  | alpha\n//  1 | q1    | L1 | 0  | +90 deg\n//  2 | q2    | 0  | L2 | 0\n\
                Matrix3d orientation(double q1, double q2)\n{\n    const double c1 = std::cos(q1), s1 = std::sin(q1);\n    Matrix3d R;\n    \
                R << c1 * std::cos(q2), -c1 * std::sin(q2), s1,\n         s1 * std::cos(q2), -s1 * std::sin(q2), -c1,\n         \
                std::sin(q2), std::cos(q2), 0;\n    return R;\n}\n";
    assert_eq!(both(text, Some(Dialect::C), "R", ["-s1 * std", "s1 * std"]), [EQUAL, WRONG]);
}

#[test]
fn degrees_by_constants_of_a_program() {
    let text = "// DH (standard), mm and degrees\n//   joint  theta  d   a   alpha\n//     1    j1     0   L1  0\n//     2    j2     0   L2  0\n\
                const float L1 = 160.0, L2 = 140.0;\nconst float RAD = PI / 180.0;\nconst float DEG = 180.0 / PI;\nfloat j1, j2;\nfloat x, y;\n\
                void forward() {\n  x = L1 * cosf(j1 * RAD) + L2 * cosf((j1 + j2) * RAD);\n  \
                y = L1 * sinf(j1 * RAD) + L2 * sinf((j1 + j2) * RAD);\n}\n// e = +1 elbow left, e = -1 elbow right\nvoid inverse(float x, float y, int e) {\n  \
                float c2 = (x * x + y * y - L1 * L1 - L2 * L2) / (2 * L1 * L2);\n  float s2 = e * sqrtf(1 - c2 * c2);\n  \
                j2 = atan2f(s2, c2) * DEG;\n  j1 = (atan2f(y, x) - atan2f(L2 * s2, L1 + L2 * c2)) * DEG;\n}\n";
    let c = Some(Dialect::C);
    assert_eq!(both(text, c, "x", ["cosf((j1 + j2) * RAD)", "cosf(j1 + j2)"]), [EQUAL, WRONG]);
    for joint in ["j1", "j2"] {
        let [right, mixed] = both(text, c, joint, ["atan2f(s2, c2) * DEG", "atan2f(s2, c2)"]);
        assert_eq!(right, EQUAL, "{joint}");
        // Where some are in degrees and others are not, nothing is said.
        assert!(!mixed.contains(&Standing::Equal), "{joint}");
    }
}

#[test]
fn an_arm_as_products_of_motions() {
    let text = "```\nA1 = Rz(q1) Tz(d1) Rx(-90°)      base\nA2 = Rz(q2) Tx(a2)               arm\n```\n\nThe tip:\n\n```\n\
                x = a2*cos(q1)*cos(q2)\ny = a2*sin(q1)*cos(q2)\nz = d1 - a2*sin(q2)\n```\n";
    assert_eq!(both(text, None, "z", ["d1 - a2", "d1 + a2"]), [EQUAL, WRONG]);
}

#[test]
fn rows_with_remarks_that_joints_before_them_move() {
    let text = "DH parameters, standard:\n\n      theta    d    a    alpha\n  1   q1       d1   0    -pi/2\n  2   q2       0    a2   0\n  \
                3   -q2      0    a3   -pi/2     <- passive\n  4   q3       d4   0    0         (motor)\n\n\
                $x = \\cos(q_1)(a_2\\cos(q_2) + a_3)$\n\n$z = d_1 - a_2\\sin(q_2) - d_4$\n";
    assert_eq!(both(text, None, "z", ["- d_4", "+ d_4"]), [EQUAL, WRONG]);
    assert_eq!(both(text, None, "x", ["+ a_3", "- a_3"]), [EQUAL, WRONG]);
}

#[test]
fn tables_with_a_bar_behind_the_numbers() {
    let text = "DH parameters (distal convention)\n\n   i │  aᵢ   αᵢ   dᵢ   θᵢ\n  ───┼─────────────────────\n   1 │  l₁   0    0    q₁\n   \
                2 │  l₂   0    0    q₂\n\nx = l₁ cos(q₁) + l₂ cos(q₁+q₂)\n";
    assert_eq!(both(text, None, "x", ["+ l₂", "- l₂"]), [EQUAL, WRONG]);
}

#[test]
fn a_point_that_words_call_an_origin() {
    let text = "Craig's parameters:\n\n| i | α_{i-1} | a_{i-1} | d_i | θ_i |\n|---|---|---|---|---|\n| 1 | 0 | 0 | 0 | θ1 |\n| 2 | -90° | L1 | d2 | 0 |\n\
                | 3 | 90° | 0 | 0 | θ3 |\n\nFor given $w=(w_x,w_y)$, the origin of frame 3, and $d_2>0$:\n\n$$d_2=\\sqrt{w_x^2+w_y^2-L_1^2}$$\n";
    let [right, wrong] = both(text, None, "d_2", ["-L_1^2", "+L_1^2"]);
    assert!(matches!(right[..], [Standing::Equal | Standing::Conditional]), "{right:?}");
    assert_eq!(wrong, WRONG);
    // In other words, and in other frames.
    let told = "For given $w=(w_x,w_y)$, the origin of frame 3, and";
    for (words, is_told) in [
        ("Let $w=(w_x,w_y)$ be the origin of frame $\\{3\\}$, and", true),
        ("The origin of frame $\\{3\\}$ is $w=(w_x,w_y)$, and", true),
        ("For given $w=(w_x,w_y)$ (the origin of frame 3) and", true),
        ("For given $w=(w_x,w_y)$, the origin of frame 3 seen from the base, and", true),
        ("For given $w=(w_x,w_y)$, the origin of frame 3 seen from frame 1, and", false),
        ("In frame 1 let $w=(w_x,w_y)$ be the origin of frame 3, and", false),
        ("For given ${}^1w=(w_x,w_y)$, the origin of frame 3, and", false),
    ] {
        let text = text.replace(told, words);
        let found = all(&read(&text, Format::Markdown, None), "d_2");
        let is_judged = found.iter().any(|s| matches!(s, Standing::Equal | Standing::Conditional));
        assert_eq!(is_judged, is_told, "{words}: {found:?}");
        assert!(!found.contains(&Standing::Wrong), "{words}");
    }
    // A point of which nothing is told is none of the arm's.
    let text = text.replace(", the origin of frame 3,", "");
    let found = all(&read(&text, Format::Markdown, None), "d_2");
    assert!(!found.contains(&Standing::Wrong) && !found.contains(&Standing::Equal), "{found:?}");
}

#[test]
fn spanish_sines_and_curly_thetas() {
    let text = "DH standard:\n\n| i | $\\vartheta$ | $d$ | $a$ | $\\alpha$ |\n|---|---|---|---|---|\n| 1 | $\\vartheta_1$ | 0 | $l_1$ | 0 |\n\
                | 2 | $\\vartheta_2$ | 0 | $l_2$ | 0 |\n\n$$y=l_1\\sen\\vartheta_1+l_2\\sen(\\vartheta_1+\\vartheta_2)$$\n\n\
                With $l_1=0.5$ m, $l_2=0.4$ m, $\\vartheta_1=30^\\circ$, $\\vartheta_2=60^\\circ$: $p_y=0.650$ m.\n";
    assert_eq!(both(text, None, "y", ["+l_2", "-l_2"]), [EQUAL, WRONG]);
    assert_eq!(both(text, None, "p_y", ["0.650", "0.550"]), [EQUAL, WRONG]);
}

/// Brackets in brackets are matched once, not once for each.
#[test]
fn deep_brackets_take_no_time() {
    let before = std::time::Instant::now();
    for (word, name, language) in [("// Math.\n", "f(", Dialect::C), ("using X\n", "a[", Dialect::Matlab)] {
        let options = CheckOptions { language: Some(language), ..CheckOptions::default() };
        let text = format!("{word}{}", name.repeat(80_000));
        assert!(check(&text, Format::Plain, None, &options).is_err());
    }
    assert!(before.elapsed().as_secs() < 30, "{:?}", before.elapsed());
}
