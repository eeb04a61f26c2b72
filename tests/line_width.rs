//! Ink covers of each pixel what a line of its width covers, however it runs.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "what was measured is worth reading")]

mod common;

use common::line_drawing::{Ink, line_drawing, only, set_width};
use common::line_scenes::named;
use common::outline::coverage;
use common::{scene, session, set};
use glam::{DMat4, DVec2, DVec3, Vec3};
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::primitives::{cube, from_triangles};
use hachure::geometry::{EdgeClass, Mesh};
use hachure::scene::{Camera, Projection};

/// A camera that shows a unit of the scene as a pixel and the origin in the middle.
fn camera(height: u32) -> Camera {
    Camera {
        position: DVec3::Z * 100.0,
        focal_point: DVec3::ZERO,
        view_up: DVec3::Y,
        projection: Projection::Orthographic { view_height: f64::from(height) },
    }
}

/// A flat polygon, star-shaped about its first corner.
fn flat(corners: &[DVec2]) -> Mesh {
    let fan = (1..corners.len() as u32 - 1).flat_map(|i| [0, i, i + 1]).collect();
    from_triangles(corners.iter().map(|c| Vec3::new(c.x as f32, c.y as f32, 0.0)).collect(), fan)
}

/// The border of a mesh.
fn bordered(session: &mut Session, mesh: Mesh, size: [u32; 2]) -> Opened {
    let scene = scene(vec![("flat", mesh, DMat4::IDENTITY, [0.7; 3])]);
    let mut opened = line_drawing(&scene, camera(size[1]));
    only(&mut opened, &[EdgeClass::Border]);
    session.set_scene(&opened).unwrap();
    opened
}

/// Mean difference over the pixels that are covered in part, and drawn ink over true ink.
#[derive(Debug, Default, Clone, Copy)]
struct Difference {
    mean: f64,
    ratio: f64,
}

/// Compares with the true coverage of pixels, away from the sides of the picture.
fn compare(ink: &Ink, margin: u32, truth: impl Fn(DVec2) -> f64) -> Difference {
    let [width, height] = ink.size;
    let (mut count, mut sum, mut drawn, mut wanted) = (0.0, 0.0, 0.0, 0.0);
    for (x, y) in (margin..height - margin).flat_map(|y| (margin..width - margin).map(move |x| (x, y))) {
        let (is, should) = (ink.at(x as i32, y as i32), truth(DVec2::new(f64::from(x), f64::from(y))));
        if should > 1e-9 && should < 1.0 - 1e-9 {
            count += 1.0;
            sum += (is - should).abs();
        }
        drawn += is;
        wanted += should;
    }
    assert!(count > 20.0, "nothing to see");
    Difference { mean: sum / count, ratio: drawn / wanted }
}

/// A half plane whose border runs in a direction through a point near the middle of the picture.
struct Straight {
    direction: DVec2,
    through: DVec2,
}

impl Straight {
    fn at(degrees: f64) -> Self {
        let direction = DVec2::from_angle(degrees.to_radians());
        Self { direction, through: DVec2::new(0.31, -0.17) }
    }

    fn mesh(&self) -> Mesh {
        let (along, across) = (self.direction * 2000.0, self.direction.perp() * 2000.0);
        let [a, b] = [self.through - along, self.through + along];
        flat(&[a, b, b + across, a + across])
    }

    /// The strip between two distances from the border, on its outside, in pixels of a picture.
    fn strip(&self, size: [u32; 2], [from, to]: [f64; 2]) -> Vec<DVec2> {
        let outwards = -self.direction.perp();
        let corner = |along: f64, out: f64| {
            let p = self.through + self.direction * along + outwards * out;
            DVec2::new(p.x, -p.y) + DVec2::new(f64::from(size[0]), f64::from(size[1])) * 0.5
        };
        vec![corner(-900.0, from), corner(900.0, from), corner(900.0, to), corner(-900.0, to)]
    }
}

