//! How well the offsets of sketches move with the model, in an orbit, in a dolly and in a pan: see `field.rs` and `ink.rs`. All of it:
//!
//! ```text
//! cargo test --release --test sketch_coherence -- --ignored --nocapture --test-threads 1
//! ```
//!
//! `HACHURE_SKETCH_ONLY=crank` limits it to one model.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "the numbers are what it is for")]

#[path = "../common/mod.rs"]
mod common;
mod drawn;
mod field;
mod ink;
mod model;
mod paths;

use common::failures::Failures;
use common::session;
use field::{LOCKED, MAP, SURFACE, walk};
use hachure::export::Session;
use hachure::render::base::view::REFERENCE_HEIGHT;
use hachure::render::effects::sketch::field as field_of;
use hachure::render::passes::offset_field::FieldUniform;
use hachure::style::{Sketch, preset};
use ink::{Changes, Draftsman, Waves, compare, drawn_small, frame, plus};
use model::{Eye, Model, SIDE};
use paths::{Eased, Length, PATHS, Path, Step, dolly, eased, runs, target};

const MODELS: [&str; 3] = ["ogre", "crank", "temple"];

/// The wave for which numbers are asked, reference pixels.
const WAVE: f32 = 120.0;
/// Least coherence of its offsets, of those of presets, of a field that is locked to the surface, and of ink.
const LEAST: f64 = 0.9;
const MIN_OF_PRESETS: f64 = 0.88;
const MIN_LOCKED: f64 = 0.98;
const MIN_OF_INK: f64 = 0.9;
/// Where surfaces run through each other: a line there is now the end of one surface before another, now an intersection.
const MIN_OF_CROSSINGS: f64 = 0.8;
/// Greatest share of the pixels with ink that pop beyond those of a locked run: of all, and where surfaces run through each other.
const MAX_POPS: f64 = 0.0012;
const MAX_POPS_OF_CROSSINGS: f64 = 0.007;
/// Greatest deviation of the root of the mean square on a dolly.
const MAX_DEVIATION: f64 = 0.15;
/// Most steps of a path that ink is compared at, all along it.
const MAX_STEPS: usize = 8;
/// So many seeds.
const SEEDS: u32 = 4;

/// Fields of a style in pictures so large, px, with so many seeds.
fn seeds(sketch: &Sketch, side: u32, count: u32) -> Vec<FieldUniform> {
    let of = |seed| {
        let mut sketch = sketch.clone();
        sketch.wander.seed = seed;
        field_of(&sketch, (f64::from(side) / REFERENCE_HEIGHT) as f32)
    };
    (1..=count).map(of).collect()
}

/// The style for which numbers are asked.
fn measured() -> Sketch {
    let mut sketch = Sketch::default();
    sketch.wander.wave = WAVE;
    sketch
}

/// Prints a row of offsets; `dolly`: where that leads to.
fn measure_field(
    session: &mut Session,
    model: &Model,
    (path, dolly): (Path, glam::DVec3),
    (length, apart): (Length, f64),
    failures: &mut Failures,
) {
    let presets: Vec<_> = preset::all().into_iter().filter(|preset| preset.style.sketch.enabled).collect();
    let mut recipes = vec![seeds(&measured(), SIDE, SEEDS)];
    recipes.extend(presets.iter().map(|preset| seeds(&preset.style.sketch, SIDE, 1)));
    let walked = walk(session, model, (path, dolly, length), &recipes, apart);
    let sums = &walked.sums[0];
    let (surface, locked) = (sums.coherence(SURFACE).unwrap(), sums.coherence(LOCKED).unwrap());
    let map = sums.coherence(MAP).map_or("     –".to_owned(), |map| format!("{map:6.3}"));
    let growth = walked.map_growth.map_or("–".to_owned(), |growth| format!("{growth:.1}"));
    let of_presets = presets.iter().zip(&walked.sums[1..]);
    let (least, preset) = of_presets
        .map(|(preset, sums)| (sums.coherence(SURFACE).unwrap(), &preset.name))
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .unwrap();
    let rms: Vec<f64> = walked.steps[0].iter().map(|step| step.rms(SURFACE) / plain_rms()).collect();
    let (low, high) = rms.iter().fold((f64::INFINITY, 0.0_f64), |(l, h), r| (l.min(*r), h.max(*r)));
    let (name, way) = (model.name, path.name());
    println!(
        "{name:<8}{way:<7}{surface:7.3}{:8.3}{map:>8} ×{growth:<6}{locked:7.3}   {low:.2} to {high:.2}   {least:.3} {preset}",
        0.0
    );
    failures.check(locked >= MIN_LOCKED, format!("{name}, {way}: what is locked has {locked:.3}"));
    failures.check(surface >= LEAST, format!("{name}, {way}: offsets have {surface:.3}"));
    failures.check(least >= MIN_OF_PRESETS, format!("{name}, {way}: offsets of {preset} have {least:.3}"));
    let is_even = path != Path::Dolly || low >= 1.0 - MAX_DEVIATION && high <= 1.0 + MAX_DEVIATION;
    failures.check(is_even, format!("{name}, {way}: rms from {low:.2} to {high:.2}"));
}

