//! Derivatives against differences of double-double numbers, and against one another.

use crate::support::{program, random, steps};
use denavit_program::{Domain, Extended, Program};
use denavit_symbolic::{Expr, Rational};
use proptest::prelude::*;

/// Values in the order of the variables, then of the parameters.
fn eval(program: &Program, inputs: &[Extended]) -> Vec<Extended> {
    let names: Vec<_> = program.variables().iter().chain(program.parameters()).collect();
    program.eval(|s| names.iter().position(|n| **n == s).map(|i| inputs[i])).expect("all inputs are given")
}

fn extended(values: &[f64]) -> Vec<Extended> {
    values.iter().map(|x| Extended::from(*x)).collect()
}

fn differ(a: &Extended, b: &Extended) -> f64 {
    a.sub(b).to_f64().abs() / (1.0 + b.to_f64().abs())
}

/// `(8 (f(h) − f(−h)) − (f(2h) − f(−2h))) / 12h`, which is the derivative but for h⁴/30 of the fifth.
fn differences(program: &Program, inputs: &[Extended], variable: usize) -> Vec<Extended> {
    let h = (2.0_f64).powi(-20);
    let at = |step: f64| {
        let mut moved = inputs.to_vec();
        moved[variable] = moved[variable].add(&step.into());
        eval(program, &moved)
    };
    let [near, far] = [h, 2.0 * h].map(|h| {
        let (above, below) = (at(h), at(-h));
        above.iter().zip(&below).map(|(a, b)| a.sub(b)).collect::<Vec<_>>()
    });
    let quotient = |(n, f): (&Extended, &Extended)| n.mul(&8.0.into()).sub(f).div(&(12.0 * h).into());
    near.iter().zip(&far).map(quotient).collect()
}

/// The largest deviation of a Jacobian from differences, relative to 1 + |derivative|.
fn deviation(program: &Program, inputs: &[f64]) -> f64 {
    let inputs = extended(inputs);
    let jacobian = eval(&program.jacobian(), &inputs);
    let (rows, columns) = (program.outputs().len(), program.variables().len());
    assert_eq!(jacobian.len(), rows * columns);
    let mut worst = 0.0_f64;
    for variable in 0..columns {
        let expected = differences(program, &inputs, variable);
        for row in 0..rows {
            worst = worst.max(differ(&jacobian[row * columns + variable], &expected[row]));
        }
    }
    worst
}

#[test]
fn every_operation_has_its_derivative() {
    let [x, y, a] = ["x", "y", "a"].map(Expr::symbol);
    let half = Expr::from(Rational::new(1, 2));
    let rows: Vec<(&str, Expr)> = vec![
        ("number", half),
        ("pi", Expr::pi()),
        ("parameter", a),
        ("input", x),
        ("negative", -x),
        ("sum", x + y),
        ("difference", x - y),
        ("negative difference", -(x - y)),
        ("offset", x + a),
        ("product", x * y),
        ("square", x * x),
        ("product with a parameter", a * x),
        ("quotient", x / y),
        ("reciprocal", half / y),
        ("quotient by a parameter", y / a),
        ("parameter over variable", a / (x * y)),
        ("root", y.sqrt()),
        ("sign", (x - y).sign() * x * y),
        ("root of a negative", (-x).sqrt()),
        ("root of a sum", (x * x + y * y).sqrt()),
        ("sine", x.sin()),
        ("cosine", x.cos()),
        ("sine of a negative", (-(x * y)).sin()),
        ("arctangent", y.atan2(x)),
        ("arctangent, first sign", (-y).atan2(x)),
        ("arctangent, second sign", y.atan2(-x)),
        ("arctangent, both signs", (-y).atan2(-x)),
        ("arctangent of one value", x.atan2(x * y)),
        ("arctangent with a parameter", a.atan2(x)),
        ("a negative arctangent", -(x.atan2(a))),
        ("shared", (x * y).sin() * (x * y).cos() + (x * y)),
        ("composition", ((x * y + a).cos() / (y + a * a)).atan2((x * x + y).sqrt()) - (x.sin() * a).cos()),
    ];
    for (name, e) in rows {
        let found = deviation(&program(&["x", "y"], &["a"], &[("f", e)]), &[-0.7, 1.3, 0.4]);
        assert!(found < 1e-20, "{name}: {found:e}");
    }
}

