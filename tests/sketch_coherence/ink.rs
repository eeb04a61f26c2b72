//! How much ink changes from picture to picture, where it goes with the model.
//!
//! Ink of two pictures is blurred by a pixel, or antialiasing is all that is measured, and compared where the exact motion of the
//! nearest place on a line leads to: where that is seen in both pictures and all lines around move as it does. Even ink whose offsets
//! never change does change there. How much is said by a locked run: undisturbed ink of both pictures, moved by the offsets that the
//! device gave the lines in the first one. It is moved here as the shader does it, y = x + F(y) with F of the nearest line. Moved in
//! the same way by the offsets of each picture itself, ink says how much of the rest is offsets; what is left then is how evenly the
//! device draws what it fetches from between its pixels. Where surfaces run through each other is counted apart.

use std::sync::Arc;

use glam::{DVec2, Vec2};
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::render::passes::offset_field::FieldUniform;
use hachure::scene::Camera;
use rayon::prelude::*;

use super::common::line_drawing::{Ink, line_drawing, set_width};
use super::common::{session, set};
use super::drawn::{Drawn, NOISE};
use super::model::{Anchor, Eye, Model, SIDE};

/// From noise to offsets, px.
const MATRIX: [[f32; 2]; 2] = [[2.0, 0.4], [-0.4, 2.0]];
/// How wide lines are, px.
const WIDTH: f64 = 2.2;
/// So far from a line, px, is looked for its ink.
const BAND: i32 = 8;
/// So far is a line looked for.
const REACH: i32 = 12;
/// Lines whose motions differ by less, px, from what the zoom makes of them move alike.
const ALIKE: f64 = 1.0;
/// A change of so much pops.
const POP: f32 = 0.25;

/// Who says where ink goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Moved {
    Not,
    BySurface,
    ByScreen,
}

/// What is compared: surface, screen, locked, and what is moved here by the offsets that the device gave the surface.
const RUNS: usize = 4;

/// What changed, by run.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Changes {
    change: [f64; RUNS],
    pops: [f64; RUNS],
    ink: [f64; RUNS],
    count: f64,
}

impl Changes {
    fn error(&self, run: usize) -> f64 {
        self.change[run] / self.count
    }

    /// 1: changes as what is locked to the lines does, 0: as much as what stays on the paper; `None`: nothing moves.
    pub(crate) fn coherence(&self) -> Option<f64> {
        self.coherence_of(0)
    }

    /// The same of the offsets alone, whatever the device makes of them.
    pub(crate) fn coherence_of_offsets(&self) -> Option<f64> {
        self.coherence_of(3)
    }

    fn coherence_of(&self, run: usize) -> Option<f64> {
        let [screen, locked] = [1, 2].map(|run| self.error(run));
        (screen - locked > 1e-6).then(|| 1.0 - (self.error(run) - locked) / (screen - locked))
    }

    /// Mean changes of surface, screen and locked run.
    pub(crate) fn errors(&self) -> [f64; RUNS] {
        std::array::from_fn(|run| self.error(run))
    }

    /// Share of the pixels with ink that pop, by run.
    pub(crate) fn pops(&self) -> [f64; RUNS] {
        std::array::from_fn(|run| self.pops[run] / self.ink[run])
    }

    fn add(&mut self, run: usize, before: f32, after: f32) {
        let change = (after - before).abs();
        self.change[run] += f64::from(change);
        self.ink[run] += f64::from(u8::from(before.max(after) > POP));
        self.pops[run] += f64::from(u8::from(change > POP));
    }

    pub(crate) fn plus(mut self, other: &Self) -> Self {
        for run in 0..RUNS {
            self.change[run] += other.change[run];
            self.pops[run] += other.pops[run];
            self.ink[run] += other.ink[run];
        }
        self.count += other.count;
        self
    }

    /// Pixels that were compared.
    pub(crate) fn count(&self) -> f64 {
        self.count
    }
}

