//! Halftone (Freudenberg et al. 2002; edge-enhancement paper, section 5): the tone that its ink adds up to, its CPU
//! twin, and what must hold of ink and of the built-in textures.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "the numbers are what the table is for")]

mod common;

use std::collections::HashSet;
use std::sync::Arc;

use common::{draw, image, opened, scene, session, set, surfels, texels};
use glam::{DMat4, DQuat, DVec3, Vec2, vec2};
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::primitives;
use hachure::render::effects::halftone::built_in;
use hachure::render::effects::halftone::calibration::{PLACES, SIZES, TONES, ink, sample};
use hachure::render::effects::halftone::threshold_map::{
    LAYERS, LEVELS, PERIODS, SIDE as TILE, STEPS, ThresholdMap,
};
use hachure::scene::{Projection, Scene, Texture as ImageTexture};
use hachure::style::Value;
use hachure::style::halftone::Texture;

const SIDE: u32 = 192;

const TEXTURES: [Texture; 4] = [Texture::Strokes, Texture::Dots, Texture::Lines, Texture::Stipple];

fn name(texture: Texture) -> &'static str {
    texture.into()
}

/// Black ink on white paper, without lines and lights: the tone is the ambient light.
fn halftone(scene: &Arc<Scene>, towards_viewer: DVec3, texture: Texture) -> Opened {
    let mut opened = opened(scene, towards_viewer);
    set(&mut opened, "light.source", "file");
    for (key, value) in [
        ("technique", "halftone"),
        ("halftone.texture", name(texture)),
        ("halftone.ink", "#000000"),
        ("halftone.paper", "#ffffff"),
        ("halftone.object_tone", "0"),
        ("edges.profile.show", "false"),
        ("edges.inner.show", "false"),
    ] {
        set(&mut opened, key, value);
    }
    opened
}

/// Where the texture lies.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Fixed {
    Screen,
    Triplanar,
    Uv,
}

const EVERYWHERE: [Fixed; 3] = [Fixed::Screen, Fixed::Triplanar, Fixed::Uv];

fn fix(opened: &mut Opened, fixed: Fixed) {
    set(opened, "halftone.space", if fixed == Fixed::Screen { "screen" } else { "surface" });
    if fixed != Fixed::Screen {
        set(opened, "halftone.mapping", if fixed == Fixed::Uv { "uv" } else { "triplanar" });
    }
}

/// A plane, tilted, that fills every picture of it.
fn tilted_plane(tilt: f64) -> Arc<Scene> {
    let turn = DMat4::from_quat(DQuat::from_rotation_x(tilt.to_radians()));
    scene(vec![("plane", primitives::plane(40.0), turn, [0.7; 3])])
}

/// A patch of it, `zoom` times as large as a picture of height 2.
fn zoomed(opened: &mut Opened, zoom: f64) {
    let camera = opened.document.camera.as_mut().unwrap();
    (camera.position, camera.focal_point) = (DVec3::new(0.0, 0.0, 50.0), DVec3::ZERO);
    camera.projection = Projection::Orthographic { view_height: 2.0 / zoom };
}

/// Shares of ink of a picture, row by row.
fn inks(session: &mut Session, opened: &Opened, side: u32) -> Vec<f32> {
    let picture = session.draw(opened, [side, side], false).unwrap();
    texels::<[u8; 4]>(session, &picture.image).into_iter().map(|p| 1.0 - linear(p[1])).collect()
}

fn linear(byte: u8) -> f32 {
    hachure::style::Color([byte; 3]).to_linear().x
}

fn mean(values: &[f32]) -> f32 {
    values.iter().sum::<f32>() / values.len() as f32
}

/// The mean ink shall be what the tone asks for but for this.
const GOAL: f32 = 0.02;

