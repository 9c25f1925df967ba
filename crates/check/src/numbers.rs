//! Numeric answers: a matrix of numbers at a configuration that the document states.

use super::facts::{Remark, Unproved};
use super::outcome::{Finding, Wrong};
use super::subject::Subject;
use denavit::description::JointKind;
use denavit_symbolic::{Angle, Expr, Rational, Symbol};
use std::f64::consts::TAU;

/// Values of joints, and whether they have a unit.
pub(super) type Values = Vec<Option<(f64, bool)>>;

/// The configuration that a document states, joint by joint.
#[derive(Clone, Debug, Default)]
pub(super) struct Configuration {
    /// Values, and whether they have a unit.
    values: Vec<Option<(f64, bool)>>,
    /// Those of the configuration before, while the joints are what is asked for.
    before: Vec<Option<(f64, bool)>>,
    /// Whole ones that were found before, for the same pose or for others.
    found: Vec<Vec<Option<(f64, bool)>>>,
    /// Whole ones that were stated before the present one.
    stated: Vec<Vec<Option<(f64, bool)>>>,
    /// What of the next one is found.
    partly: Vec<Option<(f64, bool)>>,
    /// The joints are what is asked for.
    pub is_sought: bool,
    /// Lengths that the document states, metres.
    lengths: Vec<(Symbol, f64)>,
}

/// No more configurations that were found are kept.
const MOST_FOUND: usize = 12;

/// How a value without unit is read.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Unit {
    Degrees,
    Radians,
}

/// A number in print at a configuration.
#[derive(Clone, Debug)]
pub(super) struct Answer {
    pub printed: f64,
    /// Half a unit of the last printed digit.
    pub half: f64,
    pub wanted: Expr,
    pub at: Configuration,
    /// What is printed, where it is exact.
    pub constant: Option<Expr>,
}

impl Configuration {
    /// States a joint's value; `value` is a constant.
    pub fn set(&mut self, joint: usize, value: Expr) {
        let has_unit = value.as_number().is_none();
        if let Ok(x) = value.eval(|_| None) {
            if self.is_sought && self.values.get(joint).is_some_and(Option::is_some) {
                self.keep_found();
            }
            let is_whole = !self.values.is_empty() && self.values.iter().all(Option::is_some);
            if joint == 0 && is_whole && self.stated.len() < MOST_FOUND && !self.stated.contains(&self.values)
            {
                self.stated.push(self.values.clone());
            }
            if self.values.len() <= joint {
                self.values.resize(joint + 1, None);
            }
            self.values[joint] = Some((x, has_unit));
        }
    }

    /// The joints of a program, in radians and metres.
    pub fn in_radians(values: &[f64]) -> Self {
        Configuration { values: values.iter().map(|x| Some((*x, true))).collect(), ..Self::default() }
    }

    /// The present values.
    pub fn present(&self) -> Values {
        self.values.clone()
    }

    /// The present values, if so many joints have one.
    pub fn whole(&self, joints: usize) -> Option<Values> {
        let is_whole = self.values.len() == joints && self.values.iter().all(Option::is_some);
        is_whole.then(|| self.values.clone())
    }

    /// Goes to other values, those that are left being stated as well.
    pub fn put(&mut self, values: Values) {
        for own in [self.values.clone(), values.clone()] {
            let is_whole = !own.is_empty() && own.iter().all(Option::is_some);
            if is_whole && self.stated.len() < MOST_FOUND && !self.stated.contains(&own) {
                self.stated.push(own);
            }
        }
        self.values = values;
    }

    /// Keeps the present configuration among those that were found.
    fn keep_found(&mut self) {
        self.keep(self.values.clone());
    }

    fn keep(&mut self, values: Vec<Option<(f64, bool)>>) {
        let is_whole = !values.is_empty() && values.iter().all(Option::is_some);
        if is_whole && self.found.len() < MOST_FOUND && !self.found.contains(&values) {
            self.found.push(values);
        }
    }

    /// A value that one of so many joints has in a solution, and whether it has a unit; a joint that has one begins another
    /// solution.
    pub fn find_joint(&mut self, joint: usize, joints: usize, value: (f64, bool)) {
        if self.partly.len() != joints || self.partly[joint].is_some() {
            self.partly = vec![None; joints];
        }
        self.partly[joint] = Some(value);
        self.keep(self.partly.clone());
    }