/// Lines only, each drawn once, evenly.
fn drawing(model: &Model, moved: Moved, wave: f32, side: u32) -> Opened {
    let mut opened = line_drawing(&model.opened.scene, model.camera());
    set_width(&mut opened, WIDTH, side);
    let [a, b] = MATRIX;
    if moved != Moved::Not {
        set(&mut opened, "sketch.enabled", "true");
        set(&mut opened, "sketch.fill.show", "false");
        set(&mut opened, "sketch.wave", &format!("{wave}"));
        set(&mut opened, "sketch.pass1.matrix", &format!("{},{},{},{}", a[0], a[1], b[0], b[1]));
    }
    if moved == Moved::ByScreen {
        set(&mut opened, "sketch.anchor", "screen");
    }
    opened
}

/// A picture and where its lines are.
pub(crate) struct Frame {
    drawn: Drawn,
    anchors: Vec<Anchor>,
    /// The nearest of them, by pixel.
    nearest: Vec<Option<u32>>,
    /// The noise of its lines.
    field: FieldUniform,
    /// Undisturbed, by the surface, by the screen.
    ink: [Ink; 3],
}

/// Whoever draws a model in one way.
pub(crate) struct Draftsman {
    session: Session,
    opened: Opened,
}

impl Draftsman {
    /// One for each way: undisturbed, by the surface, by the screen.
    pub(crate) fn all(model: &Model, wave: f32) -> [Self; 3] {
        [Moved::Not, Moved::BySurface, Moved::ByScreen].map(|moved| Self::new(model, moved, wave, SIDE))
    }

    fn new(model: &Model, moved: Moved, wave: f32, side: u32) -> Self {
        let opened = drawing(model, moved, wave, side);
        let mut session = session();
        session.renderer().capture(NOISE);
        session.set_scene(&opened).unwrap();
        Self { session, opened }
    }

    fn draw(&mut self, eye: &Eye, wave_scale: f32) -> Ink {
        self.opened.document.camera = Some(eye.camera);
        let document = self.opened.document.with_wave_scale(wave_scale).into_owned();
        let opened = Opened { document, scene: Arc::clone(&self.opened.scene) };
        Ink::of(&mut self.session, &opened, [eye.side; 2])
    }
}

/// What the device finds in a small picture of a model, px, from each of these cameras.
pub(crate) fn drawn_small(
    session: &mut Session,
    model: &Model,
    wave: f32,
    (cameras, side): (&[Camera], u32),
) -> Vec<Drawn> {
    let [mut plain, mut by_surface] =
        [Moved::Not, Moved::BySurface].map(|moved| Draftsman::new(model, moved, wave, side));
    let drawn = |camera: &Camera| {
        let eye = Eye::new(session, *camera, side);
        let _ink = [&mut plain, &mut by_surface].map(|draftsman| draftsman.draw(&eye, 1.0));
        Drawn::new(&mut plain.session, &mut by_surface.session, eye)
    };
    cameras.iter().map(drawn).collect()
}

/// The waves of a picture.
#[derive(Clone, Copy)]
pub(crate) struct Waves<'a> {
    /// As long as they are to be.
    pub(crate) field: &'a FieldUniform,
    /// How much longer they are.
    pub(crate) wave_scale: f32,
}

/// Draws a picture in all ways.
pub(crate) fn frame(draftsmen: &mut [Draftsman; 3], model: &Model, eye: Eye, waves: Waves<'_>) -> Frame {
    let Waves { field, wave_scale } = waves;
    let anchors = model.anchors(&eye, 0.5);
    let ink = draftsmen.each_mut().map(|draftsman| draftsman.draw(&eye, wave_scale));
    let [plain, by_surface, _] = draftsmen;
    let drawn = Drawn::new(&mut plain.session, &mut by_surface.session, eye);
    let field = FieldUniform { line_wave: wave_scale * field.line_wave, ..*field };
    Frame { nearest: nearest(&anchors), anchors, field, drawn, ink }
}

