//! `hachure render`: a picture without a window.

use std::thread::JoinHandle;

use serde_json::json;

use super::args::{CameraArgs, LookArgs, RenderArgs, SectionAt};
use super::{CliError, layers, print_json, session, warn};
use crate::document::{Document, Pattern, Role, SectionSettings, ViewSettings, glyph, section};
use crate::export::save_png;
use crate::export::session::{OpenError, Opened, initial_camera, open};
use crate::gpu::{Gpu, GpuError};
use crate::import::{ImageCache, Progress};
use crate::render::StyleImages;
use crate::scene::{Camera, NodeId, Projection, Scene, Warning};
use crate::style::{Color, Style, param, preset};

/// Pixels per inch of paper, as printers expect them.
const DPI: f64 = 300.0;

const METERS_PER_INCH: f64 = 0.0254;

pub(super) fn run(args: &RenderArgs) -> Result<(), CliError> {
    let device = StartingDevice::new()?;
    let mut opened = open(&args.files, |view| look_at_files(view, &args.look), &Progress::default())?;
    let renamed = apply_look(&mut opened, &args.look)?;
    opened.document.view.background = args.background.or(opened.document.view.background);
    let uses = opened.document.images();
    let images = ImageCache::default().read(&uses, &Progress::default()).map_err(OpenError::from)?;
    let size = args.resolution.0;
    let aspect = f64::from(size[0]) / f64::from(size[1]);
    let mut camera = camera(&opened, &args.camera, aspect);
    let dpi = args.dpi.or(args.camera.scale.map(|_| DPI));
    if let (Some(scale), Some(dpi)) = (args.camera.scale, dpi) {
        let meters = opened.document.meters_per_unit(&opened.scene).ok_or(CliError::NoUnit)?;
        let paper_height = f64::from(size[1]) / dpi * METERS_PER_INCH;
        camera.projection = Projection::Orthographic { view_height: paper_height * scale.0 / meters };
    }
    opened.document.camera = Some(camera);

    let mut session = session(device.wait()?)?;
    session.set_samples(args.samples);
    session.set_scene(&opened)?;
    session.renderer().set_images(StyleImages::new(images.images()));
    let image = session.image(&opened, size, args.no_background)?;
    save_png(&args.output, image, dpi)?;

    let scene = &opened.scene;
    let document = &opened.document;
    let section = document.section_fault(document.up(scene), &scene.bounds());
    let roles = document.role_faults(&document.scene_with_glyphs(scene));
    let faults = roles.into_iter().chain(section).chain(document.glyph_faults(scene));
    let uncapped = section::without_caps(session.renderer().open_bodies());
    let faults = faults.chain(document.coordinate_faults(scene)).chain(uncapped);
    let reports: Vec<_> = session.renderer().last_layer_reports().into_iter().flatten().collect();
    let strokes = crate::render::image_faults(session.renderer().images(), &uses);
    let files = scene.warnings.iter().cloned().chain(renamed);
    let warnings = images.warnings(&uses).into_iter().chain(strokes).chain(files).chain(faults);
    let warnings =
        warnings.map(|w| w.to_string()).chain(layers::warnings(&reports, opened.document.view.layer_method));
    if args.json {
        print_json(&json!({
            "output": args.output.to_string_lossy(),
            "resolution": size,
            "samples": args.samples,
            "adapter": session.renderer().gpu().adapter_name,
            "triangles": scene.triangle_count(),
            "blueprints": layers::as_json(&reports),
            "warnings": warnings.collect::<Vec<_>>(),
        }))
    } else {
        for warning in warnings {
            warn(&warning);
        }
        Ok(())
    }
}

/// A device that is opened while the files are read. It is always waited for: a program that ends while its graphics
/// driver starts may crash.
struct StartingDevice(Option<JoinHandle<Result<Gpu, GpuError>>>);

impl StartingDevice {
    fn new() -> Result<Self, CliError> {
        Ok(Self(Some(std::thread::Builder::new().name("device".to_owned()).spawn(Gpu::headless)?)))
    }

    fn wait(mut self) -> Result<Gpu, GpuError> {
        let failed = || GpuError::Lost("the driver failed while starting".to_owned());
        self.0.take().and_then(|thread| thread.join().ok()).ok_or_else(failed)?
    }
}

impl Drop for StartingDevice {
    fn drop(&mut self) {
        if let Some(thread) = self.0.take() {
            // What became of it matters to nobody any more.
            let _ = thread.join();
        }
    }
}

/// What `--set view.…` says, as far as it matters while files are read already. What is wrong is told with all other settings.
fn look_at_files(view: &mut ViewSettings, look: &LookArgs) {
    for setting in look.set.iter().filter(|setting| setting.key.starts_with("view.")) {
        let _ = param::set(&mut view.params(Color::WHITE), &setting.key, &setting.value);
    }
}

