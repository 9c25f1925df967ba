//! What is found in pieces of documents, most of them from the five course sheets and reports that the checks began with.

use denavit_reading::document::{Fence, Format, Part, Place, Relation, formula, read, sides};
use std::ops::Range;

/// The statements, one a line: sides between `=`, cells between `|`, rows between `/`.
fn shown(text: &str, format: Format) -> String {
    let document = read(text, format);
    let mut out = String::new();
    for s in &document.statements {
        assert_eq!(s.relations.len() + 1, s.sides.len());
        s.directives.iter().for_each(|d| out += &format!("[{}] ", d.words));
        if let Some(label) = &s.label {
            out += &format!("{}: ", &text[label.clone()]);
        }
        for (i, side) in s.sides.iter().enumerate() {
            if i > 0 {
                out += match s.relations[i - 1] {
                    Relation::Equal => " = ",
                    Relation::Define => " := ",
                    Relation::Identical => " ≡ ",
                    Relation::Approximate => " ≈ ",
                };
            }
            let parts: Vec<String> = side.parts.iter().map(|p| part(text, p)).collect();
            out += &parts.join(" ");
        }
        if let Some(aside) = &s.aside {
            out += &format!("   ({})", &text[aside.clone()]);
        }
        out += "\n";
    }
    out
}

fn part(text: &str, part: &Part) -> String {
    match part {
        Part::Text(span) => formula(text, span).split_whitespace().collect::<Vec<_>>().join(" "),
        Part::Matrix(grid) => {
            let (open, close) = match grid.fence {
                Fence::Square => ("[", "]"),
                Fence::Round => ("(", ")"),
                Fence::Bars => ("|", "|"),
                Fence::Braces => ("{", "}"),
                Fence::None => ("<", ">"),
            };
            let cell = |c: &Range<usize>| formula(text, c).into_owned();
            let rows: Vec<String> =
                grid.rows.iter().map(|r| r.iter().map(cell).collect::<Vec<_>>().join("|")).collect();
            let under = grid.under.as_ref().map_or(String::new(), |u| format!("_{}", &text[u.clone()]));
            format!("{open}{}{close}{under}", rows.join(" / "))
        }
    }
}

/// Each piece of Markdown with what is found in it.
fn check(rows: &[(&str, &str)]) {
    check_as(Format::Markdown, rows);
}

fn check_as(format: Format, rows: &[(&str, &str)]) {
    for (text, expect) in rows {
        let expect: String = expect.lines().map(|l| format!("{}\n", l.trim())).collect();
        assert_eq!(shown(text, format), expect, "in {text:?}");
        // Other ends of lines change nothing but the bytes.
        let returns = text.replace('\n', "\r\n");
        assert_eq!(shown(&returns, format), expect, "with carriage returns, in {text:?}");
    }
}

#[test]
fn formulas_in_prose() {
    check(&[
        (
            "We have $n_x = c_1 s_2$ and $t_{34}=d_1$, but $x$ and $a \\leq b$ state nothing.\n",
            "n_x = c_1 s_2\nt_{34} = d_1",
        ),
        (
            "On pose : $T_1 = \\theta_1, T_2 = \\theta_2, T_3 = \\theta_3$\n",
            "T_1 = \\theta_1\nT_2 = \\theta_2\nT_3 = \\theta_3",
        ),
        (" $q_i = \\pi$ si  $\\sigma_i = 1$   \n", "q_i = \\pi\n\\sigma_i = 1"),
        ("then \\(a = b\\) and `y = s2.(D7 + s34.r7)` hold", "a = b\ny = s2.(D7 + s34.r7)"),
        (
            "$a = b; c = d$ $e=f,\\quad g=h$ $i = j \\text{ and } k = l$",
            "a = b\nc = d\ne = f\ng = h\ni = j\nk = l",
        ),
        ("$\\underline{X}_p^t = (x, y, z)$", "\\underline{X}_p^t = (x / y / z)"),
        ("`--depth=3` and `f(x=3)` and `a.b(\"x = 2\")`", ""),
        ("it costs $5 and then x = 3 of $ more", "x = 3"),
        ("$x := 3$, $y \\equiv 4$, $z \\approx 5$, $w ≈ 6$", "x := 3\ny ≡ 4\nz ≈ 5\nw ≈ 6"),
        ("$x \\to 0$, $a \\in A$, $a \\neq b$, $x < 3$, $-\\pi < q = 3$", ""),
        ("$x = \\sum_{i=1}^n a_i$", "x = \\sum_{i=1}^n a_i"),
    ]);
}