const ANGLES: [f64; 12] = [0.0, 3.0, 11.0, 26.6, 37.0, 45.0, 58.0, 72.0, 89.0, 90.0, 124.0, 161.0];

/// The mean of all mean differences, the worst one and the worst ratio of straight lines in all directions.
fn straight_lines(session: &mut Session, width: f64, size: [u32; 2], alignment: &str) -> (f64, Difference) {
    let reach = match alignment {
        "outward" => [0.0, width],
        "inward" => [-width, 0.0],
        _ => [-0.5 * width, 0.5 * width],
    };
    let mut worst = Difference { mean: 0.0, ratio: 1.0 };
    let mut mean = 0.0;
    for degrees in ANGLES {
        let line = Straight::at(degrees);
        let mut opened = bordered(session, line.mesh(), size);
        set_width(&mut opened, width, size[1]);
        set(&mut opened, "edges.alignment", alignment);
        let ink = Ink::of(session, &opened, size);
        let strip = line.strip(size, reach);
        let margin = (reach[1] - reach[0]).max(1.0) as u32 + 3;
        let found = compare(&ink, margin.min(20), |px| coverage(&strip, px));
        worst.mean = worst.mean.max(found.mean);
        mean += found.mean / ANGLES.len() as f64;
        if (found.ratio - 1.0).abs() > (worst.ratio - 1.0).abs() {
            worst.ratio = found.ratio;
        }
    }
    (mean, worst)
}

