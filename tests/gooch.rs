//! Gooch shading (Gooch et al. 1998; edge-enhancement paper, section 5): a CPU twin with highlight and metal, and what
//! must hold of stripes and of surfaces with two sides.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use std::f32::consts::TAU;
use std::sync::Arc;

use common::{Surfel, draw, image, opened, scene, session, set, surfels, texels, to_srgb};
use glam::{DMat4, DVec3, EulerRot, Mat3, UVec2, Vec2, Vec3, vec2};
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::{Bounds, primitives};
use hachure::render::View;
use hachure::scene::Scene;
use hachure::style::Color;
use image::RgbaImage;

const SIDE: i32 = 160;

/// Gooch shading without lines.
fn gooch(scene: &Arc<Scene>, towards_viewer: DVec3, settings: &[(&str, &str)]) -> Opened {
    let mut opened = opened(scene, towards_viewer);
    set(&mut opened, "light.fill.show", "false");
    for (key, value) in
        [("technique", "gooch"), ("edges.profile.show", "false"), ("edges.inner.show", "false")]
            .iter()
            .chain(settings)
    {
        set(&mut opened, key, value);
    }
    opened
}

fn drawn(session: &mut Session, opened: &Opened) -> (RgbaImage, Vec<Surfel>, Vec<u32>) {
    let picture = draw(session, opened, SIDE as u32);
    let image = RgbaImage::from_raw(SIDE as u32, SIDE as u32, texels::<u8>(session, &picture.image)).unwrap();
    let regions = common::captured(session, "surface ids").unwrap();
    let regions = texels::<u32>(session, &regions);
    (image, surfels(session, &picture), regions)
}

/// The PCG hash as a number from 0 to 1.
fn chance(index: u32, seed: u32) -> f32 {
    let state = (index.wrapping_mul(747_796_405).wrapping_add(seed))
        .wrapping_mul(747_796_405)
        .wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (((word >> 22) ^ word) >> 8) as f32 / 16_777_216.0
}

/// Middles in turns and intensities of so many stripes, and the first one again a turn later.
fn stripes(count: u32, seed: u32) -> Vec<(f32, f32)> {
    let middle = |k: u32| (k as f32 + 0.5 + 0.6 * (chance(2 * k, seed) - 0.5)) / count as f32;
    let mut all: Vec<_> = (0..count).map(|k| (middle(k), 0.5 * chance(2 * k + 1, seed))).collect();
    all.push((all[0].0 + 1.0, all[0].1));
    all
}

/// The paper's lines through the middles.
fn intensity(stripes: &[(f32, f32)], turn: f32) -> f32 {
    let turn = if turn < stripes[0].0 { turn + 1.0 } else { turn };
    let after = stripes.iter().position(|(middle, _)| *middle > turn).unwrap_or(stripes.len() - 1);
    let ((a, from), (b, to)) = (stripes[after - 1], stripes[after]);
    from + (to - from) * (turn - a) / (b - a)
}

