//! The shortest straight-line program for a chain, found by search and proved.
//!
//! A direct column of the orientation is carried from the right, vector at a time, down to some frame, and then
//! multiplied by the product of the factors before it, or carried across three factors at once; the third column can
//! be the cross product of two direct ones; a displacement can be added in its own frame or, along its axis carried there, in any frame before it. All
//! candidates share one value-numbered graph, and what an output reaches in it is what it costs.

use crate::forward::chain::{Chain, Item};
use crate::geometry::{Axis, Rotation, Vector};
use denavit_program::{Graph, Program, Stage, Value, Walk};
use denavit_symbolic::{Angle, Expr, Refusal, Symbol, equal};
use rustc_hash::{FxHashMap, FxHashSet};
use std::fmt;
use std::str::FromStr;

/// Which parts of a transform are asked for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Outputs {
    /// The columns x, y, z of the orientation.
    pub columns: [bool; 3],
    /// The position.
    pub position: bool,
}

impl Outputs {
    /// The whole matrix.
    pub const ALL: Outputs = Outputs { columns: [true; 3], position: true };

    /// Row and column (from 0) of the matrix entries asked for, in the order in which a program gives them: column
    /// by column, the position last.
    pub fn places(self) -> Vec<(usize, usize)> {
        let [x, y, z] = self.columns;
        let columns = [x, y, z, self.position].into_iter().enumerate().filter(|c| c.1);
        columns.flat_map(|(c, _)| (0..3).map(move |r| (r, c))).collect()
    }
}

/// The name of a matrix entry: `t14` is row 1, column 4.
pub fn entry_name((row, column): (usize, usize)) -> String {
    format!("t{}{}", row + 1, column + 1)
}

/// A part of a pose that is not known.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct UnknownPart(pub String);

impl fmt::Display for UnknownPart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "unknown part `{}`; known are x, y, z, orientation, position, all", self.0)
    }
}

impl std::error::Error for UnknownPart {}

impl FromStr for Outputs {
    type Err = UnknownPart;

    /// A list of `x`, `y`, `z`, `position`, `orientation` or `all`, separated by commas.
    fn from_str(text: &str) -> Result<Self, UnknownPart> {
        let mut outputs = Outputs { columns: [false; 3], position: false };
        for part in text.split(',').map(str::trim) {
            match part {
                "x" | "s" | "n" => outputs.columns[0] = true,
                "y" | "o" => outputs.columns[1] = true,
                "z" | "a" => outputs.columns[2] = true,
                "orientation" | "rotation" => outputs.columns = [true; 3],
                "position" | "p" => outputs.position = true,
                "all" => outputs = Outputs::ALL,
                other => return Err(UnknownPart(other.into())),
            }
        }
        Ok(outputs)
    }
}

/// How far the equality of a program with the product of its table was established.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Proof {
    /// Proved: the canonical forms are identical.
    Proved,
    /// Not decided, for the reason given.
    Undecided(Refusal),
    /// The canonical forms differ. With constant angles whose sines are related in ways the ring does not know,
    /// the two sides may still be equal; otherwise this is a defect of the program.
    Failed,
}

const AXES: [char; 3] = ['x', 'y', 'z'];
/// Factors up to which every combination of splits is tried.
const MAX_FACTORS_FOR_ALL_SPLITS: usize = 8;
/// Candidates for the orientation for which the displacements are placed as well.
const ORIENTATIONS_TRIED: usize = 12;
/// Placements of displacements tried for one orientation.
const PLACEMENTS_TRIED: usize = 400;

type Vector3 = [Value; 3];

/// Displacements along some directions, summed up.
type Sums = Vec<(Vector3, Value)>;

/// One way to compute the orientation.
#[derive(Clone)]
struct Orientation {
    /// For each column the frame up to which it is carried from the right; `None` if it is not direct.
    splits: [Option<usize>; 3],
    /// Columns carried across three factors at once: column, frame reached, value.
    leaps: Vec<(usize, usize, Vector3)>,
    columns: [Option<Vector3>; 3],
    cost: (u32, u32),
}

