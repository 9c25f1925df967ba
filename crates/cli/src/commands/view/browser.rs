//! The browser of this machine.

use std::process::{Command, Stdio};
use std::{env, thread};

/// Opens an address in the browser, if there is one; that there is none is no failure, for the address is printed.
///
/// Other people on the same machine may see the address in the list of processes while the browser starts. What it
/// gives them is the page and the robot to look at, and nothing that they could change.
pub fn open(address: &str) {
    let (program, arguments): (&str, &[&str]) = if cfg!(windows) {
        ("rundll32", &["url.dll,FileProtocolHandler"])
    } else if cfg!(target_os = "macos") {
        ("open", &[])
    } else {
        ("xdg-open", &[])
    };
    if !has_screen() {
        return;
    }
    let mut command = Command::new(program);
    command.args(arguments).arg(address);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    if let Ok(mut child) = command.spawn() {
        // Waited for, so that it leaves no entry in the list of processes.
        thread::spawn(move || child.wait());
    }
}

/// Without a screen `xdg-open` would start a browser for the terminal, which nobody asked for.
fn has_screen() -> bool {
    const SIGNS: [&str; 4] = ["DISPLAY", "WAYLAND_DISPLAY", "BROWSER", "WSL_DISTRO_NAME"];
    let names_its_screen = !cfg!(any(windows, target_os = "macos"));
    !names_its_screen || SIGNS.iter().any(|v| env::var_os(v).is_some_and(|v| !v.is_empty()))
}
