//! Names of matrices as people print them, taken apart.

use super::*;

fn read(text: &str) -> String {
    let Some(tokens) = tokens(text, &(0..text.len()), &|w| w == "RHS") else { return "-".into() };
    let shown = tokens.iter().map(|t| match t {
        Token::Name(n) => {
            let power =
                format!("{}{}", if n.is_inverse { "'" } else { "" }, if n.is_transposed { "~" } else { "" });
            let arguments =
                if n.arguments.is_empty() { String::new() } else { format!("({})", n.arguments.join(";")) };
            format!("{}{power}{arguments}", n.key())
        }
        Token::Plus => "+".into(),
        Token::Minus => "-".into(),
        Token::Times => "×".into(),
        Token::Dot => "·".into(),
        Token::Open => "(".into(),
        Token::Close { is_inverse, .. } => {
            if *is_inverse {
                ")'".into()
            } else {
                ")".to_string()
            }
        }
        Token::Power { is_inverse, .. } => {
            if *is_inverse {
                "'".into()
            } else {
                "~".to_string()
            }
        }
    });
    shown.collect::<Vec<_>>().join(" ")
}

#[test]
fn names_as_people_print_them() {
    for (text, expected) in [
        ("{}^0T_6", "^0T_6"),
        (r"{}^{0}\mathbf{T}_1", "^0T_1"),
        (r"^{j-1}T_j", "^j-1T_j"),
        ("⁰T₆", "^0T_6"),
        ("0T6", "^0T_6"),
        ("T06", "T_06"),
        ("T_{0,6}", "T_0,6"),
        ("R0_3", "R_0,3"),
        ("H_n^{n-1}", "H_n^n-1"),
        ("A_1A_2A_3", "A_1 A_2 A_3"),
        ("A_6^{-1}", "A_6'"),
        ("RHSA_6^{-1}", "RHS A_6'"),
        ("R_3^{0^{-1}} R_6^0", "R_3^0' R_6^0"),
        ("{R_3^0}^{-1}", "R_3^0'"),
        ("(R_3^0)^T", "( R_3^0 )"),
        (r"Z_{1} \times (\Omega_{3} - \Omega_{1})", "Z_1 × ( Ω_3 - Ω_1 )"),
        (r"\text{Rot}(z,\theta_n) \times \text{Trans}(0,0,d_n)", r"Rot(z;\theta_n) × Trans(0;0;d_n)"),
        (r"{}^0T_1(q_1)\,{}^1T_2(q_2)", "^0T_1(q_1) ^1T_2(q_2)"),
        (r"T_{45}\cdot T_{56}", "T_45 · T_56"),
        (r"{}^{j-1}A_j^{-1}", "^j-1A_j'"),
        (r"{}^0T_1\,{}^1T_2", "^0T_1 ^1T_2"),
        ("^0T_1 ^1T_2 ^2T_3", "^0T_1 ^1T_2 ^2T_3"),
        ("{}^0T_1^1T_2", "^0T_1 ^1T_2"),
        ("H_3^0H_6^3", "H_3^0 H_6^3"),
        ("{}^0T_1^{T}", "^0T_1~"),
        ("T(1,2)", "T(1;2)"),
        (r"\frac{a}{b}", "-"),
        ("a_2 + 3", "-"),
    ] {
        assert_eq!(read(text), expected, "{text}");
    }
}

#[test]
fn indices() {
    assert_eq!(index("j-1"), Some(Index::Letter('j', -1)));
    assert_eq!(index("12"), Some(Index::Number(12)));
    assert_eq!(pair("06"), Some((Index::Number(0), Index::Number(6))));
    assert_eq!(pair("0,12"), Some((Index::Number(0), Index::Number(12))));
    assert_eq!(pair("123"), None);
}
