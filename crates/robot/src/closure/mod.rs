//! Closed loops in numbers: how a linkage can be assembled where its driven joints are, and how its passive joints move with them.
//!
//! - [`Loops`]: a linkage to compute with; [`Assembly`]: one way to close it.
//! - [`Loops::rates`]: the velocities of passive joints, the Jacobian of a frame, both kinds of singularities.
//! - [`ClosedInverse`]: the configurations in which a frame is where it is wanted.
//! - [`findings`]: what is to be said of a linkage: its mobility, and whether it closes.

mod dyads;
mod findings;
mod inverse;
mod linear;
mod newton;
mod rates;

pub use dyads::Met;
pub use findings::{Mobility, compare, findings, mobility};
pub use inverse::{ClosedAnswer, ClosedInverse, ClosedSolution, NoInverse};
pub use rates::Rates;

use crate::description::linkage::{Linkage, Mode, NoMode, Plan, is_passive};
use crate::description::{Convention, JointKind, NoChain};
use crate::geometry::Transform;
use crate::mechanism::robot::{Link, MissingValue, link_of};
use denavit_symbolic::{Expr, Symbol};
use dyads::Compiled;

/// A linkage over numbers.
pub struct Loops {
    linkage: Linkage,
    plan: Plan,
    steps: Vec<Compiled>,
    base: Transform<f64>,
    /// The rows, and what each stands on.
    links: Vec<(Link<f64>, Option<usize>)>,
    /// Both sides of each closure, likewise.
    sides: Vec<[(Link<f64>, Option<usize>); 2]>,
    /// Named frames: their row, and their pose there.
    frames: Vec<(String, Option<usize>, Transform<f64>)>,
    /// The passive variables that no step finds, by their places among all.
    rest: Vec<usize>,
    driven: Vec<JointKind>,
    passive: Vec<JointKind>,
    /// The longest of its lengths.
    size: f64,
}

/// A frame that does not move on a row: the row, none for frame 0, and its pose there.
pub type Place = (Option<usize>, Transform<f64>);

/// One way to close a linkage.
#[derive(Clone, PartialEq, Debug)]
pub struct Assembly {
    /// Its mode.
    pub mode: Mode,
    /// The passive variables, p1 first.
    pub passive: Vec<f64>,
    /// How far the frames of a closure are from each other at most: metres, and sines of angles.
    pub residual: f64,
    /// The closures at which modes meet: flat, or dead points.
    pub flat: Vec<usize>,
    /// Whether a part of it was found by descent, so that there may be others.
    pub is_numeric: bool,
}

/// Why a linkage is not closed in a mode.
#[derive(Clone, PartialEq, Debug)]
pub enum Open {
    /// This loop does not reach: its sides stay so far apart.
    Gap {
        /// The closure.
        closure: usize,
        /// Metres; nothing of a spherical loop, in which directions do not reach one another.
        metres: Option<f64>,
    },
    /// The two places between which the dyad of this loop stands coincide: it is closed by infinitely many configurations, or by none.
    Indeterminate {
        /// The closure.
        closure: usize,
    },
    /// A loop before it meets its other mode, where its angle is not known well enough to say whether this one closes.
    Undecided {
        /// The closure.
        closure: usize,
    },
    /// No descent ended where the loops close.
    NotFound,
    /// What is solved closes, and this loop, of which nothing is unknown any more, does not.
    Contradicts {
        /// The closure.
        closure: usize,
        /// By how much.
        gap: f64,
    },
}

/// Frames that are closer are closed: places by the size of the linkage, and sines of angles.
const CLOSED: f64 = 1e-9;

