//! Paths that are polynomials piece by piece.

use super::{JointPath, PathPoint, Side};

/// A path of pieces, each a polynomial in s − sᵢ for every joint, all of one degree (at most five).
#[derive(Clone, Debug, PartialEq)]
pub struct PiecewisePath {
    dof: usize,
    /// Coefficients of a joint and piece: one more than the degree.
    order: usize,
    /// Parameters of the ends of all pieces: one more than there are pieces.
    breaks: Vec<f64>,
    /// `coefficients[(piece * order + power) * dof + joint]`
    coefficients: Vec<f64>,
}

impl PiecewisePath {
    /// Pieces between `breaks`, with `order` coefficients a joint given by `coefficient(piece, joint, power)`.
    pub(super) fn new(
        dof: usize,
        order: usize,
        breaks: Vec<f64>,
        coefficient: impl Fn(usize, usize, usize) -> f64,
    ) -> Self {
        let mut coefficients = Vec::with_capacity((breaks.len() - 1) * order * dof);
        for piece in 0..breaks.len() - 1 {
            for power in 0..order {
                coefficients.extend((0..dof).map(|joint| coefficient(piece, joint, power)));
            }
        }
        Self { dof, order, breaks, coefficients }
    }

    /// Parameters of the ends of all pieces; those of the way-points if the path is a spline.
    pub fn breaks(&self) -> &[f64] {
        &self.breaks
    }

    fn piece(&self, s: f64, side: Side) -> usize {
        let inner = self.knots();
        match side {
            Side::Behind => inner.partition_point(|k| *k <= s),
            Side::Before => inner.partition_point(|k| *k < s),
        }
    }

    /// Horner's rule for the value and three derivatives at once, over all joints.
    fn horner<const N: usize>(&self, piece: usize, h: f64, point: &mut PathPoint) {
        let dof = self.dof;
        let block = &self.coefficients[piece * N * dof..(piece + 1) * N * dof];
        let rows: [&[f64]; N] = std::array::from_fn(|k| &block[k * dof..(k + 1) * dof]);
        let (q, dq) = (&mut point.q[..dof], &mut point.dq[..dof]);
        let (ddq, dddq) = (&mut point.ddq[..dof], &mut point.dddq[..dof]);
        for joint in 0..dof {
            let [mut p0, mut p1, mut p2, mut p3] = [0.0; 4];
            for row in rows.iter().rev() {
                p3 = p3 * h + p2;
                p2 = p2 * h + p1;
                p1 = p1 * h + p0;
                p0 = p0 * h + row[joint];
            }
            (q[joint], dq[joint], ddq[joint], dddq[joint]) = (p0, p1, 2.0 * p2, 6.0 * p3);
        }
    }
}

impl JointPath for PiecewisePath {
    fn dof(&self) -> usize {
        self.dof
    }

    fn end(&self) -> f64 {
        self.breaks[self.breaks.len() - 1]
    }

    fn eval_into(&self, s: f64, side: Side, point: &mut PathPoint) {
        let s = s.clamp(0.0, self.end());
        let piece = self.piece(s, side);
        let h = s - self.breaks[piece];
        match self.order {
            2 => self.horner::<2>(piece, h, point),
            3 => self.horner::<3>(piece, h, point),
            4 => self.horner::<4>(piece, h, point),
            5 => self.horner::<5>(piece, h, point),
            _ => self.horner::<6>(piece, h, point),
        }
    }

    fn knots(&self) -> &[f64] {
        &self.breaks[1..self.breaks.len() - 1]
    }
}