#[test]
fn displays() {
    check(&[
        ("$$D_1 = c4.c5;$$\n\n$$D_2 = s4.c5;$$", "D_1 = c4.c5\nD_2 = s4.c5"),
        ("$$z = D_8 + q_1 - c_{34}.r_7$$", "z = D_8 + q_1 - c_{34}.r_7"),
        ("\\[\n  a = b\n\\]\n", "a = b"),
        ("$$ A = B \\tag{3} $$ $$ = C \\label{x} $$", "A = B = C"),
        ("$$A = B$$\n\n$$= C$$\n\nor\n\n$$= D$$", "A = B = C"),
        ("$$\\underline{X}_p : a = b$$", "\\underline{X}_p: a = b"),
        ("$${}^0T_3 = {}^0T_1 {}^1T_2 \\quad (0.5pt)$$", "{}^0T_3 = {}^0T_1 {}^1T_2   ((0.5pt))"),
        ("$$\\longrightarrow T = A$$", "T = A"),
        ("$$x = a \\text{ if } s_5 > 0$$", "x = a   (\\text{ if } s_5 > 0)"),
        ("$$\nx = a\ny = b\n$$", "x = a\ny = b"),
        ("$$x = a +\n b$$", "x = a + b"),
        ("$$R_{3}^{0}, R_{6}^{3} \\text{ can all be extracted}$$", ""),
    ]);
}

#[test]
fn rows_of_latex() {
    check(&[
        (
            "```\n\\begin{split} t_{11} &= C_1 C_{234} C_5 - S_1 \\\\ t_{12} &= -C_1 C_{234} \\\\ &\\quad + S_1 S_5 S_6 \\\\[4pt] t_{13} &= S_1 C_5 \\nonumber \\end{split}\n```",
            "t_{11} = C_1 C_{234} C_5 - S_1\nt_{12} = -C_1 C_{234} + S_1 S_5 S_6\nt_{13} = S_1 C_5",
        ),
        (
            "$$\\begin{split} \\theta_1 &= a + b \\\\ &= a - b + \\pi \\\\ \\theta_2 &= c \\end{split}$$",
            "\\theta_1 = a + b = a - b + \\pi\n\\theta_2 = c",
        ),
        (
            "$$\\mathbf{U}_0 \\left\\{ \\begin{array}{l} s_x = C1(C23) - S1 \\\\ s_y = S1 \\end{array} \\right.$$",
            "s_x = C1(C23) - S1\ns_y = S1",
        ),
        (
            "$$\\left\\{\\begin{array}{ll} k_{33} = & -C_5 & = C_1 a_y - S_1 a_x \\\\ k_{34} = & d_2 & = C_1 \\end{array}\\right.$$",
            "k_{33} = -C_5 = C_1 a_y - S_1 a_x\nk_{34} = d_2 = C_1",
        ),
        (
            "$$\\begin{cases} {}^is_j = [1 & 0 & 0 & 0]^T \\\\ {}^in_j = [0 & C\\theta & S\\theta & 0]^T \\end{cases}$$",
            "{}^is_j = [1|0|0|0] ^T\n{}^in_j = [0|C\\theta|S\\theta|0] ^T",
        ),
        (
            "```\n\\begin{array}{lll} & \\text{phi} = \\operatorname{atan2}(a,b); \\\\ & \\text{and for 'RPY' we need :} \\\\ & \\text{psi} = c; \\end{array}\n```",
            "\\text{phi} = \\operatorname{atan2}(a,b)\n\\text{psi} = c",
        ),
        ("\\begin{align*}\na &= b \\\\\n% a comment = x\nc &= d\n\\end{align*}", "a = b\nc = d"),
        ("$$\\begin{gather} a = b \\\\ c = d \\end{gather}$$", "a = b\nc = d"),
        (
            "$$x = \\begin{cases} a & q > 0 \\\\ b & \\text{otherwise} \\end{cases}$$",
            "x = {a|q > 0 / b|\\text{otherwise}}",
        ),
        (
            "$$C(\\theta_n + 90) = -S\\theta_n \\\\ S(\\theta_n + 90) = C\\theta_n$$",
            "C(\\theta_n + 90) = -S\\theta_n\nS(\\theta_n + 90) = C\\theta_n",
        ),
    ]);
}

