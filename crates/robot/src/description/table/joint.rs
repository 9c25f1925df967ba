//! Which cell of a row moves.

use super::columns::Role;
use super::read::{ReadRow, TableCell};
use crate::description::cell::name_of;
use crate::description::diagnostic::Diagnostics;
use crate::description::{Convention, JointKind};
use std::ops::Range;

/// Longer tables are not searched for variables with names of their own.
const MOST_BY_WORDS: usize = 64;

/// What a row's joint is.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Joint {
    /// A fixed transform.
    Fixed,
    /// The cell that holds the variable, and the variable's name there; a cell that only says "variable" has none.
    Moves(JointKind, Option<String>),
}

/// What the text gives names.
pub(super) struct Given<'a> {
    /// True for a name to which it gives a constant.
    pub is_constant: &'a dyn Fn(&str) -> bool,
    /// True for two names to which one line gives values.
    pub gives_both: &'a dyn Fn(&str, &str) -> bool,
}

/// The joint of each row.
pub(super) fn joints(
    rows: &[ReadRow],
    convention: Convention,
    given: &Given<'_>,
    out: &mut Diagnostics,
) -> Vec<Joint> {
    let starred = rows.iter().any(|r| r.cells().iter().any(|c| c.star));
    let mut joints: Vec<Joint> = vec![];
    let mut by_row = Diagnostics::default();
    for row in rows {
        let found = joint(row, convention.length_z(), starred, &joints, &mut by_row);
        joints.push(found.unwrap_or(Joint::Fixed));
    }
    let counted = counted_apart(rows, &joints).filter(|_| !starred).unwrap_or_default();
    for (joint, name) in joints.iter_mut().zip(&counted) {
        if let Some(name) = name {
            *joint = Joint::Moves(JointKind::Revolute, Some(name.clone()));
        }
    }
    // What was said of the length of a row whose angle turns does not hold.
    let is_of = |row: &ReadRow, span: &Range<usize>| row.z.cell.span == *span;
    let is_turning =
        |span: &Range<usize>| rows.iter().zip(&counted).any(|(row, name)| name.is_some() && is_of(row, span));
    by_row.list().iter().filter(|f| !is_turning(&f.span)).for_each(|f| out.add(f.clone()));
    check_owners(rows, &joints, convention.length_z(), out);
    let is_silent = rows.len() <= MOST_BY_WORDS
        && !starred
        && !out.has_errors()
        && rows.iter().all(|r| !says_what_moves(r));
    // θ without a number turns, and so do letters like it in other rows: θ, φ.
    let is_bare =
        |j: &Joint| matches!(j, Joint::Moves(_, Some(n)) if !n.ends_with(|c: char| c.is_ascii_digit()));
    if is_silent && joints.iter().all(|j| *j == Joint::Fixed || is_bare(j)) {
        let is_known = joints.iter().any(|j| *j != Joint::Fixed);
        joints = by_words(rows, joints, convention.length_z(), given, out);
        if !is_known {
            return joints;
        }
    }
    // The letter of the angles that turn is that of all joints: `t3` along z beside θ1 = `t1`.
    let stems: Vec<String> = joints.iter().filter_map(stem_of_angle).collect();
    for (row, joint) in rows.iter().zip(&mut joints).filter(|(row, _)| !starred && !says_what_moves(row)) {
        if *joint == Joint::Fixed
            && let Some(name) = slide(row, &stems)
        {
            let (z, number) = (convention.length_z(), row.number);
            note_slide(&row.z, (&name, number, z), out);
            *joint = Joint::Moves(JointKind::Prismatic, Some(name));
        }
    }
    joints
}

