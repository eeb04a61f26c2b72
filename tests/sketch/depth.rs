//! What hides what, in random scenes: truth comes from cast rays.

use std::sync::Arc;

use glam::{DMat4, DQuat, DVec3};
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::{Mesh, primitives};
use hachure::scene::{AlphaMode, NodeId};
use hachure::style::sketch::{Anchor, MAX_PASSES, Noise, SketchDepth};
use hachure::style::{Color, Matrix, Style};

use super::common;
use super::random::Random;
use super::rays::{around, cast, step_px};
use super::{alone, apart, at, drawn, is_other, seen_from, set_style, style, surface_techniques};

const SIDE: u32 = 160;
const SKETCH: NodeId = 0;

/// Where the sketch lies.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Layout {
    /// Behind a wall that covers all of it.
    BehindWall,
    /// Before everything else.
    InFront,
    /// A near pillar covers a part of it; others lie anywhere.
    Among,
}

/// A random scene.
struct Scenario {
    opened: Opened,
    /// Nothing of the sketch is drawn farther from where it belongs, px.
    reach: f64,
    /// What others hide with.
    opaque: Vec<NodeId>,
}

fn shape(random: &mut Random) -> Mesh {
    match random.below(3) {
        0 => primitives::cube(1.1),
        1 => primitives::sphere(0.7, 10, 18),
        _ => primitives::torus(0.6, 0.22, 18, 8),
    }
}

fn turn(random: &mut Random) -> DMat4 {
    let mut angle = || random.within(-3.0, 3.0);
    DMat4::from_quat(DQuat::from_rotation_y(angle()) * DQuat::from_rotation_x(angle()))
}

/// A sketch, and how far anything of it is off at most, px.
fn random_sketch(random: &mut Random) -> (Style, f64) {
    let mut style = style(random.one_of(&surface_techniques()));
    let sketch = &mut style.sketch;
    sketch.enabled = true;
    sketch.wander.amount = random.within(0.3, 2.0) as f32;
    sketch.wander.anchor = random.one_of(&[Anchor::Surface, Anchor::Screen, Anchor::Normal]);
    sketch.wander.noise = random.one_of(&[Noise::Smooth, Noise::Turbulence]);
    sketch.wander.seed = random.below(1000) as u32;
    sketch.wander.pressure = random.within(0.0, 0.6) as f32;
    sketch.passes = 1 + random.below(3) as u32;
    let matrix = |random: &mut Random| {
        let most = random.within(1.0, 10.0);
        Matrix::of_numbers([0; 4].map(|_| random.within(-most, most) as f32))
    };
    for pass in &mut sketch.pass {
        pass.matrix = matrix(random);
        pass.color = random.chance(0.3).then_some(Color([200, 30, 30]));
        pass.relative_width = random.within(0.6, 1.6) as f32;
    }
    sketch.fill.show = random.chance(0.75);
    sketch.fill.matrix = matrix(random);
    if random.chance(0.3) {
        sketch.grain.roughness = 2.0;
        sketch.grain.amount = 0.5;
    }
    let count = (sketch.passes as usize).min(MAX_PASSES);
    let matrices = sketch.pass[..count].iter().map(|pass| pass.matrix).chain([sketch.fill.matrix]);
    let rms = f64::from(matrices.map(Matrix::rms).fold(0.0, f32::max) * sketch.wander.amount);
    let widest = 0.5 * 1.6 * f64::from(style.edges.profile.width);
    // Noise of so many times its mean is as good as none; both coordinates count.
    let reference = 4.5 * rms + 2.0 * f64::from(style.sketch.grain.roughness) + widest;
    (style, reference * f64::from(SIDE) / 1080.0 + 2.0)
}

