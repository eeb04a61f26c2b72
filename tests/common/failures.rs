//! What a long measurement finds wrong, told together at its end.

/// What does not hold, in words.
#[derive(Default)]
pub struct Failures(Vec<String>);

impl Failures {
    /// Notes `what` unless it holds.
    pub fn check(&mut self, holds: bool, what: String) {
        if !holds {
            self.0.push(what);
        }
    }

    /// Fails with all that was noted.
    pub fn report(self) {
        assert!(self.0.is_empty(), "{:#?}", self.0);
    }
}
