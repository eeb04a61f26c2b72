//! Composition: objects of any styles in one picture. A parameter of one object changes no pixel of another one, except
//! by occlusion, in a mirror, or where the object's own lines reach over its boundary. Techniques and parameters are
//! taken from their declarations: a new one is tested without a word here.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use std::sync::Arc;

use common::{opened, scene, session, set, set_for, set_value_for, surfels};
use glam::{DMat4, DQuat, DVec3};
use hachure::document::Role;
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::{Mesh, primitives};
use hachure::scene::NodeId;
use hachure::style::param::Condition;
use hachure::style::{Matrix, Slot, Style, Technique, Value};
use image::RgbaImage;
use strum::VariantNames as _;

const SIDE: u32 = 96;

/// The object whose parameters change.
const A: NodeId = 0;
/// A wall behind all others, which may be a mirror.
const WALL: NodeId = 1;
/// The first of the other objects.
const B: NodeId = 2;

fn at(x: f64, y: f64, z: f64) -> DMat4 {
    DMat4::from_translation(DVec3::new(x, y, z)) * DMat4::from_quat(DQuat::from_rotation_x(0.6))
}

/// A ball before a wall, and around it an object of each of these techniques, which all reach into it.
fn composed(session: &mut Session, techniques: &[&str]) -> Opened {
    let mut objects = vec![
        ("a", primitives::sphere(1.0, 12, 20), at(0.0, 0.0, 0.0), [0.8, 0.5, 0.3]),
        ("wall", primitives::plane(6.0), DMat4::from_translation(DVec3::Z * -1.4), [0.9; 3]),
    ];
    let shapes: [Mesh; 3] =
        [primitives::cube(0.8), primitives::torus(0.4, 0.15, 16, 8), primitives::sphere(0.5, 10, 16)];
    for (i, technique) in techniques.iter().enumerate() {
        let angle = std::f64::consts::TAU * i as f64 / techniques.len() as f64;
        let depth = [0.5, -0.2, 0.1][i % 3];
        objects.push((
            technique,
            shapes[i % 3].clone(),
            at(1.1 * angle.cos(), 1.1 * angle.sin(), depth),
            [0.4, 0.6, 0.8],
        ));
    }
    let scene = scene(objects);
    let mut opened = opened(&scene, DVec3::new(0.1, 0.15, 1.0));
    for (i, technique) in techniques.iter().enumerate() {
        set_for(&mut opened, B + i, "technique", technique);
    }
    session.set_scene(&opened).unwrap();
    opened
}

/// Sets a parameter of all objects but [`A`].
fn set_for_all(opened: &mut Opened, key: &str, value: &str) {
    for node in WALL..opened.scene.nodes.len() {
        set_for(opened, node, key, value);
    }
}

fn drawn(session: &mut Session, opened: &Opened) -> RgbaImage {
    session.image(opened, [SIDE; 2], false).unwrap()
}

/// Where a parameter of a technique may show: lines are a blueprint's own, and reach over its boundary.
fn reach_of(technique: &str, pixels: &[bool]) -> Vec<bool> {
    if technique == "blueprint" { widened(pixels, 3.0) } else { pixels.to_vec() }
}

/// Per pixel, whether it is the node's.
fn pixels_of(session: &mut Session, opened: &Opened, node: NodeId) -> Vec<bool> {
    let picture = session.draw(opened, [SIDE; 2], false).unwrap();
    let object = hachure::render::base::ids::object_id(node);
    surfels(session, &picture).iter().map(|s| s.object == object).collect()
}

/// The same with all pixels that are at most so far away.
fn widened(pixels: &[bool], by: f32) -> Vec<bool> {
    let (side, reach) = (SIDE as i32, by.ceil() as i32);
    let is_near = |x: i32, y: i32| {
        (-reach..=reach).any(|dy| {
            (-reach..=reach).any(|dx| {
                let (x, y) = (x + dx, y + dy);
                ((dx * dx + dy * dy) as f32) <= by * by
                    && (0..side).contains(&x)
                    && (0..side).contains(&y)
                    && pixels[(y * side + x) as usize]
            })
        })
    };
    (0..side * side).map(|i| is_near(i % side, i / side)).collect()
}

