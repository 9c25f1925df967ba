//! The convention of a table, and which column is the length along x and along z in it.

use super::TableOptions;
use super::columns::{Column, Role, plain};
use super::layout::Layout;
use super::lines::Lines;
use super::said::convention_said;
use crate::description::Convention;
use crate::description::diagnostic::{Diagnostics, nearest};

/// The convention, and its columns.
#[derive(Clone, Debug)]
pub(super) struct Letters {
    pub convention: Convention,
    /// The length along x, if there is such a column.
    pub x: Option<Role>,
    /// The length along z.
    pub z: Option<Role>,
}

/// What every choice means, for who has to make it.
const CHOICES: &str = "add the line `convention: standard` (Rz(θ)·Tz(d)·Tx(a)·Rx(α)), `convention: craig` \
     (Rx(α)·Tx(a)·Rz(θ)·Tz(d)) or `convention: khalil` (Rx(α)·Tx(d)·Rz(θ)·Tz(r)), or give it as an option";

/// The letters that the user gives the columns, from left to right.
pub(super) fn told_letters(
    lines: &Lines,
    at: usize,
    options: &TableOptions,
    out: &mut Diagnostics,
) -> Option<Vec<Role>> {
    let line = lines.get("columns", at);
    let told = options.columns.as_deref().or(line.map(|l| l.text.as_str()))?;
    let mut roles = vec![];
    for name in told.split([' ', ',', '\t']).filter(|n| !n.is_empty()) {
        let Some(role) = Role::of_letter(&plain(name)) else {
            let span = line.filter(|_| options.columns.is_none()).map_or(at..at, |l| l.span.clone());
            let shown: String = name.chars().take(20).collect();
            out.error(span, format!("`{shown}` is no column of a table")).hint(
                "columns: theta, d, a, alpha (and r, gamma, b in Khalil's letters), from left to right",
            );
            return None;
        };
        roles.push(role);
    }
    Some(roles)
}

/// The columns of a layout with the letters that the user gives them.
pub(super) fn columns(
    layout: &Layout,
    lines: &Lines,
    options: &TableOptions,
    out: &mut Diagnostics,
) -> Option<Vec<Column>> {
    let mut columns = layout.columns.clone();
    let at = layout.span.start;
    if layout.told || options.columns.is_none() && lines.get("columns", at).is_none() {
        return Some(columns);
    }
    let roles = told_letters(lines, at, options, out)?;
    let letters: Vec<&mut Column> = columns.iter_mut().filter(|c| c.role.is_letter()).collect();
    if letters.len() != roles.len() {
        let line = lines.get("columns", at).filter(|_| options.columns.is_none());
        let span = line.map_or(layout.span.clone(), |l| l.span.clone());
        let verb = if roles.len() == 1 { "column is" } else { "columns are" };
        out.error(span, format!("{} {verb} named, the table has {}", roles.len(), letters.len()))
            .hint("name the columns θ, d, a, α, r from left to right, without numbers and types");
        return None;
    }
    letters.into_iter().zip(roles).for_each(|(column, role)| column.role = role);
    Some(columns)
}

