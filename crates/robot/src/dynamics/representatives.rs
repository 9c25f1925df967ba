//! Base parameters with other representatives: which parameters of the links stand for those that are grouped with them.
//!
//! Grouping gives β = K χ, a row of K for each base parameter, and τ = W β with independent columns of W. So any parameters S, of
//! which the columns of K have an inverse, are representatives as well: τ = (W K_S)(K_S⁻¹ K χ), with 1 for each of S in its own row
//! (Gautier 1991). K is reduced in symbols, one column after the other.

use super::base::{BaseModel, BaseParameter, named_apart};
use super::grouping::Grouped;
use super::model::Formulas;
use crate::geometry::PARAMETERS;
use denavit_symbolic::{Expr, Node, Symbol, equal, readable};
use rustc_hash::{FxHashMap, FxHashSet};
use std::fmt;

/// What is asked of the representatives; grouping chooses the others.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Representatives {
    /// Parameters of the links that are to be representatives.
    pub kept: Vec<Symbol>,
    /// Those that are not to be.
    pub dropped: Vec<Symbol>,
}

/// Why parameters are no representatives.
#[derive(Clone, PartialEq, Debug)]
pub enum NoBasis {
    /// The links have no such parameter.
    Unknown(Symbol),
    /// It is to be kept and to be dropped.
    Both(Symbol),
    /// No torque depends on it.
    WithoutEffect(Symbol),
    /// With those that are kept already it is too many: its effect is that of these.
    Dependent(Symbol, Expr),
    /// It cannot be dropped: with it all go that could stand for it, these among them.
    Needed(Symbol, Vec<Symbol>),
    /// Numbers of links are formulas, and no parameters of their own.
    Formulas,
}

impl fmt::Display for NoBasis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoBasis::Unknown(s) => write!(f, "the links have no parameter {}", s.name()),
            NoBasis::Both(s) => write!(f, "{} cannot be kept and dropped", s.name()),
            NoBasis::WithoutEffect(s) => {
                write!(f, "{} has no effect on the torques: it represents nothing", s.name())
            }
            NoBasis::Dependent(s, of) => {
                let name = s.name();
                write!(f, "{name} cannot be kept with the others: its effect on the torques is theirs, {of}")
            }
            NoBasis::Needed(s, gone) if gone.is_empty() => {
                write!(f, "{} cannot be dropped: no other parameter stands for it", s.name())
            }
            NoBasis::Needed(s, gone) => {
                let gone: Vec<String> = gone.iter().map(|s| s.name().to_string()).collect();
                let (name, gone) = (s.name(), gone.join(", "));
                write!(f, "{name} cannot be dropped: all that could stand for it are dropped, too: {gone}")
            }
            NoBasis::Formulas => f.write_str(
                "masses of links are formulas in this description: they have no parameters that could be chosen",
            ),
        }
    }
}

impl std::error::Error for NoBasis {}

/// A row of K: what is not 0 of it, by the number of the column.
type Row = FxHashMap<usize, Expr>;

/// K under way.
struct Table<'a> {
    /// The parameters of the links, with the link and the place among [`PARAMETERS`].
    columns: Vec<(Symbol, usize, usize)>,
    rows: Vec<Row>,
    /// The column that stands for each row; none yet.
    chosen: Vec<Option<usize>>,
    /// The order in which symbols are written.
    order: &'a [Symbol],
}

impl BaseModel {
    /// The same torques in base parameters with other representatives, what links have in terms of them.
    ///
    /// # Errors
    /// If what is asked for is no choice of representatives.
    pub(super) fn with_representatives(
        &self,
        order: &[Symbol],
        formulas: &Formulas,
        wanted: &Representatives,
    ) -> Result<Self, NoBasis> {
        let mut table = Table::new(self, order, formulas)?;
        let given = table.rows.clone();
        table.choose(wanted)?;
        // In the order of links and their parameters.
        let mut all: Vec<(usize, usize)> =
            table.chosen.iter().enumerate().filter_map(|(row, c)| c.map(|c| (c, row))).collect();
        all.sort_unstable();
        let mut taken: FxHashSet<String> =
            formulas.parameters.iter().map(|p| p.symbol.name().to_string()).collect();
        let mut parameters: Vec<BaseParameter> = vec![];
        for &(column, row) in &all {
            let (symbol, link, place) = table.columns[column];
            let mut terms: Vec<(usize, Expr)> = table.rows[row].iter().map(|(&c, &k)| (c, k)).collect();
            terms.sort_unstable_by_key(|t| t.0);
            let is_grouped = terms.len() > 1;
            let sum = |all: Expr, &(c, k): &(usize, Expr)| all + k * Expr::from(table.columns[c].0);
            let value = table.simple(terms.iter().fold(Expr::int(0), sum));
            let symbol = if is_grouped { named_apart(PARAMETERS[place], link, &mut taken) } else { symbol };
            parameters.push(BaseParameter { symbol, value, link, is_grouped });
        }
        // β = K_S β'
        let names: Vec<(usize, Symbol)> = all.iter().zip(&parameters).map(|(c, p)| (c.0, p.symbol)).collect();
        let mut values: FxHashMap<Symbol, Expr> = FxHashMap::default();
        for (p, row) in self.parameters.iter().zip(&given) {
            let terms = names.iter().filter_map(|(c, s)| Some(*row.get(c)? * Expr::from(*s)));
            values.insert(p.symbol, terms.fold(Expr::int(0), |all, term| all + term));
        }
        let links: Vec<Grouped> = self
            .links
            .iter()
            .map(|link| link.with(|_, e| e.substitute(|s| values.get(&s).copied())))
            .collect();
        Ok(BaseModel { asked: wanted.clone(), ..BaseModel::in_parameters(formulas, links, parameters) })
    }
}

