//! The budget of a frame: for how many layers and fragments it has room, guessed before it and known after it.

use crate::document::LayersBy;
use crate::gpu::{Gpu, parted_counter};
use crate::render::passes::fragment_lists::FragmentLists;
use crate::render::passes::layer_report::{LayerReport, LayersEnd};

/// Fragments per pixel of the picture, as long as nobody has counted them.
const FIRST_GUESS: u64 = 4;

/// After so many complete pictures in a row, more than one picture has samples, guesses may be tight again.
const CALM: u32 = 2 * crate::render::base::sample::MAX_SAMPLES;

/// Wrong guesses after which the budget does not grow any more: then all layers are recorded.
const MAX_MISTAKES: u32 = 6;

/// What is known of pictures that were drawn, from reports that come back some time after them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reported {
    /// All of them are complete.
    Complete,
    /// Not yet all about the last one.
    Waiting,
    /// One was incomplete, as the budget was too small. Whoever wants it asks for it again: there is now.
    Incomplete,
}

/// How layers were made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LayerMethod {
    /// From lists of fragments.
    Lists,
    /// By peeling.
    Peeling(Reason),
}

/// Why layers are peeled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reason {
    /// The document asks for it.
    Asked,
    /// A single layer is made faster so.
    Single,
    /// The device cannot do otherwise.
    Device,
    /// Memory for so many fragments is more than there ever is.
    TooMany(u64),
}

impl LayerMethod {
    /// Whether it was peeled although that was not asked for, as a sentence.
    pub fn shortfall(&self) -> Option<String> {
        match self {
            Self::Lists | Self::Peeling(Reason::Asked | Reason::Single) => None,
            Self::Peeling(Reason::Device) => Some(
                "layers are peeled, as fragment shaders cannot write with this graphics driver".to_owned(),
            ),
            Self::Peeling(Reason::TooMany(fragments)) => Some(format!(
                "layers are peeled, as lists with room for {fragments} fragments would take too much memory"
            )),
        }
    }
}

impl std::fmt::Display for LayerMethod {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Lists => "lists",
            Self::Peeling(_) => "peeling",
        })
    }
}

/// What is recorded for a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Recorded {
    /// So many layers are recorded, of so many that were asked for.
    pub(super) layers: u32,
    most: u32,
    /// Memory for so many fragments, or why it is peeled.
    pub(super) fragments: Result<u64, Reason>,
}

impl Recorded {
    /// Whether a layer is only asked whether it is there: then the picture is incomplete.
    pub(super) fn only_counts(&self, layer: u32) -> bool {
        layer + 1 == self.layers && self.layers < self.most
    }

    pub(super) fn by(&self) -> LayerMethod {
        self.fragments.map_or_else(LayerMethod::Peeling, |_| LayerMethod::Lists)
    }
}

/// What reports have taught. It decides nothing: when it is wrong, the next report says so.
#[derive(Debug, Default)]
pub(super) struct Budget {
    /// Layers there were, that which ended them included, or twice as many as were recorded where those were too few;
    /// `None`: nobody knows.
    layers: Option<u32>,
    /// Fragments there had to be room for.
    fragments: Option<u64>,
    /// Guesses that were wrong: each doubles the reserve. Samples of one picture differ, and each wrong guess begins it
    /// anew, so a reserve is kept at least until it is done. Layers begin without one: each takes time though nothing is
    /// in it.
    mistakes: u32,
    /// Complete pictures since the last wrong guess.
    calm: u32,
    /// Since lists needed more memory than there can be: pixels of all layers when it was first peeled.
    peeled: Option<u64>,
}

