//! Which vertices lie at the same place.
//!
//! Files split vertices at seams of texture, normals and color, and STL gives every triangle its own three; topology
//! and normals need to know which of them are one point. The vertices themselves stay as they are.

use std::sync::atomic::{AtomicU32, Ordering};

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::Bounds;

/// Share of the bounding box's diagonal below which [`Weld::near`] takes two positions for one.
pub const TOLERANCE: f64 = 1e-6;

/// A map from vertices to points.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Weld {
    /// For each vertex the first vertex (smallest index) at the same point.
    pub representative: Vec<u32>,
    /// Number of points.
    pub count: usize,
}

impl Weld {
    /// Welds positions that are equal (−0 equals 0).
    pub fn exact(positions: &[Vec3]) -> Self {
        Self::by_key(positions, |p| {
            let [x, y, z] = (p + Vec3::ZERO).to_array().map(|c| u128::from(c.to_bits()));
            x << 64 | y << 32 | z
        })
    }

    /// Welds positions that share a cell of a grid whose cells are [`TOLERANCE`] of the diagonal wide: equal positions
    /// always, positions that differ by rounding almost always.
    pub fn near(positions: &[Vec3]) -> Self {
        let bounds = Bounds::of_points(positions);
        let cells_per_unit = 1.0 / (bounds.diagonal() * TOLERANCE);
        if !cells_per_unit.is_finite() {
            return Self::exact(positions);
        }
        // An odd shift of the grid keeps round coordinates, which files are full of, off the walls of the cells.
        let origin = bounds.min - DVec3::splat(0.374_165_738 / cells_per_unit);
        Self::by_key(positions, |p| {
            let cell = (p.as_dvec3() - origin) * cells_per_unit;
            u128::from(cell.x as u64 & 0xff_ffff) << 48
                | u128::from(cell.y as u64 & 0xff_ffff) << 24
                | u128::from(cell.z as u64 & 0xff_ffff)
        })
    }

    /// The points in the order of their first vertices, and for each vertex the index of its point: the indices of a
    /// mesh that was given as loose triangles.
    pub fn indexed(&self, positions: &[Vec3]) -> (Vec<Vec3>, Vec<u32>) {
        let mut points = Vec::with_capacity(self.count);
        let mut indices: Vec<u32> = Vec::with_capacity(positions.len());
        for (v, &first) in self.representative.iter().enumerate() {
            if first as usize == v {
                indices.push(points.len() as u32);
                points.push(positions[v]);
            } else {
                indices.push(indices[first as usize]);
            }
        }
        (points, indices)
    }

    fn by_key(positions: &[Vec3], key: impl Fn(Vec3) -> u128 + Sync) -> Self {
        let mut keys: Vec<u128> = positions
            .par_iter()
            .enumerate()
            .with_min_len(4096)
            .map(|(v, &p)| key(p) << 32 | v as u128)
            .collect();
        keys.par_sort_unstable();
        // Written in scattered order by several threads; each vertex once.
        let representative: Vec<AtomicU32> = positions.iter().map(|_| AtomicU32::new(0)).collect();
        let count = keys
            .par_chunk_by(|a, b| a >> 32 == b >> 32)
            .map(|same| {
                let first = same[0] as u32;
                for &k in same {
                    representative[k as u32 as usize].store(first, Ordering::Relaxed);
                }
                1
            })
            .sum();
        Self { representative: representative.into_iter().map(AtomicU32::into_inner).collect(), count }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_positions_share_the_first_vertex() {
        let p = [Vec3::X, Vec3::ZERO, Vec3::X, Vec3::new(-0.0, 0.0, -0.0), Vec3::Y];
        for weld in [Weld::exact(&p), Weld::near(&p)] {
            assert_eq!(weld.representative, [0, 1, 0, 1, 4]);
            assert_eq!(weld.count, 3);
            let points = vec![Vec3::X, Vec3::ZERO, Vec3::Y];
            assert_eq!(weld.indexed(&p), (points, vec![0, 1, 0, 1, 2]));
        }
    }

    #[test]
    fn rounding_is_welded_only_when_asked_for() {
        let p = [Vec3::ZERO, Vec3::ONE, Vec3::new(1.0, 1.0, 1.000_000_1)];
        assert_eq!(Weld::exact(&p).count, 3);
        assert_eq!(Weld::near(&p).count, 2);
    }

    #[test]
    fn no_vertices_and_one_point_are_fine() {
        assert_eq!(Weld::near(&[]).count, 0);
        assert_eq!(Weld::near(&[Vec3::ONE; 4]).representative, [0; 4]);
        assert_eq!(Weld::near(&[Vec3::splat(1e30), Vec3::splat(-1e30)]).count, 2);
    }
}