impl<'a> Table<'a> {
    fn new(base: &BaseModel, order: &'a [Symbol], formulas: &Formulas) -> Result<Self, NoBasis> {
        let mut columns: Vec<(Symbol, usize, usize)> = vec![];
        let links = &formulas.dynamics.links;
        let bodies = links.iter().enumerate().map(|(k, link)| (k, link.body.parameters()));
        let own =
            bodies.flat_map(|(k, all)| all.into_iter().enumerate().map(move |(place, e)| (e, k, place)));
        let payload = formulas.payload.iter().enumerate();
        let payload = payload.map(|(place, &s)| (Expr::from(s), links.len().saturating_sub(1), place));
        let is_own: FxHashSet<Symbol> = formulas.payload.iter().copied().collect();
        for (e, link, place) in own.chain(payload) {
            // What the tool carries is added to the numbers of the last link.
            let symbols =
                e.symbols().into_iter().filter(|s| e.as_symbol() == Some(*s) || !is_own.contains(s));
            for s in symbols.collect::<Vec<_>>() {
                if !columns.iter().any(|c| c.0 == s) {
                    columns.push((s, link, place));
                }
            }
        }
        let mut table = Table { columns, rows: vec![], chosen: vec![], order };
        for p in &base.parameters {
            let none = p.value.substitute(|s| table.column(s).map(|_| Expr::int(0)));
            if !table.simple(none).is_zero() {
                return Err(NoBasis::Formulas);
            }
            let mut row = Row::default();
            for s in p.value.symbols() {
                let Some(c) = table.column(s) else { continue };
                let alone = |o: Symbol| table.column(o).map(|_| Expr::int(i64::from(o == s)));
                let k = table.simple(p.value.substitute(alone));
                // A sum of multiples, and nothing else.
                let twice = |o: Symbol| table.column(o).map(|_| Expr::int(if o == s { 2 } else { 0 }));
                if !equal(p.value.substitute(twice), Expr::int(2) * k).is_equal() {
                    return Err(NoBasis::Formulas);
                }
                row.insert(c, k);
            }
            table.rows.push(row);
            table.chosen.push(None);
        }
        Ok(table)
    }

    fn column(&self, s: Symbol) -> Option<usize> {
        self.columns.iter().position(|c| c.0 == s)
    }

    fn simple(&self, e: Expr) -> Expr {
        cancelled(readable::simplify(e, self.order).map_or(e, |s| s.expr))
    }

