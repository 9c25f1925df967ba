//! Slips in printed formulas are found and mended: those of the documents, one of each kind, and many at random.

mod points;
mod study;
mod subjects;

use denavit_reading::slip::{Effort, Lexicon, Slip, Wanted, needed, repairs};
use denavit_symbolic::parse::{Syntax, SyntaxKind, parse_syntax};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Symbol};
use subjects::{Subject, names, prrrrp, rx90, ur3, wrist};

#[test]
fn slips_of_the_documents() {
    let rx90 = rx90();
    let printed = "C1(-C23(C4C5C6 + S4S6) + S23S5S6) + S1(S4C5S6 - C4C6)";
    rx90.check(printed, rx90.right[3], rx90.right[3]);
    let printed = "S1(-C23(C4C5C6 + S4S6) + S23S5S6) - C1(S4C5S6 - C4C6)";
    rx90.check(printed, rx90.right[4], rx90.right[4]);
    let prrrrp = prrrrp();
    prrrrp.check("s2.D_7 + c2.s34.r_7", "s2.D_7 + s2.s34.r_7", "s2.D_7 + s2.s34.r_7");
    let ur3 = ur3();
    let printed = [
        (0, "C_1 C_{234} C_5 C_6 - S_1 S_5 C_6 - C_1 S_{234} S_6"),
        (1, "-C_1 C_{234} C_5 S_6 - C_1 S_{234} C_6 + S_1 S_5 S_6"),
        (2, "S_1 C_5 - C_1 C_{234} S_5"),
        (
            3,
            "a_3 C_1 C_{23} + a_2 C_1 C_2 - S_1 d_2 - S_1 d_3 - S_1 d_4 + d_5 C_1 S_{234} + d_6 (S_1 C_5 - C_1 S_5 C_{234})",
        ),
        (4, "C_1 S_5 C_6 + S_1 C_{234} C_5 C_6 - S_1 S_{234} S_6"),
        (5, "-S_1 S_{234} C_6 - C_1 S_5 S_6 + S_1 C_{234} C_5 S_6"),
        (6, "-C_1 C_5 - S_1 S_5 C_{234}"),
        (
            7,
            "C_1 (d_2 + d_3 + d_4) + S_1 (a_2 C_2 + a_3 C_{23} + S_{234} d_5) - d_6 (C_1 C_5 + S_1 S_5 C_{234})",
        ),
        (8, "-C_{234} S_6 - S_{234} C_5 C_6"),
        (9, "S_{234} C_5 S_6 - C_{234} C_6"),
        (10, "S_{234} S_5"),
        (11, "-a_2 S_2 - a_3 S_{23} + d_1 + C_{234} d_5 + S_{234} S_5 d_6"),
        (13, "-C_{234}C_5C_6 - S_{234}C_6"),
        (14, "-C_{234}S_5"),
        (15, "a_3C_{23} + a_2C_2 - C_{234}S_5d_6 + S_{234}d_5"),
        (16, "S_{234}S_6 + S_{234}C_5C_6"),
        (17, "C_{234}C_6 - S_{234}C_5C_6"),
        (18, "a_3S_{23} + a_2S_2 - S_{234}S_5d_6 - C_{234}d_5"),
    ];
    for (i, printed) in printed {
        ur3.check(printed, ur3.right[i], ur3.right[i]);
    }
    let wrist = wrist();
    wrist.check("S5S6 + C5", "S5S6", "S5S6");
    let stanford = Subject {
        names: names(&["r3", "d2"], &[1, 2]),
        right: vec!["C(t1)*S(t2)", "S(t1)*S(t2)", "C(t2)", "r3*C(t1)*S(t2) - d2*S(t1)"],
    };
    stanford.check("0", "r3*cos(t2)", "r3*C(t2)");
    let angles = Subject { names: names(&["R32", "R33"], &[]), right: vec!["atan2(R32, R33)"] };
    angles.check("atan2(R32, -R33)", "atan2(R32, R33)", "atan2(R32, R33)");
}

#[test]
fn every_kind_of_slip_has_its_name() {
    let subject = ur3();
    let rows: [(&str, &str, Slip); 13] = [
        ("S_1 C_5 - C_1 C_{234} S_5", "S_1 C_5 + C_1 C_{234} S_5", Slip::Sign),
        ("-S_5 C_6", "S_5 C_6", Slip::Sign),
        ("S_1 S_5 + C_1 C_{234} S_5", "S_1 C_5 + C_1 C_{234} S_5", Slip::SineForCosine),
        ("S_1 C_5 + C_1 C_{23} S_5", "S_1 C_5 + C_1 C_{234} S_5", Slip::Index),
        ("a_3 C_1 - d_5 S_1", "a_2 C_1 - d_5 S_1", Slip::Index),
        ("a_3 C_1 - d_5 S_1", "a_3 C_1 - a_2 S_1", Slip::Symbol),
        ("S_1 C_5 + C_{234} S_5", "S_1 C_5 + C_1 C_{234} S_5", Slip::LostFactor),
        ("S_1 C_5 + 2 C_1 C_{234} S_5", "S_1 C_5 + C_1 C_{234} S_5", Slip::ExtraFactor),
        ("a_2^2 + a_3^3", "a_2^2 + a_3^2", Slip::Exponent),
        ("d_5 (S_1 C_5 + 3) - a_2", "d_5 (S_1 C_5 + 2) - a_2", Slip::Number),
        ("C_1 (a_2 C_2) + a_3 C_{23}", "C_1 (a_2 C_2 + a_3 C_{23})", Slip::Bracket),
        ("a_2 (C_1 C_6 + S_1 S_5)", "a_2 (C_1 C_5 + S_1 S_6)", Slip::Several(vec![Slip::Index; 2])),
        ("a_2 C_1 + d_5", "a_2 C_1 + d_5 - d_6 S_1", Slip::LostTerm),
    ];
    for (printed, right, kind) in rows {
        let found = subject.mend(printed, right);
        assert!(!found.is_empty(), "{printed}");
        assert_eq!((found[0].formula.as_str(), &found[0].slip), (right, &kind), "{found:#?}");
    }
    // Both names are in print, each at the other's place.
    let found = subject.mend("a_2 (d_5 C_6 + d_6 S_5)", "a_2 (d_6 C_6 + d_5 S_5)");
    assert_eq!((found[0].formula.as_str(), &found[0].slip), ("a_2 (d_6 C_6 + d_5 S_5)", &Slip::Exchanged));
}

