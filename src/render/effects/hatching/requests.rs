//! What hatching asks for that takes long: stripes on meshes, and maps of strokes that styles describe.

use std::sync::Arc;

use glam::{DVec3, Vec3};

use crate::document::Document;
use crate::geometry::{DirectionSource, FieldOptions};
use crate::hatching::tonal_art_map::composition::COMPOSED_INKS;
use crate::hatching::tonal_art_map::generator::Recipe;
use crate::hatching::tonal_art_map::stroke::StrokeShape;
use crate::hatching::tonal_art_map::stroke_image::{StrokeImage, StrokeImageError};
use crate::render::base::gpu_scene::GpuScene;
use crate::render::base::stripes::{StripeRequest, StripesBy};
use crate::render::base::stroke_maps::StrokeMaps;
use crate::render::base::style_images::StyleImages;
use crate::scene::{NodeId, Texture};
use crate::style::hatching::{Direction, Hatching, Mapping, Set};
use crate::style::{Style, Technique};

/// How far directions reach into places that have none of their own, in diagonals of the scene: between what suits things that grew
/// (0.08) and things that were constructed (0.05).
const SMOOTHING: f32 = 0.06;

/// The stripes that an object of a style asks for; `None`: none, or it is no part of the model.
pub(super) fn request_of(
    scene: &GpuScene,
    node: NodeId,
    style: &Hatching,
    by: StripesBy,
) -> Option<StripeRequest> {
    let data = scene.scene.nodes.get(node)?;
    let mesh = data.mesh?;
    if scene.scene.is_added(node) {
        return None;
    }
    let linear = [data.world_from_local.x_axis, data.world_from_local.y_axis, data.world_from_local.z_axis];
    let size = linear.map(|axis| axis.truncate().length()).iter().sum::<f64>() / 3.0;
    let extent = (scene.diagonal() / size) as f32;
    let local_from_world = data.world_from_local.inverse();
    let local = |axis: DVec3| local_from_world.transform_vector3(axis).as_vec3().normalize_or(Vec3::Y);
    let has_uvs = scene.has_uvs(node);
    let source = match style.direction {
        Direction::TextureU if has_uvs => DirectionSource::TextureU,
        Direction::TextureV if has_uvs => DirectionSource::TextureV,
        Direction::X => DirectionSource::Axis(local(DVec3::X)),
        Direction::Y => DirectionSource::Axis(local(DVec3::Y)),
        Direction::Z => DirectionSource::Axis(local(DVec3::Z)),
        // Where the light turns with the eye, no stripe could stay.
        Direction::Light => DirectionSource::Axis(local(by.fixed_light?)),
        Direction::Curvature | Direction::TextureU | Direction::TextureV => DirectionSource::Curvature,
    };
    let options = FieldOptions {
        extent: if extent.is_finite() { extent } else { 0.0 },
        source,
        smoothing: SMOOTHING,
        crease_rule: by.crease_rule,
        up: local(scene.scene.up.vector()),
        ..FieldOptions::default()
    };
    Some(StripeRequest { mesh, options })
}

/// The stripes that a document asks for and that are not on the device yet, each once.
pub fn missing(document: &Document, scene: &GpuScene) -> Vec<StripeRequest> {
    let mut missing = Vec::new();
    let by = StripesBy::new(document, &scene.scene);
    for (node, resolved) in document.resolve(&scene.scene).iter().enumerate() {
        if !resolved.visible || !asks(resolved.style) {
            continue;
        }
        let request = request_of(scene, node, &resolved.style.hatching, by);
        if let Some(request) = request.filter(|r| scene.stripe_place(r).is_none() && !missing.contains(r)) {
            missing.push(request);
        }
    }
    missing
}

fn asks(style: &Style) -> bool {
    style.technique == Technique::Hatching
}

/// The strokes of a style, if it describes any.
pub(super) fn recipe_of(style: &Hatching, set: Set, images: &StyleImages) -> Option<Recipe> {
    let own = &style.own;
    let image = match set {
        Set::Own => None,
        Set::Painted => {
            Some(Arc::clone(images.made(own.image.as_ref()?, stroke_image)?.as_ref().as_ref().ok()?))
        }
        _ => return None,
    };
    let shape = StrokeShape {
        length: own.length,
        length_spread: own.length_spread,
        width: own.width,
        width_spread: own.width_spread,
        taper: [own.taper_in, own.taper_out],
        waviness: own.waviness,
        angle_spread: own.turn_spread.to_radians(),
        pressure: own.pressure,
        grain: own.grain,
        image,
    };
    Some(Recipe {
        shape,
        inks: COMPOSED_INKS.to_vec(),
        candidates: CANDIDATES,
        seed: u64::from(own.seed),
        ..Recipe::default()
    })
}

/// Of so many random strokes the best is taken: few enough that a person waits.
const CANDIDATES: usize = 100;

/// The stroke that an image shows, or why it shows none.
fn stroke_image(image: &Texture) -> Result<Arc<StrokeImage>, StrokeImageError> {
    let gray: Vec<f32> = image.rgba.as_chunks::<4>().0.iter().map(|t| gray_of(*t)).collect();
    StrokeImage::new(image.width as usize, image.height as usize, &gray).map(Arc::new)
}

/// What is transparent is paper.
fn gray_of([r, g, b, alpha]: [u8; 4]) -> f32 {
    let [r, g, b, alpha] = [r, g, b, alpha].map(|c| f32::from(c) / 255.0);
    1.0 - (1.0 - (0.2126 * r + 0.7152 * g + 0.0722 * b)).clamp(0.0, 1.0) * alpha
}

/// The sets of strokes that a style draws with.
pub(super) fn sets_of(style: &Hatching) -> impl Iterator<Item = Set> {
    let has_textures = style.mapping != Mapping::Stripes;
    let shadows = style.shadows.differ.then_some(style.shadows.set);
    std::iter::once(style.set).chain(shadows).filter(move |_| has_textures)
}

/// The maps of strokes that a document asks for and that have not been drawn yet, each once.
pub fn missing_strokes(document: &Document, known: &StrokeMaps, images: &StyleImages) -> Vec<Recipe> {
    let nodes = document.nodes.values().filter_map(|node| node.style.as_ref());
    let styles = std::iter::once(&document.style).chain(nodes).filter(|style| asks(style));
    let mut missing: Vec<Recipe> = Vec::new();
    for style in styles.map(|style| &style.hatching) {
        for recipe in sets_of(style).filter_map(|set| recipe_of(style, set, images)) {
            if !known.is_known(&recipe) && !missing.contains(&recipe) {
                missing.push(recipe);
            }
        }
    }
    missing
}

/// Why an image that a style names as a painted stroke is none.
pub fn stroke_image_fault(image: &Texture) -> Option<StrokeImageError> {
    stroke_image(image).err()
}
