//! Hostile documents: whatever stands in them, the checker answers in bounded time, says where something is the
//! matter, and does not panic.

mod tables;

use crate::common::{Random, robot, share};
use denavit::description::Severity;
use denavit_check::{CheckOptions, Checked, Note, check};
use denavit_reading::document::Format;
use std::sync::Arc;
use std::time::{Duration, Instant};

const FORMATS: [Format; 4] = [Format::Markdown, Format::Latex, Format::Plain, Format::Toml];
/// A hang takes longer than this, whatever else the machine does.
const PATIENCE: f64 = 90.0;

/// Seconds that this thread has worked, or else that have gone by.
fn clock() -> f64 {
    thread_local! {
        static START: Instant = Instant::now();
    }
    let spent = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let spent = spent.and_then(|s| s.split(' ').next()?.parse::<f64>().ok());
    spent.map_or_else(|| START.with(|s| s.elapsed().as_secs_f64()), |ns| 1e-9 * ns)
}

fn patience() -> f64 {
    std::env::var("PATIENCE").ok().and_then(|p| p.parse().ok()).unwrap_or(PATIENCE)
}

const TABLE: &str = "convention: standard\n\n| j | alpha | a | theta | d |\n|---|---|---|---|---|\n| 1 | 90° | 0 | θ_1 | d_1 |\n\
                     | 2 | 0 | a_2 | θ_2 | 0 |\n| 3 | 0 | a_3 | θ_3 | 0 |\n\n";
const SOUND: &str = "$$ n_x = C_1 C_{23} $$\n\n$$ p_z = d_1 + a_2 S_2 + a_3 S_{23} $$\n\n";

/// The work in a thread of its own, with the stack of a main thread: formulas live as long as it does. Nothing if it
/// does not end.
fn apart<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> Option<T> {
    let (sender, receiver) = std::sync::mpsc::channel();
    let thread = std::thread::Builder::new().stack_size(8 << 20);
    let thread = thread.spawn(move || sender.send(work()).is_ok()).expect("a thread");
    match receiver.recv_timeout(Duration::from_secs_f64(patience())) {
        Err(std::sync::mpsc::RecvTimeoutError::Timeout) => None,
        Ok(done) => Some(done),
        Err(_) => match thread.join() {
            Err(panic) => std::panic::resume_unwind(panic),
            Ok(_) => None,
        },
    }
}

/// What is said of a document. All places lie in it.
fn judged(text: &str, format: Format, named: Option<&str>) -> Result<Checked, Vec<Note>> {
    let named = named.map(robot);
    let result = check(text, format, named.as_ref(), &CheckOptions::default());
    let inside = |span: &std::ops::Range<usize>| {
        assert!(text.get(span.clone()).is_some(), "{span:?} is no place in {} bytes", text.len());
    };
    let diagnostics = match &result {
        Ok(checked) => {
            for claim in &checked.claims {
                inside(&claim.span);
                claim.entries.iter().for_each(|e| inside(&e.span));
            }
            &checked.notes
        }
        Err(errors) => {
            assert!(errors.iter().any(|e| e.severity == Severity::Error));
            errors
        }
    };
    diagnostics.iter().for_each(|d| inside(&d.span));
    result
}

/// Reads a document in every format, with a robot and with its own table, and prints how long that took at most.
fn endure(what: &str, text: impl Into<String>) {
    if std::env::var("HOSTILE").is_ok_and(|only| !what.contains(&only)) {
        return;
    }
    let given: Arc<str> = text.into().into();
    let own: Arc<str> = format!("{TABLE}{SOUND}{given}\n\n{SOUND}").into();
    let mut all: Vec<(f64, String)> = vec![];
    // A usual run reads Markdown; a soak reads all.
    for format in FORMATS.into_iter().take(share(FORMATS.len(), 1)) {
        for (text, named) in [(&given, Some("ur5")), (&own, None)] {
            let text = Arc::clone(text);
            let said = apart(move || {
                let before = clock();
                let result = judged(&text, format, named);
                let took = clock() - before;
                let said = match &result {
                    Ok(checked) => {
                        let t = checked.tally();
                        let note = checked.notes.first().map_or(String::new(), |n| format!("{:?}", n.what));
                        let [a, b, c, d, e] = [t.equal, t.wrong, t.conditional, t.undecided, t.unreadable];
                        format!("{a} right, {b} wrong, {c} in part, {d} open, {e} unread; {note}")
                    }
                    Err(errors) => errors.first().map_or(String::new(), |e| format!("{:?}", e.what)),
                };
                (took, said)
            });
            let place = format!("{format:?}{}", if named.is_some() { "" } else { " with a table" });
            match said {
                Some((took, said)) => {
                    all.push((took, format!("{place}: {}", said.chars().take(160).collect::<String>())));
                }
                None if std::env::var_os("HOSTILE_GOES_ON").is_some() => {
                    all.push((PATIENCE, format!("{place}: HANGS")))
                }
                None => panic!("{what}, {place}: more than {PATIENCE} s"),
            }
        }
    }
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    println!("{:7.2} s {what}: {}", all[0].0, all[0].1);
    for (took, said) in all.iter().skip(1).filter(|a| a.0 > 2.0) {
        println!("  {took:7.2} s {said}");
    }
}

