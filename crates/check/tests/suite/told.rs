//! What a document tells without the usual marks: tables row by row, values whose names say nothing, lengths in millimetres, poses
//! and joints in numbers.

use denavit_check::{About, CheckOptions, Checked, Meaning, Standing, check};
use denavit_reading::code::Dialect;
use denavit_reading::document::Format;

fn read(text: &str, format: Format, language: Option<Dialect>) -> Checked {
    let options = CheckOptions { language, ..CheckOptions::default() };
    check(text, format, None, &options).unwrap_or_else(|e| panic!("{e:?}\n{text}"))
}

fn plain(text: &str) -> Checked {
    read(text, Format::Plain, None)
}

fn standing(checked: &Checked, name: &str) -> Standing {
    let claim = checked.claims.iter().find(|c| c.name == name);
    claim.unwrap_or_else(|| panic!("no claim about {name}: {:?}", checked.claims)).standing()
}

/// Nothing right is accused, and the other sign is.
fn holds(text: &str, format: Format, language: Option<Dialect>, name: &str, formula: &str) {
    for (sign, expected) in [("", Standing::Equal), ("-", Standing::Wrong)] {
        let found = read(&text.replace(formula, &format!("{sign}{formula}")), format, language);
        assert_eq!(standing(&found, name), expected, "{text}");
    }
}

#[test]
fn tables_told_row_by_row() {
    let x = "x = a2*cos(q1)*cos(q2)\n";
    for table in [
        "DH parameters (standard):\n\nJoint 1: theta = q1, d = d1, a = 0, alpha = 90°\n\
         Joint 2: theta = q2, d = 0, a = a2, alpha = 0\n\n",
        "Standard DH (theta, d, a, alpha):\n  link 1: (q1, d1, 0, 90°)\n  link 2: (q2, 0, a2, 0°)\n",
        "Standard DH parameters\n\ni       1     2\ntheta   q1    q2\nd       d1    0\na       0     a2\nalpha   90    0\n\n",
        "Standard D-H parameters\n+---+-------+----+----+-------+\n| i | theta | d  | a  | alpha |\n\
         +---+-------+----+----+-------+\n| 1 | q1    | d1 | 0  | 90    |\n| 2 | q2    | 0  | a2 | 0     |\n\
         +---+-------+----+----+-------+\n",
        "DH-Parameter (klassisch), Winkel in Grad:\n\nGelenk   Drehung θ   Verschiebung d   Länge a   Verwindung α\n\
         1        q1          d1              0         90\n2        q2          0               a2        0\n\n",
        "Standard DH, angles in degrees\n\nLink   Variable   alpha   a    d\n1      q1         90      0    d1\n\
         2      q2         0       a2   0\n\n",
    ] {
        holds(&format!("{table}{x}"), Format::Plain, None, "x", "a2*cos(q1)");
    }
    let list = "The standard DH parameters are\n\n- joint 1: $a_1=0$, $\\alpha_1=90^\\circ$, $d_1=h$, $\\theta_1=q_1$\n\
                - joint 2: $a_2=L$, $\\alpha_2=0$, $d_2=0$, $\\theta_2=q_2$\n\n$x = L\\cos q_1\\cos q_2$\n";
    holds(list, Format::Markdown, None, "x", "L\\cos");
    let sentence = "The two links have standard DH parameters $(\\theta, d, a, \\alpha)$ = $(\\theta_1, d_1, 0, 90°)$ and \
                    $(\\theta_2, 0, a_2, 0)$.\n\n$x = a_2 \\cos\\theta_1 \\cos\\theta_2$\n";
    holds(sentence, Format::Markdown, None, "x", "a_2 \\cos");
    let angeles = "\\section*{Standard DH}\n\\begin{tabular}{cccc}\n$a_i$ & $b_i$ & $\\alpha_i$ & $\\vartheta_i$\\\\\n\
                   0 & $h$ & $90^\\circ$ & $\\vartheta_1$\\\\\n$a_2$ & 0 & 0 & $\\vartheta_2$\n\\end{tabular}\n\n\
                   \\[ x = a_2 c_1 c_2 \\]\n";
    holds(angeles, Format::Latex, None, "x", "a_2 c_1");
}

#[test]
fn tables_in_programs() {
    for (language, table) in [
        (
            Dialect::Matlab,
            "%% DH table (standard)\n%   i     theta   d    a    alpha\n%   i = 1  q1     d1   0    90 deg\n%   i = 2  q2     0    a2   0\n",
        ),
        (
            Dialect::Python,
            "# classic DH, order (theta, d, a, alpha)\n#   axis 1 (lift):     q1   d1   0   90\n#   axis 2 (shoulder): q2  0   a2   0\n",
        ),
        (
            Dialect::Python,
            "# standard DH\n# rows: theta, d, a, alpha\nDH = [[q1, d1, 0, pi/2],\n      [q2, 0, a2, 0]]\n",
        ),
        (Dialect::Matlab, "% classical DH\nL(1) = Link([0 d1 0 pi/2]);\nL(2) = Link([0 0 a2 0]);\n"),
    ] {
        let text = format!("{table}x = a2*cos(q1)*cos(q2)\n");
        holds(&text, Format::Plain, Some(language), "x", "a2*cos(q1)");
    }
}

/// A planar arm with two links.
const PLANAR: &str =
    "Standard DH\n\n i | a | alpha | d | theta\n 1 | l1 | 0 | 0 | q1\n 2 | l2 | 0 | 0 | q2\n\n";

