//! What is easily forgotten: nothing to draw, pictures that change their size, a great many layers.

use hachure::geometry::Mesh;
use hachure::render::{LayersEnd, Reported};

use crate::common::{self, opened, scene, session, set};
use crate::{blueprint, render, stack};

#[test]
fn nothing_visible_and_an_empty_group_are_paper_by_lists_and_by_peeling() {
    let mut session = session();
    let mut hidden = stack(3, 1.0);
    for node in &hidden.scene.clone().nodes {
        hidden.document.node_mut(&node.path).visible = Some(false);
    }
    let objects = vec![("none", Mesh::default(), glam::DMat4::IDENTITY, [1.0; 3])];
    let empty = blueprint(opened(&scene(objects), glam::DVec3::Z));
    for (mut opened, groups) in [(hidden, 0), (empty, 1)] {
        for by in ["lists", "peeling"] {
            set(&mut opened, "view.layer_method", by);
            let image = common::image(&mut session, &opened, 32);
            assert!(image.pixels().all(|p| p == image.get_pixel(0, 0)), "{by}");
            let counted = session.renderer().layer_reports().unwrap();
            assert_eq!(counted.len(), groups, "{by}");
            assert!(counted.iter().all(|c| c.layers == 0 && c.pixels == [0; 64]), "{by}");
        }
    }
}

#[test]
fn a_resize_while_reports_are_outstanding_disturbs_no_picture() {
    let mut session = session();
    let mut fresh = common::session();
    let (few, many) = (stack(2, 1.0), stack(20, 1.0));
    session.set_scene(&few).unwrap();
    render(&mut session, &few, [64; 2]);
    session.set_scene(&many).unwrap();
    // Nobody waits for any of these.
    for size in [[64; 2], [200, 40], [1, 1], [31, 120], [64; 2]] {
        render(&mut session, &many, size);
    }
    fresh.set_scene(&many).unwrap();
    for size in [[90, 50], [64; 2]] {
        let image = session.image(&many, size, false).unwrap();
        assert!(image == fresh.image(&many, size, false).unwrap(), "{size:?}");
        assert_eq!(session.renderer().take_reports(), Reported::Complete);
    }
}

#[test]
fn more_layers_than_can_be_recorded_end_with_the_last_of_them() {
    for by in ["lists", "peeling"] {
        let mut many = stack(70, 1.0);
        set(&mut many, "view.layer_method", by);
        let mut session = session();
        session.set_scene(&many).unwrap();
        session.draw(&many, [48; 2], false).unwrap();
        let counted = session.renderer().layer_reports().unwrap().remove(0);
        assert_eq!((counted.layers, counted.ended), (64, LayersEnd::MaxLayers), "{by}");
        assert!(counted.pixels.iter().all(|p| *p > 0), "{by}");
    }
}
