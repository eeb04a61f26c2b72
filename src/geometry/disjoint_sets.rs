//! Which of many things are connected, found by several threads.

use std::sync::atomic::{AtomicU32, Ordering};

/// A union-find whose roots are the smallest members, so that numbering needs one pass.
pub(super) struct DisjointSets(Vec<AtomicU32>);

impl DisjointSets {
    pub(super) fn new(count: usize) -> Self {
        Self((0..count as u32).map(AtomicU32::new).collect())
    }

    /// The smallest member of the set so far.
    pub(super) fn find(&self, mut member: u32) -> u32 {
        loop {
            let parent = self.0[member as usize].load(Ordering::Relaxed);
            if parent == member {
                return member;
            }
            let above = self.0[parent as usize].load(Ordering::Relaxed);
            if above != parent {
                // Halving the path. Parents only ever decrease to smaller members of the same set, so a race here
                // costs a longer path at worst.
                self.0[member as usize].fetch_min(above, Ordering::Relaxed);
            }
            member = above;
        }
    }

    /// Makes one set of the sets of both. Many threads may do so at once: the sets do not depend on their order.
    pub(super) fn unite(&self, a: u32, b: u32) {
        let (mut a, mut b) = (self.find(a), self.find(b));
        while a != b {
            let (low, high) = (a.min(b), a.max(b));
            match self.0[high as usize].compare_exchange(high, low, Ordering::Relaxed, Ordering::Relaxed) {
                Ok(_) => return,
                Err(_) => (a, b) = (self.find(low), self.find(high)),
            }
        }
    }

    /// The number of each member's set, in the order of their smallest members, and how many sets there are.
    pub(super) fn numbered(self) -> (Vec<u32>, usize) {
        let mut set_of: Vec<u32> = self.0.into_iter().map(AtomicU32::into_inner).collect();
        let mut count = 0;
        for member in 0..set_of.len() {
            let parent = set_of[member] as usize;
            set_of[member] = if parent == member {
                count += 1;
                count - 1
            } else {
                set_of[parent]
            };
        }
        (set_of, count as usize)
    }
}
