//! The text form: round trips, errors with places, and texts that nobody should write.

use crate::support::{program, random, steps};
use denavit_program::{Program, Stage};
use denavit_symbolic::Expr;
use proptest::prelude::*;
use proptest::sample::Index;

const SAMPLE: &str = "\
variables q1 \"q 2\"
parameters a
%0 = input q1
%1 = cos %0
%2 = input a
%m1 = mul %1 %2
%4 = number 3/2
%5 = add %m1 %4
%6 = input \"q 2\"
%\"7\" = atan2 -%6 %5
%8 = pi
%9 = sub %\"7\" %8
%10 = div %9 %8
%11 = sqrt -%10
%12 = sin %11
result x = %12
result \"y, \\\"raised\\\" \\u{7}#\" = -%m1
";

#[track_caller]
fn read(text: &str) -> Program {
    Program::from_text(text).unwrap_or_else(|errors| panic!("{errors:?}\n{text}"))
}

fn errors(text: &str) -> Vec<String> {
    match Program::from_text(text) {
        Ok(_) => vec![],
        Err(errors) => errors.iter().map(ToString::to_string).collect(),
    }
}

#[test]
fn a_text_reads_back_as_it_stands() {
    let program = read(SAMPLE);
    assert_eq!(program.to_text(), SAMPLE);
    assert_eq!(program.name(3), Some("m1"));
    assert_eq!(program.ops()[3].1, Stage::Variable);
    assert_eq!(program.ops()[2].1, Stage::Parameter);
    assert_eq!(program.ops()[4].1, Stage::Constant);
    assert_eq!(program.outputs()[1].0, "y, \"raised\" \u{7}#");
    let (q1, q2, a) = (0.3_f64, -0.2_f64, 2.0_f64);
    let m1 = q1.cos() * a;
    let angle = (-q2).atan2(m1 + 1.5);
    let x = (-((angle - std::f64::consts::PI) / std::f64::consts::PI)).sqrt().sin();
    let value = |name: &str| {
        Some(match name {
            "q1" => q1,
            "q 2" => q2,
            _ => a,
        })
    };
    assert_eq!(program.eval(|s| value(&s.name())), Ok(vec![x, -m1]));
}

#[test]
fn order_and_layout_are_free() {
    let text = "variables q\r\n\n  # a comment\nvariables r # more\n%a = input q # last\nresult x=-%a\n%1=input r\n\
                %2 = number 6 / 4\nresult y = %1\nresult z = %2";
    let canonical = "variables q r\nparameters\n%a = input q\n%1 = input r\n%2 = number 3/2\n\
                     result x = -%a\nresult y = %1\nresult z = %2\n";
    assert_eq!(read(text).to_text(), canonical);
    assert_eq!(read("").to_text(), "variables\nparameters\n");
}

#[test]
fn large_rationals_are_exact() {
    let [x, y] = ["x", "y"].map(Expr::symbol);
    let big = (0..20).fold(Expr::int(i64::MAX), |n, _| n * Expr::int(i64::MAX));
    let f = program(&["x", "y"], &[], &[("f", x * big + y / (big + Expr::int(2)))]);
    let text = f.to_text();
    assert!(text.len() > 800);
    assert_eq!(read(&text).to_text(), text);
}

#[test]
fn all_errors_are_found_with_their_places() {
    let rows: &[(&str, &[&str])] = &[
        ("%0 = input q", &["1:12: `q` is neither a variable nor a parameter"]),
        ("%0 = add %1 %1\n%1 = pi", &["1:10: this value is not defined above"]),
        ("%0 = sin %0", &["1:10: this value is not defined above"]),
        ("%0 = pi\n%0 = pi", &["2:1: this value is defined twice"]),
        ("%m = pi\n%\"m\" = pi", &["2:1: this value is defined twice"]),
        ("variables q q\nparameters q", &["1:13: `q` is declared twice", "2:12: `q` is declared twice"]),
        ("%0 = pi\nresult x = %0\nresult x = %0", &["3:8: there are two results `x`"]),
        ("%0 = pi\n%1 = add %0", &["2:12: expected a value: `%` and its name or number"]),
        ("%0 = pi\n%1 = sin %0 %0", &["2:13: nothing more is expected in this line"]),
        (
            "%0 = pi\n%1 = mul -%0 %0",
            &["2:10: signs stand on results and on operands of sqrt and atan2 only"],
        ),
        ("%0 = tan %0", &["1:6: there is no operation `tan`"]),
        ("%0 = number -1", &["1:13: a number has no sign: subtract it, or use it negated"]),
        ("%0 = number 1/0", &["1:14: a denominator is not zero"]),
        ("%0 = number 1.5", &["1:13: expected a whole number"]),
        ("%0 = number", &["1:12: expected a whole number"]),
        ("%0 pi", &["1:4: expected `=`"]),
        ("% = pi", &["1:1: expected a name or number behind `%`"]),
        ("%0 = pi $", &["1:9: unexpected character `$`"]),
        ("parameters \"a", &["1:12: this quote is not closed"]),
        (
            "parameters \"\\n\"",
            &["1:12: behind a backslash stand a quote, a backslash or a character as in `\\u{a}`"],
        ),
        ("parameters \"\\u{d800}\"", &["1:12: expected a character as in `\\u{a}`"]),
        ("constants a", &["1:1: expected `variables`, `parameters`, `result` or `%name =`"]),
        ("= 3", &["1:1: expected `variables`, `parameters`, `result` or `%name =`"]),
        ("result = %0", &["1:8: expected the name of a result"]),
        // What is wrong in one line is not reported again where its value is used.
        (
            "%a = tan\n%b = sin %a\n%c = $\n%d = add %c %e",
            &[
                "1:6: there is no operation `tan`",
                "3:6: unexpected character `$`",
                "4:13: this value is not defined above",
            ],
        ),
    ];
    for (text, expected) in rows {
        assert_eq!(errors(text), *expected, "{text}");
    }
    let digits = format!("%0 = number 1{}", "0".repeat(5000));
    assert_eq!(errors(&digits), ["1:13: more than 4000 digits"]);
    assert_eq!(errors(&"\n".repeat(20_000_000)), ["1:1: the text is longer than 16777216 bytes"]);
}

