//! The formulas of the paper "Sketchy Drawings" beside plain twins: what is drawn at a pixel is fetched from beside it, as a tile
//! of noise and a matrix say (section 3.2), and the nearest depth of all that is fetched counts (section 3.3).

use glam::{DVec3, Vec2};
use hachure::export::session::Opened;
use hachure::geometry::primitives;
use hachure::render::base::noise::{SIDE as TILE, TILE_CELLS, turbulence_tile};
use hachure::render::base::view::REFERENCE_HEIGHT;
use hachure::style::sketch::{Anchor, Noise, SketchDepth};
use hachure::style::{EdgeMode, Matrix, Sketch, Style};
use image::RgbaImage;

use super::common;
use super::rays::cast;
use super::{alone, at, set_style, style, turned};

const SIDE: u32 = 240;

/// Where fetches come from, written from the paper.
struct Twin {
    tile: Vec<[f32; 2]>,
    /// Pixels per reference pixel.
    scale: f32,
    amount: f32,
}

impl Twin {
    fn new(sketch: &Sketch) -> Self {
        let wander = &sketch.wander;
        let tile = turbulence_tile(wander.octaves, wander.seed, wander.noise == Noise::Turbulence);
        Self { tile, scale: SIDE as f32 / REFERENCE_HEIGHT as f32, amount: wander.amount }
    }

    /// The pixel that is fetched at another one; `wave`: reference pixels.
    fn source(&self, [x, y]: [u32; 2], matrix: Matrix, wave: f32) -> [u32; 2] {
        let at = Vec2::new(x as f32, y as f32) + 0.5;
        let place = (at / (TILE_CELLS as f32 * wave * self.scale)).fract() * TILE as f32;
        let [s, t] = self.tile[place.y as usize * TILE + place.x as usize];
        let Matrix([[a, b], [c, d]]) = matrix;
        let offset = Vec2::new(a * s + b * t, c * s + d * t) * self.amount * self.scale;
        let source = (at + offset).clamp(Vec2::splat(0.5), Vec2::splat(SIDE as f32 - 0.5));
        source.floor().as_uvec2().to_array()
    }
}

/// Noise that stays on the picture moves lines and colors so far.
fn on_screen(mut style: Style, lines: f32, fill: f32) -> Style {
    style.sketch.enabled = true;
    style.sketch.wander.anchor = Anchor::Screen;
    style.sketch.wander.wave = 150.0;
    style.sketch.fill.wave = 110.0;
    style.sketch.pass[0].matrix = turned(lines);
    style.sketch.fill.matrix = turned(fill);
    style
}

fn without_lines(mut style: Style) -> Style {
    (style.edges.profile.show, style.edges.inner.show) = (false, false);
    style
}

fn things() -> Opened {
    let turn = glam::DMat4::from_rotation_x(0.5) * glam::DMat4::from_rotation_y(0.6);
    let scene = common::scene(vec![
        ("box", primitives::cube(1.2), at(-0.6, 0.2, 0.0) * turn, [0.8, 0.5, 0.3]),
        ("ball", primitives::sphere(0.8, 14, 24), at(0.6, 0.1, 0.1), [0.4, 0.6, 0.8]),
    ]);
    common::opened(&scene, DVec3::new(0.3, 0.4, 1.0))
}

/// How many pixels of a sketch are not what its twin fetches from the plain picture; `reach`: pixels around that are blended.
fn wrong(plain: &RgbaImage, sketched: &RgbaImage, reach: u32, fetch: impl Fn([u32; 2]) -> [u32; 2]) -> usize {
    let is_wrong = |(x, y, pixel): &(u32, u32, &image::Rgba<u8>)| {
        let [from_x, from_y] = fetch([*x, *y]);
        (0..4).any(|channel| {
            let around = |at: u32| at.saturating_sub(reach)..=(at + reach).min(SIDE - 1);
            let from = around(from_y).flat_map(|y| around(from_x).map(move |x| (x, y)));
            let values = from.map(|(x, y)| plain.get_pixel(x, y).0[channel]);
            let (least, most) = values.fold((255, 0), |(least, most), v| (v.min(least), v.max(most)));
            !(least.saturating_sub(1)..=most.saturating_add(1)).contains(&pixel.0[channel])
        })
    };
    sketched.enumerate_pixels().filter(is_wrong).count()
}

/// One pixel in a thousand may lie on the border of two texels.
const MOST: usize = (SIDE * SIDE / 1000) as usize;

