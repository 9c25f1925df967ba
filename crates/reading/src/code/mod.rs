//! Straight-line kinematics in Python and MATLAB, read without running it.
//!
//! Text → tokens (`lexer`) → a program in one form for both languages (`tree`; `grammar` and `atoms` read expressions,
//! `python` and `matlab` statements) → formulas (`machine` runs statements, `eval` and `calls` expressions, `place`
//! indices, `library`, `builders` and `methods` what NumPy, SymPy and MATLAB bring along), each beside the way it is written. Loops
//! over known numbers are unrolled, and functions of the text are carried out where they are called. What depends on
//! values, or cannot be known, is refused with its place; what comes after it is still read as far as it does not need it.
//!
//! Arrays of Python are shared between names: setting entries of one that another name may stand for is refused.

mod atoms;
mod builders;
mod c;
mod calculus;
mod calls;
mod compared;
mod eval;
mod grammar;
mod known;
mod lexer;
mod library;
mod machine;
mod matlab;
mod methods;
mod place;
mod posed;
mod python;
mod records;
mod report;
mod scalar;
mod tree;
mod value;

pub use compared::{Compared, OwnFunction};
use denavit_symbolic::Expr;
use denavit_symbolic::parse::{ParseError, Syntax};
use machine::Machine;
pub use posed::{Posed, is_sign_name};
use scalar::Scalar;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use tree::{Definition, Kind, Node, Statement, StatementKind};
use value::Object;

/// The longest text, in bytes.
pub const MAX_BYTES: usize = 1_000_000;
/// The deepest nesting of brackets and blocks.
pub const MAX_NESTING: usize = 100;
/// The most statements that are carried out.
pub(crate) const MAX_STATEMENTS: usize = 100_000;
/// The most rows and columns of a matrix, and items of a list that is counted out.
pub(crate) const MAX_SIDE: usize = 64;
/// The most turns of a loop.
pub(crate) const MAX_TURNS: usize = 64;
/// The most operators in a row.
const MAX_CHAIN: usize = 2_000;
/// The most calls inside one another.
const MAX_CALLS: usize = 20;
/// The most brackets, statements and calls inside one another, counted together.
const MAX_DEPTH: usize = 400;
/// The deepest nesting of lists.
const MAX_LISTS: usize = 16;
/// The most operations.
const MAX_WORK: u64 = 1_000_000;
/// The most nodes of a formula that is written out.
const MAX_SIZE: u64 = 1_000_000;
/// The most refusals that are reported.
const MAX_REFUSALS: usize = 50;

/// A programming language.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Dialect {
    /// Python with NumPy, SymPy or `math`.
    Python,
    /// MATLAB or Octave.
    Matlab,
    /// C or C++.
    C,
}

/// What a text computes.
#[derive(Clone, Debug, Default)]
pub struct Code {
    /// The statements outside of functions, if they give a name a value, and the functions, in the order of the text.
    /// Functions that only others of the text can call, with arguments of their own, are not among them.
    pub functions: Vec<Reading>,
    /// Functions of the four parameters of a row of a Denavit–Hartenberg table, with what stands for these.
    pub rows: Vec<RowFunction>,
    /// What is not read, in the order of the text.
    pub refusals: Vec<ParseError>,
    /// What its tests compare, if the robot's own functions are known.
    pub compared: Vec<Compared>,
}

/// A function that gives the transform of a row of a table.
#[derive(Clone, Debug)]
pub struct RowFunction {
    /// What it computes.
    pub reading: Reading,
    /// What stands for θ and α.
    pub angles: [Expr; 2],
    /// What stands for the lengths, in the order of the arguments.
    pub lengths: [Expr; 2],
}

/// What a function computes.
#[derive(Clone, Debug)]
pub struct Reading {
    /// Its name; empty for statements outside of functions.
    pub name: String,
    /// All of it.
    pub span: Range<usize>,
    /// The values that names get, in order; loops give theirs again and again.
    pub assigned: Vec<Assigned>,
    /// What it gives back; empty if that is not known.
    pub returned: Vec<Returned>,
    /// What it shows, by `print` or by standing alone.
    pub shown: Vec<Shown>,
}

/// A statement that shows values.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The statement.
    pub span: Range<usize>,
    /// Each value with the place of its formula.
    pub values: Vec<(Range<usize>, Value)>,
    /// `print(…)`, not a value that stands alone.
    pub is_call: bool,
}

