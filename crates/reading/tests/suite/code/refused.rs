//! What is refused, and what is read beside it.

use super::{close, joint, matlab, meaning, named, numbers, place, python, q, run};
use denavit_reading::code::{Code, Dialect, Value, read};

fn refused(code: &Code) -> Vec<String> {
    code.refusals.iter().map(ToString::to_string).collect()
}

#[test]
fn what_is_not_straight_is_refused_with_a_place() {
    let check = |text: &str, language: Dialect, at: &str, message: &str| {
        let code = run(text, language, 2);
        let e = code.refusals.first().unwrap_or_else(|| panic!("{text} is read: {code:?}"));
        assert_eq!(&text[e.span.clone()], at, "{e}");
        assert_eq!(e.to_string(), message);
    };
    let unread = "; only arithmetic, matrices, sines and roots are";
    for (text, at, message) in [
        (
            "import scipy.optimize\nx = scipy.optimize.fsolve(f0, q1)\n",
            "f0",
            "unknown `f0`; give it a value further up, or name it as the robot does".to_string(),
        ),
        (
            "import scipy.optimize\nx = scipy.optimize.fsolve(q1)\n",
            "scipy.optimize.fsolve(q1)",
            format!("`scipy.optimize.fsolve` is not read{unread}"),
        ),
        (
            "def f(q):\n    while q[0] > 1:\n        q = q\n    return q\n",
            "while",
            "a `while` loop is not read; only loops over known numbers are: `for i in range(6)`".to_string(),
        ),
        (
            "def f(q):\n    if q[0] > 1:\n        return 1\n    return q\n",
            "q[0] > 1",
            "a condition on values is not read; write each branch as a function of its own".to_string(),
        ),
        ("def f(q):\n    return f(q)\n", "f(q)", "`f` calls itself; recursion is not read".to_string()),
        ("T = open('a.txt')\n", "open", "unknown `open`; give it a value further up, or name it as the robot does".to_string()),
        ("x = q1 ^ 2\n", "^", "`^` works on bits in Python; a power is `**`".to_string()),
        ("x = np.eye(4)\ny = x[4, 0]\n", "4", "index 4 is out of range: there are 4; the first index is 0".to_string()),
        ("x = np.eye(4) @ np.eye(3)\n", "np.eye(4) @ np.eye(3)", "the sizes 4×4 and 3×3 do not fit in a product".to_string()),
        (
            "T = np.array([[1, 0], [0, 1]])\nT[0, 0] = np.cos(q1)\n",
            "T[0, 0] = np.cos(q1)",
            "the array is of whole numbers: NumPy cuts off what is assigned to it; write `1.0` for one of its numbers, or `dtype=float`".to_string(),
        ),
        (
            "T = np.eye(4)\nR = T[:3, :3]\nR[0, 0] = 5\n",
            "R[0, 0] = 5",
            "other names may stand for the same array, and change with it; make a copy first: `T = T.copy()`".to_string(),
        ),
        ("x = 1/(2 - 2)\n", "1/(2 - 2)", "division by zero".to_string()),
        ("def f(a, b, c):\n    return a\n", "a", "what `a` of `f` stands for is not known; a function of the joints is `def fk(q):`".to_string()),
        ("x = (1 +\n", "(", "expected a value, the line ends".to_string()),
    ] {
        let at = if text == "x = (1 +\n" { "" } else { at };
        check(text, Dialect::Python, at, &message);
    }
    for (text, at, message) in [
        (
            "while 1, x = 1; end",
            "while",
            "`while` is not read; only loops over known numbers are: `for i = 1:6`".to_string(),
        ),
        (
            "x = fsolve(1);",
            "fsolve",
            "unknown `fsolve`; give it a value further up, or name it as the robot does".to_string(),
        ),
        ("x = [1 2; 3];", "[1 2; 3]", "1×1 below 1×2: the columns do not fit".to_string()),
        (
            "x = eye(4); y = x(5,1);",
            "5",
            "index 5 is out of range: there are 4; the first index is 1".to_string(),
        ),
        ("x = 'abc", "'abc", "the text is not closed".to_string()),
    ] {
        check(text, Dialect::Matlab, at, &message);
    }
}

#[test]
fn what_needs_nothing_refused_is_still_read() {
    let text = "def fk(q):\n    c1 = np.cos(q[0])\n    k = load()\n    m = k*c1\n    s1 = np.sin(q[0])\n    return s1, m\n";
    let code = python(text, 2);
    assert_eq!(refused(&code), ["unknown `load`; give it a value further up, or name it as the robot does"]);
    let names: Vec<_> = code.functions[0].assigned.iter().map(|a| a.name.as_str()).collect();
    assert_eq!(names, ["c1", "s1"]);
}

