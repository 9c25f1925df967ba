//! From the statements of a document to pairs of formulas: what is printed, and what the robot makes of it.

use super::document::{Fence, Grid, Part, Side, Statement, sides};
use super::lexis::{Columns, Lexis};
use super::matrix::Matrix;
use super::names::Name;
use super::product::{Factor, NotMatrices, Product, product};
use super::subject::Subject;
use super::values::set_in;
use crate::geometry::orientation::OrientationSet;
use denavit_symbolic::parse::{Function, ParseError, Syntax, SyntaxKind, whole_word};
use denavit_symbolic::vocabulary::plain_name;
use denavit_symbolic::{Angle, Expr, equal};
use rustc_hash::FxHashMap;
use std::cell::RefCell;
use std::ops::Range;
use std::rc::Rc;

/// A formula in print, and what it should be.
#[derive(Clone, Debug)]
pub(super) struct Pair {
    /// Row and column from 1, in a matrix.
    pub place: Option<(usize, usize)>,
    /// Where it stands.
    pub span: Range<usize>,
    /// What is printed; nothing where it is worked out from printed factors.
    pub printed: Option<Syntax>,
    /// Its value.
    pub value: Expr,
    /// What the robot makes of it.
    pub wanted: Expr,
}

/// A part of a claim.
#[derive(Clone, Debug)]
pub(super) enum Piece {
    Pair(Pair),
    /// A formula that could not be read.
    Unreadable {
        place: Option<(usize, usize)>,
        span: Range<usize>,
        errors: Vec<ParseError>,
    },
}

/// What a statement claims of the robot.
#[derive(Clone, Debug)]
pub(super) struct Assertion {
    pub span: Range<usize>,
    /// The left side as printed.
    pub name: String,
    /// In words what it is about.
    pub about: String,
    pub pieces: Vec<Piece>,
    /// Remarks, such as a row that is too short.
    pub remarks: Vec<String>,
    /// Which of the robots of the document it is about.
    pub subject: usize,
    /// Values for joints and angles are judged in their own way.
    pub spoken: Option<Spoken>,
}

/// Printed values, the entries of the pose as symbols.
#[derive(Clone, Debug)]
pub(super) enum Spoken {
    /// Of a joint, or of a sum of joints, each value in print.
    Joint { of: Expr, sides: Vec<(Range<usize>, Syntax)> },
    /// Of an angle of an orientation.
    Angle { set: OrientationSet, name: String, value: (Range<usize>, Syntax) },
}

/// The document from beginning to end.
pub(super) struct Walk<'a> {
    text: &'a str,
    pub lexis: Lexis,
    pub subject: &'a Subject,
    number: usize,
    pub assertions: Vec<Assertion>,
    /// The set of angles that a directive names.
    pub angles: Option<OrientationSet>,
    /// Statements that say nothing of the robot and could not be read.
    pub skipped: Vec<(Range<usize>, ParseError)>,
    /// The cells of the matrices of the present statement.
    cells: RefCell<FxHashMap<usize, Rc<Cells>>>,
}

/// The cells of a printed matrix, by rows.
type Cells = Vec<Vec<Cell>>;

/// A cell of a printed matrix.
#[derive(Clone, Debug)]
enum Cell {
    LeftOut,
    /// Formulas with `=` between them.
    Formulas(Vec<(Range<usize>, Syntax)>),
    /// A name without meaning.
    Lone(Name),
    Broken(Range<usize>, Vec<ParseError>),
}

/// A side of an equation between scalars.
enum Scalar {
    Formula(Range<usize>, Syntax),
    Lone(Name),
    Broken(Range<usize>, Vec<ParseError>),
}

/// A name that a statement defines.
enum Definition {
    Matrix(Name, Matrix, Option<String>),
    /// An entry of a matrix that the robot gives.
    Entry(String, Expr),
    /// The value of a cell.
    Cell(String, Expr),
}

/// What is known before anything is compared.
struct Reference {
    matrix: Matrix,
    about: String,
}

impl<'a> Walk<'a> {
    /// Begins with a robot.
    pub fn new(text: &'a str, subject: &'a Subject) -> Self {
        let lexis = Lexis::new(subject, Columns::of(text));
        Walk {
            text,
            lexis,
            subject,
            number: 0,
            assertions: vec![],
            angles: None,
            skipped: vec![],
            cells: RefCell::default(),
        }
    }

