//! Arms made at random with everything that a robot file allows, as the text of the file.

use crate::common::Random;
use std::fmt::Write;

/// What kind of arm is made; each brings out other corners.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Kind {
    /// Axes parallel or at right angles, lengths often zero.
    Square,
    /// The last three axes meet.
    Wrist,
    /// Three axes next to each other are parallel.
    Parallel,
    /// Angles and lengths as a calibration prints them.
    Calibrated,
    /// Any angles and lengths.
    General,
    /// One to five joints.
    Few,
    /// Seven or eight.
    Many,
    /// Factors of joint variables, couplings, rows that follow others.
    Geared,
}

impl Kind {
    pub const ALL: [Kind; 8] = [
        Kind::Square,
        Kind::Wrist,
        Kind::Parallel,
        Kind::Calibrated,
        Kind::General,
        Kind::Few,
        Kind::Many,
        Kind::Geared,
    ];
}

/// One of several things.
pub fn one_of<T: Copy>(random: &mut Random, of: &[T]) -> T {
    of[(random.unit() * of.len() as f64) as usize]
}

fn chance(random: &mut Random, of: f64) -> bool {
    random.unit() < of
}

/// A file under way.
struct Writer<'a> {
    random: &'a mut Random,
    kind: Kind,
    /// What a length of 1 is here, metres.
    unit: f64,
    parameters: String,
    named: usize,
}

impl Writer<'_> {
    /// An angle between axes.
    fn twist(&mut self) -> String {
        let square = |w: &mut Self| {
            one_of(w.random, &["0", "90 deg", "-90 deg", "90 deg", "-90 deg", "90 deg", "-90 deg", "180 deg"])
        };
        match self.kind {
            Kind::General => format!("{:.4}", 6.0 * self.random.unit() - 3.0),
            Kind::Calibrated => {
                let near = one_of(self.random, &[0.0, 90.0_f64, -90.0]).to_radians();
                format!("{:.17}", near + 4e-3 * (self.random.unit() - 0.5))
            }
            _ if chance(self.random, 0.1) => {
                one_of(self.random, &["30 deg", "45 deg", "-60 deg", "120 deg"]).into()
            }
            _ => square(self).into(),
        }
    }

    /// A length of either sign, or 0.
    fn length(&mut self) -> String {
        let nice = [0.0, 0.0, 0.15, 0.25, 0.3, 0.4, 0.5, 0.7, 1.0];
        let sign = if chance(self.random, 0.3) { -1.0 } else { 1.0 };
        let x = match self.kind {
            Kind::General => 2.0 * self.random.unit() - 1.0,
            Kind::Calibrated => sign * one_of(self.random, &nice) + 1e-3 * (self.random.unit() - 0.5),
            _ if chance(self.random, 0.03) => 1e-6 * sign,
            _ => sign * one_of(self.random, &nice),
        };
        let number = format!("{:?}", x * self.unit);
        if chance(self.random, 0.2) {
            self.named += 1;
            let name = format!("l{}", self.named);
            let _ = writeln!(self.parameters, "{name} = {number}");
            return name;
        }
        number
    }

    /// A joint's cell: the variable with a factor, an offset, another variable.
    fn variable(&mut self, j: usize, slides: bool) -> String {
        let q = format!("q{j}");
        let geared = self.kind == Kind::Geared;
        let mut text = match one_of(self.random, &[0, 0, 0, 0, 1, 2, 3, 4, 5, 6]) {
            1 => format!("-{q}"),
            2 if geared => format!("{q}/2"),
            3 if geared => format!("2*{q}"),
            4 if geared => format!("3*{q}"),
            5 if geared && chance(self.random, 0.2) => {
                one_of(self.random, &["30*q", "q/30", "100*q"]).replace('q', &q)
            }
            5 if geared => format!("2*{q}/3"),
            6 if geared && j > 1 && !slides => format!("{q} + q{}", j - 1),
            _ => q,
        };
        if !slides && chance(self.random, 0.25) {
            text += one_of(self.random, &[" + 90 deg", " - 90 deg", " + 180 deg", " + 0.3"]);
        } else if slides && chance(self.random, 0.5) {
            let _ = write!(text, " + {}", self.length());
        }
        text
    }
}

