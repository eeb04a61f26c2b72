//! Stripes of hatching on the device: for each triangle of a mesh, as it is drawn, where strokes run.

use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3};

use crate::document::Document;
use crate::geometry::stripes::{StripeField, StripeVertex};
use crate::geometry::{Bounds, CreaseRule, FieldOptions, Mesh, Patches, Topology};
use crate::gpu::geometry::triangle_corners;
use crate::gpu::{Gpu, GpuError, RecordTexture, Target};
use crate::hatching::cache::Cache;
use crate::hatching::stripes::stripes_of;
use crate::scene::Scene;

/// Stripes that somebody wants: which mesh, and how they run on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StripeRequest {
    /// The mesh.
    pub mesh: usize,
    /// How they run.
    pub options: FieldOptions,
}

/// What decides where stripes run beside the style of an object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StripesBy {
    /// Direction to the first light, world space, if that is parallel and stands still.
    pub fixed_light: Option<DVec3>,
    /// Which edges are creases, which no stripe crosses.
    pub crease_rule: CreaseRule,
}

impl StripesBy {
    /// What a document says.
    pub fn new(document: &Document, scene: &Scene) -> Self {
        Self { fixed_light: document.fixed_light(scene), crease_rule: document.view.creases().rule }
    }
}

/// Stripes that have been found.
#[derive(Debug, Clone)]
pub struct SolvedStripes {
    /// What was asked for.
    pub request: StripeRequest,
    /// What was found.
    pub field: Arc<StripeField>,
}

impl SolvedStripes {
    /// Finds stripes, or takes them from a cache. `progress` is given the share that is done, 0 to 1, and says whether to go on:
    /// `None` when it did not.
    pub fn solve(
        cache: &Cache,
        scene: &Scene,
        requests: &[StripeRequest],
        progress: &(dyn Fn(f32) -> bool + Sync),
    ) -> Option<Vec<Self>> {
        let triangles = |r: &StripeRequest| scene.meshes.get(r.mesh).map_or(0, |mesh| mesh.triangle_count());
        let all = requests.iter().map(triangles).sum::<usize>().max(1) as f32;
        let mut done = 0.0;
        let mut solved = Vec::with_capacity(requests.len());
        for request in requests {
            let Some(mesh) = scene.meshes.get(request.mesh) else { continue };
            let share = triangles(request) as f32 / all;
            let field = stripes_of(cache, mesh, &request.options, &|part| progress(done + part * share))?;
            solved.push(Self { request: *request, field: Arc::new(field) });
            done += share;
            if !progress(done) {
                return None;
            }
        }
        Some(solved)
    }
}

/// Where the stripes of a mesh lie on the device.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StripePlace {
    /// The record of its first triangle.
    pub first_triangle: u32,
    /// Lines of the base level per unit of the mesh.
    pub cycles_per_unit: f32,
    /// The grid on which its vertices lie.
    pub grid: Grid,
}

/// A cube around a mesh, in so many steps from side to side that a place in it takes 63 bits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Its least corner, units of the mesh.
    pub origin: Vec3,
    /// Length of a step, units of the mesh, above 0.
    pub step: f32,
}

/// Bits of a coordinate.
const BITS: u32 = 21;

impl Grid {
    fn around(bounds: &Bounds) -> Self {
        if bounds.is_empty() {
            return Self { origin: Vec3::ZERO, step: 1.0 };
        }
        let step = ((bounds.max - bounds.min).max_element() / f64::from((1 << BITS) - 1)) as f32;
        Self { origin: bounds.min.as_vec3(), step: if step.is_normal() { step } else { 1.0 } }
    }

    /// A place on the grid: 21 bits for each coordinate, one after the other.
    fn packed(&self, position: Vec3) -> [u32; 2] {
        let at = ((position - self.origin) / self.step)
            .round()
            .clamp(Vec3::ZERO, Vec3::splat(((1 << BITS) - 1) as f32));
        let [x, y, z] = at.to_array().map(|c| c as u64);
        let bits = x | y << BITS | z << (2 * BITS);
        [bits as u32, (bits >> 32) as u32]
    }
}

/// A vertex as shaders read it, two texels: read by `stripes_of` in `shaders/effects/hatching/stripes.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct VertexRecord {
    position: [u32; 2],
    stripes: StripeVertex,
}

/// All stripes of a scene on the device. Clones share them.
#[derive(Clone)]
pub struct GpuStripes {
    solved: Vec<SolvedStripes>,
    places: Vec<StripePlace>,
    triangles: Target,
    vertices: Target,
    patches: Target,
}

