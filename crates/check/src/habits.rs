//! How a document writes a pose, and what it means by names that may mean several things.

use super::inverse::rebuilt;
use super::names::{Token, tokens};
use denavit::geometry::{Rotation, Transform, Vector};
use denavit_reading::document::{Document, Part, Side};
use denavit_symbolic::parse::{Function, Syntax, SyntaxKind};
use denavit_symbolic::vocabulary::plain_name;
use denavit_symbolic::{Expr, Node, Symbol};
use std::collections::BTreeSet;

/// Values with each choice of the signs that a document names: ε = ±1.
pub(super) fn with_named_signs(values: Vec<Expr>) -> Vec<Expr> {
    let is_sign = |s: &Symbol| s.name().strip_prefix(SIGN).is_some_and(|n| !n.contains(' '));
    let mut signs: Vec<Symbol> = values.iter().flat_map(|e| e.symbols()).filter(is_sign).collect();
    signs.sort_by_key(|s| s.name().to_string());
    signs.dedup();
    signs.into_iter().fold(values, |all, sign| {
        let is_used = all.iter().any(|e| e.symbols().contains(&sign));
        if !is_used || all.len() > MAX_SIGNED {
            return all;
        }
        let chosen = |n: i64| move |e: &Expr| e.substitute(|s| (s == sign).then(|| Expr::int(n)));
        all.iter().map(chosen(1)).chain(all.iter().map(chosen(-1))).collect()
    })
}

/// The names of signs that a text has, `ε = ±1`, `κ_2 = \pm 1`, `σ = +1 if …, σ = −1 otherwise`, each with what stands for it.
pub(super) fn named_signs(plain: &str) -> Vec<(String, Expr)> {
    let told = |said: &[&str]| -> Vec<String> {
        let places = said.iter().flat_map(|said| plain.match_indices(said));
        let names = places.filter_map(|(at, said)| {
            let rest = &plain[at + said.len()..];
            let rest = rest.strip_prefix('.').unwrap_or(rest);
            let goes_on = rest.starts_with(|c: char| c.is_ascii_digit());
            sign_before(&plain[..at]).filter(|_| !goes_on)
        });
        names.collect()
    };
    let (plus, minus) = (told(&["=+1"]), told(&["=-1", "=−1"]));
    let either = plus.into_iter().filter(|name| minus.contains(name));
    let mut found: Vec<(String, Expr)> = vec![];
    for name in told(&["=±1", "=pm1"]).into_iter().chain(either) {
        if found.iter().all(|f| f.0 != name) {
            let sign = Expr::symbol(&format!("{SIGN}{name}"));
            found.push((name, sign));
        }
    }
    found
}

/// What stands for a sign under a name.
pub(super) fn named_sign(name: &str) -> Expr {
    Expr::symbol(&format!("{SIGN}{name}"))
}

/// True for a sign that the document names.
pub(super) fn is_named_sign(e: Expr) -> bool {
    e.as_symbol().is_some_and(|s| s.name().strip_prefix(SIGN).is_some_and(|n| !n.contains(' ')))
}

/// The name of a sign at the end of a text: a letter that is customary for signs, with its number.
fn sign_before(text: &str) -> Option<String> {
    let stem = text.trim_end_matches(|c: char| c.is_ascii_digit());
    let letter =
        SPELLED.iter().find(|s| stem.ends_with(s.0)).map(|s| s.1).or_else(|| stem.chars().next_back());
    let letter = letter.filter(|c| SIGNS.contains(c))?;
    Some(format!("{letter}{}", &text[stem.len()..]))
}

/// What the symbol of a sign begins with.
const SIGN: &str = "sign ";
/// So many values are given each choice of one more sign.
const MAX_SIGNED: usize = 16;
/// Letters for signs.
const SIGNS: [char; 8] = ['ε', 'σ', 'κ', 'δ', 'λ', 'k', 'e', 's'];
/// Those of them that LaTeX spells.
const SPELLED: [(&str, char); 5] =
    [("epsilon", 'ε'), ("sigma", 'σ'), ("kappa", 'κ'), ("delta", 'δ'), ("lambda", 'λ')];