fn smoothstep(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

fn turn_of(v: Vec2) -> f32 {
    (v.y.atan2(v.x) / TAU).rem_euclid(1.0)
}

fn turned(a: f32, b: f32) -> f32 {
    (b - a + 0.5).rem_euclid(1.0) - 0.5
}

/// Style of the twin's scene, and as numbers.
const SETTINGS: [(&str, &str); 11] = [
    ("gooch.cool", "#203880"),
    ("gooch.warm", "#a08030"),
    ("gooch.alpha", "0.25"),
    ("gooch.beta", "0.6"),
    ("gooch.object_hue", "0.4"),
    ("gooch.side_light", "0.7"),
    ("gooch.highlight", "0.5"),
    ("gooch.shininess", "24"),
    ("gooch.metal", "0.8"),
    ("gooch.metal_axis", "y"),
    ("gooch.stripes", "12"),
];

struct Twin {
    view: View,
    light: Vec3,
    world_from_view: Mat3,
    /// Of each object: its color, and its Z and X axes, across its Y axis.
    objects: [(Vec3, Vec3, Vec3); 2],
}

impl Twin {
    fn towards_eye(&self, px: [i32; 2]) -> Vec3 {
        let ndc = (Vec2::new(px[0] as f32, px[1] as f32) + 0.5) / SIDE as f32 * 2.0 - 1.0;
        -(ndc * vec2(1.0, -1.0) * self.view.half_extent).extend(-1.0).normalize()
    }

    /// A direction as seen along the object's axis.
    fn across(&self, object: u32, direction: Vec3) -> Vec2 {
        let (_, z, x) = self.objects[object as usize - 1];
        let world = self.world_from_view * direction;
        vec2(world.dot(z), world.dot(x))
    }

    /// `slope`: change of the turn per pixel.
    fn color(&self, px: [i32; 2], s: &Surfel, slope: f32) -> Vec3 {
        let base = self.objects[s.object as usize - 1].0;
        let hue = Vec3::ONE.lerp(base, 0.4);
        let cool = (Color([32, 56, 128]).to_linear() * hue + 0.25 * base).min(Vec3::ONE);
        let warm = (Color([160, 128, 48]).to_linear() * hue + 0.6 * base).min(Vec3::ONE);
        let n_l = s.normal.dot(self.light);
        let eye = self.towards_eye(px);
        let key = (self.light - 0.7 * self.light.dot(eye) * eye).normalize();
        let shade = cool.lerp(warm, 0.5 + 0.5 * s.normal.dot(key));

        let across = self.across(s.object, s.normal);
        let light = self.across(s.object, self.light);
        let per_px = slope * 12.0;
        let stripe = intensity(&stripes(12, s.object), turn_of(across));
        let stripe = stripe + (0.25 - stripe) * smoothstep(0.5, 1.0, per_px);
        let width = per_px.max(1.0);
        let off = turned(turn_of(across), turn_of(light)).abs() * 12.0;
        let white = (1.0 - off / width).max(0.0) / width * smoothstep(0.05, 0.3, light.length());
        let stripe = stripe + (1.0 - stripe) * white;
        let metal =
            if stripe < 0.5 { shade * 2.0 * stripe } else { shade.lerp(Vec3::ONE, 2.0 * stripe - 1.0) };
        let shade = shade.lerp(metal, 0.8 * smoothstep(0.1, 0.5, across.length()));

        let reflected = 2.0 * n_l * s.normal - self.light;
        let gloss = reflected.dot(eye).max(0.0).powf(24.0);
        shade.lerp(Vec3::ONE, 0.5 * gloss)
    }
}

#[test]
fn gooch_with_highlight_and_metal_equals_its_twin() {
    let base = [[0.7, 0.4, 0.2], [0.3, 0.5, 0.7]];
    let turned_cone = DMat4::from_euler(EulerRot::XYZ, 0.5, 0.4, -0.7);
    let scene = scene(vec![
        ("ball", primitives::sphere(1.0, 48, 64), DMat4::IDENTITY, base[0]),
        (
            "egg",
            primitives::sphere(0.5, 32, 48),
            DMat4::from_translation(DVec3::new(1.3, 0.2, 0.3)) * turned_cone,
            base[1],
        ),
    ]);
    let opened = gooch(&scene, DVec3::new(0.3, 0.4, 1.0), &SETTINGS);
    let (image, surfels, regions) = drawn(&mut session(), &opened);
    let unit = Bounds { min: DVec3::NEG_ONE, max: DVec3::ONE };
    let view = View::new(&opened.document.camera.unwrap(), &unit, UVec2::splat(SIDE as u32));
    let linear = |c: [f32; 3]| Color(c.map(to_srgb)).to_linear();
    let axes = |m: DMat4| (m.z_axis.truncate().as_vec3(), m.x_axis.truncate().as_vec3());
    let object = |c, m| (linear(c), axes(m).0, axes(m).1);
    let twin = Twin {
        light: opened.document.lighting.key.direction().as_vec3(),
        world_from_view: Mat3::from_mat4(view.view_from_world.inverse().as_mat4()),
        objects: [object(base[0], DMat4::IDENTITY), object(base[1], turned_cone)],
        view,
    };

    let at = |px: [i32; 2]| (px[1] * SIDE + px[0]) as usize;
    let (mut compared, mut dark, mut white) = (0, 0, 0);
    for (i, s) in surfels.iter().enumerate() {
        let px = [i as i32 % SIDE, i as i32 / SIDE];
        let near = [[-1, 0], [1, 0], [0, -1], [0, 1]].map(|[dx, dy]| [px[0] + dx, px[1] + dy]);
        // Where the surface surely goes on to all sides; how it ends is tested with the toon.
        let goes_on = |q: &[i32; 2]| {
            let other = &surfels[at(*q)];
            regions[at(*q)] == regions[i] && other.face_normal.dot(s.face_normal) > 0.9
        };
        if s.object == 0 || !near.iter().all(goes_on) || s.face_normal.dot(twin.towards_eye(px)) < 0.3 {
            continue;
        }
        let turn = |q: [i32; 2]| turn_of(twin.across(s.object, surfels[at(q)].normal));
        let change = |a: usize, b: usize| {
            let here = turn(px);
            (turned(here, turn(near[b])) - turned(here, turn(near[a]))) * 0.5
        };
        let slope = vec2(change(0, 1), change(2, 3)).length();
        let color = twin.color(px, s, slope);
        let pixel = image.get_pixel(px[0] as u32, px[1] as u32).0;
        for (mine, theirs) in color.to_array().map(to_srgb).into_iter().zip(pixel) {
            assert!(mine.abs_diff(theirs) <= 2, "{px:?}: {color} against {pixel:?}");
        }
        compared += 1;
        dark += i32::from(color.max_element() < 0.25);
        white += i32::from(color.min_element() > 0.8);
    }
    assert!(compared > 5000 && dark > 50 && white > 50, "{compared} {dark} {white}: nothing to see");
}

#[test]
fn stripes_stay_on_the_object_and_change_little_as_it_turns() {
    let mut session = session();
    let tube = scene(vec![("ball", primitives::sphere(1.0, 64, 96), DMat4::IDENTITY, [0.6; 3])]);
    let settings = [("gooch.metal", "1"), ("gooch.highlight", "0"), ("gooch.stripes", "20")];
    let mut from = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        image(&mut session, &gooch(&tube, DVec3::new(sin, 0.2, cos), &settings), SIDE as u32)
    };
    let mut last = from(0.0);
    let first = last.clone();
    let difference = |a: &RgbaImage, b: &RgbaImage| {
        let pairs = a.as_raw().iter().zip(b.as_raw());
        pairs.map(|(a, b)| f64::from(a.abs_diff(*b))).sum::<f64>() / a.as_raw().len() as f64
    };
    // A stripe that became white all at once would be seen as a jump.
    let steps: Vec<f64> = (1..=20)
        .map(|i| {
            let next = from(f64::from(i));
            let step = difference(&last, &next);
            last = next;
            step
        })
        .collect();
    let (least, most) = steps.iter().fold((f64::MAX, 0.0_f64), |(a, b), s| (a.min(*s), b.max(*s)));
    assert!(most < 2.0 * least && least > 0.0, "{steps:?}");
    assert!(difference(&first, &last) > 2.0 * most, "stripes do not stay before the eye");
}

