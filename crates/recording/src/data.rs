//! What the search looks at: a few hundred rows, drawn once, decoded in every format.

use crate::arm::Arm;
use crate::columns::{Prepared, cubic, median, noise, places};
use crate::decode::{Format, candidates};
use crate::recording::HoldError;
use crate::turns::{between, log};
use denavit::geometry::{Rotation, Vector};
use denavit::random::Random;

/// Pairs of rows whose increments are compared.
const PAIRS: usize = 90;
/// Rows to fit on, and others to judge by.
const FIT: usize = 48;
const HELD: usize = 100;
/// Pairs of fitted rows for the axes of increments.
const AXES: usize = 80;
/// Rows this near to an end of the recording have no neighbours for a lag.
const MARGIN: usize = 6;

/// Third differences above this part of a column's deviation are those of motion; below this angle between rows, radians, noise
/// may be as large.
const SPARSE: f64 = 0.35;
const LITTLE: f64 = 0.1;

/// A recorded pose.
pub type Recorded = (Rotation<f64>, Vector<f64>);

/// How the recorded pose is meant.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Direction {
    /// The hand in the base.
    Direct,
    /// The base in the hand.
    Inverse,
    /// The position of the hand, and the orientation of the base in it.
    Transposed,
}

impl Direction {
    /// All of them.
    pub const ALL: [Self; 3] = [Direction::Direct, Direction::Inverse, Direction::Transposed];

    /// The hand in the base, out of what is recorded.
    pub fn read(self, (r, p): Recorded) -> Recorded {
        match self {
            Direction::Direct => (r, p),
            Direction::Inverse => (r.inverse(), -(r.inverse() * p)),
            Direction::Transposed => (r.inverse(), p),
        }
    }
}

/// The orientation in one format.
pub struct Decoded {
    /// The format.
    pub format: Format,
    /// What it costs to believe it, nats.
    pub cost: f64,
    /// How it turns between the rows of each pair, radians.
    pub angles: Vec<f64>,
    /// Its noise, radians.
    pub noise: f64,
}

/// Columns with the rows that the search looks at.
pub struct Data<'a> {
    /// The columns.
    pub columns: &'a Prepared,
    /// The arm that they are held against.
    pub arm: &'a Arm,
    /// Rows of each pair.
    pub pairs: Vec<(usize, usize)>,
    /// Rows to fit on.
    pub fit: Vec<usize>,
    /// Rows to judge by.
    pub held: Vec<usize>,
    /// Pairs of rows to fit on, by their place among them.
    pub axes: Vec<(usize, usize)>,
    /// The formats.
    pub decoded: Vec<Decoded>,
    /// The noise of the position, in its own unit.
    pub noise_position: f64,
    /// The noise of each joint's column, in its own unit.
    pub noise_columns: Vec<f64>,
    /// Whether rows are too far apart for the noise to be seen: third differences are as large as the motion.
    pub is_sparse: bool,
}

impl<'a> Data<'a> {
    /// Draws the rows and decodes them.
    ///
    /// # Errors
    /// If the orientation cannot be read in any format, or too few rows are left.
    pub fn new(columns: &'a Prepared, arm: &'a Arm, known: Option<Format>) -> Result<Self, HoldError> {
        let rotation: Vec<&[f64]> = columns.rotation.iter().map(Vec::as_slice).collect();
        let sample = spread(&columns.good, 2000);
        let mut formats = match known {
            Some(format) => vec![(format, 0.0)],
            None => candidates(&rotation, &sample),
        };
        if columns.rotation_degrees {
            // They are radians already.
            formats.iter_mut().for_each(|f| f.0.degrees = false);
        }
        let row = |r: usize| rotation.iter().map(|c| c[r]).collect::<Vec<f64>>();
        let is_read = |r: &usize| formats.iter().all(|f| f.0.read(&row(*r)).is_some());
        if formats.is_empty() {
            return Err(HoldError::NoOrientation(sample.first().copied().unwrap_or(0)));
        }
        let inner = |r: &usize| {
            let from = r.saturating_sub(MARGIN) + 1;
            r + MARGIN < columns.follows.len()
                && *r >= MARGIN
                && (from..=r + MARGIN).all(|k| columns.follows[k])
        };
        let readable: Vec<usize> = columns.good.iter().copied().filter(is_read).collect();
        let inside: Vec<usize> = readable.iter().copied().filter(inner).collect();
        let good = if 2 * inside.len() > readable.len() && inside.len() >= 60 { inside } else { readable };
        if good.len() < crate::recording::LEAST {
            return Err(HoldError::Rows { whole: good.len(), all: columns.position.len() });
        }
        let mut random = Random(1);
        let any = |n: usize, random: &mut Random| ((random.unit() * n as f64) as usize).min(n - 1);
        let pairs: Vec<(usize, usize)> = (0..PAIRS)
            .map(|_| (good[any(good.len(), &mut random)], good[any(good.len(), &mut random)]))
            .collect();
        let mut mixed = good.clone();
        for k in (1..mixed.len()).rev() {
            mixed.swap(k, any(k + 1, &mut random));
        }
        let count = FIT.min(mixed.len() / 2);
        let held: Vec<usize> = mixed[count..].iter().copied().take(HELD).collect();
        mixed.truncate(count);
        let axes = (0..AXES).map(|_| (any(count, &mut random), any(count, &mut random))).collect();
        let decoded = formats
            .into_iter()
            .map(|(format, cost)| {
                let turn = |r: usize| format.read(&row(r)).unwrap_or_else(Rotation::identity);
                let angles = pairs.iter().map(|&(s, t)| between(&turn(s), &turn(t))).collect();
                Decoded { format, cost, angles, noise: noise_of_turns(columns, &turn) }
            })
            .collect();
        let of = |k: usize| noise(&columns.follows, |r| columns.position[r][k]);
        let noise_position = (0..3).map(of).fold(0.0, f64::max);
        let noise_columns: Vec<f64> =
            columns.joints.iter().map(|c| noise(&columns.follows, |r| c[r])).collect();
        let spreads: Vec<f64> = columns.joints.iter().map(|c| spread_of(&good, |r| c[r])).collect();
        let parts: Vec<f64> = noise_columns.iter().zip(&spreads).map(|(n, s)| n / s.max(1e-12)).collect();
        let is_sparse = median(parts) > SPARSE || places(&columns.follows).is_empty();
        let mut data = Data {
            columns,
            arm,
            pairs,
            fit: mixed,
            held,
            axes,
            decoded,
            noise_position,
            noise_columns,
            is_sparse,
        };
        // What moves less than noise may be noise.
        let turned: f64 = median(data.decoded.iter().map(|d| median(d.angles.clone())).collect());
        data.is_sparse &= turned > LITTLE;
        Ok(data)
    }

