//! A printed matrix, or a product of printed matrices, against the matrix that it should be.

use super::scalars::is_measured;
use super::words::puts_to_zero;
use super::{Assertion, Cell, Pair, Piece, Reference, Walk};
use crate::facts::{About, Meaning, Remark, ShortRow};
use crate::jacobians::{frames_told, told_of_jacobian};
use crate::matrix::Matrix;
use crate::names::Name;
use crate::note::{Unread, Unreadable};
use crate::numbers::{Answer, half_unit, judge};
use crate::outcome::Finding;
use crate::product::{Factor, NotMatrices, Product, product};
use crate::recognised::{Agreement, candidates, nearest};
use denavit::forward::Reference::Tool;
use denavit::geometry::Transform;
use denavit_reading::document::{Fence, Grid, Part, Side, Statement};
use denavit_reading::slip::Points;
use denavit_symbolic::readable::literals;
use denavit_symbolic::{Expr, equal};
use std::ops::Range;

impl Walk<'_> {
    /// The Jacobian, where a statement is about one: `J = […]`, or a matrix times a column of rates.
    pub(super) fn jacobian_of(
        &self,
        read: &[Result<Product<'_>, NotMatrices>],
        statement: &Statement,
    ) -> Option<Reference> {
        let told_by = |side: &Side| match &side.parts[..] {
            [Part::Text(span)] => told_of_jacobian(&self.lexis.lone_name(self.text, span)?),
            _ => None,
        };
        let is_rates = |grid: &Grid| {
            let mut spans = grid.rows.iter().flatten();
            let is_rate = |s: &str| s.contains("\\dot") || s.contains('̇') || s.ends_with('\'');
            spans.clone().count() > 0 && spans.all(|s| is_rate(self.source(s)))
        };
        let told = statement.sides.iter().find_map(told_by);
        let is_told = told.is_some();
        let grid = read.iter().find_map(|r| match r.as_ref().ok()?.factors.as_deref()? {
            [Factor::Grid(grid)] if is_told => Some(*grid),
            [Factor::Scalar(_), Factor::Grid(grid)] if is_told => Some(*grid),
            [Factor::Grid(grid), Factor::Grid(rates)] if is_rates(rates) => Some(*grid),
            _ => None,
        })?;
        let scale = read.iter().find_map(|r| match r.as_ref().ok()?.factors.as_deref()? {
            [Factor::Scalar(factor), Factor::Grid(_)] => Some(*factor),
            _ => None,
        });
        let scaled = |e: Expr| scale.map_or(e, |factor| factor * e);
        let printed = Matrix(
            self.cells(grid)
                .iter()
                .map(|row| {
                    row.iter()
                        .map(|c| match c {
                            Cell::Formulas(f) => f.first().map(|f| scaled(f.1.value())),
                            _ => None,
                        })
                        .collect()
                })
                .collect(),
        );
        let (rows, columns) = printed.shape()?;
        let joints = self.subject.description.variables().len();
        if !(2..=joints).contains(&columns) && columns != joints || !(2..=6).contains(&rows) {
            return None;
        }
        let mut told = told.unwrap_or_default();
        told.points.extend(frames_told(self.paragraph_before(statement)));
        let (matrix, jacobian) = self.subject.nearest_jacobian(&printed, &told, &self.at)?;
        Some(Reference { matrix, about: Some(Meaning::Jacobian(jacobian)) })
    }

    /// The length of a vector, or its square: `|p_5 - S|^2`, `\|p\|`.
    pub(super) fn norm(&self, span: &Range<usize>) -> Option<Expr> {
        const BARS: [&str; 4] = ["|", "\\|", "\\lVert", "\\Vert"];
        const ENDS: [&str; 4] = ["|", "\\|", "\\rVert", "\\Vert"];
        let source = self.text.get(span.clone())?;
        let (start, bar) = (0..4).find_map(|k| Some((source.strip_prefix(BARS[k])?.len(), k)))?;
        let start = source.len() - start;
        let close = source[start..].find(ENDS[bar])? + start;
        let power: String =
            source[close + ENDS[bar].len()..].chars().filter(|c| !matches!(c, '{' | '}' | ' ')).collect();
        if !matches!(power.as_str(), "" | "^2" | "²") {
            return None;
        }
        let inner = span.start + start..span.start + close;
        let side = Side { span: inner.clone(), parts: vec![Part::Text(inner)] };
        let found = product(self.text, &side, &self.lexis, &self.subject, &|_| None).ok()?;
        let value = found.value.filter(|m| m.shape().is_some_and(|s| s.1 == 1 && s.0 > 1))?;
        let square = value.0.iter().flatten().try_fold(Expr::int(0), |sum, e| Some(sum + (*e)?.powi(2)))?;
        Some(if power.is_empty() { square.sqrt() } else { square })
    }

    /// What a printed matrix is by the robot, where the name beside it says nothing: its value is asked.
    pub(super) fn recognised(
        &self,
        read: &[Result<Product<'_>, NotMatrices>],
        statement: &Statement,
    ) -> Option<Reference> {
        if self.subject.last() == 0 {
            return None;
        }
        let grid = read.iter().find_map(|r| match r.as_ref().ok()?.factors.as_deref()? {
            [Factor::Grid(grid)] if grid.fence != Fence::Bars => Some(*grid),
            _ => None,
        })?;
        let name = match &statement.sides[..] {
            [_] => None,
            [left, ..] => match (&read[0], &left.parts[..]) {
                (Err(NotMatrices::Unknown(name)), _) if self.is_lone(left, name) => Some((**name).clone()),
                (Err(_), [Part::Text(_)]) => None,
                _ => return None,
            },
            [] => return None,
        };
        let printed = self.printed(grid)?;
        if let Some(found) = name.as_ref().and_then(|name| self.screw_named(name, &printed)) {
            return Some(found);
        }
        let is_number = |e: &Option<Expr>| e.is_some_and(|e| e.symbols().is_empty());
        if printed.0.iter().flatten().all(is_number) {
            let (matrix, about) = self.recognised_number(grid, &printed)?;
            return Some(Reference { matrix, about: Some(about) });
        }
        let ((matrix, about), agreement) = nearest(&self.subject, &printed)?;
        let Agreement { telling, agreeing, is_whole } = agreement;
        let base = name.as_ref().map_or("", |n| n.base.as_str());
        let is_place = matches!(base, "p" | "P" | "r" | "d" | "o" | "x" | "X" | "t");
        let is_vector = printed.shape()?.1 == 1;
        let is_hand =
            about == Meaning::Origin(Box::new(Meaning::Frame { of: Tool, seen_from: self.subject.ground() }));
        let is_near = match is_vector {
            true => is_place && is_hand && telling >= 2 && 2 * agreeing >= telling,
            false => {
                matches!(base, "T" | "A" | "H" | "M" | "R") && telling >= 3 && 3 * agreeing >= 2 * telling
            }
        };
        let is_velocity = matches!(base, "ω" | "Ω" | "v" | "V") && matches!(about, Meaning::Velocity { .. });
        let is_place = is_place || is_velocity;
        // A column that is named by its joint, as others before it are.
        let column = |about: &Meaning, sub: &str| match about {
            Meaning::Column(joint, jacobian) => (sub.parse() == Ok(*joint)).then_some(jacobian.order),
            _ => None,
        };
        let own = name.as_ref().filter(|n| n.base == "J").and_then(|n| column(&about, &n.sub));
        let is_column = || {
            let sub =
                |a: &Assertion| a.name.trim_start_matches(['J', '_', '{']).trim_end_matches('}').to_string();
            let others = self.assertions.iter().filter(|a| a.name.starts_with('J'));
            let mut others = others.filter_map(|a| match &a.about {
                About::Matrix(m) => column(m, &sub(a)),
                _ => None,
            });
            own.is_some() && agreeing > 0 && others.any(|o| Some(o) == own)
        };
        // All but one component of a velocity.
        let is_velocity = is_velocity && is_vector && agreeing > 1 && 3 * agreeing >= 2 * telling;
        let is_near = is_near || is_velocity || is_column();
        let is_certain = is_whole && (telling >= 2 || telling == 1 && (is_place || !is_vector));
        (is_certain || is_near).then_some(Reference { matrix, about: Some(about) })
    }

    /// The screw of a joint at rest, `ξ_1 = (0, 0, 0, 0, 0, 1)`, where it is that.
    fn screw_named(&self, name: &Name, printed: &Matrix) -> Option<Reference> {
        let is_screw = matches!(name.base.as_str(), "ξ" | "Ξ" | "S" | "$") && name.left.is_empty();
        let shape = printed.shape().filter(|s| is_screw && matches!(s, (6, 1) | (1, 6)))?;
        let number: usize = name.sub.parse().ok()?;
        let is_same = |(m, about): &(Matrix, Meaning)| {
            let pairs = || m.0.iter().flatten().zip(printed.0.iter().flatten());
            matches!(about, Meaning::Screw { joint, .. } if *joint == number)
                && pairs().all(|(a, b)| matches!((a, b), (Some(a), Some(b)) if equal(*a, *b).is_equal()))
        };
        let (matrix, about) = candidates(&self.subject, shape).into_iter().find(is_same)?;
        Some(Reference { matrix, about: Some(about) })
    }

    /// What a matrix of numbers is by the robot at the present configuration.
    fn recognised_number(&self, grid: &Grid, printed: &Matrix) -> Option<(Matrix, Meaning)> {
        let spans: Vec<&Range<usize>> = grid.rows.iter().flatten().collect();
        let entries: Vec<Expr> = printed.0.iter().flatten().copied().collect::<Option<_>>()?;
        if entries.iter().filter(|e| is_measured(**e)).count() < 2 || spans.len() != entries.len() {
            return None;
        }
        let fits = |(matrix, _): &(Matrix, Meaning)| {
            let wanted = matrix.0.iter().flatten();
            wanted.zip(&entries).zip(&spans).all(|((wanted, printed), span)| {
                let Some(wanted) = wanted.filter(|w| self.at.knows(*w, &self.subject)) else { return false };
                matches!(self.number(None, span, *printed, wanted), Some(Piece::Number { answer, .. })
                    if matches!(judge(&answer, &self.subject, None), Finding::Equal { .. }))
            })
        };
        candidates(&self.subject, printed.shape()?).into_iter().find(fits)
    }

    /// Holds a side against a matrix that is known.
    pub(super) fn compare(
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
                out.whole = Some(reference.matrix.clone());
                self.compare_grid(grid, &reference.matrix, out);
            }
            Some([Factor::Scalar(factor), Factor::Grid(grid)]) if grid.fence != Fence::Bars => {
                out.whole = Some(reference.matrix.clone());
                self.compare_grid(grid, &reference.matrix.divided_by(*factor), out);
            }
            Some([Factor::Grid(grid), Factor::Grid(rates)])
                if reference.about.as_ref().is_some_and(Meaning::begins_with_jacobian)
                    && rates.rows.iter().all(|r| r.len() == 1) =>
            {
                self.compare_grid(grid, &reference.matrix, out);
            }
            Some(factors) if factors.len() > 1 && factors.iter().all(is_grid) => {
                let mut worked = out.clone();
                let is_long = is_too_long(product.value.as_ref());
                if is_long || self.compare_value(product.value.as_ref(), &reference.matrix, span, &mut worked)
                {
                    if is_long {
                        worked.pieces.push(too_long(span));
                    }
                    *out = worked;
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
            _ if is_too_long(product.value.as_ref()) => out.pieces.push(too_long(span)),
            _ => {
                self.compare_value(product.value.as_ref(), &reference.matrix, span, out);
            }
        }
    }

    /// The transforms that printed factors stand for, where their product is known: links next to each other, cut so
    /// that most entries agree.
    pub(super) fn chain(&self, factors: &[Factor<'_>], whole: &Matrix) -> Option<Vec<Matrix>> {
        let mut points = Points::new(7);
        let mut key = |m: &Matrix| -> Vec<Option<[u64; 3]>> {
            m.0.iter().take(3).flatten().map(|e| e.and_then(|e| points.value(e))).collect()
        };
        let n = self.subject.last();
        let size = whole.0.len();
        let form = |x: Transform<Expr>| {
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
            for (i, slot) in best.iter().enumerate().take(to).skip(from) {
                let Some((score, cuts)) = slot.clone() else { continue };
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

    pub(super) fn compare_grid(&self, grid: &Grid, wanted: &Matrix, out: &mut Assertion) {
        let cells = self.cells(grid);
        let width = cells.iter().map(Vec::len).max().unwrap_or(0);
        // `[x, y, z]^T` is a column.
        let is_column = wanted.0.len() > 1 && wanted.0.iter().all(|row| row.len() == 1);
        let turned = (is_column && cells.len() == 1 && width > 1).then(|| wanted.transposed());
        let wanted = turned.as_ref().unwrap_or(wanted);
        let is_number = |cell: &Cell| match cell {
            Cell::Formulas(formulas) => formulas.iter().all(|f| f.1.value().symbols().is_empty()),
            Cell::LeftOut => true,
            _ => false,
        };
        // Numbers between bars are no single entry of a larger matrix.
        if (cells.len(), width) == (1, 1) && wanted.0.iter().map(Vec::len).sum::<usize>() > 1 {
            let errors = vec![Unread::new(grid.span.clone(), Unreadable::NeitherFormulaNorProduct)];
            out.pieces.push(Piece::Unreadable { place: None, span: grid.span.clone(), errors });
            return;
        }
        if cells.len() > wanted.0.len() {
            out.remarks.push(Remark::ManyRows { printed: cells.len(), wanted: wanted.0.len() });
        }
        let depends = wanted.0.iter().flatten().flatten().any(|e| !e.symbols().is_empty());
        let all_numbers = depends && cells.iter().flatten().all(is_number);
        let knows = |e: &Expr| self.at.knows(*e, &self.subject) || self.at.knew(*e, &self.subject);
        let is_numeric = all_numbers && wanted.0.iter().flatten().flatten().all(knows);
        let is_open = all_numbers && !is_numeric;
        // Beside numbers that somebody computed 0 and 1 are such numbers, too.
        let is_computed =
            |cell: &Cell| matches!(cell, Cell::Formulas(f) if f.iter().any(|f| is_measured(f.1.value())));
        let is_worked_out = is_open && cells.iter().flatten().any(is_computed);
        // Zeros and ones alone are the matrix at some configuration, not at all.
        let mut is_bare = is_open && !is_worked_out && width > 1 && cells.len() > 1;
        for (r, row) in cells.iter().enumerate() {
            if row.len() < width {
                let short = ShortRow { row: r + 1, elements: row.len(), width };
                // The last row of a homogeneous matrix says nothing.
                if (r, width) == (3, 4) {
                    out.remarks.push(Remark::ShortRow(short));
                    continue;
                }
                let first = grid.rows[r].first().map_or(grid.span.start, |s| s.start);
                let last = grid.rows[r].last().map_or(grid.span.end, |s| s.end);
                let errors = vec![Unread::new(first..last.max(first), Unreadable::ShortRow(short))];
                out.pieces.push(Piece::Unreadable { place: None, span: first..last.max(first), errors });
                continue;
            }
            for (c, cell) in row.iter().enumerate() {
                let place = Some(if turned.is_some() { (c + 1, r + 1) } else { (r + 1, c + 1) });
                match cell {
                    Cell::LeftOut => {}
                    Cell::Broken(span, errors) => out.pieces.push(Piece::Unreadable {
                        place,
                        span: span.clone(),
                        errors: errors.clone(),
                    }),
                    Cell::Lone(name) => {
                        let span = grid.rows[r][c].clone();
                        let errors = vec![Unread::new(span.clone(), Unreadable::Unknown(name.key()))];
                        out.pieces.push(Piece::Unreadable { place, span, errors });
                    }
                    Cell::Formulas(formulas) => {
                        let Some(wanted) = wanted.entry(r, c) else {
                            if wanted.0.get(r).is_none_or(|row| c >= row.len()) && c < 4 && r < 4 {
                                continue;
                            }
                            out.remarks.push(Remark::Incomparable(r + 1, c + 1));
                            continue;
                        };
                        for (span, syntax) in formulas {
                            // A length or an angle in decimals makes nearly 0 of what is 0.
                            let is_still =
                                all_numbers && wanted.symbols().is_empty() && wanted.as_number().is_none();
                            if is_numeric || is_still {
                                out.pieces.extend(self.number(place, span, syntax.value(), wanted));
                                continue;
                            }
                            if is_open && !is_worked_out && width > 1 && !wanted.symbols().is_empty() {
                                if std::mem::take(&mut is_bare) {
                                    let errors = vec![Unread::new(span.clone(), Unreadable::NoConfiguration)];
                                    out.pieces.push(Piece::Unreadable { place, span: span.clone(), errors });
                                }
                                continue;
                            }
                            if is_worked_out && !is_measured(syntax.value()) && !wanted.symbols().is_empty() {
                                continue;
                            }
                            if is_open && is_measured(syntax.value()) && !wanted.symbols().is_empty() {
                                let errors = vec![Unread::new(span.clone(), Unreadable::NoConfiguration)];
                                out.pieces.push(Piece::Unreadable { place, span: span.clone(), errors });
                                continue;
                            }
                            out.pieces.push(Piece::Pair(Pair {
                                place,
                                span: span.clone(),
                                printed: Some(syntax.clone()),
                                value: syntax.value(),
                                wanted,
                                also: vec![],
                            }));
                        }
                    }
                }
            }
        }
    }

    /// Half a unit of the last digit of a number, in the unit in which it is compared.
    pub(super) fn half(&self, span: &Range<usize>) -> f64 {
        let source = self.source(span);
        let degree = std::f64::consts::PI / 180.0;
        match crate::numbers::unit_behind(source.trim_end_matches([',', '.', ';'])) {
            Some((number, factor, power)) => {
                let factor = self.in_unit(factor, power);
                half_unit(number) * factor.eval(|_| None).unwrap_or(1.0)
            }
            None if source.contains('°') || source.contains("\\circ") => half_unit(source) * degree,
            None => half_unit(source),
        }
    }

    /// The unit that stands behind the marks of a formula, `$\dot\theta_1 = -6.17$ °/s`; 1 where there is none.
    pub(super) fn unit_outside(&self, span: &Range<usize>) -> f64 {
        if crate::numbers::unit_behind(self.source(span)).is_some() {
            return 1.0;
        }
        let rest = self.text.get(span.end..).unwrap_or_default();
        // The unit behind the bracket counts for each of the numbers in it.
        let is_inside = |c: char| c.is_ascii_digit() || ".,;-−+ \t&\\".contains(c);
        let inside = rest.trim_start_matches(is_inside).strip_prefix([')', ']']);
        let rest = inside.unwrap_or(rest);
        let rest = rest.trim_start_matches(['$', ' ', '~', '\\', ',', ';']);
        let rest = ["mathrm{", "text{"].iter().fold(rest, |r, look| r.strip_prefix(look).unwrap_or(r));
        let word = rest
            .split(|c: char| c.is_whitespace() || matches!(c, ',' | ';' | ')' | '}' | '$' | '&'))
            .next()
            .unwrap_or_default();
        if word.is_empty() || word.len() > 12 || rest.len() == self.text.get(span.end..).map_or(0, str::len) {
            return 1.0;
        }
        let number = format!("1{word}");
        match crate::numbers::unit_behind(&number) {
            Some(("1", factor, power)) => {
                let factor = self.in_unit(factor, power);
                factor.eval(|_| None).unwrap_or(1.0)
            }
            _ => 1.0,
        }
    }

    /// What a formula without joints is held against, where its own sentence gives a configuration: at rest `x = l_1 + l_2` is
    /// the place of the hand there.
    pub(super) fn there(&self, span: &Range<usize>, printed: Expr, wanted: Expr) -> Expr {
        let variables = self.subject.description.variables();
        let has_joints = |e: Expr| e.symbols().iter().any(|s| variables.iter().any(|v| v.symbol == *s));
        if has_joints(printed) || !has_joints(wanted) || equal(printed, wanted).is_equal() {
            return wanted;
        }
        let before = &self.text[..span.start];
        let sentence =
            &before[[". ", "\n\n", ":"].iter().filter_map(|end| before.rfind(end)).max().unwrap_or(0)..];
        let is_value = |at: usize| {
            let value = sentence[at + 1..].trim_start_matches([' ', '$', '-', '−', '+']);
            value.starts_with(|c: char| c.is_ascii_digit() || c == 'π') || value.starts_with("\\pi")
        };
        let words = sentence.to_lowercase();
        let is_at_rest = || puts_to_zero(&words);
        let is_told = sentence.match_indices('=').any(|(at, _)| is_value(at)) || is_at_rest();
        let there = self.at.exactly(wanted, &self.subject).filter(|_| is_told);
        there.filter(|&there| equal(printed, there).is_equal()).unwrap_or(wanted)
    }

    /// A number in print against a formula at the present configuration.
    pub(super) fn number(
        &self,
        place: Option<(usize, usize)>,
        span: &Range<usize>,
        printed: Expr,
        wanted: Expr,
    ) -> Option<Piece> {
        let constant = Some(printed);
        let unit = self.unit_outside(span);
        let printed = printed.eval(|_| None).ok()? * unit;
        let half = self.half(span) * unit;
        // `sqrt(14² + 5²) = 14.9 cm`: arithmetic of numbers is in the unit of its result.
        let in_result = || {
            let (number, factor, power) = crate::numbers::unit_behind(self.source(span))?;
            let factor = self.in_unit(factor, power).eval(|_| None).ok().filter(|_| power > 0)?;
            let value = wanted.eval(|_| None).ok().filter(|_| wanted.symbols().is_empty())?;
            let own = half_unit(number);
            ((printed / factor - value).abs() <= 3.0 * own).then_some((printed / factor, own))
        };
        let (printed, half) = in_result().unwrap_or((printed, half));
        let answer = Answer { printed, half, wanted, at: self.at.clone(), constant };
        Some(Piece::Number { place, span: span.clone(), answer })
    }

    /// Holds a matrix that is worked out against one that is known; true if all of it is proved equal. What is equal
    /// is said in one piece, what is not entry by entry.
    pub(super) fn compare_value(
        &self,
        value: Option<&Matrix>,
        wanted: &Matrix,
        span: &Range<usize>,
        out: &mut Assertion,
    ) -> bool {
        let is_entry = |m: &Matrix| m.shape() == Some((1, 1));
        let Some(value) = value.filter(|m| !is_entry(m) || is_entry(wanted)) else { return false };
        let value = match (value.shape(), wanted.shape()) {
            (Some((4, 4)), Some((3, 3))) => &value.rotation_part(),
            _ => value,
        };
        let (mut same, mut different, mut also) = (None, vec![], vec![]);
        for (r, row) in wanted.0.iter().enumerate() {
            for (c, wanted) in row.iter().enumerate() {
                let (Some(value), &Some(wanted)) = (value.entry(r, c), wanted) else { continue };
                let pair =
                    |place| Pair { place, span: span.clone(), printed: None, value, wanted, also: vec![] };
                if equal(value, wanted).is_equal() {
                    also.push([value, wanted]);
                    same = Some(pair(None));
                } else {
                    different.push(pair(Some((r + 1, c + 1))));
                }
            }
        }
        let is_right = different.is_empty() && same.is_some();
        if different.len() > 1 {
            let places = different[1..].iter().filter_map(|p| p.place).collect();
            out.remarks.push(Remark::OthersDiffer(places));
        }
        out.pieces.extend(different.into_iter().take(1).map(Piece::Pair));
        out.pieces.extend(same.filter(|_| is_right).map(|pair| Piece::Pair(Pair { also, ..pair })));
        is_right
    }
}

/// The longest product of matrices that is worked out, in literals of its longest entry.
const MAX_PRODUCT: u64 = 2_000_000;

/// True for a product that nobody works out.
fn is_too_long(value: Option<&Matrix>) -> bool {
    value.is_some_and(|m| m.0.iter().flatten().flatten().any(|&e| literals(e) > MAX_PRODUCT))
}

fn too_long(span: &Range<usize>) -> Piece {
    let errors = vec![Unread::new(span.clone(), Unreadable::LongProduct)];
    Piece::Unreadable { place: None, span: span.clone(), errors }
}