/// The variables of a table that counts its angles apart, `s`, θ1, θ2 or a fixed row and θ1, θ2: one letter, numbered from 1 on
/// where θ is no number. Nothing where the numbers are those of the rows, or a row says itself what moves.
fn counted_apart(rows: &[ReadRow], joints: &[Joint]) -> Option<Vec<Option<String>>> {
    let mut names: Vec<Option<String>> = vec![];
    let (mut stem, mut count, mut is_own) = (None, 0, true);
    for row in rows {
        if says_what_moves(row) {
            return None;
        }
        // `-q2-q3`: the row follows joints before it.
        let is_known = |name: &String| names.iter().flatten().any(|n| n == name);
        let name = match &row.theta.cell.symbols[..] {
            all if all.iter().all(|s| is_known(&s.0)) && row.theta.cell.expr.as_symbol().is_none() => {
                names.push(None);
                continue;
            }
            [(name, _)] => name,
            _ => return None,
        };
        let letters = name.trim_end_matches(|c: char| c.is_ascii_digit());
        count += 1;
        if name[letters.len()..].parse() != Ok(count) || stem.get_or_insert(letters) != &letters {
            return None;
        }
        is_own &= row.number == count;
        names.push(Some(name.clone()));
    }
    // What slides by the number of its row counts as all joints do.
    let slides = |j: &Joint| matches!(j, Joint::Moves(JointKind::Prismatic, Some(n)) if n.ends_with(|c: char| c.is_ascii_digit()));
    let is_angle = stem.is_some_and(|s| matches!(s, "theta" | "t" | "th" | "phi" | "q"));
    let is_slide = joints.iter().zip(&names).any(|(j, name)| name.is_none() && slides(j));
    (is_angle && count > 1 && !is_own && !is_slide).then_some(names)
}

/// The letter of a joint that turns, without its number.
fn stem_of_angle(joint: &Joint) -> Option<String> {
    let Joint::Moves(JointKind::Revolute, Some(name)) = joint else { return None };
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    (!stem.is_empty() && stem.len() < name.len()).then(|| stem.to_string())
}

/// The letter of a way along z in a row that does not turn, where other rows move: `s`, or `p3` in row 3, or one of `stems` with
/// the number of the row; or a word for one.
fn slide(row: &ReadRow, stems: &[String]) -> Option<String> {
    const LETTERS: [&str; 19] = [
        "s",
        "p",
        "x",
        "y",
        "z",
        "u",
        "rho",
        "lambda",
        "sigma",
        "delta",
        "xi",
        "zeta",
        "ext",
        "extension",
        "stroke",
        "slide",
        "lift",
        "hub",
        "telescope",
    ];
    let is_joint = |name: &str| {
        let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
        let index = &name[stem.len()..];
        // Beside another length, `z0 + z1`, only the number of the row tells.
        let is_alone = row.z.cell.symbols.len() == 1;
        let is_own = index.is_empty() && is_alone || index.parse() == Ok(row.number);
        let cells = [&row.x, &row.alpha];
        let is_elsewhere = cells.into_iter().any(|c| c.cell.symbols.iter().any(|s| s.0 == name));
        let is_letter = LETTERS.contains(&stem) || !index.is_empty() && stems.iter().any(|s| s == stem);
        is_letter && is_own && !is_elsewhere
    };
    let mut found = row.z.cell.symbols.iter().map(|s| &s.0).filter(|name| is_joint(name));
    let name = found.next().filter(|_| row.theta.cell.symbols.is_empty())?;
    found.all(|other| other == name).then(|| name.clone())
}

/// Says that a row slides.
fn note_slide(cell: &TableCell, (name, number, z): (&str, usize, &str), out: &mut Diagnostics) {
    let message = format!("row {number} is prismatic: `{name}` in {z}, and no variable in theta");
    out.note(cell.cell.span.clone(), message).hint(
        "if that is a constant, give it another name, or add a column σ (0 revolute, 1 prismatic, 2 fixed)",
    );
}

/// True for a row with a cell for its type or its variable.
fn says_what_moves(row: &ReadRow) -> bool {
    row.source(Role::Sigma).or(row.source(Role::Variable)).is_some()
}

