//! Inverse kinematics.

use super::{English, counted};
use crate::explained::{Bound, Case, Component, Consequence, Kind, Remark, Source};
use crate::tree::{Line, Math, Proof, Sign};
use crate::words::{Coefficients, Given, Inverse, Terms};
use denavit::inverse::derivation::{Elimination, NotGiven};
use denavit::inverse::{Doubt, Goal, Label, Obstacle, Stuck, Task, Unsuitable};
use denavit_symbolic::Expr;

const ORDINALS: [&str; 5] = ["zeroth", "first", "second", "third", "fourth"];

impl Inverse for English {
    fn inverse_title(&self, robot: &str) -> String {
        format!("Inverse kinematics of the {robot}")
    }

    fn other_joints(&self) -> String {
        "The other joints".into()
    }

    fn solutions_found(&self, solutions: Option<usize>) -> String {
        match solutions {
            Some(1) => "one solution".into(),
            Some(n) => format!("at most {n} solutions"),
            None => "here the derivation ends: no closed form was found".into(),
        }
    }

    fn given(&self, given: Given) -> Line {
        let mut line = Line::new(match given.goal {
            Goal::Pose => "Given the pose T of the hand",
            Goal::Position => "Given the position of the hand",
            Goal::PositionAndAxis => "Given the position of the hand and the direction of its z axis",
        });
        let beside = given.joints.len();
        if beside > 0 {
            line = line.text(" and ").list(given.joints);
        }
        line = line.text(match (given.is_choice && beside > 0, beside) {
            (false, _) => "",
            (true, 1) => {
                " (a joint too many: any value is allowed, and the derivation is shortest with this one)"
            }
            (true, _) => {
                " (joints too many: any values are allowed, and the derivation is shortest with these)"
            }
        });
        let line = line.text("; sought ").list(given.sought).text(". ");
        match given.is_whole {
            true => line.text("With ").math(Given::whole()).text(" the chain is"),
            false => {
                line.text("What is constant at both ends is taken to the side of the pose; what is left is")
            }
        }
    }