fn matching(scene: &Scene, pattern: &str) -> Result<Vec<NodeId>, CliError> {
    Ok(Document::matching(scene, &Pattern::new(pattern)?)?)
}

/// Sets styles, parameters and roles in their order of precedence, and warns of keys of earlier versions.
fn apply_look(opened: &mut Opened, look: &LookArgs) -> Result<Vec<Warning>, CliError> {
    let mut warnings = Vec::new();
    let mut loaded = |name: &str| -> Result<Style, CliError> {
        let preset = preset::load(name)?;
        warnings.extend(preset.renamed.iter().map(|renamed| Warning::new(name, renamed.to_string())));
        Ok(preset.style)
    };
    let Opened { document, scene } = opened;
    // Glyphs are meant by their paths too.
    let scene = &*document.scene_with_glyphs(scene);
    if let Some(name) = &look.style {
        document.style = loaded(name)?;
        for (_, node) in document.nodes.iter_mut().filter(|(path, _)| !path.starts_with(glyph::FOLDER)) {
            node.style = None;
        }
    }
    for assignment in &look.object_style {
        let style = loaded(&assignment.style)?;
        document.set_style(scene, &matching(scene, &assignment.pattern)?, &style);
    }
    if let Some(SectionAt { axis, position }) = look.section {
        document.section = SectionSettings { show: true, axis, position, ..document.section.clone() };
    }
    for setting in &look.set {
        let renamed = match &setting.pattern {
            None => document.set(&setting.key, &setting.value)?,
            Some(pattern) => {
                document.set_for(scene, &matching(scene, pattern)?, &setting.key, &setting.value)?
            }
        };
        warnings.extend(renamed.map(|renamed| Warning::new("--set", renamed.to_string())));
    }
    for pattern in &look.hide {
        for id in matching(scene, pattern)? {
            document.node_mut(&scene.nodes[id].path).visible = Some(false);
        }
    }
    for pattern in &look.no_enhance {
        for id in matching(scene, pattern)? {
            document.node_mut(&scene.nodes[id].path).enhanced = Some(false);
        }
    }
    for pattern in &look.mirror {
        document.set_role(scene, &matching(scene, pattern)?, Role::Mirror, true);
    }
    for pattern in &look.mask {
        document.set_role(scene, &matching(scene, pattern)?, Role::Mask, true);
    }
    document.up = look.up.or(document.up);
    document.meters_per_unit = look.unit.map(|unit| unit.meters).or(document.meters_per_unit);
    document.tidy();
    Ok(warnings)
}

/// The camera that the flags describe, as F3D reads them: position, focal point, up and angle first, then everything
/// is framed if no position was given, then azimuth and elevation.
fn camera(opened: &Opened, args: &CameraArgs, aspect: f64) -> Camera {
    let Opened { document, scene } = opened;
    let up = document.up(scene);
    let bounds = scene.bounds();
    let extent = document.scene_with_glyphs(scene).extent();
    let is_placed = args.camera_position.is_some();
    let mut camera = match (args.look_from, document.camera) {
        (Some(side), like) => side.camera(up, &extent, aspect, like.as_ref()),
        (None, Some(camera)) => camera,
        (None, None) if args.camera_azimuth_angle.or(args.camera_elevation_angle).is_some() || is_placed => {
            Camera::looking_from(up.front(), up.vector(), &extent, aspect)
        }
        (None, None) => initial_camera(document, scene, aspect),
    };
    if let Some(position) = args.camera_position {
        camera.position = position.0;
        camera.focal_point = bounds.center();
        camera.view_up = up.vector();
    }
    if let Some(focal_point) = args.camera_focal_point {
        let moved = focal_point.0 - camera.focal_point;
        camera.focal_point = focal_point.0;
        if !is_placed {
            camera.position += moved;
        }
    }
    if let Some(view_up) = args.camera_view_up {
        camera.view_up = view_up.0;
    }
    if let Some(view_angle) = args.camera_view_angle {
        camera.projection = Projection::Perspective { view_angle };
    }
    let azimuth = args.camera_azimuth_angle.unwrap_or(0.0);
    let elevation = args.camera_elevation_angle.unwrap_or(0.0);
    if azimuth != 0.0 || elevation != 0.0 {
        camera = camera.orbited(camera.view_up, azimuth, elevation);
    }
    if args.camera_orthographic {
        camera = camera.with_orthographic(true);
    }
    let is_free = document.camera.is_none() || args.look_from.is_some();
    let frames_all = !is_placed && args.camera_focal_point.is_none() && is_free;
    if frames_all {
        camera = camera.framing(&extent, aspect);
    }
    if let Some(view_height) = args.camera_view_height {
        camera.projection = Projection::Orthographic { view_height };
    }
    camera
}
