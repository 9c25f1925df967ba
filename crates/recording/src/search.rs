//! The search: joints and formats by the angles of increments, frames in closed form, then fits of the best.
//!
//! ∠(R_sᵀ R_t) does not change with base, tool, direction, handedness or unit of length, so that H readings of the joints and E
//! formats cost H + E evaluations. L = 60·ln(0.15 + ρ) + Σ cost decides: 60 stands for the independent rows.

use crate::arm::{Arm, half_turn};
use crate::data::{Data, Direction};
use crate::fit::{Extra, Fit, Problem, Scale, rho};
use crate::frames::closed;
use crate::hypothesis::{Hypothesis, Map, Move, Unit};
use crate::turns::{angle, between};
use denavit::geometry::{Axis, Rotation, Transform, Vector};
use std::collections::BTreeSet;
use std::rc::Rc;

/// What an arm that nobody calibrated is forgiven: radians, metres.
pub const TURN: f64 = 1.745e-3;
pub const SHIFT: f64 = 1e-3;
/// What differences of angles are cut at, radians.
const CUT: f64 = 0.3;
/// What a nat is worth among differences of angles, radians.
const NAT: f64 = 5.7e-4;

/// A reading of the joints with the mean difference of angles in each format.
struct Scored {
    hypothesis: Rc<Hypothesis>,
    differences: Vec<f64>,
}

/// A whole reading of the recording.
#[derive(Clone)]
pub struct Reading<'a> {
    /// The arm.
    pub arm: &'a Arm,
    /// What the joints' columns hold.
    pub hypothesis: Rc<Hypothesis>,
    /// The same, to compute with.
    pub map: Rc<Map>,
    /// The format, as a number among those of the data.
    pub format: usize,
    /// How the pose is meant.
    pub direction: Direction,
    /// The lag that was taken out before, rows.
    pub lag: f64,
    /// Base, tool and scale, and single numbers.
    pub fit: Fit,
    /// Which of base and tool are free.
    pub free: [bool; 2],
    /// The half turn by which a left-handed recording is one; none for a right-handed one.
    pub mirror: Option<Axis>,
    /// What residuals are compared with.
    pub scale: Scale,
    /// The size of the residual on rows that were not fitted.
    pub rho: f64,
    /// L, nats.
    pub score: f64,
    /// Whether the base is another one.
    pub has_base: bool,
    /// Whether there is a tool.
    pub has_tool: bool,
}

impl Reading<'_> {
    /// Base and tool, the mirror taken out.
    pub fn plain_frames(&self) -> (Transform<f64>, Transform<f64>) {
        let frames = &self.fit.frames;
        match self.mirror {
            None => (frames.base, frames.tool),
            Some(axis) => {
                let m = Transform::from_rotation_translation(half_turn(axis), Vector::zero());
                (m * frames.base, frames.tool * m)
            }
        }
    }
}

/// What is searched.
pub struct Search<'a> {
    /// The data.
    pub data: &'a Data<'a>,
    /// The noise of the joints as the columns stand, radians.
    pub noise_joints: f64,
    /// The lag that is taken out, rows.
    pub lag: f64,
    scored: Vec<Scored>,
    seen: BTreeSet<Hypothesis>,
    bases: Vec<Hypothesis>,
}

impl<'a> Search<'a> {
    /// Of data, for a lag.
    pub fn new(data: &'a Data<'a>, lag: f64) -> Self {
        let bases = bases(data);
        let mut search =
            Search { data, noise_joints: 0.0, lag, scored: vec![], seen: BTreeSet::new(), bases };
        search.noise_joints = search.noise_of(&search.bases[0]);
        search
    }

    /// The noise of the turning joints under a reading, radians.
    fn noise_of(&self, hypothesis: &Hypothesis) -> f64 {
        let map = hypothesis.map(self.data.width(), self.data.arm);
        let of = |i: usize| map.scale[i].abs() * self.data.noise_columns[map.pick[i]];
        crate::columns::median(self.data.arm.turning().map(of).collect())
    }

    /// The readings of all the columns as they stand, each in every unit and order.
    pub fn bases(&self) -> &[Hypothesis] {
        &self.bases
    }

    /// Scores readings by the angles of increments.
    fn look_at(&mut self, hypotheses: impl IntoIterator<Item = Hypothesis>) {
        let data = self.data;
        let (mut row, mut q) = (vec![], vec![]);
        for h in hypotheses {
            if !self.seen.insert(h.key()) {
                continue;
            }
            let map = h.map(data.width(), data.arm);
            let differences = differences(data, data.arm, &map, self.lag, &mut row, &mut q);
            self.scored.push(Scored { hypothesis: Rc::new(h), differences });
        }
    }

