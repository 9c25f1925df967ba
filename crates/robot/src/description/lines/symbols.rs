//! Rows with names for lengths: the table of a chain is made for values, and what depends on them is found again and proved.
//!
//! With a table at hand whose directions are numbers, its lengths are sums of the names with constant factors wherever the frames
//! stay on the same normals. So the rows are made for values, and for values of which one differs; what the differences say is put
//! into the cells, and the chain with names is proved to be the rows with names, as polynomials. What is not proved keeps its numbers.

use super::screws::is_chain;
use super::{Agreement, AxisAtRest, ChainAtRest, NotPlaced};
use crate::description::{Convention, Description, Parameter};
use crate::geometry::{Transform, Vector};
use denavit_symbolic::real::Values;
use denavit_symbolic::{Angle, Expr, Rational, Symbol};

/// A table with names.
#[derive(Clone, Debug)]
pub struct Named {
    /// The table.
    pub description: Description,
    /// How it was proved to be the chain; with names always exactly.
    pub agreement: Agreement,
    /// Parameters for which the table has their values.
    pub in_numbers: Vec<Symbol>,
}

/// Why a chain with names has no rows.
#[derive(Clone, PartialEq, Debug)]
pub enum NotNamed {
    /// It has none for values either.
    NotPlaced(NotPlaced),
    /// These have no value, and the table is not the same for all.
    NeedsValues(Vec<Symbol>),
}

impl From<NotPlaced> for NotNamed {
    fn from(why: NotPlaced) -> Self {
        NotNamed::NotPlaced(why)
    }
}

/// So many names times axes are worth a table each; beyond, the values are taken.
const MOST: usize = 6000;

/// By how much a value is moved.
fn step() -> Expr {
    Expr::from(Rational::new(1, 997))
}

/// A value for a parameter that has none; sums of a few are not 0.
fn any_value(k: usize) -> Expr {
    Expr::from(Rational::new(7 * (k as i64 * k as i64) + 12 * k as i64 + 31, 101))
}

impl ChainAtRest {
    /// As [`description`](ChainAtRest::description), for a chain some of whose lengths are names.
    ///
    /// # Errors
    /// If there is no table, or one only for values, and a parameter has none.
    pub fn named_description(
        &self,
        name: &str,
        convention: Convention,
        parameters: &[Parameter],
    ) -> Result<Named, NotNamed> {
        let occurring = self.symbols();
        let names: Vec<&Parameter> = parameters.iter().filter(|p| occurring.contains(&p.symbol)).collect();
        let kept = |description: Description, agreement| {
            let in_numbers = vec![];
            Named {
                description: Description { parameters: parameters.to_vec(), ..description },
                agreement,
                in_numbers,
            }
        };
        if names.is_empty() {
            let (description, agreement) = self.description(name, convention)?;
            return Ok(kept(description, agreement));
        }
        let values: Vec<Expr> =
            names.iter().enumerate().map(|(k, p)| p.value.unwrap_or_else(|| any_value(k))).collect();
        let at = |values: &[Expr]| {
            let value = |s: Symbol| names.iter().position(|p| p.symbol == s).map(|k| values[k]);
            self.map(|e| e.substitute(value)).description(name, convention)
        };
        let (plain, agreement) = at(&values)?;
        let many = if names.len() * self.axes.len() > MOST { 0 } else { names.len() };
        let moved: Option<Vec<Vec<Expr>>> = (0..many)
            .map(|k| {
                let mut other = values.clone();
                other[k] = other[k] + step();
                let (other, _) = at(&other).ok()?;
                is_alike(&plain, &other).then(|| lengths(&other))
            })
            .collect();
        let moved = moved.filter(|_| many > 0);
        let symbolic = moved.and_then(|moved| with_names(&plain, &moved, &names, &values));
        if let Some(d) = symbolic.filter(|d| is_chain(self, d)) {
            return Ok(kept(d, Agreement::Proved));
        }
        let missing: Vec<Symbol> = names.iter().filter(|p| p.value.is_none()).map(|p| p.symbol).collect();
        if !missing.is_empty() {
            return Err(NotNamed::NeedsValues(missing));
        }
        let in_numbers: Vec<Symbol> = names.iter().map(|p| p.symbol).collect();
        let others = parameters.iter().filter(|p| !in_numbers.contains(&p.symbol));
        let description = Description { parameters: others.cloned().collect(), ..plain };
        Ok(Named { description, agreement, in_numbers })
    }

    fn map(&self, of: impl Fn(Expr) -> Expr) -> ChainAtRest {
        let axis = |a: &AxisAtRest| AxisAtRest {
            point: a.point.map(&of),
            direction: a.direction.map(&of),
            ..a.clone()
        };
        ChainAtRest {
            axes: self.axes.iter().map(axis).collect(),
            tip: self.tip.map(&of),
            beside: self.beside.map(&of),
        }
    }

    /// The symbols in it.
    pub(super) fn symbols(&self) -> Vec<Symbol> {
        let axes = self.axes.iter().flat_map(|a| a.point.0.into_iter().chain(a.direction.0));
        let tip = self.tip.translation.0.into_iter().chain(self.tip.rotation.rows().concat());
        axes.chain(tip).flat_map(Expr::symbols).collect()
    }
}

/// All lengths of a table, in order.
fn lengths(d: &Description) -> Vec<Expr> {
    let rows = d.rows.iter().flat_map(|r| [r.d, r.a, r.b]);
    rows.chain(d.base.translation.0).chain(d.tool.translation.0).collect()
}

/// True if two tables differ in their lengths alone.
fn is_alike(a: &Description, b: &Description) -> bool {
    let turned = |d: &Description| {
        let rows = d.rows.iter().flat_map(|r| [r.theta, r.alpha, r.gamma]);
        rows.chain([d.base, d.tool].into_iter().flat_map(|x| x.rotation.rows().concat())).collect::<Vec<_>>()
    };
    turned(a) == turned(b)
}

/// The table with names: each length as the sum that its differences say.
fn with_names(
    plain: &Description,
    moved: &[Vec<Expr>],
    names: &[&Parameter],
    values: &[Expr],
) -> Option<Description> {
    let variables: Vec<Symbol> = plain.variables().iter().map(|v| v.symbol).collect();
    let mut numbers = Values::default();
    let mut constant = |e: Expr| -> Option<Expr> {
        let sum = Angle::of(e).to_expr();
        if sum.is_zero() { Some(sum) } else { numbers.of(sum)?.to_expr() }
    };
    let mut all = vec![];
    for (i, &length) in lengths(plain).iter().enumerate() {
        let (mut sum, mut rest) =
            (Expr::int(0), length.substitute(|s| variables.contains(&s).then(|| Expr::int(0))));
        let motion = Angle::of(length - rest).to_expr();
        for (k, p) in names.iter().enumerate() {
            let factor = constant((moved[k][i] - length) / step())?;
            sum = sum + factor * Expr::from(p.symbol);
            rest = rest - factor * values[k];
        }
        all.push(Angle::of(motion + sum + constant(rest)?).to_expr());
    }
    let mut d = plain.clone();
    let mut next = all.into_iter();
    for row in &mut d.rows {
        (row.d, row.a, row.b) = (next.next()?, next.next()?, next.next()?);
    }
    for x in [&mut d.base, &mut d.tool] {
        let place = Vector([next.next()?, next.next()?, next.next()?]);
        *x = Transform::from_rotation_translation(x.rotation, place);
    }
    Some(d)
}
