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
    /// Samples that the picture is to have at rest.
    wanted: u32,
    /// Whether it rests.
    rests: bool,
    /// The last one that was drawn; `None` when it could not be drawn.
    drawn: Option<Sample>,
    is_complete: bool,
}

impl Default for Refining {
    fn default() -> Self {
        Self { quiet_since: Instant::now(), wanted: 1, rests: false, drawn: None, is_complete: true }
    }
}

impl Refining {
    /// A new picture, which is to have so many samples at rest.
    pub fn begin(&mut self, wanted: u32) {
        *self = Self { wanted, is_complete: wanted <= 1, ..Self::default() };
    }

    /// How many samples to ask the renderer for. While something moves, of all of them only the first one is ever drawn.
    pub fn samples(&self) -> u32 {
        self.wanted
    }

    /// Takes note of what was drawn; `None`: nothing could be.
    pub fn note(&mut self, drawn: Option<Sample>) {
        self.drawn = drawn;
        self.is_complete = drawn.is_none_or(Sample::is_last);
    }

    /// Whether no more samples are to come.
    pub fn is_complete(&self) -> bool {
        self.is_complete
    }

    /// Samples so far, and how many there are to be; `None` when it is complete, or does not rest yet.
    pub fn progress(&self) -> Option<(u32, u32)> {
        let drawn = self.drawn.filter(|_| self.rests && !self.is_complete)?;
        Some((drawn.index + 1, drawn.of))
    }

    /// Whether to draw one more sample now, which takes about `cost`. Otherwise the window is woken when it is time, unless the device `is_busy`:
    /// whoever waits for that wakes it then.
    pub fn is_due(&mut self, context: &egui::Context, cost: Duration, is_busy: bool) -> bool {
        if context.input(|i| !i.events.is_empty() || i.pointer.any_down()) {
            self.quiet_since = Instant::now();
        }
        if self.is_complete {
            return false;
        }
        let [least, most] = REST;
        let left = cost.clamp(least, most).saturating_sub(self.quiet_since.elapsed());
        if !left.is_zero() {
            context.request_repaint_after(left);
        } else if !is_busy {
            self.rests = true;
        }
        left.is_zero() && !is_busy
    }
}
