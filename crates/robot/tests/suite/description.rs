//! Robot files: what they are read as, what is said about those that cannot be read, and conversions.

use crate::common::{robot, shown};
use denavit::catalogue;
use denavit::description::{
    Convention, Description, Measure, Moved, SameChain, prove_same_chain, read_toml, read_value, render,
    write_toml,
};
use denavit_symbolic::{Expr, Rational, equal};

/// All findings of a robot file begin as expected, in this order.
#[track_caller]
fn check_findings(text: &str, expected: &[&str]) {
    let found = match read_toml(text) {
        Ok((_, findings)) => shown(text, &findings),
        Err(findings) => shown(text, &findings),
    };
    let same = found.len() == expected.len() && found.iter().zip(expected).all(|(f, e)| f.starts_with(e));
    assert!(same, "{text}\nfound:\n{}\nexpected:\n{}", found.join("\n"), expected.join("\n"));
}

/// As [`check_findings`], for a planar arm of one row with the given lines in it (which begin in line 3).
#[track_caller]
fn check_row(lines: &str, expected: &[&str]) {
    check_findings(&format!("convention = \"standard\"\n[[joints]]\n{lines}\n"), expected);
}

#[test]
fn rows_say_what_is_wrong_with_them() {
    for (lines, expected) in [
        ("theta = \"q1\"\ntetha = 0", vec!["4:1 error: unknown key `tetha` | did you mean `theta`?"]),
        (
            "theta = \"q1\"\nr = 1",
            vec!["4:1 error: unknown key `r` | `r` is Khalil's letter; the standard convention writes `d`"],
        ),
        (
            "theta = \"q1\"\noffset = 1",
            vec!["4:1 error: unknown key `offset` | an offset stands in the cell itself"],
        ),
        ("theta = \"q1 +\"", vec!["3:13 error: the formula ends where a name or a number should stand"]),
        ("theta = \"q1 ++ 2\"", vec!["3:14 error: unexpected `+`"]),
        ("theta = \"q1 2\"", vec!["3:13 error: two values without a sign between them | write a product"]),
        ("theta = \"(q1\"", vec!["3:10 error: no `)` closes this bracket"]),
        ("theta = \"q1 @ 3\"", vec!["3:13 error: unexpected character `@`"]),
        ("theta = \"\"", vec!["3:9 error: an empty cell | write 0"]),
        ("theta = \"q1 + 20 mm\"", vec!["3:18 error: `mm` measures a length; this is an angle"]),
        ("theta = \"q1\"\nd = \"90 deg\"", vec!["4:9 error: `deg` measures an angle; this is a length"]),
        (
            "theta = \"q1\"\nd = \"a1 mm\"",
            vec!["4:9 error: the unit `mm` behind a name | a name has its unit"],
        ),
        ("theta = \"q1\"\nd = \"2 mm * (3 mm)\"", vec!["4:6 error: a product of two quantities with units"]),
        ("theta = \"q1\"\nd = \"3 mm a1\"", vec!["4:11 error: `a1` behind a unit | a product with a unit"]),
        (
            "theta = \"q1\"\nd = \"1/2 a1\"",
            vec!["4:7 error: `/2 a1` reads as `/2*a1` or as `/(2*a1)` | write"],
        ),
        (
            "theta = \"q1\"\nd = \"2^99\"",
            vec!["4:6 error: a power is a whole number up to 9, and a cell has few"],
        ),
        (
            "theta = \"q1 + 1 rad deg\"",
            vec!["3:21 error: `1 rad` has a unit already; `deg` would be a second"],
        ),
        ("theta = \"q1\"\nd = \"1/0\"", vec!["4:7 error: division by zero"]),
        ("theta = \"q1\"\nd = nan", vec!["4:5 error: the value is not a finite number"]),
        ("theta = \"q1\"\nd = -inf", vec!["4:5 error: the value is not a finite number"]),
        ("theta = \"q1\"\nd = 1e999", vec!["4:5 error: `1e999` is too long a number"]),
        (
            "theta = \"q1\"\nd = true",
            vec!["4:5 error: a number or a formula in quotes is expected here, not true"],
        ),
        (
            "theta = \"q1\"\nd = \"L7\"",
            vec!["4:6 error: `L7` is not declared | declare it: [parameters] L7 = \"450 mm\""],
        ),
        (
            "theta = \"theta1\"",
            vec!["3:10 error: `theta1` is not declared | joint variables are written `q1`"],
        ),
        ("theta = \"q2\"", vec!["3:10 error: `q2` comes before `q1` | variables count the rows"]),
        (
            "theta = \"q1 + q2\"",
            vec!["3:15 error: two new joint variables in one row, `q1` and `q2` | a row is one joint"],
        ),
        (
            "theta = \"q1\"\nd = \"q1\"",
            vec!["4:6 error: `q1` both in `theta` and in `d` | a joint turns or slides"],
        ),
        ("theta = \"q1\"\na = \"q1\"", vec!["4:6 error: the joint variable `q1` in `a` | a joint turns"]),
        ("alpha = \"q1\"", vec!["3:10 error: the joint variable `q1` in `alpha`"]),
        (
            "theta = \"q1^2\"",
            vec!["3:10 error: `theta` is not linear in `q1` | a joint variable may have a rational number"],
        ),
        (
            "theta = \"pi*q1\"",
            vec![
                "3:13 error: the factor of `q1` in `theta` is no rational number | a joint variable may have",
            ],
        ),
        ("theta = \"sin(q1)\"", vec!["3:14 error: `theta` is not linear in `q1`"]),
        ("theta = \"2*q1 - q1 - q1\"", vec!["3:12 error: `q1` cancels in `theta`"]),
        ("theta = \"q1\"\nlimits = [2, 1]", vec!["4:10 error: the lower limit is above the upper one"]),
        ("theta = \"q1\"\nlimits = [1]", vec!["4:10 error: limits are two values"]),
        ("theta = \"q1\"\nlimits = [0, \"L\"]", vec!["4:15 error: `L` stands where a number is needed"]),
        (
            "theta = \"q1\"\nlimits = [0, \"20 mm\"]",
            vec!["4:18 error: `mm` measures a length; this is an angle"],
        ),
        ("d = 1\nlimits = [0, 1]", vec!["4:10 error: `limits` of a row without a joint variable"]),
        ("theta = \"q1\"\nvelocity = -1", vec!["4:12 error: the largest value is positive"]),
        ("theta = \"q1\"\ncom = [0, 0]", vec!["4:7 error: com has 3 values, not 2"]),
        ("theta = \"q1\"\nmass = \"-1 kg\"", vec!["4:8 error: the mass is negative"]),
        ("theta = \"q1\"\ntheta = \"q1\"", vec!["4:1 error: `theta` is given twice"]),
        ("theta = \"q1 + 90\"", vec!["3:15 warning: 90 rad is more than a turn"]),
        ("theta = \"q1\"\na = 151.9", vec!["4:5 warning: 151.9 m is a long way"]),
        ("theta = \"q1 + 1.5708\"", vec!["3:15 warning: 1.5708 is nearly π/2 (off by 3.7e-6 rad)"]),
        ("theta = \"q1\"\nalpha = 1.5707963267948966", vec!["4:9 note: 1.5707963267948966 is read as π/2"]),
        ("theta = \"q1\"\nalpha = -1.570796326794897", vec!["4:9 note: 1.570796326794897 is read as π/2"]),
        (
            "theta = \"q1\"\nalpha = \"2.356194490192345 rad\"",
            vec!["4:10 note: 2.356194490192345 is read as 3π/4"],
        ),
        ("theta = \"q1\"\nalpha = 0.7", vec![]),
        ("theta = \"q1\"\na = \"450 mm + 2 cm\"", vec![]),
    ] {
        check_row(lines, &expected);
    }
}

