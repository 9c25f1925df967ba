//! Motions.

use super::{German, counted};
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

impl Motion for German {
    fn course(&self, course: &Course) -> String {
        let parts = match course {
            Course::Move => return "Bewegung in Gelenkkoordinaten".into(),
            Course::Straight(n) => {
                return format!(
                    "geradlinige Bewegungen in Gelenkkoordinaten, an {} vorbei",
                    counted(*n, "Zwischenpunkt", "Zwischenpunkten")
                );
            }
            Course::Spline(n) => {
                return format!(
                    "Spline in Gelenkkoordinaten durch {}",
                    counted(*n, "Zwischenpunkt", "Zwischenpunkte")
                );
            }
            Course::Hand(parts) => parts,
        };
        let count = |of: Stretch| parts.iter().filter(|p| **p == of).count();
        let (lines, arcs) = (count(Stretch::Line), count(Stretch::Arc));
        let lines = (lines > 0).then(|| counted(lines, "Strecke", "Strecken"));
        let arcs = (arcs > 0).then(|| counted(arcs, "Kreisbogen", "Kreisbögen"));
        let splines = parts.iter().filter_map(|p| match p {
            Stretch::Spline(n) => Some(format!("Spline durch {}", counted(*n, "Pose", "Posen"))),
            Stretch::Line | Stretch::Arc => None,
        });
        lines.into_iter().chain(arcs).chain(splines).collect::<Vec<_>>().join(", ")
    }

    fn hand_path(&self, parts: usize) -> String {
        match parts {
            1 => "eine Bahn des Endeffektors".into(),
            n => format!("eine Bahn des Endeffektors in {n} Teilen"),
        }
    }

    fn timing(&self, timing: &Timing, description: &Description) -> String {
        let number = |x: f64, digits| self.written(decimals(x, digits));
        let slowed = timing.slowed_to.map(|t| format!(", verlangsamt auf {} s", self.written(t.to_string())));
        let words = match timing.by {
            TimingLaw::Still => "sie beginnt nicht".into(),
            TimingLaw::TimeOptimal => {
                "zeitoptimal innerhalb der Grenzen für Geschwindigkeit und Beschleunigung".into()
            }
            TimingLaw::WithinTorques { accelerations, fastest } => {
                let how = if fastest { "zeitoptimal" } else { "schnell," };
                let what = if accelerations {
                    "Geschwindigkeit, Beschleunigung und Moment"
                } else {
                    "Geschwindigkeit und Moment"
                };
                format!("{how} innerhalb der Grenzen für {what}")
            }
            TimingLaw::JerkLimited => {
                "schnell, innerhalb der Grenzen für Geschwindigkeit, Beschleunigung und Ruck".into()
            }
            TimingLaw::WithinJerksAndTorques { accelerations } => {
                let what = if accelerations {
                    "Geschwindigkeit, Beschleunigung, Ruck"
                } else {
                    "Geschwindigkeit, Ruck"
                };
                format!("schnell, innerhalb der Grenzen für {what} und Moment")
            }
            TimingLaw::Fastest => {
                "so schnell wie möglich innerhalb der Grenzen für Geschwindigkeit, Beschleunigung und Ruck"
                    .into()
            }
            TimingLaw::Together(law) => {
                let law = match law {
                    Law::Cubic => "Polynom dritten Grades",
                    Law::Quintic => "Polynom fünften Grades",
                    Law::Trapezoidal => "trapezförmiger Geschwindigkeitsverlauf",
                    Law::DoubleS => "ruckbegrenzter Verlauf",
                };
                format!("{law}, alle Gelenke synchron, innerhalb der Grenzen")
            }
            TimingLaw::Quintic { duration, fastest } => {
                let variables = description.variables();
                let most = fastest.map(|(j, v)| {
                    let (name, v) = (variables[j].symbol.name(), self.written(rate(v, variables[j].kind)));
                    format!("; das schnellste Gelenk, {name}, erreicht {v}")
                });
                let (duration, most) = (number(duration, 4), most.unwrap_or_default());
                format!("Polynom fünften Grades in {duration} s, Grenzen sind nicht bekannt{most}")
            }
            TimingLaw::QuinticWithin { duration } => format!(
                "Polynom fünften Grades in {} s innerhalb der Geschwindigkeitsgrenzen, Beschleunigungen sind nicht bekannt",
                number(duration, 4)
            ),
        };
        words + &slowed.unwrap_or_default()
    }

