//! When a picture gets smoother: a moment after the last change and the last sign of the person, and never so fast that
//! the device has no time for them.

use std::time::{Duration, Instant};

use eframe::egui;

use crate::render::Sample;

/// How long nothing must have happened, and at most: where a sample takes longer than the one, it is that long.
const REST: [Duration; 2] = [Duration::from_millis(150), Duration::from_secs(1)];

/// How far the picture at rest is.
#[derive(Debug)]
pub struct Refining {
    quiet_since: Instant,
    /// Samples that the present picture is asked for: one until it rests.
    asked: u32,
    /// Samples that it is to have at rest.
    wanted: u32,
    /// The last one that was drawn; `None` when it could not be drawn.
    drawn: Option<Sample>,
}

impl Default for Refining {
    fn default() -> Self {
        Self { quiet_since: Instant::now(), asked: 1, wanted: 1, drawn: None }
    }
}

impl Refining {
    /// A new picture, which is to have so many samples at rest.
    pub fn begin(&mut self, wanted: u32) {
        *self = Self { wanted, ..Self::default() };
    }

    /// How many samples to ask the renderer for.
    pub fn samples(&self) -> u32 {
        self.asked
    }

    /// Takes note of what was drawn; `None`: nothing could be.
    pub fn note(&mut self, drawn: Option<Sample>) {
        self.drawn = drawn;
        if drawn.is_none_or(|sample| sample.is_last() && self.asked > 1) {
            self.wanted = 1;
        }
    }

    /// Whether no more samples are to come.
    pub fn is_complete(&self) -> bool {
        self.wanted <= 1
    }

    /// Samples so far, and how many there are to be; `None` when it is complete, or does not rest yet.
    pub fn progress(&self) -> Option<(u32, u32)> {
        let drawn = self.drawn.filter(|_| self.asked > 1 && !self.is_complete())?;
        Some((drawn.index + 1, drawn.of))
    }

    /// Whether to draw one more sample now, which takes about `cost`. Otherwise the window is woken when it is time, unless the device `is_busy`:
    /// whoever waits for that wakes it then.
    pub fn is_due(&mut self, context: &egui::Context, cost: Duration, is_busy: bool) -> bool {
        if context.input(|i| !i.events.is_empty() || i.pointer.any_down()) {
            self.quiet_since = Instant::now();
        }
        if self.is_complete() {
            return false;
        }
        let [least, most] = REST;
        let left = cost.clamp(least, most).saturating_sub(self.quiet_since.elapsed());
        if !left.is_zero() {
            context.request_repaint_after(left);
        } else if !is_busy {
            self.asked = self.wanted;
        }
        left.is_zero() && !is_busy
    }
}
