//! The header `denavit.h`, made of the functions and types of `crates/ffi` and of what is said of them.
//!
//! It reads Rust as rustfmt writes it, as much of it as stands in those files: enumerations with numbers, structures for C, opaque ones,
//! constants, functions for C.

use crate::path;
use anyhow::{Context, Result, bail};
use std::fmt::Write as _;
use std::fs;

/// Where it lies.
pub const HEADER: &str = "crates/ffi/include/denavit.h";
const SOURCES: &str = "crates/ffi/src";
/// What is seen from C, in the order in which it stands in the header.
const FILES: [&str; 8] =
    ["types", "c/objects", "c/error", "c/robot", "c/kinematics", "c/dynamics", "c/solver", "c/answer"];
/// The longest line.
const WIDTH: usize = 120;

/// Compares the header with the source, or renews it. The names of its functions.
///
/// # Errors
/// If it is not up to date, or something in the source is not understood.
pub fn check(write: bool) -> Result<Vec<String>> {
    let made = made()?;
    let file = path(HEADER);
    if write {
        fs::create_dir_all(file.parent().context("a folder")?)?;
        fs::write(&file, &made.text)?;
    } else if fs::read_to_string(&file).unwrap_or_default() != made.text {
        bail!("{HEADER} is not up to date: cargo xtask c --write");
    }
    Ok(made.functions)
}

/// A header.
#[derive(Default)]
struct Header {
    text: String,
    functions: Vec<String>,
}

fn made() -> Result<Header> {
    let read =
        |name: &str| fs::read_to_string(path(&format!("{SOURCES}/{name}.rs"))).context(name.to_string());
    let mut header = Header { text: opening(&read("lib")?), ..Header::default() };
    let texts = FILES.map(read);
    let texts: Vec<String> = texts.into_iter().collect::<Result<_>>()?;
    for text in &texts {
        header.file(text)?;
    }
    header.text += "\n#ifdef __cplusplus\n}\n#endif\n\n#endif\n";
    Ok(header)
}

/// What stands before everything else, with what the library says of itself.
fn opening(lib: &str) -> String {
    let about: Vec<&str> = lib.lines().map_while(|l| l.strip_prefix("//!")).map(str::trim_start).collect();
    let mut text = comment(&about, "");
    text.insert_str(text.find('\n').map_or(0, |at| at + 1), " * denavit.h\n *\n");
    text + "\
#ifndef DENAVIT_H
#define DENAVIT_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern \"C\" {
#endif
"
}

/// A comment of these lines, which are filled anew.
fn comment(lines: &[&str], indent: &str) -> String {
    let mut text = format!("{indent}/**\n");
    for paragraph in lines.split(|l| l.is_empty()) {
        if text.ends_with('/') || paragraph.is_empty() {
            continue;
        }
        if text.len() > indent.len() + 4 {
            let _ = writeln!(text, "{indent} *");
        }
        let mut line = format!("{indent} *");
        for word in paragraph.iter().flat_map(|l| l.split(' ')) {
            if line.chars().count() + 1 + word.chars().count() > WIDTH {
                text += &std::mem::replace(&mut line, format!("{indent} *"));
                text.push('\n');
            }
            line.push(' ');
            line += word;
        }
        text += &line;
        text.push('\n');
    }
    let _ = writeln!(text, "{indent} */");
    // One line is enough for one.
    let body: Vec<&str> = text.lines().collect();
    match body[..] {
        [_, line, _] if line.chars().count() + 5 <= WIDTH => {
            format!("{indent}/**{} */\n", line.trim_start().trim_start_matches('*'))
        }
        _ => text,
    }
}

/// `NotARotation` as `not_a_rotation`.
fn snake(name: &str) -> String {
    let mut text = String::new();
    for c in name.chars() {
        if c.is_uppercase() && !text.is_empty() {
            text.push('_');
        }
        text.extend(c.to_lowercase());
    }
    text
}

/// What begins the names of an enumeration's values: statuses, kinds and conventions are what they are called.
fn prefix(of: &str) -> &'static str {
    match of {
        "Doubt" => "DENAVIT_DOUBT_",
        "Goal" => "DENAVIT_GOAL_",
        "Function" => "DENAVIT_FUNCTION_",
        "Convention" => "DENAVIT_CONVENTION_",
        "FindingSeverity" => "DENAVIT_FINDING_",
        _ => "DENAVIT_",
    }
}

