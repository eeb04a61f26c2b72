//! Each parameter changes something, and nothing of another object.

use std::path::PathBuf;
use std::sync::Arc;

use glam::DVec3;
use hachure::export::session::Opened;
use hachure::geometry::primitives;
use hachure::render::StyleImages;
use hachure::scene::Texture;
use hachure::style::param::Condition;
use hachure::style::{Matrix, Slot, Style, Value};

use super::common;
use super::{apart, at, drawn, is_other, seen_from, set_style, sketched, style};

const SIDE: u32 = 160;

/// Parameters of what moves with time or is made elsewhere.
fn is_left_out(key: &str) -> bool {
    ["sketch.boil", "sketch.exterior", "sketch.enlarge", "sketch.strokes."]
        .iter()
        .any(|start| key.starts_with(start))
}

/// All parameters of sketches, with what they need to matter and the values that they are changed to.
fn changes() -> Vec<(String, Vec<Condition>, Vec<Value>)> {
    let mut style = Style::default();
    let change = |mut param: hachure::style::Param<'_>| {
        let mut values = match &param.slot {
            Slot::Bool(_) => [false, true].map(Value::Bool).to_vec(),
            Slot::Number { soft, hard, .. } => {
                [soft.start(), soft.end(), hard.end()].map(|end| Value::Number(f64::from(*end))).to_vec()
            }
            Slot::Integer { range, .. } => {
                [range.start(), range.end()].map(|end| Value::Number(f64::from(*end))).to_vec()
            }
            Slot::Choice(choice) => choice.names().iter().map(|name| Value::from(*name)).collect(),
            Slot::Matrix { .. } => {
                [[0.0; 4], [4.0, -1.0, 1.0, 4.0]].map(|n| Value::Matrix(Matrix::of_numbers(n))).to_vec()
            }
            Slot::Curve(_) => ["0,1,1,0", "0,0,0.3,0.8,1,1"].map(Value::parse).to_vec(),
            Slot::Color(_) => ["#ff3010", "#10a0ff"].map(Value::from).to_vec(),
            Slot::File(_) => ["paper", "no/such/image"].map(Value::from).to_vec(),
        };
        values.retain(|value| param.set(value).is_ok());
        (param.key, param.conditions, values)
    };
    let all = style.params().into_iter().map(change);
    all.filter(|(key, ..)| key.starts_with("sketch.") && !is_left_out(key)).collect()
}

/// A coarse paper.
fn paper() -> Texture {
    let rgba = (0..64_u32).flat_map(|i| [i.wrapping_mul(2_654_435_761).to_be_bytes()[0]; 4]).collect();
    Texture { name: "paper".to_owned(), width: 8, height: 8, rgba }
}

/// What most of the parameters need to be seen.
fn rich(technique: &str) -> Style {
    let mut style = sketched(style(technique), 8.0, 14.0);
    let sketch = &mut style.sketch;
    (sketch.passes, sketch.wander.pressure) = (2, 0.3);
    (sketch.grain.amount, sketch.grain.roughness, sketch.grain.smudge) = (0.5, 1.0, 0.3);
    sketch.grain.image = Some(PathBuf::from("paper"));
    (sketch.fill.object_color, sketch.fill.strokes, sketch.fill.opacity) = (0.5, 0.5, 0.8);
    style
}

/// Two things that overlap at the left, and one far off at the right.
fn three() -> Opened {
    let scene = common::scene(vec![
        ("a", primitives::cube(1.0), at(-1.2, 0.1, 0.0) * glam::DMat4::from_rotation_y(0.5), [0.8, 0.5, 0.3]),
        ("behind", primitives::sphere(0.5, 12, 20), at(-1.5, -0.3, -0.8), [0.4, 0.6, 0.8]),
        ("b", primitives::torus(0.5, 0.2, 20, 10), at(1.4, 0.0, 0.2), [0.5, 0.8, 0.4]),
    ]);
    let mut opened = common::opened(&scene, DVec3::Z);
    opened.document.camera = Some(seen_from(DVec3::new(0.0, 2.5, 8.5), DVec3::ZERO));
    opened
}

#[test]
fn each_parameter_of_a_sketch_changes_it_and_nothing_far_from_it() {
    let mut session = common::session();
    session.renderer().set_images(StyleImages::new([(PathBuf::from("paper"), Arc::new(paper()))].into()));
    let mut opened = three();
    session.set_scene(&opened).unwrap();
    set_style(&mut opened, 1, &style("toon"));
    let changes = changes();
    assert!(changes.len() > 60, "{}", changes.len());
    let mut still = Vec::new();
    // Once as a sketch among others and once as an object like any other.
    for other in [rich("gooch"), style("gooch")] {
        set_style(&mut opened, 2, &other);
        set_style(&mut opened, 0, &rich("gooch"));
        for (key, conditions, values) in &changes {
            // Half of all is enough beside another one.
            if !other.sketch.enabled && key.contains("pass") && !key.contains("pass1") {
                continue;
            }
            let scene = Arc::clone(&opened.scene);
            let mut before = opened.clone();
            for condition in conditions.iter().filter(|condition| condition.key != "technique") {
                let value = Value::parse(condition.values[0]);
                before.document.set_for(&scene, &[0], condition.key, &value).unwrap();
            }
            let first = drawn(&mut session, &before, SIDE, |_| true);
            let mut seen = false;
            for value in values {
                let mut after = before.clone();
                after.document.set_for(&scene, &[0], key, value).unwrap();
                let after = drawn(&mut session, &after, SIDE, |_| true);
                let is_far = |px: usize| px % SIDE as usize > 95;
                // Roundings, where what is far is drawn together with it or not.
                let changed = is_other(&first, &after, 2e-3);
                let count = (0..changed.len()).filter(|px| is_far(*px) && changed[*px]).count();
                assert_eq!(count, 0, "{key} = {value} changes another object");
                let apart = apart(&first, &after);
                seen |= (0..apart.len()).any(|px| !is_far(px) && apart[px] > 0);
                if seen && !other.sketch.enabled {
                    break;
                }
            }
            if !seen {
                still.push(key.clone());
            }
        }
    }
    assert!(still.is_empty(), "these change nothing: {still:?}");
}
