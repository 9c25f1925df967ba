//! Where an equation comes from: which matrices are moved, and which element of the two sides it is.

use super::reading::{Reading, negated};
use crate::document::Factor;
use crate::explained::Component;
use denavit::description::Convention;
use denavit::geometry::Rotation;
use denavit::inverse::derivation::{Element, Entry, Kind, Motion, NormalChain, Source, Split, Unknown};
use denavit_symbolic::poly::Poly;
use denavit_symbolic::{Expr, Rational};
use std::ops::Range;

/// The chain as a product of matrices A1, A2, …, one a joint.
pub struct Matrices<'a> {
    reading: &'a Reading<'a>,
    splits: &'a [Split],
    /// The elements of each matrix.
    pub groups: Vec<Range<usize>>,
}

/// An element of both sides of a product.
pub struct Cut {
    /// The first element of the middle part.
    pub left: usize,
    /// The element behind it.
    pub right: usize,
    /// The rows that are used, from 0.
    pub rows: Vec<usize>,
    /// The column, from 0.
    pub column: usize,
    /// Whether the inverse of both sides is meant.
    pub inverse: bool,
    /// The sides, pose first, for each row.
    pub sides: Vec<(Poly, Poly)>,
}

impl<'a> Matrices<'a> {
    /// Each axis with the constants before it or behind it, as the convention has them.
    pub fn new(reading: &'a Reading<'a>, splits: &'a [Split], convention: Convention) -> Self {
        let elements = &reading.chain.elements;
        let axes: Vec<usize> =
            (0..elements.len()).filter(|&e| matches!(elements[e], Element::Axis(_))).collect();
        let behind = convention == Convention::Standard;
        let groups = (0..axes.len())
            .map(|k| match (behind, axes.get(k + 1)) {
                (true, next) => axes[k]..next.copied().unwrap_or(elements.len()),
                (false, None) => start(&axes, k)..elements.len(),
                (false, Some(_)) => start(&axes, k)..axes[k] + 1,
            })
            .collect();
        Matrices { reading, splits, groups }
    }