    fn given_columns(&self, has_axis: bool) -> &'static str {
        match has_axis {
            true => "Of U the third and fourth columns alone are given; the others follow from the solution.",
            false => "Of U the fourth column alone is given; the others follow from the solution.",
        }
    }

    fn short_names(&self, q: Expr, sum: Option<Expr>) -> Line {
        let line = Line::default().math(q.cos()).text(" and ").math(q.sin());
        let line = line.text(" are cosine and sine of ").math(q);
        match sum {
            Some(sum) => line.text(", ").math(sum.cos()).text(" is the cosine of ").math(sum).text("."),
            None => line.text("."),
        }
    }

    fn step_title(&self, number: usize, unknown: Line, values: usize, label: Option<Label>) -> Line {
        let mut line = Line::new(format!("Step {number}. "));
        line.0.extend(unknown.0);
        let line = line.text(match values {
            1 => ": one value".into(),
            n => format!(": {n} values"),
        });
        line.text(label.map(|l| format!(" ({})", self.label(l))).unwrap_or_default())
    }

    fn source(&self, source: &Source) -> Line {
        let (left, right) = source.product.clone();
        let mut line = Line::new(if source.inverse { "The inverse of both sides of " } else { "" });
        line = line.math(Math::Products(left, right)).text(", ");
        let [rows, columns] = source.rows_and_columns();
        let several = |all: &[usize], word: &str| {
            let names: Vec<String> = all.iter().map(|&n| ORDINALS[n.min(4)].to_string()).collect();
            format!("{} {word}{}", self.listed(&names), if all.len() == 1 { "" } else { "s" })
        };
        line = line.text(match (rows.len(), columns.len()) {
            (1, _) | (_, 1) => format!("{}, {}", several(&rows, "row"), several(&columns, "column")),
            _ => {
                let places: Vec<String> =
                    source.elements.iter().map(|(r, c)| format!("({r}, {c})")).collect();
                format!("elements {}", self.listed(&places))
            }
        });
        let why = source.why.as_ref().map(|why| format!(" ({})", self.component(why)));
        line.text(why.unwrap_or_default()).text(":")
    }

    fn component(&self, component: &Component) -> String {
        let numbers = |all: &[usize]| self.numbers(all);
        let along = match &component.along[..] {
            [] => String::new(),
            [axis] => format!(" along axis {}", axis + 1),
            axes => format!(" along the parallel axes {}", numbers(axes)),
        };
        let of = match (&component.of[..], component.is_point) {
            ([], _) => String::new(),
            ([axis], false) => format!(" of the direction of axis {}", axis + 1),
            (axes, false) => format!(" of the direction of axes {}", numbers(axes)),
            ([axis], true) => format!(" of a point on axis {}", axis + 1),
            (axes, true) => format!(" of a point on axes {}", numbers(axes)),
        };
        let free = match &component.free[..] {
            [joint] => format!(": free of joint {}", joint + 1),
            joints => format!(": free of joints {}", numbers(joints)),
        };
        format!("a component{along}{of}{free}")
    }

    fn elimination(&self, unknown: Expr, how: Elimination) -> Line {
        Line::default().math(unknown).text(match how {
            Elimination::Rotation => {
                " goes out when the two are solved for its terms, squared and added: the factors of its cosine and sine \
                 are those of a rotation."
            }
            Elimination::Cramer => {
                " goes out when its cosine and sine are solved for by Cramer's rule; the sum of their squares is 1."
            }
            Elimination::Displacement => " goes out when one is solved for it and put into the other.",
        })
    }

    fn names_follow(&self, is_beside: bool) -> String {
        if is_beside { "with" } else { "Let" }.into()
    }

    fn kind(&self, kind: Kind) -> String {
        match kind {
            Kind::Displacement => "linear in the displacement",
            Kind::DisplacementSquared => "quadratic in the displacement",
            Kind::Quartic => "of degree 2 in cosine and sine: degree 4 in tan(θ/2)",
            Kind::Homogeneous => "linear in cosine and sine, without right-hand side",
            Kind::Cosine => "one cosine alone",
            Kind::Sine => "one sine alone",
            Kind::Linear => "linear in cosine and sine",
            Kind::Pair => "two equations, linear in cosine and sine",
            Kind::Separate => "cosine and sine, each from an equation of its own",
        }
        .into()
    }

    fn equation(&self, kind: Kind, is_squared: bool, form: &[Math], coefficients: &Coefficients) -> Line {
        let mut line = Line::new(match (kind.number(), is_squared) {
            ("none", _) => "An equation ".to_string(),
            (n, true) => format!("The squares of both sides, added: type {n}, "),
            (n, false) => format!("Type {n}, "),
        });
        line = line.text(self.kind(kind));
        for (k, f) in form.iter().enumerate() {
            line = line.text(if k == 0 { ": " } else { " and " }).math(f.clone());
        }
        match coefficients {
            Coefficients::Below => line.text(" with"),
            Coefficients::Here([]) => line.text("; so"),
            Coefficients::Here(all) => line.text(" with ").list(all.iter().cloned()).text("; so"),
        }
    }

    fn so(&self) -> String {
        "so".into()
    }

    fn case(&self, case: &Case) -> Line {
        let mut line = Line::default();
        let between = if case.is_zeros() { " and " } else { " or " };
        for (k, m) in case.when.iter().enumerate() {
            line = line.text(if k == 0 { "" } else { between }).math(m.clone());
        }
        line.text(if case.when.is_empty() { "" } else { ": " }).text(self.consequence(case.then))
    }

    fn consequence(&self, consequence: Consequence) -> String {
        match consequence {
            Consequence::NoSolution(bound) => nothing(bound),
            Consequence::Coincide => "both values coincide (multiplicity 2)",
            Consequence::TwoValues(bound) => {
                return format!(
                    "two values; they coincide where equality holds (multiplicity 2, a singular configuration); otherwise {}",
                    nothing(bound)
                );
            }
            Consequence::OpenDisplacement => {
                "the equation does not determine the displacement: if the right-hand side vanishes too, it is free or \
                 another equation gives it; else no solution"
            }
            Consequence::OpenAngle => {
                "the equation leaves the angle open: it is free (the arm can move without leaving the target), or another \
                 equation gives it"
            }
            Consequence::OpenUnless => {
                "no solution, unless the right-hand side vanishes too: then the equation leaves the joint open"
            }
            Consequence::OpenJoint => {
                "if the right-hand sides vanish too, the joint is free or another equation gives it; else no solution"
            }
            Consequence::Roots => {
                "as many values as the polynomial has real roots t = tan(θ/2): 0, 2 or 4; a double root counts twice"
            }
            Consequence::HalfTurn => "one root is the half turn",
            Consequence::Free => "the joint is free",
            Consequence::OneValue => "always exactly one value",
            Consequence::OneEquation => {
                "the two equations are one: two values, or a free joint, or none; the solver goes by the longer row"
            }
        }
        .into()
    }

    fn remark(&self, remark: Remark) -> String {
        match remark {
            Remark::MayAdd => {
                "The elimination may add roots that solve this equation alone; the residual of the pose sorts them out."
            }
            Remark::SquaresAddNone => {
                "Squaring adds no root: for each value of the unknown the components give the direction that was squared \
                 away."
            }
            Remark::Whole => "Nothing is dropped, nothing is squared.",
            Remark::AddsNone => "No root is added.",
        }
        .into()
    }

    fn step_remark(&self, sign: Option<(Expr, Option<Label>)>, remark: Remark, used_by: &[usize]) -> Line {
        let mut line = Line::default();
        if let Some((sign, label)) = sign {
            line = line.math(Math::relation(sign, Sign::EitherSign, Expr::int(1)));
            if let Some(label) = label.map(|l| self.label(l)) {
                line = line.text(format!(": {label}+ and {label}−"));
            }
            line = line.text(". ");
        }
        line.text(self.remark(remark)).text(match used_by {
            [] => " No later step needs it.".to_string(),
            [one] => format!(" Used by step {one}."),
            many => {
                let many: Vec<String> = many.iter().map(ToString::to_string).collect();
                format!(" Used by steps {}.", self.listed(&many))
            }
        })
    }

    fn conditions_title(&self) -> String {
        "What the pose must meet".into()
    }

    fn conditions(&self, rank: usize, task: Option<Task>) -> String {
        let told = task.map(|t| format!(": it can be told {}", self.task(t))).unwrap_or_default();
        // Of these there is always the plural.
        format!("The hand can move in {rank} independent directions{told}. A pose that is reached meets")
    }

    fn task(&self, task: Task) -> String {
        match task {
            Task::Pose => "any position and orientation".into(),
            Task::PositionAndAxis => "a position and the direction of the tool's axis".into(),
            Task::PositionAndTurn => "a position and a turn about one direction (x, y, z, φ)".into(),
            Task::Planar => "a place and a turn in a plane (x, y, φ)".into(),
            Task::Position => "a position (x, y, z)".into(),
            Task::Orientation => "an orientation".into(),
            Task::Other(n) => format!("a {n}-dimensional set of poses"),
        }
    }

    fn solutions_title(&self, solutions: usize) -> String {
        match solutions {
            1 => "One solution".into(),
            n => format!("At most {n} solutions"),
        }
    }

    fn solutions_product(&self, product: &str) -> String {
        format!("{product} branches:")
    }

    fn solutions_remark(&self) -> String {
        "Each step follows from the equations before it and has all their roots, so no solution is lost. \
         Each solution is put into the whole chain again; what does not give the pose is dropped. \
         The types are numbered as by Khalil and Dombre; 1, 2 and 3 are Paul's."
            .into()
    }

    fn ended_title(&self) -> String {
        "Here the derivation ends".into()
    }

    fn ended(&self, has_found: bool, missing: Vec<Math>) -> Line {
        let line = Line::new(if has_found { "" } else { "Nothing was found. " });
        let line =
            line.text("No equation of the chain, and no combination of two of them that was tried, holds ");
        line.list(missing).text(" in one unknown with degree up to 4 in tan(θ/2).")
    }

    fn ended_remark(&self, surplus: usize) -> String {
        if surplus == 0 {
            return "Closed forms exist where three axes in a row meet in one point or are parallel; \
                    where neither is so, the general arm has up to 16 solutions, roots of one polynomial of degree 16."
                .into();
        }
        format!(
            "The arm has {} more than the hand can use: with other joints given the derivation may end.",
            counted(surplus, "joint", "joints")
        )
    }

    fn solution(&self, number: usize) -> String {
        format!("solution {number}")
    }

    fn legend(&self, proof: Proof) -> String {
        match proof {
            Proof::Proved => {
                "✓: proved. With A1·A2·… put in for U, both sides are identical, whatever the joint values and lengths."
            }
            Proof::Sampled => {
                "✓: proved. ≈: checked at sample poses only; the expansion is too large to decide."
            }
            Proof::Wrong => "A formula above is NOT TRUE: this is an error of the program.",
        }
        .into()
    }

    fn unsuitable(&self, why: &Unsuitable) -> String {
        why.to_string()
    }

    fn not_given(&self, why: NotGiven) -> String {
        why.to_string()
    }

    fn stuck(&self, stuck: &Stuck) -> String {
        stuck.to_string()
    }

    fn doubt(&self, doubt: Doubt) -> String {
        match doubt {
            Doubt::Sampled => "some solutions were found by trying values",
            Doubt::DoubleRoot => "undecided near a double root",
            Doubt::Uncounted => "the roots could not be counted",
            Doubt::Searched => "searched for from several starts",
            Doubt::OneAsked => "one was asked for",
            Doubt::Copies => "gears repeat each configuration more often within a turn than is listed",
            Doubt::Digits => "the robot stands so far from the origin that the pose has too few digits",
        }
        .into()
    }

    fn obstacle(&self, obstacle: &Obstacle) -> String {
        match &obstacle.unknown {
            Some(x) => format!("no branch has a value for {x}"),
            None => "the hand cannot take this pose".into(),
        }
    }

    fn violated(&self, conditions: &[&str]) -> String {
        format!("a pose of this arm meets {}", conditions.join(", "))
    }
}

fn nothing(bound: Bound) -> &'static str {
    match bound {
        Bound::Reach => "out of reach: no solution on this branch",
        Bound::Span => "the arm is too short, or cannot fold so far: no solution on this branch",
    }
}
