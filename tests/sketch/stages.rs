//! What runs again when a parameter of a sketch changes.

use glam::DVec3;
use hachure::geometry::primitives;
use hachure::style::{Color, Style};

use super::common;
use super::{at, set_style, sketched, style, turned};

const SIDE: u32 = 96;

#[test]
fn where_lines_and_colors_go_is_no_reason_to_draw_geometry_again() {
    let mut session = common::session();
    let scene = common::scene(vec![
        ("box", primitives::cube(1.0), at(-0.4, 0.0, 0.0), [0.8, 0.5, 0.3]),
        ("ball", primitives::sphere(0.6, 10, 18), at(0.4, 0.0, 0.0), [0.4, 0.6, 0.8]),
    ]);
    let mut opened = common::opened(&scene, DVec3::new(0.4, 0.5, 1.0));
    set_style(&mut opened, 1, &style("toon"));
    let mut base = sketched(style("gooch"), 8.0, 14.0);
    base.edges.inner.width = 16.0;
    session.set_scene(&opened).unwrap();
    let mut changed = |change: &dyn Fn(&mut Style)| {
        set_style(&mut opened, 0, &base);
        session.draw(&opened, [SIDE; 2], false).unwrap();
        let before = session.renderer().runs();
        let mut style = base.clone();
        change(&mut style);
        set_style(&mut opened, 0, &style);
        session.draw(&opened, [SIDE; 2], false).unwrap();
        let after = session.renderer().runs();
        let pairs = before.iter().zip(&after);
        pairs.filter(|(before, after)| before != after).map(|(before, _)| before.0).collect::<Vec<_>>()
    };
    assert_eq!(changed(&|_| {}), [""; 0]);
    let placed = ["sketch", "image"];
    let sorted = |mut names: Vec<&'static str>| {
        names.sort_unstable_by_key(|name| placed.iter().position(|known| known == name).unwrap_or(9));
        names
    };
    let only_placed: [(&str, &dyn Fn(&mut Style)); 4] = [
        ("the fill's matrix", &|style| style.sketch.fill.matrix = turned(13.9)),
        ("density", &|style| style.sketch.pass[0].opacity = 0.5),
        ("color", &|style| style.sketch.pass[0].color = Some(Color([200, 0, 0]))),
        ("grain", &|style| style.sketch.grain.amount = 0.5),
    ];
    for (what, change) in only_placed {
        assert_eq!(sorted(changed(change)), placed, "{what}");
    }
    let moved: [(&str, &dyn Fn(&mut Style)); 3] = [
        ("a matrix", &|style| style.sketch.pass[0].matrix = turned(8.1)),
        ("amount", &|style| style.sketch.wander.amount = 0.99),
        ("pressure", &|style| style.sketch.wander.pressure = 0.5),
    ];
    for (what, change) in moved {
        assert_eq!(sorted(changed(change)), ["sketch", "image", "moved edges"], "{what}");
    }
    let asked_again = ["sketch", "image", "moved edges", "noise"];
    assert_eq!(sorted(changed(&|style| style.sketch.wander.seed = 2)), asked_again);
    assert_eq!(sorted(changed(&|style| style.sketch.pass[0].seed = 9)), asked_again);
    let wide = changed(&|style| style.sketch.pass[0].matrix = turned(32.0));
    assert!(!wide.contains(&"g-buffer") && !wide.contains(&"edge map"), "{wide:?}");
}
