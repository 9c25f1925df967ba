//! A robot by its axes at rest: `[[axes]]`, each a point and a direction, or `[[screws]]`, each ω and v, in the base or, as
//! `[[body_screws]]`, in the tip; and the pose of the `[tip]` at rest. Rows are made of them.
//!
//! A screw (ω, v) is that of the product of exponentials, exp(ξ₁q₁) … exp(ξₙqₙ)·M (Brockett 1984; Murray, Li and Sastry 1994, §3.2):
//! |ω| = 1 and v = −ω × p for an axis that turns, through p; ω = 0 and |v| = 1 for one that slides.

use super::fields::{Fields, Reader};
use super::{Cell, Convention, MAX_ROWS, Quantity, Style, parameters};
use crate::description::cell::variable_number;
use crate::description::lines::{Agreement, AxisAtRest, ChainAtRest, NotNamed, NotPlaced};
use crate::description::{Description, JointKind, Row, Variable, rows};
use crate::geometry::{Rotation, Vector};
use denavit_symbolic::{Angle, Expr, Rational, Symbol};
use std::ops::Range;
use toml::Spanned;
use toml::de::DeValue;

/// How a file gives its axes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Given {
    /// A point and a direction.
    Axes,
    /// ω and v in the base.
    Screws,
    /// ω and v in the tip at rest.
    BodyScrews,
}

impl Given {
    const ALL: [Given; 3] = [Given::Axes, Given::Screws, Given::BodyScrews];

    pub fn key(self) -> &'static str {
        match self {
            Given::Axes => "axes",
            Given::Screws => "screws",
            Given::BodyScrews => "body_screws",
        }
    }

    /// How the axes of a file are given, if it is one of axes.
    pub fn of(fields: &Fields) -> Option<Given> {
        Given::ALL.into_iter().find(|g| fields.get(g.key()).is_some())
    }
}

const KEYS: &[&str] = &["name", "convention", "source", "parameters", "tip", "poses", "gravity"];
const COMMON: &[&str] = &["name", "kind", "moves", "limits", "velocity", "acceleration"];

/// An axis as it was read.
struct Draft {
    axis: AxisAtRest,
    /// Its name and its limits.
    row: Row,
    direction: Range<usize>,
}

/// Lengths may be as much off 1 as decimals make them.
const DECIMALS: f64 = 1e-3;

/// ω and v may be as much off a right angle as decimals make them.
const PITCH: f64 = 1e-6;
/// What rounding leaves of a length that is 0, metres.
const THROUGH: f64 = 1e-15;

fn number(e: Expr) -> f64 {
    e.eval(|_| None).unwrap_or(0.0)
}

