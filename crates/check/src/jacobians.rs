//! Jacobians that people print: which rows, of which point, along whose axes; their determinants, and the velocities and torques
//! that follow of them.

use super::facts::Jacobian;
use super::matrix::Matrix;
use super::names::Name;
use super::numbers::Configuration;
use super::subject::Subject;
use denavit::description::JointKind;
use denavit::forward::Reference;
use denavit_reading::slip::{Points, Value};
use denavit_symbolic::factor::factored;
use denavit_symbolic::readable::simplify;
use denavit_symbolic::{Expr, Node, Rational, Symbol, equal};
use rustc_hash::FxHashMap;

/// Which rows the name of a Jacobian tells.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(super) enum Part {
    /// Any.
    #[default]
    Any,
    /// `J_v`, `J_P`
    Linear,
    /// `J_ω`, `J_O`
    Angular,
}

/// What the name of a Jacobian tells.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(super) struct Told {
    pub part: Part,
    /// Of the origin of this frame.
    pub frame: Option<usize>,
    /// Along the axes of this frame.
    pub axes: Option<usize>,
    /// The words before it speak of these frames: the point of the hand may be at the origin of one.
    pub points: Vec<usize>,
    /// Its indices name something that is no frame: only what it is wholly is it.
    pub is_foreign: bool,
}

/// The rows of a full Jacobian, as they may be named: linear first, angular first.
const FULL: [[u8; 6]; 2] = [[0, 1, 2, 3, 4, 5], [3, 4, 5, 0, 1, 2]];

/// A body, the frame at whose origin its point is, the axes, and the full Jacobian.
type View = (Reference, Option<usize>, Reference, Vec<Vec<Expr>>);

impl Subject {
    /// Of the Jacobians that people print, the one that agrees with a matrix in most entries, its rows in any order.
    pub fn nearest_jacobian(
        &self,
        printed: &Matrix,
        told: &Told,
        at: &Configuration,
    ) -> Option<(Matrix, Jacobian)> {
        let (rows, columns) = printed.shape()?;
        if (2..self.joints().len()).contains(&columns) {
            return self.jacobian_of_first_joints(printed, told);
        }
        if rows > 6 || columns != self.joints().len() {
            return None;
        }
        if let Some(found) = self.jacobian_in_numbers(printed, told, at) {
            return Some(found);
        }
        let mut points = Points::new(7);
        let mut value = |e: &Option<Expr>| e.and_then(|e| points.value(e));
        let wanted: Vec<Vec<Option<Value>>> =
            printed.0.iter().map(|row| row.iter().map(&mut value).collect()).collect();
        let mut best: Option<(usize, Jacobian, Matrix)> = None;
        for (body, at, axes, full) in self.views(told) {
            let own: Vec<Vec<Option<Value>>> =
                full.iter().map(|row| row.iter().map(|&e| points.value(e)).collect()).collect();
            // What is not 0 tells more.
            let zero = points.value(Expr::int(0));
            let agreement = |r: usize, k: usize| -> usize {
                let pairs = wanted[r].iter().zip(&own[k]).filter(|(a, b)| a.is_some() && a == b);
                pairs.map(|(a, _)| if *a == zero { 1 } else { 3 }).sum()
            };
            for order in orders(rows, told.part, &agreement) {
                let total: usize = (0..rows).map(|r| agreement(r, usize::from(order[r]))).sum();
                if best.as_ref().is_none_or(|b| total > b.0) {
                    let is_angular_first = rows > 3 && order[0] == 3;
                    let jacobian = Jacobian { body, at, axes, is_angular_first, rows, order };
                    let row = |k: &u8| full[usize::from(*k)].iter().map(|&e| Some(e)).collect();
                    best = Some((total, jacobian, Matrix(order[..rows].iter().map(row).collect())));
                }
            }
        }
        let (_, about, matrix) = best?;
        let agrees = |r: usize, c: usize| {
            let (Some(a), Some(b)) = (printed.entry(r, c), matrix.entry(r, c)) else { return false };
            equal(a, b).is_equal()
        };
        let is_whole = || (0..rows).all(|r| (0..columns).all(|c| agrees(r, c)));
        (!told.is_foreign || is_whole()).then_some((matrix, about))
    }

