//! `denavit view`: the page, served to the browser of this machine.
//!
//! The page needs no server, but a browser lets a page that is a file start neither workers nor WebAssembly. So it is
//! served: to this machine alone, under an address that cannot be guessed, read only.

mod browser;
mod packing;
mod request;
mod response;
mod server;
mod site;
#[cfg(test)]
mod tests;

use crate::arguments::ViewArguments;
use crate::failure::Failure;
use crate::load;
use denavit_wire::Schema;
use denavit_wire::view::Served;
use server::{Bounds, Server};
use site::Site;
use std::io::Write;

/// Serves the page and says where, until the program is ended.
///
/// # Errors
/// If there is no such robot, no page, or the port is taken.
pub fn run(arguments: &ViewArguments) -> Result<(), Failure> {
    let robot = arguments.robot.as_ref().map(load::robot_file).transpose()?;
    let (site, name) = match &arguments.page {
        Some(folder) => {
            let name = folder.display().to_string();
            (Site::of_folder(folder).map_err(|e| Failure::Input(format!("error: {name}: {e}")))?, name)
        }
        None => (Site::embedded().ok_or_else(without_page)?, "the page".into()),
    };
    // The page opens a tree itself, so that another chain can be chosen there.
    let tree = arguments.robot.as_ref().filter(|r| r.set.is_empty() && load::is_tree(&r.robot));
    let site = match (tree.map(load::bundle).transpose()?, robot) {
        (Some((bundle, meshes)), _) => site.with_tree(&denavit_wire::text(&bundle), &meshes),
        (None, Some((_, text))) => site.with_robot(&text),
        (None, None) => Ok(site),
    };
    let site = site.map_err(|e| Failure::Input(format!("error: {name}: {e}")))?;
    let server = Server::bind(site, arguments.port, Bounds::default()).map_err(|e| match arguments.port {
        0 => Failure::Io(e),
        port => Failure::Usage(format!("--port {port}: {e}")),
    })?;
    let address = server.address();
    let mut out = anstream::stdout();
    if arguments.json {
        writeln!(out, "{}", denavit_wire::text(&Served { schema: Schema, url: address.clone() }))?;
    } else {
        writeln!(out, "{address}")?;
    }
    out.flush()?;
    writeln!(anstream::stderr(), "Ctrl-C ends it")?;
    if !arguments.no_open {
        browser::open(&address);
    }
    server.run()
}

fn without_page() -> Failure {
    let how = "run `cargo xtask web`, then build again";
    Failure::Unsupported(format!("this binary was built without the page: {how}"))
}