    /// The same at each of the configurations that were found before.
    fn earlier(&self) -> impl Iterator<Item = Configuration> + '_ {
        self.found.iter().map(|values| Configuration { values: values.clone(), ..self.clone() })
    }

    /// The same at each of the whole configurations that were stated before.
    fn told_before(&self) -> impl Iterator<Item = Configuration> + '_ {
        self.stated.iter().map(|values| Configuration { values: values.clone(), ..self.clone() })
    }

    /// True if all joints that a formula speaks of have values in a configuration that was found or stated before.
    pub fn knew(&self, e: Expr, subject: &Subject) -> bool {
        self.earlier().chain(self.told_before()).any(|c| c.knows(e, subject))
    }

    /// The joints have no values any more; those that they had were found, or are kept.
    pub fn forget_joints(&mut self, were_found: bool) {
        if were_found {
            self.keep_found();
        }
        let values = std::mem::take(&mut self.values);
        // A part of a configuration is that of another.
        let is_whole = values.iter().all(Option::is_some) && values.len() >= self.before.len();
        if !were_found && is_whole && !values.is_empty() {
            if self.stated.len() < MOST_FOUND && !self.stated.contains(&values) {
                self.stated.push(values.clone());
            }
            self.before = values;
        }
    }

    /// The joints have the values again that they had when these were forgotten.
    pub fn recall_joints(&mut self) {
        if !self.before.is_empty() {
            self.values.clone_from(&self.before);
        }
    }

    /// States a length.
    pub fn give(&mut self, symbol: Symbol, value: Expr) {
        if let Ok(x) = value.eval(|_| None) {
            self.lengths.retain(|l| l.0 != symbol);
            self.lengths.push((symbol, x));
        }
    }

    /// A length, or a rate, that is not known any more.
    pub fn forget(&mut self, symbol: Symbol) {
        self.lengths.retain(|l| l.0 != symbol);
    }

    /// The lengths without the joints.
    pub fn lengths_alone(&self) -> Self {
        Configuration { lengths: self.lengths.clone(), ..Configuration::default() }
    }

    /// The length that the document states.
    pub fn length(&self, symbol: Symbol) -> Option<f64> {
        self.lengths.iter().find(|l| l.0 == symbol).map(|l| l.1)
    }

    /// True if a sum of joints has this value, degrees or radians, but for whole turns.
    pub fn has(&self, of: Expr, value: f64, subject: &Subject) -> bool {
        let at = [Unit::Radians, Unit::Degrees]
            .into_iter()
            .filter_map(|unit| self.value(of, subject, unit, false));
        at.into_iter().any(|x| {
            let off = x - value;
            (off - TAU * (off / TAU).round()).abs() < 1e-3
        })
    }

    /// True if all joints that a formula speaks of have values.
    pub fn knows(&self, e: Expr, subject: &Subject) -> bool {
        let variables = subject.description.variables();
        let symbols = e.symbols();
        let has = |k: usize| self.values.get(k).is_some_and(Option::is_some);
        (0..variables.len()).filter(|&k| symbols.contains(&variables[k].symbol)).all(has)
    }

    /// A formula at the configuration, lengths as letters; joints that have no value stay. Nothing if one has a value that is
    /// not exact: a multiple of 15°, or a slide in its home.
    pub fn exactly(&self, e: Expr, subject: &Subject) -> Option<Expr> {
        let is_degrees = self.looks_like_degrees();
        let mut exact = vec![];
        for (v, value) in subject.description.variables().iter().zip(&self.values) {
            let Some((x, has_unit)) = *value else { continue };
            let steps = if is_degrees && !has_unit { x / 15.0 } else { x.to_degrees() / 15.0 };
            if (steps - steps.round()).abs() > 1e-9 || v.kind == JointKind::Prismatic && x != 0.0 {
                return None;
            }
            exact.push((v.symbol, Expr::pi() * Expr::from(Rational::new(steps.round() as i64, 12))));
        }
        Some(e.substitute(|s| exact.iter().find(|x| x.0 == s).map(|x| x.1)))
    }

    /// The value of a formula, lengths by the robot's file.
    fn value(&self, e: Expr, subject: &Subject, unit: Unit, is_turned: bool) -> Option<f64> {
        let d = &subject.description;
        let variables = d.variables();
        let value = |s: Symbol| {
            if let Some(j) = variables.iter().position(|v| v.symbol == s) {
                let (x, has_unit) = (*self.values.get(j)?)?;
                let is_angle = variables[j].kind == JointKind::Revolute;
                return Some(match () {
                    () if is_turned && is_angle && has_unit => x.to_degrees(),
                    () if is_angle && !has_unit && unit == Unit::Degrees => x.to_radians(),
                    () => x,
                });
            }
            self.length(s).or_else(|| d.value(s))
        };
        e.eval(value).ok().filter(|x| x.is_finite())
    }

    /// The value of a formula, angles without unit as they look.
    pub fn number(&self, e: Expr, subject: &Subject) -> Option<f64> {
        let unit = if self.looks_like_degrees() { Unit::Degrees } else { Unit::Radians };
        self.value(e, subject, unit, false)
    }

    /// True if an angle without unit is more than a turn in radians, or a multiple of 5 other than 0.
    fn looks_like_degrees(&self) -> bool {
        let bare = self.values.iter().flatten().filter(|v| !v.1).map(|v| v.0);
        bare.clone().any(|x| x.abs() > TAU || x != 0.0 && x % 5.0 == 0.0)
    }
}