fn display(formula: &str) -> String {
    format!("$$ n_x = {formula} $$")
}

#[test]
fn deep_nesting() {
    let n = share(100_000, 40_000);
    for (open, inner, close) in [
        ("(", "C1", ")"),
        ("[", "C1", "]"),
        ("{", "C1", "}"),
        ("\\left(", "C1", "\\right)"),
        ("\\frac{", "1", "}{2}"),
        ("\\sqrt{", "1", "}"),
        ("\\begin{bmatrix}", "1", "\\end{bmatrix}"),
        ("\\begin{cases}", "1", "\\end{cases}"),
        ("\\begin{align}", "n_x = 1", "\\end{align}"),
        ("\\underbrace{", "1", "}_{T_1}"),
        ("\\mathbf{", "T", "}"),
        ("\\text{", "x", "}"),
        ("cos(", "1", ")"),
        ("-", "1", ""),
        ("(-", "1", ")"),
        ("1/", "1", ""),
        ("2^", "2", ""),
        ("x_{", "1", "}"),
        ("x^{", "1", "}"),
        ("|", "1", "|"),
        ("√", "4", ""),
    ] {
        let (many, ends) = (open.repeat(n), close.repeat(n));
        endure(&format!("{open} nested"), display(&format!("{many}{inner}{ends}")));
        endure(&format!("{open} opened"), display(&format!("{many}{inner}")));
        endure(&format!("{open} closed"), display(&format!("{inner}{ends}")));
        endure(&format!("T = {open} nested"), format!("$$ T_{{03}} = {many}{inner}{ends} $$"));
    }
    endure("$ alone", "$".repeat(n));
    endure("` alone", "`".repeat(n));
    endure("<!-- alone", "<!-- ".repeat(n));
    endure("```", "```\n".repeat(n));
    endure("backslashes", "\\".repeat(n));
    endure("backslashes and blanks", "\\ ".repeat(n));
}

#[test]
#[ignore = "takes minutes: cargo xtask soak suites"]
fn long_lines() {
    let n = 4 << 20;
    for (what, piece) in [
        ("letters", "a"),
        ("words", "word "),
        ("digits", "1"),
        ("sums", "C1 + "),
        ("products", "C1"),
        ("products of matrices", "T_{03}"),
        ("equals", "n_x = "),
        ("=", "="),
        ("dollars", "$n_x$ "),
        ("dots", "."),
        ("commas", ","),
        ("ampersands", "&"),
        ("quotes", "\""),
        ("subscripts", "_"),
        ("powers", "^"),
        ("hashes", "#"),
        ("bars", "|"),
        ("dashes", "-"),
        ("greek", "θ"),
        ("code", "`C1 = 1` "),
        ("items", "- "),
        ("tilde", "~"),
        ("directives", "<!-- check: claim T06 --> "),
    ] {
        endure(&format!("a line of {what}"), piece.repeat(n / piece.len()));
        endure(&format!("a formula of {what}"), display(&piece.repeat(n / 8 / piece.len())));
        endure(&format!("a short formula of {what}"), display(&piece.repeat(50_000 / piece.len())));
    }
    endure("beyond the limit", "a".repeat(9_000_000));
}