/// How many pixels differ within a mask and where the first one outside of it does.
fn difference(before: &RgbaImage, after: &RgbaImage, mask: &[bool]) -> (usize, Option<(u32, u32)>) {
    let pairs = before.enumerate_pixels().zip(after.pixels()).zip(mask);
    let differing = pairs.filter(|(((.., a), b), _)| *a != *b);
    let (mut inside, mut outside) = (0, None);
    for (((x, y, _), _), &is_inside) in differing {
        if is_inside {
            inside += 1;
        } else {
            outside.get_or_insert((x, y));
        }
    }
    (inside, outside)
}

/// By how much each pixel outside of a mask differs that does.
fn beyond(before: &RgbaImage, after: &RgbaImage, mask: &[bool]) -> Vec<u8> {
    let outside = before.pixels().zip(after.pixels()).zip(mask).filter(|(_, inside)| !**inside);
    let difference = |((a, b), _): ((&image::Rgba<u8>, &image::Rgba<u8>), _)| {
        a.0.iter().zip(b.0).map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0)
    };
    outside.map(difference).filter(|difference| *difference > 0).collect()
}

/// A parameter, what it needs to matter, and the values that it is changed to.
struct Change {
    key: String,
    conditions: Vec<Condition>,
    values: Vec<Value>,
}

/// All parameters of a style.
fn changes() -> Vec<Change> {
    let mut style = Style::default();
    let change = |mut param: hachure::style::Param<'_>| {
        let mut values = match &param.slot {
            Slot::Bool(place) => vec![Value::Bool(!place.get())],
            Slot::Number { soft, hard, .. } => {
                [soft.start(), soft.end(), hard.end()].map(|end| Value::Number(f64::from(*end))).to_vec()
            }
            Slot::Integer { range, .. } => {
                [range.start(), range.end()].map(|end| Value::Number(f64::from(*end))).to_vec()
            }
            Slot::Choice(choice) => choice.names().iter().map(|name| Value::from(*name)).collect(),
            Slot::Matrix { most, .. } => [[0.0; 4], [4.0, -1.0, 1.0, 4.0], [*most; 4]]
                .map(|n| Value::Matrix(Matrix::of_numbers(n)))
                .to_vec(),
            Slot::Curve(_) => ["0,1,1,0", "0,0,0.3,0.8,1,1"].map(Value::parse).to_vec(),
            Slot::Color(_) => ["#ff3010", "#10a0ff"].map(Value::from).to_vec(),
            Slot::File(_) => ["assets/strokes/dots.png", "no/such.png"].map(Value::from).to_vec(),
        };
        values.dedup();
        values.retain(|value| param.set(value).is_ok());
        Change { key: param.key, conditions: param.conditions, values }
    };
    style.params().into_iter().map(change).collect()
}

/// Changes of all but the technique, the edges and the sketch, which matter for a technique or for all of them.
fn changes_with(technique: &str) -> Vec<Change> {
    let mut all = changes();
    all.retain(|change| {
        let of_it = |c: &Condition| c.key != "technique" || c.values.contains(&technique);
        let is_shared = ["technique", "edges.", "sketch."].iter().any(|key| change.key.starts_with(key));
        !is_shared && change.conditions.iter().all(of_it)
    });
    all
}

/// Gives an object what a parameter needs to matter.
fn with_conditions(opened: &Opened, node: NodeId, conditions: &[Condition]) -> Opened {
    let mut opened = opened.clone();
    for condition in conditions {
        set_for(&mut opened, node, condition.key, condition.values[0]);
    }
    opened
}

#[test]
fn a_parameter_of_one_technique_changes_no_pixel_of_an_object_of_any_technique() {
    let mut session = session();
    let mut all = composed(&mut session, Technique::VARIANTS);
    // Two blueprints of one style are one group, which is drawn in another way than two groups: a rounding apart.
    set_for_all(&mut all, "blueprint.fill", "#d0e0d8");
    let of_a = pixels_of(&mut session, &all, A);
    let mut still = Vec::new();
    for technique in Technique::VARIANTS {
        let mut seen = 0;
        let of_a = reach_of(technique, &of_a);
        let changes = changes_with(technique);
        for Change { key, conditions, values } in &changes {
            let mut before = with_conditions(&all, A, conditions);
            set_for(&mut before, A, "technique", technique);
            let first = drawn(&mut session, &before);
            for value in values {
                let mut after = before.clone();
                set_value_for(&mut after, A, key, value);
                let (inside, outside) = difference(&first, &drawn(&mut session, &after), &of_a);
                assert_eq!(outside, None, "{technique}: {key} = {value} changes another object");
                seen += inside;
            }
        }
        if seen == 0 {
            still.push(*technique);
        }
    }
    // What has no parameters of its own cannot show any change; all others must, or nothing was tested.
    assert_eq!(still, ["blank", "unlit"]);
}

