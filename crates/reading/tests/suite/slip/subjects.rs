//! Arms whose formulas are in print, and what is right of them.

use denavit_reading::slip::{Effort, Lexicon, Repair, Wanted, repairs};
use denavit_symbolic::parse::{Syntax, parse, parse_syntax};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Symbol, equal};

/// Names of an arm with six angles, and its formulas that are right.
pub struct Subject {
    pub names: Vocabulary,
    pub right: Vec<&'static str>,
}

pub fn names(symbols: &[&str], angles: &[u32]) -> Vocabulary {
    let names = angles.iter().fold(Vocabulary::new(), |v, &n| v.angle(n, Symbol::new(&format!("q{n}"))));
    names.symbols(symbols.iter().copied())
}

/// examples/documents/rx90.md, with n_x and n_y mended.
pub fn rx90() -> Subject {
    Subject {
        names: names(&["D3", "RL4"], &[1, 2, 3, 4, 5, 6]).alias("R4", Expr::symbol("RL4")),
        right: vec![
            "C1(C23(C4C5C6 - S4S6) - S23S5C6) - S1(S4C5C6 + C4S6)",
            "S1(C23(C4C5C6 - S4S6) - S23S5C6) + C1(S4C5C6 + C4S6)",
            "S23(C4C5C6 - S4S6) + C23S5C6",
            "C1(-C23(C4C5S6 + S4C6) + S23S5S6) + S1(S4C5S6 - C4C6)",
            "S1(-C23(C4C5S6 + S4C6) + S23S5S6) - C1(S4C5S6 - C4C6)",
            "-S23(C4C5S6 + S4C6) - C23S5S6",
            "-C1(C23C4S5 + S23C5) + S1S4S5",
            "-S1(C23C4S5 + S23C5) - C1S4S5",
            "-S23C4S5 + C23C5",
            "-C1(S23R4 - C2D3)",
            "-S1(S23R4 - C2D3)",
            "C23R4 + S2D3",
        ],
    }
}

/// examples/documents/prrrrp.md, the definitions written out in part.
pub fn prrrrp() -> Subject {
    let names = names(&["a_2", "a_3", "q_1", "q_6", "r_7"], &[2, 3, 4, 5]);
    let define = |v: Vocabulary, name: &str, text: &str| {
        let meaning = parse(text, &v).unwrap();
        v.alias(name, meaning)
    };
    let defined = [
        ("D_1", "c4.c5"),
        ("D_2", "s4.c5"),
        ("D_3", "s4.q_6 + a_3"),
        ("D_4", "-c4.q_6"),
        ("D_5", "c3.D_1 - s3.D_2"),
        ("D_6", "s3.D_1 + c3.D_2"),
        ("D_7", "c3.D_3 - s3.D_4 + a_2"),
        ("D_8", "s3.D_3 + c3.D_4"),
    ];
    Subject {
        names: defined.iter().fold(names, |v, (name, text)| define(v, name, text)),
        right: vec![
            "c4.c5",
            "s4.q_6 + a_3",
            "c3.D_1 - s3.D_2",
            "s3.D_1 + c3.D_2",
            "c3.D_3 - s3.D_4 + a_2",
            "s3.D_3 + c3.D_4",
            "c2.(D_7 + s_{34}.r_7)",
            "s2.(D_7 + s_{34}.r_7)",
            "s2.D_7 + s2.s34.r_7",
            "D_8 + q_1 - c_{34}.r_7",
            "c2.D_5 + s2.s5",
            "s2.D_5 - c2.s5",
            "c2.s_{34}",
        ],
    }
}