/// Root of the mean square of noise with its details, by construction.
fn plain_rms() -> f64 {
    f64::from(measured().wander.detail).hypot(1.0)
}

/// What is looked at apart.
struct Part {
    name: &'static str,
    min_coherence: f64,
    /// Greatest share of the pixels with ink that pop beyond those of offsets that do not change.
    max_pops: f64,
}

const PARTS: [Part; 3] = [
    Part { name: "", min_coherence: MIN_OF_INK, max_pops: MAX_POPS },
    Part { name: " elsewhere", min_coherence: MIN_OF_INK, max_pops: MAX_POPS },
    Part { name: " crossings", min_coherence: MIN_OF_CROSSINGS, max_pops: MAX_POPS_OF_CROSSINGS },
];

/// A row of the table of ink.
struct InkRow<'a> {
    name: &'a str,
    steps: &'a [Step],
    floor: Floor,
}

/// What pops though offsets do not change.
#[derive(Debug, Clone, Copy)]
enum Floor {
    /// As much as in the locked run.
    Locked,
    /// So much of each part: the device drew it, with waves that stay on their surface.
    Held([f64; 3]),
    /// How much it is does not matter.
    Any,
}

/// Prints three rows of the ink of some of these steps: all of it, apart from where surfaces run through each other, and there. Returns
/// the shares of pixels that pop.
fn measure_ink(
    session: &mut Session,
    model: &Model,
    draftsmen: &mut [Draftsman; 3],
    row: &InkRow<'_>,
    failures: &mut Failures,
) -> [f64; 3] {
    let InkRow { name, steps, floor } = *row;
    let field = seeds(&measured(), SIDE, 1)[0];
    let mut all = [Changes::default(); 2];
    let count = steps.len().min(MAX_STEPS);
    for step in (0..count).map(|i| steps[i * steps.len() / count]) {
        let [before, after] = [0, 1].map(|at| {
            let eye = Eye::new(session, step.cameras[at], SIDE);
            let wave_scale = step.wave_scales[at];
            frame(draftsmen, model, eye, Waves { field: &field, wave_scale })
        });
        all = plus(all, compare(&before, &after));
    }
    let [elsewhere, crossings] = all;
    let mut drawn_pops = [0.0; 3];
    for (number, part) in PARTS.into_iter().enumerate() {
        let Part { name: part, min_coherence, max_pops } = part;
        let changes = [elsewhere.plus(&crossings), elsewhere, crossings][number];
        let [surface, screen, locked, moved] = changes.errors();
        let pops = changes.pops();
        drawn_pops[number] = pops[0];
        let [of_surface, of_screen, of_locked, of_moved] = pops.map(|share| 100.0 * share);
        let coherences = [changes.coherence(), changes.coherence_of_offsets()];
        let [drawn, offsets] = coherences.map(|found| found.map_or("–".to_owned(), |c| format!("{c:.3}")));
        let row = format!("{} {name}{part}", model.name);
        println!(
            "{row:<34}{drawn:>7}{offsets:>9}   {surface:.4} {moved:.4} {locked:.4} {screen:.4}   {of_surface:6.3} {of_moved:6.3} {of_locked:6.3} {of_screen:6.2}   {:7.0}",
            changes.count()
        );
        let beyond = match floor {
            Floor::Locked => [pops[0] - pops[2], pops[3] - pops[2]],
            Floor::Held(held) => [pops[0] - held[number]; 2],
            Floor::Any => [0.0; 2],
        };
        for (i, what) in ["ink", "offsets of ink"].into_iter().enumerate() {
            let is_enough = coherences[i].is_none_or(|coherence| coherence >= min_coherence);
            failures.check(is_enough, format!("{row}: {what}: {:.3?}", coherences[i]));
            failures.check(beyond[i] <= max_pops, format!("{row}: {what}: {:.5} pop", beyond[i]));
        }
    }
    drawn_pops
}

fn field_head() {
    println!(
        "offsets at lines, wave {WAVE} px; screen: by definition; rms: least and greatest of a step, {SEEDS} seeds"
    );
    println!("model   path   surface  screen      uv, larger  locked        rms        least of the presets");
}

fn ink_head() {
    println!(
        "ink, wave {WAVE} px, so many steps at once: coherence; mean change; pixels with ink that pop, %"
    );
    println!(
        "model, path, steps                  drawn  offsets    drawn offsets locked screen    drawn offsets locked screen    pixels"
    );
}

