//! How well strokes of hatching hold: they stay on the surface while the camera moves, keep their width and spacing on paper, and
//! leave no crumbs. All of it:
//!
//! ```text
//! cargo test --release --test stroke_coherence -- --ignored --nocapture --test-threads 1
//! ```

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "the numbers are what it is for")]

#[path = "../common/mod.rs"]
mod common;
mod frame;
mod marks;
mod twins;

use common::failures::Failures;
use common::hatched::{even, presets};
use common::{sample, session};
use glam::{DMat4, DVec3};
use hachure::export::Session;
use hachure::export::session::{Opened, initial_camera};
use hachure::geometry::primitives;
use hachure::scene::Camera;
use hachure::style::hatching::{Hatching, Mapping};
use hachure::style::{Technique, preset};

use frame::{Frame, Pops, pops};
use marks::{Evenness, Marks};

const SIDE: u32 = 480;
/// Pixels per side of pictures as they are drawn.
const PICTURE: u32 = 800;
const MODELS: [&str; 3] = ["ogre", "crank", "temple"];
/// Darkness of even pictures.
const DARKNESS: f32 = 0.35;
/// Greatest shares of the pixels that change by more than 0.6: of strokes that go on and on, and of others.
const MAX_POPS: [f64; 2] = [0.008, 0.015];
/// Of what is painted on the surface.
const MAX_LOCKED: f64 = 0.002;
/// Greatest share of the ink that lies in marks shorter than 6 px; and in pictures of one sample.
const MAX_CRUMBS: f64 = 0.02;
const MAX_CRISP_CRUMBS: f64 = 0.0225;
/// The same of a picture of one sample, without those that are cut off.
const MAX_PIECES: f64 = 0.008;
/// Samples per pixel of finished pictures.
const SAMPLES: u32 = 8;
/// Greatest coefficient of variation of spacing and width.
const MAX_UNEVEN: f64 = 0.08;
/// Steps in an octave of coming closer.
const STEPS: u32 = 4;

