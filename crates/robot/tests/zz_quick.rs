use denavit::description::*;
use std::path::PathBuf;
#[test]
fn quick() {
    let dir = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/tables"));
    for (f, opt) in [("staubli-rx90", TableOptions{convention:Some(Convention::Khalil),..Default::default()}),("stanford", TableOptions{convention:Some(Convention::Khalil),..Default::default()}),
     ("prrrrp", TableOptions::default()), ("ur3-lab", TableOptions{convention:Some(Convention::Standard),lengths_in_millimetres:Some(true),..Default::default()}),
     ("cylindrical-wrist", TableOptions{convention:Some(Convention::Standard),..Default::default()}),
     ("cylindrical-wrist-b", TableOptions{convention:Some(Convention::Standard),columns:Some("theta alpha a d".into()),..Default::default()}),
     ("smart5-six-rail-scan", TableOptions{convention:Some(Convention::Standard),..Default::default()}),
     ("ur3-lab", TableOptions{..Default::default()}), ("cylindrical-wrist", TableOptions::default()), ("staubli-rx90", TableOptions::default()),
     ("ur3-lab", TableOptions{convention:Some(Convention::Standard),..Default::default()}),
     ] {
        println!("=== {f}");
        let text = std::fs::read_to_string(dir.join(format!("{f}.md"))).unwrap();
        match read_table(&text, TableKind::Markdown, &opt) {
            Ok((d, notes)) => { println!("{}", render(&notes, f, &text)); println!("{}", write_toml(&d)); }
            Err(e) => println!("{}", render(&e, f, &text)),
        }
    }
}
#[test]
fn conv() {
    let dir = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/catalogue"));
    for f in std::fs::read_dir(dir).unwrap() {
        let p = f.unwrap().path();
        let text = std::fs::read_to_string(&p).unwrap();
        let (d, _) = read_toml(&text).unwrap();
        for to in Convention::ALL {
            let c = d.converted(to);
            let t = std::time::Instant::now();
            let v = prove_same_chain(&d, &c.description);
            if !v.is_equal() || t.elapsed().as_millis() > 5 { println!("{p:?} {to} {v:?} {:?}", t.elapsed()); }
            let w = write_toml(&c.description);
            match read_toml(&w) { Ok((e, n)) => { if format!("{:?}", c.description) != format!("{e:?}") { println!("DIFF {p:?} {to} {:?}", prove_same_chain(&e, &d)); } if !n.is_empty() { println!("{}", render(&n, "w", &w)); } }, Err(e) => println!("{}\n{w}", render(&e, "w", &w)) }
        }
    }
}