#[test]
fn metal_is_off_at_strength_zero_and_differs_from_object_to_object() {
    let mut session = session();
    let ball = || primitives::sphere(1.0, 48, 64);
    let two = scene(vec![("a", ball(), DMat4::IDENTITY, [0.6; 3]), ("b", ball(), DMat4::IDENTITY, [0.6; 3])]);
    let mut without = |hidden: &str, settings: &[(&str, &str)]| {
        let mut opened = gooch(&two, DVec3::Z, settings);
        opened.document.node_mut(hidden).visible = Some(false);
        image(&mut session, &opened, SIDE as u32)
    };
    let smooth = without("/b", &[]);
    let off = [("gooch.metal", "0"), ("gooch.stripes", "7"), ("gooch.metal_axis", "view")];
    assert_eq!(smooth, without("/b", &off));
    assert_eq!(smooth, without("/a", &[]));
    let metal = [("gooch.metal", "1")];
    let (first, second) = (without("/b", &metal), without("/a", &metal));
    let other = |a: &RgbaImage, b: &RgbaImage| {
        a.pixels().zip(b.pixels()).filter(|(a, b)| (0..3).any(|c| a.0[c].abs_diff(b.0[c]) > 24)).count()
    };
    assert!(other(&smooth, &first) > 4000 && other(&first, &second) > 2000);
}

