//! What goes into a solver, and the pose that it is about.

use super::chain::NormalChain;
use super::equations::Goal;
use super::naming::unique;
use crate::geometry::{Rotation, Transform, Vector};
use denavit_symbolic::{Expr, Symbol};
use rustc_hash::FxHashSet;

/// What goes into a solver, in order: the entries of the pose that the goal gives, then the given joint variables.
#[derive(Clone, Debug)]
pub struct Inputs {
    /// The entries of the pose, row-major in a 3×4 matrix; nothing where the goal does not give one.
    pub pose: [Option<Symbol>; 12],
    /// The joint variables that are given, with their numbers.
    pub given: Vec<(usize, Symbol)>,
}

impl Inputs {
    /// The inputs of a chain's solver.
    pub fn new(chain: &NormalChain, goal: Goal, given: &[usize]) -> Self {
        let trivial = chain.base == Transform::identity() && chain.tool == Transform::identity();
        let mut taken: FxHashSet<String> =
            chain.variables.iter().chain(&chain.parameters).map(|s| s.name().to_string()).collect();
        let pose = std::array::from_fn(|k| {
            let (row, column) = (k / 4, k % 4);
            let wanted = match goal {
                Goal::Pose => true,
                Goal::Position => column == 3,
                Goal::PositionAndAxis => column >= 2,
            };
            let name = if trivial {
                chain.pose[k].name().to_string()
            } else {
                unique(format!("t{}{}", row + 1, column + 1), &mut taken)
            };
            wanted.then(|| Symbol::new(&name))
        });
        Inputs { pose, given: given.iter().map(|&k| (k, chain.variables[k])).collect() }
    }

    /// All symbols, in order.
    pub fn symbols(&self) -> Vec<Symbol> {
        self.pose.iter().flatten().copied().chain(self.given.iter().map(|g| g.1)).collect()
    }
}

/// The entries of U = base⁻¹ · T · tool⁻¹ in those of T; nothing for an entry that the goal does not give.
pub fn moved_pose(chain: &NormalChain, inputs: &Inputs) -> [Option<Expr>; 12] {
    let entry = |row: usize, column: usize| inputs.pose[row * 4 + column].map(Expr::from);
    let zero = Expr::int(0);
    let r = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j).unwrap_or(zero)));
    let p = std::array::from_fn(|i| entry(i, 3).unwrap_or(zero));
    let pose = Transform::from_rotation_translation(Rotation::from_rows(r), Vector(p));
    let base = chain.base.inverse();
    let tool = chain.tool.inverse();
    let moved = if inputs.pose.iter().all(Option::is_some) { base * pose * tool } else { base * pose };
    let rows = moved.rotation.rows();
    std::array::from_fn(|k| {
        let (i, j) = (k / 4, k % 4);
        inputs.pose[k]?;
        Some(if j == 3 { moved.translation.0[i] } else { rows[i][j] })
    })
}