#[test]
fn colors_are_fetched_from_beside_as_the_paper_says() {
    let mut session = common::session();
    let mut opened = things();
    session.set_scene(&opened).unwrap();
    for noise in [Noise::Smooth, Noise::Turbulence] {
        let mut style = on_screen(without_lines(style("gooch")), 12.0, 24.0);
        style.sketch.wander.noise = noise;
        let twin = Twin::new(&style.sketch);
        opened.document.style = style.clone();
        let sketched = alone(&mut session, &opened, SIDE, |_| true);
        opened.document.style.sketch.enabled = false;
        let plain = alone(&mut session, &opened, SIDE, |_| true);
        let fill = &style.sketch.fill;
        let missed = wrong(&plain, &sketched, 1, |px| twin.source(px, fill.matrix, fill.wave));
        println!("{missed} pixels are not as fetched");
        assert!(missed <= MOST, "{noise:?}: {missed}");
        // Another matrix is another picture.
        assert!(wrong(&plain, &sketched, 1, |px| twin.source(px, turned(-24.0), fill.wave)) > 10 * MOST);
    }
}

#[test]
fn ink_of_the_papers_operators_is_fetched_from_beside_as_the_paper_says() {
    let mut session = common::session();
    let mut opened = things();
    session.set_scene(&opened).unwrap();
    let mut style = on_screen(style("blank"), 24.0, 0.0);
    style.edges.mode = EdgeMode::ImageSpace;
    style.sketch.fill.show = false;
    let twin = Twin::new(&style.sketch);
    opened.document.style = style.clone();
    let sketched = alone(&mut session, &opened, SIDE, |_| true);
    opened.document.style.sketch.enabled = false;
    let plain = alone(&mut session, &opened, SIDE, |_| true);
    assert!(plain.pixels().filter(|pixel| pixel.0[3] > 128).count() > 400, "hardly any ink");
    let matrix = style.sketch.pass[0].matrix;
    let missed = wrong(&plain, &sketched, 0, |px| twin.source(px, matrix, style.sketch.wander.wave));
    println!("{missed} pixels are not as fetched");
    assert!(missed <= MOST, "{missed}");
}

#[test]
fn the_nearest_depth_of_all_fetches_counts() {
    let mut session = common::session();
    let (ball, other) = (0, 1);
    // Where the one comes out of the other both are about as deep.
    let scene = common::scene(vec![
        ("ball", primitives::sphere(0.9, 24, 48), glam::DMat4::IDENTITY, [0.9, 0.1, 0.1]),
        ("other", primitives::sphere(0.9, 24, 48), at(0.3, 0.1, 0.0), [0.1, 0.8, 0.1]),
    ]);
    let mut opened = common::opened(&scene, DVec3::Z);
    session.set_scene(&opened).unwrap();
    set_style(&mut opened, other, &without_lines(style("unlit")));
    let mut sketch = on_screen(without_lines(style("unlit")), 40.0, 30.0);
    sketch.sketch.wander.depth = SketchDepth::Nearer;
    set_style(&mut opened, ball, &sketch);
    let picture = alone(&mut session, &opened, SIDE, |_| true);
    let [ball_depth, other_depth] = [ball, other].map(|node| cast(&opened, SIDE, &[node]));
    let twin = Twin::new(&sketch.sketch);
    let depth_at = |[x, y]: [u32; 2]| ball_depth[(y * SIDE + x) as usize];
    let (mut missed, mut told_apart) = (0, 0);
    for (x, y, pixel) in picture.enumerate_pixels() {
        let of_fill = depth_at(twin.source([x, y], sketch.sketch.fill.matrix, sketch.sketch.fill.wave));
        let of_ink = depth_at(twin.source([x, y], sketch.sketch.pass[0].matrix, sketch.sketch.wander.wave));
        let other = other_depth[(y * SIDE + x) as usize];
        // Color is there where it is fetched from the ball, with the nearer depth of both fetches.
        let is_ball = of_fill.is_finite() && of_fill.min(of_ink) < other;
        missed += usize::from((pixel.0[0] > pixel.0[1]) != is_ball);
        told_apart += usize::from(is_ball != (of_fill.is_finite() && of_fill < other));
    }
    println!("{missed} pixels are wrong, {told_apart} tell the rules apart");
    assert!(told_apart > 10 * MOST, "{told_apart}");
    assert!(missed <= 3 * MOST, "{missed}");
}
