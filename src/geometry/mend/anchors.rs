//! Step 2: chains of border edges between the same two common points.

use rayon::prelude::*;

use super::border_points::Tie;
use super::borders::{Borders, MAX_AT_A_POINT};
use super::limits::{COS_ANCHORED_FOLD, COS_SMOOTH, Limits};
use super::open::Open;
use super::side::Side;
use super::zip::Fit;

/// Longer chains are left to the other steps.
const MAX_EDGES: usize = 4096;

/// What is joined: the border edges of both sides, and the places that become one.
pub(super) struct Joined {
    pub(super) edges: Vec<u32>,
    pub(super) ties: Vec<Tie>,
}

/// Open border edges in a row, none of whose inner points is an anchor.
struct Chain {
    /// Groups of places at its ends.
    ends: [u32; 2],
    edges: Vec<u32>,
}

/// Two chains with the same ends.
struct Candidate {
    chains: [usize; 2],
    /// Whether the surface does not go on straight.
    turns: bool,
    width: f64,
    ties: Vec<Tie>,
}

/// Pairs the chains that have common ends: first those that one surface goes on through, then the narrowest gaps.
pub(super) fn anchored(borders: &Borders, open: &Open, limits: &Limits) -> Vec<Joined> {
    let chains = chains(open);
    let mut by_ends: Vec<([u32; 2], usize)> = chains
        .iter()
        .enumerate()
        .map(|(number, Chain { ends: [a, b], .. })| ([*a.min(b), *a.max(b)], number))
        .collect();
    by_ends.par_sort_unstable();
    let rivals: Vec<&[([u32; 2], usize)]> =
        by_ends.chunk_by(|a, b| a.0 == b.0).filter(|rivals| rivals.len() > 1).collect();
    rivals
        .into_par_iter()
        .flat_map_iter(|rivals| {
            let rivals = &rivals[..rivals.len().min(MAX_AT_A_POINT)];
            let mut candidates = Vec::new();
            for (k, &(_, a)) in rivals.iter().enumerate() {
                for &(_, b) in &rivals[k + 1..] {
                    candidates.extend(candidate(borders, &chains, [a, b], limits));
                }
            }
            candidates.sort_by(|a, b| {
                let by_width = a.width.total_cmp(&b.width).then(a.chains.cmp(&b.chains));
                a.turns.cmp(&b.turns).then(by_width)
            });
            let mut taken: Vec<usize> = Vec::new();
            candidates.retain(|candidate| {
                let is_free = !candidate.chains.iter().any(|c| taken.contains(c));
                if is_free {
                    taken.extend(candidate.chains);
                }
                is_free
            });
            candidates
        })
        .map(|Candidate { chains: [a, b], ties, .. }| Joined {
            edges: [&chains[a].edges[..], &chains[b].edges].concat(),
            ties,
        })
        .collect()
}

/// The seam that two chains with the same ends form, if they do; patches may be flipped against each other.
fn candidate(borders: &Borders, chains: &[Chain], pair: [usize; 2], limits: &Limits) -> Option<Candidate> {
    let [a, b] = pair.map(|c| &chains[c]);
    let side = Side::new(borders, &a.edges, false);
    let fit = |reversed: bool| {
        let other = Side::new(borders, &b.edges, reversed);
        let fit = Fit::new(&side, &other, COS_ANCHORED_FOLD, limits)?;
        let turns = Fit::new(&side, &other, COS_SMOOTH, limits).is_none();
        let ties = fit.ties(&side, &other, limits);
        Some(Candidate { chains: pair, turns, width: fit.width, ties })
    };
    if a.ends[0] == a.ends[1] {
        return fit(true).or_else(|| fit(false));
    }
    fit(a.ends[0] != b.ends[0])
}

/// Cuts the open border edges into chains at the points from which more than one of them starts, and where they do not
/// go on.
fn chains(open: &Open) -> Vec<Chain> {
    let mut chains = Vec::new();
    for &first in &open.edges {
        let [start, _] = open.ends(first);
        if !open.is_anchor(start) {
            continue;
        }
        let mut edges = vec![first];
        let mut end = open.ends(first)[1];
        while !open.is_anchor(end) && edges.len() <= MAX_EDGES {
            let &[(_, next)] = open.starting_at(end) else { break };
            edges.push(next);
            end = open.ends(next)[1];
        }
        if edges.len() <= MAX_EDGES {
            chains.push(Chain { ends: [start, end], edges });
        }
    }
    chains
}
