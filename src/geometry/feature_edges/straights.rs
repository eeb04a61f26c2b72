//! The straight lines among the edges that are lines from all sides: what strokes follow.
//!
//! They are found in the mesh, so that each is the same one for every camera.

use std::sync::Arc;

use glam::Vec3;

use super::FeatureEdges;
use super::crease_angles::CreaseAngles;
use super::pieces::Piece;
use crate::geometry::Mesh;
use crate::geometry::hand::mix;
use crate::geometry::line_chains::{ChainEdge, ChainLink, Chains, NO_END, for_each_best_pair};

/// Cosine of the angle by which a straight line may turn at a point, 1°: finely tessellated arcs turn by more.
const STRAIGHT: f32 = 0.999_85;
/// Cosine of the angle by which a curve may turn at a point, 25°: polygons up to 14 corners are made of straight lines.
const SMOOTH: f32 = 0.906_3;
/// How far from the line between its ends a straight line may be, as a share of its length.
const MAX_MISS: f32 = 0.004;
/// So many lines of similar length, each smoothly after the other, are a curve.
const CURVE: u32 = 4;
/// How often the longer of two neighbors in a curve has the length of the shorter one.
const SIMILAR: f32 = 3.0;

/// A straight line of one or more edges.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::geometry) struct Straight {
    /// Its ends, local space.
    pub ends: [Vec3; 2],
    /// Whether it is over there; otherwise a curve goes on.
    pub is_end: [bool; 2],
    /// Made of its ends alone: the same however the mesh is ordered.
    pub hash: u32,
}

/// The straight lines for some angles.
#[derive(Debug, Clone, PartialEq, Default)]
pub(in crate::geometry) struct Straights {
    pub lines: Vec<Straight>,
    /// (edge, line), sorted.
    pub by_edge: Vec<(u32, u32)>,
}

impl FeatureEdges {
    /// The straight lines for these angles; made when they are asked for first.
    pub(in crate::geometry) fn straights(&self, mesh: &Mesh, angles: CreaseAngles) -> Arc<Straights> {
        self.cached_straights.get(angles, || Straights::new(self, mesh, angles))
    }
}

impl Straights {
    fn new(all: &FeatureEdges, mesh: &Mesh, angles: CreaseAngles) -> Self {
        let pieces = all.pieces(mesh, angles);
        let Joints { straight, smooth } = Joints::new(&pieces);
        let chains = Chains::joined(&straight);
        let lines: Vec<Option<[Vec3; 2]>> =
            chains.iter().map(|(links, is_closed)| line_of(&pieces, links, is_closed)).collect();
        let mut chain_of = vec![0_u32; pieces.len()];
        for (number, (links, _)) in (0..).zip(chains.iter()) {
            for link in links {
                chain_of[link.link as usize] = number;
            }
        }
        let next = |half: u32| {
            let other = smooth.get(half as usize).copied().filter(|&half| half != NO_END)?;
            chain_of.get(other as usize >> 1).copied()
        };
        let is_curve = curves(&chains, &lines, next);
        let mut found = Self::default();
        for (number, (links, _)) in chains.iter().enumerate() {
            let (Some(Some(ends)), Some([first, last])) = (lines.get(number), outer_halves(links)) else {
                continue;
            };
            if is_curve[number] {
                continue;
            }
            let is_end = [first, last].map(|half| next(half).is_none_or(|other| !is_curve[other as usize]));
            let line = found.lines.len() as u32;
            found.lines.push(Straight::new(*ends, is_end));
            found.by_edge.extend(links.iter().filter_map(|link| {
                let piece = pieces.get(link.link as usize)?;
                Some((piece.edge, line))
            }));
        }
        found.by_edge.sort_unstable();
        found
    }
}

