//! What words and numbers around formulas give: where the arm is singular, joints in numbers, rates and loads in words, letters of
//! rates, points with a letter.

use denavit_check::{About, CheckOptions, Checked, Remark, Sense, Skipped, Standing, check};
use denavit_reading::document::Format;

fn read(text: &str) -> Checked {
    check(text, Format::Markdown, None, &CheckOptions::default()).unwrap_or_else(|e| panic!("{e:?}\n{text}"))
}

fn all(checked: &Checked, name: &str) -> Vec<Standing> {
    checked.claims.iter().filter(|c| c.name == name).map(|c| c.standing()).collect()
}

const RIGHT: &[Standing] = &[Standing::Equal];
const WRONG: &[Standing] = &[Standing::Wrong];
const NONE: &[Standing] = &[];
const PLANAR: &str = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | a1 | 0 |\n\
                      | 2 | θ2 | 0 | a2 | 0 |\n\n";
const NUMBERS: &str = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | 0.4 | 0 |\n\
                       | 2 | θ2 | 0 | 0.3 | 0 |\n\n";
const ELBOW: &str = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | h | 0 | 90° |\n\
                     | 2 | θ2 | 0 | a2 | 0 |\n| 3 | θ3 | 0 | a3 | 0 |\n\n";

#[track_caller]
fn is(text: &str, expected: &[(&str, &[Standing])]) {
    let found = read(text);
    for (name, standings) in expected {
        assert_eq!(all(&found, name), *standings, "{name}\n{text}\n{:#?}", found.claims);
    }
}

#[test]
fn where_the_arm_is_singular() {
    let with = |words: &str| format!("{ELBOW}det J = -a2 a3 s3 (a2 c2 + a3 c23)\n\n{words}\n");
    let shoulder = "a2 c2 + a3 c23";
    // In the sentence, on lines of their own, in a list, behind the determinant.
    for words in [
        "The arm is singular if θ3 = 0.",
        "which vanishes for\n\nθ3 = 0",
        "Singularities:\n\n- θ3 = 0 (elbow)",
    ] {
        is(&with(words), &[("θ3", RIGHT)]);
    }
    is(&with("The arm is singular if θ3 = 90°."), &[("θ3", WRONG)]);
    is(
        &with(&format!("Two families of singular configurations follow:\n\n- {shoulder} = 0 (shoulder)")),
        &[(shoulder, RIGHT)],
    );
    // A formula that does not divide the determinant is no claim; nor is what words deny.
    let other = read(&with("The arm is singular for\n\n- a2 c2 - a3 c23 = 0"));
    assert!(all(&other, "a2 c2 - a3 c23").is_empty(), "{:?}", other.claims);
    let twice = "2 a2 c2 + 2 a3 c23";
    is(&with(&format!("It is singular where {twice} = 0.")), &[(twice, RIGHT)]);
    let found = read(&with("The arm is singular if θ3 = 0."));
    assert!(found.claims.iter().any(|c| c.about == About::Singularity), "{:?}", found.claims);
    is(&with("The arm is not singular at θ2 = 0."), &[("θ2", NONE)]);
    is(&with("It is singular not for θ2 = 0 but for θ3 = 0."), &[("θ2", NONE), ("θ3", RIGHT)]);
    let list =
        "It vanishes in two cases:\n\n1. θ3 = 0, arm stretched;\n2. a2 c2 + a3 c23 = 0, the tip on the axis.";
    is(&with(list), &[("θ3", RIGHT), (shoulder, RIGHT)]);
}

/// Rows that vanish everywhere tell nothing: a wrist moves no point.
#[test]
fn where_a_wrist_is_singular() {
    let wrist = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | 0 | -90° |\n\
                 | 2 | θ2 | 0 | 0 | 90° |\n| 3 | θ3 | 0 | 0 | 0 |\n\n";
    for (value, standing) in [("0", RIGHT), ("π/2", WRONG)] {
        is(&format!("{wrist}The wrist is singular for θ2 = {value}.\n"), &[("θ2", standing)]);
    }
}

