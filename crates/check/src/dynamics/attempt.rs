//! A document's dynamics read in one way: its names, its formulas, and how its bodies and its gravity are read for most of them to be right.

use super::bodies::bodies;
use super::letters::{Letters, from_zero, letters, maps};
use super::measures::{Measures, measures};
use super::model::{ALONG, COUPLED, Coordinates, Model, Numbers, Rotor, moving_rows, numbers};
use super::points::jacobians;
use super::quantity::{Quantity, STYLES};
use super::statements::{Read, statements};
use super::told::{Told, as_told, told};
use super::vote::{Bounds, Candidates, Reading, Symbols, Test, Vote, Voter};
use super::words::{Role, length_of, names, role, words};
use crate::facts::{Motion, Spoken};
use crate::subject::Subject;
use denavit::description::JointKind;
use denavit_reading::document::Statement;
use denavit_symbolic::{Expr, Symbol};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// Arms with more rows that move are not judged: their formulas are no ones that people print.
const MAX_ROWS: usize = 4;

/// A way to read a document's dynamics.
pub(super) struct Attempt {
    pub coordinates: Coordinates,
    pub read: Read,
    /// Of each piece without a row and of each row: its test.
    pub test_of_piece: Vec<Option<usize>>,
    pub test_of_row: Vec<usize>,
    pub tests: Vec<Test>,
    pub vote: Vote,
    pub candidates: Candidates,
    /// What names stand for.
    pub roles: BTreeMap<Symbol, Role>,
    /// The arm with symbols for all numbers.
    pub model: Rc<Model>,
    symbols: Rc<Symbols>,
    pub gravities: Vec<[Expr; 3]>,
    /// The bodies are the robot's own.
    pub is_given: bool,
    pub rows: Vec<usize>,
    bounds: Rc<Bounds>,
    /// Formulas have numbers for symbols: what is not right may be rounded.
    pub is_measured: bool,
    /// The places that are right with each way to give letters to bodies, where several are as good.
    agreed: Option<BTreeSet<(usize, usize)>>,
}

impl Attempt {
    /// The arm of a reading.
    pub fn model(&self, subject: &Subject, reading: usize) -> Option<Model> {
        let reading = &self.vote.best[reading];
        let bodies: Vec<Numbers> =
            reading.bodies.iter().zip(&self.candidates.bodies).map(|(k, all)| all[*k]).collect();
        let gravity = self.gravities[reading.gravity];
        Model::new(&subject.description, &self.rows, &bodies, gravity, self.coordinates)
    }

    /// How many tests are right.
    pub fn score(&self) -> usize {
        self.vote.score()
    }

    /// True if a test is right in some reading, whatever the rest of the document says, or not all readings could be tried.
    pub fn is_right_alone(&self, test: usize) -> bool {
        let voter = Voter::new(&self.model, &self.symbols, &self.bounds);
        let before = self.bounds.is_cut.replace(false);
        let vote = voter.vote(&self.tests[test..=test], &self.candidates, &self.gravities);
        let is_cut = self.bounds.is_cut.replace(before);
        is_cut || vote.is_some_and(|v| v.score() > 0)
    }

    /// True if not all ways to read the document were tried.
    pub fn is_cut(&self) -> bool {
        self.bounds.is_cut.get() || self.is_open()
    }

    /// True if nothing can be called wrong.
    pub fn is_open(&self) -> bool {
        self.is_measured || self.agreed.is_some()
    }

    /// True for a formula that is right in one way to read letters, and in another that is as good not.
    pub fn is_disputed(&self, span: &std::ops::Range<usize>) -> bool {
        self.agreed.as_ref().is_some_and(|all| !all.contains(&(span.start, span.end)))
    }

    /// The places of what is right in every reading.
    fn right(&self) -> BTreeSet<(usize, usize)> {
        let is_right = |test: usize| self.vote.best.iter().all(|b| b.right[test]);
        let of_piece = |(k, piece): (usize, &super::statements::Piece)| {
            let test = self.test_of_piece[k]?;
            is_right(test).then_some((piece.span.start, piece.span.end))
        };
        self.read.pieces.iter().enumerate().filter_map(of_piece).collect()
    }