/// The convention that is told by an option or a line, that the columns force, or that the text names in its words.
pub(super) fn convention(
    text: &str,
    layout: &Layout,
    columns: &[Column],
    lines: &Lines,
    options: &TableOptions,
    out: &mut Diagnostics,
) -> Option<Convention> {
    let has = |role| columns.iter().any(|c| c.role == role);
    let previous = columns.iter().any(|c| c.previous && matches!(c.role, Role::A | Role::Alpha | Role::D));
    let line = lines.get("convention", layout.span.start);
    let told = match (options.convention, line) {
        (Some(convention), _) => Some(convention),
        (None, Some(line)) => {
            let name = line.text.to_lowercase();
            let known = Convention::ALL.into_iter().find(|c| c.name() == name);
            if known.is_none() {
                let near = nearest(&name, Convention::ALL.map(Convention::name));
                let hint = near.map_or(CHOICES.to_string(), |n| format!("did you mean `convention: {n}`?"));
                out.error(line.span.clone(), "unknown convention").hint(hint);
                return None;
            }
            known
        }
        (None, None) => None,
    };
    let head = layout.head();
    let khalil_only = has(Role::Gamma) || has(Role::B);
    match told {
        Some(Convention::Standard) if previous => {
            out.error(head, "the index i-1 of α or a does not go with the standard convention")
                .hint("rows that begin with the x axis of the frame before are `craig` or, with r, `khalil`");
            None
        }
        Some(convention) => Some(convention),
        None if khalil_only || previous && has(Role::R) => {
            let why = if khalil_only {
                "γ and b are Khalil's"
            } else {
                "the index i-1 and the length r are Khalil's"
            };
            out.note(head, format!("read as khalil: {why}"));
            Some(Convention::Khalil)
        }
        None if previous && has(Role::D) => {
            out.note(
                head,
                "read as craig: with α_{i-1} or a_{i-1} a row begins with the x axis of the frame before",
            );
            Some(Convention::Craig)
        }
        None => {
            if let Some((convention, place)) = convention_said(text) {
                out.note(place, format!("read as {convention}: the text says so"));
                return Some(convention);
            }
            let what = if has(Role::R) && has(Role::D) && !has(Role::A) {
                "the convention is not said: θ, d, r, α are Khalil's letters, but others write r for the length along x"
            } else {
                "the convention is not said, and the columns do not tell"
            };
            out.error(head, what).hint(CHOICES);
            None
        }
    }
}

/// No letter stands over two columns.
pub(super) fn check_letters(layout: &Layout, columns: &[Column], out: &mut Diagnostics) -> Option<()> {
    for (i, column) in columns.iter().enumerate() {
        if column.role.is_letter() && columns[..i].iter().any(|c| c.role == column.role) {
            let span = layout.heads[i].span.clone();
            out.error(span, format!("a second column `{}`", column.role.letter()));
            return None;
        }
    }
    Some(())
}

/// The lengths along x and z in a convention.
pub(super) fn letters(
    layout: &Layout,
    columns: &[Column],
    convention: Convention,
    out: &mut Diagnostics,
) -> Option<Letters> {
    let has = |role| columns.iter().any(|c| c.role == role);
    let head = layout.head();
    let lengths = (has(Role::A), has(Role::D), has(Role::R));
    let (a, d, r) = (Some(Role::A), Some(Role::D), Some(Role::R));
    let (x, z) = match (convention, lengths) {
        (Convention::Khalil, (false, x, z)) => (d.filter(|_| x), r.filter(|_| z)),
        (Convention::Khalil, (true, false, true)) => (a, r),
        (Convention::Standard | Convention::Craig, (x, z, false)) => (a.filter(|_| x), d.filter(|_| z)),
        (Convention::Standard | Convention::Craig, (true, false, true)) => (a, r),
        (Convention::Standard, (false, true, true)) => (r, d),
        _ => {
            let hint = match convention {
                Convention::Khalil => {
                    "a and d are Craig's letters for the same product: say `convention: craig`".to_string()
                }
                Convention::Craig if !lengths.0 => "d and r are Khalil's letters for the same product: say \
                     `convention: khalil`, or name the columns: `columns: …`"
                    .to_string(),
                _ => {
                    "name the columns from left to right with the line `columns: theta alpha a d`".to_string()
                }
            };
            out.error(head, format!("the lengths of this table do not go with the {convention} convention"))
                .hint(hint);
            return None;
        }
    };
    for (role, native, axis) in [(x, convention.length_x(), "x"), (z, convention.length_z(), "z")] {
        if let Some(role) = role.filter(|r| r.letter() != native) {
            let message = format!(
                "the column {} is the length along {axis}, `{native}` of the {convention} convention",
                role.letter()
            );
            out.note(head.clone(), message);
        }
    }
    Some(Letters { convention, x, z })
}