#[test]
fn values_whose_names_say_nothing() {
    let about = |text: &str| {
        let found = read(&format!("{PLANAR}{text}\n"), Format::Markdown, None);
        found.claims.into_iter().map(|c| (c.standing(), c.about)).collect::<Vec<_>>()
    };
    let all = about("$$w = \\begin{pmatrix} l_1 c_1 \\\\ l_1 s_1 \\\\ 0\\end{pmatrix}$$");
    assert!(matches!(&all[..], [(Standing::Equal, About::Matrix(Meaning::Origin(_)))]), "{all:?}");
    let all = about("$$M = \\begin{pmatrix} 1&0&0&l_1+l_2\\\\0&1&0&0\\\\0&0&1&0\\\\0&0&0&1\\end{pmatrix}$$");
    assert!(matches!(&all[..], [(Standing::Equal, About::Matrix(Meaning::AtRest(_)))]), "{all:?}");
    let all = about("$$u = \\begin{pmatrix} l_1 c_2 \\\\ l_1 s_1 \\\\ 0\\end{pmatrix}$$");
    assert!(all.is_empty(), "a vector of the author's own: {all:?}");
}

#[test]
fn lengths_in_the_unit_of_the_document() {
    let text = "Standard DH, lengths in mm\n\n i | a | alpha | d | theta\n 1 | 300 | 0 | 0 | q1\n 2 | 200 | 0 | 0 | q2\n\n";
    let formula = |n: u32| plain(&format!("{text}x = 300 cos(q1) + {n} cos(q1+q2)\n"));
    assert_eq!(standing(&formula(200), "x"), Standing::Equal);
    assert_eq!(standing(&formula(210), "x"), Standing::Wrong);
    // Digits count in the unit of the number.
    let number = |x: &str| plain(&format!("{text}For q1 = 30 deg and q2 = 60 deg\n\nx = {x}\n"));
    for (x, expected) in
        [("259.8 mm", Standing::Equal), ("0.2598 m", Standing::Equal), ("261.3 mm", Standing::Wrong)]
    {
        assert_eq!(standing(&number(x), "x"), expected, "{x}");
    }
}

#[test]
fn joints_in_numbers_for_a_pose_in_numbers() {
    let text = |q1: &str| {
        format!(
            "{PLANAR}l1 = 0.5 m, l2 = 0.3 m\n\nInverse kinematics for the point\n\nx = 0.433 m\n\ny = 0.55 m\n\nq1 = {q1}\n\nq2 = 60 deg or q2 = -60 deg\n"
        )
    };
    // The elbow on either side: 30° and 51.8° + 21.8°.
    for (q1, expected) in [("30.0 deg", Standing::Equal), ("25.0 deg", Standing::Wrong)] {
        let found = plain(&text(q1));
        let claim = found.claims.iter().find(|c| c.about == About::Configuration && c.name == "q1");
        let claim = claim.unwrap_or_else(|| panic!("{:?} {:?}", found.claims, found.unjudged));
        assert_eq!(claim.standing(), expected, "{q1}");
    }
}

#[test]
fn conditions_are_no_claims() {
    let found = read(
        &format!(
            "{PLANAR}The Jacobian loses rank iff $\\sin q_2 = 0$. If $c_2 = 0$ the second link is at right angles.\n"
        ),
        Format::Markdown,
        None,
    );
    assert!(found.claims.iter().all(|c| c.standing() == Standing::Equal), "{:?}", found.claims);
}

#[test]
fn values_of_points_and_rates_and_of_the_configuration_before() {
    let table = "DH (standard)\n\n| i | theta | d | a | alpha |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | L1 | 0 |\n| 2 | θ2 | 0 | 0,5 | 0 |\n\n\
                 avec L1 = 0,5 m.\n\nx_C = L1·c1 + 0,5·c12\ny_C = L1·s1 + 0,5·s12\n\nPour θ1 = 30°, θ2 = 60° :\n";
    let text = format!(
        "{table}x_C = 0,433 m ; y_C = 0,750 m\n\nPour le point (0,3 ; 0,4) : θ1 = 1°\n\n\
         Dans la configuration du 1), avec θ1' = 0,3 rad/s, θ2' = -0,1 rad/s :\nvx = -0,175 m/s ; vy = 0,130 m/s\n"
    );
    let found = plain(&text);
    assert_eq!(found.tally().wrong, 0, "{:?}", found.claims);
    assert_eq!([standing(&found, "vx"), standing(&found, "vy")], [Standing::Equal; 2]);
    let found = plain(&text.replace("vx = -0,175", "vx = -0,275").replace("y_C = 0,750", "y_C = 0,450"));
    let wrong = found.claims.iter().filter(|c| c.standing() == Standing::Wrong).map(|c| c.name.as_str());
    assert_eq!(wrong.collect::<Vec<_>>(), ["y_C", "vx"]);
    // Where no configuration is known, a number for a point accuses nothing.
    let found = plain(&text.replace("Pour θ1 = 30°, θ2 = 60° :", "Quelque part :"));
    assert_eq!(found.tally().wrong, 0, "{:?}", found.claims);
}

/// Letters whose small form has another length, as long all together, move no place.
#[test]
fn letters_that_change_their_length() {
    let table = "convention: standard\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | q1 | 0 | a1 | 0 |\n| 2 | q2 | 0 | a2 | 0 |\n\n";
    for words in [
        "ẞ denotes q1 + q2 İ = 3 and",
        "ẞlengths 1.0, 2.0 İ = 2",
        "ẞ the point is on the x axis of frame 2 at the distance b İ = 1",
    ] {
        let text = format!("{table}{words}\n\nx = a1 c1 + a2 c12\n");
        let options = denavit_check::CheckOptions::default();
        let format = denavit_reading::document::Format::Markdown;
        let found = denavit_check::check(&text, format, None, &options).expect("a robot");
        let x = found.claims.iter().find(|c| c.name == "x").expect("a claim");
        assert_eq!(x.standing(), denavit_check::Standing::Equal, "{words}");
    }
}
