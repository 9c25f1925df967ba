//! Where the arm is said to be singular: the value of a joint, a sine, or a formula that is zero there.

use super::cases::NEAR;
use super::{Assertion, Pair, Piece, Scalar, Walk};
use crate::facts::About;
use crate::note::Unreadable;
use denavit::description::JointKind;
use denavit_reading::document::Statement;
use denavit_symbolic::{Expr, Node, Symbol, equal};
use std::ops::Range;

/// True if the words before a place speak of where the arm is singular.
pub(in super::super) fn speaks_of_singularity(text: &str, at: usize) -> bool {
    let before = text.get(..at).unwrap_or_default();
    let start = before.char_indices().rev().take(NEAR).last().map_or(0, |c| c.0);
    let before = before[start..].to_lowercase();
    VANISHING.iter().chain(&DETERMINANTS).any(|w| before.contains(w)) && !is_denied(&before)
}

/// A determinant speaks of what stands so many bytes behind it.
const BEHIND: usize = 200;
/// The longest paragraph whose words are looked at, in bytes.
const PARAGRAPH: usize = 600;

impl Walk<'_> {
    /// Where the arm is said to be singular: `singular for θ3 = 0`, `a_2 c_2 + a_3 c_{23} = 0` behind a determinant. False
    /// where nothing says so, or where words only stand near and it is not so.
    pub(super) fn singular(&mut self, statement: &Statement, read: &[Scalar]) -> bool {
        let [Scalar::Formula(_, left), Scalar::Formula(span, right)] = read else { return false };
        let (of, value) = (left.value(), right.value());
        let joints = self.subject.joints();
        let is_still = |e: Expr| e.symbols().iter().all(|s| !joints.contains(&(*s).into()));
        let joint = of.as_symbol().filter(|s| joints.contains(&(*s).into()));
        match joint {
            Some(joint) if is_still(value) => {
                // A rounded angle is where the determinant vanishes as nearly as it is printed.
                if self.source(span).contains('.') || self.denies(statement) {
                    return false;
                }
                let says = self.says_singular(statement);
                if !says && !self.may_say_singular(statement) {
                    return false;
                }
                if let Some(there) = self.subject.singular_at(joint, value) {
                    self.singular_there(statement, span, [there, Expr::int(0)]);
                    if !says {
                        // It may be a configuration as well.
                        let spans: Vec<Range<usize>> =
                            statement.sides.iter().map(|s| s.span.clone()).collect();
                        self.configuration(&spans, read);
                    }
                    return true;
                }
                // Words that only stand near accuse nothing, nor do lengths of which the table has none.
                let whole = self.subject.determinants().first().copied();
                let Some(whole) = whole.filter(|_| says && value.symbols().is_empty()) else { return false };
                let there = whole.substitute(|s| (s == joint).then_some(value));
                self.singular_there(statement, span, [there, Expr::int(0)]);
                true
            }
            None if value.is_zero() && !is_still(of) && !equal(of, value).is_equal() => {
                let says = self.says_singular(statement) || self.may_say_singular(statement);
                let there = || self.subject.singular_where(of);
                let Some(sides) = says.then(there).flatten() else { return false };
                self.singular_there(statement, span, sides);
                true
            }
            _ => false,
        }
    }

    /// Keeps a claim that the arm is singular somewhere: the sides are equal if it is so.
    fn singular_there(&mut self, statement: &Statement, span: &Range<usize>, [value, wanted]: [Expr; 2]) {
        let pair = Pair { place: None, span: span.clone(), printed: None, value, wanted, also: vec![] };
        let assertion = self.assertion(statement, About::Singularity);
        self.assertions.push(Assertion { pieces: vec![Piece::Pair(pair)], ..assertion });
    }

    /// True where the words right before a statement deny it: `not for t3 = 0 but for t3 = -b`.
    fn denies(&self, statement: &Statement) -> bool {
        const FEW: usize = 16;
        const NOT: [&str; 6] = ["not for", "nicht für", "pas pour", "no para", "non per", "niet voor"];
        let before = self.text.get(..statement.span.start).unwrap_or_default();
        let before = before.trim_end_matches([' ', '$', '\n']);
        let start = before.char_indices().rev().take(FEW).last().map_or(0, |c| c.0);
        let words = before[start..].to_lowercase();
        NOT.iter().any(|n| words.ends_with(n))
    }

    /// True for a statement in a sentence, or a list, that says that the arm is singular there.
    fn says_singular(&self, statement: &Statement) -> bool {
        let said = statement.prose.clone().and_then(|p| self.text.get(p)).unwrap_or_default().to_lowercase();
        self.is_case(statement) && is_singular(&said) || self.is_in_list_of_singular(statement)
    }

    /// True for a statement beside words of singularity, or right behind a determinant.
    fn may_say_singular(&self, statement: &Statement) -> bool {
        let (start, end) = (statement.span.start, statement.span.end);
        let before = self.text.get(..start).unwrap_or_default();
        let mut from = start.saturating_sub(PARAGRAPH);
        while !before.is_char_boundary(from) {
            from += 1;
        }
        let before = &before[from..];
        let own = before.rsplit("\n\n").next().unwrap_or_default();
        // A formula on lines of its own goes with the sentence above that is not at its end.
        let above = match own.trim().len() < 4 {
            true => before[..before.len() - own.len()].trim_end().rsplit("\n\n").next().unwrap_or_default(),
            false => "",
        };
        let above = if above.trim_end().ends_with('.') { "" } else { above };
        let behind = self.text.get(end..).unwrap_or_default();
        let behind = behind.split(['\n', '.', ';']).next().unwrap_or_default();
        let lead = self.lead_of_list(statement).unwrap_or_default();
        let words = [&lead, above, own, behind].join(" ").to_lowercase();
        let is_behind_determinant = self.assertions.last().is_some_and(|a| {
            let said = self.source(&a.span).to_lowercase();
            ["det", "|j"].iter().any(|w| said.contains(w))
                && (a.span.end..a.span.end + BEHIND).contains(&start)
        });
        !is_denied(&words) && (is_behind_determinant || VANISHING.iter().any(|w| words.contains(w)))
    }

    /// `sin θ2 = −e/d3`, of no pose: where something is so, as singular. True if it is no identity; then it is a claim only if
    /// the arm is singular there.
    pub(super) fn is_sine_there(&mut self, statement: &Statement, read: &[Scalar]) -> bool {
        let [Scalar::Formula(_, left), Scalar::Formula(span, right)] = read else { return false };
        let (sine, value) = (left.value(), right.value());
        let (Node::Sin(angle) | Node::Cos(angle)) = sine.node() else { return false };
        let Some(joint) = angle.as_symbol().filter(|s| self.subject.joints().contains(&(*s).into())) else {
            return false;
        };
        let d = &self.subject.description;
        let symbols = value.symbols();
        // `s_1 = sin θ2` is a slip of an index.
        let slides =
            |s: &Symbol| d.variables().iter().any(|v| v.symbol == *s && v.kind == JointKind::Prismatic);
        let is_known = |s: &Symbol| d.parameter(*s).is_some() || slides(s);
        if symbols.is_empty()
            || !symbols.iter().all(is_known)
            || self.speaks_of_pose(span)
            || equal(sine, value).is_equal()
        {
            return false;
        }
        let other = (Expr::int(1) - value.powi(2)).sqrt();
        let there = match sine.node() {
            Node::Sin(_) => value.atan2(other),
            _ => other.atan2(value),
        };
        let is_told = speaks_of_singularity(self.text, statement.span.start);
        let singular = self.subject.singular_at(joint, there).filter(|_| is_told);
        match singular {
            Some(value) => self.singular_there(statement, span, [value, Expr::int(0)]),
            None => self.skipped.push((statement.span.clone(), Unreadable::NoConfiguration)),
        }
        true
    }

    /// True for an item of a list whose lead says that the arm is singular: `Two families of singular configurations follow.`
    fn is_in_list_of_singular(&self, statement: &Statement) -> bool {
        self.lead_of_list(statement).is_some_and(|lead| is_singular(&lead))
    }

    /// The line above the list in which a statement is an item, in small letters.
    fn lead_of_list(&self, statement: &Statement) -> Option<String> {
        const MOST: usize = 12;
        let before = self.text.get(..statement.span.start).unwrap_or_default();
        let is_item = |line: &str| {
            let mark = line.trim_start().trim_start_matches(|c: char| c.is_ascii_digit());
            mark.len() < line.trim_start().len() && mark.starts_with(['.', ')'])
                || line.trim_start().starts_with("- ")
                || line.trim_start().starts_with("* ")
                || line.trim_start().starts_with("\\item")
        };
        let mut lines = before.rsplit('\n').take(MOST);
        if !lines.next().is_some_and(is_item) {
            return None;
        }
        let is_beside =
            |line: &&str| is_item(line) || line.trim().is_empty() || line.trim_start().starts_with("\\begin");
        lines.find(|line| !is_beside(line)).map(str::to_lowercase)
    }
}

