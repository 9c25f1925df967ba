//! The verdict on each pair of formulas, by proof; what is wrong with it, and the smallest change that mends it.

use super::facts::{Condition, Remark, SlipKind, Unproved};
use super::formula::Formula;
use super::habits::with_named_signs;
use super::inverse::Composed;
use super::leeway;
use super::numbers::{self, Answer};
use super::outcome::{Claim, Counterexample, Entry, Finding, Patch, Slip, Standing, Wrong};
use super::plan::{Plan, Walked};
use super::subject::Subject;
use super::supposed;
use super::values;
use super::walk::{Assertion, Pair, Piece, is_measured};
use super::whole;
use denavit_reading::slip::{Effort, Lexicon, Points, Repair, Slip as Kind, Wanted, repairs};
use denavit_symbolic::parse::{Syntax, SyntaxKind};
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::readable::{literals, simplify};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Equality, Expr, Symbol, equal};
use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::ops::Range;
use std::rc::Rc;

/// A formula of more literals is not shown.
const MAX_SHOWN: u64 = 300;

/// The claims of a document with their verdicts, and what the formulas of all joints yield together.
pub(super) fn judge(
    text: &str,
    plan: &Plan,
    walked: &Walked,
    tolerance: Option<f64>,
) -> (Vec<Claim>, Vec<(Range<usize>, Composed)>) {
    let mut judge = Judge { tolerance, ..Judge::new(text, plan, walked) };
    let mut claims: Vec<Claim> = walked.assertions.iter().map(|a| judge.claim(a)).collect();
    let (values, notes) = values::judge(text, plan, walked);
    for (at, claim) in values {
        claims[at] = claim;
    }
    (claims, notes)
}

/// What judging needs, one of a kind for each robot.
pub(super) struct Judge<'a> {
    text: &'a str,
    plan: &'a Plan,
    walked: &'a Walked,
    lexicons: BTreeMap<usize, Option<Lexicon>>,
    /// Spellings of the document, for the lexicons.
    spellings: Vec<(Expr, String)>,
    /// How far numbers may be off.
    tolerance: Option<f64>,
    /// The names of the present claim, where they are its own.
    own_names: Option<Rc<Vocabulary>>,
    /// Whether slips are looked for.
    has_slips: bool,
    /// Right formulas as a person would write them.
    readable: BTreeMap<Expr, Expr>,
    /// The work left for slips, in formulas.
    budget: usize,
}

/// The cost of the largest change that is called a slip; a sign costs 10.
const MAX_COST: u32 = 60;
/// The cost of the largest lost term, which may be long.
const MAX_TERM: u32 = 100;
/// The cost of a sign.
const SIGN: u32 = 10;
/// No more formulas than these are looked at for slips.
const MAX_SLIPS: usize = 150;

impl<'a> Judge<'a> {
    pub fn new(text: &'a str, plan: &'a Plan, walked: &'a Walked) -> Self {
        let mut spellings = vec![];
        for assertion in &walked.assertions {
            for piece in &assertion.pieces {
                if let Piece::Pair(Pair { printed: Some(syntax), span, .. }) = piece {
                    let source = text.get(span.clone()).unwrap_or_default();
                    visit(syntax, &mut |part: &Syntax| {
                        let spelled = source.get(part.span.clone()).unwrap_or_default();
                        match &part.kind {
                            SyntaxKind::Name(e) if spelled.len() < 60 => {
                                spellings.push((*e, spelled.to_string()))
                            }
                            SyntaxKind::Call(..) if spelled.len() < 60 => {
                                spellings.push((part.value(), spelled.to_string()));
                            }
                            _ => {}
                        }
                    });
                }
            }
        }
        spellings.sort_by(|a, b| a.1.cmp(&b.1));
        spellings.dedup();
        Judge {
            text,
            plan,
            walked,
            lexicons: BTreeMap::new(),
            spellings,
            tolerance: None,
            own_names: None,
            has_slips: true,
            readable: BTreeMap::new(),
            budget: MAX_SLIPS,
        }
    }

