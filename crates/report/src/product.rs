//! Products as one writes them: `a·b·c`, not `a·(b·c)`.

use denavit_symbolic::{Expr, Node};

/// The product, its factors one after another.
pub fn times(a: Expr, b: Expr) -> Expr {
    match b.node() {
        Node::Mul(x, y) if x.as_number().is_none() => times(a, x) * y,
        Node::Neg(x) => -times(a, x),
        _ => a * b,
    }
}

#[cfg(test)]
mod tests {
    use super::times;
    use denavit_symbolic::Expr;

    #[test]
    fn factors_stand_one_after_another() {
        let [a, b, c] = ["a", "b", "c"].map(Expr::symbol);
        assert_eq!(times(a, b * c), a * b * c);
        assert_ne!(a * (b * c), a * b * c);
        assert_eq!(times(a, -(b * c)), -(a * b * c));
        assert_eq!(times(a, b + c), a * (b + c));
    }
}