    /// That of a point which the first joints alone move, as the wrist centre, if most of the matrix agrees with it.
    fn jacobian_of_first_joints(&self, printed: &Matrix, told: &Told) -> Option<(Matrix, Jacobian)> {
        let (rows, columns) = printed.shape().filter(|s| (2..=3).contains(&s.0))?;
        let axes = told.axes.filter(|k| *k <= self.last()).map_or_else(|| self.ground(), Reference::Frame);
        let mut best: Option<(usize, Reference, Vec<Vec<Expr>>)> = None;
        let bodies = (columns..=self.last()).map(Reference::Frame).chain([Reference::Tool]);
        for body in bodies {
            let full = self.geometric_rows(body, axes);
            let still = |e: &Expr| e.is_zero() || equal(*e, Expr::int(0)).is_equal();
            if !full[..3].iter().all(|row| row[columns..].iter().all(still)) {
                continue;
            }
            let agrees = |&(r, c): &(usize, usize)| {
                let entry = printed.entry(r, c).filter(|e| !e.is_zero());
                entry.is_some_and(|e| equal(e, full[r][c]).is_equal())
            };
            let count = (0..rows).flat_map(|r| (0..columns).map(move |c| (r, c))).filter(agrees).count();
            if best.as_ref().is_none_or(|b| count > b.0) {
                best = Some((count, body, full));
            }
        }
        let (count, body, full) = best?;
        let told = printed.0.iter().flatten().flatten().filter(|e| !e.is_zero()).count();
        if 2 * count <= told {
            return None;
        }
        let rows_of = |r: &Vec<Expr>| r[..columns].iter().map(|e| Some(*e)).collect();
        let matrix = Matrix(full[..rows].iter().map(rows_of).collect());
        let order = [0, 1, 2, 3, 4, 5];
        Some((matrix, Jacobian { body, at: None, axes, is_angular_first: false, rows, order }))
    }

    /// The columns of some joints of the Jacobian of the hand, in the order of rows that agrees most with the printed ones.
    pub fn jacobian_of_joints(
        &self,
        printed: &Matrix,
        joints: &[usize],
        part: Part,
    ) -> Option<(Matrix, Jacobian)> {
        let (rows, columns) = printed.shape().filter(|s| s.0 <= 6)?;
        if columns != joints.len() || joints.iter().any(|&k| k >= self.joints().len()) {
            return None;
        }
        let axes = self.ground();
        let full = self.geometric_rows(Reference::Tool, axes);
        let mut points = Points::new(7);
        let zero = points.value(Expr::int(0));
        let mut value = |e: Option<Expr>| e.and_then(|e| points.value(e));
        let wanted: Vec<Vec<Option<Value>>> =
            printed.0.iter().map(|row| row.iter().map(|e| value(*e)).collect()).collect();
        let own: Vec<Vec<Option<Value>>> =
            full.iter().map(|row| joints.iter().map(|&k| value(Some(row[k]))).collect()).collect();
        let agreement = |r: usize, k: usize| -> usize {
            let pairs = wanted[r].iter().zip(&own[k]).filter(|(a, b)| a.is_some() && a == b);
            pairs.map(|(a, _)| if *a == zero { 1 } else { 3 }).sum()
        };
        let order = matched(rows, part, &agreement)?;
        let row = |k: &u8| joints.iter().map(|&c| Some(full[usize::from(*k)][c])).collect();
        let matrix = Matrix(order[..rows].iter().map(row).collect());
        let body = Reference::Tool;
        Some((matrix, Jacobian { body, at: None, axes, is_angular_first: false, rows, order }))
    }

    /// Numbers agree with no formula: they are those of the Jacobian that the arm has by nature, if it has as many rows.
    fn jacobian_in_numbers(
        &self,
        printed: &Matrix,
        told: &Told,
        at: &Configuration,
    ) -> Option<(Matrix, Jacobian)> {
        let is_number = |e: &Option<Expr>| e.is_some_and(|e| e.symbols().is_empty());
        if !printed.0.iter().flatten().all(is_number) || told.frame.is_some() || told.axes.is_some() {
            return None;
        }
        let axes = self.ground();
        if printed.0.len() == 6 {
            return self.full_jacobian_in_numbers(printed, told, at);
        }
        let task = self.task(told.part).filter(|t| t.len() == printed.0.len())?;
        let mut order = [0; 6];
        order.iter_mut().zip(&task).for_each(|(o, &r)| *o = u8::try_from(r).unwrap_or_default());
        let rows = task.len();
        let jacobian =
            Jacobian { body: Reference::Tool, at: None, axes, is_angular_first: false, rows, order };
        Some((self.square_jacobian(told.part)?, jacobian))
    }

