//! Newton's method on the pose, eight candidates at a time, and the smallest singular value at its end.
//!
//! Joint angles are kept as cosine and sine; a step turns them. Lengths are divided by the arm's size.

use crate::{
    arm::{Arm, Joint},
    determinant::reduce,
    instructions::{Compute, Instructions, part},
    lanes::Lanes,
    remaining::Value,
    rigid::Rigid,
};

/// A pose and, per joint, its axis and a point on it, in the base frame.
struct Motion {
    rotation: [[Lanes; 3]; 3],
    position: [Lanes; 3],
    axes: [[Lanes; 3]; 6],
    points: [[Lanes; 3]; 6],
}

/// Where the chain is at the values.
#[inline(always)]
fn forward<I: Instructions>(arm: &Arm, values: &[Value; 6]) -> Motion {
    let mut at = Motion {
        rotation: [[Lanes::ZERO; 3]; 3],
        position: [Lanes::ZERO; 3],
        axes: [[Lanes::ZERO; 3]; 6],
        points: [[Lanes::ZERO; 3]; 6],
    };
    for x in 0..3 {
        at.position[x] = Lanes::splat(arm.base.translation[x]);
        for k in 0..3 {
            at.rotation[x][k] = Lanes::splat(arm.base.rotation[x][k]);
        }
    }
    for i in 0..6 {
        let [c, s] = values[i];
        let link = &arm.links[i];
        for x in 0..3 {
            let row = at.rotation[x];
            at.axes[i][x] = row[2];
            at.points[i][x] = at.position[x];
            let row = match arm.joints[i] {
                Joint::Revolute => {
                    [s.mul_add::<I>(row[1], c.times(row[0])), s.mul_sub::<I>(row[0], c.times(row[1])), row[2]]
                }
                Joint::Prismatic => {
                    at.position[x] = c.mul_add::<I>(row[2], at.position[x]);
                    row
                }
            };
            let mut position = at.position[x];
            for k in 0..3 {
                position = row[k].scale_add::<I>(link.translation[k], position);
                let mut entry = row[0].scale(link.rotation[0][k]);
                entry = row[1].scale_add::<I>(link.rotation[1][k], entry);
                entry = row[2].scale_add::<I>(link.rotation[2][k], entry);
                at.rotation[x][k] = entry;
            }
            at.position[x] = position;
        }
    }
    at
}

/// The twist that is left to the pose, and the square of the distance (in SE(3): the turn's chord, and the shift).
#[inline(always)]
fn error<I: Instructions>(at: &Motion, target: &Rigid) -> ([Lanes; 6], Lanes) {
    let mut twist = [Lanes::ZERO; 6];
    let mut square = Lanes::ZERO;
    for k in 0..3 {
        // ½ Σ r × r', over the columns
        let column = [at.rotation[0][k], at.rotation[1][k], at.rotation[2][k]];
        let goal = [target.rotation[0][k], target.rotation[1][k], target.rotation[2][k]];
        for x in 0..3 {
            let (y, z) = ((x + 1) % 3, (x + 2) % 3);
            twist[3 + x] = column[y].scale_add::<I>(0.5 * goal[z], twist[3 + x]);
            twist[3 + x] = column[z].scale_add::<I>(-0.5 * goal[y], twist[3 + x]);
            let apart = column[x].minus(Lanes::splat(goal[x]));
            square = apart.mul_add::<I>(apart, square);
        }
    }
    square = square.scale(0.5);
    for x in 0..3 {
        twist[x] = Lanes::splat(target.translation[x]).minus(at.position[x]);
        square = twist[x].mul_add::<I>(twist[x], square);
    }
    (twist, square)
}

/// The geometric Jacobian in the first six of `N` columns.
#[inline(always)]
fn jacobian<I: Instructions, const N: usize>(arm: &Arm, at: &Motion, m: &mut [[Lanes; N]; 6]) {
    for i in 0..6 {
        let z = &at.axes[i];
        for x in 0..3 {
            let (y, w) = ((x + 1) % 3, (x + 2) % 3);
            match arm.joints[i] {
                Joint::Revolute => {
                    let (a, b) =
                        (at.position[w].minus(at.points[i][w]), at.position[y].minus(at.points[i][y]));
                    m[x][i] = z[w].mul_sub::<I>(b, z[y].times(a));
                    m[3 + x][i] = z[x];
                }
                Joint::Prismatic => {
                    m[x][i] = z[x];
                    m[3 + x][i] = Lanes::ZERO;
                }
            }
        }
    }
}

/// Pivots below this stand for directions in which no step is taken.
const FLAT: f64 = 1e-13;
/// Largest step of a joint (rad, or parts of the arm's size).
const STEP: f64 = 0.6;
/// Square of the distance that is as good as none.
const DONE: f64 = 4e-30;
/// Most iterations.
const MOST: u32 = 24;

