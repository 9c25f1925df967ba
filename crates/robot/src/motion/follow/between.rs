//! Joints between samples.

use crate::motion::path::{JointPath, PathPoint, Side};

/// A cubic between each two samples, with given derivatives.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct HermitePath {
    /// The parameters, increasing from 0.
    s: Vec<f64>,
    q: Vec<Vec<f64>>,
    /// Derivatives by s, before and behind each sample: they differ at corners.
    slopes: Vec<[Vec<f64>; 2]>,
}

impl HermitePath {
    /// A path that starts here.
    pub(super) fn start(q: Vec<f64>, slope: Vec<f64>) -> Self {
        HermitePath { s: vec![0.0], q: vec![q], slopes: vec![[slope.clone(), slope]] }
    }

    /// Goes on to a sample.
    pub(super) fn push(&mut self, s: f64, q: Vec<f64>, slopes: [Vec<f64>; 2]) {
        self.s.push(s);
        self.q.push(q);
        self.slopes.push(slopes);
    }

    /// The parameters of the samples.
    pub fn parameters(&self) -> &[f64] {
        &self.s
    }

    /// The configurations of the samples.
    pub fn samples(&self) -> &[Vec<f64>] {
        &self.q
    }

    /// How fast each joint is at most between the samples around a parameter, by s: no cubic leaves the hull of its
    /// control points.
    pub(super) fn fastest(&self, s: f64) -> Vec<f64> {
        let k = self.s.partition_point(|x| *x <= s).clamp(1, self.s.len() - 1) - 1;
        let h = self.s[k + 1] - self.s[k];
        (0..self.q[k].len())
            .map(|j| {
                let (m, n) = (self.slopes[k][1][j], self.slopes[k + 1][0][j]);
                let middle = 3.0 * (self.q[k + 1][j] - self.q[k][j]) / h - m - n;
                m.abs().max(n.abs()).max(middle.abs())
            })
            .collect()
    }

    /// The value between two configurations with slopes, at u in [0, 1] of a step h.
    pub(super) fn value(h: f64, u: f64, from: (&[f64], &[f64]), to: (&[f64], &[f64])) -> Vec<f64> {
        let (a, b) = (1.0 - u, u);
        let (p, q) = (a * a * (1.0 + 2.0 * b), b * b * (1.0 + 2.0 * a));
        let (m, n) = (h * a * a * b, -h * a * b * b);
        (0..from.0.len()).map(|j| p * from.0[j] + q * to.0[j] + m * from.1[j] + n * to.1[j]).collect()
    }
}

impl JointPath for HermitePath {
    fn dof(&self) -> usize {
        self.q[0].len()
    }

    fn end(&self) -> f64 {
        self.s[self.s.len() - 1]
    }

    fn eval_into(&self, s: f64, side: Side, point: &mut PathPoint) {
        let last = self.s.len() - 1;
        if last == 0 {
            point.q.copy_from_slice(&self.q[0]);
            [&mut point.dq, &mut point.ddq, &mut point.dddq].into_iter().for_each(|v| v.fill(0.0));
            return;
        }
        let s = s.clamp(0.0, self.end());
        let k = match side {
            Side::Behind => self.s.partition_point(|x| *x <= s),
            Side::Before => self.s.partition_point(|x| *x < s),
        };
        let k = k.clamp(1, last) - 1;
        let h = self.s[k + 1] - self.s[k];
        let u = (s - self.s[k]) / h;
        for j in 0..self.dof() {
            let (p, q) = (self.q[k][j], self.q[k + 1][j]);
            let (m, n) = (h * self.slopes[k][1][j], h * self.slopes[k + 1][0][j]);
            let (c2, c3) = (3.0 * (q - p) - 2.0 * m - n, 2.0 * (p - q) + m + n);
            point.q[j] = p + u * (m + u * (c2 + u * c3));
            point.dq[j] = (m + u * (2.0 * c2 + 3.0 * u * c3)) / h;
            point.ddq[j] = (2.0 * c2 + 6.0 * u * c3) / (h * h);
            point.dddq[j] = 6.0 * c3 / (h * h * h);
        }
    }

    fn knots(&self) -> &[f64] {
        self.s.get(1..self.s.len() - 1).unwrap_or(&[])
    }
}
