//! Tables as they stand in documents: what they are read as, and what is said about those that cannot be read.

use crate::common::{robot, shown};
use denavit::description::{
    Convention, Description, JointKind, SameChain, TableKind, TableOptions, prove_same_chain, read_table,
    read_toml, render, write_toml,
};
use denavit_symbolic::Expr;

fn told(convention: Convention) -> TableOptions {
    TableOptions { convention: Some(convention), ..TableOptions::default() }
}

/// A rule of single dashes is one below the heading, and nowhere else.
#[test]
fn rules_of_single_dashes() {
    let rows = "| 1 | 0 | 0 | q1 | 0 |\n| 2 | 90 deg | L1 | q2 | 0 |\n";
    let head = "| j | alpha | a | theta | d |\n";
    let [short, long] = ["|-|-|-|-|-|\n", "|:--|---|---|---|--:|\n"]
        .map(|rule| table(&format!("{head}{rule}{rows}"), TableKind::Markdown, &told(Convention::Craig)));
    assert_eq!(write_toml(&short), write_toml(&long));
}

/// An arm that cannot move is one that somebody forgot the variables of, in a robot file as well as in a table.
#[test]
fn that_nothing_moves_is_said() {
    let text = "convention = \"standard\"\n[[joints]]\ntheta = \"30 deg\"\na = 0.3\n";
    let (d, findings) = read_toml(text).expect("a robot file");
    assert!(d.variables().is_empty());
    assert!(findings.iter().any(|f| f.message.contains("no row holds a joint variable")), "{findings:?}");
}

#[track_caller]
fn table(text: &str, kind: TableKind, options: &TableOptions) -> Description {
    read_table(text, kind, options).unwrap_or_else(|e| panic!("{}", render(&e, "table", text))).0
}

/// The table is the chain of the catalogue's robot without its tool, once its parameters have their names there.
#[track_caller]
fn check_table(found: &Description, name: &str, names: &[(&str, Expr)]) {
    let mut expected = robot(name);
    expected.tool = found.tool;
    let mut found = found.clone();
    for row in &mut found.rows {
        for cell in [&mut row.theta, &mut row.d, &mut row.a, &mut row.alpha] {
            *cell = cell.substitute(|s| names.iter().find(|n| *s.name() == *n.0).map(|n| n.1));
        }
    }
    assert_eq!(prove_same_chain(&found, &expected), SameChain::Equal, "{}", write_toml(&found));
}

/// Names for the values of the catalogue's robot, for a table of numbers.
fn with_values(d: &Description) -> Description {
    let mut d = d.clone();
    let own = d.clone();
    for row in &mut d.rows {
        for cell in [&mut row.theta, &mut row.d, &mut row.a, &mut row.alpha] {
            *cell = cell.substitute(|s| own.exact_value(s));
        }
    }
    d.tool = denavit::geometry::Transform::identity();
    d
}

#[test]
fn the_tables_of_the_documents() {
    // As they stand in the documents, the slips of the scan included.
    let khalil = told(Convention::Khalil);
    check_table(
        &table(include_str!("../tables/staubli-rx90.md"), TableKind::Markdown, &khalil),
        "staubli-rx90",
        &[],
    );
    check_table(&table(include_str!("../tables/stanford.md"), TableKind::Markdown, &khalil), "stanford", &[]);
    let prrrrp = table(include_str!("../tables/prrrrp.md"), TableKind::Markdown, &TableOptions::default());
    check_table(&prrrrp, "prrrrp", &[("dO2O3", Expr::symbol("a2")), ("dO3O4", Expr::symbol("a3"))]);
    let standard = told(Convention::Standard);
    for name in ["cylindrical-wrist", "cylindrical-wrist-b"] {
        let text = match name {
            "cylindrical-wrist" => include_str!("../tables/cylindrical-wrist.md"),
            _ => include_str!("../tables/cylindrical-wrist-b.md"),
        };
        check_table(&table(text, TableKind::Markdown, &standard), name, &[]);
        let named = TableOptions { columns: Some("theta alpha a d".into()), ..standard.clone() };
        check_table(&table(text, TableKind::Markdown, &named), name, &[]);
    }
    let mm = TableOptions { lengths_in_millimetres: Some(true), ..standard.clone() };
    let ur3 = table(include_str!("../tables/ur3-lab.md"), TableKind::Markdown, &mm);
    assert_eq!(prove_same_chain(&ur3, &with_values(&robot("ur3-lab"))), SameChain::Equal);
    let smart5 = table(include_str!("../tables/smart5-six-rail.md"), TableKind::Markdown, &standard);
    assert_eq!(prove_same_chain(&smart5, &with_values(&robot("smart5-six-rail"))), SameChain::Equal);
}

