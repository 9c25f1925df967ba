//! Source code of programs: a folder in one of several languages that builds and tests itself.
//!
//! [`Library`] says what to emit; every language starts from the same listing of statements and spells
//! it its own way. What comes from outside (names, descriptions) reaches the text as sanitised identifiers
//! (`names.rs`) or in comments without line breaks.

pub(crate) mod blocks;
mod c;
pub(crate) mod compiled;
mod cuda;
mod javascript;
pub(crate) mod listing;
mod matlab;
pub(crate) mod names;
mod nested;
mod order;
mod python;
mod rust;
pub(crate) mod solver;
pub(crate) mod spelling;
pub(crate) mod wrap;

use denavit_program::Program;
use denavit_program::solver::Solver;
use denavit_symbolic::{Expr, Symbol};

/// A language that source can be emitted in.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Language {
    /// Rust without standard library or allocation.
    Rust,
    /// C99, header and source, which compile as C++ too.
    C,
    /// Python over NumPy arrays.
    Python,
    /// MATLAB, which Octave reads.
    Matlab,
    /// JavaScript, an ES module.
    JavaScript,
    /// CUDA C++.
    Cuda,
    /// C++ in one file: the functions in a namespace of their own, behind an interface that an attachment brings.
    IkFast,
}

impl Language {
    /// All of them.
    pub const ALL: [Language; 7] = [
        Language::Rust,
        Language::C,
        Language::Python,
        Language::Matlab,
        Language::JavaScript,
        Language::Cuda,
        Language::IkFast,
    ];

    /// Its name for people.
    pub fn name(self) -> &'static str {
        match self {
            Language::Rust => "Rust",
            Language::C => "C",
            Language::Python => "Python",
            Language::Matlab => "MATLAB",
            Language::JavaScript => "JavaScript",
            Language::Cuda => "CUDA",
            Language::IkFast => "IKFast",
        }
    }
}

/// Floating-point numbers of the emitted code.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Precision {
    /// 64 bits.
    #[default]
    Double,
    /// 32 bits, where the language has a choice (C, CUDA).
    Single,
}

/// What to emit.
#[derive(Clone, Debug)]
pub struct Library<'a> {
    /// What the functions are about, for people: one line.
    pub title: String,
    /// The name to make file and function names of.
    pub name: String,
    /// The lines that every file opens with, without comment signs: the table, the version of the generator, the
    /// conventions.
    pub header: Vec<String>,
    /// The variables of all routines, in order, each with what it is and its unit.
    pub variables: Vec<(Symbol, String)>,
    /// The parameters of all routines, in order.
    pub parameters: Vec<Parameter>,
    /// The functions.
    pub routines: Vec<Routine<'a>>,
    /// The functions that find all solutions.
    pub solvers: Vec<SolverRoutine<'a>>,
    /// Functions that are no programs.
    pub attachments: Vec<Attachment>,
    /// Numbers of the emitted code.
    pub precision: Precision,
}

/// A function that is no program, written out in the language of the library (CUDA leaves it out).
///
/// In all its texts `@name@` stands for the name of the library, `@NAME@` for the same in capitals; in all but IkFast,
/// `@fk_parameters@` for the last argument of a call of `fk`, with a comma before it, if that reads parameters (in C, Rust and
/// JavaScript also `@solve_result@` for what a solver calls its results); in files for Rust,
/// and in Python, JavaScript and MATLAB, `@Parameters(1.5, 2.0)@` for these values of all parameters.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Attachment {
    /// Its name, such as `inverse`.
    pub name: String,
    /// What callers see: C, for the header; Rust, for the root of the package; IkFast, for the namespace, ahead of all functions.
    /// Python: what is imported, a line each.
    pub declarations: String,
    /// C: for the source file. IkFast: for the namespace, behind the functions. Python, JavaScript: for the end of the module.
    pub definitions: String,
    /// IkFast: for the file, ahead of the namespace and behind it.
    pub around: [String; 2],
    /// C: for the test, with a function `test_…` of the attachment's name. IkFast: the test. Python: classes of tests. JavaScript,
    /// MATLAB: tests.
    pub test: String,
    /// Files of its own, besides.
    pub files: Vec<File>,
}

impl Attachment {
    /// A text with the name of the library in it.
    pub(crate) fn named(text: &str, library: &str) -> String {
        text.replace("@name@", library).replace("@NAME@", &library.to_uppercase())
    }

    /// Its files with the name of the library in them.
    pub(crate) fn named_files(&self, library: &str) -> impl Iterator<Item = File> {
        self.files
            .iter()
            .map(|f| File { path: Self::named(&f.path, library), text: Self::named(&f.text, library) })
    }

    /// A text with what `value` makes of the values in place of `@Parameters(…)@`, if that is there.
    pub(crate) fn with_values(text: String, value: impl Fn(&[&str]) -> String) -> String {
        let parts = text.split_once("@Parameters(").and_then(|(a, rest)| Some((a, rest.split_once(")@")?)));
        let made = parts.map(|(before, (values, after))| {
            let values: Vec<&str> = values.split(", ").collect();
            format!("{before}{}{after}", value(&values))
        });
        made.unwrap_or(text)
    }

    /// A text with what solvers call their results.
    pub(crate) fn with_results(text: String, plans: &[solver::Plan]) -> String {
        let marks = plans.iter().map(|p| (format!("@{}_result@", p.name), &p.result));
        marks.fold(text, |text, (mark, result)| text.replace(&mark, result))
    }

