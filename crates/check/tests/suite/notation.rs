//! What upper indices, lists of columns and words make of names: components along the axes of frames, the order of a pose's columns,
//! loads, links without mass; and structures and tables of programs.

use crate::common::robot;
use denavit::forward::{ForwardModel, Outputs, Reference};
use denavit::velocity::{Viewpoint, geometric};
use denavit::{Description, Robot};
use denavit_check::{CheckOptions, Checked, Standing, check};
use denavit_reading::code::Dialect;
use denavit_reading::document::Format;
use denavit_symbolic::Expr;
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::readable::simplify;

fn read(text: &str, format: Format, robot: Option<&Description>, language: Option<Dialect>) -> Checked {
    let options = CheckOptions { language, ..CheckOptions::default() };
    check(text, format, robot, &options).unwrap_or_else(|e| panic!("{e:?}\n{text}"))
}

fn all(checked: &Checked, name: &str) -> Vec<Standing> {
    checked.claims.iter().filter(|c| c.name == name).map(|c| c.standing()).collect()
}

/// The torques for a force whose components are along the axes of a frame.
fn torques(d: &Description, frame: usize) -> Vec<Expr> {
    let robot = Robot::symbolic(d);
    let q: Vec<Expr> = d.variables().iter().map(|v| v.symbol.into()).collect();
    let rows = geometric(&robot, &q, &Viewpoint::of(Reference::Tool, Reference::Frame(frame))).rows();
    let rows: Vec<Vec<Expr>> = rows.iter().map(|row| row.to_vec()).collect();
    let force = ["Fx", "Fy", "Fz"].map(Expr::symbol);
    let of = |k: usize| (0..3).fold(Expr::int(0), |sum, r| sum + rows[r][k] * force[r]);
    let short = |e: Expr| simplify(e, &e.symbols()).map_or(e, |s| s.expr);
    (0..q.len()).map(|k| short(of(k))).collect()
}

#[test]
fn loads_along_the_axes_of_any_frame() {
    for name in ["scara", "planar-3r", "gantry-wrist"] {
        let d = robot(name);
        let names = ["Fx", "Fy", "Fz"].iter().fold(d.vocabulary(), |v, f| v.symbol(f));
        for frame in 1..=d.rows.len() {
            let right = torques(&d, frame);
            let sheet = |torques: &[Expr]| {
                let mut text = format!(
                    "The hand pushes with ${{}}^{{{frame}}}F=[F_x, F_y, F_z]^T$. The joint torques for this load are\n"
                );
                for (k, e) in (1..).zip(torques) {
                    text += &format!("\\[\\tau_{k} = {}\\]\n", print(*e, &names, Style::Latex));
                }
                read(&text, Format::Latex, Some(&d), None)
            };
            let found = sheet(&right);
            for k in 1..=right.len() {
                assert_eq!(
                    all(&found, &format!("\\tau_{k}")),
                    [Standing::Equal],
                    "{name}, frame {frame}: {:?}",
                    found.claims
                );
            }
            // One of the wrong sign is not right.
            for k in (0..right.len()).filter(|&k| !right[k].is_zero()) {
                let mut wrong = right.clone();
                wrong[k] = -wrong[k];
                let found = sheet(&wrong);
                assert_ne!(
                    all(&found, &format!("\\tau_{}", k + 1)),
                    [Standing::Equal],
                    "{name}, frame {frame}"
                );
            }
        }
    }
}

#[test]
fn columns_in_the_order_that_the_text_has() {
    for name in ["puma560", "stanford", "staubli-rx90"] {
        let d = robot(name);
        let names = d.vocabulary();
        let pose = ForwardModel::derive(&d, Reference::Base, Reference::Tool, Outputs::ALL).matrix;
        let pose = pose.unwrap_or_else(|_| panic!("{name}"));
        for order in ["noa", "sna", "nsa"] {
            let letters: Vec<String> = order.chars().map(String::from).collect();
            let head =
                letters.iter().map(|l| format!("{{\\boldsymbol {l}}}")).collect::<Vec<_>>().join("\\ ");
            let sheet = |sign: usize| {
                let mut text = format!("With ${{\\boldsymbol R}}=[{head}]$:\n");
                for (c, letter) in letters.iter().enumerate() {
                    for (r, axis) in ["x", "y", "z"].iter().enumerate() {
                        let minus = if 3 * c + r == sign { "-" } else { "" };
                        let e = pose[r][c];
                        let e = simplify(e, &e.symbols()).map_or(e, |s| s.expr);
                        let shown = print(e, &names, Style::Latex);
                        text += &format!("\\[{letter}_{axis} = {minus}\\left({shown}\\right)\\]\n");
                    }
                }
                read(&text, Format::Latex, Some(&d), None)
            };
            let count = |checked: &Checked, s: Standing| {
                checked.claims.iter().filter(|c| c.name.contains('_') && c.standing() == s).count()
            };
            assert_eq!(count(&sheet(9), Standing::Equal), 9, "{name}, {order}");
            let found = sheet(4);
            let counts = [count(&found, Standing::Equal), count(&found, Standing::Wrong)];
            assert_eq!(counts, [8, 1], "{name}, {order}");
        }
    }
}

