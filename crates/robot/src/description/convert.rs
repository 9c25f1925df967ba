//! From one convention to another, exactly, and the proof that two chains are the same.
//!
//! With X = Rx(α)·Tx(a) and Z = Rz(θ)·Tz(d), a row is Z·X in the standard convention and X·Z in Craig's and
//! Khalil's. The same product is cut at other places: each X moves to the neighbouring row, and the one at the
//! end of the chain becomes part of the base or of the tool.

use super::{Convention, Description, Screw, same_screws};
use crate::geometry::{Axis, Transform};
use denavit_symbolic::{Angle, Equality, Expr, Refusal, Ring, equal};

/// A description in another convention.
#[derive(Clone, Debug)]
pub struct Conversion {
    /// The same robot.
    pub description: Description,
    /// What moved into the base, the tool or neighbouring rows.
    pub moved: Vec<Moved>,
}

/// What a conversion moved, because the other convention has no place for it. Rows are counted from 0.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Moved {
    /// γ and b of the first row into the base.
    BranchToBase,
    /// γ and b of the next row into this one.
    BranchToRow(usize),
    /// The turn about x and the length along it of the first row into the base.
    FirstToBase,
    /// Those of the last row into the tool.
    LastToTool,
}

/// Whether two descriptions are the same function from joint variables to the pose of the tool.
#[derive(Clone, PartialEq, Debug)]
pub enum SameChain {
    /// Proved: base, rows and tool multiply to the same matrix.
    Equal,
    /// Proved different.
    Different {
        /// An entry of the 4×4 matrix that differs, row and column counted from 0.
        entry: (usize, usize),
    },
    /// Neither was proved.
    Undecided,
}

impl SameChain {
    /// True if proved equal.
    pub fn is_equal(&self) -> bool {
        *self == SameChain::Equal
    }
}

fn x_screw(angle: Expr, length: Expr) -> Screw {
    Screw { axis: Axis::X, angle, length }
}

fn z_screw(angle: Expr, length: Expr) -> Screw {
    Screw { axis: Axis::Z, angle, length }
}

/// The sum in its normal order, so that q + π/2 − π/2 is q.
fn plus(a: Expr, b: Expr) -> Expr {
    if b.is_zero() { a } else { Angle::of(a + b).to_expr() }
}

impl Description {
    /// The same robot in another convention; joints keep their variables, names and limits.
    ///
    /// Where the frame of a link moves, its centre of mass and inertia are expressed in the new one.
    pub fn converted(&self, to: Convention) -> Conversion {
        let mut d = self.clone();
        let mut moved = vec![];
        let from = self.convention;
        d.convention = to;
        if from == Convention::Khalil && to != Convention::Khalil {
            d.fold_branches(&mut moved);
        }
        match (from == Convention::Standard, to == Convention::Standard) {
            (false, true) => d.shift_to_standard(&mut moved),
            (true, false) => d.shift_from_standard(&mut moved),
            _ => {}
        }
        Conversion { description: d, moved }
    }

    /// Rz(γ)·Tz(b) before a row goes to the Z of the row before, or to the base.
    fn fold_branches(&mut self, moved: &mut Vec<Moved>) {
        for i in 0..self.rows.len() {
            let branch = z_screw(self.rows[i].gamma, self.rows[i].b);
            if branch.is_identity() {
                continue;
            }
            (self.rows[i].gamma, self.rows[i].b) = (Expr::int(0), Expr::int(0));
            if i == 0 {
                self.base = self.base * branch.transform();
                moved.push(Moved::BranchToBase);
            } else {
                let before = &mut self.rows[i - 1];
                before.theta = plus(before.theta, branch.angle);
                before.d = plus(before.d, branch.length);
                before.move_frame(&branch.transform().inverse());
                moved.push(Moved::BranchToRow(i - 1));
            }
        }
    }

    /// X₁Z₁ X₂Z₂ … XₙZₙ = X₁ · Z₁X₂ · Z₂X₃ … Zₙ
    fn shift_to_standard(&mut self, moved: &mut Vec<Moved>) {
        let screws: Vec<Screw> = self.rows.iter().map(|r| x_screw(r.alpha, r.a)).collect();
        if let Some(first) = screws.first().filter(|s| !s.is_identity()) {
            self.base = self.base * first.transform();
            moved.push(Moved::FirstToBase);
        }
        let behind = screws.into_iter().skip(1).chain([x_screw(Expr::int(0), Expr::int(0))]);
        for (row, x) in self.rows.iter_mut().zip(behind) {
            (row.alpha, row.a) = (x.angle, x.length);
            row.move_frame(&x.transform().inverse());
        }
    }

