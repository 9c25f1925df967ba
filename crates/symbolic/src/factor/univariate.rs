//! Polynomials in one variable modulo the prime: Euclid, and factors by Cantor and Zassenhaus (1981).

use super::field::{Field, Residue};

/// Coefficients from the lowest power, the last not 0.
pub(super) type Line = Vec<Residue>;

/// The polynomial without zeros at its end.
pub(super) fn trimmed(mut a: Line) -> Line {
    while a.last().is_some_and(Field::is_zero) {
        a.pop();
    }
    a
}

/// The product.
pub(super) fn times(a: &[Residue], b: &[Residue]) -> Line {
    if a.is_empty() || b.is_empty() {
        return vec![];
    }
    let mut out = vec![Residue::zero(); a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            out[i + j] = out[i + j].plus(&x.times(y));
        }
    }
    out
}

/// The difference.
pub(super) fn minus(a: &[Residue], b: &[Residue]) -> Line {
    let at = |v: &[Residue], i: usize| v.get(i).copied().unwrap_or_else(Residue::zero);
    trimmed((0..a.len().max(b.len())).map(|i| at(a, i).minus(&at(b, i))).collect())
}

/// The multiple with leading coefficient 1.
pub(super) fn monic(a: Line) -> Line {
    match a.last().and_then(Field::inverse) {
        Some(k) => a.iter().map(|c| c.times(&k)).collect(),
        None => a,
    }
}

/// Quotient and remainder; by 0, nothing and everything.
pub(super) fn divided(a: &[Residue], b: &[Residue]) -> (Line, Line) {
    let mut rest = a.to_vec();
    let Some(inverse) = b.last().and_then(Field::inverse) else { return (vec![], rest) };
    let mut quotient = vec![Residue::zero(); (a.len() + 1).saturating_sub(b.len())];
    for at in (0..quotient.len()).rev() {
        let k = rest[at + b.len() - 1].times(&inverse);
        for (j, c) in b.iter().enumerate() {
            rest[at + j] = rest[at + j].minus(&c.times(&k));
        }
        quotient[at] = k;
    }
    rest.truncate(b.len() - 1);
    (trimmed(quotient), trimmed(rest))
}

/// The greatest common divisor, monic.
pub(super) fn gcd(a: &[Residue], b: &[Residue]) -> Line {
    let (mut a, mut b) = (a.to_vec(), b.to_vec());
    while !b.is_empty() {
        let rest = divided(&a, &b).1;
        (a, b) = (b, rest);
    }
    monic(a)
}

/// `t` with `t·b = 1` modulo `a`, for coprime polynomials.
pub(super) fn inverse_modulo(b: &[Residue], a: &[Residue]) -> Option<Line> {
    let (mut r0, mut r1) = (a.to_vec(), divided(b, a).1);
    let (mut t0, mut t1) = (vec![], vec![Residue::one()]);
    while r1.len() > 1 {
        let (q, rest) = divided(&r0, &r1);
        (r0, r1) = (r1, rest);
        let t = minus(&t0, &times(&q, &t1));
        (t0, t1) = (t1, t);
    }
    let k = r1.first()?.inverse()?;
    Some(divided(&times(&t1, &[k]), a).1)
}

/// The derivative.
fn derivative(a: &[Residue]) -> Line {
    trimmed((1..a.len()).map(|i| a[i].times(&Residue::int(i as i64))).collect())
}

/// True if no factor occurs twice.
pub(super) fn is_squarefree(a: &[Residue]) -> bool {
    gcd(a, &derivative(a)).len() == 1
}

fn square(a: &[Residue], modulus: &[Residue]) -> Line {
    divided(&times(a, a), modulus).1
}

/// `a^(2ⁿ − 1)`
fn power_of_ones(a: &Line, n: u32, modulus: &[Residue]) -> Line {
    (1..n).fold(a.clone(), |x, _| divided(&times(&square(&x, modulus), a), modulus).1)
}

/// `a^(P²)`, with P = 2¹²⁷ − 1.
fn frobenius(a: &Line, modulus: &[Residue]) -> Line {
    power_of_ones(&power_of_ones(a, 127, modulus), 127, modulus)
}

/// The irreducible factors, monic, of a squarefree polynomial.
pub(super) fn factors(a: &[Residue], state: &mut u64) -> Vec<Line> {
    let mut rest = monic(a.to_vec());
    let mut found = vec![];
    let x = vec![Residue::zero(), Residue::one()];
    let mut power = divided(&x, &rest).1;
    let mut degree = 0;
    while rest.len() > 1 {
        degree += 1;
        if rest.len() - 1 < 2 * degree {
            found.push(rest);
            break;
        }
        power = frobenius(&power, &rest);
        let of_degree = gcd(&rest, &minus(&power, &x));
        if of_degree.len() > 1 {
            rest = divided(&rest, &of_degree).0;
            power = divided(&power, &rest).1;
            split_equal(of_degree, degree, state, &mut found);
        }
    }
    found
}

/// Splits a product of irreducible polynomials of one degree.
fn split_equal(a: Line, degree: usize, state: &mut u64, found: &mut Vec<Line>) {
    let mut pending = vec![a];
    while let Some(a) = pending.pop() {
        if a.len() - 1 <= degree {
            found.push(a);
            continue;
        }
        let random: Line = trimmed((1..a.len()).map(|_| Residue::random(state)).collect());
        // r^((q^d − 1)/2) is ±1 modulo each factor; q = P², (q − 1)/2 = (2¹²⁶ − 1)·2¹²⁷.
        let (mut conjugate, mut norm) = (random.clone(), random);
        for _ in 1..degree {
            conjugate = frobenius(&conjugate, &a);
            norm = divided(&times(&norm, &conjugate), &a).1;
        }
        let half = (0..127).fold(power_of_ones(&norm, 126, &a), |x, _| square(&x, &a));
        let part = gcd(&a, &minus(&half, &[Residue::one()]));
        if part.len() > 1 && part.len() < a.len() {
            pending.push(divided(&a, &part).0);
            pending.push(part);
        } else {
            pending.push(a);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_product_splits_into_its_factors() {
        let line = |v: &[i64]| v.iter().map(|&n| Residue::int(n)).collect::<Line>();
        // x² − 2 has roots modulo 2¹²⁷ − 1; x² + 1 = (x − i)(x + i)
        let p = times(&times(&line(&[-1, 1]), &line(&[5, 1])), &line(&[1, 0, 1]));
        let parts = factors(&p, &mut 7);
        assert_eq!(parts.len(), 4);
        assert_eq!(parts.iter().fold(line(&[1]), |x, f| times(&x, f)), p);
        assert!(is_squarefree(&p) && !is_squarefree(&times(&p, &line(&[-1, 1]))));
        let t = inverse_modulo(&line(&[3, 1]), &p).unwrap();
        assert_eq!(divided(&times(&t, &line(&[3, 1])), &p).1, line(&[1]));
    }
}
