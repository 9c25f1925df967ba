//! The serial chain that a linkage is where its passive joints are affine in the driven ones: they become couplings.

use super::dyad::Complex;
use super::mode::{Mode, NoMode, Sign};
use super::order::{Dyad, Plan};
use super::{Linkage, is_passive};
use crate::description::branches::{NamedFrame, RowChain, RowTree};
use crate::description::{Convention, NoChain, Row};
use denavit_symbolic::factor::factored;
use denavit_symbolic::{Angle, Expr, Symbol, equal};
use std::fmt;

/// What is known of a chain that was taken out of a linkage.
#[derive(Clone, Debug)]
pub struct ClosedChain {
    /// The assembly mode.
    pub mode: Mode,
    /// What the linkage calls it.
    pub mode_name: Option<String>,
    /// The driven joint of the linkage that each joint variable of the chain is.
    pub driven: Vec<Symbol>,
    /// The passive variables in the driven ones of the linkage, as far as they are affine.
    pub passive: Vec<(Symbol, Expr)>,
    /// True if this holds for the values of the parameters alone, which stand in the place of their names.
    pub is_of_values: bool,
    /// Loops with passive joints that are not affine: nothing is proved of these, and they close only as far as they reach.
    pub untested: Vec<String>,
    /// Passive joints with limits, which a chain has no place for.
    pub without_limits: Vec<String>,
    /// Frames of rows beside the chain that move with it: links that have no place in it.
    pub beside: Vec<String>,
    /// What is 0 where the affine mode of a loop meets its other one, the factors with joints alone: there the loop is flat, a parallel
    /// singularity that the chain knows nothing of.
    pub meets: Vec<Expr>,
}

/// Why a linkage is no serial chain.
#[derive(Clone, PartialEq, Debug)]
pub enum NotCoupled {
    /// There is no such assembly mode.
    NoMode(NoMode),
    /// There is no such chain.
    NoChain(NoChain),
    /// On the way passive joints are not affine in driven ones, in this mode.
    NotAffine {
        /// The passive variables.
        passive: Vec<String>,
        /// The mode.
        mode: String,
    },
    /// The closure is not proved with the couplings that were found.
    NotProved(String),
}

impl fmt::Display for NotCoupled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NotCoupled::NoMode(why) => why.fmt(f),
            NotCoupled::NoChain(why) => why.fmt(f),
            NotCoupled::NotAffine { passive, mode } => {
                let (are, s) = if passive.len() == 1 { ("is", "") } else { ("are", "s") };
                let mode = if mode.is_empty() { String::new() } else { format!(" in the mode {mode}") };
                write!(
                    f,
                    "closed loops, and no serial chain: the passive joint{s} {} {are} not affine in the driven joints{mode}",
                    passive.join(", ")
                )
            }
            NotCoupled::NotProved(name) => write!(f, "`{name}` is not proved to close with its couplings"),
        }
    }
}

impl From<NoChain> for NotCoupled {
    fn from(why: NoChain) -> Self {
        NotCoupled::NoChain(why)
    }
}

impl Linkage {
    /// The serial chain between two frames in an assembly mode, where nothing else is asked for that which is meant: the passive joints
    /// on the way are couplings of the driven ones. That the loops close so is proved.
    ///
    /// # Errors
    /// If there is no such mode or chain, or a passive joint on the way is not affine in driven ones.
    pub fn chain(
        &self,
        from: Option<&str>,
        to: Option<&str>,
        mode: Option<&str>,
        convention: Convention,
    ) -> Result<RowChain, NotCoupled> {
        let by_names = self.chain_as_it_is(from, to, mode, convention, false);
        match by_names {
            Err(NotCoupled::NotAffine { .. }) if !self.tree.parameters.is_empty() => {
                // What is a parallelogram by its values alone.
                let numbers = self.in_numbers();
                numbers.chain_as_it_is(from, to, mode, convention, true).or(by_names)
            }
            known => known,
        }
    }

    fn chain_as_it_is(
        &self,
        from: Option<&str>,
        to: Option<&str>,
        mode: Option<&str>,
        convention: Convention,
        is_of_values: bool,
    ) -> Result<RowChain, NotCoupled> {
        let plan = Plan::of(self);
        let mode = self.mode(&plan, mode).map_err(NotCoupled::NoMode)?;
        let end = self.tree.end(from, to)?;
        let (tree, is_left_out) = self.coupled(&plan, &mode);
        let ways = [from.map(|name| self.tree.named(name)), Some(end.clone())].into_iter().flatten();
        let rows = ways.filter_map(|name| self.tree.row_of(&name)).flat_map(|row| self.tree.way(Some(row)));
        let affine = plan.affine(&mode);
        let mut missing: Vec<Symbol> = vec![];
        for row in rows.filter(|&j| is_left_out[j]).map(|j| &self.tree.rows[j]) {
            let known = |s: Symbol| affine.iter().any(|a| a.0 == s && a.1.is_some());
            let all = [row.theta, row.d].into_iter().flat_map(Expr::symbols);
            for s in all.filter(|&s| is_passive(s) && !known(s)) {
                if !missing.contains(&s) {
                    missing.push(s);
                }
            }
        }
        if !missing.is_empty() {
            let passive = missing.iter().map(|s| s.name().to_string()).collect();
            return Err(NotCoupled::NotAffine { passive, mode: mode.to_string() });
        }
        if let Some(closure) = self.first_open(&plan, &mode) {
            return Err(NotCoupled::NotProved(self.loop_name(closure)));
        }
        let mut chain = tree.chain(from, Some(&end), convention)?;
        let has_limits = |row: &&Row| {
            let is_limited = row.limits.is_some() || row.velocity.is_some() || row.acceleration.is_some();
            is_limited && row.variable.is_some_and(|v| is_passive(v.symbol))
        };
        let limited = self.tree.rows.iter().filter(has_limits).filter_map(|r| r.variable);
        let on_way = self.tree.way(self.tree.row_of(&end));
        let is_beside = |j: &usize| {
            let moves = self.tree.way(Some(*j)).iter().any(|&k| self.tree.rows[k].variable.is_some());
            moves && !on_way.contains(j)
        };
        let beside = (0..self.tree.rows.len()).filter(is_beside).map(|j| self.tree.frame_name(j)).collect();
        let meets = self.meets(&plan, &mode);
        let untested = self.untested(&plan, &mode).map(|k| self.loop_name(k)).collect();
        chain.closed = Some(Box::new(ClosedChain {
            mode_name: self.mode_name(&plan, &mode).map(str::to_string),
            mode,
            driven: chain.variables.clone(),
            passive: affine.into_iter().filter_map(|(s, e)| Some((s, e?))).collect(),
            is_of_values,
            untested,
            without_limits: limited.map(|v| v.symbol.name().to_string()).collect(),
            beside,
            meets,
        }));
        Ok(chain)
    }

