//! What a header says: which column is what, in which unit.

use crate::description::cell::greek;
use crate::description::units::{Quantity, Unit, unit_named};
use denavit_symbolic::parse::subscript;

/// What a column holds.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Role {
    /// The number of the row or joint.
    Index,
    /// a(j): the row that this one stands on.
    After,
    /// μ: whether the joint has a motor.
    Motor,
    /// σ or the type: revolute or prismatic.
    Sigma,
    Theta,
    D,
    A,
    R,
    Alpha,
    Gamma,
    B,
    /// The name of the joint variable.
    Variable,
    /// An offset of the joint variable.
    Offset,
    Lower,
    Upper,
    Limits,
    /// The name of the joint.
    Name,
    /// Something else.
    Other,
}

impl Role {
    /// One of the letters of a Denavit–Hartenberg table.
    pub fn is_letter(self) -> bool {
        use Role::*;
        matches!(self, Theta | D | A | R | Alpha | Gamma | B)
    }

    /// The letter as robot files write it.
    pub fn letter(self) -> &'static str {
        match self {
            Role::Theta => "theta",
            Role::D => "d",
            Role::A => "a",
            Role::R => "r",
            Role::Alpha => "alpha",
            Role::Gamma => "gamma",
            Role::B => "b",
            _ => "",
        }
    }

    /// The role of a letter.
    pub fn of_letter(letter: &str) -> Option<Role> {
        [Role::Theta, Role::D, Role::A, Role::R, Role::Alpha, Role::Gamma, Role::B]
            .into_iter()
            .find(|r| r.letter() == letter)
    }
}

/// A column.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Column {
    pub role: Role,
    /// The index is that of the frame before: `a_{i-1}`.
    pub previous: bool,
    pub unit: Option<Unit>,
}

const WORDS: &[(&str, Role)] = &[
    ("", Role::Index),
    ("i", Role::Index),
    ("j", Role::Index),
    ("k", Role::Index),
    ("n", Role::Index),
    ("#", Role::Index),
    ("no", Role::Index),
    ("no.", Role::Index),
    ("nr", Role::Index),
    ("nr.", Role::Index),
    ("row", Role::Index),
    ("link", Role::Index),
    ("linki", Role::Index),
    ("joint", Role::Index),
    ("jointi", Role::Index),
    ("jointj", Role::Index),
    ("frame", Role::Index),
    ("axis", Role::Index),
    ("axe", Role::Index),
    ("achse", Role::Index),
    ("gelenk", Role::Index),
    ("articulation", Role::Index),
    ("articulación", Role::Index),
    ("articulacion", Role::Index),
    ("articulaçãoi", Role::Index),
    ("articulação", Role::Index),
    ("eslabón", Role::Index),
    ("eslabon", Role::Index),
    ("elo", Role::Index),
    ("junta", Role::Index),
    ("giunto", Role::Index),
    ("glied", Role::Index),
    ("corps", Role::Index),
    ("liaison", Role::Index),
    ("gewricht", Role::Index),
    ("as", Role::Index),
    ("schakel", Role::Index),
    ("braccio", Role::Index),
    ("art.", Role::Index),
    ("关节", Role::Index),
    ("连杆", Role::Index),
    ("body", Role::Index),
    ("type", Role::Sigma),
    ("jointtype", Role::Sigma),
    ("typ", Role::Sigma),
    ("r/p", Role::Sigma),
    ("var", Role::Variable),
    ("ant", Role::After),
    ("antj", Role::After),
    ("antecedent", Role::After),
    ("antécédent", Role::After),
    ("mu", Role::Motor),
    ("muj", Role::Motor),
    ("offset", Role::Offset),
    ("min", Role::Lower),
    ("lower", Role::Lower),
    ("lowerlimit", Role::Lower),
    ("qmin", Role::Lower),
    ("q-", Role::Lower),
    ("max", Role::Upper),
    ("upper", Role::Upper),
    ("upperlimit", Role::Upper),
    ("qmax", Role::Upper),
    ("q+", Role::Upper),
    ("limits", Role::Limits),
    ("limit", Role::Limits),
    ("range", Role::Limits),
    ("jointlimits", Role::Limits),
    ("name", Role::Name),
    ("jointname", Role::Name),
    // McKerrow's length of a link.
    ("l", Role::A),
    ("variable", Role::Variable),
    ("variables", Role::Variable),
    ("jointvariable", Role::Variable),
    ("variablei", Role::Variable),
    ("gelenkvariable", Role::Variable),
    ("variablearticulaire", Role::Variable),
    ("variablearticular", Role::Variable),
    ("variabiledigiunto", Role::Variable),
    ("linklength", Role::A),
    ("linktwist", Role::Alpha),
    ("twist", Role::Alpha),
    ("linkoffset", Role::D),
    ("jointangle", Role::Theta),
];

