//! Source code for one robot: what to emit, the words around it, and the vectors that its tests hold.

use crate::description::{Description, JointKind, Measure};
use crate::forward::{Proof, Reference, frames_program, pose_program, prove};
use crate::geometry::Transform;
use crate::robot::{MissingValue, Robot};
use denavit_program::emit::{self, File, Language, Library, Parameter, Precision, Routine, Vector};
use denavit_program::{Extended, Graph, Program};
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::{Expr, Node, Symbol};
use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt;
use std::str::FromStr;

/// A function that can be generated.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Wanted {
    /// `fk`: the tool in the base.
    Pose,
    /// `frames`: frames 0 … n in the base.
    Frames,
}

impl Wanted {
    /// All of them.
    pub const ALL: [Wanted; 2] = [Wanted::Pose, Wanted::Frames];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Wanted::Pose => "fk",
            Wanted::Frames => "frames",
        }
    }
}

impl FromStr for Wanted {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let known = Wanted::ALL.into_iter().find(|w| w.name() == text.trim());
        let names = || Wanted::ALL.map(Wanted::name).join(", ");
        known.ok_or_else(|| format!("unknown function `{text}`; known are {}", names()))
    }
}

/// How to generate.
#[derive(Clone, Debug)]
pub struct Options {
    /// The language.
    pub language: Language,
    /// The functions.
    pub functions: Vec<Wanted>,
    /// Double or single precision, where the language has a choice.
    pub precision: Precision,
    /// The name of the files and functions; by default that of the robot.
    pub name: Option<String>,
    /// Write the values of parameters into the code, instead of taking them as arguments.
    pub fixed: bool,
}

/// Generated source code.
#[derive(Clone, Debug)]
pub struct Generated {
    /// The files of a folder that builds and tests itself.
    pub files: Vec<File>,
    /// For each function its operations and whether it is proved equal to the product of the link transforms.
    pub functions: Vec<(Wanted, denavit_program::Count, Proof)>,
}

/// Seed of the configurations that the tests hold.
const SEED: u64 = 0x5EED;
/// Random configurations in the tests.
const RANDOM: usize = 12;

/// Generates source code for a robot.
///
/// # Errors
/// With `fixed`: if a parameter has no value.
pub fn generate(description: &Description, options: &Options) -> Result<Generated, MissingValue> {
    let fixed;
    let d = if options.fixed {
        fixed = with_values(description)?;
        &fixed
    } else {
        description
    };
    let variables = d.variables();
    let parameters: Vec<Parameter> = d.parameters.iter().map(|p| parameter(d, p.symbol, p.value)).collect();
    let programs: Vec<(Wanted, Program, Proof)> =
        options.functions.iter().map(|&wanted| program(d, wanted)).collect();
    let samples = samples(d);
    let routines =
        programs.iter().map(|(wanted, program, _)| routine(d, *wanted, program, &samples)).collect();
    let library = Library {
        title: d.name.clone(),
        name: options.name.clone().unwrap_or_else(|| d.name.clone()),
        header: header(description, d, &programs),
        variables: variables.iter().map(|v| (v.symbol, about_variable(d, v.symbol, v.kind))).collect(),
        parameters,
        routines,
        precision: options.precision,
    };
    let files = emit::emit(&library, options.language);
    let functions =
        programs.iter().map(|(wanted, program, proof)| (*wanted, program.count(), *proof)).collect();
    Ok(Generated { files, functions })
}

/// The program of a function, and whether it is the product of the link transforms.
fn program(d: &Description, wanted: Wanted) -> (Wanted, Program, Proof) {
    let program = match wanted {
        Wanted::Pose => pose_program(d),
        Wanted::Frames => {
            let all: Vec<Reference> = (0..=d.rows.len()).map(Reference::Frame).collect();
            frames_program(d, &all)
        }
    };
    let proof = prove(d, &program, &reference(d, wanted));
    (wanted, program, proof)
}