part! {
    /// Newton's method on all lanes, each kept at its best; the distances to the pose that are left.
    pub fn polish<I>(arm: &Arm, target: &Rigid, values: &mut [Value; 6]) -> Lanes {
        let mut best = Lanes::splat(f64::INFINITY);
        let mut now = *values;
        let mut patience = Lanes::splat(4.0);
        for _ in 0..MOST {
            let at = forward::<I>(arm, &now);
            let (twist, square) = error::<I>(&at, target);
            // A lane that has not halved its distance uses up its patience.
            let slow = square.where_less(best.scale(0.25), Lanes::ZERO, Lanes::ONE);
            patience = patience.minus(slow);
            for i in 0..6 {
                for k in 0..2 {
                    values[i][k] = square.where_less(best, now[i][k], values[i][k]);
                }
            }
            best = square.where_less(best, square, best);
            let open = square.where_less(Lanes::splat(DONE), Lanes::ZERO, patience);
            if open.largest() <= 0.0 {
                break;
            }

            let mut m = [[Lanes::ZERO; 7]; 6];
            jacobian::<I, 7>(arm, &at, &mut m);
            for (row, twist) in m.iter_mut().zip(&twist) {
                row[6] = *twist;
            }
            reduce::<I, 7>(&mut m, 6);
            let mut step = [Lanes::ZERO; 6];
            for k in (0..6).rev() {
                let mut sum = m[k][6];
                for c in k + 1..6 {
                    sum = m[k][c].mul_sub::<I>(step[c], sum);
                }
                let flat = m[k][k].magnitude();
                step[k] = flat.where_less(Lanes::splat(FLAT), Lanes::ZERO, sum.over(m[k][k]));
            }
            let mut longest = Lanes::splat(STEP);
            for step in &step {
                longest = longest.larger(step.magnitude());
            }
            let factor = Lanes::splat(STEP).over(longest);
            for i in 0..6 {
                let step = step[i].times(factor);
                now[i] = match arm.joints[i] {
                    Joint::Revolute => turned::<I>(&now[i], step),
                    Joint::Prismatic => [now[i][0].plus(step), Lanes::ZERO],
                };
            }
        }
        best.root()
    }
}

/// Cosine and sine after a turn by at most 0.6 rad: Taylor's polynomials, then back to length 1.
#[inline(always)]
fn turned<I: Instructions>(value: &Value, step: Lanes) -> Value {
    let square = step.times(step);
    let (mut c, mut s) = (Lanes::splat(1.0 / 479_001_600.0), Lanes::splat(1.0 / 6_227_020_800.0));
    for k in (0..6).rev() {
        // cos: terms (2k)!, sin: (2k + 1)!, signs alternating
        c = c.mul_sub::<I>(square, Lanes::splat(RECIPROCAL[2 * k]));
        s = s.mul_sub::<I>(square, Lanes::splat(RECIPROCAL[2 * k + 1]));
    }
    let s = s.times(step);
    let [x, y] = *value;
    let (nx, ny) = (s.mul_sub::<I>(y, c.times(x)), s.mul_add::<I>(x, c.times(y)));
    let length = ny.mul_add::<I>(ny, nx.times(nx));
    let back = Lanes::splat(1.5).minus(length.scale(0.5));
    [nx.times(back), ny.times(back)]
}

/// `1/n!`
const RECIPROCAL: [f64; 12] = [
    1.0,
    1.0,
    1.0 / 2.0,
    1.0 / 6.0,
    1.0 / 24.0,
    1.0 / 120.0,
    1.0 / 720.0,
    1.0 / 5040.0,
    1.0 / 40320.0,
    1.0 / 362_880.0,
    1.0 / 3_628_800.0,
    1.0 / 39_916_800.0,
];

part! {
    /// The smallest singular value of the Jacobian in each lane: power iterations with the inverse, from its longest row.
    pub fn smallest_singular_values<I>(arm: &Arm, values: &[Value; 6]) -> Lanes {
        let at = forward::<I>(arm, values);
        let mut m = [[Lanes::ZERO; 12]; 6];
        jacobian::<I, 12>(arm, &at, &mut m);
        for (k, row) in m.iter_mut().enumerate() {
            row[6 + k] = Lanes::ONE;
        }
        reduce::<I, 12>(&mut m, 6);
        let mut inverse = [[Lanes::ZERO; 6]; 6];
        for k in (0..6).rev() {
            let flat = m[k][k].magnitude();
            let pivot = flat.where_less(Lanes::splat(1e-15), Lanes::splat(1e-15), m[k][k]);
            let pivot = Lanes::ONE.over(pivot);
            for j in 0..6 {
                let mut sum = m[k][6 + j];
                for c in k + 1..6 {
                    sum = m[k][c].mul_sub::<I>(inverse[c][j], sum);
                }
                inverse[k][j] = sum.times(pivot);
            }
        }
        // x ← the longest row, then x ← Xᵀ X x: the length grows by σ_min⁻² each time.
        let (mut x, mut longest) = ([Lanes::ZERO; 6], Lanes::splat(-1.0));
        for row in &inverse {
            let mut square = Lanes::ZERO;
            for entry in row {
                square = entry.mul_add::<I>(*entry, square);
            }
            for (x, entry) in x.iter_mut().zip(row) {
                *x = longest.where_less(square, *entry, *x);
            }
            longest = longest.larger(square);
        }
        let mut growth = Lanes::ONE;
        for _ in 0..4 {
            let mut square = Lanes::ZERO;
            for x in &x {
                square = x.mul_add::<I>(*x, square);
            }
            let back = Lanes::ONE.over(square.root());
            for x in &mut x {
                *x = x.times(back);
            }
            let mut image = [Lanes::ZERO; 6];
            for (image, row) in image.iter_mut().zip(&inverse) {
                for (entry, x) in row.iter().zip(&x) {
                    *image = entry.mul_add::<I>(*x, *image);
                }
            }
            growth = Lanes::ZERO;
            for image in &image {
                growth = image.mul_add::<I>(*image, growth);
            }
            x = [Lanes::ZERO; 6];
            for (image, row) in image.iter().zip(&inverse) {
                for (x, entry) in x.iter_mut().zip(row) {
                    *x = entry.mul_add::<I>(*image, *x);
                }
            }
        }
        Lanes::ONE.over(growth.root())
    }
}
