//! What a click means: the surface that lies there, wherever its color is drawn.

use glam::DVec3;
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::primitives;

use super::common;
use super::{at, set_style, sketched, style};

const SIDE: u32 = 96;

/// The nodes under pixels all over a picture, and how deep they lie.
fn picks(session: &mut Session, opened: &Opened) -> Vec<(Option<usize>, f64)> {
    session.draw(opened, [SIDE; 2], false).unwrap();
    let mut picked = Vec::new();
    for y in (4..SIDE).step_by(8) {
        for x in (4..SIDE).step_by(8) {
            session.renderer().start_pick([x, y]).unwrap();
            session.renderer().gpu().wait().unwrap();
            let pick = session.renderer().poll_pick().unwrap();
            picked.push((pick.node, pick.point.map_or(0.0, |point| point.z)));
        }
    }
    picked
}

#[test]
fn a_click_on_a_sketch_means_the_surface_that_lies_there() {
    let mut session = common::session();
    let scene = common::scene(vec![
        ("box", primitives::cube(1.0), at(-0.4, 0.0, 0.0), [0.8, 0.5, 0.3]),
        ("ball", primitives::sphere(0.6, 10, 18), at(0.4, 0.0, 0.3), [0.4, 0.6, 0.8]),
        ("wall", primitives::cube(0.7), at(0.0, 0.5, -1.0), [0.6, 0.6, 0.6]),
    ]);
    let mut opened = common::opened(&scene, DVec3::new(0.2, 0.3, 1.0));
    session.set_scene(&opened).unwrap();
    let expected = picks(&mut session, &opened);
    let nodes = |node| expected.iter().filter(|(found, _)| *found == node).count();
    assert!(nodes(None) > 20 && (0..3).all(|node| nodes(Some(node)) > 3), "{expected:?}");
    // First one sketch, then one before another one and others.
    for (node, technique, rms) in [(0, "gooch", 14.0), (1, "toon", 9.0)] {
        set_style(&mut opened, node, &sketched(style(technique), rms, 1.4 * rms));
        let picked = picks(&mut session, &opened);
        assert_eq!(picked, expected, "{technique}");
    }
}
