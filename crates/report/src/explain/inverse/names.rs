//! Names for what occurs again: X = C1px + S1py.

use super::reading::{Reading, Short, negated};
use denavit::inverse::derivation::{Kind, Norm};
use denavit_symbolic::Expr;
use denavit_symbolic::poly::Poly;
use std::cell::RefCell;

/// Polynomials that have names.
pub struct Names {
    /// Polynomial (its first term positive), name, when it is known.
    named: Vec<(Poly, Expr, usize)>,
    /// Which were used and not yet said.
    used: RefCell<Vec<usize>>,
    /// Which were said.
    said: RefCell<Vec<usize>>,
}

/// The polynomial or its negative, and whether it is the negative.
fn oriented(p: &Poly) -> (Poly, bool) {
    // More terms with plus than with minus; in doubt the first.
    let minus = p.terms().iter().filter(|t| t.1.is_negative()).count();
    let negative = 2 * minus > p.terms().len()
        || 2 * minus == p.terms().len() && p.terms().first().is_some_and(|t| t.1.is_negative());
    if negative { (negated(p), true) } else { (p.clone(), false) }
}

impl Names {
    /// Names for the parts that occur at least twice among the polynomials (with how often each is written).
    pub fn new(reading: &Reading, written: &[(Poly, usize)], taken: &mut dyn FnMut(&str) -> bool) -> Self {
        let mut counts: Vec<(Poly, usize)> = vec![];
        for (p, times) in written {
            reading.walk(p, &mut |part| {
                let (part, _) = oriented(part);
                match counts.iter_mut().find(|c| c.0 == part) {
                    Some(c) => {
                        c.1 += times;
                        false
                    }
                    None => {
                        counts.push((part, *times));
                        true
                    }
                }
            });
        }
        // What is long, or holds more than the pose.
        counts.retain(|c| {
            c.1 >= 2 && (reading.rank_of(&c.0) >= 2 || reading.rank_of(&c.0) == 1 && c.0.terms().len() > 2)
        });
        counts.sort_by_key(|c| (reading.rank_of(&c.0), c.0.terms().len()));
        let mut named: Vec<(Poly, Expr, usize)> = vec![];
        for (p, _) in counts {
            let kinds: Vec<Kind> = p.atoms().into_iter().map(|a| reading.chain.algebra.kind(a)).collect();
            let has = |f: &dyn Fn(&Kind) -> bool| kinds.iter().any(f);
            let position = has(&|k| matches!(k, Kind::Pose(n) if n % 4 == 3));
            let height = has(&|k| matches!(k, Kind::Pose(11))) && !has(&|k| matches!(k, Kind::Pose(3 | 7)));
            let rotation = has(&|k| matches!(k, Kind::Pose(n) if n % 4 != 3));
            let letters: &[&str] = match (position, rotation) {
                (true, _) if height => &["Z", "X", "Y", "W"],
                (true, _) => &["X", "Y", "W"],
                (false, true) => &["u", "v", "w"],
                (false, false) => &["k1", "k2"],
            };
            let base = letters[0].trim_end_matches(|c: char| c.is_ascii_digit());
            let numbered = (1..1000).map(|n| format!("{base}{n}"));
            let name = letters.iter().map(|l| (*l).to_string()).chain(numbered).find(|n| !taken(n));
            let name = name.unwrap_or_else(|| format!("part{}", named.len()));
            let rank = reading.rank_of(&p);
            named.push((p, Expr::symbol(&name), rank));
        }
        Names { named, used: RefCell::default(), said: RefCell::default() }
    }

    fn of(&self, p: &Poly, rank: usize) -> Option<Expr> {
        let (q, negative) = oriented(p);
        let k = self.named.iter().position(|n| n.0 == q && n.2 <= rank)?;
        self.used.borrow_mut().push(k);
        Some(if negative { -self.named[k].1 } else { self.named[k].1 })
    }

    /// The polynomial with the names of what is known at a rank.
    pub fn expr(&self, reading: &Reading, p: &Poly, rank: usize) -> Expr {
        let short: Short = &|p| self.of(p, rank);
        reading.expr(p, short)
    }

    /// As [`Names::expr`], for a sum with squares.
    pub fn norm(&self, reading: &Reading, n: &Norm, rank: usize) -> Expr {
        let short: Short = &|p| self.of(p, rank);
        reading.norm(n, short)
    }

    /// Names that were used since the last call and not said before, with their meanings, inner ones first.
    pub(crate) fn introduced(&self, reading: &Reading) -> Vec<(Expr, Expr)> {
        let mut found: Vec<(usize, Expr)> = vec![];
        loop {
            let pending: Vec<usize> = self.used.borrow_mut().drain(..).collect();
            let before = found.len();
            for k in pending {
                if self.said.borrow().contains(&k) {
                    continue;
                }
                self.said.borrow_mut().push(k);
                found.push((k, self.meaning(reading, k)));
            }
            if found.len() == before {
                break;
            }
        }
        found.sort_by_key(|f| f.0);
        found.into_iter().map(|(k, meaning)| (self.named[k].1, meaning)).collect()
    }

    fn meaning(&self, reading: &Reading, k: usize) -> Expr {
        let (p, _, rank) = &self.named[k];
        reading.expr(p, &|x| if x == p { None } else { self.of(x, *rank) })
    }

    /// All names with their meanings in full.
    pub fn meanings(&self, reading: &Reading) -> Vec<(Expr, Expr)> {
        self.named.iter().map(|(p, name, _)| (*name, reading.plain(p))).collect()
    }
}
