//! Equations that claim nothing of the robot: cases, conditions, places, goals.

use super::scalars::is_measured;
use super::{Pair, Piece, Scalar, Spoken, Walk};
use crate::facts::About;
use crate::habits::is_named_sign;
use crate::jacobians::Part;
use crate::note::Unreadable;
use denavit::description::JointKind;
use denavit_reading::document::{Place, Statement};
use denavit_symbolic::parse::{Syntax, SyntaxKind};
use denavit_symbolic::vocabulary::plain_name;
use denavit_symbolic::{Expr, Node, Symbol, equal};
use std::ops::Range;

/// Words so many letters before a statement speak of it.
const NEAR: usize = 400;

/// True if the words before a place speak of where the arm is singular.
pub(in super::super) fn speaks_of_singularity(text: &str, at: usize) -> bool {
    const WORDS: [&str; 13] = [
        "singul",
        "vanish",
        "determinant",
        "déterminant",
        "det j",
        "det(",
        "\\det",
        "rank",
        "rang ",
        "annul",
        "se anula",
        "degenera",
        "verschwind",
    ];
    let before = text.get(..at).unwrap_or_default();
    let start = before.char_indices().rev().take(NEAR).last().map_or(0, |c| c.0);
    let before = before[start..].to_lowercase();
    WORDS.iter().any(|w| before.contains(w)) && !is_denied(&before)
}