#[test]
fn files_say_what_is_wrong_with_them() {
    let joint = "[[joints]]\ntheta = \"q1\"\n";
    for (text, expected) in [
        (joint.to_string(), vec!["1:1 error: the convention is missing | a table means nothing without it"]),
        (
            format!("convention = \"stadnard\"\n{joint}"),
            vec!["1:14 error: unknown convention \"stadnard\" | did you mean \"standard\"?"],
        ),
        (
            format!("convention = \"modified\"\n{joint}"),
            vec!["1:14 error: unknown convention \"modified\" | the modified convention has two alphabets"],
        ),
        ("convention = \"craig\"\n".into(), vec!["1:1 error: there are no joints"]),
        (
            format!("convention = \"craig\"\ntheta = 1\n{joint}"),
            vec!["2:1 error: unknown key `theta` | `theta` belongs under [[joints]]"],
        ),
        ("convention = \"craig\"\n[[joints]]\ntheta = \"q1\n".into(), vec!["3:12 error: not TOML: "]),
        (
            format!("convention = \"craig\"\n[parameters]\nq1 = 1\nC1 = 2\nmm = 3\n{joint}"),
            vec![
                "3:1 error: the parameter `q1` is named like a joint variable",
                "4:1 error: the parameter `C1` is named like",
                "5:1 error: the parameter `mm` is named like",
            ],
        ),
        (
            format!("convention = \"craig\"\n[parameters]\na1 = 1\na1 = 2\na2 = \"a1\"\na3 = \"1 mm + 2 deg\"\n{joint}"),
            vec![
                "4:1 error: `a1` is given twice",
                "5:7 error: `a1` in the value of a parameter",
                "6:16 error: `deg` measures an angle; this is a length",
            ],
        ),
        (
            "convention = \"craig\"\n[parameters]\nd1 = \"90 deg\"\n[[joints]]\ntheta = \"q1\"\nd = \"d1\"\n".into(),
            vec!["3:10 error: `deg` measures an angle; this is a length"],
        ),
        (
            "convention = \"craig\"\n[parameters]\nshoulder = 1\n[[joints]]\ntheta = \"q1\"\nd = \"sholder\"\n".into(),
            vec!["6:6 error: `sholder` is not declared | did you mean `shoulder`?"],
        ),
        (
            format!("convention = \"craig\"\n{joint}[poses]\nhome = [0, 1]\n"),
            vec!["5:8 error: the pose `home` has 2 values for 1 joint variables"],
        ),
        (
            format!("convention = \"craig\"\n{joint}[tool]\nxyz = [\"q1\", 0, 0]\n"),
            vec!["5:9 error: the joint variable `q1` in what is constant"],
        ),
        (
            format!("convention = \"craig\"\n{joint}[base]\nmatrix = [[1,0,0,0],[0,2,0,0],[0,0,1,0],[0,0,0,1]]\n"),
            vec!["5:10 error: not a rigid transform: the columns of the rotation are not orthogonal unit vectors"],
        ),
        (
            format!("convention = \"craig\"\n{joint}[base]\nmatrix = [[1,0,0,0],[0,1,0,0],[0,0,-1,0],[0,0,0,1]]\n"),
            vec!["5:10 error: not a rigid transform: the rotation has determinant −1"],
        ),
        // A name in a place says nothing for the rotation.
        (
            format!("convention = \"craig\"\n[parameters]\nL = 1\n{joint}[tool]\nmatrix = [[1,0,0,\"L\"],[0,1,0,0],[0,0,-1,0],[0,0,0,1]]\n"),
            vec!["7:10 error: not a rigid transform: the rotation has determinant −1"],
        ),
        (
            format!("convention = \"craig\"\n[parameters]\nL = 1\n{joint}[tool]\nmatrix = [[2,0,0,\"L\"],[0,1,0,0],[0,0,0.5,0],[0,0,0,1]]\n"),
            vec!["7:10 error: not a rigid transform: the columns of the rotation are not orthogonal unit vectors"],
        ),
        (
            format!("convention = \"craig\"\n[parameters]\ng = {{}}\n{joint}[tool]\nmatrix = [[\"cos(g)\",\"-sin(g)\",0,0],[\"sin(g)\",\"cos(g)\",0,0],[0,0,-1,0],[0,0,0,1]]\n"),
            vec!["7:10 error: not a rigid transform: the columns are not proved to be orthogonal unit vectors"],
        ),
        (
            "convention = \"khalil\"\n[[joints]]\na = 1\ntheta = \"q1\"\n".into(),
            vec!["3:1 error: unknown key `a` | Khalil writes `d` for the length along x"],
        ),
        (
            "convention = \"standard\"\n[[joints]]\ntheta = \"q1\"\n[[joints]]\ntheta = \"q1\"\n".into(),
            vec!["5:10 note: this row has no joint variable of its own: it follows `q1`"],
        ),
    ] {
        check_findings(&text, &expected);
    }
}

