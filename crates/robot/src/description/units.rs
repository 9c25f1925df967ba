//! Units, and the exact factors that take them to SI.

use denavit_symbolic::{Expr, Rational};

/// What a cell measures.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Quantity {
    /// Radians.
    Angle,
    /// Metres.
    Length,
    /// Radians per second.
    AngularVelocity,
    /// Metres per second.
    Velocity,
    /// Radians per second squared.
    AngularAcceleration,
    /// Metres per second squared.
    Acceleration,
    /// Kilograms.
    Mass,
    /// Kilogram square metres.
    Inertia,
    /// Kilogram metres.
    FirstMoment,
    /// Newtons.
    Force,
    /// Newton metres.
    Torque,
    /// Torque by angular velocity, newton metre seconds a radian.
    AngularDamping,
    /// Force by velocity, newton seconds a metre.
    Damping,
    /// A plain number.
    Number,
    /// A parameter: the first unit that occurs decides, none leaves it open.
    Open,
}

impl Quantity {
    /// As said in a message.
    pub(super) fn name(self) -> &'static str {
        match self {
            Quantity::Angle => "an angle",
            Quantity::Length => "a length",
            Quantity::AngularVelocity => "an angular velocity",
            Quantity::Velocity => "a velocity",
            Quantity::AngularAcceleration => "an angular acceleration",
            Quantity::Acceleration => "an acceleration",
            Quantity::Mass => "a mass",
            Quantity::Inertia => "a moment of inertia",
            Quantity::FirstMoment => "a first moment of mass",
            Quantity::Force => "a force",
            Quantity::Torque => "a torque",
            Quantity::AngularDamping => "a torque by an angular velocity",
            Quantity::Damping => "a force by a velocity",
            Quantity::Number => "a plain number",
            Quantity::Open => "a length or an angle",
        }
    }

    /// The units to write a multiple of π and any other number in.
    pub(super) fn units(self) -> (Option<&'static str>, &'static str) {
        match self {
            Quantity::Angle => (Some("deg"), "rad"),
            Quantity::AngularVelocity => (Some("deg/s"), "rad/s"),
            Quantity::AngularAcceleration => (Some("deg/s^2"), "rad/s^2"),
            Quantity::Length => (None, "m"),
            Quantity::Velocity => (None, "m/s"),
            Quantity::Acceleration => (None, "m/s^2"),
            Quantity::Mass => (None, "kg"),
            Quantity::Inertia => (None, "kg m^2"),
            Quantity::FirstMoment => (None, "kg m"),
            Quantity::Force => (None, "N"),
            Quantity::Torque => (None, "N m"),
            Quantity::AngularDamping => (None, "N m s/rad"),
            Quantity::Damping => (None, "N s/m"),
            Quantity::Number | Quantity::Open => (None, ""),
        }
    }
}

/// A unit as it stands in a text: how many bytes it is, what it measures, and its factor `numerator / denominator`, times
/// `π^pi`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Unit {
    pub length: usize,
    pub quantity: Quantity,
    numerator: i64,
    denominator: i64,
    pi: i8,
}

impl Unit {
    /// What one of it is in SI.
    pub fn factor(self) -> Expr {
        let number = Expr::from(Rational::new(self.numerator, self.denominator));
        match self.pi {
            0 => number,
            1 => number * Expr::pi(),
            n => number * Expr::pi().powi(i32::from(n)),
        }
    }
}

/// Exponents of kilogram, metre, second and radian.
type Dimension = [i8; 4];

const ANGLE: Dimension = [0, 0, 0, 1];
const LENGTH: Dimension = [0, 1, 0, 0];
const TIME: Dimension = [0, 0, 1, 0];
const MASS: Dimension = [1, 0, 0, 0];
const FORCE: Dimension = [1, 1, -2, 0];
const TORQUE: Dimension = [1, 2, -2, 0];

/// What has which dimension. A radian is a number where torques are multiplied by time.
const QUANTITIES: &[(Dimension, Quantity)] = &[
    (ANGLE, Quantity::Angle),
    (LENGTH, Quantity::Length),
    ([0, 0, -1, 1], Quantity::AngularVelocity),
    ([0, 1, -1, 0], Quantity::Velocity),
    ([0, 0, -2, 1], Quantity::AngularAcceleration),
    ([0, 1, -2, 0], Quantity::Acceleration),
    (MASS, Quantity::Mass),
    ([1, 2, 0, 0], Quantity::Inertia),
    ([1, 1, 0, 0], Quantity::FirstMoment),
    (FORCE, Quantity::Force),
    (TORQUE, Quantity::Torque),
    ([1, 2, -1, -1], Quantity::AngularDamping),
    ([1, 2, -1, 0], Quantity::AngularDamping),
    ([1, 0, -1, 0], Quantity::Damping),
];