    /// Goes on with another robot of the document.
    pub fn turn_to(&mut self, subject: &'a Subject, number: usize) {
        if number != self.number {
            self.lexis = self.lexis.of(subject);
            (self.subject, self.number) = (subject, number);
        }
    }

    /// The number of formulas so far.
    pub fn count(&self) -> usize {
        self.assertions.iter().map(|a| a.pieces.len()).sum()
    }

    /// A second name for a quantity.
    pub fn alias(&mut self, name: &str, meaning: &str) -> Option<()> {
        let value = match super::lexis::read(meaning, &(0..meaning.len()), &self.lexis.names) {
            Ok(syntax) => syntax.value(),
            Err(_) => {
                let word = whole_word(meaning)?.replace('_', "");
                self.lexis.names.lookup(&word)?
            }
        };
        self.lexis.define(name, value);
        Some(())
    }

    /// Reads a statement; `claim` says what its left side means, where that is told.
    pub fn statement(&mut self, statement: &Statement, claim: Option<&str>) {
        if statement.sides.iter().flat_map(|s| &s.parts).all(|p| matches!(p, Part::Text(_)))
            && self.scalars(statement, claim)
        {
            return;
        }
        self.matrices(statement, claim);
    }

    fn source(&self, span: &Range<usize>) -> &'a str {
        self.text.get(span.clone()).unwrap_or_default().trim()
    }

    fn claim_name(&self, statement: &Statement) -> String {
        let first = statement.sides.first().map_or(&statement.span, |s| &s.span);
        let name: String = self.source(first).chars().take(80).collect();
        name.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    fn assertion(&self, statement: &Statement, about: String) -> Assertion {
        Assertion {
            span: statement.span.clone(),
            name: self.claim_name(statement),
            about,
            pieces: vec![],
            remarks: vec![],
            subject: self.number,
            spoken: None,
        }
    }

    // Equations between scalars ---------------------------------------------------------------------------------

    fn scalar(&self, span: &Range<usize>) -> Scalar {
        let errors = match self.lexis.formula(self.text, span) {
            Ok(syntax) => return Scalar::Formula(span.clone(), syntax),
            Err(errors) => errors,
        };
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
            _ => Scalar::Broken(span.clone(), errors),
        }
    }

    /// What `x`, `Y`, `x_x` or `z_y` mean by custom, where the document gives no other meaning.
    fn conventional(&self, name: &Name) -> Option<Expr> {
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
    fn scalars(&mut self, statement: &Statement, claim: Option<&str>) -> bool {
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
        if let Some(spoken) = self.values(&spans, &read).or_else(|| self.angle(statement, &read)) {
            let about = match spoken {
                Spoken::Joint { .. } => "values of a joint".to_string(),
                Spoken::Angle { set, .. } => format!("an angle of the set {set}"),
            };
            let assertion = Assertion { spoken: Some(spoken), ..self.assertion(statement, about) };
            self.assertions.push(assertion);
            return true;
        }
        let told = claim.and_then(|words| self.told_entry(words));
        // A name that the document defines here.
        let is_definition = told.is_none()
            && match &read[..] {
                [Scalar::Lone(name), Scalar::Formula(_, syntax), ..] => {
                    let name = plain_name(&format!("{}{}", name.base, name.sub));
                    self.lexis.define(&name, syntax.value());
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
                let found = right.or_else(|| sine()).or_else(|| posed().filter(|_| !all_posed));
                found.or_else(|| formulas().next()).map(|(i, _, s)| (i, s.value()))
            }
        };
        let Some((at, wanted)) = reference else {
            for s in &read {
                if let Scalar::Broken(span, errors) = s {
                    let error = errors.first().cloned();
                    self.skipped.extend(error.map(|e| (span.clone(), e)));
                    break;
                }
            }
            return true;
        };
        let others = read.iter().enumerate().filter(|(i, _)| *i != at);
        let mut pieces = vec![];
        for (i, s) in others {
            match s {
                Scalar::Formula(span, syntax) => pieces.push(Piece::Pair(Pair {
                    place: None,
                    span: span.clone(),
                    printed: Some(syntax.clone()),
                    value: syntax.value(),
                    wanted,
                })),
                Scalar::Lone(_) if i == 0 => {}
                Scalar::Lone(name) => {
                    let errors = vec![ParseError::new(spans[i].clone(), format!("unknown `{}`", name.key()))];
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
            "an entry".to_string()
        } else {
            "an equation".to_string()
        };
        let mut assertion = self.assertion(statement, about);
        assertion.pieces = pieces;
        self.assertions.push(assertion);
        true
    }

    /// True for a name that the robot gives its meaning.
    fn is_right_name(&self, span: &Range<usize>) -> bool {
        let source = self.source(span);
        let Some(name) = self.lexis.lone_name(self.text, span) else { return self.lexis.is_right(source) };
        let plain = plain_name(&format!("{}{}", name.base, name.sub));
        self.lexis.is_right(&plain)
            || self.lexis.formula(self.text, span).is_err() && self.conventional(&name).is_some()
    }

    /// True if an entry of the pose occurs.
    fn speaks_of_pose(&self, span: &Range<usize>) -> bool {
        let Ok(syntax) = self.lexis.inverse_formula(self.text, span) else { return false };
        let symbols = syntax.value().symbols();
        let is_entry = |r: usize, c: usize| symbols.contains(&self.lexis.pose_symbol(r, c));
        (0..3).any(|r| (0..4).any(|c| is_entry(r, c)))
    }

    /// Values for a joint: `θ_1 = atan2(…)`.
    fn values(&self, spans: &[Range<usize>], read: &[Scalar]) -> Option<Spoken> {
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
        sides.iter().any(|(span, syntax)| is_value(syntax, span)).then_some(Spoken::Joint { of, sides })
    }

    /// Values for an angle of an orientation: `φ = atan2(R(2,3), R(1,3))`.
    fn angle(&self, statement: &Statement, read: &[Scalar]) -> Option<Spoken> {
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
    fn told_entry(&self, words: &str) -> Option<Expr> {
        let (name, place) = words.trim().split_once(' ')?;
        let (r, c) = place.trim().split_once([',', ' '])?;
        let (r, c): (usize, usize) = (r.trim().parse().ok()?, c.trim().parse().ok()?);
        let reference = self.told_matrix(name)?;
        reference.matrix.entry(r.checked_sub(1)?, c.checked_sub(1)?)
    }

    fn told_matrix(&self, words: &str) -> Option<Reference> {
        let name = self.lexis.lone_name(words, &(0..words.len()))?;
        let (matrix, about) = self.lexis.matrix(self.subject, &name)?;
        Some(Reference { matrix, about: about? })
    }

    // Equations between matrices --------------------------------------------------------------------------------

    /// True if a text is a product of names of matrices that have a meaning.
    fn is_product(&self, span: &Range<usize>) -> bool {
        let mut lexis = self.lexis.clone();
        lexis.anywhere = true;
        let side = Side { span: span.clone(), parts: vec![Part::Text(span.clone())] };
        product(self.text, &side, &lexis, self.subject, &|_| None).is_ok()
    }

    fn cell(&self, span: &Range<usize>, grid: &Grid) -> Cell {
        let is_determinant = grid.fence == Fence::Bars;
        let source = self.source(span);
        let is_dots = source.trim_matches(['$', '\\', '{', '}', ' ']);
        let is_column = grid.rows.iter().all(|r| r.len() == 1);
        if matches!(
            is_dots,
            "" | "."
                | "*"
                | "-"
                | "…"
                | "..."
                | "?"
                | "cdot"
                | "cdots"
                | "ldots"
                | "dots"
                | "ast"
                | "—"
                | "–"
                | "·"
                | "bullet"
                | "times"
        ) || matches!(is_dots, "x" | "X" | "×") && !is_column && self.lexis.names.lookup("x").is_none()
        {
            return Cell::LeftOut;
        }
        let mut formulas = vec![];
        let mut lone = None;
        for side in sides(self.text, span) {
            match self.scalar(&side) {
                Scalar::Formula(span, syntax) => formulas.push((span, syntax)),
                Scalar::Lone(name) if is_determinant && matches!(name.base.as_str(), "i" | "j" | "k") => {
                    let kind = SyntaxKind::Name(Expr::symbol(&name.base));
                    formulas.push((side.clone(), Syntax { kind, span: 0..side.len() }));
                }
                Scalar::Lone(name) => lone = Some(name),
                Scalar::Broken(span, errors) => return Cell::Broken(span, errors),
            }
        }
        match (formulas.is_empty(), lone) {
            (false, _) => Cell::Formulas(formulas),
            (true, Some(name)) => Cell::Lone(name),
            (true, None) => Cell::LeftOut,
        }
    }

    fn cells(&self, grid: &Grid) -> Rc<Cells> {
        if let Some(known) = self.cells.borrow().get(&grid.span.start) {
            return Rc::clone(known);
        }
        let cells = grid.rows.iter().map(|row| row.iter().map(|span| self.cell(span, grid)).collect());
        let cells: Rc<Cells> = Rc::new(cells.collect());
        self.cells.borrow_mut().insert(grid.span.start, Rc::clone(&cells));
        cells
    }

    /// The matrix that a grid prints.
    fn printed(&self, grid: &Grid) -> Option<Matrix> {
        let entry = |cell: &Cell| match cell {
            Cell::Formulas(formulas) => formulas.first().map(|f| f.1.value()),
            _ => None,
        };
        let mut rows: Vec<Vec<Option<Expr>>> =
            self.cells(grid).iter().map(|row| row.iter().map(entry).collect()).collect();
        // The last row of a homogeneous matrix may be left out or shortened.
        let width = rows.first().map_or(0, Vec::len);
        let is_bottom = |row: &Vec<Option<Expr>>| row.len() < width && width == 4;
        if rows.len() == 4 && rows.last().is_some_and(is_bottom) {
            rows.pop();
        }
        if rows.len() == 3 && width == 4 {
            rows.push([0, 0, 0, 1].map(|n| Some(Expr::int(n))).to_vec());
        }
        Some(Matrix(rows))
    }

    /// Gives names in cells their meaning: `c_4 c_5 = D_1`.
    fn define_cells(&mut self, grid: &Grid, definitions: &mut Vec<Definition>) {
        for span in grid.rows.iter().flatten() {
            let parts = sides(self.text, span);
            if parts.len() < 2 {
                continue;
            }
            let read: Vec<Scalar> = parts.iter().map(|s| self.scalar(s)).collect();
            let value = read.iter().find_map(|s| match s {
                Scalar::Formula(_, syntax) => Some(syntax.value()),
                _ => None,
            });
            for s in &read {
                if let (Scalar::Lone(name), Some(value)) = (s, value) {
                    let name = format!("{}{}", name.base, name.sub);
                    self.lexis.define(&name, value);
                    definitions.push(Definition::Cell(name, value));
                }
            }
        }
    }

    fn matrices(&mut self, statement: &Statement, claim: Option<&str>) {
        let before = self.lexis.clone();
        self.lexis.anywhere =
            statement.sides.iter().flat_map(|s| &s.parts).all(|p| matches!(p, Part::Text(_)))
                && !self.text.get(statement.span.clone()).unwrap_or_default().contains("ot}(")
                && !self.text.get(statement.span.clone()).unwrap_or_default().contains("Rot");
        let definitions = self.equate(statement, claim);
        // The letters of elementary transforms are known in their own statement only.
        self.lexis = before;
        self.cells.borrow_mut().clear();
        for definition in definitions {
            match definition {
                Definition::Matrix(name, matrix, about) => self.lexis.define_matrix(&name, matrix, about),
                Definition::Entry(name, value) => self.lexis.define_right(&name, value, value),
                Definition::Cell(name, value) => self.lexis.define(&name, value),
            }
        }
    }

    /// Holds the sides of an equation between matrices against each other; gives the names that it defines.
    fn equate(&mut self, statement: &Statement, claim: Option<&str>) -> Vec<Definition> {
        let mut definitions = vec![];
        for side in &statement.sides {
            for part in &side.parts {
                match part {
                    Part::Matrix(grid) => self.define_cells(grid, &mut definitions),
                    Part::Text(span) => {
                        let known = |_: &str| false;
                        for token in super::names::tokens(self.text, span, &known).unwrap_or_default() {
                            if let super::names::Token::Name(name) = token {
                                self.lexis.declare_arguments(&name);
                            }
                        }
                    }
                }
            }
        }
        let subject = self.subject;
        let read: Vec<Result<Product<'_>, NotMatrices>> = statement
            .sides
            .iter()
            .map(|side| product(self.text, side, &self.lexis, subject, &|grid| self.printed(grid)))
            .collect();
        if !read.iter().any(|r| r.is_ok()) {
            let error =
                ParseError::new(statement.span.clone(), "neither a formula nor a product of matrices");
            self.skipped.push((statement.span.clone(), error));
            return definitions;
        }
        let told = claim.and_then(|words| self.told_matrix(words.split(' ').next().unwrap_or(words)));
        let named = read.iter().enumerate().find_map(|(i, r)| match r {
            Ok(Product { value: Some(matrix), about: Some(about), .. }) => {
                Some((i, Reference { matrix: matrix.clone(), about: about.clone() }))
            }
            Ok(Product { value: Some(matrix), factors, .. }) => match factors.as_deref() {
                Some([Factor::Grid(grid)]) if self.is_right_names(grid) => {
                    Some((i, Reference { matrix: matrix.clone(), about: "the hand".into() }))
                }
                _ => None,
            },
            _ => None,
        });
        let jacobian = || self.jacobian_of(&read, statement);
        let (at, reference) = match (told, named) {
            (Some(reference), _) => (usize::MAX, Some(reference)),
            (None, Some((i, reference))) => (i, Some(reference)),
            (None, None) => match jacobian() {
                Some(reference) => (usize::MAX, Some(reference)),
                None => (usize::MAX, None),
            },
        };
        let mut assertion =
            self.assertion(statement, reference.as_ref().map_or(String::new(), |r| r.about.clone()));
        let mut names: Vec<&Grid> = vec![];
        let mut unread: Vec<Range<usize>> = vec![];
        let factors = read.iter().find_map(|r| match r {
            Ok(Product { factors: Some(factors), .. }) if factors.len() > 1 => {
                factors.iter().map(named_factor).collect::<Option<Vec<Matrix>>>()
            }
            _ => None,
        });
        match &reference {
            Some(reference) => {
                for (i, r) in read.iter().enumerate().filter(|(i, _)| *i != at) {
                    let span = &statement.sides[i].span;
                    match r {
                        Ok(_) if self.redefined(statement, i) => {}
                        Ok(product) => match &product.factors.as_deref() {
                            Some([Factor::Grid(grid)]) if self.is_velocity(grid) => {}
                            Some([Factor::Grid(grid)]) if self.is_names(grid) => names.push(grid),
                            _ => self.compare(product, reference, factors.as_deref(), span, &mut assertion),
                        },
                        Err(NotMatrices::Unknown(name)) if self.is_lone(&statement.sides[i], name) => {}
                        Err(_) => unread.push(span.clone()),
                    }
                }
                // A side that cannot be read matters where nothing else is judged.
                if assertion.pieces.is_empty() && names.is_empty() {
                    for span in unread {
                        let error = ParseError::new(span.clone(), "no product of matrices that are known");
                        assertion.pieces.push(Piece::Unreadable { place: None, span, errors: vec![error] });
                    }
                }
            }
            None => {
                // Nothing is known: what is printed later should be what is printed first.
                let first = read.iter().enumerate().find_map(|(i, r)| match r {
                    Ok(Product { value: Some(matrix), .. }) => Some((i, matrix.clone())),
                    _ => None,
                });
                if let Some((i, matrix)) = first {
                    let reference = Reference { matrix, about: "what stands before it".into() };
                    for (k, r) in read.iter().enumerate().skip(i + 1) {
                        if let Ok(product) = r {
                            self.compare(product, &reference, None, &statement.sides[k].span, &mut assertion);
                        }
                    }
                    assertion.about = "an equation between matrices".into();
                }
            }
        }
        // Matrices with a name of their own below them.
        let mut own: Vec<Assertion> = vec![];
        for grid in statement.sides.iter().flat_map(|s| &s.parts).filter_map(|p| match p {
            Part::Matrix(grid) => Some(grid),
            Part::Text(_) => None,
        }) {
            let Some(under) = &grid.under else { continue };
            let Some(found) = self.told_matrix(self.source(under)) else { continue };
            let mut part = self.assertion(statement, found.about.clone());
            part.name = self.source(under).to_string();
            part.span = grid.span.clone();
            let product = Product { factors: Some(vec![Factor::Grid(grid)]), value: None, about: None };
            self.compare(&product, &found, None, &grid.span, &mut part);
            own.push(part);
        }
        // Names that are defined: a matrix, or its entries.
        let defined = reference.as_ref().map(|r| (r.matrix.clone(), Some(r.about.clone()))).or_else(|| {
            read.iter().find_map(|r| match r {
                Ok(Product { value: Some(matrix), .. }) => Some((matrix.clone(), None)),
                _ => None,
            })
        });
        for (side, r) in statement.sides.iter().zip(&read) {
            if let (Err(NotMatrices::Unknown(name)), Some((matrix, about))) = (r, &defined)
                && self.is_lone(side, name)
            {
                definitions.push(Definition::Matrix(name.clone(), matrix.clone(), about.clone()));
            }
        }
        if let Some(reference) = &reference {
            for grid in names {
                for (r, row) in self.cells(grid).iter().enumerate() {
                    for (c, cell) in row.iter().enumerate() {
                        if let (Cell::Lone(name), Some(value)) = (cell, reference.matrix.entry(r, c)) {
                            definitions.push(Definition::Entry(format!("{}{}", name.base, name.sub), value));
                        }
                    }
                }
            }
        }
        drop(read);
        self.assertions.extend(own);
        if !assertion.pieces.is_empty() {
            self.assertions.push(assertion);
        }
        definitions
    }

    /// The number of a side that only names what the document has defined before, and is defined anew.
    fn redefined(&self, statement: &Statement, i: usize) -> bool {
        let [Part::Text(span)] = &statement.sides[i].parts[..] else { return false };
        let name = self.lexis.lone_name(self.text, span);
        i == 0
            && name.is_some_and(|n| {
                self.lexis.has_defined(&n)
                    && self.lexis.matrix(self.subject, &n).is_some_and(|m| m.1.is_none())
            })
    }

    /// True for a column of velocities.
    fn is_velocity(&self, grid: &Grid) -> bool {
        let mut spans = grid.rows.iter().flatten().map(|s| self.source(s));
        grid.rows.iter().all(|r| r.len() == 1) && spans.any(|s| s.contains(r"\dot") || s.contains('\u{307}'))
    }

    fn is_lone(&self, side: &Side, name: &Name) -> bool {
        matches!(&side.parts[..], [Part::Text(span)]
            if self.lexis.lone_name(self.text, span).is_some_and(|n| n.key() == name.key()))
    }

    /// True for a matrix of names without meaning of their own; the last row may hold numbers.
    fn is_names(&self, grid: &Grid) -> bool {
        let cells = self.cells(grid);
        let is_number = |syntax: &Syntax| syntax.value().as_number().is_some();
        let is_pose = |span: &Range<usize>| self.is_right_name(span);
        let is_name = |cell: &Cell| match cell {
            Cell::Lone(_) | Cell::LeftOut => true,
            Cell::Formulas(formulas) => formulas.iter().all(|f| is_number(&f.1) || is_pose(&f.0)),
            Cell::Broken(..) => false,
        };
        let has_name = |cell: &Cell| match cell {
            Cell::Lone(_) => true,
            Cell::Formulas(formulas) => formulas.iter().all(|f| is_pose(&f.0)),
            _ => false,
        };
        cells.iter().flatten().all(is_name) && cells.iter().flatten().any(has_name)
    }

    /// True for a matrix of names that custom or the robot give a meaning.
    fn is_right_names(&self, grid: &Grid) -> bool {
        let mut spans = grid.rows.iter().flatten();
        spans.clone().count() > 1 && spans.all(|s| self.is_right_name(s))
    }

    /// The Jacobian, where a statement is about one: `J = […]`, or a matrix times a column of rates.
    fn jacobian_of(
        &self,
        read: &[Result<Product<'_>, NotMatrices>],
        statement: &Statement,
    ) -> Option<Reference> {
        let is_j = |side: &Side| match &side.parts[..] {
            [Part::Text(span)] => {
                let name = self.lexis.lone_name(self.text, span);
                name.is_some_and(|n| n.base == "J" || n.base == "Jacobian")
            }
            _ => false,
        };
        let is_rates = |grid: &Grid| {
            let mut spans = grid.rows.iter().flatten();
            let is_rate = |s: &str| s.contains("\\dot") || s.contains('̇') || s.ends_with('\'');
            spans.clone().count() > 0 && spans.all(|s| is_rate(self.source(s)))
        };
        let is_told = statement.sides.iter().any(is_j);
        let grid = read.iter().find_map(|r| match r.as_ref().ok()?.factors.as_deref()? {
            [Factor::Grid(grid)] if is_told => Some(*grid),
            [Factor::Grid(grid), Factor::Grid(rates)] if is_rates(rates) => Some(*grid),
            _ => None,
        })?;
        let printed = Matrix(
            self.cells(grid)
                .iter()
                .map(|row| {
                    row.iter()
                        .map(|c| match c {
                            Cell::Formulas(f) => f.first().map(|f| f.1.value()),
                            _ => None,
                        })
                        .collect()
                })
                .collect(),
        );
        let (rows, columns) = printed.shape()?;
        let joints = self.subject.description.variables().len();
        if columns != joints || !(2..=6).contains(&rows) {
            return None;
        }
        let mut points = denavit_symbolic::slip::Points::new(7);
        let mut same = |m: &Matrix| {
            let pairs = m.0.iter().flatten().zip(printed.0.iter().flatten());
            let mut count = 0;
            for (a, b) in pairs {
                if let (Some(a), Some(b)) = (a, b) {
                    let (a, b) = (points.value(*a), points.value(*b));
                    count += usize::from(a.is_some() && a == b);
                }
            }
            count
        };
        let mut best: Option<(usize, String, Matrix)> = None;
        for (about, matrix) in self.subject.jacobians(rows) {
            let count = same(&matrix);
            if best.as_ref().is_none_or(|b| count > b.0) {
                best = Some((count, about, matrix));
            }
        }
        best.map(|(_, about, matrix)| Reference { matrix, about })
    }

    /// Holds a side against a matrix that is known.
    fn compare(
        &self,
        product: &Product<'_>,
        reference: &Reference,
        named: Option<&[Matrix]>,
        span: &Range<usize>,
        out: &mut Assertion,
    ) {
        let is_grid = |f: &Factor<'_>| matches!(f, Factor::Grid(g) if g.fence != Fence::Bars);
        match product.factors.as_deref() {
            Some([Factor::Grid(grid)]) if grid.fence != Fence::Bars => {
                self.compare_grid(grid, &reference.matrix, out)
            }
            Some([Factor::Grid(grid), Factor::Grid(rates)])
                if reference.about.starts_with("the Jacobian") && rates.rows.iter().all(|r| r.len() == 1) =>
            {
                self.compare_grid(grid, &reference.matrix, out);
            }
            Some(factors) if factors.len() > 1 && factors.iter().all(is_grid) => {
                if self.compare_value(product.value.as_ref(), &reference.matrix, span, &mut out.clone()) {
                    self.compare_value(product.value.as_ref(), &reference.matrix, span, out);
                    return;
                }
                // The product is wrong: which of its factors is?
                let parts = named.filter(|n| n.len() == factors.len()).map(<[Matrix]>::to_vec);
                match parts.or_else(|| self.chain(factors, &reference.matrix)) {
                    Some(parts) => {
                        for (factor, part) in factors.iter().zip(parts) {
                            if let Factor::Grid(grid) = factor {
                                self.compare_grid(grid, &part, out);
                            }
                        }
                    }
                    None => {
                        self.compare_value(product.value.as_ref(), &reference.matrix, span, out);
                    }
                }
            }
            _ => {
                self.compare_value(product.value.as_ref(), &reference.matrix, span, out);
            }
        }
    }

    /// The transforms that printed factors stand for, where their product is known: links next to each other, cut so
    /// that most entries agree.
    fn chain(&self, factors: &[Factor<'_>], whole: &Matrix) -> Option<Vec<Matrix>> {
        let mut points = denavit_symbolic::slip::Points::new(7);
        let mut key = |m: &Matrix| -> Vec<Option<[u64; 3]>> {
            m.0.iter().take(3).flatten().map(|e| e.and_then(|e| points.value(e))).collect()
        };
        let n = self.subject.last();
        let size = whole.0.len();
        let form = |x: crate::geometry::Transform<Expr>| {
            if size == 3 { Matrix::of_rotation(&x.rotation) } else { Matrix::of(&x) }
        };
        let wanted = key(whole);
        let (from, to) = (0..=n).flat_map(|i| (i + 1..=n).map(move |j| (i, j))).find(|&(i, j)| {
            self.subject.transform(Some(i), Some(j)).is_some_and(|x| key(&form(x)) == wanted)
        })?;
        let count = factors.len();
        if to - from < count || count > 6 {
            return None;
        }
        let mut agreement = |grid: &Factor<'_>, i: usize, j: usize| -> usize {
            let Factor::Grid(grid) = grid else { return 0 };
            let (Some(printed), Some(x)) = (self.printed(grid), self.subject.transform(Some(i), Some(j)))
            else {
                return 0;
            };
            let pairs = key(&printed).into_iter().zip(key(&form(x)));
            pairs.filter(|(a, b)| a.is_some() && a == b).count()
        };
        // The best cut of from..to into as many pieces as there are factors.
        let mut best: Vec<Option<(usize, Vec<usize>)>> = vec![None; to + 1];
        best[from] = Some((0, vec![from]));
        for factor in factors {
            let mut next: Vec<Option<(usize, Vec<usize>)>> = vec![None; to + 1];
            for i in from..to {
                let Some((score, cuts)) = best[i].clone() else { continue };
                for (j, slot) in next.iter_mut().enumerate().skip(i + 1) {
                    let total = score + agreement(factor, i, j);
                    if slot.as_ref().is_none_or(|s| total > s.0) {
                        let mut cuts = cuts.clone();
                        cuts.push(j);
                        *slot = Some((total, cuts));
                    }
                }
            }
            best = next;
        }
        let (score, cuts) = best[to].take()?;
        let entries = wanted.len() * count;
        if 2 * score < entries {
            return None;
        }
        cuts.windows(2).map(|w| Some(form(self.subject.transform(Some(w[0]), Some(w[1]))?))).collect()
    }

    fn compare_grid(&self, grid: &Grid, wanted: &Matrix, out: &mut Assertion) {
        let cells = self.cells(grid);
        let width = cells.iter().map(Vec::len).max().unwrap_or(0);
        for (r, row) in cells.iter().enumerate() {
            if row.len() < width {
                out.remarks.push(format!("row {} has {} elements for {width}", r + 1, row.len()));
                continue;
            }
            for (c, cell) in row.iter().enumerate() {
                let place = Some((r + 1, c + 1));
                match cell {
                    Cell::LeftOut => {}
                    Cell::Broken(span, errors) => out.pieces.push(Piece::Unreadable {
                        place,
                        span: span.clone(),
                        errors: errors.clone(),
                    }),
                    Cell::Lone(name) => {
                        let span = grid.rows[r][c].clone();
                        let errors = vec![ParseError::new(span.clone(), format!("unknown `{}`", name.key()))];
                        out.pieces.push(Piece::Unreadable { place, span, errors });
                    }
                    Cell::Formulas(formulas) => {
                        let Some(wanted) = wanted.entry(r, c) else {
                            if wanted.0.get(r).is_none_or(|row| c >= row.len()) && c < 4 && r < 4 {
                                continue;
                            }
                            let remark =
                                format!("row {}, column {} has nothing to compare with", r + 1, c + 1);
                            out.remarks.push(remark);
                            continue;
                        };
                        for (span, syntax) in formulas {
                            out.pieces.push(Piece::Pair(Pair {
                                place,
                                span: span.clone(),
                                printed: Some(syntax.clone()),
                                value: syntax.value(),
                                wanted,
                            }));
                        }
                    }
                }
            }
        }
    }

    /// Holds a matrix that is worked out against one that is known; true if all of it is proved equal. What is equal
    /// is said in one piece, what is not entry by entry.
    fn compare_value(
        &self,
        value: Option<&Matrix>,
        wanted: &Matrix,
        span: &Range<usize>,
        out: &mut Assertion,
    ) -> bool {
        let Some(value) = value else { return false };
        let value = match (value.shape(), wanted.shape()) {
            (Some((4, 4)), Some((3, 3))) => &value.rotation_part(),
            _ => value,
        };
        let (mut same, mut different) = (None, false);
        for (r, row) in wanted.0.iter().enumerate() {
            for (c, wanted) in row.iter().enumerate() {
                let (Some(value), &Some(wanted)) = (value.entry(r, c), wanted) else { continue };
                let pair = |place| Pair { place, span: span.clone(), printed: None, value, wanted };
                if equal(value, wanted).is_equal() {
                    same = Some(pair(None));
                } else {
                    different = true;
                    out.pieces.push(Piece::Pair(pair(Some((r + 1, c + 1)))));
                }
            }
        }
        let is_right = !different && same.is_some();
        out.pieces.extend(same.filter(|_| is_right).map(Piece::Pair));
        is_right
    }
}

/// True if a formula speaks of the orientation.
fn has_entry(walk: &Walk<'_>, span: &Range<usize>) -> bool {
    let Ok(syntax) = walk.lexis.inverse_formula(walk.text, span) else { return false };
    let symbols = syntax.value().symbols();
    (0..3).any(|r| (0..3).any(|c| symbols.contains(&walk.lexis.pose_symbol(r, c))))
}

/// The matrix that a factor names.
fn named_factor(factor: &Factor<'_>) -> Option<Matrix> {
    match factor {
        Factor::Named(_, matrix, Some(_)) => Some(matrix.clone()),
        _ => None,
    }
}

/// True if an arctangent or the like occurs.
fn has_inverse_function(syntax: &Syntax) -> bool {
    let is_inverse = match &syntax.kind {
        SyntaxKind::Call(f, _) => f.is_inverse() || *f == Function::Atan2,
        _ => false,
    };
    is_inverse || syntax.children().into_iter().any(has_inverse_function)
}
