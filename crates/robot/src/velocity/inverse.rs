//! Joint velocities as formulas, where the Jacobian falls into small blocks.
//!
//! Where the last three axes meet, the velocity of the point where they do is a matter of the first three joints alone:
//!
//! ```text
//! ⎡ v ⎤   ⎡ A  0 ⎤ ⎡ q̇₁₋₃ ⎤        q̇₁₋₃ = A⁻¹ v
//! ⎣ ω ⎦ = ⎣ C  B ⎦ ⎣ q̇₄₋₆ ⎦        q̇₄₋₆ = B⁻¹ (ω − C q̇₁₋₃)
//! ```
//!
//! Of other arms, rows are taken together in which as many joints are open as there are of them, the fewest first: they give
//! these joints, and the other rows have that many less.

use super::geometric::{Jacobian, ROWS};
use super::model::JacobianModel;
use crate::description::Description;
use crate::forward::symbol_order;
use denavit_symbolic::factor::{Factored, factored};
use denavit_symbolic::{Expr, Refusal, Ring, Symbol, equal};

/// The joint velocities for a twist, one formula after another.
#[derive(Clone, Debug)]
pub struct RateFormulas {
    /// How the matrix falls into blocks.
    pub blocks: Blocks,
    /// Name and value: [`REST`] (what the joints before leave of the twist), and `d<joint>`. The twist is `vx` … `wz` in the
    /// frame and at the point of the Jacobian.
    pub steps: Vec<(String, Expr)>,
    /// What must not be 0.
    pub conditions: Vec<Expr>,
    /// Whether the blocks times their inverses are proved to be 1.
    pub is_proved: bool,
}

/// How a Jacobian falls into blocks.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Blocks {
    /// Three joints, and the linear rows.
    Point,
    /// The linear rows for three joints, the angular ones for a wrist.
    Wrist,
    /// Rows in which as many joints are open as there are of them.
    Rows,
}

/// Names of what joints that are known leave of the twist.
pub const REST: [&str; 6] = ["ux", "uy", "uz", "rx", "ry", "rz"];

/// Rows and joints that are solved together.
const LARGEST: usize = 3;

type Block = Vec<Vec<Expr>>;

impl RateFormulas {
    /// Those of a Jacobian with three joints, or with blocks of three at the most; `None` for others.
    ///
    /// # Errors
    /// If a determinant is too large to expand.
    pub fn derive(description: &Description, jacobian: &JacobianModel) -> Result<Option<Self>, Refusal> {
        let Ok(matrix) = &jacobian.matrix else { return Ok(None) };
        let order = symbol_order(description);
        let joints: Vec<String> =
            description.variables().iter().map(|v| format!("d{}", v.symbol.name())).collect();
        let (front, back) = ([0, 1, 2], [3, 4, 5]);
        let has_wrist =
            joints.len() == 6 && block(matrix, &front, &back).iter().flatten().all(|e| e.is_zero());
        let plan = match joints.len() {
            3 => Some((Blocks::Point, vec![(front.to_vec(), front.to_vec())])),
            6 if has_wrist => {
                let blocks = [front, back].map(|rows| (rows.to_vec(), rows.to_vec()));
                Some((Blocks::Wrist, blocks.to_vec()))
            }
            _ => None,
        };
        if let Some((blocks, plan)) = plan
            && let Some(found) = Self::by_plan(matrix, &joints, (blocks, plan), &order)?
        {
            return Ok(Some(found));
        }
        // With fewer joints the twist would have to be one that the hand can have.
        if joints.len() != 6 {
            return Ok(None);
        }
        let Some(plan) = by_rows(matrix, &order)? else { return Ok(None) };
        Self::by_plan(matrix, &joints, (Blocks::Rows, plan), &order)
    }

    /// Block after block: rows, and the joints that they give.
    fn by_plan(
        matrix: &Jacobian<Expr>,
        joints: &[String],
        (blocks, plan): (Blocks, Plan),
        order: &[Symbol],
    ) -> Result<Option<Self>, Refusal> {
        let mut found = RateFormulas { blocks, steps: vec![], conditions: vec![], is_proved: true };
        let mut known: Vec<usize> = vec![];
        for (rows, columns) in plan {
            let own = block(matrix, &rows, &columns);
            let Some(inverse) = Inverse::new(&own, order)? else { return Ok(None) };
            // What the joints before leave of the rows.
            let mut right = vec![];
            for &r in &rows {
                let twist = Expr::symbol(ROWS[r]);
                let taken: Vec<(Expr, Expr)> = known
                    .iter()
                    .map(|&j| (matrix.columns[j][r], Expr::symbol(&joints[j])))
                    .filter(|(e, _)| !e.is_zero())
                    .collect();
                right.push(if taken.is_empty() {
                    twist
                } else {
                    let (entries, rates): (Vec<Expr>, Vec<Expr>) = taken.into_iter().unzip();
                    found.steps.push((REST[r].into(), twist - row(&entries, &rates)));
                    Expr::symbol(REST[r])
                });
            }
            for (&j, entries) in columns.iter().zip(&inverse.entries) {
                found.steps.push((joints[j].clone(), row(entries, &right)));
            }
            found.is_proved &= inverse.is_proved(&own);
            for c in inverse.conditions {
                if !found.conditions.contains(&c) {
                    found.conditions.push(c);
                }
            }
            known.extend(columns);
        }
        Ok(Some(found))
    }
}

