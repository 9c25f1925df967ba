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
            Quantity::Number | Quantity::Open => (None, ""),
        }
    }
}

/// A unit: how it is written, what it measures, and its factor `numerator / denominator`, times π where `pi`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Unit {
    pub name: &'static str,
    pub quantity: Quantity,
    numerator: i64,
    denominator: i64,
    pi: bool,
}

impl Unit {
    /// What one of it is in SI.
    pub fn factor(self) -> Expr {
        let number = Expr::from(Rational::new(self.numerator, self.denominator));
        if self.pi { number * Expr::pi() } else { number }
    }
}

const fn unit(name: &'static str, quantity: Quantity, numerator: i64, denominator: i64) -> Unit {
    Unit { name, quantity, numerator, denominator, pi: false }
}

const fn turn(name: &'static str, quantity: Quantity, numerator: i64, denominator: i64) -> Unit {
    Unit { name, quantity, numerator, denominator, pi: true }
}

/// All of them. A longer name wins over a shorter one that begins it.
const UNITS: &[Unit] = &[
    turn("°", Quantity::Angle, 1, 180),
    turn("º", Quantity::Angle, 1, 180),
    turn("˚", Quantity::Angle, 1, 180),
    turn("deg", Quantity::Angle, 1, 180),
    turn("degree", Quantity::Angle, 1, 180),
    turn("degrees", Quantity::Angle, 1, 180),
    turn("turn", Quantity::Angle, 2, 1),
    turn("turns", Quantity::Angle, 2, 1),
    unit("rad", Quantity::Angle, 1, 1),
    unit("radian", Quantity::Angle, 1, 1),
    unit("radians", Quantity::Angle, 1, 1),
    unit("mrad", Quantity::Angle, 1, 1000),
    unit("m", Quantity::Length, 1, 1),
    unit("metre", Quantity::Length, 1, 1),
    unit("metres", Quantity::Length, 1, 1),
    unit("meter", Quantity::Length, 1, 1),
    unit("meters", Quantity::Length, 1, 1),
    unit("dm", Quantity::Length, 1, 10),
    unit("cm", Quantity::Length, 1, 100),
    unit("mm", Quantity::Length, 1, 1000),
    unit("um", Quantity::Length, 1, 1_000_000),
    unit("µm", Quantity::Length, 1, 1_000_000),
    unit("μm", Quantity::Length, 1, 1_000_000),
    unit("in", Quantity::Length, 254, 10_000),
    unit("inch", Quantity::Length, 254, 10_000),
    unit("inches", Quantity::Length, 254, 10_000),
    unit("ft", Quantity::Length, 3048, 10_000),
    turn("deg/s", Quantity::AngularVelocity, 1, 180),
    turn("°/s", Quantity::AngularVelocity, 1, 180),
    turn("rpm", Quantity::AngularVelocity, 1, 30),
    unit("rad/s", Quantity::AngularVelocity, 1, 1),
    unit("m/s", Quantity::Velocity, 1, 1),
    unit("cm/s", Quantity::Velocity, 1, 100),
    unit("mm/s", Quantity::Velocity, 1, 1000),
    turn("deg/s^2", Quantity::AngularAcceleration, 1, 180),
    turn("deg/s²", Quantity::AngularAcceleration, 1, 180),
    turn("°/s^2", Quantity::AngularAcceleration, 1, 180),
    turn("°/s²", Quantity::AngularAcceleration, 1, 180),
    unit("rad/s^2", Quantity::AngularAcceleration, 1, 1),
    unit("rad/s²", Quantity::AngularAcceleration, 1, 1),
    unit("m/s^2", Quantity::Acceleration, 1, 1),
    unit("m/s²", Quantity::Acceleration, 1, 1),
    unit("mm/s^2", Quantity::Acceleration, 1, 1000),
    unit("mm/s²", Quantity::Acceleration, 1, 1000),
    unit("kg", Quantity::Mass, 1, 1),
    unit("g", Quantity::Mass, 1, 1000),
    unit("lb", Quantity::Mass, 45_359_237, 100_000_000),
    unit("kg m^2", Quantity::Inertia, 1, 1),
    unit("kg m²", Quantity::Inertia, 1, 1),
    unit("kg*m^2", Quantity::Inertia, 1, 1),
    unit("kg·m²", Quantity::Inertia, 1, 1),
    unit("kg m", Quantity::FirstMoment, 1, 1),
    unit("kg*m", Quantity::FirstMoment, 1, 1),
    unit("kg·m", Quantity::FirstMoment, 1, 1),
    unit("g mm", Quantity::FirstMoment, 1, 1_000_000),
    unit("g mm^2", Quantity::Inertia, 1, 1_000_000_000),
    unit("g mm²", Quantity::Inertia, 1, 1_000_000_000),
];

/// The longest unit at the beginning of `text` that no letter or digit continues.
pub(super) fn unit_at(text: &str) -> Option<Unit> {
    let ends = |u: &Unit| {
        let last_is_letter = u.name.ends_with(|c: char| c.is_alphanumeric());
        let next = text[u.name.len()..].chars().next();
        !last_is_letter || !next.is_some_and(|c| c.is_alphanumeric() || c == '_')
    };
    UNITS.iter().filter(|u| text.starts_with(u.name) && ends(u)).max_by_key(|u| u.name.len()).copied()
}

/// The unit with this name.
pub(super) fn unit_named(name: &str) -> Option<Unit> {
    unit_at(name).filter(|u| u.name == name)
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
            ("", None),
        ] {
            assert_eq!(unit_at(text).map(|u| u.name), name, "{text}");
        }
    }
}
