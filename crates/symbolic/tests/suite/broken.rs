//! Formulas in lines.

use denavit_symbolic::Expr;
use denavit_symbolic::print::{Style, broken};
use denavit_symbolic::vocabulary::Vocabulary;

fn sum(of: &[&str]) -> Expr {
    let terms = of.iter().map(|name| Expr::symbol(name));
    terms.reduce(|a, b| a + b).unwrap_or(Expr::int(0))
}

#[test]
fn lines_end_before_signs_and_nothing_is_lost() {
    let names: Vec<String> = (0..40).map(|k| format!("a{k}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let inner = sum(&names[..20]);
    let e = Expr::symbol("x") * inner + sum(&names[20..]) - Expr::symbol("y") * (inner / sum(&names)).sqrt();
    let v = Vocabulary::new();
    let product = inner * (sum(&names[20..]) - sum(&names[..5]));
    let breaks =
        [Style::Latex, Style::Typst, Style::MathMl].map(|s| broken(product, &v, s, 20.0, 20.0).len());
    assert!(breaks[0] > 3 && breaks == [breaks[0]; 3], "{breaks:?}");
    for style in [Style::Latex, Style::Typst, Style::MathMl] {
        let lines = broken(e, &v, style, 20.0, 20.0);
        assert!(lines.len() > 3, "{lines:?}");
        let whole: String = broken(e, &v, style, 1e9, 1e9).into_iter().map(|l| l.text).collect();
        let joined: String = lines.iter().map(|l| l.text.as_str()).collect();
        let plain = |t: &str| -> String {
            let mut t = t.to_string();
            let forms = [
                "<mo stretchy=\"false\">",
                "<mo form=\"infix\">",
                "<mrow>",
                "</mrow>",
                "\\left",
                "\\right",
                "\\bigl",
                "\\bigr",
            ];
            for form in forms {
                t = t.replace(form, if form.starts_with("<mo ") { "<mo>" } else { "" });
            }
            t.replace("\\(", "(").replace("\\)", ")")
        };
        assert_eq!(plain(&joined), plain(&whole));
        assert!(lines.iter().any(|l| l.depth == 1), "{lines:?}");
        for line in lines.iter().filter(|_| style == Style::MathMl) {
            assert_eq!(line.text.matches("<mrow>").count(), line.text.matches("</mrow>").count());
        }
        for line in lines.iter().filter(|_| style == Style::Latex) {
            assert_eq!(line.text.matches("\\left").count(), line.text.matches("\\right").count());
            assert_eq!(line.text.matches('{').count(), line.text.matches('}').count());
        }
    }
}
