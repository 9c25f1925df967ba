//! NPY and NPZ as NumPy writes them; the bytes are those of its format description, version 1.0.

use denavit_tables::{Kind, read};
use flate2::Compression;
use flate2::write::DeflateEncoder;
use std::io::Write;

/// An array in a file.
fn npy(descr: &str, fortran: &str, shape: &str, data: &[u8]) -> Vec<u8> {
    let mut head = format!("{{'descr': {descr}, 'fortran_order': {fortran}, 'shape': {shape}, }}");
    while (head.len() + 11) % 64 != 0 {
        head.push(' ');
    }
    head.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend(u16::try_from(head.len()).expect("short").to_le_bytes());
    bytes.extend(head.as_bytes());
    bytes.extend(data);
    bytes
}

fn doubles(x: &[f64]) -> Vec<u8> {
    x.iter().flat_map(|x| x.to_le_bytes()).collect()
}

/// An archive of files, stored or deflated.
fn zip(files: &[(&str, Vec<u8>)], is_packed: bool) -> Vec<u8> {
    let (mut all, mut directory) = (vec![], vec![]);
    for (name, content) in files {
        let packed = if is_packed {
            let mut encoder = DeflateEncoder::new(vec![], Compression::default());
            encoder.write_all(content).expect("memory");
            encoder.finish().expect("memory")
        } else {
            content.clone()
        };
        let method: u16 = if is_packed { 8 } else { 0 };
        let mut fields = vec![20, 0, 0, 0];
        fields.extend(method.to_le_bytes());
        fields.extend([0; 8]);
        fields.extend((packed.len() as u32).to_le_bytes());
        fields.extend((content.len() as u32).to_le_bytes());
        fields.extend((name.len() as u16).to_le_bytes());
        fields.extend([0, 0]);
        let at = all.len() as u32;
        all.extend(b"PK\x03\x04");
        all.extend(&fields);
        all.extend(name.as_bytes());
        all.extend(&packed);
        directory.extend(b"PK\x01\x02\x14\x00");
        directory.extend(&fields);
        directory.extend([0; 10]);
        directory.extend(at.to_le_bytes());
        directory.extend(name.as_bytes());
    }
    let start = all.len() as u32;
    all.extend(&directory);
    all.extend(b"PK\x05\x06\0\0\0\0");
    let count = (files.len() as u16).to_le_bytes();
    all.extend(count.iter().chain(&count));
    all.extend((directory.len() as u32).to_le_bytes());
    all.extend(start.to_le_bytes());
    all.extend([0, 0]);
    all
}

#[test]
fn arrays_of_many_types() {
    let row = |bytes: &[u8]| {
        let table = read(bytes, Kind::Npy).expect("a table");
        table.columns.iter().map(|c| c.values.clone()).collect::<Vec<_>>()
    };
    let wanted = vec![vec![1.0, 3.0], vec![-2.0, 4.0]];
    assert_eq!(row(&npy("'<f8'", "False", "(2, 2)", &doubles(&[1.0, -2.0, 3.0, 4.0]))), wanted);
    assert_eq!(row(&npy("'<f8'", "True", "(2, 2)", &doubles(&[1.0, 3.0, -2.0, 4.0]))), wanted);
    let floats: Vec<u8> = [1.0_f32, -2.0, 3.0, 4.0].iter().flat_map(|x| x.to_be_bytes()).collect();
    assert_eq!(row(&npy("'>f4'", "False", "(2, 2)", &floats)), wanted);
    let whole: Vec<u8> = [1_i16, -2, 3, 4].iter().flat_map(|x| x.to_le_bytes()).collect();
    assert_eq!(row(&npy("'<i2'", "False", "(2, 2)", &whole)), wanted);
    assert_eq!(row(&npy("'|b1'", "False", "(2,)", &[1, 0])), [[1.0, 0.0]]);
    // A record: one number, and three.
    let record =
        npy("[('t', '<f8'), ('q', '<f8', (2,))]", "False", "(2,)", &doubles(&[0.5, 1.0, 2.0, 0.6, 3.0, 4.0]));
    let table = read(&record, Kind::Npy).expect("a table");
    let names: Vec<&str> = table.columns.iter().map(|c| c.name.as_str()).collect();
    assert_eq!((names, table.columns[2].values.clone()), (vec!["t", "q[0]", "q[1]"], vec![2.0, 4.0]));
    // Poses: 3 of 2×2, in either order of their memory.
    let c = npy("'<f8'", "False", "(3, 2, 2)", &doubles(&(0..12).map(f64::from).collect::<Vec<_>>()));
    assert_eq!(row(&c)[2], [2.0, 6.0, 10.0]);
    let fortran: Vec<f64> = (0..2)
        .flat_map(|j| (0..2).flat_map(move |i| (0..3).map(move |r| f64::from(4 * r + 2 * i + j))))
        .collect();
    assert_eq!(row(&npy("'<f8'", "True", "(3, 2, 2)", &doubles(&fortran))), row(&c));
}