    /// Takes the noise for known: radians, metres.
    pub fn suppose(&mut self, turn: f64, shift: f64) {
        let rows = &self.columns.good;
        let far = median(rows.iter().map(|&r| self.columns.position[r].norm()).collect());
        self.noise_position = if far > 10.0 { 1e3 * shift } else { shift };
        self.decoded.iter_mut().for_each(|d| d.noise = turn);
        for (noise, c) in self.noise_columns.iter_mut().zip(&self.columns.joints) {
            *noise = noise.min(1e-3 * spread_of(rows, |r| c[r]));
        }
    }

    /// How many columns may be joints.
    pub fn width(&self) -> usize {
        self.columns.joints.len()
    }

    /// The joints' columns at a row, for a pose that is so many rows behind.
    pub fn row(&self, r: usize, lag: f64, out: &mut Vec<f64>) {
        out.clear();
        let joints = &self.columns.joints;
        if lag == 0.0 {
            out.extend(joints.iter().map(|c| c[r]));
            return;
        }
        let follows = &self.columns.follows;
        let joined = |from: usize, to: usize| to < follows.len() && (from + 1..=to).all(|k| follows[k]);
        let x = r as f64 - lag;
        let at = x.floor();
        let f = x - at;
        if at >= 1.0 && joined((at as usize - 1).min(r), (at as usize + 2).max(r)) {
            let i = at as usize;
            let w = cubic(f);
            out.extend(joints.iter().map(|c| (0..4).map(|k| w[k] * c[i + k - 1]).sum::<f64>()));
            return;
        }
        // At an end: as far as there are rows.
        let step = if lag > 0.0 { -1 } else { 1 };
        let mut i = r;
        for _ in 0..lag.abs().round() as usize {
            let next = i.wrapping_add_signed(step);
            if next >= follows.len() || !follows[next.max(i)] {
                break;
            }
            i = next;
        }
        out.extend(joints.iter().map(|c| c[i]));
    }

    /// The recorded pose of a row, as it stands.
    pub fn recorded(&self, format: usize, r: usize) -> Option<Recorded> {
        let x: Vec<f64> = self.columns.rotation.iter().map(|c| c[r]).collect();
        Some((self.decoded[format].format.read(&x)?, self.columns.position[r]))
    }

    /// The recorded poses of rows, the hand in the base; rows of the sample can all be read.
    pub fn poses(&self, format: usize, direction: Direction, rows: &[usize]) -> Vec<Recorded> {
        let nothing = (Rotation::identity(), Vector::zero());
        rows.iter().map(|&r| direction.read(self.recorded(format, r).unwrap_or(nothing))).collect()
    }
}

/// The standard deviation of a column.
fn spread_of(rows: &[usize], of: impl Fn(usize) -> f64) -> f64 {
    let n = rows.len().max(1) as f64;
    let mean = rows.iter().map(|&r| of(r)).sum::<f64>() / n;
    (rows.iter().map(|&r| (of(r) - mean).powi(2)).sum::<f64>() / n).sqrt()
}

/// At most so many of the rows, evenly spread.
pub fn spread(rows: &[usize], most: usize) -> Vec<usize> {
    rows.iter().copied().step_by(rows.len().div_ceil(most).max(1)).collect()
}

/// The noise of an orientation: third differences of its logarithm seen from the middle of each place.
fn noise_of_turns(columns: &Prepared, turn: &dyn Fn(usize) -> Rotation<f64>) -> f64 {
    let mut all = vec![];
    for r in places(&columns.follows) {
        let back = turn(r).inverse();
        let x: [Vector<f64>; 4] = std::array::from_fn(|k| log(&(back * turn(r + k))));
        let third = x[3] - x[2].scale(3.0) + x[1].scale(3.0) - x[0];
        all.extend(third.0.map(f64::abs));
    }
    median(all) / (0.6745 * 20_f64.sqrt())
}