#[test]
#[ignore = "takes minutes: cargo xtask soak suites"]
fn many_statements() {
    let n = 100_000;
    endure("100,000 equations", "$$ n_x = 1 $$\n".repeat(n));
    endure("100,000 lines", "n_x = 1\n".repeat(n));
    endure("100,000 right entries", "n_z = S_{234} C_5 C_6 + C_{234} S_6\n".repeat(n));
    endure("100,000 nearly right entries", "n_z = S_{234} C_5 C_6 - C_{234} S_6\n".repeat(n));
    endure("100,000 definitions", (0..n).map(|i| format!("D_{i} = C1 + {i}\n")).collect::<String>());
    endure("100,000 matrices", "$$ T_{01} = [1, 2; 3, 4] $$\n".repeat(n / 4));
    endure("100,000 directives", "<!-- check: claim T03 1,1 -->\n".repeat(n));
    endure("20,000 joint values", "$$ \\theta_1 = atan2(p_y, p_x) $$\n".repeat(20_000));
    endure(
        "300 different joint values",
        (0..300).map(|i| format!("$$ \\theta_1 = atan2(p_y + {i}, p_x) $$\n")).collect::<String>(),
    );
    endure("angles", "$$ RPY: \\phi = atan2(r_{21}, r_{11}) $$\n".repeat(10_000));
    endure("claims on a line", "$$ n_x = C1 = C2 = C3 = C4 = C5 $$ ".repeat(5_000));
    endure("one chain", display(&"C1 = ".repeat(20_000)));
}

#[test]
#[ignore = "takes minutes: cargo xtask soak suites"]
fn large_matrices() {
    let rows = |n: usize, m: usize, cell: &str| {
        let row = vec![cell; m].join(" & ");
        vec![row; n].join(" \\\\\n")
    };
    let grid =
        |n: usize, m: usize, cell: &str| format!("\\begin{{bmatrix}} {} \\end{{bmatrix}}", rows(n, m, cell));
    let t = |body: &str| format!("$$ T_{{03}} = {body} $$");
    endure("2000 by 2000", t(&grid(2_000, 1_500, "1")));
    endure("300 by 300 formulas", t(&grid(300, 300, "C_1 S_2")));
    endure("4 by 100,000", t(&grid(4, 100_000, "C1")));
    endure("100,000 by 4", t(&grid(100_000, 4, "C1")));
    endure("a determinant", t(&format!("\\begin{{vmatrix}} {} \\end{{vmatrix}}", rows(200, 200, "C1"))));
    endure(
        "determinants of six",
        t(&format!("\\begin{{vmatrix}} {} \\end{{vmatrix}}", rows(6, 6, "C_1 S_2 + a_3"))),
    );
    endure("a list", format!("T = [{}]", vec!["[1, 2, 3, 4]"; 100_000].join(", ")));
    endure("5,000 factors", t(&"T_{01} ".repeat(5_000)));
    endure("200 factors", t(&"T_{01} ".repeat(199)));
    endure("200 factors with sums", t(&"(T_{01} + T_{12}) ".repeat(30)));
    endure("factors one to six", t(&"T_{06} ".repeat(6)));
    endure("inverses", t(&"T_{06}^{-1} ".repeat(100)));
    endure("5,000 grids", t(&grid(4, 4, "C1 + 1").repeat(5_000)));
    endure("100 grids", t(&grid(4, 4, "C_1 + S_2").repeat(100)));
    endure("12 grids", t(&grid(4, 4, "C_1 + S_2 a_3").repeat(12)));
    endure("6 grids", t(&grid(4, 4, "C_1 + S_2 a_3").repeat(6)));
    endure("wrong matrices", (0..1000).map(|_| t(&grid(4, 4, "C_1 + S_2 a_3"))).collect::<String>());
    endure("a Jacobian", format!("$$ J = {} $$", grid(6, 6, "C_1 S_2 d_4")));
    endure("many Jacobians", format!("$$ J = {} $$\n", grid(6, 6, "C_1 S_2 d_4")).repeat(100));
}

