//! Small libraries with every operation, for the tests of emitted code, and a place to run it.

use denavit_emit::{File, Language, Library, Parameter, Precision, Routine, Vector, emit};
use denavit_program::{Graph, Program};
use denavit_symbolic::{Expr, Symbol};
use std::f64::consts::PI;
use std::path::PathBuf;
use std::process::Command;

/// What the names and texts of a library look like.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Words {
    Plain,
    /// Quotes, ends of comments, line breaks, keywords, other scripts.
    Hostile,
}

/// What is known about the parameters.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Given {
    /// There are none.
    Nothing,
    /// Each has a default.
    Defaults,
    /// One has none.
    Required,
}

const HOSTILE: [&str; 8] = [
    "q\"\"\"; import os; os.exit(1) #",
    "lambda",
    "*/ process.exit(1); /*",
    "x'); exit(1); % ${process.exit(1)} `\\",
    "θ\u{202e}\n@ts-nocheck",
    "class\r\nraise SystemExit(1)",
    "# -*- coding: utf-7 -*-",
    "'''\u{2028}%{",
];

/// Variables and parameters of a library.
fn inputs(words: Words, given: Given) -> (Vec<Symbol>, Vec<Symbol>) {
    let (variables, parameters) = match words {
        Words::Plain => (["q1", "q2"], ["a", "b", "c"]),
        Words::Hostile => ([HOSTILE[0], HOSTILE[1]], [HOSTILE[2], HOSTILE[3], HOSTILE[4]]),
    };
    let parameters = if given == Given::Nothing { vec![] } else { parameters.map(Symbol::new).to_vec() };
    (variables.map(Symbol::new).to_vec(), parameters)
}

/// Sixteen results of every kind; without parameters, their values are numbers.
fn formulas(variables: &[Symbol], parameters: &[Symbol]) -> Vec<Expr> {
    let [x, y] = [0, 1].map(|k| Expr::from(variables[k]));
    let fixed = [Expr::int(1) / Expr::int(2), Expr::int(-3) / Expr::int(4), Expr::int(3)];
    let [a, b, c] = [0, 1, 2].map(|k| parameters.get(k).map_or(fixed[k], |&s| s.into()));
    let first = x.sin() * y.cos() + a;
    let long = (0..9).map(|k| (x * Expr::int(k) + y).sin() * (y * Expr::int(k) + x).cos() * (a + b * x));
    vec![
        first,
        (Expr::int(1) + x * x).sqrt(),
        x.sin().atan2(y.cos() + c),
        x / (c + y.cos()),
        Expr::int(1) / Expr::int(10),
        Expr::int(0),
        Expr::pi(),
        x,
        -x,
        first,
        -first,
        (a * b).sin() * y + (a * b).cos(),
        (x * y).sin() + (x * y).cos(),
        x.sin().sin(),
        b * c,
        long.reduce(|u, v| u + v).expect("nine terms"),
    ]
}

/// The same in numbers, by hand.
fn values([x, y]: [f64; 2], [a, b, c]: [f64; 3]) -> Vec<f64> {
    let first = x.sin() * y.cos() + a;
    let long = (0..9).map(f64::from).map(|k| (k * x + y).sin() * (k * y + x).cos() * (a + b * x));
    vec![
        first,
        (1.0 + x * x).sqrt(),
        x.sin().atan2(y.cos() + c),
        x / (c + y.cos()),
        0.1,
        0.0,
        PI,
        x,
        -x,
        first,
        -first,
        (a * b).sin() * y + (a * b).cos(),
        (x * y).sin() + (x * y).cos(),
        x.sin().sin(),
        b * c,
        long.sum(),
    ]
}

