//! Directives, tables and definitions that nobody should write.

use super::{SOUND, endure, greek};

#[test]
#[ignore = "takes minutes: cargo xtask soak suites"]
fn directives_and_tables() {
    for words in [
        "tool ((((",
        "tool",
        "tool 1,2",
        "tool 1/0, 0, 0",
        "tool 9^999, x^1000, (x+y)^1000",
        "table 99999999999",
        "table 99999999999999999999999999",
        "table",
        "table -1",
        "table 0",
        "rows 0",
        "rows 99999999999",
        "rows",
        "rows 1",
        "alias = ",
        "alias a = a",
        "alias C1 = S1",
        "alias T = n_x",
        "alias n_x = n_x + 1",
        "alias = = =",
        "alias a",
        "let x = y = z",
        "claim",
        "claim T06",
        "claim T99 1,1",
        "claim T06 9,9",
        "claim T06 0,0",
        "claim T06 99999999999999999999,1",
        "claim T999999999999",
        "claim θ",
        "robot",
        "robot nobody",
        "robot ../../etc/passwd",
        "robot ur5",
        "convention",
        "convention nothing",
        "convention craig",
        "euler",
        "euler XXX",
        "euler ZYZ",
        "angles θθθ",
        "off",
        "on",
        "skip",
        "nonsense",
        "",
        "((((((((",
        "\0",
    ] {
        let text = format!(
            "<!-- check: {words} -->\n% check: {words}\n# check: {words}\n\n{SOUND}$$ T = [1, 0; 0, 1] $$\n"
        );
        endure(&format!("check: {words}"), text);
    }
    let row = |n: usize| format!("| {n} | 90° | a_{n} | θ_{n} | d_{n} |\n");
    let head = "| j | alpha | a | theta | d |\n|---|---|---|---|---|\n";
    let rows = |n: usize| head.to_string() + &(1..=n).map(row).collect::<String>() + "\n";
    for n in [0, 1, 8, 12, 29, 31, 499, 1_000] {
        endure(&format!("a table of {n} rows"), format!("{}{SOUND}", rows(n)));
    }
    endure("100 tables", (0..100).map(|i| format!("{}{SOUND}", rows(i % 6 + 1))).collect::<String>());
    endure("300 tables", (0..300).map(|i| format!("{}{SOUND}", rows(i % 6 + 1))).collect::<String>());
    endure("100 long tables", (0..100).map(|_| format!("{}{SOUND}", rows(20))).collect::<String>());
    endure(
        "100 robots",
        (0..2_000).map(|_| "<!-- check: robot ur5 -->\n$$ n_x = C1 $$\n".to_string()).collect::<String>(),
    );
    endure(
        "a wide table",
        format!("|{}\n|{}\n|{}\n", "a|".repeat(5_000), "---|".repeat(5_000), "1|".repeat(5_000)),
    );
    endure("a long cell", format!("{head}| 1 | 90° | {} | θ_1 | 0 |\n\n{SOUND}", "a+".repeat(20_000)));
    endure(
        "cells of powers",
        format!(
            "{head}| 1 | 90° | (a+b+c+e)^999 | θ_1 | 0 |\n| 2 | 0 | (a+b+c+e)^999 | θ_2 | 0 |\n\n{SOUND}"
        ),
    );
    endure(
        "cells of sums",
        format!(
            "{head}{}\n\n{SOUND}",
            (1..9)
                .map(|i| format!("| {i} | α_{i} | a_{i}+b_{i}+c_{i} | θ_{i}+φ_{i} | d_{i}+e_{i} |\n"))
                .collect::<String>()
        ),
    );
    endure(
        "skew axes",
        format!(
            "{head}{}\n\n{SOUND}$$ T_{{0,7}} = [1,2;3,4] $$",
            (1..8).map(|i| format!("| {i} | α_{i} | a_{i} | θ_{i} | d_{i} |\n")).collect::<String>()
        ),
    );
    endure("a long arm", format!("{}$$ T = [1, 2, 3, 4; 5, 6, 7, 8; 9, 10, 11, 12] $$\n", rows(29)));
    endure(
        "a long arm and its Jacobian",
        format!("{}$$ J = [{}] $$\n", rows(29), vec![vec!["C_1"; 29].join(", "); 6].join("; ")),
    );
    endure(
        "a long arm and a joint value",
        format!("{}$$ θ_1 = atan2(p_y, p_x) $$\n$$ θ_2 = arccos(p_x) $$", rows(20)),
    );
    endure(
        "an arm of nine and joint values",
        format!("{}$$ θ_1 = atan2(p_y, p_x) $$\n$$ θ_2 = arccos(p_x) $$", rows(9)),
    );
}