#[test]
fn upper_indices_of_components_are_frames() {
    let text = |fourth: &str| {
        format!(
            "From ${{\\boldsymbol R}}_6^3={{\\boldsymbol R}}_3^{{0T}}{{\\boldsymbol R}}=[{{\\boldsymbol n}}^3\\ {{\\boldsymbol s}}^3\\ \
             {{\\boldsymbol a}}^3]$, for $\\theta_5$ in $(0,\\pi)$,\n\\begin{{align*}}\n\\theta_4&={fourth}\\\\\n\
             \\theta_5&=\\operatorname{{atan2}}(\\sqrt{{(a_x^3)^2+(a_y^3)^2}},\\,a_z^3)\\\\\n\
             \\theta_6&=\\operatorname{{atan2}}(s_z^3,-n_z^3)\n\\end{{align*}}\n"
        )
    };
    let arm = "Standard DH parameters:\n\\begin{tabular}{ccccc}\nLink & $a_i$ & $\\alpha_i$ & $d_i$ & $\\theta_i$\\\\ \\hline\n\
               1 & 0 & $\\pi/2$ & 0 & $\\theta_1$\\\\\n2 & $a_2$ & 0 & 0 & $\\theta_2$\\\\\n3 & 0 & $\\pi/2$ & 0 & $\\theta_3$\\\\\n\
               4 & 0 & $-\\pi/2$ & $d_4$ & $\\theta_4$\\\\\n5 & 0 & $\\pi/2$ & 0 & $\\theta_5$\\\\\n6 & 0 & 0 & $d_6$ & $\\theta_6$\n\
               \\end{tabular}\n\n";
    let of = |fourth: &str| read(&format!("{arm}{}", text(fourth)), Format::Latex, None, None);
    let is_right = |s: &Standing| matches!(s, Standing::Equal | Standing::Conditional);
    let found = of("\\operatorname{atan2}(a_y^3,a_x^3)");
    for joint in ["\\theta_4", "\\theta_5", "\\theta_6"] {
        let standings = all(&found, joint);
        assert!(standings.len() == 1 && standings.iter().all(is_right), "{joint}: {:?}", found.claims);
    }
    let found = of("\\operatorname{atan2}(a_x^3,a_y^3)");
    assert_eq!(all(&found, "\\theta_4"), [Standing::Wrong], "{:?}", found.claims);
}

const SCARA: &str = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | h | l1 | 0 |\n| 2 | θ2 | 0 | l2 | π |\n\
                     | 3 | θ3 | 0 | 0 | 0 |\n| 4 | 0 | d4 | 0 | 0 |\n\n";

#[test]
fn a_moment_beside_a_force_is_part_of_the_load() {
    let of = |moment: &str, second: &str| {
        let text = format!(
            "{SCARA}The gripper exerts the force $F=(F_x,F_y,F_z)$ and the moment ${moment}$ about the vertical. The joint torques are\n\n\
             $$\\tau_1=-(l_1s_1+l_2s_{{12}})F_x+(l_1c_1+l_2c_{{12}})F_y+{moment}$$\n\n$$\\tau_2={second}$$\n\n$$\\tau_3=-{moment}$$\n"
        );
        let found = read(&text, Format::Markdown, None, None);
        ["\\tau_1", "\\tau_2", "\\tau_3"].map(|n| all(&found, n))
    };
    let (equal, wrong) = (vec![Standing::Equal], vec![Standing::Wrong]);
    let (whole, part) = ("-l_2s_{12}F_x+l_2c_{12}F_y+N_z", "-l_2s_{12}F_x+l_2c_{12}F_y");
    assert_eq!(of("N_z", whole), [equal.clone(), equal.clone(), equal.clone()]);
    assert_eq!(of("N_z", part), [equal.clone(), wrong, equal]);
    // A moment of a name that is not known: nothing is said of the others.
    let found = of("Q_z", part);
    assert_eq!(found[1], [Standing::Undecided]);
}

