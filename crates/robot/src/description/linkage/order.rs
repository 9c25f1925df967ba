//! The order in which the loops of a linkage are solved: each by a dyad, of which all but three joints are known.

use super::affine::affine;
use super::dyad::Complex;
use super::plane::{Fault, Planar, Term};
use super::spherical::{Between, Spherical};
use super::{Linkage, is_passive};
use crate::scalar::Scalar;
use denavit_symbolic::{Angle, Expr, Node, Rational, Symbol, readable};

/// A sum of vectors of the plane, Σ (x + iy)·e(angle).
#[derive(Clone, Debug, Default)]
pub struct Vectors(pub Vec<Term>);

/// What three unknown joints of a loop are to each other. Unknown directions have length 1.
#[derive(Clone, Debug)]
pub enum Dyad {
    /// All axes of the loop meet in one point: the rotations between the three that are unknown.
    Spherical(Between),
    /// Three turn: A·e₁ + B·e₂ = P.
    Turns {
        /// A
        a: Vectors,
        /// B
        b: Vectors,
        /// P
        p: Vectors,
        /// Solutions that are affine in what is known: the angles of e₁ and e₂.
        affine: Vec<[Angle; 2]>,
    },
    /// Two turn, and what slides does not turn with them: A·e₁ + u·r = P.
    Slide {
        /// A
        a: Vectors,
        /// u
        u: Vectors,
        /// P
        p: Vectors,
        /// r
        slide: Symbol,
    },
    /// Two turn, and what slides between them turns: (A + u·r)·e₁ = P.
    Cylinder {
        /// A
        a: Vectors,
        /// u
        u: Vectors,
        /// P
        p: Vectors,
        /// r
        slide: Symbol,
    },
    /// One turns, two slide: u·r + v·s = P.
    Slides {
        /// u and v
        along: [Vectors; 2],
        /// P
        p: Vectors,
        /// r and s
        slides: [Symbol; 2],
    },
}

/// An unknown angle as whole multiples of what is found: of the turn that is left, of the angle of e₁, and of that of e₂; in a spherical
/// loop of its three angles.
#[derive(Clone, Debug)]
pub struct Sum {
    /// The variable.
    pub symbol: Symbol,
    /// The multiples.
    pub of: [i64; 3],
}

/// A loop that is solved when those before it are.
#[derive(Clone, Debug)]
pub struct Step {
    /// The closure.
    pub closure: usize,
    /// Its equations.
    pub dyad: Dyad,
    /// The sum of the unknown angles around the loop, in what is known.
    pub turn: Angle,
    /// The unknown angles.
    pub angles: Vec<Sum>,
}

/// Why a loop has no closed form here.
#[derive(Clone, Debug)]
pub enum Unsolved {
    /// It is not planar.
    NotPlanar(Fault),
    /// Nothing of it is unknown once the loops before it are solved: it only repeats what they say, or forbids it.
    Determined,
    /// So many of its joints are unknown at once, or three that do not make a dyad.
    Unknowns(Vec<Symbol>),
}

/// How the loops of a linkage are solved.
#[derive(Clone, Debug)]
pub struct Plan {
    /// One loop after the other.
    pub steps: Vec<Step>,
    /// Loops that are left: what they are solved by is numeric.
    pub unsolved: Vec<(usize, Unsolved)>,
}

impl Vectors {
    /// The sum, where `value` gives lengths and angles theirs.
    pub fn sum<T: Scalar>(&self, value: impl Fn(Expr) -> T) -> Complex<T> {
        let one =
            |t: &Term| Complex::new(value(t.x), value(t.y)) * Complex::direction(value(t.angle.to_expr()));
        self.0.iter().map(one).reduce(|a, b| a + b).unwrap_or_else(|| Complex::new(T::zero(), T::zero()))
    }

    /// As a formula.
    pub fn formula(&self) -> Complex<Expr> {
        self.sum(|e| e)
    }