/// Worst error of the mean ink over all that is asked for; prints the worst of each texture and place.
fn worst_tone_error(side: u32, tones: &[f32], zooms: &[f64], tilts: &[f64]) -> f32 {
    let mut session = session();
    let scenes: Vec<_> = tilts.iter().map(|tilt| tilted_plane(*tilt)).collect();
    let mut worst = vec![0.0_f32; TEXTURES.len() * EVERYWHERE.len()];
    for (scene, tilt) in scenes.iter().zip(tilts) {
        session.set_scene(&opened(scene, DVec3::Z)).unwrap();
        for (t, texture) in TEXTURES.into_iter().enumerate() {
            for (f, fixed) in EVERYWHERE.into_iter().enumerate() {
                let mut opened = halftone(scene, DVec3::Z, texture);
                // Not along the picture's rows, where a part of a line would count for a whole one.
                set(&mut opened, "halftone.angle", "27");
                fix(&mut opened, fixed);
                for zoom in zooms {
                    // On the screen a whole tile with three to six pixels between lines; on a surface six to twelve.
                    let six = 6.0 * 1080.0 / f64::from(side);
                    let scale = if fixed == Fixed::Screen { six / zoom } else { six };
                    set(&mut opened, "halftone.scale", &scale.to_string());
                    zoomed(&mut opened, *zoom);
                    let mut darker = 1.0;
                    for tone in tones {
                        set(&mut opened, "halftone.ambient", &tone.to_string());
                        let ink = mean(&inks(&mut session, &opened, side));
                        assert!(ink < darker, "{texture:?}, {fixed:?}: not darker at {tone}");
                        darker = ink;
                        let error = ink - (1.0 - tone);
                        if error.abs() >= GOAL {
                            println!(
                                "{texture:?}, {fixed:?}, zoom {zoom}, tilt {tilt}, tone {tone}: {error:+.4}"
                            );
                        }
                        let slot = &mut worst[t * EVERYWHERE.len() + f];
                        *slot = slot.max(error.abs());
                    }
                }
            }
        }
    }
    for (i, error) in worst.iter().enumerate() {
        let (t, f) = (i / EVERYWHERE.len(), i % EVERYWHERE.len());
        println!("{:<10}{:<12}{error:.4}", name(TEXTURES[t]), format!("{:?}", EVERYWHERE[f]));
    }
    worst.into_iter().fold(0.0, f32::max)
}

#[test]
fn the_mean_ink_is_what_the_tone_asks_for() {
    let worst = worst_tone_error(SIDE, &[0.1, 0.35, 0.6, 0.9], &[1.3], &[0.0, 60.0]);
    assert!(worst < GOAL, "{worst}");
}

#[test]
#[ignore = "heavy: run by `make quality`"]
fn the_mean_ink_is_what_the_tone_asks_for_in_every_case() {
    let tones: Vec<f32> = (0..16).map(|i| (i as f32 + 0.5) / 16.0).collect();
    println!("worst error of the mean ink, 16 tones, 4 zooms, 4 tilts (goal 0.02):");
    assert!(worst_tone_error(2 * SIDE, &tones, &[1.0, 1.3, 1.7, 2.1], &[0.0, 30.0, 60.0, 75.0]) < GOAL);
}

#[test]
fn white_has_no_ink_and_black_is_all_ink() {
    let mut session = session();
    let scene = tilted_plane(50.0);
    session.set_scene(&opened(&scene, DVec3::Z)).unwrap();
    for texture in TEXTURES {
        for fixed in EVERYWHERE {
            let mut opened = halftone(&scene, DVec3::Z, texture);
            fix(&mut opened, fixed);
            zoomed(&mut opened, 1.0);
            for tone in ["0", "1"] {
                set(&mut opened, "halftone.ambient", tone);
                let expected = if tone == "0" { 1.0 } else { 0.0 };
                let inks = inks(&mut session, &opened, SIDE);
                assert!(inks.iter().all(|ink| *ink == expected), "{texture:?}, {fixed:?}, {tone}");
            }
        }
    }
}

#[test]
fn darker_tones_only_add_ink() {
    let mut session = session();
    let scene = tilted_plane(20.0);
    session.set_scene(&opened(&scene, DVec3::Z)).unwrap();
    for texture in TEXTURES {
        let mut opened = halftone(&scene, DVec3::Z, texture);
        zoomed(&mut opened, 1.0);
        set(&mut opened, "halftone.scale", "80");
        let mut last = vec![0.0; (SIDE * SIDE) as usize];
        for step in (0..20).rev() {
            set(&mut opened, "halftone.ambient", &format!("{}", f64::from(step) / 20.0));
            let next = inks(&mut session, &opened, SIDE);
            assert!(last.iter().zip(&next).all(|(a, b)| *b >= a - 1e-6), "{texture:?}, tone {step}/20");
            last = next;
        }
        assert!(mean(&last) > 0.99, "{texture:?}: black is not all ink");
    }
}