/// All findings of a table begin as expected, in this order.
#[track_caller]
fn check_table_findings(text: &str, kind: TableKind, options: &TableOptions, expected: &[&str]) {
    let found = match read_table(text, kind, options) {
        Ok((_, findings)) => shown(text, &findings),
        Err(findings) => shown(text, &findings),
    };
    let same = found.len() == expected.len() && found.iter().zip(expected).all(|(f, e)| f.starts_with(e));
    assert!(same, "{text}\nfound:\n{}\nexpected:\n{}", found.join("\n"), expected.join("\n"));
}

#[test]
fn a_convention_is_never_guessed() {
    let missing = "error: the convention is not said";
    let none = TableOptions::default();
    for (head, expected) in [
        (
            "i,theta,d,a,alpha",
            format!("1:1 {missing}, and the columns do not tell | add the line `convention: standard`"),
        ),
        ("i,alpha,a,theta,d", format!("1:1 {missing}, and")),
        ("i,theta,alpha,r,d", format!("1:1 {missing}: θ, d, r, α are Khalil's letters, but")),
        ("j,sigma,alpha,d,theta", format!("1:1 {missing}, and")),
    ] {
        let cells = if head.contains("sigma") {
            "1,0,0,0,q1"
        } else if head.contains("i,theta") {
            "1,q1,0,0,0"
        } else {
            "1,0,0,q1,0"
        };
        check_table_findings(&format!("{head}\n{cells}\n"), TableKind::Csv, &none, &[&expected]);
    }
    let convention = |text: &str| table(text, TableKind::Csv, &none).convention;
    assert_eq!(convention("i,alpha_{i-1},a_{i-1},theta,d\n1,0,0,q1,0\n"), Convention::Craig);
    assert_eq!(convention("i,alpha_{i-1},a_{i-1},theta,r\n1,0,0,q1,0\n"), Convention::Khalil);
    assert_eq!(convention("j,gamma,b,alpha,d,theta,r\n1,0,0,0,0,q1,0\n"), Convention::Khalil);
    assert_eq!(convention("# convention: craig\ni,alpha,a,theta,d\n1,0,0,q1,0\n"), Convention::Craig);
    check_table_findings(
        "i,alpha_{i-1},a_{i-1},theta,d\n1,0,0,q1,0\n",
        TableKind::Csv,
        &told(Convention::Standard),
        &["1:1 error: the index i-1 of α or a does not go with the standard convention"],
    );
    check_table_findings(
        "i,theta,d,r,alpha\n1,q1,0,0,0\n",
        TableKind::Csv,
        &told(Convention::Craig),
        &["1:1 error: the lengths of this table do not go with the craig convention | d and r are Khalil's"],
    );
}

