//! Names, kinds of files, and findings in the files that files name.

use denavit::description::{Language, TableKind};
use denavit_load::{Content, Kind, Options, Problem, catalogue_name, close_names, listed, read, read_text};
use std::fs;
use std::path::PathBuf;

fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

#[test]
fn kinds_by_ending_or_root_element() {
    for (name, kind) in [
        ("arm.toml", Some(Kind::Robot)),
        ("arm.md", Some(Kind::Table(TableKind::Markdown))),
        ("arm.tsv", Some(Kind::Table(TableKind::Csv))),
        ("arm.tex", Some(Kind::Table(TableKind::Latex))),
        ("arm.urdf.xacro", Some(Kind::Bodies)),
        ("arm.par", Some(Kind::Par)),
        ("arm.m", Some(Kind::Program(Language::Matlab))),
        ("-", Some(Kind::Table(TableKind::Markdown))),
        ("arm", None),
        ("arm.pdf", None),
    ] {
        assert_eq!(Kind::of(name), kind, "{name}");
    }
    let file = folder("kinds").join("arm.description");
    fs::write(&file, "<?xml version='1.0'?><robot name='r'/>").expect("written");
    assert_eq!(Kind::of(&file.to_string_lossy()), Some(Kind::Bodies));
    fs::write(&file, "<html/>").expect("written");
    assert_eq!(Kind::of(&file.to_string_lossy()), None);
}

#[test]
fn names_of_the_catalogue() {
    assert_eq!(catalogue_name("Staubli RX90").as_deref(), Some("staubli-rx90"));
    assert_eq!(catalogue_name("ur5.toml"), None);
    assert!(listed("ur5").is_some() && listed("ur-5").is_none());
    assert!(close_names("ur-5").contains(&"ur5"));
    assert!(close_names("x").is_empty());
}

#[test]
fn findings_are_placed_in_the_file_they_are_in() {
    let folder = folder("findings");
    let part = "<robot xmlns:xacro='http://ros.org/wiki/xacro'>\n  <link name='a'/>\n  <joint name='j' type='wobbly'>\
                <parent link='a'/><child link='b'/></joint>\n  <link name='b'/>\n</robot>";
    fs::write(folder.join("part.xacro"), part).expect("written");
    let whole = "<robot name='r' xmlns:xacro='http://ros.org/wiki/xacro'>\n<xacro:include filename='part.xacro'/>\n</robot>";
    let name = folder.join("whole.urdf.xacro");
    fs::write(&name, whole).expect("written");
    let Err(Problem::Errors(findings)) = read(&name.to_string_lossy(), Kind::Bodies, &Options::default())
    else {
        panic!("a joint that wobbles");
    };
    let error = findings.iter().find(|f| f.is_error()).expect("an error");
    assert!(error.name.ends_with("part.xacro"), "{}", error.name);
    let place = &error.text[error.diagnostic.span.clone()];
    assert!(
        error.diagnostic.message.contains("wobbly") || place.contains("wobbly"),
        "{:?}",
        error.diagnostic
    );
}

#[test]
fn what_cannot_be_read() {
    let missing = read("no/such.toml", Kind::Robot, &Options::default());
    assert!(matches!(missing, Err(Problem::Unreadable(_))));
    let name = folder("mjcf").join("arm.xml");
    fs::write(&name, "<mujoco><worldbody/></mujoco>").expect("written");
    let given = Options { arguments: vec![("a".into(), "1".into())], ..Options::default() };
    let refused = read(&name.to_string_lossy(), Kind::Bodies, &given);
    assert!(matches!(refused, Err(Problem::TakesNoArguments)));
    let name = folder("rows").join("arm.csv");
    fs::write(&name, "theta,d,a,alpha\nq1,0,1,0\n").expect("written");
    let mut options = Options::default();
    options.table.convention = Some(denavit::description::Convention::Standard);
    let read =
        read(&name.to_string_lossy(), Kind::of("arm.csv").expect("a table"), &options).expect("a robot");
    assert!(matches!(read.content, Content::Rows(_)));
}

#[test]
fn texts_are_read_as_what_they_look_like() {
    let urdf = "<?xml version='1.0'?><robot name='r'><link name='a'/></robot>";
    let toml = "name = 'r'\nconvention = 'craig'\n[[joints]]\ntheta = 'q1'\n";
    let table = "| theta | d | a | alpha |\n|---|---|---|---|\n| q1 | 0 | 1 | 0 |\n";
    for (text, kind) in [
        (urdf, Kind::Bodies),
        (toml, Kind::Robot),
        (table, Kind::Table(TableKind::Markdown)),
        ("", Kind::Table(TableKind::Markdown)),
    ] {
        assert_eq!(Kind::of_text(text), kind, "{text}");
    }
    let read = read_text("mine", toml.into(), Kind::Robot, &Options::default()).expect("a robot");
    assert_eq!(read.content.chain("mine", None, None, None, None).map(|c| c.0.variables().len()), Ok(1));
    let wrong = read_text("mine", toml.replace("q1", "q1 +").into(), Kind::Robot, &Options::default());
    let Err(Problem::Errors(findings)) = wrong else { panic!("a sum that breaks off") };
    assert_eq!(findings.first().map(|f| (&*f.name, f.is_error())), Some(("mine", true)));
    let packages = vec![("p".into(), "no/such/folder".into())];
    let nowhere = read_text("mine", urdf.into(), Kind::Bodies, &Options { packages, ..Options::default() });
    assert!(matches!(nowhere, Err(Problem::NoFolder(_))));
}
