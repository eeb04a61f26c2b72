//! Polygonizes an implicit surface and makes its triangles even: long edges are split, short ones collapsed, others
//! flipped, and all points slide along the surface until they are well spread (Botsch and Kobbelt 2004).

use std::collections::{BTreeMap, BTreeSet};

use fast_surface_nets::ndshape::{RuntimeShape, Shape};
use fast_surface_nets::{SurfaceNetsBuffer, surface_nets};
use glam::{DVec3, dvec3};

use crate::sdf::{gradient, project};

/// A closed surface: points and triangles between them.
pub(crate) struct Surface {
    /// Positions, on the surface.
    pub(crate) points: Vec<DVec3>,
    /// Counter-clockwise from outside.
    pub(crate) faces: Vec<[usize; 3]>,
    /// The wanted length of edges at each point.
    sizes: Vec<f64>,
}

/// How long edges should be.
#[derive(Clone, Copy)]
pub(crate) struct Sizing {
    /// The shortest.
    pub(crate) finest: f64,
    /// The longest.
    pub(crate) coarsest: f64,
    /// The angle in radians by which the surface may turn along one edge, within those limits.
    pub(crate) turn: f64,
}

/// The surface `f = 0` inside the box, found on a grid of `cell`, with edges about as long as `sizing` says.
pub(crate) fn polygonize(
    f: &impl Fn(DVec3) -> f64,
    (low, high): (DVec3, DVec3),
    cell: f64,
    sizing: Sizing,
) -> Surface {
    let mut surface = nets(f, low, high, cell);
    surface.untangle();
    surface.relax(f);
    for _ in 0..8 {
        surface.measure(f, sizing);
        surface.split();
        surface.collapse();
        surface.flip();
        surface.relax(f);
    }
    for _ in 0..3 {
        surface.flip();
        surface.relax(f);
    }
    surface
}

/// Naive surface nets.
fn nets(f: &impl Fn(DVec3) -> f64, low: DVec3, high: DVec3, cell: f64) -> Surface {
    let count = ((high - low) / cell).ceil().as_uvec3() + 1;
    let shape = RuntimeShape::<u32, 3>::new(count.to_array());
    let at = |[x, y, z]: [u32; 3]| low + cell * dvec3(f64::from(x), f64::from(y), f64::from(z));
    let samples = sample(f, &shape, count.to_array(), cell, &at);
    let mut buffer = SurfaceNetsBuffer::default();
    let last = (count - 1).to_array();
    surface_nets(&samples, &shape, [0; 3], last, &mut buffer);
    Surface {
        points: buffer.positions.iter().map(|p| low + cell * DVec3::from(p.map(f64::from))).collect(),
        faces: buffer
            .indices
            .chunks_exact(3)
            .map(|c| [c[0] as usize, c[1] as usize, c[2] as usize])
            .collect(),
        sizes: Vec::new(),
    }
}

/// The distance at each grid point; in blocks far from the surface only its sign is right.
fn sample(
    f: &impl Fn(DVec3) -> f64,
    shape: &RuntimeShape<u32, 3>,
    count: [u32; 3],
    cell: f64,
    at: &impl Fn([u32; 3]) -> DVec3,
) -> Vec<f32> {
    const BLOCK: u32 = 8;
    let mut samples = vec![1.0_f32; shape.size() as usize];
    let blocks = count.map(|n| n.div_ceil(BLOCK));
    let blocks = RuntimeShape::<u32, 3>::new(blocks);
    for block in 0..blocks.size() {
        let first = blocks.delinearize(block).map(|v| v * BLOCK);
        let middle = f(at(first) + cell * f64::from(BLOCK) / 2.0);
        // The distances are only roughly distances; half the diagonal, twice over, is safe.
        let far = middle.abs() > 2.0 * cell * f64::from(BLOCK) * 0.87;
        let last = [0, 1, 2].map(|axis| (first[axis] + BLOCK).min(count[axis]));
        for z in first[2]..last[2] {
            for y in first[1]..last[1] {
                for x in first[0]..last[0] {
                    let value = if far { middle } else { f(at([x, y, z])) };
                    samples[shape.linearize([x, y, z]) as usize] = value as f32;
                }
            }
        }
    }
    samples
}

impl Surface {
    /// For each directed edge its face.
    fn edges(&self) -> BTreeMap<(usize, usize), usize> {
        let mut edges = BTreeMap::new();
        for (f, face) in self.faces.iter().enumerate() {
            for k in 0..3 {
                edges.insert((face[k], face[(k + 1) % 3]), f);
            }
        }
        edges
    }

