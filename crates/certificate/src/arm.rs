//! The robot by its table alone: frames, Jacobians, as plain polynomials. The checker does the same again.

use crate::field::{Field, Obstacle};
use denavit::description::{Cell, Convention, Description};
use denavit::forward::Reference;
use denavit_symbolic::poly::{Monomial, Poly};
use denavit_symbolic::{Angle, Expr, Rational, Symbol};
use rustc_hash::FxHashMap;

/// Three rows of a homogeneous matrix.
pub(crate) type Matrix = [[Poly; 4]; 3];

/// Whose velocity, along which axes, at which point.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct View {
    /// The frame of the body.
    pub body: Frame,
    /// Along whose axes.
    pub axes: Frame,
    /// The frame from whose origin the point is given.
    pub at: Frame,
    /// The point in that frame.
    pub offset: [Expr; 3],
}

/// A frame: the base, those behind the rows, the tool.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Frame {
    /// Before frame 0.
    Base,
    /// Behind the row with this number.
    Behind(usize),
    /// Behind the last.
    Tool,
}

impl From<Reference> for Frame {
    fn from(frame: Reference) -> Self {
        match frame {
            Reference::Base => Frame::Base,
            Reference::Frame(i) => Frame::Behind(i),
            Reference::Tool => Frame::Tool,
        }
    }
}

/// The screws of each link and what joints move.
pub struct Arm {
    /// The base, the rows, the tool; each the matrices that are multiplied.
    pub(crate) links: Vec<Vec<Matrix>>,
    /// θ and d of each row.
    pub(crate) moved: Vec<[Expr; 2]>,
    /// The matrices of a row before its joint's.
    pub(crate) before: usize,
    /// The joint variables.
    pub(crate) joints: Vec<Symbol>,
    frames: FxHashMap<(usize, usize), Matrix>,
}

/// The cells of a row in the order of the product, by axes. The checker has the same table.
pub fn order(convention: Convention) -> &'static [[Cell; 2]] {
    match convention {
        Convention::Standard => &[[Cell::Theta, Cell::D], [Cell::A, Cell::Alpha]],
        Convention::Craig => &[[Cell::Alpha, Cell::A], [Cell::Theta, Cell::D]],
        Convention::Khalil => &[[Cell::Gamma, Cell::B], [Cell::Alpha, Cell::A], [Cell::Theta, Cell::D]],
    }
}

/// The key of a cell in a certificate, whatever the convention.
pub fn key(cell: Cell) -> &'static str {
    match cell {
        Cell::Gamma => "gamma",
        Cell::B => "b",
        Cell::Alpha => "alpha",
        Cell::A => "a",
        Cell::Theta => "theta",
        Cell::D => "d",
    }
}

impl Arm {
    /// The arm of a description.
    ///
    /// # Errors
    /// If a cell holds what certificates do not know.
    pub fn new(description: &Description, field: &mut Field) -> Result<Self, Obstacle> {
        let constant = |x: [[Expr; 4]; 4], field: &mut Field| -> Result<Matrix, Obstacle> {
            let mut rows = identity();
            for (row, entries) in rows.iter_mut().zip(x) {
                for (p, e) in row.iter_mut().zip(entries) {
                    *p = field.polynomial(e)?;
                }
            }
            Ok(rows)
        };
        let mut links = vec![vec![constant(description.base.matrix(), field)?]];
        let order = order(description.convention);
        for row in &description.rows {
            let screws = order.iter().map(|&[x, y]| {
                let (angle, length) = if x.turns() { (x, y) } else { (y, x) };
                screw(field, angle == Cell::Alpha, angle.of(row), length.of(row))
            });
            links.push(screws.collect::<Result<_, _>>()?);
        }
        links.push(vec![constant(description.tool.matrix(), field)?]);
        Ok(Arm {
            links,
            moved: description.rows.iter().map(|r| [r.theta, r.d]).collect(),
            before: order.iter().position(|c| c.contains(&Cell::Theta)).unwrap_or(0),
            joints: description.variables().iter().map(|v| v.symbol).collect(),
            frames: FxHashMap::default(),
        })
    }

    pub(crate) fn index(&self, frame: Frame) -> usize {
        match frame {
            Frame::Base => 0,
            Frame::Behind(i) => (i + 1).min(self.links.len()),
            Frame::Tool => self.links.len(),
        }
    }

    /// An entry of frame `to` in frame `from`, row and column from 0.
    ///
    /// # Errors
    /// If the product is too large.
    pub fn entry(
        &mut self,
        field: &mut Field,
        from: Frame,
        to: Frame,
        (row, column): (usize, usize),
    ) -> Result<Poly, Obstacle> {
        let (from, to) = (self.index(from), self.index(to));
        Ok(self.between(field, from, to)?[row][column].clone())
    }