#[test]
fn places_count_in_the_whole_text() {
    let text = "prose ```x = q1*2\n``` more";
    let span = 9..18;
    let code = read(text, span, Dialect::Python, &meaning, &[joint(1)]);
    assert_eq!(&text[code.functions[0].assigned[0].span.clone()], "q1*2");
}

#[test]
fn a_function_of_the_same_joints_is_read_beside_the_one_that_calls_it() {
    let text = "def fk(u, v):\n    return cos(u + v)\ndef jac(u, v):\n    return fk(u, v)\n";
    let code = python(text, 2);
    assert_eq!(code.functions.iter().map(|f| f.name.as_str()).collect::<Vec<_>>(), ["fk", "jac"]);
}

#[test]
fn classes_and_attempts_leave_the_rest() {
    let text = "class Arm:\n    def __init__(self):\n        self.l = 1\n\ntry:\n    import x\nexcept ImportError:\n    pass\n\n@njit(cache=True)\ndef fk(q):\n    return np.cos(q[0])\n";
    let code = python(text, 1);
    assert_eq!(refused(&code), ["`try` is not read"]);
    assert_eq!(code.functions.iter().map(|f| f.name.as_str()).collect::<Vec<_>>(), ["", "fk"]);
    assert_eq!(code.functions[0].assigned[0].name, "l");
    assert_eq!(code.functions[1].returned.len(), 1);
}

#[test]
fn pages_and_cells_of_matlab() {
    let text = "T = zeros(2,2,2);\nfor i = 1:2\n T(:,:,i) = [cos(q(i)) -sin(q(i)); sin(q(i)) cos(q(i))];\nend\nX = T(:,:,1)*T(:,:,2)';\nC = {X, 2}; Y = C{1}/C{2};\n";
    let code = matlab(text, 2);
    assert_eq!(code.refusals, []);
    let (s, c) = (q(1) - q(2)).sin_cos();
    close(&numbers(&named(&code.functions[0], "X").value), &[[c, -s], [s, c]]);
    close(&numbers(&named(&code.functions[0], "Y").value), &[[c / 2., -s / 2.], [s / 2., c / 2.]]);
}

#[test]
fn arguments_by_name_by_default_and_as_all_joints() {
    let value = |text: &str| {
        let code = python(text, 2);
        assert_eq!(code.refusals, [], "{text}");
        numbers(&code.functions[0].returned[0].value)
    };
    close(&value("def f(theta2, l1): return l1*cos(theta2)"), &[[place("l1") * q(2).cos()]]);
    close(&value("def f(conf, k=2): return k*conf[1]"), &[[2. * q(2)]]);
    close(&value("def f(alpha, beta): return alpha - beta"), &[[q(1) - q(2)]]);
    close(
        &value(
            "def f(theta: list[float], /, *, deg=False):\n    if deg:\n        theta = np.deg2rad(theta)\n    return np.cumsum(theta)[-1]",
        ),
        &[[q(1) + q(2)]],
    );
}

#[test]
fn each_of_a_tuple_has_its_own_place() {
    let text = "c1, s1 = cos(q1), sin(q1)\n";
    let code = python(text, 1);
    let [c1, s1] = &code.functions[0].assigned[..] else { panic!("{code:?}") };
    assert_eq!((&text[c1.span.clone()], &text[s1.span.clone()]), ("cos(q1)", "sin(q1)"));
    let Value::Scalar(cell) = &s1.value else { panic!() };
    assert_eq!(cell.value, joint(1).sin());
}

#[test]
fn only_rigid_matrices_are_inverted() {
    let code = python("x = np.linalg.inv(np.array([[1.0, 2], [3, 4]]))\n", 1);
    assert_eq!(
        refused(&code),
        ["this inverse is not read; only rotations and homogeneous matrices are inverted"]
    );
    let code = matlab("syms t\nx = inv([cos(t) -sin(t) 2; sin(t) cos(t) 1; 0 0 1]);", 1);
    let (s, c) = place("t").sin_cos();
    close(
        &numbers(&named(&code.functions[0], "x").value),
        &[[c, s, -2. * c - s], [-s, c, 2. * s - c], [0., 0., 1.]],
    );
}

#[test]
fn the_last_definition_of_a_name_is_the_one_that_is_called() {
    let code = python("k = 1\ndef f(q):\n    g = lambda x: k*x\n    k = 3\n    return g(q[0])\n", 1);
    assert_eq!(code.refusals, []);
    assert_eq!(numbers(&code.functions[1].returned[0].value), [[3. * q(1)]]);
    let code = matlab("k = 1; g = @(x) k*x; k = 3; y = g(2);", 1);
    assert_eq!(numbers(&named(&code.functions[0], "y").value), [[2.]]);
}