/// The folder of a library with results as a list, a matrix, pages and a single number.
pub fn folder(language: Language, words: Words, given: Given) -> Vec<File> {
    let (variables, parameters) = inputs(words, given);
    let formulas = formulas(&variables, &parameters);
    let program = |formulas: &[Expr]| {
        let mut graph = Graph::new(&variables, &parameters);
        let named =
            formulas.iter().enumerate().map(|(k, &e)| (format!("r{k}"), graph.trace(e))).collect::<Vec<_>>();
        let taken = variables.iter().chain(&parameters).map(|s| s.name().to_string()).collect();
        Program::new(&graph, &named, |_| None, &taken)
    };
    let (all, one) = (program(&formulas), program(&formulas[..1]));
    let points = [[0.0, 0.0], [0.5, -1.25], [-2.0, 3.0], [1e-3, 0.75]];
    let sets = [[0.5, -0.75, 3.0], [0.25, 1.5, 2.0]];
    let vectors = |count: usize| -> Vec<Vector> {
        let vector = |(k, point): (usize, &[f64; 2])| {
            let set = if parameters.is_empty() { sets[0] } else { sets[k % 2] };
            let results = values(*point, set)[..count].to_vec();
            let parameters = if parameters.is_empty() { vec![] } else { set.to_vec() };
            Vector { variables: point.to_vec(), parameters, results }
        };
        points.iter().enumerate().map(vector).collect()
    };
    let hostile = words == Words::Hostile;
    let say = |k: usize, plain: &str| if hostile { HOSTILE[k].to_string() } else { plain.to_string() };
    let routine = |(name, program, shape): (String, _, &[usize])| {
        let count = shape.iter().product();
        Routine {
            name,
            about: vec![say(3, "Results of every kind."), say(7, "A second line.")],
            program,
            result: say(5, "results"),
            shape: shape.to_vec(),
            vectors: vectors(count),
            scales: vec![8.0; count],
        }
    };
    let routines = [
        (say(2, "list"), &all, &[16][..]),
        (say(5, "matrix"), &all, &[4, 4]),
        (say(0, "pages"), &all, &[2, 2, 4]),
        (say(1, "number"), &one, &[]),
    ];
    let default = |k: usize| if given == Given::Required && k == 2 { None } else { Some(sets[0][k]) };
    let library = Library {
        title: say(0, "A small library"),
        name: say(5, "small"),
        header: if hostile {
            HOSTILE.iter().rev().map(|s| s.to_string()).collect()
        } else {
            vec!["Header 1".into()]
        },
        variables: variables.iter().map(|s| (*s, say(2, "a number"))).collect(),
        parameters: (0..)
            .zip(&parameters)
            .map(|(k, s)| Parameter { symbol: *s, about: say(4, "another number"), default: default(k) })
            .collect(),
        routines: routines.into_iter().map(routine).collect(),
        solvers: vec![],
        attachments: vec![],
        precision: Precision::Double,
    };
    emit(&library, language)
}

/// Emits each kind of library, checks what holds of all of them, and runs `test` in each folder.
pub fn run_all(language: Language, width: usize, test: impl Fn(&[File]) -> Vec<String>) {
    for words in [Words::Plain, Words::Hostile] {
        for (k, given) in [Given::Nothing, Given::Defaults, Given::Required].into_iter().enumerate() {
            let files = folder(language, words, given);
            assert_eq!(files, folder(language, words, given), "emitted twice");
            let label = format!("{}-{k}-{}", language.name(), words == Words::Hostile);
            for file in &files {
                if words == Words::Plain {
                    assert!(file.text.contains("Header 1"), "{label}: {}", file.path);
                }
                for line in file.text.lines() {
                    assert!(line.chars().count() <= width, "{label}: {}: {line}", file.path);
                    assert_eq!(line.trim_end(), line, "{label}: {}", file.path);
                }
            }
            let folder = written(&label, &files);
            let command = test(&files);
            let output = Command::new(&command[0]).args(&command[1..]).current_dir(&folder).output();
            let output = output.unwrap_or_else(|e| panic!("{}: {e}", command[0]));
            let text = [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
            assert!(output.status.success(), "{label} in {}:\n{}{}", folder.display(), text[0], text[1]);
            std::fs::remove_dir_all(&folder).expect("a folder of our own");
        }
    }
}

/// A folder of its own for some files.
fn written(label: &str, files: &[File]) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("denavit-emit-{}-{label}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder for temporary files");
    for file in files {
        std::fs::write(folder.join(&file.path), &file.text).expect("a temporary file");
    }
    folder
}

/// True if the command runs; otherwise says that the test is left out.
pub fn has(command: &[&str]) -> bool {
    let output = Command::new(command[0]).args(&command[1..]).output();
    let runs = output.is_ok_and(|o| o.status.success());
    if !runs {
        eprintln!("left out: `{}` does not run", command.join(" "));
    }
    runs
}

/// The name of the file that begins and ends so.
pub fn file_name(files: &[File], start: &str, end: &str) -> String {
    let mut names = files.iter().map(|f| f.path.clone());
    names.find(|name| name.starts_with(start) && name.ends_with(end)).expect("a file of that name")
}
