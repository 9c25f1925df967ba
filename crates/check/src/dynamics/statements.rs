//! From the statements of a document to formulas with what they may be: scalars, vectors and matrices entry by entry, and sums of
//! products of matrices term by term.

use super::letters::numbered;
use super::model::State;
use super::points::{self, Named, named};
use super::quantity::{Content, Quantity, STYLES, Size, Style, key, of_scalar, symbol};
use super::words::{Names, Role, is_grouped, words};
use crate::lexis::read;
use crate::names::{Name, Token, tokens};
use crate::note::Unread;
use denavit_reading::document::{Part, Relation, Side, Statement};
use denavit_symbolic::parse::Syntax;
use denavit_symbolic::vocabulary::{Vocabulary, plain_name};
use denavit_symbolic::{Expr, Symbol};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// A formula with what it may be.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// The number of its statement among those that are read.
    pub statement: usize,
    pub place: Option<(usize, usize)>,
    pub span: Range<usize>,
    /// Nothing where it is worked out.
    pub syntax: Option<Syntax>,
    pub value: Expr,
    pub candidates: Vec<Quantity>,
    /// The row of C in which it stands, as a number among those read.
    pub row: Option<usize>,
    /// It may be right, and is never called wrong: nothing names it, as an equation of motion without a force, or its name may be that of a
    /// force at a link.
    pub is_nameless: bool,
    /// The ratios of gears that it has: it is called wrong only where these are in other formulas that are right, and it is a small slip away.
    pub gears: Vec<Symbol>,
    /// The letters and the indices of a name with three.
    pub symbol: Option<(String, [usize; 3])>,
    /// The helpers that it uses.
    pub uses: Vec<usize>,
}

/// A row of a matrix C: what it gives with the rates.
#[derive(Clone, Debug)]
pub(super) struct Row {
    pub pieces: Vec<usize>,
    pub value: Expr,
    pub joint: usize,
}

/// A name that a statement defines.
#[derive(Clone, Debug)]
pub(super) struct Helper {
    pub statement: usize,
    pub name: String,
    pub span: Range<usize>,
    pub syntax: Syntax,
    pub value: Expr,
    /// What else it is said to be there: `h = … = …`.
    pub also: Vec<(Range<usize>, Expr)>,
    /// The helpers that it uses.
    pub uses: Vec<usize>,
}

/// What was read.
pub(super) struct Read {
    pub pieces: Vec<Piece>,
    pub rows: Vec<Row>,
    pub helpers: Vec<Helper>,
    /// Statements that could not be read, and why.
    pub unread: Vec<(usize, Vec<Unread>)>,
    pub vocabulary: Vocabulary,
    /// What the document says that masses, inertias and lengths are.
    pub given: BTreeMap<Symbol, Expr>,
    /// What letters with three indices mean, by symmetries that the document prints: `c_{121} = c_{211}`.
    pub styles: BTreeMap<String, Style>,
    /// Names of points, and the pieces that say what they are.
    pub defined: BTreeMap<String, (usize, points::Kind)>,
}

/// The name that a text is, if it is one; of what it is a function, `M(\Theta)`, is left aside.
pub(super) fn lone_name(text: &str, span: &Range<usize>) -> Option<Name> {
    let source = text.get(span.clone())?;
    let end = match source.find('(') {
        Some(at) if source.trim_end().ends_with(')') && !source[..at].trim().is_empty() => {
            let before = source[..at].trim_end();
            let before = before.strip_suffix("\\left").unwrap_or(before);
            let inner = &source[at..];
            let is_one = inner.matches('(').count() == 1 && !inner.contains(['+', '=', '/']);
            if is_one { span.start + before.trim_end().len() } else { span.end }
        }
        _ => span.end,
    };
    const WORDS: [&str; 11] = ["tau", "Tau", "Gamma", "Ekin", "Epot", "Ek", "Ep", "Ec", "KE", "PE", "Ecin"];
    match &tokens(text, &(span.start..end), &|word| WORDS.contains(&word) || is_grouped(word))?[..] {
        [Token::Name(name)] => {
            let mut name = name.clone();
            // `C(1,2)` is an entry, `M(q)` what depends on q.
            let inner = source[end - span.start..].trim_matches([' ', '(', ')']);
            let is_place = inner.len() < 8
                && inner.contains(|c: char| c.is_ascii_digit())
                && inner.chars().all(|c| c.is_ascii_digit() || matches!(c, ',' | ' '));
            if is_place && name.sub.is_empty() {
                name.sub = inner.replace([',', ' '], "");
                name.arguments.clear();
            }
            match name.base.as_str() {
                "tau" | "Tau" => name.base = "τ".into(),
                "Gamma" => name.base = "Γ".into(),
                _ => {}
            }
            Some(name)
        }
        _ => None,
    }
}

