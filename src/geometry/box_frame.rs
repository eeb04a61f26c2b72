//! The frame of a box: beams along its twelve edges.

use glam::{UVec3, Vec3};

use super::primitives::from_triangles;
use super::{Bounds, Mesh};

/// A closed mesh of beams, square in section and `width` wide, that lie within the edges of `bounds`, which must not be
/// empty. Where two beams meet, so does the frame become a full box.
pub fn box_frame(bounds: &Bounds, width: f64) -> Mesh {
    let size = bounds.max - bounds.min;
    let width = glam::DVec3::splat(width).min(size * 0.5);
    let steps = [bounds.min, bounds.min + width, bounds.max - width, bounds.max].map(|p| p.as_vec3());
    // Three cells along each axis; those of the edges and corners are filled.
    let is_filled = |cell: [i32; 3]| {
        let outer = cell.iter().filter(|c| [0, 2].contains(*c)).count();
        cell.iter().all(|c| (0..3).contains(c)) && outer >= 2
    };
    let index = |corner: UVec3| corner.x + 4 * (corner.y + 4 * corner.z);
    let positions =
        (0..64_usize).map(|i| Vec3::new(steps[i % 4].x, steps[i / 4 % 4].y, steps[i / 16].z)).collect();
    let mut indices = Vec::new();
    for cell in (0..27).map(|i| [i % 3, i / 3 % 3, i / 9]).filter(|cell| is_filled(*cell)) {
        for (axis, forward) in (0..3).flat_map(|axis| [(axis, false), (axis, true)]) {
            let mut beside = cell;
            beside[axis] += if forward { 1 } else { -1 };
            if is_filled(beside) {
                continue;
            }
            let mut origin = UVec3::from_array(cell.map(|c| c as u32));
            origin[axis] += u32::from(forward);
            let [mut u, mut v] = [(axis + 1) % 3, (axis + 2) % 3].map(|a| UVec3::from_array(unit(a)));
            if !forward {
                std::mem::swap(&mut u, &mut v);
            }
            let [a, b, c, d] = [origin, origin + u, origin + u + v, origin + v].map(index);
            indices.extend([a, b, c, a, c, d]);
        }
    }
    from_triangles(positions, indices).without_unused_vertices()
}

fn unit(axis: usize) -> [u32; 3] {
    std::array::from_fn(|a| u32::from(a == axis))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{CreaseRule, Topology};
    use glam::DVec3;

    #[test]
    fn a_frame_is_closed_fills_its_box_and_is_hollow() {
        let bounds = Bounds { min: DVec3::new(-1.0, 0.0, 2.0), max: DVec3::new(1.0, 4.0, 5.0) };
        let mesh = box_frame(&bounds, 0.25);
        assert!(Topology::new(&mesh, 0.5, CreaseRule::Normals).is_solid);
        assert_eq!(Bounds::of_points(&mesh.positions), bounds);
        let volume: f32 =
            mesh.triangles().iter().map(|t| mesh.corners(*t)).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum();
        let beams = 4.0 * (1.5 + 3.5 + 2.5) * 0.0625 + 8.0 * 0.015_625;
        assert!((volume - beams).abs() < 1e-3, "{volume} {beams}");
    }

    #[test]
    fn a_frame_of_a_thin_box_is_that_box() {
        let bounds = Bounds { min: DVec3::ZERO, max: DVec3::new(0.125, 4.0, 4.0) };
        assert_eq!(Bounds::of_points(&box_frame(&bounds, 0.25).positions), bounds);
    }
}