/// The twin of `calibrated` in `shaders/effects/halftone.wgsl`.
fn calibrated(map: &ThresholdMap, step: f32, level: f32, tone: f32) -> f32 {
    let between = |place: f32, count: usize| {
        let inside = place.clamp(0.0, (count - 1) as f32);
        let first = (inside as usize).min(count - 2);
        (first, inside - first as f32)
    };
    let (place, by_place) = between(step / STEPS as f32 * (PLACES - 1) as f32, PLACES);
    let (size, by_size) = between((level + 2.0) * 4.0, SIZES);
    let (column, by_tone) = between(tone * (TONES - 1) as f32, TONES);
    let mix = |a: f32, b: f32, share: f32| a + (b - a) * share;
    let at = |place: usize, size: usize| {
        let i = (place * SIZES + size) * TONES + column;
        mix(map.calibration[i], map.calibration[i + 1], by_tone)
    };
    let of_place = |place| mix(at(place, size), at(place, size + 1), by_size);
    mix(of_place(place), of_place(place + 1), by_place) * 1.002 - 0.001
}

/// The twin of `ink_share`: a pixel's sides are `dx` and `dy` in tiles.
fn ink_share(map: &ThresholdMap, center: Vec2, [dx, dy]: [Vec2; 2], step: f32, tone: f32) -> f32 {
    let (major, minor) = axes(dx, dy);
    let taps = (major.length() / minor).round().clamp(1.0, 4.0);
    let size = minor.max(major.length() / taps) * TILE as f32;
    let threshold = calibrated(map, step, size.log2(), tone);
    let layer = (step as usize).min(STEPS - 1);
    let places = (0..taps as i32).map(|i| center + major * ((i as f32 + 0.5) / taps - 0.5));
    let inks = places.map(|at| {
        let [here, there] =
            [layer, layer + 1].map(|layer| sample(&map.layers[layer], at.to_array(), size.log2()));
        let mixed = [0, 1].map(|i| here[i] + (there[i] - here[i]) * (step - layer as f32));
        ink(mixed[0], mixed[1], size, threshold)
    });
    inks.sum::<f32>() / taps
}

/// The longer half axis of the ellipse that a circle becomes, and the length of the shorter: by turning the circle.
fn axes(dx: Vec2, dy: Vec2) -> (Vec2, f32) {
    let around = (0..1800).map(|i| Vec2::from_angle((i as f32 * 0.1).to_radians()));
    let image = around.map(|v| dx * v.x + dy * v.y);
    let longest = image.max_by(|a, b| a.length().total_cmp(&b.length())).unwrap();
    (longest, dx.perp_dot(dy).abs() / longest.length())
}

/// Most pixels equal their twin to a hundredth or two, and all of them together even more so. Devices filter textures
/// with few digits, which steep thresholds show.
fn assert_equal(what: &str, drawn: &[f32], twins: &[f32]) {
    let errors: Vec<f32> = drawn.iter().zip(twins).map(|(a, b)| (a - b).abs()).collect();
    let close = errors.iter().filter(|e| **e < 0.03).count() as f32 / errors.len() as f32;
    assert!(drawn.iter().any(|i| *i > 0.95) && drawn.iter().any(|i| *i < 0.05), "{what}: nothing to see");
    assert!(close > 0.97 && mean(&errors) < 0.005, "{what}: {close} close, mean error {}", mean(&errors));
}