#[test]
#[ignore = "takes minutes: cargo xtask soak suites"]
fn long_formulas() {
    let terms = |n: usize, term: &dyn Fn(usize) -> String| (0..n).map(term).collect::<Vec<_>>().join(" + ");
    for n in [500, 1_900, 5_000] {
        endure(&format!("{n} equal terms"), display(&terms(n, &|_| "C1".into())));
        endure(&format!("{n} terms"), display(&terms(n, &|i| format!("{i} C{} S{}", i % 6 + 1, i % 5 + 1))));
        let product =
            |i: usize| (0..8).map(|k| format!("{}_{} ", ["C", "S"][(i >> k) & 1], k % 6 + 1)).collect();
        endure(&format!("{n} long terms"), display(&terms(n, &product)));
        endure(&format!("{n} roots"), display(&terms(n, &|i| format!("sqrt(C1 + {i})"))));
        endure(&format!("{n} fractions"), display(&terms(n, &|i| format!("\\frac{{C1}}{{S2 + {i}}}"))));
        endure(&format!("{n} angles"), display(&terms(n, &|i| format!("\\cos({i} θ_1 + {} θ_2)", i % 7))));
        endure(&format!("{n} degrees"), display(&terms(n, &|i| format!("\\cos({i}° + θ_1)"))));
        let zeros = terms(n, &|i| format!("C{} - C{}", i % 6 + 1, i % 6 + 1));
        endure(&format!("{n} pairs that cancel"), display(&format!("{zeros} + C_1 C_2")));
    }
    endure("10,000 signs", display(&"± C1".repeat(10_000)));
    endure("10,000 joint signs", format!("$$ θ_1 = {} $$", "± C1 ".repeat(10_000)));
    endure("7 signs", display(&"± C1 ".repeat(7)));
    endure("6 signs", format!("$$ θ_1 = atan2(p_y, p_x) {} $$", "± arccos(p_z) ".repeat(6)));
    endure("a power of a sum", display("(C_1 + S_2 + C_3 + S_4 + d_1 + a_2)^{999}"));
    endure("a power of a sum", display("(C_1 + S_2 + C_3 + S_4 + d_1 + a_2)^{40}"));
    endure("powers of powers", display("((((((C_1 + S_2)^{100})^{100})^{100})^{100})^{100})^{100}"));
    endure("numbers to powers", display("((((((2)^{1000})^{1000})^{1000})^{1000})^{1000})^{1000}"));
    endure(
        "numbers to powers in steps",
        "$$ K = 2^{1000} $$\n".to_string()
            + &(0..9)
                .map(|i| format!("$$ K{} = K{i}^{{1000}} $$\n", i + 1))
                .collect::<String>()
                .replace("K0", "K"),
    );
    endure("2,000 powers of a number", display(&"(10^{999})^{9} · ".repeat(1_900)));
    endure("2,000 lower powers", display(&"10^{999} · ".repeat(1_900)));
    endure("an exponent", display("C1^{1000000000}"));
    endure("a larger exponent", display("2^{99999999999999999999}"));
    endure("a negative exponent", display("0^{-1}"));
    endure("division by zero", display("1/0"));
    endure("division by zero in other words", display("C_1/(C_1 - C_1) + 1/(S_1^2 + C_1^2 - 1)"));
    endure("0/0", display("0/0"));
    endure("roots of what is negative", display("\\sqrt{-1} + \\sqrt{-C_1^2 - 1}"));
    endure("nested roots", display(&format!("{}C1{}", "sqrt(1 + ".repeat(90), ")".repeat(90))));
    endure("nested fractions", display(&format!("{}C1{}", "1/(S1 + ".repeat(90), ")".repeat(90))));
    endure("nested products", display(&format!("{}C1{}", "(S1 + C2)(C1 + ".repeat(90), ")".repeat(90))));
    endure("nested sines", display(&format!("{}C1{}", "sin(".repeat(90), ")".repeat(90))));
    endure("a number of 100,000 digits", display(&"7".repeat(100_000)));
    endure("a number of 60,000 digits", display(&"7".repeat(60_000)));
    endure("a decimal of 60,000 digits", display(&format!("0.{}", "7".repeat(60_000))));
    endure("1e999999999", display("1e999999999 + 1e-999999999"));
    endure("numbers multiplied", display(&"9999999999999999999 · ".repeat(1_900)));
    endure("a name of 100,000 letters", format!("$$ {} = C1 $$", "x".repeat(100_000)));
    endure("a name of 60,000 letters", format!("$$ {} = C1 $$", "x".repeat(60_000)));
    endure("an index of 60,000 digits", format!("$$ T_{{{}}} = C1 $$", "1".repeat(60_000)));
    endure("sines of many digits", display(&format!("C_{{{}}}", "123456".repeat(5_000))));
    endure(
        "a sum of sines of sums",
        display(&terms(60, &|i| format!("\\sin({} θ_1 + θ_2 + θ_3 + θ_4)", 50 + i))),
    );
    endure("a multiple angle", display("\\cos(1000000 θ_1) + \\cos(999999999999 θ_2)"));
    endure(
        "many multiple angles",
        display(
            &(1..12).map(|i| format!("\\cos({} θ_{})", 97 * i, i % 6 + 1)).collect::<Vec<_>>().join(" · "),
        ),
    );
    endure("exponents of many angles", display("(C_{123456} + S_{123456})^{60}"));
}

