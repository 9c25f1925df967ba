//! What joint columns may hold: unit, order, signs, zeros, gears, couplings, each with what it costs to believe it.

use crate::arm::Arm;
use std::f64::consts::FRAC_PI_2;

/// In which unit all columns of the joints are, beside what they are said to be in.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Unit {
    /// As they are said to be: radians and metres, unless a header says otherwise.
    AsSaid,
    /// Degrees where radians are said.
    Degrees,
    /// Radians where degrees are said.
    Radians,
    /// −100 to 100 for the range of each joint.
    Hundred,
}

/// How one joint's column, or two, may differ from the model.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Move {
    /// The sign is reversed.
    Flip(usize),
    /// The column is so many quarter turns ahead.
    Quarter(usize, i8),
    /// Two columns are exchanged.
    Swap(usize, usize),
    /// The column holds the joint plus (1) or minus (−1) the one before it.
    Couple(usize, i8),
    /// This column is in degrees.
    Degrees(usize),
    /// The column counts twice (2) or half (−2) of the joint.
    Gain(usize, i8),
}

/// What joint columns hold.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Hypothesis {
    /// The unit of all columns.
    pub unit: Unit,
    /// Columns that are no joint's.
    pub dropped: Vec<usize>,
    /// Whether the columns are in reversed order.
    pub reversed: bool,
    /// What else, in order.
    pub moves: Vec<Move>,
}

/// A hypothesis ready to compute with: each joint a multiple of a column and a constant, then couplings in order.
#[derive(Clone, PartialEq, Debug)]
pub struct Map {
    /// The column of each joint.
    pub pick: Vec<usize>,
    /// By what it is multiplied.
    pub scale: Vec<f64>,
    /// What is added then.
    pub shift: Vec<f64>,
    /// Joints from which a multiple of the one before is taken.
    pub couplings: Vec<(usize, f64)>,
}

impl Move {
    fn cost(self) -> f64 {
        match self {
            Move::Flip(_) => 2.1,
            Move::Quarter(_, 2) => 2.45,
            Move::Quarter(..) => 2.1,
            Move::Swap(..) | Move::Degrees(_) => 2.8,
            Move::Couple(..) => 3.5,
            Move::Gain(..) => 3.15,
        }
    }

    /// Every one that an arm allows.
    pub fn all(arm: &Arm) -> Vec<Move> {
        let n = arm.joints();
        let turning: Vec<usize> = arm.turning().collect();
        let mut all: Vec<Move> = (0..n).map(Move::Flip).collect();
        all.extend(turning.iter().flat_map(|&i| [1, 2, -1].map(|k| Move::Quarter(i, k))));
        let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j)));
        all.extend(pairs.filter(|&(i, j)| arm.turns[i] == arm.turns[j]).map(|(i, j)| Move::Swap(i, j)));
        let coupled = turning.iter().filter(|&&i| i > 0 && arm.turns[i - 1]);
        all.extend(coupled.flat_map(|&i| [1, -1].map(|s| Move::Couple(i, s))));
        all.extend(turning.iter().map(|&i| Move::Degrees(i)));
        all.extend(turning.iter().flat_map(|&i| [2, -2].map(|g| Move::Gain(i, g))));
        all
    }
}

impl Hypothesis {
    /// The columns as they stand.
    pub fn plain(unit: Unit, dropped: Vec<usize>, reversed: bool) -> Self {
        Hypothesis { unit, dropped, reversed, moves: vec![] }
    }

    /// With one more.
    pub fn plus(&self, one: Move) -> Self {
        let mut moves = self.moves.clone();
        moves.push(one);
        Hypothesis { moves, ..self.clone() }
    }

    /// The same whatever the order of its parts.
    pub fn key(&self) -> Self {
        let mut key = self.clone();
        key.moves.sort_unstable();
        key
    }

    /// What it costs to believe it, nats.
    pub fn cost(&self) -> f64 {
        let unit = match self.unit {
            Unit::AsSaid => 0.0,
            Unit::Degrees | Unit::Radians => 1.4,
            Unit::Hundred => 2.1,
        };
        let order = if self.reversed { 2.1 } else { 0.0 };
        unit + 1.4 * self.dropped.len() as f64 + order + self.moves.iter().map(|m| m.cost()).sum::<f64>()
    }

    /// Ready to compute with, for so many columns.
    pub fn map(&self, columns: usize, arm: &Arm) -> Map {
        let n = arm.joints();
        let mut pick: Vec<usize> = (0..columns).filter(|c| !self.dropped.contains(c)).take(n).collect();
        if self.reversed {
            pick.reverse();
        }
        for one in &self.moves {
            if let Move::Swap(i, j) = *one {
                pick.swap(i, j);
            }
        }
        let degree = 1_f64.to_radians();
        let (mut scale, mut shift) = (vec![1.0; n], vec![0.0; n]);
        for i in 0..n {
            let [low, high] = arm.limits[i];
            match self.unit {
                Unit::Degrees if arm.turns[i] => scale[i] = degree,
                Unit::Radians if arm.turns[i] => scale[i] = 1.0 / degree,
                Unit::Hundred => (scale[i], shift[i]) = ((high - low) / 200.0, 0.5 * (low + high)),
                _ => {}
            }
        }
        let mut couplings = vec![];
        for one in &self.moves {
            let by = |i: usize, k: f64, scale: &mut Vec<f64>, shift: &mut Vec<f64>| {
                (scale[i], shift[i]) = (k * scale[i], k * shift[i]);
            };
            match *one {
                Move::Swap(..) => {}
                Move::Flip(i) => by(i, -1.0, &mut scale, &mut shift),
                Move::Degrees(i) => by(i, degree, &mut scale, &mut shift),
                Move::Gain(i, g) => by(i, if g > 0 { 0.5 } else { 2.0 }, &mut scale, &mut shift),
                Move::Quarter(i, k) => shift[i] -= f64::from(k) * FRAC_PI_2,
                Move::Couple(i, s) => couplings.push((i, f64::from(s))),
            }
        }
        Map { pick, scale, shift, couplings }
    }
}

impl Map {
    /// The joints out of a row of columns.
    pub fn apply(&self, row: &[f64], q: &mut Vec<f64>) {
        q.clear();
        let parts = self.pick.iter().zip(&self.scale).zip(&self.shift);
        q.extend(parts.map(|((&c, k), b)| k * row[c] + b));
        for &(i, k) in &self.couplings {
            q[i] -= k * q[i - 1];
        }
    }
}
