//! The `denavit` command: arguments, files, colours, exit codes. The science is in the crate `denavit`.

mod arguments;
mod commands;
mod failure;
mod load;
mod terminal;

use arguments::Command;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = arguments::arguments();
    if arguments.quiet {
        terminal::be_quiet();
    }
    let done = match arguments.command {
        Command::Robots(a) => commands::robots::run(&a),
        Command::Show(a) => commands::show::run(&a),
        Command::Convert(a) => commands::convert::run(&a),
        Command::Fk(a) => commands::fk::run(&a),
        Command::Ik(a) => commands::ik::run(&a),
        Command::Jacobian(a) => commands::jacobian::run(&a),
        Command::Dynamics(a) => commands::dynamics::run(&a),
        Command::Identify(a) => commands::identify::run(&a),
        Command::Path(a) => commands::path::run(&a),
        #[cfg(feature = "parquet")]
        Command::Map(a) => commands::map::run(&a),
        Command::Derive(a) => commands::derive::run(&a),
        Command::Report(a) => commands::report::run(&a),
        Command::Exercise(a) => commands::exercise::run(&a),
        Command::Check(a) => commands::check::run(a),
        Command::Calibrate(a) => commands::calibrate::run(&a),
        Command::Generate(a) => commands::generate::run(&a),
        Command::View(a) => commands::view::run(&a),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