/// No more formulas are read.
const MAX_PIECES: usize = 500;

/// The word of a name as formulas use it.
pub(super) fn word(name: &Name) -> String {
    plain_name(&format!("{}{}{}", name.base, name.sub, name.sup)).replace(',', "")
}

/// The place of a side that is one formula.
pub(super) fn formula_span(side: &Side) -> Option<Range<usize>> {
    let is_text = side.parts.iter().all(|p| matches!(p, Part::Text(_)));
    (is_text && !side.span.is_empty()).then(|| side.span.clone())
}

pub(super) struct Reader<'a> {
    pub text: &'a str,
    pub statements: &'a [Statement],
    pub(super) names: Names,
    pub state: &'a State,
    pub n: usize,
    pub read: Read,
    /// Entries of C by row: the pieces of each column, and the statement.
    pub entries: BTreeMap<(usize, usize), Vec<Option<usize>>>,
    /// The helper that a name is at present.
    helpers: BTreeMap<String, usize>,
}

/// Reads statements about an arm.
pub(super) fn statements(text: &str, statements: &[Statement], names: Names, state: &State) -> Read {
    let order = in_order(text, statements, &names);
    let read = Read {
        pieces: vec![],
        rows: vec![],
        helpers: vec![],
        unread: vec![],
        vocabulary: names.vocabulary.clone(),
        given: BTreeMap::new(),
        styles: BTreeMap::new(),
        defined: BTreeMap::new(),
    };
    let n = state.q.len();
    let mut reader = Reader {
        text,
        statements,
        names,
        state,
        n,
        read,
        entries: BTreeMap::new(),
        helpers: BTreeMap::new(),
    };
    for at in order {
        reader.statement(at);
    }
    reader.zeros();
    reader.rows();
    reader.read
}

/// The statements so that names are defined before they are used.
fn in_order(text: &str, statements: &[Statement], own: &Names) -> Vec<usize> {
    let word_of = |span: Range<usize>| {
        let point = named(text, &span, own.bodies, &own.letters);
        point.map(|p| p.word).or_else(|| lone_name(text, &span).map(|name| word(&name)))
    };
    let mut defines: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    let mut own: Vec<Vec<String>> = vec![];
    for (at, statement) in statements.iter().enumerate() {
        let names: Vec<Option<String>> =
            statement.sides.iter().map(|s| formula_span(s).and_then(word_of)).collect();
        // Of `c_{221} = h` the first.
        let count = if names.iter().all(Option::is_some) { 1 } else { names.len() };
        let names: Vec<String> = names.into_iter().take(count).flatten().collect();
        for name in &names {
            defines.entry(name.clone()).or_default().push(at);
        }
        own.push(names);
    }
    let needs: Vec<Vec<usize>> = statements
        .iter()
        .enumerate()
        .map(|(at, statement)| {
            let sides = statement.sides.iter().map(|s| text.get(s.span.clone()).unwrap_or_default());
            let used: BTreeSet<String> = sides.flat_map(words).filter(|w| !own[at].contains(w)).collect();
            let places = used.iter().filter_map(|w| defines.get(w));
            let nearest = |all: &Vec<usize>| {
                let before = all.iter().rev().find(|k| **k < at);
                before.or_else(|| all.iter().find(|k| **k > at)).copied()
            };
            places.filter_map(nearest).collect()
        })
        .collect();
    let mut done = vec![false; statements.len()];
    let mut order = vec![];
    for start in 0..statements.len() {
        // Depth first, with a stack of its own; what needs itself is taken as it comes.
        let mut stack = vec![(start, 0_usize)];
        let mut open: BTreeSet<usize> = BTreeSet::new();
        while let Some((at, next)) = stack.pop() {
            if done[at] {
                continue;
            }
            open.insert(at);
            match needs[at].get(next) {
                Some(&k) => {
                    stack.push((at, next + 1));
                    if !done[k] && !open.contains(&k) {
                        stack.push((k, 0));
                    }
                }
                None => {
                    done[at] = true;
                    order.push(at);
                }
            }
        }
    }
    order
}

/// What formulas without accelerations may speak of.
const KINDS: [Content; 3] = [
    Content { accelerations: false, rates: false, gravity: false },
    Content { accelerations: false, rates: true, gravity: false },
    Content { accelerations: false, rates: false, gravity: true },
];

