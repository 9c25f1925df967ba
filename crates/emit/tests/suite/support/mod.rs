//! Libraries to emit, folders to emit them into, and compilers to run there.

use denavit_emit::{File, Language, Library, Parameter, Precision, Routine, Vector, emit};
use denavit_program::{Graph, Program};
use denavit_symbolic::{Expr, Symbol};
use rustc_hash::FxHashSet;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A program of formulas in variables and parameters.
pub fn program(variables: &[&str], parameters: &[&str], outputs: &[(&str, Expr)]) -> Program {
    let [v, p] = [variables, parameters].map(|list| list.iter().map(|s| Symbol::new(s)).collect::<Vec<_>>());
    let mut graph = Graph::new(&v, &p);
    let outputs: Vec<_> = outputs.iter().map(|(name, e)| (name.to_string(), graph.trace(*e))).collect();
    let taken: FxHashSet<String> = variables.iter().chain(parameters).map(|s| s.to_string()).collect();
    Program::new(&graph, &outputs, |_| None, &taken)
}

/// What a library is made of, so that the programs outlive it.
pub struct Sample {
    pub name: &'static str,
    pub variables: Vec<&'static str>,
    pub parameters: Vec<(&'static str, Option<f64>)>,
    pub programs: Vec<(&'static str, &'static str, Vec<usize>, Program)>,
    pub configurations: Vec<Vec<f64>>,
}

impl Sample {
    /// A library whose vectors are the formulas' own values, run with the C library.
    pub fn library(&self, precision: Precision) -> Library<'_> {
        let hostile = "*/ int main() { \" \\ ??/\n#error \u{202e} ``` [x]";
        let parameters: Vec<f64> = self.parameters.iter().map(|p| p.1.unwrap_or(0.375)).collect();
        let value = |x: &[f64], s: Symbol| {
            let place = self.variables.iter().position(|v| *v == &*s.name());
            let other = self.parameters.iter().position(|p| p.0 == &*s.name());
            place.map(|k| x[k]).or(other.map(|k| parameters[k]))
        };
        let vectors = |program: &Program| {
            let of = |x: &Vec<f64>| Vector {
                variables: x.clone(),
                parameters: parameters.clone(),
                results: program.eval(|s| value(x, s)).expect("all inputs have values"),
            };
            self.configurations.iter().map(of).collect()
        };
        let routines = self.programs.iter().map(|(name, result, shape, program)| Routine {
            name: (*name).into(),
            about: vec!["What comes out, in m.".into(), hostile.into()],
            program,
            result: (*result).into(),
            shape: shape.clone(),
            vectors: vectors(program),
            scales: vec![4.0; program.outputs().len()],
        });
        Library {
            title: format!("Sample \"{hostile}"),
            name: self.name.into(),
            header: vec!["A table:".into(), hostile.into(), "  1  2".into()],
            variables: self.variables.iter().map(|v| (Symbol::new(v), hostile.into())).collect(),
            parameters: self
                .parameters
                .iter()
                .map(|p| Parameter { symbol: Symbol::new(p.0), about: hostile.into(), default: p.1 })
                .collect(),
            routines: routines.collect(),
            solvers: vec![],
            attachments: vec![],
            precision,
        }
    }
}

