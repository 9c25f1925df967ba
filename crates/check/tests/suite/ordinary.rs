//! Ways of saying things that ordinary documents have: loads in words, configurations by name, results in comments.

use denavit_check::{CheckOptions, Checked, Standing, check};
use denavit_reading::code::Dialect;
use denavit_reading::document::Format;

fn read(text: &str, language: Option<Dialect>) -> Checked {
    let options = CheckOptions { language, ..CheckOptions::default() };
    let format = if language.is_some() { Format::Plain } else { Format::Markdown };
    check(text, format, None, &options).unwrap_or_else(|e| panic!("{e:?}\n{text}"))
}

#[track_caller]
fn expect(text: &str, language: Option<Dialect>, wanted: &[(&str, &[Standing])]) {
    let found = read(text, language);
    for (name, standings) in wanted {
        let own: Vec<Standing> =
            found.claims.iter().filter(|c| c.name == *name).map(|c| c.standing()).collect();
        assert_eq!(own, *standings, "{name}: {:?}", found.claims);
    }
}

const EQUAL: &[Standing] = &[Standing::Equal];
const WRONG: &[Standing] = &[Standing::Wrong];

/// An arm in a vertical plane: its torques under a weight W are W (a1 c1 + a2 c12) and W a2 c12.
const UPRIGHT: &str = "DH (standard), y0 points up\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | a1 | 0 |\n\
                       | 2 | θ2 | 0 | a2 | 0 |\n\na1 = 0.5 m, a2 = 0.4 m, θ1 = 30°, θ2 = 30°:\n\n";

#[test]
fn a_weight_in_newtons_is_a_load() {
    // 0.5 cos 30° + 0.4 cos 60° = 0.63301
    let text = |second: &str| {
        format!(
            "{UPRIGHT}$x = 0.633$ m\n\nThe tip carries a load of 20 N. The torques that hold it are\n\n$\\tau_1 = 12.66$ N m,\n$\\tau_2 = {second}$ N m.\n"
        )
    };
    expect(&text("4.00"), None, &[("\\tau_1", EQUAL), ("\\tau_2", EQUAL)]);
    // Where no reading of the load makes two of them right, nothing is called wrong.
    let found = read(&text("6.93"), None);
    assert!(found.claims.iter().all(|c| c.standing() != Standing::Wrong), "{:?}", found.claims);
}

#[test]
fn a_moment_beside_a_force() {
    let text = |second: &str| {
        format!(
            "{UPRIGHT}The hand exerts (Fx, Fy) and the moment M:\n\nτ1 = -(a1 s1 + a2 s12) Fx + (a1 c1 + a2 c12) Fy + M\n\n\
             τ2 = -a2 s12 Fx + a2 {second} Fy + M\n"
        )
    };
    expect(&text("c12"), None, &[("τ1", EQUAL), ("τ2", EQUAL)]);
    expect(&text("c2"), None, &[("τ1", EQUAL), ("τ2", WRONG)]);
}

const CYLINDER: &str = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | q1 | h | 0 | 0 |\n| 2 | 0 | q2 | 0 | -90° |\n\
                        | 3 | 0 | q3 | 0 | 0 |\n\n";

#[test]
fn couples_and_forces_by_letters() {
    let text = format!(
        "{CYLINDER}Couples and forces of the joints for a force (fx, fy, fz):\n\n    C1 = -q3 c1 fx - q3 s1 fy\n    F2 = fz\n    F3 = c1 fy - s1 fx\n"
    );
    expect(&text, None, &[("C1", EQUAL), ("F2", EQUAL), ("F3", EQUAL)]);
    expect(&text.replace("c1 fy - s1", "c1 fy + s1"), None, &[("C1", EQUAL), ("F3", WRONG)]);
}

#[test]
fn joints_that_words_put_to_zero() {
    let text = |z: &str| {
        format!(
            "{CYLINDER}h = 0.5 m. All joints at 0: z = 0.500 m\n\nq3 = 0.25 m, all others 0: y = 0.250 m, z = {z} m\n"
        )
    };
    expect(&text("0.500"), None, &[("y", EQUAL), ("z", &[Standing::Equal, Standing::Equal])]);
    expect(&text("0.750"), None, &[("y", EQUAL), ("z", &[Standing::Equal, Standing::Wrong])]);
}