struct Search<'a> {
    graph: Graph,
    chain: &'a Chain,
    variables: &'a [Symbol],
    factors: Vec<[Vector3; 3]>,
    /// Whether all factors are rotations exactly, and not up to the rounding of a matrix as somebody wrote it.
    are_rotations: bool,
    /// Direction of item i carried to a frame before its own.
    carried: FxHashMap<(usize, usize), Vector3>,
    /// F₁…Fₖ.
    prefixes: Vec<[Vector3; 3]>,
    /// Axis c of the last frame in frame k.
    tails: Vec<[Vector3; 3]>,
    /// Displacements summed up, for a frame and the items placed in it.
    sums: FxHashMap<(usize, Vec<usize>), Sums>,
}

/// The shortest program found for the chain's transform. Results are named `t11` … `t34` by row and column;
/// names in `taken` are not given to intermediates.
pub(super) fn shortest(
    chain: &Chain,
    variables: &[Symbol],
    parameters: &[Symbol],
    outputs: Outputs,
    taken: &FxHashSet<String>,
) -> Program {
    let mut search = Search::new(Graph::new(variables, parameters), chain, variables);
    let orientations = search.orientations(outputs.columns);
    let own: Vec<usize> = chain.items.iter().map(|i| i.frame).collect();
    let mut best: Option<((u32, u32), Orientation, Vec<usize>)> = None;
    for orientation in orientations.into_iter().take(ORIENTATIONS_TRIED) {
        if best.as_ref().is_some_and(|b| orientation.cost >= b.0) {
            continue;
        }
        if !outputs.position {
            best = Some((orientation.cost, orientation, own.clone()));
            continue;
        }
        let start = best.as_ref().map_or_else(|| own.clone(), |b| b.2.clone());
        let (cost, placement) = search.place(&orientation, start);
        if best.as_ref().is_none_or(|b| cost < b.0) {
            best = Some((cost, orientation, placement));
        }
    }
    let (orientation, placement) = match best {
        Some((_, orientation, placement)) => (orientation, placement),
        None => (Orientation { splits: [None; 3], leaps: vec![], columns: [None; 3], cost: (0, 0) }, own),
    };
    search.program(&orientation, &placement, outputs, taken)
}

/// True if each column of a factor is the cross product of the other two: a matrix of decimals has it up to rounding.
fn is_rotation(factor: &Rotation<Expr>) -> bool {
    let [x, y, z] = Axis::ALL.map(|axis| factor.column(axis));
    let constant = |e: &Expr| e.symbols().is_empty();
    let entries = factor.rows().into_iter().flatten().collect::<Vec<_>>();
    let is_cross = |a: Vector<Expr>, b: Vector<Expr>, c: Vector<Expr>| {
        let cross = a.cross(b);
        (0..3).all(|i| equal(cross[i], c[i]).is_equal())
    };
    !entries.iter().all(constant) || is_cross(x, y, z) && is_cross(y, z, x) && is_cross(z, x, y)
}

impl<'a> Search<'a> {
    fn new(mut graph: Graph, chain: &'a Chain, variables: &'a [Symbol]) -> Self {
        let factors: Vec<[Vector3; 3]> =
            chain.factors.iter().map(|r| r.rows().map(|row| row.map(|e| graph.trace(e)))).collect();
        let unit = [0, 1, 2].map(|i| [0, 1, 2].map(|j| graph.trace(Expr::int(i64::from(i == j)))));
        let mut search = Search {
            graph,
            chain,
            variables,
            factors,
            are_rotations: chain.factors.iter().all(is_rotation),
            carried: FxHashMap::default(),
            prefixes: vec![unit],
            tails: vec![],
            sums: FxHashMap::default(),
        };
        let m = search.factors.len();
        for k in 0..m {
            let (prefix, factor) = (search.prefixes[k], search.factors[k]);
            let columns = [0, 1, 2].map(|c| {
                let column = factor.map(|row| row[c]);
                search.times(&prefix, column)
            });
            search.prefixes.push([0, 1, 2].map(|r| columns.map(|c| c[r])));
        }
        let mut tails = vec![unit; m + 1];
        for k in (0..m).rev() {
            let factor = search.factors[k];
            tails[k] = tails[k + 1].map(|axis| search.times(&factor, axis));
        }
        search.tails = tails;
        search
    }

