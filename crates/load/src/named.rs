//! Joints and frames by number or name.

use denavit::description::{Description, Row, Variable};
use denavit_symbolic::Expr;

/// The joint (from 0) that a word names: by its number from 1, its variable, or the name of its row.
///
/// # Errors
/// A sentence that says which there are.
pub fn joint(d: &Description, word: &str) -> Result<usize, String> {
    let moving: Vec<_> = d.rows.iter().filter_map(|r| Some((r.variable?, r.name.as_deref()))).collect();
    let number = word.parse().ok().filter(|n| (1..=moving.len()).contains(n)).map(|n: usize| n - 1);
    let variable = moving.iter().position(|m| *m.0.symbol.name() == *word);
    let named = moving.iter().position(|m| m.1 == Some(word));
    if let (None, Some(v), Some(n)) = (number, variable, named.filter(|n| variable != Some(*n))) {
        let what = format!("`{word}` is the variable of joint {} and the name of joint {}", v + 1, n + 1);
        return Err(format!("{what}: name it by its number"));
    }
    let found = number.or(variable).or(named);
    found.ok_or_else(|| {
        let follows = d.rows.iter().find(|r| r.variable.is_none() && r.name.as_deref() == Some(word));
        if let Some(leader) = follows.and_then(|row| follows_whom(d, row)) {
            return format!("`{word}` does not move by itself: it follows {leader}");
        }
        let named = |(v, name): &(Variable, Option<&str>)| match name {
            Some(name) => format!("{} ({name})", v.symbol.name()),
            None => v.symbol.name().to_string(),
        };
        format!("no joint `{word}`; there are {}", moving.iter().map(named).collect::<Vec<_>>().join(", "))
    })
}

/// The frame that a word names: by its number from 0, or by the name of its row.
///
/// # Errors
/// A sentence that says which there are.
pub fn frame(d: &Description, word: &str) -> Result<usize, String> {
    let last = d.rows.len();
    if let Some(n) = word.parse::<usize>().ok().filter(|n| *n <= last) {
        return Ok(n);
    }
    let named = |row: &Row| row.name.as_deref() == Some(word);
    let found: Vec<usize> = (0..last).filter(|&i| named(&d.rows[i])).collect();
    match found[..] {
        [i] => Ok(i + 1),
        [] => {
            let names: Vec<&str> = d.rows.iter().filter_map(|r| r.name.as_deref()).collect();
            let names = if names.is_empty() { String::new() } else { format!(", or {}", names.join(", ")) };
            Err(format!("no frame `{word}`: name a frame from 0 to {last}{names}"))
        }
        _ => Err(format!("several rows are called `{word}`: name the frame by its number, from 0 to {last}")),
    }
}

/// The variables, with the names of their rows, that move a row which has none of its own.
fn follows_whom(d: &Description, row: &Row) -> Option<String> {
    let symbols = [row.theta, row.d].into_iter().flat_map(Expr::symbols).collect::<Vec<_>>();
    let moving = d.rows.iter().filter_map(|r| Some((r.variable?.symbol, r.name.as_deref())));
    let named = moving.filter(|m| symbols.contains(&m.0)).map(|(symbol, name)| match name {
        Some(name) => format!("{} ({name})", symbol.name()),
        None => symbol.name().to_string(),
    });
    let all: Vec<String> = named.collect();
    (!all.is_empty()).then(|| all.join(" and "))
}
