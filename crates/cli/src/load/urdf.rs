//! A URDF, plain or for xacro to expand, and the chain of it that a command is about.

use super::linkage::set;
use super::{Around, file, options, rows};
use crate::arguments::RobotArguments;
use crate::failure::Failure;
use crate::terminal::{note, words};
use denavit::description::{Convention, Decimals, Described, Description, MAX_XML_BYTES, Shape, read_bodies};
use denavit_load::{Content, Folder, Kind, contents, plain};
use denavit_wire::view::Bundle;
use std::fs;
use std::path::PathBuf;

/// Metres that a person could see.
const SEEN: f64 = 1e-9;

/// The chain that the arguments name, and what is around it.
///
/// # Errors
/// If the file cannot be read or has errors, or there is no such chain.
pub fn from_urdf(arguments: &RobotArguments) -> Result<(Description, Around), Failure> {
    let mut content = bodies(arguments)?;
    if let Content::Rows(Described::Linkage(linkage)) = &mut content {
        set(arguments, linkage)?;
        return rows::chain(arguments, content);
    }
    let (description, around) = rows::taken(arguments, content)?;
    if let Around::Bodies(both) = &around {
        let (mechanism, chain) = &**both;
        note(&format!("note: {}", words().chain(chain, mechanism)));
        if let Some(why) = &chain.unweighed {
            note(&format!("warning: {why}"));
        }
    }
    Ok((description, around))
}

/// What is in the file that the arguments name: a tree of bodies, or a linkage.
///
/// # Errors
/// If the file cannot be read or has errors.
pub fn bodies(arguments: &RobotArguments) -> Result<Content, Failure> {
    let found = file(arguments, Kind::Bodies)?;
    if found.apart > SEEN {
        note(&format!("{}: note: {}", arguments.robot, words().read_apart(found.apart)));
    }
    Ok(found.content)
}

/// The most bytes of a mesh, and of all together, that the page is given.
const MOST_MESH: u64 = 64 << 20;
const MOST_MESHES: u64 = 256 << 20;

/// The description that the arguments name, with all that the page needs to open it itself, and its meshes in the order of
/// their numbers.
///
/// # Errors
/// If the file cannot be read or has errors.
pub fn bundle(arguments: &RobotArguments) -> Result<(Bundle, Vec<PathBuf>), Failure> {
    let file = fs::canonicalize(&arguments.robot)
        .map_err(|e| Failure::Input(format!("error: {}: {e}", arguments.robot)))?;
    let name = file.to_string_lossy().into_owned();
    let text = contents(&name, MAX_XML_BYTES);
    let text = text.map_err(|e| Failure::Input(format!("error: {name}: {e}")))?;
    let options = options(arguments)?;
    let mut folder = Folder::around(&name, &options.packages);
    let given = options.arguments;
    let (outcome, _) = read_bodies(&name, &text, &mut folder, &given, Decimals::Meant);
    let (mechanism, _) = outcome.map_err(|_| Failure::Input(format!("error: {name}: it has errors")))?;
    let mut paths: Vec<PathBuf> = vec![];
    let mut meshes: Vec<(String, String, usize)> = vec![];
    let mut sum = 0;
    for look in mechanism.bodies.iter().flat_map(|b| &b.looks) {
        let Shape::Mesh { file, .. } = &look.shape else { continue };
        let Some((key, path)) = folder.mesh(&name, file) else { continue };
        for (key, path) in with_data(key, path) {
            let size = fs::metadata(&path).map_or(u64::MAX, |m| m.len());
            let is_known = meshes.iter().any(|(known, ..)| *known == key);
            if is_known || size > MOST_MESH || sum + size > MOST_MESHES {
                continue;
            }
            sum += size;
            meshes.push((key, format!("mesh/{}", paths.len()), usize::try_from(size).unwrap_or(usize::MAX)));
            paths.push(path);
        }
    }
    let own = plain(&file);
    let mut texts = folder.found.texts;
    texts.push((own.clone(), text));
    let bundle = Bundle {
        arguments: given,
        as_written: arguments.as_written,
        base: arguments.base.clone(),
        convention: arguments.convention.map(|c| Convention::from(c).name()),
        meshes,
        name: own,
        packages: folder.found.packages,
        texts,
        tip: arguments.tip.clone(),
    };
    Ok((bundle, paths))
}

/// A mesh, and the files of data beside one that is glTF.
fn with_data(key: String, path: PathBuf) -> Vec<(String, PathBuf)> {
    let is_gltf = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("gltf"));
    let folder = path.parent().filter(|_| is_gltf).and_then(|f| fs::read_dir(f).ok());
    let beside = folder.into_iter().flatten().filter_map(Result::ok).filter(|e| {
        let is_file = e.file_type().is_ok_and(|t| t.is_file());
        is_file && e.path().extension().is_some_and(|x| x.eq_ignore_ascii_case("bin"))
    });
    let top = key.rsplit_once('/').map_or(String::new(), |(folder, _)| format!("{folder}/"));
    let data = beside.map(|e| (format!("{top}{}", e.file_name().to_string_lossy()), e.path()));
    let mut all: Vec<(String, PathBuf)> = data.collect();
    all.sort();
    all.insert(0, (key, path));
    all
}