/// Long chains are read and evaluated without recursion.
#[test]
fn size_is_no_danger() {
    let mut text = String::from("variables x\n%0 = input x\n");
    for i in 1..50_000 {
        text += &format!("%{i} = {} %{}\n", ["sin", "cos"][i % 2], i - 1);
    }
    text += "result y = %49999\n";
    let program = read(&text);
    let y = program.eval(|_| Some(0.5_f64)).expect("the input is given")[0];
    assert!(y.is_finite());
    assert_eq!(program.depth(), 49_999);
}

fn lines() -> impl Strategy<Value = String> {
    let word = prop_oneof![
        Just("variables"),
        Just("parameters"),
        Just("result"),
        Just("%0"),
        Just("%1"),
        Just("%m"),
        Just("%\"0\""),
        Just("="),
        Just("-"),
        Just("/"),
        Just("input"),
        Just("number"),
        Just("pi"),
        Just("add"),
        Just("sqrt"),
        Just("atan2"),
        Just("q"),
        Just("a"),
        Just("3"),
        Just("0"),
        Just("\""),
        Just("\\u{"),
        Just("}"),
        Just("#"),
        Just("\n"),
        Just("\u{301}"),
        Just("٣"),
        Just("%"),
    ];
    proptest::collection::vec(word, 0..60).prop_map(|words| words.join(" "))
}

fn check_hostile(text: &str) {
    if let Ok(program) = Program::from_text(text) {
        let printed = program.to_text();
        assert_eq!(read(&printed).to_text(), printed);
        program.compile(&vec![1.0; program.parameters().len()]);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn any_text_is_read_or_refused(text in any::<String>(), words in lines()) {
        check_hostile(&text);
        check_hostile(&words);
    }

    #[test]
    fn mutations_are_read_or_refused(
        cuts in proptest::collection::vec((any::<Index>(), any::<Index>(), any::<char>()), 1..6),
    ) {
        let mut chars: Vec<char> = SAMPLE.chars().collect();
        for (from, to, c) in cuts {
            let (i, j) = (from.index(chars.len()), to.index(chars.len()));
            match c as u32 % 4 {
                0 => chars[i] = c,
                1 => chars.swap(i, j),
                2 => { chars.remove(i); }
                _ => {
                    let copied: Vec<char> = chars[i.min(j)..i.max(j)].to_vec();
                    chars.splice(i..i, copied);
                }
            }
        }
        check_hostile(&chars.into_iter().collect::<String>());
    }
}

proptest! {
    #[test]
    fn round_trips_keep_every_bit(
        steps in steps(40),
        at in [-3.0..3.0_f64, -3.0..3.0, -3.0..3.0, -3.0..3.0],
    ) {
        let own = random(&steps, 3);
        for program in [own.jacobian(), own] {
            let text = program.to_text();
            let back = read(&text);
            prop_assert_eq!(back.to_text(), text);
            prop_assert_eq!(back.ops(), program.ops());
            prop_assert_eq!(back.outputs(), program.outputs());
            let names: Vec<_> = program.variables().iter().chain(program.parameters()).copied().collect();
            let bits = |p: &Program| {
                let values = p.eval(|s| names.iter().position(|n| *n == s).map(|i| at[i])).expect("inputs");
                values.iter().map(|x| x.to_bits()).collect::<Vec<_>>()
            };
            prop_assert_eq!(bits(&program), bits(&back));
            let compiled = |p: &Program| {
                let values = p.compile(&at[3..]).scalar().eval(&at[..3]).to_vec();
                values.iter().map(|x| x.to_bits()).collect::<Vec<_>>()
            };
            prop_assert_eq!(compiled(&program), compiled(&back));
        }
    }
}
