//! Robots: from the catalogue, from files, texts and tables; what they are.

#![allow(unsafe_code, clippy::missing_safety_doc)] // functions of C; what pointers have to be stands in `lib.rs`

use super::error::shown;
use super::objects::Robot;
use crate::border::{Place, array, give, object, optional, optional_text, take, text};
use crate::dh::Table;
use crate::loading::{Request, Source};
use crate::robot::Core;
use crate::trouble::{Trouble, guarded};
use crate::types::{Code, Convention as Named, Finding, Joint, JointKind, Options, Pose, Status};
use denavit::description::{Convention, TableOptions};
use denavit_load as load;
use std::ffi::{CString, c_char};
use std::ptr;
use std::sync::{Arc, OnceLock};

/// The names of the catalogue: arms, then structures, which are trees.
fn names() -> &'static [CString] {
    static NAMES: OnceLock<Vec<CString>> = OnceLock::new();
    let all = || denavit::catalogue::names().into_iter().chain(denavit::catalogue::structures());
    NAMES.get_or_init(|| all().map(crate::trouble::text).collect())
}

/// How many robots the catalogue has.
#[unsafe(no_mangle)]
pub extern "C" fn denavit_catalogue_length() -> usize {
    names().len()
}

/// The name of robot `index` of the catalogue. The text is always there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_catalogue(index: usize, name: *mut *const c_char) -> Status {
    guarded(|| unsafe {
        let place = Place::new(name, "name")?;
        let found = names().get(index).ok_or_else(|| index_error("the catalogue", index, names().len()))?;
        place.put(found.as_ptr());
        Ok(Status::Ok)
    })
}

/// What is said of an index that is too large.
pub fn index_error(of: &str, index: usize, count: usize) -> Trouble {
    Trouble::new(Status::BadArgument, format!("{of}: there is no {index}; there are {count}, counted from 0"))
}

fn convention(code: Code<Named>) -> Result<Option<Convention>, Trouble> {
    Ok(match code.meant() {
        Some(Named::None) => None,
        Some(Named::Standard) => Some(Convention::Standard),
        Some(Named::Craig) => Some(Convention::Craig),
        Some(Named::Khalil) => Some(Convention::Khalil),
        None => return Err(Trouble::new(Status::BadArgument, format!("no convention {}", code.0))),
    })
}

/// A request with options, or usual ones.
unsafe fn request(source: Source, options: *const Options) -> Result<Request, Trouble> {
    let Some(given) = (unsafe { optional(options, "options") })? else {
        return Ok(Request { source, options: load::Options::default(), base: None, tip: None });
    };
    let unit = |code: i32, name: &str| match code {
        0 => Ok(None),
        1 => Ok(Some(false)),
        2 => Ok(Some(true)),
        _ => Err(Trouble::new(Status::BadArgument, format!("options.{name}: {code} is not 0, 1 or 2"))),
    };
    let owned = |pointer, name: &str| -> Result<Option<String>, Trouble> {
        Ok(unsafe { optional_text(pointer, name) }?.map(str::to_string))
    };
    let pairs = |pointer, length: usize, name: &str| -> Result<Vec<(String, String)>, Trouble> {
        if length % 2 == 1 {
            let why = format!("options.{name}: {length} texts; a name and a value each are needed");
            return Err(Trouble::new(Status::WrongLength, why));
        }
        let all: &[*const c_char] = unsafe { array(pointer, length, name) }?;
        let texts = all.iter().map(|&t| unsafe { text(t, name) }.map(str::to_string));
        let texts = texts.collect::<Result<Vec<String>, Trouble>>()?;
        Ok(texts.chunks_exact(2).map(|pair| (pair[0].clone(), pair[1].clone())).collect())
    };
    let packages = pairs(given.packages, given.packages_length, "packages")?;
    Ok(Request {
        source,
        options: load::Options {
            arguments: pairs(given.arguments, given.arguments_length, "arguments")?,
            as_written: given.as_written != 0,
            packages: packages.into_iter().map(|(name, path)| (name, path.into())).collect(),
            table: TableOptions {
                convention: convention(given.convention)?,
                angles_in_degrees: unit(given.angles, "angles")?,
                lengths_in_millimetres: unit(given.lengths, "lengths")?,
                table: (given.table > 0).then_some(given.table),
                columns: owned(given.columns, "options.columns")?,
            },
        },
        base: owned(given.base, "options.base")?,
        tip: owned(given.tip, "options.tip")?,
    })
}

unsafe fn hand_over(robot: *mut *mut Robot, made: Result<Core, Trouble>) -> Result<Status, Trouble> {
    unsafe { give(&Place::new(robot, "robot")?, Robot(Arc::new(made?))) };
    Ok(Status::Ok)
}

/// A robot of the catalogue, by its name: `ur5`. `options` may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_robot_catalogue(
    name: *const c_char,
    options: *const Options,
    robot: *mut *mut Robot,
) -> Status {
    guarded(|| unsafe {
        Place::new(robot, "robot")?;
        let source = Source::Catalogue(text(name, "name")?.into());
        hand_over(robot, Core::load(request(source, options)?))
    })
}

