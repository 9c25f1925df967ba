//! What a document states: configurations, lengths, rates, in formulas and in sentences.

use super::cases::tells_goal;
use super::units::shared;
use super::words::{JOINTS, LENGTHS, RATES, SAME, VALUES, WORST, puts_to_zero};
use super::{Scalar, Walk};
use crate::lexis::read;
use denavit::description::{JointKind, Measure, Variable, read_value};
use denavit_reading::code::Dialect;
use denavit_symbolic::parse::{SyntaxKind, subscript};
use denavit_symbolic::vocabulary::plain_name;
use denavit_symbolic::{Expr, Symbol};
use std::ops::Range;

/// Sentences of more bytes state nothing.
const LONGEST: usize = 1_000;
/// A unit stands at most so many bytes behind a value.
const LIST: usize = 300;
/// What a list of values is for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum List {
    Joints,
    Rates,
    Lengths,
}

impl Walk<'_> {
    /// Reads the values that a line of prose gives: `with a1 = 1 and θ1 = 30°`, `q = (30°, 45°)`, `lengths 0.5, 0.4`.
    pub(super) fn told_in(&mut self, prose: &Range<usize>) {
        let before = self.at.present();
        let whole = self.at.clone();
        self.told_of(prose);
        if self.at.present() != before {
            self.before_told = (prose.clone(), whole);
        }
        self.learn_label(prose, &before);
    }

    fn told_of(&mut self, prose: &Range<usize>) {
        let Some(line) = self.text.get(prose.clone()).filter(|l| l.len() < LONGEST) else { return };
        if is_case(line) {
            return;
        }
        let joined = line
            .replace('$', " ")
            .replace('\u{200b}', "   ")
            .replace("\\left", "     ")
            .replace("\\right", "      ");
        let joined = joined.replace("\\,", "  ").replace("\\;", "  ");
        let lower = joined.to_lowercase();
        if tells_goal(&lower) {
            self.at.forget_joints(self.in_inverse);
        }
        if WORST.iter().any(|words| lower.contains(words)) {
            self.at.forget_joints(false);
        }
        self.recall_named(&lower);
        if self.in_inverse && SAME.iter().any(|words| lower.contains(words)) {
            self.at.recall_joints();
            self.seek(false);
        }
        if puts_to_zero(&lower) {
            (0..self.subject.joints().len()).for_each(|joint| self.at.set(joint, Expr::int(0)));
        }
        self.told_row(&joined);
        self.told_words(&joined);
        self.told_speeds(&joined);
        self.told_names(&joined);
        self.told_lists(&joined);
        self.told_tuples(&joined, prose.start);
        let parts: Vec<&str> = joined.split('=').collect();
        let mut names: Vec<&str> = vec![];
        let mut at = 0;
        for pair in parts.windows(2) {
            let start = at + pair[0].rfind([' ', ',', ';', '(']).map_or(0, |i| i + 1);
            at += pair[0].len() + 1;
            let name = pair[0].trim().rsplit([' ', ',', ';', '(']).next().unwrap_or_default();
            let rest = pair[1].trim_start();
            let value = rest.split([',', ';', ')']).next().unwrap_or_default();
            let value =
                JOINTS.iter().filter_map(|j| value.split_once(j)).map(|v| v.0).min_by_key(|v| v.len());
            let value = value.unwrap_or(rest.split([',', ';', ')']).next().unwrap_or_default());
            let value = value.trim().trim_end_matches([':', '.', '?', '!']);
            // `cos θ3 = 0.2` says nothing of θ3 itself.
            let before = pair[0].trim_end().strip_suffix(name).unwrap_or_default().trim_end();
            let word =
                before.rsplit([' ', '(', '$', '\\', '·', '*', '+', '-', '−']).next().unwrap_or_default();
            let is_argument = matches!(word, "cos" | "sin" | "tan" | "sen" | "tg" | "det");
            // `a1 − a2 = 0.2` says nothing of a2 itself.
            let signs = ['+', '-', '−', '·', '*', '/', '±', '×', '^', '|'];
            let operand = before.strip_suffix(signs).map(str::trim_end);
            let is_term =
                operand.is_some_and(|o| o.ends_with(|c: char| c.is_alphanumeric() || ")}]".contains(c)));
            if name.is_empty() || is_argument || is_term {
                names.clear();
                continue;
            }
            names.push(name);
            // `0.8 we get`: the number alone, or it with its unit.
            let words: Vec<&str> = value.split(' ').filter(|w| !w.is_empty()).collect();
            let short = words.iter().take(2).copied().collect::<Vec<&str>>().join(" ");
            let first = words.first().copied().unwrap_or_default();
            // `36.9° - 29.5°` is no value with words behind it.
            let is_sum = words.get(1).is_some_and(|w| matches!(*w, "-" | "+" | "−" | "±" | "*" | "/" | "·"));
            let tried = match is_sum {
                true => [value; 3],
                false => [value, short.as_str(), first.trim_end_matches([':', '.'])],
            };
            let mut is_given = false;
            let behind = joined.get(at + pair[1].len() - rest.len() + value.len()..).unwrap_or_default();
            let with_unit = self.with_shared_unit(&names, value, behind);
            let tried = with_unit.as_deref().map_or(tried, |v| [v; 3]);
            for name in &names {
                is_given |= tried.iter().any(|v| self.assign(name, v));
            }
            if is_given {
                let end = prose.start + (at + pair[1].len() - rest.len() + value.len()).min(line.len());
                // Numbers of joints behind a pose are answers, which are not passed over.
                let is_answer = self.in_inverse && !self.goal.is_empty();
                if !is_answer {
                    self.taken.push(prose.start + start.min(line.len())..end);
                }
                names.clear();
            } else if plain_name(value) != value.replace(['_', '{', '}', '\\', ' '], "") || !is_name(value) {
                names.clear();
            }
        }
    }

    /// Reads the names that words give a formula: `let zeta be the wanted t2+t3+t4`.
    fn told_names(&mut self, line: &str) {
        const VERBS: [&str; 7] =
            [" be ", " denote ", " denotes ", " stand for ", " stands for ", " means ", " bezeichnet "];
        // Places stay where they are.
        let lower = line.to_ascii_lowercase();
        for (at, verb) in VERBS.iter().flat_map(|v| lower.match_indices(v)) {
            let before = line[..at].trim_end();
            let name =
                before.rsplit([' ', '(', ',']).next().unwrap_or_default().trim_matches(['$', '*', '`']);
            let is_let = verb != " be "
                || before[..before.len() - name.len()].trim_end().to_lowercase().ends_with("let");
            if !is_let || name.is_empty() || self.lexis.names.lookup(name).is_some() {
                continue;
            }
            let rest = line[at + verb.len()..].split(['.', ',', ';', ':']).next().unwrap_or_default();
            // The formula stands at the end of the phrase.
            let words: Vec<(usize, &str)> = rest
                .split(' ')
                .scan(0, |k, w| {
                    let start = *k;
                    *k += w.len() + 1;
                    Some((start, w))
                })
                .collect();
            let value = words.iter().find_map(|(start, _)| {
                let source = rest.get(*start..)?.trim().trim_matches(['$', '*', '`']);
                let value = read(source, &(0..source.len()), &self.lexis.names).ok()?.value();
                (!value.symbols().is_empty()).then_some(value)
            });
            if let Some(value) = value {
                let plain = plain_name(name);
                self.lexis.define(&plain, value);
                let inverse = denavit_symbolic::Angle::of(value);
                let is_sum = inverse.terms.iter().all(|(e, _)| self.subject.joints().contains(e));
                // A sum of joints that is wanted is known where the joints are looked for.
                if is_sum && inverse.terms.len() > 1 {
                    let entry = self.direction_of(value);
                    self.lexis.define_inverse(&plain, entry.unwrap_or(value));
                }
            }
        }
    }

    /// The angle of the hand in its plane by the entries of the pose, where a sum of joints is that.
    fn direction_of(&self, sum: Expr) -> Option<Expr> {
        let rows = self.subject.pose().rotation.rows();
        let symbol = |r: usize, c: usize| Expr::from(self.lexis.pose_symbol(r, c));
        let mut points = denavit_reading::slip::Points::new(5);
        let (sine, cosine) = (points.value(sum.sin()), points.value(sum.cos()));
        let find = |value| {
            (0..9).map(|k| (k / 3, k % 3)).find(|&(r, c)| {
                let mut points = denavit_reading::slip::Points::new(5);
                points.value(rows[r][c]) == value
            })
        };
        let ((a, b), (c, d)) = (find(sine)?, find(cosine)?);
        Some(symbol(a, b).atan2(symbol(c, d)))
    }

    /// Reads the values that the comments of a program give.
    pub(in super::super) fn told_in_comments(&mut self, span: &Range<usize>, language: Dialect) {
        let mark = super::super::listing::comment_mark(language);
        let Some(text) = self.text.get(span.clone()) else { return };
        let mut start = span.start;
        for line in text.split_inclusive('\n') {
            if let Some(at) = line.find(mark) {
                self.told_in(&(start + at + mark.len()..start + line.trim_end().len()));
            }
            start += line.len();
        }
    }

    /// Reads the values that the lines between two statements give, but for the prose that is read with the second.
    pub(super) fn told_between(&mut self, span: &Range<usize>, prose: Option<&Range<usize>>) {
        let Some(text) = self.text.get(span.clone()) else { return };
        let mut start = span.start;
        for line in text.split_inclusive('\n') {
            let here = start..start + line.trim_end().len();
            start += line.len();
            let is_prose = prose.is_some_and(|p| p.start < here.end && here.start < p.end);
            let is_text = !line.trim_start().starts_with(['|', '%', '!', '#', '\\', '<']);
            if line.contains('=') && is_text && !is_prose {
                self.told_in(&here);
            } else if is_text && line.trim_start().starts_with(['(', '-', '*']) && line.len() < LONGEST {
                self.told_row(line);
            } else if is_text && tells_goal(&line.to_lowercase()) {
                self.look_for_joints();
            } else if is_text && !is_prose && line.len() < LONGEST {
                self.recall_named(&line.to_lowercase());
            }
        }
    }

    /// `q = (30°, 45°, 0.1 m)`, `(θ1, θ2) = (…)`.
    fn told_tuples(&mut self, line: &str, start: usize) {
        for (at, _) in line.match_indices('=') {
            let behind = &line[at + 1..];
            let open = behind.trim_start();
            // `q = np.radians([20, 45])`
            const CALLS: [&str; 8] = [
                "np.radians(",
                "np.deg2rad(",
                "numpy.radians(",
                "deg2rad(",
                "radians(",
                "np.array(",
                "numpy.array(",
                "math.radians(",
            ];
            let call = CALLS.iter().find(|c| open.starts_with(**c));
            let is_degrees = call.is_some_and(|c| c.contains("rad"));
            let open = call.map_or(open, |c| &open[c.len()..]);
            let Some(inner) = open.strip_prefix(['(', '[']) else { continue };
            let Some(close) = inner.find([')', ']']) else { continue };
            let values: Vec<String> = inner[..close]
                .split([',', ';'])
                .map(|v| format!("{}{}", v.trim_matches(['\\', ' ', '~']), if is_degrees { "°" } else { "" }))
                .collect();
            let values: Vec<&str> = values.iter().map(String::as_str).collect();
            let before = line[..at].trim_end();
            let name = before.rsplit([' ', ',', ';', ':']).next().unwrap_or_default();
            let plain = crate::custom::plain(&name.replace(['(', ')', '*'], ""));
            let is_dotted = before[..before.len() - name.len()].trim_end().ends_with("\\dot");
            let plain = if is_dotted { format!("dot{plain}") } else { plain };
            let plain =
                plain.trim_start_matches("mathbf").trim_start_matches("boldsymbol").trim_start_matches("vec");
            let is_angles = matches!(plain, "θ" | "Θ" | "ϑ" | "φ");
            let is_joints = is_angles || matches!(plain, "q" | "Q") || self.is_letter_of_joints(plain);
            let is_rates = matches!(plain, "dotq" | "dotθ" | "qdot" | "dotmathbfq" | "thetadot" | "dq")
                || matches!(plain, "q\u{307}" | "θ\u{307}");
            let listed = before.ends_with(')') && self.is_list_of_joints(before);
            let list = match () {
                () if is_joints || listed => List::Joints,
                () if is_rates => List::Rates,
                () => continue,
            };
            if self.assign_list(list, &values) || is_angles && self.assign_angles(&values) {
                let from = start + at - name.len();
                let length = at + 1 + (behind.len() - open.len()) + 1 + close;
                self.taken.push(from.min(start + at)..start + length);
            }
        }
    }

    /// `(-30, 60, 150, 30):` at the beginning of a line, one number a joint.
    pub(super) fn told_row(&mut self, line: &str) {
        let begins = line.trim_start().trim_start_matches(['-', '*', '•', ' ']);
        let Some((inner, rest)) = begins.strip_prefix('(').and_then(|l| l.split_once(')')) else { return };
        let rest = rest.trim_start();
        let leads = [":", "->", "→", "=>", "|", "⇒"].iter().any(|sign| rest.starts_with(sign));
        let values: Vec<&str> = inner.split([',', ';']).map(str::trim).collect();
        let is_number =
            |v: &&str| v.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '-' | '−' | '+' | '.'));
        if leads && values.len() == self.subject.joints().len() && values.iter().all(is_number) {
            self.assign_list(List::Joints, &values);
        }
    }

    /// True for the letter that the names of all joints have before their number: `t` of `t1`, `t2`, `t3`.
    fn is_letter_of_joints(&self, letter: &str) -> bool {
        let is_letter = !letter.is_empty() && letter.chars().all(char::is_alphabetic);
        let mut named = (1..).zip(self.subject.joints());
        is_letter && named.all(|(k, joint)| self.lexis.names.lookup(&format!("{letter}{k}")) == Some(*joint))
    }

    /// Gives the joints that turn values in their order; false if there are not as many.
    fn assign_angles(&mut self, values: &[&str]) -> bool {
        let variables = self.subject.description.variables();
        let turning: Vec<usize> =
            (0..variables.len()).filter(|&k| variables[k].kind == JointKind::Revolute).collect();
        if turning.len() != values.len() || turning.len() < 2 {
            return false;
        }
        let Some(read) = values.iter().map(|v| self.constant(v)).collect::<Option<Vec<Expr>>>() else {
            return false;
        };
        turning.into_iter().zip(read).for_each(|(k, value)| self.at.set(k, value));
        true
    }

    /// True for `(q1, q2, q3)` at the end of a text: all joints in their order.
    fn is_list_of_joints(&self, text: &str) -> bool {
        let Some(open) = text.rfind('(') else { return false };
        let names = text[open + 1..text.len() - 1].split(',');
        let found: Vec<Option<Expr>> = names.map(|n| self.lexis.names.lookup(n.trim())).collect();
        let joints = self.subject.joints();
        found.len() == joints.len() && found.iter().zip(joints).all(|(f, q)| *f == Some(*q))
    }

    /// `lengths 1.0, 0.8, 0.4`
    fn told_lists(&mut self, line: &str) {
        // Places stay where they are.
        let lower = line.to_ascii_lowercase();
        let all = [(List::Lengths, &LENGTHS[..]), (List::Joints, &VALUES[..]), (List::Rates, &RATES[..])];
        for (list, words) in all {
            for word in words {
                let Some(at) = lower.find(word) else { continue };
                let rest = line[at + word.len()..].trim_start_matches([':', ' ', '=', '(']);
                let joined = JOINTS.iter().fold(rest.to_string(), |r, j| r.replace(j, ", "));
                let mut values: Vec<&str> = vec![];
                for value in joined.split(',').map(str::trim) {
                    let number = value.trim_end_matches(['.', ')', ':', ';']);
                    if !number.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '-' | '−' | '.')) {
                        break;
                    }
                    values.push(number);
                }
                // What follows the last number is no part of it.
                let last = values.pop().map(|v| v.split(' ').take(2).collect::<Vec<_>>().join(" "));
                let mut owned: Vec<String> = values.iter().map(ToString::to_string).collect();
                owned.extend(last);
                for take in [2, 1] {
                    if let Some(last) = owned.last_mut() {
                        *last = last.split(' ').take(take).collect::<Vec<_>>().join(" ");
                    }
                    let values: Vec<&str> = owned.iter().map(String::as_str).collect();
                    if self.assign_list(list, &values) {
                        break;
                    }
                }
            }
        }
    }

    /// Gives values in the order of the joints, or of the lengths; false if there are not as many.
    pub(super) fn assign_list(&mut self, list: List, values: &[&str]) -> bool {
        let d = &self.subject.description;
        let symbols: Vec<Symbol> = match list {
            List::Joints => d.variables().iter().map(|v| v.symbol).collect(),
            List::Rates => self.subject.rates().iter().filter_map(|e| e.as_symbol()).collect(),
            List::Lengths => d.parameters.iter().map(|p| p.symbol).collect(),
        };
        if symbols.len() != values.len() || symbols.is_empty() {
            return false;
        }
        let read: Option<Vec<Expr>> = values
            .iter()
            .zip(&symbols)
            .map(|(v, s)| match list {
                List::Lengths => read_value(v, d.measure(*s)).ok().map(|v| self.in_unit(v, 1)),
                List::Joints | List::Rates => self.constant(v),
            })
            .collect();
        let Some(read) = read else { return false };
        for (k, value) in read.into_iter().enumerate() {
            match list {
                List::Joints => self.at.set(k, value),
                List::Rates | List::Lengths => self.at.give(symbols[k], value),
            }
        }
        true
    }

    /// What is proportional to a power of a length, out of metres into the unit in which the document has lengths.
    pub(super) fn in_unit(&self, metres: Expr, power: u32) -> Expr {
        if self.lexis.habits.scaled { metres * Expr::int(1000_i64.pow(power)) } else { metres }
    }

    /// A number with its unit: `30°`, `0.1 m`, `0.5 rad/s`.
    pub(super) fn constant(&self, text: &str) -> Option<Expr> {
        let text = text.trim().trim_end_matches('.');
        let (number, factor) = match crate::numbers::unit_behind(text) {
            // The unit is that of a number, not of the last term of a sum.
            Some((number, ..))
                if number.trim_start_matches(['-', '+', '−']).contains(['-', '+', '−', '±', '°']) =>
            {
                return None;
            }
            Some((number, factor, power)) => (number, self.in_unit(factor, power)),
            None => (text, Expr::int(1)),
        };
        let value = read(number, &(0..number.len()), &self.lexis.names).ok()?.value();
        value.symbols().is_empty().then(|| value * factor)
    }

    /// The symbol of a name as it is written, and the name without subscripts.
    fn named(&self, name: &str) -> (Option<Symbol>, String) {
        let letters = name.trim_matches(['*', '`']).replace("\\ell", "l").replace('ℓ', "l");
        let letters = letters.replace("\\vartheta", "\\theta");
        let name = letters.as_str();
        let plain: String = name.chars().map(|c| subscript(c).unwrap_or(c)).collect();
        let found = self.lexis.names.lookup(name).or_else(|| self.lexis.names.lookup(&plain));
        (found.and_then(|e| e.as_symbol()), plain)
    }

    /// True for the name of a joint, or of a length or an angle of the table.
    pub(super) fn is_of_robot(&self, name: &str) -> bool {
        let d = &self.subject.description;
        let symbol = self.named(name).0;
        symbol.is_some_and(|s| d.parameter(s).is_some() || d.variables().iter().any(|v| v.symbol == s))
    }

    /// True for the name of a length, or of a joint that slides.
    fn is_length(&self, name: &str) -> bool {
        let d = &self.subject.description;
        let Some(symbol) = self.named(name).0 else { return false };
        let slides = |v: &Variable| v.symbol == symbol && v.kind == JointKind::Prismatic;
        let is_parameter = d.parameter(symbol).is_some() && d.measure(symbol) == Measure::Length;
        is_parameter || d.variables().iter().any(slides)
    }

    /// The value of a length with the unit behind the last value of its list, where it has none of its own.
    fn with_shared_unit(&self, names: &[&str], value: &str, behind: &str) -> Option<String> {
        value.trim_start_matches(['-', '−']).parse::<f64>().ok()?;
        let is_length = |name: &str| self.is_length(name);
        let unit = shared(behind, &is_length)?;
        names.iter().all(|name| is_length(name)).then(|| format!("{value} {unit}"))
    }

    /// Gives a joint or a length a value; false if that is not what is written.
    pub(super) fn assign(&mut self, name: &str, value: &str) -> bool {
        let (symbol, plain) = self.named(name);
        let Some(symbol) = symbol else { return false };
        let d = &self.subject.description;
        if let Some(joint) = d.variables().iter().position(|v| v.symbol == symbol) {
            return match self.constant(value) {
                Some(constant) => {
                    self.at.set(joint, constant);
                    true
                }
                None => false,
            };
        }
        // Rates of joints are given where none are asked for.
        let is_rate = self.subject.rates().contains(&symbol.into());
        if is_rate && self.velocity_given().is_none() {
            let Some(constant) = self.constant(value) else { return false };
            self.at.give(symbol, constant);
            return true;
        }
        if d.parameter(symbol).is_none() {
            // A component of a load: `Fx = -18 kN`.
            let name = symbol.name();
            // `f2` may have it as its value, but is not its name.
            let is_own = crate::custom::plain(&plain) == crate::custom::plain(&name);
            let is_load = is_own
                && (self.lexis.is_by_custom(&plain)
                    || name.len() == 2
                        && name.starts_with(['F', 'f', 'M', 'm'])
                        && name.ends_with(['x', 'y', 'z'])
                    || self.lexis.habits.load.is_some_and(|l| *name == *l.0.to_string()));
            return match self.constant(value).filter(|_| is_load) {
                Some(constant) => {
                    self.at.give(symbol, constant);
                    true
                }
                None => false,
            };
        }
        let measure = d.measure(symbol);
        let Ok(constant) = read_value(value, measure) else { return false };
        // Without a unit it is in that of the document already.
        let has_unit = crate::numbers::unit_behind(value).is_some();
        let is_length = measure == Measure::Length && (has_unit || !self.lexis.habits.scaled);
        self.at.give(symbol, if is_length { self.in_unit(constant, 1) } else { constant });
        true
    }

    /// Reads `θ_1 = 30°` or `a_1 = 500 mm` as a part of a configuration.
    pub(super) fn configuration(&mut self, spans: &[Range<usize>], read: &[Scalar]) -> bool {
        let values: Vec<(&Range<usize>, Option<Symbol>)> = spans
            .iter()
            .zip(read)
            .map(|(span, s)| match s {
                Scalar::Formula(_, syntax) => match syntax.kind {
                    SyntaxKind::Name(e) => (span, e.as_symbol()),
                    _ => (span, None),
                },
                _ => (span, None),
            })
            .collect();
        let Some(((value, None), names)) = values.split_last() else { return false };
        if names.is_empty() || names.iter().any(|n| n.1.is_none()) {
            return false;
        }
        let is_constant = match read.last() {
            Some(Scalar::Formula(_, s)) => s.value().symbols().is_empty(),
            Some(Scalar::Broken(..)) => true,
            _ => false,
        };
        let end = (value.end..=value.end + LIST).rev().find(|&k| self.text.is_char_boundary(k));
        let behind = end.and_then(|end| self.text.get(value.end..end)).unwrap_or_default();
        let behind = behind.lines().next().unwrap_or_default();
        let value = self.source(value);
        let names: Vec<&str> = names.iter().map(|n| self.source(n.0)).collect();
        let with_unit = self.with_shared_unit(&names, value, behind);
        let value = with_unit.as_deref().unwrap_or(value);
        // `v_z` behind `v_x`, `v_y` that were computed is the third of them, also where one joint alone has it.
        let velocity = |name: &str| {
            let plain = crate::custom::plain(name);
            ["vx", "vy", "vz", "Vx", "Vy", "Vz"].contains(&&*plain).then_some(plain)
        };
        let before: Vec<String> =
            self.assertions.iter().rev().take(2).filter_map(|a| velocity(&a.name)).collect();
        let is_next = |name: &str| {
            let own = velocity(name).filter(|own| own.ends_with('z'));
            own.is_some_and(|own| before.len() == 2 && before[0] != before[1] && !before.contains(&own))
        };
        if matches!(names[..], [name] if is_next(name)) {
            return false;
        }
        is_constant && names.iter().all(|name| self.assign(name, value))
    }
}

