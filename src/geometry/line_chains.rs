//! Edges one after the other: what dashes run along.

use rayon::prelude::*;

/// Marks the end of a chain.
pub(super) const NO_END: u32 = u32::MAX;

/// An edge that takes part in chains.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ChainEdge {
    /// The points at both ends, as any numbers; `None` where it never goes on.
    pub ends: [Option<u32>; 2],
    /// Only links of one kind are joined.
    pub kind: u8,
}

/// A link as a part of a chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ChainLink {
    /// Index of the link.
    pub link: u32,
    /// Whether the chain runs from its second to its first end.
    pub reversed: bool,
}

/// One of the two ends of a link.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct LinkEnd {
    point: u32,
    kind: u8,
    /// Twice the number of the link, plus the number of the end.
    pub number: u32,
}

/// Visits the points at which links can be joined, with the halves of one kind that meet there.
pub(super) fn for_each_meeting(links: &[ChainEdge], mut visit: impl FnMut(&[LinkEnd])) {
    let mut halves: Vec<LinkEnd> = (0_u32..)
        .step_by(2)
        .zip(links)
        .flat_map(|(first, link)| {
            let half = |end: u32| {
                Some(LinkEnd { point: link.ends[end as usize]?, kind: link.kind, number: first | end })
            };
            [half(0), half(1)].into_iter().flatten()
        })
        .collect();
    halves.par_sort_unstable();
    for here in halves.chunk_by(|a, b| (a.point, a.kind) == (b.point, b.kind)) {
        visit(here);
    }
}

/// Edges that meet in one point, beyond which nobody looks for those that go on.
const MAX_HERE: usize = 64;

/// Pairs up the halves of each kind that meet at a point and go on in each other, those first that do it best: `join` gets both and
/// their rating. `rate`: how well one half goes on in the other, `None` where it does not at all.
pub(super) fn for_each_best_pair(
    links: &[ChainEdge],
    rate: impl Fn([u32; 2]) -> Option<f32>,
    mut join: impl FnMut([u32; 2], f32),
) {
    let mut is_joined = vec![false; 2 * links.len()];
    let mut pairs: Vec<(f32, [u32; 2])> = Vec::new();
    for_each_meeting(links, |here| {
        if !(2..=MAX_HERE).contains(&here.len()) {
            return;
        }
        pairs.clear();
        for (i, &LinkEnd { number: a, .. }) in here.iter().enumerate() {
            for &LinkEnd { number: b, .. } in &here[i + 1..] {
                if let Some(rating) = rate([a, b]).filter(|_| a >> 1 != b >> 1) {
                    pairs.push((rating, [a, b]));
                }
            }
        }
        pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
        for &(rating, pair) in &pairs {
            if pair.iter().all(|&half| !is_joined[half as usize]) {
                pair.iter().for_each(|&half| is_joined[half as usize] = true);
                join(pair, rating);
            }
        }
    });
}

/// For each half the one that goes on from it best, or [`NO_END`]; rated as for [`for_each_best_pair`].
pub(super) fn best_partners(links: &[ChainEdge], rate: impl Fn([u32; 2]) -> Option<f32>) -> Vec<u32> {
    let mut partner = vec![NO_END; 2 * links.len()];
    for_each_best_pair(links, rate, |[a, b], _| {
        partner[a as usize] = b;
        partner[b as usize] = a;
    });
    partner
}

/// All links in the order of their chains.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct Chains {
    pub links: Vec<ChainLink>,
    /// For each chain the number of its first link in `links`, and whether its end meets its start.
    pub starts: Vec<(u32, bool)>,
}

impl Chains {
    /// Joins links at points where exactly two of a kind meet and `goes_on` says of both halves there that the chain goes on.
    pub(super) fn new(links: &[ChainEdge], goes_on: impl Fn(u32, u32) -> bool) -> Self {
        let mut partner = vec![NO_END; 2 * links.len()];
        for_each_meeting(links, |here| {
            if let &[LinkEnd { number: a, .. }, LinkEnd { number: b, .. }] = here
                && a >> 1 != b >> 1
                && goes_on(a, b)
            {
                partner[a as usize] = b;
                partner[b as usize] = a;
            }
        });
        Self::joined(&partner)
    }

