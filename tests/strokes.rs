//! Straight edges drawn as strokes of a hand.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::line_drawing::{Ink, line_drawing, only, set_width};
use common::{scene, session, set};
use glam::{DMat4, DVec2, DVec3};
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::EdgeClass;
use hachure::geometry::primitives::cube;
use hachure::scene::{Camera, Projection};

const SIDE: u32 = 400;

fn box_drawing(session: &mut Session) -> Opened {
    let scene = scene(vec![("box", cube(1.0), DMat4::IDENTITY, [0.7; 3])]);
    let camera = Camera {
        position: DVec3::new(2.1, 1.7, 2.6),
        focal_point: DVec3::ZERO,
        view_up: DVec3::Y,
        projection: Projection::Perspective { view_angle: 30.0 },
    };
    let mut opened = line_drawing(&scene, camera);
    session.set_scene(&opened).unwrap();
    only(&mut opened, &[EdgeClass::Silhouette, EdgeClass::Ridge]);
    set_width(&mut opened, 2.0, SIDE);
    opened
}

/// `shift` and overshoot are pixels.
fn with_strokes(opened: &Opened, times: u32, overshoot: f64, shift: f64) -> Opened {
    let mut opened = opened.clone();
    let per_pixel = 1080.0 / f64::from(SIDE);
    let numbers =
        [("overshoot", overshoot * per_pixel), ("shift", shift * per_pixel), ("bow", 0.0), ("tremor", 0.0)];
    set(&mut opened, "sketch.enabled", "true");
    // Nothing else wanders.
    set(&mut opened, "sketch.amount", "0");
    set(&mut opened, "sketch.strokes.enabled", "true");
    set(&mut opened, "sketch.strokes.times", &times.to_string());
    for (key, value) in numbers {
        set(&mut opened, &format!("sketch.strokes.{key}"), &value.to_string());
    }
    opened
}

/// The pixels with ink by a third.
fn inked(ink: &Ink) -> Vec<DVec2> {
    let [width, _] = ink.size;
    let place = |i: usize| DVec2::new((i % width as usize) as f64 + 0.5, (i / width as usize) as f64 + 0.5);
    ink.values.iter().enumerate().filter(|(_, ink)| **ink > 0.33).map(|(i, _)| place(i)).collect()
}

/// The pixels with ink in one that are farther from all ink of the other.
fn beyond(ink: &Ink, of: &Ink, distance: f64) -> usize {
    let others = inked(of);
    inked(ink)
        .iter()
        .filter(|p| !others.iter().any(|q| q.distance_squared(**p) < distance * distance))
        .count()
}

#[test]
fn lines_are_overshot_beyond_the_corners_of_a_box() {
    let mut session = session();
    let opened = box_drawing(&mut session);
    let plain = Ink::of(&mut session, &opened, [SIDE; 2]);
    let strokes = Ink::of(&mut session, &with_strokes(&opened, 2, 12.0, 0.0), [SIDE; 2]);
    assert_eq!(beyond(&plain, &strokes, 2.0), 0);
    // Nine visible lines have eighteen ends.
    assert!(beyond(&strokes, &plain, 3.0) > 18, "{}", beyond(&strokes, &plain, 3.0));
    assert_eq!(beyond(&strokes, &plain, 15.0), 0);
}

#[test]
fn a_steady_hand_draws_the_same_lines() {
    let mut session = session();
    let opened = box_drawing(&mut session);
    let plain = Ink::of(&mut session, &opened, [SIDE; 2]);
    let strokes = Ink::of(&mut session, &with_strokes(&opened, 1, 0.0, 0.0), [SIDE; 2]);
    assert!(beyond(&plain, &strokes, 1.5) == 0 && beyond(&strokes, &plain, 1.5) == 0);
    let sum = |ink: &Ink| ink.values.iter().sum::<f64>();
    // It presses less where lines are long.
    assert!((0.55..1.0).contains(&(sum(&strokes) / sum(&plain))), "{}", sum(&strokes) / sum(&plain));
    // No line is broken by being off its edges.
    let shifted = Ink::of(&mut session, &with_strokes(&opened, 1, 0.0, 2.0), [SIDE; 2]);
    assert_eq!(beyond(&plain, &shifted, 9.0), 0);
    let share = inked(&shifted).len() as f64 / inked(&strokes).len() as f64;
    assert!((0.9..1.1).contains(&share), "{share}");
}
