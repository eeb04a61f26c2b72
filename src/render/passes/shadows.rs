//! Shadow maps and the shadow mask: what of them has to be drawn again. Maps depend on lights and objects only, so that
//! a turn of the camera redraws none of a light that stands still.

use glam::{DMat4, Vec2, Vec4};

use super::gbuffer::GBuffer;
use super::shadow_map::{ShadowCall, ShadowDraw, ShadowMapPass, ShadowScene};
use super::shadow_mask::ShadowPass;
use crate::gpu::{Gpu, Recorder, Target};
use crate::render::base::error::RenderError;
use crate::render::base::gpu_scene::{GpuScene, Origin};
use crate::render::base::group::{Group, VisibleSubmesh};
use crate::render::base::light_view::{LightView, ShadowReceivers, light_views};
use crate::render::base::lights::{MAX_SHADOWS, WorldLight};
use crate::render::base::scene_view::SceneView;
use crate::render::base::stage::{Output, Stage};
use crate::scene::AlphaMode;

/// The map of one light, and what it sees there.
#[derive(Debug, Clone)]
pub struct ShadowMap {
    map: Output<Target>,
    views: Vec<LightView>,
}

impl ShadowMap {
    /// Changes when it does.
    pub fn revision(&self) -> u64 {
        self.map.revision
    }
}

/// The maps of all lights that throw shadows.
pub struct ShadowMaps {
    maps: [(ShadowMapPass, Stage<MapKey, Target>); MAX_SHADOWS],
}

/// What a shadow map depends on.
#[derive(PartialEq)]
struct MapKey {
    shaders: u64,
    scene_revision: u64,
    seen: ShadowScene,
}

impl ShadowMaps {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self { maps: std::array::from_fn(|_| (ShadowMapPass::new(gpu), Stage::default())) }
    }

    /// How many maps have been drawn.
    pub fn runs(&self) -> u64 {
        self.maps.iter().map(|(_, stage)| stage.runs()).sum()
    }

    /// The maps of the lights that throw shadows, by channel, of these groups; those that the eye sees only as far as
    /// `fitted_to` lies, `None`: everywhere, as mirrors show what the eye does not see.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn run(
        &mut self,
        rec: &mut Recorder<'_>,
        scene_view: &SceneView<'_>,
        groups: &[&Group],
        fitted_to: Option<&[&Group]>,
        material_layout: &wgpu::BindGroupLayout,
    ) -> Result<Vec<ShadowMap>, RenderError> {
        let SceneView { scene, scene_revision, lights, view, .. } = *scene_view;
        let shaders = rec.pipelines.generation();
        let [width, height] = rec.size();
        let limit = rec.gpu.device.limits().max_texture_dimension_2d.min(MAX_TEXELS);
        let points = match fitted_to {
            Some(groups) => {
                let boxes = groups.iter().flat_map(|group| group.boxes(scene));
                let depths = view.fitted_depth_range(boxes);
                view.moved(Vec2::ZERO).corners(depths).to_vec()
            }
            None => Vec::new(),
        };
        let looked_at = ShadowReceivers { points, spread: f64::from(lights.spread) };
        let side = (lights.detail * width.max(height) as f32).round().max(MIN_TEXELS as f32) as u32;
        let mut casting = lights.casting();
        let mut made = Vec::new();
        for (pass, stage) in &mut self.maps {
            let Some(light) = casting.next() else {
                stage.clear();
                continue;
            };
            let seen = seen_by(light, scene, groups, &looked_at, side.min(limit));
            let views = seen.views.clone();
            let map = stage.run(MapKey { shaders, scene_revision, seen }, |MapKey { seen, .. }| {
                pass.run(rec, scene, material_layout, seen)
            })?;
            made.push(ShadowMap { map, views });
        }
        Ok(made)
    }
}

/// Greatest and least width of a shadow map, texels.
const MAX_TEXELS: u32 = 8192;
const MIN_TEXELS: u32 = 256;

