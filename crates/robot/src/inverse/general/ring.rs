//! Five axes and a ring of transforms between them that depend on an angle φ: the determinant that is zero where the ring
//! closes (Raghavan and Roth 1990, with a hidden variable that moves several links).
//!
//! The loop `Z₁ K₁ Z₂ K₂ Z₃ K₃ Z₄ K₄ Z₅ K₅ = 1` is cut in two, `K₂ Z₃ K₃ Z₄ K₄ = Z₂⁻¹ K₁⁻¹ Z₁⁻¹ K₅⁻¹ Z₅⁻¹`. `Z₅` leaves its
//! own line where it is; fourteen functions of this line, seen from both sides, are equations over the monomials
//! `(1, c, s) ⊗ (1, c, s)` of each side. Where `K₁` and `K₅` do not depend on φ, the right side is eliminated once. Six
//! equations remain over the left side's nine monomials; multiplied by the halves of one angle they are a square matrix of
//! twelve, of which the determinant is a trigonometric polynomial in φ.

use crate::description::JointKind;
use crate::geometry::Transform;

const FORMS: usize = 14;
/// Relative size of a column that counts as none.
const RANK: f64 = 1e-11;

/// Which axis of the ring is which: places 0 to 4.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Cut {
    /// The place of the axis whose line is looked at.
    pub dropped: usize,
    /// Whether the loop is read forwards.
    pub forwards: bool,
    /// Whether the halves of the fourth axis's angle multiply, else those of the third.
    pub last: bool,
}

impl Cut {
    /// All there are.
    pub fn all() -> impl Iterator<Item = Cut> {
        (0..20).map(|k| Cut { dropped: k / 4, forwards: k % 2 == 0, last: k / 2 % 2 == 0 })
    }

    /// The places in the order in which the loop is read: 1 to 5.
    fn places(self) -> [usize; 5] {
        let step = if self.forwards { 1 } else { 4 };
        std::array::from_fn(|k| (self.dropped + step * (k + 1)) % 5)
    }

    /// Whether the gaps that must not depend on φ do not: `gap` says of the gap behind a place whether it does.
    pub fn suits(self, depends: &[bool; 5]) -> bool {
        let p = self.places();
        // K₁ and K₅ are the gaps on both sides of the first axis of the order.
        !depends[p[0]] && !depends[(p[0] + 4) % 5]
    }
}

/// The equations that remain at a pose, the same for all φ.
#[derive(Clone, Debug)]
pub(super) struct Remaining {
    cut: Cut,
    kinds: [JointKind; 5],
    /// Six rows that vanish on the right side's monomials.
    rows: [[f64; FORMS]; 6],
    /// What they are on its constant.
    constant: [f64; 6],
}

/// The links of the loop as it is read.
fn links(cut: Cut, gaps: &[Transform<f64>; 5]) -> [Transform<f64>; 5] {
    let p = cut.places();
    std::array::from_fn(|k| if cut.forwards { gaps[p[k]] } else { gaps[(p[k] + 4) % 5].inverse() })
}

impl Remaining {
    /// At a pose: `gaps` are the transforms behind each axis of the ring, at any φ.
    pub fn new(cut: Cut, kinds: &[JointKind; 5], gaps: &[Transform<f64>; 5]) -> Self {
        let kinds = cut.places().map(|p| kinds[p]);
        let k = links(cut, gaps);
        let right = monomials([kinds[0], kinds[1]], |first, second| {
            second.inverse() * k[0].inverse() * first.inverse() * k[4].inverse()
        });
        let (rows, constant) = left_null(&right);
        Remaining { cut, kinds, rows, constant }
    }

