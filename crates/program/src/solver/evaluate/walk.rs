//! The careful evaluator: depth first through all branches, the cases of every root told apart.

use super::leaves::{Leaves, Record};
use super::single::Single;
use super::{Shape, SolverFunction, lanes};
use crate::evaluate::Scalar;
use crate::solver::roots::{Roots, magnified, power, roots};
use crate::solver::{BESIDE, CANDIDATE};
use std::sync::Arc;

/// What a branch misses by as many times the error of its roots, it may miss for rounding alone.
const GROWTH: f64 = 64.0;

/// A way through all branches, for levels that are computed by anybody. It allocates nothing after it is made.
#[derive(Clone, Debug)]
pub struct Walk {
    shape: Arc<Shape>,
    /// The registers of the solver.
    registers: Vec<f64>,
    /// sizeᵈᵉᵍʳᵉᵉ of each node.
    scales: Vec<f64>,
    /// The roots of each node on the way, and how many of them have been visited.
    found: Vec<(Roots, usize)>,
    /// The relative errors of these, as far as rounding makes them.
    errors: Vec<f64>,
    signs: Vec<i8>,
    leaves: Leaves,
    looseness: f64,
    /// The largest guard of each node on the last walk.
    largest: Vec<f64>,
}

impl Walk {
    /// A walk through the nodes of a solver.
    pub fn new(solver: &SolverFunction) -> Self {
        let shape = solver.shape.clone();
        let n = shape.steps.len();
        Walk {
            registers: vec![0.0; shape.registers],
            scales: vec![1.0; n],
            found: vec![(Roots::NONE, 0); n],
            errors: vec![0.0; n],
            signs: vec![0; n],
            leaves: shape.leaves(),
            looseness: 1.0,
            largest: vec![0.0; n],
            shape,
        }
    }

    /// Guards count as vanished up to `looseness` times what rounding leaves, from the next call on: for variables that
    /// are known less well, or that made an earlier root coincide.
    pub(crate) fn set_looseness(&mut self, looseness: f64) {
        self.looseness = looseness;
    }

    /// Visits all branches. `level` is called with the number of a level and the registers, and must write those that
    /// the level writes ([`Level`](crate::solver::Level)); `given` is as for [`SolverScalar::solve`].
    ///
    /// # Panics
    /// If there is not one value per variable.
    pub fn solve(
        &mut self,
        variables: &[f64],
        given: &[Option<[f64; 2]>],
        mut level: impl FnMut(usize, &mut [f64]),
    ) -> &Leaves {
        let Walk { shape, registers, scales, found, errors, signs, leaves, looseness, largest } = self;
        assert_eq!(variables.len(), shape.variables, "one value per variable");
        let last = shape.steps.len();
        leaves.clear();
        registers[..variables.len()].copy_from_slice(variables);
        level(0, registers);
        let size = registers[shape.size as usize].abs();
        for (scale, step) in scales.iter_mut().zip(&shape.steps) {
            // What rounding leaves does not depend on what is usual.
            let loosened = (*looseness * step.usual).max(1.0);
            *scale = power(size, step.degree) * loosened;
        }
        largest.fill(0.0);
        let mut i = 0;
        let mut is_new = true;
        loop {
            if i == last {
                let error = errors.last().copied().unwrap_or_default();
                leaf(shape, registers, found, error, signs, leaves);
            } else {
                let step = &shape.steps[i];
                let error = if i == 0 { f64::EPSILON } else { errors[i - 1] };
                if is_new {
                    let at = |r: u32| registers[r as usize];
                    let given = given.get(i).copied().flatten();
                    let all = roots(&step.root.map(at), step.guard.map(at), (scales[i], size), given);
                    if all.count == 0 {
                        let earlier = found[..i].iter().map(|f| f.0.guard);
                        let guards = earlier.chain([all.guard]).zip(&shape.steps).map(|(g, s)| g / s.usual);
                        let guard = guards.fold(f64::INFINITY, f64::min);
                        leaves.end(i, all.gap, if all.gap <= GROWTH * error { 0.0 } else { guard });
                    }
                    leaves.miss(if all.missed <= GROWTH * error { 0.0 } else { all.missed });
                    if all.is_free {
                        leaves.meet_free(i);
                    }
                    if all.guard.is_finite() {
                        largest[i] = largest[i].max(all.guard);
                    }
                    found[i] = (all, 0);
                }
                let (all, visited) = &mut found[i];
                if *visited < all.count {
                    let k = *visited;
                    *visited += 1;
                    // A smaller guard is said by itself.
                    let by = all.magnified[k] / all.guard.max(BESIDE * step.usual).min(1.0);
                    // What is free is given exactly.
                    errors[i] = if all.is_free { error } else { magnified(&step.root, error, by) };
                    signs[i] = all.signs[k];
                    let [first, second] = all.values[k];
                    let results = [first, if step.root.is_angle() { second } else { f64::from(signs[i]) }];
                    for (x, r) in results.iter().chain([&f64::from(signs[i])]).zip(step.results.clone()) {
                        registers[r] = *x;
                    }
                    i += 1;
                    level(i, registers);
                    is_new = true;
                    continue;
                }
            }
            if i == 0 {
                return leaves;
            }
            i -= 1;
            is_new = false;
        }
    }
}