#[test]
fn angles_of_the_joints_that_turn() {
    let table = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | l1 | 0 |\n| 2 | θ2 | 0 | l2 | 180° |\n\
                 | 3 | 0 | d3 | 0 | 0 |\n\nl1 = 0.3 m, l2 = 0.2 m.\n\n";
    let text =
        format!("{table}$\\theta=(30^\\circ, 60^\\circ)$: the tool is at\n$x=0.2598$ m,\n$y=0.3600$ m\n");
    expect(&text, None, &[("x", EQUAL), ("y", WRONG)]);
    let letters = table.replace("θ1", "t1").replace("θ2", "t2").replace("| 0 | d3 |", "| t3 | 0 |");
    let text = format!("{letters}For t = (30 deg, 60 deg, 10 deg)\n\nx = 0.2598 m\ny = 0.3600 m\n");
    expect(&text, None, &[("x", EQUAL), ("y", WRONG)]);
}

#[test]
fn configurations_by_name() {
    let table = "DH (standard), metres\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | q1 | 0 | 0.5 | 0 |\n| 2 | q2 | 0 | 0.4 | 0 |\n\n";
    let text = |second: &str| {
        format!(
            "{table}Pose P1   q = (0, 90) deg\n\n    x = 0.500\n\nPose P2   q = (90, 0) deg\n\n    x = 0.000\n\nHeight of the tip:\n\n    P1: y = 0.400\n    P2: y = {second}\n"
        )
    };
    expect(&text("0.900"), None, &[("y", &[Standing::Equal, Standing::Equal])]);
    expect(&text("0.700"), None, &[("y", &[Standing::Equal, Standing::Wrong])]);
}

#[test]
fn columns_by_their_number() {
    let table = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | q1 | d1 | 0 | 90° |\n| 2 | q2 | 0 | a2 | 0 |\n| 3 | q3 | 0 | a3 | 0 |\n\n";
    let text = |sign: &str| {
        format!(
            "{table}The columns are\n\n$$J_3=\\begin{{bmatrix}}-a_3c_1s_{{23}}\\\\-a_3s_1s_{{23}}\\\\a_3c_{{23}}\\end{{bmatrix}}$$\n\n\
             $$J_2=\\begin{{bmatrix}}-c_1(a_2s_2+a_3s_{{23}})\\\\{sign}s_1(a_2s_2+a_3s_{{23}})\\\\a_2c_2+a_3c_{{23}}\\end{{bmatrix}}$$\n"
        )
    };
    expect(&text("-"), None, &[("J_3", EQUAL), ("J_2", EQUAL)]);
    expect(&text(""), None, &[("J_3", EQUAL), ("J_2", WRONG)]);
}

#[test]
fn a_jacobian_with_a_factor() {
    let table = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | q1 | 0 | 0 | 90° |\n| 2 | q2 | 0 | b | 0 |\n\n";
    let text = |last: &str| {
        format!(
            "{table}$$J_v=b\\begin{{bmatrix}}-s_1c_2&-c_1s_2\\\\c_1c_2&-s_1s_2\\\\0&{last}\\end{{bmatrix}}$$\n"
        )
    };
    expect(&text("c_2"), None, &[("J_v", EQUAL)]);
    expect(&text("s_2"), None, &[("J_v", WRONG)]);
}

#[test]
fn a_direction_by_its_formula() {
    let table = "# DH (standard)\n#\n# | i | theta | d | a | alpha |\n# |---|---|---|---|---|\n# | 1 | q1 | 0 | L1 | 0 |\n# | 2 | q2 | 0 | L2 | 0 |\n\
                 # | 3 | q3 | 0 | L3 | 0 |\nfrom math import *\n\n";
    let text = |last: &str| {
        format!(
            "{table}def ik(x, y, w):\n    u = x - L3*cos(w)\n    v = y - L3*sin(w)\n    D = (u**2 + v**2 - L1**2 - L2**2)/(2*L1*L2)\n    q2 = atan2(sqrt(1 - D**2), D)\n    \
             q1 = atan2(v, u) - atan2(L2*sin(q2), L1 + L2*cos(q2))\n    q3 = {last}\n    return q1, q2, q3\n"
        )
    };
    let right = read(&text("w - q1 - q2"), Some(Dialect::Python));
    let of = |c: &Checked, name: &str| c.claims.iter().find(|c| c.name == name).map(|c| c.standing());
    for name in ["q1", "q2", "q3"] {
        let standing = of(&right, name);
        assert!(matches!(standing, Some(Standing::Equal | Standing::Conditional)), "{name}: {standing:?}");
    }
    let wrong = read(&text("w - q1 + q2"), Some(Dialect::Python));
    assert!(wrong.claims.iter().all(|c| c.standing() != Standing::Wrong), "{:?}", wrong.claims);
}