    fn times(&mut self, matrix: &[Vector3; 3], v: Vector3) -> Vector3 {
        matrix.map(|row| self.dot(row, v))
    }

    fn dot(&mut self, a: Vector3, b: Vector3) -> Value {
        let products = [0, 1, 2].map(|i| self.graph.mul(a[i], b[i]));
        let sum = self.graph.add(products[0], products[1]);
        self.graph.add(sum, products[2])
    }

    fn cross(&mut self, a: Vector3, b: Vector3) -> Vector3 {
        [(1, 2), (2, 0), (0, 1)].map(|(i, j)| {
            let (x, y) = (self.graph.mul(a[i], b[j]), self.graph.mul(a[j], b[i]));
            self.graph.sub(x, y)
        })
    }

    fn cost(&self, values: &[Value]) -> (u32, u32) {
        let count = self.graph.walk(values).count;
        (count.cost(), count.multiplications)
    }

    /// Ways to compute the orientation, cheapest first; the one with y = z × x and no split wins ties.
    fn orientations(&mut self, wanted: [bool; 3]) -> Vec<Orientation> {
        let m = self.factors.len();
        let direct_sets: Vec<[bool; 3]> = if wanted == [true; 3] && self.are_rotations {
            vec![[true, false, true], [true, true, false], [false, true, true], [true; 3]]
        } else {
            vec![wanted]
        };
        let mut found = vec![];
        for direct in direct_sets {
            let range = |c: usize| if direct[c] { 0..=m } else { 0..=0 };
            for x in range(0) {
                for y in range(1) {
                    for z in range(2) {
                        let splits = [x, y, z];
                        let alike = |c: usize| !direct[c] || splits[c] == x.max(y).max(z);
                        if m > MAX_FACTORS_FOR_ALL_SPLITS && !(0..3).all(alike) {
                            continue;
                        }
                        let splits = [0, 1, 2].map(|c| direct[c].then_some(splits[c]));
                        found.push(self.orientation(splits, wanted));
                    }
                }
            }
            found.extend((0..m.saturating_sub(2)).map(|k| self.leap(k, direct, wanted)));
        }
        found.sort_by_key(|o| o.cost);
        found
    }

    fn orientation(&mut self, splits: [Option<usize>; 3], wanted: [bool; 3]) -> Orientation {
        let columns = [0, 1, 2].map(|c| {
            splits[c].map(|k| {
                let prefix = self.prefixes[k];
                self.times(&prefix, self.tails[k][c])
            })
        });
        self.completed(Orientation { splits, leaps: vec![], columns, cost: (0, 0) }, wanted)
    }

    /// The direct columns through F·G·H = Σ gᵢⱼ·(fᵢ hⱼᵀ), the factors from k on: the outer angles are multiplied
    /// first, which serves several entries where F and H turn about the same kind of axis.
    fn leap(&mut self, k: usize, direct: [bool; 3], wanted: [bool; 3]) -> Orientation {
        let [f, g, h] = [self.factors[k], self.factors[k + 1], self.factors[k + 2]];
        let zero = self.graph.trace(Expr::int(0));
        let mut product = [[zero; 3]; 3];
        for (r, row) in product.iter_mut().enumerate() {
            for (c, entry) in row.iter_mut().enumerate() {
                for i in 0..3 {
                    for j in 0..3 {
                        let outer = self.graph.mul(f[r][i], h[j][c]);
                        let term = self.graph.mul(outer, g[i][j]);
                        *entry = self.graph.add(*entry, term);
                    }
                }
            }
        }
        let mut leaps = vec![];
        let columns = [0, 1, 2].map(|c| {
            direct[c].then(|| {
                let carried = self.times(&product, self.tails[k + 3][c]);
                leaps.push((c, k, carried));
                let prefix = self.prefixes[k];
                self.times(&prefix, carried)
            })
        });
        let splits = direct.map(|d| d.then_some(k + 3));
        self.completed(Orientation { splits, leaps, columns, cost: (0, 0) }, wanted)
    }