    /// The tree with its passive variables as couplings of the driven ones, without the rows of which they are not affine and what
    /// stands on these; and whether each row is left out.
    pub fn coupled(&self, plan: &Plan, mode: &Mode) -> (RowTree, Vec<bool>) {
        let affine = plan.affine(mode);
        let value = |s: Symbol| affine.iter().find(|a| a.0 == s).and_then(|a| a.1);
        let mut place: Vec<Option<usize>> = vec![];
        let (mut rows, mut after) = (vec![], vec![]);
        for (row, &on) in self.tree.rows.iter().zip(&self.tree.after) {
            let symbols = [row.theta, row.d].into_iter().flat_map(Expr::symbols);
            let is_known = symbols.into_iter().all(|s| !is_passive(s) || value(s).is_some());
            let stands = on.map_or(Some(None), |a| place[a].map(Some));
            let (Some(on), true) = (stands, is_known) else {
                place.push(None);
                continue;
            };
            place.push(Some(rows.len()));
            rows.push(with_couplings(row, &value));
            after.push(on);
        }
        let frame = |f: &NamedFrame| {
            let on = f.on.map_or(Some(None), |row| place[row].map(Some))?;
            Some(NamedFrame { on, ..f.clone() })
        };
        let frames = self.tree.frames.iter().filter_map(frame).collect();
        let poses = self.poses.clone();
        let tree = RowTree { rows, after, frames, poses, ..self.tree.clone() };
        (tree, place.iter().map(Option::is_none).collect())
    }

    /// What is 0 where an affine solution meets the other one: the factors with joints of P × A·e₁.
    fn meets(&self, plan: &Plan, mode: &Mode) -> Vec<Expr> {
        let affine = plan.affine(mode);
        let value = |s: Symbol| affine.iter().find(|a| a.0 == s).and_then(|a| a.1);
        let variables: Vec<Symbol> = self.driven().iter().map(|v| v.symbol).collect();
        let mut all: Vec<Expr> = vec![];
        for (step, sign) in plan.steps.iter().zip(&mode.0) {
            let Dyad::Turns { a, p, affine, .. } = &step.dyad else { continue };
            let solution = match sign {
                Sign::Affine => affine.first(),
                Sign::Crossed => affine.get(1),
                _ => None,
            };
            let Some([one, _]) = solution else { continue };
            let w = a.formula() * Complex::direction(one.to_expr());
            let area = (p.formula().conj() * w).im.substitute(value);
            let Ok(product) = factored(area, &variables) else { continue };
            for (factor, _) in product.factors {
                let moves = factor.symbols().iter().any(|s| variables.contains(s));
                if moves && !all.contains(&factor) {
                    all.push(factor);
                }
            }
        }
        all
    }

    /// The closures that hold passive joints which are not affine in this mode.
    fn untested(&self, plan: &Plan, mode: &Mode) -> impl Iterator<Item = usize> {
        let affine = plan.affine(mode);
        let is_affine = move |s: Symbol| affine.iter().any(|a| a.0 == s && a.1.is_some());
        (0..self.closures.len()).filter(move |&k| !self.symbols_of(k).into_iter().all(&is_affine))
    }

    /// The first closure that is not proved to close in this mode, of those whose passive joints are all affine.
    pub fn first_open(&self, plan: &Plan, mode: &Mode) -> Option<usize> {
        let affine = plan.affine(mode);
        let value = |s: Symbol| affine.iter().find(|a| a.0 == s).and_then(|a| a.1);
        let untested: Vec<usize> = self.untested(plan, mode).collect();
        (0..self.closures.len()).filter(|k| !untested.contains(k)).find(|&k| {
            let [left, right] = self.ends(k).map(|x| x.map(|e| e.substitute(value)));
            let (left, right) = (left.matrix().concat(), right.matrix().concat());
            !left.into_iter().zip(right).all(|(a, b)| equal(a, b).is_equal())
        })
    }
}

/// A row of which the passive variables are couplings.
fn with_couplings(row: &Row, value: &impl Fn(Symbol) -> Option<Expr>) -> Row {
    let put = |e: Expr| match e.symbols().into_iter().any(is_passive) {
        true => Angle::of(e.substitute(value)).to_expr(),
        false => e,
    };
    let mut coupled = Row { theta: put(row.theta), d: put(row.d), ..row.clone() };
    if row.variable.is_some_and(|v| is_passive(v.symbol)) {
        coupled.variable = None;
        (coupled.limits, coupled.velocity, coupled.acceleration) = (None, None, None);
    }
    coupled
}
