//! Sketches with mirrors, glass, sections, hidden lines and each other.

use std::sync::Arc;

use glam::{DMat4, DVec3, DVec4};
use hachure::document::Role;
use hachure::export::session::Opened;
use hachure::geometry::{Mesh, Plane, primitives};
use hachure::scene::AlphaMode;
use hachure::style::{Color, Style};
use image::RgbaImage;

use super::common::{
    self,
    outline::{hull_of, projected},
    set, to_linear,
};
use super::{alone, apart, at, differing, drawn, seen_from, set_style, sketched, style};

const SIDE: u32 = 160;

fn tilted() -> DMat4 {
    DMat4::from_rotation_y(0.5) * DMat4::from_rotation_x(0.4)
}

/// Opens objects, each with a style, of which some blend.
fn opened(
    objects: Vec<(&str, Mesh, DMat4, [f32; 3])>,
    styles: &[Style],
    blends: &[usize],
    eye: DVec3,
) -> Opened {
    let mut scene = Arc::unwrap_or_clone(common::scene(objects));
    for node in blends {
        scene.materials[*node].base_color.w = 0.4;
        scene.materials[*node].alpha = AlphaMode::Blend;
    }
    let mut opened = common::opened(&Arc::new(scene), DVec3::Z);
    opened.document.camera = Some(seen_from(eye, DVec3::ZERO));
    for (node, style) in styles.iter().enumerate() {
        set_style(&mut opened, node, style);
    }
    opened
}

fn a_sketch() -> Style {
    sketched(style("unlit"), 6.0, 10.0)
}

fn without_lines(mut style: Style) -> Style {
    (style.edges.profile.show, style.edges.inner.show) = (false, false);
    style
}

/// Before a mirror in the plane z = 0, or behind it.
fn mirrored(place: DMat4) -> Opened {
    let objects = vec![
        ("box", primitives::cube(1.0), place * tilted(), [0.8, 0.3, 0.2]),
        ("glass", primitives::plane(4.0), DMat4::IDENTITY, [0.9; 3]),
    ];
    let styles = [a_sketch(), without_lines(style("unlit"))];
    let mut opened = opened(objects, &styles, &[], DVec3::new(3.0, 1.5, 6.0));
    let scene = Arc::clone(&opened.scene);
    opened.document.set_role(&scene, &[1], Role::Mirror, true);
    opened
}

#[test]
fn sketches_are_seen_in_mirrors_where_their_images_stand() {
    let mut session = common::session();
    let opened = mirrored(at(-1.2, 0.3, 1.2));
    session.set_scene(&opened).unwrap();
    let with = drawn(&mut session, &opened, SIDE, |_| true);
    let without = drawn(&mut session, &opened, SIDE, |node| node == 1);
    let changed = apart(&with, &without);
    let corners = |reflection: DMat4| {
        let place = reflection * opened.scene.nodes[0].world_from_local;
        let mesh = &opened.scene.meshes[0];
        let world: Vec<DVec3> = mesh.positions.iter().map(|p| place.transform_point3(p.as_dvec3())).collect();
        hull_of(projected(&opened, [SIDE; 2], &world))
    };
    let image = corners(Plane::of_mesh(&primitives::plane(4.0)).unwrap().reflection());
    let own = corners(DMat4::IDENTITY);
    // Positive within.
    let depth_in = |hull: &[glam::DVec2], p: glam::DVec2| {
        let sides = (0..hull.len()).map(|i| {
            let (a, b) = (hull[i], hull[(i + 1) % hull.len()]);
            (b - a).normalize().perp_dot(p - a)
        });
        sides.fold(f64::INFINITY, f64::min)
    };
    let (mut inside, mut shown, mut stray) = (0, 0, 0);
    for (px, changed) in changed.iter().enumerate() {
        let p = glam::DVec2::new((px as u32 % SIDE) as f64 + 0.5, (px as u32 / SIDE) as f64 + 0.5);
        if depth_in(&own, p) > -8.0 {
            continue;
        }
        if depth_in(&image, p) > 5.0 {
            inside += 1;
            shown += usize::from(*changed > 20);
        }
        stray += usize::from(depth_in(&image, p) < -8.0 && *changed > 0);
    }
    assert!(inside > 300 && shown == inside && stray == 0, "{shown} of {inside}, {stray} stray");

    // As if it stood behind the glass: strokes follow the object, from both sides alike.
    let mut plain = opened.clone();
    set_style(&mut plain, 0, &style("unlit"));
    assert!(differing(&drawn(&mut session, &plain, SIDE, |_| true), &with, 20) > 100);
}

#[test]
fn a_sketch_behind_a_mirror_is_not_seen() {
    let mut session = common::session();
    let opened = mirrored(at(0.0, 0.0, -1.6));
    session.set_scene(&opened).unwrap();
    let with = drawn(&mut session, &opened, SIDE, |_| true);
    assert!(with == drawn(&mut session, &opened, SIDE, |node| node == 1));
}

fn over(front: DVec4, behind: DVec4) -> DVec4 {
    front + behind * (1.0 - front.w)
}

/// How many pixels of what is in front lie over what is behind it, and how many of them are wrong.
fn composed(front: &RgbaImage, behind: &RgbaImage, all: &RgbaImage) -> (usize, usize) {
    let mut counted = (0, 0);
    for ((front, behind), all) in front.pixels().zip(behind.pixels()).zip(all.pixels()) {
        if front.0[3] > 0 && behind.0[3] > 0 {
            let apart = (over(to_linear(*front), to_linear(*behind)) - to_linear(*all)).abs().max_element();
            counted = (counted.0 + 1, counted.1 + usize::from(apart > 0.03));
        }
    }
    counted
}