    /// All six rows, of the point and along the axes with which most numbers agree at the configuration, those of the hand along
    /// the axes of the base before others.
    fn full_jacobian_in_numbers(
        &self,
        printed: &Matrix,
        told: &Told,
        at: &Configuration,
    ) -> Option<(Matrix, Jacobian)> {
        /// Coarser numbers tell nothing.
        const NEAR: f64 = 5e-3;
        let numbers: Vec<Vec<f64>> = printed
            .0
            .iter()
            .map(|row| {
                row.iter().map(|e| e.and_then(|e| e.eval(|_| None).ok()).unwrap_or(f64::NAN)).collect()
            })
            .collect();
        let mut best: Option<(usize, Jacobian, Matrix)> = None;
        for (body, point, axes, full) in self.views(told) {
            let own: Vec<Vec<Option<f64>>> =
                full.iter().map(|row| row.iter().map(|&e| at.number(e, self)).collect()).collect();
            for (order, is_angular_first) in FULL.into_iter().zip([false, true]) {
                let agrees = |r: usize, c: usize| {
                    let x = own[usize::from(order[r])][c];
                    x.is_some_and(|x| (x - numbers[r][c]).abs() <= NEAR * (1.0 + x.abs()))
                };
                let total = (0..6).map(|r| (0..numbers[r].len()).filter(|&c| agrees(r, c)).count()).sum();
                if best.as_ref().is_none_or(|b| total > b.0) {
                    let jacobian = Jacobian { body, at: point, axes, is_angular_first, rows: 6, order };
                    let row = |k: &u8| full[usize::from(*k)].iter().map(|&e| Some(e)).collect();
                    best = Some((total, jacobian, Matrix(order.iter().map(row).collect())));
                }
            }
        }
        best.map(|(_, jacobian, matrix)| (matrix, jacobian))
    }

    /// Full Jacobians of the points and along the axes that a name may mean, the usual ones first.
    fn views(&self, told: &Told) -> Vec<View> {
        let n = self.last();
        let bodies = match told.frame {
            Some(k) if k < n => vec![Reference::Frame(k)],
            _ => vec![Reference::Tool, Reference::Frame(n)],
        };
        let axes: Vec<Reference> = match told.axes {
            Some(k) if k <= n => vec![Reference::Frame(k)],
            _ => {
                let ground = Some(self.ground()).filter(|g| *g == Reference::Base);
                ground.into_iter().chain((0..=n).map(Reference::Frame)).chain([Reference::Tool]).collect()
            }
        };
        let views = bodies.iter().flat_map(|&body| axes.iter().map(move |&along| (body, along)));
        let mut found: Vec<_> =
            views.map(|(body, along)| (body, None, along, self.geometric_rows(body, along))).collect();
        if self.is_printed() {
            found.extend(self.differentiated().map(|j| (Reference::Tool, None, Reference::Frame(0), j)));
            return found;
        }
        for &k in told.points.iter().filter(|k| **k < n) {
            found.extend(axes.iter().map(|&along| {
                (Reference::Tool, Some(k), along, self.geometric_rows_at(Reference::Frame(k), along))
            }));
        }
        found
    }

    /// The rows of a square Jacobian that the arm has by nature: all that do not vanish, or the linear or the angular ones.
    pub fn task(&self, part: Part) -> Option<Vec<usize>> {
        let n = self.joints().len();
        let j = self.geometric_rows(Reference::Tool, self.ground());
        let mut points = Points::new(7);
        let zero = points.value(Expr::int(0));
        let moving: Vec<usize> = (0..6).filter(|&r| j[r].iter().any(|&e| points.value(e) != zero)).collect();
        let among = |rows: std::ops::Range<usize>| -> Vec<usize> {
            moving.iter().copied().filter(|r| rows.contains(r)).collect()
        };
        let candidates = match part {
            Part::Any => vec![moving.clone(), among(0..3), among(3..6)],
            Part::Linear => vec![among(0..3)],
            Part::Angular => vec![among(3..6)],
        };
        candidates.into_iter().find(|rows| rows.len() == n)
    }

