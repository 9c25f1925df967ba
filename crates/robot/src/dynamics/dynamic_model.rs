//! The dynamic model of an arm as formulas.

use super::base::BaseModel;
use super::lagrange::{Ground, program};
use super::model::Formulas;
use super::representatives::{NoBasis, Representatives};
use super::short::shortest;
use crate::description::Description;
use crate::forward::symbol_order;
use denavit_program::Program;
use denavit_symbolic::{Expr, Node, Symbol, equal, readable};

/// Joints up to which the matrices are written out.
const WRITTEN_OUT: usize = 3;

/// The dynamic model as formulas.
#[derive(Clone, Debug)]
pub struct DynamicModel {
    /// The arm and its names.
    pub formulas: Formulas,
    /// The base parameters.
    pub base: BaseModel,
    /// The joint torques from q, q̇ and q̈, in base parameters.
    pub torques: Program,
    /// On what it rests that these are Lagrange's.
    pub ground: Ground,
    /// The parts of the torques, entry by entry, of arms with few joints.
    pub parts: Option<Parts>,
}

/// τ = A q̈ + C q̇ + Q, each entry as short as it was found.
#[derive(Clone, Debug)]
pub struct Parts {
    /// A(q), row by row.
    pub inertia: Vec<Vec<Expr>>,
    /// C(q, q̇) q̇, with friction.
    pub velocity: Vec<Expr>,
    /// Q(q).
    pub gravity: Vec<Expr>,
    /// On what it rests that their sum gives Lagrange's torques. A and Q have no rates, and C q̇ vanishes with them: each is the
    /// part that it is called, then.
    pub ground: Ground,
}

impl DynamicModel {
    /// The model of a description: its numbers for masses get Khalil and Dombre's names.
    pub fn derive(d: &Description) -> Self {
        Self::of(d, Formulas::named(d))
    }

    /// The same with the description's numbers as they are, gravity with them: what is 0 or equal among them shortens the program.
    pub fn with_numbers(d: &Description) -> Self {
        Self::of(d, Formulas::in_numbers(d))
    }

    /// The model of a description with representatives of the base parameters as they are wanted.
    ///
    /// # Errors
    /// If there are none.
    pub fn derive_for(d: &Description, wanted: &Representatives) -> Result<Self, NoBasis> {
        let formulas = Formulas::named(d);
        let base = BaseModel::derive_for(d, &formulas, wanted)?;
        Ok(Self::in_base(d, formulas, base))
    }

    /// The model of a whole tree, by the recursion in base parameters: no frames are searched.
    pub fn of_tree(formulas: Formulas) -> Self {
        let base = BaseModel::of_tree(&formulas);
        Self::of_tree_in_base(formulas, base)
    }

    /// The same with representatives of the base parameters as they are wanted.
    ///
    /// # Errors
    /// If there are none.
    pub fn of_tree_for(formulas: Formulas, wanted: &Representatives) -> Result<Self, NoBasis> {
        let base = BaseModel::of_tree_for(&formulas, wanted)?;
        Ok(Self::of_tree_in_base(formulas, base))
    }

    fn of_tree_in_base(formulas: Formulas, base: BaseModel) -> Self {
        let short = base.inverse.shortened(0);
        let ground = base.ground_of_tree(&formulas, &short);
        let (torques, ground) = match ground {
            Ground::Failed => (base.inverse.clone(), base.ground_of_tree(&formulas, &base.inverse)),
            _ => (short, ground),
        };
        let torques = named_apart(torques, &formulas);
        DynamicModel { formulas, base, torques, ground, parts: None }
    }

    /// The model of formulas.
    pub(super) fn of(d: &Description, formulas: Formulas) -> Self {
        let base = BaseModel::derive(d, &formulas);
        Self::in_base(d, formulas, base)
    }

