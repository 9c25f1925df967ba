//! Whether a search can end with all unknowns: a test in numbers before anything is multiplied.
//!
//! The search finds unknowns from equations that hold two independent ones at most. How many an equation holds is the rank
//! of its derivatives by the axes at some configurations, the entries of the pose held: never more than of the unknowns
//! that its polynomial shows. Here every equation with one unknown counts as solved, and so do any two with the same two
//! unknowns; what cannot be found even so is not found by the search.
//!
//! Of a redundant arm the joints that are given are chosen, and six turns that are left have a closed form where three
//! neighbours meet or are parallel (D. L. Pieper, *The Kinematics of Manipulators under Computer Control*, 1968).

use super::algebra::Algebra;
use super::chain::{Element, Motion, NormalChain};
use super::known::Samples;
use crate::geometry::{Rotation, Transform, Vector};
use crate::random::Random;
use denavit_symbolic::poly::Poly;
use std::f64::consts::TAU;

/// Configurations at which derivatives are taken: more than the unknowns that an equation may hold.
const CONFIGURATIONS: usize = 5;
/// Derivatives below, by the largest of the equation, are none.
const SMALL: f64 = 1e-9;
/// Derivatives below, by what is added up in an equation, are rounding.
const ROUNDING: f64 = 1e-12;

/// Linear forms in the axes.
type Forms = Vec<Vec<f64>>;

/// The equations of a chain as the unknowns that they hold: forms in the axes that span their derivatives.
#[derive(Debug)]
pub struct Screen {
    axes: usize,
    /// For each axis the form that it is: of one that follows others, in those.
    forms: Forms,
    equations: Vec<Forms>,
    /// A point and the direction of each axis at some configuration; no point of one that slides.
    lines: Vec<(Option<[f64; 3]>, [f64; 3])>,
    length: f64,
    /// Whether six turns have to be of a usual geometry.
    usual: bool,
}

/// A 4×4 matrix without its last row; the pose need not be rigid.
#[derive(Clone, Copy, Debug)]
struct Block {
    r: [[f64; 3]; 3],
    p: [f64; 3],
}

impl Block {
    fn of(x: &Transform<f64>) -> Self {
        Block { r: x.rotation.rows(), p: x.translation.0 }
    }

    /// self · o; of a derivative and a matrix, with `last` 0 for a derivative on the left.
    fn times(&self, o: &Block, last: f64) -> Block {
        let [r, p] = [&self.r, &o.r];
        Block {
            r: std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| r[i][k] * p[k][j]).sum())),
            p: std::array::from_fn(|i| (0..3).map(|k| r[i][k] * o.p[k]).sum::<f64>() + last * self.p[i]),
        }
    }
}

/// The product of a part of the chain, and its derivatives by the axes in it.
#[derive(Clone, Debug)]
struct Part {
    value: Block,
    by: Vec<(usize, Block)>,
}

impl Part {
    fn behind(&self, next: &Part) -> Part {
        let mut by: Vec<(usize, Block)> =
            self.by.iter().map(|(k, d)| (*k, derivative_times(d, &next.value))).collect();
        by.extend(next.by.iter().map(|(k, d)| (*k, self.value.times(d, 0.0))));
        Part { value: self.value.times(&next.value, 1.0), by }
    }
}

/// (dR, dp)·(R, p) = (dR R, dR p + dp).
fn derivative_times(d: &Block, o: &Block) -> Block {
    d.times(o, 1.0)
}

/// The sides of an equation with the pose and with the middle part: rotation, position, position of the inverse, square.
type Entries = [f64; 16];

