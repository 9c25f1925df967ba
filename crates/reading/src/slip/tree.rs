//! A printed formula as a table of parts, with the value of each part and the value that it should have.

use super::field::{self, ONE, Value, ZERO};
use super::points::{Points, arctangent, roots};
use denavit_symbolic::expr::Expr;
use denavit_symbolic::parse::{Function, Syntax, SyntaxKind};
use std::ops::Range;

/// What a part is. Parts that are not looked into are leaves.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Kind {
    /// A name, a number, or a function of an angle.
    Leaf(Expr),
    /// Whether each term is subtracted.
    Sum(Vec<bool>),
    /// Whether each factor stands behind a `/`.
    Product(Vec<bool>),
    Power(i32),
    Root,
    Arctangent,
    Bracket,
}

/// A part, whose own parts have larger numbers.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub kind: Kind,
    pub span: Range<usize>,
    pub parent: Option<usize>,
    pub kids: Vec<usize>,
    /// The number of leaves.
    pub size: u32,
    /// True above or below the line of a `\frac{…}{…}`.
    pub in_braces: bool,
}

/// The parts of a formula; the first is all of it.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    pub parts: Vec<Part>,
    leaves: Vec<Value>,
}

/// The value that a part should have, as a quotient.
pub(super) type Needed = Option<(Value, Value)>;

impl Tree {
    /// `None` if a leaf has no value, or a sign has two.
    pub fn of(syntax: &Syntax, points: &mut Points) -> Option<Self> {
        let mut tree = Tree { parts: vec![], leaves: vec![] };
        tree.add(syntax, None, points)?;
        for i in (0..tree.parts.len()).rev() {
            let size = tree.parts[i].kids.iter().map(|&k| tree.parts[k].size).sum::<u32>();
            tree.parts[i].size = size.max(1);
        }
        Some(tree)
    }

    fn add(&mut self, syntax: &Syntax, parent: Option<usize>, points: &mut Points) -> Option<usize> {
        let own = self.parts.len();
        let mut value = ZERO;
        let mut leaf = |e: Expr| {
            value = points.value(e)?;
            Some((Kind::Leaf(e), vec![]))
        };
        let (kind, kids): (Kind, Vec<&Syntax>) = match &syntax.kind {
            SyntaxKind::Number(r) => leaf(r.clone().into())?,
            SyntaxKind::Name(e) => leaf(*e)?,
            SyntaxKind::Sum(terms) => {
                if terms.iter().any(|(sign, _)| sign.is_two_valued()) {
                    return None;
                }
                let signs = terms.iter().map(|(sign, _)| sign.is_minus()).collect();
                (Kind::Sum(signs), terms.iter().map(|t| &t.1).collect())
            }
            SyntaxKind::Product(factors) => {
                (Kind::Product(factors.iter().map(|f| f.0).collect()), factors.iter().map(|f| &f.1).collect())
            }
            SyntaxKind::Fraction(over, under) => (Kind::Product(vec![false, true]), vec![over, under]),
            SyntaxKind::Power(base, n) => (Kind::Power(*n), vec![base]),
            SyntaxKind::Root(inner) => (Kind::Root, vec![inner]),
            SyntaxKind::Bracket(inner) => (Kind::Bracket, vec![inner]),
            SyntaxKind::Call(Function::Atan2, arguments) if arguments.len() == 2 => {
                (Kind::Arctangent, arguments.iter().collect())
            }
            SyntaxKind::Call(..) => leaf(syntax.value())?,
        };
        self.parts.push(Part {
            kind,
            span: syntax.span.clone(),
            parent,
            kids: vec![],
            size: 1,
            in_braces: false,
        });
        self.leaves.push(value);
        let kids = kids.into_iter().map(|k| self.add(k, Some(own), points)).collect::<Option<Vec<_>>>()?;
        if let SyntaxKind::Fraction(..) = syntax.kind {
            kids.iter().for_each(|&k| self.parts[k].in_braces = true);
        }
        self.parts[own].kids = kids;
        Some(own)
    }

    /// The expression of a leaf.
    pub fn leaf(&self, part: usize) -> Option<Expr> {
        match self.parts[part].kind {
            Kind::Leaf(e) => Some(e),
            Kind::Sum(_)
            | Kind::Product(_)
            | Kind::Power(_)
            | Kind::Root
            | Kind::Arctangent
            | Kind::Bracket => None,
        }
    }