#[test]
fn all_errors_come_at_once() {
    let text = "convention = \"standard\"\n[parameters]\npi = 1\n[[joints]]\ntheta = \"q2\"\nd = \"L\"\nlimit = 3\n\
                [[joints]]\nalpha = \"90 mm\"\ntheta = \"q3\"\n[poses]\nzero = 0\n";
    check_findings(
        text,
        &[
            "3:1 error: the parameter `pi`",
            "5:10 error: `q2` comes before `q1`",
            "6:6 error: `L` is not declared",
            "7:1 error: unknown key `limit` | did you mean `limits`?",
            "9:13 error: `mm` measures a length",
            "12:8 error: a list for a pose is expected here, not a number",
        ],
    );
}

#[test]
fn cells_are_exact() {
    let value = |key: &str, cell: &str| {
        let text = format!(
            "convention = \"standard\"\n[parameters]\na1 = \"\"\na_1 = {{}}\ne1a = {{}}\n[[joints]]\ntheta = \"q1\"\n[[joints]]\n{key} = {cell}\n"
        );
        let row =
            read_toml(&text).unwrap_or_else(|e| panic!("{}", render(&e, "cell", &text))).0.rows[1].clone();
        if key == "alpha" { row.alpha } else { row.a }
    };
    let (pi, a1, number) = (Expr::pi(), Expr::symbol("a1"), |n, d| Expr::from(Rational::new(n, d)));
    for (key, cell, expected) in [
        ("a", "0.1519", number(1519, 10000)),
        ("a", "\"151.9 mm\"", number(1519, 10000)),
        ("a", "\"a1 + 20 mm\"", a1 + number(1, 50)),
        ("a", "\"2 a1 - 1/3 m\"", number(2, 1) * a1 - number(1, 3)),
        ("a", "\"1 in\"", number(254, 10000)),
        ("a", "\"a1*cos(60 deg)\"", a1 * number(1, 2)),
        ("a", "\"sqrt(2)/2 * a1\"", Expr::int(2).sqrt() / Expr::int(2) * a1),
        ("a", "1_000e-3", number(1, 1)),
        ("a", "\"1e-3\"", number(1, 1000)),
        ("a", "\".5e-3\"", number(1, 2000)),
        ("a", "\"2e1a\"", number(2, 1) * Expr::symbol("e1a")),
        ("a", "\"2e1mm\"", number(1, 50)),
        ("a", "\"a1*tan(45 deg)\"", a1),
        ("a", "\"\\\\frac{a_1}{2}\"", Expr::symbol("a_1") / Expr::int(2)),
        ("alpha", "\"90 deg\"", pi * number(1, 2)),
        ("alpha", "\"-90°\"", -pi * number(1, 2)),
        ("alpha", "\"−π/2\"", -pi / Expr::int(2)),
        ("alpha", "\"-pi/2\"", -pi / Expr::int(2)),
        ("alpha", "\"pi - 30 deg\"", pi - pi * number(1, 6)),
        ("alpha", "\"(45 + 45) deg\"", pi * number(1, 2)),
        ("alpha", "\"0.5 rad\"", number(1, 2)),
        ("alpha", "\"1/4 turn\"", pi * number(1, 2)),
        ("alpha", "-1.5707963267948966", -pi * number(1, 2)),
    ] {
        let found = value(key, cell);
        assert!(equal(found, expected).is_equal(), "{key} = {cell}");
    }
    assert_eq!(value("alpha", "\"90 deg\"").cos(), Expr::int(0), "cos(π/2) is 0, not 6e-17");
}

