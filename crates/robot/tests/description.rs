use denavit::description::*;
use std::path::PathBuf;
#[test]
fn catalogue() {
    let dir = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/catalogue"));
    for f in std::fs::read_dir(dir).unwrap() {
        let p = f.unwrap().path();
        let text = std::fs::read_to_string(&p).unwrap();
        match read_toml(&text) {
            Ok((d, notes)) => {
                if !notes.is_empty() { print!("{}", render(&notes, p.file_name().unwrap().to_str().unwrap(), &text)); }
                let w = write_toml(&d);
                match read_toml(&w) {
                    Ok((e, _)) => {
                        if format!("{d:?}") != format!("{e:?}") { println!("DIFF {p:?}\n{w}\n"); }
                    }
                    Err(e) => println!("ROUND {p:?}\n{}", render(&e, "w", &w)),
                }
            }
            Err(e) => println!("{}", render(&e, p.file_name().unwrap().to_str().unwrap(), &text)),
        }
    }
}
