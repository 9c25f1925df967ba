//! Data sets of LeRobot: a folder with `meta/info.json`, whose episodes stand in files of Parquet, one each (version 2) or many a file
//! (version 3).

use super::recording::bytes_of;
use crate::failure::Failure;
use denavit_tables::{Kind, Table};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// The most files that are read, and how deep folders are looked through.
const MOST_FILES: usize = 2000;
const DEPTH: usize = 4;
/// Where a description of the data does not say.
const DATA: &str = "data/";

/// Whether a folder is such a data set.
pub fn is_one(folder: &Path) -> bool {
    folder.is_dir() && folder.join("meta").join("info.json").is_file()
}

/// All episodes, one behind the other.
///
/// # Errors
/// If a file cannot be read, or is broken.
pub fn table(folder: &Path) -> Result<Table, Failure> {
    let info_name = folder.join("meta").join("info.json").to_string_lossy().into_owned();
    let info: Value = serde_json::from_slice(&bytes_of(&info_name)?)
        .map_err(|e| Failure::Input(format!("error: {info_name}: {e}")))?;
    // The folder in front of the first name that is filled in.
    let template = info["data_path"].as_str().unwrap_or(DATA);
    let before = template.split('{').next().unwrap_or(DATA);
    let data = before.rsplit_once('/').map_or("", |b| b.0);
    let is_inside = !data.split('/').any(|part| part == "..") && !data.starts_with('/');
    let mut files = vec![];
    if is_inside {
        found(&folder.join(data), DEPTH, &mut files);
    }
    files.sort();
    if files.is_empty() {
        let hint = "the data of version 2 and 3 are files of Parquet";
        return Err(Failure::Input(format!("error: {info_name}: no file in {data}\n  = hint: {hint}")));
    }
    let mut all = Table { first_row: 1, ..Table::default() };
    let (count, mut of) = (files.len().min(MOST_FILES), 0);
    for file in files.iter().take(MOST_FILES) {
        let name = file.to_string_lossy().into_owned();
        let failed = |e| Failure::Input(format!("error: {name}: {e}"));
        let part = denavit_tables::read(&bytes_of(&name)?, Kind::Parquet).map_err(failed)?;
        all.append(part).map_err(failed)?;
        of += 1;
    }
    let version = info["codebase_version"].as_str().unwrap_or("of no version");
    let mut said = format!("read as a data set of LeRobot, {version}: {of} of {} files", files.len());
    if count < files.len() {
        said += ", the first ones";
    }
    all.remarks.insert(0, said);
    all.remarks.extend(names(&info["features"], "observation.state"));
    all.remarks.extend(rate(&info, &all));
    Ok(all)
}

/// The files of Parquet in a folder.
fn found(folder: &Path, depth: usize, files: &mut Vec<PathBuf>) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for path in entries.filter_map(|e| Some(e.ok()?.path())) {
        if path.is_dir() && depth > 0 {
            found(&path, depth - 1, files);
        } else if path.extension().is_some_and(|e| e == "parquet") {
            files.push(path);
        }
    }
}

/// What the members of a feature are called: a list, or a map with one list.
fn names(features: &Value, feature: &str) -> Option<String> {
    let names = &features[feature]["names"];
    let list = names.as_array().or_else(|| names.as_object()?.values().find_map(Value::as_array))?;
    let list: Vec<&str> = list.iter().filter_map(Value::as_str).take(16).collect();
    (list.len() > 1).then(|| format!("{feature}[0], … are called {}", list.join(", ")))
}

/// Where the rate that is said is not that of the time.
fn rate(info: &Value, table: &Table) -> Option<String> {
    let said = info["fps"].as_f64().filter(|f| *f > 0.0)?;
    let time = &table.columns.iter().find(|c| c.name == "timestamp")?.values;
    let mut steps: Vec<f64> = time.windows(2).map(|w| w[1] - w[0]).filter(|d| *d > 0.0).collect();
    steps.sort_by(f64::total_cmp);
    let usual = *steps.get(steps.len() / 2)?;
    let is_other = (usual * said - 1.0).abs() > 0.02;
    is_other.then(|| format!("fps is {said} in meta/info.json, {:.2} by the time of the rows", 1.0 / usual))
}