    fn claim(&mut self, assertion: &Assertion) -> Claim {
        let exchanged = whole::exchanged(assertion);
        let instead = whole::instead(assertion, self.plan);
        self.has_slips = instead.is_none();
        self.own_names = assertion.names.clone();
        let mut entries: Vec<Entry> = vec![];
        for (i, piece) in assertion.pieces.iter().enumerate() {
            let other = exchanged.get(&i).copied();
            let mut entry = self.entry(piece, assertion.subject);
            if let (Some(other), Finding::Wrong(wrong)) = (other, &mut entry.finding) {
                self.exchange(assertion, i, other, wrong);
            }
            entries.push(entry);
        }
        // A number behind a formula that is not read may be this formula's own, with what is not known in it.
        let is_hidden = |e: &Entry| e.place.is_none() && e.finding.standing() == Standing::Unreadable;
        if let Some(hidden) = entries.iter().position(is_hidden) {
            let mut pieces = assertion.pieces.iter().enumerate();
            entries.retain(|e| {
                let is_number = matches!(pieces.next(), Some((i, Piece::Number { .. })) if i > hidden);
                !(is_number && e.finding.standing() == Standing::Wrong)
            });
        }
        Claim {
            entries,
            instead,
            span: assertion.span.clone(),
            name: assertion.name.clone(),
            about: assertion.about.clone(),
            remarks: assertion.remarks.clone(),
            robot: assertion.subject,
        }
    }

    /// Says that an entry stands in another's place.
    fn exchange(&self, assertion: &Assertion, i: usize, other: usize, wrong: &mut Wrong) {
        let (Piece::Pair(here), Piece::Pair(there)) = (&assertion.pieces[i], &assertion.pieces[other]) else {
            return;
        };
        let Some((r, c)) = there.place else { return };
        let source = |p: &Pair| self.text.get(p.span.clone()).unwrap_or_default().trim().to_string();
        let mut patches = vec![
            Patch { span: here.span.clone(), now: source(there) },
            Patch { span: there.span.clone(), now: source(here) },
        ];
        patches.sort_by_key(|p| p.span.start);
        wrong.correct = vec![source(there)];
        wrong.rivals = vec![];
        wrong.slip = Some(Slip { kind: SlipKind::ExchangedWith(r, c), patches, formula: source(there) });
    }

    fn entry(&mut self, piece: &Piece, subject: usize) -> Entry {
        match piece {
            Piece::Unreadable { place, span, errors } => Entry {
                place: *place,
                span: span.clone(),
                finding: Finding::Unreadable(errors.clone()),
                identities: vec![],
            },
            Piece::Number { place, span, answer } => Entry {
                place: *place,
                span: span.clone(),
                finding: self.number(answer, span, subject),
                identities: vec![],
            },
            Piece::Pair(pair) => {
                let pair = &self.in_numbers(pair, subject);
                let robot = &self.plan.subjects[subject];
                let mut finding = self.finding(pair, subject);
                let seen = match finding.standing() {
                    Standing::Wrong => leeway::of_inverse(pair, robot),
                    _ => None,
                };
                let pair = seen.as_ref().unwrap_or(pair);
                if seen.is_some() {
                    finding = self.finding(pair, subject);
                }
                if finding.standing() == Standing::Wrong && leeway::is_rounded(self.text, pair, robot) {
                    // Right in numbers: there is no identity.
                    let finding = Finding::Equal { unless_zero: vec![] };
                    return Entry { place: pair.place, span: pair.span.clone(), finding, identities: vec![] };
                }
                if finding.standing() == Standing::Wrong && leeway::with_locked_joints(self.text, pair, robot)
                {
                    let (correct, remarks) = (vec![], vec![]);
                    finding = Finding::Conditional { condition: Condition::Locked, correct, remarks };
                }
                if finding.standing() == Standing::Wrong
                    && let Some(condition) = supposed::where_told(self.text, pair, robot)
                {
                    finding = Finding::Conditional { condition, correct: vec![], remarks: vec![] };
                }
                let mut identities = vec![];
                if finding.standing() == Standing::Equal {
                    identities.push([pair.value, pair.wanted]);
                    identities.extend(pair.also.iter().filter(|i| **i != [pair.value, pair.wanted]));
                }
                Entry { place: pair.place, span: pair.span.clone(), finding, identities }
            }
        }
    }