/// A robot file.
pub fn text(random: &mut Random, kind: Kind) -> String {
    let joints = match kind {
        Kind::Few => 1 + (random.unit() * 5.0) as usize,
        Kind::Many => 7 + usize::from(chance(random, 0.2)),
        Kind::Geared => 2 + (random.unit() * 5.0) as usize,
        _ => 6,
    };
    let convention = one_of(random, &["standard", "craig", "khalil"]);
    // The keys of a row: the length along z, the length along x.
    let [along, across] = if convention == "khalil" { ["r", "d"] } else { ["d", "a"] };
    let unit = if chance(random, 0.15) { one_of(random, &[1e-12, 1e-6, 1e-3, 1e3, 1e6, 1e12]) } else { 1.0 };
    let parallel = (random.unit() * 3.0) as usize + 1;
    // In the standard convention a row's twist stands behind its joint.
    let shift = usize::from(convention == "standard");
    let mut w = Writer { random, kind, unit, parameters: String::new(), named: 0 };
    let mut rows = String::new();
    for j in 1..=joints {
        let place = j + shift;
        let mut twist = w.twist();
        let (mut d, mut a) = (w.length(), w.length());
        if matches!(kind, Kind::Square | Kind::Wrist | Kind::Many) && chance(w.random, 0.6) {
            *one_of_two(w.random, &mut d, &mut a) = "0".into();
        }
        if kind == Kind::Parallel && (parallel + 1..parallel + 3).contains(&(place - 1)) {
            twist = one_of(w.random, &["0", "0", "180 deg"]).into();
        }
        if kind == Kind::Wrist && place > 4 {
            (a, twist) = ("0".into(), one_of(w.random, &["90 deg", "-90 deg"]).into());
        }
        if kind == Kind::Wrist && j >= 5 {
            d = "0".into();
        }
        let slides = match kind {
            Kind::Calibrated => false,
            Kind::Wrist => j <= 3 && chance(w.random, 0.2),
            _ => chance(w.random, 0.12),
        };
        rows += "[[joints]]\n";
        let _ = writeln!(rows, "alpha = \"{twist}\"\n{across} = \"{a}\"");
        let variable = w.variable(j, slides);
        let (theta, d) = if slides {
            (one_of(w.random, &["0", "90 deg", "-90 deg"]).to_string(), variable)
        } else {
            (variable, d)
        };
        let _ = writeln!(rows, "theta = \"{theta}\"\n{along} = \"{d}\"");
        if chance(w.random, 0.1) {
            let far = if slides { 2.0 * unit } else { 6.5 };
            let _ = writeln!(rows, "limits = [{:?}, {:?}]", -far * w.random.unit(), far * w.random.unit());
        }
    }
    let mut ends = String::new();
    for end in ["base", "tool"] {
        if chance(w.random, 0.2) {
            // Some stand far away, as in the coordinates of a hall or of a map.
            let is_far = end == "base" && chance(w.random, 0.2);
            let far = if is_far { one_of(w.random, &[1e2, 1e4, 1e6, 1e8]) } else { 1.0 };
            let xyz: Vec<f64> = (0..3).map(|_| far * unit * (w.random.unit() - 0.5)).collect();
            let rpy = one_of(w.random, &["[0, 0, 0]", "[0, \"90 deg\", 0]", "[0.3, -0.2, 1]"]);
            let _ = writeln!(ends, "[{end}]\nxyz = {xyz:?}\nrpy = {rpy}");
        }
    }
    format!("name = \"{kind:?}\"\nconvention = \"{convention}\"\n[parameters]\n{}{rows}{ends}", w.parameters)
}

fn one_of_two<'a, T>(random: &mut Random, a: &'a mut T, b: &'a mut T) -> &'a mut T {
    if chance(random, 0.5) { a } else { b }
}