    /// The best readings, by their best format.
    fn best(&self, count: usize) -> Vec<&Scored> {
        let worth = |s: &Scored| {
            s.differences.iter().copied().fold(f64::INFINITY, f64::min) + NAT * s.hypothesis.cost()
        };
        let mut all: Vec<(f64, &Scored)> = self.scored.iter().map(|s| (worth(s), s)).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all.into_iter().take(count).map(|s| s.1).collect()
    }

    /// Whether one of the best differs from the angles by no more than noise does.
    fn is_good(&self) -> bool {
        let data = self.data;
        let turning = data.arm.turning().count() as f64;
        let floor = |e: usize, joints: f64| {
            let noise = data.decoded[e].noise.hypot((joints * turning.sqrt()).hypot(TURN));
            0.8 * 2_f64.sqrt() * noise
        };
        self.best(5).iter().any(|s| {
            let joints = self.noise_of(&s.hypothesis);
            s.differences.iter().enumerate().any(|(e, d)| *d < 1.8 * floor(e, joints))
        })
    }

    /// Every single move on the best readings, as often as needed.
    pub fn widen(&mut self) {
        let moves = Move::all(self.data.arm);
        let bases = self.bases.clone();
        self.look_at(bases);
        let extra = self.data.width() > self.data.arm.joints();
        let mut count = if extra { 10 } else { 4 };
        for round in 0..3 {
            let top: Vec<Rc<Hypothesis>> = self.best(count).iter().map(|s| s.hypothesis.clone()).collect();
            let more = top.iter().flat_map(|h| {
                let is_new = |m: &&Move| !h.moves.contains(m);
                moves.iter().filter(is_new).map(|&m| h.plus(m)).collect::<Vec<_>>()
            });
            self.look_at(more.collect::<Vec<_>>());
            if self.is_good() {
                break;
            }
            count = [14, 10, 10][round];
        }
    }

    /// Readings and formats whose frames are worth solving for.
    fn survivors(&self) -> Vec<(Rc<Hypothesis>, usize)> {
        let data = self.data;
        let mut all: Vec<(f64, &Rc<Hypothesis>, usize)> = vec![];
        for s in &self.scored {
            for (e, d) in s.differences.iter().enumerate() {
                let cost = s.hypothesis.cost() + data.decoded[e].cost;
                all.push((d + NAT * cost, &s.hypothesis, e));
            }
        }
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        let Some(&(first, _, format)) = all.first() else { return vec![] };
        let (limit, tied) = (1.5 * first + 0.01, 1.15 * first + 0.004);
        let few = data.arm.turning().count() < 5;
        let most = if few { 60 } else { 36 };
        let slides: Vec<usize> = (0..data.arm.joints()).filter(|&i| !data.arm.turns[i]).collect();
        let mut out = vec![];
        for (k, (d, h, e)) in all.into_iter().take(200).enumerate() {
            if (d > limit && out.len() > 12) || (k >= most && d > tied) {
                break;
            }
            out.push((h.clone(), e));
            out.extend(slides.iter().map(|&i| (Rc::new(h.plus(Move::Flip(i))), e)));
        }
        out.extend(self.bases.iter().take(6).map(|h| (Rc::new(h.clone()), format)));
        out
    }