/// A declaration of C: `double matrix[4][4]`, `const denavit_pose *pose`.
fn declared(rust: &str, name: &str) -> Result<String> {
    if let Some(inner) = rust.strip_prefix('[') {
        let mut inner = inner.strip_suffix(']').context("an array ends")?;
        let mut sizes = String::new();
        loop {
            let (element, size) = inner.rsplit_once("; ").context("an array has a length")?;
            let _ = write!(sizes, "[{size}]");
            let Some(next) = element.strip_prefix('[').and_then(|e| e.strip_suffix(']')) else {
                return declared(element, &format!("{name}{sizes}"));
            };
            inner = next;
        }
    }
    if let Some(to) = rust.strip_prefix("*const ") {
        return match to.starts_with('*') {
            true => declared(to, &format!("const *{name}")),
            false => Ok(format!("const {}", declared(to, &format!("*{name}"))?)),
        };
    }
    if let Some(to) = rust.strip_prefix("*mut ") {
        return declared(to, &format!("*{name}"));
    }
    let rust = rust.strip_prefix("Code<").and_then(|r| r.strip_suffix('>')).unwrap_or(rust);
    let own;
    let c = match rust {
        "f64" => "double",
        "usize" => "size_t",
        "i32" => "int32_t",
        "u32" => "uint32_t",
        "u64" => "uint64_t",
        "c_char" => "char",
        // Imported under another name.
        "Named" => "denavit_convention",
        _ if rust.chars().all(char::is_alphanumeric) && rust.starts_with(char::is_uppercase) => {
            own = format!("denavit_{}", snake(rust));
            &own
        }
        _ => bail!("no type of C: {rust}"),
    };
    Ok(format!("{c} {name}"))
}

impl Header {
    /// All that a file has.
    fn file(&mut self, text: &str) -> Result<()> {
        let mut lines = text.lines();
        let about = lines.next().and_then(|l| l.strip_prefix("//! ")).context("a file says what it is")?;
        let _ = write!(self.text, "\n\n/* {about} */\n");
        let (mut doc, mut marks): (Vec<&str>, Vec<&str>) = (vec![], vec![]);
        while let Some(line) = lines.next() {
            if let Some(words) = line.strip_prefix("///") {
                doc.push(words.trim_start());
            } else if line.starts_with("#[") {
                marks.push(line);
            } else {
                let mut whole = line.to_string();
                let is_function = line.contains(" extern \"C\" fn ");
                while is_function && !whole.ends_with('{') {
                    whole += " ";
                    whole += lines.next().context("a function goes on")?.trim();
                }
                if is_function && marks.contains(&"#[unsafe(no_mangle)]") {
                    self.function(&whole, &doc)?;
                } else if let Some(name) = named(line, "pub enum ") {
                    if marks.contains(&"#[repr(i32)]") {
                        self.enumeration(name, &doc, &mut lines)?;
                    }
                } else if let Some(name) = named(line, "pub struct ") {
                    self.structure(name, &doc, &marks, line, &mut lines)?;
                } else if let Some(constant) = line.strip_prefix("pub const ") {
                    let (name, value) = constant.split_once(": i32 = ").context("a constant is an i32")?;
                    let value = value.trim_end_matches(';');
                    let _ = write!(self.text, "\n{}enum {{ {name} = {value} }};\n", comment(&doc, ""));
                }
                (doc, marks) = (vec![], vec![]);
            }
        }
        Ok(())
    }