    /// The orientation with its third column as a cross product, and what it costs.
    fn completed(&mut self, mut orientation: Orientation, wanted: [bool; 3]) -> Orientation {
        let columns = &mut orientation.columns;
        for c in 0..3 {
            if let (true, None, Some(a), Some(b)) =
                (wanted[c], columns[c], columns[(c + 1) % 3], columns[(c + 2) % 3])
            {
                columns[c] = Some(self.cross(a, b));
            }
        }
        let values: Vec<Value> = columns.iter().flatten().flatten().copied().collect();
        orientation.cost = self.cost(&values);
        orientation
    }

    /// Moves displacements to earlier frames, one at a time, while that pays.
    fn place(&mut self, orientation: &Orientation, start: Vec<usize>) -> ((u32, u32), Vec<usize>) {
        let fixed: Vec<Value> = orientation.columns.iter().flatten().flatten().copied().collect();
        let paid = self.graph.walk(&fixed);
        let mut placement = start;
        let mut best = self.placed_cost(&paid, &placement);
        let mut tried = 0;
        loop {
            let mut improved = false;
            for i in 0..placement.len() {
                for frame in (0..=self.chain.items[i].frame).rev() {
                    if frame == placement[i] || tried >= PLACEMENTS_TRIED {
                        continue;
                    }
                    tried += 1;
                    let before = std::mem::replace(&mut placement[i], frame);
                    let cost = self.placed_cost(&paid, &placement);
                    if cost < best {
                        (best, improved) = (cost, true);
                    } else {
                        placement[i] = before;
                    }
                }
            }
            if !improved {
                return (best, placement);
            }
        }
    }

    fn placed_cost(&mut self, paid: &Walk, placement: &[usize]) -> (u32, u32) {
        let position = self.positions(placement)[0];
        let count = self.graph.extended(paid, &position);
        (count.cost(), count.multiplications)
    }

    /// p in frame k is the sum of the displacements placed there plus Fₖ₊₁ times p in frame k+1; frame 0 first.
    fn positions(&mut self, placement: &[usize]) -> Vec<Vector3> {
        let m = self.factors.len();
        let zero = self.graph.trace(Expr::int(0));
        let mut partial = vec![[zero; 3]; m + 1];
        for k in (0..=m).rev() {
            let carried = match self.factors.get(k).copied() {
                Some(factor) => self.times(&factor, partial[k + 1]),
                None => [zero; 3],
            };
            let displacements = self.displacements(placement, k);
            partial[k] = [0, 1, 2].map(|axis| {
                // What is constant is added first, so that it is hoisted, then what moves.
                let (mut fixed, mut moving) = (zero, vec![]);
                for (direction, length) in &displacements {
                    let term = self.graph.mul(*length, direction[axis]);
                    match self.graph.stage(term.node) {
                        Stage::Constant | Stage::Parameter => fixed = self.graph.add(fixed, term),
                        Stage::Variable => moving.push(term),
                    }
                }
                let own = moving.into_iter().fold(fixed, |sum, term| self.graph.add(sum, term));
                self.graph.add(own, carried[axis])
            });
        }
        partial
    }