    /// The square Jacobian that the arm has by nature, along the axes of frame 0.
    pub fn square_jacobian(&self, part: Part) -> Option<Matrix> {
        let j = self.geometric_rows(Reference::Tool, self.ground());
        let rows = self.task(part)?;
        Some(Matrix(rows.iter().map(|&r| j[r].iter().map(|&e| Some(e)).collect()).collect()))
    }

    /// The determinant of the Jacobian that the arm has by nature.
    pub fn determinant(&self, part: Part) -> Option<Expr> {
        if let Some((_, known)) = self.determinants.0.borrow().iter().find(|d| d.0 == part as usize) {
            return *known;
        }
        let found = self.worked_out(part);
        self.determinants.0.borrow_mut().push((part as usize, found));
        found
    }

    /// True if the place of the hand is what its joints are for: with three at most, it tells them.
    pub fn is_for_places(&self) -> bool {
        let is_zero = |d: Expr| equal(d, Expr::int(0)).is_equal();
        self.joints().len() <= 3 && self.determinant(Part::Linear).is_some_and(|d| !is_zero(d))
    }

    /// What a determinant that does not vanish everywhere becomes where a joint has a value, if it vanishes there.
    pub fn singular_at(&self, joint: Symbol, value: Expr) -> Option<Expr> {
        let at = |e: Expr| e.substitute(|s| (s == joint).then_some(value));
        self.determinants().into_iter().map(at).find(|e| equal(*e, Expr::int(0)).is_equal())
    }

    /// The determinants of the whole Jacobian and of its linear rows, but for those that vanish everywhere; that of the angular
    /// rows where these are none, as of a wrist.
    pub fn determinants(&self) -> Vec<Expr> {
        let found = |part| self.determinant(part).filter(|d| !equal(*d, Expr::int(0)).is_equal());
        let of_places: Vec<Expr> = [Part::Any, Part::Linear].into_iter().filter_map(found).collect();
        if of_places.is_empty() { found(Part::Angular).into_iter().collect() } else { of_places }
    }

    /// A formula that is zero only where the arm is singular, as it divides the determinant: the formula times what does not
    /// move, and the factor of the determinant that it is.
    pub fn singular_where(&self, formula: Expr) -> Option<[Expr; 2]> {
        /// Configurations that are tried: joints at one of four places each.
        const MAX_MOVING: usize = 4;
        let variables = self.description.variables();
        let moving = |e: Expr| -> Vec<Symbol> {
            let symbols = e.symbols();
            variables.iter().map(|v| v.symbol).filter(|s| symbols.contains(s)).collect()
        };
        let of = moving(formula);
        if of.is_empty() || of.len() > MAX_MOVING {
            return None;
        }
        // What two proportional formulas have for a ratio is known from one configuration where they are not zero.
        let at = |e: Expr, number: usize| {
            e.substitute(|s| {
                let place = of.iter().position(|o| *o == s)?;
                let step = [0, 1, 3, 2][number >> (2 * place) & 3];
                let slides = variables.iter().any(|v| v.symbol == s && v.kind == JointKind::Prismatic);
                let quarter = Expr::pi() * Expr::from(Rational::new(step, 4));
                Some(if slides { Expr::int(step + 1) } else { quarter })
            })
        };
        let is_zero = |e: Expr| equal(e, Expr::int(0)).is_equal();
        let known = self.determinants();
        let factors = known.iter().filter_map(|d| factored(*d, &d.symbols()).ok()).flat_map(|f| f.factors);
        let candidates: Vec<Expr> = factors.map(|f| f.0).chain(known.iter().copied()).collect();
        candidates.into_iter().filter(|f| moving(*f) == of).find_map(|factor| {
            let number = (0..1 << (2 * of.len())).find(|&k| !is_zero(at(formula, k)))?;
            let ratio = at(factor, number) / at(formula, number);
            let scaled = formula * ratio;
            (!is_zero(ratio) && equal(scaled, factor).is_equal()).then_some([scaled, factor])
        })
    }

    /// The determinant of the linear rows without the joints that do not move the hand's point.
    fn of_moving_joints(&self) -> Option<Expr> {
        let j = self.geometric_rows(Reference::Tool, self.ground());
        let mut points = Points::new(7);
        let zero = points.value(Expr::int(0));
        let mut moves = |r: usize, k: usize| points.value(j[r][k]) != zero;
        let n = self.joints().len();
        let rows: Vec<usize> = (0..3).filter(|&r| (0..n).any(|k| moves(r, k))).collect();
        let columns: Vec<usize> = (0..n).filter(|&k| rows.iter().any(|&r| moves(r, k))).collect();
        if rows.len() != columns.len() || columns.len() == n {
            return None;
        }
        let row = |&r: &usize| columns.iter().map(|&k| Some(j[r][k])).collect();
        Matrix(rows.iter().map(row).collect()).determinant()
    }