#[test]
fn tables_say_what_is_wrong_with_them() {
    let standard = told(Convention::Standard);
    let scan = include_str!("../tables/smart5-six-rail-scan.md"); // two cells hold the content of three rows
    check_table_findings(
        scan,
        TableKind::Markdown,
        &standard,
        &["3:42 error: two values", "7:21 error: two values"],
    );
    for (text, expected) in [
        ("i;theta;d;a;alpha\n1;q1;$a_1$ $a_2$;0;0\n", vec!["2:13 error: two values without a sign"]),
        ("no table at all", vec!["1:1 error: there is no Denavit-Hartenberg table in the text"]),
        ("i;theta;d;a;alpha\n1;q1;0;0;0\n3;q3;0;0;0\n", vec!["3:1 error: row 3 follows row 1"]),
        ("i;theta;d;a;alpha\n1;q1;0;0;0;7\n", vec!["2:12 error: row 1 has 6 cells, the header has 5"]),
        ("i;theta (mm);d;a;alpha\n1;q1;0;0;0\n", vec!["1:3 error: `theta` is an angle"]),
        (
            "i;sigma;theta;d;a;alpha\n1;1;q1;0;0;0\n",
            vec!["2:8 error: row 1 is prismatic, but its d cell holds no joint variable"],
        ),
        (
            "i;theta;d;a;alpha;offset\n1;q1;0;0;0;30 mm\n",
            vec!["2:15 error: `mm` measures a length; this is an angle"],
        ),
        ("i;type;theta;d;a;alpha\n1;X;q1;0;0;0\n", vec!["2:3 error: `x` is no type of joint"]),
        (
            "i;theta;d;a;alpha;q\n1;0;d1;0;0;d2\n",
            vec!["2:12 error: the variable `d2` stands neither in theta nor in d"],
        ),
        ("i;theta;d;a;alpha\n1;q1;0;0;q1\n", vec!["2:10 error: the joint variable `q1` in `alpha`"]),
        ("i;theta;d;a;alpha\n1;q1;q2;0;0\n", vec!["2:6 error: `q2` is not the variable of any row"]),
        (
            "i;theta;d;a;alpha\n1;0;L;0;0\n2;q2;0;0;0\n3;q3+q1;0;0;0\n",
            vec!["4:6 error: `q1` is not the variable of any row"],
        ),
        (
            "i;sigma;theta;d;a;alpha\n1;0;q5;0;0;0\n2;0;q5;0;0;0\n",
            vec!["3:5 error: `q5` is the variable of two rows"],
        ),
        ("i;theta;d;a;alpha\n1;q1;S2;0;0\n", vec!["2:6 error: the parameter `S2` is named like"]),
        ("i;theta;d;a;a\n1;q1;0;0;0\n", vec!["1:13 error: a second column `a`"]),
        ("lengths: miles\ni;theta;d;a;alpha\n1;q1;0;0;0\n", vec!["1:10 error: unknown unit of lengths"]),
        ("i;theta;d;a;alpha;mass\n1;q1;0;0;0;3\n", vec!["1:19 warning: the column `mass` is not read"]),
        (
            "i;theta;d;a;alpha\n1;q1;151,9;0;0\n",
            vec!["2:6 warning: 151.9 m is a long way for a robot | say `d (mm)`"],
        ),
        ("i;theta;d;a;alpha\n1;q1;0;0;1.5708\n", vec!["2:10 warning: 1.5708 is nearly π/2"]),
        (
            "i;theta;d;a;alpha\n1;q1;0;0;0\n\nx\ni;theta;d;a;alpha\n1;q1;1;0;0\n",
            vec![
                "5:1 error: the text has 2 tables | choose one with --table: 1 (line 1, 1 row), 2 (line 5, 1 row)",
            ],
        ),
    ] {
        check_table_findings(text, TableKind::Csv, &standard, &expected);
    }
}

#[test]
fn tables_in_every_dress_are_the_same_robot() {
    let expected = "name = \"RRP arm\"\nconvention = \"craig\"\n\n[parameters]\na1 = \"0.45 m\"\n\n[[joints]]\ntheta = \"q1\"\n\
                    d = \"0.3 m\"\nlimits = [\"-170 deg\", \"170 deg\"]\n\n[[joints]]\nalpha = \"-90 deg\"\na = \"a1\"\n\
                    theta = \"q2 + 90 deg\"\n\n[[joints]]\nalpha = \"90 deg\"\nd = \"q3 + 0.1 m\"\n";
    let craig = told(Convention::Craig);
    for (kind, text) in [
        (
            TableKind::Csv,
            "i,α (deg),a (mm),θ (deg),d (mm),limits\n1,0,0,θ1,300,±170\n2,-90,a1,θ2+90,0,\n3,90,0,0,d3+100,\na1 = 450\n",
        ),
        (
            TableKind::Csv,
            "Link;theta;d;a;alpha;min (deg);max (deg)\n1;q1;0,3;0;0;-170;170\n2;90+q2;;a_1;-90;;\n3;-;0,1+d3;-;90;;\na1 = 450 mm\n",
        ),
        (
            TableKind::Csv,
            "joint\ttheta\td\ta\talpha\toffset\tlimits\n1\tq1\t0.3\t0\t0\t0\t-170 … 170\n\
             2\tq2\t0\ta1\t-90\t90\t\n3\t0\tq3\t0\t90\t0.1\t\na1 = 450 mm\n",
        ),
        (
            TableKind::Markdown,
            "| Joint | $\\alpha_{i-1}$ | $a_{i-1}$ | $\\theta_i$ | $d_i$ | range |\n|---|:-:|--:|---|---|---|\n\
             | 1 | 0 | 0 | $\\theta_1^*$ | 0.3 | [-170°, 170°] |\n| 2 | $-\\frac{\\pi}{2}$ | $a_1$ | $\\theta_2 + 90^\\circ$* | 0 | |\n\
             | 3 | $\\pi/2$ | 0 | 0 | $0.1 + d_3$* | |\n\nwith $a_1 = 0.45$ m.\n\n- a_1 = 45 cm\n",
        ),
        (
            TableKind::Latex,
            "\\documentclass{article}\\begin{document}\\begin{tabular}{|c|c c c c|c|} \\hline % the arm\n\
             $i$ & \\multicolumn{1}{c}{$\\alpha$} & $a$ [mm] & $\\theta$ & $d$ [mm] & limits\\\\ \\hline\\hline\n\
             1 & 0 & 0 & $\\theta_{1}$ & 300 & $\\pm 170^\\circ$ \\\\[2pt]\n\
             2 & $-90^{\\circ}$ & $a_1$ & $\\theta_{2}+\\frac{\\pi}{2}$ & 0 & \\\\ \\cline{1-2}\n\
             3 & $90^{\\circ}$ & 0 & 0 & $d_3 + 100$ & \\\\ \\hline\n\\end{tabular}\na1 = 450 mm\n\\end{document}\n",
        ),
    ] {
        let found = write_toml(&table(text, kind, &craig)).replace("0.1 m + q3", "q3 + 0.1 m");
        assert_eq!(found, expected, "{text}");
    }
}