    /// Z₁X₁ Z₂X₂ … ZₙXₙ = Z₁ · X₁Z₂ · X₂Z₃ … · Xₙ
    fn shift_from_standard(&mut self, moved: &mut Vec<Moved>) {
        let mut x = x_screw(Expr::int(0), Expr::int(0));
        for row in &mut self.rows {
            let own = x_screw(row.alpha, row.a);
            (row.alpha, row.a) = (x.angle, x.length);
            row.move_frame(&own.transform());
            x = own;
        }
        if !x.is_identity() {
            self.tool = x.transform() * self.tool;
            moved.push(Moved::LastToTool);
        }
    }

    /// The chain as screws, neighbours on one axis merged, without identities.
    fn screws(&self) -> Vec<Screw> {
        let mut screws: Vec<Screw> = vec![];
        for row in &self.rows {
            for screw in row.screws(self.convention) {
                if let Some(last) = screws.last_mut().filter(|l| l.axis == screw.axis) {
                    last.angle = Angle::of(last.angle + screw.angle).to_expr();
                    last.length = Angle::of(last.length + screw.length).to_expr();
                } else {
                    let normal = |e| Angle::of(e).to_expr();
                    screws.push(Screw { angle: normal(screw.angle), length: normal(screw.length), ..screw });
                }
                if screws.last().is_some_and(Screw::is_identity) {
                    screws.pop();
                }
            }
        }
        screws
    }

    /// The constant ends of the chain multiplied into base and tool.
    pub(super) fn core(&self) -> (Transform<Expr>, Vec<Screw>, Transform<Expr>) {
        let variables = self.variables();
        let mut screws = self.screws();
        let moves = |s: &Screw| {
            let symbols = [s.angle.symbols(), s.length.symbols()].concat();
            symbols.iter().any(|&s| variables.iter().any(|v| v.symbol == s))
        };
        let first = screws.iter().position(moves).unwrap_or(screws.len());
        let base = screws.drain(..first).fold(self.base, |x, s| x * s.transform());
        let last = screws.iter().rposition(moves).map_or(0, |i| i + 1);
        let tool = screws.drain(last..).rev().fold(self.tool, |x, s| s.transform() * x);
        (base, screws, tool)
    }
}

/// Proves that two descriptions take the same joint variables to the same pose, or that they do not.
///
/// Chains that are the same screws cut in other places are compared screw by screw, those with the same axes at rest axis by
/// axis ([`same_screws`]), whatever their length; others by the product of all their transforms.
pub fn prove_same_chain(a: &Description, b: &Description) -> SameChain {
    let ((base_a, core_a, tool_a), (base_b, core_b, tool_b)) = (a.core(), b.core());
    if core_a == core_b
        && same_transform(&base_a, &base_b).is_equal()
        && same_transform(&tool_a, &tool_b).is_equal()
    {
        return SameChain::Equal;
    }
    if same_screws(a, b) {
        return SameChain::Equal;
    }
    let product =
        |base, core: &[Screw], tool| core.iter().fold(base, |x: Transform<Expr>, s| x * s.transform()) * tool;
    same_transform(&product(base_a, &core_a, tool_a), &product(base_b, &core_b, tool_b))
}

/// Compares two transforms entry by entry in one ring.
fn same_transform(a: &Transform<Expr>, b: &Transform<Expr>) -> SameChain {
    if a == b {
        return SameChain::Equal;
    }
    let (a, b) = (a.matrix(), b.matrix());
    let pairs: Vec<(usize, usize)> =
        (0..12).map(|k| (k / 4, k % 4)).filter(|&(i, j)| a[i][j] != b[i][j]).collect();
    let differences: Vec<Expr> = pairs.iter().map(|&(i, j)| a[i][j] - b[i][j]).collect();
    let mut ring = Ring::new(&differences, &[]);
    let mut verdict = SameChain::Equal;
    for (&entry, &difference) in pairs.iter().zip(&differences) {
        match ring.normal(difference) {
            Ok(form) if form.num.is_zero() => continue,
            Ok(_) | Err(Refusal::OutsideBasis | Refusal::Undefined) => {}
            Err(Refusal::TooLarge) => return SameChain::Undecided,
        }
        match equal(difference, Expr::int(0)) {
            Equality::Equal { .. } => {}
            Equality::Different { .. } => return SameChain::Different { entry },
            Equality::Undecided(_) => verdict = SameChain::Undecided,
        }
    }
    verdict
}
