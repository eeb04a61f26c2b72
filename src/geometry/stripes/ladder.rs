//! The phases of all levels: the coarse ones from coarse graphs to the fine one, each other from the one before it.

use std::collections::VecDeque;
use std::f32::consts::TAU;

use glam::Vec3;
use rayon::prelude::*;

use super::levels::{BASE_LEVEL, CYCLES_PER_EXTENT, FAMILIES, LEVELS, Phases};
use super::rails::{Rail, Track, Wave};
use crate::geometry::direction_field::graph::Graph;
use crate::geometry::disjoint_sets::DisjointSets;

/// Levels that are solved on coarse graphs first.
const COARSE_LEVELS: usize = 5;
/// Edges of the coarsest graph on which a level is solved are at most this many cycles long.
const LONGEST_STEP: f32 = 0.4;
/// Sweeps over the finest graph, over coarser ones, and over the one to begin with.
const SWEEPS: usize = 20;
const COARSE_SWEEPS: usize = 60;
const COARSEST_SWEEPS: usize = 200;
/// Weight of a patch's own phase in a sweep, relative to all of its neighbors.
const INERTIA: f32 = 0.3;
/// How strongly a level is held to the doubled phases of the one before, per cycle and extent.
const PULL: f32 = 1.0;
/// At most this much of the weight of all neighbors: large triangles must be free to end lines.
const MAX_PULL: f32 = 0.3;
/// Around a thin tube lines are a whole number, and the double of one that was rounded need not be the best: where so few lines lie
/// on a part, and doubled phases strain it more than that, they are compared with others, which take their place if they strain it
/// so much less.
const FEW_LINES: f32 = 5.0;
const STRAINED: f32 = 0.02;
const LESS_STRAINED: f32 = 0.5;

/// The phases of a surface, level by level.
pub(super) struct Ladder<'a> {
    tracks: Vec<Track<'a>>,
    /// The phases of the level before on each graph.
    waves: Vec<Vec<Wave>>,
    frequency: f32,
    /// Which of the connected parts each patch of the finest graph belongs to.
    part_of: Vec<u32>,
    /// Area of each of them by the diagonal of its box, in extents: of a tube the way around it.
    widths: Vec<f32>,
}

impl<'a> Ladder<'a> {
    /// For a hierarchy of graphs, and the directions of the finest.
    pub(super) fn new(graphs: &'a [Graph], directions: &[Vec3]) -> Self {
        let frequency = CYCLES_PER_EXTENT * (-(BASE_LEVEL as f32)).exp2();
        let (part_of, widths) = graphs.first().map_or_else(Default::default, parts);
        let tracks = Track::hierarchy(graphs, directions, frequency);
        Self { tracks, waves: Vec::new(), frequency, part_of, widths }
    }

    /// The phases of every vertex. `None` when `progress` says so.
    pub(super) fn solve(mut self, progress: &(dyn Fn(f32) -> bool + Sync)) -> Option<Vec<Phases>> {
        let count = self.tracks.first().map_or(0, |t| t.graph.len());
        let mut phases = vec![[[0; LEVELS]; FAMILIES]; count];
        for level in 0..LEVELS {
            self.solve_level(level, &|| progress(level as f32 / LEVELS as f32))?;
            if let Some(waves) = self.waves.first() {
                phases.par_iter_mut().zip(waves).with_min_len(1024).for_each(|(phases, wave)| {
                    for ((phases, im), re) in phases.iter_mut().zip(wave.im).zip(wave.re) {
                        let cycles = im.atan2(re) / TAU;
                        phases[level] = ((cycles * 65536.0).round() as i32 & 0xffff) as u16;
                    }
                });
            }
            self.tracks.par_iter_mut().for_each(Track::double);
            self.frequency *= 2.0;
        }
        Some(phases)
    }

    /// The phases of one level on all graphs. `None` when `go_on` says no.
    fn solve_level(&mut self, level: usize, go_on: &dyn Fn() -> bool) -> Option<()> {
        let mut waves = self.settled(level, &self.waves, go_on)?;
        if !self.waves.is_empty() {
            self.unwind(level, &mut waves, go_on)?;
        }
        self.keep(waves);
        Some(())
    }

