//! One line is one line: its class is that of a stretch, and stays while the camera turns. See `runs.rs` and `orbit.rs`. All of
//! it:
//!
//! ```text
//! cargo test --release --test line_continuity -- --ignored --nocapture
//! ```
//!
//! `HACHURE_LINES_ONLY=crank` limits it to one model; with `HACHURE_LINES_DIR` set to a folder, pictures are written there of the
//! lines gray, with runs that are too short in red.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "the numbers are what it is for")]

mod coaxial;
#[path = "../common/mod.rs"]
mod common;
mod folded;
mod lines;
mod orbit;
mod runs;
mod sunk;

use std::path::PathBuf;

use common::line_drawing::{line_drawing, set_width};
use common::line_scenes::{Subject, models, models_in_patches};
use common::line_truth::{Stage, directions, projector};
use common::session;
use glam::{DVec2, DVec3};
use hachure::export::Session;
use hachure::geometry::EdgeClass;
use hachure::scene::Camera;
use image::{Rgb, RgbImage};
use lines::Lines;
use orbit::{Changes, Shares, TrueClasses};
use runs::{Run, alternations};

/// A pixel is a reference pixel.
const SIDE: u32 = 1080;
const VIEWS: u32 = 6;
/// Orbits, with so many steps of this angle, degrees.
const ORBITS: usize = 3;
const STEPS: u32 = 6;
const STEP: f64 = 0.1;

/// Goals over all models: per 1000 px of line, and in percent of line pixels. Merges don't count: where several exact edges lie in
/// one pixel, now one of them is seen and now another, too.
const MAX_ALTERNATIONS: f64 = 0.2;
const MAX_CLASSES: f64 = 0.05;
const MAX_STRENGTHS: f64 = 0.1;

/// What was found in the pictures of a model.
#[derive(Default)]
struct Row {
    /// px.
    length: f64,
    alternations: usize,
    changes: Changes,
    /// Of exact visible edges, drawn without the renderer.
    exact_changes: Changes,
}

impl Row {
    /// Per 1000 px of line.
    fn alternations(&self) -> f64 {
        1000.0 * self.alternations as f64 / self.length.max(1.0)
    }

    fn line(&self) -> String {
        let [drawn, exact] = [self.changes, self.exact_changes].map(|changes| changes.shares());
        format!("{:6.3}  {drawn}  exact: {exact}", self.alternations())
    }
}

#[test]
fn where_parts_touch_lines_keep_their_class() {
    let mut session = session();
    let scene = coaxial::flange_on_hub();
    for z in [0.5, 1.0, 2.0, 4.0] {
        let camera = Camera::looking_from(DVec3::new(1.0, 0.6, z), DVec3::Y, &scene.extent(), 1.0);
        let opened = line_drawing(&scene, camera);
        session.set_scene(&opened).unwrap();
        let lines = Lines::draw(&mut session, &opened, 400);
        let found = alternations(&lines, 400);
        assert!(lines.length() > 300.0, "from {z}: hardly any line");
        assert!(
            found.is_empty(),
            "from {z}: {} runs in {:.0} px of line: {found:?}",
            found.len(),
            lines.length()
        );
    }
}

#[test]
fn what_ends_just_behind_a_wall_draws_one_line() {
    let mut session = session();
    for depth in [0.002, 0.004, 0.008, 0.016, 0.03] {
        let scene = sunk::frame_on_wall(depth);
        let camera = Camera::looking_from(DVec3::new(1.0, 0.6, 0.5), DVec3::Y, &scene.extent(), 1.0);
        let opened = line_drawing(&scene, camera);
        session.set_scene(&opened).unwrap();
        let lines = Lines::draw(&mut session, &opened, 400);
        let eye = projector(&camera, 400);
        let foot = |point: &&lines::Point| {
            let at = eye.view_from_world.inverse().transform_point3(eye.unproject(point.at, point.depth));
            at.x.abs().max(at.y.abs()) < 0.6 && at.z < 0.1
        };
        let count =
            |class| lines.points().map(|(_, point)| point).filter(foot).filter(|p| p.class == class).count();
        let [borders, intersections] = [EdgeClass::Border, EdgeClass::Intersection].map(count);
        let strays = borders.min(intersections);
        assert!(strays <= 8, "{depth} behind: {borders} px of border, {intersections} of intersection");
    }
}

/// Each of them is less than MERGING from the next one, see `shaders/passes/line_classes/links.wgsl`.
#[test]
fn of_three_lines_side_by_side_both_outer_ones_are_drawn() {
    let mut session = session();
    for distance in [1.1, 1.2, 1.3, 1.4] {
        let scene = folded::folded_sheet(distance);
        let mut opened = line_drawing(&scene, folded::from_above(400));
        set_width(&mut opened, 1.0, 400);
        session.set_scene(&opened).unwrap();
        let lines = Lines::draw(&mut session, &opened, 400);
        let drawn = |x: f64, class| {
            let eye = projector(&folded::from_above(400), 400);
            let is_there = |point: &&lines::Point| {
                let at = eye.view_from_world.inverse().transform_point3(eye.unproject(point.at, point.depth));
                (at.x - x).abs() < 0.3 && at.y.abs() < 130.0
            };
            lines.points().map(|(_, point)| point).filter(is_there).filter(|p| p.class == class).count()
        };
        let distance = f64::from(distance);
        let [border, ridge, valley] = [
            drawn(0.0, EdgeClass::Border),
            drawn(distance, EdgeClass::Ridge),
            drawn(2.0 * distance, EdgeClass::Valley),
        ];
        println!("{distance} px apart: border {border} px, ridge {ridge} px, valley {valley} px");
        assert!(border > 240 && valley > 240, "{distance} px apart: border {border} px, valley {valley} px");
        assert!(ridge < 20, "{distance} px apart: ridge {ridge} px");
    }
}

