//! How what the steps find moves with the pose: to first order, at the first sample.

use super::algebra::{Algebra, Kind};
use super::chain::NormalChain;
use super::drivers::Lattice;
use super::known::{Samples, Unknown, axis_unknown};
use super::plan::{Form, Norm, Step};
use denavit_symbolic::poly::{Atom, Poly};

/// A change of the pose's entries, and how angles and displacements go with it, those that the steps have found so far.
pub struct Tangent<'a> {
    chain: &'a NormalChain,
    samples: &'a Samples,
    pose: [f64; 12],
    /// The angles that are known, and how fast each changes.
    learnt: Lattice,
    rates: Vec<f64>,
    slides: Vec<f64>,
}

impl<'a> Tangent<'a> {
    /// Before the first step.
    pub fn new(chain: &'a NormalChain, samples: &'a Samples, given: &[usize], pose: [f64; 12]) -> Self {
        let mut learnt = Lattice::default();
        let angles = given.iter().filter_map(|&k| match axis_unknown(chain, k) {
            Unknown::Angle(d) => Some(chain.form(d)),
            Unknown::Slide(_) => None,
        });
        let turning = angles.map(|form| learnt.add(&form)).count();
        Tangent {
            chain,
            samples,
            pose,
            rates: vec![0.0; turning],
            learnt,
            slides: vec![0.0; chain.axes.len()],
        }
    }

    /// The unknown of a step moves as the step's formula has it.
    pub fn learn(&mut self, step: &Step) {
        let rate = self.rate_of(step);
        match step.unknown {
            Unknown::Slide(k) => self.slides[k] = rate,
            Unknown::Angle(d) => {
                let form = self.chain.form(d);
                if self.learnt.made(&form).is_none() {
                    self.learnt.add(&form);
                    self.rates.push(rate);
                }
            }
        }
    }

    /// The changes of all atoms.
    pub fn direction(&self) -> Vec<f64> {
        let values = self.samples.first();
        let of = |a: usize| {
            let kind = self.chain.algebra.kind(a as Atom);
            let turn = |n: usize| {
                let made = self.learnt.made(&self.chain.forms[n]).unwrap_or_default();
                made.iter().zip(&self.rates).map(|(x, rate)| *x as f64 * rate).sum::<f64>()
            };
            let partner = |kind: Kind| self.chain.algebra.find(kind).map_or(0.0, |b| values[b as usize]);
            match kind {
                Kind::Pose(k) => self.pose[k],
                Kind::Cos(n) => -partner(Kind::Sin(n)) * turn(n),
                Kind::Sin(n) => partner(Kind::Cos(n)) * turn(n),
                Kind::Slide(k) => self.slides[k],
                Kind::Constant(_) => 0.0,
            }
        };
        (0..values.len()).map(of).collect()
    }

    /// How fast the unknown of a step changes; 0 where its formula leaves it open.
    fn rate_of(&self, step: &Step) -> f64 {
        let direction = self.direction();
        let values = self.samples.first();
        let value = |p: &Poly| Algebra::value(p, values);
        let rate = |p: &Poly| self.samples.derivative(p, &direction);
        let of_norm =
            |n: &Norm| n.squares.iter().map(|s| 2.0 * value(s) * rate(s)).sum::<f64>() + rate(&n.plus);
        let atom = |kind: Kind| self.chain.algebra.find(kind).map_or(0.0, |a| values[a as usize]);
        let (c, s, r) = match step.unknown {
            Unknown::Angle(d) => {
                let n = self.chain.number(d);
                (atom(Kind::Cos(n)), atom(Kind::Sin(n)), 0.0)
            }
            Unknown::Slide(k) => (0.0, 0.0, atom(Kind::Slide(k))),
        };
        let found = match &step.form {
            Form::Ratio { numerator, denominator } => {
                (rate(numerator) - r * rate(denominator)) / value(denominator)
            }
            Form::Quadratic { a, b, c } => {
                -(rate(a) * r * r + 2.0 * rate(b) * r + of_norm(c)) / (2.0 * (value(a) * r + value(b)))
            }
            Form::Quartic(all) => {
                let [cc, cs, fc, fs, _] = all.each_ref().map(|n| value(&n.plus));
                let powers = [c * c, c * s, c, s, 1.0];
                let moved: f64 = all.iter().zip(powers).map(|(n, p)| of_norm(n) * p).sum();
                -moved / (-2.0 * cc * c * s + cs * (c * c - s * s) - fc * s + fs * c)
            }
            Form::Line | Form::Sincos | Form::Pair { .. } => {
                // a·ċ + b·ṡ = −(ȧ c + ḃ s − ċ₀)
                let rows: Vec<[f64; 3]> = step
                    .rows
                    .iter()
                    .map(|row| {
                        let left = of_norm(&row.c) - rate(&row.a) * c - rate(&row.b) * s;
                        [value(&row.a), value(&row.b), left]
                    })
                    .collect();
                match rows[..] {
                    [[a, b, left]] => left / (b * c - a * s),
                    [[a, b, left], [e, f, right], ..] => {
                        let determinant = a * f - b * e;
                        let (dc, ds) = (left * f - b * right, a * right - left * e);
                        (c * ds - s * dc) / determinant
                    }
                    [] => 0.0,
                }
            }
        };
        if found.is_finite() { found } else { 0.0 }
    }
}
