//! The search itself: single slips, one slip repeated, exchanges, then pairs.

use super::changes::{self, Change, home};
use super::edit::Edit;
use super::field::{self, Value, ZERO};
use super::lexicon::{Entry, Lexicon, distance};
use super::lookups::Lookups;
use super::tree::{Needed, Tree};
use super::{Slip, Wanted, brackets};
use denavit_symbolic::expr::{Expr, Node};
use denavit_symbolic::parse::Syntax;
use denavit_symbolic::readable::{literals, settled};
use rustc_hash::FxHashSet;

/// What a second slip costs beside its own cost.
const SECOND: u32 = 5;
/// Pairs are sought unless one slip explains the formula at this cost.
const PLAIN: u32 = 2 * changes::SIGN + SECOND;
/// No more small changes are tried.
const MAX_CHANGES: usize = 3_000;
/// No more leaves are exchanged.
const MAX_LEAVES: usize = 80;
/// Where all is dearer, the whole difference is tried as a lost term.
const LONG: u32 = 50;
/// In a printed formula of more parts it is not.
const MAX_DIFFERENCE: usize = 200;
/// What is dearer is not a repair but another formula.
const MAX_COST: u32 = 110;
/// In pairs, no first slip is dearer.
const MAX_FIRST: u32 = 20;

/// Work that is left, in additions and multiplications or so.
pub(super) struct Work(pub u64);

impl Work {
    /// False if not as much is left.
    pub fn spend(&mut self, units: u64) -> bool {
        match self.0.checked_sub(units) {
            Some(left) => {
                self.0 = left;
                true
            }
            None => false,
        }
    }
}

/// Edits that give the formula the value wanted.
#[derive(Clone, Debug)]
pub(super) struct Hit {
    pub cost: u32,
    pub slips: Vec<Slip>,
    pub edits: Vec<Edit>,
}

impl Hit {
    fn of(change: &Change) -> Self {
        Hit { cost: change.cost, slips: vec![change.slip.clone()], edits: vec![change.edit.clone()] }
    }

    /// This and another slip.
    fn and(mut self, other: Hit) -> Option<Self> {
        if other.edits.iter().any(|e| self.edits.contains(e)) {
            return None;
        }
        self.cost += other.cost + SECOND;
        self.slips.extend(other.slips);
        self.edits.extend(other.edits);
        Some(self)
    }
}

pub(super) struct Search<'a> {
    pub text: &'a str,
    pub tree: &'a Tree,
    pub lexicon: &'a Lexicon,
    /// The atoms of the right formula.
    home: FxHashSet<Expr>,
    wanted: Value,
    /// The right formula, if it is known, and the printed one.
    formula: Option<Expr>,
    printed: Option<Expr>,
    /// The arguments of an arctangent that is wanted.
    arguments: Option<(Value, Value)>,
}

