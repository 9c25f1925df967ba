//! A study of slips made at random, one and two in a formula: how many are mended, and how many to the letter.

use super::subjects::{Subject, prrrrp, rx90, ur3, wrist};
use denavit_reading::slip::{Effort, Wanted, repairs};
use denavit_symbolic::parse::{Syntax, SyntaxKind, parse_syntax};
use denavit_symbolic::readable::settled;
use denavit_symbolic::{Expr, Node, equal};

/// Numbers at random, the same ones every time.
struct Draw(u64);

impl Draw {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % n
    }

    fn of<'a, T>(&mut self, from: &'a [T]) -> Option<&'a T> {
        (!from.is_empty()).then(|| &from[self.below(from.len())])
    }
}

fn parts(syntax: &Syntax) -> Vec<&Syntax> {
    let mut all = vec![syntax];
    let mut next = 0;
    while next < all.len() {
        all.extend(all[next].children());
        next += 1;
    }
    all
}

fn spliced(text: &str, from: usize, to: usize, now: &str) -> String {
    format!("{}{now}{}", &text[..from], &text[to..])
}

/// Atoms as the subject prints them.
fn atoms(subject: &Subject) -> Vec<(Expr, String)> {
    let mut atoms: Vec<(Expr, String)> = vec![];
    for text in &subject.right {
        let syntax = subject.read(text);
        for part in parts(&syntax).into_iter().filter(|p| matches!(p.kind, SyntaxKind::Name(_))) {
            let e = part.value();
            if matches!(e.node(), Node::Sin(_) | Node::Cos(_) | Node::Symbol(_))
                && !atoms.iter().any(|a| a.0 == e)
            {
                atoms.push((e, text[part.span.clone()].to_string()));
            }
        }
    }
    atoms
}

const KINDS: [&str; 8] =
    ["sign", "sine/cosine", "lost factor", "extra factor", "index", "bracket", "lost term", "extra term"];

/// The text with one slip of a kind, made without the code under test.
fn slip(kind: usize, text: &str, subject: &Subject, draw: &mut Draw) -> Option<String> {
    let syntax = subject.read(text);
    let all = parts(&syntax);
    let atoms = atoms(subject);
    let sums: Vec<_> = all
        .iter()
        .filter_map(|p| match &p.kind {
            SyntaxKind::Sum(terms) if terms.len() > 1 => Some((p.span.clone(), terms)),
            _ => None,
        })
        .collect();
    let products: Vec<_> = all
        .iter()
        .filter_map(|p| match &p.kind {
            SyntaxKind::Product(factors) => Some(factors),
            _ => None,
        })
        .collect();
    let names: Vec<_> = all.iter().filter(|p| matches!(p.kind, SyntaxKind::Name(_))).collect();
    match kind {
        0 => {
            let signs: Vec<usize> = text.match_indices(['+', '-']).map(|m| m.0).collect();
            let at = *draw.of(&signs)?;
            let now = if &text[at..=at] == "+" { "-" } else { "+" };
            let is_leading = at == 0 || text[..at].trim_end().ends_with('(');
            Some(spliced(text, at, at + 1, if is_leading { "" } else { now }))
        }
        1 | 4 => {
            let name = draw.of(&names)?;
            let e = name.value();
            let is_other = |a: &&(Expr, String)| match (e.node(), a.0.node()) {
                (Node::Sin(x), Node::Cos(y)) | (Node::Cos(x), Node::Sin(y)) => kind == 1 && x == y,
                (Node::Sin(x), Node::Sin(y)) | (Node::Cos(x), Node::Cos(y)) => kind == 4 && x != y,
                (Node::Symbol(a), Node::Symbol(b)) => kind == 4 && a != b && a.name()[..1] == b.name()[..1],
                _ => false,
            };
            let others: Vec<_> = atoms.iter().filter(is_other).collect();
            Some(spliced(text, name.span.start, name.span.end, &draw.of(&others)?.1))
        }
        2 => {
            let factors = draw.of(&products)?;
            let i = draw.below(factors.len());
            let span = match i {
                0 => factors[0].1.span.start..factors[1].1.span.start,
                _ => factors[i - 1].1.span.end..factors[i].1.span.end,
            };
            Some(spliced(text, span.start, span.end, ""))
        }
        3 => {
            let factors = draw.of(&products)?;
            let i = 1 + draw.below(factors.len() - 1);
            let gap = &text[factors[i - 1].1.span.end..factors[i].1.span.start];
            let at = factors[i].1.span.start;
            Some(spliced(text, at, at, &format!("{}{gap}", draw.of(&atoms)?.1)))
        }
        5 => {
            let closing: Vec<usize> = text.match_indices(')').map(|m| m.0).collect();
            let at = *draw.of(&closing)?;
            let without = spliced(text, at, at + 1, "");
            let ends: Vec<usize> = names.iter().map(|n| n.span.end).filter(|&e| e != at).collect();
            let to = *draw.of(&ends)?;
            let to = if to > at { to - 1 } else { to };
            Some(spliced(&without, to, to, ")"))
        }
        6 => {
            let (span, terms) = draw.of(&sums)?;
            let i = draw.below(terms.len());
            Some(match i {
                0 => {
                    let next = &text[terms[0].1.span.end..terms[1].1.span.start];
                    let sign = if next.contains('-') { "-" } else { "" };
                    spliced(text, span.start, terms[1].1.span.start, sign)
                }
                _ => spliced(text, terms[i - 1].1.span.end, terms[i].1.span.end, ""),
            })
        }
        _ => {
            // A term of another formula, drawn over from the next cell.
            let other = subject.right[draw.below(subject.right.len())];
            let other_syntax = subject.read(other);
            let terms: Vec<_> = parts(&other_syntax)
                .into_iter()
                .filter(|p| {
                    matches!(p.kind, SyntaxKind::Product(_) | SyntaxKind::Name(_)) && p.span.len() < 30
                })
                .collect();
            let term = &other[draw.of(&terms)?.span.clone()];
            let (at, sign) = match draw.of(&sums) {
                Some((span, _)) => (span.end, [" + ", " - "][draw.below(2)]),
                None => (text.len(), " + "),
            };
            Some(spliced(text, at, at, &format!("{sign}{term}")))
        }
    }
}

