//! What a person can change, save and undo: models, styles and roles per object, camera, lights, view, section plane.

mod boil;
mod coordinates;
pub mod file;
pub mod glyph;
pub mod history;
pub mod lighting;
pub mod masks;
pub mod mirrors;
pub mod pattern;
pub mod roles;
pub mod section;
mod shown;
pub mod view;
mod wave_scale;

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use glam::DVec3;

use crate::scene::{Camera, Light, LightKind, NodeId, Scene, Up};
use crate::style::param::{self, Renamed};
use crate::style::{Color, Style, StyleError, Value};

pub use file::{DOCUMENT_ENDING, DocumentError, DocumentFile};
pub use glyph::Glyph;
pub use history::History;
pub use lighting::Lighting;
pub use pattern::{Pattern, PatternError};
pub use roles::Role;
pub use section::SectionSettings;
pub use view::{Creases, LayersBy, Show, ViewSettings};

/// A drawing: everything about it that is not in the model files.
#[derive(Debug, Clone, PartialEq)]
pub struct Document {
    /// The model files, in the order in which they were added.
    pub models: Vec<PathBuf>,
    /// The axis that is up, for navigation and standard views; `None`: as the file's format has it.
    pub up: Option<Up>,
    /// The unit of the files' coordinates in meters; `None`: as the file states, if it does.
    pub meters_per_unit: Option<f64>,
    /// Where the eye is; `None` until a scene has been framed.
    pub camera: Option<Camera>,
    /// Which lights there are, and their shadows.
    pub lighting: Lighting,
    /// The lights of the model files, where [`lighting::Source::File`] asks for them.
    pub lights: Vec<Light>,
    /// How the picture is shown.
    pub view: ViewSettings,
    /// The plane at which the model is cut open.
    pub section: SectionSettings,
    /// The style of every object that has none and inherits none.
    pub style: Style,
    /// What single nodes have of their own, by node path.
    pub nodes: BTreeMap<String, NodeSettings>,
    /// What points things out.
    pub glyphs: Vec<Glyph>,
    /// What a file lists as glyphs and cannot be read.
    pub unreadable_glyphs: Vec<glyph::Unreadable>,
}

/// What a person set for one node; what is `None` is inherited from the parent.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct NodeSettings {
    /// Complete look.
    pub style: Option<Style>,
    /// Whether the node and what hangs below it is drawn. A node is hidden when any node above it is.
    pub visible: Option<bool>,
    /// Whether its edges are drawn.
    pub enhanced: Option<bool>,
    /// Whether it is a mirror.
    pub mirror: Option<bool>,
    /// Whether layers of blueprints are drawn until it is uncovered.
    pub mask: Option<bool>,
}

/// A use of an image by a style.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ImageUse {
    /// The parameter that names it, and the node whose style it is in: `toon.image`, `/crank/rod, toon.image`.
    pub place: String,
    /// The parameter alone.
    pub key: String,
    /// The file; `None` where a choice asks for an image and none is named.
    pub path: Option<PathBuf>,
}

/// What holds for one node after inheritance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolved<'a> {
    /// The look.
    pub style: &'a Style,
    /// Whether it is drawn.
    pub visible: bool,
    /// Whether its edges are drawn.
    pub enhanced: bool,
    /// Whether it is a mirror, if it can be one: see [`mirrors::mirror_fault`].
    pub mirror: bool,
    /// Whether it is designated: it belongs to the depth mask, and no blueprint is made of it.
    pub mask: bool,
}

impl Default for Document {
    fn default() -> Self {
        Self {
            models: Vec::new(),
            up: None,
            meters_per_unit: None,
            camera: None,
            lighting: Lighting::default(),
            lights: Vec::new(),
            view: ViewSettings::default(),
            section: SectionSettings::default(),
            style: default_style(),
            nodes: BTreeMap::new(),
            glyphs: Vec::new(),
            unreadable_glyphs: Vec::new(),
        }
    }
}

