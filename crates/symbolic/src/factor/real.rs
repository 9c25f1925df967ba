//! Real factors from factors over the Gaussian rationals.
//!
//! Conjugation turns i into −i and z into 1/z. A factor that is not its own conjugate is multiplied by it. One that is,
//! but has an odd degree in some z, belongs to half of an angle: z − 1 is sin φ/2. Such factors are taken in
//! groups whose degrees are even: (z − 1)(z + 1) is sin φ, (z + 1)² is 1 + cos φ.

use super::field::{Field, Gauss};
use super::sparse::{Exhausted, Exponents, Sparse, Work};

type Poly = Sparse<Gauss>;

/// Real factors, up to a constant, and how often each occurs; the first `symbols` variables are no angles.
pub(super) fn grouped(
    factors: &[Poly],
    symbols: usize,
    work: &mut Work,
) -> Result<Vec<(Poly, u32)>, Exhausted> {
    let mut counted = counted(factors);
    let mut real = vec![];
    let mut left = vec![];
    conjugates(&mut counted, symbols, &mut real, &mut left, work)?;
    let mut halves = vec![];
    for (f, n) in counted {
        match is_even(&f, symbols) {
            true => real.push((f, n)),
            false => halves.push((f, n)),
        }
    }
    sines(&mut halves, symbols, &mut real, work)?;
    for (f, n) in &mut halves {
        if *n >= 2 {
            real.push((f.times(f, work)?, *n / 2));
            *n %= 2;
        }
    }
    let mut single: Vec<Poly> = halves.into_iter().filter(|h| h.1 > 0).map(|h| h.0).collect();
    while let Some(group) = even_group(&single, symbols) {
        let chosen: Vec<Poly> = group.iter().rev().map(|&i| single.remove(i)).collect();
        real.push((product(&chosen, work)?, 1));
    }
    left.extend(single);
    if !left.is_empty() {
        real.push((product(&left, work)?, 1));
    }
    Ok(real.into_iter().map(|(f, n)| (made_real(f, symbols), n)).collect())
}

fn counted(factors: &[Poly]) -> Vec<(Poly, u32)> {
    let mut counted: Vec<(Poly, u32)> = vec![];
    for f in factors {
        match counted.iter_mut().find(|c| c.0 == *f) {
            Some(c) => c.1 += 1,
            None => counted.push((f.clone(), 1)),
        }
    }
    counted
}

fn product(factors: &[Poly], work: &mut Work) -> Result<Poly, Exhausted> {
    let one = Poly::constant(factors[0].variables(), Gauss::one());
    factors.iter().try_fold(one, |p, f| p.times(f, work))
}

/// Takes the pairs of conjugates out of `counted`. What should have a conjugate and has none goes to `left`.
fn conjugates(
    counted: &mut Vec<(Poly, u32)>,
    symbols: usize,
    real: &mut Vec<(Poly, u32)>,
    left: &mut Vec<Poly>,
    work: &mut Work,
) -> Result<(), Exhausted> {
    for i in 0..counted.len() {
        let mirror = conjugate(&counted[i].0, symbols);
        if mirror == counted[i].0 || counted[i].1 == 0 {
            continue;
        }
        if let Some(j) = counted.iter().position(|c| c.0 == mirror) {
            let n = counted[i].1.min(counted[j].1);
            real.push((counted[i].0.times(&mirror, work)?, n));
            counted[i].1 -= n;
            counted[j].1 -= n;
        }
        for _ in 0..counted[i].1 {
            left.push(counted[i].0.clone());
        }
        counted[i].1 = 0;
    }
    counted.retain(|c| c.1 > 0);
    Ok(())
}

/// The conjugate times the power of each z that makes it a polynomial, monic.
fn conjugate(p: &Poly, symbols: usize) -> Poly {
    let terms = p.terms().iter().map(|(e, k)| (mirrored(p, e, symbols), k.conjugate()));
    Poly::from_terms(p.variables(), terms).monic()
}

fn mirrored(p: &Poly, e: &Exponents, symbols: usize) -> Exponents {
    let flip = |(x, &n): (usize, &u16)| if x < symbols { n } else { p.degree(x) - n };
    e.iter().enumerate().map(flip).collect()
}

/// The angles in which the degree is odd, as bits.
fn parity(p: &Poly, symbols: usize) -> u64 {
    let odd = (symbols..p.variables()).filter(|&x| p.degree(x) % 2 == 1);
    odd.fold(0, |bits, x| bits | 1 << ((x - symbols) % 64))
}

fn is_even(p: &Poly, symbols: usize) -> bool {
    (symbols..p.variables()).all(|x| p.degree(x).is_multiple_of(2))
}

/// Joins w − ζ and w + ζ to the sine or cosine that they make up.
fn sines(
    halves: &mut [(Poly, u32)],
    symbols: usize,
    real: &mut Vec<(Poly, u32)>,
    work: &mut Work,
) -> Result<(), Exhausted> {
    for i in 0..halves.len() {
        let [first, second] = halves[i].0.terms() else { continue };
        let opposite = [first.clone(), (second.0.clone(), Gauss::zero().minus(&second.1))];
        let opposite = Poly::from_terms(halves[i].0.variables(), opposite);
        if let Some(j) = halves.iter().position(|h| h.0 == opposite) {
            let n = halves[i].1.min(halves[j].1);
            let whole = halves[i].0.times(&opposite, work)?;
            if n > 0 && is_even(&whole, symbols) {
                real.push((whole, n));
                halves[i].1 -= n;
                halves[j].1 -= n;
            }
        }
    }
    Ok(())
}

/// Halves beyond which not every group is tried.
const MAX_HALVES: usize = 14;

/// The smallest group of factors whose degrees add up to even ones.
fn even_group(single: &[Poly], symbols: usize) -> Option<Vec<usize>> {
    let odd: Vec<u64> = single.iter().map(|f| parity(f, symbols)).collect();
    let n = odd.len().min(MAX_HALVES);
    let members = |set: u32| (0..n).filter(move |i| set >> i & 1 == 1);
    let even = (1..1_u32 << n).filter(|&set| members(set).fold(0, |sum, i| sum ^ odd[i]) == 0);
    even.min_by_key(|set| (set.count_ones(), *set)).map(|set| members(set).collect())
}

/// The multiple that is real when its middle is moved to z⁰.
fn made_real(p: Poly, symbols: usize) -> Poly {
    let Some((e, k)) = p.terms().first() else { return p };
    let mirror = mirrored(&p, e, symbols);
    let Some((_, other)) = p.terms().iter().find(|t| t.0 == mirror) else { return p };
    // u·other must be the conjugate of u·k: u/ū = k̄/other = r, so u = 1 + r, or i if r = −1.
    let Some(inverse) = other.inverse() else { return p };
    let scale = k.conjugate().times(&inverse).plus(&Gauss::one());
    let scale = if scale.is_zero() { Gauss::i() } else { scale };
    p.scaled(&scale)
}
