//! Names whose meaning is asked of their values: points, frame 0, signs, entries of the wrist, Jacobians of the first joints.

use denavit::catalogue;
use denavit_check::{CheckOptions, Checked, Finding, Standing, check};
use denavit_reading::document::Format;

fn checked(robot: &str, text: &str) -> Checked {
    check(text, Format::Markdown, catalogue::robot(robot).as_ref(), &CheckOptions::default()).unwrap()
}

fn standing(checked: &Checked, name: &str) -> Standing {
    let claim = checked.claims.iter().find(|c| c.name == name);
    claim.unwrap_or_else(|| panic!("no claim about {name}: {:?}", checked.claims)).standing()
}

#[test]
fn coordinates_of_a_point_of_the_arm() {
    let elbow = |z: &str| format!("xE = a2*cos(q1)*cos(q2)\n\nyE = a2*sin(q1)*cos(q2)\n\nzE = {z}\n");
    let right = checked("articulated-3r", &elbow("d1 + a2*sin(q2)"));
    let wrong = checked("articulated-3r", &elbow("a2*sin(q2)"));
    for name in ["xE", "yE"] {
        assert_eq!([standing(&right, name), standing(&wrong, name)], [Standing::Equal; 2], "{name}");
    }
    assert_eq!([standing(&right, "zE"), standing(&wrong, "zE")], [Standing::Equal, Standing::Wrong]);
    // What agrees with no frame is a helper of the author's own.
    let own = checked("articulated-3r", "xk = a2*sin(q1)\n\nyk = a3*cos(q2)\n");
    assert!(own.claims.is_empty() && own.unjudged.len() == 2, "{:?}", own.claims);
}

#[test]
fn frame_0_may_be_the_base_of_the_file() {
    let rotation = "$$R_{03} = \\begin{bmatrix} 1&0&0\\\\0&1&0\\\\0&0&1\\end{bmatrix}$$\n";
    assert_eq!(standing(&checked("cartesian-ppp", rotation), "R_{03}"), Standing::Equal);
}

#[test]
fn an_arm_of_slides_has_no_size_of_its_own() {
    let found = checked("cartesian-ppp", "q1 = px\n\nq2 = -py\n\nq3 = pz\n");
    let all = ["q1", "q2", "q3"].map(|name| standing(&found, name));
    assert_eq!(all, [Standing::Equal, Standing::Wrong, Standing::Equal]);
}

#[test]
fn a_sign_that_is_chosen_is_no_claim() {
    let text = "Let $\\sigma = +1$ for the one elbow and $\\sigma = -1$ for the other.\n\n\
                $$D = \\frac{p_x^2 + p_y^2 + (p_z - d_1)^2 - a_2^2 - a_3^2}{2 a_2 a_3}$$\n\n\
                $$\\theta_3 = \\operatorname{atan2}(\\sigma\\sqrt{1 - D^2}, D)$$\n";
    let found = checked("articulated-3r", text);
    assert_eq!(standing(&found, "\\theta_3"), Standing::Equal);
    assert!(found.claims.iter().all(|c| c.standing() != Standing::Wrong), "{:?}", found.claims);
}

#[test]
fn entries_of_the_wrist() {
    let wrist = |q6: &str| {
        format!(
            "With $M = R_{{36}}$ and its entries m_ij:\n\nq5 = atan2(±sqrt(m13^2 + m23^2), m33)\n\nq6 = atan2({q6})\n"
        )
    };
    let right = checked("stanford", &wrist("m32*sin(q5), -m31*sin(q5)"));
    let wrong = checked("stanford", &wrist("m32*sin(q5), m31*sin(q5)"));
    assert_eq!(standing(&right, "q5"), Standing::Equal);
    assert_eq!([standing(&right, "q6"), standing(&wrong, "q6")], [Standing::Equal, Standing::Wrong]);
}