/// The joints of a table whose variables have names of their own (`pan`, `tilt`, `rho`): the one symbol of θ that has no
/// value turns; where θ is a number, the one along z that stands nowhere else slides. Values are those of a configuration where
/// the names are numbered as the rows are (`φ1`, `φ2`, or `θ4`, `θ5` of a wrist), where nothing would turn without these names, or
/// where the line that gives one gives another angle its value, too. Beside joints that are known only angles are looked at.
fn by_words(
    rows: &[ReadRow],
    known: Vec<Joint>,
    z: &str,
    given: &Given<'_>,
    out: &mut Diagnostics,
) -> Vec<Joint> {
    let is_known = known.iter().any(|j| *j != Joint::Fixed);
    let is_constant = given.is_constant;
    let turning = || rows.iter().filter(|r| !r.theta.cell.symbols.is_empty());
    // The stem of a name, and how far its number is from that of the row.
    let counted = |row: &ReadRow| -> Option<(String, usize)> {
        let [(name, _)] = &row.theta.cell.symbols[..] else { return None };
        let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
        let number: usize = name[stem.len()..].parse().ok()?;
        Some((stem.to_string(), number.checked_sub(row.number)?)).filter(|_| !stem.is_empty())
    };
    let first = turning().next().and_then(counted);
    let is_counted = turning().count() > 1 && first.is_some() && turning().all(|r| counted(r) == first);
    let angles = || turning().flat_map(|r| &r.theta.cell.symbols).map(|s| s.0.as_str());
    let is_still = angles().all(is_constant);
    let is_angle = |name: &str| angles().any(|a| a == name);
    let is_beside = |name: &str| {
        angles().any(|other| other != name && !is_constant(other) && (given.gives_both)(name, other))
    };
    let is_given =
        |name: &str| is_constant(name) && !(is_angle(name) && (is_counted || is_still || is_beside(name)));
    let open = |cell: &TableCell| -> Option<String> {
        let mut names = cell.cell.symbols.iter().map(|s| &s.0).filter(|n| !is_given(n));
        let first = names.next()?;
        names.all(|n| n == first).then(|| first.clone())
    };
    let uses = |name: &str| {
        let cells = rows.iter().flat_map(|r| r.cells());
        cells.filter(|c| c.cell.symbols.iter().any(|s| s.0 == name)).count()
    };
    let mut joint = |row: &ReadRow| {
        let (cell, kind) = match row.theta.cell.symbols.is_empty() {
            true => (&row.z, JointKind::Prismatic),
            false => (&row.theta, JointKind::Revolute),
        };
        let name = open(cell).filter(|n| uses(n) == 1)?;
        let letter = if kind == JointKind::Revolute { "theta" } else { z };
        out.note(
            cell.cell.span.clone(),
            format!("`{name}` in {letter} is read as the variable of row {}", row.number),
        )
        .hint("if that is a constant, say its value, or add a column σ (0 revolute, 1 prismatic, 2 fixed)");
        Some(Joint::Moves(kind, Some(name)))
    };
    // Without any angle that may turn, a length is more likely one.
    if !rows.iter().any(|r| open(&r.theta).is_some()) {
        return known;
    }
    let found = |(row, known): (&ReadRow, Joint)| match known {
        Joint::Fixed if !is_known || !row.theta.cell.symbols.is_empty() => joint(row).unwrap_or(Joint::Fixed),
        known => known,
    };
    rows.iter().zip(known).map(found).collect()
}

