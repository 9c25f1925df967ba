//! Equations that claim nothing of the robot: cases, conditions, places, goals.

use super::scalars::is_measured;
use super::{Scalar, Spoken, Walk};
use crate::habits::is_named_sign;
use denavit_reading::document::{Place, Statement};
use denavit_symbolic::Expr;
use denavit_symbolic::parse::{Syntax, SyntaxKind};
use denavit_symbolic::vocabulary::plain_name;
use std::ops::Range;

/// Words so many letters before a statement speak of it.
pub(super) const NEAR: usize = 400;

impl Walk<'_> {
    /// A joint's value in a sentence that tells a case.
    pub(super) fn case(&mut self, statement: &Statement, read: &[Scalar]) -> bool {
        let [Scalar::Formula(_, left), Scalar::Formula(_, right)] = read else { return false };
        let joints = self.subject.joints();
        let is_joint = left.value().as_symbol().is_some_and(|s| joints.contains(&s.into()));
        let is_told = is_joint && right.value().symbols().is_empty();
        if is_told {
            self.taken.push(statement.span.clone());
        }
        is_told
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
            // What holds everywhere is no condition: it is said of the robot.
            && !denavit_symbolic::equal(left.value(), right.value()).is_equal()
    }

    /// True for an entry of the pose that a sentence gives a value in which no joint occurs: `with px = 0.6, pz = d1`.
    pub(super) fn is_goal(&self, statement: &Statement, read: &[Scalar]) -> bool {
        let [Scalar::Formula(span, left), Scalar::Formula(_, right)] = read else { return false };
        let joints = self.subject.joints();
        let moves = |e: Expr| e.symbols().iter().any(|s| joints.contains(&(*s).into()));
        if right.value().symbols().is_empty() && self.is_right_name(span) && self.tells_goal(statement) {
            return true;
        }
        // What moves the hand so fast is a claim, but for a velocity for which rates are asked.
        let symbols = left.value().symbols();
        let is_velocity =
            self.subject.rates().iter().any(|r| r.as_symbol().is_some_and(|s| symbols.contains(&s)));
        if is_velocity && is_measured(right.value()) && !self.asks_for_rates(statement) {
            return false;
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
        let sentence = line.rsplit(". ").next().unwrap_or_default().to_lowercase();
        tells_goal(&sentence) || self.asks_for_joints(statement, &sentence)
    }

    /// True for a number in a question for joints: `welche Gelenkwinkel gehören zu x = 0,30 und y = 0,80?`
    fn asks_for_joints(&self, statement: &Statement, sentence: &str) -> bool {
        const JOINTS: [&str; 12] = [
            "angle", "joint", "winkel", "gelenk", "ángulo", "articula", "angoli", "giunt", "ângulo", "junta",
            "hoek", "gewricht",
        ];
        const FAR: usize = 120;
        let rest = self.text.get(statement.span.end..).unwrap_or_default();
        let is_question = rest.find(['?', '\n']).is_some_and(|at| at < FAR && rest[at..].starts_with('?'));
        let is_of_rates =
            ["rate", "speed", "veloc", "geschwind", "vitesse", "snelhe"].iter().any(|w| sentence.contains(w));
        is_question && !is_of_rates && JOINTS.iter().any(|w| sentence.contains(w))
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

/// True for `σ = +1`, where the document names a sign.
pub(super) fn is_choice_of_sign(read: &[Scalar]) -> bool {
    let [Scalar::Formula(_, left), Scalar::Formula(_, right)] = read else { return false };
    let one = right.value();
    is_named_sign(left.value()) && (one.is_one() || (-one).is_one() || right.sign_choices() > 0)
}
