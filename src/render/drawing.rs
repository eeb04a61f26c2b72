//! The scene drawn once, from one camera; and what its mirrors show, each by a drawing of its own.
//!
//! ```text
//! objects ─► G-buffer ─┬─► (shadow mask ─► cartoon map ─►) surfaces ┬─► + mirrors (drawings) ─► + hidden lines ─► + lines ─► + blueprints ─► colour
//!                      └─► edge map ─► reach of the lines ──────────┘
//! segments (topology) ─────┘
//! ```

mod layered;
mod reflections;
mod tones;

use std::sync::Arc;

use glam::{UVec2, Vec2, Vec4};

use self::reflections::Reflection;
use super::RenderError;
use super::effects::blended::{Blend, Blended, Opaque};
use super::effects::blueprint::Blueprints;
use super::effects::halftone::{HalftoneInputs, HalftoneUniform, Halftones, ThresholdMaps};
use super::effects::hidden::HiddenLines;
use super::effects::mirror::{MirrorUniform, mirror};
use super::effects::section::{CapUniform, caps};
use super::effects::surface::{Shading, SurfaceUniform, surface};
use super::effects::toon::{ToonBuffers, Toons};
use super::frame_uniform::{FrameUniform, View};
use super::gpu_scene::{GpuScene, Origin};
use super::groups::Objects;
use super::lights::Lights;
use super::passes::depth_mask::DepthMaskPass;
use super::passes::edge_map::{EdgeInputs, EdgeMap, edge_map};
use super::passes::edge_style::EdgeUniform;
use super::passes::gbuffer::{GBuffer, GBufferPass};
use super::passes::instances::{DrawCall, Instance, Instances};
use super::passes::line_distance::{Reach, line_distance};
use super::passes::lines::{Lines, Pen, lines};
use super::passes::overlay::overlay;
use super::passes::peel::Layer;
use super::passes::segments::Segments;
use super::sample::Sample;
use super::segments::segments;
use super::shadows::{ShadowMap, ShadowMask};
use super::stage::{Output, Stage};
use crate::document;
use crate::geometry::{EdgeClass, LineSegment};
use crate::gpu::{ArrayBuffer, Gpu, Recorder, Target, UniformBuffer};

/// What is to be drawn, and from where.
#[derive(Clone, Copy)]
pub struct DrawingInputs<'a> {
    /// The scene on the device.
    pub scene: &'a GpuScene,
    /// Changes when the scene does.
    pub scene_revision: u64,
    /// Styles and roles, resolved.
    pub objects: &'a Objects,
    /// Above it edges separate surfaces; radians.
    pub crease_angle: f32,
    /// The lights.
    pub lights: &'a Lights,
    /// The maps of those that throw shadows, by channel; they are for all cameras.
    pub shadow_maps: &'a [ShadowMap],
    /// Which sample of the picture this is.
    pub sample: Sample,
    /// The camera, moved by the sample's jitter.
    pub view: &'a View,
    /// Paper: linear colour and opacity.
    pub background: Vec4,
    /// How many mirrors in a row are followed from here.
    pub reflections: u32,
    /// Whether the layers of blueprints are kept.
    pub keeps_layers: bool,
    /// How depth layers are to be made.
    pub layers_by: document::LayersBy,
}

/// A drawing while it is being made: what all of its passes read.
pub struct Begun {
    /// All that is in bind group 0.
    pub uniform: FrameUniform,
    /// Linear depth range of the enhanced objects.
    pub depth_range: Vec2,
    /// Per-pixel geometry.
    pub gbuffer: Output<GBuffer>,
    /// See [`ShadowMask`]; `None` when no light throws shadows.
    pub shadow_mask: Option<Output<Target>>,
    /// The draws of those objects whose style asks for coordinates on their surface.
    with_coordinates: Vec<DrawCall>,
}

