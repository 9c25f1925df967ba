//! The timing of a motion between two configurations: cubic polynomials, and trapezoidal profiles of the speed.

use super::NoExercise;
use super::chosen::Chosen;
use super::sheet::{Asked, Field, Ground, Task, claimed, digits, quantity};
use crate::document::{Line, Math, Section};
use denavit::inverse::JointSpace;
use denavit::robot::Robot;
use denavit_check::Answer;
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Rational};

/// The way of a joint: where it begins, how far it goes, in degrees or metres, and its limits.
struct Way {
    turns: bool,
    from: Rational,
    by: Rational,
    speed: f64,
    acceleration: f64,
}

/// A number of degrees or metres, with four decimals.
fn exact(x: f64) -> Rational {
    Rational::new((x * 10_000.0).round() as i64, 10_000)
}

fn number(x: &Rational) -> f64 {
    Expr::from(x.clone()).eval(|_| None).unwrap_or_default()
}

impl Way {
    fn unit(&self, behind: &str) -> &'static str {
        match (self.turns, behind) {
            (true, "") => "°",
            (true, "/s") => "°/s",
            (true, _) => "°/s²",
            (false, "") => "m",
            (false, "/s") => "m/s",
            (false, _) => "m/s²",
        }
    }

    /// Whether it reaches its speed, and the shortest time.
    fn time(&self) -> (bool, f64) {
        let by = number(&self.by).abs();
        let reaches = by * self.acceleration >= self.speed * self.speed;
        let time = match reaches {
            true => by / self.speed + self.speed / self.acceleration,
            false => 2.0 * (by / self.acceleration).sqrt(),
        };
        (reaches, time)
    }
}

