//! Equations between scalars: entries, definitions, identities, values of joints and angles.

use super::cases::is_choice_of_sign;
use super::{Assertion, Pair, Piece, Scalar, Spoken, Walk};
use crate::facts::About;
use crate::habits::with_named_signs;
use crate::lexis::set_in;
use crate::names::Name;
use crate::note::{Unread, Unreadable};
use denavit::forward::Reference as Frame;
use denavit::geometry::orientation::OrientationSet;
use denavit_reading::document::Statement;
use denavit_symbolic::parse::{Function, Syntax, SyntaxKind};
use denavit_symbolic::vocabulary::plain_name;
use denavit_symbolic::{Angle, Expr};
use std::ops::Range;

impl Walk<'_> {
    pub(super) fn scalar(&self, span: &Range<usize>) -> Scalar {
        // `which joints go with x = 0.3?`
        let asked = self.text.get(span.clone()).and_then(|s| s.strip_suffix('?')).filter(|s| !s.is_empty());
        let span = &asked.map_or(span.clone(), |s| span.start..span.start + s.trim_end().len());
        let known = |value: Expr| {
            let syntax = Syntax { kind: SyntaxKind::Name(value), span: 0..span.len() };
            Scalar::Formula(span.clone(), syntax)
        };
        if let Some(value) = self.derivative_named(span) {
            return known(value);
        }
        // `6.96°/s`, also where s is a name, and `0.45 m`, where m is that of a moment or a mass.
        let source = self.source(span);
        let is_rate = |number: &str| {
            let is_named = source.ends_with("/s") || source.ends_with(" m") && !self.is_of_robot("m");
            is_named && number.trim().parse::<f64>().is_ok()
        };
        let rate = crate::numbers::unit_behind(source).filter(|(number, ..)| is_rate(number));
        if let Some(value) = rate.and_then(|_| self.constant(source)) {
            return known(value);
        }
        let errors = match self.lexis.formula(self.text, span) {
            Ok(syntax) => return Scalar::Formula(span.clone(), syntax),
            Err(errors) => errors,
        };
        // Numbers with units: `0.433 m`.
        let other = || self.norm(span).or_else(|| self.constant(self.source(span)));
        if let Some(value) = self.determinant(span).or_else(other) {
            return known(value);
        }
        match self.lexis.lone_name(self.text, span) {
            Some(name) if name.left.is_empty() && name.sup.is_empty() && name.arguments.is_empty() => {
                self.conventional(&name).map_or(Scalar::Lone(name), known)
            }
            _ => Scalar::Broken(span.clone(), errors.into_iter().map(Unread::from).collect()),
        }
    }

    /// What `x`, `Y`, `x_x` or `z_y` mean by custom, where the document gives no other meaning.
    pub(super) fn conventional(&self, name: &Name) -> Option<Expr> {
        if self.subject.last() == 0
            || self.lexis.habits.helpers.contains(&format!("{}{}", name.base, name.sub))
        {
            return None;
        }
        let digits: Vec<u32> = name.sub.chars().filter_map(|c| c.to_digit(10)).collect();
        // `J_{11} = […]` is a block.
        let is_block = || {
            let given = ["J_{11}", "J_{11} ", "J11", "J11 "].iter().flat_map(|n| self.text.match_indices(n));
            given.take(20).any(|(at, n)| {
                let rest = self.text[at + n.len()..].trim_start_matches([' ', '&']);
                let rest = rest.strip_prefix('=').unwrap_or_default().trim_start_matches([' ', '&', '\n']);
                rest.starts_with('[') || ["\\begin", "\\left["].iter().any(|b| rest.starts_with(b))
            })
        };
        if let ("J", [r, c]) = (name.base.as_str(), &digits[..]) {
            if is_block() {
                return None;
            }
            let j = self.subject.geometric_rows(Frame::Tool, Frame::Frame(0));
            return j.get((*r as usize).checked_sub(1)?)?.get((*c as usize).checked_sub(1)?).copied();
        }
        let axis = |c: &str| ["x", "y", "z"].iter().position(|a| *a == c.to_lowercase());
        let plain = format!("{}{}", name.base, name.sub);
        let pose = self.subject.pose();
        match (axis(&name.base), name.sub.as_str()) {
            (Some(r), "p" | "P") => Some(pose.translation.0[r]),
            (Some(_), "") => None,
            (Some(c), sub) => Some(pose.rotation.rows()[axis(sub)?][c]),
            (None, _) => {
                let mut letters = plain.chars();
                let (first, rest) = (letters.next()?.to_string(), letters.as_str());
                Some(pose.rotation.rows()[axis(rest)?][axis(&first)?])
            }
        }
    }

    /// Reads a statement as one between scalars; false if it is none.
    pub(super) fn scalars(&mut self, statement: &Statement, claim: Option<&str>) -> bool {
        let spans: Vec<Range<usize>> = statement.sides.iter().map(|s| s.span.clone()).collect();
        let mut read: Vec<Scalar> = spans.iter().map(|s| self.scalar(s)).collect();
        if self.finds_rates(statement, &read) {
            read = spans.iter().map(|s| self.scalar(s)).collect();
        }
        let is_matrix = |s: &Scalar| match s {
            Scalar::Lone(name) => self.lexis.matrix(&self.subject, name).is_some(),
            Scalar::Broken(span, _) => self.is_product(span),
            Scalar::Formula(..) => false,
        };
        if !read.iter().any(|s| matches!(s, Scalar::Formula(..))) || read.iter().skip(1).any(is_matrix) {
            let all_matrices = read.iter().all(|s| is_matrix(s) || matches!(s, Scalar::Lone(_)));
            if all_matrices || read.iter().any(is_matrix) {
                return false;
            }
        }
        if self.is_numbered_word(statement) {
            self.skipped.push((statement.span.clone(), Unreadable::NeitherFormulaNorProduct));
            return true;
        }
        if self.is_read_off(statement, &read) {
            self.skipped.push((statement.span.clone(), Unreadable::NeitherFormulaNorProduct));
            return true;
        }
        if self.is_of_last_matrix(statement) {
            return true;
        }
        if self.tells_goal(statement) {
            self.look_for_joints();
        }
        if self.singular(statement, &read) {
            return true;
        }
        let is_case = self.is_case(statement) || self.is_satisfied(statement);
        if is_case && (self.case(statement, &read) || self.is_open(&read)) {
            self.take_as_case(statement);
            return true;
        }
        if self.is_place(statement, &read) || is_choice_of_sign(&read) || self.is_other_case(&spans, &read) {
            self.taken.push(statement.span.clone());
            return true;
        }
        if !is_case && (self.is_velocity_sought(statement, &read) || self.answer(statement, &read)) {
            return true;
        }
        if !is_case && self.configuration(&spans, &read) {
            self.keep_given(statement, &read);
            self.taken.push(statement.span.clone());
            return true;
        }
        if self.is_number_with_signs(&read) {
            // Nothing says which pose has it.
            self.skipped.push((statement.span.clone(), Unreadable::NoConfiguration));
            return true;
        }
        if self.is_taken_as_goal(statement, &read) {
            self.taken.push(statement.span.clone());
            return true;
        }
        let spoken = self.half_turn(&read).or_else(|| self.values(&spans, &read));
        if let Some(spoken) = spoken.or_else(|| self.angle(statement, &read)) {
            let about = match spoken {
                Spoken::Joint { .. } => About::Joint,
                Spoken::Angle { set, .. } => About::Angle(set),
            };
            if about == About::Joint {
                // Numbers behind it are those of a pose to be reached.
                self.look_for_joints();
            }
            let assertion = Assertion { spoken: Some(spoken), ..self.assertion(statement, about.clone()) };
            self.assertions.push(assertion);
            if let (About::Angle(_), [_, Scalar::Formula(_, formula), numbers @ ..]) = (about, &read[..]) {
                self.numbers_behind(statement, formula.value(), numbers);
            }
            return true;
        }
        if self.is_told_of_joints(&spans, &read) || self.is_told_of_rates(&read) {
            // `θ4 = −θ2` keeps the hand level: it says how to move, nothing of the robot.
            self.skipped.push((statement.span.clone(), Unreadable::NeitherFormulaNorProduct));
            return true;
        }
        if self.is_sine_there(statement, &read) {
            return true;
        }
        self.record_sine(&spans, &read);
        self.record_posed(&spans, &read);
        let told = claim.and_then(|words| self.told_entry(words)).or_else(|| self.of_motion(&read));
        // A name that the document defines here.
        let is_definition = told.is_none()
            && match &read[..] {
                [first, Scalar::Formula(span, syntax), ..]
                    if self.defines(&spans[0], first, syntax)
                        || self.is_told_of_itself(&spans[0], span)
                        || self.is_own_of_two(&spans[0], &read) =>
                {
                    let name = match first {
                        Scalar::Lone(name) => {
                            plain_name(&format!("{}{}", name.base, name.sub)).replace('ℓ', "l")
                        }
                        _ => plain_name(self.source(&spans[0])),
                    };
                    let inverse = self.inverse_value(span, syntax);
                    self.defined_here(statement, name, [syntax.value(), inverse], span, syntax);
                    true
                }
                [Scalar::Broken(left, _), Scalar::Formula(span, syntax), ..]
                    if self.name_with_argument(left).is_some() =>
                {
                    let inverse = self.inverse_value(span, syntax);
                    let name = self.name_with_argument(left).unwrap_or_default();
                    self.defined_here(statement, name, [syntax.value(), inverse], span, syntax);
                    true
                }
                [Scalar::Broken(left, _), Scalar::Formula(span, syntax)] => {
                    let inverse = self.inverse_value(span, syntax);
                    match (self.implied(left, syntax.value()), self.implied(left, inverse)) {
                        (Some((name, value)), Some((_, inverse))) => {
                            self.defined_here(statement, name, [value, inverse], span, syntax);
                            return true;
                        }
                        _ => false,
                    }
                }
                _ => false,
            };
        if is_definition && matches!(read.first(), Some(Scalar::Formula(..))) {
            return true;
        }
        // `cos θ3 = … = D` gives what stands before it a name.
        let tells = |sides: usize| sides > 2 || self.source(&statement.span).contains("=:");
        if let [.., Scalar::Formula(span, syntax), Scalar::Lone(name)] = &read[..]
            && !is_definition
            && name.is_bare()
            && tells(read.len())
        {
            let name = plain_name(&format!("{}{}", name.base, name.sub));
            let inverse = self.inverse_value(span, syntax);
            self.defined_here(statement, name, [syntax.value(), inverse], span, syntax);
            read.pop();
        }
        let formulas = || {
            read.iter().enumerate().filter_map(|(i, s)| match s {
                Scalar::Formula(span, syntax) => Some((i, span, syntax)),
                _ => None,
            })
        };
        let reference = match told {
            Some(value) => Some((usize::MAX, value)),
            None => {
                let right = formulas().find(|(_, span, _)| self.is_right_name(span));
                let is_plain = |s: &Syntax| s.sign_choices() == 0 && !has_inverse_function(s);
                let posed = || formulas().find(|(_, span, s)| is_plain(s) && self.speaks_of_pose(span));
                let all_posed = formulas().all(|(_, span, _)| self.speaks_of_pose(span));
                let sine =
                    || formulas().next().filter(|(i, _, s)| *i == 0 && matches!(s.kind, SyntaxKind::Name(_)));
                let found = right.or_else(sine).or_else(|| posed().filter(|_| !all_posed));
                found.or_else(|| formulas().next()).map(|(i, _, s)| (i, s.value()))
            }
        };
        let reference = reference.map(|(at, wanted)| (at, self.with_rates(wanted)));
        let reference = reference.map(|(at, wanted)| (at, self.of_moving(statement, &read, wanted)));
        let reference = reference.and_then(|(at, wanted)| Some((at, self.under_load(wanted)?)));
        let Some((at, wanted)) = reference else {
            for s in &read {
                if let Scalar::Broken(span, errors) = s {
                    let error = errors.first().cloned();
                    self.skipped.extend(error.map(|e| (span.clone(), e.why)));
                    break;
                }
            }
            return true;
        };
        // A number that is held against the pose to be reached.
        let is_answered = self.answered.last().is_some_and(|a| a.span == statement.span);
        let is_number = |s: &Scalar| matches!(s, Scalar::Formula(_, s) if s.value().symbols().is_empty());
        let others = read.iter().enumerate().filter(|(i, s)| *i != at && !(is_answered && is_number(s)));
        let mut pieces = vec![];
        for (i, s) in others {
            match s {
                Scalar::Formula(span, syntax)
                    if syntax.value().symbols().is_empty()
                        && (!wanted.symbols().is_empty() || self.is_rounded(span))
                        && (self.at.knows(wanted, &self.subject) || self.knew(wanted)) =>
                {
                    // `±25°` beside a configuration with −25°.
                    let variants = syntax.variants();
                    let mut signed = variants.iter().filter(|_| variants.len() > 1).map(|v| v.value());
                    let is_there =
                        |v: &Expr| v.eval(|_| None).is_ok_and(|x| self.at.has(wanted, x, &self.subject));
                    let value = signed.find(is_there).unwrap_or(syntax.value());
                    pieces.extend(self.number(None, span, value, wanted));
                }
                Scalar::Formula(span, syntax)
                    if (is_measured(syntax.value()) || self.is_quantity(span, syntax))
                        && !wanted.symbols().is_empty() =>
                {
                    let errors = vec![Unread::new(span.clone(), Unreadable::NoConfiguration)];
                    pieces.push(Piece::Unreadable { place: None, span: span.clone(), errors });
                }
                Scalar::Formula(span, syntax) => pieces.push(Piece::Pair(Pair {
                    place: None,
                    span: span.clone(),
                    printed: Some(syntax.clone()),
                    value: in_degrees(syntax.value(), wanted),
                    wanted: self.there(span, syntax.value(), wanted),
                    also: vec![],
                })),
                Scalar::Lone(_) if i == 0 => {}
                Scalar::Lone(name) => {
                    let errors = vec![Unread::new(spans[i].clone(), Unreadable::Unknown(name.key()))];
                    pieces.push(Piece::Unreadable { place: None, span: spans[i].clone(), errors });
                }
                Scalar::Broken(span, errors) => {
                    pieces.push(Piece::Unreadable {
                        place: None,
                        span: span.clone(),
                        errors: errors.clone(),
                    });
                }
            }
        }
        if pieces.is_empty() || is_definition && pieces.iter().all(|p| matches!(p, Piece::Unreadable { .. }))
        {
            return true;
        }
        let about = if at == usize::MAX || at == 0 && self.is_right_name(&spans[0]) {
            About::Entry
        } else {
            About::Equation
        };
        if at == 0 {
            self.know_entry(&spans[0], wanted);
        }
        let mut assertion = self.assertion(statement, about);
        assertion.pieces = pieces;
        assertion.reference = formulas().find(|f| f.0 == at).map(|(_, span, s)| (span.clone(), s.clone()));
        self.assertions.push(assertion);
        true
    }

    /// Holds numbers against the formula before them, at the present configuration.
    fn numbers_behind(&mut self, statement: &Statement, formula: Expr, numbers: &[Scalar]) {
        if !self.at.knows(formula, &self.subject) {
            return;
        }
        let number = |s: &Scalar| match s {
            Scalar::Formula(span, syntax) => self.number(None, span, syntax.value(), formula),
            _ => None,
        };
        let pieces: Vec<Piece> = numbers.iter().filter_map(number).collect();
        if !pieces.is_empty() {
            let assertion = Assertion { pieces, ..self.assertion(statement, About::Equation) };
            self.assertions.push(assertion);
        }
    }

    /// True for what all joints together give at a configuration that was found before.
    fn knew(&self, wanted: Expr) -> bool {
        let is_sum =
            denavit_symbolic::Angle::of(wanted).terms.iter().all(|t| self.subject.joints().contains(&t.0));
        let is_place = self.subject.pose().translation.0.contains(&wanted);
        !is_sum && !is_place && self.at.knew(wanted, &self.subject)
    }

    /// The value of a formula, the entries of the pose as symbols.
    fn inverse_value(&self, span: &Range<usize>, syntax: &Syntax) -> Expr {
        self.lexis.inverse_formula(self.text, span).map_or(syntax.value(), |s| s.value())
    }

    /// True for `2 = 78.5` of `motor 2 = 78.5`: the number belongs to the word before it.
    fn is_numbered_word(&self, statement: &Statement) -> bool {
        let Some(first) = statement.sides.first() else { return false };
        let before = self.text.get(..first.span.start).unwrap_or_default();
        let number = self.source(&first.span).trim();
        !number.is_empty()
            && number.bytes().all(|b| b.is_ascii_digit())
            && before.ends_with(' ')
            && before.trim_end_matches(' ').ends_with(char::is_alphabetic)
    }

    /// True for a name that the robot gives its meaning.
    pub(super) fn is_right_name(&self, span: &Range<usize>) -> bool {
        let source = self.source(span);
        let Some(name) = self.lexis.lone_name(self.text, span) else { return self.lexis.is_right(source) };
        let plain = plain_name(&format!("{}{}", name.base, name.sub));
        self.lexis.is_right(&plain)
            || self.lexis.formula(self.text, span).is_err() && self.conventional(&name).is_some()
    }

    /// True if an entry of the pose occurs.
    pub(super) fn speaks_of_pose(&self, span: &Range<usize>) -> bool {
        let Ok(syntax) = self.lexis.inverse_formula(self.text, span) else { return false };
        let symbols = syntax.value().symbols();
        let is_entry = |r: usize, c: usize| symbols.contains(&self.lexis.pose_symbol(r, c));
        (0..3).any(|r| (0..4).any(|c| is_entry(r, c)))
    }

    /// Values for a joint: `θ_1 = atan2(…)`.
    pub(super) fn values(&self, spans: &[Range<usize>], read: &[Scalar]) -> Option<Spoken> {
        let (first, rest) = spans.split_first()?;
        let Some(Scalar::Formula(_, left)) = read.first() else { return None };
        let is_name = matches!(left.kind, SyntaxKind::Name(_) | SyntaxKind::Sum(_));
        let of = Some(left.value()).filter(|_| is_name)?;
        let variables = self.subject.description.variables();
        let angle = Angle::of(of);
        let is_joint = |e: &Expr| e.as_symbol().is_some_and(|s| variables.iter().any(|v| v.symbol == s));
        let is_unit = |k: &denavit_symbolic::Rational| k.is_one() || (-k).is_one();
        let is_sum = !angle.terms.is_empty() && angle.terms.iter().all(|(e, k)| is_joint(e) && is_unit(k));
        let is_right = self.is_right_name(first) && !self.lexis.is_by_custom(self.source(first));
        if !is_sum || is_right || rest.is_empty() {
            return None;
        }
        let mut sides = vec![];
        for span in rest {
            sides.push((span.clone(), self.lexis.inverse_formula(self.text, span).ok()?));
        }
        // What is made of letters that nothing gives a meaning is a value, too: of what is known there.
        let is_value = |syntax: &Syntax, span: &Range<usize>| {
            has_inverse_function(syntax)
                || self.speaks_of_pose(span)
                || syntax.sign_choices() > 0
                || self.has_strange_components(syntax.value())
        };
        let is_number = |syntax: &Syntax| syntax.value().symbols().is_empty();
        if !sides.iter().any(|(span, syntax)| is_value(syntax, span)) || sides.iter().all(|s| is_number(&s.1))
        {
            return None;
        }
        // Numbers for a pose that is given are judged by themselves.
        if self.answered.last().is_some_and(|a| a.span.contains(&first.start)) {
            sides.retain(|s| !is_number(&s.1));
        }
        // What was printed for the joint's own sine and cosine stands for them.
        let own: Vec<&(Expr, Vec<Expr>)> =
            self.sines.iter().filter(|s| s.0 == of.sin() || s.0 == of.cos()).collect();
        let mut branches: Vec<Expr> = vec![];
        for syntax in sides.iter().flat_map(|(_, s)| s.variants()) {
            let choices = own.iter().map(|s| s.1.len()).product::<usize>().clamp(1, 64);
            for choice in 0..choices {
                let mut rest = choice;
                let mut chosen = vec![];
                for (sine, values) in &own {
                    chosen.push((*sine, values[rest % values.len()]));
                    rest /= values.len();
                }
                let value = replaced(&syntax, &chosen, 0);
                if !branches.contains(&value) {
                    branches.push(value);
                }
            }
        }
        let branches = with_named_signs(branches);
        Some(Spoken::Joint { of, sides, branches })
    }

    /// Values for an angle of an orientation: `φ = atan2(R(2,3), R(1,3))`.
    pub(super) fn angle(&self, statement: &Statement, read: &[Scalar]) -> Option<Spoken> {
        let set = self.angles.or_else(|| {
            let words = [&statement.prose, &statement.heading];
            words.into_iter().flatten().find_map(|span| set_in(self.text.get(span.clone())?))
        })?;
        let (side, rest) = statement.sides.split_first()?;
        // The number that it comes to may stand behind.
        let [value, numbers @ ..] = rest else { return None };
        let is_number = |s: &Scalar| matches!(s, Scalar::Formula(_, s) if s.value().symbols().is_empty());
        if !numbers.is_empty() && !read.iter().skip(2).all(is_number) {
            return None;
        }
        let left = self.lexis.lone_name(self.text, &side.span)?;
        let name = match format!("{}{}", left.base, left.sub).as_str() {
            "φ" => "phi".to_string(),
            "θ" | "ϑ" => "theta".to_string(),
            "ψ" => "psi".to_string(),
            other => other.to_lowercase(),
        };
        let names = set.names();
        let name = match set {
            // Roll, pitch and yaw turn about x, y and z; many call them ψ, θ, φ.
            OrientationSet::Rpy => match name.as_str() {
                "phi" => "yaw",
                "theta" => "pitch",
                "psi" => "roll",
                other => other,
            },
            _ => &name,
        };
        let name = (*names.iter().find(|n| **n == name)?).to_string();
        if matches!(read.first(), Some(Scalar::Formula(..))) && !has_entry(self, &value.span) {
            return None;
        }
        let syntax = self.lexis.inverse_formula(self.text, &value.span).ok()?;
        has_entry(self, &value.span).then_some(Spoken::Angle {
            set,
            name,
            value: (value.span.clone(), syntax),
        })
    }

    /// `T06 3,4`: an entry that a directive names.
    pub(super) fn told_entry(&self, words: &str) -> Option<Expr> {
        let (name, place) = words.trim().split_once(' ')?;
        let (r, c) = place.trim().split_once([',', ' '])?;
        let (r, c): (usize, usize) = (r.trim().parse().ok()?, c.trim().parse().ok()?);
        let reference = self.told_matrix(name)?;
        reference.matrix.entry(r.checked_sub(1)?, c.checked_sub(1)?)
    }

    /// True for a number with digits behind the point, which may be rounded: `0.567 m`.
    fn is_rounded(&self, span: &Range<usize>) -> bool {
        let source = self.source(span).trim();
        let number = crate::numbers::unit_behind(source).map_or(source, |(number, ..)| number).trim();
        number.contains('.') && number.trim_start_matches(['-', '\u{2212}']).parse::<f64>().is_ok()
    }

    /// True for a number with its unit, `0 mm`.
    fn is_quantity(&self, span: &Range<usize>, syntax: &Syntax) -> bool {
        syntax.value().symbols().is_empty() && crate::numbers::unit_behind(self.source(span)).is_some()
    }
}

