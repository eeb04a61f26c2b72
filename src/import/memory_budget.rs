//! How much memory a file may make the program allocate: a small file must not claim a large model, or unpack into one.

use std::sync::atomic::{AtomicU64, Ordering};

/// More was asked for than is left.
#[derive(Debug, thiserror::Error)]
#[error("{what} would take {megabytes} MB, more than the file's size justifies")]
pub(super) struct OverBudget {
    what: String,
    megabytes: u64,
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
    pub(super) fn take(&self, bytes: u64, what: impl FnOnce() -> String) -> Result<(), OverBudget> {
        let taken = self.0.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(bytes));
        match taken {
            Ok(_) => Ok(()),
            Err(_) => Err(OverBudget { what: what(), megabytes: bytes.div_ceil(1 << 20) }),
        }
    }
}
