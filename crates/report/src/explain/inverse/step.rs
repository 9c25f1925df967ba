//! One step: from where its equation comes, of which type it is, its solution, what can go wrong.

use super::names::Names;
use super::origin::Matrices;
use super::prove::{Prover, identity};
use super::reading::{Reading, negated};
use crate::document::{Math, Proof, Sign};
use crate::explained::{Bound, Case, Consequence, Explained, Kind, Remark, Source, Statement};
use crate::product::times;
use denavit::inverse::Label;
use denavit::inverse::derivation::{Determinant, Elimination, Form, Norm, Origin, Row, Samples, Step};
use denavit_symbolic::poly::{Monomial, Poly};
use denavit_symbolic::{Expr, Rational};

/// What explaining a step needs.
pub struct Context<'a> {
    pub reading: &'a Reading<'a>,
    pub matrices: &'a Matrices<'a>,
    pub names: &'a Names,
    pub prover: &'a Prover,
    /// Names for coefficients that are not taken.
    pub letters: [Expr; 5],
    /// R and Δ.
    pub helpers: [Expr; 2],
    /// The number of the last equation.
    pub equations: usize,
    /// The number of the last sign.
    pub signs: usize,
}

/// Literals up to which coefficients are put into a solution.
const SHORT: u64 = 14;

