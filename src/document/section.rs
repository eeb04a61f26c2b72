//! The section plane: what lies beyond it, in its direction, is cut away, in every technique.

use std::ops::RangeInclusive;

use glam::DVec3;

use super::Document;
use crate::geometry::{Bounds, Plane};
use crate::scene::{Up, Warning};
use crate::style::param::{Param, Params, StyleField};
use crate::style::{Color, choice};

/// Section settings of a document.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionSettings {
    /// Whether anything is cut.
    pub show: bool,
    /// What the plane is perpendicular to.
    pub axis: Axis,
    /// Direction of a free plane: degrees to the right of the model's front.
    pub azimuth: f32,
    /// Direction of a free plane: degrees above the horizon.
    pub elevation: f32,
    /// Where the plane is along its direction, in units of the model; `None`: in the middle of everything.
    pub position: Option<f32>,
    /// Whether what lies before that position is cut away, and not what lies beyond it.
    pub flip: bool,
    /// What fills the cut through a solid.
    pub cap: Fill,
    /// Color of the caps.
    pub color: Color,
    /// Whether caps are shaded like other surfaces, or have their color as it is.
    pub lit: bool,
    /// The lines of hatched caps.
    pub hatch: Hatch,
}

/// Parallel lines on caps; where objects meet, they differ in direction or distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hatch {
    /// Color of the lines.
    pub color: Color,
    /// Distance of the lines' middles in reference pixels.
    pub spacing: f32,
    /// Width of the lines in reference pixels.
    pub width: f32,
    /// Direction in the plane, degrees: 0 is as horizontal as the plane allows.
    pub angle: f32,
}

choice! {
    /// What a section plane is perpendicular to.
    pub enum Axis {
        /// The file's X axis.
        X,
        /// The file's Y axis.
        #[default]
        Y,
        /// The file's Z axis.
        Z,
        /// A direction given by two angles.
        Free,
    }
}

choice! {
    /// What fills the cut through a solid.
    pub enum Fill {
        /// Nothing: the solid shows its inside.
        None,
        /// The color of the caps.
        Plain,
        /// Parallel lines on it.
        #[default]
        Hatched,
    }
}

impl Default for SectionSettings {
    fn default() -> Self {
        Self {
            show: false,
            axis: Axis::default(),
            azimuth: 30.0,
            elevation: 0.0,
            position: None,
            flip: false,
            cap: Fill::default(),
            color: Color([242, 238, 228]),
            lit: false,
            hatch: Hatch { color: Color::BLACK, spacing: 12.0, width: 1.2, angle: 45.0 },
        }
    }
}

impl SectionSettings {
    /// The unit vector along which [`Self::position`] counts. `up`: the model's.
    pub fn direction(&self, up: Up) -> DVec3 {
        match self.axis {
            Axis::X => DVec3::X,
            Axis::Y => DVec3::Y,
            Axis::Z => DVec3::Z,
            Axis::Free => {
                let (sin_a, cos_a) = f64::from(self.azimuth).to_radians().sin_cos();
                let (sin_e, cos_e) = f64::from(self.elevation).to_radians().sin_cos();
                let (up, front) = (up.vector(), up.front());
                (up.cross(front) * sin_a + front * cos_a) * cos_e + up * sin_e
            }
        }
    }

    /// The positions between which the plane meets a box; 0 to 1 if it is empty.
    pub fn range(&self, up: Up, bounds: &Bounds) -> [f64; 2] {
        let direction = self.direction(up);
        let along = bounds.corners().map(|corner| corner.dot(direction));
        let [low, high] = [
            along.iter().copied().fold(f64::INFINITY, f64::min),
            along.into_iter().fold(f64::NEG_INFINITY, f64::max),
        ];
        if !bounds.is_empty() && low.is_finite() && high.is_finite() { [low, high] } else { [0.0, 1.0] }
    }

