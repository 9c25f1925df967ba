//! Intervals hold what they should, and roots are counted.

use denavit::random::Random;
use denavit_parallel::interval::Interval;
use denavit_parallel::roots::isolate;

#[test]
fn products_and_sums_hold_exact_values() {
    // Numbers with few bits: their products and sums in integers are exact.
    let mut random = Random(3);
    for _ in 0..2000 {
        let mut whole = || ((random.unit() - 0.5) * f64::from(1 << 20)) as i64;
        let (a, b) = (whole(), whole());
        let x = |n: i64| Interval::point(n as f64);
        let holds = |i: Interval, n: i64| i.lo <= n as f64 && n as f64 <= i.hi;
        assert!(holds(x(a) * x(b), a * b) && holds(x(a) + x(b), a + b) && holds(x(a) - x(b), a - b));
        assert!(holds(x(a).squared(), a * a));
    }
    // 1/3 lies between its neighbours.
    let third = Interval::around(1.0 / 3.0, 0.0);
    let one = third * Interval::point(3.0);
    assert!(one.lo < 1.0 && one.hi > 1.0);
    let square = Interval { lo: -2.0, hi: 1.0 }.squared();
    assert!(square.lo == 0.0 && square.hi >= 4.0);
}

#[test]
fn roots_are_counted() {
    let polynomial = |roots: &[f64]| {
        let mut c = vec![1.0];
        for r in roots {
            c.insert(0, 0.0);
            for k in 0..c.len() - 1 {
                c[k] -= r * c[k + 1];
            }
        }
        c.into_iter().map(Interval::point).collect::<Vec<_>>()
    };
    let all = [-1.5, -0.5, -0.25, 0.0, 0.5, 0.75];
    let found = isolate(&polynomial(&all), -1.0, 1.0);
    assert!(found.doubtful.is_empty());
    assert_eq!(found.isolated.len(), 5);
    for (x, r) in found.isolated.iter().zip(&all[1..]) {
        assert!(x.lo <= *r && *r <= x.hi && x.hi - x.lo < 1e-12, "{x:?} {r}");
    }
    // A double root is none that is sure.
    let found = isolate(&polynomial(&[0.25, 0.25, -0.5]), -1.0, 1.0);
    assert!(found.isolated.len() == 1 && !found.doubtful.is_empty());
    assert!(
        isolate(&[Interval::point(1.0), Interval::ZERO, Interval::point(1.0)], -1.0, 1.0).isolated.is_empty()
    );
    // What is 0 everywhere ends.
    assert!(!isolate(&[Interval::ZERO; 7], -1.0, 1.0).doubtful.is_empty());
}
