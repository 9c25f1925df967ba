//! The solutions of a pose, as a table and as JSON.

use crate::commands::fk::{joint_names, plural};
use crate::terminal::{Align, FAINT, HEADING, NAME, matrix, noise, number, styled, table, words};
use denavit::description::{Description, JointKind, Variable};
use denavit::geometry::Transform;
use denavit::idealise::Ideal;
use denavit::inverse::{
    Answer, Criterion, Family, Goal, InverseKinematics, JointSpace, Nearest, Obstacle, Solution,
};
use denavit::motion::follow::Jump;
use denavit::quantity::reading;
use denavit_wire::Schema;
use denavit_wire::inverse::{self as wire, Idealised};

/// What does not change from pose to pose.
#[derive(Clone)]
pub struct Question {
    /// The values of the given joints.
    pub given: Vec<f64>,
    /// The best solution by this is wanted as well.
    pub criterion: Option<Criterion>,
    /// What is wanted of the solutions.
    pub wanted: Wanted,
    robot: String,
    goal: Goal,
    method: &'static str,
    names: Vec<(String, f64)>,
    /// What the file calls the joints, where it does.
    called: Option<Vec<String>>,
    space: JointSpace,
    joints: Vec<(String, JointKind)>,
    ideal: Option<Idealised>,
}

/// What is wanted of the solutions.
#[derive(Clone, Copy)]
pub struct Wanted {
    /// One is enough.
    pub one: bool,
    /// Only what the limits allow.
    pub within_limits: bool,
    /// Their copies within the limits as well.
    pub copies: bool,
}

/// What was found.
pub struct Found {
    /// The answer.
    pub answer: Answer,
    /// The solution that is best by the criterion, if there is one.
    pub best: Option<Nearest>,
    /// How many solutions and families the limits exclude, where these were left out.
    pub left_out: Option<usize>,
    /// That the best does not go on from the one of the pose before.
    pub jump: Option<Jump>,
}

impl Question {
    /// About a robot, with values of the given joints.
    pub fn new(
        description: &Description,
        solver: &InverseKinematics,
        given: Vec<f64>,
        (criterion, wanted): (Option<Criterion>, Wanted),
        ideal: Option<&Ideal>,
    ) -> Self {
        let variables = description.variables();
        let name = |j: &usize| variables[*j].symbol.name().to_string();
        let names = solver.given.iter().map(name).zip(given.iter().copied()).collect();
        let ideal = ideal.map(Idealised::from);
        let (robot, method, space) = (description.name.clone(), solver.method(), solver.space.clone());
        let goal = solver.goal;
        let joint = |v: &Variable| (v.symbol.name().to_string(), v.kind);
        let joints = variables.iter().map(joint).collect();
        let called = description.joint_names();
        Question { given, criterion, wanted, robot, goal, method, names, called, space, joints, ideal }
    }

    /// The answer, and the solution that is best by the criterion, if there is one; `at` is a configuration that the pose was
    /// taken from.
    pub fn ask(&self, solver: &InverseKinematics, pose: &Transform<f64>, at: Option<&[f64]>) -> Found {
        let mut answer = match (&self.criterion, self.wanted.one) {
            (Some(Criterion::Nearest(to)), true) => solver.one(pose, &self.given, Some(to)),
            (_, true) => solver.one(pose, &self.given, None),
            _ => solver.solve(pose, &self.given),
        };
        if let (Some(q), false) = (at, self.wanted.one) {
            solver.include(pose, &mut answer, q);
        }
        let best = self.criterion.as_ref().and_then(|c| solver.best(pose, &answer, c));
        let left_out = self.wanted.within_limits.then(|| answer.leave_out(&self.space));
        let best = best.filter(|b| b.within_limits || !self.wanted.within_limits);
        Found { answer, best, left_out, jump: None }
    }

    /// What a jump is in words.
    pub fn jump(&self, jump: &Jump) -> String {
        words().jump(jump, &self.joints)
    }