impl Screen {
    /// For a chain whose whole pose is given; with `usual`, six turns count only if [usual](Self::is_usual).
    pub fn new(chain: &NormalChain, samples: &Samples, usual: bool) -> Self {
        let n = chain.elements.len();
        let mut random = Random(0x5851_F42D_4C95_7F2D);
        let mut gradients: Vec<Vec<Forms>> = vec![];
        let mut lines = vec![];
        for _ in 0..CONFIGURATIONS {
            let parts = parts(chain, samples, &mut random);
            lines = self::lines(chain, &parts[0]);
            let mut drawn = |by: f64| by * (2.0 * random.unit() - 1.0);
            let r = std::array::from_fn(|_| std::array::from_fn(|_| drawn(1.0)));
            let pose = Block { r, p: std::array::from_fn(|_| drawn(2.0 * samples.length())) };
            let mut of_all: Vec<Forms> = vec![];
            for right in 0..=n {
                for left in 0..=right {
                    let three = [&parts[0][left], &parts[left][right - left], &parts[right][n - right]];
                    let mut rows = derivatives(chain.axes.len(), &pose, three);
                    rows.iter_mut().for_each(|row| followed(chain, row));
                    of_all.push(rows);
                }
            }
            gradients.push(of_all);
        }
        let length = samples.length();
        let mut equations = vec![];
        for split in 0..gradients[0].len() {
            for entry in 0..16 {
                let degree = [0, 1, 2][usize::from(entry >= 9) + usize::from(entry >= 15)];
                let rows: Forms = gradients.iter().map(|g| g[split][entry].clone()).collect();
                let forms = spanned(rows, ROUNDING * length.powi(degree));
                if !forms.is_empty() {
                    equations.push(forms);
                }
            }
        }
        let forms = (0..chain.axes.len()).map(|k| form(chain, k)).collect();
        Screen { axes: chain.axes.len(), forms, equations, lines, length, usual }
    }

    /// False if six turns are left of which no three neighbours meet in a point or are parallel.
    fn is_usual(&self, given: &[usize]) -> bool {
        let left: Vec<_> = (0..self.axes).filter(|k| !given.contains(k)).map(|k| self.lines[k]).collect();
        let turns: Vec<_> = left.iter().filter_map(|&(point, z)| Some((point?, z))).collect();
        let is_small = |v: [f64; 3], unit: f64| square(&v).sqrt() <= SMALL * unit;
        let are_parallel = |a: [f64; 3], b: [f64; 3]| is_small(cross(&a, &b), 1.0);
        let special = |w: &[([f64; 3], [f64; 3])]| {
            let [(p, u), (q, v), (r, w)] = [w[0], w[1], w[2]];
            if are_parallel(u, v) || are_parallel(v, w) {
                return are_parallel(u, v) && are_parallel(v, w);
            }
            // The points of the second axis that are nearest to the others are one, and on them.
            let nearest = |(p, u): ([f64; 3], [f64; 3])| {
                let (n, between) = (cross(&u, &v), std::array::from_fn(|i| p[i] - q[i]));
                let along = dot(&cross(&between, &u), &n) / -dot(&n, &n);
                (along, dot(&between, &n).abs() / square(&n).sqrt())
            };
            let ((a, first), (b, second)) = (nearest((p, u)), nearest((r, w)));
            (a - b).abs().max(first).max(second) <= SMALL * self.length
        };
        let follows = (0..self.axes).any(|k| self.forms[k][k] == 0.0);
        follows || left.len() != 6 || turns.len() < 6 || turns.windows(3).any(special)
    }

    /// False if the search cannot find everything from the values of some axes.
    pub fn may_end(&self, given: &[usize]) -> bool {
        if self.usual && !self.is_usual(given) {
            return false;
        }
        let drive: usize = (0..self.axes).filter(|&k| self.forms[k][k] != 0.0).count();
        let mut known: Forms = spanned(given.iter().map(|&k| self.forms[k].clone()).collect(), 0.0);
        loop {
            if known.len() >= drive {
                return true;
            }
            let before = known.len();
            let mut pairs: Vec<Forms> = vec![];
            for forms in &self.equations {
                if forms.len() > known.len() + 2 {
                    continue;
                }
                let left = beyond(&known, forms);
                match left.len() {
                    1 => known.extend(left),
                    2 => match pairs
                        .iter()
                        .find(|p| left.iter().all(|f| beyond(p, std::slice::from_ref(f)).is_empty()))
                    {
                        Some(_) => known.extend(left),
                        None => pairs.push(left),
                    },
                    _ => {}
                }
            }
            if known.len() == before {
                return false;
            }
        }
    }
}