    /// A formula with the numbers of the table in it, where it is right by these: `80 c5` for `d6 c5`.
    fn in_numbers(&self, pair: &Pair, subject: usize) -> Pair {
        let d = &self.plan.subjects[subject].description;
        // The names that are missing in print must be lengths that a number can stand for.
        let printed = pair.value.symbols();
        let is_number = |s: &Symbol| d.exact_value(*s).is_some_and(is_measured);
        let mut missing = pair.wanted.symbols().into_iter().filter(|s| !printed.contains(s)).peekable();
        let is_replaced = missing.peek().is_some() && missing.all(|s| is_number(&s));
        // `400` beside an `x_w` in which `a1` is.
        let symbols = || printed.iter().copied().chain(pair.wanted.symbols());
        let lengths = || symbols().filter_map(|s| d.exact_value(s));
        let is_beside = || {
            let mut found = false;
            let mut each = |s: &Syntax| {
                if let SyntaxKind::Number(_) = s.kind {
                    found |= is_measured(s.value()) && lengths().any(|l| l == s.value());
                }
            };
            pair.printed.iter().for_each(|s| visit(s, &mut each));
            found
        };
        if !is_replaced && !is_beside() || equal(pair.value, pair.wanted).is_equal() {
            return pair.clone();
        }
        let known = |e: Expr| e.substitute(|s| d.exact_value(s));
        let (value, wanted) = (known(pair.value), known(pair.wanted));
        match equal(value, wanted).is_equal() {
            true => Pair { value, wanted, ..pair.clone() },
            false => pair.clone(),
        }
    }

    /// The verdict on a number; where lengths are in millimetres, one without a unit may be a length, too.
    fn number(&self, answer: &Answer, span: &Range<usize>, subject: usize) -> Finding {
        let found = numbers::judge(answer, &self.plan.subjects[subject], self.tolerance);
        let is_bare = || !self.text.get(span.clone()).unwrap_or_default().contains(char::is_alphabetic);
        match found {
            Finding::Wrong(w)
                if self.plan.habits.millimetres && w.remarks == [Remark::Millimetres] && is_bare() =>
            {
                Finding::Equal { unless_zero: vec![] }
            }
            found => found,
        }
    }

    fn finding(&mut self, pair: &Pair, subject: usize) -> Finding {
        if let Some(printed) = &pair.printed
            && (printed.sign_choices() > 0 || with_named_signs(vec![pair.value]).len() > 1)
        {
            return self.with_signs(printed, pair);
        }
        match equal(pair.value, pair.wanted) {
            Equality::Equal { conditions } => {
                let names = self.vocabulary(subject);
                Finding::Equal { unless_zero: conditions.iter().map(|c| Formula::new(*c, names)).collect() }
            }
            Equality::Different { .. } => self.refuted(pair, subject),
            Equality::Undecided(_) => {
                match counterexample(pair.value, pair.wanted, &self.plan.subjects[subject]) {
                    Some(_) => self.refuted(pair, subject),
                    None => Finding::Undecided { why: Unproved::NotFound },
                }
            }
        }
    }

    /// What is not equal everywhere: wrong, or right in a part of all configurations, as what uses √(x² + y²) for x is.
    fn refuted(&mut self, pair: &Pair, subject: usize) -> Finding {
        if !right_in_part(pair.value, pair.wanted, &self.plan.subjects[subject]) {
            return Finding::Wrong(Box::new(self.wrong(pair, subject)));
        }
        let correct = shown(pair.wanted, self.vocabulary(subject)).iter().map(ToString::to_string).collect();
        let condition = Condition::Configurations(vec![]);
        Finding::Conditional { condition, correct, remarks: vec![Remark::Sampled] }
    }