#[test]
fn a_straight_line_covers_what_its_width_covers() {
    let mut session = session();
    let mut wrong = Vec::new();
    for (samples, most, cases) in [
        (
            1,
            0.05,
            &[
                (1.0, [64, 100]),
                (2.0, [64, 100]),
                (4.0, [64, 100]),
                (8.0, [64, 136]),
                (16.0, [72, 270]),
                (32.0, [96, 540]),
            ][..],
        ),
        (64, 0.02, &[(1.0, [48, 48]), (2.0, [48, 48]), (5.0, [48, 90])][..]),
    ] {
        session.set_samples(samples);
        for &(width, size) in cases {
            let (mean, worst) = straight_lines(&mut session, width, size, "centered");
            println!(
                "{samples} samples, {width} px: mean difference {mean:.4}, worst {:.4}, width {:.4}",
                worst.mean, worst.ratio
            );
            // Along the axes all pixels are alike, so that what is between the samples does not even out.
            if mean > most || worst.mean > 2.0 * most || (worst.ratio - 1.0).abs() > 0.03 {
                wrong.push((samples, width, mean, worst));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

#[test]
fn a_line_outside_or_inside_lies_there_with_all_its_width() {
    let mut session = session();
    let mut wrong = Vec::new();
    for alignment in ["outward", "inward"] {
        for (width, size) in [(1.0, [64, 64]), (3.0, [64, 64]), (8.0, [64, 136])] {
            let (_, found) = straight_lines(&mut session, width, size, alignment);
            println!(
                "{alignment}, {width} px: worst mean difference {:.4}, width {:.4}",
                found.mean, found.ratio
            );
            if found.mean > 0.05 || (found.ratio - 1.0).abs() > 0.03 {
                wrong.push((alignment, width, found));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

#[test]
fn only_profile_edges_lie_outside_or_inside_and_creases_stay_in_the_middle() {
    const SIZE: [u32; 2] = [64; 2];
    let mut session = session();
    let corners = [(-20.0, -20.0), (20.0, -20.0), (20.0, 0.3), (-20.0, 0.3), (20.0, 20.0), (-20.0, 20.0)];
    let roof = corners.map(|(x, y): (f32, f32)| Vec3::new(x, y, -y.abs()));
    let roof = from_triangles(roof.to_vec(), vec![0, 1, 2, 0, 2, 3, 3, 2, 4, 3, 4, 5]);
    let mut opened = bordered(&mut session, roof, SIZE);
    set_width(&mut opened, 3.0, SIZE[1]);
    let mut drawn = |class: EdgeClass, alignment: &str| {
        only(&mut opened, &[class]);
        set(&mut opened, "edges.alignment", alignment);
        Ink::of(&mut session, &opened, SIZE).values
    };
    let [crease, border] = [EdgeClass::Ridge, EdgeClass::Border].map(|class| drawn(class, "centered"));
    assert!(crease.iter().sum::<f64>() > 100.0 && border.iter().sum::<f64>() > 400.0);
    for alignment in ["outward", "inward"] {
        assert!(drawn(EdgeClass::Ridge, alignment) == crease, "{alignment}");
        assert!(drawn(EdgeClass::Border, alignment) != border, "{alignment}");
    }
}

#[test]
fn a_circle_covers_what_its_width_covers() {
    const RADIUS: f64 = 30.0;
    let circle = |radius: f64| -> Vec<DVec2> {
        (0..720).map(|i| DVec2::from_angle(f64::from(i) * 0.5_f64.to_radians()) * radius).collect()
    };
    let mut session = session();
    let size = [96, 96];
    let mut opened = bordered(&mut session, flat(&circle(RADIUS)), size);
    let mut wrong = Vec::new();
    for (samples, most) in [(1, 0.05), (64, 0.02)] {
        session.set_samples(samples);
        for width in [1.0, 2.0, 4.0] {
            set_width(&mut opened, width, size[1]);
            let ink = Ink::of(&mut session, &opened, size);
            let inside = |radius: f64| -> Vec<DVec2> { circle(radius).iter().map(|p| *p + 48.0).collect() };
            let [outer, inner] = [RADIUS + 0.5 * width, RADIUS - 0.5 * width].map(inside);
            let found = compare(&ink, 2, |px| coverage(&outer, px) - coverage(&inner, px));
            println!(
                "circle, {samples} samples, {width} px: mean difference {:.4}, width {:.4}",
                found.mean, found.ratio
            );
            if found.mean > most || (found.ratio - 1.0).abs() > 0.03 {
                wrong.push((samples, width, found));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

/// Mean and greatest-row difference of a picture and one twice as large, reduced; over all pixels and over those with
/// ink in either.
fn reduced_difference(session: &mut Session, name: &str, side: u32) -> [f64; 2] {
    let scene = named(name).scene;
    let camera = Camera::looking_from(DVec3::new(0.6, 0.6, 0.7), DVec3::Y, &scene.extent(), 1.0);
    let mut opened = line_drawing(&scene, camera);
    // In a thumbnail thinner lines would keep more ink.
    set_width(&mut opened, (2.5 * f64::from(side) / 1080.0).max(0.8), side);
    session.set_scene(&opened).unwrap();
    session.set_samples(64);
    let [large, small] = [2 * side, side].map(|side| Ink::of(session, &opened, [side; 2]));
    let (mut sum, mut inked) = (0.0, 0.0);
    for (x, y) in (0..side as i32).flat_map(|y| (0..side as i32).map(move |x| (x, y))) {
        let four = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| large.at(2 * x + i, 2 * y + j));
        let reduced = four.iter().sum::<f64>() / 4.0;
        sum += (reduced - small.at(x, y)).abs();
        inked += f64::from(u8::from(reduced > 0.0 || small.at(x, y) > 0.0));
    }
    [sum / f64::from(side * side), sum / inked]
}

#[test]
fn a_picture_twice_as_large_and_reduced_is_the_same() {
    let mut session = session();
    for name in ["intersecting", "torus"] {
        let [all, inked] = reduced_difference(&mut session, name, 120);
        println!("{name}: mean difference {all:.4}, where there is ink {inked:.4}");
        assert!(all <= 0.01 && inked <= 0.06, "{name}: {all} {inked}");
    }
}

#[test]
#[ignore = "heavy: run by `make quality`"]
fn a_large_picture_reduced_is_the_same() {
    let mut session = session();
    for name in ["intersecting", "torus", "wires", "stairs"] {
        let [all, inked] = reduced_difference(&mut session, name, 800);
        println!("{name}: mean difference {all:.4}, where there is ink {inked:.4}");
        assert!(all <= 0.01 && inked <= 0.06, "{name}: {all} {inked}");
    }
}

#[test]
fn thumbnails_keep_ink_in_the_proportion_of_widths() {
    let mut session = session();
    session.set_samples(64);
    let line = Straight::at(0.0);
    for side in [32, 64, 128, 256, 400] {
        let mut opened = bordered(&mut session, line.mesh(), [side; 2]);
        let mut ink = |width: f64| {
            set(&mut opened, "edges.profile.width", &format!("{width}"));
            let ink = Ink::of(&mut session, &opened, [side; 2]);
            (0..side as i32).map(|y| ink.at(side as i32 / 2, y)).sum::<f64>()
        };
        for width in [1.0, 1.5, 3.0, 12.0] {
            let wanted = (width * f64::from(side) / 1080.0).max((0.25 * width).min(0.75));
            let drawn = ink(width);
            assert!((drawn - wanted).abs() < 0.04, "{width} at {side}: {drawn:.3} of {wanted:.3}");
        }
    }
}

/// A far thing with thick creases before a near one with a thin outline.
#[test]
fn an_outline_has_no_gaps_where_thicker_lines_go_on_behind_it() {
    const SIDE: u32 = 160;
    let mut session = session();
    // Flights of steps, seen from the front, each edge of which ends behind the sheet.
    let steps = (0..24).flat_map(|i| {
        let (y, z) = (3.0 * f64::from(i) - 36.0, -20.0 - 2.0 * f64::from(i));
        [DVec2::new(y, z), DVec2::new(y + 3.0, z)]
    });
    let profile: Vec<DVec2> = steps.collect();
    let positions = profile.iter().flat_map(|p| [-60.0, 60.0].map(|x| Vec3::new(x, p.x as f32, p.y as f32)));
    let quads = (0..profile.len() as u32 - 1).flat_map(|i| {
        let [a, b, c, d] = [2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3];
        [a, b, d, a, d, c]
    });
    let stairs = from_triangles(positions.collect(), quads.collect());
    let corners = [[0.0, -30.0], [70.0, -30.0], [70.0, 30.0], [0.0, 30.0]].map(DVec2::from_array);
    for (profile_px, inner_px) in [(1.3, 1.7), (1.3, 2.4), (1.0, 4.0)] {
        for tilt in [0.0, 0.01, 0.03] {
            let sheet = DMat4::from_translation(DVec3::new(0.3, 0.0, 20.0)) * DMat4::from_rotation_z(tilt);
            let scene = scene(vec![
                ("stairs", stairs.clone(), DMat4::from_rotation_x(0.2), [0.7; 3]),
                ("sheet", flat(&corners), sheet, [0.7; 3]),
            ]);
            let mut opened = line_drawing(&scene, camera(SIDE));
            set_width(&mut opened, profile_px, SIDE);
            set(&mut opened, "edges.inner.width", &format!("{}", inner_px * 1080.0 / f64::from(SIDE)));
            session.set_scene(&opened).unwrap();
            let ink = Ink::of(&mut session, &opened, [SIDE; 2]);
            for y in 55..105 {
                let drawn = (78..84).map(|x| ink.at(x, y)).sum::<f64>();
                assert!(
                    drawn > 0.6 * profile_px,
                    "{profile_px} px before {inner_px} px, tilted {tilt}, row {y}: {drawn:.3}"
                );
            }
        }
    }
}

/// However lines are looked for, which depends on the widest of them.
#[test]
fn thin_lines_do_not_swallow_others_beside_them() {
    const SIDE: u32 = 160;
    let mut session = session();
    for beside in [1.6, 2.0, 2.4] {
        let corners = [[-40.0, -60.0], [0.0, -60.0], [0.0, 60.0], [-40.0, 60.0]];
        let sheet = flat(&corners.map(DVec2::from_array));
        let turned = DMat4::from_translation(DVec3::new(beside, 0.0, -60.0))
            * DMat4::from_rotation_y(std::f64::consts::FRAC_PI_4);
        let scene = scene(vec![
            ("sheet", sheet, DMat4::from_translation(DVec3::Z * 10.0), [0.7; 3]),
            ("cube", cube(60.0), turned, [0.7; 3]),
        ]);
        let mut opened = line_drawing(&scene, camera(SIDE));
        session.set_scene(&opened).unwrap();
        for px in [1.7, 1.85, 1.95, 2.1] {
            set_width(&mut opened, px, SIDE);
            let ink = Ink::of(&mut session, &opened, [SIDE; 2]);
            // Of both lines, in a row between the corners.
            let drawn = (76..90).map(|x| ink.at(x, 80)).sum::<f64>();
            let wanted = px + px.min(beside);
            assert!(drawn > wanted - 0.3, "{px} px wide, {beside} px apart: {drawn:.3} of {wanted:.3}");
        }
    }
}

/// Ink per pixel of length along the middle of a straight line between two places in the picture, px.
fn width_along(ink: &Ink, [from, to]: [DVec2; 2]) -> f64 {
    let (length, along) = (from.distance(to), (to - from).normalize());
    let [width, height] = ink.size.map(|side| side as i32);
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let is_near = |&(x, y): &(i32, i32)| {
        let away = DVec2::new(f64::from(x), f64::from(y)) + 0.5 - from;
        let share = away.dot(along) / length;
        share > 0.2 && share < 0.8 && away.perp_dot(along).abs() < 7.0
    };
    pixels.filter(is_near).map(|(x, y)| ink.at(x, y)).sum::<f64>() / (0.6 * length)
}

#[test]
fn what_dips_into_a_surface_has_a_whole_line_at_its_foot() {
    const SIDE: u32 = 300;
    const WIDTH: f64 = 3.0;
    let mut session = session();
    let depths = [0.0, 0.2, 0.4, 0.7, 1.2, 2.0];
    for (elevation, deep) in [5.0_f64, 10.0, 20.0, 45.0].into_iter().flat_map(|e| depths.map(|d| (e, d))) {
        let plate = DMat4::from_scale_rotation_translation(
            DVec3::new(600.0, 20.0, 600.0),
            Default::default(),
            DVec3::new(0.0, -10.0, 0.0),
        );
        let place = DMat4::from_translation(DVec3::new(0.0, 50.0 - deep, 0.0));
        let scene = scene(vec![("plate", cube(1.0), plate, [0.7; 3]), ("box", cube(100.0), place, [0.7; 3])]);
        let (azimuth, elevation) = (35.0_f64.to_radians(), elevation.to_radians());
        let back =
            DVec3::new(azimuth.sin() * elevation.cos(), elevation.sin(), azimuth.cos() * elevation.cos());
        let seen = Camera { position: 1000.0 * back, ..camera(SIDE) };
        let mut opened = line_drawing(&scene, seen);
        set_width(&mut opened, WIDTH, SIDE);
        session.set_scene(&opened).unwrap();
        let ink = Ink::of(&mut session, &opened, [SIDE; 2]);
        let right = DVec3::Y.cross(back).normalize();
        let down = right.cross(back);
        let middle = 0.5 * f64::from(SIDE);
        let px = |x: f64, z: f64| {
            let at = DVec3::new(x, 0.0, z);
            DVec2::new(at.dot(right), at.dot(down)) + middle
        };
        for foot in [[px(-50.0, 50.0), px(50.0, 50.0)], [px(50.0, 50.0), px(50.0, -50.0)]] {
            let found = width_along(&ink, foot);
            assert!(
                (found - WIDTH).abs() < 0.1 * WIDTH,
                "from {:.0}°, {deep} px deep: {found:.2} px",
                elevation.to_degrees()
            );
        }
    }
}
