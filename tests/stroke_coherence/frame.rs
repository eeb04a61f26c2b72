//! A picture of strokes, and where each of its pixels lies in another one.

use glam::{DVec2, DVec3, UVec2};
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::Projector;
use hachure::render::{Picture, View};
use hachure::scene::Camera;

use crate::common::{Surfel, hatched, surfels};

/// A change of so much pops.
const POP: f64 = 0.6;
/// From so much on a pixel has ink.
const INK: f64 = 0.2;
/// Greatest difference of depths at which two pixels show the same place, as a share of the depth.
const SAME_DEPTH: f64 = 4e-3;
/// Least cosine between the normals of faces that are the same one, or neighbors on a round surface.
const SAME_FACE: f32 = 0.94;

/// Ink and surface of each pixel, one sample each.
#[derive(Clone)]
pub(crate) struct Frame {
    pub(crate) side: usize,
    /// Share of ink, 0 to 1, row by row.
    pub(crate) inks: Vec<f64>,
    pub(crate) surfels: Vec<Surfel>,
    pub(crate) projector: Projector,
}

impl Frame {
    /// As it is while something moves.
    pub(crate) fn drawn(session: &mut Session, opened: &mut Opened, camera: Camera, side: u32) -> Self {
        opened.document.camera = Some(camera);
        let picture = hatched::moving(session, opened, side);
        Self::of(session, opened, camera, &picture)
    }

    /// As a picture of so many samples is.
    pub(crate) fn sampled(
        session: &mut Session,
        opened: &mut Opened,
        camera: Camera,
        side: u32,
        samples: u32,
    ) -> Self {
        opened.document.camera = Some(camera);
        session.set_samples(samples);
        let picture = session.draw(opened, [side; 2], true).unwrap();
        Self::of(session, opened, camera, &picture)
    }

    fn of(session: &mut Session, opened: &Opened, camera: Camera, picture: &Picture) -> Self {
        let size = UVec2::from_array(picture.image.size());
        let inks = hatched::inks(&hatched::read(session, picture))
            .into_iter()
            .map(|ink| ink.unwrap_or(0.0))
            .collect();
        let view = View::new(&camera, &opened.scene.bounds(), size);
        Self { side: size.x as usize, inks, surfels: surfels(session, picture), projector: view.projector() }
    }

    /// The point in the world that a pixel shows.
    pub(crate) fn point(&self, x: usize, y: usize) -> Option<DVec3> {
        let surfel = &self.surfels[y * self.side + x];
        let at = DVec2::new(x as f64, y as f64) + 0.5;
        let view = self.projector.unproject(at, f64::from(surfel.depth));
        (surfel.object != 0).then(|| self.projector.view_from_world.inverse().transform_point3(view))
    }

    /// Ink where a point of a surface is seen, between the centers of pixels; `None` where one of them shows something else, also
    /// another face of the same object. `surfel`: how another picture sees it.
    fn ink_at(&self, world: DVec3, surfel: &Surfel) -> Option<f64> {
        let view = self.projector.view_from_world.transform_point3(world);
        let at = self.projector.pixel(view) - 0.5;
        let (first, f) = (at.floor(), at - at.floor());
        let most = (self.side - 2) as f64;
        if first.min_element() < 0.0 || first.max_element() > most {
            return None;
        }
        let first = first.y as usize * self.side + first.x as usize;
        let around = [first, first + 1, first + self.side, first + self.side + 1];
        let is_same = |i: &usize| {
            let there = &self.surfels[*i];
            there.object == surfel.object
                && there.face_normal.dot(surfel.face_normal) > SAME_FACE
                && (f64::from(there.depth) / -view.z - 1.0).abs() < SAME_DEPTH
        };
        let [a, b, c, d] = around.map(|i| self.inks[i]);
        let ink = (a * (1.0 - f.x) + b * f.x) * (1.0 - f.y) + (c * (1.0 - f.x) + d * f.x) * f.y;
        around.iter().all(is_same).then_some(ink)
    }
}

/// Shares of the pixels that two pictures show whose ink changes by more than [`POP`].
#[derive(Clone, Copy)]
pub(crate) struct Pops {
    pub(crate) of_all: f64,
    /// Of those that have ink in one of them.
    pub(crate) of_ink: f64,
}

pub(crate) fn pops(before: &Frame, after: &Frame) -> Pops {
    let (mut all, mut inked, mut popped) = (0, 0, 0);
    for (i, ink) in after.inks.iter().enumerate() {
        let Some(world) = after.point(i % after.side, i / after.side) else { continue };
        let Some(was) = before.ink_at(world, &after.surfels[i]) else { continue };
        all += 1;
        inked += usize::from(ink.max(was) > INK);
        popped += usize::from((ink - was).abs() > POP);
    }
    assert!(inked > 5_000, "{inked} pixels");
    Pops { of_all: popped as f64 / all as f64, of_ink: popped as f64 / inked as f64 }
}
