//! The text form of a solver: its levels as programs, with the nodes between them, to be read back.
//!
//! ```text
//! variables x y
//! parameters a
//! level                              # what can be computed before the node
//! reads 0 1                          # registers of the program's variables
//! writes 4 5                         # registers of its results
//! variables x y                      # the program (see `text.rs`)
//! parameters a
//! …
//! node line x 4 y 5                  # the equation: its type, its operands' registers
//! degree 1                           # the dimension of its guard
//! guard 6                            # the guard's register, if it has one of its own
//! results c s k
//! label "shoulder"                   # what its branches are called, if anything
//! level
//! …
//! output q1 = 7 angle                # a result's register; whether it is equal modulo 2π
//! residual 8
//! size 9
//! defect 10                          # if it is computed
//! ```
//!
//! Registers are numbered: first the variables, then the results of the nodes in order; all others are written by a level,
//! once. What [`Solver::to_text`] writes reads back as the same solver, operation by operation.

use super::{Level, Node, Register, Root, Solver};
use crate::text::{MAX_BYTES, Name, Quoted, Reader, Rest, TextError, Token, tokens};
use denavit_symbolic::Symbol;
use rustc_hash::FxHashSet;
use std::fmt;

/// The largest number of a register, of nodes, and of branches.
const MAX_REGISTER: Register = 1 << 18;
const MAX_NODES: usize = 32;
const MAX_BRANCHES: usize = 4096;

impl<V> Root<V> {
    /// What the type is called, and the names of its operands in the order of [`Root::map`]; the last may be missing where
    /// a `?` stands behind it.
    fn spelling(word: &str) -> Option<&'static [&'static str]> {
        Some(match word {
            "ratio" => &["numerator", "denominator"],
            "direction" => &["x", "y", "sign?"],
            "line" | "length" => &["x", "y"],
            "sincos" => &["a", "b", "c", "discriminant?"],
            "quadratic" => &["a", "b", "c"],
            "quartic" => &["cc", "cs", "c", "s", "one"],
            _ => return None,
        })
    }

    fn word(&self) -> &'static str {
        match self {
            Root::Ratio { .. } => "ratio",
            Root::Direction { .. } => "direction",
            Root::Line { .. } => "line",
            Root::Length { .. } => "length",
            Root::Sincos { .. } => "sincos",
            Root::Quadratic { .. } => "quadratic",
            Root::Quartic { .. } => "quartic",
        }
    }
}

/// The root of a type with its operands, as many as its spelling has.
fn root(word: &str, operands: &[Register]) -> Option<Root<Register>> {
    Some(match (word, operands) {
        ("ratio", &[numerator, denominator]) => Root::Ratio { numerator, denominator },
        ("direction", &[x, y]) => Root::Direction { x, y, sign: None },
        ("direction", &[x, y, sign]) => Root::Direction { x, y, sign: Some(sign) },
        ("line", &[x, y]) => Root::Line { x, y },
        ("length", &[x, y]) => Root::Length { x, y },
        ("sincos", &[a, b, c]) => Root::Sincos { a, b, c, discriminant: None },
        ("sincos", &[a, b, c, d]) => Root::Sincos { a, b, c, discriminant: Some(d) },
        ("quadratic", &[a, b, c]) => Root::Quadratic { a, b, c },
        ("quartic", &[cc, cs, c, s, one]) => Root::Quartic { cc, cs, c, s, one },
        _ => return None,
    })
}

fn line<T: fmt::Display>(
    f: &mut fmt::Formatter<'_>,
    word: &str,
    all: impl IntoIterator<Item = T>,
) -> fmt::Result {
    f.write_str(word)?;
    all.into_iter().try_for_each(|x| write!(f, " {x}"))?;
    writeln!(f)
}

fn names(symbols: &[Symbol]) -> Vec<String> {
    symbols.iter().map(|s| Name(&s.name()).to_string()).collect()
}