impl Walk<'_> {
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
            Some(value) => {
                let (place, span, wanted, also) = (None, span.clone(), Expr::int(0), vec![]);
                let pair = Pair { place, span, printed: None, value, wanted, also };
                let mut assertion = self.assertion(statement, About::Singularity);
                assertion.pieces = vec![Piece::Pair(pair)];
                self.assertions.push(assertion);
            }
            None => self.skipped.push((statement.span.clone(), Unreadable::NoConfiguration)),
        }
        true
    }

    /// A joint's value in a sentence that tells a case: a singular configuration, if the sentence says so.
    pub(super) fn case(&mut self, statement: &Statement, read: &[Scalar]) -> bool {
        let [Scalar::Formula(_, left), Scalar::Formula(span, right)] = read else { return false };
        let (of, value) = (left.value(), right.value());
        let joints = self.subject.joints();
        if !of.as_symbol().is_some_and(|s| joints.contains(&s.into())) || !value.symbols().is_empty() {
            return false;
        }
        let said = statement.prose.clone().and_then(|p| self.text.get(p)).unwrap_or_default().to_lowercase();
        // A rounded angle is where the determinant vanishes as nearly as it is printed.
        let is_rounded = self.source(span).contains('.');
        let is_told = is_singular(&said) || self.is_in_list_of_singular(statement);
        let determinant = self.subject.determinant(Part::Any).filter(|_| is_told && !is_rounded);
        match determinant {
            Some(determinant) => {
                let there = determinant.substitute(|s| (Some(s) == of.as_symbol()).then_some(value));
                let piece = Piece::Pair(Pair {
                    place: None,
                    span: span.clone(),
                    printed: None,
                    value: there,
                    wanted: Expr::int(0),
                    also: vec![],
                });
                // The configurations of a sentence are one claim.
                let last = self.assertions.last_mut().filter(|a| a.about == About::Singularity);
                match last.filter(|a| statement.span.start.saturating_sub(a.span.end) < 120) {
                    Some(assertion) => {
                        assertion.span.end = statement.span.end;
                        assertion.pieces.push(piece);
                    }
                    None => {
                        let mut assertion = self.assertion(statement, About::Singularity);
                        assertion.pieces = vec![piece];
                        self.assertions.push(assertion);
                    }
                }
            }
            None => self.taken.push(statement.span.clone()),
        }
        true
    }

    /// True for an item of a list whose lead says that the arm is singular: `Two families of singular configurations follow.`
    fn is_in_list_of_singular(&self, statement: &Statement) -> bool {
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
            return false;
        }
        let is_beside =
            |line: &&str| is_item(line) || line.trim().is_empty() || line.trim_start().starts_with("\\begin");
        let lead = lines.find(|line| !is_beside(line)).map(str::to_lowercase);
        lead.is_some_and(|lead| is_singular(&lead))
    }

    /// Keeps a statement that only tells a case from being listed.
    pub(super) fn take_as_case(&mut self, statement: &Statement) {
        let is_judged = self.assertions.last().is_some_and(|a| a.span.end >= statement.span.end);
        if !is_judged {
            self.taken.push(statement.span.clone());
        }
    }

    /// True for an equation that does not hold everywhere: in a sentence that tells a case it is the case.
    pub(super) fn is_open(&self, read: &[Scalar]) -> bool {
        let mut values = read.iter().map(|s| match s {
            Scalar::Formula(_, syntax) => Some(syntax.value()),
            _ => None,
        });
        let Some(Some(first)) = values.next() else { return false };
        let moves = |e: &Expr| e.symbols().iter().any(|s| self.subject.joints().contains(&(*s).into()));
        let rest: Option<Vec<Expr>> = values.collect();
        let is_of_pose =
            read.iter().any(|s| matches!(s, Scalar::Formula(span, _) if self.speaks_of_pose(span)));
        // A number at a known configuration is a claim.
        let is_number = rest.as_ref().is_some_and(|r| r.iter().any(|e| is_measured(*e)));
        if is_of_pose || is_number && self.at.knows(first, &self.subject) {
            return false;
        }
        rest.is_some_and(|rest| {
            let is_any = moves(&first) || rest.iter().any(moves);
            is_any && rest.iter().any(|e| !denavit_symbolic::equal(first, *e).is_equal())
        })
    }

    /// True for the value of a joint that only says where something is so, without the pose:
    /// `where q_3 = atan2(-d_4, a_3) or q_3 = …`.
    pub(super) fn is_place(&self, statement: &Statement, read: &[Scalar]) -> bool {
        const WHERE: [&str; 8] = ["where", "at", "wo", "bei", "où", "donde", "dove", "onde"];
        let [Scalar::Formula(_, left), Scalar::Formula(span, _)] = read else { return false };
        let is_joint =
            matches!(left.kind, SyntaxKind::Name(_)) && self.subject.joints().contains(&left.value());
        if !is_joint || statement.place != Place::Inline || self.speaks_of_pose(span) {
            return false;
        }
        let before = self.text.get(..statement.span.start).unwrap_or_default();
        let line = before.rsplit('\n').next().unwrap_or_default();
        let words = line.split(|c: char| !c.is_alphabetic()).filter(|w| !w.is_empty() && *w != "item");
        words.take(1).any(|w| WHERE.contains(&w))
    }

    /// True for an equation that only the joints and lengths occur in, and that is none: `s_5 = 0` on a line of its own.
    fn is_to_be_solved(&self, span: &Range<usize>, left: &Syntax, right: Expr) -> bool {
        right.is_zero()
            && self.lexis.lone_name(self.text, span).is_none_or(|_| !self.is_right_name(span))
            && self.determinant(span).is_none()
            && !self.speaks_of_pose(span)
            && !self.at.knows(left.value(), &self.subject)
            && left.value().symbols().iter().any(|s| self.subject.joints().contains(&(*s).into()))
            && !denavit_symbolic::equal(left.value(), right).is_equal()
    }

    /// True for an equation behind words that something satisfies it: it holds there.
    pub(super) fn is_satisfied(&self, statement: &Statement) -> bool {
        const WORDS: [&str; 9] = [
            "satisfies",
            "satisfy",
            "satisfying",
            "erfüllt",
            "satisface",
            "satisfait",
            "vérifie",
            "soddisfa",
            "satisfaz",
        ];
        let before = self.text.get(..statement.span.start).unwrap_or_default();
        let marks = [' ', '\n', '$', ':', '[', '\\', '&', '~'];
        let before = before.trim_end_matches(marks);
        WORDS.iter().any(|w| before.ends_with(w))
    }

    /// True for a number of the hand's place that somebody measured: `we measured x = 367.1`.
    pub(super) fn is_read_off(&self, statement: &Statement, read: &[Scalar]) -> bool {
        const WORDS: [&str; 13] = [
            "measured",
            "measurement",
            "gemessen",
            "abgelesen",
            "messwert",
            "mesuré",
            "mesure",
            "medido",
            "medimos",
            "misurat",
            "gemeten",
            "zmierz",
            "измерен",
        ];
        const FROM: [&str; 9] =
            [" from", " ab ", " von", " vom", " desde", " depuis", " dal", " a partir", " vanaf"];
        let [Scalar::Formula(name, _), Scalar::Formula(_, right)] = read else { return false };
        if !right.value().symbols().is_empty() || !self.is_right_name(name) {
            return false;
        }
        let end = statement.span.start;
        let start =
            (end.saturating_sub(2 * NEAR)..=end).find(|&i| self.text.is_char_boundary(i)).unwrap_or(end);
        let before = self.text.get(start..end).unwrap_or_default();
        let paragraph = before.rsplit("\n\n").next().unwrap_or_default();
        // What stands behind an equation on a line of its own speaks of that.
        let line = match paragraph.rsplit_once('\n') {
            Some((above, line)) => {
                let lines = above.rsplit('\n').take_while(|l| !l.contains('='));
                let length: usize = lines.map(|l| l.len() + 1).sum();
                &paragraph[paragraph.len() - line.len() - length..]
            }
            None => paragraph,
        };
        let sentence = line.rsplit(". ").next().unwrap_or_default();
        let sentence = sentence.rsplit([':', ';', '!']).find(|s| s.trim().len() > 3).unwrap_or_default();
        let is_short = line.len() < NEAR;
        let sentence = sentence.to_lowercase();
        is_short
            && WORDS.iter().any(|w| {
                sentence.find(w).is_some_and(|at| {
                    let rest = &sentence[at + w.len()..];
                    !FROM.iter().any(|f| rest.starts_with(f))
                })
            })
    }

    /// True for another whole number of a name that the document gave one: `σ_j = 0` for what turns, `σ_j = 1` for what slides.
    pub(super) fn is_other_case(&self, spans: &[Range<usize>], read: &[Scalar]) -> bool {
        let ([name, _], [Scalar::Formula(_, left), Scalar::Formula(_, right)]) = (spans, read) else {
            return false;
        };
        let is_whole = |e: Expr| e.as_number().is_some_and(|n| n.to_integer().is_some());
        let name = match self.lexis.lone_name(self.text, name) {
            Some(lone) => plain_name(&format!("{}{}", lone.base, lone.sub)),
            None => plain_name(self.source(name)),
        };
        let given = self.defined.iter().rev().find(|d| d.name == name);
        is_whole(left.value()) && is_whole(right.value()) && given.is_some_and(|d| is_whole(d.value))
    }

    /// The other value of a joint, half a turn from one that was printed: `θ_1 = θ_1 + 180°`.
    pub(super) fn half_turn(&self, read: &[Scalar]) -> Option<Spoken> {
        let [Scalar::Formula(_, left), Scalar::Formula(span, right)] = read else { return None };
        let of = left.value();
        if !matches!(left.kind, SyntaxKind::Name(_)) || !self.subject.joints().contains(&of) {
            return None;
        }
        let turn = right.value() - of;
        if !is_half_turn(turn) {
            return None;
        }
        let own = self.assertions.iter().rev().filter(|a| a.subject == self.number);
        let first = own.filter_map(|a| a.spoken.as_ref()).find_map(|s| match s {
            Spoken::Joint { of: other, branches, .. } if *other == of => Some(branches),
            _ => None,
        })?;
        let branches = first.iter().map(|b| *b + Expr::pi()).collect();
        Some(Spoken::Joint { of, sides: vec![(span.clone(), right.clone())], branches })
    }

    /// True for a joint's value in other joints alone that is not so everywhere.
    pub(super) fn is_told_of_joints(&self, spans: &[Range<usize>], read: &[Scalar]) -> bool {
        // A number may stand behind: `θ4 = −90° − θ2 − θ3 = −89.93°`.
        let is_number = |s: &Scalar| matches!(s, Scalar::Formula(_, s) if s.value().symbols().is_empty());
        let ([name, value, ..], [Scalar::Formula(_, left), Scalar::Formula(_, right), rest @ ..]) =
            (spans, read)
        else {
            return false;
        };
        if !rest.iter().all(is_number) {
            return false;
        }
        let joints = self.subject.joints();
        let symbols = right.value().symbols();
        if matches!(left.kind, SyntaxKind::Name(_)) && is_half_turn(right.value() - left.value()) {
            return joints.contains(&left.value());
        }
        // `θ5' = −θ5`: the same joint in another solution, as a joint that is told by another value of itself can be nothing
        // else; `θ4 = θ234 − θ2 − θ3` tells its own.
        if joints.contains(&left.value())
            && !denavit_symbolic::equal(right.value(), left.value()).is_equal()
            && left.value().as_symbol().is_some_and(|s| symbols.contains(&s))
        {
            return symbols.iter().all(|s| joints.contains(&(*s).into()));
        }
        matches!(left.kind, SyntaxKind::Name(_))
            && joints.contains(&left.value())
            && !self.is_right_name(name)
            && !symbols.is_empty()
            && symbols.iter().all(|s| joints.contains(&(*s).into()))
            && !symbols.contains(&left.value().as_symbol().unwrap_or(symbols[0]))
            && !self.speaks_of_pose(value)
    }

    /// True for a rate in the rates of other joints, `\\dot q_3 = w c_5 \\dot q_5`: it says how to move.
    pub(super) fn is_told_of_rates(&self, read: &[Scalar]) -> bool {
        let [Scalar::Formula(_, left), Scalar::Formula(_, right)] = read else { return false };
        let rates = self.subject.rates();
        let is_rate = |e: &Expr| rates.contains(e);
        let mut only = true;
        let mut any = false;
        let mut next = vec![right];
        while let Some(syntax) = next.pop() {
            if let SyntaxKind::Name(e) = syntax.kind {
                let has = e.symbols().iter().any(|s| is_rate(&(*s).into()));
                any |= has;
                only &= !has || is_rate(&e);
            }
            next.extend(syntax.children());
        }
        matches!(left.kind, SyntaxKind::Name(_))
            && is_rate(&left.value())
            && any
            && only
            && self.velocity_given().is_none()
            && !denavit_symbolic::equal(left.value(), right.value()).is_equal()
    }

    /// True for an equation to be solved: `det J = 0`, `s_5 = 0` in a sentence, `s_5 = 0` without the pose anywhere.
    pub(super) fn is_condition(&self, statement: &Statement, read: &[Scalar]) -> bool {
        let [Scalar::Formula(span, left), Scalar::Formula(_, right)] = read else { return false };
        if self.is_to_be_solved(span, left, right.value()) {
            return true;
        }
        let is_constant = right.value().symbols().is_empty() && !is_measured(right.value());
        let is_entry = self.is_right_name(span) && self.lexis.lone_name(self.text, span).is_some();
        // At a known configuration it is a number like others.
        let is_number = is_entry && self.at.knows(left.value(), &self.subject);
        statement.place == Place::Inline
            && is_constant
            && !is_number
            && !left.value().symbols().is_empty()
            && (!is_entry || !denavit_symbolic::equal(left.value(), right.value()).is_equal())
    }

    /// True for an entry of the pose that a sentence gives a value in which no joint occurs: `with px = 0.6, pz = d1`.
    pub(super) fn is_goal(&self, statement: &Statement, read: &[Scalar]) -> bool {
        let [Scalar::Formula(span, left), Scalar::Formula(_, right)] = read else { return false };
        let joints = self.subject.joints();
        let moves = |e: Expr| e.symbols().iter().any(|s| joints.contains(&(*s).into()));
        if right.value().symbols().is_empty() && self.is_right_name(span) && self.tells_goal(statement) {
            return true;
        }
        statement.place == Place::Inline
            && self.is_right_name(span)
            && moves(left.value())
            && !moves(right.value())
            && (right.value().symbols().is_empty() || !self.lexis.is_by_custom(self.source(span)))
            && !self.speaks_of_pose(&statement.sides[1].span)
            && !(right.value().symbols().is_empty() && self.at.knows(left.value(), &self.subject))
    }
}

