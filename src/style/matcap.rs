//! Matcap: a picture of a shaded sphere that says how a surface looks in each direction (Sloan et al. 2001, "The Lit Sphere").

use std::path::{Path, PathBuf};

use super::param::Params;
use super::slot::choice;

/// Parameters of the technique `matcap`.
#[derive(Debug, Clone, PartialEq)]
pub struct Matcap {
    /// The sphere.
    pub sphere: Sphere,
    /// The image of [`Sphere::Image`]: a square picture of a sphere that touches its border. Without one there is clay.
    pub image: Option<PathBuf>,
    /// How far the sphere is multiplied by the object's own color.
    pub object_color: f32,
    /// How dark cast shadows are; 0: not at all, 1: black.
    pub shadow: f32,
}

choice! {
    /// A picture of a shaded sphere.
    pub enum Sphere {
        /// Warm modeling clay under soft light: shows form best.
        #[default]
        Clay,
        /// White glaze with cool shadows.
        Porcelain,
        /// Polished steel between sky and ground.
        Metal,
        /// Green stone that light shines through.
        Jade,
        /// An image.
        Image,
    }
}

impl Default for Matcap {
    fn default() -> Self {
        Self { sphere: Sphere::default(), image: None, object_color: 0.0, shadow: 0.6 }
    }
}

impl Matcap {
    /// The image of the sphere, if it is one.
    pub fn sphere_image(&self) -> Option<&Path> {
        self.image.as_deref().filter(|_| self.sphere == Sphere::Image)
    }

    pub(super) fn params<'a>(&'a mut self, list: &mut Params<'a>) {
        list.choice("sphere", "Sphere", "How surfaces look from each side.", &mut self.sphere);
        list.when("matcap.sphere", Sphere::Image, |list| {
            list.file(
                "image",
                "Image",
                "A square picture of a lit sphere that touches the border.",
                &mut self.image,
            );
        });
        let own_color = "How far the sphere is multiplied by the object's own color.";
        list.share("object_color", "Object color", own_color, &mut self.object_color);
        list.formerly("own_color");
        list.share("shadow", "Shadow", "How dark cast shadows are.", &mut self.shadow);
    }
}
