//! Work that runs in the background.
//!
//! Every kind of work is a [`Job`] over the type of its result; the viewer keeps one field per kind and asks it once
//! per frame. A job that panics becomes an error like any other, a job that is dropped is asked to stop.

use eframe::egui;
use std::panic::AssertUnwindSafe;
use std::sync::mpsc::{Receiver, channel};

use crate::import::Progress;

/// Work in a thread of its own.
pub struct Job<T> {
    progress: Progress,
    receiver: Receiver<Result<T, JobError>>,
}

/// Why a job has no result.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum JobError {
    /// It panicked: a mistake of the program.
    #[error("{name} failed unexpectedly ({message}); please report this")]
    Panicked {
        /// What it was doing.
        name: &'static str,
        /// What the panic said.
        message: String,
    },
    /// The system gave no thread.
    #[error("{name} could not be started: {message}")]
    NotStarted {
        /// What it was to do.
        name: &'static str,
        /// What the system said.
        message: String,
    },
}

impl<T: Send + 'static> Job<T> {
    /// Starts `work` in a thread called `name`; the window is woken when it is done.
    pub fn start(
        name: &'static str,
        context: &egui::Context,
        work: impl FnOnce(&Progress) -> T + Send + 'static,
    ) -> Self {
        let progress = Progress::default();
        let (sender, receiver) = channel();
        let (inner_progress, inner_sender, context) = (progress.clone(), sender.clone(), context.clone());
        let started = std::thread::Builder::new().name(name.to_owned()).spawn(move || {
            let result = std::panic::catch_unwind(AssertUnwindSafe(|| work(&inner_progress)))
                .map_err(|payload| JobError::Panicked { name, message: panic_message(payload.as_ref()) });
            // Nobody listens any more when the job was dropped.
            let _ = inner_sender.send(result);
            context.request_repaint();
        });
        if let Err(error) = started {
            let _ = sender.send(Err(JobError::NotStarted { name, message: error.to_string() }));
        }
        Self { progress, receiver }
    }

    /// The result, once, as soon as it is there.
    pub fn poll(&self) -> Option<Result<T, JobError>> {
        self.receiver.try_recv().ok()
    }

    /// The result of the job that is there, as soon as it is done; the job is gone then.
    pub fn take(job: &mut Option<Self>) -> Option<Result<T, JobError>> {
        let result = job.as_ref()?.poll()?;
        *job = None;
        Some(result)
    }

    /// How far it is, and the way to stop it.
    pub fn progress(&self) -> &Progress {
        &self.progress
    }
}

impl<T> Drop for Job<T> {
    fn drop(&mut self) {
        self.progress.cancel();
    }
}

fn panic_message(payload: &(dyn std::any::Any + Send)) -> String {
    payload
        .downcast_ref::<&str>()
        .map(|s| (*s).to_owned())
        .or_else(|| payload.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "no reason given".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wait<T: Send + 'static>(job: &Job<T>) -> Result<T, JobError> {
        for _ in 0..1000 {
            if let Some(result) = job.poll() {
                return result;
            }
            std::thread::sleep(std::time::Duration::from_millis(10));
        }
        panic!("the job never ended");
    }

    #[test]
    fn a_job_gives_its_result_once_and_a_panic_becomes_an_error() {
        let context = egui::Context::default();
        let job = Job::start("adding", &context, |_| 1 + 1);
        assert_eq!(wait(&job), Ok(2));
        assert_eq!(job.poll(), None);
        let job = Job::start("failing", &context, |_| -> u8 { panic!("no such thing") });
        assert!(wait(&job).unwrap_err().to_string().contains("failing failed unexpectedly (no such thing)"));
    }

    #[test]
    fn a_dropped_job_is_asked_to_stop() {
        let context = egui::Context::default();
        let (sender, receiver) = channel();
        let job = Job::start("waiting", &context, move |progress| {
            while !progress.is_canceled() {
                std::thread::sleep(std::time::Duration::from_millis(1));
            }
            sender.send(()).unwrap();
        });
        drop(job);
        receiver.recv_timeout(std::time::Duration::from_secs(10)).unwrap();
    }
}
