//! Results that take long, kept in the user's cache folder.
//!
//! A result is bytes under a [`Key`], which is made from everything that the result depends on. Nothing here ever fails: a
//! file that is missing, cut off or not ours is no result, a folder that cannot be written keeps nothing.

mod file;
mod folder;

use std::hash::Hasher;
use std::io;
use std::path::{Path, PathBuf};

use siphasher::sip128::{Hasher128, SipHasher24};

/// Where results are kept. Clones share the folder.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Cache {
    folder: Option<PathBuf>,
    limit: u64,
}

/// All results together are no larger than this, in bytes: 1 GiB.
pub const LIMIT: u64 = 1 << 30;

impl Cache {
    /// The one in the user's cache folder; [`Cache::nowhere`] if there is none.
    pub fn of_user() -> Self {
        let folder = folder::of_user(|name| std::env::var_os(name));
        if folder.is_none() {
            log::debug!("there is no cache folder: results are made anew each time");
        }
        Self { folder, limit: LIMIT }
    }

    /// One in a folder of its own, with results of no more than `limit` bytes together.
    pub fn at(folder: &Path, limit: u64) -> Self {
        Self { folder: Some(folder.to_owned()), limit }
    }

    /// One that keeps nothing.
    pub fn nowhere() -> Self {
        Self::default()
    }

    /// The result under a key, if there is a whole one.
    pub fn load(&self, key: Key) -> Option<Vec<u8>> {
        let path = self.path(key)?;
        match file::read(&path, key, self.limit) {
            Ok(bytes) => {
                folder::mark_as_used(&path);
                Some(bytes)
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            Err(error) => {
                log::debug!("{}: {error}; it is made anew", path.display());
                None
            }
        }
    }

    /// Keeps a result; the least recently used ones make room for it.
    pub fn store(&self, key: Key, bytes: &[u8]) {
        let Some((folder, path)) = self.folder.as_ref().zip(self.path(key)) else { return };
        let size = file::size(bytes);
        if size > self.limit {
            log::debug!("a result of {size} bytes is too large for the cache");
            return;
        }
        let written = std::fs::create_dir_all(folder).and_then(|()| {
            // Before, so that the limit holds at any time.
            folder::make_room(folder, &path, self.limit - size)?;
            file::write(&path, key, bytes)
        });
        if let Err(error) = written {
            log::warn!("{}: {error}; the result is not kept", path.display());
        }
    }

    fn path(&self, key: Key) -> Option<PathBuf> {
        Some(self.folder.as_ref()?.join(format!("{:032x}.{}", key.0, folder::ENDING)))
    }
}

/// What a result is found by: a hash of what it depends on, the same on all systems and in all versions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Key(u128);

/// Makes a key of one thing after the other. Order matters, and where one thing ends.
#[derive(Debug, Clone)]
pub struct KeyMaker(SipHasher24);

impl KeyMaker {
    /// `kind`: what the results are; `version`: raised whenever the same inputs give another result.
    #[must_use]
    pub fn new(kind: &str, version: u32) -> Self {
        Self(SipHasher24::new()).bytes(kind.as_bytes()).bytes(&version.to_le_bytes())
    }

    /// Adds bytes.
    #[must_use]
    pub fn bytes(mut self, bytes: &[u8]) -> Self {
        self.0.write(&(bytes.len() as u64).to_le_bytes());
        self.0.write(bytes);
        self
    }

    /// Adds numbers, bit by bit: 0 and −0 differ.
    #[must_use]
    pub fn numbers(mut self, numbers: &[f32]) -> Self {
        self.0.write(&(numbers.len() as u64).to_le_bytes());
        for number in numbers {
            self.0.write(&number.to_bits().to_le_bytes());
        }
        self
    }

    /// Adds whole numbers.
    #[must_use]
    pub fn integers(mut self, numbers: &[u64]) -> Self {
        self.0.write(&(numbers.len() as u64).to_le_bytes());
        for number in numbers {
            self.0.write(&number.to_le_bytes());
        }
        self
    }