/// An axis as a form in those that drive.
fn form(chain: &NormalChain, k: usize) -> Vec<f64> {
    let mut form = vec![0.0; chain.axes.len()];
    for (&d, x) in chain.drivers.axes.iter().zip(&chain.drivers.factors[k]) {
        form[d] = x.to_f64();
    }
    form
}

/// Derivatives by all axes become those by the axes that drive.
fn followed(chain: &NormalChain, row: &mut [f64]) {
    for k in (0..row.len()).filter(|&k| !chain.drivers.drives(k)) {
        let by = std::mem::take(&mut row[k]);
        row.iter_mut().zip(form(chain, k)).for_each(|(x, factor)| *x += factor * by);
    }
}

/// The axes at a configuration, by the products of the first elements.
fn lines(chain: &NormalChain, before: &[Part]) -> Vec<(Option<[f64; 3]>, [f64; 3])> {
    let mut lines = vec![(None, [0.0; 3]); chain.axes.len()];
    for (element, part) in chain.elements.iter().zip(before) {
        if let Element::Axis(k) = element {
            let turns = chain.axes[*k].motion != Motion::Slide;
            lines[*k] = (turns.then_some(part.value.p), part.value.r.map(|row| row[2]));
        }
    }
    lines
}

/// All products of neighbouring elements at a configuration: by the first element, then by how many.
fn parts(chain: &NormalChain, samples: &Samples, random: &mut Random) -> Vec<Vec<Part>> {
    let value = |p: &Poly| Algebra::value(p, samples.first());
    let elements: Vec<Part> = chain
        .elements
        .iter()
        .map(|element| match element {
            Element::Constant(constant) => {
                let (r, p) = &**constant;
                let rows = std::array::from_fn(|i| std::array::from_fn(|j| value(&r[i][j])));
                let p = Vector(std::array::from_fn(|i| value(&p[i])));
                let x = Transform::from_rotation_translation(Rotation::from_rows(rows), p);
                Part { value: Block::of(&x), by: vec![] }
            }
            Element::Axis(k) if chain.axes[*k].motion == Motion::Slide => {
                let x = samples.length() * (2.0 * random.unit() - 1.0);
                let d = Block { r: [[0.0; 3]; 3], p: [0.0, 0.0, 1.0] };
                Part { value: Block::of(&Transform::translation_z(x)), by: vec![(*k, d)] }
            }
            Element::Axis(k) => {
                let angle = TAU * random.unit();
                let (s, c) = angle.sin_cos();
                let d = Block { r: [[-s, -c, 0.0], [c, -s, 0.0], [0.0; 3]], p: [0.0; 3] };
                Part { value: Block::of(&Transform::rotation_z(angle)), by: vec![(*k, d)] }
            }
        })
        .collect();
    let whole = |from: usize| {
        let mut found = vec![Part { value: Block::of(&Transform::identity()), by: vec![] }];
        for element in &elements[from..] {
            let next = found[found.len() - 1].behind(element);
            found.push(next);
        }
        found
    };
    (0..=elements.len()).map(whole).collect()
}