/// Surfaces with their lines.
#[derive(Debug, Clone)]
pub struct Shaded {
    /// Linear colour times opacity, and opacity.
    pub color: Output<Target>,
    /// See `shaders/effects/toon.wgsl`; `None` when no object asks for it.
    pub cartoon_map: Option<Target>,
    /// See `shaders/passes/coordinates.wgsl`; `None` when no object asks for it.
    pub coordinates: Option<Target>,
    /// Reversed depth of the designated objects alone; `None` when no blueprint is peeled for them.
    pub depth_mask: Option<Target>,
    /// Geometry of the first drawn layer of each blueprint, and their revisions.
    pub fronts: (Vec<u64>, Vec<Target>),
    /// The layers of each blueprint, the farthest first; empty unless they are kept.
    pub layers: Vec<Vec<Layer>>,
}

/// What all drawings have in common across frames.
pub struct Shared {
    /// Pipelines of the geometry.
    pub gbuffer: GBufferPass,
    /// Textures of halftones.
    pub thresholds: ThresholdMaps,
}

impl Shared {
    /// Compiles and uploads nothing yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self { gbuffer: GBufferPass::new(gpu), thresholds: ThresholdMaps::new(gpu) }
    }
}

/// What of a drawing lives across frames.
pub struct Drawing {
    uniform: UniformBuffer<FrameUniform>,
    frame_group: wgpu::BindGroup,
    draws: Instances,
    placed_segments: Segments,
    greatest_radius: ArrayBuffer,
    edge_styles: ArrayBuffer,
    surface_styles: ArrayBuffer,
    toon_styles: ArrayBuffer,
    toon_bands: ArrayBuffer,
    halftone_styles: ArrayBuffer,
    caps: ArrayBuffer,
    gbuffer: Stage<(u64, u64, UVec2, Option<View>, Vec<Instance>, Vec<DrawCall>), GBuffer>,
    segments: Stage<(u64, View, Vec<EdgeUniform>, f32), Arc<Vec<LineSegment>>>,
    edge_map: Stage<([u64; 2], Vec<EdgeUniform>, Vec2, Option<FrameUniform>), EdgeMap>,
    reach: Stage<u64, Reach>,
    shadow_mask: ShadowMask,
    cartoon_map: Stage<(u64, u64, Toons, FrameUniform), Target>,
    coordinates: Stage<(u64, Vec<DrawCall>), Target>,
    surface: Stage<
        (
            [u64; 2],
            Option<[u64; 2]>,
            Vec<SurfaceUniform>,
            Toons,
            (Vec<HalftoneUniform>, Halftones),
            Vec<EdgeUniform>,
            FrameUniform,
            Seen,
            Option<u64>,
            Option<Blend>,
            Vec<u64>,
            Vec<CapUniform>,
        ),
        (Target, Option<Target>),
    >,
    depth_mask: DepthMaskPass,
    /// `None` while nothing blends.
    blended: Option<Blended>,
    /// `None` while no object has any.
    hidden: Option<HiddenLines>,
    blueprints: Vec<Blueprints>,
    /// How often a blueprint was drawn.
    blueprinted: u64,
    reflections: Vec<Reflection>,
    /// How often a reflection was drawn.
    reflected: u64,
}

/// What is seen in mirrors: the revision of each drawing and how it is laid over its mirror; and the paper, which they
/// show too.
type Seen = Option<(Vec<(u64, MirrorUniform)>, Vec4)>;