    /// The plane; `None` when nothing is to be cut. What lies beyond it, to where its normal points, is cut away. `bounds`: of
    /// everything.
    pub fn plane(&self, up: Up, bounds: &Bounds) -> Option<Plane> {
        let direction = self.direction(up);
        let [low, high] = self.range(up, bounds);
        let position = self.position.map_or(0.5 * (low + high), f64::from);
        let center = if bounds.is_empty() { DVec3::ZERO } else { bounds.center() };
        let point = center + direction * (position - center.dot(direction));
        let normal = if self.flip { -direction } else { direction };
        (self.show && point.is_finite() && normal.is_finite()).then_some(Plane { point, normal })
    }

    /// Every parameter, like [`crate::style::Style::params`], for any model.
    pub fn params(&mut self) -> Vec<Param<'_>> {
        self.params_within(0.0..=1.0, "")
    }

    /// The same for a model that reaches so far along the plane's direction, in a unit.
    pub fn params_within(&mut self, extent: RangeInclusive<f32>, unit: &'static str) -> Vec<Param<'_>> {
        let mut list = Params::default();
        self.declare(extent, unit, &mut list);
        list.finish()
    }

    /// The same with every number in the range of its parameter, however it was set.
    #[must_use]
    pub fn clamped(&self) -> Self {
        let mut clamped = self.clone();
        clamped.declare(0.0..=1.0, "", &mut Params::clamping());
        clamped
    }

    fn declare<'a>(&'a mut self, extent: RangeInclusive<f32>, unit: &'static str, list: &mut Params<'a>) {
        let middle = 0.5 * (extent.start() + extent.end());
        list.section("section", |list| {
            list.head("show", "Section plane", "Cut away what lies beyond a plane, in its direction.", &mut self.show);
            list.choice(
                "axis",
                "Axis",
                "The axis of the file that the plane is perpendicular to, or any direction.",
                &mut self.axis,
            );
            list.when("section.axis", Axis::Free, |list| {
                list.number(
                    "azimuth",
                    "Azimuth",
                    "°",
                    -180.0..=180.0,
                    "Direction of the plane: 0 faces the front of the model, 90 its right.",
                    &mut self.azimuth,
                );
                list.number(
                    "elevation",
                    "Elevation",
                    "°",
                    -90.0..=90.0,
                    "Direction of the plane: 90 faces straight up.",
                    &mut self.elevation,
                );
            });
            list.wide_number(
                "position",
                "Position",
                unit,
                extent,
                -MOST..=MOST,
                "Where the plane is along its direction, in units of the model; what lies farther along is cut away, unless flipped.",
                StyleField::Inheriting {
                    own: &mut self.position,
                    inherited: middle,
                    from: "the middle of the model".to_owned(),
                },
            );
            list.switch("flip", "Flip", "Cut away what lies before the plane instead.", &mut self.flip);
            list.choice(
                "cap",
                "Cap",
                "What fills the cut through a solid; surfaces that enclose nothing have no cap.",
                &mut self.cap,
            );
            list.color("color", "Cap color", "Color of the caps.", &mut self.color);
            list.switch(
                "lit",
                "Shade caps",
                "Shade caps as their object is shaded; otherwise they have their color as it is.",
                &mut self.lit,
            );
            list.when("section.cap", Fill::Hatched, |list| {
                list.section("hatch", |list| self.hatch.params(list));
            });
        });
    }
}

/// The farthest position that is accepted.
const MOST: f32 = 1e9;

impl Document {
    /// A warning where the section plane lies beyond a model with this box around it: it cuts nothing, or leaves nothing.
    pub fn section_fault(&self, up: Up, bounds: &Bounds) -> Option<Warning> {
        let section = &self.section;
        let position = f64::from(section.position.filter(|_| section.show && !bounds.is_empty())?);
        let [low, high] = section.range(up, bounds);
        let is_beyond = if position >= high {
            true
        } else if position <= low {
            false
        } else {
            return None;
        };
        let effect = if is_beyond == section.flip {
            "nothing is left; move the plane or flip it"
        } else {
            "nothing is cut; move the plane"
        };
        let reach = format!("the model reaches from {low:.6} to {high:.6} along the plane's direction");
        Some(Warning {
            place: "section.position".to_owned(),
            message: format!("{position}: {reach}, so {effect}"),
        })
    }
}