    /// Finds the wanted lengths from how fast the normal turns around each point.
    fn measure(&mut self, f: &impl Fn(DVec3) -> f64, sizing: Sizing) {
        let reach = sizing.finest * 0.8;
        let own: Vec<f64> = self
            .points
            .iter()
            .map(|&p| {
                let n = gradient(f, p).normalize_or_zero();
                let t = n.any_orthonormal_vector();
                let b = n.cross(t);
                let turn = [t, b, (t + b) * 0.707, (t - b) * 0.707]
                    .map(|d| {
                        let turn = |d: DVec3| {
                            let there = gradient(f, p + d * reach).normalize_or_zero();
                            // Hollows may be coarser than bulges: they are never seen against the sky.
                            let hollow = if there.dot(d) < 0.0 { 1.35 } else { 1.0 };
                            there.angle_between(n) / hollow
                        };
                        turn(d).max(turn(-d))
                    })
                    .into_iter()
                    .fold(1e-3, f64::max);
                (sizing.turn * reach / turn).clamp(sizing.finest, sizing.coarsest)
            })
            .collect();
        // Sizes grow gently from point to point.
        let neighbors = self.neighbors();
        self.sizes = own;
        for _ in 0..3 {
            self.sizes = (0..self.points.len())
                .map(|i| neighbors[i].iter().fold(self.sizes[i], |size, &j| size.min(self.sizes[j] * 1.25)))
                .collect();
        }
    }

    /// Each edge once, with its length relative to the wanted one.
    fn lengths(&self) -> Vec<(f64, usize, usize)> {
        let edges = self.edges();
        let mut out: Vec<_> = edges
            .keys()
            .filter(|(a, b)| a < b)
            .map(|&(a, b)| {
                let (p, q) = (self.points[a], self.points[b]);
                (2.0 * p.distance(q) / (self.sizes[a] + self.sizes[b]), a, b)
            })
            .collect();
        out.sort_by(|x, y| x.partial_cmp(y).unwrap_or(std::cmp::Ordering::Equal));
        out
    }

    /// The face's corner that is neither `a` nor `b`.
    fn apex(&self, face: usize, a: usize, b: usize) -> usize {
        let [x, y, z] = self.faces[face];
        if x != a && x != b {
            x
        } else if y != a && y != b {
            y
        } else {
            z
        }
    }

    /// Halves edges that are too long, the longest first.
    fn split(&mut self) {
        for _ in 0..4 {
            let mut long = self.lengths();
            long.retain(|e| e.0 > 4.0 / 3.0);
            if long.is_empty() {
                return;
            }
            let edges = self.edges();
            let mut stale = vec![false; self.faces.len()];
            for &(_, a, b) in long.iter().rev() {
                let (f, g) = (edges[&(a, b)], edges[&(b, a)]);
                if stale[f] || stale[g] {
                    continue;
                }
                let (c, d) = (self.apex(f, a, b), self.apex(g, a, b));
                let m = self.points.len();
                self.points.push((self.points[a] + self.points[b]) / 2.0);
                self.sizes.push((self.sizes[a] + self.sizes[b]) / 2.0);
                self.faces[f] = [a, m, c];
                self.faces[g] = [b, m, d];
                self.faces.push([m, b, c]);
                self.faces.push([m, a, d]);
                (stale[f], stale[g]) = (true, true);
            }
        }
    }

    /// The neighbors of each point.
    pub(crate) fn neighbors(&self) -> Vec<BTreeSet<usize>> {
        let mut out = vec![BTreeSet::new(); self.points.len()];
        for face in &self.faces {
            for k in 0..3 {
                out[face[k]].insert(face[(k + 1) % 3]);
                out[face[(k + 1) % 3]].insert(face[k]);
            }
        }
        out
    }

