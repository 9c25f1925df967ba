//! `denavit generate`: source code that builds and tests itself.

use crate::arguments::{GenerateArguments, LanguageName};
use crate::commands::dynamics::tree;
use crate::commands::fk::tree::bodies;
use crate::failure::Failure;
use crate::load::{self, Around, Tree};
use crate::terminal::{FAINT, HEADING, NAME, note, styled};
use denavit::description::{Description, MAX_XML_BYTES, read_srdf, render};
use denavit::dynamics::{Loads, NoProgram};
use denavit::inverse;
use denavit_emit::{Language, Precision};
use denavit_generate::{Generated, Inverse, Links, PackageOptions, Unable, Wanted, generate_ros2};
use denavit_wire::code::Written;
use std::fs;
use std::io::Write;
use std::path::Path;

/// Writes the files.
///
/// # Errors
/// If the robot cannot be read, a function is not known, a file stands in the way, or nothing can be written.
pub fn run(arguments: &GenerateArguments) -> Result<(), Failure> {
    let named =
        arguments.functions.as_deref().unwrap_or("fk,ik").split(',').map(str::trim).filter(|f| !f.is_empty());
    let functions: Result<Vec<Wanted>, String> = named.map(str::parse).collect();
    let mut functions = functions.map_err(|e| Failure::Usage(format!("--functions: {e}")))?;
    if functions.is_empty() {
        return Err(Failure::Usage("--functions names no function".into()));
    }
    if arguments.name.as_ref().is_some_and(|n| !n.contains(|c: char| c.is_alphanumeric())) {
        return Err(Failure::Usage("--name needs a letter or a digit".into()));
    }
    let mut seen = vec![];
    functions.retain(|f| {
        !seen.contains(f) && {
            seen.push(*f);
            true
        }
    });
    let of_group = group_chain(arguments)?;
    let arguments = of_group.as_ref().unwrap_or(arguments);
    let language: Language = arguments.language.into();
    if arguments.float && !matches!(language, Language::C | Language::Cuda) {
        return Err(Failure::Usage(format!("--float: {} computes in double precision", language.name())));
    }
    if let (true, Some(option)) = (is_package(arguments), not_in_package(arguments)) {
        return Err(Failure::Usage(format!("{option} is not for --language ros2")));
    }
    let generated = match arguments.whole {
        true => of_tree(arguments, functions, language),
        false => of_chain(arguments, functions, language),
    }?;
    if let Some(why) = &generated.refused {
        // What was asked for by its name is there, or nothing is.
        if generated.files.is_empty() || arguments.functions.is_some() || arguments.given.is_some() {
            return Err(Failure::Unsupported(format!("ik: {why}")));
        }
        note(&format!("warning: no ik: {why}"));
    }
    write(&generated, &arguments.output, arguments.force)?;
    for f in &generated.functions {
        if !f.is_proved && !matches!(f.wanted, Wanted::Dynamic(_)) {
            note(&format!("warning: {} is {}", f.wanted, f.claim));
        }
    }
    let mut out = anstream::stdout();
    let what = if is_package(arguments) { ROS2 } else { language.name() };
    if arguments.json {
        let written = Written { language: what, ..Written::of(&generated, language, &arguments.output) };
        writeln!(out, "{}", denavit_wire::text(&written))?;
    } else {
        let test = generated.test_command(language);
        write!(out, "{}", report(&generated, what, &test, &arguments.output))?;
    }
    Ok(())
}

/// Functions of a chain.
fn of_chain(
    arguments: &GenerateArguments,
    functions: Vec<Wanted>,
    language: Language,
) -> Result<Generated, Failure> {
    let (description, around) = load::robot_and_around(&arguments.robot)?;
    let given = arguments.given.as_deref().map(|words| joints(words, &description)).transpose()?;
    let options = PackageOptions {
        inverse: inverse::InverseOptions { goal: arguments.goal.into(), given },
        ..options(arguments, functions, language, &description.name)
    };
    if is_package(arguments) {
        return package(&description, &around, &options, arguments);
    }
    denavit_generate::generate(&description, &options).map_err(|why| refused(&why, arguments))
}