fn leaf(
    shape: &Shape,
    registers: &[f64],
    found: &[(Roots, usize)],
    error: f64,
    signs: &[i8],
    leaves: &mut Leaves,
) {
    let at = |r: &u32| registers[*r as usize];
    let mut record = Record { residual: at(&shape.residual), multiplicity: 1, free: 0, guard: f64::INFINITY };
    for (i, (all, visited)) in found.iter().enumerate() {
        record.multiplicity = record.multiplicity.saturating_mul(all.multiplicities[visited - 1]);
        record.free |= u64::from(all.is_free) << i;
        record.guard = record.guard.min(all.guard / shape.steps[i].usual);
    }
    if record.residual > CANDIDATE && record.residual <= GROWTH * error {
        record.guard = 0.0;
    }
    leaves.add(shape.outputs.iter().map(at), signs, record);
}

/// Runs a [`SolverFunction`] for one set of variables after another. It allocates nothing after it is made.
#[derive(Clone, Debug)]
pub struct SolverScalar {
    fast: Option<Single>,
    walk: Walk,
    levels: Vec<Scalar>,
    /// What a level reads, gathered.
    gathered: Vec<f64>,
}

impl SolverScalar {
    pub(crate) fn new(solver: &SolverFunction) -> Self {
        let levels = solver.levels.iter().map(|f| f.scalar()).collect();
        let most = solver.shape.places.iter().map(|p| p.reads.len()).max().unwrap_or(0);
        let fast = lanes::is_possible(&solver.shape).then(|| Single::new(solver));
        SolverScalar { fast, walk: Walk::new(solver), levels, gathered: vec![0.0; most] }
    }

    /// All solutions for one set of variables; they stay readable until the next call.
    ///
    /// `given` says what an unknown takes that turns out to be free: for each node cosine and sine, or the value and
    /// anything; nodes that are missing take (1, 0) or 0.
    ///
    /// # Panics
    /// If there is not one value per variable.
    pub fn solve(&mut self, variables: &[f64], given: &[Option<[f64; 2]>]) -> &Leaves {
        assert_eq!(variables.len(), self.walk.shape.variables, "one value per variable");
        if let Some(fast) = &mut self.fast
            && fast.solve(variables, &mut self.walk.leaves)
        {
            return &self.walk.leaves;
        }
        self.solve_carefully(variables, given)
    }

    /// As [`SolverScalar::solve_carefully`], with guards that count as vanished up to `looseness` times what rounding
    /// leaves.
    ///
    /// # Panics
    /// If there is not one value per variable.
    pub fn solve_loosely(
        &mut self,
        variables: &[f64],
        given: &[Option<[f64; 2]>],
        looseness: f64,
    ) -> &Leaves {
        self.walk.set_looseness(looseness);
        self.solve_carefully(variables, given);
        self.walk.set_looseness(1.0);
        &self.walk.leaves
    }

    /// The largest guard of each node on any branch for one set of variables, relative to sizeᵈᵉᵍʳᵉᵉ.
    pub(crate) fn largest_guards(&mut self, variables: &[f64]) -> Vec<f64> {
        self.solve_carefully(variables, &[]);
        self.walk.largest.clone()
    }

    /// The same, one branch after the other.
    ///
    /// # Panics
    /// If there is not one value per variable.
    pub fn solve_carefully(&mut self, variables: &[f64], given: &[Option<[f64; 2]>]) -> &Leaves {
        let SolverScalar { walk, levels, gathered, .. } = self;
        let shape = walk.shape.clone();
        walk.solve(variables, given, |i, registers| {
            let places = &shape.places[i];
            let values = &mut gathered[..places.reads.len()];
            for (x, &r) in values.iter_mut().zip(&places.reads) {
                *x = registers[r as usize];
            }
            for (x, &r) in levels[i].eval(values).iter().zip(&places.writes) {
                registers[r as usize] = *x;
            }
        })
    }
}
