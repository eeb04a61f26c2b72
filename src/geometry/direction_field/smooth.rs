//! Directions without front and back that are as parallel as what is known of them permits.
//!
//! A direction at the angle `a` in the frame of a vertex is the complex number `e^(2 i a)`, which is the same for both
//! of its ends. The sum over all edges of the squared differences, plus the weighted squares of the differences to the
//! data, is least. Source: Knoeppel et al., Globally Optimal Direction Fields, 2013.

use glam::{Vec2, Vec3};
use rayon::prelude::*;

use super::cut::transport;
use super::graph::Graph;

/// What is known at each patch of a graph: the sum of weighted directions (as complex numbers in the frame of the
/// patch), and the sum of the weights.
#[derive(Clone)]
pub(crate) struct Data {
    pub(crate) sums: Vec<Vec2>,
    pub(crate) weights: Vec<f32>,
}

impl Data {
    pub(crate) fn new(count: usize) -> Self {
        Self { sums: vec![Vec2::ZERO; count], weights: vec![0.0; count] }
    }

    /// Adds a direction at a patch with this normal; its length does not matter.
    pub(crate) fn add(&mut self, v: usize, normal: Vec3, direction: Vec3, weight: f32) {
        let (x, y) = normal.any_orthonormal_pair();
        let angle = Vec2::new(direction.dot(x), direction.dot(y));
        if weight > 0.0
            && let Some(angle) = angle.try_normalize()
        {
            self.sums[v] += angle.rotate(angle) * weight;
            self.weights[v] += weight;
        }
    }
}

/// The smooth unit directions at the patches of the finest graph. `None` when `go_on` says no.
pub(crate) fn smooth(graphs: &[Graph], data: Data, go_on: &(dyn Fn() -> bool + Sync)) -> Option<Vec<Vec3>> {
    let mut levels = vec![data];
    for (fine, coarse) in graphs.iter().zip(graphs.iter().skip(1)) {
        let of_fine = levels.last()?;
        let mut of_coarse = Data::new(coarse.len());
        for (v, parent) in fine.children() {
            of_coarse.sums[parent] += of_fine.sums[v].rotate(turn(fine.normals[v], coarse.normals[parent]));
            of_coarse.weights[parent] += of_fine.weights[v];
        }
        levels.push(of_coarse);
    }
    let mut guess: Vec<Vec2> = Vec::new();
    for (level, (graph, data)) in graphs.iter().zip(&levels).enumerate().rev() {
        if !go_on() {
            return None;
        }
        let from_parent =
            |(v, &parent): (usize, &u32)| match (graphs.get(level + 1), guess.get(parent as usize)) {
                (Some(coarse), Some(u)) => u.rotate(turn(coarse.normals[parent as usize], graph.normals[v])),
                _ => data.sums[v] / data.weights[v].max(1e-30),
            };
        guess = match graph.parents.len() {
            0 => vec![Vec2::ZERO; graph.len()],
            _ => graph.parents.par_iter().with_min_len(4096).enumerate().map(from_parent).collect(),
        };
        System::new(graph, data).solve(&mut guess, if level + 1 == graphs.len() { 200 } else { 24 });
    }
    let direction = |(u, &normal): (&Vec2, &Vec3)| {
        let (x, y) = normal.any_orthonormal_pair();
        let (sin, cos) = (0.5 * u.to_angle()).sin_cos();
        x * cos + y * sin
    };
    graphs.first().map(|finest| guess.iter().zip(&finest.normals).map(direction).collect())
}

/// The factor that takes a direction in the frame of one normal to that of another.
fn turn(from: Vec3, to: Vec3) -> Vec2 {
    let x = transport(from.any_orthonormal_pair().0, from, to);
    let (to_x, to_y) = to.any_orthonormal_pair();
    let angle = Vec2::new(x.dot(to_x), x.dot(to_y)).normalize_or(Vec2::X);
    angle.rotate(angle)
}

/// Linear equations whose matrix is Hermitian and positive.
struct System<'a> {
    graph: &'a Graph,
    data: &'a Data,
    /// For each neighbor the factor that takes its end's direction to its start's frame, times its weight.
    factors: Vec<Vec2>,
    diagonal: Vec<f32>,
}