#[test]
fn matrices_of_latex() {
    check(&[
        (
            "$$T_{46} = \\underbrace{\\begin{pmatrix} c5 & -s5 \\\\ 0 & 0 \\end{pmatrix}}_{T_{45}} \\cdot T_{56} = \\begin{pmatrix} c4.c5 = D_1 & . \\\\ x & -q_6 \\end{pmatrix}$$",
            "T_{46} = (c5|-s5 / 0|0)_T_{45} \\cdot T_{56} = (c4.c5 = D_1|. / x|-q_6)",
        ),
        (
            "$$T_{01} = \\begin{pmatrix} & & \\\\ & & \\\\ 0 & 0 & 1 \\end{pmatrix}$$",
            "T_{01} = (|| / || / 0|0|1)",
        ),
        (
            "$$A = \\left[ \\begin{array}{cc} a & b \\cr \\hline c & d \\end{array} \\right]^{-1}$$",
            "A = [a|b / c|d] ^{-1}",
        ),
        (
            "$$\\begin{vmatrix} i & j \\\\ 0 & 1 \\end{vmatrix} = \\begin{Bmatrix} x \\\\ y \\end{Bmatrix}$$",
            "|i|j / 0|1| = {x / y}",
        ),
        (
            "$$M = \\left(\\begin{smallmatrix} a & b \\\\ c & d \\end{smallmatrix}\\right)$$",
            "M = (a|b / c|d)",
        ),
        (
            "$$M = \\begin{bmatrix} \\begin{bmatrix} a \\\\ b \\end{bmatrix} & c \\end{bmatrix}$$",
            "M = [\\begin{bmatrix} a    b \\end{bmatrix}|c]",
        ),
        (
            "$$M = A \\left( \\begin{bmatrix} a \\\\ b \\end{bmatrix} + B \\right)^T$$",
            "M = A \\left( [a / b] + B \\right)^T",
        ),
        ("$$q = [q_1 \\quad q_2 \\cdots q_n]$$", "q = [q_1|q_2|\\cdots|q_n]"),
        ("$$q = [q_1 \\ q_2 \\ \\dots \\ q_n]^T$$", "q = [q_1|q_2|\\dots|q_n] ^T"),
        ("$$A_1 = \\begin{bmatrix} C_1 & 0 \\ S_1 & 0 \\end{bmatrix}$$", "A_1 = [C_1|0 / S_1|0]"),
        (
            "$$A_1 = [..] $$ $$ C_3 = C_3 \\left[ C_4 S_5 + S_4 C_5 \\right] C_6 $$",
            "A_1 = [..]\nC_3 = C_3 \\left[ C_4 S_5 + S_4 C_5 \\right] C_6",
        ),
        ("$$p = T([1 \\ 2 \\ 3], \\ 4);$$", "p = T([1 2 3], 4)"),
        ("$$\\underset{T_{01}}{\\begin{pmatrix} a \\end{pmatrix}} = B$$", "(a)_T_{01} = B"),
        ("$$\\begin{bmatrix} a & b \\\\ c & d \\end{bmatrix}$$", "[a|b / c|d]"),
        ("$$\\begin{array}{c|c} \\textbf{Prismatic} & \\textbf{Revolute} \\\\ a & b \\end{array}$$", ""),
    ]);
}

#[test]
fn several_matrices_on_a_line() {
    let m = |a: &str| format!("\\begin{{bmatrix}} {a} \\end{{bmatrix}}");
    let row = |text: String, expect: &str| check(&[(&text, expect)]);
    row(format!("$$A = {} \\quad B = {}$$", m("1"), m("2")), "A = [1]\nB = [2]");
    row(
        format!("$$R_1^0 = {} R_2^0 = {} R_3^0 = {}$$", m("1"), m("2"), m("3")),
        "R_1^0 = [1]\nR_2^0 = [2]\nR_3^0 = [3]",
    );
    // A name that was stated to be something else is a factor.
    row(format!("$$B = {}$$ $$A = {} B = {}$$", m("2"), m("1"), m("3")), "B = [2]\nA = [1] B = [3]");
    row(format!("$$B = {}$$ $$A = {} B = {}$$", m("2"), m("1"), m("2")), "B = [2]\nA = [1]\nB = [2]");
    let text = format!("$$A = {} B = {}$$", m("1"), m("2"));
    assert!(read(&text, Format::Markdown).statements.iter().all(|s| s.juxtaposed));
}