#[test]
fn the_smooth_threshold_equals_its_twin() {
    let mut session = session();
    let tone = 0.55;
    for (tilt, texture) in [0.0, 40.0, 65.0, 75.0].into_iter().zip(TEXTURES) {
        let scene = tilted_plane(tilt);
        let mut opened = halftone(&scene, DVec3::Z, texture);
        zoomed(&mut opened, 1.4);
        for (key, value) in [("ambient", "0.55"), ("scale", "90"), ("angle", "25"), ("smoothness", "1.25")] {
            set(&mut opened, &format!("halftone.{key}"), value);
        }
        let map = built_in(texture);
        let tile = 90.0 * SIDE as f32 / 1080.0 * PERIODS as f32;
        let turn = Vec2::from_angle(-25.0_f32.to_radians());

        fix(&mut opened, Fixed::Screen);
        session.set_scene(&opened).unwrap();
        let drawn = inks(&mut session, &opened, SIDE);
        let sides = [Vec2::X, Vec2::Y].map(|v| turn.rotate(v) * 1.25 / tile);
        let twins: Vec<f32> = (0..SIDE * SIDE)
            .map(|i| turn.rotate(vec2((i % SIDE) as f32 + 0.5, (i / SIDE) as f32 + 0.5)) / tile)
            .map(|center| ink_share(map, center, sides, 0.0, tone))
            .collect();
        assert_equal(&format!("{texture:?} on the screen"), &drawn, &twins);

        fix(&mut opened, Fixed::Uv);
        draw(&mut session, &opened, SIDE);
        let coordinates = common::captured(&mut session, "coordinates").unwrap();
        let drawn = inks(&mut session, &opened, SIDE);
        let halves = |packed: u32| {
            let half = |bits: u32| {
                let (exponent, digits) = (bits >> 10 & 31, (bits & 1023) as f32);
                let value = if exponent == 0 {
                    digits * (-24.0_f32).exp2()
                } else {
                    (1.0 + digits / 1024.0) * (exponent as f32 - 15.0).exp2()
                };
                if bits >> 15 & 1 == 1 { -value } else { value }
            };
            vec2(half(packed & 0xffff), half(packed >> 16)) / 4096.0
        };
        let twins: Vec<f32> = texels::<[u32; 4]>(&mut session, &coordinates)
            .into_iter()
            .map(|[u, v, dx, dy]| {
                let uv = turn.rotate(vec2(f32::from_bits(u), f32::from_bits(v)));
                let [dx, dy] = [dx, dy].map(|d| turn.rotate(halves(d)));
                let (major, minor) = axes(dx, dy);
                let pixel = (major.length() * minor).sqrt().max(major.length() / 3.0);
                let wanted = (pixel * tile).log2();
                let per_unit = (-wanted.ceil()).exp2();
                let sides = [dx, dy].map(|d| d * 1.25 * per_unit);
                ink_share(map, uv * per_unit, sides, (wanted.ceil() - wanted) * STEPS as f32, tone)
            })
            .collect();
        assert_equal(&format!("{texture:?} by texture coordinates"), &drawn, &twins);
    }
}

#[test]
fn nothing_jumps_while_the_camera_comes_nearer() {
    let mut session = session();
    let scene = tilted_plane(35.0);
    session.set_scene(&opened(&scene, DVec3::Z)).unwrap();
    for (texture, fixed) in TEXTURES.into_iter().zip([Fixed::Uv, Fixed::Triplanar].into_iter().cycle()) {
        let mut opened = halftone(&scene, DVec3::Z, texture);
        fix(&mut opened, fixed);
        set(&mut opened, "halftone.ambient", "0.6");
        set(&mut opened, "halftone.scale", "120");
        let mut last: Option<Vec<f32>> = None;
        let mut changes = Vec::new();
        // 72 steps of one in a hundred: more than an octave.
        for step in 0..72 {
            zoomed(&mut opened, 1.01_f64.powi(step));
            let next = inks(&mut session, &opened, 48);
            if let Some(last) = &last {
                let change: Vec<f32> = last.iter().zip(&next).map(|(a, b)| (a - b).abs()).collect();
                changes.push(mean(&change));
            }
            last = Some(next);
        }
        let (usual, most) = (mean(&changes), changes.iter().copied().fold(0.0, f32::max));
        // Unrelated patterns of this tone differ in 0.48 of their pixels.
        assert!(most < 0.1 && most < 4.0 * usual, "{texture:?}: {most}, usually {usual}");
    }
}