    /// The leaves, in the order of print.
    pub fn leaves(&self) -> impl Iterator<Item = (usize, Expr)> + '_ {
        (0..self.parts.len()).filter_map(|i| Some((i, self.leaf(i)?)))
    }

    /// Where the part stands among those of its parent.
    pub fn place(&self, part: usize) -> Option<(usize, usize)> {
        let parent = self.parts[part].parent?;
        self.parts[parent].kids.iter().position(|&k| k == part).map(|i| (parent, i))
    }

    /// True for the whole formula and for all that a bracket, a root or a fraction holds: a sum may stand there.
    pub fn is_whole(&self, part: usize) -> bool {
        self.parts[part].in_braces
            || self.parts[part].parent.is_none_or(|parent| match self.parts[parent].kind {
                Kind::Bracket | Kind::Root | Kind::Arctangent => true,
                Kind::Leaf(_) | Kind::Product(_) | Kind::Sum(_) | Kind::Power(_) => false,
            })
    }

    /// The term of a sum that the part belongs to, or the nearest whole.
    pub fn term(&self, mut part: usize) -> usize {
        while let Some(parent) = self.parts[part].parent {
            if matches!(self.parts[parent].kind, Kind::Sum(_)) || self.is_whole(part) {
                break;
            }
            part = parent;
        }
        part
    }

    /// True if `part` is `above` or stands in it.
    pub fn is_in(&self, mut part: usize, above: usize) -> bool {
        while part > above {
            match self.parts[part].parent {
                Some(parent) => part = parent,
                None => return false,
            }
        }
        part == above
    }

    /// The values of all parts, where some have others than their own.
    pub fn values(&self, others: &[(usize, Value)]) -> Option<Vec<Value>> {
        let mut values = self.leaves.clone();
        for i in (0..self.parts.len()).rev() {
            if let Some((_, other)) = others.iter().find(|o| o.0 == i) {
                values[i] = *other;
                continue;
            }
            let part = &self.parts[i];
            let kid = |k: usize| values[part.kids[k]];
            values[i] = match &part.kind {
                Kind::Leaf(_) => continue,
                Kind::Sum(signs) => signs.iter().enumerate().fold(ZERO, |s, (k, &is_minus)| match is_minus {
                    true => field::difference(&s, &kid(k)),
                    false => field::sum(&s, &kid(k)),
                }),
                Kind::Product(places) => {
                    let of = |is_under: bool| {
                        let chosen = (0..places.len()).filter(|&k| places[k] == is_under);
                        chosen.fold(ONE, |p, k| field::product(&p, &kid(k)))
                    };
                    match places.contains(&true) {
                        true => field::product(&of(false), &field::reciprocal(&of(true))?),
                        false => of(false),
                    }
                }
                Kind::Power(n) => field::raised(&kid(0), *n)?,
                // Where there is no root the formula is wrong, but what is under the root may still be found.
                Kind::Root => roots(&kid(0)).unwrap_or_else(|| arctangent(&kid(0), &ONE)),
                Kind::Arctangent => arctangent(&kid(0), &kid(1)),
                Kind::Bracket => kid(0),
            };
        }
        Some(values)
    }

    /// The value that each part must have, by itself, for the whole to be `wanted`; none where that is not one value.
    pub fn needed(&self, values: &[Value], wanted: &Value, arguments: Option<(Value, Value)>) -> Vec<Needed> {
        let mut needed: Vec<Needed> = vec![None; self.parts.len()];
        if let Some(first) = needed.first_mut() {
            *first = Some((*wanted, ONE));
        }
        for i in 0..self.parts.len() {
            let part = &self.parts[i];
            let Some((n, d)) = needed[i] else { continue };
            match &part.kind {
                Kind::Leaf(_) => {}
                Kind::Sum(signs) => {
                    for (&kid, &is_minus) in part.kids.iter().zip(signs) {
                        let x = &values[kid];
                        let rest = match is_minus {
                            true => field::sum(&values[i], x),
                            false => field::difference(&values[i], x),
                        };
                        let own = field::difference(&n, &field::product(&rest, &d));
                        needed[kid] = usable(if is_minus { field::opposite(&own) } else { own }, d);
                    }
                }
                Kind::Product(places) => {
                    for (&kid, is_under, others, under) in cofactors(&part.kids, places, values) {
                        needed[kid] = match is_under {
                            false => usable(field::product(&n, &under), field::product(&d, &others)),
                            true => usable(field::product(&d, &others), field::product(&n, &under)),
                        };
                    }
                }
                Kind::Power(-1) => needed[part.kids[0]] = usable(d, n),
                Kind::Power(_) => {}
                Kind::Root => {
                    needed[part.kids[0]] = usable(field::product(&n, &n), field::product(&d, &d));
                }
                Kind::Arctangent => {
                    if let (0, Some((y, x))) = (i, arguments) {
                        needed[part.kids[0]] = Some((y, ONE));
                        needed[part.kids[1]] = Some((x, ONE));
                    }
                }
                Kind::Bracket => needed[part.kids[0]] = Some((n, d)),
            }
        }
        needed
    }
}

fn usable(n: Value, d: Value) -> Needed {
    (!field::has_zero(&d)).then_some((n, d))
}

/// For each factor: whether it is a divisor, the product of the other factors above the line, and that of the other
/// divisors below it.
fn cofactors<'a>(
    kids: &'a [usize],
    places: &[bool],
    values: &[Value],
) -> Vec<(&'a usize, bool, Value, Value)> {
    let count = kids.len();
    // Products of the factors from each place on: above the line, below it.
    let mut behind = vec![(ONE, ONE); count + 1];
    for i in (0..count).rev() {
        behind[i] = with(behind[i + 1], places[i], &values[kids[i]]);
    }
    let mut before = (ONE, ONE);
    let mut found = Vec::with_capacity(count);
    for (i, kid) in kids.iter().enumerate() {
        let others = field::product(&before.0, &behind[i + 1].0);
        let under = field::product(&before.1, &behind[i + 1].1);
        found.push((kid, places[i], others, under));
        before = with(before, places[i], &values[*kid]);
    }
    found
}

fn with((above, below): (Value, Value), is_under: bool, x: &Value) -> (Value, Value) {
    match is_under {
        false => (field::product(&above, x), below),
        true => (above, field::product(&below, x)),
    }
}
