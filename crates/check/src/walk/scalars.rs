//! Equations between scalars: entries, definitions, identities, values of joints and angles.

use super::{Assertion, Defined, Pair, Piece, Reference, Scalar, Spoken, Walk};
use crate::facts::About;
use crate::lexis::set_in;
use crate::names::Name;
use crate::note::{Unread, Unreadable};
use denavit::description::read_value;
use denavit::geometry::orientation::OrientationSet;
use denavit_reading::document::Statement;
use denavit_symbolic::parse::{Function, Syntax, SyntaxKind};
use denavit_symbolic::vocabulary::plain_name;
use denavit_symbolic::{Angle, Expr, Node};
use std::ops::Range;

impl Walk<'_> {
    pub(super) fn scalar(&self, span: &Range<usize>) -> Scalar {
        let errors = match self.lexis.formula(self.text, span) {
            Ok(syntax) => return Scalar::Formula(span.clone(), syntax),
            Err(errors) => errors,
        };
        let plain: String = self.source(span).chars().filter(|c| c.is_alphanumeric() || *c == '|').collect();
        let is_determinant = matches!(
            plain.as_str(),
            "detJ" | "|J|" | "leftJright" | "detJq" | "detleftJright" | "left|Jright|"
        );
        if is_determinant && let Some(value) = self.subject.determinant() {
            let kind = SyntaxKind::Name(value);
            return Scalar::Formula(span.clone(), Syntax { kind, span: 0..span.len() });
        }
        match self.lexis.lone_name(self.text, span) {
            Some(name) if name.left.is_empty() && name.sup.is_empty() && name.arguments.is_empty() => {
                match self.conventional(&name) {
                    Some(value) => {
                        let kind = SyntaxKind::Name(value);
                        Scalar::Formula(span.clone(), Syntax { kind, span: 0..span.len() })
                    }
                    None => Scalar::Lone(name),
                }
            }
            _ => Scalar::Broken(span.clone(), errors.into_iter().map(Unread::from).collect()),
        }
    }

    /// What `x`, `Y`, `x_x` or `z_y` mean by custom, where the document gives no other meaning.
    pub(super) fn conventional(&self, name: &Name) -> Option<Expr> {
        if name.base == "det" && name.sub.is_empty() {
            return self.subject.determinant();
        }
        if self.subject.last() == 0 {
            return None;
        }
        let digits: Vec<u32> = name.sub.chars().filter_map(|c| c.to_digit(10)).collect();
        if let ("J", [r, c]) = (name.base.as_str(), &digits[..]) {
            let (_, j) = self.subject.jacobians(6).into_iter().next()?;
            return j.entry((*r as usize).checked_sub(1)?, (*c as usize).checked_sub(1)?);
        }
        let axis = |c: &str| ["x", "y", "z"].iter().position(|a| *a == c.to_lowercase());
        let plain = format!("{}{}", name.base, name.sub);
        let pose = self.subject.pose();
        match (axis(&name.base), name.sub.as_str()) {
            (Some(r), "" | "p" | "P") => Some(pose.translation.0[r]),
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
        let read: Vec<Scalar> = spans.iter().map(|s| self.scalar(s)).collect();
        let is_matrix = |s: &Scalar| match s {
            Scalar::Lone(name) => self.lexis.matrix(self.subject, name).is_some(),
            Scalar::Broken(span, _) => self.is_product(span),
            Scalar::Formula(..) => false,
        };
        if !read.iter().any(|s| matches!(s, Scalar::Formula(..))) || read.iter().skip(1).any(is_matrix) {
            let all_matrices = read.iter().all(|s| is_matrix(s) || matches!(s, Scalar::Lone(_)));
            if all_matrices || read.iter().any(is_matrix) {
                return false;
            }
        }
        if self.configuration(&spans, &read) {
            return true;
        }
        if let Some(spoken) = self.values(&spans, &read).or_else(|| self.angle(statement, &read)) {
            let about = match spoken {
                Spoken::Joint { .. } => About::Joint,
                Spoken::Angle { set, .. } => About::Angle(set),
            };
            let assertion = Assertion { spoken: Some(spoken), ..self.assertion(statement, about) };
            self.assertions.push(assertion);
            return true;
        }
        self.record_sine(&spans, &read);
        let told = claim.and_then(|words| self.told_entry(words));
        // A name that the document defines here.
        let is_definition = told.is_none()
            && match &read[..] {
                [Scalar::Lone(name), Scalar::Formula(span, syntax), ..] => {
                    let name = plain_name(&format!("{}{}", name.base, name.sub));
                    let inverse = self.lexis.inverse_formula(self.text, span);
                    let inverse = inverse.map_or(syntax.value(), |s| s.value());
                    self.lexis.define(&name, syntax.value());
                    self.lexis.define_inverse(&name, inverse);
                    self.defined.push(Defined {
                        name,
                        span: span.clone(),
                        printed: syntax.clone(),
                        value: syntax.value(),
                        subject: self.number,
                    });
                    true
                }
                _ => false,
            };
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
        let others = read.iter().enumerate().filter(|(i, _)| *i != at);
        let mut pieces = vec![];
        for (i, s) in others {
            match s {
                Scalar::Formula(span, syntax)
                    if syntax.value().symbols().is_empty()
                        && !wanted.symbols().is_empty()
                        && self.at.is_complete(self.subject) =>
                {
                    pieces.extend(self.number(None, span, syntax.value(), wanted));
                }
                Scalar::Formula(span, syntax)
                    if is_measured(syntax.value()) && !wanted.symbols().is_empty() =>
                {
                    let errors = vec![Unread::new(span.clone(), Unreadable::NoConfiguration)];
                    pieces.push(Piece::Unreadable { place: None, span: span.clone(), errors });
                }
                Scalar::Formula(span, syntax) => pieces.push(Piece::Pair(Pair {
                    place: None,
                    span: span.clone(),
                    printed: Some(syntax.clone()),
                    value: syntax.value(),
                    wanted,
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
        let mut assertion = self.assertion(statement, about);
        assertion.pieces = pieces;
        self.assertions.push(assertion);
        true
    }

    /// Keeps what is printed for the sine or cosine of a joint: `c_3 = D`, `s_3 = ±√(1 − D²)`.
    fn record_sine(&mut self, spans: &[Range<usize>], read: &[Scalar]) {
        let ([_, right], [Scalar::Formula(_, left), _]) = (spans, read) else { return };
        let sine = left.value();
        if !matches!(sine.node(), Node::Sin(_) | Node::Cos(_)) {
            return;
        }
        let Ok(syntax) = self.lexis.inverse_formula(self.text, right) else { return };
        let known: Vec<(Expr, Expr)> = self.sines.iter().filter_map(|s| Some((s.0, *s.1.first()?))).collect();
        let values: Vec<Expr> = syntax.variants().iter().map(|s| replaced(s, &known, 0)).collect();
        self.sines.retain(|s| s.0 != sine);
        if !values.iter().any(|v| v.symbols().iter().any(|s| sine.symbols().contains(s))) {
            self.sines.push((sine, values));
        }
    }

    /// Reads the values that a line of prose gives: `with a1 = 1 and θ1 = 30°`.
    pub(super) fn told_in(&mut self, prose: &Range<usize>) {
        let Some(line) = self.text.get(prose.clone()).filter(|l| l.len() < 500) else { return };
        let joined = line.replace('$', " ");
        let parts: Vec<&str> = joined.split('=').collect();
        for pair in parts.windows(2) {
            let name = pair[0].trim().rsplit([' ', ',', ';', '(']).next().unwrap_or_default();
            let value = pair[1].trim_start();
            let value = value.split([',', ';', ')']).next().unwrap_or_default();
            let value = value.split(" and ").next().unwrap_or_default().trim().trim_end_matches([':', '.']);
            // `0.8 we get`: the number alone.
            let number = value.split(' ').next().unwrap_or_default();
            if name.is_empty() || !self.assign(name, value) {
                self.assign(name, number);
            }
        }
    }

    /// Gives a joint or a length a value; false if that is not what is written.
    fn assign(&mut self, name: &str, value: &str) -> bool {
        let Some(symbol) = self.lexis.names.lookup(name).and_then(|e| e.as_symbol()) else { return false };
        let d = &self.subject.description;
        if let Some(joint) = d.variables().iter().position(|v| v.symbol == symbol) {
            let Ok(read) = crate::lexis::read(value, &(0..value.len()), &self.lexis.names) else {
                return false;
            };
            let constant = read.value();
            if constant.symbols().is_empty() {
                self.at.set(joint, constant);
                return true;
            }
            return false;
        }
        let Ok(constant) = read_value(value, d.measure(symbol)) else { return false };
        self.at.give(symbol, constant);
        true
    }

    /// Reads `θ_1 = 30°` or `a_1 = 500 mm` as a part of a configuration.
    fn configuration(&mut self, spans: &[Range<usize>], read: &[Scalar]) -> bool {
        if let ([name, value], [Scalar::Formula(_, left), right]) = (spans, read)
            && let SyntaxKind::Name(e) = left.kind
            && let Some(symbol) = e.as_symbol()
            && self.subject.description.parameter(symbol).is_some()
        {
            let is_constant = match right {
                Scalar::Formula(_, s) => s.value().symbols().is_empty(),
                Scalar::Broken(..) => true,
                Scalar::Lone(_) => false,
            };
            let (name, value) = (self.source(name), self.source(value));
            if is_constant && self.assign(name, value) {
                return true;
            }
        }
        let [Scalar::Formula(_, left), Scalar::Formula(_, right)] = read else { return false };
        let value = right.value();
        let joint = match left.kind {
            SyntaxKind::Name(e) => {
                let variables = self.subject.description.variables();
                e.as_symbol().and_then(|s| variables.iter().position(|v| v.symbol == s))
            }
            _ => None,
        };
        let Some(joint) = joint.filter(|_| value.symbols().is_empty()) else { return false };
        self.at.set(joint, value);
        true
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
        let SyntaxKind::Name(of) = left.kind else { return None };
        let variables = self.subject.description.variables();
        let angle = Angle::of(of);
        let is_joint = |e: &Expr| e.as_symbol().is_some_and(|s| variables.iter().any(|v| v.symbol == s));
        let is_sum = !angle.terms.is_empty() && angle.terms.iter().all(|(e, k)| is_joint(e) && k.is_one());
        if !is_sum || self.is_right_name(first) || rest.is_empty() {
            return None;
        }
        let mut sides = vec![];
        for span in rest {
            sides.push((span.clone(), self.lexis.inverse_formula(self.text, span).ok()?));
        }
        let is_value = |syntax: &Syntax, span: &Range<usize>| {
            has_inverse_function(syntax) || self.speaks_of_pose(span) || syntax.sign_choices() > 0
        };
        if !sides.iter().any(|(span, syntax)| is_value(syntax, span)) {
            return None;
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
        Some(Spoken::Joint { of, sides, branches })
    }

    /// Values for an angle of an orientation: `φ = atan2(R(2,3), R(1,3))`.
    pub(super) fn angle(&self, statement: &Statement, read: &[Scalar]) -> Option<Spoken> {
        let set = self.angles.or_else(|| {
            let words = [&statement.prose, &statement.heading];
            words.into_iter().flatten().find_map(|span| set_in(self.text.get(span.clone())?))
        })?;
        let (side, rest) = statement.sides.split_first()?;
        let [value] = rest else { return None };
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

    pub(super) fn told_matrix(&self, words: &str) -> Option<Reference> {
        let name = self.lexis.lone_name(words, &(0..words.len()))?;
        let (matrix, about) = self.lexis.matrix(self.subject, &name)?;
        Some(Reference { matrix, about: Some(about?) })
    }
}

/// True for a number that somebody computed: neither 0 nor ±1.
pub(super) fn is_measured(e: Expr) -> bool {
    e.as_number().is_some_and(|r| !r.is_zero() && !r.is_one() && !(-&r).is_one())
}

/// The value of a formula with other values for some sines.
pub(super) fn replaced(syntax: &Syntax, by: &[(Expr, Expr)], depth: usize) -> Expr {
    if depth > 200 || by.is_empty() {
        return syntax.value();
    }
    let inner = |s: &Syntax| replaced(s, by, depth + 1);
    match &syntax.kind {
        SyntaxKind::Name(e) => by.iter().find(|b| b.0 == *e).map_or(*e, |b| b.1),
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