/// The axes of coordinates.
const AXES: [&str; 3] = ["x", "y", "z"];

/// The letters of a pose's columns.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Columns {
    /// n, o, a, p
    Noap,
    /// s, n, a, P
    Snap,
    /// n, s, a, o: the place of the hand is o.
    Nsao,
    /// n, s, a, p
    Nsap,
}

impl Columns {
    pub fn letters(self) -> [&'static str; 4] {
        match self {
            Columns::Noap => ["n", "o", "a", "p"],
            Columns::Snap => ["s", "n", "a", "p"],
            Columns::Nsao => ["n", "s", "a", "o"],
            Columns::Nsap => ["n", "s", "a", "p"],
        }
    }

    /// Those that a text uses.
    pub fn of(text: &str) -> Self {
        // `o = (o_x, o_y, o_z)` is a place where there are no other letters for one.
        let is_place = plain_name(text).contains("(ox,oy,oz)");
        if is_place && !['n', 's', 'p', 'P'].iter().any(|&c| has_component(text, c)) {
            return Columns::Nsao;
        }
        if let Some(told) = told_order(text) {
            return told;
        }
        if has_component(text, 'o') || !has_component(text, 's') { Columns::Noap } else { Columns::Snap }
    }
}

/// The order in which a text names the columns of a pose one after another: `R = [n s a]`, `s, n, a, P`; nothing where it
/// names several.
fn told_order(text: &str) -> Option<Columns> {
    const LONGEST: usize = 400;
    let mut found = None;
    for line in text.lines().filter(|l| l.len() < LONGEST && l.contains(['n', 'N'])) {
        // Commands change looks alone: `{\boldsymbol n}\ {\boldsymbol s}`.
        let mut letters: Vec<char> = vec![];
        let mut rest = line;
        while let Some(c) = rest.chars().next() {
            let length = match c {
                '\\' => 1 + rest[1..].chars().take_while(char::is_ascii_alphabetic).count(),
                c if c.is_alphanumeric() || c == '_' => {
                    let word: String =
                        rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
                    letters.push(word.chars().next().filter(|_| word.chars().count() == 1).unwrap_or('.'));
                    word.len()
                }
                // In a frame: `n^3`.
                '^' => {
                    let index = rest[1..].strip_prefix('{').unwrap_or(&rest[1..]);
                    let digits = index.chars().take_while(char::is_ascii_digit).count();
                    let braces = if rest[1..].starts_with('{') { 1 } else { 0 };
                    1 + braces + digits
                }
                // `n + s + a` is no list.
                ' ' | ',' | '$' | '{' | '}' | '[' | ']' | '(' | ')' | '&' | '|' | ';' => 1,
                c => {
                    letters.push('.');
                    c.len_utf8()
                }
            };
            rest = &rest[length..];
        }
        for window in letters.windows(3) {
            let told = match window {
                ['n', 'o', 'a'] => Columns::Noap,
                ['s', 'n', 'a'] => Columns::Snap,
                ['n', 's', 'a'] => Columns::Nsap,
                _ => continue,
            };
            if found.is_some_and(|other| other != told) {
                return None;
            }
            found = Some(told);
        }
    }
    found
}

/// True if a text has the first component of a vector: `s_x`, `s_{x}`, `sx` as a word of its own.
fn has_component(text: &str, letter: char) -> bool {
    text.match_indices(letter).any(|(at, _)| {
        let is_alone = !text[..at].ends_with(|c: char| c.is_alphanumeric() || matches!(c, '\\' | '_'));
        let behind = text[at + letter.len_utf8()..].trim_start_matches(['_', '{', '}']);
        let after = behind.strip_prefix(['x', '\u{2093}']);
        is_alone && after.is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_'))
    })
}

/// The symbol of an entry of the pose in inverse formulas, row and column from 0.
pub(super) fn pose_symbol(columns: Columns, row: usize, column: usize) -> Symbol {
    Symbol::new(&format!("{}{}", columns.letters()[column], AXES[row]))
}

