//! Equations that claim nothing of the robot: cases, conditions, places, goals.

use super::scalars::is_measured;
use super::{Pair, Piece, Scalar, Walk};
use crate::facts::About;
use crate::goals::{Answered, Target};
use crate::habits::is_named_sign;
use crate::jacobians::Part;
use denavit_reading::document::{Place, Statement};
use denavit_symbolic::parse::{Syntax, SyntaxKind};
use denavit_symbolic::vocabulary::plain_name;
use denavit_symbolic::{Angle, Expr};
use std::ops::Range;

/// Numbers of one pose stand no farther from each other, in bytes.
const FAR: usize = 300;

impl Walk<'_> {
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
        let determinant = self.subject.determinant(Part::Any).filter(|_| is_singular(&said) && !is_rounded);
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

    /// The joint, or the sum of joints, that is said to have numbers.
    fn numbers_of_joint<'r>(&self, read: &'r [Scalar]) -> Option<(Expr, &'r Range<usize>, &'r Syntax)> {
        let (Scalar::Formula(_, left), rest) = read.split_first()? else { return None };
        let joints = self.subject.joints();
        let form = Angle::of(left.value());
        // `θ_1 + θ_2`, or `q_3 - δ` with a number δ.
        let is_part = |e: &Expr| joints.contains(e) || e.symbols().is_empty();
        let is_sum =
            form.terms.iter().any(|t| joints.contains(&t.0)) && form.terms.iter().all(|t| is_part(&t.0));
        let is_number = |s: &Scalar| matches!(s, Scalar::Formula(_, s) if s.value().symbols().is_empty());
        // The last side is the number that the others come to.
        let Scalar::Formula(span, syntax) = rest.last()? else { return None };
        (is_sum && rest.iter().all(is_number)).then_some((left.value(), span, syntax))
    }

    /// True for numbers with signs that a joint is said to have, `θ_5 = ±60°`, where nothing says for which pose.
    pub(super) fn is_number_with_signs(&self, read: &[Scalar]) -> bool {
        self.numbers_of_joint(read).is_some_and(|(of, _, syntax)| {
            let at = |e: Expr| e.eval(|_| None).ok();
            let known = self.at.knows(of, &self.subject);
            syntax.sign_choices() > 0
                && !(known
                    && syntax
                        .variants()
                        .iter()
                        .any(|v| at(v.value()).is_some_and(|x| self.at.has(of, x, &self.subject))))
        })
    }

    /// Keeps the numbers that a joint is said to have for the pose that is to be reached; false if there is none.
    pub(super) fn answer(&mut self, statement: &Statement, read: &[Scalar]) -> bool {
        if !self.in_inverse || self.goal.is_empty() {
            return false;
        }
        let Some((of, span, syntax)) = self.numbers_of_joint(read) else { return false };
        let values: Vec<f64> =
            syntax.variants().iter().filter_map(|v| v.value().eval(|_| None).ok()).collect();
        let source = self.source(span);
        let is_degree = source.contains('°') || source.contains("deg") || source.contains("circ");
        let has_unit = is_degree || source.contains(|c: char| c.is_alphabetic() || c == 'π');
        let half = self.half(span);
        let name = self.claim_name(statement);
        self.answered.push(Answered {
            span: statement.span.clone(),
            name,
            value: span.clone(),
            of,
            values,
            half,
            has_unit,
            subject: self.number,
            targets: self.goal.clone(),
            at: self.at.clone(),
        });
        true
    }

    /// Keeps a number for an entry of the pose that is to be reached: `x = 516.8 mm` above inverse kinematics.
    pub(super) fn aims(&mut self, statement: &Statement, read: &[Scalar]) -> bool {
        let [Scalar::Formula(name, left), Scalar::Formula(span, right)] = read else { return false };
        let wanted = left.value();
        let moves = wanted.symbols().iter().any(|s| self.subject.joints().contains(&(*s).into()));
        let is_place = self.is_right_name(name) || self.numbers_of_joint(read).is_some();
        let is_known = self.at.knows(wanted, &self.subject);
        if !self.in_inverse || !moves || is_known || !right.value().symbols().is_empty() || !is_place {
            return false;
        }
        let Ok(printed) = right.value().eval(|_| None) else { return false };
        let half = self.half(span);
        let target = Target::new(&self.subject, wanted, printed, half);
        self.aim_at(statement, vec![target]);
        true
    }

    /// Adds to the pose that is to be reached; what stands far behind begins another one.
    pub(super) fn aim_at(&mut self, statement: &Statement, targets: Vec<Target>) {
        let is_told = |t: &Target| targets.iter().any(|n| n.wanted == t.wanted);
        if statement.span.start.saturating_sub(self.goal_at) > FAR || self.goal.iter().any(is_told) {
            self.goal.clear();
        }
        self.goal.extend(targets);
        self.goal_at = statement.span.end;
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

    /// True for an equation to be solved: `det J = 0`, `s_5 = 0` in a sentence, `s_5 = 0` without the pose anywhere.
    pub(super) fn is_condition(&self, statement: &Statement, read: &[Scalar]) -> bool {
        let [Scalar::Formula(span, left), Scalar::Formula(_, right)] = read else { return false };
        if self.is_to_be_solved(span, left, right.value()) {
            return true;
        }
        let is_constant = right.value().symbols().is_empty() && !is_measured(right.value());
        let is_entry = self.is_right_name(span) && self.lexis.lone_name(self.text, span).is_some();
        statement.place == Place::Inline
            && is_constant
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

/// True if a heading, in small letters, is one above inverse kinematics.
pub(super) fn tells_inverse(heading: &str) -> bool {
    const WORDS: [&str; 12] = [
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
const GOALS: [&str; 22] = [
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
    let denials = [
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
    ];
    said.contains("singul") && !denials.iter().any(|d| said.contains(d))
}

/// True for `σ = +1`, where the document names a sign.
pub(super) fn is_choice_of_sign(read: &[Scalar]) -> bool {
    let [Scalar::Formula(_, left), Scalar::Formula(_, right)] = read else { return false };
    let one = right.value();
    is_named_sign(left.value()) && (one.is_one() || (-one).is_one() || right.sign_choices() > 0)
}