impl GpuStripes {
    /// Uploads stripes of a scene; `topology`: of its meshes, as they are on the device, or empty. From any thread.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn new(
        gpu: &Gpu,
        scene: &Scene,
        topology: &[Topology],
        solved: Vec<SolvedStripes>,
    ) -> Result<Self, GpuError> {
        let mut triangles: Vec<[u32; 4]> = Vec::new();
        let mut vertices: Vec<VertexRecord> = Vec::new();
        let mut patches: Vec<[[f32; 4]; 2]> = Vec::new();
        let mut places = Vec::with_capacity(solved.len());
        for SolvedStripes { request, field } in &solved {
            let none = Mesh::default();
            let mesh = scene.meshes.get(request.mesh).map_or(&none, |mesh| mesh);
            let grid = Grid::around(&mesh.bounds());
            places.push(StripePlace {
                first_triangle: triangles.len() as u32,
                cycles_per_unit: field.cycles_per_unit,
                grid,
            });
            let first_vertex = vertices.len() as u32;
            vertices.extend(records(mesh, field, &grid));
            let corners = triangle_corners(mesh, topology.get(request.mesh).map(|t| &t.provoking));
            let vertex_of =
                |corner: u32| field.corner_vertices.get(corner as usize).map_or(0, |v| first_vertex + v);
            let flat = topology.get(request.mesh).map(|t| Patches::new(mesh, &t.edges)).unwrap_or_default();
            let first_patch = patches.len() as u32;
            patches.extend(flat.planes.iter().map(|planes| planes.map(|plane| plane.to_array())));
            let patch_of = |corner: u32| match flat.of_triangle.get(corner as usize / 3) {
                Some(&number) if number > 0 => first_patch + number,
                _ => 0,
            };
            triangles.extend(
                corners.into_iter().map(|[a, b, c]| [vertex_of(a), vertex_of(b), vertex_of(c), patch_of(a)]),
            );
        }
        let mut triangle_records = RecordTexture::new(gpu, "triangles of stripes");
        triangle_records.write(gpu, &triangles)?;
        let mut vertex_records = RecordTexture::new(gpu, "vertices of stripes");
        vertex_records.write(gpu, &vertices)?;
        let mut patch_records = RecordTexture::new(gpu, "flat parts");
        patch_records.write(gpu, &patches)?;
        let [triangles, vertices, patches] =
            [triangle_records, vertex_records, patch_records].map(|records| records.target().clone());
        Ok(Self { solved, places, triangles, vertices, patches })
    }

    /// Where these stripes lie; `None`: they are not there.
    pub fn place(&self, request: &StripeRequest) -> Option<StripePlace> {
        let number = self.solved.iter().position(|s| s.request == *request)?;
        self.places.get(number).copied()
    }

    /// The stripes, as they were found.
    pub fn solved(&self) -> &[SolvedStripes] {
        &self.solved
    }

    /// Per triangle one texel: three numbers of vertices, and that of its flat part, counted from 1; 0: none.
    pub fn triangles(&self) -> &Target {
        &self.triangles
    }

    /// The vertices, two texels each.
    pub fn vertices(&self) -> &Target {
        &self.vertices
    }

    /// The flat parts, two texels each ([`Patches::planes`]).
    pub fn patches(&self) -> &Target {
        &self.patches
    }
}

fn records(mesh: &Mesh, field: &StripeField, grid: &Grid) -> Vec<VertexRecord> {
    let mut positions = vec![Vec3::ZERO; field.vertices.len()];
    for (vertex, index) in field.corner_vertices.iter().zip(&mesh.indices) {
        if let (Some(slot), Some(position)) =
            (positions.get_mut(*vertex as usize), mesh.positions.get(*index as usize))
        {
            *slot = *position;
        }
    }
    let record =
        |(p, stripes): (&Vec3, &StripeVertex)| VertexRecord { position: grid.packed(*p), stripes: *stripes };
    positions.iter().zip(&field.vertices).map(record).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vertex_takes_two_texels_and_lies_within_half_a_step_of_its_place() {
        assert_eq!(size_of::<VertexRecord>(), 32);
        let positions = [[-3.0, 700.0, 0.25], [5.0, 702.0, 0.25], [1.3, 701.1, 1e3]].map(Vec3::from_array);
        let grid = Grid::around(&Bounds::of_points(&positions));
        for position in positions {
            let [low, high] = grid.packed(position);
            let bits = u64::from(low) | u64::from(high) << 32;
            let at = [0, 1, 2].map(|axis| (bits >> (axis * BITS) & ((1 << BITS) - 1)) as f32);
            let back = grid.origin + Vec3::from_array(at) * grid.step;
            assert!((back - position).abs().max_element() < 0.6 * grid.step + 1e-4, "{position} {back}");
        }
    }

    #[test]
    fn hostile_meshes_have_a_grid() {
        for positions in [
            vec![],
            vec![Vec3::ONE; 2],
            vec![Vec3::NAN, Vec3::X],
            vec![Vec3::splat(-3e38), Vec3::splat(3e38)],
        ] {
            let grid = Grid::around(&Bounds::of_points(&positions));
            assert!(grid.step > 0.0 && grid.step.is_finite());
            for position in positions {
                grid.packed(position);
            }
        }
    }
}