/// A bare number that is right as degrees of an angle of the table, in radians: `alpha1 = -90`; any other formula as it is.
fn in_degrees(value: Expr, wanted: Expr) -> Expr {
    let may_be = value.as_number().is_some() && wanted.as_number().is_none() && wanted.symbols().is_empty();
    let angle = value * Expr::pi() / Expr::int(180);
    if may_be && denavit_symbolic::equal(angle, wanted).is_equal() { angle } else { value }
}

/// True for a number that somebody computed: neither 0 nor ±1.
pub(crate) fn is_measured(e: Expr) -> bool {
    match e.as_number() {
        Some(r) => !r.is_zero() && !r.is_one() && !(-&r).is_one(),
        None => e.symbols().is_empty(),
    }
}

/// The value of a formula with other values for some sines.
pub(super) fn replaced(syntax: &Syntax, by: &[(Expr, Expr)], depth: usize) -> Expr {
    if depth > 200 || by.is_empty() {
        return syntax.value();
    }
    let inner = |s: &Syntax| replaced(s, by, depth + 1);
    match &syntax.kind {
        SyntaxKind::Name(e) => {
            let mut change = |old: Expr, new: Expr| by.iter().find(|b| b.0 == old).map_or(new, |b| b.1);
            crate::inverse::rebuilt(*e, &mut change)
        }
        SyntaxKind::Number(_) => syntax.value(),
        SyntaxKind::Sum(terms) => {
            terms.iter().fold(Expr::int(0), |sum, (sign, term)| match sign.is_minus() {
                true => sum - inner(term),
                false => sum + inner(term),
            })
        }
        SyntaxKind::Product(factors) => {
            factors.iter().fold(Expr::int(1), |product, (is_over, factor)| match is_over {
                true => product / inner(factor),
                false => product * inner(factor),
            })
        }
        SyntaxKind::Fraction(a, b) => inner(a) / inner(b),
        SyntaxKind::Power(a, n) => inner(a).powi(*n),
        SyntaxKind::Root(a) => inner(a).sqrt(),
        SyntaxKind::Call(f, arguments) => {
            let whole = syntax.value();
            match by.iter().find(|b| b.0 == whole) {
                Some(b) => b.1,
                None => f.of(&arguments.iter().map(inner).collect::<Vec<Expr>>()),
            }
        }
        SyntaxKind::Bracket(a) => inner(a),
    }
}

/// True if a formula speaks of the orientation.
fn has_entry(walk: &Walk<'_>, span: &Range<usize>) -> bool {
    let Ok(syntax) = walk.lexis.inverse_formula(walk.text, span) else { return false };
    let symbols = syntax.value().symbols();
    (0..3).any(|r| (0..3).any(|c| symbols.contains(&walk.lexis.pose_symbol(r, c))))
}

/// True if an arctangent or the like occurs.
fn has_inverse_function(syntax: &Syntax) -> bool {
    let is_inverse = match &syntax.kind {
        SyntaxKind::Call(f, _) => f.is_inverse() || *f == Function::Atan2,
        _ => false,
    };
    is_inverse || syntax.children().into_iter().any(has_inverse_function)
}