    fn shares_of_limits(&self, held: &Held) -> String {
        let shares = [
            ("Geschwindigkeiten", Some(held.velocity)),
            ("Beschleunigungen", held.acceleration),
            ("Rucke", held.jerk),
            ("Momente", held.torque),
        ];
        let part = |(what, share): (&str, Option<f64>)| {
            share.map(|share| format!("{what} bei {} %", self.written(decimals(100.0 * share, 2))))
        };
        let parts: Vec<String> = shares.into_iter().filter_map(part).collect();
        format!("an {} Zeitpunkten höchstens {} ihrer Grenzen", held.instants, parts.join("; "))
    }

    fn event(&self, event: &Event, description: &Description) -> String {
        let names = description.vocabulary().decimal_comma(true);
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
                    (false, 0.0) => "beginnt in einer singulären Stellung",
                    (true, _) => "geht durch eine singuläre Stellung",
                    _ => "berührt eine singuläre Stellung oder kommt ihr sehr nahe",
                };
                format!("sie {how}{}", why(factor, place))
            }
            EventKind::Limit { joint, limit } => {
                let v = variables[*joint];
                let how =
                    if event.s == 0.0 { "liegt jenseits der Grenze" } else { "überschreitet die Grenze" };
                format!("{} {how} {}", v.symbol.name(), self.written(reading(*limit, v.kind)))
            }
            EventKind::WithinLimits { joint } => {
                format!("{} liegt wieder innerhalb der Grenzen", variables[*joint].symbol.name())
            }
            EventKind::End { reachable: false, .. } if event.s == 0.0 && variables.len() < 6 => format!(
                "sie verlässt, was der Endeffektor erreicht: auch die Orientierung soll erhalten bleiben, und beides \
                 zugleich können {} nicht",
                counted(variables.len(), "Gelenk", "Gelenke")
            ),
            EventKind::End { reachable: false, factor, place } => {
                format!("sie verlässt, was der Endeffektor erreicht{}", why(factor, place))
            }
            EventKind::End { reachable: true, factor, place } => format!(
                "der Lösungszweig endet; auf einem anderen kann der Endeffektor weiter{}",
                why(factor, place)
            ),
        }
    }

    fn jump(&self, jump: &Jump, joints: &[(String, JointKind)]) -> String {
        let (name, kind) = &joints[jump.joint];
        let by = self.written(reading(jump.by, *kind));
        let what = match jump.same_branch {
            true => format!("{name} springt um ganze Umdrehungen, um {by} seit der Pose davor"),
            false => format!("ein anderer Zweig als in der Pose davor, {name} ändert sich um {by}"),
        };
        let why = match jump.why {
            Cause::Limit { joint, limit } => {
                let (name, kind) = &joints[joint];
                let limit = self.written(reading(limit, *kind));
                format!("ginge es weiter, überschritte {name} seine Grenze {limit}")
            }
            Cause::End(s) => {
                format!("der Zweig endet nach {} % des Weges", self.written(decimals(100.0 * s, 2)))
            }
            Cause::Nearer => "diese Lösung liegt näher als die, die weiterführt".into(),
        };
        format!("{what}: {why}")
    }

    fn verdict(&self, verdict: Verdict) -> String {
        match verdict {
            Verdict::Whole => "die Bahn wird bis zum Ende durchfahren".into(),
            Verdict::Ends(reached) => format!(
                "die Bahn kann nur bis {} % ihrer Länge durchfahren werden",
                self.written(decimals(100.0 * reached, 4))
            ),
            Verdict::BeyondLimits => "die Bahn verlässt die Gelenkgrenzen".into(),
        }
    }
}
