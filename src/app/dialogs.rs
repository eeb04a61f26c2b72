//! The system's file dialogs.

use std::path::PathBuf;
use std::pin::Pin;
use std::sync::Arc;

/// A dialog that is to be opened.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Dialog {
    /// Its title.
    pub title: &'static str,
    /// The kinds of files that it offers, each with the endings of their names.
    pub filters: Vec<(&'static str, Vec<&'static str>)>,
    /// The folder in which it begins.
    pub folder: Option<PathBuf>,
    /// What is chosen in it.
    pub choice: Choice,
}

/// What is chosen in a dialog.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Choice {
    /// A file that is there.
    File,
    /// Any number of them.
    Files,
    /// The name of a file that is to be written; this one is proposed.
    Name(String),
}

/// The chosen files, once the person has answered; none: nothing was wanted.
pub type Answer = Pin<Box<dyn Future<Output = Vec<PathBuf>> + Send>>;

/// What opens dialogs; the tests answer them in place of [`system`].
pub type Dialogs = Arc<dyn Fn(Dialog) -> Answer + Send + Sync>;

/// Opens a dialog of the system.
pub fn system(dialog: Dialog) -> Answer {
    let mut asked = rfd::AsyncFileDialog::new().set_title(dialog.title);
    if let Some(folder) = &dialog.folder {
        asked = asked.set_directory(folder);
    }
    for (name, endings) in &dialog.filters {
        asked = asked.add_filter(*name, endings);
    }
    let path = |file: rfd::FileHandle| file.path().to_owned();
    // Futures are made here, not where they are waited for, because some systems open dialogs only from this thread.
    match dialog.choice {
        Choice::File => {
            let chosen = asked.pick_file();
            Box::pin(async move { chosen.await.map(path).into_iter().collect() })
        }
        Choice::Files => {
            let chosen = asked.pick_files();
            Box::pin(async move { chosen.await.unwrap_or_default().into_iter().map(path).collect() })
        }
        Choice::Name(proposed) => {
            let chosen = asked.set_file_name(proposed).save_file();
            Box::pin(async move { chosen.await.map(path).into_iter().collect() })
        }
    }
}
