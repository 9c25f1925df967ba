//! Motions.

use super::{French, counted};
use crate::words::{Motion, Terms, Velocity};
use denavit::description::{Description, JointKind};
use denavit::motion::follow::{Cause, Event, EventKind, Jump};
use denavit::motion::hand::Stretch;
use denavit::motion::plan::{Course, Held, Timing, TimingLaw, Verdict};
use denavit::motion::profile::Law;
use denavit::quantity::{decimals, rate, reading};
use denavit::velocity::Place;
use denavit_symbolic::Expr;
use denavit_symbolic::print::{Style, print};

impl Motion for French {
    fn course(&self, course: &Course) -> String {
        let parts = match course {
            Course::Move => return "mouvement articulaire".into(),
            Course::Straight(n) => {
                return format!("mouvements articulaires rectilignes passant près de {n} points");
            }
            Course::Spline(n) => return format!("spline articulaire par {n} points"),
            Course::Hand(parts) => parts,
        };
        let count = |of: Stretch| parts.iter().filter(|p| **p == of).count();
        let (lines, arcs) = (count(Stretch::Line), count(Stretch::Arc));
        let lines = (lines > 0).then(|| counted(lines, "segment", "segments"));
        let arcs = (arcs > 0).then(|| counted(arcs, "arc", "arcs"));
        let splines = parts.iter().filter_map(|p| match p {
            Stretch::Spline(n) => Some(format!("spline par {n} poses")),
            Stretch::Line | Stretch::Arc => None,
        });
        lines.into_iter().chain(arcs).chain(splines).collect::<Vec<_>>().join(", ")
    }

    fn hand_path(&self, parts: usize) -> String {
        match parts {
            1 => say!("une trajectoire de l’organe terminal"),
            n => say!("une trajectoire de l’organe terminal en {n} parties"),
        }
    }

    fn timing(&self, timing: &Timing, description: &Description) -> String {
        let slowed = timing
            .slowed_to
            .map(|t| format!(", ralentie à {} s", self.written(t.to_string())))
            .unwrap_or_default();
        let words = match timing.by {
            TimingLaw::Still => "elle ne commence pas".into(),
            TimingLaw::TimeOptimal => {
                say!("en temps minimal dans les limites de vitesse et d’accélération")
            }
            TimingLaw::WithinTorques { accelerations, fastest } => {
                let how = if fastest { "en temps minimal" } else { "rapide," };
                let what = if accelerations { "de vitesse, d’accélération" } else { "de vitesse" };
                say!("{how} dans les limites {what} et de couple")
            }
            TimingLaw::JerkLimited => {
                say!("rapide, dans les limites de vitesse, d’accélération et de jerk")
            }
            TimingLaw::WithinJerksAndTorques { accelerations } => {
                let what = if accelerations {
                    "de vitesse, d’accélération, de jerk"
                } else {
                    "de vitesse, de jerk"
                };
                say!("rapide, dans les limites {what} et de couple")
            }
            TimingLaw::Fastest => {
                say!("la plus rapide dans les limites de vitesse, d’accélération et de jerk")
            }
            TimingLaw::Together(law) => {
                let law = match law {
                    Law::Cubic => "loi cubique",
                    Law::Quintic => "loi de degré 5",
                    Law::Trapezoidal => "loi trapézoïdale en vitesse",
                    Law::DoubleS => "loi à jerk limité",
                };
                format!("{law}, toutes les articulations ensemble, dans les limites")
            }
            TimingLaw::Quintic { duration, fastest } => {
                let variables = description.variables();
                let most = fastest.map(|(j, v)| {
                    let (name, v) = (variables[j].symbol.name(), self.written(rate(v, variables[j].kind)));
                    format!(" ; l’articulation la plus rapide, {name}, atteint {v}")
                });
                let (duration, most) = (self.written(decimals(duration, 4)), most.unwrap_or_default());
                say!("loi de degré 5 en {duration} s, aucune limite n’est connue{most}")
            }
            TimingLaw::QuinticWithin { duration } => say!(
                "loi de degré 5 en {} s dans les limites de vitesse, les accélérations ne sont pas connues",
                self.written(decimals(duration, 4))
            ),
        };
        words + &slowed
    }

