//! Rotations that are rounded: the nearest one stands for them.

use super::inputs::Inputs;
use denavit_program::Value;
use denavit_program::solver::SolverBuilder;
use denavit_symbolic::Rational;

/// Puts the nearest rotation in place of the entries that are given, up to the square of what they are off by:
/// R(3 − RᵀR)/2, or the same of the columns that the goal has. The defect is |RᵀR − 1|.
pub fn nearest(solver: &mut SolverBuilder, inputs: &Inputs) {
    let column = |j: usize| -> Option<(usize, [_; 3])> {
        let [x, y, z] = [0, 1, 2].map(|i| inputs.pose[4 * i + j]);
        Some((j, [x?, y?, z?]))
    };
    let given: Vec<_> = (0..3).filter_map(column).collect();
    if given.is_empty() {
        return;
    }
    let g = &mut solver.graph;
    let columns: Vec<[Value; 3]> = given.iter().map(|(_, symbols)| symbols.map(|s| g.input(s))).collect();
    let (one, half) = (g.number(&Rational::ONE), g.number(&Rational::new(1, 2)));
    let n = columns.len();
    let mut misses = vec![vec![one; n]; n];
    let mut squares = vec![];
    for (a, left) in columns.iter().enumerate() {
        for (b, right) in columns.iter().enumerate().skip(a) {
            let [x, y, z] = [0, 1, 2].map(|i| g.mul(left[i], right[i]));
            let sum = g.add(x, y);
            let sum = g.add(sum, z);
            let miss = if a == b { g.sub(one, sum) } else { -sum };
            (misses[a][b], misses[b][a]) = (miss, miss);
            squares.push(g.mul(miss, miss));
        }
    }
    let total = squares.into_iter().reduce(|sum, square| g.add(sum, square)).unwrap_or(one);
    let defect = g.sqrt(total);
    for (b, (j, symbols)) in given.iter().enumerate() {
        for (i, &symbol) in symbols.iter().enumerate() {
            let g = &mut solver.graph;
            let ways: Vec<Value> =
                columns.iter().zip(&misses).map(|(c, miss)| g.mul(c[i], miss[b])).collect();
            let way = ways.into_iter().reduce(|sum, way| g.add(sum, way)).unwrap_or(one);
            let way = g.mul(half, way);
            let entry = g.add(columns[b][i], way);
            g.bind(symbol, entry);
            solver.name(entry, &format!("r{}{}", i + 1, j + 1));
        }
    }
    solver.defect(defect);
}