const LETTERS: &[(&str, Role)] = &[
    ("theta", Role::Theta),
    ("alpha", Role::Alpha),
    ("teta", Role::Theta),
    ("alfa", Role::Alpha),
    ("gamma", Role::Gamma),
    ("sigma", Role::Sigma),
    ("d", Role::D),
    ("a", Role::A),
    ("r", Role::R),
    ("b", Role::B),
    ("q", Role::Variable),
];

/// Reads the head of a column.
pub(super) fn column(text: &str) -> Column {
    if text.len() > 200 {
        return Column { role: Role::Other, previous: false, unit: None };
    }
    // Khalil's a(j) is no length.
    if text.len() < 20
        && text.contains('(')
        && ["a(j)", "a(i)"]
            .contains(&text.replace(['$', ' ', '*', '{', '}', '_'], "").to_lowercase().as_str())
    {
        return Column { role: Role::After, previous: false, unit: None };
    }
    let (head, unit, qualifier) = split_unit(text);
    let (mut role, mut previous) = symbol(&plain(head));
    if role == Role::Other {
        // `Verdrehung α_i`, `θ_i angle`: a letter beside words.
        let words = || head.split([' ', '~']).filter(|w| !w.trim_matches(['$', ',', '.']).is_empty());
        let mut beside =
            [words().next_back(), words().next()].into_iter().flatten().map(|w| symbol(&plain(w)));
        let letter = beside.find(|s| s.0.is_letter() && words().count() > 1);
        if let Some(letter) = letter.filter(|_| words().count() <= 4) {
            (role, previous) = letter;
        } else if words().count() <= 5
            && words().any(|w| plain(w) == "offset")
            && words().any(|w| {
                matches!(symbol(&plain(w)).0, Role::Theta | Role::Variable)
                    || matches!(plain(w).as_str(), "angle" | "angular" | "variable")
            })
        {
            role = Role::Offset; // `offset added to q`; a joint's or a link's is a length
        }
    }
    if let (Role::Other, Some(inside)) = (role, &qualifier) {
        (role, previous) = symbol(&plain(inside)); // link offset (d)
    } else if role == Role::Variable && qualifier.is_some() {
        role = Role::Other; // q (figure): a configuration, not the variable
    }
    Column { role, previous, unit }
}

/// A unit that stands alone in brackets, as in a row of units below the header.
pub(super) fn lone_unit(text: &str) -> Option<Unit> {
    let (head, unit, _) = split_unit(text);
    if plain(head).is_empty() { unit } else { None }
}

/// The head without its unit, the unit, and other words in brackets.
fn split_unit(text: &str) -> (&str, Option<Unit>, Option<String>) {
    let text = text.trim();
    let inner = text.trim_end_matches(['$', ' ', '*']);
    for (open, close) in [('(', ')'), ('[', ']')] {
        if let Some(body) = inner.strip_suffix(close)
            && let Some(at) = body.rfind(open)
        {
            let inside = body[at + 1..].to_string();
            return match unit(&inside) {
                Some(unit) => (&text[..at], Some(unit), None),
                None if inside.trim().is_empty() || plain(&inside).ends_with("-1") => (text, None, None),
                None => (&text[..at], None, Some(inside)),
            };
        }
    }
    for separator in [" in ", "/", ","] {
        if let Some((head, tail)) = inner.rsplit_once(separator)
            && let Some(unit) = unit(tail)
        {
            return (head, Some(unit), None);
        }
    }
    (text, None, None)
}

/// `mm`, `°`, `$^\circ$`, `\text{deg}`
fn unit(text: &str) -> Option<Unit> {
    let bare = text.replace("\\circ", "°").replace(['$', '{', '}', '^', '\\', ' '], "");
    let bare =
        ["mathrm", "text", "rm", "si"].iter().fold(bare.as_str(), |t, p| t.strip_prefix(p).unwrap_or(t));
    let bare = if bare.eq_ignore_ascii_case("deg.") { "deg" } else { bare };
    unit_named(&bare.to_lowercase())
        .or_else(|| unit_named(bare))
        .filter(|u| matches!(u.quantity, Quantity::Angle | Quantity::Length))
}