impl Walk<'_> {
    /// True if the words of the line before a statement give a place that is to be reached.
    pub(super) fn tells_goal(&self, statement: &Statement) -> bool {
        let before = self.text.get(..statement.span.start).unwrap_or_default();
        let line = before.rsplit('\n').next().unwrap_or_default();
        tells_goal(&line.rsplit(". ").next().unwrap_or_default().to_lowercase())
    }
}

/// True for ±π.
fn is_half_turn(turn: Expr) -> bool {
    [Expr::pi(), -Expr::pi()].iter().any(|p| denavit_symbolic::equal(turn, *p).is_equal())
}

/// True if a heading, in small letters, is one above inverse kinematics.
pub(super) fn tells_inverse(heading: &str) -> bool {
    const WORDS: [&str; 21] = [
        "reaching a ",
        "reaching the ",
        "given point",
        "erreichen",
        "rückrechnung",
        "alcanzar",
        "atteindre",
        "raggiungere",
        "to joint angles",
        "inverse",
        "inversa",
        "inverso",
        "inversion",
        "backward",
        "rückwärts",
        "rueckwaerts",
        "géométrique inverse",
        "cinemática inversa",
        "and back",
        "back again",
        "umkehr",
    ];
    let velocities = ["jacobi", "velocit", "geschwindig", "vitesse", "velocidad", "transform", "matri"];
    WORDS.iter().any(|w| heading.contains(w)) && !velocities.iter().any(|w| heading.contains(w))
}