    /// The determinant at a value of φ, with the gaps that it makes.
    pub fn determinant(&self, gaps: &[Transform<f64>; 5]) -> f64 {
        let k = links(self.cut, gaps);
        let (mut kinds, last) = ([self.kinds[2], self.kinds[3]], self.cut.last);
        let left = monomials(kinds, |third, fourth| k[1] * *third * k[2] * *fourth * k[3]);
        if last {
            kinds.swap(0, 1);
        }
        let (r, is_angle) = match kinds[0] {
            JointKind::Revolute => (1.0 / 3.0_f64.sqrt(), true),
            JointKind::Prismatic => (1.0, false),
        };
        let mut m = [[0.0; 12]; 12];
        for i in 0..6 {
            // Over the multiplied axis's monomials, then those of the other.
            let entry = |a: usize, b: usize| {
                let at = if last { 3 * b + a } else { 3 * a + b };
                let sum: f64 = (0..FORMS).map(|f| self.rows[i][f] * left[f][at]).sum();
                if a == 0 && b == 0 { sum - self.constant[i] } else { sum }
            };
            for w in 0..3 {
                let (one, first, second) = (entry(0, w), entry(1, w), entry(2, w));
                // One + first c + second s = A u² + B u v + C v² with the half angle's u and v.
                let (a, b, c) =
                    if is_angle { (one + first, 2.0 * second, one - first) } else { (one, first, second) };
                let b = if is_angle { b * r } else { b };
                (m[i][w], m[i][3 + w], m[i][6 + w]) = (a, b, c * r);
                (m[6 + i][3 + w], m[6 + i][6 + w], m[6 + i][9 + w]) = (a * r, b, c);
            }
        }
        determinant(m)
    }
}

/// The fourteen functions of a line over the monomials of two axes, the second's fastest; `z` of the transform is the line.
fn monomials(
    kinds: [JointKind; 2],
    place: impl Fn(&Transform<f64>, &Transform<f64>) -> Transform<f64>,
) -> [[f64; 9]; FORMS] {
    let [first, second] = kinds.map(nodes);
    let mut rows = [[0.0; 9]; FORMS];
    for (i, a) in first.iter().enumerate() {
        for (j, b) in second.iter().enumerate() {
            let x = place(a, b);
            let values = forms(&x);
            rows.iter_mut().zip(values).for_each(|(row, value)| row[3 * i + j] = value);
        }
    }
    for row in &mut rows {
        for (kind, stride) in [(kinds[0], 3), (kinds[1], 1)] {
            for at in (0..9).filter(|at| at / stride % 3 == 0) {
                let found = interpolate(kind, [row[at], row[at + stride], row[at + 2 * stride]]);
                found.into_iter().enumerate().for_each(|(k, value)| row[at + k * stride] = value);
            }
        }
    }
    rows
}

/// `[p, l, p·p, p·l, p×l, (p·p) l − 2 (p·l) p]` of the line through p along l: affine in the sine and cosine of each angle on
/// the way.
fn forms(x: &Transform<f64>) -> [f64; FORMS] {
    let (p, l) = (x.translation, x.rotation.z());
    let (pp, pl, n) = (p.dot(p), p.dot(l), p.cross(l));
    let last = l.scale(pp) - p.scale(2.0 * pl);
    let (p, l, n, last) = (p.0, l.0, n.0, last.0);
    [p[0], p[1], p[2], l[0], l[1], l[2], pp, pl, n[0], n[1], n[2], last[0], last[1], last[2]]
}

/// The motions of an axis at which a function of it is sampled.
fn nodes(kind: JointKind) -> [Transform<f64>; 3] {
    match kind {
        JointKind::Revolute => {
            [0.0, 1.0, -1.0].map(|k| Transform::rotation_z(k * std::f64::consts::TAU / 3.0))
        }
        JointKind::Prismatic => [-1.0, 0.0, 1.0].map(Transform::translation_z),
    }
}

/// The coefficients of `(1, cos, sin)` or `(1, d, d²)` from the values at the [`nodes`].
fn interpolate(kind: JointKind, [a, b, c]: [f64; 3]) -> [f64; 3] {
    match kind {
        JointKind::Revolute => [(a + b + c) / 3.0, (2.0 * a - b - c) / 3.0, (b - c) / 3.0_f64.sqrt()],
        JointKind::Prismatic => [b, (c - a) / 2.0, (a + c) / 2.0 - b],
    }
}

