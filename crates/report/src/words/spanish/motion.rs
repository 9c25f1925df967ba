//! Motions.

use super::{Spanish, counted};
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

impl Motion for Spanish {
    fn course(&self, course: &Course) -> String {
        let parts = match course {
            Course::Move => return "movimiento articular".into(),
            Course::Straight(n) => {
                let points = counted(*n, "punto de paso", "puntos de paso");
                return format!("movimientos articulares rectilíneos cerca de {points}");
            }
            Course::Spline(n) => {
                return format!("spline articular por {}", counted(*n, "punto de paso", "puntos de paso"));
            }
            Course::Hand(parts) => parts,
        };
        let count = |of: Stretch| parts.iter().filter(|p| **p == of).count();
        let (lines, arcs) = (count(Stretch::Line), count(Stretch::Arc));
        let lines = (lines > 0).then(|| counted(lines, "segmento", "segmentos"));
        let arcs = (arcs > 0).then(|| counted(arcs, "arco", "arcos"));
        let splines = parts.iter().filter_map(|p| match p {
            Stretch::Spline(n) => Some(format!("spline por {}", counted(*n, "pose", "poses"))),
            Stretch::Line | Stretch::Arc => None,
        });
        lines.into_iter().chain(arcs).chain(splines).collect::<Vec<_>>().join(", ")
    }

    fn hand_path(&self, parts: usize) -> String {
        match parts {
            1 => "una trayectoria del efector final".into(),
            n => format!("una trayectoria del efector final en {n} tramos"),
        }
    }

    fn timing(&self, timing: &Timing, description: &Description) -> String {
        let number = |x: f64, digits| self.written(decimals(x, digits));
        let slowed = timing.slowed_to.map(|t| format!(", ralentizada a {} s", self.written(t.to_string())));
        let words = match timing.by {
            TimingLaw::Still => "no llega a empezar".into(),
            TimingLaw::TimeOptimal => {
                "en tiempo mínimo dentro de los límites de velocidad y aceleración".into()
            }
            TimingLaw::WithinTorques { accelerations, fastest } => {
                let how = if fastest { "en tiempo mínimo" } else { "rápida," };
                let what = if accelerations { "velocidad, aceleración y par" } else { "velocidad y par" };
                format!("{how} dentro de los límites de {what}")
            }
            TimingLaw::JerkLimited => {
                "rápida, dentro de los límites de velocidad, aceleración y sobreaceleración".into()
            }
            TimingLaw::WithinJerksAndTorques { accelerations } => {
                let what = if accelerations {
                    "velocidad, aceleración, sobreaceleración"
                } else {
                    "velocidad, sobreaceleración"
                };
                format!("rápida, dentro de los límites de {what} y par")
            }
            TimingLaw::Fastest => {
                "la más rápida dentro de los límites de velocidad, aceleración y sobreaceleración".into()
            }
            TimingLaw::Together(law) => {
                let law = match law {
                    Law::Cubic => "polinomio cúbico",
                    Law::Quintic => "polinomio de quinto grado",
                    Law::Trapezoidal => "perfil trapezoidal de velocidad",
                    Law::DoubleS => "perfil con sobreaceleración limitada",
                };
                format!("{law}, todas las articulaciones a la vez, dentro de los límites")
            }
            TimingLaw::Quintic { duration, fastest } => {
                let variables = description.variables();
                let most = fastest.map(|(j, v)| {
                    let (name, v) = (variables[j].symbol.name(), self.written(rate(v, variables[j].kind)));
                    format!("; la articulación más rápida, {name}, alcanza {v}")
                });
                let (duration, most) = (number(duration, 4), most.unwrap_or_default());
                format!("polinomio de quinto grado en {duration} s, no se conocen límites{most}")
            }
            TimingLaw::QuinticWithin { duration } => format!(
                "polinomio de quinto grado en {} s dentro de los límites de velocidad, no se conocen los de aceleración",
                number(duration, 4)
            ),
        };
        words + &slowed.unwrap_or_default()
    }

    fn shares_of_limits(&self, held: &Held) -> String {
        let shares = [
            ("las velocidades", Some(held.velocity)),
            ("las aceleraciones", held.acceleration),
            ("las sobreaceleraciones", held.jerk),
            ("los pares", held.torque),
        ];
        let part = |(what, share): (&str, Option<f64>)| {
            share.map(|share| format!("{what} al {} %", self.written(decimals(100.0 * share, 2))))
        };
        let parts: Vec<String> = shares.into_iter().filter_map(part).collect();
        format!("en {} instantes, como mucho {} de sus límites", held.instants, parts.join("; "))
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
                    (false, 0.0) => "parte de",
                    (true, _) => "atraviesa",
                    _ => "roza, o casi,",
                };
                format!("{how} una configuración singular{}", why(factor, place))
            }
            EventKind::Limit { joint, limit } => {
                let v = variables[*joint];
                let how = if event.s == 0.0 { "está más allá de" } else { "rebasa" };
                format!("{} {how} su límite {}", v.symbol.name(), self.written(reading(*limit, v.kind)))
            }
            EventKind::WithinLimits { joint } => {
                format!("{} vuelve a estar dentro de sus límites", variables[*joint].symbol.name())
            }
            EventKind::End { reachable: false, .. } if event.s == 0.0 && variables.len() < 6 => format!(
                "sale de lo que alcanza el efector final: también debe conservarse la orientación, y {} no {} para ambas cosas",
                counted(variables.len(), "articulación", "articulaciones"),
                if variables.len() == 1 { "basta" } else { "bastan" }
            ),
            EventKind::End { reachable: false, factor, place } => {
                format!("sale de lo que alcanza el efector final{}", why(factor, place))
            }
            EventKind::End { reachable: true, factor, place } => {
                format!("la rama termina; el efector final puede seguir por otra{}", why(factor, place))
            }
        }
    }

    fn jump(&self, jump: &Jump, joints: &[(String, JointKind)]) -> String {
        let (name, kind) = &joints[jump.joint];
        let by = self.written(reading(jump.by, *kind));
        let what = match jump.same_branch {
            true => format!("{name} retrocede vueltas enteras, {by} desde la pose anterior"),
            false => format!("otra rama que en la pose anterior, {name} varía {by}"),
        };
        let why = match jump.why {
            Cause::Limit { joint, limit } => {
                let (name, kind) = &joints[joint];
                let limit = self.written(reading(limit, *kind));
                format!("de seguir, {name} rebasaría su límite {limit}")
            }
            Cause::End(s) => {
                format!("la rama termina tras el {} % del recorrido", self.written(decimals(100.0 * s, 2)))
            }
            Cause::Nearer => "esta solución está más cerca que la que continúa".into(),
        };
        format!("{what}: {why}")
    }

    fn verdict(&self, verdict: Verdict) -> String {
        match verdict {
            Verdict::Whole => "la trayectoria se recorre hasta el final".into(),
            Verdict::Ends(reached) => format!(
                "la trayectoria no puede recorrerse más allá del {} % de su longitud",
                self.written(decimals(100.0 * reached, 4))
            ),
            Verdict::BeyondLimits => "la trayectoria sale de los límites articulares".into(),
        }
    }
}
