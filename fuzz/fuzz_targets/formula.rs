//! Any text as a formula: read, simplified, printed; what is printed reads back as an equal formula.

#![no_main]

use denavit_symbolic::parse::{parse, parse_angle, parse_definition};
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Ring, Symbol, Equality, equal, readable};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let mut closed =
        Vocabulary::new().symbols(["a2", "d4", "D3", "RL4", "S", "c"]).sliding(4, Symbol::new("q4"));
    for n in 1..=3 {
        closed = closed.angle(n, Symbol::new(&format!("q{n}")));
    }
    let degrees = Vocabulary::new().open(true).degrees(true);
    for names in [Vocabulary::new().open(true), closed, degrees] {
        let _ = parse_angle(text, &names);
        let _ = parse_definition(text, &names);
        let Ok(formula) = parse(text, &names) else { continue };
        check(formula, &names, text.len() <= SHORT);
    }
});

/// Bytes up to which the search for the shortest angle sums is run as well; instrumented, it takes seconds on a formula
/// in six angles.
const SHORT: usize = 32;

fn check(formula: Expr, names: &Vocabulary, is_short: bool) {
    for style in [Style::Latex, Style::Typst, Style::MathMl, Style::Unicode] {
        print(formula, names, style);
    }
    let printed = print(formula, names, Style::Ascii);
    if let Ok(again) = parse(&printed, names) {
        assert!(!matches!(equal(again, formula), Equality::Different { .. }), "{printed}");
    }
    let simple = if is_short {
        readable::simplify(formula, &[])
    } else {
        readable::simplify_in(&mut Ring::new(&[formula], &[]), formula)
    };
    if let Ok(simple) = simple {
        print(simple.expr, names, Style::Unicode);
    }
}