fn joint(row: &ReadRow, z: &str, starred: bool, above: &[Joint], out: &mut Diagnostics) -> Option<Joint> {
    if let Some(sigma) = row.source(Role::Sigma) {
        let kind = match sigma.text.trim_matches(['$', ' ', '*']).to_lowercase().as_str() {
            "0" | "r" | "rev" | "revolute" | "rotoïde" | "rotoide" | "rot" | "rotary" | "rotational" => {
                JointKind::Revolute
            }
            "1" | "p" | "t" | "prism" | "prismatic" | "prismatique" | "linear" | "trans"
            | "translational" => JointKind::Prismatic,
            "2" | "f" | "fixed" | "-" | "" => return Some(Joint::Fixed),
            other => {
                let shown: String = other.chars().take(20).collect();
                out.error(sigma.span.clone(), format!("`{shown}` is no type of joint"))
                    .hint("0 or R is revolute, 1 or P prismatic, 2 or F fixed");
                return None;
            }
        };
        let (cell, name) = if kind == JointKind::Revolute { (&row.theta, "theta") } else { (&row.z, z) };
        if let Some(symbol) = the_variable(cell, row, above) {
            return Some(Joint::Moves(kind, symbol));
        }
        let (span, number) = (cell.cell.span.clone(), row.number);
        let what = if kind == JointKind::Revolute { "revolute" } else { "prismatic" };
        let letter = if kind == JointKind::Revolute { "θ" } else { z };
        out.error(span, format!("row {number} is {what}, but its {name} cell holds no joint variable"))
            .hint(format!("write {letter}{number} or q{number} in it, with an offset if there is one"));
        return None;
    }
    if let Some(variable) = row.source(Role::Variable) {
        let text = variable.text.trim_matches(['$', ' ']);
        if matches!(text, "" | "-" | "–" | "—" | "0" | "fixed") {
            return Some(Joint::Fixed);
        }
        let name = name_of(text, true);
        let holds = |c: &TableCell| name.as_ref().is_some_and(|n| c.cell.symbols.iter().any(|s| s.0 == *n));
        return match (holds(&row.theta), holds(&row.z)) {
            (true, _) => Some(Joint::Moves(JointKind::Revolute, name)),
            (false, true) => Some(Joint::Moves(JointKind::Prismatic, name)),
            (false, false) => {
                let shown: String = text.chars().take(20).collect();
                out.error(
                    variable.span.clone(),
                    format!("the variable `{shown}` stands neither in theta nor in {z}"),
                )
                .hint("the q column names the symbol that moves");
                None
            }
        };
    }
    let own_angle = || {
        let name = own_symbol(&row.theta, row.number, &["theta", "q", "t", "th"])?;
        Some(Joint::Moves(JointKind::Revolute, Some(name)))
    };
    if starred {
        return match star(row, z, above, out) {
            Some(found) => found,
            None => own_angle().or_else(|| {
                if let Some(name) = own_symbol(&row.z, row.number, &["d", "r", "q"]) {
                    let message = format!("`{name}` carries no star: row {} is fixed", row.number);
                    out.warning(row.z.cell.span.clone(), message).hint("mark what moves with a star");
                }
                None
            }),
        };
    }
    if let Some(joint) = own_angle() {
        return Some(joint);
    }
    // Offsets of angles for which the table has no column: they are the variables.
    let has_offset = row.source(Role::Offset).is_some_and(|c| !matches!(c.text.trim(), "" | "-" | "–" | "—"));
    if has_offset && row.source(Role::Theta).is_none() && row.z.cell.symbols.is_empty() {
        return Some(Joint::Moves(JointKind::Revolute, None));
    }
    // Some count all joint variables as θ.
    let name = own_symbol(&row.z, row.number, &["d", "r", "q", "theta"])?;
    note_slide(&row.z, (&name, row.number, z), out);
    Some(Joint::Moves(JointKind::Prismatic, Some(name)))
}