/// Two angles and a slide, with parameters; sines, roots and arctangents, some of parameters alone.
pub fn arm() -> Sample {
    let [q1, q2, d3, a, b] = ["q1", "q2", "d3", "a1", "b1"].map(Expr::symbol);
    let x = a * q1.cos() + b.sin() * (q1 + q2).cos() - Expr::pi() / Expr::int(7) * q2.cos();
    let y = a * q1.sin() + b.sin() * (q1 + q2).sin() + (a * a + b * b).sqrt() * d3;
    let z = (x * x + y * y + Expr::int(1)).sqrt();
    let angle = y.atan2(x) + a.atan2(b);
    let variables = vec!["q1", "q2", "d3"];
    let point = program(
        &variables,
        &["a1", "b1"],
        &[
            ("x", x),
            ("y", y),
            ("z", z),
            ("phi", angle),
            ("s", (angle / Expr::int(2)).sin()),
            ("one", Expr::int(1)),
            ("way", a * (q2 - q1).sign() + d3.sign()),
        ],
    );
    let many: Vec<Expr> = (1..=9).map(|k| (q1 * Expr::int(k)).sin() * (q2 * Expr::int(k)).cos()).collect();
    let names = ["m11", "m12", "m13", "m21", "m22", "m23", "m31", "m32", "m33"];
    let outputs: Vec<(&str, Expr)> = names.into_iter().zip(many).collect();
    let others = ["t11", "t12", "t13", "t21", "t22", "t23", "t31", "t32", "t33"];
    let scaled: Vec<(&str, Expr)> = others.into_iter().zip(&outputs).map(|(t, m)| (t, m.1 * d3)).collect();
    let matrices = program(&variables, &["a1", "b1"], &[outputs, scaled].concat());
    let configurations =
        vec![vec![0.5, -0.25, 0.125], vec![-2.5, 3.0, 0.0], vec![0.0, 0.0, 0.5], vec![1.5625, 3.1, 0.25]];
    Sample {
        name: "arm",
        variables,
        parameters: vec![("a1", Some(0.75)), ("b1", Some(-0.1))],
        programs: vec![("point", "point", vec![7], point), ("matrices", "matrices", vec![2, 3, 3], matrices)],
        configurations,
    }
}

/// Names that are words of the languages or end strings and comments, and functions named like everything else.
pub fn hostile() -> Sample {
    let variables = vec!["double", "q", "a\"b\\", "*/ x; /*", "θ₁\n#error", "sin_cos", "None", "M_PI"];
    let parameters =
        vec![("const", Some(1.0)), ("parameters", None), ("in_range", Some(-0.0)), ("\u{202e}", Some(1e30))];
    let e = |name: &str| Expr::symbol(name);
    let angles: Vec<Expr> = variables.iter().map(|v| e(v).sin() * e("const") + e(v).cos()).collect();
    let sum = angles.into_iter().reduce(|a, b| a + b * e("in_range") + e("parameters")).expect("some");
    let names: Vec<&str> = parameters.iter().map(|p| p.0).collect();
    let first =
        program(&variables, &names, &[("return", sum), ("self; }", sum * e("q")), ("*/", e("q").sin())]);
    let second = program(&variables, &names, &[("i", Expr::int(2))]);
    let configurations = vec![(0..8).map(|k| 0.25 * f64::from(k)).collect(), vec![-0.5; 8]];
    Sample {
        name: "int\"; */",
        variables,
        parameters,
        programs: vec![
            ("main", "fn", vec![3], first.clone()),
            ("sin_cos\n", "q", vec![3], first),
            ("test", "block", vec![], second),
        ],
        configurations,
    }
}

/// No variable, or one; constant results; a function that reads no variable and one that reads no parameter; a name
/// like those of tests.
pub fn small(variables: usize) -> Sample {
    let variables = vec!["q1"; variables];
    let angle = variables.first().map_or(Expr::int(2), |q| Expr::symbol(q));
    let length = Expr::symbol("L");
    let parameters = ["L", "al6"];
    let twist = Expr::symbol("al6");
    let constant = [("one", Expr::int(1)), ("two", length), ("three", twist.sin() + twist.cos())];
    let moving = [("x", angle.cos()), ("y", angle.sin() * Expr::int(3))];
    let first = program(&variables, &parameters, &constant);
    let second = program(&variables, &parameters, &moving);
    let configurations = match variables.len() {
        0 => vec![vec![], vec![]],
        _ => vec![vec![0.5], vec![-2.0], vec![3.0]],
    };
    Sample {
        name: "test",
        variables,
        parameters: vec![("L", Some(0.5)), ("al6", Some(0.25))],
        programs: vec![("fixed", "values", vec![3], first), ("moving", "values", vec![2, 1], second)],
        configurations,
    }
}

