//! What is met on the way.

use crate::description::Description;
use crate::explain::reading;
use crate::velocity::Place;
use denavit_symbolic::Expr;
use denavit_symbolic::print::{Style, print};

/// Something on the way, at a parameter of the path.
#[derive(Clone, PartialEq, Debug)]
pub struct Event {
    /// Where.
    pub s: f64,
    /// The configuration there.
    pub q: Vec<f64>,
    /// What.
    pub kind: EventKind,
}

/// What can be met.
#[derive(Clone, PartialEq, Debug)]
pub enum EventKind {
    /// A singular configuration is passed or touched.
    Singular {
        /// The factor of the determinant that is 0, if it is one of those that are known.
        factor: Option<Expr>,
        /// How the axes lie.
        place: Option<Place>,
        /// Whether the factor changes its sign; otherwise it is touched, or nearly.
        crossed: bool,
    },
    /// A joint leaves its limits.
    Limit {
        /// The joint, from 0.
        joint: usize,
        /// The limit.
        limit: f64,
    },
    /// From here on the joints enter their limits again.
    WithinLimits {
        /// The joint, from 0.
        joint: usize,
    },
    /// The branch ends: behind this there is no solution near the last one.
    End {
        /// Whether the hand can be there at all, on another branch.
        reachable: bool,
        /// The factor of the determinant that is 0 here, if it is one of those that are known.
        factor: Option<Expr>,
        /// How the axes lie.
        place: Option<Place>,
    },
}

impl Event {
    /// What happens, in words: `passes through a singular configuration: S5 = 0; …`. The path is the subject, or a joint.
    pub fn sentence(&self, description: &Description) -> String {
        let names = description.vocabulary();
        let why = |factor: &Option<Expr>, place: &Option<Place>| {
            let zero = factor.map(|f| format!("{} = 0", print(f, &names, Style::Unicode)));
            let parts: Vec<String> = [zero, place.as_ref().map(ToString::to_string)]
                .into_iter()
                .flatten()
                .filter(|p| !p.is_empty())
                .collect();
            if parts.is_empty() { String::new() } else { format!(": {}", parts.join("; ")) }
        };
        let variables = description.variables();
        let few = variables.len() < 6;
        match &self.kind {
            EventKind::Singular { factor, place, crossed } => {
                let how = match (crossed, self.s) {
                    (false, 0.0) => "starts in",
                    (true, _) => "passes through",
                    _ => "touches, or nearly,",
                };
                format!("it {how} a singular configuration{}", why(factor, place))
            }
            EventKind::Limit { joint, limit } => {
                let v = variables[*joint];
                let how = if self.s == 0.0 { "is beyond" } else { "leaves" };
                format!("{} {how} its limit {}", v.symbol.name(), reading(*limit, v.kind))
            }
            EventKind::WithinLimits { joint } => {
                format!("{} is within its limits again", variables[*joint].symbol.name())
            }
            EventKind::End { reachable: false, .. } if self.s == 0.0 && few => format!(
                "it leaves what the hand can reach: the orientation is to be kept too, and {} joints cannot do both",
                variables.len()
            ),
            EventKind::End { reachable: false, factor, place } => {
                format!("it leaves what the hand can reach{}", why(factor, place))
            }
            EventKind::End { reachable: true, factor, place } => {
                format!("the branch ends; the hand can go on with another{}", why(factor, place))
            }
        }
    }
}

impl EventKind {
    /// True if the path cannot be followed beyond.
    pub fn is_end(&self) -> bool {
        matches!(self, EventKind::End { .. })
    }
}
