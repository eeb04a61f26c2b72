//! The noise that the device gave to the lines of a picture.

use glam::{DVec2, Vec2};
use hachure::export::Session;
use hachure::render::base::ids::ENHANCED;
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
/// Those of them that run along where objects end or meet.
const BETWEEN_OBJECTS: [u32; 5] = [1, 2, 3, 7, 11];

/// What the device found in a picture.
pub(crate) struct Drawn {
    pub(crate) eye: Eye,
    edges: Vec<[u32; 4]>,
    noise: Vec<[u32; 4]>,
    /// The object of each pixel, 0: none.
    objects: Vec<u32>,
}

impl Drawn {
    /// What was found in the pictures that these have drawn last: the edge map of the one without a sketch, which is that of the
    /// sketch too, and what lines were given there.
    pub(crate) fn new(plain: &mut Session, sketched: &mut Session, eye: Eye) -> Self {
        let edges = captured(plain, "edge map").unwrap();
        let noise = captured(sketched, NOISE).unwrap();
        let geometry = captured(plain, "geometry").unwrap();
        let objects = texels::<[u32; 4]>(plain, &geometry).iter().map(|texel| texel[3] & !ENHANCED).collect();
        Self { eye, edges: texels(plain, &edges), noise: texels(sketched, &noise), objects }
    }

    /// The number of the pixel that holds the line of a place, whichever of the objects that meet there draws it: the one whose
    /// spine is nearest, as not every pixel of a line has one.
    fn pixel_of(&self, anchor: &Anchor) -> Option<usize> {
        let side = self.eye.side as i32;
        let spot = self.eye.spot(anchor.world, anchor.along)?;
        let [x, y] = [spot.pixel.x, spot.pixel.y].map(|c| c.floor() as i32);
        let away = |index: usize| {
            let pixels_off = (f32::from_bits(self.edges[index][2]) + spot.place.at.z) / spot.place.pixel;
            let away = self.spine(index)?.distance(spot.pixel);
            (away < NEAR && pixels_off.abs() < 4.0 * spot.place.foreshortening).then_some((away, index))
        };
        let found = around(x, y, side).filter_map(away).min_by(|a, b| a.0.total_cmp(&b.0));
        found.map(|(_, index)| index)
    }

    /// Where a line that is drawn runs in a pixel.
    fn spine(&self, index: usize) -> Option<DVec2> {
        let [class, .., look] = self.edges[index];
        let is_drawn = CLASSES.contains(&(class >> 28)) && look >> 26 != 0;
        let side = self.eye.side as usize;
        let cell = DVec2::new((index % side) as f64, (index / side) as f64);
        let offset = [class >> 8, class].map(|bits| f64::from(bits & 255) / 127.0 - 1.0);
        is_drawn.then_some(cell + 0.5 + DVec2::from(offset))
    }

    /// How far the noise of one pixel of a line is from that of the next one, where that is of another object at the same place.
    pub(crate) fn torn(&self) -> Vec<f64> {
        let side = self.eye.side as usize;
        let between = |[a, b]: [usize; 2]| {
            let [one, other] = [self.spine(a)?, self.spine(b)?];
            let [depth, beyond] = [a, b].map(|index| f32::from_bits(self.edges[index][2]));
            let pixel = self.eye.place(one, depth, 1.0).pixel;
            let is_one_line =
                [a, b].iter().all(|index| BETWEEN_OBJECTS.contains(&(self.edges[*index][0] >> 28)))
                    && self.edges[a][1] != self.edges[b][1]
                    && one.distance(other) < 1.75
                    && (depth - beyond).abs() < 2.0 * pixel;
            is_one_line.then(|| f64::from(self.noise_at(a).distance(self.noise_at(b))))
        };
        let next = |index: usize| [1, side - 1, side, side + 1].map(|step| [index, index + step]);
        (0..self.edges.len() - side - 1).flat_map(next).filter_map(between).collect()
    }

    fn noise_at(&self, index: usize) -> Vec2 {
        let bits = self.noise[index][0];
        Vec2::from([bits as u16, (bits >> 16) as u16].map(|half| f16::from_bits(half).to_f32()))
    }

    /// Whether no other object is seen beside a pixel of a line: where one touches it they share their noise.
    fn is_alone(&self, index: usize) -> bool {
        let side = self.eye.side as i32;
        let [x, y] = [index as i32 % side, index as i32 / side];
        around(x, y, side).all(|beside| [0, self.edges[index][1]].contains(&self.objects[beside]))
    }

    /// How far what the device found is from what its twin makes of the same places, of those that have a pixel of their object alone.
    pub(crate) fn unlike_twin(&self, anchors: &[Anchor], field: &FieldUniform) -> Vec<f64> {
        let unlike = |anchor: &Anchor| {
            let spot = self.eye.spot(anchor.world, anchor.along)?;
            let index = self.pixel_of(anchor)?;
            if self.edges[index][1] != anchor.object || !self.is_alone(index) {
                return None;
            }
            let twin = field.line_noise(self.eye.object(anchor.object), &spot.place, 0);
            Some(f64::from(self.noise_at(index).distance(twin)))
        };
        anchors.iter().filter_map(unlike).collect()
    }

    /// What the device found next to a place on a line; `None`: it has no pixel.
    pub(crate) fn noise(&self, anchor: &Anchor) -> Option<Vec2> {
        self.pixel_of(anchor).map(|index| self.noise_at(index))
    }
}

/// The numbers of a pixel and of those around it.
fn around(x: i32, y: i32, side: i32) -> impl Iterator<Item = usize> {
    let all = (-1..=1).flat_map(move |v| (-1..=1).map(move |u| [x + u, y + v]));
    all.filter(move |at| at.iter().all(|c| (0..side).contains(c))).map(move |[u, v]| (v * side + u) as usize)
}
