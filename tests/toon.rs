//! Toon shading (edge-enhancement paper, section 5, Fig. 9): CPU twins of the ramp and of the cartoon map, and what
//! must hold of bands and their borders.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use std::collections::HashSet;
use std::sync::Arc;

use common::{Surfel, at, draw, image, opened, scene, session, set, surfels, texels, to_srgb};
use glam::{DMat4, DVec3, UVec2, Vec2, Vec3, vec3};
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::{Bounds, primitives};
use hachure::render::View;
use hachure::scene::{Images, Scene, Texture};
use hachure::style::{Color, Value};
use image::RgbaImage;

const SIDE: i32 = 160;

/// A toon without lines.
fn toon(scene: &Arc<Scene>, towards_viewer: DVec3, border: &str) -> Opened {
    let mut opened = opened(scene, towards_viewer);
    for (key, value) in [
        ("technique", "toon"),
        ("toon.smoothing", border),
        ("edges.profile.show", "false"),
        ("edges.inner.show", "false"),
    ] {
        set(&mut opened, key, value);
    }
    opened
}

/// Picture, its G-buffer, and surfaces by number.
struct Drawn {
    image: RgbaImage,
    surfels: Vec<Surfel>,
    regions: Vec<u32>,
    cartoon_map: Option<Vec<u16>>,
}

fn drawn(session: &mut Session, opened: &Opened) -> Drawn {
    let picture = draw(session, opened, SIDE as u32);
    let (regions, cartoon_map) =
        (common::captured(session, "surface ids").unwrap(), common::captured(session, "cartoon map"));
    Drawn {
        image: RgbaImage::from_raw(SIDE as u32, SIDE as u32, texels::<u8>(session, &picture.image)).unwrap(),
        surfels: surfels(session, &picture),
        regions: texels::<u32>(session, &regions),
        cartoon_map: cartoon_map.map(|map| texels::<u16>(session, &map)),
    }
}

/// The style of the twins' scene: four bands over 1.1 of N·L, a highlight and a rim.
const SETTINGS: [(&str, &str); 11] = [
    ("toon.bands", "4"),
    ("toon.start", "-0.2"),
    ("toon.end", "0.9"),
    ("toon.shadow", "#402060"),
    ("toon.mid", "#a08060"),
    ("toon.light", "#fff0c0"),
    ("toon.object_color", "0.5"),
    ("toon.highlight", "0.8"),
    ("toon.highlight_size", "20"),
    ("toon.rim", "0.5"),
    ("toon.rim_width", "0.4"),
];

// As in `shaders/effects/toon.wgsl`.
const HIGHLIGHT: u16 = 512;
const RIM: u16 = 1024;

/// What the twins know of the scene: first light and camera.
struct Twin {
    view: View,
    light: Vec3,
    base: [Vec3; 3],
}

impl Twin {
    /// The direction through a pixel's center, of depth 1.
    fn ray(&self, px: [i32; 2]) -> Vec3 {
        let ndc = (Vec2::new(px[0] as f32, px[1] as f32) + 0.5) / SIDE as f32 * 2.0 - 1.0;
        (ndc * Vec2::new(1.0, -1.0) * self.view.half_extent).extend(-1.0)
    }

    /// Ramp position in bands, and how far N·H and N·V are past the borders of highlight and rim.
    fn fields(&self, px: [i32; 2], s: &Surfel) -> [f32; 3] {
        let towards_eye = -self.ray(px).normalize();
        let half = (self.light + towards_eye).normalize();
        [
            (s.normal.dot(self.light) + 0.2) / 1.1 * 4.0,
            s.normal.dot(half) - 20.0_f32.to_radians().cos(),
            0.4 - s.normal.dot(towards_eye),
        ]
    }

    fn color(&self, object: u32, code: u16) -> Vec3 {
        // Even steps from the shadow over the middle to the light.
        let ramp = [[64, 32, 96], [128, 96, 96], [192, 165, 128], [255, 240, 192]];
        let band = Color(ramp[usize::from(code & 511) - 1]).to_linear();
        let tinted = band * (0.5 + 0.5 * self.base[object as usize - 1]);
        let lit = if code & HIGHLIGHT == 0 { tinted } else { tinted.lerp(Vec3::ONE, 0.8) };
        if code & RIM == 0 { lit } else { lit.lerp(Vec3::ONE, 0.5) }
    }

    /// By how many pixels the plane at `px` misses the depth at `other_px`.
    fn miss(&self, px: [i32; 2], s: &Surfel, other_px: [i32; 2], other: &Surfel) -> f32 {
        let on_plane = self.ray(px) * s.depth;
        let depth = s.face_normal.dot(on_plane) / s.face_normal.dot(self.ray(other_px));
        let pixel = 2.0 * self.view.half_extent.y / SIDE as f32;
        (1.0 / depth - 1.0 / other.depth).abs() * s.depth.min(other.depth) / pixel
    }
}