#[test]
fn lines_on_their_own() {
    check(&[
        ("psi = atan2(R(3,2), -R(3,3));\n", "psi = atan2(R(3,2), -R(3,3))"),
        ("- t11: a_3 = c4.c5\n- t12: b = 4\n", "t11: a_3 = c4.c5\nt12: b = 4"),
        ("(3) C3 = 0\n\n4. T_2 = q2\n", "3: C3 = 0\n4: T_2 = q2"),
        ("Scaling factor = 1 in robotics\n", ""),
        ("x = 3 is the length\n\nHere y = 4\n\nso that a = b.\n", "x = 3\ny = 4\na = b"),
        ("n_x = c1*c2 - s1*s2,\n", "n_x = c1*c2 - s1*s2"),
        ("A1 A2 A3 = T03\n", "A1 A2 A3 = T03"),
        ("q1 = atan2(py, px), q2 = 0 and q3 = 1\n", "q1 = atan2(py, px)\nq2 = 0\nq3 = 1"),
        ("R(1:3,1:3) = R06\n", "R(1:3,1:3) = R06"),
        ("x = a +\n    b\n  - c\n  = d\n", "x = a + b - c = d"),
        ("T22:\n ( C4*S5 + S4 )*C6\n = S45 + C6\n = B\n", "T22: ( C4*S5 + S4 )*C6 = S45 + C6 = B"),
        ("t22:\n = C1 S5\n", "t22: t22 = C1 S5"),
        ("<img src=\"x\" width = 3>\nCours : <http://a.dz/view.php?id=25>\n[a]: http://b.c/?d=e\n", ""),
        ("Title\n=====\n\nx = 1\n---\n", "x = 1"),
        ("---\ntitle = 3\n---\n\nx = 1", "x = 1"),
        ("A = B\n\n然后 x = 3\n\nx = 3 à 5\n", "A = B\nx = 3\nx = 3"),
    ]);
    check_as(
        Format::Plain,
        &[
            ("C1*nx + S1*ny = C5*C6\n", "C1*nx + S1*ny = C5*C6"),
            ("x = 3 # three\ny = 4 // four\n", "x = 3\ny = 4"),
        ],
    );
}

#[test]
fn plain_matrices() {
    let grids = [
        ("T = [C1 -S1 0; S1 C1 0; 0 0 1]", "T = [C1|-S1|0 / S1|C1|0 / 0|0|1]"),
        ("T = [a + b, c - d; -e, f]", "T = [a + b|c - d / -e|f]"),
        ("T = [a + b c -d; 1 2 3]", "T = [a + b|c|-d / 1|2|3]"),
        ("T = [C1 -S1 0\n     S1 C1 0\n     0 0 1]", "T = [C1|-S1|0 / S1|C1|0 / 0|0|1]"),
        ("T = [[a, b], [c, d]]", "T = [a|b / c|d]"),
        ("T = [[a, b],\n     [c, d]]\n", "T = [a|b / c|d]"),
        ("T =\n[[a, b],\n [c, d]]\n", "T = [a|b / c|d]"),
        ("T = Matrix([[a, b], [c, d]])", "T = [a|b / c|d]"),
        ("T = np.array([[a, b], [c, d]])", "T = [a|b / c|d]"),
        ("T = {{a, b}, {c, d}}", "T = {a|b / c|d}"),
        (
            "    ⎡ C4   −S4  0 ⎤\nT = ⎢ 0    a + b  RL4 ⎥\n    ⎣ 0    0    1 ⎦\n",
            "T = [C4|−S4|0 / 0|a + b|RL4 / 0|0|1]",
        ),
        (
            "    ⎡1 2⎤   ⎡x⎤\nT = ⎢3 4⎥ · ⎢y⎥ = B\n    ⎣5 6⎦   ⎣z⎦\n",
            "T = [1|2 / 3|4 / 5|6] · [x / y / z] = B",
        ),
        ("T = | c1 -s1 |\n    | s1  c1 |\n", "T = [c1|-s1 / s1|c1]"),
        ("det T = | c1 -s1 |\n        | s1  c1 |\n", "det T = |c1|-s1 / s1|c1|"),
        ("T =\n| c1 -s1 |\n| s1  c1 |\n", "T = [c1|-s1 / s1|c1]"),
        ("T = [ c1 -s1 ]\n    [ s1  c1 ]\n", "T = [c1|-s1 / s1|c1]"),
        ("v = [1, 2, 3]^T", "v = [1|2|3] ^T"),
        ("T[1,4] = d1*c2", "T[1,4] = d1*c2"),
        ("T = [c5 . 0; s5 * 0; 0 - 1; 1 2 3]", "T = [c5|.|0 / s5|*|0 / 0|-|1 / 1|2|3]"),
        ("T = [cos t1 -sin t1; sin(t1) cos(t1)]", "T = [cos t1|-sin t1 / sin(t1)|cos(t1)]"),
    ];
    check(&grids);
    check_as(Format::Plain, &grids);
    for (text, expect) in grids {
        check(&[(&format!("```text\n{text}\n```\n"), expect)]);
    }
}