/// A number and the factor of the unit behind it, to metres, radians and seconds, and to which power of a length it is
/// proportional; nothing where there is no unit.
pub(super) fn unit_behind(text: &str) -> Option<(&str, Expr, u32)> {
    let plain = text.trim().trim_end_matches(['.', ',', ' ', '$', '}']);
    // `57956 mm^2`
    let squares = ["^2", "²", "^{2", "}^2", "}^{2"];
    let mut squared = squares.iter().filter_map(|s| simple_unit_behind(plain.strip_suffix(s)?));
    let square =
        squared.find(|(_, _, power)| *power == 1).map(|(before, factor, _)| (before, factor * factor, 2));
    let cubes = ["^3", "³", "^{3", "}^3", "}^{3"];
    let mut cubed = cubes.iter().filter_map(|s| simple_unit_behind(plain.strip_suffix(s)?));
    let cube = cubed.find(|(_, _, power)| *power == 1).map(|(before, factor, _)| (before, factor.powi(3), 3));
    square.or(cube).or_else(|| simple_unit_behind(text))
}

/// The same for a unit that is no power.
fn simple_unit_behind(text: &str) -> Option<(&str, Expr, u32)> {
    let degree = Expr::pi() / Expr::int(180);
    let part = |n: i64| Expr::int(1) / Expr::int(n);
    let units: [(&str, Expr); 36] = [
        ("rad/s", Expr::int(1)),
        ("deg/s", degree),
        ("°/s", degree),
        ("mm/s", part(1000)),
        ("cm/s", part(100)),
        ("m/s", Expr::int(1)),
        ("kN*m", Expr::int(1000)),
        ("kN·m", Expr::int(1000)),
        ("kN m", Expr::int(1000)),
        ("kNm", Expr::int(1000)),
        ("kN", Expr::int(1000)),
        ("N\\,m", Expr::int(1)),
        ("N\\cdot m", Expr::int(1)),
        ("N\\cdot\\mathrm{m", Expr::int(1)),
        ("N~m", Expr::int(1)),
        ("N*m", Expr::int(1)),
        ("N·m", Expr::int(1)),
        ("N m", Expr::int(1)),
        ("Nm", Expr::int(1)),
        ("N", Expr::int(1)),
        ("rad", Expr::int(1)),
        ("grad", degree),
        ("grados", degree),
        ("gradi", degree),
        ("graus", degree),
        ("graden", degree),
        ("degrees", degree),
        ("degree", degree),
        ("degrés", degree),
        ("Grad", degree),
        ("deg", degree),
        ("°", degree),
        ("mm", part(1000)),
        ("cm", part(100)),
        ("metres", Expr::int(1)),
        ("m", Expr::int(1)),
    ];
    let plain = text.trim().trim_end_matches(['.', ',', ' ', '$', '}']);
    for (unit, factor) in units {
        let Some(before) = plain.strip_suffix(unit) else { continue };
        let before = ["\\mathrm{", "\\text{", "\\,", "\\;", "~", "\\ ", "\\"]
            .iter()
            .fold(before.trim_end(), |b, look| b.strip_suffix(look).unwrap_or(b).trim_end());
        let is_number = before.ends_with(|c: char| c.is_ascii_digit() || matches!(c, '.' | ')' | 'π'));
        if is_number && before.starts_with(|c: char| !c.is_alphabetic()) {
            return Some((before, factor, u32::from(unit.contains(['m', 'M']))));
        }
    }
    None
}

