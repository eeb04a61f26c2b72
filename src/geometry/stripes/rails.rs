//! How the phases of neighbors go with each other.

use std::f32::consts::{FRAC_PI_2, FRAC_PI_3, PI};

use glam::{Vec2, Vec3};
use rayon::prelude::*;

use super::levels::{DENSITIES, FAMILIES};
use super::lift::sign;
use crate::geometry::direction_field::cut::transport;
use crate::geometry::direction_field::graph::Graph;

/// A unit complex number for each family.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Wave {
    pub(super) re: [f32; FAMILIES],
    pub(super) im: [f32; FAMILIES],
}

impl Wave {
    pub(super) const ONE: Self = Self { re: [1.0; FAMILIES], im: [0.0; FAMILIES] };
    pub(super) const ZERO: Self = Self { re: [0.0; FAMILIES], im: [0.0; FAMILIES] };

    /// The doubled phase.
    pub(super) fn squared(&self) -> Self {
        let mut out = Self::ZERO;
        for f in 0..FAMILIES {
            out.re[f] = self.re[f] * self.re[f] - self.im[f] * self.im[f];
            out.im[f] = 2.0 * self.re[f] * self.im[f];
        }
        out
    }

    pub(super) fn add_scaled(&mut self, other: &Self, weight: f32) {
        for f in 0..FAMILIES {
            self.re[f] += weight * other.re[f];
            self.im[f] += weight * other.im[f];
        }
    }

    /// With unit length, or the other where there is none.
    pub(super) fn normalized_or(&self, other: &Self) -> Self {
        let mut out = *other;
        for f in 0..FAMILIES {
            let length2 = self.re[f] * self.re[f] + self.im[f] * self.im[f];
            if length2 > 1e-30 {
                let scale = 1.0 / length2.sqrt();
                out.re[f] = self.re[f] * scale;
                out.im[f] = self.im[f] * scale;
            }
        }
        out
    }
}

/// A patch with its direction.
#[derive(Clone, Copy)]
struct DirectedPoint {
    position: Vec3,
    normal: Vec3,
    direction: Vec3,
}

impl DirectedPoint {
    fn of(graph: &Graph, patch: usize, direction: Vec3) -> Self {
        Self { position: graph.positions[patch], normal: graph.normals[patch], direction }
    }
}

/// How the phase changes from one place to another.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rail {
    /// −1 if phases count backwards there.
    pub(super) sign: f32,
    /// The change of the phase.
    pub(super) turn: Wave,
}

impl Rail {
    /// What a phase at the end of the rail says about its start.
    #[inline]
    pub(super) fn back(&self, end: &Wave) -> Wave {
        let mut out = Wave::ZERO;
        for f in 0..FAMILIES {
            let (re, im) = (end.re[f], self.sign * end.im[f]);
            out.re[f] = self.turn.re[f] * re + self.turn.im[f] * im;
            out.im[f] = self.turn.re[f] * im - self.turn.im[f] * re;
        }
        out
    }

    /// What a phase at the start of the rail says about its end.
    #[inline]
    pub(super) fn on(&self, start: &Wave) -> Wave {
        let mut out = Wave::ZERO;
        for f in 0..FAMILIES {
            out.re[f] = self.turn.re[f] * start.re[f] - self.turn.im[f] * start.im[f];
            out.im[f] = self.sign * (self.turn.re[f] * start.im[f] + self.turn.im[f] * start.re[f]);
        }
        out
    }

    fn new(from: DirectedPoint, to: DirectedPoint, frequency: f32) -> Self {
        let DirectedPoint { position: p, normal: n, direction: d } = from;
        let DirectedPoint { position: to_p, normal: to_n, direction: to_d } = to;
        // The same for both directions between neighbors, bit for bit.
        let sign = if (p.x, p.y, p.z) <= (to_p.x, to_p.y, to_p.z) {
            sign(d, n, to_d, to_n)
        } else {
            sign(to_d, to_n, d, n)
        };
        let way = to_p - p;
        let along = (d + to_d * sign).dot(way);
        let across = (n.cross(d) + to_n.cross(to_d) * sign).dot(way);
        let mut turn = Wave::ZERO;
        for (f, density) in DENSITIES.iter().enumerate() {
            let (sin, cos) = (FRAC_PI_2 + FRAC_PI_3 * f as f32).sin_cos();
            let angle = PI * frequency * density * (cos * along + sin * across);
            (turn.im[f], turn.re[f]) = angle.sin_cos();
        }
        Self { sign, turn }
    }