    fn choose(&mut self, wanted: &Representatives) -> Result<(), NoBasis> {
        let find = |s: &Symbol| self.column(*s).ok_or(NoBasis::Unknown(*s));
        let kept: Vec<usize> = wanted.kept.iter().map(find).collect::<Result<_, _>>()?;
        let dropped: Vec<usize> = wanted.dropped.iter().map(find).collect::<Result<_, _>>()?;
        if let Some(&both) = kept.iter().find(|c| dropped.contains(c)) {
            return Err(NoBasis::Both(self.columns[both].0));
        }
        // What grouping has for each row: the first that is in no other one.
        let own: Vec<Option<usize>> = self
            .rows
            .iter()
            .enumerate()
            .map(|(i, row)| {
                let alone =
                    |c: &usize| self.rows.iter().enumerate().all(|(j, r)| i == j || !r.contains_key(c));
                row.keys().copied().filter(alone).min()
            })
            .collect();
        for &c in &kept {
            if self.chosen.contains(&Some(c)) {
                continue;
            }
            let open =
                (0..self.rows.len()).filter(|&i| self.chosen[i].is_none() && self.rows[i].contains_key(&c));
            // What is to go goes first, what is to stay last; then what is of the same link, or near, and what is simple to divide by.
            let rank = |&i: &usize| {
                let by = own[i].map_or(1, |o| match (dropped.contains(&o), kept.contains(&o) && o != c) {
                    (true, _) => 0,
                    (false, false) => 1,
                    (false, true) => 2,
                });
                let far = own[i].map_or(0, |o| self.columns[o].1.abs_diff(self.columns[c].1));
                (by, far, weight(self.rows[i][&c]), i)
            };
            let Some(row) = open.min_by_key(rank) else {
                let terms = (0..self.rows.len()).filter_map(|i| {
                    let k = self.rows[i].get(&c)?;
                    Some(*k * Expr::from(self.columns[self.chosen[i]?].0))
                });
                let sum = self.simple(terms.fold(Expr::int(0), |all, term| all + term));
                let symbol = self.columns[c].0;
                return Err(match sum.is_zero() {
                    true => NoBasis::WithoutEffect(symbol),
                    false => NoBasis::Dependent(symbol, sum),
                });
            };
            self.reduce(row, c);
        }
        for row in 0..self.rows.len() {
            if self.chosen[row].is_some() {
                continue;
            }
            let is_free = |c: &usize| !dropped.contains(c) && !self.chosen.contains(&Some(*c));
            let own = own[row].filter(|c| is_free(c) && self.rows[row].contains_key(c));
            let mut others: Vec<usize> = self.rows[row].keys().copied().filter(is_free).collect();
            others.sort_unstable_by_key(|&c| (weight(self.rows[row][&c]), c));
            let Some(c) = own.or(others.first().copied()) else {
                let mut gone: Vec<usize> =
                    self.rows[row].keys().copied().filter(|c| dropped.contains(c)).collect();
                gone.sort_unstable();
                let mut gone: Vec<Symbol> = gone.into_iter().map(|c| self.columns[c].0).collect();
                let first = if gone.is_empty() { self.columns[0].0 } else { gone.remove(0) };
                return Err(NoBasis::Needed(first, gone));
            };
            self.reduce(row, c);
        }
        Ok(())
    }

    /// Makes a column 1 in a row and 0 in all others.
    fn reduce(&mut self, row: usize, column: usize) {
        let by = self.rows[row][&column];
        let mut leading: Row = Row::default();
        for (&c, &k) in &self.rows[row] {
            leading.insert(c, if c == column { Expr::int(1) } else { self.simple(k / by) });
        }
        for i in (0..self.rows.len()).filter(|&i| i != row) {
            let Some(k) = self.rows[i].remove(&column) else { continue };
            for (&c, &l) in leading.iter().filter(|l| *l.0 != column) {
                let before = self.rows[i].get(&c).copied().unwrap_or(Expr::int(0));
                let after = self.simple(before - k * l);
                if after.is_zero() || equal(after, Expr::int(0)).is_equal() {
                    self.rows[i].remove(&c);
                } else {
                    self.rows[i].insert(c, after);
                }
            }
        }
        self.rows[row] = leading;
        self.chosen[row] = Some(column);
    }
}

/// A quotient without the factors that both of its parts have.
fn cancelled(e: Expr) -> Expr {
    let (over, under) = match e.node() {
        Node::Neg(a) => return -cancelled(a),
        Node::Div(a, b) => (factors(a), factors(b)),
        _ => return e,
    };
    let (mut over, mut left) = (over, vec![]);
    for f in under {
        match over.iter().position(|g| *g == f) {
            Some(place) => {
                over.remove(place);
            }
            None => left.push(f),
        }
    }
    let product = |all: Vec<Expr>| all.into_iter().fold(Expr::int(1), |all, f| all * f);
    product(over) / product(left)
}

/// The factors of a product, powers as often as they count.
fn factors(e: Expr) -> Vec<Expr> {
    match e.node() {
        Node::Mul(a, b) => [factors(a), factors(b)].concat(),
        Node::Neg(a) => [vec![Expr::int(-1)], factors(a)].concat(),
        Node::Pow(a, n) if n > 0 => vec![a; n.unsigned_abs() as usize],
        _ => vec![e],
    }
}

/// How simple it is to divide by: a number first, then few operations.
fn weight(e: Expr) -> usize {
    match e.as_number() {
        Some(_) => 0,
        None => Expr::postorder(&[e]).len(),
    }
}
