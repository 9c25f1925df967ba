//! Claims, each an equality with the cofactors that prove it, put together one by one.

use crate::arm::{Arm, Frame, View};
use crate::field::{Field, MOST_TERMS, Obstacle, Value};
use crate::names::Names;
use denavit::description::{Cell, Description};
use denavit_symbolic::poly::{Atom, Poly};
use denavit_symbolic::{Angle, Expr, Node, Rational, Symbol};
use rustc_hash::FxHashMap;

/// What a claim or a definition speaks of. Rows, columns and joints count from 0.
#[derive(Clone, Debug)]
pub enum Quantity {
    /// A formula.
    Formula(Expr),
    /// A polynomial in atoms.
    Terms(Poly),
    /// An entry of frame `to` in frame `from`, by the table.
    Frame {
        /// In which frame.
        from: Frame,
        /// Which frame.
        to: Frame,
        /// Row and column.
        place: (usize, usize),
    },
    /// An entry of a Jacobian, by the table.
    Jacobian {
        /// Which Jacobian.
        view: View,
        /// Its row.
        row: usize,
        /// The joint.
        joint: usize,
    },
    /// A determinant of entries claimed before, developed along a row.
    Minor {
        /// Of which Jacobian.
        view: View,
        /// Its rows.
        rows: Vec<usize>,
        /// Its columns.
        joints: Vec<usize>,
        /// Which row.
        along: usize,
    },
}

/// `left = right`.
#[derive(Clone, Debug)]
pub struct Claim {
    /// What it is called.
    pub name: String,
    /// One side.
    pub left: Quantity,
    /// The other.
    pub right: Quantity,
    /// Atoms whose squares are known, and by what x² − square is multiplied.
    pub cofactors: Vec<(Atom, Poly)>,
}

/// A certificate: claims about a robot that stand on its table alone.
pub struct Certificate {
    /// The robot.
    pub description: Description,
    /// Atoms.
    pub field: Field,
    /// Joint variables.
    pub variables: Vec<Symbol>,
    /// Names for quantities, in order.
    pub definitions: Vec<(Symbol, Quantity)>,
    /// What is proved.
    pub claims: Vec<Claim>,
    /// What could not be, and why.
    pub missing: Vec<(String, Obstacle)>,
    pub(crate) arm: Result<Arm, Obstacle>,
    /// Entries and minors that are proved, as they are claimed.
    proved: FxHashMap<(View, Vec<usize>, Vec<usize>), Poly>,
    terms: usize,
}

/// Terms of all polynomials of a certificate together.
pub const MOST_TERMS_IN_ALL: usize = 400_000;

impl Certificate {
    /// One without claims, for claims made of these formulas.
    pub fn new(description: &Description, formulas: &[Expr]) -> Self {
        let mut parts: FxHashMap<Symbol, i64> = FxHashMap::default();
        let rows = &description.rows;
        let cells = rows.iter().flat_map(|r| [r.theta, r.alpha, r.gamma]);
        let mut angles: Vec<Angle> = cells.map(Angle::of).collect();
        let ends = description.base.matrix().into_iter().chain(description.tool.matrix()).flatten();
        let formulas: Vec<Expr> = formulas.iter().copied().chain(ends).collect();
        for e in Expr::postorder(&formulas) {
            if let Node::Sin(a) | Node::Cos(a) = e.node() {
                angles.push(Angle::of(a));
            }
        }
        for (x, k) in angles.iter().flat_map(|a| &a.terms) {
            if let (Some(s), Some((_, d))) = (x.as_symbol(), k.to_parts()) {
                let part = parts.entry(s).or_insert(1);
                *part = least_common_multiple(*part, d);
            }
        }
        let mut field = Field::new(Names::default(), parts);
        let variables: Vec<Symbol> = description.variables().iter().map(|v| v.symbol).collect();
        variables.iter().for_each(|v| drop(field.symbol(*v)));
        field.parameters.clear();
        let arm = Arm::new(description, &mut field);
        Certificate {
            description: description.clone(),
            field,
            variables,
            definitions: vec![],
            claims: vec![],
            missing: vec![],
            arm,
            proved: FxHashMap::default(),
            terms: 0,
        }
    }

    /// Gives a quantity a name, unless it cannot be expanded.
    ///
    /// # Errors
    /// Why it cannot.
    pub fn define(&mut self, name: Symbol, quantity: Quantity) -> Result<(), Obstacle> {
        self.field.begin_claim();
        let value = self.value(&quantity)?;
        if self.field.knows(name) {
            return Err(Obstacle::Function);
        }
        self.field.names.of(name);
        self.field.define(name, value);
        self.definitions.push((name, quantity));
        Ok(())
    }

    /// What a quantity is.
    fn value(&mut self, quantity: &Quantity) -> Result<Value, Obstacle> {
        if let Quantity::Formula(e) = quantity {
            return self.field.value(*e);
        }
        let field = &mut self.field;
        let arm = self.arm.as_mut().map_err(|why| *why);
        Ok(Value::from(match quantity {
            Quantity::Formula(_) => Poly::zero(),
            Quantity::Terms(p) => p.clone(),
            Quantity::Frame { from, to, place } => arm?.entry(field, *from, *to, *place)?,
            Quantity::Jacobian { view, row, joint } => arm?.jacobian(field, view, *row, *joint)?,
            Quantity::Minor { view, rows, joints, along } => {
                let rest: Vec<usize> = rows.iter().copied().filter(|r| r != along).collect();
                let at = rows.iter().position(|r| r == along).ok_or(Obstacle::Undefined)?;
                let known = |rows: Vec<usize>, joints: Vec<usize>| {
                    self.proved.get(&(view.clone(), rows, joints)).cloned().ok_or(Obstacle::Undefined)
                };
                let mut total = Poly::zero();
                for (k, &joint) in joints.iter().enumerate() {
                    let entry = known(vec![*along], vec![joint])?;
                    if entry.is_zero() {
                        continue;
                    }
                    let others: Vec<usize> = joints.iter().copied().filter(|&j| j != joint).collect();
                    let smaller = if rest.is_empty() { Poly::one() } else { known(rest.clone(), others)? };
                    let sign = Rational::from(if (at + k) % 2 == 0 { 1 } else { -1 });
                    total = total.plus(&field.times(&entry, &smaller)?.scaled(&sign));
                }
                total
            }
        }))
    }