/// The description with values in place of its parameters.
fn with_values(d: &Description) -> Result<Description, MissingValue> {
    let missing = d.parameters.iter().filter(|p| p.value.is_none());
    let parameters: Vec<String> = missing.map(|p| p.symbol.name().to_string()).collect();
    if !parameters.is_empty() {
        return Err(MissingValue { parameters });
    }
    let value = |s: Symbol| d.parameters.iter().find(|p| p.symbol == s)?.value;
    let fixed = |e: Expr| e.substitute(value);
    let mut new = d.clone();
    for row in &mut new.rows {
        for cell in [&mut row.theta, &mut row.d, &mut row.a, &mut row.alpha, &mut row.gamma, &mut row.b] {
            *cell = fixed(*cell);
        }
    }
    (new.base, new.tool) = (d.base.map(fixed), d.tool.map(fixed));
    new.parameters.clear();
    Ok(new)
}

/// Where a parameter stands in the table, and its unit.
fn parameter(d: &Description, symbol: Symbol, value: Option<Expr>) -> Parameter {
    let letters = [d.convention.length_z(), d.convention.length_x()];
    let mut places = vec![];
    for (i, row) in d.rows.iter().enumerate() {
        let cells = [
            ("theta", row.theta),
            (letters[0], row.d),
            (letters[1], row.a),
            ("alpha", row.alpha),
            ("gamma", row.gamma),
            ("b", row.b),
        ];
        let holds = |cell: &&(&str, Expr)| cell.1.symbols().contains(&symbol);
        places.extend(cells.iter().filter(holds).map(|(letter, _)| format!("{letter} of row {}", i + 1)));
    }
    let occurs_in = |x: &Transform<Expr>| x.matrix().iter().flatten().any(|e| e.symbols().contains(&symbol));
    places.extend(occurs_in(&d.base).then(|| "the base".to_string()));
    places.extend(occurs_in(&d.tool).then(|| "the tool".to_string()));
    let unit = match d.measure(symbol) {
        Measure::Angle => "rad",
        Measure::Length => "m",
    };
    let about = match &places[..] {
        [] => format!("not used, in {unit}"),
        places => format!("in {}; {unit}", places.join(", ")),
    };
    Parameter { symbol, about, default: value.and_then(|e| e.eval(|_| None).ok()) }
}

fn about_variable(d: &Description, symbol: Symbol, kind: JointKind) -> String {
    let row = d.rows.iter().find(|r| r.variable.is_some_and(|v| v.symbol == symbol));
    let what = match kind {
        JointKind::Revolute => "angle of a revolute joint, in rad",
        JointKind::Prismatic => "displacement of a prismatic joint, in m",
    };
    match row.and_then(|r| r.name.as_ref()) {
        Some(name) => format!("{what} ({name})"),
        None => what.into(),
    }
}

/// The words of a function.
fn routine<'a>(d: &Description, wanted: Wanted, program: &'a Program, samples: &[Sample]) -> Routine<'a> {
    let rows = d.rows.len();
    let (result, shape, what) = match wanted {
        Wanted::Pose => {
            let has_base = d.base != Transform::identity();
            let from = if has_base { "the base" } else { "frame 0" };
            let to =
                if d.tool == Transform::identity() { format!("frame {rows}") } else { "the tool".into() };
            let what = format!("Forward kinematics: the homogeneous matrix of {to} in {from}.");
            ("pose", vec![4, 4], what)
        }
        Wanted::Frames => {
            let what = format!(
                "Forward kinematics of all link frames: the homogeneous matrices of frames 0 to {rows} in the base."
            );
            ("frames", vec![rows + 1, 4, 4], what)
        }
    };
    let about = vec![
        what,
        "Rotation in the first three rows and columns (no unit), position in the last column (m).".into(),
    ];
    let reference = reference_program(program, &reference(d, wanted));
    let vectors: Vec<Vector> = samples.iter().map(|s| s.vector(&reference)).collect();
    let reach = samples.iter().map(|s| s.reach).fold(f64::MIN_POSITIVE, f64::max);
    let rounding = rounding(d, program, samples);
    let is_length = |k: usize| k % 4 == 3 && k % 16 != 15;
    let scale = |k| if is_length(k) { reach * rounding } else { rounding };
    let scales = (0..program.outputs().len()).map(scale).collect();
    Routine { name: wanted.name().into(), about, program, result: result.into(), shape, vectors, scales }
}