    /// Gives thin parts that doubled phases strain others, if those strain them less. `None` when `go_on` says no.
    fn unwind(&self, level: usize, doubled: &mut [Wave], go_on: &dyn Fn() -> bool) -> Option<()> {
        let is_thin: Vec<bool> = self.widths.iter().map(|width| width * self.frequency < FEW_LINES).collect();
        if !is_thin.contains(&true) {
            return Some(());
        }
        let strains = self.strains(doubled);
        let is_strained = |part: usize, f: usize| is_thin[part] && strains[part][f] > STRAINED;
        if !(0..strains.len()).any(|part| (0..FAMILIES).any(|f| is_strained(part, f))) {
            return Some(());
        }
        let anew = self.settled(level, &[], go_on)?;
        let strains_anew = self.strains(&anew);
        for (v, (wave, anew)) in doubled.iter_mut().zip(&anew).enumerate() {
            let part = self.part_of[v] as usize;
            for f in 0..FAMILIES {
                if is_strained(part, f) && strains_anew[part][f] < LESS_STRAINED * strains[part][f] {
                    (wave.re[f], wave.im[f]) = (anew.re[f], anew.im[f]);
                }
            }
        }
        Some(())
    }

    /// How far the phases of each part are from what its directions ask for: 0: nowhere, 2: as far as can be.
    fn strains(&self, waves: &[Wave]) -> Vec<[f32; FAMILIES]> {
        let mut strains = vec![[0.0; FAMILIES]; self.widths.len()];
        let mut weights = vec![0.0_f32; self.widths.len()];
        let Some(track) = self.tracks.first() else { return strains };
        for (v, wave) in waves.iter().enumerate() {
            let part = self.part_of[v] as usize;
            let range = track.graph.range(v);
            for (neighbor, rail) in track.graph.neighbors[range.clone()].iter().zip(&track.rails[range]) {
                let other = rail.back(&waves[neighbor.to as usize]);
                weights[part] += neighbor.weight;
                for (f, strain) in strains[part].iter_mut().enumerate() {
                    *strain += neighbor.weight * (1.0 - wave.re[f] * other.re[f] - wave.im[f] * other.im[f]);
                }
            }
        }
        for (strains, weight) in strains.iter_mut().zip(weights) {
            *strains = strains.map(|strain| strain / weight.max(1e-30));
        }
        strains
    }

    /// The phases of one level on the finest graph, from those of the level before on each graph, or from nothing where there are
    /// none. `None` when `go_on` says no.
    fn settled(&self, level: usize, before: &[Vec<Wave>], go_on: &dyn Fn() -> bool) -> Option<Vec<Wave>> {
        let fits = |track: &Track<'_>| track.step * self.frequency <= LONGEST_STEP;
        let coarsest =
            if level < COARSE_LEVELS { self.tracks.iter().rposition(fits).unwrap_or(0) } else { 0 };
        let finest = self.tracks.first().map_or(0, |t| t.graph.len());
        let mut waves: Vec<Wave> = Vec::new();
        for g in (0..=coarsest).rev() {
            if !go_on() {
                return None;
            }
            let track = self.tracks.get(g)?;
            let targets: Option<Vec<Wave>> =
                before.get(g).map(|before| before.par_iter().map(Wave::squared).collect());
            let is_coarsest = g == coarsest;
            waves = match (&targets, is_coarsest) {
                (Some(targets), true) => targets.clone(),
                (None, true) => spread(track),
                _ => {
                    let parents = track.graph.parents.par_iter().zip(&track.to_parent).enumerate();
                    let from_parent = |(v, (&parent, rail)): (usize, (&u32, &Rail))| {
                        let alone = || targets.as_ref().and_then(|t| t.get(v)).copied().unwrap_or(Wave::ONE);
                        waves.get(parent as usize).map_or_else(alone, |wave| rail.back(wave))
                    };
                    parents.with_min_len(1024).map(from_parent).collect()
                }
            };
            let pull = (PULL * self.frequency).powi(2);
            let sweeps = match g {
                0 => SWEEPS,
                // Not more work than on the finest graph, where this one is about as large.
                _ if is_coarsest => (COARSE_SWEEPS * finest / track.graph.len().max(1)).min(COARSEST_SWEEPS),
                _ => COARSE_SWEEPS,
            };
            for _ in 0..sweeps {
                waves = swept(track, &waves, targets.as_deref(), pull);
            }
        }
        Some(waves)
    }

