//! In what a printed formula may differ from the robot's and be right all the same: in the last digits of rounded numbers, in
//! joints that the text locks, and in the side from which the pose is seen.

use super::numbers::half_unit;
use super::subject::Subject;
use super::walk::Pair;
use denavit_reading::slip::Points;
use denavit_symbolic::parse::{Syntax, SyntaxKind};
use denavit_symbolic::{Expr, Symbol, equal};

/// A number of as many digits may be rounded: `0.866`.
const DIGITS: usize = 3;
/// The most numbers of a formula that may be.
const MAX_ROUNDED: usize = 40;
/// The deepest formula that is looked at.
const MAX_DEPTH: usize = 100;
/// At so many points formulas of rounded numbers are compared.
const POINTS: u32 = 12;
/// The most joints of which some may be locked.
const MAX_JOINTS: usize = 8;

/// True for a formula of rounded numbers that is right as far as their digits tell.
pub(super) fn is_rounded(text: &str, pair: &Pair, subject: &Subject) -> bool {
    let Some(printed) = pair.printed.as_ref().filter(|p| p.sign_choices() == 0) else { return false };
    let source = text.get(pair.span.clone()).unwrap_or_default();
    let mut halves = vec![];
    let Some(loose) = loosened(printed, source, &mut halves, 0) else { return false };
    if halves.is_empty() || halves.len() > MAX_ROUNDED {
        return false;
    }
    let mut compared = 0;
    for seed in 1..=POINTS {
        let symbols: Vec<Symbol> = loose.symbols().into_iter().chain(pair.wanted.symbols()).collect();
        let at = |s: Symbol| {
            let place = symbols.iter().position(|x| *x == s)? as u32;
            let random = 0.2 + f64::from((seed * 7919 + place * 104_729) % 1000) / 400.0;
            subject.description.value(s).or(Some(random))
        };
        let near = |k: Option<usize>| {
            let value = |s: Symbol| match halves.iter().position(|h| h.0 == s) {
                Some(i) => Some(if Some(i) == k { halves[i].1 } else { 0.0 }),
                None => at(s),
            };
            loose.eval(value).ok().filter(|x| x.is_finite())
        };
        let (Some(here), Ok(right)) = (near(None), pair.wanted.eval(at)) else { continue };
        let allowed: f64 = (0..halves.len()).filter_map(|k| Some((near(Some(k))? - here).abs())).sum();
        if (here - right).abs() > 1.02 * allowed + 1e-12 {
            return false;
        }
        compared += 1;
    }
    compared >= POINTS / 2
}

/// A formula in which each rounded number may be a little more or less; the numbers, with half a unit of their last digits.
fn loosened(syntax: &Syntax, source: &str, halves: &mut Vec<(Symbol, f64)>, depth: usize) -> Option<Expr> {
    if depth > MAX_DEPTH {
        return None;
    }
    let mut inner = |s: &Syntax| loosened(s, source, halves, depth + 1);
    Some(match &syntax.kind {
        SyntaxKind::Number(_) => {
            let shown = source.get(syntax.span.clone()).unwrap_or_default().trim();
            let digits = shown.trim_start_matches(['0', '.']).chars().filter(char::is_ascii_digit).count();
            if !shown.contains('.') || digits < DIGITS {
                return Some(syntax.value());
            }
            let more = Symbol::new(&format!("rounding {}", halves.len()));
            halves.push((more, half_unit(shown)));
            syntax.value() + Expr::from(more)
        }
        SyntaxKind::Name(_) => syntax.value(),
        SyntaxKind::Sum(terms) => {
            let mut sum = Expr::int(0);
            for (sign, term) in terms {
                let term = inner(term)?;
                sum = if sign.is_minus() { sum - term } else { sum + term };
            }
            sum
        }
        SyntaxKind::Product(factors) => {
            let mut product = Expr::int(1);
            for (is_over, factor) in factors {
                let factor = inner(factor)?;
                product = if *is_over { product / factor } else { product * factor };
            }
            product
        }
        SyntaxKind::Fraction(a, b) => {
            let a = inner(a)?;
            a / inner(b)?
        }
        SyntaxKind::Power(a, n) => inner(a)?.powi(*n),
        SyntaxKind::Root(a) => inner(a)?.sqrt(),
        SyntaxKind::Call(f, arguments) => {
            f.of(&arguments.iter().map(inner).collect::<Option<Vec<Expr>>>()?)
        }
        SyntaxKind::Bracket(a) => inner(a)?,
    })
}

/// Words for joints that do not move.
pub(super) const HELD: [&str; 9] =
    ["locked", "held", "at rest", "frozen", "gesperrt", "blockiert", "festgehalten", "bloqu", "bloccat"];

/// True for a rate of a joint that is right while other joints do not move, in a text that has some fixed.
pub(super) fn with_locked_joints(text: &str, pair: &Pair, subject: &Subject) -> bool {
    const FIXED: [&str; 6] = ["fixed", "ruht", "fixe", "fisso", "fijo", "fija"];
    let rates: Vec<Symbol> = subject.rates().iter().filter_map(|r| r.as_symbol()).collect();
    let own = pair.wanted.as_symbol().filter(|s| rates.contains(s));
    let (Some(own), true) = (own, rates.len() <= MAX_JOINTS) else { return false };
    let lower = text.to_lowercase();
    if !HELD.iter().chain(&FIXED).any(|w| lower.contains(w)) {
        return false;
    }
    let mut points = Points::new(41);
    (1_u32..1 << rates.len()).any(|locked| {
        let still = |e: Expr| {
            e.substitute(|s| {
                let k = rates.iter().position(|r| *r == s)?;
                (locked >> k & 1 == 1).then(|| Expr::int(0))
            })
        };
        let (value, wanted) = (still(pair.value), still(pair.wanted));
        wanted.as_symbol() == Some(own)
            && points.value(value).is_some_and(|v| points.value(wanted) == Some(v))
            && equal(value, wanted).is_equal()
    })
}

/// Coordinates of the base as the hand sees it, where they are called x, y, z: the last column of the inverse. An entry of a
/// matrix is no coordinate: of a lone slide the inverse differs by its sign alone.
pub(super) fn of_inverse(pair: &Pair, subject: &Subject) -> Option<Pair> {
    if pair.place.is_some() {
        return None;
    }
    let pose = subject.pose();
    let axis = pose.translation.0.iter().position(|e| *e == pair.wanted)?;
    let wanted = pose.inverse().translation.0[axis];
    let mut points = Points::new(43);
    let is_near = points.value(pair.value).is_some_and(|v| points.value(wanted) == Some(v));
    (is_near && pair.value != pair.wanted && equal(pair.value, wanted).is_equal())
        .then(|| Pair { wanted, ..pair.clone() })
}