#[test]
fn values_have_exponents_and_units() {
    let value = |text: &str, measure| read_value(text, measure).map(|e| e.eval(|_| None).expect("a number"));
    assert_eq!(value("-7.5e-13rad", Measure::Angle), Ok(-7.5e-13));
    assert_eq!(value("2e-3 mm", Measure::Length), Ok(2e-6));
    assert_eq!(value("1E+2mm", Measure::Length), Ok(0.1));
    assert!(value("1erad", Measure::Angle).is_err());
    for (text, unit, wanted) in [
        ("4kg", "kg", 4.0),
        ("250 g", "kg", 0.25),
        ("0.1 kg m²", "kg m^2", 0.1),
        ("2e3 g*mm^2", "kg m^2", 2e-6),
        ("0.4 N·m", "N m", 0.4),
        ("400 Nmm", "N m", 0.4),
        ("0.4 kg m² s⁻²", "N m", 0.4),
        ("0.1 N m s/rad", "N m s/rad", 0.1),
        ("0.1 N·m·s", "N m s/rad", 0.1),
        ("3 N s/m + 1 kg/s", "N s/m", 4.0),
        ("1.62 m / s^2", "m/s^2", 1.62),
        ("7", "kg", 7.0),
        ("7 kg", "", 7.0),
    ] {
        assert_eq!(value(text, Measure::Other(unit)), Ok(wanted), "{text}");
    }
    for (text, unit) in [("4 mm", "kg"), ("4 kg", "kg m^2"), ("4 N m", "N"), ("1e400", "m/s^2"), ("4 s", "")]
    {
        assert!(value(text, Measure::Other(unit)).is_err(), "{text}");
    }
}

