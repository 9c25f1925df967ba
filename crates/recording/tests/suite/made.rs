//! Recordings that are made: a path of an arm with noise, and slips put into its columns.

use denavit::geometry::{Rotation, Transform, Vector};
use denavit::random::Random;
use denavit::{Description, catalogue};
use denavit_recording::{Arm, Column, Form, Format, Recording, Roles};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Random numbers of a few kinds.
pub struct Dice(Random);

impl Dice {
    pub fn new(seed: u64) -> Self {
        let mut random = Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0x1234_5678);
        random.unit();
        Dice(random)
    }
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.unit()
    }
    pub fn below(&mut self, n: usize) -> usize {
        ((self.0.unit() * n as f64) as usize).min(n - 1)
    }
    pub fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())]
    }
    pub fn normal(&mut self, deviation: f64) -> f64 {
        let (u, v) = (1.0 - self.0.unit(), self.0.unit());
        deviation * (-2.0 * u.ln()).sqrt() * (TAU * v).cos()
    }
    fn vector(&mut self, deviation: f64) -> Vector<f64> {
        Vector(std::array::from_fn(|_| self.normal(deviation)))
    }
}

/// Noise: of the position (metres), the orientation and the joints (degrees).
#[derive(Clone, Copy)]
pub struct Noise(pub f64, pub f64, pub f64);

/// What a recording is made with.
#[derive(Clone, Copy)]
pub struct Setting {
    pub noise: Noise,
    pub rows: usize,
    /// Errors of every link: metres, degrees.
    pub calibration: (f64, f64),
    /// How much of the usual motion there is.
    pub motion: f64,
}

pub const NOMINAL: Setting =
    Setting { noise: Noise(0.3e-3, 0.1, 0.01), rows: 900, calibration: (0.0, 0.0), motion: 1.0 };
const RATE: f64 = 30.0;

/// The kinds of slips, after those of the method's study.
pub const KINDS: &[&str] = &[
    "all-deg",
    "one-deg",
    "norm100",
    "flip",
    "zero90",
    "zero180",
    "zerofit",
    "swap",
    "reverse",
    "gripper",
    "couple",
    "gain",
    "mm",
    "euler-deg",
    "rotvec",
    "euler",
    "wxyz",
    "xyzw",
    "6drows",
    "inverse",
    "transposed",
    "base90",
    "base",
    "tool-z",
    "tool",
    "lag",
    "jump",
    "stuck",
    "spikes",
    "mirror",
    "length",
    "variant",
];

/// A recording with what is in it, each as a text.
pub struct Made {
    pub recording: Recording,
    pub roles: Roles,
    pub truth: Vec<String>,
    /// The true joints and poses of the model.
    pub poses: Vec<Transform<f64>>,
}

pub fn description(name: &str) -> Description {
    catalogue::robot(name).expect("a robot of the catalogue")
}

pub fn arm(name: &str) -> Arm {
    Arm::new(name, &description(name)).expect("it has numbers")
}

fn exp(w: Vector<f64>) -> Rotation<f64> {
    let v = w.norm();
    if v < 1e-12 {
        return Rotation::identity();
    }
    let x = [w[0] / v, w[1] / v, w[2] / v, v];
    denavit::geometry::orientation::rotation(denavit::geometry::OrientationSet::AxisAngle, &x)
        .expect("an axis")
}

/// The limits of motion: half a turn either way at most.
fn ranges(arm: &Arm) -> Vec<[f64; 2]> {
    let one = |[l, h]: [f64; 2]| if h - l > TAU { [-PI, PI] } else { [l, h] };
    arm.limits.iter().map(|l| one(*l)).collect()
}