/// A head in plain letters: `$\boldsymbol{\alpha}_{i-1}$` is `alphai-1`.
pub(super) fn plain(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '$' | '{' | '}' | '*' | '\\' | '`' | '_' | '(' | ')' | '~' | ':' | '^' => {}
            '−' | '–' | '‐' | '-' => out.push('-'),
            c if c.is_whitespace() => {}
            c => match (greek(c), subscript(c)) {
                (Some(name), _) => out.push_str(name),
                (None, Some(plain)) => out.push(plain),
                (None, None) => out.extend(c.to_lowercase()),
            },
        }
    }
    loop {
        let looks = [
            "boldsymbol",
            "oldsymbol",
            "mathrm",
            "mathbf",
            "mathit",
            "textbf",
            "textit",
            "text",
            "overline",
            "bar",
            "bf",
        ];
        match looks.iter().find_map(|p| out.strip_prefix(p).filter(|rest| !rest.is_empty())) {
            Some(rest) => out = rest.to_string(),
            None => break,
        }
    }
    if let Some(rest) = out.strip_prefix("var").filter(|r| r.starts_with("theta") || r.starts_with("alpha")) {
        out = rest.to_string(); // `\vartheta`
    }
    if out.starts_with("heta") {
        out.insert(0, 't'); // the scan took `\t` for a tab
    }
    for look in ["mathrm", "text", "rm"] {
        out = out.replace(look, "");
    }
    out
}

/// The role of a head in plain letters, and whether its index is that of the frame before.
fn symbol(plain: &str) -> (Role, bool) {
    if let Some(&(_, role)) = WORDS.iter().find(|w| w.0 == plain) {
        return (role, false);
    }
    for &(letter, role) in LETTERS {
        if let Some(index) = plain.strip_prefix(letter) {
            let index = index.trim_start_matches(',');
            match index {
                "" | "i" | "j" | "k" | "n" => return (role, false),
                "i-1" | "j-1" | "k-1" | "n-1" | "prev" | "previous" => return (role, true),
                _ => {}
            }
        }
    }
    (Role::Other, false)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heads_of_columns() {
        for (head, role, previous, unit) in [
            ("θ", Role::Theta, false, ""),
            ("$oldsymbol{ heta}$", Role::Theta, false, ""),
            ("Θ_j", Role::Theta, false, ""),
            ("θ_j", Role::Theta, false, ""),
            ("$\\theta_i$ (deg)", Role::Theta, false, "deg"),
            ("α_j", Role::Alpha, false, ""),
            ("$\\alpha_{i-1}$", Role::Alpha, true, ""),
            ("⍺ⱼ₋₁", Role::Alpha, true, ""),
            ("a_{i−1} [mm]", Role::A, true, "mm"),
            ("a(i-1)", Role::A, true, ""),
            ("alpha_prev", Role::Alpha, true, ""),
            ("α [°]", Role::Alpha, false, "°"),
            ("$\\alpha$ ($^\\circ$)", Role::Alpha, false, "°"),
            ("d/mm", Role::D, false, "mm"),
            ("r in mm", Role::R, false, "mm"),
            ("link offset (d)", Role::D, false, ""),
            ("d (offset)", Role::D, false, ""),
            ("$\\sigma_j$", Role::Sigma, false, ""),
            ("$\\overline{q}$", Role::Variable, false, ""),
            ("$q_i(figure)$", Role::Other, false, ""),
            ("J", Role::Index, false, ""),
            ("", Role::Index, false, ""),
            ("Link $i$", Role::Index, false, ""),
            ("\\textbf{Joint}", Role::Index, false, ""),
            ("offset added to q", Role::Offset, false, ""),
            ("joint offset", Role::Other, false, ""),
            ("axis offset", Role::Other, false, ""),
            ("offset along z", Role::Other, false, ""),
            ("mass", Role::Other, false, ""),
            ("R", Role::R, false, ""),
        ] {
            let found = column(head);
            assert_eq!(
                (found.role, found.previous, found.unit),
                (role, previous, unit_named(unit)),
                "{head}"
            );
        }
    }
}
