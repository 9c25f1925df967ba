//! The rule of joint variables, for rows from whatever text.
//!
//! Row by row, the next variable `qk` may appear in θ or in the length along z, with a factor that is a number;
//! it makes the row revolute or prismatic. Variables of earlier rows may be added there (a coupling). Everything
//! else is constant.

use super::cell::variable_number;
use super::diagnostic::{Diagnostics, nearest};
use super::linkage::passive_number;
use super::{Convention, JointKind, Row, Variable};
use denavit_symbolic::{Angle, Expr, Rational, Symbol, equal};
use std::ops::{Range, RangeInclusive};

/// A cell that was read, and where.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    pub expr: Expr,
    pub span: Range<usize>,
    pub symbols: Vec<(String, Range<usize>)>,
}

impl Cell {
    /// The 0 of a cell that is not there.
    pub fn zero(span: Range<usize>) -> Self {
        Cell { expr: Expr::int(0), span, symbols: vec![] }
    }

    /// The names that the value depends on as a sum: each with a number as its factor.
    pub fn summands(&self) -> impl Iterator<Item = Symbol> {
        Angle::of(self.expr).terms.into_iter().filter_map(|t| t.0.as_symbol())
    }
}

/// The cells of a row.
#[derive(Clone, Debug)]
pub(super) struct Cells {
    /// The whole row.
    pub span: Range<usize>,
    pub theta: Cell,
    pub d: Cell,
    pub a: Cell,
    pub alpha: Cell,
    pub gamma: Cell,
    pub b: Cell,
}

impl Cells {
    pub fn all(&self) -> [&Cell; 6] {
        [&self.theta, &self.d, &self.a, &self.alpha, &self.gamma, &self.b]
    }

    /// The geometry of the row; nothing else is known of it.
    pub fn row(&self, variable: Option<Variable>) -> Row {
        Row {
            theta: self.theta.expr,
            d: self.d.expr,
            a: self.a.expr,
            alpha: self.alpha.expr,
            gamma: self.gamma.expr,
            b: self.b.expr,
            variable,
            ..Row::still()
        }
    }

    /// The cells that hold angles, then those that hold lengths.
    pub fn by_quantity(&self) -> ([&Cell; 3], [&Cell; 3]) {
        ([&self.theta, &self.alpha, &self.gamma], [&self.d, &self.a, &self.b])
    }
}

/// The letter of joint variables, each with a count of its own.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Letter {
    /// `q1`, `q2`, …: joints that move by themselves.
    Driven,
    /// `p1`, `p2`, …: joints that closures determine.
    Passive,
}

impl Letter {
    /// The number of the variable of this letter that a name is.
    fn number(self, name: &str) -> Option<usize> {
        match self {
            Letter::Driven => variable_number(name),
            Letter::Passive => passive_number(name),
        }
    }

    fn name(self, number: usize) -> String {
        format!("{}{number}", if self == Letter::Driven { 'q' } else { 'p' })
    }
}

/// Finds each row's own variable; reports every breach of the rule.
pub(super) fn assign_variables(
    rows: &[Cells],
    convention: Convention,
    out: &mut Diagnostics,
) -> Vec<Option<Variable>> {
    assign(rows, Letter::Driven, true, convention, out)
}

/// As [`assign_variables`], for rows of a linkage, which have driven and passive variables.
pub(super) fn assign_all_variables(
    rows: &[Cells],
    convention: Convention,
    out: &mut Diagnostics,
) -> Vec<Option<Variable>> {
    let driven = assign(rows, Letter::Driven, false, convention, out);
    let passive = assign(rows, Letter::Passive, false, convention, out);
    let both = |((row, q), p): ((&Cells, Option<Variable>), Option<Variable>)| {
        if let (Some(q), Some(p)) = (q, p) {
            let (q, p) = (q.symbol.name(), p.symbol.name());
            out.error(
                row.span.clone(),
                format!("two joint variables of its own in one row, `{q}` and `{p}`"),
            )
            .hint("a row is one joint, driven (q) or passive (p)");
        }
        q.or(p)
    };
    rows.iter().zip(driven).zip(passive).map(both).collect()
}

