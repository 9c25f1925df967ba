//! What sentences say of a table: its convention and the unit of its lengths, in four languages.

use denavit::description::Convention::{Craig, Khalil, Standard};
use denavit::description::{TableKind, TableOptions, read_table};
use denavit_symbolic::{Expr, Rational};

const TABLE: &str =
    "| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | 0 | 0 |\n| 2 | θ2 | 80 | 30 | 0 |\n";
const KHALIL: &str =
    "| j | α | d | θ | r |\n|---|---|---|---|---|\n| 1 | 0 | 0 | θ1 | 0 |\n| 2 | 0 | 30 | θ2 | 80 |\n";

#[test]
fn a_sentence_tells_the_convention() {
    for (sentence, table, expected) in [
        ("The table follows Craig's convention.", TABLE, Craig),
        ("We use the standard Denavit-Hartenberg convention.", TABLE, Standard),
        ("Die Tabelle folgt der Konvention von Craig.", TABLE, Craig),
        ("Die Tabelle steht in der klassischen Konvention.", TABLE, Standard),
        ("Le tableau suit la convention de Craig.", TABLE, Craig),
        ("Les paramètres sont ceux de Khalil et Kleinfinger.", KHALIL, Khalil),
        ("La tabla sigue la convención de Craig.", TABLE, Craig),
        ("Se usa el convenio estándar de Denavit-Hartenberg.", TABLE, Standard),
    ] {
        for text in [format!("{sentence}\n\n{table}"), format!("{table}\n{sentence}\n")] {
            let (d, findings) =
                read_table(&text, TableKind::Markdown, &TableOptions::default()).expect(&text);
            assert_eq!(d.convention, expected, "{text}");
            let message = format!("read as {expected}: the text says so");
            let said = findings.iter().find(|f| f.message == message).expect(&text);
            assert!(sentence.to_ascii_lowercase().contains(&text[said.span.clone()].to_ascii_lowercase()));
        }
    }
}

#[test]
fn what_is_no_statement_tells_none() {
    for sentence in [
        "The standard table and the one of Craig differ in the order of the motions.",
        "## References\n\nJ. J. Craig, Introduction to Robotics, 1986.",
        "[2] J. J. Craig, Introduction to Robotics, 1986.",
    ] {
        let text = format!("{TABLE}\n{sentence}\n");
        let found = read_table(&text, TableKind::Markdown, &TableOptions::default()).expect_err(sentence);
        assert!(found.iter().any(|f| f.message.starts_with("the convention is not said")), "{sentence}");
    }
    // An option, a line and the columns come first.
    for (text, expected) in [
        (format!("convention: standard\n\nAfter Craig.\n\n{TABLE}"), Standard),
        (
            format!("The standard convention.\n\n{}", TABLE.replace("| a | α |", "| a_{i-1} | α_{i-1} |")),
            Craig,
        ),
    ] {
        let (d, _) = read_table(&text, TableKind::Markdown, &TableOptions::default()).expect(&text);
        assert_eq!(d.convention, expected, "{text}");
    }
}

#[test]
fn a_sentence_tells_millimetres() {
    for (sentence, expected) in [
        ("All lengths are in mm.", Rational::new(2, 25).into()),
        ("Alle Längen in mm.", Rational::new(2, 25).into()),
        ("Longueurs en mm.", Rational::new(2, 25).into()),
        ("Longitudes en mm.", Rational::new(2, 25).into()),
        ("Lengths in mm; lengths in m in the next chapter.", Expr::int(80)),
        ("lengths: m\n\nThe drawing has its lengths in mm.", Expr::int(80)),
    ] {
        let text = format!("convention: craig\n\n{sentence}\n\n{TABLE}");
        let (d, _) = read_table(&text, TableKind::Markdown, &TableOptions::default()).expect(&text);
        assert_eq!(d.rows[1].d, expected, "{text}");
    }
}