#[test]
fn a_question_for_joints_gives_a_goal() {
    let text = |x: &str| {
        format!(
            "{NUMBERS}For θ1 = 20° and θ2 = 50°: x = {x}\n\nWhich joint angles go with x = 0.478 and y = 0.419?\n\nθ2 = -50° with θ1 = 62.4°\n"
        )
    };
    let found = read(&text("0.478"));
    assert_eq!(found.tally().wrong, 0, "{:?}", found.claims);
    assert_eq!(all(&found, "θ2"), RIGHT);
    assert_eq!(all(&read(&text("0.300")), "x"), WRONG);
}

#[test]
fn joints_in_numbers_answer_for_a_pose_that_is_known() {
    let known = format!("{NUMBERS}For θ1 = 20° and θ2 = 50°:\n\nx = 0.478\n\ny = 0.419\n\n");
    let twice = [Standing::Equal; 2];
    is(&format!("{known}There are two ways to be there:\n\nθ2 = 50° or θ2 = -50°\n"), &[("θ2", &twice)]);
    // What reaches no pose that is known is listed, not passed over.
    let found = read(&format!("{known}Somebody else wrote:\n\nθ2 = 70°\n"));
    assert!(all(&found, "θ2").is_empty(), "{:?}", found.claims);
    assert!(matches!(found.unjudged[..], [ref u] if matches!(u.why, Skipped::Given)), "{:?}", found.unjudged);
    // A configuration at which numbers are judged, or that is only given, is none of these.
    for text in [known.clone(), format!("{NUMBERS}Let the arm stand at θ1 = 20°, θ2 = 50°.\n")] {
        assert!(read(&text).unjudged.is_empty(), "{text}");
    }
    // Solutions with a letter are those of the configuration that was stated.
    let other = |value: &str| format!("{known}solution A: θ1 = 62.4°, θ2 = {value}°\n");
    is(&other("-50"), &[("θ2", RIGHT)]);
}

#[test]
fn rates_in_words() {
    let at = format!("{NUMBERS}θ1 = 20°, θ2 = 50°\n\n");
    // x' = -0.419·0.5 + 0.282·0.2, y' = 0.478·0.5 - 0.103·0.2
    for words in ["Rates of 0.5 and -0.2 rad/s give", "With the joint speeds 0.5 rad/s, -0.2 rad/s we get"] {
        is(&format!("{at}{words}\n\nvx = -0.153 m/s\n\nω = 0.3 rad/s\n"), &[("vx", RIGHT), ("ω", RIGHT)]);
        is(&format!("{at}{words}\n\nvx = 0.153 m/s\n\nω = 0.7 rad/s\n"), &[("vx", WRONG), ("ω", WRONG)]);
    }
    let alone = "With 2 rad/s on axis 2 alone:";
    is(&format!("{at}{alone}\n\nvx = -0.564 m/s\n"), &[("vx", RIGHT)]);
    // What moves so many metres is no joint that turns.
    let of_hand = "The hand moves at 0.5 m/s and -0.2 m/s.";
    is(&format!("{at}{of_hand}\n\nvx = -0.153 m/s\n"), &[("vx", &[Standing::Undecided])]);
    // Limits are no motion.
    let limits = "The limits are 0.5 rad/s and 0.2 rad/s.";
    is(&format!("{at}{limits}\n\nvx = -0.153 m/s\n"), &[("vx", &[Standing::Undecided])]);
}

#[test]
fn loads_in_words() {
    let at = format!("{NUMBERS}θ1 = 20°, θ2 = 50°\n\nThe torques for ");
    let force = "a force of 10 N along x and -20 N along y at the hand";
    let of = |words: &str, tau: &str| format!("{at}{words}:\n\ntau1 = {tau} Nm\n");
    is(&of(force, "-13.76"), &[("tau1", RIGHT)]);
    is(&of(force, "-5.38"), &[("tau1", WRONG)]);
    is(&of(&format!("{force}, moment 0.8 Nm"), "-12.96"), &[("tau1", RIGHT)]);
}