/// The end of a shaft lies under the chamfer of a flange by little more than nothing: a pixel of its outline in seven is found.
#[test]
fn what_peeps_through_now_and_then_takes_the_place_of_no_line() {
    let crank = models().into_iter().find(|subject| subject.name == "crank").unwrap();
    let camera = Camera {
        position: DVec3::new(0.350_902, 0.146_113, -0.737_422),
        focal_point: DVec3::new(-0.001_377, 0.008_377, -0.002_65),
        view_up: DVec3::new(-0.072_053, 0.986_013, 0.150_286),
        ..Camera::default()
    };
    let opened = line_drawing(&crank.scene, camera);
    let mut session = session();
    session.set_scene(&opened).unwrap();
    let lines = Lines::draw(&mut session, &opened, SIDE);
    let around =
        || lines.points().map(|(_, point)| point).filter(|p| p.at.distance(DVec2::new(270.0, 702.0)) < 12.0);
    let count = |class| around().filter(|point| point.class == class).count();
    let classes = [EdgeClass::Ridge, EdgeClass::Intersection, EdgeClass::Object].map(count);
    assert!(
        classes[0] > 20 && classes[1] > 20 && classes[2] == 0,
        "ridge, intersection, outline: {classes:?}"
    );
}

#[test]
#[ignore = "heavy: run by `make quality`"]
fn lines_of_models_keep_their_class() {
    let only = std::env::var("HACHURE_LINES_ONLY").unwrap_or_default();
    let mut session = session();
    println!(
        "alternations of class per 1000 px of line; per {STEP}°, % of line pixels: changes of class where an exact edge \
         has it still, those of them that are no merges, changes of inner ink; then what exact edges do by themselves"
    );
    let mut all = Row::default();
    let subjects = models().into_iter().chain(models_in_patches());
    for subject in subjects.filter(|subject| subject.name.contains(&only)) {
        let row = measure(&mut session, &subject);
        println!("{:<20} {}", subject.name, row.line());
        all.length += row.length;
        all.alternations += row.alternations;
        all.changes = all.changes.and(row.changes);
        all.exact_changes = all.exact_changes.and(row.exact_changes);
    }
    println!("{:<20} {}", "all", all.line());
    assert!(all.length > 1000.0, "nothing was measured");
    let (alternations, Shares { unmerged: classes, strengths, .. }) =
        (all.alternations(), all.changes.shares());
    assert!(alternations <= MAX_ALTERNATIONS, "{alternations:.3} alternations, wanted {MAX_ALTERNATIONS}");
    assert!(classes <= MAX_CLASSES, "{classes:.3} % change their class, wanted {MAX_CLASSES}");
    assert!(strengths <= MAX_STRENGTHS, "{strengths:.3} % change their ink, wanted {MAX_STRENGTHS}");
}

fn measure(session: &mut Session, subject: &Subject) -> Row {
    let folder = std::env::var_os("HACHURE_LINES_DIR").map(PathBuf::from);
    let scene = &subject.scene;
    let truth = Stage::new(session, subject);
    let mut opened = line_drawing(scene, Camera::default());
    session.set_scene(&opened).unwrap();
    let extent = scene.extent();
    let up = opened.document.up(scene).vector();
    let mut row = Row::default();
    for (view, towards_viewer) in directions(VIEWS).enumerate() {
        let camera = Camera::looking_from(towards_viewer, up, &extent, 1.0);
        opened.document.camera = Some(camera);
        let mut last = Lines::draw(session, &opened, SIDE);
        let found = alternations(&last, SIDE);
        row.length += last.length();
        row.alternations += found.len();
        if let Some(folder) = &folder {
            let file = folder.join(format!("{} {view}.png", subject.name));
            picture(&last, &found).save(file).unwrap();
        }
        if view >= ORBITS {
            continue;
        }
        let mut from = projector(&camera, SIDE);
        let mut last_exact = Lines::of_edges(&truth.visible(&from).0, &from);
        for step in 1..=STEPS {
            let camera = camera.orbited(up, f64::from(step) * STEP, 0.0);
            opened.document.camera = Some(camera);
            let (next, to) = (Lines::draw(session, &opened, SIDE), projector(&camera, SIDE));
            let edges = truth.visible(&to).0;
            let next_exact = Lines::of_edges(&edges, &to);
            let classes = TrueClasses::new(&edges, SIDE as usize);
            row.changes = row.changes.and(Changes::between((&last, &from), (&next, &to), &classes));
            let exact = Changes::between((&last_exact, &from), (&next_exact, &to), &classes);
            row.exact_changes = row.exact_changes.and(exact);
            (last, last_exact, from) = (next, next_exact, to);
        }
    }
    row
}

fn picture(lines: &Lines, runs: &[Run]) -> RgbImage {
    let mut picture = RgbImage::from_pixel(SIDE, SIDE, Rgb([255; 3]));
    let gray = lines.points().map(|(i, _)| (i, Rgb([190; 3])));
    for (i, color) in gray.chain(runs.iter().flat_map(|run| &run.pixels).map(|&i| (i, Rgb([230, 0, 0])))) {
        picture.put_pixel(i as u32 % SIDE, i as u32 / SIDE, color);
    }
    picture
}