#[test]
fn a_picture_twice_as_large_is_the_same_drawing() {
    let mut session = session();
    let ball = scene(vec![("ball", primitives::sphere(1.0, 64, 96), DMat4::IDENTITY, [0.8; 3])]);
    for texture in TEXTURES {
        for fixed in EVERYWHERE {
            let mut opened = halftone(&ball, DVec3::Z, texture);
            fix(&mut opened, fixed);
            set(&mut opened, "halftone.scale", "60");
            set(&mut opened, "light.source", "rig");
            session.set_scene(&opened).unwrap();
            let small = inks(&mut session, &opened, SIDE);
            let large = inks(&mut session, &opened, 2 * SIDE);
            assert!((0.02..0.98).contains(&mean(&small)), "{texture:?}, {fixed:?}: {}", mean(&small));
            let side = SIDE as usize;
            let errors: Vec<f32> = (0..side * side)
                .map(|i| {
                    let corner = (i / side * 2) * 2 * side + i % side * 2;
                    let four =
                        [corner, corner + 1, corner + 2 * side, corner + 2 * side + 1].map(|j| large[j]);
                    (mean(&four) - small[i]).abs()
                })
                .collect();
            assert!(mean(&errors) < 0.035, "{texture:?}, {fixed:?}: {}", mean(&errors));
        }
    }
}

#[test]
fn one_halftones_parameters_change_no_pixel_of_another() {
    let mut session = session();
    let at = |x: f64, y: f64, z: f64| DMat4::from_translation(DVec3::new(x, y, z));
    let scene = scene(vec![
        ("a", primitives::sphere(1.0, 48, 64), at(0.0, 0.0, 0.0), [0.8, 0.4, 0.4]),
        ("b", primitives::sphere(0.7, 48, 64), at(0.8, 0.2, 0.4), [0.4, 0.4, 0.8]),
    ]);
    let mut before = halftone(&scene, DVec3::new(0.1, 0.4, 1.0), Texture::Strokes);
    set(&mut before, "light.source", "rig");
    let first = image(&mut session, &before, SIDE);
    let picture = draw(&mut session, &before, SIDE);
    let objects: Vec<u32> = surfels(&mut session, &picture).iter().map(|s| s.object).collect();
    for (key, value) in [
        ("halftone.texture", "dots"),
        ("halftone.space", "screen"),
        ("halftone.mapping", "uv"),
        ("halftone.scale", "30"),
        ("halftone.angle", "30"),
        ("halftone.smoothness", "4"),
        ("halftone.ink", "#ff0000"),
        ("halftone.ink_tint", "0.5"),
        ("halftone.paper", "#00ff00"),
        ("halftone.paper_tint", "1"),
        ("halftone.ambient", "0.9"),
        ("halftone.object_tone", "1"),
        ("halftone.black", "0.3"),
        ("halftone.white", "0.6"),
        ("halftone.gamma", "3"),
        ("technique", "toon"),
    ] {
        let mut after = before.clone();
        after.document.set_for(&scene, &[0], key, &Value::parse(value)).unwrap();
        let second = image(&mut session, &after, SIDE);
        let pairs = first.pixels().zip(second.pixels()).zip(&objects);
        let changed: HashSet<u32> = pairs.filter(|((a, b), _)| a != b).map(|(_, object)| *object).collect();
        assert_eq!(changed, HashSet::from([1]), "{key}");
    }
}