/// The entries of the pose as symbols.
#[derive(Clone, Copy, Debug)]
pub(super) struct Places(pub Columns);

impl Places {
    /// The symbol of an entry, row and column from 0.
    pub fn symbol(&self, row: usize, column: usize) -> Symbol {
        pose_symbol(self.0, row, column)
    }

    /// The pose with its entries as symbols.
    pub fn pose(&self) -> Transform<Expr> {
        let entry = |r: usize, c: usize| Expr::from(self.symbol(r, c));
        let rows = [0, 1, 2].map(|r| [0, 1, 2].map(|c| entry(r, c)));
        let position = Vector([0, 1, 2].map(|r| entry(r, 3)));
        Transform::from_rotation_translation(Rotation::from_rows(rows), position)
    }
}

/// What a document means by names that may mean several things.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Habits {
    /// The letters of the pose's columns.
    pub columns: Columns,
    /// Lengths without a unit may be in millimetres.
    pub millimetres: bool,
    /// The unit of lengths is a millimetre, in the robot and in what is printed.
    pub scaled: bool,
    /// A number behind `T` is that of a link, not of a frame in the base.
    pub links: bool,
    /// The left index is the frame, the right one that in which it is seen.
    pub exchanged: bool,
    /// Frame 0 is the base that the robot's file has in front of its table.
    pub zero_is_base: bool,
    /// r_ij are the entries of frame 6 in frame 3.
    pub wrist_entries: bool,
    /// `atan2` has the cosine first.
    pub cosine_first: bool,
    /// The arctangent of a fraction takes the signs of both parts, as the text says.
    pub arctan_of_both: bool,
    /// A load on the hand that has a letter of its own: `W`, its axis, and whether it points against it.
    pub load: Option<(char, usize, bool)>,
    /// The components of a load are those along the axes of the hand.
    pub load_in_hand: bool,
    /// The torques of the joints hold against the load.
    pub against_load: bool,
    /// P_i is the place of the hand seen from frame i.
    pub hand_in_frames: bool,
    /// Velocities are those of the Jacobian that was printed last: of its point, along its axes.
    pub velocities_of_jacobian: bool,
    /// Names that are helpers, not entries of the pose.
    pub helpers: BTreeSet<String>,
    /// Names of matrices that the document defines as products, `T_2 = A_4 A_5`.
    pub products: BTreeSet<String>,
}

impl Habits {
    /// The first readings.
    pub fn of(text: &str) -> Self {
        Habits {
            columns: Columns::of(text),
            millimetres: false,
            scaled: false,
            links: false,
            exchanged: false,
            zero_is_base: false,
            wrist_entries: false,
            cosine_first: false,
            arctan_of_both: tells_both_signs(text),
            velocities_of_jacobian: false,
            load: None,
            load_in_hand: false,
            against_load: false,
            hand_in_frames: false,
            helpers: BTreeSet::new(),
            products: BTreeSet::new(),
        }
    }

    /// A formula with the arguments of `atan2` in the order that is read: the sine first.
    pub fn ordered(&self, syntax: Syntax) -> Syntax {
        let syntax = if self.cosine_first { exchanged(syntax) } else { syntax };
        if self.arctan_of_both { changed(syntax, &mut of_both) } else { syntax }
    }

    /// A formula as the document would print it.
    pub fn printed(&self, e: Expr) -> Expr {
        let exchange = |was: Expr, now: Expr| match (was.node(), now.node()) {
            (Node::Atan2(..), Node::Atan2(y, x)) => x.atan2(y),
            _ => now,
        };
        if self.cosine_first { rebuilt(e, &mut { exchange }) } else { e }
    }