    /// Chains of links of which it is known how they go on: for each half the other one there, or [`NO_END`].
    pub(super) fn joined(partner: &[u32]) -> Self {
        let mut all = Self::default();
        let mut is_used = vec![false; partner.len() / 2];
        // Open chains first: each from the one of its ends that comes first.
        for half in 0..partner.len() as u32 {
            if partner[half as usize] == NO_END && !is_used[half as usize >> 1] {
                all.walk(half, partner, &mut is_used, false);
            }
        }
        for link in 0..is_used.len() as u32 {
            if !is_used[link as usize] {
                all.walk(2 * link, partner, &mut is_used, true);
            }
        }
        all
    }

    /// The chains: their links, and whether they are closed.
    pub(super) fn iter(&self) -> impl Iterator<Item = (&[ChainLink], bool)> {
        (0..self.starts.len()).filter_map(|chain| self.get(chain))
    }

    /// The links of a chain, and whether it is closed.
    pub(super) fn get(&self, chain: usize) -> Option<(&[ChainLink], bool)> {
        let &(start, is_closed) = self.starts.get(chain)?;
        let end = self.starts.get(chain + 1).map_or(self.links.len(), |next| next.0 as usize);
        Some((self.links.get(start as usize..end)?, is_closed))
    }

    /// Adds the chain that begins at this half.
    fn walk(&mut self, start: u32, partner: &[u32], is_used: &mut [bool], is_closed: bool) {
        self.starts.push((self.links.len() as u32, is_closed));
        let mut half = start;
        loop {
            let link = half >> 1;
            is_used[link as usize] = true;
            self.links.push(ChainLink { link, reversed: half & 1 == 1 });
            half = partner[half as usize ^ 1];
            if half == NO_END || half == start {
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn link(a: u32, b: u32, kind: u8) -> ChainEdge {
        ChainEdge { ends: [Some(a), Some(b)], kind }
    }

    /// (links, negative where reversed and counted from 1; closed) of each chain.
    fn chains(links: &[ChainEdge], goes_on: impl Fn(u32, u32) -> bool) -> Vec<(Vec<i32>, bool)> {
        let signed = |l: &ChainLink| if l.reversed { -(l.link as i32 + 1) } else { l.link as i32 + 1 };
        let chains = Chains::new(links, goes_on);
        chains.iter().map(|(own, closed)| (own.iter().map(signed).collect(), closed)).collect()
    }

    #[test]
    fn links_are_joined_end_to_end() {
        let links = [link(5, 6, 0), link(8, 7, 0), link(6, 7, 0)];
        assert_eq!(chains(&links, |_, _| true), [(vec![1, 3, -2], false)]);
        assert_eq!(chains(&links, |a, b| (a >> 1) + (b >> 1) != 3), [(vec![1, 3], false), (vec![2], false)]);
        let mut loose = links;
        loose[2].ends[0] = None;
        assert_eq!(chains(&loose, |_, _| true), [(vec![1], false), (vec![2, -3], false)]);
    }

    #[test]
    fn loops_are_closed_and_branches_end_chains() {
        let ring = [link(0, 1, 0), link(2, 1, 0), link(2, 0, 0)];
        assert_eq!(chains(&ring, |_, _| true), [(vec![1, -2, 3], true)]);
        let star = [link(0, 1, 0), link(0, 2, 0), link(0, 3, 0), link(3, 4, 1), link(3, 5, 0)];
        let expected = [(vec![1], false), (vec![2], false), (vec![3, 5], false), (vec![4], false)];
        assert_eq!(chains(&star, |_, _| true), expected);
        // Two points joined twice, and one with itself.
        assert_eq!(chains(&[link(0, 1, 0), link(0, 1, 0)], |_, _| true), [(vec![1, -2], true)]);
        assert_eq!(chains(&[link(4, 4, 0)], |_, _| true), [(vec![1], false)]);
        assert!(chains(&[], |_, _| true).is_empty());
    }
}