    fn is_perfect(&self) -> bool {
        self.vote.best.first().is_some_and(|b| b.right.iter().all(|r| *r)) && self.read.unread.is_empty()
    }
}

/// The way to read in which most is right; the more usual of those that are as good.
pub(super) fn best(text: &str, subject: &Subject, all: &[Statement], motion: &Motion) -> Option<Attempt> {
    let d = &subject.description;
    let rows = moving_rows(d)?;
    let n = rows.len();
    if n > MAX_ROWS {
        return None;
    }
    let sources = all.iter().map(|s| text.get(s.span.clone()).unwrap_or_default());
    let mut mentioned: BTreeSet<String> = sources.flat_map(words).collect();
    let jacobians = jacobians(text, all);
    mentioned.retain(|w| !jacobians.contains(w));
    let symbols = Rc::new(Symbols::new(n));
    let has_rotor = mentioned.iter().any(|w| matches!(role(w, n), Some(Role::Rotor(_))));
    let generic = symbols.bodies.iter().map(|b| -> Numbers {
        // What goes with a rotor alone.
        let is_none = |p: usize| matches!(p, COUPLED | ALONG) && !has_rotor;
        std::array::from_fn(|p| if is_none(p) { Expr::int(0) } else { b[p].into() })
    });
    let generic: Vec<Numbers> = generic.collect();
    let gravity = symbols.gravity.map(Expr::from);
    let told = told(text);
    let bounds = Rc::new(Bounds::default());
    let follows = |k: usize| d.rows[rows[k]].variable.is_none();
    let driven = d.variables().len();
    // Whose rotor turns with a row that follows others is anybody's guess.
    let is_of_drive = |w: &String| matches!(role(w, n), Some(Role::Rotor(_) | Role::Motor(_)));
    if driven < n && mentioned.iter().any(is_of_drive) {
        return None;
    }
    // Where one stands before others, their bodies may have the numbers of their joints.
    let is_last = (driven..n).all(follows);
    if !is_last && !d.has_masses() {
        bounds.is_cut.set(true);
    }
    let own = subject.vocabulary();
    let lengths = ['l', 'L', 'a', 'd', 'r'].into_iter().filter(|letter| {
        let named = |k: usize| format!("{letter}{}", k + 1);
        let is_new = |w: String| mentioned.contains(&w) && own.lookup(&w).is_none_or(|e| e.is_zero());
        // Beside the table's own letter another is no second one for the same length.
        let is_beside = |k: usize| {
            let own = length_of(subject, &rows, k).and_then(Expr::as_symbol);
            own.is_some_and(|s| mentioned.contains(&*s.name()) && is_new(named(k)))
        };
        (0..n).any(|k| is_new(named(k))) && !(0..n).any(is_beside)
    });
    let lengths: Vec<Option<char>> = std::iter::once(None).chain(lengths.map(Some)).collect();
    let (maps, is_cut) = match d.has_masses() {
        true => (vec![], false),
        false => maps(&letters(&mentioned, text), n),
    };
    if is_cut {
        bounds.is_cut.set(true);
    }
    let measures = if d.has_masses() { Measures::new() } else { measures(text) };
    let zero = from_zero(&mentioned, n).filter(|_| !d.has_masses());
    let maps = std::iter::once(Letters::new()).chain(maps).chain(zero);
    let way = |letters: &Letters, length| Way { letters: letters.clone(), length, measures: Measures::new() };
    let mut ways: Vec<Way> =
        maps.flat_map(|m| lengths.iter().map(move |l| way(&m, *l)).collect::<Vec<_>>()).collect();
    if !measures.is_empty() {
        ways.push(Way { letters: Letters::new(), length: None, measures });
    }
    let variables = d.variables();
    let is_planar = n > 1
        && variables.iter().all(|v| v.kind == JointKind::Revolute)
        && is_last
        && d.rows.iter().skip(usize::from(!d.convention.begins_with_joint())).all(|r| r.alpha.is_zero());
    let coordinates: &[Coordinates] = match is_planar {
        true => &[Coordinates::Joints, Coordinates::Absolute, Coordinates::AbsoluteWithTorques],
        false => &[Coordinates::Joints],
    };
    let mut found: Option<Attempt> = None;
    for &coordinates in coordinates {
        let model = Rc::new(Model::new(d, &rows, &generic, gravity, coordinates)?);
        let voter = Voter::new(&model, &symbols, &bounds);
        for way in &ways {
            let letters = &way.letters;
            let mut mentioned = mentioned.clone();
            mentioned.extend(way.measures.keys().cloned());
            let mut names =
                names(subject, (&model.state, motion), &rows, &mentioned, way.length, letters, &told.lengths);
            names.is_measured = !way.measures.is_empty();
            if told.is_massless {
                let lone = names.roles.values_mut().filter(|r| **r == Role::Mass(None));
                lone.for_each(|r| *r = Role::Payload);
            }
            let roles = names.roles.clone();
            let read = statements(text, all, names, &model.state);
            let made = attempted(subject, &rows, &voter, coordinates, read, &roles, &told, &way.measures);
            let Some(attempt) = made else { continue };
            let score = attempt.score();
            match &mut found {
                Some(found) if found.score() > score => {}
                Some(found) if found.score() == score => {
                    // Other bodies for the letters make as much right, but something else: which is meant is open.
                    let (before, now) = (found.right(), attempt.right());
                    if !letters.is_empty() && before != now {
                        let agreed = found.agreed.take().unwrap_or(before);
                        found.agreed = Some(agreed.intersection(&now).copied().collect());
                    }
                }
                _ => found = Some(attempt),
            }
            if found.as_ref().is_some_and(Attempt::is_perfect) {
                return found;
            }
        }
    }
    found
}

