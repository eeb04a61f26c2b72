//! What can go wrong inside the glTF importer, before the file's path is added.

use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::import::ImportError;
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

/// Short for `Err(Fault::Malformed(…))`.
pub(super) fn malformed<T>(message: impl Into<String>) -> Result<T> {
    Err(Fault::Malformed(message.into()))
}

/// How much memory the file may still make the program allocate, shared by all threads of an import.
#[derive(Debug)]
pub(super) struct MemoryBudget(AtomicU64);

impl MemoryBudget {
    /// A file of any size may expand to this many bytes …
    const BASE: u64 = 192 << 20;
    /// … and to this many more for each of its own bytes.
    const PER_BYTE: u64 = 12;

    /// The budget of a model whose files have so many bytes altogether.
    pub(super) fn for_input(bytes: u64) -> Self {
        Self(AtomicU64::new(bytes.saturating_mul(Self::PER_BYTE).saturating_add(Self::BASE)))
    }

    /// The number of bytes that are left.
    pub(super) fn left(&self) -> u64 {
        self.0.load(Ordering::Relaxed)
    }

    /// Takes bytes off, before they are allocated.
    ///
    /// # Errors
    /// When fewer are left; `what` then begins the message.
    pub(super) fn take(&self, bytes: u64, what: impl FnOnce() -> String) -> Result<()> {
        let taken = self.0.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(bytes));
        if taken.is_err() {
            return malformed(format!(
                "{} would take {} MB, more than the file's size justifies",
                what(),
                bytes.div_ceil(1 << 20)
            ));
        }
        Ok(())
    }
}