/// The style of a new document: the preset `gooch`.
fn default_style() -> Style {
    crate::style::preset::load("gooch").map_or_else(|_missing| Style::default(), |p| p.style)
}

impl Document {
    /// Color of the paper behind everything.
    pub fn paper(&self) -> Color {
        self.view.background.unwrap_or(self.style.paper.color)
    }

    /// The axis that is up for a scene.
    pub fn up(&self, scene: &Scene) -> Up {
        self.up.unwrap_or(scene.up)
    }

    /// Meters per unit of a scene, where anybody said so.
    pub fn meters_per_unit(&self, scene: &Scene) -> Option<f64> {
        self.meters_per_unit.or(scene.meters_per_unit)
    }

    /// The lights that shine; `up`: the model's.
    pub fn light_sources(&self, up: Up) -> Vec<Light> {
        match self.lighting.source {
            lighting::Source::Rig => self.lighting.rig(up),
            lighting::Source::File => self.lights.clone(),
        }
    }

    /// Direction to the first light, world space, if that is parallel and stands still.
    pub fn fixed_light(&self, scene: &Scene) -> Option<DVec3> {
        match self.light_sources(self.up(scene)).first()? {
            Light { kind: LightKind::Directional { direction }, attached_to_camera: false, .. } => {
                (-*direction).try_normalize()
            }
            _ => None,
        }
    }

    /// Takes over the lights of model files, if they have any.
    pub fn use_lights_of(&mut self, scene: &Scene) {
        self.lights = scene.lights.clone();
        self.lighting.source =
            if scene.lights.is_empty() { lighting::Source::Rig } else { lighting::Source::File };
    }

