//! Tables as they stand in documents: what they are read as, and what is said about those that cannot be read.

use denavit::catalogue;
use denavit::description::{
    Convention, Description, Diagnostic, SameChain, TableKind, TableOptions, line_column, prove_same_chain,
    read_table, read_toml, render, write_toml,
};
use denavit_symbolic::Expr;

fn robot(name: &str) -> Description {
    let text = catalogue::text(name).expect("a robot of the catalogue");
    read_toml(text).unwrap_or_else(|e| panic!("{}", render(&e, name, text))).0
}

/// `line:column severity: message | hint` of each finding.
fn shown(text: &str, findings: &[Diagnostic]) -> Vec<String> {
    findings
        .iter()
        .map(|d| {
            let (line, column) = line_column(text, d.span.start);
            let hint = d.hint.as_deref().map_or(String::new(), |h| format!(" | {h}"));
            format!("{line}:{column} {}: {}{hint}", d.severity.name(), d.message)
        })
        .collect()
}

fn told(convention: Convention) -> TableOptions {
    TableOptions { convention: Some(convention), ..TableOptions::default() }
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
    let values: Vec<_> = d.parameters.iter().filter_map(|p| Some((p.symbol, p.value?))).collect();
    for row in &mut d.rows {
        for cell in [&mut row.theta, &mut row.d, &mut row.a, &mut row.alpha] {
            *cell = cell.substitute(|s| values.iter().find(|v| v.0 == s).map(|v| v.1));
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
        &table(include_str!("tables/staubli-rx90.md"), TableKind::Markdown, &khalil),
        "staubli-rx90",
        &[],
    );
    check_table(&table(include_str!("tables/stanford.md"), TableKind::Markdown, &khalil), "stanford", &[]);
    let prrrrp = table(include_str!("tables/prrrrp.md"), TableKind::Markdown, &TableOptions::default());
    check_table(&prrrrp, "prrrrp", &[("dO2O3", Expr::symbol("a2")), ("dO3O4", Expr::symbol("a3"))]);
    let standard = told(Convention::Standard);
    for name in ["cylindrical-wrist", "cylindrical-wrist-b"] {
        let text = match name {
            "cylindrical-wrist" => include_str!("tables/cylindrical-wrist.md"),
            _ => include_str!("tables/cylindrical-wrist-b.md"),
        };
        check_table(&table(text, TableKind::Markdown, &standard), name, &[]);
        let named = TableOptions { columns: Some("theta alpha a d".into()), ..standard.clone() };
        check_table(&table(text, TableKind::Markdown, &named), name, &[]);
    }
    let mm = TableOptions { lengths_in_millimetres: Some(true), ..standard.clone() };
    let ur3 = table(include_str!("tables/ur3-lab.md"), TableKind::Markdown, &mm);
    assert_eq!(prove_same_chain(&ur3, &with_values(&robot("ur3-lab"))), SameChain::Equal);
    let smart5 = table(include_str!("tables/smart5-six-rail.md"), TableKind::Markdown, &standard);
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
    let scan = include_str!("tables/smart5-six-rail-scan.md"); // two cells hold the content of three rows
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
        ("i;theta;d;a;alpha\n1;q1;0;0;0;7\n", vec!["2:12 error: a row of 6 cells under 5 columns"]),
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
                "5:1 error: the text has 2 tables | choose one with --table: 1 (line 1, 1 rows), 2 (line 5, 1 rows)",
            ],
        ),
    ] {
        check_table_findings(text, TableKind::Csv, &standard, &expected);
    }
}

#[test]
fn tables_in_every_dress_are_the_same_robot() {
    let expected = "name = \"table\"\nconvention = \"craig\"\n\n[parameters]\na1 = \"0.45 m\"\n\n[[joints]]\ntheta = \"q1\"\n\
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
    let values: Vec<(String, Option<f64>)> = d
        .parameters
        .iter()
        .map(|p| (p.symbol.name().to_string(), p.value.and_then(|v| v.eval(|_| None).ok())))
        .collect();
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