/// examples/documents/ur3.md, mended by the report's own table.
pub fn ur3() -> Subject {
    Subject {
        names: names(&["a_2", "a_3", "d_1", "d_2", "d_3", "d_4", "d_5", "d_6"], &[1, 2, 3, 4, 5, 6]),
        right: vec![
            "C_1 C_{234} C_5 C_6 - S_1 S_5 C_6 + C_1 S_{234} S_6",
            "-C_1 C_{234} C_5 S_6 + C_1 S_{234} C_6 + S_1 S_5 S_6",
            "S_1 C_5 + C_1 C_{234} S_5",
            "a_3 C_1 C_{23} + a_2 C_1 C_2 - S_1 d_2 - S_1 d_3 - S_1 d_4 + d_5 C_1 S_{234} + d_6 (S_1 C_5 + C_1 S_5 C_{234})",
            "C_1 S_5 C_6 + S_1 C_{234} C_5 C_6 + S_1 S_{234} S_6",
            "S_1 S_{234} C_6 - C_1 S_5 S_6 - S_1 C_{234} C_5 S_6",
            "-C_1 C_5 + S_1 S_5 C_{234}",
            "C_1 (d_2 + d_3 + d_4) + S_1 (a_2 C_2 + a_3 C_{23} + S_{234} d_5) - d_6 (C_1 C_5 - S_1 S_5 C_{234})",
            "C_{234} S_6 - S_{234} C_5 C_6",
            "S_{234} C_5 S_6 + C_{234} C_6",
            "-S_{234} S_5",
            "-a_2 S_2 - a_3 S_{23} + d_1 + C_{234} d_5 - S_{234} S_5 d_6",
            "C_{234}C_5C_6 + S_{234}S_6",
            "-C_{234}C_5S_6 + S_{234}C_6",
            "C_{234}S_5",
            "a_3C_{23} + a_2C_2 + C_{234}S_5d_6 + S_{234}d_5",
            "-C_{234}S_6 + S_{234}C_5C_6",
            "-C_{234}C_6 - S_{234}C_5S_6",
            "a_3S_{23} + a_2S_2 + S_{234}S_5d_6 - C_{234}d_5",
            "-C_5d_6 + d_2 + d_3 + d_4",
        ],
    }
}

/// The wrist of examples/documents/cylindrical.md, and what LaTeX makes of it.
pub fn wrist() -> Subject {
    Subject {
        names: names(&["a_3", "a_4", "a_5", "a_6", "a_7", "d_3"], &[2, 4, 5, 6]),
        right: vec![
            r"-C\theta_4C\theta_5C\theta_6 - S\theta_4S\theta_6",
            r"C\theta_4C\theta_5S\theta_6 - S\theta_4C\theta_6",
            r"S\theta_5C\theta_6",
            r"-S\theta_5S\theta_6",
            r"C\theta_5a_7 + C\theta_5a_6 + a_5",
            r"(a_3 + a_4 + d_3)C\theta_2",
        ],
    }
}

impl Subject {
    pub fn read(&self, text: &str) -> Syntax {
        parse_syntax(text, &self.names).unwrap_or_else(|e| panic!("{text}: {e:?}"))
    }

    /// What is known where one of the formulas is not.
    pub fn lexicon_without(&self, unknown: &str, wanted: &[Expr]) -> Lexicon {
        let known = || self.right.iter().filter(|t| **t != unknown);
        let right: Vec<Expr> = known().map(|t| self.read(t).value()).chain(wanted.iter().copied()).collect();
        let mut lexicon = Lexicon::new(&[], &right).unwrap();
        for text in known() {
            lexicon.learn(text, &self.read(text));
        }
        lexicon
    }

    pub fn mend(&self, printed: &str, right: &str) -> Vec<Repair> {
        let wanted = self.read(right).value();
        let mut lexicon = self.lexicon_without(right, &[wanted]);
        let syntax = self.read(printed);
        repairs(printed, &syntax, &Wanted::Formula(wanted), &mut lexicon, &self.names, Effort::default())
    }

    #[track_caller]
    pub fn check(&self, printed: &str, right: &str, expect: &str) {
        let found = self.mend(printed, right);
        let first = found.first().unwrap_or_else(|| panic!("{printed}: nothing found"));
        assert_eq!(first.formula, expect, "{found:#?}");
        assert!(equal(parse(&first.formula, &self.names).unwrap(), self.read(right).value()).is_equal());
    }
}