#[test]
fn names_and_order_are_row_by_row_and_nothing_collides() {
    let [x, y, a, dx] = ["x", "y", "a", "dx"].map(Expr::symbol);
    let f = program(&["x", "y", "dx"], &["a"], &[("u", a * x * y + dx), ("v", y.sin()), ("d_u_y", x)]);
    let names = |p: &Program| p.outputs().iter().map(|o| o.0.clone()).collect::<Vec<_>>().join(" ");
    let inputs =
        |p: &Program| p.variables().iter().map(|s| s.name().to_string()).collect::<Vec<_>>().join(" ");
    let jacobian = "d_u_x d_u_y_2 d_u_dx d_v_x d_v_y d_v_dx d_d_u_y_x d_d_u_y_y d_d_u_y_dx";
    assert_eq!(names(&f.jacobian()), jacobian);
    assert_eq!(inputs(&f.jacobian()), "x y dx");
    assert_eq!(inputs(&f.tangent()), "x y dx dx_2 dy ddx");
    assert_eq!(names(&f.tangent()), "u v d_u_y du dv dd_u_y");
    assert_eq!(inputs(&f.adjoint()), "x y dx w_u w_v w_d_u_y");
    assert_eq!(names(&f.adjoint()), "d_x d_y d_dx");
    for p in [f.jacobian(), f.tangent(), f.adjoint()] {
        assert_eq!(p.parameters(), f.parameters());
    }
    // u = a·x·y + dx,   v = sin y at x = 2, y = 0, dx = 5, a = 3
    let values = eval(&f.jacobian(), &extended(&[2.0, 0.0, 5.0, 3.0]));
    let values: Vec<f64> = values.iter().map(Extended::to_f64).collect();
    assert_eq!(values, [0.0, 6.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0]);
}

#[test]
fn what_does_not_vary_costs_nothing() {
    let [x, a] = ["x", "a"].map(Expr::symbol);
    let f = program(&["x", "y"], &["a"], &[("f", a.sin() + a * a), ("g", x * a)]);
    assert_eq!(f.jacobian().count().cost(), 0);
    assert_eq!(eval(&f.jacobian(), &extended(&[1.0, 2.0, 3.0]))[2].to_f64(), 3.0);
    let nothing = program(&["x"], &[], &[]);
    assert_eq!(nothing.jacobian().outputs().len(), 0);
    assert_eq!(eval(&nothing.adjoint(), &extended(&[1.0]))[0].to_f64(), 0.0);
}

