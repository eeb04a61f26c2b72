//! CPU twins of the edge-enhancement paper's operators (section 4.1.2), written from the paper, fed the G-buffer that
//! the device made and compared with its values.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{Surfel, draw, ink, opened, scene, session, set, surfels, texels};
use glam::{DMat4, DVec3, Vec3, vec3};
use hachure::geometry::primitives;

const SIDE: i32 = 160;

#[derive(Clone, Copy)]
struct Sample {
    normal: Vec3,
    depth: f32,
    object: u32,
}

/// What the operators see of a neighbor of `x`.
fn neighbor(buffer: &[Surfel], px: [i32; 2], x: &Surfel, range: [f32; 2]) -> Sample {
    let [i, j] = px.map(|c| c.clamp(0, SIDE - 1));
    let s = &buffer[(j * SIDE + i) as usize];
    let scaled = |s: &Surfel| Sample {
        normal: s.normal,
        depth: ((s.depth - range[0]) / (range[1] - range[0])).clamp(0.0, 1.0),
        object: s.object,
    };
    if s.enhanced {
        scaled(s)
    } else if s.object != 0 && s.depth < x.depth {
        scaled(x)
    } else {
        Sample { normal: Vec3::Z, depth: 1.0, object: 0 }
    }
}

/// `I_N`, `I_Z` and C1 at a pixel, letter for letter.
fn operators(buffer: &[Surfel], px: [i32; 2], range: [f32; 2]) -> ([f32; 3], u32) {
    let x = &buffer[(px[1] * SIDE + px[0]) as usize];
    let at = |i: i32, j: i32| neighbor(buffer, [px[0] + i, px[1] + j], x, range);
    let [a, b, c] = [at(-1, -1), at(0, -1), at(1, -1)];
    let [d, center, e] = [at(-1, 0), at(0, 0), at(1, 0)];
    let [f, g, h] = [at(-1, 1), at(0, 1), at(1, 1)];
    let i_n = 0.5 * (a.normal.dot(h.normal) + c.normal.dot(f.normal));
    let i_z =
        (1.0 - 0.5 * (a.depth - h.depth).abs()).powi(2) * (1.0 - 0.5 * (c.depth - f.depth).abs()).powi(2);
    let z = center.depth;
    let c1 = [(a, 1.0), (b, 2.0), (c, 1.0), (d, 2.0), (e, 2.0), (f, 1.0), (g, 2.0), (h, 1.0)]
        .iter()
        .map(|(s, weight)| weight * (s.depth - z).abs())
        .sum::<f32>()
        / 8.0;
    let nearest = [a, c, f, h].iter().fold(center, |n, s| if s.depth < n.depth { *s } else { n });
    ([i_n, i_z, c1], nearest.object)
}

fn compare(towards_viewer: DVec3, orthographic: bool) {
    let at = |x, y, z| DMat4::from_translation(DVec3::new(x, y, z));
    let scene = scene(vec![
        ("torus", primitives::torus(1.0, 0.4, 48, 24), at(0.0, 0.0, 0.0), [0.8, 0.3, 0.2]),
        ("cube", primitives::cube(0.9), at(0.6, 0.7, 0.3), [0.3, 0.6, 0.8]),
        ("shy", primitives::sphere(0.5, 16, 24), at(-0.7, 0.5, 0.8), [0.5, 0.5, 0.5]),
    ]);
    let mut opened = opened(&scene, towards_viewer);
    opened.document.camera = opened.document.camera.map(|c| c.with_orthographic(orthographic));
    opened.document.node_mut("/shy").enhanced = Some(false);
    set(&mut opened, "edges.mode", "image_space");
    set(&mut opened, "view.show", "depth_operator");
    let mut session = session();
    let picture = draw(&mut session, &opened, SIDE as u32);
    let buffer = surfels(&mut session, &picture);

    // Near and far are fitted to the enhanced objects' boxes (section 4.1.1).
    let view_from_world = opened.document.camera.unwrap().view_from_world();
    let fitted = scene.nodes[..2]
        .iter()
        .map(|n| scene.meshes[n.mesh.unwrap()].bounds().transformed(&(view_from_world * n.world_from_local)))
        .reduce(|a, b| a.union(&b))
        .unwrap();
    let range = [-fitted.max.z as f32, -fitted.min.z as f32];

    let shown = common::captured(&mut session, "operators").unwrap();
    let values = texels::<[f32; 4]>(&mut session, &shown);
    let ink = ink(&mut session, &picture);
    let (mut enhanced, mut edges) = (0, 0);
    for (i, (surfel, value)) in buffer.iter().zip(&values).enumerate() {
        if !surfel.enhanced {
            assert_eq!(value[..3], [1.0, 1.0, 0.0], "what is not enhanced has no edges");
            assert_eq!(ink[i], (0.0, 0.0, 0));
            continue;
        }
        let px = [i as i32 % SIDE, i as i32 / SIDE];
        let (twin, owner) = operators(&buffer, px, range);
        for (mine, theirs) in twin.iter().zip(value) {
            assert!((mine - theirs).abs() < 2e-5, "{px:?}: {twin:?} against {value:?}");
        }
        enhanced += 1;
        // Ink: gain · (1 − I) past its threshold, with the default gains.
        let past = |ink: f32| ((ink - 0.2) / 0.8).clamp(0.0, 1.0);
        let expected = (past(4.0 * (1.0 - value[0])), past(10.3 * (1.0 - value[1])));
        assert!((ink[i].0 - expected.0).abs() < 1e-3 && (ink[i].1 - expected.1).abs() < 1e-3, "{px:?}");
        // Pixels without ink are nobody's; where it only just begins, a device may round it to either.
        let just_begins = expected.0.max(expected.1) < 1e-3;
        let owner = if ink[i].0 + ink[i].1 > 0.0 { owner } else { 0 };
        assert!(ink[i].2 == owner || just_begins, "{px:?}: {} against {owner}", ink[i].2);
        edges += i32::from(expected.1 > 0.5);
    }
    assert!(enhanced > 3000 && edges > 200, "{enhanced} {edges}: the scene shows nothing");
}