#[test]
fn an_image_is_inked_first_where_it_is_dark_and_keeps_the_tone() {
    // A dark cross on an even ground; a single texel has no order but keeps the tone too.
    let cross = |x: u32, y: u32| if x < 8 || y < 8 { 30_u8 } else { 200 };
    for (width, picture) in [(48, &cross as &dyn Fn(u32, u32) -> u8), (1, &|_, _| 90_u8)] {
        let texels = (0..width * width).map(|i| picture(i % width, i / width));
        let rgba: Vec<u8> = texels.flat_map(|v| [v, v, v, 255]).collect();
        let image = Arc::new(ImageTexture { name: "tile".into(), width, height: width, rgba: rgba.into() });
        let mut session = session();
        session.renderer().set_images(hachure::render::StyleImages::new([("tile.png".into(), image)].into()));
        let scene = tilted_plane(0.0);
        session.set_scene(&opened(&scene, DVec3::Z)).unwrap();
        let mut opened = halftone(&scene, DVec3::Z, Texture::Image);
        fix(&mut opened, Fixed::Screen);
        zoomed(&mut opened, 1.0);
        set(&mut opened, "halftone.image", "tile.png");
        // One tile is as large as the picture.
        set(&mut opened, "halftone.scale", &(1080.0 / PERIODS as f32).to_string());
        for tone in [0.2, 0.7, 0.9] {
            set(&mut opened, "halftone.ambient", &tone.to_string());
            let inks = inks(&mut session, &opened, SIDE);
            assert!((mean(&inks) - (1.0 - tone)).abs() < 0.02, "{width}, {tone}: {}", mean(&inks));
            let of_cross = |dark: bool| {
                let in_cross = |i: usize| {
                    let texel = |c: usize| c as u32 * width / SIDE;
                    picture(texel(i % SIDE as usize), texel(i / SIDE as usize)) < 50
                };
                let of: Vec<f32> = inks
                    .iter()
                    .enumerate()
                    .filter(|(i, _)| in_cross(*i) == dark)
                    .map(|(_, ink)| *ink)
                    .collect();
                mean(&of)
            };
            // The cross covers 0.31 of the tile.
            assert!(width == 1 || tone < 0.69 || of_cross(false) < 0.03, "{tone}: {}", of_cross(false));
        }
    }
}

/// Thresholds of a step, 0 to 255.
fn thresholds(map: &ThresholdMap, step: usize) -> Vec<f32> {
    map.layers[step][0].iter().map(|t| f32::from(t[0])).collect()
}

#[test]
fn built_in_textures_are_evenly_ranked_and_repeat_without_a_seam() {
    for texture in TEXTURES {
        let map = built_in(texture);
        assert_eq!(map.layers.len(), LAYERS);
        assert!(map.layers.iter().all(|levels| levels.len() == LEVELS));
        assert_eq!(map.calibration.len(), PLACES * SIZES * TONES);
        for step in 0..STEPS {
            let thresholds = thresholds(map, step);
            for tone in 1..16 {
                let paper = thresholds.iter().filter(|t| **t < tone as f32 * 16.0).count() as f32;
                let error = paper / thresholds.len() as f32 - tone as f32 / 16.0;
                assert!(error.abs() < 0.02, "{texture:?}, step {step}, tone {tone}/16: {error}");
            }
            let change = |a: fn(usize) -> usize, b: fn(usize) -> usize| {
                let pairs = (0..TILE).map(|i| (thresholds[a(i)] - thresholds[b(i)]).abs());
                pairs.sum::<f32>() / TILE as f32
            };
            let [across, down] =
                [change(|i| i * TILE, |i| i * TILE + TILE - 1), change(|i| i, |i| (TILE - 1) * TILE + i)];
            let inside: Vec<f32> =
                (0..TILE * TILE - 1).map(|i| (thresholds[i] - thresholds[i + 1]).abs()).collect();
            let inside_down: Vec<f32> =
                (0..TILE * (TILE - 1)).map(|i| (thresholds[i] - thresholds[i + TILE]).abs()).collect();
            assert!(across < 1.5 * mean(&inside) + 1.0, "{texture:?}, step {step}: {across}");
            assert!(down < 2.0 * mean(&inside_down) + 1.0, "{texture:?}, step {step}: {down}");
        }
    }
}

#[test]
fn strokes_of_an_octave_stay_while_others_come_between() {
    for texture in TEXTURES {
        let map = built_in(texture);
        // The middles of the first strokes.
        let first = thresholds(map, 0);
        let middles: Vec<usize> = (0..first.len()).filter(|i| first[*i] >= 251.0).collect();
        for step in 1..STEPS {
            let later = thresholds(map, step);
            let kept = middles.iter().filter(|i| later[**i] >= 255.0 * 0.85).count();
            let share = kept as f32 / middles.len() as f32;
            // They get shorter, as they are as long as ever on the screen.
            assert!(share > 0.6, "{texture:?}, step {step}: {share} of the strokes stay");
        }
    }
}
