//! What a model refers to by URI: `data:` payloads and files beside it. Nothing outside the model's own folder is
//! read, and no other scheme is followed.

use std::collections::HashMap;
use std::path::{Component, Path, PathBuf};
use std::sync::{Arc, Mutex};

use base64::Engine;
use base64::alphabet;
use base64::engine::general_purpose::{GeneralPurpose, GeneralPurposeConfig};
use base64::engine::{DecodePaddingMode, general_purpose};

/// Why a reference could not be followed.
#[derive(Debug)]
pub(super) enum SourceError {
    /// It must not be followed, or cannot be understood; the message is for a person.
    Refused(String),
    /// The system could not read the file.
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
}

impl std::fmt::Display for SourceError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Refused(message) => f.write_str(message),
            Self::Read { path, source } => write!(f, "cannot read {}: {source}", path.display()),
        }
    }
}

/// The folder that a model lies in. Each file is read once, however often it is referred to.
#[derive(Debug)]
pub(super) struct Folder {
    root: PathBuf,
    read: Mutex<HashMap<PathBuf, Arc<Vec<u8>>>>,
}

impl Folder {
    /// The folder of the model at `path`.
    pub(super) fn of(path: &Path) -> Self {
        let parent = match path.parent() {
            Some(p) if !p.as_os_str().is_empty() => p,
            _ => Path::new("."),
        };
        Self { root: parent.to_path_buf(), read: Mutex::default() }
    }

    /// The bytes behind a URI: a `data:` payload, or a file in the folder or below it.
    ///
    /// # Errors
    /// When the URI leads elsewhere or cannot be decoded, or when the file cannot be read.
    pub(super) fn fetch(&self, uri: &str) -> Result<Arc<Vec<u8>>, SourceError> {
        match scheme(uri) {
            Some(s) if s.eq_ignore_ascii_case("data") => {
                decode_data_uri(uri.get(5..).unwrap_or_default()).map(Arc::new)
            }
            Some(s) => Err(SourceError::Refused(format!(
                "`{}` has the scheme `{}:`; only files in the model's own folder and data: URIs are read, so put \
                 the file beside the model",
                shorten(uri),
                shorten(s)
            ))),
            None => self.read_file(&percent_decode(uri)?),
        }
    }

    /// The content of a file in the folder or below it, named as in a path (no percent-encoding).
    ///
    /// # Errors
    /// When the path leads out of the folder, also by a symbolic link, or when the file cannot be read.
    pub(super) fn read_file(&self, relative: &str) -> Result<Arc<Vec<u8>>, SourceError> {
        let outside = || {
            SourceError::Refused(format!(
                "`{}` lies outside the model's folder and is not read; put the file beside the model",
                shorten(relative)
            ))
        };
        if relative.contains('\0') {
            return Err(SourceError::Refused("a file name contains a zero byte".into()));
        }
        let relative_path = relative.replace('\\', "/");
        if has_drive(&relative_path) {
            return Err(outside());
        }
        let mut inside = PathBuf::new();
        for component in Path::new(&relative_path).components() {
            match component {
                Component::Normal(name) => inside.push(name),
                Component::CurDir => {}
                Component::ParentDir => {
                    if !inside.pop() {
                        return Err(outside());
                    }
                }
                Component::RootDir | Component::Prefix(_) => return Err(outside()),
            }
        }
        let wanted = self.root.join(&inside);
        let read_error = |source| SourceError::Read { path: wanted.clone(), source };
        let root = self.root.canonicalize().map_err(read_error)?;
        let real = wanted.canonicalize().map_err(read_error)?;
        if !real.starts_with(&root) {
            return Err(outside());
        }
        let mut read = match self.read.lock() {
            Ok(guard) => guard,
            Err(poisoned) => poisoned.into_inner(),
        };
        if let Some(bytes) = read.get(&real) {
            return Ok(bytes.clone());
        }
        let bytes = Arc::new(read_regular_file(&real).map_err(read_error)?);
        read.insert(real, bytes.clone());
        Ok(bytes)
    }
}

/// Reads a whole file; devices, pipes and directories are refused.
///
/// # Errors
/// What the system says, or that it is no regular file.
pub(super) fn read_regular_file(path: &Path) -> std::io::Result<Vec<u8>> {
    let metadata = std::fs::metadata(path)?;
    if metadata.is_dir() {
        return Err(std::io::Error::new(
            std::io::ErrorKind::IsADirectory,
            "it is a directory; open a file in it",
        ));
    }
    if !metadata.is_file() {
        return Err(std::io::Error::new(std::io::ErrorKind::InvalidInput, "it is no regular file"));
    }
    std::fs::read(path)
}

/// The scheme of a URI, if it has one.
fn scheme(uri: &str) -> Option<&str> {
    let (scheme, _) = uri.split_once(':')?;
    let mut chars = scheme.chars();
    let plain = chars.next()?.is_ascii_alphabetic()
        && chars.all(|c| c.is_ascii_alphanumeric() || matches!(c, '+' | '-' | '.'));
    plain.then_some(scheme)
}

