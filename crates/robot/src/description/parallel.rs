//! Parallel robots as described: a platform on several legs at once.

use super::{Measure, MissingValue, NotSet, Parameter, read_value};
use crate::geometry::{Transform, Vector};
use denavit_symbolic::{Expr, Symbol};

/// A parallel robot of one of three families; lengths are metres, angles radians.
#[derive(Clone, Debug)]
pub struct Parallel {
    /// Its name.
    pub name: String,
    /// Where the numbers come from.
    pub source: Option<String>,
    /// Names with their values.
    pub parameters: Vec<Parameter>,
    /// Its geometry.
    pub family: Family<Expr>,
    /// The least and the greatest value of each drive, one pair for all or one a drive.
    pub limits: Vec<[Expr; 2]>,
    /// Places of the platform or of the drives, by name.
    pub poses: Vec<(String, Place)>,
}

/// What a robot is made of.
#[derive(Clone, PartialEq, Debug)]
pub enum Family<T> {
    /// Six legs between points of a base and points of a platform: a Stewart platform, Gough's hexapod.
    Stewart {
        /// In the base.
        base: [Vector<T>; 6],
        /// In the platform.
        platform: [Vector<T>; 6],
    },
    /// Three arms with rods that keep the platform parallel to the base.
    Delta {
        /// From the middle of the base to the axes of the arms, or to where slides begin.
        base_radius: T,
        /// From the middle of the platform to its rods.
        platform_radius: T,
        /// The length of the rods.
        lower_arm: T,
        /// The arms' angles around z.
        angles: [T; 3],
        /// How they are driven.
        drive: DeltaDrive<T>,
    },
    /// Three legs of two links in the plane, turned at the base.
    Planar3Rrr {
        /// In the base.
        base: [[T; 2]; 3],
        /// In the platform.
        platform: [[T; 2]; 3],
        /// The links that are driven.
        proximal: [T; 3],
        /// Those behind them.
        distal: [T; 3],
    },
}

/// How the arms of a delta are driven.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum DeltaDrive<T> {
    /// An arm of this length turns.
    Turns(T),
    /// A slide, at this angle below the horizontal, outwards.
    Slides(T),
}

/// A place with a name.
#[derive(Clone, Debug)]
pub enum Place {
    /// Values of the drives.
    Drives(Vec<Expr>),
    /// A pose of the platform.
    Platform(Transform<Expr>),
}

impl<T: Copy> Family<T> {
    /// `gough-stewart`, `delta` or `planar-3rrr`.
    pub fn kind(&self) -> &'static str {
        match self {
            Family::Stewart { .. } => "gough-stewart",
            Family::Delta { .. } => "delta",
            Family::Planar3Rrr { .. } => "planar-3rrr",
        }
    }

    /// How many drives it has.
    pub fn drives(&self) -> usize {
        if matches!(self, Family::Stewart { .. }) { 6 } else { 3 }
    }

    /// What its drives are: angles, or lengths.
    pub fn measure(&self) -> Measure {
        match self {
            Family::Stewart { .. } | Family::Delta { drive: DeltaDrive::Slides(_), .. } => Measure::Length,
            Family::Delta { .. } | Family::Planar3Rrr { .. } => Measure::Angle,
        }
    }

    /// What a drive is called: `l1` for the length of a leg, `q1` otherwise.
    pub fn drive_name(&self, k: usize) -> String {
        let letter = if matches!(self, Family::Stewart { .. }) { 'l' } else { 'q' };
        format!("{letter}{}", k + 1)
    }

    /// The same with another kind of numbers.
    pub fn map<U>(&self, mut f: impl FnMut(T) -> U) -> Family<U> {
        match self {
            Family::Stewart { base, platform } => Family::Stewart {
                base: base.map(|p| Vector(p.0.map(&mut f))),
                platform: platform.map(|p| Vector(p.0.map(&mut f))),
            },
            Family::Delta { base_radius, platform_radius, lower_arm, angles, drive } => Family::Delta {
                base_radius: f(*base_radius),
                platform_radius: f(*platform_radius),
                lower_arm: f(*lower_arm),
                angles: angles.map(&mut f),
                drive: match drive {
                    DeltaDrive::Turns(arm) => DeltaDrive::Turns(f(*arm)),
                    DeltaDrive::Slides(slope) => DeltaDrive::Slides(f(*slope)),
                },
            },
            Family::Planar3Rrr { base, platform, proximal, distal } => Family::Planar3Rrr {
                base: base.map(|p| p.map(&mut f)),
                platform: platform.map(|p| p.map(&mut f)),
                proximal: proximal.map(&mut f),
                distal: distal.map(&mut f),
            },
        }
    }
}

impl Parallel {
    /// The value of a name, if it has one.
    fn value(&self, symbol: Symbol) -> Option<f64> {
        self.parameters.iter().find(|p| p.symbol == symbol)?.number()
    }

    /// A cell as a number.
    ///
    /// # Errors
    /// If a parameter in it has no value.
    pub fn number(&self, e: Expr) -> Result<f64, MissingValue> {
        let symbols: Vec<Symbol> = e.symbols().into_iter().collect();
        denavit_program::values(&symbols, |s| self.value(s))?;
        Ok(e.eval(|s| self.value(s)).unwrap_or(f64::NAN))
    }

    /// The geometry in numbers.
    ///
    /// # Errors
    /// If a parameter has no value.
    pub fn numbers(&self) -> Result<Family<f64>, MissingValue> {
        let mut symbols: Vec<Symbol> = vec![];
        self.family.map(|e| symbols.extend(e.symbols()));
        symbols.sort_unstable_by_key(|s| self.parameters.iter().position(|p| p.symbol == *s));
        symbols.dedup();
        denavit_program::values(&symbols, |s| self.value(s))?;
        Ok(self.family.map(|e| e.eval(|s| self.value(s)).unwrap_or(f64::NAN)))
    }

    /// What a parameter measures: an angle if it stands in one alone, else a length.
    fn measure(&self, symbol: Symbol) -> Measure {
        let angles: Vec<Expr> = match &self.family {
            Family::Delta { angles, drive, .. } => {
                let slope = if let DeltaDrive::Slides(slope) = drive { Some(*slope) } else { None };
                angles.iter().copied().chain(slope).collect()
            }
            Family::Stewart { .. } | Family::Planar3Rrr { .. } => vec![],
        };
        let is_angle = angles.iter().any(|e| e.symbols().contains(&symbol));
        if is_angle { Measure::Angle } else { Measure::Length }
    }

    /// Gives a parameter a value, as in a robot file.
    ///
    /// # Errors
    /// If there is no such parameter, or the text is no value.
    pub fn set(&mut self, name: &str, value: &str) -> Result<(), NotSet> {
        let symbol = Symbol::new(name.trim());
        let known = || self.parameters.iter().map(|p| p.symbol.name().to_string()).collect();
        let Some(at) = self.parameters.iter().position(|p| p.symbol == symbol) else {
            return Err(NotSet::Unknown { name: name.trim().into(), known: known() });
        };
        let read = read_value(value.trim(), self.measure(symbol)).map_err(NotSet::Value)?;
        self.parameters[at].value = Some(read);
        Ok(())
    }
}
