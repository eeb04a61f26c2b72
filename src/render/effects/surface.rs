//! Shading of a layer by the surface techniques, from its G-buffer in full-screen passes: the scene is traversed once, where
//! the edge-enhancement paper's pipeline traverses it twice. Opaque surfaces, what blends and whatever else has layers are
//! shaded by this alone.
//!
//! A layer of several techniques has a pass for each: software devices run all branches of a shader for every pixel. A pass
//! before them writes the number of each pixel's technique as a depth, by which each of them finds its own pixels.

use encase::ShaderType;
use glam::Vec3;
use strum::IntoEnumIterator as _;

use super::section::{GpuCap, draw_caps};
use super::technique::{Shaded, Styled};
use super::techniques::{SharedTechniques, TechniqueStyles, Techniques};
use crate::gpu::recorder::{Draw, Onto};
use crate::gpu::{ArrayBuffer, DepthRule, Gpu, Program, Recorder, Target, inputs};
use crate::render::base::error::RenderError;
use crate::render::base::scene_view::SceneView;
use crate::render::base::stage::Output;
use crate::render::passes::edge_map::EdgeMap;
use crate::render::passes::gbuffer::DEPTH;
use crate::style::{Style, Technique};

/// Twin of `SurfaceStyle` in `shaders/effects/surface.wgsl`; by default paper only.
#[derive(Debug, Clone, Copy, PartialEq, ShaderType, Default)]
pub struct GpuSurfaceStyle {
    designated_color: Vec3,
    ambient: f32,
    technique: u32,
}

impl GpuSurfaceStyle {
    fn new(style: &Style) -> Self {
        Self {
            designated_color: style.blueprint.designated_color.to_linear(),
            ambient: style.plain.ambient,
            // The shader's constants have the same order.
            technique: style.technique as u32,
        }
    }
}

/// How all visible objects are shaded, by value.
#[derive(Clone, PartialEq, Default)]
pub struct SurfaceStyles {
    /// By object id.
    surfaces: Vec<GpuSurfaceStyle>,
    /// What their techniques ask for.
    techniques: TechniqueStyles,
}

impl SurfaceStyles {
    /// Nothing of a scene with so many object ids: what is not drawn, entry 0 (the background) included, is paper.
    pub fn new(count: usize) -> Self {
        Self { surfaces: vec![GpuSurfaceStyle::default(); count], techniques: TechniqueStyles::default() }
    }

    /// Adds an object.
    pub fn add(&mut self, object: &Styled<'_>) {
        if let Some(surface) = object.entry(&mut self.surfaces) {
            *surface = GpuSurfaceStyle::new(object.style);
        }
        self.techniques.add(object);
    }
}

/// Everything but the layer itself that shading depends on, for one camera.
#[derive(Clone, PartialEq)]
pub struct Look {
    styles: SurfaceStyles,
    /// The caps of a section by object id; empty when there are none.
    caps: Vec<GpuCap>,
}

/// What of shading lives across frames, for one camera.
pub struct Shading {
    surfaces: ArrayBuffer,
    caps: ArrayBuffer,
    techniques: Techniques,
    uploaded: Option<Look>,
}

impl Shading {
    /// Nothing drawn yet.
    pub fn new(gpu: &Gpu) -> Self {
        Self {
            surfaces: ArrayBuffer::new(gpu, "surface styles"),
            caps: ArrayBuffer::new(gpu, "caps"),
            techniques: Techniques::new(gpu),
            uploaded: None,
        }
    }

    /// Names of the stages of techniques, and how often each has run.
    pub fn runs(&self) -> Vec<(&'static str, u64)> {
        self.techniques.runs()
    }

