//! Pure line drawings, and how much ink is where.

use std::sync::Arc;

use glam::DVec2;
use hachure::export::Session;
use hachure::export::session::Opened;
use hachure::geometry::EdgeClass;
use hachure::render::Picture;
use hachure::scene::{Camera, Scene};

use super::{set, texels};

/// Lines without surfaces.
pub fn line_drawing(scene: &Arc<Scene>, camera: Camera) -> Opened {
    let mut opened = Opened { document: Default::default(), scene: Arc::clone(scene) };
    opened.document.camera = Some(camera);
    set(&mut opened, "technique", "blank");
    for class in EdgeClass::ALL {
        set(&mut opened, &format!("edges.{}.width", <&str>::from(class)), "inherit");
    }
    opened
}

/// Draws these classes and no others.
pub fn only(opened: &mut Opened, classes: &[EdgeClass]) {
    for class in EdgeClass::ALL {
        let key = format!("edges.{}.show", <&str>::from(class));
        set(opened, &key, if classes.contains(&class) { "true" } else { "false" });
    }
}

/// Makes all lines this wide, in pixels of a picture of that height.
pub fn set_width(opened: &mut Opened, px: f64, height: u32) {
    let width = px * 1080.0 / f64::from(height);
    assert!(width <= 64.0, "wider than a line can be");
    for group in ["profile", "inner"] {
        set(opened, &format!("edges.{group}.width"), &format!("{width}"));
    }
}

/// Share of each pixel that has ink.
#[derive(Clone)]
pub struct Ink {
    pub size: [u32; 2],
    pub values: Vec<f64>,
}

impl Ink {
    /// Draws the scene that was set, without paper: what is opaque is ink.
    pub fn of(session: &mut Session, opened: &Opened, size: [u32; 2]) -> Self {
        let picture = session.image(opened, size, true).unwrap();
        Self { size, values: picture.pixels().map(|p| f64::from(p.0[3]) / 255.0).collect() }
    }

    /// The ink of a pixel; none outside of the picture.
    pub fn at(&self, x: i32, y: i32) -> f64 {
        let [width, height] = self.size.map(|side| side as i32);
        let inside = (0..width).contains(&x) && (0..height).contains(&y);
        if inside { self.values[(y * width + x) as usize] } else { 0.0 }
    }

    /// Interpolated between the centers of pixels.
    pub fn sampled(&self, at: DVec2) -> f64 {
        let corner = (at - 0.5).floor();
        let f = at - 0.5 - corner;
        let (x, y) = (corner.x as i32, corner.y as i32);
        let row = |y: i32| self.at(x, y) * (1.0 - f.x) + self.at(x + 1, y) * f.x;
        row(y) * (1.0 - f.y) + row(y + 1) * f.y
    }

    /// The most ink within a pixel of this place.
    pub fn near(&self, at: DVec2) -> f64 {
        let (x, y) = (at.x.floor() as i32, at.y.floor() as i32);
        let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy)));
        around.map(|(dx, dy)| self.at(x + dx, y + dy)).fold(0.0, f64::max)
    }

    /// The paper that is joined to the upper left corner, not passing pixels that have ink by half.
    pub fn paper_from_corner(&self) -> Vec<bool> {
        let [width, height] = self.size.map(|side| side as i32);
        let mut reached = vec![false; self.values.len()];
        let mut open = vec![(0, 0)];
        while let Some((x, y)) = open.pop() {
            let inside = (0..width).contains(&x) && (0..height).contains(&y);
            if inside && self.at(x, y) < 0.5 && !reached[(y * width + x) as usize] {
                reached[(y * width + x) as usize] = true;
                open.extend([(x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)]);
            }
        }
        reached
    }
}

/// The class of the edge at each pixel of the edge map, and the object that draws it.
pub fn edge_classes(session: &mut Session, picture: &Picture) -> Vec<Option<(EdgeClass, u32)>> {
    let Some(edge_map) = super::captured(session, "edge map") else {
        return vec![None; (picture.image.size()[0] * picture.image.size()[1]) as usize];
    };
    let edge = |[what, object, ..]: [u32; 4]| {
        let class = (what >> 28).checked_sub(1)?;
        Some((EdgeClass::ALL[class as usize], object))
    };
    texels::<[u32; 4]>(session, &edge_map).into_iter().map(edge).collect()
}