/// What the entries of a rotation are worth where rounding is concerned: 1, more for many rows, and more where an angle
/// is a sum, which is rounded at its own size before its sine is taken.
fn rounding(d: &Description, program: &Program, samples: &[Sample]) -> f64 {
    let mut scale = (d.rows.len() as f64 / 6.0).max(1.0);
    for e in program.sines_and_cosines() {
        let (Node::Sin(angle) | Node::Cos(angle)) = e.node() else { continue };
        if angle.as_symbol().is_none() {
            let sizes = samples.iter().map(|s| angle.eval(|x| s.value(program, x)).map_or(0.0, f64::abs));
            scale = sizes.map(|size| size / 4.0).fold(scale, f64::max);
        }
    }
    scale
}

/// The plain product of the table's link transforms, to be run in extended precision.
fn reference(d: &Description, wanted: Wanted) -> Vec<Expr> {
    let robot = Robot::symbolic(d);
    let q: Vec<Expr> = d.variables().iter().map(|v| v.symbol.into()).collect();
    let poses = match wanted {
        Wanted::Pose => vec![robot.pose(&q)],
        Wanted::Frames => robot.frames(&q),
    };
    poses.into_iter().flat_map(|x| x.matrix()).flatten().collect()
}

/// Formulas as they stand, over the inputs of a program.
fn reference_program(program: &Program, formulas: &[Expr]) -> Program {
    let mut graph = Graph::new(program.variables(), program.parameters());
    let outputs: Vec<_> = formulas.iter().map(|e| (String::new(), graph.trace(*e))).collect();
    Program::new(&graph, &outputs, |_| None, &Default::default())
}

/// A configuration for a test, with values for the parameters.
struct Sample {
    variables: Vec<f64>,
    parameters: Vec<f64>,
    /// A bound on the distances between origins, m.
    reach: f64,
}

impl Sample {
    /// The value of an input of the program.
    fn value(&self, program: &Program, s: Symbol) -> Option<f64> {
        let place = |list: &[Symbol]| list.iter().position(|x| *x == s);
        let variable = place(program.variables()).map(|k| self.variables[k]);
        variable.or_else(|| place(program.parameters()).map(|k| self.parameters[k]))
    }

    /// The results of the reference here.
    fn vector(&self, reference: &Program) -> Vector {
        let exact = reference.eval(|s| self.value(reference, s).map(Extended::from));
        let exact = exact.expect("a sample has a value for every input");
        let results = exact.iter().map(Extended::to_f64).collect();
        Vector { variables: self.variables.clone(), parameters: self.parameters.clone(), results }
    }
}

/// Configurations: zero, quarter turns, and random ones inside (−π, π) and half a metre.
fn samples(d: &Description) -> Vec<Sample> {
    let variables = d.variables();
    let mut state = SEED;
    // Knuth's linear congruential generator, the upper bits.
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let parameters: Vec<f64> = d
        .parameters
        .iter()
        .enumerate()
        .map(|(k, p)| {
            let value = p.value.and_then(|e| e.eval(|_| None).ok());
            value.unwrap_or(0.25 + 0.0625 * k as f64)
        })
        .collect();
    let mut configurations = vec![vec![0.0; variables.len()]];
    let quarters = |k: usize, kind| match kind {
        JointKind::Revolute => [FRAC_PI_2, PI, -FRAC_PI_2, 0.0][k % 4],
        JointKind::Prismatic => [0.125, 0.5, 0.25, 0.0][k % 4],
    };
    for shift in 0..3 {
        configurations.push(variables.iter().enumerate().map(|(k, v)| quarters(k + shift, v.kind)).collect());
    }
    for _ in 0..RANDOM {
        let value = |kind| match kind {
            JointKind::Revolute => PI * (2.0 * random() - 1.0),
            JointKind::Prismatic => 0.5 * random(),
        };
        configurations.push(variables.iter().map(|v| v.kind).map(value).collect());
    }
    let symbolic = Robot::symbolic(d);
    let with_reach = |q: Vec<f64>| {
        let value = |s: Symbol| {
            let variable = variables.iter().position(|v| v.symbol == s).map(|k| q[k]);
            variable.or_else(|| d.parameters.iter().position(|p| p.symbol == s).map(|k| parameters[k]))
        };
        let q_symbols: Vec<Expr> = variables.iter().map(|v| v.symbol.into()).collect();
        let links = symbolic.links.iter().map(|link| link.transform(&q_symbols));
        let lengths = links.chain([symbolic.base, symbolic.tool]).map(|x| {
            let square: f64 = x.translation.0.iter().map(|e| e.eval(value).unwrap_or(0.0).powi(2)).sum();
            square.sqrt()
        });
        let reach = lengths.sum();
        Sample { variables: q, parameters: parameters.clone(), reach }
    };
    configurations.into_iter().map(with_reach).collect()
}