impl fmt::Display for Solver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        line(f, "variables", names(&self.variables))?;
        line(f, "parameters", names(&self.parameters))?;
        for (i, level) in self.levels.iter().enumerate() {
            writeln!(f, "level")?;
            line(f, "reads", &level.reads)?;
            line(f, "writes", &level.writes)?;
            write!(f, "{}", level.program)?;
            let Some(node) = self.nodes.get(i) else { continue };
            write!(f, "node {}", node.root.word())?;
            let parts = Root::<Register>::spelling(node.root.word()).unwrap_or_default();
            for (part, r) in parts.iter().zip(node.root.operands()) {
                write!(f, " {} {r}", part.trim_end_matches('?'))?;
            }
            writeln!(f)?;
            line(f, "degree", [node.degree])?;
            if let Some(guard) = node.guard {
                line(f, "guard", [guard])?;
            }
            line(f, "results", names(&node.results))?;
            if let Some(label) = &node.label {
                line(f, "label", [Quoted(label)])?;
            }
        }
        for ((name, register), is_angle) in self.outputs.iter().zip(&self.angles) {
            let kind = if *is_angle { " angle" } else { "" };
            writeln!(f, "output {} = {register}{kind}", Name(name))?;
        }
        line(f, "residual", [self.residual])?;
        line(f, "size", [self.size])?;
        self.defect.map_or(Ok(()), |r| line(f, "defect", [r]))
    }
}

impl Solver {
    /// The solver as text.
    pub fn to_text(&self) -> String {
        self.to_string()
    }

    /// Reads the text of a solver.
    ///
    /// # Errors
    /// All that is wrong with its programs, in order; else the first thing that is wrong with what stands around them.
    pub fn from_text(text: &str) -> Result<Solver, Vec<TextError>> {
        if text.len() > MAX_BYTES {
            let message = format!("the text is longer than {MAX_BYTES} bytes");
            return Err(vec![TextError { line: 1, column: 1, message }]);
        }
        let mut draft = Draft::default();
        let mut last = 1;
        for (i, line) in text.lines().enumerate() {
            last = i + 1;
            draft.line(last, line).map_err(|e| vec![e])?;
        }
        let errors: Vec<TextError> =
            draft.levels.iter_mut().flat_map(|l| std::mem::take(&mut l.program.errors)).collect();
        if !errors.is_empty() {
            return Err(errors);
        }
        draft.check(last).map_err(|e| vec![e])?;
        draft.solver().ok_or_else(|| vec![missing(last, "`residual` and `size` are missing")])
    }
}

fn missing(line: usize, message: impl Into<String>) -> TextError {
    TextError { line, column: 1, message: message.into() }
}

/// A register where it is named.
#[derive(Clone, Copy)]
struct Place {
    register: Register,
    line: usize,
    column: usize,
}

impl Place {
    fn error(&self, message: String) -> TextError {
        TextError { line: self.line, column: self.column, message }
    }
}

/// A level as it is read.
struct LevelDraft {
    line: usize,
    reads: Vec<Place>,
    writes: Vec<Place>,
    program: Reader,
}

/// A node as it is read; its names are not symbols yet.
struct NodeDraft {
    line: usize,
    word: String,
    operands: Vec<Place>,
    guard: Option<Place>,
    degree: Option<u8>,
    results: Vec<String>,
    label: Option<String>,
}

/// A solver as it is read.
#[derive(Default)]
struct Draft {
    /// Variables and parameters: a program's declarations.
    inputs: Reader,
    levels: Vec<LevelDraft>,
    nodes: Vec<NodeDraft>,
    outputs: Vec<(String, Place, bool)>,
    residual: Option<Place>,
    size: Option<Place>,
    defect: Option<Place>,
}