/// The joint of a row that carries a star; `Some(None)` if the star says nothing useful.
fn star(row: &ReadRow, z: &str, above: &[Joint], out: &mut Diagnostics) -> Option<Option<Joint>> {
    let number = row.number;
    let (cell, kind) = match (row.theta.star, row.z.star) {
        (true, true) => {
            out.error(row.z.cell.span.clone(), format!("two cells of row {number} carry a star"))
                .hint("a row is one joint: give the second a row of its own");
            return Some(None);
        }
        (true, false) => (&row.theta, JointKind::Revolute),
        (false, true) => (&row.z, JointKind::Prismatic),
        (false, false) => {
            let wrong = [&row.x, &row.alpha, &row.gamma, &row.b].into_iter().find(|c| c.star)?;
            out.error(wrong.cell.span.clone(), "a star on a cell that cannot move")
                .hint(format!("a joint turns or slides along z: its variable belongs in theta or {z}"));
            return Some(None);
        }
    };
    let symbol = the_variable(cell, row, above);
    if symbol.is_none() {
        out.error(cell.cell.span.clone(), "which symbol of this cell is the variable?")
            .hint(format!("write it as q{number}"));
    }
    Some(symbol.map(|s| Joint::Moves(kind, s)))
}

/// Rows that hold the variable of another row, which does not hold it.
fn check_owners(rows: &[ReadRow], joints: &[Joint], z: &str, out: &mut Diagnostics) {
    let moved = |name: &str| joints.iter().any(|j| matches!(j, Joint::Moves(_, Some(n)) if n == name));
    let of_other_row = |cell: &TableCell, number: usize, letters: &[&str]| {
        cell.cell.symbols.iter().find_map(|(name, span)| {
            let index = letters.iter().find_map(|l| name.strip_prefix(l)?.parse::<usize>().ok())?;
            let other = index != number && rows.iter().any(|r| r.number == index) && !moved(name);
            other.then(|| (name.clone(), index, span.clone()))
        })
    };
    for (row, joint) in rows.iter().zip(joints) {
        if says_what_moves(row) {
            continue;
        }
        let number = row.number;
        // qᵢ of another row is reported with all names that are no row's
        if let Some((name, index, span)) = of_other_row(&row.theta, number, &["theta", "t", "th"]) {
            out.error(span, format!("row {number} holds θ{index}, the variable of another row")).hint(
                format!(
                    "the variable of row {number} is θ{number}; give a constant another name than `{name}`"
                ),
            );
        } else if let (Joint::Fixed, Some((name, _, span))) =
            (joint, of_other_row(&row.z, number, &["d", "r"]))
        {
            let message = format!("row {number} holds `{name}` in {z} and no variable: it is read as fixed");
            out.warning(span, message)
                .hint(format!("the variable of row {number} is {z}{number} or θ{number}"));
        }
    }
}

/// The variable in a cell that is known to hold one: `Some(None)` for a cell that only says so.
fn the_variable(cell: &TableCell, row: &ReadRow, above: &[Joint]) -> Option<Option<String>> {
    if cell.marker {
        return Some(None);
    }
    if let Some(own) = own_symbol(cell, row.number, &["q", "theta", "t", "th", "d", "r", "var"]) {
        return Some(Some(own));
    }
    let moved = |name: &str| above.iter().any(|j| matches!(j, Joint::Moves(_, Some(n)) if n == name));
    let mut new = cell.cell.symbols.iter().map(|s| &s.0).filter(|n| !moved(n));
    match (new.next(), new.next()) {
        (Some(only), None) => Some(Some(only.clone())),
        (None, _) if cell.cell.symbols.len() == 1 => Some(Some(cell.cell.symbols[0].0.clone())), // said of two rows
        _ => None,
    }
}

/// The symbol of row `number` in a cell: θ3 in row 3, or θ without index.
fn own_symbol(cell: &TableCell, number: usize, letters: &[&str]) -> Option<String> {
    let index = number.to_string();
    letters.iter().find_map(|letter| {
        let own = |name: &str| {
            name.strip_prefix(letter).is_some_and(|i| i == index || i.is_empty() && *letter != "t")
        };
        cell.cell.symbols.iter().map(|s| &s.0).find(|n| own(n)).cloned()
    })
}
