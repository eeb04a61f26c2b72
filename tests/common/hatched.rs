//! Hatched pictures for measurements.

use hachure::export::Session;
use hachure::export::session::{Opened, initial_camera};
use hachure::gpu::readback;
use hachure::render::base::view::REFERENCE_HEIGHT;
use hachure::render::{Picture, Request};
use hachure::style::hatching::{Hatching, Mapping};
use hachure::style::{Color, Curve, Style, Technique, preset};
use image::RgbaImage;

/// Black strokes on white of one darkness everywhere, without lines, in a picture so high (px).
pub fn even(mut hatching: Hatching, darkness: f32, side: u32) -> Style {
    let tone = (1.0 - darkness) * 1000.0;
    let points = [[0.0, tone.round() / 1000.0], [1.0, tone.round() / 1000.0]];
    hatching.tone.curve = Curve::of_points(&points.map(Into::into)).unwrap();
    (hatching.tone.lightest, hatching.tone.darkest) = (0.0, 1.0);
    (hatching.ink, hatching.paper) = (Color([0; 3]), Color([255; 3]));
    hatching.indication.amount = 0.0;
    // As large as in a picture of 1080 pixels.
    let stroke = &mut hatching.stroke;
    let larger = REFERENCE_HEIGHT as f32 / side as f32;
    for length in [&mut stroke.spacing, &mut stroke.length, &mut stroke.taper, &mut stroke.gap] {
        *length *= larger;
    }
    let mut style = Style { technique: Technique::Hatching, hatching, ..Style::default() };
    (style.edges.profile.show, style.edges.inner.show) = (false, false);
    style
}

/// As the window shows it while something moves: the first of several samples. The scene must have been set.
pub fn moving(session: &mut Session, opened: &Opened, side: u32) -> Picture {
    session.find_stripes(&opened.document, &opened.scene).unwrap();
    let Opened { document, scene, .. } = opened;
    let camera = document.camera.unwrap_or_else(|| initial_camera(document, scene, 1.0));
    let request =
        Request { document, camera: &camera, size: [side; 2], transparent: true, selected: &[], samples: 2 };
    session.renderer().render(&request).unwrap()
}

/// Reads a picture back.
pub fn read(session: &mut Session, picture: &Picture) -> RgbaImage {
    let [width, height] = picture.image.size();
    RgbaImage::from_raw(width, height, readback::read(session.renderer().gpu(), &picture.image).unwrap())
        .unwrap()
}

/// Share of ink of each pixel; `None` beside the model.
pub fn inks(picture: &RgbaImage) -> Vec<Option<f64>> {
    let ink = |p: &image::Rgba<u8>| {
        let c = f64::from(p.0[1]) / 255.0;
        let linear = if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) };
        (p.0[3] == 255).then_some(1.0 - linear)
    };
    picture.pixels().map(ink).collect()
}

/// The presets that are hatched with stripes.
pub fn presets() -> Vec<(String, Hatching)> {
    let all = preset::all().into_iter().filter(|preset| preset.style.technique == Technique::Hatching);
    let mut presets: Vec<_> =
        all.map(|preset| (preset.name.clone(), preset.style.hatching.clone())).collect();
    presets.push(("default".to_owned(), Hatching::default()));
    presets.retain(|(_, hatching)| hatching.mapping == Mapping::Stripes);
    presets
}