impl Reader<'_> {
    /// How many joints and bodies the arm has.
    pub(super) fn size(&self) -> Size {
        Size { joints: self.n, bodies: self.names.bodies }
    }

    pub(super) fn content(&self, e: Expr) -> Content {
        let mut content = Content::default();
        for s in e.symbols() {
            content.accelerations |= self.state.qdd.contains(&s);
            content.rates |= self.state.qd.contains(&s);
            content.gravity |= self.names.roles.get(&s) == Some(&Role::Gravity);
        }
        content
    }

    pub(super) fn define(&mut self, name: &str, value: Expr) {
        // Powers of powers are no formulas that people print.
        if denavit_symbolic::readable::literals(value) < 20_000 {
            self.read.vocabulary = std::mem::take(&mut self.read.vocabulary).alias(name, value);
        }
    }

    fn statement(&mut self, at: usize) {
        let statement = &self.statements[at];
        let is_rounded = statement.relations.contains(&Relation::Approximate);
        if statement.sides.len() < 2 || is_rounded || self.read.pieces.len() > MAX_PIECES {
            return;
        }
        let has_grid = |s: &Side| s.parts.iter().any(|p| matches!(p, Part::Matrix(_)));
        let (pieces, helpers) = (self.read.pieces.len(), self.read.helpers.len());
        if statement.sides.iter().any(has_grid) {
            self.matrices(at);
        } else {
            self.scalars(at);
        }
        // What it uses are the helpers as they were before it.
        let uses = |span: &Range<usize>| -> Vec<usize> {
            let words = words(self.text.get(span.clone()).unwrap_or_default());
            words.iter().filter_map(|w| self.helpers.get(w).copied()).collect()
        };
        let of_pieces: Vec<Vec<usize>> = self.read.pieces[pieces..].iter().map(|p| uses(&p.span)).collect();
        let of_helpers: Vec<Vec<usize>> =
            self.read.helpers[helpers..].iter().map(|h| uses(&h.span)).collect();
        for (piece, uses) in self.read.pieces[pieces..].iter_mut().zip(of_pieces) {
            piece.uses = uses;
        }
        for (k, uses) in of_helpers.into_iter().enumerate() {
            let helper = &mut self.read.helpers[helpers + k];
            helper.uses = uses;
            self.helpers.insert(helper.name.clone(), helpers + k);
        }
    }

    /// Keeps a name that other formulas use, by the first of its formulas, the others beside it.
    pub(super) fn helper(
        &mut self,
        statement: usize,
        name: String,
        formulas: &[(usize, Range<usize>, Syntax)],
    ) {
        let Some(((_, span, syntax), others)) = formulas.split_first() else { return };
        let also = others.iter().map(|f| (f.1.clone(), f.2.value())).collect();
        let (span, syntax, value) = (span.clone(), syntax.clone(), syntax.value());
        self.read.helpers.push(Helper { statement, name, span, syntax, value, also, uses: vec![] });
    }

    /// A zero is of the kind that the other formulas under its letters have: `V_2 = 0` below `V_1 = …`.
    fn zeros(&mut self) {
        let family = |piece: &Piece| {
            let side = self.statements[piece.statement].sides.first()?;
            let (letters, digits) = key(&lone_name(self.text, &formula_span(side)?)?);
            Some((letters, digits.len()))
        };
        let families: Vec<Option<(String, usize)>> = self.read.pieces.iter().map(family).collect();
        let kinds = |k: usize| -> Vec<std::mem::Discriminant<Quantity>> {
            let kin = (0..families.len()).filter(|&i| {
                families[i].is_some() && families[i] == families[k] && !self.read.pieces[i].value.is_zero()
            });
            kin.flat_map(|i| &self.read.pieces[i].candidates).map(std::mem::discriminant).collect()
        };
        let wanted: Vec<Option<Vec<_>>> = (0..families.len())
            .map(|k| {
                let piece = &self.read.pieces[k];
                (piece.place.is_none() && piece.value.is_zero() && piece.candidates.len() > 1)
                    .then(|| kinds(k))
            })
            .collect();
        for (piece, kinds) in self.read.pieces.iter_mut().zip(wanted) {
            if let Some(kinds) = kinds {
                piece.candidates.retain(|q| kinds.contains(&std::mem::discriminant(q)));
            }
        }
    }

    fn scalars(&mut self, at: usize) {
        let statement = &self.statements[at];
        let mut names: Vec<(usize, Name)> = vec![];
        let mut known: Option<Quantity> = None;
        let mut formulas: Vec<(usize, Range<usize>, Syntax)> = vec![];
        let mut errors = vec![];
        let mut points: Vec<Named> = vec![];
        for (i, side) in statement.sides.iter().enumerate() {
            let Some(span) = formula_span(side) else { continue };
            if let (true, Some(point)) = (i == points.len(), self.number_of_point(at, &span)) {
                points.push(point);
                continue;
            }
            let name = lone_name(self.text, &span);
            let is_mentioned = |name: &Name| {
                !of_scalar(name, self.size(), Content { accelerations: true, rates: false, gravity: true })
                    .is_empty()
            };
            // `c_{121} = … = h`: a name that is defined there.
            let is_new = |name: &Name| {
                i > 0 && name.arguments.is_empty() && read(self.text, &span, &self.read.vocabulary).is_err()
            };
            if let Some(name) = name
                && (i == 0 || is_mentioned(&name) || is_new(&name))
            {
                names.push((i, name));
                continue;
            }
            if let Some(quantity) = self.derivative(&span) {
                known = Some(quantity);
                continue;
            }
            match read(self.text, &span, &self.read.vocabulary) {
                Ok(syntax) if syntax.sign_choices() == 0 => formulas.push((i, span, syntax)),
                Ok(_) => {}
                Err(e) => errors.extend(e.into_iter().map(Unread::from)),
            }
        }
        if formulas.is_empty() {
            if !errors.is_empty() && (!names.is_empty() || known.is_some() || !points.is_empty()) {
                self.read.unread.push((at, errors));
            }
            return;
        }
        if !points.is_empty() {
            return self.point(at, &points, &formulas);
        }
        let is_number = formulas.iter().all(|f| f.2.value().symbols().is_empty());
        // Zeros are entries and symbols; other numbers are values at a configuration.
        let is_zero = formulas.iter().all(|f| f.2.value().is_zero());
        if is_number && !is_zero && !self.names.is_measured {
            return;
        }
        let mut has_letter = false;
        let indexed: Vec<Name> = names
            .iter()
            .map(|(_, name)| match numbered(name, &self.names.letters) {
                Some(name) => {
                    has_letter = true;
                    name
                }
                None => name.clone(),
            })
            .collect();
        let first = names.iter().find(|(i, _)| *i == 0).map(|(_, n)| n.clone());
        if let Some(name) = &first
            && let Some(role) = self.names.roles.get(&Symbol::new(&word(name)))
            && matches!(
                role,
                Role::Mass(_) | Role::Inertia(_) | Role::About(..) | Role::Length(_) | Role::Payload
            )
            && !self.content(formulas[0].2.value()).rates
            && !self.content(formulas[0].2.value()).gravity
        {
            let (name, value) = (word(name), formulas[0].2.value());
            self.read.given.insert(Symbol::new(&name), value);
            self.define(&name, value);
            return;
        }
        let mut is_judged = false;
        let is_force =
            |name: &Name| matches!(word(name).as_str(), "F" | "f" | "u" | "τ" | "T" | "M" | "Γ" | "Q");
        let is_nothing = |f: &(usize, Range<usize>, Syntax)| f.2.value().is_zero();
        let is_nameless = known.is_none()
            && (names.is_empty() && formulas.len() == 2 && formulas.iter().any(is_nothing)
                || names.len() == 1 && is_force(&names[0].1));
        let symbols: Vec<(String, [usize; 3])> =
            names.iter().filter_map(|(_, n)| symbol(n, self.n)).collect();
        self.learn_style(&symbols);
        let is_link_force = names.iter().any(|(_, name)| {
            let (letters, digits) = key(name);
            let joint = digits.parse::<usize>().ok().and_then(|d| d.checked_sub(1));
            let slides = joint.is_some_and(|k| self.names.slides.get(k) == Some(&true));
            matches!(letters.as_str(), "F" | "f" | "N" | "n") && !slides
        });
        for (_, span, syntax) in &formulas {
            let value = syntax.value();
            let content = self.content(value);
            if !(symbols.is_empty() || content.accelerations || content.rates || content.gravity) {
                is_judged = true;
                for (letters, all) in &symbols {
                    self.read.pieces.push(Piece {
                        symbol: Some((letters.clone(), *all)),
                        ..self.piece(
                            at,
                            span,
                            syntax,
                            STYLES.iter().filter_map(|s| s.quantity(*all)).collect(),
                        )
                    });
                }
                continue;
            }
            let mut candidates: Vec<Quantity> = known.into_iter().collect();
            // Zero may be of any kind.
            let hidden = [content, Content { gravity: true, ..content }];
            let contents: &[Content] = match value.is_zero() {
                true => &KINDS,
                // Gravity does not show in numbers.
                false if self.names.is_measured => &hidden,
                false => &hidden[..1],
            };
            // Beside Khalil's A a name `m_{12}` is one of something on the way.
            let has_ten = self.names.roles.values().any(|r| matches!(r, Role::Ten(..)));
            for name in indexed.iter().filter(|n| !(has_ten && n.base == "m")) {
                for found in contents.iter().flat_map(|c| of_scalar(name, self.size(), *c)) {
                    if !candidates.contains(&found) {
                        candidates.push(found);
                    }
                }
            }
            // There may be motors, and the energy of a link that without its own.
            let turns = self.has_rotors() || self.has_motors();
            candidates.retain(|q| turns || !matches!(q, Quantity::Motor(_)));
            let of_link = |q: &Quantity| match q {
                Quantity::Kinetic(Some(k)) if turns => Some(Quantity::Link(*k)),
                _ => None,
            };
            let of_links: Vec<Quantity> = candidates.iter().filter_map(of_link).collect();
            let has_motor = !of_links.is_empty() && self.has_motors();
            candidates.extend(of_links);
            if is_number && !is_zero {
                // Other numbers are values at a configuration.
                candidates.retain(|q| matches!(q, Quantity::Inertia(..)));
            }
            // `(M + m) \ddot x + … = F`, `… = 0`: the equation of some joint.
            let is_energy = |q: &Quantity| {
                matches!(q, Quantity::Kinetic(_) | Quantity::Motor(_) | Quantity::Potential(_))
            };
            let names_quantity = !candidates.is_empty();
            if candidates.is_empty() && is_nameless && content.accelerations {
                candidates.extend((0..self.n).map(Quantity::Torque));
            }
            if candidates.is_empty() {
                continue;
            }
            is_judged = true;
            let entry = match candidates[..] {
                [Quantity::CoriolisEntry(i, j)] => Some((i, j)),
                _ => None,
            };
            self.read.pieces.push(Piece {
                // A force or a torque with a letter may be one at a point of this name.
                is_nameless: has_motor
                    || is_nameless && !names_quantity
                    || is_link_force && content.accelerations
                    || has_letter && !candidates.iter().all(is_energy),
                ..self.piece(at, span, syntax, candidates)
            });
            if let Some((i, j)) = entry {
                let row = self.entries.entry((usize::MAX, i)).or_insert_with(|| vec![None; self.n]);
                row[j] = Some(self.read.pieces.len() - 1);
            }
        }
        let (_, _, syntax) = &formulas[0];
        for (_, name) in &names {
            let (name, value) = (word(name), syntax.value());
            if !is_judged && first.as_ref().is_some_and(|f| word(f) == name) {
                self.helper(at, name.clone(), &formulas);
            }
            self.define(&name, value);
        }
    }

    /// The ratios of gears in a formula.
    pub(super) fn gears(&self, e: Expr) -> Vec<Symbol> {
        let is_gear = |s: &Symbol| matches!(self.names.roles.get(s), Some(Role::Gear(_)));
        e.symbols().into_iter().filter(is_gear).collect()
    }

    fn has_rotors(&self) -> bool {
        self.names.roles.values().any(|r| matches!(r, Role::Rotor(_)))
    }

    /// True where motors have masses, which no link alone has.
    fn has_motors(&self) -> bool {
        self.names.roles.values().any(|r| matches!(r, Role::Motor(_)))
    }

    /// A formula that is read.
    pub(super) fn piece(
        &self,
        at: usize,
        span: &Range<usize>,
        syntax: &Syntax,
        candidates: Vec<Quantity>,
    ) -> Piece {
        Piece {
            statement: at,
            place: None,
            span: span.clone(),
            syntax: Some(syntax.clone()),
            value: syntax.value(),
            candidates,
            row: None,
            is_nameless: false,
            gears: self.gears(syntax.value()),
            symbol: None,
            uses: vec![],
        }
    }

    /// `c_{121} = c_{211} = …` says which index is the row's.
    fn learn_style(&mut self, symbols: &[(String, [usize; 3])]) {
        for ((letters, a), (other, b)) in symbols.iter().zip(symbols.iter().skip(1)) {
            let style = match (a, b) {
                _ if letters != other || a == b => continue,
                (&[i, j, k], &[x, y, z]) if [i, j, k] == [y, x, z] => Style::RowLast,
                (&[i, j, k], &[x, y, z]) if [i, j, k] == [x, z, y] => Style::RowFirst,
                _ => continue,
            };
            self.read.styles.entry(letters.clone()).or_insert(style);
        }
    }
}