/// Vectors are handled in chunks of this many numbers, one after the other where sums must not depend on threads.
const CHUNK: usize = 4096;

impl<'a> System<'a> {
    fn new(graph: &'a Graph, data: &'a Data) -> Self {
        let rows: Vec<(usize, f32)> = (0..graph.len())
            .map(|v| {
                let sum: f32 = graph.neighbors[graph.range(v)].iter().map(|neighbor| neighbor.weight).sum();
                (v, sum + data.weights[v])
            })
            .collect();
        let mut factors = vec![Vec2::ZERO; graph.neighbors.len()];
        let mut rest = factors.as_mut_slice();
        let mut jobs = Vec::new();
        for chunk in rows.chunks(CHUNK) {
            let (first, last) = (chunk[0].0, chunk[chunk.len() - 1].0);
            let (own, after) = rest.split_at_mut(graph.range(last).end - graph.range(first).start);
            rest = after;
            jobs.push((first..last + 1, own));
        }
        jobs.into_par_iter().for_each(|(rows, factors)| {
            let mut factors = factors.iter_mut();
            for v in rows {
                for (neighbor, factor) in graph.neighbors[graph.range(v)].iter().zip(&mut factors) {
                    *factor = turn(graph.normals[neighbor.to as usize], graph.normals[v]) * neighbor.weight;
                }
            }
        });
        let diagonal = rows.into_iter().map(|(_, d)| d.max(1e-30)).collect();
        Self { graph, data, factors, diagonal }
    }

    fn apply(&self, u: &[Vec2], out: &mut [Vec2]) {
        out.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, out)| {
            for (k, out) in out.iter_mut().enumerate() {
                let v = chunk * CHUNK + k;
                let range = self.graph.range(v);
                let mut sum = u[v] * self.diagonal[v];
                for (neighbor, factor) in self.graph.neighbors[range.clone()].iter().zip(&self.factors[range])
                {
                    sum -= u[neighbor.to as usize].rotate(*factor);
                }
                *out = sum;
            }
        });
    }

    /// Conjugate gradients with the diagonal as preconditioner, from a guess.
    fn solve(&self, u: &mut [Vec2], max_steps: usize) {
        let count = u.len();
        let mut image = vec![Vec2::ZERO; count];
        self.apply(u, &mut image);
        let mut residual: Vec<Vec2> = self.data.sums.iter().zip(&image).map(|(b, a)| b - a).collect();
        let mut step: Vec<Vec2> = residual.iter().zip(&self.diagonal).map(|(r, d)| r / d).collect();
        let mut energy = dot(&residual, |v| residual[v] / self.diagonal[v]);
        let enough = 1e-8 * dot(&self.data.sums, |v| self.data.sums[v] / self.diagonal[v]);
        for _ in 0..max_steps {
            if energy.is_nan() || energy <= enough {
                return;
            }
            self.apply(&step, &mut image);
            let alpha = (energy / dot(&step, |v| image[v])) as f32;
            if !alpha.is_finite() {
                return;
            }
            let both = u.par_chunks_mut(CHUNK).zip(residual.par_chunks_mut(CHUNK)).enumerate();
            both.for_each(|(chunk, (u, residual))| {
                for (k, (u, residual)) in u.iter_mut().zip(residual).enumerate() {
                    *u += step[chunk * CHUNK + k] * alpha;
                    *residual -= image[chunk * CHUNK + k] * alpha;
                }
            });
            let next = dot(&residual, |v| residual[v] / self.diagonal[v]);
            let beta = (next / energy) as f32;
            energy = next;
            step.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, step)| {
                for (k, step) in step.iter_mut().enumerate() {
                    let v = chunk * CHUNK + k;
                    *step = residual[v] / self.diagonal[v] + *step * beta;
                }
            });
        }
    }
}

/// Scalar product, the same for any number of threads.
fn dot(a: &[Vec2], b: impl Fn(usize) -> Vec2 + Sync) -> f64 {
    let of_chunk = |(chunk, a): (usize, &[Vec2])| -> f64 {
        a.iter().enumerate().map(|(k, a)| f64::from(a.dot(b(chunk * CHUNK + k)))).sum()
    };
    let sums: Vec<f64> = a.par_chunks(CHUNK).enumerate().map(of_chunk).collect();
    sums.iter().sum()
}