/// A name and its value. A matrix whose entries are set one by one is here once, complete, from the first statement that
/// sets one to the last.
#[derive(Clone, Debug)]
pub struct Assigned {
    /// The name.
    pub name: String,
    /// Of the right side.
    pub span: Range<usize>,
    /// What the name stands for from here on.
    pub value: Value,
}

impl Assigned {
    /// True for a matrix of zeros alone.
    fn is_set_aside(&self) -> bool {
        match &self.value {
            Value::Matrix(rows) => rows.iter().flatten().all(|cell| cell.value.is_zero()),
            Value::Scalar(_) => false,
        }
    }
}

/// A value that a function gives back.
#[derive(Clone, Debug)]
pub struct Returned {
    /// The name, if one is given back.
    pub name: Option<String>,
    /// Where it is given back; in MATLAB where the name got its value.
    pub span: Range<usize>,
    /// What it is.
    pub value: Value,
}

/// A number or a matrix by rows. An array with one index, and a list of numbers, is a column.
#[derive(Clone, Debug)]
pub enum Value {
    /// A number.
    Scalar(Cell),
    /// Rows of equal length, at least one.
    Matrix(Vec<Vec<Cell>>),
}

/// A number, or an entry of a matrix.
#[derive(Clone, Debug)]
pub struct Cell {
    /// What it is.
    pub value: Expr,
    /// How it is written, if it is: its value is `value`, its places count from the beginning of `span`.
    pub syntax: Option<Syntax>,
    /// Where it is written, perhaps in a function that was called, or the operation that it comes from.
    pub span: Range<usize>,
}

/// Reads the part of a text that is a program.
///
/// `names` gives names without a value in the text their meaning: parameters, joint variables. A function is read if its
/// arguments have meaning: by name, by default, one argument as the vector of all `joints`, or as many arguments as joints.
pub fn read(
    text: &str,
    span: Range<usize>,
    language: Dialect,
    names: &dyn Fn(&str) -> Option<Expr>,
    joints: &[Expr],
) -> Code {
    read_stated(text, span, language, names, joints, &|_, _| None)
}

/// What a name stands for that a script gives numbers: as many formulas.
pub type Stated<'a> = dyn Fn(&str, &[Expr]) -> Option<Vec<Expr>> + 'a;

/// The same, where numbers that a script gives names outside of functions are what `stated` says: joints for their values.
pub fn read_stated(
    text: &str,
    span: Range<usize>,
    language: Dialect,
    names: &dyn Fn(&str) -> Option<Expr>,
    joints: &[Expr],
    stated: &Stated<'_>,
) -> Code {
    let asked = Asked { names, joints, stated, mended: &BTreeMap::new(), posed: None, own: None };
    read_blocks(text, &[span], language, &asked).pop().unwrap_or_default()
}

/// What a program is read with.
#[derive(Clone, Copy)]
pub struct Asked<'a> {
    /// The meaning of names without a value in the text.
    pub names: &'a dyn Fn(&str) -> Option<Expr>,
    /// All joints.
    pub joints: &'a [Expr],
    /// What names stand for that a script gives numbers.
    pub stated: &'a Stated<'a>,
    /// Values that stand for those that names get, by the place where these are written: all entries, by rows.
    pub mended: &'a BTreeMap<usize, Vec<Expr>>,
    /// How it is read where it is told of a pose, and gives joints their values.
    pub posed: Option<Posed<'a>>,
    /// What functions give that are the robot's own.
    pub own: Option<&'a OwnFunction<'a>>,
}