#[test]
fn results_in_comments() {
    let text = |y: &str| {
        format!(
            "%  i  theta  d  a   alpha   (standard DH)\n%  1  q1     0  L1  0\n%  2  q2     0  L2  0\nL1 = 0.5; L2 = 0.4;\n\
             q1 = 30*pi/180;  q2 = 60*pi/180;\n\n% tip\n%   px = 0.4330\n%   py = {y}\n% $\\det J = L_1 L_2 \\sin q_2$\n% k = 3 of 7\n"
        )
    };
    let matlab = Some(Dialect::Matlab);
    expect(&text("0.6500"), matlab, &[("px", EQUAL), ("py", EQUAL), ("\\det J", EQUAL), ("k", &[])]);
    expect(&text("0.5600"), matlab, &[("px", EQUAL), ("py", WRONG)]);
    // Alone it may be said of another configuration.
    let alone = text("0.5600").replace("%   px = 0.4330\n", "");
    expect(&alone, matlab, &[("py", &[Standing::Undecided])]);
}

#[test]
fn units_in_brackets() {
    let text = format!("{UPRIGHT}x = 0.633 (m)\n\ny = 0.560 (m)\n\nM = 3 (N), det J = a1 a2 s2   (m^2)\n");
    expect(&text, None, &[("x", EQUAL), ("y", WRONG), ("det J", EQUAL)]);
}

#[test]
fn determinants_in_another_unit() {
    let text = "DH (standard), lengths in mm\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | 500 | 0 |\n| 2 | θ2 | 0 | 400 | 0 |\n\n\
                At θ1 = 0°, θ2 = 90° (in square metres): det J = 0.2\n";
    expect(text, None, &[("det J", EQUAL)]);
}

#[test]
fn measured_numbers_in_brackets() {
    let text =
        format!("{UPRIGHT}x = 0.633 (0.640),   y = 0.596 (0.59)\n\nx = 0.633 (0.64), y = 0.695 (0.70)\n");
    expect(
        &text,
        None,
        &[("x", &[Standing::Equal, Standing::Equal]), ("y", &[Standing::Equal, Standing::Wrong])],
    );
}

#[test]
fn tables_in_centimetres() {
    let text = "Tabla DH (convención clásica), longitudes en cm\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | 40 | 0 |\n| 2 | θ2 | 0 | 30 | 0 |\n\n\
                Para θ1 = 0°, θ2 = 90°:\n\n- x = 40 cm\n- y = 32,00 cm\n- z = 0,00 cm\n";
    expect(text, None, &[("x", EQUAL), ("y", WRONG)]);
}

#[test]
fn partial_derivatives_by_a_joint_called_t() {
    let text = |y: &str| {
        format!(
            "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | p | 0 | 0 | 90° |\n| 2 | t | 0 | b | 0 |\n\n\
             X = b cos p cos t\n\n∂X/∂t = −b cos p sin t\n\n∂Z/∂t = b {y} t\n"
        )
    };
    expect(&text("cos"), None, &[("∂X/∂t", EQUAL), ("∂Z/∂t", EQUAL)]);
    expect(&text("sin"), None, &[("∂X/∂t", EQUAL), ("∂Z/∂t", WRONG)]);
}