/// What every file opens with.
fn header(original: &Description, d: &Description, programs: &[(Wanted, Program, Proof)]) -> Vec<String> {
    let mut lines = vec![original.name.clone()];
    if let Some(source) = &original.source {
        lines.push(format!("Source of the table: {source}"));
    }
    lines.push(String::new());
    lines.push(format!(
        "Denavit-Hartenberg table, {} convention (angles in rad, lengths in m):",
        original.convention
    ));
    lines.extend(table(d));
    let fixed = |x: &Transform<Expr>, what: &str, lines: &mut Vec<String>| {
        if *x != Transform::identity() {
            lines.push(format!("{what}:"));
            let rows = x.matrix();
            lines.extend(rows[..3].iter().map(|row| format!("  [{}]", row.map(text).join(", "))));
        }
    };
    fixed(&d.base, "Frame 0 in the base", &mut lines);
    fixed(&d.tool, "The tool in the last frame", &mut lines);
    lines.push(String::new());
    lines.push(format!(
        "Generated by Denavit {} from this table. Do not edit: generate again.",
        env!("CARGO_PKG_VERSION")
    ));
    lines.extend(programs.iter().map(|(wanted, _, proof)| format!("{wanted}: {proof}.")));
    lines
}

fn text(e: Expr) -> String {
    print(e, &denavit_symbolic::vocabulary::Vocabulary::new(), Style::Ascii)
}

/// The table with aligned columns, its letters those of the convention.
fn table(d: &Description) -> Vec<String> {
    let convention = d.convention;
    let (x, z) = (convention.length_x(), convention.length_z());
    let branches = d.rows.iter().any(|r| !r.gamma.is_zero() || !r.b.is_zero());
    let cells = |row: &crate::description::Row| -> Vec<String> {
        let screw_x = [row.alpha, row.a];
        let screw_z = [row.theta, row.d];
        let list: Vec<Expr> = match convention {
            crate::description::Convention::Standard => vec![row.theta, row.d, row.a, row.alpha],
            _ if branches => [vec![row.gamma, row.b], screw_x.to_vec(), screw_z.to_vec()].concat(),
            _ => [screw_x, screw_z].concat(),
        };
        list.into_iter().map(text).collect()
    };
    let head: Vec<&str> = match convention {
        crate::description::Convention::Standard => vec!["theta", z, x, "alpha"],
        _ if branches => vec!["gamma", "b", "alpha", x, "theta", z],
        _ => vec!["alpha", x, "theta", z],
    };
    let mut rows: Vec<Vec<String>> = vec![head.into_iter().map(str::to_string).collect()];
    rows.extend(d.rows.iter().map(cells));
    let width = |c: usize| rows.iter().map(|r| r[c].len()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..rows[0].len()).map(width).collect();
    let line = |(i, row): (usize, &Vec<String>)| {
        let number = if i == 0 { "i".into() } else { i.to_string() };
        let cells: Vec<String> = row.iter().zip(&widths).map(|(cell, &w)| format!("{cell:<w$}")).collect();
        format!("  {number:>2}  {}", cells.join("  ")).trim_end().to_string()
    };
    rows.iter().enumerate().map(line).collect()
}

impl fmt::Display for Wanted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