impl Context<'_> {
    fn numbered(&mut self, left: Expr, right: Expr) -> Statement {
        self.equations += 1;
        let proof = Some(self.prover.equation(left, right));
        Statement { math: Math::equation(left, right), number: Some(self.equations), proof }
    }

    /// Explains step `i`.
    pub fn explain(&mut self, i: usize, step: &Step, label: Option<Label>) -> Explained {
        let (unknown, meaning) = self.reading.name(step.unknown);
        let sources = self.sources(i, step);
        let mut done = Explained {
            unknown,
            meaning,
            values: usize::from(step.cost.roots),
            elimination: self.elimination(step),
            sources,
            names: vec![],
            kind: kind(&step.form),
            form: vec![],
            coefficients: vec![],
            solution: vec![],
            conditions: vec![],
            label,
            sign: (step.cost.roots > 1).then(|| {
                self.signs += 1;
                Expr::symbol(&format!("κ{}", self.signs))
            }),
            used_by: vec![],
            remark: remark(step),
        };
        match &step.form {
            Form::Ratio { numerator, denominator } => self.ratio(i, numerator, denominator, &mut done),
            Form::Quadratic { a, b, c } => self.quadratic(i, a, b, c, &mut done),
            Form::Quartic(all) => self.quartic(i, step, all, &mut done),
            Form::Line => self.line(i, step, &mut done),
            Form::Sincos => self.sincos(i, step, &mut done),
            Form::Pair { determinant } => self.pair(i, step, *determinant, &mut done),
        }
        let introduced = self.names.introduced(self.reading);
        done.names = introduced
            .into_iter()
            .map(|(n, e)| Statement { math: Math::equation(n, e), number: None, proof: None })
            .collect();
        done
    }

    fn known(&self, i: usize, p: &Poly) -> Expr {
        self.names.expr(self.reading, p, 2 + i)
    }

    fn sum(&self, i: usize, n: &Norm) -> Expr {
        self.names.norm(self.reading, n, 2 + i)
    }

    /// −n, what is squared behind the rest.
    fn negative(&self, i: usize, n: &Norm) -> Expr {
        let rest = self.sum(i, &negated(&n.plus).into());
        n.squares.iter().fold(rest, |sum, p| sum - self.known(i, p).powi(2))
    }

    /// Cosine and sine of the unknown.
    fn pair_of(&self, step: &Step) -> (Expr, Expr) {
        let angle = self.reading.chain.unknown_expr(step.unknown);
        (angle.cos(), angle.sin())
    }

    /// The equations as they stand in products of matrices.
    fn sources(&mut self, i: usize, step: &Step) -> Vec<Source> {
        let mut origins: Vec<&Origin> = vec![];
        for origin in &step.origins {
            match origin {
                Origin::Eliminated { from, .. } => origins.extend(from.iter()),
                other => origins.push(other),
            }
        }
        let mut found: Vec<Source> = vec![];
        for origin in origins {
            let (cut, squared) = match origin {
                Origin::Entry(source) => (self.matrices.entry(*source), false),
                Origin::Squares { left, right, components } => {
                    (self.matrices.squares(*left, *right, components), true)
                }
                Origin::Eliminated { .. } => (None, false),
            };
            let Some(cut) = cut else { continue };
            let equations: Vec<Statement> = cut
                .sides
                .iter()
                .map(|(pose, chain)| {
                    let (left, right) = (self.raw(i, pose), self.raw(i, chain));
                    self.numbered(left, right)
                })
                .collect();
            let product = self.matrices.sides(&cut);
            let why = self.matrices.why_short(&cut);
            let elements = cut.rows.iter().map(|r| (r + 1, cut.column + 1));
            let same =
                |s: &&mut Source| !squared && !s.squared && s.inverse == cut.inverse && s.product == product;
            if let Some(s) = found.iter_mut().find(same) {
                s.elements.extend(elements);
                s.equations.extend(equations);
                if s.why != why {
                    s.why = None;
                }
                continue;
            }
            found.push(Source {
                elements: elements.collect(),
                product,
                inverse: cut.inverse,
                squared,
                why,
                equations,
            });
        }
        found
    }

    /// A side of an equation with the names that are already said.
    fn raw(&self, i: usize, p: &Poly) -> Expr {
        self.names.expr(self.reading, p, 2 + i)
    }

    fn elimination(&self, step: &Step) -> Option<(Expr, Elimination)> {
        let Origin::Eliminated { unknown, how, .. } = step.origins.first()? else { return None };
        let (name, meaning) = self.reading.name(*unknown);
        Some((meaning.unwrap_or(name), *how))
    }

    fn ratio(&mut self, i: usize, numerator: &Poly, denominator: &Poly, done: &mut Explained) {
        let [a, b, ..] = self.letters;
        done.form = vec![Math::equation(a * done.unknown, b)];
        let r = done.meaning.unwrap_or(done.unknown);
        let (mut n, mut d) = (self.known(i, numerator), self.known(i, denominator));
        if unsigned(d) != d {
            (n, d) = (self.known(i, &negated(numerator)), -d);
        }
        done.solution.push(Statement {
            proof: Some(self.prover.equation(d * r, n)),
            ..self.plain(done.unknown, n / d)
        });
        if self.reading.rank_of(denominator) > 0 {
            done.conditions.push(Case {
                when: vec![Math::equation(unsigned(d), Expr::int(0))],
                then: Consequence::OpenDisplacement,
            });
        }
    }

    fn plain(&self, left: Expr, right: Expr) -> Statement {
        Statement { math: Math::equation(left, right), number: None, proof: None }
    }

    fn quadratic(&mut self, i: usize, a: &Poly, b: &Poly, c: &Norm, done: &mut Explained) {
        let [la, lb, lc, ..] = self.letters;
        let r = done.unknown;
        let zero = Expr::int(0);
        done.form = vec![Math::equation(la * r.powi(2) + Expr::int(2) * lb * r + lc, zero)];
        let (a, b, c) = (self.known(i, a), self.known(i, b), self.sum(i, c));
        let value = done.meaning.unwrap_or(r);
        let proof = Some(self.prover.equation(a * value.powi(2) + Expr::int(2) * b * value + c, zero));
        let sign = done.sign.unwrap_or(Expr::int(1));
        if a.is_one() {
            done.coefficients = vec![self.plain(lb, b), self.plain(lc, c)];
            done.form = vec![Math::equation(r.powi(2) + Expr::int(2) * lb * r + lc, zero)];
            let root = (lb.powi(2) - lc).sqrt();
            let formula = if b.is_zero() { sign * (-c).sqrt() } else { sign * root - lb };
            if b.is_zero() {
                done.form = vec![Math::equation(r.powi(2), -c)];
                done.coefficients.clear();
            }
            done.solution = vec![Statement { proof, ..self.plain(r, formula) }];
        } else {
            done.coefficients = vec![self.plain(la, a), self.plain(lb, b), self.plain(lc, c)];
            done.solution =
                vec![Statement { proof, ..self.plain(r, (sign * (lb.powi(2) - la * lc).sqrt() - lb) / la) }];
        }
        let inside =
            if b.is_zero() && a.is_one() { -c } else { lb.powi(2) - if a.is_one() { lc } else { la * lc } };
        done.conditions = vec![
            Case {
                when: vec![Math::relation(inside, Sign::Less, zero)],
                then: Consequence::NoSolution(Bound::Reach),
            },
            Case { when: vec![Math::equation(inside, zero)], then: Consequence::Coincide },
        ];
    }

    fn quartic(&mut self, i: usize, step: &Step, all: &[Norm; 5], done: &mut Explained) {
        let (c, s) = self.pair_of(step);
        let [a, b, d, e, g] = self.letters;
        let name = done.unknown;
        let (cn, sn) = (c, s);
        let zero = Expr::int(0);
        let form =
            |[a, b, d, e, g]: [Expr; 5], c: Expr, s: Expr| a * c.powi(2) + b * c * s + d * c + e * s + g;
        let values: [Expr; 5] = all.each_ref().map(|n| self.sum(i, n));
        // Letters of coefficients that are there.
        let letters: [Expr; 5] =
            std::array::from_fn(|k| if values[k].is_zero() { zero } else { self.letters[k] });
        done.form = vec![Math::equation(form(letters, cn, sn), zero)];
        done.coefficients = [a, b, d, e, g]
            .into_iter()
            .zip(values)
            .filter(|(_, v)| !v.is_zero())
            .map(|(l, v)| self.plain(l, v))
            .collect();
        self.equations += 1;
        let proof = Some(self.prover.equation(form(values, c, s), zero));
        done.solution.push(Statement { math: done.form[0].clone(), number: Some(self.equations), proof });
        let t = Expr::symbol("t");
        let two = Expr::int(2);
        let [a, b, d, e, g] = letters;
        let quartic = (a - d + g) * t.powi(4)
            + two * (e - b) * t.powi(3)
            + two * (g - a) * t.powi(2)
            + two * (e + b) * t
            + (a + d + g);
        let one = Expr::int(1);
        let half = one + t.powi(2);
        let substituted = form(letters, (one - t.powi(2)) / half, two * t / half);
        let proof = Some(identity(substituted * half.powi(2), quartic));
        done.solution.push(Statement { math: Math::equation(quartic, zero), number: None, proof });
        done.solution.push(self.plain(name, two * t.atan2(one)));
        done.conditions = vec![
            Case { when: vec![], then: Consequence::Roots },
            Case { when: vec![Math::equation(a - d + g, zero)], then: Consequence::HalfTurn },
            Case {
                when: [a, b, d, e, g]
                    .into_iter()
                    .filter(|x| !x.is_zero())
                    .map(|x| Math::equation(x, zero))
                    .collect(),
                then: Consequence::Free,
            },
        ];
    }

    fn line(&mut self, i: usize, step: &Step, done: &mut Explained) {
        let row = &step.rows[0];
        let [a, b, ..] = self.letters;
        let name = done.unknown;
        let zero = Expr::int(0);
        let (c, s) = self.pair_of(step);
        done.form = vec![Math::equation(a * c + b * s, zero)];
        let (x, y) = (self.known(i, &row.b), self.known(i, &negated(&row.a)));
        done.coefficients = vec![self.plain(a, -y), self.plain(b, x)];
        let k = done.sign.unwrap_or(Expr::int(1));
        let proof = Some(self.prover.equation(x * s, y * c));
        done.solution = vec![Statement { proof, ..self.plain(name, (k * y).atan2(k * x)) }];
        done.conditions = vec![Case {
            when: vec![Math::equation(unsigned(x), zero), Math::equation(unsigned(y), zero)],
            then: Consequence::OpenAngle,
        }];
    }

    fn sincos(&mut self, i: usize, step: &Step, done: &mut Explained) {
        let row = &step.rows[0];
        let (c, s) = self.pair_of(step);
        let name = done.unknown;
        let [la, lb, lc, ..] = self.letters;
        let r = self.helpers[0];
        let (zero, one) = (Expr::int(0), Expr::int(1));
        let k = done.sign.unwrap_or(one);
        let lone = |p: &Poly| self.reading.rank_of(p) == 0 && p.terms().len() == 1;
        for (of, other, is_cos) in [(&row.a, &row.b, true), (&row.b, &row.a, false)] {
            if !other.is_zero() || !lone(of) {
                continue;
            }
            // A cos = C: the cosine itself, the sine by the root.
            done.kind = if is_cos { Kind::Cosine } else { Kind::Sine };
            let (letter, value, rest) = if is_cos { (la, c, s) } else { (lb, s, c) };
            done.form = vec![Math::equation(letter * value, lc)];
            let factor = self.known(i, of);
            let negative = of.terms()[0].1.is_negative();
            let right = if negative { self.negative(i, &row.c) } else { self.sum(i, &row.c) };
            let positive = if negative { -factor } else { factor };
            let (vn, rn) = (value, rest);
            self.equations += 1;
            let proof = Some(self.prover.equation(positive * value, right));
            done.solution.push(Statement {
                math: Math::equation(vn, right / positive),
                number: Some(self.equations),
                proof,
            });
            // cos = (a c − κ b R)/(a² + b²), sin = (b c + κ a R)/(a² + b²)
            let sign = if is_cos == negative { -k } else { k };
            let root = (one - vn.powi(2)).sqrt();
            let proof = Some(self.prover.equation(rest.powi(2), one - value.powi(2)));
            done.solution.push(Statement { proof, ..self.plain(rn, sign * root) });
            let angle = if is_cos { rn.atan2(vn) } else { vn.atan2(rn) };
            done.solution.push(self.plain(name, angle));
            self.reach(i, row, done, Some(vn));
            return;
        }
        done.form = vec![Math::equation(la * c + lb * s, lc)];
        // The equation times −1 exchanges the branches.
        let flipped = flipped(self, row);
        let k = if flipped.is_some() { -k } else { k };
        let row = flipped.as_ref().unwrap_or(row);
        let (a, b, right) = (self.known(i, &row.a), self.known(i, &row.b), self.sum(i, &row.c));
        done.coefficients = vec![self.plain(la, a), self.plain(lb, b), self.plain(lc, right)];
        let literals = |e: Expr| denavit_symbolic::readable::literals(e);
        let short = literals(a) + literals(b) + literals(right) <= SHORT;
        let (fa, fb, fc) = if short { (a, b, right) } else { (la, lb, lc) };
        let square = length_squared(fa, fb) - fc.powi(2);
        // At every configuration R² = (A sin − B cos)².
        let proof =
            Some(self.prover.equation((a * s - b * c).powi(2), a.powi(2) + b.powi(2) - right.powi(2)));
        done.solution.push(Statement { proof, ..self.plain(r, square.sqrt()) });
        let proof = Some(type_2());
        done.solution.push(Statement { proof, ..self.plain(name, fb.atan2(fa) + k * r.atan2(fc)) });
        self.reach(i, row, done, None);
        if self.reading.rank_of(&row.a).max(self.reading.rank_of(&row.b)) > 0 {
            let when = [b, a]
                .into_iter()
                .filter(|e| !e.is_zero())
                .map(|e| Math::equation(unsigned(e), zero))
                .collect();
            done.conditions.push(Case { when, then: Consequence::OpenUnless });
        }
    }

    /// When an equation of type 2 has how many values: where what is left of the squares can be factored, by lengths.
    fn reach(&mut self, i: usize, row: &Row, done: &mut Explained, lone: Option<Expr>) {
        let [la, lb, lc, ..] = self.letters;
        let one = Expr::int(1);
        let bounds = self.heron(row);
        let (when, less) = match (bounds, lone) {
            (Some((low, high)), _) => {
                let squares = Norm { squares: row.c.squares.clone(), plus: Poly::zero() };
                let distance = self.sum(i, &squares);
                let both = Math::Chain(low, vec![(Sign::AtMost, distance), (Sign::AtMost, high)]);
                (both, Bound::Span)
            }
            (None, Some(v)) => {
                (Math::Chain(-one, vec![(Sign::AtMost, v), (Sign::AtMost, one)]), Bound::Reach)
            }
            (None, None) => {
                let coefficients: Vec<Expr> = [&row.a, &row.b].map(|p| self.known(i, p)).to_vec();
                let right = self.sum(i, &row.c);
                let literals = |e: Expr| denavit_symbolic::readable::literals(e);
                let total: u64 = coefficients.iter().map(|e| literals(*e)).sum::<u64>() + literals(right);
                let (a, b, c) =
                    if total <= SHORT { (coefficients[0], coefficients[1], right) } else { (la, lb, lc) };
                let (left, right) = (length_squared(a, b), c.powi(2));
                (Math::relation(left, Sign::AtLeast, right), Bound::Reach)
            }
        };
        done.conditions.push(Case { when: vec![when], then: Consequence::TwoValues(less) });
    }

    /// Bounds of D² = Σ squares for A² + B² = C², C = D² − K, with A, B, K constants: K ± √(A² + B²), as squares
    /// where they are; proved.
    fn heron(&self, row: &Row) -> Option<(Expr, Expr)> {
        let algebra = &self.reading.chain.algebra;
        let k = negated(&row.c.plus);
        let constant = |p: &Poly| self.reading.rank_of(p) == 0;
        if row.c.squares.is_empty() || !constant(&row.a) || !constant(&row.b) || !constant(&k) {
            return None;
        }
        let n = algebra.square(&row.a).plus(&algebra.square(&row.b));
        // N = 4m²·rest and K = m² + rest: K ± √N = (m ± √rest)².
        let halves = n.monomial_content();
        let mut divisors = vec![Monomial::one()];
        for &(atom, exponent) in halves.factors() {
            let powers = (0..=exponent / 2).map(|e| Monomial::power(atom, e));
            divisors =
                powers.flat_map(|p| divisors.iter().map(|d| d.times(&p)).collect::<Vec<_>>()).collect();
        }
        for d in divisors {
            let rest = n.over(&d.times(&d)).scaled(&Rational::new(1, 4));
            let m = Poly::term(d, Rational::ONE);
            if algebra.square(&m).plus(&rest) != k {
                continue;
            }
            let root = match rest.terms() {
                [(x, r)] if x.factors().iter().all(|f| f.1 % 2 == 0) && r.sqrt().is_some() => {
                    let half = x
                        .factors()
                        .iter()
                        .fold(Monomial::one(), |h, f| h.times(&Monomial::power(f.0, f.1 / 2)));
                    self.reading.plain(&Poly::term(half, r.sqrt()?))
                }
                _ => self.reading.plain(&rest).sqrt(),
            };
            let m = self.reading.plain(&m);
            let (low, high) = ((m - root).powi(2), (m + root).powi(2));
            let (k, n) = (self.reading.plain(&k), self.reading.plain(&n));
            let fits = identity(low + high, Expr::int(2) * k) == Proof::Proved
                && identity(low * high, k.powi(2) - n) == Proof::Proved;
            return fits.then_some((low, high));
        }
        None
    }

    fn pair(&mut self, i: usize, step: &Step, determinant: Determinant, done: &mut Explained) {
        let (c, s) = self.pair_of(step);
        let name = done.unknown;
        let zero = Expr::int(0);
        let lone = |p: &Poly| p.terms().len() == 1 && self.reading.rank_of(p) == 0;
        let rows = [0, 1].map(|k| flipped(self, &step.rows[k]).unwrap_or_else(|| step.rows[k].clone()));
        let (r1, r2) = (&rows[0], &rows[1]);
        let separate = [(r1, r2), (r2, r1)]
            .into_iter()
            .find(|(x, y)| x.b.is_zero() && y.a.is_zero() && lone(&x.a) && lone(&y.b));
        if let Some((x, y)) = separate {
            done.kind = Kind::Separate;
            let mut values = vec![];
            for (row, of, value) in [(x, &x.a, c), (y, &y.b, s)] {
                let negative = of.terms()[0].1.is_negative();
                let right = if negative { self.negative(i, &row.c) } else { self.sum(i, &row.c) };
                let factor = self.known(i, of);
                let factor = if negative { -factor } else { factor };
                let proof = self.prover.equation(factor * value, right);
                values.push((right / factor, proof));
            }
            let [(x, px), (y, py)] = values[..] else { return };
            let literals = denavit_symbolic::readable::literals;
            if literals(x) + literals(y) <= 2 * SHORT {
                done.solution.push(Statement { proof: Some(px.max(py)), ..self.plain(name, y.atan2(x)) });
            } else {
                done.solution.push(Statement { proof: Some(px), ..self.plain(c, x) });
                done.solution.push(Statement { proof: Some(py), ..self.plain(s, y) });
                done.solution.push(self.plain(name, s.atan2(c)));
            }
            done.conditions.push(Case { when: vec![], then: Consequence::OneValue });
            return;
        }
        let coefficients = |row: &Row| [self.known(i, &row.a), self.known(i, &row.b), self.sum(i, &row.c)];
        let ([a1, b1, c1], [a2, b2, c2]) = (coefficients(r1), coefficients(r2));
        let (cos, sin) = (c, s);
        for [a, b, c] in [[a1, b1, c1], [a2, b2, c2]] {
            done.form.push(Math::equation(a * cos + b * sin, c));
        }
        let (mut x, mut y) = (times(b2, c1) - times(b1, c2), times(a1, c2) - times(a2, c1));
        let mut delta = a1 * b2 - a2 * b1;
        let algebra = &self.reading.chain.algebra;
        let exact = algebra.times(&r1.a, &r2.b).minus(&algebra.times(&r2.a, &r1.b));
        let general = determinant == Determinant::General;
        if !general {
            let value = Samples::new(self.reading.chain, |_| None).values(&exact)[0];
            if value < 0.0 {
                x = times(b1, c2) - times(b2, c1);
                y = times(a2, c1) - times(a1, c2);
                delta = a2 * b1 - a1 * b2;
            }
            if determinant == Determinant::Perpendicular {
                // The rows are (a, b) and ±(−b, a).
                let square = |a: Expr, b: Expr| a.powi(2) + b.powi(2);
                if self.prover.equation(delta, square(a1, b1)) == Proof::Proved {
                    delta = square(a1, b1);
                }
            }
        }
        let (px, py) = (self.prover.equation(x, delta * c), self.prover.equation(y, delta * s));
        let proof = Some(px.max(py));
        if general {
            let symbol = self.helpers[1];
            done.solution.push(self.plain(symbol, delta));
            done.solution.push(Statement { proof: Some(px), ..self.plain(c, x / symbol) });
            done.solution.push(Statement { proof: Some(py), ..self.plain(s, y / symbol) });
            done.solution.push(self.plain(name, s.atan2(c)));
            done.conditions
                .push(Case { when: vec![Math::equation(symbol, zero)], then: Consequence::OneEquation });
        } else {
            done.solution.push(Statement { proof, ..self.plain(name, y.atan2(x)) });
            match determinant {
                Determinant::Perpendicular => done.conditions.push(Case {
                    when: [a1, b1]
                        .into_iter()
                        .filter(|e| !e.is_zero())
                        .map(|e| Math::equation(unsigned(e), zero))
                        .collect(),
                    then: Consequence::OpenJoint,
                }),
                _ => done.conditions.push(Case { when: vec![], then: Consequence::OneValue }),
            }
        }
    }
}

