//! The folder of the cache: where it is, and what is removed from it.

use std::ffi::OsString;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use super::file::PART;

/// Results end so; nothing else in the folder is touched.
pub(super) const ENDING: &str = "result";
/// Older files that were never finished belong to a program that has ended.
const ABANDONED: Duration = Duration::from_secs(24 * 60 * 60);

/// `hachure` in the user's cache folder; `variable`: gives environment variables.
pub(super) fn of_user(variable: impl Fn(&str) -> Option<OsString>) -> Option<PathBuf> {
    // A relative path would be another folder for each place that the program is started in.
    let absolute = |name: &str| variable(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let folder = if cfg!(target_os = "windows") {
        absolute("LOCALAPPDATA")
    } else if cfg!(target_os = "macos") {
        absolute("HOME").map(|home| home.join("Library").join("Caches"))
    } else {
        absolute("XDG_CACHE_HOME").or_else(|| absolute("HOME").map(|home| home.join(".cache")))
    };
    folder.map(|folder| folder.join("hachure"))
}

/// Notes that a file was needed now.
pub(super) fn mark_as_used(path: &Path) {
    let marked = File::options().write(true).open(path).and_then(|file| file.set_modified(SystemTime::now()));
    if let Err(error) = marked {
        log::debug!("{}: {error}; its use is not noted", path.display());
    }
}

/// A result in the folder.
struct Entry {
    path: PathBuf,
    used: SystemTime,
    size: u64,
}

/// Removes the least recently used results until all others are no larger than `limit` bytes together; `but`: is about to be
/// replaced, and neither counted nor removed.
pub(super) fn make_room(folder: &Path, but: &Path, limit: u64) -> io::Result<()> {
    let mut entries = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        // Another program may have removed it meanwhile.
        let Ok((entry, about)) = entry.and_then(|entry| entry.metadata().map(|about| (entry, about))) else {
            continue;
        };
        let path = entry.path();
        let used = about.modified().unwrap_or(SystemTime::UNIX_EPOCH);
        let ending = path.extension().unwrap_or_default();
        if !about.is_file() || path == but {
            continue;
        }
        if ending == ENDING {
            entries.push(Entry { path, used, size: about.len() });
        } else if ending == PART && used.elapsed().is_ok_and(|age| age > ABANDONED) {
            remove(&path);
        }
    }
    entries.sort_by(|a, b| b.used.cmp(&a.used).then_with(|| a.path.cmp(&b.path)));
    let mut sum = 0u64;
    for entry in entries {
        sum = sum.saturating_add(entry.size);
        if sum > limit {
            remove(&entry.path);
        }
    }
    Ok(())
}

fn remove(path: &Path) {
    if let Err(error) = std::fs::remove_file(path) {
        log::debug!("{}: {error}; it stays in the cache", path.display());
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn the_folder_follows_the_environment() {
        let with = |pairs: &'static [(&str, &str)]| {
            of_user(move |name| pairs.iter().find(|(key, _)| *key == name).map(|(_, value)| value.into()))
        };
        let at = |path: &str| Some(PathBuf::from(path));
        assert_eq!(with(&[("XDG_CACHE_HOME", "/c"), ("HOME", "/h")]), at("/c/hachure"));
        assert_eq!(with(&[("XDG_CACHE_HOME", "c"), ("HOME", "/h")]), at("/h/.cache/hachure"));
        assert_eq!(with(&[("HOME", "")]), None);
    }
}
