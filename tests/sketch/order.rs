//! The order of objects decides nothing.

use std::sync::Arc;

use glam::DVec3;
use hachure::export::session::Opened;
use hachure::geometry::primitives;
use hachure::style::Style;

use super::common;
use super::{apart, at, drawn, seen_from, set_style, sketched, style};

const SIDE: u32 = 200;

/// Objects that cover parts of each other, of which each has one of these styles, in this order or the other way round.
fn company(styles: &[Style], reversed: bool) -> Opened {
    let turn = glam::DMat4::from_rotation_x(0.5) * glam::DMat4::from_rotation_y(0.6);
    let mut objects = vec![
        ("box", primitives::cube(1.2), at(-0.5, 0.2, -1.4) * turn, [0.8, 0.5, 0.3]),
        ("ball", primitives::sphere(0.8, 14, 24), at(0.5, 0.1, 0.6), [0.4, 0.6, 0.8]),
        ("ring", primitives::torus(0.9, 0.2, 24, 10), at(0.0, -0.3, 2.6) * turn, [0.5, 0.8, 0.4]),
        ("cube", primitives::cube(0.6), at(0.1, 0.9, -2.8) * turn, [0.8, 0.8, 0.4]),
    ];
    let names = objects.iter().map(|(name, ..)| *name).collect::<Vec<_>>();
    if reversed {
        objects.reverse();
    }
    let scene = common::scene(objects);
    let mut opened = common::opened(&scene, DVec3::Z);
    opened.document.camera = Some(seen_from(DVec3::new(1.0, 1.5, 6.0), DVec3::ZERO));
    for (i, name) in names.iter().enumerate() {
        let node = scene.nodes.iter().position(|node| node.name == *name).unwrap();
        set_style(&mut opened, node, &styles[i % styles.len()]);
    }
    opened
}

#[test]
fn the_order_of_sketches_changes_nothing() {
    let mut session = common::session();
    let sketch = |technique: &str, rms: f32, passes: u32| {
        let mut style = sketched(style(technique), rms, 1.4 * rms);
        style.sketch.wander.by_object = false;
        style.sketch.passes = passes;
        style
    };
    for (name, styles) in [
        ("one group", vec![sketch("gooch", 8.0, 2)]),
        ("two groups", vec![sketch("gooch", 8.0, 2), sketch("toon", 5.0, 1)]),
        ("a group and surfaces", vec![sketch("gooch", 8.0, 2), style("toon")]),
    ] {
        let mut pictures = Vec::new();
        for reversed in [false, true] {
            let opened = company(&styles, reversed);
            session
                .set_scene(&Opened { document: opened.document.clone(), scene: Arc::clone(&opened.scene) })
                .unwrap();
            pictures.push(drawn(&mut session, &opened, SIDE, |_| true));
            assert!(drawn(&mut session, &opened, SIDE, |_| true) == pictures[pictures.len() - 1], "{name}");
            let mut anew = common::session();
            anew.set_scene(&opened).unwrap();
            let again = drawn(&mut anew, &opened, SIDE, |_| true);
            assert!(again == pictures[pictures.len() - 1], "{name}: not the same each time");
        }
        let apart = apart(&pictures[0], &pictures[1]);
        let wrong = apart.iter().filter(|apart| **apart > 12).count();
        println!("{name}: {wrong} pixels depend on the order of objects");
        // Ties: where two lines are equally near.
        assert!(wrong <= 40, "{name}: {wrong} pixels");
    }
}