#[test]
fn parameters_of_a_table_get_values_from_lines() {
    let text = "# My arm\n\nconvention: khalil\n\n| j | σ | α | d | θ | r |\n|---|---|---|---|---|---|\n\
                | 1 | 0 | 0 | 0 | θ₁ | 0 |\n| 2 | 0 | 90° | D3 | θ₂ | L |\n\nD3 = 450 mm, L = 0.3 m\nD3 = x\n";
    let (d, findings) = read_table(text, TableKind::Markdown, &TableOptions::default()).expect("a table");
    assert_eq!(d.name, "My arm");
    let values: Vec<(String, Option<f64>)> =
        d.parameters.iter().map(|p| (p.symbol.name().to_string(), p.number())).collect();
    assert_eq!(values, [("D3".to_string(), Some(0.45)), ("L".to_string(), Some(0.3))]);
    assert_eq!(shown(text, &findings).len(), 1, "{:?}", shown(text, &findings));
    assert!(shown(text, &findings)[0].starts_with("11:6 note: `D3 = x` is not taken for the value of `D3`"));
}

#[test]
fn a_joint_is_found_in_many_ways() {
    for (text, expected) in [
        ("i;theta;d;a;alpha\n1;θ;0;0;0\n2;θ;0;0;0\n", ["q1", "q2"]),
        ("i;theta;d;a;alpha\n1;var;0;0;0\n2;90+var;0;0;0\n", ["q1", "q2 + 90 deg"]),
        ("i;theta;d;a;alpha\n1;*;0;0;0\n2;q1*;0;0;0\n", ["q1", "q2"]),
        ("i;theta;d;a;alpha\n0;θ0;0;0;0\n1;θ1 - θ0;0;0;0\n", ["q1", "q2 - q1"]),
        ("i;sigma;theta;d;a;alpha\n1;0;phi;0;0;0\n2;R;psi+phi;0;0;0\n", ["q1", "q1 + q2"]),
        ("i;theta;d;a;alpha;q\n1;q_a;0;0;0;q_a\n2;x2;0;0;0;x_2\n", ["q1", "q2"]),
        ("link;theta;d;a;alpha\n4;θ_4;0;0;0\n5;θ_5;0;0;0\n", ["q1", "q2"]),
    ] {
        let written = write_toml(&table(text, TableKind::Csv, &told(Convention::Standard)));
        let lines = expected.map(|e| format!("theta = \"{e}\"\n"));
        assert!(lines.iter().all(|l| written.contains(l.as_str())), "{text}{written}");
    }
}

