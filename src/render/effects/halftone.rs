//! Halftone: what the surface pass needs for it (Freudenberg et al. 2002; edge-enhancement paper, section 5).

pub mod calibration;
mod own_image;
pub mod threshold_map;

use std::path::Path;
use std::sync::{Arc, OnceLock};

use encase::ShaderType;
use glam::{DMat4, DVec3, Mat4, Vec2, Vec3};

use super::technique::{Shaded, Styled, SurfaceTechnique};
use crate::gpu::{ArrayBuffer, Gpu, GpuError, ImageArray, Inputs, Recorder, Target};
use crate::render::base::error::RenderError;
use crate::render::base::gpu_scene::{GpuScene, Origin};
use crate::render::base::ids::node_of;
use crate::render::base::instances::DrawCall;
use crate::render::base::object_axes::ObjectAxes;
use crate::render::base::stage::Stage;
use crate::render::base::style_images::StyleImages;
use crate::render::base::view::View;
use crate::render::passes::coordinates::{Coordinates, CoordinatesPass};
use crate::style::Technique;
use crate::style::halftone::{Mapping, Space, Texture};
use threshold_map::{LAYERS, LEVELS, PERIODS, SIDE, ThresholdMap};

/// Twin of `HalftoneStyle` in `shaders/effects/halftone.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub struct GpuHalftoneStyle {
    pattern_from_view: Mat4,
    ink: Vec3,
    ink_tint: f32,
    paper: Vec3,
    paper_tint: f32,
    turn: Vec2,
    tile: f32,
    footprint: f32,
    ambient: f32,
    object_tone: f32,
    black: f32,
    range: f32,
    gamma: f32,
    map: u32,
    space: u32,
}

// As in `shaders/effects/halftone.wgsl`.
const SCREEN: u32 = 1;
const TRIPLANAR: u32 = 2;
const UV: u32 = 3;

const THRESHOLDS: wgpu::TextureFormat = wgpu::TextureFormat::Rg8Unorm;

/// A threshold map.
#[derive(Debug, Clone)]
enum Map {
    BuiltIn(Texture),
    Own(Arc<ThresholdMap>),
}

impl PartialEq for Map {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::BuiltIn(a), Self::BuiltIn(b)) => a == b,
            // Each image has one map.
            (Self::Own(a), Self::Own(b)) => Arc::ptr_eq(a, b),
            _ => false,
        }
    }
}

/// All visible objects that are halftones.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Halftones {
    /// By object id; empty when there are none.
    styles: Vec<GpuHalftoneStyle>,
    /// Their threshold maps, by number.
    maps: Vec<Map>,
}

impl Halftones {
    /// Adds an object.
    fn set(&mut self, object: &Styled<'_>) {
        let (style, scale) = (&object.style.halftone, object.scale);
        let has_uvs = object.scene.has_uvs(object.node);
        let own = style.texture_image().and_then(|path| object.images.made(path, ThresholdMap::of_image));
        let map = own.map_or(Map::BuiltIn(style.texture), Map::Own);
        let map = self.maps.iter().position(|known| *known == map).unwrap_or_else(|| {
            self.maps.push(map);
            self.maps.len() - 1
        });
        let black = style.black;
        if let Some(slot) = object.entry(&mut self.styles) {
            *slot = GpuHalftoneStyle {
                // Where it lies on the surface depends on the camera: see `placed`.
                pattern_from_view: Mat4::IDENTITY,
                ink: style.ink.to_linear(),
                ink_tint: style.ink_tint,
                paper: style.paper.to_linear(),
                paper_tint: style.paper_tint,
                turn: Vec2::from_angle(style.angle.to_radians()),
                tile: style.scale * scale * PERIODS as f32,
                footprint: style.smoothness,
                ambient: style.ambient,
                object_tone: style.object_tone,
                black,
                // Points that meet make a step.
                range: (style.white - black).max(1e-3),
                gamma: style.gamma,
                map: map as u32,
                space: match (style.space, style.mapping) {
                    (Space::Screen, _) => SCREEN,
                    (Space::Surface, Mapping::Uv) if has_uvs => UV,
                    (Space::Surface, _) => TRIPLANAR,
                },
            };
        }
    }

