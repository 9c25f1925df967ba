//! The sections of a report.

use super::{English, counted};
use crate::tree::{Line, Math};
use crate::words::report::{Caption, Column, Factors, Glance, Heading, List, Names, Report, Standings};
use crate::words::{Inverse, Terms};
use denavit::description::{Convention, JointKind};
use denavit::forward::Proof;
use denavit::inverse::Refusal;
use denavit::structure::{Relation, Structure};
use denavit::workspace::Section as Plane;
use denavit_program::{COUNTING_RULE, Count};
use denavit_symbolic::Refusal as Unexpanded;

impl Report for English {
    fn title(&self, robot: &str) -> String {
        format!("Kinematics of the {robot}")
    }

    fn of_the_position(&self, said: &str) -> String {
        format!("The position alone: {said}")
    }

    fn compared(&self, robots: &[&str]) -> String {
        format!("{} compared", self.listed(&robots.iter().map(ToString::to_string).collect::<Vec<_>>()))
    }

    fn beside_each_other(&self, have_one_scale: bool) -> [&'static str; 2] {
        let pictures = match have_one_scale {
            true => "The robots at one scale.",
            false => "The robots, each as large as its picture allows.",
        };
        ["The robots at a glance.", pictures]
    }

    fn heading(&self, heading: Heading) -> String {
        match heading {
            Heading::Arm => "The arm",
            Heading::Arms => "The arms",
            Heading::Table => "Denavit–Hartenberg table",
            Heading::Links => "Link transforms",
            Heading::Algorithm => "Algorithm",
            Heading::Example => "A worked example",
            Heading::Inverse => "Inverse kinematics",
            Heading::Solutions => "The solutions at the example",
            Heading::Velocity => "Jacobian and singularities",
            Heading::Dynamics => "Dynamics",
            Heading::Workspace => "Workspace",
            Heading::Errata => "Errata",
            Heading::References => "References",
        }
        .into()
    }

    fn glance(&self, glance: Glance) -> String {
        match glance {
            Glance::Structure => "Structure",
            Glance::Convention => "Convention",
            Glance::Source => "Source",
            Glance::Forward => "Forward model",
            Glance::Inverse => "Inverse model",
            Glance::Singularities => "Singularities",
        }
        .into()
    }

    fn column(&self, column: Column) -> String {
        match column {
            Column::Joint => "joint",
            Column::Torque => "holding torque",
            Column::Inertia => "inertia",
            Column::Name => "name",
            Column::Limits => "limits",
            Column::Branch => "branch",
            Column::Step => "step",
            Column::Value => "value",
        }
        .into()
    }

    fn caption(&self, caption: Caption) -> String {
        match caption {
            Caption::AtRest => {
                "What holds the arm at rest against gravity, and the inertia that each joint feels alone, at"
            }
            Caption::Steps => "The steps of the forward algorithm in numbers; lengths in metres.",
            Caption::Configurations => "All configurations with this pose.",
            Caption::Picture => "The configuration of the table.",
            Caption::Pictures => "The configurations of the table, all with the same pose of the tool.",
            Caption::Singular => "A configuration at each singularity; the axes that make it one are marked.",
            Caption::Scheme => {
                "Line diagram: the axes of the joints, their variables and the lengths between them."
            }
        }
        .into()
    }

