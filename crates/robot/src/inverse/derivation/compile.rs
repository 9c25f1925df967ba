//! The steps of a derivation as a solver.

use super::algebra::Kind;
use super::chain::{Difference, Element, Motion, NormalChain};
use super::drivers::Lattice;
use super::equations::{Goal, Split};
use super::inputs::{Inputs, moved_pose};
use super::known::Unknown;
use super::naming::names;
use super::plan::{Determinant, Form, Norm, Row, Step};
use super::rounding;
use super::sign::{Sign, determinant_sign};
use super::terms::{outermost, split, square_root};
use crate::geometry::Transform;
use crate::inverse::branch::Label;
use denavit_program::solver::{Draft, Output, Root, Solver, SolverBuilder};
use denavit_program::{Op, Stage, Value};
use denavit_symbolic::poly::{Atom, Poly};
use denavit_symbolic::{Rational, Symbol};
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::VecDeque;

/// A compiled derivation.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// The solver.
    pub solver: Solver,
    /// Its inputs.
    pub inputs: Inputs,
}

/// Compiles the steps of a complete search.
pub fn compile(
    chain: &NormalChain,
    steps: &[Step],
    splits: &[Split],
    goal: Goal,
    given: &[usize],
    labels: &[Option<Label>],
) -> Compiled {
    let options = Options { splits: Some(splits), is_rounding: false };
    compile_with(chain, steps, &options, goal, given, labels)
}

/// The solver of a model that keeps every branch: its residual is 0.
pub fn without_residual(model: &super::model::InverseModel) -> Solver {
    with(model, &Options { splits: None, is_rounding: false })
}

/// The solver of a model that takes rounded rotations for those that are nearest to them.
pub fn rounding(model: &super::model::InverseModel) -> Solver {
    with(model, &Options { splits: Some(&model.whole), is_rounding: true })
}

fn with(model: &super::model::InverseModel, options: &Options) -> Solver {
    compile_with(&model.chain, &model.steps, options, model.goal, &model.given, &model.labels).solver
}

/// What is computed beside the steps.
struct Options<'a> {
    /// Where the residual is looked for; without, it is 0.
    splits: Option<&'a [Split]>,
    /// Whether rotations may be rounded.
    is_rounding: bool,
}

fn compile_with(
    chain: &NormalChain,
    steps: &[Step],
    options: &Options,
    goal: Goal,
    given: &[usize],
    labels: &[Option<Label>],
) -> Compiled {
    let inputs = Inputs::new(chain, goal, given);
    let names = names(chain, steps, &inputs);
    let results: Vec<Symbol> = names.iter().flatten().copied().collect();
    let mut builder = Builder {
        chain,
        solver: SolverBuilder::new(&inputs.symbols(), &chain.parameters, &results),
        atoms: FxHashMap::default(),
        ranks: vec![0; chain.algebra.atoms()],
        edges: vec![vec![]; chain.groups.len()],
        learnt: Lattice::default(),
        angles: vec![],
        forms: vec![],
        pairs: FxHashMap::default(),
        polys: FxHashMap::default(),
    };
    if options.is_rounding {
        rounding::nearest(&mut builder.solver, &inputs);
    }
    let moved = moved_pose(chain, &inputs);
    for (k, e) in moved.iter().enumerate() {
        if let Some(e) = e {
            let v = builder.solver.trace(*e);
            builder.atoms.insert(k as Atom, v);
            builder.ranks[k] = 1;
        }
    }
    for k in chain.axes_of(given) {
        builder.give(k);
    }
    let size = builder.size(goal);
    for (i, step) in steps.iter().enumerate() {
        let label = labels.get(i).copied().flatten();
        builder.step(i, step, &names[i], label);
    }
    let residual = match options.splits {
        Some(splits) => builder.residual(splits, goal, size),
        None => builder.number(0),
    };
    let outputs: Vec<Output> = (0..chain.variables.len()).map(|j| builder.output(j, given)).collect();
    Compiled { solver: builder.solver.finish(&outputs, residual, size), inputs }
}