/// A warning where a section cuts bodies that have no cap.
pub fn without_caps(count: usize) -> Option<Warning> {
    let bodies = if count == 1 {
        "1 body that is cut encloses"
    } else {
        &format!("{count} bodies that are cut enclose")
    };
    let message = format!(
        "{bodies} no volume and has no cap; wider `view.seams=gap` may close it, or the model has holes there"
    );
    (count > 0).then(|| Warning { place: "section.cap".to_owned(), message })
}

impl Hatch {
    fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.color("color", "Color", "Color of the hatching.", &mut self.color);
        list.wide_number(
            "spacing",
            "Spacing",
            "px",
            4.0..=40.0,
            2.0..=200.0,
            "Distance of the lines; the same everywhere in the picture.",
            &mut self.spacing,
        );
        list.wide_number(
            "width",
            "Width",
            "px",
            0.5..=6.0,
            0.25..=32.0,
            "Width of the lines.",
            &mut self.width,
        );
        list.number(
            "angle",
            "Angle",
            "°",
            -90.0..=90.0,
            "Direction of the lines in the plane; objects that touch each other differ.",
            &mut self.angle,
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOX: Bounds = Bounds { min: DVec3::new(-1.0, 0.0, 2.0), max: DVec3::new(3.0, 1.0, 4.0) };

    #[test]
    fn the_plane_is_in_the_middle_until_it_is_placed() {
        let mut section = SectionSettings { show: true, ..SectionSettings::default() };
        for (axis, middle) in [(Axis::X, 1.0), (Axis::Y, 0.5), (Axis::Z, 3.0)] {
            section.axis = axis;
            let plane = section.plane(Up::PosY, &BOX).unwrap();
            assert_eq!(plane.point.dot(plane.normal), middle);
        }
        section.position = Some(2.25);
        let plane = section.plane(Up::PosY, &BOX).unwrap();
        assert_eq!((plane.point.z, plane.normal), (2.25, DVec3::Z));
        section.flip = true;
        let plane = section.plane(Up::PosY, &BOX).unwrap();
        assert_eq!((plane.point.z, plane.normal), (2.25, DVec3::NEG_Z));
        section.show = false;
        assert_eq!(section.plane(Up::PosY, &BOX), None);
    }

    #[test]
    fn a_plane_beyond_the_model_is_told() {
        let section = SectionSettings { show: true, position: Some(0.5), ..SectionSettings::default() };
        let mut document = Document { section, ..Document::default() };
        let mut fault = |position, flip| {
            (document.section.position, document.section.flip) = (Some(position), flip);
            document.section_fault(Up::PosY, &BOX).map(|w| w.to_string())
        };
        assert_eq!(fault(0.5, false), None);
        let told = [
            (7.0, false, "nothing is cut"),
            (7.0, true, "nothing is left"),
            (-1.0, false, "nothing is left"),
            (-1.0, true, "nothing is cut"),
        ];
        for (position, flip, effect) in told {
            let message = fault(position, flip).unwrap();
            assert!(message.contains("from 0.000000 to 1.000000") && message.contains(effect), "{message}");
        }
        document.section.show = false;
        assert_eq!(document.section_fault(Up::PosY, &BOX), None);
    }

    #[test]
    fn a_free_plane_reaches_over_the_whole_box() {
        let mut section =
            SectionSettings { show: true, axis: Axis::Free, elevation: 35.0, ..SectionSettings::default() };
        for up in Up::ALL {
            let direction = section.direction(up);
            assert!((direction.length() - 1.0).abs() < 1e-12);
            let [low, high] = section.range(up, &BOX);
            let outside =
                BOX.corners().map(|c| c.dot(direction)).map(|d| d - low >= -1e-9 && high - d >= -1e-9);
            assert!(outside.iter().all(|inside| *inside));
        }
        (section.azimuth, section.elevation) = (0.0, 0.0);
        assert_eq!(section.direction(Up::PosY), DVec3::Z);
        (section.azimuth, section.elevation) = (90.0, 0.0);
        assert!((section.direction(Up::PosY) - DVec3::X).length() < 1e-12);
        section.elevation = 90.0;
        assert!((section.direction(Up::PosZ) - DVec3::Z).length() < 1e-12);
        assert_eq!(section.range(Up::PosY, &Bounds::EMPTY), [0.0, 1.0]);
    }
}
