//! Which gaps stay, and what searching for others costs.

use std::f32::consts::TAU;
use std::time::Instant;

use glam::Vec3;

use super::{mended, shapes};
use crate::geometry::primitives;

#[test]
fn what_is_really_open_stays_open() {
    let mut open_box = primitives::cube(1.0);
    open_box.indices.truncate(30);
    open_box.submeshes[0].index_count = 30;
    let mut all = vec![
        ("open box", open_box),
        ("sheet", shapes::sheet(8, Vec3::ZERO, 1.0)),
        ("tube", shapes::tube(0.3, 24, 0.0, TAU)),
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
        all.push(("slit tube", shapes::tube(0.3, 24, 0.0, TAU - gap / 0.3)));
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

#[test]
fn the_same_gaps_are_closed_when_they_are_too_narrow_to_see() {
    let gap = 1e-6;
    let slit = shapes::tube(0.3, 24, 0.0, TAU - 4.0 * gap);
    for (name, mesh, share) in [
        ("tiles", shapes::tiles(2, 4.0 * gap, 3), 0.45),
        ("half shells", shapes::half_shells(2.0 * gap), 0.86),
        ("slit tube", slit, 0.3),
        ("slit", shapes::slit_plate(4.0 * gap, 4.0 * gap), 0.15),
    ] {
        let (_, report) = mended(&mesh).unwrap();
        assert!(report.joined_length >= share * report.border_length, "{name}: {report:?}");
    }
}

#[test]
fn loose_triangles_take_linear_time() {
    let start = Instant::now();
    let torus = primitives::torus(1.0, 0.3, 100, 50);
    let (_, report) = mended(&shapes::soup(&torus, 2e-5)).unwrap();
    assert!(report.joined_length > 0.999 * report.border_length, "{report:?}");
    assert!(mended(&shapes::loose_triangles(20_000, 0.02)).is_none());
    let _ = mended(&shapes::bundle(1_300));
    assert!(start.elapsed().as_secs() < 20);
}