/// Reads the blocks of one program, as the cells of a notebook are: a name keeps its value in those that follow.
pub fn read_blocks(text: &str, spans: &[Range<usize>], language: Dialect, asked: &Asked<'_>) -> Vec<Code> {
    let mut codes: Vec<Code> = spans.iter().map(|_| Code::default()).collect();
    let Some(last) = spans.last().cloned() else { return codes };
    let length: usize = spans.iter().map(Range::len).sum();
    if length > MAX_BYTES || spans.iter().any(|s| text.get(s.clone()).is_none()) {
        let message = format!("a program has at most {MAX_BYTES} bytes");
        codes[spans.len() - 1].refusals.push(ParseError::new(last, message));
        return codes;
    }
    let parsed: Vec<(Vec<Statement>, Vec<ParseError>)> = spans
        .iter()
        .map(|span| match language {
            Dialect::Python => python::parse(text, span),
            Dialect::Matlab => matlab::parse(text, span),
            Dialect::C => c::parse(text, span),
        })
        .collect();
    // C is read as what it says in Python.
    let language = if language == Dialect::C { Dialect::Python } else { language };
    let mut machine = Machine::new(language, asked);
    machine.refusals = parsed.iter().flat_map(|p| p.1.iter().cloned()).collect();
    let mut of_script = BTreeSet::new();
    let scripts = parsed.iter().flat_map(|p| &p.0).filter(|s| definition(s).is_none());
    scripts.for_each(|statement| tree::mentioned(std::slice::from_ref(statement), &mut of_script));
    let mut of_others = BTreeSet::new();
    for d in parsed.iter().flat_map(|p| &p.0).filter_map(definition) {
        let mut names = BTreeSet::new();
        tree::mentioned(&d.body, &mut names);
        names.remove(d.name.as_str());
        of_others.extend(names);
    }
    for ((code, (program, _)), span) in codes.iter_mut().zip(&parsed).zip(spans) {
        block(code, program, span, &mut machine, [&of_script, &of_others]);
    }
    if machine.budget.is_spent() && machine.refusals.len() < MAX_REFUSALS {
        let e = ParseError::new(last, "the code computes more than is followed")
            .hint("leave only the kinematics");
        machine.refusals.push(e);
    }
    for e in machine.refusals {
        let of = |s: &Range<usize>| s.start <= e.span.start && e.span.start <= s.end;
        let k = spans.iter().position(of).unwrap_or(0);
        codes[k].refusals.push(e);
    }
    for c in machine.compared {
        let of = |s: &Range<usize>| s.start <= c.span.start && c.span.start <= s.end;
        let k = spans.iter().position(of).unwrap_or(0);
        codes[k].compared.push(c);
    }
    for code in &mut codes {
        code.refusals.sort_by_key(|e| (e.span.start, e.span.end));
    }
    codes
}

/// One block, after those before it.
fn block<'a>(
    code: &mut Code,
    program: &'a [Statement],
    span: &Range<usize>,
    machine: &mut Machine<'a>,
    [of_script, of_others]: [&BTreeSet<&str>; 2],
) {
    let definitions: Vec<&Definition> = program.iter().filter_map(definition).collect();
    machine.functions.extend(definitions.iter().map(|d| (d.name.as_str(), *d)));
    let assigned = machine.script(program);
    let shown = std::mem::take(&mut machine.shown);
    if !assigned.is_empty() || !shown.is_empty() || definitions.is_empty() {
        let (name, span, returned) = (String::new(), span.clone(), vec![]);
        code.functions.push(Reading { name, span, assigned, returned, shown });
    }
    let mut helpers = vec![];
    for d in &definitions {
        // A script calls `Rz(t)` with what it likes, `fk(q)` with the joints.
        let is_joints = |p: &tree::Parameter| is_vector(&p.name) || (machine.names)(&p.name).is_some();
        let is_of_script = of_script.contains(d.name.as_str()) && !d.parameters.iter().all(is_joints);
        let is_helper = of_others.contains(d.name.as_str())
            || is_of_script && d.parameters.len() < machine.joints.len()
            || roles_of_row(d).is_some();
        match arguments(d, machine, is_helper) {
            Ok(slots) => code.functions.push(reading(d, slots, machine)),
            Err(_) if is_helper => helpers.push(*d),
            Err(e) => machine.refuse(e.into()),
        }
    }
    for d in helpers {
        // Another function calls it with the joints as they are.
        if machine.called.contains(&d.name.as_str())
            && let Ok(slots) = arguments(d, machine, false)
        {
            code.functions.push(reading(d, slots, machine));
        }
    }
    for d in &definitions {
        code.rows.extend(row_function(d, machine));
    }
    // `px = lambda q1, q2: …`, `px = @(q1, q2) …`
    for statement in program {
        if let StatementKind::Assign(targets, value) = &statement.kind
            && let ([Node { kind: Kind::Name(name), .. }], Kind::Lambda(d)) =
                (targets.as_slice(), &value.kind)
        {
            match arguments(d, machine, of_script.contains(name.as_str())) {
                Ok(slots) => {
                    let mut read = reading(d, slots, machine);
                    read.name.clone_from(name);
                    read.returned.iter_mut().for_each(|r| r.name = None);
                    code.functions.push(read);
                }
                Err(_) => {
                    let renamed = row_function(d, machine);
                    code.rows.extend(renamed.map(|mut r| {
                        r.reading.name.clone_from(name);
                        r
                    }));
                }
            }
        }
    }
    code.functions.sort_by_key(|f| (!f.name.is_empty(), f.span.start));
}

