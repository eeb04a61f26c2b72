//! Ways of a camera about a model.

use glam::DVec3;
use hachure::app::viewport::wave_easing::WaveEasing;
use hachure::scene::Camera;

use super::model::{Eye, Model, SIDE};

/// A way of moving.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Path {
    Orbit,
    Dolly,
    Pan,
}

pub(crate) const PATHS: [Path; 3] = [Path::Orbit, Path::Dolly, Path::Pan];

impl Path {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Orbit => "orbit",
            Self::Dolly => "dolly",
            Self::Pan => "pan",
        }
    }
}

/// How much nearer a dolly gets, in how many single steps.
pub(crate) const ZOOM: f64 = 32.0;
pub(crate) const STEPS: u32 = 120;
/// Degrees and pixels of a single step.
const TURN: f64 = 0.5;
const SHIFT: f64 = 5.0;

/// How much of a path is walked.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Length {
    /// Places where an orbit or a pan begins.
    pub(crate) starts: u32,
    /// Single steps of a dolly between looks at which edges are visible; the whole dolly is walked.
    pub(crate) fresh: u32,
    /// Single steps in one step.
    pub(crate) stride: u32,
}

/// Where a dolly leads to: the place on a line, well within the picture, that has most lines around it.
pub(crate) fn target(model: &Model, eye: &Eye) -> DVec3 {
    let anchors = model.anchors(eye, 6.0);
    let side = f64::from(SIDE);
    let is_central = |p: glam::DVec2| (p - 0.5 * side).abs().max_element() < 0.2 * side;
    let neighbors =
        |p: glam::DVec2| anchors.iter().filter(|a| a.pixel.distance(p) < 0.5 * side / ZOOM).count();
    let central = anchors.iter().filter(|a| is_central(a.pixel));
    central.max_by_key(|a| neighbors(a.pixel)).unwrap().world
}

/// The camera so many single steps on a dolly towards a place.
pub(crate) fn dolly(start: &Camera, target: DVec3, step: u32) -> Camera {
    let share = ZOOM.powf(-f64::from(step) / f64::from(STEPS));
    // It turns towards the place first, so that this stays in the middle.
    Camera { position: target + (start.position - target) * share, focal_point: target, ..*start }
}

/// The camera moved so many pixels across the picture, on a slant.
fn panned(start: &Camera, px: f64) -> Camera {
    let across = (0.8 * start.right() - 0.6 * start.up()) * (px * start.view_height() / f64::from(SIDE));
    Camera { position: start.position + across, focal_point: start.focal_point + across, ..*start }
}

/// Cameras in runs: within one of them edges are those of its first camera.
pub(crate) fn runs(model: &Model, path: Path, target: DVec3, length: Length) -> Vec<Vec<Camera>> {
    let Length { starts, fresh, stride } = length;
    let start = model.camera();
    match path {
        Path::Orbit => (0..starts)
            .map(|i| {
                let elevation = if i % 2 == 0 { 0.0 } else { 25.0 };
                let from = start.orbited(model.up(), 360.0 / f64::from(starts) * f64::from(i), elevation);
                (0..2).map(|step| from.orbited(model.up(), TURN * f64::from(stride * step), 0.0)).collect()
            })
            .collect(),
        Path::Pan => (0..starts)
            .map(|i| {
                let first = 10.0 * SHIFT * (f64::from(i) - 0.5 * f64::from(starts));
                (0..2).map(|step| panned(&start, first + SHIFT * f64::from(stride * step))).collect()
            })
            .collect(),
        Path::Dolly => (0..STEPS)
            .step_by((fresh * stride) as usize)
            .map(|first| (0..=fresh).map(|i| dolly(&start, target, first + stride * i)).collect())
            .collect(),
    }
}

/// Two pictures, one after the other.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Step {
    pub(crate) cameras: [Camera; 2],
    /// How much longer than they are to be waves are in each of them.
    pub(crate) wave_scales: [f32; 2],
}

impl Step {
    pub(crate) fn new(run: &[Camera]) -> Self {
        Self { cameras: [run[0], run[1]], wave_scales: [1.0; 2] }
    }
}

/// Least pictures per second that are asked of a window.
const PICTURES_PER_SECOND: f64 = 15.0;

/// Steps that go on from each other, with waves as the window shows them.
pub(crate) struct Eased {
    pub(crate) moved: Vec<Step>,
    /// The same, but with waves that stay on their surface from the first to the second picture of each step.
    pub(crate) held: Vec<Step>,
    /// The pictures that follow, until waves are as long as they are to be.
    pub(crate) rest: Vec<Step>,
}

pub(crate) fn eased(steps: &[Step]) -> Eased {
    let mut easing = WaveEasing::default();
    let mut seconds = 0.0;
    let mut scale = |camera: &Camera| {
        seconds += 1.0 / PICTURES_PER_SECOND;
        easing.scale(camera, seconds)
    };
    let mut before = scale(&steps[0].cameras[0]);
    let mut next = |cameras: [Camera; 2]| {
        let wave_scales = [before, scale(&cameras[1])];
        before = wave_scales[1];
        Step { cameras, wave_scales }
    };
    let moved: Vec<Step> = steps.iter().map(|step| next(step.cameras)).collect();
    let last = steps[steps.len() - 1].cameras[1];
    let mut rest: Vec<Step> = Vec::new();
    while rest.last().is_none_or(|step| step.wave_scales[1] != 1.0) {
        rest.push(next([last; 2]));
    }
    let held = moved.iter().map(|step| {
        let nearer = step.cameras[0].view_height() / step.cameras[1].view_height();
        Step { wave_scales: [step.wave_scales[0], step.wave_scales[0] * nearer as f32], ..*step }
    });
    Eased { held: held.collect(), moved, rest }
}