/// The arguments with base and tip of the group that they name.
fn group_chain(arguments: &GenerateArguments) -> Result<Option<GenerateArguments>, Failure> {
    let (Some(file), Some(name)) = (&arguments.srdf, &arguments.group) else { return Ok(None) };
    let Some(Tree::Bodies(mechanism)) = load::mechanism(&arguments.robot)? else {
        return Err(Failure::Usage("--srdf is for the groups of a URDF or MJCF".into()));
    };
    let text =
        load::contents(file, MAX_XML_BYTES).map_err(|e| Failure::Input(format!("error: {file}: {e}")))?;
    let (groups, findings) =
        read_srdf(&text).map_err(|errors| Failure::Input(render(&errors, file, &text)))?;
    note(render(&findings, file, &text).trim_end());
    let [base, tip] = mechanism
        .ends_of_group(&groups, name)
        .map_err(|why| Failure::Input(format!("error: {file}: {why}")))?;
    let mut own = arguments.clone();
    (own.robot.base, own.robot.tip) = (Some(base), Some(tip));
    Ok(Some(own))
}

/// What is written for `--language ros2`.
const ROS2: &str = "ROS 2 package";

fn is_package(arguments: &GenerateArguments) -> bool {
    matches!(arguments.language, LanguageName::Ros2)
}

/// An option that a package has no place for.
fn not_in_package(arguments: &GenerateArguments) -> Option<&'static str> {
    let given = [
        (arguments.whole, "--whole"),
        (arguments.float, "--float"),
        (arguments.wrench, "--wrench"),
        (arguments.payload, "--payload"),
        (arguments.masses.is_some(), "--masses"),
    ];
    given.into_iter().find(|g| g.0).map(|g| g.1)
}

/// A package for ROS 2.
fn package(
    description: &Description,
    around: &Around,
    options: &PackageOptions,
    arguments: &GenerateArguments,
) -> Result<Generated, Failure> {
    let file = &arguments.robot.robot;
    let Around::Bodies(both) = around else {
        return Err(Failure::Input(format!(
            "error: {file}: a package for ROS 2 needs the names of links and joints, which a table does not have\n  = hint: \
             give the URDF of the robot; `denavit convert {file} --to urdf` writes one"
        )));
    };
    let mut links = Links::new(&both.0, &both.1, description).map_err(|missing| {
        Failure::Input(format!("error: {file}: {missing}\n  = hint: give values with --set"))
    })?;
    links.group.clone_from(&arguments.group);
    generate_ros2(description, &links, options).map_err(|why| refused(&why, arguments))
}

/// Functions of a whole tree.
fn of_tree(
    arguments: &GenerateArguments,
    functions: Vec<Wanted>,
    language: Language,
) -> Result<Generated, Failure> {
    let file = &arguments.robot.robot;
    let tree = load::mechanism(&arguments.robot)?
        .ok_or_else(|| Failure::Usage(format!("--whole: {file} is no tree: leave it away")))?;
    let m = bodies(&tree, file)?;
    let options = options(arguments, functions, language, &m.name);
    denavit_generate::generate_tree(&m, &options).map_err(|why| refused(&why, arguments))
}

fn options(
    arguments: &GenerateArguments,
    functions: Vec<Wanted>,
    language: Language,
    title: &str,
) -> PackageOptions {
    PackageOptions {
        language,
        functions,
        inverse: inverse::InverseOptions { goal: arguments.goal.into(), given: None },
        precision: if arguments.float { Precision::Single } else { Precision::Double },
        name: Some(arguments.name.clone().unwrap_or_else(|| name_of(&arguments.robot.robot, title))),
        masses: arguments.masses.map(Into::into),
        loads: Loads { wrench: arguments.wrench, payload: arguments.payload },
        fixed: arguments.fixed,
    }
}

/// Why nothing is generated.
fn refused(why: &Unable, arguments: &GenerateArguments) -> Failure {
    Failure::Input(match why {
        Unable::Fixed(missing) if arguments.fixed => {
            format!("error: --fixed: {missing}\n  = hint: give values with --set")
        }
        Unable::Fixed(missing) => {
            format!(
                "error: IKFast's interface takes no parameters: {missing}\n  = hint: give values with --set"
            )
        }
        Unable::NotInInterface(_) => {
            let name = if is_package(arguments) { "ros2" } else { "ikfast" };
            format!(
                "error: --language {name}: {why}\n  = hint: --language c has all functions, and is C++ too"
            )
        }
        Unable::Program(NoProgram::Energy) => {
            format!("error: --masses base: {why}\n  = hint: leave energy out, or --masses links")
        }
        Unable::Program(NoProgram::Singular(_)) => format!(
            "error: {why}\n  = hint: give its link a mass and an inertia, or the joint a rotor, or leave acceleration out"
        ),
        Unable::Tree(why) => return tree::unknown(&arguments.robot.robot, why),
        Unable::OfChains(_) => {
            format!(
                "error: --whole: {why}\n  = hint: --tip names the end of a chain; a tree has torque, inertia, bias, gravity, \
                     acceleration, energy and derivatives"
            )
        }
        Unable::Payload => {
            format!(
                "error: --payload: {why}\n  = hint: --masses links takes its numbers beside those of the links"
            )
        }
        Unable::Loads { is_wrench } => {
            let load = if *is_wrench { "--wrench" } else { "--payload" };
            format!("error: {load}: {why}\n  = hint: torque, bias and acceleration do")
        }
        Unable::Masses(none) => {
            format!("error: --masses numbers: {none}\n  = hint: --masses links takes them as parameters")
        }
    })
}