/// The text as a row of marks, without blanks.
fn marks(text: &str) -> String {
    text.chars().filter(|c| !c.is_whitespace() && !matches!(c, '{' | '}' | '_')).collect()
}

/// A study of slips made at random: how many are detected, mended, and mended to the letter.
#[test]
fn slips_made_at_random_are_mended() {
    let subjects = [rx90(), prrrrp(), ur3(), wrist()];
    let mut draw = Draw(7);
    let (mut counts, mut time, mut slowest) = ([[0_usize; 4]; 8], 0.0_f64, 0.0_f64);
    for subject in &subjects {
        for &text in &subject.right {
            // The model gives its own form of the formula, and the author's other formulas are known.
            let right = settled(subject.read(text).value());
            let mut lexicon = subject.lexicon_without(text, &[right]);
            for kind in 0..8 {
                for _ in 0..4 {
                    let Some(printed) = slip(kind, text, subject, &mut draw) else { continue };
                    let Ok(syntax) = parse_syntax(&printed, &subject.names) else { continue };
                    let is_changed = equal(syntax.value(), right).is_equal();
                    assert_eq!(
                        lexicon.value(syntax.value()) == lexicon.value(right),
                        is_changed,
                        "{printed}"
                    );
                    if is_changed {
                        continue;
                    }
                    let before = std::time::Instant::now();
                    let wanted = Wanted::Formula(right);
                    let found =
                        repairs(&printed, &syntax, &wanted, &mut lexicon, &subject.names, Effort::default());
                    let took = before.elapsed().as_secs_f64() * 1e3;
                    time += took;
                    slowest = slowest.max(took);
                    counts[kind][0] += 1;
                    let first = found.first();
                    counts[kind][1] += usize::from(first.is_some());
                    counts[kind][2] += usize::from(first.is_some_and(|r| marks(&r.formula) == marks(text)));
                    counts[kind][3] += usize::from(found.iter().any(|r| marks(&r.formula) == marks(text)));
                    if std::env::var_os("SLIP_STUDY").is_some()
                        && first.is_none_or(|r| marks(&r.formula) != marks(text))
                    {
                        println!("{}\n  right   {text}\n  printed {printed}", KINDS[kind]);
                        for r in found.iter().take(3) {
                            println!("  {:3}     {}  {:?}", r.cost, r.formula, r.slip);
                        }
                    }
                }
            }
        }
    }
    let sum = |i: usize| counts.iter().map(|c| c[i]).sum::<usize>();
    for (kind, c) in KINDS.iter().zip(counts) {
        println!(
            "{kind:14} {:4} slips, {:4} mended, {:4} to the letter, {:4} among the rivals",
            c[0], c[1], c[2], c[3]
        );
    }
    println!(
        "all {} mended {} to the letter {} ({}); {:.2} ms each, {slowest:.0} at most",
        sum(0),
        sum(1),
        sum(2),
        sum(3),
        time / sum(0) as f64
    );
    assert!(sum(0) > 600);
    assert!(sum(1) * 100 >= sum(0) * 97, "{} of {} mended", sum(1), sum(0));
    assert!(sum(2) * 100 >= sum(0) * 85, "{} of {} to the letter", sum(2), sum(0));
}