#[test]
fn formulas_under_a_supposition() {
    let table = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | q1 | 0 | 0 | -90° |\n| 2 | q2 | 0 | 0 | 90° |\n| 3 | q3 | L | b | 0 |\n\n";
    // x = b (c1 c2 c3 - s1 s3) + L c1 s2
    let text =
        |words: &str, last: &str| format!("{table}{words} the hand is at\n\n$$x = c_1(b c_2 + L {last})$$\n");
    let posture = "In the posture $q_3 = 0$, in which the arm lies in a plane,";
    expect(&text(posture, "s_2"), None, &[("x", &[Standing::Conditional])]);
    expect(&text(posture, "c_2"), None, &[("x", WRONG)]);
    expect(&text("In general", "s_2"), None, &[("x", WRONG)]);
}

#[test]
fn the_other_solution_of_a_wrist() {
    let table = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | t1 | 0 | 0 | -90° |\n| 2 | t2 | 0 | 0 | 90° |\n| 3 | t3 | d3 | 0 | 0 |\n\n";
    let text = format!(
        "{table}Given R, for t2 > 0:\n\n    t2 = atan2(sqrt(r13^2 + r23^2), r33)\n    t1 = atan2(r23, r13)\n\nand the other one\n\n    t2 = atan2(-sqrt(r13^2 + r23^2), r33)\n    t1 = atan2(-r23, -r13)\n"
    );
    let found = read(&text, None);
    assert!(found.claims.iter().all(|c| c.standing() != Standing::Wrong), "{:?}", found.claims);
    let wrong = read(&text.replace("atan2(-r23, -r13)", "atan2(r13, r23)"), None);
    assert!(wrong.claims.iter().any(|c| c.standing() == Standing::Wrong), "{:?}", wrong.claims);
}

#[test]
fn points_that_words_name() {
    let table = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | q1 | d1 | 0 | 90° |\n| 2 | q2 | 0 | a2 | 0 |\n| 3 | q3 | 0 | a3 | 0 |\n\n";
    let text = |words: &str| {
        format!(
            "{table}{words} lies at\n\n$$p_E = \\begin{{pmatrix}} a_2c_1c_2\\\\ a_2s_1c_2\\\\ d_1+a_2s_2\\end{{pmatrix}}$$\n"
        )
    };
    expect(&text("The elbow, the origin of frame 2,"), None, &[("p_E", EQUAL)]);
    expect(&text("The hand"), None, &[("p_E", WRONG)]);
}

#[test]
fn a_function_for_an_axis() {
    let text = "# DH (standard)\n#\n# | i | theta | d | a | alpha |\n# |---|---|---|---|---|\n# | 1 | q1 | 0 | 0 | 90° |\n# | 2 | q2 | 0 | L2 | 90° |\n\
                # | 3 | q3 | d3 | 0 | 0 |\nimport numpy as np\nfrom numpy import sin, cos\n\n\
                def approach(q1, q2):\n    ax = cos(q1)*sin(q2)\n    ay = sin(q1)*sin(q2)\n    az = -cos(q2)\n    return np.array([ax, ay, az])\n";
    let found = read(text, Some(Dialect::Python));
    assert!(found.claims.iter().all(|c| c.standing() != Standing::Wrong), "{:?}", found.claims);
}

#[test]
fn a_unit_behind_the_last_of_several_lengths() {
    let table = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | q1 | 0 | coxa | 90° |\n| 2 | q2 | 0 | femur | 0 |\n\n";
    // x = (coxa + femur c2) c1 = 40 + 30 = 70 mm at q2 = 60°
    for given in
        ["coxa = 40, femur = 60 (mm), q1 = 0°, q2 = 60°", "coxa = 40 and femur = 60 mm, q1 = 0°, q2 = 60°"]
    {
        let text = |z: &str| format!("{table}With {given}:\n\nx = 70.0 mm\n\nz = {z} mm\n");
        expect(&text("51.96"), None, &[("x", EQUAL), ("z", EQUAL), ("coxa", &[]), ("femur", &[])]);
        expect(&text("30.00"), None, &[("x", EQUAL), ("z", WRONG)]);
    }
}