    /// Whether an object (by id, with or without flag) needs coordinates on its surface.
    fn need_coordinates(&self, object: u32) -> bool {
        let style = node_of(object).and_then(|node| self.styles.get(node + 1));
        style.is_some_and(|s| s.space == UV)
    }

    /// The same with the place of the patterns for a camera.
    fn placed(&self, scene: &GpuScene, view: &View) -> Self {
        let placed = |(id, style): (usize, &GpuHalftoneStyle)| {
            let place = (style.space == TRIPLANAR).then(|| pattern_from_view(scene, id, view)).flatten();
            GpuHalftoneStyle { pattern_from_view: place.unwrap_or(Mat4::IDENTITY), ..*style }
        };
        Self { styles: self.styles.iter().enumerate().map(placed).collect(), maps: self.maps.clone() }
    }
}

/// From view space to the axes of an object, of which the diagonal becomes 1. In double precision up to there, so that patterns
/// keep their digits wherever the object is.
fn pattern_from_view(scene: &GpuScene, id: usize, view: &View) -> Option<Mat4> {
    let axes = ObjectAxes::of(scene, id as u32, view)?;
    let pattern = DMat4::from_scale(DVec3::splat(axes.diagonal.recip())) * axes.from_view;
    pattern.is_finite().then(|| pattern.as_mat4())
}

/// What halftones of all cameras share.
pub struct SharedHalftones {
    maps: ThresholdMaps,
    coordinates: CoordinatesPass,
}

/// Halftones on the device.
pub struct HalftoneShading {
    styles: ArrayBuffer,
    stage: Stage<(u64, Vec<DrawCall>), Target>,
    /// Coordinates on the surfaces of the layer that is shaded; `None` when no object asks for them.
    coordinates: Option<Target>,
}

impl SurfaceTechnique for HalftoneShading {
    const TECHNIQUE: Technique = Technique::Halftone;

    type Styles = Halftones;
    type Shared = SharedHalftones;

    fn shared(gpu: &Gpu) -> SharedHalftones {
        SharedHalftones {
            maps: ThresholdMaps::new(gpu),
            coordinates: CoordinatesPass::new(Coordinates::Texture),
        }
    }

    fn new(gpu: &Gpu) -> Self {
        Self { styles: ArrayBuffer::new(gpu, "halftone styles"), stage: Stage::default(), coordinates: None }
    }

    fn add(styles: &mut Halftones, object: &Styled<'_>) {
        if object.style.technique == Technique::Halftone {
            styles.set(object);
        }
    }

    fn placed(styles: &Halftones, scene: &GpuScene, view: &View) -> Halftones {
        styles.placed(scene, view)
    }

    fn prepare_image(images: &StyleImages, key: &str, path: &Path) {
        if key == "halftone.image" {
            images.made(path, ThresholdMap::of_image);
        }
    }

    fn switches(halftones: &Halftones) -> Vec<(&'static str, bool)> {
        let any = |space| halftones.styles.iter().any(|s| s.space == space);
        vec![
            ("WITH_HALFTONE", !halftones.styles.is_empty()),
            ("WITH_SCREEN", any(SCREEN)),
            ("WITH_TRIPLANAR", any(TRIPLANAR)),
            ("WITH_UV", any(UV)),
        ]
    }

    fn upload(
        &mut self,
        shared: &mut SharedHalftones,
        gpu: &Gpu,
        halftones: &Halftones,
    ) -> Result<(), RenderError> {
        if !halftones.styles.is_empty() {
            self.styles.write(gpu, &halftones.styles);
        }
        Ok(shared.maps.prepare(gpu, halftones)?)
    }