/// The file whose name begins and ends so, of which there is one.
pub fn only(files: &[File], start: &str, end: &str) -> String {
    let names: Vec<&String> =
        files.iter().map(|f| &f.path).filter(|p| p.starts_with(start) && p.ends_with(end)).collect();
    assert_eq!(names.len(), 1, "{names:?}");
    names[0].clone()
}

/// The text of a file.
pub fn text<'a>(files: &'a [File], path: &str) -> &'a str {
    &files.iter().find(|f| f.path == path).unwrap_or_else(|| panic!("no {path}")).text
}

/// The lines behind `Example` in a comment, without its signs.
pub fn example(text: &str, sign: &str) -> String {
    let lines = text.lines().map(|line| line.strip_prefix(sign).unwrap_or(line));
    let lines = lines.skip_while(|line| !line.trim_start().starts_with("Example")).skip(1);
    lines.take_while(|line| line.starts_with("    ")).map(|line| format!("{line}\n")).collect()
}

/// An empty folder for a test.
pub fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).expect("a folder");
    path
}

/// Writes the files of a library and checks what holds for all: the same twice, and no long line.
pub fn write(library: &Library, language: Language, folder: &Path) -> Vec<File> {
    let files = emit(library, language);
    assert_eq!(files, emit(library, language), "the same each time");
    for file in &files {
        let path = folder.join(&file.path);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(&path, &file.text).expect("written");
        for line in file.text.lines() {
            assert!(line.chars().count() <= 100, "{}: {line}", file.path);
            assert_eq!(line, line.trim_end(), "{}", file.path);
        }
    }
    files
}

/// Runs a program in a folder, which must succeed; what it prints.
pub fn run(folder: &Path, words: &[&str]) -> String {
    run_with(folder, words, &[])
}

/// The same with some environment variables.
pub fn run_with(folder: &Path, words: &[&str], variables: &[(&str, &str)]) -> String {
    let mut command = Command::new(words[0]);
    let output = command.args(&words[1..]).current_dir(folder).envs(variables.iter().copied()).output();
    let output = output.unwrap_or_else(|e| panic!("{words:?}: {e}"));
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let (out, err) = (text(&output.stdout), text(&output.stderr));
    assert!(output.status.success(), "{words:?} in {}: {out}\n{err}", folder.display());
    out + &err
}

/// Whether a program is there.
pub fn is_there(program: &str) -> bool {
    Command::new(program).arg("--version").output().is_ok_and(|o| o.status.success())
}

/// Whether this machine has fused multiply-add.
pub fn has_fma() -> bool {
    #[cfg(target_arch = "x86_64")]
    return std::arch::is_x86_feature_detected!("fma") && std::arch::is_x86_feature_detected!("avx2");
    #[cfg(not(target_arch = "x86_64"))]
    false
}

/// Builds and tests Rust packages in folders of `folder`, as one workspace, so that three runs of cargo serve all of them:
/// with and without fused multiplications, and without the standard library. Nothing in a package is touched.
pub fn check_rust(folder: &Path, members: &[String]) {
    let manifest = format!("[workspace]\nresolver = \"3\"\nmembers = {members:?}\n");
    std::fs::write(folder.join("Cargo.toml"), manifest).expect("written");
    run_with(folder, &[env!("CARGO"), "fmt", "--all", "--check"], &[]);
    let target = folder.join("target");
    let target = target.to_str().expect("a path");
    let test = |flags: &str, extra: &[&str]| {
        let words = [&[env!("CARGO"), "test", "-q", "--offline", "--workspace"], extra].concat();
        run_with(folder, &words, &[("RUSTFLAGS", flags), ("CARGO_TARGET_DIR", target)]);
    };
    test("-D warnings", &[]);
    if has_fma() {
        test("-D warnings -C target-feature=+avx2,+fma", &[]);
    }
    test("-D warnings", &["--no-default-features"]);
}