#[test]
fn stripes_lie_around_turned_forms_and_on_no_others() {
    let mut session = session();
    let mut striped = |stretch: Vec3, place: DMat4| {
        let mut mesh = primitives::sphere(1.0, 48, 64);
        mesh.positions.iter_mut().for_each(|p| *p *= stretch);
        let scene = scene(vec![("form", mesh, place, [0.6; 3])]);
        let mut drawn = |metal| {
            let settings = [("gooch.metal", metal), ("gooch.metal_axis", "form")];
            image(&mut session, &gooch(&scene, DVec3::Z, &settings), SIDE as u32)
        };
        let (with, without) = (drawn("1"), drawn("0"));
        with.pixels()
            .zip(without.pixels())
            .filter(|(a, b)| (0..3).any(|c| a.0[c].abs_diff(b.0[c]) > 24))
            .count()
    };
    let turned = DMat4::from_euler(EulerRot::XYZ, 0.5, 0.4, -0.7);
    let lying = striped(Vec3::new(1.8, 0.9, 0.9), turned);
    let standing = striped(Vec3::new(0.9, 1.8, 0.9), turned);
    assert!(lying > 2000 && standing > 2000, "{lying} {standing}");
    assert_eq!(striped(Vec3::new(0.6, 1.8, 0.9), turned), 0);
}

#[test]
fn a_surface_is_shaded_on_the_side_that_is_seen() {
    let mut session = session();
    let sheet = scene(vec![("sheet", primitives::plane(1.0), DMat4::IDENTITY, [0.7, 0.5, 0.3])]);
    let mut from = |towards_viewer| image(&mut session, &gooch(&sheet, towards_viewer, &[]), SIDE as u32);
    // The light turns with the eye.
    assert_eq!(from(DVec3::Z), from(DVec3::NEG_Z));

    let mut bowl = primitives::sphere(1.0, 32, 48);
    let lower: Vec<u32> = bowl
        .indices
        .chunks_exact(3)
        .filter(|t| t.iter().all(|i| bowl.positions[*i as usize].y < 0.1))
        .flatten()
        .copied()
        .collect();
    bowl.submeshes[0].index_count = lower.len() as u32;
    bowl.indices = lower;
    let open = scene(vec![("bowl", bowl, DMat4::IDENTITY, [0.7, 0.5, 0.3])]);
    let opened = gooch(&open, DVec3::new(0.2, 0.8, 1.0), &[]);
    let (_, surfels, _) = drawn(&mut session, &opened);
    let unit = Bounds { min: DVec3::NEG_ONE, max: DVec3::ONE };
    let view = View::new(&opened.document.camera.unwrap(), &unit, UVec2::splat(SIDE as u32));
    let (mut inside, mut outside) = (0, 0);
    for (i, s) in surfels.iter().enumerate().filter(|(_, s)| s.object != 0) {
        let px = vec2((i as i32 % SIDE) as f32, (i as i32 / SIDE) as f32) + 0.5;
        let outwards = view.unproject(px, s.depth).normalize();
        let towards_eye = (opened.document.camera.unwrap().position - outwards).normalize();
        let is_inside = outwards.dot(towards_eye) < 0.0;
        let expected = view.view_from_world.transform_vector3(if is_inside { -outwards } else { outwards });
        // Facets differ from the sphere where it is seen edge-on.
        if outwards.dot(towards_eye).abs() > 0.2 {
            assert!(s.normal.as_dvec3().dot(expected) > 0.98, "{px}: {} and not {expected}", s.normal);
            if is_inside { inside += 1 } else { outside += 1 }
        }
    }
    assert!(inside > 1000 && outside > 1000, "{inside} {outside}");
}
