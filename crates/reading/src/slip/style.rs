//! How an author prints: spellings of atoms, what stands between factors and terms, which factor comes first.

use denavit_symbolic::Angle;
use denavit_symbolic::expr::{Expr, Node};
use denavit_symbolic::parse::{Syntax, SyntaxKind, parse};
use denavit_symbolic::print;
use denavit_symbolic::vocabulary::Vocabulary;
use rustc_hash::FxHashMap;
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// No more spellings of other atoms than these are tried as patterns.
const MAX_PATTERNS: usize = 24;

/// The order of no more factors or terms is learned.
const LONGEST: usize = 20;

/// What was seen in print.
#[derive(Clone, Debug, Default)]
pub(super) struct Style {
    spellings: FxHashMap<Expr, String>,
    /// The spelled atoms in the order in which they were seen.
    order: Vec<Expr>,
    /// How often each text stands between two factors, and between two terms, with `+` for the sign.
    between_factors: BTreeMap<String, u32>,
    between_terms: BTreeMap<String, u32>,
    /// How often the one atom stands before the other in a product.
    before: FxHashMap<(Expr, Expr), u32>,
    /// How often a term that begins with the one atom stands before a term that begins with the other.
    terms_before: FxHashMap<(Expr, Expr), u32>,
    /// How often a symbol stands before a sine, and behind one.
    symbols_first: [u32; 2],
    minus: Option<char>,
    /// What was seen in the formula that is being mended, which goes before all others.
    own: Own,
}

#[derive(Clone, Debug, Default)]
struct Own {
    atoms: Vec<Expr>,
    between_factors: BTreeMap<String, u32>,
    between_terms: BTreeMap<String, u32>,
    minus: Option<char>,
}

/// True for the characters that are read as a minus.
pub(super) fn is_minus(c: char) -> bool {
    matches!(c, '-' | '−' | '‐' | '‑' | '–' | '—')
}

impl Style {
    pub fn spelled(&mut self, e: Expr, text: &str) {
        if self.spellings.insert(e, text.to_string()).is_none() {
            self.order.push(e);
        }
    }

    /// The character of a minus.
    pub fn minus(&self) -> char {
        self.own.minus.or(self.minus).unwrap_or('-')
    }

    pub fn learn(&mut self, text: &str, printed: &Syntax, is_right: bool) {
        let minus = text.chars().find(|&c| is_minus(c));
        self.minus = self.minus.or(minus);
        self.own = Own { minus, ..Own::default() };
        let between =
            |a: &Syntax, b: &Syntax| text.get(a.span.end..b.span.start).unwrap_or_default().to_string();
        let mut stack = vec![printed];
        while let Some(part) = stack.pop() {
            match &part.kind {
                SyntaxKind::Name(_) | SyntaxKind::Call(..) => {
                    let e = part.value();
                    let is_name = super::lexicon::is_atom(e) || matches!(part.kind, SyntaxKind::Name(_));
                    if let (true, Some(spelling)) = (is_name, text.get(part.span.clone())) {
                        self.spelled(e, spelling);
                        self.own.atoms.push(e);
                    }
                }
                SyntaxKind::Product(factors) => {
                    for pair in factors.windows(2) {
                        let are_names = pair.iter().all(|f| matches!(f.1.kind, SyntaxKind::Name(_)) && !f.0);
                        if are_names {
                            let gap = between(&pair[0].1, &pair[1].1);
                            *self.own.between_factors.entry(gap.clone()).or_default() += 1;
                            *self.between_factors.entry(gap).or_default() += 1;
                        }
                    }
                    let leaves: Vec<Expr> =
                        factors.iter().filter(|f| is_leaf(&f.1)).map(|f| f.1.value()).collect();
                    if is_right {
                        self.learn_order(&leaves);
                    }
                }
                SyntaxKind::Sum(terms) => {
                    let leads: Vec<Option<Expr>> =
                        terms.iter().take(if is_right { LONGEST } else { 0 }).map(|t| lead(&t.1)).collect();
                    for (i, a) in leads.iter().enumerate() {
                        for pair in leads[i + 1..].iter().filter_map(|b| a.zip(*b)) {
                            *self.terms_before.entry(pair).or_default() += 1;
                        }
                    }
                    for pair in terms.windows(2) {
                        let gap: String = between(&pair[0].1, &pair[1].1);
                        let gap: String = gap.chars().map(|c| if is_minus(c) { '+' } else { c }).collect();
                        if gap.matches('+').count() == 1 {
                            *self.own.between_terms.entry(gap.clone()).or_default() += 1;
                            *self.between_terms.entry(gap).or_default() += 1;
                        }
                    }
                }
                SyntaxKind::Number(_)
                | SyntaxKind::Fraction(..)
                | SyntaxKind::Power(..)
                | SyntaxKind::Root(_)
                | SyntaxKind::Bracket(_) => {}
            }
            if !matches!(part.kind, SyntaxKind::Call(..)) {
                stack.extend(part.children());
            }
        }
    }

