//! How long it takes, printed: `cargo test --release --lib line_segments::speed -- --ignored --nocapture`.

use std::time::Instant;

use glam::DVec2;

use super::tests::{EYE, LENSES, Subject, everything, look_from};
use super::*;
use crate::geometry::primitives;

/// The median of some runs over all objects, in milliseconds, and the number of segments.
fn measure(subject: &Subject, places: &[DMat4], wanted: &LineSelection) -> (f64, usize) {
    let view = look_from(EYE, LENSES[0]);
    let mut out = Vec::new();
    let mut times: Vec<f64> = (0..31)
        .map(|_| {
            out.clear();
            let start = Instant::now();
            for &place in places {
                line_segments(&subject.at(place), &view, wanted, &mut out);
            }
            1e3 * start.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    (times[times.len() / 2], out.len())
}

/// So many placements side by side, all of them in the picture.
fn places(count: u32) -> Vec<DMat4> {
    let side = (f64::from(count)).sqrt().ceil();
    (0..count)
        .map(|i| DVec2::new(f64::from(i) % side, (f64::from(i) / side).floor()) / side - 0.5)
        .map(|at| DMat4::from_translation(at.extend(0.0)) * DMat4::from_scale(glam::DVec3::splat(0.5 / side)))
        .collect()
}

#[test]
#[ignore = "a measurement"]
#[expect(clippy::print_stdout, reason = "a measurement")]
fn speed() {
    let cases = [
        ("1.1 million triangles, smooth", primitives::torus(1.0, 0.3, 1100, 500), 1),
        ("1.1 million triangles, coarse", primitives::torus(1.0, 0.3, 275_000, 2), 1),
        ("67 objects of 400", primitives::torus(1.0, 0.3, 20, 10), 67),
        ("67 objects of 408, creases", primitives::torus(1.0, 0.3, 34, 6), 67),
        ("2000 cubes", primitives::cube(1.0), 2000),
    ];
    for (name, mesh, count) in cases {
        let start = Instant::now();
        let subject = Subject::new(mesh);
        let built = start.elapsed();
        let size = subject.edges.size_in_bytes() as f64 / 1e6;
        let (time, segments) = measure(&subject, &places(count), &everything());
        println!("{name}: {time:.3} ms, {segments} segments; {size:.1} MB, built in {built:.0?}");
    }
}