impl<'a> Search<'a> {
    /// `None` if the formula that is wanted has no value.
    pub fn new(
        text: &'a str,
        (tree, printed): (&'a Tree, &Syntax),
        lexicon: &'a mut Lexicon,
        wanted: &Wanted,
    ) -> Option<Self> {
        let home = home(wanted);
        let (value, arguments) = match wanted {
            Wanted::Values(v) => (*v, None),
            Wanted::Formula(e) => {
                let arguments = match e.node() {
                    Node::Atan2(y, x) => lexicon.value(y).zip(lexicon.value(x)),
                    _ => None,
                };
                (lexicon.value(*e)?, arguments)
            }
        };
        let formula = match wanted {
            Wanted::Formula(e) => Some(*e),
            Wanted::Values(_) => None,
        };
        let is_small = tree.parts.len() <= MAX_DIFFERENCE;
        let printed = is_small.then(|| printed.value());
        Some(Search { text, tree, lexicon, home, wanted: value, formula, printed, arguments })
    }

    pub fn wanted(&self) -> &Value {
        &self.wanted
    }

    /// The hits, best first. The printed formula is known to be wrong.
    pub fn run(&self, work: &mut Work) -> Vec<Hit> {
        let tree = self.tree;
        let size = tree.parts.len() as u64;
        let Some(values) = tree.values(&[]) else { return vec![] };
        let needed = tree.needed(&values, &self.wanted, self.arguments);
        if !work.spend(8 * size) {
            return vec![];
        }
        let changes = changes::all(tree, &values, self.lexicon, &self.home, MAX_CHANGES);
        let mut hits: Vec<Hit> =
            changes.iter().filter(|c| self.mends(c, &needed, work)).map(Hit::of).collect();
        hits.extend(self.looked_up(&values, &needed, true, work));
        hits.extend(brackets::all(self.text, tree, &values, &needed, work));
        hits.extend(self.exchanges(work));
        hits.extend(self.repeated(work));
        if hits.iter().all(|h| h.cost > PLAIN) {
            hits.extend(self.pairs(&changes, work));
        }
        if hits.is_empty() {
            hits.extend(self.pairs_looked_up(&changes, work));
        }
        if hits.iter().all(|h| h.cost > LONG) {
            hits.extend(self.difference());
        }
        hits.retain(|h| h.cost <= MAX_COST);
        hits.sort_by_key(|h| (h.cost, h.edits.len()));
        hits
    }

    /// Whether a change of one part makes the whole right.
    fn mends(&self, change: &Change, needed: &[Needed], work: &mut Work) -> bool {
        match &needed[change.part] {
            Some(needed) => fits(&change.value, needed),
            // No single value is needed where it is under a power, or where a product is 0: it is tried.
            None => {
                work.spend(self.tree.parts.len() as u64)
                    && self.tree.values(&[(change.part, change.value)]).is_some_and(|v| self.is_right(&v))
            }
        }
    }

    /// True if these values are those of a right formula.
    fn is_right(&self, values: &[Value]) -> bool {
        values.first() == Some(&self.wanted)
    }

    fn looked_up(&self, values: &[Value], needed: &[Needed], with_runs: bool, work: &mut Work) -> Vec<Hit> {
        let mut lookups = Lookups {
            tree: self.tree,
            values,
            needed,
            lexicon: self.lexicon,
            home: &self.home,
            hits: vec![],
        };
        for part in 0..self.tree.parts.len() {
            lookups.part(part, work);
            if with_runs {
                lookups.runs(part, work);
            }
        }
        lookups.hits
    }

    /// The whole difference to the formula wanted, as a term.
    fn difference(&self) -> Option<Hit> {
        let (Some(right), Some(printed)) = (self.formula, self.printed) else { return None };
        let missing = settled(right - printed);
        let (is_minus, missing) = match missing.node() {
            Node::Neg(a) => (true, a),
            _ => (false, missing),
        };
        let size = u32::try_from(literals(missing)).unwrap_or(u32::MAX);
        let cost = 18_u32.saturating_add(size.saturating_mul(5));
        let edits = vec![Edit::Term(0, Entry::Phrase(missing, size), is_minus)];
        (cost <= MAX_COST).then(|| Hit { cost, slips: vec![Slip::LostTerm], edits })
    }

    /// Two leaves exchanged.
    fn exchanges(&self, work: &mut Work) -> Vec<Hit> {
        let tree = self.tree;
        let own = tree.values(&[]).unwrap_or_default();
        let leaves: Vec<usize> = tree.leaves().map(|l| l.0).take(MAX_LEAVES).collect();
        let mut hits = vec![];
        for (i, &a) in leaves.iter().enumerate() {
            for &b in &leaves[i + 1..] {
                let is_idle = own[a] == own[b]
                    || tree.parts[a].parent == tree.parts[b].parent && tree.term(a) == tree.term(b);
                if is_idle {
                    continue;
                }
                if !work.spend(tree.parts.len() as u64) {
                    return hits;
                }
                if tree.values(&[(a, own[b]), (b, own[a])]).is_some_and(|v| self.is_right(&v)) {
                    // In one sum, or one inside of the other's.
                    let sum = |x: usize| tree.parts[tree.term(x)].parent;
                    let cost = if sum(a) == sum(b) { 18 } else { 24 };
                    let edits = vec![Edit::Exchange(a, b)];
                    hits.push(Hit { cost, slips: vec![Slip::Exchanged], edits });
                }
            }
        }
        hits
    }

    /// The same atom wrong wherever it stands.
    fn repeated(&self, work: &mut Work) -> Vec<Hit> {
        let tree = self.tree;
        let mut atoms: Vec<Expr> = tree.leaves().map(|l| l.1).collect();
        atoms.sort_unstable();
        atoms.dedup();
        let mut hits = vec![];
        for atom in atoms {
            let places: Vec<usize> = tree.leaves().filter(|l| l.1 == atom).map(|l| l.0).collect();
            if places.len() < 2 {
                continue;
            }
            for &(other, value) in &self.lexicon.atoms {
                let cost = distance(atom, other);
                if other == atom || cost > 24 {
                    continue;
                }
                if !work.spend(tree.parts.len() as u64) {
                    return hits;
                }
                let others: Vec<(usize, Value)> = places.iter().map(|&p| (p, value)).collect();
                if tree.values(&others).is_some_and(|v| self.is_right(&v)) {
                    let cost = cost + 6 * (places.len() as u32 - 1) + changes::foreign(other, &self.home);
                    let edits = places.iter().map(|&p| Edit::Respell(p, other)).collect();
                    hits.push(Hit { cost, slips: vec![changes::replaced(atom, other)], edits });
                }
            }
        }
        hits
    }

    /// Two small changes.
    fn pairs(&self, changes: &[Change], work: &mut Work) -> Vec<Hit> {
        let tree = self.tree;
        let mut order: Vec<&Change> = changes.iter().collect();
        order.sort_by_key(|c| c.cost);
        let mut hits: Vec<Hit> = vec![];
        let mut best = u32::MAX;
        for (i, first) in order.iter().enumerate() {
            if first.cost.saturating_mul(2) > best || !work.spend(8 * tree.parts.len() as u64) {
                break;
            }
            let Some(values) = tree.values(&[(first.part, first.value)]) else { continue };
            let needed = tree.needed(&values, &self.wanted, self.arguments);
            if !work.spend(1 + order.len() as u64 / 4) {
                break;
            }
            for (j, second) in order.iter().enumerate() {
                let cost = first.cost + second.cost;
                if cost > best {
                    break; // the others are dearer still
                }
                let Some(wanted) = &needed[second.part] else { continue };
                // Of a change that contains the other only the sign is still the same.
                let is_flip = matches!(second.edit, Edit::Flip(_));
                let contains = first.part != second.part && tree.is_in(first.part, second.part);
                let value = match (is_flip, contains) {
                    (true, true) => field::opposite(&values[second.part]),
                    (false, true) => continue,
                    _ if j < i => continue,
                    _ => second.value,
                };
                if fits(&value, wanted) && first.part != second.part && !tree.is_in(second.part, first.part) {
                    best = best.min(cost + SECOND);
                    hits.extend(Hit::of(first).and(Hit::of(second)));
                }
            }
        }
        hits
    }

    /// A small change, and whatever the lexicon has for the rest.
    fn pairs_looked_up(&self, changes: &[Change], work: &mut Work) -> Vec<Hit> {
        let tree = self.tree;
        let mut order: Vec<&Change> = changes.iter().filter(|c| c.cost <= MAX_FIRST).collect();
        order.sort_by_key(|c| c.cost);
        let mut hits: Vec<Hit> = vec![];
        for first in order {
            if !work.spend(30 * tree.parts.len() as u64) {
                break;
            }
            let Some(values) = tree.values(&[(first.part, first.value)]) else { continue };
            let needed = tree.needed(&values, &self.wanted, self.arguments);
            let mut found = self.looked_up(&values, &needed, false, work);
            found.extend(brackets::all(self.text, tree, &values, &needed, work));
            hits.extend(found.into_iter().filter_map(|second| Hit::of(first).and(second)));
        }
        hits
    }
}

fn fits(value: &Value, (n, d): &(Value, Value)) -> bool {
    field::times(value[0], d[0]) == n[0] && field::difference(&field::product(value, d), n) == ZERO
}