    fn chain(&self) -> &'a NormalChain {
        self.reading.chain
    }

    /// An element as a matrix.
    fn element(&self, e: usize) -> Factor {
        match &self.chain().elements[e] {
            Element::Axis(k) => {
                let axis = &self.chain().axes[*k];
                match axis.motion {
                    Motion::Turn { .. } => Factor::Rotation('z', axis.value),
                    Motion::Slide => Factor::Translation([Expr::int(0), Expr::int(0), axis.value]),
                }
            }
            Element::Constant(..) => Factor::Constant(vec![]),
        }
    }

    /// An element written out: displacement, then rotation.
    pub fn written(&self, e: usize) -> Vec<Factor> {
        let Element::Constant(constant) = &self.chain().elements[e] else { return vec![self.element(e)] };
        let (r, p) = &**constant;
        let p = p.each_ref().map(|x| self.reading.plain(x));
        let mut found = vec![];
        if p.iter().any(|x| !x.is_zero()) {
            found.push(Factor::Translation(p));
        }
        let r = r.each_ref().map(|row| row.each_ref().map(|x| self.reading.plain(x)));
        match elementary(&r) {
            Some(mut factors) => found.append(&mut factors),
            None => {
                let zero = Expr::int(0);
                found.push(Factor::Constant(
                    r.iter().map(|row| row.iter().copied().chain([zero]).collect()).collect(),
                ));
            }
        }
        found
    }

    /// The matrices of some elements: whole ones by name.
    fn product(&self, range: Range<usize>, inverse: bool) -> Vec<Factor> {
        let mut found = vec![];
        let mut at = range.start;
        while at < range.end {
            match self.groups.iter().position(|g| g.start == at && g.end <= range.end) {
                Some(k) => {
                    let of = inverse.then(|| self.chain().axes[k].value);
                    found.push(Factor::Named { letter: "A", number: Some(k + 1), of, inverse: false });
                    at = self.groups[k].end;
                }
                None => {
                    found.extend(self.written(at));
                    at += 1;
                }
            }
        }
        if inverse {
            found.reverse();
            found = found.into_iter().map(Factor::inverse).collect();
        }
        found
    }

    /// Both sides of the product at two cuts.
    pub fn sides(&self, cut: &Cut) -> (Vec<Factor>, Vec<Factor>) {
        let n = self.chain().elements.len();
        let mut left = self.product(0..cut.left, true);
        left.push(Factor::named("U"));
        left.extend(self.product(cut.right..n, true));
        let mut right = self.product(cut.left..cut.right, false);
        if right.is_empty() {
            right.push(Factor::named("1"));
        }
        (left, right)
    }

    /// How many matrices stand on the side of the pose, those that are taken apart first.
    fn price(&self, left: usize, right: usize) -> (usize, usize) {
        let inside = |e: usize| self.groups.iter().any(|g| g.start < e && e < g.end);
        let apart = usize::from(inside(left)) + usize::from(inside(right));
        let axes =
            |r: Range<usize>| self.groups.iter().filter(|g| g.start < r.end && r.start < g.end).count();
        (apart, axes(0..left) + axes(right..self.chain().elements.len()))
    }

    /// The two sides of an equation, at the cuts where that reads best.
    pub fn entry(&self, source: Source) -> Option<Cut> {
        let (pose, chain) = self.found(source)?;
        let zero = pose.minus(&chain);
        let minus = negated(&zero);
        let (row, column, inverse) = match source.entry {
            Entry::Rotation(i, j) => (i, j, false),
            Entry::Position(i) => (i, 3, false),
            Entry::Inverse(i) => (i, 3, true),
        };
        let mut best = Cut {
            left: source.left,
            right: source.right,
            rows: vec![row],
            column,
            inverse,
            sides: vec![(pose, chain)],
        };
        let mut price = self.price(best.left, best.right);
        for split in self.splits {
            let here = self.price(split.left, split.right);
            if here >= price {
                continue;
            }
            for i in 0..3 {
                for j in 0..4 {
                    let (pose, chain) = match j {
                        3 => (&split.pose[i], &split.chain[i]),
                        _ => (&split.pose_rotation[i][j], &split.chain_rotation[i][j]),
                    };
                    let Some(pose) = pose else { continue };
                    let difference = pose.minus(chain);
                    if here < price && (difference == zero || difference == minus) {
                        price = here;
                        let sides = vec![(pose.clone(), chain.clone())];
                        best = Cut {
                            left: split.left,
                            right: split.right,
                            rows: vec![i],
                            column: j,
                            inverse: false,
                            sides,
                        };
                    }
                }
            }
        }
        best.sides = best.sides.into_iter().map(|s| self.settled(s)).collect();
        Some(best)
    }

    /// The position components whose squares are added, at the cuts where that reads best.
    pub fn squares(&self, left: usize, right: usize, components: &[usize]) -> Option<Cut> {
        let here = self.splits.iter().find(|s| s.left == left && s.right == right)?;
        let zero = |s: &Split, k: usize| Some(s.pose[k].as_ref()?.minus(&s.chain[k]));
        let wanted: Option<Vec<Poly>> = components.iter().map(|&k| zero(here, k)).collect();
        let wanted = wanted?;
        let mut best = (self.price(left, right), here, components.to_vec());
        for split in self.splits {
            let price = self.price(split.left, split.right);
            if price >= best.0 {
                continue;
            }
            let zeros: Vec<Option<Poly>> = (0..3).map(|k| zero(split, k)).collect();
            let place =
                |w: &Poly| zeros.iter().position(|z| z.as_ref().is_some_and(|z| z == w || *z == negated(w)));
            let places: Option<Vec<usize>> = wanted.iter().map(place).collect();
            if let Some(mut places) = places {
                places.sort_unstable();
                best = (price, split, places);
            }
        }
        let (_, split, rows) = best;
        let sides: Option<Vec<(Poly, Poly)>> =
            rows.iter().map(|&k| Some((split.pose[k].clone()?, split.chain[k].clone()))).collect();
        Some(Cut { left: split.left, right: split.right, rows, column: 3, inverse: false, sides: sides? })
    }

    /// The two sides of an element.
    fn found(&self, source: Source) -> Option<(Poly, Poly)> {
        let at = |left| self.splits.iter().find(|s| s.left == left && s.right == source.right);
        let split = at(source.left)?;
        match source.entry {
            Entry::Rotation(i, j) => {
                Some((split.pose_rotation[i][j].clone()?, split.chain_rotation[i][j].clone()))
            }
            Entry::Position(i) => Some((split.pose[i].clone()?, split.chain[i].clone())),
            Entry::Inverse(i) => {
                // −Rᵀp on both sides, the side of the pose before it is turned.
                let a = &self.chain().algebra;
                let whole = at(0)?;
                let shift = &self.chain().products_from(0)[source.left].1;
                let (mut pose, mut chain) = (Poly::zero(), Poly::zero());
                for (k, shift) in shift.iter().enumerate() {
                    let moved = whole.pose[k].as_ref()?.minus(shift);
                    pose = pose.minus(&a.times(whole.pose_rotation[k][i].as_ref()?, &moved));
                    chain = chain.minus(&a.times(&split.chain_rotation[k][i], &split.chain[k]));
                }
                Some((pose, chain))
            }
        }
    }

    /// Both sides negated if that leaves fewer signs.
    fn settled(&self, (pose, chain): (Poly, Poly)) -> (Poly, Poly) {
        let negative = |p: &Poly| p.terms().iter().filter(|t| t.1.is_negative()).count();
        let (n, all) = (negative(&pose) + negative(&chain), pose.terms().len() + chain.terms().len());
        if 2 * n > all || 2 * n == all && negative(&chain) > 0 && chain.terms().len() == 1 {
            (negated(&pose), negated(&chain))
        } else {
            (pose, chain)
        }
    }

    /// Why few joints occur in an element: turning about an axis changes no component along it; a joint whose axis
    /// passes through a point does not move it.
    pub fn why_short(&self, cut: &Cut) -> Option<Component> {
        let chain = self.chain();
        let middle: Vec<usize> = chain.elements[cut.left..cut.right]
            .iter()
            .filter_map(|e| if let Element::Axis(k) = e { Some(*k) } else { None })
            .collect();
        let occurs = |k: usize| {
            cut.sides.iter().any(|(_, c)| {
                c.atoms().into_iter().any(|a| match chain.algebra.kind(a) {
                    Kind::Slide(s) => chain.moves_with(k, Unknown::Slide(s)),
                    Kind::Cos(n) | Kind::Sin(n) => chain.moves_with(k, Unknown::Angle(chain.differences[n])),
                    _ => false,
                })
            })
        };
        let group = |k: usize| match chain.axes[k].motion {
            Motion::Turn { group, .. } => Some(group),
            Motion::Slide => None,
        };
        if cut.rows.len() > 1 || cut.inverse {
            return None;
        }
        let first = middle.first().and_then(|&k| group(k));
        let last = middle.last().and_then(|&k| group(k));
        let absent = |g: Option<usize>| -> Vec<usize> {
            let of = middle.iter().copied().filter(|&k| g.is_some() && group(k) == g && !occurs(k));
            of.collect()
        };
        // The axis along which the component is taken; those of what it is a component of.
        let front = absent(first);
        let mut of = vec![];
        if cut.column == 2 {
            of = absent(last).into_iter().filter(|k| !front.contains(k)).collect();
        } else if cut.column == 3 {
            let still = |k: usize| !occurs(k) && !front.contains(&k) && chain.axes[k].motion != Motion::Slide;
            of = middle.iter().copied().rev().take_while(|&k| still(k)).collect();
            of.reverse();
        }
        let mut free: Vec<usize> = front.iter().chain(&of).copied().collect();
        free.sort_unstable();
        (!free.is_empty()).then_some(Component { along: front, of, is_point: cut.column == 3, free })
    }
}

