//! What a redundant arm can do at one pose: curves of configurations, each with a parameter.

use crate::inverse::answer::{Answer, Doubt, Family, Solution};
use crate::inverse::branch::Branch;

/// All configurations of a pose, as curves.
#[derive(Clone, PartialEq, Debug)]
pub struct Manifold {
    /// The curves: one a branch and piece of its parameter's range.
    pub components: Vec<Component>,
    /// How many parameters configurations have; beyond one, components are samples.
    pub dimension: usize,
    /// Why there may be more; nothing if all are here.
    pub doubt: Option<Doubt>,
}

/// A curve of configurations.
#[derive(Clone, PartialEq, Debug)]
pub struct Component {
    /// The branch: `shoulder+ elbow− wrist+`; empty for a curve that was followed.
    pub branch: Branch,
    /// The parameter: `ψ` (the arm angle, radians), the name of a joint variable (radians or metres), or `s` (the length
    /// along the curve, radians with slides by the reach).
    pub parameter: String,
    /// The values of the parameter, whatever the limits: a whole turn is `[−π, π]`; an arc starts in (−π, π].
    pub domain: [f64; 2],
    /// The values at which the limits allow the configuration, or a copy of it whole turns away, in order. The end of an
    /// interval may be up to a turn beyond π.
    pub feasible: Vec<[f64; 2]>,
    /// True if the end of the domain is its start again.
    pub is_closed: bool,
    /// A member: in the middle of the longest feasible interval, if there is one, or of the domain.
    pub representative: Solution,
    /// How the joints move there, radians and metres, a unit vector.
    pub direction: Vec<f64>,
    /// Members along the domain, neighbours at most 0.1 rad apart and without jumps of whole turns.
    pub curve: Vec<Vec<f64>>,
    pub(super) chart: Chart,
}

/// A component before members of it are computed.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub branch: Branch,
    pub parameter: String,
    pub domain: [f64; 2],
    pub feasible: Vec<[f64; 2]>,
    pub is_closed: bool,
    pub chart: Chart,
}

/// A configuration of a pose.
#[derive(Clone, Debug)]
pub(super) struct Found {
    pub q: Vec<f64>,
    /// The smallest quantity that was divided by, if it is known.
    pub guard: Option<f64>,
    pub branch: Branch,
}

/// How the joints follow from the parameter.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Chart {
    /// By the arm angle: which elbow (0 or 1), and the signs of shoulder and wrist.
    ArmAngle { elbow: usize, shoulder: f64, wrist: f64 },
    /// By a joint's value: the signs of the solver's nodes, and the values of other joints that are given.
    Joint { signs: Vec<i8>, others: Vec<f64> },
    /// By interpolation and correction: members with their lengths along the curve.
    Curve { members: Vec<Vec<f64>>, lengths: Vec<f64> },
}

impl Manifold {
    /// True if no configuration has the pose.
    pub fn is_empty(&self) -> bool {
        self.components.is_empty()
    }

    /// True if a configuration within the limits has the pose.
    pub fn is_feasible(&self) -> bool {
        self.components.iter().any(|c| !c.feasible.is_empty())
    }

    /// The curves as families of solutions. Where configurations have several parameters, `free` by name, the curves are samples
    /// of them: one family with one of the curves stands for all.
    pub fn answer(mut self, free: &[String]) -> Answer {
        let dimension = self.dimension;
        if dimension > 1 {
            let longest = |c: &Component| c.feasible.iter().map(|[low, high]| high - low).fold(0.0, f64::max);
            let best =
                self.components.iter().enumerate().max_by(|a, b| longest(a.1).total_cmp(&longest(b.1)));
            let family = best.map(|(k, _)| k).map(|k| self.components.swap_remove(k)).map(|c| Family {
                dimension,
                curve: c.curve,
                ..Family::new(c.representative, free.to_vec(), c.direction)
            });
            return Answer { doubt: self.doubt, families: family.into_iter().collect(), ..Answer::empty() };
        }
        let doubt = self.doubt;
        Answer { doubt, families: self.curves(), ..Answer::empty() }
    }

    /// Each curve as a family of its own.
    pub(in crate::inverse) fn curves(self) -> Vec<Family> {
        let dimension = self.dimension;
        let family = |c: Component| Family {
            dimension,
            interval: Some(c.domain),
            feasible: c.feasible,
            curve: c.curve,
            ..Family::new(c.representative, vec![c.parameter], c.direction)
        };
        self.components.into_iter().map(family).collect()
    }
}

impl Piece {
    /// The middle of the longest interval that the limits allow, or of all.
    pub fn middle(&self) -> f64 {
        let length = |i: &[f64; 2]| i[1] - i[0];
        let longest = self.feasible.iter().max_by(|a, b| length(a).total_cmp(&length(b)));
        let [low, high] = longest.unwrap_or(&self.domain);
        (low + high) / 2.0
    }
}
