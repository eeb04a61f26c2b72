//! Documents as `.hachure` files (TOML).

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::lighting::{Lighting, Source};
use super::{Document, NodeSettings, SectionSettings, ViewSettings, glyph};
use crate::scene::{Camera, Light, Up, Warning};
use crate::style::param::{Param, map_paths};
use crate::style::{MadeFrom, Style, StyleError, diff_to_toml, set_from_toml};

/// A document is text that a person could have written; anything larger is a mistake.
const MAX_FILE_BYTES: u64 = 64 << 20;

/// Why a document could not be opened or saved.
#[derive(Debug, thiserror::Error)]
pub enum DocumentError {
    /// The file could not be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The file could not be written; the old one, if any, is untouched.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The content is no document.
    #[error("{}: {message}", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// What is wrong and in which line.
        message: String,
    },
    /// A parameter of a style, of the view, the light or the section plane in it is wrong.
    #[error("{}, {place}: {source}", path.display())]
    Style {
        /// The file.
        path: PathBuf,
        /// `style`, `view`, `light`, `section` or the path of the node.
        place: String,
        /// What is wrong.
        source: StyleError,
    },
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Form {
    #[serde(default)]
    models: Vec<PathBuf>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    up: Option<Up>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    meters_per_unit: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    camera: Option<Camera>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    lights: Option<Vec<Light>>,
    #[serde(default, skip_serializing_if = "toml::Table::is_empty")]
    light: toml::Table,
    #[serde(default, skip_serializing_if = "toml::Table::is_empty")]
    view: toml::Table,
    #[serde(default, skip_serializing_if = "toml::Table::is_empty")]
    section: toml::Table,
    #[serde(default, skip_serializing_if = "toml::Table::is_empty")]
    style: toml::Table,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    nodes: BTreeMap<String, NodeForm>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    glyph: Vec<toml::Table>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct NodeForm {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    visible: Option<bool>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    enhanced: Option<bool>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    mirror: Option<bool>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    mask: Option<bool>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    style: Option<toml::Table>,
}

/// The ending of documents, without dot.
pub const DOCUMENT_ENDING: &str = "hachure";

/// What a `.hachure` file holds.
#[derive(Debug, Clone)]
pub struct DocumentFile {
    /// The document.
    pub document: Document,
    /// Keys of earlier versions in it, at the part of the document that has them.
    pub warnings: Vec<Warning>,
}

impl Document {
    /// Reads a `.hachure` file. Paths of models and images become relative to the current folder.
    ///
    /// # Errors
    /// See [`DocumentError`]; nothing is half read.
    pub fn open(path: &Path) -> Result<DocumentFile, DocumentError> {
        let read_error = |source| DocumentError::Read { path: path.into(), source };
        let size = std::fs::metadata(path).map_err(read_error)?.len();
        if size > MAX_FILE_BYTES {
            return Err(DocumentError::Malformed {
                path: path.into(),
                message: format!("{size} bytes are too many for a document"),
            });
        }
        let text = std::fs::read_to_string(path).map_err(read_error)?;
        Self::from_text(&text, path)
    }

    fn from_text(text: &str, path: &Path) -> Result<DocumentFile, DocumentError> {
        let form: Form = toml::from_str(text).map_err(|e| DocumentError::Malformed {
            path: path.into(),
            message: e.to_string().trim_end().to_owned(),
        })?;
        let malformed =
            |message: &str| DocumentError::Malformed { path: path.into(), message: message.to_owned() };
        if form.camera.is_some_and(|c| !c.is_valid()) {
            return Err(malformed(
                "camera: its numbers must be finite, its view angle from 1 to 170, its height above 0",
            ));
        }
        if form.lights.iter().flatten().any(|l| !l.is_valid()) {
            return Err(malformed("lights: their numbers must be finite"));
        }
        let warnings = RefCell::new(Vec::new());
        let fill = |params: &mut [Param<'_>], table: &toml::Table, place: &str| {
            let renamed =
                set_from_toml(params, &table.to_string(), place).map_err(|e| DocumentError::Style {
                    path: path.into(),
                    place: place.to_owned(),
                    source: match e {
                        StyleError::InFile { source, .. } => *source,
                        other => other,
                    },
                })?;
            let place = format!("{}, {place}", path.display());
            warnings.borrow_mut().extend(renamed.iter().map(|r| Warning::new(&place, r.to_string())));
            Ok(())
        };
        let style = |mut table: toml::Table, place: &str| {
            let mut style = Style::default();
            if let Some(toml::Value::String(id)) = table.get("preset").cloned() {
                table.remove("preset");
                style.made_from = MadeFrom(Some(id));
            }
            fill(&mut style.params(), &table, place).map(|()| style)
        };
        let folder = path.parent().unwrap_or(Path::new(""));
        let (glyphs, unreadable_glyphs) = glyph::from_tables(form.glyph);
        let mut document = Self {
            models: form.models.iter().map(|m| folder.join(m)).collect(),
            up: form.up,
            meters_per_unit: form.meters_per_unit.filter(|u| u.is_finite() && *u > 0.0),
            camera: form.camera,
            lighting: default_lighting(form.lights.is_some()),
            lights: form.lights.unwrap_or_default(),
            style: style(form.style, "style")?,
            unreadable_glyphs,
            ..Self::default()
        };
        for glyph in glyphs {
            document.add_glyph(glyph);
        }
        // These tables hold the keys of one section; the list of parameters has them with their prefix.
        let section =
            |name: &str, table: toml::Table| toml::Table::from_iter([(name.to_owned(), table.into())]);
        fill(&mut document.view.params(document.style.paper.color), &section("view", form.view), "view")?;
        fill(&mut document.lighting.params(), &section("light", form.light), "light")?;
        fill(&mut document.section.params(), &section("section", form.section), "section")?;
        for (node, form) in form.nodes {
            let style = form.style.map(|table| style(table, &node)).transpose()?;
            let NodeForm { visible, enhanced, mirror, mask, .. } = form;
            let settings = NodeSettings { style, visible, enhanced, mirror, mask };
            document.nodes.insert(node, settings);
        }
        let own = document.nodes.values_mut().filter_map(|n| n.style.as_mut());
        for style in own.chain([&mut document.style]) {
            map_paths(&mut style.params(), |image| folder.join(image));
        }
        document.tidy();
        Ok(DocumentFile { document, warnings: warnings.into_inner() })
    }

    /// Writes a `.hachure` file; paths of models and images are written relative to it where they share a folder with it.
    ///
    /// # Errors
    /// [`DocumentError::Write`]; an existing file is then untouched.
    pub fn save(&self, path: &Path) -> Result<(), DocumentError> {
        let text = self.to_text(path)?;
        write_atomically(path, text.as_bytes())
            .map_err(|source| DocumentError::Write { path: path.into(), source })
    }

    fn to_text(&self, path: &Path) -> Result<String, DocumentError> {
        let style_table = |style: &Style| {
            let mut style = style.clone();
            let mut params = style.params();
            map_paths(&mut params, |image| relative_to(image, path));
            let mut table = diff_to_toml(&mut params, &mut Style::default().params());
            table.extend(style.made_from.0.map(|id| ("preset".to_owned(), id.into())));
            table
        };
        let has_lights = !self.lights.is_empty();
        let section = |name: &str, table: toml::Table| {
            table.get(name).and_then(|v| v.as_table()).cloned().unwrap_or_default()
        };
        let paper = self.style.paper.color;
        let view =
            diff_to_toml(&mut self.view.clone().params(paper), &mut ViewSettings::default().params(paper));
        let plane =
            diff_to_toml(&mut self.section.clone().params(), &mut SectionSettings::default().params());
        let light =
            diff_to_toml(&mut self.lighting.clone().params(), &mut default_lighting(has_lights).params());
        let form = Form {
            models: self.models.iter().map(|m| relative_to(m, path)).collect(),
            up: self.up,
            meters_per_unit: self.meters_per_unit,
            camera: self.camera,
            lights: has_lights.then(|| self.lights.clone()),
            light: section("light", light),
            view: section("view", view),
            section: section("section", plane),
            style: style_table(&self.style),
            nodes: self
                .nodes
                .iter()
                .map(|(node, own)| {
                    let form = NodeForm {
                        visible: own.visible,
                        enhanced: own.enhanced,
                        mirror: own.mirror,
                        mask: own.mask,
                        style: own.style.as_ref().map(style_table),
                    };
                    (node.clone(), form)
                })
                .collect(),
            glyph: glyph::to_tables(&self.glyphs, &self.unreadable_glyphs),
        };
        toml::to_string(&form)
            .map_err(|e| DocumentError::Malformed { path: path.into(), message: e.to_string() })
    }
}

/// A document that lists lights uses them unless it says otherwise.
fn default_lighting(has_lights: bool) -> Lighting {
    Lighting { source: if has_lights { Source::File } else { Source::Rig }, ..Lighting::default() }
}

/// `file` as it is seen from the folder of `document`; absolute where the two share no folder.
fn relative_to(file: &Path, document: &Path) -> PathBuf {
    let absolute = |p: &Path| std::path::absolute(p).unwrap_or_else(|_unknown| p.to_owned());
    let file = absolute(file);
    let document = absolute(document);
    let folder = document.parent().unwrap_or(Path::new("/"));
    let shared = file.components().zip(folder.components()).take_while(|(a, b)| a == b).count();
    // Sharing only the root is sharing nothing.
    if shared < 2 {
        return file;
    }
    let up = folder.components().skip(shared).map(|_| "..");
    let down = file.components().skip(shared).map(|c| c.as_os_str());
    up.map(std::ffi::OsStr::new).chain(down).collect()
}

/// Writes a file beside its target and renames it, so that nobody ever sees half of it.
///
/// # Errors
/// What the system says; the target is then as it was.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}.part", std::process::id()));
    let part = path.with_file_name(name);
    let written = std::fs::File::create(&part)
        .and_then(|mut file| file.write_all(bytes).and_then(|()| file.sync_data()))
        .and_then(|()| std::fs::rename(&part, path));
    if written.is_err() {
        // The error that is returned says more than a failure to clean up would.
        let _ = std::fs::remove_file(&part);
    }
    written
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::EdgeClass;
    use crate::style::Technique;

    #[test]
    fn a_document_survives_saving_and_opening() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.hachure");
        let mut document = Document {
            models: vec![folder.path().join("models/crank.glb")],
            up: Some(Up::PosZ),
            camera: Some(Camera::default()),
            ..Document::default()
        };
        document.view.background = Some("#102030".parse().unwrap());
        document.lighting.shadows = true;
        document.lighting.rim.azimuth = -12.5;
        document.section.show = true;
        document.section.position = Some(0.25);
        document.section.hatch.spacing = 7.5;
        document.node_mut("/crank/rod.3").style =
            Some(Style { technique: Technique::Plain, ..Style::default() });
        document.node_mut("/crank/rod.4").visible = Some(false);
        document.style.edges.class_mut(EdgeClass::Ridge).width = Some(document.style.edges.inner.width);
        document.style.toon.image = Some(folder.path().join("images/ramp.png"));
        document.save(&path).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.contains("\"models/crank.glb\"") && text.contains("\"images/ramp.png\""), "{text}");
        let again = Document::open(&path).unwrap().document;
        assert_eq!(again, document);
        assert_eq!(again.style.made_from.0.as_deref(), Some("gooch"));
        assert_eq!(again.nodes["/crank/rod.3"].style.as_ref().unwrap().made_from.0, None);
    }

    #[test]
    fn a_document_that_is_saved_elsewhere_finds_its_images() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("drawings")).unwrap();
        std::fs::write(folder.path().join("ramp.png"), "").unwrap();
        let (first, second) = (folder.path().join("a.hachure"), folder.path().join("drawings/b.hachure"));
        std::fs::write(
            &first,
            "[style]\ntoon.image = 'ramp.png'\n[nodes.'/m'.style]\ntoon.image = 'ramp.png'\n",
        )
        .unwrap();
        Document::open(&first).unwrap().document.save(&second).unwrap();
        let again = Document::open(&second).unwrap().document;
        let styles = [Some(&again.style), again.nodes["/m"].style.as_ref()];
        assert!(styles.iter().all(|s| s.unwrap().toon.image.as_ref().unwrap().exists()), "{again:?}");
        assert!(std::fs::read_to_string(&second).unwrap().contains("\"../ramp.png\""));
    }

    #[test]
    fn listed_lights_shine_unless_the_rig_is_asked_for() {
        let lights = "[[lights]]\nkind = { directional = { direction = [0.0, -1.0, 0.0] } }\n\
                      color = [1.0, 1.0, 1.0]\nintensity = 1.0\nattached_to_camera = false\n";
        for (text, source) in
            [(lights.to_owned(), Source::File), (format!("{lights}[light]\nsource = \"rig\""), Source::Rig)]
        {
            let document = Document::from_text(&text, Path::new("a.hachure")).unwrap().document;
            assert_eq!((document.lights.len(), document.lighting.source), (1, source));
            let again = document.to_text(Path::new("a.hachure")).unwrap();
            assert_eq!(Document::from_text(&again, Path::new("a.hachure")).unwrap().document, document);
        }
    }

    #[test]
    fn mistakes_name_the_file_and_the_place() {
        let open = |text: &str| Document::from_text(text, Path::new("a.hachure")).unwrap_err().to_string();
        assert!(open("modles = []").contains("a.hachure: TOML parse error at line 1"));
        assert!(
            open("[style]\ngooch.alhpa = 1").contains("a.hachure, style: unknown parameter `gooch.alhpa`")
        );
        assert!(open("[nodes.\"/crank\".style]\ngooch.alpha = 9").contains("a.hachure, /crank: "));
        assert!(open("\u{0}").contains("a.hachure"));
        assert!(open("[section]\nazimuth = nan").contains("a.hachure, section: "));
        assert!(open("[section]\nposition = inf").contains("section.position"));
        assert!(open("[section]\naxis = \"w\"").contains("one of x, y, z, free"));
        let camera = "[camera]\nposition = [nan, 0.0, 0.0]\nfocal_point = [0.0, 0.0, 0.0]\nview_up = [0.0, 1.0, 0.0]\n\
                      [camera.projection.perspective]\nview_angle = 30.0";
        assert!(open(camera).contains("camera: its numbers must be finite"));
        assert!(
            open(&camera.replace("nan", "0.0").replace("30.0", "500.0")).contains("view angle from 1 to 170")
        );
    }

    #[test]
    fn saving_where_nothing_can_be_written_is_an_error_that_names_the_file() {
        let error = Document::default().save(Path::new("/nonexistent/a.hachure")).unwrap_err();
        assert!(error.to_string().starts_with("cannot write /nonexistent/a.hachure: "));
    }
}