/// The derivatives of left⁻¹ · U · right⁻¹ − middle by all axes, an entry each.
fn derivatives(axes: usize, pose: &Block, [left, middle, right]: [&Part; 3]) -> Forms {
    let mut rows = vec![vec![0.0; axes]; 16];
    let mut set = |k: usize, d: Entries| rows.iter_mut().zip(d).for_each(|(row, x)| row[k] += x);
    // W = U · right⁻¹: rotation U Rᵀ, position u − U Rᵀ p; then leftᵀ, and the position from left's.
    let turned = |r: &[[f64; 3]; 3]| -> [[f64; 3]; 3] {
        std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| pose.r[i][k] * r[j][k]).sum()))
    };
    let w = turned(&right.value.r);
    let position = |w: &[[f64; 3]; 3], p: &[f64; 3]| -> [f64; 3] { std::array::from_fn(|i| dot(&w[i], p)) };
    let reached = position(&w, &right.value.p);
    let moved: [f64; 3] = std::array::from_fn(|i| pose.p[i] - reached[i] - left.value.p[i]);
    let on_pose = across(&left.value.r, &moved);
    // dW and d(moved) by an axis on either side, and dRᵀ of the left side.
    let mut of_pose = |k: usize, dw: [[f64; 3]; 3], dm: [f64; 3], dl: Option<&[[f64; 3]; 3]>| {
        let zero = [[0.0; 3]; 3];
        let dl = dl.unwrap_or(&zero);
        let position: [f64; 3] = {
            let (a, b) = (across(&left.value.r, &dm), across(dl, &moved));
            std::array::from_fn(|i| a[i] + b[i])
        };
        let inverse: [f64; 3] = {
            let (a, b) = (across(&dw, &moved), across(&w, &dm));
            std::array::from_fn(|i| -a[i] - b[i])
        };
        let rotation = |i: usize, j: usize| -> f64 {
            (0..3).map(|m| left.value.r[m][i] * dw[m][j] + dl[m][i] * w[m][j]).sum()
        };
        set(k, entries(rotation, position, inverse, 2.0 * dot(&on_pose, &position)));
    };
    for (k, d) in &left.by {
        of_pose(*k, [[0.0; 3]; 3], d.p.map(|x| -x), Some(&d.r));
    }
    for (k, d) in &right.by {
        let dw = turned(&d.r);
        let (a, b) = (position(&dw, &right.value.p), position(&w, &d.p));
        of_pose(*k, dw, std::array::from_fn(|i| -a[i] - b[i]), None);
    }
    let m = &middle.value;
    for (k, d) in &middle.by {
        let inverse = {
            let (a, b) = (across(&d.r, &m.p), across(&m.r, &d.p));
            std::array::from_fn(|i| a[i] + b[i])
        };
        let rotation = |i: usize, j: usize| -d.r[i][j];
        set(*k, entries(rotation, d.p.map(|x| -x), inverse, -2.0 * dot(&m.p, &d.p)));
    }
    rows
}

fn entries(
    rotation: impl Fn(usize, usize) -> f64,
    position: [f64; 3],
    inverse: [f64; 3],
    square: f64,
) -> Entries {
    std::array::from_fn(|e| match e {
        0..9 => rotation(e / 3, e % 3),
        9..12 => position[e - 9],
        12..15 => inverse[e - 12],
        _ => square,
    })
}

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    Vector(*a).cross(Vector(*b)).0
}

/// Rᵀ v.
fn across(r: &[[f64; 3]; 3], v: &[f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| (0..3).map(|k| r[k][i] * v[k]).sum())
}

/// Orthonormal forms that span some, the longest first; what is left of a form below `least`, or small beside the longest,
/// is none.
fn spanned(mut rows: Forms, least: f64) -> Forms {
    let mut found: Forms = vec![];
    let mut scale = 0.0;
    while let Some(k) = (0..rows.len()).max_by(|&a, &b| square(&rows[a]).total_cmp(&square(&rows[b]))) {
        let length = square(&rows[k]).sqrt();
        if found.is_empty() {
            scale = length;
        }
        if length <= least.max(SMALL * scale) {
            break;
        }
        let one: Vec<f64> = rows.swap_remove(k).iter().map(|x| x / length).collect();
        rows.iter_mut().for_each(|row| remove(row, &one));
        found.push(one);
    }
    found
}

/// What forms span beside known ones, orthonormal.
fn beyond(known: &[Vec<f64>], forms: &[Vec<f64>]) -> Forms {
    let mut left = forms.to_vec();
    left.iter_mut().for_each(|f| known.iter().for_each(|k| remove(f, k)));
    spanned(left, SMALL)
}

fn square(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum()
}

/// Takes out of a form what lies along a unit form.
fn remove(form: &mut [f64], unit: &[f64]) {
    let along: f64 = form.iter().zip(unit).map(|(x, y)| x * y).sum();
    form.iter_mut().zip(unit).for_each(|(x, y)| *x -= along * y);
}
