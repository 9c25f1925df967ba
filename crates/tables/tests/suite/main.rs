//! Tables out of bytes: dialects, places of what is no number, broken files.

mod arrays;

use denavit_tables::{Kind, Table, read, written};

fn csv(text: &str) -> Table {
    read(text.as_bytes(), Kind::Csv).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// Names, units and the first row.
fn shape(table: &Table) -> (Vec<String>, Vec<f64>) {
    let name =
        |c: &denavit_tables::Column| c.unit.as_ref().map_or(c.name.clone(), |u| format!("{} in {u}", c.name));
    (table.columns.iter().map(name).collect(), table.columns.iter().map(|c| c.values[0]).collect())
}

#[test]
fn dialects() {
    let wanted = (vec!["t in s".to_string(), "q1 in deg".into(), "x in mm".into()], vec![0.5, -1.25, 300.0]);
    for text in [
        "t [s],q1 [deg],x [mm]\n0.5,-1.25,300\n0.6,-1.5,301\n",
        "t (s);q1 (deg);x (mm)\n0,5;-1,25;300\n0,6;-1,5;301\n",
        "t [s];q1_deg;x_mm\n0.5;-1.25;300\n0.6;-1.5;301\n",
        "t [s]\tq1_deg\tx_mm\r\n0.5\t-1.25\t3e2\r\n0.6\t-1.5\t301\r\n",
        "# t[s] q1[deg] x[mm]\n0.5 -1.25 300\n0.6 -1.5 301\n",
        "# made yesterday\n# t [s],q1 [deg],x [mm]\n0.5,-1.25,300\n0.6,-1.5,301\n",
        "\u{feff}t [s], q1 [deg], x [mm]\n 0.5, -1.25, 300\n\n 0.6, -1.5, 301\n",
        "\"t [s]\",\"q1 [deg]\",\"x [mm]\"\n\"0.5\",\"-1.25\",\"300\"\n0.6,-1.5,301\n",
    ] {
        assert_eq!(shape(&csv(text)), wanted, "{text}");
        assert_eq!(csv(text).columns[0].values, [0.5, 0.6]);
    }
    let nameless = csv("0.5,1\n0.6,2\n");
    assert_eq!(shape(&nameless).0, ["column 1", "column 2"]);
    assert!(nameless.remarks[0].contains("no head"), "{:?}", nameless.remarks);
    let utf16: Vec<u8> =
        [0xff, 0xfe].into_iter().chain("a,b\n1,2\n".encode_utf16().flat_map(u16::to_le_bytes)).collect();
    assert_eq!(read(&utf16, Kind::Csv).expect("a table").columns[1].values, [2.0]);
}

#[test]
fn what_is_no_number_has_its_place() {
    let table = csv("t,q1,who\n0,1,ann\n1,x7,bob\n2,,cid\n3,NaN,dan\n4,5\n");
    assert_eq!(table.columns.len(), 2);
    let values = &table.columns[1].values;
    assert_eq!((values[0], values[4]), (1.0, 5.0));
    assert!(values[1..4].iter().all(|x| x.is_nan()));
    let remarks = table.remarks.join("\n");
    for part in ["`x7` in line 3, column q1", "holds texts: who", "line 6 has 2"] {
        assert!(remarks.contains(part), "{part}: {remarks}");
    }
    assert_eq!(table.first_row, 2);
}

#[test]
fn broken_texts() {
    for (text, part) in [
        ("", "empty"),
        ("a,b\n", "no row"),
        ("\n\n  \n", "empty"),
        ("a\0b", "no text"),
        ("who,where\nann,here\nbob,there\n", "no column of numbers"),
    ] {
        let error = read(text.as_bytes(), Kind::Csv).expect_err(text);
        assert!(error.what.contains(part), "{text:?}: {error}");
        assert!(!error.hint.is_empty());
    }
    let wide = vec!["1"; 1_000_000].join(",");
    let error = read(wide.as_bytes(), Kind::Csv).expect_err("too wide");
    assert!(error.what.contains("1000000 columns"), "{error}");
    // Cut off anywhere, and bytes that are no UTF-8.
    let text = "t,q1 [deg],x\n0,\"1\",2\n1,2,3\n\"4\",5,6\n";
    for k in 0..text.len() {
        let _ = read(&text.as_bytes()[..k], Kind::Csv);
        let mut bytes = text.as_bytes().to_vec();
        bytes[k] = 0xf5;
        let _ = read(&bytes, Kind::Csv);
    }
}

#[test]
fn json_lines() {
    let read = |text: &str| denavit_tables::read(text.as_bytes(), Kind::Json);
    let lines = "{\"t\":0,\"q\":[1,2],\"tcp\":{\"x\":0.1,\"ok\":true},\"who\":\"ann\"}\n{\"t\":1,\"q\":[3,4],\"tcp\":{\"x\":null}}\n";
    let table = read(lines).expect("a table");
    let names: Vec<&str> = table.columns.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names, ["q[0]", "q[1]", "t", "tcp.ok", "tcp.x"]);
    assert_eq!(table.columns[1].values, [2.0, 4.0]);
    assert!(table.columns[4].values[1].is_nan() && table.columns[3].values[1].is_nan());
    for text in ["[{\"a\":1},{\"a\":2}]", "{\"a\":[1,2]}", "{\"a\":1}\n{\"a\":2}"] {
        assert_eq!(read(text).expect("a table").columns[0].values, [1.0, 2.0], "{text}");
    }
    let changing = read("{\"q\":[1,2]}\n{\"q\":[1,2,3]}\n{\"q\":[1]}\n").expect("a table");
    assert!(changing.remarks[1].contains("`q` has 3 in row 2, 2 before"), "{:?}", changing.remarks);
    let cut = read("{\"a\":1}\n{\"a\":2}\n{\"a\":").expect("the last line is left out");
    assert_eq!(cut.columns[0].values, [1.0, 2.0]);
    let error = read("{\"a\":1}\n{a:2}\n{\"a\":3}\n").expect_err("no JSON");
    assert!(error.what.starts_with("line 2, column 2"), "{error}");
    assert!(read("").is_err() && read("7").is_err() && read("\"a\"\n").is_err());
    let deep = format!("{}1{}", "[".repeat(100), "]".repeat(100));
    assert!(read(&deep).is_err());
    let wide = format!("{{\"q\":[{}]}}", vec!["1"; 5000].join(","));
    assert!(read(&format!("{wide}\n{wide}\n")).expect_err("too wide").what.contains("columns"));
}

#[test]
fn what_is_written_is_read() {
    let table = csv("t [s],\"a,b\",c\n0.1,1e-7,\n0.2,-3,4\n");
    let again = csv(&written(&table.columns));
    assert_eq!(shape(&again).0, ["t in s", "a,b", "c"]);
    for (a, b) in table.columns.iter().zip(&again.columns) {
        assert!(
            a.values.iter().zip(&b.values).all(|(x, y)| x == y || x.is_nan() && y.is_nan()),
            "{a:?} {b:?}"
        );
    }
}
