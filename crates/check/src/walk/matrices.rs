//! Equations between matrices: what is known of a side, what is compared, what is defined.

use super::{Assertion, Cell, Cells, Definition, MAX_ELEMENTS, Piece, Reference, Scalar, Walk};
use crate::facts::{About, Jacobian, Meaning};
use crate::jacobians::told_of_jacobian;
use crate::matrix::Matrix;
use crate::names::{Name, Token, tokens};
use crate::note::{Unread, Unreadable};
use crate::product::{Factor, NotMatrices, Product, product};
use denavit::forward::Reference as Frame;
use denavit_reading::document::{Fence, Grid, Part, Place, Side, Statement, sides};
use denavit_symbolic::parse::{Syntax, SyntaxKind};
use denavit_symbolic::{Expr, Symbol};
use std::ops::Range;
use std::rc::Rc;

impl Walk<'_> {
    /// True if a text is a product of names of matrices that have a meaning.
    pub(super) fn is_product(&self, span: &Range<usize>) -> bool {
        let before = self.lexis.anywhere.replace(true);
        let side = Side { span: span.clone(), parts: vec![Part::Text(span.clone())] };
        let is_product = product(self.text, &side, &self.lexis, &self.subject, &|_| None).is_ok();
        self.lexis.anywhere.set(before);
        is_product
    }

    pub(super) fn cell(&self, span: &Range<usize>, grid: &Grid) -> Cell {
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
        ) || matches!(is_dots, "x" | "X" | "×")
            && !is_column
            && (self.lexis.is_by_custom("x") || self.lexis.names.lookup("x").is_none())
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

    pub(super) fn cells(&self, grid: &Grid) -> Rc<Cells> {
        if let Some(known) = self.cells.borrow().get(&grid.span.start) {
            return Rc::clone(known);
        }
        let count = elements(grid);
        let cells: Cells = if count > MAX_ELEMENTS {
            let why = Unreadable::ManyElements { elements: count, most: MAX_ELEMENTS };
            let errors = vec![Unread::new(grid.span.clone(), why)];
            vec![vec![Cell::Broken(grid.span.clone(), errors)]]
        } else {
            grid.rows.iter().map(|row| row.iter().map(|span| self.cell(span, grid)).collect()).collect()
        };
        let cells = Rc::new(cells);
        self.cells.borrow_mut().insert(grid.span.start, Rc::clone(&cells));
        cells
    }

    /// The matrix that a grid prints.
    pub(super) fn printed(&self, grid: &Grid) -> Option<Matrix> {
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
    pub(super) fn define_cells(&mut self, grid: &Grid, definitions: &mut Vec<Definition>) {
        if elements(grid) > MAX_ELEMENTS {
            return;
        }
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

    pub(super) fn matrices(&mut self, statement: &Statement, claim: Option<&str>) {
        self.begin_again(statement);
        let names = self.elementary(statement);
        let before = (!names.is_empty()).then(|| self.lexis.clone());
        names.iter().for_each(|name| self.lexis.declare_arguments(name));
        self.declare_load(statement);
        if self.is_load_given(statement) {
            self.taken.push(statement.span.clone());
            return;
        }
        let is_named = statement.sides.iter().flat_map(|s| &s.parts).all(|p| matches!(p, Part::Text(_)));
        self.lexis.anywhere.set(is_named && names.is_empty());
        let definitions = self.equate(statement, claim);
        self.lexis.anywhere.set(false);
        // The letters of elementary transforms are known in their own statement only.
        if let Some(before) = before {
            self.lexis = before;
        }
        self.cells.borrow_mut().clear();
        for definition in definitions {
            match definition {
                Definition::Matrix(name, matrix, about) => {
                    self.named.push((statement.span.clone(), name.key()));
                    self.named_under.insert(name.key(), statement.heading.clone());
                    self.name_entries(&name, &matrix);
                    self.lexis.define_matrix(&name, matrix, about);
                }
                Definition::Entry(name, value, posed) => self.lexis.define_right(&name, value, posed),
                Definition::Posed(name, matrix) => self.lexis.define_posed(&name, matrix),
                Definition::Cell(name, value) => self.lexis.define(&name, value),
            }
        }
    }

    /// Reads `q = [0, 30, 45]` as a configuration.
    fn whole_configuration(&mut self, statement: &Statement) -> bool {
        let [left, right] = &statement.sides[..] else { return false };
        let ([Part::Text(name)], [Part::Matrix(grid)]) = (&left.parts[..], &right.parts[..]) else {
            return false;
        };
        // `qn` and `q0` name configurations, too.
        let is_named = |n: &Name| {
            let plain = format!("{}{}", n.base, n.sub);
            let mut letters = plain.chars();
            let is_own = n.left.is_empty() && n.sup.is_empty() && letters.next() == Some('q');
            is_own
                && letters.next().is_some_and(|c| c.is_alphabetic() || c == '0')
                && letters.next().is_none()
        };
        let is_q =
            |n: &Name| is_named(n) || n.is_bare() && matches!(n.base.as_str(), "q" | "θ" | "Θ" | "theta");
        let cells = self.cells(grid);
        let values: Option<Vec<Expr>> = cells
            .iter()
            .flatten()
            .map(|cell| match cell {
                Cell::Formulas(formulas) => {
                    formulas.first().map(|f| f.1.value()).filter(|e| e.symbols().is_empty())
                }
                _ => None,
            })
            .collect();
        let joints = self.subject.description.variables().len();
        let Some(values) = values.filter(|v| v.len() == joints) else { return false };
        let plain = crate::custom::plain(self.source(name));
        let is_rates = matches!(plain.as_str(), "dotq" | "dotθ" | "qdot" | "θdot" | "q\u{307}" | "θ\u{307}");
        if is_rates && self.velocity_given().is_none() {
            let rates = self.subject.rates();
            for (rate, value) in rates.iter().filter_map(|e| e.as_symbol()).zip(values) {
                self.at.give(rate, value);
            }
            self.taken.push(statement.span.clone());
            return true;
        }
        if !self.lexis.lone_name(self.text, name).is_some_and(|n| is_q(&n)) {
            return false;
        }
        self.taken.push(statement.span.clone());
        let before = self.at.present();
        for (joint, value) in values.into_iter().enumerate() {
            self.at.set(joint, value);
        }
        self.learn_label(&statement.span, &before);
        true
    }

    /// The elementary transforms that a statement names, `Rot(x, θ)`.
    fn elementary(&self, statement: &Statement) -> Vec<Name> {
        let texts = statement.sides.iter().flat_map(|s| &s.parts).filter_map(|p| match p {
            Part::Text(span) => Some(span),
            Part::Matrix(_) => None,
        });
        let names = texts.flat_map(|span| tokens(self.text, span, &|_| false).unwrap_or_default());
        let is_elementary = |name: &Name| {
            matches!(name.base.as_str(), "Rot" | "rot" | "Trans" | "trans")
                || name.base == "R" && !name.arguments.is_empty()
        };
        let names = names.filter_map(|t| match t {
            Token::Name(name) => Some(name),
            _ => None,
        });
        names.filter(is_elementary).collect()
    }

    /// Holds the sides of an equation between matrices against each other; gives the names that it defines.
    pub(super) fn equate(&mut self, statement: &Statement, claim: Option<&str>) -> Vec<Definition> {
        let mut definitions = vec![];
        for part in statement.sides.iter().flat_map(|s| &s.parts) {
            if let Part::Matrix(grid) = part {
                self.define_cells(grid, &mut definitions);
            }
        }
        let subject = Rc::clone(&self.subject);
        let read: Vec<Result<Product<'_>, NotMatrices>> = statement
            .sides
            .iter()
            .map(|side| product(self.text, side, &self.lexis, &subject, &|grid| self.printed(grid)))
            .collect();
        if !read.iter().any(|r| r.is_ok()) {
            self.skipped.push((statement.span.clone(), Unreadable::NeitherFormulaNorProduct));
            return definitions;
        }
        if self.whole_configuration(statement) || self.aims_at_matrix(statement) {
            return definitions;
        }
        // What a sentence tells is a claim only where it is something of the robot.
        if statement.place == Place::Told && self.recognised(&read, statement).is_none() {
            self.taken.push(statement.span.clone());
            return definitions;
        }
        if let Some(columns) = self.columns(statement) {
            return columns;
        }
        definitions.extend(self.posed(statement));
        let told = claim.and_then(|words| self.told_matrix(words.split(' ').next().unwrap_or(words)));
        let is_jacobian = self.jacobian_of(&read, statement).is_some();
        let tells_jacobian = |i: usize| is_jacobian && self.tells_jacobian(&statement.sides[i]);
        let named = read.iter().enumerate().filter(|(i, _)| !tells_jacobian(*i)).find_map(|(i, r)| match r {
            Ok(Product { value: Some(matrix), about: Some(about), .. }) => {
                Some((i, Reference { matrix: matrix.clone(), about: Some(about.clone()) }))
            }
            Ok(Product { value: Some(matrix), factors, .. }) => match factors.as_deref() {
                Some([Factor::Grid(grid)]) if self.is_right_names(grid) => {
                    Some((i, Reference { matrix: matrix.clone(), about: Some(Meaning::Hand) }))
                }
                _ => None,
            },
            _ => None,
        });
        let jacobian = || self.jacobian_of(&read, statement);
        let (at, reference) = match (told, named) {
            (Some(reference), _) => (usize::MAX, Some(reference)),
            // A column of velocities is a matrix times rates.
            (None, Some((_, Reference { about: Some(Meaning::Hand), .. }))) if is_jacobian => {
                (usize::MAX, jacobian())
            }
            (None, Some((i, reference))) => (i, Some(reference)),
            (None, None) => match jacobian() {
                Some(reference) => (usize::MAX, Some(reference)),
                None => (usize::MAX, self.rates_of(statement).or_else(|| self.recognised(&read, statement))),
            },
        };
        if let Some(Reference { matrix, about: Some(Meaning::Jacobian(jacobian)) }) = &reference {
            if self.lexis.habits.velocities_of_jacobian {
                definitions.extend(self.velocities(jacobian));
            }
            definitions.extend(self.entries(statement, matrix));
        }
        let about = reference.as_ref().and_then(|r| r.about.clone()).map_or(About::Matrices, About::Matrix);
        let mut assertion = self.assertion(statement, about);
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
                        Ok(_) if tells_jacobian(i) => {}
                        Ok(product) => match &product.factors.as_deref() {
                            Some([Factor::Grid(grid)])
                                if self.is_velocity(grid)
                                    && !matches!(reference.about, Some(Meaning::Velocity { .. })) => {}
                            Some([Factor::Grid(grid)])
                                if self.is_names(grid)
                                    && !matches!(reference.about, Some(Meaning::Velocity { .. })) =>
                            {
                                names.push(grid);
                            }
                            _ => self.compare(product, reference, factors.as_deref(), span, &mut assertion),
                        },
                        Err(NotMatrices::Unknown(name)) if self.is_lone(&statement.sides[i], name) => {}
                        Err(_) => unread.push(span.clone()),
                    }
                }
                // A side that cannot be read matters where nothing else is judged.
                if assertion.pieces.is_empty() && names.is_empty() {
                    for span in unread {
                        let error = Unread::new(span.clone(), Unreadable::NoKnownProduct);
                        assertion.pieces.push(Piece::Unreadable { place: None, span, errors: vec![error] });
                    }
                }
            }
            None => {
                // Nothing is known: what is printed later should be what is printed first.
                let is_old = |i: usize| i == 0 && read.len() > 1 && self.redefined(statement, 0);
                let first = read.iter().enumerate().find_map(|(i, r)| match r {
                    Ok(Product { value: Some(matrix), .. }) if !is_old(i) => Some((i, matrix.clone())),
                    _ => None,
                });
                if let Some((i, matrix)) = first {
                    let reference = Reference { matrix, about: None };
                    for (k, r) in read.iter().enumerate().skip(i + 1) {
                        if let Ok(product) = r {
                            self.compare(product, &reference, None, &statement.sides[k].span, &mut assertion);
                        }
                    }
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
            let about = found.about.clone().map_or(About::Matrices, About::Matrix);
            let mut part = self.assertion(statement, about);
            part.name = self.source(under).to_string();
            part.span = grid.span.clone();
            let product = Product { factors: Some(vec![Factor::Grid(grid)]), value: None, about: None };
            self.compare(&product, &found, None, &grid.span, &mut part);
            own.push(part);
        }
        // Names that are defined: a matrix, or its entries.
        let defined = reference.as_ref().map(|r| (r.matrix.clone(), r.about.clone())).or_else(|| {
            read.iter().find_map(|r| match r {
                Ok(Product { value: Some(matrix), .. }) => Some((matrix.clone(), None)),
                _ => None,
            })
        });
        for (k, (side, r)) in statement.sides.iter().zip(&read).enumerate() {
            // `Jv` may look like a product.
            let is_told = tells_jacobian(0) && (r.is_ok() || k == 0);
            let anew = is_told.then(|| self.lone(side)).flatten().map(Box::new);
            let unknown = match r {
                Err(NotMatrices::Unknown(name)) => Some(name.clone()),
                _ => anew,
            };
            if let (Some(name), Some((matrix, about))) = (unknown, &defined)
                && self.is_lone(side, &name)
                && !name.is_at_rest()
            {
                definitions.push(Definition::Matrix(name.as_ref().clone(), matrix.clone(), about.clone()));
            }
        }
        if let Some(reference) = &reference {
            for grid in names {
                for (r, row) in self.cells(grid).iter().enumerate() {
                    for (c, cell) in row.iter().enumerate() {
                        if let (Cell::Lone(name), Some(value)) = (cell, reference.matrix.entry(r, c)) {
                            let name = format!("{}{}", name.base, name.sub);
                            definitions.push(Definition::Entry(name, value, value));
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

    /// The names of the entries of a Jacobian that a statement prints: `j_{11}`.
    fn entries(&self, statement: &Statement, matrix: &Matrix) -> Vec<Definition> {
        let is_bare = statement.sides.first().and_then(|s| self.lone(s)).is_some_and(|n| n.is_bare());
        let mut found = vec![];
        for (r, row) in matrix.0.iter().enumerate().filter(|_| is_bare) {
            for (c, value) in row.iter().enumerate() {
                let name = format!("j{}{}", r + 1, c + 1);
                if let Some(value) = value.filter(|_| self.lexis.names.lookup(&name).is_none()) {
                    found.push(Definition::Entry(name, value, value));
                }
            }
        }
        found
    }

    /// The components of the velocity that a Jacobian gives, under their names.
    fn velocities(&self, jacobian: &Jacobian) -> Vec<Definition> {
        const NAMES: [&[&str]; 6] = [&["vx"], &["vy"], &["vz"], &["wx", "ωx"], &["wy", "ωy"], &["wz", "ωz"]];
        let rows = match jacobian.at {
            Some(k) => self.subject.geometric_rows_at(Frame::Frame(k), jacobian.axes),
            None => self.subject.geometric_rows(jacobian.body, jacobian.axes),
        };
        let rates = self.subject.rates();
        let of =
            |row: &Vec<Expr>| row.iter().zip(&rates).fold(Expr::int(0), |sum, (&e, &rate)| sum + e * rate);
        let values = rows.iter().map(of).zip(NAMES);
        let entry = |(value, names): (Expr, &'static [&'static str])| {
            names.iter().map(move |name| Definition::Entry((*name).to_string(), value, value))
        };
        values.flat_map(entry).collect()
    }

    /// What a side that is a lone name is in the entries of the pose, and in no joint: `U = X·T·Y`.
    fn posed(&self, statement: &Statement) -> Option<Definition> {
        let [left, rest @ ..] = &statement.sides[..] else { return None };
        let name = self.lone(left)?;
        let joints = self.subject.joints();
        let is_free = |e: Expr| !e.symbols().iter().any(|s| joints.contains(&(*s).into()));
        self.lexis.is_posed.set(true);
        let read = |side| product(self.text, side, &self.lexis, &self.subject, &|grid| self.printed(grid));
        let value = rest.iter().find_map(|side| {
            let value =
                read(side).ok()?.value.filter(|m| m.0.iter().flatten().flatten().all(|e| is_free(*e)))?;
            (value.shape() == Some((4, 4)) && self.is_of_pose(&value)).then_some(value)
        });
        self.lexis.is_posed.set(false);
        Some(Definition::Posed(name, value?))
    }

    /// True for a matrix in which entries of the pose occur.
    fn is_of_pose(&self, matrix: &Matrix) -> bool {
        let symbols: Vec<Symbol> = (0..3)
            .flat_map(|r| (0..4).map(move |c| (r, c)))
            .map(|(r, c)| self.lexis.pose_symbol(r, c))
            .collect();
        matrix.0.iter().flatten().flatten().any(|e| e.symbols().iter().any(|s| symbols.contains(s)))
    }

    /// The entries of the pose that name the columns of another matrix: `U = [n o a p]` behind `U = X·T·Y`.
    fn columns(&self, statement: &Statement) -> Option<Vec<Definition>> {
        let [left, right] = &statement.sides[..] else { return None };
        let [Part::Matrix(grid)] = &right.parts[..] else { return None };
        let name = self.lone(left)?;
        let posed = self.lexis.posed_matrix(&name)?;
        let (matrix, _) = self.lexis.matrix(&self.subject, &name)?;
        if !self.is_names(grid) {
            return None;
        }
        let mut found = vec![];
        for (r, row) in grid.rows.iter().enumerate().take(3) {
            for (c, span) in row.iter().enumerate() {
                let name = self.lexis.lone_name(self.text, span)?;
                let name = format!("{}{}", name.base, name.sub);
                found.push(Definition::Entry(name, matrix.entry(r, c)?, posed.entry(r, c)?));
            }
        }
        Some(found)
    }

    /// The number of a side that only names what the document has defined before, and is defined anew.
    pub(super) fn redefined(&self, statement: &Statement, i: usize) -> bool {
        let [Part::Text(span)] = &statement.sides[i].parts[..] else { return false };
        let name = self.lexis.lone_name(self.text, span);
        i == 0
            && name.is_some_and(|n| {
                self.lexis.has_defined(&n)
                    && self.lexis.matrix(&self.subject, &n).is_some_and(|m| m.1.is_none())
            })
    }

    /// True for a column of velocities.
    pub(super) fn is_velocity(&self, grid: &Grid) -> bool {
        let mut spans = grid.rows.iter().flatten().map(|s| self.source(s));
        grid.rows.iter().all(|r| r.len() == 1) && spans.any(|s| s.contains(r"\dot") || s.contains('\u{307}'))
    }

    /// The matrix that words name.
    pub(super) fn told_matrix(&self, words: &str) -> Option<Reference> {
        let name = self.lexis.lone_name(words, &(0..words.len()))?;
        let (matrix, about) = self.lexis.matrix(&self.subject, &name)?;
        Some(Reference { matrix, about: Some(about?) })
    }

    /// The one name that a side is.
    pub(super) fn lone(&self, side: &Side) -> Option<Name> {
        match &side.parts[..] {
            [Part::Text(span)] => self.lexis.lone_name(self.text, span),
            _ => None,
        }
    }

    /// True for a side that only names a Jacobian.
    fn tells_jacobian(&self, side: &Side) -> bool {
        self.lone(side).is_some_and(|name| told_of_jacobian(&name).is_some())
    }

    pub(super) fn is_lone(&self, side: &Side, name: &Name) -> bool {
        matches!(&side.parts[..], [Part::Text(span)]
            if self.lexis.lone_name(self.text, span).is_some_and(|n| n.key() == name.key()))
    }

    /// True for a matrix of names without meaning of their own; the last row may hold numbers.
    pub(super) fn is_names(&self, grid: &Grid) -> bool {
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
    pub(super) fn is_right_names(&self, grid: &Grid) -> bool {
        let mut spans = grid.rows.iter().flatten();
        spans.clone().count() > 1 && spans.all(|s| self.is_right_name(s))
    }
}

/// The number of elements of a printed matrix.
pub(super) fn elements(grid: &Grid) -> usize {
    grid.rows.iter().map(Vec::len).sum()
}

/// The matrix that a factor names.
fn named_factor(factor: &Factor<'_>) -> Option<Matrix> {
    match factor {
        Factor::Named(matrix, Some(_)) => Some(matrix.clone()),
        _ => None,
    }
}