#[test]
fn strange_characters() {
    for (what, c) in [
        ("zero width space", "\u{200b}"),
        ("zero width joiner", "\u{200d}"),
        ("word joiner", "\u{2060}"),
        ("byte order mark", "\u{feff}"),
        ("right to left", "\u{202e}"),
        ("isolate", "\u{2066}"),
        ("soft hyphen", "\u{ad}"),
        ("NUL", "\0"),
        ("escape", "\u{1b}[31m"),
        ("carriage return", "\r"),
        ("CRLF", "\r\n"),
        ("line separator", "\u{2028}"),
        ("form feed", "\u{c}"),
        ("combining", "\u{307}"),
        ("emoji", "👩‍🔧"),
        ("private use", "\u{f8ff}"),
        ("last", "\u{10ffff}"),
        ("mathematical C", "𝐶"),
        ("full width", "Ｃ１"),
        ("Arabic digits", "١"),
    ] {
        let sound = format!("{TABLE}{SOUND}");
        let between: String = sound.chars().flat_map(|x| [x.to_string(), c.to_string()]).collect();
        endure(&format!("{what} between all"), between);
        endure(&format!("{what} in a formula"), display(&format!("C{c}_1 {c}+ S_{c}2{c}")));
        endure(&format!("{what} many"), display(&format!("C_1{}", c.repeat(20_000))));
        endure(&format!("{what} before all"), format!("{c}{sound}"));
    }
    let sound = format!("{TABLE}{SOUND}").replace('\n', "\r\n");
    let checked = judged(&sound, Format::Markdown, None).expect("a table");
    assert_eq!((checked.tally().equal, checked.tally().wrong), (2, 0));
}

fn greek(i: usize) -> String {
    char::from_u32('A' as u32 + i as u32).map_or("A".into(), |c| format!("\\mathbf{{{c}}}"))
}

/// Documents that people wrote, with a few bytes changed, moved or lost.
#[test]
#[ignore = "takes minutes: cargo xtask soak suites"]
fn documents_that_were_damaged() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/documents");
    let mut files: Vec<_> =
        std::fs::read_dir(folder).expect("the documents").map(|f| f.expect("a file").path()).collect();
    files.sort();
    let texts: Vec<(String, String)> = files
        .iter()
        .map(|f| {
            (
                f.file_name().unwrap_or_default().to_string_lossy().into(),
                std::fs::read_to_string(f).expect("text"),
            )
        })
        .collect();
    const PIECES: [&str; 24] = [
        "(",
        ")",
        "{",
        "}",
        "[",
        "]",
        "$",
        "$$",
        "\\",
        "&",
        "\\\\",
        "=",
        "|",
        "^",
        "_",
        "`",
        "\n",
        "\n\n",
        "θ",
        "\\frac{",
        "\\begin{bmatrix}",
        "\\end{bmatrix}",
        "<!-- check: ",
        "\u{202e}",
    ];
    let count = share(600, 60);
    let mut slowest = (0.0_f64, String::new());
    for k in 0..count {
        let (name, text) = texts[k % texts.len()].clone();
        if std::env::var("DAMAGED").is_ok_and(|only| only != k.to_string()) {
            continue;
        }
        let format = FORMATS[if k % 5 == 0 { k / 5 % 4 } else { 0 }];
        let took = apart(move || {
            let mut random = Random(k as u64);
            let mut text = text;
            for _ in 0..1 + (random.unit() * 12.0) as usize {
                let chars: Vec<usize> = text.char_indices().map(|c| c.0).chain([text.len()]).collect();
                let mut at = || chars[(random.unit() * chars.len() as f64) as usize];
                let (a, b) = (at(), at());
                let (a, b) = (a.min(b), a.max(b));
                let near = text[a..].char_indices().nth(1 + (b - a) % 40).map_or(text.len(), |c| a + c.0);
                match (random.unit() * 6.0) as usize {
                    0 => text.replace_range(a..near, ""),
                    1 => {
                        let part = text[a..near].to_string();
                        text.insert_str(b, &part);
                    }
                    2 if random.unit() < 0.1 => text.truncate(b),
                    3 => {
                        let c = text[a..near].chars().next().unwrap_or(' ');
                        text.replace_range(a..near, &c.to_string().repeat(3));
                    }
                    _ => {
                        let piece = PIECES[(random.unit() * PIECES.len() as f64) as usize];
                        text.insert_str(b, piece);
                    }
                }
            }
            let before = clock();
            let _ = judged(&text, format, None);
            let _ = judged(&text, format, Some("staubli-rx90")).map(|c| c.tally());
            clock() - before
        })
        .unwrap_or_else(|| panic!("{k}: more than {PATIENCE} s"));
        if took > slowest.0 {
            slowest = (took, format!("{name} {k} {format:?}"));
        }
    }
    println!("{count} damaged documents, {:.2} s at most ({})", slowest.0, slowest.1);
}