/// Polynomials, greatest speeds, shortest times.
pub(super) fn timing(ground: &Ground, chosen: &mut Chosen) -> Result<Asked, NoExercise> {
    let (s, words) = (&ground.setting, ground.words());
    let d = &s.description;
    let robot = Robot::numeric(d).map_err(NoExercise::Values)?;
    let space = JointSpace::new(d, &robot);
    let ends = chosen.configurations(d, 2, |_| true)?;
    let seconds = chosen.whole([1, 5]);
    let shown = |k: usize, q: f64| if space.is_angle[k] { q.to_degrees() } else { q };
    let ways: Vec<Way> = (0..space.is_angle.len())
        .map(|k| {
            let [from, to] = [0, 1].map(|e| exact(shown(k, ends[e][k])));
            let [speed, acceleration] = chosen.limits(space.is_angle[k]);
            Way { turns: space.is_angle[k], by: &to - &from, from, speed, acceleration }
        })
        .collect();
    if ways.iter().all(|way| way.by == Rational::from(0)) {
        return Err(NoExercise::Configurations { found: 1, asked: 2 });
    }

    let t = Expr::symbol("t");
    let q: Vec<Expr> = d.variables().iter().map(|v| v.symbol.into()).collect();
    let named = |letter: &str, j: usize| Expr::symbol(&format!("{letter}{}", j + 1));
    let all = ["t", "f", "D", "q", "v", "a", "T"].iter().fold(ground.names(), |names, n| names.symbol(n));
    let names =
        (0..ways.len()).fold(all, |v, j| v.symbol(&format!("v{}", j + 1)).symbol(&format!("T{}", j + 1)));
    let mut cubic = Section::new(names.clone());
    let mut peaks = Section::new(names.clone());
    let mut times = Section::new(names.clone());
    let [by, whole, start, speed, acceleration] = ["D", "f", "q", "v", "a"].map(Expr::symbol);
    let general = start + by * (Expr::int(3) * (t / whole).powi(2) - Expr::int(2) * (t / whole).powi(3));
    cubic.paragraph(words.cubic_step(Math::Expr(general)));
    peaks.paragraph(words.peaks_step(Math::Expr(Expr::int(3) * by / (Expr::int(2) * whole))));
    let mut coefficients = vec![];
    let [mut polynomials, mut speeds, mut shortest] = [vec![], vec![], vec![]];
    for (j, way) in ways.iter().enumerate() {
        let f = Expr::int(seconds);
        let by = Expr::from(way.by.clone());
        let [two, three] = [Expr::int(3) * by / f.powi(2), Expr::int(-2) * by / f.powi(3)]
            .map(|e| e.as_number().map_or(e, Expr::from));
        let value = Expr::from(way.from.clone()) + two * t.powi(2) + three * t.powi(3);
        cubic.formula(Math::equation(q[j], value));
        let k = j + 1;
        let letters =
            ["q", "theta", "th", "d", "r"].iter().flat_map(|l| [format!("{l}{k}"), format!("{l}{k}t")]);
        for (power, c) in [(0, Expr::from(way.from.clone())), (2, two), (3, three)] {
            let label = claimed(&Math::Expr(q[j]), &names);
            let label = if power == 0 { label } else { format!("{label}:\\; t^{power}") };
            let value = c.eval(|_| None).unwrap_or_default();
            coefficients.push(Field {
                group: words.coefficients(),
                label,
                value,
                unit: String::new(),
                within: 0.0,
            });
        }
        polynomials.push(Answer {
            names: letters.collect(),
            value: print(value, &Vocabulary::new(), Style::Ascii),
            unit: way.unit("").into(),
        });
        let peak = 1.5 * number(&way.by).abs() / seconds as f64;
        peaks.paragraph(Line::default().math(quantity(named("v", j), peak, 4, way.unit("/s"))));
        let called = ["v", "dotq", "dottheta", "omega", "w", "qd", "qp"];
        speeds.push(Answer {
            names: called
                .iter()
                .flat_map(|l| [format!("{l}{k}"), format!("{l}{k}max"), format!("{l}max{k}")])
                .collect(),
            value: digits(peak, 4),
            unit: way.unit("/s").into(),
        });
        let (reaches, time) = way.time();
        let step = match reaches {
            true => words.trapezoid_step(
                Math::Expr(Expr::int(k as i64)),
                Math::Expr(Expr::symbol("D") / speed + speed / acceleration),
            ),
            false => words.triangle_step(
                Math::Expr(Expr::int(k as i64)),
                Math::Expr(Expr::int(2) * (Expr::symbol("D") / acceleration).sqrt()),
            ),
        };
        times.paragraph(step);
        times.paragraph(Line::default().math(quantity(named("T", j), time, 4, "s")));
        shortest.push(Answer {
            names: vec![format!("T{k}"), format!("t{k}"), format!("tf{k}"), format!("tmin{k}")],
            value: digits(time, 4),
            unit: "s".into(),
        });
    }
    let slowest = ways.iter().map(|way| way.time().1).fold(0.0, f64::max);
    times.paragraph(words.slowest_step(quantity(Expr::symbol("T"), slowest, 4, "s")));
    shortest.push(Answer {
        names: ["T", "Tmin", "tmin", "Tmax", "Ttot", "Tmove"].map(String::from).to_vec(),
        value: digits(slowest, 4),
        unit: "s".into(),
    });

    let mut given = Section::new(names);
    given.heading(3, Line::new(words.motion_title()));
    given.paragraph(words.motion_begins(ground.configuration(&ends[0])));
    given.paragraph(words.motion_ends(ground.configuration(&ends[1])));
    for (j, way) in ways.iter().enumerate() {
        let [v, a] = [(way.speed, "/s"), (way.acceleration, "/s²")]
            .map(|(x, behind)| words.written(format!("{} {}", crate::decimals(x, 4), way.unit(behind))));
        given.paragraph(words.joint_limits(Math::Expr(Expr::int(j as i64 + 1)), &v, &a));
    }
    let joints = ways.len() as u32;
    let letters = |letter: &str| (0..ways.len()).map(|j| Math::Expr(named(letter, j))).collect::<Vec<_>>();
    let task = |name, words, points, answers, fields, answer| Task {
        name,
        words,
        points,
        answers,
        fields,
        has_formulas: false,
        answer: vec![answer],
        ..Task::default()
    };
    let duration = quantity(Expr::symbol("f"), seconds as f64, 0, "s");
    Ok(Asked {
        given: vec![given],
        tasks: vec![
            task(
                words.cubic_title(),
                words.ask_cubic(duration),
                2 * joints,
                polynomials,
                coefficients,
                cubic,
            ),
            task(words.peaks_title(), words.ask_peaks(letters("v")), joints, speeds, vec![], peaks),
            task(
                words.trapezoid_title(),
                words.ask_trapezoid(letters("T"), Math::Expr(Expr::symbol("T"))),
                joints + 1,
                shortest,
                vec![],
                times,
            ),
        ],
    })
}