/// The variables of a letter; `says_followers` where rows are noted that only repeat others.
fn assign(
    rows: &[Cells],
    letter: Letter,
    says_followers: bool,
    convention: Convention,
    out: &mut Diagnostics,
) -> Vec<Option<Variable>> {
    let joint_variables = |cell: &Cell| joint_variables(cell, letter);
    let mut next = 1;
    let mut variables = vec![];
    for row in rows {
        let (x, z) = (convention.length_x(), convention.length_z());
        for (cell, name) in [(&row.a, x), (&row.alpha, "alpha"), (&row.gamma, "gamma"), (&row.b, "b")] {
            for (q, span) in joint_variables(cell) {
                out.error(span, format!("the joint variable `{}` in `{name}`", letter.name(q))).hint(
                    format!("a joint turns or slides along z: its variable belongs in `theta` or `{z}`"),
                );
            }
        }
        let mut new: Vec<(usize, Range<usize>)> = joint_variables(&row.theta);
        new.extend(joint_variables(&row.d));
        new.retain(|v| v.0 >= next);
        let (first, last) = (new.iter().map(|v| v.0).min(), new.iter().map(|v| v.0).max());
        let mut own = None;
        match (first, last) {
            (Some(first), Some(last)) if first != last => {
                let span = new.iter().find(|v| v.0 == last).map_or(row.span.clone(), |v| v.1.clone());
                out.error(span, format!(
                    "two new joint variables in one row, `{}` and `{}`",
                    letter.name(first),
                    letter.name(last)
                ))
                    .hint("a row is one joint: give the second a row of its own; only variables of rows above may be added");
            }
            (Some(first), _) if first > next => {
                let (first, next) = (letter.name(first), letter.name(next));
                let (message, hint) = (
                    format!("`{first}` comes before `{next}`"),
                    format!("variables count the rows that have one: this row's is `{next}`"),
                );
                out.error(new[0].1.clone(), message).hint(hint);
            }
            (Some(_), _) => own = own_variable(row, letter, next, z, out),
            (None, _) => {}
        }
        if first.is_none() && says_followers {
            follows(row, out);
        }
        check_linear(row, letter, z, own.is_some() || first.is_none(), out);
        next = last.map_or(next, |q| q + 1);
        variables.push(own);
    }
    variables
}

/// The variable of a number and a letter, of a row in which it occurs.
fn own_variable(
    row: &Cells,
    letter: Letter,
    number: usize,
    z: &str,
    out: &mut Diagnostics,
) -> Option<Variable> {
    let name = letter.name(number);
    let symbol = Symbol::new(&name);
    let occurs = |c: &Cell| joint_variables(c, letter).into_iter().find(|v| v.0 == number);
    match (occurs(&row.theta), occurs(&row.d)) {
        (Some(_), Some((_, span))) => {
            out.error(span, format!("`{name}` both in `theta` and in `{z}`"))
                .hint("a joint turns or slides; a screw joint is not supported");
            None
        }
        (Some(_), None) => Some(Variable { symbol, kind: JointKind::Revolute }),
        (None, Some(_)) => Some(Variable { symbol, kind: JointKind::Prismatic }),
        (None, None) => None,
    }
}

/// Says so where a row only repeats variables of other rows.
fn follows(row: &Cells, out: &mut Diagnostics) {
    for cell in [&row.theta, &row.d] {
        if let Some((q, span)) = joint_variables(cell, Letter::Driven).into_iter().next() {
            out.note(span, format!("this row has no joint variable of its own: it follows `q{q}`"));
        }
    }
}

/// The factors that joint variables can have, signs aside.
const FACTORS: RangeInclusive<f64> = 1e-9..=1e9;