    /// The key of all that was added.
    #[must_use]
    pub fn key(&self) -> Key {
        Key(self.0.finish128().as_u128())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(name: &str) -> Key {
        KeyMaker::new("test", 1).bytes(name.as_bytes()).key()
    }

    #[test]
    fn what_is_stored_is_loaded_under_its_key_alone() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::at(&folder.path().join("deeper"), LIMIT);
        assert_eq!(cache.load(key("a")), None);
        cache.store(key("a"), b"one");
        cache.store(key("a"), b"two");
        cache.store(key("empty"), b"");
        assert_eq!(cache.load(key("a")).as_deref(), Some(b"two".as_slice()));
        assert_eq!(cache.load(key("empty")).as_deref(), Some(b"".as_slice()));
        assert_eq!(cache.load(key("b")), None);
    }

    #[test]
    fn keys_stay_as_they_are_and_tell_things_apart() {
        let maker = KeyMaker::new("test", 1);
        assert_eq!(maker.clone().bytes(b"ab").numbers(&[1.5]).key(), Key(KNOWN));
        let other = KeyMaker::new("test", 2);
        let keys = [
            maker.key(),
            other.key(),
            maker.clone().bytes(b"a").bytes(b"b").key(),
            maker.clone().bytes(b"ab").key(),
            maker.clone().bytes(b"").bytes(b"ab").key(),
            maker.clone().numbers(&[0.0]).key(),
            maker.clone().numbers(&[-0.0]).key(),
            maker.clone().integers(&[0]).key(),
        ];
        for (i, key) in keys.iter().enumerate() {
            assert!(!keys[..i].contains(key), "{i}");
        }
    }

    /// From the published algorithm, computed by another program. Were it to change, older results would be lost.
    const KNOWN: u128 = 0xf3a7_bdab_f098_6259_84d6_cba1_58a8_aae3;

    #[test]
    fn damaged_and_foreign_files_are_no_results() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::at(folder.path(), LIMIT);
        cache.store(key("a"), &[7; 1000]);
        let path = cache.path(key("a")).unwrap();
        let whole = std::fs::read(&path).unwrap();
        let mut damaged: Vec<Vec<u8>> = [0, 1, 10, 40, whole.len() - 1].map(|n| whole[..n].to_vec()).into();
        damaged.push([whole.as_slice(), b"more"].concat());
        for at in [0, 5, 12, 25, 33, 50, whole.len() - 1] {
            let mut bytes = whole.clone();
            bytes[at] ^= 1;
            damaged.push(bytes);
        }
        for bytes in damaged {
            std::fs::write(&path, &bytes).unwrap();
            assert_eq!(cache.load(key("a")), None);
        }
        // A whole file of another key.
        std::fs::write(cache.path(key("b")).unwrap(), &whole).unwrap();
        assert_eq!(cache.load(key("b")), None);
        // A folder in its place.
        std::fs::remove_file(&path).unwrap();
        std::fs::create_dir(&path).unwrap();
        assert_eq!(cache.load(key("a")), None);
        cache.store(key("a"), b"one");
        std::fs::remove_dir(&path).unwrap();
        cache.store(key("a"), b"one");
        assert_eq!(cache.load(key("a")).as_deref(), Some(b"one".as_slice()));
    }

    #[test]
    fn the_least_recently_used_make_room() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::at(folder.path(), 4500);
        let names = ["a", "b", "c", "d"];
        for (age, name) in names.iter().enumerate() {
            cache.store(key(name), &[1; 1000]);
            let file = std::fs::File::options().write(true).open(cache.path(key(name)).unwrap()).unwrap();
            let used = std::time::SystemTime::now() - std::time::Duration::from_secs(1000 - age as u64);
            file.set_modified(used).unwrap();
        }
        std::fs::write(folder.path().join("not ours"), [0; 9000]).unwrap();
        // Used last, although stored first.
        assert!(cache.load(key("a")).is_some());
        cache.store(key("e"), &[2; 2000]);
        let kept = ["a", "b", "c", "d", "e"].map(|name| cache.load(key(name)).is_some());
        assert_eq!(kept, [true, false, false, true, true]);
        cache.store(key("huge"), &[3; 5000]);
        assert_eq!(cache.load(key("huge")), None);
        assert!(cache.load(key("e")).is_some() && folder.path().join("not ours").exists());
    }

    #[test]
    fn a_folder_that_cannot_be_is_no_error() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        std::fs::write(&file, b"").unwrap();
        for cache in [Cache::at(&file.join("below"), LIMIT), Cache::nowhere()] {
            cache.store(key("a"), b"one");
            assert_eq!(cache.load(key("a")), None);
        }
    }
}