/// The type of a form; some are refined by the coefficients.
fn kind(form: &Form) -> Kind {
    match form {
        Form::Ratio { .. } => Kind::Displacement,
        Form::Quadratic { .. } => Kind::DisplacementSquared,
        Form::Quartic(_) => Kind::Quartic,
        Form::Line => Kind::Homogeneous,
        Form::Sincos => Kind::Linear,
        Form::Pair { .. } => Kind::Pair,
    }
}

/// What is lost or added on the way.
fn remark(step: &Step) -> Remark {
    let squares = step.origins.iter().any(|o| matches!(o, Origin::Squares { .. }));
    match (&step.form, step.cost.spurious, squares) {
        (_, true, _) => Remark::MayAdd,
        (_, false, true) => Remark::SquaresAddNone,
        (Form::Pair { .. } | Form::Line | Form::Sincos | Form::Ratio { .. }, ..) => Remark::Whole,
        _ => Remark::AddsNone,
    }
}

/// The row times −1, if neither of its coefficients is positive.
fn flipped(context: &Context, row: &Row) -> Option<Row> {
    let minus = |p: &Poly| {
        let e = context.reading.plain(p);
        p.is_zero() || unsigned(e) != e || e.as_number().is_some_and(|r| r.is_negative())
    };
    let flip = row.c.squares.is_empty() && minus(&row.a) && minus(&row.b);
    let c = Norm { squares: vec![], plus: negated(&row.c.plus) };
    flip.then(|| Row { a: negated(&row.a), b: negated(&row.b), c, ..row.clone() })
}