#[test]
fn ramp_and_cartoon_map_equal_their_twins() {
    let base = [[0.8, 0.3, 0.2], [0.3, 0.6, 0.8], [0.5, 0.5, 0.5]];
    let scene = scene(vec![
        ("torus", primitives::torus(1.0, 0.4, 48, 24), at(0.0, 0.0, 0.0), base[0]),
        ("cube", primitives::cube(0.9), at(0.6, 0.7, 0.3), base[1]),
        ("ball", primitives::sphere(0.5, 32, 48), at(-0.7, 0.5, 0.8), base[2]),
    ]);
    let mut opened = toon(&scene, vec3(0.4, 0.5, 1.0).as_dvec3(), "cartoon_map");
    for (key, value) in SETTINGS {
        set(&mut opened, key, value);
    }
    let drawn = drawn(&mut session(), &opened);
    let map = drawn.cartoon_map.unwrap();
    let unit = Bounds { min: DVec3::NEG_ONE, max: DVec3::ONE };
    let twin = Twin {
        view: View::new(&opened.document.camera.unwrap(), &unit, UVec2::splat(SIDE as u32)),
        light: opened.document.lighting.key.direction().as_vec3(),
        // As 8-bit colors, which is what the G-buffer holds.
        base: base.map(|c| Color(c.map(to_srgb)).to_linear()),
    };

    let (mut inside, mut smoothed, mut accents) = (0, 0, 0);
    for (i, s) in drawn.surfels.iter().enumerate() {
        let px = [i as i32 % SIDE, i as i32 / SIDE];
        if s.object == 0 {
            assert_eq!(map[i], 0);
            continue;
        }
        inside += 1;
        // The ramp, from the normals.
        let fields = twin.fields(px, s);
        let mut code = 1 + fields[0].floor().clamp(0.0, 3.0) as u16;
        code |= if fields[1] >= 0.0 { HIGHLIGHT } else { 0 } | if fields[2] >= 0.0 { RIM } else { 0 };
        let on_a_border =
            (fields[0] - fields[0].round()).abs().min(fields[1].abs()).min(fields[2].abs()) < 1e-4;
        assert!(code == map[i] || on_a_border, "{px:?}: {code} against {}, {fields:?}", map[i]);
        accents |= map[i] & (HIGHLIGHT | RIM);

        // Its mean, from the map.
        let own = twin.color(s.object, map[i]);
        let (mut mean, mut unsure) = (Vec3::ZERO, false);
        for (dx, dy) in (0..9).map(|n| (n % 3 - 1, n / 3 - 1)) {
            let other_px = [px[0] + dx, px[1] + dy].map(|c| c.clamp(0, SIDE - 1));
            let j = (other_px[1] * SIDE + other_px[0]) as usize;
            let other = &drawn.surfels[j];
            let mut color = own;
            if other.object == s.object && drawn.regions[i] == drawn.regions[j] {
                let miss = twin.miss(px, s, other_px, other).min(twin.miss(other_px, other, px, s));
                unsure |= (miss - 2.0).abs() < 0.05;
                if miss < 2.0 {
                    color = twin.color(s.object, map[j]);
                }
            }
            let weight = if dx == 0 && dy == 0 { 8 } else { (2 - dx.abs()) * (2 - dy.abs()) };
            mean += color * weight as f32 / 20.0;
        }
        smoothed += i32::from(mean.distance(own) > 0.01);
        let pixel = drawn.image.get_pixel(px[0] as u32, px[1] as u32).0;
        for (mine, theirs) in mean.to_array().map(to_srgb).into_iter().zip(pixel) {
            assert!(mine.abs_diff(theirs) <= 1 || unsure, "{px:?}: {mean} against {pixel:?}");
        }
    }
    assert!(
        inside > 5000 && smoothed > 500 && accents == HIGHLIGHT | RIM,
        "{inside} {smoothed} {accents}: nothing to see"
    );
}

fn ball() -> Arc<Scene> {
    scene(vec![("ball", primitives::sphere(1.0, 64, 96), DMat4::IDENTITY, [0.9, 0.6, 0.3])])
}

/// The colors of an object.
fn colors(drawn: &Drawn, object: u32) -> HashSet<[u8; 4]> {
    let pixels = drawn.image.pixels().zip(&drawn.surfels);
    pixels.filter(|(_, s)| s.object == object).map(|(p, _)| p.0).collect()
}

