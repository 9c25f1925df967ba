//! Recordings in Parquet, alone and as data sets of LeRobot of both versions.

use super::recordings::{folder, rows, run};
use parquet::data_type::{DoubleType, FloatType, Int64Type};
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;
use std::path::Path;
use std::sync::Arc;

const SCHEMA: &str = "message schema {
    required double timestamp;
    required int64 episode_index;
    required group observation.state (LIST) { repeated group list { required float element; } }
    required group pose (LIST) { repeated group list { required double element; } }
}";

/// Writes rows of time, joints and pose as one episode after another.
fn write(file: &Path, episodes: &[(i64, &[Vec<f64>])]) {
    let schema = Arc::new(parse_message_type(SCHEMA).expect("a schema"));
    let sink = std::fs::File::create(file).expect("a file");
    let properties = Arc::new(WriterProperties::builder().build());
    let mut writer = SerializedFileWriter::new(sink, schema, properties).expect("a writer");
    let all: Vec<(i64, &Vec<f64>)> =
        episodes.iter().flat_map(|(e, r)| r.iter().map(move |r| (*e, r))).collect();
    let mut group = writer.next_row_group().expect("a group");
    let levels = |n: usize| {
        let one: Vec<i16> = (0..n).map(|k| i16::from(k > 0)).collect();
        (vec![1_i16; n * all.len()], one.repeat(all.len()))
    };
    let mut column = group.next_column().expect("written").expect("a column");
    let times: Vec<f64> = all.iter().map(|r| r.1[0]).collect();
    column.typed::<DoubleType>().write_batch(&times, None, None).expect("written");
    column.close().expect("closed");
    let mut column = group.next_column().expect("written").expect("a column");
    let numbers: Vec<i64> = all.iter().map(|r| r.0).collect();
    column.typed::<Int64Type>().write_batch(&numbers, None, None).expect("written");
    column.close().expect("closed");
    let mut column = group.next_column().expect("written").expect("a column");
    let joints: Vec<f32> = all.iter().flat_map(|r| r.1[1..7].iter().map(|x| *x as f32)).collect();
    let (definition, repetition) = levels(6);
    column.typed::<FloatType>().write_batch(&joints, Some(&definition), Some(&repetition)).expect("written");
    column.close().expect("closed");
    let mut column = group.next_column().expect("written").expect("a column");
    let poses: Vec<f64> = all.iter().flat_map(|r| r.1[7..13].to_vec()).collect();
    let (definition, repetition) = levels(6);
    column.typed::<DoubleType>().write_batch(&poses, Some(&definition), Some(&repetition)).expect("written");
    column.close().expect("closed");
    group.close().expect("closed");
    writer.close().expect("closed");
}

#[test]
fn a_file_of_parquet() {
    let at = folder("parquet");
    let file = at.join("run.parquet");
    write(&file, &[(0, &rows(|_| {}))]);
    let name = file.to_string_lossy();
    let (code, out, err) = run(&["check", "ur5", &name]);
    assert_eq!(code, 0, "{out}{err}");
    assert!(
        out.contains(
            "joints observation.state[0] … observation.state[5]; position pose[0], pose[1], pose[2]"
        ),
        "{out}"
    );
    write(&file, &[(0, &rows(|r| r[2] = -r[2]))]);
    let (code, out, _) = run(&["check", "ur5", &name]);
    assert!(code == 1 && out.contains("the sign is reversed"), "{out}");
    // Cut off, and with bytes changed: an error, no panic.
    let bytes = std::fs::read(&file).expect("a file");
    for k in [0, 3, 4, 100, bytes.len() / 2, bytes.len() - 9, bytes.len() - 1] {
        std::fs::write(&file, &bytes[..k]).expect("a file");
        assert_eq!(run(&["check", "ur5", &name]).0, 3, "{k}");
    }
    for k in (bytes.len() - 400..bytes.len()).step_by(7) {
        let mut other = bytes.clone();
        other[k] ^= 0x55;
        std::fs::write(&file, &other).expect("a file");
        let (code, _, err) = run(&["check", "ur5", &name]);
        assert!((0..=3).contains(&code), "{k}: {code} {err}");
    }
}

#[test]
fn data_sets_of_both_versions() {
    let lists = ["[\"a.pos\", \"b.pos\"]", "{\"motors\": [\"a.pos\", \"b.pos\"]}", "null"];
    for (k, names) in lists.into_iter().enumerate() {
        let is_old = k == 0;
        let at = folder(&format!("lerobot-{k}"));
        let (version, template, files) = if is_old {
            let files = ["episode_000000.parquet", "episode_000001.parquet"];
            ("v2.1", "data/chunk-{episode_chunk:03d}/episode_{episode_index:06d}.parquet", files.to_vec())
        } else {
            ("v3.0", "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet", vec!["file-000.parquet"])
        };
        let chunk = at.join("data").join("chunk-000");
        std::fs::create_dir_all(at.join("meta")).expect("a folder");
        std::fs::create_dir_all(&chunk).expect("a folder");
        let info = format!(
            "{{\"codebase_version\": \"{version}\", \"fps\": 30, \"data_path\": \"{template}\", \
             \"features\": {{\"observation.state\": {{\"dtype\": \"float32\", \"names\": {names}}}}}}}"
        );
        std::fs::write(at.join("meta").join("info.json"), info).expect("a file");
        let all = rows(|r| r[6] = -r[6]);
        let (first, second) = all.split_at(120);
        match is_old {
            true => {
                write(&chunk.join(files[0]), &[(0, first)]);
                write(&chunk.join(files[1]), &[(1, second)]);
            }
            false => write(&chunk.join(files[0]), &[(0, first), (1, second)]),
        }
        let (code, out, err) = run(&["check", "ur5", &at.to_string_lossy()]);
        assert_eq!(code, 1, "{out}{err}");
        assert!(out.contains("observation.state[5] (joint q6): the sign is reversed"), "{out}");
        assert!(
            err.contains(version) && err.contains("fps is 30 in meta/info.json, 25.00 by the time"),
            "{err}"
        );
        assert_eq!(err.contains("are called a.pos, b.pos"), k < 2, "{err}");
        // The other verbs that read recordings read it as well.
        let name = at.to_string_lossy();
        let (_, out, err) =
            run(&["identify", "ur5", &name, "--torques", "pose[0]..pose[5]", "--cutoff", "none"]);
        assert!(out.contains("joints observation.state[0] … observation.state[5]"), "{out}{err}");
        assert!(err.contains(version), "{err}");
        let (_, out, err) = run(&["calibrate", "ur5", &name]);
        assert!(err.contains(version) && err.contains("the sign is reversed"), "{out}{err}");
        std::fs::remove_dir_all(at.join("data")).expect("a folder");
        assert_eq!(run(&["check", "ur5", &at.to_string_lossy()]).0, 3);
    }
}
