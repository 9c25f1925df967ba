//! Documents of Typst.

use denavit_reading::typst::markdown;

#[test]
fn words_and_formulas() {
    for (typst, read) in [
        ("= The arm\n\nAt $q_1 = 0$.", "# The arm\n\nAt $q_{1} = 0$."),
        ("#heading(level: 2)[#\"Step \";$q_1$]", "## Step $q_{1}$"),
        ("#heading(level: 1, \"The arm\")", "# The arm"),
        ("#heading[One] a\n#heading(level: 3)[Two]", "# One a\n### Two"),
        ("#set text(\n  size: 10pt,\n)\n$ x = 1 $", "\n\n\n$$ x = 1 $$"),
        ("#grid(columns: (1fr, auto), $ x = 1 $, [(2) #sym.checkmark])", " $$ x = 1 $$ (2) ✓"),
        ("a // b\nc /* d\n */ e", "a \nc \n e"),
        ("$f(x_\"4x\",$ $y) + 1$ and $a$ $\"\" = b$ $c$", "$f(x_{4x}, y) + 1$ and $a = b$ $c$"),
        ("see https://a.b and \\$5", "see https://a.b and $5"),
        ("#text(fill: rgb(\"#ff0000\"))[red]", "red"),
    ] {
        assert_eq!(markdown(typst).replace("  ", " "), read, "{typst}");
    }
}

#[test]
fn tables_keep_their_lines() {
    let text =
        "#table(columns: 3,\n  [j], [$a$], [$theta$],\n  [1], [0], $q_1$,\n  [2], \"L1\", $q_2$,\n)\nend";
    let read = markdown(text);
    assert_eq!(
        read,
        "| j | $a$ | $\\theta$ |\n|---|---|---|\n| 1 | 0 | $q_{1}$ |\n| 2 | L1 | $q_{2}$ |\n\nend"
    );
    let of = |text: &str, word: &str| text[..text.find(word).expect("it is there")].matches('\n').count();
    for word in ["L1", "end"] {
        assert_eq!(of(text, word), of(&read, word), "{word}");
    }
}

#[test]
fn nothing_is_without_an_end() {
    for text in [
        "$", "#", "#a(", "#[", "\"", "#\"", "$ (", "#table(", "]]]", "#set (", "/*", "\\", "#f({[(", "$x_(",
        "$\"a",
    ] {
        let _ = markdown(text);
    }
    let _ = markdown(&"#[".repeat(10_000));
    let _ = markdown(&format!("${}", "(".repeat(10_000)));
    for part in ["#f(", "#table(", "#heading(", "#table(columns: 2, [", "(#f[", "$a$ ", "x ", "= "] {
        let _ = markdown(&part.repeat(50_000));
    }
    for part in ["#", "(", "a_", "a/", "sqrt(", "mat(", "\"", "\\"] {
        let _ = markdown(&format!("${}", part.repeat(50_000)));
    }
}

#[test]
fn formulas_are_those_of_latex() {
    for (typst, latex) in [
        ("q_1 = op(\"atan2\")(p_y, p_x)", "q_{1} = \\operatorname{atan2}(p_{y}, p_{x})"),
        ("A_1(q_1)^(-1) U", "A_{1}(q_{1})^{-1} U"),
        ("mat(delim: \"[\", a, b; c, d)", "\\begin{bmatrix}a & b \\\\ c & d\\end{bmatrix}"),
        ("kappa_1 = plus.minus 1", "\\kappa_{1} = \\pm  1"),
        ("(a + b)/(2 a_2) x", "\\frac{a + b}{2 a_{2}} x"),
        ("1/2 m v^2", "\\frac{1}{2} m v^{2}"),
        ("C_23 italic(\"RL\")_4", "C_{23} \\mathit{RL}_{4}"),
        ("sqrt(1 - c_2^2)", "\\sqrt{1 - c_{2}^{2}}"),
        ("dot(q)_1 + dot.double(theta)", "\\dot{q}_{1} + \\ddot{\\theta}"),
        ("a &= b \\\n &= c", "\\begin{aligned}a &= b \\\\\n &= c\\end{aligned}"),
        ("sin theta_1 cos(theta_2)", "\\sin \\theta_{1} \\cos(\\theta_{2})"),
        ("90 degree", "90 ^{\\circ}"),
        ("x >= y'", "x \\geq  y'"),
        ("vec(x, y)", "\\begin{bmatrix}x \\\\ y\\end{bmatrix}"),
        ("attach(T, tl: 0, br: 2) = A_1", "{}^{0}T_{2} = A_{1}"),
        ("\"\"^0 T_6", "{}^{0} T_{6}"),
        ("L1 + a", "L_{1} + a"),
    ] {
        assert_eq!(markdown(&format!("${typst}$")), format!("${latex}$"), "{typst}");
    }
}