#[test]
fn tables() {
    let table = "| c1 | -s1 |\n|----|-----|\n| s1 | c1  |\n";
    check(&[
        (&format!("T06 =\n\n{table}"), "T06 = [c1|-s1 / s1|c1]"),
        (&format!("$$T_{{06}} =$$\n{table}"), "T_{06} = [c1|-s1 / s1|c1]"),
        (table, ""),
        ("|   | θ | d |\n|---|---|---|\n| 1 | $a = 3$ | x = 4 |\n\nx = 1\n", "x = 1"),
        ("j | θ\n--|--\n1 | a = 2\n", ""),
    ]);
    check_as(Format::Latex, &[("\\begin{tabular}{cc}\n$a = b$ & c \\\\\n\\end{tabular}\n$x = 1$", "x = 1")]);
}

#[test]
fn whole_latex_files() {
    let text = "\\documentclass{article}\n\\newcommand{\\x}{$a = b$}\n\\begin{document}\n\\section{Inverse model}\nWe use ZYZ % $c = d$\nangles: $e = f$.\n\\begin{equation}\\label{q}\ng = h.\n\\end{equation}\n\\begin{lstlisting}[language=Python]\nx = 3\n\\end{lstlisting}\ny = 4\n\\end{document}\n$z = 5$";
    check_as(Format::Latex, &[(text, "e = f\ng = h")]);
    let document = read(text, Format::Latex);
    let first = &document.statements[0];
    assert_eq!(first.heading.clone().map(|h| &text[h]), Some("Inverse model"));
    assert_eq!(first.prose.clone().map(|h| &text[h]), Some("angles:"));
    assert_eq!(document.code[0].language, "python");
    check_as(
        Format::Latex,
        &[("T_{06} = \\begin{bmatrix} a & b \\\\\n c & d \\end{bmatrix}\n", "T_{06} = [a|b / c|d]")],
    );
}

#[test]
fn headings_code_and_places() {
    let text = "# Direct model\n\nThe matrices\nin ZYZ are:\n\n$$a = b$$\n\n```python\nx = 3\n```\n\n`c = d`\n\ne = f\n";
    let document = read(text, Format::Markdown);
    let places: Vec<Place> = document.statements.iter().map(|s| s.place).collect();
    assert_eq!(places, [Place::Display, Place::Code, Place::Line]);
    assert_eq!(document.statements[0].heading.clone().map(|h| &text[h]), Some("Direct model"));
    assert_eq!(document.statements[0].prose.clone().map(|h| &text[h]), Some("in ZYZ are:"));
    assert_eq!(document.code.len(), 1);
    assert_eq!(
        (&text[document.code[0].span.clone()], document.code[0].language.as_str()),
        ("x = 3\n", "python")
    );
}