const PLANAR: &str = "The arm moves in a vertical plane, gravity g along −y. DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n\
                      | 1 | q_1 | 0 | l_1 | 0 |\n| 2 | q_2 | 0 | l_2 | 0 |\n\n";

#[test]
fn lengths_of_the_table_hide_no_centres() {
    let of = |last: &str| {
        let text = format!(
            "{PLANAR}The centre of mass of link i lies at the distance r_i from joint i, I_i is the inertia about it.\n\n\
             $$x_{{C1}}=r_1c_1,\\qquad x_{{C2}}=l_1c_1+r_2c_{{12}}$$\n\n\
             $$J_{{C2}}=\\begin{{bmatrix}} -l_1s_1-r_2s_{{12}} & -r_2s_{{12}}\\\\ l_1c_1+r_2c_{{12}} & r_2c_{{12}}\\end{{bmatrix}}$$\n\n\
             $$M_{{11}}=I_1+I_2+m_1r_1^2+m_2(l_1^2+r_2^2+2l_1r_2c_2)$$\n\n$$M_{{12}}=I_2+m_2(r_2^2+l_1r_2c_2)$$\n\n$$M_{{22}}={last}$$\n"
        );
        let found = read(&text, Format::Markdown, None, None);
        (all(&found, "J_{C2}"), all(&found, "M_{22}"))
    };
    assert_eq!(of("I_2+m_2r_2^2"), (vec![Standing::Equal], vec![Standing::Equal]));
    assert_eq!(of("I_2+m_2l_2^2"), (vec![Standing::Equal], vec![Standing::Wrong]));
}

#[test]
fn the_mass_of_links_without_one_is_that_of_the_hand() {
    let of = |energy: &str, words: &str| {
        let text = format!(
            "{PLANAR}{words}\n\n$$U=Mg(l_1s_1+l_2s_{{12}})$$\n\n$$E={energy}$$\n\n$$G_2=Mgl_2c_{{12}}$$\n\n$$G_1=Mg(l_1c_1+l_2c_{{12}})$$\n"
        );
        let found = read(&text, Format::Markdown, None, None);
        ["U", "E", "G_1", "G_2"].map(|n| all(&found, n))
    };
    let right =
        "\\frac12 M(l_1^2\\dot q_1^2+l_2^2(\\dot q_1+\\dot q_2)^2+2l_1l_2c_2\\dot q_1(\\dot q_1+\\dot q_2))";
    let words =
        "All links are massless; a point mass M is fixed at the tip. Gravity potential U, kinetic energy E.";
    assert_eq!(of(right, words), [(); 4].map(|()| vec![Standing::Equal]));
    let found = of(&right.replace("+2l_1", "-2l_1"), words);
    assert_eq!(found[1], [Standing::Wrong]);
}

#[test]
fn rows_of_a_program_in_which_nothing_moves_turn() {
    let of = |sign: &str| {
        let text = format!(
            "\"\"\"Arm, standard DH parameters.\"\"\"\nimport numpy as np\nfrom numpy import sin, cos, pi\n\nd1, a2, d4 = 0.15, 0.40, 0.12\n\n\
             #  theta d a alpha\nDH = np.array([\n    [0.0, d1, 0.0, pi/2],\n    [0.0, 0.0, a2, 0.0],\n    [0.0, d4, 0.0, 0.0],\n])\n\n\n\
             def fk(q):\n    q1, q2, q3 = q\n    px = a2*cos(q1)*cos(q2) {sign} d4*sin(q1)\n    py = a2*sin(q1)*cos(q2) - d4*cos(q1)\n    \
             pz = d1 + a2*sin(q2)\n    return np.array([px, py, pz])\n"
        );
        let found = read(&text, Format::Markdown, None, Some(Dialect::Python));
        ["px", "py", "pz"].map(|n| all(&found, n))
    };
    let equal = || vec![Standing::Equal];
    assert_eq!(of("+"), [equal(), equal(), equal()]);
    assert_eq!(of("-"), [vec![Standing::Wrong], equal(), equal()]);
}

#[test]
fn a_mass_at_the_end_of_each_link_is_no_load() {
    let of = |words: &str, first: &str| {
        let text = format!(
            "{PLANAR}{words} Gravity acts along -y.\n\n$$M_{{11}} = {first} + m l_2^2 + 2 m l_1 l_2 c_2$$\n\n\
             $$M_{{12}} = m l_2^2 + m l_1 l_2 c_2$$\n\n$$M_{{22}} = m l_2^2$$\n"
        );
        all(&read(&text, Format::Markdown, None, None), "M_{11}")
    };
    for words in [
        "Each link is a massless rod with a point mass $m$ at its end.",
        "Both links are massless, with masses $m$ at their ends.",
        "All links have equal mass $m$ at their ends; there is no mass below the base.",
    ] {
        assert_eq!(of(words, "2 m l_1^2"), [Standing::Equal], "{words}");
    }
}