/// Six vectors that are orthogonal to all columns but the first, and their products with the first.
fn left_null(right: &[[f64; 9]; FORMS]) -> ([[f64; FORMS]; 6], [f64; 6]) {
    let dot = |a: &[f64; FORMS], b: &[f64; FORMS]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let column = |k: usize| -> [f64; FORMS] { std::array::from_fn(|i| right[i][k]) };
    // Gram's and Schmidt's method, the column with the most left first, each made orthogonal twice.
    let mut basis: Vec<[f64; FORMS]> = vec![];
    let extend = |basis: &mut Vec<[f64; FORMS]>, mut left: Vec<[f64; FORMS]>, most: usize, least: f64| {
        let mut largest: f64 = 0.0;
        while basis.len() < most && !left.is_empty() {
            for v in &mut left {
                for b in basis.iter() {
                    let along = dot(v, b);
                    v.iter_mut().zip(b).for_each(|(x, y)| *x -= along * y);
                }
            }
            let Some(k) =
                (0..left.len()).max_by(|&i, &j| dot(&left[i], &left[i]).total_cmp(&dot(&left[j], &left[j])))
            else {
                break;
            };
            let mut v = left.swap_remove(k);
            let norm = dot(&v, &v).sqrt();
            largest = largest.max(norm);
            if norm <= least * largest || norm == 0.0 {
                break;
            }
            v.iter_mut().for_each(|x| *x /= norm);
            for b in basis.iter() {
                let along = dot(&v, b);
                v.iter_mut().zip(b).for_each(|(x, y)| *x -= along * y);
            }
            let norm = dot(&v, &v).sqrt();
            v.iter_mut().for_each(|x| *x /= norm);
            basis.push(v);
        }
    };
    extend(&mut basis, (1..9).map(column).collect(), 8, RANK);
    let rank = basis.len();
    let unit = |k: usize| -> [f64; FORMS] { std::array::from_fn(|i| f64::from(u8::from(i == k))) };
    extend(&mut basis, (0..FORMS).map(unit).collect(), FORMS, 0.0);
    let own = &basis[rank..];
    let first = column(0);
    let row = |i: usize| -> [f64; FORMS] {
        // More than six remain where columns depend on each other: of them six fixed mixtures.
        if own.len() == 6 {
            return own[i];
        }
        let mut mixed = [0.0; FORMS];
        for (j, v) in own.iter().enumerate() {
            let weight = mixture(i, j);
            mixed.iter_mut().zip(v).for_each(|(x, y)| *x += weight * y);
        }
        mixed
    };
    let rows: [[f64; FORMS]; 6] = std::array::from_fn(row);
    let constant = rows.map(|row| dot(&row, &first));
    (rows, constant)
}

/// A fixed number between −1 and 1 without pattern.
fn mixture(i: usize, j: usize) -> f64 {
    let x = (i * FORMS + j + 1) as f64 * 0.618_033_988_749_894_9;
    2.0 * (x.fract() * 997.0).fract() - 1.0
}

/// By Gauss's elimination.
fn determinant(mut m: [[f64; 12]; 12]) -> f64 {
    let mut product = 1.0;
    for k in 0..12 {
        let pivot = (k..12).max_by(|&a, &b| m[a][k].abs().total_cmp(&m[b][k].abs())).unwrap_or(k);
        if pivot != k {
            m.swap(k, pivot);
            product = -product;
        }
        if m[k][k] == 0.0 {
            return 0.0;
        }
        product *= m[k][k];
        let row = m[k];
        for other in &mut m[k + 1..] {
            let factor = other[k] / row[k];
            other[k..].iter_mut().zip(&row[k..]).for_each(|(x, y)| *x -= factor * y);
        }
    }
    product
}
