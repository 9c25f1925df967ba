//! Robots of a document with names for their lengths and with tools that the document tells.

use super::subject::Subject;
use denavit::description::{Description, JointKind, Parameter};
use denavit::geometry::{Transform, Vector};
use denavit_symbolic::parse::parse;
use denavit_symbolic::{Expr, Symbol};
use std::collections::BTreeSet;

/// Lengths that the table gives as numbers under the names that the formulas use for them: d_1 for 151.9 mm.
pub(super) fn with_names(subject: Subject, mentioned: &BTreeSet<String>) -> Subject {
    let mut d = subject.description.clone();
    let taken: BTreeSet<String> = d.parameters.iter().map(|p| p.symbol.name().to_string()).collect();
    let mut parameters = vec![];
    let [x, z] = &subject.letters;
    for (i, row) in (1..).zip(&mut d.rows) {
        let slides = row.variable.is_some_and(|v| v.kind == JointKind::Prismatic);
        let k = i - i32::from(subject.previous);
        for (name, cell, moves) in
            [(format!("{x}{k}"), &mut row.a, false), (format!("{z}{i}"), &mut row.d, slides)]
        {
            let is_number = cell.symbols().is_empty() && !cell.is_zero();
            if is_number && mentioned.contains(&name) && !taken.contains(&name) && !moves {
                let symbol = Symbol::new(&name);
                parameters.push(Parameter { symbol, value: Some(*cell) });
                *cell = symbol.into();
            }
        }
    }
    d.parameters.extend(parameters);
    subject.with(d)
}

/// A robot whose rows with one length in numbers have it under a letter with their number: `l1`, `l2`; nothing if no row has.
pub(super) fn with_lengths(subject: &Subject, letter: char) -> Option<Subject> {
    let mut d = subject.description.clone();
    let mut parameters = vec![];
    for (i, row) in (1..).zip(&mut d.rows) {
        let slides = row.variable.is_some_and(|v| v.kind == JointKind::Prismatic);
        let is_number = |e: &Expr| e.symbols().is_empty() && !e.is_zero();
        let cell = match (is_number(&row.a), !slides && is_number(&row.d)) {
            (true, false) => &mut row.a,
            (false, true) => &mut row.d,
            _ => continue,
        };
        let symbol = Symbol::new(&format!("{letter}{i}"));
        parameters.push(Parameter { symbol, value: Some(*cell) });
        *cell = symbol.into();
    }
    if parameters.is_empty() || parameters.iter().any(|p| d.parameter(p.symbol).is_some()) {
        return None;
    }
    d.parameters.extend(parameters);
    Some(subject.with(d))
}

/// A robot with a tool at `x, y, z`.
pub(super) fn with_tool(d: &Description, place: &str) -> Option<Description> {
    let names = d.vocabulary().open(true);
    let lengths: Vec<Expr> = place.split(',').map(|p| parse(p, &names).ok()).collect::<Option<_>>()?;
    let [x, y, z] = lengths[..] else { return None };
    Some(with_tool_at(d, &Vector([x, y, z])))
}

/// The same with lengths that are worked out.
pub(super) fn with_tool_at(d: &Description, place: &Vector<Expr>) -> Description {
    let mut d = d.clone();
    let Vector([x, y, z]) = *place;
    for symbol in [x, y, z].iter().flat_map(|e| e.symbols()) {
        if d.parameter(symbol).is_none() {
            d.parameters.push(Parameter { symbol, value: None });
        }
    }
    d.tool = Transform::translation(x, y, z);
    d
}

/// The number that a line of C gives a name: `#define H 1.20f`.
pub(super) fn defined_in<'t>(text: &'t str, name: &str) -> Option<&'t str> {
    text.lines().find_map(|line| {
        let mut words = line.trim().strip_prefix("#define")?.split_whitespace();
        let value = words.next().filter(|n| *n == name).and(words.next())?;
        let number = value.trim_end_matches(['f', 'F']);
        number.parse::<f64>().is_ok().then_some(number)
    })
}