#[test]
fn a_fraction_in_numbers_is_no_number() {
    let text = format!(
        "{PLANAR}All mass of a link is at its far end, $m_1$ = 1 kg at the distance $l_1$, $m_2$ = 1 kg at the distance $l_2$, with \
         $l_1$ = 0.5 m and $l_2$ = 0.5 m. Gravity acts along -y.\n\n$$M_{{11}} = (m_1 + m_2) l_1^2 + m_2 l_2^2 + 2 m_2 l_1 l_2 c_2$$\n\n\
         $$M_{{12}} = m_2 l_2^2 + m_2 l_1 l_2 c_2$$\n\n$$M_{{22}} = m_2 l_2^2$$\n\n\
         At $q_1 = 0$ and $q_2 = 0$ we have $M_{{11}} = 5/4$ and $M_{{22}} = 0.25$.\n"
    );
    let found = read(&text, Format::Markdown, None, None);
    assert!(found.claims.iter().all(|c| c.standing() != Standing::Wrong), "{:?}", all(&found, "M_{11}"));
}

#[test]
fn fields_are_not_what_a_function_calls_so_itself() {
    let text = "struct Arm { double d1, a2, a3; };\nvoid fk(const Arm *p, double q1, double q2, double q3, double pos[3]) {\n\
        double a2 = p->a2 * cos(q2);\ndouble a3 = p->a3 * cos(q2 + q3);\npos[0] = cos(q1) * (a2 + a3);\npos[1] = sin(q1) * (a2 + a3);\n\
        pos[2] = p->d1 + p->a2 * sin(q2) + p->a3 * sin(q2 + q3);\n}\n\
        double both(const Arm *left, const Arm *right, double q1, double q2, double q3) {\n\
        double x = cos(q1) * (left->a2 * cos(q2) + right->a3 * cos(q2 + q3));\nreturn x;\n}\n";
    let found = read(text, Format::Markdown, Some(&robot("articulated-3r")), Some(Dialect::C));
    for claim in &found.claims {
        assert_ne!(claim.standing(), Standing::Wrong, "{}", claim.name);
    }
    assert!(!all(&found, "x").contains(&Standing::Equal));
}

#[test]
fn structures_and_matrices_of_cpp() {
    let of = |entry: &str| {
        let text = format!(
            "// standard DH parameters (degrees):\n//\n//   joint | theta | d  | a  | alpha\n//   ------+-------+----+----+------\n\
             //     1   |  t1   | d1 | 0  |  -90\n//     2   |  t2   | 0  | a2 |    0\n//\n#include <cmath>\n#include <array>\n\n\
             struct Arm {{ double d1, a2; }};\nusing Mat = std::array<std::array<double, 2>, 3>;\n\n\
             std::array<double, 3> place(const Arm& arm, double t1, double t2) {{\n    const double d1 = arm.d1;\n    \
             double x = arm.a2 * std::cos(t1) * std::cos(t2);\n    double y = arm.a2 * std::sin(t1) * std::cos(t2);\n    \
             double z = d1 - arm.a2 * std::sin(t2);\n    return {{x, y, z}};\n}}\n\n\
             Mat jacobian(const Arm& arm, double t1, double t2) {{\n    const double r = arm.a2 * std::cos(t2);\n    Mat J;\n    \
             J[0][0] = -r * std::sin(t1);\n    J[0][1] = {entry};\n    J[1][0] = r * std::cos(t1);\n    \
             J[1][1] = -arm.a2 * std::sin(t1) * std::sin(t2);\n    J[2][0] = 0.0;\n    J[2][1] = -r;\n    return J;\n}}\n"
        );
        let found = read(&text, Format::Markdown, None, Some(Dialect::C));
        ["x", "y", "z", "J[0][0]", "J[0][1]", "J[1][0]", "J[1][1]", "J[2][1]"].map(|n| all(&found, n))
    };
    let right = of("-arm.a2 * std::cos(t1) * std::sin(t2)");
    assert!(right.iter().all(|s| *s == [Standing::Equal]), "{right:?}");
    let wrong = of("arm.a2 * std::cos(t1) * std::sin(t2)");
    assert_eq!(wrong[4], [Standing::Wrong], "{wrong:?}");
    assert!((0..8).filter(|k| *k != 4).all(|k| wrong[k] == [Standing::Equal]), "{wrong:?}");
}

