//! The shape of a label: text, the plate behind it and the line to what it names, in sizes of its letters. The point that it
//! names is the origin.

use glam::{Vec2, Vec3};

use super::Label;
use crate::geometry::primitives::from_triangles;
use crate::geometry::{Mesh, Text};
use crate::style::Color;

/// Width of the line and radius of its dot.
const LINE_WIDTH: f32 = 0.07;
const DOT_RADIUS: f32 = 0.16;

/// Paper around the letters.
const MARGIN: f32 = 0.25;

/// From the letters back to the line, and from there to the plate: less than can be seen.
const BEHIND: f32 = 0.002;

/// The mesh of a label with its colors, facing +z.
pub(super) fn label_mesh(label: &Label, text: &Text, ink: Color, paper: Color) -> Mesh {
    let [right, up] = label.offset;
    let (size, middle) = (text.max - text.min, (text.min + text.max) * 0.5);
    let is_on_point = right == 0.0 && up == 0.0;
    // The end of the first line that is nearer to the point is where the offset says.
    let place = Vec2::new(
        if is_on_point {
            -middle.x
        } else if right < 0.0 {
            right - text.max.x
        } else {
            right
        },
        if is_on_point { -middle.y } else { up },
    );
    let mut mesh = Colored::default();
    if label.plate {
        let margin = Vec2::splat(MARGIN);
        let (min, max) = (text.min + place - margin, text.max + place + margin);
        mesh.polygon(&[min, Vec2::new(max.x, min.y), max, Vec2::new(min.x, max.y)], -2.0 * BEHIND, paper);
    }
    if !is_on_point {
        let side = if right < 0.0 { place.x + size.x + 0.5 * MARGIN } else { place.x - 0.5 * MARGIN };
        let to = Vec2::new(side, place.y + 0.5 * text.max.y);
        let across = to.normalize_or(Vec2::X).perp() * (0.5 * LINE_WIDTH);
        mesh.polygon(&[across * -1.0, to - across, to + across, across], -BEHIND, ink);
        let dot: Vec<Vec2> =
            (0..24).map(|k| Vec2::from_angle(k as f32 * std::f32::consts::TAU / 24.0) * DOT_RADIUS).collect();
        mesh.polygon(&dot, -BEHIND, ink);
    }
    mesh.triangles(&text.mesh, place, ink);
    mesh.finish()
}

/// Flat triangles in colors.
#[derive(Default)]
struct Colored {
    positions: Vec<Vec3>,
    colors: Vec<[u8; 4]>,
    indices: Vec<u32>,
}

impl Colored {
    fn add(
        &mut self,
        positions: impl Iterator<Item = Vec3>,
        indices: impl Iterator<Item = u32>,
        color: Color,
    ) {
        let first = self.positions.len() as u32;
        self.positions.extend(positions);
        let linear = color.to_linear().extend(1.0).to_array().map(|c| (c * 255.0).round() as u8);
        self.colors.resize(self.positions.len(), linear);
        self.indices.extend(indices.map(|v| first + v));
    }

    fn polygon(&mut self, corners: &[Vec2], z: f32, color: Color) {
        let fan = (1..corners.len().saturating_sub(1) as u32).flat_map(|k| [0, k, k + 1]);
        self.add(corners.iter().map(|p| p.extend(z)), fan, color);
    }

    fn triangles(&mut self, mesh: &Mesh, place: Vec2, color: Color) {
        let positions = mesh.positions.iter().map(|p| *p + place.extend(0.0));
        self.add(positions, mesh.indices.iter().copied(), color);
    }

    fn finish(self) -> Mesh {
        Mesh { colors: self.colors, ..from_triangles(self.positions, self.indices) }
    }
}
