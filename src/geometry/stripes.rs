//! Phases of stripes on a surface: families of lines that follow a direction field, at several densities.
//!
//! Three families cross at 60°. Each has a ladder of levels, every one twice as dense as the one before; where the field
//! is parallel, each line of a level is a line of the next. Source: Knoeppel et al., Stripe Patterns on Surfaces, 2015;
//! the ladder is ours.

mod ladder;
mod levels;
pub mod lift;
mod rails;
mod vertex;

use rayon::prelude::*;

use self::ladder::Ladder;
use super::direction_field::Solved;
use super::{FieldOptions, Mesh};

pub use self::levels::{BASE_LEVEL, CYCLES_PER_EXTENT, FAMILIES, LEVELS, Phases};
pub use self::lift::{Corner, TrianglePhases, lift};
pub use self::vertex::{StripeVertex, WORDS};

/// Stripes on a mesh.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StripeField {
    /// The vertices of the mesh cut open at its creases.
    pub vertices: Vec<StripeVertex>,
    /// The vertex at each corner of the mesh's triangles; as long as [`Mesh::indices`].
    pub corner_vertices: Vec<u32>,
    /// Lines of the base level per unit of the mesh; each level has twice as many as the one before.
    pub cycles_per_unit: f32,
}

impl StripeField {
    /// The stripes of a clean mesh; the same bits for the same input. `progress` is given the share that is done, 0 to
    /// 1, and says whether to go on: `None` when it did not.
    pub fn solve(
        mesh: &Mesh,
        options: &FieldOptions,
        progress: &(dyn Fn(f32) -> bool + Sync),
    ) -> Option<Self> {
        const SHARE_OF_FIELD: f32 = 0.2;
        let solved = Solved::new(mesh, options, &|done| progress(SHARE_OF_FIELD * done))?;
        let ladder = Ladder::new(&solved.graphs, &solved.directions);
        let phases = ladder.solve(&|done| progress(SHARE_OF_FIELD + (1.0 - SHARE_OF_FIELD) * done))?;
        let vertex = |(v, phases): (usize, &Phases)| {
            StripeVertex::new(solved.directions[v], solved.cut.normals[v], phases)
        };
        Some(Self {
            vertices: phases.par_iter().with_min_len(4096).enumerate().map(vertex).collect(),
            corner_vertices: solved.corner_vertices(mesh),
            cycles_per_unit: (f64::from(CYCLES_PER_EXTENT) / solved.extent) as f32,
        })
    }

    /// What [`lift()`] needs to know of a triangle of the mesh; `None` if there is no such triangle.
    pub fn corners(&self, mesh: &Mesh, triangle: usize) -> Option<[Corner; 3]> {
        let positions = mesh.triangles().get(triangle)?;
        let vertices = self.corner_vertices.as_chunks::<3>().0.get(triangle)?;
        let corner = |k: usize| {
            let vertex = self.vertices.get(vertices[k] as usize)?;
            Some(Corner {
                position: *mesh.positions.get(positions[k] as usize)?,
                direction: vertex.direction(),
                normal: vertex.normal(),
                phases: vertex.phases(),
            })
        };
        Some([corner(0)?, corner(1)?, corner(2)?])
    }
}

#[cfg(test)]
#[path = "stripes/tests.rs"]
mod tests;
