//! The rows: `[[joints]]`.

use super::fields::{Fields, Reader};
use super::{Cell, Convention, MAX_ROWS, Quantity, Style, quantity_of};
use crate::description::rows::Cells;
use crate::description::{JointKind, Row, Variable};
use denavit_symbolic::Expr;
use std::ops::Range;
use toml::Spanned;
use toml::de::DeValue;

const COMMON: &[&str] = &[
    "name",
    "limits",
    "velocity",
    "acceleration",
    "mass",
    "com",
    "inertia",
    "first_moment",
    "inertia_at_origin",
    "rotor",
    "viscous",
    "coulomb",
];
const LETTERS: &[&str] = &["theta", "d", "a", "alpha", "r", "gamma", "b"];

/// A row whose limits wait until it is known what they limit.
pub(super) struct Draft<'a> {
    pub cells: Cells,
    pub fields: Fields<'a>,
}

/// The letters of a convention, in its order.
fn letters(convention: Convention) -> &'static [&'static str] {
    match convention {
        Convention::Standard => &["theta", "d", "a", "alpha"],
        Convention::Craig => &["alpha", "a", "theta", "d"],
        Convention::Khalil => &["alpha", "d", "theta", "r", "gamma", "b"],
    }
}

/// What to say about a key that a row does not know.
fn hint(key: &str, convention: Option<Convention>) -> Option<String> {
    let plain = match key {
        "θ" | "Theta" | "q" => "theta",
        "α" | "Alpha" => "alpha",
        "γ" => "gamma",
        "offset" => return Some("an offset stands in the cell itself: theta = \"q2 + 90 deg\"".into()),
        "type" | "sigma" | "σ" | "kind" => {
            return Some(
                "the cell that holds the variable decides: theta = \"q1\" turns, a length along z slides"
                    .into(),
            );
        }
        "min" | "max" | "lower" | "upper" => return Some("limits = [lower, upper]".into()),
        "after" if convention.is_some() => {
            return Some("rows of a tree stand in the convention khalil".into());
        }
        "effort" | "torque" => return Some("not part of a robot file".into()),
        _ => key,
    };
    let convention = convention?;
    let known = letters(convention);
    if known.contains(&plain) {
        return Some(format!("write `{plain}`"));
    }
    Some(match (plain, convention) {
        ("r", _) => format!("`r` is Khalil's letter; the {convention} convention writes `d`"),
        ("gamma" | "b", _) => {
            format!("`{plain}` is Khalil's letter for branches; the {convention} convention has none")
        }
        ("a", Convention::Khalil) => {
            "Khalil writes `d` for the length along x, and `r` for the one along z".into()
        }
        _ => return None,
    })
}

