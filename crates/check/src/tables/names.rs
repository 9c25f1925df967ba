//! What a table calls lengths, and in which unit it has them.

use denavit::description::{Cell, Description, Row};
use denavit_symbolic::{Expr, Rational, Symbol};
use std::collections::BTreeSet;

/// A robot and a table in the same names and units.
pub(super) struct Reading {
    pub robot: Description,
    pub table: Description,
    /// Names of the table for lengths of the robot.
    pub names: Vec<(String, String)>,
    /// The lengths of the table are in millimetres.
    pub millimetres: bool,
    /// The table has names that are not known of the robot.
    pub is_open: bool,
}

/// No more names than these are tried in all orders.
const MAX_OPEN: usize = 3;

/// The ways to read a table: in the robot's names, then in its numbers, metres first.
pub(super) fn readings(robot: &Description, table: &Description) -> Vec<Reading> {
    let mut found = vec![];
    for (table, names) in named(robot, table) {
        let is_known = |s: &Symbol| robot.parameter(*s).is_some() || is_joint(&table, *s);
        let is_open = lengths(&table)
            .iter()
            .flat_map(|e| e.symbols())
            .any(|s| !is_known(&s) && table.value(s).is_none());
        let has_numbers = lengths(&table).iter().any(|e| e.as_number().is_some_and(|n| !n.is_zero()))
            || table.parameters.iter().any(|p| p.value.is_some());
        if !has_numbers {
            found.push(Reading { robot: robot.clone(), table, names, millimetres: false, is_open });
            continue;
        }
        let (a, b) = (with_values(robot, robot), with_values(&table, robot));
        // A robot without numbers cannot be held against them.
        let is_open = is_open || lengths(&a).iter().any(|e| !e.symbols().is_empty());
        let in_metres = scaled(&b);
        found.push(Reading { robot: a.clone(), table: b, names: names.clone(), millimetres: false, is_open });
        found.push(Reading { robot: a, table: in_metres, names, millimetres: true, is_open: true });
    }
    found
}

/// A table with names of the robot in place of its own, each way that its places allow, and which became which.
fn named(robot: &Description, table: &Description) -> Vec<(Description, Vec<(String, String)>)> {
    let there = robot.converted(table.convention).description;
    let own = |s: &Symbol| robot.parameter(*s).is_none() && !is_joint(table, *s) && table.value(*s).is_none();
    let mut bound: Vec<(Symbol, Expr)> = vec![];
    for (a, b) in there.rows.iter().zip(&table.rows) {
        for cell in [Cell::A, Cell::D] {
            let (wanted, printed) = (positive(cell.of(a)), positive(cell.of(b)));
            if let Some(symbol) = printed.as_symbol().filter(own)
                && !wanted.is_zero()
                && wanted.symbols().iter().all(|s| !is_joint(table, *s))
                && bound.iter().all(|(s, e)| *s != symbol && *e != wanted)
            {
                bound.push((symbol, wanted));
            }
        }
    }
    let names = |bound: &[(Symbol, Expr)]| {
        let shown = |e: &Expr| e.as_symbol().map(|s| s.name().to_string());
        bound.iter().filter_map(|(s, e)| Some((s.name().to_string(), shown(e)?))).collect::<Vec<_>>()
    };
    let replaced = |bound: &[(Symbol, Expr)]| {
        let value = |s: Symbol| bound.iter().find(|b| b.0 == s).map(|b| b.1);
        mapped(table, &|e| e.substitute(value))
    };
    let symbols: BTreeSet<Symbol> = lengths(table).iter().flat_map(|e| e.symbols()).filter(own).collect();
    let open: Vec<Symbol> = symbols.into_iter().filter(|s| bound.iter().all(|b| b.0 != *s)).collect();
    let used = |s: &Symbol| {
        lengths(table).iter().any(|e| e.symbols().contains(s))
            || bound.iter().any(|b| b.1.as_symbol() == Some(*s))
    };
    let unused: Vec<Symbol> = robot.parameters.iter().map(|p| p.symbol).filter(|s| !used(s)).collect();
    let mut all = vec![bound.clone()];
    if !open.is_empty() && open.len() <= MAX_OPEN && unused.len() <= 2 * MAX_OPEN {
        let mut ways: Vec<Vec<Symbol>> = vec![vec![]];
        for _ in &open {
            ways = ways
                .iter()
                .flat_map(|w| unused.iter().filter(|u| !w.contains(u)).map(|u| [&w[..], &[*u]].concat()))
                .collect();
        }
        for way in ways {
            let further = open.iter().copied().zip(way.into_iter().map(Expr::from));
            all.push(bound.iter().copied().chain(further).collect());
        }
    }
    all.iter().map(|b| (replaced(b), names(b))).collect()
}

fn is_joint(d: &Description, symbol: Symbol) -> bool {
    d.variables().iter().any(|v| v.symbol == symbol)
}

/// Without its sign.
fn positive(e: Expr) -> Expr {
    if (-e).as_symbol().is_some() { -e } else { e }
}

/// The constant cells that are lengths.
fn lengths(d: &Description) -> Vec<Expr> {
    d.rows.iter().flat_map(|r| [r.a, r.d]).collect()
}

/// All cells changed.
fn mapped(d: &Description, change: &dyn Fn(Expr) -> Expr) -> Description {
    let mut d = d.clone();
    d.rows.iter_mut().for_each(|row: &mut Row| {
        for cell in [&mut row.theta, &mut row.d, &mut row.a, &mut row.alpha, &mut row.gamma, &mut row.b] {
            *cell = change(*cell);
        }
    });
    (d.base, d.tool) = (d.base.map(change), d.tool.map(change));
    d
}

/// Parameters replaced by their values, by those of the robot first.
fn with_values(d: &Description, robot: &Description) -> Description {
    let value = |s: Symbol| [robot, d].into_iter().find_map(|d| d.parameter(s)?.value);
    mapped(d, &|e| e.substitute(value))
}

/// Lengths divided by a thousand.
fn scaled(d: &Description) -> Description {
    let mut d = d.clone();
    let thousandth = Expr::from(Rational::new(1, 1000));
    let joints: Vec<Symbol> = d.variables().iter().map(|v| v.symbol).collect();
    let scale = |e: Expr| {
        // What moves is in metres already.
        let rest = e.substitute(|s| joints.contains(&s).then(|| Expr::int(0)));
        if rest == e { e * thousandth } else { e - rest + rest * thousandth }
    };
    for row in &mut d.rows {
        (row.a, row.d, row.b) = (scale(row.a), scale(row.d), scale(row.b));
    }
    d
}
