//! What the formulas about a subject are made of: values to small expressions.

use super::field::{self, ONE, Value};
use super::points::Points;
use super::style::Style;
use denavit_symbolic::Angle;
use denavit_symbolic::expr::{Expr, Node};
use denavit_symbolic::parse::{Syntax, SyntaxKind};
use rustc_hash::{FxHashMap, FxHashSet};
use smallvec::SmallVec;

/// No more products than these are listed.
const MAX_PRODUCTS: usize = 40_000;
/// The most atoms in a listed product.
const MAX_FACTORS: usize = 4;
/// The largest expression of the right formulas that is listed, in leaves.
const MAX_PHRASE: u32 = 40;
/// No more atoms than these are used.
const MAX_ATOMS: usize = 400;
/// A name with a meaning is multiplied by no more atoms than these.
const MAX_NAMED: usize = 100;
/// The seeds that are tried for the points.
const SEEDS: u64 = 4;

/// The small expressions that a printed formula may lack, found by their values.
#[derive(Clone, Debug)]
pub struct Lexicon {
    points: Points,
    pub(super) atoms: Vec<(Expr, Value)>,
    numbers: FxHashMap<Expr, u16>,
    entries: FxHashMap<Value, Entry>,
    pub(super) style: Style,
}

/// A small expression, up to its sign.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Entry {
    /// A product of atoms; of none, it is 1.
    Product(SmallVec<[u16; MAX_FACTORS]>),
    /// The sum of two atoms, or their difference.
    Sum(u16, u16, bool),
    /// A part of a right formula, and its leaves.
    Phrase(Expr, u32),
}

impl Entry {
    /// The number of leaves.
    pub fn size(&self) -> u32 {
        match self {
            Entry::Product(atoms) => (atoms.len() as u32).max(1),
            Entry::Sum(..) => 2,
            Entry::Phrase(_, size) => *size,
        }
    }
}

impl Lexicon {
    /// The lexicon of a subject: `atoms` are symbols, sines and cosines; `right` are formulas that are known to be
    /// right, whose parts are plausible. `None` if a formula has no value at the points tried.
    pub fn new(atoms: &[Expr], right: &[Expr]) -> Option<Self> {
        let all: Vec<Expr> = atoms.iter().chain(right).copied().collect();
        let points = (0..SEEDS).find_map(|seed| Points::fitting(seed, &all))?;
        let mut lexicon = Lexicon {
            points,
            atoms: vec![],
            numbers: FxHashMap::default(),
            entries: FxHashMap::default(),
            style: Style::default(),
        };
        lexicon.offer(ONE, Entry::Product(SmallVec::new()));
        let parts = Expr::postorder(right);
        for &e in atoms.iter().chain(&parts) {
            lexicon.add_atom(e);
        }
        lexicon.list_products();
        lexicon.list_phrases(&parts);
        Some(lexicon)
    }

    /// The points at which this lexicon compares: the same question has the same answer.
    pub fn value(&mut self, e: Expr) -> Option<Value> {
        self.points.value(e)
    }

    /// The points themselves.
    pub fn points(&mut self) -> &mut Points {
        &mut self.points
    }

    /// Records how an atom is printed.
    pub fn spelled(&mut self, e: Expr, text: &str) {
        self.style.spelled(e, text);
    }

    /// Learns from a printed formula: spellings, names with a meaning of their own, the signs between factors and terms,
    /// and which factor comes first.
    pub fn learn(&mut self, text: &str, printed: &Syntax) {
        self.style.learn(text, printed, true);
        self.add_names(printed);
    }

    /// Learns from a formula that is wrong.
    pub(super) fn learn_spellings(&mut self, text: &str, printed: &Syntax) {
        self.style.learn(text, printed, false);
        self.add_names(printed);
    }

