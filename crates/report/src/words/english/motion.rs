//! Motions.

use super::{English, counted};
use crate::words::{Motion, Velocity};
use denavit::description::{Description, JointKind};
use denavit::motion::follow::{Cause, Event, EventKind, Jump};
use denavit::motion::hand::Stretch;
use denavit::motion::plan::{Course, Held, Timing, TimingLaw, Verdict};
use denavit::motion::profile::Law;
use denavit::quantity::{decimals, rate, reading};
use denavit::velocity::Place;
use denavit_symbolic::Expr;
use denavit_symbolic::print::{Style, print};

impl Motion for English {
    fn course(&self, course: &Course) -> String {
        let parts = match course {
            Course::Move => return "joint move".into(),
            Course::Straight(n) => return format!("straight joint moves past {n} way-points"),
            Course::Spline(n) => return format!("joint spline through {n} way-points"),
            Course::Hand(parts) => parts,
        };
        let count = |of: Stretch| parts.iter().filter(|p| **p == of).count();
        let (lines, arcs) = (count(Stretch::Line), count(Stretch::Arc));
        let lines = (lines > 0).then(|| counted(lines, "line", "lines"));
        let arcs = (arcs > 0).then(|| counted(arcs, "arc", "arcs"));
        let splines = parts.iter().filter_map(|p| match p {
            Stretch::Spline(n) => Some(format!("spline through {n} poses")),
            Stretch::Line | Stretch::Arc => None,
        });
        lines.into_iter().chain(arcs).chain(splines).collect::<Vec<_>>().join(", ")
    }

    fn hand_path(&self, parts: usize) -> String {
        match parts {
            1 => "a path of the hand".into(),
            n => format!("a path of the hand in {n} parts"),
        }
    }

    fn timing(&self, timing: &Timing, description: &Description) -> String {
        let slowed = timing.slowed_to.map(|t| format!(", slowed down to {t} s")).unwrap_or_default();
        let words = match timing.by {
            TimingLaw::Still => "it does not start".into(),
            TimingLaw::TimeOptimal => "time-optimal within velocity and acceleration limits".into(),
            TimingLaw::WithinTorques { accelerations, fastest } => {
                let how = if fastest { "time-optimal" } else { "fast," };
                let what =
                    if accelerations { "velocity, acceleration and torque" } else { "velocity and torque" };
                format!("{how} within {what} limits")
            }
            TimingLaw::JerkLimited => "fast, within velocity, acceleration and jerk limits".into(),
            TimingLaw::WithinJerksAndTorques { accelerations } => {
                let what = if accelerations { "velocity, acceleration, jerk" } else { "velocity, jerk" };
                format!("fast, within {what} and torque limits")
            }
            TimingLaw::Fastest => "the fastest within velocity, acceleration and jerk limits".into(),
            TimingLaw::Together(law) => {
                let law = match law {
                    Law::Cubic => "a cubic",
                    Law::Quintic => "a quintic",
                    Law::Trapezoidal => "a trapezoidal",
                    Law::DoubleS => "a jerk-limited",
                };
                format!("{law} law, all joints together, within the limits")
            }
            TimingLaw::Quintic { duration, fastest } => {
                let variables = description.variables();
                let most = fastest.map(|(j, v)| {
                    let (name, v) = (variables[j].symbol.name(), rate(v, variables[j].kind));
                    format!("; the fastest joint, {name}, turns at {v}")
                });
                let most = most.unwrap_or_default();
                format!("a quintic law over {} s, no limits are known{most}", decimals(duration, 4))
            }
            TimingLaw::QuinticWithin { duration } => format!(
                "a quintic law over {} s within the velocity limits, no accelerations are known",
                decimals(duration, 4)
            ),
        };
        words + &slowed
    }

    fn shares_of_limits(&self, held: &Held) -> String {
        let shares = [
            ("velocities", Some(held.velocity)),
            ("accelerations", held.acceleration),
            ("jerks", held.jerk),
            ("torques", held.torque),
        ];
        let part = |(what, share): (&str, Option<f64>)| {
            share.map(|share| format!("{what} at {} %", decimals(100.0 * share, 2)))
        };
        let parts: Vec<String> = shares.into_iter().filter_map(part).collect();
        format!("at {} instants at most {} of their limits", held.instants, parts.join(", "))
    }

    fn event(&self, event: &Event, description: &Description) -> String {
        let names = description.vocabulary();
        let why = |factor: &Option<Expr>, place: &Option<Place>| {
            let zero = factor.map(|f| format!("{} = 0", print(f, &names, Style::Unicode)));
            let place = place.as_ref().map(|p| self.place(p));
            let parts: Vec<String> = [zero, place].into_iter().flatten().collect();
            if parts.is_empty() { String::new() } else { format!(": {}", parts.join("; ")) }
        };
        let variables = description.variables();
        match &event.kind {
            EventKind::Singular { factor, place, crossed } => {
                let how = match (crossed, event.s) {
                    (false, 0.0) => "starts in",
                    (true, _) => "passes through",
                    _ => "touches, or nearly,",
                };
                format!("it {how} a singular configuration{}", why(factor, place))
            }
            EventKind::Limit { joint, limit } => {
                let v = variables[*joint];
                let how = if event.s == 0.0 { "is beyond" } else { "leaves" };
                format!("{} {how} its limit {}", v.symbol.name(), reading(*limit, v.kind))
            }
            EventKind::WithinLimits { joint } => {
                format!("{} is within its limits again", variables[*joint].symbol.name())
            }
            EventKind::End { reachable: false, .. } if event.s == 0.0 && variables.len() < 6 => format!(
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

    fn jump(&self, jump: &Jump, joints: &[(String, JointKind)]) -> String {
        let (name, kind) = &joints[jump.joint];
        let by = reading(jump.by, *kind);
        let what = match jump.same_branch {
            true => format!("{name} goes back by whole turns, {by} from the pose before"),
            false => format!("another branch than at the pose before, {name} moves by {by}"),
        };
        let why = match jump.why {
            Cause::Limit { joint, limit } => {
                let (name, kind) = &joints[joint];
                format!("going on, {name} would pass its limit {}", reading(limit, *kind))
            }
            Cause::End(s) => format!("the branch ends after {} % of the way", decimals(100.0 * s, 2)),
            Cause::Nearer => "this solution is nearer than the one that goes on".into(),
        };
        format!("{what}: {why}")
    }

    fn verdict(&self, verdict: Verdict) -> String {
        match verdict {
            Verdict::Whole => "the path is followed to its end".into(),
            Verdict::Ends(reached) => {
                format!("the path cannot be followed beyond {} % of its way", decimals(100.0 * reached, 4))
            }
            Verdict::BeyondLimits => "the path leaves the limits of the joints".into(),
        }
    }
}
