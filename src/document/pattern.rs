//! Patterns for node paths: `/crank/rod.3/*`, or `rod*` for a node's name.

use crate::scene::Scene;
use crate::style::nearest;

/// A shell pattern: `*` any text, `?` one character, `[ab]` one of these.
///
/// Glyphs are meant only by patterns that begin with `glyphs/`. With a `/` it is compared with the whole path and `*` crosses levels; without one, with the last name only.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pattern {
    glob: glob::Pattern,
    whole_path: bool,
}

/// Why a pattern cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PatternError {
    /// It is malformed.
    #[error("`{pattern}` is no pattern: {reason}")]
    Malformed {
        /// As written.
        pattern: String,
        /// What is wrong.
        reason: String,
    },
    /// It matches no node of the scene.
    #[error("no object matches `{pattern}`{} `hachure info FILE` lists all paths",
        nearest.as_ref().map_or(".".to_owned(), |n| format!("; did you mean `{n}`?")))]
    Unmatched {
        /// As written.
        pattern: String,
        /// The most similar path or name.
        nearest: Option<String>,
    },
}

impl Pattern {
    /// Reads a pattern.
    ///
    /// # Errors
    /// When it is malformed.
    pub fn new(text: &str) -> Result<Self, PatternError> {
        let glob = glob::Pattern::new(text)
            .map_err(|e| PatternError::Malformed { pattern: text.to_owned(), reason: e.msg.to_owned() })?;
        Ok(Self { glob, whole_path: text.contains('/') })
    }

    /// Whether a node of this path is meant.
    pub fn matches(&self, path: &str) -> bool {
        let is_glyph = path.starts_with(super::glyph::FOLDER);
        if is_glyph && !self.glob.as_str().starts_with(super::glyph::FOLDER) {
            return false;
        }
        let text = if self.whole_path { path } else { path.rsplit('/').next().unwrap_or(path) };
        self.glob.matches(text)
    }

    pub(super) fn unmatched(&self, scene: &Scene) -> PatternError {
        let names =
            scene.nodes.iter().map(|n| if self.whole_path { n.path.as_str() } else { n.name.as_str() });
        PatternError::Unmatched {
            pattern: self.glob.as_str().to_owned(),
            nearest: nearest(self.glob.as_str(), names),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_match_paths_or_names() {
        let matches = |p: &str, path: &str| Pattern::new(p).unwrap().matches(path);
        assert!(matches("/crank/rod.3/*", "/crank/rod.3/cap"));
        assert!(!matches("/crank/rod.3/*", "/crank/rod.4/cap"));
        assert!(matches("rod.?", "/crank/rod.3"));
        assert!(!matches("rod.?", "/crank/rod.3/cap"));
        assert!(
            matches("glyphs/w*", "glyphs/way")
                && !matches("*", "glyphs/way")
                && !matches("*/way", "glyphs/way")
        );
        assert!(Pattern::new("[").is_err());
    }
}
