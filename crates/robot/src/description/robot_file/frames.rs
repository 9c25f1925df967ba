//! `[base]` and `[tool]`: constant transforms.

use super::fields::{Fields, Reader};
use super::{Cell, Quantity, Style};
use crate::geometry::{RIGID_TOLERANCE, Rotation, Transform, Vector};
use denavit_symbolic::{Expr, equal};
use toml::Spanned;
use toml::de::DeValue;

/// The cells that a transform was given in.
#[derive(Default)]
pub(super) struct FrameCells {
    pub lengths: Vec<Cell>,
    pub angles: Vec<Cell>,
    /// The entries of a rotation matrix.
    pub entries: Vec<Cell>,
}

impl Reader<'_> {
    /// The transform; the identity if there is none in the file, `None` if it could not be read.
    pub fn frame(
        &mut self,
        value: Option<&Spanned<DeValue>>,
        what: &str,
    ) -> (Option<Transform<Expr>>, FrameCells) {
        let Some(value) = value else { return (Some(Transform::identity()), FrameCells::default()) };
        let Some(fields) = self.table(value, what) else { return (None, FrameCells::default()) };
        self.pose(&fields, &[])
    }

    /// The transform of a table that has `others` beside it.
    pub fn pose(&mut self, fields: &Fields, others: &[&str]) -> (Option<Transform<Expr>>, FrameCells) {
        let mut cells = FrameCells::default();
        self.unknown_keys(fields, &[&["xyz", "rpy", "matrix"], others].concat(), |key| {
            ["quaternion", "xyzw", "euler"]
                .contains(&key)
                .then(|| "give the rotation as `rpy` or `matrix`".into())
        });
        if let Some(matrix) = fields.get("matrix") {
            for key in ["xyz", "rpy"] {
                if let Some(other) = fields.get(key) {
                    self.out
                        .error(other.span(), format!("`{key}` beside `matrix`"))
                        .hint("give one or the other");
                }
            }
            let transform = self.matrix(matrix, &mut cells);
            return (transform, cells);
        }
        let zero = || vec![Cell::zero(fields.span.clone()); 3];
        let mut three = |key: &str, quantity| match fields.get(key) {
            Some(v) => self.list(v, &Style::of(quantity), key, 3),
            None => Some(zero()),
        };
        let (Some(xyz), Some(rpy)) = (three("xyz", Quantity::Length), three("rpy", Quantity::Angle)) else {
            return (None, cells);
        };
        let [x, y, z] = [0, 1, 2].map(|i| xyz[i].expr);
        let [roll, pitch, yaw] = [0, 1, 2].map(|i| rpy[i].expr);
        let rotation = Rotation::from_rpy(roll, pitch, yaw);
        (cells.lengths, cells.angles) = (xyz, rpy);
        (Some(Transform::from_rotation_translation(rotation, Vector([x, y, z]))), cells)
    }

    fn matrix(&mut self, value: &Spanned<DeValue>, cells: &mut FrameCells) -> Option<Transform<Expr>> {
        let rows = self.array(value, "matrix")?;
        if rows.len() != 4 {
            self.out.error(value.span(), format!("a matrix has four rows, not {}", rows.len()));
            return None;
        }
        let mut entries = vec![];
        for (i, row) in rows.iter().enumerate() {
            let row = self.array(row, "a row of the matrix").filter(|r| r.len() == 4).or_else(|| {
                self.out.error(row.span(), "a row of the matrix has four entries");
                None
            })?;
            for (j, entry) in row.iter().enumerate() {
                let length = j == 3 && i < 3;
                let quantity = if length { Quantity::Length } else { Quantity::Number };
                let cell = self.cell(entry, &Style::of(quantity))?;
                entries.push(cell.expr);
                if length { cells.lengths.push(cell) } else { cells.entries.push(cell) }
            }
        }
        let e = |i: usize, j: usize| entries[4 * i + j];
        // Where it is has no part in whether it is rigid.
        let at = |i: usize, j: usize| if j == 3 && i < 3 { Expr::int(0) } else { e(i, j) };
        let numbers: Result<Vec<f64>, _> = (0..16).map(|k| at(k / 4, k % 4).eval(|_| None)).collect();
        if let Ok(n) = numbers {
            let m = [0, 1, 2, 3].map(|i| [0, 1, 2, 3].map(|j| n[4 * i + j]));
            if let Err(why) = Transform::from_matrix(m) {
                self.out.error(value.span(), format!("not a rigid transform: {why}"));
                return None;
            }
        }
        let rotation = Rotation::from_rows([0, 1, 2].map(|i| [0, 1, 2].map(|j| e(i, j))));
        if !self.is_exact_rotation(&rotation, [e(3, 0), e(3, 1), e(3, 2), e(3, 3)], value) {
            return None;
        }
        Some(Transform::from_rotation_translation(rotation, Vector([e(0, 3), e(1, 3), e(2, 3)])))
    }

    /// RᵀR = 1, det R = 1 and the last row, exactly; numbers may be off by rounding, which is only noted.
    fn is_exact_rotation(&mut self, r: &Rotation<Expr>, last: [Expr; 4], value: &Spanned<DeValue>) -> bool {
        let product = r.inverse() * *r;
        let identity = Rotation::<Expr>::identity();
        let mut pairs: Vec<(Expr, Expr)> =
            (0..9).map(|k| (product[(k / 3, k % 3)], identity[(k / 3, k % 3)])).collect();
        pairs.push((r.determinant(), Expr::int(1)));
        pairs.extend(last.into_iter().zip([0, 0, 0, 1].map(Expr::int)));
        if pairs.iter().all(|&(a, b)| equal(a, b).is_equal()) {
            return true;
        }
        let near = |(a, b): &(Expr, Expr)| {
            let apart = a.eval(|_| None).ok().zip(b.eval(|_| None).ok()).map(|(a, b)| (a - b).abs());
            apart.is_some_and(|x| x <= RIGID_TOLERANCE)
        };
        let constant = pairs.iter().all(near);
        if constant {
            self.out
                .note(value.span(), "the matrix is a rotation up to rounding only")
                .hint("`rpy` in degrees is exact, and so are entries such as \"sqrt(2)/2\"");
        } else {
            self.out.error(
                value.span(),
                "not a rigid transform: the columns are not proved to be orthogonal unit vectors",
            );
        }
        constant
    }
}