    fn table(&self) -> &'static str {
        "Table"
    }

    fn figure(&self) -> &'static str {
        "Figure"
    }

    fn contents(&self) -> &'static str {
        "Contents"
    }

    fn turning(&self) -> [&'static str; 2] {
        ["Previous step", "Next step"]
    }

    fn formula(&self) -> &'static str {
        "formula"
    }

    fn picture(&self, own: &str, whole: &str) -> String {
        format!("{own}: {whole}")
    }

    fn arm_picture(&self, is_scheme: bool, robot: &str, joints: &str) -> String {
        let what = if is_scheme { "Line diagram" } else { "Picture" };
        format!("{what} of {robot}, joints {joints} from the base to the hand")
    }

    fn workspace_picture(&self, plane: &Plane, [[a, b], [c, d]]: [[String; 2]; 2]) -> String {
        let [u, v] = plane.symbols();
        let what = match plane {
            Plane::ThroughAxis { joint, .. } => {
                format!("half plane through axis {} (distance {u} from it, height {v} along it)", joint + 1)
            }
            Plane::Plane { .. } => format!("{u}–{v} plane, in which the arm moves"),
            Plane::Projection { .. } => format!("projection onto the {u}–{v} plane"),
        };
        format!(
            "Section of the workspace, {what}: {u} from {a} to {b} m, {v} from {c} to {d} m; coloured by manipulability, \
             its largest value 1"
        )
    }

    fn curves_picture(&self, title: &str, names: &[String]) -> String {
        format!("{title}: {} over the horizontal axis", names.join(", "))
    }

    fn assumed_lengths(&self) -> String {
        "The robot gives no values for some lengths. Figures and numbers take ".into()
    }

    fn structure(&self, structure: &Structure) -> String {
        let kind = |k: &JointKind| if *k == JointKind::Revolute { 'R' } else { 'P' };
        let kinds: String = structure.joints.iter().map(kind).collect();
        let n = kinds.len();
        let mut text = format!("{kinds}, {}; {}", counted(n, "joint", "joints"), structure.schematic());
        let numbers = |all: &[usize]| self.listed(&all.iter().map(ToString::to_string).collect::<Vec<_>>());
        for run in &structure.parallel {
            text += &format!("; axes {} are parallel", numbers(run));
        }
        for &first in &structure.spherical {
            let what = if first + 2 == n { "spherical wrist" } else { "spherical joint" };
            text += &format!("; axes {} meet in one point ({what})", numbers(&[first, first + 1, first + 2]));
        }
        for (k, _) in structure.relations.iter().enumerate().filter(|r| *r.1 == Relation::Coincident) {
            text += &format!("; axes {} and {} coincide", k + 1, k + 2);
        }
        text + "."
    }

    fn convention(&self, convention: Convention) -> String {
        match convention {
            Convention::Standard => {
                "Denavit–Hartenberg, standard: Rot(z, θ) Trans(z, d) Trans(x, a) Rot(x, α)."
            }
            Convention::Craig => {
                "Denavit–Hartenberg, modified (Craig): Rot(x, α) Trans(x, a) Rot(z, θ) Trans(z, d)."
            }
            Convention::Khalil => "Khalil–Kleinfinger: Rot(x, α) Trans(x, d) Rot(z, θ) Trans(z, r).",
        }
        .into()
    }

    fn forward_cost(&self, count: &Count, proof: Proof) -> String {
        format!("{}; {}.", self.count(count), self.forward_proof(proof))
    }

    fn closed_form(&self, solutions: usize, given: &[String]) -> String {
        let count = match solutions {
            1 => "one solution".into(),
            n => format!("at most {n} solutions"),
        };
        match given {
            [] => format!("closed form, {count}."),
            _ => format!("closed form, {count}, for each value of {}.", given.join(", ")),
        }
    }

    fn no_closed_form(&self, by_elimination: bool) -> String {
        match by_elimination {
            true => "no closed form; all solutions, at most 16, by elimination.",
            false => "no closed form; in numbers.",
        }
        .into()
    }

    fn factors(&self, factors: Factors) -> Line {
        Line::new(match factors {
            Factors::None => "none.",
            Factors::NotShared => {
                "where all determinants of the section on the Jacobian vanish at once; no single factor is shared by them."
            }
            Factors::Long => "factors of the determinant that are too long for a summary.",
            Factors::Everywhere => "the arm has fewer than six directions everywhere.",
            Factors::TooLarge => "too large to be expanded.",
            Factors::Shared(all, is_complete) => {
                let mut line = Line::default();
                for (k, math) in all.into_iter().enumerate() {
                    line = line.text(if k > 0 { "; " } else { "" }).math(math);
                }
                return line.text(match is_complete {
                    true => ".",
                    false => ", and where all determinants of the section on the Jacobian vanish at once.",
                });
            }
        })
    }

    fn arm_caption(&self, configuration: Line) -> Line {
        let mut line = Line::new("The arm with its frames and lengths, at ");
        line.0.extend(configuration.0);
        line.text(". Cylinders turn, boxes slide; x axes red, z axes blue.")
    }

    fn converted(&self, convention: Convention) -> String {
        match convention {
            Convention::Standard => "In the standard convention",
            Convention::Craig => "In Craig's convention",
            Convention::Khalil => "In Khalil and Kleinfinger's convention",
        }
        .into()
    }

    fn same_pose(&self, is_proved: bool) -> String {
        match is_proved {
            true => {
                "Proved: both tables give the same pose of the tool, whatever the joint values and lengths."
            }
            false => "That both tables give the same pose is not proved: the expansion is too large.",
        }
        .into()
    }

    fn parameter(&self, is_angle: bool, axis: char, frame: &str) -> String {
        let (what, how) = if is_angle { ("angle", "about") } else { ("distance", "along") };
        let other = if axis == 'z' { 'x' } else { 'z' };
        format!(
            ": {what} from the {other} axis of frame j−1 to that of frame j, {how} the {axis} axis of frame {frame}"
        )
    }

    fn parameters(&self, convention: Convention) -> String {
        let convention = match convention {
            Convention::Standard => "the standard",
            Convention::Craig => "Craig's (modified)",
            Convention::Khalil => "Khalil and Kleinfinger's",
        };
        format!("Parameters in {convention} convention; lengths in metres.")
    }

    fn base_stands(&self) -> String {
        "Frame 0 stands in the base at".into()
    }

    fn tool_stands(&self) -> String {
        "The tool stands in the last frame at".into()
    }

    fn base(&self) -> String {
        "base".into()
    }

    fn tool(&self) -> String {
        "tool".into()
    }

    fn values(&self) -> String {
        "Values: ".into()
    }

    fn row_transform(&self) -> String {
        "The transform of a row of the table is".into()
    }

    fn row_by_row(&self) -> String {
        "and so, row by row,".into()
    }

    fn forward_title(&self) -> String {
        "Forward model ".into()
    }

    fn image_title(&self, is_point: bool) -> String {
        if is_point { "A point in the other frame" } else { "A free vector in the other frame" }.into()
    }

    fn image(&self, is_point: bool, of: [Math; 3], from: &str, to: &str) -> Line {
        let (what, how) = match is_point {
            true => ("point", "it is turned and shifted (a fourth coordinate 1)"),
            false => ("vector", "it is turned and not shifted (a fourth coordinate 0)"),
        };
        let line = Line::new(format!("The {what} (")).list(of);
        line.text(format!(") of frame {to} has in frame {from} these coordinates: {how}."))
    }

    fn long_matrix(&self) -> String {
        "The entries of the matrix are too long to be printed; the algorithm below computes them.".into()
    }

    fn no_matrix(&self, why: Unexpanded) -> String {
        format!("The matrix is not expanded: {}.", self.unexpanded(why))
    }

    fn shortest_program(&self) -> String {
        "The same model as the shortest program that was found for it:".into()
    }

    fn names(&self, all: Vec<Names>) -> Line {
        let mut line = Line::default();
        for (k, one) in all.into_iter().enumerate() {
            line = line.text(if k > 0 { "; " } else { "" }).list(one.names);
            line = line.text(match (one.has_cosine, one.has_sine) {
                (true, false) => ": cosine of ",
                (true, true) => ": cosine and sine of ",
                (false, _) => ": sine of ",
            });
            line = line.math(one.angle);
        }
        if line.0.is_empty() { line } else { line.text(".") }
    }

    fn counting_rule(&self) -> String {
        format!("Counted: {COUNTING_RULE}.")
    }

    fn example(&self, configuration: Line) -> Line {
        let mut line = Line::new("With ");
        line.0.extend(configuration.0);
        line.text(" the steps of the algorithm, one after another, are")
    }

    fn example_pose(&self) -> String {
        "and the pose of the tool in the base is".into()
    }

    fn orientation(&self, rpy: &str, zyz: &str) -> String {
        format!(
            "Its orientation: roll, pitch, yaw {rpy} (about the fixed axes x, y, z); Euler angles ZYZ {zyz}."
        )
    }

    fn difference(&self, by: &str) -> String {
        format!(
            "The product of the link transforms, multiplied out in numbers, differs from it by {by} at most."
        )
    }

    fn refused(&self, why: &Refusal) -> String {
        format!("There is no closed form: {}.", self.refusal(why))
    }

    fn long_formula(&self) -> String {
        "A formula that is too long to be printed stands here; `--json` of the command has it.".into()
    }

    fn pose_at(&self, configuration: Line) -> Line {
        let mut line = Line::new("The pose of the tool at ");
        line.0.extend(configuration.0);
        line.text(" is")
    }

    fn given_values(&self, values: Line) -> Line {
        let mut line = Line::new("With ");
        line.0.extend(values.0);
        line.text(" given:")
    }

    fn no_solution(&self) -> String {
        "No solution was found in numbers.".into()
    }

    fn found(&self, isolated: usize, families: usize, is_complete: bool) -> String {
        let mut text = counted(isolated, "isolated solution", "isolated solutions");
        if families > 0 {
            let families = counted(
                families,
                "family in which the arm moves with its hand still",
                "families in which the arm moves with its hand still",
            );
            text += &format!(" and {families} (marked *: one member each is shown)");
        }
        text + match is_complete {
            true if isolated + families == 1 => "; there is no other. It was put into the chain again.",
            true => "; these are all. Each was put into the chain again.",
            false => "; others may exist.",
        }
    }

    fn first_of_them(&self, shown: usize) -> String {
        format!("The first {shown} of them are shown.")
    }

    fn within_limits(&self, is_within: bool) -> String {
        if is_within { "within" } else { "beyond" }.into()
    }

    fn reach(&self, first: (&str, &str), second: (&str, &str), from_shoulder: Option<&str>) -> String {
        let ((u, x), (v, y)) = (first, second);
        let far = from_shoulder.map(|d| format!("; its largest distance from the shoulder is {d}"));
        format!(
            "Within the limits of the joints the tool point comes to {u} = {x} and {v} = {y}{}.",
            far.unwrap_or_default()
        )
    }

    fn full_turns(&self) -> String {
        " Joints that turn and have no limits turn fully.".into()
    }

    fn assumed_travel(&self) -> String {
        " Assumed travel: ".into()
    }

    fn held(&self) -> String {
        " Held: ".into()
    }

    fn workspace(&self, plane: &Plane, [u, v]: [&str; 2], has_arm: bool) -> String {
        let text = match plane {
            Plane::ThroughAxis { joint, .. } => format!(
                "What the tool point reaches, in the half plane through axis {} (distance {u}, height {v}). Colours: the \
                 largest manipulability √det(J Jᵀ) of its velocity found there, by the largest of all.",
                joint + 1
            ),
            Plane::Plane { .. } => format!(
                "What the tool point reaches, in its plane ({u}, {v}). Colours: the largest manipulability of its \
                 velocity found there, by the largest of all."
            ),
            Plane::Projection { .. } => format!(
                "What the tool point reaches, projected onto the plane ({u}, {v}). Colours: the largest manipulability of \
                 its velocity found there, by the largest of all."
            ),
        };
        text + if has_arm { " The line is the arm of the example." } else { "" }
    }

    fn claims(&self, name: &str, claims: usize, s: Standings) -> String {
        let all = [
            (s.equal, "proved"),
            (s.wrong, "wrong"),
            (s.conditional, "right under a condition"),
            (s.carried, "carried from an earlier error"),
            (s.undecided, "undecided"),
            (s.unreadable, "unreadable"),
        ];
        let parts = all.into_iter().filter(|(n, _)| *n > 0).map(|(n, what)| format!("{n} {what}"));
        let unjudged = match s.unjudged {
            0 => String::new(),
            1 => " One more line was not judged.".into(),
            n => format!(" {n} more lines were not judged."),
        };
        format!("{name} claims {claims} formulas: {}.{unjudged}", self.listed(&parts.collect::<Vec<_>>()))
    }

    fn cause(&self, [right, wrong, still]: [usize; 3]) -> String {
        format!(" would turn {right} of them right and {wrong} wrong; {still} would stay wrong.")
    }

    fn list(&self, list: List) -> String {
        match list {
            List::Wrong => "Wrong",
            List::Conditional => "Right under a condition",
            List::Open => "Not decided or not readable",
            List::Unjudged => "Not judged",
        }
        .into()
    }

    fn more(&self, number: usize) -> String {
        format!("And {number} more; `denavit check` lists them.")
    }

    fn printed(&self, line: usize, formula: &str) -> String {
        format!(", line {line}: {formula}")
    }

    fn right(&self) -> String {
        "; right: ".into()
    }

    fn robot(&self) -> String {
        "The robot: ".into()
    }

    fn made_by(&self, version: &str) -> String {
        format!("Derived, proved and printed by denavit {version}.")
    }
}