/// True if words, in small letters, give a place that is to be reached.
pub(super) fn tells_goal(sentence: &str) -> bool {
    GOALS.iter().any(|words| sentence.contains(words))
}

/// Words before a place that is to be reached.
const GOALS: [&str; 41] = [
    "must reach",
    "should reach",
    "joint angles for",
    "joint values for",
    "find both solutions",
    "find all solutions",
    "all solutions for",
    "back to joint",
    "to joint angles",
    "goal",
    "given pose",
    "point to reach",
    "soll erreicht",
    "alcanzar",
    "for the point",
    "for the position",
    "for the pose",
    "for a point",
    "to the point",
    "inverse for",
    "inverse kinematics for",
    "to reach",
    "target",
    "desired",
    "wanted at",
    "wanted pose",
    "gewünscht",
    "souhait",
    "desiderat",
    "für den punkt",
    "für die position",
    "inverse für",
    "zielpunkt",
    "zielposition",
    "pour le point",
    "pour la position",
    "position désirée",
    "para el punto",
    "para la posición",
    "punto deseado",
    "per il punto",
];

/// True if a sentence says that the arm is singular somewhere.
fn is_singular(said: &str) -> bool {
    said.contains("singul") && !is_denied(said)
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

/// True for `σ = +1`, where the document names a sign.
pub(super) fn is_choice_of_sign(read: &[Scalar]) -> bool {
    let [Scalar::Formula(_, left), Scalar::Formula(_, right)] = read else { return false };
    let one = right.value();
    is_named_sign(left.value()) && (one.is_one() || (-one).is_one() || right.sign_choices() > 0)
}