    fn negated(self) -> Self {
        Vectors(self.0.into_iter().map(|t| Term { x: -t.x, y: -t.y, ..t }).collect())
    }
}

impl Plan {
    /// That of a linkage.
    pub fn of(linkage: &Linkage) -> Self {
        let mut planar: Vec<(usize, Result<Planar, Fault>)> =
            (0..linkage.closures.len()).map(|k| (k, Planar::of(linkage, k))).collect();
        let spherical: Vec<Option<Spherical>> = planar
            .iter()
            .map(|(k, plane)| if plane.is_err() { Spherical::of(linkage, *k) } else { None })
            .collect();
        let mut unknown: Vec<Symbol> = linkage.passive().iter().map(|v| v.symbol).collect();
        let mut steps: Vec<Step> = vec![];
        loop {
            let next = planar.iter().enumerate().find_map(|(at, (closure, plane))| {
                let step = match plane {
                    Ok(plane) => Step::of(*closure, plane, &unknown)?,
                    Err(_) => Step::of_spherical(*closure, spherical[*closure].as_ref()?, &unknown)?,
                };
                Some((at, step))
            });
            let Some((at, step)) = next else { break };
            let _solved = planar.remove(at);
            unknown.retain(|s| !step.unknowns().contains(s));
            steps.push(step);
        }
        let why = |(closure, plane): (usize, Result<Planar, Fault>)| {
            let left: Vec<Symbol> =
                linkage.symbols_of(closure).into_iter().filter(|s| unknown.contains(s)).collect();
            let why = match (plane, left.is_empty()) {
                (_, true) => Unsolved::Determined,
                (Err(fault), _) => Unsolved::NotPlanar(fault),
                (Ok(_), _) => Unsolved::Unknowns(left),
            };
            (closure, why)
        };
        Plan { steps, unsolved: planar.into_iter().map(why).collect() }
    }
}

impl Linkage {
    /// The passive variables that stand in a loop.
    pub fn symbols_of(&self, closure: usize) -> Vec<Symbol> {
        let rows = self.sides(closure).concat();
        let mut all: Vec<Symbol> = vec![];
        for s in rows.iter().flat_map(|r| [r.theta, r.d]).flat_map(Expr::symbols) {
            if is_passive(s) && !all.contains(&s) {
                all.push(s);
            }
        }
        all
    }
}

/// The unknown and the known part of an angle.
fn parts(angle: &Angle, unknown: &[Symbol]) -> (Angle, Angle) {
    let is_unknown = |t: &&(Expr, Rational)| t.0.as_symbol().is_some_and(|s| unknown.contains(&s));
    let terms = |wanted: bool| angle.terms.iter().filter(|t| is_unknown(t) == wanted).cloned().collect();
    (
        Angle { terms: terms(true), ..Angle::default() },
        Angle { terms: terms(false), turns: angle.turns.clone(), radians: angle.radians.clone() },
    )
}

fn factor(angle: &Angle, symbol: Symbol) -> Rational {
    let term = angle.terms.iter().find(|t| t.0.as_symbol() == Some(symbol));
    term.map_or(Rational::ZERO, |t| t.1.clone())
}

fn symbols_of(e: Expr, unknown: &[Symbol]) -> Vec<Symbol> {
    e.symbols().into_iter().filter(|s| unknown.contains(s)).collect()
}

impl Step {
    /// The unknown variables that it finds.
    pub fn unknowns(&self) -> Vec<Symbol> {
        let slides: &[Symbol] = match &self.dyad {
            Dyad::Turns { .. } | Dyad::Spherical(_) => &[],
            Dyad::Slide { slide, .. } | Dyad::Cylinder { slide, .. } => std::slice::from_ref(slide),
            Dyad::Slides { slides, .. } => slides,
        };
        self.angles.iter().map(|a| a.symbol).chain(slides.iter().copied()).collect()
    }