#[test]
fn arguments_of_jacobians_are_all_joints() {
    let of = |argument: &str, sign: &str| {
        let text = format!(
            "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | a1 | 0 |\n| 2 | θ2 | 0 | a2 | 0 |\n\n\
             $$J({argument})=\\begin{{bmatrix}}-a_1s_1-a_2s_{{12}}&-a_2s_{{12}}\\\\a_1c_1+a_2c_{{12}}&a_2c_{{12}}\\end{{bmatrix}}$$\n\n\
             $$\\det J({argument})={sign}a_1a_2s_2$$\n"
        );
        let found = read(&text, Format::Markdown, None, None);
        found.claims.iter().map(|c| c.standing()).collect::<Vec<Standing>>()
    };
    for argument in ["\\Theta", "\\theta", "\\vartheta", "q", "\\mathbf q", "\\bm{\\theta}"] {
        assert_eq!(of(argument, ""), [Standing::Equal, Standing::Equal], "{argument}");
        assert_eq!(of(argument, "-"), [Standing::Equal, Standing::Wrong], "{argument}");
    }
}

#[test]
fn vectors_below_one_another_are_each_their_own() {
    let text = "DH (standard)\n\n| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | a1 | 0 |\n| 2 | θ2 | 0 | a2 | 0 |\n\n\
                p1 = [a1*cos(t1), a1*sin(t1), 0]\np2 = [a1*cos(t1) + a2*cos(t1+t2), a1*sin(t1) - a2*sin(t1+t2), 0]\n\n\
                R = [ cos(t1+t2)  -sin(t1+t2)  0 ]\n    [ sin(t1+t2)   cos(t1+t2)  0 ]\n    [ 0            0           1 ]\n";
    let found = read(text, Format::Plain, None, None);
    assert_eq!(all(&found, "p1"), [Standing::Equal], "{:?}", found.claims);
    assert_eq!(all(&found, "p2"), [Standing::Wrong], "{:?}", found.claims);
    assert_eq!(all(&found, "R"), [Standing::Equal], "{:?}", found.claims);
}

#[test]
fn entries_in_numbers_at_a_configuration() {
    let of = |numbers: &str, words: &str| {
        let text = format!(
            "{PLANAR}The centre of mass of link i lies at the distance r_i from joint i, I_i is the inertia about it.\n\n\
             $$M_{{11}}=I_1+I_2+m_1r_1^2+m_2(l_1^2+r_2^2+2l_1r_2c_2)$$\n\n$$M_{{12}}=I_2+m_2(r_2^2+l_1r_2c_2)$$\n\n\
             $$M_{{22}}=I_2+m_2r_2^2$$\n\n$$G_1=(m_1r_1+m_2l_1)gc_1+m_2r_2gc_{{12}}$$\n\n\
             **Numbers.** $l_1=l_2=0.5$, $r_1=r_2=0.25$ (m), $m_1=4$, $m_2=2$ (kg), $I_1=0.08$, $I_2=0.04$ (kg m²), $g=9.81$, at \
             $q_1=0°$, $q_2=90°$:\n\n{words}$${numbers}$$\n"
        );
        let found = read(&text, Format::Markdown, None, None);
        ["M_{11}", "M_{12}", "G_1"].map(|n| all(&found, n).last().copied())
    };
    let equal = Some(Standing::Equal);
    assert_eq!(of("M_{11}=0.995,\\qquad M_{12}=0.165,\\qquad G_1=19.62", ""), [equal; 3]);
    let found = of("M_{11}=0.995,\\qquad M_{12}=0.175,\\qquad G_1=24.525", "");
    assert_eq!(found, [equal, Some(Standing::Wrong), Some(Standing::Wrong)]);
    // With words between they may be those of another configuration.
    let found = of("M_{11}=0.995,\\qquad M_{12}=0.175", "With the elbow stretched again we have\n\n");
    assert_eq!(found[1], Some(Standing::Undecided));
}

#[test]
fn sums_of_joints_are_found_before_their_parts() {
    let text = include_str!("../labelled/kestrel_ik.py");
    let of = |text: &str| {
        let found = read(text, Format::Markdown, None, Some(Dialect::Python));
        ["c234", "q3", "q2"].map(|n| all(&found, n))
    };
    assert!(of(text).iter().all(|all| !all.is_empty() && all.iter().all(|s| *s == Standing::Equal)));
    // What rests on a wrong one is not at fault.
    let found = of(&text.replace("c234 = s6*r31 + c6*r32", "c234 = s6*r31 - c6*r32"));
    assert_eq!(found[0], [Standing::Wrong]);
    assert!(!found[1..].iter().flatten().any(|s| *s == Standing::Wrong), "{found:?}");
}