fn path(arm: &Arm, dice: &mut Dice, setting: &Setting) -> Vec<Vec<f64>> {
    let n = arm.joints();
    let mut columns = vec![];
    for (i, [low, high]) in ranges(arm).into_iter().enumerate() {
        let width = high - low;
        let middle = low + width * dice.between(0.35, 0.65);
        let most = if arm.turns[i] { dice.between(0.25, 0.9) } else { dice.between(0.05, 0.15) };
        let waves: Vec<[f64; 3]> = (0..4)
            .map(|_| [dice.between(0.3, 1.0), dice.between(0.04, 0.3), dice.between(0.0, 6.3)])
            .collect();
        let at = |t: f64| waves.iter().map(|[a, f, p]| a * (TAU * f * t + p).sin()).sum::<f64>();
        let shape: Vec<f64> = (0..setting.rows).map(|r| at(r as f64 / RATE)).collect();
        let largest = shape.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let size = most.min(0.33 * width) / largest;
        let mean = shape.iter().sum::<f64>() / shape.len() as f64;
        columns.push(shape.iter().map(|x| middle + size * (mean + setting.motion * (x - mean))).collect());
    }
    assert_eq!(columns.len(), n);
    columns
}

fn any_form(dice: &mut Dice) -> Form {
    Form::Euler(dice.below(12) as u8, dice.below(2) == 0)
}

/// Another arm that is nearly this one.
pub fn variant(name: &str) -> Option<&'static str> {
    Some(match name {
        "ur5" => "ur5e",
        "ur5e" => "ur5",
        "puma560" => "abb-irb120",
        "abb-irb120" => "puma560",
        "ur10" => "ur10e",
        _ => return None,
    })
}