#[test]
fn glass_and_sketches_lie_over_each_other_both_ways() {
    let mut session = common::session();
    let ball = || primitives::sphere(0.8, 14, 24);
    for (sketch_z, glass_z) in [(-1.5, 1.5), (1.5, -1.5)] {
        let objects = vec![
            ("sketch", ball(), at(0.2, 0.0, sketch_z), [0.8, 0.3, 0.2]),
            ("glass", primitives::plane(1.6), at(0.0, 0.1, glass_z), [0.2, 0.4, 0.8]),
        ];
        let styles = [a_sketch(), without_lines(style("unlit"))];
        let opened = opened(objects, &styles, &[1], DVec3::new(0.3, 0.4, 9.0));
        session.set_scene(&opened).unwrap();
        let [sketch, glass] = [0, 1].map(|shown| alone(&mut session, &opened, SIDE, |node| node == shown));
        let all = alone(&mut session, &opened, SIDE, |_| true);
        let (front, behind) = if sketch_z > glass_z { (&sketch, &glass) } else { (&glass, &sketch) };
        let (compared, wrong) = composed(front, behind, &all);
        assert!(compared > 500 && wrong == 0, "sketch at {sketch_z}: {wrong} of {compared}");
    }
}

#[test]
fn a_sketch_of_glass_shows_what_lies_behind_it() {
    let mut session = common::session();
    let objects = vec![
        ("sketch", primitives::sphere(0.8, 14, 24), at(0.2, 0.0, 1.5), [0.8, 0.3, 0.2]),
        ("wall", primitives::plane(3.0), at(0.0, 0.1, -1.0), [0.2, 0.7, 0.4]),
        ("nearer", primitives::cube(0.5), at(0.4, 0.2, 3.0) * tilted(), [0.5; 3]),
    ];
    let styles = [a_sketch(), without_lines(style("unlit")), without_lines(style("unlit"))];
    let opened = opened(objects, &styles, &[0], DVec3::new(0.3, 0.4, 9.0));
    session.set_scene(&opened).unwrap();
    let [sketch, wall] = [0, 1].map(|shown| alone(&mut session, &opened, SIDE, |node| node == shown));
    let both = alone(&mut session, &opened, SIDE, |node| node < 2);
    let (compared, wrong) = composed(&sketch, &wall, &both);
    assert!(compared > 1500 && wrong == 0, "{wrong} of {compared}");
    let see_through = sketch.pixels().filter(|p| (90..115).contains(&p.0[3])).count();
    assert!(see_through > 1000, "{see_through}");
    let nearer = alone(&mut session, &opened, SIDE, |node| node == 2);
    let all = alone(&mut session, &opened, SIDE, |_| true);
    let (compared, wrong) = composed(&nearer, &both, &all);
    assert!(compared > 100 && wrong == 0, "{wrong} of {compared}");
}

#[test]
fn two_sketches_lie_over_each_other_both_ways() {
    let mut session = common::session();
    let mut other = sketched(style("toon"), 9.0, 4.0);
    other.sketch.passes = 3;
    other.sketch.wander.seed = 77;
    other.edges.profile.color = Color([160, 0, 0]);
    for [first, second] in [[1.5, -1.5], [-1.5, 1.5]] {
        let objects = vec![
            ("first", primitives::sphere(0.8, 14, 24), at(-0.3, 0.0, first), [0.8, 0.3, 0.2]),
            ("second", primitives::cube(1.2), at(0.3, 0.1, second) * tilted(), [0.2, 0.4, 0.8]),
        ];
        let opened = opened(objects, &[a_sketch(), other.clone()], &[], DVec3::new(0.3, 0.4, 9.0));
        session.set_scene(&opened).unwrap();
        let alone_of = [0, 1].map(|shown| alone(&mut session, &opened, SIDE, |node| node == shown));
        let all = alone(&mut session, &opened, SIDE, |_| true);
        let [a, b] = &alone_of;
        let (front, behind) = if first > second { (a, b) } else { (b, a) };
        let (compared, wrong) = composed(front, behind, &all);
        // Where lines cross, a single pixel may go to the other one.
        assert!(compared > 800 && wrong <= 1, "first at {first}: {wrong} of {compared}");
    }
}

#[test]
fn sections_and_hidden_lines_of_sketches_are_drawn() {
    let mut session = common::session();
    let objects = vec![
        ("box", primitives::cube(1.6), tilted(), [0.8, 0.6, 0.5]),
        ("core", primitives::cube(0.7), tilted(), [0.5, 0.6, 0.8]),
    ];
    let mut opened = opened(objects, &[a_sketch(), a_sketch()], &[], DVec3::new(0.6, 2.5, 8.0));
    session.set_scene(&opened).unwrap();
    for section in ["false", "true"] {
        set(&mut opened, "section.show", section);
        let mut hidden = opened.clone();
        for node in 0..2 {
            let scene = Arc::clone(&hidden.scene);
            let dashed = hachure::style::Value::from("dashed");
            hidden.document.set_for(&scene, &[node], "edges.hidden.mode", &dashed).unwrap();
        }
        let [without, with] = [&opened, &hidden].map(|opened| drawn(&mut session, opened, SIDE, |_| true));
        let lines = differing(&without, &with, 20);
        assert!(lines > 60, "section {section}: {lines} pixels of hidden lines");
        // Beyond the surfaces there are none.
        let stray =
            without.pixels().zip(with.pixels()).filter(|(a, b)| a != b && a.0[..3] == [255; 3]).count();
        assert!(stray <= 10, "section {section}: {stray} stray pixels");
    }
}
