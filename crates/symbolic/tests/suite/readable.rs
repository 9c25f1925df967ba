//! Formulas as short as a person writes them.

use denavit_symbolic::readable::simplify;
use denavit_symbolic::{Expr, equal};

fn cs(names: &[&str]) -> (Expr, Expr) {
    let sum = names.iter().fold(Expr::int(0), |s, n| s + Expr::symbol(n));
    (sum.cos(), sum.sin())
}

#[track_caller]
fn check(e: Expr, expected: Expr) {
    let shown = simplify(e, &[]).unwrap().expr;
    assert!(equal(shown, e).is_equal());
    assert_eq!(shown, expected, "{shown:?}, not {expected:?}");
}

#[test]
fn sums_merge_squares_vanish_and_common_factors_come_out() {
    let ((c2, s2), (c3, s3), (c23, s23)) = (cs(&["q2"]), cs(&["q3"]), cs(&["q2", "q3"]));
    let (a, b) = (Expr::symbol("a"), Expr::symbol("b"));
    check(c2 * c3 - s2 * s3, c23);
    check(s2 * c3 + c2 * s3, s23);
    check(c2 * c2 + s2 * s2, Expr::int(1));
    check(Expr::int(1) - c2 * c2, s2.powi(2));
    check(a * c2 + b * c2, c2 * (a + b));
    check(a * c2 * c3 - a * s2 * s3 + b * c2, b * c2 + a * c23);
    check((a * a - b * b) * c2 / (a - b), c2 * (a.powi(2) - b.powi(2)) / (a - b));
}