    /// What the best solution is called.
    fn superlative(&self) -> &'static str {
        match self.criterion {
            Some(Criterion::Nearest(_)) => "nearest",
            _ => "best",
        }
    }

    /// The answer.
    pub fn wire(&self, pose: &Transform<f64>, found: &Found) -> wire::Answer {
        let (answer, nearest) = (&found.answer, found.best.as_ref());
        let solution = |s: &Solution| {
            let one = wire::Solution::of(s, &self.space);
            if self.lists_copies() { one.with_copies(&self.space) } else { one }
        };
        let is_near = matches!(self.criterion, Some(Criterion::Nearest(_)));
        wire::Answer {
            best: nearest.filter(|_| !is_near).map(wire::Nearest::best),
            complete: answer.is_complete(),
            doubt: wire::doubt(answer),
            families: answer.families.iter().map(|f| wire::Family::of(f, &self.space)).collect(),
            given: self.names.iter().cloned().collect(),
            idealised: self.ideal.clone(),
            joints: self.called.clone(),
            jump: found.jump.as_ref().map(|j| wire::Jump::of(j, &self.joints)),
            left_out: found.left_out,
            method: self.method,
            nearest: nearest.filter(|_| is_near).map(wire::Nearest::of),
            obstacle: answer.obstacle.as_ref().map(wire::Obstacle::from),
            pose: pose.matrix(),
            robot: self.robot.clone(),
            schema: Schema,
            solutions: answer.solutions.iter().map(solution).collect(),
            status: wire::status_within(answer, found.left_out),
        }
    }

    /// Whether there can be copies: of one pose, of an arm with limits.
    fn lists_copies(&self) -> bool {
        self.wanted.copies && self.space.limits.iter().any(Option::is_some)
    }
}

impl Found {
    /// Whether there are solutions, and the limits exclude them all.
    pub fn excluded(&self) -> bool {
        !self.answer.is_reachable() && self.left_out.is_some_and(|n| n > 0)
    }
}

/// Why there is no solution.
pub fn obstacle(d: &Description, answer: &Answer) -> String {
    const NOT_FOUND: &str = "no solution was found, and none is excluded";
    match &answer.obstacle {
        Some(found @ Obstacle { q, angle, distance, violated, .. }) => {
            let head = match answer.is_complete() {
                true => format!("unreachable: {}", words().obstacle(found)),
                false => NOT_FOUND.into(),
            };
            let conditions: Vec<&str> = violated.iter().map(|v| v.0.as_str()).collect();
            let which = match conditions[..] {
                [] => String::new(),
                _ => format!("\n  {}", words().violated(&conditions)),
            };
            let at: Vec<String> = d
                .variables()
                .iter()
                .zip(q)
                .map(|(v, &x)| format!("{} = {}", v.symbol.name(), reading(x, v.kind)))
                .collect();
            format!(
                "{head}; nearest found, {} and {} away: {}{which}",
                reading(*angle, JointKind::Revolute),
                reading(*distance, JointKind::Prismatic),
                at.join(", ")
            )
        }
        None if answer.is_complete() => "unreachable".into(),
        None => NOT_FOUND.into(),
    }
}

/// The answer for reading.
pub struct Report<'a> {
    /// What was asked.
    pub solver: &'a InverseKinematics,
    pub question: &'a Question,
    /// The robot.
    pub description: &'a Description,
    /// The pose.
    pub pose: &'a Transform<f64>,
    /// Its solutions.
    pub answer: &'a Answer,
    /// How many were left out, if any were to be.
    pub left_out: Option<usize>,
    /// The configuration that the pose was taken from.
    pub at: Option<&'a [f64]>,
    /// The solution nearest to what was asked for.
    pub nearest: Option<&'a Nearest>,
}

/// Joint values closer than this are shown as the same configuration.
const SAME: f64 = 1e-6;
/// Solutions this far apart do not nearly coincide.
const FAR: f64 = 0.1;
/// Copies that are shown.
const COPIES: usize = 8;