#[test]
fn metres_beside_a_letter_m() {
    let table = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | t1 | 0 | a1 | 0 |\n| 2 | t2 | 0 | a2 | 180° |\n| 3 | 0 | d3 | 0 | 0 |\n\n";
    let text = |z: &str| {
        format!(
            "{table}The hand exerts (Fx, Fy) and the moment m:\n\nτ1 = -(a1 s1 + a2 s12) Fx + (a1 c1 + a2 c12) Fy + m\n\n\
             τ2 = -a2 s12 Fx + a2 c12 Fy + m\n\nWith a1 = 0.5, a2 = 0.4 (m); d3 = 0.30 m, t1 = 30°, t2 = 30°:\n\nx = 0.6330 m\n\nz = {z} m\n"
        )
    };
    let all = |z: &str| {
        read(&text(z), None).claims.iter().map(|c| (c.name.clone(), c.standing())).collect::<Vec<_>>()
    };
    let wrong = |z: &str| all(z).iter().filter(|c| c.1 == Standing::Wrong).count();
    assert_eq!((wrong("-0.300"), wrong("0.500")), (0, 1), "{:?}", all("-0.300"));
    assert!(all("-0.300").contains(&("z".to_string(), Standing::Equal)));
}

#[test]
fn angles_of_the_table_in_degrees() {
    let text = |angle: &str| {
        format!(
            "% Two joints, standard DH\n%\n%  i  theta  d  a   alpha\n%  1  q1     0  L1  -90\n%  2  q2     0  L2  0\n\n% alpha1 = {angle}, alpha2 = 0\nA = 1;\n"
        )
    };
    let wrong = |angle: &str| {
        let found = read(&text(angle), Some(Dialect::Matlab));
        found.claims.iter().filter(|c| c.name == "alpha1" && c.standing() == Standing::Wrong).count()
    };
    assert_eq!((wrong("-90"), wrong("-pi/2"), wrong("90")), (0, 0, 1));
}

#[test]
fn a_configuration_that_a_line_of_words_names() {
    let table = "DH (standard), metres\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | q1 | 0 | 0.5 | 0 |\n| 2 | q2 | 0 | 0.4 | 0 |\n\n";
    let text = |words: &str, det: &str| {
        format!(
            "{table}First test pose, q = (0, 90):\n   x = 0.500\n   y = 0.400\n\nSecond test pose, q = (30, -30):\n   x = 0.833\n\n\
             {words} has\n   det J = {det}\nby hand.\n"
        )
    };
    expect(&text("The arm in the first test pose", "0.200"), None, &[("det J", EQUAL)]);
    expect(&text("The arm in the first test pose", "-0.150"), None, &[("det J", WRONG)]);
    expect(&text("The arm in the second test pose", "-0.100"), None, &[("det J", EQUAL)]);
}

#[test]
fn a_sum_of_angles_in_degrees() {
    let table = "DH (standard), metres\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | q1 | 0 | 0.5 | 0 |\n| 2 | q2 | 0 | 0.4 | 0 |\n\nPut φ = q1 + q2.\n\n";
    let text = |phi: &str| format!("{table}At q1 = 90, q2 = -30 (degrees):\n\nφ = {phi}\n");
    let of = |text: &str| read(text, None).claims.iter().filter(|c| c.standing() == Standing::Wrong).count();
    assert_eq!((of(&text("60")), of(&text("65"))), (0, 1));
}

#[test]
fn statements_that_blanks_set_apart() {
    let text = |y: &str| format!("{UPRIGHT}   x = 0.633 m\n\n   x = 0.6330   y = {y}   z = 0.0000\n");
    let standings =
        |y: &str| -> Vec<Standing> { read(&text(y), None).claims.iter().map(|c| c.standing()).collect() };
    assert_eq!(standings("0.5964"), [Standing::Equal; 4]);
    let (e, w) = (Standing::Equal, Standing::Wrong);
    assert_eq!(standings("0.6964"), [e, e, w, e]);
}

#[test]
fn the_worst_case_is_another_configuration() {
    let text = |words: &str| {
        format!(
            "{UPRIGHT}$x = 0.633$ m\n\nThe hand exerts the force (Fx, Fy), τ1 = -(a1 s1 + a2 s12) Fx + (a1 c1 + a2 c12) Fy.\n\n{words} x = 0.900 m.\n"
        )
    };
    let wrong = |words: &str| {
        read(&text(words), None).claims.iter().filter(|c| c.standing() == Standing::Wrong).count()
    };
    assert_eq!((wrong("The worst case is the arm stretched out. There"), wrong("There")), (0, 1));
}