    /// Takes to the device what all layers of a picture read, unless it is there.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn upload(
        &mut self,
        shared: &mut SharedTechniques,
        gpu: &Gpu,
        look: &Look,
    ) -> Result<(), RenderError> {
        if self.uploaded.as_ref() == Some(look) {
            return Ok(());
        }
        self.uploaded = None;
        self.surfaces.write(gpu, &look.styles.surfaces);
        if !look.caps.is_empty() {
            self.caps.write(gpu, &look.caps);
        }
        self.techniques.upload(shared, gpu, &look.styles.techniques)?;
        self.uploaded = Some(look.clone());
        Ok(())
    }

    /// Shades a layer: linear color times opacity, and opacity; nothing where there is no object. `by_opacity`: colors
    /// are as opaque as the materials, otherwise fully.
    ///
    /// # Errors
    /// [`RenderError`].
    pub fn shade(
        &mut self,
        rec: &mut Recorder<'_>,
        shared: &mut SharedTechniques,
        look: &Look,
        layer: &Shaded<'_>,
        by_opacity: bool,
    ) -> Result<Target, RenderError> {
        let Look { styles: SurfaceStyles { surfaces, techniques }, caps } = look;
        self.techniques.begin(rec, shared, techniques, layer)?;
        let gbuffer = layer.gbuffer;
        let color = rec.target("color", wgpu::TextureFormat::Rgba16Float)?;
        let program = |entry_point, only: Option<Technique>| {
            let is_drawn = |technique| surfaces.iter().any(|s| s.technique == technique as u32);
            let with_plain = is_drawn(Technique::Plain) && only.is_none_or(|only| only == Technique::Plain);
            let mut switches = vec![
                ("WITH_SHADOWS", layer.shadow_mask.is_some()),
                ("WITH_OPACITY", by_opacity),
                ("WITH_PLAIN", with_plain),
            ];
            switches.extend(techniques.switches(only));
            Program { file: "effects/surface.wgsl", entry_point, switches }
        };
        let mut inputs = inputs! {
            geometry_tex: &gbuffer.geometry,
            surface_id_tex: &gbuffer.surface_id,
            base_color_tex: &gbuffer.base_color,
            shadow_mask_tex: layer.shadow_mask.map(|(mask, _)| mask),
            surface_styles: &self.surfaces,
        };
        self.techniques.bind(shared, &mut inputs);
        let drawn = drawn_techniques(surfaces);
        if drawn.len() < 2 {
            let program = program("fs_main", None);
            rec.fullscreen("surface", program, &inputs, &[&color], Some(&gbuffer.depth))?;
        } else {
            let numbers = rec.target("techniques", DEPTH)?;
            rec.draw(Draw {
                label: "techniques",
                program: program("fs_technique", None),
                inputs: &inputs,
                outputs: &[],
                onto: Onto::Clear,
                depth: Some((&numbers, DepthRule::Mark)),
            })?;
            let mut onto = Onto::Clear;
            for technique in drawn {
                rec.draw(Draw {
                    label: "surface",
                    program: program("fs_main", Some(technique)),
                    inputs: &inputs,
                    outputs: &[&color],
                    onto,
                    depth: Some((&numbers, DepthRule::Equal(technique as u32 as f32 * DEPTH_PER_TECHNIQUE))),
                })?;
                onto = Onto::Load;
            }
        }
        if !caps.is_empty() {
            draw_caps(rec, gbuffer, &self.caps, &color)?;
        }
        Ok(color)
    }
}

/// Steps of depth by which techniques are told apart. Twin of that in `shaders/effects/surface.wgsl`.
const DEPTH_PER_TECHNIQUE: f32 = 1.0 / 64.0;

/// The techniques of these objects that draw anything, each once.
fn drawn_techniques(surfaces: &[GpuSurfaceStyle]) -> Vec<Technique> {
    let is_drawn =
        |technique: &Technique| surfaces.iter().any(|surface| surface.technique == *technique as u32);
    Technique::iter().filter(|technique| *technique != Technique::Blank).filter(is_drawn).collect()
}

impl Look {
    /// Those of these lines that shading goes by, and what changes when they do.
    pub fn lines<'a>(&self, edges: Option<&'a Output<EdgeMap>>) -> Option<(&'a Target, u64)> {
        let edges = edges.filter(|_| self.styles.techniques.read_lines())?;
        Some((edges.value.spines.as_ref()?, edges.revision))
    }

    /// The caps of a section by object id; empty when there are none.
    pub fn caps(&self) -> &Vec<GpuCap> {
        &self.caps
    }

    /// How objects of these styles look to a camera, with these caps.
    pub fn new(styles: &SurfaceStyles, scene_view: &SceneView<'_>, caps: Vec<GpuCap>) -> Self {
        let techniques = styles.techniques.placed(scene_view.scene, scene_view.view);
        Self { styles: SurfaceStyles { surfaces: styles.surfaces.clone(), techniques }, caps }
    }
}
