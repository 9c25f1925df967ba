//! Tables that count their angles apart from their rows.

use denavit::description::{Convention, JointKind, TableKind, TableOptions, read_table};

fn standard() -> TableOptions {
    TableOptions { convention: Some(Convention::Standard), ..TableOptions::default() }
}

#[test]
fn angles_counted_apart() {
    let moves = |text: &str| {
        let found = read_table(text, TableKind::Markdown, &standard());
        let (d, _) = found.unwrap_or_else(|e| panic!("{e:?}\n{text}"));
        d.variables().iter().map(|v| v.kind).collect::<Vec<JointKind>>()
    };
    let (turns, slides) = (JointKind::Revolute, JointKind::Prismatic);
    let head = "| i | θ | d | a | α |\n|---|---|---|---|---|\n";
    // Angles counted apart: beside a slide without a number, above a fixed row.
    let lift =
        format!("{head}| 1 | 0 | s | 0 | 0 |\n| 2 | th1 | 0 | l1 | 0 |\n| 3 | th2 | 0 | l2 | 180° |\n");
    assert_eq!(moves(&lift), [slides, turns, turns]);
    let raised = format!("{head}| 1 | 0 | h | 0 | 0 |\n| 2 | θ1 | 0 | l1 | 0 |\n| 3 | θ2 | 0 | l2 | 0 |\n");
    assert_eq!(moves(&raised), [turns; 2]);
    // Words apart behind the cells of a row.
    let words = "i | a | alpha | d | theta\n1 | E | 0 | 0 | th1      slewing ring\n2 | 0 | 90° | d2 | 0        mast (sliding), d2 >= 0\n";
    assert_eq!(moves(words), [turns, slides]);
}

/// Numbers of angles that are neither those of the rows nor counted from 1 on name no variables.
#[test]
fn angles_in_no_order_are_refused() {
    let head = "| i | θ | d | a | α |\n|---|---|---|---|---|\n";
    for rows in [
        "| 1 | θ2 | 0 | l1 | 0 |\n| 2 | θ1 | 0 | l2 | 0 |\n",
        "| 1 | 0 | d1 | 0 | 0 |\n| 2 | θ1 | 0 | l2 | 0 |\n| 3 | θ2 | 0 | l3 | 0 |\n",
    ] {
        let found = read_table(&format!("{head}{rows}"), TableKind::Markdown, &standard());
        assert!(found.is_err(), "{rows}");
    }
}