    /// The displacements placed in a frame; lengths along the same direction are added first, parameters before
    /// joint variables, so that what is constant is hoisted.
    fn displacements(&mut self, placement: &[usize], frame: usize) -> Sums {
        let placed: Vec<usize> = (0..placement.len()).filter(|&i| placement[i] == frame).collect();
        let key = (frame, placed);
        if let Some(known) = self.sums.get(&key) {
            return known.clone();
        }
        let mut sums: Vec<(Vector3, Vec<Expr>)> = vec![];
        for &i in &key.1 {
            let direction = self.carried(i, frame);
            let length = self.chain.items[i].length;
            let opposite =
                direction.map(|v| if self.graph.as_number(v).is_some_and(|r| r.is_zero()) { v } else { -v });
            if let Some(same) = sums.iter_mut().find(|s| s.0 == direction) {
                same.1.push(length);
            } else if let Some(reversed) = sums.iter_mut().find(|s| s.0 == opposite) {
                reversed.1.push(-length);
            } else {
                sums.push((direction, vec![length]));
            }
        }
        let sums: Sums = sums
            .into_iter()
            .flat_map(|(direction, lengths)| {
                let sum = lengths.into_iter().fold(Expr::int(0), |a, b| a + b);
                let (fixed, moving) = self.split_length(sum);
                let (fixed, moving) = (self.graph.trace(fixed), self.graph.trace(moving));
                // Along an axis the two parts can be added to others of their kind.
                let is_axis = direction.iter().all(|v| self.graph.as_number(*v).is_some());
                if is_axis {
                    vec![(direction, fixed), (direction, moving)]
                } else {
                    vec![(direction, self.graph.add(fixed, moving))]
                }
            })
            .collect();
        self.sums.insert(key, sums.clone());
        sums
    }

    /// The part of a length that is constant, and the part that moves.
    fn split_length(&self, length: Expr) -> (Expr, Expr) {
        let form = Angle::of(length);
        let moves = |e: Expr| e.symbols().iter().any(|s| self.variables.contains(s));
        let (moving, fixed) = form.terms.iter().cloned().partition(|t| moves(t.0));
        let fixed = Angle { terms: fixed, ..form };
        (fixed.to_expr(), Angle { terms: moving, ..Angle::default() }.to_expr())
    }

    /// The direction of item i in a frame at or before its own.
    fn carried(&mut self, i: usize, frame: usize) -> Vector3 {
        if let Some(&known) = self.carried.get(&(i, frame)) {
            return known;
        }
        let item: Item = self.chain.items[i];
        let carried = if frame == item.frame {
            item.direction.0.map(|e| self.graph.trace(e))
        } else {
            let behind = self.carried(i, frame + 1);
            let factor = self.factors[frame];
            self.times(&factor, behind)
        };
        self.carried.insert((i, frame), carried);
        carried
    }

    /// The program of the winner, its shared values named for what they are.
    fn program(
        &mut self,
        orientation: &Orientation,
        placement: &[usize],
        outputs: Outputs,
        taken: &FxHashSet<String>,
    ) -> Program {
        let partial = if outputs.position { self.positions(placement) } else { vec![] };
        let zero = self.graph.trace(Expr::int(0));
        let columns = orientation.columns.map(|c| c.unwrap_or([zero; 3]));
        let position = partial.first().copied().unwrap_or([zero; 3]);
        let value = |(r, c): (usize, usize)| if c < 3 { columns[c][r] } else { position[r] };
        let results: Vec<(String, Value)> =
            outputs.places().into_iter().map(|place| (entry_name(place), value(place))).collect();
        // Name a node after the first part it plays: z4x is the x component, in frame 4, of the last z axis.
        let mut names: FxHashMap<u32, String> = FxHashMap::default();
        let mut name = |v: &Vector3, letter: char, frame: usize| {
            for (value, axis) in v.iter().zip(AXES) {
                names.entry(value.node).or_insert_with(|| format!("{letter}{frame}{axis}"));
            }
        };
        for (c, letter) in AXES.iter().enumerate() {
            if let Some(split) = orientation.splits[c] {
                for k in split..self.tails.len() {
                    name(&self.tails[k][c], *letter, self.chain.frames[k]);
                }
            }
        }
        for (c, k, carried) in &orientation.leaps {
            name(carried, AXES[*c], self.chain.frames[*k]);
        }
        for (k, p) in partial.iter().enumerate().skip(1) {
            name(p, 'p', self.chain.frames[k]);
        }
        if let Some(p) = partial.first() {
            name(p, 'p', self.chain.frames[0]);
        }
        Program::new(&self.graph, &results, |node| names.get(&node).cloned(), taken)
    }
}
