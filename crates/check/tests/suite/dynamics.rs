//! Formulas of dynamics: torques, inertia matrices, Coriolis torques, gravity and energies of documents in several notations and
//! languages. The documents in `tests/dynamics` were written for this, and what is right and wrong in them was computed apart, from
//! the energies, with SymPy.

use denavit::description::{Convention, read_toml};
use denavit_check::{CheckOptions, Checked, Finding, Standing, Unproved, check};
use denavit_reading::document::Format;

macro_rules! document {
    ($name:literal) => {
        ($name, include_str!(concat!("../dynamics/", $name)))
    };
}

fn checked((name, text): (&str, &str)) -> Checked {
    check(text, Format::of(name, text), None, &CheckOptions::default())
        .unwrap_or_else(|e| panic!("{name}: {e:?}"))
}

/// All claims of a document are proved, and nothing is left out.
#[track_caller]
fn all_right(document: (&str, &str), claims: usize) {
    let all = checked(document);
    for claim in &all.claims {
        assert!(claim.is_proved(), "{}: {} {:?}", document.0, claim.name, claim.standing());
    }
    assert_eq!((all.claims.len(), &all.unjudged[..]), (claims, &[][..]), "{}", document.0);
}

/// Only these claims are not proved: a name, its verdict, and what its slip puts in place of what.
#[track_caller]
fn wrong(document: (&str, &str), expected: &[(&str, Standing, &str, &str)]) {
    let all = checked(document);
    let mut found: Vec<(String, Standing, String, String)> = vec![];
    for claim in all.claims.iter().filter(|c| !c.is_proved()) {
        let mut patch = (String::new(), String::new());
        for entry in &claim.entries {
            if let Finding::Wrong(wrong) = &entry.finding {
                let slip = wrong
                    .slip
                    .as_ref()
                    .unwrap_or_else(|| panic!("{}: {} has no slip", document.0, claim.name));
                assert_eq!(slip.patches.len(), 1, "{}: {}: {slip:?}", document.0, claim.name);
                let one = &slip.patches[0];
                patch = (document.1[one.span.clone()].trim().to_string(), one.now.trim().to_string());
            }
        }
        found.push((claim.name.clone(), claim.standing(), patch.0, patch.1));
    }
    let expected: Vec<(String, Standing, String, String)> =
        expected.iter().map(|e| (e.0.to_string(), e.1, e.2.to_string(), e.3.to_string())).collect();
    assert_eq!(found, expected, "{}", document.0);
    assert_eq!(all.unjudged, [], "{}", document.0);
}

#[test]
fn right_models_in_different_notations_are_proved() {
    all_right(document!("point_masses.md"), 5);
    all_right(document!("centres.md"), 15);
    all_right(document!("schwerpunkt.md"), 6);
    all_right(document!("grouped.md"), 4);
    all_right(document!("khalil.md"), 7);
    all_right(document!("polar.md"), 4);
    all_right(document!("cilindrico.md"), 4);
    all_right(document!("pendulum_cart.md"), 3);
    all_right(document!("tige.md"), 3);
    all_right(document!("trois.md"), 7);
    all_right(document!("scara.md"), 6);
    all_right(document!("spherical.md"), 5);
    all_right(document!("anthropomorphic.md"), 8);
    all_right(document!("absolute.md"), 4);
    all_right(document!("mail.txt"), 2);
    all_right(document!("unicode.txt"), 2);
    all_right(document!("lagrangian.md"), 9);
    all_right(document!("vertical.md"), 2);
    all_right(document!("code_style.txt"), 5);
    all_right(document!("gantry.md"), 3);
    all_right(document!("configuration_form.md"), 3);
    all_right(document!("tensors.md"), 4);
}

