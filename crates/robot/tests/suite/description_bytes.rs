//! No text makes a reader panic, and what is read is written to a file that reads back.

use denavit::catalogue;
use denavit::description::{
    Convention, TableKind, TableOptions, prove_same_chain, read_table, read_toml, render, write_toml,
};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

fn read_everything(text: &str) {
    let results = [read_toml(text)].into_iter().chain(
        [TableKind::Markdown, TableKind::Csv, TableKind::Latex].into_iter().flat_map(|kind| {
            [None, Some(Convention::Standard), Some(Convention::Khalil)].map(|convention| {
                read_table(text, kind, &TableOptions { convention, ..TableOptions::default() })
            })
        }),
    );
    for result in results {
        match result {
            Ok((d, findings)) => {
                let _ = render(&findings, "f", text);
                let written = write_toml(&d);
                let again =
                    read_toml(&written).unwrap_or_else(|e| panic!("{text}\n{}", render(&e, "w", &written))).0;
                assert_eq!(format!("{:?}", d.rows), format!("{:?}", again.rows), "{text}\n{written}");
                let _ = prove_same_chain(&d, &d.converted(Convention::Standard).description);
            }
            Err(findings) => assert!(!render(&findings, "f", text).is_empty()),
        }
    }
}

/// Pieces that cells and heads are made of.
fn piece() -> impl Strategy<Value = String> {
    let pieces = [
        "θ",
        "\\theta",
        "_",
        "{",
        "}",
        "1",
        "2",
        "q1",
        "q2",
        "q3",
        "d_2",
        "a1",
        "L",
        "+",
        "-",
        "−",
        "*",
        "/",
        "(",
        ")",
        "^",
        "2.5",
        "90",
        "°",
        " deg",
        " mm",
        "π",
        "\\frac",
        "$",
        " ",
        "\t",
        "|",
        ",",
        ";",
        "&",
        "\\\\",
        "0",
        "1e3",
        "=",
        "sqrt(",
        "sin(",
        "\\begin{tabular}{cc}",
        "\\end{tabular}",
        "\n",
        "[",
        "]",
        "\"",
        "₂",
        "±",
        "...",
        "\\mathrm{",
        "atan2(1,2)",
        "nan",
        "\\",
    ];
    proptest::sample::select(pieces.to_vec()).prop_map(str::to_string)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, rng_seed: RngSeed::Fixed(2), ..ProptestConfig::default() })]

    #[test]
    fn bytes(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        read_everything(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn pieces(pieces in proptest::collection::vec(piece(), 0..80)) {
        read_everything(&pieces.concat());
    }

    #[test]
    fn changed_robots(
        robot in 0..1000_usize,
        edits in proptest::collection::vec((any::<usize>(), 0..4_usize, any::<u8>(), piece()), 1..6),
    ) {
        let names = catalogue::names();
        let mut bytes = catalogue::text(names[robot % names.len()]).unwrap_or("").as_bytes().to_vec();
        for (at, kind, byte, piece) in edits {
            let at = at % bytes.len();
            match kind {
                0 => bytes[at] = byte,
                1 => { bytes.remove(at); }
                2 => { bytes.splice(at..at, piece.bytes()); }
                _ => { let end = (at + 20).min(bytes.len()); let copy = bytes[at..end].to_vec(); bytes.splice(at..at, copy); }
            }
        }
        read_everything(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn tables(
        rows in proptest::collection::vec(proptest::collection::vec(
            proptest::collection::vec(piece(), 0..4).prop_map(|p| p.concat()), 5), 1..6),
        separator in proptest::sample::select(vec![" | ", ",", ";", "\t", " & "]),
        head in proptest::sample::select(vec!["theta d a alpha q", "α a θ d i", "σ α d θ r", "θ_i α_{i-1} a_{i-1} d_i type"]),
    ) {
        let mut lines = vec![head.split(' ').collect::<Vec<_>>().join(separator)];
        lines.extend(rows.iter().map(|r| r.join(separator)));
        read_everything(&lines.join(if separator == " & " { "\\\\\n" } else { "\n" }));
        read_everything(&format!("\\begin{{tabular}}{{ccccc}}\n{}\n\\end{{tabular}}", lines.join("\\\\\n")));
    }

    #[test]
    fn cells(pieces in proptest::collection::vec(piece(), 1..12)) {
        let cell = pieces.concat().replace(['"', '\\', '\n'], "");
        read_everything(&format!(
            "convention = \"standard\"\n[parameters]\na1 = {{}}\nL = {{}}\n[[joints]]\ntheta = \"{cell}\"\n[[joints]]\nd = \"{cell}\"\n"
        ));
    }
}

#[test]
fn long_texts_are_read_in_time() {
    let standard = TableOptions { convention: Some(Convention::Standard), ..TableOptions::default() };
    for piece in [
        "[[joints]]\n",
        "\\begin{tabular}",
        "\\cline{",
        "a=",
        "((((",
        "| ",
        "theta,d,a\n",
        "'",
        "x=1\n",
        "[a",
        "{",
        "θ",
    ] {
        let seconds = |length: usize| {
            let text = piece.repeat(length / piece.len());
            let started = std::time::Instant::now();
            let _ = read_toml(&text);
            for kind in [TableKind::Markdown, TableKind::Csv, TableKind::Latex] {
                let _ = read_table(&text, kind, &standard);
            }
            started.elapsed().as_secs_f64()
        };
        // Sixteen times as long takes sixteen times the time, not 256 times; a busy machine may be slow once.
        let mut measured = vec![];
        let is_linear = (0..3).any(|_| {
            let (short, long) = (seconds(1 << 15), seconds(1 << 19));
            measured.push((short, long));
            long < 1.0 + 64.0 * short
        });
        assert!(is_linear, "{piece:?}: {measured:?} s");
    }
}