impl Budget {
    /// What to record for a picture of which up to `most` layers are wanted.
    pub(super) fn plan(&self, gpu: &Gpu, size: [u32; 2], most: u32, by: LayersBy) -> Recorded {
        let bound = match (by, FragmentLists::most(gpu)) {
            (LayersBy::Peeling, _) => Err(Reason::Asked),
            (LayersBy::Auto, _) if most == 1 => Err(Reason::Single),
            (_, 0) => Err(Reason::Device),
            (_, fragments) => Ok(fragments),
        };
        self.plan_within(bound, size, most)
    }

    fn plan_within(&self, bound: Result<u64, Reason>, size: [u32; 2], most: u32) -> Recorded {
        let [width, height] = size.map(|side| u64::from(side.next_multiple_of(parted_counter::SQUARE)));
        let first = FIRST_GUESS * width * height;
        // More than there were, as there may be more by now: a quarter.
        let reserve = 1 << self.mistakes;
        let budget = self.fragments.map_or(first, |counted| counted + counted / 4 * reserve);
        let fragments = bound.and_then(|bound| match self.fragments {
            Some(counted) if counted > bound => Err(Reason::TooMany(counted)),
            _ => Ok(budget.clamp(1, bound)),
        });
        Recorded {
            layers: self.layers.map_or(most, |layers| (layers + reserve as u32 - 1).min(most)),
            most,
            fragments,
        }
    }