#[test]
fn nothing_is_dropped_in_silence() {
    let standard = told(Convention::Standard);
    let head = "| i | θ | d | a | α |\n|---|---|---|---|---|\n| 1 | θ1 | 0 | 0 | 90° |\n";
    for (rest, expected) in [
        ("| 2 | θ2 |\n| 3 | θ3 | 0 | 0 | 0 |\n", vec!["4:3 error: row 2 has 2 cells, the header has 5"]),
        (
            "| 2 | θ2 | 0 | 0 | 0 | 7 | 8 |\n| 3 |\n",
            vec!["4:24 error: row 2 has 7 cells", "5:3 error: row 3 has 1 cell, the header has 5"],
        ),
        ("\n| 2 | θ2 |\n", vec!["5:3 error: row 2 has 2 cells"]),
        ("\nand the wrist:\n\n| 3 | θ3 | 0 | 0 | 0 |\n", vec!["7:3 error: row 3 follows row 1"]),
        ("2 | θ2 | 0\n", vec!["4:1 error: row 2 has 3 cells"]),
        ("\n| 2 | θ2 | | 0 | |\n", vec!["5:12 note: empty cells are read as 0"]),
        ("\n| joint | limit |\n|---|---|\n| 1 | 90° |\n", vec![]),
        ("\n| 1 | 2 | 3 | 4 | 5 |\n|---|---|---|---|---|\n| a | b | c | d | e |\n", vec![]),
        ("where |x| is the norm\n", vec![]),
    ] {
        check_table_findings(&format!("{head}{rest}"), TableKind::Markdown, &standard, &expected);
    }
    for between in ["", "\n", "The second joint:\n", "\nThe norm |x| is:\n\n"] {
        let text = format!("{head}{between}| 2 | θ2 | 0 | 0 | 0 |\n| 3 | θ3 | 0 | 0 | 0 |\n");
        assert_eq!(table(&text, TableKind::Markdown, &standard).rows.len(), 3, "{text}");
    }
    for (kind, text) in [
        (TableKind::Csv, "i,theta,d,a,alpha\n1,θ1,0,0,0\n2,θ2\n3,θ3,0,0,0\n"),
        (TableKind::Csv, "i;theta;d;a;alpha\n1;θ1;0;0;0\n2;θ2\n3;θ3;0;0;0\n"),
        (TableKind::Csv, "i\ttheta\td\ta\talpha\n1\tθ1\t0\t0\t0\n2\tθ2\n3\tθ3\t0\t0\t0\n"),
        (TableKind::Markdown, "i\ttheta\td\ta\talpha\n1\tθ1\t0\t0\t0\n2\tθ2\n3\tθ3\t0\t0\t0\n"),
        (
            TableKind::Latex,
            "\\begin{tabular}{c}$i$&$\\theta$&$d$&$a$&$\\alpha$\\\\\n1&$\\theta_1$&0&0&0\\\\\n2&$\\theta_2$\\\\\n\\end{tabular}",
        ),
    ] {
        check_table_findings(text, kind, &standard, &["3:1 error: row 2 has 2 cells, the header has 5"]);
    }
    let matrix = "\\begin{tabular}{c}$\\theta$&$d$&$a$&$\\alpha$\\\\\n$\\theta_1$&0&0&0\\\\\n\\end{tabular}\n\
                  $\\begin{array}{cccc}1&0&0&0\\\\0&1&0&0\\\\0&0&1&0\\\\0&0&0&1\\end{array}$\n";
    check_table_findings(matrix, TableKind::Latex, &standard, &[]);
    let text = "θ;d;a;α\nθ1;0;0;0\nθ2;0\n";
    check_table_findings(
        text,
        TableKind::Csv,
        &standard,
        &["3:1 error: row 2 has 2 cells, the header has 4"],
    );
    let text = "i;theta;d;a;alpha\n1;θ1;;0;\n2;θ2;;;\n";
    check_table_findings(text, TableKind::Csv, &standard, &["2:6 note: empty cells are read as 0"]);
}

#[test]
fn stars_mark_what_moves() {
    let standard = told(Convention::Standard);
    let row = |theta: &str, d: &str, i: usize| format!("{i} & ${theta}$ & ${d}$ & 0 & 0 \\\\\n");
    let text = |rows: &[(&str, &str)]| {
        let rows: String = rows.iter().zip(1..).map(|(r, i)| row(r.0, r.1, i)).collect();
        let header = "$i$ & $\\theta_i$ & $d_i$ & $a_i$ & $\\alpha_i$ \\\\\n";
        format!("\\begin{{tabular}}{{c}}\n{header}{rows}\\end{{tabular}}\n")
    };
    let mixed = text(&[
        ("\\theta_1^*", "d_1"),
        ("\\theta_2^{*}", "0"),
        ("\\theta_3^\\ast", "0"),
        ("\\theta_4 - \\frac{\\pi}{2}", "0"),
        ("\\theta_5", "0"),
        ("\\theta_6^* - \\pi", "0"),
        ("\\theta_7", "d_7^*"),
    ]);
    let found = table(&mixed, TableKind::Latex, &standard);
    let written = write_toml(&found);
    assert_eq!(found.variables().len(), 7, "{written}");
    for cell in [
        "theta = \"q1\"\nd = \"d1\"",
        "theta = \"q4 - 90 deg\"",
        "theta = \"q5\"",
        "theta = \"q6 - 180 deg\"",
        "theta = \"theta7\"\nd = \"q7\"",
    ] {
        assert!(written.contains(cell), "{cell}\n{written}");
    }
    for (rows, expected) in [
        ([("\\theta_1^*", "0"), ("0", "d_2")], "4:11 warning: `d2` carries no star: row 2 is fixed"),
        ([("\\theta_1^*", "d_1^*"), ("\\theta_2", "0")], "3:20 error: two cells of row 1 carry a star"),
    ] {
        check_table_findings(&text(&rows), TableKind::Latex, &standard, &[expected]);
    }
    let text = "i;theta;d;a;alpha\n1;θ1*;0;0;0\n2;θ2;0;a2*;0\n";
    check_table_findings(text, TableKind::Csv, &standard, &["3:8 error: a star on a cell that cannot move"]);
}

