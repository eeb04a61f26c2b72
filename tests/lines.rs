//! Pictures of lines against the exact visible edges. `make quality` measures more of them (`line_table.rs`).

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "the scores are worth reading")]

mod common;

use common::line_scenes::{analytic, named, pebble};
use common::line_truth::{Look, Stage, directions};
use common::session;
use glam::DVec3;
use hachure::geometry::{Mesh, clean};

const SIDE: u32 = 320;
const VIEWS: u32 = 8;

/// The bar of image-space mode is what it reaches in views that suit it: faces seen at a grazing angle are full of its ink.
#[test]
fn simple_scenes_are_outlined_where_their_edges_are() {
    let mut session = session();
    for (name, least) in
        [("box", 0.99), ("sphere", 0.99), ("torus", 0.97), ("stairs", 0.97), ("intersecting", 0.95)]
    {
        let mut stage = Stage::new(&mut session, &named(name));
        for towards_viewer in [DVec3::new(0.6, 0.6, 0.7), DVec3::new(-0.8, 0.7, 0.6)] {
            for orthographic in [false, true] {
                let look = Look { towards_viewer, orthographic };
                let bars = [("image_space", least), ("exact", 0.98_f64)];
                for (found, (mode, least)) in
                    stage.measure(&mut session, look, SIDE, &bars.map(|(mode, _)| mode)).iter().zip(bars)
                {
                    let s = found.score;
                    println!(
                        "{name:<12} {mode:<5} precision {:.3} recall {:.3} F1 {:.3}",
                        s.precision,
                        s.recall,
                        s.f1()
                    );
                    assert!(s.f1() >= least, "{name}, {mode}: {s:?}");
                }
            }
        }
    }
}

/// Where triangles fold to and fro around the contour of their surface, a line goes on beside the next one.
#[test]
fn coarse_surfaces_have_no_barbs() {
    let mut session = session();
    let mut stage = Stage::new(&mut session, &pebble());
    let (mut barbs, mut recall) = (0.0, 0.0);
    for towards_viewer in directions(VIEWS) {
        let look = Look { towards_viewer, orthographic: false };
        for found in stage.measure(&mut session, look, SIDE, &["exact"]) {
            barbs += found.barbs / f64::from(VIEWS);
            recall += found.score.recall / f64::from(VIEWS);
        }
    }
    println!("{:.2} % of the ink is of barbs; recall {recall:.4}", 100.0 * barbs);
    assert!(barbs < 0.001 && recall > 0.99, "{barbs}, {recall}");
}

#[test]
fn the_analytic_scenes_need_no_repair() {
    for subject in analytic() {
        for mesh in &subject.scene.meshes {
            let (_, report) = clean(Mesh::clone(mesh));
            assert!(report.is_clean(), "{}: {report:?}", subject.name);
        }
    }
}