fn start(axes: &[usize], k: usize) -> usize {
    if k == 0 { 0 } else { axes[k - 1] + 1 }
}

/// A constant rotation as turns about axes, if it is that simple.
pub fn elementary(r: &[[Expr; 3]; 3]) -> Option<Vec<Factor>> {
    let turn = |axis: char| -> Option<(Expr, Expr)> {
        let k = "xyz".find(axis)?;
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let straight = r[k][k].is_one() && [i, j].iter().all(|&m| r[k][m].is_zero() && r[m][k].is_zero());
        straight.then_some((r[i][i], r[j][i]))
    };
    if r.iter().enumerate().all(|(i, row)| row[i].is_one()) {
        return Some(vec![]);
    }
    for axis in ['x', 'y', 'z'] {
        if let Some((c, s)) = turn(axis) {
            return Some(vec![Factor::Rotation(axis, angle(c, s)?)]);
        }
    }
    // Quarter turns: one about z, then one about x, then one about z.
    let quarters = [0, 1, 2, -1].map(|n| Expr::from(Rational::new(n, 2)) * Expr::pi());
    for a in quarters {
        for b in quarters {
            for c in quarters {
                let product = Rotation::about_z(a) * Rotation::about_x(b) * Rotation::about_z(c);
                if product.rows() == *r {
                    let all = [('z', a), ('x', b), ('z', c)];
                    return Some(
                        all.into_iter()
                            .filter(|f| !f.1.is_zero())
                            .map(|(k, e)| Factor::Rotation(k, e))
                            .collect(),
                    );
                }
            }
        }
    }
    None
}

/// The angle with a cosine and a sine.
fn angle(c: Expr, s: Expr) -> Option<Expr> {
    let twelfths = (-11..=12).map(|n| Expr::from(Rational::new(n, 12)) * Expr::pi());
    twelfths.into_iter().find(|x| (x.cos(), x.sin()) == (c, s)).or_else(|| {
        // cos α, sin α of a parameter or another constant angle
        match (c.node(), s.node()) {
            (denavit_symbolic::Node::Cos(x), denavit_symbolic::Node::Sin(y)) if x == y => Some(x),
            (denavit_symbolic::Node::Cos(x), denavit_symbolic::Node::Neg(s)) if matches!(s.node(), denavit_symbolic::Node::Sin(y) if x == y) => Some(-x),
            _ => None,
        }
    })
}