impl Reader<'_> {
    /// The table of a file that gives axes.
    pub fn axes_description(&mut self, fields: &Fields, given: Given) -> Option<Description> {
        let others = Given::ALL.into_iter().filter(|g| *g != given).map(Given::key).chain(["joints"]);
        for other in others {
            if let Some(value) = fields.get(other) {
                let message = format!("`{other}` beside `{}`", given.key());
                self.out.error(value.span(), message).hint("a robot is given in one way");
            }
        }
        let known = [KEYS, &[given.key(), "joints", "axes", "screws", "body_screws"]].concat();
        self.unknown_keys(fields, &known, hint);
        let name = self.string(fields.get("name")).unwrap_or_else(|| "robot".into());
        let source = self.string(fields.get("source"));
        let convention = match fields.get("convention") {
            None => Some(Convention::Standard),
            told => self.convention(told),
        };
        let declared = self.parameter_names(fields.get("parameters"));
        let names: Vec<String> = declared.iter().map(|p| p.name.clone()).collect();
        let value = fields.get(given.key())?;
        let mut lengths: Vec<Cell> = vec![];
        let drafts = self.axis_drafts(value, given, &names, &mut lengths);
        let (tip, cells) = self.frame(fields.get("tip"), "tip");
        lengths.extend(cells.lengths.iter().cloned());
        rows::check_declared(&lengths, &names, drafts.len(), &mut self.out);
        for cell in lengths.iter().chain(&cells.angles).chain(&cells.entries) {
            self.constant_of_parameters(cell, &names, drafts.len());
        }
        let uses = parameters::Uses::of_cells(&cells.angles, &lengths);
        let parameters = self.parameter_values(&declared, &uses);
        let kinds = self.kinds(&drafts);
        let poses = self.poses(fields.get("poses"), &kinds);
        let gravity = self.gravity(fields.get("gravity"), &names, kinds.len());
        let tip = tip?;
        if self.out.has_errors() || drafts.is_empty() {
            return None;
        }
        let in_base = |a: &AxisAtRest| match given {
            Given::BodyScrews => AxisAtRest {
                point: tip.act_on_point(a.point),
                direction: tip.act_on_vector(a.direction),
                ..a.clone()
            },
            Given::Axes | Given::Screws => a.clone(),
        };
        let axes = drafts.iter().map(|d| in_base(&d.axis)).collect();
        let chain = ChainAtRest { axes, tip, beside: Rotation::identity() };
        let named = match chain.named_description(&name, convention?, &parameters) {
            Ok(named) => named,
            Err(why) => {
                self.not_placed(why, &drafts, value);
                return None;
            }
        };
        self.say_table(&named.agreement, &named.in_numbers, value);
        let mut d = Description { source, poses, gravity, ..named.description };
        name_rows(&mut d, &drafts);
        Some(d)
    }

    fn say_table(&mut self, agreement: &Agreement, in_numbers: &[Symbol], value: &Spanned<DeValue>) {
        let proof = match agreement {
            Agreement::Proved => "the table is proved to have these axes and this tip".to_string(),
            Agreement::Within(by) if *by < 1e-50 => {
                "the table has these axes and this tip to 60 digits".into()
            }
            Agreement::Within(by) => format!("the table has these axes and this tip within {by:.0e}"),
        };
        let names: Vec<String> = in_numbers.iter().map(|s| format!("`{}`", s.name())).collect();
        let kept = if names.is_empty() {
            String::new()
        } else {
            format!("; it stands for the values of {}", names.join(", "))
        };
        self.out.note(value.span(), format!("{proof}{kept}"));
    }

    fn not_placed(&mut self, why: NotNamed, drafts: &[Draft], value: &Spanned<DeValue>) {
        match why {
            NotNamed::NotPlaced(NotPlaced::NoDirection(k)) => {
                let span = drafts.get(k).map_or(value.span(), |d| d.direction.clone());
                self.out.error(span, "this axis has no direction");
            }
            NotNamed::NotPlaced(NotPlaced::Symbols) => {
                self.out
                    .error(value.span(), "there are names in the directions of these axes")
                    .hint("directions and the tip's rotation are numbers, or names with values");
            }
            NotNamed::NeedsValues(names) => {
                let names: Vec<String> = names.iter().map(|s| format!("`{}`", s.name())).collect();
                self.out
                    .error(
                        value.span(),
                        format!("the table is not the same for all values of {}", names.join(", ")),
                    )
                    .hint("give values under [parameters]");
            }
        }
    }

    fn axis_drafts(
        &mut self,
        value: &Spanned<DeValue>,
        given: Given,
        names: &[String],
        lengths: &mut Vec<Cell>,
    ) -> Vec<Draft> {
        let Some(array) = self.array(value, given.key()) else { return vec![] };
        if array.is_empty() {
            self.out.error(value.span(), "there are no axes");
        }
        if array.len() > MAX_ROWS / 2 {
            let message = format!("{} axes; {} are allowed", array.len(), MAX_ROWS / 2);
            self.out.error(value.span(), message);
            return vec![];
        }
        let mut drafts: Vec<Draft> = vec![];
        let mut count = 0;
        for item in array.iter() {
            let known = match given {
                Given::Axes => [COMMON, &["point", "direction"]].concat(),
                Given::Screws | Given::BodyScrews => [&["omega", "v"], &COMMON[..1], &COMMON[2..]].concat(),
            };
            let Some(fields) = self.table(item, given.key()) else { continue };
            self.unknown_keys(&fields, &known, hint);
            let line = match given {
                Given::Axes => self.line(&fields, lengths),
                Given::Screws | Given::BodyScrews => self.screw(&fields, names, lengths),
            };
            let known = count;
            let moves = self.moves(&fields, &mut count);
            let (Some((mut axis, direction)), Some(moves)) = (line, moves) else { continue };
            axis.moves = moves;
            let variable = (count > known)
                .then(|| Variable { symbol: Symbol::new(&format!("q{count}")), kind: axis.kind });
            let mut row = Row { name: self.string(fields.get("name")), variable, ..Row::still() };
            self.joint_limits(&fields, &mut row);
            drafts.push(Draft { axis, row, direction });
        }
        drafts
    }

    /// A point and a direction.
    fn line(&mut self, fields: &Fields, lengths: &mut Vec<Cell>) -> Option<(AxisAtRest, Range<usize>)> {
        let kind = match fields.get("kind") {
            None => JointKind::Revolute,
            Some(value) => match self.string(Some(value))?.as_str() {
                "revolute" => JointKind::Revolute,
                "prismatic" => JointKind::Prismatic,
                _ => {
                    self.out.error(value.span(), "an axis is \"revolute\" or \"prismatic\"");
                    return None;
                }
            },
        };
        let direction = match fields.get("direction") {
            Some(value) => self.direction(value),
            None => {
                self.out
                    .error(fields.span.clone(), "the axis has no direction")
                    .hint("direction = [0, 0, 1], or the name of an axis of the base: \"z\", \"-x\"");
                None
            }
        };
        let point = match (fields.get("point"), kind) {
            (Some(value), _) => self.list(value, &Style::of(Quantity::Length), "point", 3),
            (None, JointKind::Prismatic) => Some(vec![Cell::zero(fields.span.clone()); 3]),
            (None, JointKind::Revolute) => {
                self.out
                    .error(fields.span.clone(), "the axis has no point")
                    .hint("point = [0, 0, \"400 mm\"]: any point of it, in the base");
                None
            }
        };
        let at = point.as_ref().map(|p| Vector([0, 1, 2].map(|i| p[i].expr)));
        lengths.extend(point.into_iter().flatten());
        let (direction, span) = direction?;
        Some((AxisAtRest { kind, point: at?, direction: Vector(direction), moves: vec![] }, span))
    }

    /// Three numbers, or the name of an axis.
    fn direction(&mut self, value: &Spanned<DeValue>) -> Option<([Expr; 3], Range<usize>)> {
        if let Some(text) = value.get_ref().as_str() {
            let name = text.trim().trim_start_matches(['-', '+']);
            let sign = if text.trim().starts_with('-') { -1 } else { 1 };
            let Some(at) = ["x", "y", "z"].iter().position(|n| *n == name) else {
                self.out
                    .error(value.span(), "no axis of this name")
                    .hint("\"x\", \"-y\", \"z\", or three numbers: [0, 0, 1]");
                return None;
            };
            return Some(([0, 1, 2].map(|i| Expr::int(if i == at { sign } else { 0 })), value.span()));
        }
        let three = self.numbers(value, "direction")?;
        if three.iter().all(|e| number(*e) == 0.0) {
            self.out.error(value.span(), "this axis has no direction");
            return None;
        }
        Some((three, value.span()))
    }

    /// Three numbers without names.
    fn numbers(&mut self, value: &Spanned<DeValue>, what: &str) -> Option<[Expr; 3]> {
        let cells = self.list(value, &Style::plain(Quantity::Number), what, 3)?;
        for (name, span) in cells.iter().flat_map(|c| &c.symbols) {
            self.out.error(span.clone(), format!("`{name}` stands where a number is needed"));
        }
        let plain = cells.iter().all(|c| c.symbols.is_empty());
        plain.then(|| [0, 1, 2].map(|i| cells[i].expr))
    }

    /// ω and v.
    fn screw(
        &mut self,
        fields: &Fields,
        names: &[String],
        lengths: &mut Vec<Cell>,
    ) -> Option<(AxisAtRest, Range<usize>)> {
        let (Some(omega_at), Some(v_at)) = (fields.get("omega"), fields.get("v")) else {
            self.out
                .error(fields.span.clone(), "a screw has `omega` and `v`")
                .hint("omega = [0, 0, 1], v = [0, \"-400 mm\", 0]: v = −ω × p for an axis through p");
            return None;
        };
        let omega = self.numbers(omega_at, "omega")?;
        let size = omega.iter().map(|e| number(*e).powi(2)).sum::<f64>().sqrt();
        if size == 0.0 {
            // It slides: v is a direction.
            let direction = self.numbers(v_at, "v")?;
            self.of_length_one(&direction, v_at, "v of a screw that slides")?;
            let axis = AxisAtRest {
                kind: JointKind::Prismatic,
                point: Vector::zero(),
                direction: Vector(direction),
                moves: vec![],
            };
            return Some((axis, v_at.span()));
        }
        self.of_length_one(&omega, omega_at, "ω")?;
        let cells = self.list(v_at, &Style::of(Quantity::Length), "v", 3)?;
        let (w, v) = (Vector(omega), Vector([0, 1, 2].map(|i| cells[i].expr)));
        let along = w.dot(v);
        let value = |s: Symbol| names.contains(&s.name().to_string()).then_some(1.0);
        let largest = v.0.iter().map(|e| e.eval(value).unwrap_or(0.0).abs()).fold(0.0, f64::max);
        let pitch = along.eval(value).unwrap_or(0.0).abs();
        // An axis that is no farther from the origin than this goes through it.
        if pitch > PITCH * largest && largest > THROUGH {
            self.out
                .error(v_at.span(), "v is not perpendicular to ω: the screw has a pitch")
                .hint("a joint turns or slides: v = −ω × p for an axis through p");
            return None;
        }
        if pitch > 0.0 {
            self.out.note(
                v_at.span(),
                format!("v is perpendicular to ω within {pitch:.0e}; its part along ω is left out"),
            );
        }
        // The point of the axis next to the origin: p = ω × v / |ω|².
        let over = Expr::int(1) / w.dot(w);
        let point = w.cross(v).scale(over).map(|e| Angle::of(e).to_expr());
        let axis = AxisAtRest { kind: JointKind::Revolute, point, direction: w, moves: vec![] };
        lengths.extend(cells);
        Some((axis, omega_at.span()))
    }

    /// Reports what is not of length 1.
    fn of_length_one(&mut self, v: &[Expr; 3], at: &Spanned<DeValue>, what: &str) -> Option<()> {
        let size = v.iter().map(|e| number(*e).powi(2)).sum::<f64>().sqrt();
        if (size - 1.0).abs() > DECIMALS {
            self.out
                .error(at.span(), format!("{what} has the length {size:.4}, not 1"))
                .hint("a variable counts radians or metres; \"sqrt(2)/2\" is exact");
            return None;
        }
        if (size - 1.0).abs() > 1e-12 {
            self.out.note(at.span(), format!("{what} has the length {size}: it is read as a direction"));
        }
        Some(())
    }

    /// What moves an axis: the next variable, or a sum of variables with factors of which at most one is new.
    fn moves(&mut self, fields: &Fields, count: &mut usize) -> Option<Vec<(usize, Rational)>> {
        let Some(value) = fields.get("moves") else {
            *count += 1;
            return Some(vec![(*count - 1, Rational::ONE)]);
        };
        let cell = self.cell(value, &Style::plain(Quantity::Number))?;
        let form = Angle::of(cell.expr);
        let term =
            |(e, k): &(Expr, Rational)| Some((variable_number(&e.as_symbol()?.name())? - 1, k.clone()));
        let terms: Option<Vec<(usize, Rational)>> = form.terms.iter().map(term).collect();
        let is_plain = form.turns.is_zero() && form.radians.is_zero();
        let Some(terms) = terms.filter(|t| is_plain && !t.is_empty()) else {
            self.out
                .error(value.span(), "a sum of joint variables is expected here")
                .hint("moves = \"q3 - q2\"; what is constant stands in point, direction and tip");
            return None;
        };
        let new: Vec<usize> = terms.iter().map(|t| t.0).filter(|v| *v >= *count).collect();
        match new[..] {
            [] => {}
            [v] if v == *count => *count += 1,
            _ => {
                let next = format!("q{}", *count + 1);
                self.out
                    .error(value.span(), format!("the next joint variable is `{next}`"))
                    .hint("variables count the axes that have one; an axis has at most one of its own");
                return None;
            }
        }
        Some(terms)
    }

    /// What each variable moves.
    fn kinds(&self, drafts: &[Draft]) -> Vec<JointKind> {
        let mut kinds: Vec<JointKind> = vec![];
        for draft in drafts {
            if draft.axis.moves.iter().any(|m| m.0 == kinds.len()) {
                kinds.push(draft.axis.kind);
            }
        }
        kinds
    }
}