/// What names are taken for.
struct Way {
    letters: Letters,
    /// The letter of lengths that the table does not have.
    length: Option<char>,
    /// The numbers that formulas have for symbols.
    measures: Measures,
}

#[expect(clippy::too_many_arguments, reason = "all of them belong to one way to read a document")]
fn attempted(
    subject: &Subject,
    rows: &[usize],
    voter: &Voter<'_>,
    coordinates: Coordinates,
    mut read: Read,
    roles: &BTreeMap<Symbol, Role>,
    told: &Told,
    measures: &Measures,
) -> Option<Attempt> {
    let d = &subject.description;
    let n = rows.len();
    let is_given = d.has_masses();
    let given = read.given.clone();
    let measured = |e: Expr| match measures.is_empty() {
        true => e,
        false => e.substitute(|s| measures.get(&*s.name()).copied()),
    };
    let meaning = |s: Symbol| measured(given.get(&s).copied().unwrap_or(s.into()));
    let all_bodies = |told: &Told| -> Vec<Vec<Numbers>> {
        let roles = &as_told(roles, told, n);
        let of = |(k, &row): (usize, &usize)| match is_given {
            true => vec![given_numbers(&d.rows[row])],
            false => {
                let (all, is_cut) = bodies(d, row, k, k + 1 == n, roles, &meaning, told);
                if is_cut {
                    voter.bounds.is_cut.set(true);
                }
                all
            }
        };
        rows.iter().enumerate().map(of).collect()
    };
    let state = &voter.model.state;
    let candidates = Candidates::new(all_bodies(&Told::default()), state);
    let mut told = told.clone();
    if has_inertias(roles) {
        told.links.inertias.clear();
    }
    let told = &told;
    let spoken = if is_given { vec![] } else { spoken(told, roles) };
    let strict = (!spoken.is_empty()).then(|| Candidates::new(all_bodies(told), state));
    // Those of both, the first as they are numbered there.
    let mut known = candidates.bodies.clone();
    for (all, more) in known.iter_mut().zip(strict.iter().flat_map(|s| &s.bodies)) {
        let more: Vec<Numbers> = more.iter().filter(|b| !all.contains(b)).copied().collect();
        all.extend(more);
    }
    let mut tests: Vec<Test> = vec![];
    let mut test_of_piece = vec![None; read.pieces.len()];
    for (k, piece) in read.pieces.iter().enumerate() {
        if piece.row.is_none() {
            test_of_piece[k] = Some(tests.len());
            tests.push(Test { value: piece.value, candidates: piece.candidates.clone() });
        }
    }
    let mut test_of_row = vec![];
    for row in &read.rows {
        test_of_row.push(tests.len());
        tests.push(Test { value: row.value, candidates: vec![Quantity::Velocity(row.joint)] });
    }
    let (gravities, count) = gravities(subject, roles, told, &tests);
    let gravities: Vec<[Expr; 3]> = gravities.into_iter().map(|g| g.map(measured)).collect();
    let of_link = |s: Symbol| match roles.get(&s) {
        Some(Role::Mass(Some(k))) => Some((s, *k)),
        _ => None,
    };
    let masses: BTreeSet<(Symbol, usize)> =
        tests.iter().flat_map(|t| t.value.symbols()).filter_map(of_link).collect();
    let touches = |of: Spoken, test: &Test| {
        let is_told = |s: &Symbol| match (of, roles.get(s)) {
            (Spoken::Gravity, Some(Role::Gravity)) => true,
            (Spoken::Inertias, Some(Role::Inertia(_) | Role::About(..))) => true,
            (Spoken::Shape, Some(Role::Inertia(_) | Role::About(..))) => true,
            (Spoken::Shape, Some(Role::Mass(_))) => told.links.place.is_some(),
            (Spoken::Centres, Some(Role::Length(_))) => true,
            (Spoken::Links, _) => told.links.links.contains_key(&*s.name()),
            _ => false,
        };
        test.value.symbols().iter().any(is_told)
    };
    let of_aspect = |of: Spoken| all_bodies(&told.only(of));
    let ways = Ways {
        voter,
        candidates: &candidates,
        known: &known,
        strict: strict.as_ref(),
        gravities: &gravities,
        told: count,
        masses,
        spoken,
        of_aspect: &of_aspect,
        touches: &touches,
    };
    let (vote, tests) = ways.styled(tests, &mut read, &test_of_piece)?;
    let rows = rows.to_vec();
    let candidates = match strict {
        Some(_) => Candidates::new(known, state),
        None => candidates,
    };
    Some(Attempt {
        coordinates,
        read,
        test_of_piece,
        test_of_row,
        tests,
        vote,
        candidates,
        roles: roles.clone(),
        model: Rc::clone(voter.model),
        symbols: Rc::clone(voter.symbols),
        gravities,
        is_given,
        rows,
        bounds: Rc::clone(voter.bounds),
        is_measured: !measures.is_empty(),
        agreed: None,
    })
}