impl Draft {
    fn line(&mut self, number: usize, text: &str) -> Result<(), TextError> {
        let in_level = self.levels.len() > self.nodes.len() && self.outputs.is_empty();
        let (found, end) = tokens(number, text)?;
        let mut rest = Rest::new(number, &found, end);
        let Some((column, word)) = found.first().map(|(column, token)| match token {
            Token::Word(word) => (*column, word.as_str()),
            _ => (*column, ""),
        }) else {
            return Ok(());
        };
        let of_program = matches!(word, "" | "variables" | "parameters" | "result");
        if of_program {
            let reader = match self.levels.last_mut() {
                Some(level) if in_level => &mut level.program,
                None if matches!(word, "variables" | "parameters") => &mut self.inputs,
                _ => return Err(rest.error(column, "this line belongs to a level")),
            };
            reader.line(number, text);
            return reader.errors.first().filter(|_| !in_level).map_or(Ok(()), |e| Err(e.clone()));
        }
        rest.next();
        let is_late = self.residual.is_some() || self.size.is_some() || !self.outputs.is_empty();
        match word {
            "level" if self.levels.len() == self.nodes.len() && !is_late => {
                if self.levels.len() > MAX_NODES {
                    return Err(rest.error(column, format!("more than {MAX_NODES} nodes")));
                }
                let program = Reader::default();
                self.levels.push(LevelDraft { line: number, reads: vec![], writes: vec![], program });
            }
            "reads" | "writes" if in_level => {
                let Some(level) = self.levels.last_mut() else { return Ok(()) };
                let list = if word == "reads" { &mut level.reads } else { &mut level.writes };
                while rest.column() != rest.end() {
                    list.push(register(&mut rest)?);
                }
            }
            "node" if in_level => self.node(number, &mut rest)?,
            "degree" | "guard" | "results" | "label" if !in_level && !is_late => {
                let Some(node) = self.nodes.last_mut() else {
                    return Err(rest.error(column, "there is no node yet"));
                };
                node.line(word, &mut rest)?;
            }
            "output" if self.levels.len() > self.nodes.len() => {
                let (_, name) = rest.name("the name of an output")?;
                rest.equals()?;
                let place = register(&mut rest)?;
                let is_angle = rest.take(&Token::Word("angle".into()));
                self.outputs.push((name, place, is_angle));
            }
            "residual" if self.levels.len() > self.nodes.len() => self.residual = Some(register(&mut rest)?),
            "size" if self.levels.len() > self.nodes.len() => self.size = Some(register(&mut rest)?),
            "defect" if self.levels.len() > self.nodes.len() => self.defect = Some(register(&mut rest)?),
            _ => return Err(rest.error(column, format!("`{word}` is not expected here"))),
        }
        rest.finished()
    }

    fn node(&mut self, line: usize, rest: &mut Rest) -> Result<(), TextError> {
        let (column, word) = rest.name("the type of an equation")?;
        let Some(parts) = Root::<Register>::spelling(&word) else {
            return Err(rest.error(column, format!("there is no equation `{word}`")));
        };
        let mut operands = vec![];
        for part in parts {
            let name = part.trim_end_matches('?');
            let column = rest.column();
            if rest.take(&Token::Word(name.into())) {
                operands.push(register(rest)?);
            } else if name == *part {
                return Err(rest.error(column, format!("expected `{name}`")));
            }
        }
        let draft =
            NodeDraft { line, word, operands, guard: None, degree: None, results: vec![], label: None };
        self.nodes.push(draft);
        Ok(())
    }

    /// Whether every register is there where it is read, and written once.
    fn check(&self, last: usize) -> Result<(), TextError> {
        if self.levels.len() != self.nodes.len() + 1 {
            return Err(missing(last, "a level is missing behind the last node"));
        }
        let mut names: FxHashSet<&String> =
            self.inputs.variables.iter().chain(&self.inputs.parameters).collect();
        let mut known: FxHashSet<Register> = (0..self.inputs.variables.len() as Register).collect();
        let mut results = known.len() as Register;
        let total: usize = self.nodes.iter().map(|n| n.results.len()).sum();
        let own = results + total as Register;
        let is_known = |known: &FxHashSet<Register>, place: &Place| match known.contains(&place.register) {
            true => Ok(()),
            false => Err(place.error(format!("register {} is not known here", place.register))),
        };
        let mut branches = 1;
        for (i, level) in self.levels.iter().enumerate() {
            level.check(&self.inputs)?;
            level.reads.iter().try_for_each(|place| is_known(&known, place))?;
            for place in &level.writes {
                if place.register < own || !known.insert(place.register) {
                    return Err(place.error(format!("register {} is taken", place.register)));
                }
            }
            if i == 0 {
                self.size.iter().chain(&self.defect).try_for_each(|place| is_known(&known, place))?;
            }
            let Some(node) = self.nodes.get(i) else { continue };
            node.operands.iter().chain(&node.guard).try_for_each(|place| is_known(&known, place))?;
            branches *= node.check()?;
            if branches > MAX_BRANCHES {
                return Err(missing(node.line, format!("more than {MAX_BRANCHES} branches")));
            }
            for name in &node.results {
                if !names.insert(name) {
                    return Err(missing(node.line, format!("there are two values `{name}`")));
                }
                known.insert(results);
                results += 1;
            }
        }
        let ends = self.outputs.iter().map(|o| &o.1).chain(&self.residual);
        ends.clone().try_for_each(|place| is_known(&known, place))
    }