/// Names and limits, to the rows that move.
fn name_rows(d: &mut Description, drafts: &[Draft]) {
    let symbols: Vec<_> = d.variables().iter().map(|v| v.symbol).collect();
    let moves = |e: &Expr| e.symbols().iter().any(|s| symbols.contains(s));
    let is_moved = |r: &&mut Row| [r.theta, r.d].iter().any(moves);
    for (row, draft) in d.rows.iter_mut().filter(is_moved).zip(drafts) {
        row.name.clone_from(&draft.row.name);
        (row.limits, row.velocity) = (draft.row.limits, draft.row.velocity);
        row.acceleration = draft.row.acceleration;
    }
}

fn hint(key: &str) -> Option<String> {
    Some(match key {
        "base" => "the axes stand in the base".into(),
        "tool" | "M" | "home" => "the pose of the tip with all joints at 0 is [tip]".to_string(),
        "w" | "ω" => "write `omega`".into(),
        "axis" => "write `direction`".into(),
        "min" | "max" | "lower" | "upper" => "limits = [lower, upper]".into(),
        "type" => "write `kind`: \"revolute\" or \"prismatic\"".into(),
        "theta" | "d" | "a" | "alpha" | "r" => "cells of a table stand in [[joints]]".into(),
        _ => return None,
    })
}