/// What words say of the bodies of a document whose names have these roles.
fn spoken(told: &Told, roles: &BTreeMap<Symbol, Role>) -> Vec<Spoken> {
    let all = [
        (Spoken::Shape, told.links.shape.is_some() || told.links.place.is_some()),
        (Spoken::Centres, told.links.has_from()),
        (Spoken::Inertias, told.inertia.is_some()),
        (Spoken::LeftOut, !told.links.inertias.is_empty()),
        (Spoken::Links, told.links.links.keys().any(|name| roles.contains_key(&Symbol::new(name)))),
    ];
    all.into_iter().filter(|(_, is_said)| *is_said).map(|(of, _)| of).collect()
}

fn has_inertias(roles: &BTreeMap<Symbol, Role>) -> bool {
    roles.values().any(|r| matches!(r, Role::Inertia(_) | Role::About(..) | Role::Ten(..)))
}

/// The numbers of a link that the robot's own file gives.
fn given_numbers(row: &denavit::description::Row) -> Numbers {
    let o = Expr::int(0);
    let ten = row.body().map_or([o; 10], |b| b.parameters());
    numbers(ten, Rotor::felt(row.rotor.unwrap_or(o)), row.com.unwrap_or([o; 3]))
}

/// In which ways the bodies and gravity of a document may be read: all, and those that its words tell.
struct Ways<'a> {
    voter: &'a Voter<'a>,
    candidates: &'a Candidates,
    /// All bodies that a reading may have.
    known: &'a [Vec<Numbers>],
    strict: Option<&'a Candidates>,
    gravities: &'a [[Expr; 3]],
    /// So many of them, the first, are those that are told.
    told: usize,
    /// The masses that formulas have, and their links.
    masses: BTreeSet<(Symbol, usize)>,
    /// What the words tell of bodies.
    spoken: Vec<Spoken>,
    /// The bodies that each link may have by one of these alone.
    of_aspect: &'a dyn Fn(Spoken) -> Vec<Vec<Numbers>>,
    /// Whether a test has something of which the words tell so.
    touches: &'a dyn Fn(Spoken, &Test) -> bool,
}

