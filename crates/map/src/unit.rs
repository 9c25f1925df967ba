//! Units of columns: radians or degrees, metres or millimetres.

use std::str::FromStr;

/// The unit of angles.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Angle {
    /// Radians.
    #[default]
    Radian,
    /// Degrees.
    Degree,
}

/// The unit of lengths.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Length {
    /// Metres.
    #[default]
    Metre,
    /// Millimetres.
    Millimetre,
}

/// The units of columns that do not say theirs, and of those that are written.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Units {
    /// Of angles.
    pub angle: Angle,
    /// Of lengths.
    pub length: Length,
}

impl FromStr for Units {
    type Err = String;

    /// `deg`, `mm`, or both with a comma.
    fn from_str(text: &str) -> Result<Self, String> {
        let mut units = Units::default();
        for word in text.split(',').map(str::trim) {
            match word {
                "rad" => units.angle = Angle::Radian,
                "deg" => units.angle = Angle::Degree,
                "m" => units.length = Length::Metre,
                "mm" => units.length = Length::Millimetre,
                _ => return Err(format!("no unit `{word}`: rad or deg, m or mm, as in `deg,mm`")),
            }
        }
        Ok(units)
    }
}

/// What a number is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Quantity {
    /// An angle; or, by the number of seconds that it is divided by, a rate of one.
    Angle(u8),
    /// The same of a length.
    Length(u8),
    /// N m.
    Torque,
    /// N.
    Force,
    /// Without unit.
    Plain,
    /// With a unit that does not change.
    Named(&'static str),
}

/// How numbers of a column become radians and metres.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Scale {
    /// They are.
    One,
    /// From degrees.
    Degrees,
    /// From millimetres.
    Millimetres,
}

impl Scale {
    /// In radians and metres.
    pub fn apply(self, x: f64) -> f64 {
        match self {
            Scale::One => x,
            Scale::Degrees => x.to_radians(),
            Scale::Millimetres => x / 1000.0,
        }
    }

    /// From radians and metres.
    pub fn undo(self, x: f64) -> f64 {
        match self {
            Scale::One => x,
            Scale::Degrees => x.to_degrees(),
            Scale::Millimetres => x * 1000.0,
        }
    }
}

impl Quantity {
    /// Of a joint variable, or of a rate of it.
    pub fn of_joint(is_angle: bool, seconds: u8) -> Self {
        if is_angle { Quantity::Angle(seconds) } else { Quantity::Length(seconds) }
    }

    /// In these units.
    pub fn scale(self, units: Units) -> Scale {
        match (self, units) {
            (Quantity::Angle(_), Units { angle: Angle::Degree, .. }) => Scale::Degrees,
            (Quantity::Length(_), Units { length: Length::Millimetre, .. }) => Scale::Millimetres,
            _ => Scale::One,
        }
    }

    /// The name of its unit; nothing where it has none.
    pub fn unit(self, units: Units) -> Option<&'static str> {
        let of = |names: [&'static str; 3], seconds: u8| names.get(usize::from(seconds)).copied();
        match self {
            Quantity::Angle(s) => match units.angle {
                Angle::Radian => of(["rad", "rad/s", "rad/s^2"], s),
                Angle::Degree => of(["deg", "deg/s", "deg/s^2"], s),
            },
            Quantity::Length(s) => match units.length {
                Length::Metre => of(["m", "m/s", "m/s^2"], s),
                Length::Millimetre => of(["mm", "mm/s", "mm/s^2"], s),
            },
            Quantity::Torque => Some("N m"),
            Quantity::Force => Some("N"),
            Quantity::Plain => None,
            Quantity::Named(unit) => Some(unit),
        }
    }

    /// How a column that says its unit is read as this.
    ///
    /// # Errors
    /// If it is another quantity, or the unit is unknown.
    pub fn said(self, unit: &str) -> Result<Scale, String> {
        let lower = unit.trim().to_lowercase().replace('²', "^2").replace("**2", "^2");
        let (base, per) = lower.split_once('/').map_or((lower.as_str(), ""), |(b, p)| (b.trim(), p.trim()));
        let seconds: u8 = match per {
            "" => 0,
            "s" | "sec" => 1,
            "s^2" | "s2" | "sec^2" => 2,
            _ => return Err(format!("in `{unit}`, which is not known")),
        };
        let found = match base {
            "rad" | "radian" | "radians" => (Quantity::Angle(seconds), Scale::One),
            "deg" | "degree" | "degrees" | "°" => (Quantity::Angle(seconds), Scale::Degrees),
            "m" | "metre" | "metres" | "meter" | "meters" => (Quantity::Length(seconds), Scale::One),
            "mm" | "millimetre" | "millimetres" | "millimeter" | "millimeters" => {
                (Quantity::Length(seconds), Scale::Millimetres)
            }
            _ => return Err(format!("in `{unit}`, which is not known")),
        };
        let wanted = self.unit(Units::default()).unwrap_or("no unit");
        // A bare unit behind a name stands for the rate that the column is.
        let fits = match (self, found.0) {
            (Quantity::Angle(own), Quantity::Angle(said))
            | (Quantity::Length(own), Quantity::Length(said)) => own == said || said == 0,
            _ => false,
        };
        if fits { Ok(found.1) } else { Err(format!("in `{unit}`, and {wanted} is what is needed")) }
    }
}