fn nearest(anchors: &[Anchor]) -> Vec<Option<u32>> {
    let side = SIDE as i32;
    let mut found = vec![(f64::INFINITY, None); (side * side) as usize];
    for (number, anchor) in (0..).zip(anchors) {
        let [x, y] = [anchor.pixel.x, anchor.pixel.y].map(|c| c.floor() as i32);
        for v in (y - REACH).max(0)..(y + REACH + 1).min(side) {
            for u in (x - REACH).max(0)..(x + REACH + 1).min(side) {
                let apart = anchor.pixel.distance(DVec2::new(f64::from(u), f64::from(v)) + 0.5);
                let best = &mut found[(v * side + u) as usize];
                if apart < best.0 && apart < f64::from(REACH) {
                    *best = (apart, Some(number));
                }
            }
        }
    }
    found.into_iter().map(|(_, number)| number).collect()
}

impl Frame {
    fn nearest(&self, at: DVec2) -> Option<u32> {
        let cell = at.floor();
        let side = f64::from(SIDE);
        let is_inside = cell.min_element() >= 0.0 && cell.max_element() < side;
        if is_inside { self.nearest[(cell.y * side + cell.x) as usize] } else { None }
    }

    /// A place on a line that is so near that its ink can be here.
    fn line_near(&self, at: DVec2) -> Option<usize> {
        let number = self.nearest(at)? as usize;
        (self.anchors[number].pixel.distance(at) < f64::from(BAND)).then_some(number)
    }

    /// Undisturbed ink moved by the offsets that its lines have in a picture, which are compared with those in another one.
    fn moved(&self, by: &Self, other: &Self) -> Ink {
        let offsets: Vec<DVec2> = self
            .anchors
            .par_iter()
            .map(|anchor| {
                let twin = || {
                    let spot = by.drawn.eye.seen_or_not(anchor.world, anchor.along)?;
                    Some(by.field.line_noise(by.drawn.eye.object(anchor.object), &spot.place, 0))
                };
                // Where it has no pixel for it, the other one speaks for both, or the twin.
                let found = by.drawn.noise(anchor).or_else(|| other.drawn.noise(anchor));
                let noise = found.or_else(twin).unwrap_or_default();
                let row = |row: [f32; 2]| f64::from(Vec2::from(row).dot(noise));
                DVec2::new(row(MATRIX[0]), row(MATRIX[1]))
            })
            .collect();
        let values = (0..SIDE * SIDE).into_par_iter().map(|i| {
            let x = DVec2::new(f64::from(i % SIDE), f64::from(i / SIDE)) + 0.5;
            let mut y = x;
            for _ in 0..3 {
                y = x + self.nearest(y).map_or(DVec2::ZERO, |number| offsets[number as usize]);
            }
            self.ink[0].sampled(y)
        });
        Ink { size: [SIDE; 2], values: values.collect() }
    }
}