    /// Style and roles of every node, in the order of `scene.nodes`.
    pub fn resolve(&self, scene: &Scene) -> Vec<Resolved<'_>> {
        let root = Resolved { style: &self.style, visible: true, enhanced: true, mirror: false, mask: false };
        let glyph = Resolved { style: glyph::base_style(), ..root };
        let mut resolved: Vec<Resolved<'_>> = Vec::with_capacity(scene.nodes.len());
        for node in &scene.nodes {
            let above = node.parent.and_then(|p| resolved.get(p)).copied().unwrap_or_else(|| {
                let is_label = || scene.facing_of(resolved.len()).is_some();
                let is_glyph = node.path.starts_with(glyph::FOLDER);
                if is_glyph { Resolved { enhanced: !is_label(), ..glyph } } else { root }
            });
            let own = self.nodes.get(&node.path);
            resolved.push(Resolved {
                style: own.and_then(|n| n.style.as_ref()).unwrap_or(above.style),
                visible: above.visible && own.and_then(|n| n.visible).unwrap_or(true),
                enhanced: own.and_then(|n| n.enhanced).unwrap_or(above.enhanced),
                mirror: own.and_then(|n| n.mirror).unwrap_or(above.mirror),
                mask: own.and_then(|n| n.mask).unwrap_or(above.mask),
            });
        }
        resolved
    }

    /// The images that the styles need, each with the first place that names it.
    pub fn images(&self) -> Vec<ImageUse> {
        let own = self.nodes.iter().filter_map(|(path, node)| Some((path.as_str(), node.style.as_ref()?)));
        let mut seen = BTreeSet::new();
        let mut uses = Vec::new();
        let mut last = None;
        for (node, style) in std::iter::once(("", &self.style)).chain(own) {
            // Thousands of nodes may have one style.
            if last.replace(style) == Some(style) {
                continue;
            }
            for (key, path) in style.images() {
                if seen.insert((key.clone(), path.clone())) {
                    let place = if node.is_empty() { key.clone() } else { format!("{node}, {key}") };
                    uses.push(ImageUse { place, key, path });
                }
            }
        }
        uses
    }

    /// The style of the document, and those that nodes have of their own.
    pub fn styles(&self) -> impl Iterator<Item = &Style> {
        let own = self.nodes.values().filter_map(|node| node.style.as_ref());
        std::iter::once(&self.style).chain(own)
    }

    /// The same, to be changed.
    pub fn styles_mut(&mut self) -> impl Iterator<Item = &mut Style> {
        let own = self.nodes.values_mut().filter_map(|node| node.style.as_mut());
        std::iter::once(&mut self.style).chain(own)
    }

    /// The settings of one node, made if there are none.
    pub fn node_mut(&mut self, path: &str) -> &mut NodeSettings {
        self.nodes.entry(path.to_owned()).or_default()
    }

    /// The same with every number in the range of its parameter, however it was set. This is what is drawn.
    #[must_use]
    pub fn clamped(&self) -> Self {
        let mut clamped = Self {
            lighting: self.lighting.clamped(),
            view: self.view.clamped(),
            section: self.section.clamped(),
            style: self.style.clamped(),
            glyphs: self.glyphs.iter().map(Glyph::clamped).collect(),
            ..self.clone()
        };
        // Often thousands of objects have one style: it is clamped once.
        let mut last: Option<(Style, Style)> = None;
        for style in clamped.nodes.values_mut().filter_map(|node| node.style.as_mut()) {
            match &last {
                Some((given, within)) if given == style => style.clone_from(within),
                _ => {
                    let within = style.clamped();
                    last = Some((std::mem::replace(style, within.clone()), within));
                }
            }
        }
        clamped
    }

    /// Removes entries that say nothing, so that equal documents compare equal.
    pub fn tidy(&mut self) {
        self.nodes.retain(|_, n| *n != NodeSettings::default());
    }

    /// The nodes that a pattern matches, without those below another one that it matches.
    ///
    /// # Errors
    /// When it matches nothing, which is a mistake on the command line.
    pub fn matching(scene: &Scene, pattern: &Pattern) -> Result<Vec<NodeId>, PatternError> {
        let mut matches: Vec<NodeId> = Vec::new();
        let mut covered = 0;
        for (id, node) in scene.nodes.iter().enumerate() {
            if id >= covered && pattern.matches(&node.path) {
                matches.push(id);
                covered = scene.subtree(id).end;
            }
        }
        if matches.is_empty() { Err(pattern.unmatched(scene)) } else { Ok(matches) }
    }

    /// Gives nodes a style; what hangs below them inherits it.
    pub fn set_style(&mut self, scene: &Scene, nodes: &[NodeId], style: &Style) {
        for &id in nodes {
            for inner in scene.subtree(id) {
                if let Some(own) = scene.nodes.get(inner).and_then(|n| self.nodes.get_mut(&n.path)) {
                    own.style = None;
                }
            }
            if let Some(node) = scene.nodes.get(id) {
                self.node_mut(&node.path).style = Some(style.clone());
            }
        }
        self.tidy();
    }

    /// Sets one parameter of the default style, of the view, the light or the section plane, and in all styles that single
    /// nodes have; glyphs keep theirs. A key of an earlier version is said to be one.
    ///
    /// # Errors
    /// See [`param::set`].
    pub fn set(&mut self, key: &str, value: &Value) -> Result<Option<Renamed>, StyleError> {
        let mut params = self.view.params(self.style.paper.color);
        params.extend(self.lighting.params());
        params.extend(self.section.params());
        params.extend(self.style.params());
        let renamed = param::set(&mut params, key, value)?;
        if !["view.", "light.", "section."].iter().any(|section| key.starts_with(section)) {
            let of_objects = self.nodes.iter_mut().filter(|(path, _)| !path.starts_with(glyph::FOLDER));
            for style in of_objects.filter_map(|(_, n)| n.style.as_mut()) {
                param::set(&mut style.params(), key, value)?;
            }
        }
        Ok(renamed)
    }

    /// Sets one parameter of the given nodes and of everything below them. A key of an earlier version is said to be one.
    ///
    /// # Errors
    /// See [`param::set`].
    pub fn set_for(
        &mut self,
        scene: &Scene,
        nodes: &[NodeId],
        key: &str,
        value: &Value,
    ) -> Result<Option<Renamed>, StyleError> {
        // Resolved once: thousands of nodes may be set at a time.
        let inherited: Vec<Style> = {
            let resolved = self.resolve(scene);
            nodes
                .iter()
                .map(|&id| resolved.get(id).map_or_else(Style::default, |r| r.style.clone()))
                .collect()
        };
        let mut renamed = None;
        for (&id, inherited) in nodes.iter().zip(inherited) {
            let Some(node) = scene.nodes.get(id) else { continue };
            for inner in scene.subtree(id).skip(1) {
                if let Some(style) = scene
                    .nodes
                    .get(inner)
                    .and_then(|n| self.nodes.get_mut(&n.path))
                    .and_then(|n| n.style.as_mut())
                {
                    param::set(&mut style.params(), key, value)?;
                }
            }
            let style = self.node_mut(&node.path).style.get_or_insert(inherited);
            renamed = param::set(&mut style.params(), key, value)?;
        }
        Ok(renamed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Node;
    use crate::style::Technique;

    fn scene() -> Scene {
        let node = |path: &str, parent, descendants| Node {
            name: path.rsplit('/').next().unwrap_or_default().to_owned(),
            path: path.to_owned(),
            parent,
            descendants,
            world_from_local: glam::DMat4::IDENTITY,
            mesh: None,
        };
        Scene {
            nodes: vec![
                node("/m", None, 3),
                node("/m/rod.1", Some(0), 1),
                node("/m/rod.1/bolt", Some(1), 0),
                node("/m/wheel", Some(0), 0),
            ],
            ..Scene::default()
        }
    }

    #[test]
    fn styles_and_roles_are_inherited() {
        let (scene, mut document) = (scene(), Document::default());
        let plain = Style { technique: Technique::Plain, ..Style::default() };
        document.set_style(&scene, &[1], &plain);
        document.node_mut("/m").visible = Some(false);
        document.node_mut("/m/rod.1/bolt").enhanced = Some(false);
        let r = document.resolve(&scene);
        assert_eq!(r[2].style, &plain);
        assert_eq!(r[3].style, &document.style);
        assert!(r.iter().all(|r| !r.visible));
        assert!(r[1].enhanced && !r[2].enhanced);
    }

    #[test]
    fn a_parameter_set_for_a_node_reaches_what_is_below_and_nothing_else() {
        let (scene, mut document) = (scene(), Document::default());
        let pattern = Pattern::new("rod*").unwrap();
        let nodes = Document::matching(&scene, &pattern).unwrap();
        assert_eq!(nodes, [1]);
        document.set_for(&scene, &nodes, "gooch.alpha", &Value::Number(0.9)).unwrap();
        let r = document.resolve(&scene);
        assert_eq!(r[2].style.gooch.alpha, 0.9);
        assert_ne!(r[3].style.gooch.alpha, 0.9);
        assert!(document.set("gooch.alpah", &Value::Number(0.9)).is_err());
        document.set("gooch.alpha", &Value::Number(0.1)).unwrap();
        assert!(document.resolve(&scene).iter().all(|r| r.style.gooch.alpha == 0.1));
    }

    #[test]
    fn each_image_is_listed_once_with_the_place_that_names_it() {
        let (scene, mut document) = (scene(), Document::default());
        let text = |t: &str| Value::Text(t.to_owned());
        for (key, value) in [("technique", "toon"), ("toon.ramp", "image"), ("toon.image", "a.png")] {
            document.set(key, &text(value)).unwrap();
        }
        document.set_for(&scene, &[1], "toon.image", &text("b.png")).unwrap();
        document.set_for(&scene, &[3], "gooch.alpha", &Value::Number(0.9)).unwrap();
        let expected = [("toon.image", "a.png"), ("/m/rod.1, toon.image", "b.png")];
        let expected = expected.map(|(place, path)| ImageUse {
            place: place.into(),
            key: "toon.image".into(),
            path: Some(path.into()),
        });
        assert_eq!(document.images(), expected);
        document.set("technique", &text("gooch")).unwrap();
        assert_eq!(document.images(), []);
    }
}