    /// Frames in closed form, in every direction.
    pub fn framed(&self, hypothesis: &Rc<Hypothesis>, format: usize, arm: &'a Arm) -> Vec<Reading<'a>> {
        let data = self.data;
        let map = Rc::new(hypothesis.map(data.width(), arm));
        let model = |rows: &[usize]| {
            let (mut row, mut q) = (vec![], vec![]);
            let pose = |&r: &usize| {
                data.row(r, self.lag, &mut row);
                map.apply(&row, &mut q);
                arm.pose(&q)
            };
            rows.iter().map(pose).collect::<Vec<_>>()
        };
        let (fit, held) = (model(&data.fit), model(&data.held));
        let mut readings = vec![];
        for direction in Direction::ALL {
            let recorded = data.poses(format, direction, &data.fit);
            let judged = data.poses(format, direction, &data.held);
            for frames in closed(&fit, &recorded, &data.axes) {
                let scale = self.scale(hypothesis, format, frames.scale);
                let problem = Problem {
                    arm,
                    joints: &|_, _, _| {},
                    rows: &data.held,
                    recorded: &judged,
                    scale,
                    lag: self.lag,
                };
                let rho = rho(&problem.residuals(&frames, &held));
                let fit = Fit { frames, extras: vec![], deviations: vec![] };
                let mut reading = Reading {
                    arm,
                    hypothesis: hypothesis.clone(),
                    map: map.clone(),
                    format,
                    direction,
                    lag: self.lag,
                    fit,
                    free: [true; 2],
                    mirror: None,
                    scale,
                    rho,
                    score: 0.0,
                    has_base: false,
                    has_tool: false,
                };
                reading.score = self.score(&reading);
                readings.push(reading);
            }
        }
        readings
    }

    /// What residuals are compared with.
    fn scale(&self, hypothesis: &Hypothesis, format: usize, unit: f64) -> Scale {
        let data = self.data;
        let turning = data.arm.turning().count() as f64;
        let joints = self.noise_of(hypothesis).min(0.1);
        Scale {
            turn: data.decoded[format].noise.hypot(joints * (0.67 * turning).sqrt()).hypot(TURN),
            shift: (data.noise_position / unit.abs()).hypot(0.6 * joints).hypot(SHIFT),
        }
    }

    /// So many independent rows stand behind a residual: recorded rows are like their neighbours, and few are few.
    fn weight(&self) -> f64 {
        (2.0 * (self.data.fit.len() + self.data.held.len()) as f64).min(60.0)
    }

    /// L of a reading, base and tool as they are known to be.
    pub fn score(&self, reading: &Reading) -> f64 {
        let is = |yes: bool, cost: f64| if yes { cost } else { 0.0 };
        self.weight() * (0.15 + reading.rho).ln()
            + reading.hypothesis.cost()
            + self.data.decoded[reading.format].cost
            + is(reading.direction != Direction::Direct, 2.0)
            + is(reading.fit.frames.scale != 1.0, 2.0)
            + is(reading.lag != 0.0 && !reading.fit.extras.iter().any(|e| e.0 == Extra::Lag), 6.0)
            + 6.0 * reading.fit.extras.len() as f64
            + is(!std::ptr::eq(reading.arm, self.data.arm), 4.0)
            + is(reading.has_base, 3.0)
            + is(reading.has_tool, 3.0)
    }

    /// Fits a reading with some numbers free beside base and tool, or without these.
    pub fn finish(
        &self,
        start: &Reading<'a>,
        extras: &[(Extra, f64)],
        free: [bool; 2],
        steps: usize,
    ) -> Reading<'a> {
        let mirrors: &[Option<Axis>] = match (start.fit.frames.scale < 0.0, free) {
            (false, _) | (true, [true, true]) => &[None],
            (true, _) => &[Some(Axis::X), Some(Axis::Y), Some(Axis::Z)],
        };
        let all = mirrors.iter().map(|m| self.finish_mirrored(start, extras, free, steps, *m));
        all.min_by(|a, b| a.score.total_cmp(&b.score)).expect("there is one at least")
    }