#[test]
fn archives() {
    let files = [
        ("q.npy", npy("'<f8'", "False", "(2, 2)", &doubles(&[1.0, 2.0, 3.0, 4.0]))),
        ("t.npy", npy("'<f8'", "False", "(2,)", &doubles(&[0.0, 0.1]))),
        ("note.npy", npy("'<U4'", "False", "()", &[0; 16])),
        ("K.npy", npy("'<f8'", "False", "(3,)", &doubles(&[1.0, 2.0, 3.0]))),
    ];
    for is_packed in [false, true] {
        let table = read(&zip(&files, is_packed), Kind::Npz).expect("a table");
        let names: Vec<&str> = table.columns.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["q[0]", "q[1]", "t"]);
        assert_eq!(table.remarks.len(), 3, "{:?}", table.remarks);
    }
}

#[test]
fn broken_archives() {
    let array = npy("'<f8'", "False", "(2, 2)", &doubles(&[1.0, 2.0, 3.0, 4.0]));
    let packed = zip(&[("q.npy", array.clone())], true);
    for (bytes, kind) in [(&array, Kind::Npy), (&packed, Kind::Npz)] {
        for k in 0..bytes.len() {
            assert!(read(&bytes[..k], kind).is_err(), "{k}");
            for value in [0, 0x7f, 0xff] {
                let mut other = bytes.clone();
                other[k] = value;
                let _ = read(&other, kind);
            }
        }
    }
    let huge = npy("'<f8'", "False", "(99999999999, 3)", &[]);
    assert!(read(&huge, Kind::Npy).is_err());
    let wide = npy("'<f8'", "False", "(1, 99999)", &[]);
    assert!(read(&wide, Kind::Npy).expect_err("too wide").hint.contains("4096"));
    let complex = npy("'<c16'", "False", "(1, 1)", &[0; 16]);
    assert!(read(&complex, Kind::Npy).expect_err("complex").what.contains("<c16"));
}

/// Sizes of 64 bits that no file has, and entries that say they are small and are not.
#[test]
fn sizes_that_no_archive_has() {
    for places in [[u64::MAX; 3], [0, 0, u64::MAX - 20], [u64::MAX, 1, 0], [7, u64::MAX, 3]] {
        let mut entry = b"PK\x01\x02".to_vec();
        entry.resize(46, 0);
        for at in [20, 24, 42] {
            entry[at..at + 4].copy_from_slice(&u32::MAX.to_le_bytes());
        }
        entry[28..30].copy_from_slice(&1_u16.to_le_bytes());
        entry[30..32].copy_from_slice(&28_u16.to_le_bytes());
        entry.push(b'a');
        entry.extend([1, 0, 24, 0]);
        entry.extend(places.iter().flat_map(|x| x.to_le_bytes()));
        let mut end = b"PK\x05\x06".to_vec();
        end.resize(22, 0);
        end[10] = 1;
        let bytes = [entry, end].concat();
        assert!(read(&bytes, Kind::Npz).is_err(), "{places:?}");
    }
}