    /// A formula with ±: one of the signs is right at each configuration, or none.
    fn with_signs(&self, printed: &Syntax, pair: &Pair) -> Finding {
        let values: Vec<Expr> = with_named_signs(printed.variants().iter().map(Syntax::value).collect());
        // One of the values is right in each configuration if the product of all differences vanishes.
        let product = values.iter().fold(Expr::int(1), |p, &v| p * (pair.wanted - v));
        if values.len() <= 4 && equal(product, Expr::int(0)).is_equal() {
            return Finding::Equal { unless_zero: vec![] };
        }
        let is_one = values.iter().any(|&v| equal(v, pair.wanted).is_equal());
        if is_one {
            return Finding::Conditional { condition: Condition::OneSign, correct: vec![], remarks: vec![] };
        }
        let symbols: Vec<Symbol> = values.iter().chain([&pair.wanted]).flat_map(|e| e.symbols()).collect();
        for seed in 0..30_u32 {
            let value = |s: Symbol| symbols.iter().position(|x| *x == s).map(|i| sample(seed, i));
            let (Ok(right), read) = (pair.wanted.eval(value), values.iter().map(|v| v.eval(value))) else {
                continue;
            };
            let printed: Vec<f64> = read.filter_map(Result::ok).filter(|x| x.is_finite()).collect();
            if !printed.is_empty() && right.is_finite() && printed.iter().all(|x| (x - right).abs() > 1e-9) {
                return Finding::Wrong(Box::default());
            }
        }
        Finding::Conditional {
            condition: Condition::OwnSign,
            correct: vec![],
            remarks: vec![Remark::Sampled],
        }
    }

    /// A right formula, simplified, unless it is too long: the parts that an author may have lost stand in it.
    fn readable(&mut self, right: Expr) -> Expr {
        *self.readable.entry(right).or_insert_with(|| {
            let is_short = literals(right) <= 20 * MAX_SHOWN;
            is_short.then(|| simplify(right, &right.symbols()).ok()).flatten().map_or(right, |s| s.expr)
        })
    }

    /// Another entry in place of a short one: 0 for C2, and C2 for 1.
    fn entire(&self, printed: &Syntax, pair: &Pair, found: Option<&Slip>, cost: u32) -> Option<Slip> {
        let is_one = pair.value.is_one();
        let right = simplify(pair.wanted, &pair.wanted.symbols()).ok()?.expr;
        let number = right.as_number();
        let is_sum = matches!(&printed.kind, SyntaxKind::Sum(terms) if terms.len() > 1);
        if is_sum && !is_one || cost <= SIGN {
            return None;
        }
        let now = match (number, found) {
            (Some(_), _) => print(right, &Vocabulary::new(), Style::Ascii),
            (None, Some(slip)) if is_one => {
                let rest = slip.formula.replacen('1', "", 1);
                rest.replace("\\cdot", "").trim().trim_start_matches(['*', '.', '·', ' ']).to_string()
            }
            _ => return None,
        };
        Some(Slip {
            kind: SlipKind::OtherEntry,
            patches: vec![Patch { span: pair.span.clone(), now: now.clone() }],
            formula: now,
        })
    }