/// Rows with the joints that they give, block after block.
type Plan = Vec<(Vec<usize>, Vec<usize>)>;

/// Rows and the joints that are open in them, as many of these as of those, the smallest blocks first; `None` if some joint is in
/// no such block.
fn by_rows(matrix: &Jacobian<Expr>, order: &[Symbol]) -> Result<Option<Plan>, Refusal> {
    let n = matrix.columns.len();
    let (mut plan, mut open_rows): (Plan, Vec<usize>) = (vec![], (0..6).collect());
    let mut open: Vec<usize> = (0..n).collect();
    'next: while !open.is_empty() {
        for size in 1..=LARGEST.min(open.len()) {
            for mask in 0..1_u32 << open_rows.len() {
                if mask.count_ones() as usize != size {
                    continue;
                }
                let rows: Vec<usize> =
                    (0..open_rows.len()).filter(|k| mask >> k & 1 == 1).map(|k| open_rows[k]).collect();
                let in_them = |&&j: &&usize| rows.iter().any(|&r| !matrix.columns[j][r].is_zero());
                let joints: Vec<usize> = open.iter().filter(in_them).copied().collect();
                if joints.len() == size && Inverse::new(&block(matrix, &rows, &joints), order)?.is_some() {
                    open_rows.retain(|r| !rows.contains(r));
                    open.retain(|j| !joints.contains(j));
                    plan.push((rows, joints));
                    continue 'next;
                }
            }
        }
        return Ok(None);
    }
    Ok(Some(plan))
}

fn block(matrix: &Jacobian<Expr>, rows: &[usize], columns: &[usize]) -> Block {
    rows.iter().map(|&r| columns.iter().map(|&c| matrix.columns[c][r]).collect()).collect()
}

fn row(entries: &[Expr], by: &[Expr]) -> Expr {
    entries.iter().zip(by).fold(Expr::int(0), |sum, (&e, &x)| sum + e * x)
}

/// The inverse of a block, common factors cancelled.
struct Inverse {
    entries: Block,
    /// The factors of the determinant that are not numbers.
    conditions: Vec<Expr>,
}

impl Inverse {
    fn new(a: &Block, order: &[Symbol]) -> Result<Option<Self>, Refusal> {
        let n = a.len();
        let mut ring = Ring::new(&a.concat(), order);
        let mut factors = |e: Expr| -> Result<Factored, Refusal> {
            let p = ring.polynomial(e)?;
            factored(ring.poly_expr(&p), order)
        };
        let cofactor = |r: usize, c: usize| match n {
            1 => Expr::int(1),
            2 => Expr::int(if r == c { 1 } else { -1 }) * a[1 - r][1 - c],
            _ => {
                let [i, j] = [(r + 1) % 3, (r + 2) % 3];
                let [k, l] = [(c + 1) % 3, (c + 2) % 3];
                // With indices that go round the sign of the cofactor is in the order.
                a[i][k] * a[j][l] - a[i][l] * a[j][k]
            }
        };
        let expanded = (0..n).fold(Expr::int(0), |sum, c| sum + a[0][c] * cofactor(0, c));
        let determinant = factors(expanded)?;
        if determinant.constant.is_zero() {
            return Ok(None);
        }
        let mut entries = vec![vec![Expr::int(0); n]; n];
        for (r, line) in entries.iter_mut().enumerate() {
            for (c, entry) in line.iter_mut().enumerate() {
                *entry = quotient(&factors(cofactor(c, r))?, &determinant);
            }
        }
        Ok(Some(Inverse { entries, conditions: determinant.factors.iter().map(|f| f.0).collect() }))
    }

    fn is_proved(&self, a: &Block) -> bool {
        let n = a.len();
        let column = |c: usize| -> Vec<Expr> { self.entries.iter().map(|row| row[c]).collect() };
        let place =
            |r: usize, c: usize| equal(row(&a[r], &column(c)), Expr::int(i64::from(r == c))).is_equal();
        (0..n).all(|r| (0..n).all(|c| place(r, c)))
    }
}

/// A quotient of products.
fn quotient(above: &Factored, below: &Factored) -> Expr {
    if above.constant.is_zero() {
        return Expr::int(0);
    }
    let power = |of: &Factored, f: Expr| of.factors.iter().find(|g| g.0 == f).map_or(0, |g| g.1);
    let product = |own: &Factored, other: &Factored| {
        let left =
            own.factors.iter().map(|&(f, n)| f.powi(i32::try_from(n - n.min(power(other, f))).unwrap_or(0)));
        left.fold(Expr::int(1), |p, f| p * f)
    };
    Expr::from(&above.constant / &below.constant) * product(above, below) / product(below, above)
}
