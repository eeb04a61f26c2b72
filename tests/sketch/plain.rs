//! Sketches that move nothing.

use glam::DVec3;
use hachure::export::session::Opened;
use hachure::geometry::primitives;
use hachure::style::{Matrix, Style};

use super::common::{self, set};
use super::{at, drawn, is_other, style, surface_techniques};

const SIDE: u32 = 160;

fn still(mut style: Style) -> Style {
    style.sketch.enabled = true;
    style.sketch.pass.iter_mut().for_each(|pass| pass.matrix = Matrix::ZERO);
    style.sketch.fill.matrix = Matrix::ZERO;
    style
}

/// Things that overlap, or convex ones apart, of which no line competes with one that is hidden.
fn things(overlapping: bool) -> Opened {
    let turn = glam::DMat4::from_rotation_x(0.5) * glam::DMat4::from_rotation_y(0.6);
    let mut objects = vec![
        ("box", primitives::cube(1.2), at(-1.0, 0.2, 0.0) * turn, [0.8, 0.5, 0.3]),
        ("ball", primitives::sphere(0.8, 14, 24), at(1.0, 0.1, 0.1), [0.4, 0.6, 0.8]),
    ];
    if overlapping {
        objects.push((
            "ring",
            primitives::torus(0.9, 0.2, 24, 10),
            at(0.0, -0.3, 0.4) * turn,
            [0.5, 0.8, 0.4],
        ));
    }
    common::opened(&common::scene(objects), DVec3::new(0.3, 0.4, 1.0))
}

/// Lines that are found in another way where nothing moves.
const THIN: &[(&str, &str)] = &[("edges.profile.width", "8"), ("edges.inner.width", "6")];

/// Equally wide ones, unless anything else is said.
const WIDE: &[(&str, &str)] = &[("edges.profile.width", "16"), ("edges.inner.width", "16")];

/// Lines of many kinds.
const LINES: [&[(&str, &str)]; 7] = [
    &[],
    &[("edges.profile.width", "24"), ("edges.inner.width", "5")],
    &[("edges.mode", "image_space")],
    THIN,
    &[("edges.dash.length", "30"), ("edges.silhouette.dashed", "true")],
    &[("edges.object_color", "0.6"), ("edges.variation.distance", "0.7"), ("edges.pressure.amount", "0.7")],
    &[("edges.profile.show", "false"), ("edges.inner.show", "false")],
];

#[test]
fn sketches_without_offsets_are_the_plain_picture() {
    let mut session = common::session();
    for overlapping in [false, true] {
        let opened = things(overlapping);
        session.set_scene(&opened).unwrap();
        for technique in surface_techniques() {
            // All of the lines with one technique, some of them with each.
            let count = if technique == "gooch" { LINES.len() } else { 2 };
            for lines in &LINES[..count] {
                let mut plain = opened.clone();
                plain.document.style = style(technique);
                for (key, value) in WIDE.iter().chain(*lines) {
                    set(&mut plain, key, value);
                }
                let mut sketch = plain.clone();
                sketch.document.style = still(plain.document.style.clone());
                let mut forced = sketch.clone();
                forced.document.style.sketch.wander.pressure = 1e-6;
                let mut picture = |opened| drawn(&mut session, &opened, SIDE, |_| true);
                let [plain, sketch, forced] = [plain, sketch, forced].map(&mut picture);
                assert!(plain == sketch, "{technique} with {lines:?}");
                let wrong = is_other(&plain, &forced, 1e-3).into_iter().filter(|is_other| *is_other).count();
                // Lines behind hidden ones are found from farther away.
                let most = if overlapping || *lines == THIN { plain.pixels().len() / 150 } else { 20 };
                println!("{technique} with {lines:?}: {wrong} pixels differ");
                assert!(wrong <= most, "{technique} with {lines:?}, as a sketch: {wrong} pixels");
            }
        }
    }
}