/// A parameter is what the cells are in which it stands.
#[test]
fn parameters_of_masses_have_their_units() {
    let text = "name = 'm'\nconvention = 'craig'\n\
        [parameters]\nL = ''\nM = ''\nJ = ''\nF = ''\nV = ''\nx = ''\nk = ''\n\
        [[joints]]\na = 'L'\ntheta = 'q1'\nmass = 'M'\ncom = ['x', 0, 0]\n\
        inertia = ['J', 0, 0, '0.1 kg m²', 0, 'k*J']\ncoulomb = 'F + 0.1 N·m'\nviscous = 'V'\n\
        [[joints]]\nd = 'q2'\nmass = 1\n";
    let mut d = read_toml(text).expect("a robot").0;
    let measure = |d: &Description, name: &str| d.measure(denavit_symbolic::Symbol::new(name));
    for (name, wanted) in [
        ("L", Measure::Length),
        ("M", Measure::Other("kg")),
        ("x", Measure::Length),
        ("J", Measure::Other("kg m^2")),
        ("F", Measure::Other("N m")),
        ("V", Measure::Other("N m s/rad")),
        ("k", Measure::Other("")),
    ] {
        assert_eq!(measure(&d, name), wanted, "{name}");
    }
    assert!(d.set("M", "4kg").is_ok() && d.set("M", "4").is_ok() && d.set("k", "2").is_ok());
    assert!(d.set("M", "4mm").is_err() && d.set("J", "4 kg").is_err());
    let found = read_toml(&text.replace("M = ''", "M = '4 mm'")).expect_err("a mass is no length");
    assert!(found.iter().any(|f| f.message.contains("this is a mass")), "{found:?}");
}

#[test]
fn every_robot_of_the_catalogue_is_read_and_written_back() {
    for name in catalogue::names() {
        let text = catalogue::text(name).expect("a robot of the catalogue");
        let (d, findings) = read_toml(text).unwrap_or_else(|e| panic!("{}", render(&e, name, text)));
        assert_eq!(shown(text, &findings), Vec::<String>::new(), "{name}");
        let written = write_toml(&d);
        let again = read_toml(&written).unwrap_or_else(|e| panic!("{}", render(&e, name, &written))).0;
        assert_eq!(format!("{d:?}"), format!("{again:?}"), "{name}"); // equal handles are equal formulas
    }
}