#[test]
fn a_planted_slip_is_found_and_named() {
    wrong(document!("point_masses_factor.md"), &[(r"\tau_1", Standing::Wrong, "", "2")]);
    wrong(document!("polar_factor.md"), &[(r"\tau_1", Standing::Wrong, "", "2")]);
    wrong(document!("trois_index.md"), &[("M_{22}", Standing::Wrong, "a_1", "a_2")]);
    wrong(document!("spherical_sign.md"), &[(r"\tau_2", Standing::Wrong, "+", "-")]);
    wrong(document!("mail_half.txt"), &[("tau2", Standing::Wrong, "", "/2")]);
    wrong(document!("tensors_sign.md"), &[(r"\tau_1", Standing::Wrong, "-", "+")]);
    wrong(document!("anthropomorphic_sine.md"), &[("g_2", Standing::Wrong, "s_2", "c_2")]);
    wrong(document!("gravity_length.md"), &[("G_1", Standing::Wrong, "l_2", "l_{c2}")]);
    wrong(document!("configuration_form_sine.md"), &[(r"C(\theta)", Standing::Wrong, "c_2", "s_2")]);
    wrong(document!("coriolis_entry.md"), &[(r"C(q, \dot q)", Standing::Wrong, r"\dot q_2", r"\dot q_1")]);
    wrong(
        document!("kinetic_term.md"),
        &[("K", Standing::Wrong, "", r"+ m_2 l_1 l_2 \dot\theta_1 \dot\theta_2 \cos\theta_2")],
    );
}

#[test]
fn what_follows_from_a_slip_is_carried() {
    wrong(
        document!("carried.md"),
        &[("m_{11}", Standing::Wrong, "", "2"), (r"\tau_1", Standing::Carried, "", "")],
    );
    wrong(document!("centres_sign.md"), &[("h", Standing::Wrong, "", "-"), ("C", Standing::Carried, "", "")]);
}

#[test]
fn derivations_by_lagrange_are_read_step_by_step() {
    all_right(document!("lagrange_point_masses.md"), 14);
    all_right(document!("centres_derived.md"), 14);
    all_right(document!("pendulo_doble.md"), 7);
    all_right(document!("elevation.md"), 9);
    all_right(document!("telescope.md"), 10);
    all_right(document!("motors.md"), 10);
    all_right(document!("motors_energies.md"), 6);
    // A square of a speed with a slip, and the energy in which it is.
    wrong(
        document!("lagrange_factor.md"),
        &[("v_2^2", Standing::Wrong, "", "2"), ("k_2", Standing::Carried, "", "")],
    );
    wrong(document!("centres_derived_sign.md"), &[("y_{c2}", Standing::Wrong, "-", "+")]);
    wrong(document!("elevation_sine.md"), &[("J_{v_{c2}}", Standing::Wrong, "c_2", "s_2")]);
    wrong(document!("motors_exponent.md"), &[("b_{12}", Standing::Wrong, "^2", "")]);
    // A square: of the two signs the first may be the other, too.
    wrong(document!("motors_energies_sign.md"), &[("T_{m_2}", Standing::Wrong, "", "-")]);
}

#[test]
fn what_nothing_pins_down_is_not_judged() {
    let all = checked(document!("open_question.md"));
    let open = |c: &denavit_check::Claim| {
        c.entries.iter().all(|e| matches!(&e.finding, Finding::Undecided { why: Unproved::OpenReading }))
    };
    assert_eq!(all.claims.len(), 1);
    assert!(all.claims.iter().all(open), "{:?}", all.claims);
}

/// A planar arm with two links whose file says what they weigh.
const WEIGHED: &str = r#"
name = "weighed"
convention = "standard"
gravity = [0, -9.81, 0]
[parameters]
l1 = "0.5"
l2 = "0.4"
m1 = "3"
m2 = "2"
J1 = "0.1"
J2 = "0.05"
[[joints]]
theta = "q1"
a = "l1"
mass = "m1"
com = ["-l1/2", "0", "0"]
inertia = ["0", "0", "0", "0", "0", "J1"]
[[joints]]
theta = "q2"
a = "l2"
mass = "m2"
com = ["-l2/2", "0", "0"]
inertia = ["0", "0", "0", "0", "0", "J2"]
"#;

