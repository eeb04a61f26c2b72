//! The images that styles name, each read again only when its file has changed.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

use super::{ImportError, Progress, load_image};
use crate::document::ImageUse;
use crate::scene::{Images, Texture, Warning};

/// What became of each image file when it was last read.
#[derive(Debug, Clone, Default)]
pub struct ImageCache {
    read: BTreeMap<PathBuf, Read>,
}

#[derive(Debug, Clone)]
struct Read {
    stamp: Option<Stamp>,
    result: Result<Arc<Texture>, String>,
}

/// Time of the last change, and bytes.
type Stamp = (SystemTime, u64);

fn stamp(path: &Path) -> Option<Stamp> {
    let metadata = std::fs::metadata(path).ok()?;
    Some((metadata.modified().ok()?, metadata.len()))
}

impl ImageCache {
    /// The images that `uses` name: those that are here and whose files did not change, the others read. Whoever has a
    /// window calls this beside it.
    ///
    /// # Errors
    /// Only when the person stopped it; what could not be read is in [`Self::warnings`].
    pub fn read(&self, uses: &[ImageUse], progress: &Progress) -> Result<Self, ImportError> {
        let mut next = Self::default();
        for path in uses.iter().filter_map(|u| u.path.as_ref()) {
            progress.check()?;
            if next.read.contains_key(path) {
                continue;
            }
            let stamp = stamp(path);
            let known = self.read.get(path).filter(|r| r.stamp == stamp && r.stamp.is_some());
            let read = known.cloned().unwrap_or_else(|| Read {
                stamp,
                result: load_image(path).map(Arc::new).map_err(|e| e.to_string()),
            });
            next.read.insert(path.clone(), read);
        }
        Ok(next)
    }

    /// Those that could be read.
    pub fn images(&self) -> Images {
        let image = |(path, read): (&PathBuf, &Read)| Some((path.clone(), read.result.clone().ok()?));
        self.read.iter().filter_map(image).collect()
    }

    /// What is missing, and where it is named.
    pub fn warnings(&self, uses: &[ImageUse]) -> Vec<Warning> {
        let warning = |u: &ImageUse| {
            let message = match &u.path {
                None => "names no image. What is built in is drawn; name a PNG or JPEG file".to_owned(),
                Some(path) => {
                    let error = self.read.get(path)?.result.as_ref().err()?;
                    format!("{error}. What is built in is drawn instead; name another PNG or JPEG file")
                }
            };
            Some(Warning { place: u.place.clone(), message })
        };
        uses.iter().filter_map(warning).collect()
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    fn write(path: &Path, gray: u8, seconds: u64) {
        ::image::GrayImage::from_pixel(2, 1, ::image::Luma([gray])).save(path).unwrap();
        let time = SystemTime::UNIX_EPOCH + Duration::from_secs(seconds);
        std::fs::File::open(path).unwrap().set_modified(time).unwrap();
    }

    #[test]
    fn a_file_is_read_again_only_when_it_changed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let uses =
            [ImageUse { place: "toon.image".into(), key: "toon.image".into(), path: Some(path.clone()) }];
        let progress = Progress::default();
        write(&path, 7, 1000);
        let first = ImageCache::default().read(&uses, &progress).unwrap();
        assert_eq!(first.images()[&path].rgba[0], 7);
        let same = first.read(&uses, &progress).unwrap();
        assert!(Arc::ptr_eq(&first.images()[&path], &same.images()[&path]));
        write(&path, 9, 2000);
        let second = same.read(&uses, &progress).unwrap();
        assert_eq!(second.images()[&path].rgba[0], 9);
        assert!(second.read(&[], &progress).unwrap().images().is_empty(), "what nobody names is forgotten");
        std::fs::remove_file(&path).unwrap();
        let gone = second.read(&uses, &progress).unwrap();
        assert!(gone.images().is_empty());
        let said = gone.warnings(&uses)[0].to_string();
        assert!(said.starts_with("toon.image: cannot read ") && said.contains("name another PNG"), "{said}");
        write(&path, 9, 2000);
        assert!(gone.read(&uses, &progress).unwrap().warnings(&uses).is_empty());
    }

    #[test]
    fn an_image_that_is_asked_for_and_not_named_is_a_warning() {
        let uses = [ImageUse { place: "/crank, toon.image".into(), key: "toon.image".into(), path: None }];
        let said = ImageCache::default().warnings(&uses)[0].to_string();
        assert!(said.starts_with("/crank, toon.image: names no image"), "{said}");
    }
}