#[test]
fn conversions_keep_every_chain() {
    for name in catalogue::names() {
        let d = robot(name);
        for to in Convention::ALL {
            let there = d.converted(to).description;
            assert_eq!(there.convention, to);
            assert_eq!(prove_same_chain(&d, &there), SameChain::Equal, "{name} in {to}");
            let back = there.converted(d.convention).description;
            assert_eq!(prove_same_chain(&d, &back), SameChain::Equal, "{name} to {to} and back");
            let written = write_toml(&there);
            let again = read_toml(&written).unwrap_or_else(|e| panic!("{}", render(&e, name, &written))).0;
            assert_eq!(format!("{there:?}"), format!("{again:?}"), "{name} in {to}, written");
        }
    }
}

#[test]
fn a_changed_length_is_another_chain() {
    let d = robot("puma560");
    let mut changed = d.converted(Convention::Craig).description;
    changed.rows[2].a = changed.rows[2].a + Expr::from(Rational::new(1, 1_000_000));
    assert!(matches!(prove_same_chain(&d, &changed), SameChain::Different { .. }));
}

#[test]
fn branches_of_khalil_become_part_of_the_row_before() {
    // Khalil and Kleinfinger 1986: a row with γ, b is Rz(γ)·Tz(b)·Rx(α)·Tx(d)·Rz(θ)·Tz(r).
    let text = "convention = \"khalil\"\n[parameters]\nL = {}\n[[joints]]\ngamma = \"30 deg\"\nb = \"L\"\ntheta = \"q1\"\n\
                com = [\"1 m\", 0, 0]\ninertia = [1, 0, 0, 2, 0, 3]\n\
                [[joints]]\ngamma = \"90 deg\"\nb = \"0.2 m\"\nalpha = \"90 deg\"\nd = \"0.1 m\"\ntheta = \"q2\"\n";
    let d = read_toml(text).expect("a robot").0;
    for to in [Convention::Standard, Convention::Craig] {
        let conversion = d.converted(to);
        assert!(conversion.moved.contains(&Moved::BranchToRow(0)), "{:?}", conversion.moved);
        assert_eq!(prove_same_chain(&d, &conversion.description), SameChain::Equal, "{to}");
    }
    // Frame 1 turned by 90° about z and moved by 0.2 m along it: (1, 0, 0) is seen at (0, −1, −0.2).
    let craig = d.converted(Convention::Craig).description;
    let numbers = |e: &[Expr]| e.iter().map(|e| e.eval(|_| None).expect("a number")).collect::<Vec<_>>();
    assert_eq!(numbers(&craig.rows[0].com.expect("it had one")), [0.0, -1.0, -0.2]);
    assert_eq!(numbers(&craig.rows[0].inertia.expect("it had one")), [2.0, 0.0, 0.0, 1.0, 0.0, 3.0]);
}

#[test]
fn a_chain_of_sixty_joints() {
    let row =
        |i: usize| format!("[[joints]]\ntheta = \"q{i} + {i} deg\"\na = \"{i} mm\"\nalpha = \"30 deg\"\n");
    let text = format!("convention = \"standard\"\n{}", (1..=60).map(row).collect::<String>());
    let d = read_toml(&text).unwrap_or_else(|e| panic!("{}", render(&e, "long", &text))).0;
    assert_eq!(d.variables().len(), 60);
    let craig = d.converted(Convention::Craig).description;
    assert_eq!(prove_same_chain(&d, &craig), SameChain::Equal);
    assert_eq!(format!("{d:?}"), format!("{:?}", read_toml(&write_toml(&d)).expect("what was written").0));
}

#[test]
fn too_large_texts_are_refused() {
    let rows = format!("convention = \"craig\"\n{}", "[[joints]]\n".repeat(501));
    check_findings(&rows, &["2:1 error: 501 rows; 500 are allowed"]);
    let long = " ".repeat((1 << 20) + 1);
    check_findings(&long, &["1:1 error: the text has 1048577 bytes"]);
    check_row(&format!("theta = \"q1{}\"", " + 1".repeat(300)), &["3:9 error: a cell of 1202 bytes"]);
    check_row(&format!("theta = \"{}q1\"", "(".repeat(120)), &["3:110 error: nested more than 100 deep"]);
}