struct Builder<'a> {
    chain: &'a NormalChain,
    solver: SolverBuilder,
    /// Values of atoms other than sines and cosines.
    atoms: FxHashMap<Atom, Value>,
    /// When each atom became known: 0 for constants, 1 for the pose, later steps more.
    ranks: Vec<usize>,
    /// For each group the angles that are known, from node to node.
    edges: Vec<Vec<(usize, usize, Value, Value)>>,
    /// Those that were found, with their cosines and sines, if axes follow others.
    learnt: Lattice,
    angles: Vec<(Value, Value)>,
    forms: Vec<Vec<i64>>,
    pairs: FxHashMap<(usize, usize, usize), (Value, Value)>,
    polys: FxHashMap<Poly, Value>,
}

impl Builder<'_> {
    /// The value of a given axis.
    fn give(&mut self, k: usize) {
        let value = self.chain.axes[k].value;
        match self.chain.axes[k].motion {
            Motion::Slide => {
                // What follows another is known with that.
                let Some(atom) = self.chain.algebra.find(Kind::Slide(k)) else { return };
                let v = self.solver.trace(value);
                self.atoms.insert(atom, v);
                self.ranks[usize::from(atom)] = 2;
            }
            Motion::Turn { group, from, to, reversed } => {
                let (s, c) = value.sin_cos();
                let (c, s) = (self.solver.trace(c), self.solver.trace(s));
                self.learn(Difference { group, from, to }, (c, if reversed { -s } else { s }));
                self.rank(2);
            }
        }
    }

    /// Cosine and sine of an angle are known from here on, and those of what follows it.
    fn learn(&mut self, d: Difference, pair: (Value, Value)) {
        self.edges[d.group].push((d.from, d.to, pair.0, pair.1));
        if !self.chain.has_followers() {
            return;
        }
        self.learnt.add(&self.chain.form(d));
        self.angles.push(pair);
        self.forms.push(self.chain.form(d));
        for (&d, form) in self.chain.differences.iter().zip(&self.chain.forms) {
            if self.path(d.group, d.from, d.to).is_none()
                && let Some(made) = self.learnt.made(form)
            {
                let (c, s) = self.multiples(&made, &self.angles.clone());
                self.edges[d.group].push((d.from, d.to, c, s));
            }
        }
    }

    /// Cosine and sine of a sum of whole multiples of angles.
    fn multiples(&mut self, factors: &[i64], angles: &[(Value, Value)]) -> (Value, Value) {
        let mut sum: Option<(Value, Value)> = None;
        for (factor, &(c, s)) in factors.iter().zip(angles) {
            let s = if *factor < 0 { -s } else { s };
            for _ in 0..factor.unsigned_abs() {
                sum = Some(sum.map_or((c, s), |before| self.added(before, (c, s))));
            }
        }
        sum.unwrap_or_else(|| (self.number(1), self.number(0)))
    }

    /// How far angles are from what the axes that drive make of them, where the pose told more than are independent.
    fn contradictions(&mut self) -> Vec<Value> {
        if self.forms.len() <= self.learnt.rank() {
            return vec![];
        }
        let drivers: Vec<(Value, Value)> = (0..self.chain.drivers.axes.len())
            .map(|i| match self.chain.axes[self.chain.drivers.axes[i]].motion {
                Motion::Slide => (self.number(1), self.number(0)),
                Motion::Turn { group, from, to, .. } => {
                    let (c, s) = self.pair(group, from, to);
                    let is_opposite = self.chain.form(Difference { group, from, to })[i] < 0;
                    (c, if is_opposite { -s } else { s })
                }
            })
            .collect();
        let mut found = vec![];
        for (form, (c, s)) in self.forms.clone().into_iter().zip(self.angles.clone()) {
            let (made_c, made_s) = self.multiples(&form, &drivers);
            found.extend([self.solver.graph.sub(c, made_c), self.solver.graph.sub(s, made_s)]);
        }
        found
    }

    /// Sines and cosines that can be composed now, and could not before, get a rank.
    fn rank(&mut self, rank: usize) {
        for n in 0..self.chain.differences.len() {
            let d = self.chain.differences[n];
            if self.path(d.group, d.from, d.to).is_some() {
                for kind in [Kind::Cos(n), Kind::Sin(n)] {
                    let Some(a) = self.chain.algebra.find(kind) else { continue };
                    let r = &mut self.ranks[usize::from(a)];
                    if *r == 0 {
                        *r = rank;
                    }
                }
            }
        }
    }

    /// The shortest way from node to node over known angles.
    fn path(&self, group: usize, from: usize, to: usize) -> Option<Vec<(usize, bool)>> {
        let mut reached: FxHashMap<usize, Vec<(usize, bool)>> = FxHashMap::default();
        reached.insert(from, vec![]);
        let mut pending = VecDeque::from([from]);
        while let Some(at) = pending.pop_front() {
            if at == to {
                return reached.remove(&to);
            }
            for (e, &(a, b, ..)) in self.edges[group].iter().enumerate() {
                for (start, end, backwards) in [(a, b, false), (b, a, true)] {
                    if start == at && !reached.contains_key(&end) {
                        let mut way = reached[&at].clone();
                        way.push((e, backwards));
                        reached.insert(end, way);
                        pending.push_back(end);
                    }
                }
            }
        }
        None
    }

    /// Cosine and sine of φ_to − φ_from.
    fn pair(&mut self, group: usize, from: usize, to: usize) -> (Value, Value) {
        if let Some(&known) = self.pairs.get(&(group, from, to)) {
            return known;
        }
        let path = self.path(group, from, to).expect("the angle is known");
        let mut sum: Option<(Value, Value)> = None;
        for (e, backwards) in path {
            let (_, _, c, s) = self.edges[group][e];
            let s = if backwards { -s } else { s };
            sum = Some(match sum {
                None => (c, s),
                Some((c1, s1)) => self.added((c1, s1), (c, s)),
            });
        }
        let found = sum.unwrap_or_else(|| (self.number(1), self.number(0)));
        self.pairs.insert((group, from, to), found);
        found
    }

    fn added(&mut self, (c1, s1): (Value, Value), (c2, s2): (Value, Value)) -> (Value, Value) {
        let g = &mut self.solver.graph;
        let (cc, ss) = (g.mul(c1, c2), g.mul(s1, s2));
        let (sc, cs) = (g.mul(s1, c2), g.mul(c1, s2));
        (g.sub(cc, ss), g.add(sc, cs))
    }

    fn number(&mut self, n: i64) -> Value {
        self.solver.graph.number(&Rational::from(n))
    }

    fn atom(&mut self, a: Atom) -> Value {
        match self.chain.algebra.kind(a) {
            Kind::Cos(n) | Kind::Sin(n) => {
                let d = self.chain.differences[n];
                let (c, s) = self.pair(d.group, d.from, d.to);
                if matches!(self.chain.algebra.kind(a), Kind::Cos(_)) { c } else { s }
            }
            Kind::Constant(e) => self.solver.trace(e),
            Kind::Pose(_) | Kind::Slide(_) => self.atoms[&a],
        }
    }

    /// The value of a polynomial, what was found last taken out first: the nesting in which products of matrices share
    /// their parts.
    fn poly(&mut self, p: &Poly) -> Value {
        if let Some(&v) = self.polys.get(p) {
            return v;
        }
        let v = match outermost(p, |a| self.ranks[usize::from(a)]) {
            None => {
                let r = p.as_constant().unwrap_or(Rational::ZERO);
                self.solver.graph.number(&r)
            }
            Some(atom) => {
                let (inside, rest) = split(p, atom);
                let (x, inside, rest) = (self.atom(atom), self.poly(&inside), self.poly(&rest));
                let product = self.solver.graph.mul(x, inside);
                self.solver.graph.add(product, rest)
            }
        };
        self.polys.insert(p.clone(), v);
        v
    }

    fn norm(&mut self, n: &Norm) -> Value {
        let plus = self.poly(&n.plus);
        let squares = self.squares(&n.squares);
        self.solver.graph.add(squares, plus)
    }

    fn squares(&mut self, polys: &[Poly]) -> Value {
        let values: Vec<Value> = polys.iter().map(|p| self.poly(p)).collect();
        self.sum_of_squares(&values)
    }

    fn sum_of_squares(&mut self, values: &[Value]) -> Value {
        let mut sum = self.number(0);
        for &v in values {
            let square = self.solver.graph.mul(v, v);
            sum = self.solver.graph.add(sum, square);
        }
        sum
    }

    /// √(squared lengths of the chain's constants and tool + squared distance of the hand from the first axis's origin).
    fn size(&mut self, goal: Goal) -> Value {
        let mut lengths: Vec<Value> = vec![];
        for e in &self.chain.elements {
            if let Element::Constant(constant) = e {
                lengths.extend(constant.1.iter().map(|x| self.poly(x)));
            }
        }
        lengths.extend(self.chain.tool.translation.0.map(|e| self.solver.trace(e)));
        debug_assert!(goal == Goal::Pose || self.chain.tool == Transform::identity());
        lengths.extend([3, 7, 11].map(|k| self.atoms[&k]));
        let sum = self.sum_of_squares(&lengths);
        // Never 0, so that a quotient by it is a number.
        let tiny = self.solver.graph.number(&Rational::new(1, 1 << 62));
        let tiny = self.solver.graph.mul(tiny, tiny);
        let sum = self.solver.graph.add(sum, tiny);
        self.solver.graph.sqrt(sum)
    }

    fn step(&mut self, i: usize, step: &Step, names: &[Symbol], label: Option<Label>) {
        let mut guard = None;
        let mut degree = step.degree;
        let root = match &step.form {
            Form::Ratio { numerator, denominator } => {
                degree = step.degree.saturating_sub(1);
                Root::Ratio { numerator: self.poly(numerator), denominator: self.poly(denominator) }
            }
            Form::Quadratic { a, b, c } => {
                degree = step.degree.saturating_sub(2);
                Root::Quadratic { a: self.poly(a), b: self.poly(b), c: self.norm(c) }
            }
            Form::Line => {
                let (a, b) = (self.poly(&step.rows[0].a), self.poly(&step.rows[0].b));
                Root::Line { x: b, y: -a }
            }
            Form::Sincos => {
                let row = &step.rows[0];
                let (a, b, c) = (self.poly(&row.a), self.poly(&row.b), self.norm(&row.c));
                Root::Sincos { a, b, c, discriminant: self.discriminant(row) }
            }
            Form::Pair { determinant } => {
                let (root, found) = self.direction(step, *determinant);
                if let Some((v, d)) = found {
                    (guard, degree) = (Some(v), d);
                }
                root
            }
            Form::Quartic(all) => Root::Quartic {
                cc: self.norm(&all[0]),
                cs: self.norm(&all[1]),
                c: self.norm(&all[2]),
                s: self.norm(&all[3]),
                one: self.norm(&all[4]),
            },
        };
        self.solver.node(Draft {
            root,
            guard,
            degree,
            results: names.to_vec(),
            label: label.map(|l| l.to_string()),
        });
        let inputs: Vec<Value> = names.iter().map(|s| self.solver.graph.input(*s)).collect();
        match step.unknown {
            Unknown::Slide(k) => {
                let atom = self.chain.algebra.find(Kind::Slide(k)).expect("every slide has an atom");
                self.atoms.insert(atom, inputs[0]);
                self.ranks[usize::from(atom)] = 3 + i;
            }
            Unknown::Angle(d) => {
                self.learn(d, (inputs[0], inputs[1]));
                self.rank(3 + i);
            }
        }
    }

    /// Two equations in cosine and sine by Cramer's rule, and the guard with its dimension.
    fn direction(&mut self, step: &Step, determinant: Determinant) -> (Root<Value>, Option<(Value, u8)>) {
        let mut values = [[Value { node: 0, negative: false }; 3]; 2];
        for (row, v) in step.rows.iter().zip(&mut values) {
            *v = [self.poly(&row.a), self.poly(&row.b), self.norm(&row.c)];
        }
        let [[a1, b1, c1], [a2, b2, c2]] = values;
        let g = &mut self.solver.graph;
        let mut difference = |x: [Value; 2], y: [Value; 2]| {
            let (x, y) = (g.mul(x[0], x[1]), g.mul(y[0], y[1]));
            g.sub(x, y)
        };
        let (x, y) = (difference([c1, b2], [c2, b1]), difference([a1, c2], [a2, c1]));
        if determinant == Determinant::General {
            let d = difference([a1, b2], [a2, b1]);
            return (Root::Direction { x, y, sign: Some(d) }, Some((d, step.degree)));
        }
        // The sign of the determinant does not change from pose to pose; that of a parameter may decide it.
        let (r1, r2) = (&step.rows[0], &step.rows[1]);
        let (x, y, sign) = match determinant_sign(self.chain, r1, r2) {
            Sign::Fixed { is_negative: true } => (-x, -y, None),
            Sign::Fixed { is_negative: false } => (x, y, None),
            Sign::Of { poly, is_opposite } => {
                let v = self.poly(&poly);
                (x, y, Some(if is_opposite { -v } else { v }))
            }
        };
        let guard = (determinant == Determinant::Perpendicular).then(|| {
            let sum = self.sum_of_squares(&[c1, c2]);
            (self.solver.graph.sqrt(sum), r1.degree)
        });
        (Root::Direction { x, y, sign }, guard)
    }

    /// a² + b² − c² without cancellation, where c = D² − K and a, b, K are constants:
    /// (K + √N − D²)(D² − (K − √N)), and K − √N = M²/(K + √N) where K² − N = M².
    fn discriminant(&mut self, row: &Row) -> Option<Value> {
        if row.c.squares.is_empty() {
            return None;
        }
        let a = &self.chain.algebra;
        let constant = |p: &Poly| p.atoms().iter().all(|&x| matches!(a.kind(x), Kind::Constant(_)));
        let n = a.square(&row.a).plus(&a.square(&row.b));
        let root = if constant(&n) && constant(&row.c.plus) {
            let k = row.c.plus.scaled(&-Rational::ONE);
            square_root(a, &a.square(&k).minus(&n)).map(|m| (k, m))
        } else {
            None
        };
        let length = {
            let n = self.poly(&n);
            self.solver.graph.sqrt(n)
        };
        let distance = self.squares(&row.c.squares);
        let (first, second) = match root {
            Some((k, m)) => {
                let (k, m) = (self.poly(&k), self.poly(&m));
                let g = &mut self.solver.graph;
                let outer = g.add(k, length);
                let square = g.mul(m, m);
                let inner = g.div(square, outer);
                (g.sub(outer, distance), g.sub(distance, inner))
            }
            None => {
                let c = self.norm(&row.c);
                let g = &mut self.solver.graph;
                (g.sub(length, c), g.add(length, c))
            }
        };
        Some(self.solver.graph.mul(first, second))
    }

    /// How far the chain with these sines and cosines is from the pose: √(Σ(ΔR)² + Σ(Δp)²/size²), at the two cuts where
    /// that is computed with the fewest operations. Two columns of a rotation determine the third.
    fn residual(&mut self, splits: &[Split], goal: Goal, size: Value) -> Value {
        let columns: &[usize] = match goal {
            Goal::Pose => &[0, 1, 2],
            Goal::Position => &[],
            Goal::PositionAndAxis => &[2],
        };
        let keep = if goal == Goal::Pose { 2 } else { columns.len() };
        let mut best: Option<(u64, Vec<Value>, Vec<Value>)> = None;
        let spent = self.solver.walk();
        for split in splits {
            let Some(position) = self.differences_of(&split.pose, |i| &split.chain[i]) else { continue };
            let mut turned: Vec<(u64, Vec<Value>)> = vec![];
            for &j in columns {
                let column: [Option<Poly>; 3] = std::array::from_fn(|i| split.pose_rotation[i][j].clone());
                let Some(values) = self.differences_of(&column, |i| &split.chain_rotation[i][j]) else {
                    continue;
                };
                turned.push((self.cost(&spent, &values), values));
            }
            if turned.len() < keep {
                continue;
            }
            turned.sort_by_key(|t| t.0);
            let rotation: Vec<Value> = turned.into_iter().take(keep).flat_map(|t| t.1).collect();
            let all: Vec<Value> = rotation.iter().chain(&position).copied().collect();
            let cost = self.cost(&spent, &all);
            if best.as_ref().is_none_or(|b| cost < b.0) {
                best = Some((cost, rotation, position));
            }
        }
        let (_, mut rotation, position) = best.expect("both sides are formed at the ends of the chain");
        rotation.extend(self.contradictions());
        let (rotation, position) = (self.sum_of_squares(&rotation), self.sum_of_squares(&position));
        let g = &mut self.solver.graph;
        let area = g.mul(size, size);
        let relative = g.div(position, area);
        let sum = g.add(rotation, relative);
        g.sqrt(sum)
    }

    fn cost(&self, spent: &FxHashSet<u32>, values: &[Value]) -> u64 {
        let g = &self.solver.graph;
        let new = g.reach(values).into_iter().filter(|n| !spent.contains(n));
        new.filter(|&n| g.stage(n) == Stage::Variable && !matches!(g.op(n), Op::Input(_))).count() as u64
    }

    /// pose − chain, if the side of the pose is there.
    fn differences_of<'p>(
        &mut self,
        pose: &[Option<Poly>; 3],
        chain: impl Fn(usize) -> &'p Poly,
    ) -> Option<Vec<Value>> {
        let mut found = vec![];
        for (i, p) in pose.iter().enumerate() {
            let p = p.as_ref()?;
            let (x, y) = (self.poly(p), self.poly(chain(i)));
            found.push(self.solver.graph.sub(x, y));
        }
        Some(found)
    }

    /// A joint variable by the angles and displacements of the rows.
    fn output(&mut self, j: usize, given: &[usize]) -> Output {
        let name = self.chain.variables[j].name().to_string();
        if given.contains(&j) {
            let value = self.solver.graph.input(self.chain.variables[j]);
            return Output { name, value, is_angle: self.chain.goes_round[j] };
        }
        let factors = self.chain.drivers.inverse[j].clone();
        if !self.chain.is_angle(j) {
            let mut sum = self.number(0);
            for (k, m) in factors {
                let atom = self.chain.algebra.find(Kind::Slide(k)).expect("every slide has an atom");
                let factor = self.solver.graph.number(&m);
                let offset = self.solver.trace(self.chain.axes[k].form.offset);
                let x = self.atoms[&atom];
                let x = self.solver.graph.sub(x, offset);
                let x = self.solver.graph.mul(factor, x);
                sum = self.solver.graph.add(sum, x);
            }
            return Output { name, value: sum, is_angle: false };
        }
        // Whole multiples of angles are added as cosines and sines, so that the sum is in (−π, π]: if a whole turn of the
        // joint changes nothing.
        let whole = self.chain.goes_round[j] && factors.iter().all(|f| f.1.is_integer());
        let mut angle: Option<(Value, Value)> = None;
        let mut plain = self.number(0);
        for (k, m) in factors {
            let Motion::Turn { group, from, to, reversed } = self.chain.axes[k].motion else { continue };
            let (c, s) = self.pair(group, from, to);
            let s = if reversed { -s } else { s };
            let offset = self.chain.axes[k].form.offset;
            let (os, oc) = offset.sin_cos();
            let (oc, os) = (self.solver.trace(oc), self.solver.trace(os));
            let (c, s) = self.added((c, s), (oc, -os));
            if whole {
                let n = m.to_integer().unwrap_or(0);
                let s = if n < 0 { -s } else { s };
                for _ in 0..n.unsigned_abs() {
                    angle = Some(match angle {
                        None => (c, s),
                        Some(sum) => self.added(sum, (c, s)),
                    });
                }
            } else {
                let factor = self.solver.graph.number(&m);
                let theta = self.solver.graph.atan2(s, c);
                let term = self.solver.graph.mul(factor, theta);
                plain = self.solver.graph.add(plain, term);
            }
        }
        let value = match angle {
            Some((c, s)) => self.solver.graph.atan2(s, c),
            None => plain,
        };
        Output { name, value, is_angle: self.chain.goes_round[j] }
    }
}