#[test]
fn a_ball_has_as_many_colors_as_bands_and_others_only_beside_their_borders() {
    let mut session = session();
    let ball = ball();
    for bands in 2..=8 {
        let mut with = |border: &str| {
            let mut opened = toon(&ball, DVec3::Z, border);
            set(&mut opened, "toon.bands", &bands.to_string());
            drawn(&mut session, &opened)
        };
        let nearest = with("nearest");
        let palette = colors(&nearest, 1);
        assert_eq!(palette.len(), bands);
        assert!(nearest.cartoon_map.is_none());
        for border in ["cartoon_map", "analytic"] {
            let smooth = with(border);
            assert_eq!(smooth.cartoon_map.is_some(), border == "cartoon_map");
            let mut between = 0;
            for (x, y, pixel) in smooth.image.enumerate_pixels() {
                let near = |dx: i32, dy: i32| {
                    let [x, y] = [x as i32 + dx, y as i32 + dy].map(|c| c.clamp(0, SIDE - 1));
                    (&nearest.surfels[(y * SIDE + x) as usize], *nearest.image.get_pixel(x as u32, y as u32))
                };
                let around = || (0..9).map(|n| near(n % 3 - 1, n / 3 - 1));
                // A border just beyond the outline reaches into it.
                if palette.contains(&pixel.0) || around().any(|(s, _)| s.object == 0) {
                    continue;
                }
                between += 1;
                let has_border = around().any(|(_, color)| color != near(0, 0).1);
                assert!(has_border, "{border}, {bands} bands: {pixel:?} at {x},{y} is beside no border");
            }
            assert!(between > 50, "{border}: nothing is smoothed");
        }
    }
}

#[test]
fn smoothed_borders_are_nearer_to_the_truth_than_nearest_ones() {
    let mut session = session();
    let ball = ball();
    session.set_samples(64);
    let truth = image(&mut session, &toon(&ball, DVec3::Z, "nearest"), SIDE as u32);
    session.set_samples(1);
    let mut error = |border: &str| {
        let drawn = drawn(&mut session, &toon(&ball, DVec3::Z, border));
        let inner = |i: usize| {
            let around = [0, 1, SIDE as usize].map(|d| [i.saturating_sub(d), i + d]);
            around.as_flattened().iter().all(|j| drawn.surfels.get(*j).is_some_and(|s| s.object != 0))
        };
        let pairs = drawn.image.pixels().zip(truth.pixels()).enumerate();
        pairs
            .filter(|(i, _)| inner(*i))
            .map(|(_, (a, b))| u32::from(a.0[0].abs_diff(b.0[0])).pow(2))
            .sum::<u32>()
    };
    let [nearest, cartoon_map, analytic] = ["nearest", "cartoon_map", "analytic"].map(&mut error);
    assert!(5 * cartoon_map < 4 * nearest && 10 * analytic < nearest, "{nearest} {cartoon_map} {analytic}");
}

#[test]
fn one_toons_parameters_change_no_pixel_of_another() {
    let mut session = session();
    let scene = scene(vec![
        ("a", primitives::sphere(1.0, 48, 64), at(0.0, 0.0, 0.0), [0.8, 0.4, 0.4]),
        ("b", primitives::sphere(0.7, 48, 64), at(0.8, 0.2, 0.4), [0.4, 0.4, 0.8]),
    ]);
    for border in ["nearest", "cartoon_map", "analytic"] {
        let before = toon(&scene, DVec3::new(0.1, 0.4, 1.0), border);
        let first = drawn(&mut session, &before);
        for (key, value) in [
            ("toon.bands", "7"),
            ("toon.shadow", "#ff0000"),
            ("toon.light", "#00ff00"),
            ("toon.start", "-0.5"),
            ("toon.object_color", "0"),
            ("toon.highlight", "1"),
            ("toon.rim", "1"),
            ("toon.smoothing", if border == "nearest" { "cartoon_map" } else { "nearest" }),
            ("technique", "gooch"),
        ] {
            let mut after = before.clone();
            after.document.set_for(&scene, &[0], key, &Value::parse(value)).unwrap();
            let second = drawn(&mut session, &after);
            let changed: HashSet<u32> = (first.image.pixels().zip(second.image.pixels()))
                .zip(&first.surfels)
                .filter(|((a, b), _)| a != b)
                .map(|(_, s)| s.object)
                .collect();
            assert_eq!(changed, HashSet::from([1]), "{border}, {key}");
        }
    }
}

/// A ramp as an image file's content.
fn ramp_image(colors: &[[u8; 3]]) -> Texture {
    let rgba: Vec<u8> = colors.iter().flat_map(|[r, g, b]| [*r, *g, *b, 255]).collect();
    Texture { name: "ramp".into(), width: colors.len() as u32, height: 1, rgba: rgba.into() }
}