    /// For twice the frequency.
    fn double(&mut self) {
        self.turn = self.turn.squared().normalized_or(&Wave::ONE);
    }
}

/// A graph, and the rails between all neighbors at one frequency.
pub(super) struct Track<'a> {
    pub(super) graph: &'a Graph,
    /// One for each neighbor.
    pub(super) rails: Vec<Rail>,
    /// From each patch to the one of the coarser graph that it is part of.
    pub(super) to_parent: Vec<Rail>,
    /// Mean distance of neighbors.
    pub(super) step: f32,
}

impl<'a> Track<'a> {
    /// All graphs of a hierarchy, for the frequency in cycles per extent.
    pub(super) fn hierarchy(graphs: &'a [Graph], directions: &[Vec3], frequency: f32) -> Vec<Self> {
        let mut tracks: Vec<Self> = Vec::new();
        let mut directions = directions.to_vec();
        for (level, graph) in graphs.iter().enumerate() {
            let at = |v: usize| DirectedPoint::of(graph, v, directions[v]);
            let rails = (0..graph.len())
                .into_par_iter()
                .with_min_len(1024)
                .flat_map_iter(|v| {
                    let neighbors = &graph.neighbors[graph.range(v)];
                    neighbors
                        .iter()
                        .map(move |neighbor| Rail::new(at(v), at(neighbor.to as usize), frequency))
                })
                .collect();
            let lengths = (0..graph.len()).flat_map(|v| {
                graph.neighbors[graph.range(v)]
                    .iter()
                    .map(move |l| graph.positions[v].distance(graph.positions[l.to as usize]))
            });
            let step = lengths.sum::<f32>() / graph.neighbors.len().max(1) as f32;
            let mut coarser = Vec::new();
            let mut to_parent = Vec::new();
            if let Some(coarse) = graphs.get(level + 1) {
                coarser = joined(graph, coarse, &directions);
                let rail = |v: usize| {
                    // What has no parent needs no rail to it.
                    let p = graph.parents[v] as usize;
                    let parent = coarser.get(p).map(|&direction| DirectedPoint::of(coarse, p, direction));
                    Rail::new(at(v), parent.unwrap_or(at(v)), frequency)
                };
                to_parent = (0..graph.len()).into_par_iter().with_min_len(1024).map(rail).collect();
            }
            tracks.push(Self { graph, rails, to_parent, step });
            directions = coarser;
        }
        tracks
    }

    /// For twice the frequency.
    pub(super) fn double(&mut self) {
        self.rails.par_iter_mut().with_min_len(4096).for_each(Rail::double);
        self.to_parent.par_iter_mut().with_min_len(4096).for_each(Rail::double);
    }
}

/// The mean directions of the patches of the coarser graph.
fn joined(fine: &Graph, coarse: &Graph, directions: &[Vec3]) -> Vec<Vec3> {
    let mut sums = vec![Vec2::ZERO; coarse.len()];
    for (v, parent) in fine.children() {
        let normal = coarse.normals[parent];
        let (x, y) = normal.any_orthonormal_pair();
        let direction = transport(directions[v], fine.normals[v], normal);
        let angle = Vec2::new(direction.dot(x), direction.dot(y));
        sums[parent] += angle.rotate(angle) * fine.areas[v].max(1e-30);
    }
    let direction = |(sum, &normal): (Vec2, &Vec3)| {
        let (x, y) = normal.any_orthonormal_pair();
        let (sin, cos) = (0.5 * sum.to_angle()).sin_cos();
        x * cos + y * sin
    };
    sums.into_iter().zip(&coarse.normals).map(direction).collect()
}