impl Drawing {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu, frame_layout: &wgpu::BindGroupLayout) -> Self {
        let uniform = UniformBuffer::new(gpu, "frame");
        let nearest = gpu
            .device
            .create_sampler(&wgpu::SamplerDescriptor { label: Some("nearest"), ..Default::default() });
        let frame_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("frame"),
            layout: frame_layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: uniform.buffer().as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::Sampler(&nearest) },
            ],
        });
        Self {
            uniform,
            frame_group,
            draws: Instances::new(gpu),
            placed_segments: Segments::new(gpu),
            greatest_radius: ArrayBuffer::new(gpu, "greatest radius"),
            edge_styles: ArrayBuffer::new(gpu, "edge styles"),
            surface_styles: ArrayBuffer::new(gpu, "surface styles"),
            toon_styles: ArrayBuffer::new(gpu, "toon styles"),
            toon_bands: ArrayBuffer::new(gpu, "toon bands"),
            halftone_styles: ArrayBuffer::new(gpu, "halftone styles"),
            caps: ArrayBuffer::new(gpu, "caps"),
            gbuffer: Stage::default(),
            segments: Stage::default(),
            edge_map: Stage::default(),
            reach: Stage::default(),
            shadow_mask: ShadowMask::new(gpu),
            cartoon_map: Stage::default(),
            coordinates: Stage::default(),
            surface: Stage::default(),
            depth_mask: DepthMaskPass::new(gpu),
            blended: None,
            hidden: None,
            blueprints: Vec::new(),
            blueprinted: 0,
            reflections: Vec::new(),
            reflected: 0,
        }
    }

    /// Bind group 0 of its passes.
    pub fn frame_group(&self) -> &wgpu::BindGroup {
        &self.frame_group
    }

    /// Edge styles by object id on the device.
    pub fn edge_styles(&self) -> &wgpu::Buffer {
        self.edge_styles.buffer()
    }

    /// How often each stage has run, by name.
    pub fn runs(&self) -> [(&'static str, u64); 9] {
        [
            ("g-buffer", self.gbuffer.runs()),
            ("edge map", self.edge_map.runs()),
            ("line distance", self.reach.runs()),
            ("shadow", self.shadow_mask.runs()),
            ("cartoon map", self.cartoon_map.runs()),
            ("surface", self.surface.runs()),
            ("hidden lines", self.hidden.as_ref().map_or(0, HiddenLines::runs)),
            ("blueprint", self.blueprinted),
            ("mirror", self.reflected),
        ]
    }

    /// Begins a drawing with its G-buffer and the shadows on it; all later passes see through its camera.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn begin(
        &mut self,
        rec: &mut Recorder<'_>,
        shared: &mut Shared,
        inputs: &DrawingInputs<'_>,
    ) -> Result<Begun, RenderError> {
        let DrawingInputs { scene, objects, view, sample, lights, background, .. } = *inputs;
        let depth_range = view.fitted_depth_range(objects.enhanced_boxes(scene));
        let uniform = FrameUniform::new(view, sample, depth_range, lights, background);
        self.uniform.write(rec.gpu, &uniform);
        self.look_through(rec, view);
        self.edge_styles.write(rec.gpu, &objects.surfaces.edge_styles);

        let (draws, calls) = objects.surfaces.draws(scene, view);
        let with_coordinates = calls
            .iter()
            .filter(|call| {
                let draw = draws.get(call.draw as usize);
                call.origin != Origin::Caps
                    && draw.is_some_and(|draw| objects.halftones.need_coordinates(draw.object))
            })
            .copied()
            .collect();
        // Nothing looks the same from everywhere.
        let through = (!calls.is_empty()).then_some(*view);
        let shaders = rec.pipelines.generation();
        let geometry = (shaders, inputs.scene_revision, view.size, through, draws, calls);
        let gbuffer = self.gbuffer.run(geometry, |(.., draws, calls)| {
            shared.gbuffer.run(rec, scene, &mut self.draws, (draws, calls), view.has_cuts(), None)
        })?;
        let shadow_mask = self.shadow_mask.run(rec, &gbuffer, inputs)?;
        Ok(Begun { uniform, depth_range, gbuffer, shadow_mask, with_coordinates })
    }

    fn look_through(&self, rec: &mut Recorder<'_>, view: &View) {
        rec.frame = self.frame_group.clone();
        rec.part = view.part;
    }

    /// The edges of what was begun.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn find_edges(
        &mut self,
        rec: &mut Recorder<'_>,
        inputs: &DrawingInputs<'_>,
        begun: &Begun,
    ) -> Result<Output<EdgeMap>, RenderError> {
        let styles: Vec<_> =
            inputs.objects.surfaces.edge_styles.iter().map(EdgeUniform::for_finding).collect();
        // Only widths that follow the light depend on more than the geometry.
        let light = styles.iter().any(|s| s.by_light > 0.0).then(|| begun.uniform.without_background());
        // Which edges are lines does not change from sample to sample.
        let view = inputs.view.moved(Vec2::ZERO);
        let found = (inputs.scene_revision, view, styles.clone(), inputs.crease_angle);
        let segments = self.segments.run(found, |_| {
            let found = segments(inputs.scene, &inputs.objects.surfaces, &view, inputs.crease_angle);
            Ok::<_, RenderError>(Arc::new(found))
        })?;
        let has_borders = styles.iter().any(|s| s.draws(EdgeClass::Shadow));
        let shadow_mask = begun.shadow_mask.as_ref().filter(|_| has_borders);
        let revisions = [begun.gbuffer.revision, shadow_mask.map_or(0, |mask| mask.revision)];
        let edges = (revisions, styles, begun.depth_range, light);
        self.edge_map.run(edges, |(_, styles, ..)| {
            self.placed_segments.write(rec, &segments.value, false)?;
            edge_map(
                rec,
                &EdgeInputs {
                    gbuffer: &begun.gbuffer.value,
                    styles,
                    edge_styles: self.edge_styles.buffer(),
                    is_whole: true,
                    seen: None,
                    marked: None,
                    segments: &self.placed_segments,
                    has_holes: inputs.objects.surfaces.has_holes,
                    is_cut: view.cut.is_some(),
                    before: None,
                    shadow_mask: shadow_mask.map(|mask| &mask.value),
                },
            )
        })
    }

    /// Without lines: lets go of the last edge map.
    pub fn forget_edges(&mut self) {
        self.edge_map.clear();
    }

    /// Without surfaces: lets go of the last ones.
    pub fn forget_surfaces(&mut self) {
        self.surface.clear();
        self.cartoon_map.clear();
        self.coordinates.clear();
    }

    /// Shades what was begun and draws the lines over it.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn shade(
        &mut self,
        rec: &mut Recorder<'_>,
        shared: &mut Shared,
        inputs: &DrawingInputs<'_>,
        begun: &Begun,
        edge_map: Option<&Output<EdgeMap>>,
    ) -> Result<Shaded, RenderError> {
        let reflected = self.reflect(rec, shared, inputs)?;
        let mask = self.depth_mask.run(rec, &mut shared.gbuffer, inputs, &begun.gbuffer)?;
        let blueprints = self.peel(rec, &mut shared.gbuffer, inputs, (begun, mask.as_ref()))?;
        let hidden = self.draw_hidden(rec, &mut shared.gbuffer, inputs, begun, edge_map)?;
        let cartoon_map = self.find_bands(rec, inputs, begun)?;
        let coordinates = self.find_coordinates(rec, shared, inputs, begun)?;
        shared.thresholds.prepare(rec.gpu, &inputs.objects.halftones)?;
        let gbuffer = &begun.gbuffer;
        let styles = &inputs.objects.surfaces.edge_styles;
        let spines = edge_map.and_then(|e| Some((e.revision, e.value.spines.as_ref()?)));
        let reach = match spines {
            Some((revision, spines)) => Some(
                self.reach
                    .run(revision, |_| line_distance(rec, spines, styles, &mut self.greatest_radius))?,
            ),
            None => {
                self.reach.clear();
                None
            }
        };
        let revisions = edge_map.map(|e| [e.revision, reach.as_ref().map_or(0, |reach| reach.revision)]);
        let shading = (
            [gbuffer.revision, begun.shadow_mask.as_ref().map_or(0, |mask| mask.revision)],
            revisions,
            inputs.objects.surface_styles.clone(),
            inputs.objects.toons.clone(),
            (inputs.objects.halftones.placed(inputs.scene, inputs.view), inputs.objects.halftones.clone()),
            styles.clone(),
            begun.uniform.without_background(),
            (!reflected.is_empty()).then(|| {
                let seen = reflected.iter().map(|r| (r.color.revision, r.uniform)).collect();
                (seen, inputs.background)
            }),
            hidden.as_ref().map(|hidden| hidden.revision),
            Blend::new(inputs),
            blueprints.iter().map(|(_, b)| b.revision).collect(),
            caps(inputs.scene, inputs.view, inputs.objects.scale),
        );
        let drawn = self.surface.run(shading, |shading| {
            let (_, _, surfaces, toons, (halftones, _), styles, .., blend, _, caps) = shading;
            let is_bare = inputs.objects.surfaces.is_empty() && blend.is_none();
            if let ([(_, only)], true) = (&blueprints[..], is_bare) {
                return Ok((only.value.color.clone(), None));
            }
            self.surface_styles.write(rec.gpu, surfaces);
            if !caps.is_empty() {
                self.caps.write(rec.gpu, caps);
            }
            if !halftones.is_empty() {
                self.halftone_styles.write(rec.gpu, halftones);
            }
            let shading = Shading {
                surfaces,
                surface_styles: self.surface_styles.buffer(),
                toons,
                toon_buffers: ToonBuffers {
                    styles: self.toon_styles.buffer(),
                    bands: self.toon_bands.buffer(),
                },
                shadow_mask: begun.shadow_mask.as_ref().map(|mask| &mask.value),
                cartoon_map: cartoon_map.as_ref(),
                halftones: HalftoneInputs {
                    styles: halftones,
                    style_buffer: self.halftone_styles.buffer(),
                    maps: &shared.thresholds,
                    coordinates: coordinates.as_ref(),
                },
                caps: (!caps.is_empty()).then_some(self.caps.buffer()),
                blends: false,
            };
            let color = surface(rec, &gbuffer.value, &shading)?;
            for seen in &reflected {
                let Some(reflection) = self.reflections.get_mut(seen.index) else { continue };
                reflection.uniform.write(rec.gpu, &vec![seen.uniform]);
                mirror(rec, &gbuffer.value, &seen.color.value, reflection.uniform.buffer(), &color)?;
            }
            if let Some(hidden) = &hidden {
                overlay(rec, &hidden.value, &color)?;
            }
            let opaque_lines = edge_map.map(|edge_map| Lines {
                gbuffer: &gbuffer.value,
                edge_map: &edge_map.value,
                reach: reach.as_ref().map(|reach| &reach.value),
                styles,
                edge_styles: self.edge_styles.buffer(),
            });
            if let Some(opaque_lines) = &opaque_lines {
                lines(rec, opaque_lines, &Pen::PLAIN, &color)?;
            }
            let panes = match blend {
                Some(blend) => {
                    let blended = self.blended.get_or_insert_with(|| Blended::new(rec.gpu));
                    let opaque = Opaque { gbuffer: &gbuffer.value, lines: opaque_lines.as_ref() };
                    let shaded = (&shading, &mut self.shadow_mask);
                    Some(blended.run(rec, &mut shared.gbuffer, inputs, blend, opaque, shaded)?)
                }
                None => {
                    self.blended = None;
                    None
                }
            };
            let mut pictures: Vec<_> =
                blueprints.iter().map(|(depth, peels)| (*depth, &peels.value.color)).collect();
            if let Some(panes) = &panes {
                pictures.push((inputs.objects.blended.mean_depth(inputs.scene, inputs.view), &panes.color));
                pictures.sort_by(|(a, _), (b, _)| b.total_cmp(a));
            }
            for (_, picture) in pictures {
                overlay(rec, picture, &color)?;
            }
            Ok::<_, RenderError>((color, panes.and_then(|panes| panes.front)))
        })?;
        let (color, front_pane) = drawn.value;
        let color = Output { value: color, revision: drawn.revision };
        let mut fronts: (Vec<_>, Vec<_>) =
            blueprints.iter().filter_map(|(_, b)| Some((b.revision, b.value.front.clone()?))).unzip();
        fronts.0.extend(front_pane.as_ref().map(|_| drawn.revision));
        fronts.1.extend(front_pane);
        let layers = blueprints.into_iter().map(|(_, b)| b.value.layers).filter(|l| !l.is_empty()).collect();
        let depth_mask = mask.map(|mask| mask.value.depth);
        Ok(Shaded { color, cartoon_map, coordinates, depth_mask, fronts, layers })
    }
}