    fn worked_out(&self, part: Part) -> Option<Expr> {
        let Some(rows) = self.task(part) else {
            return self.of_moving_joints().filter(|_| part != Part::Angular);
        };
        // Along which axes it is written does not matter for blocks that turn together; the middle is short.
        let is_whole = |block: [usize; 3]| {
            let count = block.iter().filter(|r| rows.contains(r)).count();
            count == 0 || count == 3
        };
        let turns = is_whole([0, 1, 2]) && is_whole([3, 4, 5]) && !self.is_printed();
        let axes = if turns { self.last().div_ceil(2) } else { 0 };
        let body = if turns && rows.len() == 6 { Reference::Frame(self.last()) } else { Reference::Tool };
        let j = self.geometric_rows(body, Reference::Frame(axes));
        let entry = |e: Expr| simplify(e, &e.symbols()).map_or(e, |s| s.expr);
        Matrix(rows.iter().map(|&r| j[r].iter().map(|&e| Some(entry(e))).collect()).collect()).determinant()
    }

    /// The symbols of the joints' rates.
    pub fn rates(&self) -> Vec<Expr> {
        let variables = self.description.variables();
        variables.iter().map(|v| Expr::symbol(&format!("rate of {}", v.symbol.name()))).collect()
    }

    /// The linear and angular velocity of the hand along the axes of frame 0, in the joints' rates.
    pub fn velocity(&self) -> Vec<Expr> {
        let (j, rates) = (self.geometric_rows(Reference::Tool, self.ground()), self.rates());
        let row = |row: &Vec<Expr>| row.iter().zip(&rates).fold(Expr::int(0), |sum, (&e, &r)| sum + e * r);
        j.iter().map(row).collect()
    }

    /// The torques and forces of the joints that a load on the hand takes: force and moment along the axes of frame 0.
    pub fn torques(&self, load: &[Expr; 6]) -> Vec<Expr> {
        let j = self.geometric_rows(Reference::Tool, self.ground());
        let of = |k: usize| (0..6).fold(Expr::int(0), |sum, r| sum + j[r][k] * load[r]);
        (0..self.joints().len()).map(of).collect()
    }

    /// The linear rows by the derivatives of the hand's position, the angular ones as they are, where the author's own pose
    /// stands for the arm's.
    fn differentiated(&self) -> Option<Vec<Vec<Expr>>> {
        let position = self.pose().translation.0;
        let mut j = self.geometric_rows(Reference::Tool, self.ground());
        for (r, &p) in position.iter().enumerate() {
            for (k, &q) in self.joints().iter().enumerate() {
                j[r][k] = derivative(p, q)?;
            }
        }
        Some(j)
    }
}

/// The orders of rows in which a Jacobian of so many rows may be printed.
fn orders(rows: usize, part: Part, agreement: &dyn Fn(usize, usize) -> usize) -> Vec<[u8; 6]> {
    let mut found: Vec<[u8; 6]> = match part {
        Part::Any if rows == 6 => FULL.to_vec(),
        Part::Any => vec![FULL[0]],
        Part::Linear => vec![FULL[0]],
        Part::Angular => vec![FULL[1]],
    };
    if rows < 6 {
        found.extend(matched(rows, part, agreement));
    }
    found
}

