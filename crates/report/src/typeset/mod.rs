//! Formulas in LaTeX, as somebody wrote them, as MathML with marks: each letter and sign stays where its author put it.
//!
//! What is not known is not guessed: a formula with an unknown command is not typeset.

mod find;
mod read;
mod write;

pub use find::{Printed, printed};

use std::ops::Range;

/// What is marked in a formula; places are bytes of its source.
#[derive(Clone, Debug, Default)]
pub struct Marks {
    /// Parts of a class, which none of the others overlaps.
    pub classes: Vec<(Range<usize>, &'static str)>,
    /// Parts that should be others: shown as deleted, with what should stand there.
    pub changes: Vec<(Range<usize>, String)>,
}

/// The inside of a `math` element for a formula without its dollar signs; nothing where a command is unknown or a bracket does not
/// close.
pub fn typeset(source: &str, marks: &Marks) -> Option<String> {
    let all = read::formula(source)?;
    write::formula(source, &all, marks)
}

#[cfg(test)]
mod tests {
    use super::{Marks, typeset};

    fn plain(source: &str) -> Option<String> {
        typeset(source, &Marks::default())
    }

    #[test]
    fn formulas_of_courses() {
        for (source, expected) in [
            (
                "x = a_1 C_{12}",
                "<mi>x</mi><mo>=</mo><msub><mi>a</mi><mn>1</mn></msub><msub><mi>C</mi><mn>12</mn></msub>",
            ),
            (
                r"\dot\theta_1^2",
                "<msubsup><mover accent=\"true\"><mi>θ</mi><mo>˙</mo></mover><mn>1</mn><mn>2</mn></msubsup>",
            ),
            (r"\frac{1}{2}", "<mfrac><mn>1</mn><mn>2</mn></mfrac>"),
            (r"\frac12", "<mfrac><mn>1</mn><mn>2</mn></mfrac>"),
            (
                r"\sqrt{1-C_3^2}",
                "<msqrt><mn>1</mn><mo>−</mo><msubsup><mi>C</mi><mn>3</mn><mn>2</mn></msubsup></msqrt>",
            ),
            (r"{}^0T_3", "<msup><mrow></mrow><mn>0</mn></msup><msub><mi>T</mi><mn>3</mn></msub>"),
            (
                r"\theta_3=90^\circ",
                "<msub><mi>θ</mi><mn>3</mn></msub><mo>=</mo><msup><mn>90</mn><mo>∘</mo></msup>",
            ),
            (
                r"\operatorname{atan2}(y,x)",
                "<mi>atan2</mi><mo>(</mo><mi>y</mi><mo>,</mo><mi>x</mi><mo>)</mo>",
            ),
            (r"\sin 2q", "<mi class=\"fn\">sin</mi><mn>2</mn><mi>q</mi>"),
            (r"(-a)-1", "<mo>(</mo><mo form=\"prefix\">−</mo><mi>a</mi><mo>)</mo><mo>−</mo><mn>1</mn>"),
            (r"f'", "<msup><mi>f</mi><mo>′</mo></msup>"),
            ("a < 0{,}5", "<mi>a</mi><mo>&lt;</mo><mn>0</mn><mrow><mo>,</mo></mrow><mn>5</mn>"),
            (
                r"\begin{bmatrix} a & 0 \\ 0 & 1 \end{bmatrix}",
                "<mrow><mo>[</mo><mtable><mtr><mtd><mi>a</mi></mtd><mtd><mn>0</mn></mtd></mtr>\
                 <mtr><mtd><mn>0</mn></mtd><mtd><mn>1</mn></mtd></mtr></mtable><mo>]</mo></mrow>",
            ),
            (
                r"a &= b \\ &= c",
                "<mtable class=\"lines\"><mtr><mtd><mi>a</mi></mtd><mtd><mo form=\"infix\">=</mo><mi>b</mi></mtd></mtr>\
                 <mtr><mtd></mtd><mtd><mo form=\"infix\">=</mo><mi>c</mi></mtd></mtr></mtable>",
            ),
        ] {
            assert_eq!(plain(source).as_deref(), Some(expected), "{source}");
        }
    }

    #[test]
    fn what_is_not_known_is_left() {
        for source in [
            r"\frac{1",
            r"\unheardof{x}",
            "a}",
            r"\begin{bmatrix} a",
            r"\left( a",
            "x_",
            "$",
            r"\begin{tikzpicture}\end{tikzpicture}",
        ] {
            assert_eq!(plain(source), None, "{source}");
        }
        assert_eq!(plain(&"{".repeat(5000)), None);
        assert_eq!(plain(&r"\sqrt".repeat(5000)), None);
    }

    #[test]
    fn marks_stand_where_they_belong() {
        let marked = |source: &str, classes: &[(&str, &'static str)], changes: &[(&str, &str)]| {
            let place = |part: &str| {
                let at = source.find(part).expect("a part");
                at..at + part.len()
            };
            let marks = Marks {
                classes: classes.iter().map(|c| (place(c.0), c.1)).collect(),
                changes: changes.iter().map(|c| (place(c.0), c.1.to_string())).collect(),
            };
            typeset(source, &marks)
        };
        // Inside of an index, of a whole sign, in half a number, and added at a place.
        assert_eq!(
            marked("a C_{1}", &[("C_{1}", "wrong")], &[("1", "12")]).expect("typeset"),
            "<mi>a</mi><mrow class=\"wrong\"><msub><mi>C</mi><mrow><mrow class=\"del\"><mn>1</mn></mrow>\
             <mrow class=\"ins\"><mn>12</mn></mrow></mrow></msub></mrow>"
        );
        assert_eq!(
            marked("a - b", &[], &[("-", "+")]).expect("typeset"),
            "<mi>a</mi><mrow class=\"del\"><mo>−</mo></mrow><mrow class=\"ins\"><mo>+</mo></mrow><mi>b</mi>"
        );
        assert_eq!(
            marked("C_{12}", &[], &[("2", "3")]).expect("typeset"),
            "<msub><mi>C</mi><mrow><mrow class=\"del\"><mn>12</mn></mrow><mrow class=\"ins\"><mn>13</mn></mrow></mrow></msub>"
        );
        let marks = Marks { classes: vec![], changes: vec![(1..1, "b".into())] };
        assert_eq!(typeset("a", &marks).expect("typeset"), "<mi>a</mi><mrow class=\"ins\"><mi>b</mi></mrow>");
        // What should stand there cannot be typeset: neither is the formula.
        assert_eq!(marked("a - b", &[], &[("-", r"\unheardof")]), None);
    }
}