    fn begin(
        &mut self,
        rec: &mut Recorder<'_>,
        shared: &mut SharedHalftones,
        halftones: &Halftones,
        layer: &Shaded<'_>,
    ) -> Result<(), RenderError> {
        let asks = |call: &&DrawCall| {
            let object = layer.instances.get(call.instance as usize).map(|instance| instance.object);
            call.origin != Origin::Caps && object.is_some_and(|object| halftones.need_coordinates(object))
        };
        let calls: Vec<DrawCall> = layer.calls.iter().filter(asks).copied().collect();
        let (scene, has_any) = (layer.scene_view.scene, !calls.is_empty());
        let mut draw = |calls: &[DrawCall]| {
            shared.coordinates.run(rec, scene, layer.gbuffer, layer.instance_buffer, calls, None)
        };
        self.coordinates = match layer.revision {
            Some(revision) if has_any => {
                Some(self.stage.run((revision, calls), |(_, calls)| draw(calls))?.value)
            }
            None if has_any => Some(draw(&calls)?),
            _ => None,
        };
        if layer.revision.is_some() {
            rec.note("coordinates", self.coordinates.as_ref());
        }
        Ok(())
    }

    fn bind<'a>(&'a self, shared: &'a SharedHalftones, inputs: &mut Inputs<'a>) {
        inputs.set("halftone_styles", &self.styles);
        inputs.set("thresholds", shared.maps.thresholds.view());
        inputs.set("threshold_sampler", &shared.maps.sampler);
        inputs.set("calibration", &shared.maps.calibration);
        inputs.set("coordinates_tex", self.coordinates.as_ref());
    }
}

/// A built-in texture, read when first asked for; strokes, where an image is missing. They are made by
/// `assets/textures`.
pub fn built_in(texture: Texture) -> &'static ThresholdMap {
    static MAPS: [OnceLock<ThresholdMap>; 4] = [const { OnceLock::new() }; 4];
    macro_rules! images {
        ($name:literal) => {
            (
                include_bytes!(concat!("../../../assets/strokes/", $name, ".png")).as_slice(),
                include_bytes!(concat!("../../../assets/strokes/", $name, "_calibration.png")).as_slice(),
            )
        };
    }
    let (number, (steps, calibration)) = match texture {
        Texture::Strokes | Texture::Image => (0, images!("strokes")),
        Texture::Dots => (1, images!("dots")),
        Texture::Lines => (2, images!("lines")),
        Texture::Stipple => (3, images!("stipple")),
    };
    MAPS[number].get_or_init(|| {
        // A test reads them all.
        ThresholdMap::from_images(steps, calibration).unwrap_or_default()
    })
}

/// Threshold maps on the device: those that the visible objects use.
pub struct ThresholdMaps {
    uploaded: Vec<Map>,
    thresholds: ImageArray,
    calibration: ArrayBuffer,
    sampler: wgpu::Sampler,
}

impl ThresholdMaps {
    /// None yet; a shader that reads none is given an empty texture.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            uploaded: Vec::new(),
            thresholds: ImageArray::none(gpu, THRESHOLDS),
            calibration: ArrayBuffer::new(gpu, "calibration"),
            sampler: ImageArray::tile_sampler(gpu),
        }
    }

    /// Uploads what is not there yet.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub fn prepare(&mut self, gpu: &Gpu, halftones: &Halftones) -> Result<(), GpuError> {
        if halftones.maps.is_empty() || self.uploaded == halftones.maps {
            return Ok(());
        }
        gpu.check_texture_size("a halftone texture", [SIDE as u32; 2])?;
        let maps: Vec<&ThresholdMap> = halftones
            .maps
            .iter()
            .map(|map| match map {
                Map::BuiltIn(texture) => built_in(*texture),
                Map::Own(map) => map.as_ref(),
            })
            .collect();
        let count = (maps.len() * LAYERS) as u32;
        let thresholds = ImageArray::new(gpu, "thresholds", THRESHOLDS, SIDE as u32, count, LEVELS as u32);
        for (layer, levels) in maps.iter().flat_map(|map| &map.layers).enumerate() {
            for (level, texels) in levels.iter().enumerate() {
                thresholds.write(gpu, layer as u32, level as u32, texels.as_flattened());
            }
        }
        self.thresholds = thresholds;
        let calibration: Vec<f32> = maps.iter().flat_map(|map| &map.calibration).copied().collect();
        self.calibration.write(gpu, &calibration);
        self.uploaded.clone_from(&halftones.maps);
        Ok(())
    }
}