/// Half a unit of the last digit of a printed number: 0.005 for `-0.71`.
pub(super) fn half_unit(text: &str) -> f64 {
    let plain = with_exponent(text);
    let text = plain.as_str();
    let is_part = |c: char| c.is_ascii_digit() || c == '.';
    let literals: Vec<&str> =
        text.split(|c: char| !is_part(c)).filter(|w| w.contains('.') && w.len() > 1).collect();
    if literals.len() > 1 {
        // A formula of rounded numbers.
        return 2.0 * literals.into_iter().map(half_unit).fold(0.0, f64::max);
    }
    let digits = text.trim().trim_matches(|c: char| !c.is_ascii_digit() && c != '.');
    let (mantissa, power) = match digits.split_once(['e', 'E']) {
        Some((m, p)) => (m, p.parse::<i32>().unwrap_or(0)),
        None => (digits, 0),
    };
    let decimals =
        mantissa.split_once('.').map_or(0, |(_, d)| d.chars().filter(char::is_ascii_digit).count());
    0.5 * 10_f64.powi(power - i32::try_from(decimals.min(300)).unwrap_or(300))
}

/// `1.195\cdot10^{5}` as `1.195e5`.
fn with_exponent(text: &str) -> String {
    let plain = text.replace(['{', '}', ' ', '~'], "");
    let powers = ["\\cdot10^", "\\times10^", "·10^", "×10^", "*10^"];
    powers.iter().find(|p| plain.contains(**p)).map_or_else(|| text.into(), |p| plain.replacen(p, "e", 1))
}

/// The verdict on a number: at the present configuration, or at one that was found before, of which a later part may speak.
pub(super) fn judge(answer: &Answer, subject: &Subject, tolerance: Option<f64>) -> Finding {
    let here = judge_here(answer, subject, tolerance);
    let there = |at| judge_here(&Answer { at, ..answer.clone() }, subject, tolerance);
    // What is right at another configuration of the document may be said of that one.
    let is_told = || answer.at.told_before().map(there).any(|f| matches!(f, Finding::Equal { .. }));
    let is_open = !matches!(here, Finding::Equal { .. } | Finding::Wrong(_));
    let here = match here {
        Finding::Wrong(_) if answer.printed != 0.0 && is_told() => {
            Finding::Undecided { why: Unproved::OtherConfiguration }
        }
        here => here,
    };
    // Nothing is known here: then it is said of the one that it is right at.
    if is_open && tells(answer) && is_told() {
        return Finding::Equal { unless_zero: vec![] };
    }
    if matches!(here, Finding::Equal { .. }) || answer.at.found.is_empty() {
        return here;
    }
    let others: Vec<Finding> = answer.at.earlier().map(there).collect();
    let is_right = |f: &Finding| matches!(f, Finding::Equal { .. });
    let is_wrong = |f: &Finding| matches!(f, Finding::Wrong(_));
    let right = others.iter().find(|f| is_right(f)).cloned();
    let other = || others.into_iter().rfind(is_wrong).filter(|_| !is_wrong(&here));
    right.or_else(other).unwrap_or(here)
}

/// True for a number with two digits or more: one with fewer is right at many configurations.
fn tells(answer: &Answer) -> bool {
    const UNITS: f64 = 20.0;
    answer.printed.abs() >= UNITS * answer.half && answer.printed.abs() != 1.0 && answer.printed != 0.0
}

