//! The sign of a determinant by which a step divides: a direction keeps it, whatever the values of parameters.

use super::algebra::Kind;
use super::candidates::rotation_like;
use super::chain::NormalChain;
use super::known::Samples;
use super::plan::Row;
use denavit_symbolic::poly::{Atom, Poly};

/// What the sign of a determinant is, wherever it does not vanish.
pub enum Sign {
    /// Always the same.
    Fixed {
        /// Whether it is negative.
        is_negative: bool,
    },
    /// That of a polynomial in parameters.
    Of {
        /// The polynomial.
        poly: Poly,
        /// Whether the determinant has the opposite sign.
        is_opposite: bool,
    },
}

/// The sign of a1·b2 − a2·b1, of rows whose determinant keeps it from pose to pose.
pub fn determinant_sign(chain: &NormalChain, r1: &Row, r2: &Row) -> Sign {
    let a = &chain.algebra;
    let d = a.times(&r1.a, &r2.b).minus(&a.times(&r2.a, &r1.b));
    // Rows (a, b) and ±λ(−b, a) have the determinant ±λ(a² + b²); λ is a quotient of the two factors.
    let factors = rotation_like(a, [&r1.a, &r1.b], [&r2.a, &r2.b]);
    let poly = factors.map_or_else(|| d.clone(), |(alpha, beta)| a.times(&alpha, &beta));
    // A value at which nothing is special decides: constants as they are, the rest drawn.
    let samples = Samples::new(chain, |_| None);
    let is_negative = |p: &Poly| samples.values(p)[0] < 0.0;
    if keeps_its_sign(chain, &poly) {
        Sign::Fixed { is_negative: is_negative(&d) }
    } else {
        Sign::Of { is_opposite: is_negative(&d) != is_negative(&poly), poly }
    }
}

/// True if no value of a parameter can change the sign of a polynomial: it holds none, or only even powers of them in terms
/// of one sign.
fn keeps_its_sign(chain: &NormalChain, p: &Poly) -> bool {
    let kind = |x: Atom| chain.algebra.kind(x);
    let is_parameter = |x: Atom| matches!(kind(x), Kind::Constant(e) if !e.symbols().is_empty());
    if !p.atoms().into_iter().any(is_parameter) {
        return true;
    }
    let signs: Option<Vec<bool>> = p
        .terms()
        .iter()
        .map(|(m, r)| {
            let mut value = r.to_f64();
            for &(x, n) in m.factors() {
                match kind(x) {
                    _ if is_parameter(x) && n % 2 == 0 => {}
                    Kind::Constant(e) if !is_parameter(x) => {
                        value *= e.eval(|_| None).ok()?.powi(i32::from(n))
                    }
                    _ => return None,
                }
            }
            Some(value < 0.0)
        })
        .collect();
    signs.is_some_and(|all| all.windows(2).all(|pair| pair[0] == pair[1]))
}
