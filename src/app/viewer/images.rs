//! The images that styles name are read in the background, and again when their files have changed.

use std::path::Path;

use eframe::egui;

use super::Viewer;
use crate::app::jobs::Job;
use crate::app::panels::{Choosing, style};
use crate::import::{ImageCache, Progress};
use crate::render;
use crate::scene::{Scene, Warning};
use crate::style::Value;

impl Viewer {
    /// Keeps the images of the picture those that the styles name.
    pub(super) fn answer_images(&mut self, context: &egui::Context) {
        if let Some(result) = self.jobs.images.as_ref().and_then(Job::poll) {
            self.jobs.images = None;
            match result {
                Ok(Ok((cache, images))) => self.show_images(cache, images),
                Ok(Err(error)) => self.notices.error(error.to_string()),
                Err(error) => self.notices.error(error.to_string()),
            }
        }
        self.images.note(&self.document);
        // Whoever comes back to the window may have painted an image elsewhere.
        let is_back = context.input(|i| i.events.contains(&egui::Event::WindowFocused(true)));
        self.images.is_outdated |= is_back && !self.images.uses.is_empty();
        if self.images.is_outdated && self.jobs.images.is_none() {
            self.images.is_outdated = false;
            let (cache, uses) = (self.images.cache.clone(), self.images.uses.clone());
            let known = self.viewport.images().clone();
            let work = move |progress: &Progress| {
                let cache = cache.read(&uses, progress)?;
                let images = render::StyleImages::new(cache.images()).knowing(&known);
                render::prepare_images(&images, &uses);
                Ok((cache, images))
            };
            self.jobs.images = Some(Job::start("reading images", context, work));
        }
    }

    fn show_images(&mut self, cache: ImageCache, images: render::StyleImages) {
        let mut warnings = cache.warnings(&self.images.uses);
        warnings.extend(render::image_faults(&images, &self.images.uses));
        let is_new = |w: &&Warning| !self.images.warnings.contains(w);
        // Where none is named yet, one is about to be chosen.
        let is_named = |w: &&Warning| self.images.uses.iter().any(|u| u.place == w.place && u.path.is_some());
        for warning in warnings.iter().filter(is_new).filter(is_named) {
            self.notices.warning(warning.to_string());
        }
        self.images.warnings = warnings;
        self.viewport.show_images(images);
        self.images.cache = cache;
    }

    /// Takes an image that was chosen in a dialog.
    pub(super) fn take_image(&mut self, choosing: &Choosing, path: &Path) {
        let Some(text) = path.to_str() else {
            let path = path.display();
            self.notices.error(format!("{path}: its name is no valid Unicode; rename the file to use it"));
            return;
        };
        let scene: &Scene = &self.model.scene;
        let is_meant = |id: &usize| scene.nodes.get(*id).is_some_and(|n| choosing.nodes.contains(&n.path));
        let nodes: Vec<_> = (0..scene.nodes.len()).filter(is_meant).collect();
        if nodes.len() < choosing.nodes.len() {
            self.notices.warning("The object for which the image was chosen is not there any more");
            return;
        }
        let value = Value::Text(text.to_owned());
        if let Err(error) = style::set(&mut self.document, scene, &nodes, &choosing.key, &value) {
            self.notices.error(error.to_string());
        }
    }
}