impl Ways<'_> {
    /// What the words tell counts, if as much is right so; else it is open which of the two is meant.
    fn vote(&self, tests: &[Test]) -> Option<Vote> {
        let is_told = self.told < self.gravities.len() || self.strict.is_some();
        let told = self.strict.unwrap_or(self.candidates);
        let strict = match is_told {
            true => self.voter.vote(tests, told, &self.gravities[..self.told]),
            false => None,
        };
        let strict = strict.map(|mut vote| {
            for reading in &mut vote.best {
                for (k, number) in reading.bodies.iter_mut().enumerate() {
                    let own = told.bodies[k][*number];
                    *number = self.known[k].iter().position(|b| *b == own).unwrap_or(0);
                }
            }
            vote
        });
        let any = self.voter.vote(tests, self.candidates, self.gravities);
        let (strict, any) = (strict.map(|v| self.effective(v)), any.map(|v| self.effective(v)));
        match (strict, any) {
            (Some(strict), Some(any)) if strict.score() < any.score() => {
                // Against the words nothing is right of which they tell.
                let against = self.against(&any);
                let mut told = any.best[0].clone();
                for (right, test) in told.right.iter_mut().zip(tests) {
                    *right &= !against.iter().any(|of| (self.touches)(*of, test));
                }
                // What the words tell comes first: a slip is one beside that.
                let mut both = strict;
                both.against = against;
                both.is_many |= any.is_many;
                both.best.extend(any.best);
                both.best.push(told);
                Some(both)
            }
            (Some(strict), _) => Some(strict),
            (None, any) => any,
        }
    }

    /// What the words tell that no reading follows in which most is right; all that they tell where one follows each.
    fn against(&self, any: &Vote) -> Vec<Spoken> {
        let state = &self.voter.model.state;
        let of_bodies = self.spoken.iter().filter(|of| {
            let bodies = (self.of_aspect)(**of);
            let follows = |reading: &Reading| {
                reading.bodies.iter().enumerate().all(|(k, number)| {
                    let own = &self.known[k][*number];
                    bodies[k].iter().any(|b| any.is_same(reading, k, own, b, state))
                })
            };
            !any.best.iter().any(follows)
        });
        let mut found: Vec<Spoken> = of_bodies.copied().collect();
        let is_told = self.told < self.gravities.len();
        if is_told && any.best.iter().all(|reading| reading.gravity >= self.told) {
            found.insert(0, Spoken::Gravity);
        }
        if found.is_empty() {
            found.extend(is_told.then_some(Spoken::Gravity));
            found.extend(&self.spoken);
        }
        found
    }

    /// A mass that formulas have has an effect, where that is so in a reading that is as good.
    fn effective(&self, mut vote: Vote) -> Vote {
        let state = &self.voter.model.state;
        let has = |reading: &Reading| {
            self.masses.iter().all(|&(symbol, k)| {
                vote.has_effect(reading, k, &self.known[k][reading.bodies[k]], symbol, state)
            })
        };
        let effects: Vec<bool> = vote.best.iter().map(has).collect();
        if effects.contains(&true) {
            let mut effects = effects.into_iter();
            vote.best.retain(|_| effects.next() == Some(true));
        }
        vote
    }

    /// With one meaning for each letter with three indices: that with which most is right, all of those that are as good.
    fn styled(
        &self,
        tests: Vec<Test>,
        read: &mut Read,
        test_of_piece: &[Option<usize>],
    ) -> Option<(Vote, Vec<Test>)> {
        let mut families: BTreeMap<String, Vec<(usize, [usize; 3])>> = BTreeMap::new();
        for (k, piece) in read.pieces.iter().enumerate() {
            if let Some((letters, indices)) = &piece.symbol {
                families.entry(letters.clone()).or_default().push((k, *indices));
            }
        }
        let mut tests = tests;
        let mut found: Option<Vote> = None;
        for (letters, pieces) in families.iter().take(MAX_FAMILIES) {
            let mut best: Option<(usize, Vote, Vec<Test>)> = None;
            for style in STYLES {
                if read.styles.get(letters).is_some_and(|told| *told != style) {
                    continue;
                }
                let mut styled = tests.clone();
                for &(k, indices) in pieces {
                    if let Some(test) = test_of_piece[k] {
                        styled[test].candidates = style.quantity(indices).into_iter().collect();
                    }
                }
                let Some(mut vote) = self.vote(&styled) else { continue };
                let score = vote.score();
                match &mut best {
                    Some((top, _, _)) if *top > score => {}
                    Some((top, known, _)) if *top == score => {
                        known.is_many |= vote.is_many;
                        known.best.append(&mut vote.best);
                    }
                    _ => best = Some((score, vote, styled)),
                }
            }
            let (_, vote, styled) = best?;
            (found, tests) = (Some(vote), styled);
        }
        for (piece, test) in read.pieces.iter_mut().zip(test_of_piece) {
            if let (Some(test), true) = (test, piece.symbol.is_some()) {
                piece.candidates = tests[*test].candidates.clone();
            }
        }
        let vote = match found {
            Some(vote) => vote,
            None => self.vote(&tests)?,
        };
        Some((vote, tests))
    }
}

