//! Recordings of arms whose masses are known: the torques are those of the recursion of Newton and Euler, not of the regressor.

use denavit::Description;
use denavit::catalogue;
use denavit::dynamics::{Drive, Dynamics, drive_torques};
use denavit::geometry::{Body, Vector};
use denavit::random::Random;
use denavit_identification::{Columns, Model, Sought, What};
use std::f64::consts::TAU;

/// Normal deviations.
pub struct Dice(Random);

impl Dice {
    pub fn new(seed: u64) -> Self {
        let mut random = Random(seed.wrapping_mul(7919) + 13);
        (0..5).for_each(|_| {
            random.unit();
        });
        Dice(random)
    }

    pub fn unit(&mut self) -> f64 {
        self.0.unit()
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    pub fn normal(&mut self) -> f64 {
        (-2.0 * self.unit().max(1e-300).ln()).sqrt() * (TAU * self.unit()).cos()
    }

    /// A body of a few mass points, which is one that can be.
    pub fn body(&mut self, mass: f64, size: f64) -> Body<f64> {
        let mut body = Body::nothing();
        for _ in 0..8 {
            let at = Vector([0, 1, 2].map(|_| self.between(-size, size)));
            body = body + Body::about_centre(mass * self.between(0.5, 1.5) / 8.0, at, [0.0; 6]);
        }
        body
    }
}

/// A table at random: joints that turn and slide, twists that are quarters or any.
pub fn table(seed: u64) -> String {
    let mut dice = Dice::new(seed + 500);
    let mut text = "convention = \"standard\"\n".to_string();
    let joints = 3 + (dice.unit() * 4.0) as usize;
    for k in 1..=joints {
        let twist = [0.0, 90.0, -90.0, dice.between(-80.0, 80.0)][(dice.unit() * 4.0) as usize];
        let mut length = || if dice.unit() < 0.5 { 0.0 } else { dice.between(0.1, 0.5) };
        let (a, d) = (length(), length());
        let moves = match dice.unit() < 0.2 {
            true => format!("d = \"q{k} + {d}\"\n"),
            false => format!("theta = \"q{k}\"\nd = \"{d} m\"\n"),
        };
        text += &format!("[[joints]]\n{moves}a = \"{a} m\"\nalpha = \"{twist} deg\"\n");
    }
    text
}

/// An arm of the catalogue, or one that is written out.
pub fn arm(name: &str) -> Description {
    catalogue::robot(name).unwrap_or_else(|| {
        let (found, _) = denavit::description::read_robot(name).expect("it can be read");
        match found {
            denavit::description::Described::Chain(d) => *d,
            _ => panic!("a chain"),
        }
    })
}

/// What an arm is in truth.
pub struct Truth {
    pub description: Description,
    pub model: Model,
    pub dynamics: Dynamics<f64>,
    pub offsets: Vec<f64>,
}

/// With masses and drives at random.
pub fn truth(name: &str, seed: u64, sought: Sought) -> Truth {
    let description = arm(name);
    let model = Model::new(&description, sought).expect("a model");
    let mut dice = Dice::new(seed);
    let mut dynamics = model.arm.clone();
    let links = dynamics.links.len();
    for (k, link) in dynamics.links.iter_mut().enumerate() {
        link.body = dice.body(12.0 * (links - k) as f64 / links as f64 + 1.0, 0.12);
    }
    let rotors = f64::from(u8::from(sought.rotors));
    for drive in &mut dynamics.drives {
        *drive = Drive {
            rotor: rotors * dice.between(0.1, 0.6),
            viscous: dice.between(0.5, 4.0),
            coulomb: dice.between(0.5, 3.0),
        };
    }
    let offsets = (0..model.joints()).map(|_| dice.between(-0.5, 0.5)).collect();
    Truth { description, model, dynamics, offsets }
}

impl Truth {
    /// The values of the model's parameters.
    pub fn values(&self) -> Vec<f64> {
        let bodies: Vec<Body<f64>> = self.dynamics.links.iter().map(|l| l.body).collect();
        let base = self.model.base_of(&bodies);
        let of = |what: What| match what {
            What::Base(k) => base[k],
            What::Rotor(j) => self.dynamics.drives[j].rotor,
            What::Viscous(j) => self.dynamics.drives[j].viscous,
            What::Coulomb(j) => self.dynamics.drives[j].coulomb,
            What::Offset(j) => self.offsets[j],
        };
        self.model.parameters.iter().map(|p| of(p.what)).collect()
    }
}

/// How a recording is made.
#[derive(Clone, Copy)]
pub struct Setting {
    pub seconds: f64,
    pub rate: f64,
    /// The noise of positions, rad or m.
    pub positions: f64,
    /// The noise of torques, as a part of each joint's.
    pub torques: f64,
    pub seed: u64,
}

pub const USUAL: Setting = Setting { seconds: 30.0, rate: 200.0, positions: 2e-5, torques: 0.03, seed: 1 };

/// A recording of a smooth motion, with white noise.
pub fn recording(truth: &Truth, setting: &Setting) -> Columns {
    let n = truth.model.joints();
    let mut dice = Dice::new(setting.seed + 1000);
    let waves: Vec<Vec<[f64; 3]>> = (0..n)
        .map(|j| {
            let size = if truth.model.turns[j] { 1.0 } else { 0.15 };
            (0..4)
                .map(|k| {
                    let w = TAU * dice.between(0.08 + 0.1 * f64::from(k), 0.18 + 0.1 * f64::from(k));
                    [size * dice.between(0.3, 0.7), w, dice.between(0.0, TAU)]
                })
                .collect()
        })
        .collect();
    let state = |t: f64| -> [Vec<f64>; 3] {
        let sum = |f: &dyn Fn(&[f64; 3]) -> f64| waves.iter().map(|own| own.iter().map(f).sum()).collect();
        [
            sum(&|[a, w, p]| a * (w * t + p).sin()),
            sum(&|[a, w, p]| a * w * (w * t + p).cos()),
            sum(&|[a, w, p]| -a * w * w * (w * t + p).sin()),
        ]
    };
    let rows = (setting.seconds * setting.rate) as usize;
    let mut columns = Columns {
        time: (0..rows).map(|r| r as f64 / setting.rate).collect(),
        q: vec![vec![]; n],
        tau: vec![vec![]; n],
        ..Columns::default()
    };
    for &t in &columns.time {
        let [q, qd, qdd] = state(t);
        let tau = drive_torques(&truth.dynamics, &q, &qd, &qdd, None);
        for j in 0..n {
            columns.q[j].push(q[j] + setting.positions * dice.normal());
            columns.tau[j].push(tau[j] + truth.offsets[j]);
        }
    }
    for tau in &mut columns.tau {
        let size = (tau.iter().map(|x| x * x).sum::<f64>() / rows as f64).sqrt();
        tau.iter_mut().for_each(|x| *x += setting.torques * size * dice.normal());
    }
    columns
}