    fn vocabulary(&self, subject: usize) -> &'a Rc<Vocabulary> {
        self.walked.names_of(subject)
    }

    fn wrong(&mut self, pair: &Pair, subject: usize) -> Wrong {
        let names = self.vocabulary(subject);
        let robot = &self.plan.subjects[subject];
        let mut wrong = Wrong {
            counterexample: counterexample(pair.value, pair.wanted, robot),
            holds_if: holds_if(pair, robot),
            difference: shown(pair.value - pair.wanted, names),
            ..Wrong::default()
        };
        let mut slips = self.slips(pair, subject).into_iter();
        wrong.slip = slips.next();
        wrong.rivals = slips.collect();
        wrong.correct = match &wrong.slip {
            Some(slip) => vec![slip.formula.clone()],
            None => shown(pair.wanted, names).iter().map(ToString::to_string).collect(),
        };
        wrong
    }

    /// What formulas about a robot are made of.
    pub fn lexicon(&mut self, subject: usize) -> Option<&mut Lexicon> {
        if !self.lexicons.contains_key(&subject) {
            let mut made = lexicon(&self.plan.subjects[subject], &self.spellings);
            if let Some(lexicon) = &mut made {
                self.learn(subject, lexicon);
            }
            self.lexicons.insert(subject, made);
        }
        self.lexicons.get_mut(&subject)?.as_mut()
    }

    /// Learns from the formulas that are right how the author writes.
    fn learn(&self, subject: usize, lexicon: &mut Lexicon) {
        for assertion in self.walked.assertions.iter().filter(|a| a.subject == subject) {
            for piece in &assertion.pieces {
                if let Piece::Pair(Pair { printed: Some(syntax), span, value, wanted, .. }) = piece
                    && lexicon.value(*value).is_some_and(|v| Some(v) == lexicon.value(*wanted))
                {
                    lexicon.learn(self.text.get(span.clone()).unwrap_or_default(), syntax);
                }
            }
        }
    }

    /// The smallest changes that make a formula right.
    pub fn slips(&mut self, pair: &Pair, subject: usize) -> Vec<Slip> {
        let Some(printed) = &pair.printed else { return vec![] };
        if self.budget == 0 || !self.has_slips {
            return vec![];
        }
        self.budget -= 1;
        let source = self.text.get(pair.span.clone()).unwrap_or_default();
        let wanted = Wanted::Formula(self.readable(pair.wanted));
        let own = self.own_names.clone();
        let names = own.as_deref().unwrap_or(self.vocabulary(subject));
        let Some(lexicon) = self.lexicon(subject) else { return vec![] };
        let found = repairs(source, printed, &wanted, lexicon, names, Effort::default());
        // A change that is larger than this is another formula.
        let limit = |r: &Repair| if r.slip == Kind::LostTerm { MAX_TERM } else { MAX_COST };
        let best = found.first().map_or(0, |r| r.cost);
        let close = found.into_iter().filter(|r| r.cost <= best.min(limit(r))).take(4);
        let found: Vec<Slip> = close.map(|r| slip(r, pair.span.start)).collect();
        match self.entire(printed, pair, found.first(), best.max(u32::from(found.is_empty()) * MAX_COST)) {
            Some(entire) => vec![entire],
            None => found,
        }
    }
}

/// Calls for each part of a formula.
fn visit(syntax: &Syntax, each: &mut dyn FnMut(&Syntax)) {
    each(syntax);
    syntax.children().into_iter().for_each(|part| visit(part, each));
}

/// A repair of the formula that begins at a place of the document.
pub(super) fn slip(repair: Repair, start: usize) -> Slip {
    let moved = |r: &Range<usize>| r.start + start..r.end + start;
    Slip {
        kind: SlipKind::Formula(repair.slip),
        patches: repair.patches.iter().map(|p| Patch { span: moved(&p.span), now: p.now.clone() }).collect(),
        formula: repair.formula,
    }
}

/// What formulas about a robot are made of.
fn lexicon(subject: &Subject, spellings: &[(Expr, String)]) -> Option<Lexicon> {
    let d = &subject.description;
    let mut atoms: Vec<Expr> = vec![];
    for v in d.variables() {
        let q = Expr::from(v.symbol);
        atoms.push(q);
        if v.kind == denavit::description::JointKind::Revolute {
            let (s, c) = q.sin_cos();
            atoms.extend([s, c]);
        }
    }
    atoms.extend(d.parameters.iter().map(|p| Expr::from(p.symbol)));
    let mut vocabulary: Vec<Expr> = vec![];
    let n = subject.last();
    for i in 0..=n {
        for j in i + 1..=n {
            if let Some(x) = subject.transform(Some(i), Some(j)) {
                let x = if j - i <= 3 { x } else { continue };
                vocabulary.extend(x.matrix().iter().take(3).flatten());
            }
        }
    }
    vocabulary.extend(spellings.iter().map(|s| s.0));
    let mut lexicon = Lexicon::new(&atoms, &vocabulary)?;
    for (e, text) in spellings {
        lexicon.spelled(*e, text);
    }
    Some(lexicon)
}