    fn learn_order(&mut self, leaves: &[Expr]) {
        for (i, &a) in leaves.iter().enumerate().take(LONGEST) {
            for &b in leaves[i + 1..].iter().take(LONGEST) {
                *self.before.entry((a, b)).or_default() += 1;
                match (a.as_symbol(), is_sine(a), b.as_symbol(), is_sine(b)) {
                    (Some(_), _, _, true) => self.symbols_first[0] += 1,
                    (_, true, Some(_), _) => self.symbols_first[1] += 1,
                    _ => {}
                }
            }
        }
    }

    /// Which of two factors the author would print first.
    pub fn compare(&self, a: Expr, b: Expr) -> Ordering {
        let seen = |x, y| self.before.get(&(x, y)).copied().unwrap_or(0);
        let (ab, ba) = (seen(a, b), seen(b, a));
        if ab != ba {
            return ba.cmp(&ab);
        }
        let rank = |e: Expr| match e.node() {
            Node::Number(_) => 0,
            Node::Symbol(_) if self.symbols_first[0] >= self.symbols_first[1] => 1,
            Node::Sin(_) | Node::Cos(_) => 2,
            Node::Symbol(_) => 3,
            _ => 4,
        };
        let indices = |e: Expr| match e.node() {
            Node::Sin(x) | Node::Cos(x) => index(x, &Vocabulary::new()).unwrap_or_default(),
            _ => String::new(),
        };
        rank(a).cmp(&rank(b)).then_with(|| match (is_sine(a), is_sine(b)) {
            (true, true) => indices(a).cmp(&indices(b)),
            _ => Ordering::Equal,
        })
    }

    /// The place for a term among others, each given by the atom that it begins with. Where nothing is known, the last.
    pub fn place(&self, own: Option<Expr>, others: &[Option<Expr>]) -> usize {
        let seen = |a: Option<Expr>, b: Option<Expr>| {
            i64::from(a.zip(b).and_then(|pair| self.terms_before.get(&pair)).copied().unwrap_or(0).min(1000))
        };
        // How much speaks against the place.
        let wrong = |at: usize| {
            let before: i64 = others[..at].iter().map(|&o| seen(own, o) - seen(o, own)).sum();
            before + others[at..].iter().map(|&o| seen(o, own) - seen(own, o)).sum::<i64>()
        };
        (0..=others.len()).rev().min_by_key(|&at| wrong(at)).unwrap_or(0)
    }

    /// What stands between two factors, the most frequent first.
    pub fn factor_gaps(&self, is_latex: bool) -> Vec<String> {
        let seen = [&self.own.between_factors, &self.between_factors];
        let mut gaps: Vec<String> = seen.into_iter().filter_map(most_frequent).collect();
        let usual: &[&str] = if is_latex { &[" ", r" \cdot "] } else { &["*", "", " "] };
        gaps.extend(usual.iter().map(|g| (*g).to_string()));
        gaps
    }

    /// What stands between two terms, with the sign wanted.
    pub fn term_gap(&self, is_minus: bool) -> String {
        let seen = most_frequent(&self.own.between_terms).or_else(|| most_frequent(&self.between_terms));
        let gap = seen.unwrap_or_else(|| " + ".to_string());
        if is_minus { gap.replace('+', &self.minus().to_string()) } else { gap }
    }

    /// True if a spelling is known.
    pub fn knows(&self, e: Expr) -> bool {
        self.spellings.contains_key(&e)
    }

    /// How many neighbours in products stand in an order that is not the author's.
    pub fn disorder(&self, printed: &Syntax) -> usize {
        let own = match &printed.kind {
            SyntaxKind::Product(factors) => {
                let wrong = |pair: &&[(bool, Syntax)]| {
                    pair.iter().all(|f| is_leaf(&f.1))
                        && self.compare(pair[0].1.value(), pair[1].1.value()).is_gt()
                };
                factors.windows(2).filter(wrong).count()
            }
            _ => 0,
        };
        own + printed.children().into_iter().map(|c| self.disorder(c)).sum::<usize>()
    }