#[test]
fn every_row_holds_its_own_variable() {
    let standard = told(Convention::Standard);
    for (rows, expected) in [
        (
            "1;θ2;0;0;0\n2;θ1;0;0;0\n",
            vec![
                "2:3 error: row 1 holds θ2, the variable of another row | the variable of row 1 is θ1",
                "3:3 error: row 2 holds θ1, the variable of another row",
            ],
        ),
        ("1;θ1;0;0;0\n2;θ2-θ1;0;0;0\n", vec![]),
        ("1;θ1;0;0;0\n2;-θ1;0;0;0\n", vec!["3:4 note: this row has no joint variable of its own"]),
        (
            "1;θ1;0;0;0\n2;0;d3;0;0\n3;0;0;0;90°\n",
            vec!["3:5 warning: row 2 holds `d3` in d and no variable: it is read as fixed"],
        ),
        (
            "1;30°;0.3;0;0\n2;0;L;0;0\n",
            vec!["1:1 warning: no row holds a joint variable: the table describes a fixed transform"],
        ),
    ] {
        check_table_findings(&format!("i;theta;d;a;alpha\n{rows}"), TableKind::Csv, &standard, &expected);
    }
}

#[test]
fn lines_do_not_contradict_each_other() {
    let rows = "i;theta;d;a;alpha\n1;θ1;D1;0;0\n";
    let standard = "convention: standard\n";
    for (text, expected) in [
        (
            format!("{standard}convention: craig\n{rows}"),
            vec!["2:13 error: `convention: craig` here, but `standard` in line 1 | leave one"],
        ),
        (format!("{standard}{rows}convention: Craig\n"), vec!["4:13 error: `convention: Craig` here"]),
        (format!("{standard}{rows}convention: Standard\n"), vec![]),
        (
            format!("{standard}{rows}D1 = 3\nD1 = 4\n"),
            vec!["5:6 error: a second value for `D1`; line 4 gives another | leave one"],
        ),
        (format!("{standard}{rows}D1 = 0.3\nD1 = 300 mm\n"), vec![]),
        (
            format!("{standard}{rows}D2 = 4 m\n"),
            vec!["4:6 warning: the table has no symbol `D2`: `D2 = 4 m` is not read | did you mean `D1`?"],
        ),
        (
            format!("{standard}{rows}θ1 = 30°\n"),
            vec!["4:6 note: `theta1` is a joint variable: `theta1 = 30°` is not read"],
        ),
        (format!("{standard}{rows}y = x + 3, as is well known\n"), vec![]),
    ] {
        check_table_findings(&text, TableKind::Csv, &TableOptions::default(), &expected);
    }
    let both = format!("{standard}{rows}D1 = 3\n\nsecond\nconvention: craig\n{rows}D1 = 4\n");
    for (number, expected) in [(1, (Convention::Standard, 3.0)), (2, (Convention::Craig, 4.0))] {
        let options = TableOptions { table: Some(number), ..TableOptions::default() };
        let found = table(&both, TableKind::Csv, &options);
        let value = found.parameters[0].number();
        assert_eq!(
            (found.convention, value),
            (expected.0, Some(expected.1)),
            "every table has its own lines"
        );
    }
}

