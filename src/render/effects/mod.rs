//! What an object looks like: one file per effect, named as its style and its shader, and what several share.

pub mod blended;
pub mod blueprint;
pub mod gooch;
pub mod halftone;
pub mod hatching;
pub mod hidden;
pub mod layered;
pub mod matcap;
pub mod mirror;
pub mod opaque;
pub mod section;
pub mod sketch;
pub mod surface;
pub mod technique;
pub mod techniques;
pub mod toon;
pub mod translucent;

use super::base::style_images::StyleImages;
use crate::document::ImageUse;
use crate::scene::Warning;

/// Images that styles name and that are not what they should be.
pub fn image_faults(images: &StyleImages, uses: &[ImageUse]) -> Vec<Warning> {
    let fault = |used: &ImageUse| {
        let path = used.path.as_ref().filter(|_| used.key == "hatching.own.image")?;
        let error = hatching::stroke_image_fault(images.all().get(path)?)?;
        Some(Warning {
            place: used.place.clone(),
            message: format!("{error}. A pen's strokes are drawn instead"),
        })
    };
    uses.iter().filter_map(fault).collect()
}

/// Makes what takes long of the images that styles name, before it is asked for.
pub fn prepare_images(images: &StyleImages, uses: &[ImageUse]) {
    for ImageUse { key, path, .. } in uses {
        let Some(path) = path else { continue };
        techniques::prepare_image(images, key, path);
        sketch::prepare_image(images, key, path);
    }
}