fn scenario(layout: Layout, random: &mut Random) -> Scenario {
    let mut objects = vec![("sketch".to_owned(), shape(random), DMat4::IDENTITY)];
    let z = if layout == Layout::InFront { 2.6 } else { random.within(-0.6, 0.6) };
    objects[0].2 = at(random.within(-0.3, 0.3), random.within(-0.3, 0.3), z) * turn(random);
    // So that the range of depths is the same with and without the sketch.
    objects.push(("back".to_owned(), primitives::plane(14.0), at(0.0, 0.0, -5.0)));
    objects.push(("speck".to_owned(), primitives::cube(0.01), at(2.6, 2.6, 4.6)));
    match layout {
        Layout::BehindWall => objects.push(("wall".to_owned(), primitives::plane(6.0), at(0.0, 0.0, 3.4))),
        Layout::Among => {
            let beside = random.within(-0.5, 0.5);
            let size = DMat4::from_scale(DVec3::new(0.4, 5.0, 0.3));
            let pillar = at(beside, 0.0, 3.0) * DMat4::from_rotation_y(random.within(0.0, 1.5)) * size;
            objects.push(("pillar".to_owned(), primitives::cube(1.0), pillar));
        }
        Layout::InFront => {}
    }
    for i in 0..3 {
        let z = if layout == Layout::InFront { random.within(-3.0, 0.0) } else { random.within(-2.5, 2.2) };
        let place = at(random.within(-1.2, 1.2), random.within(-1.2, 1.2), z) * turn(random);
        objects.push((format!("other {i}"), shape(random), place));
    }
    let colors = [[0.8, 0.5, 0.3], [0.9; 3], [0.2; 3], [0.4, 0.6, 0.8], [0.5, 0.8, 0.4], [0.7, 0.4, 0.7]];
    let named = objects.iter().enumerate();
    let named = named.map(|(i, (name, mesh, place))| (name.as_str(), mesh.clone(), *place, colors[i % 6]));
    let mut scene = Arc::unwrap_or_clone(common::scene(named.collect()));
    let is_pillar = |node: NodeId| matches!(objects[node].0.as_str(), "back" | "speck" | "wall" | "pillar");
    let (sketch, reach) = random_sketch(random);
    let mut styles = vec![sketch];
    let mut opaque = Vec::new();
    for node in 1..objects.len() {
        let technique = if node < 3 { "unlit" } else { random.one_of(&surface_techniques()) };
        let mut other = style(technique);
        match random.below(4) {
            0 if !is_pillar(node) => other = style("blueprint"),
            1 if !is_pillar(node) => {
                scene.materials[node].base_color.w = 0.4;
                scene.materials[node].alpha = AlphaMode::Blend;
            }
            _ => opaque.push(node),
        }
        styles.push(other);
    }
    let mut opened = common::opened(&Arc::new(scene), DVec3::Z);
    let eye = DVec3::new(random.within(-0.8, 0.8), random.within(-0.8, 0.8), 9.0);
    let mut camera = seen_from(eye, DVec3::ZERO);
    if random.chance(0.4) {
        camera = camera.with_orthographic(true);
    }
    opened.document.camera = Some(camera);
    for (node, style) in styles.iter().enumerate() {
        set_style(&mut opened, node, style);
    }
    Scenario { opened, reach, opaque }
}

/// How much farther a surface is one pixel on, in pixels' widths.
fn slope(opened: &Opened, depths: &[f64], px: usize) -> f64 {
    let side = SIDE as usize;
    let step = |by: isize| {
        let other = px.checked_add_signed(by).and_then(|q| depths.get(q)).copied().unwrap_or(f64::INFINITY);
        step_px(opened, SIDE, depths[px], other).abs()
    };
    // On one side of a pixel its surface goes on, as a rule.
    let along = |by: isize| step(by).min(step(-by));
    along(1).hypot(along(side as isize))
}

/// How many pixels were compared.
#[derive(Debug, Default)]
struct Compared {
    hidden: usize,
    shown: usize,
}