fn definition(statement: &Statement) -> Option<&Definition> {
    match &statement.kind {
        StatementKind::Define(d) => Some(d),
        _ => None,
    }
}

fn reading<'a>(
    d: &'a Definition,
    slots: BTreeMap<&'a str, Object<'a>>,
    machine: &mut Machine<'a>,
) -> Reading {
    let (assigned, returned) = machine.function(d, slots);
    let shown = std::mem::take(&mut machine.shown);
    Reading { name: d.name.clone(), span: d.span.clone(), assigned, returned, shown }
}

/// What the arguments of the function of a row are, if they are named as its parameters are: θ 0, α 1, a length 2.
fn roles_of_row(d: &Definition) -> Option<Vec<usize>> {
    let role = |name: &str| match name.to_lowercase().trim_end_matches(['_', 'i']) {
        "theta" | "th" | "tht" | "t" | "q" | "θ" => Some(0),
        "alpha" | "alph" | "alfa" | "al" | "alp" | "α" => Some(1),
        "a" | "d" | "r" => Some(2),
        _ => None,
    };
    let roles: Vec<usize> = d.parameters.iter().map(|p| role(&p.name)).collect::<Option<_>>()?;
    let count = |k: usize| roles.iter().filter(|r| **r == k).count();
    ([count(0), count(1), count(2)] == [1, 1, 2]).then_some(roles)
}

/// A function whose arguments are named as the parameters of a row are; errors of it are reported where it is called.
fn row_function<'a>(d: &'a Definition, machine: &mut Machine<'a>) -> Option<RowFunction> {
    let roles = roles_of_row(d)?;
    let symbols: Vec<Expr> = d.parameters.iter().map(|p| Expr::symbol(&format!("{}_i", p.name))).collect();
    let of =
        |k: usize| -> Vec<Expr> { symbols.iter().zip(&roles).filter(|s| *s.1 == k).map(|s| *s.0).collect() };
    let (angles, lengths) = ([of(0)[0], of(1)[0]], [of(2)[0], of(2)[1]]);
    let slots = d.parameters.iter().zip(&symbols);
    let slots = slots.map(|(p, e)| (p.name.as_str(), Object::Scalar(Scalar::of(*e, &p.span)))).collect();
    let refusals = machine.refusals.len();
    let reading = reading(d, slots, machine);
    machine.refusals.truncate(refusals);
    Some(RowFunction { reading, angles, lengths })
}