    /// How many solutions it has at most.
    pub fn solutions(&self) -> usize {
        if matches!(self.dyad, Dyad::Slides { .. }) { 1 } else { 2 }
    }

    /// The step for a spherical loop, if three of its joints are unknown.
    fn of_spherical(closure: usize, loop_: &Spherical, unknown: &[Symbol]) -> Option<Self> {
        let (turns, between) = loop_.between(unknown)?;
        let angle = |(k, &(symbol, sign)): (usize, &(Symbol, i64))| {
            let mut of = [0; 3];
            of[k] = sign;
            Sum { symbol, of }
        };
        let angles = turns.iter().enumerate().map(angle).collect();
        Some(Step { closure, dyad: Dyad::Spherical(between), turn: Angle::default(), angles })
    }

    /// The step for a planar loop, if three of its joints are unknown and make a dyad.
    fn of(closure: usize, plane: &Planar, unknown: &[Symbol]) -> Option<Self> {
        let turning: Vec<Symbol> = symbols_of(plane.turn.to_expr(), unknown);
        let mut slides: Vec<Symbol> = vec![];
        for term in &plane.terms {
            for s in [symbols_of(term.x, unknown), symbols_of(term.y, unknown)].concat() {
                if !slides.contains(&s) {
                    slides.push(s);
                }
            }
        }
        if turning.len() + slides.len() != 3 || turning.is_empty() {
            return None;
        }
        let (turn_of_unknowns, turn) = parts(&plane.turn, unknown);
        // The turn around the loop is 0: one unknown angle goes, so that few directions are left.
        let without = |symbol: &Symbol| -> Option<Vec<Term>> {
            let own = factor(&plane.turn, *symbol);
            let terms = plane.terms.iter().map(|t| {
                let times = &factor(&t.angle, *symbol) * &own.recip()?;
                let angle = t.angle.plus(&plane.turn.scaled(&-&times));
                times.is_integer().then(|| Term { angle, ..t.clone() })
            });
            terms.collect()
        };
        let directions = |terms: &[Term]| {
            let mut all: Vec<Angle> = vec![];
            for part in terms.iter().map(|t| parts(&t.angle, unknown).0) {
                if !part.is_constant() && !all.contains(&part) {
                    all.push(part);
                }
            }
            all
        };
        let fewest = turning.iter().filter_map(without).map(|t| (directions(&t), t));
        let (directions, terms) = fewest.min_by_key(|f| f.0.len())?;
        let gathered = |direction: Option<&Angle>| {
            let own = |t: &&Term| {
                let part = parts(&t.angle, unknown).0;
                direction.map_or_else(|| part.is_constant(), |d| part == *d)
            };
            terms.iter().filter(own).cloned().collect::<Vec<Term>>()
        };
        // What stands there without a slide, and by how much it changes with it.
        let at = |terms: &[Term], slide: Option<Symbol>, value: i64| {
            let put = |e: Expr| {
                let put = |s: Symbol| match slides.contains(&s) {
                    true => Some(Expr::int(if Some(s) == slide { value } else { 0 })),
                    false => None,
                };
                readable::settled(e.substitute(put))
            };
            let known = |t: &Term| Term { x: put(t.x), y: put(t.y), angle: parts(&t.angle, unknown).1 };
            terms.iter().map(known).collect::<Vec<Term>>()
        };
        let still = |terms: &[Term]| plain(at(terms, None, 0));
        let along = |terms: &[Term], slide: Symbol| {
            let (one, zero) = (at(terms, Some(slide), 1), at(terms, None, 0));
            let change = |(a, b): (Term, Term)| Term {
                x: readable::settled(a.x - b.x),
                y: readable::settled(a.y - b.y),
                angle: a.angle,
            };
            plain(one.into_iter().zip(zero).map(change).collect())
        };
        let known = gathered(None);
        let p = still(&known).negated();
        let slides_in = |terms: &[Term], slide: Symbol| !along(terms, slide).0.is_empty();
        let groups: Vec<Vec<Term>> = directions.iter().map(|d| gathered(Some(d))).collect();
        let dyad = match (&groups[..], &slides[..]) {
            ([a, b], []) => {
                let (a, b) = (still(a), still(b));
                let affine = affine(&a, &b, &p);
                Dyad::Turns { a, b, p, affine }
            }
            ([a], &[slide]) => match (slides_in(a, slide), slides_in(&known, slide)) {
                (true, false) => Dyad::Cylinder { a: still(a), u: along(a, slide), p, slide },
                (false, true) => Dyad::Slide { a: still(a), u: along(&known, slide), p, slide },
                _ => return None,
            },
            ([], &[r, s]) => Dyad::Slides { along: [along(&known, r), along(&known, s)], p, slides: [r, s] },
            _ => return None,
        };
        let forms: Vec<Angle> = [turn_of_unknowns].into_iter().chain(directions).collect();
        let angles = combined(&turning, &forms)?;
        Some(Step { closure, dyad, turn: turn.scaled(&-Rational::ONE), angles })
    }
}