/// Two slips at random in one formula.
#[test]
fn two_slips_are_mended() {
    let subjects = [rx90(), prrrrp(), ur3(), wrist()];
    let mut draw = Draw(11);
    let (mut count, mut mended, mut first, mut rivals, mut time, mut slowest) =
        (0, 0, 0, 0, 0.0_f64, 0.0_f64);
    for subject in &subjects {
        for &text in &subject.right {
            let right = settled(subject.read(text).value());
            let mut lexicon = subject.lexicon_without(text, &[right]);
            for _ in 0..12 {
                // Signs, sines and indices; and one of another kind.
                let kinds = [[0, 1, 4][draw.below(3)], draw.below(8)];
                let Some(once) = slip(kinds[0], text, subject, &mut draw) else { continue };
                if parse_syntax(&once, &subject.names).is_err() {
                    continue;
                }
                let Some(printed) = slip(kinds[1], &once, subject, &mut draw) else { continue };
                let Ok(syntax) = parse_syntax(&printed, &subject.names) else { continue };
                if equal(syntax.value(), right).is_equal() {
                    continue;
                }
                let before = std::time::Instant::now();
                let wanted = Wanted::Formula(right);
                let found =
                    repairs(&printed, &syntax, &wanted, &mut lexicon, &subject.names, Effort::default());
                let took = before.elapsed().as_secs_f64() * 1e3;
                time += took;
                slowest = slowest.max(took);
                count += 1;
                mended += usize::from(!found.is_empty());
                first += usize::from(found.first().is_some_and(|r| marks(&r.formula) == marks(text)));
                rivals += usize::from(found.iter().any(|r| marks(&r.formula) == marks(text)));
                if std::env::var_os("SLIP_STUDY").is_some() && found.is_empty() {
                    println!("unmended {kinds:?}\n  right   {text}\n  printed {printed}");
                }
            }
        }
    }
    println!(
        "{count} pairs, {mended} mended, {first} to the letter ({rivals}); {:.2} ms each, {slowest:.0} at most",
        time / f64::from(count)
    );
    assert!(mended * 100 >= count as usize * 97, "{mended} of {count}");
}

/// A formula in the place of another: the search ends, and what it finds is proved.
#[test]
fn another_formula_is_no_slip() {
    let (mut count, mut found_any, mut slowest, mut building) = (0, 0, 0.0_f64, 0.0_f64);
    for subject in [rx90(), prrrrp(), ur3(), wrist()] {
        let before = std::time::Instant::now();
        let mut lexicon = subject.lexicon_without("", &[]);
        building = building.max(before.elapsed().as_secs_f64() * 1e3);
        for &printed in &subject.right {
            let syntax = subject.read(printed);
            for right in subject.right.iter().map(|t| subject.read(t).value()) {
                let before = std::time::Instant::now();
                let wanted = Wanted::Formula(right);
                let found =
                    repairs(printed, &syntax, &wanted, &mut lexicon, &subject.names, Effort::default());
                slowest = slowest.max(before.elapsed().as_secs_f64() * 1e3);
                assert!(found.iter().all(|r| equal(r.value, right).is_equal()));
                count += 1;
                found_any += usize::from(!found.is_empty());
            }
        }
    }
    println!(
        "{count} pairs, {found_any} with a way from one to the other; {slowest:.0} ms at most, lexicon {building:.0} ms"
    );
}
