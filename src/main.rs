//! `hachure`: see `hachure --help`.

use std::process::ExitCode;

fn main() -> ExitCode {
    #[cfg(target_os = "linux")]
    quiet::name_a_runtime_folder();
    env_logger::Builder::from_env(env_logger::Env::default().default_filter_or("error")).init();
    match hachure::cli::run() {
        Ok(code) => {
            // The device and the driver's threads take a while to wind down; everything is written by now.
            std::process::exit(code)
        }
        Err(error) => {
            eprintln!("hachure: {error}");
            ExitCode::from(1)
        }
    }
}

/// Mesa's Vulkan layer looks for a Wayland session whenever somebody asks for adapters, and Wayland's library then says
/// `error: XDG_RUNTIME_DIR is invalid or not set` wherever there is no session: over ssh, in containers, in build jobs.
/// wgpu asks for Wayland's surfaces always, so this cannot be avoided, only answered.
#[cfg(target_os = "linux")]
mod quiet {
    use std::os::unix::process::CommandExt as _;
    use std::process::Command;

    const VARIABLE: &str = "XDG_RUNTIME_DIR";

    /// A folder where no session is, and where nobody can put anything.
    const NOWHERE: &str = "/nonexistent";

    /// Where no folder of a session is known, this program takes its own place, with the name of an empty one. The
    /// environment of a program that runs already is better left alone: other threads may read it at any time.
    pub(super) fn name_a_runtime_folder() {
        let is_named =
            std::env::var_os(VARIABLE).is_some_and(|folder| folder.as_encoded_bytes().starts_with(b"/"));
        let Ok(program) = std::env::current_exe() else { return };
        if !is_named {
            let mut arguments = std::env::args_os();
            let name = arguments.next().unwrap_or_else(|| program.clone().into());
            // It comes back only where it fails; then everything goes on with the complaint.
            let _ = Command::new(program).arg0(name).args(arguments).env(VARIABLE, NOWHERE).exec();
        }
    }
}