fn judge_here(answer: &Answer, subject: &Subject, tolerance: Option<f64>) -> Finding {
    // One unit of the last digit: what was computed from other rounded numbers is off by as much.
    let allowed = tolerance.unwrap_or_else(|| allowed(answer));
    let units = match answer.at.looks_like_degrees() {
        true => [Unit::Degrees, Unit::Radians],
        false => [Unit::Radians, Unit::Degrees],
    };
    let at = |unit, turned| answer.at.value(answer.wanted, subject, unit, turned);
    let Some(right) = at(units[0], false) else {
        let rates = subject.rates();
        let is_open = |s: &Symbol| rates.contains(&(*s).into()) && answer.at.length(*s).is_none();
        let why = match answer.wanted.symbols().iter().any(is_open) {
            true => Unproved::NoRate,
            false => Unproved::NoLength,
        };
        return Finding::Undecided { why };
    };
    let near = |x: f64, allowed: f64| (x - answer.printed).abs() <= allowed;
    if near(right, allowed) {
        return Finding::Equal { unless_zero: vec![] };
    }
    // An angle in degrees beside others in degrees: `θ2 = 90, θ3 = -30: φ = 60`.
    if units[0] == Unit::Degrees && is_angle(answer.wanted, subject) && near(right.to_degrees(), allowed) {
        return Finding::Equal { unless_zero: vec![] };
    }
    // A table in centimetres, of which nothing else says so.
    if near(right / 100.0, allowed) && answer.printed != 0.0 && right.abs() > 1.0 {
        return Finding::Equal { unless_zero: vec![] };
    }
    // Areas and volumes in another unit of length: a number of another size is none of this one.
    let ratio = (answer.printed / right).abs();
    if right.abs() > 1e-6 && ratio > 0.0 && !(3e-5..3e4).contains(&ratio) {
        let is_there = [1e6, 1e-6, 1e9, 1e-9].into_iter().any(|k| near(right * k, allowed));
        return match is_there {
            true => Finding::Equal { unless_zero: vec![] },
            false => Finding::Undecided { why: Unproved::NotFound },
        };
    }
    let mut wrong = Wrong { correct: vec![decimal(right)], ..Wrong::default() };
    let other = at(units[1], false).filter(|x| near(*x, allowed));
    let turned = at(units[0], true).filter(|x| near(*x, allowed));
    // Zero is right in every unit.
    let scaled = [1000.0, 0.001].into_iter().filter(|_| answer.printed != 0.0);
    let scaled = scaled.into_iter().find(|k| near(right * k, allowed * k.max(1.0)));
    wrong.remarks.push(match (other.or(turned), scaled) {
        (Some(_), _) => Remark::AngleUnit,
        (None, Some(k)) if k > 1.0 => Remark::Millimetres,
        (None, Some(_)) => Remark::Metres,
        (None, None) if near(-right, allowed) => Remark::Sign,
        (None, None) if near(right, 4.0 * allowed) && 4.0 * allowed <= TELLING * right.abs() => {
            Remark::LastDigit
        }
        (None, None) => Remark::OffBy((answer.printed - right).abs()),
    });
    Finding::Wrong(Box::new(wrong))
}

/// True for a sum of joints that turn, with whole parts of a turn.
fn is_angle(e: Expr, subject: &Subject) -> bool {
    let angle = Angle::of(e);
    let turns = |e: Expr| {
        let variables = subject.description.variables();
        variables.iter().any(|v| Expr::from(v.symbol) == e && v.kind == JointKind::Revolute)
    };
    !angle.terms.is_empty() && angle.radians.is_zero() && angle.terms.iter().all(|t| turns(t.0))
}

/// How far a number may be off: zero and one are meant so, other whole numbers are rounded, and so are those with so few digits
/// that a unit of the last one is no small part.
fn allowed(answer: &Answer) -> f64 {
    let is_whole = answer.printed.fract() == 0.0 && answer.half >= 0.5;
    let is_coarse = answer.half >= 0.05 && answer.half * 3.0 > TELLING * answer.printed.abs();
    match is_whole {
        true if answer.printed.abs() <= 1.0 => 5e-3,
        true => answer.half * 1.01,
        false if is_coarse => answer.half * 1.01 + 1e-12,
        false => answer.half * 3.0 + 1e-12,
    }
}

/// The part of a number by which it may be off in its last digit and still tell the same.
const TELLING: f64 = 0.02;

/// True if a number is what follows from other rounded numbers.
pub(super) fn is_near(answer: &Answer, subject: &Subject) -> bool {
    matches!(judge(answer, subject, Some(answer.half * 6.0 + 1e-12)), Finding::Equal { .. })
}

/// A number with at most six digits behind the point.
pub fn decimal(x: f64) -> String {
    let text = format!("{x:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.to_string() }
}

#[cfg(test)]
mod tests {
    use super::half_unit;

    #[test]
    fn the_last_digit_says_how_exact_a_number_is() {
        for (text, half) in
            [("1.195\\cdot10^{5}", 50.0), ("0.71", 0.005), ("-12", 0.5), ("1.50e-3", 0.000_005), ("3", 0.5)]
        {
            assert!((half_unit(text) - half).abs() < 1e-12, "{text}: {}", half_unit(text));
        }
    }
}
