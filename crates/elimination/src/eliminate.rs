//! From fourteen equations to six that are free of two joints: Householder QR with column pivoting.

use crate::{
    forms::{FORMS, forms, interpolate, left_alone, move_by_joint_back, moved, nodes},
    instructions::{Compute, Instructions, Strict, part},
    lanes::{Lanes, mul_add, one_by_one},
    rigid::Rigid,
    split::Split,
};

/// The six equations that remain, and what the eliminated joints are found from later.
#[derive(Clone, Debug)]
pub struct Eliminated {
    /// Rows over the 27 monomials of [`Split::left`], the largest entry of each row 1.
    pub rows: [[f64; 27]; 6],
    /// The largest entries before: rounding errors are the same for all.
    pub sizes: [f64; 6],
    /// The links with the pose in its place.
    pub links: [Rigid; 6],
    /// The forms that the second joint leaves alone, over `(1, c, s)` or `(1, d, d²)` of the first.
    pub first: [[f64; 3]; 6],
}

impl Default for Eliminated {
    fn default() -> Eliminated {
        Eliminated {
            rows: [[0.0; 27]; 6],
            sizes: [0.0; 6],
            links: [Rigid::IDENTITY; 6],
            first: [[0.0; 3]; 6],
        }
    }
}

/// Relative size of a column that counts as none.
const RANK: f64 = 1e-11;

part! {
    /// Eliminates the first two joints of the split at a pose; `closing` is `A₆ T⁻¹ B`, scaled.
    pub fn eliminate<I>(split: &Split, closing: &Rigid, out: &mut Eliminated) {
        out.links = split.links_at(closing);
        let right = right_side(split, out);

        // Columns 0 to 7: the right side without its constant; 8 to 34: the left side minus that constant.
        let mut rows = [[Lanes::ZERO; 5]; FORMS];
        for i in 0..FORMS {
            let mut row = [0.0; 40];
            row[..8].copy_from_slice(&right[i][1..]);
            row[8..35].copy_from_slice(&split.left[i]);
            row[8] -= right[i][0];
            for (lanes, part) in rows[i].iter_mut().zip(row.chunks_exact(8)) {
                lanes.0.copy_from_slice(part);
            }
        }

        let mut rank = 0;
        let mut used = [false; 8];
        let mut largest = 0.0f64;
        for k in 0..8 {
            // The column with the most left in the rows from k on.
            let mut left = Lanes::ZERO;
            for row in &rows[k..] {
                left = row[0].mul_add::<I>(row[0], left);
            }
            let mut pivot = 8;
            let mut norm = 0.0;
            for l in 0..8 {
                if !used[l] && left.0[l] > norm {
                    (pivot, norm) = (l, left.0[l]);
                }
            }
            let norm = norm.sqrt();
            largest = if norm > largest { norm } else { largest };
            if pivot == 8 || norm <= RANK * largest {
                break;
            }
            used[pivot] = true;
            rank += 1;

            // Reflection x ↦ x − v (v·x) β with v = column + sign norm e_k, β = 1 / (norm |v_k|)
            let mut v = [0.0; FORMS];
            for i in k..FORMS {
                v[i] = rows[i][0].0[pivot];
            }
            v[k] += if v[k] < 0.0 { -norm } else { norm };
            let beta = 1.0 / (norm * v[k].abs());
            let mut sum = [Lanes::ZERO; 5];
            for i in k..FORMS {
                for (sum, entry) in sum.iter_mut().zip(&rows[i]) {
                    one_by_one();
                    *sum = entry.scale_add::<I>(v[i], *sum);
                }
            }
            for sum in &mut sum {
                *sum = sum.scale(-beta);
            }
            for i in k..FORMS {
                for (entry, sum) in rows[i].iter_mut().zip(&sum) {
                    one_by_one();
                    *entry = sum.scale_add::<I>(v[i], *entry);
                }
            }
        }

        // Fewer than eight columns: more than six equations remain, of which six fixed mixtures are taken.
        for i in 0..6 {
            let mut mixed = rows[8 + i];
            if rank < 8 {
                mixed = [Lanes::ZERO; 5];
                for (j, row) in rows.iter().enumerate().skip(rank) {
                    let weight = mixture(i, j);
                    for (mixed, entry) in mixed.iter_mut().zip(row) {
                        *mixed = entry.scale_add::<I>(weight, *mixed);
                    }
                }
            }
            let mut top = Lanes::ZERO;
            for entry in &mixed[1..] {
                top = top.larger(entry.magnitude());
            }
            let top = top.largest();
            let scale = if top > 0.0 { 1.0 / top } else { 0.0 };
            out.sizes[i] = top;
            for (k, x) in out.rows[i].iter_mut().enumerate() {
                *x = mixed[1 + k / 8].0[k % 8] * scale;
            }
        }
    }
}

/// The right sides over the monomials of the first two joints (the second's fastest).
fn right_side(split: &Split, out: &mut Eliminated) -> [[f64; 9]; FORMS] {
    let links = &out.links;
    let mut samples = [[0.0; FORMS]; 3];
    for (sample, node) in samples.iter_mut().zip(&nodes(split.kinds[0])) {
        // L₁⁻¹ Z₁⁻¹ L₆⁻¹ on the origin and on e₃
        let last = &links[5].rotation[2];
        let p = links[0].point_back(node.point_back(links[5].point_back([0.0; 3])));
        let l = links[0].turn_back(node.turn_back([last[0], last[1], last[2]]));
        *sample = forms(p, l);
    }
    let mut first = [[0.0; 3]; FORMS];
    for (k, row) in first.iter_mut().enumerate() {
        *row = interpolate(split.kinds[0], [samples[0][k], samples[1][k], samples[2][k]]);
    }
    for (row, form) in out.first.iter_mut().zip(left_alone(split.kinds[1])) {
        *row = first[form];
    }
    let right = move_by_joint_back(split.kinds[1], &first);
    if split.pose_link == 1 { moved(&links[1].inverse(), &right) } else { right }
}

/// A fixed number between −1 and 1 without pattern.
fn mixture(i: usize, j: usize) -> f64 {
    let x = mul_add::<Strict>((i * FORMS + j + 1) as f64, 0.618_033_988_749_894_9, 0.0);
    let y = (x - x.floor()) * 997.0;
    2.0 * (y - y.floor()) - 1.0
}
