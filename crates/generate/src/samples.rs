//! Configurations that tests hold generated code to.

use denavit::description::{Description, JointKind};
use denavit::robot::Robot;
use denavit_emit::Vector;
use denavit_program::{Extended, Program};
use denavit_symbolic::{Expr, Rational, Symbol};
use std::f64::consts::{FRAC_PI_2, PI};

/// Seed of the random ones.
const SEED: u64 = 0x5EED;
/// How many are random.
const RANDOM: usize = 12;

/// A configuration for a test, with values for the parameters.
pub(super) struct Sample {
    pub variables: Vec<f64>,
    pub parameters: Vec<f64>,
    /// A bound on the distances between origins, m.
    pub reach: f64,
}

impl Sample {
    /// The value of an input of the program.
    pub fn value(&self, program: &Program, s: Symbol) -> Option<f64> {
        let place = |list: &[Symbol]| list.iter().position(|x| *x == s);
        let variable = place(program.variables()).map(|k| self.variables[k]);
        variable.or_else(|| place(program.parameters()).map(|k| self.parameters[k]))
    }

    /// The results of the reference here.
    pub fn vector(&self, reference: &Program) -> Vector {
        let exact = reference.eval(|s| self.value(reference, s).map(Extended::from));
        let exact = exact.expect("a sample has a value for every input");
        let results = exact.iter().map(Extended::to_f64).collect();
        Vector { variables: self.variables.clone(), parameters: self.parameters.clone(), results }
    }
}

/// What lengths of an arm are compared with, metres: 1, or a power of ten for an arm in micrometres or kilometres.
pub(super) fn unit(reach: f64) -> f64 {
    if reach == 0.0 || (0.03..30.0).contains(&reach) { 1.0 } else { 10_f64.powf(reach.log10().round()) }
}

/// A bound on the distances between origins, m; 1 where there are none.
pub(super) fn size(samples: &[Sample]) -> f64 {
    let reach = samples.iter().map(|s| s.reach).fold(0.0, f64::max);
    if reach > 0.0 { reach } else { 1.0 }
}

/// Values of the parameters: those of the robot file, and others where it has none.
pub(super) fn parameters(d: &Description) -> Vec<f64> {
    let parameters = d.parameters.iter().enumerate();
    parameters.map(|(k, p)| p.number().unwrap_or_else(|| stand_in(k))).collect()
}

/// The description with these values in place of its parameters' missing ones.
pub(super) fn valued(d: &Description) -> Description {
    let mut new = d.clone();
    for (k, p) in new.parameters.iter_mut().enumerate() {
        let exact = || Rational::from_f64(stand_in(k)).map(Expr::from);
        p.value = p.value.or_else(exact);
    }
    new
}

/// For the parameter with this number.
fn stand_in(number: usize) -> f64 {
    0.25 + 0.0625 * number as f64
}

/// Zero, quarter turns, and random configurations inside (−π, π) and half a metre.
pub(super) fn samples(d: &Description) -> Vec<Sample> {
    configurations(&kinds(d)).into_iter().map(|q| sample(d, q)).collect()
}

/// The same of joints that move so.
pub(super) fn configurations(kinds: &[JointKind]) -> Vec<Vec<f64>> {
    special_angles(kinds).into_iter().chain(random(kinds, RANDOM)).collect()
}

fn kinds(d: &Description) -> Vec<JointKind> {
    d.variables().into_iter().map(|v| v.kind).collect()
}

/// The first of [`samples`].
pub(super) fn few(d: &Description) -> Vec<Sample> {
    let kinds = kinds(d);
    let all = special_angles(&kinds).into_iter().chain(random(&kinds, RANDOM / 2));
    all.map(|q| sample(d, q)).collect()
}

/// Random configurations with a joint at zero, each joint in turn.
pub(super) fn special(d: &Description) -> Vec<Sample> {
    let n = d.variables().len();
    let configurations = random(&kinds(d), RANDOM / 2 + n).split_off(RANDOM / 2);
    let zeroed = configurations.into_iter().enumerate().map(|(k, mut q)| {
        q[k] = 0.0;
        sample(d, q)
    });
    zeroed.collect()
}

/// Zero and quarter turns.
fn special_angles(kinds: &[JointKind]) -> Vec<Vec<f64>> {
    let quarters = |k: usize, kind| match kind {
        JointKind::Revolute => [FRAC_PI_2, PI, -FRAC_PI_2, 0.0][k % 4],
        JointKind::Prismatic => [0.125, 0.5, 0.25, 0.0][k % 4],
    };
    let turned = |shift| kinds.iter().enumerate().map(|(k, kind)| quarters(k + shift, *kind)).collect();
    [vec![0.0; kinds.len()]].into_iter().chain((0..3).map(turned)).collect()
}

/// Knuth's linear congruential generator, the upper bits.
pub(super) struct Uniform(u64);

impl Uniform {
    /// From the beginning.
    pub fn new() -> Self {
        Uniform(SEED)
    }

    /// A number between two.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let unit = (self.0 >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * unit
    }
}

fn random(kinds: &[JointKind], count: usize) -> Vec<Vec<f64>> {
    let mut random = Uniform::new();
    let mut value = |kind| match kind {
        JointKind::Revolute => PI * random.between(-1.0, 1.0),
        JointKind::Prismatic => 0.5 * random.between(0.0, 1.0),
    };
    (0..count).map(|_| kinds.iter().map(|&kind| value(kind)).collect()).collect()
}

/// A configuration with parameters, and a bound on distances.
fn sample(d: &Description, q: Vec<f64>) -> Sample {
    let variables = d.variables();
    let parameters = parameters(d);
    let value = |s: Symbol| {
        let variable = variables.iter().position(|v| v.symbol == s).map(|k| q[k]);
        variable.or_else(|| d.parameters.iter().position(|p| p.symbol == s).map(|k| parameters[k]))
    };
    let symbolic = Robot::symbolic(d);
    let symbols: Vec<Expr> = variables.iter().map(|v| v.symbol.into()).collect();
    let links = symbolic.links.iter().map(|link| link.transform(&symbols));
    let lengths = links.chain([symbolic.base, symbolic.tool]).map(|x| {
        let square: f64 = x.translation.0.iter().map(|e| e.eval(value).unwrap_or(0.0).powi(2)).sum();
        square.sqrt()
    });
    let reach = lengths.sum();
    Sample { variables: q, parameters, reach }
}