    fn finish_mirrored(
        &self,
        start: &Reading<'a>,
        extras: &[(Extra, f64)],
        free: [bool; 2],
        steps: usize,
        mirror: Option<Axis>,
    ) -> Reading<'a> {
        let data = self.data;
        let mut frames = start.fit.frames;
        let plain = mirror.map_or_else(Rotation::identity, half_turn);
        let plain = Transform::from_rotation_translation(plain, Vector::zero());
        for (place, is_free) in [&mut frames.base, &mut frames.tool].into_iter().zip(free) {
            if !is_free {
                *place = plain;
            }
        }
        let map = &start.map;
        let joints = |r: usize, lag: f64, q: &mut Vec<f64>| {
            let mut row = vec![];
            data.row(r, lag, &mut row);
            map.apply(&row, q);
        };
        let problem = |rows, recorded| Problem {
            arm: start.arm,
            joints: &joints,
            rows,
            recorded,
            scale: start.scale,
            lag: start.lag,
        };
        let recorded = data.poses(start.format, start.direction, &data.fit);
        let fit = problem(&data.fit, &recorded).fit(&frames, extras, free, steps);
        let judged = data.poses(start.format, start.direction, &data.held);
        let held = problem(&data.held, &judged);
        let rho = rho(&held.residuals(&fit.frames, &held.model(&fit.extras)));
        let mut reading = Reading { fit, free, rho, ..start.clone() };
        let size = rho.min(3.0);
        let (turn, shift) = (
            1.2_f64.to_radians() + 2.0 * start.scale.turn * size / 7.0,
            0.008 + 2.0 * start.scale.shift * size / 3.0,
        );
        let frames = &reading.fit.frames;
        let is_there = |x: &Transform<f64>, m: &Rotation<f64>| {
            between(&x.rotation, m) > turn || x.translation.norm() > shift
        };
        reading.mirror = match (frames.scale < 0.0, mirror) {
            (false, _) => None,
            (true, Some(axis)) => Some(axis),
            (true, None) => {
                let far = |a: &Axis| {
                    between(&frames.base.rotation, &half_turn(*a))
                        + between(&frames.tool.rotation, &half_turn(*a))
                };
                Axis::ALL.into_iter().min_by(|a, b| far(a).total_cmp(&far(b)))
            }
        };
        let m = reading.mirror.map_or_else(Rotation::identity, half_turn);
        (reading.has_base, reading.has_tool) = (is_there(&frames.base, &m), is_there(&frames.tool, &m));
        reading.score = self.score(&reading);
        reading
    }

    /// A reading with base, tool, both or none of them.
    pub fn nested(&self, start: &Reading<'a>, extras: &[(Extra, f64)], steps: usize) -> Vec<Reading<'a>> {
        let free = self.finish(start, extras, [true; 2], 4);
        let mut all = vec![];
        if free.has_base || free.has_tool {
            for which in [[false, false], [false, true], [true, false]] {
                all.push(self.finish(start, extras, which, steps));
            }
        }
        all.push(free);
        all
    }

    /// Steps 4 to 7: the best readings, fitted.
    pub fn readings(&mut self) -> Vec<Reading<'a>> {
        self.widen();
        let mut framed: Vec<Reading<'a>> =
            self.survivors().iter().flat_map(|(h, e)| self.framed(h, *e, self.data.arm)).collect();
        framed.sort_by(|a, b| a.score.total_cmp(&b.score));
        let mut fitted: Vec<Reading<'a>> =
            framed.iter().take(14).flat_map(|r| self.nested(r, &[], 6)).collect();
        let plain = framed.iter().skip(14).filter(|r| r.hypothesis.moves.is_empty()).take(3);
        fitted.extend(plain.map(|r| self.finish(r, &[], [true; 2], 4)));
        fitted.sort_by(|a, b| a.score.total_cmp(&b.score));
        fitted
    }

    /// The best readings and formats of another arm by the angles of increments.
    pub fn of_other(&self, arm: &'a Arm, count: usize) -> Vec<(Rc<Hypothesis>, usize)> {
        let (mut row, mut q, mut all) = (vec![], vec![], vec![]);
        for h in &self.bases {
            let h = Rc::new(h.clone());
            let map = h.map(self.data.width(), arm);
            let d = differences(self.data, arm, &map, self.lag, &mut row, &mut q);
            all.extend(d.into_iter().enumerate().map(|(e, d)| (d, h.clone(), e)));
        }
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all.into_iter().take(count).map(|(_, h, e)| (h, e)).collect()
    }
}

/// The mean differences of angles in each format.
fn differences(
    data: &Data,
    arm: &Arm,
    map: &Map,
    lag: f64,
    row: &mut Vec<f64>,
    q: &mut Vec<f64>,
) -> Vec<f64> {
    let mut turn = |r: usize| {
        data.row(r, lag, row);
        map.apply(row, q);
        arm.rotation(q)
    };
    let angles: Vec<f64> = data.pairs.iter().map(|&(s, t)| angle(&(turn(s).inverse() * turn(t)))).collect();
    let mean = |other: &[f64]| {
        let cut = |(a, b): (&f64, &f64)| (a - b).abs().min(CUT);
        angles.iter().zip(other).map(cut).sum::<f64>() / angles.len() as f64
    };
    data.decoded.iter().map(|d| mean(&d.angles)).collect()
}

/// The columns as they stand, in every unit and order, with every choice of columns left out.
fn bases(data: &Data) -> Vec<Hypothesis> {
    let (columns, n) = (data.width(), data.arm.joints());
    let largest = |c: &Vec<f64>| data.columns.good.iter().map(|&r| c[r].abs()).fold(0.0, f64::max);
    let wide = data.columns.joints.iter().filter(|c| largest(c) > 7.0).count();
    let said = data.columns.said_degrees.iter().any(|d| *d);
    let turning = data.arm.turning().count();
    let mut units = if wide >= 2.max(turning / 2) || wide == columns {
        vec![Unit::Degrees, Unit::Hundred, Unit::AsSaid]
    } else {
        vec![Unit::AsSaid]
    };
    if said {
        units.insert(1, Unit::Radians);
    }
    let mut all = vec![];
    for unit in units {
        for dropped in choices(columns, columns - n) {
            for reversed in [false, true] {
                all.push(Hypothesis::plain(unit, dropped.clone(), reversed));
            }
        }
    }
    all
}

/// Every choice of so many numbers below a bound, in order.
fn choices(below: usize, count: usize) -> Vec<Vec<usize>> {
    if count == 0 {
        return vec![vec![]];
    }
    let with = |last: usize| {
        choices(last, count - 1).into_iter().map(move |mut c| {
            c.push(last);
            c
        })
    };
    (count - 1..below).flat_map(with).collect()
}