    /// Claims that two quantities are equal; what cannot be proved is noted as missing.
    pub fn claim(&mut self, name: impl Into<String>, left: Quantity, right: Quantity) {
        let name = name.into();
        self.field.begin_claim();
        match self.proof(&left, &right) {
            Ok((cofactors, right_value)) => {
                self.keep(&left, right_value);
                self.claims.push(Claim { name, left, right, cofactors });
            }
            Err(why) => self.missing.push((name, why)),
        }
    }

    fn proof(&mut self, left: &Quantity, right: &Quantity) -> Result<(Vec<(Atom, Poly)>, Value), Obstacle> {
        let (a, b) = (self.value(left)?, self.value(right)?);
        let field = &mut self.field;
        let (x, y) = (field.times(&a.num, &b.den)?, field.times(&b.num, &a.den)?);
        let (cofactors, rest) = field.reduced(&x.minus(&y))?;
        if !rest.is_zero() {
            return Err(Obstacle::NoIdentity);
        }
        self.spend(cofactors.iter().map(|c| &c.1))?;
        Ok((cofactors, b))
    }

    fn spend<'a>(&mut self, polynomials: impl Iterator<Item = &'a Poly>) -> Result<(), Obstacle> {
        let terms: usize = polynomials.map(|p| p.terms().len()).sum();
        if terms > MOST_TERMS || self.terms + terms > MOST_TERMS_IN_ALL {
            return Err(Obstacle::TooLarge);
        }
        self.terms += terms;
        Ok(())
    }

    /// Later minors are made of what is claimed of entries and smaller minors.
    fn keep(&mut self, left: &Quantity, value: Value) {
        let key = match left {
            Quantity::Jacobian { view, row, joint } => (view.clone(), vec![*row], vec![*joint]),
            Quantity::Minor { view, rows, joints, .. } if rows.len() > 1 => {
                (view.clone(), rows.clone(), joints.clone())
            }
            _ => return,
        };
        if value.den == Poly::one() {
            self.proved.insert(key, value.num);
        }
    }

    /// Claims that a determinant is this formula, with all smaller ones that are needed.
    pub fn determinant(&mut self, name: &str, view: &View, rows: &[usize], joints: &[usize], formula: Expr) {
        match self.smaller(view, rows, joints) {
            Ok(along) => {
                let (rows, joints) = (rows.to_vec(), joints.to_vec());
                let left = Quantity::Minor { view: view.clone(), rows, joints, along };
                self.claim(name, left, Quantity::Formula(formula));
            }
            Err(why) => self.missing.push((name.into(), why)),
        }
    }

    /// The row with the most zeros, along which a determinant is developed; the minors for that are claimed.
    fn smaller(&mut self, view: &View, rows: &[usize], joints: &[usize]) -> Result<usize, Obstacle> {
        let entry = |c: &Self, row: usize, joint: usize| {
            c.proved.get(&(view.clone(), vec![row], vec![joint])).cloned().ok_or(Obstacle::Undefined)
        };
        let mut best: Option<(usize, usize)> = None;
        for &row in rows {
            let mut filled = 0;
            for &joint in joints {
                filled += usize::from(!entry(self, row, joint)?.is_zero());
            }
            if best.is_none_or(|b| filled < b.0) {
                best = Some((filled, row));
            }
        }
        let along = best.ok_or(Obstacle::Undefined)?.1;
        self.field.begin_claim();
        let rest: Vec<usize> = rows.iter().copied().filter(|&r| r != along).collect();
        for &joint in joints {
            let others: Vec<usize> = joints.iter().copied().filter(|&j| j != joint).collect();
            let is_known = self.proved.contains_key(&(view.clone(), rest.clone(), others.clone()));
            if rest.len() > 1 && !is_known && !entry(self, along, joint)?.is_zero() {
                let along = self.smaller(view, &rest, &others)?;
                let left =
                    Quantity::Minor { view: view.clone(), rows: rest.clone(), joints: others.clone(), along };
                let value = self.value(&left)?;
                let (cofactors, right) = self.field.reduced(&value.num)?;
                self.spend(cofactors.iter().map(|c| &c.1).chain([&right]))?;
                self.keep(&left, right.clone().into());
                let number = |all: &[usize]| all.iter().map(|k| (k + 1).to_string()).collect::<String>();
                let name = format!("minor {} {}", number(&rest), number(&others));
                self.claims.push(Claim { name, left, right: Quantity::Terms(right), cofactors });
            }
        }
        Ok(along)
    }

    /// The cells of a row, as the certificate lists them.
    pub fn cells(&self, row: usize) -> Vec<(Cell, Expr)> {
        let cells = crate::arm::order(self.description.convention).iter().flatten();
        cells.map(|c| (*c, c.of(&self.description.rows[row]))).collect()
    }
}

fn least_common_multiple(a: i64, b: i64) -> i64 {
    let (mut x, mut y) = (a, b);
    while y != 0 {
        (x, y) = (y, x % y);
    }
    (a / x).saturating_mul(b)
}