    /// A text with `, parameters` or nothing where functions are called, each by whether it reads none.
    pub(crate) fn called<'a>(text: String, functions: impl Iterator<Item = (&'a str, bool)>) -> String {
        let marked = functions.fold(text, |text, (name, reads_none)| {
            text.replace(&format!("@{name}_parameters@"), if reads_none { "" } else { ", parameters" })
        });
        // Elimination has the values of parameters in it.
        marked.replace("@solve_parameters@", "")
    }
}

/// A parameter of emitted code.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Its symbol in the programs.
    pub symbol: Symbol,
    /// What it is and its unit: one line.
    pub about: String,
    /// Its value where the caller gives none.
    pub default: Option<f64>,
}

/// A function to emit.
#[derive(Clone, Debug)]
pub struct Routine<'a> {
    /// Its name, such as `fk`.
    pub name: String,
    /// What the results are: shape, units, frames. A line each.
    pub about: Vec<String>,
    /// What it computes; its variables and parameters are those of the library.
    pub program: &'a Program,
    /// What the results are called as a whole, such as `pose`.
    pub result: String,
    /// The shape of the results, row-major; the product is their number.
    pub shape: Vec<usize>,
    /// What the stored test holds it to.
    pub vectors: Vec<Vector>,
    /// The magnitude of each result, of which the test allows some units in the last place.
    pub scales: Vec<f64>,
}

/// A configuration and the results there, from an independent source.
#[derive(Clone, PartialEq, Debug)]
pub struct Vector {
    /// One value per variable.
    pub variables: Vec<f64>,
    /// One value per parameter.
    pub parameters: Vec<f64>,
    /// The results.
    pub results: Vec<f64>,
}

/// A function that finds all solutions. It computes in double precision, whatever the precision of the library.
#[derive(Clone, Debug)]
pub struct SolverRoutine<'a> {
    /// Its name, such as `inverse`.
    pub name: String,
    /// What it solves: shapes, units, frames. A line each.
    pub about: Vec<String>,
    /// What it computes; its parameters are among those of the library, its variables are its own.
    pub solver: &'a Solver,
    /// For each node how large its guard is usually
    /// ([`SolverFunction::usual_guards`](denavit_program::solver::SolverFunction::usual_guards)).
    pub usual: Vec<f64>,
    /// What the variables are called as a whole, such as `goal`.
    pub argument: String,
    /// The shape of the variables, row-major; the product is their number.
    pub shape: Vec<usize>,
    /// What the results of a solution are called as a whole, such as `q`.
    pub result: String,
    /// What the stored test holds it to.
    pub vectors: Vec<SolverVector>,
}

/// What an emitted solver says of its answer.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Certificate {
    /// All solutions are there; without one, there is none.
    Complete,
    /// Somewhere an unknown is free, or nearly so: what is there solves the equations, and there may be more.
    Singular,
    /// The variables are no numbers, or further from what they must be than rounding brings them.
    NotAPose,
}

impl Certificate {
    /// All of them; the place is the number in languages that have no names for values.
    pub const ALL: [Certificate; 3] = [Certificate::Complete, Certificate::Singular, Certificate::NotAPose];

    /// Its name in words: `not a pose`.
    pub fn words(self) -> &'static str {
        match self {
            Certificate::Complete => "complete",
            Certificate::Singular => "singular",
            Certificate::NotAPose => "not a pose",
        }
    }

    /// Its number.
    pub fn code(self) -> usize {
        self as usize
    }
}

/// What is known, and all solutions.
#[derive(Clone, PartialEq, Debug)]
pub struct SolverVector {
    /// One value per variable of the solver.
    pub variables: Vec<f64>,
    /// One value per parameter of the library.
    pub parameters: Vec<f64>,
    /// All solutions, in any order.
    pub solutions: Vec<KnownSolution>,
    /// What the function says of them.
    pub certificate: Certificate,
    /// What a result may be off by; angles modulo 2π.
    pub tolerance: f64,
}

/// A solution from an independent source.
#[derive(Clone, PartialEq, Debug)]
pub struct KnownSolution {
    /// The results.
    pub results: Vec<f64>,
    /// How many branches come together in it.
    pub multiplicity: u32,
    /// The nodes whose unknown is free there: bit i for node i.
    pub free: u32,
}

/// A file of the emitted folder.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct File {
    /// Its path in the folder, with `/`.
    pub path: String,
    /// Its text.
    pub text: String,
}

/// A formula on its own in a language, in double precision; symbols become the nearest identifiers that the language has.
pub fn expression(e: Expr, language: Language) -> String {
    let mut names = names::Names::new(language, &[]);
    e.symbols().into_iter().for_each(|s| names.declare(s));
    spelling::Spelling { language, precision: Precision::Double, names: &names }.formula(e)
}

/// The files of a folder that builds and tests itself.
pub fn emit(library: &Library, language: Language) -> Vec<File> {
    match language {
        Language::Python => python::emit(library),
        Language::Matlab => matlab::emit(library),
        Language::JavaScript => javascript::emit(library),
        Language::C => c::emit(library),
        Language::Rust => rust::emit(library),
        Language::Cuda => cuda::emit(library),
        Language::IkFast => c::single::emit(library),
    }
}