/// What changes between two pictures, apart from where surfaces run through each other, and there.
pub(crate) fn compare(before: &Frame, after: &Frame) -> [Changes; 2] {
    let locked = [before, after].map(|frame| blurred(&frame.moved(before, after)));
    let moved = [locked[0].clone(), blurred(&after.moved(after, before))];
    let drawn = [1, 2].map(|run| [before, after].map(|frame| blurred(&frame.ink[run])));
    let [surface, screen] = &drawn;
    let motions = motions(before, after);
    let is_known: Vec<bool> = self::motions(after, before).iter().map(Option::is_some).collect();
    let inside = f64::from(BAND)..f64::from(SIDE) - f64::from(BAND);
    let changes = (0..SIDE * SIDE).into_par_iter().map(|i| {
        let mut changes = [Changes::default(); 2];
        let x = DVec2::new(f64::from(i % SIDE), f64::from(i / SIDE)) + 0.5;
        let Some(number) = before.nearest[i as usize] else { return changes };
        let Some(motion) = motions[number as usize] else { return changes };
        let there = x + motion.by;
        let is_near = before.anchors[number as usize].pixel.distance(x) < f64::from(BAND);
        if !is_near || [x.x, x.y, there.x, there.y].iter().any(|c| !inside.contains(c)) {
            return changes;
        }
        // Only where all lines around move alike and are in both pictures is there one motion.
        let is_one = around().all(|aside| {
            let is_alike = before.line_near(x + aside).is_none_or(|other| {
                let apart = before.anchors[other].pixel - before.anchors[number as usize].pixel;
                let expected = motion.by + (motion.zoom - 1.0) * apart;
                motions[other].is_some_and(|other| other.by.distance(expected) < ALIKE)
            });
            is_alike && after.line_near(there + aside).is_none_or(|other| is_known[other])
        });
        if !is_one {
            return changes;
        }
        let is_at_crossing = around()
            .any(|aside| before.line_near(x + aside).is_some_and(|line| before.anchors[line].is_crossing));
        let changes_here = &mut changes[usize::from(is_at_crossing)];
        for (run, [from, to]) in [surface, screen, &locked, &moved].into_iter().enumerate() {
            changes_here.add(run, from.values[i as usize] as f32, to.sampled(there) as f32);
        }
        changes_here.count = 1.0;
        changes
    });
    changes.reduce(Default::default, plus)
}

/// Of each part the sum.
pub(crate) fn plus(one: [Changes; 2], other: [Changes; 2]) -> [Changes; 2] {
    [0, 1].map(|part| one[part].plus(&other[part]))
}

/// Steps from a pixel in all directions, as far as ink of a line reaches.
fn around() -> impl Iterator<Item = DVec2> {
    (0..16).map(|turn| {
        let radius = f64::from(BAND) * if turn < 8 { 0.5 } else { 1.0 };
        radius * DVec2::from_angle(f64::from(turn) * std::f64::consts::FRAC_PI_4)
    })
}

/// How a place on a line moves between two pictures.
#[derive(Debug, Clone, Copy)]
struct Motion {
    by: DVec2,
    /// How much larger everything around it gets.
    zoom: f64,
}

/// Where each place on a line is seen in another picture, from where it is in this one; `None`: it is not.
fn motions(from: &Frame, to: &Frame) -> Vec<Option<Motion>> {
    let motion = |anchor: &Anchor| {
        let there = to.drawn.eye.spot(anchor.world, anchor.along)?;
        let seen = &to.anchors[to.nearest(there.pixel)? as usize];
        let is_same = seen.object == anchor.object
            && seen.pixel.distance(there.pixel) < 0.75
            && seen.along.dot(anchor.along).abs() > 0.9
            && seen.world.distance(anchor.world) < 4.0 * f64::from(there.place.pixel);
        let here = from.drawn.eye.spot(anchor.world, anchor.along)?;
        let zoom = f64::from(here.place.pixel / there.place.pixel);
        is_same.then_some(Motion { by: there.pixel - anchor.pixel, zoom })
    };
    from.anchors.par_iter().map(motion).collect()
}

/// Blurred by a deviation of one pixel.
fn blurred(ink: &Ink) -> Ink {
    let weights: [f64; 7] = std::array::from_fn(|i| (-0.5 * (i as f64 - 3.0).powi(2)).exp());
    let total: f64 = weights.iter().sum();
    let pass = |ink: &Ink, step: [i32; 2]| {
        let values = (0..SIDE * SIDE).into_par_iter().map(|i| {
            let (x, y) = ((i % SIDE) as i32, (i / SIDE) as i32);
            let sum: f64 = (-3..=3)
                .zip(weights)
                .map(|(k, weight)| weight * ink.at(x + k * step[0], y + k * step[1]))
                .sum();
            sum / total
        });
        Ink { size: ink.size, values: values.collect() }
    };
    pass(&pass(ink, [1, 0]), [0, 1])
}