impl Loops {
    /// A linkage with the values of its parameters.
    ///
    /// # Errors
    /// If a parameter that it needs has no value.
    pub fn new(linkage: &Linkage) -> Result<Self, MissingValue> {
        let open = linkage.open_names();
        if !open.is_empty() {
            return Err(MissingValue { parameters: open });
        }
        let linkage = linkage.in_numbers();
        let plan = Plan::of(&linkage);
        let number = |e: Expr| e.eval(|_| None).unwrap_or(f64::NAN);
        let (driven, passive) = (linkage.driven(), linkage.passive());
        let symbols: Vec<Symbol> = driven.iter().chain(&passive).map(|v| v.symbol).collect();
        let link = |row| link_of(Convention::Khalil, row, &symbols).in_numbers(number);
        let links: Vec<(Link<f64>, Option<usize>)> =
            linkage.tree.rows.iter().map(link).zip(linkage.tree.after.iter().copied()).collect();
        let sides: Vec<[(Link<f64>, Option<usize>); 2]> = linkage
            .closures
            .iter()
            .map(|c| [&c.left, &c.right].map(|side| (link(&side.row), side.after)))
            .collect();
        let frames = linkage.tree.frames.iter();
        let frames = frames.map(|f| (f.name.clone(), f.on, f.pose.map(number))).collect();
        let steps: Vec<Compiled> = plan.steps.iter().map(|s| Compiled::of(s, &symbols)).collect();
        let found: Vec<Symbol> = plan.steps.iter().flat_map(|s| s.unknowns()).collect();
        let is_left = |k: &usize| is_passive(symbols[*k]) && !found.contains(&symbols[*k]);
        let rest = (0..symbols.len()).filter(is_left).collect();
        let all = links.iter().map(|l| &l.0).chain(sides.iter().flatten().map(|s| &s.0));
        let size = all.map(|l| l.before.translation.norm() + l.d.offset.abs()).fold(0.0, f64::max);
        Ok(Loops {
            steps,
            base: linkage.tree.base.map(number),
            links,
            sides,
            frames,
            rest,
            driven: driven.iter().map(|v| v.kind).collect(),
            passive: passive.iter().map(|v| v.kind).collect(),
            size: if size > 0.0 { size } else { 1.0 },
            plan,
            linkage,
        })
    }

    /// How its loops are solved, with the values of its parameters.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// The linkage, with the values of its parameters.
    pub fn linkage(&self) -> &Linkage {
        &self.linkage
    }

    /// The mode of this name or of these signs; that which is meant where nothing is asked for.
    ///
    /// # Errors
    /// If there is none.
    pub fn mode(&self, asked: Option<&str>) -> Result<Mode, NoMode> {
        self.linkage.mode(&self.plan, asked)
    }

    /// What each driven joint does, q1 first.
    pub fn driven(&self) -> &[JointKind] {
        &self.driven
    }

    /// What each passive joint does, p1 first.
    pub fn passive(&self) -> &[JointKind] {
        &self.passive
    }

    /// The place of a frame by its name: its row, and its pose there; that at which a chain would end where none is named.
    ///
    /// # Errors
    /// If there is none.
    pub fn place(&self, name: Option<&str>) -> Result<(String, Place), NoChain> {
        let name = self.linkage.tree.end(None, name)?;
        if let Some(f) = self.frames.iter().find(|f| f.0 == name) {
            return Ok((name, (f.1, f.2)));
        }
        let row = self.linkage.tree.row_of(&name);
        Ok((name, (row, Transform::identity())))
    }

    /// All ways to close it that are found where the driven joints are, in the order of their modes.
    ///
    /// # Panics
    /// If there is not one value for each driven joint.
    pub fn assemblies(&self, q: &[f64]) -> Vec<Assembly> {
        self.tried(q).into_iter().filter_map(|(_, found)| found.ok()).collect()
    }

    /// What comes of each mode where the driven joints are; of very many of the first ([`Plan::modes`], of [`Plan::count`]).
    ///
    /// # Panics
    /// If there is not one value for each driven joint.
    pub fn tried(&self, q: &[f64]) -> Vec<(Mode, Result<Assembly, Open>)> {
        self.plan.modes().into_iter().map(|mode| (mode.clone(), self.assembly(q, &mode))).collect()
    }

    /// The way to close it in a mode.
    ///
    /// # Errors
    /// If there is none, or none was found.
    ///
    /// # Panics
    /// If there is not one value for each driven joint, and one sign for each step.
    pub fn assembly(&self, q: &[f64], mode: &Mode) -> Result<Assembly, Open> {
        self.assembly_near(q, mode, None)
    }