/// Whether three values of a variable lie on a line, whatever the others are.
fn is_affine(e: Expr, variable: Symbol) -> bool {
    let value = |sevenths: i64| Expr::from(Rational::new(sevenths, 7));
    let [zero, one, two] = [0, 1, 2].map(|x| e.substitute(|s| (s == variable).then(|| value(x))));
    equal(zero + two, Expr::int(2) * one).is_equal()
}

/// Every joint variable stands in a sum, with a number other than 0 as its factor.
fn check_linear(row: &Cells, letter: Letter, z: &str, report: bool, out: &mut Diagnostics) {
    for (cell, name) in [(&row.theta, "theta"), (&row.d, z)] {
        let variables = joint_variables(cell, letter);
        if variables.is_empty() || !report {
            continue;
        }
        let summands: Vec<Symbol> = cell.summands().collect();
        let nonlinear: Vec<Symbol> = Angle::of(cell.expr)
            .terms
            .iter()
            .filter(|t| t.0.as_symbol().is_none())
            .flat_map(|t| t.0.symbols())
            .filter(|s| letter.number(&s.name()).is_some())
            .collect();
        let factors = Angle::of(cell.expr).terms;
        for (q, span) in variables {
            let q = letter.name(q);
            let symbol = Symbol::new(&q);
            if nonlinear.contains(&symbol) {
                let why = if is_affine(cell.expr, symbol) {
                    format!("the factor of `{q}` in `{name}` is no rational number")
                } else {
                    format!("`{name}` is not linear in `{q}`")
                };
                out.error(span, why).hint(format!("a joint variable may have a rational number as its factor and an offset: `{name} = \"2*{q} + 90 deg\"`"));
            } else if !summands.contains(&symbol) {
                out.error(span, format!("`{q}` cancels in `{name}`"));
            } else if let Some((_, k)) = factors.iter().find(|t| t.0.as_symbol() == Some(symbol))
                && !FACTORS.contains(&k.to_f64().abs())
            {
                out.error(
                    span,
                    format!(
                        "the factor of `{q}` is out of the range {:e} to {:e}",
                        FACTORS.start(),
                        FACTORS.end()
                    ),
                )
                .hint("gears are ratios: `theta = \"100*q1\"`");
            }
        }
    }
}

/// The joint variables of a letter in a cell, each once.
fn joint_variables(cell: &Cell, letter: Letter) -> Vec<(usize, Range<usize>)> {
    let mut found: Vec<(usize, Range<usize>)> = vec![];
    for (name, span) in &cell.symbols {
        if let Some(q) = letter.number(name)
            && !found.iter().any(|f| f.0 == q)
        {
            found.push((q, span.clone()));
        }
    }
    found
}

/// Reports names that are neither parameters nor joint variables, each once.
pub(super) fn check_declared<'a>(
    cells: impl IntoIterator<Item = &'a Cell>,
    parameters: &[String],
    count: usize,
    out: &mut Diagnostics,
) {
    let mut reported: Vec<&str> = vec![];
    for (name, span) in cells.into_iter().flat_map(|c| &c.symbols) {
        if variable_number(name).is_some() || parameters.contains(name) || reported.contains(&name.as_str()) {
            continue;
        }
        if out.is_full() {
            out.error(span.clone(), format!("`{name}` is not declared"));
            continue;
        }
        reported.push(name);
        let joints: Vec<String> = (1..=count.min(60)).map(|i| format!("q{i}")).collect();
        let lower = name.to_lowercase();
        let joint = ["theta", "t", "th"]
            .iter()
            .find_map(|p| lower.strip_prefix(p))
            .and_then(|n| joints.iter().find(|j| j[1..] == *n));
        let candidates = parameters.iter().chain(&joints).map(String::as_str);
        let hint = match (joint, nearest(name, candidates)) {
            (Some(q), _) => format!("joint variables are written `{q}`"),
            (_, Some(near)) => {
                format!("did you mean `{near}`? If not, declare it: [parameters] {name} = \"\"")
            }
            _ => format!("declare it: [parameters] {name} = \"450 mm\", or \"\" where it has no value"),
        };
        out.error(span.clone(), format!("`{name}` is not declared")).hint(hint);
    }
}