    /// What the next level asks for on coarser graphs.
    fn keep(&mut self, waves: Vec<Wave>) {
        self.waves = vec![waves];
        for (fine, coarse) in self.tracks.iter().zip(self.tracks.iter().skip(1)) {
            let Some(of_fine) = self.waves.last() else {
                break;
            };
            let mut sums = vec![Wave::ZERO; coarse.graph.len()];
            for (v, parent) in fine.graph.children() {
                sums[parent].add_scaled(&fine.to_parent[v].on(&of_fine[v]), fine.graph.areas[v].max(1e-30));
            }
            for sum in &mut sums {
                *sum = sum.normalized_or(&Wave::ONE);
            }
            self.waves.push(sums);
        }
    }
}

/// Numbers of the connected parts of a graph, for each patch, and the width of each part.
fn parts(graph: &Graph) -> (Vec<u32>, Vec<f32>) {
    let sets = DisjointSets::new(graph.len());
    for v in 0..graph.len() {
        for neighbor in &graph.neighbors[graph.range(v)] {
            sets.unite(v as u32, neighbor.to);
        }
    }
    let (part_of, count) = sets.numbered();
    let mut areas = vec![0.0; count];
    let mut boxes = vec![(Vec3::INFINITY, Vec3::NEG_INFINITY); count];
    for (v, part) in part_of.iter().map(|part| *part as usize).enumerate() {
        areas[part] += graph.areas[v];
        let (min, max) = boxes[part];
        boxes[part] = (min.min(graph.positions[v]), max.max(graph.positions[v]));
    }
    let widths =
        areas.iter().zip(boxes).map(|(area, (min, max))| area / min.distance(max).max(1e-30)).collect();
    (part_of, widths)
}

/// Phases that agree along a tree through each connected part of a graph.
fn spread(track: &Track<'_>) -> Vec<Wave> {
    let graph = track.graph;
    let mut waves: Vec<Option<Wave>> = vec![None; graph.len()];
    let mut queue = VecDeque::new();
    for seed in 0..graph.len() {
        if waves[seed].is_some() {
            continue;
        }
        waves[seed] = Some(Wave::ONE);
        queue.push_back(seed);
        while let Some(v) = queue.pop_front() {
            let wave = waves[v].unwrap_or(Wave::ONE);
            for (end, rail) in graph.neighbors[graph.range(v)].iter().zip(&track.rails[graph.range(v)]) {
                let wave_there = &mut waves[end.to as usize];
                if wave_there.is_none() {
                    *wave_there = Some(rail.on(&wave));
                    queue.push_back(end.to as usize);
                }
            }
        }
    }
    waves.into_iter().map(|w| w.unwrap_or(Wave::ONE)).collect()
}

/// One sweep of Jacobi's method towards phases that agree with those of the neighbors and with the targets. Every phase
/// keeps unit length, else weak parts of the surface would be lost.
fn swept(track: &Track<'_>, waves: &[Wave], targets: Option<&[Wave]>, pull: f32) -> Vec<Wave> {
    let graph = track.graph;
    let new = |v: usize| {
        let range = graph.range(v);
        let mut sum = Wave::ZERO;
        let mut total = 0.0;
        for (neighbor, rail) in graph.neighbors[range.clone()].iter().zip(&track.rails[range]) {
            sum.add_scaled(&rail.back(&waves[neighbor.to as usize]), neighbor.weight);
            total += neighbor.weight;
        }
        if let Some(targets) = targets {
            sum.add_scaled(&targets[v], (pull * graph.areas[v]).min(MAX_PULL * total.max(1e-30)));
        }
        sum.add_scaled(&waves[v], INERTIA * total);
        sum.normalized_or(&waves[v])
    };
    (0..graph.len()).into_par_iter().with_min_len(1024).map(new).collect()
}
