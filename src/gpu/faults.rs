//! What the device could not do. It says so beside the calls that it concerns, and not always where they are made: so it
//! is noted here, and asked for wherever somebody waits for the device or shows what it made.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// A fault of the device.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Fault {
    /// It has no memory left.
    OutOfMemory,
    /// It was asked for something that it does not do.
    Refused(String),
}

/// The faults of a device; every clone hears of each once.
#[derive(Debug, Default)]
pub(super) struct Faults {
    noted: Arc<Mutex<Noted>>,
    heard: AtomicU64,
}

#[derive(Debug, Default)]
struct Noted {
    count: u64,
    /// The number and the words of the last refusal.
    refused: (u64, String),
    /// The number of the last want of memory. What is made without memory is refused later, wherever it is used.
    out_of_memory: u64,
}

impl Clone for Faults {
    fn clone(&self) -> Self {
        let heard = AtomicU64::new(self.heard.load(Ordering::Relaxed));
        Self { noted: Arc::clone(&self.noted), heard }
    }
}

impl Faults {
    /// Notes all faults of a device from now on; without that they would end the program.
    pub(super) fn of(device: &wgpu::Device) -> Self {
        let faults = Self::default();
        let noting = faults.clone();
        device.on_uncaptured_error(Arc::new(move |error| {
            log::error!("{error}");
            noting.note(match error {
                wgpu::Error::OutOfMemory { .. } => Fault::OutOfMemory,
                wgpu::Error::Validation { description, .. } | wgpu::Error::Internal { description, .. } => {
                    Fault::Refused(description)
                }
            });
        }));
        faults
    }

    pub(super) fn note(&self, fault: Fault) {
        let mut noted = self.noted.lock().unwrap_or_else(PoisonError::into_inner);
        noted.count += 1;
        match fault {
            Fault::OutOfMemory => noted.out_of_memory = noted.count,
            Fault::Refused(words) => noted.refused = (noted.count, words),
        }
    }

    /// What went wrong since the last call; of several faults the one that led to the others.
    pub(super) fn take(&self) -> Option<Fault> {
        let noted = self.noted.lock().unwrap_or_else(PoisonError::into_inner);
        let heard = self.heard.swap(noted.count, Ordering::Relaxed);
        if noted.out_of_memory > heard {
            Some(Fault::OutOfMemory)
        } else {
            (noted.refused.0 > heard).then(|| Fault::Refused(noted.refused.1.clone()))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everybody_hears_of_a_fault_once_and_of_its_cause_first() {
        let one = Faults::default();
        let two = one.clone();
        assert_eq!(one.take(), None);
        one.note(Fault::Refused("a".to_owned()));
        one.note(Fault::OutOfMemory);
        one.note(Fault::Refused("b".to_owned()));
        assert_eq!((two.take(), two.take()), (Some(Fault::OutOfMemory), None));
        assert_eq!(one.clone().take(), Some(Fault::OutOfMemory));
        one.note(Fault::Refused("c".to_owned()));
        assert_eq!(
            (one.take(), two.take()),
            (Some(Fault::OutOfMemory), Some(Fault::Refused("c".to_owned())))
        );
    }
}