#[test]
fn masses_of_a_robot_file_are_those_of_the_formulas() {
    let (robot, _) = read_toml(WEIGHED).expect("a robot");
    assert_eq!(robot.convention, Convention::Standard);
    let of = |text: &str| {
        let text = format!("The inertia matrix and gravity of the arm\n\n{text}\n");
        let all = check(&text, Format::Markdown, Some(&robot), &CheckOptions::default()).expect("claims");
        all.claims.iter().map(denavit_check::Claim::standing).collect::<Vec<_>>()
    };
    assert_eq!(of("$$M_{22} = J_2 + \\frac14 m_2 l_2^2$$"), [Standing::Equal]);
    // Nothing else has to bear out what the file says.
    assert_eq!(of("$$M_{22} = J_2 + \\frac12 m_2 l_2^2$$"), [Standing::Wrong]);
    assert_eq!(of("$$G_2 = \\frac12 m_2 g l_2 \\cos(q_1 + q_2)$$"), [Standing::Equal]);
    assert_eq!(of("$$G_2 = \\frac12 m_2 g l_2 \\sin(q_1 + q_2)$$"), [Standing::Wrong]);
}

/// An arm of two links, their masses at the ends.
const ARM: &str = "# Arm\n\nStandard DH\n\n| i | theta | d | a | alpha |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | l1 | 0 |\n\
                   | 2 | θ2 | 0 | l2 | 0 |\n\nPoint masses.\n\n$$M_{22} = m_2 l_2^2$$\n\n$$M_{12} = m_2 l_2^2 + m_2 l_1 l_2 c_2$$\n\n";

#[test]
fn what_may_be_meant_otherwise_is_not_accused() {
    let of = |text: &str| {
        let text = format!("{ARM}{text}\n");
        let all = check(&text, Format::Markdown, None, &CheckOptions::default()).expect("claims");
        let rest = all.claims.iter().skip(2).map(denavit_check::Claim::standing).collect::<Vec<_>>();
        (rest, all.unjudged.len())
    };
    // Damping.
    let torque = "m_2 l_2^2 (\\ddot\\theta_1 + \\ddot\\theta_2) + m_2 l_1 l_2 c_2 \\ddot\\theta_1 + m_2 l_1 l_2 s_2 \\dot\\theta_1^2";
    assert_eq!(of(&format!("$$\\tau_2 = {torque}$$")).0, [Standing::Equal]);
    assert_eq!(of(&format!("$$\\tau_2 = {torque} + d_2 \\dot\\theta_2$$")).0, [Standing::Undecided]);
    // The first link is spoken of nowhere else: d_1 might be a distance to its centre of mass.
    let first = "(m_1 + m_2) l_1^2 \\ddot\\theta_1 + m_2 l_2^2 (\\ddot\\theta_1 + \\ddot\\theta_2) + m_2 l_1 l_2 c_2 (2\\ddot\\theta_1 + \\ddot\\theta_2) \
                 - m_2 l_1 l_2 s_2 (2\\dot\\theta_1\\dot\\theta_2 + \\dot\\theta_2^2)";
    assert_eq!(of(&format!("$$\\tau_1 = {first}$$")).0, [Standing::Equal]);
    assert_eq!(of(&format!("$$\\tau_1 = {first} + d_1 \\dot\\theta_1$$")).0, [Standing::Undecided]);
    // Equal masses, a right angle, another arm.
    assert_eq!(of("For equal links $$M_{22} = m l^2$$").0, [Standing::Undecided]);
    assert_eq!(of("For $\\theta_2 = 90°$ $$M_{12} = m_2 l_2^2$$").0, [Standing::Undecided]);
    assert_eq!(of("For rods instead $$M_{22} = \\frac13 m_2 l_2^2$$").0, [Standing::Undecided]);
    // What is none of these is wrong.
    assert_eq!(of("$$G_2 = m_2 g l_2 c_{12}$$").0, [Standing::Equal]);
    assert_eq!(of("$$M_{21} = m_2 l_2^2 - m_2 l_1 l_2 c_2$$").0, [Standing::Wrong]);
}