impl Straight {
    fn new(ends: [Vec3; 2], is_end: [bool; 2]) -> Self {
        // Of 0 there are two.
        let hash_of = |p: Vec3| (p + Vec3::ZERO).to_array().into_iter().fold(0, |h, x| mix(h ^ x.to_bits()));
        let hashes = ends.map(hash_of);
        let (ends, is_end, [low, high]) = if hashes[0] <= hashes[1] {
            (ends, is_end, hashes)
        } else {
            ([ends[1], ends[0]], [is_end[1], is_end[0]], [hashes[1], hashes[0]])
        };
        Self { ends, is_end, hash: mix(low ^ mix(high)) }
    }
}

/// For each half (the number of a piece and of one of its ends) the one that goes on from there.
struct Joints {
    straight: Vec<u32>,
    /// Where it goes on, but not straight.
    smooth: Vec<u32>,
}

impl Joints {
    fn new(pieces: &[Piece]) -> Self {
        let links: Vec<ChainEdge> = pieces.iter().map(Piece::chain_edge).collect();
        let none = vec![NO_END; 2 * links.len()];
        let mut all = Self { straight: none.clone(), smooth: none };
        let leave =
            |half: u32| pieces.get(half as usize >> 1).map_or(Vec3::ZERO, |piece| piece.leave(half & 1));
        // What goes on most straightly first.
        let cosine = |[a, b]: [u32; 2]| Some(-leave(a).dot(leave(b))).filter(|&cosine| cosine >= SMOOTH);
        for_each_best_pair(&links, cosine, |[a, b], cosine| {
            let joints = if cosine >= STRAIGHT { &mut all.straight } else { &mut all.smooth };
            joints[a as usize] = b;
            joints[b as usize] = a;
        });
        all
    }
}

/// The two halves at the ends of a chain.
fn outer_halves(links: &[ChainLink]) -> Option<[u32; 2]> {
    let (first, last) = (links.first()?, links.last()?);
    Some([2 * first.link + u32::from(first.reversed), 2 * last.link + u32::from(!last.reversed)])
}

/// The ends of a chain if it is straight.
fn line_of(pieces: &[Piece], links: &[ChainLink], is_closed: bool) -> Option<[Vec3; 2]> {
    let at = |half: u32| pieces.get(half as usize >> 1).map(|piece| piece.ends[half as usize & 1]);
    let [from, to] = outer_halves(links)?.map(at);
    let (from, to) = (from?, to?);
    let length = from.distance(to);
    let direction = (to - from) / length;
    let is_near = |p: Vec3| (p - from).reject_from_normalized(direction).length() <= MAX_MISS * length;
    let is_straight = links.iter().all(|link| at(2 * link.link).is_some_and(is_near));
    (!is_closed && length > 0.0 && is_straight).then_some([from, to])
}

/// Which chains are curves, or parts of one.
fn curves(chains: &Chains, lines: &[Option<[Vec3; 2]>], next: impl Fn(u32) -> Option<u32>) -> Vec<bool> {
    let length = |chain: u32| {
        let line = lines.get(chain as usize).copied().flatten();
        line.map_or(0.0, |[a, b]| a.distance(b))
    };
    let is_similar = |a: f32, b: f32| a <= SIMILAR * b && b <= SIMILAR * a;
    let neighbors: Vec<[Option<u32>; 2]> = (0_u32..)
        .zip(chains.iter())
        .map(|(number, (links, _))| {
            let next = |half: u32| next(half).filter(|&other| is_similar(length(number), length(other)));
            outer_halves(links).map_or([None; 2], |halves| halves.map(next))
        })
        .collect();
    let mut is_curve: Vec<bool> = lines.iter().map(Option::is_none).collect();
    let mut is_seen = vec![false; neighbors.len()];
    for start in 0..neighbors.len() as u32 {
        let (mut row, mut open) = (Vec::new(), vec![start]);
        while let Some(chain) = open.pop() {
            if !std::mem::replace(&mut is_seen[chain as usize], true) {
                row.push(chain);
                open.extend(neighbors[chain as usize].iter().flatten());
            }
        }
        if row.len() as u32 >= CURVE {
            for chain in row {
                is_curve[chain as usize] = true;
            }
        }
    }
    is_curve
}
