//! Only what changed runs again: a stage compares its inputs with those of the last frame, by value.

use std::sync::atomic::{AtomicU64, Ordering};

/// The last revision of all stages: an output is never taken for that of another stage which was there before.
static REVISIONS: AtomicU64 = AtomicU64::new(0);

/// A stage of the frame with its last inputs and output.
#[derive(Debug)]
pub struct Stage<I, O> {
    last: Option<(I, O)>,
    revision: u64,
    runs: u64,
}

impl<I, O> Default for Stage<I, O> {
    fn default() -> Self {
        Self { last: None, revision: 0, runs: 0 }
    }
}

/// What a stage made, and a number that nothing else has which was ever made.
#[derive(Debug, Clone, PartialEq)]
pub struct Output<O> {
    /// The result.
    pub value: O,
    /// Changes with every run of the stage; goes into the inputs of later stages.
    pub revision: u64,
}

impl<I: PartialEq, O: Clone> Stage<I, O> {
    /// The last output if `inputs` are equal to the last ones, otherwise that of `run`.
    ///
    /// # Errors
    /// What `run` says; the stage then runs again next time.
    pub fn run<E>(&mut self, inputs: I, run: impl FnOnce(&I) -> Result<O, E>) -> Result<Output<O>, E> {
        if let Some((_, value)) = self.last.as_ref().filter(|(last, _)| *last == inputs) {
            return Ok(Output { value: value.clone(), revision: self.revision });
        }
        // Lets the pool use the old textures again.
        self.last = None;
        let value = run(&inputs)?;
        self.revision = REVISIONS.fetch_add(1, Ordering::Relaxed) + 1;
        self.runs += 1;
        self.last = Some((inputs, value.clone()));
        Ok(Output { value, revision: self.revision })
    }

    /// What the last output depends on, if there is one.
    pub fn inputs(&self) -> Option<&I> {
        self.last.as_ref().map(|(inputs, _)| inputs)
    }

    /// How often the stage ran.
    pub fn runs(&self) -> u64 {
        self.runs
    }

    /// Lets go of the output; the stage runs again when it is next asked for.
    pub fn clear(&mut self) {
        self.last = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stage_runs_only_when_its_inputs_changed() {
        let mut stage = Stage::default();
        let mut run = |input: i32| stage.run(input, |i| Ok::<_, ()>(i * 2)).unwrap();
        let first = run(1);
        assert_eq!((first.value, run(1)), (2, first.clone()));
        let second = run(2);
        assert_eq!(second.value, 4);
        let third = run(1);
        assert!(first.revision < second.revision && second.revision < third.revision);
        assert!(stage.run(5, |_| Err::<i32, _>("no")).is_err());
        let last = stage.run(5, |i| Ok::<_, ()>(i * 2)).unwrap();
        assert!(last.revision > third.revision);
        assert_eq!(stage.runs(), 4);
    }

    #[test]
    fn what_another_stage_made_before_has_another_revision() {
        let made = || Stage::default().run(1, |i: &i32| Ok::<_, ()>(*i)).unwrap().revision;
        assert_ne!(made(), made());
    }
}