/// Joint variables (from 0) by name or number.
fn joints(words: &str, description: &Description) -> Result<Vec<usize>, Failure> {
    let find = |word: &str| {
        crate::load::joint(description, word).map_err(|why| Failure::Usage(format!("--given: {why}")))
    };
    words.split(',').map(str::trim).filter(|w| !w.is_empty()).map(find).collect()
}

/// The catalogue's name or the file's stem; a table from standard input goes by the name in it.
fn name_of(robot: &str, title: &str) -> String {
    let stem = Path::new(robot).file_stem().and_then(|s| s.to_str()).unwrap_or(title);
    if robot == "-" { title.into() } else { stem.into() }
}

/// Writes all files or, if one would be overwritten, none.
fn write(generated: &Generated, folder: &Path, force: bool) -> Result<(), Failure> {
    let target = |path: &str| path.split('/').fold(folder.to_path_buf(), |p, part| p.join(part));
    let failed = |path: &Path, e: std::io::Error| Failure::Input(format!("error: {}: {e}", path.display()));
    let targets = || generated.files.iter().map(|f| (target(&f.path), f));
    if let Some((path, _)) = targets().find(|(path, _)| path.is_dir()) {
        return Err(Failure::Input(format!(
            "error: {}: a folder stands where a file should",
            path.display()
        )));
    }
    let differs = |path: &Path, text: &str| fs::read_to_string(path).ok().as_deref() != Some(text);
    let in_the_way: Vec<String> = targets()
        .filter(|(path, file)| !force && path.exists() && differs(path, &file.text))
        .map(|(path, _)| path.display().to_string())
        .collect();
    if !in_the_way.is_empty() {
        return Err(Failure::Input(format!(
            "error: these files are there already, with other contents: {}\n  = hint: --force overwrites them",
            in_the_way.join(", ")
        )));
    }
    for file in &generated.files {
        let path = target(&file.path);
        if let Some(parent) = path.parent() {
            if let Some(file) = parent.ancestors().find(|p| p.is_file()) {
                let file = file.display();
                return Err(Failure::Input(format!("error: {file}: a file stands where a folder should")));
            }
            fs::create_dir_all(parent).map_err(|e| failed(parent, e))?;
        }
        fs::write(&path, &file.text).map_err(|e| failed(&path, e))?;
    }
    Ok(())
}

fn report(generated: &Generated, what: &str, test: &str, folder: &Path) -> String {
    let mut text = format!("{} in {}\n", styled(what, HEADING), folder.display());
    for file in &generated.files {
        text += &format!(
            "  {}  {}\n",
            styled(&file.path, NAME),
            styled(&format!("{} lines", file.text.lines().count()), FAINT)
        );
    }
    for f in &generated.functions {
        text += &format!("{}: {}; {}\n", styled(f.wanted.name(), NAME), f.count, f.claim);
    }
    if let Some(ik) = &generated.inverse {
        text += &format!("{}: {}\n", styled("ik", NAME), in_words(ik));
    }
    text += &format!("test it there with: {test}\n");
    text
}

/// `closed form, at most 8 solutions (shoulder, wrist, elbow); q3 is given`
fn in_words(ik: &Inverse) -> String {
    let how = if ik.by_elimination { "by elimination" } else { "closed form" };
    let mut text = format!("{how}, at most {}", ik.at_most());
    if !ik.branches.is_empty() {
        text += &format!(" ({})", ik.branches.join(", "));
    }
    let given: Vec<String> = ik.given.iter().map(|s| s.name().to_string()).collect();
    if !given.is_empty() {
        text += &format!("; given: {}", given.join(", "));
    }
    if ik.given_by_choice {
        text += " (chosen here; --given chooses others)";
    }
    let assumed: Vec<String> = ik.assumed.iter().map(|(s, _)| s.name().to_string()).collect();
    if !assumed.is_empty() {
        text += &format!("; with the values of {} in it", assumed.join(", "));
    }
    text
}
