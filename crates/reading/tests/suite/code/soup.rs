//! Nothing that is handed over breaks the reader, or keeps it long.

use denavit_reading::code::{Code, Dialect, MAX_BYTES, read};
use denavit_symbolic::Expr;

fn run(text: &str, language: Dialect) -> Code {
    let joints: Vec<Expr> = (1..=3).map(|i| Expr::symbol(&format!("q{i}"))).collect();
    let names = |n: &str| n.strip_prefix('q')?.parse::<u8>().ok().map(|_| Expr::symbol(n));
    let code = read(text, 0..text.len(), language, &names, &joints);
    for e in &code.refusals {
        assert!(text.get(e.span.clone()).is_some(), "{e}");
    }
    code
}

const WORDS: &[&str] = &[
    "def f(q):\n",
    "function T = f(q)\n",
    "end\n",
    "    ",
    "return ",
    "T",
    " = ",
    "q",
    "[0]",
    "(1)",
    "[",
    "]",
    "(",
    ")",
    "{",
    "}",
    ",",
    ";",
    ":",
    "\n",
    "\n    ",
    "+",
    "-",
    "*",
    "**",
    "^",
    "@",
    ".T",
    "'",
    "\"",
    ".",
    "...",
    "np.eye(4)",
    "np.array([[1, 2], [3, q1]])",
    "cos",
    "sin(q1)",
    "for i in range(3):\n    ",
    "for i = 1:3\n",
    "if 1 < 2:\n    ",
    "if",
    "else",
    "lambda x: ",
    "@(x) ",
    "0",
    "1.5",
    "1e9",
    "%{\n",
    "%}\n",
    "# ",
    "θ",
    "\t",
    "\\\n",
    "np.linalg.inv(",
    "zeros(2)",
    "T(1,2) = ",
    "T[0,1] = ",
    "A{2} = ",
    "T.append(q)",
    "syms a b\n",
    "import numpy as np\n",
    "class A:\n",
    "try:\n",
    "while",
    " in ",
    " is ",
    "not ",
    "f(",
    "sum(",
    "zip(q, q)",
    "[i for i in q]",
    "*q",
    "=",
    "==",
    "+=",
    "@=",
    "T[1:]",
    "T(:,end)",
];

#[test]
fn soup_of_tokens() {
    let mut state = 0x2545_f491_4f6c_dd1d_u64;
    let mut next = move |n: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state % n as u64) as usize
    };
    for _ in 0..30_000 {
        let text: String = (0..next(40)).map(|_| WORDS[next(WORDS.len())]).collect();
        run(&text, Dialect::Python);
        run(&text, Dialect::Matlab);
    }
}

#[test]
fn bytes_of_a_program_left_out() {
    let text = "import numpy as np\ndef dh(t, a):\n    return np.array([[np.cos(t), -np.sin(t), a], [np.sin(t), np.cos(t), 0.0], [0, 0, 1]])\ndef fk(q):\n    T = np.eye(3)\n    for i in range(3):\n        T = T @ dh(q[i], 0.5)\n    T[0, 2] += 1\n    return T[:2, 2]\n";
    for from in 0..text.len() {
        for length in 1..4 {
            let left: String = [&text[..from], text.get(from + length..).unwrap_or_default()].concat();
            run(&left, Dialect::Python);
            run(&left, Dialect::Matlab);
        }
    }
}

#[test]
fn bounds_hold() {
    let loops = |body: &str| {
        format!(
            "x = q1\ny = 2\nz = []\nfor i in range(64):\n for j in range(64):\n  for k in range(64):\n   {body}\n"
        )
    };
    let inner = "(".repeat(99) + "q1" + &")".repeat(99);
    let chained: String =
        (1..30).map(|i| format!("def f{i}(x):\n return f{}(x) + f{}(x)\n", i - 1, i - 1)).collect();
    let python = [
        loops("x = x + x"),
        loops("x = x * x"),
        loops("x = cos(x)"),
        loops("y = y * y"),
        loops("y = y ** 3"),
        loops("y = y + 1/3"),
        loops("z = [z]"),
        loops("z = [z, z]*30"),
        loops("x = np.eye(64) @ np.eye(64)"),
        loops("x = np.eye(64).T"),
        loops("x = sqrt(x)"),
        loops("x = load()"),
        loops("f = lambda t: f(t)"),
        format!("def f0(x):\n return x\n{chained}x = f29(q1)\n"),
        format!("x = {inner}\n"),
        "(".repeat(MAX_BYTES),
        "[".repeat(MAX_BYTES),
        "-".repeat(MAX_BYTES),
        "\\".repeat(MAX_BYTES),
        "x = ".to_string() + &"q1+".repeat(MAX_BYTES / 4) + "1",
        "x = ".to_string() + &"q1+".repeat(1_900) + "1\n",
        "x = 1\n".repeat(MAX_BYTES / 6),
        "x".to_string() + &".T".repeat(MAX_BYTES / 3),
        "def f(): pass\n".repeat(MAX_BYTES / 14),
        (0..150).map(|i| " ".repeat(i) + "if 1:\n").collect(),
        "if 1: x\nelif ".repeat(MAX_BYTES / 14),
        "a = b = ".repeat(MAX_BYTES / 8),
        "lambda: ".repeat(MAX_BYTES / 8),
        "\"".repeat(MAX_BYTES),
        "é".repeat(MAX_BYTES / 2),
        " ".repeat(MAX_BYTES),
        "x = 1;".repeat(MAX_BYTES / 6),
        "1\n ".repeat(MAX_BYTES / 3),
        "while:\n".repeat(MAX_BYTES / 7),
        "@njit\n".repeat(MAX_BYTES / 6),
    ];
    let loops = |body: &str| {
        format!(
            "x = q1; f = @(t) t; c = {{}};\nfor i = 1:64\nfor j = 1:64\nfor k = 1:64\n{body};\nend, end, end\n"
        )
    };
    let matlab = [
        loops("f = @(t) f(t)"),
        loops("f = @(t) f(t) + f(t); x = f(x)"),
        loops("c = {c}"),
        loops("c{3} = c"),
        loops("x(i, j) = x(1) + x(1)"),
        loops("x = [x x]"),
        loops("x = inv(eye(64))"),
        "[".repeat(MAX_BYTES),
        "{".repeat(MAX_BYTES),
        "x' ".repeat(MAX_BYTES / 3),
        "if 1\n".repeat(MAX_BYTES / 5),
        "function f\n".repeat(MAX_BYTES / 11),
        "[a".to_string() + &"\n".repeat(MAX_BYTES - 2),
        "while 1\n".repeat(MAX_BYTES / 8),
        "@(x) ".repeat(MAX_BYTES / 5),
        "%{\n".repeat(MAX_BYTES / 3),
        "2^".repeat(MAX_BYTES / 2),
        "end ".repeat(MAX_BYTES / 4),
        "x = 'a' 'b'\n".repeat(MAX_BYTES / 12),
    ];
    let all = python.iter().map(|t| (t, Dialect::Python)).chain(matlab.iter().map(|t| (t, Dialect::Matlab)));
    for (text, language) in all {
        run(text, language);
    }
}
