//! One result in one file: a head that says what it is, and its bytes.

use std::fs::File;
use std::hash::Hasher;
use std::io::{self, Read, Write};
use std::path::Path;
use std::sync::atomic::{AtomicU32, Ordering};

use siphasher::sip128::{Hasher128, SipHasher13};

use super::Key;

/// Begins each file. The last character is the version of the head.
const MAGIC: [u8; 8] = *b"hachure1";
/// Magic, key, number of bytes and their hash.
const HEAD: usize = 8 + 16 + 8 + 16;

/// Size of the file for a result, in bytes.
pub(super) fn size(bytes: &[u8]) -> u64 {
    (HEAD + bytes.len()) as u64
}

fn head(key: Key, bytes: &[u8]) -> [u8; HEAD] {
    let mut hasher = SipHasher13::new();
    hasher.write(bytes);
    let (length, hash) = ((bytes.len() as u64).to_le_bytes(), hasher.finish128().as_u128().to_le_bytes());
    let parts = MAGIC.into_iter().chain(key.0.to_le_bytes()).chain(length).chain(hash);
    let mut head = [0; HEAD];
    head.iter_mut().zip(parts).for_each(|(byte, part)| *byte = part);
    head
}

/// Reads a result of no more than `limit` bytes.
pub(super) fn read(path: &Path, key: Key, limit: u64) -> io::Result<Vec<u8>> {
    let mut found = [0; HEAD];
    let mut file = File::open(path)?;
    let length = file.metadata()?.len();
    file.read_exact(&mut found)?;
    if length > limit {
        return Err(io::Error::other("the file is larger than the cache"));
    }
    let mut bytes = Vec::with_capacity(length as usize);
    file.take(limit).read_to_end(&mut bytes)?;
    if found == head(key, &bytes) {
        Ok(bytes)
    } else {
        Err(io::Error::other("the file is damaged or not ours"))
    }
}

/// Files that are being written end so.
pub(super) const PART: &str = "part";

/// Writes a result beside its place and renames it, so that nobody ever sees half of it.
pub(super) fn write(path: &Path, key: Key, bytes: &[u8]) -> io::Result<()> {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    // Other threads and programs write too.
    let number = COUNT.fetch_add(1, Ordering::Relaxed);
    let part = path.with_extension(format!("{}-{number}.{PART}", std::process::id()));
    let written = File::create(&part)
        .and_then(|mut file| file.write_all(&head(key, bytes)).and_then(|()| file.write_all(bytes)))
        .and_then(|()| std::fs::rename(&part, path));
    if written.is_err() {
        // The error that is returned says more than a failure to clean up would.
        let _ = std::fs::remove_file(&part);
    }
    written
}