/// The gradient of one result costs a small multiple of the result, however many variables there are (Baur and
/// Strassen 1983: at most four times, each arithmetic operation counted once).
#[test]
fn a_gradient_is_cheap() {
    let names: Vec<String> = (0..40).map(|i| format!("q{i}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let q: Vec<Expr> = names.iter().map(|n| Expr::symbol(n)).collect();
    let product = q.iter().copied().reduce(|a, b| a * b + b).expect("not empty");
    let f = program(&names, &[], &[("f", product)]);
    let (own, gradient) = (f.count().cost(), f.jacobian().count().cost());
    assert!(gradient <= 4 * own, "{gradient} against {own}");
    // The other way round, one variable and many results: rates are cheaper.
    let x = Expr::symbol("x");
    let mut powers = vec![x];
    (0..20).for_each(|i| powers.push(powers[i] * x + powers[i]));
    let formulas: Vec<(&str, Expr)> = names.iter().copied().zip(powers).collect();
    let g = program(&["x"], &[], &formulas);
    assert!(g.jacobian().count().cost() <= 4 * g.count().cost());
}

/// Three variables, a chain of products and three results: rates run through the chain three times, weights likewise, and the
/// elimination of its vertices once.
#[test]
fn elimination_takes_a_narrow_place_once() {
    let [x, y, z, a] = ["x", "y", "z", "a"].map(Expr::symbol);
    let chain = (0..30).fold(x * y * z, |v, _| v * v + a);
    let f = program(&["x", "y", "z"], &["a"], &[("f", chain * x), ("g", chain * y), ("h", chain * z)]);
    let [plain, found] = [0, 1].map(|orders| f.jacobian_in_orders(f.variables(), orders));
    assert_eq!(plain.to_text(), f.jacobian().to_text());
    let [most, least] = [plain, found].map(|p| p.count().cost());
    assert!(least + 40 < most, "{least} against {most}");
}

proptest! {
    /// Elimination of vertices gives the same matrix, of some of the variables, too, and never a longer program.
    #[test]
    fn every_order_gives_the_jacobian(
        steps in steps(40),
        at in [-3.0..3.0_f64, -3.0..3.0, -3.0..3.0, -3.0..3.0],
    ) {
        let f = random(&steps, 3);
        for some in [f.variables(), &f.variables()[1..]] {
            let plain = f.jacobian_by(some);
            let found = f.jacobian_in_orders(some, 3);
            prop_assert_eq!(found.to_text(), f.jacobian_in_orders(some, 3).to_text());
            prop_assert!(found.count().cost() <= plain.count().cost());
            let names = |p: &Program| p.outputs().iter().map(|o| o.0.clone()).collect::<Vec<_>>();
            prop_assert_eq!(names(&found), names(&plain));
            let [found, plain] = [found, plain].map(|p| eval(&p, &extended(&at)));
            for (x, y) in found.iter().zip(&plain) {
                prop_assert!(differ(x, y) < 1e-24, "{:?} {:?}", x, y);
            }
        }
    }

    #[test]
    fn compositions(steps in steps(14), at in [-3.0..3.0_f64, -3.0..3.0, -3.0..3.0, -3.0..3.0]) {
        let found = deviation(&random(&steps, 3), &at);
        prop_assert!(found < 1e-18, "{:e}", found);
    }

    /// Forward equals reverse: J v, wᵀJ and J itself; and w·(J v) = (wᵀJ)·v.
    #[test]
    fn modes_agree(
        steps in steps(25),
        at in [-3.0..3.0_f64, -3.0..3.0, -3.0..3.0, -3.0..3.0],
        v in [-1.0..1.0_f64, -1.0..1.0, -1.0..1.0],
        w in [-1.0..1.0_f64, -1.0..1.0, -1.0..1.0],
    ) {
        let f = random(&steps, 3);
        let jacobian = eval(&f.jacobian(), &extended(&at));
        let results = eval(&f, &extended(&at));
        let [x, y, z, a] = at;
        let tangent = eval(&f.tangent(), &extended(&[x, y, z, v[0], v[1], v[2], a]));
        let adjoint = eval(&f.adjoint(), &extended(&[x, y, z, w[0], w[1], w[2], a]));
        let sum = |terms: [(Extended, f64); 3]| {
            terms.iter().fold(Extended::from(0.0), |s, (a, b)| s.add(&a.mul(&(*b).into())))
        };
        for i in 0..3 {
            prop_assert_eq!(tangent[i], results[i]);
            let rate = sum([0, 1, 2].map(|j| (jacobian[3 * i + j], v[j])));
            prop_assert!(differ(&tangent[3 + i], &rate) < 1e-26);
            let weighted = sum([0, 1, 2].map(|j| (jacobian[3 * j + i], w[j])));
            prop_assert!(differ(&adjoint[i], &weighted) < 1e-26);
        }
        let left = sum([0, 1, 2].map(|i| (tangent[3 + i], w[i])));
        let right = sum([0, 1, 2].map(|i| (adjoint[i], v[i])));
        prop_assert!(differ(&left, &right) < 1e-26);
    }

    #[test]
    fn second_derivatives_are_symmetric(
        steps in steps(12),
        at in [-3.0..3.0_f64, -3.0..3.0, -3.0..3.0, -3.0..3.0],
    ) {
        let gradient = random(&steps, 1).jacobian();
        let second = eval(&gradient.jacobian(), &extended(&at));
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            prop_assert!(differ(&second[3 * i + j], &second[3 * j + i]) < 1e-26);
        }
        let found = deviation(&gradient, &at);
        prop_assert!(found < 1e-17, "{:e}", found);
    }
}