/// A formula simplified, unless it is too long to be shown.
fn shown(e: Expr, names: &Rc<Vocabulary>) -> Option<Formula> {
    if literals(e) > 20 * MAX_SHOWN {
        return None;
    }
    let simple = simplify(e, &e.symbols()).ok()?.expr;
    (literals(simple) <= MAX_SHOWN).then(|| Formula::new(simple, names))
}

/// A number for a symbol that looks random.
fn sample(seed: u32, index: usize) -> f64 {
    let mut z = u64::from(seed).wrapping_mul(0x9E37_79B9_7F4A_7C15)
        ^ (index as u64 + 1).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 30)).wrapping_mul(0x94D0_49BB_1331_11EB);
    0.3 + 2.0 * ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// True if two formulas that differ agree all the same at some of many configurations from everywhere.
fn right_in_part(printed: Expr, right: Expr, subject: &Subject) -> bool {
    let mut symbols = printed.symbols();
    symbols.extend(right.symbols());
    let joints = subject.joints();
    let mut agreeing = 0;
    for seed in 0..MANY {
        let value = |s: Symbol| {
            let index = symbols.iter().position(|x| *x == s)?;
            // Joints are anywhere, lengths positive.
            let x = sample(seed, index);
            Some(if joints.contains(&s.into()) { (x - 1.3) * PI } else { x })
        };
        let (Ok(a), Ok(b)) = (printed.eval(value), right.eval(value)) else { continue };
        let is_same = (a - b).abs() <= 1e-9 * (1.0 + a.abs().max(b.abs()));
        agreeing += u32::from(is_same && b.abs() > 1e-6);
    }
    agreeing >= MANY / 10
}

/// So many configurations tell a formula that is right in a part of them.
const MANY: u32 = 60;

/// A configuration in whole degrees at which two formulas differ.
pub(super) fn counterexample(printed: Expr, right: Expr, subject: &Subject) -> Option<Counterexample> {
    let mut symbols = printed.symbols();
    symbols.extend(right.symbols());
    symbols.sort_by(|a, b| denavit_symbolic::expr::natural_order(&a.name(), &b.name()));
    symbols.dedup();
    let d = &subject.description;
    let variables = d.variables();
    for seed in 0..20_u32 {
        let value = |s: Symbol| -> Option<f64> {
            let index = symbols.iter().position(|x| *x == s)?;
            let known = d.value(s);
            let turns = variables
                .iter()
                .any(|v| v.symbol == s && v.kind == denavit::description::JointKind::Revolute);
            let spread = f64::from((seed * 37 + 17 * index as u32 + 20) % 160);
            Some(match known {
                Some(x) => x,
                None if turns => (5.0 * (spread / 5.0).round()).to_radians(),
                None => (10.0 + spread).round() / 100.0,
            })
        };
        if let (Ok(a), Ok(b)) = (printed.eval(value), right.eval(value))
            && a.is_finite()
            && b.is_finite()
            && (a - b).abs() > 1e-6 * (1.0 + a.abs().max(b.abs()))
        {
            let at = symbols.iter().filter_map(|s| Some((s.name().to_string(), value(*s)?))).collect();
            return Some(Counterexample { at, printed: a, right: b });
        }
    }
    None
}

/// The parameter that would have to be 0.
fn holds_if(pair: &Pair, subject: &Subject) -> Option<Symbol> {
    let mut points = Points::new(11);
    let found = subject.description.parameters.iter().find(|p| {
        let without = |e: Expr| e.substitute(|s| (s == p.symbol).then(|| Expr::int(0)));
        let used = |e: Expr| e.symbols().contains(&p.symbol);
        if !(used(pair.value) || used(pair.wanted)) {
            return false;
        }
        let (a, b) = (points.value(without(pair.value)), points.value(without(pair.wanted)));
        a.is_some() && a == b && equal(without(pair.value), without(pair.wanted)).is_equal()
    })?;
    Some(found.symbol)
}
