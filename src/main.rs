//! `hachure`: see `hachure --help`.

use std::process::ExitCode;

fn main() -> ExitCode {
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
