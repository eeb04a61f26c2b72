//! The lines at the foot of what stands on a floor, seen from low down.

use glam::{DMat4, DVec2, DVec3};
use hachure::export::session::Opened;
use hachure::geometry::primitives;
use hachure::style::sketch::Anchor;
use hachure::style::{Color, Style};

use super::common::{self, outline::projected};
use super::random::Random;
use super::{drawn, seen_from, set_style, sketched, style};

const SIDE: u32 = 216;

/// Half of the side of the box.
const HALF: f64 = 0.5;

/// A box on a floor, from an elevation in degrees.
fn standing(elevation: f64, azimuth: f64, orthographic: bool, sketch: &Style) -> Opened {
    let lying =
        DMat4::from_translation(DVec3::NEG_Y * HALF) * DMat4::from_rotation_x(-std::f64::consts::FRAC_PI_2);
    let scene = common::scene(vec![
        ("box", primitives::cube(1.0), DMat4::IDENTITY, [0.9; 3]),
        ("floor", primitives::plane(14.0), lying, [0.9; 3]),
    ]);
    let mut opened = common::opened(&scene, DVec3::Z);
    let (sin, cos) = elevation.to_radians().sin_cos();
    let (x, z) = azimuth.to_radians().sin_cos();
    let camera = seen_from(4.0 * DVec3::new(cos * x, sin, cos * z), DVec3::ZERO);
    opened.document.camera = Some(camera.with_orthographic(orthographic));
    let mut floor = style("unlit");
    (floor.edges.profile.show, floor.edges.inner.show) = (false, false);
    set_style(&mut opened, 0, sketch);
    set_style(&mut opened, 1, &floor);
    opened
}

/// Whether a pixel is nearer to an edge of the foot that is seen than to any other edge.
fn is_foot(opened: &Opened) -> impl Fn(DVec2) -> bool {
    let signs = [-HALF, HALF];
    let corners: Vec<DVec3> = signs
        .iter()
        .flat_map(|x| signs.iter().flat_map(move |y| signs.map(|z| DVec3::new(*x, *y, z))))
        .collect();
    let eye = opened.document.camera.unwrap().position;
    let mut edges = Vec::new();
    for a in &corners {
        for b in &corners {
            let apart = *b - *a;
            if (apart.length() - 2.0 * HALF).abs() < 1e-9 && apart.min_element() >= 0.0 {
                let middle = (*a + *b) * 0.5;
                let sides = DVec3::new(middle.x, 0.0, middle.z);
                let is_seen = middle.y < 0.0 && sides.dot(eye) > 0.0;
                let ends = projected(opened, [SIDE; 2], &[*a, *b]);
                edges.push((is_seen, [ends[0], ends[1]]));
            }
        }
    }
    move |px| {
        let away = |[a, b]: [DVec2; 2]| {
            let t = ((px - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
            px.distance(a.lerp(b, t))
        };
        let nearest = |feet: bool| {
            edges
                .iter()
                .filter(|(foot, _)| *foot == feet)
                .map(|(_, ends)| away(*ends))
                .fold(f64::INFINITY, f64::min)
        };
        nearest(true) < nearest(false)
    }
}

#[test]
fn ink_at_the_foot_of_a_box_on_a_floor_stays() {
    let mut session = common::session();
    for elevation in [8.0, 20.0, 45.0] {
        let (mut kept, mut all) = (0.0, 0.0);
        let mut random = Random::new(elevation as u64);
        let mut least: f64 = 1.0;
        for number in 0..16 {
            // 1.2 to 4 pixels of this picture.
            let rms = random.within(6.0, 20.0) as f32;
            let mut sketch = sketched(style("unlit"), rms, 6.0);
            sketch.edges.profile.color = Color([255, 0, 0]);
            sketch.edges.inner.color = Color([255, 0, 0]);
            sketch.sketch.wander.seed = number;
            sketch.sketch.passes = 1 + number % 2;
            if number % 4 == 3 {
                sketch.sketch.wander.anchor = Anchor::Screen;
            }
            let opened = standing(elevation, random.within(20.0, 70.0), number % 2 == 1, &sketch);
            session.set_scene(&opened).unwrap();
            let is_foot = is_foot(&opened);
            // Paper is a little red too.
            let red = |p: &image::Rgba<u8>| (f64::from(p.0[0].saturating_sub(p.0[1])) / 255.0 - 0.1).max(0.0);
            let with = drawn(&mut session, &opened, SIDE, |_| true);
            let without = drawn(&mut session, &opened, SIDE, |node| node == 0);
            let (mut own_kept, mut own_all) = (0.0, 0.0);
            for ((x, y, a), b) in without.enumerate_pixels().zip(with.pixels()) {
                if is_foot(DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5)) {
                    own_all += red(a);
                    own_kept += red(a).min(red(b));
                }
            }
            assert!(own_all > 100.0, "there is ink: {own_all}");
            least = least.min(own_kept / own_all);
            kept += own_kept;
            all += own_all;
        }
        println!(
            "contact ink from {elevation}°: {:.2} % kept, {:.2} % in the worst picture",
            100.0 * kept / all,
            100.0 * least
        );
        assert!(kept / all >= 0.95, "{elevation}°: {kept} of {all}");
    }
}