#[test]
fn the_technique_of_one_object_changes_no_pixel_of_another() {
    let mut session = session();
    for other in Technique::VARIANTS {
        let pair = composed(&mut session, &[other]);
        let of_a = pixels_of(&mut session, &pair, A);
        let drawn_as = |session: &mut Session, technique: &str| {
            let mut pair = pair.clone();
            set_for(&mut pair, A, "technique", technique);
            drawn(session, &pair)
        };
        let first = drawn_as(&mut session, other);
        for technique in Technique::VARIANTS.iter().filter(|t| *t != other) {
            // Edges of and with a blueprint's surfaces are its own, so that a line may come or go along its boundary.
            let of_a = reach_of(technique, &reach_of(other, &of_a));
            let (inside, outside) = difference(&first, &drawn_as(&mut session, technique), &of_a);
            assert_eq!(outside, None, "{technique} beside {other}");
            assert!(inside > 100, "{technique} looks like {other}");
        }
    }
}

#[test]
fn the_lines_of_one_object_change_no_pixel_beyond_their_reach() {
    let mut session = session();
    // Surfaces, whose lines are found together; those of blueprints are beneath nobody's.
    let surfaces: Vec<_> = Technique::VARIANTS.iter().copied().filter(|t| *t != "blueprint").collect();
    let all = composed(&mut session, &surfaces);
    let of_a = pixels_of(&mut session, &all, A);
    // Where it would be seen if nothing hid it: hidden lines are there.
    let mut alone = all.clone();
    for node in &all.scene.nodes[WALL..] {
        alone.document.node_mut(&node.path).visible = Some(false);
    }
    let whole_a = pixels_of(&mut session, &alone, A);
    // Reference pixels: the widest lines lie wholly outside.
    let px = |width: f32| width * SIDE as f32 / 1080.0;
    for (mode, width) in [("exact", 2.5_f32), ("exact", 32.0), ("image_space", 2.5)] {
        // Where a line of the object covers another one's spine, that one's width is missing beside it.
        let near = |pixels: &[bool]| widened(pixels, px(64.0) + px(width) * 0.5 + 1.5);
        let (near_a, near_whole_a) = (near(&of_a), near(&whole_a));
        let mut all = all.clone();
        set(&mut all, "edges.mode", mode);
        set(&mut all, "edges.profile.width", &width.to_string());
        let mut changed = 0;
        for Change { key, conditions, values } in changes().iter().filter(|c| c.key.starts_with("edges.")) {
            let before = with_conditions(&all, A, conditions);
            let near_a = if key.starts_with("edges.hidden.") { &near_whole_a } else { &near_a };
            let first = drawn(&mut session, &before);
            for value in values {
                let mut after = before.clone();
                set_value_for(&mut after, A, key, value);
                let after = drawn(&mut session, &after);
                let (inside, outside) = difference(&first, &after, near_a);
                // Thin lines are found in another way than wide ones, and single pixels then differ by a shade.
                let shades = beyond(&first, &after, near_a);
                assert!(
                    shades.len() <= 4 && shades.iter().all(|shade| *shade <= 16),
                    "beside {mode}, {width} px: {key} = {value} changes another object at {outside:?}: {shades:?}"
                );
                changed += usize::from(inside > 0);
            }
        }
        assert!(changed > 40, "{mode}, {width} px: only {changed} changes were seen");
    }
}

