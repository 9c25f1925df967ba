//! Options that say something beside another alone. clap asks for that one, but not where a third option excludes it: there the
//! first would pass, and change nothing.

use super::Arguments;
use clap::error::ErrorKind;
use clap::parser::ValueSource;
use clap::{ArgMatches, Command, CommandFactory, FromArgMatches};

/// A verb, some of its options, and those of which one must be there with them.
type Needed = (&'static str, &'static [&'static str], &'static [&'static str]);

/// All of them, by the names of their fields.
const NEEDED: [Needed; 18] = [
    ("show", &["scheme", "q"], &["figure"]),
    ("ik", &["orientation"], &["pose"]),
    ("jacobian", &["orientation", "rates", "twist", "wrench", "hessian"], &["q"]),
    ("jacobian", &["damping", "wish"], &["twist"]),
    ("jacobian", &["torques"], &["wrench"]),
    ("jacobian", &["position"], &["explain"]),
    ("dynamics", &["tau_file", "dt", "step", "plot", "csv"], &["simulate"]),
    ("dynamics", &["simulate"], &["q"]),
    ("dynamics", &["derivatives"], &["q", "input"]),
    ("path", &["screw"], &["line"]),
    ("path", &["law"], &["joint"]),
    ("calibrate", &["robust", "folds", "group", "recipe", "unchecked"], &["file"]),
    ("calibrate", &["candidates", "seed"], &["choose"]),
    ("calibrate", &["offset"], &["distance"]),
    ("generate", &["srdf"], &["group"]),
    ("generate", &["group"], &["srdf"]),
    (
        "identify",
        &[
            "duration",
            "harmonics",
            "dt",
            "seed",
            "trials",
            "criterion",
            "range",
            "velocity",
            "acceleration",
            "torque",
        ],
        &["excite"],
    ),
    ("map", &["slots"], &["ik"]),
];

/// The arguments of this process, or an end with what is wrong about them.
pub fn arguments() -> Arguments {
    let mut command = Arguments::command();
    let matches = command.get_matches_mut();
    if let Some((verb, why)) = alone(&command, &matches) {
        let mut whole = Arguments::command();
        let of_verb = command.find_subcommand_mut(&verb).unwrap_or(&mut whole);
        of_verb.error(ErrorKind::MissingRequiredArgument, why).exit();
    }
    Arguments::from_arg_matches(&matches).unwrap_or_else(|why| why.exit())
}

/// Of which verb an option stands without the one that it is for, and which.
fn alone(command: &Command, matches: &ArgMatches) -> Option<(String, String)> {
    let (verb, given) = matches.subcommand()?;
    let command = command.find_subcommand(verb)?;
    let is_given = |id: &&str| given.value_source(id) == Some(ValueSource::CommandLine);
    let called = |id: &str| -> String {
        let argument = command.get_arguments().find(|a| a.get_id() == id);
        match argument.map(|a| (a.get_long(), a.get_value_names())) {
            Some((Some(long), _)) => format!("--{long}"),
            Some((None, Some([name, ..]))) => format!("<{name}>"),
            _ => id.into(),
        }
    };
    NEEDED.iter().filter(|n| n.0 == verb).find_map(|(_, options, needs)| {
        let option = options.iter().find(|o| is_given(o) && !needs.iter().any(is_given))?;
        let needs: Vec<String> = needs.iter().map(|n| called(n)).collect();
        Some((verb.to_string(), format!("{} is for {}", called(option), needs.join(" or "))))
    })
}

#[cfg(test)]
mod tests {
    use super::NEEDED;

    /// Every option of which clap asks so stands here.
    #[test]
    fn what_clap_asks_for_is_asked_for_always() {
        let files = [
            include_str!("mod.rs"),
            include_str!("calibrate.rs"),
            include_str!("convert.rs"),
            include_str!("dynamics.rs"),
            include_str!("exercise.rs"),
            include_str!("generate.rs"),
            include_str!("identify.rs"),
            include_str!("map.rs"),
            include_str!("path.rs"),
            include_str!("recording.rs"),
            include_str!("report.rs"),
            include_str!("view.rs"),
        ];
        let mut count = 0;
        for text in files {
            for part in text.split("requires = \"").skip(1) {
                let (needs, rest) = part.split_once('"').unwrap();
                let (_, rest) = rest.split_once("pub ").unwrap();
                let (option, _) = rest.split_once(':').unwrap();
                let is_known = NEEDED.iter().any(|n| n.1.contains(&option) && n.2.contains(&needs));
                assert!(is_known, "{option} requires {needs}");
                count += 1;
            }
        }
        assert!(count > 30, "{count}");
    }
}