/// Ways of a camera, as far as from one picture to the next: 1° around, 1 % closer.
fn ways(opened: &Opened) -> [(&'static str, Camera, Camera); 2] {
    let start = initial_camera(&opened.document, &opened.scene, 1.0);
    let up = opened.document.up(&opened.scene).vector();
    let closer =
        Camera { position: start.focal_point + (start.position - start.focal_point) / 1.01, ..start };
    [("orbit", start, start.orbited(up, 1.0, 0.0)), ("zoom", start, closer)]
}

fn measure_pops(session: &mut Session, models: &[&str], failures: &mut Failures) {
    for name in models {
        let mut opened = sample(name);
        session.set_scene(&opened).unwrap();
        for (way, before, after) in ways(&opened) {
            let mut popped = |style: Hatching| {
                opened.document.style = even(style, DARKNESS, SIDE);
                let [before, after] =
                    [before, after].map(|camera| Frame::drawn(session, &mut opened, camera, SIDE));
                (pops(&before, &after), [before, after])
            };
            for (preset, hatching) in presets() {
                let most = MAX_POPS[usize::from(hatching.stroke.taper > 0.0)];
                let (found, _) = popped(hatching);
                let Pops { of_all, of_ink } = found;
                println!(
                    "{name:<8}{way:<7}{preset:<24}{:5.2} %, {:.2} % of those with ink",
                    100.0 * of_all,
                    100.0 * of_ink
                );
                failures.check(of_all <= most, format!("{name}, {way}: {preset} pops: {of_all:.4}"));
            }
            // What stays on the paper fails, and what is painted on the surface hardly changes.
            let (paper, frames) = popped(Hatching { mapping: Mapping::ImageSpace, ..Hatching::default() });
            let locked = frames.each_ref().map(|frame| twins::locked(frame, &frames[0]));
            let [paper, locked] = [paper, pops(&locked[0], &locked[1])].map(|pops| pops.of_all);
            println!(
                "{name:<8}{way:<7}on paper {:.2} %, on the surface {:.2} %",
                100.0 * paper,
                100.0 * locked
            );
            failures.check(paper > MAX_POPS[1], format!("{name}, {way}: paper: {paper:.4}"));
            failures.check(locked <= MAX_LOCKED, format!("{name}, {way}: surface: {locked:.4}"));
        }
    }
}

#[test]
fn strokes_stay_on_an_ogre() {
    let mut failures = Failures::default();
    measure_pops(&mut session(), &MODELS[..1], &mut failures);
    failures.report();
}

#[test]
#[ignore = "heavy: run by `make quality`"]
fn strokes_stay_on_the_models() {
    let mut failures = Failures::default();
    measure_pops(&mut session(), &MODELS, &mut failures);
    failures.report();
}

fn measure_crumbs(session: &mut Session, models: &[&str], failures: &mut Failures) {
    let all = preset::all().into_iter().filter(|preset| {
        preset.style.technique == Technique::Hatching && preset.style.hatching.mapping == Mapping::Stripes
    });
    let all: Vec<_> = all.collect();
    for name in models {
        let mut opened = sample(name);
        session.set_scene(&opened).unwrap();
        let camera = initial_camera(&opened.document, &opened.scene, 1.0);
        for preset in &all {
            let mut style = preset.style.clone();
            (style.edges.profile.show, style.edges.inner.show) = (false, false);
            style.sketch.enabled = false;
            opened.document.style = style;
            let moving = Marks::of(&Frame::drawn(session, &mut opened, camera, PICTURE));
            let [single, finished] = [1, SAMPLES]
                .map(|samples| Frame::sampled(session, &mut opened, camera, PICTURE, samples))
                .map(|frame| Marks::of(&frame));
            for (what, marks) in [("moving", &moving), ("one sample", &single), ("finished", &finished)] {
                let (all, most) =
                    (marks.crumbs(), if what == "one sample" { MAX_CRISP_CRUMBS } else { MAX_CRUMBS });
                println!(
                    "{name:<12}{:<24}{what:<12}{:5.2} % of the ink, {:.2} % inside of surfaces",
                    preset.name,
                    100.0 * all,
                    100.0 * marks.free_crumbs()
                );
                failures
                    .check(all <= most, format!("{name}, {what}: {} has {all:.4} in crumbs", preset.name));
            }
            // What is crisp has no gaps: only borders cut it into pieces.
            let pieces = single.free_crumbs();
            failures
                .check(pieces <= MAX_PIECES, format!("{name}: {} has {pieces:.4} in pieces", preset.name));
        }
    }
}

/// Of its wires, and of the round edges of its boards, less than a pixel is seen.
#[test]
fn strokes_leave_no_crumbs_in_a_still_life() {
    let mut failures = Failures::default();
    measure_crumbs(&mut session(), &["still_life"], &mut failures);
    failures.report();
}

#[test]
#[ignore = "heavy: run by `make quality`"]
fn strokes_leave_no_crumbs() {
    let mut failures = Failures::default();
    measure_crumbs(&mut session(), &["ogre", "crank", "temple", "cloister", "still_life"], &mut failures);
    failures.report();
}

/// Spacing and width of strokes, coming 32 times closer from far away.
fn measure_evenness(
    session: &mut Session,
    (name, mut opened): (&str, Opened),
    far: Camera,
    failures: &mut Failures,
) {
    session.set_scene(&opened).unwrap();
    for (preset, hatching) in presets() {
        opened.document.style = even(hatching, DARKNESS, SIDE);
        let mut seen = Vec::new();
        for step in 0..=5 * STEPS {
            let closer = 0.5_f64.powf(f64::from(step) / f64::from(STEPS));
            let position = far.focal_point + closer * (far.position - far.focal_point);
            seen.push(Evenness::of(&Frame::drawn(session, &mut opened, Camera { position, ..far }, SIDE)));
        }
        let [spacing, width] = [|s: &Evenness| s.spacing, |s: &Evenness| s.width]
            .map(|of| marks::variation(seen.iter().map(of)));
        let (mean_spacing, mean_width) =
            (marks::mean(seen.iter().map(|s| s.spacing)), marks::mean(seen.iter().map(|s| s.width)));
        println!(
            "{name:<8}{preset:<24}spacing {mean_spacing:5.2} px ± {:4.1} %, width {mean_width:5.2} px ± {:4.1} %",
            100.0 * spacing,
            100.0 * width
        );
        for (what, varies) in [("spacing", spacing), ("width", width)] {
            failures.check(varies <= MAX_UNEVEN, format!("{name}: {what} of {preset} varies by {varies:.3}"));
        }
    }
}

#[test]
fn strokes_keep_their_width_and_spacing() {
    let mut failures = Failures::default();
    let mut session = session();
    let scene =
        common::scene(vec![("plane", primitives::plane(40.0), DMat4::from_rotation_z(0.4), [1.0; 3])]);
    let far = Camera { position: 16.0 * DVec3::Z, focal_point: DVec3::ZERO, ..Camera::default() };
    measure_evenness(&mut session, ("plane", common::opened(&scene, DVec3::Z)), far, &mut failures);
    let mut ogre = sample("ogre");
    let start = initial_camera(&ogre.document, &ogre.scene, 1.0);
    session.set_scene(&ogre).unwrap();
    let middle = SIDE as usize / 2;
    let focal_point = Frame::drawn(&mut session, &mut ogre, start, SIDE).point(middle, middle).unwrap();
    let far = Camera { position: focal_point + 2.0 * (start.position - focal_point), focal_point, ..start };
    measure_evenness(&mut session, ("ogre", ogre), far, &mut failures);
    failures.report();
}
