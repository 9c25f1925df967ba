//! Programs for evaluators and generated code: whole 4×4 matrices, row-major, the row 0 0 0 1 included.
//!
//! Of one pose alone the shortest program; of many frames one pass along the chain, each frame from the one before:
//! at most twelve multiplications and six additions for an axis that turns, three of each for a length.

use crate::description::Description;
use crate::forward::algorithm::{Outputs, entry_name};
use crate::forward::model::ForwardModel;
use crate::mechanism::{Reference, Walk};
use denavit_program::{Graph, Op, Program, Value};
use denavit_symbolic::{Expr, Rational, Symbol};
use rustc_hash::{FxHashMap, FxHashSet};

/// The tool in the base: the algorithm of [`ForwardModel::of_tool`] with the sixteen entries `t11`, `t12` … `t44` as its
/// results, row by row.
pub fn pose_program(description: &Description) -> Program {
    by_rows(&ForwardModel::of_tool(description, Outputs::ALL).algorithm)
}

/// A program whose results are the entries of a pose column by column, with all results row by row.
fn by_rows(program: &Program) -> Program {
    let mut graph = Graph::new(program.variables(), program.parameters());
    let mut names: FxHashMap<u32, String> = FxHashMap::default();
    let mut values: Vec<Value> = vec![];
    for (i, (op, _)) in program.ops().iter().enumerate() {
        let at = |n: &u32| values[*n as usize];
        let signed = |v: &Value| if v.negative { -at(&v.node) } else { at(&v.node) };
        let v = match op {
            Op::Number(r) => graph.number(r),
            Op::Pi => graph.trace(Expr::pi()),
            Op::Input(s) => graph.input(*s),
            Op::Add(a, b) => graph.add(at(a), at(b)),
            Op::Sub(a, b) => graph.sub(at(a), at(b)),
            Op::Mul(a, b) => graph.mul(at(a), at(b)),
            Op::Div(a, b) => graph.div(at(a), at(b)),
            Op::Sqrt(a) => graph.sqrt(signed(a)),
            Op::Sin(a) => graph.sin(at(a)),
            Op::Cos(a) => graph.cos(at(a)),
            Op::Atan2(a, b) => graph.atan2(signed(a), signed(b)),
            Op::Sign(a) => graph.sign(at(a)),
        };
        if let Some(name) = program.name(i as u32) {
            names.insert(v.node, name.to_string());
        }
        values.push(v);
    }
    let found: FxHashMap<(usize, usize), Value> = Outputs::ALL
        .places()
        .into_iter()
        .zip(program.outputs())
        .map(|(place, (_, v))| {
            let own = values[v.node as usize];
            (place, if v.negative { -own } else { own })
        })
        .collect();
    let mut result = |place: (usize, usize)| {
        let last_row = || Rational::from(i64::from(place == (3, 3)));
        let v = found.get(&place).copied().unwrap_or_else(|| graph.number(&last_row()));
        (entry_name(place), v)
    };
    let results: Vec<(String, Value)> = places().map(&mut result).collect();
    let inputs = program.variables().iter().chain(program.parameters());
    let taken = inputs.map(|s| s.name().to_string()).collect();
    Program::new(&graph, &results, |node| names.get(&node).cloned(), &taken)
}

/// Row and column of the entries of a 4×4 matrix, row by row.
fn places() -> impl Iterator<Item = (usize, usize)> {
    (0..4).flat_map(|r| (0..4).map(move |c| (r, c)))
}

/// Frames in the base, sixteen results each, in the order asked for: `t3_11` … `t3_44` for frame 3, `t11` … `t44` for
/// the tool, `tb_11` … `tb_44` for the base itself.
///
/// The program is the product of the table's elementary transforms, multiplied from the left. The only rule besides
/// is Rz(a)·Rz(b) = Rz(a+b), for axes that are exactly parallel. It takes well below a millisecond to find, and an
/// entry is computed in the same way whichever frames are asked for.
///
/// # Panics
/// If the robot has no such frame.
pub fn frames_program(description: &Description, of: &[Reference]) -> Program {
    let variables: Vec<Symbol> = description.variables().iter().map(|v| v.symbol).collect();
    let parameters: Vec<Symbol> = description.parameters.iter().map(|p| p.symbol).collect();
    let taken: FxHashSet<String> =
        variables.iter().chain(&parameters).map(|s| s.name().to_string()).collect();
    let walked = Walk::merged(description);
    let mut graph = Graph::new(&variables, &parameters);
    let mut entries = |frame: Reference| -> Vec<(String, Value)> {
        let label = match frame {
            Reference::Base => "tb_".into(),
            Reference::Frame(i) => format!("t{i}_"),
            Reference::Tool => "t".to_string(),
        };
        let matrix = walked.place(frame).matrix();
        let name = |place| entry_name(place).replacen('t', &label, 1);
        places().map(|(r, c)| (name((r, c)), graph.trace(matrix[r][c]))).collect()
    };
    // A shared value that is no result has the name of the first frame in which it stands.
    let mut names: FxHashMap<u32, String> = FxHashMap::default();
    for i in 0..=description.rows.len() {
        for (name, v) in entries(Reference::Frame(i)) {
            names.entry(v.node).or_insert(name);
        }
    }
    let results: Vec<(String, Value)> = of.iter().flat_map(|&frame| entries(frame)).collect();
    Program::new(&graph, &results, |node| names.get(&node).cloned(), &taken)
}