/// The meaning of the arguments of a function that is read by itself.
fn arguments<'a>(
    d: &'a Definition,
    machine: &Machine<'a>,
    is_helper: bool,
) -> Result<BTreeMap<&'a str, Object<'a>>, ParseError> {
    if machine.posed.is_some() {
        return Ok(machine.posed_arguments(d));
    }
    let mut slots = BTreeMap::new();
    let mut unknown = vec![];
    // Beside a joint by its name, another one has a name, too.
    let mut has_joint = false;
    for p in &d.parameters {
        match (machine.names)(&p.name) {
            Some(meaning) => {
                has_joint |= machine.joints.iter().any(|q| is_angle_of(meaning, *q));
                slots.insert(p.name.as_str(), Object::Scalar(Scalar::of(meaning, &p.span)));
            }
            None if p.default.is_none() => unknown.push(p),
            None => {}
        }
    }
    // Beside joints as many more as there are: how fast they move.
    let known: Vec<Expr> = d.parameters.iter().filter_map(|p| (machine.names)(&p.name)).collect();
    let takes_all = || machine.joints.iter().all(|q| known.iter().any(|e| is_angle_of(*e, *q)));
    let rate = |q: &Expr| (machine.names)(&format!("dot{}", q.as_symbol()?.name()));
    let rates: Option<Vec<Expr>> = machine.joints.iter().map(rate).collect();
    if !unknown.is_empty()
        && unknown.len() < machine.joints.len() + 1
        && let Some(rates) = &rates
        && (takes_all() || has_joint && rates.iter().any(|r| known.contains(r)))
    {
        // Those that are known keep their meaning, the others are the rest in their order.
        let open: Vec<Expr> = rates.iter().copied().filter(|r| !known.contains(r)).collect();
        if open.len() == unknown.len() {
            for (p, rate) in unknown.iter().zip(open) {
                slots.insert(p.name.as_str(), Object::Scalar(Scalar::of(rate, &p.span)));
            }
            unknown.clear();
        }
    }
    // Beside the vector of all joints that of their rates, or of a force.
    if let [q, others @ ..] = &unknown[..]
        && !others.is_empty()
        && !has_joint
        && is_vector(&q.name)
        && let Some(vectors) =
            others.iter().map(|p| beside(p, rates.as_deref(), machine)).collect::<Option<Vec<_>>>()
    {
        slots.insert(q.name.as_str(), machine.joint_vector(&q.span));
        slots.extend(others.iter().map(|p| p.name.as_str()).zip(vectors));
        unknown.clear();
    }
    // Beside all joints by their names the vector of their rates, or of a force.
    if !unknown.is_empty()
        && takes_all()
        && let Some(vectors) =
            unknown.iter().map(|p| beside(p, rates.as_deref(), machine)).collect::<Option<Vec<_>>>()
    {
        slots.extend(unknown.iter().map(|p| p.name.as_str()).zip(vectors));
        unknown.clear();
    }
    match unknown.as_slice() {
        [] => {}
        // One name stands for all joints; a helper has meaning only where it is called.
        [p] if !has_joint && !is_helper || (d.parameters.len() == 1 && is_vector(&p.name)) => {
            slots.insert(p.name.as_str(), machine.joint_vector(&p.span));
        }
        several if several.len() == machine.joints.len() && !has_joint && !is_helper => {
            for (p, joint) in several.iter().zip(machine.joints) {
                slots.insert(p.name.as_str(), Object::Scalar(Scalar::of(*joint, &p.span)));
            }
        }
        [first, ..] => {
            let message = format!("what `{}` of `{}` stands for is not known", first.name, d.name);
            let hint = match machine.language {
                Dialect::Python | Dialect::C => "a function of the joints is `def fk(q):`",
                Dialect::Matlab => "a function of the joints is `function T = fk(q)`",
            };
            return Err(ParseError::new(first.span.clone(), message).hint(hint));
        }
    }
    Ok(slots)
}

/// True for a joint, and for one in degrees.
fn is_angle_of(meaning: Expr, joint: Expr) -> bool {
    meaning == joint
        || matches!(meaning.node(), denavit_symbolic::Node::Mul(a, b) if a == joint || b == joint)
}

/// What a vector beside that of all joints is by its name: the rates of these, or the components of a force.
fn beside<'a>(p: &tree::Parameter, rates: Option<&[Expr]>, machine: &Machine<'a>) -> Option<Object<'a>> {
    const RATES: [&str; 16] = [
        "qd",
        "dq",
        "qdot",
        "q_dot",
        "qp",
        "dqdt",
        "thetad",
        "dtheta",
        "theta_dot",
        "thetadot",
        "thd",
        "dth",
        "w",
        "omega",
        "rates",
        "speeds",
    ];
    if RATES.contains(&p.name.as_str()) {
        return Some(machine.vector_of(rates?, &p.span));
    }
    let force =
        is_force(&p.name).then(|| ["x", "y", "z"].map(|axis| Expr::symbol(&format!("{}{axis}", p.name))));
    Some(machine.vector_of(&force?, &p.span))
}

/// True for a name that usually stands for the components of a force on the hand.
pub fn is_force(name: &str) -> bool {
    matches!(name, "f" | "F" | "force" | "load" | "fext" | "Fext" | "F_ext" | "f_ext" | "F_tip" | "f_tip")
}

/// True for a name that usually stands for all joints.
pub fn is_vector(name: &str) -> bool {
    eval::VECTORS.contains(&name)
}