/// Compares the picture of a scene with those with nothing but the sketch and without it.
fn check(session: &mut Session, layout: Layout, scenario: &Scenario, compared: &mut Compared) -> Vec<String> {
    let Scenario { opened, reach, opaque } = scenario;
    session.set_scene(opened).unwrap();
    let all = drawn(session, opened, SIDE, |_| true);
    let without = drawn(session, opened, SIDE, |node| node != SKETCH);
    let only = alone(session, opened, SIDE, |node| node == SKETCH);
    let is_wandering_far = reach.ceil() as usize;
    let sketch = cast(opened, SIDE, &[SKETCH]);
    let nearest = around(&sketch, SIDE, is_wandering_far, f64::min);
    let depth = |far: f64| if far == f64::INFINITY { f64::NEG_INFINITY } else { far };
    let farthest: Vec<f64> = sketch.iter().copied().map(depth).collect();
    let farthest = around(&farthest, SIDE, is_wandering_far, f64::max);
    let hiding = cast(opened, SIDE, opaque);
    let others: Vec<NodeId> = (1..opened.scene.nodes.len()).collect();
    // Others have lines that are a little wider than themselves.
    let others = around(&cast(opened, SIDE, &others), SIDE, 2, f64::min);
    let (from_without, from_alone) = (apart(&all, &without), apart(&all, &only));
    // Black over white shows the least share of it that is missing.
    let is_other = is_other(&all, &only, 0.005);
    let mut wrong = Vec::new();
    let mut worst = [(0, 0, 0_u8); 2];
    for px in 0..all.pixels().len() {
        let steep = slope(opened, &hiding, px).clamp(4.0, 9.5);
        if step_px(opened, SIDE, hiding[px], nearest[px]) > steep * reach {
            compared.hidden += usize::from(nearest[px].is_finite());
            // Where there are sketches, other lines are laid over the picture with other roundings.
            if from_without[px] > if layout == Layout::BehindWall { 0 } else { 2 } {
                worst[0] = (worst[0].0 + 1, px, worst[0].2.max(from_without[px]));
            }
        }
        let is_opaque = only.as_raw()[4 * px + 3] == 255;
        if is_opaque && step_px(opened, SIDE, farthest[px], others[px]) > 0.0 {
            compared.shown += 1;
            if is_other[px] {
                worst[1] = (worst[1].0 + 1, px, worst[1].2.max(from_alone[px]));
            }
        }
    }
    for (what, (count, px, most)) in
        ["comes through what is nearer", "is hidden by what is farther"].iter().zip(worst)
    {
        if count > 0 {
            let at = (px as u32 % SIDE, px as u32 / SIDE);
            wrong.push(format!("a sketch {what} in {count} pixels, by {most}, at {at:?}"));
        }
    }
    wrong
}

/// Scenes of each of these layouts, with their sketches changed.
fn check_all(
    session: &mut Session,
    layout: Layout,
    seeds: std::ops::Range<u64>,
    change: impl Fn(&mut Style),
) -> Compared {
    let mut compared = Compared::default();
    let mut wrong = Vec::new();
    let only: Option<u64> = std::env::var("HACHURE_SKETCH_SEED").ok().and_then(|seed| seed.parse().ok());
    for seed in seeds.filter(|seed| only.is_none_or(|only| only == *seed)) {
        let mut scenario = scenario(layout, &mut Random::new(seed));
        let mut style = scenario.opened.document.node_mut("/sketch").style.clone().unwrap();
        change(&mut style);
        set_style(&mut scenario.opened, SKETCH, &style);
        let found = check(session, layout, &scenario, &mut compared);
        wrong.extend(found.into_iter().map(|what| format!("{layout:?}, seed {seed}: {what}")));
    }
    println!("{layout:?}: {compared:?}");
    assert!(wrong.is_empty() || only.is_some(), "{}", wrong.join("\n"));
    compared
}

#[test]
fn what_hides_what_is_right_with_sketches_in_a_hundred_scenes() {
    let mut session = common::session();
    let behind = check_all(&mut session, Layout::BehindWall, 0..32, |_| {});
    assert!(behind.hidden > 32 * 1000, "{behind:?}");
    let in_front = check_all(&mut session, Layout::InFront, 100..132, |_| {});
    assert!(in_front.shown > 32 * 250, "{in_front:?}");
    let among = check_all(&mut session, Layout::Among, 200..236, |_| {});
    assert!(among.hidden > 36 * 500, "{among:?}");
}

#[test]
fn the_papers_rule_of_depth_lets_nothing_through_a_wall_either() {
    let mut session = common::session();
    let behind = check_all(&mut session, Layout::BehindWall, 302..308, |style| {
        style.sketch.wander.depth = SketchDepth::Nearer;
    });
    assert!(behind.hidden > 6 * 1000, "{behind:?}");
}