#[test]
fn the_jacobian_of_the_first_joints() {
    let jacobian = |first: &str| {
        format!(
            "The velocity of the wrist centre:\n\n$$J_3 = \\begin{{bmatrix}} {first} & c_1c_2q_3 & c_1s_2\\\\ \
             c_1s_2q_3 - s_1R2 & s_1c_2q_3 & s_1s_2\\\\ 0 & -s_2q_3 & c_2\\end{{bmatrix}}$$\n"
        )
    };
    assert_eq!(standing(&checked("stanford", &jacobian("-s_1s_2q_3 - c_1R2")), "J_3"), Standing::Equal);
    let wrong = checked("stanford", &jacobian("-s_1s_2q_3"));
    let places = wrong.claims.iter().flat_map(|c| &c.entries);
    let places: Vec<_> = places.filter(|e| matches!(e.finding, Finding::Wrong(_))).map(|e| e.place).collect();
    assert_eq!(places, [Some((1, 1))]);
}

#[test]
fn a_name_may_have_a_number_for_each_case() {
    let text = "Here $\\sigma_j = 0$ for a joint that turns and\n\n- $\\sigma_j = 1$ for one that slides.\n\n$p_z = d_1 + a_2 s_2 + a_3 s_{23}$\n";
    let found = checked("articulated-3r", text);
    assert!(found.claims.iter().all(|c| c.standing() == Standing::Equal), "{:?}", found.claims);
}

#[test]
fn a_name_beside_its_own_other_spelling_is_the_authors() {
    let found = checked("ur5", "Px = px - d6*ax\n\nPy = py - d6*ay\n\nd4 = Px*sin(q1) - Py*cos(q1)\n");
    for name in ["Px", "Py", "d4"] {
        assert_eq!(standing(&found, name), Standing::Equal, "{name}");
    }
}

#[test]
fn letters_of_the_hand_may_be_another_point() {
    let wrist = "The first wrist point is at\n\nx = cos(q1)*(a2*cos(q2) + a3*cos(q2+q3)) + d4*sin(q1)\n\n\
                 y = sin(q1)*(a2*cos(q2) + a3*cos(q2+q3)) - d4*cos(q1)\n\nz = d1 + a2*sin(q2) + a3*cos(q2+q3)\n";
    let found = checked("ur5", wrist);
    assert_eq!(
        ["x", "y", "z"].map(|n| standing(&found, n)),
        [Standing::Equal, Standing::Equal, Standing::Wrong]
    );
}

/// x² + y² does not tell the signs of x and y.
#[test]
fn what_holds_for_both_signs_vouches_for_none() {
    let text = |u: &str| {
        format!("u = {u}\n\nw = a2*sin(q2) + a3*sin(q2+q3)\n\nu^2 + w^2 = a2^2 + a3^2 + 2*a2*a3*cos(q3)\n")
    };
    let plane = "a2*cos(q2) + a3*cos(q2+q3)";
    for (u, w) in [(plane.to_string(), "w"), (format!("-({plane})"), "u")] {
        // The distance from the first axis is known by its value.
        let found = checked("articulated-3r", &text(&u));
        assert!(found.claims.iter().all(|c| c.name != w), "{:?}", found.claims);
        assert_eq!(standing(&found, "u^2 + w^2"), Standing::Equal);
    }
    let found = checked("articulated-3r", &format!("u = {plane}\n\npx = u*cos(q1)\n"));
    assert_eq!(standing(&found, "u"), Standing::Equal);
}

#[test]
fn r_ij_may_be_the_wrist_s() {
    let text = "With $r_{ij}$ the elements of $R^3_6$:\n\n- $\\theta_5=\\operatorname{atan2}(\\pm\\sqrt{r_{13}^2+r_{23}^2}, r_{33})$\n\
                - $\\theta_4=\\operatorname{atan2}(r_{23}\\sin\\theta_5, r_{13}\\sin\\theta_5)$\n";
    let found = checked("stanford", text);
    for name in ["\\theta_5", "\\theta_4"] {
        assert_eq!(standing(&found, name), Standing::Equal, "{name}: {:?}", found.claims);
    }
}