/// A word of units.
struct Word {
    name: &'static str,
    dimension: Dimension,
    numerator: i64,
    denominator: i64,
    pi: i8,
}

const fn word(name: &'static str, dimension: Dimension, numerator: i64, denominator: i64) -> Word {
    Word { name, dimension, numerator, denominator, pi: 0 }
}

const fn turn(name: &'static str, dimension: Dimension, numerator: i64, denominator: i64) -> Word {
    Word { name, dimension, numerator, denominator, pi: 1 }
}

/// All of them. A longer name wins over a shorter one that begins it.
const WORDS: &[Word] = &[
    turn("°", ANGLE, 1, 180),
    turn("º", ANGLE, 1, 180),
    turn("˚", ANGLE, 1, 180),
    turn("deg", ANGLE, 1, 180),
    turn("degree", ANGLE, 1, 180),
    turn("degrees", ANGLE, 1, 180),
    turn("turn", ANGLE, 2, 1),
    turn("turns", ANGLE, 2, 1),
    word("rad", ANGLE, 1, 1),
    word("radian", ANGLE, 1, 1),
    word("radians", ANGLE, 1, 1),
    word("mrad", ANGLE, 1, 1000),
    word("m", LENGTH, 1, 1),
    word("metre", LENGTH, 1, 1),
    word("metres", LENGTH, 1, 1),
    word("meter", LENGTH, 1, 1),
    word("meters", LENGTH, 1, 1),
    word("dm", LENGTH, 1, 10),
    word("cm", LENGTH, 1, 100),
    word("mm", LENGTH, 1, 1000),
    word("um", LENGTH, 1, 1_000_000),
    word("µm", LENGTH, 1, 1_000_000),
    word("μm", LENGTH, 1, 1_000_000),
    word("in", LENGTH, 254, 10_000),
    word("inch", LENGTH, 254, 10_000),
    word("inches", LENGTH, 254, 10_000),
    word("ft", LENGTH, 3048, 10_000),
    turn("rpm", [0, 0, -1, 1], 1, 30),
    word("s", TIME, 1, 1),
    word("ms", TIME, 1, 1000),
    word("min", TIME, 60, 1),
    word("kg", MASS, 1, 1),
    word("g", MASS, 1, 1000),
    word("lb", MASS, 45_359_237, 100_000_000),
    word("N", FORCE, 1, 1),
    word("kN", FORCE, 1000, 1),
    word("mN", FORCE, 1, 1000),
    word("Nm", TORQUE, 1, 1),
    word("kNm", TORQUE, 1000, 1),
    word("mNm", TORQUE, 1, 1000),
    word("Nmm", TORQUE, 1, 1000),
];

/// Words that one unit is made of, at most.
const MOST_WORDS: usize = 6;

/// A product of words with powers, so far.
#[derive(Clone, Copy)]
struct Product {
    dimension: Dimension,
    numerator: i64,
    denominator: i64,
    pi: i8,
}

impl Product {
    /// Times a word to a power; `None` if numbers become too large.
    fn times(self, word: &Word, power: i8) -> Option<Self> {
        let mut all = self;
        for (sum, d) in all.dimension.iter_mut().zip(word.dimension) {
            *sum = sum.checked_add(d.checked_mul(power)?)?;
        }
        all.pi = all.pi.checked_add(word.pi.checked_mul(power)?)?;
        let (above, below) = match power < 0 {
            true => (word.denominator, word.numerator),
            false => (word.numerator, word.denominator),
        };
        for _ in 0..power.unsigned_abs() {
            all.numerator = all.numerator.checked_mul(above)?;
            all.denominator = all.denominator.checked_mul(below)?;
        }
        Some(all)
    }

    fn quantity(&self) -> Option<Quantity> {
        QUANTITIES.iter().find(|(dimension, _)| *dimension == self.dimension).map(|q| q.1)
    }
}

/// The longest unit at the beginning of `text` that no letter or digit continues: words with powers, with blanks or `*` between
/// them, or `/`: `mm`, `deg/s^2`, `kg m²`, `N·m·s/rad`. What is no quantity known here is no unit.
pub(super) fn unit_at(text: &str) -> Option<Unit> {
    let mut product = Product { dimension: [0; 4], numerator: 1, denominator: 1, pi: 0 };
    let (mut at, mut sign) = (0, 1);
    let mut found = None;
    for place in 0..MOST_WORDS {
        let Some(word) = word_at(&text[at..]) else { break };
        // A mass stands first; `m*g` is a length times what is called g.
        if place > 0 && word.dimension[0] != 0 {
            break;
        }
        at += word.name.len();
        let (power, length) = power_at(&text[at..]);
        at += length;
        let Some(next) = power.checked_mul(sign).and_then(|power| product.times(word, power)) else { break };
        product = next;
        if let Some(quantity) = product.quantity() {
            let Product { numerator, denominator, pi, .. } = product;
            found = Some(Unit { length: at, quantity, numerator, denominator, pi });
        }
        let Some((between, divides)) = separator_at(&text[at..]) else { break };
        at += between;
        // In `N m/rad s` only the radian is below.
        sign = if divides { -1 } else { 1 };
    }
    found
}