#[test]
fn a_determinant_of_the_joints_that_a_function_takes() {
    let text = |sign: &str| {
        format!(
            "# DH (standard)\n#\n# | i | theta | d | a | alpha |\n# |---|---|---|---|---|\n# | 1 | q1 | H | L1 | 0 |\n# | 2 | q2 | 0 | L2 | 180 |\n\
             # | 3 | 0 | q3 | 0 | 0 |\nfrom math import *\n\ndef det_j(q1, q2):\n    return {sign}L1*L2*sin(q2)\n\n\
             def det_jacobian(q1, q2, q3):\n    return L1*L2*cos(q2)\n"
        )
    };
    let wrong = |sign: &str| {
        let found = read(&text(sign), Some(Dialect::Python));
        found.claims.iter().filter(|c| c.standing() == Standing::Wrong).count()
    };
    // That of all three joints has the other sign.
    assert_eq!((wrong(""), wrong("-"), wrong("2*")), (1, 1, 2));
}

#[test]
fn the_determinant_of_a_wrist() {
    let table = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | q1 | 0 | 0 | 90° |\n| 2 | q2 | 0 | a2 | 0 |\n| 3 | q3 | 0 | 0 | 90° |\n\
                 | 4 | q4 | d4 | 0 | -90° |\n| 5 | q5 | 0 | 0 | 90° |\n| 6 | q6 | d6 | 0 | 0 |\n\n";
    // The wrist is at a2 c2 + d4 s23 from the first axis.
    let text = |sign: &str| {
        format!(
            "{table}The block of the wrist has\n\n$$\\det J_{{11}} = {sign}a_2d_4c_3(a_2c_2+d_4s_{{23}})$$\n"
        )
    };
    let standing =
        |sign: &str| read(&text(sign), None).claims.iter().map(|c| c.standing()).collect::<Vec<_>>();
    let found = (standing(""), standing("-"));
    assert!(found.0 == EQUAL && found.1 == WRONG || found.0 == WRONG && found.1 == EQUAL, "{found:?}");
}

const PLANAR: &str = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | L1 | 0 |\n| 2 | θ2 | 0 | L2 | 0 |\n\n";

/// `column 2` and `J(:,2)` are columns of the Jacobian.
#[test]
fn columns_of_the_jacobian_by_words() {
    let text = |left: &str, second: &str| {
        format!(
            "{PLANAR}The Jacobian of (x, y):\n\ncolumn 1 = (-L1 s1 - L2 s12, L1 c1 + L2 c12)\n\n{left} = ({second})\n"
        )
    };
    for left in ["column 2", "J(:,2)"] {
        expect(&text(left, "-L2 s12, L2 c12"), None, &[("J_1", EQUAL), ("J_2", EQUAL)]);
        expect(&text(left, "-L2 s12, L2 s12"), None, &[("J_1", EQUAL), ("J_2", WRONG)]);
    }
}

/// Commas of numbers beside a point in a heading, words of other languages, a letter that joins two values.
#[test]
fn values_in_other_languages() {
    let text = |y: &str| {
        format!(
            "## Exercício 2.6\n\n{}\ncom L1 = 0,4 m e L2 = 0,3 m.\n\nCom θ1 = 30 graus e θ2 = 60 graus:\n\nx = 0,3464 m\n\ny = {y} m\n\n\
             raiz(x² + y²) = 0,6083 m\n",
            PLANAR.replace("(standard)", "(convenção clássica)")
        )
    };
    expect(&text("0,5000"), None, &[("x", EQUAL), ("y", EQUAL)]);
    expect(&text("0,5300"), None, &[("x", EQUAL), ("y", WRONG)]);
}

/// A sentence ends between two statements of one line.
#[test]
fn results_behind_the_sentence_of_their_configuration() {
    let text = |y: &str| {
        format!(
            "{PLANAR}L1 = 220 mm, L2 = 160 mm. At θ2 = 140° the arm is folded.\n\nP1: θ1 = 45°, θ2 = 45°. x = 155.6 mm, y = {y} mm\n"
        )
    };
    expect(&text("315.6"), None, &[("x", EQUAL), ("y", EQUAL)]);
    expect(&text("351.6"), None, &[("x", EQUAL), ("y", WRONG)]);
}
