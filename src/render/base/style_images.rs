//! The images that styles name, and what effects made of them.

use std::any::{Any, TypeId};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use crate::scene::{Images, Texture};

/// What was made of one image: made once, whoever asks first.
type Made = Arc<OnceLock<Arc<dyn Any + Send + Sync>>>;

/// Decoded images by path, with what was made of them. Clones share both.
#[derive(Clone, Default)]
pub struct StyleImages {
    images: Images,
    made: Arc<Mutex<HashMap<(PathBuf, TypeId), Made>>>,
}

impl StyleImages {
    /// Takes images over.
    pub fn new(images: Images) -> Self {
        Self { images, ..Self::default() }
    }

    /// The same with what was made before of those images that are the same.
    #[must_use]
    pub fn knowing(self, before: &Self) -> Self {
        let known = before.made.lock().unwrap_or_else(PoisonError::into_inner);
        let is_same =
            |path: &Path| self.images.contains_key(path) && self.images.get(path) == before.images.get(path);
        let made = known.iter().filter(|((path, _), _)| is_same(path));
        let made = made.map(|(key, made)| (key.clone(), Arc::clone(made))).collect();
        Self { images: self.images, made: Arc::new(Mutex::new(made)) }
    }

    /// All of them.
    pub fn all(&self) -> &Images {
        &self.images
    }

    /// What `make` makes of one of them, if it could be loaded; what one effect makes of an image has a type of its own. Later
    /// calls find it ready.
    pub fn made<T: Any + Send + Sync>(
        &self,
        path: &Path,
        make: impl FnOnce(&Texture) -> T,
    ) -> Option<Arc<T>> {
        let image = self.images.get(path)?;
        let key = (path.to_owned(), TypeId::of::<T>());
        let made =
            Arc::clone(self.made.lock().unwrap_or_else(PoisonError::into_inner).entry(key).or_default());
        // Outside of the lock: some take a second.
        let value = Arc::clone(made.get_or_init(|| Arc::new(make(image))));
        value.downcast().ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn images(width: u32) -> StyleImages {
        let rgba: Arc<[u8]> = vec![255; 4 * width as usize].into();
        let image = Texture { name: String::new(), width, height: 1, rgba };
        StyleImages::new([(PathBuf::from("a"), Arc::new(image))].into())
    }

    #[test]
    fn what_is_made_of_an_image_is_made_once_and_lost_with_it() {
        let first = images(3);
        let made = first.made(Path::new("a"), |image| image.width).unwrap();
        assert_eq!((*made, first.made(Path::new("b"), |image| image.width)), (3, None));
        let same = images(3).knowing(&first);
        assert!(Arc::ptr_eq(&made, &same.made(Path::new("a"), |_| unreachable!()).unwrap()));
        let other = images(4).knowing(&first);
        assert_eq!(*other.made(Path::new("a"), |image| image.width).unwrap(), 4);
    }
}
