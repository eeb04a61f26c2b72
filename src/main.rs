//! Opens the window.

fn main() -> anyhow::Result<()> {
    env_logger::init();
    let files = std::env::args_os().skip(1).map(std::path::PathBuf::from).collect();
    Ok(hachure::app::run(files, None)?)
}
