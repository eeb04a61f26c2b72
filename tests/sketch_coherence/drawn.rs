//! The noise that the device gave to the lines of a picture.

use glam::{DVec2, Vec2};
use hachure::export::Session;
use hachure::render::passes::offset_field::FieldUniform;
use half::f16;

use super::common::{captured, texels};
use super::model::{Anchor, Eye};

/// The texture that says where lines go.
pub(crate) const NOISE: &str = "noise of lines";
/// Farthest from where an edge is seen that a pixel holds it, px; four times as far in depth.
const NEAR: f64 = 1.0;
/// Classes of lines that have a point: see `shaders/common/edge_map.wgsl`.
const CLASSES: std::ops::RangeInclusive<u32> = 1..=11;

/// What the device found in a picture.
pub(crate) struct Drawn {
    pub(crate) eye: Eye,
    edges: Vec<[u32; 4]>,
    noise: Vec<[u32; 4]>,
}

impl Drawn {
    /// What was found in the pictures that these have drawn last: the edge map of the one without a sketch, which is that of the
    /// sketch too, and what lines were given there.
    pub(crate) fn new(plain: &mut Session, sketched: &mut Session, eye: Eye) -> Self {
        let edges = captured(plain, "edge map").unwrap();
        let noise = captured(sketched, NOISE).unwrap();
        Self { eye, edges: texels(plain, &edges), noise: texels(sketched, &noise) }
    }

    /// The number of the pixel that holds the line of a place.
    fn pixel_of(&self, anchor: &Anchor) -> Option<usize> {
        let spot = self.eye.spot(anchor.world, anchor.along)?;
        let cell = spot.pixel.floor();
        let index = (cell.y * f64::from(self.eye.side) + cell.x) as usize;
        let [class, object, depth, _] = self.edges[index];
        let offset = [class >> 8, class].map(|bits| f64::from(bits & 255) / 127.0 - 1.0);
        let spine = cell + 0.5 + DVec2::from(offset);
        let pixels_off = (f32::from_bits(depth) + spot.place.at.z) / spot.place.pixel;
        let is_held = CLASSES.contains(&(class >> 28))
            && object == anchor.object
            && spine.distance(spot.pixel) < NEAR
            && pixels_off.abs() < 4.0 * spot.place.stretch;
        is_held.then_some(index)
    }

    fn noise_at(&self, index: usize) -> Vec2 {
        let bits = self.noise[index][0];
        Vec2::from([bits as u16, (bits >> 16) as u16].map(|half| f16::from_bits(half).to_f32()))
    }

    /// How far what the device found is from what its twin makes of the same places, of those that have a pixel.
    pub(crate) fn unlike_twin(&self, anchors: &[Anchor], field: &FieldUniform) -> Vec<f64> {
        let unlike = |anchor: &Anchor| {
            let spot = self.eye.spot(anchor.world, anchor.along)?;
            let twin = field.line_noise(self.eye.object(anchor.object), &spot.place, 0);
            Some(f64::from(self.noise(anchor)?.distance(twin)))
        };
        anchors.iter().filter_map(unlike).collect()
    }

    /// What the device found next to a place on a line; `None`: it has no pixel.
    pub(crate) fn noise(&self, anchor: &Anchor) -> Option<Vec2> {
        self.pixel_of(anchor).map(|index| self.noise_at(index))
    }
}