#[test]
fn documents_without_dynamics_are_as_they_were() {
    let text = "DH parameters (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | a1 | 0 |\n\
                | 2 | θ2 | 0 | a2 | 0 |\n\nThe torque of the second joint for a load F at the hand, $F = (0, -W)$:\n\n\
                $$\\tau_2 = -W a_2 c_{12}$$\n";
    let all = check(text, Format::Markdown, None, &CheckOptions::default()).expect("claims");
    assert_eq!(all.claims.len(), 1);
    assert!(!matches!(all.claims[0].about, denavit_check::About::Dynamics(_)), "{:?}", all.claims[0].about);
}

#[test]
fn letters_may_number_bodies() {
    let bars = document!("bars_with_letters.md");
    all_right(bars, 6);
    all_right(document!("trolley_with_letters.txt"), 5);
    // The second bar is the first that the text has: still one is hinged to the wall.
    let swapped = bars.1.replace("A uniform bar P", "With bar Q, $m_Q$, comes a bar P");
    all_right((bars.0, &swapped), 6);
    let slip = bars.1.replace("+ \\frac{1}{2} m_Q l_P l_Q", "+ m_Q l_P l_Q");
    wrong((bars.0, &slip), &[("M_{12}", Standing::Wrong, "", "/2")]);
    let slip = bars.1.replace("\\frac{1}{6} m_P", "\\frac{1}{3} m_P");
    let standings: Vec<(String, Standing)> =
        checked((bars.0, &slip)).claims.iter().map(|c| (c.name.clone(), c.standing())).collect();
    let slipped = ("T_P".to_string(), Standing::Wrong);
    assert_eq!(standings.iter().filter(|s| s.1 != Standing::Equal).collect::<Vec<_>>(), [&slipped]);
}

#[test]
fn gears_groupings_and_numbers_are_read() {
    let geared = document!("geared.md");
    all_right(geared, 4);
    all_right(document!("khalil_groups.md"), 5);
    let numbers = document!("in_numbers.md");
    let all = checked(numbers);
    assert!(
        all.claims.len() == 5 && all.claims.iter().all(denavit_check::Claim::is_proved),
        "{:?}",
        all.claims
    );
    // No other formula has the ratio, a number may be rounded: neither is called right or wrong.
    for (document, from, to, name) in [
        (geared, "N_1^2 J_{m1}", "N_1 J_{m1}", "M_{11}"),
        (numbers, "0.42 +", "0.43 +", "M_{12}"),
        (numbers, "= 7.848", "= 7.85", "G_2"),
    ] {
        let all = checked((document.0, &document.1.replace(from, to)));
        let open: Vec<(&str, Standing)> =
            all.claims.iter().filter(|c| !c.is_proved()).map(|c| (c.name.as_str(), c.standing())).collect();
        assert_eq!(open, [(name, Standing::Undecided)], "{}", document.0);
    }
}

/// A row that follows others is a link with a mass of its own: one more than there are joints.
#[test]
fn rows_that_follow_others_are_links() {
    all_right(document!("level_plate.md"), 7);
    wrong(document!("level_plate_sign.md"), &[("\\tau_2", Standing::Wrong, "-", "+")]);
    // Whose inertia the rotors' is, is not known there.
    let rotors =
        include_str!("../dynamics/level_plate.md").replace("I_2 + m_3 a_2^2", "I_2 + J_{m2} + m_3 a_2^2");
    let all = checked(("rotors.md", &rotors));
    assert!(all.claims.is_empty() && all.unjudged.len() == 7, "{:?}", all.claims.len());
    // Before another joint its body may have the number of either: what is right is proved, and nothing called wrong.
    let table = "| 2 | a2 | 0 | 0 | q2 |\n| 3 | a3 | 0 | 0 | -q1 - q2 |";
    let before = include_str!("../dynamics/level_plate_sign.md");
    assert!(before.contains(table));
    let before = before
        .replace(table, "| 2 | a2 | 0 | 0 | -q1 |\n| 3 | a3 | 0 | 0 | q2 |")
        .replace("level", "on rails");
    let all = checked(("before.md", &before));
    assert!(all.claims.iter().all(|c| c.standing() != Standing::Wrong), "{:?}", all.claims);
}