    /// The atom as the author prints it; an atom never seen after the pattern of one that is alike.
    pub fn spell(&self, e: Expr, vocabulary: &Vocabulary) -> String {
        let means = |text: &String| parse(text, vocabulary) == Ok(e);
        let after = |patterns: &[Expr], limit: u32| {
            let near = patterns.iter().map(|&k| (super::lexicon::distance(e, k), k));
            let mut near: Vec<(u32, Expr)> = near.filter(|p| p.0 < limit).collect();
            near.sort_by_key(|p| p.0);
            let tried = near.iter().take(MAX_PATTERNS);
            tried.flat_map(|(_, k)| self.after(e, *k, vocabulary)).find(means)
        };
        let own = if self.own.atoms.contains(&e) { None } else { after(&self.own.atoms, 20) };
        let known = || self.spellings.get(&e).filter(|t| means(t)).cloned();
        let printed = || print::print(e, vocabulary, print::Style::Ascii);
        own.or_else(known).or_else(|| after(&self.order, 30)).unwrap_or_else(printed)
    }

    /// Spellings of `e` after that of `known`.
    fn after(&self, e: Expr, known: Expr, vocabulary: &Vocabulary) -> Vec<String> {
        let Some(text) = self.spellings.get(&known) else { return vec![] };
        match (e.node(), known.node()) {
            (Node::Symbol(a), Node::Symbol(b)) => {
                let (a, b) = (a.name(), b.name());
                let digits =
                    |s: &str| s[s.trim_end_matches(|c: char| c.is_ascii_digit()).len()..].to_string();
                reindexed(text, &digits(&b), &digits(&a))
            }
            (Node::Sin(x) | Node::Cos(x), Node::Sin(y) | Node::Cos(y)) => {
                let is_same = matches!(e.node(), Node::Sin(_)) == matches!(known.node(), Node::Sin(_));
                let functions = if is_same { vec![text.clone()] } else { other_function(text) };
                if x == y {
                    return functions;
                }
                let (Some(new), Some(old)) = (index(x, vocabulary), index(y, vocabulary)) else {
                    return vec![];
                };
                functions.iter().flat_map(|t| reindexed(t, &old, &new)).collect()
            }
            _ => vec![],
        }
    }
}

fn is_leaf(part: &Syntax) -> bool {
    matches!(part.kind, SyntaxKind::Name(_) | SyntaxKind::Number(_) | SyntaxKind::Call(..))
}

/// The name that a part begins with.
fn lead(part: &Syntax) -> Option<Expr> {
    match &part.kind {
        SyntaxKind::Name(e) => Some(*e),
        SyntaxKind::Call(..) => Some(part.value()),
        _ => lead(part.children().first()?),
    }
}

fn is_sine(e: Expr) -> bool {
    matches!(e.node(), Node::Sin(_) | Node::Cos(_))
}

fn most_frequent(counts: &BTreeMap<String, u32>) -> Option<String> {
    counts.iter().max_by_key(|c| c.1).map(|c| c.0.clone())
}

/// The numbers of the angles in a sum, as an index: `23`.
fn index(angle: Expr, vocabulary: &Vocabulary) -> Option<String> {
    let angle = Angle::of(angle);
    if !angle.turns.is_zero() || !angle.radians.is_zero() || angle.is_constant() {
        return None;
    }
    let number = |(x, k): &(Expr, denavit_symbolic::Rational)| {
        let symbol = x.as_symbol().filter(|_| k.is_one())?;
        let name = symbol.name();
        let digits = &name[name.trim_end_matches(|c: char| c.is_ascii_digit()).len()..];
        vocabulary.number_of(symbol).or_else(|| digits.parse().ok())
    };
    let mut numbers = angle.terms.iter().map(number).collect::<Option<Vec<u32>>>()?;
    numbers.sort_unstable();
    let separator = if numbers.iter().all(|&n| n < 10) || numbers.len() == 1 { "" } else { "," };
    Some(numbers.iter().map(u32::to_string).collect::<Vec<_>>().join(separator))
}

/// The text with another index in place of the last `old`.
fn reindexed(text: &str, old: &str, new: &str) -> Vec<String> {
    let Some(at) = text.rfind(old).filter(|_| !old.is_empty() && !new.is_empty()) else { return vec![] };
    let (before, behind) = (&text[..at], &text[at + old.len()..]);
    let mut spellings = vec![];
    if before.trim_end().ends_with('_') && new.len() > 1 {
        spellings.push(format!("{before}{{{new}}}{behind}"));
    }
    spellings.push(format!("{before}{new}{behind}"));
    if let (Some(before), Some(behind), 1) = (before.strip_suffix('{'), behind.strip_prefix('}'), new.len()) {
        spellings.push(format!("{before}{new}{behind}"));
    }
    spellings
}

/// The text with the sine for the cosine, or the cosine for the sine.
pub(super) fn other_function(text: &str) -> Vec<String> {
    const PAIRS: [(&str, &str); 3] = [("cos", "sin"), ("C", "S"), ("c", "s")];
    for (a, b) in PAIRS {
        for (from, to) in [(a, b), (b, a)] {
            if let Some(at) = text.find(from) {
                return vec![format!("{}{to}{}", &text[..at], &text[at + from.len()..])];
            }
        }
    }
    vec![]
}