#[test]
fn repairs_keep_the_notation() {
    let rows = [
        (r"\cos\theta_1 \cos\theta_2 - d_3 \sin\theta_1", r"\cos\theta_1 \sin\theta_2 - d_3 \sin\theta_1"),
        (r"\left(a_3 + a_4\right) C_5 + a_5", r"\left(a_3 + a_4\right) C_6 + a_5"),
        ("−c2.s4 + c5", "c2.s4 + c5"),
        ("cos(q2)*sin(q4) - d_3", "cos(q2)*cos(q4) - d_3"),
        (r"\frac{C_5 a_3}{2} + a_4", r"\frac{C_5 a_3 - a_5}{2} + a_4"),
        (r"\frac{a_3 - a_4}{2 a_5}", r"\frac{a_3 + a_4}{2 a_5}"),
        (r"\sqrt{a_3^2 - a_4^2}", r"\sqrt{a_3^2 + a_4^2}"),
        ("a_3/a_4 + a_5", "a_3/a_6 + a_5"),
        ("a_3 - (C_5 + a_4)", "a_3 - (C_5 - a_4)"),
    ];
    let subject = wrist();
    let names = subject.names.clone().angle(1, Symbol::new("q1"));
    let subject = Subject { names, right: subject.right };
    for (printed, right) in rows {
        subject.check(printed, right, right);
    }
}

#[test]
fn values_are_enough() {
    let subject = prrrrp();
    let right = subject.read("s2.D_7 + s2.s34.r_7");
    let mut lexicon = subject.lexicon_without("", &[]);
    let wanted = Wanted::Values(lexicon.value(right.value()).unwrap());
    let text = "s2.D_7 + c2.s34.r_7";
    let found = repairs(text, &subject.read(text), &wanted, &mut lexicon, &subject.names, Effort::default());
    assert_eq!(found[0].formula, "s2.D_7 + s2.s34.r_7");
    // A formula that is right needs no repair.
    let found = repairs(text, &right, &wanted, &mut lexicon, &subject.names, Effort::default());
    assert_eq!(found, []);
}

/// A slip in the definition of D_5 is mended through a result that uses it.
#[test]
fn a_definition_is_mended_through_its_use() {
    let subject = prrrrp();
    let wrong = subject.read("c3.D_1 - s3.D_1").value();
    let names = subject.names.clone().alias("D_5", wrong);
    let result = parse_syntax("c2.D_5 + s2.s5", &names).unwrap();
    let right = subject.read("c2.D_5 + s2.s5").value();
    let mut lexicon = subject.lexicon_without("c3.D_1 - s3.D_2", &[right]);
    let is_name = |part: &Syntax| part.kind == SyntaxKind::Name(wrong);
    let value = needed(&result, is_name, &Wanted::Formula(right), &mut lexicon).unwrap();
    assert_eq!(Some(value), lexicon.value(subject.read("c3.D_1 - s3.D_2").value()));
    let text = "c3.D_1 - s3.D_1";
    let found = repairs(
        text,
        &subject.read(text),
        &Wanted::Values(value),
        &mut lexicon,
        &subject.names,
        Effort::default(),
    );
    assert_eq!(found[0].formula, "c3.D_1 - s3.D_2");
}

#[test]
fn large_formulas_and_small_efforts_end() {
    let symbols: Vec<String> = (0..1500).map(|i| format!("x{i}")).collect();
    let names = symbols.iter().fold(Vocabulary::new(), |v, s| v.symbol(s));
    let text = symbols.join(" + ");
    let syntax = parse_syntax(&text, &names).unwrap();
    let mut lexicon = Lexicon::new(&[Expr::symbol("x0"), Expr::symbol("x1")], &[]).unwrap();
    let x = |i| Expr::symbol(&format!("x{i}"));
    let other = syntax.value() * x(3) * Expr::int(17) + x(0) * x(1).powi(5) + x(2) * x(4).powi(3);
    let before = std::time::Instant::now();
    let wanted = Wanted::Formula(other);
    assert_eq!(repairs(&text, &syntax, &wanted, &mut lexicon, &names, Effort::default()), []);
    println!("{:.0} ms", before.elapsed().as_secs_f64() * 1e3);
    let subject = rx90();
    let printed = subject.read("S23(C4C5C6 + S4S6) + C23S5C6");
    let mut lexicon = subject.lexicon_without("", &[]);
    for units in [0, 1, 10, 100, 1_000, 10_000] {
        let wanted = Wanted::Formula(subject.read(subject.right[2]).value());
        let text = "S23(C4C5C6 + S4S6) + C23S5C6";
        let found = repairs(text, &printed, &wanted, &mut lexicon, &subject.names, Effort(units));
        assert!(found.is_empty() || found[0].formula == subject.right[2], "{units}: {found:?}");
    }
}
