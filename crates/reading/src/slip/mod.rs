//! The slip in a printed formula: what was probably meant, in the author's own notation.
//!
//! The printed formula f and the right one g are compared at three random points modulo a prime (`field`, `points`), where
//! all is exact and nothing is expanded. In a tree of sums and products every part x has one value x* that makes the
//! whole right, if all else is as printed (`tree`): f = A·x + B asks for x* = (g − B)/A. A map from values to small
//! expressions (`lexicon`) then says what should stand there: x* itself (another symbol), x*/x (a lost factor), x* − x (a
//! lost term) (`lookups`); small changes of what is printed (`changes`) and other places of brackets (`brackets`) are
//! compared with it. `search` goes from one slip to two. What is found becomes text (`edit`, `style`, `write`), is read
//! again, compared again, and proved.
//!
//! Work is bounded by a count, never by time; a formula that is too large has no answer.

mod brackets;
mod changes;
mod edit;
mod field;
mod kind;
mod lexicon;
mod lookups;
mod points;
mod search;
mod style;
mod tree;
mod write;

pub use field::{K, Value};
pub use kind::Slip;
pub use lexicon::Lexicon;
pub use points::Points;

use denavit_symbolic::equality::equal;
use denavit_symbolic::expr::Expr;
use denavit_symbolic::parse::{Sign, Syntax, SyntaxKind, parse_syntax};
use denavit_symbolic::vocabulary::Vocabulary;
use edit::Editor;
use search::{Search, Work};
use std::ops::Range;
use tree::Tree;

/// No more repairs are returned.
const MAX_REPAIRS: usize = 8;
/// No more hits are printed and read again.
const MAX_READ: usize = 60;
/// No more texts between factors are tried.
const MAX_GAPS: usize = 4;
/// Repairs that cost this much more than the best are no rivals.
const MARGIN: u32 = 12;

/// What a formula should equal.
#[derive(Clone, Debug, PartialEq)]
pub enum Wanted {
    /// This formula.
    Formula(Expr),
    /// These values, at the points of the lexicon.
    Values(Value),
}

/// What to print at a place instead.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Patch {
    /// The place, in bytes of the text.
    pub span: Range<usize>,
    /// What should stand there.
    pub now: String,
}

/// A change of the text that makes the formula right.
#[derive(Clone, Debug, PartialEq)]
pub struct Repair {
    /// What the slip is.
    pub slip: Slip,
    /// The changes, in the order of the text.
    pub patches: Vec<Patch>,
    /// The text with the changes, which is read in the same vocabulary as `value`.
    pub formula: String,
    /// What the repaired text means.
    pub value: Expr,
    /// How much is changed: 10 for a sign.
    pub cost: u32,
}

/// How much work a search may take, in additions and multiplications or so.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort(pub u64);

impl Default for Effort {
    fn default() -> Self {
        Effort(3_000_000)
    }
}

/// The repairs of a printed formula that does not equal what is wanted, best first; rivals that are as plausible come
/// with it. Every one was read again and has the values wanted, and is proved equal where a formula is wanted.
/// None if the formula is right, if it has no value, or if nothing was found within the effort.
///
/// ```
/// use denavit_symbolic::parse::{parse, parse_syntax};
/// use denavit_reading::slip::{Effort, Lexicon, Slip, Wanted, repairs};
/// use denavit_symbolic::{Symbol, vocabulary::Vocabulary};
/// let names = Vocabulary::new().symbols(["a2", "a3"]).angle(1, Symbol::new("q1")).angle(2, Symbol::new("q2"));
/// let right = parse("a2*sin(q1) - a3*cos(q2)", &names).unwrap();
/// let mut lexicon = Lexicon::new(&[], &[right]).unwrap();
/// let text = "a2C1 − a3C2";
/// let printed = parse_syntax(text, &names).unwrap();
/// let found = repairs(text, &printed, &Wanted::Formula(right), &mut lexicon, &names, Effort::default());
/// assert_eq!((found[0].formula.as_str(), &found[0].slip), ("a2S1 − a3C2", &Slip::SineForCosine));
/// ```
pub fn repairs(
    text: &str,
    printed: &Syntax,
    wanted: &Wanted,
    lexicon: &mut Lexicon,
    vocabulary: &Vocabulary,
    effort: Effort,
) -> Vec<Repair> {
    let Some(tree) = Tree::of(printed, lexicon.points()) else { return vec![] };
    for (_, e) in tree.leaves() {
        lexicon.add_atom(e);
    }
    if let Wanted::Formula(right) = wanted {
        lexicon.add_formula(*right);
    }
    lexicon.learn_spellings(text, printed);
    let Some(search) = Search::new(text, (&tree, printed), lexicon, wanted) else { return vec![] };
    let target = *search.wanted();
    if tree.values(&[]).is_none_or(|v| v.first() == Some(&target)) {
        return vec![];
    }
    let hits = search.run(&mut Work(effort.0));
    let gaps = lexicon.style.factor_gaps(text.contains('\\'));
    let mut found: Vec<Repair> = vec![];
    let mut seen: Vec<(u64, usize)> = vec![]; // of each repair found: its shape, its disorder
    for hit in hits.iter().take(MAX_READ) {
        let limit = found.first().map_or(u32::MAX, |r| r.cost + MARGIN);
        if found.len() >= MAX_REPAIRS || hit.cost > limit {
            break;
        }
        let mut read = None;
        for gap in gaps.iter().take(MAX_GAPS) {
            let editor = Editor { text, tree: &tree, lexicon, vocabulary, gap: gap.clone() };
            let Some((patches, formula)) = editor.applied(&hit.edits) else { continue };
            let Ok(syntax) = parse_syntax(&formula, vocabulary) else { continue };
            if lexicon.value(syntax.value()) == Some(target) {
                read = Some((patches, formula, syntax));
                break;
            }
        }
        let Some((patches, formula, syntax)) = read else { continue };
        let (own, disorder) = (shape(&syntax), lexicon.style.disorder(&syntax));
        let known = seen.iter().position(|s| s.0 == own);
        // Of repairs that differ only in order the author's is taken.
        if known.is_some_and(|i| found[i].cost < hit.cost || seen[i].1 <= disorder) {
            continue;
        }
        let value = syntax.value();
        if let Wanted::Formula(right) = wanted
            && !equal(value, *right).is_equal()
        {
            continue;
        }
        let repair = Repair { slip: Slip::joined(&hit.slips), patches, formula, value, cost: hit.cost };
        match known {
            Some(i) => (found[i], seen[i].1) = (repair, disorder),
            None => {
                found.push(repair);
                seen.push((own, disorder));
            }
        }
    }
    found
}

