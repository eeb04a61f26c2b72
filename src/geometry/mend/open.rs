//! The border edges that are not joined yet, by the points at their ends as joined so far.

use super::border_points::PointGroups;
use super::borders::{Borders, MAX_AT_A_POINT};

/// A snapshot of what is still open.
pub(super) struct Open {
    /// The edges, in order.
    pub(super) edges: Vec<u32>,
    /// For each edge, open or not, the groups of its ends.
    groups: Vec<[u32; 2]>,
    /// (group, edge), sorted: the open edges that start there.
    starts: Vec<(u32, u32)>,
    /// (group, edge), sorted: the open edges that end there.
    ends: Vec<(u32, u32)>,
}

impl Open {
    pub(super) fn new(borders: &Borders, places: &PointGroups, is_joined: &[bool]) -> Self {
        let groups: Vec<[u32; 2]> =
            borders.list.iter().map(|b| b.ends.map(|point| places.group(point))).collect();
        let edges: Vec<u32> =
            (0..).zip(is_joined).filter(|(_, joined)| !**joined).map(|(edge, _)| edge).collect();
        let by_end = |end: usize| {
            let mut list: Vec<(u32, u32)> = edges.iter().map(|&e| (groups[e as usize][end], e)).collect();
            list.sort_unstable();
            list
        };
        Self { starts: by_end(0), ends: by_end(1), edges, groups }
    }

    /// The groups of an edge's ends.
    pub(super) fn ends(&self, edge: u32) -> [u32; 2] {
        self.groups[edge as usize]
    }

    /// The open edges that start at a group, each with the group; of very many only some.
    pub(super) fn starting_at(&self, group: u32) -> &[(u32, u32)] {
        Self::at(&self.starts, group)
    }

    /// The open edges that end at a group, as [`Self::starting_at`].
    pub(super) fn ending_at(&self, group: u32) -> &[(u32, u32)] {
        Self::at(&self.ends, group)
    }

    /// Whether the open edges do not just go on from one to the next there.
    pub(super) fn is_anchor(&self, group: u32) -> bool {
        self.starting_at(group).len() != 1 || self.ending_at(group).len() != 1
    }

    fn at(list: &[(u32, u32)], group: u32) -> &[(u32, u32)] {
        let list = &list[list.partition_point(|&(g, _)| g < group)..];
        &list[..list.iter().take(MAX_AT_A_POINT).take_while(|&&(g, _)| g == group).count()]
    }
}