#[test]
fn an_image_is_a_ramp_of_its_texels() {
    let mut session = session();
    let five = [[20, 20, 60], [60, 90, 160], [190, 100, 110], [240, 190, 130], [255, 255, 255]];
    let many: Vec<[u8; 3]> = (0..=255).map(|v| [v, 255 - v, 7]).collect();
    let images: Images = [
        ("five.png".into(), Arc::new(ramp_image(&five))),
        ("many.png".into(), Arc::new(ramp_image(&many))),
        ("one.png".into(), Arc::new(ramp_image(&[[9, 90, 200]]))),
    ]
    .into();
    session.renderer().set_images(hachure::render::StyleImages::new(images));
    let ball = ball();
    let mut with = |border: &str, image: &str| {
        let mut opened = toon(&ball, DVec3::Z, border);
        for (key, value) in [("toon.ramp", "image"), ("toon.image", image), ("toon.object_color", "0")] {
            set(&mut opened, key, value);
        }
        drawn(&mut session, &opened)
    };
    let palette = |drawn: &Drawn| -> HashSet<[u8; 3]> {
        colors(drawn, 1).into_iter().map(|[r, g, b, _]| [r, g, b]).collect()
    };
    for border in ["nearest", "cartoon_map", "analytic"] {
        assert_eq!(palette(&with(border, "one.png")), HashSet::from([[9, 90, 200]]), "{border}");
        // Nothing but the texels and what lies between two of them.
        let wide = with(border, "many.png");
        let shades = palette(&wide);
        assert!(shades.len() > 150, "{border}: {}", shades.len());
        assert!(
            shades
                .iter()
                .all(|[r, g, b]| (i32::from(*r) + i32::from(*g) - 255).abs() < 6 && b.abs_diff(7) <= 1)
        );
    }
    assert_eq!(palette(&with("nearest", "five.png")), five.into());
    // An image that is not there is drawn as bands.
    let missing = palette(&with("nearest", "missing.png"));
    assert_eq!(missing.len(), 3);
    assert!(missing.contains(&[255, 255, 255]));
}

#[test]
fn the_bands_that_a_pixel_touches_have_their_shares_in_it() {
    // The analytic border against its definition: the mean of the ramp over the pixel's footprint.
    let mut session = session();
    let texels: Vec<[u8; 3]> =
        (0..256_u32).map(|k| [(k * 83 % 256) as u8, (k * 151 % 256) as u8, k as u8]).collect();
    session.renderer().set_images(hachure::render::StyleImages::new(
        [("ramp.png".into(), Arc::new(ramp_image(&texels)))].into(),
    ));
    let mut opened = toon(&ball(), DVec3::Z, "analytic");
    for (key, value) in
        [("toon.ramp", "image"), ("toon.image", "ramp.png"), ("toon.object_color", "0"), ("toon.start", "-1")]
    {
        set(&mut opened, key, value);
    }
    let drawn = drawn(&mut session, &opened);
    let light = opened.document.lighting.key.direction().as_vec3();
    let place =
        |x: i32, y: i32| (drawn.surfels[(y * SIDE + x) as usize].normal.dot(light) + 1.0) * 0.5 * 256.0;
    let (mut compared, mut most) = (0, 0.0_f32);
    for y in SIDE / 4..3 * SIDE / 4 {
        for x in SIDE / 4..3 * SIDE / 4 {
            let dx = (place(x + 1, y) - place(x - 1, y)) * 0.5;
            let dy = (place(x, y + 1) - place(x, y - 1)) * 0.5;
            let width = dx.hypot(dy).max(1e-6);
            let (from, to) = (place(x, y) - width * 0.5, place(x, y) + width * 0.5);
            let share = |k: usize| {
                let start = if k == 0 { f32::MIN } else { k as f32 };
                let end = if k == 255 { f32::MAX } else { k as f32 + 1.0 };
                ((to.min(end) - from.max(start)) / width).max(0.0)
            };
            let mean: Vec3 = texels.iter().enumerate().map(|(k, c)| Color(*c).to_linear() * share(k)).sum();
            let pixel = drawn.image.get_pixel(x as u32, y as u32).0;
            for (mine, theirs) in mean.to_array().map(to_srgb).into_iter().zip(pixel) {
                assert!(mine.abs_diff(theirs) <= 3, "{x},{y}: {mean} against {pixel:?}");
            }
            compared += 1;
            most = most.max(width);
        }
    }
    assert!(compared > 5000 && most > 2.0, "{compared} {most}: no pixel touches more than two bands");
}