    fn between(&mut self, field: &mut Field, a: usize, b: usize) -> Result<Matrix, Obstacle> {
        if let Some(known) = self.frames.get(&(a, b)) {
            return Ok(known.clone());
        }
        let x = match a.cmp(&b) {
            std::cmp::Ordering::Equal => identity(),
            std::cmp::Ordering::Less => {
                let mut x = self.between(field, a, b - 1)?;
                for screw in &self.links[b - 1] {
                    x = product(field, &x, screw)?;
                }
                x
            }
            std::cmp::Ordering::Greater => {
                let forth = self.between(field, b, a)?;
                inverse(field, &forth)?
            }
        };
        self.frames.insert((a, b), x.clone());
        Ok(x)
    }

    /// An entry of a Jacobian, row and joint from 0: the sum over the rows before the body of θ' z × (p − o) + d' z, and of θ' z.
    ///
    /// # Errors
    /// If a product is too large.
    pub fn jacobian(
        &mut self,
        field: &mut Field,
        view: &View,
        row: usize,
        joint: usize,
    ) -> Result<Poly, Obstacle> {
        let (axes, at) = (self.index(view.axes), self.index(view.at));
        let mut shift = identity();
        for (row, e) in shift.iter_mut().zip(view.offset) {
            row[3] = field.polynomial(e)?;
        }
        let frame = self.between(field, axes, at)?;
        let point = product(field, &frame, &shift)?;
        let rows = match view.body {
            Frame::Base => 0,
            Frame::Behind(i) => i.min(self.moved.len()),
            Frame::Tool => self.moved.len(),
        };
        let q = field.symbol(self.joints[joint]).num;
        let mut total = Poly::zero();
        for i in 0..rows {
            let [turn, slide] = self.moved[i].map(|e| field.polynomial(e).map(|p| factor(&p, &q)));
            let (turn, slide) = (turn?, slide?);
            if turn.is_zero() && slide.is_zero() {
                continue;
            }
            let mut x = self.between(field, axes, i + 1)?;
            for screw in &self.links[i + 1][..self.before] {
                x = product(field, &x, screw)?;
            }
            let k = row % 3;
            let lever = |n: usize| point[n][3].minus(&x[n][3]);
            let twist = if row < 3 {
                let (n, m) = ((k + 1) % 3, (k + 2) % 3);
                let (a, b) = (field.times(&x[n][2], &lever(m))?, field.times(&x[m][2], &lever(n))?);
                a.minus(&b).scaled(&turn).plus(&x[k][2].scaled(&slide))
            } else {
                x[k][2].scaled(&turn)
            };
            total = total.plus(&twist);
        }
        Ok(total)
    }
}

/// The coefficient of an atom, where it stands alone.
pub(crate) fn factor(p: &Poly, atom: &Poly) -> Rational {
    let of = |m: &Monomial| p.terms().iter().find(|t| t.0 == *m).map(|t| t.1.clone());
    atom.terms().first().and_then(|t| of(&t.0)).unwrap_or(Rational::ZERO)
}

fn identity() -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|k| if i == k { Poly::one() } else { Poly::zero() }))
}

/// Rotation about and translation along x or z.
fn screw(field: &mut Field, is_x: bool, angle: Expr, length: Expr) -> Result<Matrix, Obstacle> {
    let (s, c) = field.sine(&Angle::of(angle))?;
    let d = field.polynomial(length)?;
    let minus = Poly::zero().minus(&s);
    let (one, zero) = (Poly::one(), Poly::zero);
    Ok(if is_x {
        [[one, zero(), zero(), d], [zero(), c.clone(), minus, zero()], [zero(), s, c, zero()]]
    } else {
        [[c.clone(), minus, zero(), zero()], [s, c, zero(), zero()], [zero(), zero(), one, d]]
    })
}

fn product(field: &mut Field, a: &Matrix, b: &Matrix) -> Result<Matrix, Obstacle> {
    let mut x = identity();
    for (i, row) in a.iter().enumerate() {
        for k in 0..4 {
            let mut sum = if k == 3 { row[3].clone() } else { Poly::zero() };
            for (p, other) in row.iter().zip(b) {
                sum = sum.plus(&field.times(p, &other[k])?);
            }
            x[i][k] = sum;
        }
    }
    Ok(x)
}

/// Rᵀ, −Rᵀp
fn inverse(field: &mut Field, x: &Matrix) -> Result<Matrix, Obstacle> {
    let turned: Matrix =
        std::array::from_fn(|i| std::array::from_fn(|k| if k < 3 { x[k][i].clone() } else { Poly::zero() }));
    let back = product(field, &turned, x)?;
    let mut inverse = turned;
    for (row, moved) in inverse.iter_mut().zip(back) {
        row[3] = Poly::zero().minus(&moved[3]);
    }
    Ok(inverse)
}