impl Reader<'_> {
    /// The rows with their cells read.
    pub fn joints<'a>(
        &mut self,
        value: Option<&'a Spanned<DeValue<'a>>>,
        convention: Option<Convention>,
        are_needed: bool,
    ) -> Vec<Draft<'a>> {
        let Some(value) = value else {
            if are_needed {
                self.out.error(0..0, "there are no joints").hint("each row of the table is a [[joints]]");
            }
            return vec![];
        };
        let Some(array) = self.array(value, "[[joints]]") else { return vec![] };
        if array.is_empty() && are_needed {
            self.out.error(value.span(), "there are no joints").hint("each row of the table is a [[joints]]");
        }
        if array.len() > MAX_ROWS {
            self.out.error(value.span(), format!("{} rows; {MAX_ROWS} are allowed", array.len()));
            return vec![];
        }
        array.iter().filter_map(|row| self.draft(row, convention)).collect()
    }

    fn draft<'a>(
        &mut self,
        row: &'a Spanned<DeValue<'a>>,
        convention: Option<Convention>,
    ) -> Option<Draft<'a>> {
        let fields = self.table(row, "[joints]")?;
        let branches: &[&str] = if convention == Some(Convention::Khalil) { &["after"] } else { &[] };
        let known = [convention.map_or(LETTERS, letters), COMMON, branches].concat();
        Some(self.draft_of(fields, row.span(), convention, &known))
    }

    /// A side of a closure.
    pub fn side<'a>(&mut self, fields: Fields<'a>, span: Range<usize>) -> Draft<'a> {
        let known = [letters(Convention::Khalil), &["after"]].concat();
        self.draft_of(fields, span, Some(Convention::Khalil), &known)
    }

    fn draft_of<'a>(
        &mut self,
        fields: Fields<'a>,
        span: Range<usize>,
        convention: Option<Convention>,
        known: &[&str],
    ) -> Draft<'a> {
        self.unknown_keys(&fields, known, |key| hint(key, convention));
        let khalil = convention == Some(Convention::Khalil);
        let mut cell = |key: &str, quantity| {
            let value = fields.get(key).filter(|_| known.contains(&key));
            value.and_then(|v| self.cell(v, &Style::of(quantity))).unwrap_or_else(|| Cell::zero(span.clone()))
        };
        let (x, z) = if khalil { ("d", "r") } else { ("a", "d") };
        let cells = Cells {
            span: span.clone(),
            theta: cell("theta", Quantity::Angle),
            d: cell(z, Quantity::Length),
            a: cell(x, Quantity::Length),
            alpha: cell("alpha", Quantity::Angle),
            gamma: cell("gamma", Quantity::Angle),
            b: cell("b", Quantity::Length),
        };
        Draft { cells, fields }
    }

    /// The rows, with what each says about its joint and its link.
    pub fn rows(&mut self, drafts: Vec<Draft>, variables: &[Option<Variable>], names: &[String]) -> Vec<Row> {
        drafts
            .into_iter()
            .zip(variables)
            .map(|(draft, &variable)| self.row(&draft, variable, names))
            .collect()
    }

    fn row(&mut self, draft: &Draft, variable: Option<Variable>, names: &[String]) -> Row {
        let get = |key| draft.fields.get(key);
        let mut row = draft.cells.row(variable);
        self.joint_limits(&draft.fields, &mut row);
        row.name = self.string(get("name"));
        self.masses(&draft.fields, &mut row, names);
        row
    }

    /// How far and how fast a row's joint moves.
    pub fn joint_limits(&mut self, fields: &Fields, row: &mut Row) {
        let get = |key| fields.get(key);
        let kind = row.variable.map(|v| v.kind);
        let turns = kind == Some(JointKind::Revolute);
        let (rate, change) = match turns {
            true => (Quantity::AngularVelocity, Quantity::AngularAcceleration),
            false => (Quantity::Velocity, Quantity::Acceleration),
        };
        for key in ["limits", "velocity", "acceleration"] {
            if let (Some(value), None) = (get(key), kind)
                && !self.out.has_errors()
            {
                self.out
                    .error(value.span(), format!("`{key}` of a row without a joint variable"))
                    .hint("write the variable into theta or into the length along z, or drop the line");
            }
        }
        row.limits = get("limits").zip(kind).and_then(|(v, kind)| self.limits(v, quantity_of(kind)));
        row.velocity = get("velocity").zip(kind).and_then(|(v, _)| self.positive(v, rate));
        row.acceleration = get("acceleration").zip(kind).and_then(|(v, _)| self.positive(v, change));
    }

    fn limits(&mut self, value: &Spanned<DeValue>, quantity: Quantity) -> Option<[Expr; 2]> {
        let array = self.array(value, "limits")?;
        let [lower, upper] = array.iter().collect::<Vec<_>>()[..] else {
            self.out.error(value.span(), "limits are two values").hint("limits = [lower, upper]");
            return None;
        };
        let style = Style::plain(quantity);
        let (lower, upper) = (self.constant(lower, &style), self.constant(upper, &style));
        let limits = [lower?, upper?];
        let [low, high] = limits.map(number);
        if low > high {
            self.out
                .error(value.span(), "the lower limit is above the upper one")
                .hint("limits = [lower, upper]");
            return None;
        }
        Some(limits)
    }

    fn positive(&mut self, value: &Spanned<DeValue>, quantity: Quantity) -> Option<Expr> {
        let e = self.constant(value, &Style::plain(quantity))?;
        if number(e) <= 0.0 {
            self.out.error(value.span(), "the largest value is positive");
            return None;
        }
        Some(e)
    }
}

/// The value of an expression without names.
pub(super) fn number(e: Expr) -> f64 {
    e.eval(|_| None).unwrap_or(0.0)
}
