//! Joint velocities as formulas, where the Jacobian falls into blocks of three.
//!
//! Where the last three axes meet, the velocity of the point where they do is a matter of the first three joints alone:
//!
//! ```text
//! ⎡ v ⎤   ⎡ A  0 ⎤ ⎡ q̇₁₋₃ ⎤        q̇₁₋₃ = A⁻¹ v
//! ⎣ ω ⎦ = ⎣ C  B ⎦ ⎣ q̇₄₋₆ ⎦        q̇₄₋₆ = B⁻¹ (ω − C q̇₁₋₃)
//! ```

use super::geometric::{Jacobian, ROWS};
use super::model::JacobianModel;
use crate::description::Description;
use crate::forward::symbol_order;
use denavit_symbolic::factor::{Factored, factored};
use denavit_symbolic::{Expr, Refusal, Ring, Symbol, equal};

/// The joint velocities for a twist, one formula after another.
#[derive(Clone, Debug)]
pub struct RateFormulas {
    /// Name and value: [`REST`] (what the first three joints leave of ω), and `d<joint>`. The twist is `vx` … `wz` in the
    /// frame and at the point of the Jacobian.
    pub steps: Vec<(String, Expr)>,
    /// What must not be 0.
    pub conditions: Vec<Expr>,
    /// Whether the blocks times their inverses are proved to be 1.
    pub is_proved: bool,
}

/// Names of what the first three joints leave of the angular velocity.
pub const REST: [&str; 3] = ["rx", "ry", "rz"];

type Block = [[Expr; 3]; 3];

impl RateFormulas {
    /// Those of a Jacobian with three joints or with two blocks; `None` for others.
    ///
    /// # Errors
    /// If a determinant is too large to expand.
    pub fn derive(description: &Description, jacobian: &JacobianModel) -> Result<Option<Self>, Refusal> {
        let Ok(matrix) = &jacobian.matrix else { return Ok(None) };
        let order = symbol_order(description);
        let joints: Vec<String> =
            description.variables().iter().map(|v| format!("d{}", v.symbol.name())).collect();
        let (first, second) = match joints.len() {
            3 => (Some(block(matrix, 0, 0)), None),
            6 if block(matrix, 0, 3).as_flattened().iter().all(|e| e.is_zero()) => {
                (Some(block(matrix, 0, 0)), Some(block(matrix, 3, 3)))
            }
            _ => (None, None),
        };
        let Some(a) = first else { return Ok(None) };
        let Some(inverse_a) = Inverse::new(&a, &order)? else { return Ok(None) };
        let twist = |k: usize| Expr::symbol(ROWS[k]);
        let mut found = RateFormulas {
            steps: vec![],
            conditions: inverse_a.conditions.clone(),
            is_proved: inverse_a.is_proved(&a),
        };
        for (joint, entries) in joints.iter().zip(&inverse_a.entries) {
            found.steps.push((joint.clone(), row(entries, &[0, 1, 2].map(twist))));
        }
        if let Some(b) = second {
            let Some(inverse_b) = Inverse::new(&b, &order)? else { return Ok(None) };
            let c = block(matrix, 3, 0);
            let rates = [0, 1, 2].map(|k| Expr::symbol(&joints[k]));
            let left = REST.map(Expr::symbol);
            for (k, entries) in c.iter().enumerate() {
                found.steps.push((REST[k].into(), twist(3 + k) - row(entries, &rates)));
            }
            for (joint, entries) in joints[3..].iter().zip(&inverse_b.entries) {
                found.steps.push((joint.clone(), row(entries, &left)));
            }
            found.is_proved &= inverse_b.is_proved(&b);
            found.conditions.extend(inverse_b.conditions);
        }
        Ok(Some(found))
    }
}

fn block(matrix: &Jacobian<Expr>, row: usize, column: usize) -> Block {
    [0, 1, 2].map(|r| [0, 1, 2].map(|c| matrix.columns[column + c][row + r]))
}

fn row(entries: &[Expr; 3], by: &[Expr; 3]) -> Expr {
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
        let mut ring = Ring::new(a.as_flattened(), order);
        let mut factors = |e: Expr| -> Result<Factored, Refusal> {
            let p = ring.polynomial(e)?;
            factored(ring.poly_expr(&p), order)
        };
        let minor = |r: usize, c: usize| {
            let [i, j] = [(r + 1) % 3, (r + 2) % 3];
            let [k, l] = [(c + 1) % 3, (c + 2) % 3];
            // With indices that go round the sign of the cofactor is in the order.
            a[i][k] * a[j][l] - a[i][l] * a[j][k]
        };
        let expanded = (0..3).fold(Expr::int(0), |sum, c| sum + a[0][c] * minor(0, c));
        let determinant = factors(expanded)?;
        if determinant.constant.is_zero() {
            return Ok(None);
        }
        let mut entries = [[Expr::int(0); 3]; 3];
        for (r, line) in entries.iter_mut().enumerate() {
            for (c, entry) in line.iter_mut().enumerate() {
                *entry = quotient(&factors(minor(c, r))?, &determinant);
            }
        }
        Ok(Some(Inverse { entries, conditions: determinant.factors.iter().map(|f| f.0).collect() }))
    }

    fn is_proved(&self, a: &Block) -> bool {
        let column = |c: usize| [0, 1, 2].map(|r| self.entries[r][c]);
        let place =
            |r: usize, c: usize| equal(row(&a[r], &column(c)), Expr::int(i64::from(r == c))).is_equal();
        (0..3).all(|r| (0..3).all(|c| place(r, c)))
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