    /// The names that stand for formulas, and their products with atoms.
    fn add_names(&mut self, printed: &Syntax) {
        let mut stack = vec![printed];
        while let Some(part) = stack.pop() {
            stack.extend(part.children());
            let SyntaxKind::Name(e) = part.kind else { continue };
            if is_atom(e) || e.as_number().is_some() || self.numbers.contains_key(&e) {
                self.add_atom(e);
                continue;
            }
            let count = self.atoms.len().min(MAX_NAMED) as u16;
            let Some((own, value)) = self.add(e) else { continue };
            for other in 0..count {
                let value = field::product(&value, &self.atoms[usize::from(other)].1);
                self.offer(value, Entry::Product([other, own].into_iter().collect()));
            }
        }
    }

    /// Makes sure that what a right formula is made of is listed.
    pub(super) fn add_formula(&mut self, right: Expr) {
        let parts = Expr::postorder(&[right]);
        for &e in &parts {
            self.add_atom(e);
        }
        self.list_phrases(&parts);
    }

    /// Makes sure that an atom of a printed formula is listed.
    pub(super) fn add_atom(&mut self, e: Expr) {
        if is_atom(e) && !self.numbers.contains_key(&e) {
            self.add(e);
        }
    }

    fn add(&mut self, e: Expr) -> Option<(u16, Value)> {
        if self.atoms.len() >= MAX_ATOMS {
            return None;
        }
        let value = self.points.value(e)?;
        let number = self.atoms.len() as u16; // below MAX_ATOMS
        self.numbers.insert(e, number);
        self.atoms.push((e, value));
        self.offer(value, Entry::Product([number].into_iter().collect()));
        Some((number, value))
    }

    /// All products of as many factors as there is room for, the same factor twice included.
    fn list_products(&mut self) {
        let count = self.atoms.len();
        let mut last: Vec<(SmallVec<[u16; MAX_FACTORS]>, Value)> = vec![(SmallVec::new(), ONE)];
        let mut total = 0;
        for factors in 1..=MAX_FACTORS {
            // The number of multisets: the last one times (count + factors − 1)/factors.
            let next = last.len().saturating_mul(count + factors - 1) / factors;
            if total + next > MAX_PRODUCTS && factors > 2 || next > 4 * MAX_PRODUCTS {
                break;
            }
            total += next;
            let mut longer = Vec::with_capacity(next);
            for (product, value) in &last {
                for i in product.last().copied().unwrap_or(0)..count as u16 {
                    let mut product = product.clone();
                    product.push(i);
                    let value = field::product(value, &self.atoms[usize::from(i)].1);
                    longer.push((product, value));
                }
            }
            for (product, value) in &longer {
                self.offer(*value, Entry::Product(product.clone()));
            }
            last = longer;
        }
        for i in 0..count.min(200) {
            for j in i + 1..count.min(200) {
                let (a, b) = (self.atoms[i].1, self.atoms[j].1);
                self.offer(field::sum(&a, &b), Entry::Sum(i as u16, j as u16, false));
                self.offer(field::difference(&a, &b), Entry::Sum(i as u16, j as u16, true));
            }
        }
    }

    /// The parts of right formulas.
    fn list_phrases(&mut self, parts: &[Expr]) {
        let mut sizes: FxHashMap<Expr, u32> = FxHashMap::default();
        for &e in parts {
            let is_leaf = matches!(e.node(), Node::Symbol(_) | Node::Sin(_) | Node::Cos(_) | Node::Number(_));
            let below =
                e.children().fold(0_u32, |s, c| s.saturating_add(sizes.get(&c).copied().unwrap_or(1)));
            let size = if is_leaf { 1 } else { below.max(1) };
            sizes.insert(e, size);
            if size <= MAX_PHRASE
                && !is_leaf
                && let Some(value) = self.points.value(e)
            {
                self.offer(value, Entry::Phrase(e, size));
            }
        }
    }

    fn offer(&mut self, value: Value, entry: Entry) {
        let (value, _) = without_sign(value);
        match self.entries.get(&value) {
            Some(known) if known.size() <= entry.size() => {}
            _ => {
                self.entries.insert(value, entry);
            }
        }
    }

    /// The listed expression with this value or its opposite; true for the opposite.
    pub(super) fn lookup(&self, value: Value) -> Option<(&Entry, bool)> {
        let (key, is_opposite) = without_sign(value);
        let entry = self.entries.get(&key)?;
        let own = self.entry_sign(entry)?;
        Some((entry, own != is_opposite))
    }

