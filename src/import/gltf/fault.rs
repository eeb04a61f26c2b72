//! What can go wrong inside the glTF importer, before the file's path is added.

use std::path::Path;

use crate::import::ImportError;
use crate::import::memory_budget::OverBudget;
use crate::import::source::SourceError;

/// A failure that ends the import.
#[derive(Debug)]
pub(super) enum Fault {
    /// See [`ImportError::Malformed`].
    Malformed(String),
    /// See [`ImportError::Unsupported`].
    Unsupported(String),
    /// See [`ImportError::Empty`].
    Empty(String),
    /// Already complete.
    Import(ImportError),
}

/// Short for the importer's results.
pub(super) type Result<T> = std::result::Result<T, Fault>;

impl Fault {
    /// The error for the file at `path`.
    pub(super) fn of_file(self, path: &Path) -> ImportError {
        let path = path.to_path_buf();
        match self {
            Self::Malformed(message) => ImportError::Malformed { path, message },
            Self::Unsupported(feature) => ImportError::Unsupported { path, feature },
            Self::Empty(reason) => ImportError::Empty { path, reason },
            Self::Import(error) => error,
        }
    }

    /// The same failure, with the place it happened at put before a message that needs one.
    pub(super) fn at(self, place: impl FnOnce() -> String) -> Self {
        match self {
            Self::Malformed(message) => Self::Malformed(format!("{}: {message}", place())),
            other => other,
        }
    }
}

impl From<ImportError> for Fault {
    fn from(error: ImportError) -> Self {
        Self::Import(error)
    }
}

impl From<SourceError> for Fault {
    fn from(error: SourceError) -> Self {
        match error {
            SourceError::Refused(message) => Self::Malformed(message),
            SourceError::Read { path, source } => Self::Import(ImportError::Read { path, source }),
        }
    }
}

impl From<OverBudget> for Fault {
    fn from(error: OverBudget) -> Self {
        Self::Malformed(error.to_string())
    }
}

/// Short for `Err(Fault::Malformed(…))`.
pub(super) fn malformed<T>(message: impl Into<String>) -> Result<T> {
    Err(Fault::Malformed(message.into()))
}