/// Words of where the arm is singular.
const VANISHING: [&str; 17] = [
    "singul",
    "singol",
    "vanish",
    "degenera",
    "loses a direction",
    "lose a direction",
    "verschwind",
    "annul",
    "se anula",
    "si annulla",
    "rang ",
    "rank ",
    "rank\n",
    "at its boundary",
    "at the boundary",
    "over the shoulder",
    "dead point",
];
/// Words of determinants, which vanish there.
const DETERMINANTS: [&str; 5] = ["determinant", "déterminant", "det j", "det(", "\\det"];

/// True if a sentence says that the arm is singular somewhere.
fn is_singular(said: &str) -> bool {
    ["singul", "singol"].iter().any(|w| said.contains(w)) && !is_denied(said)
}

/// True if words say that something is not so, or not there.
fn is_denied(said: &str) -> bool {
    const DENIALS: [&str; 21] = [
        "not singul",
        "nicht singul",
        "non singul",
        "no singul",
        "nonsingul",
        "pas singul",
        "unless",
        "not at ",
        "nicht bei",
        "pas pour",
        "no en ",
        "non per ",
        "not when",
        "not if",
        "not vanish",
        "never",
        "annule pas",
        "no se anula",
        "non si annulla",
        "verschwindet nicht",
        "nirgends",
    ];
    DENIALS.iter().any(|d| said.contains(d))
}