pub fn make(name: &str, slips: &[&str], seed: u64, setting: &Setting) -> Made {
    let mut dice = Dice::new(seed);
    let own = arm(name);
    let has = |s: &str| slips.contains(&s);
    let q = path(&own, &mut dice, setting);
    let (n, rows) = (own.joints(), setting.rows);
    let mut truth: Vec<String> = vec![];
    let turning: Vec<usize> = (0..n).filter(|&i| own.turns[i]).collect();
    let middle: Vec<usize> = turning.iter().copied().filter(|&i| i > 0 && i + 1 < n).collect();
    let mut mover = own.clone();
    if has("variant")
        && let Some(other) = variant(name)
    {
        mover = arm(other);
        truth.push(format!("arm {other}"));
    }
    if setting.calibration.0 > 0.0 {
        for c in &mut mover.constants {
            let turn = exp(dice.vector(setting.calibration.1.to_radians()));
            *c = *c * Transform::from_rotation_translation(turn, dice.vector(setting.calibration.0));
        }
    }
    if has("length") {
        // One along the first axis is the base, one along the last the tool.
        let is_long = |&(k, a): &(usize, usize)| mover.constants[k].translation[a].abs() > 0.03;
        let all: Vec<(usize, usize)> = mover.lengths().into_iter().filter(is_long).collect();
        let (k, a) = dice.one_of(&all);
        mover.constants[k].translation.0[a] += dice.one_of(&[-1.0, 1.0]) * dice.between(0.012, 0.03);
        truth.push(format!("length {k} {a}"));
    }
    let mut lag = 0.0;
    if has("lag") {
        lag = dice.one_of(&[-4.0, -3.0, -2.0, 2.0, 3.0, 4.0]);
        truth.push("lag".into());
    }
    let at = |i: usize, r: f64| {
        let x = r.clamp(0.0, (rows - 1) as f64);
        let k = (x.floor() as usize).min(rows - 2);
        q[i][k] + (x - k as f64) * (q[i][k + 1] - q[i][k])
    };
    let mut base = Transform::identity();
    let mut tool = Transform::identity();
    if has("base90") {
        base = Transform::rotation_z(dice.one_of(&[-1.0, 1.0, 2.0]) * FRAC_PI_2);
    }
    if has("base") {
        base = Transform::from_rotation_translation(exp(dice.vector(1.0)), dice.vector(0.5));
    }
    if has("tool-z") {
        tool = Transform::translation_z(0.1736);
    }
    if has("tool") {
        tool = Transform::from_rotation_translation(exp(dice.vector(0.7)), dice.vector(0.1));
    }
    if has("base90") || has("base") {
        truth.push("base".into());
    }
    if has("tool-z") || has("tool") {
        truth.push("tool".into());
    }
    let poses: Vec<Transform<f64>> =
        (0..rows).map(|r| mover.pose(&(0..n).map(|i| at(i, r as f64 - lag)).collect::<Vec<_>>())).collect();
    let mut recorded: Vec<Transform<f64>> = poses
        .iter()
        .map(|p| {
            let x = base * *p * tool;
            let turn = x.rotation * exp(dice.vector(setting.noise.1.to_radians()));
            Transform::from_rotation_translation(turn, x.translation + dice.vector(setting.noise.0))
        })
        .collect();
    let noise = setting.noise.2.to_radians();
    let mut columns: Vec<Vec<f64>> = (0..n)
        .map(|i| q[i].iter().map(|x| x + dice.normal(noise) * if own.turns[i] { 1.0 } else { 0.3 }).collect())
        .collect();
    if has("spikes") {
        for _ in 0..8 {
            let r = 10 + dice.below(rows - 20);
            let x = recorded[r];
            let turn = x.rotation * exp(dice.vector(0.5));
            recorded[r] = Transform::from_rotation_translation(turn, x.translation + dice.vector(0.3));
        }
        truth.push("spikes".into());
    }
    if has("mirror") {
        let flip = |r: Rotation<f64>| {
            let s = |i: usize| if i == 1 { -1.0 } else { 1.0 };
            let rows = r.rows();
            Rotation::from_rows(std::array::from_fn(|i| std::array::from_fn(|j| s(i) * s(j) * rows[i][j])))
        };
        for x in &mut recorded {
            let Vector([a, b, c]) = x.translation;
            *x = Transform::from_rotation_translation(flip(x.rotation), Vector([a, -b, c]));
        }
        truth.push("mirror".into());
    }
    if has("inverse") {
        recorded.iter_mut().for_each(|x| *x = x.inverse());
        truth.push("inverse".into());
    }
    if has("transposed") {
        recorded.iter_mut().for_each(|x| x.rotation = x.rotation.inverse());
        truth.push("transposed".into());
    }
    let mut unit = 1.0;
    if has("mm") {
        unit = 1e3;
        truth.push("unit 1000".into());
    }
    let mut form = dice.one_of(&[Form::RotationVector, Form::QuaternionXyzw]);
    let degrees = has("euler-deg");
    for (kind, is) in [
        ("rotvec", Form::RotationVector),
        ("wxyz", Form::QuaternionWxyz),
        ("xyzw", Form::QuaternionXyzw),
        ("6drows", Form::Rows),
    ] {
        if has(kind) {
            form = is;
        }
    }
    if has("euler") || degrees {
        form = any_form(&mut dice);
    }
    let format = Format { form, degrees };
    truth.push(format!("format {form}{}", if degrees { " deg" } else { "" }));
    if has("couple") {
        let all: Vec<usize> = turning.iter().copied().filter(|&i| i > 0 && own.turns[i - 1]).collect();
        let i = dice.one_of(&all);
        (0..rows).for_each(|r| columns[i][r] += columns[i - 1][r]);
        truth.push(format!("couple {i}"));
    }
    let change = |c: &mut Vec<f64>, k: f64, b: f64| c.iter_mut().for_each(|x| *x = k * *x + b);
    if has("gain") {
        let i = dice.one_of(&middle);
        let k = dice.one_of(&[0.5, 2.0, 1.1, 0.9]);
        change(&mut columns[i], k, 0.0);
        truth.push(format!("gain {i}"));
    }
    if has("zero90") {
        let i = dice.one_of(&turning);
        change(&mut columns[i], 1.0, dice.one_of(&[1.0, 3.0]) * FRAC_PI_2);
        truth.push(format!("zero {i}"));
    }
    if has("zero180") {
        let i = dice.one_of(&turning);
        change(&mut columns[i], 1.0, PI);
        truth.push(format!("zero {i}"));
    }
    if has("zerofit") {
        let i = dice.one_of(&middle);
        change(&mut columns[i], 1.0, (dice.one_of(&[-1.0, 1.0]) * dice.between(4.0, 25.0)).to_radians());
        truth.push(format!("zero {i}"));
    }
    if has("flip") {
        let i = dice.one_of(&turning);
        change(&mut columns[i], -1.0, 0.0);
        truth.push(format!("flip {i}"));
    }
    if has("stuck") {
        let i = dice.one_of(&turning);
        let from = 100.min(rows / 6) + dice.below(rows.saturating_sub(250).max(1));
        let length = 80 + dice.below(60);
        let value = columns[i][from];
        columns[i][from..(from + length).min(rows)].fill(value);
        truth.push(format!("stuck {i}"));
    }
    if has("jump") {
        let i = dice.one_of(&turning);
        let from = 100.min(rows / 6) + dice.below(rows.saturating_sub(200).max(1));
        columns[i][from..].iter_mut().for_each(|x| *x += TAU);
        truth.push(format!("jump {i}"));
    }
    let degree = 180.0 / PI;
    if has("one-deg") {
        let i = dice.one_of(&turning);
        change(&mut columns[i], degree, 0.0);
        truth.push(format!("deg {i}"));
    }
    if has("all-deg") {
        turning.iter().for_each(|&i| change(&mut columns[i], degree, 0.0));
        truth.push("deg".into());
    }
    if has("norm100") {
        for (c, [low, high]) in columns.iter_mut().zip(&own.limits) {
            c.iter_mut().for_each(|x| *x = (*x - low) / (high - low) * 200.0 - 100.0);
        }
        truth.push("hundred".into());
    }
    if has("swap") {
        let i = dice.one_of(&turning);
        let others: Vec<usize> = turning.iter().copied().filter(|&j| j != i).collect();
        let j = dice.one_of(&others);
        columns.swap(i, j);
        truth.push(format!("swap {} {}", i.min(j), i.max(j)));
    }
    if has("reverse") {
        columns.reverse();
        truth.push("reverse".into());
    }
    if has("gripper") {
        let phase = dice.between(0.0, 6.0);
        let open = |r: usize| f64::from(u8::from((TAU * r as f64 / RATE / 7.0 + phase).sin() > 0.0));
        let smooth = |r: usize| (0..9).map(|k| open((r + k).saturating_sub(4))).sum::<f64>() / 9.0;
        let k = dice.below(n + 1);
        columns.insert(k, (0..rows).map(smooth).collect());
        truth.push(format!("drop {k}"));
    }
    truth.sort();
    let recording = assembled(&columns, &recorded, unit, format);
    let (joints, width) = (columns.len(), format.form.width());
    let roles = Roles {
        time: Some(0),
        episode: None,
        joints: (1..=joints).collect(),
        position: (joints + 1..joints + 4).collect(),
        rotation: (joints + 4..joints + 4 + width).collect(),
    };
    Made { recording, roles, truth, poses }
}

fn assembled(columns: &[Vec<f64>], recorded: &[Transform<f64>], unit: f64, format: Format) -> Recording {
    let rows = recorded.len();
    let column = |name: String, values: Vec<f64>| Column { name, said: None, values };
    let mut all = vec![column("t".into(), (0..rows).map(|r| r as f64 / RATE).collect())];
    all.extend(columns.iter().enumerate().map(|(i, c)| column(format!("c{i}"), c.clone())));
    for (k, name) in ["x", "y", "z"].iter().enumerate() {
        all.push(column((*name).into(), recorded.iter().map(|p| unit * p.translation[k]).collect()));
    }
    let mut turns: Vec<Vec<f64>> = vec![];
    for x in recorded {
        // As libraries print them: each row for itself.
        turns.push(format.write(&x.rotation, None));
    }
    for k in 0..format.form.width() {
        all.push(column(format!("r{k}"), turns.iter().map(|t| t[k]).collect()));
    }
    Recording { columns: all }
}
