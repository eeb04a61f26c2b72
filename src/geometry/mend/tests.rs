use std::time::Instant;

use glam::{Vec2, Vec3};

use super::*;
use crate::geometry::normals::face_normals;
use crate::geometry::{EdgeKind, MeshPart, clean, primitives};

#[path = "../../../tests/common/repatch.rs"]
mod repatch;
mod shapes;

use repatch::{Common, Repatch, Repatched};

fn mended(mesh: &Mesh) -> Option<(Mesh, Mended)> {
    mend(mesh, &Adjacency::new(mesh), SeamTolerance::Automatic)
}

/// Length of the edges of one triangle, and number of those of more than two.
fn borders(mesh: &Mesh) -> (f64, usize) {
    let adjacency = Adjacency::new(mesh);
    let is_border = |kind| matches!(kind, EdgeKind::Border | EdgeKind::Stitched);
    let length = |edge: &crate::geometry::Edge| {
        let [a, b] = edge.vertices.map(|v| mesh.positions[v as usize]);
        f64::from(a.distance(b))
    };
    let borders = adjacency.edges.iter().filter(|e| is_border(e.kind));
    (borders.map(length).sum(), adjacency.non_manifold_count)
}

fn area(mesh: &Mesh) -> f64 {
    let area = |t: &[u32; 3]| {
        let [a, b, c] = mesh.corners(*t);
        f64::from((b - a).cross(c - a).length()) * 0.5
    };
    mesh.triangles().iter().map(area).sum()
}

fn cut_cylinder() -> Mesh {
    let mut side = shapes::tube(0.4, 40, 0.0, std::f32::consts::TAU);
    for p in &mut side.positions {
        if p.z > 0.9 {
            p.z += 0.5 * p.x;
        }
    }
    let cap = |z: f32| {
        let rim: Vec<Vec3> = side.positions[..]
            .iter()
            .copied()
            .filter(|p| (z > 0.5) == (p.z > 0.7) && (z > 0.5 || p.z < 0.1))
            .take(41)
            .collect();
        let middle = rim.iter().sum::<Vec3>() / rim.len() as f32;
        let mut positions = vec![middle];
        positions.extend(&rim);
        let indices = (1..41).flat_map(|k| if z > 0.5 { [0, k, k + 1] } else { [0, k + 1, k] }).collect();
        primitives::from_triangles(positions, indices)
    };
    let caps = [cap(0.0), cap(1.0)];
    let (mesh, _) = clean(shapes::together([side.clone(), caps[0].clone(), caps[1].clone()]));
    mesh
}

fn solids() -> Vec<(&'static str, Mesh)> {
    vec![
        ("cube", primitives::cube(1.0)),
        ("sphere", primitives::sphere(1.0, 12, 24)),
        ("torus", primitives::torus(1.0, 0.3, 32, 16)),
        ("cylinder", cut_cylinder()),
    ]
}

#[test]
fn negatives_keep_every_border() {
    let mut open_box = primitives::cube(1.0);
    open_box.indices.truncate(30);
    open_box.parts[0].index_count = 30;
    let mut all = vec![
        ("open box", open_box),
        ("sheet", shapes::sheet(8, Vec3::ZERO, 1.0)),
        ("tube", shapes::tube(0.3, 24, 0.0, std::f32::consts::TAU)),
        ("moebius", shapes::moebius()),
        ("leaf cards", shapes::leaf_cards(300)),
        ("book", shapes::stack(50, 3e-4, [1, 1], false)),
    ];
    for gap in [1e-5, 1e-4, 1e-3, 1e-2] {
        all.push(("plates", shapes::stack(2, gap, [6, 6], false)));
        all.push(("opposite plates", shapes::stack(2, gap, [6, 6], true)));
        all.push(("plates of other grids", shapes::stack(2, gap, [6, 7], false)));
        all.push(("opposite plates of other grids", shapes::stack(2, gap, [6, 7], true)));
        all.push(("double tube", shapes::double_tube(gap)));
        all.push(("strip", shapes::strip(gap, false)));
        all.push(("leaf", shapes::strip(gap, true)));
    }
    for gap in [1.2e-4, 1e-3] {
        all.push(("slit tube", shapes::tube(0.3, 24, 0.0, std::f32::consts::TAU - gap / 0.3)));
        all.push(("tiles", shapes::tiles(2, gap, 3)));
        all.push(("tile field", shapes::tiles(8, gap, 1)));
        all.push(("corner clearance", shapes::corner_clearance(gap)));
        all.push(("pillow", shapes::pillow(gap)));
        all.push(("half shells", shapes::half_shells(gap)));
        all.push(("slit", shapes::slit_plate(gap, gap)));
        all.push(("wedge", shapes::slit_plate(0.0, gap)));
        all.push(("slot", shapes::slotted_plate(gap)));
    }
    let bad: Vec<String> = all
        .iter()
        .filter_map(|(name, mesh)| {
            let (_, report) = mended(mesh)?;
            Some(format!("{name}: {report:?}"))
        })
        .collect();
    assert!(bad.is_empty(), "{bad:#?}");
}