    fn shares_of_limits(&self, held: &Held) -> String {
        let shares = [
            ("les vitesses", Some(held.velocity)),
            ("les accélérations", held.acceleration),
            ("les jerks", held.jerk),
            ("les couples", held.torque),
        ];
        let part = |(what, share): (&str, Option<f64>)| {
            share.map(|share| say!("{what} à {} %", self.written(decimals(100.0 * share, 2))))
        };
        let parts: Vec<String> = shares.into_iter().filter_map(part).collect();
        say!("à {} instants, au plus {} de leurs limites", held.instants, parts.join(" ; "))
    }

    fn event(&self, event: &Event, description: &Description) -> String {
        let names = description.vocabulary().decimal_comma(true);
        let why = |factor: &Option<Expr>, place: &Option<Place>| {
            let zero = factor.map(|f| format!("{} = 0", print(f, &names, Style::Unicode)));
            let place = place.as_ref().map(|p| self.place(p));
            let parts: Vec<String> = [zero, place].into_iter().flatten().collect();
            if parts.is_empty() { String::new() } else { format!(" : {}", parts.join(" ; ")) }
        };
        let variables = description.variables();
        match &event.kind {
            EventKind::Singular { factor, place, crossed } => {
                let how = match (crossed, event.s) {
                    (false, 0.0) => "part d’une",
                    (true, _) => "traverse une",
                    _ => "touche, ou presque, une",
                };
                say!("elle {how} configuration singulière{}", why(factor, place))
            }
            EventKind::Limit { joint, limit } => {
                let v = variables[*joint];
                let how = if event.s == 0.0 { "est au-delà de" } else { "franchit" };
                say!("{} {how} sa butée {}", v.symbol.name(), self.written(reading(*limit, v.kind)))
            }
            EventKind::WithinLimits { joint } => {
                format!("{} revient entre ses butées", variables[*joint].symbol.name())
            }
            EventKind::End { reachable: false, .. } if event.s == 0.0 && variables.len() < 6 => say!(
                "elle sort de ce que l’organe terminal peut atteindre : il faut aussi garder l’orientation, et {} \
                 articulations n’y suffisent pas",
                variables.len()
            ),
            EventKind::End { reachable: false, factor, place } => {
                say!("elle sort de ce que l’organe terminal peut atteindre{}", why(factor, place))
            }
            EventKind::End { reachable: true, factor, place } => say!(
                "la branche se termine ; l’organe terminal peut continuer sur une autre{}",
                why(factor, place)
            ),
        }
    }

    fn jump(&self, jump: &Jump, joints: &[(String, JointKind)]) -> String {
        let (name, kind) = &joints[jump.joint];
        let by = self.written(reading(jump.by, *kind));
        let what = match jump.same_branch {
            true => say!("{name} revient de tours entiers, de {by} depuis la pose précédente"),
            false => say!("une autre branche qu’à la pose précédente, {name} varie de {by}"),
        };
        let why = match jump.why {
            Cause::Limit { joint, limit } => {
                let (name, kind) = &joints[joint];
                say!("en continuant, {name} passerait sa limite {}", self.written(reading(limit, *kind)))
            }
            Cause::End(s) => {
                say!("la branche s’arrête après {} % du chemin", self.written(decimals(100.0 * s, 2)))
            }
            Cause::Nearer => say!("cette solution est plus proche que celle qui continue"),
        };
        say!("{what} : {why}")
    }

    fn verdict(&self, verdict: Verdict) -> String {
        match verdict {
            Verdict::Whole => say!("la trajectoire est suivie jusqu’au bout"),
            Verdict::Ends(reached) => say!(
                "la trajectoire ne peut pas être suivie au-delà de {} % de sa longueur",
                self.written(decimals(100.0 * reached, 4))
            ),
            Verdict::BeyondLimits => "la trajectoire dépasse les butées des articulations".into(),
        }
    }
}
