//! The images that styles name, and what was made of them.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

use glam::Vec4;

use super::effects::halftone::threshold_map::ThresholdMap;
use crate::document::ImageUse;
use crate::scene::{Images, Texture};
use crate::style::toon::MAX_RAMP;

/// Decoded images by path, with the ramps and halftone textures that they are. Clones share the images.
#[derive(Debug, Clone, Default)]
pub struct StyleImages {
    images: Images,
    ramps: BTreeMap<PathBuf, OnceLock<Arc<[Vec4]>>>,
    threshold_maps: BTreeMap<PathBuf, OnceLock<Arc<ThresholdMap>>>,
}

impl StyleImages {
    /// Takes images over; what is made of them is made when it is asked for, or by [`Self::prepare`].
    pub fn new(images: Images) -> Self {
        let ramps = images.keys().map(|path| (path.clone(), OnceLock::new())).collect();
        let threshold_maps = images.keys().map(|path| (path.clone(), OnceLock::new())).collect();
        Self { images, ramps, threshold_maps }
    }

    /// The same with what was made before of those images that are the same.
    #[must_use]
    pub fn knowing(mut self, before: &Self) -> Self {
        for (path, image) in &self.images {
            if before.images.get(path) != Some(image) {
                continue;
            }
            if let Some(known) = before.threshold_maps.get(path) {
                self.threshold_maps.insert(path.clone(), known.clone());
            }
        }
        self
    }

    /// Makes what takes long: the threshold map of each halftone texture, about a second on two cores. Later calls find
    /// it ready.
    pub fn prepare(&self, uses: &[ImageUse]) {
        for path in uses.iter().filter(|u| u.key == "halftone.image").filter_map(|u| u.path.as_deref()) {
            self.threshold_map(path);
        }
    }

    /// All of them.
    pub fn all(&self) -> &Images {
        &self.images
    }

    /// One of them, if it could be loaded.
    pub fn get(&self, path: &Path) -> Option<&Arc<Texture>> {
        self.images.get(path)
    }

    /// One of them as a ramp: linear colours along its longer side, from the left or the top, each the mean across the
    /// other side; at most [`MAX_RAMP`].
    pub fn ramp(&self, path: &Path) -> Option<Arc<[Vec4]>> {
        let image = self.images.get(path)?;
        let size = if image.width >= image.height { [MAX_RAMP, 1] } else { [1, MAX_RAMP] };
        Some(self.ramps.get(path)?.get_or_init(|| image.averaged(size).into()).clone())
    }

    /// One of them as a halftone texture.
    pub fn threshold_map(&self, path: &Path) -> Option<Arc<ThresholdMap>> {
        let image = self.images.get(path)?;
        Some(self.threshold_maps.get(path)?.get_or_init(|| Arc::new(ThresholdMap::of_image(image))).clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_runs_along_the_longer_side_and_is_averaged_across() {
        let rgba: Vec<u8> = [0_u8, 255, 0, 255, 255, 255].iter().flat_map(|v| [*v, *v, *v, 255]).collect();
        let image = |width, height| Texture { name: String::new(), width, height, rgba: rgba.clone().into() };
        let ramp = |width, height| {
            let images = StyleImages::new([(PathBuf::from("a"), Arc::new(image(width, height)))].into());
            let ramp = images.ramp(Path::new("a")).unwrap();
            ramp.iter().map(|c| c.x).collect::<Vec<_>>()
        };
        assert_eq!(ramp(6, 1), [0.0, 1.0, 0.0, 1.0, 1.0, 1.0]);
        assert_eq!(ramp(3, 2), [0.5, 1.0, 0.5]);
        assert_eq!(ramp(2, 3), [0.5, 0.5, 1.0]);
        assert_eq!(StyleImages::default().ramp(Path::new("a")), None);
    }
}