/// A robot from a file: a robot file (.toml, .par), a URDF, xacro or MJCF, a table in Markdown, CSV or LaTeX, or a program (.py, .m), which
/// is read and not run. `options` may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_robot_file(
    path: *const c_char,
    options: *const Options,
    robot: *mut *mut Robot,
) -> Status {
    guarded(|| unsafe {
        Place::new(robot, "robot")?;
        let source = Source::File(text(path, "path")?.into());
        hand_over(robot, Core::load(request(source, options)?))
    })
}

/// A robot from `length` bytes of text, which need no end. `format` is the ending that a file of it would have (`urdf`, `toml`, `md`,
/// `csv`, …); null: bodies by the root element, a robot file by its heads, else a table of Markdown. Files that it names are looked for in
/// the working folder and in packages. `options` may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_robot_text(
    text: *const c_char,
    length: usize,
    format: *const c_char,
    options: *const Options,
    robot: *mut *mut Robot,
) -> Status {
    guarded(|| unsafe {
        Place::new(robot, "robot")?;
        let bytes: &[u8] = array(text.cast(), length, "text")?;
        let all = String::from_utf8_lossy(bytes).into_owned();
        let format = optional_text(format, "format")?.map(str::to_string);
        hand_over(robot, Core::load(request(Source::Text(all, format), options)?))
    })
}

/// A robot from a Denavit-Hartenberg table in numbers, metres and radians. Each of its `rows` has 4 cells in the order of the convention:
/// `cells_length` is 4 times `rows`. `kinds` says of each row how it moves (`DENAVIT_REVOLUTE`, `DENAVIT_PRISMATIC`, `DENAVIT_FIXED`); the
/// joint variable is added to the cell that it moves. `limits` has the lowest and the highest value of each row (`limits_length` is twice
/// `rows`; not finite: no limits); it may be null with length 0. `base` is frame 0 in the base, `tool` the tool in the last frame; each may be
/// null. A number that is the nearest double to a multiple of pi/12 is that angle exactly.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)] // arrays with their lengths
pub unsafe extern "C" fn denavit_robot_table(
    convention: Code<Named>,
    rows: usize,
    cells: *const f64,
    cells_length: usize,
    kinds: *const Code<JointKind>,
    kinds_length: usize,
    limits: *const f64,
    limits_length: usize,
    base: *const Pose,
    tool: *const Pose,
    robot: *mut *mut Robot,
) -> Status {
    guarded(|| unsafe {
        Place::new(robot, "robot")?;
        let cells = array(cells, cells_length, "cells")?;
        let kinds: &[Code<JointKind>] = array(kinds, kinds_length, "kinds")?;
        let limits = array(limits, limits_length, "limits")?;
        let wanted = |name, given, wanted: Option<usize>| match wanted {
            Some(wanted) if wanted == given => Ok(()),
            _ => Err(Trouble::length(name, given, wanted.unwrap_or(usize::MAX))),
        };
        wanted("cells", cells.len(), rows.checked_mul(4))?;
        wanted("kinds", kinds.len(), Some(rows))?;
        if !limits.is_empty() {
            wanted("limits", limits.len(), rows.checked_mul(2))?;
        }
        let kind = |code: &Code<JointKind>| {
            code.meant().ok_or_else(|| Trouble::new(Status::BadArgument, format!("no kind {}", code.0)))
        };
        let convention = convention.meant();
        let table = Table {
            convention: convention.ok_or_else(|| Trouble::new(Status::BadArgument, "no such convention"))?,
            cells: cells.as_chunks().0,
            kinds: kinds.iter().map(kind).collect::<Result<_, _>>()?,
            limits: (!limits.is_empty()).then_some(limits.as_chunks().0),
            base: optional(base, "base")?,
            tool: optional(tool, "tool")?,
        };
        let source = Source::Text(table.text()?, Some("toml".into()));
        hand_over(robot, Core::load(request(source, ptr::null())?))
    })
}

/// Another chain of what a robot was read from: from `base` to `tip`, each a link or frame, or null. Its file is read again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_robot_chain(
    robot: *const Robot,
    base: *const c_char,
    tip: *const c_char,
    chain: *mut *mut Robot,
) -> Status {
    guarded(|| unsafe {
        Place::new(chain, "chain")?;
        let core = &object(robot, "robot")?.0;
        hand_over(chain, core.chain(optional_text(base, "base")?, optional_text(tip, "tip")?))
    })
}

/// The same robot with a value for a parameter of its table, metres or radians.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_robot_set(
    robot: *const Robot,
    name: *const c_char,
    value: f64,
    changed: *mut *mut Robot,
) -> Status {
    guarded(|| unsafe {
        Place::new(changed, "changed")?;
        crate::solver::finite(&[value], "value")?;
        hand_over(changed, object(robot, "robot")?.0.set(text(name, "name")?, value))
    })
}