/// Each printed row beside the row of the full Jacobian that it agrees with most, none twice.
fn matched(rows: usize, part: Part, agreement: &dyn Fn(usize, usize) -> usize) -> Option<[u8; 6]> {
    let allowed = match part {
        Part::Any => 0..6,
        Part::Linear => 0..3,
        Part::Angular => 3..6,
    };
    let mut pairs: Vec<(usize, usize, usize)> =
        (0..rows).flat_map(|r| allowed.clone().map(move |k| (agreement(r, k), r, k))).collect();
    pairs.sort_by(|a, b| b.0.cmp(&a.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
    let mut order = [u8::MAX; 6];
    for (_, r, k) in pairs {
        if order[r] == u8::MAX && !order.contains(&(k as u8)) {
            order[r] = k as u8;
        }
    }
    let mut rest = (0..6).filter(|k| !order.contains(k)).collect::<Vec<u8>>().into_iter();
    order.iter_mut().filter(|k| **k == u8::MAX).for_each(|k| *k = rest.next().unwrap_or(0));
    Some(order)
}

/// The derivative of a formula by a symbol; nothing where it is no polynomial of sines and cosines.
pub(super) fn derivative(e: Expr, by: Expr) -> Option<Expr> {
    let zero = Expr::int(0);
    let mut known: FxHashMap<Expr, Expr> = FxHashMap::default();
    for part in Expr::postorder(&[e]) {
        let of = |a: &Expr| known.get(a).copied();
        let found = match part.node() {
            Node::Number(_) | Node::Pi => zero,
            Node::Symbol(_) => Expr::int(i64::from(part == by)),
            Node::Neg(a) => -of(&a)?,
            Node::Add(a, b) => of(&a)? + of(&b)?,
            Node::Sub(a, b) => of(&a)? - of(&b)?,
            Node::Mul(a, b) => of(&a)? * b + a * of(&b)?,
            Node::Div(a, b) => (of(&a)? * b - a * of(&b)?) / b.powi(2),
            Node::Pow(a, n) => Expr::int(i64::from(n)) * a.powi(n - 1) * of(&a)?,
            Node::Sin(a) => a.cos() * of(&a)?,
            Node::Cos(a) => -a.sin() * of(&a)?,
            Node::Sqrt(_) | Node::Atan2(..) | Node::Sign(_) => return None,
        };
        known.insert(part, found);
    }
    known.get(&e).copied()
}

/// What the name of a Jacobian tells; nothing for other names.
pub(super) fn told_of_jacobian(name: &Name) -> Option<Told> {
    matches!(name.base.as_str(), "J" | "Jacobian").then(|| told(name))
}

/// The numbers of frames that words speak of: `the origin of frame 5`, `O_4`.
pub(super) fn frames_told(words: &str) -> Vec<usize> {
    const FRAMES: [&str; 12] = [
        "frame",
        "origin",
        "repère",
        "system",
        "systems",
        "koordinatensystem",
        "koordinatensystems",
        "koordinatensysteme",
        "sistema",
        "marco",
        "terna",
        "o",
    ];
    let plain = words.replace(['_', '{', '}', '$', '\\'], "");
    let words: Vec<&str> = plain.split(|c: char| !c.is_alphanumeric()).filter(|w| !w.is_empty()).collect();
    let number = |w: &str| w.parse::<usize>().ok().filter(|_| w.len() <= 2);
    let named = words.windows(2).filter(|w| FRAMES.contains(&w[0].to_lowercase().as_str()));
    let origins = words.iter().filter_map(|w| number(w.strip_prefix(['O', 'o'])?));
    named.filter_map(|w| number(w[1])).chain(origins).collect()
}

/// What the indices of a Jacobian tell.
pub(super) fn told(name: &Name) -> Told {
    let sub = name.sub.to_lowercase();
    let letters: String = sub.chars().filter(|c| c.is_alphabetic()).collect();
    // `J_A` is the analytic one, `J_W` that of a point W.
    let letters = if matches!(name.sub.as_str(), "A" | "W") { String::new() } else { letters };
    let part = match letters.as_str() {
        "v" | "p" | "l" | "lin" | "t" => Part::Linear,
        "ω" | "w" | "o" | "a" | "ang" | "omega" | "r" => Part::Angular,
        _ => Part::Any,
    };
    let number = |text: &str| text.chars().filter(char::is_ascii_digit).collect::<String>().parse().ok();
    let frame = (!letters.is_empty()).then(|| number(&sub)).flatten();
    let axes = number(&name.left).or_else(|| number(&name.sup));
    // The spatial Jacobian is that of the point at the origin of the base.
    let is_spatial = [&name.left, &name.sup, &name.sub].iter().any(|i| *i == "s");
    // `J_v^{ψ}`
    let is_known = |c: char| c.is_ascii_digit() || "TtsbewBEWHRO+-−∗*'†#".contains(c);
    let is_foreign = [&name.left, &name.sup].into_iter().any(|i| !i.chars().all(is_known));
    Told { part, frame, axes, points: if is_spatial { vec![0] } else { vec![] }, is_foreign }
}
