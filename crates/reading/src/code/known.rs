//! The names of NumPy, SymPy, `math`, Python and MATLAB that are known.

use super::Dialect;
use super::scalar::Scalar;
use super::tree::Span;
use super::value::Object;
use denavit_symbolic::Expr;
use denavit_symbolic::parse::Function;

/// Modules whose functions are read.
pub(super) const MODULES: &[&str] =
    &["numpy", "math", "sympy", "jax", "autograd", "matlab", "python", "functools", "copy"];
/// Modules that go by a short name where no import says so.
const SHORT: &[(&str, &str)] = &[
    ("np", "numpy"),
    ("numpy", "numpy"),
    ("math", "math"),
    ("sp", "sympy"),
    ("sym", "sympy"),
    ("sympy", "sympy"),
    ("jnp", "numpy"),
];
/// Python's own.
const PYTHON: &[&str] = &[
    "len",
    "range",
    "float",
    "int",
    "sum",
    "abs",
    "enumerate",
    "zip",
    "list",
    "tuple",
    "reversed",
    "pow",
    "reduce",
    "print",
    "deepcopy",
    "max",
    "min",
];
/// What may be called by its bare name behind `import *`, and in MATLAB.
const BARE: &[&str] = &[
    "cos",
    "sin",
    "tan",
    "sqrt",
    "atan2",
    "arctan2",
    "max",
    "min",
    "clip",
    "fmax",
    "fmin",
    "acos",
    "asin",
    "atan",
    "arccos",
    "arcsin",
    "arctan",
    "pi",
    "array",
    "eye",
    "identity",
    "zeros",
    "ones",
    "matrix",
    "Matrix",
    "dot",
    "matmul",
    "inv",
    "cross",
    "radians",
    "deg2rad",
    "rad2deg",
    "degrees",
    "hstack",
    "vstack",
    "concatenate",
    "block",
    "transpose",
    "symbols",
    "simplify",
    "trigsimp",
    "expand",
    "Rational",
    "diag",
    "norm",
    "power",
    "Symbol",
    "multi_dot",
    "cumsum",
    "asarray",
    "subs",
    "diff",
    "det",
    "factor",
    "collect",
    "cancel",
    "together",
    "N",
    "nsimplify",
    "lambdify",
    "expand_trig",
    "hypot",
    "round",
];
const MATLAB: &[&str] = &[
    "max",
    "min",
    "cos",
    "sin",
    "tan",
    "sqrt",
    "atan2",
    "acos",
    "asin",
    "atan",
    "cosd",
    "sind",
    "tand",
    "deg2rad",
    "pi",
    "eye",
    "zeros",
    "ones",
    "inv",
    "cross",
    "dot",
    "transpose",
    "ctranspose",
    "simplify",
    "sym",
    "deal",
    "sincos",
    "numel",
    "length",
    "size",
    "horzcat",
    "vertcat",
    "diag",
    "cell",
    "sum",
    "cumsum",
    "norm",
    "power",
    "times",
    "mtimes",
    "plus",
    "minus",
    "double",
    "expand",
    "vpa",
    "isempty",
    "reshape",
    "abs",
    "mpower",
    "rdivide",
    "uminus",
    "atan2d",
    "rad2deg",
    "combine",
    "subs",
    "diff",
    "jacobian",
    "det",
    "factor",
    "collect",
    "round",
    "hypot",
    "asind",
    "acosd",
    "atand",
    "single",
    "real",
    "eval",
    "simplifyFraction",
];

/// The path of a bare name.
pub(super) fn path_of(name: &str, language: Dialect, stars: &[&str]) -> Option<String> {
    if language == Dialect::Matlab {
        return MATLAB.contains(&name).then(|| format!("matlab.{name}"));
    }
    if PYTHON.contains(&name) && name != "reduce" {
        return Some(format!("python.{name}"));
    }
    if BARE.contains(&name) {
        let module = stars.iter().rev().find(|s| MODULES.contains(&root(s)));
        let by_default = if matches!(name, "Matrix" | "symbols" | "simplify") { "sympy" } else { "numpy" };
        return Some(format!("{}.{name}", module.copied().unwrap_or(by_default)));
    }
    let (_, module) = SHORT.iter().find(|(short, _)| *short == name)?;
    Some((*module).to_string())
}

/// The module of a path.
pub(super) fn root(path: &str) -> &str {
    path.split('.').next().unwrap_or(path)
}

/// The value of a path that is a constant.
pub(super) fn constant<'a>(path: &str, span: &Span) -> Option<Object<'a>> {
    let (module, name) = path.rsplit_once('.')?;
    if !MODULES.contains(&root(module)) {
        return None;
    }
    match name {
        "pi" => Some(Object::Scalar(Scalar::of(Expr::pi(), span).named(span))),
        "newaxis" => Some(Object::Nothing),
        _ => None,
    }
}

/// The function of a formula that a name calls, and whether its angle is in degrees.
pub(super) fn function(name: &str) -> Option<(Function, bool)> {
    Some(match name {
        "sin" => (Function::Sin, false),
        "cos" => (Function::Cos, false),
        "tan" => (Function::Tan, false),
        "sind" => (Function::Sin, true),
        "cosd" => (Function::Cos, true),
        "tand" => (Function::Tan, true),
        "sqrt" => (Function::Sqrt, false),
        "asin" | "arcsin" => (Function::Arcsin, false),
        "acos" | "arccos" => (Function::Arccos, false),
        "atan" | "arctan" => (Function::Arctan, false),
        _ => return None,
    })
}

/// A path as it is known.
pub(super) fn short(path: &str) -> &str {
    path.strip_prefix("matlab.").or_else(|| path.strip_prefix("python.")).unwrap_or(path)
}
