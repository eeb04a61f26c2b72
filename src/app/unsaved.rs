//! What of the drawing would be lost, and what waits for the answer to the question about it.

use std::path::PathBuf;

use super::loading::Loaded;
use crate::document::Document;

/// What is left of the drawing when it goes.
#[derive(Debug, Default)]
pub(super) struct Saved {
    /// Its file, once it has one.
    pub(super) file: Option<PathBuf>,
    /// What is in the file; without one, what opening the models again brings.
    pub(super) document: Document,
}

impl Saved {
    /// What opening models brings. Looking at them from elsewhere changes nothing.
    pub(super) fn models(document: &Document) -> Self {
        Self { file: None, document: Document { camera: None, ..document.clone() } }
    }

    /// What is in a file.
    pub(super) fn in_file(file: PathBuf, document: Document) -> Self {
        Self { file: Some(file), document }
    }

    /// Whether a drawing differs from it. A file without a camera says nothing about the view.
    pub(super) fn differs_from(&self, document: &Document) -> bool {
        let camera = self.document.camera.or(document.camera);
        Document { camera, ..self.document.clone() } != *document
    }
}

/// What takes the place of the drawing.
pub(super) enum Replacement {
    /// Nothing: the window closes.
    Close,
    /// What the person is about to choose.
    Choose,
    /// These files.
    Open(Vec<PathBuf>),
    /// What was loaded while the drawing was being changed.
    Show(Box<Loaded>),
}

/// How far a drawing has come on its way out.
#[derive(Default)]
pub(super) enum Leaving {
    /// It stays.
    #[default]
    No,
    /// The question is on the screen.
    Asked(Replacement),
    /// As soon as it is saved.
    AfterSaving(Replacement),
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Camera;

    #[test]
    fn another_view_is_a_change_only_where_the_file_holds_one() {
        let mut document = Document { camera: Some(Camera::default()), ..Document::default() };
        let (models, saved) =
            (Saved::models(&document), Saved::in_file("a.hachure".into(), document.clone()));
        assert!(!models.differs_from(&document) && !saved.differs_from(&document));
        document.camera = document.camera.map(|c| c.with_orthographic(true));
        assert!(!models.differs_from(&document) && saved.differs_from(&document));
        document.node_mut("/a").visible = Some(false);
        assert!(models.differs_from(&document) && saved.differs_from(&document));
    }
}