#[test]
fn operators_equal_their_twins_in_perspective() {
    compare(vec3(0.4, 0.5, 1.0).as_dvec3(), false);
}

#[test]
fn operators_equal_their_twins_in_parallel_projection() {
    compare(vec3(-0.8, 0.9, 0.6).as_dvec3(), true);
}

#[test]
fn a_step_of_a_tenth_of_the_depth_range_is_full_ink_with_either_operator() {
    // Two squares that face the eye, a tenth of the whole depth apart, and one far behind that sets the range.
    let at = |x, z| DMat4::from_translation(DVec3::new(x, 0.0, z));
    let scene = scene(vec![
        ("front", primitives::plane(2.0), at(-0.5, 0.0), [0.5; 3]),
        ("back", primitives::plane(2.0), at(0.5, -0.1), [0.5; 3]),
        ("far", primitives::plane(0.2), at(1.2, -1.0), [0.5; 3]),
    ]);
    for operator in ["diagonal", "c1"] {
        let mut opened = opened(&scene, DVec3::Z);
        opened.document.camera = opened.document.camera.map(|c| c.with_orthographic(true));
        set(&mut opened, "edges.mode", "image_space");
        set(&mut opened, "edges.operator", operator);
        let mut session = session();
        let picture = draw(&mut session, &opened, SIDE as u32);
        let buffer = surfels(&mut session, &picture);
        let ink = ink(&mut session, &picture);
        let row = (SIDE / 2 * SIDE) as usize;
        let step = (1..SIDE as usize).find(|i| {
            let (left, right) = (buffer[row + i - 1].object, buffer[row + i].object);
            left == 1 && right == 2
        });
        let (inner, profile, owner) = ink[row + step.unwrap() - 1];
        assert!(profile > 0.999, "{operator}: {profile}");
        assert_eq!((inner, owner), (0.0, 1), "{operator}: no crease there, and the line is the nearer one's");
    }
}

/// Gradients by Sobel operators, and whether the z of normals differs in sign (hatching paper, section 3, "Outline").
#[derive(Debug)]
struct Gradients {
    normal: f32,
    depth: f32,
    color: f32,
    turns: bool,
}

fn sobel(buffer: &[Surfel], colors: &[[u8; 4]], px: [i32; 2], range: [f32; 2], sums: bool) -> Gradients {
    const S_X: [[f32; 3]; 3] = [[-1.0, 0.0, 1.0], [-2.0, 0.0, 2.0], [-1.0, 0.0, 1.0]];
    const S_Y: [[f32; 3]; 3] = [[-1.0, -2.0, -1.0], [0.0, 0.0, 0.0], [1.0, 2.0, 1.0]];
    let x = &buffer[(px[1] * SIDE + px[0]) as usize];
    let images = |s: Sample, px: [i32; 2]| {
        let texel = colors[(px[1] * SIDE + px[0]) as usize];
        let bright = [0, 1, 2].map(|k| srgb_to_linear(f32::from(texel[k]) / 255.0));
        let luminance = 0.2126 * bright[0] + 0.7152 * bright[1] + 0.0722 * bright[2];
        let luminance = if s.object == 0 { 1.0 } else { luminance };
        [s.normal.x, s.normal.y, s.normal.z, s.depth, luminance]
    };
    let (mut along, mut down, mut signs) = ([0.0; 5], [0.0; 5], [0; 2]);
    for (j, i) in (0..3).flat_map(|j| (0..3).map(move |i| (j, i))) {
        let at = [px[0] + i as i32 - 1, px[1] + j as i32 - 1].map(|c: i32| c.clamp(0, SIDE - 1));
        let s = neighbor(buffer, at, x, range);
        for (k, value) in images(s, at).into_iter().enumerate() {
            along[k] += S_X[j][i] * value;
            down[k] += S_Y[j][i] * value;
        }
        signs[usize::from(s.object != 0 && s.normal.z >= 0.0)] += 1;
    }
    let length = |v: &[f32]| v.iter().map(|c| c * c).sum::<f32>().sqrt();
    let magnitude = |of: std::ops::Range<usize>| {
        let (x, y) = (length(&along[of.clone()]), length(&down[of]));
        if sums { x + y } else { (x * x + y * y).sqrt() }
    };
    Gradients {
        normal: magnitude(0..3),
        depth: magnitude(3..4),
        color: magnitude(4..5),
        turns: signs[0] > 0 && signs[1] > 0,
    }
}