/// A number that is the same for formulas that differ in the order of terms and factors, and in brackets.
fn shape(part: &Syntax) -> u64 {
    use field::mixed;
    use std::hash::BuildHasher;
    let of_expr = |e: Expr| mixed(rustc_hash::FxBuildHasher.hash_one(e));
    match &part.kind {
        SyntaxKind::Number(r) => of_expr(r.clone().into()),
        SyntaxKind::Name(e) => of_expr(*e),
        SyntaxKind::Sum(terms) => mixed(terms.iter().fold(1_u64, |s, (sign, t)| match sign {
            Sign::Plus | Sign::PlusMinus => s.wrapping_add(shape(t)),
            Sign::Minus | Sign::MinusPlus => s.wrapping_sub(shape(t)),
        })),
        SyntaxKind::Product(factors) => mixed(
            factors
                .iter()
                .fold(2_u64, |s, (is_under, f)| s.wrapping_add(mixed(shape(f) ^ u64::from(*is_under)))),
        ),
        SyntaxKind::Fraction(a, b) => mixed(shape(a).wrapping_sub(shape(b).rotate_left(1))),
        SyntaxKind::Power(a, n) => mixed(shape(a) ^ mixed(n.unsigned_abs().into())),
        SyntaxKind::Root(a) => mixed(shape(a) ^ 3),
        SyntaxKind::Call(..) => of_expr(part.value()),
        SyntaxKind::Bracket(inner) => shape(inner),
    }
}

/// The value that parts of a formula, the same for all of them, must have for the whole to be right; a name for a
/// definition, say. `is_part` picks the parts. `None` if there is no such value or more than one, and if the formula
/// is not linear in it.
pub fn needed(
    printed: &Syntax,
    is_part: impl Fn(&Syntax) -> bool,
    wanted: &Wanted,
    lexicon: &mut Lexicon,
) -> Option<Value> {
    let tree = Tree::of(printed, lexicon.points())?;
    let target = match wanted {
        Wanted::Values(v) => *v,
        Wanted::Formula(e) => lexicon.value(*e)?,
    };
    let mut stack = vec![printed];
    let mut picked: Vec<Range<usize>> = vec![];
    while let Some(part) = stack.pop() {
        match is_part(part) {
            true => picked.push(part.span.clone()),
            false => stack.extend(part.children()),
        }
    }
    let parts: Vec<usize> = (0..tree.parts.len()).filter(|&i| picked.contains(&tree.parts[i].span)).collect();
    let at = |x: u64| {
        let others: Vec<(usize, Value)> = parts.iter().map(|&p| (p, [field::whole(x); K])).collect();
        tree.values(&others)?.first().copied()
    };
    // f(x) = A·x + B
    let (b, one, two) = (at(0)?, at(1)?, at(2)?);
    let a = field::difference(&one, &b);
    if field::sum(&one, &a) != two {
        return None;
    }
    Some(field::product(&field::difference(&target, &b), &field::reciprocal(&a)?))
}