#[test]
fn degrees_are_not_inferred_beside_radians() {
    let rows =
        |theta: &str, alpha: &str| format!("i;theta;d;a;alpha\n1;θ1;0;0;{alpha}\n2;θ2+{theta};0;0;0\n");
    let standard = told(Convention::Standard);
    for alpha in ["1.5707963267948966", "1.571", "0.2618", "3.1416"] {
        let error =
            format!("2:10 error: {alpha} looks like radians, but 30 elsewhere like degrees | `angles: deg`");
        check_table_findings(&rows("30", alpha), TableKind::Csv, &standard, &[&error]);
    }
    let note = "3:6 note: 30 is more than a turn in radians";
    check_table_findings(&rows("30", "3"), TableKind::Csv, &standard, &[note]);
    let said = TableOptions { angles_in_degrees: Some(true), ..standard };
    assert!(read_table(&rows("30", "1.5707963267948966"), TableKind::Csv, &said).is_ok());
}

#[test]
fn told_columns_need_no_known_header() {
    let expected = "theta = \"q1\"\nd = \"0.3 m\"\nalpha = \"90 deg\"\n";
    let rows = "| 1 | θ1 | 0.3 | 0 | 90° |\n| 2 | θ2 | 0 | 0.2 | 0 |\n";
    let standard = told(Convention::Standard);
    let named = TableOptions { columns: Some("theta d a alpha".into()), ..standard.clone() };
    for header in [
        "| i | x | y | z | w |",
        "| i | φ | s | l | ψ |",
        "| i | angle | d | length | twist |",
        "| joint | theta | offset | length | twist |",
        "| i | theta | d | length | twist |",
        "| i | θ | d | a | α |",
    ] {
        for text in [
            format!("{header}\n|---|---|---|---|---|\n{rows}"),
            format!("{header}\n{rows}"),
            format!("{header}\n| | [rad] | [m] | [m] | [rad] |\n{rows}"),
        ] {
            let (found, findings) = read_table(&text, TableKind::Markdown, &named)
                .unwrap_or_else(|e| panic!("{}", render(&e, "table", &text)));
            assert!(write_toml(&found).contains(expected), "{text}{}", write_toml(&found));
            assert_eq!((found.rows.len(), findings.len()), (2, 0), "{text}");
        }
    }
    for text in [
        rows.to_string(),
        rows.replace("| 2 ", "\n| 2 "),
        format!("columns: theta, d, a, alpha\n\n| i | x | y | z | w |\n{rows}"),
        "columns: θ d a α\n\n| x | y | z | w |\n| θ1 | 0.3 | 0 | 90° |\n| θ2 | 0 | 0.2 | 0 |\n".to_string(),
        "| x | y (mm) | z | w |\n| θ1 | 300 | 0 | 90° |\n| θ2 | 0 | 0.2 | 0 |\n".to_string(),
    ] {
        let options = if text.starts_with("col") { &standard } else { &named };
        let found = table(&text, TableKind::Markdown, options);
        assert!(write_toml(&found).contains(expected), "{text}{}", write_toml(&found));
    }
    check_table_findings(
        &format!("columns: theta d a twist\n\n| i | x | y | z | w |\n{rows}"),
        TableKind::Markdown,
        &standard,
        &[
            "1:10 error: `twist` is no column of a table | columns: theta, d, a, alpha (and r, gamma, b in Khalil's \
             letters), from left to right",
        ],
    );
}

#[test]
fn small_courtesies() {
    let standard = told(Convention::Standard);
    let text = "\u{feff}joint;theta;d;a;alpha;mass\n1;θ1;0;0;x°\n";
    let (d, _) = read_table(&text.replace(";x°", ";0;1"), TableKind::Csv, &standard).expect("a table");
    assert_eq!(d.rows.len(), 1);
    check_table_findings(
        &text.replace(";x°", ";0;1").replace("joint", "i"),
        TableKind::Csv,
        &standard,
        &["1:19 warning: the column `mass` is not read"],
    );
    check_table_findings(
        "i;theta;d;a;alpha\n1;q1;151.9;0;0\n2;q2;-86.85;243.65;0\n3;q3;0;0.5;0\n",
        TableKind::Csv,
        &standard,
        &["3:13 warning: 243.65 and 2 more are long ways for a robot in metres | say `d (mm)`"],
    );
}

#[test]
fn without_a_convention_all_else_is_still_told() {
    let missing = "error: the convention is not said";
    for (text, expected) in [
        (
            "i;theta;d;a;alpha\n1;q1;151.9;0;9 mm\n2;q2\nD1 = 2\n",
            vec![
                "1:1 error: the convention is not said",
                "2:6 warning: 151.9 m is a long way",
                "2:16 error: `mm` measures a length",
                "3:1 error: row 2 has 2 cells",
                "4:6 warning: the table has no symbol `D1`",
            ],
        ),
        (
            "convention: denavit\ni;theta;d;a;alpha\n1;q1;0;0;0\n3;q2;0;0;0\n",
            vec!["1:13 error: unknown convention", "4:1 error: row 3 follows row 1"],
        ),
        ("i;theta;d;r;alpha\n1;θ1;0;r1;0\n2;0;d2;0;0\n", vec![]),
    ] {
        let own = format!("1:1 {missing}");
        let expected = if expected.is_empty() { vec![own.as_str()] } else { expected };
        check_table_findings(text, TableKind::Csv, &TableOptions::default(), &expected);
    }
}