fn srgb_to_linear(c: f32) -> f32 {
    if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}

#[test]
fn sobel_edges_equal_their_twins() {
    let at = |x, y, z| DMat4::from_translation(DVec3::new(x, y, z));
    let mut torus = primitives::torus(1.0, 0.4, 48, 24);
    // Half of it is dark.
    torus.colors =
        torus.positions.iter().map(|p| if p.x < 0.2 { [255; 4] } else { [9, 9, 9, 255] }).collect();
    let scene = scene(vec![
        ("torus", torus, at(0.0, 0.0, 0.0), [0.9, 0.9, 0.9]),
        ("cube", primitives::cube(0.9), at(0.6, 0.7, 0.3), [0.3, 0.6, 0.8]),
        ("dark", primitives::cube(0.5), at(-0.9, -0.2, 0.4), [0.02, 0.02, 0.02]),
    ]);
    for sums in [false, true] {
        let mut opened = opened(&scene, vec3(0.4, 0.5, 1.0).as_dvec3());
        for (key, value) in [
            ("edges.mode", "image_space"),
            ("edges.operator", "sobel"),
            ("edges.sobel.sum", if sums { "true" } else { "false" }),
            ("edges.sobel.depth_threshold", "0.3"),
        ] {
            set(&mut opened, key, value);
        }
        let mut session = session();
        session.renderer().capture("base color");
        let picture = draw(&mut session, &opened, SIDE as u32);
        let buffer = surfels(&mut session, &picture);
        let shown = common::captured(&mut session, "base color").unwrap();
        let colors = texels::<[u8; 4]>(&mut session, &shown);
        let ink = ink(&mut session, &picture);
        let range = opened_range(&scene, &opened);
        let (mut profile_count, mut by_color, mut by_normal) = (0, 0, 0);
        for (i, surfel) in buffer.iter().enumerate() {
            let px = [i as i32 % SIDE, i as i32 / SIDE];
            let g = sobel(&buffer, &colors, px, range, sums);
            // On the threshold itself rounding decides, of colors that of the device's conversion to linear ones.
            let is_close = |value: f32, threshold: f32, by: f32| (value - threshold).abs() < by;
            if is_close(g.normal, 1.4, 2e-3) || is_close(g.depth, 0.3, 2e-3) || is_close(g.color, 0.6, 0.01) {
                continue;
            }
            let profile = surfel.enhanced && (g.turns || g.depth >= 0.3);
            let inner = surfel.enhanced && !profile && (g.normal >= 1.4 || g.color >= 0.6);
            let expected = (f32::from(u8::from(inner)), f32::from(u8::from(profile)));
            assert_eq!((ink[i].0, ink[i].1), expected, "{px:?}, sums: {sums}: {g:?}");
            profile_count += i32::from(profile);
            by_normal += i32::from(inner && g.color < 0.6);
            by_color += i32::from(inner && g.normal < 1.4);
        }
        assert!(
            profile_count > 500 && by_normal > 50 && by_color > 5,
            "{profile_count} {by_normal} {by_color}"
        );
    }
}

/// Near and far of everything, as fitted to the boxes of the objects (section 4.1.1).
fn opened_range(scene: &hachure::scene::Scene, opened: &hachure::export::session::Opened) -> [f32; 2] {
    let view_from_world = opened.document.camera.unwrap().view_from_world();
    let boxes = scene
        .nodes
        .iter()
        .map(|n| scene.meshes[n.mesh.unwrap()].bounds().transformed(&(view_from_world * n.world_from_local)));
    let fitted = boxes.reduce(|a, b| a.union(&b)).unwrap();
    [-fitted.max.z as f32, -fitted.min.z as f32]
}