    /// The way to close it in a mode; loops that are sought by descent are sought near to these passive variables.
    ///
    /// # Errors
    /// If there is none, or none was found.
    ///
    /// # Panics
    /// If there is not one value for each driven joint, one sign for each step, and one value for each passive joint.
    pub fn assembly_near(&self, q: &[f64], mode: &Mode, near: Option<&[f64]>) -> Result<Assembly, Open> {
        assert_eq!(q.len(), self.driven.len(), "one value for each driven joint");
        assert_eq!(mode.0.len(), self.steps.len(), "one sign for each step");
        let mut all = q.to_vec();
        match near {
            Some(p) => {
                assert_eq!(p.len(), self.passive.len(), "one value for each passive joint");
                all.extend_from_slice(p);
            }
            None => all.resize(q.len() + self.passive.len(), 0.0),
        }
        let mut flat = vec![];
        for (step, &sign) in self.steps.iter().zip(&mode.0) {
            match step.solve(&mut all, sign) {
                Ok(Met::Meets) => flat.push(step.closure),
                Ok(Met::Apart) => {}
                Err(_) if !flat.is_empty() => return Err(Open::Undecided { closure: step.closure }),
                Err(why) => return Err(why),
            }
        }
        if !self.rest.is_empty() {
            self.descend(&mut all, near.is_some()).ok_or(Open::NotFound)?;
        }
        let apart = self.apart(&all);
        if let Some(closure) = self.first_apart(&all) {
            return Err(match flat.is_empty() {
                true => Open::Contradicts { closure, gap: apart[closure] },
                false => Open::Undecided { closure },
            });
        }
        let residual = apart.into_iter().fold(0.0, f64::max);
        let is_numeric = !self.rest.is_empty();
        Ok(Assembly { mode: mode.clone(), passive: all.split_off(q.len()), residual, flat, is_numeric })
    }

    /// Whether all loops close there.
    ///
    /// # Panics
    /// If there is not one value for each joint.
    pub fn is_closed(&self, q: &[f64], p: &[f64]) -> bool {
        self.first_apart(&self.all(q, p)).is_none()
    }

    /// All variables: the driven and the passive ones.
    fn all(&self, q: &[f64], p: &[f64]) -> Vec<f64> {
        assert_eq!((q.len(), p.len()), (self.driven.len(), self.passive.len()), "one value for each joint");
        [q, p].concat()
    }

    /// The frames of all rows in the base.
    ///
    /// # Panics
    /// If there is not one value for each joint.
    pub fn frames(&self, q: &[f64], p: &[f64]) -> Vec<Transform<f64>> {
        self.placed(&self.all(q, p))
    }

    /// The frame of a row or of a name in the base.
    ///
    /// # Panics
    /// If there is not one value for each joint.
    pub fn pose(&self, place: &Place, q: &[f64], p: &[f64]) -> Transform<f64> {
        let frames = self.frames(q, p);
        place.0.map_or(self.base, |row| frames[row]) * place.1
    }

    fn placed(&self, all: &[f64]) -> Vec<Transform<f64>> {
        let mut frames: Vec<Transform<f64>> = vec![];
        for (link, on) in &self.links {
            let before = on.map_or(self.base, |row| frames[row]);
            frames.push(before * link.transform(all));
        }
        frames
    }

    /// How far the frames of each closure are from each other.
    fn apart(&self, all: &[f64]) -> Vec<f64> {
        let frames = self.placed(all);
        let one = |sides: &[(Link<f64>, Option<usize>); 2]| {
            let [a, b] = sides.each_ref().map(|s| self.side(&frames, s, all));
            let (x, y) = (a.matrix(), b.matrix());
            let entries = x.as_flattened().iter().zip(y.as_flattened());
            // What is no number is far.
            entries.map(|(x, y)| (x - y).abs()).fold(0.0, |m: f64, x| if x <= m { m } else { x })
        };
        self.sides.iter().map(one).collect()
    }

    /// The first closure that is not closed: places by the size of the linkage, directions by themselves.
    fn first_apart(&self, all: &[f64]) -> Option<usize> {
        let frames = self.placed(all);
        let is_closed = |sides: &[(Link<f64>, Option<usize>); 2]| {
            let [a, b] = sides.each_ref().map(|s| self.side(&frames, s, all));
            let place = (a.translation - b.translation).norm();
            let (x, y) = (a.rotation.rows(), b.rotation.rows());
            let turn = x.as_flattened().iter().zip(y.as_flattened()).map(|(x, y)| (x - y).abs());
            // What is no number is far.
            place <= CLOSED * self.size && turn.into_iter().all(|x| x <= CLOSED)
        };
        self.sides.iter().position(|s| !is_closed(s))
    }

    fn side(
        &self,
        frames: &[Transform<f64>],
        side: &(Link<f64>, Option<usize>),
        all: &[f64],
    ) -> Transform<f64> {
        side.1.map_or(self.base, |row| frames[row]) * side.0.transform(all)
    }
}
