//! Inverse kinematics in programs, helpers at fault, and roots of squares.

use denavit::catalogue;
use denavit_check::{About, CheckOptions, Checked, Claim, Finding, SlipKind, Standing, check};
use denavit_reading::code::Dialect;
use denavit_reading::document::Format;

fn checked(robot: &str, text: &str, language: Option<Dialect>) -> Checked {
    let options = CheckOptions { language, ..CheckOptions::default() };
    check(text, Format::Plain, catalogue::robot(robot).as_ref(), &options).unwrap()
}

fn claim<'a>(checked: &'a Checked, name: &str) -> &'a Claim {
    checked.claims.iter().find(|c| c.name == name).unwrap_or_else(|| panic!("no claim about {name}"))
}

/// The elbow arm as programs solve it.
fn python(quadrant: &str, elbow: &str, shoulder: &str) -> String {
    format!(
        "import numpy as np\n\ndef solve(p, elbow=1):\n    px, py, pz = p\n    th1 = np.arctan2({quadrant})\n    \
         r = np.cos(th1)*p[0] + np.sin(th1)*p[1]   # in the plane of the arm\n    s = p[2] - d1\n    \
         D = (r**2 + s**2 - a2**2 - a3**2) / (2*a2*a3)\n    th3 = np.arctan2({elbow} * np.sqrt(1 - D**2), D)\n    \
         th2 = np.arctan2(s, r) - np.arctan2({shoulder})\n    return np.array([th1, th2, th3])\n"
    )
}

#[test]
fn the_lines_of_a_function_are_judged() {
    let shoulder = "a3*np.sin(th3), a2 + a3*np.cos(th3)";
    let right = checked("articulated-3r", &python("py, px", "elbow", shoulder), Some(Dialect::Python));
    for name in ["r", "s", "D", "th3", "th2"] {
        assert_eq!(claim(&right, name).standing(), Standing::Equal, "{name}");
    }
    assert_ne!(claim(&right, "th1").standing(), Standing::Wrong);

    let wrong = checked("articulated-3r", &python("px, py", "elbow", shoulder), Some(Dialect::Python));
    let slip = |checked: &Checked, name: &str| match &claim(checked, name).entries[0].finding {
        Finding::Wrong(wrong) => wrong.slip.clone().map(|s| s.kind),
        other => panic!("{name}: {other:?}"),
    };
    assert_eq!(slip(&wrong, "th1"), Some(SlipKind::Arguments));

    let swapped = "a3*np.cos(th3), a2 + a3*np.sin(th3)";
    let wrong = checked("articulated-3r", &python("py, px", "elbow", swapped), Some(Dialect::Python));
    assert!(matches!(slip(&wrong, "th2"), Some(SlipKind::Formula(_))));
}

#[test]
fn a_matlab_script_too() {
    let text = "px = T(1,4); py = T(2,4);\nq1 = atan2(py, px);\nr = px*cos(q1) + py*sin(q1);\ns = pz - d1;\n\
                D = (r.^2 + s.^2 - a2^2 - a3^2)./(2*a2*a3);\nfor k = [1 -1]\n  q3 = atan2(k*sqrt(1 - D^2), D);\nend\n\
                q2 = atan2(s, r) - atan2(a3*sin(q3), a2 + a3*cos(q3));\n";
    let right = checked("articulated-3r", text, Some(Dialect::Matlab));
    for name in ["r", "s", "D", "q3", "q2"] {
        assert_eq!(claim(&right, name).standing(), Standing::Equal, "{name}");
    }
}

/// `r = √(px² + py²)`, the way of most textbooks: r² is no root.
#[test]
fn the_square_of_a_root_is_proved() {
    let text = "r = sqrt(px^2 + py^2)\ns = pz - d1\nD = (r^2 + s^2 - a2^2 - a3^2)/(2*a2*a3)\n\
                theta3 = atan2(±sqrt(1 - D^2), D)\n";
    let right = checked("articulated-3r", text, None);
    assert_eq!(claim(&right, "theta3").standing(), Standing::Equal);
}

#[test]
fn a_helper_is_blamed_for_what_it_makes_wrong() {
    let text = |helper: &str| format!("D = {helper}\n\ntheta3 = atan2(±sqrt(1 - D^2), D)\n");
    let right = "(px^2 + py^2 + (pz - d1)^2 - a2^2 - a3^2)/(2*a2*a3)";
    let checked_right = checked("articulated-3r", &text(right), None);
    assert_eq!(claim(&checked_right, "D").standing(), Standing::Equal);
    for (was, now) in [("- a3^2", "+ a3^2"), ("(2*a2*a3)", "(a2*a3)"), ("(pz - d1)", "(pz + d1)")] {
        let found = checked("articulated-3r", &text(&right.replace(was, now)), None);
        let helper = claim(&found, "D");
        assert_eq!((helper.standing(), &helper.about), (Standing::Wrong, &About::Helper), "{now}");
        assert_eq!(claim(&found, "theta3").standing(), Standing::Carried, "{now}");
    }
}