    fn in_base(d: &Description, formulas: Formulas, base: BaseModel) -> Self {
        let torques = shortest(d, &formulas, &base);
        let ground = base.ground(d, &formulas, &torques);
        // What was searched is held against the definition, and left if it is not that.
        let (torques, ground) = match ground {
            Ground::Failed => (base.inverse.clone(), base.ground(d, &formulas, &base.inverse)),
            _ => (torques, ground),
        };
        let torques = named_apart(torques, &formulas);
        let parts = (formulas.q.len() <= WRITTEN_OUT).then(|| Parts::new(d, &formulas, &base));
        DynamicModel { formulas, base, torques, ground, parts: parts.flatten() }
    }
}

/// The program with names that no parameter has: those that groupings stand for are none of its inputs.
fn named_apart(torques: Program, formulas: &Formulas) -> Program {
    torques.named_apart(&formulas.parameters.iter().map(|p| p.symbol.name().to_string()).collect())
}

impl DynamicModel {
    /// What the program of the torques and the groupings divide by: where one of these is 0 they do not hold.
    pub fn divisors(&self) -> Vec<Expr> {
        let mut found = self.torques.divisors();
        let groupings: Vec<Expr> = self.base.parameters.iter().map(|p| p.value).collect();
        for e in Expr::postorder(&groupings) {
            let below = match e.node() {
                Node::Div(_, b) => b,
                Node::Pow(b, n) if n < 0 => b,
                _ => continue,
            };
            if !below.symbols().is_empty() && !found.contains(&below) {
                found.push(below);
            }
        }
        found
    }
}

impl Parts {
    /// The parts of torques; nothing if one is too large.
    fn new(d: &Description, formulas: &Formulas, base: &BaseModel) -> Option<Self> {
        let mut order = symbol_order(d);
        order.extend(base.parameters.iter().map(|p| p.symbol));
        order.extend(formulas.qd.iter().chain(&formulas.qdd));
        let simple = |e: Expr| readable::simplify(e, &order).ok().map(|s| s.expr);
        // The plain recursion: the short program may have lengths in a unit of its own.
        let all = base.inverse.formulas();
        let with = |e: Expr, of: &dyn Fn(Symbol) -> Option<i64>| e.substitute(|s| of(s).map(Expr::int));
        let is = |all: &[Symbol], s: Symbol| all.contains(&s);
        let resting = |s: Symbol| (is(&formulas.qd, s) || is(&formulas.qdd, s)).then_some(0);
        let gravity: Vec<Expr> = all.iter().map(|&e| simple(with(e, &resting))).collect::<Option<_>>()?;
        let coasting = |s: Symbol| is(&formulas.qdd, s).then_some(0);
        let velocity: Vec<Expr> =
            all.iter().map(|&e| simple(with(e, &coasting) - with(e, &resting))).collect::<Option<_>>()?;
        let entry = |e: Expr, j: usize| {
            let pulled = |s: Symbol| if s == formulas.qdd[j] { Some(1) } else { resting(s) };
            simple(with(e, &pulled) - with(e, &resting))
        };
        let row = |&e: &Expr| (0..formulas.q.len()).map(|j| entry(e, j)).collect::<Option<Vec<Expr>>>();
        let inertia: Vec<Vec<Expr>> = all.iter().map(row).collect::<Option<_>>()?;
        let moving = |s: &Symbol| is(&formulas.qd, *s) || is(&formulas.qdd, *s);
        let is_still = |e: &Expr| !e.symbols().iter().any(moving);
        let are_parts = inertia.iter().flatten().chain(&gravity).all(is_still)
            && velocity.iter().all(|&e: &Expr| equal(with(e, &resting), Expr::int(0)).is_equal());
        let [_, _, qdd] = formulas.state();
        let torque = |j: usize| {
            let pulled = inertia[j].iter().zip(&qdd).fold(Expr::int(0), |sum, (&a, &x)| sum + a * x);
            pulled + velocity[j] + gravity[j]
        };
        let torques: Vec<Expr> = (0..gravity.len()).map(torque).collect();
        let ground = match are_parts {
            true => base.ground(d, formulas, &program(base.inverse.variables(), &torques)),
            false => Ground::Failed,
        };
        // What is not the torque's part is not printed as one.
        (ground != Ground::Failed).then_some(Parts { inertia, velocity, gravity, ground })
    }
}