    /// Whether the value of an entry is the opposite of its key.
    fn entry_sign(&self, entry: &Entry) -> Option<bool> {
        let value = match entry {
            Entry::Product(atoms) => {
                atoms.iter().fold(ONE, |v, &i| field::product(&v, &self.atoms[usize::from(i)].1))
            }
            Entry::Sum(i, j, is_minus) => {
                let (a, b) = (&self.atoms[usize::from(*i)].1, &self.atoms[usize::from(*j)].1);
                if *is_minus { field::difference(a, b) } else { field::sum(a, b) }
            }
            Entry::Phrase(e, _) => self.points.known_value(*e)?,
        };
        Some(without_sign(value).1)
    }

    /// The factors of an entry as they are printed.
    pub(super) fn factors(&self, entry: &Entry) -> Vec<Expr> {
        match entry {
            Entry::Product(atoms) => atoms.iter().map(|&i| self.atoms[usize::from(i)].0).collect(),
            Entry::Sum(..) | Entry::Phrase(..) => vec![self.expr(entry)],
        }
    }

    /// The expression of an entry.
    pub(super) fn expr(&self, entry: &Entry) -> Expr {
        let atom = |i: &u16| self.atoms[usize::from(*i)].0;
        match entry {
            Entry::Product(atoms) => atoms.iter().map(atom).fold(Expr::int(1), |a, b| a * b),
            Entry::Sum(i, j, false) => atom(i) + atom(j),
            Entry::Sum(i, j, true) => atom(i) - atom(j),
            Entry::Phrase(e, _) => *e,
        }
    }
}

/// Of a value and its opposite always the same one, and whether that is the opposite.
fn without_sign(value: Value) -> (Value, bool) {
    let opposite = field::opposite(&value);
    if opposite < value { (opposite, true) } else { (value, false) }
}

pub(super) fn is_atom(e: Expr) -> bool {
    matches!(e.node(), Node::Symbol(_) | Node::Sin(_) | Node::Cos(_))
}

/// How far one atom is from another in print: what changes is the function, or the index, or the name.
pub(super) fn distance(a: Expr, b: Expr) -> u32 {
    let parts = |e: Expr| match e.node() {
        Node::Sin(x) => Some((0, x)),
        Node::Cos(x) => Some((1, x)),
        _ => None,
    };
    match (parts(a), parts(b)) {
        _ if a == b => 0,
        (Some((f, x)), Some((g, y))) if f == g || x == y => {
            if x == y {
                10
            } else {
                10 + index_distance(x, y)
            }
        }
        (Some((_, x)), Some((_, y))) => 19 + index_distance(x, y),
        (None, None) => match (a.as_symbol(), b.as_symbol()) {
            (Some(x), Some(y)) if stem(&x.name()) == stem(&y.name()) => 12,
            (Some(_), Some(_)) => 24,
            _ => 30,
        },
        _ => 30,
    }
}

fn stem(name: &str) -> &str {
    name.trim_end_matches(|c: char| c.is_ascii_digit())
}

/// The angles that one sum has and the other has not.
fn index_distance(x: Expr, y: Expr) -> u32 {
    let (x, y) = (Angle::of(x), Angle::of(y));
    let only = |a: &Angle, b: &Angle| a.terms.iter().filter(|t| !b.terms.contains(t)).count() as u32;
    let other = u32::from(x.turns != y.turns || x.radians != y.radians);
    (only(&x, &y).max(only(&y, &x)) + other).max(1)
}

/// The atoms that occur in a formula; an angle inside of a sine is none.
pub(super) fn atoms_of(e: Expr) -> FxHashSet<Expr> {
    let mut seen = FxHashSet::default();
    let mut stack = vec![e];
    while let Some(e) = stack.pop() {
        if seen.insert(e) && !matches!(e.node(), Node::Sin(_) | Node::Cos(_)) {
            stack.extend(e.children());
        }
    }
    seen
}