/// No document has more letters with three indices.
const MAX_FAMILIES: usize = 3;

/// The accelerations of gravity that a document may mean, the more usual ones first, and how many of them its words or the robot tell.
fn gravities(
    subject: &Subject,
    roles: &BTreeMap<Symbol, Role>,
    told: &Told,
    tests: &[Test],
) -> (Vec<[Expr; 3]>, usize) {
    let o = Expr::int(0);
    let g = roles.iter().find(|(_, r)| **r == Role::Gravity).map(|(s, _)| Expr::from(*s));
    if let Some(given) = subject.description.gravity {
        // Its size has a name in formulas.
        let along: Vec<usize> = (0..3).filter(|&i| !given[i].is_zero()).collect();
        if let (Some(g), &[i]) = (g, &along[..])
            && let Some(number) = given[i].as_number()
        {
            let mut named = [o; 3];
            named[i] = if number.is_negative() { -g } else { g };
            return (vec![named, given], 2);
        }
        return (vec![given], 1);
    }
    let g = match (g, told.gravity) {
        (Some(g), _) => g,
        // It is told, and no formula has it: then it is forgotten, or left out on purpose.
        (None, Some((axis, is_down))) => {
            let mut v = [o; 3];
            v[axis] = if is_down { -Expr::symbol("g") } else { Expr::symbol("g") };
            return (vec![v, [o; 3]], 1);
        }
        (None, None) => return (vec![[o; 3]], 1),
    };
    let mut axes: [(usize, bool); 6] = [(1, true), (2, true), (0, true), (0, false), (1, false), (2, false)];
    axes.sort_by_key(|a| Some(*a) != told.gravity);
    let mut found: Vec<[Expr; 3]> = axes
        .iter()
        .map(|&(axis, is_down)| {
            let mut v = [o; 3];
            v[axis] = if is_down { -g } else { g };
            v
        })
        .collect();
    if told.is_level {
        // Nothing moves along it, or only what slides up and down.
        found.sort_by_key(|v| v[2].is_zero());
        found.insert(0, [o; 3]);
        return (found, 3);
    }
    // There is some where a formula has it.
    if !tests.iter().any(|t| g.symbols().iter().all(|s| t.value.symbols().contains(s))) {
        found.push([o; 3]);
    }
    let count = if told.gravity.is_some() { 1 } else { found.len() };
    (found, count)
}