#[test]
fn variables_with_values_of_configurations() {
    let standard = told(Convention::Standard);
    let moves = |text: &str| {
        let d = table(text, TableKind::Markdown, &standard);
        d.variables().iter().map(|v| v.kind).collect::<Vec<JointKind>>()
    };
    let (turns, slides) = (JointKind::Revolute, JointKind::Prismatic);
    let head = "| i | θ | d | a | α |\n|---|---|---|---|---|\n";
    // Names that are numbered as the rows are, at one configuration or at several.
    let numbered = format!("{head}| 1 | φ1 | 0 | l1 | 0 |\n| 2 | φ2 | 0 | l2 | 0 |\n\n");
    assert_eq!(moves(&format!("{numbered}For φ1 = 30°, φ2 = 60°:\n")), [turns; 2]);
    assert_eq!(moves(&format!("{numbered}φ1 = 30°, φ2 = 60°\n\nφ1 = 0°, φ2 = 90°\n")), [turns; 2]);
    // Nothing would turn without them; a name that always has one value is a constant beside others.
    let words = format!("{head}| 1 | pan | 0 | 0 | 90° |\n| 2 | tilt | 0 | l2 | 0 |\n\n");
    assert_eq!(moves(&format!("{words}pan = 30°, tilt = 45°\n")), [turns; 2]);
    assert_eq!(moves(&format!("{words}tilt = 45°\n")), [turns]);
    // A slide by a letter of its own among joints with numbers.
    assert_eq!(
        moves(&format!("{head}| 1 | 0 | s | 0 | -90° |\n| 2 | t2 | w | l2 | 0 |\n| 3 | t3 | 0 | l3 | 0 |\n")),
        [slides, turns, turns]
    );
    assert_eq!(
        moves(&format!("{head}| 1 | 0 | l1 | 0 | -90° |\n| 2 | t2 | w | l2 | 0 |\n")),
        [turns],
        "a length is none"
    );
    let angle = "| giunto | a | α | d | angolo |\n|---|---|---|---|---|\n| 1 | 0 | -90° | 0 | φ |\n| 2 | l | 0 | 0 | ψ |\n";
    assert_eq!(moves(angle), [turns; 2]);
    let named = "  Axis      theta  d    a     alpha\n  1 swing   q1     880  240   90 deg\n  2 boom    q2     0    1790  0\n  3 stick arm  q3   0   980   0\n";
    assert_eq!(moves(named), [turns; 3]);
    // A wrist counts on; the values of a sentence are those of a configuration.
    let wrist =
        format!("{head}| 1 | th4 | 0 | 0 | -90° |\n| 2 | th5 | 0 | 0 | 90° |\n| 3 | th6 | d6 | 0 | 0 |\n\n");
    assert_eq!(
        moves(&format!("{wrist}Numbers: th4 = 30°, th5 = 60°, th6 = 90° gives r33 = 0.5.\n")),
        [turns; 3]
    );
    let beam = format!(
        "{head}| 1 | p | 142 | 25 | 90° |\n| 2 | t + 90° | 0 | 18 | 90° |\n| 3 | 0 | s | 0 | 0 |\n\n"
    );
    assert_eq!(
        moves(&format!("{beam}For p = 90°, t = 30°, s = 2 the point is Y = 1.7.\n")),
        [turns, turns, slides]
    );
    // A word for a slide among joints with numbers.
    let boom =
        format!("{head}| 1 | th1 | 0 | 0 | 90° |\n| 2 | th2 | 0 | 0 | 90° |\n| 3 | 0 | ext | 0 | 0 |\n");
    assert_eq!(moves(&boom), [turns, turns, slides]);
    // One letter for all joints.
    let scara = format!(
        "{head}| 1 | t1 | h | a | 0 |\n| 2 | t2 | 0 | b | 180° |\n| 3 | 0 | t3 | 0 | 0 |\n| 4 | t4 | k | 0 | 0 |\n"
    );
    assert_eq!(moves(&scara), [turns, turns, slides, turns]);
}
