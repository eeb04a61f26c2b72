//! How much room a frame has for layers and for the fragments that they are made of: guessed before it, known after it.

use crate::document;
use crate::gpu::Gpu;
use crate::render::passes::fragment_lists::FragmentLists;
use crate::render::passes::peel::Peeled;

/// Fragments per pixel of the picture, as long as nobody has counted them.
const FIRST_GUESS: u64 = 4;

/// More layers are recorded than the last report names, as there may be more by now.
const MORE_LAYERS: u32 = 1;

/// What is known of pictures that were drawn, from reports that come back some time after them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reported {
    /// All of them are complete.
    Complete,
    /// Not yet all about the last one.
    Waiting,
    /// One was incomplete, as there was not room enough. Whoever wants it asks for it again: there is now.
    Incomplete,
}

/// How layers were made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LayersBy {
    /// From lists of fragments.
    Lists,
    /// By peeling.
    Peeling,
}

/// What a frame has room for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Recorded {
    /// So many layers are recorded, of so many that were asked for.
    pub(super) layers: u32,
    most: u32,
    /// Room for so many fragments; `None`: it is peeled.
    pub(super) fragments: Option<u64>,
}

impl Recorded {
    pub(super) fn by(&self) -> LayersBy {
        if self.fragments.is_some() { LayersBy::Lists } else { LayersBy::Peeling }
    }
}

/// What reports have taught. It decides nothing: when it is wrong, the next report says so.
#[derive(Debug, Default)]
pub(super) struct Room {
    /// Layers there were; `None`: nobody knows.
    layers: Option<u32>,
    /// Fragments there were.
    fragments: Option<u64>,
    /// Since lists had more fragments than there can be room for: pixels of all layers when it was first peeled.
    peeled: Option<u64>,
}

impl Room {
    /// What to record for a picture of which up to `most` layers are wanted.
    pub(super) fn plan(&self, gpu: &Gpu, size: [u32; 2], most: u32, by: document::LayersBy) -> Recorded {
        let bound = if by == document::LayersBy::Peeling { 0 } else { FragmentLists::most(gpu) };
        self.plan_within(bound, size, most)
    }

    fn plan_within(&self, bound: u64, [width, height]: [u32; 2], most: u32) -> Recorded {
        let first = FIRST_GUESS * u64::from(width) * u64::from(height);
        let needed = self.fragments.unwrap_or(0);
        // A quarter more, as there may be more by now.
        let room = self.fragments.map_or(first, |counted| counted + counted / 4);
        Recorded {
            layers: self.layers.map_or(most, |layers| (layers + MORE_LAYERS).min(most)),
            most,
            fragments: (bound > 0 && needed <= bound).then_some(room.clamp(1, bound.max(1))),
        }
    }

    /// Learns from a report; returns whether the picture was complete.
    pub(super) fn learn(&mut self, recorded: &Recorded, peeled: &Peeled) -> bool {
        let fragments = u64::from(peeled.fragments);
        let fitted = recorded.fragments.is_none_or(|room| fragments <= room);
        let is_complete = fitted && (peeled.has_ended == 1 || recorded.layers >= recorded.most);
        // That which ended it is recorded too.
        self.layers = is_complete.then_some(peeled.layers + 1);
        if recorded.fragments.is_some() {
            self.fragments = Some(fragments);
            self.peeled = None;
        } else {
            let pixels = peeled.pixels.iter().copied().map(u64::from).sum();
            let first = *self.peeled.get_or_insert(pixels);
            if 2 * pixels < first {
                // So much less that lists may do again.
                *self = Self { layers: self.layers, ..Self::default() };
            }
        }
        is_complete
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn peeled(layers: u32, has_ended: bool, fragments: u32) -> Peeled {
        let mut pixels = [0; 64];
        pixels[..layers as usize].fill(100);
        Peeled { has_ended: u32::from(has_ended), layers, fragments, pixels, ..Peeled::begun(1, 1.0) }
    }

    #[test]
    fn without_a_report_all_layers_are_recorded_and_after_one_a_few_more_than_there_were() {
        let mut room = Room::default();
        let first = room.plan_within(1000, [10, 10], 64);
        assert_eq!((first.layers, first.fragments), (64, Some(400)));
        assert!(room.learn(&first, &peeled(5, true, 80)));
        let second = room.plan_within(1000, [10, 10], 64);
        assert_eq!((second.layers, second.fragments), (7, Some(100)));
        // Two layers more: nobody reached their end.
        assert!(!room.learn(&second, &peeled(7, false, 90)));
        assert_eq!(room.plan_within(1000, [10, 10], 64).layers, 64);
        // As many as were asked for need no end.
        assert!(room.learn(&room.plan_within(1000, [10, 10], 7), &peeled(7, false, 90)));
    }

    #[test]
    fn fragments_without_room_get_it_or_are_peeled_until_there_are_far_fewer() {
        let mut room = Room::default();
        let first = room.plan_within(1000, [10, 10], 8);
        assert!(!room.learn(&first, &peeled(3, true, 700)));
        let second = room.plan_within(1000, [10, 10], 8);
        assert_eq!((second.fragments, second.by()), (Some(875), LayersBy::Lists));
        assert!(!room.learn(&second, &peeled(3, true, 1001)));
        let third = room.plan_within(1000, [10, 10], 8);
        assert_eq!((third.fragments, third.by()), (None, LayersBy::Peeling));
        for (layers, by) in [(8, LayersBy::Peeling), (4, LayersBy::Peeling), (3, LayersBy::Lists)] {
            assert!(room.learn(&room.plan_within(1000, [10, 10], 8), &peeled(layers, true, 0)));
            assert_eq!(room.plan_within(1000, [10, 10], 8).by(), by, "{layers}");
        }
    }

    #[test]
    fn a_device_without_lists_peels() {
        assert_eq!(Room::default().plan_within(0, [10, 10], 8).by(), LayersBy::Peeling);
    }
}