impl Report<'_> {
    /// Pose, solutions, families.
    pub fn text(&self) -> String {
        let (d, answer) = (self.description, self.answer);
        let count = match (answer.solutions.len(), answer.families.len()) {
            (0, 0) => "no solution".to_string(),
            (n, 0) => plural(n, "solution"),
            (0, 1) => "one family of solutions".into(),
            (0, n) => format!("{n} families of solutions"),
            (n, m) => format!(
                "{} and {}",
                plural(n, "solution"),
                if m == 1 { "1 family".into() } else { format!("{m} families") }
            ),
        };
        let mut text = format!("{}: {count} for\n\n{}", styled(&d.name, HEADING), joint_names(d));
        let noise = noise([self.pose]);
        let rows: Vec<Vec<String>> =
            self.pose.matrix().iter().map(|r| r.iter().map(|&x| number(x, noise)).collect()).collect();
        text += &matrix("T = ", &rows, Align::Right);
        for (name, x) in &self.question.names {
            let kind = d.variables().iter().find(|v| *v.symbol.name() == **name).map(|v| v.kind);
            text += &format!(
                "  {} = {} given\n",
                styled(name, NAME),
                reading(*x, kind.unwrap_or(JointKind::Revolute))
            );
        }
        if !answer.solutions.is_empty() {
            text.push('\n');
            text += &self.table(answer.solutions.iter());
        }
        text += &self.copies();
        for (k, f) in answer.families.iter().enumerate() {
            text += &self.family(k, f);
        }
        if let Some(n) = self.left_out {
            text += &match n {
                0 => "\n  none is outside the limits\n".to_string(),
                1 => "\n  1 is outside the limits and left out\n".to_string(),
                n => format!("\n  {n} are outside the limits and left out\n"),
            };
        }
        if let Some(nearest) = self.nearest {
            let at: Vec<String> =
                d.variables().iter().zip(&nearest.q).map(|(v, &x)| reading(x, v.kind)).collect();
            let note = if nearest.within_limits { "" } else { ", outside the limits" };
            text += &format!("\n  {}{note}: {}\n", self.question.superlative(), at.join(", "));
        }
        text += &self.unmarked();
        if let Some(doubt) = answer.doubt {
            text += &format!("  not complete, there may be more: {}\n", words().doubt(doubt));
        }
        text
    }

    /// Where the configuration that the pose was taken from is, if it is none of the rows.
    fn unmarked(&self) -> String {
        let Some(at) = self.at else { return String::new() };
        let representatives = self.answer.families.iter().map(|f| &f.representative);
        if self
            .answer
            .solutions
            .iter()
            .chain(representatives)
            .any(|s| self.question.space.is_listed_as(at, &s.q))
        {
            return String::new();
        }
        if let Some(k) = self.solver.family_of(self.pose, self.answer, at) {
            return format!("\n  -q is a member of family {}\n", k + 1);
        }
        let Some(nearest) = self.solver.nearest(self.pose, self.answer, at) else { return String::new() };
        let away = nearest.distance;
        // Outside of the limits its copies are far away.
        if away > FAR {
            return String::new();
        }
        if let Some(k) = self.answer.solutions.iter().position(|s| self.question.space.is_same(at, &s.q)) {
            return format!("\n  -q is solution {} moved by periods of its joints\n", k + 1);
        }
        match away <= SAME {
            true => "\n  -q is a member of a family\n".into(),
            false if self.question.ideal.is_some() => format!(
                "\n  -q is {} from the nearest of these, which are those of the idealised arm, as their residuals are\n",
                reading(away, JointKind::Revolute)
            ),
            false => format!(
                "\n  -q is {} from the nearest of these: so close are solutions to each other where the arm is nearly singular\n",
                reading(away, JointKind::Revolute)
            ),
        }
    }

    /// Copies of the solutions within the limits, whole turns away: some of them, and how many there are.
    fn copies(&self) -> String {
        if !self.question.lists_copies() {
            return String::new();
        }
        let (space, variables) = (&self.question.space, self.description.variables());
        let mut rows: Vec<Vec<String>> = vec![];
        let mut count = 0_u64;
        for (k, s) in self.answer.solutions.iter().enumerate() {
            let is_itself = |q: &[f64]| q == s.q;
            let all = space.listed_copies(&s.q, COPIES + 1);
            let is_listed = all.iter().any(|q| is_itself(q));
            count = count.saturating_add(space.copies_within(&s.q) - u64::from(is_listed));
            for q in all.iter().filter(|q| !is_itself(q)).take(COPIES - rows.len().min(COPIES)) {
                let values = variables.iter().zip(q).map(|(v, &x)| reading(x, v.kind));
                rows.push(std::iter::once(format!("{}", k + 1)).chain(values).collect());
            }
        }
        if rows.is_empty() {
            return String::new();
        }
        let names: Vec<String> = variables.iter().map(|v| v.symbol.name().to_string()).collect();
        let header: Vec<&str> = std::iter::once("of").chain(names.iter().map(String::as_str)).collect();
        let rest = count.saturating_sub(rows.len() as u64);
        let more = match rest {
            0 => String::new(),
            n => format!("  and {n} more, which --json lists (up to {} of each)\n", wire::MOST_COPIES),
        };
        format!(
            "\n  the same whole turns away, within the limits: {count}\n{}{more}",
            table(&header, &vec![Align::Right; header.len()], &rows)
        )
    }

    fn table<'s>(&self, solutions: impl Iterator<Item = &'s Solution>) -> String {
        let variables = self.description.variables();
        let names: Vec<String> = variables.iter().map(|v| v.symbol.name().to_string()).collect();
        let mut header: Vec<&str> = vec![""];
        header.extend(names.iter().map(String::as_str));
        header.extend(["branch", "residual", ""]);
        let mut align = vec![Align::Right; 1 + names.len()];
        align.extend([Align::Left, Align::Right, Align::Left]);
        let rows: Vec<Vec<String>> = solutions
            .enumerate()
            .map(|(k, s)| {
                let mut row = vec![(k + 1).to_string()];
                row.extend(variables.iter().zip(&s.q).map(|(v, &x)| reading(x, v.kind)));
                row.push(words().branch(&s.branch));
                row.push(format!("{:.0e}", s.residual));
                let mut notes = vec![];
                if s.multiplicity > 1 {
                    notes.push(format!("{}-fold", s.multiplicity));
                }
                if !s.within_limits {
                    notes.push("outside the limits".into());
                }
                if self.at.is_some_and(|q| self.question.space.is_listed_as(q, &s.q)) {
                    notes.push("← -q".into());
                }
                row.push(notes.join(", "));
                row
            })
            .collect();
        table(&header, &align, &rows)
    }

    fn family(&self, k: usize, f: &Family) -> String {
        let mut text = format!(
            "\n  {}: the {} stands still while {}{}\n",
            styled(&format!("family {}", k + 1), HEADING),
            if self.question.goal == Goal::Position { "point of the tool" } else { "hand" },
            self.moving(f),
            match (f.is_affine, f.dimension) {
                (true, _) => ", in these proportions everywhere",
                (false, 1) => ", in these proportions here",
                _ => "",
            }
        );
        let free = f.free.join(", ");
        let is_length = f.free == ["s"];
        let mut of = format!("free: {free}");
        if is_length {
            of += ", the length along the curve in radians (slides by the arm's size)";
        }
        let shown = |x: f64| match self.description.variables().iter().find(|v| *v.symbol.name() == *free) {
            Some(v) => reading(x, v.kind),
            None if free == "s" => number(x, 1e-9),
            None => reading(x, JointKind::Revolute),
        };
        if let Some([low, high]) = f.interval {
            of += &format!(", from {} to {}", shown(low), shown(high));
        }
        if !f.feasible.is_empty() && self.question.space.limits.iter().any(Option::is_some) {
            let stretch = |[low, high]: &[f64; 2]| format!("{} to {}", shown(*low), shown(*high));
            let stretches: Vec<String> = f.feasible.iter().map(stretch).collect();
            of += &format!("; within the limits {}", stretches.join(", "));
        }
        let of_joint = self.description.variables().iter().position(|v| *v.symbol.name() == *free);
        if let (Some(j), true) = (of_joint, f.feasible.is_empty())
            && let Some([low, high]) = self.question.space.limits[j]
        {
            of += &format!("; its limits are {} and {}", shown(low), shown(high));
        }
        if f.dimension > 1 {
            of += &format!("; {} parameters, all of them together in one family", f.dimension);
        }
        text += &format!("  {}\n", styled(&of, FAINT));
        text + &self.table(std::iter::once(&f.representative))
    }

    /// `q4 : −q6`, the joints that move.
    fn moving(&self, f: &Family) -> String {
        let largest = f.direction.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let variables = self.description.variables();
        let moving = variables.iter().zip(&f.direction).filter(|(_, x)| x.abs() > 1e-9);
        let moving: Vec<_> = moving.collect();
        if let [(v, _)] = moving[..] {
            return format!("{} moves", v.symbol.name());
        }
        let part =
            |(v, x): &(&Variable, &f64)| format!("{} by {}", v.symbol.name(), number(*x / largest, 1e-9));
        format!("{} move", moving.iter().map(part).collect::<Vec<_>>().join(", "))
    }
}