/// Whether a path begins like `C:`.
fn has_drive(path: &str) -> bool {
    matches!(path.as_bytes(), [letter, b':', ..] if letter.is_ascii_alphabetic())
}

/// `%20` and the like become bytes; the result must be UTF-8.
fn percent_decode(uri: &str) -> Result<String, SourceError> {
    String::from_utf8(percent_bytes(uri)).map_err(|e| {
        SourceError::Refused(format!(
            "`{}` is no UTF-8 text after decoding its percent signs: {e}",
            shorten(uri)
        ))
    })
}

/// Replaces every valid `%XX`; what is not valid stays as it is.
fn percent_bytes(text: &str) -> Vec<u8> {
    let digit = |b: Option<&u8>| b.and_then(|b| (*b as char).to_digit(16));
    let bytes = text.as_bytes();
    let mut out = Vec::with_capacity(bytes.len());
    let mut at = 0;
    while let Some(&byte) = bytes.get(at) {
        match (byte, digit(bytes.get(at + 1)), digit(bytes.get(at + 2))) {
            (b'%', Some(high), Some(low)) => {
                out.push((high * 16 + low) as u8);
                at += 3;
            }
            _ => {
                out.push(byte);
                at += 1;
            }
        }
    }
    out
}

const BASE64: GeneralPurpose = GeneralPurpose::new(
    &alphabet::STANDARD,
    GeneralPurposeConfig::new()
        .with_decode_padding_mode(DecodePaddingMode::Indifferent)
        .with_decode_allow_trailing_bits(true),
);

/// Decodes what follows `data:`.
fn decode_data_uri(rest: &str) -> Result<Vec<u8>, SourceError> {
    let Some((header, payload)) = rest.split_once(',') else {
        return Err(SourceError::Refused("a data: URI has no comma before its payload".into()));
    };
    if !header.to_ascii_lowercase().ends_with(";base64") {
        return Ok(percent_bytes(payload));
    }
    // Rare: line breaks, percent-encoding or the URL alphabet inside the payload.
    let lenient = || {
        let mut clean = percent_bytes(payload);
        clean.retain(|b| !b.is_ascii_whitespace());
        BASE64.decode(&clean).or_else(|_| general_purpose::URL_SAFE_NO_PAD.decode(&clean))
    };
    BASE64
        .decode(payload)
        .or_else(|_| lenient())
        .map_err(|e| SourceError::Refused(format!("a data: URI holds no valid base64 payload: {e}")))
}

/// The beginning of a text, for messages.
pub(super) fn shorten(text: &str) -> String {
    const LONGEST: usize = 80;
    if text.chars().count() <= LONGEST {
        return text.to_owned();
    }
    let mut short: String = text.chars().take(LONGEST).collect();
    short.push('…');
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn schemes_and_percent_signs_are_understood() {
        assert_eq!(scheme("data:,a"), Some("data"));
        assert_eq!(scheme("a/b:c.png"), None);
        assert_eq!(scheme("plain.png"), None);
        assert_eq!(percent_decode("a%20b%C3%A4%zz").unwrap(), "a bä%zz");
        assert_eq!(decode_data_uri("application/octet-stream;base64,AQID").unwrap(), [1, 2, 3]);
        assert_eq!(decode_data_uri(";base64,AQ I\nD").unwrap(), [1, 2, 3]);
        assert_eq!(decode_data_uri("text/plain,a%20b").unwrap(), b"a b");
    }

    #[test]
    fn only_the_models_own_folder_is_read() {
        let dir = tempfile::tempdir().unwrap();
        let inside = dir.path().join("model");
        std::fs::create_dir_all(inside.join("tex")).unwrap();
        std::fs::write(inside.join("tex/a b.bin"), b"in").unwrap();
        std::fs::write(dir.path().join("secret.bin"), b"out").unwrap();
        let folder = Folder::of(&inside.join("m.gltf"));
        assert_eq!(**folder.fetch("tex/a%20b.bin").unwrap(), *b"in");
        assert_eq!(**folder.fetch("tex\\a b.bin").unwrap(), *b"in");
        assert_eq!(**folder.fetch("./x/../tex/a b.bin").unwrap(), *b"in");
        let absolute = dir.path().join("secret.bin");
        for bad in [
            "../secret.bin",
            "%2e%2e/secret.bin",
            "tex/../../secret.bin",
            "..\\secret.bin",
            absolute.to_str().unwrap(),
            "http://example.com/a.bin",
            "file:///etc/passwd",
            "C:\\a.bin",
        ] {
            let e = folder.fetch(bad).unwrap_err();
            assert!(matches!(e, SourceError::Refused(_)), "{bad}: {e}");
        }
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(&absolute, inside.join("link.bin")).unwrap();
            assert!(matches!(folder.fetch("link.bin"), Err(SourceError::Refused(_))));
        }
    }
}