#[test]
fn in_a_mirror_a_parameter_changes_only_the_pixels_where_its_object_is_seen() {
    let mut session = session();
    let mut all = composed(&mut session, Technique::VARIANTS);
    let scene = Arc::clone(&all.scene);
    all.document.set_role(&scene, &[WALL], Role::Mirror, true);
    // Blueprints of equal style leave out the lines that they have in common: this one is by itself.
    let alone = B + Technique::VARIANTS.iter().position(|technique| *technique == "blueprint").unwrap();
    set_for(&mut all, alone, "blueprint.by_layer", "0.3");
    let eye = DVec3::new(1.2, 0.5, 1.0);
    all.document.camera = all.document.camera.map(|_| common::opened(&scene, eye).document.camera.unwrap());
    let of_a = pixels_of(&mut session, &all, A);
    let of_wall = pixels_of(&mut session, &all, WALL);
    // Where it is seen in the mirror: where a red one makes a difference on blank paper.
    let mut blank = all.clone();
    for (key, value) in
        [("technique", "blank"), ("edges.profile.show", "false"), ("edges.inner.show", "false")]
    {
        set(&mut blank, key, value);
    }
    // A blueprint hides nothing.
    blank.document.node_mut("/blueprint").visible = Some(false);
    let without = drawn(&mut session, &blank);
    set_for(&mut blank, A, "technique", "unlit");
    let with = drawn(&mut session, &blank);
    let differs = |a: &RgbaImage, b: &RgbaImage| a.pixels().zip(b.pixels()).map(|(a, b)| a != b).collect();
    let is_seen: Vec<bool> = differs(&without, &with);
    // Its outline reaches over what hides the rest of it there.
    for node in (B..scene.nodes.len()).filter(|node| *node != alone) {
        blank.document.node_mut(&scene.nodes[node].path).visible = Some(false);
    }
    let with = drawn(&mut session, &blank);
    blank.document.node_mut(&scene.nodes[A].path).visible = Some(false);
    let whole: Vec<bool> = differs(&drawn(&mut session, &blank), &with);
    let outside: Vec<bool> = whole.iter().map(|is_in| !is_in).collect();
    let near_outside = widened(&outside, 3.0);
    let outline: Vec<bool> =
        widened(&whole, 3.0).iter().zip(&near_outside).map(|(whole, outside)| *whole && *outside).collect();
    let mirrored = of_wall.iter().zip(&is_seen).filter(|(wall, seen)| **wall && **seen).count();
    assert!(mirrored > 100, "it is seen in {mirrored} pixels of the mirror");

    let of_wall: Vec<bool> = of_wall.iter().zip(&of_a).map(|(wall, a)| *wall && !a).collect();
    for technique in Technique::VARIANTS {
        let mut before = all.clone();
        set_for(&mut before, A, "technique", technique);
        let first = drawn(&mut session, &before);
        let mut is_seen = reach_of(technique, &is_seen);
        if *technique == "blueprint" {
            is_seen.iter_mut().zip(&outline).for_each(|(seen, outline)| *seen |= outline);
        }
        let mut changed = 0;
        for Change { key, values, .. } in &changes_with(technique) {
            // Every value has been tried in front of the mirror.
            let Some(value) = values.last() else { continue };
            let mut after = before.clone();
            set_value_for(&mut after, A, key, value);
            let after = drawn(&mut session, &after);
            let (_, outside) = difference(&first, &after, &is_seen);
            assert_eq!(outside, None, "{technique}: {key} = {value} in a mirror");
            changed += first
                .pixels()
                .zip(after.pixels())
                .zip(&of_wall)
                .filter(|((a, b), wall)| a != b && **wall)
                .count();
        }
        let has_parameters = !["blank", "unlit"].contains(technique);
        assert_eq!(changed > 0, has_parameters, "{technique}: {changed} pixels changed in the mirror");
    }
    // What the mirror itself is set to changes its own pixels only.
    let first = drawn(&mut session, &all);
    let others: Vec<bool> = of_wall.clone();
    for (key, value) in [("mirror.reflectivity", 0.1), ("mirror.fresnel", 0.0)] {
        let mut after = all.clone();
        set_value_for(&mut after, WALL, key, &Value::Number(value));
        let (inside, outside) = difference(&first, &drawn(&mut session, &after), &others);
        assert!(inside > 0 && outside.is_none(), "{key}: {inside} {outside:?}");
    }
}
