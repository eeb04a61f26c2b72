//! What the window knows of the images that styles name; `viewer/images.rs` reads them.

use std::collections::BTreeMap;

use crate::document::{Document, ImageUse, NodeSettings};
use crate::import::ImageCache;
use crate::scene::Warning;
use crate::style::Style;

/// What the window knows of the images.
#[derive(Default)]
pub(super) struct ImageFiles {
    /// What has been read.
    pub(super) cache: ImageCache,
    /// The styles for which it was last looked what they need, and that.
    styles: Option<(Style, BTreeMap<String, NodeSettings>)>,
    /// Where styles need one.
    pub(super) uses: Vec<ImageUse>,
    /// What could not be loaded.
    pub(super) warnings: Vec<Warning>,
    /// Whether files are to be looked at again.
    pub(super) is_outdated: bool,
}

impl ImageFiles {
    /// Looks in the next frame whether files have changed.
    pub(super) fn look_again(&mut self) {
        self.is_outdated = true;
    }

    /// Notes what the styles of a document need.
    pub(super) fn note(&mut self, document: &Document) {
        if self.styles.as_ref().is_some_and(|(s, nodes)| *s == document.style && *nodes == document.nodes) {
            return;
        }
        self.styles = Some((document.style.clone(), document.nodes.clone()));
        let uses = document.images();
        if uses != self.uses {
            self.uses = uses;
            self.is_outdated = true;
        }
    }
}