#[test]
#[ignore = "heavy: run by `make quality`"]
fn sketches_move_with_the_model() {
    let mut session = session();
    let mut failures = Failures::default();
    let only = std::env::var("HACHURE_SKETCH_ONLY").unwrap_or_default();
    let names = || MODELS.into_iter().filter(|name| name.contains(&only));
    field_head();
    for name in names() {
        let model = Model::new(&mut session, name);
        let eye = Eye::new(&mut session, model.camera(), SIDE);
        let dolly = target(&model, &eye);
        for path in PATHS {
            let length = Length { starts: 12, fresh: 4, stride: 1 };
            measure_field(&mut session, &model, (path, dolly), (length, 16.0), &mut failures);
        }
    }
    ink_head();
    for name in names() {
        let model = Model::new(&mut session, name);
        let eye = Eye::new(&mut session, model.camera(), SIDE);
        let dolly = target(&model, &eye);
        let mut draftsmen = Draftsman::all(&model, WAVE);
        for path in PATHS {
            let strides: &[u32] = if path == Path::Dolly { &[3, 10] } else { &[10] };
            for &stride in strides {
                let length = Length { starts: 3, fresh: 1, stride };
                let steps: Vec<Step> =
                    runs(&model, path, dolly, length).iter().map(|run| Step::new(run)).collect();
                let name = format!("{} ×{stride}", path.name());
                let mut measure = |name: &str, steps: &[Step], floor| {
                    let row = InkRow { name, steps, floor };
                    measure_ink(&mut session, &model, &mut draftsmen, &row, &mut failures)
                };
                if path == Path::Dolly && stride >= 10 {
                    let Eased { moved, held, rest } = eased(&steps);
                    let floor = Floor::Held(measure(&format!("{name}, held"), &held, Floor::Any));
                    measure(&name, &moved, floor);
                    measure(&format!("{name}, rest"), &rest, Floor::Locked);
                    measure(&format!("{name}, at once"), &steps, Floor::Any);
                } else {
                    measure(&name, &steps, Floor::Locked);
                }
            }
        }
    }
    failures.report();
}

/// Pixels per side of the pictures in which the device is compared with its twin.
const SMALL: u32 = 360;
/// Greatest difference of their noise, of which the mean square is about 1, at half of the places and at four of five. The device
/// tells how a line is shortened from the pixels beside it, the twin knows.
const MAX_UNLIKE: [f64; 2] = [0.08, 0.2];
/// The same of what one object gives to a line and another one to the next pixel of it, where they touch.
const MAX_TORN: [f64; 2] = [0.6, 1.2];

fn half_and_four_fifths(values: &mut [f64]) -> [f64; 2] {
    values.sort_by(f64::total_cmp);
    [values[values.len() / 2], values[values.len() * 4 / 5]]
}

#[test]
fn the_device_gives_the_lines_of_a_crank_the_noise_that_its_twin_says() {
    let mut session = session();
    let model = Model::new(&mut session, "crank");
    let start = model.camera();
    let eye = Eye::new(&mut session, start, SIDE);
    let cameras = [start, start.orbited(model.up(), 100.0, 25.0), dolly(&start, target(&model, &eye), 50)];
    let field = seeds(&measured(), SMALL, 1)[0];
    let mut torn = Vec::new();
    for (i, drawn) in drawn_small(&mut session, &model, WAVE, (&cameras, SMALL)).iter().enumerate() {
        let anchors = model.anchors(&drawn.eye, 2.0);
        let mut unlike = drawn.unlike_twin(&anchors, &field);
        assert!(3 * unlike.len() > anchors.len(), "{} of {} places are drawn", unlike.len(), anchors.len());
        let found = half_and_four_fifths(&mut unlike);
        assert!(found[0] < MAX_UNLIKE[0] && found[1] < MAX_UNLIKE[1], "camera {i}: {found:?}");
        torn.extend(drawn.torn());
    }
    assert!(torn.len() > 100, "{} times a line goes on as that of another object", torn.len());
    let found = half_and_four_fifths(&mut torn);
    assert!(found[0] < MAX_TORN[0] && found[1] < MAX_TORN[1], "torn: {found:?}");
}

#[test]
fn offsets_of_a_crank_move_with_it() {
    let mut session = session();
    let mut failures = Failures::default();
    let model = Model::new(&mut session, "crank");
    let eye = Eye::new(&mut session, model.camera(), SIDE);
    let dolly = target(&model, &eye);
    field_head();
    for path in PATHS {
        let length = Length { starts: 2, fresh: 20, stride: 1 };
        measure_field(&mut session, &model, (path, dolly), (length, 160.0), &mut failures);
    }
    failures.report();
}