/// All visible objects as a light sees them.
fn seen_by(
    light: &WorldLight,
    scene: &GpuScene,
    groups: &[&Group],
    looked_at: &ShadowReceivers,
    side: u32,
) -> ShadowScene {
    let boxes: Vec<_> = groups.iter().flat_map(|group| group.boxes(scene)).collect();
    let mut seen = ShadowScene {
        views: light_views(&light.kind, &boxes, looked_at, side),
        draws: Vec::new(),
        calls: Vec::new(),
        side,
    };
    for (number, view) in seen.views.iter().enumerate() {
        let clip_from_world = view.clip_from_light() * view.light_from_world;
        let throws = |part: &VisibleSubmesh| scene.scene.facing_of(part.node).is_none();
        for part in groups.iter().flat_map(|group| group.submeshes(scene)).filter(throws) {
            let alpha = scene.alpha(part.material);
            let has_attributes = scene.geometry(part.origin).attributes.is_some();
            let has_holes = alpha != AlphaMode::Opaque && has_attributes;
            let opacity = scene.scene.materials.get(part.material).map_or(1.0, |m| m.base_color.w);
            if alpha == AlphaMode::Blend && opacity < 0.5 {
                continue;
            }
            let light_from_local = view.light_from_world * part.world_from_local;
            let section = scene.section.as_ref().filter(|s| s.sectioned(part.node).is_some());
            let section = section.filter(|_| part.origin != Origin::Caps).map(|section| section.plane);
            seen.calls.push(ShadowCall {
                draw: seen.draws.len() as u32,
                view: number,
                origin: part.origin,
                first_index: part.first_index,
                index_count: part.index_count,
                base_vertex: part.base_vertex,
                material_group: scene.materials.group_index(part.material),
                has_holes,
                is_clipped: section.is_some(),
                culled_face: if has_holes {
                    None
                } else {
                    part.culled_face(scene, &light_from_local, !view.is_central)
                },
            });
            seen.draws.push(ShadowDraw {
                clip_from_local: (clip_from_world * part.world_from_local).as_mat4(),
                material: part.material(scene).throwing_shadows(),
                section: section
                    .map_or(Vec4::ZERO, |plane| (part.world_from_local.transpose() * plane).as_vec4()),
            });
        }
    }
    seen.calls
        .sort_by_key(|c| (c.view, c.origin, c.has_holes, c.is_clipped, c.culled_face.map(|s| s as u32)));
    seen
}

/// The shadow mask of one camera's picture.
pub struct ShadowMask {
    pass: ShadowPass,
    stage: Stage<MaskKey, Option<Target>>,
}

/// What a shadow mask depends on.
#[derive(PartialEq)]
struct MaskKey {
    shaders: u64,
    gbuffer: u64,
    view_from_world: DMat4,
    /// Of each light.
    maps: Vec<u64>,
    spread: f32,
}

impl ShadowMask {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self { pass: ShadowPass::new(gpu), stage: Stage::default() }
    }

    /// How often it has been drawn.
    pub fn runs(&self) -> u64 {
        self.stage.runs()
    }

    /// The mask of a depth layer, always drawn anew.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn of_layer(
        &mut self,
        rec: &mut Recorder<'_>,
        layer: &GBuffer,
        scene_view: &SceneView<'_>,
        maps: &[ShadowMap],
    ) -> Result<Option<Target>, RenderError> {
        let maps: Vec<_> = maps.iter().map(|m| (m.views.as_slice(), &m.map.value)).collect();
        self.pass.run(rec, layer, &scene_view.view.view_from_world, &maps, scene_view.lights.spread)
    }

    /// Channel i: how much of the light of channel i reaches each pixel; `None` when no light throws shadows.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn run(
        &mut self,
        rec: &mut Recorder<'_>,
        gbuffer: &Output<GBuffer>,
        scene_view: &SceneView<'_>,
        maps: &[ShadowMap],
    ) -> Result<Option<Output<Target>>, RenderError> {
        let view_from_world = &scene_view.view.view_from_world;
        let spread = scene_view.lights.spread;
        if maps.is_empty() {
            self.stage.clear();
            return Ok(None);
        }
        let key = MaskKey {
            shaders: rec.pipelines.generation(),
            gbuffer: gbuffer.revision,
            view_from_world: *view_from_world,
            maps: maps.iter().map(ShadowMap::revision).collect(),
            spread,
        };
        let mask = self.stage.run(key, |_| {
            let maps: Vec<_> = maps.iter().map(|m| (m.views.as_slice(), &m.map.value)).collect();
            self.pass.run(rec, &gbuffer.value, view_from_world, &maps, spread)
        })?;
        Ok(mask.value.map(|value| Output { value, revision: mask.revision }))
    }
}