/// The sum of terms of one direction each; what is 0 is left out.
fn plain(terms: Vec<Term>) -> Vectors {
    let mut all: Vec<Term> = vec![];
    for t in terms {
        match all.iter_mut().find(|a| a.angle == t.angle) {
            Some(a) => (a.x, a.y) = (readable::settled(a.x + t.x), readable::settled(a.y + t.y)),
            None => all.push(t),
        }
    }
    all.retain(|t| !(t.x.is_zero() && t.y.is_zero()));
    Vectors(all.into_iter().map(straightened).collect())
}

/// A term of which the length is one number, if one of the angles in it makes it so: (L·cos γ + iL·sin γ)·e(φ) is L·e(φ + γ).
fn straightened(t: Term) -> Term {
    if t.x.is_zero() || t.y.is_zero() {
        return t;
    }
    let angles = Expr::postorder(&[t.x, t.y]).into_iter().filter_map(|e| match e.node() {
        Node::Sin(a) | Node::Cos(a) => Some(a),
        _ => None,
    });
    for angle in angles.flat_map(|a| [a, -a]) {
        let turned = Complex::new(t.x, t.y) * Complex::direction(-angle);
        let (x, y) = (readable::settled(turned.re), readable::settled(turned.im));
        if x.is_zero() || y.is_zero() {
            return Term { x, y, angle: t.angle.plus(&Angle::of(angle)) };
        }
    }
    t
}

/// The symbols as whole multiples of forms of them, if there are as many forms as symbols and they determine them.
fn combined(symbols: &[Symbol], forms: &[Angle]) -> Option<Vec<Sum>> {
    let n = symbols.len();
    if forms.len() != n || n > 3 {
        return None;
    }
    // Gauss and Jordan on [forms | 1].
    let mut m: Vec<Vec<Rational>> = forms
        .iter()
        .enumerate()
        .map(|(i, form)| {
            let unit = (0..n).map(|j| Rational::from(i64::from(i == j)));
            symbols.iter().map(|s| factor(form, *s)).chain(unit).collect()
        })
        .collect();
    for c in 0..n {
        let pivot = (c..n).find(|&r| !m[r][c].is_zero())?;
        m.swap(c, pivot);
        let by = m[c][c].recip()?;
        m[c] = m[c].iter().map(|x| x * &by).collect();
        let own = m[c].clone();
        for (_, row) in m.iter_mut().enumerate().filter(|(r, _)| *r != c) {
            let by = row[c].clone();
            *row = row.iter().zip(&own).map(|(x, y)| x - &(&by * y)).collect();
        }
    }
    let sum = |(row, &symbol): (&Vec<Rational>, &Symbol)| {
        let mut of = [0; 3];
        for (k, x) in row[n..].iter().enumerate() {
            of[k] = x.to_integer()?;
        }
        Some(Sum { symbol, of })
    };
    m.iter().zip(symbols).map(sum).collect()
}