    /// Learns from a report; returns whether the picture was complete.
    pub(super) fn learn(&mut self, recorded: &Recorded, report: &LayerReport) -> bool {
        let fragments = report.capacity;
        let overflowed = recorded.fragments.is_ok_and(|budget| fragments > budget);
        // Each layer that is recorded counts unless the device has ended them before it.
        let has_ended = report.ended != LayersEnd::MaxLayers || report.layers < recorded.layers;
        let is_complete = !overflowed && (has_ended || recorded.layers >= recorded.most);
        if is_complete {
            self.calm += 1;
            if self.calm >= CALM {
                (self.mistakes, self.calm) = (0, 0);
            }
        } else {
            (self.mistakes, self.calm) = ((self.mistakes + 1).min(MAX_MISTAKES), 0);
        }
        self.layers = match (is_complete, overflowed) {
            (true, _) if has_ended => Some(report.layers + 1),
            // As many as were asked for may not be all: what is known of those behind them is still the best guess.
            (true, _) => self.layers.filter(|&layers| layers > report.layers),
            (false, false) => Some(2 * recorded.layers),
            (false, true) => None,
        };
        if recorded.fragments.is_ok() {
            self.fragments = Some(fragments);
            self.peeled = None;
        } else {
            let pixels = report.pixels.iter().copied().map(u64::from).sum();
            let first = *self.peeled.get_or_insert(pixels);
            if 2 * pixels < first {
                // So much less that lists may do again.
                (self.fragments, self.peeled) = (None, None);
            }
        }
        is_complete
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As much room as one fragment takes at least.
    const CHUNK: u64 = 4096;
    /// Of which the first guess is 400 times that much.
    const SIZE: [u32; 2] = [640; 2];

    /// With fragments that take so many times that much.
    fn report(layers: u32, has_ended: bool, chunks: u32) -> LayerReport {
        let mut pixels = vec![0; 64];
        pixels[..layers as usize].fill(100);
        let ended = if has_ended { LayersEnd::TooFewPixels } else { LayersEnd::MaxLayers };
        let (passed, capacity) = (vec![0; 64], CHUNK * u64::from(chunks));
        LayerReport {
            layers,
            ended,
            fraction: 1.0,
            masked: 0,
            hidden: 0,
            fragments: capacity,
            capacity,
            pixels,
            passed,
        }
    }

    #[test]
    fn without_a_report_all_layers_are_recorded_and_after_one_as_many_as_there_were() {
        let mut budget = Budget::default();
        let first = budget.plan_within(Ok(1000 * CHUNK), SIZE, 64);
        assert_eq!((first.layers, first.fragments), (64, Ok(400 * CHUNK)));
        assert!(budget.learn(&first, &report(5, true, 80)));
        let second = budget.plan_within(Ok(1000 * CHUNK), SIZE, 64);
        assert_eq!((second.layers, second.fragments), (6, Ok(100 * CHUNK)));
        assert_eq!([4, 5].map(|layer| second.only_counts(layer)), [false, true]);
        // A layer more: nobody reached their end.
        assert!(!budget.learn(&second, &report(6, false, 90)));
        assert_eq!(budget.plan_within(Ok(1000 * CHUNK), SIZE, 64).layers, 13);
        // As many as were asked for need no end, and say nothing about it,
        assert!(budget.learn(&budget.plan_within(Ok(1000 * CHUNK), SIZE, 7), &report(7, false, 90)));
        assert_eq!(budget.plan_within(Ok(1000 * CHUNK), SIZE, 64).layers, 13);
        // unless there were more than were ever seen.
        assert!(budget.learn(&budget.plan_within(Ok(1000 * CHUNK), SIZE, 12), &report(12, false, 90)));
        assert_eq!(budget.plan_within(Ok(1000 * CHUNK), SIZE, 64).layers, 64);
    }

    #[test]
    fn fragments_without_room_get_it_or_are_peeled_until_there_are_far_fewer() {
        let mut budget = Budget::default();
        let first = budget.plan_within(Ok(1000 * CHUNK), SIZE, 8);
        assert!(!budget.learn(&first, &report(3, true, 700)));
        let second = budget.plan_within(Ok(1000 * CHUNK), SIZE, 8);
        assert_eq!((second.fragments, second.by()), (Ok(1000 * CHUNK), LayerMethod::Lists));
        assert!(!budget.learn(&second, &report(3, true, 1001)));
        let third = budget.plan_within(Ok(1000 * CHUNK), SIZE, 8);
        let peeling = LayerMethod::Peeling(Reason::TooMany(1001 * CHUNK));
        assert_eq!(third.by(), peeling);
        assert!(peeling.shortfall().is_some_and(|why| why.contains(&(1001 * CHUNK).to_string())));
        for (layers, by) in [(8, peeling), (4, peeling), (3, LayerMethod::Lists)] {
            assert!(budget.learn(&budget.plan_within(Ok(1000 * CHUNK), SIZE, 8), &report(layers, true, 0)));
            assert_eq!(budget.plan_within(Ok(1000 * CHUNK), SIZE, 8).by(), by, "{layers}");
        }
    }

    #[test]
    fn a_picture_whose_samples_differ_gets_done() {
        let mut budget = Budget::default();
        let (mut sample, mut drawn) = (0_u32, 0);
        while sample < 64 {
            let recorded = budget.plan_within(Ok(100_000 * CHUNK), SIZE, 64);
            // Each fifth sample has many more layers and fragments.
            let (layers, fragments) = if sample % 5 == 4 { (20, 900) } else { (9, 300) };
            let has_ended = recorded.layers > layers;
            let is_complete = budget.learn(&recorded, &report(layers, has_ended, fragments));
            sample = if is_complete { sample + 1 } else { 0 };
            drawn += 1;
            assert!(drawn < 200, "begun anew for ever");
        }
        // Long after that it is guessed tightly again.
        for _ in 0..CALM {
            let recorded = budget.plan_within(Ok(100_000 * CHUNK), SIZE, 64);
            assert!(budget.learn(&recorded, &report(9, true, 300)));
        }
        assert_eq!(budget.plan_within(Ok(100_000 * CHUNK), SIZE, 64).layers, 10);
    }

    #[test]
    fn a_device_without_lists_peels_and_says_so_unless_that_was_asked_for() {
        for (reason, is_said) in [(Reason::Device, true), (Reason::Asked, false)] {
            let by = Budget::default().plan_within(Err(reason), SIZE, 8).by();
            assert_eq!((by, by.shortfall().is_some()), (LayerMethod::Peeling(reason), is_said));
        }
    }
}