/// True for a text that tells a case, not a configuration.
pub(super) fn is_case(line: &str) -> bool {
    const CASES: [&str; 32] = [
        "singolar",
        "satisf",
        "erfüll",
        "soddisf",
        "vérifie",
        "if ",
        "iff ",
        "loses rank",
        "lose rank",
        "drops rank",
        "rank drops",
        "only for ",
        "genau dann",
        "nur dann",
        "si et seulement",
        "s'annulent",
        "se anula",
        "si annulla",
        "when ",
        "unless",
        "singul",
        "falls ",
        "wenn ",
        "sofern",
        "lorsque",
        "cuando",
        "quando ",
        "whenever",
        "vanish",
        "degenerate",
        "should give",
        "s'annule",
    ];
    let lower = line.to_lowercase();
    let is_word = |i: usize| !lower[..i].chars().next_back().is_some_and(char::is_alphanumeric);
    // `The height would be with b = 90°: z = 4.70` states a configuration.
    let is_stated = |rest: &str| ["be with ", "be at ", "be for "].iter().any(|w| rest.starts_with(w));
    let would = "would ";
    let supposes =
        lower.match_indices(would).any(|(i, _)| is_word(i) && !is_stated(&lower[i + would.len()..]));
    supposes || CASES.iter().any(|c| lower.match_indices(c).any(|(i, _)| is_word(i)))
}

fn is_name(text: &str) -> bool {
    let text = text.trim();
    text.starts_with(|c: char| c.is_alphabetic() || c == '\\') && !text.contains(' ')
}

/// Where the sentence of a line ends in which a statement ends: at the line's end, or at a full stop before a capital.
pub(super) fn sentence_end(text: &str, line: &Range<usize>, from: usize) -> usize {
    let is_short = line.contains(&from) && line.len() < LONGEST;
    let Some(rest) = text.get(from..line.end).filter(|_| is_short) else { return line.end };
    let ends = |at: &usize| {
        let behind = &rest[at + 1..];
        let begins = behind.trim_start().chars().next().is_some_and(char::is_uppercase);
        let word = rest[..*at].chars().next_back();
        behind.starts_with(' ')
            && begins
            && word.is_none_or(|c| c.is_alphanumeric() || matches!(c, ')' | '$' | '°'))
    };
    rest.match_indices('.').map(|m| m.0).find(ends).map_or(line.end, |at| from + at + 1)
}
