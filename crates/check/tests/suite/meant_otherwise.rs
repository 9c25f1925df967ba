//! Words before a formula that give its letters another meaning than the usual one.

use denavit::catalogue;
use denavit_check::{CheckOptions, Checked, Condition, Finding, Standing, check};
use denavit_reading::document::Format;

fn read(text: &str) -> Checked {
    check(text, Format::Markdown, None, &CheckOptions::default()).unwrap_or_else(|e| panic!("{e:?}\n{text}"))
}

#[track_caller]
fn standings(text: &str, name: &str) -> Vec<Standing> {
    let found = read(text);
    let own: Vec<Standing> = found.claims.iter().filter(|c| c.name == name).map(|c| c.standing()).collect();
    assert!(!own.is_empty(), "{name}: {:?}", found.claims);
    own
}

/// A wrist of three joints with its orientation, right.
const WRIST: &str = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | 0 | -90° |\n| 2 | θ2 | 0 | 0 | 90° |\n\
                     | 3 | θ3 | 0 | 0 | 0 |\n\n$\\theta_2 = \\operatorname{atan2}(\\pm\\sqrt{r_{13}^2+r_{23}^2}, r_{33})$\n\n";

#[test]
fn entries_of_another_matrix() {
    let text = |what: &str| {
        format!(
            "{WRIST}Let $r_{{ij}}$ be the elements of ${what}$, then\n\n$\\theta_1 = \\operatorname{{atan2}}(-r_{{12}}, r_{{22}})$\n"
        )
    };
    assert_ne!(standings(&text("R_2^0"), "\\theta_1"), [Standing::Wrong]);
    assert_eq!(standings(&text("R_3^0"), "\\theta_1"), [Standing::Wrong]);
}

#[test]
fn a_sum_under_a_supposition() {
    let text = |words: &str| {
        format!("{WRIST}{words}\n\n* $\\theta_1 + \\theta_3 = \\operatorname{{atan2}}(r_{{21}}, r_{{22}})$\n")
    };
    let name = "\\theta_1 + \\theta_3";
    assert_ne!(standings(&text("When $\\theta_2 = 0$ only the sum is determined:"), name), [Standing::Wrong]);
    assert_eq!(standings(&text("For all poses:"), name), [Standing::Wrong]);
}

/// `T1` is the pose at `P1` where it is that in all its entries.
#[test]
fn a_pose_with_the_number_of_its_configuration() {
    let text = |x: &str| {
        format!(
            "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | 0.5 | 0 |\n| 2 | θ2 | 0 | 0.4 | 0 |\n\n\
             x = 0.5 cos θ1 + 0.4 cos(θ1 + θ2)\n\nPose P1: θ1 = 30°, θ2 = 60°\n\n\
             T1 = | 0  -1  0  {x} |\n     | 1   0  0  0.650 |\n     | 0   0  1  0 |\n     | 0   0  0  1 |\n"
        )
    };
    assert_eq!(standings(&text("0.433"), "T1"), [Standing::Equal]);
    assert_eq!(standings(&text("0.443"), "T1"), [Standing::Wrong]);
    // Without that number it is what its name says: frame 1.
    assert_eq!(standings(&text("0.433").replace("Pose P1: ", "At "), "T1"), [Standing::Wrong]);
}

/// A moment beside forces, in a plane that is not x y: what its letter is nobody said.
#[test]
fn a_moment_that_is_a_letter() {
    let text = |second: &str| {
        format!(
            "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | a1 | 90° |\n| 2 | θ2 | 0 | a2 | 0 |\n\
             | 3 | θ3 | 0 | a3 | 0 |\n\nThe hand exerts the force (fx, fy, fz) and the couple m.\n\n\
             $\\tau_2 = {second}$\n"
        )
    };
    let right = "-(a_2 s_2 + a_3 s_{23})(c_1 f_x + s_1 f_y) + (a_2 c_2 + a_3 c_{23}) f_z";
    assert_ne!(standings(&text(&format!("{right} + m")), "\\tau_2"), [Standing::Wrong]);
    assert_eq!(standings(&text(&right.replace("c_{23}", "c_{2}")), "\\tau_2"), [Standing::Wrong]);
}

/// The same where the supposition stands in the sentence itself.
#[test]
fn a_sum_in_the_sentence_of_its_supposition() {
    let text = |words: &str| {
        format!("{WRIST}{words} $\\theta_1+\\theta_3 = \\operatorname{{atan2}}(r_{{21}}, r_{{22}})$.\n")
    };
    let name = "\\theta_1+\\theta_3";
    assert_ne!(standings(&text("The axes coincide; with $\\theta_2=0$ we have"), name), [Standing::Wrong]);
    assert_eq!(standings(&text("For all poses we have"), name), [Standing::Wrong]);
}