#[test]
fn letters_of_rates_are_seen_from_a_velocity() {
    let right = "vx = -(a1 s1 + a2 s12) A - a2 s12 B";
    let second = |sign: &str| format!("vy = (a1 c1 + a2 c12) A {sign} a2 c12 B");
    for (vy, standing) in [(second("+"), RIGHT), (second("-"), WRONG)] {
        // Also what stands before it.
        is(&format!("{PLANAR}{right}\n\n{vy}\n"), &[("vx", RIGHT), ("vy", standing)]);
        is(&format!("{PLANAR}{vy}\n\n{right}\n"), &[("vx", RIGHT), ("vy", standing)]);
    }
    // Letters with numbers are those of their joints: exchanged ones are not taken for the others.
    let unread: &[Standing] = &[Standing::Unreadable];
    is(&format!("{PLANAR}vx = -(a1 s1 + a2 s12) k2 - a2 s12 k1\n"), &[("vx", unread)]);
    is(&format!("{PLANAR}vx = -(a1 s1 + a2 s12) k1 - a2 s12 k2\n"), &[("vx", RIGHT)]);
    // How they are read is said.
    let found = read(&format!("{PLANAR}{right}\n"));
    assert!(
        found.claims[0].remarks.iter().any(|r| matches!(r, Remark::ReadAs(Sense::Rates(_)))),
        "{found:?}"
    );
    // One that is right with no letters tells nothing.
    is(&format!("{PLANAR}vx = -(a1 s1 - a2 s12) A - a2 s12 B\n"), &[("vx", unread)]);
}

#[test]
fn points_with_a_letter_and_lengths_of_the_arm() {
    let places = "x_P = a1 c1 + a2 c12\n\ny_P = a1 s1 + a2 s12\n\n";
    let of = |sign: &str| {
        format!("{PLANAR}{places}Inverse:\n\ncos θ2 = (x_P^2 + y_P^2 - a1^2 {sign} a2^2)/(2 a1 a2)\n")
    };
    is(&of("-"), &[("x_P", RIGHT), ("cos θ2", RIGHT)]);
    is(&of("+"), &[("cos θ2", WRONG)]);
    // A wrong component of a point that has a right one is wrong, and what stands behind it is held against the point.
    let wrong = "Gx = a1 c1 + a2 c12\n\nGy = a1 s1 + a2 c12\n\nInverse:\n\nθ1 = atan2(Gy, Gx) - atan2(a2 s2, a1 + a2 c2)\n";
    is(&format!("{PLANAR}{wrong}"), &[("Gy", WRONG), ("θ1", RIGHT)]);
    is(&format!("{ELBOW}The reach is rho = a2 c2 + a3 c23.\n"), &[("rho", RIGHT)]);
    // A part of the arm may be meant.
    is(&format!("{ELBOW}The reach is rho = a3 c23.\n"), &[("rho", NONE)]);
    // A name may be that of a determinant with its sign, not with the other.
    let named = |sign: &str| format!("{PLANAR}The determinant is D = {sign}a1 a2 s2.\n");
    is(&named(""), &[("D", RIGHT)]);
    is(&named("-"), &[("D", NONE)]);
    is(&format!("{ELBOW}Its determinant:\n\ndet = -a2 a3 s3 (a2 c2 + a3 c23)\n"), &[("det", RIGHT)]);
}

/// Six rows in numbers are those along the axes of the base, whatever zeros another frame has.
#[test]
fn six_rows_in_numbers() {
    let table = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | 1 | 0 |\n| 2 | θ2 | 0 | 0.5 | 0 |\n\n\
                 θ1 = 150°, θ2 = 30°\n\n";
    // The hand is at (-1.366, 0.5).
    let rows = ["-0.5 & 0", "-1.366 & -0.5", "0 & 0", "0 & 0", "0 & 0", "1 & 1"];
    let of = |order: [usize; 6], sign: &str| {
        let body: Vec<String> =
            order.iter().map(|&k| rows[k].replacen("-0.5 & 0", &format!("{sign}0.5 & 0"), 1)).collect();
        format!("{table}$$J = \\begin{{bmatrix}} {} \\end{{bmatrix}}$$\n", body.join(" \\\\ "))
    };
    // Along the axes of the hand, where all of them are so.
    let hand = "$$J = \\begin{bmatrix} 0.5 & 0 \\\\ 1.366 & 0.5 \\\\ 0 & 0 \\\\ 0 & 0 \\\\ 0 & 0 \\\\ 1 & 1 \\end{bmatrix}$$\n";
    is(&format!("{}{hand}", table.replace("150", "0")), &[("J", RIGHT)]);
    for order in [[0, 1, 2, 3, 4, 5], [3, 4, 5, 0, 1, 2]] {
        is(&of(order, "-"), &[("J", RIGHT)]);
        is(&of(order, ""), &[("J", WRONG)]);
    }
}
