//! Where all bodies of a mechanism are, as one program: each from the one that it stands on.

use super::{Mechanism, chain::moved};
use crate::geometry::Transform;
use denavit_program::{Graph, Program, Value};
use denavit_symbolic::{Expr, Symbol};
use rustc_hash::FxHashSet;

impl Mechanism {
    /// A program for the frames of these bodies in that of the root, in order, sixteen results each, by rows: `t3_11` … `t3_44` for
    /// body 3. Its variables are q1, q2, …, the values of the mechanism's [variables](Mechanism::variables).
    ///
    /// # Panics
    /// If there is no such body.
    pub fn frames_program(&self, bodies: &[usize]) -> Program {
        let joints = self.variables();
        let symbols: Vec<Symbol> = (1..=joints.len()).map(|i| Symbol::new(&format!("q{i}"))).collect();
        let value = |joint: usize| {
            let leader = |j: usize| joints.binary_search(&j).map_or(Expr::int(0), |v| symbols[v].into());
            match &self.joints[joint].follows {
                Some(f) => Expr::from(f.factor.clone()) * leader(f.joint) + f.offset,
                None => leader(joint),
            }
        };
        let mut poses = vec![Transform::<Expr>::identity(); self.bodies.len()];
        for (j, joint) in self.joints.iter().enumerate() {
            let motion = joint.kind.map_or(Transform::identity(), |kind| moved(joint, kind, value(j)));
            poses[joint.child] = poses[joint.parent] * (joint.origin * motion);
        }
        let mut graph = Graph::new(&symbols, &[]);
        let mut results: Vec<(String, Value)> = vec![];
        for &body in bodies {
            for (k, e) in poses[body].matrix().concat().into_iter().enumerate() {
                results.push((format!("t{body}_{}{}", k / 4 + 1, k % 4 + 1), graph.trace(e)));
            }
        }
        let taken: FxHashSet<String> = symbols.iter().map(|s| s.name().to_string()).collect();
        Program::new(&graph, &results, |_| None, &taken)
    }
}