#[test]
fn directives() {
    check(&[
        (
            "<!-- check: robot  ur3 -->\n<!-- check: claim T06 -->\n<!-- another a = b -->\n$$a = b$$ <!-- check: skip -->\n\n$c = d$",
            "[robot ur3] [claim T06] [skip] a = b\nc = d",
        ),
        ("$$\n% check: claim t11\na = b\n$$\n", "[claim t11] a = b"),
        ("```text\n# check: off\na = b  // check: on\nc = d\n```\n", "[off] [on] a = b\nc = d"),
        ("# check: no\n\n`<!-- check: no -->`\n\na = b\n", "a = b"),
    ]);
    check_as(
        Format::Plain,
        &[("# check: claim x\nx = 3\n% check: skip\ny = 4\n", "[claim x] x = 3\n[skip] y = 4")],
    );
    check_as(Format::Latex, &[("% check: claim x\n$x = 3$\n", "[claim x] x = 3")]);
    let document =
        read("a = b\n\n<!-- check: end -->\n```python\nx\n```\n<!-- check: last -->", Format::Markdown);
    assert_eq!(document.code[0].directives[0].words, "end");
    assert_eq!(document.directives[0].words, "last");
}

#[test]
fn toml_files() {
    let text = r#"# check: robot rx90
title = "x"
n_x = 'c1 \frac{a}{b}'
"t34" = "a = b"
a2 = 0.43
T01 = [["c1", "-s1"], [0, 1]]
p = ["x", "y"]
M = """
[c1 -s1
 s1 c1]"""

[model]
z = "[a b; c d]"

[[claims]]
claim = "T06"
matrix = [["a"]]
robot = "ur3"

[[claims]]
claim = "T05"
at = [1, 2]
formula = "c1"
"#;
    check_as(
        Format::Toml,
        &[(
            text,
            r"[robot rx90] title = x
            n_x = c1 \frac{a}{b}
            t34 = a = b
            a2 = 0.43
            T01 = [c1|-s1 / 0|1]
            p = [x / y]
            M = [c1|-s1 / s1|c1]
            z = [a|b / c|d]
            [claim T06] [robot ur3] T06 = [a]
            [claim T05] [at 1 2] T05 = c1",
        )],
    );
    let escaped = read("x = \"\\\\frac{a}{b}\"\n", Format::Toml);
    assert!(escaped.statements.is_empty() && escaped.notes[0].hint.contains("single quotes"));
    assert!(!read("x = = 3", Format::Toml).notes.is_empty());
}

#[test]
fn what_cannot_be_read_is_noted() {
    for (text, message) in [
        ("$$a = \\begin{bmatrix} 1 & 2 $$", "`\\begin{bmatrix}` is not closed"),
        ("$$a = (b$$", "`(` is not closed"),
        ("$$a = b)$$", "`)` closes nothing"),
        ("$$a = b", "`$$` is not closed"),
        ("\\begin{align} a = b", "`\\begin{align}` has no end"),
        ("see $a = b and more\n\nx = 1", "`$` is not closed in its paragraph"),
        ("$$= b$$", "the `=` follows no other side"),
        ("$$a =$$", "nothing stands behind the `=`"),
    ] {
        let notes = read(text, Format::Markdown).notes;
        assert!(notes.iter().any(|n| n.message == message), "{text}: {notes:?}");
    }
    let deep = format!("$$a = {}b{}$$", "(".repeat(200), ")".repeat(200));
    assert!(read(&deep, Format::Markdown).notes.iter().any(|n| n.message.contains("too deeply")));
}

#[test]
fn sides_and_formulas_keep_their_places() {
    let text = "c4.c5 = D_1 = f(a=b)";
    let cut: Vec<&str> = sides(text, &(0..text.len())).into_iter().map(|s| &text[s]).collect();
    assert_eq!(cut, ["c4.c5", "D_1", "f(a=b)"]);
    let text = "a & \\quad b \\\\[4pt] \u{200b}c \\label{x}";
    let blanked = formula(text, &(0..text.len()));
    assert_eq!(blanked.len(), text.len());
    assert_eq!(blanked.find('c'), text.find('c'));
    assert_eq!(blanked.split_whitespace().collect::<String>(), "abc");
}

#[test]
fn formats() {
    for (name, text, format) in [
        ("a.md", "", Format::Markdown),
        ("a.TEX", "", Format::Latex),
        ("a.toml", "", Format::Toml),
        ("a.txt", "a = b", Format::Plain),
        ("a.txt", "$$a = b$$", Format::Markdown),
        ("-", "\\documentclass{x}", Format::Latex),
        ("-", "\\begin{align}", Format::Latex),
    ] {
        assert_eq!(Format::of(name, text), format, "{name} {text}");
    }
}
