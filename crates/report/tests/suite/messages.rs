//! Messages that need no robot: each is said in every language, in its words, in the singular and the plural.

use crate::language::check_text;
use denavit::description::{Convention, Part};
use denavit::dynamics::{Gives, Ground, Minimality};
use denavit::geometry::NoBody;
use denavit::inverse::Task;
use denavit_check::ValueSlip;
use denavit_program::Count;
use denavit_report::document::plain;
use denavit_report::words::{
    Caption, Column, ExerciseKind, Glance, Heading, List, Standings, Tongue, Wording,
};
use denavit_symbolic::vocabulary::Vocabulary;

/// What another language may say as English does.
const ALIKE: [&str; 11] = [
    "Structure",
    "Convention",
    "Source",
    "Errata",
    "Configuration 1",
    "Pose 1",
    "Position 1",
    "Solution 1: ",
    "Figure",
    "Table",
    "masses",
];

type Said<'a> = &'a dyn Fn(&'static dyn Wording) -> String;

/// The message in all languages, English first.
#[track_caller]
fn all(message: Said) -> [String; 4] {
    let said = Tongue::ALL.map(|language| message(language.words()));
    for (text, language) in said.iter().zip(Tongue::ALL) {
        assert!(!text.trim().is_empty(), "{language:?}");
        // What stands in backquotes is of no language.
        let words: Vec<&str> = text.split('`').step_by(2).collect();
        check_text(&words.join("`"), language, "a message");
        let is_alike = ALIKE.iter().any(|alike| text.replace('\u{a0}', "") == alike.replace('\u{a0}', ""));
        assert!(language == Tongue::English || *text != said[0] || is_alike, "{language:?}: {text}");
    }
    said
}

#[test]
fn headings_and_captions() {
    let headings = [
        Heading::Arm,
        Heading::Table,
        Heading::Links,
        Heading::Algorithm,
        Heading::Example,
        Heading::Inverse,
        Heading::Solutions,
        Heading::Velocity,
        Heading::Dynamics,
        Heading::Workspace,
        Heading::Errata,
        Heading::References,
    ];
    for heading in headings {
        all(&|w| w.heading(heading));
    }
    let glances = [
        Glance::Structure,
        Glance::Convention,
        Glance::Source,
        Glance::Forward,
        Glance::Inverse,
        Glance::Singularities,
    ];
    for glance in glances {
        all(&|w| w.glance(glance));
    }
    let columns = [
        Column::Joint,
        Column::Torque,
        Column::Inertia,
        Column::Name,
        Column::Limits,
        Column::Branch,
        Column::Step,
        Column::Value,
    ];
    for column in columns {
        all(&|w| w.column(column));
    }
    let captions = [
        Caption::AtRest,
        Caption::Steps,
        Caption::Configurations,
        Caption::Pictures,
        Caption::Singular,
        Caption::Scheme,
    ];
    for caption in captions {
        all(&|w| w.caption(caption));
    }
    for list in [List::Wrong, List::Conditional, List::Open, List::Unjudged] {
        all(&|w| w.list(list));
    }
    for convention in Convention::ALL {
        all(&|w| w.convention(convention));
        all(&|w| w.converted(convention));
        all(&|w| w.parameters(convention));
        all(&|w| w.ask_table(convention));
    }
    let words: [Said; 12] = [
        &|w| w.table().into(),
        &|w| w.figure().into(),
        &|w| w.contents().into(),
        &|w| w.formula().into(),
        &|w| w.base(),
        &|w| w.tool(),
        &|w| w.values(),
        &|w| w.long_formula(),
        &|w| w.counting_rule(),
        &|w| w.full_turns(),
        &|w| w.same_pose(true),
        &|w| w.same_pose(false),
    ];
    // The tool and the base of a robot are called so in their own words.
    words.into_iter().filter(|said| said(Tongue::English.words()) != "base").for_each(|said| {
        all(said);
    });
}

#[test]
fn words_of_exercises() {
    for kind in ExerciseKind::ALL {
        all(&|w| w.exercise_title(kind, "X"));
        all(&|w| w.solution_title(kind, "X"));
    }
    let words: [Said; 28] = [
        &|w| w.seed(3),
        &|w| w.configuration_title(1),
        &|w| w.given_pose_title(1),
        &|w| w.solved_pose_title(1),
        &|w| w.given_position_title(1),
        &|w| w.solved_position_title(1),
        &|w| w.pose_title(),
        &|w| w.numbers_title(),
        &|w| w.ask_links(),
        &|w| w.ask_pose(),
        &|w| w.axes_title(),
        &|w| w.axes_caption(),
        &|w| w.configurations_title(),
        &|w| w.ask_jacobian(),
        &|w| w.ask_velocity(),
        &|w| w.ask_determinant(),
        &|w| w.ask_singular(),
        &|w| w.coefficients(),
        &|w| w.largest_of("X"),
        &|w| w.ask_transforms(),
        &|w| w.statics_step(),
        &|w| w.point_masses(),
        &|w| w.ask_motion_parts(),
        &|w| w.ask_motion(),
        &|w| w.motion_step(),
        &|w| w.cubic_title(),
        &|w| w.peaks_title(),
        &|w| w.trapezoid_title(),
    ];
    words.into_iter().for_each(|said| {
        all(said);
    });
    let line = |w: &dyn Wording, one: bool| match one {
        true => w.motion_begins(denavit_report::document::Line::new("X")),
        false => w.motion_ends(denavit_report::document::Line::new("X")),
    };
    for one in [true, false] {
        all(&|w| plain(&line(w, one), &Vocabulary::new()));
    }
    for count in [1, 2] {
        all(&|w| w.ask_numbers(count));
        all(&|w| w.ask_configurations(count));
        all(&|w| w.ask_positions(count));
        all(&|w| w.ask_torque_numbers(count));
    }
    let two = Tongue::ALL.map(|l| l.words().points(2));
    assert_eq!(two, ["(2 points)", "(2 points)", "(2 Punkte)", "(2 puntos)"]);
    let one = Tongue::ALL.map(|l| l.words().points(1));
    assert_eq!(one, ["(1 point)", "(1 point)", "(1 Punkt)", "(1 punto)"]);
}

#[test]
fn words_of_dynamics() {
    let words: [Said; 16] = [
        &|w| w.dynamics_title("X"),
        &|w| w.link_parameters(true),
        &|w| w.link_parameters(false),
        &|w| w.base_title(),
        &|w| w.torques_title(),
        &|w| w.with_friction(),
        &|w| w.inertia_title(),
        &|w| w.velocity_torques_title(),
        &|w| w.gravity_torques_title(),
        &|w| w.bodies(),
        &|w| w.grouping(),
        &|w| w.outward(),
        &|w| w.inward(),
        &|w| w.short(),
        &|w| w.link_of_tree(2, "X", Some(1)),
        &|w| w.link_of_tree(1, "X", None),
    ];
    words.into_iter().for_each(|said| {
        all(said);
    });
    for why in
        [NoBody::NotFinite, NoBody::NegativeMass, NoBody::NoMass, NoBody::NotPositive, NoBody::Triangle]
    {
        all(&|w| w.no_body(why).into());
    }
    for gives in [Gives::OnAxis, Gives::Nothing, Gives::Inertia, Gives::Plan, Gives::Across] {
        for link in [1, 2] {
            all(&|w| w.gives(link, gives));
        }
    }
    for ground in [Ground::Proved, Ground::Modulo(20), Ground::Numbers(20, 1e-9), Ground::Failed] {
        all(&|w| w.torques_cost(&Count::default(), ground));
        all(&|w| w.motion_ground(ground));
    }
    for part in [Part::Names, Part::Limits, Part::Velocities, Part::Efforts, Part::Masses, Part::Friction] {
        all(&|w| w.left_part(part).into());
    }
    for minimality in [Minimality::Proved, Minimality::AtLeast(2), Minimality::Unknown] {
        all(&|w| w.base_count(20, 8, minimality));
    }
    let [_, french, german, spanish] = all(&|w| w.base_count(1, 1, Minimality::Unknown));
    assert!(
        french.contains("1 agit") && german.contains("wirkt") && spanish.contains("influye "),
        "{german}"
    );
}

#[test]
fn one_and_many() {
    let found = |isolated, families| all(&|w| w.found(isolated, families, true));
    let (one, two) = (found(1, 1), found(2, 2));
    let singular = [
        "1 isolated solution and 1 family",
        "1 solution isolée",
        "1 isolierte Lösung und 1 Schar",
        "1 solución aislada y 1 familia",
    ];
    let plural = [
        "2 isolated solutions and 2 families",
        "2 solutions isolées",
        "2 isolierte Lösungen und 2 Scharen",
        "2 soluciones aisladas y 2 familias",
    ];
    for k in 0..4 {
        assert!(one[k].starts_with(singular[k]), "{}", one[k]);
        assert!(two[k].starts_with(plural[k]), "{}", two[k]);
    }
    let surplus = |n| all(&|w| w.ended_remark(n));
    assert!(surplus(1)[2].contains("1 Gelenk mehr") && surplus(2)[2].contains("2 Gelenke mehr"));
    assert!(surplus(1)[3].contains("1 articulación más") && surplus(2)[3].contains("2 articulaciones más"));
    all(&|w| w.conditions(5, Some(Task::PositionAndAxis)));
    let standings = |n| Standings {
        equal: n,
        wrong: n,
        conditional: n,
        carried: n,
        undecided: n,
        unreadable: n,
        unjudged: n,
    };
    let claims = |n| all(&|w| w.claims("X", 6 * n, standings(n)));
    assert!(claims(1)[2].ends_with("Eine weitere Zeile wurde nicht beurteilt."));
    assert!(claims(2)[2].ends_with("2 weitere Zeilen wurden nicht beurteilt."));
    assert!(claims(1)[3].contains("1 errónea,") && claims(2)[3].contains("2 erróneas,"));
    all(&|w| w.cause([3, 1, 2]));
    all(&|w| w.more(4));
    let slips =
        [ValueSlip::Sign, ValueSlip::AngleUnit, ValueSlip::Factor, ValueSlip::PowerOfTen, ValueSlip::Other];
    for slip in slips.into_iter().chain([ValueSlip::Term(2)]) {
        all(&|w| w.value_slip(slip));
    }
    // A number is written with the sign of the language, a name with a point in it is none of these.
    let written = Tongue::ALL.map(|l| l.words().written("0.5 m, v1.x, 2.".into()));
    assert_eq!(written, ["0.5 m, v1.x, 2.", "0,5 m, v1.x, 2.", "0,5 m, v1.x, 2.", "0,5 m, v1.x, 2."]);
}