/// Frees a robot.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_robot_free(robot: *mut Robot) {
    unsafe { take(robot) }
}

/// The robot's name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_robot_name(robot: *const Robot, name: *mut *const c_char) -> Status {
    guarded(|| unsafe {
        let core = &object(robot, "robot")?.0;
        Place::new(name, "name")?.put(core.facts.name.as_ptr());
        Ok(Status::Ok)
    })
}

/// The robot as the text of a robot file (TOML), exact: `denavit_robot_text` reads it again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_robot_toml(robot: *const Robot, toml: *mut *const c_char) -> Status {
    guarded(|| unsafe {
        let core = &object(robot, "robot")?.0;
        Place::new(toml, "toml")?.put(core.facts.text.as_ptr());
        Ok(Status::Ok)
    })
}

/// The convention of the robot's table.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_robot_convention(
    robot: *const Robot,
    convention: *mut Code<Named>,
) -> Status {
    guarded(|| unsafe {
        let named = match object(robot, "robot")?.0.facts.convention {
            Convention::Standard => Named::Standard,
            Convention::Craig => Named::Craig,
            Convention::Khalil => Named::Khalil,
        };
        Place::new(convention, "convention")?.put(named.into());
        Ok(Status::Ok)
    })
}

/// How many joints the robot has: the length of q.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_robot_joints(robot: *const Robot, joints: *mut usize) -> Status {
    guarded(|| unsafe {
        let core = &object(robot, "robot")?.0;
        Place::new(joints, "joints")?.put(core.joints());
        Ok(Status::Ok)
    })
}

/// Joint `index`, from 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_robot_joint(robot: *const Robot, index: usize, joint: *mut Joint) -> Status {
    guarded(|| unsafe {
        let core = &object(robot, "robot")?.0;
        let place = Place::new(joint, "joint")?;
        let found = core.facts.joints.get(index);
        let found = found.ok_or_else(|| index_error("joints", index, core.joints()))?;
        let [lower, upper] = found.limits.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
        place.put(Joint {
            variable: found.variable.as_ptr(),
            name: found.name.as_ref().map_or(ptr::null(), |n| n.as_ptr()),
            kind: found.kind.into(),
            limited: found.limits.is_some().into(),
            lower,
            upper,
            velocity: found.velocity.unwrap_or(f64::INFINITY),
        });
        Ok(Status::Ok)
    })
}

/// Which joint has a name: its variable, or what the description calls it; or its number from 1.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_robot_find_joint(
    robot: *const Robot,
    name: *const c_char,
    index: *mut usize,
) -> Status {
    guarded(|| unsafe {
        let (core, name) = (&object(robot, "robot")?.0, text(name, "name")?);
        let place = Place::new(index, "index")?;
        let no = |why| Trouble::new(Status::BadArgument, why);
        place.put(core.derive(|d| load::joint(d, name).map_err(no))?);
        Ok(Status::Ok)
    })
}

/// How many frames the robot's table has: one more than rows. The tool is none of them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_robot_frames(robot: *const Robot, frames: *mut usize) -> Status {
    guarded(|| unsafe {
        let core = &object(robot, "robot")?.0;
        Place::new(frames, "frames")?.put(core.frames());
        Ok(Status::Ok)
    })
}

/// Which frame has a name: that of its row, or its number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_robot_find_frame(
    robot: *const Robot,
    name: *const c_char,
    frame: *mut i32,
) -> Status {
    guarded(|| unsafe {
        let (core, name) = (&object(robot, "robot")?.0, text(name, "name")?);
        let place = Place::new(frame, "frame")?;
        let no = |why| Trouble::new(Status::BadArgument, why);
        let found = core.derive(|d| load::frame(d, name).map_err(no))?;
        place.put(i32::try_from(found).unwrap_or(i32::MAX));
        Ok(Status::Ok)
    })
}

/// Whether the description says something of masses: 1 or 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_robot_has_masses(robot: *const Robot, has_masses: *mut i32) -> Status {
    guarded(|| unsafe {
        let core = &object(robot, "robot")?.0;
        Place::new(has_masses, "has_masses")?.put(core.facts.has_masses.into());
        Ok(Status::Ok)
    })
}

/// How many warnings and notes the description of a robot gave.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_robot_findings(robot: *const Robot, findings: *mut usize) -> Status {
    guarded(|| unsafe {
        let core = &object(robot, "robot")?.0;
        Place::new(findings, "findings")?.put(core.facts.findings.len());
        Ok(Status::Ok)
    })
}

/// Warning or note `index` of a robot's description.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_robot_finding(
    robot: *const Robot,
    index: usize,
    finding: *mut Finding,
) -> Status {
    guarded(|| unsafe {
        let all = &object(robot, "robot")?.0.facts.findings;
        let place = Place::new(finding, "finding")?;
        place.put(shown(all.get(index).ok_or_else(|| index_error("findings", index, all.len()))?));
        Ok(Status::Ok)
    })
}