/// The longest word at the beginning of `text` that no letter or digit continues; a power may.
fn word_at(text: &str) -> Option<&'static Word> {
    let ends = |w: &&Word| {
        let last_is_letter = w.name.ends_with(|c: char| c.is_alphanumeric());
        let next = text[w.name.len()..].chars().next();
        let goes_on = |c: char| (c.is_alphanumeric() || c == '_') && !matches!(c, '¹' | '²' | '³');
        !last_is_letter || !next.is_some_and(goes_on)
    };
    WORDS.iter().filter(|w| text.starts_with(w.name)).filter(ends).max_by_key(|w| w.name.len())
}

/// The power at the beginning of `text` and its bytes: `²`, `^2`, `**2`, `^-1`; 1 if there is none.
fn power_at(text: &str) -> (i8, usize) {
    let raised = text.strip_prefix('⁻').unwrap_or(text);
    let sign = text.len() - raised.len();
    for (digit, power) in [('¹', 1), ('²', 2), ('³', 3)] {
        if raised.starts_with(digit) {
            return (if sign > 0 { -power } else { power }, sign + digit.len_utf8());
        }
    }
    let Some(rest) = text.strip_prefix("**").or_else(|| text.strip_prefix('^')) else { return (1, 0) };
    let digits = rest.strip_prefix('-').unwrap_or(rest);
    let digit = digits.bytes().next().filter(u8::is_ascii_digit);
    let is_one =
        !digits.as_bytes().get(1).is_some_and(|b| b.is_ascii_alphanumeric() || matches!(*b, b'.' | b'_'));
    match digit.filter(|_| is_one) {
        Some(digit) => {
            let size = (digit - b'0') as i8;
            (if digits.len() < rest.len() { -size } else { size }, text.len() - digits.len() + 1)
        }
        None => (1, 0),
    }
}

/// The bytes between two words at the beginning of `text`, and whether what follows is divided by.
fn separator_at(text: &str) -> Option<(usize, bool)> {
    let rest = text.trim_start_matches(' ');
    let blanks = text.len() - rest.len();
    let sign = rest.chars().next()?;
    match sign {
        '/' => Some((text.len() - rest[1..].trim_start_matches(' ').len(), true)),
        '*' | '·' | '⋅' | '×' if blanks == 0 => Some((sign.len_utf8(), false)),
        _ if blanks > 0 => Some((blanks, false)),
        _ => None,
    }
}

/// The unit that is all of this text.
pub(super) fn unit_named(name: &str) -> Option<Unit> {
    unit_at(name).filter(|u| u.length == name.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_unit_wins_and_words_are_not_cut() {
        for (text, name) in [
            ("mm", Some("mm")),
            ("m", Some("m")),
            ("deg/s^2 ", Some("deg/s^2")),
            ("deg/s", Some("deg/s")),
            ("deg + q1", Some("deg")),
            ("°", Some("°")),
            ("°C", Some("°")),
            ("m2", None),
            ("mass", None),
            ("in_x", None),
            ("kg m^2", Some("kg m^2")),
            ("kg m² + I", Some("kg m²")),
            ("kg·m^2/2", Some("kg·m^2")),
            ("N m s/rad", Some("N m s/rad")),
            ("N·m·s/rad", Some("N·m·s/rad")),
            ("N*m, 2", Some("N*m")),
            ("Nm", Some("Nm")),
            ("N s/m", Some("N s/m")),
            ("kg m s^-2", Some("kg m s^-2")),
            ("rad s⁻¹", Some("rad s⁻¹")),
            ("m / s^2", Some("m / s^2")),
            // What follows is a name, or measures nothing that is known.
            ("m*g", Some("m")),
            ("m * s", Some("m")),
            ("mm*m", Some("mm")),
            ("kg m^2_1", Some("kg m")),
            ("deg/2", Some("deg")),
            ("s", None),
            ("kg^9 kg^9 kg^9", None),
            ("m^-9/m^-9/m^-9/m^-9", None),
            ("", None),
        ] {
            assert_eq!(unit_at(text).map(|u| &text[..u.length]), name, "{text}");
        }
    }
}