/// a² + b², what has a minus sign behind.
fn length_squared(a: Expr, b: Expr) -> Expr {
    let (a, b) = if unsigned(a) == a { (a, b) } else { (b, a) };
    a.powi(2) + b.powi(2)
}

/// Without the sign in front.
pub fn unsigned(e: Expr) -> Expr {
    if let denavit_symbolic::Node::Neg(x) = e.node() { x } else { e }
}

/// cos = (AC − κBR)/N and sin = (BC + κAR)/N with N = A² + B², R² = N − C² solve A cos + B sin = C on the unit circle.
fn type_2() -> Proof {
    let [a, b, r, k] = ["A", "B", "R", "κ"].map(Expr::symbol);
    // C is the root of N − R², which the ring takes as an atom.
    let n = a.powi(2) + b.powi(2);
    let c = (n - r.powi(2)).sqrt();
    let (x, y) = ((a * c - k * b * r) / n, (b * c + k * a * r) / n);
    let on_line = identity(a * x + b * y, c);
    // κ² = 1, for either sign.
    let on_circle = [1, -1].map(|sign| {
        let put = |e: Expr| e.substitute(|s| (Expr::from(s) == k).then(|| Expr::int(sign)));
        identity(put(x.powi(2) + y.powi(2)), Expr::int(1))
    });
    on_line.max(on_circle[0]).max(on_circle[1])
}