    fn enumeration<'a>(
        &mut self,
        name: &str,
        doc: &[&str],
        lines: &mut impl Iterator<Item = &'a str>,
    ) -> Result<()> {
        let own = format!("denavit_{}", snake(name));
        let _ = write!(self.text, "\n{}typedef int32_t {own};\n\nenum {{\n", comment(doc, ""));
        let mut doc: Vec<&str> = vec![];
        let mut values = vec![];
        for line in lines.map(str::trim).take_while(|l| *l != "}") {
            if let Some(words) = line.strip_prefix("///") {
                doc.push(words.trim_start());
                continue;
            }
            let (variant, number) =
                line.trim_end_matches(',').split_once(" = ").context("a value has a number")?;
            let name = format!("{}{}", prefix(name), snake(variant).to_uppercase());
            values.push(format!("{}  {name} = {number}", comment(&doc, "  ")));
            doc.clear();
        }
        let _ = write!(self.text, "{}\n}};\n", values.join(",\n"));
        Ok(())
    }

    fn structure<'a>(
        &mut self,
        name: &str,
        doc: &[&str],
        marks: &[&str],
        line: &str,
        lines: &mut impl Iterator<Item = &'a str>,
    ) -> Result<()> {
        let own = format!("denavit_{}", snake(name));
        if marks.contains(&"#[repr(transparent)]") {
            return Ok(());
        }
        let _ = write!(self.text, "\n{}typedef struct {own} ", comment(doc, ""));
        if line.ends_with(';') {
            let _ = writeln!(self.text, "{own};");
            return Ok(());
        }
        self.text += "{\n";
        let mut doc: Vec<&str> = vec![];
        for line in lines.map(str::trim).take_while(|l| *l != "}") {
            if let Some(words) = line.strip_prefix("///") {
                doc.push(words.trim_start());
                continue;
            }
            let field = line.strip_prefix("pub ").and_then(|l| l.strip_suffix(',')).context("a field")?;
            let (name, kind) = field.split_once(": ").context("a field has a type")?;
            let _ = writeln!(self.text, "{}  {};", comment(&doc, "  "), declared(kind, name)?);
            doc.clear();
        }
        let _ = writeln!(self.text, "}} {own};");
        Ok(())
    }

    fn function(&mut self, line: &str, doc: &[&str]) -> Result<()> {
        let (_, rest) = line.split_once(" fn ").context("a function")?;
        let (name, rest) = rest.split_once('(').context("a function has arguments")?;
        let (arguments, result) = rest.rsplit_once(')').context("arguments end")?;
        let arguments = arguments.split(", ").map(str::trim).map(|a| a.trim_end_matches(','));
        let arguments = arguments.filter(|a| !a.is_empty()).map(|a| {
            let (name, kind) = a.split_once(": ").context("an argument has a type")?;
            declared(kind, name)
        });
        let arguments = arguments.collect::<Result<Vec<_>>>()?;
        let result = result.trim().trim_end_matches('{').trim().strip_prefix("-> ").unwrap_or("");
        let head = if result.is_empty() { format!("void {name}") } else { declared(result, name)? };
        let listed = if arguments.is_empty() { "void".to_string() } else { arguments.join(", ") };
        let mut text = format!("{head}({listed});");
        if text.chars().count() > WIDTH {
            text = format!("{head}(\n    {}\n);", arguments.join(",\n    "));
        }
        let _ = write!(self.text, "\n{}{text}\n", comment(doc, ""));
        self.functions.push(name.into());
        Ok(())
    }
}

/// The name of an item of a kind.
fn named<'a>(line: &'a str, kind: &str) -> Option<&'a str> {
    let rest = line.strip_prefix(kind)?;
    Some(&rest[..rest.find(|c: char| !c.is_alphanumeric()).unwrap_or(rest.len())])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn declarations_of_c() {
        for (rust, c) in [
            ("f64", "double x"),
            ("*const f64", "const double *x"),
            ("*mut Pose", "denavit_pose *x"),
            ("*mut *mut Robot", "denavit_robot **x"),
            ("*mut *const c_char", "const char **x"),
            ("*const *const c_char", "const char *const *x"),
            ("[[f64; 4]; 2]", "double x[2][4]"),
            ("Code<Goal>", "denavit_goal x"),
        ] {
            assert_eq!(declared(rust, "x").ok().as_deref(), Some(c), "{rust}");
        }
        assert!(declared("Option<f64>", "x").is_err());
    }

    #[test]
    fn an_enumeration_a_structure_and_a_function() {
        let text = "\
//! What.

/// How it ended.
#[repr(i32)]
#[derive(Debug)]
pub enum Status {
    /// Done.
    Ok = 0,
    /// No `pose`.
    NotARotation = -1,
}

/// An object.
pub struct Robot(Arc<Core>);

/// Does it.
#[unsafe(no_mangle)]
pub unsafe extern \"C\" fn denavit_do(
    robot: *const Robot,
    length: usize,
) -> Status {
    guarded()
}
";
        let mut header = Header::default();
        assert!(header.file(text).is_ok());
        let expected = "\n\n/* What. */\n
/** How it ended. */\ntypedef int32_t denavit_status;\n
enum {\n  /** Done. */\n  DENAVIT_OK = 0,\n  /** No `pose`. */\n  DENAVIT_NOT_A_ROTATION = -1\n};\n
/** An object. */\ntypedef struct denavit_robot denavit_robot;\n
/** Does it. */\ndenavit_status denavit_do(const denavit_robot *robot, size_t length);\n";
        assert_eq!(header.text, expected);
        assert_eq!(header.functions, ["denavit_do"]);
    }
}