    /// Takes the names that a document defines as products for its own.
    pub fn with_products(mut self, text: &str, document: &Document) -> Self {
        for statement in &document.statements {
            let names = |side: &Side| match &side.parts[..] {
                [Part::Text(span)] => tokens(text, span, &|_| false).unwrap_or_default(),
                _ => vec![],
            };
            let Some((first, rest)) = statement.sides.split_first() else { continue };
            let [Token::Name(name)] = &names(first)[..] else { continue };
            let is_single =
                name.base == "T" && name.left.is_empty() && name.sup.is_empty() && name.sub.len() == 1;
            let is_product = |side: &Side| {
                let found = names(side);
                let is_other = |t: &Token| matches!(t, Token::Name(n) if n.base != "T" || n.sub != name.sub);
                found.len() > 1 && found.iter().all(is_other)
            };
            if is_single && rest.iter().any(is_product) {
                self.products.insert(name.key());
            }
        }
        self
    }
}

/// A formula with the arguments of each `atan2` exchanged.
fn exchanged(syntax: Syntax) -> Syntax {
    changed(syntax, &mut |kind| match kind {
        SyntaxKind::Call(Function::Atan2, arguments) => {
            SyntaxKind::Call(Function::Atan2, arguments.into_iter().rev().collect())
        }
        other => other,
    })
}

/// The arctangent of a fraction as that of both its parts.
fn of_both(kind: SyntaxKind) -> SyntaxKind {
    let SyntaxKind::Call(Function::Arctan, arguments) = &kind else { return kind };
    let [argument] = &arguments[..] else { return kind };
    let mut inner = argument;
    while let SyntaxKind::Bracket(next) = &inner.kind {
        inner = next;
    }
    let both = match &inner.kind {
        SyntaxKind::Fraction(a, b) => Some([(**a).clone(), (**b).clone()]),
        SyntaxKind::Product(factors) => match &factors[..] {
            [(false, a), (true, b)] => Some([a.clone(), b.clone()]),
            _ => None,
        },
        _ => None,
    };
    match both {
        Some(both) => SyntaxKind::Call(Function::Atan2, both.into()),
        None => kind,
    }
}

/// True for a text that says that its arctangents are those of the right quadrant.
fn tells_both_signs(text: &str) -> bool {
    const PHRASES: [&str; 16] = [
        "signs of numerator",
        "sign of numerator",
        "signs of the numerator",
        "sign of the numerator",
        "signs of both",
        "four-quadrant",
        "four quadrant",
        "correct quadrant",
        "right quadrant",
        "proper quadrant",
        "appropriate quadrant",
        "richtigen quadranten",
        "vorzeichen von zähler",
        "bon quadrant",
        "cuadrante correcto",
        "quadrante corretto",
    ];
    let lower = text.split_whitespace().collect::<Vec<_>>().join(" ").to_lowercase();
    PHRASES.iter().any(|p| lower.contains(p))
}

/// A formula with each of its parts changed, from within.
fn changed(syntax: Syntax, change: &mut dyn FnMut(SyntaxKind) -> SyntaxKind) -> Syntax {
    let Syntax { kind, span } = syntax;
    let kind = match kind {
        SyntaxKind::Call(f, arguments) => {
            SyntaxKind::Call(f, arguments.into_iter().map(|s| changed(s, change)).collect())
        }
        SyntaxKind::Sum(terms) => {
            SyntaxKind::Sum(terms.into_iter().map(|(sign, s)| (sign, changed(s, change))).collect())
        }
        SyntaxKind::Product(factors) => {
            SyntaxKind::Product(factors.into_iter().map(|(over, s)| (over, changed(s, change))).collect())
        }
        SyntaxKind::Fraction(a, b) => {
            SyntaxKind::Fraction(Box::new(changed(*a, change)), Box::new(changed(*b, change)))
        }
        SyntaxKind::Power(a, n) => SyntaxKind::Power(Box::new(changed(*a, change)), n),
        SyntaxKind::Root(a) => SyntaxKind::Root(Box::new(changed(*a, change))),
        SyntaxKind::Bracket(a) => SyntaxKind::Bracket(Box::new(changed(*a, change))),
        SyntaxKind::Name(_) | SyntaxKind::Number(_) => kind,
    };
    Syntax { kind: change(kind), span }
}