    /// Merges the ends of edges that are too short where that keeps the surface a surface.
    fn collapse(&mut self) {
        for _ in 0..4 {
            let neighbors = self.neighbors();
            let mut around: Vec<Vec<usize>> = vec![Vec::new(); self.points.len()];
            for (f, face) in self.faces.iter().enumerate() {
                face.iter().for_each(|&i| around[i].push(f));
            }
            let mut frozen = vec![false; self.points.len()];
            let mut becomes: Vec<usize> = (0..self.points.len()).collect();
            let mut any = false;
            for (_, a, b) in self.lengths().into_iter().take_while(|e| e.0 < 0.8) {
                let ring = || neighbors[a].union(&neighbors[b]);
                if ring().any(|&i| frozen[i])
                    || neighbors[a].intersection(&neighbors[b]).count() != 2
                    || neighbors[a].intersection(&neighbors[b]).any(|&i| neighbors[i].len() < 5)
                {
                    continue;
                }
                let middle = (self.points[a] + self.points[b]) / 2.0;
                let size = (self.sizes[a] + self.sizes[b]) / 2.0;
                let too_long = ring().any(|&i| {
                    let p = self.points[i];
                    p.distance(middle) > 4.0 / 3.0 * (self.sizes[i] + size) / 2.0
                });
                let turns = around[a].iter().chain(&around[b]).any(|&f| {
                    let face = self.faces[f];
                    if face.contains(&a) && face.contains(&b) {
                        return false;
                    }
                    let before = face.map(|i| self.points[i]);
                    let after = face.map(|i| if i == a || i == b { middle } else { self.points[i] });
                    cosine(normal(before), normal(after)) < 0.5
                });
                if too_long || turns {
                    continue;
                }
                ring().for_each(|&i| frozen[i] = true);
                self.points[a] = middle;
                self.sizes[a] = size;
                becomes[b] = a;
                any = true;
            }
            if !any {
                return;
            }
            self.faces.iter_mut().flatten().for_each(|i| *i = becomes[*i]);
            self.faces.retain(|[a, b, c]| a != b && b != c && c != a);
            self.compact();
        }
    }

    /// Drops points that no face uses.
    fn compact(&mut self) {
        let mut number = vec![usize::MAX; self.points.len()];
        let mut kept = Vec::new();
        let mut sizes = Vec::new();
        for i in self.faces.iter_mut().flatten() {
            if number[*i] == usize::MAX {
                number[*i] = kept.len();
                kept.push(self.points[*i]);
                sizes.push(self.sizes[*i]);
            }
            *i = number[*i];
        }
        self.points = kept;
        self.sizes = sizes;
    }

    /// Flips edges where that brings the points closer to having six neighbors.
    fn flip(&mut self) {
        let neighbors = self.neighbors();
        let mut valence: Vec<i32> = neighbors.iter().map(|n| n.len() as i32).collect();
        let edges = self.edges();
        let mut stale = vec![false; self.faces.len()];
        let mut added: BTreeSet<(usize, usize)> = BTreeSet::new();
        for (&(a, b), &f) in &edges {
            let g = edges[&(b, a)];
            if a > b || stale[f] || stale[g] {
                continue;
            }
            let (c, d) = (self.apex(f, a, b), self.apex(g, a, b));
            let key = (c.min(d), c.max(d));
            if neighbors[c].contains(&d) || added.contains(&key) || valence[a] < 5 || valence[b] < 5 {
                continue;
            }
            let off = |i: usize, change: i32| (valence[i] + change - 6).pow(2);
            let before = off(a, 0) + off(b, 0) + off(c, 0) + off(d, 0);
            let after = off(a, -1) + off(b, -1) + off(c, 1) + off(d, 1);
            if after >= before {
                continue;
            }
            let face = |f: [usize; 3]| normal(f.map(|i| self.points[i]));
            let old = face([a, b, c]) + face([b, a, d]);
            let (new_f, new_g) = ([a, d, c], [d, b, c]);
            if cosine(face(new_f), old) < 0.7 || cosine(face(new_g), old) < 0.7 {
                continue;
            }
            self.faces[f] = new_f;
            self.faces[g] = new_g;
            (stale[f], stale[g]) = (true, true);
            added.insert(key);
            for (i, change) in [(a, -1), (b, -1), (c, 1), (d, 1)] {
                valence[i] += change;
            }
        }
    }

    /// Moves each point towards the middle of its neighbors, along the surface.
    fn relax(&mut self, f: &impl Fn(DVec3) -> f64) {
        let neighbors = self.neighbors();
        self.points = (0..self.points.len())
            .map(|i| {
                let p = self.points[i];
                let sum: DVec3 = neighbors[i].iter().map(|&j| self.points[j]).sum();
                let move_by = sum / neighbors[i].len() as f64 - p;
                let n = gradient(f, p).normalize_or_zero();
                project(f, p + 0.7 * (move_by - n * n.dot(move_by)))
            })
            .collect();
    }
}

/// The normal of a triangle, twice its area long.
pub(crate) fn normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

/// The cosine of the angle between two vectors.
pub(crate) fn cosine(a: DVec3, b: DVec3) -> f64 {
    a.normalize_or_zero().dot(b.normalize_or_zero())
}