/// A linkage makes a joint follow others: what holds then is right under that condition, and wrong without these words.
#[test]
fn joints_that_hang_together() {
    let text = |words: &str, pz: &str| {
        format!(
            "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | q1 | d1 | a1 | -90° |\n| 2 | q2 | 0 | a2 | 0 |\n\
             | 3 | q3 | 0 | a3 | 0 |\n| 4 | q4 | 0 | a4 | 0 |\n\n{words}\n\npz = {pz}\n"
        )
    };
    let linkage = "The linkage keeps the flange level: q4 = -(q2 + q3). Hence";
    let right = "d1 - a2 sin q2 - a3 sin(q2 + q3)";
    let found = read(&text(linkage, right));
    let own = found.claims.iter().find(|c| c.name == "pz").unwrap();
    assert!(
        matches!(own.entries[0].finding, Finding::Conditional { condition: Condition::Following, .. }),
        "{own:?}"
    );
    assert_eq!(standings(&text("The position:", right), "pz"), [Standing::Wrong]);
    let wrong = "d1 - a2 sin q2 - a3 cos(q2 + q3)";
    assert_eq!(standings(&text(linkage, wrong), "pz"), [Standing::Wrong]);
}

/// What follows from coordinates of a point of the document's own is not wrong by itself: one of these may be.
#[test]
fn an_equation_between_coordinates_of_an_own_point() {
    let text = |hy: &str, square: &str| {
        format!(
            "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | a1 | 0 |\n| 2 | θ2 | 0 | a2 | 0 |\n\n\
             The middle $h$ of the second link is at\n\n$h_x = a_1 c_1 + \\frac{{a_2}}{{2}} c_{{12}}$\n\n$h_y = {hy}$\n\n\
             $h_x^2 + h_y^2 = {square}$\n"
        )
    };
    let square = "a_1^2 + \\frac{a_2^2}{4} + a_1 a_2 c_2";
    let name = "h_x^2 + h_y^2";
    let right = "a_1 s_1 + \\frac{a_2}{2} s_{12}";
    assert_eq!(standings(&text(right, square), name), [Standing::Equal]);
    assert_ne!(standings(&text("a_1 s_1 - \\frac{a_2}{2} s_{12}", square), name), [Standing::Wrong]);
}

/// The angle of a sine and a cosine is what these are: proved with them, carried where one of them is wrong.
#[test]
fn an_angle_of_its_sine_and_cosine_rests_on_them() {
    let d = catalogue::robot("ur5").expect("in the catalogue");
    let standings = |cosine: &str| {
        let text = format!(
            "$$\nX = C_1 (p_x - d_6 a_x) + S_1 (p_y - d_6 a_y) - d_5 S_{{234}}\n$$\n\n\
             $$\nZ = p_z - d_6 a_z - d_1 + d_5 C_{{234}}\n$$\n\n$$\nC_3 = {cosine}\n$$\n\n\
             $$\nS_3 = \\kappa_3 \\sqrt{{1 - C_3^2}}\n$$\n\nwith $\\kappa_3 = \\pm 1$,\n\n\
             $$\nq_3 = \\operatorname{{atan2}}(S_3, C_3)\n$$\n"
        );
        let checked = check(&text, Format::Markdown, Some(&d), &CheckOptions::default()).expect("it is read");
        let of = |name: &str| {
            let claim = checked.claims.iter().find(|c| c.name == name);
            claim.map(|c| (c.standing(), c.is_proved()))
        };
        [of("C_3"), of("q_3")]
    };
    let right = standings("\\frac{X^2 + Z^2 - a_2^2 - a_3^2}{2 a_2 a_3}");
    assert_eq!(right, [Some((Standing::Equal, true)); 2]);
    let wrong = standings("\\frac{X^2 + Z^2 + a_2^2 - a_3^2}{2 a_2 a_3}");
    assert_eq!(wrong, [Some((Standing::Wrong, false)), Some((Standing::Carried, false))]);
}

/// Two values of which one is right at every pose are proved; one value twice is half of them.
#[test]
fn both_directions_of_an_arctangent_are_proved() {
    let d = catalogue::robot("staubli-rx90").expect("in the catalogue");
    let proved = |other: &str| {
        let text = format!(
            "$\\theta_1 = \\operatorname{{atan2}}(p_y, p_x)$ or $\\theta_1 = \\operatorname{{atan2}}({other})$\n"
        );
        let checked = check(&text, Format::Markdown, Some(&d), &CheckOptions::default()).expect("it is read");
        assert_eq!(checked.claims.len(), 2, "{other}");
        checked.claims.iter().filter(|c| c.is_proved()).count()
    };
    assert_eq!(proved("-p_y, -p_x"), 2);
    assert_eq!(proved("2 p_y, 2 p_x"), 0);
    assert_eq!(proved("-p_y, p_x"), 0);
}