    /// Once all is checked.
    fn solver(self) -> Option<Solver> {
        let symbols = |names: &[String]| names.iter().map(|n| Symbol::new(n)).collect::<Vec<_>>();
        let registers = |places: &[Place]| places.iter().map(|p| p.register).collect::<Vec<_>>();
        let nodes = self.nodes.into_iter().map(|node| {
            Some(Node {
                root: root(&node.word, &registers(&node.operands))?,
                guard: node.guard.map(|p| p.register),
                degree: node.degree?,
                results: symbols(&node.results),
                label: node.label,
            })
        });
        let nodes = nodes.collect::<Option<Vec<_>>>()?;
        let results: usize = nodes.iter().map(|n| n.results.len()).sum();
        let written = self.levels.iter().flat_map(|l| &l.writes).map(|p| p.register as usize + 1);
        let own = self.inputs.variables.len() + results;
        let total = written.max().unwrap_or(0).max(own);
        let level = |l: LevelDraft| Level {
            reads: registers(&l.reads),
            writes: registers(&l.writes),
            program: l.program.finish(),
        };
        Some(Solver {
            variables: symbols(&self.inputs.variables),
            parameters: symbols(&self.inputs.parameters),
            angles: self.outputs.iter().map(|o| o.2).collect(),
            outputs: self.outputs.into_iter().map(|(name, place, _)| (name, place.register)).collect(),
            residual: self.residual?.register,
            size: self.size?.register,
            defect: self.defect.map(|place| place.register),
            registers: total,
            levels: self.levels.into_iter().map(level).collect(),
            nodes,
        })
    }
}

impl LevelDraft {
    fn check(&self, inputs: &Reader) -> Result<(), TextError> {
        let program = &self.program;
        for (what, places, count) in [
            ("variables", &self.reads, program.variables.len()),
            ("results", &self.writes, program.results.len()),
        ] {
            if places.len() != count {
                let message =
                    format!("the program has {count} {what}, and {} registers for them", places.len());
                return Err(missing(self.line, message));
            }
        }
        if program.parameters != inputs.parameters {
            return Err(missing(self.line, "the program's parameters are not those of the solver"));
        }
        Ok(())
    }
}

impl NodeDraft {
    fn line(&mut self, word: &str, rest: &mut Rest) -> Result<(), TextError> {
        let column = rest.column();
        match word {
            "degree" => {
                let degree = register(rest)?.register;
                let degree = u8::try_from(degree).map_err(|_| rest.error(column, "a degree is below 256"))?;
                self.degree = Some(degree);
            }
            "guard" => self.guard = Some(register(rest)?),
            "results" => {
                while rest.column() != rest.end() {
                    self.results.push(rest.name("a name")?.1);
                }
            }
            _ => self.label = Some(rest.name("a label")?.1),
        }
        Ok(())
    }

    /// How many branches there are.
    fn check(&self) -> Result<usize, TextError> {
        let operands: Vec<Register> = self.operands.iter().map(|p| p.register).collect();
        let Some(root) = root(&self.word, &operands) else {
            return Err(missing(self.line, "operands are missing"));
        };
        if self.degree.is_none() {
            return Err(missing(self.line, "the degree of the guard is missing"));
        }
        if self.results.len() != root.results() {
            let message = format!("{} results have {} names", root.results(), self.results.len());
            return Err(missing(self.line, message));
        }
        Ok(root.branches())
    }
}

fn register(rest: &mut Rest) -> Result<Place, TextError> {
    let (line, column) = (rest.number(), rest.column());
    let number = rest.digits()?.to_integer().and_then(|n| Register::try_from(n).ok());
    match number.filter(|&n| n <= MAX_REGISTER) {
        Some(register) => Ok(Place { register, line, column }),
        None => Err(rest.error(column, format!("a number up to {MAX_REGISTER} is expected"))),
    }
}
