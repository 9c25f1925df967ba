//! Single values with units, as they stand on a command line or in a form.

use super::cell::{Place, Style, read_cell};
use super::diagnostic::{Diagnostic, Diagnostics};
use super::units::{Quantity, unit_named};
use super::{Description, JointKind, Row};
use denavit_symbolic::{Expr, Node, Symbol};
use rustc_hash::FxHashSet;
use std::fmt;

/// What a value measures.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Measure {
    /// Radians.
    Angle,
    /// Metres.
    Length,
    /// Something of masses and drives, by its unit of the SI; without one where that is open.
    Other(&'static str),
}

impl From<JointKind> for Measure {
    fn from(kind: JointKind) -> Self {
        match kind {
            JointKind::Revolute => Measure::Angle,
            JointKind::Prismatic => Measure::Length,
        }
    }
}

impl From<Measure> for Quantity {
    fn from(measure: Measure) -> Self {
        match measure {
            Measure::Angle => Quantity::Angle,
            Measure::Length => Quantity::Length,
            Measure::Other(unit) => unit_named(unit).map_or(Quantity::Open, |u| u.quantity),
        }
    }
}

/// Reads a constant with or without unit: `90 deg`, `-pi/2`, `20 mm`, `0.1`.
///
/// # Errors
/// If the text is no finite constant, or has a unit of something else.
pub fn read_value(text: &str, measure: Measure) -> Result<Expr, Vec<Diagnostic>> {
    let quantity = Quantity::from(measure);
    let mut out = Diagnostics::default();
    let place = Place { span: 0..text.len(), start: Some(0) };
    let value = read_cell(text, &place, &Style::plain(quantity), &mut out);
    if let Some(value) = &value {
        for (name, span) in &value.symbols {
            out.error(span.clone(), format!("`{name}` is no number"));
        }
        let number = value.expr.eval(|_| None);
        if value.symbols.is_empty() && !number.is_ok_and(f64::is_finite) {
            out.error(place.span, "not a finite number");
        }
    }
    match value {
        Some(value) if !out.has_errors() => Ok(value.expr),
        _ => Err(out.list().to_vec()),
    }
}

/// Why a parameter has not been given a value.
#[derive(Clone, PartialEq, Debug)]
pub enum NotSet {
    /// There is no parameter of this name.
    Unknown {
        /// The name.
        name: String,
        /// Those that are there.
        known: Vec<String>,
    },
    /// The text is no value.
    Value(Vec<Diagnostic>),
}

impl fmt::Display for NotSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NotSet::Unknown { name, known } if known.is_empty() => {
                write!(f, "no parameter `{name}`; there are none")
            }
            NotSet::Unknown { name, known } => {
                write!(f, "no parameter `{name}`; they are {}", known.join(", "))
            }
            NotSet::Value(findings) => {
                let sentence = |d: &Diagnostic| match &d.hint {
                    Some(hint) => format!("{} ({hint})", d.message),
                    None => d.message.clone(),
                };
                write!(f, "{}", findings.iter().map(sentence).collect::<Vec<_>>().join("; "))
            }
        }
    }
}

impl std::error::Error for NotSet {}

impl Description {
    /// Gives a parameter a value: a constant with or without unit, as in a robot file.
    ///
    /// # Errors
    /// If there is no such parameter, or the text is no value.
    pub fn set(&mut self, name: &str, value: &str) -> Result<(), NotSet> {
        let symbol = Symbol::new(name.trim());
        let measure = self.measure(symbol);
        let known = || self.parameters.iter().map(|p| p.symbol.name().to_string()).collect();
        let Some(at) = self.parameters.iter().position(|p| p.symbol == symbol) else {
            return Err(NotSet::Unknown { name: name.trim().into(), known: known() });
        };
        self.parameters[at].value = Some(read_value(value.trim(), measure).map_err(NotSet::Value)?);
        Ok(())
    }

    /// What a parameter measures: an angle if some row turns by it; what it is in masses, drives and gravity where it stands in no
    /// length; else a length.
    pub fn measure(&self, parameter: Symbol) -> Measure {
        let holds = |e: Expr| e.symbols().contains(&parameter);
        if self.rows.iter().flat_map(|r| [r.theta, r.alpha, r.gamma]).any(holds) {
            return Measure::Angle;
        }
        let placed = [&self.base, &self.tool].into_iter().flat_map(|x| x.matrix().concat());
        if self.rows.iter().flat_map(|r| [r.d, r.a, r.b]).chain(placed).any(holds) {
            return Measure::Length;
        }
        let quantities = self.mass_quantities();
        let alone = quantities.iter().find(|(e, _)| summands(*e).contains(&parameter));
        match alone {
            Some((_, Quantity::Length)) => Measure::Length,
            Some((_, quantity)) => Measure::Other(quantity.units().1),
            None if quantities.iter().any(|(e, _)| holds(*e)) => Measure::Other(""),
            None => Measure::Length,
        }
    }

    /// What the rows say of masses and drives, and gravity, with what each measures.
    fn mass_quantities(&self) -> Vec<(Expr, Quantity)> {
        let gravity = self.gravity.iter().flatten().map(|&e| (e, Quantity::Acceleration));
        self.rows.iter().flat_map(Row::mass_quantities).chain(gravity).collect()
    }
}

impl Row {
    /// What the row says of its link's mass and its drive, with what each measures.
    fn mass_quantities(&self) -> impl Iterator<Item = (Expr, Quantity)> {
        let slides = self.variable.is_some_and(|v| v.kind == JointKind::Prismatic);
        self.mass_cells().map(move |(key, e)| (e, quantity_of_key(key, slides)))
    }

    /// The names that are summands there.
    pub(super) fn mass_summands(&self) -> Vec<(Symbol, Quantity)> {
        let all = self.mass_quantities();
        all.flat_map(|(e, quantity)| summands(e).into_iter().map(move |s| (s, quantity))).collect()
    }
}

/// What a key of a row's masses and drive measures.
pub(super) fn quantity_of_key(key: &str, slides: bool) -> Quantity {
    match (key, slides) {
        ("mass", _) | ("rotor", true) => Quantity::Mass,
        ("com", _) => Quantity::Length,
        ("inertia" | "inertia_at_origin", _) | ("rotor", false) => Quantity::Inertia,
        ("first_moment", _) => Quantity::FirstMoment,
        ("viscous", true) => Quantity::Damping,
        ("viscous", false) => Quantity::AngularDamping,
        ("coulomb", true) => Quantity::Force,
        ("coulomb", false) => Quantity::Torque,
        _ => Quantity::Number,
    }
}

/// The names that are summands of a formula themselves.
fn summands(e: Expr) -> Vec<Symbol> {
    let (mut found, mut open, mut seen) = (vec![], vec![e], FxHashSet::default());
    while let Some(e) = open.pop() {
        if !seen.insert(e) {
            continue;
        }
        match e.node() {
            Node::Symbol(s) => found.push(s),
            Node::Neg(a) => open.push(a),
            Node::Add(a, b) | Node::Sub(a, b) => open.extend([a, b]),
            _ => {}
        }
    }
    found
}