#[test]
#[ignore = "takes minutes: cargo xtask soak suites"]
fn definitions() {
    let end = "$$ n_x = D9 $$\n";
    endure("of themselves", format!("$$ D1 = D1 + 1 $$\n$$ D2 = D3 $$\n$$ D3 = D2 $$\n{end}"));
    endure("of a joint by itself", "$$ θ_1 = θ_1 + 1 $$\n$$ C1 = C1 + 1 $$\n$$ n_x = n_x + 1 $$\n");
    let doubling = |first: &str, step: &dyn Fn(usize) -> String, n: usize| {
        format!("$$ D0 = {first} $$\n")
            + &(1..=n).map(|i| format!("$$ D{i} = {} $$\n", step(i - 1))).collect::<String>()
            + &format!("$$ n_x = D{n} $$\n$$ n_y = D{} $$\n", n / 2)
    };
    for n in [10, 20, 60, 200] {
        endure(&format!("squares {n}"), doubling("C_1 + a_2", &|i| format!("D{i} D{i}"), n));
        endure(
            &format!("squares of sums {n}"),
            doubling("C_1 + a_2", &|i| format!("(D{i} + S_2)(D{i} + C_2)"), n),
        );
        endure(&format!("powers {n}"), doubling("C_1 + a_2", &|i| format!("D{i}^9"), n));
        endure(&format!("sums {n}"), doubling("C_1 + a_2", &|i| format!("D{i} + D{i}"), n));
        endure(&format!("numbers {n}"), doubling("7", &|i| format!("D{i} · D{i}"), n));
        endure(&format!("sines {n}"), doubling("θ_1", &|i| format!("sin(D{i}) + cos(D{i})"), n));
        endure(
            &format!("angles {n}"),
            doubling("θ_1", &|i| format!("D{i} + D{i}"), n).replace("n_x = D", "n_x = cos D"),
        );
        endure(&format!("roots {n}"), doubling("C_1 + 2", &|i| format!("sqrt(D{i} + S_2)"), n));
        endure(&format!("quotients {n}"), doubling("C_1 + 2", &|i| format!("(D{i} + S_2)/(D{i} - S_2)"), n));
        let aliases = |i: usize| format!("<!-- check: alias D{} = D{i}*D{i} -->\n", i + 1);
        endure(
            &format!("aliases {n}"),
            "<!-- check: alias D0 = C1 + d1 -->\n".to_string()
                + &(0..n).map(aliases).collect::<String>()
                + &format!("$$ n_x = D{n} $$"),
        );
        let squared = |i: usize| format!("$$ M_{} = M_{i} M_{i} $$\n", i + 1);
        endure(
            &format!("matrices {n}"),
            "$$ M_0 = T_{03} $$\n".to_string()
                + &(0..n).map(squared).collect::<String>()
                + &format!("$$ T_{{03}} = M_{n} $$"),
        );
        let squared =
            |i: usize| format!("$$ {}_{{q}} = {}_{{q}} {}_{{q}} $$\n", greek(i + 1), greek(i), greek(i));
        endure(
            &format!("named matrices {n}"),
            format!(
                "$$ {}_{{q}} = [C_1, S_2, 0, 1; 1, C_3, d_1, 0; S_4, 1, 0, C_1; 0, 0, 0, 1] $$\n",
                greek(0)
            ) + &(0..n.min(20)).map(squared).collect::<String>()
                + &format!("$$ T_{{03}} = {}_{{q}} $$", greek(n.min(20))),
        );
    }
}
